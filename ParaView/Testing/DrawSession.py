# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Does what users do, and writes pictures and states that TestSession.py compares: pvbatch DrawSession.py FOLDER"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import (  # noqa: E402
    Calculator,
    ColorBy,
    CompositeKeyFrame,
    GetAnimationScene,
    GetAnimationTrack,
    HideUnusedScalarBars,
    ProgrammableSource,
    Render,
    SaveScreenshot,
    SaveState,
    Show,
)
from paraview import smstate, smtrace  # noqa: E402

import Scenes  # noqa: E402

FOLDER = sys.argv[1]


def write_picture(name, view, **options):
    SaveScreenshot(os.path.join(FOLDER, f"{name}.png"), view, **options)


def first_apply():
    view = Scenes.make_view()
    Show(Scenes.make_wavelet(), view).SetRepresentationType(Scenes.REPRESENTATION)
    write_picture("first_apply", view)


def states_and_sizes():
    view = Scenes.make_view()
    Scenes.clipped(view)
    write_picture("still", view)
    write_picture("large", view, ImageResolution=[400, 300])
    view.SMProxy.InteractiveRender()
    view.UseInteractiveRenderingForScreenshots = 1
    write_picture("interactive", view)
    view.UseInteractiveRenderingForScreenshots = 0
    SaveState(os.path.join(FOLDER, "state.pvsm"))
    # SaveState of a script writes no Python; the window does it so.
    with open(os.path.join(FOLDER, "state.py"), "w") as file:
        file.write(smstate.get_state())


def trace():
    """Edits as the display panel makes them, inside an item of the trace."""
    view = Scenes.make_view()
    wavelet = Scenes.make_wavelet()
    smtrace.start_trace()
    display = Show(wavelet, view)
    display.SetRepresentationType(Scenes.REPRESENTATION)
    edit = smtrace._create_trace_item_internal("PropertiesModified", kwargs={"proxy": display.SMProxy})
    display.Isovalues = [150.0, 190.0]
    display.IsosurfaceInterpolation = "Cubic"
    edit.finalize()
    with open(os.path.join(FOLDER, "trace.py"), "w") as file:
        file.write(smtrace.stop_trace())


def animation():
    view = Scenes.make_view()
    display = Scenes.show(Scenes.make_wavelet(), view, isovalues=(150.0,))
    write_picture("isovalue_150", view)
    scene = GetAnimationScene()
    scene.PlayMode = "Sequence"
    scene.NumberOfFrames = 3
    scene.StartTime, scene.EndTime = 0.0, 1.0
    track = GetAnimationTrack("Isovalues", index=0, proxy=display)
    track.KeyFrames = [
        CompositeKeyFrame(KeyTime=0.0, KeyValues=[100.0], Interpolation="Ramp"),
        CompositeKeyFrame(KeyTime=1.0, KeyValues=[200.0]),
    ]
    for name, time in (("start", 0.0), ("middle", 0.5)):
        scene.AnimationTime = time
        write_picture(f"animated_{name}", view)


def time_series():
    view = Scenes.make_view()
    source = ProgrammableSource(OutputDataSetType="vtkImageData")
    source.ScriptRequestInformation = """
information = self.GetOutputInformation(0)
information.Set(self.GetExecutive().WHOLE_EXTENT(), -12, 12, -12, 12, -12, 12)
information.Set(self.GetExecutive().TIME_STEPS(), [0.0, 1.0], 2)
information.Set(self.GetExecutive().TIME_RANGE(), [0.0, 1.0], 2)
"""
    source.Script = """
import numpy
time = self.GetOutputInformation(0).Get(self.GetExecutive().UPDATE_TIME_STEP())
output.SetExtent(-12, 12, -12, 12, -12, 12)
z, y, x = numpy.meshgrid(*[numpy.arange(-12.0, 13.0)] * 3, indexing="ij")
output.PointData.append((x ** 2 + y ** 2 * (1.0 + time) + z ** 2).ravel(), "RTData")
"""
    Scenes.show(source, view, isovalues=(100.0,))
    for time in (0, 1):
        view.ViewTime = float(time)
        write_picture(f"time_{time}", view)


def refinement():
    view = Scenes.make_view()
    view.UseFXAA = 0
    display = Scenes.show(Scenes.make_wavelet(), view)
    Render(view)
    write_picture("unrefined", view)
    display.IsosurfaceProgressiveRefinement = 1
    for _ in range(16):
        Render(view)
    write_picture("refined", view)


def scalar_bar():
    view = Scenes.make_view()
    display = Scenes.colored_by_isovalue(view)
    write_picture("without_bar", view)
    display.SetScalarBarVisibility(view, True)
    HideUnusedScalarBars(view)
    write_picture("with_bar", view)


def vectors():
    """Coloured by what the colour map shows of vectors, and by arrays of that; contoured by their magnitude, too."""
    view = Scenes.make_view()
    source = Scenes.make_wavelet()
    functions = {
        "along": "(25 + coordsY) * (0.6 * iHat + 0.8 * jHat)",
        "length": "25 + coordsY",
        "around": "coordsX * iHat + coordsY * jHat + coordsZ * kHat",
        "height": "coordsY",
    }
    for name, function in functions.items():
        source = Calculator(Input=source, ResultArrayName=name, Function=function)
    display = Scenes.show(source, view)

    def write_colored(name, *array):
        ColorBy(display, ("POINTS", *array))
        display.LookupTable.RescaleTransferFunction(-10.0, 40.0)
        write_picture(f"colored_by_{name}", view)

    write_colored("length", "length")
    write_colored("magnitude", "along", "Magnitude")
    display.IsosurfaceArray = ["POINTS", "around"]
    display.IsosurfaceComponent = 3
    display.Isovalues = [11.0]
    write_colored("height", "height")
    write_colored("component", "around", "Y")
    write_colored("isovalue", "around", "Magnitude")


# The state files have what there is then.
states_and_sizes()
first_apply()
trace()
animation()
time_series()
refinement()
scalar_bar()
vectors()
