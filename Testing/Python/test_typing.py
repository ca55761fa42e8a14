#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The package says its types: stubs agree with the classes, and mypy with both: test_typing.py."""
import ast
import inspect
import pathlib
import subprocess
import sys
import tempfile
import unittest

import nephoscope

PACKAGE = pathlib.Path(nephoscope.__file__).parent

RIGHT = """
import typing
import numpy as np
import numpy.typing as npt
import nephoscope

picture = nephoscope.render(np.ones((3, 3, 3)), style="volume", size=(8, 6))
typing.assert_type(picture, nephoscope.Picture)
typing.assert_type(picture.radiance, npt.NDArray[np.float32])
typing.assert_type(nephoscope.vtkCloudCellVolume().GetColor(), tuple[float, ...])
nephoscope.vtkCloudCellVolume().SetColor(1, 0.5, 0)
nephoscope.vtkCloudCellVolume().SetColor((1, 0.5, 0))
"""
WRONG = {
    "nephoscope.render(1, size=3)": "incompatible type",
    "nephoscope.vtkCloudContour().SetValue('a', 'b')": "incompatible type",
    "nephoscope.rendr(1)": "has no attribute",
}
CONFIGURATION = "[mypy]\nstrict = True\nwarn_unused_ignores = False\ndisallow_subclassing_any = False\n" \
                "[mypy-vtkmodules.*]\nignore_missing_imports = True\n"


def has_mypy():
    return subprocess.run([sys.executable, "-c", "import mypy"], capture_output=True, check=False).returncode == 0


class Stubs(unittest.TestCase):
    def test_every_class_has_every_method_in_its_stub(self):
        self.assertTrue((PACKAGE / "py.typed").exists())
        stubbed = {}
        for path in PACKAGE.glob("vtkCloud*.pyi"):
            tree = ast.parse(path.read_text())
            stubbed.update({c.name: {m.name for m in c.body if isinstance(m, ast.FunctionDef)}
                            for c in tree.body if isinstance(c, ast.ClassDef)})
        names = {name for name in nephoscope.__all__ if name.startswith("vtkCloud")}
        self.assertEqual(names - set(stubbed), set())
        for name in names:
            methods = {key for key, value in vars(getattr(nephoscope, name)).items()
                       if not key.startswith("_") and callable(value) and not inspect.isclass(value)}
            self.assertEqual(methods - stubbed[name], set(), name)

    def test_no_signature_was_left_out(self):
        for path in PACKAGE.glob("vtkCloud*.pyi"):
            self.assertNotIn("*args", path.read_text(), path.name)

    def test_the_package_names_all_it_has(self):
        tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
        named = {alias.asname for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names}
        self.assertEqual(named, {*nephoscope.__all__, "open"})


@unittest.skipUnless(has_mypy(), "no mypy; install the package mypy")
class Mypy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (cls.folder / "mypy.ini").write_text(CONFIGURATION)

    def mypy(self, *arguments):
        command = [sys.executable, "-m", "mypy", "--config-file", self.folder / "mypy.ini", "--cache-dir", self.folder / "cache"]
        done = subprocess.run([*command, *arguments], cwd=PACKAGE.parent, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_package_is_strictly_typed(self):
        code, said = self.mypy("-p", "nephoscope")
        self.assertEqual(code, 0, said)

    def test_users_are_told_what_is_wrong(self):
        code, said = self.mypy("-c", RIGHT)
        self.assertEqual(code, 0, said)
        code, said = self.mypy("-c", "import nephoscope\n" + "\n".join(WRONG))
        self.assertEqual(code, 1, said)
        for line, (wrong, message) in enumerate(WRONG.items(), 2):
            self.assertRegex(said, rf"<string>:{line}: error: .*{message}", wrong)


if __name__ == "__main__":
    unittest.main()
