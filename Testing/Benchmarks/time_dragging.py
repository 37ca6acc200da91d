#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Time the frames of vtkIsosurfaceViewer while the mouse drags, with one surface and with a translucent second one:

    time_dragging.py VTKISOSURFACEVIEWER VOLUME ISOVALUE SECOND_ISOVALUE [SECONDS]

The mouse moves 60 times a second, for five seconds or SECONDS, under an X server (xvfb-run -s "-screen 0 1280x1024x24")."""

import math
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Support"))
from ViewerSession import Viewer, xdotool

RATE = 60  # moves a second
RADIUS = 150  # of the circle on which the mouse moves, in pixels


def drag(viewer, seconds):
    x, y = viewer.middle
    moves, count = [], round(RATE * seconds)
    for i in range(count):
        angle = 2.0 * math.pi * i / count
        moves += ["mousemove", round(x + RADIUS * math.sin(angle)), round(y + RADIUS * (1.0 - math.cos(angle))),
                  "sleep", 1.0 / RATE]  # fmt: skip
    xdotool("mousemove", x, y, "mousedown", 1, *moves, "mouseup", 1)


def measure(program, volume, isovalues, seconds):
    with tempfile.TemporaryDirectory() as folder:
        viewer = Viewer(program, Path(folder), volume)
        viewer.type(isovalues[0])
        for isovalue in isovalues[1:]:
            viewer.press("a")
            viewer.type(isovalue)
        viewer.press("r")
        viewer.take_picture()  # when all of that is done
        drag(viewer, seconds)
        return viewer.quit().strip()


def main():
    if len(sys.argv) not in (5, 6):
        sys.exit(__doc__)
    program, volume, *isovalues = sys.argv[1:5]
    seconds = float(sys.argv[5]) if len(sys.argv) == 6 else 5.0
    for name, count in (("one surface", 1), ("two surfaces", 2)):
        print(f"{name}:", measure(os.path.abspath(program), os.path.abspath(volume), isovalues[:count], seconds))


if __name__ == "__main__":
    main()
