# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Arrays, what volumes are made with, and volumes that are hard on the arithmetic."""

import array
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
    vtkDataArray,
    vtkDoubleArray,
)
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkRectilinearGrid

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


def make_array(scalar_type, values, components=1):
    """A vtkDataArray of a type such as VTK_FLOAT."""
    result = vtkDataArray.CreateDataArray(scalar_type)
    result.SetNumberOfComponents(components)
    result.SetNumberOfTuples(len(values) // components)
    view = memoryview(result)
    code = "b" if view.format == "c" else view.format
    view.cast("B")[:] = array.array(code, values).tobytes()
    return result


def get_point_arrays(data_set):
    point_data = data_set.GetPointData()
    return {point_data.GetArrayName(i): point_data.GetArray(i)
            for i in range(point_data.GetNumberOfArrays())}


def make_image(dimensions, scalars):
    image = vtkImageData()
    image.SetDimensions(dimensions)
    image.GetPointData().SetScalars(scalars)
    return image


def make_rectilinear(coordinates, scalars):
    """A grid with its planes at these coordinates along each axis."""
    grid = vtkRectilinearGrid()
    grid.SetDimensions([len(planes) for planes in coordinates])
    setters = (grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)
    for set_coordinates, planes in zip(setters, coordinates):
        axis = vtkDoubleArray()
        for plane in planes:
            axis.InsertNextValue(plane)
        set_coordinates(axis)
    grid.GetPointData().SetScalars(scalars)
    return grid


def sample(dimensions, function):
    """A function of x, y and z at all points."""
    return [function(x, y, z) for z in range(dimensions[2]) for y in range(dimensions[1])
            for x in range(dimensions[0])]


def make_volumes():
    """Data sets and isovalues by name. The dimensions are such that blocks of eight cells are cut
    off at the border, and in the long ones such that there are several blocks of 64."""
    generator = random.Random(1)
    size = (13, 11, 10)
    count = size[0] * size[1] * size[2]
    volumes = {}

    def add(name, values, isovalue, scalar_type=VTK_DOUBLE, dimensions=size):
        volumes[name] = (make_image(dimensions, make_array(scalar_type, values)), isovalue)

    def noise(dimensions=size):
        return sample(dimensions, lambda x, y, z: generator.uniform(-1.0, 1.0))

    for name, (scalar_type, low, high) in INTEGER_RANGES.items():
        values = [generator.randint(low, high) for i in range(count)]
        add(name, values, 0.5 * (low + high + 1), scalar_type)
    add("float", noise(), 0.1, VTK_FLOAT)
    add("double", noise(), 0.1)
    add("few-values", [generator.randint(0, 3) for i in range(count)], 2.0, VTK_UNSIGNED_CHAR)
    add("isovalue-at-points", [generator.choice((-1.0, 0.0, 0.0, 1.0)) for i in range(count)], 0.0)
    add("isovalue-at-points-float", [generator.choice((-1.0, 0.0, -0.0, 1.0)) for i in range(count)],
        0.0, VTK_FLOAT)
    add("plateau-below", [min(value, 0.0) for value in noise()], 0.0)
    add("plateau-above", [max(value, 0.0) for value in noise()], 0.0, VTK_FLOAT)
    for name, hole in (("nan", math.nan), ("infinity", math.inf), ("minus-infinity", -math.inf)):
        for scalar_type, type_name in ((VTK_FLOAT, "float"), (VTK_DOUBLE, "double")):
            values = [hole if generator.random() < 0.04 else value for value in noise()]
            add(f"{name}-{type_name}", values, 0.1, scalar_type)
    for scale in (5e-324, 1e-320, 1e-300, 1e-160, 1e160, 1e300, 1.7e308):
        add(f"scaled-by-{scale}", [scale * value for value in noise()], 0.1 * scale)
    for scale in (1e-44, 1e-38, 3e38):
        add(f"scaled-by-{scale}-float", [scale * value for value in noise()], 0.1 * scale, VTK_FLOAT)
    add("all-magnitudes", [value * 10.0**generator.uniform(-300.0, 300.0) for value in noise()], 0.0)
    add("near-isovalue", [1.0 + 2.0**-52 * generator.randint(-3, 3) for i in range(count)], 1.0)
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
    """Noise with other origins and spacings, and on uneven planes."""
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
