#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The program vtkIsosurfaceRender, by one process and by many.

Arguments: the program, mpiexec, its option for the number of processes."""

import array
import math
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
from vtkmodules.vtkImagingCore import vtkImageShiftScale, vtkRTAnalyticSource

from DicomSlices import write_dicom_slices
from PictureTesting import add_array_of_cells, count_colored
from VtiFiles import write_vti

PROGRAM, *MPIEXEC = sys.argv[1:4]
SIZE = ("--width", "120", "--height", "90")


def run(*arguments, processes=None):
    command = [*MPIEXEC, str(processes), PROGRAM] if processes else [PROGRAM]
    return subprocess.run([*command, *arguments], capture_output=True, text=True, timeout=120, check=False)


def make_image(last=20):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-20, 20, -20, 20, -20, last)
    source.Update()
    return source.GetOutput()


def make_vectors(image):
    """Their magnitudes are the scalars."""
    vectors = vtkFloatArray()
    vectors.SetName("vectors")
    vectors.SetNumberOfComponents(2)
    vectors.SetNumberOfTuples(image.GetNumberOfPoints())
    vectors.FillComponent(0, 0.0)
    vectors.CopyComponent(1, image.GetPointData().GetScalars(), 0)
    return vectors


def write(image, file_name):
    if file_name.suffix == ".vti":
        write_vti(file_name, image)
        return
    writer = vtkMetaImageWriter()
    if file_name.suffix == ".mhd":
        writer.SetRAWFileName(str(file_name.with_suffix(".raw")))
        writer.SetCompression(False)
    writer.SetInputData(image)
    writer.SetFileName(str(file_name))
    writer.Write()


class TestIsosurfaceRender(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.picture = self.folder / "picture.png"

    def check_failure(self, result, *patterns):
        self.assertNotEqual(result.returncode, 0)
        for pattern in patterns:
            self.assertRegex(result.stderr, pattern)
        self.assertFalse(self.picture.exists())

    def render(self, volume, *arguments, processes=None):
        result = run("--input", str(volume), "--output", str(self.picture), *SIZE, *arguments, processes=processes)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        self.assertRegex(lines[0], "process .*read.*render.*composite.*sent")
        self.assertEqual([line.split()[0] for line in lines[1:]], [str(i) for i in range(processes or 1)])
        self.assertGreater(float(lines[1].split()[2]), 0.0)
        png = self.picture.read_bytes()
        self.picture.unlink()
        return png

    def count_colored(self, png):
        file_name = self.folder / "read.png"
        file_name.write_bytes(png)
        self.assertEqual(struct.unpack(">II", png[16:24]), (120, 90))  # of its header
        return count_colored(str(file_name))

    def test_pictures_are_the_same(self):
        for name in ("volume.vti", "volume.mhd"):
            volume = self.folder / name
            write(make_image(), volume)
            for arguments in (("--isovalue", "157"), ("--isovalue", "120", "200", "--opacity", "0.3", "1")):
                alone = self.render(volume, *arguments)
                self.assertGreater(self.count_colored(alone), 1500)
                for processes in (1, 2, 3):
                    with self.subTest(name=name, arguments=arguments, processes=processes):
                        self.assertEqual(self.render(volume, *arguments, processes=processes), alone)

    def test_arrays(self):
        """Without a name the active scalars; those of cells need more ghosts; vectors are taken by their magnitude."""
        image = make_image()
        plain = self.folder / "plain.vti"
        write(image, plain)
        expected = self.render(plain, "--isovalue", "157")
        vectors = make_vectors(image)
        of_cells = add_array_of_cells(image, "RTData")
        image.GetPointData().AddArray(vectors)
        image.AllocatePointGhostArray()
        volume = self.folder / "arrays.vti"
        write(image, volume)
        for processes in (1, 3):
            self.assertEqual(self.render(volume, "--isovalue", "157", processes=processes), expected)
            of_vectors = self.render(volume, "--array", "vectors", "--isovalue", "157", processes=processes)
            self.assertEqual(of_vectors, expected)
        alone = self.render(volume, "--array", "of cells", "--isovalue", "157")
        self.assertGreater(self.count_colored(alone), 1500)
        self.assertNotEqual(alone, expected)
        self.assertEqual(self.render(volume, "--array", "of cells", "--isovalue", "157", processes=3), alone)
        empty = run("--input", str(volume), "--array", "of cells", "--isovalue", "1e4", "--output", str(self.picture))
        lowest, highest = of_cells.GetRange()
        self.assertIn(f"are from {lowest:.6g} to {highest:.6g}:", empty.stderr)
        self.picture.unlink()
        image.GetPointData().SetActiveScalars(None)
        image.GetPointData().RemoveArray("vectors")
        write(image, volume)
        self.assertEqual(self.render(volume, "--isovalue", "157"), expected)
        result = run("--input", str(volume), "--array", "x", "--isovalue", "1", "--output", str(self.picture))
        self.check_failure(result, r'arrays.vti: there is no array "x" .*\(for --array\): RTData of cells$')

    def test_scaled_nifti(self):
        """Isovalues are those that the file means: of the values that are stored times scl_slope, plus scl_inter."""
        stored = vtkImageShiftScale()
        stored.SetInputData(make_image())
        stored.SetOutputScalarTypeToShort()
        meant = vtkImageShiftScale()
        meant.SetInputConnection(stored.GetOutputPort())
        meant.SetShift(-100.0)
        meant.SetScale(0.5)
        meant.SetOutputScalarTypeToFloat()
        meant.Update()
        write(meant.GetOutput(), self.folder / "meant.mhd")
        expected = self.render(self.folder / "meant.mhd", "--isovalue", "28.5")
        self.assertGreater(self.count_colored(expected), 1500)
        writer = vtkNIFTIImageWriter()
        writer.SetInputConnection(stored.GetOutputPort())
        writer.SetRescaleSlope(0.5)
        writer.SetRescaleIntercept(-50.0)
        for name in ("scaled.nii", "scaled.nii.gz"):
            writer.SetFileName(str(self.folder / name))
            writer.Write()
            self.assertEqual(self.render(self.folder / name, "--isovalue", "28.5", processes=2), expected, name)

    def test_slices(self):
        """A folder of DICOM slices, of which each process reads all."""
        folder = self.folder / "ct"
        folder.mkdir()
        write_dicom_slices(make_image(), folder)
        alone = self.render(folder, "--isovalue", "157")
        self.assertGreater(self.count_colored(alone), 1500)
        self.assertEqual(self.render(folder, "--isovalue", "157", processes=3), alone)
        write_dicom_slices(make_image(), folder, slope=300)
        result = run("--input", str(folder), "--output", str(self.picture), "--isovalue", "157")
        self.check_failure(result, "dcm may have values that do not fit the 16 bits")
        write_dicom_slices(make_image(), folder, slope=0.5, intercept=-200)
        negative = self.render(folder, "--isovalue", "-121.5")
        self.assertEqual(negative, alone)

    def test_other_formats(self):
        """Big-endian samples after a header that has a HeaderSize of 0; compressed ones, of which each process reads
        all."""
        raw = self.folder / "volume.mhd"
        write(make_image(), raw)
        alone = self.render(raw, "--isovalue", "157")
        header = raw.read_text().replace("volume.raw", "LOCAL").replace("MSB = False", "MSB = True")
        header = header.replace("ElementDataFile", "HeaderSize = 0\nElementDataFile")
        samples = array.array("f", raw.with_suffix(".raw").read_bytes())
        samples.byteswap()
        local = self.folder / "local.mha"
        local.write_bytes(header.encode() + samples.tobytes())
        compressed = self.folder / "compressed.mha"
        write(make_image(), compressed)
        for volume in (local, compressed):
            for processes in (1, 3):
                with self.subTest(volume=volume.name, processes=processes):
                    self.assertEqual(self.render(volume, "--isovalue", "157", processes=processes), alone)

    def test_memory(self):
        """A volume that may take none, because it stays in its file; one that is compressed may not be read."""
        memory = ("--isovalue", "157", "--max-memory", "0.001")
        volume = self.folder / "volume.mhd"
        write(make_image(), volume)
        alone = self.render(volume, *memory)
        self.assertEqual(self.render(volume, "--isovalue", "157"), alone)
        self.assertEqual(self.render(volume, *memory, processes=2), alone)
        compressed = self.folder / "compressed.mha"
        write(make_image(), compressed)
        result = run("--input", str(compressed), "--output", str(self.picture), *memory)
        self.check_failure(result, "compressed.mha.*--max-memory sets this limit")

    def test_cache(self):
        """Of macrocells: one file of each process."""
        volume, cache = self.folder / "volume.mhd", self.folder / "cache"
        write(make_image(last=400), volume)
        alone = self.render(volume, "--isovalue", "157")
        time.sleep(2.2)  # Files that have just been written are not kept.
        for processes, files in ((None, 1), (1, 1), (2, 3), (2, 3)):
            self.assertEqual(self.render(volume, "--isovalue", "157", "--cache", str(cache), processes=processes), alone)
            self.assertEqual(len(list(cache.iterdir())), files)
        result = run("--input", str(volume), "--output", str(self.picture), "--isovalue", "157", "--cache", str(volume))
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr.count("cannot be kept"), 1)

    def test_more_processes_than_layers(self):
        volume = self.folder / "thin.vti"
        image = make_image(last=-18)
        vectors = make_vectors(image)
        image.GetPointData().AddArray(vectors)
        write(image, volume)
        for options in (("--isovalue", "0", "10"), ("--isovalue", "10", "--array", "vectors")):
            alone = self.render(volume, *options)
            self.assertGreater(self.count_colored(alone), 20)
            self.assertEqual(self.render(volume, *options, processes=3), alone)

    def test_isovalue_outside_the_scalars(self):
        volume = self.folder / "volume.vti"
        write(make_image(), volume)
        for processes in (None, 3):
            for isovalue, is_empty in (("1e4", True), ("157", False)):
                result = run("--input", str(volume), "--isovalue", isovalue, "--output", str(self.picture), *SIZE,
                             processes=processes)  # fmt: skip
                self.assertEqual(result.returncode, 0)
                self.assertEqual(result.stderr.count("warning: the picture is empty. The scalars of the volume are "
                                                     "from "), int(is_empty))  # fmt: skip

    def test_why_nothing_is_seen(self):
        volume, nothing, small = (self.folder / f"{name}.vti" for name in ("volume", "nothing", "small"))
        write(make_image(), volume)
        image = make_image()
        image.GetPointData().GetScalars().Fill(math.nan)
        write(image, nothing)
        image.GetPointData().GetScalars().Fill(0.0)
        image.GetPointData().GetScalars().SetTuple1(image.GetNumberOfPoints() // 2, 1.0)
        write(image, small)
        for arguments, reason in (
            ((volume, "--isovalue", "157", "--opacity", "0"), "whose --opacity is 0 cannot be seen"),
            ((nothing, "--isovalue", "157"), r"No sample of the volume is a number \(all are NaN\)"),
            ((volume, "--isovalue", "1e4", "157", "--opacity", "1", "0"), "whose --opacity is 0 cannot be seen"),
            ((small, "--isovalue", "0.99", "7", "--opacity", "1", "0"), "No ray meets a surface"),
        ):
            result = run("--input", *map(str, arguments), "--output", "/dev/null", "--width", "16", "--height", "12")
            self.assertEqual(result.returncode, 0)
            self.assertRegex(result.stderr, "warning: the picture is empty. .*" + reason)

    def test_view(self):
        volume = self.folder / "volume.vti"
        write(make_image(), volume)
        front = self.render(volume, "--isovalue", "157")
        self.assertNotEqual(self.render(volume, "--isovalue", "157", "--azimuth", "80"), front)
        self.assertNotEqual(self.render(volume, "--isovalue", "157", "--elevation", "-50"), front)

    def test_process_that_cannot_read(self):
        """The last slab is damaged: its process says so, and all stop."""
        volume = self.folder / "volume.vti"
        writer = vtkXMLImageDataWriter()
        writer.EncodeAppendedDataOff()
        writer.SetInputData(make_image())
        writer.SetFileName(str(volume))
        writer.Write()
        content = volume.read_bytes()
        end = content.rindex(b"\n  </AppendedData>")
        begin = end * 3 // 4
        volume.write_bytes(content[:begin] + bytes(end - begin) + content[end:])
        result = run("--input", str(volume), "--isovalue", "157", "--output", str(self.picture), *SIZE, processes=3)
        self.check_failure(result, "error: process 2: .*volume.vti cannot be read")
        self.assertNotIn("error: process 0", result.stderr)

    def test_errors(self):
        volume = self.folder / "volume.vti"
        write(make_image(), volume)
        arguments = ["--input", str(volume), "--isovalue", "157", "--output", str(self.picture)]
        nowhere = ["--input", "nowhere.vti", *arguments[2:]]
        self.check_failure(run(*nowhere, processes=2), "process 1: there is no file nowhere.vti")
        unwritable = [*arguments[:-1], str(self.folder / "no" / "picture.png")]
        self.check_failure(run(*unwritable, processes=2), "error: process 0: .*picture.png cannot be written")
        self.check_failure(run(*arguments[:4]), "--output are needed")
        self.check_failure(run(*arguments[:-1], "a.jpg"), "--output a.jpg: the name must end in .png")
        image = self.folder / "image.png"
        image.write_text("not looked at")
        self.check_failure(run("--input", str(image), *arguments[2:-1], str(image)), "image.png is the input")
        self.assertEqual(image.read_text(), "not looked at")
        flat = self.folder / "flat.vti"
        write(make_image(last=-20), flat)
        self.check_failure(run("--input", str(flat), *arguments[2:]), "a single layer of samples")
        self.check_failure(run(*arguments, "--frame"), "unknown option --frame")
        self.check_failure(run(*arguments, "--width", "0"), "--width and --height take numbers")
        self.check_failure(run(*arguments, "--elevation", "90"), "--elevation takes")
        self.check_failure(run(*arguments, "--opacity", "1.5"), "--opacity takes")
        self.check_failure(run(*arguments, "--opacity", "0.5", "0.5"), "--opacity takes")
        self.check_failure(run(*arguments, "--isovalue", "160", "--opacity", "0.5"), "--opacity takes")
        self.check_failure(run(*arguments, "--azimuth", "front"), "front is not a number")
        self.check_failure(run(*arguments, "--azimuth", "nan"), "nan is not a number")
        self.check_failure(run(*arguments, "--azimuth", "inf"), "--azimuth takes")
        self.check_failure(run("--isovalue", "157", "--frame", *arguments), "unknown option --frame")
        self.check_failure(run(*arguments, "--width", "99.5"), "99.5 is not an integer")
        compressed = self.folder / "compressed.vti"
        writer = vtkXMLImageDataWriter()
        writer.SetInputData(make_image())
        writer.SetFileName(str(compressed))
        writer.Write()
        arguments[1] = str(compressed)
        self.check_failure(run(*arguments, "--max-memory", "0.001"), "--max-memory sets this limit")

    def test_help(self):
        for processes in (None, 2):
            result = run("--help", processes=processes)
            self.assertEqual(result.returncode, 0)
            self.assertEqual(result.stdout.count("--isovalue VALUE...  One or more"), 1)
            self.assertIn("mpirun -n 4 vtkIsosurfaceRender", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
