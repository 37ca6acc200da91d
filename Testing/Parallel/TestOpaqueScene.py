#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Translucent surfaces, caps and clouds of many processes among opaque polygons, which process 0 draws: its window shows
what one mapper with all data draws there. Run by mpirun, with a display for process 0."""

import os
import unittest

from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the window
from vtkIsosurfaceRayTracing import (
    vtkCellProjectionMapper,
    vtkIsosurfacePicture,
    vtkIsosurfaceRayTraceMapper,
    vtkIsosurfaceRayTraceMeshMapper,
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
    split,
)

PICTURE = (213, 187)
EXACT = ("SetNormalMode", vtkIsosurfaceRayTraceMapper.INTERPOLANT_GRADIENT)  # without ghosts
THREE = {"isovalues": (120.0, 157.0, 200.0), "opacities": (0.3, 0.4, 0.5)}
CAPS = [EXACT, ("AddClippingPlane", make_plane()), ("SetCapClippingPlanes", True)]
MESHES = {"convert": as_mesh, "mapper_class": vtkIsosurfaceRayTraceMeshMapper}
CLOUDS = {"convert": as_mesh, "mapper_class": vtkCellProjectionMapper, "opacities": (0.1, 0.2, 0.4)}
SCENES = {
    "opaque": {"settings": [EXACT]},
    "translucent": {**THREE, "settings": [EXACT]},
    "opaque within translucent": {**THREE, "opacities": (0.3, 0.4, 1.0), "settings": [EXACT]},
    "caps": {**THREE, "settings": CAPS},
    "maximum": {**THREE, "settings": [("SetBlendModeToMaximumIntensity",)]},
    "mesh": {**THREE, **MESHES, "settings": [EXACT]},
    "mesh with caps": {**THREE, **MESHES, "settings": CAPS},
    "cloud": {**THREE, **CLOUDS, "settings": [EXACT]},
    "surfaces in a cloud": {**THREE, **CLOUDS, "settings": [EXACT, ("SetDrawIsosurfaces", True)]},
}


def make_scene(box, scene):
    """A volume with the cells of a box; with none, without data."""
    scene = dict(scene)
    convert = scene.pop("convert", lambda piece: piece)
    piece = None
    if box:
        piece = make_piece(box, 0)
        if convert is as_mesh:
            piece.GetCellData().Initialize()
    volume = make_volume(convert(piece) if piece else None, **scene)
    volume.GetProperty().SetScalarOpacityUnitDistance(8.0)
    return volume


class Window:
    """A window with a sphere, in which data are drawn."""

    def __init__(self):
        source = vtkSphereSource()
        source.SetRadius(11.0)
        source.SetThetaResolution(32)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        sphere = vtkActor()
        sphere.SetMapper(mapper)
        self.renderer = vtkRenderer()
        self.renderer.AddActor(sphere)
        self.renderer.GetActiveCamera().DeepCopy(make_camera())
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(PICTURE)
        self.window.AddRenderer(self.renderer)

    def find_depths(self):
        self.window.Render()
        depths = vtkFloatArray()
        self.window.GetZbufferData(0, 0, PICTURE[0] - 1, PICTURE[1] - 1, depths)
        return depths

    def draw(self, prop):
        self.renderer.AddViewProp(prop)
        self.window.Render()
        self.renderer.RemoveViewProp(prop)
        pixels = capture(self.window)
        return [pixels[i : i + 3] for i in range(0, len(pixels), 3)]

    def draw_picture(self, image):
        picture = vtkIsosurfacePicture()
        picture.SetPicture(image)
        return self.draw(picture)


def count_differences(pixels, others):
    return sum(a != b for a, b in zip(pixels, others))


@unittest.skipUnless(os.environ.get("DISPLAY"), "there is no display")
class TestOpaqueScene(PicturesOfMany):
    @classmethod
    def setUpClass(cls):
        cls.window = Window() if RANK == 0 else None
        cls.depths = cls.window.find_depths() if RANK == 0 else None

    def render(self, volume, depths):
        image = vtkImageData()
        compositor = vtkIsosurfaceRayTraceCompositor()
        self.assertTrue(compositor.RenderToImage(volume, make_camera(), None, *PICTURE, image, depths))
        return image

    def check(self, name, box, depths):
        own = make_scene(box, SCENES[name])
        among, over = self.render(own, depths), self.render(own, None)

        def compare():
            expected = self.window.draw(make_scene(CELLS, SCENES[name]))
            different = count_differences(self.window.draw_picture(among), expected)
            without_depths = count_differences(self.window.draw_picture(over), expected)
            answer = f"{name}, {SIZE} processes: {different} pixels differ; {without_depths} if drawn over the scene"
            print(answer)
            # The colours of opaque surfaces are drawn by their own depths.
            is_fine = different == 0 and (without_depths > 1000 or name == "opaque")
            return None if is_fine else answer

        self.assertIsNone(on_first(compare))

    def test_scene_of_process_0(self):
        for name in SCENES:
            with self.subTest(name):
                self.check(name, split(CELLS, SIZE)[RANK], self.depths)

    def test_data_of_the_last_process(self):
        for name in ("translucent", "cloud"):
            with self.subTest(name):
                self.check(name, CELLS if RANK == SIZE - 1 else None, self.depths)

    def test_nearest_of_all_processes(self):
        """Each process has drawn some columns of the scene."""
        depths = vtkFloatArray()
        depths.SetNumberOfValues(PICTURE[0] * PICTURE[1])
        whole = self.share_depths()
        for i, depth in enumerate(whole):
            depths.SetValue(i, depth if i % PICTURE[0] % SIZE == RANK else 1.0)
        for name in ("translucent", "cloud"):
            with self.subTest(name):
                self.check(name, split(CELLS, SIZE)[RANK], depths)

    def share_depths(self):
        return WORLD.bcast([self.depths.GetValue(i) for i in range(PICTURE[0] * PICTURE[1])] if RANK == 0 else None)

    def test_depths_of_another_size(self):
        depths = vtkFloatArray()
        depths.SetNumberOfValues(7)
        volume = make_scene(split(CELLS, SIZE)[RANK], SCENES["translucent"])
        last = SIZE - 1
        self.check_failure(volume, "a depth for each pixel", last, depths=depths if RANK == last else None)


if __name__ == "__main__":
    unittest.main()
