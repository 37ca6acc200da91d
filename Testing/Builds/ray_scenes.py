# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Rays cast at volumes that are hard on the arithmetic: every volume in every way."""

import functools
import math
import random

from vtkmodules.vtkCommonCore import (
    VTK_CHAR,
    VTK_DOUBLE,
    VTK_FLOAT,
    VTK_INT,
    VTK_LONG_LONG,
    VTK_SHORT,
    VTK_SIGNED_CHAR,
    VTK_UNSIGNED_CHAR,
    VTK_UNSIGNED_INT,
    VTK_UNSIGNED_LONG_LONG,
    VTK_UNSIGNED_SHORT,
    vtkPoints,
)
from vtkmodules.vtkCommonDataModel import vtkPlane, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkVolume
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

from scene import apply_settings, make_array, make_image, make_rectilinear

INTEGER_RANGES = {
    "char": (VTK_CHAR, -128, 127),
    "signed-char": (VTK_SIGNED_CHAR, -128, 127),
    "unsigned-char": (VTK_UNSIGNED_CHAR, 0, 255),
    "short": (VTK_SHORT, -2**15, 2**15 - 1),
    "unsigned-short": (VTK_UNSIGNED_SHORT, 0, 2**16 - 1),
    "int": (VTK_INT, -2**31, 2**31 - 1),
    "unsigned-int": (VTK_UNSIGNED_INT, 0, 2**32 - 1),
    "long-long": (VTK_LONG_LONG, -2**63, 2**63 - 1),
    "unsigned-long-long": (VTK_UNSIGNED_LONG_LONG, 0, 2**64 - 1),
}


def sample(dimensions, function):
    """A function of x, y and z at all points."""
    return [function(x, y, z) for z in range(dimensions[2]) for y in range(dimensions[1])
            for x in range(dimensions[0])]


def make_volumes():
    """Data sets and isovalues by name. The dimensions are such that blocks of eight cells are cut
    off at the border, and in the long ones such that there are several blocks of 64."""
    dice = random.Random(1)
    size = (13, 11, 10)
    count = size[0] * size[1] * size[2]
    volumes = {}

    def add(name, values, isovalue, scalar_type=VTK_DOUBLE, dimensions=size):
        volumes[name] = (make_image(dimensions, make_array(scalar_type, values)), isovalue)

    def noise(dimensions=size):
        return sample(dimensions, lambda x, y, z: dice.uniform(-1.0, 1.0))

    for name, (scalar_type, low, high) in INTEGER_RANGES.items():
        values = [dice.randint(low, high) for i in range(count)]
        add(name, values, 0.5 * (low + high + 1), scalar_type)
    add("float", noise(), 0.1, VTK_FLOAT)
    add("double", noise(), 0.1)
    add("few-values", [dice.randint(0, 3) for i in range(count)], 2.0, VTK_UNSIGNED_CHAR)
    add("isovalue-at-points", [dice.choice((-1.0, 0.0, 0.0, 1.0)) for i in range(count)], 0.0)
    add("isovalue-at-points-float", [dice.choice((-1.0, 0.0, -0.0, 1.0)) for i in range(count)],
        0.0, VTK_FLOAT)
    add("plateau-below", [min(value, 0.0) for value in noise()], 0.0)
    add("plateau-above", [max(value, 0.0) for value in noise()], 0.0, VTK_FLOAT)
    for name, hole in (("nan", math.nan), ("infinity", math.inf), ("minus-infinity", -math.inf)):
        for scalar_type, type_name in ((VTK_FLOAT, "float"), (VTK_DOUBLE, "double")):
            values = [hole if dice.random() < 0.04 else value for value in noise()]
            add(f"{name}-{type_name}", values, 0.1, scalar_type)
    for scale in (5e-324, 1e-320, 1e-300, 1e-160, 1e160, 1e300, 1.7e308):
        add(f"scaled-by-{scale}", [scale * value for value in noise()], 0.1 * scale)
    for scale in (1e-44, 1e-38, 3e38):
        add(f"scaled-by-{scale}-float", [scale * value for value in noise()], 0.1 * scale, VTK_FLOAT)
    add("all-magnitudes", [value * 10.0**dice.uniform(-300.0, 300.0) for value in noise()], 0.0)
    add("near-isovalue", [1.0 + 2.0**-52 * dice.randint(-3, 3) for i in range(count)], 1.0)
    add("large-offset", [1e15 + value for value in noise()], 1e15)
    add("checkerboard", sample(size, lambda x, y, z: (-1.0)**(x + y + z)), 0.0)
    add("checkerboard-off", sample(size, lambda x, y, z: (-1.0)**(x + y + z)), 1e-9)
    add("saddle", sample(size, lambda x, y, z: (x - 6.0) * (y - 5.0) * (z - 4.5)), 0.0)
    add("plane-in-faces", sample(size, lambda x, y, z: x - 6.0), 0.0)
    add("thin-sheet", sample(size, lambda x, y, z: 1e-9 - abs(x + y - 11.0)), 0.0)
    add("touching-sheet", sample(size, lambda x, y, z: -abs(x + 2 * y - z - 9.0)), 0.0)
    add("sphere", sample(size, lambda x, y, z: math.dist((x, y, z), (6.2, 5.1, 4.7))), 4.0)
    for dimensions in ((2, 2, 2), (2, 9, 3), (40, 2, 2), (9, 9, 2)):
        add("thin-" + "x".join(map(str, dimensions)), noise(dimensions), 0.1, VTK_FLOAT, dimensions)
    for name, dimensions in (("long-x", (140, 12, 10)), ("long-y", (9, 133, 11)),
                             ("long-z", (11, 10, 137))):
        waves = sample(dimensions,
                       lambda x, y, z: math.sin(0.41 * x) + math.sin(0.37 * y) + math.sin(0.43 * z))
        add(name, waves, 0.7, VTK_FLOAT, dimensions)
    add_placed(volumes, noise)
    return volumes


def add_placed(volumes, noise):
    """Noise in other places than the lattice of whole numbers, and on uneven planes."""
    size = (13, 11, 10)
    for name, spacing, origin in (
            ("negative-spacing", (-1.0, 0.7, -1.3), (3.0, -2.0, 1.0)),
            ("far-away", (0.1, 0.2, 0.3), (1e8, -3e7, 2e9)),
            ("tiny", (1e-12, 2e-12, 1e-12), (0.0, 0.0, 0.0)),
            ("huge", (1e12, 1e12, 3e12), (0.0, 0.0, 0.0)),
            ("flat-spacing", (1.0, 1e-3, 1e3), (0.0, 0.0, 0.0))):
        image = make_image(size, make_array(VTK_FLOAT, noise()))
        image.SetSpacing(spacing)
        image.SetOrigin(origin)
        volumes[name] = (image, 0.1)
    image = make_image(size, make_array(VTK_DOUBLE, noise()))
    image.SetDirectionMatrix(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6)
    volumes["turned"] = (image, 0.1)
    squares = [[0.1 * i * i for i in range(count)] for count in size]
    volumes["uneven-planes"] = (make_rectilinear(squares, make_array(VTK_DOUBLE, noise())), 0.1)
    repeated = [[float(i - (i > 4)) for i in range(count)] for count in size]
    volumes["repeated-planes"] = (make_rectilinear(repeated, make_array(VTK_FLOAT, noise())), 0.1)
    falling = [[-0.5 * i - 0.01 * i * i for i in range(count)] for count in size]
    volumes["falling-planes"] = (make_rectilinear(falling, make_array(VTK_SHORT, [
        int(100.0 * value) for value in noise()])), 10.0)


SOLVERS = ("ROBUST", "FAST", "ANALYTIC", "MARMITT", "LINEAR")


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


def make_rays(dice, dimensions, count):
    """Origins and directions in the lattice of whole numbers: at random; and aimed exactly at
    vertices, edges and faces of cells, from afar, from within and from a vertex; slanting, along
    axes, in planes of the lattice and along diagonals; and all that a little beside."""
    longest = 2.0 * max(dimensions)
    for i in range(count):
        target = [dice.uniform(-0.2, size - 0.8) for size in dimensions]
        for axis in dice.sample(range(3), dice.choice((0, 1, 2, 3, 3))):
            target[axis] = float(dice.randrange(dimensions[axis]))
        if dice.random() < 0.1:
            target = [math.nextafter(value, dice.choice((-1e9, 1e9))) for value in target]
        direction = dice.choice((
            [dice.gauss(0.0, 1.0) for axis in range(3)],
            [float(dice.randint(-2, 2)) for axis in range(3)],
            [dice.choice((0.0, -0.0, 1e-300, 1e-17, 1e-9, 1.0, -1.0)) for axis in range(3)]))
        if not any(abs(component) >= 1.0 for component in direction):
            direction[dice.randrange(3)] = dice.choice((-1.0, 1.0))
        length = dice.choice((0.0, 0.5, longest, longest, 1024.0))
        yield [a - length * b for a, b in zip(target, direction)], direction


@functools.lru_cache(maxsize=None)
def get_rays(dimensions, count):
    return list(make_rays(random.Random(2), dimensions, count))


class RayScene:
    """A volume with two isosurfaces, and rays through it."""

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

    def record(self):
        origins, ends, directions = vtkPoints(), [], []
        origins.SetDataTypeToDouble()
        for origin, direction in get_rays(tuple(self.data.GetDimensions()), self.count):
            begin = self.to_world(origin)
            end = self.to_world([a + b for a, b in zip(origin, direction)])
            origins.InsertNextPoint(begin)
            directions += [b - a for a, b in zip(begin, end)]
        output = vtkPolyData()
        if not self.mapper.CastRays(
                self.volume, origins, make_array(VTK_DOUBLE, directions, 3), output):
            raise RuntimeError("The rays were not cast.")
        return output


def make_scenes(is_quick):
    scenes = {}
    ways = make_ways()
    for volume_name, (data, isovalue) in make_volumes().items():
        for way_name in QUICK_WAYS if is_quick else ways:
            scenes[f"rays/{volume_name}/{way_name}"] = functools.partial(
                RayScene, data, isovalue, *ways[way_name], 300 if is_quick else 1000)
    return scenes
