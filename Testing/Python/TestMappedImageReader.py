#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""vtkMappedImageReader gives what VTK's readers give, bit for bit, or one error with a remedy."""

import gzip
import os
import resource
import re
import struct
import sys
import tempfile
import unittest
from pathlib import Path

from PictureTesting import make_waves
from VtiFiles import write_vti
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkMappedImageReader
from vtkmodules.vtkCommonCore import (
    VTK_DOUBLE, VTK_FLOAT, VTK_INT, VTK_SHORT, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, vtkFloatArray)
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageCast
from vtkmodules.vtkIOImage import (
    vtkImageReader2, vtkMetaImageReader, vtkMetaImageWriter, vtkNIFTIImageReader, vtkNIFTIImageWriter, vtkNrrdReader)
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter
from vtkmodules.vtkRenderingCore import vtkCamera, vtkVolume

TYPES = (VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT, VTK_INT, VTK_FLOAT, VTK_DOUBLE)
DIMENSIONS = (7, 6, 5)
COUNT = 7 * 6 * 5
IS_LITTLE = sys.byteorder == "little"

METAIMAGE = """\
Comment = Spaces
ObjectType = Image
NDims = 3
BinaryData = True
BinaryDataByteOrderMSB = False
CompressedData = False
TransformMatrix = 0 1 0 -1 0 0 0 0 1
Offset = 1 -2 3
ElementSpacing = 0.5 2 3
DimSize = 7 6 5
ElementType = MET_SHORT
ElementDataFile = samples.raw
"""

NRRD = """\
NRRD0005
# A comment
type: short
dimension: 3
space: left-posterior-superior
sizes: 7 6 5
space directions: (0.5,0,0) (0,2,0) (0,0,3)
space origin: (1,-2,3)
endian: little
encoding: raw
"""


def make_image(scalar_type=VTK_SHORT, components=1, extent=(0, 6, 0, 5, 0, 4)):
    image = vtkImageData()
    image.SetExtent(*extent)
    image.SetSpacing(0.5, 2.0, 3.0)
    image.SetOrigin(1.0, -2.0, 3.0)
    image.AllocateScalars(scalar_type, components)
    scalars = image.GetPointData().GetScalars()
    for i in range(scalars.GetNumberOfValues()):
        scalars.SetValue(i, i % 251)
    return image


def get_bytes(array):
    return memoryview(array).tobytes()


def get_samples():
    return get_bytes(make_image().GetPointData().GetScalars())


def write(writer, image, path):
    writer.SetInputData(image)
    writer.SetFileName(str(path))
    writer.Write()


def nifti_header(order="<", dimensions=(3, 7, 6, 5, 1, 1, 1, 1), code=4, qfac=1.0, offset=352.0):
    header = bytearray(352)
    struct.pack_into(order + "i", header, 0, 348)
    struct.pack_into(order + "8h", header, 40, *dimensions)
    struct.pack_into(order + "2h", header, 70, code, 16)
    struct.pack_into(order + "9f", header, 76, qfac, 0.5, 2.0, 3.0, 1.0, 1.0, 1.0, 1.0, offset)
    struct.pack_into(order + "2h", header, 252, 1, 0)  # qform_code, sform_code
    struct.pack_into(order + "6f", header, 256, 0.5, 0.5, 0.5, 10.0, 20.0, 30.0)
    struct.pack_into("4s", header, 344, b"n+1")
    return bytes(header)


class ErrorTexts:
    """Of an object and its executive."""

    def __init__(self, reader):
        self.texts = []
        reader.AddObserver("ErrorEvent", self.add)

    def add(self, caller, event, text=None):
        self.texts.append(text)

    add.CallDataType = "string0"


def read_otherwise(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def pad(header):
    """Samples after it begin at a multiple of 8."""
    for name in ("Comment = Spaces", "# A comment"):
        header = header.replace(name, name + -len(header) % 8 * "s")
    return header


def read_memory(column):
    """The bytes of address space (column 0), or of those the ones in memory (1)."""
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[column]) * resource.getpagesize()


def render(image):
    mapper, volume, camera, picture = vtkIsosurfaceRayTraceMapper(), vtkVolume(), vtkCamera(), vtkImageData()
    mapper.SetInputData(image)
    volume.SetMapper(mapper)
    volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 157.0)
    volume.GetProperty().GetScalarOpacity().AddPoint(157.0, 1.0)
    camera.SetPosition(20.0, 30.0, 60.0)
    camera.SetClippingRange(1.0, 200.0)
    assert mapper.RenderToImage(volume, camera, None, 80, 60, picture)
    return get_bytes(picture.GetPointData().GetArray("Colors"))


class TestMappedImageReader(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, *parts):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(b"".join(part.encode() if isinstance(part, str) else part for part in parts))
        return path

    def map(self, path):
        reader = vtkMappedImageReader()
        self.assertEqual(reader.CanReadFile(str(path)), 3)
        return read_otherwise(reader, path)

    def assert_same(self, mapped, expected):
        for get in (vtkImageData.GetExtent, vtkImageData.GetSpacing, vtkImageData.GetOrigin):
            self.assertEqual(get(mapped), get(expected))
        self.assert_same_directions(mapped, expected)
        self.assert_same_scalars(mapped, expected)
        self.assertEqual(get_bytes(mapped.GetPointData().GetScalars()), get_bytes(expected.GetPointData().GetScalars()))

    def assert_same_directions(self, mapped, expected):
        for row in range(3):
            for column in range(3):
                self.assertEqual(mapped.GetDirectionMatrix().GetElement(row, column),
                                 expected.GetDirectionMatrix().GetElement(row, column))

    def assert_same_scalars(self, mapped, expected):
        own, other = (image.GetPointData().GetScalars() for image in (mapped, expected))
        self.assertEqual(own.GetName(), other.GetName())
        self.assertEqual(own.GetDataType(), other.GetDataType())
        self.assertEqual(own.GetNumberOfComponents(), other.GetNumberOfComponents())
        self.assertEqual(own.GetNumberOfTuples(), other.GetNumberOfTuples())

    def assert_same_places(self, mapped, expected):
        """The same samples at the same points in space, in another order."""
        self.assert_same_scalars(mapped, expected)
        self.assertLess(mapped.GetDirectionMatrix().Determinant(), 0.0)
        self.assertEqual(mapped.GetExtent(), expected.GetExtent())
        scalars = mapped.GetPointData().GetScalars()
        for i in range(mapped.GetNumberOfPoints()):
            point = expected.FindPoint(mapped.GetPoint(i))
            for own, other in zip(mapped.GetPoint(i), expected.GetPoint(point)):
                self.assertAlmostEqual(own, other, places=12)
            self.assertEqual(scalars.GetTuple(i), expected.GetPointData().GetScalars().GetTuple(point))

    def test_metaimage(self):
        for scalar_type in TYPES:
            for components in (1, 3):
                with self.subTest(scalar_type=scalar_type, components=components):
                    path = self.folder / "image.mhd"
                    writer = vtkMetaImageWriter()
                    writer.SetCompression(False)
                    writer.SetRAWFileName(str(path.with_suffix(".raw")))
                    write(writer, make_image(scalar_type, components), path)
                    self.assert_same(self.map(path), read_otherwise(vtkMetaImageReader(), path))

    def test_headers_of_metaimage(self):
        samples = get_samples()
        self.write("samples.raw", samples)
        self.write("sub/samples.raw", samples[::-1])
        self.write("late.raw", bytes(10), samples)
        local = METAIMAGE.replace("samples.raw", "LOCAL")
        late = METAIMAGE.replace("samples", "late").replace("ElementData", "HeaderSize = 10\nElementData")
        flat = METAIMAGE.replace("NDims = 3", "NDims = 2").replace("7 6 5", "7 30").replace("1 -2 3", "1 -2")
        flat = flat.replace("0 1 0 -1 0 0 0 0 1", "1 0 0 1").replace("0.5 2 3", "0.5 2")
        for name, text, tail in (
            ("plain.mhd", METAIMAGE, b""),
            ("sub.mhd", METAIMAGE.replace("samples.raw", "sub/samples.raw"), b""),
            ("absolute.mhd", METAIMAGE.replace("samples.raw", str(self.folder / "sub/samples.raw")), b""),
            ("skip.mhd", late, b""),
            ("end.mhd", late.replace("HeaderSize = 10", "HeaderSize = -1"), b""),
            ("zero.mhd", late.replace("HeaderSize = 10", "HeaderSize = 0"), b""),
            ("silent.mhd", METAIMAGE.replace("BinaryData = True\n", ""), b""),
            ("flat.mhd", flat, b""),
            ("local.mha", pad(local), samples),
            ("zero.mha", pad(local.replace("ElementData", "HeaderSize = 0\nElementData")), samples),
        ):
            with self.subTest(name):
                path = self.write(name, text, tail)
                self.assert_same(self.map(path), read_otherwise(vtkMetaImageReader(), path))

    def test_nrrd(self):
        samples = get_samples()
        self.write("samples.raw", samples)
        self.write("late.raw", bytes(10), samples)
        detached = NRRD + "data file: samples.raw\n"
        # After the dimension of the space: VTK takes the last for that of the sizes.
        vectors = NRRD.replace("dimension: 3\nspace: left-posterior-superior", "space dimension: 3\ndimension: 4")
        vectors = vectors.replace("7 6 5", "3 7 2 5").replace("directions:", "directions: none")
        for name, text, tail in (
            ("detached.nhdr", detached, b""),
            ("alone.nhdr", detached.replace("data file: ", "datafile: "), b""),
            ("late.nhdr", detached.replace("samples", "late"), b""),
            ("attached.nrrd", pad(NRRD + "\n"), samples),
            ("named.nrrd", pad(NRRD + 'labels: "CT"\n\n'), samples),
            ("vectors.nrrd", pad(vectors + "\n"), samples),
            ("unsigned.nrrd", pad(NRRD.replace("short", "uint16") + "\n"), samples),
        ):
            with self.subTest(name):
                path = self.write(name, text, tail)
                self.assert_same(self.map(path), read_otherwise(vtkNrrdReader(), path))
        left = self.write("left.nrrd", pad(NRRD.replace("left-posterior", "left-anterior") + "\n"), samples)
        self.assert_same_places(self.map(left), read_otherwise(vtkNrrdReader(), left))

    def test_nifti(self):
        for scalar_type in TYPES:
            with self.subTest(scalar_type=scalar_type):
                path = self.folder / "image.nii"
                write(vtkNIFTIImageWriter(), make_image(scalar_type), path)
                self.assert_same(self.map(path), read_otherwise(vtkNIFTIImageReader(), path))

    def test_headers_of_nifti(self):
        samples = get_samples()
        for name, header, tail in (
            ("turned.nii", nifti_header(), samples),
            ("extended.nii", nifti_header(offset=368.0), bytes(16) + samples),
            ("times.nii", nifti_header(dimensions=(4, 7, 6, 1, 5, 1, 1, 1)), samples),
            ("colors.nii", nifti_header(code=128, dimensions=(3, 7, 2, 10, 1, 1, 1, 1)), samples),
        ):
            with self.subTest(name):
                path = self.write(name, header, tail)
                self.assert_same(self.map(path), read_otherwise(vtkNIFTIImageReader(), path))
        path = self.write("reversed.nii", nifti_header(qfac=-1.0), samples)
        self.assert_same_places(self.map(path), read_otherwise(vtkNIFTIImageReader(), path))

    def test_vti(self):
        for scalar_type in TYPES:
            for components, has_long_sizes in ((1, False), (3, True)):
                with self.subTest(scalar_type=scalar_type, components=components):
                    image = make_image(scalar_type, components, (-3, 3, 2, 7, 0, 4))
                    image.GetPointData().GetScalars().SetName("density")
                    image.SetDirectionMatrix(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
                    other = vtkFloatArray()
                    other.SetName("other")
                    other.SetNumberOfValues(2 * COUNT)
                    other.SetNumberOfComponents(2)
                    image.GetPointData().AddArray(other)
                    path = self.folder / "image.vti"
                    write_vti(path, image, has_long_sizes)
                    self.assert_same(self.map(path), read_otherwise(vtkXMLImageDataReader(), path))

    def test_raw(self):
        path = self.write("volume.raw", bytes(10), get_samples())
        for has_header_size in (False, True):
            images = []
            for reader in (vtkMappedImageReader(), vtkImageReader2()):
                self.set_raw(reader)
                if has_header_size:
                    reader.SetHeaderSize(6)
                images.append(read_otherwise(reader, path))
            self.assert_same(*images)

    def test_raw_from_the_top(self):
        """vtkImageReader2 reverses the rows by default."""
        path = self.write("volume.raw", get_samples())
        images = []
        for reader in (vtkMappedImageReader(), vtkImageReader2()):
            self.set_raw(reader)
            reader.SetDataExtent(2, 8, 0, 5, -1, 3)  # VTK 9.1 reverses rows that do not begin with 0 to others.
            reader.FileLowerLeftOff()
            images.append(read_otherwise(reader, path))
        self.assert_same_places(*images)

    @staticmethod
    def set_raw(reader):
        reader.SetDataExtent(2, 8, -1, 4, 0, 4)
        reader.SetFileDimensionality(3)
        reader.FileLowerLeftOn()
        reader.SetDataScalarTypeToShort()
        reader.SetDataByteOrderToLittleEndian() if IS_LITTLE else reader.SetDataByteOrderToBigEndian()
        reader.SetDataSpacing(0.5, 2.0, 3.0)
        reader.SetDataOrigin(1.0, -2.0, 3.0)

    def write_volume(self):
        self.write("samples.raw", get_samples())
        return self.write("volume.mhd", METAIMAGE)

    def test_slices(self):
        """Of an update extent, whole slices are mapped."""
        path = self.write_volume()
        reader = vtkMappedImageReader()
        reader.SetFileName(str(path))
        reader.UpdateExtent((2, 3, 1, 1, 2, 3))
        self.assertEqual(reader.GetOutput().GetExtent(), (0, 6, 0, 5, 2, 3))
        whole = self.map(path)
        whole.Crop((0, 6, 0, 5, 2, 3))
        self.assert_same(reader.GetOutput(), whole)

    def test_arrays_outlive_the_reader(self):
        """Also copies that share the samples, which the system unmaps with the last."""
        path = self.write_volume()
        scalars = self.map(path).GetPointData().GetScalars()
        copy = scalars.NewInstance()
        copy.ShallowCopy(scalars)
        self.assertEqual(copy.GetVoidPointer(0), scalars.GetVoidPointer(0))
        del scalars
        self.assertEqual(get_bytes(copy), get_samples())
        self.assertEqual(self.count_mappings(), 1)
        del copy
        self.assertEqual(self.count_mappings(), 0)

    def count_mappings(self):
        with open("/proc/self/maps", encoding="utf-8") as maps:
            return sum(str(self.folder) in line for line in maps)

    def test_file_stays_as_it_is(self):
        path = self.write_volume()
        image = self.map(path)
        image.GetPointData().GetScalars().Fill(7)
        self.assertEqual(image.GetPointData().GetScalars().GetValue(COUNT - 1), 7)
        self.assertEqual((self.folder / "samples.raw").read_bytes(), get_samples())
        self.assertEqual(get_bytes(self.map(path).GetPointData().GetScalars()), get_samples())

    def test_new_file(self):
        """One that replaces the file, by its name, does not change an image that is in use."""
        path = self.write_volume()
        image = self.map(path)
        self.write("new.raw", get_samples()[::-1])
        os.replace(self.folder / "new.raw", self.folder / "samples.raw")
        self.assertEqual(get_bytes(image.GetPointData().GetScalars()), get_samples())
        self.assertEqual(get_bytes(self.map(path).GetPointData().GetScalars()), get_samples()[::-1])

    def test_nothing_is_read(self):
        """Of a file of 1 TB with a hole for samples."""
        os.truncate(self.write("samples.raw"), 1 << 40)
        path = self.write("huge.mhd", METAIMAGE.replace("7 6 5", "8192 8192 8192"))
        before = read_memory(1)
        image = self.map(path)
        scalars = image.GetPointData().GetScalars()
        self.assertEqual(scalars.GetNumberOfTuples(), 1 << 39)
        self.assertEqual(scalars.GetTuple1((1 << 39) - 1), 0.0)
        self.assertLess(read_memory(1) - before, 1 << 22)

    def test_address_space(self):
        """Less than the file would take."""
        os.truncate(self.write("samples.raw"), 1 << 40)
        path = self.write("huge.mhd", METAIMAGE.replace("7 6 5", "8192 8192 8192"))
        limits = resource.getrlimit(resource.RLIMIT_AS)
        reader = vtkMappedImageReader()
        errors, _ = ErrorTexts(reader), ErrorTexts(reader.GetExecutive())
        resource.setrlimit(resource.RLIMIT_AS, (read_memory(0) + (1 << 30), limits[1]))
        read_otherwise(reader, path)
        resource.setrlimit(resource.RLIMIT_AS, limits)
        self.assertEqual(len(errors.texts), 1)
        self.assertIn("ulimit -v", errors.texts[0])

    def test_picture(self):
        """That of the same samples in memory."""
        cast = vtkImageCast()
        cast.SetInputData(make_waves(10))
        cast.SetOutputScalarTypeToShort()
        cast.Update()
        path = self.folder / "waves.mhd"
        writer = vtkMetaImageWriter()
        writer.SetCompression(False)
        writer.SetRAWFileName(str(path.with_suffix(".raw")))
        write(writer, cast.GetOutput(), path)
        pictures = [render(image) for image in (self.map(path), read_otherwise(vtkMetaImageReader(), path))]
        self.assertGreater(max(pictures[0]), 0)
        self.assertEqual(*pictures)

    def test_pages_that_are_read(self):
        """Those next to the surface, and not what is around them: the system is told when macrocells are there."""
        image = self.map(self.write_volume())
        self.assertTrue(vtkMappedImageReader.IsMapped(image.GetPointData().GetScalars()))
        self.assertNotIn("rr", self.read_flags())
        render(image)
        self.assertIn("rr", self.read_flags())

    def read_flags(self):
        """Those of the mapping, as Linux has them."""
        with open("/proc/self/smaps", encoding="utf-8") as maps:
            lines = iter(maps)
            for line in lines:
                if str(self.folder) in line:
                    return next(line for line in lines if line.startswith("VmFlags:")).split()[1:]
        return []

    def test_arrays_in_memory(self):
        scalars = make_image().GetPointData().GetScalars()
        self.assertFalse(vtkMappedImageReader.IsMapped(scalars))
        self.assertFalse(vtkMappedImageReader.IsMapped(None))
        copy = scalars.NewInstance()
        copy.DeepCopy(self.map(self.write_volume()).GetPointData().GetScalars())
        self.assertFalse(vtkMappedImageReader.IsMapped(copy))

    def refuse(self, path, *words, reader=None):
        """One error, with all words; and the file is left to others."""
        reader = reader or vtkMappedImageReader()
        self.assertEqual(reader.CanReadFile(str(path)), 0)
        errors = ErrorTexts(reader)
        silence = ErrorTexts(reader.GetExecutive())
        image = read_otherwise(reader, path)
        self.assertEqual(len(errors.texts), 1, errors.texts)
        self.assertLessEqual(len(silence.texts), 1)
        self.assertNotEqual(reader.GetErrorCode(), 0)
        self.assertEqual(image.GetNumberOfPoints(), 0)
        for word in words:
            self.assertIn(word, errors.texts[0])

    def test_files_of_another_form(self):
        samples = get_samples()
        self.write("samples.raw", samples)
        memory = "or read it into the memory with"
        of_metaimage = (f"{memory} vtkMetaImageReader",)
        of_nrrd = (f"{memory} vtkNrrdReader",)
        big, odd = "big-endian" if IS_LITTLE else "little-endian", "begin at byte"
        compressed = self.folder / "compressed.vti"
        write(vtkXMLImageDataWriter(), make_image(), compressed)
        self.refuse(compressed, "compressed", "vtkXMLImageDataReader")
        text = self.folder / "text.vti"
        writer = vtkXMLImageDataWriter()
        writer.SetDataModeToAscii()
        write(writer, make_image(), text)
        self.refuse(text, "text", "vtkXMLImageDataReader")
        for of_cells in (False, True):
            image = make_image()
            image.AllocateCellGhostArray() if of_cells else image.AllocatePointGhostArray()
            hidden = self.folder / "hidden.vti"
            write_vti(hidden, image)
            self.refuse(hidden, "hidden in part", "vtkXMLImageDataReader")
        for name, text, tail, words in (
            ("packed.mhd", METAIMAGE.replace("CompressedData = False", "CompressedData = True"), b"", ("compressed",)),
            ("text.mhd", METAIMAGE.replace("BinaryData = True", "BinaryData = False"), b"", ("text",)),
            ("list.mhd", METAIMAGE.replace("samples.raw", "LIST\nsamples.raw"), b"", ("several files",)),
            ("big.mhd", METAIMAGE.replace("MSB = False", f"MSB = {IS_LITTLE}"), b"", (big, *of_metaimage)),
            ("odd.mha", "\n" + pad(METAIMAGE.replace("samples.raw", "LOCAL")), samples, (odd, ".mhd", *of_metaimage)),
            ("packed.nrrd", NRRD.replace("raw", "gzip") + "\n", gzip.compress(samples), ("compressed", "NrrdReader")),
            ("big.nrrd", pad(NRRD.replace("little", "big") + "\n"), samples, (big, *of_nrrd)),
            ("odd.nrrd", pad(NRRD + "\n").replace("# A", "# An"), samples, (odd, ".nhdr", *of_nrrd)),
            ("list.nhdr", NRRD + "data file: LIST\nsamples.raw\n", b"", ("several files",)),
            ("packed.nii.gz", b"", gzip.compress(nifti_header() + samples), ("compressed",)),
            ("packed.nii", b"", gzip.compress(nifti_header() + samples), ("compressed",)),
            ("big.nii", nifti_header(">"), samples, (big, f"{memory} vtkNIFTIImageReader")),
            ("vectors.nii", nifti_header(dimensions=(5, 7, 6, 1, 1, 5, 1, 1)), samples, ("components",)),
        ):
            with self.subTest(name):
                self.refuse(self.write(name, text, tail), *words)

    def test_bytes_have_no_order(self):
        self.write("samples.raw", get_samples())
        text = METAIMAGE.replace("MSB = False", "MSB = True").replace("MET_SHORT", "MET_UCHAR")
        self.assertEqual(self.map(self.write("bytes.mhd", text)).GetScalarType(), VTK_UNSIGNED_CHAR)

    def test_files_that_are_too_short(self):
        samples = get_samples()
        self.write("samples.raw", samples)
        self.write("cut.raw", samples[:-1])
        vti = self.folder / "volume.vti"
        write_vti(vti, make_image())
        many = "2147483647 2147483647 2147483647"
        short = ("but", "bytes. Complete the file, or correct the header.")
        cut = METAIMAGE.replace("samples", "cut")
        for name, text, tail in (
            ("cut.mhd", cut, b""),
            ("skip.mhd", METAIMAGE.replace("ElementData", "HeaderSize = 1\nElementData"), b""),
            ("end.mhd", cut.replace("ElementData", "HeaderSize = -1\nElementData"), b""),
            ("many.mhd", METAIMAGE.replace("7 6 5", many), b""),
            ("channels.mhd", METAIMAGE.replace("ElementType", "ElementNumberOfChannels = 1000000\nElementType"), b""),
            ("cut.nrrd", pad(NRRD + "\n"), samples[:-1]),
            ("cut.nhdr", NRRD + "data file: cut.raw\n", b""),
            ("cut.nii", nifti_header(), samples[:-1]),
            ("cut.vti", b"", vti.read_bytes()[:-200]),
            ("many.nii", nifti_header(dimensions=(3, 32767, 32767, 32767, 1, 1, 1, 1)), samples),
        ):
            with self.subTest(name):
                self.refuse(self.write(name, text, tail), *short)

    def test_damaged_headers(self):
        self.write("samples.raw", get_samples())
        vti = self.folder / "volume.vti"
        write_vti(vti, make_image())
        vti = vti.read_bytes()
        for name, data, words in (
            ("absent.mhd", METAIMAGE.replace("samples", "absent"), "absent.raw"),
            ("folder.mhd", METAIMAGE.replace("samples.raw", "."), "not a file"),
            ("empty.mhd", "", "no ElementDataFile"),
            ("negative.mhd", METAIMAGE.replace("7 6 5", "7 -6 5"), "DimSize = 7 -6 5"),
            ("empty.nrrd", "", "does not begin with NRRD"),
            ("cut.nrrd", NRRD[:NRRD.index("7 6 5")], "has no end"),
            ("nul.nrrd", NRRD.replace("7 6 5", "7 \0 5"), "has no end"),
            ("without.nrrd", re.sub("sizes:.*\n", "", NRRD), "sizes: "),
            ("sizes.nrrd", NRRD.replace("7 6 5", "7 6"), "sizes: 7 6"),
            ("none.nrrd", NRRD.replace("7 6 5", "7 0 5"), "sizes: 7 0 5"),
            ("words.nrrd", NRRD.replace("7 6 5", "7 x 5"), "sizes: 7 x 5"),
            ("large.nrrd", NRRD.replace("7 6 5", "7 6 1e300"), "sizes: 7 6 1e300"),
            ("five.nrrd", NRRD.replace("7 6 5", "7 6 5 1 2").replace("dimension: 3", "dimension: 5"), "volume"),
            ("type.nii", nifti_header(code=999), "999"),
            ("before.nii", nifti_header(offset=-8.0), "before the file"),
            ("none.nii", nifti_header(dimensions=(3, 7, 0, 5, 1, 1, 1, 1)), "no samples"),
            ("empty.nii", b"", "0"),
            ("empty.vti", b"", "its header is damaged; vtkXMLImageDataReader tells how."),
            ("offset.vti", vti.replace(b'offset="0"', b'offset="9223372036854775807"'), "ends before its scalars"),
            ("before.vti", vti.replace(b'offset="0"', b'offset="-99999"'), "ends before its scalars"),
            ("extent.vti", vti.replace(b'Extent="0 6', b'Extent="0 5'), "another size"),
            ("nameless.vti", vti.replace(b'PointData Scalars="ImageScalars"', b"PointData"), "Scalars="),
        ):
            with self.subTest(name):
                self.refuse(self.write(name, data), words)

    def test_settings_of_raw_samples(self):
        path = self.write("volume.raw", get_samples())
        for change, words in (
            (lambda reader: reader.SetFileDimensionality(2), "FileDimensionality to 3"),
            (lambda reader: reader.SetHeaderSize(1), "bytes. Complete"),
            (lambda reader: reader.SetDataExtent(0, -1, 0, 0, 0, 0), "no samples"),
            (lambda reader: reader.SetDataExtent(*3 * (-2147483648, 2147483647)), "bytes. Complete"),
            (lambda reader: reader.SetNumberOfScalarComponents(-1), "no samples"),
            (lambda reader: reader.SetDataScalarType(1), "no samples"),
            (lambda reader: reader.SetDataScalarType(-1), "no samples"),
            (lambda reader: reader.SetSwapBytes(1), "-endian"),
        ):
            reader = vtkMappedImageReader()
            self.set_raw(reader)
            change(reader)
            with self.subTest(words):
                self.refuse(path, words, reader=reader)

    def test_no_file(self):
        self.refuse(self.folder / "absent.raw", "absent.raw", "No such file")
        for name in ("absent.mhd", "absent.nrrd"):
            self.refuse(self.folder / name, f"{name}: there is no such file")
        self.refuse(self.folder, "not a file")
        reader = vtkMappedImageReader()
        errors, silence = ErrorTexts(reader), ErrorTexts(reader.GetExecutive())
        reader.Update()
        self.assertEqual(len(errors.texts), 1)
        self.assertIn("SetFileName", errors.texts[0])

    def test_file_that_becomes_shorter(self):
        """Between the header and the samples."""
        path = self.write_volume()
        reader = vtkMappedImageReader()
        reader.SetFileName(str(path))
        reader.UpdateInformation()
        os.truncate(self.folder / "samples.raw", 10)
        errors, silence = ErrorTexts(reader), ErrorTexts(reader.GetExecutive())
        reader.Update()
        self.assertEqual(len(errors.texts), 1)
        self.assertIn("has become shorter", errors.texts[0])


if __name__ == "__main__":
    unittest.main()
