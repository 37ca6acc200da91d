#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of meshes: against closed forms, against VTK's ray caster, and in every kind of scene."""

import math
import unittest

import numpy as np

from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import reference, vtkCommand, vtkSOADataArrayTemplate, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_PYRAMID,
    VTK_TETRA,
    VTK_WEDGE,
    vtkDataSetAttributes,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPiecewiseFunction,
    vtkPlane,
    vtkTable,
)
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkFiltersCore import vtkThreshold
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCamera,
    vtkColorTransferFunction,
    vtkLight,
    vtkLightCollection,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
)
from vtkmodules.vtkRenderingVolume import (
    vtkFixedPointVolumeRayCastMapper,
    vtkUnstructuredGridLinearRayIntegrator,
    vtkUnstructuredGridVolumeRayCastMapper,
)
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401  (vtkRayCastImageDisplayHelper)
from vtkIsosurfaceRayTracing import (
    vtkCellProjectionMapper, vtkIsosurfacePicture, vtkIsosurfaceRayTraceMeshMapper)

from MeshTesting import SIZE, ball, errors_of, make_grid, make_structured_grid, make_volume
from PictureTesting import capture, make_waves

PIXELS = 90
CENTER = 3 * (SIZE / 2,)


def fill_property(volume_property, low=-2.0, high=2.0, opacity=0.4, unit=1.0):
    """Blue to red, and more and more opaque."""
    colors, opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
    colors.AddRGBPoint(low, 0.1, 0.2, 1.0)
    colors.AddRGBPoint(0.3 * low + 0.7 * high, 1.0, 0.9, 0.2)
    colors.AddRGBPoint(high, 1.0, 0.1, 0.0)
    opacities.AddPoint(low, 0.0)
    opacities.AddPoint(high, opacity)
    volume_property.SetColor(colors)
    volume_property.SetScalarOpacity(opacities)
    volume_property.SetScalarOpacityUnitDistance(unit)


def make_cloud(grid, mapper_class=vtkCellProjectionMapper, **transfer):
    mapper, volume = make_volume(grid, mapper_class=mapper_class)
    fill_property(volume.GetProperty(), **transfer)
    volume.GetProperty().ShadeOff()
    return mapper, volume


def make_camera():
    camera = vtkCamera()
    camera.SetFocalPoint(CENTER)
    camera.SetPosition(CENTER[0] + 6.0, CENTER[1] - 14.0, CENTER[2] + 9.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetClippingRange(1.0, 60.0)
    return camera


def make_camera_along_y(scale=2.0):
    """Parallel rays through the whole of the box."""
    camera = make_camera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(scale)
    camera.SetPosition(CENTER[0], CENTER[1] - 14.0, CENTER[2])
    return camera


def render_to_image(mapper, volume, camera=None, size=PIXELS):
    """Red, green, blue and opacity in [0, 1]: an array of size x size x 4."""
    image = vtkImageData()
    assert mapper.RenderToImage(volume, camera or make_camera(), None, size, size, image)
    colors = vtk_to_numpy(image.GetPointData().GetArray("Colors"))
    return colors.reshape(size, size, 4) / 255.0


def make_window(*props, size=PIXELS):
    renderer = vtkRenderer()
    for prop in props:
        renderer.AddViewProp(prop)
    renderer.SetActiveCamera(make_camera())
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(size, size)
    window.AddRenderer(renderer)
    return window


def draw(*props, size=PIXELS):
    """Red, green and blue from 0 to 255: an array of size x size x 3."""
    return draw_in(make_window(*props, size=size))


def draw_in(window):
    window.Render()
    size = window.GetSize()[0]
    return np.frombuffer(capture(window), dtype=np.uint8).reshape(size, size, 3).astype(int)


def make_sphere(radius):
    source = vtkSphereSource()
    source.SetCenter(CENTER)
    source.SetRadius(radius)
    source.SetThetaResolution(64)
    source.SetPhiResolution(64)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetColor(0.0, 1.0, 0.0)
    return actor


class TestClosedForms(unittest.TestCase):
    SHAPES = (VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID)

    def test_a_box_of_one_value(self):
        """Each ray has the opacity that its length in the box says, whatever the cells are."""
        camera = make_camera_along_y()
        for shape in self.SHAPES:
            for unit in (0.5, 3.0, 40.0):
                with self.subTest(shape=shape, unit=unit):
                    mapper, volume = make_cloud(make_grid(shape, lambda p: 0.0), unit=unit)
                    picture = render_to_image(mapper, volume, camera)
                    expected = 1.0 - math.exp(-0.2 * SIZE / unit)
                    self.assertLess(np.abs(picture[..., 3] - expected).max(), 0.51 / 255)

    def test_scales_are_those_of_the_world(self):
        mapper, volume = make_cloud(make_grid(VTK_HEXAHEDRON, lambda p: 0.0), unit=4.0)
        volume.SetOrigin(CENTER)
        volume.SetScale(1.0, 2.0, 1.0)
        camera = make_camera_along_y()
        opacity = render_to_image(mapper, volume, camera)[..., 3]
        self.assertLess(np.abs(opacity - (1.0 - math.exp(-0.2 * 2 * SIZE / 4.0))).max(), 0.51 / 255)

    def test_steps_in_the_transfer_functions(self):
        """A slab of one value in a linear field, between two steps of the opacity."""
        mapper, volume = make_cloud(make_grid(VTK_TETRA, lambda p: p[1]))
        opacities = vtkPiecewiseFunction()
        for value, opacity in ((0.0, 0.0), (2.0, 0.0), (2.0 + 1e-9, 0.7), (3.5, 0.7), (3.5 + 1e-9, 0.0)):
            opacities.AddPoint(value, opacity)
        volume.GetProperty().SetScalarOpacity(opacities)
        camera = make_camera_along_y()
        opacity = render_to_image(mapper, volume, camera)[..., 3]
        self.assertLess(np.abs(opacity - (1.0 - math.exp(-0.7 * 1.5))).max(), 0.51 / 255)

    def test_functions_that_are_not_linear(self):
        """They are those that VTK evaluates, not the lines between their nodes."""
        mapper, volume = make_cloud(make_grid(VTK_TETRA, ball))
        opacities = vtkPiecewiseFunction()
        opacities.AddPoint(-2.0, 0.0, 0.3, 0.6)
        opacities.AddPoint(2.0, 0.5)
        colors = vtkColorTransferFunction()
        colors.SetColorSpaceToHSV()
        colors.AddRGBPoint(-2.0, 1.0, 0.0, 0.0)
        colors.AddRGBPoint(2.0, 0.0, 0.0, 1.0)
        volume.GetProperty().SetScalarOpacity(opacities)
        volume.GetProperty().SetColor(colors)
        picture = render_to_image(mapper, volume)
        sampled, sampled_opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
        for value in np.linspace(-2.0, 2.0, 2001):
            sampled.AddRGBPoint(value, *colors.GetColor(value))
            sampled_opacities.AddPoint(value, opacities.GetValue(value))
        volume.GetProperty().SetScalarOpacity(sampled_opacities)
        volume.GetProperty().SetColor(sampled)
        self.assertLess(np.abs(picture - render_to_image(mapper, volume)).max(), 1.01 / 255)

    def test_functions_that_are_not_clamped(self):
        mapper, volume = make_cloud(make_grid(VTK_TETRA, lambda p: 5.0))
        self.assertGreater(render_to_image(mapper, volume)[..., 3].max(), 0.5)
        volume.GetProperty().GetScalarOpacity().ClampingOff()
        self.assertEqual(render_to_image(mapper, volume)[..., 3].max(), 0.0)


class TestAgainstVtk(unittest.TestCase):
    def test_ray_caster(self):
        """The colours of VTK's ray caster with its most accurate integrator. It loses rays now and
        then, and its rays go through other points of the pixels: in large pictures, that is little."""
        grid = make_grid(VTK_TETRA, ball)
        _, volume = make_cloud(grid)
        other, other_volume = make_cloud(grid, vtkUnstructuredGridVolumeRayCastMapper)
        other.SetRayIntegrator(vtkUnstructuredGridLinearRayIntegrator())
        difference = np.abs(draw(volume, size=480) - draw(other_volume, size=480)).max(axis=-1)
        self.assertLess(np.mean(difference), 1.0)
        self.assertLess(np.mean(difference > 3), 0.02)

    def test_hexahedra_are_their_tetrahedra(self):
        """A linear field has one picture, however its cells are cut."""
        pictures = []
        for shape in TestClosedForms.SHAPES:
            mapper, volume = make_cloud(make_grid(shape, lambda p: p[0] + 0.5 * p[1] - p[2]))
            pictures.append(render_to_image(mapper, volume))
        self.assertGreater(pictures[0][..., 3].max(), 0.3)
        for picture in pictures[1:]:
            self.assertLess(np.abs(picture - pictures[0]).max(), 1.01 / 255)


def make_light(direction, color=(1.0, 1.0, 1.0)):
    """A light from so far away that its rays are parallel, in a list."""
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetFocalPoint(CENTER)
    light.SetPosition(np.array(CENTER) + direction)
    light.SetColor(color)
    light.SetAmbientColor(1.0, 1.0, 1.0)  # for vtkFixedPointVolumeRayCastMapper
    lights = vtkLightCollection()
    lights.AddItem(light)
    return lights


def shade(volume_property, ambient=0.1, diffuse=0.6, specular=0.3, power=10.0, component=0):
    volume_property.SetShade(component, 1)
    volume_property.SetAmbient(component, ambient)
    volume_property.SetDiffuse(component, diffuse)
    volume_property.SetSpecular(component, specular)
    volume_property.SetSpecularPower(component, power)


class TestShading(unittest.TestCase):
    NORMALS = (vtkCellProjectionMapper.CENTRAL_DIFFERENCES, vtkCellProjectionMapper.INTERPOLANT_GRADIENT)

    def render(self, mapper, volume, lights, camera=None):
        image = vtkImageData()
        camera = camera or make_camera_along_y()
        self.assertTrue(mapper.RenderToImage(volume, camera, lights, PIXELS, PIXELS, image))
        return vtk_to_numpy(image.GetPointData().GetArray("Colors")).reshape(PIXELS, PIXELS, 4) / 255.0

    def test_a_linear_field(self):
        """Its normal is the same everywhere: as bright as a plane, whatever the cells are."""
        normal = np.array((0.4, -0.8, 0.2)) / np.linalg.norm((0.4, -0.8, 0.2))
        direction = np.array((0.3, -0.9, 0.5)) / np.linalg.norm((0.3, -0.9, 0.5))
        to_viewer = np.array((0.0, -1.0, 0.0))
        cosine = normal @ direction
        mirrored = (2 * cosine * normal - direction) @ to_viewer
        for shape, normals, side in zip(TestClosedForms.SHAPES, 2 * self.NORMALS, (1.0, 1.0, -1.0, -1.0)):
            with self.subTest(shape=shape, normals=normals):
                mapper, volume = make_cloud(make_grid(shape, lambda p: side * (np.dot(p, normal) - 2.0)), opacity=1.0)
                mapper.SetNormalMode(normals)
                colors = vtkColorTransferFunction()
                colors.AddRGBPoint(0.0, 0.5, 0.8, 0.3)
                volume.GetProperty().SetColor(colors)
                lights = make_light(direction, (0.9, 1.0, 0.4))
                unlit = self.render(mapper, volume, lights)
                shade(volume.GetProperty())
                lit = self.render(mapper, volume, lights)
                self.assertGreater(lit[..., 3].max(), 0.5)
                self.assertTrue(np.array_equal(lit[..., 3], unlit[..., 3]))
                for channel, light in enumerate((0.9, 1.0, 0.4)):
                    own = colors.GetColor(0.0)[channel]
                    expected = own * (0.1 + 0.6 * cosine * light) + 0.3 * mirrored**10 * light
                    self.assertLess(np.abs(lit[..., channel] - lit[..., 3] * expected).max(), 1.01 / 255)

    def test_each_component_has_its_own(self):
        """Light from behind shows nothing of a component that is shaded: what is left is the other one."""
        mapper, volume = make_mixture(make_components(VTK_TETRA, WAVES[:2]), HUES[:2])
        lights = make_light((0.0, 1.0, 0.0))
        for shaded, other in ((0, 1), (1, 0)):
            shade(volume.GetProperty(), ambient=0.0, component=shaded)
            volume.GetProperty().SetShade(other, 0)
            colors = self.render(mapper, volume, lights)[..., :3].reshape(-1, 3)
            self.assertGreater(colors.max(), 0.3)
            self.assertLess(np.abs(np.cross(colors, HUES[other])).max(), 0.01)

    def test_dependent_components(self):
        """They are lit by the gradient of the opacity."""
        functions = (lambda p: 255.0, lambda p: 127.0, lambda p: 40.0 * p[2], lambda p: 40.0 * p[1])
        mapper, volume = make_cloud(make_components(VTK_TETRA, functions, np.uint8), unit=0.3)
        volume.GetProperty().IndependentComponentsOff()
        unlit = self.render(mapper, volume, None)
        cosine = 0.8
        shade(volume.GetProperty(), 0.1, 0.6, 0.0)
        lit = self.render(mapper, volume, make_light((0.6, -0.8, 0.0)))
        self.assertGreater(unlit[..., :3].min(axis=(0, 1))[0], 0.9)
        self.assertLess(np.abs(lit[..., :3] - (0.1 + 0.6 * cosine) * unlit[..., :3]).max(), 1.01 / 255)

    def test_fixed_point_mapper(self):
        """The shading of the mapper for images, of an image that is cut into tetrahedra. Its opacity
        is that of the unit distance, not the attenuation."""
        size = 40
        image = vtkImageData()
        image.SetDimensions(size, size, size)
        image.SetSpacing(3 * (SIZE / (size - 1),))
        points = np.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())]) - CENTER
        values = np.sin(1.1 * points[:, 0]) + np.cos(0.9 * points[:, 1]) - 0.5 * points[:, 2]
        scalars = numpy_to_vtk((1000.0 * (values + 4.0)).astype(np.uint16), deep=True)
        image.GetPointData().SetScalars(scalars)
        tetrahedra = vtkDataSetTriangleFilter()
        tetrahedra.SetInputData(image)
        tetrahedra.Update()
        for is_two_sided in (True, False):
            pictures = []
            for mapper, data in (
                (vtkCellProjectionMapper(), tetrahedra.GetOutput()), (vtkFixedPointVolumeRayCastMapper(), image)
            ):
                mapper.SetInputData(data)
                volume = vtkVolume()
                volume.SetMapper(mapper)
                fill_property(volume.GetProperty(), low=3000.0, high=6500.0, opacity=0.25, unit=0.1)
                shade(volume.GetProperty())
                if mapper.IsA("vtkFixedPointVolumeRayCastMapper"):
                    opacities = volume.GetProperty().GetScalarOpacity()
                    for value in np.linspace(3000.0, 6500.0, 100):
                        opacities.AddPoint(value, 1.0 - math.exp(-0.25 * (value - 3000.0) / 3500.0))
                    # By the half-way vector, whose angle to the normal is half of that of the mirrored light.
                    volume.GetProperty().SetSpecularPower(40.0)
                    volume.GetProperty().SetInterpolationTypeToLinear()
                    mapper.SetAutoAdjustSampleDistances(0)
                    mapper.SetSampleDistance(0.05)
                window = make_window(volume, size=200)
                renderer = window.GetRenderers().GetFirstRenderer()
                renderer.SetTwoSidedLighting(is_two_sided)
                renderer.GetActiveCamera().ParallelProjectionOn()  # it has one direction to the viewer
                renderer.GetActiveCamera().SetParallelScale(5.0)
                renderer.AddLight(make_light((0.8, -0.5, 0.6)).GetItemAsObject(0))
                pictures.append(draw_in(window))
            difference = np.abs(pictures[0] - pictures[1])
            self.assertGreater(pictures[0].mean(), 20)
            self.assertLess(difference.mean(), 2.0)
            self.assertLess(np.mean(difference.max(axis=-1) > 16), 0.02)


class TestScenes(unittest.TestCase):
    def test_window_and_image_are_alike(self):
        mapper, volume = make_cloud(make_structured_grid(ball))
        image = vtkImageData()
        self.assertTrue(mapper.RenderToImage(volume, make_camera(), None, PIXELS, PIXELS, image))
        flat = vtkImageData()
        vtkIsosurfacePicture.FlattenColors(image, (0.0, 0.0, 0.0), flat)
        picture = vtk_to_numpy(flat.GetPointData().GetScalars()).reshape(PIXELS, PIXELS, -1)[..., :3]
        self.assertLessEqual(np.abs(draw(volume) - picture.astype(int)).max(), 1)

    def test_threads_do_not_matter(self):
        mapper, volume = make_cloud(make_structured_grid(ball))
        mapper.SetNumberOfThreads(1)
        expected = render_to_image(mapper, volume)
        for threads in (2, 5):
            mapper.SetNumberOfThreads(threads)
            self.assertTrue(np.array_equal(render_to_image(mapper, volume), expected))

    def test_geometry_in_the_cloud(self):
        """An opaque sphere ends the rays: what is before it is seen, and nothing behind it."""
        mapper, volume = make_cloud(make_grid(VTK_HEXAHEDRON, lambda p: 0.0))
        picture = draw(volume, make_sphere(1.5))
        middle = picture[PIXELS // 2, PIXELS // 2]
        # Through half of the box, less the radius.
        camera = make_camera()
        away = np.array(camera.GetPosition()) - CENTER
        away /= np.linalg.norm(away)
        length = (SIZE / 2) / np.abs(away).max() - 1.5
        transmittance = math.exp(-0.2 * length)
        color = np.array(volume.GetProperty().GetRGBTransferFunction().GetColor(0.0))
        expected = (1.0 - transmittance) * color + transmittance * np.array((0.0, 1.0, 0.0))
        self.assertLess(np.abs(middle / 255 - expected).max(), 0.02)
        self.assertLess(np.abs(draw(volume) - picture).max(axis=-1)[2, 2], 1)

    def test_isosurfaces_in_the_cloud(self):
        """Before an opaque isosurface there is the cloud of what is outside; by itself it is the
        one that the mapper of meshes draws."""
        grid = make_grid(VTK_TETRA, ball)
        mapper, volume = make_cloud(grid, opacity=1.0)
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 2.5)
        without = render_to_image(mapper, volume)
        mapper.DrawIsosurfacesOn()
        self.assertTrue(np.array_equal(render_to_image(mapper, volume), without))  # beyond the data
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 1.0)
        volume.GetProperty().GetScalarOpacity().AddPoint(0.99, 0.3)
        volume.GetProperty().GetScalarOpacity().AddPoint(1.0, 1.0)
        with_surface = render_to_image(mapper, volume)
        self.assertEqual(with_surface[PIXELS // 2, PIXELS // 2, 3], 1.0)
        # A cloud that has no opacity where it is seen leaves the surface as it is.
        opacities = vtkPiecewiseFunction()
        opacities.AddPoint(1.0 - 1e-9, 0.0)
        opacities.AddPoint(1.0, 1.0)
        volume.GetProperty().SetScalarOpacity(opacities)
        surface, surface_volume = make_cloud(grid, vtkIsosurfaceRayTraceMeshMapper)
        surface_volume.SetProperty(volume.GetProperty())
        self.assertLess(
            np.abs(render_to_image(mapper, volume) - render_to_image(surface, surface_volume)).max(),
            1.01 / 255)

    def test_translucent_isosurfaces(self):
        """Two halves of a linear field: a plane between them transmits one minus its opacity."""
        mapper, volume = make_cloud(make_grid(VTK_TETRA, lambda p: p[1]), unit=8.0)
        volume.GetProperty().ShadeOff()
        opacities = vtkPiecewiseFunction()
        opacities.AddPoint(0.0, 0.25)
        opacities.AddPoint(6.0, 0.25)
        volume.GetProperty().SetScalarOpacity(opacities)
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 3.1)
        camera = make_camera_along_y()
        mapper.DrawIsosurfacesOn()
        opacity = render_to_image(mapper, volume, camera)[..., 3]
        expected = 1.0 - 0.75 * math.exp(-0.25 * SIZE / 8.0)
        self.assertLess(np.abs(opacity - expected).max(), 0.51 / 255)

    def test_opacities_beyond_one(self):
        """They attenuate: a thickness d transmits exp(-a d / unit)."""
        mapper, volume = make_cloud(make_grid(VTK_TETRA, lambda p: 0.5), unit=2.0 * SIZE)
        volume.GetProperty().ShadeOff()
        camera = make_camera_along_y()
        for attenuation in (1.0, 2.5, 7.0, 1000.0):
            opacities = vtkPiecewiseFunction()
            opacities.AddPoint(0.0, attenuation)
            opacities.AddPoint(1.0, attenuation)
            volume.GetProperty().SetScalarOpacity(opacities)
            opacity = render_to_image(mapper, volume, camera)[..., 3]
            self.assertLess(np.abs(opacity - (1.0 - math.exp(-0.5 * attenuation))).max(), 0.51 / 255)

    def test_maximum_intensity(self):
        """Of a linear field: the value where the ray leaves the box, or enters it."""
        mapper, volume = make_cloud(make_grid(VTK_WEDGE, lambda p: p[2]))
        mapper.SetBlendModeToMaximumIntensity()
        colors, opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
        colors.AddRGBPoint(0.0, 0.0, 0.0, 0.0)
        colors.AddRGBPoint(SIZE, 1.0, 1.0, 1.0)
        opacities.AddPoint(0.0, 1.0)
        volume.GetProperty().SetColor(colors)
        volume.GetProperty().SetScalarOpacity(opacities)
        camera = make_camera_along_y(SIZE / 2)
        picture = render_to_image(mapper, volume, camera, 60)
        expected = (np.arange(60) + 0.5) / 60
        self.assertLess(np.abs(picture[:, 30, 0] - expected).max(), 1.01 / 255)

    def test_clipping_planes(self):
        mapper, volume = make_cloud(make_grid(VTK_HEXAHEDRON, lambda p: 0.0), unit=4.0)
        plane = vtkPlane()
        plane.SetNormal(0.0, 1.0, 0.0)
        plane.SetOrigin(0.0, 4.0, 0.0)
        mapper.AddClippingPlane(plane)
        camera = make_camera_along_y()
        opacity = render_to_image(mapper, volume, camera)[..., 3]
        self.assertLess(np.abs(opacity - (1.0 - math.exp(-0.2 * 2.0 / 4.0))).max(), 0.51 / 255)

    def test_blocks_are_one_cloud(self):
        grid = make_grid(VTK_HEXAHEDRON, ball)
        _, volume = make_cloud(grid)
        mapper, _ = make_cloud(grid)
        expected = render_to_image(mapper, volume)
        centers = np.array([np.mean([grid.GetPoint(grid.GetCell(i).GetPointId(k)) for k in range(8)], axis=0)
                            for i in range(grid.GetNumberOfCells())])
        halves = numpy_to_vtk((centers[:, 0] + centers[:, 1] > SIZE).astype(np.uint8))
        halves.SetName("half")
        grid.GetCellData().AddArray(halves)
        blocks = vtkMultiBlockDataSet()
        for half in range(2):
            threshold = vtkThreshold()
            threshold.SetInputData(grid)
            threshold.SetInputArrayToProcess(0, 0, 0, 1, "half")
            threshold.SetLowerThreshold(half)
            threshold.SetUpperThreshold(half)
            threshold.Update()
            blocks.SetBlock(half, threshold.GetOutput())
        mapper.SetInputDataObject(blocks)
        self.assertLess(np.abs(render_to_image(mapper, volume) - expected).max(), 1.01 / 255)

    def test_several_connections(self):
        """Two clouds in each other: attenuations add up."""
        mapper, volume = make_cloud(make_grid(VTK_HEXAHEDRON, lambda p: 0.0), unit=4.0)
        own = vtkVolume()
        fill_property(own.GetProperty(), unit=2.0)
        producer = vtkTrivialProducer()
        producer.SetOutput(make_grid(VTK_WEDGE, lambda p: 0.0))
        mapper.AddInputConnection(producer.GetOutputPort())
        mapper.SetConnectionVolume(1, own)
        camera = make_camera_along_y()
        opacity = render_to_image(mapper, volume, camera)[..., 3]
        expected = 1.0 - math.exp(-0.2 * SIZE * (1 / 4.0 + 1 / 2.0))
        self.assertLess(np.abs(opacity - expected).max(), 1.01 / 255)

    def test_hidden_cells(self):
        grid = make_grid(VTK_HEXAHEDRON, lambda p: 0.0)
        ghosts = vtkUnsignedCharArray()
        ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
        for i in range(grid.GetNumberOfCells()):
            ghosts.InsertNextValue(vtkDataSetAttributes.HIDDENCELL if i // SIZE % SIZE < 2 else 0)
        grid.GetCellData().AddArray(ghosts)
        mapper, volume = make_cloud(grid, unit=4.0)
        camera = make_camera_along_y()
        opacity = render_to_image(mapper, volume, camera)[..., 3]
        self.assertLess(np.abs(opacity - (1.0 - math.exp(-0.2 * (SIZE - 2) / 4.0))).max(), 0.51 / 255)

    def test_smooth_edges_and_coarse_pictures(self):
        mapper, volume = make_cloud(make_structured_grid(ball))
        expected = render_to_image(mapper, volume)
        window = make_window(volume)
        for distance in (0.5, 3.0):
            mapper.SetImageSampleDistance(distance)
            picture = draw_in(window)
            self.assertLess(abs(picture.mean() / 255 - expected[..., :3].mean()), 0.02)

    def test_from_within(self):
        """The eye is in the cloud: what is behind it is not drawn."""
        mapper, volume = make_cloud(make_grid(VTK_TETRA, lambda p: 0.0), unit=2.0)
        camera = make_camera()
        camera.SetPosition(CENTER)
        camera.SetFocalPoint(CENTER[0], CENTER[1] + 1.0, CENTER[2])
        camera.SetViewAngle(10.0)
        camera.SetClippingRange(1e-3, 60.0)
        opacity = render_to_image(mapper, volume, camera)[..., 3]
        self.assertLess(abs(opacity[PIXELS // 2, PIXELS // 2] - (1.0 - math.exp(-0.2 * 3.0 / 2.0))), 1.01 / 255)


class TestDamage(unittest.TestCase):
    """What is not finite is left out; the rest is drawn as it is."""

    def setUp(self):
        self.expected = render_to_image(*make_cloud(make_grid(VTK_HEXAHEDRON, ball)))

    def test_images_have_no_cloud(self):
        """They are told so."""
        mesh = make_grid(VTK_HEXAHEDRON, ball)
        for data, count in ((make_waves(4), 1), (mesh, 0)):
            mapper, volume = make_cloud(data)
            hints = errors_of(mapper, lambda: render_to_image(mapper, volume), vtkCommand.WarningEvent)  # noqa: B023
            self.assertEqual(len(hints), count, hints)
            for hint in hints:
                self.assertIn("There is no cloud: images, rectilinear grids and AMR data have none", hint)

    def test_values_that_are_not_finite(self):
        for value in (math.nan, math.inf, -math.inf):
            with self.subTest(value):
                grid = make_grid(VTK_HEXAHEDRON, ball)
                grid.GetPointData().GetScalars().SetValue(0, value)
                picture = render_to_image(*make_cloud(grid))
                self.assertLess(np.mean(np.abs(picture - self.expected).max(axis=-1) > 1.01 / 255), 0.1)

    def test_points_that_are_not_finite(self):
        for value in (math.nan, math.inf):
            with self.subTest(value):
                grid = make_grid(VTK_HEXAHEDRON, ball)
                grid.GetPoints().SetPoint(0, value, 0.0, 0.0)
                picture = render_to_image(*make_cloud(grid))
                self.assertLess(np.mean(np.abs(picture - self.expected).max(axis=-1) > 1.01 / 255), 0.1)

    def test_extreme_values(self):
        picture = render_to_image(*make_cloud(make_grid(VTK_WEDGE, lambda p: 1e305 * (p[0] + 1.0))))
        highest = render_to_image(*make_cloud(make_grid(VTK_WEDGE, lambda p: 2.0)))
        self.assertTrue(np.array_equal(picture, highest))

    def test_sizes_and_places(self):
        """Pictures of what is far away and large or small are the same."""
        expected = render_to_image(*make_cloud(make_grid(VTK_TETRA, ball)))
        for scale, offset in ((1e-9, 0.0), (1e6, 0.0), (1.0, 1e7)):
            with self.subTest(scale=scale, offset=offset):
                grid, camera = make_grid(VTK_TETRA, ball), make_camera()
                for i in range(grid.GetNumberOfPoints()):
                    grid.GetPoints().SetPoint(i, *(scale * x + offset for x in grid.GetPoint(i)))
                camera.SetFocalPoint(*(scale * x + offset for x in camera.GetFocalPoint()))
                camera.SetPosition(*(scale * x + offset for x in camera.GetPosition()))
                camera.SetClippingRange(scale, 60.0 * scale)
                picture = render_to_image(*make_cloud(grid, unit=scale), camera)
                self.assertLess(np.abs(picture - expected).max(), 1.01 / 255)

    def test_cells_without_volume(self):
        grid = make_grid(VTK_HEXAHEDRON, ball)
        for i in range(grid.GetNumberOfPoints()):
            x, y, _ = grid.GetPoint(i)
            grid.GetPoints().SetPoint(i, x, y, 3.0)
        self.assertEqual(render_to_image(*make_cloud(grid)).max(), 0.0)


def make_components(shape, functions, dtype=np.float64):
    """A grid whose scalars have a component by each function of the points."""
    grid = make_grid(shape, lambda p: 0.0)
    points = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
    values = np.array([[function(point) for function in functions] for point in points])
    array = numpy_to_vtk(values.astype(dtype), deep=True)
    array.SetName("components")
    grid.GetPointData().SetScalars(array)
    return grid


WAVES = (
    lambda p: 0.5 + 0.5 * math.sin(1.1 * p[0] + 0.3 * p[1]),
    lambda p: 0.5 + 0.5 * math.cos(0.9 * p[1] - 0.4 * p[2]),
    lambda p: 0.5 + 0.5 * math.sin(0.7 * p[2] + 0.5 * p[0]),
    lambda p: 0.5 + 0.5 * math.cos(0.5 * sum(p)),
)


def make_mixture(grid, hues, mapper_class=vtkCellProjectionMapper):
    """Each component has a hue, an opacity and a unit distance of its own."""
    mapper, volume = make_cloud(grid, mapper_class)
    for i, hue in enumerate(hues):
        colors, opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
        # VTK's linear integrator knows the nodes of colours alone.
        for value, brightness, opacity in ((0.0, 0.2, 0.0), (0.6, 1.0, 0.3 + 0.05 * i), (1.0, 0.5, 0.1)):
            colors.AddRGBPoint(value, *(brightness * number for number in hue))
            opacities.AddPoint(value, opacity)
        volume.GetProperty().SetColor(i, colors)
        volume.GetProperty().SetScalarOpacity(i, opacities)
        volume.GetProperty().SetScalarOpacityUnitDistance(i, 1.0 + 0.3 * i)
    return mapper, volume


HUES = ((1.0, 0.2, 0.1), (0.1, 1.0, 0.2), (0.1, 0.3, 1.0), (1.0, 1.0, 0.1))


class TestComponents(unittest.TestCase):
    def check(self, volume, color, depth):
        """Everywhere, light of a colour through an optical depth."""
        picture = render_to_image(volume.GetMapper(), volume, make_camera_along_y())
        opacity = 1.0 - math.exp(-depth)
        for i, expected in enumerate((*(opacity * np.array(color)), opacity)):
            self.assertLess(np.abs(picture[..., i] - expected).max(), 0.51 / 255)

    def test_independent_components_of_one_value_each(self):
        """Attenuations are added; colours are weighted by them."""
        _, volume = make_mixture(make_components(VTK_WEDGE, (lambda p: 0.6, lambda p: 1.0)), HUES[:2])
        attenuations = np.array((0.3, 0.1 / 1.3))
        color = attenuations @ (np.array(HUES[:2]) * ((1.0,), (0.5,))) / attenuations.sum()
        self.check(volume, color, attenuations.sum() * SIZE)
        # Without one of them there is the other.
        volume.GetProperty().SetComponentWeight(0, 0.0)
        self.check(volume, 0.5 * np.array(HUES[1]), attenuations[1] * SIZE)

    def test_linear_components(self):
        """A closed form: where attenuations rise and fall, and their sum is the same."""
        grid = make_components(VTK_TETRA, (lambda p: p[1] / SIZE, lambda p: 1.0 - p[1] / SIZE))
        mapper, volume = make_cloud(grid)
        for i, color in enumerate(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))):
            colors, opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
            colors.AddRGBPoint(0.0, *color)
            opacities.AddPoint(0.0, 0.0)
            opacities.AddPoint(1.0, 1.0)
            volume.GetProperty().SetColor(i, colors)
            volume.GetProperty().SetScalarOpacity(i, opacities)
            volume.GetProperty().SetScalarOpacityUnitDistance(i, 3.0)
        depth = SIZE / 3.0
        picture = render_to_image(mapper, volume, make_camera_along_y())
        passed = math.exp(-depth)
        rising = (1.0 - passed * (1.0 + depth)) / depth  # of x exp(-depth x) depth, from 0 to 1
        for i, expected in enumerate((rising, 1.0 - passed - rising, 0.0, 1.0 - passed)):
            self.assertLess(np.abs(picture[..., i] - expected).max(), 0.51 / 255)

    def test_two_dependent_components(self):
        """The colour is that of the first, the opacity that of the second."""
        _, volume = make_cloud(make_components(VTK_PYRAMID, (lambda p: 1.0, lambda p: 0.5)))
        volume.GetProperty().IndependentComponentsOff()
        color = volume.GetProperty().GetRGBTransferFunction().GetColor(1.0)
        self.check(volume, color, volume.GetProperty().GetScalarOpacity().GetValue(0.5) * SIZE)

    def test_colors_and_an_opacity(self):
        """Of unsigned char up to 255, of others up to 1."""
        for dtype, largest in ((np.uint8, 255), (np.float32, 1.0), (np.int16, 1.0)):
            with self.subTest(dtype=dtype):
                parts = (1.0, 0.0, 0.0, 1.0) if dtype == np.int16 else (0.8, 0.4, 0.2, 0.6)
                functions = [lambda p, part=part: part * largest for part in parts]
                _, volume = make_cloud(make_components(VTK_HEXAHEDRON, functions, dtype), unit=5.0)
                volume.GetProperty().IndependentComponentsOff()
                self.check(volume, parts[:3], parts[3] * SIZE / 5.0)

    def test_ray_caster(self):
        """The pictures of VTK's ray caster, as for one component."""
        for count, are_independent in ((2, True), (4, True), (4, False)):
            with self.subTest(count=count, are_independent=are_independent):
                grid = make_components(VTK_TETRA, WAVES[:count], np.float32)
                _, volume = make_mixture(grid, HUES[:count])
                volume.GetProperty().SetIndependentComponents(are_independent)
                other, other_volume = make_cloud(grid, vtkUnstructuredGridVolumeRayCastMapper)
                other.SetRayIntegrator(vtkUnstructuredGridLinearRayIntegrator())
                other_volume.SetProperty(volume.GetProperty())
                picture = draw(volume, size=480)
                difference = np.abs(picture - draw(other_volume, size=480)).max(axis=-1)
                self.assertGreater(picture.max(), 150)
                self.assertLess(np.mean(difference), 1.5)
                self.assertLess(np.mean(difference > 6), 0.03)

    def test_arrays_of_any_kind(self):
        """Values of cells, and arrays that are not interleaved."""
        grid = make_components(VTK_HEXAHEDRON, (lambda p: 0.6, lambda p: 1.0))
        _, volume = make_mixture(grid, HUES[:2])
        expected = render_to_image(volume.GetMapper(), volume)
        apart = vtkSOADataArrayTemplate["float64"]()
        apart.SetNumberOfComponents(2)
        apart.SetNumberOfTuples(grid.GetNumberOfPoints())
        apart.CopyComponent(0, grid.GetPointData().GetScalars(), 0)
        apart.CopyComponent(1, grid.GetPointData().GetScalars(), 1)
        grid.GetPointData().SetScalars(apart)
        self.assertTrue(np.array_equal(render_to_image(volume.GetMapper(), volume), expected))
        of_cells = numpy_to_vtk(np.tile((0.6, 1.0), (grid.GetNumberOfCells(), 1)), deep=True)
        grid.GetPointData().SetScalars(None)
        grid.GetCellData().SetScalars(of_cells)
        self.assertTrue(np.array_equal(render_to_image(volume.GetMapper(), volume), expected))

    def test_one_component_of_several(self):
        """By the vector mode; and of the largest weight, for isosurfaces and the largest value."""
        several = make_components(VTK_TETRA, WAVES[:3])
        one = make_components(VTK_TETRA, WAVES[1:2])
        mapper, volume = make_cloud(several, low=0.0, high=1.0)
        mapper.SetVectorModeToComponent()
        mapper.SetVectorComponent(1)
        expected_mapper, expected_volume = make_cloud(one, low=0.0, high=1.0)
        expected = render_to_image(expected_mapper, expected_volume)
        self.assertTrue(np.array_equal(render_to_image(mapper, volume), expected))

        mapper.SetVectorModeToDisabled()
        for i in (0, 2):
            volume.GetProperty().SetComponentWeight(i, 0.5)
        fill_property(expected_volume.GetProperty(), low=0.0, high=1.0)
        volume.GetProperty().SetColor(1, expected_volume.GetProperty().GetRGBTransferFunction())
        volume.GetProperty().SetScalarOpacity(1, expected_volume.GetProperty().GetScalarOpacity())
        for either in (mapper, expected_mapper):
            either.SetBlendModeToMaximumIntensity()
        expected = render_to_image(expected_mapper, expected_volume)
        self.assertTrue(np.array_equal(render_to_image(mapper, volume), expected))

        for either, its_volume in ((mapper, volume), (expected_mapper, expected_volume)):
            either.SetBlendModeToComposite()
            either.DrawIsosurfacesOn()
            its_volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 0.5)
            its_volume.GetProperty().ShadeOff()
            for i in range(3):
                its_volume.GetProperty().SetScalarOpacityUnitDistance(i, 1e9)
        picture = render_to_image(mapper, volume)
        expected = render_to_image(expected_mapper, expected_volume)
        self.assertGreater(expected[..., 3].max(), 0.15)
        self.assertLess(np.abs(picture - expected).max(), 1.01 / 255)

    def test_blocks_and_changes(self):
        """Two blocks are one cloud; another number of components is another cloud."""
        whole = make_components(VTK_TETRA, WAVES[:2])
        mapper, volume = make_mixture(whole, HUES[:2])
        expected = render_to_image(mapper, volume)
        blocks = vtkMultiBlockDataSet()
        empty = make_components(VTK_TETRA, WAVES[:2])
        empty.SetPoints(whole.GetPoints())
        for number, grid in enumerate((whole, empty)):
            ghosts = np.arange(grid.GetNumberOfCells()) % 2 == number
            flags = numpy_to_vtk((ghosts * vtkDataSetAttributes.HIDDENCELL).astype(np.uint8), deep=True,
                                 array_type=vtkUnsignedCharArray().GetDataType())
            flags.SetName("vtkGhostType")
            grid.GetCellData().AddArray(flags)
            blocks.SetBlock(number, grid)
        mapper.SetInputDataObject(blocks)
        self.assertLess(np.abs(render_to_image(mapper, volume) - expected).max(), 1.01 / 255)
        three = make_components(VTK_TETRA, (*WAVES[:2], lambda p: 0.0))
        mapper.SetInputDataObject(three)
        opacities = vtkPiecewiseFunction()
        opacities.AddPoint(0.0, 0.0)
        volume.GetProperty().SetScalarOpacity(2, opacities)
        self.assertLess(np.abs(render_to_image(mapper, volume) - expected).max(), 1.01 / 255)

    def test_components_that_cannot_be_drawn(self):
        for count, are_independent, text in ((3, False, "IndependentComponentsOn"), (5, True, "SetVectorMode"),
                                             (5, False, "SetVectorMode")):
            with self.subTest(count=count, are_independent=are_independent):
                mapper, volume = make_cloud(make_components(VTK_TETRA, (WAVES + WAVES)[:count]))
                volume.GetProperty().SetIndependentComponents(are_independent)
                sphere = make_sphere(1.5)
                pictures = []
                errors = errors_of(mapper, lambda: pictures.append(draw(volume, sphere)))
                self.assertEqual(len(errors), 1)
                self.assertIn(text, errors[0])
                self.assertTrue(np.array_equal(pictures[0], draw(sphere)))

    def test_blocks_of_unlike_colors(self):
        mapper, volume = make_cloud(None)
        volume.GetProperty().IndependentComponentsOff()
        blocks = vtkMultiBlockDataSet()
        for number, dtype in enumerate((np.uint8, np.float32)):
            blocks.SetBlock(number, make_components(VTK_TETRA, WAVES, dtype))
        mapper.SetInputDataObject(blocks)
        errors = errors_of(
            mapper, lambda: mapper.RenderToImage(volume, make_camera(), None, 20, 20, vtkImageData()))
        self.assertIn("unsigned char", "".join(errors))


class TestUse(unittest.TestCase):
    def test_fragments_are_refused(self):
        mapper, volume = make_cloud(make_grid(VTK_TETRA, ball))
        errors = errors_of(
            mapper, lambda: mapper.RenderToFragments(volume, make_camera(), None, 20, 20, vtkTable()))
        self.assertIn("RenderToImage", "".join(errors))

    def test_it_is_never_opaque(self):
        mapper, volume = make_cloud(make_grid(VTK_TETRA, ball))
        mapper.DrawIsosurfacesOn()
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 1.0)
        volume.GetProperty().GetScalarOpacity().AddPoint(1.0, 1.0)
        self.assertFalse(mapper.HasOnlyOpaqueSurfaces(volume))

    def test_copies(self):
        mapper, volume = make_cloud(make_grid(VTK_TETRA, ball))
        mapper.DrawIsosurfacesOn()
        mapper.SetNumberOfThreads(3)
        other = vtkCellProjectionMapper()
        other.ShallowCopy(mapper)
        self.assertTrue(other.GetDrawIsosurfaces())
        self.assertEqual(other.GetNumberOfThreads(), 3)
        self.assertIn("DrawIsosurfaces: on", str(other))

    def test_picking_finds_the_isosurface(self):
        mapper, volume = make_cloud(make_grid(VTK_TETRA, ball))
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 0.5)
        window = make_window(volume)
        x, pcoords, normal = [0.0] * 3, [0.0] * 3, [0.0] * 3
        renderer = window.GetRenderers().GetFirstRenderer()
        for is_drawn in (False, True):
            mapper.SetDrawIsosurfaces(is_drawn)
            window.Render()
            found = mapper.PickPixel(
                renderer, volume, PIXELS // 2, PIXELS // 2, x, pcoords, reference(0), reference(0.0), normal)
            self.assertEqual(bool(found), is_drawn)

    def test_unit_distance_of_almost_nothing(self):
        mapper, volume = make_cloud(make_grid(VTK_TETRA, lambda p: 0.0), unit=1e-300)
        opacity = render_to_image(mapper, volume)[..., 3]
        self.assertEqual(opacity[PIXELS // 2, PIXELS // 2], 1.0)

    def test_no_input(self):
        mapper, volume = make_cloud(None)
        errors = errors_of(
            mapper, lambda: mapper.RenderToImage(volume, make_camera(), None, 20, 20, vtkImageData()))
        self.assertIn("vtkUnstructuredGrid", "".join(errors))


if __name__ == "__main__":
    unittest.main()
