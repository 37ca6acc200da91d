#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Where there is not enough memory, there is one error, and what fits works afterwards."""

import resource
import subprocess
import sys
import unittest

from Waves import make_waves
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkCamera


def limit_memory(mebibytes):
    """What the process may take from now on."""
    with open("/proc/self/statm", encoding="ascii") as statm:
        used = int(statm.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + (mebibytes << 20),) * 2)


def run():
    _, mapper, volume = make_waves()
    camera = vtkCamera()
    camera.SetPosition(10.0, 20.0, 60.0)
    camera.SetClippingRange(1.0, 200.0)

    def render(size):
        output = vtkImageData()
        if not mapper.RenderToImage(volume, camera, None, size, size, output):
            return None
        return bytes(memoryview(output.GetPointData().GetArray("Colors")))

    expected = render(64)
    assert expected
    limit_memory(512)
    assert render(30000) is None
    assert render(64) == expected
    print("survived")


class TestMemory(unittest.TestCase):
    def test_picture_that_does_not_fit(self):
        run = subprocess.run([sys.executable, __file__, "--run"], capture_output=True, text=True, timeout=100)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("survived", run.stdout)
        self.assertEqual(run.stderr.count("There is not enough memory."), 1, run.stderr)


if __name__ == "__main__":
    if sys.argv[1:] == ["--run"]:
        run()
    else:
        unittest.main()
