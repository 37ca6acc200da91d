# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures as numpy arrays and as files."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Sequence

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

from ._colors import to_rgb
from .vtkIsosurfaceRayTracing import vtkIsosurfacePicture


class Picture:
    """A picture of isosurfaces, which Jupyter shows.

    numpy.asarray converts it to ``rgba``; matplotlib's imshow and Pillow's Image.fromarray accept it.

    Attributes
    ----------
    image : vtkImageData
        The output of RenderToImage of the mapper: colours (multiplied by the opacity), depths, normals, positions,
        cells.
    rgba : numpy.ndarray
        Red, green, blue and opacity, from 0 to 255, in rows from the top. The colours are not multiplied by the opacity.
    """

    def __init__(self, image: vtkImageData, background: str | Sequence[float] | None = None) -> None:
        self.image: vtkImageData = image
        self.rgba: np.ndarray = _to_rgba(image, background)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height, in pixels."""
        return self.image.GetDimensions()[:2]

    def array(self, name: str) -> np.ndarray:
        """An array of ``image``, as rows from the top: "Depth", "Normals", "Position", "CellId" or "IsovalueId"."""
        array = self.image.GetPointData().GetArray(name)
        if array is None:
            points = self.image.GetPointData()
            names = ", ".join(repr(points.GetArrayName(i)) for i in range(points.GetNumberOfArrays()))
            raise KeyError(f"there is no array {name!r}; give one of {names}")
        return _rows(array, self.size)

    def png(self) -> bytes:
        """The bytes of a PNG file."""
        from vtkmodules.vtkIOImage import vtkPNGWriter

        image = vtkImageData()
        image.SetDimensions(*self.size, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(self.rgba[::-1].reshape(-1, 4)))
        writer = vtkPNGWriter()
        writer.SetInputData(image)
        writer.WriteToMemoryOn()
        writer.Write()
        return bytes(writer.GetResult())

    def save(self, path: str | os.PathLike) -> None:
        """Write a PNG file."""
        if not os.fspath(path).lower().endswith(".png"):
            raise ValueError(f"{path} is no name of a PNG file; Pillow writes others: Image.fromarray(picture.rgba)")
        Path(path).write_bytes(self.png())

    def _repr_png_(self):
        return self.png()

    def __array__(self, dtype=None, copy=None):
        return np.array(self.rgba, dtype=dtype) if copy else np.asarray(self.rgba, dtype=dtype)

    def __getstate__(self):
        """What is pickled: arrays of numpy, since data of VTK cannot be."""
        points = self.image.GetPointData()
        arrays = [points.GetArray(i) for i in range(points.GetNumberOfArrays())]
        return self.size, self.rgba, [(array.GetName(), array.GetDataType(), vtk_to_numpy(array)) for array in arrays]

    def __setstate__(self, state):
        size, self.rgba, arrays = state
        self.image = vtkImageData()
        self.image.SetDimensions(*size, 1)
        for name, kind, values in arrays:
            array = numpy_to_vtk(values, array_type=kind)
            array.SetName(name)
            self.image.GetPointData().AddArray(array)
        self.image.GetPointData().SetActiveScalars("Colors")

    def __repr__(self):
        width, height = self.size
        return f"<Picture of {width} x {height} pixels>"


def _to_rgba(image, background):
    straight = vtkImageData()
    size = image.GetDimensions()[:2]
    if background is None:
        vtkIsosurfacePicture.UnpremultiplyColors(image, straight)
        return _rows(straight.GetPointData().GetScalars(), size).copy()
    vtkIsosurfacePicture.FlattenColors(image, to_rgb(background), straight)
    rgb = _rows(straight.GetPointData().GetScalars(), size)
    return np.concatenate([rgb, np.full((*rgb.shape[:2], 1), 255, np.uint8)], axis=2)


def _rows(array, size):
    """From the top, where VTK begins at the bottom."""
    values = vtk_to_numpy(array)
    return values.reshape(size[1], size[0], *values.shape[1:])[::-1]
