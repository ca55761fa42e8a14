#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Blender imports what `nephoscope convert` writes and draws it: test_blender.py NEPHOSCOPE ROOT FOLDER. 77: there is no Blender."""
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

PROGRAM, ROOT, FOLDER = (pathlib.Path(argument) for argument in sys.argv[1:4])
CLOUDS = FOLDER / "clouds.vdb"
VOXEL = 1e5


def blender(script, *arguments):
    command = ["blender", "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "--python", script, "--", *arguments]
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


class Blender(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([PROGRAM, "convert", ROOT / "Data" / "sample_climate.nc", CLOUDS, "--exaggeration", "20", "--voxel", str(VOXEL)],
            check=True, capture_output=True)

    def test_grids_and_box_are_those_that_were_written(self):
        (line,) = [line for line in blender(ROOT / "Testing/Blender/grids.py", CLOUDS).splitlines() if line.startswith("FOUND")]
        found = json.loads(line.split(maxsplit=1)[1])
        self.assertEqual(found["grids"], {"density": "FLOAT", "liquid": "FLOAT", "ice": "FLOAT", "wind": "VECTOR_FLOAT"})
        radius = 6371229 + 20 * 2e4
        for axis in range(3):
            places = [corner[axis] for corner in found["box"]]
            for end, sign in ((min(places), -1), (max(places), 1)):
                self.assertAlmostEqual(sign * end, radius, delta=2.5e5 + 8 * VOXEL)  # whole bricks

    def test_the_example_draws_bright_clouds_before_black_space(self):
        picture = FOLDER / "globe.png"
        picture.unlink(missing_ok=True)
        blender(ROOT / "Examples/Blender/globe.py", CLOUDS, picture, 64, 2)
        reader = vtkPNGReader()
        reader.SetFileName(str(picture))
        reader.Update()
        red = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, 0].reshape(48, 64)
        self.assertLess(red[:4, :8].max(), 10)
        bright = (red[8:40, 16:48] > 120).mean()
        self.assertTrue(0.2 < bright < 0.9, bright)


if __name__ == "__main__":
    if not shutil.which("blender"):
        print("Skipped: no Blender, install blender (0.4 GB)")
        sys.exit(77)
    FOLDER.mkdir(exist_ok=True)
    unittest.main(argv=sys.argv[:1])
