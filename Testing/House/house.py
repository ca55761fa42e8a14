#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The house rules that a machine can see. house.py ROOT prints each breach and fails if there is any."""
import pathlib
import re
import sys

TOP = {"CMakeLists.txt", "Modules", "Testing", "Examples", "Data", "Utilities", "README.md", "LICENSE", "CONTRIBUTING.md",
       "CHANGELOG.md"}
NOT_COMMITTED = re.compile(r"build.*|out|compile_commands\.json|\..*")
LINES = 600


def top_level(root):
    here = {path.name for path in root.iterdir() if not NOT_COMMITTED.fullmatch(path.name)}
    yield from (f"{name}: the top level has no place for it" for name in sorted(here - TOP))
    yield from (f"{name}: missing at the top level" for name in sorted(TOP - here))


def sources(root):
    """C++, Python, and scripts without a suffix."""
    for top in ("Modules", "Testing", "Examples", "Utilities"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in (".h", ".cxx", ".py"):
                yield path
            elif path.is_file() and not path.suffix and path.read_bytes()[:2] == b"#!":
                yield path


def licence_and_length(root):
    for path in sources(root):
        lines = path.read_text().splitlines()
        name = path.relative_to(root)
        if not any("SPDX-License-Identifier: BSD-3-Clause" in line for line in lines[:3]):
            yield f"{name}: no SPDX-License-Identifier: BSD-3-Clause in the first three lines"
        if len(lines) > LINES:
            yield f"{name}: {len(lines)} lines; split it, {LINES} are the limit"


def modules(root):
    folders = sorted(path for path in (root / "Modules").iterdir() if path.is_dir())
    for folder in folders:
        for needed in ("vtk.module", "CMakeLists.txt", "Testing/Cxx/CMakeLists.txt"):
            if not (folder / needed).exists():
                yield f"{folder.relative_to(root)}: no {needed}"
        module = folder / "vtk.module"
        text = module.read_text() if module.exists() else ""
        for words in (f"Nephoscope::Cloud{folder.name}", f"vtkCloud{folder.name}", "VTK::CommonCore"):
            if words not in text.split():
                yield f"{module.relative_to(root)}: does not say {words}"


def array_names(root):
    """Nothing but CloudArrays.h spells an array's name in a module."""
    header = (root / "Modules/Kernels/CloudArrays.h").read_text()
    names = "|".join(re.findall(r"const char\*\s+(\w+)\s*=", header))
    for path in sorted((root / "Modules").rglob("*.cxx")):
        if "Testing" in path.parts:
            continue
        for line in path.read_text().splitlines():
            spelled = re.search(rf'Array\w*\([^)]*"({names})"', line)
            if spelled:
                yield f'{path.relative_to(root)}: spells "{spelled[1]}"; say nephoscope::arrays::{spelled[1]}'


def breaches(root):
    root = pathlib.Path(root)
    for rule in (top_level, licence_and_length, modules, array_names):
        yield from rule(root)


if __name__ == "__main__":
    found = list(breaches(sys.argv[1]))
    print("\n".join(found) or "the house is in order")
    sys.exit(bool(found))
