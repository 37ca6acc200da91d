#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The example InSitu: its pictures change with time, and not with the number of processes.

Arguments: the program, mpiexec, its option for the number of processes."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from PictureTesting import count_colored

PROGRAM, *MPIEXEC = sys.argv[1:4]


def run(processes, *arguments):
    command = [*MPIEXEC, str(processes), PROGRAM, *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


class TestInSitu(unittest.TestCase):
    def test_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            pictures = {}
            for processes in (1, 2, 5):
                prefix = Path(folder) / f"{processes}_"
                result = run(processes, "32", "300", "150", str(prefix))
                self.assertEqual(result.returncode, 0, result.stderr)
                names = [f"{prefix}150.png", f"{prefix}300.png"]
                self.assertEqual(result.stdout.split(), names)
                pictures[processes] = [Path(name).read_bytes() for name in names]
            self.assertGreater(min(map(count_colored, names)), 2000)
            self.assertNotEqual(*pictures[1])
            self.assertEqual(pictures[2], pictures[1])
            self.assertEqual(pictures[5], pictures[1])

    def test_usage(self):
        for arguments in ((), ("4", "1", "1", "x"), ("32", "1", "0", "x")):
            result = run(1, *arguments)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn("usage: InSitu", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
