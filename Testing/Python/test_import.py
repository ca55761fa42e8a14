#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every VTK class of the modules is in the package nephoscope and says what it is: test_import.py ROOT rejected=MODULES."""
import pathlib
import re
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


class Package(unittest.TestCase):
    def test_every_declared_class_is_there(self):
        self.assertEqual([name for name in declared() if not hasattr(nephoscope, name)], [])

    def test_every_class_is_listed(self):
        self.assertEqual(sorted(declared()), nephoscope.__all__)

    def test_instances_print_and_know_their_class(self):
        for name in nephoscope.__all__:
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
