#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The picture of many processes is that of one. Run by mpirun; process 0 has the whole data, too, for comparison."""

import math
import os
import unittest

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkRectilinearGrid
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCamera,
    vtkLight,
    vtkLightCollection,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolumeCollection,
)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the window
from vtkIsosurfaceRayTracing import (
    vtkIsosurfacePicture,
    vtkIsosurfaceRayTraceMapper,
    vtkIsosurfaceRayTraceMeshMapper,
    vtkIsosurfaceVolume,
)
from vtkIsosurfaceRayTracing.vtkIsosurfaceRayTracingParallel import vtkIsosurfaceRayTraceCompositor

from PictureTesting import capture
from Pieces import (
    CELLS,
    PicturesOfMany,
    RANK,
    SIZE,
    WORLD,
    as_mesh,
    make_camera,
    make_piece,
    make_plane,
    make_volume,
    on_first,
    pixels_of,
    render,
    split,
    whole_picture,
    with_cell_scalars,
    with_few_values,
)


CUT = CELLS[0][0] + (CELLS[0][1] - CELLS[0][0]) * (SIZE // 2) // SIZE  # the index of the first plane where pieces meet


def on_odd_lattice(piece):
    """Where positions and indices are rounded."""
    piece.SetOrigin(0.77, -0.3, 0.2)
    piece.SetSpacing(0.37, 0.9, 1.1)
    return piece


def as_rectilinear(piece):
    grid, on_lattice = vtkRectilinearGrid(), on_odd_lattice(piece)
    grid.SetExtent(piece.GetExtent())
    for axis, put in enumerate((grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)):
        first, last = piece.GetExtent()[2 * axis:2 * axis + 2]
        indices = numpy.arange(first, last + 1)
        planes = on_lattice.GetOrigin()[axis] + on_lattice.GetSpacing()[axis] * (indices + 0.3 * numpy.sin(3.0 * (indices - CUT)))
        put(numpy_to_vtk(planes, deep=True))
    grid.GetPointData().ShallowCopy(piece.GetPointData())
    grid.GetCellData().ShallowCopy(piece.GetCellData())
    return grid


def make_camera_in_cut():
    """Its middle column of rays runs along the first plane where pieces meet."""
    camera, x = vtkCamera(), 0.77 + 0.37 * CUT
    camera.SetPosition(x, 60.0, 9.0)
    camera.SetFocalPoint(x, 0.0, 0.5)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetClippingRange(20.0, 160.0)
    return camera


MESHES = {"convert": as_mesh, "mapper_class": vtkIsosurfaceRayTraceMeshMapper}
EXACT = [("SetNormalMode", vtkIsosurfaceRayTraceMapper.INTERPOLANT_GRADIENT)]
THREE = {"isovalues": (120.0, 157.0, 200.0)}
SCENES = {
    "central differences": {},
    "exact normals, no ghosts": {"ghosts": 0, "settings": EXACT},
    "cubic": {"ghosts": 2, "settings": [("SetInterpolationMode", vtkIsosurfaceRayTraceMapper.CUBIC)]},
    "nearest": {"settings": [("SetInterpolationMode", vtkIsosurfaceRayTraceMapper.NEAREST)]},
    "translucent": {**THREE, "opacities": (0.3, 0.4, 0.5)},
    "opaque within translucent": {**THREE, "opacities": (0.3, 0.4, 1.0)},
    "cells": {"ghosts": 2, "convert": with_cell_scalars},
    "caps": {"settings": [("AddClippingPlane", make_plane()), ("SetCapClippingPlanes", True)]},
    "parallel projection": {"camera": make_camera(True), "size": (131, 97)},
    "rays in the plane where pieces meet": {"convert": on_odd_lattice, "camera": make_camera_in_cut(), "size": (61, 60)},
    "translucent rays there": {"convert": on_odd_lattice, "camera": make_camera_in_cut(), "size": (61, 60), **THREE,
                               "opacities": (0.3, 0.4, 0.5)},
    "rectilinear rays there": {"convert": as_rectilinear, "camera": make_camera_in_cut(), "size": (61, 60)},
    "mesh": {**MESHES},
    "translucent mesh": {**MESHES, **THREE, "opacities": (0.3, 0.4, 1.0)},
}


MAXIMUM, MINIMUM = ("SetBlendModeToMaximumIntensity",), ("SetBlendModeToMinimumIntensity",)
PROJECTIONS = {
    "maximum": {"settings": [MAXIMUM]},
    "minimum": {"settings": [MINIMUM]},
    "maximum of cells": {"ghosts": 1, "convert": with_cell_scalars, "settings": [MAXIMUM]},
    "minimum behind a plane": {"settings": [MINIMUM, ("AddClippingPlane", make_plane())]},
    "maximum with equal values": {"convert": with_few_values, "settings": [MAXIMUM]},
}


def make_own(ghosts=1, convert=lambda piece: piece):
    return convert(make_piece(split(CELLS, SIZE)[RANK], ghosts))


def make_window(size):
    """A window with a sphere, and its renderer."""
    source = vtkSphereSource()
    source.SetRadius(11.0)
    source.SetThetaResolution(32)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    sphere = vtkActor()
    sphere.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(sphere)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(size)
    window.AddRenderer(renderer)
    return window, renderer


def as_collection(volumes):
    collection = vtkVolumeCollection()
    for volume in volumes:
        collection.AddItem(volume)
    return collection


class TestCompositor(PicturesOfMany):
    def test_picture_of_many_is_that_of_one(self):
        for name, scene in SCENES.items():
            with self.subTest(name):
                scene = dict(scene)
                camera, size = scene.pop("camera", make_camera()), scene.pop("size", (160, 120))
                ghosts, convert = scene.pop("ghosts", 1), scene.pop("convert", lambda piece: piece)
                is_rendered, picture = render(make_volume(make_own(ghosts, convert), **scene), camera, size)
                self.assertTrue(is_rendered)
                if RANK > 0:
                    self.assertEqual(picture.GetNumberOfPoints(), 0)
                whole = make_volume(convert(make_piece(CELLS, 0)), **scene) if RANK == 0 else None
                self.check_against_whole(picture, whole, camera, size, name=name)

    def test_projections(self):
        """The largest or the smallest value of all pieces; many of them have no opacity."""
        opacities = {"isovalues": (90.0, 120.0, 157.0, 250.0, 260.0), "opacities": (0.0, 0.6, 0.4, 1.0, 0.0)}
        for name, scene in PROJECTIONS.items():
            with self.subTest(name):
                scene = {**opacities, **scene}
                ghosts, convert = scene.pop("ghosts", 0), scene.pop("convert", lambda piece: piece)
                is_rendered, picture = render(make_volume(make_own(ghosts, convert), **scene), make_camera(), (160, 120))
                self.assertTrue(is_rendered)
                whole = make_volume(convert(make_piece(CELLS, 0)), **scene) if RANK == 0 else None
                self.assertIsNone(on_first(lambda: self.compare_projections(name, picture, whole)))

    def compare_projections(self, name, picture, volume):
        expected = vtkImageData()
        assert volume.GetMapper().RenderToImage(volume, make_camera(), None, 160, 120, expected)
        pixels = sum(a != b for a, b in zip(pixels_of(picture), pixels_of(expected)))
        colors = sum(a[0] != b[0] for a, b in zip(pixels_of(picture), pixels_of(expected)))
        found, whole = (vtk_to_numpy(each.GetPointData().GetArray("Value")) for each in (picture, expected))
        same_rays = (numpy.isnan(found) == numpy.isnan(whole)).all()
        error = numpy.nanmax(abs(found / whole - 1.0))
        answer = f"{name}, {SIZE} processes: {colors} colours and {pixels} pixels differ, values by {error:.1e} at most"
        print(answer)
        # Index coordinates are those of the piece, which changes the last bits of values. So of points whose values
        # are equal but for these another one may be taken, which has another depth.
        is_fine = colors == 0 and pixels <= (30 if "equal" in name else 0) and same_rays and error < 1e-13
        return None if is_fine else answer

    def test_lights_and_matrix(self):
        lights, light = vtkLightCollection(), vtkLight()
        light.SetPositional(True)
        light.SetPosition(30.0, 20.0, 60.0)
        light.SetFocalPoint(0.0, 0.0, 0.0)
        light.SetConeAngle(40.0)
        light.SetDiffuseColor(1.0, 0.8, 0.7)
        lights.AddItem(light)
        volumes = [make_volume(make_own()), make_volume(make_piece(CELLS, 0))]
        for volume in volumes:
            volume.SetScale(1.0, 1.2, 0.8)
            volume.RotateX(25.0)
        _, picture = render(volumes[0], make_camera(), (160, 120), lights)
        self.check_against_whole(picture, volumes[1], lights=lights)

    def test_rows_of_each_process(self):
        compositor = vtkIsosurfaceRayTraceCompositor()
        compositor.GatherOff()
        size = (160, 121)
        _, rows = render(make_volume(make_own()), make_camera(), size, compositor=compositor)
        extent = rows.GetExtent()
        own = (extent[2], extent[3] + 1, pixels_of(rows)) if rows.GetNumberOfPoints() > 0 else (0, 0, [])
        parts = sorted(part for part in WORLD.allgather(own) if part[1] > part[0])
        self.assertEqual([part[0] for part in parts[1:]], [part[1] for part in parts[:-1]])
        self.assertEqual((parts[0][0], parts[-1][1]), (0, size[1]))
        self.assertGreaterEqual(2 * len(parts), SIZE)
        expected = whole_picture(make_volume(make_piece(CELLS, 0)), make_camera(), size)
        self.assertEqual([pixel for part in parts for pixel in part[2]], expected)

    def test_processes_without_data(self):
        """Of two processes, one has all; the other has no input, or an empty one."""
        for nothing in (None, vtkImageData()):
            own = make_piece(CELLS, 0) if RANK == SIZE - 1 else nothing
            _, picture = render(make_volume(own), make_camera(), (160, 120))
            self.check_against_whole(picture, make_volume(make_piece(CELLS, 0)))

    def test_nobody_has_a_surface(self):
        is_rendered, picture = render(make_volume(make_own(), isovalues=(1e6,)), make_camera(), (40, 30))
        self.assertTrue(is_rendered)
        if RANK == 0:
            self.assertEqual(set(pixels_of(picture)), {((0.0, 0.0, 0.0, 0.0), 1.0)})

    def test_overlapping_pieces(self):
        """Opaque surfaces that several processes have are those of one."""
        own = split(CELLS, SIZE)[RANK]
        larger = tuple((max(a - 3, low), min(b + 3, high)) for (a, b), (low, high) in zip(own, CELLS))
        _, picture = render(make_volume(make_piece(larger, 1)), make_camera(), (160, 120))
        self.check_against_whole(picture, make_volume(make_piece(CELLS, 0)))

    def test_piece_of_another_lattice(self):
        """Each process has an image of its own, which crosses those of others."""

        def moved(process):
            image = make_piece(CELLS, 0)
            image.SetOrigin(0.3 * process, -0.7 * process, 0.9 * process)
            image.SetSpacing(1.0 - 0.01 * process, 1.0, 1.0)
            return image

        opacities = {**THREE, "opacities": (0.3, 0.4, 0.5)}
        _, picture = render(make_volume(moved(RANK), **opacities), make_camera(), (160, 120))
        volume = make_volume(moved(0), **opacities)
        for process in range(1, SIZE):
            volume.GetMapper().AddInputDataObject(moved(process))
        self.check_against_whole(picture, volume)

    def test_connections_without_data(self):
        """Each of two connections has data in some processes alone."""

        def moved(has_data):
            image = make_piece(CELLS, 0) if has_data else vtkImageData()
            if has_data:
                image.SetOrigin(4.3, -2.7, 1.9)
            return image

        for opacities in ((1.0, 1.0, 1.0), (0.3, 0.4, 0.5)):
            scene = {**THREE, "opacities": opacities, "settings": EXACT}
            boxes = split(CELLS, max(SIZE - 1, 1))
            is_last = RANK == SIZE - 1
            own = make_volume(make_piece(boxes[RANK], 0) if RANK < len(boxes) else vtkImageData(), **scene)
            own.GetMapper().AddInputDataObject(moved(is_last))
            is_rendered, picture = render(own, make_camera(), (160, 120))
            self.assertTrue(is_rendered)
            whole = make_volume(make_piece(CELLS, 0), **scene)
            whole.GetMapper().AddInputDataObject(moved(True))
            self.check_against_whole(picture, whole)

    def test_several_volumes(self):
        """Surfaces of an image and of a mesh in each other, each with its matrix and its colours."""
        box = ((-9, 8), (-10, 11), (-12, 9))

        def make_volumes(image, mesh, opacities):
            of_image = {"isovalues": (120.0, 200.0), "opacities": opacities[0]}
            of_mesh = {"isovalues": (150.0, 190.0), "opacities": opacities[1]}
            settings = [*EXACT, ("AddClippingPlane", make_plane()), ("SetCapClippingPlanes", True)]
            volumes = [
                make_volume(image, settings=settings, **of_image),
                make_volume(mesh, mapper_class=vtkIsosurfaceRayTraceMeshMapper, settings=settings, **of_mesh),
            ]
            volumes[1].SetPosition(7.0, 2.0, -3.0)
            volumes[1].RotateZ(30.0)
            volumes[1].GetProperty().GetRGBTransferFunction().AddRGBPoint(150.0, 0.1, 0.9, 0.3)
            return volumes

        pieces = make_piece(split(CELLS, SIZE)[RANK], 0), as_mesh(make_piece(split(box, SIZE)[RANK], 0, box))
        for opacities in (((0.4, 0.5), (0.3, 0.6)), ((1.0, 1.0), (1.0, 1.0)), ((0.3, 0.4), (1.0, 1.0))):
            is_rendered, picture = render(as_collection(make_volumes(*pieces, opacities)), make_camera(), (160, 120))
            self.assertTrue(is_rendered)
            # Of one process: a mapper with two connections, whose hits it orders itself.
            wholes = make_volumes(make_piece(CELLS, 0), as_mesh(make_piece(box, 0, box)), opacities)
            mapper = wholes[0].GetMapper()
            mapper.AddInputDataObject(wholes[1].GetMapper().GetInputDataObject(0, 0))
            mapper.SetConnectionVolume(1, wholes[1])
            # Pieces of meshes have other centres than the whole.
            self.check_against_whole(picture, wholes[0], depth_tolerance=1e-6)

    def test_data_that_come_and_go(self):
        """A connection without data changes nothing; it has them in the next picture, and none in the one after it."""
        settings = [*EXACT, ("ShadowsOn",), ("AmbientOcclusionOn",)]

        def draw(*others):
            volume.GetMapper().SetInputDataObject(make_own(0))
            for other in others:
                volume.GetMapper().AddInputDataObject(other)
            is_rendered, picture = render(volume, make_camera(), (160, 120))
            self.assertTrue(is_rendered)
            return pixels_of(picture)

        volume = make_volume(None, settings=settings)
        expected = draw()
        moved = make_piece(split(CELLS, SIZE)[RANK], 0)
        moved.SetOrigin(5.0, 5.0, 5.0)
        self.assertEqual(draw(vtkImageData()), expected)
        with_other = draw(moved)
        self.assertNotEqual(with_other, expected) if RANK == 0 else self.assertEqual(with_other, [])
        self.assertEqual(draw(vtkImageData()), expected)

    def test_camera_of_process_0(self):
        camera = make_camera(True) if RANK == 0 else vtkCamera()
        if RANK == 0:
            camera.SetWindowCenter(0.1, -0.2)
            camera.Azimuth(30.0)
            camera.Elevation(20.0)
        vtkIsosurfaceRayTraceCompositor().BroadcastCamera(camera)
        matrices = WORLD.allgather([
            camera.GetCompositeProjectionTransformMatrix(1.5, -1.0, 1.0).GetElement(i, k)
            for i in range(4) for k in range(4)])
        self.assertTrue(all(matrix == matrices[0] for matrix in matrices))

    @unittest.skipUnless(os.environ.get("DISPLAY"), "there is no display")
    def test_window_of_process_0(self):
        """The surfaces of all, through which a sphere of process 0 passes."""
        size, window, camera = (160, 120), None, vtkCamera()
        if RANK == 0:
            window, renderer = make_window(size)
            camera = renderer.GetActiveCamera()
            camera.DeepCopy(make_camera())
        vtkIsosurfaceRayTraceCompositor().BroadcastCamera(camera)
        _, image = render(make_volume(make_own()), camera, size)

        def compare():
            volume = vtkIsosurfaceVolume()
            whole = make_volume(make_piece(CELLS, 0))
            volume.SetMapper(whole.GetMapper())
            volume.SetProperty(whole.GetProperty())
            picture = vtkIsosurfacePicture()
            picture.SetPicture(image)
            captured = []
            for prop in (volume, picture):
                renderer.AddViewProp(prop)
                window.Render()
                captured.append(capture(window))
                renderer.RemoveViewProp(prop)
            window.Render()
            return captured[0] == captured[1] != capture(window)

        self.assertTrue(on_first(compare))

    def test_times_and_bytes(self):
        compositor = vtkIsosurfaceRayTraceCompositor()
        render(make_volume(make_own()), make_camera(), (160, 120), compositor=compositor)
        self.assertGreater(compositor.GetRenderTime(), 0.0)
        self.assertGreater(compositor.GetCompositeTime(), 0.0)
        sent = sum(WORLD.allgather(compositor.GetBytesSent()))
        self.assertGreater(sent, 0) if SIZE > 1 else self.assertEqual(sent, 0)

    def test_process_that_cannot_render(self):
        last = SIZE - 1
        piece = make_own()
        if RANK == last:
            piece.GetPointData().Initialize()
        self.check_failure(make_volume(piece), "scalars", last)

    def test_bad_arguments_of_a_process(self):
        last = SIZE - 1
        size = (0, 30) if RANK == last else (40, 30)
        self.check_failure(make_volume(make_own()), "size of at least 1 x 1", last, size=size)
        volume = make_volume(make_own())
        if RANK == last:
            volume.GetMapper().SetBlendModeToComposite()
        self.check_failure(volume, "ISOSURFACE_BLEND, MAXIMUM_INTENSITY_BLEND or", last)
        volume = make_volume(make_own(), settings=[("SetBlendModeToMaximumIntensity",)])
        if RANK == last:
            volume.GetMapper().AddInputDataObject(make_own())
        self.check_failure(volume, "Projections of several connections", last)
        volumes = as_collection([make_volume(make_own()), make_volume(make_own())])
        if RANK == last:
            volumes.GetItemAsObject(1).GetMapper().SetBlendModeToMaximumIntensity()
        self.check_failure(volumes, "Several volumes are composited as isosurfaces alone", last)
        volumes = as_collection([] if RANK == last else [make_volume(make_own())])
        self.check_failure(volumes, "RenderToImage needs a volume", last)

    @unittest.skipIf(SIZE == 1, "one process agrees with itself")
    def test_different_settings(self):
        last = SIZE - 1

        def check(pattern, change=lambda volume: None, **arguments):
            volume = make_volume(make_own())
            if RANK == last:
                change(volume)
            self.check_failure(volume, f"{pattern} of process {last} differ from those of process 0", last, **arguments)

        check("isovalues", lambda volume: volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 158.0))
        check("transfer functions", lambda volume: volume.GetProperty().GetScalarOpacity().AddPoint(157.0, 0.5))
        colors = lambda volume: volume.GetProperty().GetRGBTransferFunction()  # noqa: E731
        check("transfer functions", lambda volume: colors(volume).SetColorSpaceToLab())
        check("transfer functions", lambda volume: colors(volume).SetNodeValue(0, (60.0, 0.2, 0.3, 0.9, 0.4, 0.0)))
        check("transfer functions", lambda volume: volume.GetProperty().GetScalarOpacity().SetNodeValue(
            0, (157.0, 1.0, 0.4, 0.0)))  # fmt: skip
        check("materials", lambda volume: volume.GetProperty().SetSpecular(0.7))
        check("settings of the mappers", lambda volume: volume.GetMapper().CroppingOn())
        check("settings of the mappers", lambda volume: volume.GetMapper().ShadowsOn())
        check("settings of the mappers", lambda volume: volume.GetMapper().SetBlendModeToMaximumIntensity())
        check("clipping planes", lambda volume: volume.GetMapper().AddClippingPlane(make_plane()))
        check("matrices of the volumes", lambda volume: volume.SetPosition(1.0, 0.0, 0.0))
        check("sizes", size=(41, 30) if RANK == last else (40, 30))
        check("cameras", camera=make_camera(RANK == last))

        volumes = as_collection([make_volume(make_own()) for _ in range(3 if RANK == last else 2)])
        text = f"numbers of volumes of process {last} differ from those of process 0"
        self.check_failure(volumes, text, last)
        volumes = as_collection([make_volume(make_own()) for _ in range(2)])
        if RANK == last:
            volumes.GetItemAsObject(1).GetProperty().SetSpecular(0.7)
        self.check_failure(volumes, f"materials of process {last} differ from those of process 0", last)

    def test_settings_that_are_not_numbers_are_the_same(self):
        """Such isovalues have no surface, in many processes as in one."""
        volume = make_volume(make_own(), isovalues=(157.0, math.nan), opacities=(1.0, 1.0))
        is_rendered, picture = render(volume, make_camera(), (40, 30))
        self.assertTrue(is_rendered)
        whole = make_volume(make_piece(CELLS, 0)) if RANK == 0 else None
        self.check_against_whole(picture, whole, make_camera(), (40, 30), name="NaN among isovalues")


if __name__ == "__main__":
    unittest.main()
