#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Clouds whose cells lie in many processes: the picture of one process with all cells, bit for bit, however the cells
are dealt out. Run by mpirun."""

import unittest

import numpy as np

from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPiecewiseFunction, vtkPlane, vtkUnstructuredGrid
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction
from vtkIsosurfaceRayTracing import vtkCellProjectionMapper, vtkIsosurfaceRayTraceMeshMapper
from vtkIsosurfaceRayTracing.vtkIsosurfaceRayTracingParallel import vtkIsosurfaceRayTraceCompositor

from Pieces import (
    CELLS,
    Errors,
    PicturesOfMany,
    RANK,
    SIZE,
    WORLD,
    as_mesh,
    make_camera,
    make_piece,
    make_volume,
    pixels_of,
    render,
    split,
    whole_picture,
)

PICTURE = (213, 187)


def make_mesh(tetrahedra):
    mesh = as_mesh(make_piece(CELLS, 0))
    mesh.GetCellData().Initialize()
    if tetrahedra:
        cut = vtkDataSetTriangleFilter()
        cut.SetInputData(mesh)
        cut.Update()
        mesh = cut.GetOutput()
    return mesh


def extract(mesh, cells):
    """Some cells of a mesh whose cells have one shape."""
    shape, corners = mesh.GetCellType(0), mesh.GetCell(0).GetNumberOfPoints()
    ids = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, corners)[cells]
    array = vtkCellArray()
    array.SetData(corners, numpy_to_vtkIdTypeArray(ids.ravel(), deep=True))
    extracted = vtkUnstructuredGrid()
    extracted.ShallowCopy(mesh)
    extracted.SetCells(shape, array)
    return extracted


def round_robin(mesh):
    return extract(mesh, slice(RANK, None, SIZE))


def in_order(mesh):
    count = mesh.GetNumberOfCells()
    return extract(mesh, slice(count * RANK // SIZE, count * (RANK + 1) // SIZE))


def with_some_empty(mesh):
    """The odd processes have nothing."""
    with_data = (SIZE + 1) // 2
    return None if RANK % 2 else extract(mesh, slice(RANK // 2, None, with_data))


def in_runs(mesh):
    """Of some cells that follow each other; the odd processes have the points alone."""
    with_data = (SIZE + 1) // 2
    runs = np.arange(mesh.GetNumberOfCells()) // 64
    return extract(mesh, runs % with_data == RANK // 2 if RANK % 2 == 0 else runs < 0)


def to_the_last(mesh):
    return mesh if RANK == SIZE - 1 else None


def make_cloud(data, surfaces=False, unit=8.0, maximum=False, plane=False, threads=1, shade=False, smooth=False, opaque=False,
               many=False):
    """With two isosurfaces, of which one may be opaque, or with many that together hide what is behind them."""
    settings = [("SetNumberOfThreads", threads), ("SetDrawIsosurfaces", surfaces)]
    if not smooth:
        settings.append(("SetNormalMode", vtkCellProjectionMapper.INTERPOLANT_GRADIENT))  # without ghosts
    if maximum:
        settings.append(("SetBlendModeToMaximumIntensity",))
    volume = make_volume(data, mapper_class=vtkCellProjectionMapper, settings=settings)
    volume.GetProperty().SetShade(shade)
    volume.GetProperty().GetScalarOpacity().RemoveAllPoints()
    for value, opacity in ((60.0, 0.0), (120.0, 0.1), (150.0, 0.6), (200.0, 0.2), (260.0, 0.9)):
        volume.GetProperty().GetScalarOpacity().AddPoint(value, opacity)
    if opaque:
        volume.GetProperty().GetScalarOpacity().AddPoint(157.0, 1.0)
    volume.GetProperty().SetScalarOpacityUnitDistance(unit)
    for i, isovalue in enumerate(range(150, 200, 2) if many else (157.0, 230.0)):
        volume.GetProperty().GetIsoSurfaceValues().SetValue(i, isovalue)
    if plane:
        clipping = vtkPlane()
        clipping.SetOrigin(2.0, 1.0, 3.0)
        clipping.SetNormal(-0.5, -0.6, 0.2)
        volume.GetMapper().AddClippingPlane(clipping)
    return volume


def with_components(mesh, dtype=np.float64):
    """The mesh with four components from 0 to 1, or of unsigned char from 0 to 255."""
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    waves = [0.5 + 0.5 * np.sin(points @ direction) for direction in np.eye(4, 3) * 0.7 + 0.1]
    largest = 255 if dtype == np.uint8 else 1
    array = numpy_to_vtk((largest * np.stack(waves, axis=1)).astype(dtype), deep=True)
    array.SetName("components")
    copy = vtkUnstructuredGrid()
    copy.ShallowCopy(mesh)
    copy.GetPointData().SetScalars(array)
    return copy


def make_mixture(data, are_independent=True, **settings):
    volume = make_cloud(data, **settings)
    volume.GetProperty().SetIndependentComponents(are_independent)
    volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 0.4)
    for i, hue in enumerate(((1.0, 0.2, 0.1), (0.1, 1.0, 0.2), (0.1, 0.3, 1.0), (1.0, 1.0, 0.1))):
        colors, opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
        colors.AddRGBPoint(0.3 + 0.1 * i, *hue)
        colors.AddRGBPoint(1.0, 1.0, 1.0, 1.0)
        opacities.AddPoint(0.4, 0.0)
        opacities.AddPoint(0.8, 0.5)
        volume.GetProperty().SetColor(i, colors)
        volume.GetProperty().SetScalarOpacity(i, opacities)
        volume.GetProperty().SetScalarOpacityUnitDistance(i, 8.0)
        volume.GetProperty().SetShade(i, volume.GetProperty().GetShade())
    return volume


class TestClouds(PicturesOfMany):
    @classmethod
    def setUpClass(cls):
        cls.cells, cls.tetrahedra = make_mesh(False), make_mesh(True)

    def check(self, mesh, deal, compositor=None, is_parallel=False, **settings):
        camera = make_camera(is_parallel)
        own = make_cloud(deal(mesh), **settings)
        is_rendered, picture = render(own, camera, PICTURE, compositor=compositor)
        self.assertTrue(is_rendered)
        whole = make_cloud(mesh, **settings)
        self.check_against_whole(picture, whole, camera, PICTURE, name=f"{deal.__name__} {settings}")

    def test_cells_dealt_out_in_any_way(self):
        for mesh in (self.cells, self.tetrahedra):
            for deal in (round_robin, in_order, in_runs, with_some_empty, to_the_last):
                with self.subTest(deal.__name__):
                    self.check(mesh, deal)

    def test_settings(self):
        for settings in (
            {"is_parallel": True},
            {"maximum": True},
            {"maximum": True, "surfaces": True, "opaque": True},
            {"surfaces": True},
            {"surfaces": True, "many": True, "unit": 100.0},
            {"shade": True},
            {"shade": True, "surfaces": True, "plane": True, "threads": 2},
            {"threads": 3},
            {"plane": True},
            {"unit": 0.01},  # so dense that little is seen
            {"unit": 0.01, "surfaces": True, "threads": 2},
        ):
            for deal in (round_robin, in_order):
                with self.subTest(settings):
                    self.check(self.tetrahedra, deal, **settings)

    def test_smooth_shading(self):
        """By the gradients at points, which a layer of ghosts makes those of the whole."""
        own = as_mesh(make_piece(split(CELLS, SIZE)[RANK], 1))
        for surfaces in (False, True):
            is_rendered, picture = render(make_cloud(own, surfaces, shade=True, smooth=True), make_camera(), PICTURE)
            self.assertTrue(is_rendered)
            whole = make_cloud(self.cells, surfaces, shade=True, smooth=True)
            self.check_against_whole(picture, whole, make_camera(), PICTURE, name=f"smooth shading, surfaces {surfaces}")

    def test_components(self):
        camera = make_camera()
        for are_independent, dtype, surfaces in (
            (True, np.float64, False), (True, np.float32, True), (False, np.uint8, False)
        ):
            mesh = with_components(self.tetrahedra, dtype)
            for deal in (round_robin, with_some_empty):
                with self.subTest(f"{are_independent} {dtype}"):
                    shade = deal == round_robin
                    is_rendered, picture = render(
                        make_mixture(deal(mesh), are_independent, surfaces=surfaces, shade=shade), camera, PICTURE)
                    self.assertTrue(is_rendered)
                    whole = make_mixture(mesh, are_independent, surfaces=surfaces, shade=shade)
                    self.check_against_whole(
                        picture, whole, camera, PICTURE, name=f"components {are_independent} {surfaces}")

    def test_components_of_connections_without_data(self):
        """Processes that have nothing of a connection draw what the others find of it."""
        for are_independent, dtype in ((True, np.float64), (False, np.uint8)):
            mesh = with_components(self.cells, dtype)
            own = make_mixture(mesh if RANK == 0 else vtkUnstructuredGrid(), are_independent)
            other = vtkUnstructuredGrid()
            other.DeepCopy(mesh)
            for i in range(other.GetNumberOfPoints()):
                x, y, z = other.GetPoint(i)
                other.GetPoints().SetPoint(i, x + 6.3, y - 3.1, 1.1 * z)
            own.GetMapper().AddInputDataObject(other if RANK == SIZE - 1 else vtkUnstructuredGrid())
            is_rendered, picture = render(own, make_camera(), PICTURE)
            self.assertTrue(is_rendered)
            whole = make_mixture(mesh, are_independent)
            whole.GetMapper().AddInputDataObject(other)
            self.check_against_whole(
                picture, whole, make_camera(), PICTURE, name=f"components of connections {are_independent}")

    @unittest.skipIf(SIZE == 1, "one process agrees with itself")
    def test_different_components(self):
        is_last = RANK == SIZE - 1
        mesh = round_robin(with_components(self.tetrahedra) if is_last else self.tetrahedra)
        volume = make_mixture(mesh)
        errors = Errors(volume.GetMapper())
        self.assertFalse(render(volume, make_camera(), (40, 30))[0])
        self.assertRegex(errors.texts[0], "different numbers of components")
        volume = make_mixture(round_robin(with_components(self.tetrahedra)))
        if is_last:
            volume.GetProperty().SetScalarOpacityUnitDistance(3, 1.0)
        self.check_failure(
            volume, f"clouds of process {SIZE - 1} differ from those of process 0", SIZE - 1)
        volume = make_mixture(round_robin(with_components(self.tetrahedra)))
        if is_last:
            volume.GetProperty().SetShade(2, 1)
        self.check_failure(
            volume, f"clouds of process {SIZE - 1} differ from those of process 0", SIZE - 1)

    def test_counts(self):
        compositor = vtkIsosurfaceRayTraceCompositor()
        compositor.SetBufferDepth(100)
        compositor.SetPollingInterval(7)
        self.check(self.tetrahedra, round_robin, compositor)
        found, drawn = compositor.GetSegmentsFound(), compositor.GetSegmentsDrawn()
        all_found, all_drawn = WORLD.allreduce(found), WORLD.allreduce(drawn)
        self.assertEqual(all_found, all_drawn)
        if SIZE == 1:
            self.assertEqual(found, 0)
            return
        self.assertGreater(all_found, 500000)
        self.assertLess(abs(found * SIZE / all_found - 1.0), 0.3)
        self.assertLess(abs(drawn * SIZE / all_drawn - 1.0), 0.5)
        self.assertGreater(compositor.GetMostSegmentsStored(), 0)
        self.assertLess(compositor.GetMostSegmentsStored(), drawn)
        self.assertGreater(compositor.GetBytesSent(), 30 * (found - drawn / SIZE) // 2)

    def test_dense_clouds_send_less(self):
        sent = []
        for unit in (8.0, 0.001):
            compositor = vtkIsosurfaceRayTraceCompositor()
            render(make_cloud(in_order(self.tetrahedra), unit=unit), make_camera(), (40, 30), compositor=compositor)
            sent.append(WORLD.allreduce(compositor.GetSegmentsFound()))
        self.assertLessEqual(sent[1], sent[0])

    def test_rows_of_each_process(self):
        compositor = vtkIsosurfaceRayTraceCompositor()
        compositor.GatherOff()
        own = make_cloud(round_robin(self.tetrahedra))
        is_rendered, rows = render(own, make_camera(), PICTURE, compositor=compositor)
        self.assertTrue(is_rendered)
        first = rows.GetExtent()[2]
        parts = sorted(WORLD.allgather((first, pixels_of(rows)) if rows.GetNumberOfPoints() > 0 else (0, [])))
        expected = whole_picture(make_cloud(self.tetrahedra), make_camera(), PICTURE)
        self.assertEqual([pixel for part in parts for pixel in part[1]], expected)

    def test_connections_without_data(self):
        """Each of two connections has data in some processes alone."""
        other = vtkUnstructuredGrid()
        other.DeepCopy(self.cells)
        for i in range(other.GetNumberOfPoints()):
            x, y, z = other.GetPoint(i)
            other.GetPoints().SetPoint(i, x + 6.3, y - 3.1, 1.1 * z)
        first = SIZE // 2  # the processes from it on have the second mesh, those before it the first
        for surfaces in (False, True):
            own = make_cloud(self.tetrahedra if RANK == 0 else vtkUnstructuredGrid(), surfaces)
            count = other.GetNumberOfCells()
            rank, size = RANK - first, SIZE - first
            part = extract(other, slice(count * rank // size, count * (rank + 1) // size))
            own.GetMapper().AddInputDataObject(part if rank >= 0 else vtkUnstructuredGrid())
            is_rendered, picture = render(own, make_camera(), PICTURE)
            self.assertTrue(is_rendered)
            whole = make_cloud(self.tetrahedra, surfaces)
            whole.GetMapper().AddInputDataObject(other)
            self.check_against_whole(picture, whole, make_camera(), PICTURE, name=f"two connections, surfaces {surfaces}")

    def test_nobody_has_data(self):
        is_rendered, picture = render(make_cloud(None), make_camera(), (40, 30))
        self.assertTrue(is_rendered)
        if RANK == 0:
            self.assertEqual(set(pixels_of(picture)), {((0.0, 0.0, 0.0, 0.0), 1.0)})

    def test_process_that_cannot_render(self):
        last = SIZE - 1
        volume = make_cloud(round_robin(self.tetrahedra))
        volume.GetMapper().SelectScalarArray("missing" if RANK == last else "RTData")
        volume.GetMapper().SetScalarModeToUsePointFieldData()
        self.check_failure(volume, "no array \"missing\" of points with numbers. SelectScalarArray\\(\\) takes one of ", last)

    @unittest.skipIf(SIZE == 1, "one process agrees with itself")
    def test_different_settings(self):
        last = SIZE - 1
        is_last = RANK == last

        def check(pattern, **settings):
            volume = make_cloud(round_robin(self.tetrahedra), **(settings if is_last else {}))
            self.check_failure(volume, f"{pattern} of process {last} differ from those of process 0", last)

        check("clouds", unit=1.0)
        check("clouds", maximum=True)
        check("clouds", surfaces=True)
        volume = make_cloud(round_robin(self.tetrahedra))
        if is_last:
            mapper = vtkIsosurfaceRayTraceMeshMapper()
            mapper.SetInputData(volume.GetMapper().GetInput())
            mapper.SetNormalMode(volume.GetMapper().GetNormalMode())
            volume.SetMapper(mapper)
        self.check_failure(volume, f"clouds of process {last} differ", last)

    @unittest.skipIf(SIZE == 1, "one process agrees with itself")
    def test_different_inputs(self):
        last = SIZE - 1
        volume = make_cloud(round_robin(self.tetrahedra))
        if RANK == last:
            volume.GetMapper().AddInputDataObject(0, round_robin(self.cells))
        compositor = vtkIsosurfaceRayTraceCompositor()
        errors = Errors(compositor, volume.GetMapper())
        self.assertFalse(render(volume, make_camera(), (40, 30), compositor=compositor)[0])
        self.assertRegex(errors.texts[0], "different numbers of inputs")


if __name__ == "__main__":
    unittest.main()
