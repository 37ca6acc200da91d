#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""vtkIsosurfacePicture shows what the mapper would draw, among other props."""

import unittest

from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkTable
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the window
from vtkIsosurfaceRayTracing import vtkIsosurfacePicture, vtkIsosurfaceRayTraceMapper, vtkIsosurfaceVolume

from MeshTesting import errors_of
from PictureTesting import capture, make_waves

SIZE = (180, 140)


def make_volume(opacities):
    mapper = vtkIsosurfaceRayTraceMapper()
    mapper.SetInputData(make_waves(12))
    volume = vtkIsosurfaceVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().ShadeOn()
    for i, (isovalue, opacity) in enumerate(zip((130.0, 200.0), opacities)):
        volume.GetProperty().GetIsoSurfaceValues().SetValue(i, isovalue)
        volume.GetProperty().GetScalarOpacity().AddPoint(isovalue, opacity)
    colors = volume.GetProperty().GetRGBTransferFunction()
    colors.AddRGBPoint(130.0, 0.3, 0.5, 0.9)
    colors.AddRGBPoint(200.0, 0.9, 0.6, 0.3)
    return volume


def make_sphere(center, radius):
    source = vtkSphereSource()
    source.SetCenter(center)
    source.SetRadius(radius)
    source.SetThetaResolution(32)
    source.SetPhiResolution(32)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def set_camera(camera):
    camera.SetPosition(50.0, 35.0, 60.0)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetClippingRange(30.0, 160.0)


def make_window(props, viewport=(0.0, 0.0, 1.0, 1.0), background=(0.1, 0.2, 0.3)):
    renderer = vtkRenderer()
    renderer.SetBackground(background)
    renderer.SetViewport(viewport)
    set_camera(renderer.GetActiveCamera())
    for prop in props:
        renderer.AddViewProp(prop)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(SIZE)
    window.AddRenderer(renderer)
    return window


def draw(*props, **options):
    window = make_window(props, **options)
    window.Render()
    return capture(window)


def make_camera():
    camera = vtkRenderer().MakeCamera()
    set_camera(camera)
    return camera


def render(volume, size=SIZE, depths=None):
    image = vtkImageData()
    assert volume.GetMapper().RenderToImage(volume, make_camera(), None, *size, image, depths)
    return image


def find_depths(*props):
    window = make_window(props)
    window.Render()
    depths = vtkFloatArray()
    window.GetZbufferData(0, 0, SIZE[0] - 1, SIZE[1] - 1, depths)
    return depths


def scalars(image):
    return image.GetPointData().GetScalars()


def rows(image, components):
    values = bytes(memoryview(scalars(image)))
    return [values[i : i + components] for i in range(0, len(values), components)]


def make_picture(image):
    picture = vtkIsosurfacePicture()
    picture.SetPicture(image)
    return picture


class TestPicture(unittest.TestCase):
    def check(self, opacities, *others, size=SIZE, **options):
        volume = make_volume(opacities)
        expected = draw(volume, *others, **options)
        picture = make_picture(render(volume, size))
        self.assertNotEqual(expected, draw(*others, **options))
        self.assertEqual(draw(picture, *others, **options), expected)
        self.assertEqual(draw(*others, picture, **options), expected)

    def test_opaque_surfaces_and_polygons_hide_each_other(self):
        """A sphere that the surfaces pass through."""
        self.check((1.0, 1.0), make_sphere((4.0, 2.0, 5.0), 8.0))

    def test_translucent_polygons_before_opaque_surfaces(self):
        sphere = make_sphere((10.0, 6.0, 12.0), 6.0)
        sphere.GetProperty().SetOpacity(0.4)
        self.check((1.0, 1.0), sphere)

    def test_translucent_surfaces(self):
        self.check((0.3, 0.5))
        self.check((0.3, 1.0), make_sphere((-20.0, -14.0, -24.0), 8.0))

    def test_translucent_surfaces_before_and_behind_polygons(self):
        volume, sphere = make_volume((0.3, 0.5)), make_sphere((4.0, 2.0, 5.0), 8.0)
        expected = draw(volume, sphere)
        self.assertEqual(draw(make_picture(render(volume, depths=find_depths(sphere))), sphere), expected)
        self.assertNotEqual(draw(make_picture(render(volume)), sphere), expected)

    def test_projection_hides_nothing_by_its_depths(self):
        """It is opaque, and yet drawn over translucent polygons, as in a window."""
        volume, sphere = make_volume((1.0, 1.0)), make_sphere((10.0, 6.0, 12.0), 6.0)
        volume.GetMapper().SetBlendModeToMaximumIntensity()
        sphere.GetProperty().SetOpacity(0.4)
        expected = draw(volume, sphere)
        self.assertEqual(draw(make_picture(render(volume)), sphere), expected)
        self.assertNotEqual(draw(sphere), expected)

    def test_depths_that_are_not_of_the_pixels(self):
        volume = make_volume((0.3, 0.5))
        mapper = volume.GetMapper()
        fewer, pairs = vtkFloatArray(), vtkFloatArray()
        fewer.SetNumberOfValues(17)
        pairs.SetNumberOfComponents(2)
        pairs.SetNumberOfTuples(18)
        for depths in (fewer, pairs):
            for render_to, output in ((mapper.RenderToImage, vtkImageData()), (mapper.RenderToFragments, vtkTable())):
                errors = errors_of(
                    mapper, lambda: self.assertFalse(render_to(volume, make_camera(), None, 6, 3, output, depths)))
                self.assertIn("needs a depth for each of the 6 x 3 pixels", "".join(errors))

    def test_viewport(self):
        self.check((1.0, 1.0), make_sphere((4.0, 2.0, 5.0), 8.0), size=(90, 140), viewport=(0.5, 0.0, 1.0, 1.0))

    def test_changed_picture(self):
        picture = make_picture(render(make_volume((1.0, 1.0))))
        window = make_window([picture])
        window.Render()
        first = capture(window)
        other = make_volume((1.0, 1.0))
        other.RotateY(40.0)
        image = render(other)
        picture.GetPicture().ShallowCopy(image)
        window.Render()
        self.assertNotEqual(capture(window), first)
        self.assertEqual(capture(window), draw(make_picture(image)))
        copy = vtkIsosurfacePicture()
        copy.ShallowCopy(picture)
        self.assertEqual(draw(copy), capture(window))

    def test_images_for_files(self):
        """Over a background it is what a window of that background shows; by itself it is divided by the opacity."""
        volume = make_volume((0.3, 0.5))
        picture = render(volume)
        colors = rows(picture, 4)
        self.assertTrue(any(0 < color[3] < 255 for color in colors))
        for background in ((1.0, 1.0, 1.0), (0.2, 0.5, 0.0)):
            flat = vtkImageData()
            self.assertTrue(vtkIsosurfacePicture.FlattenColors(picture, background, flat))
            self.assertEqual(flat.GetDimensions(), picture.GetDimensions())
            shown = draw(volume, background=background)
            difference = max(abs(a - b) for a, b in zip(bytes(memoryview(scalars(flat))), shown, strict=True))
            self.assertLessEqual(difference, 1)
        transparent = vtkImageData()
        self.assertTrue(vtkIsosurfacePicture.UnpremultiplyColors(picture, transparent))
        for color, straight in zip(colors, rows(transparent, 4), strict=True):
            self.assertEqual(straight[3], color[3])
            for multiplied, channel in zip(color[:3], straight[:3]):
                self.assertLessEqual(abs(channel * color[3] / 255.0 - multiplied), 0.5)
        same = vtkImageData()
        same.DeepCopy(picture)
        self.assertTrue(vtkIsosurfacePicture.UnpremultiplyColors(same, same))
        self.assertEqual(same.GetDimensions(), picture.GetDimensions())
        self.assertEqual(bytes(memoryview(scalars(same))), bytes(memoryview(scalars(transparent))))
        for image in (vtkImageData(), make_waves(4), None):
            self.assertFalse(vtkIsosurfacePicture.UnpremultiplyColors(image, transparent))
        self.assertFalse(vtkIsosurfacePicture.FlattenColors(picture, background, None))

    def test_what_is_no_picture(self):
        nothing = draw()
        self.assertEqual(draw(vtkIsosurfacePicture()), nothing)
        self.assertEqual(draw(make_picture(vtkImageData())), nothing)
        without_depth = render(make_volume((1.0, 1.0)))
        without_depth.GetPointData().RemoveArray("Depth")
        shorter = render(make_volume((1.0, 1.0)))
        shorter.GetPointData().GetArray("Colors").Resize(10)
        for image in (without_depth, shorter, make_waves(4)):
            picture = make_picture(image)
            errors = []
            picture.AddObserver("ErrorEvent", lambda *_, errors=errors: errors.append(1))
            window = make_window([picture])
            window.Render()
            window.Render()
            self.assertEqual(capture(window), nothing)
            self.assertEqual(len(errors), 1)


if __name__ == "__main__":
    unittest.main()
