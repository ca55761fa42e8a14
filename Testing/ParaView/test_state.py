# SPDX-License-Identifier: BSD-3-Clause
"""A state file restores the pipeline, and the trace of a session replays it."""
import unittest

from paraview import simple, smtrace

import plugin


def pipeline():
    """A pipeline with something other than the default in each part; its last filter."""
    reader = simple.CloudNetCDFReader(
        FileName=plugin.CLIMATE, Geometry="Globe", VerticalExaggeration=20, PointArrays=["CloudFraction", "Wind"])
    smooth = simple.CloudSmooth(Input=reader, Passes=3)
    contour = simple.CloudContour(Input=smooth, Values=[0.2, 0.4])
    return simple.CloudTexture(Input=contour, Seed=7, Octaves=5)


def figures(texture):
    texture.UpdatePipeline()
    information = texture.GetDataInformation()
    return (information.GetNumberOfPoints(), information.GetNumberOfCells(), information.GetBounds(),
            texture.PointData["Opacity"].GetRange(), sorted(texture.PointData.keys()))


def find(kind):
    return next(source for source in simple.GetSources().values() if source.SMProxy.GetXMLName() == kind)


class Saved(plugin.PluginTest):
    def test_a_state_file_restores_the_pipeline(self):
        for extension in ("pvsm", "py"):
            with self.subTest(extension):
                simple.ResetSession()
                before = figures(pipeline())
                file = str(plugin.FOLDER / f"state.{extension}")
                simple.SaveState(file)
                simple.ResetSession()
                self.assertEqual(len(simple.GetSources()), 0)
                simple.LoadState(file)
                self.assertEqual(figures(find("CloudTexture")), before)
                self.assertEqual(list(find("CloudContour").Values), [0.2, 0.4])
                self.assertEqual(find("CloudNetCDFReader").VerticalExaggeration, 20)

    def test_a_trace_replays_the_session(self):
        smtrace.start_trace()
        before = figures(pipeline())
        simple.Show(find("CloudTexture"))
        trace = smtrace.stop_trace()
        self.assertIn("CloudNetCDFReader(", trace)
        simple.ResetSession()
        exec(compile(trace, "trace", "exec"), {})
        self.assertEqual(figures(find("CloudTexture")), before)


if __name__ == "__main__":
    plugin.main()
