# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Directions by the names of axes, for views and planes."""

import numpy as np

from ._numbers import are_three

NAMES = {sign + axis: (-1.0 if sign else 1.0) * np.eye(3)[i] for sign in ("", "-") for i, axis in enumerate("xyz")}


def is_direction(value):
    """Whether a value has the form of a direction, and not of several."""
    return isinstance(value, str) or are_three(value)


def to_direction(name, value):
    """A vector of length one, of the name of an axis ("x", "-z") or of a vector."""
    if isinstance(value, str) and value in NAMES:
        return NAMES[value]
    if not are_three(value) or not np.isfinite(value).all() or not np.any(value):
        raise ValueError(f"{name} is {value!r}; give an axis ('x', '-x', ... '-z') or a vector")
    vector = np.asarray(value, dtype=float)
    vector = vector / np.abs(vector).max()  # whose length is no overflow
    return vector / np.linalg.norm(vector)
