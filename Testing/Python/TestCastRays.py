#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""cast_rays() of the Python package: numpy in and out, the hits of the mapper."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPolyData
from vtkIsosurfaceRayTracing import cast_rays, isosurface

from MeshTesting import ball, make_grid, parallel_rays
from PackageTesting import BALL, make_ball


class TestCastRays(unittest.TestCase):
    def test_ball(self):
        hits = cast_rays(make_ball(), [[-3, 0, 0], [-3, 9, 0], [0, 0, 5]], [[2, 0, 0], [1, 0, 0], [0, 0, -1]],
                         0.0, **BALL, opacity=0.5)  # fmt: skip
        np.testing.assert_array_equal(hits.rays, [0, 0, 2, 2])
        expected = np.array([[-0.7, 0, 0], [0.7, 0, 0], [0, 0, 0.7], [0, 0, -0.7]])
        np.testing.assert_allclose(hits.points, expected, atol=0.01)
        np.testing.assert_allclose(hits.normals, expected / 0.7, atol=0.01)
        np.testing.assert_allclose(hits.t, [2.3 / 2, 3.7 / 2, 4.3, 5.7], atol=0.01)
        np.testing.assert_array_equal(hits.isovalues, [0.0] * 4)
        self.assertEqual(hits.parametric.shape, (4, 3))
        self.assertTrue(((hits.parametric >= 0.0) & (hits.parametric <= 1.0)).all())
        index = np.stack(np.unravel_index(hits.cells, (23, 23, 23), order="F"), axis=1)
        np.testing.assert_allclose((index + hits.parametric) * BALL["spacing"] - 1.0, hits.points, atol=1e-12)

    def test_the_bits_of_the_mapper(self):
        volume = isosurface(make_grid(VTK_TETRA, ball), 0.5)
        rays = np.array(parallel_rays())
        origins, directions, output = vtkPoints(), vtkDoubleArray(), vtkPolyData()
        origins.SetDataTypeToDouble()
        directions.SetNumberOfComponents(3)
        for origin, direction in rays:
            origins.InsertNextPoint(origin)
            directions.InsertNextTuple(direction)
        self.assertTrue(volume.GetMapper().CastRays(volume, origins, directions, output))
        hits = cast_rays(volume, rays[:, 0], rays[:, 1])
        self.assertGreater(len(hits.rays), 20)
        for values, name in ((hits.rays, "RayId"), (hits.t, "T"), (hits.normals, "Normals"), (hits.cells, "CellId")):
            np.testing.assert_array_equal(values, vtk_to_numpy(output.GetPointData().GetArray(name)))
        np.testing.assert_array_equal(hits.points, vtk_to_numpy(output.GetPoints().GetData()))

    def test_hits_of_several_isovalues_are_those_of_each(self):
        """Also where samples are equal to them, with every RootSolver."""
        samples = np.random.default_rng(1).integers(0, 5, (12, 12, 12)).astype(np.int16)
        starts = np.stack(np.meshgrid(np.arange(0, 11, 0.25), np.arange(0, 11, 0.25)), axis=-1).reshape(-1, 2)
        origins, direction = np.column_stack([starts, np.full(len(starts), -1.0)]), (0.05, 0.02, 1.0)
        for solver in range(4):
            def cast(isovalues, solver=solver):
                volume = isosurface(samples, isovalues, opacity=0.001)
                volume.GetMapper().SetRootSolver(solver)
                hits = cast_rays(volume, origins, direction)
                return sorted(zip(hits.rays, hits.t, hits.isovalues))

            alone = sorted(hit for isovalue in (1, 2, 3, 4) for hit in cast([isovalue]))
            self.assertGreater(len(alone), 10000)
            self.assertTrue(cast([1, 2, 3, 4]) == alone, solver)

    def test_one_for_all(self):
        origins = np.column_stack([np.full(5, -3.0), np.linspace(-0.5, 0.5, 5), np.zeros(5)])
        hits = cast_rays(make_ball(), origins, (1, 0, 0), 0.0, **BALL)
        np.testing.assert_array_equal(hits.rays, range(5))
        np.testing.assert_array_equal(cast_rays(make_ball(), origins[:1], np.eye(3)[[0, 0]], 0.0, **BALL).rays, [0, 1])
        np.testing.assert_array_equal(cast_rays(make_ball(), origins.T.copy().T, [1, 0, 0], 0.0, **BALL).t, hits.t)

    def test_no_hits(self):
        hits = cast_rays(make_ball(), [99, 9, 9], [1, 0, 0], 0.0)
        self.assertEqual([len(values) for values in hits], [0] * 7)
        self.assertEqual(hits.points.shape, (0, 3))

    def test_hits_outlive_what_made_them(self):
        hits = cast_rays(make_ball(), [-3, 0, 0], [1, 0, 0], 0.0, **BALL)
        make_ball(64)
        np.testing.assert_allclose(hits.points, [[-0.7, 0, 0]], atol=0.01)

    def test_bad_arguments(self):
        surface = isosurface(make_ball(), 0.0)
        for origins, directions, message in (
            ([1, 2], [1, 0, 0], "origins have the shape"),
            ([[[1, 2, 3]]], [1, 0, 0], "origins have the shape"),
            ([1, 2, np.nan], [1, 0, 0], r"row 0 of the origins is \(1\.0, 2\.0, nan\)"),
            ([1, 2, 3], [[1, 0, 0], [0, np.inf, 0]], r"row 1 of the directions is \(0\.0, inf, 0\.0\)"),
            ([1, 2, 3], [[1, 0], [0, 1]], "directions have the shape"),
            (np.zeros((2, 3)), np.ones((3, 3)), "2 origins and 3 directions"),
            (np.zeros((3, 3)), [[1, 0, 0], [0, 0, 0], [0, 1, 0]], r"direction of ray 1 is \(0, 0, 0\)"),
        ):
            with self.assertRaisesRegex(ValueError, message):
                cast_rays(surface, origins, directions)
        with self.assertRaisesRegex(TypeError, "isosurface"):
            cast_rays(surface, [0, 0, 0], [1, 0, 0], 0.0)


if __name__ == "__main__":
    unittest.main()
