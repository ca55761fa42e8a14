# SPDX-License-Identifier: BSD-3-Clause
"""Constants of approximations, fitted to exact integrals."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkAbstractArray, vtkDataArray

from ._errors import raising


def fit(subject: str, range: tuple[float, float] | None = None) -> dict[str, Any]:  # noqa: A002
    """Fits the constants of an approximation to its exact integrals, with standard errors and held-out errors.

    Parameters
    ----------
    subject
        What to fit: ``"transmittance"``, ``"phase"``, ``"slab"``, ``"heightfield"`` ... An unknown one is answered with all.
    range
        Range of the subject's variable, 0 <= from < to. Default: the subject's own.

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
        No such subject, a range that is empty, negative or not finite, no solution.

    Examples
    --------
    >>> table = nephoscope.fit("transmittance", (0, 2))
    >>> for name, value, error in zip(table["Parameter"], table["Value"], table["StandardError"]): ...
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
    with raising(filter_):
        filter_.Update()
    table = filter_.GetOutput()
    return {column.GetName(): _values(column) for column in _all(table.GetNumberOfColumns(), table.GetColumn)}


def _all(count: int, get: Callable[[int], Any]) -> list[Any]:
    return [get(n) for n in range(count)]


def _values(column: vtkAbstractArray) -> Any:
    if not isinstance(column, vtkDataArray):
        return _all(column.GetNumberOfValues(), column.GetValue)
    values = vtk_to_numpy(column)
    return list(values) if values.ndim > 1 else values
