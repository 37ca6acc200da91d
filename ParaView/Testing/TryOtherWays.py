# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tries what the table "What works" of Documentation/paraview.md says of ParaView's own ways to show isosurfaces:
pvbatch TryOtherWays.py FOLDER

They are the filter Contour, and the representation Volume with the blend mode Isosurface. Writes a picture of each
trial, and prints what pictures do not show; ParaView prints errors of its own. With pvpython, and SERVER_PORT in the
environment, the pvserver that listens there draws them.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import (  # noqa: E402
    Calculator,
    CellDatatoPointData,
    CompositeKeyFrame,
    Connect,
    Contour,
    Delete,
    GetActiveViewOrCreate,
    GetAnimationScene,
    GetAnimationTrack,
    GroupDatasets,
    LoadState,
    PointDatatoCellData,
    Render,
    ResetSession,
    SaveScreenshot,
    SaveState,
    SelectSurfacePoints,
    Show,
    Wavelet,
)

import Scenes  # noqa: E402


def contour(source, view, array=Scenes.POINTS, isovalues=(Scenes.ISOVALUE,), **settings):
    surface = Contour(Input=source, ContourBy=list(array), Isosurfaces=list(isovalues))
    display = Show(surface, view)
    display.ColorArrayName = ["POINTS", ""]
    for name, value in settings.items():
        setattr(display, name, value)
    return display


def volume(source, view, array=Scenes.POINTS, isovalues=(Scenes.ISOVALUE,), **settings):
    display = Show(source, view)
    display.SetRepresentationType("Volume")
    display.BlendMode = "Isosurface"
    display.IsosurfaceValues = list(isovalues)
    display.Shade = 1
    table = Scenes.color_by(display, *array)
    table.RescaleTransferFunction(100.0, 220.0)
    table.ScalarOpacityFunction.Points = [100.0, 1.0, 0.5, 0.0, 220.0, 1.0, 0.5, 0.0]
    for name, value in settings.items():
        setattr(display, name, value)
    return display


def plain(show, view):
    return show(Scenes.make_wavelet(), view)


def composite_data(show, view):
    return show(GroupDatasets(Input=Scenes.make_blocks()), view)


def composite_images(show, view):
    halves = [Wavelet(WholeExtent=[-12, 12, low, high, -12, 12]) for low, high in ((-12, 0), (0, 12))]
    return show(GroupDatasets(Input=halves, BlockNames=["Wavelet1", "Wavelet2"]), view)


def one_block(show, view):
    display = composite_images(show, view)
    display.BlockSelectors = ["/Root/Wavelet1"]
    return display


def sets_of_data(show, view):
    for source in Scenes.make_two_sets():
        display = show(source, view, isovalues=(120.0, Scenes.ISOVALUE), Opacity=0.4)
    return display


def sets_of_images(show, view):
    for source in (Scenes.make_wavelet(), Scenes.make_two_sets()[1]):
        display = show(source, view)
    return display


def cells(show, view):
    """The filter Contour reads arrays of cells beyond their end: it takes those of points alone."""
    source = PointDatatoCellData(Input=Scenes.make_wavelet(), ProcessAllArrays=1)
    return show(source, view, array=Scenes.CELLS) if show is volume else None


def cells_to_points(show, view):
    source = PointDatatoCellData(Input=Scenes.make_wavelet(), ProcessAllArrays=1)
    return show(CellDatatoPointData(Input=source, ProcessAllArrays=1), view)


def amr(show, view):
    view.CameraPosition = [2.0, 2.0, 6.0]
    view.CameraFocalPoint = [-0.75, -0.75, 1.25]
    points = CellDatatoPointData(Input=Scenes.make_pulse(), ProcessAllArrays=1)
    return show(points, view, array=("POINTS", "Gaussian-Pulse"), isovalues=(0.2,))


def another_array(show, view):
    source = Calculator(Input=Scenes.make_wavelet(), ResultArrayName="height", Function="coordsY")
    display = show(source, view)
    Scenes.color_by(display, "POINTS", "height").RescaleTransferFunction(-12.0, 12.0)
    return display


def selection(show, view):
    display = show(Scenes.make_wavelet(), view)
    Render(view)
    SelectSurfacePoints(Rectangle=[60, 60, 180, 180], View=view)
    selected = display.Input.SMProxy.GetSelectionInput(0)
    print("something is selected" if selected else "nothing is selected")
    return display


def animation(show, view):
    """The isovalue 182.5, in the middle."""
    display = show(Scenes.make_wavelet(), view)
    proxy, name = (display.Input, "ContourValues") if show is contour else (display, "IsosurfaceValues")
    scene = GetAnimationScene()
    scene.PlayMode, scene.NumberOfFrames, scene.StartTime, scene.EndTime = "Sequence", 3, 0.0, 1.0
    track = GetAnimationTrack(name, index=0, proxy=proxy)
    track.KeyFrames = [
        CompositeKeyFrame(KeyTime=0.0, KeyValues=[165.0], Interpolation="Ramp"),
        CompositeKeyFrame(KeyTime=1.0, KeyValues=[200.0]),
    ]
    scene.AnimationTime = 0.5
    return display


TRIALS = (
    plain,
    composite_data,
    composite_images,
    one_block,
    sets_of_data,
    sets_of_images,
    cells,
    cells_to_points,
    amr,
    another_array,
    selection,
    animation,
)
if "SERVER_PORT" in os.environ:
    Connect("localhost", int(os.environ["SERVER_PORT"]))
for trial in TRIALS:
    for way in (contour, volume):
        print(f"== {trial.__name__}, {way.__name__}", flush=True)
        view = Scenes.make_view()
        try:
            trial(way, view)
            SaveScreenshot(os.path.join(sys.argv[1], f"{trial.__name__}-{way.__name__}.png"), view)
        except AttributeError as problem:  # a property that this representation does not have
            print(problem, flush=True)
        Delete(view)
if "SERVER_PORT" not in os.environ:
    for way in (contour, volume):
        ResetSession()
        plain(way, Scenes.make_view())
        state = os.path.join(sys.argv[1], f"{way.__name__}.pvsm")
        SaveState(state)
        ResetSession()
        LoadState(state)
        SaveScreenshot(os.path.join(sys.argv[1], f"state-{way.__name__}.png"), GetActiveViewOrCreate("RenderView"))
