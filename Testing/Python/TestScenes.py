#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The scenes of Examples/Python/scenes.py are the baselines; what was drawn is left in ./scenes."""

import os
import subprocess
import sys
import unittest

from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "../../Examples/Python")
BASELINES = os.path.join(HERE, "../Data/Baseline")
sys.path.insert(0, EXAMPLES)
import scenes  # noqa: E402

SIZE = 160


def read(file_name):
    reader = vtkPNGReader()
    reader.SetFileName(file_name)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    return [scalars.GetTuple3(i) for i in range(scalars.GetNumberOfTuples())]


def difference(picture, other):
    """The share of pixels of which a channel differs by more than two steps."""
    different = sum(1 for a, b in zip(picture, other)
                    if max(abs(x - y) for x, y in zip(a, b)) > 2)
    return different / len(picture)


class TestScenes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        waves = vtkRTAnalyticSource()
        waves.SetWholeExtent(-20, 20, -20, 20, -20, 20)
        waves.Update()
        scenes.write_all(waves.GetOutput(), 150.0, "scenes", SIZE)
        cls.pictures = {scene.__name__: read(os.path.join("scenes", scene.__name__ + ".png"))
                        for scene in scenes.SCENES}

    def test_baselines(self):
        for name, picture in self.pictures.items():
            with self.subTest(name):
                baseline = read(os.path.join(BASELINES, f"scenes-{name}.png"))
                self.assertEqual(len(picture), SIZE * SIZE)
                self.assertEqual(len(baseline), SIZE * SIZE)
                self.assertLessEqual(difference(picture, baseline), 0.002)

    def test_none_is_like_another(self):
        pictures = list(self.pictures.values())
        for i, picture in enumerate(pictures):
            for other in pictures[:i]:
                self.assertGreater(difference(picture, other), 0.01)

    def test_smart_mapper_draws_our_picture(self):
        waves = vtkRTAnalyticSource()
        waves.SetWholeExtent(-20, 20, -20, 20, -20, 20)
        waves.Update()
        scenes.Scene(waves.GetOutput(), 150.0, SIZE).write("scenes/plain.png")
        self.assertEqual(difference(read("scenes/plain.png"), self.pictures["smart_mapper"]), 0.0)

    def test_usage(self):
        script = os.path.join(EXAMPLES, "scenes.py")
        result = subprocess.run([sys.executable, script], capture_output=True, check=False)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn(b"scenes.py VOLUME.mhd ISOVALUE FOLDER", result.stderr)


if __name__ == "__main__":
    unittest.main()
