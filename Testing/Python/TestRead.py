#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""read() of the Python package: files of every format, folders of DICOM slices, and what is damaged."""

import gzip
import itertools
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path
from unittest import mock

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonCore import VTK_SHORT, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkImageData, vtkMultiBlockDataSet, vtkOverlappingAMR
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter
from vtkmodules.vtkIOLegacy import vtkDataSetWriter
from vtkmodules.vtkIOParallelXML import (
    vtkXMLPImageDataWriter,
    vtkXMLPStructuredGridWriter,
    vtkXMLPUnstructuredGridWriter,
)
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLMultiBlockDataWriter,
    vtkXMLStructuredGridWriter,
    vtkXMLUniformGridAMRWriter,
    vtkXMLUnstructuredGridWriter,
)
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkIsosurfaceRayTracing import isosurface, read, render, vtkMappedImageReader
from vtkIsosurfaceRayTracing._files import _limits_of_groups

from DicomSlices import write_dicom_slices
from MeshTesting import ball, make_grid, make_structured_grid
from PackageTesting import SIZE
from PictureTesting import ISOVALUE, make_waves, write_bad_volumes
from TestAmr import NESTED, fill


sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "Support"))
from LimitedMemory import LimitedMemory, write_zeros


def make_short_waves(radius):
    shorts = vtkImageShiftScale()
    shorts.SetInputData(make_waves(radius))
    shorts.SetOutputScalarTypeToShort()
    shorts.Update()
    return shorts.GetOutput()


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
        image = make_short_waves(20)
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
            # In DICOM, from the first sample: along rows, down columns (which are written from the top), and by slices.
            along, down = np.array(orientation[:3]), np.array(orientation[3:])
            expected = 2 * along + 1 * down + 6 * np.abs(np.cross(along, down))
            np.testing.assert_allclose(place, expected * [-1, -1, 1], atol=1e-5)  # to NIfTI's axes
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

    def test_spacing_of_slices(self):
        """DICOM names the distance of rows first, which VTK's reader took for that in a row before 9.6."""
        image = make_waves(5)
        image.SetSpacing(0.75, 1.5, 2.0)
        self.assertEqual(read(self.write_slices("uneven", image)).GetSpacing(), (0.75, 1.5, 2.0))

    @unittest.skipUnless(hasattr(os, "mkfifo"), "pipes have names there")
    def test_slices_beside_a_pipe(self):
        """VTK's reader would wait for it."""
        expected = read(self.write_slices("files", make_waves(9)))
        slices = self.write_slices("slices", make_waves(9))
        os.mkfifo(slices / "000.pipe")
        (slices / "link").symlink_to("nowhere")
        image = read(os.path.relpath(slices))
        self.assertEqual(image.GetBounds(), expected.GetBounds())
        self.assertEqual(bytes(memoryview(image.GetPointData().GetScalars())),
                         bytes(memoryview(expected.GetPointData().GetScalars())))  # fmt: skip

    def test_slices_that_are_missing(self):
        slices = self.write_slices("missing", make_waves(9))
        (slices / "003.dcm").unlink()
        with self.assertWarnsRegex(RuntimeWarning, r"slices are missing.*from 004.dcm to 002.dcm it is 2 mm, elsewhere 1"):
            self.assertEqual(read(slices).GetSpacing()[2], 1.0)

    def test_slices_of_a_tilted_gantry(self):
        tilted = self.write_slices("tilted", make_waves(9), (1, 0, 0, 0, 0.8, 0.6))
        with self.assertWarnsRegex(RuntimeWarning, "the slices are shifted against each other by up to .* tilted gantry"):
            read(tilted)

    def test_folders_that_are_no_series(self):
        """VTK's reader writes beyond its memory, or takes some of the slices."""
        image, larger = make_waves(9), make_waves(15)
        scout = self.write_slices("scout", image)
        (self.write_slices("larger", larger) / "000.dcm").rename(scout / "scout.dcm")
        with self.assertRaisesRegex(ValueError, "slices of different sizes.*000.dcm and scout.dcm; put each series"):
            read(scout)
        for shift, message in ((0.0, "several slices at one place"), (100.0, "has 38 slices, of which VTK's reader takes 19")):
            two = self.write_slices(f"two{shift}", image)
            image.SetOrigin(0.0, 0.0, shift)
            for path in self.write_slices(f"second{shift}", image).iterdir():
                (two / f"second{path.name}").write_bytes(path.read_bytes().replace(b"1.2\0", b"1.3\0"))
            with self.assertRaisesRegex(ValueError, message):
                read(two)
        compressed = self.write_slices("compressed", image)
        (compressed / "004.dcm").write_bytes(
            (compressed / "004.dcm").read_bytes().replace(b"1.2.840.10008.1.2.1\0", b"1.2.840.10008.1.2.5\0"))
        with self.assertRaisesRegex(ValueError, r"004.dcm is compressed or big-endian \(transfer syntax 1.2.840.10008.1.2.5\)"):
            read(compressed)
        cut = self.write_slices("cut", image)
        (cut / "004.dcm").write_bytes((cut / "004.dcm").read_bytes()[:600])
        with self.assertRaisesRegex(ValueError, "004.dcm is damaged: it ends before its last samples"):
            read(cut)
        for path in sorted(compressed.iterdir())[1:]:
            path.unlink()
        with self.assertRaisesRegex(ValueError, "has one slice, 000.dcm"):
            read(compressed)
        with self.assertRaisesRegex(ValueError, "is a file of DICOM; name the folder"):
            read(compressed / "000.dcm")

    def test_scaled_slices(self):
        """VTK's reader scales them to 16 bits; what does not fit would be something else."""
        image = vtkImageData()
        image.SetDimensions(3, 2, 2)
        image.AllocateScalars(VTK_SHORT, 1)
        values = vtk_to_numpy(image.GetPointData().GetScalars())
        for most, slope, intercept, fits in ((30000, 1, -1024, True), (-32000, 1, -1024, False), (3000, 10, 0, True),
                                             (4000, 10, 0, False), (20000, 2, 0, False), (1000, 0.5, 3, True)):
            with self.subTest(most=most, slope=slope, intercept=intercept):
                values[:] = np.linspace(0, most, values.size)
                slices = self.write_slices(f"{most} {slope}", image, slope=slope, intercept=intercept)
                if fits:
                    extreme = np.abs(vtk_to_numpy(read(slices).GetPointData().GetScalars())).max()
                    self.assertEqual(extreme, most * slope + intercept)
                else:
                    with self.assertRaisesRegex(ValueError, "0.*.dcm may have values that do not fit the 16 bits"):
                        read(slices)

    def test_slices_of_negative_values_with_a_fractional_slope(self):
        """VTK's reader takes their samples for unsigned ones."""
        image = vtkImageData()
        image.SetDimensions(4, 3, 5)
        image.AllocateScalars(VTK_SHORT, 1)
        values = vtk_to_numpy(image.GetPointData().GetScalars())
        values[:] = np.linspace(-32768, 32767, values.size)
        read_values = vtk_to_numpy(read(self.write_slices("signed", image, slope=0.25, intercept=3)).GetPointData().GetScalars())
        np.testing.assert_array_equal(np.sort(read_values), np.sort(0.25 * values + 3.0))

    def test_scaled_slices_of_bytes(self):
        """VTK's reader scales them to 8 bits, and takes signed ones for unsigned ones."""
        image = vtkImageData()
        image.SetDimensions(4, 3, 5)
        for kind, slope, intercept in ((VTK_UNSIGNED_CHAR, 1, 0), (VTK_UNSIGNED_CHAR, 0.5, 3), (VTK_UNSIGNED_CHAR, 1, -1),
                                       (VTK_UNSIGNED_CHAR, 2, 0), (VTK_SIGNED_CHAR, 1, 0)):
            with self.subTest(kind=kind, slope=slope, intercept=intercept):
                image.AllocateScalars(kind, 1)
                values = vtk_to_numpy(image.GetPointData().GetScalars())
                values[:] = np.linspace(-100 if kind == VTK_SIGNED_CHAR else 0, 120, values.size)
                slices = self.write_slices(f"bytes {kind} {slope} {intercept}", image, slope=slope, intercept=intercept)
                if kind == VTK_UNSIGNED_CHAR and (slope, intercept) in ((1, 0), (0.5, 3)):
                    found = vtk_to_numpy(read(slices).GetPointData().GetScalars())
                    np.testing.assert_array_equal(np.sort(found), np.sort(slope * values.astype(float) + intercept))
                else:
                    with self.assertRaisesRegex(ValueError, "may have values that do not fit the 8 bits"):
                        read(slices)

    def write_slices(self, name, image, orientation=(1, 0, 0, 0, 1, 0), **scale):
        slices = self.folder / name
        slices.mkdir()
        write_dicom_slices(image, slices, orientation, **scale)
        return slices

    def test_scaled_nifti(self):
        """What is stored times scl_slope, plus scl_inter."""
        stored = make_waves(5)
        writer = vtkNIFTIImageWriter()
        writer.SetRescaleSlope(0.5)
        writer.SetRescaleIntercept(-1024.0)
        scaled = read(self.write(writer, "scaled.nii.gz", stored))
        values = [vtk_to_numpy(each.GetPointData().GetScalars()) for each in (stored, scaled)]
        np.testing.assert_allclose(values[1], 0.5 * values[0] - 1024.0, rtol=1e-6)

    def test_several_volumes_in_a_nifti(self):
        """The first is read, and it is told."""
        several = make_waves(2)
        several.GetPointData().SetScalars(numpy_to_vtk(np.arange(375.0).reshape(125, 3)))
        writer = vtkNIFTIImageWriter()
        writer.SetTimeDimension(3)
        path = self.write(writer, "several.nii", several)
        with self.assertWarnsRegex(RuntimeWarning, "several.nii has 3 volumes; this is the first of them"):
            values = vtk_to_numpy(read(path).GetPointData().GetScalars())
        np.testing.assert_array_equal(values, np.arange(0.0, 375.0, 3.0))

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
        matrix.DeepCopy((0, -1, 0, 5, 3, 0, 0, 6, 0, 0, 2, 7, 0, 0, 0, 1))
        writer = vtkNIFTIImageWriter()
        writer.SetSFormMatrix(matrix)  # with spacings of its own
        cubes = make_waves(5)
        cubes.SetSpacing(1.0, 1.0, 1.0)
        image = read(self.write(writer, "sform.nii", cubes))
        self.assertEqual((image.GetSpacing(), image.GetOrigin()), ((3.0, 1.0, 2.0), (5.0, 6.0, 7.0)))
        writer.SetQFormMatrix(vtkMatrix4x4())  # of the scanner
        image = read(self.write(writer, "registered.nii", cubes))
        self.assertEqual((image.GetSpacing(), image.GetOrigin()), ((3.0, 1.0, 2.0), (5.0, 6.0, 7.0)))
        matrix.SetElement(0, 0, 0.5)  # no axes
        writer = vtkNIFTIImageWriter()
        writer.SetSFormMatrix(matrix)
        with self.assertWarnsRegex(RuntimeWarning, "sheared.nii: the axes that its sform gives are not .* left out"):
            image = read(self.write(writer, "sheared.nii", make_waves(5)))
        self.assertTrue(image.GetDirectionMatrix().IsIdentity())
        rigid = vtkMatrix4x4()
        rigid.SetElement(0, 3, 8.0)
        writer.SetQFormMatrix(rigid)
        with self.assertWarnsRegex(RuntimeWarning, "both.nii: the axes that its sform .* those of its qform are taken"):
            image = read(self.write(writer, "both.nii", make_waves(5)))
        self.assertEqual(image.GetOrigin(), (8.0, 0.0, 0.0))

    def test_directions_in_headers(self):
        """Of NRRD and MetaImage: a marked sample is where the header puts it, also where it is used in the file."""
        samples = np.zeros((11, 8, 7), np.int16)
        samples[2, 1, 5] = 100
        (self.folder / "marked.raw").write_bytes(samples.tobytes(order="F"))
        axes = np.array([(0.6, 0.8, 0.0), (0.0, 0.0, 1.0), (0.8, -0.6, 0.0)])  # rows, of each axis
        steps, origin = axes * [[0.5], [2.0], [3.0]], np.array([10.0, -20.0, 30.0])
        metaimage = ("NDims = 3\nBinaryData = True\nTransformMatrix = {}\nOffset = 10 -20 30\nElementSpacing = 0.5 2 3\n"
                     "DimSize = 11 8 7\n{}ElementType = MET_SHORT\nElementDataFile = marked.raw\n")
        nrrd = ("NRRD0005\ntype: short\ndimension: 3\n{}\nsizes: 11 8 7\nspace directions: {}\nspace origin: (10,-20,30)\n"
                "endian: little\nencoding: raw\ndata file: marked.raw\n")
        matrix, vectors = " ".join(map(str, axes.ravel())), " ".join("({},{},{})".format(*each) for each in steps)
        headers = [(f"{code}.mhd", metaimage.format(matrix, line), turn) for code, line, turn in (
            ("lps", "AnatomicalOrientation = RAI\n", (-1, -1, 1)), ("unknown", "AnatomicalOrientation = ???\n", (1, 1, 1)),
            ("none", "", (1, 1, 1)))]  # fmt: skip
        headers += [(f"{i}.nhdr", nrrd.format(space, vectors), turn) for i, (space, turn) in enumerate((
            ("space: left-posterior-superior", (-1, -1, 1)), ("space: LPS", (-1, -1, 1)), ("space: RAS", (1, 1, 1)),
            ("space: right-anterior-superior", (1, 1, 1)), ("space: left-anterior-superior", (-1, 1, 1)),
            ("space: LAS", (-1, 1, 1)), ("space: 3D-left-handed", (1, 1, 1)), ("space: scanner-xyz", (1, 1, 1)),
            ("space dimension: 3", (1, 1, 1))))]  # fmt: skip
        for name, header, turn in headers:
            (self.folder / name).write_text(header, encoding="ascii")
            for memory in (1 << 40, 1):
                with mock.patch("vtkIsosurfaceRayTracing._files._count_memory", return_value=memory):
                    image = read(self.folder / name)
                marked = int(np.argmax(vtk_to_numpy(image.GetPointData().GetScalars())))
                expected = turn * (origin + np.array([2, 1, 5]) @ steps)
                np.testing.assert_allclose(image.GetPoint(marked), expected, atol=1e-12, err_msg=f"{name} {memory}")
                self.assertEqual(image.GetSpacing(), (0.5, 2.0, 3.0))
        identity, sheared = "1 0 0 0 1 0 0 0 1", "1 0 0 0.5 1 0 0 0 1"
        (self.folder / "upright.mha").write_text(
            metaimage.format(identity, "AnatomicalOrientation = RAI\n").replace("Transform", "# "), encoding="ascii")
        self.assertEqual(read(self.folder / "upright.mha").GetOrigin(), (-10.0, 20.0, 30.0))
        for name, header in (("sheared.mhd", metaimage.format(sheared, "")),
                             ("two.nhdr", nrrd.format("space: RAS", "(0.5,0,0) (0,2,0)"))):  # fmt: skip
            (self.folder / name).write_text(header, encoding="ascii")
            with self.subTest(name), self.assertWarnsRegex(RuntimeWarning, f"{name}: the axes that its header gives are not"):
                image = read(self.folder / name)
                self.assertTrue(image.GetDirectionMatrix().IsIdentity())
        last = nrrd.format("space: RAS", vectors + " none").replace("sizes: 11 8 7", "sizes: 11 8 7 1")
        for name, header, message in (
                ("text.nhdr", nrrd.format("space: RAS", vectors).replace("raw\n", "ASCII\n"), "as text"),
                ("last.nhdr", last.replace("dimension: 3", "dimension: 4"), "components, or several volumes")):  # fmt: skip
            (self.folder / name).write_text(header, encoding="ascii")
            with self.assertRaisesRegex(ValueError, f"{name} has .*{message}"):
                read(self.folder / name)

    def test_several_volumes_in_a_nrrd(self):
        """VTK's reader takes those along the last axis for slices, and the first axis for components."""
        (self.folder / "samples.raw").write_bytes(bytes(2640 * 2))
        for sizes, more, is_right in (
                ("10 11 12 2", "kinds: space space space time\n", False),
                ("10 11 12 2", "kinds: domain domain domain list\n", False),
                ("10 11 12 2", "kinds: domain domain domain domain\n", False),
                ("10 11 12 2", "space directions: (1,0,0) (0,1,0) (0,0,1) none\n", False),
                ("2 10 11 12", "space directions: none (1,0,0) (0,1,0) (0,0,1)\n", True),
                ("2 10 11 12", "kinds: vector domain domain domain\n", True),
                ("10 11 12 2", "kinds: list domain domain domain\n", True),
                ("2 10 11 12", "", True), ("10 11 12 2", "", False), ("2 10 11 12 1", "", False)):  # fmt: skip
            path = self.folder / "several.nhdr"
            path.write_text(f"NRRD0005\ntype: short\ndimension: {len(sizes.split())}\nsizes: {sizes}\n{more}endian: little\n"
                            "encoding: raw\ndata file: samples.raw\n", encoding="ascii")
            with self.subTest(sizes=sizes, more=more):
                self.assertEqual(vtkMappedImageReader().CanReadFile(str(path)), 3 if is_right else 0)
                if is_right:
                    self.assertEqual(read(path).GetNumberOfScalarComponents(), int(sizes.split()[0]))
                else:
                    with self.assertRaisesRegex(ValueError, "components, or several volumes, along an axis that is not the"):
                        read(path)

    def test_nrrd_where_mpi_is_loaded(self):
        """By "import vtk", where VTK has MPI: object factories make another reader, which needs a controller."""
        path = self.folder / "zeros.nrrd"
        path.write_bytes(b"NRRD0004\ntype: short\ndimension: 3\nsizes: 12 5 2\nendian: little\nencoding: raw\n\n" + bytes(240))
        code = f"""
try:
    import vtkmodules.vtkIOMPIImage
except ImportError:
    pass
from vtkIsosurfaceRayTracing import read, vtkMappedImageReader
mapped = vtkMappedImageReader()
mapped.SetFileName({str(path)!r})
mapped.Update()
for image in (read({str(path)!r}), mapped.GetOutput()):
    assert image.GetDimensions() == (12, 5, 2), image
"""
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_meshes(self):
        tetrahedra, curved = make_grid(VTK_TETRA, ball), make_structured_grid(ball)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, tetrahedra)
        for writer, name, mesh in ((vtkXMLPUnstructuredGridWriter(), "mesh.pvtu", tetrahedra),
                                   (vtkXMLPStructuredGridWriter(), "mesh.pvts", curved),
                                   (vtkXMLUnstructuredGridWriter(), "mesh.vtu", tetrahedra),
                                   (vtkDataSetWriter(), "mesh.vtk", tetrahedra),
                                   (vtkXMLStructuredGridWriter(), "mesh.vts", curved),
                                   (vtkXMLMultiBlockDataWriter(), "mesh.vtm", blocks)):  # fmt: skip
            path = self.write(writer, name, mesh)
            np.testing.assert_array_equal(render(path, 0.5, size=SIZE).rgba, render(mesh, 0.5, size=SIZE).rgba, name)

    def test_pieces_that_are_cut(self):
        """VTK's readers of grids in pieces crash."""
        for mode, (writer, name, data) in itertools.product(("Ascii", "Binary", "Appended"), (
                (vtkXMLPStructuredGridWriter, "cut.pvts", make_structured_grid(ball)),
                (vtkXMLPImageDataWriter, "cut.pvti", make_waves(3)))):
            writer = writer()
            getattr(writer, f"SetDataModeTo{mode}")()
            path = self.write(writer, name, data)
            (piece,) = [each for each in path.parent.rglob("cut*") if each.suffix == "." + path.suffix[2:]]
            whole = piece.read_bytes()
            for length in (len(whole) // 3, len(whole) * 9 // 10, len(whole) - 12):
                piece.write_bytes(whole[:length])
                with self.subTest(mode=mode, name=name, length=length), self.assertRaisesRegex(ValueError, "is damaged"):
                    read(path)
            piece.unlink()

    def test_all_arrays_of_legacy_files(self):
        mesh = make_grid(VTK_TETRA, ball)
        text = self.write(vtkDataSetWriter(), "mesh.vtk", mesh).read_text(encoding="ascii")
        for kind, values in (("SCALARS {} float\nLOOKUP_TABLE default", "1 "), ("VECTORS {} float", "1 2 3 ")):
            for name in ("one", "two"):
                text += kind.format(name) + "\n" + values * mesh.GetNumberOfPoints() + "\n"
        (self.folder / "mesh.vtk").write_text(text, encoding="ascii")
        points = read(self.folder / "mesh.vtk").GetPointData()
        self.assertEqual(points.GetScalars().GetName(), mesh.GetPointData().GetScalars().GetName())
        self.assertEqual(points.GetNumberOfArrays(), mesh.GetPointData().GetNumberOfArrays() + 2)
        self.assertEqual(points.GetArray("two").GetNumberOfComponents(), 3)

    def test_amr(self):
        amr = vtkOverlappingAMR()
        fill(amr, NESTED, of_cells=True)
        for name in ("amr.vth", "amr.vthb"):
            path = self.write(vtkXMLUniformGridAMRWriter(), name, amr)
            np.testing.assert_array_equal(render(path, 0.5, size=SIZE).rgba, render(amr, 0.5, size=SIZE).rgba, name)

    def test_amr_without_spacing(self):
        """VTK's reader crashes by it."""
        amr = vtkOverlappingAMR()
        fill(amr, NESTED, of_cells=True)
        path = self.write(vtkXMLUniformGridAMRWriter(), "amr.vthb", amr)
        text = path.read_text(encoding="ascii")
        path.write_text(re.sub('(level="0") spacing="[^"]*"', r"\1", text), encoding="ascii")
        with self.assertRaisesRegex(ValueError, "levels without a spacing.* vtkXMLHierarchicalBoxDataFileConverter"):
            read(path)

    def test_images_in_pieces(self):
        image = make_waves(8)
        expected = render(image, ISOVALUE, size=SIZE).rgba
        writer = vtkXMLPImageDataWriter()
        writer.SetNumberOfPieces(3)
        writer.SetEndPiece(2)
        picture = render(self.write(writer, "waves.pvti", image), ISOVALUE, size=SIZE).rgba.astype(int)
        self.assertLess((np.abs(picture - expected).max(axis=2) > 2).mean(), 0.001)

    def test_what_cannot_be_read(self):
        with self.assertRaisesRegex(FileNotFoundError, "there is no file absent.vti"):
            read("absent.vti")
        with self.assertRaisesRegex(ValueError, "has no DICOM slices; name the folder that the slices are in"):
            read(self.folder)
        (self.folder / "empty.vti").touch()
        with self.assertRaisesRegex(ValueError, "empty.vti is empty"):
            read(self.folder / "empty.vti")
        layer = vtkImageData()
        layer.SetDimensions(5, 4, 1)
        layer.AllocateScalars(VTK_SHORT, 1)
        with self.assertRaisesRegex(ValueError, "layer.nii is not a volume: it has 5 x 4 x 1 samples"):
            read(self.write(vtkNIFTIImageWriter(), "layer.nii", layer))
        (self.folder / "volume.txt").write_text("no volume", encoding="ascii")
        with self.assertRaisesRegex(ValueError, "does not know .*volume.txt; read it by a reader of VTK"):
            read(self.folder / "volume.txt")
        (self.folder / "surface.vtp").write_text("<VTKFile type='PolyData'></VTKFile>", encoding="ascii")
        with self.assertRaisesRegex(ValueError, "does not know .*surface.vtp"):
            read(self.folder / "surface.vtp")
        with self.assertRaises(TypeError):
            read(7)

    def test_files_larger_than_memory(self):
        image = make_waves()
        size = 4 * image.GetNumberOfPoints()
        writer = vtkMetaImageWriter()
        writer.SetCompression(False)
        names = [self.write(writer, "waves.mhd", image), self.folder / "waves.nhdr"]
        names[1].write_text("NRRD0004\ntype: float\ndimension: 3\nsizes: 41 41 41\nspacings: 1 1 1\nencoding: raw\n"
                            f"endian: {sys.byteorder}\ndata file: waves.raw\n", encoding="ascii")
        expected = [bytes(memoryview(read(name).GetPointData().GetScalars())) for name in names]
        compressed = self.write(vtkXMLImageDataWriter(), "compressed.vti", image)
        scaled = self.write(vtkNIFTIImageWriter(), "waves.nii", image)
        for memory in (size - 1, size // 2):
            with mock.patch("vtkIsosurfaceRayTracing._files._count_memory", return_value=memory):
                for name, samples in zip(names, expected):
                    data = read(name)
                    self.assertEqual(bytes(memoryview(data.GetPointData().GetScalars())), samples)
                    self.assertEqual((data.GetDimensions(), data.GetSpacing()), (image.GetDimensions(), image.GetSpacing()))
                    self.assertIsNotNone(render(data, ISOVALUE, size=(16, 16)))
                for name in (compressed, scaled):
                    with self.assertRaisesRegex(MemoryError, f"{name} asks for more memory.*uncompressed MetaImage"):
                        read(name)
        with mock.patch("vtkIsosurfaceRayTracing._files._count_memory", return_value=2 * size):
            with mock.patch("vtkIsosurfaceRayTracing._files.vtkMappedImageReader", side_effect=AssertionError):
                read(names[0])

    def test_limits_of_containers(self):
        """The least of the groups that a process is in, of either version."""
        for version, listed, limits, expected in (
            ("", "0::/", {"memory.max": "12345678"}, [12345678]),
            ("", "0::/a/b", {"memory.max": "max", "a/memory.max": "5000", "a/b/memory.max": "7000"}, [7000, 5000]),
            ("", "0::/of/the/host", {"memory.max": "5000"}, [5000]),
            ("", "0::/../../x", {"memory.max": "5000"}, [5000]),
            ("memory", "9:cpu:/\n3:memory:/a:1", {"memory.limit_in_bytes": "9000", "a:1/memory.limit_in_bytes": "8000"},
             [8000, 9000]),
            ("memory", "9:cpu:/", {"memory.limit_in_bytes": "9000"}, []),
        ):  # fmt: skip
            with self.subTest(listed), tempfile.TemporaryDirectory() as root:
                groups = {"proc/self/cgroup": listed}
                groups.update({f"sys/fs/cgroup/{version}/{name}": limit for name, limit in limits.items()})
                for name, text in groups.items():
                    (Path(root) / name).parent.mkdir(parents=True, exist_ok=True)
                    (Path(root) / name).write_text(text, encoding="ascii")
                self.assertEqual(list(_limits_of_groups(Path(root))), expected)
        self.assertEqual(list(_limits_of_groups(self.folder)), [])

    def test_within_a_container(self):
        """What is larger than half of its memory stays in the file."""
        header = write_zeros(self.folder)
        with LimitedMemory(300 << 20) as limited:
            if not limited.is_possible:
                self.skipTest("no process can be limited")
            code = f"import vtkIsosurfaceRayTracing as v; v.read({str(header)!r}); print(open('/proc/self/status').read())"
            result = subprocess.run([*limited.prefix, sys.executable, "-c", code], capture_output=True, text=True, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)
            peak = next(line for line in result.stdout.splitlines() if line.startswith("VmHWM:"))
            self.assertLess(int(peak.split()[1]), 200 << 10, peak)

    def test_nrrd_without_an_end_or_sizes(self):
        """VTK's reader does not come back from these."""
        header = "NRRD0004\ntype: short\ndimension: 3\nsizes: 3 3 3\nencoding: raw\nendian: little\n"
        for name, text, message in (
            ("cut.nrrd", header[:-9], "its header has no end"), ("cut.nhdr", header + "data file: x", "its header has no end"),
            ("none.nrrd", header.replace("sizes: 3 3 3\n", "") + "\n", "has no sizes"),
            ("two.nrrd", header.replace("3 3 3", "3 3") + "\n", "not as many as the dimension"),
            ("zero.nrrd", header.replace("3 3 3", "3 0 3") + "\n", "has no sizes"),
            ("order.nrrd", header.replace("dimension: 3\n", "").replace("encoding", "dimension: 3\nencoding") + "\n",
             "no dimension before its sizes"),
        ):  # fmt: skip
            path = self.folder / name
            path.write_text(text, encoding="ascii")
            with self.subTest(name), self.assertRaisesRegex(ValueError, message):
                read(path)
        # Hundreds of segments.
        segments = "".join(f"Segment{i}_Name:={'x' * 400}\n" for i in range(400))
        path = self.folder / "segments.nrrd"
        path.write_bytes((header.replace("3 3 3", "12 3 3") + segments + "\n").encode() + bytes(216))
        self.assertEqual(read(path).GetDimensions(), (12, 3, 3))
        self.assertTrue(vtkMappedImageReader().CanReadFile(str(path)))

    def test_nrrd_that_vtk_does_not_read(self):
        path = self.folder / "odd.nrrd"
        header = "NRRD0004\ntype: short\ndimension: 3\nsizes: 12 12 12\nendian: little\nencoding: {}\n{}\n"
        for encoding, skip, words in (("bzip2", "", "has the encoding 'bzip2'"), ("hex", "", "has the encoding 'hex'"),
                                      ("raw", "byte skip: 8\n", "byte skip"), ("raw", "line skip: 1\n", "line skip")):
            path.write_bytes(header.format(encoding, skip).encode() + bytes(2 * 12**3 + 8))
            with self.subTest(encoding=encoding, skip=skip), self.assertRaisesRegex(ValueError, words):
                read(path)
        path.write_bytes(header.format("raw", "byte skip: 0\n").encode() + bytes(2 * 12**3))
        self.assertEqual(read(path).GetDimensions(), (12, 12, 12))

    def test_compressed_nrrd_that_vtk_reads_wrongly(self):
        """Of what VTK's reader gives other samples than there are."""
        path, samples = self.folder / "packed.nhdr", self.folder / "packed.raw.gz"
        header = "NRRD0004\ntype: {}\ndimension: {}\nsizes: {}\n{}endian: {}\nencoding: gzip\ndata file: {}\n"
        random = np.random.default_rng(1).integers(0, 256, 2 * 12**3, np.uint8).tobytes()  # which does not become shorter
        for content, values, words in (
                (bytes(2 * 12**3), ("short", 3, "12 12 12", "", "big", samples.name), "compressed big-endian samples"),
                (bytes(12**3), ("uchar", 3, "12 12 12", "", "big", samples.name), None),
                (bytes(2 * 12**3), ("short", 3, "12 12 12", "", "little", samples.name), None),
                (random, ("short", 3, "12 12 12", "", "little", samples.name), "a file that is longer"),
                (bytes(2 * 12**3), ("short", 3, "12 12 12", "", "little", f"LIST\n{samples.name}"), "in several files"),
                (bytes(6 * 12**3), ("short", 4, "3 12 12 12", "kinds: vector domain domain domain\n", "little", samples.name),
                 "several components")):  # fmt: skip
            path.write_text(header.format(*values))
            samples.write_bytes(gzip.compress(content))
            with self.subTest(words):
                if words:
                    with self.assertRaisesRegex(ValueError, f"{words}.* with the encoding raw"):
                        read(path)
                else:
                    self.assertEqual(read(path).GetDimensions(), (12, 12, 12))

    def test_rows_of_compressed_nrrd_are_not_reversed(self):
        """By VTK's reader, which reverses those that are not compressed."""
        samples = np.arange(12 * 4 * 3, dtype="<i2")
        header = "NRRD0004\ntype: short\ndimension: 3\nspace: {}\nsizes: 12 4 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
        for space, encoding in itertools.product(("LAS", "left-anterior-superior", "3D-left-handed"), ("raw", "gzip")):
            path = self.folder / f"{space}-{encoding}.nrrd"
            content = gzip.compress(samples.tobytes()) if encoding == "gzip" else samples.tobytes()
            path.write_bytes(f"{header.format(space)}endian: little\nencoding: {encoding}\n\n".encode() + content)
            image = read(path)
            values = vtk_to_numpy(image.GetPointData().GetScalars())
            side = 1 if space == "3D-left-handed" else -1
            for point in (0, 17, 100, 143):
                x, y, z = np.rint(image.GetPoint(point)).astype(int)
                self.assertEqual(values[point], side * x + 12 * (y + 4 * z), (space, encoding))

    def test_metaimage_in_several_files(self):
        path, samples = self.folder / "several.mhd", np.arange(5 * 4 * 3, dtype="<i2").reshape(3, 20)
        header = "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 5 4 3\nElementType = MET_SHORT\nElementDataFile = "
        for i, each in enumerate(samples):
            (self.folder / f"part{i}.raw").write_bytes(each.tobytes())
        (self.folder / "cut.raw").write_bytes(bytes(39))
        (self.folder / "all.raw").write_bytes(samples.tobytes())
        for files, words in (
                ("LIST\npart0.raw\npart1.raw\npart2.raw\n", None), ("part%d.raw 0 2 1\n", None),
                ("LIST\npart0.raw\npart1.raw\n", "is damaged"), ("part%d.raw 0 1 1\n", "is damaged"),
                ("LIST\npart0.raw\ncut.raw\npart2.raw\n", "is damaged"),
                ("LIST\npart0.raw\nmissing.raw\npart2.raw\n", "in the file missing.raw, which is not there"),
                ("part%d.raw 1 3 1\n", "in the file part3.raw, which is not there"), ("LIST\n", "names no file of samples"),
                ("LIST 3D\nall.raw\n", "has the ElementDataFile 'LIST 3D'"), ("part%d.raw\n", "has the ElementDataFile 'part%d.raw'")):
            path.write_text(header + files)
            with self.subTest(files):
                if words:
                    with self.assertRaisesRegex(ValueError, words):
                        read(path)
                else:
                    np.testing.assert_array_equal(vtk_to_numpy(read(path).GetPointData().GetScalars()), samples.ravel())

    def test_metaimage_of_several_components_as_text(self):
        """VTK's reader takes the first of all numbers."""
        path = self.folder / "text.mhd"
        (self.folder / "text.txt").write_text(" ".join(map(str, range(5 * 4 * 3 * 2))) + "\n")
        path.write_text("ObjectType = Image\nNDims = 3\nBinaryData = False\nDimSize = 5 4 3\nElementType = MET_SHORT\n"
                        "ElementNumberOfChannels = 2\nElementDataFile = text.txt\n")
        with self.assertRaisesRegex(ValueError, "several components as text"):
            read(path)

    def test_pieces_that_do_not_fill_the_whole(self):
        """VTK's readers leave the rest as it was in memory."""
        for mode in ("Ascii", "Appended"):
            writer = vtkXMLImageDataWriter()
            getattr(writer, f"SetDataModeTo{mode}")()
            path = self.write(writer, f"{mode}.vti", make_waves(4))
            text = path.read_bytes()
            self.assertEqual(text.count(b'WholeExtent="-4 4 -4 4 -4 4"'), 1)
            path.write_bytes(text.replace(b'WholeExtent="-4 4 -4 4 -4 4"', b'WholeExtent="-4 4 -4 4 -4 5"'))
            with self.subTest(mode), self.assertRaisesRegex(ValueError, "its pieces do not fill its WholeExtent"):
                read(path)

    def test_nrrd_with_a_short_first_axis(self):
        """VTK's reader takes it for components."""
        path = self.folder / "short.nrrd"
        header = "NRRD0004\ntype: short\ndimension: 3\nsizes: 9 12 13\n{}endian: little\nencoding: raw\n\n"
        for more in ("", "kinds: domain domain domain\n", "space directions: (1,0,0) (0,1,0) (0,0,1)\n"):
            path.write_bytes(header.format(more).encode() + bytes(9 * 12 * 13 * 2))
            with self.subTest(more), self.assertRaisesRegex(ValueError, "fewer than ten samples, for components"):
                read(path)

    def test_metaimage_with_a_long_comment(self):
        """VTK's reader ends the process."""
        path = self.folder / "long.mha"
        for name, length in itertools.product(("Comment", "Name", "ObjectSubType"), (254, 255, 3000)):
            path.write_bytes(f"ObjectType = Image\nNDims = 3\n{name} = {'x' * length}\nBinaryData = True\nDimSize = 5 4 3\n"
                             "ElementType = MET_SHORT\nElementDataFile = LOCAL\n".encode() + bytes(120))
            with self.subTest(name=name, length=length):
                if length < 255:
                    self.assertEqual(read(path).GetDimensions(), (5, 4, 3))
                else:
                    with self.assertRaisesRegex(ValueError, f"a {name} of more than 254 characters"):
                        read(path)

    def test_types_of_metaimage(self):
        """VTK's reader takes four bytes for eight, or has no other samples."""
        path = self.folder / "types.mha"
        header = "NDims = 3\nBinaryData = True\nDimSize = 5 4 3\nElementType = {}\nElementDataFile = LOCAL\n"
        for kind in ("MET_LONG", "MET_ULONG", "MET_LONG_LONG", "MET_ULONG_LONG"):
            path.write_bytes(header.format(kind).encode() + bytes(480))
            with self.subTest(kind), self.assertRaisesRegex(ValueError, f"samples of the type {kind}, which VTK does not read"):
                read(path)

    def test_headers_without_their_samples(self):
        for name, header in (
                ("alone.mhd", "NDims = 3\nDimSize = 12 12 12\nElementType = MET_SHORT\nElementDataFile = samples.raw\n"),
                ("alone.nhdr", "NRRD0004\ntype: short\ndimension: 3\nsizes: 12 12 12\nendian: little\nencoding: raw\n"
                               "data file: samples.raw\n")):  # fmt: skip
            (self.folder / name).write_text(header, encoding="ascii")
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"{name} is a header.* in the file samples.raw"):
                read(self.folder / name)
        (self.folder / "samples.raw").write_bytes(bytes(2 * 12**3))
        for name in ("alone.mhd", "alone.nhdr"):
            self.assertEqual(read(self.folder / name).GetDimensions(), (12, 12, 12))

    def test_metaimage_as_text(self):
        """Its samples may have fewer bytes than in memory."""
        path = self.folder / "text.mha"
        header = "NDims = 3\nBinaryData = False\nDimSize = 5 4 3\nElementType = MET_DOUBLE\nElementDataFile = LOCAL\n"
        path.write_text(header + 60 * "7 ", encoding="ascii")
        self.assertEqual(read(path).GetScalarRange(), (7.0, 7.0))

    def test_metaimage_with_compressed_samples(self):
        path = self.folder / "packed.mha"
        packed = zlib.compress(bytes(range(60)))
        header = f"""NDims = 3\nBinaryData = True\nCompressedData = True\nCompressedDataSize = {len(packed)}
DimSize = 5 4 3\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n""".encode()
        path.write_bytes(header + packed)
        self.assertEqual(read(path).GetScalarRange(), (0.0, 59.0))
        path.write_bytes(header + packed[:-1])
        with self.assertRaisesRegex(ValueError, "is damaged"):
            read(path)
        path.write_bytes(re.sub(b"CompressedDataSize.*\n", b"", header) + packed)
        with self.assertRaisesRegex(ValueError, "without their CompressedDataSize"):
            read(path)

    def test_samples_that_are_cut(self):
        """VTK's readers leave those undefined that are not there."""
        metaimage = "NDims = 3\nBinaryData = True\nDimSize = 12 12 12\nElementType = MET_SHORT\n{}ElementDataFile = {}\n"
        nrrd = "NRRD0004\ntype: short\ndimension: 3\nsizes: 12 12 12\nendian: little\nencoding: raw\n\n"
        legacy = "# vtk DataFile Version 3.0\nmesh\n{}\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 8 float\n"
        (self.folder / "skipped.raw").write_bytes(bytes(2 * 12**3 + 9))
        for name, header, samples in (("cut.mha", metaimage.format("", "LOCAL"), bytes(2 * 12**3 - 1)),
                                      ("cut.mhd", metaimage.format("HeaderSize = 10\n", "skipped.raw"), b""),
                                      ("cut.nrrd", nrrd, bytes(2 * 12**3 - 1)),
                                      ("binary.vtk", legacy.format("BINARY"), bytes(95)),
                                      ("text.vtk", legacy.format("ASCII"), 23 * b"0 ")):  # fmt: skip
            (self.folder / name).write_bytes(header.encode() + samples)
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"{name} is damaged"):
                read(self.folder / name)

    def test_raw_appended_data_that_are_cut(self):
        """VTK's readers leave those undefined that are not there, or read on."""
        mesh = make_grid(VTK_TETRA, ball)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, mesh)
        for writer, name, data in ((vtkXMLImageDataWriter(), "raw.vti", make_waves(5)),
                                   (vtkXMLUnstructuredGridWriter(), "raw.vtu", mesh),
                                   (vtkXMLStructuredGridWriter(), "raw.vts", make_structured_grid(ball)),
                                   (vtkXMLMultiBlockDataWriter(), "raw.vtm", blocks)):  # fmt: skip
            for compressor, header, order in itertools.product(("None", "ZLib"), ("UInt32", "UInt64"), (0, 1)):
                writer.EncodeAppendedDataOff()
                writer.SetByteOrder(order)
                getattr(writer, f"SetHeaderTypeTo{header}")()
                getattr(writer, f"SetCompressorTypeTo{compressor}")()
                path = self.write(writer, name, data)
                file = self.folder / "raw/raw_0.vtu" if name == "raw.vtm" else path
                whole = file.read_bytes()
                samples = whole[:whole.rindex(b"\n  </AppendedData>")]
                with self.subTest(name, compressor=compressor, header=header, order=order):
                    file.write_bytes(samples)
                    read(path)
                    for length in (len(samples) - 1, samples.index(b"<AppendedData") + 50):
                        file.write_bytes(samples[:length])
                        with self.assertRaisesRegex(ValueError, "ends before its last samples"):
                            read(path)

    def test_nifti_that_vtk_does_not_know(self):
        """By some of these it ends the process."""
        path = self.folder / "odd.nii"
        for kind, sizes, words in ((1536, (3, 9, 9, 9), "of the type 1536"), (7, (3, 9, 9, 9), "of the type 7"),
                                   (16, (3, 9, 9, 0), r"the dimensions \[9, 9, 0\]"),
                                   (16, (5, 9, 9, 9, 1, 0), r"the dimensions \[9, 9, 9, 1, 0\]")):  # fmt: skip
            for order in "<>":
                old, new = bytearray(352), bytearray(544)
                struct.pack_into(f"{order}i{36}x{len(sizes)}h", old, 0, 348, *sizes)
                struct.pack_into(f"{order}hh", old, 70, kind, 32)
                old[344:347] = b"n+1"
                struct.pack_into(f"{order}i8s2h{len(sizes)}q", new, 0, 540, b"n+2\0\r\n\x1a\n", kind, 32, *sizes)
                for header in (old, new, gzip.compress(old)):
                    path.write_bytes(header)
                    with self.subTest(kind=kind, sizes=sizes, order=order), self.assertRaisesRegex(ValueError, words):
                        read(path)

    @unittest.skipUnless(hasattr(os, "mkfifo"), "pipes have names there")
    def test_pipes(self):
        """Nobody waits for them."""
        for suffix in (".mhd", ".nrrd", ".vti", ".vtu", ".nii", ".png"):
            path = self.folder / f"pipe{suffix}"
            os.mkfifo(path)
            with self.subTest(suffix), self.assertRaisesRegex(ValueError, "a pipe or a device"):
                read(path)
            self.assertFalse(vtkMappedImageReader().CanReadFile(str(path)))

    @unittest.skipUnless(sys.platform.startswith("linux"), "names are text there")
    def test_names_that_are_not_utf_8(self):
        image = make_short_waves(5)
        for writer, name in ((vtkXMLImageDataWriter(), "name.vti"), (vtkMetaImageWriter(), "name.mha"),
                             (vtkNIFTIImageWriter(), "name.nii"), (vtkDataSetWriter(), "name.vtk")):  # fmt: skip
            path = self.write(writer, name, image)
            other = os.path.join(self.folder, os.fsdecode(b"n\xe4me") + path.suffix)
            path.rename(other)
            with self.subTest(name):
                self.assertEqual(read(other).GetScalarRange(), image.GetScalarRange())
        slices = self.folder / os.fsdecode(b"sl\xefces")
        slices.mkdir()
        write_dicom_slices(image, slices)
        self.assertEqual(read(slices).GetDimensions(), image.GetDimensions())
        with self.assertRaisesRegex(ValueError, "is a file of DICOM"):
            read(slices / "000.dcm")

    def test_damaged_files(self):
        """Nothing but the exception tells of them."""
        for suffix in (".vti", ".vtu", ".pvti", ".pvtu", ".vtk", ".vtm", ".nii", ".nii.gz", ".nrrd", ".mha", ".png"):
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
