#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""read() of the Python package: files of every format, folders of DICOM slices, and what is damaged."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkMultiBlockDataSet
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter
from vtkmodules.vtkIOLegacy import vtkDataSetWriter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLMultiBlockDataWriter,
    vtkXMLStructuredGridWriter,
    vtkXMLUnstructuredGridWriter,
)
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkIsosurfaceRayTracing import isosurface, read, render

from MeshTesting import ball, make_grid, make_structured_grid
from PackageTesting import SIZE
from PictureTesting import ISOVALUE, make_waves, write_bad_volumes
from TestExamples import write_dicom_slices


class TestRead(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def write(self, writer, name, data):
        writer.SetInputData(data)
        writer.SetFileName(str(self.folder / name))
        writer.Write()
        return self.folder / name

    def test_volumes(self):
        """The same one in each format makes the same picture."""
        shorts = vtkImageShiftScale()
        shorts.SetInputData(make_waves())
        shorts.SetOutputScalarTypeToShort()
        shorts.Update()
        image = shorts.GetOutput()
        slices = self.folder / "slices"
        slices.mkdir()
        write_dicom_slices(image, slices)
        names = [slices, str(slices)]
        for writer, name in ((vtkMetaImageWriter(), "waves.mhd"), (vtkXMLImageDataWriter(), "waves.VTI"),
                             (vtkNIFTIImageWriter(), "waves.nii"), (vtkNIFTIImageWriter(), "waves.nii.gz"),
                             (vtkDataSetWriter(), "waves.vtk")):  # fmt: skip
            names.append(self.write(writer, name, image))
        samples = self.folder / "waves.raw"
        samples.write_bytes(bytes(memoryview(image.GetPointData().GetScalars())))
        names.append(self.folder / "waves.nhdr")
        names[-1].write_text("NRRD0004\ntype: short\ndimension: 3\nsizes: 41 41 41\nendian: little\nencoding: raw\n"
                             "data file: waves.raw\n", encoding="ascii")
        expected = render(image, ISOVALUE, size=SIZE).rgba.astype(int)
        for name in names:
            picture = render(name, ISOVALUE, size=SIZE).rgba
            self.assertLess((np.abs(picture - expected).max(axis=2) > 2).mean(), 0.001, name)

    def test_orientations_of_slices(self):
        """Of axial, coronal and sagittal ones: what is near the front, the left and the head of a patient is there."""
        marked = np.zeros((9, 9, 9), np.int16)
        marked[2, 7, 6] = 100
        image = isosurface(marked, 50).GetMapper().GetInput()
        for name, orientation in (("usual", (1, 0, 0, 0, 1, 0)), ("turned", (-1, 0, 0, 0, 1, 0)),
                                  ("coronal", (1, 0, 0, 0, 0, -1)), ("sagittal", (0, 1, 0, 0, 0, -1))):  # fmt: skip
            slices = self.folder / name
            slices.mkdir()
            write_dicom_slices(image, slices, orientation)
            found = read(slices)
            index = np.unravel_index(np.argmax(vtk_to_numpy(found.GetPointData().GetScalars())), (9, 9, 9), order="F")
            place = [0.0] * 3
            found.TransformContinuousIndexToPhysicalPoint(*map(float, index), place)
            # In DICOM, from the middle: along rows, down columns (which are written from the top), and by slices.
            along, down = np.array(orientation[:3]), np.array(orientation[3:])
            offset = (2 - 4) * along + (1 - 4) * down + (6 - 4) * np.abs(np.cross(along, down))
            middle = np.reshape(found.GetBounds(), (3, 2)).mean(axis=1)
            np.testing.assert_allclose(np.array(place) - middle, offset * [-1, -1, 1], atol=1e-5)  # to NIfTI's axes
            self.assertAlmostEqual(np.linalg.det(np.reshape([found.GetDirectionMatrix().GetElement(i, j)
                                   for i in range(3) for j in range(3)], (3, 3))), 1.0)  # not mirrored

    def test_heads_are_upright(self):
        """The slice that is highest in the patient is above in the picture."""
        cone = np.fromfunction(lambda x, y, z: 100.0 * (np.hypot(x - 10, y - 10) < 8 - 0.35 * z), (21, 21, 21))
        image = isosurface(cone.astype(np.int16), 50).GetMapper().GetInput()
        slices = self.folder / "head"
        slices.mkdir()
        write_dicom_slices(image, slices, (1, 0, 0, 0, 1, 0))
        covered = render(slices, 50, size=SIZE, view="y").rgba[:, :, 3] > 0
        rows = np.flatnonzero(covered.any(axis=1))
        self.assertLess(covered[rows[5]].sum(), 0.6 * covered[rows[-5]].sum())

    def test_matrices_of_nifti(self):
        matrix = vtkMatrix4x4()
        matrix.DeepCopy((0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1))
        writer = vtkNIFTIImageWriter()
        writer.SetQFormMatrix(matrix)
        writer.SetSFormMatrix(matrix)
        image = read(self.write(writer, "turned.nii", make_waves(5)))
        self.assertEqual([image.GetDirectionMatrix().GetElement(i, j) for i in range(3) for j in range(3)],
                         [0, -1, 0, 1, 0, 0, 0, 0, 1])  # fmt: skip
        self.assertEqual(image.GetOrigin(), (5.0, 6.0, 7.0))
        matrix.SetElement(0, 0, 0.5)  # no axes
        writer = vtkNIFTIImageWriter()
        writer.SetSFormMatrix(matrix)
        image = read(self.write(writer, "sheared.nii", make_waves(5)))
        self.assertTrue(image.GetDirectionMatrix().IsIdentity())

    def test_meshes(self):
        tetrahedra, curved = make_grid(VTK_TETRA, ball), make_structured_grid(ball)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, tetrahedra)
        for writer, name, mesh in ((vtkXMLUnstructuredGridWriter(), "mesh.vtu", tetrahedra),
                                   (vtkDataSetWriter(), "mesh.vtk", tetrahedra),
                                   (vtkXMLStructuredGridWriter(), "mesh.vts", curved),
                                   (vtkXMLMultiBlockDataWriter(), "mesh.vtm", blocks)):  # fmt: skip
            path = self.write(writer, name, mesh)
            np.testing.assert_array_equal(render(path, 0.5, size=SIZE).rgba, render(mesh, 0.5, size=SIZE).rgba, name)

    def test_what_cannot_be_read(self):
        with self.assertRaisesRegex(FileNotFoundError, "there is no file absent.vti"):
            read("absent.vti")
        with self.assertRaisesRegex(ValueError, "is damaged, or not a volume"):
            read(self.folder)
        (self.folder / "volume.txt").write_text("no volume", encoding="ascii")
        with self.assertRaisesRegex(ValueError, "no reader for .*volume.txt; read it by another one"):
            read(self.folder / "volume.txt")
        with self.assertRaises(TypeError):
            read(7)

    def test_damaged_files(self):
        """Nothing but the exception tells of them."""
        for suffix in (".vti", ".vtu", ".vtk", ".vtm", ".nii", ".nii.gz", ".nrrd", ".mha", ".png"):
            (self.folder / f"text{suffix}").write_text("<VTKFile type='ImageData'><oops>", encoding="ascii")
        names = write_bad_volumes(str(self.folder)) + [str(path) for path in self.folder.glob("text*")]
        code = f"""
from vtkIsosurfaceRayTracing import read
for name in {names!r}:
    try:
        data = read(name)
        print("read", name, data)
    except (ValueError, MemoryError) as error:
        assert name in str(error), error
"""
        result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
        printed = [line for line in result.stderr.splitlines() if not line.startswith("MetaImage: ")]  # by no class of VTK
        self.assertEqual((result.returncode, result.stdout, printed), (0, "", []))


if __name__ == "__main__":
    unittest.main()
