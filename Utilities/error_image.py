# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The errors of pixels as colours: document_accuracy.py makes pictures of .vti files by this."""

import math

from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageMagnify, vtkImageMapToColors
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor2D,
    vtkColorTransferFunction,
    vtkImageMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
)

from document_parts import write_picture

PANELS_IN_ROW = 4
SMALLEST_PANEL = 512
GAP, TITLE_HEIGHT, LEGEND_HEIGHT = 8, 36, 110
# What is drawn is the power of ten of the error, in this range; what is not an error is out of it.
LOWEST, HIGHEST = -16.0, 0.0
MISJUDGED, UNKNOWN, NOTHING = (1.0, 0.0, 0.0), (0.75, 0.55, 0.85), (0.5, 0.5, 0.5)


def new_colors():
    colors = vtkColorTransferFunction()
    colors.AddRGBPoint(LOWEST, 0.0, 0.0, 0.1)
    colors.AddRGBPoint(-12.0, 0.1, 0.1, 0.6)
    colors.AddRGBPoint(-8.0, 0.0, 0.6, 0.6)
    colors.AddRGBPoint(-5.0, 0.2, 0.8, 0.2)
    colors.AddRGBPoint(-2.0, 1.0, 0.9, 0.2)
    colors.AddRGBPoint(HIGHEST, 1.0, 1.0, 1.0)
    colors.SetNanColor(*NOTHING)
    colors.SetAboveRangeColor(*MISJUDGED)
    colors.UseAboveRangeColorOn()
    colors.SetBelowRangeColor(*UNKNOWN)
    colors.UseBelowRangeColorOn()
    return colors


def exponent(error):
    """NaN where nothing is and was found; infinite where something was missed or invented; below
    the range where the error is not known."""
    if error < 0.0:
        return LOWEST - 1.0
    return error if math.isinf(error) else min(HIGHEST, math.log10(max(10.0**LOWEST, error)))


def new_panel(errors, dimensions, scale, colors):
    """The colours of errors, as an image."""
    exponents = vtkFloatArray()
    for i in range(errors.GetNumberOfValues()):
        error = errors.GetValue(i)
        exponents.InsertNextValue(error if math.isnan(error) else exponent(error))
    image = vtkImageData()
    image.SetDimensions(dimensions)
    image.GetPointData().SetScalars(exponents)
    colored = vtkImageMapToColors()
    colored.SetInputData(image)
    colored.SetLookupTable(colors)
    colored.SetOutputFormatToRGB()
    magnified = vtkImageMagnify()
    magnified.SetInputConnection(colored.GetOutputPort())
    magnified.SetMagnificationFactors(scale, scale, 1)
    magnified.Update()
    return magnified.GetOutput()


def add_image(renderer, image, x, y):
    mapper = vtkImageMapper()
    mapper.SetInputData(image)
    mapper.SetColorWindow(255.0)
    mapper.SetColorLevel(127.5)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.SetPosition(x, y)
    renderer.AddViewProp(actor)


def add_text(renderer, text, x, y, color=(0.0, 0.0, 0.0)):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetPosition(x, y)
    actor.GetTextProperty().SetFontSize(24)
    actor.GetTextProperty().SetColor(color)
    renderer.AddViewProp(actor)


def add_legend(renderer, colors):
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetOrientationToHorizontal()
    bar.SetNumberOfLabels(9)
    bar.SetLabelFormat("1e%.0f")
    bar.UnconstrainedFontSizeOn()
    text = bar.GetLabelTextProperty()
    text.SetFontSize(20)
    text.SetColor(0.0, 0.0, 0.0)
    text.ShadowOff()
    text.ItalicOff()
    for coordinate, place in (
        (bar.GetPositionCoordinate(), (260.0, 0.0)),
        (bar.GetPosition2Coordinate(), (800.0, 90.0)),
    ):
        coordinate.SetCoordinateSystemToDisplay()
        coordinate.SetValue(*place)
    renderer.AddViewProp(bar)
    add_text(renderer, "error, cells", GAP, 40)
    add_text(renderer, "missed or invented", 1130, 40, MISJUDGED)
    add_text(renderer, "nothing there", 1380, 40, NOTHING)
    add_text(renderer, "seen, distance not known", 1580, 40, UNKNOWN)


def write_error_image(vti, path):
    """A panel for each array of the file, and a legend."""
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(vti))
    reader.Update()
    dimensions = reader.GetOutput().GetDimensions()
    arrays = reader.GetOutput().GetPointData()
    scale = max(1, SMALLEST_PANEL // dimensions[0])
    edge = scale * dimensions[0]
    rows = math.ceil(arrays.GetNumberOfArrays() / PANELS_IN_ROW)
    colors = new_colors()
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    for i in range(arrays.GetNumberOfArrays()):
        x = i % PANELS_IN_ROW * (edge + GAP)
        y = LEGEND_HEIGHT + (rows - 1 - i // PANELS_IN_ROW) * (edge + TITLE_HEIGHT)
        add_image(renderer, new_panel(arrays.GetArray(i), dimensions, scale, colors), x, y)
        add_text(renderer, arrays.GetArrayName(i), x + GAP, y + edge + GAP)
    add_legend(renderer, colors)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(
        PANELS_IN_ROW * (edge + GAP) - GAP, LEGEND_HEIGHT + rows * (edge + TITLE_HEIGHT)
    )
    window.AddRenderer(renderer)
    write_picture(window, path)
