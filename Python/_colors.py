# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Colours by names, numbers and colour maps."""

import re

import numpy as np
from vtkmodules.vtkCommonColor import vtkNamedColors

from ._numbers import are_three

# Of surfaces without colours of their own: of one, and of several by their isovalues.
ONE = "#f7e9d2"
SEVERAL = ("#4f86c6", "#74c2a2", "#f2a65a", ONE)

MAPS = {
    "gray": ("#404040", "white"),  # light falls on it
    "coolwarm": ("#3b4cc0", "#7396f5", "#b0cbfc", "#dcdcdd", "#f6bfa5", "#ea7b60", "#b40426"),
    "inferno": ("#000004", "#210c4a", "#57106e", "#8a226a", "#bc3754", "#e45a31", "#f98e09", "#f9cb35", "#fcffa4"),
    "viridis": ("#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"),
}
REMEDY = f"give one of {', '.join(MAPS)}, one of matplotlib, or a list of colours"


def is_color(value):
    """Whether a value has the form of a colour, and not of several."""
    return isinstance(value, str) or are_three(value)


def to_rgb(color):
    """Red, green and blue, from 0 to 1, of a name ("ivory"), of "#rrggbb" or of three such numbers."""
    if isinstance(color, str):
        names = vtkNamedColors()
        if re.fullmatch("#[0-9a-fA-F]{6}", color):
            return tuple(channel / 255.0 for channel in bytes.fromhex(color[1:]))
        if names.ColorExists(color):
            return tuple(names.GetColor3d(color))
    elif is_color(color) and all(0.0 <= channel <= 1.0 for channel in color):
        return tuple(map(float, color))
    raise ValueError(
        f"{color!r} is no colour; give a name of CSS, \"#rrggbb\", or red, green and blue from 0 to 1")


def map_colors(colors, parts):
    """The colours of a map at parts of it, from 0 to 1: rows of red, green and blue.

    The map is the name of one in MAPS, or of one of matplotlib if that is installed; a list of colours; or what maps
    an array of parts to rows of colours, as colour maps of matplotlib do.
    """
    if isinstance(colors, str):
        colors = MAPS.get(colors) or _find_in_matplotlib(colors)
    if callable(colors):
        rows = np.asarray(colors(np.asarray(parts)), dtype=float)
        if rows.ndim == 2 and rows.shape[0] == len(parts) and rows.shape[1] >= 3:
            return rows[:, :3]
    elif isinstance(colors, (list, tuple, np.ndarray)) and len(colors):
        points = np.array([to_rgb(color) for color in colors])
        places = np.linspace(0.0, 1.0, len(points))
        return np.stack([np.interp(parts, places, points[:, channel]) for channel in range(3)], axis=1)
    raise ValueError(f"there is no colour map {colors!r}; {REMEDY}")


def _find_in_matplotlib(name):
    try:
        import matplotlib

        return matplotlib.colormaps[name]
    except (ImportError, AttributeError, KeyError):
        raise ValueError(f"there is no colour map {name!r}; {REMEDY}") from None
