# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Edits a view of two sets of data, and writes pictures that TestSets.py compares: pvbatch DrawSets.py FOLDER"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import (  # noqa: E402
    AppendDatasets,
    ClearSelection,
    Delete,
    ExtractSelection,
    MergeBlocks,
    Render,
    SaveScreenshot,
    SelectSurfacePoints,
    Show,
)
from paraview import servermanager  # noqa: E402

import Scenes  # noqa: E402


def write_picture(name, view):
    SaveScreenshot(os.path.join(sys.argv[1], f"{name}.png"), view)


def make_view():
    view = Scenes.make_view()
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    return view


def show_set(number, view, **settings):
    """One of two sets of data, in each other."""
    source = Scenes.make_two_sets()[number]
    return source, Scenes.show(source, view, isovalues=(120.0, Scenes.ISOVALUE), **settings)


def count_selected(source):
    """In all processes."""
    append = AppendDatasets()
    merged = MergeBlocks(Input=ExtractSelection(Input=source), MergePoints=0)
    return servermanager.Fetch(merged, append, append).GetNumberOfPoints()


def write_expected():
    for number in range(2):
        view = make_view()
        show_set(number, view, Opacity=0.4)
        write_picture(f"set_{number}", view)
        Delete(view)
    for name, opacity in (("translucent", 0.4), ("opaque", 1.0)):
        view = make_view()
        for number in range(2):
            show_set(number, view, Opacity=opacity)
        write_picture(name, view)
        Delete(view)


def edit():
    view = make_view()
    (first, one), (second, other) = (show_set(number, view, Opacity=0.4) for number in range(2))
    write_picture("begin", view)
    other.Visibility = 0
    write_picture("hidden", view)
    other.Visibility = 1
    write_picture("shown", view)
    one.Opacity = other.Opacity = 1.0
    write_picture("made_opaque", view)
    one.Opacity = other.Opacity = 0.4
    write_picture("made_translucent", view)
    # Another representation of the same data has no part in the picture.
    other.SetRepresentationType("Outline")
    write_picture("outline", view)
    other.SetRepresentationType(Scenes.REPRESENTATION)
    write_picture("no_outline", view)
    # The camera is set by the first Render.
    Render(view)
    Scenes.place_camera(view)
    # Selections find the nearest of both.
    SelectSurfacePoints(Rectangle=[60, 60, 180, 180], View=view)
    for source in (first, second):
        print(f"{count_selected(source)} points are selected")
        ClearSelection(source)
    write_picture("after_selection", view)
    Delete(one)
    write_picture("deleted", view)
    Delete(other)
    write_picture("empty", view)
    # The same data in a view of their own, of another size.
    small = make_view()
    small.ViewSize = [120, 90]
    for source in (first, second):
        Show(source, small).SetRepresentationType(Scenes.REPRESENTATION)
    write_picture("small", small)
    Delete(small)


write_expected()
edit()
