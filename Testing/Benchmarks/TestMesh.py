#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Small runs of vtkIsosurfaceMeshBenchmark: everything must be there and make sense, and rays hit
what Embree hits; times are not judged. See Programs.py."""

import math
import os
import re
import unittest
from pathlib import Path

from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkPointDataToCellData
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLStructuredGridWriter

from Displays import why_no_pictures, without_display
from Programs import ProgramTest, new_folder, read_json

BENCHMARK = "vtkIsosurfaceMeshBenchmark"
FOLDER = new_folder("mesh")
SOURCE = Path(__file__).resolve().parents[2]
SMALL = "--size 64 --views 2 --repeats 1 --threads 1,2"


def write_files():
    """A curvilinear grid whose values are z: grid.vts, and as listed cells with the means of their
    values, cells.vtk."""
    points, values = vtkPoints(), vtkFloatArray()
    values.SetName("height")
    for z in range(6):
        for y in range(6):
            for x in range(6):
                points.InsertNextPoint(x, y, z + 0.02 * x * y)
                values.InsertNextValue(z)
    grid = vtkStructuredGrid()
    grid.SetDimensions(6, 6, 6)
    grid.SetPoints(points)
    grid.GetPointData().AddArray(values)
    writer = vtkXMLStructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(FOLDER / "grid.vts"))
    writer.Write()
    means = vtkPointDataToCellData()
    means.SetInputData(grid)
    listed = vtkAppendFilter()
    listed.SetInputConnection(means.GetOutputPort())
    writer = vtkUnstructuredGridWriter()
    writer.SetInputConnection(listed.GetOutputPort())
    writer.SetFileName(str(FOLDER / "cells.vtk"))
    writer.Write()


class TestMeshBenchmark(ProgramTest):
    def measure(self, arguments, environment=None, name="a.json"):
        self.run_program(FOLDER, BENCHMARK, f"{arguments} {SMALL} --json {name}", environment)
        measured = read_json(FOLDER / name)
        for goal in measured["goals"]:
            self.assertTrue(math.isfinite(goal["measured"]), goal["what"])
            self.assertGreater(goal["measured"], 0, goal["what"])
        return measured, {table["name"]: table["rows"] for table in measured["tables"]}

    def check_agreement(self, measured, tables, median, far, share):
        """The hits of nearly all rays are near those of Embree with the triangles."""
        if "Embree" not in measured["environment"]:
            self.assertNotIn("mesh agreement", tables)
            return
        for row in tables["mesh agreement"]:
            self.assertGreater(row["rays that hit both"], 500, row["mesh"])
            self.assertLess(row["distance: median"], median, row["mesh"])
            self.assertLess(row["99 %"], far, row["mesh"])
            self.assertLess(row["only this library's surface, %"], share, row["mesh"])
            self.assertLess(row["only the triangles, %"], share, row["mesh"])

    def test_tetrahedra(self):
        measured, tables = self.measure("--cells 3000")
        self.check_agreement(measured, tables, 1e-4, 1e-3, 0.2)
        names = [row["mesh"] for row in tables["mesh preparation"]]
        self.assertEqual(names, ["2560 tetrahedra, ball", "2560 tetrahedra, gyroid"])
        self.assertEqual(len(tables["mesh traces"]), 4)
        for row in tables["mesh traces"]:
            self.assertGreater(row["this library, ns"]["median"], 0)
            self.assertGreater(row["rays alone, ns"]["median"], 0)
        self.assertNotIn("mesh split", tables)
        # Other hierarchies hit what this library hits, but for rays that slip through.
        hierarchies = 3 if "Embree" in measured["environment"] else 2
        self.assertEqual(len(tables["mesh hierarchies"]), 2 * hierarchies)
        for row in tables["mesh hierarchies"]:
            self.assertGreater(row["memory, bytes a cell"], 0, row["hierarchy"])
            self.assertLess(row["rays with a hit in one of both, %"], 0.2, row["hierarchy"])

    def test_order_changes_no_hit(self):
        rows = []
        for order in ("", "--shuffled"):
            _, tables = self.measure(f"--cells 3000 --fields gyroid {order}")
            rows.append(tables.get("mesh agreement"))
        self.assertEqual(rows[0], rows[1])

    def test_hexahedra(self):
        measured, tables = self.measure("--cells 3000 --shapes hexahedra --fields ball")
        self.check_agreement(measured, tables, 0.05, 1.0, 2.0)
        self.assertEqual(len(tables["mesh split"]), 2)
        self.assertNotIn("mesh hierarchies", tables)
        self.assertIn(5, {goal["goal"] for goal in measured["goals"]})

    def test_files(self):
        write_files()
        for name in ("grid.vts", "cells.vtk"):
            measured, tables = self.measure(f"--input {name} --array height --isovalue 2.25")
            self.check_agreement(measured, tables, 0.05, 0.2, 2.0)
            self.assertEqual(tables["mesh preparation"][0]["mesh"], f"{name}, height 2.25")
            self.assertEqual(tables["mesh preparation"][0]["cells"], 125)

    def test_pictures(self):
        measured, tables = self.measure("--cells 3000 --fields ball")
        if why_no_pictures(dict(os.environ)):
            self.assertNotIn("mesh pictures", tables)
            return
        self.assertEqual({goal["goal"] for goal in measured["goals"]} - {1}, {2, 3, 4})
        for name, count in (("mesh pictures", 4), ("mesh first picture", 3), ("mesh memory", 1)):
            self.assertEqual(len(tables[name]), count, name)
        memory = tables["mesh memory"][0]
        # 4 ids and an offset of 8 bytes, a type, and of each fifth a point.
        self.assertGreater(memory["the user's arrays"], 41)
        self.assertGreater(memory["tree, with gradients at the points"], memory["tree"])
        self.assertGreater(memory["what is known of the surface"], 0.0)

    def test_documented_commands(self):
        """Those of Documentation/tables.md, with fewer cells."""
        page = (SOURCE / "Documentation" / "tables.md").read_text(encoding="utf-8")
        commands = re.findall(r"^## Meshes: .*\n\n    \$measure (.*) --json (.*)$", page, re.M)
        self.assertEqual(len(commands), 3)
        for arguments, name in commands:
            few, count = re.subn(r"--cells \S+", "--cells 1e3,2e3", arguments)
            self.assertEqual(count, 1, arguments)
            _, tables = self.measure(few, name=name)
            self.assertEqual(len(tables["mesh preparation"]), 4)

    def test_without_display(self):
        _, tables = self.measure("--cells 1000 --fields ball", without_display())
        self.assertIn("mesh traces", tables)
        self.assertEqual("mesh pictures" in tables, not why_no_pictures(without_display()))

    def test_refusals(self):
        write_files()
        for arguments, message in (
            ("--cells x", "give numbers from 1 to 1e9"),
            ("--shapes cubes", 'there is no "cubes"; there are tetrahedra, hexahedra'),
            ("--fields f", 'there is no "f"; there are ball, gyroid'),
            ("--isovalue 1", "Usage"),
            ("--input none.vtu --isovalue 1", "there is no file none.vtu"),
            ("--input grid.vts --array a --isovalue 1", 'grid.vts: there is no array "a"'),
            ("--input grid.vts --isovalue 9", "has values from 0 to 5, so there is no surface"),
            ("--threads 0", "give numbers from 1 to 1024"),
            ("--json none/x.json", "cannot be written"),
        ):
            self.assert_fails(FOLDER, BENCHMARK, f"--json refused.json {arguments}", message)


if __name__ == "__main__":
    unittest.main()
