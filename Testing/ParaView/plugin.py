# SPDX-License-Identifier: BSD-3-Clause
"""For scripts of pvbatch: loads the plugin, knows the folders, listens to VTK's errors. Arguments: PLUGIN ROOT FOLDER."""
import os
import pathlib
import sys
import unittest

import nephoscope  # noqa: F401 - gives proxies' objects their own methods in Python
from paraview import simple
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

PLUGIN, ROOT, FOLDER = (pathlib.Path(argument) for argument in sys.argv[1:4])
CLIMATE = str(ROOT / "Data" / "sample_climate.nc")
CLOUDS = str(ROOT / "Data" / "sample_clouds.nc")
SHARED = ROOT / ".." / "shared" / "data"

simple.LoadPlugin(str(PLUGIN), remote=False, ns=vars(simple))


class PluginTest(unittest.TestCase):
    """A fresh session for each test; an error of VTK is a failure."""

    def setUp(self):
        simple.ResetSession()
        self.listen()

    def listen(self):
        """From here on; what was said before is forgotten."""
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)

    def tearDown(self):
        self.assertNotIn("ERROR", self.window.GetOutput())


def number_of(data, what):
    return getattr(data.GetDataInformation(), "GetNumberOf" + what)()


def main(before_exit=lambda: None):
    # pvbatch sends Python's streams to VTK's output window, which the tests listen to.
    with open(2, "w", closefd=False) as stream:
        program = unittest.main(argv=sys.argv[:1], exit=False, testRunner=unittest.TextTestRunner(stream))
    before_exit()
    os._exit(0 if program.result.wasSuccessful() else 1)  # without the time that ParaView takes to leave
