#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Macrocells that are kept in a directory: a file that is opened again is drawn without a pass over its samples, and
what is damaged, stale or of another file is never believed."""

import hashlib
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkMappedImageReader
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkVolume

DIMENSIONS = (256, 256, 512)
SLICE = 256 * 256  # bytes
SIZE = 512 * SLICE
SETTLED = 2.2  # seconds, after which the times of a file tell whether it is changed
LINUX = sys.platform == "linux"


def write_volume(folder, name="volume", value=100, offset=0):
    """Zero, which takes no room in the file, but for a box in its middle."""
    with open(folder / f"{name}.raw", "wb") as file:
        file.seek(offset + 250 * SLICE)
        for _ in range(12):
            file.write(bytes(SLICE // 4) + bytes([value]) * (SLICE // 4) + bytes(SLICE // 2))
        file.truncate(offset + SIZE)
    header = folder / f"{name}.mhd"
    sizes = " ".join(map(str, DIMENSIONS))
    header.write_text(f"NDims = 3\nDimSize = {sizes}\nElementType = MET_UCHAR\nHeaderSize = {offset}\n"
                      f"ElementDataFile = {name}.raw\n", encoding="ascii")
    return header


class View:
    """A picture of a file, and what it took."""

    def __init__(self, header, cache=None, change=None, prepare=None):
        reader = vtkMappedImageReader()
        reader.SetFileName(str(header))
        reader.Update()
        self.mapper, volume, renderer, picture = vtkIsosurfaceRayTraceMapper(), vtkVolume(), vtkRenderer(), vtkImageData()
        self.warnings = []
        self.mapper.AddObserver("WarningEvent", self.add_warning)
        self.mapper.SetInputConnection(reader.GetOutputPort())
        self.mapper.SetCacheDirectory(cache and str(cache))
        if prepare:
            prepare(self.mapper)
        if change:
            change(memoryview(reader.GetOutput().GetPointData().GetScalars()))
        volume.SetMapper(self.mapper)
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 50.0)
        volume.GetProperty().GetScalarOpacity().AddPoint(50.0, 1.0)
        renderer.ResetCamera(reader.GetOutput().GetBounds())
        camera = renderer.GetActiveCamera()
        camera.Elevation(30.0)
        before = read_mapped_memory()
        for _ in range(2):
            assert self.mapper.RenderToImage(volume, camera, None, 64, 64, picture)
        self.pages = read_mapped_memory() - before
        self.colors = bytes(memoryview(picture.GetPointData().GetArray("Colors")))
        assert max(self.colors) > 0

    def add_warning(self, caller, event, text=None):
        self.warnings.append(text)

    add_warning.CallDataType = "string0"

    @property
    def has_read_all(self):
        assert self.pages > SIZE * 0.9 or self.pages < SIZE // 4, self.pages
        return self.pages > SIZE // 2


def read_mapped_memory():
    """The bytes of files that this process has looked at, where they are mapped."""
    (line,) = (line for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines()
               if line.startswith("RssFile:"))
    return int(line.split()[1]) << 10


def flip(data, place):
    return data[:place] + bytes([data[place] ^ 1]) + data[place + 1:]


@unittest.skipUnless(LINUX, "other systems do not tell what has been written to")
class TestMacrocellCache(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.volume = write_volume(cls.folder)
        cls.other = write_volume(cls.folder, "other", 200)
        time.sleep(SETTLED)
        cls.expected = View(cls.volume).colors

    def setUp(self):
        folder = tempfile.TemporaryDirectory(dir=self.folder)
        self.addCleanup(folder.cleanup)
        self.cache = Path(folder.name) / "for" / "macrocells"

    def get_kept(self):
        return sorted(self.cache.iterdir()) if self.cache.exists() else []

    def keep(self):
        """The file in which the macrocells of the volume are."""
        self.assertTrue(View(self.volume, self.cache).has_read_all)
        (kept,) = self.get_kept()
        return kept

    def assert_believed(self):
        view = View(self.volume, self.cache)
        self.assertFalse(view.has_read_all)
        self.assertEqual(view.colors, self.expected)

    def assert_rebuilt(self):
        """And then believed."""
        view = View(self.volume, self.cache)
        self.assertTrue(view.has_read_all)
        self.assertEqual(view.colors, self.expected)
        self.assertEqual(view.warnings, [])
        self.assert_believed()

    def test_second_opening(self):
        first = View(self.volume, self.cache)
        self.assertTrue(first.has_read_all)
        self.assertEqual(first.colors, self.expected)
        self.assert_believed()
        (kept,) = self.get_kept()
        self.assertLess(kept.stat().st_size, SIZE // 250 + 1000)
        self.assertTrue(View(self.volume).has_read_all)  # off by default
        for layout in range(3):
            view = View(self.volume, self.cache, prepare=lambda mapper, layout=layout: mapper.SetBrickLayout(layout))
            self.assertFalse(view.has_read_all)
            self.assertEqual(view.colors, self.expected)

    def test_levels(self):
        """The levels above are built of the finest, whose edge counts."""
        self.keep()
        for levels, edge, is_kept in ((1, 8, True), (3, 8, True), (0, 8, True), (2, 16, False)):
            def prepare(mapper, levels=levels, edge=edge):
                mapper.SetNumberOfMacrocellLevels(levels)
                mapper.SetMacrocellBranching(0, edge)
            with self.subTest(levels=levels, edge=edge):
                view = View(self.volume, self.cache, prepare=prepare)
                self.assertEqual(view.colors, self.expected)
                if levels > 0:  # Without levels rays read all samples on their way.
                    self.assertEqual(view.has_read_all, not is_kept)

    def test_damaged(self):
        kept = self.keep()
        data = kept.read_bytes()
        begin = len(data) - 32 * 32 * 64 * 2
        for name, damaged in (
            ("empty", b""),
            ("cut", data[:-1]),
            ("half", data[:len(data) // 2]),
            ("longer", data + b"\0"),
            ("first range", flip(data, begin)),
            ("last range", flip(data, len(data) - 1)),
            ("checksum", flip(data, begin - 1)),
            ("ranges of zero", data[:begin] + bytes(len(data) - begin)),
            ("all zero", bytes(len(data))),
            ("version", data.replace(b"version 1", b"version 0")),
            ("byte order", data.replace(b"little", b"middle").replace(b"big-", b"bug-")),
            ("path", data.replace(b"volume.raw", b"velume.raw")),
            ("dimensions", data.replace(b"256 x 256 x 512", b"256 x 512 x 256")),
            ("type", data.replace(b"uint8", b"uint9")),
            ("edge", data.replace(b"of 8 cells", b"of 4 cells")),
        ):
            with self.subTest(name):
                self.assertNotEqual(damaged, data)
                kept.write_bytes(damaged)
                self.assert_rebuilt()
                self.assertEqual(kept.read_bytes(), data)
                self.assertEqual(self.get_kept(), [kept])

    def test_any_flipped_bit(self):
        """The checksum counts every bit of some places, the ranges' own included."""
        kept = self.keep()
        data = kept.read_bytes()
        for place in range(0, len(data), len(data) // 40):
            kept.write_bytes(flip(data, place))
            self.assertTrue(View(self.volume, self.cache).has_read_all, place)

    def test_macrocells_of_another_file(self):
        kept = self.keep()
        View(self.other, self.cache)
        (foreign,) = set(self.get_kept()) - {kept}
        kept.write_bytes(foreign.read_bytes())
        self.assert_rebuilt()

    def test_changed_file(self):
        """A file that has the size and the time of the one before is another, however it came there."""
        folder = self.cache.parent.parent
        volume = write_volume(folder)
        samples = folder / "volume.raw"
        os.utime(samples, (1, 1))
        time.sleep(SETTLED)
        self.assertTrue(View(volume, self.cache).has_read_all)
        self.assertFalse(View(volume, self.cache).has_read_all)
        (kept,) = self.get_kept()
        for way in ("rewritten", "renamed"):
            write_volume(folder, "new", 200)
            if way == "renamed":
                os.rename(folder / "new.raw", samples)
            else:
                samples.write_bytes((folder / "new.raw").read_bytes())
            os.utime(samples, (1, 1))
            with self.subTest(way):
                expected = View(volume).colors
                view = View(volume, self.cache)
                self.assertTrue(view.has_read_all)
                self.assertEqual(view.colors, expected)
                time.sleep(SETTLED)
                View(volume, self.cache)
                self.assertFalse(View(volume, self.cache).has_read_all)
                self.assertEqual(self.get_kept(), [kept])  # It is replaced.

    def test_file_that_is_changed_before_it_is_drawn(self):
        """After it was mapped: nothing is kept by its name."""
        folder = self.cache.parent.parent
        volume, new = write_volume(folder), write_volume(folder, "new", 200)
        samples, others = volume.with_suffix(".raw"), new.with_suffix(".raw")
        os.utime(samples, (1, 1))
        time.sleep(SETTLED)

        def rewrite(memory):
            with open(samples, "r+b") as file:
                file.write(others.read_bytes())
            os.utime(samples, (1, 1))

        for change in (rewrite, lambda memory: os.rename(others, samples), lambda memory: samples.unlink()):
            View(volume, self.cache, change)
            self.assertEqual(self.get_kept(), [])
            time.sleep(SETTLED)

    def test_file_that_has_just_been_changed(self):
        """Its time may be that of a later change, too."""
        volume = write_volume(self.cache.parent.parent)
        View(volume, self.cache)
        self.assertEqual(self.get_kept(), [])

    def test_samples_that_were_written_to(self):
        """They are not those of the file, which is as it was."""
        def change(samples):
            samples[SIZE // 8] = 255

        changed = View(self.volume, None, change).colors
        self.assertTrue(View(self.volume, self.cache, change).has_read_all)
        self.assertEqual(self.get_kept(), [])
        self.keep()
        view = View(self.volume, self.cache, change)
        self.assertTrue(view.has_read_all)
        self.assertEqual(view.colors, changed)
        self.assert_believed()

    def test_places_in_a_file(self):
        folder = self.cache.parent.parent
        late = write_volume(folder, "late", offset=4096)
        early = folder / "early.mhd"
        early.write_text(late.read_text(encoding="ascii").replace("= 4096", "= 0"), encoding="ascii")
        time.sleep(SETTLED)
        pictures = [View(volume).colors for volume in (late, early)]
        for _ in range(2):
            for volume, picture in zip((late, early), pictures):
                self.assertEqual(View(volume, self.cache).colors, picture)
        self.assertEqual(len(self.get_kept()), 2)

    def test_directory_that_cannot_be_written_to(self):
        blocked = self.folder / "blocked"
        blocked.write_text("a file")
        for directory in (blocked, blocked / "below", Path("/proc/none")):
            with self.subTest(directory):
                view = View(self.volume, directory)
                self.assertEqual(view.colors, self.expected)
                (warning,) = view.warnings
                self.assertIn(f"cannot be kept in {directory}", warning)
                self.assertIn("SetCacheDirectory", warning)

    def test_file_that_cannot_be_replaced(self):
        kept = self.keep()
        kept.unlink()
        kept.mkdir()
        view = View(self.volume, self.cache)
        self.assertEqual(view.colors, self.expected)
        self.assertEqual(len(view.warnings), 1)
        self.assertEqual(self.get_kept(), [kept])

    def test_many_processes_at_once(self):
        command = [sys.executable, __file__, str(self.volume), str(self.cache)]
        expected = hashlib.sha256(self.expected).hexdigest()
        for _ in range(3):
            processes = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(4)]
            for process in processes:
                self.assertEqual(process.communicate()[0].strip(), expected)
            (kept,) = self.get_kept()
            self.assert_believed()
            kept.write_bytes(b"damaged")

    def test_small_volume(self):
        folder = self.cache.parent.parent
        header = write_volume(folder)
        text = header.read_text(encoding="ascii").replace("256 256 512", "64 64 64")
        header.write_text(text.replace("HeaderSize = 0", f"HeaderSize = {251 * SLICE}"), encoding="ascii")
        time.sleep(SETTLED)
        View(header, self.cache)
        self.assertEqual(self.get_kept(), [])


if __name__ == "__main__":
    if len(sys.argv) == 3:
        print(hashlib.sha256(View(*sys.argv[1:]).colors).hexdigest())
    else:
        unittest.main()
