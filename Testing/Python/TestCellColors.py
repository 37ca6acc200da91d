#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Isosurfaces coloured by arrays of cells: every pixel has the colour of the cell that is hit."""

import unittest

from vtkmodules.vtkCommonCore import mutable, vtkCommand, vtkDoubleArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_TETRA,
    vtkImageData,
    vtkNonOverlappingAMR,
    vtkOverlappingAMR,
)
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper

from MeshTesting import ball, errors_of, make_grid, make_structured_grid, make_volume
from TestAmr import APART, NESTED, fill
from TestManyGrids import make_image, make_rectilinear, multi_block, saddle

PIXELS = 70


def paint(grid, is_value=False):
    """Gives cells colours that tell them apart."""
    array = vtkDoubleArray() if is_value else vtkUnsignedCharArray()
    array.SetName("paint")
    array.SetNumberOfComponents(1 if is_value else 3)
    for i in range(grid.GetNumberOfCells()):
        code = (i + 1) * 7919 + grid.GetNumberOfCells()
        array.InsertNextTuple((code % 101 / 100.0,) if is_value else (code % 251, code // 251 % 251, code % 83))
    grid.GetCellData().AddArray(array)
    return grid


def make_cells():
    """An image with scalars of cells."""
    image = make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball)
    scalars = vtkDoubleArray()
    for i in range(image.GetNumberOfCells()):
        bounds = image.GetCell(i).GetBounds()
        scalars.InsertNextValue(ball([0.5 * (a + b) for a, b in zip(bounds[::2], bounds[1::2])]))
    image.GetPointData().Initialize()
    image.GetCellData().SetScalars(scalars)
    return image


def make_pieces():
    """Two halves of an image on one lattice."""
    pieces = []
    for first, last in ((0, 6), (6, 12)):
        piece = make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball)
        part = vtkImageData()
        part.SetOrigin(piece.GetOrigin())
        part.SetSpacing(piece.GetSpacing())
        part.SetExtent(0, 12, 0, 12, first, last)
        part.AllocateScalars(piece.GetScalarType(), 1)
        part.CopyAndCastFrom(piece, 0, 12, 0, 12, first, last)
        pieces.append(part)
    return pieces


class TestCellColors(unittest.TestCase):
    def check_colors(self, data, is_value=False, mapper_class=vtkIsosurfaceRayTraceMapper):
        mapper, volume = make_volume(data, 0.0, mapper_class=mapper_class)
        surface = volume.GetProperty()
        surface.ShadeOff()
        colors = surface.GetRGBTransferFunction()
        colors.RemoveAllPoints()
        colors.AddRGBPoint(0.0, 0.0, 0.2, 1.0)
        colors.AddRGBPoint(1.0, 1.0, 0.4, 0.0)
        mapper.SetColorArrayName("paint")
        camera = vtkCamera()
        camera.SetFocalPoint(3, 3, 3)
        camera.SetPosition(12, 8, -14)
        camera.SetClippingRange(1, 60)
        image = vtkImageData()
        picture = []
        messages = errors_of(mapper, lambda: picture.append(
            mapper.RenderToImage(volume, camera, None, PIXELS, PIXELS, image)))
        self.assertEqual((messages, picture), ([], [True]))
        in_block, flat_index = mutable(0), mutable(0)
        seen = set()
        for pixel in range(PIXELS**2):
            cell = int(image.GetPointData().GetArray("CellId").GetValue(pixel))
            if cell < 0:
                continue
            block = mapper.FindBlock(cell, in_block, flat_index)
            expected = block.GetCellData().GetArray("paint").GetTuple(in_block.get())
            if is_value:
                expected = [255 * channel for channel in colors.GetColor(expected[0])]
            for channel, value in zip(image.GetPointData().GetArray("Colors").GetTuple(pixel), expected):
                self.assertAlmostEqual(channel, value, delta=1)
            seen.add((int(flat_index), int(in_block)))
        self.assertGreater(len(seen), 30)
        return {index for index, _ in seen}

    def test_single_grids(self):
        for grid in (make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball), make_cells(), make_rectilinear(ball)):
            for is_value in (False, True):
                self.check_colors(paint(grid, is_value), is_value)
        for mesh in (make_grid(VTK_TETRA, ball), make_grid(VTK_HEXAHEDRON, ball), make_structured_grid(ball)):
            self.check_colors(paint(mesh), mapper_class=vtkIsosurfaceRayTraceMeshMapper)

    def test_composite_data(self):
        pieces = [paint(piece) for piece in make_pieces()]
        self.assertEqual(self.check_colors(multi_block(pieces)), {1, 2})
        mixed = [paint(grid) for grid in (
            make_image((0.3, 0.2, 0.1), (0.3, 0.3, 0.3), 13, ball),
            make_image((3.0, 3.0, 0.0), (0.3, 0.31, 0.3), 11, ball), make_grid(VTK_TETRA, saddle))]
        self.assertEqual(self.check_colors(multi_block(mixed)), {1, 2, 3})

    def test_amr(self):
        for of_cells in (False, True):
            for amr, blocks, least in ((vtkOverlappingAMR(), NESTED, 3), (vtkNonOverlappingAMR(), APART, 15)):
                for grid in fill(amr, blocks, of_cells):
                    paint(grid)
                self.assertGreaterEqual(len(self.check_colors(amr)), least)

    def test_arrays_of_points_come_first(self):
        image = paint(make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball))
        other = vtkDoubleArray()
        other.SetName("paint")
        other.SetNumberOfTuples(image.GetNumberOfPoints())
        other.Fill(1.0)
        image.GetPointData().AddArray(other)
        with self.assertRaises(AssertionError):
            self.check_colors(image)

    def test_blocks_with_arrays_of_the_other_kind_are_left_out(self):
        blocks = make_pieces()
        paint(blocks[0])
        other = vtkDoubleArray()
        other.SetName("paint")
        other.SetNumberOfComponents(3)
        other.SetNumberOfTuples(blocks[1].GetNumberOfPoints())
        other.Fill(1.0)
        blocks[1].GetPointData().AddArray(other)
        mapper, volume = make_volume(multi_block(blocks), 0.0, mapper_class=vtkIsosurfaceRayTraceMapper)
        mapper.SetColorArrayName("paint")
        renderer = vtkRenderer()
        renderer.ResetCamera(mapper.GetBounds())
        messages = errors_of(mapper, lambda: mapper.RenderToImage(
            volume, renderer.GetActiveCamera(), None, 20, 20, vtkImageData()), vtkCommand.WarningEvent)
        self.assertEqual(len(messages), 1, messages)
        self.assertIn("is one of points, those of others are of cells", messages[0])

    def test_an_observer_shortens_the_array(self):
        image = paint(make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball))
        mapper, volume = make_volume(image, 0.0, mapper_class=vtkIsosurfaceRayTraceMapper)
        mapper.SetColorArrayName("paint")
        mapper.AddObserver(
            vtkCommand.VolumeMapperRenderProgressEvent,
            lambda *_: image.GetCellData().GetArray("paint").SetNumberOfTuples(3))
        messages = errors_of(mapper, lambda: mapper.RenderToImage(
            volume, vtkCamera(), None, 20, 20, vtkImageData()))
        self.assertTrue(any("released or made shorter" in message for message in messages), messages)


if __name__ == "__main__":
    unittest.main()
