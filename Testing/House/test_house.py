#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The house check finds each kind of breach, and nothing in a house in order."""
import unittest

from house import LINES, TOP, breaches
from planted import found_in

SPDX = "// SPDX-License-Identifier: BSD-3-Clause\n"
IN_ORDER = {
    **{name: "" for name in TOP if "." in name or name == "LICENSE"},
    "Data/sample": "",
    "Examples/Scenes/a.yaml": "",
    "Testing/House/test.py": SPDX,
    "Utilities/demo": "#!/bin/sh\n" + SPDX,
    "Utilities/packages": "",
    "build/anything.h": "",
    ".gitignore": "",
    "Modules/Kernels/vtk.module": "Nephoscope::CloudKernels vtkCloudKernels VTK::CommonCore",
    "Modules/Kernels/CMakeLists.txt": "",
    "Modules/Kernels/Testing/Cxx/CMakeLists.txt": "",
    "Modules/Kernels/CloudArrays.h": SPDX + "const char* Wind =\n  \"Wind\";",
    "Modules/Kernels/Long.cxx": SPDX * LINES,
}
BREACHES = [
    ("Docs/index.md", "", "no place"),
    ("Modules/IO/vtk.module", "Nephoscope::CloudIO vtkCloudIO VTK::CommonCore", "no CMakeLists.txt"),
    ("Modules/Kernels/vtk.module", "Nephoscope::CloudKernels vtkCloudKernels", "VTK::CommonCore"),
    ("Modules/Kernels/No.h", "#ifndef No_h\n", "SPDX"),
    ("Utilities/script", "#!/bin/sh\n", "SPDX"),
    ("Modules/Kernels/Long.cxx", SPDX * (LINES + 1), "601 lines"),
    ("Modules/Kernels/a.cxx", SPDX + 'data->GetArray("Wind");\n', "arrays::Wind"),
]


class House(unittest.TestCase):
    def test_house_in_order(self):
        self.assertEqual(found_in(breaches, IN_ORDER), [])

    def test_each_planted_breach_is_found(self):
        for name, text, what in BREACHES:
            with self.subTest(name=name):
                self.assertTrue(any(what in line for line in found_in(breaches, {**IN_ORDER, name: text})))

    def test_missing_file_is_found(self):
        files = {name: text for name, text in IN_ORDER.items() if name != "LICENSE"}
        self.assertEqual(found_in(breaches, files), ["LICENSE: missing at the top level"])


if __name__ == "__main__":
    unittest.main()
