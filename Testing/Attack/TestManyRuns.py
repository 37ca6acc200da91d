#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The whole of vtkIsosurfaceCompare, again and again: TestManyRuns.py VTKISOSURFACECOMPARE

What crashes in one run of thirty needs many: ATTACK_RUNS says how many (3)."""

import os
import shutil
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
    def check_runs(self, environment):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            write(vtkXMLImageDataWriter(), new_ball(), folder / "ball.vti")
            for run in range(RUNS):
                result = subprocess.run(
                    [PROGRAM, "--input", folder / "ball.vti", "--isovalue", "40", "--repeats", "1",
                     "--thorough", "--report", folder],
                    capture_output=True, text=True, check=False, env=environment)  # fmt: skip
                self.assertEqual(result.returncode, 0, f"run {run}: {result.stderr}")

    def test_report(self):
        self.check_runs(dict(os.environ))

    @unittest.skipUnless(shutil.which("Xvfb"), "there is no Xvfb")
    def test_server_that_resets(self):
        """Without -noreset a server starts anew when its last client leaves, and refuses others for a
        moment: VTK 9.1 crashed between the windows of a run, in three runs of four."""
        with subprocess.Popen(
            ["Xvfb", "-displayfd", "1", "-nolisten", "tcp"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        ) as server:  # fmt: skip
            display = ":" + server.stdout.readline().strip()
            try:
                self.check_runs(dict(os.environ, DISPLAY=display))
            finally:
                server.terminate()


if __name__ == "__main__":
    unittest.main()
