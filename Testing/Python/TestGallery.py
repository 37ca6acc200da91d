#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of Examples/Python/gallery.py, made where there is no display, are the baselines;
what was made is left in ./gallery."""

import os
import subprocess
import sys
import tempfile
import unittest

from PictureTesting import EXAMPLES, ISOVALUE, SIZE, PictureTestCase, make_waves, read, write_waves
import gallery


class TestGallery(PictureTestCase):
    @classmethod
    def setUpClass(cls):
        os.environ.pop("DISPLAY", None)
        gallery.write_all(make_waves(), ISOVALUE, "gallery", SIZE)
        cls.pictures = {scene.__name__: read(os.path.join("gallery", scene.__name__ + ".png"))
                        for scene in gallery.SCENES}

    def test_baselines(self):
        self.check_baselines(self.pictures, "gallery")

    def test_none_is_like_another(self):
        self.check_none_is_like_another(self.pictures)

    def test_script(self):
        """It reads a file, and makes all pictures, larger."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [sys.executable, os.path.join(EXAMPLES, "gallery.py"), write_waves(folder),
                 str(ISOVALUE), folder],
                check=True, stdout=subprocess.DEVNULL)
            for name in self.pictures:
                self.assertEqual(len(read(os.path.join(folder, name + ".png"))), 960 * 960, name)

    def test_usage(self):
        self.check_usage("gallery.py")


if __name__ == "__main__":
    unittest.main()
