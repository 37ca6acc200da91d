# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shows blocks as the multiblock inspector does, and writes pictures that TestBlocks.py compares:
pvbatch DrawBlocks.py FOLDER"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import (  # noqa: E402
    AppendDatasets,
    Delete,
    ExtractSelection,
    MergeBlocks,
    Render,
    ResetCamera,
    SaveScreenshot,
    SaveState,
    SelectSurfacePoints,
    Wavelet,
)
from paraview import servermanager  # noqa: E402

import Scenes  # noqa: E402

FOLDER = sys.argv[1]
BLUE = [0.2, 0.5, 0.9]


def write_picture(name, view):
    SaveScreenshot(os.path.join(FOLDER, f"{name}.png"), view)


def make_view():
    view = Scenes.make_view()
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    return view


def styled_and_separate():
    """The same blocks as sets of data of their own, with these settings."""
    view = make_view()
    Scenes.styled_blocks(view)
    write_picture("styled", view)
    SaveState(os.path.join(FOLDER, "styled.pvsm"))
    Delete(view)
    view = make_view()
    image, grid, _ = Scenes.make_blocks()
    Scenes.show(image, view, Opacity=0.4)
    Scenes.show(grid, view, DiffuseColor=BLUE)
    Scenes.show(Wavelet(WholeExtent=[-6, 6, -4, 8, 4, 16]), view)
    write_picture("separate", view)
    Delete(view)


def edit():
    view = make_view()
    display = Scenes.show(Scenes.make_named_blocks(), view)
    write_picture("plain", view)
    display.BlockColors = ["/Root/pair", "1", "0", "0", "/Root/pair/grid", *map(str, BLUE)]
    display.BlockSelectors = ["/Root/pair/grid"]
    write_picture("innermost", view)
    display.BlockColors = ["/Root", *map(str, BLUE)]
    write_picture("colored", view)
    display.BlockColors = []
    display.DiffuseColor = BLUE
    write_picture("colored_all", view)
    display.DiffuseColor = [0.9, 0.75, 0.55]
    display.BlockSelectors = []
    write_picture("nothing", view)
    display.BlockSelectors = ["/"]
    display.BlockOpacities = ["/Root/above", "0", "/Root/absent", "0.5"]
    write_picture("invisible", view)
    display.BlockOpacities = []
    display.BlockSelectors = ["/Root/image", "/Root/pair"]
    write_picture("hidden", view)
    display.BlockSelectors = ["/"]
    write_picture("again", view)
    return view, display


def look_at_one(view, display):
    display.BlockSelectors = ["/Root/above"]
    Render(view)
    ResetCamera(view)
    print("focal point", [round(x) for x in view.CameraFocalPoint])
    Scenes.place_camera(view)
    Render(view)
    SelectSurfacePoints(Rectangle=[0, 0, 240, 240], View=view)
    append = AppendDatasets()
    merged = MergeBlocks(Input=ExtractSelection(Input=display.Input), MergePoints=0)
    selected = servermanager.Fetch(merged, append, append)
    print("selected", selected.GetNumberOfPoints(), [round(x) for x in selected.GetBounds()])


styled_and_separate()
look_at_one(*edit())
