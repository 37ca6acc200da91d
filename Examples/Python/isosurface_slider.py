#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A window with an isosurface and a slider for its isovalue: isosurface_slider.py VOLUME ISOVALUE"""

import sys

import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws
from vtkmodules.vtkInteractionWidgets import vtkSliderRepresentation2D, vtkSliderWidget
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor
from vtkIsosurfaceRayTracing import isosurface, read

if len(sys.argv) != 3:
    sys.exit(__doc__)
data = read(sys.argv[1])
volume = isosurface(data, float(sys.argv[2]), color="ivory")
renderer, window, interactor = vtkRenderer(), vtkRenderWindow(), vtkRenderWindowInteractor()
renderer.AddVolume(volume)
window.AddRenderer(renderer)
window.SetMultiSamples(0)  # Smooths polygons, not isosurfaces, and is slow without a GPU.
window.SetSize(800, 800)
interactor.SetRenderWindow(window)

low, high = data.GetScalarRange()
slider = vtkSliderRepresentation2D()
slider.SetMinimumValue(low)
slider.SetMaximumValue(high)
slider.SetValue(float(sys.argv[2]))
for point, x in ((slider.GetPoint1Coordinate(), 0.1), (slider.GetPoint2Coordinate(), 0.9)):
    point.SetCoordinateSystemToNormalizedViewport()
    point.SetValue(x, 0.1)
widget = vtkSliderWidget()
widget.SetInteractor(interactor)
widget.SetRepresentation(slider)
widget.AddObserver("InteractionEvent", lambda *_: volume.GetProperty().GetIsoSurfaceValues().SetValue(0, slider.GetValue()))
widget.EnabledOn()
window.Render()
interactor.Start()
