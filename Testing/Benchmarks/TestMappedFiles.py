#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The programs that measure volumes in mapped files print tables with numbers."""

import subprocess
import sys
import unittest
from pathlib import Path

from Programs import ProgramTest, new_folder

HERE = Path(__file__).resolve().parent


class TestMappedFiles(ProgramTest):
    def run_script(self, name, *arguments):
        """The rows of its table, without the head."""
        run = subprocess.run([sys.executable, HERE / name, *map(str, arguments)], capture_output=True, text=True,
                             check=False)
        if "no control groups" in run.stderr:
            self.skipTest(run.stderr.strip())
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        rows = [line.strip("| ").split(" | ") for line in run.stdout.splitlines()]
        self.assertEqual({len(row) for row in rows if "---" not in row[0]}, {len(rows[0])})
        return rows[2:]

    def test_large_volume(self):
        folder = new_folder("mapped-files")
        self.run_program(folder, "vtkIsosurfaceBenchmarkVolume", "--field gyroid --dimensions 80 --output gyroid.mhd")
        rows = self.run_script("large_volume.py", folder / "gyroid.mhd", 0, 1024)
        self.assertEqual(len(rows), 8)
        for row in rows:
            self.assertGreater(float(row[3]), 0.0)

    def test_time_steps(self):
        rows = self.run_script("time_steps.py", "--steps", 3, "--edge", 40, "--seconds", 0, "--folder", ".")
        self.assertEqual(len(rows), 6)
        for row in rows:
            self.assertGreater(float(row[5]), 0.0)


if __name__ == "__main__":
    unittest.main()
