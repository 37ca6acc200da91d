# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Cameras that show surfaces, and not the boxes around them, as large as the picture allows."""

import numbers

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkCamera

from ._directions import to_direction
from ._errors import call
from .vtkIsosurfaceRayTracing import vtkCellProjectionMapper

VIEW = (-0.45, 1.0, 0.3)  # sees faces where y is to the front of a patient, as in NIfTI
MARGIN = 0.06  # of the picture, around the surface
COARSE = 192**2  # the pixels of a picture that finds the surface
FEW = 50  # of them do not


def make_camera(volume, size, view=VIEW, up=None, zoom=1.0, camera=None):
    """A camera that looks at the surfaces of a volume from a direction, in which they are centered, or a copy of one."""
    if camera is not None:
        return _copy(camera, volume)
    back = to_direction("view", view)
    upward = to_direction("up", ("z" if abs(back[2]) < 0.999 else "y") if up is None else up)
    if np.linalg.norm(np.cross(back, upward)) < 1e-6:
        raise ValueError(f"view and up are both along {back.tolist()}; give up another direction")
    if not isinstance(zoom, numbers.Real) or not 0.0 < zoom < np.inf:
        raise ValueError(f"zoom is {zoom!r}; give a number above 0")
    camera = vtkCamera()
    camera.SetViewUp(upward)
    bounds = volume.GetBounds()
    points = _find_corners(volume) if bounds is None else _corners_of(bounds)
    # A look at all, in which small parts are that lie apart, then one at the surfaces. Clouds fill their bounds.
    for _ in range(0 if isinstance(volume.GetMapper(), vtkCellProjectionMapper) else 2):
        _fit(camera, back, points, size)
        set_clipping_range(camera, volume)
        points = _find_points(volume, camera, size)
    _fit(camera, back, points, size)
    camera.Zoom(zoom)
    set_clipping_range(camera, volume)
    return camera


def _copy(camera, volume):
    if not isinstance(camera, vtkCamera):
        raise TypeError(f"camera is {camera!r}; give a vtkCamera, or view, up and zoom instead")
    copy = vtkCamera()
    copy.DeepCopy(camera)
    set_clipping_range(copy, volume)
    return copy


def set_clipping_range(camera, volume):
    """Have a camera see all of a volume."""
    bounds = volume.GetBounds()
    if bounds is None:  # without an input, which the mapper reports
        return
    toward = np.array(camera.GetDirectionOfProjection())
    depths = (_corners_of(bounds) - camera.GetPosition()) @ toward
    far = 1.01 * max(depths.max(), 1e-30)
    camera.SetClippingRange(max(0.99 * depths.min(), 1e-3 * far), far)


def _find_corners(volume):
    """The corners of the box around the surfaces of a volume."""
    bounds = [0.0] * 6
    if not call(volume.GetMapper(), "FindSurfaceBounds", volume, bounds):
        raise ValueError("there is no surface to be seen: no isovalue is within the scalars, all surfaces have the "
                         "opacity 0, or clip removes them")
    return _corners_of(bounds)


def _corners_of(bounds):
    x, y, z = np.meshgrid(*np.reshape(bounds, (3, 2)))
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)


def _find_points(volume, camera, size):
    """What a small picture shows of the surfaces."""
    width, height = (max(1, round(length * (COARSE / size[0] / size[1]) ** 0.5)) for length in size)
    picture = vtkImageData()
    call(volume.GetMapper(), "RenderToImage", volume, camera, None, width, height, picture)
    points = vtk_to_numpy(picture.GetPointData().GetArray("Position"))
    points = points[np.isfinite(points[:, 0])]
    return points if len(points) >= FEW else _find_corners(volume)


def _fit(camera, back, points, size):
    """Move a camera along its axes to where all points are just in the picture, and in its middle."""
    right = np.cross(camera.GetViewUp(), back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    x, y, z = points @ right, points @ up, points @ back
    slope = np.tan(np.radians(0.5 * camera.GetViewAngle())) * (1.0 - 2.0 * MARGIN)
    depth = max(_find_depth(x, z, slope * size[0] / size[1]), _find_depth(y, z, slope))
    depth = max(depth, z.max() + 1e-12 * np.abs(points).max() + 1e-300)  # of a single point
    focus = _find_center(x, depth - z) * right + _find_center(y, depth - z) * up
    camera.SetFocalPoint(focus + 0.5 * (z.min() + z.max()) * back)
    camera.SetPosition(focus + depth * back)


def _find_depth(along, z, slope):
    """The least depth of a camera between whose sides all points are."""
    # They are there where |along - that of the camera| <= slope * (depth - z), so the camera is between
    # max(along + slope z) - slope * depth and slope * depth - max(slope z - along).
    return (np.max(along + slope * z) + np.max(slope * z - along)) / (2.0 * slope)


def _find_center(along, distances):
    """Where a camera is in the middle between the sides of what it sees, by bisection."""
    low, high = along.min(), along.max()
    for _ in range(50):
        center = 0.5 * (low + high)
        if np.max((along - center) / distances) > np.max((center - along) / distances):
            low = center
        else:
            high = center
    return center
