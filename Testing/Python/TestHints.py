#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A picture that does not show what was meant comes with one warning that says why; others with none."""

import math
import unittest
from functools import partial

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkDataObject, vtkDataSetAttributes, vtkImageData, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer, vtkRenderWindow, vtkVolume
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the window
from vtkIsosurfaceRayTracing import vtkCellProjectionMapper, vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper

from MeshTesting import ball, errors_of, make_grid, make_volume
from PictureTesting import make_waves

NO_SURFACE = r"There is no surface: the scalars of the input are from 34\.\d+ to 286\.\d+"


def make_scene(data, isovalue, mapper_class=vtkIsosurfaceRayTraceMapper):
    mapper, volume = make_volume(data, isovalue, mapper_class=mapper_class)
    renderer = vtkRenderer()
    renderer.AddVolume(volume)
    renderer.ResetCamera()
    return mapper, volume, renderer


def warnings_of(mapper, call):
    return errors_of(mapper, call, vtkCommand.WarningEvent)


class TestHints(unittest.TestCase):
    def draw(self, mapper, volume, renderer):
        """In a window and without one. Returns the warnings of the first, and checks those of the second."""
        window = vtkRenderWindow()
        window.SetOffScreenRendering(True)
        window.SetSize(60, 60)
        window.AddRenderer(renderer)
        warnings = warnings_of(mapper, lambda: (window.Render(), window.Render()))
        image = vtkImageData()
        self.assertEqual(warnings_of(
            mapper, lambda: mapper.RenderToImage(volume, renderer.GetActiveCamera(), None, 60, 60, image)), [])
        window.RemoveRenderer(renderer)
        return warnings

    def check(self, scene, expected):
        warnings = self.draw(*scene)
        self.assertEqual(len(warnings), 1)
        self.assertRegex(warnings[0], expected)

    def test_isovalue_outside_the_scalars(self):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, make_waves())
        for data in (make_waves(), blocks):
            for isovalue in (20.0, 300.0):
                self.check(make_scene(data, isovalue), NO_SURFACE)
        mesh = make_grid(VTK_TETRA, ball)
        self.check(make_scene(mesh, 100.0, vtkIsosurfaceRayTraceMeshMapper), "There is no surface")

    def test_scalars_without_a_range(self):
        for value, expected in ((0.5, "all scalars of the input are 0.5"), (-0.0, r"all scalars of the input are 0\."),
                                (math.nan, "no scalar of the input is a number")):  # fmt: skip
            image = make_waves()
            image.GetPointData().GetScalars().Fill(value)
            self.check(make_scene(image, 0.5), expected)
            mesh = make_grid(VTK_TETRA, lambda point, value=value: value)
            self.check(make_scene(mesh, 0.5, vtkIsosurfaceRayTraceMeshMapper), expected)

    def test_it_is_said_again_after_a_surface(self):
        mapper, volume, renderer = make_scene(make_waves(), 300.0)
        isovalues = volume.GetProperty().GetIsoSurfaceValues()
        for isovalue, count in ((300.0, 1), (310.0, 0), (150.0, 0), (320.0, 1)):
            isovalues.SetValue(0, isovalue)
            self.assertEqual(len(self.draw(mapper, volume, renderer)), count)

    def test_once_for_each_volume(self):
        """Whether or not another one, of the same mapper, shows what was meant."""
        mapper, volume, renderer = make_scene(make_waves(), 150.0)
        other = vtkVolume()
        other.SetMapper(mapper)
        other.GetProperty().GetIsoSurfaceValues().SetValue(0, 300.0)
        renderer.AddVolume(other)
        window = vtkRenderWindow()
        window.SetOffScreenRendering(True)
        window.SetSize(60, 60)
        window.AddRenderer(renderer)
        warnings = warnings_of(mapper, lambda: [window.Render() for _ in range(4)])
        self.assertEqual(len(warnings), 1)
        self.assertRegex(warnings[0], NO_SURFACE)

    def test_one_of_two_isovalues_suffices(self):
        scene = make_scene(make_waves(), 300.0)
        scene[1].GetProperty().GetIsoSurfaceValues().SetValue(1, 150.0)
        self.assertEqual(self.draw(*scene), [])

    def test_pieces_of_others_may_have_no_surface(self):
        image = make_waves()
        image.AllocateCellGhostArray()
        image.GetCellGhostArray().SetValue(7, vtkDataSetAttributes.DUPLICATECELL)
        self.assertEqual(self.draw(*make_scene(image, 300.0)), [])
        mesh = make_grid(VTK_TETRA, ball)
        for pieces, count in ((2, 0), (1, 1)):
            mesh.GetInformation().Set(vtkDataObject.DATA_NUMBER_OF_PIECES(), pieces)
            scene = make_scene(mesh, 100.0, vtkIsosurfaceRayTraceMeshMapper)
            self.assertEqual(len(self.draw(*scene)), count)

    def test_nothing_that_was_asked_for(self):
        mapper, volume, renderer = make_scene(make_waves(), 300.0)
        volume.GetProperty().GetIsoSurfaceValues().SetNumberOfContours(0)
        self.assertEqual(self.draw(mapper, volume, renderer), [])
        mapper.SetBlendModeToMaximumIntensity()
        self.assertEqual(self.draw(mapper, volume, renderer), [])

    def test_shadows_without_shading(self):
        for switch in ("ShadowsOn", "AmbientOcclusionOn"):
            mapper, volume, renderer = make_scene(make_waves(), 150.0)
            getattr(mapper, switch)()
            volume.GetProperty().ShadeOff()
            self.check((mapper, volume, renderer), r"call ShadeOn\(\)")
            volume.GetProperty().ShadeOn()
            self.assertEqual(self.draw(mapper, volume, renderer), [])

    def test_occlusion_without_ambient_light(self):
        mapper, volume, renderer = make_scene(make_waves(), 150.0)
        mapper.AmbientOcclusionOn()
        volume.GetProperty().SetAmbient(0.0)
        volume.GetProperty().ShadeOn()
        self.check((mapper, volume, renderer), r"call SetAmbient\(0\.5\)")
        volume.GetProperty().SetAmbient(0.5)
        self.assertEqual(self.draw(mapper, volume, renderer), [])

    def test_no_light(self):
        for intensities in ((), (0.0,), (0.0, 0.0)):
            mapper, volume, renderer = make_scene(make_waves(), 150.0)
            scene = mapper, volume, renderer
            shading = volume.GetProperty()
            shading.ShadeOn()
            renderer.AutomaticLightCreationOff()  # as in ParaView
            for intensity in intensities:
                light = vtkLight()
                light.SetIntensity(intensity)
                renderer.AddLight(light)
            self.check(scene, r"Call AddLight\(\)")
            camera, lights, image = renderer.GetActiveCamera(), renderer.GetLights(), vtkImageData()
            warnings = warnings_of(mapper, partial(mapper.RenderToImage, volume, camera, lights, 60, 60, image))
            self.assertEqual(len(warnings), 1)
            shading.ShadeOff()
            self.assertEqual(self.draw(*scene), [])
            shading.ShadeOn()
            mapper.AmbientOcclusionOn()
            self.assertEqual(self.draw(*scene), [])
            mapper.AmbientOcclusionOff()
            self.check(scene, r"Call AddLight\(\)")
            renderer.AddLight(vtkLight())
            self.assertEqual(self.draw(*scene), [])

    def test_no_light_that_matters(self):
        """Without light a picture is dark only of what reflects some: surfaces, or a cloud."""
        mesh = make_grid(VTK_TETRA, ball)
        for mapper_class in (vtkIsosurfaceRayTraceMeshMapper, vtkCellProjectionMapper):
            mapper, volume, renderer = make_scene(mesh, 2.0, mapper_class)
            renderer.AutomaticLightCreationOff()
            material = volume.GetProperty()
            material.ShadeOn()
            for diffuse, specular, count in ((0.0, 0.0, 0), (0.7, 0.0, 1), (0.0, 0.0, 0), (0.0, 0.2, 1)):
                material.SetDiffuse(diffuse)
                material.SetSpecular(specular)
                with self.subTest(mapper_class.__name__, diffuse=diffuse, specular=specular):
                    warnings = self.draw(mapper, volume, renderer)
                    self.assertEqual(len(warnings), count)
                    self.assertTrue(all("No light is on" in warning for warning in warnings))
            material.ShadeOff()
            self.assertEqual(self.draw(mapper, volume, renderer), [])
        material.ShadeOn()
        mapper.SetBlendModeToMaximumIntensity()  # of a cloud, which is not shaded
        self.assertEqual(self.draw(mapper, volume, renderer), [])

    def test_components_that_reflect_light(self):
        """Of a cloud of two, one is enough; that of no other number is asked."""
        mesh = make_grid(VTK_TETRA, ball)
        values = vtk_to_numpy(mesh.GetPointData().GetScalars())
        mesh.GetPointData().SetScalars(numpy_to_vtk(np.stack([values, values], axis=1), deep=True))
        mapper, volume, renderer = make_scene(mesh, 2.0, vtkCellProjectionMapper)
        renderer.AutomaticLightCreationOff()
        material = volume.GetProperty()
        for component in range(4):
            material.SetShade(component, 0)
        for component, count in ((0, 1), (1, 1), (2, 0)):
            material.SetShade(component, 1)
            self.assertEqual(len(self.draw(mapper, volume, renderer)), count)
            material.SetShade(component, 0)
            self.assertEqual(self.draw(mapper, volume, renderer), [])

    def test_camera_that_sees_nothing(self):
        mapper, volume, renderer = make_scene(make_waves(), 150.0)
        camera = renderer.GetActiveCamera()
        position = camera.GetPosition()
        image = vtkImageData()

        def render():
            return warnings_of(mapper, lambda: self.assertTrue(mapper.RenderToImage(volume, camera, None, 60, 60, image)))

        self.assertEqual(render(), [])
        camera.SetClippingRange(0.01, 10.0)
        self.assertRegex(render()[0], r"vtkRenderer::ResetCamera\(bounds\)")
        self.assertEqual(render(), [])
        renderer.ResetCameraClippingRange()
        self.assertEqual(render(), [])
        camera.SetFocalPoint([2.0 * x for x in position])
        self.assertEqual(len(render()), 1)
        # The remedy, in an application that has no window.
        vtkRenderer.ResetCamera(renderer, mapper.GetBounds())
        self.assertEqual(render(), [])

    def test_input_of_another_kind(self):
        mapper, volume, renderer = make_scene(vtkPolyData(), 150.0)
        errors = errors_of(mapper, lambda: mapper.RenderToImage(
            volume, renderer.GetActiveCamera(), None, 60, 60, vtkImageData()))
        self.assertRegex(errors[0], "The input is a vtkPolyData. Give a")


if __name__ == "__main__":
    unittest.main()
