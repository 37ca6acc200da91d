#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every snippet of Documentation/python.md and of the tutorials, and README.md's line, run with data of the names that they
read, and so does pictures.py."""

import contextlib
import io
import os
import re
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkOverlappingAMR
from vtkmodules.vtkIOImage import vtkNIFTIImageWriter
from vtkmodules.vtkIOXML import vtkXMLUniformGridAMRWriter, vtkXMLUnstructuredGridWriter
from vtkIsosurfaceRayTracing import isosurface, read, render

from DicomSlices import write_dicom_slices
from MeshTesting import ball, make_grid
from PackageTesting import make_ball
from PictureTesting import EXAMPLES, make_interactor
from TestAmr import NESTED, fill
from TestIsosurface import PlotterOfPyVista

DOCUMENTATION = Path(EXAMPLES, "../../Documentation")
DOCUMENT = DOCUMENTATION / "python.md"
TUTORIALS = sorted(DOCUMENTATION.glob("tutorial-*.md"))
README = Path(EXAMPLES, "../../README.md")


def snippets_of(document):
    return re.findall(r"```python\n(.*?)```", document.read_text(encoding="utf-8"), re.DOTALL)


def snippets():
    """The second one of README.md is tested in TestExamples.py."""
    return sum(map(snippets_of, TUTORIALS), snippets_of(DOCUMENT) + snippets_of(README)[:1])


def make_ct():
    """A ball of bone in one of flesh, in air."""
    array = make_ball(41)
    values = np.where(array < 0.0, -1024.0, np.where(array < 0.3, 0.0, 2986.0))
    return isosurface(values.astype(np.int16), 300).GetMapper().GetInput()


def write_data():
    """What the snippets read, in the current folder."""
    os.mkdir("ct")
    write_dicom_slices(make_ct(), Path("ct"))
    brain = vtkNIFTIImageWriter()
    brain.SetInputData(make_ct())
    brain.SetFileName("brain.nii.gz")
    brain.Write()
    mesh = make_grid(VTK_TETRA, ball)
    for name, values in (("speed", [ball(mesh.GetPoint(i)) for i in range(mesh.GetNumberOfPoints())]),
                         ("pressure", vtk_to_numpy(mesh.GetPoints().GetData())[:, 0])):  # fmt: skip
        array = numpy_to_vtk(np.array(values, dtype=float), deep=True)
        array.SetName(name)
        mesh.GetPointData().AddArray(array)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(mesh)
    for name in ("flow.vtu", "flow0.vtu", "flow1.vtu", "flow2.vtu"):
        writer.SetFileName(name)
        writer.Write()
    cluster = vtkOverlappingAMR()
    for grid in fill(cluster, NESTED, of_cells=True):
        grid.GetCellData().GetScalars().SetName("Density")
    writer = vtkXMLUniformGridAMRWriter()
    writer.SetInputData(cluster)
    writer.SetFileName("cluster.vthb")
    writer.Write()


def make_pyvista():
    class Plotter(PlotterOfPyVista):
        def show(self):
            self.window.Render()

    pyvista = types.ModuleType("pyvista")
    pyvista.Plotter, pyvista.read = Plotter, read
    return pyvista


class TestPythonDocument(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(temporary.name)

    def run_snippet(self, snippet):
        printed, scope = io.StringIO(), {}
        with contextlib.redirect_stdout(printed):
            exec(compile(snippet, DOCUMENT.name, "exec"), scope)
        return scope, printed.getvalue()

    def test_snippets(self):
        write_data()
        self.assertGreater(len(snippets()), 20)
        small = mock.patch.dict(render.__kwdefaults__, size=(100, 80))  # in less time
        users = mock.patch("vtkmodules.vtkRenderingCore.vtkRenderWindowInteractor", make_interactor)
        with mock.patch.dict(sys.modules, pyvista=make_pyvista()), small, users:
            for number, snippet in enumerate(snippets()):
                with self.subTest(number=number):
                    scope, printed = self.run_snippet(re.sub(r"size=\(\d+, \d+\)", "size=(100, 80)", snippet))
                    for line in re.findall(r"print\(.*\)  # (.*)", snippet):
                        self.assertEqual(printed, line + "\n")
                    if "hits" in scope:
                        self.assertGreater(max(scope["depths"]), 20.0)
        for name in ("skull.png", "brain.png", "frame3.png", "head.png", "half.png", "turn5.png", "flow.png", "frame2.png",
                     "cluster.png"):
            self.assertTrue(Path(name).exists(), name)

    def test_version(self):
        (command,) = re.findall(r"`python3 -c \"(.*)\"`", (DOCUMENTATION / "faq.md").read_text(encoding="utf-8"))
        self.assertRegex(self.run_snippet(command)[1], r"^\d+\.\d+\.\d+\n$")

    def test_pictures(self):
        write_data()
        import pictures  # of the examples

        arguments, printed = ["pictures.py", "ct", "brain.nii.gz", "pictures"], io.StringIO()
        with mock.patch.object(pictures, "SIZE", (80, 80)), mock.patch.object(sys, "argv", arguments):
            with contextlib.redirect_stdout(printed):
                pictures.main()
        names = {Path(line).name for line in printed.getvalue().split()}
        self.assertEqual({path.name for path in Path("pictures").iterdir()}, names)
        shown = {image.replace("-", "_") for image in re.findall(r"images/python-(.*?)\)", DOCUMENT.read_text(encoding="utf-8"))}
        self.assertEqual(names, shown)
        with mock.patch.object(sys, "argv", arguments[:2]), self.assertRaisesRegex(SystemExit, "pictures.py CT MR FOLDER"):
            pictures.main()


if __name__ == "__main__":
    unittest.main()
