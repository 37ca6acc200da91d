#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The mapper of meshes: cells of every shape, pictures, rays, picking, errors."""

import itertools
import math
import subprocess
import sys
import unittest
from pathlib import Path
from random import Random

from vtkmodules.vtkCommonCore import (
    VTK_DOUBLE,
    VTK_FLOAT,
    mutable,
    vtkBitArray,
    vtkCommand,
    vtkDoubleArray,
    vtkIdList,
    vtkIdTypeArray,
    vtkPoints,
    vtkUnsignedCharArray,
)
from vtkmodules.vtkCommonDataModel import (
    VTK_BEZIER_HEXAHEDRON,
    VTK_BEZIER_TETRAHEDRON,
    VTK_BEZIER_WEDGE,
    VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON,
    VTK_BIQUADRATIC_QUADRATIC_WEDGE,
    VTK_CONVEX_POINT_SET,
    VTK_HEXAHEDRON,
    VTK_HEXAGONAL_PRISM,
    VTK_LAGRANGE_HEXAHEDRON,
    VTK_LAGRANGE_TETRAHEDRON,
    VTK_LAGRANGE_TETRAHEDRON,
    VTK_LAGRANGE_WEDGE,
    VTK_POLYHEDRON,
    VTK_PYRAMID,
    VTK_QUADRATIC_HEXAHEDRON,
    VTK_QUADRATIC_LINEAR_WEDGE,
    VTK_QUADRATIC_PYRAMID,
    VTK_QUADRATIC_TETRA,
    VTK_QUADRATIC_WEDGE,
    VTK_TETRA,
    VTK_TRIANGLE,
    VTK_TRIQUADRATIC_HEXAHEDRON,
    VTK_VOXEL,
    VTK_WEDGE,
    vtkDataSetAttributes,
    vtkGenericCell,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPolyData,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData, vtkContourFilter
from vtkmodules.vtkFiltersSources import vtkCellTypeSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkWindowToImageFilter,
)
import vtkmodules.vtkRenderingOpenGL2  # the window
from vtkIsosurfaceRayTracing import vtkIsosurfaceComparisonFilter, vtkIsosurfacePicker

from MeshTesting import (
    SIZE,
    ball,
    cast,
    errors_of,
    insert_polyhedron,
    make_grid,
    make_polyhedra,
    make_structured_grid,
    make_volume,
    parallel_rays,
    plane,
    set_values,
)

LINEAR_SHAPES = (VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID)


def make_cells(shape, value):
    """Two cells that are alike, the second one shifted by 2 along x."""
    reference = vtkGenericCell()
    reference.SetCellType(VTK_HEXAHEDRON if shape == VTK_CONVEX_POINT_SET else shape)
    places = reference.GetParametricCoords()
    places = [places[i : i + 3] for i in range(0, 3 * reference.GetNumberOfPoints(), 3)]
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetDataTypeToDouble()
    for shift in (0.0, 2.0):
        ids = [points.InsertNextPoint(x + shift, y, z) for x, y, z in places]
        grid.InsertNextCell(shape, len(ids), ids)
    grid.SetPoints(points)
    return set_values(grid, value)


def make_random_cell(shape, count):
    random = Random(3)
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    for _ in range(max(count, 1)):
        points.InsertNextPoint(random.random(), random.random(), random.random())
    grid.SetPoints(points)
    grid.InsertNextCell(shape, count, range(count))
    return set_values(grid, ball)


def make_cubes_with_points_on_edges(count, parts, place, precision):
    """Polyhedra. Values inside of the grid are random, and those at its border less than 0."""
    random = Random(1)
    points, numbers, values = vtkPoints(), {}, vtkDoubleArray()
    points.SetDataType(precision)
    grid = vtkUnstructuredGrid()

    def number(p):
        key = tuple(round(parts * c) for c in p)
        if key not in numbers:
            numbers[key] = points.InsertNextPoint(place([c / parts for c in key]))
            is_inside = all(0 < c < parts * count for c in key)
            values.InsertNextValue(random.uniform(-1.0, 1.0) if is_inside else -1.0)
        return numbers[key]

    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    for cube in itertools.product(range(count), repeat=3):
        faces = []
        for axis, side in itertools.product(range(3), range(2)):
            face = []
            for (u, v), (to_u, to_v) in zip(corners, corners[1:] + corners[:1]):
                for i in range(parts):
                    offset = [0.0, 0.0, 0.0]
                    offset[axis] = side
                    offset[(axis + 1) % 3] = u + (to_u - u) * i / parts
                    offset[(axis + 2) % 3] = v + (to_v - v) * i / parts
                    face.append(number([c + o for c, o in zip(cube, offset)]))
            faces.append(face)
        insert_polyhedron(grid, faces)
    grid.SetPoints(points)
    grid.GetPointData().SetScalars(values)
    return grid


def make_tuple(numbers):
    """An array of one."""
    array = vtkDoubleArray()
    array.SetNumberOfComponents(len(numbers))
    array.InsertNextTuple(numbers)
    return array


def make_prism(polygon, value):
    """One polyhedron over a polygon, from z = 0 to 1."""
    grid, points, count = vtkUnstructuredGrid(), vtkPoints(), len(polygon)
    points.SetDataTypeToDouble()
    for z in (0.0, 1.0):
        for x, y in polygon:
            points.InsertNextPoint(x, y, z)
    grid.SetPoints(points)
    sides = [(i, (i + 1) % count, count + (i + 1) % count, count + i) for i in range(count)]
    insert_polyhedron(grid, [range(count), range(count, 2 * count), *sides])
    return set_values(grid, value)


def make_uneven_cubes(value):
    """Polyhedra of which the faces are not flat, and turned in and out at random."""
    random, size = Random(4), 4
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetDataTypeToDouble()
    places = [(x, y, z) for z in range(size) for y in range(size) for x in range(size)]
    numbers = random.sample(range(len(places)), len(places))
    points.SetNumberOfPoints(len(places))
    for place, number in zip(places, numbers):
        points.SetPoint(number, [p + random.uniform(-0.1, 0.1) for p in place])
    grid.SetPoints(points)
    of_place = dict(zip(places, numbers))
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    for first in places:
        if max(first) + 1 < size:
            faces = []
            for axis in range(3):
                for side in (0, 1):
                    offsets = [(*c[:axis], side, *c[axis:]) for c in corners]
                    face = [of_place[tuple(f + o for f, o in zip(first, offset))] for offset in offsets]
                    faces.append(face if random.random() < 0.5 else face[::-1])
            insert_polyhedron(grid, faces)
    return set_values(grid, value)


def split_cells(grid):
    """A grid of tetrahedra as TetrahedralizeOn is to make them, and the cell that each is of."""
    split, cells = vtkUnstructuredGrid(), []
    split.SetPoints(grid.GetPoints())
    split.GetPointData().ShallowCopy(grid.GetPointData())
    for i in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(i)
        ids = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
        apex = min(ids, key=grid.GetPoint)
        if len(ids) == 4:
            split.InsertNextCell(VTK_TETRA, 4, ids)
            cells.append(i)
            continue
        tetrahedra = []
        for k in range(cell.GetNumberOfFaces()):
            of_face = cell.GetFace(k).GetPointIds()
            face = [of_face.GetId(m) for m in range(of_face.GetNumberOfIds())]
            first = face.index(min(face, key=grid.GetPoint))
            face = face[first:] + face[:first]
            if apex not in face:
                tetrahedra += [[apex, face[0], face[m], face[m + 1]] for m in range(1, len(face) - 1)]
        for tetrahedron in tetrahedra:
            split.InsertNextCell(VTK_TETRA, 4, tetrahedron)
            cells.append(i)
    return split, cells


def show(volume):
    """A window of 80 x 80 pixels, rendered, and its renderer."""
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(True)
    window.SetSize(80, 80)
    window.AddRenderer(renderer)
    renderer.AddVolume(volume)
    renderer.ResetCamera()
    window.Render()
    return window, renderer


class TestMeshMapper(unittest.TestCase):
    def test_a_plane_is_hit_exactly_in_every_shape(self):
        for shape in LINEAR_SHAPES:
            with self.subTest(shape=shape):
                mapper, volume = make_volume(make_grid(shape, plane), 3.3)
                hits = {ray: (t, normal) for ray, t, _, normal in cast(mapper, volume, parallel_rays())}
                length = math.sqrt(1.0 + 0.25 + 0.0625)
                expected = 0
                for i, (origin, direction) in enumerate(parallel_rays()):
                    t = (3.3 - plane(origin)) / plane(direction)
                    point = [o + t * d for o, d in zip(origin, direction)]
                    if all(0.001 < p < SIZE - 0.001 for p in point):
                        expected += 1
                        self.assertAlmostEqual(hits[i][0], t, delta=1e-12)
                        for n, m in zip(hits[i][1], (1.0, 0.5, -0.25)):
                            self.assertAlmostEqual(n, -m / length, delta=1e-9)
                self.assertGreater(expected, 40)

    def test_cells_are_split_into_tetrahedra(self):
        grids = [make_grid(shape, ball) for shape in LINEAR_SHAPES]
        grids.append(make_structured_grid(ball))
        hidden = vtkUnsignedCharArray()
        hidden.SetName(vtkDataSetAttributes.GhostArrayName())
        for i in range(grids[1].GetNumberOfCells()):
            hidden.InsertNextValue(vtkDataSetAttributes.HIDDENCELL if i % 5 == 0 else 0)
        grids[1].GetCellData().AddArray(hidden)
        for grid in grids:
            with self.subTest(grid.GetCellType(0)):
                split, cell_of = split_cells(grid)
                flags = grid.GetCellData().GetArray(hidden.GetName())
                if flags:
                    of_split = vtkUnsignedCharArray()
                    of_split.SetName(hidden.GetName())
                    for cell in cell_of:
                        of_split.InsertNextValue(flags.GetValue(cell))
                    split.GetCellData().AddArray(of_split)
                expected = cast(*make_volume(split, 0.0), parallel_rays())
                mapper, volume = make_volume(grid, 0.0)
                of_cells = cast(mapper, volume, parallel_rays())
                mapper.TetrahedralizeOn()
                found = cast(mapper, volume, parallel_rays())
                self.assertGreater(len(found), 40)
                self.assertEqual([hit[:3] for hit in found], [(ray, t, cell_of[cell]) for ray, t, cell, _ in expected])
                for hit, other in zip(found, expected):
                    # The gradients of cells are added in another order.
                    self.assertLess(math.dist(hit[3], other[3]), 1e-14)
                mapper.TetrahedralizeOff()
                self.assertEqual(cast(mapper, volume, parallel_rays()), of_cells)
                if grid.GetCellType(0) == VTK_TETRA:
                    self.assertEqual(found, of_cells)
                else:
                    self.assertNotEqual([hit[1] for hit in found], [hit[1] for hit in of_cells])

    def test_pieces_are_split_as_the_whole(self):
        """Though their points have other ids."""
        grid = make_structured_grid(ball)
        blocks = vtkMultiBlockDataSet()
        for first in (0, 1):
            piece, points = vtkUnstructuredGrid(), vtkPoints()
            for i in range(first, grid.GetNumberOfCells(), 2):
                of_cell = grid.GetCell(i).GetPoints()
                # The last one first: they have other ids, and the points of neighbours are others.
                ids = [points.InsertNextPoint(of_cell.GetPoint(k)) for k in reversed(range(8))]
                piece.InsertNextCell(VTK_HEXAHEDRON, 8, ids[::-1])
            piece.SetPoints(points)
            blocks.SetBlock(first, set_values(piece, ball))
        hits = []
        for data in (grid, blocks):
            mapper, volume = make_volume(data, 0.0)
            of_cells = cast(mapper, volume, parallel_rays())
            mapper.TetrahedralizeOn()
            hits.append(cast(mapper, volume, parallel_rays()))
            self.assertNotEqual([hit[1] for hit in hits[-1]], [hit[1] for hit in of_cells])
        self.assertGreater(len(hits[0]), 40)
        self.assertEqual(*([hit[0] for hit in some] for some in hits))
        for hit, other in zip(*hits):
            self.assertAlmostEqual(hit[1], other[1], delta=1e-13)

    def test_concave_polyhedra_are_split_as_they_are(self):
        star = [(math.cos(i * math.pi / 5) * (1 + i % 2), math.sin(i * math.pi / 5) * (1 + i % 2)) for i in range(10)]
        mapper, volume = make_volume(make_prism(star, lambda point: point[2]), 0.5)
        rays = [((0.1 * i, 0.1 * k, -1.0), (0.0, 0.0, 1.0)) for i in range(-20, 21) for k in range(-20, 21)]
        whole = cast(mapper, volume, rays)
        mapper.TetrahedralizeOn()
        self.assertEqual([hit[:3] for hit in cast(mapper, volume, rays)], [hit[:3] for hit in whole])
        self.assertTrue(400 < len(whole) < 1200)

    def test_voxels_are_hexahedra(self):
        grid = make_grid(VTK_HEXAHEDRON, ball)
        voxels = vtkUnstructuredGrid()
        voxels.SetPoints(grid.GetPoints())
        voxels.GetPointData().ShallowCopy(grid.GetPointData())
        ids = vtkIdList()
        for cell in range(grid.GetNumberOfCells()):
            grid.GetCellPoints(cell, ids)
            voxels.InsertNextCell(VTK_VOXEL, 8, [ids.GetId(i) for i in (0, 1, 3, 2, 4, 5, 7, 6)])
        expected = cast(*make_volume(grid, 0.0), parallel_rays())
        self.assertGreater(len(expected), 40)
        for hit, other in zip(cast(*make_volume(voxels, 0.0), parallel_rays()), expected):
            self.assertEqual(hit[0], other[0])
            self.assertAlmostEqual(hit[1], other[1], delta=1e-12)

    def test_other_cells_are_subdivided(self):
        for shape in (VTK_QUADRATIC_TETRA, VTK_QUADRATIC_HEXAHEDRON):
            with self.subTest(shape=shape):
                grid = make_grid(shape, ball)
                mapper, volume = make_volume(grid, 0.0)
                hits = cast(mapper, volume, parallel_rays())
                self.assertGreater(len(hits), 40)
                for ray, t, cell, _ in hits:
                    origin, direction = parallel_rays()[ray]
                    self.assertLess(abs(ball([o + t * d for o, d in zip(origin, direction)])), 0.15)
                    self.assertLess(cell, grid.GetNumberOfCells())

    def test_subdivided_cells_are_filled(self):
        wedges = (VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_LINEAR_WEDGE, VTK_BIQUADRATIC_QUADRATIC_WEDGE)
        for shape in (VTK_QUADRATIC_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON,
                      VTK_CONVEX_POINT_SET, *wedges):
            with self.subTest(shape=shape):
                grid = make_cells(shape, lambda point: point[2])
                inside = [(0.03 + 0.1 * i, 0.04 + 0.1 * j) for i in range(10) for j in range(10)
                          if shape not in wedges or i + j < 9]
                rays = [((x + shift, y, -1.0), (0.0, 0.0, 1.0)) for shift in (0.0, 2.0) for x, y in inside]
                hits = cast(*make_volume(grid, 0.3), rays)
                self.assertEqual([hit[0] for hit in hits], list(range(len(rays))))
                self.assertEqual([hit[2] for hit in hits], len(inside) * [0] + len(inside) * [1])
                for hit in hits:
                    self.assertAlmostEqual(hit[1], 1.3, delta=1e-12)

    def test_cells_divide_a_face_alike(self):
        def wavy_ball(point):
            return 1.1 - math.dist(point, (1.5, 1.5, 1.5)) + 0.08 * math.sin(4.0 * point[0] + 2.0 * point[1])

        shapes = [(shape, order) for shape in (VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_WEDGE, VTK_LAGRANGE_TETRAHEDRON)
                  for order in (1, 2, 3)]  # fmt: skip
        shapes += [(VTK_BEZIER_HEXAHEDRON, 2), (VTK_BEZIER_WEDGE, 2), (VTK_HEXAGONAL_PRISM, 1),
                   (VTK_QUADRATIC_PYRAMID, 1)]  # fmt: skip
        for shape, order in shapes:
            with self.subTest(shape=shape, order=order):
                source = vtkCellTypeSource()
                source.SetCellType(shape)
                source.SetCellOrder(order)
                source.SetBlocksDimensions(3, 3, 3)
                source.Update()
                self._check_closed(set_values(source.GetOutput(), wavy_ball), 0.0123)
        with self.subTest(shape=VTK_POLYHEDRON):
            self._check_closed(make_uneven_cubes(wavy_ball), 0.0123)

    def _check_closed(self, grid, value):
        """Each ray enters a closed surface as often as it leaves it."""
        random = Random(2)
        rays = []
        for _ in range(1000):
            direction = [random.gauss(0.0, 1.0) for _ in range(3)]
            far = 8.0 / math.hypot(*direction)
            rays.append(([random.gauss(1.5, 0.5) - far * d for d in direction], direction))
        hits = [hit[0] for hit in cast(*make_volume(grid, value, opacity=0.1), rays)]
        self.assertGreater(len(hits), 800)
        self.assertEqual({ray for ray in hits if hits.count(ray) % 2 != 0}, set())

    def test_polyhedra_that_are_not_convex(self):
        """Those seen from their centres are traced; of others the hull, with a warning."""
        rays = [((0.03 + 0.1 * i, 0.04 + 0.1 * j, -1.0), (0.0, 0.0, 1.0)) for i in range(20) for j in range(20)]
        corner = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]
        mapper, volume = make_volume(make_prism(corner, lambda point: point[2]), 0.3)
        hits = []
        warnings = errors_of(mapper, lambda: hits.extend(cast(mapper, volume, rays)), vtkCommand.WarningEvent)
        self.assertEqual(warnings, [])
        inside = [i for i, ((x, y, _), _) in enumerate(rays) if x < 1.0 or y < 1.0]
        self.assertEqual([hit[0] for hit in hits], inside)
        for hit in hits:
            self.assertAlmostEqual(hit[1], 1.3, delta=1e-12)
        fork = [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)]
        mapper, volume = make_volume(make_prism(fork, lambda point: point[2]), 0.3)
        warnings = errors_of(mapper, lambda: cast(mapper, volume, rays), vtkCommand.WarningEvent)
        self.assertEqual(len(warnings), 1)
        self.assertIn("Cell 0 is a polyhedron", warnings[0])
        self.assertEqual(errors_of(mapper, lambda: cast(mapper, volume, rays), vtkCommand.WarningEvent), [])

    def test_polyhedra_with_points_on_their_edges(self):
        """As cells of an octree beside finer ones: straight, rounded, or bent a little. No ray gets in or out elsewhere."""

        def turn(p):
            x, y, z = p
            x, y = 0.92 * x - 0.39 * y, 0.39 * x + 0.92 * y
            return x, 0.95 * y - 0.31 * z, 0.31 * y + 0.95 * z

        def bend(p):
            return [p[k] + 0.01 * math.sin(3.1 * p[(k + 1) % 3] + 1.7 * p[(k + 2) % 3] + k) for k in range(3)]

        def round_places(p):
            return [c + 1000.0 for c in turn(p)]

        for parts in (2, 3):
            for place, precision, origin in ((turn, VTK_DOUBLE, 0.0), (bend, VTK_DOUBLE, 0.0),
                                             (round_places, VTK_FLOAT, 1000.0)):  # fmt: skip
                with self.subTest(parts=parts, place=place.__name__):
                    grid = make_cubes_with_points_on_edges(3, parts, place, precision)
                    mapper, volume = make_volume(grid, 0.0, opacity=0.001)
                    warnings = []
                    tag = mapper.AddObserver(vtkCommand.WarningEvent, lambda *_: warnings.append(1))
                    random = Random(parts)
                    rays = []
                    for _ in range(1500):
                        inside = [random.uniform(0.0, 3.0) for _ in range(3)]
                        direction = [random.gauss(0.0, 1.0) for _ in range(3)]
                        target = (turn if place is round_places else place)(inside)
                        rays.append(([origin + target[k] - 20.0 * direction[k] for k in range(3)], direction))
                    hits = [hit[0] for hit in cast(mapper, volume, rays)]
                    mapper.RemoveObserver(tag)
                    self.assertGreater(len(hits), 1500)
                    self.assertEqual([ray for ray in set(hits) if hits.count(ray) % 2 == 1], [])
                    self.assertEqual(warnings, [])

    def test_concave_faces_are_cut_alike(self):
        """Two cells on each other meet in an uneven L, with points in common or points of their own."""
        corner = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]
        rays = [((0.03 + 0.1 * i, 0.04 + 0.1 * j, -1.0), (0.0, 0.0, 1.0)) for i in range(20) for j in range(20)]
        inside = [i for i, ((x, y, _), _) in enumerate(rays) if x < 1.0 or y < 1.0]
        for seed in range(10):
            random = Random(seed)
            heights = [[0.0] * 6, [1.0 + random.uniform(-0.1, 0.1) for _ in range(6)], [2.0] * 6]
            grid, points = vtkUnstructuredGrid(), vtkPoints()
            points.SetDataTypeToDouble()
            layers = [0, 1, 1, 2] if seed % 2 else [0, 1, 2]
            numbers = random.sample(range(6 * len(layers)), 6 * len(layers))
            points.SetNumberOfPoints(len(numbers))
            for i, number in enumerate(numbers):
                points.SetPoint(number, *corner[i % 6], heights[layers[i // 6]][i % 6])
            grid.SetPoints(points)
            for lower in (0, len(layers) - 2):
                low, high = numbers[6 * lower : 6 * lower + 6], numbers[6 * lower + 6 : 6 * lower + 12]
                sides = [(low[i - 1], low[i], high[i], high[i - 1]) for i in range(6)]
                faces = []
                for face in (low, high, *sides):
                    first = random.randrange(len(face))
                    face = [*face[first:], *face[:first]]
                    faces.append(face if random.random() < 0.5 else face[::-1])
                insert_polyhedron(grid, faces)
            mapper, volume = make_volume(set_values(grid, lambda point: point[2]), 1.0, opacity=0.1)
            hits = cast(mapper, volume, rays)
            self.assertEqual([hit[0] for hit in hits], inside)
            for hit in hits:
                self.assertAlmostEqual(hit[1], 2.0, delta=1e-12)

    def test_many_cells_that_are_subdivided(self):
        """More than a thread takes at once."""
        count = 13
        source = vtkCellTypeSource()
        source.SetCellType(VTK_HEXAHEDRON)
        source.SetBlocksDimensions(count, count, count)
        source.Update()
        grid = make_polyhedra(set_values(source.GetOutput(), plane))
        rays = [((0.37 + i, 0.41 + j, -1.0), (0.1, 0.05, 1.0)) for i in range(count - 1) for j in range(count - 1)]
        found = []
        for threads in (1, 3):
            mapper, volume = make_volume(grid, *(0.2 * i + 0.0137 for i in range(70)), opacity=0.1)
            mapper.SetNumberOfThreads(threads)
            found.append(cast(mapper, volume, rays))
        self.assertEqual(*found)
        self.assertGreater(len(found[0]), 1000)
        for ray, t, cell, _ in found[0]:
            point = [o + t * d for o, d in zip(*rays[ray])]
            x, y, z = (int(p) for p in point)
            self.assertEqual(cell, x + count * (y + count * z))

    def test_faces_of_points_that_are_not_there(self):
        grid = make_prism([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)], lambda point: point[2])
        if hasattr(grid, "GetPolyhedronFaces"):
            faces, last = grid.GetPolyhedronFaces().GetConnectivityArray(), 23
        else:
            faces, last = grid.GetFaces(), 30
        for number in (8, -1):
            self.assertIn(faces.GetTuple1(last), range(8))
            former = faces.GetTuple1(last)
            faces.SetTuple1(last, number)
            mapper, volume = make_volume(grid, 0.5)
            errors = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays()))
            self.assertIn("Cell 0 has a wrong number of points, or a face of it has", errors[0])
            faces.SetTuple1(last, former)

    def test_faces_of_fewer_than_three_points(self):
        for count in range(3):
            with self.subTest(count=count):
                grid, points = vtkUnstructuredGrid(), vtkPoints()
                for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)):
                    points.InsertNextPoint(point)
                grid.SetPoints(points)
                insert_polyhedron(grid, [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3), range(count)])
                mapper, volume = make_volume(set_values(grid, lambda point: point[0]), 0.25)
                errors = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays()))
                self.assertIn("Cell 0 has a wrong number of points, or a face of it has", errors[0])

    def test_centres_of_polyhedra_are_not_picked(self):
        square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]
        mapper, volume = make_volume(make_prism(square, lambda point: point[2]), 0.45)
        window, renderer = show(volume)
        picker = vtkIsosurfacePicker()
        for x in range(30, 51, 5):
            self.assertTrue(picker.Pick(x, 40, 0, renderer))
            self.assertIn(picker.GetPointId(), range(8))

    def test_wrong_number_of_points_of_an_order(self):
        for shape in (VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_WEDGE, VTK_BEZIER_HEXAHEDRON, VTK_BEZIER_WEDGE):
            for count in (1, 9, 26):
                with self.subTest(shape=shape, count=count):
                    mapper, volume = make_volume(make_random_cell(shape, count), 0.0)
                    messages = errors_of(mapper, lambda m=mapper, v=volume: cast(m, v, parallel_rays()))
                    self.assertIn("Cell 0 has a wrong number of points", messages[0])

    def test_wrong_number_of_points_of_a_tetrahedron_of_any_order(self):
        """VTK crashes where it triangulates them."""
        for shape in (VTK_LAGRANGE_TETRAHEDRON, VTK_BEZIER_TETRAHEDRON):
            for count in (0, 1, 2, 3, 5, 9, 11, 21):
                with self.subTest(shape=shape, count=count):
                    mapper, volume = make_volume(make_random_cell(shape, count), 0.0)
                    messages = errors_of(mapper, lambda m=mapper, v=volume: cast(m, v, parallel_rays()))
                    self.assertIn("Cell 0 has a wrong number of points", messages[0])

    def test_degrees_and_weights_that_do_not_fit(self):
        """VTK trusts them, and writes beyond its memory."""
        for shape, count in ((VTK_LAGRANGE_HEXAHEDRON, 27), (VTK_BEZIER_HEXAHEDRON, 27), (VTK_LAGRANGE_WEDGE, 18),
                             (VTK_BEZIER_WEDGE, 18)):  # fmt: skip
            for degrees in ((2, 2, 3), (1, 1, 1), (2.5, 2, 2), (0, 2, 2), (-3, -3, 2), (math.nan, 2, 2), None):
                with self.subTest(shape=shape, degrees=degrees):
                    grid = make_random_cell(shape, count)
                    array = make_tuple(degrees or (2, 2, 2))
                    array.SetNumberOfTuples(1 if degrees else 0)
                    grid.GetCellData().SetHigherOrderDegrees(array)
                    mapper, volume = make_volume(grid, 0.0)
                    messages = errors_of(mapper, lambda m=mapper, v=volume: cast(m, v, parallel_rays()))
                    self.assertIn("Cell 0 has a wrong number of points", messages[0])
        for shape, count in ((VTK_LAGRANGE_HEXAHEDRON, 27), (VTK_LAGRANGE_WEDGE, 18), (VTK_LAGRANGE_WEDGE, 21)):
            grid = make_random_cell(shape, count)
            grid.GetCellData().SetHigherOrderDegrees(make_tuple((2, 2, 2)))
            mapper, volume = make_volume(grid, 0.0)
            self.assertEqual(errors_of(mapper, lambda m=mapper, v=volume: cast(m, v, parallel_rays())), [])
        grid = make_random_cell(VTK_BEZIER_HEXAHEDRON, 27)
        grid.GetPointData().SetRationalWeights(make_tuple([1.0]))
        mapper, volume = make_volume(grid, 0.0)
        messages = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays()))
        self.assertIn("RationalWeights", messages[0])

    def test_degrees_that_change_in_place_are_seen(self):
        grid = set_values(make_random_cell(VTK_LAGRANGE_HEXAHEDRON, 12), plane)
        degrees = make_tuple((1, 1, 2))
        grid.GetCellData().SetHigherOrderDegrees(degrees)
        mapper, volume = make_volume(grid, 0.5, opacity=0.1)
        rays = [((0.03 * i, 0.03 * j, -1.0), (0.03, 0.02, 1.0)) for i in range(34) for j in range(34)]
        before = cast(mapper, volume, rays)
        degrees.SetTuple3(0, 2, 1, 1)
        degrees.Modified()
        after = cast(mapper, volume, rays)
        self.assertGreater(len(after), 20)
        self.assertNotEqual(before, after)
        self.assertEqual(after, cast(*make_volume(grid, 0.5, opacity=0.1), rays))

    def test_comparison_of_cells_with_degrees(self):
        grid = set_values(make_random_cell(VTK_LAGRANGE_HEXAHEDRON, 12), plane)
        grid.GetCellData().SetHigherOrderDegrees(make_tuple((1, 1, 2)))
        comparison = vtkIsosurfaceComparisonFilter()
        comparison.SetInputData(grid)
        comparison.SetValue(0, 0.5)
        comparison.PicturesOff()
        self.assertEqual(errors_of(comparison, comparison.Update), [])
        pixels = comparison.GetOutput().GetColumnByName("CoveredPixels")
        self.assertGreater(min(pixels.GetValue(i) for i in range(pixels.GetNumberOfTuples())), 100)

    def test_convex_point_sets_divide_a_face_alike(self):
        """A ray that comes from below the isovalue, and gets there again, has as many hits that enter as hits that
        leave."""
        random = Random(1)
        for _ in range(20):
            face = [(0.0, y + 0.2 * random.random(), z + 0.2 * random.random())
                    for y, z in ((0, 0), (1, 0), (1, 1), (0, 1))]  # fmt: skip
            sides = [[(-1.0, 3.0 * y, z) for _, y, z in face], [(1.0, y, 3.0 * z) for _, y, z in face]]
            grid, points = vtkUnstructuredGrid(), vtkPoints()
            points.SetDataTypeToDouble()
            for place in (*face, *sides[0], *sides[1]):
                points.InsertNextPoint(place)
            grid.SetPoints(points)
            for first in (4, 8):
                grid.InsertNextCell(VTK_CONVEX_POINT_SET, 8, [0, 1, 2, 3, *range(first, first + 4)])
            high = {face[1], face[3]}
            set_values(grid, lambda point, high=high: float(point in high))
            mapper, volume = make_volume(grid, 0.5, opacity=0.1)
            rays = [((-2.0, 0.3 + 0.05 * i, 0.3 + 0.05 * j), (1.0, 0.0, 0.0)) for i in range(10) for j in range(10)]
            hits = [hit[0] for hit in cast(mapper, volume, rays)]
            self.assertEqual({ray for ray in hits if hits.count(ray) % 2 != 0}, set())

    def test_parametric_coordinates_are_those_of_the_cell(self):
        for shape in (VTK_TETRA, VTK_HEXAHEDRON, VTK_HEXAGONAL_PRISM, VTK_QUADRATIC_HEXAHEDRON):
            for splits in (False, True):
                with self.subTest(shape=shape, splits=splits):
                    grid = make_cells(shape, ball) if shape == VTK_HEXAGONAL_PRISM else make_grid(shape, ball)
                    value = ball((0.5, 0.5, 0.3)) if shape == VTK_HEXAGONAL_PRISM else 0.0
                    mapper, volume = make_volume(grid, value)
                    mapper.SetTetrahedralize(splits)
                    self._check_parametric(mapper, volume, grid)
        with self.subTest(shape=VTK_POLYHEDRON):
            grid = make_uneven_cubes(ball)
            self._check_parametric(*make_volume(grid, ball((1.2, 1.7, 1.5))), grid)

    def test_bezier_cells_are_evaluated_by_one_thread(self):
        """VTK allots memory for all threads where it evaluates the first one, which crashes one process in four."""
        code = f"""
from MeshTesting import *
rays = [((0.04 * i, 0.04 * j, -1.0), (0.01, 0.002, 1.0)) for i in range(1, 150) for j in range(1, 150)]
print(len(cast(*make_volume(make_grid({VTK_BEZIER_WEDGE}, plane), 3.3), rays)))
"""
        for _ in range(8):
            done = subprocess.run([sys.executable, "-c", code], cwd=Path(__file__).parent, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater(int(done.stdout), 5000)

    def _check_parametric(self, mapper, volume, grid):
        origins, directions, hits = vtkPoints(), vtkDoubleArray(), vtkPolyData()
        directions.SetNumberOfComponents(3)
        for origin, direction in parallel_rays(40):
            origins.InsertNextPoint(origin)
            directions.InsertNextTuple(direction)
        self.assertTrue(mapper.CastRays(volume, origins, directions, hits))
        self.assertGreater(hits.GetNumberOfPoints(), 3)
        data, cell = hits.GetPointData(), vtkGenericCell()
        for i in range(hits.GetNumberOfPoints()):
            grid.GetCell(int(data.GetArray("CellId").GetTuple1(i)), cell)
            point = [0.0] * 3
            cell.EvaluateLocation(mutable(0), data.GetArray("ParametricCoordinates").GetTuple3(i), point, [0.0] * 20)
            self.assertLess(math.dist(point, hits.GetPoint(i)), 1e-3)

    def test_picked_points_of_a_connection_that_is_moved(self):
        grid = make_grid(VTK_HEXAHEDRON, ball)
        mapper, volume = make_volume(grid, 0.0)
        moved = vtkVolume()
        moved.SetProperty(volume.GetProperty())
        moved.SetPosition(3.0, 2.0, 1.0)
        mapper.SetConnectionVolume(0, moved)
        window, renderer = show(volume)
        picker = vtkIsosurfacePicker()
        for x in range(30, 51, 5):
            self.assertTrue(picker.Pick(x, 40, 0, renderer))
            cell = grid.GetCell(picker.GetCellId())
            point = [p - q for p, q in zip(picker.GetPickPosition(), moved.GetPosition())]
            corners = [cell.GetPointId(i) for i in range(8)]
            self.assertEqual(picker.GetPointId(), min(corners, key=lambda i: math.dist(grid.GetPoint(i), point)))

    def test_flat_tetrahedra_are_walls(self):
        """Two corners at one place differ. The normals are those of tetrahedra that are a little thick."""
        places = ((0.0, 0.0, 0.0), (4.0, 0.0, 1.0), (1.0, 3.0, 0.5))
        across = (-3.0, -1.0, 12.0)
        rays = [((0.7 - 0.01 * i, 0.4, -1.0), (0.01 * i, 0.02, 1.0)) for i in range(-5, 6)]
        rays += [((x, y, 2.0), (u, v, -w)) for (x, y, _), (u, v, w) in rays]

        def find_normals(values, thickness, mode):
            grid, points = vtkUnstructuredGrid(), vtkPoints()
            points.SetDataTypeToDouble()
            for place in (*places, [thickness * a for a in across]):
                points.InsertNextPoint(place)
            grid.InsertNextCell(VTK_TETRA, 4, range(4))
            grid.SetPoints(points)
            following = iter(values)
            set_values(grid, lambda _: next(following))
            mapper, volume = make_volume(grid, 0.5)
            mapper.SetNormalMode(mode)
            return {hit[0]: hit[3] for hit in cast(mapper, volume, rays)}

        for low, high in ((0.0, 1.0), (1.0, 0.0), (0.0, 1e300)):
            for mode in (0, 1):
                with self.subTest(low=low, high=high, mode=mode):
                    flat = find_normals((low, low, low, high), 0.0, mode)
                    thick = find_normals((low, low, low, high), 1e-6, mode)
                    self.assertEqual(list(flat), list(range(len(rays))))
                    for ray, normal in flat.items():
                        for found, expected in zip(normal, thick[ray]):
                            self.assertAlmostEqual(found, expected, delta=1e-6)

    def test_structured_grid(self):
        grid = make_structured_grid(ball)
        mapper, volume = make_volume(grid, 0.0)
        hits = cast(mapper, volume, parallel_rays())
        listed = vtkUnstructuredGrid()
        listed.SetPoints(grid.GetPoints())
        listed.GetPointData().ShallowCopy(grid.GetPointData())
        ids = vtkIdList()
        for cell in range(grid.GetNumberOfCells()):
            grid.GetCellPoints(cell, ids)
            listed.InsertNextCell(VTK_HEXAHEDRON, ids)
        self.assertGreater(len(hits), 40)
        self.assertEqual(hits, cast(*make_volume(listed, 0.0), parallel_rays()))

    def test_hidden_cells(self):
        for grid in (make_grid(VTK_TETRA, ball), make_structured_grid(ball)):
            mapper, volume = make_volume(grid, 0.0)
            before = cast(mapper, volume, parallel_rays())
            hidden = before[0][2]
            ghosts = vtkUnsignedCharArray()
            ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
            ghosts.SetNumberOfTuples(grid.GetNumberOfCells())
            ghosts.Fill(0)
            ghosts.SetValue(hidden, vtkDataSetAttributes.HIDDENCELL)
            grid.GetCellData().AddArray(ghosts)
            after = cast(mapper, volume, parallel_rays())
            self.assertIn(hidden, {hit[2] for hit in before})
            self.assertNotIn(hidden, {hit[2] for hit in after})

    def test_hidden_points_hide_whole_cells(self):
        """Also those that are subdivided."""
        rays = [((x + shift, 0.3, -1.0), (0.0, 0.0, 1.0)) for shift in (0.0, 2.0) for x in (0.25, 0.35, 0.45)]
        for shape, tetrahedralize in ((VTK_HEXAHEDRON, False), (VTK_HEXAHEDRON, True), (VTK_HEXAGONAL_PRISM, False),
                                      (VTK_QUADRATIC_TETRA, False), (VTK_TRIQUADRATIC_HEXAHEDRON, False)):  # fmt: skip
            grid = make_cells(shape, lambda point: point[2])
            ghosts = vtkUnsignedCharArray()
            ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
            ghosts.SetNumberOfTuples(grid.GetNumberOfPoints())
            grid.GetPointData().AddArray(ghosts)
            for hidden in range(grid.GetNumberOfPoints()):
                with self.subTest(shape=shape, tetrahedralize=tetrahedralize, hidden=hidden):
                    ghosts.Fill(0)
                    ghosts.SetValue(hidden, vtkDataSetAttributes.HIDDENPOINT)
                    mapper, volume = make_volume(grid, 0.2)
                    mapper.SetTetrahedralize(tetrahedralize)
                    visible = 1 if hidden < grid.GetNumberOfPoints() // 2 else 0
                    self.assertEqual([hit[2] for hit in cast(mapper, volume, rays)], 3 * [visible])

    def test_cells_with_a_point_that_is_not_finite_are_not_hit(self):
        """Also those that are subdivided: no part of them is."""
        rays = [((x + shift, 0.3, -1.0), (0.0, 0.0, 1.0)) for shift in (0.0, 2.0) for x in (0.25, 0.35, 0.45)]
        for shape, tetrahedralize in ((VTK_HEXAHEDRON, False), (VTK_HEXAHEDRON, True), (VTK_HEXAGONAL_PRISM, False),
                                      (VTK_QUADRATIC_TETRA, False), (VTK_TRIQUADRATIC_HEXAHEDRON, False)):  # fmt: skip
            count = make_cells(shape, lambda point: point[2]).GetNumberOfPoints()
            for number, is_value in itertools.product(range(count), (True, False)):
                with self.subTest(shape=shape, tetrahedralize=tetrahedralize, number=number, is_value=is_value):
                    grid = make_cells(shape, lambda point: point[2])
                    if is_value:
                        grid.GetPointData().GetScalars().SetValue(number, math.nan)
                    else:
                        x, y, _ = grid.GetPoint(number)
                        grid.GetPoints().SetPoint(number, x, y, math.inf)
                    mapper, volume = make_volume(grid, 0.2)
                    mapper.SetTetrahedralize(tetrahedralize)
                    other = 1 if number < count // 2 else 0
                    self.assertEqual([hit[2] for hit in cast(mapper, volume, rays)], 3 * [other])

    def test_scalars_of_cells_are_averaged_as_by_vtk(self):
        grid = make_grid(VTK_HEXAHEDRON, ball)
        grid.GetPointData().Initialize()
        scalars = vtkDoubleArray()
        scalars.SetName("values")
        for i in range(grid.GetNumberOfCells()):
            bounds = grid.GetCell(i).GetBounds()
            scalars.InsertNextValue(ball([0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)]))
        grid.GetCellData().SetScalars(scalars)
        average = vtkCellDataToPointData()
        average.SetInputData(grid)
        average.Update()
        hits = cast(*make_volume(grid, 0.0), parallel_rays())
        self.assertGreater(len(hits), 40)
        # VTK's threads add the values at a point in any order.
        expected = cast(*make_volume(average.GetOutput(), 0.0), parallel_rays())
        self.assertEqual([hit[0] for hit in hits], [hit[0] for hit in expected])
        for hit, other in zip(hits, expected):
            self.assertAlmostEqual(hit[1], other[1], delta=1e-12)

    def test_scalars_of_cells_of_any_type(self):
        """VTK 9.1 does not average ids and bits."""
        grid = make_grid(VTK_HEXAHEDRON, ball)
        grid.GetPointData().Initialize()
        for kind in (vtkIdTypeArray, vtkBitArray):
            with self.subTest(kind.__name__):
                hits = []
                for scalars in (kind(), vtkDoubleArray()):
                    for i in range(grid.GetNumberOfCells()):
                        scalars.InsertNextTuple1(1 if i % 7 < 3 else 0)
                    grid.GetCellData().SetScalars(scalars)
                    hits.append(cast(*make_volume(grid, 0.4), parallel_rays()))
                self.assertGreater(len(hits[0]), 40)
                self.assertEqual([hit[0] for hit in hits[0]], [hit[0] for hit in hits[1]])
                for hit, other in zip(*hits):
                    self.assertAlmostEqual(hit[1], other[1], delta=1e-12)

    def test_pictures_picks_and_rays_agree(self):
        mapper, volume = make_volume(make_grid(VTK_WEDGE, ball), 0.0, -0.5)
        volume.GetProperty().GetScalarOpacity().AddPoint(-0.5, 0.4)
        mapper.ShadowsOn()
        renderer = vtkRenderer()
        renderer.AddVolume(volume)
        window = vtkRenderWindow()
        window.SetMultiSamples(0)
        window.SetSize(120, 90)
        window.AddRenderer(renderer)
        renderer.ResetCamera()
        renderer.GetActiveCamera().Azimuth(30.0)
        renderer.ResetCameraClippingRange()
        window.Render()
        grabbed = vtkWindowToImageFilter()
        grabbed.SetInput(window)
        grabbed.SetInputBufferTypeToRGB()
        grabbed.ReadFrontBufferOff()
        grabbed.Update()
        image = vtkImageData()
        self.assertTrue(mapper.RenderToImage(volume, renderer.GetActiveCamera(), None, 120, 90, image))
        drawn = memoryview(grabbed.GetOutput().GetPointData().GetScalars())
        colors = memoryview(image.GetPointData().GetArray("Colors"))
        different = sum(max(abs(drawn[i, k] - colors[i, k]) for k in range(3)) > 1 for i in range(120 * 90))
        self.assertEqual(different, 0)
        picker = vtkIsosurfacePicker()
        self.assertTrue(picker.Pick(60, 45, 0, renderer))
        self.assertAlmostEqual(ball(picker.GetPickPosition()), -0.5, delta=0.1)

    def test_gradients_are_found_for_the_first_and_the_second_isovalue(self):
        mapper, volume = make_volume(make_grid(VTK_TETRA, ball), 0.0)
        renderer = vtkRenderer()
        renderer.AddVolume(volume)
        window = vtkRenderWindow()
        window.SetSize(60, 50)
        window.AddRenderer(renderer)
        renderer.ResetCamera()
        # Two frames of each.
        for isovalue, is_found in ((0.0, True), (0.1, True), (0.0, False), (-0.2, False)):
            volume.GetProperty().GetIsoSurfaceValues().SetValue(0, isovalue)
            for is_new in (True, False):
                window.Render()
                self.assertGreater(mapper.GetTraceTime(), 0.0)
                self.assertEqual(mapper.GetGradientTime() > 0.0, is_found and is_new, isovalue)
        mapper, volume = make_volume(make_grid(VTK_TETRA, ball), 0.0)
        mapper.SetNormalModeToInterpolantGradient()
        renderer.RemoveAllViewProps()
        renderer.AddVolume(volume)
        window.Render()
        self.assertGreater(mapper.GetTreeBuildTime(), 0.0)
        self.assertEqual(mapper.GetGradientTime(), 0.0)

    def test_it_hides_and_is_hidden_by_polygons(self):
        """The picture is that of extracted triangles, but for the edges."""
        grid = make_grid(VTK_TETRA, ball)
        pictures = []
        for is_traced in (True, False):
            renderer = vtkRenderer()
            if is_traced:
                _, volume = make_volume(grid, 0.0)
                renderer.AddVolume(volume)
            else:
                contour = vtkContourFilter()
                contour.SetInputData(grid)
                contour.SetValue(0, 0.0)
                polygons = vtkPolyDataMapper()
                polygons.SetInputConnection(contour.GetOutputPort())
                polygons.ScalarVisibilityOff()
                actor = vtkActor()
                actor.SetMapper(polygons)
                renderer.AddActor(actor)
            window = vtkRenderWindow()
            window.SetMultiSamples(0)
            window.SetSize(200, 200)
            window.AddRenderer(renderer)
            renderer.ResetCamera(grid.GetBounds())
            window.Render()
            depths = vtkWindowToImageFilter()
            depths.SetInput(window)
            depths.SetInputBufferTypeToZBuffer()
            depths.ReadFrontBufferOff()
            depths.Update()
            pictures.append(list(memoryview(depths.GetOutput().GetPointData().GetScalars()).cast("B").cast("f")))
        self.assertGreater(sum(depth < 1.0 for depth in pictures[0]), 5000)
        different = sum(abs(a - b) > 1e-3 for a, b in zip(*pictures))
        self.assertLess(different, 60)

    def test_what_is_kept(self):
        grid = make_grid(VTK_TETRA, ball)
        mapper, volume = make_volume(grid, 0.0)
        first = len(cast(mapper, volume, parallel_rays()))
        self.assertGreater(mapper.GetTreeMemory(), 0)
        self.assertGreater(mapper.GetSurfaceMemory(), 0)
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 1.0)
        volume.GetProperty().GetScalarOpacity().AddPoint(1.0, 1.0)
        self.assertLess(len(cast(mapper, volume, parallel_rays())), first)
        set_values(grid, lambda point: ball(point) + 1.0)
        self.assertEqual(len(cast(mapper, volume, parallel_rays())), first)

    def test_what_changes_in_place_is_seen(self):
        for grid in (make_grid(VTK_TETRA, ball), make_structured_grid(ball)):
            mapper, volume = make_volume(grid, 0.0)
            points, scalars = grid.GetPoints(), grid.GetPointData().GetScalars()

            def raise_values(scalars=scalars):
                for i in range(scalars.GetNumberOfTuples()):
                    scalars.SetTuple1(i, scalars.GetTuple1(i) + 0.6)

            def move_points(points=points):
                for i in range(points.GetNumberOfPoints()):
                    points.SetPoint(i, [1.3 * p for p in points.GetPoint(i)])

            for change, changed in ((raise_values, scalars), (move_points, points), (raise_values, grid)):
                cast(mapper, volume, parallel_rays())
                change()
                changed.Modified()
                after = cast(mapper, volume, parallel_rays())
                self.assertGreater(len(after), 20)
                self.assertEqual(after, cast(*make_volume(grid, 0.0), parallel_rays()))

    def test_threads_change_nothing(self):
        mapper, volume = make_volume(make_grid(VTK_PYRAMID, ball), 0.0)
        results = []
        for threads in (1, 3):
            mapper.SetNumberOfThreads(threads)
            results.append(cast(mapper, volume, parallel_rays()))
        self.assertEqual(*results)

    def test_errors(self):
        no_scalars = make_grid(VTK_TETRA, ball)
        no_scalars.GetPointData().Initialize()
        only_triangles = make_grid(VTK_TRIANGLE, ball)
        bad_id = make_grid(VTK_TETRA, ball)
        bad_id.GetCells().GetConnectivityArray().SetTuple1(17, 10**6)
        too_few = make_grid(VTK_TETRA, ball)
        too_few.GetPointData().GetScalars().SetNumberOfTuples(5)
        cases = [(None, "no input"), (no_scalars, "no scalars"), (only_triangles, "no cells of three"),
                 (bad_id, "Cell 4 has"), (too_few, "5 tuples")]  # fmt: skip
        for grid, text in cases:
            with self.subTest(text):
                mapper, volume = make_volume(grid, 0.0)
                messages = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays()))
                self.assertEqual(len(messages), 1, messages)
                self.assertIn(text, messages[0])
                again = errors_of(mapper, lambda: cast(mapper, volume, parallel_rays()))
                self.assertEqual(again, [])


if __name__ == "__main__":
    unittest.main()
