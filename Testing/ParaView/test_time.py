# SPDX-License-Identifier: BSD-3-Clause
"""ParaView sees the file's times, and the filters give any time between them."""
import unittest

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import plugin


def field(source, name="CloudFraction"):
    return vtk_to_numpy(simple.servermanager.Fetch(source).GetPointData().GetArray(name)).copy()


class Time(plugin.PluginTest):
    def setUp(self):
        super().setUp()
        self.reader = simple.CloudNetCDFReader(FileName=plugin.CLIMATE)
        self.reader.UpdatePipelineInformation()
        self.times = list(self.reader.TimestepValues)

    def at(self, source, time):
        source.UpdatePipeline(time)
        return field(source)

    def test_the_animation_has_the_file_s_times(self):
        self.assertEqual(len(self.times), 4)
        self.assertEqual(list(simple.GetTimeKeeper().TimestepValues), self.times)

    def test_each_time_shows_its_own_clouds(self):
        steps = [self.at(self.reader, time) for time in self.times]
        for earlier, later in zip(steps, steps[1:]):
            self.assertFalse(numpy.array_equal(earlier, later))
        self.assertTrue(numpy.array_equal(steps[0], self.at(self.reader, self.times[0])))

    def test_between_times_clouds_are_carried(self):
        between = simple.CloudTimeInterpolator(Input=self.reader)
        between.UpdatePipelineInformation()
        self.assertEqual(list(between.TimestepValues), self.times)
        first = self.at(self.reader, self.times[0])
        self.assertTrue(numpy.array_equal(self.at(between, self.times[0]), first))
        middle = self.at(between, 0.5 * (self.times[0] + self.times[1]))
        self.assertFalse(numpy.array_equal(middle, first))
        self.assertLessEqual(middle.max(), 1)

    def test_texture_moves_with_the_wind(self):
        moved = simple.CloudTextureAdvection(Input=self.reader, CrossFade=0)
        start = self.at(moved, self.times[0]) is not None and field(moved, "TextureCoordinates")
        self.at(moved, self.times[1])
        way = numpy.linalg.norm(field(moved, "TextureCoordinates") - start, axis=1)
        step = self.times[1] - self.times[0]
        self.assertGreater(numpy.median(way) / step, 0.5)  # m/s
        self.assertLess(numpy.median(way) / step, 100)


if __name__ == "__main__":
    plugin.main()
