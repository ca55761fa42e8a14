# SPDX-License-Identifier: BSD-3-Clause
"""What VTK says becomes Python: errors are raised, warnings go to the module warnings."""
from __future__ import annotations

import re
import signal
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

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
def raising(algorithm: vtkAlgorithm | None = None) -> Iterator[None]:
    """While in it, VTK prints nothing; at its end the first error is raised as CloudError and each warning warned. Ctrl-C
    aborts the algorithm and is raised then.

    VTK has one output window for all threads, so only one thread is in it at a time.
    """
    with _one_at_a_time:
        said = vtkStringOutputWindow()
        window, verbosity = vtkOutputWindow.GetInstance(), vtkLogger.GetCurrentVerbosityCutoff()
        vtkOutputWindow.SetInstance(said)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        try:
            with _interruptible(algorithm) if algorithm else nullcontext():
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


@contextmanager
def _interruptible(algorithm: vtkAlgorithm) -> Iterator[None]:
    """Python handles a signal in between its own instructions, of which there are none while VTK works: an observer of the
    progress has some. An exception in it would end the process, so the handler only asks the algorithm to abort."""
    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGINT) in (signal.SIG_IGN, None):
        yield  # signals are the main thread's, if they are heard at all
        return
    asked: list[int] = []

    def abort(number: int, frame: object) -> None:
        asked.append(number)
        algorithm.AbortExecuteOn()

    watch = algorithm.AddObserver("ProgressEvent", lambda *event: None)
    before = signal.signal(signal.SIGINT, abort)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        algorithm.RemoveObserver(watch)
    if asked:
        algorithm.AbortExecuteOff()
        raise KeyboardInterrupt
