# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Volumes from files, for the other scripts of this folder."""

import sys

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkIsosurfaceRayTracing import read


def read_volume(name):
    """The volume in a file (.vti, .mhd, .nii, .nii.gz or what else VTK reads), or in a folder of DICOM slices;
    the program ends if it cannot be read."""
    try:
        volume = read(name)
    except (OSError, ValueError, MemoryError) as error:
        sys.exit(str(error))
    if not isinstance(volume, vtkImageData):
        sys.exit(f"{name} is not a volume")
    return volume
