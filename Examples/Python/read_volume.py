# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Volumes from files, for the other scripts of this folder."""

import math
import os
import re
import sys

from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkIOImage import vtkImageReader2Factory


def read_volume(file_name):
    """The volume in a file; the program ends if it cannot be read."""
    if not os.path.isfile(file_name):
        sys.exit(f"there is no file {file_name}")
    reader = vtkImageReader2Factory.CreateImageReader2(file_name)
    if reader is None:
        sys.exit(f"VTK has no image reader for {file_name}")
    errors = []
    for source in (reader, reader.GetExecutive()):
        source.AddObserver("ErrorEvent", lambda *_: errors.append(True))
    reader.SetFileName(file_name)
    reader.UpdateInformation()
    # VTK ends the process if it cannot allocate memory.
    if not errors and get_bytes(reader) > os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"):
        sys.exit(f"{file_name} asks for more memory than this machine has")
    if not errors:
        reader.Update()
    image = reader.GetOutput()
    if errors or not is_volume(image) or is_cut(file_name, get_bytes(reader)):
        sys.exit(f"{file_name} is damaged, or not a volume")
    return image


def get_bytes(reader):
    """The size of the volume that the header announces."""
    extent = reader.GetDataExtent()
    samples = math.prod(extent[2 * axis + 1] - extent[2 * axis] + 1 for axis in range(3))
    components = reader.GetNumberOfScalarComponents()
    return samples * components * vtkDataArray.GetDataTypeSize(reader.GetDataScalarType())


def is_volume(image):
    return (image.GetDataDimension() == 3 and image.GetPointData().GetScalars() is not None
            and all(0.0 < abs(spacing) < math.inf for spacing in image.GetSpacing()))


def is_cut(file_name, size):
    """Whether a MetaImage has fewer bytes: VTK's reader leaves the other samples undefined."""
    with open(file_name, "rb") as stream:
        fields = dict(re.findall(rb"^(\w+) *= *(.*?)\s*$", stream.read(4096), re.MULTILINE))
    if fields.get(b"CompressedData", b"").lower() == b"true":
        digits = fields.get(b"CompressedDataSize", b"")
        size = int(digits) if digits.isdigit() else 0
    samples = os.fsdecode(fields.get(b"ElementDataFile", b""))
    path = file_name if samples == "LOCAL" else os.path.join(os.path.dirname(file_name), samples)
    return os.path.isfile(path) and os.path.getsize(path) < size
