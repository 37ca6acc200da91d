#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The gallery's pictures are made where there is no display, and none is like another."""

import os
import subprocess
import sys
import tempfile
import unittest

from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkPNGReader
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

SCRIPT = os.path.join(os.path.dirname(__file__), "../../Examples/Python/gallery.py")
NAMES = ["plain", "shadows", "occluded", "translucent", "clipped", "capped", "cropped",
         "coloured", "projected", "rectilinear", "blocks"]


def write_volume(file_name):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-20, 20, -20, 20, -20, 20)
    writer = vtkMetaImageWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(file_name)
    writer.Write()


def read(file_name):
    reader = vtkPNGReader()
    reader.SetFileName(file_name)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    return [scalars.GetTuple4(i) for i in range(0, scalars.GetNumberOfTuples(), 7)]


class TestGallery(unittest.TestCase):
    def test_pictures(self):
        environment = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
        with tempfile.TemporaryDirectory() as folder:
            volume = os.path.join(folder, "waves.mhd")
            write_volume(volume)
            subprocess.run([sys.executable, SCRIPT, volume, "150", folder], env=environment,
                           check=True, stdout=subprocess.DEVNULL)
            pictures = [read(os.path.join(folder, name + ".png")) for name in NAMES]
        covered = sum(1 for pixel in pictures[0] if pixel[3] > 0)
        self.assertGreater(covered, len(pictures[0]) / 10)
        for i, picture in enumerate(pictures):
            for other in pictures[:i]:
                different = sum(1 for a, b in zip(picture, other) if a != b)
                self.assertGreater(different, len(picture) / 200, NAMES[i])

    def test_usage(self):
        result = subprocess.run([sys.executable, SCRIPT], capture_output=True, check=False)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn(b"gallery.py VOLUME.mhd ISOVALUE FOLDER", result.stderr)


if __name__ == "__main__":
    unittest.main()
