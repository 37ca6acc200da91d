#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write the results of vtkIsosurfaceBenchmark, vtkIsosurfaceMeshBenchmark and
vtkIsosurfaceBlocksBenchmark into Documentation/tables.md.

    document_tables.py cranium.json large.json growth.json

replaces the text below the commands of the page that write files of these names. Check afterwards
that the text around it still holds."""

import re
import sys
from pathlib import Path

from document_parts import (
    environment_sentence,
    format_cell,
    format_number,
    markdown_table,
    parse_arguments,
    read_json,
)


def is_met(goal):
    if goal["atMost"]:
        return goal["measured"] <= goal["limit"]
    return goal["measured"] >= goal["limit"]


def format_goals(goals):
    """Those that differ in their threads alone, in one cell."""
    if not goals:
        return ""
    values = "; ".join(format_number(goal["measured"]) for goal in goals)
    limit = f"{'at most' if goals[0]['atMost'] else 'at least'} {format_number(goals[0]['limit'])}"
    return f"{values if all(map(is_met, goals)) else f'**{values}**'} ({limit})"


def goal_table(goals):
    """A row for each goal, a column for each subject, which the text of a goal names first."""
    rows = {}  # of a number and a text: goals by their subjects
    threads = {}  # of the same: numbers of them
    for goal in goals:
        subject, what, number = re.fullmatch(r"(.*?): (.*?)(?: on (\d+) threads)?", goal["what"]).groups()
        row = (str(goal["goal"]), what)
        rows.setdefault(row, {}).setdefault(subject, []).append(goal)
        if number:
            threads.setdefault(row, {})[number] = True
    subjects = list(dict.fromkeys(subject for row in rows.values() for subject in row))
    table = []
    for row, of in rows.items():
        on_threads = f" on {'; '.join(threads[row])} threads" if row in threads else ""
        table.append([row[0], row[1] + on_threads, *(format_goals(of.get(name)) for name in subjects)])
    return markdown_table(["goal", "what", *subjects], table)


def describe(measured, rest):
    """The part of the page on a file; notes that the rest of the page has are not repeated."""
    yield f"{environment_sentence(measured['environment'])}\n\n### Goals\n\n"
    yield goal_table(measured["goals"])
    for table in measured["tables"]:
        is_new = table["note"] and table["note"] not in rest
        yield f"### {table['title']}\n\n" + (f"{table['note']}\n\n" if is_new else "")
        rows = [[format_cell(row[name]) for name in table["columns"]] for row in table["rows"]]
        yield markdown_table(table["columns"], rows)


def main():
    arguments = parse_arguments(__doc__, "results+")
    path = arguments.documentation / "tables.md"
    page = path.read_text(encoding="utf-8")
    for results in arguments.results:
        command = re.escape(f"--json {results.name}\n\n")
        place = re.search(rf"(?<={command})Measured on .*?(?=\n## |\Z)", page, flags=re.DOTALL)
        if place is None:
            sys.exit(f"{path} has no command that writes {results.name}.")
        before, after = page[: place.start()], page[place.end() :]
        text = "".join(describe(read_json(results), before + after)).rstrip() + "\n"
        page = before + text + after
    path.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
