#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What PyVista, ParaView's Python and plain VTK need of the package's data: test_pyvista.py ROOT.

PyVista is not among Debian's packages. pyvista.wrap chooses a subclass of the VTK class by GetClassName() and copies
shallowly into it; where PyVista is installed it is tried itself.
"""
import pathlib
import sys
import unittest

import numpy as np

import nephoscope
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkContourFilter

try:
    import pyvista
except ImportError:
    pyvista = None

SAMPLE = str(pathlib.Path(sys.argv.pop()) / "Data/sample_climate.nc")
BASES = {"vtkStructuredGrid": vtkStructuredGrid, "vtkPolyData": vtkPolyData, "vtkImageData": vtkImageData}


def subclass_of(name):
    """As PyVista's StructuredGrid, PolyData and UniformGrid are."""
    return type("Wrapped" + name, (BASES[name],), {})


def wrapped(data):
    if pyvista:
        return pyvista.wrap(data)
    copy = subclass_of(data.GetClassName())()
    copy.ShallowCopy(data)
    return copy


def data_of_functions():
    grid = nephoscope.open(SAMPLE, geometry="globe", exaggeration=10)
    yield "open", grid
    yield "contour", nephoscope.contour(grid, 0.15)
    yield "advect", nephoscope.advect(SAMPLE, 1, geometry="globe")
    yield "grid", nephoscope.grid(np.zeros((3, 4, 5)))
    yield "render", nephoscope.render(grid, size=(8, 6)).image


class Wrapping(unittest.TestCase):
    def test_outputs_are_vtks_own_classes(self):
        for name, data in data_of_functions():
            with self.subTest(name):
                self.assertIs(type(data), BASES[data.GetClassName()])

    def test_wrapping_shares_every_array(self):
        for name, data in data_of_functions():
            copy = wrapped(data)
            for array, view in nephoscope.arrays(data).items():
                with self.subTest(f"{name} {array}"):
                    again = nephoscope.arrays(copy)[array]
                    self.assertEqual(again.__array_interface__["data"], view.__array_interface__["data"])

    def test_functions_take_what_is_wrapped(self):
        plain = nephoscope.open(SAMPLE, geometry="globe", exaggeration=10)
        grid = wrapped(plain)
        surface = wrapped(nephoscope.contour(grid, 0.15))
        self.assertEqual(surface.GetNumberOfPolys(), nephoscope.contour(plain, 0.15).GetNumberOfPolys())
        pictures = [nephoscope.render(data, smoothing=0, size=(40, 30)).radiance if data is plain else
                    nephoscope.render(data, size=(40, 30)).radiance for data in (plain, surface)]
        self.assertEqual(*(p.shape for p in pictures))

    def test_vtk_filters_take_the_data(self):
        """VTK's own contour of the same smooth ball has the same area, to the order of the steps squared."""
        z, y, x = (np.linspace(-1, 1, n) for n in (41, 45, 51))
        ball = np.exp(-z[:, None, None] ** 2 - y[:, None] ** 2 - x**2)
        grid = nephoscope.grid(ball, x=x, y=y, height=z)
        other = vtkContourFilter()
        other.SetInputData(grid)
        other.SetValue(0, 0.6)
        other.Update()
        areas = []
        for surface in (other.GetOutput(), nephoscope.contour(grid, 0.6)):
            corners = nephoscope.points(surface)[nephoscope.triangles(surface)]
            areas.append(np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum())
        self.assertAlmostEqual(areas[0] / areas[1], 1, delta=0.005)


if __name__ == "__main__":
    unittest.main()
