# SPDX-License-Identifier: BSD-3-Clause
"""Any number of processes of pvbatch --symmetric make the same triangles and the same picture as one, which writes them for the
others to compare with. Arguments: PLUGIN ROOT FOLDER, as for the other tests."""
import pathlib
import subprocess
import unittest

import numpy
from mpi4py import MPI
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import plugin

COMM = MPI.COMM_WORLD
ALONE = COMM.size == 1

SMALL_FILE = """
import netCDF4, sys
with netCDF4.Dataset(sys.argv[1], "w") as file:
    for name, values, units in (("lev", (900, 500, 100), "hPa"), ("lat", (10, 11), "degrees_north"), ("lon", (0, 1), "degrees_east")):
        file.createDimension(name, len(values))
        file.createVariable(name, "f8", (name,))[:] = values
        file[name].units = units
    file["lev"].standard_name = "air_pressure"
    file.createVariable("cl", "f4", ("lev", "lat", "lon"))[:] = [[[0.1, 0.9], [0.2, 0.4]], [[0.6, 0], [0, 0.7]], [[0, 0.2], [0.9, 1]]]
    file["cl"].units = "1"
"""


def triangles(contour):
    """Corners of all processes' triangles, each from its least corner on, in order; in process 0."""
    data = contour.GetClientSideObject().GetOutput()
    mine = numpy.empty((0, 3, 3))
    if data.GetNumberOfCells() > 0:
        corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        mine = vtk_to_numpy(data.GetPoints().GetData())[corners].astype(float)
    every = COMM.gather(mine)
    if COMM.rank > 0:
        return None
    every = numpy.concatenate(every)
    least = numpy.lexsort((every[..., 2], every[..., 1], every[..., 0]), axis=-1)[:, 0]
    turned = (least[:, None] + numpy.arange(3)) % 3
    rows = numpy.take_along_axis(every, turned[:, :, None], axis=1).reshape(-1, 9)
    return rows[numpy.lexsort(rows.T[::-1])]


class Ranks(plugin.PluginTest):
    def check(self, name, results, tolerance):
        """The same as one process has left."""
        if COMM.rank > 0:
            return
        path = pathlib.Path(plugin.FOLDER, name + ".npz")
        if ALONE:
            numpy.savez(path, **results)
        for key, expected in numpy.load(path).items():
            with self.subTest(name, result=key):
                self.assertEqual(results[key].shape, expected.shape)
                numpy.testing.assert_allclose(results[key], expected, rtol=tolerance, atol=tolerance)

    def check_picture(self, name, picture):
        image = picture.GetClientSideObject().GetOutput()
        if COMM.rank > 0:
            self.assertEqual(image.GetNumberOfPoints(), 0)
            return
        names = ("Radiance", "Transmittance", "Depth")
        self.check(name + "-picture", {key: vtk_to_numpy(image.GetPointData().GetArray(key)) for key in names}, 1e-6)
        self.assertGreater(vtk_to_numpy(image.GetPointData().GetArray("Radiance")).std(), 0.01)

    def draw(self, reader, value):
        contour = simple.CloudContour(Input=reader, Values=[value])
        picture = simple.CloudPicture(Input=reader, OtherInput=contour, Size=[160, 120])
        picture.Surface.OpacityMode = "Texture"
        picture.UpdatePipeline()
        return contour, picture

    def compare(self, name, reader, value):
        contour, picture = self.draw(reader, value)
        self.check(name + "-triangles", {"corners": triangles(contour)}, 0)
        self.check_picture(name, picture)

    def test_a_globe(self):
        reader = simple.CloudNetCDFReader(FileName=plugin.CLIMATE, VerticalExaggeration=20)
        self.compare("globe", reader, 0.3)

    def test_voxels(self):
        file = str(pathlib.Path(plugin.FOLDER, "ranks.vdb"))
        if ALONE:
            simple.SaveData(file, proxy=simple.CloudNetCDFReader(FileName=plugin.CLIMATE, VerticalExaggeration=20), VoxelSize=[2e5] * 3)
        contour = simple.CloudContour(Input=simple.CloudNetCDFReader(FileName=plugin.CLIMATE, VerticalExaggeration=20), Values=[0.3])
        picture = simple.CloudPicture(Input=simple.CloudVDBReader(FileName=file, OutputForm="Bricks"), OtherInput=contour, Size=[160, 120])
        picture.Surface.Opacity = 0.5
        picture.UpdatePipeline()
        self.check_picture("voxels", picture)

    def test_a_file_that_cannot_be_read_is_an_error_in_each_process(self):
        file = pathlib.Path(plugin.FOLDER, f"broken{COMM.rank}.nc")
        file.write_text("no NetCDF")
        picture = simple.CloudPicture(Input=simple.CloudNetCDFReader(FileName=str(file)), Size=[16, 12])
        picture.UpdatePipeline()
        self.assertIn("cannot be opened as NetCDF", self.window.GetOutput())
        self.listen()

    def test_texture_that_moves(self):
        reader = simple.CloudNetCDFReader(FileName=plugin.CLIMATE)
        reader.UpdatePipelineInformation()
        moved = simple.CloudTextureAdvection(Input=reader)
        contour = simple.CloudContour(Input=moved, Values=[0.4])
        contour.UpdatePipeline(0.5 * (reader.TimestepValues[1] + reader.TimestepValues[2]))
        self.check("moved-triangles", {"corners": triangles(contour)}, 0)

    def test_fewer_cells_than_processes(self):
        file = str(pathlib.Path(plugin.FOLDER, "one-cell.nc"))
        if ALONE:
            subprocess.run(["/usr/bin/python3", "-c", SMALL_FILE, file], check=True)
        self.compare("cell", simple.CloudNetCDFReader(FileName=file, Geometry="Map", VerticalExaggeration=5), 0.5)


if __name__ == "__main__":
    plugin.main(before_exit=MPI.Finalize)
