# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""How the tests of benchmarks run programs: TestX.py FOLDER_OF_THE_PROGRAMS FOLDER_FOR_RESULTS."""

import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

PROGRAMS = Path(sys.argv.pop(1)).resolve()
RESULTS = Path(sys.argv.pop(1)).resolve()


def new_folder(name):
    folder = RESULTS / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def read_json(path):
    return json.loads(path.read_text(encoding="utf-8"))


class ProgramTest(unittest.TestCase):
    def run_program(self, folder, program, arguments, environment=None):
        """Runs a program in a folder and returns what it prints, which must be no error."""
        run = self.start(folder, program, arguments, environment)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def assert_fails(self, folder, program, arguments, message):
        run = self.start(folder, program, arguments)
        self.assertNotEqual(run.returncode, 0)
        self.assertRegex(run.stderr, message)

    def start(self, folder, program, arguments, environment=None):
        command = [PROGRAMS / program, *arguments.split()]
        return subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
