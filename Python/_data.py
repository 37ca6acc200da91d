# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What is traced, of whatever the user has: numpy arrays, data of VTK and PyVista, files."""

import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet,
    vtkDataObject,
    vtkDataSet,
    vtkImageData,
    vtkRectilinearGrid,
    vtkStructuredGrid,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkAlgorithmOutput

from ._files import read
from ._numbers import to_array

GRIDS = (vtkImageData, vtkRectilinearGrid, vtkStructuredGrid, vtkUnstructuredGrid, vtkCompositeDataSet)
MESHES = (vtkStructuredGrid, vtkUnstructuredGrid)


def to_data(data, spacing=None, origin=None, direction=None):
    """The data of VTK; of a numpy array, an image."""
    if isinstance(data, GRIDS) or isinstance(data, (str, os.PathLike)):
        if not all(each is None for each in (spacing, origin, direction)):
            raise TypeError("spacing, origin and direction are those of numpy arrays; other data have their own")
        return data if isinstance(data, GRIDS) else read(data)
    if isinstance(data, vtkDataObject) or not hasattr(data, "__array__"):
        # (From VTK 9.6 on, some classes have other names in Python.)
        name = data.GetClassName() if isinstance(data, vtkDataObject) else type(data).__name__
        if isinstance(data, (vtkAlgorithm, vtkAlgorithmOutput)):
            raise TypeError(f"there are no isosurfaces in a {data.GetClassName()}: call Update(), and give GetOutput()")
        raise TypeError(
            f"there are no isosurfaces in a {name}: give a numpy array, a vtkImageData, a "
            "vtkRectilinearGrid, a vtkStructuredGrid, a vtkUnstructuredGrid, composite data, or the name of a file")
    return _make_image(data, spacing, origin, direction)


def _make_image(array, spacing, origin, direction):
    if np.ndim(array) != 3 or min(np.shape(array)) < 2:
        raise ValueError(
            f"a volume has three axes with two samples or more on each; the shape of this array is {np.shape(array)}"
            + ("; give one volume of it, as array[..., 0]" if np.ndim(array) > 3 else ""))
    image = vtkImageData()
    image.SetDimensions(np.shape(array))
    image.SetSpacing(_numbers("spacing", spacing, (3,), 1.0))
    if not all(image.GetSpacing()):
        raise ValueError("no spacing may be 0")
    image.SetOrigin(_numbers("origin", origin, (3,), 0.0))
    image.SetDirectionMatrix(_numbers("direction", direction, (3, 3), np.eye(3)).ravel())
    image.GetPointData().SetScalars(to_vtk(array))
    return image


def _numbers(name, value, shape, default):
    """Finite numbers of a shape; one number stands for all."""
    remedy = f"give finite numbers in the shape {shape}"
    numbers = to_array(name, default if value is None else value, remedy)
    if numbers.shape not in ((), shape) or not np.isfinite(numbers).all():
        raise ValueError(f"{name} is {value!r}; {remedy}")
    return np.broadcast_to(numbers, shape)


def to_vtk(array, name="scalars"):
    """An array of VTK with the values of a numpy array, the first axis fastest; it shares the memory if it can."""
    if isinstance(array, np.ma.MaskedArray):
        array = array.astype(float).filled(np.nan)  # where nothing is drawn
    array = np.asarray(array)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"the values of an array are {array.dtype}; give real numbers")
    if array.dtype == bool:
        array = array.astype(np.uint8)
    elif array.dtype.kind == "f" and array.dtype.itemsize not in (4, 8):
        array = array.astype(np.float32 if array.dtype.itemsize < 4 else np.float64)
    array = array.astype(array.dtype.newbyteorder("="), copy=False)
    result = numpy_to_vtk(array.ravel(order="F"))
    result.SetName(name)
    return result


def grids_of(data):
    """The grids of composite data, which may have tables besides; of others the data themselves."""
    if not isinstance(data, vtkCompositeDataSet):
        return [data]
    grids, iterator = [], data.NewIterator()
    while not iterator.IsDoneWithTraversal():
        if isinstance(block := iterator.GetCurrentDataObject(), vtkDataSet):
            grids.append(block)
        iterator.GoToNextItem()
    return grids
