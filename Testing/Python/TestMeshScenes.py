#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""An image and the mesh of its voxels have one field, and so one picture, in every kind of scene."""

import unittest

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPlane
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkLight,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
)
from vtkmodules.vtkRenderingOpenGL2 import vtkEDLShading, vtkRenderStepsPass
from vtkIsosurfaceRayTracing import (
    vtkIsosurfaceRayTraceMapper,
    vtkIsosurfaceRayTraceMeshMapper,
    vtkIsosurfaceVolume,
)

from MeshTesting import SIZE, ball, set_values
from PictureTesting import capture

PIXELS = 120


def make_image():
    image = vtkImageData()
    image.SetDimensions(2 * SIZE + 1, 2 * SIZE + 1, 2 * SIZE + 1)
    image.SetSpacing(0.5, 0.5, 0.5)
    return set_values(image, ball)


def make_mesh():
    append = vtkAppendFilter()
    append.AddInputData(make_image())
    append.Update()
    return append.GetOutput()


def add_actor(renderer, source, opacity=1.0):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.3, 0.6, 1.0)
    actor.GetProperty().SetOpacity(opacity)
    renderer.AddActor(actor)


class Scene:
    """A ball in a window, drawn by a mapper."""

    def __init__(self, mapper, data, volume):
        self.mapper = mapper
        mapper.SetInputData(data)
        mapper.AutoAdjustSampleDistancesOff()
        self.volume = volume
        self.volume.SetMapper(mapper)
        self.surface = self.volume.GetProperty()
        self.surface.ShadeOn()
        self.add_surface(0.0, (0.9, 0.7, 0.5), 1.0)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0.1, 0.1, 0.2)
        self.renderer.AddVolume(self.volume)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetPosition(1.0, 0.6, 0.8)
        self.renderer.ResetCamera()
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(PIXELS, PIXELS)
        self.window.AddRenderer(self.renderer)

    def add_surface(self, isovalue, color, opacity):
        self.surface.GetIsoSurfaceValues().SetValue(
            0 if isovalue == 0.0 else self.surface.GetIsoSurfaceValues().GetNumberOfContours(), isovalue)
        self.surface.GetRGBTransferFunction().AddRGBPoint(isovalue, *color)
        self.surface.GetScalarOpacity().AddPoint(isovalue, opacity)

    def picture(self):
        self.window.Render()
        return capture(self.window)


# What scenes have, by name -----------------------------------------------------------------------
def plain(scene):
    """One opaque surface."""


def exact_normals(scene):
    scene.mapper.SetNormalModeToInterpolantGradient()


def translucent(scene):
    scene.add_surface(-0.6, (0.4, 0.9, 0.6), 0.4)
    scene.add_surface(0.5, (1.0, 0.2, 0.2), 1.0)


def lights(scene):
    translucent(scene)
    for color, position in (((1.0, 0.3, 0.2), (9.0, 4.0, 3.0)), ((0.2, 0.5, 1.0), (1.0, 9.0, 8.0))):
        light = vtkLight()
        light.PositionalOn()
        light.SetConeAngle(60.0)
        light.SetPosition(position)
        light.SetFocalPoint(3.0, 3.0, 3.0)
        light.SetColor(color)
        scene.renderer.AddLight(light)


def shadows(scene):
    lights(scene)
    scene.mapper.ShadowsOn()


def clipped(scene):
    translucent(scene)
    for origin, normal in (((3.0, 3.0, 3.3), (-0.5, -0.3, -0.6)), ((2.5, 3.0, 3.0), (0.2, 1.0, 0.1))):
        plane = vtkPlane()
        plane.SetOrigin(origin)
        plane.SetNormal(normal)
        scene.mapper.AddClippingPlane(plane)


def capped(scene):
    clipped(scene)
    scene.mapper.CapClippingPlanesOn()


def capped_with_shadows(scene):
    capped(scene)
    scene.surface.SetAmbient(0.4)
    scene.mapper.ShadowsOn()
    scene.mapper.AmbientOcclusionOn()


def turned(scene):
    translucent(scene)
    scene.volume.SetScale(1.3, -0.8, 0.6)
    scene.volume.RotateX(33.0)
    scene.renderer.ResetCamera()


def parallel_camera(scene):
    scene.camera.ParallelProjectionOn()
    scene.camera.Zoom(1.5)


def inside(scene):
    scene.camera.SetPosition(3.0, 3.0, 2.9)
    scene.camera.SetFocalPoint(4.0, 3.5, 3.2)
    scene.renderer.ResetCameraClippingRange()


def polygons(scene):
    """An opaque sphere that is partly inside."""
    sphere = vtkSphereSource()
    sphere.SetCenter(4.5, 3.5, 4.0)
    sphere.SetRadius(1.5)
    add_actor(scene.renderer, sphere)


def translucent_polygons(scene):
    plane = vtkPlaneSource()
    plane.SetOrigin(0.0, 0.0, 3.5)
    plane.SetPoint1(6.0, 0.0, 3.5)
    plane.SetPoint2(0.0, 6.0, 3.5)
    add_actor(scene.renderer, plane, 0.5)
    scene.renderer.UseDepthPeelingOn()


def ssao(scene):
    scene.renderer.UseSSAOOn()
    scene.renderer.SetSSAORadius(2.0)


def eye_dome_lighting(scene):
    shading = vtkEDLShading()
    shading.SetDelegatePass(vtkRenderStepsPass())
    scene.renderer.SetPass(shading)


def stereo(scene):
    scene.window.SetStereoTypeToAnaglyph()
    scene.window.StereoRenderOn()


def coarse(scene):
    scene.mapper.SetImageSampleDistance(3.0)


def smooth_edges(scene):
    scene.mapper.SetImageSampleDistance(0.5)


def accumulated(scene):
    scene.mapper.ProgressiveAccumulationOn()
    for _ in range(3):
        scene.window.Render()
    assert scene.mapper.GetNumberOfAccumulatedFrames() == 3


SCENES = (plain, exact_normals, translucent, lights, shadows, clipped, capped, capped_with_shadows, turned,
          parallel_camera, inside, polygons, translucent_polygons, ssao, eye_dome_lighting, stereo, coarse,
          smooth_edges, accumulated)  # fmt: skip


class TestMeshScenes(unittest.TestCase):
    def test_pictures(self):
        image, mesh = make_image(), make_mesh()
        for volume_class in (vtkVolume, vtkIsosurfaceVolume):
            unfurnished = None
            for furnish in SCENES:
                with self.subTest(furnish.__name__, volume=volume_class.__name__):
                    pictures = []
                    for mapper, data in ((vtkIsosurfaceRayTraceMapper(), image),
                                         (vtkIsosurfaceRayTraceMeshMapper(), mesh)):  # fmt: skip
                        scene = Scene(mapper, data, volume_class())
                        furnish(scene)
                        pictures.append(scene.picture())
                    one, other = pictures
                    different = sum(abs(a - b) > 2 for a, b in zip(one, other))
                    self.assertLess(different, 0.001 * len(one))
                    if furnish is plain:
                        unfurnished = one
                        self.assertGreater(len(set(one)), 50)
                    elif furnish is not ssao or volume_class is vtkIsosurfaceVolume:
                        self.assertTrue(one != unfurnished)


if __name__ == "__main__":
    unittest.main()
