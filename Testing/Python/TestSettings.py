#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every setting of the mappers, found by its Set and Get, is copied and printed: none is forgotten."""

import re
import unittest

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPlane, vtkPlaneCollection
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes, vtkVolume, vtkVolumeProperty
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper, vtkVolumeMapper
import vtkmodules.vtkRenderingVolumeOpenGL2  # what vtkFixedPointVolumeRayCastMapper needs
from vtkIsosurfaceRayTracing import (
    vtkIsosurfacePicker,
    vtkCellProjectionMapper,
    vtkIsosurfaceRayTraceMapper,
    vtkIsosurfaceRayTraceMeshMapper,
    vtkIsosurfaceVolume,
)

LEVELS = 8
MAPPERS = (vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper, vtkCellProjectionMapper)


def find_settings(mapper):
    """Names that have both Set and Get, here or in a superclass that knows of volumes."""
    names = {name[3:] for name in dir(mapper)
             if name.startswith("Set") and not hasattr(vtkAlgorithm, name)}
    return sorted(name for name in names if hasattr(mapper, "Get" + name))


def describe(method):
    """The documentation of a method, without its signatures in Python and C++."""
    return " ".join(line.strip() for line in method.__doc__.splitlines() if not re.match(r"\w+\(|C\+\+:|    ", line))


def others(value):
    """Values that may be allowed besides one."""
    if isinstance(value, tuple):
        yield tuple(range(3, 3 + len(value)))
    elif isinstance(value, str) or value is None:
        yield "another"
    elif isinstance(value, bool):
        yield not value
    elif isinstance(value, (int, float)):
        yield value + 1
        yield value - 1


def change(mapper, name):
    """Gives a setting another value. Returns it; fails if there is none that the setting takes."""
    if name == "ClippingPlanes":
        mapper.AddClippingPlane(vtkPlane())
        return mapper.GetClippingPlanes()
    if name == "CompositeDataDisplayAttributes":
        mapper.SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes())
        return get(mapper, name)
    if name == "ConnectionVolume":
        mapper.SetConnectionVolume(1, vtkVolume())
        return get(mapper, name)
    if name == "MacrocellBranching":
        for level in range(LEVELS):
            mapper.SetMacrocellBranching(level, 10 + level)
        return get(mapper, name)
    before = get(mapper, name)
    for value in others(before):
        getattr(mapper, "Set" + name)(value)
        if get(mapper, name) != before:
            return get(mapper, name)
    raise AssertionError(f"{name} does not change from {before}")


def get(mapper, name):
    if name == "MacrocellBranching":
        return [mapper.GetMacrocellBranching(level) for level in range(LEVELS)]
    if name == "ConnectionVolume":
        return [mapper.GetConnectionVolume(connection) for connection in range(3)]
    return getattr(mapper, "Get" + name)()


def printed(mapper, name):
    """What is printed of a setting, or None."""
    lines = str(mapper).splitlines()
    for i, line in enumerate(lines):
        head, colon, rest = line.strip().partition(":")
        if colon and head.replace(" ", "") == name:
            return rest + "".join(lines[i + 1 : i + 4])
    return None


class TestSettings(unittest.TestCase):
    def test_settings_are_found(self):
        settings = find_settings(vtkIsosurfaceRayTraceMapper())
        for name in ["RootSolver", "Shadows", "TileSize", "ColorArrayName", "MacrocellBranching",
                     "Cropping", "CroppingRegionPlanes", "BlendMode", "ScalarMode",
                     "ClippingPlanes"]:
            self.assertIn(name, settings)
        self.assertNotIn("Progress", settings)

    def test_copy(self):
        for kind in MAPPERS:
            for name in find_settings(kind()):
                with self.subTest(f"{kind.__name__}: {name}"):
                    mapper = kind()
                    value = change(mapper, name)
                    copy = kind()
                    copy.ShallowCopy(mapper)
                    self.assertEqual(get(copy, name), value)

    def test_shared_settings_are_alike(self):
        images, meshes = vtkIsosurfaceRayTraceMapper(), vtkIsosurfaceRayTraceMeshMapper()
        own = {"BlendMode", "TileSize"}  # Meshes gain from larger tiles.
        shared = set(find_settings(images)) & set(find_settings(meshes)) - own
        self.assertGreater(len(shared), 15)
        for name in shared:
            with self.subTest(name):
                for end in ("", "MinValue", "MaxValue"):
                    if hasattr(images, f"Get{name}{end}"):
                        self.assertEqual(get(meshes, name + end), get(images, name + end))

    def test_copy_of_inputs_and_arrays(self):
        image, colors = vtkImageData(), vtkImageData()
        mapper, copy = vtkIsosurfaceRayTraceMapper(), vtkIsosurfaceRayTraceMapper()
        mapper.SetInputData(image)
        mapper.SetColorInputData(colors)
        mapper.SelectScalarArray("name")
        copy.ShallowCopy(mapper)
        self.assertIs(copy.GetInputDataObject(0, 0), image)
        self.assertIs(copy.GetInputDataObject(1, 0), colors)
        self.assertEqual(copy.GetArrayName(), "name")
        self.assertEqual(copy.GetArrayAccessMode(), mapper.GetArrayAccessMode())
        mapper.SelectScalarArray(3)
        copy.ShallowCopy(mapper)
        self.assertEqual(copy.GetArrayId(), 3)
        self.assertEqual(copy.GetArrayAccessMode(), mapper.GetArrayAccessMode())
        copy.ShallowCopy(vtkIsosurfaceRayTraceMapper())
        self.assertEqual(copy.GetNumberOfInputConnections(0), 0)
        self.assertEqual(copy.GetNumberOfInputConnections(1), 0)

    def test_copy_of_another_volume_mapper(self):
        mapper = vtkFixedPointVolumeRayCastMapper()
        own = set(find_settings(vtkIsosurfaceRayTraceMapper()))
        for name in sorted(own & {name[3:] for name in dir(vtkVolumeMapper)}):
            with self.subTest(name):
                value = change(mapper, name)
                copy = vtkIsosurfaceRayTraceMapper()
                copy.ShallowCopy(mapper)
                self.assertEqual(get(copy, name), value)

    def test_print(self):
        for kind in MAPPERS:
            for name in find_settings(kind()):
                if name in ("AverageIPScalarRange", "ComputeNormalFromOpacity"):
                    continue  # vtkVolumeMapper does not print them by their names, and the mapper does not use them.
                with self.subTest(f"{kind.__name__}: {name}"):
                    mapper = kind()
                    before = printed(mapper, name)
                    self.assertIsNotNone(before, "it is not printed")
                    change(mapper, name)
                    self.assertNotEqual(printed(mapper, name), before)

    def test_documentation_of_what_both_mappers_have(self):
        """Headers of VTK say what there is of a class in one place, so much of it is there twice."""
        differ = {
            "AmbientOcclusion", "CapClippingPlanes", "ColorArrayName", "TileSize", "VectorMode", "DisplayTime", "ShadeTime",
            "TraceTime"}  # fmt: skip
        names = {name for name in vars(vtkIsosurfaceRayTraceMapper) if name.startswith(("Set", "Get", "Cast", "Find"))}
        checked = 0
        for name in sorted(names & set(vars(vtkIsosurfaceRayTraceMeshMapper))):
            if not name[3:].startswith(tuple(differ)):
                own, other = (describe(getattr(kind, name)) for kind in MAPPERS[:2])
                with self.subTest(name=name):
                    self.assertEqual(own, other)
                checked += 1
        self.assertGreater(checked, 50)

    def test_print_of_the_others(self):
        self.assertIn("Isovalue:", str(vtkIsosurfacePicker()))
        self.assertIn("HasOpaqueGeometry: 0", str(vtkIsosurfaceVolume()))

    def test_volume(self):
        for kind in (vtkVolume, vtkIsosurfaceVolume):
            volume, copy = kind(), kind()
            mapper = vtkIsosurfaceRayTraceMapper()
            volume.SetMapper(mapper)
            volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 3.5)
            volume.SetPosition(1.0, 2.0, 3.0)
            copy.ShallowCopy(volume)
            self.assertIs(copy.GetMapper(), mapper)
            self.assertIs(copy.GetProperty(), volume.GetProperty())
            self.assertEqual(copy.GetPosition(), (1.0, 2.0, 3.0))

    def test_property(self):
        surface, copy = vtkVolumeProperty(), vtkVolumeProperty()
        surface.ShadeOn()
        surface.SetSpecularPower(7.0)
        surface.SetComponentWeight(1, 0.5)
        surface.GetIsoSurfaceValues().SetValue(1, 3.5)
        surface.GetRGBTransferFunction().AddRGBPoint(3.5, 0.1, 0.2, 0.3)
        surface.GetScalarOpacity().AddPoint(3.5, 0.4)
        copy.DeepCopy(surface)
        self.assertEqual(copy.GetShade(), 1)
        self.assertEqual(copy.GetSpecularPower(), 7.0)
        self.assertEqual(copy.GetComponentWeight(1), 0.5)
        self.assertEqual(copy.GetIsoSurfaceValues().GetValue(1), 3.5)
        self.assertEqual(copy.GetRGBTransferFunction().GetColor(3.5), (0.1, 0.2, 0.3))
        self.assertEqual(copy.GetScalarOpacity().GetValue(3.5), 0.4)


if __name__ == "__main__":
    unittest.main()
