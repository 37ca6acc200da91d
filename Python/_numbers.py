# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Numbers that users give."""

import numbers

import numpy as np


def to_array(name, value, remedy):
    """An array of floating point numbers; if there are none, the error says what to give for the name."""
    try:
        return np.asarray(value, dtype=float)
    except (OverflowError, TypeError, ValueError):
        raise ValueError(f"{name} is {value!r}; {remedy}") from None


def are_three(value):
    """Whether a value has the form of a point, a direction or a colour, and not of several."""
    return isinstance(value, (list, tuple, np.ndarray)) and len(value) == 3 and all(
        isinstance(each, numbers.Real) for each in value)
