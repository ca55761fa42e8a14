# SPDX-License-Identifier: BSD-3-Clause
"""The representation Cloud Volume in a render view."""
import unittest

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import plugin

SIZE = (240, 200)


def picture(view):
    simple.Render(view)
    capture = view.CaptureWindow(1) if hasattr(view, "CaptureWindow") else view.SMProxy.CaptureWindow(1)
    return vtk_to_numpy(capture.GetPointData().GetScalars()).astype(float)[:, :3].reshape(SIZE[1], SIZE[0], 3)


def show(representation, sphere, remote_threshold=20):
    """Clouds round a globe, thinned out as ParaView's own volumes are slow; a dark sphere in their middle or not."""
    for view in simple.GetRenderViews():
        simple.Delete(view)
    reader = simple.CloudNetCDFReader(FileName=plugin.CLIMATE, VerticalExaggeration=20)
    thinned = simple.ExtractSubset(Input=reader, SampleRateI=4, SampleRateJ=3, SampleRateK=2)
    thinned.VOI = [0, 128, 0, 65, 0, 18]
    view = simple.CreateView("RenderView", ViewSize=SIZE, OrientationAxesVisibility=0, UseColorPaletteForBackground=0,
                             Background=[0, 0, 0],
                             RemoteRenderThreshold=remote_threshold)
    display = simple.Show(thinned, view)
    simple.ColorBy(display, ("POINTS", "CloudFraction"))
    display.Representation = representation
    display.ScalarOpacityUnitDistance = 4e5
    display.SetScalarBarVisibility(view, False)
    if sphere:
        ball = simple.Show(simple.Sphere(Radius=6.3e6, ThetaResolution=32, PhiResolution=32), view)
        ball.AmbientColor = ball.DiffuseColor = [0.1, 0.1, 0.3]
    simple.Render(view)  # the first sets a camera of its own
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [2.6e7, 5e6, 1e7], [0, 0, 0], [0, 0, 1]
    return picture(view)


class CloudVolume(plugin.PluginTest):
    def test_looks_like_paraview_s_own_volume(self):
        for sphere in (False, True):
            with self.subTest(sphere=sphere):
                ours, theirs = show("Cloud Volume", sphere), show("Volume", sphere)
                self.assertGreater(ours.max(), 100)
                self.assertLess(numpy.abs(ours - theirs).mean(), 2)  # of 255; it rounds in each of its tetrahedra

    def test_opaque_things_hide_what_is_behind_them(self):
        free, hidden = show("Cloud Volume", False), show("Cloud Volume", True)
        middle = (slice(SIZE[1] // 3, -SIZE[1] // 3), slice(SIZE[0] // 3, -SIZE[0] // 3))
        self.assertGreater(numpy.abs(free[middle] - hidden[middle]).mean(), 5)


if __name__ == "__main__":
    plugin.main()
