#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Composite data of any mixture in one mapper: images on several lattices, grids, meshes. Rays hit what they
hit in each block by itself, in the order along the ray."""

import math
import random
import time
import unittest

from vtkmodules.vtkCommonCore import mutable, vtkDoubleArray, vtkMath, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_TETRA,
    vtkDataObject,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPartitionedDataSetCollection,
    vtkPlane,
    vtkRectilinearGrid,
    vtkSelectionNode,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkRenderingCore import (
    vtkCompositeDataDisplayAttributes,
    vtkHardwareSelector,
    vtkLight,
    vtkLightCollection,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
)
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
import vtkmodules.vtkRenderingOpenGL2  # the window
from vtkIsosurfaceRayTracing import vtkIsosurfacePicker, vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper

from PictureTesting import capture
from MeshTesting import (
    SIZE,
    ball,
    cast,
    errors_of,
    make_grid,
    make_structured_grid,
    make_volume,
    parallel_rays,
    plane,
    set_values,
)

PIXELS = 120


def make_image(origin, spacing, points, value, angle=0.0):
    image = vtkImageData()
    image.SetDimensions(points, points + 1, points + 2)
    image.SetOrigin(origin)
    image.SetSpacing(spacing)
    c, s = math.cos(angle), math.sin(angle)
    image.SetDirectionMatrix(c, -s, 0, s, c, 0, 0, 0, 1)
    return set_values(image, value)


def make_rectilinear(value):
    grid = vtkRectilinearGrid()
    grid.SetDimensions(8, 8, 8)
    for i, set_coordinates in enumerate((grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)):
        coordinates = vtkDoubleArray()
        for k in range(8):
            coordinates.InsertNextValue(-0.5 + 0.06 * k * (k + 7 + i))
        set_coordinates(coordinates)
    return set_values(grid, value)


def saddle(point):
    return 0.3 * (point[0] - 3.0) * (point[1] - 3.0) - point[2] + 2.7


def make_blocks():
    """Their surfaces pass through each other."""
    return [
        make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball),
        make_image((2.1, -0.4, 0.4), (0.3, 0.3, 0.3), 14, saddle, 0.5),
        make_rectilinear(lambda p: plane(p) - 3.4),
        make_grid(VTK_TETRA, lambda p: 0.4 + ball(p)),
        make_structured_grid(lambda p: plane(p) - 4.0),
    ]


def multi_block(blocks):
    composite = vtkMultiBlockDataSet()
    for i, block in enumerate(blocks):
        composite.SetBlock(i, block)
    return composite


def collection(blocks):
    composite = vtkPartitionedDataSetCollection()
    for i, block in enumerate(blocks):
        composite.SetPartition(i % 2, i // 2, block)
    return composite


def mapper_of(block):
    is_mesh = block.IsA("vtkUnstructuredGrid") or block.IsA("vtkStructuredGrid")
    return vtkIsosurfaceRayTraceMeshMapper if is_mesh else vtkIsosurfaceRayTraceMapper


def trace(data, mapper_class, rays, opacity, furnish=lambda mapper: None):
    mapper, volume = make_volume(data, 0.0, mapper_class=mapper_class, opacity=opacity)
    furnish(mapper)
    return mapper, cast(mapper, volume, rays)


def expected_hits(blocks, rays, furnish=lambda mapper: None):
    """(ray, t, block, cell, normal), in order, of each block by itself."""
    hits = []
    for number, block in enumerate(blocks):
        _, of_block = trace(block, mapper_of(block), rays, 0.01, furnish)
        hits += [(ray, t, number, cell, normal) for ray, t, cell, normal in of_block]
    return sorted(hits)


class TestManyGrids(unittest.TestCase):
    def check_hits(self, composite, blocks, rays, mapper_class, furnish=lambda mapper: None, tolerance=1e-10):
        expected = expected_hits(blocks, rays, furnish)
        mapper, hits = trace(composite, mapper_class, rays, 0.01, furnish)
        self.assertEqual([hit[0] for hit in hits], [hit[0] for hit in expected])
        self.assertEqual(hits, sorted(hits, key=lambda hit: hit[:2]))
        cell, flat_index = mutable(0), mutable(0)

        def by_block(hit):
            """Caps of several blocks have the same t, but for rounding."""
            return hit[0], mapper.FindBlock(hit[2], cell, flat_index) and int(flat_index), hit[1]

        numbers = sorted({by_block(hit)[1] for hit in hits})
        expected.sort(key=lambda hit: (hit[0], hit[2], hit[1]))
        self.assertEqual(len(numbers), len({hit[2] for hit in expected}))
        for hit, (_, t, block, cell_in_block, normal) in zip(sorted(hits, key=by_block), expected):
            self.assertAlmostEqual(hit[1], t, delta=tolerance * max(1.0, t))
            self.assertIs(mapper.FindBlock(hit[2], cell, flat_index), blocks[block])
            self.assertEqual(cell, cell_in_block)
            self.assertLess(math.dist(hit[3], normal), 1e-6)
        return len(hits)

    def test_hits_are_those_of_each_block_in_order(self):
        blocks = make_blocks()
        for composite in (multi_block(blocks), collection(blocks[:2] + blocks[2:])):
            listed = blocks if composite.IsA("vtkMultiBlockDataSet") else blocks[0::2] + blocks[1::2]
            for mapper_class in (vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper):
                count = self.check_hits(composite, listed, parallel_rays(21), mapper_class)
                self.assertGreater(count, 1000)

    def test_an_opaque_surface_of_a_block_hides_those_behind(self):
        blocks = make_blocks()
        rays = parallel_rays(31)
        nearest = {}
        for ray, t, *_ in expected_hits(blocks, rays):
            nearest.setdefault(ray, t)
        _, hits = trace(multi_block(blocks), vtkIsosurfaceRayTraceMapper, rays, 1.0)
        self.assertEqual(len(hits), len(nearest))
        for ray, t, *_ in hits:
            self.assertAlmostEqual(t, nearest[ray], delta=1e-10 * max(1.0, t))

    def test_clipping_and_caps(self):
        blocks = make_blocks()
        cutter = vtkPlane()
        cutter.SetOrigin(3.0, 2.8, 2.6)
        cutter.SetNormal(0.3, -0.4, -0.8)

        def clip(mapper, caps=False):
            mapper.AddClippingPlane(cutter)
            mapper.SetCapClippingPlanes(caps)

        clipped = self.check_hits(multi_block(blocks), blocks, parallel_rays(21), vtkIsosurfaceRayTraceMapper, clip)
        capped = self.check_hits(multi_block(blocks), blocks, parallel_rays(21), vtkIsosurfaceRayTraceMapper,
                                 lambda mapper: clip(mapper, True), 1e-6)  # meshes move the plane a little
        self.assertGreater(clipped, 300)
        self.assertGreater(capped, clipped + 300)

    def test_far_from_the_origin(self):
        shift = (1e6, -2e6, 3e6)
        blocks = [make_image([a + b for a, b in zip(origin, shift)], (0.4, 0.4, 0.4), 13,
                             lambda p: ball([a - b for a, b in zip(p, shift)]), angle)
                  for origin, angle in (((0.3, 0.2, 0.1), 0.0), ((2.0, 0.1, 0.3), 0.4))]  # fmt: skip
        rays = [([a + b for a, b in zip(origin, shift)], direction) for origin, direction in parallel_rays(21)]
        self.assertGreater(self.check_hits(multi_block(blocks), blocks, rays, vtkIsosurfaceRayTraceMapper), 300)

    def test_hundreds_of_lattices(self):
        random.seed(5)
        blocks = [make_image([random.uniform(-0.5, 5.5) for _ in range(3)],
                             [random.uniform(0.1, 0.3) for _ in range(3)], 4, saddle, random.uniform(0, 6))
                  for _ in range(300)]  # fmt: skip
        composite = multi_block(blocks)
        self.check_hits(composite, blocks, parallel_rays(25), vtkIsosurfaceRayTraceMapper)

    def make_cells(self, composite, count):
        """Sets so many blocks of one tetrahedron."""
        cell = vtkUnstructuredGrid()
        points = vtkPoints()
        for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)):
            points.InsertNextPoint(point)
        cell.SetPoints(points)
        cell.InsertNextCell(VTK_TETRA, 4, range(4))
        set_values(cell, lambda p: p[0] - 0.3)
        for i in range(count):
            block = vtkUnstructuredGrid()
            block.DeepCopy(cell)
            composite.SetBlock(i, block)
        composite.Modified()

    def time_of_cast(self, mapper, volume, x=0.1):
        start = time.process_time()
        hits = cast(mapper, volume, [((x, 0.1, -1.0), (0.15, 0.05, 1.0))] * 3)
        self.assertEqual(len(hits) > 0, x < 1.0)
        return time.process_time() - start

    def test_other_blocks_are_found_in_the_time_of_the_first(self):
        """Those of before are looked for in turn, be there thousands of them."""
        composite = vtkMultiBlockDataSet()
        mapper, volume = make_volume(composite, 0.0, mapper_class=vtkIsosurfaceRayTraceMeshMapper)
        mapper.SetNumberOfThreads(1)  # which need not wait for each other on a busy machine
        seconds = []
        for _ in range(2):
            self.make_cells(composite, 6000)
            seconds.append(self.time_of_cast(mapper, volume))
        self.assertLess(seconds[1], 1.5 * seconds[0] + 0.2)

    def test_blocks_that_are_as_they_were_are_not_selected_again(self):
        """They are looked at, no more, before rays are cast beside them."""
        composite = vtkMultiBlockDataSet()
        self.make_cells(composite, 6000)
        mapper, volume = make_volume(composite, 0.0, mapper_class=vtkIsosurfaceRayTraceMeshMapper)
        mapper.SetNumberOfThreads(1)
        first = self.time_of_cast(mapper, volume, 5.0)
        again = min(self.time_of_cast(mapper, volume, 5.0) for _ in range(5))
        self.assertLess(again, first / 18)

    def test_blocks_one_cell_thick(self):
        def make_block(first, cells):
            image = vtkImageData()
            image.SetExtent(0, 6, 0, 6, first, first + cells)
            values = vtkDoubleArray()
            for i in range(image.GetNumberOfCells()):
                values.InsertNextValue(math.cos(1.3 * (36 * first + i)))
            image.GetCellData().SetScalars(values)
            return image

        def trace_blocks(blocks):
            return trace(multi_block(blocks), vtkIsosurfaceRayTraceMapper, parallel_rays(), 0.01)[1]

        expected = trace_blocks([make_block(0, 6)])
        self.assertGreater(len(expected), 100)
        self.assertEqual(trace_blocks([make_block(z, 1) for z in range(6)]), expected)
        mapper, volume = make_volume(multi_block([make_block(0, 1)]), 0.0, mapper_class=vtkIsosurfaceRayTraceMapper)
        self.assertIn("7 x 7 x 2 points", errors_of(mapper, lambda: cast(mapper, volume, parallel_rays()))[0])

    def test_blocks_far_apart_take_no_memory_between_them(self):
        blocks = [make_image((1e5 * i, 0, 0), (1, 1, 1), 9, lambda p, i=i: 3.0 - math.dist(p, (1e5 * i + 4, 4, 4)))
                  for i in range(5)]  # fmt: skip
        rays = [((1e5 * i + 0.4 * x, 0.4 * y, -5.0), (0, 0.01, 1)) for i in range(5) for x in range(20) for y in range(20)]
        mapper, volume = make_volume(multi_block(blocks), 0.0, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=0.01)
        self.assertGreater(len(cast(mapper, volume, rays)), 500)
        self.assertLess(mapper.GetMacrocellMemory() + mapper.GetBrickMemory(), 200000)
        self.assertEqual(mapper.GetNumberOfBricks(), 0)
        self.check_hits(multi_block(blocks), blocks, rays, vtkIsosurfaceRayTraceMapper)

    def test_a_block_that_changes(self):
        blocks = make_blocks()
        composite = multi_block(blocks)
        mapper, volume = make_volume(composite, 0.0, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=0.01)
        rays = parallel_rays(15)
        for number, value in ((0, saddle), (3, plane), (2, ball)):
            cast(mapper, volume, rays)
            set_values(blocks[number], value)
            again = cast(mapper, volume, rays)
            self.assertEqual([hit[0] for hit in again], [hit[0] for hit in expected_hits(blocks, rays)])
        composite.SetBlock(1, None)
        del blocks[1]
        self.assertEqual([hit[0] for hit in cast(mapper, volume, rays)],
                         [hit[0] for hit in expected_hits(blocks, rays)])

    def test_coordinates_of_a_block_that_change_in_place(self):
        grid = make_rectilinear(saddle)
        mapper, volume = make_volume(multi_block([grid]), 0.1, mapper_class=vtkIsosurfaceRayTraceMapper)
        self.assertEqual(mapper.GetBounds(), grid.GetBounds())
        coordinates = grid.GetXCoordinates()
        for i in range(8):
            coordinates.SetValue(i, 3.0 * coordinates.GetValue(i))
        coordinates.Modified()
        self.assertEqual(mapper.GetBounds(), grid.GetBounds())
        self.assertEqual(volume.GetBounds(), grid.GetBounds())

    def test_blocks_that_come_and_go(self):
        """In a tree in the tree, whose own time alone says so."""
        first, second, *_ = make_blocks()
        inner = multi_block([first, second])
        outer = multi_block([inner])
        mapper, volume = make_volume(outer, 0.0, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=0.5)
        rays = parallel_rays(PIXELS)

        def check(blocks):
            bounds = mapper.GetBounds()
            picture = cast(mapper, volume, rays)
            other, other_volume = make_volume(
                multi_block(blocks), 0.0, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=0.5)
            self.assertEqual(picture, cast(other, other_volume, rays))
            self.assertEqual(bounds, other.GetBounds())

        check([first, second])
        changes = [
            (lambda: inner.RemoveBlock(1), [first]),
            (lambda: inner.SetBlock(0, second), [second]),
            (lambda: inner.ShallowCopy(multi_block([second, first])), [second, first]),
            (inner.Initialize, []),
            (lambda: inner.SetBlock(2, first), [first]),
            (lambda: outer.SetBlock(0, second), [second]),
        ]
        for change, blocks in changes:
            change()
            if blocks:
                check(blocks)
            else:
                self.assertFalse(vtkMath.AreBoundsInitialized(mapper.GetBounds()))

    def test_window_picture_and_selection(self):
        blocks = make_blocks()
        mapper, volume = make_volume(multi_block(blocks), 0.0, mapper_class=vtkIsosurfaceRayTraceMapper)
        mapper.ShadowsOn()
        renderer = vtkRenderer()
        renderer.AddVolume(volume)
        renderer.SetBackground(0.2, 0.3, 0.4)
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(PIXELS, PIXELS)
        window.AddRenderer(renderer)
        renderer.ResetCamera()
        renderer.GetActiveCamera().Azimuth(130)
        renderer.GetActiveCamera().Elevation(-35)
        renderer.ResetCameraClippingRange()
        window.Render()
        lights = vtkLightCollection()
        light = vtkLight()
        light.SetLightTypeToHeadlight()
        lights.AddItem(light)
        image = vtkImageData()
        self.assertTrue(mapper.RenderToImage(volume, renderer.GetActiveCamera(), lights, PIXELS, PIXELS, image))
        cells = image.GetPointData().GetArray("CellId")
        selector = vtkHardwareSelector()
        selector.SetRenderer(renderer)
        selector.SetArea(0, 0, PIXELS - 1, PIXELS - 1)
        selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_CELLS)
        selected = set()
        selection = selector.Select()
        for node in map(selection.GetNode, range(selection.GetNumberOfNodes())):
            block = node.GetProperties().Get(vtkSelectionNode.COMPOSITE_INDEX())
            ids = node.GetSelectionList()
            selected |= {(block, ids.GetValue(i)) for i in range(ids.GetNumberOfValues())}
        seen = set()
        in_block, flat_index = mutable(0), mutable(0)
        shown = set()
        for cell in {cells.GetValue(i) for i in range(cells.GetNumberOfValues())} - {-1}:
            mapper.FindBlock(int(cell), in_block, flat_index)
            shown.add((int(flat_index), int(in_block)))
        self.assertEqual(selected, shown)
        for pixel in range(0, PIXELS**2, 7):
            cell = int(cells.GetValue(pixel))
            x, parametric, normal = [0.0] * 3, [0.0] * 3, [0.0] * 3
            picked, isovalue = mutable(-1), mutable(0.0)
            hit = mapper.PickPixel(renderer, volume, pixel % PIXELS, pixel // PIXELS, x, parametric, picked, isovalue, normal)
            self.assertEqual(hit, 1 if cell >= 0 else 0)
            if cell >= 0:
                self.assertEqual(picked, cell)
                block = mapper.FindBlock(cell, in_block, flat_index)
                self.assertIs(block, blocks[int(flat_index) - 1])
                seen.add(int(flat_index))
        self.assertGreaterEqual(len(seen), 3)

    def test_visibility_of_blocks(self):
        blocks = make_blocks()
        composite = vtkMultiBlockDataSet()
        composite.SetBlock(0, multi_block(blocks[:3]))
        composite.SetBlock(1, multi_block(blocks[3:]))
        mapper, volume = make_volume(composite, 0.0, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=0.01)
        rays = parallel_rays(15)
        attributes = vtkCompositeDataDisplayAttributes()
        mapper.SetCompositeDataDisplayAttributes(attributes)

        def check(*visible):
            """Blocks keep their numbers of cells."""
            listed = [blocks[i] for i in visible]
            hits, expected = cast(mapper, volume, rays), expected_hits(listed, rays)
            self.assertEqual([hit[0] for hit in hits], [hit[0] for hit in expected])
            in_block, flat_index = mutable(0), mutable(0)
            for hit, other in zip(hits, expected):
                self.assertIs(mapper.FindBlock(hit[2], in_block, flat_index), listed[other[2]])
            bounds = [listed[0].GetBounds()[i] for i in range(6)]
            for block in listed[1:]:
                bounds = [(min, max)[i % 2](a, b) for i, (a, b) in enumerate(zip(bounds, block.GetBounds()))]
            self.assertEqual(list(mapper.GetBounds()), bounds)

        check(0, 1, 2, 3, 4)
        attributes.SetBlockVisibility(blocks[1], False)
        check(0, 2, 3, 4)
        attributes.SetBlockVisibility(composite.GetBlock(0), False)
        check(3, 4)
        attributes.SetBlockVisibility(blocks[2], True)
        check(2, 3, 4)
        attributes.SetBlockVisibility(composite, False)
        check(2)
        attributes.RemoveBlockVisibilities()
        check(0, 1, 2, 3, 4)

    def test_colours_of_blocks(self):
        """Also of images on one lattice, which are one image."""
        halves = [make_image((3.0 * i, 0, 0), (0.25, 0.25, 0.25), 13, ball) for i in range(2)]
        meshes = [make_grid(VTK_TETRA, lambda p: 0.4 - math.dist(p, (1.0, 3.0, 5.0)) + 0.6)]
        camera = vtkRenderer().MakeCamera()
        camera.SetPosition(3, 3, 30)
        camera.SetFocalPoint(3, 3, 0)
        camera.SetClippingRange(10, 50)
        colors = ((1.0, 0.0, 0.2), (0.0, 0.4, 1.0))
        for mapper_class in (vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper):
            blocks = halves + meshes
            mapper, volume = make_volume(multi_block(blocks), 0.0, mapper_class=mapper_class)
            volume.GetProperty().ShadeOff()
            attributes = vtkCompositeDataDisplayAttributes()
            mapper.SetCompositeDataDisplayAttributes(attributes)
            for chosen in ((), (1,), (0, 2)):
                attributes.RemoveBlockColors()
                for k, i in enumerate(chosen):
                    attributes.SetBlockColor(blocks[i], colors[k])
                image = vtkImageData()
                self.assertTrue(mapper.RenderToImage(volume, camera, None, PIXELS, PIXELS, image))
                data = image.GetPointData()
                seen = set()
                in_block, flat_index = mutable(0), mutable(0)
                for pixel in range(PIXELS**2):
                    cell = int(data.GetArray("CellId").GetValue(pixel))
                    if cell < 0:
                        continue
                    mapper.FindBlock(cell, in_block, flat_index)
                    number = int(flat_index) - 1
                    seen.add(number)
                    expected = colors[chosen.index(number)] if number in chosen else (0.9, 0.7, 0.5)
                    for channel in range(3):
                        self.assertAlmostEqual(data.GetArray("Colors").GetComponent(pixel, channel),
                                               255 * expected[channel], delta=1)
                self.assertEqual(seen, {0, 1, 2})

    def draw(self, mapper, volume):
        """Of each pixel the colour, lit from a side, and the block; an error fails."""
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(-20, 10, 30)
        light.SetFocalPoint(3, 3, 3)
        lights = vtkLightCollection()
        lights.AddItem(light)
        camera = vtkRenderer().MakeCamera()
        camera.SetPosition(10, 9, 24)
        camera.SetFocalPoint(1, 3, 2)
        camera.SetClippingRange(10, 60)
        image = vtkImageData()

        def render():
            self.assertTrue(mapper.RenderToImage(volume, camera, lights, PIXELS, PIXELS, image))

        self.assertEqual(errors_of(mapper, render), [])
        data = image.GetPointData()
        cell_in_block, flat_index = mutable(0), mutable(0)
        pixels = []
        for i in range(PIXELS**2):
            cell = int(data.GetArray("CellId").GetValue(i))
            block = mapper.FindBlock(cell, cell_in_block, flat_index) if cell >= 0 else None
            pixels.append((data.GetArray("Colors").GetTuple(i), block))
        return pixels

    def check_same(self, pixels, others):
        self.assertGreater(sum(block is not None for _, block in pixels), PIXELS**2 // 10)
        different = 0
        for (color, block), (other, expected) in zip(pixels, others):
            different += max(abs(a - b) for a, b in zip(color, other)) > 1 or block is not expected
        self.assertLess(different, PIXELS**2 // 1000)

    def test_opacities_of_blocks(self):
        """As of connections whose volumes have these opacities: also of images on one lattice."""
        halves = [
            make_image((-6 + 3.0 * i, 0, 0), (0.25, 0.25, 0.25), 13, lambda p: 1.4 - p[2] + 0.1 * p[0])
            for i in range(2)
        ]
        blocks = halves + make_blocks()
        for mapper_class in (vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper):
            for opacity, chosen in ((1.0, {0: 0.3, 3: 0.6, 5: 0.45}), (0.8, {1: 1.0, 4: 0.4, 6: 1.0})):
                mapper, volume = make_volume(multi_block(blocks), 0.0, mapper_class=mapper_class, opacity=opacity)
                mapper.ShadowsOn()
                self.assertEqual(mapper.HasOnlyOpaqueSurfaces(volume), opacity == 1.0)
                attributes = vtkCompositeDataDisplayAttributes()
                mapper.SetCompositeDataDisplayAttributes(attributes)
                plain = self.draw(mapper, volume)
                for number, own in chosen.items():
                    attributes.SetBlockOpacity(blocks[number], own)
                self.assertFalse(mapper.HasOnlyOpaqueSurfaces(volume))
                pixels = self.draw(mapper, volume)
                expected_mapper, expected_volume = make_volume(None, mapper_class=mapper_class)
                expected_mapper.ShadowsOn()
                for number, block in enumerate(blocks):
                    producer = vtkTrivialProducer()
                    producer.SetOutput(multi_block([block]))
                    expected_mapper.AddInputConnection(0, producer.GetOutputPort())
                    _, own = make_volume(block, 0.0, mapper_class=mapper_class, opacity=chosen.get(number, opacity))
                    expected_mapper.SetConnectionVolume(number, own)
                self.check_same(pixels, self.draw(expected_mapper, expected_volume))
                self.assertNotEqual(pixels, plain)
                attributes.RemoveBlockOpacities()
                self.assertEqual(self.draw(mapper, volume), plain)

    def test_opacities_of_nodes_and_of_all_blocks(self):
        blocks = make_blocks()
        composite = vtkMultiBlockDataSet()
        composite.SetBlock(0, multi_block(blocks[:3]))
        composite.SetBlock(1, multi_block(blocks[3:]))
        mapper, volume = make_volume(composite, 0.0, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=0.5)
        attributes = vtkCompositeDataDisplayAttributes()
        mapper.SetCompositeDataDisplayAttributes(attributes)
        half = self.draw(mapper, volume)
        attributes.SetBlockOpacity(composite, 7.0)
        self.assertTrue(mapper.HasOnlyOpaqueSurfaces(volume))
        opaque = self.draw(mapper, volume)
        volume.GetProperty().GetScalarOpacity().RemoveAllPoints()
        volume.GetProperty().GetScalarOpacity().AddPoint(0.0, 1.0)
        attributes.RemoveBlockOpacities()
        self.assertEqual(opaque, self.draw(mapper, volume))
        attributes.SetBlockOpacity(composite, 0.5)
        self.assertEqual(half, self.draw(mapper, volume))
        attributes.SetBlockOpacity(composite.GetBlock(1), 0.0)
        attributes.SetBlockOpacity(blocks[3], 1.0)
        faded = self.draw(mapper, volume)
        attributes.RemoveBlockOpacities()
        attributes.SetBlockOpacity(composite.GetBlock(0), 0.5)
        attributes.SetBlockVisibility(blocks[4], False)
        self.assertEqual(faded, self.draw(mapper, volume))

    def test_opacity_of_a_block_by_itself(self):
        for block in make_blocks():
            composite = multi_block([block])
            mapper, volume = make_volume(composite, 0.0, mapper_class=mapper_of(block))
            attributes = vtkCompositeDataDisplayAttributes()
            mapper.SetCompositeDataDisplayAttributes(attributes)
            attributes.SetBlockOpacity(block, 0.25)
            expected = self.draw(*make_volume(composite, 0.0, mapper_class=mapper_of(block), opacity=0.25))
            self.assertEqual(self.draw(mapper, volume), expected)

    def test_nothing_is_drawn_of_hidden_blocks(self):
        """Where no block is visible, that is no error."""
        blocks = make_blocks()
        composite = multi_block(blocks)
        mapper, volume = make_volume(composite, 0.0, mapper_class=vtkIsosurfaceRayTraceMapper)
        attributes = vtkCompositeDataDisplayAttributes()
        mapper.SetCompositeDataDisplayAttributes(attributes)
        before = self.draw(mapper, volume)
        attributes.SetBlockVisibility(composite, False)
        self.assertEqual({pixel for pixel in self.draw(mapper, volume)}, {((0.0, 0.0, 0.0, 0.0), None)})
        self.assertEqual(cast(mapper, volume, parallel_rays(5)), [])
        attributes.SetBlockVisibility(composite, True)
        self.assertEqual(self.draw(mapper, volume), before)

    def make_picture(self, mapper, volume):
        camera = vtkRenderer().MakeCamera()
        camera.SetPosition(3, 3, -30)
        camera.SetFocalPoint(3, 3, 0)
        camera.SetClippingRange(10, 50)
        image = vtkImageData()
        self.assertTrue(mapper.RenderToImage(volume, camera, None, PIXELS, PIXELS, image))
        return image

    def make_two_volumes(self, mapper_class, opacity=0.01):
        """An image and a mesh, each with isovalues, colours and a matrix of its own; and each alone."""
        data = [make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball), make_grid(VTK_TETRA, plane)]
        alone = []
        for i, isovalues in enumerate(((0.0, 0.6), (2.5, 3.5, 4.0))):
            _, volume = alone_one = make_volume(
                data[i], *isovalues, mapper_class=mapper_of(data[i]), opacity=opacity)
            volume.SetPosition(0.3 * i, 0.1, -0.2 * i)
            volume.RotateZ(20.0 * i)
            volume.SetScale(1.0 + 0.1 * i, 1.0, 0.9)
            colors = volume.GetProperty().GetRGBTransferFunction()
            colors.RemoveAllPoints()
            colors.AddRGBPoint(0.0, 0.2 + 0.6 * i, 0.5, 0.9 - 0.7 * i)
            alone.append(alone_one)
        mapper, volume = make_volume(None, mapper_class=mapper_class)
        for i, grid in enumerate(data):
            producer = vtkTrivialProducer()
            producer.SetOutput(grid)
            mapper.AddInputConnection(0, producer.GetOutputPort())
            own = vtkVolume()
            own.SetProperty(alone[i][1].GetProperty())
            own.SetUserMatrix(alone[i][1].GetMatrix())
            mapper.SetConnectionVolume(i, own)
        return mapper, volume, alone, data

    def test_several_connections(self):
        rays = parallel_rays(21)
        mapper, volume, alone, data = self.make_two_volumes(vtkIsosurfaceRayTraceMapper)
        for i in (0, 1):
            alone[i][1].ComputeMatrix()
        messages = errors_of(mapper, lambda: cast(mapper, volume, rays))
        self.assertEqual(messages, [])
        expected = sorted((ray, t, i, cell, normal) for i in (0, 1) for ray, t, cell, normal in cast(*alone[i], rays))
        hits = cast(mapper, volume, rays)
        self.assertEqual([hit[0] for hit in hits], [hit[0] for hit in expected])
        self.assertGreater(len({hit[2] for hit in expected}), 1)
        in_block, flat_index = mutable(0), mutable(0)
        for hit, (_, t, number, cell, normal) in zip(hits, expected):
            self.assertAlmostEqual(hit[1], t, delta=1e-9)
            self.assertIs(mapper.FindBlock(hit[2], in_block, flat_index), data[number])
            self.assertEqual(in_block, cell)
            self.assertLess(math.dist(hit[3], normal), 1e-6)
        bounds = [alone[0][1].GetBounds()[i] for i in range(6)]
        bounds = [(min, max)[i % 2](a, b) for i, (a, b) in enumerate(zip(bounds, alone[1][1].GetBounds()))]
        for a, b in zip(volume.GetBounds(), bounds):
            self.assertAlmostEqual(a, b, delta=1e-9)
        # Moved together.
        volume.SetPosition(10.0, 0.0, 0.0)
        moved = [((x + 10.0, y, z), direction) for (x, y, z), direction in rays]
        volume.ComputeMatrix()
        for hit, other in zip(cast(mapper, volume, moved), expected):
            self.assertAlmostEqual(hit[1], other[1], delta=1e-9)

    def test_picks_name_the_composite_data_of_their_connection(self):
        """And none, where the connection is a grid by itself."""
        grid = make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball)
        blocks = [make_grid(VTK_TETRA, ball), make_image((8.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, lambda p: ball((p[0] - 8, *p[1:])))]
        composite = multi_block(blocks)
        for inputs in ([grid, composite], [composite, grid]):
            mapper, volume = make_volume(None, 0.0, mapper_class=vtkIsosurfaceRayTraceMapper)
            for i, data in enumerate(inputs):
                producer = vtkTrivialProducer()
                producer.SetOutput(data)
                mapper.AddInputConnection(0, producer.GetOutputPort())
                own = vtkVolume()
                own.SetProperty(volume.GetProperty())
                own.SetPosition(0.0, 0.0 if data is grid else 8.0, 0.0)
                mapper.SetConnectionVolume(i, own)
            renderer = vtkRenderer()
            renderer.AddVolume(volume)
            window = vtkRenderWindow()
            window.SetOffScreenRendering(1)
            window.SetSize(PIXELS, PIXELS)
            window.AddRenderer(renderer)
            renderer.ResetCamera()
            picked = set()
            for pixel in range(0, PIXELS**2, 31):
                picker = vtkIsosurfacePicker()
                if picker.Pick(pixel % PIXELS, pixel // PIXELS, 0, renderer):
                    picked.add((picker.GetDataSet(), picker.GetCompositeDataSet(), picker.GetFlatBlockIndex()))
            self.assertEqual(picked, {(grid, None, -1), (blocks[0], composite, 1), (blocks[1], composite, 2)})

    def test_caps_of_connections_in_one_plane(self):
        """The first is in front, whatever the rounding of each."""
        data = [make_image((0.0, 0.0, 0.0), (0.5, 0.5, 0.5), 13, ball), make_grid(VTK_HEXAHEDRON, ball)]
        for first in (0, 1):
            mapper, volume = make_volume(None, mapper_class=vtkIsosurfaceRayTraceMapper)
            for connection in (0, 1):
                producer = vtkTrivialProducer()
                producer.SetOutput(data[connection ^ first])
                mapper.AddInputConnection(0, producer.GetOutputPort())
                _, own = make_volume(None, 0.0, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=0.5)
                own.SetOrigin(3.0, 3.0, 3.0)
                own.RotateWXYZ(25.0 * (connection ^ first), 1.0, 2.0, 3.0)
                mapper.SetConnectionVolume(connection, own)
            cut = vtkPlane()
            cut.SetOrigin(3.0, 3.0, 3.1)
            cut.SetNormal(0.2, 0.1, 1.0)
            mapper.AddClippingPlane(cut)
            mapper.CapClippingPlanesOn()
            cells = data[first].GetNumberOfCells()
            hits = {}
            for ray, t, cell, normal in cast(mapper, volume, parallel_rays(31)):
                if math.dist([-x for x in normal], [x / math.sqrt(1.05) for x in cut.GetNormal()]) < 1e-9:
                    hits.setdefault(ray, []).append((t, cell < cells))
            both = [found for found in hits.values() if len(found) == 2]
            self.assertGreater(len(both), 50)
            for found in both:
                self.assertEqual(found[0][0], found[1][0])
                self.assertEqual([is_first for _, is_first in found], [True, False])

    def test_hidden_connections(self):
        """Nothing of a connection is there whose volume is not visible."""
        rays = parallel_rays(21)
        mapper, volume, alone, data = self.make_two_volumes(vtkIsosurfaceRayTraceMapper)
        both = cast(mapper, volume, rays)
        bounds = volume.GetBounds()
        for hidden in (0, 1):
            shown = 1 - hidden
            mapper.GetConnectionVolume(hidden).VisibilityOff()
            alone[shown][1].ComputeMatrix()
            before = shown * data[0].GetNumberOfCells()
            expected = [(ray, cell + before) for ray, _, cell, _ in cast(*alone[shown], rays)]
            self.assertGreater(len(expected), 50)
            self.assertEqual([(ray, cell) for ray, _, cell, _ in cast(mapper, volume, rays)], expected)
            for a, b in zip(volume.GetBounds(), alone[shown][1].GetBounds()):
                self.assertAlmostEqual(a, b, delta=1e-9)
            self.assertEqual(self.draw(mapper, volume), self.draw(*alone[shown]))
            # What is wrong with it does not matter.
            values = data[hidden].GetPointData().GetScalars()
            data[hidden].GetPointData().Initialize()
            self.assertEqual(errors_of(mapper, lambda: cast(mapper, volume, rays)), [])
            data[hidden].GetPointData().SetScalars(values)
            mapper.GetConnectionVolume(hidden).VisibilityOn()
            self.assertEqual(cast(mapper, volume, rays), both)
            self.assertEqual(volume.GetBounds(), bounds)
        for i in (0, 1):
            mapper.GetConnectionVolume(i).VisibilityOff()
        self.assertEqual(errors_of(mapper, lambda: self.assertEqual(cast(mapper, volume, rays), [])), [])
        self.assertFalse(mapper.HasOnlyOpaqueSurfaces(volume))

    def test_connections_without_data(self):
        """The others are there, as in a time step for which a filter leaves nothing."""
        rays = parallel_rays(21)
        mapper, volume, alone, data = self.make_two_volumes(vtkIsosurfaceRayTraceMapper)
        both = cast(mapper, volume, rays)
        empty = [multi_block([data[0].NewInstance()]), data[1].NewInstance()]
        producers = [mapper.GetInputConnection(0, i).GetProducer() for i in (0, 1)]
        for i in (0, 1):
            producers[i].SetOutput(empty[i])
            alone[1 - i][1].ComputeMatrix()
            self.assertEqual(errors_of(mapper, lambda: cast(mapper, volume, rays)), [])
            expected = cast(*alone[1 - i], rays)
            self.assertGreater(len(expected), 50)
            self.assertEqual([hit[:1] + hit[2:3] for hit in cast(mapper, volume, rays)], [hit[:1] + hit[2:3] for hit in expected])
            self.assertEqual(self.draw(mapper, volume), self.draw(*alone[1 - i]))
            producers[i].SetOutput(data[i])
            self.assertEqual(cast(mapper, volume, rays), both)
        for i in (0, 1):
            producers[i].SetOutput(empty[i])
        (message,) = errors_of(mapper, lambda: cast(mapper, volume, rays))
        self.assertIn("Connection 0: ", message)

    def test_blocks_of_a_connection_that_was_hidden(self):
        """They are where they were, in every call."""
        images = [make_image((3.0 * i, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball) for i in (0, 1)]
        mapper, volume = make_volume(multi_block(images), 0.0, mapper_class=vtkIsosurfaceRayTraceMapper)
        own = vtkVolume()
        own.SetProperty(volume.GetProperty())
        own.VisibilityOff()
        mapper.SetConnectionVolume(0, own)
        rays = parallel_rays(11)
        self.assertEqual(cast(mapper, volume, rays), [])
        own.VisibilityOn()
        hits = cast(mapper, volume, rays)
        self.assertGreater(len(hits), 20)
        self.assertEqual(cast(mapper, volume, rays), hits)
        own.VisibilityOff()
        self.assertEqual(cast(mapper, volume, rays), [])
        own.VisibilityOn()
        self.assertEqual(cast(mapper, volume, rays), hits)

    def test_numbers_of_connections(self):
        for mapper in (vtkIsosurfaceRayTraceMapper(), vtkIsosurfaceRayTraceMeshMapper()):
            before = mapper.GetMTime()
            (message,) = errors_of(mapper, lambda mapper=mapper: mapper.SetConnectionVolume(-1, vtkVolume()))
            self.assertIn("There is no connection -1", message)
            self.assertEqual(mapper.GetMTime(), before)

    def test_projections_without_a_hidden_connection(self):
        rays = parallel_rays(11)
        values = (lambda p: p[0], lambda p: 10.0 + p[0])
        mapper, volume = make_volume(None, mapper_class=vtkIsosurfaceRayTraceMapper)
        mapper.SetBlendModeToMaximumIntensity()
        for i in (0, 1):
            producer = vtkTrivialProducer()
            producer.SetOutput(make_image((0.0, 0.0, 0.0), (0.5, 0.5, 0.5), 13, values[i]))
            mapper.AddInputConnection(0, producer.GetOutputPort())
            mapper.SetConnectionVolume(i, vtkVolume())
        mapper.GetConnectionVolume(0).VisibilityOff()
        image = self.make_picture(mapper, volume)
        lowest, highest = image.GetPointData().GetArray("Value").GetFiniteRange()
        self.assertGreaterEqual(lowest, 10.0)
        self.assertLessEqual(highest, 16.0)
        self.assertEqual({cell >= 12 * 13 * 14 for _, _, cell, _ in cast(mapper, volume, rays)}, {True})

    def test_colours_of_connections(self):
        mapper, volume, _, data = self.make_two_volumes(vtkIsosurfaceRayTraceMeshMapper, 1.0)
        for i in (0, 1):
            mapper.GetConnectionVolume(i).GetProperty().ShadeOff()
        image = self.make_picture(mapper, volume)
        in_block, flat_index = mutable(0), mutable(0)
        seen = set()
        for pixel in range(PIXELS**2):
            cell = int(image.GetPointData().GetArray("CellId").GetValue(pixel))
            if cell >= 0:
                number = next(i for i, grid in enumerate(data) if grid is mapper.FindBlock(cell, in_block, flat_index))
                seen.add(number)
                color = image.GetPointData().GetArray("Colors").GetTuple(pixel)
                for channel, expected in zip(color, (0.2 + 0.6 * number, 0.5, 0.9 - 0.7 * number)):
                    self.assertAlmostEqual(channel, 255 * expected, delta=1)
        self.assertEqual(seen, {0, 1})

    def test_opaque_and_translucent_connections_in_a_window(self):
        """The picture in a window is the one without, before the background."""
        for opaque in (0, 1):
            mapper, volume, _, _ = self.make_two_volumes(vtkIsosurfaceRayTraceMapper)
            for i in (0, 1):
                surface = mapper.GetConnectionVolume(i).GetProperty()
                surface.ShadeOff()
                surface.GetScalarOpacity().RemoveAllPoints()
                surface.GetScalarOpacity().AddPoint(0.0, 1.0 if i == opaque else 0.4)
            renderer = vtkRenderer()
            renderer.AddVolume(volume)
            renderer.SetBackground(0.2, 0.4, 0.6)
            window = vtkRenderWindow()
            window.SetOffScreenRendering(1)
            window.SetMultiSamples(0)
            window.SetSize(PIXELS, PIXELS)
            window.AddRenderer(renderer)
            renderer.ResetCamera()
            window.Render()
            image = vtkImageData()
            self.assertTrue(mapper.RenderToImage(volume, renderer.GetActiveCamera(), None, PIXELS, PIXELS, image))
            translucent = 0
            shown = capture(window)
            for pixel in range(PIXELS**2):
                *color, alpha = image.GetPointData().GetArray("Colors").GetTuple(pixel)
                translucent += 0 < alpha < 255
                for channel, own, behind in zip(shown[3 * pixel :], color, (51, 102, 153)):
                    self.assertAlmostEqual(channel, own + (1 - alpha / 255) * behind, delta=2)
            self.assertGreater(translucent, 100)

    def test_errors_name_the_connection(self):
        mapper, volume, _, data = self.make_two_volumes(vtkIsosurfaceRayTraceMapper)
        data[1].GetPointData().Initialize()
        messages = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays(5)))
        self.assertEqual(len(messages), 1)
        self.assertIn("Connection 1: The input has no scalars", messages[0])
        mapper, volume, _, _ = self.make_two_volumes(vtkIsosurfaceRayTraceMapper)
        mapper.GetConnectionVolume(0).SetScale(0.0)
        messages = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays(5)))
        self.assertEqual(len(messages), 1)
        self.assertIn("Connection 0: The matrix of the volume", messages[0])

    def test_shadows_fall_from_block_to_block(self):
        floor = make_image((0, 0, 0), (0.5, 0.5, 0.5), 13, lambda p: 1.1 - p[2])
        ball_above = make_grid(VTK_HEXAHEDRON, lambda p: 1.0 - math.dist(p, (3.0, 3.0, 3.5)))
        light = vtkLight()
        light.SetPosition(3, 3, 100)
        light.SetFocalPoint(3, 3, 0)
        lights = vtkLightCollection()
        lights.AddItem(light)
        renderer = vtkRenderer()
        camera = renderer.GetActiveCamera()
        camera.SetPosition(3, -14, 11)
        camera.SetFocalPoint(3, 3, 1)
        camera.SetViewUp(0, 0, 1)
        camera.SetClippingRange(5, 40)

        def draw(shadows):
            mapper, volume = make_volume(multi_block([floor, ball_above]), 0.0, mapper_class=vtkIsosurfaceRayTraceMapper)
            mapper.SetShadows(shadows)
            image = vtkImageData()
            self.assertTrue(mapper.RenderToImage(volume, camera, lights, PIXELS, PIXELS, image))
            return image.GetPointData()

        plain, shaded = draw(False), draw(True)
        inside = outside = 0
        for pixel in range(PIXELS**2):
            x, y, z = plain.GetArray("Position").GetTuple3(pixel)
            if not abs(z - 1.1) < 1e-6:
                continue
            darker = plain.GetArray("Colors").GetTuple(pixel)[0] - shaded.GetArray("Colors").GetTuple(pixel)[0]
            distance = math.hypot(x - 3.0, y - 3.0)
            if distance < 0.5:
                inside += 1
                self.assertGreater(darker, 50)
            elif distance > 1.05:
                outside += 1
                self.assertEqual(darker, 0)
        self.assertGreater(inside, 20)
        self.assertGreater(outside, 500)


if __name__ == "__main__":
    unittest.main()
