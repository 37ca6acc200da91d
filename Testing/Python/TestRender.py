#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""render() of the Python package: the bits of the mapper, cameras, several surfaces, files, no display."""

import copy
import os
import pickle
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import vtkCamera, vtkLight, vtkLightCollection, vtkVolume
from vtkIsosurfaceRayTracing import (
    Picture,
    cast_rays,
    isosurface,
    render,
    vtkCellProjectionMapper,
    vtkIsosurfaceRayTraceMapper,
    vtkIsosurfaceRayTraceMeshMapper,
)

from MeshTesting import ball, make_grid
from PackageTesting import BALL, SIZE, colors_of, draw, is_covered, make_ball
from PictureTesting import make_waves

VIEW = (-0.45, 1.0, 0.3)


def camera_of(view=VIEW):
    """As near as another that shows all of make_ball()."""
    camera = vtkCamera()
    camera.SetPosition(np.array(view) * 4.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    return camera


def margins_of(picture):
    """The part of the picture that is empty at the left, right, top and bottom."""
    rows, columns = (np.flatnonzero(is_covered(picture).any(axis=axis)) for axis in (1, 0))
    width, height = picture.size
    return np.array([columns[0] / width, 1.0 - (columns[-1] + 1) / width, rows[0] / height, 1.0 - (rows[-1] + 1) / height])


class TestBits(unittest.TestCase):
    """What the package draws is what the class draws with the same settings."""

    def make_lights(self):
        """Those of the package, written out."""
        lights = vtkLightCollection()
        for (azimuth, elevation), color in (
                ((-30, 45), (1.00, 0.97, 0.92)), ((45, -25), (0.27, 0.29, 0.32)),
                ((115, 10), (0.28, 0.28, 0.28)), ((-115, 0), (0.28, 0.28, 0.28))):  # fmt: skip
            across, above = np.radians([azimuth, elevation])
            light = vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(np.sin(across) * np.cos(above), np.sin(above), np.cos(across) * np.cos(above))
            light.SetColor(color)
            lights.AddItem(light)
        return lights

    def make_volume(self, mapper, data, isovalue, color, opacity):
        mapper.SetInputDataObject(data)
        mapper.ProgressiveAccumulationOn()
        mapper.SetMaximumNumberOfAccumulatedFrames(8)
        volume = vtkVolume()
        volume.SetMapper(mapper)
        surface = volume.GetProperty()
        surface.ShadeOn()
        surface.SetAmbient(0.3 if mapper.GetShadows() else 0.15)
        surface.SetDiffuse(0.85 if mapper.GetShadows() else 0.95)
        surface.SetSpecular(0.15)
        surface.SetSpecularPower(25.0)
        surface.GetIsoSurfaceValues().SetValue(0, isovalue)
        surface.GetRGBTransferFunction().RemoveAllPoints()
        surface.GetRGBTransferFunction().AddRGBPoint(isovalue, *color)
        surface.GetScalarOpacity().RemoveAllPoints()
        surface.GetScalarOpacity().AddPoint(isovalue, opacity)
        return volume

    def check(self, mapper, data, isovalue, **options):
        volume = self.make_volume(mapper, data, isovalue, (1.0, 0.0, 0.0), options.get("opacity", 1.0))
        camera = vtkCamera()
        camera.SetFocalPoint(*np.reshape(data.GetBounds(), (3, 2)).mean(axis=1))
        camera.SetPosition(*(np.array(camera.GetFocalPoint()) + 2.0 * data.GetLength() * np.array(VIEW)))
        camera.SetViewUp(0.0, 0.0, 1.0)
        camera.SetClippingRange(0.01 * data.GetLength(), 5.0 * data.GetLength())
        picture = render(data, isovalue, color="red", camera=camera, size=SIZE, **options)
        # The clipping range changes the last bits of rays: that of the package is taken.
        from vtkIsosurfaceRayTracing._camera import set_clipping_range

        set_clipping_range(camera, volume)
        expected = draw(mapper, volume, camera, self.make_lights())
        self.assertGreater(is_covered(picture).sum(), 300)
        np.testing.assert_array_equal(colors_of(picture.image), expected)

    def test_images(self):
        self.check(vtkIsosurfaceRayTraceMapper(), make_waves(), 150.0)
        self.check(vtkIsosurfaceRayTraceMapper(), make_waves(), 150.0, opacity=0.4)

    def test_meshes(self):
        self.check(vtkIsosurfaceRayTraceMeshMapper(), make_grid(VTK_TETRA, ball), 0.5)

    def test_settings(self):
        mapper = vtkIsosurfaceRayTraceMapper()
        mapper.ShadowsOn()
        mapper.SetInterpolationModeToCubic()
        self.check(mapper, make_waves(), 150.0, shadows=True, interpolation="cubic")

    def test_twice(self):
        volume = isosurface(make_waves(), 150)
        np.testing.assert_array_equal(render(volume, size=SIZE).rgba, render(volume, size=SIZE).rgba)


class TestCamera(unittest.TestCase):
    def check(self, picture):
        """Two sides are at the margin, and the surface is in the middle."""
        left, right, top, bottom = margins_of(picture)
        pixel = 2.5 / min(picture.size)
        self.assertLess(abs(left - right), 2.0 * pixel)
        self.assertLess(abs(top - bottom), 2.0 * pixel)
        self.assertAlmostEqual(min(left, top), 0.06, delta=pixel)

    def test_surfaces_fill_the_picture(self):
        for view in ("x", "-y", "z", "-z", VIEW, (1, 1, 1)):
            for size in ((120, 90), (90, 120), (200, 60), (40, 1000)):
                with self.subTest(view=view, size=size):
                    self.check(render(make_waves(), 200, size=size, view=view))

    def test_small_surface_far_from_the_middle(self):
        array = np.zeros((60, 60, 60), np.float32)
        array[50:54, 5:8, 30:34] = 1.0
        self.check(render(array, 0.5, size=SIZE))
        self.check(render(array, 0.5, size=SIZE, spacing=1e-9, origin=(1.0, 0.0, 0.0)))
        self.check(render(array, 0.5, size=SIZE, spacing=1e9))

    def test_small_parts_that_lie_apart(self):
        values = np.zeros((200, 200, 200), np.uint8)
        index = np.indices((48, 48, 48)) - 24
        values[20:68, 20:68, 20:68] = (index**2).sum(axis=0) < 400
        values[153:155, 161:163, 174:176] = 1
        picture = render(values, 0.5, size=SIZE, samples=1)
        self.assertGreater(np.nanmax(picture.array("Position")[..., 0]), 150.0)

    def test_what_is_cut_off_does_not_count(self):
        self.check(render(make_ball(), 0.0, size=SIZE, clip=((8, 12, 12), "-x"), view="y"))
        self.check(render(make_grid(VTK_TETRA, ball), 0.5, size=SIZE, clip="z"))

    def test_moved_volume(self):
        volume = isosurface(make_ball(), 0.0, **BALL)
        volume.SetPosition(100.0, -50.0, 3.0)
        volume.SetScale(1.0, 2.0, 3.0)
        self.check(render(volume, size=SIZE))

    def test_zoom(self):
        near = margins_of(render(make_ball(), 0.0, size=SIZE, zoom=0.5))
        self.assertAlmostEqual(near[2], 0.5 - 0.25 * 0.88, delta=0.03)
        self.assertTrue(is_covered(render(make_ball(), 0.0, size=SIZE, zoom=9.0)).all())

    def test_up(self):
        cone = make_ball() + np.linspace(0.5, -0.5, 24)  # wider at low z
        upright = is_covered(render(cone, 0.0, size=SIZE, view="y"))
        turned = is_covered(render(cone, 0.0, size=SIZE, view="y", up="-z"))
        self.assertLess((upright != turned[::-1, ::-1]).mean(), 0.01)
        self.assertGreater((upright != turned).mean(), 0.05)

    def test_own_camera(self):
        camera = camera_of()
        camera.SetClippingRange(0.1, 0.2)
        picture = render(make_ball(), 0.0, **BALL, size=SIZE, camera=camera)
        self.assertEqual(camera.GetClippingRange(), (0.1, 0.2))
        self.assertGreater(is_covered(picture).mean(), 0.1)

    def test_camera_that_looks_elsewhere(self):
        camera = camera_of()
        camera.SetFocalPoint(100.0, 100.0, 0.0)
        with self.assertWarnsRegex(RuntimeWarning, "The camera sees nothing"):
            self.assertFalse(is_covered(render(make_ball(), 0.0, **BALL, size=SIZE, camera=camera)).any())


class TestSeveral(unittest.TestCase):
    def test_surfaces_are_composited_along_rays(self):
        """The same in one volume and in two."""
        array = make_ball()
        options = {"size": SIZE, "camera": camera_of()}
        one = render(array, [0.0, 0.3], **BALL, color=["red", "blue"], **options)
        outer, inner = isosurface(array, 0.0, **BALL, color="red", opacity=0.35), isosurface(array, 0.3, **BALL, color="blue")
        for surfaces in ([outer, inner], (inner, outer)):
            two = render(surfaces, **options)
            self.assertLessEqual(np.abs(two.rgba.astype(int) - one.rgba).max(), 2)

    def test_image_and_mesh(self):
        mesh = make_grid(VTK_TETRA, ball)
        around = isosurface(make_ball(), 0.0, spacing=6.0 / 23.0, opacity=0.3, color="lightblue")
        inside = isosurface(mesh, 0.9, color="red", shadows=True)
        picture = render([inside, around], size=SIZE)
        red = picture.rgba[SIZE[1] // 2, SIZE[0] // 2]
        self.assertGreater(int(red[0]), int(red[1]) + 20)
        self.assertEqual(margins_of(picture).min().round(2), margins_of(render(around, size=SIZE)).min().round(2))

    def test_arrays_of_several_names(self):
        mesh = make_grid(VTK_TETRA, ball)
        points = np.array([mesh.GetPoint(i) for i in range(mesh.GetNumberOfPoints())])
        for name, values in (("x", points[:, 0]), ("y", points[:, 1])):
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            mesh.GetPointData().AddArray(array)
        across, along = (isosurface(mesh, 3.0, scalars=name, color=color) for name, color in (("x", "red"), ("y", "blue")))
        hits = cast_rays([across, along], [[-1, 2.0, 3.1], [2.0, -1, 3.1]], [[1, 0, 0], [0, 1, 0]])
        np.testing.assert_allclose(hits.points, [[3, 2, 3.1], [2, 3, 3.1]], atol=1e-9)

    def test_volumes_are_where_their_matrices_put_them(self):
        left, right = (isosurface(make_ball(), 0.0, **BALL) for _ in range(2))
        left.SetPosition(-3.0, 0.0, 0.0)
        covered = is_covered(render([left, right], size=(200, 90), view="-y"))
        self.assertFalse(covered[:, 100 + 4 * 5 // 100].all())
        self.assertGreater(covered[:, :90].sum(), 500)
        self.assertGreater(covered[:, 110:].sum(), 500)

    def test_invisible_volumes_are_left_out(self):
        options = {"size": SIZE, "camera": camera_of()}
        seen, hidden = isosurface(make_ball(), 0.3, **BALL, color="red"), isosurface(make_ball(), 0.0, **BALL)
        expected = render(seen, **options).rgba
        self.assertFalse(np.array_equal(render([hidden, seen], **options).rgba, expected))
        hidden.VisibilityOff()
        for surfaces in ([seen, hidden], [hidden, seen]):
            np.testing.assert_array_equal(render(surfaces, **options).rgba, expected)
        for surfaces in (hidden, [hidden, hidden]):
            with self.assertRaisesRegex(ValueError, r"no volume is visible; call VisibilityOn\(\)"):
                render(surfaces, **options)

    def test_volumes_of_several_connections(self):
        """Each connection has its own property, and its place in the volume."""
        outer, inner, other = (isosurface(make_ball(), isovalue, **BALL, color=color, opacity=opacity)
                               for isovalue, color, opacity in ((0.0, "red", 0.4), (0.3, "blue", 1), (0.5, "lime", 1)))
        mapper = vtkIsosurfaceRayTraceMapper()
        mapper.ShallowCopy(outer.GetMapper())
        mapper.AddInputConnection(0, inner.GetMapper().GetInputConnection(0, 0))
        mapper.SetConnectionVolume(1, inner)
        both = vtkVolume()
        both.SetMapper(mapper)
        both.SetProperty(outer.GetProperty())
        for each in (both, outer):
            each.RotateZ(40.0)
            each.SetScale(1.0, 0.8, 1.0)
        inner.SetPosition(0.2, 0.0, 0.0)
        other.SetPosition(0.0, -0.5, 0.0)
        options = {"size": SIZE, "camera": camera_of()}
        together = render([other, both], **options)
        inner.SetUserMatrix(outer.GetMatrix())
        np.testing.assert_array_equal(together.rgba, render([other, outer, inner], **options).rgba)
        without = render([other, outer], **options).rgba
        self.assertGreater((together.rgba != without).mean(), 0.01)
        inner.VisibilityOff()
        np.testing.assert_array_equal(render([other, both], **options).rgba, without)

    def test_as_many_rays_as_the_volume_with_most(self):
        one, eight = (isosurface(make_ball(), 0.0, **BALL, samples=samples) for samples in (1, 8))
        options = {"size": SIZE, "camera": camera_of()}
        expected = render([eight, eight], **options).rgba
        for surfaces in ([one, eight], [eight, one]):
            np.testing.assert_array_equal(render(surfaces, **options).rgba, expected)
        self.assertFalse(np.array_equal(render([one, one], **options).rgba, expected))

    def test_one_image_colors_all(self):
        colors = make_waves()
        left, right = (isosurface(make_ball(), 0.0, **BALL, color_by=colors, cmap=[cmap]) for cmap in ("red", "blue"))
        left.SetPosition(-2.0, 0.0, 0.0)
        red, _, blue, _ = np.moveaxis(render([left, right], size=SIZE, view="-y").rgba.astype(int), 2, 0)
        self.assertGreater((red > blue + 20)[:, :60].sum(), 500)
        self.assertGreater((blue > red + 20)[:, 60:].sum(), 500)

    def make_volume(self, mapper):
        mapper.SetInputDataObject(make_grid(VTK_TETRA, ball))
        volume = vtkVolume()
        volume.SetMapper(mapper)
        return volume

    def test_one_of_one_color(self):
        """That which the error for different colours tells to give."""
        ball = isosurface(make_ball(), 0.0, color_by=make_ball(), cmap=["red", "red"])
        red = np.full((*make_ball().shape, 3), (255, 0, 0), np.uint8)
        picture = render([ball, isosurface(make_ball(), -0.3, color_by=red)], size=(64, 64))
        colors = np.asarray(picture)[..., :3].astype(int).reshape(-1, 3)
        self.assertGreater((colors[:, 0] > colors[:, 1] + 50).sum(), 100)

    def test_cloud_fills_the_picture(self):
        volume = self.make_volume(vtkCellProjectionMapper())
        volume.GetProperty().GetScalarOpacity().AddPoint(0.0, 1.0)
        volume.GetProperty().GetRGBTransferFunction().AddRGBPoint(0.0, 1.0, 0.5, 0.0)
        margins = margins_of(render(volume, size=(100, 80)))
        self.assertTrue(0.0 < margins.min() < 0.08, margins)

    def test_what_cannot_be_joined(self):
        surface = isosurface(make_ball(), 0.0)
        cropped, projected, smooth = (isosurface(make_ball(), 0.0) for _ in range(3))
        cropped.GetMapper().CroppingOn()
        projected.GetMapper().SetBlendModeToMaximumIntensity()
        smooth.GetMapper().SetNormalModeToInterpolantGradient()
        tetrahedra = self.make_volume(vtkIsosurfaceRayTraceMeshMapper())
        tetrahedra.GetMapper().TetrahedralizeOn()
        for other, message in (
            (isosurface(make_ball(), 0.0, interpolation="cubic"), "cannot differ in InterpolationMode"),
            (isosurface(make_ball(), 0.0, color_by=make_ball()), "coloured by arrays of one name, .* may be of one colour"),
            (smooth, "cannot differ in NormalMode"),
            (isosurface(make_ball(), 0.0, clip="x", caps=False), "clipped alike"),
            (isosurface(make_ball(), 0.0, color_by=make_waves()), "coloured by one image, .* the same color_by"),
            (cropped, "cropped alike, .* clip all instead"),
            (projected, "not beside a projection"),
            (self.make_volume(vtkCellProjectionMapper()), "not beside a cloud"),
            (tetrahedra, "call TetrahedralizeOff"),
        ):
            for surfaces in ([surface, other], [other, surface]):
                with self.assertRaisesRegex(ValueError, message):
                    render(surfaces)
        with self.assertRaisesRegex(ValueError, "not beside a cloud"):
            render([isosurface(make_grid(VTK_TETRA, ball), 0.5), self.make_volume(vtkCellProjectionMapper())])
        for surfaces in ([], [surface, make_ball()], [make_ball()]):
            with self.assertRaisesRegex(TypeError, r"list of what isosurface\(\) returns"):
                render(surfaces)
        with self.assertRaisesRegex(TypeError, "has a mapper of this package"):
            render(vtkVolume())
        empty = vtkVolume()
        empty.SetMapper(vtkIsosurfaceRayTraceMapper())
        for camera in (None, vtkCamera()):
            with self.assertRaisesRegex(ValueError, "There is no input"):
                render(empty, camera=camera)
        with self.assertRaisesRegex(ValueError, "a volume has no input; give its mapper one"):
            render([surface, empty])
        with self.assertRaisesRegex(TypeError, "color cannot be given for volumes; give it to each"):
            render(surface, color="red")
        with self.assertRaisesRegex(TypeError, "isovalues cannot be given for volumes"):
            render(surface, 0.1)


class TestErrors(unittest.TestCase):
    def test_bad_arguments(self):
        for options, message in (
            ({"size": 300}, "size is 300"), ({"size": (0, 3)}, "at least one pixel"), ({"size": (3.5, 3)}, "in pixels"),
            ({"view": "front"}, "view is 'front'"), ({"view": (0, 0, 0)}, "view is"), ({"up": 3}, "up is 3"),
            ({"view": "z", "up": "-z"}, "give up another direction"), ({"zoom": 0}, "zoom is 0"),
            ({"background": "whitish"}, "no colour"), ({"clip": ((0, 0, 99), "z")}, "or clip removes them"),
            ({"size": (10**10, 1)}, r"fewer than 2\*\*31"), ({"opacity": 0}, "have the opacity 0"),
        ):  # fmt: skip
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                render(make_waves(), 150, **options)

    def test_what_is_no_data(self):
        reader, empty = vtkXMLImageDataReader(), vtkImageData()
        for given, options, kind, message in (
            (make_waves(), {"camera": "x"}, TypeError, "give a vtkCamera, or view"),
            (make_waves(), {"isovalue": 150}, TypeError, "no option isovalue; did you mean isovalues?"),
            (make_waves(), {"colour": "red"}, TypeError, "no option colour; did you mean color?"),
            (make_waves(), {"quality": 3}, TypeError, "no option quality; there are scalars, color, "),
            (make_waves(), {"color_by": "RTData", "clim": (5, 0)}, ValueError, "the smaller one first"),
            (reader, {}, TypeError, r"in a vtkXMLImageDataReader: call Update\(\), and give GetOutput\(\)"),
            (reader.GetOutputPort(), {}, TypeError, r"in a vtkAlgorithmOutput: call Update\(\)"),
            (empty, {}, ValueError, r"they are empty; call Update\(\) of their reader"),
            (np.full((3, 3, 3), np.nan), {"isovalues": 1}, ValueError, "all values are NaN"),
        ):
            with self.subTest(message), self.assertRaisesRegex(kind, message):
                render(given, **options)

    def test_picture_that_is_too_large(self):
        with self.assertRaisesRegex(MemoryError, "make the picture or the input smaller"):
            render(make_waves(4), 150, size=(2**31 - 1, 2**31 - 1), camera=vtkCamera())

    def test_errors_of_the_mapper_are_raised_each_time(self):
        volume = isosurface(make_waves(), 150)
        volume.SetPosition(np.nan, 0.0, 0.0)
        for _ in range(3):
            with self.assertRaisesRegex(ValueError, "^The matrix of the volume has numbers that are not finite"):
                render(volume, size=SIZE)
        volume.SetPosition(0.0, 0.0, 0.0)
        self.assertTrue(is_covered(render(volume, size=SIZE)).any())
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 999.0)
        with self.assertRaisesRegex(ValueError, "no isovalue is within the scalars"):
            render(volume, size=SIZE)


class TestPicture(unittest.TestCase):
    def setUp(self):
        self.picture = render(make_ball(), [0.0, 0.3], size=SIZE)

    def test_opacity(self):
        """Edges and translucent surfaces have their own colour; over a background they are mixed with it."""
        rgba = self.picture.rgba.astype(float)
        self.assertEqual(rgba.shape, (SIZE[1], SIZE[0], 4))
        self.assertTrue(((rgba[:, :, 3] > 0) & (rgba[:, :, 3] < 255)).any())
        camera = {"size": SIZE}
        for name, rgb in (("white", (255, 255, 255)), ("#204060", (0x20, 0x40, 0x60))):
            flat = render(make_ball(), [0.0, 0.3], background=name, **camera).rgba
            self.assertTrue((flat[:, :, 3] == 255).all())
            part = rgba[:, :, 3:] / 255.0
            mixed = part * rgba[:, :, :3] + (1.0 - part) * np.array(rgb)
            self.assertLess(np.abs(flat[:, :, :3] - mixed).max(), 2.0)

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "picture.png")
            for name in (path, str(path)):
                self.picture.save(name)
            self.assertEqual(path.read_bytes(), self.picture.png())
            reader = vtkPNGReader()
            reader.SetFileName(str(path))
            reader.Update()
            np.testing.assert_array_equal(colors_of(reader.GetOutput()), self.picture.rgba)
            with self.assertRaisesRegex(ValueError, "no name of a PNG file"):
                self.picture.save(path.with_suffix(".jpg"))
            with self.assertRaises(FileNotFoundError):
                self.picture.save(Path(folder, "absent", "picture.png"))
        self.assertEqual(self.picture._repr_png_()[:4], b"\x89PNG")

    def test_array(self):
        np.testing.assert_array_equal(np.asarray(self.picture), self.picture.rgba)
        self.assertEqual(np.asarray(self.picture, dtype=float).dtype, float)
        self.assertFalse(np.shares_memory(np.array(self.picture), self.picture.rgba))
        self.assertEqual(self.picture.size, SIZE)
        self.assertEqual(repr(self.picture), "<Picture of 120 x 90 pixels>")
        depth, position = self.picture.array("Depth"), self.picture.array("Position")
        self.assertEqual((depth.shape, position.shape), ((90, 120), (90, 120, 3)))
        covered = self.picture.array("IsovalueId") >= 0
        self.assertLess((covered != is_covered(self.picture)).mean(), 0.05)
        self.assertTrue(np.isfinite(position[covered]).all())
        top, bottom = position[covered][0], position[covered][-1]
        self.assertGreater(top[2], bottom[2])
        with self.assertRaisesRegex(KeyError, "give one of .*Colors"):
            self.picture.array("Value")
        self.assertIsInstance(self.picture, Picture)

    def test_copies(self):
        picture = render(make_ball(), [0.0, 0.3], size=SIZE, background="white")
        points = picture.image.GetPointData()
        names = [points.GetArrayName(i) for i in range(points.GetNumberOfArrays())]
        for again in (pickle.loads(pickle.dumps(picture)), copy.deepcopy(picture), copy.copy(picture)):
            self.assertEqual(again.size, SIZE)
            np.testing.assert_array_equal(again.rgba, picture.rgba)
            np.testing.assert_array_equal(colors_of(again.image), colors_of(picture.image))
            copied = again.image.GetPointData()
            self.assertEqual(copied.GetNumberOfArrays(), len(names))
            for name in names:
                np.testing.assert_array_equal(again.array(name), picture.array(name))
                self.assertEqual(copied.GetArray(name).GetDataType(), points.GetArray(name).GetDataType())

    def test_smooth_edges(self):
        smooth = ((self.picture.rgba[:, :, 3] > 0) & (self.picture.rgba[:, :, 3] < 80)).sum()
        plain = render(make_ball(), [0.0, 0.3], size=SIZE, samples=1).rgba[:, :, 3]
        self.assertGreater(smooth, 20)
        self.assertEqual(((plain > 0) & (plain < 80)).sum(), 0)


class TestWithoutDisplay(unittest.TestCase):
    def test_nothing_of_opengl_is_needed(self):
        code = """
import sys, numpy as np
from vtkIsosurfaceRayTracing import render, show
picture = render(np.indices((9, 9, 9)).sum(axis=0), 11.0)
assert picture.rgba.any()
assert "vtkmodules.vtkRenderingOpenGL2" not in sys.modules
try:
    show(np.indices((9, 9, 9)).sum(axis=0), 11.0)
except RuntimeError as error:
    print(error)
"""
        result = self.run_python(code)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        self.assertIn("there is no display", result.stdout)

    def test_forked_processes(self):
        """OpenMP's threads are not in them."""
        code = """
import multiprocessing, os
os.environ["OMP_NUM_THREADS"] = "3"
import numpy as np
from vtkIsosurfaceRayTracing import isosurface, render
samples = np.indices((9, 9, 9)).sum(axis=0)
def draw(threads):
    volume = isosurface(samples, 11.0)
    volume.GetMapper().SetNumberOfThreads(threads)
    return render(volume, size=(64, 64))
expected = draw(3)
with multiprocessing.get_context("fork").Pool(2) as pool:
    for picture in pool.map_async(draw, (0, 1, 3)).get(60):
        assert np.array_equal(picture, expected)
"""
        result = self.run_python(code)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_classes_need_no_numpy(self):
        code = """
import sys
sys.modules["numpy"] = None  # cannot be imported
import vtkIsosurfaceRayTracing
vtkIsosurfaceRayTracing.vtkIsosurfaceRayTraceMapper()
try:
    vtkIsosurfaceRayTracing.render
except ImportError as error:
    print(error)
"""
        result = self.run_python(code)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("numpy", result.stdout)

    def run_python(self, code):
        without = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        return subprocess.run([sys.executable, "-c", code], env=without, capture_output=True, text=True, check=False)


if __name__ == "__main__":
    unittest.main()
