#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/Cxx/RayTraceIsosurface as a user calls it: TestRayTraceIsosurface.py PROGRAM"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

from PictureTesting import SIZE, difference, read, write_bad_volumes, write_waves

PROGRAM = sys.argv.pop(1)
COLUMNS = ["build", "extraction", "first picture", "next picture", "new isovalue", "memory",
           "triangles"]
EXTRACTION = COLUMNS[1:]  # nothing serves all isovalues
METHODS = {
    "vtkFlyingEdges3D": EXTRACTION,
    "vtkMarchingCubes": EXTRACTION,
    "vtkSynchronizedTemplates3D": EXTRACTION,
    "vtkContourFilter": EXTRACTION,
    "vtkSpanSpace": COLUMNS,
    "vtkIsosurfaceRayTraceMapper": [name for name in COLUMNS
                                    if name not in ("extraction", "triangles")],
}


def cells(line):
    """The texts of a line that two blanks or more part."""
    return re.split(r" {2,}", line.strip())


class TestRayTraceIsosurface(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = temporary.name
        cls.volume = write_waves(cls.folder, radius=40)
        result = cls.run_program(
            "--input", cls.volume, "--isovalue", "200", "--skin", "150",
            "--size", str(SIZE), "--output", cls.folder)
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        cls.lines = [cells(line) for line in result.stdout.splitlines()]

    @staticmethod
    def run_program(*arguments, **options):
        return subprocess.run(
            [PROGRAM, *arguments], stderr=subprocess.PIPE, text=True, check=False,
            **{"stdout": subprocess.PIPE, **options})

    def check_amount(self, text, unit=""):
        """The text is a number above 0 that is shown as such, and its unit."""
        self.assertRegex(text, rf"^[0-9.]+{unit}$")
        self.assertGreater(float(text.removesuffix(unit)), 0.0)

    def test_volume(self):
        self.assertIn(["81 x 81 x 81 samples of type float, 34.0153 to 286.341, 2.0 MiB"], self.lines)

    def test_ray_tracing(self):
        self.assertIn([f"Ray traced at isovalue 200, {SIZE} x {SIZE} pixels"], self.lines)
        rows = {line[0]: line[1:3] for line in self.lines if len(line) > 2}
        for name in ("first frame", "macrocells", "bricks", "next frame, median"):
            with self.subTest(name):
                time, memory = rows[name]
                self.check_amount(time, " ms")
                self.check_amount(memory, " MiB")

    def test_comparison(self):
        header = self.lines.index(COLUMNS)
        rows = {line[0]: line[1:] for line in self.lines[header + 1 : self.lines.index(["Pictures"])]}
        self.assertEqual(list(rows), list(METHODS))
        for method, columns in METHODS.items():
            self.assertEqual(len(rows[method]), len(COLUMNS), method)
            for name, text in zip(COLUMNS, rows[method]):
                with self.subTest(f"{name} of {method}"):
                    if name in columns:
                        unit = {"memory": " MiB", "triangles": ""}.get(name, " ms")
                        self.check_amount(text, unit)
                    else:
                        self.assertEqual(text, "-")

    def test_pictures(self):
        pictures = []
        for name in ("bone.png", "bone-and-skin.png", "cone.png"):
            file_name = f"{self.folder}/{name}"
            self.assertIn([file_name], self.lines)
            pictures.append(read(file_name))
            self.assertEqual(len(pictures[-1]), SIZE * SIZE)
        for one, other in zip(pictures, pictures[1:] + pictures[:1]):
            self.assertGreater(difference(one, other), 0.01)

    def test_errors(self):
        for arguments, words in (
            (("--input", os.path.join(self.folder, "absent.mhd")), "There is no file"),
            (("--input", __file__), "is not a volume"),
            (("--input", self.volume, "--size", "64", "--output", "/dev/null/folder"),
             "cannot be created"),
        ):
            result = self.run_program(*arguments)
            self.assertNotEqual(result.returncode, 0, arguments)
            self.assertIn(words, result.stderr)

    def test_bad_volumes(self):
        for file_name in write_bad_volumes(self.folder):
            with self.subTest(file_name):
                result = self.run_program("--input", file_name)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn(file_name, result.stderr.splitlines()[-1])
                self.assertEqual(result.stdout, "")

    def test_pictures_that_cannot_be_written(self):
        """They are told with the reason, and nothing unfinished is left."""
        arguments = ("--input", self.volume, "--isovalue", "200", "--size", "64")
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "bone.png"))  # where the picture should go
            result = self.run_program(*arguments, "--output", folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn("bone.png cannot be written: Is a directory.", result.stderr)
            self.assertEqual(sorted(os.listdir(folder)), ["bone.png", "cone.png"])
            with open("/dev/full", "wb") as full:
                result = self.run_program(*arguments, "--output", folder, stdout=full)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output cannot be written: No space left", result.stderr)

    def test_display_that_cannot_be_opened(self):
        result = self.run_program("--input", self.volume, env=dict(os.environ, DISPLAY=":9999"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("the display :9999 cannot be opened", result.stderr)


if __name__ == "__main__":
    unittest.main()
