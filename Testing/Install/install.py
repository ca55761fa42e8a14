#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The install tree serves others, from a prefix that was moved after installation: a C++ project that finds the package
builds, runs and finds the calibrations; the program draws; Python imports the package, draws and finds its types. Nothing
that they load lies in the build tree, and libraries find each other from where they are."""
import argparse
import os
import pathlib
import subprocess
import tempfile

FUNCTIONS = """
import pathlib, sys
import nephoscope as ns
sample, prefix, build = sys.argv[1:]
clouds = ns.open(sample, time=1, geometry="globe", exaggeration=10)
picture = ns.render(clouds, style="volume", size=(32, 24))
picture.save("installed.png")
assert picture.radiance.shape == (24, 32, 3) and picture.radiance.max() > 0.5
assert ns.contour(clouds, 0.15).GetNumberOfPolys() > 1000
package = pathlib.Path(ns.__file__).parent
assert package.is_relative_to(prefix), package
assert (package / "py.typed").exists()
for module in package.glob("*.so"):
    assert module.with_suffix(".pyi").exists(), f"{module.name} has no stub"
loaded = pathlib.Path("/proc/self/maps").read_text()
assert prefix in loaded and build not in loaded, [line for line in loaded.splitlines() if build in line]
"""


def run(*command, **options):
    print("$", *(word for word in command if word is not FUNCTIONS), flush=True)
    return subprocess.run([str(word) for word in command], check=True, **options)


def environment(**more):
    """That of somebody who has set nothing up."""
    return {name: value for name, value in os.environ.items() if name not in ("LD_LIBRARY_PATH", "PYTHONPATH")} | more


def install(arguments, folder):
    """The prefix: installed in one place, used from another whose name has a space."""
    run(arguments.cmake, "--install", arguments.build, "--prefix", folder / "staged", stdout=subprocess.DEVNULL)
    return (folder / "staged").rename(folder / "moved prefix")


def check_run_paths(prefix):
    """Libraries are looked for relative to who needs them."""
    binaries = [path for path in prefix.rglob("*") if path.is_file() and not path.is_symlink()
                and path.read_bytes()[:4] == b"\x7fELF"]
    assert len(binaries) > 5, binaries
    for path in binaries:
        dynamic = run("readelf", "-d", path, capture_output=True, text=True).stdout
        entries = [line.split("[")[1].rstrip("]") for line in dynamic.splitlines() if "RUNPATH" in line or "RPATH" in line]
        for entry in ":".join(entries).split(":"):
            assert entry.startswith("$ORIGIN") or not entry, f"{path.name} looks for libraries in {entry}"


def build_consumer(arguments, prefix, folder):
    source = pathlib.Path(__file__).parent / "Consumer"
    run(arguments.cmake, "-S", source, "-B", folder / "consumer", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}",
        f"-DCMAKE_CXX_COMPILER={arguments.compiler}", f"-DCMAKE_CXX_COMPILER_LAUNCHER={arguments.launcher}")
    run(arguments.cmake, "--build", folder / "consumer")
    run(folder / "consumer" / "consumer", os.path.realpath(prefix))


def run_program(arguments, prefix, folder):
    picture = folder / "program.png"
    run(prefix / "bin" / "nephoscope", "render", "--data", arguments.sample, "--style", "texture", "--size", "32x24",
        "-o", picture, env=environment(), cwd=folder, stderr=subprocess.DEVNULL)
    assert picture.read_bytes().startswith(b"\x89PNG")


def use_package(arguments, prefix, folder):
    where = prefix / arguments.python_destination
    run("/usr/bin/python3", "-B", "-W", "error", "-c", FUNCTIONS, arguments.sample, prefix, arguments.build,
        env=environment(PYTHONPATH=str(where)), cwd=folder)
    assert (folder / "installed.png").stat().st_size > 500


def main():
    parser = argparse.ArgumentParser()
    for name in ("build", "cmake", "compiler", "launcher", "python-destination", "sample"):
        parser.add_argument("--" + name, default="")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prefix = install(arguments, folder)
        check_run_paths(prefix)
        build_consumer(arguments, prefix, folder)
        run_program(arguments, prefix, folder)
        if arguments.python_destination:
            use_package(arguments, prefix, folder)


if __name__ == "__main__":
    main()
