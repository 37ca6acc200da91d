# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what cannot be shown, beside a sphere: pvbatch DrawBadInput.py KIND PICTURE"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import Cone, PassArrays, SaveScreenshot, Show, Sphere  # noqa: E402

import Scenes  # noqa: E402


def no_array(view):
    Scenes.show(PassArrays(Input=Scenes.make_wavelet()), view)


def polygons(view):
    Scenes.show(Cone(), view)


def missing_color_array(view):
    display = Scenes.show(Scenes.make_wavelet(), view)
    Scenes.color_by(display, "POINTS", "absent")


def outside_range(view):
    Scenes.show(Scenes.make_wavelet(), view, isovalues=(1e6,))


kind, picture = sys.argv[1:]
view = Scenes.make_view()
Show(Sphere(Radius=10.0), view)
globals()[kind](view)
SaveScreenshot(picture, view)
