# SPDX-License-Identifier: BSD-3-Clause
"""From where clouds are seen, and where the light comes from: the choices of the program, for what is not said.

Tests hold these rules to those of the program (Utilities/CommandLine/SceneView.cxx) by comparing pictures.
"""
from __future__ import annotations

from typing import Any

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPointSet, vtkStructuredGrid
from vtkmodules.vtkRenderingCore import vtkCamera

from ._arrays import Array, arrays, points
from ._grids import RADIUS, dataset_of

TROPOSPHERE = 16000.0  #: m: what pictures of clouds show
_MARGIN = 1.06
_CLOUDY = {"CloudFraction": 0.05, "LiquidWater": 1e-6, "IceWater": 1e-6}


def unit(vector: Any) -> Array:
    vector = np.asarray(vector, float)
    length = np.linalg.norm(vector)
    if not 0 < length < np.inf:
        raise ValueError(f"{tuple(vector)} is no direction")
    return np.asarray(vector / length)


class Extent:
    """How data lie in the scene."""

    def __init__(self, data: vtkDataSet):
        words, fields = data.GetFieldData().GetAbstractArray("Geometry"), data.GetFieldData()
        #: "Globe", "Map", "Local"; empty for data that do not say.
        self.geometry = words.GetValue(0) if words else ""
        radius, scale = fields.GetArray("PlanetRadius"), fields.GetArray("HeightScale")
        self.radius = radius.GetValue(0) if radius else RADIUS
        self.scale = scale.GetValue(0) if scale else 1.0  #: scene units per metre of height
        everything, clouds = _hulls(data)
        self.hull = clouds if len(clouds) >= 8 else everything
        self.middle = (self.hull.min(axis=0) + self.hull.max(axis=0)) / 2 if len(self.hull) else np.zeros(3)
        self.whole = False
        if self.globe and len(everything):
            mean = (everything / np.linalg.norm(everything, axis=1)[:, None]).mean(axis=0)
            self.whole = bool(np.linalg.norm(mean) < 0.3)
            self.middle = unit(mean)
        self.step = _step(data)

    @property
    def globe(self) -> bool:
        return bool(self.geometry == "Globe")


def _hulls(data: vtkDataSet) -> tuple[Array, Array]:
    """Points of the troposphere, some thousand a layer at most, (n, 3); those of them in cloud."""
    if not isinstance(data, vtkPointSet):
        low, high = np.array(data.GetBounds()).reshape(3, 2).T
        corners = np.array(np.meshgrid(*zip(low, high))).reshape(3, -1).T if data.GetNumberOfPoints() else np.empty((0, 3))
        return corners, corners
    where, values = points(data), arrays(data)
    thin: Any = (slice(None),) + tuple(slice(None, None, max(1, (n - 1) // 64)) for n in where.shape[1:3]) \
        if where.ndim == 4 else slice(None)
    where = where[thin]
    shown = values["Height"][thin] <= TROPOSPHERE if "Height" in values else np.full(where.shape[:-1], True)
    cloudy = [values[name][thin] > least for name, least in _CLOUDY.items() if name in values and where.ndim == 4]
    return where[shown], where[shown & np.logical_or.reduce(cloudy)] if cloudy else where[shown]


def _step(data: vtkDataSet) -> float:
    """Typical distance of neighbours from south to north, scene units."""
    if not isinstance(data, vtkStructuredGrid) or data.GetDimensions()[1] < 2:
        return 0.0
    steps = np.linalg.norm(np.diff(points(data)[0], axis=0), axis=-1).ravel()
    return float(np.partition(steps, steps.size // 2)[steps.size // 2])


def _direction(longitude: float, latitude: float) -> Array:
    lon, lat = np.radians([longitude, latitude])
    return np.array([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])


def _frame(toward_eye: Array, view_up: Any) -> tuple[Array, Array, Array]:
    """Forward, right and up of a picture."""
    forward = -unit(toward_eye)
    right = unit(np.cross(forward, view_up))
    return forward, right, np.cross(right, forward)


def _fitting(extent: Extent, target: Array, frame: tuple[Array, Array, Array], tangents: tuple[float, float]) -> float:
    """The least distance from the target from which the clouds are in a picture of these half angles' tangents."""
    forward, right, up = frame
    off = extent.hull - target
    across, above = np.abs(off @ right) / tangents[0], np.abs(off @ up) / tangents[1]
    return float(np.maximum(np.maximum(across, above) - off @ forward, 0).max(initial=0.0))


def camera(clouds: Any, *, longitude: float | None = None, latitude: float | None = None, bearing: float = 150.0,
           elevation: float = 15.0, distance: float | None = None, view_angle: float = 30.0,
           size: tuple[int, int] = (1024, 768)) -> vtkCamera:
    """A camera that sees the clouds.

    Parameters
    ----------
    clouds
        A VTK data set, or arrays as ``grid`` takes them.
    longitude, latitude
        On a globe, the place under the eye, degrees. Default: the middle of the data; of a whole globe, 35 W 20 N.
    bearing, elevation
        Elsewhere, the compass direction from the data's middle to the eye, and its height over the horizon, degrees.
        Default 150 and 15.
    distance
        On a globe, of the eye from the centre, planet radii, above 1; elsewhere 1 is where all clouds fit. Default: all fit.
    view_angle
        Vertical angle of view, degrees, above 0 and below 180. Default 30.
    size
        Width and height of the picture, pixels, for which the clouds are to fit. Default (1024, 768).

    Returns
    -------
    vtkCamera
        for ``render(camera=...)``, or any VTK renderer.
    """
    return camera_of(Extent(dataset_of(clouds)), longitude, latitude, bearing, elevation, distance, view_angle, size)


def camera_of(extent: Extent, longitude: float | None, latitude: float | None, bearing: float, elevation: float,
              distance: float | None, view_angle: float, size: tuple[int, int]) -> vtkCamera:
    """The camera that ``camera`` documents."""
    if not 0 < view_angle < 180:
        raise ValueError(f"view_angle={view_angle} is not between 0 and 180 degrees")
    if distance is not None and not distance > 0:
        raise ValueError(f"distance={distance} is not above 0")
    for name, angle, most in (("longitude", longitude, 360), ("latitude", latitude, 90), ("bearing", bearing, 360),
                              ("elevation", elevation, 90)):
        if angle is not None and not abs(angle) <= most:
            raise ValueError(f"{name}={angle} is not within {-most} and {most} degrees")
    if extent.globe:
        east, north = (-35.0, 20.0) if extent.whole else _place_of(extent.middle)
        toward_eye = _direction(east if longitude is None else longitude, north if latitude is None else latitude)
    else:
        toward_eye = _direction(90 - bearing, elevation)
    vertical = np.array([0, 0, 1.0])
    up = vertical if np.linalg.norm(np.cross(vertical, toward_eye)) > 1e-6 else np.array([0, 1.0, 0])
    tangent = np.tan(np.radians(view_angle / 2)) / _MARGIN
    target = np.zeros(3) if extent.globe else extent.middle
    tangents = (tangent * size[0] / size[1], tangent)
    eye = target + toward_eye * _distance(extent, target, _frame(toward_eye, up), tangents, distance)
    made = vtkCamera()
    made.SetPosition(*eye)
    made.SetFocalPoint(*target)
    made.SetViewUp(*up)
    made.SetViewAngle(view_angle)
    return made


def _place_of(direction: Array) -> tuple[float, float]:
    return float(np.degrees(np.arctan2(direction[1], direction[0]))), float(np.degrees(np.arcsin(np.clip(direction[2], -1, 1))))


def _distance(extent: Extent, target: Array, frame: tuple[Array, Array, Array], tangents: tuple[float, float],
              distance: float | None) -> float:
    """Of the eye from the target, scene units."""
    if not extent.globe:
        return float((1.0 if distance is None else distance) * (_fitting(extent, target, frame, tangents) or 1.0))
    if distance is not None:
        return float(distance * extent.radius)
    shell = extent.radius + extent.scale * TROPOSPHERE
    whole = float(shell / np.sin(np.arctan(min(tangents))))
    near = extent.radius + _fitting(extent, -extent.radius * frame[0], frame, tangents)
    return whole if extent.whole else float(min(whole, near))


def toward_sun_of(extent: Extent, eye: vtkCamera) -> Array:
    """Over the eye's left shoulder; over flat ground 35 degrees high."""
    forward, right, up = _frame(np.subtract(eye.GetPosition(), eye.GetFocalPoint()), eye.GetViewUp())
    if extent.globe:
        return unit(-0.45 * forward - 0.7 * right + 0.55 * up)
    level = unit((-right - 0.5 * forward) * (1, 1, 0))
    return np.asarray(np.cos(np.radians(35)) * level + np.sin(np.radians(35)) * np.array([0, 0, 1.0]))
