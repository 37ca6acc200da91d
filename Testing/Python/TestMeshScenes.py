#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""An image and the mesh of its voxels have one field, and so one picture, in every kind of scene."""

import unittest

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPlane
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkLight,
    vtkLODProp3D,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
)
from vtkmodules.vtkRenderingOpenGL2 import vtkEDLShading, vtkRenderStepsPass
from vtkIsosurfaceRayTracing import (
    vtkIsosurfacePicker,
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
    def test_means_of_data_far_away_start_again(self):
        """A pan by a quarter of a pixel, which is little beside the coordinates."""
        mesh, far = make_mesh(), (5e6, 5e6, 0.0)
        move = vtkTransform()
        move.Translate(far)
        points = vtkPoints()
        points.SetDataTypeToDouble()
        move.TransformPoints(mesh.GetPoints(), points)
        mesh.SetPoints(points)
        scene = Scene(vtkIsosurfaceRayTraceMeshMapper(), mesh, vtkVolume())
        scene.mapper.ProgressiveAccumulationOn()
        scene.camera.ParallelProjectionOn()
        scene.camera.Zoom(3.0)  # The data fill the window before and after.
        # Lights of the camera would move with it.
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(5e6, 5e6, 100.0)
        light.SetFocalPoint(far)
        scene.renderer.AddLight(light)
        for expected in (1, 2, 3):
            scene.window.Render()
            self.assertEqual(scene.mapper.GetNumberOfAccumulatedFrames(), expected)
        step = 0.25 * 2.0 * scene.camera.GetParallelScale() / PIXELS
        scene.camera.SetPosition([x + step for x in scene.camera.GetPosition()])
        scene.camera.SetFocalPoint([x + step for x in scene.camera.GetFocalPoint()])
        scene.window.Render()
        self.assertEqual(scene.mapper.GetNumberOfAccumulatedFrames(), 1)

    def test_picks_of_levels_of_detail(self):
        """They are those of the volume that is drawn."""
        for mapper, data in ((vtkIsosurfaceRayTraceMapper(), make_image()), (vtkIsosurfaceRayTraceMeshMapper(), make_mesh())):
            scene = Scene(mapper, data, vtkVolume())
            levels = vtkLODProp3D()
            levels.AddLOD(mapper, scene.surface, 0.0)
            picks = []
            for prop in (scene.volume, levels):
                prop.SetPosition(2.0, 0.0, 1.0)
                prop.SetScale(-1.0, 1.0, 1.5)
                scene.renderer.RemoveAllViewProps()
                scene.renderer.AddViewProp(prop)
                scene.renderer.ResetCamera()
                scene.window.Render()
                picker = vtkIsosurfacePicker()
                picks.append([(picker.Pick(x, 60, 0, scene.renderer), picker.GetPickPosition(), picker.GetCellId(), picker.GetIsovalue())
                              for x in range(40, 80, 5)])
            self.assertEqual(picks[0], picks[1])
            self.assertTrue(all(pick[0] for pick in picks[0]))

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
