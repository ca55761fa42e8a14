#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The layering check finds each kind of breach, and nothing in a tree without one."""
import unittest

from layering import breaches
from planted import found_in

CLEAN = {
    "Modules/Kernels/Optics.h": "#include <cmath>\n",
    "Modules/Kernels/Optics.cxx": '#include "Optics.h"\n#include <boost/math/quadrature/gauss_kronrod.hpp>\n',
    "Modules/Kernels/Testing/Cxx/TestOptics.cxx": "#include <fstream>\n#include <gtest/gtest.h>\n",
    "Modules/Kernels/vtk.module": "NAME\n  Nephoscope::CloudKernels\n",
    "Modules/IO/vtkCloudReader.h": '#include "vtkCloudIOModule.h"\nclass VTKCLOUDIO_EXPORT vtkCloudReader : public vtkAlgorithm\n{\n',
    "Modules/IO/vtkCloudReader.cxx": '#include "Optics.h"\n#include <netcdf.h>\n#include <udunits2.h>\n',
    "Modules/Filters/vtkCloudContour.h": "#include <vtkPolyDataAlgorithm.h>\n",
    "Modules/Filters/vtk.module": "DEPENDS\n  Nephoscope::CloudKernels\n",
    "Utilities/CommandLine/main.cxx": '#include "vtkCloudReader.h"\n#include "vtkCloudContour.h"\n',
    "Utilities/CommandLine/Options.h": "",
}

# what is planted (file, text) and what the check must say
BREACHES = [
    ("Modules/Kernels/Bad.h", "#include <vtkMath.h>\n", "not of the standard library"),
    ("Modules/Kernels/Bad.h", "#  include <thread>\n", "no files and no threads"),
    ("Modules/Kernels/Bad.cxx", "#include <fstream>\n", "no files and no threads"),
    ("Modules/Kernels/Testing/Cxx/TestBad.cxx", "#include <vtkNew.h>\n", "not of the standard library"),
    ("Modules/Kernels/Bad.cxx", '#include "vtkCloudReader.h"\n', "not of the standard library"),
    ("Modules/Kernels/Bad.h", "#include <boost/math/quadrature/gauss.hpp>\n", ".cxx files alone"),
    ("Modules/Kernels/Bad.cxx", "#include <boost/thread.hpp>\n", "not of the standard library"),
    ("Modules/IO/Bad.cxx", "#include <boost/math/quadrature/gauss.hpp>\n", "Modules/Kernels alone"),
    ("Modules/Kernels/bad.py", "import vtkmodules\n", "no Python"),
    ("Modules/Filters/Bad.cxx", '#include "vtkCloudReader.h"\n', "of IO, which Filters may not include"),
    ("Modules/Filters/Bad.cxx", "#include <vtkCloudIOModule.h>\n", "of IO, which Filters may not include"),
    ("Modules/Filters/Bad.cxx", '#include "../IO/vtkCloudReader.h"\n', "not a way to it"),
    ("Modules/Filters/Bad.cxx", '#include "Options.h"\n', "of Utilities"),
    ("Modules/Filters/Bad.cxx", "#include <netcdf.h>\n", "Modules/IO alone"),
    ("Modules/Filters/Bad.cxx", "#include <netcdf_mem.h>\n", "Modules/IO alone"),
    ("Utilities/CommandLine/Bad.cxx", "#include <udunits2.h>\n", "Modules/IO alone"),
    ("Modules/IO/vtkCloudBad.h", "#include <netcdf.h>\n", ".cxx files alone"),
    ("Modules/IO/Bad.cxx", "#include <openvdb/openvdb.h>\n", "Modules/Sparse alone"),
    ("Examples/Cxx/Bad.cxx", "#include <ceres/ceres.h>\n", "Modules/Fits alone"),
    ("Modules/IO/vtk.module", "DEPENDS\n  Nephoscope::CloudFilters\n", "sibling of IO"),
    ("Modules/IO/Testing/Cxx/CMakeLists.txt", "DEPENDS Nephoscope::CloudFilters)\n", "sibling of IO"),
    ("Modules/IO/vtkCloudBad.h", "class vtkCloudBad : public nephoscope::Texture\n{\n", "inherits"),
]


class Layering(unittest.TestCase):
    def test_clean_tree_has_no_breach(self):
        self.assertEqual(found_in(breaches, CLEAN), [])

    def test_each_planted_breach_is_found_alone(self):
        for name, text, what in BREACHES:
            with self.subTest(name=name, text=text):
                lines = found_in(breaches, {**CLEAN, name: text})
                self.assertTrue(lines)
                self.assertTrue(all(line.startswith(name + ": ") for line in lines), lines)
                self.assertTrue(any(what in line for line in lines), lines)


if __name__ == "__main__":
    unittest.main()
