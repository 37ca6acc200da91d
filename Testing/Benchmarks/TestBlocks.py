#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A small run of vtkIsosurfaceBlocksBenchmark: everything must be there and make sense; times are not
judged. See Programs.py."""

import os
import re
import unittest
from pathlib import Path

from Displays import why_no_pictures
from Programs import ProgramTest, new_folder, read_json

BENCHMARK = "vtkIsosurfaceBlocksBenchmark"
FOLDER = new_folder("blocks")
SOURCE = Path(__file__).resolve().parents[2]


@unittest.skipIf(why_no_pictures(dict(os.environ)), "there is no display")
class TestBlocksBenchmark(ProgramTest):
    def test_documented_command(self):
        """That of Documentation/tables.md, with fewer blocks."""
        page = (SOURCE / "Documentation" / "tables.md").read_text(encoding="utf-8")
        (command,) = re.findall(r"^    xvfb-run -a build/developer/bin/vtkIsosurfaceBlocksBenchmark (.*)$", page, re.M)
        few = f"--blocks 3 --block-size 9 --size 100 --views 2 --repeats 2 {command}"
        self.run_program(FOLDER, BENCHMARK, few)
        measured = read_json(FOLDER / "blocks.json")
        (table,) = measured["tables"]
        self.assertEqual(table["title"], "27 blocks of 9^3 cells")
        self.assertEqual(len(table["rows"]), 4)
        for row in table["rows"]:
            self.assertGreater(row["next picture, ms"]["median"], 0, row["data"])
            self.assertGreater(row["of it, tracing, ms"]["median"], 0, row["data"])
            self.assertGreater(row["memory, MiB"], 0, row["data"])
        self.assertEqual(table["rows"][0]["times that of one image"]["median"], 1)
        self.assertEqual(len(measured["goals"]), 3)


if __name__ == "__main__":
    unittest.main()
