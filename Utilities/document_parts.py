# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared by the programs document_*.py: tables in Markdown, plots as PNG, parts of pages."""

import argparse
import json
import math
from pathlib import Path

import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401, for its factories
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY, vtkPlotPoints
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkViewsContext2D import vtkContextView

# Colours that are distinct on white, for colour-blind readers too.
COLORS = (
    (0, 0, 0), (230, 25, 75), (0, 130, 200), (245, 130, 48), (60, 180, 75), (145, 30, 180),
    (70, 200, 220), (128, 128, 0), (170, 110, 40), (128, 128, 128), (240, 50, 230), (0, 0, 128),
)  # fmt: skip
MARKERS = (vtkPlotPoints.SQUARE, vtkPlotPoints.CIRCLE, vtkPlotPoints.DIAMOND)
ENVIRONMENT = ("machine", "load of the machine before", "compiler", "VTK", "Embree", "OpenGL", "volume")


def parse_arguments(description, *names):
    """The arguments of a program; each name is that of a file, a name with + of several."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--documentation",
        type=Path,
        default=Path(__file__).resolve().parents[1] / "Documentation",
        help="the folder with the page and its images (default: that of this source)",
    )
    for name in names:
        parser.add_argument(name.strip("+"), type=Path, nargs="+" if name.endswith("+") else None)
    return parser.parse_args()


def read_json(path):
    return json.loads(path.read_text(encoding="utf-8"))


def replace_part(page, program, text):
    """Replaces the text between the two comments of the page that name the program."""
    begin = f"<!-- Utilities/{program} writes from here -->\n"
    end = "<!-- to here -->\n"
    head, rest = page.read_text(encoding="utf-8").split(begin)
    _, tail = rest.split(end, maxsplit=1)
    page.write_text(f"{head}{begin}\n{text}{end}{tail}", encoding="utf-8")


def format_number(value, digits=3):
    """A number of significant digits, at least all before the point; empty for None."""
    if value is None:
        return ""
    return f"{value:.0f}" if abs(value) >= 10**digits else f"{value:.{digits}g}"


def format_cell(value):
    """A text, a number, or the median of samples with their range in brackets."""
    if isinstance(value, str):
        return value
    if not isinstance(value, dict):
        return format_number(value)
    median, low, high = (format_number(value[name]) for name in ("median", "minimum", "maximum"))
    return median if value["count"] == 1 else f"{median} ({low}-{high})"


def markdown_table(titles, rows):
    first, *others = [f"| {' | '.join(line)} |\n" for line in (titles, *rows)]
    return "".join([first, f"|{'---|' * len(titles)}\n", *others]) + "\n"


def environment_sentence(environment):
    """The circumstances of a measurement."""
    said = [f"{name}: {environment[name]}" for name in ENVIRONMENT if name in environment]
    said += [f"absent: {name}" for name in environment.get("absent", [])]
    return f"Measured on {environment['date']}, {'; '.join(said)}."


def decades(values):
    """The powers of ten below and above all values."""
    logarithms = [math.log10(value) for value in values]
    return 10.0 ** math.floor(min(logarithms) - 0.05), 10.0 ** math.ceil(max(logarithms) + 0.05)


def write_picture(window, path):
    """Writes the picture of a window, as PNG."""
    window.Render()
    pixels = vtkWindowToImageFilter()
    pixels.SetInput(window)
    pixels.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(pixels.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()


def set_logarithmic_axis(axis, title, low, high):
    axis.SetTitle(title)
    axis.LogScaleOn()
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetUnscaledRange(low, high)
    axis.GetTitleProperties().SetFontSize(16)
    axis.GetLabelProperties().SetFontSize(14)
    axis.SetGridVisible(True)
    if high / low > 1e9:  # A label for every decade, side by side.
        axis.SetNotation(vtkAxis.SCIENTIFIC_NOTATION)
        axis.SetPrecision(0)
        axis.GetLabelProperties().SetFontSize(11)


def add_curve(chart, name, points, number, has_markers):
    table = vtkTable()
    for title, values in zip(("x", name), zip(*points)):
        column = vtkDoubleArray()
        column.SetName(title)
        for value in values:
            column.InsertNextValue(value)
        table.AddColumn(column)
    plot = chart.AddPlot(vtkChart.LINE if len(points) > 1 else vtkChart.POINTS)
    plot.SetInputData(table, 0, 1)
    plot.SetColor(*COLORS[number % len(COLORS)], 255)
    plot.SetWidth(2.0)
    plot.SetMarkerStyle(MARKERS[number % len(MARKERS)] if has_markers else vtkPlotPoints.NONE)
    plot.SetMarkerSize(11.0)


def write_chart(path, title, x_axis, y_axis, curves, has_markers=True):
    """Curves (name: points) on logarithmic axes (title, lowest, highest)."""
    view = vtkContextView()
    view.GetRenderer().SetBackground(1.0, 1.0, 1.0)
    window = view.GetRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(1000, 650)
    chart = vtkChartXY()
    view.GetScene().AddItem(chart)
    chart.SetTitle(title)
    chart.GetTitleProperties().SetFontSize(18)
    chart.SetShowLegend(True)
    chart.GetLegend().SetLabelSize(14)
    chart.GetLegend().SetInline(False)
    for number, (name, points) in enumerate(curves.items()):
        if points:
            add_curve(chart, name, points, number, has_markers)
    set_logarithmic_axis(chart.GetAxis(vtkAxis.BOTTOM), *x_axis)
    set_logarithmic_axis(chart.GetAxis(vtkAxis.LEFT), *y_axis)
    write_picture(window, path)
