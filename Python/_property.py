# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Colours, opacities and material of surfaces, as a vtkVolumeProperty."""

import numpy as np
from vtkmodules.vtkRenderingCore import vtkVolumeProperty

from ._colors import ONE, SEVERAL, is_color, map_colors, to_rgb
from ._numbers import to_array


def make_property(isovalues, color, opacity, shadows, occlusion):
    """That of surfaces whose colours are those of their isovalues."""
    surface = vtkVolumeProperty()
    surface.ShadeOn()
    # Only ambient light is occluded, and it alone comes to where all lights are in shadow.
    surface.SetAmbient(0.45 if occlusion else 0.3 if shadows else 0.15)
    surface.SetDiffuse(0.75 if occlusion else 0.85 if shadows else 0.95)
    surface.SetSpecular(0.15)
    surface.SetSpecularPower(25.0)
    # A new property has an isovalue, and functions from black to white.
    surface.GetIsoSurfaceValues().SetNumberOfContours(len(isovalues))
    surface.GetRGBTransferFunction().RemoveAllPoints()
    surface.GetScalarOpacity().RemoveAllPoints()
    colors, opacities = _choose_colors(isovalues, color), _choose_opacities(isovalues, opacity)
    for i, isovalue in enumerate(isovalues):
        surface.GetIsoSurfaceValues().SetValue(i, isovalue)
        surface.GetRGBTransferFunction().AddRGBPoint(isovalue, *colors[i])
        surface.GetScalarOpacity().AddPoint(isovalue, opacities[i])
    return surface


def color_values(surface, cmap, low, high):
    """Give all values the colours of a map: those of an array, instead of the isovalues."""
    function = surface.GetRGBTransferFunction()
    function.RemoveAllPoints()
    values = np.linspace(low, high, 256)
    for value, rgb in zip(values, map_colors(cmap, np.linspace(0.0, 1.0, len(values)))):
        function.AddRGBPoint(value, *rgb)


def color_slices(surface, cmap, low, high):
    """Give all values but the isovalues the colours of a map: caps show those above the least isovalue."""
    function = surface.GetRGBTransferFunction()
    isovalues = [surface.GetIsoSurfaceValues().GetValue(i)
                 for i in range(surface.GetIsoSurfaceValues().GetNumberOfContours())]
    colors = [function.GetColor(isovalue) for isovalue in isovalues]
    near = 1e-6 * (high - low)
    color_values(surface, cmap, low, high)
    for isovalue in isovalues:
        for value in (isovalue - near, isovalue + near):
            (rgb,) = map_colors(cmap, [np.clip((value - low) / (high - low), 0.0, 1.0)])
            function.AddRGBPoint(value, *rgb)
    for isovalue, rgb in zip(isovalues, colors):
        function.AddRGBPoint(isovalue, *rgb)


def _choose_colors(isovalues, color):
    if color is None and len(isovalues) == 1:
        color = ONE
    elif color is None:
        places = np.argsort(np.argsort(isovalues)) / (len(isovalues) - 1)
        return [tuple(rgb) for rgb in map_colors(SEVERAL, places)]
    if is_color(color) or not np.iterable(color):
        return [to_rgb(color)] * len(isovalues)
    if len(color) != len(isovalues):
        raise ValueError(
            f"there are {len(color)} colours for {len(isovalues)} isovalues; give one for all, or one for each")
    return [to_rgb(each) for each in color]


def _choose_opacities(isovalues, opacity):
    """Without any, those below the largest isovalue are translucent: it is seen through them."""
    if opacity is None:
        return [1.0 if isovalue == max(isovalues) else 0.35 for isovalue in isovalues]
    remedy = f"give a number from 0 to 1, or one for each of the {len(isovalues)} isovalues"
    opacities = to_array("opacity", opacity, remedy)
    if opacities.shape not in ((), (len(isovalues),)) or not np.all((opacities >= 0.0) & (opacities <= 1.0)):
        raise ValueError(f"opacity is {opacity!r}; {remedy}")
    return np.broadcast_to(opacities, len(isovalues)).tolist()
