# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of all that the gallery shows, of what it leaves out, and of these together."""

import functools
import itertools
import os
import sys

from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_FLOAT, VTK_UNSIGNED_CHAR, reference
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkImageData, vtkPlane
from vtkmodules.vtkImagingCore import vtkImageShiftScale, vtkRTAnalyticSource
from vtkmodules.vtkImagingGeneral import vtkImageGradient
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer, vtkRenderWindow

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                "../../Examples/Python"))
import gallery
from mapper_settings import SOLVERS, apply_settings
from volumes import (
    INTEGER_RANGES,
    get_point_arrays,
    make_array,
    make_rectilinear,
    make_volumes,
)

SIZE = (157, 118)  # not a multiple of the size of tiles
ISOVALUE = 150.0


class PictureScene(gallery.Picture):
    """What furnishings make of a picture, one after the other, as in the gallery."""

    def __init__(self, image, isovalue, *furnishings):
        super().__init__(image, isovalue)
        for furnish in furnishings:
            furnish(self, image, isovalue)

    def record(self):
        output = vtkImageData()
        if not self.mapper.RenderToImage(self.volume, self.camera, self.lights, *SIZE, output):
            raise RuntimeError("There is no picture.")
        return get_point_arrays(output)


class PickScene(PictureScene):
    """What is found at some pixels of the picture in a window, without drawing it."""

    def record(self):
        renderer = vtkRenderer()
        renderer.SetActiveCamera(self.camera)
        window = vtkRenderWindow()
        window.SetSize(SIZE)
        window.AddRenderer(renderer)
        picks = []
        for row, column in itertools.product(range(0, SIZE[1], 7), range(0, SIZE[0], 7)):
            cell_id, isovalue = reference(-1), reference(-1.0)
            point, parametric, normal = [0.0] * 3, [0.0] * 3, [0.0] * 3
            self.mapper.PickPixel(renderer, self.volume, column, row, point, parametric, cell_id,
                                  isovalue, normal)
            picks += [*point, *parametric, cell_id.get(), isovalue.get(), *normal]
        return {"Picks": make_array(VTK_DOUBLE, picks, 11)}


def make_waves(x, y, z):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-x, x, -y, y, -z, z)
    source.Update()
    return source.GetOutput()


def plain(picture, image, isovalue):
    """One opaque isosurface."""


def with_settings(**settings):
    return lambda picture, image, isovalue: apply_settings(picture.mapper, settings)


# The data: other samples, or the same at another position.


def turned(picture, image, isovalue):
    """With an axis that runs backwards, and far from the origin."""
    data = vtkImageData()
    data.ShallowCopy(image)
    data.SetSpacing(1.0, -0.9, 1.1)
    data.SetOrigin(1e5, -2e5, 3e4)
    data.SetDirectionMatrix(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6)
    picture.mapper.SetInputData(data)
    center = data.GetCenter()
    shift = [a - b for a, b in zip(center, picture.camera.GetFocalPoint())]
    picture.camera.SetPosition([a + b for a, b in zip(picture.camera.GetPosition(), shift)])
    picture.camera.SetFocalPoint(center)


def uneven(picture, image, isovalue):
    """Every third plane is twice as far, and some cells are flat."""
    coordinates = []
    for axis, count in enumerate(image.GetDimensions()):
        planes, position = [], image.GetBounds()[2 * axis]
        for i in range(count):
            planes.append(position)
            position += (0.0 if i == 10 else 2.0 if i % 3 == 0 else 0.5) * image.GetSpacing()[axis]
        coordinates.append(planes)
    picture.mapper.SetInputDataObject(
        make_rectilinear(coordinates, image.GetPointData().GetScalars()))


def hidden_points(picture, image, isovalue):
    data = vtkImageData()
    data.ShallowCopy(image)
    ghosts = make_array(VTK_UNSIGNED_CHAR, [
        vtkDataSetAttributes.HIDDENPOINT * (i % 97 == 0) for i in range(data.GetNumberOfPoints())])
    ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
    data.GetPointData().AddArray(ghosts)
    picture.mapper.SetInputData(data)


def component(picture, image, isovalue):
    """The second of three."""
    scalars = image.GetPointData().GetScalars()
    vectors = scalars.NewInstance()
    vectors.SetNumberOfComponents(3)
    vectors.SetNumberOfTuples(scalars.GetNumberOfTuples())
    vectors.Fill(0.0)
    vectors.CopyComponent(1, scalars, 0)
    data = vtkImageData()
    data.CopyStructure(image)
    data.GetPointData().SetScalars(vectors)
    picture.mapper.SetInputData(data)
    picture.mapper.SetVectorModeToComponent()
    picture.mapper.SetVectorComponent(1)


def heaviest_component(picture, image, isovalue):
    component(picture, image, isovalue)
    picture.mapper.SetVectorModeToDisabled()
    picture.surface.SetComponentWeight(0, 0.5)
    picture.surface.SetComponentWeight(2, 0.5)


def of_type(scalar_type):
    def convert(picture, image, isovalue):
        scale = vtkImageShiftScale()
        scale.SetInputData(image)
        scale.SetScale(0.45)
        scale.SetOutputScalarType(scalar_type)
        scale.ClampOverflowOn()
        scale.Update()
        picture.mapper.SetInputData(scale.GetOutput())
        picture.surface.GetIsoSurfaceValues().SetNumberOfContours(0)
        picture.add_surface(0.45 * isovalue, (0.6, 0.8, 0.9), 1.0)
    return convert


def magnitude(picture, image, isovalue):
    """Where the length of the gradient, an array of vectors, is a fifth of its largest."""
    gradient = vtkImageGradient()
    gradient.SetInputData(image)
    gradient.SetDimensionality(3)
    gradient.Update()
    vectors = gradient.GetOutput().GetPointData().GetScalars()
    picture.mapper.SetInputConnection(gradient.GetOutputPort())
    picture.mapper.SetVectorModeToMagnitude()
    picture.surface.GetIsoSurfaceValues().SetNumberOfContours(0)
    picture.add_surface(0.2 * vectors.GetMaxNorm(), (0.75, 0.85, 0.95), 1.0)


DATA = {
    "waves": plain,
    "turned": turned,
    "rectilinear": gallery.rectilinear,
    "uneven": uneven,
    "cells": gallery.cells,
    "blocks": gallery.blocks,
    "hidden-points": hidden_points,
    "component": component,
    "heaviest-component": heaviest_component,
    "magnitude": magnitude,
    **{name: of_type(scalar_type)
       for name, (scalar_type, *_) in INTEGER_RANGES.items()},
}


# What is drawn of the data.


def several(picture, image, isovalue):
    """Seven surfaces, all translucent but one."""
    low, high = image.GetScalarRange()
    for i, opacity in enumerate((0.0, 0.2, 0.9, 0.5, 1.0, 0.1)):
        value = low + (i + 0.7) / 6.0 * (high - low)
        picture.add_surface(value, (0.1 * i, 0.9 - 0.1 * i, 0.5), opacity)
    picture.surface.SetSpecular(0.4)
    picture.surface.SetSpecularPower(20.0)


def several_in_shadow(picture, image, isovalue):
    several(picture, image, isovalue)
    gallery.occluded(picture, image, isovalue)
    picture.mapper.SetNumberOfAmbientOcclusionRays(2)
    picture.mapper.SetAmbientOcclusionRadius(0.2 * image.GetLength())
    picture.mapper.ShadowsOn()


def box(picture, image, isovalue):
    """Six planes around the middle of the data, some of them in planes of the lattice."""
    bounds, center = picture.mapper.GetBounds(), picture.camera.GetFocalPoint()
    for axis, (share, side) in itertools.product(range(3), ((0.3, 1.0), (0.9, -1.0))):
        origin, normal = list(center), [0.0, 0.0, 0.0]
        origin[axis] = bounds[2 * axis] + share * (bounds[2 * axis + 1] - bounds[2 * axis])
        normal[axis] = side
        plane = vtkPlane()
        plane.SetOrigin(origin)
        plane.SetNormal(normal)
        picture.mapper.AddClippingPlane(plane)


def capped_box(picture, image, isovalue):
    several(picture, image, isovalue)
    box(picture, image, isovalue)
    picture.mapper.CapClippingPlanesOn()


def capped_boxes(picture, image, isovalue):
    box(picture, image, isovalue)
    picture.mapper.CapClippingPlanesOn()
    picture.mapper.SetInterpolationModeToNearest()


def capped_cubic(picture, image, isovalue):
    box(picture, image, isovalue)
    picture.mapper.CapClippingPlanesOn()
    picture.mapper.SetInterpolationModeToCubic()


def coloured_by_array(picture, image, isovalue):
    """By another array of the points, where the data have points."""
    data = picture.mapper.GetInputDataObject(0, 0)
    if not hasattr(data, "GetPointData") or data.GetPointData().GetScalars() is None:
        return
    count = data.GetNumberOfPoints()
    colors = make_array(VTK_FLOAT, [float(i % 53) for i in range(count)])
    colors.SetName("Colors")
    copy = data.NewInstance()
    copy.ShallowCopy(data)
    copy.GetPointData().AddArray(colors)
    picture.mapper.SetInputDataObject(copy)
    picture.mapper.SetColorArrayName("Colors")
    function = picture.surface.GetRGBTransferFunction()
    function.RemoveAllPoints()
    function.AddRGBPoint(0.0, 0.2, 0.3, 0.8)
    function.AddRGBPoint(53.0, 0.8, 0.3, 0.1)


def maximum(picture, image, isovalue):
    gallery.projected(picture, image, isovalue)
    box(picture, image, isovalue)


def minimum(picture, image, isovalue):
    """The smallest values inside the middle of the volume."""
    bounds = image.GetBounds()
    picture.mapper.SetCroppingRegionPlanes(
        *[bounds[2 * axis] + part * (bounds[2 * axis + 1] - bounds[2 * axis])
          for axis in range(3) for part in (0.25, 0.7)])
    picture.mapper.SetCroppingRegionFlagsToSubVolume()
    picture.mapper.CroppingOn()
    picture.mapper.SetBlendModeToMinimumIntensity()
    function, opacity = picture.surface.GetRGBTransferFunction(), picture.surface.GetScalarOpacity()
    function.RemoveAllPoints()
    opacity.RemoveAllPoints()
    low, high = image.GetScalarRange()
    function.AddRGBPoint(low, 0.1, 0.1, 0.3)
    function.AddRGBPoint(isovalue, 0.95, 0.9, 0.8)
    function.AddRGBPoint(high, 0.5, 0.1, 0.1)
    opacity.AddPoint(isovalue, 1.0)


def translucent_alone(picture, image, isovalue):
    picture.add_surface(isovalue, (0.96, 0.90, 0.80), 0.4)
    picture.surface.GetIsoSurfaceValues().SetNumberOfContours(1)


def unlit(picture, image, isovalue):
    picture.surface.ShadeOff()


LOOKS = {
    **{furnish.__name__: furnish for furnish in (
        plain, gallery.shadows, gallery.translucent, gallery.clipped, gallery.capped,
        gallery.cropped, gallery.coloured, gallery.projected, minimum, several,
        several_in_shadow, capped_box, capped_boxes, coloured_by_array, maximum,
        translucent_alone, unlit)},
    "interpolant-gradient": with_settings(NormalMode="INTERPOLANT_GRADIENT"),
    "nearest": with_settings(InterpolationMode="NEAREST"),
    **{solver.lower(): with_settings(RootSolver=solver) for solver in SOLVERS},
}
# These take longer.
LOOKS_OF_WAVES = {
    "cubic": with_settings(InterpolationMode="CUBIC"),
    "capped_cubic": capped_cubic,
    "smooth": with_settings(ImageSampleDistance=0.5),
    "coarse": with_settings(ImageSampleDistance=3.0),
    "tiles-7x5": with_settings(TileSize=(7, 5)),
    "tiles-64x64": with_settings(TileSize=(64, 64)),
    "tiles-1x1": with_settings(TileSize=(1, 1)),
}


def cropped_to(region):
    def crop(picture, image, isovalue):
        gallery.cropped(picture, image, isovalue)
        bounds = image.GetBounds()
        picture.mapper.SetCroppingRegionPlanes(*[
            bounds[2 * axis] + share * (bounds[2 * axis + 1] - bounds[2 * axis])
            for axis in range(3) for share in (0.3, 0.65)])
        picture.mapper.SetCroppingRegionFlags(1 << region)
    return crop


# Cameras and lights.


def from_afar(picture, image, isovalue):
    """So that many cells are behind each pixel."""
    picture.camera.Zoom(0.2)


def from_within(picture, image, isovalue):
    picture.camera.SetPosition([
        0.8 * a + 0.2 * b
        for a, b in zip(picture.camera.GetFocalPoint(), picture.camera.GetPosition())])
    picture.camera.SetViewAngle(80.0)
    picture.camera.SetClippingRange(0.001 * image.GetLength(), 3.0 * image.GetLength())


def along_axis(picture, image, isovalue):
    """In parallel projection, so that rays lie in planes of the lattice."""
    center, length = picture.camera.GetFocalPoint(), image.GetLength()
    picture.camera.SetPosition(center[0], center[1] - length, center[2])
    picture.camera.ParallelProjectionOn()
    # Eight pixels for each sample.
    picture.camera.SetParallelScale(0.5 * SIZE[1] / 8 * abs(image.GetSpacing()[0])
                                    if hasattr(image, "GetSpacing") else 0.3 * length)


def slanting(picture, image, isovalue):
    """In parallel projection, and not in the middle of the picture."""
    picture.camera.ParallelProjectionOn()
    picture.camera.SetParallelScale(0.4 * image.GetLength())
    picture.camera.SetWindowCenter(0.2, -0.3)


def moved(picture, image, isovalue):
    """The volume is turned, stretched and mirrored."""
    picture.volume.SetOrigin(picture.camera.GetFocalPoint())
    picture.volume.RotateX(25.0)
    picture.volume.RotateZ(-40.0)
    picture.volume.SetScale(1.2, -0.7, 0.9)


def many_lights(picture, image, isovalue):
    picture.surface.SetSpecular(0.6)
    center, length = picture.camera.GetFocalPoint(), image.GetLength()
    for i, angle in enumerate((20.0, 40.0, 90.0, 180.0)):
        lamp = vtkLight()
        lamp.SetLightTypeToSceneLight()
        lamp.PositionalOn()
        lamp.SetConeAngle(angle)
        lamp.SetExponent(1.0 + i)
        lamp.SetAttenuationValues(1.0, 0.01 * i, 0.0)
        lamp.SetColor(0.2 * i, 1.0, 1.0 - 0.2 * i)
        lamp.SetFocalPoint(center)
        lamp.SetPosition(center[0] + (0.5 - 0.4 * i) * length, center[1] + 0.7 * length,
                         center[2] + 0.5 * length)
        picture.lights.AddItem(lamp)


def headlight(picture, image, isovalue):
    picture.lights = None


VIEWS = {furnish.__name__: furnish for furnish in (
    plain, from_afar, from_within, along_axis, slanting, moved, many_lights, headlight)}


def add_products(scenes, kind, image, isovalue, *choices):
    """A picture for every combination of furnishings, one from each choice."""
    for combination in itertools.product(*(choice.items() for choice in choices)):
        names, furnishings = zip(*combination)
        scenes["/".join((kind, *names))] = functools.partial(
            PictureScene, image, isovalue, *furnishings)


def choose(choices, *names):
    return {name: choices[name] for name in names}


def make_scenes(is_quick):
    waves = make_waves(20, 20, 20)
    scenes = {}
    add_products(scenes, "gallery", waves, ISOVALUE,
                 {furnish.__name__: furnish for furnish in gallery.SCENES})
    for furnish in gallery.SCENES:
        scenes["picks/" + furnish.__name__] = functools.partial(
            PickScene, waves, ISOVALUE, furnish)
    if is_quick:
        add_products(scenes, "data", waves, ISOVALUE, DATA, choose(LOOKS, "several", "projected"))
        add_products(scenes, "looks", waves, ISOVALUE, LOOKS | LOOKS_OF_WAVES,
                     choose(VIEWS, "along_axis"))
    else:
        add_products(scenes, "data", waves, ISOVALUE, DATA, LOOKS)
        add_products(scenes, "looks", waves, ISOVALUE, LOOKS | LOOKS_OF_WAVES, VIEWS)
        add_products(scenes, "cropping", waves, ISOVALUE,
                     {str(region): cropped_to(region) for region in range(27)})
    # Across blocks of 64 cells.
    add_products(scenes, "large", make_waves(70, 33, 40), ISOVALUE,
                 choose(LOOKS, "plain", "several_in_shadow", "capped_box", "projected"),
                 choose(VIEWS, "plain", "along_axis"))
    hard_looks = choose(LOOKS | LOOKS_OF_WAVES, "plain", "translucent_alone", "several", "nearest",
                        "cubic", "linear")
    hard_views = choose(VIEWS, "plain", "along_axis")
    for name, (data, isovalue) in make_volumes().items():
        add_products(scenes, "hard/" + name, data, isovalue,
                     choose(LOOKS, "plain", "several") if is_quick else hard_looks,
                     choose(VIEWS, "along_axis") if is_quick else hard_views)
    return scenes
