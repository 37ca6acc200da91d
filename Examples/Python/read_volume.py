# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Volumes from files, for the other scripts of this folder."""

import math
import os
import re
import sys

from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSetAttributes
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOImage import vtkDICOMImageReader, vtkImageReader2Factory, vtkNIFTIImageReader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader


def read_volume(name):
    """The volume in a file (.vti, .mhd, .nii, .nii.gz or what else VTK reads), or in a folder of DICOM slices;
    the program ends if it cannot be read."""
    if not os.path.exists(name):
        sys.exit(f"there is no file {name}")
    reader = make_reader(name)
    if reader is None:
        sys.exit(f"VTK has no image reader for {name}")
    errors = []
    for source in (reader, reader.GetExecutive()):
        source.AddObserver("ErrorEvent", lambda *_: errors.append(True))
    reader.UpdateInformation()
    # VTK ends the process if it cannot allocate memory.
    if not errors and get_bytes(reader) > os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"):
        sys.exit(f"{name} asks for more memory than this machine has")
    if not errors:
        reader.Update()
    image = reader.GetOutput()
    if errors or not is_volume(image) or is_cut(name, get_bytes(reader)):
        sys.exit(f"{name} is damaged, or not a volume")
    return image


def make_reader(name):
    """That of VTK for a name; null if there is none."""
    if os.path.isdir(name):
        reader = vtkDICOMImageReader()
        reader.SetDirectoryName(name)
        return reader
    if name.endswith(".vti"):
        reader = vtkXMLImageDataReader()
    elif name.endswith((".nii", ".nii.gz")):
        reader = vtkNIFTIImageReader()
    else:
        reader = vtkImageReader2Factory.CreateImageReader2(name)
    if reader is not None:
        reader.SetFileName(name)
    return reader


def get_bytes(reader):
    """The size of the volume that the header announces."""
    header = reader.GetOutputInformation(0)
    extent = header.Get(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT())
    scalars = vtkDataObject.GetActiveFieldInformation(
        header, vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes.SCALARS)
    samples = math.prod(extent[2 * axis + 1] - extent[2 * axis] + 1 for axis in range(3))
    if scalars is None:
        return samples
    size = vtkDataArray.GetDataTypeSize(scalars.Get(vtkDataObject.FIELD_ARRAY_TYPE()))
    return samples * size * scalars.Get(vtkDataObject.FIELD_NUMBER_OF_COMPONENTS())


def is_volume(image):
    return (image.GetDataDimension() == 3 and image.GetPointData().GetScalars() is not None
            and all(0.0 < abs(spacing) < math.inf for spacing in image.GetSpacing()))


def is_cut(file_name, size):
    """Whether a MetaImage has fewer bytes: VTK's reader leaves the other samples undefined."""
    if not file_name.endswith((".mhd", ".mha")):
        return False
    with open(file_name, "rb") as stream:
        fields = dict(re.findall(rb"^(\w+) *= *(.*?)\s*$", stream.read(4096), re.MULTILINE))
    if fields.get(b"CompressedData", b"").lower() == b"true":
        digits = fields.get(b"CompressedDataSize", b"")
        size = int(digits) if digits.isdigit() else 0
    samples = os.fsdecode(fields.get(b"ElementDataFile", b""))
    path = file_name if samples == "LOCAL" else os.path.join(os.path.dirname(file_name), samples)
    return os.path.isfile(path) and os.path.getsize(path) < size
