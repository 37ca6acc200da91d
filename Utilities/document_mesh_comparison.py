#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write the results of vtkIsosurfaceCompare with meshes into Documentation/comparison.md.

    document_mesh_comparison.py disk.json curvilinear.json fire.json

replaces the part of the page between the two comments that name this program. Check afterwards that
the text around it still holds.
"""

from document_comparison import number
from document_parts import markdown_table, parse_arguments, read_json, replace_part

COLUMNS = [
    "mesh, isovalue", "cells", "method", "extraction, ms", "first picture, ms", "new isovalue, ms",
    "triangles", "distance, cells: median", "99 %", "max", "isosurface alone, % of its pixels",
    "triangles alone, %",
]  # fmt: skip


def rows_of(measured):
    for row in measured["rows"]:
        share = 100.0 / row["CoveredPixels"] if row["CoveredPixels"] else 0.0
        yield [
            f"{measured['input']}, {number(row['Isovalue'])}",
            number(measured["cells"]),
            row["Method"],
            *(number(row[f"{name}Time"], 1e3) for name in ("Extraction", "FirstPicture", "NewIsovaluePicture")),
            number(row["Triangles"]),
            *(number(row[f"{name}DistanceInCells"]) for name in ("Median", "P99", "Maximum")),
            *(number(row[f"{name}AlonePixels"], share) for name in ("Isosurface", "Mesh")),
        ]  # fmt: skip


def main():
    arguments = parse_arguments(__doc__, "tables+")
    tables = [read_json(table) for table in arguments.tables]
    commands = "".join(f"    {table['command']}\n" for table in tables)
    text = f"{commands}\n{tables[0]['machine']}; repeats: {tables[0]['repeats']}.\n\n"
    text += markdown_table(COLUMNS, [row for table in tables for row in rows_of(table)])
    page = arguments.documentation / "comparison.md"
    replace_part(page, "document_mesh_comparison.py", text)


if __name__ == "__main__":
    main()
