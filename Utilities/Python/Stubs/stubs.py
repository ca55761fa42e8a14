#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes type stubs of the package nephoscope, which has to be importable: stubs.py FOLDER.

A stub vtkCloud*.pyi for each extension module, from the signatures with which VTK's wrappers begin the documentation of each
method, and __init__.pyi, which names all that the package has.
"""
import pathlib
import re
import sys

import nephoscope
from vtkmodules.vtkCommonCore import vtkObjectBase

# VTK 9.1 has no stubs of its own: overloads that differ in a class of VTK look alike to mypy.
HEAD = "# Written by Utilities/Python/Stubs/stubs.py.\n# mypy: disable-error-code=misc\n"
SIMPLE = {"int": "int", "float": "float", "str": "str", "bool": "bool", "None": "None", "bytes": "bytes"}
SIGNATURE = re.compile(r"^\w+\(((?:[^\n]|\n +)*)\)\s+-> ([^\n]+)\nC\+\+:[^\n]*\n?(?: +[^\n]+\n?)*", re.MULTILINE)


class Types:
    """Types of signatures as those of stubs, and the imports that they take."""

    def __init__(self, module):
        self.module, self.imports = module, set()

    def of_class(self, name):
        """A class of this module, of another of this package, of VTK; Any if there is none."""
        if not hasattr(self.module, name):
            owners = [key for key, module in sorted(sys.modules.items())
                      if key.startswith(("vtkmodules.vtk", "nephoscope.vtk")) and getattr(module, name, None).__class__ is type]
            home = [key for key in owners if getattr(sys.modules[key], name).__module__ in (key, key.split(".")[-1])]
            if not home:
                return "Any"
            self.imports.add(f"from {home[0]} import {name}")
        return name

    def of(self, text, given):
        """given: of a parameter, which takes any sequence for a tuple."""
        text = text.strip()
        if text.startswith("(") or text.startswith("["):
            parts = {self.of(part, given) for part in split(text[1:-1])}
            item = parts.pop() if len(parts) == 1 else "Any"
            return f"MutableSequence[{item}]" if text[0] == "[" else f"Sequence[{item}]" if given else f"tuple[{item}, ...]"
        if text in SIMPLE:
            return SIMPLE[text]
        return self.of_class(text) if re.fullmatch(r"vtk\w+", text) else "Any"


def split(text):
    """At commas outside of brackets."""
    depth, part, parts = 0, "", []
    for character in text:
        depth += (character in "([") - (character in ")]")
        if character == "," and not depth:
            parts.append(part)
            part = ""
        else:
            part += character
    return [p for p in [*parts, part] if p.strip()]


def signatures(method):
    """Parameters and result of each overload, as text; the text that explains them."""
    text = method.__doc__ or ""
    found = [(split(" ".join(match[1].split())), match[2]) for match in SIGNATURE.finditer(text)]
    return found, SIGNATURE.sub("", text).strip()


def parameter(text, types, taken):
    name, _, kind = text.strip().partition(":")
    kind, _, default = kind.partition("=")
    name = name if name.isidentifier() and name not in taken else f"{name}_{len(taken)}"
    taken.add(name)
    return f"{name}: {types.of(kind, True)}" + (" = ..." if default else "")


def method_lines(name, method, types):
    found, text = signatures(method)
    if not found:
        yield f"    def {name}(self, *args: Any) -> Any: ..."
    for parameters, result in found:
        static = not parameters or parameters[0].strip() != "self"
        if len(found) > 1:
            yield "    @overload"
        if static:
            yield "    @staticmethod"
        taken = set()
        words = [] if static else ["self"]
        words += [parameter(p, types, taken) for p in parameters[0 if static else 1:]]
        yield f"    def {name}({', '.join(words)}) -> {types.of(result, False)}:"
        yield from documentation(text, "        ")
        yield "        ..."


def documentation(text, indent):
    if text:
        text = text.replace("\\", "\\\\").replace('"', '\\"')
        yield indent + '"""' + text.replace("\n", "\n" + indent).replace("\n" + indent + "\n", "\n\n") + '"""'


def class_lines(cls, types):
    yield f"class {cls.__name__}({types.of_class(cls.__base__.__name__)}):"
    yield from documentation(cls.__doc__.strip(), "    ")
    for name, value in vars(cls).items():
        if name.startswith("_"):
            continue
        if isinstance(value, type):
            yield f"    class {name}(int): ..."
        elif isinstance(value, int):
            yield f"    {name}: int"
        elif callable(value):
            yield from method_lines(name, value, types)


def stub_of(module):
    types, lines = Types(module), []
    for name, cls in sorted(vars(module).items()):
        if isinstance(cls, type) and issubclass(cls, vtkObjectBase):
            lines += ["", *class_lines(cls, types)]
    always = ["from collections.abc import MutableSequence, Sequence", "from typing import Any, overload"]
    return HEAD + "\n".join(always + sorted(types.imports) + lines) + "\n"


def package_stub(modules):
    lines = [f"from .{file} import {name} as {name}" for name, file in nephoscope._FUNCTIONS.items()]
    for module in modules:
        names = (name for name, value in sorted(vars(module).items()) if isinstance(value, type) and name.startswith("vtkCloud"))
        lines += [f"from .{module.__name__.split('.')[-1]} import {name} as {name}" for name in names]
    listed = "".join(f'    "{name}",\n' for name in nephoscope.__all__)
    return HEAD + "\n".join(lines) + f"\n\n__all__ = [\n{listed}]\n"


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    modules = [module for key, module in sorted(sys.modules.items()) if re.fullmatch(r"nephoscope\.vtkCloud\w+", key)]
    for module in modules:
        (folder / (module.__name__.split(".")[-1] + ".pyi")).write_text(stub_of(module))
    (folder / "__init__.pyi").write_text(package_stub(modules))


if __name__ == "__main__":
    main()
