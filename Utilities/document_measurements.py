#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write the results of vtkIsosurfaceBenchmark, vtkIsosurfaceMeshBenchmark and
vtkIsosurfaceBlocksBenchmark into Documentation/measurements.md.

    document_measurements.py cranium.json large.json growth.json

replaces the text below the commands of the page that write files of these names. Check afterwards
that the text around it still holds."""

import re
import sys
from pathlib import Path

from document_parts import (
    environment_list,
    format_cell,
    format_number,
    markdown_table,
    parse_arguments,
    read_json,
)

# What is required to measure each of the goals of a program.
NEEDS = {
    "vtkIsosurfaceBenchmark": {
        1: "the baseline embree",
        2: "the baseline polygons",
        3: "--goals",
        4: "--input",
        5: "--goals and a display",
        6: "--threads 1 and more, --goals",
        7: "--growth",
    },
    "vtkIsosurfaceMeshBenchmark": {
        1: "Embree",
        2: "a display",
        3: "a display",
        4: "a display",
        5: "--shapes hexahedra",
    },
    "vtkIsosurfaceBlocksBenchmark": {
        1: "a display",
    },
}


def goal_rows(measured):
    program = Path(measured["environment"]["command"].split()[0]).name
    for number, needs in NEEDS[program].items():
        found = [goal for goal in measured["goals"] if goal["goal"] == number]
        for goal in found:
            limit, value = goal["limit"], goal["measured"]
            is_met = value <= limit if goal["atMost"] else value >= limit
            yield [
                str(number),
                goal["what"],
                f"{'at most' if goal['atMost'] else 'at least'} {format_number(limit)}",
                format_number(value),
                "met" if is_met else "**missed**",
            ]
        if not found:
            yield [str(number), f"not measured, which needs {needs}", "", "", ""]


def describe(measured):
    yield environment_list(measured["environment"])
    yield (
        "Times are medians, in brackets the fastest and the slowest; ratios are medians of the "
        "ratios of\nmeasurements taken in turn.\n\n### Goals\n\n"
    )
    yield markdown_table(["goal", "what", "target", "measured", ""], goal_rows(measured))
    for table in measured["tables"]:
        yield f"### {table['title']}\n\n" + (f"{table['note']}\n\n" if table["note"] else "")
        rows = [[format_cell(row[name]) for name in table["columns"]] for row in table["rows"]]
        yield markdown_table(table["columns"], rows)


def main():
    arguments = parse_arguments(__doc__, "results+")
    path = arguments.documentation / "measurements.md"
    page = path.read_text(encoding="utf-8")
    for results in arguments.results:
        command = re.escape(f"--json {results.name}\n\n")
        place = re.search(rf"(?<={command})- date:.*?(?=\n## |\Z)", page, flags=re.DOTALL)
        if place is None:
            sys.exit(f"{path} has no command that writes {results.name}.")
        text = "".join(describe(read_json(results))).rstrip() + "\n"
        page = page[: place.start()] + text + page[place.end() :]
    path.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
