#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Threads of programs and of the Python package that wait sleep, unless they are told not to:
TestThreadsAtRest.py FOLDER_OF_PROGRAMS FOLDER_OF_BENCHMARKS

GNU's OpenMP says when it is loaded how often its threads look for work before they sleep.
"""

import contextlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

BENCHMARKS = Path(sys.argv.pop())
PROGRAMS = Path(sys.argv.pop())
COMPARE = PROGRAMS / "vtkIsosurfaceCompare"
RENDER = PROGRAMS / "vtkIsosurfaceRender"  # built where there is MPI
POLICIES = ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT")


def run(command, check=True, timeout=60, **variables):
    environment = {name: value for name, value in os.environ.items() if name not in POLICIES}
    environment.update(variables, OMP_DISPLAY_ENV="verbose")
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=timeout, check=check)


def find_spins(command, **variables):
    """Of each time that OpenMP was loaded."""
    return re.findall(r"GOMP_SPINCOUNT = '(\w+)'", run(command, **variables).stderr)


class TestThreadsAtRest(unittest.TestCase):
    def check(self, command):
        self.assertEqual(find_spins(command)[-1], "10000")
        self.assertEqual(find_spins(command, GOMP_SPINCOUNT="77"), ["77"])
        self.assertNotIn(find_spins(command, OMP_WAIT_POLICY="active"), ([], ["0"]))

    def test_programs(self):
        programs = [COMPARE, PROGRAMS / "vtkIsosurfaceViewer", BENCHMARKS / "vtkIsosurfaceBenchmark"]
        for program in programs + [RENDER] * RENDER.exists():
            with self.subTest(program=program):
                self.check([program, "--help"])

    def test_process(self):
        """The arguments and the name are those of the program that was started."""
        result = run([COMPARE, "--no such option", "ä"], check=False)
        self.assertIn("--no such option", result.stderr)
        self.assertNotEqual(result.returncode, 0)
        with subprocess.Popen(
            [COMPARE, "--input", "/dev/stdin", "--isovalue", "0", "--report", "/dev/null"], stdin=subprocess.PIPE,
            stderr=subprocess.PIPE, env={name: os.environ[name] for name in os.environ if name not in POLICIES},
        ) as process:  # fmt: skip
            names = set()
            while process.poll() is None:
                with contextlib.suppress(OSError):
                    names.add(Path(f"/proc/{process.pid}/comm").read_text(encoding="utf-8").strip())
            self.assertNotIn("exe", names)
            self.assertIn(COMPARE.name[:15], names)

    @unittest.skipUnless(shutil.which("valgrind"), "there is no valgrind")
    def test_valgrind(self):
        """It would be left by the program that begins once more."""
        result = run(["valgrind", "--tool=none", COMPARE, "--help"], timeout=300)
        self.assertEqual(len(re.findall("GOMP_SPINCOUNT", result.stderr)), 1)

    def test_dynamic_loader(self):
        loader = re.search(r"\S*/ld-linux\S*", subprocess.run(["ldd", COMPARE], capture_output=True, text=True).stdout)
        if loader:
            self.assertIn("--isovalue", run([loader[0], COMPARE, "--help"]).stdout)

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
