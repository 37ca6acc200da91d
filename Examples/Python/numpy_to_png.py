#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""An isosurface of a numpy array, coloured by another array: numpy_to_png.py PICTURE.png

In a notebook of Jupyter, the last line without .save(...) shows the picture."""

import sys

import numpy as np
from vtkIsosurfaceRayTracing import render

if len(sys.argv) != 2:
    sys.exit(__doc__)
x, y, z = np.mgrid[-6:6:96j, -6:6:96j, -6:6:96j]
gyroid = np.cos(x) * np.sin(y) + np.cos(y) * np.sin(z) + np.cos(z) * np.sin(x)
radius = np.sqrt(x**2 + y**2 + z**2)
render(gyroid, 0.2, color_by=radius, cmap="inferno", background="white").save(sys.argv[1])
