# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Selects in the middle of a scene, and prints where the points and cells are, how many a table of them has, and what
is told of the point and of the cell under the mouse there: pvbatch SelectInScene.py SCENE"""

import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import (  # noqa: E402
    AppendDatasets,
    CreateView,
    Delete,
    ExtractSelection,
    MergeBlocks,
    Render,
    SelectSurfaceCells,
    SelectSurfacePoints,
    Show,
)
from paraview import servermanager  # noqa: E402
from paraview.modules.vtkRemotingMisc import vtkSMTooltipSelectionPipeline  # noqa: E402
from vtkmodules.vtkCommonCore import reference, vtkCollection  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkDataObject  # noqa: E402

import Scenes  # noqa: E402

RECTANGLE = [60, 60, 180, 180]


def extract(source):
    """What is selected, from all processes."""
    append = AppendDatasets()
    merged = MergeBlocks(Input=ExtractSelection(Input=source), MergePoints=0)
    return servermanager.Fetch(merged, append, append)


def count_rows(source, association):
    """Of ParaView's table that shows selected elements alone."""
    table = CreateView("SpreadSheetView")
    Show(source, table)
    table.FieldAssociation = association
    table.SelectionOnly = 1
    Render(table)
    rows = table.SMProxy.GetClientSideObject().GetNumberOfRows()
    Delete(table)
    return rows


def middle(cell):
    low_high = cell.GetBounds()
    return [round(0.5 * (low_high[2 * k] + low_high[2 * k + 1]), 4) for k in range(3)]


def is_passed(grid, cell):
    """Whether a cell has values on both sides of the isovalue."""
    array = grid.GetPointData().GetArray("RTData")
    values = [array.GetValue(cell.GetPointId(i)) for i in range(cell.GetNumberOfPoints())]
    return min(values) < Scenes.ISOVALUE <= max(values)


def hover(select, association, view):
    """The tooltip that ParaView shows of what is under the mouse."""
    displays, selections, text = vtkCollection(), vtkCollection(), reference("")
    select([120, 120, 120, 120], displays, selections, 0)
    tooltips = vtkSMTooltipSelectionPipeline.GetInstance()
    tooltips.Show(displays.GetItemAsObject(0), selections.GetItemAsObject(0), view.SMProxy)
    tooltips.GetTooltipInfo(association, text)
    tooltips.Hide(view.SMProxy)
    return str(text)


view = Scenes.make_view()
display = getattr(Scenes, sys.argv[1])(view)
source = display.Input
Render(view)
SelectSurfacePoints(Rectangle=RECTANGLE, View=view)
points = extract(source)
rows_of_points = count_rows(source, "Point Data")
SelectSurfaceCells(Rectangle=RECTANGLE, View=view)
cells = extract(source)
rows_of_cells = count_rows(source, "Cell Data")
# Several processes may have a point; a cell is of one.
places = {tuple(round(x, 4) for x in points.GetPoint(i)) for i in range(points.GetNumberOfPoints())}
middles = [middle(cells.GetCell(i)) for i in range(cells.GetNumberOfCells())]
passed = sum(is_passed(cells, cells.GetCell(i)) for i in range(cells.GetNumberOfCells()))
point = hover(view.SMProxy.SelectSurfacePoints, vtkDataObject.FIELD_ASSOCIATION_POINTS, view)
cell = hover(view.SMProxy.SelectSurfaceCells, vtkDataObject.FIELD_ASSOCIATION_CELLS, view)
print(
    json.dumps(
        {
            "points": sorted(places),
            "cells": sorted(middles),
            "passed": passed,
            "extracted": [points.GetNumberOfPoints(), cells.GetNumberOfCells()],
            "rows": [rows_of_points, rows_of_cells],
            "point": point,
            "cell": cell,
        }
    )
)
