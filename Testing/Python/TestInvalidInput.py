#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""No number and no array, of our classes or of what they read, ends the process, hangs it or spoils the window.

Every method Set... of the objects of a scene is found by its name, and called with numbers that are not finite,
extreme, negative and zero, as its signature takes them; a table has what is not set by such a method. Then
everything that traces is called. What cannot be drawn is one error with a remedy, and the window shows the rest
of the scene. Each kind of scene is a process of its own, so that a crash is a failure with the name of the attack.
"""

import itertools
import math
import re
import subprocess
import sys
import unittest

from vtkmodules.vtkCommonCore import (
    vtkBitArray, vtkDoubleArray, vtkFloatArray, vtkOutputWindow, vtkPoints, vtkStringArray,
    vtkStringOutputWindow, vtkUnsignedCharArray, vtkVariantArray, vtkVersion, reference)
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject, vtkImageData, vtkMultiBlockDataSet, vtkPlane, vtkPolyData, vtkRectilinearGrid)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2
from vtkIsosurfaceRayTracing import (
    vtkIsosurfaceComparisonFilter, vtkIsosurfacePicker, vtkIsosurfaceRayTraceMapper,
    vtkIsosurfaceRayTraceMeshMapper, vtkIsosurfaceVolume)

EDGE = 8
WINDOW = 20
NAN, INF = math.nan, math.inf
FLOATS = [NAN, INF, -INF, 1e308, -1e308, 1e-310, 0.0, -1.0]
INTEGERS = [0, -1, 2**31 - 1, -(2**31)]
STRINGS = [None, "", "no such thing", "x" * 100000]
TIME_LIMIT = 120  # seconds; a hang

OURS = ["mapper", "picker", "filter"]
# Of VTK's objects only numbers that are not whole are attacked: VTK does not check the indices of its own
# arrays, and makes as many contours as it is asked for.
OF_VTK = ["volume", "property", "camera", "light", "plane", "image", "colors", "opacity", "isovalues"]
# What takes memory or time in proportion to its value is set, but not used.
NOT_USED = {"filter.SetImageSize", "filter.SetNumberOfRepeats", "filter.SetNumberOfContours",
            "filter.GenerateValues", "filter.SetValue"}


def make_arrays(grid, tuples):
    """The distance from the centre, from 0 to more than 1, as scalars, and another array."""
    half = (EDGE - 1) / 2
    scalars, other = vtkFloatArray(), vtkFloatArray()
    scalars.SetName("distance")
    other.SetName("other")
    for z, y, x in itertools.islice(itertools.product(range(EDGE), repeat=3), tuples):
        scalars.InsertNextValue(math.dist((x, y, z), 3 * (half,)) / half)
        other.InsertNextValue(x / EDGE)
    grid.GetPointData().SetScalars(scalars)
    grid.GetPointData().AddArray(other)


def make_image():
    """From -1 to 1 along each axis."""
    image = vtkImageData()
    image.SetDimensions(*3 * (EDGE,))
    image.SetOrigin(*3 * (-1.0,))
    image.SetSpacing(*3 * (2.0 / (EDGE - 1),))
    make_arrays(image, EDGE**3)
    return image


def make_mesh():
    """The same samples as points of hexahedra."""
    append = vtkAppendFilter()
    append.AddInputData(make_image())
    append.Update()
    return append.GetOutput()


def make_sphere():
    source = vtkSphereSource()
    source.SetCenter(-1.2, 0.0, -1.2)
    source.SetRadius(0.2)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


class Scene:
    """A volume and a sphere of polygons."""

    def __init__(self, window, kind):
        self.window = window
        self.image = make_mesh() if kind == "mesh" else make_image()
        self.mapper = vtkIsosurfaceRayTraceMeshMapper() if kind == "mesh" else vtkIsosurfaceRayTraceMapper()
        self.mapper.SetInputData(self.image)
        self.mapper.SetNumberOfThreads(1)
        self.volume = vtkIsosurfaceVolume()
        self.volume.SetMapper(self.mapper)
        self.property = self.volume.GetProperty()
        self.property.ShadeOn()
        self.colors = self.property.GetRGBTransferFunction()
        self.colors.AddRGBPoint(0.0, 0.9, 0.8, 0.7)
        self.colors.AddRGBPoint(1.0, 0.3, 0.4, 0.5)
        self.opacity = self.property.GetScalarOpacity()
        self.opacity.AddPoint(0.0, 1.0)
        self.opacity.AddPoint(1.0, 1.0)
        self.isovalues = self.property.GetIsoSurfaceValues()
        self.isovalues.SetValue(0, 0.5)
        self.plane = vtkPlane()
        self.plane.SetNormal(1.0, 0.2, 0.1)
        self.plane.SetOrigin(-0.2, 0.0, 0.0)
        self.light = vtkLight()
        self.light.SetPosition(1.0, -3.0, 2.0)
        self.matrix = vtkMatrix4x4()
        self.volume.SetUserMatrix(self.matrix)
        if kind == "everything":
            self.show_everything()
        elif kind == "mesh":
            self.mapper.AddClippingPlane(self.plane)
            self.mapper.ShadowsOn()
        elif kind == "projection":
            self.mapper.SetBlendModeToMaximumIntensity()
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.renderer.AddActor(make_sphere())
        self.renderer.AddLight(self.light)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetPosition(1.0, -5.0, 1.5)
        self.camera.SetViewUp(0.0, 0.0, 1.0)
        self.camera.SetClippingRange(1.0, 20.0)
        window.GetRenderers().RemoveAllItems()
        window.AddRenderer(self.renderer)
        self.picker = vtkIsosurfacePicker()
        self.filter = vtkIsosurfaceComparisonFilter()
        self.filter.SetInputData(self.image if kind != "mesh" else make_image())
        self.filter.PicturesOff()
        self.filter.SetImageSize(8, 8)
        self.filter.SetValue(0, 0.5)
        self.filter.SetNumberOfRepeats(1)
        self.errors = []

        def keep_error(_caller, _event, text):
            self.errors.append(text)

        keep_error.CallDataType = "string0"
        self.mapper.AddObserver("ErrorEvent", keep_error)
        self.warnings = []

        def keep_warning(_caller, _event, text):
            self.warnings.append(text)

        keep_warning.CallDataType = "string0"
        self.mapper.AddObserver("WarningEvent", keep_warning)

    def show_everything(self):
        """All that reads settings, except for projections."""
        self.mapper.CapClippingPlanesOn()
        self.mapper.CroppingOn()
        self.mapper.SetCroppingRegionPlanes(-0.9, 0.9, -0.9, 0.9, -0.9, 0.9)
        self.mapper.SetColorArrayName("other")
        self.mapper.AddClippingPlane(self.plane)
        self.mapper.ShadowsOn()
        self.mapper.AmbientOcclusionOn()
        self.mapper.SetNumberOfAmbientOcclusionRays(2)
        self.mapper.SetAmbientOcclusionRadius(1.0)
        self.mapper.AutoAdjustSampleDistancesOff()
        self.isovalues.SetValue(1, 0.8)
        self.opacity.AddPoint(0.5, 0.4)
        self.light.PositionalOn()
        self.light.SetConeAngle(30.0)

    def picture(self):
        self.window.Render()
        pixels = vtkUnsignedCharArray()
        self.window.GetRGBACharPixelData(0, 0, WINDOW - 1, WINDOW - 1, 0, pixels)
        return bytes(memoryview(pixels))

    def draw(self):
        """Draws two frames. Returns what the second shows, and all errors."""
        self.window.Render()
        picture = self.picture()
        return picture, list(self.errors)

    def picture_without_volume(self):
        self.volume.VisibilityOff()
        picture = self.picture()
        self.volume.VisibilityOn()
        return picture

    def trace(self):
        """Calls all that traces without drawing."""
        lights = self.renderer.GetLights()
        self.mapper.RenderToImage(self.volume, self.camera, lights, 8, 8, vtkImageData())
        origins, directions = vtkPoints(), vtkDoubleArray()
        directions.SetNumberOfComponents(3)
        for x in (-0.1, 0.1, 5.0):
            origins.InsertNextPoint(x, -5.0, 0.1)
            directions.InsertNextTuple3(0.0, 1.0, 0.01)
        self.mapper.CastRays(self.volume, origins, directions, vtkPolyData())
        self.picker.Pick(WINDOW / 2, WINDOW / 2, 0.0, self.renderer)
        self.picker.Pick3DRay((0.0, -5.0, 0.1), (0.0, 0.0, 0.0, 1.0), self.renderer)
        self.mapper.HasOnlyOpaqueSurfaces(self.volume)


def find_signatures(method):
    """The types of the parameters of a method of VTK, for each of its overloads."""
    for parameters in re.findall(r"^\w+\(self(?:, )?(.*)\) -> ", method.__doc__ or "", re.MULTILINE):
        yield re.findall(r"\w+:(\(.*?\)|\[.*?\]|[^,]+)", parameters)


def find_extremes(kind, integers):
    """Values for a parameter of a type; none for an object."""
    count = kind.count("float") + kind.count("int")
    if kind == "bool":
        return [False, True]
    if kind == "str":
        return STRINGS
    values = FLOATS if "float" in kind else integers
    if kind in ("float", "int"):
        return values
    if count == 0:
        return []
    return [tuple(value if i in (j, count) else 1 for i in range(count))
            for value in values for j in range(count + 1)] + [count * (value,) for value in values]


def find_arguments(kinds, integers):
    """Each parameter with all of its extremes, the others with harmless values; and all at once."""
    choices = [find_extremes(kind, integers) for kind in kinds]
    if not choices or not all(choices):
        return
    harmless = [{"float": 1.0, "int": 0}.get(kind, values[-1]) for kind, values in zip(kinds, choices)]
    for i, values in enumerate(choices):
        for value in values:
            yield harmless[:i] + [value] + harmless[i + 1 :]
    if len(choices) > 1:
        yield from map(list, zip(*choices))


def find_setters(scene, subject):
    """The attacks on an object of a scene by its own methods: their names, and functions of a scene."""
    sample = getattr(scene, subject)
    for name in dir(sample):
        if not name.startswith("Set") or hasattr(vtkAlgorithm, name) or hasattr(vtkDataObject, name):
            continue
        found = {}
        for kinds in find_signatures(getattr(sample, name)):
            if subject in OURS or any("float" in kind for kind in kinds):
                for arguments in find_arguments(kinds, INTEGERS if subject in OURS else [0]):
                    found[repr(arguments)] = arguments
        for text, arguments in found.items():
            yield f"{subject}.{name}({text[1:60]})", make_call(subject, name, arguments)


def make_call(subject, name, arguments):
    return lambda scene: getattr(getattr(scene, subject), name)(*arguments)


def set_ghosts(scene, of, tuples, components, data=None):
    ghosts = vtkUnsignedCharArray()
    ghosts.SetName("vtkGhostType")
    ghosts.SetNumberOfComponents(components)
    ghosts.SetNumberOfTuples(tuples)
    ghosts.Fill(0)
    getattr(data or scene.image, f"Get{of}Data")().AddArray(ghosts)


def invert_extent(scene):
    """VTK 9.6 and later ends the program by itself: there it is an empty one."""
    is_refused = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) >= (9, 6)
    scene.image.SetExtent(*([0, -1] if is_refused else [7, 0]) * 3)


def set_blocks(scene, attack):
    """Two blocks, of which the second is attacked."""
    blocks = vtkMultiBlockDataSet()
    for i in range(2):
        block = make_image()
        block.SetOrigin(-1.0 + 2.0 * i, -1.0, -1.0)
        blocks.SetBlock(i, block)
    scene.mapper.SetColorArrayName("other")
    scene.mapper.SetInputDataObject(blocks)
    attack(block)


def set_block_colors(block):
    colors = vtkFloatArray()
    colors.SetName("other")
    colors.SetNumberOfComponents(3)
    colors.SetNumberOfTuples(EDGE**3)
    colors.Fill(1.0)
    block.GetPointData().AddArray(colors)


def set_coordinates(scene, values):
    grid = vtkRectilinearGrid()
    grid.SetDimensions(*3 * (EDGE,))
    for axis in "XYZ":
        array = vtkDoubleArray()
        for i in range(EDGE):
            array.InsertNextValue(-1.0 + 2.0 * i / (EDGE - 1))
        getattr(grid, f"Set{axis}Coordinates")(array)
    for i, value in enumerate(values):
        array.SetValue(i, value)
    array.SetNumberOfTuples(max(len(values), EDGE) if values else 3)
    make_arrays(grid, EDGE**3)
    scene.mapper.SetInputDataObject(grid)


def set_scalars(scene, array, tuples=EDGE**3):
    array.SetName("distance")
    array.SetNumberOfTuples(tuples)
    data = scene.image.GetPointData()
    data.RemoveArray("distance")
    data.AddArray(array)
    scene.mapper.SetScalarModeToUsePointFieldData()
    scene.mapper.SelectScalarArray("distance")


def set_color_image(scene, attack):
    colors = make_image()
    attack(colors)
    scene.mapper.SetColorArrayName("other")
    scene.mapper.SetColorInputData(colors)


def resize_after_a_frame(scene, array):
    """Without Modified()."""
    scene.window.Render()
    scene.image.GetPointData().GetArray(array).SetNumberOfTuples(5)


def add_plane(scene, normal, origin):
    scene.plane.SetNormal(*normal)
    scene.plane.SetOrigin(*origin)
    scene.mapper.AddClippingPlane(scene.plane)


def put_camera_at_focal_point(scene):
    scene.camera.SetPosition(scene.camera.GetFocalPoint())


def cast_invalid_rays(scene):
    origins, directions = vtkPoints(), vtkDoubleArray()
    origins.SetDataTypeToDouble()
    directions.SetNumberOfComponents(3)
    for value in FLOATS:
        for origin, direction in [((value, -5.0, 0.1), (0.0, 1.0, 0.0)), ((0.0, -5.0, 0.1), (0.0, value, 0.0)),
                                  (3 * (value,), 3 * (value,))]:
            origins.InsertNextPoint(origin)
            directions.InsertNextTuple(direction)
    scene.mapper.CastRays(scene.volume, origins, directions, vtkPolyData())


def pick_everywhere(scene):
    for x, y in itertools.product(FLOATS, FLOATS):
        scene.picker.Pick(x, y, 0.0, scene.renderer)
        scene.picker.Pick3DPoint((x, y, 0.0), scene.renderer)
        scene.picker.Pick3DRay((x, y, 0.0), (0.0, 0.0, 0.0, 1.0), scene.renderer)
    for column, row in itertools.product(INTEGERS, INTEGERS):
        scene.mapper.PickPixel(
            scene.renderer, scene.volume, column, row, [0, 0, 0], [0, 0, 0], reference(0), reference(0.0),
            [0, 0, 0])


def set_points(scene, ids, value):
    for i in ids:
        scene.image.GetPoints().SetPoint(i, value, value, value)
    scene.image.Modified()


def set_ids(scene, place, value):
    scene.image.GetCells().GetConnectivityArray().SetTuple1(place, value)
    scene.image.Modified()


def set_offset(scene, place, value):
    scene.image.GetCells().GetOffsetsArray().SetTuple1(place, value)
    scene.image.Modified()


def scale_matrix(scene, scale):
    for i in range(3):
        scene.matrix.SetElement(i, i, scale)


def set_shapes(scene, shape):
    scene.image.GetCellTypesArray().Fill(shape)
    scene.image.Modified()


# Name, attack, and a word of the remedy; none where something is drawn, or VTK decides.
TABLE = [
    ("rays that are not finite", cast_invalid_rays, ""),
    ("pixels beyond the window", pick_everywhere, ""),
    ("a scale of 0", lambda s: s.volume.SetScale(0.0), "SetScale"),
    ("a position that is NaN", lambda s: s.volume.SetPosition(NAN, 0, 0), "SetPosition"),
    ("a matrix with NaN", lambda s: s.matrix.SetElement(0, 0, NAN), "SetUserMatrix"),
    ("a matrix with infinity", lambda s: s.matrix.SetElement(0, 3, INF), "SetUserMatrix"),
    ("a singular matrix", lambda s: s.matrix.SetElement(2, 2, 0.0), "SetUserMatrix"),
    ("a matrix with a subnormal determinant", lambda s: scale_matrix(s, 1e-106), "SetUserMatrix"),
    ("a matrix with perspective", lambda s: s.matrix.SetElement(3, 0, 0.2), "last row is 0 0 0 1"),
    ("a matrix with a common factor", lambda s: s.matrix.SetElement(3, 3, 2.0), "last row is 0 0 0 1"),
    ("a matrix that overflows", lambda s: s.matrix.SetElement(1, 1, 1e308), ""),
    ("a camera at NaN", lambda s: s.camera.SetPosition(NAN, 0, 0), "vtkCamera"),
    ("a camera at its focal point", put_camera_at_focal_point, ""),
    ("a view angle that is NaN", lambda s: s.camera.SetViewAngle(NAN), "vtkCamera"),
    ("a light with NaN", lambda s: s.light.SetPosition(NAN, 0, 0), "SwitchOff"),
    ("a light with infinite intensity", lambda s: s.light.SetIntensity(INF), "SwitchOff"),
    ("a plane without a normal", lambda s: add_plane(s, (0, 0, 0), (0, 0, 0)), ""),
    ("a plane with NaN", lambda s: add_plane(s, (NAN, 0, 0), (0, 0, 0)), "RemoveClippingPlane"),
    ("a plane at infinity", lambda s: add_plane(s, (1, 0, 0), (INF, 0, 0)), "RemoveClippingPlane"),
    ("infinite ambient light", lambda s: s.property.SetAmbient(INF), "SetAmbient"),
    ("an opacity that is NaN", lambda s: s.opacity.AddPoint(0.5, NAN), ""),
    ("a colour that is NaN", lambda s: s.colors.AddRGBPoint(0.5, NAN, 0, 0), ""),
    ("no colours", lambda s: s.colors.RemoveAllPoints(), ""),
    ("no opacities", lambda s: s.opacity.RemoveAllPoints(), ""),
    ("an isovalue that is NaN", lambda s: s.isovalues.SetValue(0, NAN), ""),
    ("no isovalues", lambda s: s.isovalues.SetNumberOfContours(0), ""),
    ("ghost points, too few", lambda s: set_ghosts(s, "Point", 5, 1), "vtkGhostType"),
    ("ghost points, none", lambda s: set_ghosts(s, "Point", 0, 1), "vtkGhostType"),
    ("ghost points, too many", lambda s: set_ghosts(s, "Point", EDGE**3 + 1, 1), "vtkGhostType"),
    ("ghost points of 2 components", lambda s: set_ghosts(s, "Point", EDGE**3, 2), "vtkGhostType"),
    ("ghost cells, too few", lambda s: set_ghosts(s, "Cell", 5, 1), "vtkGhostType"),
    ("scalars that are text", lambda s: set_scalars(s, vtkStringArray()), "SelectScalarArray"),
    ("scalars that are variants", lambda s: set_scalars(s, vtkVariantArray()), "SelectScalarArray"),
    ("scalars that are bits", lambda s: set_scalars(s, vtkBitArray()), ""),
    ("too few scalars", lambda s: set_scalars(s, vtkFloatArray(), 5), "every point"),
    ("no scalars at all", lambda s: set_scalars(s, vtkFloatArray(), 0), "every point"),
    ("fewer scalars later", lambda s: resize_after_a_frame(s, "distance"), "every point"),
]

# What is wrong with a block is a warning, and the others are drawn.
LEFT_OUT = "Block 2 of the composite input is left out."

TABLE_OF_IMAGES = [
    ("spacing 0", lambda s: s.image.SetSpacing(1, 0, 1), "spacing"),
    ("a singular direction", lambda s: s.image.SetDirectionMatrix(1, 0, 0, 1, 0, 0, 0, 0, 1), "full rank"),
    ("an empty extent", lambda s: s.image.SetExtent(0, -1, 0, -1, 0, -1), "at least 2"),
    ("an inverted extent", invert_extent, "at least 2"),
    ("a larger extent", lambda s: s.image.SetDimensions(2**20, 2**20, 2**20), "every point"),
    ("coordinates with NaN", lambda s: set_coordinates(s, [-1, NAN]), "finite"),
    ("coordinates at infinity", lambda s: set_coordinates(s, [-INF]), "finite"),
    ("coordinates out of order", lambda s: set_coordinates(s, [-1, 0.9]), "ascend or descend"),
    ("equal coordinates", lambda s: set_coordinates(s, EDGE * [0.5]), "must differ"),
    ("too few coordinates", lambda s: set_coordinates(s, []), "one for each"),
    ("ghost cells in a block", lambda s: set_blocks(s, lambda b: set_ghosts(s, "Cell", 5, 1, b)), LEFT_OUT),
    ("ghost points in a block", lambda s: set_blocks(s, lambda b: set_ghosts(s, "Point", 5, 1, b)), LEFT_OUT),
    ("unlike colours in a block", lambda s: set_blocks(s, set_block_colors), LEFT_OUT),
    ("blocks without spacing", lambda s: set_blocks(s, lambda b: b.SetSpacing(NAN, 1, 1)), LEFT_OUT),
    ("fewer colours", lambda s: (s.mapper.SetColorArrayName("other"), resize_after_a_frame(s, "other")),
     "SetColorArrayName"),
    ("a colour image without points", lambda s: set_color_image(s, lambda c: c.Initialize()),
     "SetColorArrayName"),
    ("a colour image without points, with an array", lambda s: set_color_image(
        s, lambda c: (c.SetDimensions(0, 0, 0), c.GetPointData().GetArray("other").SetNumberOfTuples(0))),
     "SetColorArrayName"),
    ("a colour image without spacing", lambda s: set_color_image(s, lambda c: c.SetSpacing(0, 1, 1)), "port 1"),
    ("a colour image at NaN", lambda s: set_color_image(s, lambda c: c.SetOrigin(NAN, 1, 1)), "port 1"),
]

TABLE_OF_MESHES = [
    ("a point at NaN", lambda s: set_points(s, [0], NAN), ""),
    ("all points at infinity", lambda s: set_points(s, range(EDGE**3), INF), ""),
    ("all points at one place", lambda s: set_points(s, range(EDGE**3), 0.1), ""),
    ("points that are far away", lambda s: set_points(s, range(100), 1e300), ""),
    ("no points", lambda s: s.image.SetPoints(vtkPoints()), "0 points"),
    ("an id that is too large", lambda s: set_ids(s, 20, EDGE**3), "Cell 2 has"),
    ("a negative id", lambda s: set_ids(s, 8, -1), "Cell 1 has"),
    ("an offset that is too large", lambda s: set_offset(s, 5, 10**6), "Cell 4 has"),
    ("a negative offset", lambda s: set_offset(s, 5, -8), "Cell 4 has"),
    ("cells of no shape that is traced", lambda s: set_shapes(s, 0), "no cells of three dimensions"),
    ("tetrahedra with eight points", lambda s: set_shapes(s, 10), "Cell 0 has"),
    ("one point for all corners", lambda s: [set_ids(s, i, 7) for i in range(8)], ""),
]


class Attacker:
    """Attacks scenes of a kind, and prints what is wrong."""

    def __init__(self, kind):
        vtkOutputWindow.SetInstance(vtkStringOutputWindow())
        self.kind = kind
        self.window = vtkRenderWindow()
        self.window.OffScreenRenderingOn()
        self.window.SetMultiSamples(0)
        self.window.SetSize(WINDOW, WINDOW)
        self.count = 0

    def check(self, name, condition, what):
        if not condition:
            print(f"FAILED {name}: {what}", flush=True)

    def begin(self, name, attack):
        print(f"ATTACK {name}", flush=True)
        self.count += 1
        scene = Scene(self.window, self.kind)
        attack(scene)
        return scene

    def attack_setter(self, subject, name, attack):
        scene = self.begin(name, attack)
        if subject == "mapper":
            for getter in dir(scene.mapper):
                if getter.startswith("Get") and hasattr(scene.mapper, "S" + getter[1:]):
                    self.check_setting(scene, name, getter)
        if name.partition("(")[0] in NOT_USED:
            return
        scene.errors.clear()
        scene.window.Render()
        if scene.errors:
            picture, errors = scene.draw()
            self.check(name, len(errors) == 1, f"{len(errors)} errors")
            self.check(name, picture == scene.picture_without_volume(), "the rest is drawn differently")
        scene.trace()
        if subject in ("filter", "image") and self.kind == "plain":
            scene.filter.Update()

    def check_setting(self, scene, name, getter):
        method = getattr(scene.mapper, getter)
        if "(self) -> float" in method.__doc__:
            self.check(name, math.isfinite(method()), f"{getter} is {method()}")

    def attack_by_table(self, name, attack, remedy):
        scene = self.begin(name, attack)
        picture, errors = scene.draw()
        if remedy == LEFT_OUT:
            self.check(name, picture != scene.picture_without_volume(), "nothing is drawn")
            self.check(name, not errors, f"errors: {errors}")
            self.check(name, len(scene.warnings) == 1 and LEFT_OUT in scene.warnings[0],
                       f"no warning, or several: {scene.warnings}")
        elif not remedy:
            self.check(name, len(errors) <= 1, f"several errors: {errors}")
        else:
            self.check(name, picture == scene.picture_without_volume(), "something is drawn")
            # VTK itself leaves out a volume that has no bounds, without asking the mapper.
            scene.mapper.Render(scene.renderer, scene.volume)
            self.check(name, len(scene.errors) == 1 and remedy in scene.errors[0],
                       f"no error with \"{remedy}\", or several: {scene.errors}")
        scene.trace()

    def run(self):
        sample = Scene(self.window, self.kind)
        for subject in OURS + OF_VTK:
            for name, attack in find_setters(sample, subject):
                self.attack_setter(subject, name, attack)
        for row in TABLE + (TABLE_OF_MESHES if self.kind == "mesh" else TABLE_OF_IMAGES):
            self.attack_by_table(*row)
        print(f"DONE {self.count}")


class TestInvalidInput(unittest.TestCase):
    def attack(self, kind):
        arguments = [sys.executable, "-X", "faulthandler", __file__, "attack", kind]
        try:
            result = subprocess.run(
                arguments, capture_output=True, check=False, timeout=TIME_LIMIT, text=True)
            output, end = result.stdout, f"exit status {result.returncode}: {result.stderr[-2000:]}"
        except subprocess.TimeoutExpired as expired:
            output, end = expired.stdout.decode(), f"not done after {TIME_LIMIT} s"
        lines = output.splitlines()
        attacks = [line for line in lines if line.startswith("ATTACK")]
        self.assertTrue(lines and lines[-1].startswith("DONE"), f"{attacks[-1:]}: {end}")
        failures = [line for line in lines if line.startswith("FAILED")]
        self.assertEqual(failures, [], "\n".join(failures))
        print(f"{len(attacks)} attacks on {kind}", flush=True)
        self.assertGreater(len(attacks), 500)

    def test_plain(self):
        self.attack("plain")

    def test_everything(self):
        self.attack("everything")

    def test_projection(self):
        self.attack("projection")

    def test_mesh(self):
        self.attack("mesh")

    def test_nan_is_refused(self):
        """By every setting that is a number: the old value stays, and an error says so."""
        refused = []
        for name in dir(vtkIsosurfaceRayTraceMapper):
            mapper = vtkIsosurfaceRayTraceMapper()
            # Some of the properties that newer VTK has cannot be read.
            setter = getattr(mapper, name) if name.startswith("Set") else None
            if setter and not hasattr(vtkAlgorithm, name) and ["float"] in find_signatures(setter):
                errors = []
                mapper.AddObserver("ErrorEvent", lambda *_: errors.append(1))
                before = getattr(mapper, "G" + name[1:])()
                setter(NAN)
                self.assertEqual(getattr(mapper, "G" + name[1:])(), before, name)
                self.assertEqual(len(errors), 1, name)
                refused.append(name)
        self.assertIn("SetImageSampleDistance", refused)
        self.assertIn("SetAmbientOcclusionRadius", refused)


if __name__ == "__main__":
    if sys.argv[1:2] == ["attack"]:
        Attacker(sys.argv[2]).run()
    else:
        unittest.main()
