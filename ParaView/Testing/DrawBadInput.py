# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what cannot be shown, beside a sphere: pvbatch DrawBadInput.py KIND PICTURE"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import (  # noqa: E402
    Cone,
    PassArrays,
    ProgrammableFilter,
    ProgrammableSource,
    SaveScreenshot,
    Show,
    Sphere,
)

import Scenes  # noqa: E402


def no_array(view):
    Scenes.show(PassArrays(Input=Scenes.make_wavelet()), view)


def polygons(view):
    Scenes.show(Cone(), view)


def missing_color_array(view):
    display = Scenes.show(Scenes.make_wavelet(), view)
    Scenes.color_by(display, "POINTS", "absent")


def outside_range(view):
    Scenes.show(Scenes.make_wavelet(), view, isovalues=(1e6,))


def no_light(view):
    view.UseLight = 0  # the Light Kit
    Scenes.show(Scenes.make_wavelet(), view)


def fails_to_read(view):
    """In the last process."""
    source = ProgrammableFilter(Input=Scenes.make_wavelet(), OutputDataSetType="Same as Input")
    source.Script = """
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
    raise RuntimeError("this process cannot read")
self.GetOutputDataObject(0).ShallowCopy(self.GetInputDataObject(0, 0))
"""
    Scenes.show(source, view)
    SaveScreenshot(picture, view)
    Scenes.show(source, view, Opacity=0.5)


def missing_in_a_time_step(view):
    """The array that is contoured is missing at the time 1; the other time steps are as they would be without it."""
    source = ProgrammableSource(OutputDataSetType="vtkImageData")
    source.ScriptRequestInformation = """
information = self.GetOutputInformation(0)
information.Set(self.GetExecutive().WHOLE_EXTENT(), -12, 12, -12, 12, -12, 12)
information.Set(self.GetExecutive().TIME_STEPS(), [0.0, 1.0, 2.0], 3)
information.Set(self.GetExecutive().TIME_RANGE(), [0.0, 2.0], 2)
"""
    source.Script = """
import numpy
time = self.GetOutputInformation(0).Get(self.GetExecutive().UPDATE_TIME_STEP())
output.SetExtent(-12, 12, -12, 12, -12, 12)
z, y, x = numpy.meshgrid(*[numpy.arange(-12.0, 13.0)] * 3, indexing="ij")
values = (x ** 2 + y ** 2 + z ** 2).ravel()
# Of another type at the time 2.
output.PointData.append(values if time < 2.0 else numpy.float32(values), "absent" if time == 1.0 else "RTData")
"""
    Scenes.show(source, view, isovalues=(121.0,))
    for time in (0.0, 1.0, 2.0):
        view.ViewTime = time
        SaveScreenshot(f"{picture}-{time:.0f}.png", view)


kind, picture = sys.argv[1:]
view = Scenes.make_view()
Show(Sphere(Radius=10.0), view)
globals()[kind](view)
SaveScreenshot(picture, view)
