# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what a state file shows: pvbatch DrawState.py STATE PICTURE"""

import runpy
import sys

from paraview.simple import GetActiveViewOrCreate, LoadState, SaveScreenshot

state, picture = sys.argv[1:]
if state.endswith(".py"):
    runpy.run_path(state)
else:
    LoadState(state)
SaveScreenshot(picture, GetActiveViewOrCreate("RenderView"))
