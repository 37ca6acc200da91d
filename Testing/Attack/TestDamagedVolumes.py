#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Programs read damaged files: TestDamagedVolumes.py VTKISOSURFACECOMPARE VTKISOSURFACEBENCHMARKVOLUME

Each run ends soon, in little memory, well or with an error. ATTACK_FILES says how many files there are
(300), ATTACK_SEED with which they begin (0); a failure names its seed."""

import gzip
import os
import re
import resource
import struct
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

from DamagedVolumes import METAIMAGE, EDGE, damage, make_whole_files, new_ball, write

BENCHMARK_VOLUME = sys.argv.pop()
COMPARE = sys.argv.pop()
FILES = int(os.environ.get("ATTACK_FILES", "300"))
SEED = int(os.environ.get("ATTACK_SEED", "0"))
SECONDS = 20  # on a machine that does much else
ADDRESS_SPACE = 2 << 30
MEBIBYTES = 64

ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "DISPLAY"}


def new_nifti(order, code):
    """A file of version 1 of the format, with the byte order and the type of data."""
    header = bytearray(352)
    struct.pack_into(order + "i", header, 0, 348)
    struct.pack_into(order + "8h", header, 40, 3, EDGE, EDGE, EDGE, 1, 1, 1, 1)
    struct.pack_into(order + "2h", header, 70, code, 16)
    struct.pack_into(order + "9f", header, 76, *8 * (1.0,), len(header))
    struct.pack_into("4s", header, 344, b"n+1")
    return header + bytes(2 * EDGE**3)


def new_nifti_2(order, code):
    header = bytearray(544)
    struct.pack_into(order + "i8s2h", header, 0, 540, b"n+2\0\r\n\032\n", code, 16)
    struct.pack_into(order + "8q", header, 16, 3, EDGE, EDGE, EDGE, 1, 1, 1, 1)
    struct.pack_into(order + "8dq", header, 104, *8 * (1.0,), len(header))
    return header + bytes(2 * EDGE**3)


NEW_NIFTI = {
    "old.nii": new_nifti,
    "new.nii": new_nifti_2,
    "packed.nii.gz": lambda order, code: gzip.compress(new_nifti(order, code)),
}


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))


def run(command, limit=limit_memory):
    return subprocess.run(
        command, capture_output=True, env=ENVIRONMENT, timeout=SECONDS, preexec_fn=limit, check=False)


def find_limit():
    """None where the sanitizers need all addresses."""
    return limit_memory if run([BENCHMARK_VOLUME, "--help"]).returncode == 0 else None


class TestDamagedVolumes(unittest.TestCase):
    maxDiff = None  # every seed is named

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.files = make_whole_files(cls.folder)
        cls.limit = staticmethod(find_limit())

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def read(self, path, with_compare=False):
        """Both programs read by the same code; the comparison takes longer."""
        memory = ["--max-memory", str(MEBIBYTES)]
        if with_compare:
            command = [COMPARE, "--input", path, "--isovalue", "40", "--repeats", "1",
                       "--methods", "flying-edges", *memory]  # fmt: skip
        else:
            command = [BENCHMARK_VOLUME, "--input", path, "--dimensions", "4",
                       "--output", f"{path}-output.mhd", *memory]  # fmt: skip
        return run(command, self.limit)

    def find_fault(self, path, with_compare=False):
        """What is wrong with the end of a run; empty if nothing is."""
        try:
            result = self.read(path, with_compare)
        except subprocess.TimeoutExpired:
            return "it does not end"
        if result.returncode == 1 and b"error: " in result.stderr or result.returncode == 0:
            return ""
        return f"it ends with {result.returncode}: {result.stderr[-300:]}"

    def attack(self, seed):
        name, data = damage(self.files, seed)
        path = self.folder / name
        path.write_bytes(data)
        fault = self.find_fault(path, with_compare=seed % 10 == 0)
        path.unlink()
        return f"seed {seed}, {name}: {fault}" if fault else ""

    def check_seeds(self, seeds):
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            faults = [fault for fault in pool.map(self.attack, seeds) if fault]
        self.assertEqual(faults, [])

    def test_whole_files_are_read(self):
        for name, data in self.files.items():
            path = self.folder / name
            path.write_bytes(data)
            result = self.read(path)
            self.assertEqual(result.returncode, 0, f"{name}: {result.stderr}")

    def test_damaged_files(self):
        self.check_seeds(range(SEED, SEED + FILES))

    def assert_refused(self, name, data, words):
        path = self.folder / name
        path.write_bytes(data)
        result = self.read(path)
        self.assertEqual(result.returncode, 1, (name, result.stderr))
        self.assertIn(words, result.stderr.decode("utf-8", "replace"))

    def refuse_header(self, line, words):
        """The line takes the place of the one with its name."""
        name = line.split(" = ")[0]
        header = METAIMAGE.format(compressed=False, edge=EDGE, data_file="ball.raw")
        lines = [line if old.startswith(name + " ") else old for old in header.splitlines()]
        self.assert_refused("refused.mhd", ("\n".join(lines) + "\n").encode("ascii"), words)

    def resample(self, name, data):
        """Where the first sample is, and the samples."""
        path = self.folder / name
        path.write_bytes(data)
        result = self.read(path)
        self.assertEqual(result.returncode, 0, result.stderr)
        header = (self.folder / f"{name}-output.mhd").read_text(encoding="ascii")
        (offset,) = re.findall("Offset = (.*)", header)
        return list(map(float, offset.split())), (self.folder / f"{name}-output.raw").read_bytes()

    def test_extents_that_do_not_begin_with_0(self):
        """Of whole files; for a damaged one vtkIsosurfaceBenchmarkVolume crashed."""
        whole = self.files["text.vti"]
        offset, samples = self.resample("from_0.vti", whole)
        moved = whole.replace(b'Extent="0 11 0 11 0 11"', b'Extent="-1 10 5 16 0 11"')
        self.assertEqual(
            self.resample("moved.vti", moved), ([offset[0] - 1, offset[1] + 5, offset[2]], samples))

    def test_headers_that_vtk_trusts(self):
        """Of these VTK's reader counted for minutes, wrote beyond its memory, or made a volume."""
        for line, words in (
            ("NDims = -2147483648", "NDims"),
            ("NDims = 99", "NDims"),
            ("NDims = 1e9", "NDims"),
            ("DimSize = 12 12", "DimSize"),
            ("DimSize = 12 12 -12", "DimSize"),
            ("DimSize = 12 12 13", "12 x 12 x 13 samples"),
            ("DimSize = 60000 60000 60000", "its file has no more than"),
            ("ElementType = MET_LONG_LONG", "MET_LONG_LONG"),
            ("ElementType = MET_LONG", "MET_LONG"),
            ("ElementType = MET_DOUBLE", "its file has no more than"),
            ("ElementNumberOfChannels = many", "ElementNumberOfChannels"),
            ("ElementNumberOfChannels = -3", "ElementNumberOfChannels"),
            ("ElementSpacing = 1 nan 1", "cannot be read"),
            ("ElementSpacing = 1 0 1", "its spacing is"),
            ("ElementSpacing = 1 1e308 1", "its place in space"),
            ("HeaderSize = 2000", "its file has no more than"),
            ("ElementDataFile = .", "no samples in the file"),
            ("ElementDataFile = /dev/zero", "no samples in the file"),
            ("ElementDataFile = LIST", "no file of samples"),
            ("ElementDataFile = LIST 3D", "which VTK's reader takes for files of slices"),
            ("ElementDataFile = ball%s%n.raw 1 3 1", "ElementDataFile"),
            ("ElementDataFile = ball%d.raw 1 999999999 1", "more than 65536 files"),
        ):
            with self.subTest(line):
                self.refuse_header(line, words)

    def test_compressed_samples_that_are_cut(self):
        """VTK's reader leaves the rest as it was in memory."""
        sized = self.files["packed.mha"]
        self.assert_refused("cut.mha", sized[:-1], "is cut off")
        self.assert_refused("unsized.mha", re.sub(b"CompressedDataSize.*\n", b"", sized), "no CompressedDataSize")

    def test_samples_that_vtk_takes_for_others(self):
        """Compressed ones of NRRD, several components as text of MetaImage, and pieces that leave samples out."""
        nrrd = "NRRD0004\ntype: {}\ndimension: {}\nsizes: {}\nendian: {}\n{}encoding: gzip\n{}\n"
        vector = ("short", 4, "3 12 12 12", "little", "kinds: vector domain domain domain\n", "")
        self.assert_refused("vector.nrrd", nrrd.format(*vector).encode() + gzip.compress(bytes(6 * EDGE**3)), "several components")
        big = ("short", 3, "12 12 12", "big", "", "")
        self.assert_refused("big.nrrd", nrrd.format(*big).encode() + gzip.compress(bytes(2 * EDGE**3)), "does not swap")
        (self.folder / "long.gz").write_bytes(bytes(2 * EDGE**3 + 1))
        detached = ("short", 3, "12 12 12", "little", "", "data file: long.gz\n")
        self.assert_refused("long.nhdr", nrrd.format(*detached).encode(), "longer than they are without compression")
        text = METAIMAGE.format(compressed=False, edge=EDGE, data_file="ball.raw").replace("BinaryData = True", "BinaryData = False")
        text = text.replace("Channels = 1", "Channels = 2")
        self.assert_refused("text.mhd", text.encode(), "several components as text")
        pieces = self.files["text.vti"].replace(b'WholeExtent="0 11 0 11 0 11"', b'WholeExtent="0 11 0 11 0 12"')
        self.assert_refused("pieces.vti", pieces, "its pieces do not fill its WholeExtent")

    def test_samples_that_are_cut(self):
        """VTK's readers report that by no object, and leave the rest as it was in memory."""
        header = "NRRD0004\ntype: short\ndimension: 3\nsizes: 12 12 12\nendian: little\nencoding: raw\n\n"
        self.assert_refused("cut.nrrd", header.encode("ascii") + bytes(2 * EDGE**3 - 1), "vtkNrrdReader was tried")
        legacy = ("# vtk DataFile Version 3.0\nmesh\n{}\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 8 float\n{}")
        for kind, samples in (("BINARY", "0" * 80), ("ASCII", "0 " * 23)):
            path = self.folder / f"{kind}.vtk"
            path.write_text(legacy.format(kind, samples), encoding="ascii")
            result = self.read(path, with_compare=True)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(b"vtkStructuredGridReader was tried", result.stderr)

    def test_raw_appended_data_that_are_cut(self):
        for compressor in ("None", "ZLib"):
            writer = vtkXMLImageDataWriter()
            writer.EncodeAppendedDataOff()
            getattr(writer, f"SetCompressorTypeTo{compressor}")()
            whole = write(writer, new_ball(), self.folder / "raw.vti")
            samples = whole[:whole.rindex(b"\n  </AppendedData>")]
            (self.folder / "raw.vti").write_bytes(samples)
            self.assertEqual(self.read(self.folder / "raw.vti").returncode, 0)
            for length in (len(samples) - 1, samples.index(b"<AppendedData") + 50):
                self.assert_refused("cut.vti", samples[:length], "cut.vti cannot be read: it ends before its last samples")

    def test_dimensions_of_nifti(self):
        """VTK's reader wrote beyond its memory."""
        header = bytearray(self.files["raw.nii"])
        header[44:48] = bytes((0, 0, 128, 0))  # 12 x 0 x 128
        self.assert_refused("flat.nii", header, "its header has a dimension of 0")

    def test_types_of_nifti(self):
        """VTK 9.1's reader crashed for one that it does not know."""
        for order in ("<", ">"):
            for name, new in NEW_NIFTI.items():
                path = self.folder / name
                path.write_bytes(new(order, 4))
                result = self.read(path)
                self.assertEqual(result.returncode, 0, (order, name, result.stderr))
                for code in (0, 1, 127, -23804):
                    self.assert_refused(name, new(order, code), f"the type of data {code}, which VTK")

    def test_limit_of_memory(self):
        """A header that a compressed file could keep: it is believed up to the limit."""
        header = METAIMAGE.format(compressed="True\nCompressedDataSize = 1000", edge=1024, data_file="LOCAL").encode("ascii")
        self.assert_refused("large.mha", header + bytes(3 << 20), "--max-memory sets this limit")


if __name__ == "__main__":
    unittest.main()
