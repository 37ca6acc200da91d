#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Other data than a CT: other_volumes.py BRAIN FOLDER

BRAIN is an MR of a brain without its skull, such as ch2better.nii.gz of Debian's package mricron-data.
Writes three pictures: of the brain, of the brain cut open, and of a simulation."""

import sys
from pathlib import Path

import numpy as np
from vtkIsosurfaceRayTracing import read, render


def simulate_reaction(size=64, steps=2000):
    """Two substances that diffuse, and react where they meet (the model of Gray and Scott), in a
    periodic box of samples: the second one begins as a few drops."""
    first, second = np.ones((size, size, size), np.float32), np.zeros((size, size, size), np.float32)
    for x, y, z in np.random.default_rng(2).integers(0, size - 8, (12, 3)):
        second[x:x + 8, y:y + 8, z:z + 8] = 0.5

    def diffuse(values):
        return sum(np.roll(values, shift, axis) for axis in range(3) for shift in (-1, 1)) - 6 * values

    for _ in range(steps):
        reacted = first * second * second
        first += 0.12 * diffuse(first) - reacted + 0.03 * (1 - first)
        second += 0.06 * diffuse(second) + reacted - 0.092 * second
    return first, second


if len(sys.argv) != 3:
    sys.exit(__doc__)
brain, folder = read(sys.argv[1]), Path(sys.argv[2])
folder.mkdir(exist_ok=True)
cortex = {"isovalues": 60, "color": "#e8c4b4", "occlusion": True}

render(brain, **cortex, view=(-1, 0.6, 0.5)).save(folder / "brain.png")
render(brain, **cortex, clip="-x", view=(1, 0.6, 0.5)).save(folder / "brain_cut.png")
first, second = simulate_reaction()
concentration = {"color_by": first, "cmap": "viridis", "clim": (0.54, 0.63)}
render(second, 0.15, **concentration, occlusion=True).save(folder / "reaction.png")
