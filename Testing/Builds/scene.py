# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the scenes for pictures and for rays share."""

from vtkmodules.vtkCommonCore import vtkDataArray, vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkRectilinearGrid
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper
import array


class NotInThisBuild(Exception):
    """A setting, or a value of one, that the mapper of the build does not have."""


def apply_settings(mapper, settings):
    """Values that are strings are names of the mapper's enumerations."""
    for name, value in settings.items():
        try:
            setter = getattr(mapper, "Set" + name)
            if isinstance(value, str):
                value = getattr(vtkIsosurfaceRayTraceMapper, value)
        except AttributeError as error:
            raise NotInThisBuild(str(error)) from error
        setter(*value) if isinstance(value, tuple) else setter(value)


def make_array(scalar_type, values, components=1):
    """A vtkDataArray of a type such as VTK_FLOAT."""
    result = vtkDataArray.CreateDataArray(scalar_type)
    result.SetNumberOfComponents(components)
    result.SetNumberOfTuples(len(values) // components)
    view = memoryview(result)
    code = "b" if view.format == "c" else view.format
    view.cast("B")[:] = array.array(code, values).tobytes()
    return result


def make_image(dimensions, scalars):
    image = vtkImageData()
    image.SetDimensions(dimensions)
    scalars.SetName("Scalars")
    image.GetPointData().SetScalars(scalars)
    return image


def make_rectilinear(coordinates, scalars):
    """A grid with its planes at these coordinates along each axis."""
    grid = vtkRectilinearGrid()
    grid.SetDimensions([len(planes) for planes in coordinates])
    setters = (grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)
    for set_coordinates, planes in zip(setters, coordinates):
        axis = vtkDoubleArray()
        for plane in planes:
            axis.InsertNextValue(plane)
        set_coordinates(axis)
    scalars.SetName("Scalars")
    grid.GetPointData().SetScalars(scalars)
    return grid
