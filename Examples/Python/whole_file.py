# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Files that are whole or absent, for the other scripts of this folder."""

import os
import signal
import sys
from pathlib import Path


def write_whole(path, write):
    """Write under another name first; what is unfinished is removed, after Ctrl-C too."""
    path = Path(path)
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    on_terminate = signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    try:
        with open(part, "wb") as stream:
            write(stream)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
        signal.signal(signal.SIGTERM, on_terminate)


def write_picture(writer, file_name):
    """What a vtkPNGWriter makes of its input; the program ends if it cannot be written."""
    writer.WriteToMemoryOn()
    writer.Write()
    try:
        write_whole(file_name, lambda stream: stream.write(writer.GetResult()))
    except OSError as error:
        sys.exit(f"{file_name} cannot be written: {error.strerror}")
