#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Files that vtkMappedImageReader takes for time steps: each is mapped when its time comes, the next one is read
meanwhile, and the mapper draws what it draws of that file alone."""

import ctypes
import mmap
import os
import tempfile
import time
import unittest
from pathlib import Path

from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkMappedImageReader
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOImage import vtkMetaImageWriter
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkVolume

STEPS = 4
LIBC = ctypes.CDLL(None)


def write_step(path, frequency, last=20):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-20, 20, -20, 20, -20, last)
    source.SetXFreq(frequency)
    writer = vtkMetaImageWriter()
    writer.SetCompression(False)
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetRAWFileName(str(path.with_suffix(".raw")))
    writer.Write()


def new_reader(paths):
    names = vtkStringArray()
    for path in paths:
        names.InsertNextValue(str(path))
    reader = vtkMappedImageReader()
    reader.SetFileNames(names)
    return reader


def get_bytes(array):
    return memoryview(array).tobytes()


def get_samples(reader):
    return get_bytes(reader.GetOutput().GetPointData().GetScalars())


class Errors:
    def __init__(self, *objects):
        self.texts = []
        for origin in objects:
            origin.AddObserver("ErrorEvent", self.add)

    def add(self, caller, event, text=None):
        self.texts.append(text)

    add.CallDataType = "string0"


class Scene:
    """What a mapper draws of a reader."""

    def __init__(self, reader):
        self.mapper, self.volume, renderer = vtkIsosurfaceRayTraceMapper(), vtkVolume(), vtkRenderer()
        self.mapper.SetInputConnection(reader.GetOutputPort())
        self.volume.SetMapper(self.mapper)
        self.volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 157.0)
        self.volume.GetProperty().GetScalarOpacity().AddPoint(157.0, 1.0)
        reader.Update()
        renderer.ResetCamera(reader.GetOutput().GetBounds())
        self.camera = renderer.GetActiveCamera()

    def draw(self):
        picture = vtkImageData()
        assert self.mapper.RenderToImage(self.volume, self.camera, None, 60, 50, picture)
        return get_bytes(picture.GetPointData().GetArray("Colors"))


class TestTimeSteps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.paths = [self.folder / f"step{i}.mhd" for i in range(STEPS)]
        for i, path in enumerate(self.paths):
            write_step(path, 30.0 + 10.0 * i)
        self.samples = [path.with_suffix(".raw").read_bytes() for path in self.paths]

    def test_times(self):
        reader = new_reader(self.paths)
        reader.UpdateInformation()
        information = reader.GetOutputInformation(0)
        pipeline = vtkStreamingDemandDrivenPipeline
        self.assertEqual([information.Get(pipeline.TIME_STEPS(), i) for i in range(STEPS)], [0.0, 1.0, 2.0, 3.0])
        self.assertEqual([information.Get(pipeline.TIME_RANGE(), i) for i in range(2)], [0.0, 3.0])
        reader.Update()
        self.assertEqual(get_samples(reader), self.samples[0])
        nan = float("nan")
        for asked, step in ((2, 2), (0, 0), (3, 3), (1.4, 1), (1.6, 2), (-5, 0), (1e300, 3), (nan, 0)):
            with self.subTest(asked):
                reader.UpdateTimeStep(asked)
                self.assertEqual(get_samples(reader), self.samples[step])
                self.assertEqual(reader.GetOutput().GetInformation().Get(vtkDataObject.DATA_TIME_STEP()), step)

    def test_one_file_has_no_times(self):
        reader = new_reader(self.paths)
        reader.Update()
        reader.SetFileName(str(self.paths[1]))
        reader.Update()
        self.assertFalse(reader.GetOutputInformation(0).Has(vtkStreamingDemandDrivenPipeline.TIME_STEPS()))
        self.assertEqual(get_samples(reader), self.samples[1])

    def test_slices(self):
        reader = new_reader(self.paths)
        reader.UpdateTimeStep(2, 0, 1, 0, (0, 40, 0, 40, 23, 24))
        self.assertEqual(reader.GetOutput().GetExtent(), (0, 40, 0, 40, 23, 24))
        size = 41 * 41 * 4
        self.assertEqual(get_samples(reader), self.samples[2][23 * size:25 * size])

    def test_raw_samples(self):
        """Their extent is not that of slices."""
        reader = vtkMappedImageReader()
        reader.SetDataExtent(0, 40, 0, 40, -1, 39)
        reader.SetDataScalarTypeToFloat()
        reader.SetFileDimensionality(3)
        reader.FileLowerLeftOn()
        names = new_reader(path.with_suffix(".raw") for path in self.paths).GetFileNames()
        reader.SetFileNames(names)
        self.assertEqual(reader.GetDataExtent(), (0, 40, 0, 40, -1, 39))
        reader.UpdateTimeStep(3)
        self.assertEqual(reader.GetOutput().GetExtent(), (0, 40, 0, 40, -1, 39))
        self.assertEqual(get_samples(reader), self.samples[3])

    def test_pictures(self):
        reader = new_reader(self.paths)
        scene = Scene(reader)
        pictures = set()
        for step in (0, 1, 2, 3, 2, 0, 0, 3):
            reader.UpdateTimeStep(step)
            alone = vtkMappedImageReader()
            alone.SetFileName(str(self.paths[step]))
            picture = scene.draw()
            self.assertEqual(picture, Scene(alone).draw())
            self.assertGreater(scene.mapper.GetMacrocellBuildTime(), 0.0)
            pictures.add(picture)
        self.assertEqual(len(pictures), STEPS)

    def test_arrays_outlive_their_step(self):
        reader = new_reader(self.paths)
        arrays = []
        for step in range(STEPS):
            reader.UpdateTimeStep(step)
            arrays.append(reader.GetOutput().GetPointData().GetScalars())
        del reader
        for array, samples in zip(arrays, self.samples):
            self.assertEqual(get_bytes(array), samples)

    def test_step_that_is_missing_or_another(self):
        """An error when it is asked for, and not before."""
        self.paths[1].unlink()
        write_step(self.paths[2], 60.0, last=21)
        reader = new_reader(self.paths)
        errors, silence = Errors(reader), Errors(reader.GetExecutive())
        reader.Update()
        self.assertEqual(errors.texts, [])
        for step, words in ((1, "step1.mhd"), (2, "not that of the first time step")):
            reader.UpdateTimeStep(step)
            self.assertEqual(len(errors.texts), 1)
            self.assertIn(words, errors.texts.pop())
            reader.UpdateTimeStep(3)
            self.assertEqual(errors.texts, [])
            self.assertEqual(get_samples(reader), self.samples[3])

    def test_first_step_with_another_header(self):
        reader = new_reader(self.paths)
        reader.UpdateTimeStep(2)
        other = self.folder / "other.mhd"
        write_step(other, 55.0)
        other.replace(self.paths[0])
        reader.UpdateTimeStep(0)
        self.assertEqual(get_samples(reader), other.with_suffix(".raw").read_bytes())

    @unittest.skipUnless(hasattr(os, "fork"), "this system has no fork")
    def test_forked_process(self):
        """It has not the thread that reads ahead."""
        reader = new_reader(self.paths)
        reader.UpdateTimeStep(0)
        child = os.fork()
        if child == 0:
            status = 1
            try:
                reader.UpdateTimeStep(1)
                status = 0 if get_samples(reader) == self.samples[1] else 1
                del reader
            finally:
                os._exit(status)
        self.assertEqual(os.waitpid(child, 0)[1], 0)

    def test_no_files(self):
        for reader in (new_reader([]), vtkMappedImageReader()):
            errors, silence = Errors(reader), Errors(reader.GetExecutive())
            reader.Update()
            self.assertEqual(len(errors.texts), 1)
            self.assertIn("SetFileNames", errors.texts[0])

    def is_in_memory(self, step):
        """Whether the system has all of a file."""
        with open(self.paths[step].with_suffix(".raw"), "rb") as file:
            pages = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_COPY)
        first = ctypes.c_char.from_buffer(pages)
        states = ctypes.create_string_buffer(-(-len(pages) // mmap.PAGESIZE))
        result = LIBC.mincore(ctypes.c_void_p(ctypes.addressof(first)), ctypes.c_size_t(len(pages)), states)
        self.assertEqual(result, 0)
        return all(state & 1 for state in states.raw)

    def drop(self):
        """The files from the memory of the system. Returns whether that is possible."""
        for step, path in enumerate(self.paths):
            with open(path.with_suffix(".raw"), "rb") as file:
                os.fsync(file.fileno())
                os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
        return not any(map(self.is_in_memory, range(STEPS)))

    @unittest.skipUnless(hasattr(LIBC, "mincore"), "this system does not tell what it has in memory")
    def test_prefetch(self):
        """Of the whole next file in the direction of time: more than systems read ahead."""
        for path in self.paths:
            os.truncate(path.with_suffix(".raw"), 384 << 16)
        if not self.drop():
            self.skipTest("the files are in memory alone")
        reader = new_reader(path.with_suffix(".raw") for path in self.paths)
        reader.SetDataExtent(0, 255, 0, 255, 0, 383)
        reader.SetDataScalarTypeToUnsignedChar()
        reader.SetFileDimensionality(3)
        reader.FileLowerLeftOn()
        for step, following in ((2, 3), (1, 0), (2, 3), (3, None), (0, None)):
            self.assertTrue(self.drop())
            reader.UpdateTimeStep(step)
            deadline = time.monotonic() + 20.0
            while following is not None and not self.is_in_memory(following) and time.monotonic() < deadline:
                time.sleep(0.01)
            # Nobody has looked at the samples of the step itself.
            self.assertEqual([i for i in range(STEPS) if self.is_in_memory(i)], [] if following is None else [following])


if __name__ == "__main__":
    unittest.main()
