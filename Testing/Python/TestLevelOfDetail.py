#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A coarse level stands in for a large volume in frames of interaction. It is compared with the exact picture of the
same samples, which numpy takes; whatever is no such frame is the same as without it, bit for bit."""

import tempfile
import unittest
from pathlib import Path

import numpy
from vtkIsosurfaceRayTracing import vtkMappedImageReader
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (vtkDataSetAttributes, vtkImageData, vtkMultiBlockDataSet, vtkPlane,
                                           vtkRectilinearGrid)
from vtkmodules.vtkRenderingCore import vtkHardwareSelector

from InteractiveScene import SIZE, Scene
from TestMacrocellCache import read_mapped_memory

STEP = 2
DIMENSIONS = (512, 512, 33)
SPACING = (0.5, 0.5, 8.0)
# So many slices are passed over for a frame; an exact slab has as many.
SLICES = 16
FRAMES = 2  # until the coarse level is complete


def take(count, step=STEP):
    last = count - 1
    taken = max(2, last // step + 1)
    return [(i * last + (taken - 1) // 2) // (taken - 1) for i in range(taken)]


def take_slices(count, number, step=STEP):
    """The first that are read."""
    taken = take(count, step)
    order = [0, len(taken) - 1]
    distance = 1 << (len(taken) - 1).bit_length() - 1
    while distance:
        order += [i for i in range(distance, len(taken) - 1, 2 * distance)]
        distance //= 2
    assert sorted(order) == list(range(len(taken)))
    return sorted(taken[i] for i in order[:number])


def make_samples(dimensions=DIMENSIONS, phase=0.0):
    x, y, z = (numpy.sin(2.0 * numpy.pi * numpy.linspace(0.0, turns, count, dtype=numpy.float32) + phase)
               for count, turns in zip(dimensions, (2.3, 1.8, 2.1)))
    return (128 + 42 * (z[:, None, None] + y[:, None] + x)).astype(numpy.float32)


SAMPLES = make_samples()


def set_scalars(data, samples, name="scalars"):
    array = numpy_to_vtk(samples.reshape(-1, samples.shape[3]) if samples.ndim == 4 else samples.ravel())
    array.SetName(name)
    data.AddArray(array)
    data.SetActiveScalars(name)


def make_image(samples=SAMPLES, spacing=SPACING, origin=(0.0, 0.0, 0.0)):
    image = vtkImageData()
    image.SetDimensions(*samples.shape[2::-1])
    image.SetSpacing(*spacing)
    image.SetOrigin(*origin)
    set_scalars(image.GetPointData(), samples)
    image.samples = samples
    return image


def make_grid(samples, coordinates):
    grid = vtkRectilinearGrid()
    grid.SetDimensions(*samples.shape[2::-1])
    for axis, name in enumerate("XYZ"):
        getattr(grid, f"Set{name}Coordinates")(numpy_to_vtk(numpy.array(coordinates[axis], dtype=float)))
    set_scalars(grid.GetPointData(), samples)
    grid.samples = samples
    return grid


def decimate(samples=SAMPLES, spacing=SPACING, origin=(0.0, 0.0, 0.0), slices=1000, step=STEP, coordinates=None):
    """What the coarse level of an image or a grid should be, as a grid that is drawn exactly."""
    depth, height, width = samples.shape[:3]
    taken = [take(width, step), take(height, step), take_slices(depth, slices, step)]
    if coordinates is None:
        coordinates = [start + size * numpy.arange(count)
                       for start, size, count in zip(origin, spacing, (width, height, depth))]
    return make_grid(samples[numpy.ix_(*taken[::-1])].copy(),
                     [numpy.asarray(axis)[numbers] for axis, numbers in zip(coordinates, taken)])


def detailed(data=None, **arguments):
    scene = Scene(make_image() if data is None else data, **arguments)
    scene.mapper.LevelOfDetailOn()
    return scene


class TestLevelOfDetail(unittest.TestCase):
    def check_same(self, picture, expected, most=0.002):
        """Whether pictures differ by rounding only: at the edge of a surface, in a few pixels."""
        self.assertGreater(numpy.count_nonzero(expected), expected.size // 50)
        differing = numpy.count_nonzero(abs(picture.astype(int) - expected) > 2)
        self.assertLessEqual(differing, most * picture.size)

    def check_coarse(self, scene, reference, most=0.002):
        """Whether the complete coarse level is the reference, and the rest is exact."""
        for _ in range(FRAMES):
            picture = scene.render_interactively()
        expected = reference.render()
        self.check_same(picture, expected, most)
        exact = scene.render()
        self.assertGreater(numpy.count_nonzero(exact != picture), 0)
        scene.mapper.LevelOfDetailOff()
        numpy.testing.assert_array_equal(scene.render(), exact)
        self.assertEqual(scene.errors + scene.warnings, [])
        return picture, exact

    def test_frames_of_interaction(self):
        exact, scene = Scene(make_image()), detailed().observe()
        self.check_same(scene.render_interactively(), Scene(decimate(slices=SLICES)).render())
        self.check_same(scene.render_interactively(), Scene(decimate()).render())
        self.assertEqual(scene.fractions, [0.5, 1.0])
        self.check_same(scene.render_interactively(), Scene(decimate()).render())  # Exact frames may be slow.
        numpy.testing.assert_array_equal(scene.render(), exact.render())
        scene.renderer.GetCullers().RemoveAllItems()
        numpy.testing.assert_array_equal(scene.render_interactively(1.0), exact.render())
        self.assertEqual(scene.errors + scene.warnings, [])

    def test_slices_from_coarse_to_fine(self):
        dimensions = (1024, 1024, 65)
        samples = make_samples(dimensions)
        spacing = (0.25, 0.25, 4.0)
        scene = detailed(make_image(samples, spacing))
        for slices in (4, 8, 12, 16, 17):
            with self.subTest(slices):
                reference = Scene(decimate(samples, spacing, slices=slices, step=4))
                self.check_same(scene.render_interactively(), reference.render())

    def test_off(self):
        scene = Scene(make_image())
        self.assertFalse(scene.mapper.GetLevelOfDetail())
        rows = scene.render_interactively()
        self.assertEqual(rows[SIZE // 2 + 1:].max(), 0)

    def test_exact_pictures_in_between(self):
        expected = Scene(make_image()).render()
        for frames in range(1, FRAMES + 3):
            with self.subTest(frames):
                scene = detailed()
                for _ in range(frames):
                    scene.render_interactively()
                numpy.testing.assert_array_equal(scene.render(), expected)

    def test_others_are_exact(self):
        for call in (Scene.render_to_image, Scene.cast):
            with self.subTest(call.__name__):
                expected = call(Scene(make_image()))
                scene = detailed()
                scene.render_interactively()
                scene.window.SetDesiredUpdateRate(1e9)
                self.assertEqual(call(scene), expected)

    def test_selection_is_exact(self):
        def select(scene):
            selector = vtkHardwareSelector()
            selector.SetFieldAssociation(1)
            selector.SetRenderer(scene.renderer)
            selector.SetArea(20, 20, 40, 40)
            node = selector.Select().GetNode(0)
            return [node.GetSelectionList().GetValue(i) for i in range(node.GetSelectionList().GetNumberOfTuples())]
        expected = select(Scene(make_image()))
        scene = detailed()
        scene.render_interactively()
        scene.window.SetDesiredUpdateRate(1e9)
        self.assertEqual(select(scene), expected)

    def test_slow_frames(self):
        scene, reference = detailed(), Scene(decimate()).render()
        exact = scene.render()
        scene.render_interactively()
        # No frame takes so little time; a frame of a day takes less.
        self.check_same(scene.render_interactively(), reference)
        self.check_same(scene.render_interactively(), reference)
        numpy.testing.assert_array_equal(scene.render(), exact)
        scene.renderer.GetCullers().RemoveAllItems()
        numpy.testing.assert_array_equal(scene.render_interactively(1.0), exact)

    def test_slow_frames_at_the_largest_distance(self):
        """In a ten thousandth of the time of an exact frame there may be few rays."""
        scene, other = detailed(), Scene(make_image())
        for one in (scene, other):
            one.renderer.GetCullers().RemoveAllItems()
            one.render()
            one.mapper.AutoAdjustSampleDistancesOn()
            one.mapper.SetMaximumImageSampleDistance(100.0)
        rate = 2.0 / scene.mapper.GetTraceTime()
        few = scene.render_interactively(rate)
        self.assertGreater(scene.mapper.GetImageSampleDistance(), 1.0)
        other.mapper.AutoAdjustSampleDistancesOff()
        other.mapper.SetImageSampleDistance(scene.mapper.GetImageSampleDistance())
        numpy.testing.assert_array_equal(few, other.render())
        scene.render()
        scene.mapper.SetMaximumImageSampleDistance(2.0)
        coarse = scene.render_interactively(10.0 / scene.mapper.GetTraceTime())
        self.assertEqual(scene.mapper.GetImageSampleDistance(), 1.0)  # It is not known how long it takes.
        self.check_same(coarse, Scene(decimate(slices=SLICES)).render())

    def test_small_volumes_are_exact(self):
        samples = make_samples((128, 128, 128))
        scene = detailed(make_image(samples, (2.0, 2.0, 2.0)))
        numpy.testing.assert_array_equal(scene.render_interactively(), scene.render())

    def test_new_data(self):
        scene = detailed(make_image(SAMPLES.copy()))
        scene.render_interactively()
        scene.image.samples[...] = make_samples(phase=1.0)
        scene.image.Modified()
        self.check_coarse(scene, Scene(decimate(make_samples(phase=1.0))))

    def test_new_data_of_fast_frames(self):
        """They are exact as soon as they are read."""
        scene = detailed(make_image(SAMPLES.copy())).observe()
        scene.render()
        scene.renderer.GetCullers().RemoveAllItems()
        scene.image.samples[...] = make_samples(phase=1.0)
        scene.image.Modified()
        self.check_same(scene.render_interactively(1.0), Scene(decimate(make_samples(phase=1.0), slices=SLICES)).render())
        self.assertEqual(scene.fractions[-1], 1.0)
        numpy.testing.assert_array_equal(scene.render_interactively(1.0), scene.render())

    def test_new_isovalue(self):
        scene, reference = detailed(), Scene(decimate(), 100.0)
        scene.render_interactively()
        scene.volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 100.0)
        self.check_same(scene.render_interactively(), reference.render())

    def test_rectilinear(self):
        coordinates = [256.0 * numpy.linspace(0.0, 1.0, count) ** power
                       for count, power in zip(DIMENSIONS, (1.3, 0.8, 1.5))]
        self.check_coarse(detailed(make_grid(SAMPLES, coordinates)), Scene(decimate(coordinates=coordinates)))

    def test_turned_image(self):
        """The same box, by an image with negative spacing and one with other directions."""
        mirrored = make_image(SAMPLES[:, :, ::-1].copy(), (-0.5, 0.5, 8.0), (255.5, 0.0, 0.0))
        self.check_coarse(detailed(mirrored), Scene(decimate()), 0.02)  # It rounds in the other direction.
        turned = make_image(numpy.ascontiguousarray(SAMPLES.transpose(0, 2, 1)))
        turned.SetDirectionMatrix(0, 1, 0, 1, 0, 0, 0, 0, 1)
        self.check_coarse(detailed(turned), Scene(decimate()))

    def test_cells(self):
        samples = SAMPLES
        image = vtkImageData()
        image.SetDimensions(*(count + 1 for count in DIMENSIONS))
        image.SetSpacing(*SPACING)
        set_scalars(image.GetCellData(), samples)
        scene = detailed(image)
        reference = Scene(decimate(origin=[0.5 * size for size in SPACING]))
        for one in (scene, reference):
            one.mapper.SetScalarModeToDefault()
        self.check_coarse(scene, reference)

    def test_components(self):
        samples = numpy.stack([SAMPLES, 256 - SAMPLES[::-1]], axis=3)
        scene = detailed(make_image(samples))
        scene.mapper.SetVectorModeToComponent()
        scene.mapper.SetVectorComponent(1)
        reference = Scene(decimate(samples[:, :, :, 1]))
        for _ in range(3):  # A slice has twice as many bytes.
            scene.render_interactively()
        scene.mapper.SetVectorComponent(0)
        scene.render_interactively()
        scene.mapper.SetVectorComponent(1)
        self.check_same(scene.render_interactively(), Scene(decimate(samples[:, :, :, 1], slices=SLICES // 2)).render())
        self.check_coarse(scene, reference)

    def test_blanked_cells(self):
        image, grid = make_image(), decimate()
        hidden = numpy.zeros([count - 1 for count in reversed(DIMENSIONS)], numpy.uint8)
        hidden[11:20, :, 101:201] = hidden[:, 51:90, :] = vtkDataSetAttributes.HIDDENCELL
        middles = [[(a + b - 1) // 2 for a, b in zip(planes, planes[1:])] for planes in map(take, DIMENSIONS)]
        for data, flags in ((image, hidden), (grid, hidden[numpy.ix_(*middles[::-1])].copy())):
            array = numpy_to_vtk(flags.ravel(), array_type=vtkUnsignedCharArray().GetDataType())
            array.SetName("vtkGhostType")
            data.GetCellData().AddArray(array)
            data.flags = flags
        self.check_coarse(detailed(image), Scene(grid))

    def test_settings(self):
        def crop(scene):
            scene.mapper.CroppingOn()
            scene.mapper.SetCroppingRegionPlanes(40.0, 200.0, 30.0, 230.0, 50.0, 210.0)

        def crop_regions(scene):
            crop(scene)
            scene.mapper.SetCroppingRegionFlagsToInvertedCross()

        def clip(scene):
            plane = vtkPlane()
            plane.SetOrigin(128.0, 100.0, 128.0)
            plane.SetNormal(0.3, 1.0, 0.2)
            scene.mapper.AddClippingPlane(plane)
            scene.mapper.CapClippingPlanesOn()

        def translucent(scene):
            scene.volume.GetProperty().GetScalarOpacity().RemoveAllPoints()
            scene.volume.GetProperty().GetScalarOpacity().AddPoint(0.0, 0.5)
            scene.volume.GetProperty().GetIsoSurfaceValues().SetValue(1, 150.0)

        settings = {
            "cropping": crop, "regions": crop_regions, "caps": clip, "translucent": translucent,
            "nearest": lambda scene: scene.mapper.SetInterpolationModeToNearest(),
            "cubic": lambda scene: scene.mapper.SetInterpolationModeToCubic(),
            "maximum": lambda scene: scene.mapper.SetBlendModeToMaximumIntensity(),
            "shadows": lambda scene: scene.mapper.ShadowsOn(),
        }
        for name, change in settings.items():
            with self.subTest(name):
                scene, reference = detailed(), Scene(decimate())
                change(scene)
                change(reference)
                self.check_coarse(scene, reference, 0.01)

    def test_colors_of_an_array(self):
        heat = (numpy.linspace(0, 255, DIMENSIONS[2])[:, None, None] + 0 * SAMPLES).astype(numpy.float32)
        scenes = [detailed(), Scene(decimate())]
        for scene, values in zip(scenes, (heat, decimate(heat).samples)):
            set_scalars(scene.image.GetPointData(), values, "heat")
            scene.image.heat = values
            scene.image.GetPointData().SetActiveScalars("scalars")
            scene.mapper.SetColorArrayName("heat")
            colors = scene.volume.GetProperty().GetRGBTransferFunction()
            colors.RemoveAllPoints()
            colors.AddRGBPoint(0.0, 1.0, 0.0, 0.0)
            colors.AddRGBPoint(255.0, 0.0, 0.0, 1.0)
        self.check_coarse(*scenes)

    def test_blocks(self):
        origins = (0.0, 0.0, 0.0), (30.3, 20.2, 10.1)  # on lattices of their own
        blocks, grids = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
        for i, origin in enumerate(origins):
            blocks.SetBlock(i, make_image(origin=origin))
            grids.SetBlock(i, decimate(origin=origin))
        scene, reference = detailed(blocks).observe(), Scene(grids)
        self.check_coarse(scene, reference)
        self.assertEqual(scene.fractions, [0.25, 0.5, 0.75, 1.0])

    def test_both_eyes_see_the_same(self):
        scene = detailed()
        scene.renderer.GetActiveCamera().SetEyeAngle(0.0)
        scene.window.StereoRenderOn()
        scene.window.SetStereoTypeToInterlaced()
        self.check_same(scene.render_interactively(), Scene(decimate(slices=SLICES)).render())

    def test_coarse_pictures_are_not_accumulated(self):
        scene = detailed()
        scene.mapper.ProgressiveAccumulationOn()
        exact = scene.render()
        for _ in range(3):
            scene.render_interactively()
            self.assertEqual(scene.mapper.GetNumberOfAccumulatedFrames(), 0)
        numpy.testing.assert_array_equal(scene.render(), exact)
        self.assertEqual(scene.mapper.GetNumberOfAccumulatedFrames(), 1)

    def test_abort(self):
        expected = Scene(make_image()).render()
        scene = detailed().observe()
        scene.on_progress = lambda: scene.window.SetAbortRender(1)
        self.assertEqual(scene.render_interactively().max(), 0)
        scene.on_progress = lambda: None
        numpy.testing.assert_array_equal(scene.render(), expected)

    def test_file(self):
        """Most of it is not read for the first frames."""
        samples = make_samples((512, 512, 385))
        with tempfile.TemporaryDirectory() as folder:
            header = Path(folder) / "volume.mhd"
            samples.tofile(Path(folder) / "volume.raw")
            header.write_text("NDims = 3\nDimSize = 512 512 385\nElementSpacing = 0.5 0.5 0.6667\nElementType = MET_FLOAT\n"
                              "ElementDataFile = volume.raw\n", encoding="ascii")
            reader = vtkMappedImageReader()
            reader.SetFileName(str(header))
            reader.Update()
            scene = detailed(reader.GetOutput())
            before = read_mapped_memory()
            picture = scene.render_interactively()
            self.assertLess(read_mapped_memory() - before, samples.nbytes // 5)
            spacing = (0.5, 0.5, 0.6667)
            self.check_same(picture, Scene(decimate(samples, spacing, slices=SLICES, step=4)).render())
            numpy.testing.assert_array_equal(scene.render(), Scene(make_image(samples, spacing)).render())


if __name__ == "__main__":
    unittest.main()
