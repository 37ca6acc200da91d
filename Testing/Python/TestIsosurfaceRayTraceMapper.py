#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The classes as Python sees them, in the build folder and where they are installed."""

import unittest

from Waves import make_waves
from vtkIsosurfaceRayTracing import vtkIsosurfaceComparisonFilter, vtkIsosurfaceRayTraceMapper
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR, reference, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkCommonExecutionModel import vtkTableAlgorithm
from vtkmodules.vtkRenderingCore import (
    vtkCamera,
    vtkColorTransferFunction,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
)
from vtkmodules.vtkRenderingVolume import vtkVolumeMapper


def one_cell():
    """A cell whose isosurface 100 is the plane halfway between its lower and upper face."""
    image = vtkImageData()
    image.SetDimensions(2, 2, 2)
    image.AllocateScalars(VTK_UNSIGNED_CHAR, 1)
    scalars = image.GetPointData().GetScalars()
    for i in range(8):
        scalars.SetValue(i, 0 if i < 4 else 200)
    return image


class TestIsosurfaceRayTraceMapper(unittest.TestCase):
    def test_classes_know_their_superclasses(self):
        self.assertIsInstance(vtkIsosurfaceRayTraceMapper(), vtkVolumeMapper)
        self.assertIsInstance(vtkIsosurfaceComparisonFilter(), vtkTableAlgorithm)

    def test_settings(self):
        mapper = vtkIsosurfaceRayTraceMapper()
        mapper.SetBrickLayout(vtkIsosurfaceRayTraceMapper.TWO_LEVEL_BRICKS)
        self.assertEqual(mapper.GetBrickLayout(), vtkIsosurfaceRayTraceMapper.TWO_LEVEL_BRICKS)
        mapper.SetTileSize(16, 8)
        self.assertEqual(mapper.GetTileSize(), (16, 8))

    def test_picture(self):
        mapper = vtkIsosurfaceRayTraceMapper()
        mapper.SetInputData(one_cell())
        red = vtkColorTransferFunction()
        red.AddRGBPoint(100.0, 1.0, 0.0, 0.0)
        opaque = vtkPiecewiseFunction()
        opaque.AddPoint(100.0, 1.0)
        volume = vtkVolume()
        volume.SetMapper(mapper)
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 100.0)
        volume.GetProperty().SetColor(red)
        volume.GetProperty().SetScalarOpacity(opaque)

        renderer = vtkRenderer()
        renderer.AddVolume(volume)
        renderer.SetBackground(0.0, 0.0, 1.0)
        window = vtkRenderWindow()
        window.SetSize(64, 64)
        window.SetMultiSamples(0)
        window.AddRenderer(renderer)
        window.Render()

        pixels = vtkUnsignedCharArray()
        window.GetPixelData(0, 0, 63, 63, 0, pixels)
        self.assertEqual(pixels.GetTuple(0), (0, 0, 255))
        red, green, blue = pixels.GetTuple(32 * 64 + 32)
        self.assertGreater(red, 0)
        self.assertEqual((green, blue), (0, 0))

    def test_extreme_scales(self):
        """The scene and its camera may be scaled as long as the matrix of the volume has an inverse."""
        _, mapper, volume = make_waves()
        center, size = volume.GetCenter(), volume.GetLength()
        pictures = []
        for scale in (1.0, 2.0**-330, 2.0**-256, 2.0**256, 2.0**330):
            volume.SetScale(scale)
            camera = vtkCamera()
            camera.SetFocalPoint([scale * x for x in center])
            camera.SetPosition([scale * (x + 2.0 * size * y) for x, y in zip(center, (0.3, 0.4, 0.8))])
            camera.SetClippingRange(scale * size, scale * 4.0 * size)
            image = vtkImageData()
            self.assertTrue(mapper.RenderToImage(volume, camera, None, 40, 30, image))
            cells = image.GetPointData().GetArray("CellId")
            pictures.append([cells.GetValue(pixel) for pixel in range(40 * 30)])
        self.assertGreater(sum(cell >= 0 for cell in pictures[0]), 200)
        for picture in pictures[1:]:
            self.assertEqual(picture, pictures[0])

    def test_whole_extent_whoever_asked_for_a_part(self):
        source, mapper, volume = make_waves()

        def cast():
            t, x, pcoords = reference(0.0), [0.0] * 3, [0.0] * 3
            hit = mapper.IntersectWithLine(volume, (0.5, 0.5, 60.0), (0.5, 0.5, -60.0), t, x, pcoords,
                                           reference(0), reference(0.0), [0.0] * 3)
            return hit, t.get()

        def render():
            camera = vtkCamera()
            camera.SetPosition(10.0, 20.0, 90.0)
            camera.SetClippingRange(1.0, 200.0)
            output = vtkImageData()
            self.assertTrue(mapper.RenderToImage(volume, camera, None, 40, 40, output))
            return bytes(memoryview(output.GetPointData().GetArray("Colors")))

        calls = (cast, render, lambda: mapper.HasOnlyOpaqueSurfaces(volume), mapper.GetBounds)
        expected = [call() for call in calls]
        self.assertEqual(expected[0][0], 1)
        self.assertTrue(expected[2])
        for call, value in zip(calls, expected):
            for part in ((0, 0, -16, 16, -16, 16), (-16, 0, -16, 16, -16, 3)):
                source.Modified()
                source.UpdateExtent(part)
                self.assertEqual(source.GetOutput().GetExtent(), part)
                self.assertEqual(call(), value)
            # Nothing is modified, and yet the source executes again.
            source.UpdatePiece(1, 4, 0)
            self.assertNotEqual(source.GetOutput().GetExtent(), (-16, 16) * 3)
            self.assertEqual(call(), value)


if __name__ == "__main__":
    unittest.main()
