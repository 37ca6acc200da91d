#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Time the frames of vtkIsosurfaceViewer while the mouse drags, with one surface and with a translucent second one:

    time_dragging.py VTKISOSURFACEVIEWER VOLUME ISOVALUE SECOND_ISOVALUE

The mouse moves 60 times a second, for five seconds, under an X server (xvfb-run -s "-screen 0 1280x1024x24")."""

import math
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Support"))
from ViewerSession import Viewer, xdotool

FRAMES, SECONDS = 300, 5.0
RADIUS = 150  # of the circle on which the mouse moves, in pixels


def drag(viewer):
    x, y = viewer.middle
    moves = []
    for i in range(FRAMES):
        angle = 2.0 * math.pi * i / FRAMES
        moves += ["mousemove", round(x + RADIUS * math.sin(angle)), round(y + RADIUS * (1.0 - math.cos(angle))),
                  "sleep", SECONDS / FRAMES]  # fmt: skip
    xdotool("mousemove", x, y, "mousedown", 1, *moves, "mouseup", 1)


def measure(program, volume, isovalues):
    with tempfile.TemporaryDirectory() as folder:
        viewer = Viewer(program, Path(folder), volume)
        viewer.type(isovalues[0])
        for isovalue in isovalues[1:]:
            viewer.press("a")
            viewer.type(isovalue)
        viewer.press("r")
        viewer.take_picture()  # when all of that is done
        drag(viewer)
        return viewer.quit().strip()


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    program, volume, *isovalues = sys.argv[1:]
    print("one surface:", measure(os.path.abspath(program), os.path.abspath(volume), isovalues[:1]))
    print("two surfaces:", measure(os.path.abspath(program), os.path.abspath(volume), isovalues))


if __name__ == "__main__":
    main()
