#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Whatever an observer does while a frame is traced, the process lives, and the next frame is right."""

import subprocess
import sys
import time
import unittest

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkVersion, vtkWeakReference
from vtkmodules.vtkCommonDataModel import (
    VTK_XYZ_GRID, vtkAMRBox, vtkImageData, vtkMultiBlockDataSet, vtkOverlappingAMR, vtkPlane, vtkPolyData,
    vtkUniformGrid, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkImagingCore import vtkExtractVOI, vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkHardwareSelector, vtkRenderer, vtkRenderWindow, vtkVolume, vtkVolumeProperty)
import vtkmodules.vtkRenderingOpenGL2  # what vtkRenderWindow needs
from vtkIsosurfaceRayTracing import (
    vtkIsosurfacePicker, vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper, vtkIsosurfaceVolume)

from PictureTesting import capture

EVENTS = ("VolumeMapperRenderProgressEvent", "VolumeMapperRenderStartEvent", "VolumeMapperRenderEndEvent")
VOLUMES = {"vtkVolume": vtkVolume, "vtkIsosurfaceVolume": vtkIsosurfaceVolume}


def make_image(extent=24):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-extent, extent, -extent, extent, -extent, extent)
    source.Update()
    image = vtkImageData()
    image.ShallowCopy(source.GetOutput())
    return image


def make_property(isovalue=157.0):
    prop = vtkVolumeProperty()
    prop.GetIsoSurfaceValues().SetValue(0, isovalue)
    prop.GetScalarOpacity().AddPoint(0.0, 1.0)
    prop.GetRGBTransferFunction().AddRGBPoint(0.0, 0.9, 0.8, 0.7)
    prop.ShadeOn()
    return prop


class Scene:
    """A window with one volume, which takes long enough to trace that progress is reported."""

    MAPPER = vtkIsosurfaceRayTraceMapper
    EXTENT = 24
    RAYS = 32
    SIZE = 200

    def __init__(self, volume_class=vtkVolume):
        self.mapper = self.MAPPER()
        self.set_input(self.EXTENT)
        self.mapper.AmbientOcclusionOn()
        self.mapper.SetNumberOfAmbientOcclusionRays(self.RAYS)
        self.volume = volume_class()
        self.volume.SetMapper(self.mapper)
        self.volume.SetProperty(make_property())
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.renderer.ResetCamera()
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(self.SIZE, self.SIZE)
        self.window.AddRenderer(self.renderer)
        self.events = 0

    def set_input(self, extent):
        self.data = make_image(extent)
        self.mapper.SetInputDataObject(self.data)

    def get_leaf(self):
        """What has the scalars."""
        return self.data

    def render_with(self, attack, event):
        """Renders, and calls attack(self) at the first event."""
        def call(caller, name):
            self.events += 1
            if self.events == 1:
                attack(self)
        self.mapper.AddObserver(event, call)
        self.window.Render()
        assert self.events > 0, "no event came"

    def capture(self):
        """The picture in the window as it is."""
        return capture(self.window)

    def cast(self):
        """The cells that rays through the middle hit."""
        origins = vtkPoints()
        directions = vtkDoubleArray()
        directions.SetNumberOfComponents(3)
        for i in range(-20, 21):
            origins.InsertNextPoint(0.5 * i, 0.1, 200.0)
            directions.InsertNextTuple3(0.0, 0.0, -1.0)
        output = vtkPolyData()
        assert self.mapper.CastRays(self.volume, origins, directions, output)
        cells = output.GetPointData().GetArray("CellId") or output.GetPointData().GetArray(0)
        return [cells.GetTuple1(i) for i in range(cells.GetNumberOfTuples())]

    def pick(self):
        picker = vtkIsosurfacePicker()
        hit = picker.Pick(self.SIZE // 2, self.SIZE // 2, 0, self.renderer)
        return hit, picker.GetCellId(), picker.GetPickPosition()


class MeshScene(Scene):
    """The same with a mapper of meshes, of two blocks that lie one in the other."""

    MAPPER = vtkIsosurfaceRayTraceMeshMapper
    EXTENT = 10
    RAYS = 2
    SIZE = 90

    def set_input(self, extent):
        self.data = vtkMultiBlockDataSet()
        for i in range(2):
            append = vtkAppendFilter()
            append.AddInputData(make_image(extent - i))
            append.Update()
            block = vtkUnstructuredGrid()
            block.DeepCopy(append.GetOutput())
            colors = vtkDoubleArray()
            colors.DeepCopy(block.GetPointData().GetScalars())
            colors.SetName("colors")
            block.GetPointData().AddArray(colors)
            self.data.SetBlock(i, block)
        self.mapper.SetInputDataObject(self.data)
        self.mapper.SetColorArrayName("colors")

    def get_leaf(self):
        return self.data.GetBlock(1)


class AmrScene(Scene):
    """The same in blocks of one level of AMR data, which fill a box and are traced as one."""

    EXTENT = 16

    def set_input(self, extent):
        image = make_image(extent)
        image.SetExtent(0, 2 * extent, 0, 2 * extent, 0, 2 * extent)
        image.SetOrigin(-extent, -extent, -extent)
        self.data = vtkOverlappingAMR()
        places = [(x, y, z) for z in (0, extent) for y in (0, extent) for x in (0, extent)]
        if vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() >= 906:
            self.data.Initialize([8])
        else:
            self.data.Initialize(1, [8])
        self.data.SetOrigin(image.GetOrigin())
        self.data.SetGridDescription(VTK_XYZ_GRID)
        self.data.SetSpacing(0, image.GetSpacing())
        for i, place in enumerate(places):
            cut = vtkExtractVOI()
            cut.SetInputData(image)
            cut.SetVOI(*[k for first in place for k in (first, first + extent)])
            cut.Update()
            block = vtkUniformGrid()
            block.SetDimensions(extent + 1, extent + 1, extent + 1)
            block.SetOrigin([k - extent for k in place])
            block.GetPointData().DeepCopy(cut.GetOutput().GetPointData())
            self.data.SetAMRBox(0, i, vtkAMRBox(place, [k + extent - 1 for k in place]))
            self.data.SetDataSet(0, i, block)
        self.mapper.SetInputDataObject(self.data)

    def get_leaf(self):
        """Not the first block."""
        return self.data.GetDataSet(0, 7)


class ReadingScene(Scene):
    """An image whose samples are read in two slabs: progress is told between them."""

    EXTENT = 85
    RAYS = 1


SCENES = {"image": Scene, "mesh": MeshScene, "amr": AmrScene, "reading": ReadingScene}
READING = "ProgressEvent"


# Attacks, by name ---------------------------------------------------------------------------------
def set_input(scene):
    scene.set_input(6)


def set_input_and_cast(scene):
    set_input(scene)
    assert scene.cast()


def cast(scene):
    assert scene.cast()


def render_to_image(scene):
    output = vtkImageData()
    assert scene.mapper.RenderToImage(scene.volume, scene.renderer.GetActiveCamera(), None, 40, 40, output)
    assert output.GetNumberOfPoints() == 1600


def pick(scene):
    assert scene.pick()[0] == 1


def change_isovalue_and_cast(scene):
    scene.volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 200.0)
    assert scene.cast()


def change_property(scene):
    scene.volume.SetProperty(make_property(100.0))


def clear_functions(scene):
    scene.volume.GetProperty().GetRGBTransferFunction().RemoveAllPoints()
    scene.volume.GetProperty().GetScalarOpacity().RemoveAllPoints()


def change_settings(scene):
    if isinstance(scene.mapper, vtkIsosurfaceRayTraceMapper):
        scene.mapper.SetInterpolationModeToCubic()
        scene.mapper.SetBrickSize(3)
        scene.mapper.SetNumberOfMacrocellLevels(1)
    scene.mapper.SetTileSize(64, 64)
    scene.mapper.SetNumberOfThreads(1)
    scene.mapper.ShadowsOn()
    scene.mapper.AmbientOcclusionOff()


def add_clipping_plane(scene):
    scene.mapper.AddClippingPlane(vtkPlane())


def reallocate(scene):
    if isinstance(scene, MeshScene):
        scene.get_leaf().SetPoints(vtkPoints())
        scene.get_leaf().AllocateExact(3, 24)
    else:
        scene.data.SetDimensions(3, 3, 3)
        scene.data.AllocateScalars(10, 1)


def initialize(scene):
    scene.get_leaf().Initialize()


def shrink_scalars(scene):
    scene.get_leaf().GetPointData().GetScalars().SetNumberOfTuples(8)
    scene.get_leaf().GetPointData().GetScalars().Squeeze()


def release_scalars(scene):
    scene.get_leaf().GetPointData().GetScalars().Initialize()


def remove_scalars(scene):
    scalars = vtkWeakReference()
    scalars.Set(scene.get_leaf().GetPointData().GetScalars())
    scene.get_leaf().GetPointData().SetScalars(None)
    assert scalars.Get(), "the scalars that are read are gone"


def remove_input(scene):
    scene.mapper.SetInputDataObject(None)
    scene.data = None


def take_mapper(scene):
    scene.volume.SetMapper(None)
    scene.mapper = None


def take_volume(scene):
    scene.renderer.RemoveVolume(scene.volume)
    scene.volume = None
    scene.mapper = None


def take_all_props(scene):
    scene.renderer.RemoveAllViewProps()
    scene.volume = None
    scene.mapper = None


def take_renderer(scene):
    scene.window.RemoveRenderer(scene.renderer)
    scene.renderer = None


def render_window(scene):
    scene.window.Render()


def render_other_window(scene):
    other = vtkRenderWindow()
    other.SetOffScreenRendering(1)
    renderer = vtkRenderer()
    other.AddRenderer(renderer)
    renderer.AddVolume(scene.volume)
    other.Render()
    scene.other = other


def release_resources(scene):
    scene.mapper.ReleaseGraphicsResources(scene.window)


def resize(scene):
    scene.window.SetSize(50, 60)


def select(scene):
    selector = vtkHardwareSelector()
    selector.SetRenderer(scene.renderer)
    selector.SetArea(0, 0, 10, 10)
    selector.Select()


def finalize(scene):
    scene.window.Finalize()


def abort(scene):
    scene.window.SetAbortRender(1)


ATTACKS = {name: function for name, function in list(globals().items())
           if callable(function) and getattr(function, "__code__", None)
           and function.__code__.co_varnames[:1] == ("scene",)}


# Attacks on meshes alone --------------------------------------------------------------------------
def shrink_points(scene):
    scene.get_leaf().GetPoints().SetNumberOfPoints(8)
    scene.get_leaf().GetPoints().Squeeze()


def release_points(scene):
    scene.get_leaf().GetPoints().Initialize()


def release_cells(scene):
    scene.get_leaf().GetCells().Initialize()


def shrink_cells(scene):
    scene.get_leaf().GetCells().GetConnectivityArray().SetNumberOfTuples(8)
    scene.get_leaf().GetCells().GetConnectivityArray().Squeeze()


def release_colors(scene):
    scene.get_leaf().GetPointData().GetArray("colors").Initialize()


def remove_colors(scene):
    scene.get_leaf().GetPointData().RemoveArray("colors")


def remove_block(scene):
    scene.data.SetBlock(1, None)


MESH_ATTACKS = {function.__name__: function for function in
                (shrink_points, release_points, release_cells, shrink_cells, release_colors, remove_colors,
                 remove_block)}


# What is not seen in the frame in which it is done.
PUT_OFF = {"set_input", "set_input_and_cast", "cast", "render_to_image", "pick", "change_isovalue_and_cast",
           "change_property", "clear_functions", "change_settings", "add_clipping_plane", "reallocate", "initialize",
           "remove_scalars", "remove_input", "render_window", "render_other_window", "take_mapper",
           "take_volume", "take_all_props", "remove_colors", "remove_block"}
# But where samples are still being read, the frame is drawn afterwards.
SEEN_AFTER_READING = {"clear_functions", "change_settings"}
# What changes nothing at all.
HARMLESS = {"cast", "render_to_image", "pick", "render_window", "render_other_window", "release_resources",
            "select", "abort"}
RELEASED = ("shrink_scalars", "release_scalars", "shrink_points", "release_points", "release_cells", "shrink_cells",
            "release_colors")
ERRORS = {**dict.fromkeys(RELEASED, "has released or made shorter"), "render_other_window": "tracing already"}


def run(name, event, volume_class, scene_class):
    reference = scene_class(volume_class)
    reference.window.Render()
    expected = reference.capture()
    scene = scene_class(volume_class)
    scene.render_with({**ATTACKS, **MESH_ATTACKS}[name], event)
    if name in PUT_OFF - (SEEN_AFTER_READING if event == READING else set()):
        assert scene.capture() == expected, "the frame shows what was put off"
    if name in HARMLESS:
        scene.window.SetAbortRender(0)
        scene.window.Render()
        assert scene.capture() == expected, "the next frame differs"
    print("survived")


class TestReentry(unittest.TestCase):
    pass


def describe(scene):
    """The arrays of a picture without a window."""
    output = vtkImageData()
    assert scene.mapper.RenderToImage(scene.volume, scene.renderer.GetActiveCamera(), None, 200, 200, output)
    data = output.GetPointData()
    return {name: bytes(memoryview(data.GetArray(name)))
            for name in ("Colors", "Depth", "CellId", "IsovalueId")}


class TestRenderToImage(unittest.TestCase):
    def test_changes_are_put_off(self):
        for attack in (change_property, set_input, lambda scene:
                       scene.volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 120.0)):
            scene = Scene()
            scene.mapper.AmbientOcclusionOff()
            expected = describe(scene)
            self.assertIn(0, expected["IsovalueId"])
            observer = scene.mapper.AddObserver(EVENTS[0], lambda caller, event: attack(scene))
            self.assertEqual(describe(scene), expected)
            scene.mapper.RemoveObserver(observer)
            self.assertNotEqual(describe(scene), expected)


def add_test(name, event, volume, scene):
    def test(self):
        run = subprocess.run([sys.executable, __file__, "--attack", name, event, volume, scene],
                             capture_output=True, text=True, timeout=100)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("survived", run.stdout)
        if name in ERRORS:
            self.assertIn(ERRORS[name], run.stderr)
        else:
            self.assertNotIn("ERR|", run.stderr)
        self.assertNotIn("Traceback", run.stderr)
    setattr(TestReentry, f"test_{name}_{event}_{volume}_{scene}", test)


for attack in ATTACKS:
    add_test(attack, EVENTS[0], "vtkVolume", "image")
    add_test(attack, READING, "vtkVolume", "reading")
for attack in (*ATTACKS, *MESH_ATTACKS):
    add_test(attack, EVENTS[0], "vtkVolume", "mesh")
for attack in ("set_input", "initialize", "shrink_scalars", "release_scalars", "remove_scalars", "remove_input"):
    add_test(attack, EVENTS[0], "vtkVolume", "amr")
# Those that take something away, at other moments too.
for attack in ("set_input", "remove_input", "release_scalars", "take_mapper", "take_volume", "take_renderer",
               "finalize"):
    add_test(attack, READING, "vtkIsosurfaceVolume", "reading")
    for scene in ("image", "mesh"):
        add_test(attack, EVENTS[0], "vtkIsosurfaceVolume", scene)
        add_test(attack, EVENTS[1], "vtkVolume", scene)
        add_test(attack, EVENTS[2], "vtkIsosurfaceVolume", scene)


class TestManyProps(unittest.TestCase):
    def test_frames_beside_many_props(self):
        """Each volume holds all props of its renderer while it draws, and looks for them afterwards."""
        seconds = {}
        for count in (1_000, 16_000):
            scene = Scene()
            scene.mapper.AmbientOcclusionOff()
            for _ in range(count):
                actor = vtkActor()
                actor.VisibilityOff()
                scene.renderer.AddActor(actor)
            scene.window.Render()
            times = []
            for _ in range(5):
                start = time.perf_counter()
                scene.window.Render()
                times.append(time.perf_counter() - start)
            seconds[count] = min(times)
        # Were the time quadratic in the props, it would be a hundred times as long or more.
        self.assertLess(seconds[16_000], 40.0 * seconds[1_000] + 0.02)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--attack"]:
        run(sys.argv[2], sys.argv[3], VOLUMES[sys.argv[4]], SCENES[sys.argv[5]])
    else:
        unittest.main()
