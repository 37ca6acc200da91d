#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The pass over the samples of a large volume: it tells its progress, stops when it is asked to, goes on where it
stopped, and frames of interaction show what it has read; what is complete is the same, bit for bit."""

import tempfile
import time
import unittest
from pathlib import Path

import numpy
from vtkIsosurfaceRayTracing import vtkMappedImageReader
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector

import InteractiveScene

SLABS = 4
SLICES = 256  # of a slab: 16 MiB
DIMENSIONS = (256, 256, SLABS * SLICES + 1)
SIZE = InteractiveScene.SIZE  # A slab has 32 rows.


def make_samples(phase=0.0):
    x, y, z = (numpy.sin(numpy.arange(count) * step + phase) for count, step in zip(DIMENSIONS, (0.06, 0.05, 0.03)))
    x, y, z = ((128 + 42 * wave).astype(numpy.uint8) // 3 for wave in (x, y, z))
    return z[:, None, None] + y[:, None] + x


def make_image(samples):
    image = vtkImageData()
    image.SetDimensions(*DIMENSIONS)
    image.SetSpacing(1.0, 1.0, 0.25)
    image.GetPointData().SetScalars(numpy_to_vtk(samples.ravel()))
    image.samples = samples
    return image


SAMPLES = make_samples()


class Scene(InteractiveScene.Scene):
    def __init__(self, image=None, isovalue=128.0):
        super().__init__(make_image(SAMPLES) if image is None else image, isovalue)


FRACTIONS = [(i + 1) / SLABS for i in range(SLABS)]
WHOLE = Scene().render()
IN_IMAGE = Scene().render_to_image()


class TestReadingSamples(unittest.TestCase):
    def check_part(self, rows, slabs):
        """Whether a picture has what has been read, and nothing above it."""
        border = slabs * SIZE // SLABS
        numpy.testing.assert_array_equal(rows[:border], WHOLE[:border])
        self.assertTrue((WHOLE[border:].max(axis=1) > 0).all())
        self.assertEqual(rows[border:].max(initial=0), 0)

    def test_progress(self):
        for call in (Scene.render, Scene.render_to_image, Scene.cast):
            with self.subTest(call.__name__):
                scene = Scene().observe()
                call(scene)
                self.assertEqual(scene.fractions, FRACTIONS)
                call(scene)
                self.assertEqual(len(scene.fractions), SLABS)

    def test_abort(self):
        for slabs in range(1, SLABS + 1):
            with self.subTest(slabs):
                scene = Scene().observe()
                scene.on_progress = lambda: len(scene.fractions) == slabs and scene.window.SetAbortRender(1)
                self.assertEqual(scene.render().max(), 0)
                self.assertEqual(scene.fractions, FRACTIONS[:slabs])
                self.assertEqual(scene.window.CheckAbortStatus(), 1)
                numpy.testing.assert_array_equal(scene.render(), WHOLE)
                self.assertEqual(scene.fractions, FRACTIONS)
                self.assertEqual(scene.errors + scene.warnings, [])

    def test_goes_on_in_other_calls(self):
        scene = Scene().observe()
        expected = Scene().cast()
        scene.on_progress = lambda: scene.window.SetAbortRender(1)
        scene.render()
        self.assertEqual(scene.cast(), expected)
        self.assertEqual(scene.fractions, FRACTIONS)

    def test_frames_of_interaction(self):
        scene = Scene().observe()
        for slabs in range(1, SLABS):
            self.check_part(scene.render_interactively(), slabs)
            self.assertEqual(scene.fractions, FRACTIONS[:slabs])
        numpy.testing.assert_array_equal(scene.render_interactively(), WHOLE)
        self.assertEqual(scene.errors + scene.warnings, [])

    def test_rest_is_complete(self):
        for rate in (0.0001, 0.99):
            scene = Scene()
            scene.renderer.GetCullers().RemoveAllItems()  # which would give it all to what is seen
            for _ in range(2000):  # However many others share the time of a frame.
                scene.renderer.AddActor(vtkActor())
            self.check_part(scene.render_interactively(), 1)
            scene.window.SetDesiredUpdateRate(rate)
            numpy.testing.assert_array_equal(scene.render(), WHOLE)

    def test_picture_without_window_is_complete(self):
        scene = Scene()
        scene.window.SetDesiredUpdateRate(1e9)
        self.check_part(scene.render(), 1)
        self.assertEqual(scene.render_to_image(), IN_IMAGE)

    def test_selection_is_complete(self):
        scene = Scene()
        self.check_part(scene.render_interactively(), 1)
        scene.window.SetDesiredUpdateRate(1e9)
        selector = vtkHardwareSelector()
        selector.SetRenderer(scene.renderer)
        selector.SetArea(0, SIZE - 2, SIZE - 1, SIZE - 1)
        self.assertEqual(selector.Select().GetNumberOfNodes(), 1)

    def test_time_for_reading(self):
        # A frame in a second reads more than a slab.
        scene = Scene().observe()
        scene.render_interactively(1.0)
        self.assertGreater(len(scene.fractions), 1)

    def test_kinds_of_surfaces(self):
        settings = {
            "nearest": lambda mapper: mapper.SetInterpolationModeToNearest(),
            "cubic": lambda mapper: mapper.SetInterpolationModeToCubic(),
            "maximum": lambda mapper: mapper.SetBlendModeToMaximumIntensity(),
            "no levels": lambda mapper: mapper.SetNumberOfMacrocellLevels(0),
            "one level": lambda mapper: mapper.SetNumberOfMacrocellLevels(1),
            "little memory": lambda mapper: mapper.SetMaximumBrickMemory(1),
        }
        for name, change in settings.items():
            with self.subTest(name):
                reference, scene = Scene(), Scene()
                for one in (reference, scene):
                    change(one.mapper)
                expected = reference.render()
                pictures = [scene.render_interactively() for _ in range(SLABS)]
                numpy.testing.assert_array_equal(pictures[-1], expected)
                rows = SIZE // SLABS - 2  # Tricubic cells reach beyond the border of a slab.
                numpy.testing.assert_array_equal(pictures[0][:rows], expected[:rows])
                self.assertEqual(scene.errors + scene.warnings, [])

    def test_blocks(self):
        images = [make_image(SAMPLES), make_image(SAMPLES)]
        images[1].SetOrigin(0.3, 0.2, 0.1)  # on a lattice of its own
        blocks = vtkMultiBlockDataSet()
        for i, image in enumerate(images):
            blocks.SetBlock(i, image)
        expected = Scene(blocks).render()
        scene = Scene(blocks).observe()
        pictures = [scene.render_interactively() for _ in range(2 * SLABS)]
        self.assertEqual(scene.fractions, [(i + 1) / 2 / SLABS for i in range(2 * SLABS)])
        numpy.testing.assert_array_equal(pictures[-1], expected)
        heights = [numpy.count_nonzero(picture.max(axis=1)) for picture in pictures]
        self.assertEqual(heights[0], SIZE // SLABS)
        self.assertEqual(sorted(heights), heights)

    def test_new_isovalue_in_the_middle(self):
        scene = Scene(isovalue=100.0)
        scene.render_interactively()
        scene.volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 128.0)
        self.check_part(scene.render_interactively(), 2)

    def test_other_data_in_the_middle(self):
        samples = make_samples(1.0)
        expected = Scene(make_image(samples)).render()
        scene = Scene(make_image(make_samples())).observe()
        self.check_part(scene.render_interactively(), 1)
        scene.image.samples[...] = samples
        scene.image.Modified()
        numpy.testing.assert_array_equal(scene.render(), expected)
        self.assertEqual(scene.fractions, [FRACTIONS[0], *FRACTIONS])

    def test_parts_are_not_accumulated(self):
        scene = Scene()
        scene.mapper.ProgressiveAccumulationOn()
        for _ in range(SLABS - 1):
            scene.render_interactively()
            self.assertEqual(scene.mapper.GetNumberOfAccumulatedFrames(), 0)
        numpy.testing.assert_array_equal(scene.render(), WHOLE)
        self.assertEqual(scene.mapper.GetNumberOfAccumulatedFrames(), 1)

    def test_both_eyes_see_the_same(self):
        scene = Scene().observe()
        scene.renderer.GetActiveCamera().SetEyeAngle(0.0)
        scene.window.StereoRenderOn()
        scene.window.SetStereoTypeToInterlaced()
        self.check_part(scene.render_interactively(), 1)
        self.assertEqual(scene.fractions, FRACTIONS[:1])

    def test_hint(self):
        scene = Scene(isovalue=1000.0)
        scene.render_interactively()
        self.assertEqual(scene.warnings, [])
        scene.render()
        self.assertEqual(len(scene.warnings), 1)
        self.assertIn("There is no surface", scene.warnings[0])
        scene = Scene(isovalue=1000.0)
        scene.render()
        self.assertEqual(len(scene.warnings), 1)

    def test_cache(self):
        with tempfile.TemporaryDirectory() as folder:
            header, cache = Path(folder) / "volume.mhd", Path(folder) / "cache"
            SAMPLES.tofile(Path(folder) / "volume.raw")
            sizes = " ".join(map(str, DIMENSIONS))
            header.write_text(f"NDims = 3\nDimSize = {sizes}\nElementSpacing = 1 1 0.25\nElementType = MET_UCHAR\n"
                              "ElementDataFile = volume.raw\n", encoding="ascii")
            time.sleep(2.2)  # after which the times of a file tell whether it is changed

            def open_scene():
                reader = vtkMappedImageReader()
                reader.SetFileName(str(header))
                reader.Update()
                scene = Scene(reader.GetOutput()).observe()
                scene.mapper.SetCacheDirectory(str(cache))
                return scene
            scene = open_scene()
            self.check_part(scene.render_interactively(), 1)
            self.assertFalse(cache.exists())
            numpy.testing.assert_array_equal(scene.render(), WHOLE)
            self.assertEqual(scene.fractions, FRACTIONS)
            self.assertEqual(len(list(cache.iterdir())), 1)
            scene = open_scene()
            numpy.testing.assert_array_equal(scene.render_interactively(), WHOLE)
            self.assertEqual(scene.fractions, [1.0])


if __name__ == "__main__":
    unittest.main()
