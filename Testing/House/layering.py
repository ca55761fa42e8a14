#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Who may include whom: the folder tree is the dependency graph. layering.py ROOT prints each breach and fails if any.

    Kernels  <-  Fits, IO, Sources, Filters, Lighting, Rendering, Sparse  <-  Utilities, Examples, Testing
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^">]+)[">]', re.MULTILINE)
CPP = {".h", ".hxx", ".txx", ".cxx", ".cpp"}

# Headers of other libraries, and the one module that may include them, in .cxx files only.
PLACE = {
    re.compile(r"boost/math/quadrature/"): "Kernels",  # the exact references
    re.compile(r"ceres/"): "Fits",
    re.compile(r"openvdb/"): "Sparse",
    re.compile(r"netcdf(_\w+)?\.h$"): "IO",
    re.compile(r"udunits2\.h$"): "IO",
}

# Of the standard library, what a kernel does without: files and threads.
NOT_FOR_KERNELS = {"atomic", "condition_variable", "cstdio", "execution", "filesystem", "fstream", "future", "iostream",
                   "mutex", "shared_mutex", "thread"}


def place_of(path):
    """The module's name for a path under Modules, otherwise the top folder's; relative to the root."""
    return path.parts[1] if path.parts[0] == "Modules" else path.parts[0]


def project_files(root):
    for top in ("Modules", "Utilities", "Examples", "Testing"):
        yield from (path.relative_to(root) for path in sorted((root / top).rglob("*")) if path.is_file())


def breach_of_place(path, header):
    for pattern, module in PLACE.items():
        if pattern.match(header):
            if place_of(path) != module:
                return f"{header} belongs in Modules/{module} alone"
            if path.suffix != ".cxx":
                return f"{header} belongs in .cxx files alone"
    return None


def breach_of_kernels(path, quote, header, owners):
    """Kernels and their tests see the standard library and each other; tests also GoogleTest."""
    in_test = "Testing" in path.parts
    name = header.split("/")[-1]
    placed = any(pattern.match(header) and module == "Kernels" for pattern, module in PLACE.items())
    if placed or owners.get(name) == "Kernels" or (in_test and header.startswith(("gtest/", "gmock/"))):
        return None
    standard = quote == "<" and "." not in header and "/" not in header
    if not standard:
        return f"a kernel includes {header}, which is not of the standard library or Kernels"
    if header in NOT_FOR_KERNELS and not in_test:
        return f"a kernel includes <{header}>: kernels have no files and no threads"
    return None


def breach_of_layer(path, header, owners):
    """A module sees itself and Kernels, never a sibling or the layers above."""
    here = place_of(path)
    name = header.split("/")[-1]
    generated = re.fullmatch(r"vtkCloud(\w+)Module\.h", name)
    owner = generated.group(1) if generated else owners.get(name)
    if path.parts[0] == "Modules" and owner not in (None, here, "Kernels"):
        return f"{header} is of {owner}, which {here} may not include"
    return None


def include_breaches(root, path, owners):
    for quote, header in INCLUDE.findall((root / path).read_text()):
        if ".." in header.split("/"):
            yield f"{header}: name the header, not a way to it"
        yield breach_of_place(path, header)
        if path.parts[:2] == ("Modules", "Kernels"):
            yield breach_of_kernels(path, quote, header, owners)
        else:
            yield breach_of_layer(path, header, owners)


def module_breaches(root, path):
    """vtk.module and CMakeLists.txt link what the sources may include."""
    here = place_of(path)
    for name in re.findall(r"Nephoscope::Cloud(\w+)", (root / path).read_text()):
        if name not in (here, "Kernels"):
            yield f"Nephoscope::Cloud{name} is a sibling of {here}"


def class_breaches(root, path):
    for name, base in re.findall(r"class\s+(?:\w+_EXPORT\s+)?(vtkCloud\w+)[^{;]*:\s*public\s+([\w:]+)", (root / path).read_text()):
        if not base.startswith("vtk"):
            yield f"{name} inherits {base}: a pipeline class calls kernels and inherits none"


def breaches(root):
    """All breaches, as lines 'file: what'."""
    root = pathlib.Path(root)
    files = list(project_files(root))
    owners = {path.name: place_of(path) for path in files if path.suffix in CPP}
    for path in files:
        found = []
        if path.suffix in CPP:
            found += include_breaches(root, path, owners)
            found += class_breaches(root, path)
        if path.parts[0] == "Modules" and path.name in ("vtk.module", "CMakeLists.txt"):
            found += module_breaches(root, path)
        if path.parts[:2] == ("Modules", "Kernels") and path.suffix == ".py":
            found.append("Kernels have no Python")
        yield from (f"{path}: {what}" for what in found if what)


if __name__ == "__main__":
    lines = list(breaches(sys.argv[1]))
    print("\n".join(lines) or "every include keeps to its layer")
    sys.exit(bool(lines))
