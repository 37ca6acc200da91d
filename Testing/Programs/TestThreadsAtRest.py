#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Threads of programs and of the Python package that wait sleep, unless they are told not to:
TestThreadsAtRest.py FOLDER_OF_PROGRAMS FOLDER_OF_BENCHMARKS

GNU's OpenMP says when it is loaded how often its threads look for work before they sleep.
"""

import importlib.util
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

BENCHMARKS = Path(sys.argv.pop())
PROGRAMS = Path(sys.argv.pop())
COMPARE = PROGRAMS / "vtkIsosurfaceCompare"
RENDER = PROGRAMS / "vtkIsosurfaceRender"  # built where there is MPI
POLICIES = ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT")


def run(command, check=True, **variables):
    environment = {name: value for name, value in os.environ.items() if name not in POLICIES}
    environment.update(variables, OMP_DISPLAY_ENV="verbose")
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=check)


def find_spins(command, **variables):
    """Of each time that OpenMP was loaded."""
    return re.findall(r"GOMP_SPINCOUNT = '(\w+)'", run(command, **variables).stderr)


class TestThreadsAtRest(unittest.TestCase):
    def check(self, command):
        self.assertEqual(find_spins(command)[-1], "0")
        self.assertEqual(find_spins(command, GOMP_SPINCOUNT="77"), ["77"])
        self.assertNotEqual(find_spins(command, OMP_WAIT_POLICY="active"), ["0"])

    def test_programs(self):
        programs = [COMPARE, PROGRAMS / "vtkIsosurfaceViewer", BENCHMARKS / "vtkIsosurfaceBenchmark"]
        for program in programs + [RENDER] * RENDER.exists():
            with self.subTest(program=program):
                self.check([program, "--help"])

    def test_arguments(self):
        result = run([COMPARE, "--no such option", "ä"], check=False)
        self.assertIn("--no such option", result.stderr)
        self.assertNotEqual(result.returncode, 0)

    @unittest.skipUnless(importlib.util.find_spec("vtkIsosurfaceRayTracing"), "built without Python")
    def test_package(self):
        code = f"import os, vtkIsosurfaceRayTracing; print([name in os.environ for name in {POLICIES}])"
        command = [sys.executable, "-c", code]
        self.check(command)
        # What the package sets is for itself alone, not for programs that the script starts.
        self.assertEqual(run(command).stdout, "[False, False]\n")
        self.assertEqual(run(command, OMP_WAIT_POLICY="passive").stdout, "[True, False]\n")


if __name__ == "__main__":
    unittest.main()
