# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Environments with and without a display, for programs that draw what they can. Without one VTK 9.1 draws
nothing; newer VTK does, by EGL or OSMesa, where they are installed."""

import os
import subprocess
import sys

QUESTION = """\
import vtkmodules.vtkRenderingOpenGL2
from vtkIsosurfaceRayTracing import vtkIsosurfaceComparisonFilter
print(vtkIsosurfaceComparisonFilter.WhyNoPictures())"""


def with_display(name):
    return dict(os.environ, DISPLAY=name)


def without_display():
    return {name: value for name, value in os.environ.items() if name != "DISPLAY"}


def why_no_pictures(environment):
    """What programs say in this environment; empty if they draw."""
    return subprocess.run(
        [sys.executable, "-c", QUESTION], env=environment, stdout=subprocess.PIPE, text=True, check=True
    ).stdout.strip()
