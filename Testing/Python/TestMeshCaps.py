#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Caps on the clipping planes of meshes: where VTK's own cells say that the inside of a surface is, with the
colours of the values there. The picture that was made is left in ./mesh-caps.png."""

import itertools
import math
import unittest

from vtkmodules.vtkCommonCore import mutable, vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_PYRAMID,
    VTK_TETRA,
    VTK_WEDGE,
    vtkDataObject,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPlane,
    vtkPolyData,
    vtkRectilinearGrid,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkProbeFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkHardwareSelector,
    vtkLight,
    vtkLightCollection,
    vtkRenderer,
    vtkRenderWindow,
)
import vtkmodules.vtkRenderingOpenGL2  # the window
from vtkIsosurfaceRayTracing import vtkIsosurfacePicker

try:
    from vtkmodules.vtkFiltersCore import vtkExtractCells  # VTK 9.3 and newer
except ImportError:
    from vtkmodules.vtkFiltersExtraction import vtkExtractCells

from MeshTesting import CENTER, SIZE, ball, make_grid, make_structured_grid, make_volume, set_values
from PictureTesting import SIZE as PICTURE_SIZE
from PictureTesting import PictureTestCase, read

PIXELS = 100
LOW, HIGH = 0.0, 2.0
BLUE, RED = (0.1, 0.2, 0.9), (0.9, 0.4, 0.0)
SHAPES = (VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID)


def make_voxels(value):
    image = vtkImageData()
    image.SetDimensions(SIZE + 1, SIZE + 1, SIZE + 1)
    append = vtkAppendFilter()
    append.AddInputData(set_values(image, value))
    append.Update()
    return append.GetOutput()


def add_plane(mapper, origin, normal):
    plane = vtkPlane()
    plane.SetOrigin(origin)
    plane.SetNormal(normal)
    mapper.AddClippingPlane(plane)
    mapper.CapClippingPlanesOn()
    return plane


def is_on(plane, point):
    return abs(plane.EvaluateFunction(point)) < 1e-5  # some points are float


class Scene:
    """Surfaces that are not lit, so that caps have the colours of values, cut by a plane."""

    def __init__(self, data, *isovalues):
        self.mapper, self.volume = make_volume(data, *isovalues)
        self.surface = self.volume.GetProperty()
        self.surface.ShadeOff()
        colors = self.surface.GetRGBTransferFunction()
        colors.RemoveAllPoints()
        colors.AddRGBPoint(LOW, *BLUE)
        colors.AddRGBPoint(HIGH, *RED)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetPosition(1.0, 0.6, 0.8)
        self.renderer.ResetCamera()

    def take_picture(self, lights=None, size=PIXELS):
        image = vtkImageData()
        assert self.mapper.RenderToImage(self.volume, self.camera, lights, size, size, image)
        return image

    def take_pixels(self, lights=None):
        """The pixels with a surface: number, colour, position, normal, cell."""
        data = self.take_picture(lights).GetPointData()
        colors, positions, normals, cells = (
            data.GetArray(name) for name in ("Colors", "Position", "Normals", "CellId"))
        return [(i, colors.GetTuple(i), positions.GetTuple(i), normals.GetTuple(i), int(cells.GetTuple1(i)))
                for i in range(PIXELS**2) if cells.GetTuple1(i) >= 0]  # fmt: skip


def probe(grid, points):
    """The values of a grid at points by VTK's cells; None outside."""
    probed = vtkPoints()
    probed.SetDataTypeToDouble()
    for point in points:
        probed.InsertNextPoint(point)
    where = vtkPolyData()
    where.SetPoints(probed)
    probe_filter = vtkProbeFilter()
    probe_filter.SetInputData(where)
    probe_filter.SetSourceData(grid)
    probe_filter.Update()
    data = probe_filter.GetOutput().GetPointData()
    values, valid = data.GetArray("values"), data.GetArray(probe_filter.GetValidPointMaskArrayName())
    return [values.GetTuple1(i) if valid.GetTuple1(i) else None for i in range(len(points))]


def points_in_plane(plane, camera):
    """Where the rays of pixels of a square picture meet a plane: the world point by number of pixel."""
    matrix = camera.GetCompositeProjectionTransformMatrix(1.0, -1.0, 1.0)
    matrix.Invert()
    eye = camera.GetPosition()
    found = {}
    for i in range(PIXELS**2):
        x, y = (2.0 * (k + 0.5) / PIXELS - 1.0 for k in (i % PIXELS, i // PIXELS))
        *far, w = matrix.MultiplyPoint((x, y, 1.0, 1.0))
        way = [f / w - e for f, e in zip(far, eye)]
        slope = sum(n * d for n, d in zip(plane.GetNormal(), way))
        t = -plane.EvaluateFunction(eye) / slope
        found[i] = tuple(e + t * d for e, d in zip(eye, way))
    return found


def make_lights(*position):
    light = vtkLight()
    light.SetPosition(position)
    light.SetFocalPoint(CENTER)
    lights = vtkLightCollection()
    lights.AddItem(light)
    return lights


class TestMeshCaps(PictureTestCase):
    def check_caps(self, grid, scene, plane, isovalue):
        """Every pixel has a cap where VTK's cells have a value inside, and no other one has."""
        points = points_in_plane(plane, scene.camera)
        values = probe(grid, list(points.values()))
        pixels = {pixel[0]: pixel for pixel in scene.take_pixels()}
        caps = 0
        for (i, point), value in zip(points.items(), values):
            if value is not None and abs(value - isovalue) < 1e-6:
                continue
            is_cap = i in pixels and is_on(plane, pixels[i][2])
            self.assertEqual(is_cap, value is not None and value > isovalue, f"pixel {i}: {value} at {point}")
            if is_cap:
                caps += 1
                _, color, position, normal, _ = pixels[i]
                self.assertLess(math.dist(point, position), 1e-5)
                self.assertLess(math.dist(normal, [-n for n in plane.GetNormal()]), 1e-12)
                part = (value - LOW) / (HIGH - LOW)
                for channel, low, high in zip(color, BLUE, RED):
                    self.assertAlmostEqual(channel, 255.0 * (low + part * (high - low)), delta=0.6)
        self.assertGreater(caps, 500)

    def test_caps_are_where_cells_of_vtk_have_larger_values(self):
        grids = {shape: make_grid(shape, ball) for shape in SHAPES}
        grids["voxels"] = make_voxels(ball)
        grids["curvilinear"] = make_structured_grid(ball)
        for name, grid in grids.items():
            for origin, normal in (((3.0, 3.1, 3.2), (-0.8, 0.1, -0.6)), ((3.0, 3.0, 3.0), (-1.0, 0.0, 0.0))):
                with self.subTest(name, normal=normal):
                    scene = Scene(grid, 0.2)
                    plane = add_plane(scene.mapper, origin, normal)
                    length = math.hypot(*normal)
                    plane.SetNormal([n / length for n in normal])
                    self.check_caps(grid, scene, plane, 0.2)

    def test_picks_and_selections_are_of_caps(self):
        grid = make_structured_grid(ball)
        scene = Scene(grid, 0.2)
        plane = add_plane(scene.mapper, (3.0, 3.1, 3.2), (-0.8, 0.0, -0.6))
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(PIXELS, PIXELS)
        window.AddRenderer(scene.renderer)
        window.Render()
        caps = [pixel for pixel in scene.take_pixels() if is_on(plane, pixel[2])]
        self.assertGreater(len(caps), 500)
        picker, selector = vtkIsosurfacePicker(), vtkHardwareSelector()
        selector.SetRenderer(scene.renderer)
        selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_CELLS)
        eye = scene.camera.GetPosition()
        for i, _, position, normal, cell in caps[::97]:
            x, y = i % PIXELS, i // PIXELS
            self.assertEqual(picker.Pick(x, y, 0.0, scene.renderer), 1)
            self.assertEqual(picker.GetCellId(), cell)
            self.assertEqual(picker.GetIsovalue(), 0.2)
            self.assertEqual(picker.GetPickPosition(), position)
            self.assertEqual(picker.GetPickNormal(), normal)
            found, weights = [0.0] * 3, [0.0] * 8
            grid.GetCell(cell).EvaluateLocation(mutable(0), picker.GetPCoords(), found, weights)
            self.assertLess(math.dist(found, position), 1e-12)
            selector.SetArea(x, y, x, y)
            node = selector.Select().GetNode(0)
            self.assertEqual([int(node.GetSelectionList().GetTuple1(0))], [cell])
            behind = [2.0 * p - e for p, e in zip(position, eye)]
            t, isovalue, cell_id = mutable(0.0), mutable(0.0), mutable(0)
            outputs = [[0.0] * 3 for _ in range(3)]
            self.assertEqual(scene.mapper.IntersectWithLine(
                scene.volume, eye, behind, t, outputs[0], outputs[1], cell_id, isovalue, outputs[2]), 1)  # fmt: skip
            self.assertAlmostEqual(t.get(), 0.5, delta=1e-9)
            self.assertEqual(cell_id.get(), cell)

    def test_blocks_have_the_caps_of_the_whole(self):
        """The plane is the one between them, or goes through both."""
        whole = make_grid(VTK_HEXAHEDRON, ball)
        blocks = vtkMultiBlockDataSet()
        for i in range(2):
            extract = vtkExtractCells()
            extract.SetInputData(whole)
            for cell in range(whole.GetNumberOfCells()):
                bounds = whole.GetCell(cell).GetBounds()
                if (bounds[0] >= 3.0) == (i == 1):
                    extract.AddCellRange(cell, cell)
            extract.Update()
            block = vtkUnstructuredGrid()
            block.ShallowCopy(extract.GetOutput())
            blocks.SetBlock(i, block)
        for origin, normal in (((3.0, 0.0, 0.0), (1.0, 0.0, 0.0)), ((3.0, 0.0, 0.0), (-1.0, 0.0, 0.0)),
                               ((3.0, 2.0, 3.0), (-0.4, -0.5, -0.7))):  # fmt: skip
            with self.subTest(normal=normal):
                pictures = []
                for data in (whole, blocks):
                    scene = Scene(data, 0.2)
                    scene.surface.GetScalarOpacity().AddPoint(0.2, 0.6)
                    scene.camera.SetPosition([c - 12.0 * n for c, n in zip(CENTER, normal)])
                    plane = add_plane(scene.mapper, origin, normal)
                    pixels = scene.take_pixels()
                    self.assertGreater(sum(is_on(plane, position) for _, _, position, _, _ in pixels), 500)
                    pictures.append([(i, [round(c) for c in color]) for i, color, *_ in pixels])
                one, other = pictures
                self.assertEqual([i for i, _ in one], [i for i, _ in other])
                for (_, color), (_, expected) in zip(one, other):
                    self.assertLessEqual(max(abs(a - b) for a, b in zip(color, expected)), 1)

    def test_the_first_of_coinciding_caps_is_seen(self):
        """By the picture and by its single rays, whatever the kinds of blocks and the precision of points."""

        def make_block(kind, size):
            if kind == "image":
                image = vtkImageData()
                image.SetDimensions(SIZE + 1, SIZE + 1, SIZE + 1)
                return set_values(image, lambda _: 1.0)
            if kind == "planes":
                grid, planes = vtkRectilinearGrid(), vtkFloatArray()
                for i in range(SIZE + 1):
                    planes.InsertNextValue(i**1.1 * SIZE / SIZE**1.1)
                grid.SetDimensions(SIZE + 1, SIZE + 1, SIZE + 1)
                grid.SetXCoordinates(planes)
                grid.SetYCoordinates(planes)
                grid.SetZCoordinates(planes)
                return set_values(grid, lambda _: 1.0)
            mesh = make_grid(kind, lambda _: 1.0)
            moved = vtkPoints()  # of floats
            for i in range(mesh.GetNumberOfPoints()):
                moved.InsertNextPoint([size * (c - 3.0) + 3.0 + 0.1 * math.sin(7.0 * i + k)
                                       for k, c in enumerate(mesh.GetPoint(i))])  # fmt: skip
            mesh.SetPoints(moved)
            return mesh

        kinds = (VTK_TETRA, VTK_HEXAHEDRON, "image", "planes")
        for first, second in itertools.product(kinds, kinds):
            with self.subTest(first=first, second=second):
                blocks = vtkMultiBlockDataSet()
                # Rays come to the second first, if it is larger.
                for i, kind in enumerate((first, second)):
                    blocks.SetBlock(i, make_block(kind, 1.0 + 0.3 * i))
                scene = Scene(blocks, 0.5)
                plane = add_plane(scene.mapper, (2.9, 3.1, 3.05), (-0.48, -0.6, -0.64))
                caps = [pixel for pixel in scene.take_pixels()
                        if is_on(plane, pixel[2]) and all(0.5 < c < SIZE - 0.5 for c in pixel[2])]  # fmt: skip
                self.assertGreater(len(caps), 500)
                cells = blocks.GetBlock(0).GetNumberOfCells()
                self.assertEqual(sum(cell >= cells for *_, cell in caps), 0)
                for _, _, position, _, cell in caps[::97]:
                    eye = scene.camera.GetPosition()
                    behind = [2.0 * p - e for p, e in zip(position, eye)]
                    t, isovalue, found = mutable(0.0), mutable(0.0), mutable(0)
                    outputs = [[0.0] * 3 for _ in range(3)]
                    self.assertEqual(scene.mapper.IntersectWithLine(
                        scene.volume, eye, behind, t, outputs[0], outputs[1], found, isovalue, outputs[2]), 1)  # fmt: skip
                    self.assertLess(found.get(), cells)

    def test_a_block_before_others_on_a_lattice_that_it_cuts(self):
        """The images on both sides of it in the list are traced as one, and are seen before and behind it."""
        images = []
        for x in (-SIZE, 0):
            image = vtkImageData()
            image.SetDimensions(SIZE + 1, SIZE + 1, SIZE + 1)
            image.SetOrigin(x, 0.0, 0.0)
            images.append(set_values(image, lambda _: 1.0))
        mesh = make_grid(VTK_TETRA, lambda _: 1.0)
        for order in ((images[0], mesh, images[1]), (images[1], mesh, images[0])):
            blocks = vtkMultiBlockDataSet()
            for i, block in enumerate(order):
                blocks.SetBlock(i, block)
            scene = Scene(blocks, 0.5)
            plane = add_plane(scene.mapper, (2.9, 3.1, 3.05), (-0.48, -0.6, -0.64))
            caps = [pixel for pixel in scene.take_pixels()
                    if is_on(plane, pixel[2]) and all(0.01 < c < SIZE - 0.01 for c in pixel[2])]  # fmt: skip
            self.assertGreater(len(caps), 500)
            first = images[1] if order[0] is images[1] else mesh
            begin = 0 if first is images[1] else images[0].GetNumberOfCells()
            ends = range(begin, begin + first.GetNumberOfCells())
            self.assertEqual(sum(cell not in ends for *_, cell in caps), 0)

    def test_caps_have_the_colours_of_an_array(self):
        grid = make_grid(VTK_WEDGE, ball)
        heights = make_grid(VTK_WEDGE, lambda point: point[2] / SIZE * HIGH).GetPointData().GetScalars()
        heights.SetName("height")
        grid.GetPointData().AddArray(heights)
        scene = Scene(grid, 0.2)
        plane = add_plane(scene.mapper, (3.0, 3.0, 3.0), (-0.8, 0.0, -0.6))
        scene.mapper.SetColorArrayName("height")
        caps = [pixel for pixel in scene.take_pixels() if is_on(plane, pixel[2])]
        self.assertGreater(len(caps), 500)
        for _, color, position, _, _ in caps:
            for channel, low, high in zip(color, BLUE, RED):
                self.assertAlmostEqual(channel, 255.0 * (low + position[2] / SIZE * (high - low)), delta=0.6)

    def test_light_does_not_pass_caps(self):
        """From within, with the light outside of the opening; and caps lose no light themselves."""
        scene = Scene(make_grid(VTK_TETRA, ball), 0.0)
        plane = add_plane(scene.mapper, (3.0, 2.8, 3.0), (0.0, 1.0, 0.0))
        scene.surface.ShadeOn()
        scene.surface.SetAmbient(0.0)
        scene.surface.SetDiffuse(1.0)
        scene.surface.SetSpecular(0.0)
        scene.mapper.ShadowsOn()
        lights = make_lights(3.3, -30.0, 3.4)
        scene.camera.SetPosition(5.0, -12.0, 4.0)
        scene.camera.SetFocalPoint(CENTER)
        scene.renderer.ResetCameraClippingRange()
        shadowed = scene.take_pixels(lights)
        scene.mapper.ShadowsOff()
        plain = scene.take_pixels(lights)
        scene.mapper.ShadowsOn()
        caps = 0
        for one, other in zip(shadowed, plain):
            if is_on(plane, one[2]):
                caps += 1
                self.assertEqual(one, other)
        self.assertGreater(caps, 500)
        scene.camera.SetPosition(3.1, 3.0, 3.1)
        scene.camera.SetFocalPoint(3.2, 4.0, 3.3)
        scene.camera.SetViewAngle(60.0)
        scene.camera.SetClippingRange(0.01, 9.0)
        lit = []
        for has_caps in (False, True):
            scene.mapper.SetCapClippingPlanes(has_caps)
            lit.append(sum(color[0] > 0.0 for _, color, *_ in scene.take_pixels(lights)))
        self.assertGreater(lit[0], 500)
        self.assertEqual(lit[1], 0)

    def test_threads_change_nothing(self):
        pictures = []
        for threads in (1, 3):
            scene = Scene(make_grid(VTK_PYRAMID, ball), 0.2, 1.0)
            scene.surface.GetScalarOpacity().AddPoint(0.2, 0.5)
            add_plane(scene.mapper, (3.0, 3.1, 3.2), (-0.8, 0.1, -0.6))
            scene.mapper.SetNumberOfThreads(threads)
            pictures.append(scene.take_pixels())
        self.assertEqual(*pictures)

    def test_baseline(self):
        """A wedge out of an onion of three surfaces, the outermost translucent, with shadows."""
        scene = Scene(make_structured_grid(ball), 0.0, 0.8, 1.5)
        scene.surface.GetScalarOpacity().AddPoint(0.0, 0.5)
        scene.surface.ShadeOn()
        scene.surface.SetAmbient(0.4)
        scene.surface.SetDiffuse(0.9)
        scene.mapper.ShadowsOn()
        add_plane(scene.mapper, (3.4, 3.0, 3.0), (-1.0, 0.3, -0.2))
        add_plane(scene.mapper, (3.0, 3.0, 3.6), (0.1, -0.2, -1.0))
        scene.camera.Zoom(2.1)
        writer = vtkPNGWriter()
        writer.SetInputData(scene.take_picture(make_lights(40.0, 15.0, 25.0), PICTURE_SIZE))
        writer.SetFileName("mesh-caps.png")
        writer.Write()
        self.check_baselines({"caps": read("mesh-caps.png")}, "mesh")


if __name__ == "__main__":
    unittest.main()
