#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A window in which a click tells what it meets: pick.py VOLUME ISOVALUE"""

import sys

import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor
from vtkIsosurfaceRayTracing import isosurface, vtkIsosurfacePicker

if len(sys.argv) != 3:
    sys.exit(__doc__)
renderer, window, interactor = vtkRenderer(), vtkRenderWindow(), vtkRenderWindowInteractor()
renderer.AddVolume(isosurface(sys.argv[1], float(sys.argv[2]), color="ivory"))
window.AddRenderer(renderer)
window.SetMultiSamples(0)  # Smooths polygons, not isosurfaces, and is slow without a GPU.
window.SetSize(800, 800)
interactor.SetRenderWindow(window)
picker = vtkIsosurfacePicker()


def pick(*_):
    if picker.Pick(*interactor.GetEventPosition(), 0, renderer):
        print("position", *picker.GetPickPosition(), "normal", *picker.GetPickNormal(), "cell", picker.GetCellId())


interactor.AddObserver("LeftButtonPressEvent", pick, 1.0)  # before that which turns the camera
window.Render()
interactor.Start()
