#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Make pictures in a line or two each, without a display: pictures.py CT MR FOLDER

CT and MR are files or folders of DICOM slices of a head, in VTK's coordinates."""

import sys
from pathlib import Path

import numpy as np
from vtkIsosurfaceRayTracing import read, render

SIZE = (640, 640)


def bone(ct, mr):
    return render(ct, 300, size=SIZE)


def skin_and_bone(ct, mr):
    return render(ct, [-300, 300], color=["peachpuff", "ivory"], size=SIZE)


def cut(ct, mr):
    return render(mr, color="peachpuff", clip=(1, -0.4, -0.2), view=(-1, 0.9, 0.25), size=SIZE)


def shadows(ct, mr):
    return render(ct, 300, clip="-z", caps=True, view=(-0.5, 0.6, 0.9), shadows=True, size=SIZE)


def orbital(ct, mr):
    """Where an electron of hydrogen is likely to be (n = 4, l = 2, m = 0), with the sign of its wave in colours."""
    x, y, z = np.mgrid[-45:45:121j, -45:45:121j, -45:45:121j]
    r = np.sqrt(x * x + y * y + z * z)
    psi = (3.0 * z * z - r * r) * (12.0 - r) * np.exp(-r / 4.0)
    return render(np.abs(psi), 14.0, color_by=psi, cmap="coolwarm", clim=(-20, 20), clip=(-0.6, -1, 0), size=SIZE)


def minimal_surface(ct, mr):
    """A gyroid within a ball, coloured by the distance from its middle."""
    x, y, z = np.mgrid[-1:1:121j, -1:1:121j, -1:1:121j]
    r = np.sqrt(x * x + y * y + z * z)
    gyroid = sum(np.sin(7.0 * a) * np.cos(7.0 * b) for a, b in ((x, y), (y, z), (z, x)))
    solid = np.minimum(0.5 - np.abs(gyroid), 8.0 * (0.95 - r))
    return render(solid, 0.0, color_by=r, cmap="inferno", clim=(0.0, 1.1), occlusion=True, size=SIZE)


PICTURES = (bone, skin_and_bone, cut, shadows, orbital, minimal_surface)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    ct, mr, folder = read(sys.argv[1]), read(sys.argv[2]), Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    for make in PICTURES:
        path = folder / f"{make.__name__}.png"
        make(ct, mr).save(path)
        print(path)


if __name__ == "__main__":
    main()
