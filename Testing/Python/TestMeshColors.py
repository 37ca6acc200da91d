#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Isosurfaces of meshes coloured by another array."""

import math
import unittest

from vtkmodules.vtkCommonCore import vtkCommand, vtkDoubleArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_PYRAMID,
    VTK_QUADRATIC_TETRA,
    VTK_TETRA,
    VTK_WEDGE,
    vtkImageData,
    vtkMultiBlockDataSet,
)
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # the window

from MeshTesting import (
    SIZE,
    ball,
    errors_of,
    make_grid,
    make_polyhedra,
    make_structured_grid,
    make_volume,
    plane,
    set_values,
)

PIXELS = 60
BLUE, RED = (0.1, 0.2, 0.9), (0.9, 0.1, 0.0)


def add_array(grid, name, function, array=None):
    """A point array by a function of the position, of as many components as it has values."""
    array = array or vtkDoubleArray()
    array.SetName(name)
    for i in range(grid.GetNumberOfPoints()):
        values = function(grid.GetPoint(i))
        array.SetNumberOfComponents(len(values))
        array.InsertNextTuple(values)
    grid.GetPointData().AddArray(array)
    return grid


def multi_block(*blocks):
    composite = vtkMultiBlockDataSet()
    for i, block in enumerate(blocks):
        composite.SetBlock(i, block)
    return composite


def height(point):
    return (point[2] / SIZE,)


def paint(point):
    return tuple(255.0 * p / SIZE for p in point)


def make_scene(data, name):
    """Not lit, so that pixels have the colours themselves."""
    mapper, volume = make_volume(data, 0.0)
    surface = volume.GetProperty()
    surface.ShadeOff()
    surface.GetScalarOpacity().RemoveAllPoints()
    surface.GetScalarOpacity().AddPoint(0.0, 1.0)
    colors = surface.GetRGBTransferFunction()
    colors.RemoveAllPoints()
    colors.AddRGBPoint(0.0, *BLUE)
    colors.AddRGBPoint(1.0, *RED)
    mapper.SetColorArrayName(name)
    renderer = vtkRenderer()
    renderer.AddVolume(volume)
    renderer.GetActiveCamera().SetPosition(1.0, 0.6, 0.8)
    renderer.ResetCamera()
    return mapper, volume, renderer


def take_picture(scene):
    mapper, volume, renderer = scene
    image = vtkImageData()
    assert mapper.RenderToImage(volume, renderer.GetActiveCamera(), None, PIXELS, PIXELS, image)
    data = image.GetPointData()
    return [(data.GetArray("Colors").GetTuple(i), data.GetArray("Position").GetTuple(i))
            for i in range(PIXELS**2) if data.GetArray("CellId").GetTuple1(i) >= 0]  # fmt: skip


class TestMeshColors(unittest.TestCase):
    def check(self, data, name, color_at):
        """Each pixel has the colour of its position."""
        pixels = take_picture(make_scene(data, name))
        self.assertGreater(len(pixels), 400)
        for color, position in pixels:
            for channel, expected in zip(color, color_at(position)):
                self.assertAlmostEqual(channel, expected, delta=0.6)

    @staticmethod
    def color_of_height(position):
        (t,) = height(position)
        return [255.0 * ((1.0 - t) * a + t * b) for a, b in zip(BLUE, RED)]

    def test_values_have_the_colours_of_the_function(self):
        """Linear ones are interpolated exactly in every shape."""
        for shape in (VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID, VTK_QUADRATIC_TETRA):
            with self.subTest(shape=shape):
                self.check(add_array(make_grid(shape, ball), "height", height), "height", self.color_of_height)
        for grid in (make_structured_grid(ball), make_polyhedra(make_grid(VTK_HEXAHEDRON, ball))):
            self.check(add_array(grid, "height", height), "height", self.color_of_height)

    def test_vectors(self):
        """They have the colour of a component, at first of the first one, or of the magnitude."""

        def vector(point):
            (t,) = height(point)
            return 0.3, 0.8 * t, 0.4 * (1.0 - t)

        def twelve(point):
            return [0.1] * 8 + [*height(point)] + [7.0] * 3

        def mode(component):
            def choose(colors):
                colors.SetVectorModeToComponent()
                colors.SetVectorComponent(component)

            return choose

        cases = (
            (vector, lambda colors: None, lambda v: v[0]),
            (vector, mode(1), lambda v: v[1]),
            (vector, mode(2), lambda v: v[2]),
            (vector, mode(7), lambda v: v[2]),  # the last there is
            (vector, lambda colors: colors.SetVectorModeToMagnitude(), lambda v: math.hypot(*v)),
            (twelve, lambda colors: colors.SetVectorModeToMagnitude(), lambda v: math.hypot(*v[:9])),
            (height, lambda colors: colors.SetVectorModeToMagnitude(), lambda v: v[0]),
            (height, mode(1), lambda v: v[0]),
        )
        image = vtkImageData()
        image.SetDimensions(SIZE + 1, SIZE + 1, SIZE + 1)
        grids = (make_grid(VTK_HEXAHEDRON, ball), make_structured_grid(ball), set_values(image, ball))
        for i, (function, choose, shown) in enumerate(cases):
            for grid in grids:
                with self.subTest(case=i, grid=grid.GetClassName()):
                    data = multi_block(add_array(grid, f"values {i}", function))
                    scene = make_scene(data, f"values {i}")
                    choose(scene[1].GetProperty().GetRGBTransferFunction())
                    pixels = take_picture(scene)
                    self.assertGreater(len(pixels), 400)
                    for color, position in pixels:
                        t = min(shown(function(position)), 1.0)
                        for channel, a, b in zip(color, BLUE, RED):
                            self.assertAlmostEqual(channel, 255.0 * ((1.0 - t) * a + t * b), delta=0.6)

    def test_colours_are_shown_as_they_are(self):
        grid = add_array(make_grid(VTK_TETRA, ball), "paint", paint, vtkUnsignedCharArray())
        pixels = take_picture(make_scene(grid, "paint"))
        self.assertGreater(len(pixels), 400)
        for color, position in pixels:
            for channel, expected in zip(color, paint(position)):
                self.assertAlmostEqual(channel, expected, delta=1.6)  # bytes at points are rounded down

    def test_blocks(self):
        one = add_array(make_grid(VTK_TETRA, ball), "height", height)
        other = add_array(make_structured_grid(lambda p: plane(p) - 4.0), "height", height)
        self.check(multi_block(one, other), "height", self.color_of_height)

    def test_a_new_colour_costs_a_frame(self):
        grid = add_array(make_grid(VTK_TETRA, ball), "height", height)
        mapper, _, renderer = scene = make_scene(grid, "height")
        mapper.ProgressiveAccumulationOn()
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetSize(PIXELS, PIXELS)
        window.AddRenderer(renderer)
        window.Render()
        self.assertGreater(mapper.GetTreeBuildTime(), 0.0)
        window.Render()
        self.assertEqual(mapper.GetNumberOfAccumulatedFrames(), 2)
        array = grid.GetPointData().GetArray("height")
        array.Fill(0.0)
        array.Modified()
        window.Render()
        self.assertEqual(mapper.GetTreeBuildTime(), 0.0)
        self.assertEqual(mapper.GetNumberOfAccumulatedFrames(), 1)
        mapper.ProgressiveAccumulationOff()
        for color, _ in take_picture(scene):
            for channel, expected in zip(color, BLUE):
                self.assertAlmostEqual(channel, 255.0 * expected, delta=0.6)

    def test_errors(self):
        bare = make_grid(VTK_TETRA, ball)
        painted = add_array(make_structured_grid(ball), "height", height)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, painted)
        blocks.SetBlock(1, bare)
        vectors = vtkMultiBlockDataSet()
        vectors.SetBlock(0, painted)
        vectors.SetBlock(1, add_array(make_grid(VTK_TETRA, ball), "height", lambda p: p))
        short = add_array(make_grid(VTK_TETRA, ball), "height", height)
        short.GetPointData().GetArray("height").SetNumberOfTuples(7)
        for data, text in ((bare, 'no array named "height"'), (blocks, 'no array named "height"'),
                           (short, 'no array named "height"')):
            with self.subTest(text):
                mapper, volume, renderer = make_scene(data, "height")

                def draw(mapper=mapper, volume=volume, renderer=renderer):
                    self.assertFalse(mapper.RenderToImage(
                        volume, renderer.GetActiveCamera(), None, PIXELS, PIXELS, vtkImageData()))

                messages = errors_of(mapper, draw)
                self.assertEqual(len(messages), 1, messages)
                self.assertIn(text, messages[0])
                self.assertEqual(errors_of(mapper, draw), [])
        mapper, volume, renderer = make_scene(vectors, "height")
        messages = errors_of(mapper, lambda: take_picture((mapper, volume, renderer)), vtkCommand.WarningEvent)
        self.assertEqual(len(messages), 1)
        self.assertIn("Block 2 of the composite input is left out. It has 3 components to colour by", messages[0])


if __name__ == "__main__":
    unittest.main()
