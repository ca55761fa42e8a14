#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every VTK class of the modules is in the package nephoscope and says what it is: test_import.py ROOT rejected=MODULES."""
import pathlib
import re
import subprocess
import sys
import unittest

import nephoscope
from vtkmodules.vtkCommonCore import vtkObjectBase

REJECTED = sys.argv.pop().partition("=")[2].replace("Nephoscope::Cloud", "").split(",")
ROOT = pathlib.Path(sys.argv.pop())
CLASS = re.compile(r"^class\s+VTKCLOUD\w+_EXPORT\s+(?:VTK_MARSHAL\w+\s+)?(vtkCloud\w+)\s*(?:final\s*)?:", re.MULTILINE)


def declared():
    """The classes that the modules' public headers declare."""
    headers = sorted(path for path in (ROOT / "Modules").glob("*/vtkCloud*.h") if path.parent.name not in REJECTED)
    return [name for header in headers for name in CLASS.findall(header.read_text())]


def classes():
    return [name for name in nephoscope.__all__ if name.startswith("vtkCloud")]


def python(code):
    """What a fresh interpreter prints."""
    return subprocess.run([sys.executable, "-B", "-c", code], check=True, capture_output=True, text=True).stdout


class Beside(unittest.TestCase):
    """The package and VTK's own, in a process of their own."""

    def test_either_order_of_imports(self):
        use = "r = nephoscope.vtkCloudNetCDFReader(); c = nephoscope.vtkCloudContour(); s = vtkSphereSource(); s.Update(); " \
              "c.SetInputConnection(r.GetOutputPort()); print(type(c.GetOutput()).__name__, isinstance(c, vtkAlgorithm))"
        parts = "from vtkmodules.vtkFiltersSources import vtkSphereSource; " \
                "from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm"
        for vtk in (parts, "from vtk import vtkSphereSource, vtkAlgorithm"):
            for imports in (f"import nephoscope; {vtk}", f"{vtk}; import nephoscope"):
                with self.subTest(imports):
                    self.assertEqual(python(f"{imports}; {use}"), "vtkPolyData True\n")

    def test_what_is_not_asked_for_is_not_loaded(self):
        loaded = python("import sys, nephoscope; print(*sys.modules)").split()
        self.assertNotIn("numpy", loaded)
        self.assertNotIn("vtkmodules.vtkRenderingOpenGL2", loaded)
        loaded = python("import sys, nephoscope; nephoscope.render; nephoscope.grid; nephoscope.fit; print(*sys.modules)").split()
        self.assertIn("numpy", loaded)
        self.assertNotIn("xarray", loaded)


class Package(unittest.TestCase):
    def test_every_declared_class_is_there(self):
        self.assertEqual([name for name in declared() if not hasattr(nephoscope, name)], [])

    def test_every_class_is_listed(self):
        self.assertEqual(sorted(declared()), classes())

    def test_every_function_is_there_and_explained(self):
        self.assertNotIn("open", nephoscope.__all__)  # import * leaves Python's own
        for name in {*nephoscope.__all__, "open"} - set(classes()):
            self.assertTrue(getattr(nephoscope, name).__doc__, name)
            self.assertIn(name, dir(nephoscope))
        with self.assertRaisesRegex(AttributeError, "no attribute 'rendr'"):
            nephoscope.rendr  # noqa: B018

    def test_instances_print_and_know_their_class(self):
        for name in classes():
            kind = getattr(nephoscope, name)
            with self.subTest(name):
                self.assertTrue(issubclass(kind, vtkObjectBase))
                try:
                    instance = kind()
                except (NotImplementedError, TypeError):  # abstract: VTK's wrapper refuses
                    continue
                self.assertTrue(instance.IsA(name))
                self.assertIn(name, str(instance))


if __name__ == "__main__":
    unittest.main()
