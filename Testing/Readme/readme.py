#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""README.md keeps its word: its Python and C++ examples run as printed, and the commands and files it names exist. So does
Utilities/Doc/python.md, whose Python blocks are one session.

Examples run in an empty folder that sees Data/; every file that an example says it writes must be there afterwards."""
import argparse
import os
import pathlib
import re
import shlex
import subprocess
import tempfile

LINES = 10


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


def run(*command, **options):
    print("$", *command, flush=True)
    subprocess.run([str(word) for word in command], check=True, **options)


def check_length(code, what):
    """Blank lines, braces and imports do not count."""
    lines = [line for line in code.splitlines() if not re.match(r"\s*[{}]?\s*$|from |import |#include|int main", line)]
    assert len(lines) <= LINES, f"the {what} example has {len(lines)} lines, not {LINES}"


def check_written(code, folder):
    for name in re.findall(r'"(\w+\.(?:vt\w|png|exr))"', code):
        assert (folder / name).stat().st_size > 0, f"{name} was not written"


def check_python(text, folder):
    for code in blocks(text, "python"):
        check_length(code, "Python")
        run("/usr/bin/python3", "-B", "-c", code, cwd=folder)
        check_written(code, folder)


def check_session(page, folder):
    """All Python blocks of a page, one after the other in one interpreter."""
    text = page.read_text()
    code = "\n".join(blocks(text, "python"))
    run("/usr/bin/python3", "-B", "-W", "error", "-c", code, cwd=folder)
    check_written(code, folder)
    for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", text):
        assert (page.parent / target).exists(), f"{page.name} links {target}, which does not exist"


def check_cpp(text, folder, arguments):
    """The C++ block and the cmake block, put into a folder of their own, make a project that builds and runs."""
    (code,), (lists,) = blocks(text, "cpp"), blocks(text, "cmake")
    check_length(code, "C++")
    (folder / "main.cxx").write_text(code)
    (folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.18)\nproject(Example CXX)\n" + lists)
    run(arguments.cmake, "-S", folder, "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_PREFIX_PATH={arguments.build}", f"-DCMAKE_CXX_COMPILER={arguments.compiler}",
        f"-DCMAKE_CXX_COMPILER_LAUNCHER={arguments.launcher}")
    run(arguments.cmake, "--build", folder / "build")
    program = re.search(r"add_executable\((\w+)", lists)[1]
    run(folder / "build" / program, cwd=folder)
    check_written(code, folder)


def check_commands(text, root):
    """The first word of each command line is a program of this repository or of the build."""
    for line in "\n".join(blocks(text, "sh")).splitlines():
        words = shlex.split(line, comments=True)
        if words and words[0].startswith("Utilities/"):
            assert os.access(root / words[0], os.X_OK), f"{words[0]} is not there to be run"


def check_links(text, root):
    for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", text):
        assert (root / target).exists(), f"README.md links {target}, which does not exist"


def check_nephoscope(text, build):
    """Commands of the program run as printed; those with a name in capitals show a form only."""
    for line in "\n".join(blocks(text, "sh")).splitlines():
        words = shlex.split(line, comments=True)
        if words and words[0] == "build/bin/nephoscope" and not re.search(r"\b[A-Z]{3,}\b", line):
            yield [build / "bin" / "nephoscope", *words[1:]]


def main():
    parser = argparse.ArgumentParser()
    for name in ("root", "build", "cmake", "compiler", "launcher", "wrapped"):
        parser.add_argument("--" + name, default="")
    arguments = parser.parse_args()
    root = pathlib.Path(arguments.root)
    text = (root / "README.md").read_text()
    check_commands(text, root)
    check_links(text, root)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "Data").symlink_to(root / "Data")
        if arguments.wrapped == "ON":
            check_python(text, folder)
            check_session(root / "Utilities/Doc/python.md", folder)
        check_cpp(text, folder, arguments)
        for command in check_nephoscope(text, pathlib.Path(arguments.build)):
            run(*command, cwd=folder)


if __name__ == "__main__":
    main()
