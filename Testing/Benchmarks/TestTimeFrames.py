#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The commands of measurements.md that run time_frames.py, on a small volume: they print tables with times."""

import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

from Displays import why_no_pictures
from Programs import ProgramTest, new_folder

HERE = Path(__file__).resolve().parent
DOCUMENT = HERE.parents[1] / "Documentation" / "measurements.md"
FOLDER = new_folder("time-frames")
NUMBERS_OF_ROWS = {"kinds": 6, "projection": 4, "interpolation": 2, "secondary": 3, "multisampling": 2, "rays": 3,
                   "options": 7}


def run_script(*arguments):
    command = [sys.executable, HERE / "time_frames.py", "--size", "100", *arguments]
    return subprocess.run(command, cwd=FOLDER, capture_output=True, text=True, check=False)


class TestTimeFrames(ProgramTest):
    def test_documented_commands(self):
        reason = why_no_pictures(os.environ)
        if reason:
            self.skipTest(reason)
        arguments = "--field sphere --dimensions 12 --output cranium.mhd"
        self.run_program(FOLDER, "vtkIsosurfaceBenchmarkVolume", arguments)
        commands = re.findall(r"time_frames\.py (\w+) ([^#\n]*)", DOCUMENT.read_text(encoding="utf-8"))
        self.assertEqual({kind for kind, _ in commands}, set(NUMBERS_OF_ROWS))
        for kind, arguments in commands:
            with self.subTest(kind):
                # Bone is at 300, the sphere at 0; skin is at -300, as a part of the sphere is.
                run = run_script(kind, *re.sub(r"(?<!-)\b300\b", "0", arguments).split())
                self.check_table(run, NUMBERS_OF_ROWS[kind])

    def check_table(self, run, number_of_rows):
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        head, _, *rows = [line.strip("| ").split(" | ") for line in run.stdout.splitlines()]
        self.assertEqual([len(row) for row in rows], [len(head)] * number_of_rows)
        for row in rows:
            for cell in row[1:]:
                self.assertRegex(cell, r"^\d")

    def test_usage(self):
        for arguments in ((), ("kinds", "cranium.mhd"), ("sorts", "cranium.mhd", "0")):
            run = run_script(*arguments)
            self.assertEqual(run.returncode, 2)
            self.assertIn("time_frames.py kinds VOLUME ISOVALUE", run.stderr)


if __name__ == "__main__":
    unittest.main()
