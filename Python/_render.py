# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures without a window."""

from __future__ import annotations

import operator
from typing import Any, Sequence

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkCamera, vtkLightCollection

from ._camera import VIEW, make_camera
from ._errors import call
from ._lights import make_lights
from ._picture import Picture
from ._scene import to_volume


def render(
    surfaces: Any,
    isovalues: float | Sequence[float] | str = "auto",
    *,
    size: tuple[int, int] = (800, 800),
    view: str | Sequence[float] = VIEW,
    up: str | Sequence[float] | None = None,
    zoom: float = 1.0,
    camera: vtkCamera | None = None,
    background: str | Sequence[float] | None = None,
    **options: Any,
) -> Picture:
    """A picture of isosurfaces, without a display and without OpenGL.

    Parameters
    ----------
    surfaces : data, vtkVolume or list of vtkVolume
        What ``isosurface`` takes, or one or several volumes that it returned, which are drawn together.
    isovalues, **options
        For data, the parameters of ``isosurface``: ``scalars``, ``color``, ``opacity``, ``color_by``, ``cmap``, ``clim``,
        ``clip``, ``caps``, ``shadows``, ``occlusion``, ``interpolation``, ``samples``, ``spacing``, ``origin``, ``direction``.
    size : (int, int)
        Width and height, in pixels.
    view, up : axis or vector
        The side from which the surfaces are seen, and the direction that is up in the picture: "x", "-x", ... "-z", or vectors.
        Without ``up``, "z" is up.
    zoom : float
        With more than 1, the surfaces are larger than the picture.
    camera : vtkCamera, optional
        Used instead of ``view``, ``up`` and ``zoom``. Its clipping range is ignored: everything is seen.
    background : colour, optional
        Without it, the background is transparent.

    Returns
    -------
    Picture

    Raises
    ------
    TypeError, ValueError
        Something cannot be drawn; the message says what to give instead.

    Examples
    --------
    >>> render("ct.nii.gz", [-300, 300], color=["peachpuff", "ivory"], background="white").save("head.png")
    """
    volume = to_volume(surfaces, isovalues, options)
    width, height = check_size(size)
    seen = make_camera(volume, (width, height), view, up, zoom, camera)
    lights = vtkLightCollection()
    for light in make_lights():
        lights.AddItem(light)
    image = vtkImageData()
    call(volume.GetMapper(), "RenderToImage", volume, seen, lights, width, height, image)
    return Picture(image, background)


def check_size(size):
    try:
        width, height = map(operator.index, size)
    except (TypeError, ValueError):
        raise ValueError(f"size is {size!r}; give width and height, in pixels") from None
    if min(width, height) < 1 or max(width, height) >= 2**31:
        raise ValueError(f"size is {size!r}; give at least one pixel each, and fewer than 2**31")
    return width, height
