#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The scenes of Examples/Python/scenes.py are the baselines; what was drawn is left in ./scenes."""

import os
import unittest

from PictureTesting import ISOVALUE, SIZE, PictureTestCase, difference, make_waves, read
import scenes


class TestScenes(PictureTestCase):
    @classmethod
    def setUpClass(cls):
        scenes.write_all(make_waves(), ISOVALUE, "scenes", SIZE)
        cls.pictures = {scene.__name__: read(os.path.join("scenes", scene.__name__ + ".png"))
                        for scene in scenes.SCENES}

    def test_baselines(self):
        self.check_baselines(self.pictures, "scenes")

    def test_none_is_like_another(self):
        self.check_none_is_like_another(self.pictures)

    def test_smart_mapper_draws_our_picture(self):
        scenes.Scene(make_waves(), ISOVALUE, SIZE).write("scenes/plain.png")
        self.assertEqual(difference(read("scenes/plain.png"), self.pictures["smart_mapper"]), 0.0)

    def test_usage(self):
        self.check_usage("scenes.py")


if __name__ == "__main__":
    unittest.main()
