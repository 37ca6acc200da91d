#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draw isosurfaces in scenes of VTK: scenes.py VOLUME.mhd ISOVALUE FOLDER"""

import os
import sys

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D
from vtkmodules.vtkFiltersSources import vtkArrowSource, vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)
from vtkmodules.vtkRenderingOpenGL2 import vtkEDLShading, vtkRenderStepsPass
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkSmartVolumeMapper
from vtkIsosurfaceRayTracing import (
    vtkIsosurfacePicker,
    vtkIsosurfaceRayTraceFactory,
    vtkIsosurfaceRayTraceMapper,
    vtkIsosurfaceVolume,
)

from read_volume import read_volume
from whole_file import write_picture


class Scene:
    """A window that shows an ivory isosurface as opaque geometry, seen from a corner."""

    def __init__(self, image, isovalue, size):
        self.image = image
        mapper = vtkIsosurfaceRayTraceMapper()
        mapper.SetInputData(image)
        self.volume = vtkIsosurfaceVolume()
        self.volume.SetMapper(mapper)
        surface = self.volume.GetProperty()
        surface.ShadeOn()
        surface.SetDiffuse(0.9)
        surface.GetIsoSurfaceValues().SetValue(0, isovalue)
        colors, opacities = surface.GetRGBTransferFunction(), surface.GetScalarOpacity()
        colors.RemoveAllPoints()  # A new property has functions from black to white.
        opacities.RemoveAllPoints()
        colors.AddRGBPoint(isovalue, 0.96, 0.90, 0.80)
        opacities.AddPoint(isovalue, 1.0)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0.16, 0.18, 0.22)
        self.renderer.AddVolume(self.volume)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(-0.5, 1.1, 0.35)
        camera.SetViewUp(0.0, 0.0, 1.0)
        self.renderer.ResetCamera()
        camera.Zoom(1.5)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(size, size)
        self.window.AddRenderer(self.renderer)

    def add_screen(self, fraction, color):
        """A translucent square across y, at a fraction of the volume's bounds."""
        bounds = self.image.GetBounds()
        y = bounds[2] + fraction * (bounds[3] - bounds[2])
        middle = 0.5 * (bounds[4] + bounds[5])
        plane = vtkPlaneSource()
        plane.SetOrigin(bounds[0], y, bounds[4])
        plane.SetPoint1(bounds[1], y, bounds[4])
        plane.SetPoint2(bounds[0], y, middle)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(plane.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetColor(color)
        actor.GetProperty().SetOpacity(0.4)
        self.renderer.AddActor(actor)

    def write(self, file_name):
        self.window.Render()
        picture = vtkWindowToImageFilter()
        picture.SetInput(self.window)
        picture.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetInputConnection(picture.GetOutputPort())
        write_picture(writer, file_name)


def translucent_polygons(scene):
    scene.add_screen(0.2, (0.3, 0.5, 1.0))
    scene.add_screen(0.5, (0.3, 0.9, 0.4))
    scene.add_screen(1.1, (1.0, 0.4, 0.3))
    scene.renderer.UseDepthPeelingOn()
    scene.renderer.SetMaximumNumberOfPeels(10)
    scene.renderer.ResetCameraClippingRange()


def ambient_occlusion(scene):
    scene.renderer.UseSSAOOn()
    scene.renderer.SetSSAORadius(0.1 * scene.image.GetLength())
    scene.renderer.SetSSAOKernelSize(128)
    scene.renderer.SSAOBlurOn()


def eye_dome_lighting(scene):
    shading = vtkEDLShading()
    shading.SetDelegatePass(vtkRenderStepsPass())
    scene.renderer.SetPass(shading)


def anaglyph(scene):
    scene.window.SetStereoTypeToAnaglyph()
    scene.window.StereoRenderOn()


def smart_mapper(scene):
    vtkIsosurfaceRayTraceFactory.SwitchOn()
    mapper = vtkSmartVolumeMapper()
    mapper.SetInputData(scene.image)
    mapper.SetBlendModeToIsoSurface()
    mapper.SetRequestedRenderModeToOSPRay()
    scene.volume.SetMapper(mapper)


def at_rest(scene):
    scene.volume.GetProperty().SetAmbient(0.6)
    scene.volume.GetProperty().SetDiffuse(0.3)
    mapper = scene.volume.GetMapper()
    mapper.AmbientOcclusionOn()
    mapper.SetNumberOfAmbientOcclusionRays(8)
    mapper.ProgressiveAccumulationOn()
    while mapper.GetNumberOfAccumulatedFrames() < mapper.GetMaximumNumberOfAccumulatedFrames():
        scene.window.Render()


def coarse(scene):
    """A ray for every 4 x 4 pixels, as while interacting with a large volume."""
    scene.volume.GetMapper().AutoAdjustSampleDistancesOff()
    scene.volume.GetMapper().SetImageSampleDistance(4.0)


def smooth_edges(scene):
    """3 x 3 rays for every pixel."""
    scene.volume.GetMapper().AutoAdjustSampleDistancesOff()
    scene.volume.GetMapper().SetImageSampleDistance(1.0 / 3.0)


def picked(scene):
    """An arrow at each picked point, along the normal of the surface."""
    scene.window.Render()
    points, normals = vtkPoints(), vtkDoubleArray()
    normals.SetNumberOfComponents(3)
    picker = vtkIsosurfacePicker()
    size = scene.window.GetSize()[0]
    step = size // 12
    for y in range(step // 2, size, step):
        for x in range(step // 2, size, step):
            if picker.Pick(x, y, 0.0, scene.renderer):
                points.InsertNextPoint(picker.GetPickPosition())
                normals.InsertNextTuple(picker.GetPickNormal())
    picks = vtkPolyData()
    picks.SetPoints(points)
    picks.GetPointData().SetNormals(normals)
    arrow = vtkArrowSource()
    arrows = vtkGlyph3D()
    arrows.SetInputData(picks)
    arrows.SetSourceConnection(arrow.GetOutputPort())
    arrows.SetVectorModeToUseNormal()
    arrows.SetScaleModeToDataScalingOff()
    arrows.SetScaleFactor(0.08 * scene.image.GetLength())
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(arrows.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.9, 0.3, 0.2)
    scene.renderer.AddActor(actor)


SCENES = (
    translucent_polygons,
    ambient_occlusion,
    eye_dome_lighting,
    anaglyph,
    smart_mapper,
    at_rest,
    coarse,
    smooth_edges,
    picked,
)


def write_all(image, isovalue, folder, size):
    os.makedirs(folder, exist_ok=True)
    for furnish in SCENES:
        scene = Scene(image, isovalue, size)
        furnish(scene)
        file_name = os.path.join(folder, furnish.__name__ + ".png")
        scene.write(file_name)
        print(file_name)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    volume_file, isovalue, folder = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    write_all(read_volume(volume_file), isovalue, folder, 960)


if __name__ == "__main__":
    main()
