# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The isovalues: those of the user, or one from the histogram."""

import numpy as np

from ._numbers import to_array


def choose_isovalues(isovalues, scalars):
    """A list of isovalues, at least one of which is within the scalars."""
    if isinstance(isovalues, str):
        if isovalues != "auto":
            raise ValueError(f"isovalues is {isovalues!r}; give numbers or 'auto'")
        return [find_threshold(scalars.values())]
    chosen = np.atleast_1d(to_array("isovalues", isovalues, "give a finite number, or a list of them"))
    if chosen.ndim != 1 or chosen.size == 0 or not np.isfinite(chosen).all():
        raise ValueError(f"isovalues is {isovalues!r}; give a finite number, or a list of them")
    if np.unique(chosen).size < chosen.size:
        raise ValueError(f"isovalues is {isovalues!r}; give each once")
    limits = scalars.range()
    if limits is None:
        raise ValueError("there is no surface: all values are NaN or infinite")
    low, high = limits
    if not np.any((low < chosen) & (chosen <= high)):
        raise ValueError(f"there is no surface at {isovalues!r}: the scalars are from {low:g} to {high:g}")
    return chosen.tolist()


def find_threshold(values):
    """Between the two classes of values that differ most (N. Otsu, 1979)."""
    if values.size == 0 or values.min() == values.max():
        raise ValueError("the scalars have no two different values, so there is no surface")
    scale = np.abs(values).max()  # so that squares are no overflow
    counts, edges = np.histogram(values / scale, bins=256)
    centers = 0.5 * (edges[:-1] + edges[1:])
    below, sums = np.cumsum(counts)[:-1], np.cumsum(counts * centers)[:-1]
    above = values.size - below
    mean_below, mean_above = sums / below, (np.sum(counts * centers) - sums) / above
    between = below * above * (mean_below - mean_above) ** 2.0
    # Where bins are empty many thresholds are as good: the one in their middle.
    return float(scale * np.mean(edges[1:-1][between >= between.max() * (1.0 - 1e-12)]))
