# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A window with isosurfaces."""

from __future__ import annotations

import os
import sys
from typing import Any, Sequence

from vtkmodules.vtkRenderingCore import vtkCamera

from ._camera import VIEW, make_camera
from ._colors import to_rgb
from ._lights import make_lights
from ._render import check_size
from ._scene import to_volume

REFINING = 20  # milliseconds between frames while the picture rests


def show(
    surfaces: Any,
    isovalues: float | Sequence[float] | str = "auto",
    *,
    size: tuple[int, int] = (800, 800),
    view: str | Sequence[float] = VIEW,
    up: str | Sequence[float] | None = None,
    zoom: float = 1.0,
    camera: vtkCamera | None = None,
    background: str | Sequence[float] = "white",
    **options: Any,
) -> None:
    """Open a window in which the mouse rotates isosurfaces, and wait until it is closed.

    While the mouse rests, edges are anti-aliased. The parameters are those of ``render``; the background is white
    by default, and ``camera`` is copied.

    Raises
    ------
    RuntimeError
        There is no display: ``render`` makes pictures without one.
    """
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        raise RuntimeError("there is no display (DISPLAY is not set); render() makes pictures without one")
    volume = to_volume(surfaces, isovalues, options)
    window = make_window(volume, check_size(size), view, up, zoom, camera, background)
    interactor = make_interactor(window, volume.GetMapper())
    window.Render()
    interactor.Start()


def make_window(volume, size, view, up, zoom, camera, background):
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

    renderer = vtkRenderer()
    renderer.SetBackground(to_rgb(background))
    renderer.AutomaticLightCreationOff()
    for light in make_lights():
        renderer.AddLight(light)
    renderer.AddVolume(volume)
    renderer.SetActiveCamera(make_camera(volume, size, view, up, zoom, camera))
    window = vtkRenderWindow()
    window.SetMultiSamples(0)  # The frames that are accumulated smooth edges.
    window.SetWindowName("vtkIsosurfaceRayTracing")
    window.SetSize(size)
    window.AddRenderer(renderer)
    return window


def make_interactor(window, mapper):
    """Draws again while that makes edges smoother."""
    from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
    from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor

    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
    interactor.Initialize()

    def refine(interactor, _event):  # which must not refer to the window: they would keep each other
        if 0 < mapper.GetNumberOfAccumulatedFrames() < mapper.GetMaximumNumberOfAccumulatedFrames():
            interactor.Render()

    interactor.AddObserver("TimerEvent", refine)
    interactor.CreateRepeatingTimer(REFINING)
    return interactor
