# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What VTK reports, as exceptions and warnings of Python."""

import contextlib
import re
import warnings

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow


def call(mapper, method, *arguments):
    """What a method of a mapper returns; its errors are raised, its warnings are Python's."""
    result, errors = _attempt(mapper, method, arguments)
    if not result and not errors:
        # A mapper reports an error once and no more; a copy of it knows nothing of that.
        copy = mapper.NewInstance()
        copy.ShallowCopy(mapper)
        result, errors = _attempt(copy, method, arguments)
    if errors:
        raise (MemoryError if "not enough memory" in errors[0] else ValueError)(errors[0])
    return result


def _attempt(mapper, method, arguments):
    with _reports(mapper, "ErrorEvent") as errors, _reports(mapper, "WarningEvent") as hints:
        result = getattr(mapper, method)(*arguments)
    for hint in hints:
        warnings.warn(hint, RuntimeWarning, stacklevel=4)
    return result, errors


@contextlib.contextmanager
def _reports(source, event):
    """What an object of VTK reports meanwhile, which is then not printed."""
    messages = []

    def keep(_caller, _event, message):
        messages.append(re.sub(r"(?s)^.*?\(0x[0-9a-f]+\): ", "", message).strip())

    keep.CallDataType = "string0"
    tag = source.AddObserver(event, keep)
    try:
        yield messages
    finally:
        source.RemoveObserver(tag)


@contextlib.contextmanager
def silence():
    """What VTK reports meanwhile is kept in a window, and not printed. (Readers report by objects of their own.)"""
    window, verbosity = vtkOutputWindow.GetInstance(), vtkLogger.GetCurrentVerbosityCutoff()
    kept = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(kept)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        yield kept
    finally:
        vtkLogger.SetStderrVerbosity(verbosity)
        vtkOutputWindow.SetInstance(window)
