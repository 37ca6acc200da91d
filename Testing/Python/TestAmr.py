#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""AMR data: the finest cells count, levels meet without cracks, hits know their block and cell."""

import itertools
import math
import random
import unittest

from vtkmodules.vtkCommonCore import mutable, vtkCommand, vtkDoubleArray, vtkIdList, vtkUnsignedCharArray, vtkVersion
from vtkmodules.vtkCommonDataModel import (
    VTK_XYZ_GRID,
    vtkAMRBox,
    vtkDataSetAttributes,
    vtkImageData,
    vtkNonOverlappingAMR,
    vtkOverlappingAMR,
    vtkUniformGrid,
)
from vtkmodules.vtkFiltersAMR import vtkAMRGaussianPulseSource
from vtkmodules.vtkRenderingCore import vtkCamera, vtkCompositeDataDisplayAttributes
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

from MeshTesting import cast, errors_of, make_volume

GLASS = 1e-6


def ball(point):
    return 2.7 - math.dist(point, (4.0, 4.0, 4.0))


def make_grid(level, first, cells, value, of_cells, noise):
    """A block: 8 x 8 x 8 cells of size 1 are the coarsest level, each other is twice as fine."""
    size = 0.5**level
    grid = vtkUniformGrid()
    grid.SetDimensions([n + 1 for n in cells])
    grid.SetSpacing(size, size, size)
    grid.SetOrigin([k * size for k in first])
    values = vtkDoubleArray()
    values.SetName("values")
    counts = [n + (0 if of_cells else 1) for n in cells]
    generator = random.Random(level + 1)
    errors = {}
    for z in range(counts[2]):
        for y in range(counts[1]):
            for x in range(counts[0]):
                place = (first[0] + x, first[1] + y, first[2] + z)
                generator.seed(str((level, place)))
                shift = 0.5 if of_cells else 0.0
                values.InsertNextValue(
                    value([(k + shift) * size for k in place]) + noise * generator.uniform(-1, 1))
    data = grid.GetCellData() if of_cells else grid.GetPointData()
    data.SetScalars(values)
    return grid


def fill(amr, blocks, of_cells, value=ball, noise=0.0):
    """Blocks are (level, first cell, cells)."""
    levels = max(block[0] for block in blocks) + 1
    numbers = [[block for block in blocks if block[0] == level] for level in range(levels)]
    counts = [len(of_level) for of_level in numbers]
    if vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() >= 906:
        amr.Initialize(counts)
    else:
        amr.Initialize(levels, counts)
    if amr.IsA("vtkOverlappingAMR"):
        amr.SetOrigin([0.0, 0.0, 0.0])
        amr.SetGridDescription(VTK_XYZ_GRID)
    grids = []
    for level, of_level in enumerate(numbers):
        if amr.IsA("vtkOverlappingAMR"):
            amr.SetSpacing(level, [0.5**level] * 3)
        for i, (_, first, cells) in enumerate(of_level):
            grid = make_grid(level, first, cells, value, of_cells, noise)
            if amr.IsA("vtkOverlappingAMR"):
                amr.SetAMRBox(level, i, vtkAMRBox(first, [f + n - 1 for f, n in zip(first, cells)]))
            amr.SetDataSet(level, i, grid)
            grids.append(grid)
    return grids


NESTED = [(0, (0, 0, 0), (8, 8, 8)), (1, (2, 2, 2), (8, 8, 6)), (1, (2, 2, 8), (6, 8, 6)), (2, (8, 8, 8), (8, 8, 8))]
# The coarse cells that finer ones replace do not exist.
APART = ([(0, (x, y, z), (2, 2, 2)) for x in (0, 2, 4, 6) for y in (0, 2, 4, 6) for z in (0, 2, 4, 6)
          if (x, y, z) not in ((2, 2, 2), (4, 2, 2), (4, 4, 6))]
         + [(1, (4, 4, 4), (8, 4, 4)), (1, (8, 8, 12), (4, 4, 4))])  # fmt: skip


def random_rays(count):
    generator = random.Random(3)
    rays = []
    for _ in range(count):
        through = [generator.uniform(1, 7) for _ in range(3)]
        direction = [generator.uniform(-1, 1) for _ in range(3)]
        if generator.random() < 0.5:
            through = [round(4 * k) / 4 for k in through]
        if generator.random() < 0.2:
            direction[generator.randrange(3)] = 0.0
        if math.hypot(*direction) > 0.1:
            rays.append(([k - 200 * d for k, d in zip(through, direction)], direction))
    return rays


def make_mapper(data, isovalue=0.0, opacity=GLASS):
    return make_volume(data, isovalue, mapper_class=vtkIsosurfaceRayTraceMapper, opacity=opacity)


def find_extreme(mapper, volume, start, end):
    """The value that a projection has along a line."""
    t, position, parametric, cell = mutable(0.0), [0.0] * 3, [0.0] * 3, mutable(0)
    value, normal = mutable(0.0), [0.0] * 3
    assert mapper.IntersectWithLine(volume, start, end, t, position, parametric, cell, value, normal)
    return value.get()


class TestAmr(unittest.TestCase):
    def check_closed(self, data):
        mapper, volume = make_mapper(data)
        rays = random_rays(20000)
        hits = cast(mapper, volume, rays)
        by_ray = {}
        for ray, t, _, normal in hits:
            direction = rays[ray][1]
            by_ray.setdefault(ray, []).append((t, sum(a * b for a, b in zip(normal, direction))))
        self.assertGreater(len(by_ray), 5000)
        for of_ray in by_ray.values():
            self.assertEqual(len(of_ray) % 2, 0, of_ray)
        return mapper, volume, hits, rays

    def test_no_ray_slips_through_where_levels_meet(self):
        for of_cells in (False, True):
            for kind, blocks in ((vtkOverlappingAMR, NESTED), (vtkNonOverlappingAMR, APART)):
                for noise in (0.0, 0.3):
                    with self.subTest(of_cells=of_cells, kind=kind.__name__, noise=noise):
                        amr = kind()
                        fill(amr, blocks, of_cells, noise=noise)
                        self.check_closed(amr)

    def test_hits_are_in_the_finest_cells(self):
        """Also where blocks fill a box, and are traced as one."""
        for of_cells in (False, True):
            # On the sphere, to within the curvature of the field in a cell, and in the finer cells of means.
            for kind, blocks, least, delta in (
                    (vtkOverlappingAMR, NESTED, 4, 0.1), (vtkNonOverlappingAMR, APART, 30, 0.12 if of_cells else 0.1)):
                amr = kind()
                grids = fill(amr, blocks, of_cells)
                mapper, _, hits, rays = self.check_closed(amr)
                in_block, flat_index = mutable(0), mutable(0)
                seen = set()
                for ray, t, cell, _ in hits[::7]:
                    point = [o + t * d for o, d in zip(*rays[ray])]
                    self.assertAlmostEqual(ball(point), 0.0, delta=delta)
                    block = mapper.FindBlock(cell, in_block, flat_index)
                    number = next(i for i, grid in enumerate(grids) if grid is block)
                    seen.add(number)
                    bounds = block.GetCell(int(in_block)).GetBounds()
                    for axis in range(3):
                        self.assertGreater(point[axis], bounds[2 * axis] - 1e-6)
                        self.assertLess(point[axis], bounds[2 * axis + 1] + 1e-6)
                    inside = [i for i, grid in enumerate(grids)
                              if all(grid.GetBounds()[2 * k] + 1e-6 < point[k] < grid.GetBounds()[2 * k + 1] - 1e-6
                                     for k in range(3))]  # fmt: skip
                    if inside:
                        self.assertGreaterEqual(blocks[number][0], blocks[max(inside)][0])
                self.assertGreaterEqual(len(seen), least)

    def test_a_linear_field_has_no_levels(self):
        """All interpolants are exact, so the surface is a plane, and every ray hits it once."""
        for of_cells, (kind, blocks) in itertools.product(
                (False, True), ((vtkOverlappingAMR, NESTED), (vtkNonOverlappingAMR, APART))):
            amr = kind()
            fill(amr, blocks, of_cells, value=lambda p: p[0] + 0.5 * p[1] + 0.25 * p[2] - 7.0)
            mapper, volume = make_mapper(amr)
            rays = [((1.1 + 0.05 * i, 1.1 + 0.05 * j, -1.0), (0.01, 0.02, 1.0)) for i in range(110) for j in range(110)]
            hits = cast(mapper, volume, rays)
            count = 0
            for ray, t, _, normal in hits:
                point = [o + t * d for o, d in zip(*rays[ray])]
                if all(1.0 < k < 7.0 for k in point):
                    # At the border of the domain the means of cells are not linear.
                    self.assertAlmostEqual(point[0] + 0.5 * point[1] + 0.25 * point[2], 7.0, delta=1e-9)
                    self.assertAlmostEqual(abs(normal[0]), 1.0 / math.sqrt(1.3125), delta=1e-9)
                    count += 1
            self.assertGreater(count, 1000)

    def test_one_level_is_the_image(self):
        """Blocks of cells on one level are the image of the cells, between its centres."""
        amr = vtkOverlappingAMR()
        blocks = [(0, (x, y, z), (4, 4, 4)) for z in (0, 4) for y in (0, 4) for x in (0, 4)]
        fill(amr, blocks, True, noise=0.4)
        image = make_grid(0, (0, 0, 0), (8, 8, 8), ball, True, 0.4)
        whole = vtkImageData()
        whole.ShallowCopy(image)
        rays = random_rays(3000)
        hits = cast(*make_mapper(amr), rays)
        expected = cast(*make_mapper(whole), rays)
        self.assertGreater(len(expected), 3000)
        self.assertEqual([hit[0] for hit in hits], [hit[0] for hit in expected])
        for hit, other in zip(hits, expected):
            self.assertAlmostEqual(hit[1], other[1], delta=1e-9)
            self.assertLess(math.dist(hit[3], other[3]), 1.5)

    def test_blocks_that_fill_a_box_have_displays_of_their_own(self):
        """They are traced as one, where they have one opacity."""
        amr = vtkOverlappingAMR()
        grids = fill(amr, [(0, (x, y, z), (4, 4, 4)) for z in (0, 4) for y in (0, 4) for x in (0, 4)], False)
        mapper, volume = make_mapper(amr, opacity=1.0)
        volume.GetProperty().ShadeOff()
        attributes = vtkCompositeDataDisplayAttributes()
        mapper.SetCompositeDataDisplayAttributes(attributes)
        in_block, flat_index = mutable(0), mutable(0)
        generator = random.Random(5)
        rays = []
        for _ in range(3000):
            through = [generator.uniform(1, 7) for _ in range(3)]
            direction = [generator.uniform(-1, 1) for _ in range(3)]
            rays.append(([k - 200 * d for k, d in zip(through, direction)], direction))

        def hits_of_blocks():
            """Of each ray the numbers of the blocks that it hits, one after the other."""
            found = {}
            for ray, _, cell, _ in cast(mapper, volume, rays):
                block = mapper.FindBlock(cell, in_block, flat_index)
                found.setdefault(ray, []).append(next(i for i, grid in enumerate(grids) if grid is block))
            return found

        plain = hits_of_blocks()
        self.assertEqual({len(blocks) for blocks in plain.values()}, {1})
        self.assertEqual({blocks[0] for blocks in plain.values()}, set(range(8)))
        attributes.SetBlockOpacity(grids[5], 0.5)
        through = 0
        for ray, blocks in hits_of_blocks().items():
            self.assertEqual(blocks[0], plain[ray][0])
            self.assertEqual(set(blocks[:-1]), {5} if len(blocks) > 1 else set())
            through += len(blocks) > 1
        self.assertGreater(through, 30)
        attributes.RemoveBlockOpacities()
        attributes.SetBlockVisibility(grids[2], False)
        seen = {block for blocks in hits_of_blocks().values() for block in blocks}
        self.assertEqual(seen, set(range(8)) - {2})
        attributes.RemoveBlockVisibilities()
        self.assertEqual(hits_of_blocks(), plain)
        hidden = vtkUnsignedCharArray()
        hidden.SetName(vtkDataSetAttributes.GhostArrayName())
        hidden.SetNumberOfTuples(64)
        hidden.Fill(vtkDataSetAttributes.HIDDENCELL)
        grids[0].GetCellData().AddArray(hidden)
        self.assertEqual({block for blocks in hits_of_blocks().values() for block in blocks}, set(range(1, 8)))
        grids[0].GetCellData().RemoveArray(hidden.GetName())
        self.assertEqual(hits_of_blocks(), plain)
        colors = [(0.1 * i, 1.0 - 0.1 * i, 0.5) for i in range(8)]
        for grid, color in zip(grids, colors):
            attributes.SetBlockColor(grid, color)
        camera = vtkCamera()
        camera.SetFocalPoint(4, 4, 4)
        camera.SetPosition(12, 8, -14)
        camera.SetClippingRange(1, 60)
        image = vtkImageData()
        self.assertTrue(mapper.RenderToImage(volume, camera, None, 60, 60, image))
        data = image.GetPointData()
        seen = set()
        for pixel in range(60 * 60):
            cell = int(data.GetArray("CellId").GetValue(pixel))
            if cell >= 0:
                block = mapper.FindBlock(cell, in_block, flat_index)
                number = next(i for i, grid in enumerate(grids) if grid is block)
                seen.add(number)
                for channel in range(3):
                    self.assertAlmostEqual(
                        data.GetArray("Colors").GetComponent(pixel, channel), 255 * colors[number][channel], delta=1)
        self.assertGreater(len(seen), 5)

    def test_pulse(self):
        """The source of VTK: a Gaussian pulse, two levels."""
        source = vtkAMRGaussianPulseSource()
        source.SetDimension(3)
        source.SetRootSpacing(0.5)
        source.Update()
        amr = source.GetOutput()
        mapper, volume = make_mapper(amr, 2e-5, 1.0)
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectScalarArray("Gaussian-Pulse")
        camera = vtkCamera()
        camera.SetPosition(3, 4, 12)
        camera.SetClippingRange(1, 30)
        image = vtkImageData()
        self.assertTrue(mapper.RenderToImage(volume, camera, None, 60, 60, image))
        shown = 0
        for pixel in range(3600):
            x, y, z = image.GetPointData().GetArray("Position").GetTuple3(pixel)
            if x == x:
                shown += 1
                # Its width is that of a coarse cell.
                pulse = math.exp(-((x / 0.5) ** 2 + (y / 0.5) ** 2 + (z / 0.5) ** 2))
                self.assertAlmostEqual(pulse, 0.2, delta=0.2)
        self.assertGreater(shown, 20)

    def test_what_is_built_is_kept_where_only_the_display_of_blocks_changes(self):
        camera = vtkCamera()
        camera.SetPosition(-12.0, -5.0, -9.0)
        camera.SetFocalPoint(4.0, 4.0, 4.0)
        camera.SetClippingRange(1.0, 60.0)

        def draw(mapper, volume):
            picture = vtkImageData()
            self.assertTrue(mapper.RenderToImage(volume, camera, None, 100, 100, picture))
            return bytes(memoryview(picture.GetPointData().GetArray("Colors")))

        cubes = [(0, (x, y, z), (4, 4, 4)) for z in (0, 4) for y in (0, 4) for x in (0, 4)]
        for of_cells, blocks in itertools.product((False, True), (NESTED, cubes)):
            amr = vtkOverlappingAMR()
            grids = fill(amr, blocks, of_cells)
            attributes = vtkCompositeDataDisplayAttributes()

            def make(amr=amr, attributes=attributes):
                mapper, volume = make_mapper(amr, opacity=1.0)
                mapper.SetCompositeDataDisplayAttributes(attributes)
                return mapper, volume

            def modify_scalars(grids=grids, of_cells=of_cells):
                scalars = (grids[1].GetCellData() if of_cells else grids[1].GetPointData()).GetScalars()
                for i in range(scalars.GetNumberOfValues()):
                    scalars.SetValue(i, scalars.GetValue(i) - 0.5)
                scalars.Modified()
                attributes.SetBlockColor(grids[2], (0.0, 1.0, 1.0))

            mapper, volume = make()
            before = draw(mapper, volume)
            # The cubes are traced as one, but for those of another opacity.
            are_apart = blocks is NESTED
            for is_kept, change in (
                (True, lambda a=attributes, g=grids: a.SetBlockColor(g[1], (1.0, 0.0, 0.0))),
                (are_apart, lambda a=attributes, g=grids: a.SetBlockOpacity(g[3], 0.4)),
                (True, lambda a=attributes, g=grids: a.SetBlockOpacity(g[3], 0.6)),
                (False, lambda a=attributes, g=grids: a.SetBlockVisibility(g[0], False)),
                (False, lambda a=attributes, g=grids: a.SetBlockVisibility(g[0], True)),
                (False, modify_scalars),
            ):
                with self.subTest(of_cells=of_cells, blocks=len(blocks), is_kept=is_kept):
                    built = mapper.GetMacrocellMemory()
                    change()
                    # A ray that meets nothing has nothing built.
                    cast(mapper, volume, [((-1.0, -1.0, -1.0), (-1.0, 0.0, 0.0))])
                    self.assertEqual(mapper.GetMacrocellMemory() == built, is_kept)
                    picture = draw(mapper, volume)
                    self.assertTrue(picture == draw(*make()))
                    self.assertFalse(picture == before)
                    before = picture

    def test_bounds_of_visible_blocks(self):
        amr = vtkOverlappingAMR()
        coarse, fine, *_ = fill(amr, NESTED, of_cells=False)
        mapper, _ = make_volume(amr, 0.5, mapper_class=vtkIsosurfaceRayTraceMapper)
        attributes = vtkCompositeDataDisplayAttributes()
        mapper.SetCompositeDataDisplayAttributes(attributes)
        attributes.SetBlockVisibility(fine, True)
        self.assertEqual(mapper.GetBounds(), coarse.GetBounds())
        iterator = amr.NewIterator()
        while not iterator.IsDoneWithTraversal():
            attributes.SetBlockVisibility(iterator.GetCurrentDataObject(), iterator.GetCurrentDataObject() is fine)
            iterator.GoToNextItem()
        self.assertEqual(mapper.GetBounds(), fine.GetBounds())

    def test_blanked_cells_and_ghosts(self):
        amr = vtkOverlappingAMR()
        grids = fill(amr, NESTED, False)
        before = cast(*make_mapper(amr), random_rays(2000))
        flags = vtkUnsignedCharArray()
        flags.SetName(vtkDataSetAttributes.GhostArrayName())
        flags.SetNumberOfTuples(512)
        flags.Fill(0)
        grids[3].GetCellData().AddArray(flags)
        self.assertEqual(cast(*make_mapper(amr), random_rays(2000)), before)
        flags.Fill(vtkDataSetAttributes.HIDDENCELL)
        flags.Modified()
        mapper, volume = make_mapper(amr)
        hidden = cast(mapper, volume, random_rays(2000))
        self.assertLess(len(hidden), len(before))
        in_block, flat_index = mutable(0), mutable(0)
        self.assertFalse(any(mapper.FindBlock(hit[2], in_block, flat_index) is grids[3] for hit in hidden))

    def test_projections_show_no_hidden_cells_at_the_border(self):
        for axis, of_cells, is_covered in itertools.product(range(3), (False, True), (False, True)):
            with self.subTest(axis=axis, of_cells=of_cells, is_covered=is_covered):
                amr = vtkOverlappingAMR()
                blocks = [(0, (0, 0, 0), (4, 4, 4))]
                if is_covered:
                    first = tuple(4 if k == axis else 0 for k in range(3))
                    blocks.append((1, first, tuple(8 - k for k in first)))
                grids = fill(amr, blocks, of_cells, value=lambda point: point[axis])
                if is_covered:
                    data = grids[1].GetCellData() if of_cells else grids[1].GetPointData()
                    data.GetScalars().Fill(1.0)
                else:
                    for number in range(64):
                        if number // 4**axis % 4 == 3:
                            grids[0].BlankCell(number)
                mapper, volume = make_mapper(amr)
                mapper.SetBlendModeToMaximumIntensity()
                start = [-1.0 if k == axis else 1.7 for k in range(3)]
                end = [5.0 if k == axis else 1.6 for k in range(3)]
                self.assertLess(find_extreme(mapper, volume, start, end), 3.0 + 1e-6)

    def test_projections_end_at_the_border(self):
        """Not in the layer of nodes behind it, which continues the values."""
        for axis, of_cells in itertools.product(range(3), (False, True)):
            with self.subTest(axis=axis, of_cells=of_cells):
                amr = vtkOverlappingAMR()
                fill(amr, [(0, (0, 0, 0), (4, 4, 4))], of_cells, value=lambda point: point[axis])
                mapper, volume = make_mapper(amr)
                mapper.SetBlendModeToMaximumIntensity()
                start = [-1.0 if k == axis else 1.7 for k in range(3)]
                end = [5.0 if k == axis else 1.6 for k in range(3)]
                # Nodes of cells are as far as their centres from the border, where values do not change.
                self.assertAlmostEqual(find_extreme(mapper, volume, start, end), 3.5 if of_cells else 4.0, delta=1e-12)

    def test_cells_with_a_blanked_point_are_not_hit(self):
        for of_cells in (False, True):
            with self.subTest(of_cells):
                amr = vtkOverlappingAMR()
                grids = fill(amr, NESTED, of_cells)
                mapper, volume = make_mapper(amr)
                rays = random_rays(2000)
                before = cast(mapper, volume, rays)
                in_block, flat_index = mutable(0), mutable(0)

                def place(hit):
                    grid = mapper.FindBlock(hit[2], in_block, flat_index)
                    return grid, in_block.get()

                places = [place(hit) for hit in before]
                grid, cell = next((grid, cell) for grid, cell in places if grid in grids[1:])
                point = grid.GetCell(cell).GetPointId(0)
                around = vtkIdList()
                grid.GetPointCells(point, around)
                left = [hit for hit, (other, number) in zip(before, places)
                        if other is not grid or around.IsId(number) < 0]
                self.assertLess(len(left), len(before))
                grid.BlankPoint(point)
                self.assertEqual(cast(mapper, volume, rays), left)

    def test_blocks_one_cell_thick(self):
        slabs, whole = vtkOverlappingAMR(), vtkOverlappingAMR()
        fill(slabs, [(0, (0, 0, z), (8, 8, 1)) for z in range(8)], True)
        fill(whole, [(0, (0, 0, 0), (8, 8, 8))], True)
        rays = random_rays(500)
        hits = cast(*make_mapper(slabs), rays)
        expected = cast(*make_mapper(whole), rays)
        self.assertGreater(len(expected), 100)
        self.assertEqual([hit[0] for hit in hits], [hit[0] for hit in expected])
        for hit, other in zip(hits, expected):
            self.assertAlmostEqual(hit[1], other[1], delta=1e-9)

    def test_a_block_that_does_not_fit_is_left_out(self):
        for change, text in ((lambda grid: grid.SetSpacing(0.3, 0.3, 0.3), "whole part"),
                             (lambda grid: grid.SetOrigin(1.1, 1.0, 1.0), "lattice of its level"),
                             (lambda grid: grid.SetSpacing(math.nan, 0.5, 0.5), "spacing"),
                             (lambda grid: grid.GetPointData().GetScalars().SetNumberOfTuples(5), "scalars unlike")):
            with self.subTest(text):
                amr = vtkOverlappingAMR()
                grids = fill(amr, NESTED, False)
                change(grids[2])
                mapper, volume = make_mapper(amr)
                hits = []
                messages = errors_of(
                    mapper, lambda: hits.extend(cast(mapper, volume, random_rays(500))), vtkCommand.WarningEvent)
                self.assertEqual(len(messages), 1, messages)
                self.assertIn("of the composite input is left out.", messages[0])
                self.assertIn(text, messages[0])
                self.assertGreater(len(hits), 100)

    def test_levels_that_are_too_fine_are_left_out(self):
        rays = random_rays(500)
        # Thirty levels, each twice as fine.
        deep = [(0, (0, 0, 0), (8, 8, 8))] + [(level, (0, 0, 0), (2, 2, 2)) for level in range(1, 31)]
        amr = vtkOverlappingAMR()
        fill(amr, deep, False)
        mapper, volume = make_mapper(amr)
        hits = []
        messages = errors_of(mapper, lambda: hits.extend(cast(mapper, volume, rays)), vtkCommand.WarningEvent)
        self.assertEqual(len(messages), 1, messages)
        self.assertIn("cells are too small", messages[0])
        self.assertGreater(len(hits), 100)
        # A block far away.
        amr = vtkOverlappingAMR()
        grids = fill(amr, NESTED, False)
        mapper, volume = make_mapper(amr)
        grids[3].SetOrigin(2.0**40, 0.0, 0.0)
        hits = []
        messages = errors_of(mapper, lambda: hits.extend(cast(mapper, volume, rays)), vtkCommand.WarningEvent)
        self.assertEqual(len(messages), 1, messages)
        self.assertIn("million cells", messages[0])
        self.assertGreater(len(hits), 100)

    def test_what_no_ray_meets_costs_nothing(self):
        amr = vtkOverlappingAMR()
        fill(amr, NESTED, True)
        mapper, volume = make_mapper(amr, opacity=1.0)
        cast(mapper, volume, [((-1.0, 0.2, 0.2), (1.0, 0.0, 0.0))])
        little = mapper.GetMacrocellMemory()
        cast(mapper, volume, random_rays(500))
        self.assertLess(little, 0.4 * mapper.GetMacrocellMemory())
        # Nor does what rays meet, but has no values of the surface.
        amr = vtkNonOverlappingAMR()
        fill(amr, APART, True)
        memory = []
        for isovalue in (0.0, 2.1):
            mapper, volume = make_mapper(amr, isovalue)
            self.assertGreater(len(cast(mapper, volume, random_rays(5000))), 50)
            memory.append(mapper.GetMacrocellMemory())
        self.assertLess(memory[1], 0.5 * memory[0])

    def test_samples_are_kept_once_and_in_single_precision_where_that_holds_them(self):
        memory = []
        for scale in (1.0, 1.0 / 3.0):
            amr = vtkOverlappingAMR()
            blocks = [(0, (0, 0, 0), (8, 8, 8)), (1, (4, 4, 4), (6, 6, 6))]
            fill(amr, blocks, False, lambda point, scale=scale: scale * (point[0] - 4.25))
            mapper, volume = make_mapper(amr, opacity=1.0)
            self.assertGreater(len(cast(mapper, volume, random_rays(500))), 50)
            self.assertEqual(mapper.GetNumberOfBricks(), 0)
            memory.append(mapper.GetMacrocellMemory())
        self.assertLess(memory[0], 0.8 * memory[1])


if __name__ == "__main__":
    unittest.main()
