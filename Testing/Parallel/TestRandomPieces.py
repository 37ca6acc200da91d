#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The picture of many processes is that of one: random data, pieces, surfaces, planes and views. Run by mpirun, with
the number of scenes in ATTACK_SCENES and that of the first in ATTACK_SEED."""

import os
import random
import unittest

from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkRenderingCore import vtkCamera
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper

from Pieces import (
    RANK,
    SIZE,
    WORLD,
    as_mesh,
    make_piece,
    make_volume,
    pixels_of,
    render,
    whole_picture,
    with_cell_scalars,
)

Mapper = vtkIsosurfaceRayTraceMapper
# What is made of an image, with which mapper and settings, and how many layers of ghosts it needs.
EXACT = ("SetNormalMode", Mapper.INTERPOLANT_GRADIENT)
KINDS = (
    (lambda image: image, Mapper, [], 1),
    (lambda image: image, Mapper, [EXACT], 0),
    (lambda image: image, Mapper, [("SetInterpolationMode", Mapper.CUBIC)], 2),
    (lambda image: image, Mapper, [("SetInterpolationMode", Mapper.NEAREST)], 0),
    (with_cell_scalars, Mapper, [], 2),
    (as_mesh, vtkIsosurfaceRayTraceMeshMapper, [], 1),
    (as_mesh, vtkIsosurfaceRayTraceMeshMapper, [EXACT], 0),
)


def split(box, parts, numbers):
    """So many boxes of cells of any size; None for what is left if there are too few cells."""
    axes = [k for k in range(3) if box[k][1] - box[k][0] > 1]
    if parts == 1 or not axes:
        return [box] + [None] * (parts - 1)
    axis = numbers.choice(axes)
    low, high = box[axis]
    middle = numbers.randint(low + 1, high - 1)
    lower = numbers.randint(1, parts - 1)
    halves = ((low, middle), lower), ((middle, high), parts - lower)
    return [part for half, count in halves
            for part in split(box[:axis] + (half,) + box[axis + 1:], count, numbers)]


class Scene:
    """The same in all processes."""

    def __init__(self, seed):
        numbers = random.Random(seed)
        self.cells = tuple((-numbers.randint(3, 14), numbers.randint(3, 14)) for _ in range(3))
        self.boxes = split(self.cells, SIZE, numbers)
        self.origin = [numbers.uniform(-100.0, 100.0) for _ in range(3)]
        self.spacing = [numbers.uniform(0.3, 2.0) for _ in range(3)]
        self.convert, self.mapper_class, settings, self.ghosts = numbers.choice(KINDS)
        self.isovalues = sorted(numbers.uniform(60.0, 250.0) for _ in range(numbers.randint(1, 4)))
        self.opacities = [numbers.choice((1.0, numbers.uniform(0.05, 0.95))) for _ in self.isovalues]
        self.settings = settings + numbers.choice(([], [], self.make_cut(numbers)))
        self.camera = self.make_camera(numbers)
        self.size = (numbers.randint(20, 120), numbers.randint(20, 90))

    def find_point(self, numbers):
        return [origin + spacing * numbers.uniform(-4.0, 4.0) for origin, spacing in zip(self.origin, self.spacing)]

    def make_cut(self, numbers):
        plane = vtkPlane()
        plane.SetOrigin(self.find_point(numbers))
        plane.SetNormal([numbers.uniform(-1.0, 1.0) for _ in range(3)])
        return [("AddClippingPlane", plane), ("SetCapClippingPlanes", numbers.random() < 0.5)]

    def make_camera(self, numbers):
        camera = vtkCamera()
        focal_point = self.find_point(numbers)
        distance = numbers.uniform(2.0, 60.0)
        camera.SetFocalPoint(focal_point)
        camera.SetPosition([x + distance * numbers.gauss(0.0, 1.0) for x in focal_point])
        camera.SetViewUp(0.1, 0.2, 1.0)
        camera.SetClippingRange(0.05, 400.0)
        camera.SetParallelProjection(numbers.random() < 0.3)
        camera.SetParallelScale(numbers.uniform(5.0, 25.0))
        return camera

    def make_volume(self, box, ghosts):
        data = None
        if box:
            image = make_piece(box, ghosts, self.cells)
            image.SetOrigin(self.origin)
            image.SetSpacing(self.spacing)
            data = self.convert(image)
        return make_volume(data, self.opacities, self.isovalues, self.mapper_class, self.settings)


def count_differences(found, expected, is_mesh):
    """The points of a mesh are counted from its centre: depths differ in the last bits of a float."""
    def are_same(a, b):
        return a == b or (is_mesh and a[0] == b[0] and abs(a[1] - b[1]) <= 1e-6)

    return sum(not are_same(a, b) for a, b in zip(found, expected))


class TestRandomPieces(unittest.TestCase):
    def test_random_scenes(self):
        first, count = int(os.environ.get("ATTACK_SEED", 1)), int(os.environ.get("ATTACK_SCENES", 40))
        pixels, covered, different = 0, 0, []
        for seed in range(first, first + count):
            scene = Scene(seed)
            is_rendered, picture = render(scene.make_volume(scene.boxes[RANK], scene.ghosts), scene.camera, scene.size)
            self.assertTrue(is_rendered, seed)
            if RANK == 0:
                expected = whole_picture(scene.make_volume(scene.cells, 0), scene.camera, scene.size)
                number = count_differences(pixels_of(picture), expected, scene.convert is as_mesh)
                different += [f"{number} of scene {seed}"] if number else []
                covered += sum(color[3] > 0.0 for color, _ in expected)
                pixels += len(expected)
        if RANK == 0:
            print(f"{SIZE} processes, {count} scenes: {pixels} pixels, {covered} covered; different: {different}")
        different, pixels, covered = WORLD.bcast((different, pixels, covered), root=0)
        self.assertEqual(different, [])
        self.assertGreater(covered, pixels // 8)


if __name__ == "__main__":
    unittest.main()
