#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Composite and AMR data whose blocks are damaged at random: whatever is wrong, nothing crashes, blocks that
are left out are told, and the others are drawn. `TestDamagedBlocks.py attack FIRST COUNT` does more of it."""

import math
import random
import subprocess
import sys
import unittest

from vtkmodules.vtkCommonCore import vtkObject, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    vtkDataSetAttributes,
    vtkImageData,
    vtkNonOverlappingAMR,
    vtkOverlappingAMR,
    vtkPlane,
    vtkPolyData,
)
from vtkmodules.vtkRenderingCore import vtkCamera
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper

from MeshTesting import ball, cast, make_volume, parallel_rays
from TestAmr import APART, NESTED, fill
from TestManyGrids import make_blocks, make_image, multi_block

TIME_LIMIT = 600
EXTREMES = [math.nan, math.inf, -math.inf, 1e300, 0.0]


def change_values(generator, block):
    scalars = block.GetPointData().GetScalars()
    for _ in range(30):
        scalars.SetTuple1(generator.randrange(scalars.GetNumberOfTuples()), generator.choice(EXTREMES))


def add_flags(generator, block, tuples):
    flags = vtkUnsignedCharArray()
    flags.SetName(vtkDataSetAttributes.GhostArrayName())
    for _ in range(tuples):
        flags.InsertNextValue(generator.choice([0, 0, 1, 2, 8, 32]))
    generator.choice([block.GetCellData(), block.GetPointData()]).AddArray(flags)


DAMAGES = [
    lambda g, b: b.SetSpacing(g.choice([0, -1, 1e-300, *EXTREMES]), 1, 1),
    lambda g, b: b.SetOrigin(g.choice(EXTREMES), 0, 0),
    lambda g, b: b.SetDimensions(g.choice([0, 1, 2, 3, 50]), g.choice([1, 2, 9]), 3),
    lambda g, b: b.GetPointData().GetScalars().SetNumberOfTuples(g.randrange(20)),
    lambda g, b: b.GetPointData().Initialize(),
    lambda g, b: add_flags(g, b, g.randrange(400)),
    lambda g, b: add_flags(g, b, b.GetNumberOfCells()),
    lambda g, b: add_flags(g, b, b.GetNumberOfPoints()),
    change_values,
    lambda g, b: b.SetDirectionMatrix(*[g.choice([0, 1, -1, math.nan, 0.3]) for _ in range(9)]),
    lambda g, b: b.SetExtent(5, 4, 3, 2, 0, 0),
    lambda g, b: b.SetExtent(2**30, 2**30 + 9, 0, 9, 0, 9),
    lambda g, b: b.GetPointData().GetScalars().Fill(0.0),
]


def damage(generator, block):
    try:
        generator.choice(DAMAGES)(generator, block)
    except (AttributeError, TypeError, ValueError):
        pass  # A mesh has no spacing; samples may be gone already.


def make_data(generator):
    """Composite data, and their blocks."""
    if generator.random() < 0.25:
        amr = generator.choice([vtkOverlappingAMR, vtkNonOverlappingAMR])()
        blocks = fill(amr, generator.choice([NESTED, APART]), generator.random() < 0.5, noise=0.2)
        return amr, blocks
    # The last two lie on one lattice.
    blocks = make_blocks() + [make_image((0.3, 0.2, 0.1), (0.41, 0.37, 0.43), 13, ball),
                              make_image((5.22, 0.2, 0.1), (0.41, 0.37, 0.43), 9, ball)]  # fmt: skip
    generator.shuffle(blocks)
    listed = blocks[:]
    if generator.random() < 0.3:
        listed.insert(2, vtkPolyData())
    if generator.random() < 0.3:
        listed.insert(1, None)
    return multi_block([multi_block(listed[:3]), *listed[3:]]), blocks


def attack(seed):
    """Returns whether anything was hit."""
    generator = random.Random(seed)
    data, blocks = make_data(generator)
    for block in generator.sample(blocks, generator.randrange(4)):
        damage(generator, block)
    mapper, volume = make_volume(
        data, 0.0, opacity=generator.choice([0.01, 1.0]),
        mapper_class=generator.choice([vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper]))
    mapper.SetShadows(generator.random() < 0.3)
    if generator.random() < 0.3:
        cutter = vtkPlane()
        cutter.SetOrigin(3, 3, 3)
        cutter.SetNormal(generator.random(), generator.random(), 1)
        mapper.AddClippingPlane(cutter)
        mapper.SetCapClippingPlanes(generator.random() < 0.5)
    hits = cast(mapper, volume, parallel_rays(9))
    camera = vtkCamera()
    camera.SetPosition(3, -20, 8)
    camera.SetFocalPoint(3, 3, 3)
    camera.SetClippingRange(1, 60)
    mapper.RenderToImage(volume, camera, None, 24, 24, vtkImageData())
    mapper.GetBounds()
    damage(generator, generator.choice(blocks))
    cast(mapper, volume, parallel_rays(5))
    return bool(hits)


class TestDamagedBlocks(unittest.TestCase):
    def test_nothing_crashes(self):
        run = subprocess.run(
            [sys.executable, "-X", "faulthandler", __file__, "attack", "0", "300"],
            capture_output=True, check=False, timeout=TIME_LIMIT, text=True)  # fmt: skip
        lines = run.stdout.splitlines()
        self.assertEqual(run.returncode, 0, f"{lines[-1:]}: {run.stderr[-2000:]}")
        # Blocks that are left out do not keep the others from being drawn.
        self.assertGreater(int(lines[-1].split()[1]), 250)


if __name__ == "__main__":
    if sys.argv[1:2] == ["attack"]:
        vtkObject.GlobalWarningDisplayOff()
        first, count = int(sys.argv[2]), int(sys.argv[3])
        with_hits = 0
        for number in range(first, first + count):
            print(f"ATTACK {number}", flush=True)
            with_hits += attack(number)
        print(f"DONE {with_hits}")
    else:
        unittest.main()
