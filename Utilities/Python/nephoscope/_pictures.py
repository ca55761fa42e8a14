# SPDX-License-Identifier: BSD-3-Clause
"""Data to pictures."""
from __future__ import annotations

import difflib
import os
import pathlib
import re
import tempfile
from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np
import numpy.typing as npt
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSet, vtkImageData, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkRenderingCore import vtkCamera

from ._arrays import arrays, points, vtk_array
from ._errors import CloudError, raising
from ._files import choice
from ._filters import contour
from ._grids import dataset_of
from ._views import Extent, camera_of, toward_sun_of, unit
from .vtkCloudRendering import (
    vtkCloudCellVolume, vtkCloudGlobe, vtkCloudGradedBackdrop, vtkCloudGround, vtkCloudLitBody,
    vtkCloudPictureWriter, vtkCloudPlane, vtkCloudscape, vtkCloudSurface, vtkCloudUniformMedium)

Image = npt.NDArray[np.float32]
_STYLES = ("surface", "texture", "volume")
_AMBIENT = 0.3
_HAZE_DEPTH = 0.2  # optical depth between the eye and the middle of regional clouds
_HAZE, _SPACE = (0.42, 0.57, 0.8), (0.001, 0.0015, 0.003)
_SEA, _LAND = (0.014, 0.042, 0.1), (0.13, 0.12, 0.065)


class Picture:
    """A picture of ``render``. Its arrays are VTK's own memory, row 0 on top as in an image file; nothing is copied.

    Attributes
    ----------
    image : vtkImageData
        The same with VTK's row order, row 0 at the bottom.
    radiance : numpy.ndarray
        (height, width, 3) float32, linear RGB; a white surface full in the sun has about 1.
    transmittance : numpy.ndarray
        (height, width, 3) float32, 0..1: what all that is drawn lets through of the backdrop.
    depth : numpy.ndarray
        (height, width) float32, scene units along the ray to where half of the light gets through; inf where more does.
    """

    def __init__(self, image: vtkImageData):
        self.image = image

    def __repr__(self) -> str:
        return "<nephoscope.Picture {} x {}>".format(*self.image.GetDimensions())

    def _array(self, name: str) -> Image:
        width, height, _ = self.image.GetDimensions()
        values = vtk_to_numpy(self.image.GetPointData().GetArray(name))
        return cast(Image, values.reshape((height, width) + values.shape[1:])[::-1])

    @property
    def radiance(self) -> Image:
        return self._array("Radiance")

    @property
    def transmittance(self) -> Image:
        return self._array("Transmittance")

    @property
    def depth(self) -> Image:
        return self._array("Depth")

    def save(self, file: str | os.PathLike[str], *, exposure: float = 0.0, shoulder: float = 0.0) -> None:
        """Writes the picture beside its place and then renames it, so that there is never a part of a file.

        Parameters
        ----------
        file
            ``.png``: 8-bit sRGB to look at; ``.exr``: linear RGB, transmittance and depth to work on.
        exposure
            Stops, of a PNG: light is multiplied by 2**exposure. Default 0.
        shoulder
            How much of a PNG's range is for highlights, 0 to 1: above 1 - shoulder light is bent so that it never clips.
            Default 0.

        Raises
        ------
        CloudError
            Another extension, or a place that cannot be written.
        """
        writer = vtkCloudPictureWriter()
        writer.SetInputData(self.image)
        writer.SetFileName(os.fspath(file))
        writer.SetExposure(exposure)
        writer.SetShoulder(shoulder)
        with raising():
            writer.Write()

    def _repr_png_(self) -> bytes:
        """How Jupyter shows it."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "picture.png"
            self.save(path)
            return path.read_bytes()

    def rgb(self, *, exposure: float = 0.0, shoulder: float = 0.0) -> npt.NDArray[np.uint8]:
        """As displayed: (height, width, 3) uint8 sRGB, for ``matplotlib.pyplot.imshow`` and the like.

        Parameters as of ``save``.
        """
        from vtkmodules.vtkIOImage import vtkPNGReader
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "picture.png"
            self.save(path, exposure=exposure, shoulder=shoulder)
            reader = vtkPNGReader()
            reader.SetFileName(str(path))
            reader.Update()
        pixels = arrays(reader.GetOutput())["PNGImage"]
        return cast("npt.NDArray[np.uint8]", pixels[0, ::-1])


def set_properties(body: Any, properties: Mapping[str, Any]) -> None:
    """Calls Set<Name> for each name in snake_case. Raises TypeError for a name that the body has not."""
    names = {re.sub(r"(?<!^)(?=[A-Z])", "_", name[3:]).lower(): name for name in dir(body) if name.startswith("Set")}
    for name, value in properties.items():
        if name not in names:
            near = difflib.get_close_matches(name, names, 1)
            guess = f"; did you mean '{near[0]}'?" if near else ""
            raise TypeError(f"a {body.GetClassName()} has no property '{name}'{guess}")
        getattr(body, names[name])(*value if isinstance(value, (tuple, list)) else (value,))


def render(clouds: Any, style: str = "surface", *, size: tuple[int, int] = (1024, 768), field: str = "CloudFraction",
           value: float | Sequence[float] = 0.15, smoothing: float | None = None,
           camera: vtkCamera | Mapping[str, float] | None = None, toward_sun: Sequence[float] | None = None,
           ground: bool | None = None, samples: int = 2, depth: bool = True, **look: Any) -> Picture:
    """A picture of clouds, drawn in software: no display and no OpenGL is needed.

    What is not said is chosen as ``nephoscope render`` does.

    Parameters
    ----------
    clouds
        A grid of ``open``, ``grid``, ``advect`` or ``interpolate``, or any VTK or PyVista one; arrays as ``grid`` takes them; a
        surface (vtkPolyData); or a ``vtkCloudscape``, whose own camera, size and bodies then hold and nothing else does.
    style
        ``"surface"``: smooth shaded surfaces of one cloudiness; ``"texture"``: such surfaces torn open by a transparency
        texture; ``"volume"``: the grid's cells as fog. Max 1994, figures 5, 6, 7. Default ``"surface"``.
    size
        Width and height, pixels, 1 to 32768. Default (1024, 768).
    field
        The point array that is contoured, or that makes the cells dense. Default CloudFraction. For cells made dense by
        LiquidWater and IceWater instead, say ``extinction_rule=1`` (see ``help(nephoscope.vtkCloudCellVolume)``).
    value
        Of the surfaces. Default 0.15.
    smoothing
        Standard deviation of the filter before contouring, scene units (m). Default: one step of a structured grid.
    camera
        A vtkCamera, or what ``camera`` is to be told, such as ``{"longitude": 10, "latitude": 45, "distance": 2}``.
    toward_sun
        Direction to the sun in the scene. Default: over the eye's left shoulder.
    ground
        Whether there are a globe, or a plane and haze over it, and a sky. Default: if the data say how they lie, as those
        of ``open`` and ``grid`` do.
    samples
        samples x samples rays a pixel, 1 to 8. Default 2; 1 leaves outlines jagged.
    depth
        Whether to find the depth too; a volume alone is drawn twice as fast without. Default.
    **look
        Properties of what is drawn, in snake_case: of ``vtkCloudSurface`` (``color``, ``opacity``, ``texture_wavelength`` in m,
        ``texture_octaves``, ``texture_offset``, ...) or ``vtkCloudCellVolume`` (``full_cover_extinction`` in 1/m, ``color``,
        ``liquid_radius`` in m, ...): ``help`` has units, ranges and defaults.

    Returns
    -------
    Picture
        with the arrays ``radiance``, ``transmittance``, ``depth``, and ``save``.

    Raises
    ------
    ValueError
        No such style; a size, camera or array that makes no sense.
    TypeError
        A property that the style has not.
    CloudError
        An array is missing, or something cannot be drawn; the message says what and why.

    Examples
    --------
    >>> clouds = nephoscope.open("climate.nc", geometry="globe", exaggeration=10)
    >>> picture = nephoscope.render(clouds, style="texture", size=(640, 480), texture_wavelength=1.5e6)
    >>> picture.save("clouds.png")
    >>> picture.radiance.shape
    (480, 640, 3)
    """
    if isinstance(clouds, vtkCloudscape):
        return _drawn(clouds)
    choice("style", style, _STYLES)
    data = dataset_of(clouds)
    if np.shape(size) != (2,) or min(size) < 1:
        raise ValueError(f"size={size} is no width and height of a picture")
    if not 1 <= samples <= 8:
        raise ValueError(f"samples={samples} is not within 1 to 8")
    extent = Extent(data)
    scape = vtkCloudscape()
    scape.SetSize(*(int(n) for n in size))
    scape.SetSamples(samples)
    scape.SetComputeDepth(depth)
    eye = camera if isinstance(camera, vtkCamera) else _camera(extent, camera or {}, size)
    scape.SetCamera(eye)
    sun = unit(toward_sun) if toward_sun is not None else toward_sun_of(extent, eye)
    if ground if ground is not None else bool(extent.geometry):
        _add_surroundings(scape, extent, sun, eye)
    if style == "volume":
        scape.AddBody(_volume(data, extent, sun, field, look))
    else:
        surface = data if isinstance(data, vtkPolyData) else contour(
            data, value, field=field, smoothing=extent.step if smoothing is None else smoothing)
        scape.AddBody(_surface(surface, extent, style, sun, look))
    return _drawn(scape)


def _camera(extent: Extent, told: Mapping[str, Any], size: tuple[int, int]) -> vtkCamera:
    options: dict[str, Any] = {"longitude": None, "latitude": None, "bearing": 150.0, "elevation": 15.0, "distance": None,
                               "view_angle": 30.0}
    unknown = [name for name in told if name not in options]
    if unknown:
        raise ValueError(f"camera: {unknown[0]!r} is none of {', '.join(options)}")
    return camera_of(extent, size=size, **{**options, **told})


def _drawn(scape: vtkCloudscape) -> Picture:
    with raising(scape):
        scape.Update()
    image = vtkImageData()
    image.ShallowCopy(scape.GetOutput())
    if not image.GetNumberOfPoints():
        raise CloudError("the cloudscape gave no picture; is there a camera?")
    return Picture(image)


def _light(body: vtkCloudLitBody, sun: Any) -> None:
    body.SetTowardSun(*sun)
    body.SetAmbient(_AMBIENT)


def _add_surroundings(scape: vtkCloudscape, extent: Extent, sun: Any, eye: vtkCamera) -> None:
    """What is under and behind clouds: a globe in dark space, or a sea under a clear sky with haze between."""
    sky = vtkCloudGradedBackdrop()
    sky.SetZenith(_SPACE if extent.globe else (0.08, 0.19, 0.45))
    sky.SetHorizon(_SPACE if extent.globe else _HAZE)
    sky.SetNadir(_SPACE if extent.globe else (0.02, 0.05, 0.1))
    scape.SetBackdrop(sky)
    ground: vtkCloudGround
    if extent.globe:
        ground = vtkCloudGlobe()
        ground.SetRadius(extent.radius)
    else:
        ground = vtkCloudPlane()
    ground.SetSeaColor(_SEA)
    ground.SetLandColor(_LAND)
    _light(ground, sun)
    scape.AddBody(ground)
    if not extent.globe:
        haze = vtkCloudUniformMedium()
        haze.SetExtinction(*[_HAZE_DEPTH / eye.GetDistance()] * 3)
        haze.SetColor(_HAZE)
        scape.AddBody(haze)


def _volume(data: vtkDataSet, extent: Extent, sun: Any, field: str, look: Mapping[str, Any]) -> vtkCloudCellVolume:
    if not look.get("extinction_rule") and not data.GetPointData().HasArray(field):
        raise CloudError(f"No point array '{field}' to draw; the data have: {', '.join(arrays(data))}. Choose one with field=.")
    volume = vtkCloudCellVolume()
    volume.SetFullCoverExtinction(1.5e-4)
    volume.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, field)
    volume.SetInputData(_in_daylight(data, sun) if extent.globe and isinstance(data, vtkStructuredGrid) else data)
    set_properties(volume, look)
    return volume


def _in_daylight(grid: vtkStructuredGrid, sun: Any) -> vtkStructuredGrid:
    """The grid with the light that cloud surfaces have there: bright by day, dim by night."""
    look = vtkCloudSurface()
    wrap, where = look.GetWrap(), points(grid)
    cosine = where @ sun / np.linalg.norm(where, axis=-1)
    direct = np.maximum(0, (cosine + wrap) / (1 + wrap))[..., None] * look.GetSunColor()
    light = (1 - _AMBIENT) * direct + _AMBIENT * np.array(look.GetSkyColor())
    lit = vtkStructuredGrid()
    lit.ShallowCopy(grid)
    lit.GetPointData().AddArray(vtk_array(light.astype(np.float32), "SourceColor", 3))
    return lit


def _surface(data: vtkPolyData, extent: Extent, style: str, sun: Any, look: Mapping[str, Any]) -> vtkCloudSurface:
    surface = vtkCloudSurface()
    surface.SetInputData(data)
    _light(surface, sun)
    if style == "texture":
        metre = 1 if extent.globe or extent.geometry == "Local" else extent.scale
        moves = data.GetPointData().GetArray("TextureCoordinates") is not None
        step = extent.step or data.GetLength() / 40
        surface.SetOpacityModeToTexture()
        surface.SetTextureWavelength(extent.radius / 4 if extent.whole else 4 * step)
        set_properties(surface, {"texture_octaves": 7, "texture_offset": 0.6, "texture_threshold": 0.15,
                                 "texture_rim_threshold": 0.2 if extent.globe else 0.15, "texture_range": 0.35})
        if "texture_wavelength" in look and not moves:
            look = {**look, "texture_wavelength": look["texture_wavelength"] * metre}
    set_properties(surface, look)
    return surface
