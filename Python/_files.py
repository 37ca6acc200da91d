# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Volumes and meshes from files."""

from __future__ import annotations

import importlib
import math
import os
import re

from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSetAttributes, vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from ._errors import silence
from ._patient import place

READERS = {
    ".nhdr": "vtkIOImage.vtkNrrdReader",
    ".nii": "vtkIOImage.vtkNIFTIImageReader",
    ".nii.gz": "vtkIOImage.vtkNIFTIImageReader",
    ".nrrd": "vtkIOImage.vtkNrrdReader",
    ".vti": "vtkIOXML.vtkXMLImageDataReader",
    ".vtk": "vtkIOLegacy.vtkGenericDataObjectReader",
    ".vtm": "vtkIOXML.vtkXMLMultiBlockDataReader",
    ".vtr": "vtkIOXML.vtkXMLRectilinearGridReader",
    ".vts": "vtkIOXML.vtkXMLStructuredGridReader",
    ".vtu": "vtkIOXML.vtkXMLUnstructuredGridReader",
}


def read(path: str | os.PathLike) -> vtkDataObject:
    """Read a volume or a mesh.

    Parameters
    ----------
    path : str or os.PathLike
        A file (.vti, .vtr, .vts, .vtu, .vtm, .vtk, .mhd, .mha, .nii, .nii.gz, .nrrd, .nhdr, or another image that
        VTK reads), or a folder of DICOM slices.

    Returns
    -------
    vtkDataObject
        What the file holds, for example a vtkImageData. Those of DICOM and NIfTI have their axes in the patient: x to
        the right, y to the front, z to the head.

    Raises
    ------
    FileNotFoundError
        There is no such file or folder.
    ValueError
        VTK has no reader for it, or it is damaged, or not a volume.
    MemoryError
        It announces more samples than this machine has memory for.
    """
    path = os.fspath(path)
    if not os.path.exists(path):
        raise FileNotFoundError(f"there is no file {path}")
    with silence():
        data = _read_whole(_make_reader(path), path)
    if data is None or isinstance(data, vtkImageData) and not _is_volume(data):
        raise ValueError(f"{path} is damaged, or not a volume")
    return data


def _make_reader(path):
    if os.path.isdir(path):
        reader = _new("vtkIOImage.vtkDICOMImageReader")
        reader.SetDirectoryName(path)
        return reader
    for suffix, name in READERS.items():
        if path.lower().endswith(suffix):
            reader = _new(name)
            break
    else:
        reader = _module("vtkIOImage").vtkImageReader2Factory.CreateImageReader2(path)
    if reader is None:
        raise ValueError(f"VTK has no reader for {path}; read it by another one, and give its data")
    reader.SetFileName(path)
    return reader


def _new(name):
    module, reader = name.split(".")
    return getattr(_module(module), reader)()


def _module(name):
    return importlib.import_module(f"vtkmodules.{name}")


def _read_whole(reader, path):
    """What is in a file; None if it is damaged."""
    errors = []
    for source in (reader, reader.GetExecutive()):
        source.AddObserver("ErrorEvent", lambda *_: errors.append(True))
    reader.UpdateInformation()
    if errors:
        return None
    size = _count_bytes(reader)
    if size > _count_memory():  # VTK ends the process if it cannot allocate it.
        raise MemoryError(f"{path} asks for more memory than this machine has")
    if _is_cut(path, size):
        return None
    reader.Update()
    data = reader.GetOutputDataObject(0)
    if errors or data is None:
        return None
    place(data, reader)
    return data


def _count_bytes(reader):
    """The size of the image that the header announces; 0 for other data."""
    header = reader.GetOutputInformation(0)
    if not header.Has(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT()):
        return 0
    extent = header.Get(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT())
    samples = math.prod(extent[2 * axis + 1] - extent[2 * axis] + 1 for axis in range(3))
    scalars = vtkDataObject.GetActiveFieldInformation(
        header, vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes.SCALARS)
    if scalars is None:
        return samples
    size = vtkDataArray.GetDataTypeSize(scalars.Get(vtkDataObject.FIELD_ARRAY_TYPE()))
    return samples * size * scalars.Get(vtkDataObject.FIELD_NUMBER_OF_COMPONENTS())


def _count_memory():
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):  # not on this system
        return math.inf


def _is_volume(image):
    arrays = image.GetPointData().GetNumberOfArrays() + image.GetCellData().GetNumberOfArrays()
    return (image.GetDataDimension() == 3 and arrays > 0
            and all(0.0 < abs(spacing) < math.inf for spacing in image.GetSpacing()))


def _is_cut(path, size):
    """Whether a MetaImage has fewer bytes: VTK's reader leaves the other samples undefined."""
    if not path.lower().endswith((".mhd", ".mha")):
        return False
    with open(path, "rb") as stream:
        fields = dict(re.findall(rb"^(\w+) *= *(.*?)\s*$", stream.read(4096), re.MULTILINE))
    if fields.get(b"CompressedData", b"").lower() == b"true":
        digits = fields.get(b"CompressedDataSize", b"")
        size = int(digits) if digits.isdigit() else 0
    samples = os.fsdecode(fields.get(b"ElementDataFile", b""))
    file_of_samples = path if samples == "LOCAL" else os.path.join(os.path.dirname(path), samples)
    return os.path.isfile(file_of_samples) and os.path.getsize(file_of_samples) < size
