# SPDX-License-Identifier: BSD-3-Clause
"""The installed plugin and package work where they were moved to. Arguments: PLUGIN ROOT FOLDER PVBATCH CMAKE BUILD PACKAGE, the last
being the package's place below an install prefix."""
import os
import pathlib
import shutil
import subprocess
import sys

SCRIPT = """
import nephoscope
assert nephoscope.__file__.startswith({prefix!r}), nephoscope.__file__
assert nephoscope.vtkCloudNetCDFReader.CanReadFile({data!r})  # before the plugin brings its libraries
from paraview.simple import *
LoadPlugin({plugin!r}, remote=False, ns=globals())
reader = CloudNetCDFReader(FileName={data!r})
reader.UpdatePipeline()
assert "CloudFraction" in reader.PointData.keys()
libraries = {{line.split()[-1] for line in open("/proc/self/maps") if "libvtkCloud" in line}}
assert all(name.startswith({prefix!r}) for name in libraries), libraries
print("installed")
"""


def main(plugin, root, folder, pvbatch, cmake, build, package):
    installed, moved = pathlib.Path(folder, "installed"), pathlib.Path(folder, "moved")
    for place in (installed, moved):
        shutil.rmtree(place, ignore_errors=True)
    subprocess.run([cmake, "--install", build, "--prefix", str(installed)], check=True, stdout=subprocess.DEVNULL)
    installed.rename(moved)
    script = pathlib.Path(folder, "installed.py")
    script.write_text(SCRIPT.format(
        prefix=str(moved), plugin=str(moved / pathlib.Path(plugin).relative_to(build)), data=str(pathlib.Path(root, "Data/sample_clouds.nc"))))
    paths = [path for path in os.environ["PYTHONPATH"].split(":") if not path.startswith(build + "/" + package)]
    environment = dict(os.environ, PYTHONPATH=":".join([str(moved / package), *paths]))
    run = subprocess.run([pvbatch, str(script)], env=environment, text=True, capture_output=True)
    print(run.stdout, run.stderr)
    return run.returncode or "installed" not in run.stdout


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
