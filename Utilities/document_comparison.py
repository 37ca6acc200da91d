#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write the results of vtkIsosurfaceCompare into Documentation/comparison.md.

    document_comparison.py table.json report/report.html

replaces the part of the page between the two comments that name this program, and the plots
Documentation/images/comparison-*.png. Check afterwards that the text around it still holds.
"""

import base64
import re

from document_parts import (
    format_number,
    markdown_table,
    parse_arguments,
    read_json,
    replace_part,
)

# The beginning of the caption in the report, the file, the caption in the page.
PLOTS = (
    ("The times of the table", "comparison-times.png", "Seconds for a picture"),
    ("Above 1, rays", "comparison-crossover.png", "How many times as long triangles take as rays"),
)


def number(value, factor=1.0):
    return "–" if value is None else format_number(factor * value)


def rows_of(measured, columns):
    return [
        [row["Method"], *(number(row[name], factor) for name, factor in columns)]
        for row in measured["rows"]
    ]


def crossover_rows(measured):
    for crossover in measured["crossovers"]:
        sides = (crossover["triangles"], crossover["rays"])
        yield [
            " x ".join(map(str, crossover["dimensions"])),
            *(number(side[which], 1e3) for side in sides for which in ("first", "next")),
            crossover["verdict"],
            crossover["verdictIfDrawingWereFree"],
        ]


def write_plots(html, images):
    for caption, file_name, _ in PLOTS:
        found = re.search(rf'alt="{caption}[^"]*" src="data:image/png;base64,([^"]*)"', html)
        (images / file_name).write_bytes(base64.b64decode(found.group(1)))


def describe(measured):
    yield f"    {measured['command']}\n\n{measured['machine']}; repeats: {measured['repeats']}.\n\n"
    times = ["Build", "Extraction", "FirstPicture", "NextPicture", "NewIsovaluePicture"]
    yield markdown_table(
        ["ms", "build", "extraction", "first picture", "next picture", "new isovalue"],
        rows_of(measured, [(f"{name}Time", 1e3) for name in times]),
    )
    yield markdown_table(
        ["", "triangles", "memory, MB", "peak growth, MB", "distance, cells: median", "99 %", "max"]
        + ["normal error, degrees: median", "different pixels", "ambiguous cells", "different topology"],
        rows_of(
            measured,
            [("Triangles", 1), ("Bytes", 1e-6), ("PeakBytes", 1e-6)]
            + [(f"{share}DistanceInCells", 1) for share in ("Median", "P99", "Maximum")]
            + [("MedianNormalError", 1), ("DifferentPixels", 1)]
            + [("AmbiguousCells", 1), ("TopologyDifferences", 1)],
        ),
    )
    yield markdown_table(
        ["samples", "triangles, ms: new isovalue", "next picture", "rays, ms: new isovalue"]
        + ["next picture", "faster here", "if drawing triangles took no time"],
        crossover_rows(measured),
    )
    for _, file_name, caption in PLOTS:
        yield f"![{caption}](images/{file_name})\n\n"


def main():
    arguments = parse_arguments(__doc__, "table", "report")
    write_plots(
        arguments.report.read_text(encoding="utf-8"), arguments.documentation / "images"
    )
    text = "".join(describe(read_json(arguments.table)))
    replace_part(arguments.documentation / "comparison.md", "document_comparison.py", text)


if __name__ == "__main__":
    main()
