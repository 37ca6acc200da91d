#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ray trace an isosurface: ray_trace_isosurface.py VOLUME ISOVALUE PICTURE.png

VOLUME is a file (.vti, .mhd, .nii.gz, ...) or a folder of DICOM slices."""

import sys

from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkRenderer, vtkRenderWindow, vtkVolume, vtkWindowToImageFilter)
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

from read_volume import read_volume
from whole_file import write_picture

if len(sys.argv) != 4:
    sys.exit(__doc__)
volume_file, isovalue, picture_file = sys.argv[1], float(sys.argv[2]), sys.argv[3]

mapper = vtkIsosurfaceRayTraceMapper()
mapper.SetInputData(read_volume(volume_file))
volume = vtkVolume()
volume.SetMapper(mapper)
surface = volume.GetProperty()
surface.GetIsoSurfaceValues().SetValue(0, isovalue)
colors, opacities = surface.GetRGBTransferFunction(), surface.GetScalarOpacity()
colors.RemoveAllPoints()  # A new property has functions from black to white.
opacities.RemoveAllPoints()
colors.AddRGBPoint(isovalue, 0.96, 0.90, 0.80)
opacities.AddPoint(isovalue, 1.0)
surface.ShadeOn()
surface.SetDiffuse(0.9)

renderer = vtkRenderer()
renderer.SetBackground(0.16, 0.18, 0.22)
renderer.AddVolume(volume)
camera = renderer.GetActiveCamera()  # from the side of +y, with z up
camera.SetPosition(-0.35, 1.0, 0.15)
camera.SetViewUp(0.0, 0.0, 1.0)
renderer.ResetCamera()
camera.Zoom(1.5)
window = vtkRenderWindow()
window.SetMultiSamples(0)  # Smooths polygons, not isosurfaces, and is slow without a GPU.
window.SetOffScreenRendering(True)
window.SetSize(800, 800)
window.AddRenderer(renderer)
window.Render()

picture = vtkWindowToImageFilter()
picture.SetInput(window)
writer = vtkPNGWriter()
writer.SetInputConnection(picture.GetOutputPort())
write_picture(writer, picture_file)
