#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Small runs of vtkIsosurfaceCloudBenchmark: everything must be there, and colours are exact; times are not judged.
See Programs.py."""

import os
import re
import unittest
from pathlib import Path

from Displays import why_no_pictures, without_display
from Programs import ProgramTest, new_folder

BENCHMARK = "vtkIsosurfaceCloudBenchmark"
FOLDER = new_folder("cloud")
PAGE = Path(__file__).resolve().parents[2] / "Documentation" / "measurements.md"
SMALL = "--cells 3000 --size 64 --step 8"


def rows_of(text):
    """The cells of the rows of a table in Markdown, without its head."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:1] == "|"][2:]


class TestCloudBenchmark(ProgramTest):
    def check_summary(self, text):
        self.assertRegex(text, r"\d+ tetrahedra, 64 x 64 pixels, \d+ segments, [0-9.]+ ns .* bytes a cell")

    def get_commands(self):
        """Those of Documentation/measurements.md."""
        return re.findall(rf"^    (?:xvfb-run -a )?build/developer/bin/{BENCHMARK} (.*)$", PAGE.read_text(), re.M)

    @unittest.skipIf(why_no_pictures(dict(os.environ)), "there is no display")
    def test_pictures(self):
        commands = [command for command in self.get_commands() if "--processes" not in command]
        self.assertTrue(commands)
        for command in commands:
            command = re.sub(r"--(input|array) \S+", "", command)
            text = self.run_program(FOLDER, BENCHMARK, f"{command} {SMALL} --repeats 1")
            self.check_summary(text)
            rows = rows_of(text)
            self.assertEqual(len(rows), 4)
            for name, milliseconds, ratio, largest, mean in rows:
                self.assertGreater(float(ratio), 0.0, name)
                self.assertGreater(float(mean), 0.0, name)
                self.assertLess(float(mean), float(largest), name)
            # Rounding twice: of the cloud, and of the background behind it.
            self.assertLess(float(rows[0][3]), 0.0045)
            (error,) = re.findall(r"the error of this mapper is (\S+) at most, in 64 pixels", text)
            self.assertLess(float(error), 1e-5)

    def test_processes(self):
        commands = [command for command in self.get_commands() if "--processes" in command]
        self.assertTrue(commands)
        for command in commands:
            command = re.sub(r"--(input|array) \S+", "", command)
            rows = rows_of(self.run_program(FOLDER, BENCHMARK, f"{command} {SMALL} --processes 32"))
            self.assertEqual([row[0] for row in rows], ["1", "8", "32"])
            self.assertEqual(rows[0][5], "100 %")

    def test_without_display(self):
        text = self.run_program(FOLDER, BENCHMARK, SMALL, without_display())
        self.check_summary(text)
        self.assertEqual("There is no display" in text, bool(why_no_pictures(without_display())))

    def test_wrong_arguments(self):
        self.assert_fails(FOLDER, BENCHMARK, "--size 5", "Usage")
        self.assert_fails(FOLDER, BENCHMARK, "--input missing.vtu", "missing.vtu")


if __name__ == "__main__":
    unittest.main()
