# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces coloured by other values than their isovalues."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkImageData

from ._data import to_vtk
from ._numbers import to_array
from ._property import color_values
from ._scalars import Scalars, to_key
from .vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

ADDED = "colors of isosurfaces"  # the name of an array that is added to the data


def color_by(mapper, surface, data, by, cmap, clim):
    """Have a mapper and a property colour surfaces by something. Returns the data, to which an array may be added."""
    if isinstance(by, vtkImageData):
        if not isinstance(mapper, vtkIsosurfaceRayTraceMapper):
            raise ValueError("an image cannot colour the surfaces of a mesh; sample it at the points of the mesh")
        mapper.SetColorInputData(by)
        scalars = Scalars(by, None)
    else:
        if not isinstance(by, str):
            data = _add(np.asanyarray(by), data)  # with the mask, if there is one
            by = ADDED
        mapper.SetColorArrayName(to_key(by))
        scalars = Scalars(data, by)
    if not _are_colors(scalars.arrays[0]):
        surface.GetRGBTransferFunction().SetVectorModeToMagnitude()  # of vectors the length counts
        color_values(surface, cmap, *(_find_limits(scalars) if clim is None else to_limits(clim)))
    return data


def to_limits(clim):
    """The values of the ends of a colour map."""
    remedy = "give the values of the first and of the last colour, the smaller one first; a list for cmap may be reversed"
    limits = to_array("clim", clim, remedy)
    if limits.shape != (2,) or not np.isfinite(limits).all() or not limits[0] < limits[1]:
        raise ValueError(f"clim is {clim!r}; {remedy}")
    return tuple(limits.tolist())


def _add(array, data):
    """A shallow copy of the data with the array."""
    if not isinstance(data, vtkDataSet):
        raise ValueError("an array cannot colour composite data: add one to each block, and give color_by its name")
    copy = data.NewInstance()
    copy.ShallowCopy(data)
    of_points, of_cells = _find_shapes(data)
    for attributes, shapes in ((copy.GetPointData(), of_points), (copy.GetCellData(), of_cells)):
        for shape in shapes:
            converted = _convert(array, shape)
            if converted is not None:
                attributes.AddArray(converted)
                return copy
    raise ValueError(f"the shape of color_by is {array.shape}; give a number, or red, green and blue as uint8, for "
                     f"each point {of_points[0]} or cell {of_cells[0]} of the data")


def _find_shapes(data):
    """Those of arrays of points, and of cells: of images along the axes, and of all data flat."""
    points, cells = [(data.GetNumberOfPoints(),)], [(data.GetNumberOfCells(),)]
    if isinstance(data, vtkImageData):
        points.insert(0, data.GetDimensions())
        cells.insert(0, tuple(count - 1 for count in data.GetDimensions()))
    return points, cells


def _convert(array, shape):
    """An array of VTK with a value or a colour for each sample; None if the shape is another one."""
    if array.shape == shape:
        return to_vtk(array, ADDED)
    components = array.shape[len(shape):]
    if array.shape[: len(shape)] != shape or components not in ((3,), (4,)) or array.dtype != np.uint8:
        return None
    if np.ma.is_masked(array):
        raise ValueError("color_by are colours of which some are masked; give them a colour, as by array.filled(128)")
    colors = numpy_to_vtk(np.ascontiguousarray(array.reshape(-1, *components, order="F")))
    colors.SetName(ADDED)
    return colors


def _are_colors(array):
    return isinstance(array, vtkUnsignedCharArray) and array.GetNumberOfComponents() in (3, 4)


def _find_limits(scalars):
    low, high = scalars.range() or (0.0, 1.0)
    return (low, high) if low < high else (low, low + 1.0)
