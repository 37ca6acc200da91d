#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A volume of 1 GB, drawn by a process that may have 256 MB: the picture is that of the samples in memory."""

import hashlib
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "Support"))
from LimitedMemory import LimitedMemory
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkMappedImageReader
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkMetaImageReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkVolume

LIMIT = 256 << 20
DIMENSIONS = (1024, 1024, 512)
SLICE = 2 * 1024 * 1024  # bytes
READERS = {"mapped": vtkMappedImageReader, "read": vtkMetaImageReader}


def write_volume(folder):
    """Zero, which takes no room in the file, but for a box in its middle."""
    samples = folder / "volume.raw"
    with open(samples, "wb") as file:
        file.seek(250 * SLICE)
        for _ in range(12):
            file.write(bytes(SLICE // 4) + b"\x64\x00" * (SLICE // 4) + bytes(SLICE // 4))
    os.truncate(samples, 512 * SLICE)
    header = folder / "volume.mhd"
    sizes = " ".join(map(str, DIMENSIONS))
    header.write_text(f"NDims = 3\nDimSize = {sizes}\nElementType = MET_SHORT\nElementByteOrderMSB = "
                      f"{sys.byteorder == 'big'}\nElementDataFile = volume.raw\n", encoding="ascii")
    return header


def read_own_memory():
    """In bytes, without pages of files."""
    (line,) = (line for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines()
               if line.startswith("RssAnon:"))
    return int(line.split()[1]) << 10


def draw(way, file_name):
    """Prints a picture in short, and what the process has beyond what the mapper tells, in bytes."""
    before = read_own_memory()
    reader = READERS[way]()
    reader.SetFileName(file_name)
    mapper, volume, renderer, picture = vtkIsosurfaceRayTraceMapper(), vtkVolume(), vtkRenderer(), vtkImageData()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.SetMaximumBrickMemory(32)
    volume.SetMapper(mapper)
    volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 50.0)
    volume.GetProperty().GetScalarOpacity().AddPoint(50.0, 1.0)
    reader.Update()
    renderer.ResetCamera(reader.GetOutput().GetBounds())
    camera = renderer.GetActiveCamera()
    camera.Elevation(30.0)
    assert mapper.RenderToImage(volume, camera, None, 64, 64, picture)
    colors = bytes(memoryview(picture.GetPointData().GetArray("Colors")))
    assert max(colors) > 0
    told = mapper.GetMacrocellMemory() + mapper.GetBrickMemory()
    print(hashlib.sha256(colors).hexdigest(), read_own_memory() - before - told)


class TestMappedMemory(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.volume = write_volume(Path(folder.name))

    def draw(self, way, prefix=()):
        return subprocess.run([*prefix, sys.executable, __file__, way, str(self.volume)], capture_output=True, text=True,
                              timeout=200, check=False)

    def test_limited_memory(self):
        with LimitedMemory(LIMIT) as limited:
            if not limited.is_possible:
                self.skipTest("this system has no control groups for memory that this user may make")
            mapped = self.draw("mapped", limited.prefix)
            self.assertEqual((mapped.returncode, mapped.stderr), (0, ""))
            self.assertIn(self.draw("read", limited.prefix).returncode, (-9, 137))
        picture, untold = mapped.stdout.split()
        self.assertEqual(picture, self.draw("read").stdout.split()[0])
        self.assertLess(int(untold), 32 << 20)


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] in READERS:
        draw(*sys.argv[1:])
    else:
        unittest.main()
