# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Rays cast at volumes that are hard on the arithmetic: every volume in every way."""

import functools
import math
import random

from vtkmodules.vtkCommonCore import VTK_DOUBLE, reference, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPlane, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkVolume
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

from mapper_settings import SOLVERS, apply_settings
from volumes import get_point_arrays, make_array, make_volumes


def clip(mapper, bounds):
    """By a slanting plane, and by one in a plane of the lattice or near it."""
    center = [0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)]
    for normal in ((1.0, 0.4, 0.2), (0.0, 1.0, 0.0)):
        plane = vtkPlane()
        plane.SetOrigin(center)
        plane.SetNormal(normal)
        mapper.AddClippingPlane(plane)


def cap(mapper, bounds):
    clip(mapper, bounds)
    mapper.CapClippingPlanesOn()


def crop(mapper, bounds):
    mapper.SetCroppingRegionPlanes(*[
        bounds[2 * axis] + part * (bounds[2 * axis + 1] - bounds[2 * axis])
        for axis in range(3) for part in (0.25, 0.75)])
    mapper.SetCroppingRegionFlags(0x2D1E4B7)
    mapper.CroppingOn()


def keep_whole(mapper, bounds):
    """Cuts nothing."""


def make_ways():
    """Settings of the mapper, opacity of the surfaces, and how they are cut, by name."""
    ways = {}
    for solver in SOLVERS:
        ways[solver.lower()] = ({"RootSolver": solver}, 1.0, keep_whole)
        ways[solver.lower() + "-translucent"] = ({"RootSolver": solver}, 0.01, keep_whole)
    ways["marmitt-1"] = (
        {"RootSolver": "MARMITT", "NumberOfInterpolations": 1}, 0.01, keep_whole)
    for interpolation in ("NEAREST", "CUBIC"):
        settings = {"InterpolationMode": interpolation}
        ways[interpolation.lower()] = (settings, 1.0, keep_whole)
        ways[interpolation.lower() + "-translucent"] = (settings, 0.01, keep_whole)
        ways[interpolation.lower() + "-cap"] = (settings, 0.01, cap)
    ways["interpolant-gradient"] = ({"NormalMode": "INTERPOLANT_GRADIENT"}, 0.01, keep_whole)
    for blend in ("MAXIMUM_INTENSITY_BLEND", "MINIMUM_INTENSITY_BLEND"):
        ways[blend[:7].lower()] = ({"BlendMode": blend}, 1.0, keep_whole)
        ways[blend[:7].lower() + "-crop"] = ({"BlendMode": blend}, 1.0, crop)
    for cut in (clip, cap, crop):
        ways[cut.__name__] = ({}, 0.01, cut)
    return ways


QUICK_WAYS = ("robust", "robust-translucent", "nearest", "cubic", "maximum", "cap")


def make_rays(generator, dimensions, count):
    """Origins and directions in the lattice of whole numbers: at random; and aimed exactly at
    vertices, edges and faces of cells, from afar, from within and from a vertex; slanting, along
    axes, in planes of the lattice and along diagonals; and all that a little beside."""
    longest = 2.0 * max(dimensions)
    for i in range(count):
        target = [generator.uniform(-0.2, size - 0.8) for size in dimensions]
        for axis in generator.sample(range(3), generator.choice((0, 1, 2, 3, 3))):
            target[axis] = float(generator.randrange(dimensions[axis]))
        if generator.random() < 0.1:
            target = [math.nextafter(value, generator.choice((-1e9, 1e9))) for value in target]
        direction = generator.choice((
            [generator.gauss(0.0, 1.0) for axis in range(3)],
            [float(generator.randint(-2, 2)) for axis in range(3)],
            [generator.choice((0.0, -0.0, 1e-300, 1e-17, 1e-9, 1.0, -1.0)) for axis in range(3)]))
        if not any(abs(component) >= 1.0 for component in direction):
            direction[generator.randrange(3)] = generator.choice((-1.0, 1.0))
        length = generator.choice((0.0, 0.5, longest, longest, 1024.0))
        yield [a - length * b for a, b in zip(target, direction)], direction


@functools.lru_cache(maxsize=None)
def get_rays(dimensions, count):
    return list(make_rays(random.Random(2), dimensions, count))


class RayScene:
    """A volume with an opaque isosurface or two translucent ones, and rays through it."""

    def __init__(self, data, isovalue, settings, opacity, cut, count):
        self.data, self.count = data, count
        self.mapper = vtkIsosurfaceRayTraceMapper()
        self.mapper.SetInputDataObject(data)
        apply_settings(self.mapper, settings)
        cut(self.mapper, data.GetBounds())
        self.volume = vtkVolume()
        self.volume.SetMapper(self.mapper)
        surface = self.volume.GetProperty()
        surface.GetIsoSurfaceValues().SetNumberOfContours(0)
        surface.GetIsoSurfaceValues().SetValue(0, isovalue)
        if opacity < 1.0:
            surface.GetIsoSurfaceValues().SetValue(1, 0.7 * isovalue)
        surface.GetScalarOpacity().AddPoint(isovalue, opacity)

    def to_world(self, point):
        """From the lattice of whole numbers."""
        if hasattr(self.data, "TransformContinuousIndexToPhysicalPoint"):
            world = [0.0] * 3
            self.data.TransformContinuousIndexToPhysicalPoint(*point, world)
            return world
        bounds, dimensions = self.data.GetBounds(), self.data.GetDimensions()
        return [bounds[2 * axis] + (bounds[2 * axis + 1] - bounds[2 * axis]) * point[axis]
                / (dimensions[axis] - 1) for axis in range(3)]

    def get_rays(self):
        """Origins and directions in the world."""
        for origin, direction in get_rays(tuple(self.data.GetDimensions()), self.count):
            begin = self.to_world(origin)
            end = self.to_world([a + b for a, b in zip(origin, direction)])
            yield begin, [b - a for a, b in zip(begin, end)]

    def record(self):
        origins, directions = vtkPoints(), []
        origins.SetDataTypeToDouble()
        for origin, direction in self.get_rays():
            origins.InsertNextPoint(origin)
            directions += direction
        hits = vtkPolyData()
        if not self.mapper.CastRays(
                self.volume, origins, make_array(VTK_DOUBLE, directions, 3), hits):
            raise RuntimeError("The rays were not cast.")
        return {"Points": hits.GetPoints().GetData(), **get_point_arrays(hits)}


class LineScene(RayScene):
    """The same by IntersectWithLine, one after the other."""

    def record(self):
        hits = []
        for origin, direction in self.get_rays():
            end = [a + 10.0 * b for a, b in zip(origin, direction)]
            t, cell_id, isovalue = reference(-1.0), reference(-1), reference(-1.0)
            point, parametric, normal = [0.0] * 3, [0.0] * 3, [0.0] * 3
            self.mapper.IntersectWithLine(self.volume, origin, end, t, point, parametric, cell_id,
                                          isovalue, normal)
            hits += [t.get(), *point, *parametric, cell_id.get(), isovalue.get(), *normal]
        return {"Hits": make_array(VTK_DOUBLE, hits, 12)}


def make_scenes(is_quick):
    scenes = {}
    ways = make_ways()
    for volume_name, (data, isovalue) in make_volumes().items():
        for way_name in QUICK_WAYS if is_quick else ways:
            scenes[f"rays/{volume_name}/{way_name}"] = functools.partial(
                RayScene, data, isovalue, *ways[way_name], 300 if is_quick else 1000)
        for way_name in ("robust", "cap", "maximum"):
            scenes[f"lines/{volume_name}/{way_name}"] = functools.partial(
                LineScene, data, isovalue, *ways[way_name], 100)
    return scenes
