# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shows a scene once and waits, while it refines itself: pvpython DrawWaiting.py PICTURE

With SERVER_PORT in the environment, the pvserver that listens there draws it. Prints how often the view was drawn.
"""

import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import Connect, Render, SaveScreenshot  # noqa: E402

import Scenes  # noqa: E402

SECONDS = 60
frames = []

if "SERVER_PORT" in os.environ:
    Connect("localhost", int(os.environ["SERVER_PORT"]))
view = Scenes.make_view()
view.UseFXAA = 0
display = Scenes.show(Scenes.make_wavelet(), view)
Render(view)
display.IsosurfaceProgressiveRefinement = 1
view.GetRenderer().AddObserver("EndEvent", lambda *_: frames.append(time.monotonic()))
Render(view)
interactor = view.GetInteractor()
interactor.Initialize()
start = time.monotonic()
# Until nothing has been drawn for two seconds.
while time.monotonic() < min(frames[-1] + 2, start + SECONDS):
    interactor.ProcessEvents()
    time.sleep(0.01)
print(f"{len(frames)} frames")
SaveScreenshot(sys.argv[1], view)
