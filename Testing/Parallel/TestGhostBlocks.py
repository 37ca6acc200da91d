#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""AMR data whose blocks are shared out: with the blocks next to its own (vtkIsosurfaceGhostBlocks) each process draws its
part of the picture of one process. Run by mpirun."""

import random
import unittest

from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    vtkDataSetAttributes,
    vtkImageData,
    vtkNonOverlappingAMR,
    vtkOverlappingAMR,
    vtkUniformGrid,
)
from vtkmodules.vtkRenderingCore import vtkCamera
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper
from vtkIsosurfaceRayTracing.vtkIsosurfaceRayTracingParallel import vtkIsosurfaceGhostBlocks

from Pieces import Errors, PicturesOfMany, RANK, SIZE, WORLD, make_volume, on_first, pixels_of, render, whole_picture
from TestAmr import APART, NESTED, fill

PICTURE = (160, 120)
# A third level of small blocks, beside and in those of the second.
SMALL = [
    *[(0, (x, y, z), (4, 4, 4)) for x in (0, 4) for y in (0, 4) for z in (0, 4)],
    *[(1, (x, y, z), (4, 4, 4)) for x in (4, 8) for y in (4, 8) for z in (0, 4, 8)],
    *[(2, (x, y, z), (4, 4, 4)) for x in (8, 12, 16) for y in (12, 16) for z in (8, 12)],
]
# Fine blocks instead of coarse cells, of which each has several beside each other.
HOLES = [
    *[(0, (x, y, z), (2, 2, 2)) for x in (0, 2, 4, 6) for y in (0, 2, 4, 6) for z in (0, 2, 4, 6)
      if not (x in (2, 4) and y in (2, 4) and z in (2, 4))],
    *[(3, (x, y, z), (4, 4, 4)) for x in range(16, 48, 4) for y in range(16, 48, 4) for z in range(16, 48, 4)],
]  # fmt: skip
DATA = ((vtkOverlappingAMR, NESTED), (vtkNonOverlappingAMR, APART), (vtkOverlappingAMR, SMALL))


def make_camera():
    camera = vtkCamera()
    camera.SetPosition(13.0, 15.0, 11.0)
    camera.SetFocalPoint(4.0, 4.0, 4.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetClippingRange(5.0, 40.0)
    camera.SetViewAngle(25.0)
    return camera


def make_whole(kind, blocks, of_cells):
    amr = kind()
    fill(amr, blocks, of_cells, noise=0.2)
    return amr


def take_own(whole, owners):
    """An AMR data set of the same structure, with the blocks of this process; the others have no arrays or are null."""
    own = whole.NewInstance()
    own.CopyStructure(whole)
    number = 0
    for level in range(whole.GetNumberOfLevels()):
        for i in range(whole.GetNumberOfDataSets(level)):
            if owners[number] == RANK:
                own.SetDataSet(level, i, whole.GetDataSet(level, i))
            elif number % 2 == 1:
                without_arrays = vtkUniformGrid()
                without_arrays.CopyStructure(whole.GetDataSet(level, i))
                own.SetDataSet(level, i, without_arrays)
            number += 1
    return own


def deal(count, is_random):
    numbers = random.Random(count)
    return [numbers.randrange(SIZE) if is_random else i % SIZE for i in range(count)]


def add_ghosts(own):
    ghosts = vtkIsosurfaceGhostBlocks()
    ghosts.SetInputData(own)
    ghosts.Update()
    return ghosts


def draw(data, opacity, settings=()):
    return make_volume(data, (opacity, opacity), (-0.6, 0.3), vtkIsosurfaceRayTraceMapper, settings)


class TestGhostBlocks(PicturesOfMany):
    def check(self, whole, owners, opacity, name):
        own = take_own(whole, owners)
        is_rendered, picture = render(draw(add_ghosts(own).GetOutput(), opacity), make_camera(), PICTURE)
        self.assertTrue(is_rendered)
        self.check_against_whole(picture, draw(whole, opacity), make_camera(), PICTURE, name=name)
        return own

    def test_picture_of_shared_out_blocks(self):
        for kind, blocks in DATA:
            for of_cells in (False, True):
                for is_random in (False, True):
                    for opacity in (1.0, 0.4):
                        name = f"{len(blocks)} blocks, of cells {of_cells}, random {is_random}, opacity {opacity}"
                        with self.subTest(name):
                            owners = deal(len(blocks), is_random)
                            self.check(make_whole(kind, blocks, of_cells), owners, opacity, name)

    def test_means_of_finer_blocks_that_are_farther_away_than_four_of_their_cells(self):
        whole = make_whole(vtkNonOverlappingAMR, HOLES, True)
        owners = [0 if level == 3 and first[0] >= 32 else SIZE - 1 for level, first, _ in HOLES]
        self.check(whole, owners, 0.4, "fine blocks in coarse cells")

    @unittest.skipIf(SIZE == 1, "one process has all blocks")
    def test_without_them_there_are_gaps(self):
        whole = make_whole(vtkOverlappingAMR, SMALL, True)
        _, picture = render(draw(take_own(whole, deal(len(SMALL), False)), 1.0), make_camera(), PICTURE)

        def compare():
            expected = whole_picture(draw(whole, 1.0), make_camera(), PICTURE)
            different = sum(a != b for a, b in zip(pixels_of(picture), expected))
            print(f"without ghost blocks, {SIZE} processes: {different} pixels differ")
            return None if different > 500 else "no gaps"

        self.assertIsNone(on_first(compare))

    def test_blanked_cells_stay_blanked(self):
        whole = make_whole(vtkOverlappingAMR, SMALL, True)
        flags = vtkUnsignedCharArray()
        flags.SetName(vtkDataSetAttributes.GhostArrayName())
        flags.SetNumberOfValues(64)
        for i in range(64):
            flags.SetValue(i, vtkDataSetAttributes.HIDDENCELL if i % 5 == 0 else 0)
        for i in range(whole.GetNumberOfDataSets(2)):
            whole.GetDataSet(2, i).GetCellData().AddArray(flags)
        self.check(whole, deal(len(SMALL), False), 1.0, "blanked cells")

    def test_arrays_and_places(self):
        whole = make_whole(vtkOverlappingAMR, SMALL, False)
        own = take_own(whole, deal(len(SMALL), False))
        ghosts = add_ghosts(own)
        output = ghosts.GetOutput()
        last = own.GetNumberOfLevels()
        self.assertEqual(output.GetNumberOfLevels(), last + 1)
        self.assertEqual(output.GetNumberOfDataSets(last), ghosts.GetNumberOfGhostBlocks())
        by_place = {(block.GetOrigin(), block.GetSpacing()): block
                    for level in range(last) for block in
                    [whole.GetDataSet(level, i) for i in range(whole.GetNumberOfDataSets(level))]}  # fmt: skip
        mine = [own.GetDataSet(level, i) for level in range(last) for i in range(own.GetNumberOfDataSets(level))]
        for i in range(output.GetNumberOfDataSets(last)):
            ghost = output.GetDataSet(last, i)
            original = by_place[(ghost.GetOrigin(), ghost.GetSpacing())]
            self.assertNotIn(original, mine)
            self.assertEqual(ghost.GetExtent(), original.GetExtent())
            values, expected = (each.GetPointData().GetScalars() for each in (ghost, original))
            self.assertEqual(bytes(memoryview(values)), bytes(memoryview(expected)))
        found = WORLD.allreduce(ghosts.GetNumberOfGhostBlocks())
        self.assertGreater(found, 0) if SIZE > 1 else self.assertEqual(found, 0)

    def test_processes_without_blocks(self):
        whole = make_whole(vtkOverlappingAMR, SMALL, True)
        self.check(whole, [SIZE - 1] * len(SMALL), 1.0, "all blocks in one process")
        nothing = vtkNonOverlappingAMR()
        output = add_ghosts(whole if RANK == 0 else nothing).GetOutput()
        _, picture = render(draw(output, 1.0), make_camera(), PICTURE)
        self.check_against_whole(picture, draw(whole, 1.0), make_camera(), PICTURE)

    def test_data_that_change_in_one_process(self):
        """The others exchange blocks again, too."""
        whole = make_whole(vtkOverlappingAMR, SMALL, True)
        mine = take_own(whole, deal(len(SMALL), False))
        ghosts = add_ghosts(mine)
        for process in range(SIZE):
            before = ghosts.GetOutputDataObject(0).GetUpdateTime()
            if RANK == process:
                mine.Modified()
            ghosts.Update()
            self.assertGreater(ghosts.GetOutputDataObject(0).GetUpdateTime(), before)
            after = ghosts.GetOutputDataObject(0).GetUpdateTime()
            ghosts.Update()
            self.assertEqual(ghosts.GetOutputDataObject(0).GetUpdateTime(), after)

    def test_process_without_an_input(self):
        whole = make_whole(vtkOverlappingAMR, SMALL, True)
        ghosts = vtkIsosurfaceGhostBlocks()
        if RANK == 0:
            ghosts.SetInputDataObject(whole)
        ghosts.Update()
        self.assertEqual(ghosts.GetNumberOfGhostBlocks(), 0)

    def test_picture_without_update(self):
        """The compositor updates the inputs of mappers, in all processes."""
        whole = make_whole(vtkOverlappingAMR, SMALL, True)
        ghosts = vtkIsosurfaceGhostBlocks()
        ghosts.SetInputDataObject(whole if RANK == 0 else vtkNonOverlappingAMR())
        volume = draw(None, 1.0)
        volume.GetMapper().SetInputConnection(ghosts.GetOutputPort())
        is_rendered, picture = render(volume, make_camera(), PICTURE)
        self.assertTrue(is_rendered)
        self.check_against_whole(picture, draw(whole, 1.0), make_camera(), PICTURE)

    def test_blocks_that_all_have_are_not_sent(self):
        whole = make_whole(vtkOverlappingAMR, SMALL, True)
        self.assertEqual(add_ghosts(whole).GetNumberOfGhostBlocks(), 0)

    def test_other_kinds_of_data_are_refused(self):
        """By their process, for which no other waits."""
        is_last = RANK == SIZE - 1
        whole = make_whole(vtkOverlappingAMR, SMALL, True)
        ghosts = vtkIsosurfaceGhostBlocks()
        ghosts.SetInputDataObject(vtkImageData() if is_last else take_own(whole, deal(len(SMALL), False)))
        errors = Errors(ghosts)
        ghosts.Update()
        if is_last:
            self.assertIn("The input is a vtkImageData. Give a vtkOverlappingAMR", "".join(errors.texts))
            self.assertEqual(ghosts.GetNumberOfGhostBlocks(), 0)
        else:
            self.assertEqual(errors.texts, [])


if __name__ == "__main__":
    unittest.main()
