#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""README's first command: it builds the library, and makes the pictures that it names.

Argument: the source folder."""

import subprocess
import sys
import time
import unittest
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SOURCE = Path(sys.argv[1])


def read(picture):
    reader = vtkPNGReader()
    reader.SetFileName(str(picture))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())


class TestExamplesScript(unittest.TestCase):
    def test_readme_names_it(self):
        self.assertIn("\nExamples/run.sh", (SOURCE / "README.md").read_text(encoding="utf-8"))

    def test_makes_pictures(self):
        start = time.time()
        run = subprocess.run([SOURCE / "Examples" / "run.sh"], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout[-4000:] + run.stderr)
        folder = Path(run.stdout.splitlines()[-1].removeprefix("The pictures are in "))
        pictures = sorted(folder.glob("*.png"))
        self.assertGreater(len(pictures), 10)
        for picture in pictures:
            with self.subTest(picture.name):
                self.assertGreater(picture.stat().st_mtime, start)
                self.assertGreater(read(picture).std(), 5.0)

    def test_refuses_other_arguments(self):
        run = subprocess.run([SOURCE / "Examples" / "run.sh", "--fast"], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertEqual(run.stderr, "usage: Examples/run.sh [--interactive]\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
