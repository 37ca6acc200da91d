# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Planes that cut surfaces."""

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPlane

from ._directions import is_direction, to_direction
from ._numbers import are_three


def to_planes(clip, center):
    """Planes of VTK, of which the side is kept that the normal points to.

    One plane or a list of them: a vtkPlane; a pair of a point and a normal; or a normal, of a plane through the centre.
    """
    if clip is None:
        return []
    if isinstance(clip, list) and not is_direction(clip):
        return [plane for each in clip for plane in to_planes(each, center)]
    if isinstance(clip, vtkPlane):
        return [clip]
    point, normal = clip if isinstance(clip, tuple) and len(clip) == 2 else (center, clip)
    if not are_three(point) or not np.isfinite(point).all():
        raise ValueError(f"clip is {clip!r}; give a normal, a pair of a point and a normal, or a vtkPlane")
    plane = vtkPlane()
    plane.SetOrigin(point)
    plane.SetNormal(to_direction("the normal of clip", normal))
    return [plane]
