#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The example MeshWindow: the mouse turns the surface that it shows, and q closes it. Argument: the program."""

import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from vtkmodules.vtkCommonDataModel import VTK_TETRA
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from MeshTesting import SIZE as MESH_SIZE
from MeshTesting import make_grid
from ViewerSession import Viewer, differ, wait_for, xdotool

PROGRAM = sys.argv.pop(1)


class TestMeshWindow(unittest.TestCase):
    def test_window(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = make_grid(VTK_TETRA, sum)
            mesh.GetPointData().GetScalars().SetName("speed")
            writer = vtkXMLUnstructuredGridWriter()
            writer.SetInputData(mesh)
            writer.SetFileName(str(Path(folder) / "flow.vtu"))
            writer.Write()
            # A plane through its middle.
            window = Viewer(PROGRAM, folder, "flow.vtu", "speed", str(1.5 * MESH_SIZE), name="MeshWindow")
            self.addCleanup(window.process.kill)
            before = window.wait_for_rest()
            self.assertGreater(differ(before, before[:1, :1]), 0.02)
            x, y = window.middle

            def turn():
                """Again and again: the window may not listen yet, and takes its time on a busy machine."""
                xdotool("mousemove", x, y, "mousedown", 1, "mousemove", x + 100, y, "mouseup", 1)
                time.sleep(0.5)
                return differ(window.capture(), before) > 0.02

            wait_for(turn, "another side of the surface")
            self.assertEqual(window.quit(), "")

    def test_usage(self):
        result = subprocess.run([PROGRAM], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (1, "usage: MeshWindow FILE.vtu ARRAY ISOVALUE\n"))


if __name__ == "__main__":
    unittest.main()
