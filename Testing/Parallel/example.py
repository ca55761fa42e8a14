#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Python example of Utilities/Doc/parallel.md, as printed: the same picture with 1 and with 3 processes. example.py ROOT MPIRUN."""
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

ROOT, MPIRUN = sys.argv[1:]


def picture(code, folder, ranks):
    file = folder / "clouds.png"
    file.unlink(missing_ok=True)
    command = [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-n", str(ranks), "/usr/bin/python3", "-B", "-c", code]
    subprocess.run(command, cwd=folder, check=True)
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)


text = pathlib.Path(ROOT, "Utilities/Doc/parallel.md").read_text()
(example,) = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
with tempfile.TemporaryDirectory() as name:
    place = pathlib.Path(name)
    (place / "Data").symlink_to(pathlib.Path(ROOT, "Data"))
    one = picture(example, place, 1)
    assert one.min() < 50 < 150 < one.max(), "the picture has no clouds"
    assert numpy.abs(picture(example, place, 3) - one).max() <= 1, "three processes draw another picture"
