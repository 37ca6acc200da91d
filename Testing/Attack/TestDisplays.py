#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Utilities/with-display.sh beside others that start and end at the same time."""

import shutil
import subprocess
import unittest
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "Utilities" / "with-display.sh"
SERVERS = 12


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xauth"), "there is no Xvfb")
class TestDisplays(unittest.TestCase):
    def test_each_has_its_own(self):
        runs = [
            subprocess.Popen(
                [SCRIPT, "sh", "-c", 'echo "$DISPLAY $XAUTHORITY"; read -r line; exit 7'],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
            for _ in range(SERVERS)
        ]  # fmt: skip
        said = [run.stdout.readline().split() for run in runs]
        for run in runs:
            run.communicate("end\n")
        self.assertEqual([run.returncode for run in runs], SERVERS * [7])
        self.assertEqual(len({display for display, _ in said}), SERVERS, said)
        for _, authority in said:
            self.assertFalse(Path(authority).parent.exists(), "its folder is left")

    def test_error(self):
        run = subprocess.run([SCRIPT], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 2)
        self.assertIn("usage:", run.stderr)


if __name__ == "__main__":
    unittest.main()
