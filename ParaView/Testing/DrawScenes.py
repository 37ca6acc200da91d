# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws scenes of Scenes.py to files: pvbatch DrawScenes.py FOLDER SCENE...

With pvpython, and SERVER_PORT in the environment, the pvserver that listens there draws them.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import Connect, Delete, SaveScreenshot  # noqa: E402

import Scenes  # noqa: E402

if "SERVER_PORT" in os.environ:
    Connect("localhost", int(os.environ["SERVER_PORT"]))
folder, *names = sys.argv[1:]
for name in names:
    view = Scenes.make_view()
    getattr(Scenes, name)(view)
    SaveScreenshot(os.path.join(folder, f"{name}.png"), view)
    Delete(view)
