#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Make pictures of isosurfaces and clouds of meshes, without a window: meshes.py DATA FOLDER

DATA is the folder that mayavi_meshes.py writes.
"""

import os
import sys

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPlane
from vtkmodules.vtkIOExodus import vtkExodusIIReader
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOLegacy import vtkStructuredGridReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import vtkCamera, vtkLight, vtkLightCollection, vtkVolume
from vtkIsosurfaceRayTracing import vtkCellProjectionMapper, vtkIsosurfacePicture, vtkIsosurfaceRayTraceMeshMapper

from whole_file import write_picture


def read(reader, data, name):
    """What is in a file; the program ends if there is none, or nothing in it."""
    file_name = os.path.join(data, name)
    if not os.path.isfile(file_name):
        sys.exit(f"there is no file {file_name}")
    reader.SetFileName(file_name)
    reader.UpdateInformation()
    if isinstance(reader, vtkExodusIIReader):
        reader.SetAllArrayStatus(vtkExodusIIReader.NODAL, 1)
    reader.Update()
    mesh = reader.GetOutput()
    if mesh.GetNumberOfPoints() == 0:
        sys.exit(f"{file_name} is damaged, or not a mesh")
    return mesh


class Picture:
    """Isosurfaces or a cloud of a mesh, a camera and a light."""

    def __init__(self, mesh, scalars, mapper_class=vtkIsosurfaceRayTraceMeshMapper):
        self.mapper = mapper_class()
        self.mapper.SetInputDataObject(mesh)
        self.mapper.SetScalarModeToUsePointFieldData()
        self.mapper.SelectScalarArray(scalars)
        self.volume = vtkVolume()
        self.volume.SetMapper(self.mapper)
        self.surface = self.volume.GetProperty()
        self.surface.ShadeOn()
        self.surface.SetAmbient(0.2)
        self.surface.SetDiffuse(0.8)
        self.surface.GetIsoSurfaceValues().SetNumberOfContours(0)
        # A new property has functions from black to white.
        self.surface.GetRGBTransferFunction().RemoveAllPoints()
        self.surface.GetScalarOpacity().RemoveAllPoints()
        self.camera = vtkCamera()
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(0.5, 1.0, 1.0)
        self.lights = vtkLightCollection()
        self.lights.AddItem(light)

    def add_surface(self, isovalue, color, opacity):
        values = self.surface.GetIsoSurfaceValues()
        values.SetValue(values.GetNumberOfContours(), isovalue)
        self.surface.GetRGBTransferFunction().AddRGBPoint(isovalue, *color)
        self.surface.GetScalarOpacity().AddPoint(isovalue, opacity)

    def set_cloud(self, unit_distance, *points):
        """The cloud of values, opacities through the unit distance, and colours; with the isosurfaces in it."""
        self.mapper.DrawIsosurfacesOn()
        self.surface.SetScalarOpacityUnitDistance(unit_distance)
        for value, opacity, color in points:
            self.surface.GetScalarOpacity().AddPoint(value, opacity)
            self.surface.GetRGBTransferFunction().AddRGBPoint(value, *color)

    def color_by(self, name, *colors):
        """From the first of evenly spaced colours at the first value to the last at the second."""
        low, high, *colors = colors
        self.mapper.SetColorArrayName(name)
        function = self.surface.GetRGBTransferFunction()
        function.RemoveAllPoints()
        for i, color in enumerate(colors):
            function.AddRGBPoint(low + (high - low) * i / (len(colors) - 1), *color)

    def add_plane(self, origin, normal):
        plane = vtkPlane()
        plane.SetOrigin(origin)
        plane.SetNormal(normal)
        self.mapper.AddClippingPlane(plane)

    def look_from(self, direction, up, zoom):
        bounds = self.mapper.GetBounds()
        center = [0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)]
        length = sum((bounds[2 * k + 1] - bounds[2 * k]) ** 2 for k in range(3)) ** 0.5
        distance = 2.0 * length / zoom
        self.camera.SetFocalPoint(center)
        self.camera.SetPosition([c + distance * d for c, d in zip(center, direction)])
        self.camera.SetViewUp(up)
        self.camera.SetClippingRange(0.1 * distance, 3.0 * distance)

    def write(self, file_name, size):
        output = vtkImageData()
        self.mapper.RenderToImage(self.volume, self.camera, self.lights, size, size, output)
        transparent = vtkImageData()
        vtkIsosurfacePicture.UnpremultiplyColors(output, transparent)
        writer = vtkPNGWriter()
        writer.SetInputData(transparent)
        write_picture(writer, file_name)


def disk(data):
    """The gas above a hot disk: translucent surfaces of its temperature, cut open."""
    picture = Picture(read(vtkExodusIIReader(), data, "disk_out_ref.ex2"), "Temp")
    picture.add_surface(320.0, (0.45, 0.6, 1.0), 0.35)
    picture.add_surface(450.0, (0.35, 0.9, 0.85), 0.45)
    picture.add_surface(600.0, (1.0, 0.85, 0.4), 0.6)
    picture.add_surface(800.0, (1.0, 0.3, 0.15), 1.0)
    picture.surface.SetAmbient(0.35)
    picture.add_plane((0.0, 0.0, 0.0), (-0.5, 1.0, 0.0))
    picture.mapper.CapClippingPlanesOn()
    picture.look_from((0.65, -0.65, 0.4), (0.0, 0.0, 1.0), 1.55)
    return picture


def pressure(data):
    """A surface of the temperature, coloured by the pressure of the gas."""
    picture = Picture(read(vtkExodusIIReader(), data, "disk_out_ref.ex2"), "Temp")
    picture.add_surface(400.0, (1.0, 1.0, 1.0), 1.0)
    picture.color_by("Pres", 0.007, 0.028, (0.2, 0.3, 0.8), (0.9, 0.9, 0.85), (0.8, 0.2, 0.15))
    picture.look_from((0.65, -0.65, 0.4), (0.0, 0.0, 1.0), 1.7)
    return picture


def fire(data):
    """A fire in a room: hot gas, and the flame inside, with shadows."""
    picture = Picture(read(vtkXMLUnstructuredGridReader(), data, "fire_ug.vtu"), "t")
    picture.add_surface(330.0, (0.8, 0.8, 0.9), 0.35)
    picture.add_surface(450.0, (1.0, 0.6, 0.2), 1.0)
    picture.mapper.ShadowsOn()
    picture.look_from((-0.35, -0.75, 0.55), (0.0, 0.0, 1.0), 1.05)
    return picture


def smoke(data):
    """The same as a cloud, which is lit: the hotter the gas, the denser; and the flame in it."""
    picture = Picture(read(vtkXMLUnstructuredGridReader(), data, "fire_ug.vtu"), "t", vtkCellProjectionMapper)
    cloud = ((299.0, 0.0, (0.3, 0.3, 0.4)), (330.0, 0.2, (0.35, 0.4, 0.6)), (480.0, 0.3, (0.9, 0.4, 0.2)))
    picture.set_cloud(0.4, *cloud)
    picture.add_surface(560.0, (1.0, 0.8, 0.3), 1.0)
    picture.look_from((-0.35, -0.75, 0.55), (0.0, 0.0, 1.0), 1.05)
    return picture


def gas(data):
    """The gas above the disk as a cloud, cut open, and a surface of its temperature."""
    picture = Picture(read(vtkExodusIIReader(), data, "disk_out_ref.ex2"), "Temp", vtkCellProjectionMapper)
    cloud = ((300.0, 0.0, (0.3, 0.45, 1.0)), (400.0, 0.12, (0.3, 0.85, 0.8)), (600.0, 0.5, (1.0, 0.8, 0.3)))
    picture.set_cloud(1.5, *cloud)
    picture.surface.SetAmbient(0.5)  # it glows by itself
    picture.surface.SetDiffuse(0.6)
    picture.add_surface(800.0, (1.0, 0.3, 0.15), 1.0)
    picture.add_plane((0.0, 0.0, 0.0), (-0.5, 1.0, 0.0))
    picture.look_from((0.65, -0.65, 0.4), (0.0, 0.0, 1.0), 1.55)
    return picture


def curvilinear(data):
    """Two surfaces in a curvilinear grid."""
    picture = Picture(read(vtkStructuredGridReader(), data, "SampleStructGrid.vtk"), "scalars")
    picture.add_surface(0.3, (0.6, 0.8, 1.0), 0.45)
    picture.add_surface(0.6, (0.6, 0.95, 0.7), 0.6)
    picture.add_surface(0.9, (1.0, 0.8, 0.5), 1.0)
    picture.look_from((0.75, -0.35, 0.55), (0.0, 0.0, 1.0), 1.1)
    return picture


SCENES = (disk, pressure, fire, smoke, gas, curvilinear)


def write_all(data, folder, size):
    os.makedirs(folder, exist_ok=True)
    for make in SCENES:
        file_name = os.path.join(folder, make.__name__ + ".png")
        make(data).write(file_name, size)
        print(file_name)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    data, folder = sys.argv[1:]
    write_all(data, folder, 960)


if __name__ == "__main__":
    main()
