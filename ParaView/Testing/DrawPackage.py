# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a picture with the plugin where its package has installed it: pvpython DrawPackage.py PICTURE.png"""

import glob
import sys

from paraview.simple import GetActiveViewOrCreate, LoadPlugin, SaveScreenshot, Show, Wavelet

(plugin,) = glob.glob("/usr/lib/*/paraview-*/plugins/RayTracedIsosurfaces/RayTracedIsosurfaces.so")
LoadPlugin(plugin, remote=False, ns=globals())
view = GetActiveViewOrCreate("RenderView")
display = Show(Wavelet(), view)
display.SetRepresentationType("Isosurface (ray traced)")
display.IsosurfaceArray = ["POINTS", "RTData"]
display.Isovalues = [130.0, 200.0]
view.ResetCamera()
SaveScreenshot(sys.argv[1], view, ImageResolution=(400, 400))
