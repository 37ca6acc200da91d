#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""isosurface() of the Python package: data of every kind, isovalues, colours, cuts, and what cannot be drawn."""

import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkBitArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    VTK_TETRA,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPlane,
    vtkPolyData,
    vtkRectilinearGrid,
    vtkTable,
)
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the window
import vtkIsosurfaceRayTracing
from vtkIsosurfaceRayTracing import isosurface, render, vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper

from MeshTesting import ball, make_grid, make_structured_grid
from PackageTesting import BALL, SIZE, is_covered, make_ball
from PictureTesting import make_waves


def colors_of(volume, isovalues):
    function = volume.GetProperty().GetRGBTransferFunction()
    return [function.GetColor(isovalue) for isovalue in isovalues]


def opacities_of(volume, isovalues):
    return [volume.GetProperty().GetScalarOpacity().GetValue(isovalue) for isovalue in isovalues]


def isovalues_of(volume):
    values = volume.GetProperty().GetIsoSurfaceValues()
    return [values.GetValue(i) for i in range(values.GetNumberOfContours())]


def input_of(volume):
    return volume.GetMapper().GetInputDataObject(0, 0)


def make_blocks(*grids):
    blocks = vtkMultiBlockDataSet()
    for i, grid in enumerate(grids):
        blocks.SetBlock(i, grid)
    return blocks


def picture_of(*arguments, **options):
    return render(*arguments, size=SIZE, samples=1, **options).rgba


class TestData(unittest.TestCase):
    def test_tables_among_blocks_are_passed_over(self):
        image = input_of(isosurface(make_ball(), 0.0))
        expected = picture_of(make_blocks(image), 0.0)
        self.assertTrue(np.array_equal(picture_of(make_blocks(image, vtkTable()), 0.0), expected))

    def test_array_is_an_image(self):
        array = np.arange(2 * 3 * 4, dtype=np.int16).reshape(2, 3, 4)
        direction = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        image = input_of(isosurface(array, 7, spacing=(1, 2, 3), origin=(4, 5, 6), direction=direction))
        self.assertEqual(image.GetDimensions(), (2, 3, 4))
        self.assertEqual(image.GetSpacing(), (1.0, 2.0, 3.0))
        self.assertEqual(image.GetOrigin(), (4.0, 5.0, 6.0))
        self.assertEqual([[image.GetDirectionMatrix().GetElement(i, j) for j in range(3)] for i in range(3)], direction)
        for index in np.ndindex(array.shape):
            self.assertEqual(image.GetScalarComponentAsDouble(*index, 0), array[index])

    def test_array_is_shared_if_it_can_be(self):
        array = np.asfortranarray(make_ball())
        scalars = input_of(isosurface(array, 0.0)).GetPointData().GetScalars()
        self.assertTrue(np.shares_memory(vtk_to_numpy(scalars), array))
        # It is kept as long as the surface.
        volume = isosurface(make_ball().T, 0.0)
        self.assertEqual(input_of(volume).GetScalarRange(), isosurface(make_ball(), 0.0).GetMapper().GetInput().GetScalarRange())

    def test_types_of_values(self):
        array = np.round(100.0 * make_ball())
        expected = picture_of(array.astype(float), 10.0)
        for kind in (np.int8, np.int16, np.int32, np.int64, np.float16, np.float32, np.longdouble, ">i2", ">f8"):
            np.testing.assert_array_equal(picture_of(array.astype(kind), 10.0), expected, str(kind))
        np.testing.assert_array_equal(picture_of(array > 10.0, 0.5), picture_of((array > 10.0).astype(float), 0.5))

    def test_masked_samples_are_left_out(self):
        array = make_ball()
        masked = np.ma.masked_array(array, np.indices(array.shape)[0] < 12)
        half = is_covered(render(masked, 0.0, size=SIZE, view="y")).sum()
        self.assertLess(half, 0.8 * is_covered(render(array, 0.0, size=SIZE, view="y")).sum() + 1)
        self.assertTrue(np.isnan(vtk_to_numpy(input_of(isosurface(masked, 0.0)).GetPointData().GetScalars())).any())

    def test_what_has_array(self):
        class Tensor:
            def __array__(self, dtype=None, copy=None):
                return make_ball()

        np.testing.assert_array_equal(picture_of(Tensor(), 0.0), picture_of(make_ball(), 0.0))

    def test_data_of_vtk_are_drawn_as_they_are(self):
        image = make_waves()
        self.assertIs(input_of(isosurface(image, 150)), image)
        grid = vtkRectilinearGrid()
        grid.SetDimensions(*image.GetDimensions())
        for axis, put in enumerate((grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)):
            low = image.GetBounds()[2 * axis]
            put(numpy_to_vtk(low + np.arange(image.GetDimensions()[axis]), deep=True))
        grid.GetPointData().SetScalars(image.GetPointData().GetScalars())
        for data in (grid, make_blocks(None, image)):
            self.assertIsInstance(isosurface(data, 150).GetMapper(), vtkIsosurfaceRayTraceMapper)
            self.assertTrue(isosurface(data, 150).GetMapper().GetLevelOfDetail())
            np.testing.assert_array_equal(picture_of(data, 150), picture_of(image, 150))
        for mesh in (make_grid(VTK_TETRA, ball), make_structured_grid(ball)):
            self.assertIsInstance(isosurface(mesh, 0.5).GetMapper(), vtkIsosurfaceRayTraceMeshMapper)
            self.assertTrue(picture_of(mesh, 0.5).any())

    def test_scalars_by_name(self):
        array = make_ball()
        image = vtkImageData()
        image.SetDimensions(array.shape)
        for name, values in (("ball", array), ("twice", 2.0 * array)):
            values = numpy_to_vtk(values.ravel(order="F"), deep=True)
            values.SetName(name)
            image.GetPointData().AddArray(values)
        cells = numpy_to_vtk(array[1:, 1:, 1:].ravel(order="F"), deep=True)
        cells.SetName("cells")
        image.GetCellData().AddArray(cells)
        np.testing.assert_array_equal(picture_of(image, 0.4, scalars="twice"), picture_of(image, 0.2, scalars="ball"))
        self.assertTrue(picture_of(image, 0.2, scalars="cells").any())
        with self.assertRaisesRegex(ValueError, "no active scalars: give scalars=, one of 'ball', 'cells', 'twice'"):
            isosurface(image, 0.2)
        with self.assertRaisesRegex(ValueError, "no array 'bal': give one of 'ball', 'cells', 'twice'$"):
            isosurface(image, 0.2, scalars="bal")
        names = vtkStringArray()
        names.SetName("names")
        names.SetNumberOfValues(array.size)
        image.GetPointData().AddArray(names)
        for options in ({"scalars": "names"}, {"scalars": "ball", "color_by": "names"}):
            with self.assertRaisesRegex(
                    ValueError, "'names' has no numbers, .* vtkStringArray: give one of 'ball', 'cells', 'twice'$"):
                isosurface(image, 0.2, **options)
        for name in ("twice", "ball"):
            image.GetPointData().RemoveArray(name)
        self.assertTrue(picture_of(image, 0.2).any())  # the only array
        image.AllocateCellGhostArray()  # of cells of other pieces, which is none to be drawn
        self.assertTrue(picture_of(image, 0.2).any())
        image.GetCellData().RemoveArray("cells")
        with self.assertRaisesRegex(ValueError, "they have no arrays of numbers"):
            isosurface(image, 0.2)

    def test_names_that_are_not_utf_8(self):
        image = input_of(isosurface(make_ball(), 0.0))
        expected = picture_of(image, 0.2)
        image.GetPointData().GetScalars().SetName("größe".encode("latin-1"))
        other = image.GetPointData().GetScalars().NewInstance()
        other.DeepCopy(image.GetPointData().GetScalars())
        other.SetName("other")
        image.GetPointData().AddArray(other)
        np.testing.assert_array_equal(picture_of(image, 0.2, scalars="gr\udcf6\udcdfe"), expected)
        colored = picture_of(image, 0.2, scalars="other", color_by="gr\udcf6\udcdfe")
        np.testing.assert_array_equal(colored, picture_of(image, 0.2, scalars="other", color_by="other"))
        with self.assertRaisesRegex(ValueError, r"no array 'size': give one of 'gr\\udcf6\\udcdfe', 'other'$"):
            isosurface(image, 0.2, scalars="size")

    def test_other_data_are_drawn_by_the_same_array(self):
        """Whichever is active in them."""
        first, second = make_grid(VTK_TETRA, ball), make_grid(VTK_TETRA, lambda point: ball(point) - 0.1)
        for mesh in (first, second):
            mesh.GetPointData().GetArray(0).SetName("speed")
            other = mesh.GetPointData().GetArray(0).NewInstance()
            other.SetName("other")
            other.SetNumberOfValues(mesh.GetNumberOfPoints())
            other.Fill(7.0)
            mesh.GetPointData().SetScalars(other)
        volume = isosurface(first, 0.5, scalars="speed")
        volume.GetMapper().SetInputDataObject(second)
        expected = render(second, 0.5, scalars="speed", size=SIZE).rgba
        np.testing.assert_array_equal(render(volume, size=SIZE).rgba, expected)
        # Beside others of that name, and of none.
        first.GetPointData().SetActiveScalars("speed")
        for other in (isosurface(second, 0.5, scalars="speed"), isosurface(first, 0.5, scalars="speed")):
            self.assertTrue(render([volume, other], size=SIZE).rgba.any())
        still = isosurface(make_ball(), 0.0)
        still.SetPosition(100.0, 0.0, 0.0)
        with self.assertRaisesRegex(ValueError, "make the arrays active"):
            render([volume, still], size=SIZE)  # that of a numpy array has another name

    def test_blocks_with_another_kind_of_array_are_left_out(self):
        """As those without the array, but this one is there."""
        of_points, of_cells = make_waves(), make_waves()
        of_points.GetPointData().GetScalars().SetName("waves")
        of_cells.GetPointData().Initialize()
        cells = numpy_to_vtk(np.linspace(0.0, 300.0, of_cells.GetNumberOfCells()), deep=True)
        cells.SetName("waves")
        of_cells.GetCellData().SetScalars(cells)
        expected = picture_of(of_points, 150)
        for blocks in (make_blocks(of_points, of_cells), make_blocks(of_cells, of_points)):
            with self.assertWarnsRegex(RuntimeWarning, "'waves' is an array of cells, .* by vtkCellDataToPointData"):
                np.testing.assert_array_equal(picture_of(blocks, 150, scalars="waves"), expected)

    def test_blocks_in_which_the_array_is_not_active(self):
        first, second = make_waves(), make_waves()
        second.SetOrigin(50.0, 0.0, 0.0)
        expected = picture_of(make_blocks(first, second), 150)
        second.GetPointData().SetActiveScalars(None)
        np.testing.assert_array_equal(picture_of(make_blocks(first, second), 150), expected)
        np.testing.assert_array_equal(picture_of(make_blocks(second, first), 150), expected)

    def test_vectors_by_their_length(self):
        array = make_ball() + 1.0
        image = vtkImageData()
        image.SetDimensions(array.shape)
        image.GetPointData().SetScalars(numpy_to_vtk(
            np.stack([0.6 * array.ravel(order="F"), np.zeros(array.size), 0.8 * array.ravel(order="F")], axis=1), deep=True))
        covered = is_covered(render(image, 1.0, size=SIZE))
        expected = is_covered(render(array, 1.0, size=SIZE))
        self.assertLess((covered != expected).mean(), 0.001)
        self.assertAlmostEqual(isovalues_of(isosurface(image))[0], isovalues_of(isosurface(array))[0], 1)


class TestIsovalues(unittest.TestCase):
    def test_numbers(self):
        self.assertEqual(isovalues_of(isosurface(make_waves(), 150)), [150.0])
        self.assertEqual(isovalues_of(isosurface(make_waves(), (200, 100.5))), [200.0, 100.5])
        self.assertEqual(isovalues_of(isosurface(make_waves(), np.array([100, 120]))), [100.0, 120.0])

    def test_auto_is_between_two_classes(self):
        array = np.full((20, 20, 20), -1000, np.int16)
        array[5:15, 5:15, 5:15] = 200
        (threshold,) = isovalues_of(isosurface(array))
        self.assertAlmostEqual(threshold, -400.0, delta=10.0)  # in the middle
        noise = np.random.default_rng(1).normal(0.0, 30.0, array.shape)
        (threshold,) = isovalues_of(isosurface(array + noise, "auto"))
        self.assertTrue(-850.0 < threshold < 50.0, threshold)
        noise[0, 0] = np.nan
        noise[0, 1] = np.inf
        (again,) = isovalues_of(isosurface(array + noise))
        self.assertAlmostEqual(again, threshold, delta=60.0)

    def test_auto_of_bits(self):
        bits, image = vtkBitArray(), vtkImageData()
        bits.SetNumberOfTuples(1000)
        for i in range(1000):
            bits.SetValue(i, i % 10 > 4)
        image.SetDimensions(10, 10, 10)
        image.GetPointData().SetScalars(bits)
        (threshold,) = isovalues_of(isosurface(image, clip="y"))
        self.assertTrue(0.0 < threshold < 1.0, threshold)

    def test_auto_of_meshes(self):
        (threshold,) = isovalues_of(isosurface(make_grid(VTK_TETRA, ball)))
        self.assertTrue(-3.0 < threshold < 2.0, threshold)


class TestLook(unittest.TestCase):
    def test_defaults(self):
        volume = isosurface(make_waves(), 150)
        surface, mapper = volume.GetProperty(), volume.GetMapper()
        self.assertTrue(surface.GetShade())
        self.assertTrue(mapper.GetProgressiveAccumulation())
        self.assertEqual(mapper.GetMaximumNumberOfAccumulatedFrames(), 8)
        self.assertFalse(mapper.GetShadows() or mapper.GetAmbientOcclusion() or mapper.GetCapClippingPlanes())
        self.assertEqual(surface.GetRGBTransferFunction().GetSize(), 1)
        self.assertEqual(opacities_of(volume, [150]), [1.0])

    def test_colors(self):
        pink = (1.0, 192 / 255, 203 / 255)
        for color in ("pink", "Pink", "#ffc0cb", pink, list(pink), np.array(pink)):
            np.testing.assert_allclose(colors_of(isosurface(make_waves(), 150, color=color), [150]), [pink])
        two = isosurface(make_waves(), [100, 200], color=["red", (0, 0, 1)])
        self.assertEqual(colors_of(two, [100, 200]), [(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
        same = isosurface(make_waves(), [100, 200, 220], color="red")
        self.assertEqual(colors_of(same, [100, 200, 220]), [(1.0, 0.0, 0.0)] * 3)
        several = colors_of(isosurface(make_waves(), [200, 100, 150]), [100, 150, 200])
        self.assertEqual(len(set(several)), 3)
        self.assertEqual(several, colors_of(isosurface(make_waves(), [100, 150, 200]), [100, 150, 200]))

    def test_opacities(self):
        self.assertEqual(opacities_of(isosurface(make_waves(), [200, 100]), [100, 200]), [0.35, 1.0])
        self.assertEqual(opacities_of(isosurface(make_waves(), [200, 100], opacity=0.5), [100, 200]), [0.5, 0.5])
        self.assertEqual(opacities_of(isosurface(make_waves(), [200, 100], opacity=(1, 0)), [100, 200]), [0.0, 1.0])

    def test_switches(self):
        mapper = isosurface(make_waves(), 150, shadows=True, occlusion=True, interpolation="cubic", samples=1).GetMapper()
        self.assertTrue(mapper.GetShadows() and mapper.GetAmbientOcclusion())
        self.assertEqual(mapper.GetInterpolationMode(), vtkIsosurfaceRayTraceMapper.CUBIC)
        self.assertFalse(mapper.GetProgressiveAccumulation())
        self.assertAlmostEqual(mapper.GetAmbientOcclusionRadius(), 0.25 * make_waves().GetLength())
        plain = picture_of(make_waves(), 150)
        for option in ({"shadows": True}, {"occlusion": True}, {"interpolation": "nearest"}):
            self.assertGreater(np.abs(picture_of(make_waves(), 150, **option).astype(int) - plain).max(), 30, option)

    def test_interpolation_of_images_beside_meshes(self):
        blocks = make_blocks(make_waves(), make_grid(VTK_TETRA, ball))
        mapper = isosurface(blocks, 150, interpolation="cubic").GetMapper()
        self.assertEqual(mapper.GetInterpolationMode(), vtkIsosurfaceRayTraceMapper.CUBIC)


class TestColorBy(unittest.TestCase):
    def check(self, volume, expected):
        """The mean colour of the left and the right half, seen from the side of -y."""
        picture = render(volume, size=SIZE, view="-y")
        halves = (picture.rgba[:, :60], picture.rgba[:, 60:])
        for half, channel in zip(halves, expected):
            mean = half[half[:, :, 3] == 255].mean(axis=0)
            self.assertEqual(int(np.argmax(mean[:3])), channel, mean)

    def test_array(self):
        array = make_ball()
        x = np.indices(array.shape)[0]
        options = {"color_by": x, "cmap": ["blue", "red"]}
        self.check(isosurface(array, 0.0, **options), (2, 0))
        self.check(isosurface(array, 0.0, **options, clim=(100, 200)), (2, 2))
        cells = x[1:, 1:, 1:]
        self.check(isosurface(array, 0.0, color_by=cells, cmap=["blue", "red"]), (2, 0))
        for flat in (x.ravel(order="F"), cells.ravel(order="F")):  # as those of PyVista
            self.check(isosurface(array, 0.0, color_by=flat, cmap=["blue", "red"]), (2, 0))

    def test_masked_array(self):
        """What is masked has the colour of NaN, and no part in the limits."""
        x = np.indices((24, 24, 24))[0]
        masked = np.ma.masked_array(np.where(x > 12, -999, x), x > 12)
        expected = picture_of(make_ball(), 0.0, color_by=np.where(x > 12, np.nan, x))
        np.testing.assert_array_equal(picture_of(make_ball(), 0.0, color_by=masked), expected)

    def test_colors(self):
        array = make_ball()
        colors = np.zeros((*array.shape, 3), np.uint8)
        colors[:12, :, :, 1] = 255
        colors[12:, :, :, 2] = 255
        self.check(isosurface(array, 0.0, color_by=colors), (1, 2))

    def test_image_of_another_resolution(self):
        colors = vtkImageData()
        colors.SetDimensions(2, 2, 2)
        colors.SetSpacing(23.0, 23.0, 23.0)
        colors.GetPointData().SetScalars(numpy_to_vtk(np.array([0.0, 1.0] * 4), deep=True))
        self.check(isosurface(make_ball(), 0.0, color_by=colors, cmap=["blue", "red"]), (2, 0))

    def test_vectors_by_their_length(self):
        """The first components say nothing."""
        mesh, image = make_grid(VTK_TETRA, ball), make_waves()
        for data, isovalue in ((mesh, 0.5), (image, 150)):
            points = np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])
            x = points[:, 0] - data.GetBounds()[0]
            vectors = numpy_to_vtk(np.stack([0.0 * x, 0.6 * x, 0.8 * x], axis=1), deep=True)
            vectors.SetName("vectors")
            data.GetPointData().AddArray(vectors)
            self.check(isosurface(data, isovalue, color_by="vectors", cmap=["blue", "red"]), (2, 0))
        colors = vtkImageData()
        colors.ShallowCopy(image)
        colors.GetPointData().SetActiveScalars("vectors")
        self.check(isosurface(image, 150, color_by=colors, cmap=["blue", "red"]), (2, 0))

    def test_array_of_a_mesh(self):
        mesh = make_grid(VTK_TETRA, ball)
        x = vtk_to_numpy(mesh.GetPoints().GetData())[:, 0]
        self.check(isosurface(mesh, 0.5, color_by=x, cmap=["blue", "red"]), (2, 0))
        named = numpy_to_vtk(x.astype(float), deep=True)
        named.SetName("x")
        mesh.GetPointData().AddArray(named)
        self.check(isosurface(mesh, 0.5, color_by="x", cmap=["blue", "red"]), (2, 0))
        self.assertFalse(mesh.GetPointData().HasArray("colors of isosurfaces"))

    def test_maps(self):
        for cmap in ("viridis", "coolwarm", "gray", "inferno", lambda parts: np.stack([parts, parts, parts], axis=1)):
            self.assertTrue(picture_of(make_ball(), 0.0, color_by=make_ball(), cmap=cmap).any())
        rows = picture_of(make_ball(), 0.0, color_by=make_ball(), cmap=np.eye(3)[[2, 0]])
        np.testing.assert_array_equal(rows, picture_of(make_ball(), 0.0, color_by=make_ball(), cmap=["blue", "red"]))

    def test_map_of_matplotlib(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not installed")
        expected = picture_of(make_ball(), 0.0, color_by=np.indices((24, 24, 24))[0], cmap=matplotlib.colormaps["magma"])
        np.testing.assert_array_equal(
            picture_of(make_ball(), 0.0, color_by=np.indices((24, 24, 24))[0], cmap="magma"), expected)


class TestClip(unittest.TestCase):
    def planes_of(self, clip):
        planes = isosurface(make_ball(), 0.0, **BALL, clip=clip).GetMapper().GetClippingPlanes()
        return [(planes.GetItem(i).GetOrigin(), planes.GetItem(i).GetNormal()) for i in range(planes.GetNumberOfItems())]

    def test_planes(self):
        plane = vtkPlane()
        plane.SetOrigin(1.0, 2.0, 3.0)
        given = ((1.0, 2.0, 3.0), (0.0, 0.0, 1.0))
        for clip, expected in (
            ("-x", [((0, 0, 0), (-1, 0, 0))]),
            ((0, 2, 0), [((0, 0, 0), (0, 1, 0))]),
            (np.array([0, 2, 0]), [((0, 0, 0), (0, 1, 0))]),
            ([0, 2, 0], [((0, 0, 0), (0, 1, 0))]),
            ([[0, 2, 0], "x"], [((0, 0, 0), (0, 1, 0)), ((0, 0, 0), (1, 0, 0))]),
            (((1, 2, 3), "z"), [given]),
            (plane, [given]),
            (["x", ((1, 2, 3), (0, 0, 5)), plane], [((0, 0, 0), (1, 0, 0)), given, given]),
        ):
            np.testing.assert_allclose(self.planes_of(clip), expected, atol=1e-6)

    def test_the_normal_points_to_what_is_kept(self):
        hits = vtkIsosurfaceRayTracing.cast_rays(
            isosurface(make_ball(), 0.0, **BALL, clip="x", caps=False, opacity=0.5), [-2, 0.01, 0.02], [1, 0, 0])
        np.testing.assert_allclose(hits.points[:, 0], [0.7], atol=0.01)

    def test_caps_show_the_data_but_surfaces_keep_their_colors(self):
        volume = isosurface(make_ball(), [0.0, 0.3], **BALL, color=["red", "blue"], clip="x")
        self.assertTrue(volume.GetMapper().GetCapClippingPlanes())
        np.testing.assert_allclose(colors_of(volume, [0.0, 0.3]), [(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)], atol=1e-12)
        dark, light = colors_of(volume, [0.1, 0.6])
        self.assertAlmostEqual(dark[0], dark[2])  # gray
        self.assertLess(dark[0], light[0])
        window = isosurface(make_ball(), 0.0, **BALL, clip="x", caps=["black", "white"], clim=(0.2, 0.4))
        self.assertEqual([rgb[0] for rgb in colors_of(window, [0.1, 0.2, 0.4, 0.6])], [0.0, 0.0, 1.0, 1.0])
        for no in (False, np.False_, None):
            self.assertFalse(isosurface(make_ball(), 0.0, clip="x", caps=no).GetMapper().GetCapClippingPlanes())
        for yes in (True, np.True_):
            plain = isosurface(make_ball(), 0.0, color="red", clip="x", caps=yes)
            self.assertTrue(plain.GetMapper().GetCapClippingPlanes())
            self.assertEqual(colors_of(plain, [0.5]), [(1.0, 0.0, 0.0)])


class ImageDataOfPyVista(vtkImageData):
    """PyVista's grids are classes of Python that are derived from VTK's."""


class PlotterOfPyVista:
    """Calls of an actor what add_actor of PyVista's plotter calls, as its source says."""

    def __init__(self):
        self.renderer = vtkRenderer()
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetSize(SIZE)
        self.window.AddRenderer(self.renderer)

    def add_actor(self, actor):
        actor.name = f"{type(actor).__name__}({actor.GetAddressAsString('')})"
        actor.SetPickable(True)
        actor.SetScale(np.array(actor.GetScale()) * np.array((1.0, 1.0, 1.0)))
        self.renderer.AddActor(actor)
        self.renderer.ResetCamera(*actor.GetBounds())
        return actor, actor.GetProperty()


class TestPyVista(unittest.TestCase):
    def test_grids(self):
        image = ImageDataOfPyVista()
        image.ShallowCopy(make_waves())
        np.testing.assert_array_equal(picture_of(image, 150), picture_of(make_waves(), 150))
        self.assertTrue(picture_of(image, 150, color_by=np.arange(41**3).reshape(41, 41, 41)).any())

    def test_plotter(self):
        plotter = PlotterOfPyVista()
        plotter.add_actor(isosurface(make_waves(), 150, color="red"))
        plotter.window.Render()
        red, green, _ = plotter.window.GetPixelData(SIZE[0] // 2, SIZE[1] // 2, SIZE[0] // 2, SIZE[1] // 2, 0, 0)[:3]
        self.assertGreater(red, 2 * green)


BAD = (
    (TypeError, "vtkPolyData: give a numpy array", (vtkPolyData(),), {}),
    (TypeError, "in a list: give a numpy array", ([[[1, 2], [3, 4]]],), {}),
    (TypeError, "in a NoneType", (None,), {}),
    (ValueError, r"shape of this array is \(3, 4\)", (np.ones((3, 4)),), {}),
    (ValueError, r"shape of this array is \(3, 1, 4\)", (np.ones((3, 1, 4)),), {}),
    (TypeError, "complex128; give real numbers", (np.ones((3, 3, 3), complex),), {}),
    (TypeError, "object; give real numbers", (np.full((3, 3, 3), None),), {}),
    (ValueError, "no spacing may be 0", (make_ball(),), {"spacing": (1, 0, 1)}),
    (ValueError, "spacing is", (make_ball(),), {"spacing": (1, 2)}),
    (ValueError, "origin is", (make_ball(),), {"origin": (1, 2, np.nan)}),
    (ValueError, r"direction is .* shape \(3, 3\)", (make_ball(),), {"direction": (1, 0, 0)}),
    (TypeError, "those of numpy arrays", (make_waves(),), {"spacing": 2.0}),
    (TypeError, "those of numpy arrays", (make_waves(),), {"direction": np.eye(3)}),
    (ValueError, "spacing is 'x'; give finite numbers", (make_ball(),), {"spacing": "x"}),
    (TypeError, "scalars is 3; give the name", (make_waves(),), {"scalars": 3}),
    (ValueError, "isovalues is {}; give a finite number", (make_waves(), {}), {}),
    (ValueError, "opacity is 'x'; give a number", (make_waves(), 150), {"opacity": "x"}),
    (ValueError, "interpolation is .*; give one of", (make_waves(), 150), {"interpolation": []}),
    (ValueError, "no colour map 7; give one of gray", (make_waves(), 150), {"clip": "x", "caps": 7}),
    (ValueError, "no colour map", (make_waves(), 150), {"clip": "x", "caps": lambda parts: parts}),
    (FileNotFoundError, "there is no file absent.vti", ("absent.vti",), {}),
    (ValueError, "no surface at 500: the scalars are from 34.0153 to 286.341", (make_waves(), 500), {}),
    (ValueError, "all values are NaN", (np.full((3, 3, 3), np.nan), 1.0), {}),
    (ValueError, "no two different values", (np.ones((3, 3, 3)),), {}),
    (ValueError, r"give one volume of it, as array\[..., 0\]", (np.ones((3, 3, 3, 2)), 0.5), {}),
    (ValueError, "give numbers or 'auto'", (make_waves(), "otsu"), {}),
    (ValueError, "give a finite number", (make_waves(), np.nan), {}),
    (ValueError, "give a finite number", (make_waves(), []), {}),
    (ValueError, "give each once", (make_waves(), [150, 150]), {}),
    (ValueError, "'pinkish' is no colour", (make_waves(), 150), {"color": "pinkish"}),
    (ValueError, "is no colour", (make_waves(), 150), {"color": (255, 0, 0)}),
    (ValueError, "is no colour", (make_waves(), 150), {"color": 7}),
    (ValueError, "3 colours for 2 isovalues", (make_waves(), [150, 160]), {"color": ["red", "blue", "green"]}),
    (ValueError, "number from 0 to 1", (make_waves(), 150), {"opacity": 2}),
    (ValueError, "number from 0 to 1", (make_waves(), 150), {"opacity": np.nan}),
    (ValueError, "each of the 2 isovalues", (make_waves(), [150, 160]), {"opacity": [1, 1, 1]}),
    (ValueError, "no array 'absent'", (make_waves(), 150), {"color_by": "absent"}),
    (ValueError, r"shape of color_by is \(2, 2\)", (make_waves(), 150), {"color_by": np.ones((2, 2))}),
    (ValueError, "some are masked; give them a colour", (make_ball(), 0.0),
     {"color_by": np.ma.masked_less(np.indices((24, 24, 24)).T.astype(np.uint8), 5)}),
    (ValueError, "cannot colour the surfaces of a mesh", (make_grid(VTK_TETRA, ball), 0.5), {"color_by": make_waves()}),
    (ValueError, "cannot colour composite data", (make_blocks(make_waves()), 150), {"color_by": np.ones(5)}),
    (ValueError, "no colour map 'rainbows'", (make_ball(), 0.0), {"color_by": make_ball(), "cmap": "rainbows"}),
    (ValueError, "clim is", (make_ball(), 0.0), {"color_by": make_ball(), "clim": (1, 1)}),
    (ValueError, "cmap is for color_by; give that, too", (make_ball(), 0.0), {"cmap": "gray"}),
    (ValueError, "caps are on the cuts of clip; give that, too", (make_ball(), 0.0), {"caps": True}),
    (ValueError, "caps are on the cuts of clip; give that, too", (make_ball(), 0.0), {"caps": "inferno"}),
    (ValueError, "with color_by, cuts have the colours of cmap", (make_ball(), 0.0),
     {"clip": "x", "caps": "inferno", "color_by": make_ball()}),
    (ValueError, "clim is for color_by, or for the data on the cuts", (make_ball(), 0.0), {"clim": (0, 1)}),
    (ValueError, "clim is for color_by, or for the data on the cuts", (make_ball(), 0.0),
     {"clip": "x", "caps": True, "clim": (0, 1)}),
    (ValueError, "clim is", (make_ball(), 0.0), {"clip": "x", "clim": (1, 0)}),
    (ValueError, "the normal of clip is 'w'", (make_waves(), 150), {"clip": "w"}),
    (ValueError, "the normal of clip is", (make_waves(), 150), {"clip": (0, 0, 0)}),
    (ValueError, "clip is", (make_waves(), 150), {"clip": ("x", "y")}),
    (ValueError, "clip is", (make_waves(), 150), {"clip": ((0, 0, np.nan), "y")}),
    (ValueError, "the normal of clip is 3", (make_waves(), 150), {"clip": [3, 4]}),
    (ValueError, "interpolation is 'smooth'", (make_waves(), 150), {"interpolation": "smooth"}),
    (ValueError, "leave interpolation out", (make_grid(VTK_TETRA, ball), 0.5), {"interpolation": "cubic"}),
    (ValueError, "leave interpolation out", (make_blocks(make_grid(VTK_TETRA, ball)), 0.5), {"interpolation": "nearest"}),
    (ValueError, "samples is 0", (make_waves(), 150), {"samples": 0}),
    (ValueError, "samples is 1.5", (make_waves(), 150), {"samples": 1.5}),
    (TypeError, "unexpected keyword argument 'colour'", (make_waves(), 150), {"colour": "red"}),
)  # fmt: skip


class TestBadInput(unittest.TestCase):
    def test_bad_input_says_what_to_give(self):
        for kind, message, arguments, options in BAD:
            with self.subTest(message), self.assertRaisesRegex(kind, message):
                isosurface(*arguments, **options)

    def test_good_input_warns_of_nothing(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            render(make_ball(), [0.0, 0.2], size=SIZE, clip="x", shadows=True, occlusion=True)


class TestPackage(unittest.TestCase):
    def test_names(self):
        for name in ("Hits", "Picture", "cast_rays", "isosurface", "read", "render", "show", "vtkIsosurfacePicker"):
            self.assertIn(name, dir(vtkIsosurfaceRayTracing))
            self.assertIn(name, vtkIsosurfaceRayTracing.__all__)
            self.assertTrue(getattr(vtkIsosurfaceRayTracing, name).__doc__, name)
        self.assertRegex(vtkIsosurfaceRayTracing.__version__, r"^\d+\.\d+\.\d+$")
        with self.assertRaisesRegex(AttributeError, "no attribute 'isosurfaces'"):
            vtkIsosurfaceRayTracing.isosurfaces
        self.assertIsInstance(isosurface(make_waves(), 150), vtkVolume)


if __name__ == "__main__":
    unittest.main()
