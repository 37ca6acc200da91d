# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Edits as the display panel does, takes it back and makes it again: pvbatch DrawUndo.py FOLDER"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import SaveScreenshot  # noqa: E402
from paraview.modules.vtkRemotingServerManager import (  # noqa: E402
    vtkSMProxyManager,
    vtkSMUndoStack,
    vtkSMUndoStackBuilder,
)

import Scenes  # noqa: E402


def write_picture(name):
    SaveScreenshot(os.path.join(sys.argv[1], f"{name}.png"), view)


# As ParaView's window does: before there is anything.
stack, builder = vtkSMUndoStack(), vtkSMUndoStackBuilder()
builder.SetUndoStack(stack)
vtkSMProxyManager.GetProxyManager().SetUndoStackBuilder(builder)

view = Scenes.make_view()
display = Scenes.trilinear(view)
write_picture("before_edit")
builder.Begin("Edit")
display.Isovalues = [190.0]
display.IsosurfaceInterpolation = "Nearest"
builder.End()
builder.PushToStack()
write_picture("edited")
stack.Undo()
display.UpdateVTKObjects()  # as ParaView's window does
write_picture("undone")
stack.Redo()
display.UpdateVTKObjects()
write_picture("redone")
vtkSMProxyManager.GetProxyManager().SetUndoStackBuilder(None)
