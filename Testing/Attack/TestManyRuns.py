#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The whole of vtkIsosurfaceCompare, again and again: TestManyRuns.py VTKISOSURFACECOMPARE

What crashes in one run of thirty needs many: ATTACK_RUNS says how many (3)."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from DamagedVolumes import new_ball, write
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

PROGRAM = sys.argv.pop()
RUNS = int(os.environ.get("ATTACK_RUNS", "3"))


class TestManyRuns(unittest.TestCase):
    def test_report(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            write(vtkXMLImageDataWriter(), new_ball(), folder / "ball.vti")
            for run in range(RUNS):
                result = subprocess.run(
                    [PROGRAM, "--input", folder / "ball.vti", "--isovalue", "40", "--repeats", "1",
                     "--report", folder],
                    capture_output=True, text=True, check=False)  # fmt: skip
                self.assertEqual(result.returncode, 0, f"run {run}: {result.stderr}")


if __name__ == "__main__":
    unittest.main()
