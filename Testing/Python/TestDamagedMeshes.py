#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The mapper of meshes with damaged grids: each has a picture, or an error that says what is wrong.

ATTACK_GRIDS says how many grids there are (300), ATTACK_SEED with which they begin (0); a failure names its
seed. A crash is one that the last seed on the standard output made, with ATTACK_GRIDS set."""

import math
import os
import random
import unittest

from vtkmodules.vtkCommonCore import (
    vtkDoubleArray,
    vtkFloatArray,
    vtkPoints,
    vtkTypeInt32Array,
    vtkTypeInt64Array,
    vtkUnsignedCharArray,
)
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_PYRAMID,
    VTK_QUADRATIC_TETRA,
    VTK_TETRA,
    VTK_TRIANGLE,
    VTK_VERTEX,
    VTK_VOXEL,
    VTK_WEDGE,
    vtkCellArray,
    vtkDataSetAttributes,
    vtkImageData,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkRenderingCore import vtkCamera, vtkLight, vtkLightCollection

from MeshTesting import ball, cast, errors_of, make_grid, make_volume

GRIDS = int(os.environ.get("ATTACK_GRIDS", "300"))
SEED = int(os.environ.get("ATTACK_SEED", "0"))
SHAPES = (VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID, VTK_QUADRATIC_TETRA)
# VTK itself takes no polyhedra without faces.
ODD_TYPES = (*SHAPES, 0, VTK_VERTEX, VTK_TRIANGLE, VTK_VOXEL, 255)
ODD_NUMBERS = (math.nan, math.inf, -math.inf, 0.0, 1e308, -1e308, 5e-324, 1e30, -7.0)
WORDS = ("cell", "point", "value", "array", "type")


def copy_as(kind, array):
    copy = kind()
    copy.DeepCopy(array)
    return copy


class DamagedGrid:
    """The arrays of a grid of a seed, and what is done to them."""

    def __init__(self, draw, whole):
        self.draw = draw
        grid = whole[draw.choice(SHAPES)]
        ids = draw.choice((vtkTypeInt32Array, vtkTypeInt64Array))
        reals = (vtkFloatArray, vtkDoubleArray)
        self.types = copy_as(vtkUnsignedCharArray, grid.GetCellTypesArray())
        self.offsets = copy_as(ids, grid.GetCells().GetOffsetsArray())
        self.ids = copy_as(ids, grid.GetCells().GetConnectivityArray())
        self.points = copy_as(draw.choice(reals), grid.GetPoints().GetData())
        self.values = copy_as(draw.choice(reals), grid.GetPointData().GetScalars())
        self.ghosts = None
        self.are_of_cells = draw.randrange(4) == 0
        if self.are_of_cells:
            self.values.SetNumberOfTuples(grid.GetNumberOfCells())
            for i in range(grid.GetNumberOfCells()):
                self.values.SetValue(i, i % 7 - 3.0)
        for _ in range(draw.randint(1, 3)):
            draw.choice((self.change_ids, self.change_offsets, self.change_types, self.change_points,
                         self.change_values, self.cut, self.hide))()  # fmt: skip

    def change(self, array, most, draw_number):
        for _ in range(self.draw.randint(1, most) if array.GetNumberOfValues() > 0 else 0):
            array.SetValue(self.draw.randrange(array.GetNumberOfValues()), draw_number())

    def draw_id(self):
        points = self.points.GetNumberOfTuples()
        return self.draw.choice((-1, points, 2**31 - 1, -(2**31), 0, self.draw.randint(-9, 2 * points)))

    def change_ids(self):
        self.change(self.ids, 4, self.draw_id)

    def change_offsets(self):
        self.change(self.offsets, 2, self.draw_id)

    def change_types(self):
        self.change(self.types, 4, lambda: self.draw.choice(ODD_TYPES))

    def change_points(self):
        self.change(self.points, 9, lambda: self.draw.choice(ODD_NUMBERS))

    def change_values(self):
        self.change(self.values, 9, lambda: self.draw.choice(ODD_NUMBERS))

    def cut(self):
        """An array is too short."""
        array = self.draw.choice((self.types, self.offsets, self.ids, self.points, self.values))
        array.SetNumberOfTuples(self.draw.choice((0, 1, self.draw.randint(0, array.GetNumberOfTuples()))))

    def hide(self):
        self.ghosts = vtkUnsignedCharArray()
        self.ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
        for _ in range(self.draw.choice((self.types.GetNumberOfValues(), 3))):
            self.ghosts.InsertNextValue(self.draw.choice((0, 0, 1, 2, 32, 255)))

    def make(self):
        cells = vtkCellArray()
        cells.SetData(self.offsets, self.ids)
        points = vtkPoints()
        points.SetData(self.points)
        grid = vtkUnstructuredGrid()
        grid.SetPoints(points)
        grid.SetCells(self.types, cells)
        data = grid.GetCellData() if self.are_of_cells else grid.GetPointData()
        data.SetScalars(self.values)
        if self.ghosts:
            grid.GetCellData().AddArray(self.ghosts)
        return grid


def draw_picture(mapper, volume):
    camera = vtkCamera()
    camera.SetPosition(3, 3, 30)
    camera.SetFocalPoint(3, 3, 3)
    lights = vtkLightCollection()
    lights.AddItem(vtkLight())
    return mapper.RenderToImage(volume, camera, lights, 32, 24, vtkImageData())


class TestDamagedMeshes(unittest.TestCase):
    def check(self, grid):
        """Returns whether there is a picture."""
        mapper, volume = make_volume(grid, 0.0)
        mapper.SetTetrahedralize(grid.GetNumberOfPoints() % 3 == 0)
        drawn = []
        errors = errors_of(mapper, lambda: drawn.append(draw_picture(mapper, volume)))
        if drawn[0]:
            self.assertEqual(errors, [])
            rays = [((1.0 + i, 2.9, -9.0), (0.1, 0.0, 1.0)) for i in range(4)]
            self.assertIsNotNone(cast(mapper, volume, rays))
        else:
            self.assertEqual(len(errors), 1)
            self.assertTrue(any(word in errors[0].lower() for word in WORDS), errors[0])
        return drawn[0]

    def test_grids(self):
        whole = {shape: make_grid(shape, ball) for shape in SHAPES}
        pictures = 0
        for seed in range(SEED, SEED + GRIDS):
            if "ATTACK_GRIDS" in os.environ:
                print(seed, flush=True)
            with self.subTest(seed=seed):
                pictures += self.check(DamagedGrid(random.Random(seed), whole).make())
        self.assertGreater(pictures, GRIDS // 10)
        self.assertLess(pictures, GRIDS * 9 // 10)


if __name__ == "__main__":
    unittest.main()
