#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Put what vtkIsosurfaceCompare measured into Documentation/comparison.md.

    document_comparison.py table.json report/report.html

replaces what is between the two lines of the page that name this program, and the plots
Documentation/images/comparison-*.png. What the page says around them must be read again by a human.
"""

import base64
import json
import re
import sys
from pathlib import Path

DOCUMENTATION = Path(__file__).parents[1] / "Documentation"
PAGE = DOCUMENTATION / "comparison.md"
BEGIN = "<!-- Utilities/document_comparison.py writes from here -->\n"
END = "<!-- to here -->\n"
# The beginning of the caption in the report, the file, the caption in the page.
PLOTS = (
    ("The times of the table", "comparison-times.png", "Seconds for a picture"),
    ("Below a curve rays", "comparison-crossover.png", "Up to how many pictures rays win"),
)


def number(value, factor=1.0):
    """Three digits, as in the report."""
    if value is None:
        return "–"
    value *= factor
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.3g}"


def table(titles, rows):
    lines = [titles, ["---"] * len(titles), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines) + "\n"


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


def write_plots(html):
    for caption, file_name, _ in PLOTS:
        found = re.search(rf'alt="{caption}[^"]*" src="data:image/png;base64,([^"]*)"', html)
        (DOCUMENTATION / "images" / file_name).write_bytes(base64.b64decode(found.group(1)))


def describe(measured):
    yield f"    {measured['command']}\n\n{measured['machine']}; repeats: {measured['repeats']}.\n\n"
    times = ["Build", "Extraction", "FirstPicture", "NextPicture", "NewIsovaluePicture"]
    yield table(
        ["ms", "build", "extract", "first picture", "next picture", "new isovalue"],
        rows_of(measured, [(f"{name}Time", 1e3) for name in times]),
    )
    yield table(
        ["", "triangles", "kept, MB", "rise of RAM, MB", "cells off: median", "99 %", "max"]
        + ["normals off, degrees: median", "pixels that differ", "ambiguous cells", "of other topology"],
        rows_of(
            measured,
            [("Triangles", 1), ("Bytes", 1e-6), ("PeakBytes", 1e-6)]
            + [(f"{share}DistanceInCells", 1) for share in ("Median", "P99", "Maximum")]
            + [("MedianNormalError", 1), ("DifferentPixels", 1)]
            + [("AmbiguousCells", 1), ("TopologyDifferences", 1)],
        ),
    )
    yield table(
        ["samples", "triangles, ms: new isovalue", "next picture", "rays, ms: new isovalue"]
        + ["next picture", "less time here", "if triangles were drawn in no time"],
        crossover_rows(measured),
    )
    for _, file_name, caption in PLOTS:
        yield f"![{caption}](images/{file_name})\n\n"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    measured = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    write_plots(Path(sys.argv[2]).read_text(encoding="utf-8"))
    head, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    _, tail = rest.split(END)
    PAGE.write_text(f"{head}{BEGIN}\n{''.join(describe(measured))}{END}{tail}", encoding="utf-8")


if __name__ == "__main__":
    main()
