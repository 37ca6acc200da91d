#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of an image, each with ghosts and traced by itself, have the hits of the whole once."""

import itertools
import math
import unittest

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkImageData, vtkRectilinearGrid
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

from MeshTesting import cast, errors_of, make_volume, parallel_rays

CELLS = (13, 12, 11)
SPACING = (0.5, 0.55, 0.6)


def wave(point):
    return math.sin(1.7 * point[0]) + math.cos(1.3 * point[1]) + math.sin(point[2] + 0.4 * point[0])


def make_piece(own, ghosts, of_cells, is_rectilinear):
    """Of the cells [low, high) along each axis, and layers of cells of other pieces around them."""
    low = [max(0, a - ghosts) for a, _ in own]
    high = [min(n, b + ghosts) for (_, b), n in zip(own, CELLS)]
    size = [b - a for a, b in zip(low, high)]
    if is_rectilinear:
        piece = vtkRectilinearGrid()
        piece.SetDimensions([n + 1 for n in size])
        for axis, set_coordinates in enumerate((piece.SetXCoordinates, piece.SetYCoordinates, piece.SetZCoordinates)):
            coordinates = vtkDoubleArray()
            for i in range(low[axis], high[axis] + 1):
                coordinates.InsertNextValue(SPACING[axis] * i * (1.0 + 0.02 * i))
            set_coordinates(coordinates)
    else:
        piece = vtkImageData()
        piece.SetSpacing(SPACING)
        piece.SetExtent([k for a, b in zip(low, high) for k in (a, b)])
    values, flags = vtkDoubleArray(), vtkUnsignedCharArray()
    flags.SetName(vtkDataSetAttributes.GhostArrayName())
    values.SetName("values")
    more = 0 if of_cells else 1
    for z, y, x in itertools.product(*[range(low[k], high[k] + more) for k in (2, 1, 0)]):
        values.InsertNextValue(wave([length * k for length, k in zip(SPACING, (x, y, z))]))
    for z, y, x in itertools.product(*[range(low[k], high[k]) for k in (2, 1, 0)]):
        is_own = all(a <= k < b for (a, b), k in zip(own, (x, y, z)))
        flags.InsertNextValue(0 if is_own else vtkDataSetAttributes.DUPLICATECELL)
    (piece.GetCellData() if of_cells else piece.GetPointData()).SetScalars(values)
    piece.GetCellData().AddArray(flags)
    return piece


def hits_of(piece, rays):
    mapper, volume = make_volume(piece, 0.2, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=0.01)
    return [(ray, t, normal) for ray, t, _, normal in cast(mapper, volume, rays)]


class TestPieces(unittest.TestCase):
    def test_ghosts_are_not_offered_as_scalars(self):
        piece = make_piece([(0, n) for n in CELLS], 0, True, False)
        mapper, volume = make_volume(piece, 0.2, mapper_class=vtkIsosurfaceRayTraceMapper)
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectScalarArray("missing")
        (error,) = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays()))
        self.assertIn('no array "missing" of cells with numbers. SelectScalarArray() takes one of "values".', error)

    def test_a_hidden_point_hides_the_cells_around_it(self):
        """Whether the scalars are of points or of cells."""
        rays = parallel_rays(41)
        for of_cells, is_rectilinear in itertools.product((False, True), repeat=2):
            shown, expected, piece = (make_piece([(0, n) for n in CELLS], 0, of_cells, is_rectilinear) for _ in range(3))
            flags = vtkUnsignedCharArray()
            flags.SetName(vtkDataSetAttributes.GhostArrayName())
            for z, y, x in itertools.product(*[range(CELLS[k] + 1) for k in (2, 1, 0)]):
                is_hidden = (x + 3 * y + 5 * z) % 37 == 0
                flags.InsertNextValue(vtkDataSetAttributes.HIDDENPOINT if is_hidden else 0)
            piece.GetPointData().AddArray(flags)
            for i in range(expected.GetNumberOfCells()):
                corners = expected.GetCell(i).GetPointIds()
                if any(flags.GetValue(corners.GetId(k)) for k in range(8)):
                    expected.GetCellData().GetArray(flags.GetName()).SetValue(i, vtkDataSetAttributes.HIDDENCELL)
            hits = hits_of(piece, rays)
            self.assertEqual(hits, hits_of(expected, rays))
            self.assertGreater(len(hits), 50)
            self.assertLess(len(hits), len(hits_of(shown, rays)))

    def test_every_hit_is_of_one_piece(self):
        rays = parallel_rays(40)
        cuts = [[(0, n // 2), (n // 2, n)] for n in CELLS]
        for of_cells, is_rectilinear in itertools.product((False, True), repeat=2):
            # The second layer is for the normals at the border.
            ghosts = 2 if of_cells else 1
            with self.subTest(of_cells=of_cells, is_rectilinear=is_rectilinear):
                whole = hits_of(make_piece([(0, n) for n in CELLS], 0, of_cells, is_rectilinear), rays)
                self.assertGreater(len(whole), 1000)
                hits = []
                for own in itertools.product(*cuts):
                    of_piece = hits_of(make_piece(own, ghosts, of_cells, is_rectilinear), rays)
                    self.assertGreater(len(of_piece), 30)
                    hits += of_piece
                hits.sort(key=lambda hit: hit[:2])
                self.assertEqual([hit[0] for hit in hits], [hit[0] for hit in whole])
                for hit, expected in zip(hits, whole):
                    self.assertAlmostEqual(hit[1], expected[1], delta=1e-12 * expected[1])
                    self.assertLess(math.dist(hit[2], expected[2]), 1e-6)


if __name__ == "__main__":
    unittest.main()
