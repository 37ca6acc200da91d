# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the functions of the Python package share."""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

SIZE = (120, 90)


def make_ball(count=24, radius=0.7):
    """Values that fall from the middle of a cube from -1 to 1; the ball is where they are above 0."""
    axis = np.linspace(-1.0, 1.0, count)
    x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
    return (radius - np.sqrt(x * x + y * y + z * z)).astype(np.float32)


BALL = {"spacing": 2.0 / 23.0, "origin": (-1.0, -1.0, -1.0)}  # what puts make_ball() into its cube


def draw(mapper, volume, camera, lights, size=SIZE):
    """The colours of RenderToImage, in rows from the top; multiplied by the opacity."""
    image = vtkImageData()
    assert mapper.RenderToImage(volume, camera, lights, *size, image)
    return colors_of(image)


def colors_of(image):
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 4)[::-1]


def is_covered(picture):
    """Rows from the top: where a picture is not transparent."""
    return picture.rgba[:, :, 3] > 0
