# SPDX-License-Identifier: BSD-3-Clause
"""Between VTK data sets and numpy arrays: the same memory, wherever VTK can share it."""
from __future__ import annotations

from typing import Any, cast

import numpy as np
import numpy.typing as npt
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPointSet, vtkPolyData

Array = npt.NDArray[Any]


def values_of(data: Any) -> Array:
    """The numbers of an array or of what has .values, as VTK can read them: native, contiguous, real. Copied only if they
    are not so already; what is masked becomes NaN."""
    values: Any = getattr(data, "values", data)
    if isinstance(values, np.ma.MaskedArray):
        kind = values.dtype if values.dtype.kind == "f" else np.dtype(np.float32)
        values = values.astype(kind).filled(np.nan)  # type: ignore
    values = np.asarray(values)
    if values.dtype.kind not in "fiub":
        raise TypeError(f"an array of {values.dtype} is not one of real numbers; convert it with astype(float)")
    kind = {("f", 2): np.dtype(np.float32), ("f", 16): np.dtype(np.float64), ("b", 1): np.dtype(np.uint8)}.get(
        (values.dtype.kind, values.dtype.itemsize), values.dtype.newbyteorder("="))
    return np.require(values, kind, ["C_CONTIGUOUS", "ALIGNED"])


def vtk_array(values: Array, name: str, components: int = 1) -> vtkDataArray:
    """A vtkDataArray in the memory of contiguous values, which it keeps alive."""
    array = numpy_to_vtk(values.reshape((-1, components) if components > 1 else -1), deep=False)
    array.SetName(name)
    return array


def _shape_of(data: vtkDataSet) -> tuple[int, ...]:
    """(k, j, i) of a structured data set, else (n,)."""
    if hasattr(data, "GetExtent"):
        i, j, k = (int(n) for n in np.diff(data.GetExtent())[::2] + 1)
        return k, j, i
    return (data.GetNumberOfPoints(),)


def _view(array: vtkDataArray, shape: tuple[int, ...]) -> Array:
    components = array.GetNumberOfComponents()
    return cast(Array, vtk_to_numpy(array).reshape(shape + ((components,) if components > 1 else ())))


def arrays(data: vtkDataSet) -> dict[str, Array]:
    """The point arrays of a VTK data set as numpy arrays, by name, in VTK's own memory: nothing is copied.

    Parameters
    ----------
    data
        Any ``vtkDataSet``, as ``open``, ``contour`` and the others return it, or a PyVista one.

    Returns
    -------
    dict
        Name to array. Of a grid, its shape is (levels, rows, columns) = (k, j, i), with a last axis of 3 for vectors; of
        a surface (points,) or (points, 3). Writing into an array changes the data; say ``data.Modified()`` then, and
        ``data.GetPointData().GetArray(name).Modified()``, as everywhere in VTK. An array stays valid after the data are gone.

    Examples
    --------
    >>> clouds = nephoscope.open("climate.nc")
    >>> nephoscope.arrays(clouds)["CloudFraction"].max(axis=0)
    """
    if not isinstance(data, vtkDataSet):
        raise TypeError(f"a {type(data).__name__} is no vtkDataSet and has no point arrays")
    shape, attributes = _shape_of(data), data.GetPointData()
    found = (attributes.GetArray(n) for n in range(attributes.GetNumberOfArrays()))
    return {a.GetName(): _view(a, shape) for a in found if a and a.GetName()}


def points(data: vtkPointSet) -> Array:
    """Where the points are: (k, j, i, 3) of a grid, (points, 3) of a surface; scene units; not a copy.

    Raises
    ------
    TypeError
        A ``vtkImageData`` or ``vtkRectilinearGrid`` has no array of points.
    """
    if not isinstance(data, vtkPointSet):
        raise TypeError(f"a {data.GetClassName()} has no array of points; its origin, spacing or coordinates say where they are")
    if not data.GetPoints():
        return np.empty((0, 3))
    return _view(data.GetPoints().GetData(), _shape_of(data))


def triangles(surface: vtkPolyData) -> Array:
    """The triangles of a surface: (triangles, 3) indices into its points, counter-clockwise from outside; not a copy.

    Raises
    ------
    ValueError
        Some polygons are not triangles.
    """
    cells = surface.GetPolys()
    if cells.GetNumberOfCells() and cells.IsHomogeneous() != 3:
        raise ValueError("the surface has polygons that are not triangles; pass it through vtkTriangleFilter first")
    return cast(Array, vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, 3))
