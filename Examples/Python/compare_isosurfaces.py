#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compare ray traced and extracted isosurfaces: compare_isosurfaces.py VOLUME.mhd ISOVALUE"""

import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, for the times of pictures
from vtkIsosurfaceRayTracing import vtkIsosurfaceComparisonFilter

from read_volume import read_volume

if len(sys.argv) != 3:
    sys.exit(__doc__)

comparison = vtkIsosurfaceComparisonFilter()
comparison.SetInputData(read_volume(sys.argv[1]))
comparison.SetValue(0, float(sys.argv[2]))
comparison.Update()
table = comparison.GetOutput()
lines = [
    [table.GetColumnName(column)]
    + [table.GetValue(row, column).ToString() for row in range(table.GetNumberOfRows())]
    for column in range(table.GetNumberOfColumns())
]
widths = [max(map(len, texts)) for texts in zip(*lines)]
for line in lines:
    print("  ".join(f"{text:>{width}}" for text, width in zip(line, widths)).rstrip())
# Output 1 is the mesh with its distance from the isosurface, output 2 the image of the difference.
