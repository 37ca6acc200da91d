#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Make pictures of the mapper's features, without a window: gallery.py VOLUME.mhd ISOVALUE FOLDER"""

import os
import sys

from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import (
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPlane,
    vtkRectilinearGrid,
    vtkUniformGrid,
)
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkImagingCore import vtkExtractVOI, vtkImageReslice, vtkImageShrink3D, vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import vtkCamera, vtkLight, vtkLightCollection, vtkVolume
from vtkIsosurfaceRayTracing import vtkIsosurfacePicture, vtkIsosurfaceRayTraceMapper

from read_volume import read_volume
from whole_file import write_picture


class Picture:
    """A volume with one ivory isosurface, a camera that sees it from a corner, and a light."""

    def __init__(self, image, isovalue):
        self.mapper = vtkIsosurfaceRayTraceMapper()
        self.mapper.SetInputData(image)
        self.volume = vtkVolume()
        self.volume.SetMapper(self.mapper)
        self.surface = self.volume.GetProperty()
        self.surface.ShadeOn()
        self.surface.SetDiffuse(0.9)
        self.surface.GetIsoSurfaceValues().SetNumberOfContours(0)
        # A new property has functions from black to white.
        self.surface.GetRGBTransferFunction().RemoveAllPoints()
        self.surface.GetScalarOpacity().RemoveAllPoints()
        self.add_surface(isovalue, (0.96, 0.90, 0.80), 1.0)
        center, length = image.GetCenter(), image.GetLength()
        self.camera = vtkCamera()
        self.camera.SetFocalPoint(center)
        self.camera.SetPosition(
            center[0] - 0.85 * length, center[1] + 0.85 * length, center[2] + 0.25 * length)
        self.camera.SetViewUp(0.0, 0.0, 1.0)
        self.camera.SetClippingRange(0.3 * length, 3.0 * length)
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(0.5, 1.0, 1.0)
        self.lights = vtkLightCollection()
        self.lights.AddItem(light)

    def add_surface(self, isovalue, color, opacity):
        values = self.surface.GetIsoSurfaceValues()
        values.SetValue(values.GetNumberOfContours(), isovalue)
        self.surface.GetRGBTransferFunction().AddRGBPoint(isovalue, *color)
        self.surface.GetScalarOpacity().AddPoint(isovalue, opacity)

    def write(self, file_name, size):
        output = vtkImageData()
        self.mapper.RenderToImage(
            self.volume, self.camera, self.lights, size, size, output)
        transparent = vtkImageData()
        vtkIsosurfacePicture.UnpremultiplyColors(output, transparent)
        writer = vtkPNGWriter()
        writer.SetInputData(transparent)
        write_picture(writer, file_name)


def shadows(picture, image, isovalue):
    picture.mapper.ShadowsOn()


def occluded(picture, image, isovalue):
    picture.mapper.AmbientOcclusionOn()
    picture.surface.SetAmbient(0.7)
    picture.surface.SetDiffuse(0.4)


def translucent(picture, image, isovalue):
    low = image.GetScalarRange()[0]
    picture.add_surface(0.5 * (low + isovalue), (0.9, 0.55, 0.4), 0.35)


def clipped(picture, image, isovalue):
    plane = vtkPlane()
    plane.SetOrigin(image.GetCenter())
    plane.SetNormal(1.0, 0.3, 0.0)
    picture.mapper.AddClippingPlane(plane)


def capped(picture, image, isovalue):
    """The skin cut open, with a slice of the CT on the clipping plane."""
    low, high = image.GetScalarRange()
    skin = 0.5 * (low + isovalue)
    picture.add_surface(skin, (0.9, 0.65, 0.5), 1.0)
    function = picture.surface.GetRGBTransferFunction()
    function.AddRGBPoint(skin + 0.5 * (isovalue - skin), 0.25, 0.1, 0.1)
    function.AddRGBPoint(skin + 0.62 * (isovalue - skin), 0.75, 0.5, 0.45)
    function.AddRGBPoint(high, 1.0, 1.0, 1.0)
    plane = vtkPlane()
    plane.SetOrigin(image.GetCenter())
    plane.SetNormal(1.0, -0.4, -0.2)
    picture.mapper.AddClippingPlane(plane)
    picture.mapper.CapClippingPlanesOn()


def cropped(picture, image, isovalue):
    bounds, center = image.GetBounds(), image.GetCenter()
    picture.mapper.SetCroppingRegionPlanes(
        bounds[0], center[0], center[1], bounds[3], center[2], bounds[5])
    picture.mapper.SetCroppingRegionFlags(0x7FFFFFF & ~(1 << 13))  # all but the middle
    picture.mapper.CroppingOn()


def coloured(picture, image, isovalue):
    waves = vtkRTAnalyticSource()
    waves.Update()
    colors = vtkImageData()
    colors.ShallowCopy(waves.GetOutput())
    bounds, extent = image.GetBounds(), colors.GetExtent()
    spacing = [(bounds[2 * i + 1] - bounds[2 * i]) / (extent[2 * i + 1] - extent[2 * i])
               for i in range(3)]
    colors.SetSpacing(spacing)
    colors.SetOrigin([bounds[2 * i] - spacing[i] * extent[2 * i] for i in range(3)])
    picture.mapper.SetColorInputData(colors)
    function = picture.surface.GetRGBTransferFunction()
    function.RemoveAllPoints()
    low, high = colors.GetScalarRange()
    function.AddRGBPoint(low, 0.2, 0.3, 0.8)
    function.AddRGBPoint(0.5 * (low + high), 0.9, 0.9, 0.85)
    function.AddRGBPoint(high, 0.8, 0.2, 0.15)


def projected(picture, image, isovalue):
    picture.mapper.SetBlendModeToMaximumIntensity()
    low, high = 0.25 * isovalue, image.GetScalarRange()[1]
    function, opacity = picture.surface.GetRGBTransferFunction(), picture.surface.GetScalarOpacity()
    function.RemoveAllPoints()  # those of the surface
    opacity.RemoveAllPoints()
    function.AddRGBPoint(low, 0.3, 0.2, 0.1)
    function.AddRGBPoint(0.5 * high, 0.9, 0.8, 0.6)
    function.AddRGBPoint(high, 1.0, 1.0, 1.0)
    opacity.AddPoint(low, 0.0)
    opacity.AddPoint(0.5 * high, 1.0)


def cells(picture, image, isovalue):
    """A cell for every sample; a wedge of them is blanked."""
    grid = vtkUniformGrid()
    size = image.GetDimensions()
    grid.SetDimensions([count + 1 for count in size])
    grid.SetSpacing(image.GetSpacing())
    grid.SetOrigin([low - 0.5 * step
                    for low, step in zip(image.GetBounds()[::2], image.GetSpacing())])
    grid.GetCellData().SetScalars(image.GetPointData().GetScalars())
    for z in range(size[2]):
        for y in range(min(size[1], size[1] - z * size[1] // size[2])):
            for x in range(size[0] // 2):
                grid.BlankCell(x + size[0] * (y + size[1] * z))
    picture.mapper.SetInputData(grid)
    picture.mapper.SetScalarModeToUseCellData()


def rectilinear(picture, image, isovalue):
    """Fewer and fewer slices towards the top, with coordinates where the slices are."""
    size, samples = image.GetDimensions(), image.GetPointData().GetScalars()
    slices = [z for z in range(size[2]) if z < size[2] // 2 or z % (8 * z // size[2] - 2) == 0]
    if slices[-1] != size[2] - 1:
        slices.append(size[2] - 1)
    kept = samples.NewInstance()
    kept.SetNumberOfTuples(size[0] * size[1] * len(slices))
    for i, z in enumerate(slices):
        kept.InsertTuples(i * size[0] * size[1], size[0] * size[1], z * size[0] * size[1], samples)
    grid = vtkRectilinearGrid()
    grid.SetDimensions(size[0], size[1], len(slices))
    axes = (grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)
    for axis, (set_coordinates, planes) in enumerate(
            zip(axes, (range(size[0]), range(size[1]), slices))):
        coordinates = vtkDoubleArray()
        for i in planes:
            coordinates.InsertNextValue(
                image.GetBounds()[2 * axis] + i * image.GetSpacing()[axis])
        set_coordinates(coordinates)
    grid.GetPointData().SetScalars(kept)
    picture.mapper.SetInputDataObject(grid)


def blocks(picture, image, isovalue):
    """Eight blocks that share the points between them; one is missing."""
    extent = image.GetExtent()
    halves = [((extent[2 * axis], sum(extent[2 * axis:2 * axis + 2]) // 2),
               (sum(extent[2 * axis:2 * axis + 2]) // 2, extent[2 * axis + 1]))
              for axis in range(3)]
    pieces = vtkMultiBlockDataSet()
    for i in range(8):
        if i == 6:
            continue
        cut = vtkExtractVOI()
        cut.SetInputData(image)
        cut.SetVOI(halves[0][i & 1] + halves[1][i >> 1 & 1] + halves[2][i >> 2])
        cut.Update()
        pieces.SetBlock(i, cut.GetOutput())
    picture.mapper.SetInputDataObject(pieces)


def registered(picture, image, isovalue):
    """A second scan, coarser and turned. The matrix of its volume puts its skin around the bone."""
    turn = vtkTransform()
    turn.RotateZ(25.0)
    scan = vtkImageReslice()
    scan.SetInputData(image)
    scan.SetResliceTransform(turn)
    scan.AutoCropOutputOn()
    scan.SetOutputSpacing([3.0 * length for length in image.GetSpacing()])
    scan.SetBackgroundLevel(image.GetScalarRange()[0])
    picture.mapper.AddInputConnection(0, scan.GetOutputPort())
    volume = vtkVolume()
    volume.SetUserTransform(turn)
    skin = volume.GetProperty()
    skin.ShadeOn()
    skin.GetIsoSurfaceValues().SetValue(0, 0.5 * (image.GetScalarRange()[0] + isovalue))
    skin.GetRGBTransferFunction().RemoveAllPoints()
    skin.GetScalarOpacity().RemoveAllPoints()
    skin.GetRGBTransferFunction().AddRGBPoint(0.0, 0.3, 0.65, 1.0)
    skin.GetScalarOpacity().AddPoint(0.0, 0.25)
    skin.SetSpecular(0.5)
    skin.SetSpecularPower(40.0)
    picture.mapper.SetConnectionVolume(1, volume)


def boxes(picture, image, isovalue):
    """Of the means of 4 x 4 x 4 samples."""
    coarse = vtkImageShrink3D()
    coarse.SetInputData(image)
    coarse.SetShrinkFactors(4, 4, 4)
    picture.mapper.SetInputConnection(coarse.GetOutputPort())
    picture.mapper.SetInterpolationModeToNearest()


def near(picture, image, isovalue):
    """With the exact normals of the interpolant."""
    picture.camera.Zoom(8.0)
    picture.mapper.SetNormalModeToInterpolantGradient()


def cubic(picture, image, isovalue):
    near(picture, image, isovalue)
    picture.mapper.SetInterpolationModeToCubic()


SCENES = (
    shadows,
    occluded,
    translucent,
    clipped,
    capped,
    cropped,
    coloured,
    projected,
    cells,
    rectilinear,
    blocks,
    registered,
    boxes,
    near,
    cubic,
)


def write_all(image, isovalue, folder, size):
    os.makedirs(folder, exist_ok=True)
    for furnish in SCENES:
        picture = Picture(image, isovalue)
        furnish(picture, image, isovalue)
        file_name = os.path.join(folder, furnish.__name__ + ".png")
        picture.write(file_name, size)
        print(file_name)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    volume_file, isovalue, folder = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    write_all(read_volume(volume_file), isovalue, folder, 960)


if __name__ == "__main__":
    main()
