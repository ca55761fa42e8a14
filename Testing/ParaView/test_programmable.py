# SPDX-License-Identifier: BSD-3-Clause
"""The documentation's scripts: the one from file to picture, and the Programmable Filter that uses the package nephoscope."""
import os
import re
import unittest

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import plugin


def documented(start):
    text = (plugin.ROOT / "Utilities" / "Doc" / "paraview.md").read_text()
    return re.search(rf"```python\n({start}.*?)```", text, re.DOTALL).group(1)


class Documented(plugin.PluginTest):
    def test_from_file_to_picture(self):
        script = re.sub(r"LoadPlugin\(.*\)\n", "", documented("from paraview"))  # it is loaded already
        os.chdir(plugin.FOLDER)
        (plugin.FOLDER / "clouds.png").unlink(missing_ok=True)
        exec(compile(script.replace("Data/", str(plugin.ROOT / "Data") + "/"), "paraview.md", "exec"), {})
        self.assertGreater((plugin.FOLDER / "clouds.png").stat().st_size, 20000)

    def test_programmable_filter(self):
        reader = simple.CloudNetCDFReader(FileName=plugin.CLOUDS)
        filter_ = simple.ProgrammableFilter(Input=reader, Script=documented("# Programmable Filter"))
        filter_.UpdatePipeline()
        data = simple.servermanager.Fetch(filter_).GetPointData()
        torn = vtk_to_numpy(data.GetArray("TornFraction"))
        texture = simple.CloudTexture(Input=reader, Wavelengthm=3e6)
        opacity = vtk_to_numpy(simple.servermanager.Fetch(texture).GetPointData().GetArray("Opacity"))
        fraction = vtk_to_numpy(simple.servermanager.Fetch(reader).GetPointData().GetArray("CloudFraction"))
        numpy.testing.assert_array_equal(torn, fraction * opacity)
        self.assertGreater(numpy.abs(torn - fraction).max(), 0.1)


if __name__ == "__main__":
    plugin.main()
