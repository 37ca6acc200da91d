#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Small runs of vtkIsosurfaceBenchmarkVolume and vtkIsosurfaceBenchmark: everything must be there
and make sense; times are not judged. See Programs.py."""

import math
import os
import unittest
from pathlib import Path

from Displays import why_no_pictures, without_display
from Programs import ProgramTest, new_folder, read_json

VOLUME = "vtkIsosurfaceBenchmarkVolume"
BENCHMARK = "vtkIsosurfaceBenchmark"
FOLDER = new_folder("isosurface")


def make_large():
    """Makes sphere.mhd, and large.mhd of it; returns what is said of the latter."""
    test = ProgramTest()
    test.run_program(FOLDER, VOLUME, "--field sphere --dimensions 32 --output sphere.mhd")
    arguments = "--input sphere.mhd --dimensions 40,50,600 --output large.mhd"
    return test.run_program(FOLDER, VOLUME, arguments)


class TestBenchmarkVolume(ProgramTest):
    def test_fields(self):
        for field in ("gyroid", "marschner-lobb"):
            arguments = f"--field {field} --dimensions 32 --output {field}.mhd"
            self.run_program(FOLDER, VOLUME, arguments)
            self.assertEqual((FOLDER / f"{field}.raw").stat().st_size, 2 * 32**3)

    def test_resampling(self):
        said = make_large()
        self.assertRegex(said, "large.mhd: 40 x 50 x 600 samples from -29[0-9]* to 2")
        self.assertEqual((FOLDER / "large.raw").stat().st_size, 2 * 40 * 50 * 600)

    def test_slabs_fit_together(self):
        """The second slab begins at slice 256. What is there mirrors what is in the first."""
        self.run_program(
            FOLDER, VOLUME, "--field sphere --dimensions 256,256,300 --output slabs.mhd"
        )
        samples, size = (FOLDER / "slabs.raw").read_bytes(), 2 * 256 * 256
        (FOLDER / "slabs.raw").unlink()
        slices = {z: samples[z * size : (z + 1) * size] for z in (38, 39, 260)}
        self.assertEqual(slices[260], slices[39])
        self.assertNotEqual(slices[260], slices[38])

    def test_refusals(self):
        for arguments, message in (
            ("--field cube --dimensions 32 --output a.mhd", "no field cube; there are: gyroid"),
            ("--field sphere --dimensions 32,1,32 --output a.mhd", "from 2 to 16384 samples"),
            ("--input none.mhd --dimensions 32 --output a.mhd", "no file none.mhd"),
            ("--field sphere --dimensions 32 --output none/a.mhd", "No such file or directory"),
            ("--input sphere.mhd --dimensions 9 --output sphere.mhd", "is the input"),
            ("--field sphere", "Usage"),
        ):
            self.assert_fails(FOLDER, VOLUME, arguments, message)

    @unittest.skipUnless(Path("/dev/full").exists(), "there is no full disk to write to")
    def test_full_disk(self):
        (FOLDER / "full.raw").symlink_to("/dev/full")
        arguments = "--field sphere --dimensions 32 --output full.mhd"
        self.assert_fails(FOLDER, VOLUME, arguments, "No space left on device")
        self.assertFalse((FOLDER / "full.mhd").exists(), "a header of an incomplete volume")


class TestBenchmark(ProgramTest):
    @classmethod
    def setUpClass(cls):
        make_large()
        cls().run_program(
            FOLDER,
            BENCHMARK,
            "--input large.mhd --isovalue 0 --isovalue 2000 --size 64 --views 2 --repeats 1 "
            "--threads 1,2 --goals --papers --growth 128 --json cranium.json",
        )
        cls.measured = read_json(FOLDER / "cranium.json")
        cls.tables = {table["name"]: table for table in cls.measured["tables"]}
        cls.has_embree = "Embree" in cls.measured["environment"]

    def check_table(self, name, count, *columns):
        """The table has so many rows, in which the columns are positive numbers."""
        table = self.tables[name]
        self.assertEqual(len(table["rows"]), count, name)
        for row in table["rows"]:
            self.assertEqual(set(row), set(table["columns"]), name)
            for column in columns:
                value = row[column]
                value = value["median"] if isinstance(value, dict) else value
                self.assertGreater(value, 0, f"{name}: {column} of {row}")

    def test_refusals(self):
        for arguments, message in (
            ("--isovalue 40000", "has values from .* so there is no surface"),
            ("--isovalue 0 --baselines x", 'there is no baseline "x"'),
            ("--isovalue 0 --threads 1,two", "give numbers from 1 to 1024"),
            ("--isovalue 0 --json none/x.json", "cannot be written"),
            ("", "Usage"),
        ):
            self.assert_fails(FOLDER, BENCHMARK, f"--input sphere.mhd {arguments}", message)

    def test_isosurfaces(self):
        for isovalue in (0, 2000):
            self.check_table(f"memory {isovalue}", 5, "MiB")
            self.check_table(
                f"new isovalue {isovalue}", 6 + self.has_embree, "s", "times this mapper's"
            )
            self.check_table(
                f"pictures {isovalue}", 5 + 2 * self.has_embree, "threads", "times this mapper's"
            )
            self.check_table(f"cold start {isovalue}", 5, "ms")
            self.check_table(f"whole frame {isovalue}", 4, "ms")
            self.check_table(f"simulated scaling {isovalue}", 3, "efficiency, %")

    def test_all_show_the_same_surface(self):
        for isovalue in (0, 2000):
            rows = self.tables[f"pictures {isovalue}"]["rows"]
            ours = rows[0]["pixels hit, %"]
            self.assertGreater(ours, 5)
            for row in rows:  # fixed-point blends the border of the surface into the background
                self.assertGreater(row["pixels hit, %"], ours - 2, row["method"])
                self.assertLess(row["pixels hit, %"], ours + 6, row["method"])

    def test_papers(self):
        rate = "frames per second"
        shares = ("traversal and intersection, %", "shading, %")
        layouts = ("initial", "bricking", "hierarchy and bricking", "defaults")
        variant = ("cold, ms", "trace, ms", "times the defaults'")
        self.check_table("parker 1998 table I", 2, *shares, rate)
        self.check_table("parker 1998 table II", 4, rate, "speed-up")
        self.check_table("parker 1998 table III", 8, *layouts)
        self.check_table("other hierarchies", 11, *variant)
        self.check_table("other bricks", 10, "macrocells, % of the data", *variant)
        self.check_table("extraction", 6, "triangles", "s", "MiB")

    def test_growth(self):
        columns = ("trace, ms", "cold start to first picture, ms", "flying edges, ms")
        self.check_table("growth", 2, "n", *columns)
        self.check_table("growth fits", 3)

    def test_goals(self):
        goals = self.measured["goals"]
        self.assertEqual(len(goals), 17 if self.has_embree else 13)
        for goal in goals:
            self.assertTrue(math.isfinite(goal["measured"]), goal["what"])
            # The power of growth is that of noise in volumes so small.
            if goal["goal"] != 7:
                self.assertGreater(goal["measured"], 0, goal["what"])

    def check_frames(self, environment):
        """Rays are always measured, frames where they are possible."""
        self.run_program(
            FOLDER,
            BENCHMARK,
            "--input sphere.mhd --isovalue 0 --size 32 --views 1 --repeats 1 --threads 1",
            environment,
        )
        measured = read_json(FOLDER / "benchmark.json")
        pictures = next(t for t in measured["tables"] if t["name"] == "pictures 0")
        row = pictures["rows"][0]
        self.assertGreater(row["trace, ms"]["median"], 0)
        absent = measured["environment"].get("absent", [])
        if why_no_pictures(environment):
            self.assertIn("gpu, because there is no display (xvfb-run -a gives one)", absent)
            self.assertIsNone(row["frame, ms"])
        else:
            self.assertFalse(any(text.startswith("gpu") for text in absent))
            self.assertGreater(row["frame, ms"]["median"], 0)

    def test_display(self):
        self.check_frames(dict(os.environ))

    def test_without_display(self):
        self.check_frames(without_display())


if __name__ == "__main__":
    unittest.main()
