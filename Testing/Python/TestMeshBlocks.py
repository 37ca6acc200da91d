#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Composite data in the mapper of meshes: a mesh in blocks is the whole mesh; what blocks may be."""

import math
import unittest

from vtkmodules.vtkCommonCore import mutable, vtkCommand, vtkDoubleArray, vtkIdList, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    VTK_TETRA,
    VTK_TRIANGLE,
    vtkCellArray,
    vtkDataObject,
    vtkDataSetAttributes,
    vtkGenericCell,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPartitionedDataSet,
    vtkSelectionNode,
    vtkPartitionedDataSetCollection,
    vtkPlane,
    vtkPolyData,
    vtkStructuredGrid,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersExtraction import vtkExtractGrid
from vtkmodules.vtkFiltersSources import vtkRandomHyperTreeGridSource
from vtkmodules.vtkRenderingCore import (
    vtkHardwareSelector,
    vtkLight,
    vtkLightCollection,
    vtkRenderer,
    vtkRenderWindow,
)
import vtkmodules.vtkRenderingOpenGL2  # the window
from vtkIsosurfaceRayTracing import vtkIsosurfacePicker

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

CUTS = (3, 2, 4)
PIXELS = 100


def copy_of(kind, data):
    copy = kind()
    copy.ShallowCopy(data)
    return copy


def list_cells(grid):
    """The cells of a structured grid, as an unstructured one."""
    append = vtkAppendFilter()
    append.SetInputData(grid)
    append.Update()
    return copy_of(vtkUnstructuredGrid, append.GetOutput())


def cut(whole, ghosts=0):
    """Eight blocks that share the points between them, every other one structured. With a layer of
    ghosts each reaches a cell further, which is marked as another's."""
    blocks = []
    for i in range(8):
        own = [(CUTS[axis], SIZE) if i >> axis & 1 else (0, CUTS[axis]) for axis in range(3)]
        reach = [(max(low - ghosts, 0), min(high + ghosts, SIZE)) for low, high in own]
        extract = vtkExtractGrid()
        extract.SetInputData(whole)
        extract.SetVOI(*reach[0], *reach[1], *reach[2])
        extract.Update()
        block = copy_of(vtkStructuredGrid, extract.GetOutput())
        if ghosts:
            flags = vtkUnsignedCharArray()
            flags.SetName(vtkDataSetAttributes.GhostArrayName())
            for z in range(*reach[2]):
                for y in range(*reach[1]):
                    for x in range(*reach[0]):
                        is_own = all(low <= k < high for k, (low, high) in zip((x, y, z), own))
                        flags.InsertNextValue(0 if is_own else vtkDataSetAttributes.DUPLICATECELL)
            block.GetCellData().AddArray(flags)
        blocks.append(block if i % 2 == 0 else list_cells(block))
    return blocks


def multi_block(*blocks):
    composite = vtkMultiBlockDataSet()
    for i, block in enumerate(blocks):
        composite.SetBlock(i, block)
    return composite


def partitioned(*blocks):
    composite = vtkPartitionedDataSet()
    for i, block in enumerate(blocks):
        composite.SetPartition(i, block)
    return composite


def collection(*blocks):
    composite = vtkPartitionedDataSetCollection()
    for i, block in enumerate(blocks):
        composite.SetPartition(i % 3, i // 3, block)
    return composite


def nested(*blocks):
    return multi_block(multi_block(*blocks[:3]), None, multi_block(multi_block(*blocks[3:])))


class Scene:
    """A renderer that shows isosurfaces, the first of them opaque."""

    def __init__(self, data, *isovalues):
        self.mapper, self.volume = make_volume(data, *isovalues)
        for isovalue in isovalues[1:]:
            self.volume.GetProperty().GetScalarOpacity().AddPoint(isovalue, 0.4)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetPosition(1.0, 0.6, 0.8)
        self.renderer.ResetCamera()
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(PIXELS, PIXELS)
        self.window.AddRenderer(self.renderer)

    def picture(self):
        image = vtkImageData()
        assert self.mapper.RenderToImage(self.volume, self.camera, None, PIXELS, PIXELS, image)
        return image.GetPointData()


def colors(picture):
    array = picture.GetArray("Colors")
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def count_different(a, b, tolerance=2):
    return sum(max(abs(p - q) for p, q in zip(x, y)) > tolerance for x, y in zip(a, b))


class TestMeshBlocks(unittest.TestCase):
    def test_rays_have_the_hits_of_the_whole(self):
        whole = make_structured_grid(ball)
        isovalues = (1.5, 0.5, -0.4)
        expected_of = Scene(whole, *isovalues)
        expected = cast(expected_of.mapper, expected_of.volume, parallel_rays())
        self.assertGreater(len(expected), 200)
        for make in (multi_block, partitioned, collection, nested):
            for ghosts in (0, 1):
                with self.subTest(make.__name__, ghosts=ghosts):
                    blocks = cut(whole, ghosts)
                    scene = Scene(make(*blocks), *isovalues)
                    hits = cast(scene.mapper, scene.volume, parallel_rays())
                    self.assertEqual(len(hits), len(expected))
                    for hit, other in zip(hits, expected):
                        self.assertEqual(hit[0], other[0])
                        self.assertAlmostEqual(hit[1], other[1], delta=1e-12)
                        self.check_cells(scene.mapper, hit[2], blocks, whole.GetCell(other[2]))
                        if ghosts:
                            self.assertLess(math.dist(hit[3], other[3]), 1e-6)

    def check_cells(self, mapper, number, blocks, expected):
        """A cell of the blocks lies where it is expected."""
        in_block, flat_index = mutable(0), mutable(0)
        block = mapper.FindBlock(number, in_block, flat_index)
        self.assertIn(block, blocks)
        for p, q in zip(block.GetCell(int(in_block)).GetBounds(), expected.GetBounds()):
            self.assertAlmostEqual(p, q, delta=1e-12)

    def test_pictures_are_those_of_the_whole(self):
        """With surfaces that cross the borders, shadows, occlusion and a clipping plane."""
        whole = make_structured_grid(ball)
        pictures = []
        for data in (whole, nested(*cut(whole)), collection(*cut(whole, ghosts=1))):
            scene = Scene(data, 0.5, -0.4)
            clip = vtkPlane()
            clip.SetOrigin(3.0, 3.2, 3.0)
            clip.SetNormal(-0.6, -0.5, 0.7)
            scene.mapper.AddClippingPlane(clip)
            scene.mapper.SetNormalModeToInterpolantGradient()
            scene.mapper.ShadowsOn()
            scene.mapper.AmbientOcclusionOn()
            scene.mapper.SetNumberOfAmbientOcclusionRays(64)
            scene.volume.GetProperty().SetAmbient(0.4)
            pictures.append(colors(scene.picture()))
        self.assertGreater(count_different(pictures[0], [(0, 0, 0, 0)] * PIXELS**2), 1000)
        for picture in pictures[1:]:
            self.assertLess(count_different(pictures[0], picture, 2), 5)

    def test_ghosts_make_normals_without_seams(self):
        whole = make_structured_grid(ball)
        expected = colors(Scene(whole, 0.5).picture())
        seamless = count_different(expected, colors(Scene(multi_block(*cut(whole, ghosts=1)), 0.5).picture()))
        seams = count_different(expected, colors(Scene(multi_block(*cut(whole)), 0.5).picture()))
        self.assertLess(seamless, 5)
        self.assertGreater(seams, 50)

    def test_surfaces_that_pass_through_each_other(self):
        """Their hits are in order along each ray, and the opaque one hides what is behind it."""
        one, other = make_grid(VTK_TETRA, ball), make_structured_grid(lambda p: plane(p) - 3.3)
        hits = cast(*make_volume(multi_block(one, other), 0.0), parallel_rays())
        nearest = {}
        for grid in (one, other):
            for ray, t, _, _ in cast(*make_volume(grid, 0.0), parallel_rays()):
                nearest[ray] = min(t, nearest.get(ray, math.inf))
        self.assertEqual([ray for ray, *_ in hits], sorted(nearest))
        cells = {hit[2] < one.GetNumberOfCells() for hit in hits}
        self.assertEqual(cells, {False, True})
        for ray, t, _, _ in hits:
            self.assertAlmostEqual(t, nearest[ray], delta=1e-12)
        translucent = [make_volume(data, 0.0) for data in (multi_block(one, other), one, other)]
        for _, volume in translucent:
            volume.GetProperty().GetScalarOpacity().RemoveAllPoints()
            volume.GetProperty().GetScalarOpacity().AddPoint(0.0, 0.3)
        both, *single = [[hit[:2] for hit in cast(*pair, parallel_rays())] for pair in translucent]
        self.assertEqual(both, sorted(both))
        self.assertEqual(len(both), len(single[0]) + len(single[1]))
        for hit, expected in zip(both, sorted(single[0] + single[1])):
            self.assertEqual(hit[0], expected[0])
            self.assertAlmostEqual(hit[1], expected[1], delta=1e-12)

    def test_one_block_shadows_another(self):
        """The light comes from above, where the ball is; whatever the unit of length."""
        for unit in (1.0, 1e-7, 1e7):
            ball_block, floor = make_grid(VTK_TETRA, ball), make_structured_grid(lambda p: 1.0 - p[1])
            for block in (ball_block, floor):
                points = block.GetPoints()
                for i in range(block.GetNumberOfPoints()):
                    points.SetPoint(i, [unit * p for p in points.GetPoint(i)])
            for shadows in (False, True):
                with self.subTest(unit=unit, shadows=shadows):
                    scene = Scene(multi_block(ball_block, floor), 0.3)
                    scene.mapper.SetShadows(shadows)
                    scene.camera.SetPosition(3.0 * unit, 16.0 * unit, 3.0 * unit)
                    scene.camera.SetFocalPoint(3.0 * unit, 0.0, 3.0 * unit)
                    scene.camera.SetViewUp(0.0, 0.0, 1.0)
                    scene.camera.SetClippingRange(unit, 30.0 * unit)
                    light = self.light_on_floor(scene, unit)
                    dark = sum(color < 60.0 for color in light)
                    self.assertGreater(len(light), 500)
                    self.assertEqual(dark > 100, shadows, dark)

    @staticmethod
    def light_on_floor(scene, unit):
        """The brightness of the pixels that show the floor."""
        light = vtkLight()
        light.PositionalOn()
        light.SetConeAngle(180.0)
        light.SetPosition(9.0 * unit, 12.0 * unit, 3.0 * unit)
        lights = vtkLightCollection()
        lights.AddItem(light)
        image = vtkImageData()
        assert scene.mapper.RenderToImage(scene.volume, scene.camera, lights, PIXELS, PIXELS, image)
        data = image.GetPointData()
        positions, pixels = data.GetArray("Position"), data.GetArray("Colors")
        return [pixels.GetTuple(i)[0] for i in range(PIXELS**2)
                if abs(positions.GetTuple(i)[1] - 0.7 * unit) < 1e-3 * unit]  # fmt: skip

    def test_picks_and_selections_name_the_block(self):
        blocks = cut(make_structured_grid(ball), ghosts=1)
        composite = nested(*blocks)
        scene = Scene(composite, 0.5)
        scene.volume.RotateX(20.0)
        scene.window.Render()
        picture = scene.picture()
        picker, cell, picked = vtkIsosurfacePicker(), vtkGenericCell(), set()
        for pixel in range(0, PIXELS * PIXELS, 37):
            shown = int(picture.GetArray("CellId").GetTuple1(pixel))
            self.assertEqual(picker.Pick(pixel % PIXELS, pixel // PIXELS, 0, scene.renderer), int(shown >= 0))
            if shown < 0:
                continue
            in_block, flat_index = mutable(0), mutable(0)
            block = scene.mapper.FindBlock(shown, in_block, flat_index)
            picked.add(int(flat_index))
            self.assertEqual(picker.GetDataSet(), block)
            self.assertEqual(picker.GetCompositeDataSet(), composite)
            self.assertEqual(picker.GetFlatBlockIndex(), flat_index)
            self.assertEqual(picker.GetCellId(), in_block)
            self.assertEqual(picker.GetPickPosition(), picture.GetArray("Position").GetTuple3(pixel))
            block.GetCell(picker.GetCellId(), cell)
            sub_id, point, weights = mutable(0), [0.0] * 3, [0.0] * 8
            cell.EvaluateLocation(sub_id, picker.GetPCoords(), point, weights)
            values = block.GetPointData().GetScalars()
            value = sum(w * values.GetTuple1(cell.GetPointId(i)) for i, w in enumerate(weights))
            self.assertAlmostEqual(value, 0.5, delta=1e-12)
            in_world = scene.volume.GetMatrix().MultiplyPoint((*point, 1.0))
            for p, q in zip(in_world, picker.GetPickPosition()):
                self.assertAlmostEqual(p, q, delta=1e-12)
            corners = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
            self.assertEqual(picker.GetPointId(), min(corners, key=lambda i: math.dist(block.GetPoint(i), point)))
        self.assertGreater(len(picked), 3)
        shown, block_of = set(), {}
        in_block, flat_index = mutable(0), mutable(0)
        for cell in {int(picture.GetArray("CellId").GetTuple1(pixel)) for pixel in range(PIXELS**2)} - {-1}:
            block = scene.mapper.FindBlock(cell, in_block, flat_index)
            block_of[int(flat_index)] = block
            shown.add((int(flat_index), int(in_block)))
        self.assertEqual(self.select(scene, vtkDataObject.FIELD_ASSOCIATION_CELLS), shown)
        points = self.select(scene, vtkDataObject.FIELD_ASSOCIATION_POINTS)
        self.assertGreater(len(points), 30)
        for index, point in points:
            self.assertLess(abs(ball(block_of[index].GetPoint(point)) - 0.5), 1.0)

    @staticmethod
    def select(scene, association):
        """The flat indices and ids that a hardware selector finds in the whole window."""
        selector = vtkHardwareSelector()
        selector.SetRenderer(scene.renderer)
        selector.SetArea(0, 0, PIXELS - 1, PIXELS - 1)
        selector.SetFieldAssociation(association)
        selection = selector.Select()
        found = set()
        for node in map(selection.GetNode, range(selection.GetNumberOfNodes())):
            block = node.GetProperties().Get(vtkSelectionNode.COMPOSITE_INDEX())
            ids = node.GetSelectionList()
            found |= {(block, ids.GetValue(i)) for i in range(ids.GetNumberOfValues())}
        return found

    def test_blocks_without_a_surface_are_passed_over(self):
        grid = make_grid(VTK_TETRA, ball)
        bare = make_structured_grid(ball)
        bare.GetPointData().Initialize()
        flat = make_grid(VTK_TRIANGLE, ball)
        expected = cast(*make_volume(grid, 0.0), parallel_rays())
        mapper, volume = make_volume(
            multi_block(None, vtkUnstructuredGrid(), bare, flat, grid, multi_block()), 0.0)
        hits = cast(mapper, volume, parallel_rays())
        before = bare.GetNumberOfCells() + flat.GetNumberOfCells()
        self.assertEqual([(ray, t, cell - before) for ray, t, cell, _ in hits],
                         [(ray, t, cell) for ray, t, cell, _ in expected])  # fmt: skip
        in_block, flat_index = mutable(0), mutable(0)
        self.assertEqual(mapper.FindBlock(hits[0][2], in_block, flat_index), grid)
        self.assertEqual((flat_index, in_block), (5, expected[0][2]))

    def test_bounds(self):
        whole = make_structured_grid(ball)
        for composite in (nested(*cut(whole)), collection(*cut(whole))):
            mapper, volume = make_volume(composite, 0.0)
            self.assertEqual(mapper.GetBounds(), whole.GetBounds())
            self.assertEqual(volume.GetBounds(), whole.GetBounds())

    def test_only_a_block_that_changed_is_built_again(self):
        size = 48
        large = vtkStructuredGrid()
        image = vtkImageData()
        image.SetDimensions(size, size, size)
        image.SetSpacing(*[SIZE / (size - 1)] * 3)
        points = make_structured_grid(ball).GetPoints().NewInstance()
        points.SetNumberOfPoints(size**3)
        for i in range(size**3):
            points.SetPoint(i, image.GetPoint(i))
        large.SetDimensions(size, size, size)
        large.SetPoints(points)
        set_values(large, plane)
        small = make_grid(VTK_TETRA, ball)
        mapper, volume = make_volume(multi_block(large, small), 0.0)
        mapper.SetNumberOfThreads(1)  # Several may wait for each other.
        before = cast(mapper, volume, parallel_rays())
        first = mapper.GetTreeBuildTime()
        times = []
        for shift in (0.1, 0.2, 0.5):
            set_values(small, lambda point, shift=shift: ball(point) - shift)
            after = cast(mapper, volume, parallel_rays())
            times.append(mapper.GetTreeBuildTime())
        self.assertLess(min(times), 0.2 * first)
        in_large = large.GetNumberOfCells()
        self.assertLess(sum(hit[2] >= in_large for hit in after), sum(hit[2] >= in_large for hit in before))
        # A block that is taken away takes nothing with it.
        composite = mapper.GetInputDataObject(0, 0)
        composite.SetBlock(0, None)
        mapper.GetBounds()
        alone = cast(mapper, volume, parallel_rays())
        self.assertEqual(alone, cast(*make_volume(small, 0.0), parallel_rays()))

    def test_cells_that_are_set_in_a_block(self):
        """That does not modify the block itself."""
        blocks = [make_grid(VTK_TETRA, ball), make_grid(VTK_TETRA, lambda point: ball(point) + 0.2)]
        composite = vtkMultiBlockDataSet()
        for i, block in enumerate(blocks):
            composite.SetBlock(i, block)
        mapper, volume = make_volume(composite, 0.5)
        before = cast(mapper, volume, parallel_rays())
        cells, types, ids = vtkCellArray(), vtkUnsignedCharArray(), vtkIdList()
        for i in range(blocks[0].GetNumberOfCells() - 10):
            blocks[0].GetCellPoints(i, ids)
            cells.InsertNextCell(ids)
            types.InsertNextValue(VTK_TETRA)
        blocks[0].SetCells(types, cells)
        again, fresh = cast(mapper, volume, parallel_rays()), cast(*make_volume(composite, 0.5), parallel_rays())
        self.assertEqual(again, fresh)
        self.assertNotEqual(again, before)

    def test_cells_that_are_set_in_a_block_may_be_older(self):
        """No time tells that."""
        grid, fewer = make_grid(VTK_TETRA, ball), make_grid(VTK_TETRA, ball)
        cells, types = vtkCellArray(), vtkUnsignedCharArray()
        cells.DeepCopy(fewer.GetCells())
        cells.ResizeExact(fewer.GetNumberOfCells() - 10, 4 * (fewer.GetNumberOfCells() - 10))
        types.DeepCopy(fewer.GetCellTypesArray())
        types.Resize(fewer.GetNumberOfCells() - 10)
        grid.Modified()
        composite = multi_block(grid, make_grid(VTK_TETRA, lambda point: ball(point) + 0.2))
        mapper, volume = make_volume(composite, 0.5)
        before = cast(mapper, volume, parallel_rays())
        grid.SetCells(types, cells)
        again, fresh = cast(mapper, volume, parallel_rays()), cast(*make_volume(composite, 0.5), parallel_rays())
        self.assertEqual(again, fresh)
        self.assertNotEqual(again, before)

    def test_accumulation_starts_again_when_a_block_changes(self):
        blocks = cut(make_structured_grid(ball))
        scene = Scene(multi_block(*blocks), 0.5)
        scene.mapper.ProgressiveAccumulationOn()
        for expected in (1, 2, 3):
            scene.window.Render()
            self.assertEqual(scene.mapper.GetNumberOfAccumulatedFrames(), expected)
        blocks[5].Modified()
        scene.window.Render()
        self.assertEqual(scene.mapper.GetNumberOfAccumulatedFrames(), 1)

    def test_errors(self):
        grid = make_grid(VTK_TETRA, ball)
        image = vtkImageData()
        image.SetDimensions(3, 3, 3)
        polygons = make_grid(VTK_TRIANGLE, ball)
        poly_data = vtkPolyData()
        poly_data.SetPoints(polygons.GetPoints())
        vectors = make_grid(VTK_TETRA, ball)
        array = vtkDoubleArray()
        array.SetName("values")
        array.SetNumberOfComponents(3)
        array.SetNumberOfTuples(vectors.GetNumberOfPoints())
        array.Fill(0.0)
        vectors.GetPointData().SetScalars(array)
        bad_id = make_grid(VTK_TETRA, ball)
        bad_id.GetCells().GetConnectivityArray().SetTuple1(17, 10**6)
        bare = make_grid(VTK_TETRA, ball)
        bare.GetPointData().Initialize()
        cases = [
            (multi_block(poly_data), "Block 1 of the composite input is left out. It is a vtkPolyData"),
            (multi_block(multi_block(bad_id)), "Block 2 of the composite input is left out. Cell 4 has"),
            (multi_block(bare, image), "no block with a volume and scalars"),
            (multi_block(), "no block with a volume and scalars"),
        ]
        for data, text in cases:
            with self.subTest(text):
                mapper, volume = make_volume(data, 0.0)
                messages = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays()))
                self.assertEqual(len(messages), 1, messages)
                self.assertIn(text, messages[0])
                self.assertEqual(errors_of(mapper, lambda: cast(mapper, volume, parallel_rays())), [])
                mapper.SetInputDataObject(multi_block(grid))
                self.assertEqual(errors_of(mapper, lambda: cast(mapper, volume, parallel_rays())), [])
        trees = vtkRandomHyperTreeGridSource()
        trees.SetDimensions(3, 3, 3)
        trees.Update()
        cases = [
            (multi_block(trees.GetOutput(), grid), "Block 1 of the composite input is left out. It is a vtkHyper"),
            (multi_block(poly_data, grid), "Block 1 of the composite input is left out. It is a vtkPolyData"),
            (multi_block(grid, vectors), "Block 2 of the composite input is left out. It has scalars unlike"),
            (multi_block(grid, multi_block(bad_id)), "Block 3 of the composite input is left out. Cell 4"),
        ]
        expected = [hit[1] for hit in cast(*make_volume(grid, 0.0), parallel_rays())]
        for data, text in cases:
            with self.subTest(text):
                mapper, volume = make_volume(data, 0.0)
                hits = []
                messages = errors_of(
                    mapper, lambda: hits.extend(cast(mapper, volume, parallel_rays())), vtkCommand.WarningEvent)
                self.assertEqual(len(messages), 1, messages)
                self.assertIn(text, messages[0])
                self.assertEqual([hit[1] for hit in hits], expected)
                self.assertEqual(errors_of(
                    mapper, lambda: cast(mapper, volume, parallel_rays()), vtkCommand.WarningEvent), [])


if __name__ == "__main__":
    unittest.main()
