# SPDX-License-Identifier: BSD-3-Clause
"""What VTK says becomes Python: errors are raised, warnings go to the module warnings."""
from __future__ import annotations

import re
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

_PLACE = re.compile(r"^(ERROR|Warning|Generic Warning): In [^\n]*, line \d+\n(?:\w+ \((?:0x)?[0-9a-fA-F]+\): )?", re.MULTILINE)
_AFTERMATH = re.compile(r"returned failure for request|see its own message")
# A remedy in the words of the classes, in those of the functions.
_WORDS = {"SetVariableName": "variables={role: name}", "SetInputArrayToProcess": "field=",
          "SetGeometryToLocal": "geometry='local'", "SetGeometryToMap or SetGeometryToGlobe": "geometry='map' or 'globe'"}
_one_at_a_time = threading.RLock()


class CloudError(RuntimeError):
    """Nephoscope could not do what was asked. The message says what is wrong, where, and what would be right."""


def _messages(text: str) -> Iterator[tuple[str, str]]:
    """Kind and message, on one line, of each entry of VTK's output."""
    parts = _PLACE.split(text)
    for kind, message in zip(parts[1::2], parts[2::2]):
        for said, meant in _WORDS.items():
            message = message.replace(said, meant)
        yield kind, " ".join(message.split())


@contextmanager
def raising() -> Iterator[None]:
    """While in it, VTK prints nothing; at its end the first error is raised as CloudError and each warning warned.

    VTK has one output window for all threads, so only one thread is in it at a time.
    """
    with _one_at_a_time:
        said = vtkStringOutputWindow()
        window, verbosity = vtkOutputWindow.GetInstance(), vtkLogger.GetCurrentVerbosityCutoff()
        vtkOutputWindow.SetInstance(said)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        try:
            yield
        finally:
            vtkLogger.SetStderrVerbosity(verbosity)
            vtkOutputWindow.SetInstance(window)
    messages = list(_messages(said.GetOutput()))
    errors = [message for kind, message in messages if kind == "ERROR"]
    for message in dict.fromkeys(message for kind, message in messages if kind != "ERROR"):
        warnings.warn(message, stacklevel=4)
    if errors:
        raise CloudError(next((e for e in errors if not _AFTERMATH.search(e)), errors[0]))
