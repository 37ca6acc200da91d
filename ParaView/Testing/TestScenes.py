#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Each scene looks as its baseline."""

import unittest

from Support import HERE, differences, draw

BASELINES = HERE / "Baseline"


class TestScenes(unittest.TestCase):
    def test_baselines(self):
        names = sorted(path.stem for path in BASELINES.glob("*.png"))
        for name, path in draw(1, names).items():
            with self.subTest(scene=name):
                # Polygons, and ParaView's smoothing, are OpenGL's.
                changed = int((differences(path, BASELINES / f"{name}.png") > 10).sum())
                print(f"{name}: {changed} pixels differ from the baseline")
                self.assertLessEqual(changed, 60)


if __name__ == "__main__":
    unittest.main()
