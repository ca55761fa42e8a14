# SPDX-License-Identifier: BSD-3-Clause
"""Data to data: contours, and what moves with the wind."""
from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSet, vtkPolyData, vtkStructuredGrid

from ._errors import raising
from ._files import choice, detached, reader_of, seconds_of
from ._grids import dataset_of
from .vtkCloudFilters import vtkCloudContour, vtkCloudSmooth, vtkCloudTextureAdvection, vtkCloudTimeInterpolator


def contour(clouds: Any, value: float | Iterable[float] = 0.15, *, field: str = "CloudFraction", smoothing: float = 0.0,
            normals: bool = True) -> vtkPolyData:
    """The surfaces on which a field has a value, watertight, by tetrahedra in the grid's own cells (Max 1994).

    Parameters
    ----------
    clouds
        A grid of ``open`` or ``grid``, any structured VTK or PyVista data set or one of tetrahedra, or arrays as ``grid`` takes
        them: a numpy array (k, j, i) lies on unit steps.
    value
        One value or several, in the field's unit. Default 0.15.
    field
        The point array. Default CloudFraction.
    smoothing
        Standard deviation of the filter along the layers before contouring, scene units (m), >= 0. Default 0: none. One or two
        grid steps give rounder clouds.
    normals
        Whether to give normals, out of the cloud. Default.

    Returns
    -------
    vtkPolyData
        Triangles, counter-clockwise seen from outside, with all point arrays interpolated. ``points`` and ``triangles`` give
        them as numpy arrays without a copy.

    Raises
    ------
    CloudError
        No such array, several components, a value that is not finite, cells that are no hexahedra or tetrahedra.
    ValueError
        Arrays that are no grid; a smoothing below 0.

    Examples
    --------
    >>> surface = nephoscope.contour(nephoscope.open("climate.nc"), 0.15)
    >>> surface = nephoscope.contour(density, [0.1, 0.5])      # a numpy array (k, j, i)
    """
    if not smoothing >= 0:
        raise ValueError(f"smoothing={smoothing} is not a length from 0 up")
    values = [float(v) for v in np.atleast_1d(np.asarray(value, float))]
    filter_ = vtkCloudContour()
    filter_.SetNumberOfContours(len(values))
    for n, v in enumerate(values):
        filter_.SetValue(n, v)
    filter_.SetComputeNormals(normals)
    filter_.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, field)
    with raising(filter_):
        filter_.SetInputData(_smoothed(dataset_of(clouds), field, smoothing))
        filter_.Update()
    return detached(filter_.GetOutput())


def _smoothed(data: vtkDataSet, field: str, length: float) -> vtkDataSet:
    if length == 0:
        return data
    smooth = vtkCloudSmooth()
    smooth.SetInputData(data)
    smooth.SetLength(length)
    smooth.AddSmoothedArray(field)
    smooth.Update()
    return smooth.GetOutput()


def _connect(filter_: Any, source: Any, time: Any, options: dict[str, Any]) -> float:
    """Connects a filter to a file or to grids of several times; the seconds of a time."""
    if isinstance(source, (str, os.PathLike)):
        reader = reader_of(source, **options)
        filter_.SetInputConnection(reader.GetOutputPort())
        return seconds_of(reader, time)
    if options:
        raise TypeError(f"{', '.join(options)}: only for files; these grids are as they are")
    from ._series import Series
    series = Series(source)
    filter_.SetInputConnection(series.GetOutputPort())
    return series.seconds(time)


def _at(filter_: Any, source: Any, time: Any, options: dict[str, Any]) -> vtkStructuredGrid:
    seconds = _connect(filter_, source, time, options)
    with raising(filter_):
        filter_.UpdateTimeStep(seconds)
    return detached(filter_.GetOutput())


def advect(source: str | os.PathLike[str] | Sequence[vtkStructuredGrid], time: Any, *, integrator: str = "rk2",
           interpolation: str = "linear", tolerance: float = 5000.0, cross_fade: bool = True, restart_period: float = 0.0,
           **options: Any) -> vtkStructuredGrid:
    """A grid with texture coordinates that the wind has carried there: cloud textures drift with their clouds
    (Max and Crawfis 1992, semi-Lagrangian).

    Parameters
    ----------
    source
        A file, or grids of several times in rising order, as ``open`` or ``grid(..., time=...)`` gives them, with Wind and
        Height.
    time
        Any time within the source's: a step by index (``int``), seconds (``float``) or a date, as in ``open``; of grids that
        were made with dates, seconds count from 1970.
    integrator
        ``"rk2"`` (default) or ``"rk4"``: order of the trajectories.
    interpolation
        ``"linear"`` (default) or ``"cubic"``: how wind and coordinates are read between points.
    tolerance
        Error that a trajectory may have over an interval, m, 0.001 to 1e7. Default 5000.
    cross_fade
        Whether textures are started again and cross-faded, before they are sheared too far. Default.
    restart_period
        Seconds from one start to the next. Default 0: from the wind's strain, an hour to ten days.
    **options
        For a file, those of ``open``: geometry, exaggeration, variables ...

    Returns
    -------
    vtkStructuredGrid
        The grid at the time, with the point arrays TextureCoordinates (3, m), OtherTextureCoordinates (3, m, with
        cross_fade) and TextureStretch (1 is none). ``render(..., style="texture")`` draws them.

    Raises
    ------
    ValueError
        No such time; grids without a time, or not in rising order.
    CloudError
        No Wind or Height, lines that do not run along meridians and parallels (or x and y), a grid that changes.

    Examples
    --------
    >>> clouds = nephoscope.advect("climate.nc", "2001-10-01T09:30", geometry="globe", exaggeration=10)
    >>> nephoscope.render(clouds, style="texture").save("half-past-nine.png")
    """
    filter_ = vtkCloudTextureAdvection()
    filter_.SetIntegrator(choice("integrator", integrator, ("rk2", "rk4")))
    filter_.SetInterpolation(choice("interpolation", interpolation, ("linear", "cubic")))
    filter_.SetTolerance(tolerance)
    filter_.SetCrossFade(cross_fade)
    filter_.SetRestartPeriod(restart_period)
    return _at(filter_, source, time, options)


def interpolate(source: str | os.PathLike[str] | Sequence[vtkStructuredGrid], time: Any, *, carry_clouds: bool = True,
                interpolation: str = "cubic", tolerance: float = 5000.0, **options: Any) -> vtkStructuredGrid:
    """Clouds between two times: carried along the wind from both, instead of one fading into the other.

    Parameters
    ----------
    source, time, tolerance, **options
        As of ``advect``.
    carry_clouds
        Whether clouds are carried by the wind; else they fade, and no Wind is needed. Default.
    interpolation
        ``"cubic"`` (default) or ``"linear"``, which blurs more: how clouds are read between points.

    Returns
    -------
    vtkStructuredGrid
        The grid at the time; at a time of the source it is the source's, to the bit.

    Raises
    ------
    ValueError, CloudError
        As ``advect``.
    """
    filter_ = vtkCloudTimeInterpolator()
    filter_.SetCarryClouds(carry_clouds)
    filter_.SetInterpolation(choice("interpolation", interpolation, ("linear", "cubic")))
    filter_.SetTolerance(tolerance)
    return _at(filter_, source, time, options)
