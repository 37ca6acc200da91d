#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Skin and bone of a CT, cut open: ct.py CT FOLDER

CT is a folder of DICOM slices or a file (.nii.gz, .mhd, .nrrd, ...). Writes three pictures."""

import sys
from pathlib import Path

from vtkIsosurfaceRayTracing import read, render

if len(sys.argv) != 3:
    sys.exit(__doc__)
ct, folder = read(sys.argv[1]), Path(sys.argv[2])
folder.mkdir(exist_ok=True)
head = {"isovalues": [-300, 300], "color": ["peachpuff", "ivory"]}  # Hounsfield units: skin and bone

render(ct, **head).save(folder / "skin_and_bone.png")
window = (-160, 240)  # of soft tissue
render(ct, -300, color="peachpuff", clip="x", clim=window, view=(-1, 0.15, 0.1)).save(folder / "slice.png")  # of the CT
render(ct, 300, color="ivory", clip="-z", caps=True, shadows=True, view="z").save(folder / "caps.png")
