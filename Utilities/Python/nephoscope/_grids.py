# SPDX-License-Identifier: BSD-3-Clause
"""Grids of arrays and coordinates."""
from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSet, vtkImageData, vtkStructuredGrid

from ._arrays import Array, values_of, vtk_array
from ._coordinates import attributes, discovered, epoch_seconds, metres, ordered
from ._files import choice

RADIUS = 6371229.0  #: of the Earth, m
_METRES_PER_DEGREE = RADIUS * np.pi / 180


class _Columns:
    """Where the columns of a grid stand, and how a grid of longitudes and latitudes that goes round is closed."""

    def __init__(self, east: Any, north: Any, geometry: str, close: bool):
        east, north = _axis_pair(east, north, geometry)
        self.geometry = geometry
        plain = east.ndim == 1 and north.ndim == 1
        self.seam = plain and close and geometry != "local" and goes_round(east)
        self.poles = [False, False]
        if self.seam and geometry == "globe" and len(north) > 1:
            step = 1.5 * abs(north[1] - north[0])
            self.poles = [bool(0 < 90 - abs(end) <= step) for end in (north[0], north[-1])]
        self.shape = (len(north), len(east)) if plain else np.broadcast_shapes(east.shape, north.shape)
        if self.seam:
            east = np.append(east, east[0] + np.copysign(360, east[-1] - east[0]))
        south, rest = np.copysign(90, north[:1])[: self.poles[0]], np.copysign(90, north[-1:])[: self.poles[1]]
        north = np.concatenate([south, north, rest]) if plain else north
        #: (rows, columns) of what is built: degrees, or m in the geometry local.
        self.east, self.north = np.meshgrid(east, north) if plain else np.broadcast_arrays(east, north)

    def closed(self, values: Array) -> Array:
        """Values (levels, rows, columns[, 3]) with the column and the rows that close the grid; a pole has its row's mean."""
        rows = [values]
        if self.poles[0]:
            rows.insert(0, _mean_row(values[:, :1]))
        if self.poles[1]:
            rows.append(_mean_row(values[:, -1:]))
        values = np.concatenate(rows, axis=1) if len(rows) > 1 else values
        return np.concatenate([values, values[:, :, :1]], axis=2) if self.seam else values

    def directions(self) -> tuple[Array, Array, Array]:
        """Unit vectors east, north and up at each column, (rows, columns, 3), in the scene."""
        if self.geometry != "globe":
            return tuple(np.broadcast_to(axis, (*self.east.shape, 3)) for axis in np.eye(3))  # type: ignore[return-value]
        lon, lat = np.radians(self.east), np.radians(self.north)
        east = np.stack([-np.sin(lon), np.cos(lon), 0 * lon], axis=-1)
        up = np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=-1)
        return east, np.cross(up, east), up

    def places(self, height: Array) -> Array:
        """Points (levels, rows, columns, 3) in the scene at heights in scene units."""
        if self.geometry == "globe":
            return (RADIUS + height)[..., None] * self.directions()[2]
        scale = _METRES_PER_DEGREE if self.geometry == "map" else 1.0
        return np.stack(np.broadcast_arrays(scale * self.east, scale * self.north, height), axis=-1)


def _axis_pair(east: Any, north: Any, geometry: str) -> tuple[Array, Array]:
    """Coordinates as numbers, of one dimension each or of the same two."""
    names = ("x", "y") if geometry == "local" else ("longitude", "latitude")
    east, north = values_of(east).astype(float), values_of(north).astype(float)
    if not (east.ndim == north.ndim == 1 or (east.ndim == 2 and east.shape == north.shape)):
        raise ValueError(f"{names[0]} is {east.shape} and {names[1]} {north.shape}; "
                         "give 1 dimension each, or (rows, columns) both")
    for name, values in zip(names, (east, north)):
        if not np.isfinite(values).all():
            raise ValueError(f"{name} has values that are not finite; every column needs a place")
    if geometry != "local":
        east = _unwrapped(east)
        if np.abs(north).max() > 90 + 1e-6:
            raise ValueError(f"latitude reaches {north.flat[np.abs(north).argmax()]:g}; give degrees from -90 to 90")
    for name, values in zip(names, (east, north)):
        _check_axis(name, values)
    return east, north


def _unwrapped(longitude: Array) -> Array:
    """Longitudes, degrees, without the step from 359 to 0 or from 180 to -180."""
    steps = np.diff(longitude)
    plain = longitude.ndim != 1 or (steps > 0).all() or (steps < 0).all()
    return longitude if plain else np.unwrap(longitude, period=360)


def _check_axis(name: str, values: Array) -> None:
    steps = np.diff(values)
    if values.ndim == 1 and not ((steps > 0).all() or (steps < 0).all()):
        raise ValueError(f"{name} neither rises nor falls throughout; sort it, and the arrays along it")


def _mean_row(row: Array) -> Array:
    """Each value the mean of those of its row that are numbers."""
    known = np.isfinite(row).sum(axis=2, keepdims=True)
    mean = np.nansum(row, axis=2, keepdims=True) / np.where(known, known, np.nan)
    return np.broadcast_to(mean, row.shape).astype(row.dtype)


def goes_round(longitude: Any) -> bool:
    """Whether longitudes, degrees, go once round, the first one not repeated."""
    n = len(longitude)
    return n > 2 and bool(abs(abs(longitude[-1] - longitude[0]) * n / (n - 1) - 360) < 1e-3 * 360 / n)


def _named(fields: Any) -> dict[str, Any]:
    if isinstance(fields, Mapping):
        return {str(name): fields[name] for name in fields}
    return {"CloudFraction": np.asarray(fields) if isinstance(fields, (tuple, list)) else fields}


def _scalar(name: str, data: Any) -> Array:
    values = ordered(name, data)
    if values.ndim != 3:
        raise ValueError(f"'{name}' has {values.ndim} dimensions {values.shape}; 3 are needed: (height, latitude, longitude) "
                         "or (height, y, x)")
    return np.asarray(values * np.float32(0.01)) if attributes(data).get("units") == "%" else values


def _components(name: str, data: Any) -> list[Array]:
    """Eastward, northward and upward component of a vector field, (height, rows, columns) each."""
    parts: Any = data if isinstance(data, (tuple, list)) else np.moveaxis(values_of(data), -1, 0)
    if len(parts) not in (2, 3):
        raise ValueError(f"'{name}' has {len(parts)} components; give (eastward, northward[, upward]), or an array whose last "
                         "axis is these")
    components = [_scalar(name, part) for part in parts]
    for component in components:
        _check_shape(name, component.shape, components[0].shape)
    return [*components, *[np.zeros_like(components[0])] * (3 - len(parts))]


def _is_vector(data: Any) -> bool:
    return isinstance(data, (tuple, list)) or (not hasattr(data, "dims") and np.ndim(data) == 4)


def _placed_vector(name: str, data: Any, columns: _Columns) -> Array:
    if columns.geometry != "globe" and not columns.seam and not isinstance(data, (tuple, list)) and np.shape(data)[-1] == 3:
        return values_of(data)
    parts = _components(name, data)
    _check_shape(name, parts[0].shape, (parts[0].shape[0], *columns.shape))
    if columns.geometry != "globe":
        return columns.closed(np.stack(parts, axis=-1))
    open_columns = (slice(columns.poles[0], columns.poles[0] + columns.shape[0]), slice(0, columns.shape[1]))
    turned = sum(part[..., None] * axis[open_columns] for part, axis in zip(parts, columns.directions()))
    return columns.closed(np.asarray(turned, parts[0].dtype))


def _check_shape(name: str, shape: tuple[int, ...], wanted: tuple[int, ...]) -> None:
    if shape[:3] != wanted:
        raise ValueError(f"'{name}' is {shape[:3]} where the grid is {wanted} (levels, rows, columns)")


def _attach(data: vtkDataSet, name: str, values: Array) -> None:
    data.GetPointData().AddArray(vtk_array(values, name, values.shape[3] if values.ndim == 4 else 1))


def _describe(data: vtkDataSet, geometry: str, exaggeration: float) -> None:
    """The field data by which the modules know how the grid lies in the scene."""
    word = vtkStringArray()
    word.SetName("Geometry")
    word.InsertNextValue(geometry.capitalize())
    data.GetFieldData().AddArray(word)
    for name, value in (("HeightScale", exaggeration), *((("PlanetRadius", RADIUS),) if geometry == "globe" else ())):
        number = vtkDoubleArray()
        number.SetName(name)
        number.InsertNextValue(value)
        data.GetFieldData().AddArray(number)


def _image(named: Mapping[str, Any], spacing: tuple[float, float, float]) -> vtkImageData:
    image = vtkImageData()
    shape: tuple[int, ...] = ()
    for name, data in named.items():
        if not _is_vector(data):
            values = _scalar(name, data)
        elif isinstance(data, (tuple, list)) or np.shape(data)[-1] != 3:
            values = np.stack(_components(name, data), axis=-1)
        else:
            values = values_of(data)
        shape = shape or values.shape[:3]
        _check_shape(name, values.shape, shape)
        _attach(image, name, values)
    image.SetDimensions(shape[::-1])
    image.SetSpacing(spacing)
    return image


def _structured(named: Mapping[str, Any], columns: _Columns, height: Any, exaggeration: float) -> vtkStructuredGrid:
    heights = metres(height) if np.ndim(getattr(height, "values", height)) != 3 else ordered("height", height)
    metres(height)
    wanted = (heights.shape[0], *columns.shape)
    if heights.ndim == 3:
        _check_shape("height", heights.shape, wanted)
        heights = columns.closed(heights)
    elif heights.ndim == 1:
        _check_axis("height", heights)
        heights = values_of(np.broadcast_to(heights[:, None, None], (len(heights), *columns.east.shape)))
    else:
        raise ValueError(f"height has {heights.ndim} dimensions; give 1 (levels) or 3 (levels, rows, columns)")
    grid = vtkStructuredGrid()
    grid.SetDimensions(heights.shape[::-1])
    points = vtkPoints()
    points.SetData(vtk_array(values_of(columns.places(exaggeration * heights.astype(float))), "Points", 3))
    grid.SetPoints(points)
    _attach(grid, "Height", heights)
    for name, data in named.items():
        if _is_vector(data):
            values = _placed_vector(name, data, columns)
        else:
            scalar = _scalar(name, data)
            _check_shape(name, scalar.shape, wanted)
            values = columns.closed(scalar)
        _check_shape(name, values.shape, heights.shape)
        _attach(grid, name, values_of(values))
    return grid


def grid(fields: Any, *, longitude: Any = None, latitude: Any = None, x: Any = None, y: Any = None, height: Any = None,
         geometry: str | None = None, exaggeration: float = 1.0, close: bool = True,
         spacing: tuple[float, float, float] = (1.0, 1.0, 1.0), time: Any = None) -> vtkDataSet:
    """Arrays with their coordinates as a grid in the scene, in the arrays' own memory where it can be shared.

    An array is anything that numpy takes, or that has ``.values`` and, optionally, ``.dims``, ``.coords`` and ``.attrs``, as
    xarray's do; xarray itself is not needed. Its axes are (height, latitude, longitude) or (height, y, x), in either direction,
    unless its ``.dims`` say otherwise. Contiguous arrays of floats in this order are not copied: the grid reads your
    memory, and keeps it. Copied is what is transposed, packed, masked (NaN then), in ``%`` (a fraction then), in
    the other byte order, and what a globe or map that goes round is closed with; ``close=False`` avoids the last. Nothing
    writes into your arrays, but what ``arrays`` gives of the grid is the same memory.

    Parameters
    ----------
    fields
        One array, the CloudFraction, or a mapping from name to array, as a dict or an ``xarray.Dataset`` of such. The names
        that the modules know: CloudFraction (0..1), LiquidWater, IceWater, SpecificHumidity (kg/kg), Pressure (Pa),
        Temperature (K), Wind (m/s: a tuple of eastward, northward and, optionally, upward arrays, or one with a last axis of
        3), Extinction (1/m). Others are carried along; ``contour(field=...)`` and ``render(field=...)`` take any.
    longitude, latitude
        Degrees; 1 dimension each, rising or falling (from 359 on to 0, and 180 on to -180, too), or (rows, columns) both.
        Default: the coordinates that the fields bring along.
    x, y
        m, in place of longitude and latitude, likewise.
    height
        m above sea level; (levels,), rising or falling, or (levels, rows, columns). Levels of pressure are not heights: give these.
    geometry
        ``"globe"``, ``"map"`` (m on the equator), or ``"local"`` for x and y. Default: globe where longitudes go once round
        the Earth, else map.
    exaggeration
        Factor on heights in the scene, 1e-6 to 1e6. Default 1.
    close
        Whether longitudes that go round get their first column again at the end and, on a globe, a row at each pole. Default.
    spacing
        Distances (x, y, z) of the points of arrays without any coordinates. Default 1 each.
    time
        Seconds, or a date, for ``advect`` and ``interpolate``; dates count from 1970. Default: what the fields bring along.

    Returns
    -------
    vtkStructuredGrid
        or, without any coordinates, vtkImageData.

    Raises
    ------
    ValueError
        Shapes that do not fit, dimensions that cannot be told, coordinates missing, heights that are no heights.
    TypeError
        Arrays that are not of real numbers.

    Examples
    --------
    >>> clouds = nephoscope.grid(cover, longitude=lon, latitude=lat, height=z, exaggeration=10)
    >>> clouds = nephoscope.grid(dataset.isel(time=0), height=dataset.zg.isel(time=0))     # an xarray.Dataset
    """
    named = _named(fields)
    if not named:
        raise ValueError("there are no fields; give an array, or a mapping from name to array")
    if not 1e-6 <= exaggeration <= 1e6:
        raise ValueError(f"exaggeration={exaggeration} is not within 1e-6 to 1e6")
    known = discovered(part for data in named.values() for part in (data if isinstance(data, (tuple, list)) else (data,)))
    known.update({key: value for key, value in (("longitude", longitude), ("latitude", latitude), ("x", x), ("y", y),
                                                ("height", height), ("time", time)) if value is not None})
    if any(np.size(coordinate) == 0 for coordinate in known.values()):
        raise ValueError("a coordinate is empty; a grid needs a value at least of each")
    lying = _lying(known, geometry, plane=x is not None or y is not None)
    if lying is None:
        built: vtkDataSet = _image(named, spacing)
    else:
        east, north = ("x", "y") if lying == "local" else ("longitude", "latitude")
        _require(known, east, north)
        columns = _Columns(known[east], known[north], lying, close)
        built = _structured(named, columns, known["height"], exaggeration)
        _describe(built, lying, exaggeration)
    if "CloudFraction" in named:
        built.GetPointData().SetActiveScalars("CloudFraction")
    if np.size(known.get("time", ())) == 1:
        built.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), epoch_seconds(known["time"]))
    return built


def _lying(known: Mapping[str, Any], geometry: str | None, plane: bool) -> str | None:
    """The geometry; None for arrays without any coordinates."""
    if geometry is not None:
        choice("geometry", geometry, ("globe", "map", "local"))
        return geometry
    if not plane and known.keys() & {"longitude", "latitude"}:
        longitude = _unwrapped(values_of(known.get("longitude", ())))
        whole = longitude.ndim == 1 and len(longitude) > 2 and (goes_round(longitude) or np.ptp(longitude) >= 359.99)
        return "globe" if whole else "map"
    return "local" if known.keys() & {"x", "y", "height"} else None


def _require(known: Mapping[str, Any], east: str, north: str) -> None:
    for key in (east, north, "height"):
        if key not in known:
            level = known.get("level")
            have = f"; the levels are in '{attributes(level).get('units', '?')}'" if key == "height" and level is not None else ""
            raise ValueError(f"there is no {key}{have}: give {key}=, in {'degrees' if key.endswith('itude') else 'm'}")


def dataset_of(data: Any) -> vtkDataSet:
    """A VTK data set as it is; arrays as a grid."""
    if isinstance(data, (str, os.PathLike)):
        raise TypeError(f"{os.fspath(data)!r} is the name of a file; give nephoscope.open(...) of it")
    return data if isinstance(data, vtkDataSet) else grid(data)
