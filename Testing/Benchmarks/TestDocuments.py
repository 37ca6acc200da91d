#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The measured parts of Documentation can be made of what the benchmarks write: here of the results
of their tests, for copies of the pages. See Programs.py."""

import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from vtkmodules.vtkIOImage import vtkPNGReader

from Programs import RESULTS, new_folder

SOURCE = Path(__file__).resolve().parents[2]


class TestDocuments(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = new_folder("documents")
        (cls.folder / "images").mkdir()

    def document(self, name, *results):
        """Runs the program for a page, and returns the page and its tables: lists of rows."""
        page = self.folder / f"{name}.md"
        shutil.copy(SOURCE / "Documentation" / page.name, page)
        program = SOURCE / "Utilities" / f"document_{name}.py"
        run = subprocess.run(
            [sys.executable, program, "--documentation", self.folder, *results],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        self.assertEqual(run.returncode, 0, run.stderr)
        text = page.read_text(encoding="utf-8")
        tables = re.findall(r"(?:^\|.*\n)+", text, re.M)
        return text, [[row.strip("| ").split(" | ") for row in t.splitlines()] for t in tables]

    def check_picture(self, name):
        """The picture shows something in several colours."""
        reader = vtkPNGReader()
        reader.SetFileName(str(self.folder / "images" / name))
        reader.Update()
        pixels = reader.GetOutput().GetPointData().GetScalars()
        colors = {pixels.GetTuple3(i) for i in range(0, pixels.GetNumberOfTuples(), 7)}
        self.assertGreater(len(colors), 5, name)

    def check_goals(self, table):
        self.assertGreater(len(table), 2)
        for row in table[2:]:
            for cell in row[2:]:
                self.assertRegex(cell, r"^(\*\*|)[\de.; -]+\1 \(at (most|least) [\d.]+\)$|^$")

    def test_tables(self):
        text, tables = self.document("tables", RESULTS / "isosurface" / "cranium.json")
        self.assertIn("volume: large.mhd, 40 x 50 x 600, short", text)
        self.assertIn("### Isovalue 2000: memory\n", text)
        self.assertNotIn("volume: cranium.mhd", text)
        self.assertIn("## Growth\n", text)  # parts of other files stand as they did
        goals = next(t for t in tables if t[0][:2] == ["goal", "what"])
        self.assertIn("Isovalue 2000", goals[0])
        self.check_goals(goals)

    def test_tables_of_meshes(self):
        text, tables = self.document("tables", RESULTS / "mesh" / "meshes.json")
        self.assertIn("### First hits of rays, 64 x 64 pixels\n", text)
        self.assertIn("## Meshes: hexahedra\n", text)
        (goals,) = [t for t in tables if t[0][:2] == ["goal", "what"] and "1080 tetrahedra, ball" in t[0]]
        self.check_goals(goals)

    def test_accuracy(self):
        reports = [RESULTS / "accuracy" / name for name in ("fields", "cranium")]
        text, tables = self.document("accuracy", *reports)
        for heading in ("cranium", "gyroid 24^3", "near tangent 24^3"):
            self.assertIn(f"### {heading}, isovalue", text)
        self.assertNotIn("ch2better,", text)
        prices = next(t for t in tables if t[0][0] == "input")
        self.assertEqual(len(prices), 2 + 6)
        self.assertTrue(all(re.match(r"\d", cell) for row in prices[2:] for cell in row[1:]))
        pictures = re.findall(r"\(images/(accuracy-.*\.png)\)", text)
        self.assertEqual(len(pictures), 6)
        for picture in pictures:
            self.check_picture(picture)


if __name__ == "__main__":
    unittest.main()
