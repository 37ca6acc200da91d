#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A time series with a scalar bar: simulation.py ARRAY ISOVALUE COLOR_ARRAY FILE...

Draws the isosurface of an array, coloured by another one, and writes a PNG file beside each file of the series."""

import sys
from pathlib import Path

import vtkmodules.vtkRenderingFreeType  # noqa: F401, draws text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
from vtkIsosurfaceRayTracing import isosurface, read

if len(sys.argv) < 5:
    sys.exit(__doc__)
array, isovalue, color_array, *files = sys.argv[1:]
volume = isosurface(files[0], float(isovalue), scalars=array, color_by=color_array, cmap="coolwarm")
bar = vtkScalarBarActor()
bar.SetLookupTable(volume.GetProperty().GetRGBTransferFunction())  # of the range in the first file
bar.SetTitle(color_array)
renderer, window = vtkRenderer(), vtkRenderWindow()
renderer.AddVolume(volume)
renderer.AddViewProp(bar)
window.SetOffScreenRendering(True)
window.SetSize(800, 600)
window.SetMultiSamples(0)
window.AddRenderer(renderer)
for file in files:
    volume.GetMapper().SetInputDataObject(read(file))
    window.Render()
    picture, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    picture.SetInput(window)
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(str(Path(file).with_suffix(".png")))
    writer.Write()
