# SPDX-License-Identifier: BSD-3-Clause
"""What a check finds in a tree that is made for it."""
import pathlib
import tempfile


def found_in(breaches, files):
    """The breaches in a tree of these files, a dictionary of names and texts."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return list(breaches(folder))
