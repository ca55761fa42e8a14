#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The install tree serves others: a C++ project that finds the package builds and runs, and Python imports it, from a
prefix that was moved after installation (no path of the build tree is left in it). Its calibrations are found there too."""
import argparse
import os
import pathlib
import subprocess
import tempfile


def run(*command, **options):
    print("$", *command, flush=True)
    subprocess.run([str(word) for word in command], check=True, **options)


def install(arguments, folder):
    """The prefix: installed in one place, used from another."""
    run(arguments.cmake, "--install", arguments.build, "--prefix", folder / "staged", stdout=subprocess.DEVNULL)
    return (folder / "staged").rename(folder / "prefix")


def build_consumer(arguments, prefix, folder):
    source = pathlib.Path(__file__).parent / "Consumer"
    run(arguments.cmake, "-S", source, "-B", folder / "consumer", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}",
        f"-DCMAKE_CXX_COMPILER={arguments.compiler}", f"-DCMAKE_CXX_COMPILER_LAUNCHER={arguments.launcher}")
    run(arguments.cmake, "--build", folder / "consumer")
    run(folder / "consumer" / "consumer", os.path.realpath(prefix))


def import_package(arguments, prefix):
    where = prefix / arguments.python_destination
    check = f"import nephoscope; assert nephoscope.__file__.startswith({str(where)!r}), nephoscope.__file__"
    run("/usr/bin/python3", "-B", "-c", check, env={**os.environ, "PYTHONPATH": str(where)})


def main():
    parser = argparse.ArgumentParser()
    for name in ("build", "cmake", "compiler", "launcher", "python-destination"):
        parser.add_argument("--" + name, default="")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prefix = install(arguments, folder)
        build_consumer(arguments, prefix, folder)
        if arguments.python_destination:
            import_package(arguments, prefix)


if __name__ == "__main__":
    main()
