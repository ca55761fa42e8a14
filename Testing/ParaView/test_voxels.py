# SPDX-License-Identifier: BSD-3-Clause
"""Clouds leave ParaView as OpenVDB volumes and come back as images."""
import math
import pathlib

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import plugin

FILE = str(plugin.FOLDER / "voxels.vdb")


def write(name=FILE, **options):
    pathlib.Path(name).unlink(missing_ok=True)
    source = simple.CloudNetCDFReader(FileName=plugin.CLIMATE, Geometry="Globe", VerticalExaggeration=20)
    simple.SaveData(name, proxy=source, **options)


def read(**options):
    source = simple.OpenDataFile(FILE)
    for key, value in options.items():
        setattr(source, key, value)
    source.UpdatePipeline()
    return source


def image_of(source):
    return source.GetClientSideObject().GetOutputDataObject(0)


class Voxels(plugin.PluginTest):
    def test_mass_and_metadata_come_back(self):
        write(VoxelSize=[2e5, 2.5e5, 3e5], Source="sample", Time="2001-10-01")
        source = read()
        self.assertEqual(source.SMProxy.GetXMLName(), "CloudVDBReader")
        image = image_of(source)
        for given, edge in zip(image.GetSpacing(), (2e5, 2.5e5, 3e5)):
            self.assertAlmostEqual(given, edge, delta=1)
        values = vtk_to_numpy(image.GetPointData().GetArray("density"))
        fields = image.GetFieldData()
        mass = fields.GetArray("mass").GetValue(0)
        self.assertGreater(mass, 0)
        self.assertAlmostEqual(values.sum(dtype=float) * math.prod(image.GetSpacing()) / mass, 1, delta=1e-3)
        self.assertEqual(fields.GetAbstractArray("Source").GetValue(0), "sample")
        self.assertEqual(fields.GetAbstractArray("Geometry").GetValue(0), "Globe")
        radius = 6371e3 * 1.2
        self.assertTrue(all(abs(bound) < radius for bound in image.GetBounds()))

    def test_grids_can_be_chosen(self):
        write(VoxelSize=[3e5, 3e5, 3e5], GridNames=["ice", "wind"], Half=1)
        self.assertEqual(image_of(read()).GetPointData().GetArray(0).GetName(), "ice")
        self.assertEqual(image_of(read(Grid="wind")).GetPointData().GetArray("wind").GetNumberOfComponents(), 3)
        read(Grid="density")
        self.assertIn("has no grid 'density'; it has 'ice'", self.window.GetOutput())
        self.listen()

    def test_a_picture_draws_bricks_round_their_globe(self):
        write(VoxelSize=[1.5e5, 1.5e5, 1.5e5], GridNames=["density"])
        picture = simple.CloudPicture(Input=read(OutputForm="Bricks"), Size=[120, 90], Position=[1, 0.2, 0.4])
        picture.Voxels.TowardSun = [1, 0, 0.5]
        picture.UpdatePipeline()
        drawn = image_of(picture).GetPointData()
        transmittance = vtk_to_numpy(drawn.GetArray("Transmittance"))[:, 0].reshape(90, 120)
        radiance = vtk_to_numpy(drawn.GetArray("Radiance"))[:, 1].reshape(90, 120)
        self.assertTrue((transmittance[25:65, 40:80] == 0).all())  # the globe, clouds or none
        self.assertTrue((transmittance[:, :8] == 1).all())
        self.assertGreater(radiance.max(), 0.2)
        picture.Voxels.ExtinctionScale = 0
        picture.UpdatePipeline()
        self.assertGreater(radiance.max(), 1.5 * vtk_to_numpy(image_of(picture).GetPointData().GetArray("Radiance")).max())

    def test_a_file_for_each_time(self):
        folder = plugin.FOLDER / "voxel-times"
        folder.mkdir(exist_ok=True)
        for old in folder.iterdir():
            old.unlink()
        write(str(folder / "clouds.vdb"), VoxelSize=[5e5, 5e5, 5e5], GridNames=["density"], Writetimestepsasfileseries=1)
        self.assertEqual(sorted(file.name for file in folder.iterdir()), [f"clouds_{n}.vdb" for n in range(4)])


if __name__ == "__main__":
    plugin.main()
