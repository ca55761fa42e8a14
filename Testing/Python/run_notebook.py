#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the code cells of a notebook in order, in its folder, as Jupyter would: run_notebook.py NOTEBOOK.

A cell's last expression is shown: by _repr_png_ if it has one, and then it must be a PNG, else by repr. The notebook is
committed without outputs. Jupyter itself, 33 packages of Debian's, is not needed.
"""
import ast
import json
import os
import pathlib
import sys

PNG = b"\x89PNG\r\n\x1a\n"


def show(value):
    if hasattr(value, "_repr_png_"):
        picture = value._repr_png_()
        assert picture.startswith(PNG) and len(picture) > 1000, "not a picture"
        print(f"[a picture of {len(picture)} bytes]")
    elif value is not None:
        print(repr(value)[:2000])


def run(source, name, scope):
    tree = ast.parse(source, name)
    last = ast.Expression(tree.body.pop().value) if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, name, "exec"), scope)
    if last:
        show(eval(compile(last, name, "eval"), scope))


def main():
    path = pathlib.Path(sys.argv[1]).resolve()
    notebook = json.loads(path.read_text())
    os.chdir(path.parent)
    scope = {"__name__": "__main__"}
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert cells, "no code"
    for number, cell in enumerate(cells, 1):
        assert not cell["outputs"] and cell["execution_count"] is None, f"cell {number} is committed with its outputs"
        source = "".join(cell["source"])
        print(f"[{number}]", source, sep="\n")
        run(source, f"cell {number}", scope)


if __name__ == "__main__":
    main()
