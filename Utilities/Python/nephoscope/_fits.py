# SPDX-License-Identifier: BSD-3-Clause
"""Constants of approximations, fitted to exact integrals."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkAbstractArray, vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkRectilinearGrid, vtkTable

from ._arrays import Array, values_of, vtk_array
from ._errors import raising


def fit(subject: str, range: tuple[float, float] | None = None, *, depths: Any = None,  # noqa: A002
        density: Any = None, at: Sequence[Any] | None = None, tolerance: float = 0.05, terms: int = 32) -> dict[str, Any]:
    """Fits the constants of an approximation to its exact integrals, with standard errors and held-out errors.

    Parameters
    ----------
    subject
        What to fit: ``"transmittance"``, ``"phase"``, ``"slab"``, ``"heightfield"``, ``"density"`` ... An unknown one is answered
        with all.
    range
        Range of the subject's variable, 0 <= from < to. Default: the subject's own.
    depths
        Of ``"transmittance"``: optical depths that occur, in place of the subject's own, or a ``Picture`` of clouds, whose rays are
        taken (green) that neither miss all cloud nor end at something opaque. Half of them are held out.
    density
        Of ``"density"``, which needs it: extinction, 1/m, of a column (levels,) or a volume (levels, rows, columns), as the fewest
        Gaussians whose line integrals meet the tolerance; or a ``vtkImageData`` or ``vtkRectilinearGrid`` with the array Extinction.
    at
        Where the density's points are, m, ascending: (heights,), or (heights, y, x). Not of VTK data, which know it.
    tolerance
        Of the density's line integrals, relative root mean square, above 0. Default 0.05.
    terms
        Gaussians at most, 1 to 100. Default 32.

    Returns
    -------
    dict
        A table, column by column, with a row for each parameter of each fit, ready for ``pandas.DataFrame``: Fit,
        Parameter (lists of str); Value, StandardError, Lower, Upper (bounds), Determined and more (numpy arrays);
        of the whole fit, repeated in its rows, TrainingRMS, HeldOutRMS, HeldOut95, HeldOutMax, Iterations, Warnings and so on;
        Covariance (a list of arrays: with the fit's parameters in their order).

    Raises
    ------
    RuntimeError
        Nephoscope was built without Ceres.
    CloudError
        A range that is empty, negative or not finite, a tolerance that is not met, numbers that make no sense, no solution.
    ValueError
        No such subject; arrays that it has no use for, or that do not fit each other.

    Examples
    --------
    >>> table = nephoscope.fit("transmittance", (0, 2))
    >>> for name, value, error in zip(table["Parameter"], table["Value"], table["StandardError"]): ...

    A column of ``clouds = nephoscope.open(...)``, 0.2 per km where it is overcast:

    >>> fields = nephoscope.arrays(clouds)
    >>> fraction, height = (fields[name][:, 40, 30] for name in ("CloudFraction", "Height"))
    >>> layers = nephoscope.fit("density", density=2e-4 * fraction, at=(height,), tolerance=0.01)

    What a picture of a volume has:

    >>> table = nephoscope.fit("transmittance", depths=nephoscope.render(clouds, "volume", ground=False))
    """
    try:
        from .vtkCloudFits import vtkCloudFit
    except ImportError as error:
        raise RuntimeError("this nephoscope was built without Ceres; install libceres-dev and build again") from error
    filter_ = vtkCloudFit()
    subjects = _all(vtkCloudFit.GetNumberOfSubjects(), vtkCloudFit.GetSubjectName)
    if subject not in subjects:
        raise ValueError(f"subject={subject!r} is none of {', '.join(map(repr, subjects))}")
    filter_.SetSubject(subject)
    if range is not None:
        filter_.SetRange(*range)
    source = _input_of(subject, depths, density, at)
    if source is not None:
        filter_.SetInputDataObject(source)
    filter_.SetTolerance(tolerance)
    filter_.SetTerms(terms)
    with raising(filter_):
        filter_.Update()
    table = filter_.GetOutput()
    return {column.GetName(): _values(column) for column in _all(table.GetNumberOfColumns(), table.GetColumn)}


def _input_of(subject: str, depths: Any, density: Any, at: Sequence[Any] | None) -> vtkDataObject | None:
    """What the subject is fitted to, as vtkCloudFit takes it."""
    for name, value, owner in (("depths", depths, "transmittance"), ("density", density, "density"), ("at", at, "density")):
        if value is not None and subject != owner:
            raise ValueError(f"{name} is for {owner!r} and not for {subject!r}")
    if subject == "density" and density is None:
        raise ValueError("'density' needs density=, an extinction in 1/m, and at=, where its points are")
    if depths is not None:
        table = vtkTable()
        table.AddColumn(vtk_array(_depths_of(depths), "depths"))
        return table
    if density is None or isinstance(density, vtkDataObject):
        return density
    return _grid_of(density, at)


def _depths_of(depths: Any) -> Array:
    through = getattr(depths, "transmittance", None)
    if through is None:
        return values_of(depths).astype(float).ravel()
    green = through[..., 1].astype(float)
    return np.asarray(-np.log(green[(green > 0) & (green < 1)]))


def _grid_of(density: Any, at: Sequence[Any] | None) -> vtkRectilinearGrid:
    """A column or a volume on its coordinates; along an axis that a column has not there is one point, at 0."""
    values = values_of(density).astype(float)
    axes = [values_of(axis).astype(float) for axis in at or ()]
    if values.ndim not in (1, 3) or values.shape != tuple(len(axis) for axis in axes if axis.ndim == 1):
        raise ValueError(f"density is {values.shape} and at has {tuple(axis.shape for axis in axes)}; give at=(heights,) for a "
                         "column, at=(heights, y, x) for a volume")
    axes += [np.zeros(1)] * (3 - len(axes))
    grid = vtkRectilinearGrid()
    grid.SetDimensions(*(len(axis) for axis in reversed(axes)))
    for set_, axis in zip((grid.SetZCoordinates, grid.SetYCoordinates, grid.SetXCoordinates), axes):
        set_(vtk_array(axis, "at"))
    grid.GetPointData().AddArray(vtk_array(values, "Extinction"))
    return grid


def _all(count: int, get: Callable[[int], Any]) -> list[Any]:
    return [get(n) for n in range(count)]


def _values(column: vtkAbstractArray) -> Any:
    if not isinstance(column, vtkDataArray):
        return _all(column.GetNumberOfValues(), column.GetValue)
    values = vtk_to_numpy(column)
    return list(values) if values.ndim > 1 else values
