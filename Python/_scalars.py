# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The array whose isosurfaces are drawn, and its values."""

import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkBitArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkDataSetAttributes

from ._data import grids_of


def to_key(name):
    """The name of an array as VTK has it, whatever its encoding is."""
    return name and name.encode("utf-8", "surrogateescape")


def _to_name(key):
    """VTK gives the bytes of names that are not UTF-8."""
    return key.decode("utf-8", "surrogateescape") if isinstance(key, bytes) else key


def _of_bytes(array):
    """The same, but of bits a copy, which numpy can read."""
    if not isinstance(array, vtkBitArray):
        return array
    copy = vtkUnsignedCharArray()
    copy.DeepCopy(array)
    return copy


class Scalars:
    """The arrays of one name in all grids of the data; those that are active if the name is None."""

    def __init__(self, data, name):
        if name is not None and not isinstance(name, str):
            raise TypeError(f"scalars is {name!r}; give the name of an array")
        self.grids = grids_of(data)
        self.name = name or self._only_name()
        self.key = to_key(self.name)
        found = [self._find(grid) for grid in self.grids]
        self.arrays = [array for array, _ in found if array is not None]
        kinds = {is_of_points for array, is_of_points in found if array is not None}
        self.of_points = True in kinds
        self.are_mixed = len(kinds) > 1
        if not self.arrays:
            raise ValueError(f"{self._describe_lack(name)}: {self._describe_names()}")

    def select(self, mapper, data):
        """Have a mapper trace these, whichever are active. Returns the data, or a shallow copy in which they are active.

        So surfaces of arrays with several names can be in one picture: a mapper knows one name.
        """
        if any(array.GetNumberOfComponents() > 1 for array in self.arrays):
            mapper.SetVectorModeToMagnitude()
        if not self.name:
            return data
        mapper.SelectScalarArray(self.key)
        (mapper.SetScalarModeToUsePointFieldData if self.of_points else mapper.SetScalarModeToUseCellFieldData)()
        if not isinstance(data, vtkDataSet):
            if self.are_mixed:
                warnings.warn(f"blocks are left out in which {self.name!r} is an array of cells, since in others it is one "
                              "of points; convert it by vtkCellDataToPointData", RuntimeWarning, stacklevel=3)
            return data
        copy = data.NewInstance()
        copy.ShallowCopy(data)
        if not self.of_points:
            copy.GetPointData().SetActiveAttribute(-1, vtkDataSetAttributes.SCALARS)
        (copy.GetPointData() if self.of_points else copy.GetCellData()).SetActiveScalars(self.key)
        return copy

    def values(self):
        """Of many values a million, evenly, as a histogram needs them: finite ones, and the lengths of vectors."""
        step = max(1, sum(array.GetNumberOfTuples() for array in self.arrays) // 1_000_000)
        values = [vtk_to_numpy(_of_bytes(array))[::step].astype(float) for array in self.arrays]
        values = np.concatenate([each if each.ndim == 1 else np.linalg.norm(each, axis=1) for each in values])
        return values[np.isfinite(values)]

    def high_value(self, low):
        """What 99 of 100 of the values from a low one on do not exceed: the rest is metal and noise."""
        values = self.values()
        values = values[values >= low]
        return max(float(np.percentile(values, 99.0)) if values.size else low, np.nextafter(low, np.inf))

    def range(self):
        """The least and the largest of these; None if there is none."""
        ranges = []
        for array in self.arrays:
            ranges.append(array.GetFiniteRange(-1 if array.GetNumberOfComponents() > 1 else 0))
        ranges = [each for each in ranges if each[0] <= each[1]]
        return (min(low for low, _ in ranges), max(high for _, high in ranges)) if ranges else None

    def _find(self, grid):
        """The array of a grid, and whether it is of points."""
        for attributes, is_of_points in ((grid.GetPointData(), True), (grid.GetCellData(), False)):
            array = attributes.GetArray(self.key) if self.key else attributes.GetScalars()
            if array is not None:
                return array, is_of_points
        return None, False

    def _only_name(self):
        """The name of the only array where none is active, or of that which is active in some grids and not in others; else
        None."""
        others, active = [], set()
        for grid in self.grids:
            array = grid.GetPointData().GetScalars() or grid.GetCellData().GetScalars()
            active.update([_to_name(array.GetName())] if array else [])
            others += [] if array else [grid]
        names = self._names() if not active else sorted(active.intersection(self._names(others)))
        return names[0] if len(names) == 1 and len(active) < 2 else None

    def _names(self, grids=None):
        """Those of arrays of numbers, but for the marks of ghosts."""
        names = {_to_name(attributes.GetArrayName(i)) for attributes in self._attributes(grids)
                 for i in range(attributes.GetNumberOfArrays()) if attributes.GetArray(i) is not None}
        return sorted(name for name in names if name and name != vtkDataSetAttributes.GhostArrayName())

    def _attributes(self, grids=None):
        return [attributes for grid in (self.grids if grids is None else grids) for attributes in (grid.GetPointData(), grid.GetCellData())]

    def _describe_lack(self, name):
        if not name:
            return "the data have no active scalars"
        others = [attributes.GetAbstractArray(to_key(name)) for attributes in self._attributes()]
        others = [array.GetClassName() for array in others if array]
        if others:
            return f"the array {name!r} has no numbers, but is a {others[0]}"
        return f"the data have no array {name!r}"

    def _describe_names(self):
        names = self._names()
        setting = "" if self.name else "scalars=, "
        if names:
            return f"give {setting}one of {', '.join(map(repr, names))}"
        is_empty = not any(grid.GetNumberOfPoints() for grid in self.grids)
        return "they are empty; call Update() of their reader" if is_empty else "they have no arrays of numbers"
