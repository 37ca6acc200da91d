#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A user of the viewer, who looks at a CT: view_ct.py PROGRAM FOLDER PICTURE.png"""

import sys
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

from ViewerSession import Viewer

program, folder, picture = sys.argv[1:]
viewer = Viewer(program, Path.cwd(), folder)
viewer.type("300")
viewer.press("a")
viewer.type("-300")
viewer.press("x")
pixels = viewer.wait_for_rest()
print(viewer.quit().strip())

image = vtkImageData()
image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
colors = np.ascontiguousarray(pixels[::-1].reshape(-1, 3), np.uint8)
image.GetPointData().SetScalars(numpy_to_vtk(colors))
writer = vtkPNGWriter()
writer.SetInputData(image)
writer.SetFileName(picture)
writer.Write()
