#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""render() with arguments of all kinds, drawn at random: a picture, or an exception of those that it documents.

ATTACK_ARGUMENTS calls (200) are drawn from the seed ATTACK_SEED (0)."""

import os
import random
import unittest
import warnings

import numpy as np
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkImageData, vtkMultiBlockDataSet, vtkPlane, vtkUnstructuredGrid
from vtkIsosurfaceRayTracing import render

from MeshTesting import ball, make_grid, make_structured_grid
from PackageTesting import make_ball
from PictureTesting import make_waves

OPTIONS = ("scalars", "color", "opacity", "color_by", "cmap", "clim", "clip", "caps", "shadows", "occlusion",
           "interpolation", "samples", "spacing", "origin", "direction", "size", "view", "up", "zoom", "background")  # fmt: skip
VALUES = (None, "", "x", "red", "auto", b"x", 0, 1, -1, 0.5, 150, 10**30, 1e308, -1e-308, np.nan, np.inf, True, 1 + 2j,
          [], (), {}, object(), [1, 2, 3], (0, 0, 1), [0.1, 0.2], [["a"]], [np.nan] * 3, [1e300] * 3, ["red", "blue"],
          np.zeros(3), np.zeros((3, 3)), make_ball(8), lambda value: value, vtkPlane(), make_waves(4))  # fmt: skip
DOCUMENTED = (FileNotFoundError, MemoryError, TypeError, ValueError)


def make_data():
    flat = vtkImageData()
    flat.SetDimensions(3, 3, 1)
    flat.AllocateScalars(10, 1)
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, make_waves(4))
    blocks.SetBlock(3, make_grid(VTK_TETRA, ball))
    return (make_ball(10), make_waves(5), make_grid(VTK_TETRA, ball), make_structured_grid(ball), blocks, flat,
            vtkMultiBlockDataSet(), vtkImageData(), vtkUnstructuredGrid(), np.zeros((4, 4, 4)),
            np.full((4, 4, 4), np.nan), np.array([[[0, np.inf], [1, 2]], [[3, -np.inf], [4, 5]]]),
            np.arange(27, dtype=np.uint64).reshape(3, 3, 3) * 2**60, None, "", "absent.vti")  # fmt: skip


class TestRandomArguments(unittest.TestCase):
    def test_random_arguments(self):
        draw = random.Random(int(os.environ.get("ATTACK_SEED", "0")))
        data, pictures, count = make_data(), 0, int(os.environ.get("ATTACK_ARGUMENTS", "200"))
        for _ in range(count):
            options = {"size": (20, 16), "samples": 2}
            options.update({draw.choice(OPTIONS): draw.choice(VALUES) for _ in range(draw.randrange(4))})
            isovalues = draw.choice(("auto", 0.1, [0.1, 0.2], 150, draw.choice(VALUES)))
            with self.subTest(options=options), warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of overflow
                try:
                    picture = render(draw.choice(data), isovalues, **options)
                except DOCUMENTED as error:
                    self.assertTrue(str(error))
                else:
                    pictures += 1
                    self.assertEqual(picture.rgba.shape[2], 4)
        self.assertGreater(pictures, count // 20)


if __name__ == "__main__":
    unittest.main()
