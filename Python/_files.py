# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Volumes and meshes from files."""

from __future__ import annotations

import importlib
import math
import os
import warnings
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSetAttributes, vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from ._errors import silence
from ._headers import check_amr, check_metaimage, check_nifti, check_nrrd, check_xml, fields_of_metaimage, is_true, size_of_samples
from ._patient import place_by_header, place_nifti, place_slices
from ._slices import correct_values, find_slices, only_files, warn_of_distances
from .vtkIsosurfaceRayTracing import vtkMappedImageReader

READERS = {
    ".nhdr": "vtkIOImage.vtkNrrdReader",
    ".nii": "vtkIOImage.vtkNIFTIImageReader",
    ".nii.gz": "vtkIOImage.vtkNIFTIImageReader",
    ".nrrd": "vtkIOImage.vtkNrrdReader",
    ".pvti": "vtkIOXML.vtkXMLPImageDataReader",
    ".pvtr": "vtkIOXML.vtkXMLPRectilinearGridReader",
    ".pvts": "vtkIOXML.vtkXMLPStructuredGridReader",
    ".pvtu": "vtkIOXML.vtkXMLPUnstructuredGridReader",
    ".vti": "vtkIOXML.vtkXMLImageDataReader",
    ".vtk": "vtkIOLegacy.vtkGenericDataObjectReader",
    ".vth": "vtkIOXML.vtkXMLUniformGridAMRReader",
    ".vthb": "vtkIOXML.vtkXMLUniformGridAMRReader",
    ".vtm": "vtkIOXML.vtkXMLMultiBlockDataReader",
    ".vtr": "vtkIOXML.vtkXMLRectilinearGridReader",
    ".vts": "vtkIOXML.vtkXMLStructuredGridReader",
    ".vtu": "vtkIOXML.vtkXMLUnstructuredGridReader",
}

COLORS_OF_NIFTI = (128, 2304)  # DT_RGB24 and DT_RGBA32, which are not scaled

# What VTK reports, by nothing that can be observed, of files that end before their last samples, and of errors of a reader
# in another one.
DAMAGES = ("ERROR: ", "Error reading ascii data", "Error reading binary data", "File operation failed")


def read(path: str | os.PathLike) -> vtkDataObject:
    """Read a volume or a mesh.

    Parameters
    ----------
    path : str or os.PathLike
        A file (.vti, .vtr, .vts, .vtu, .pvti, .pvtr, .pvts, .pvtu, .vtm, .vth, .vthb, .vtk, .mhd, .mha, .nii,
        .nii.gz, .nrrd, .nhdr, or another image that VTK reads), or a folder of DICOM slices.

    Returns
    -------
    vtkDataObject
        What the file holds, for example a vtkImageData.

        Images from DICOM and NIfTI, and from NRRD and MetaImage files that specify an anatomical orientation (space,
        AnatomicalOrientation), have the axes and the origin of the patient: x to the right, y to the front, z to the head.
        Images from other NRRD and MetaImage files have the axes that the file gives. If a NIfTI file has several volumes, the
        first is read. Values are scaled as specified by DICOM and NIfTI (scl_slope, scl_inter).

        Images of more than half the memory are not read, but mapped (see vtkMappedImageReader), if the file is an uncompressed
        MetaImage or NRRD, or a .vti with raw appended data, of which only the active scalars are used.

    Raises
    ------
    FileNotFoundError
        There is no such file or folder.
    ValueError
        There is no reader for the file, the file is damaged or not a volume, or the folder does not have the slices of one
        series.
    MemoryError
        The header announces more samples than this process may have memory for, and the file cannot be mapped.

    Warns
    -----
    RuntimeWarning
        Something is left out or missing: further volumes of a NIfTI file, axes that are not perpendicular, missing slices.
    """
    path = os.fspath(path)
    if not os.path.exists(path):
        raise FileNotFoundError(f"there is no file {path}")
    if not os.path.isfile(path) and not os.path.isdir(path):
        raise ValueError(f"{path} is neither a file nor a folder, but a pipe or a device; write a file")
    if os.path.isfile(path) and os.path.getsize(path) == 0:
        raise ValueError(f"{path} is empty")
    with silence():
        data = _read_slices(path) if os.path.isdir(path) else _read_whole(_make_reader(path), path)
    if isinstance(data, vtkImageData) and data.GetNumberOfPoints() > 0 and data.GetDataDimension() < 3:
        size = " x ".join(map(str, data.GetDimensions()))
        raise ValueError(f"{path} is not a volume: it has {size} samples, and two or more are needed on each axis")
    if data is None or isinstance(data, vtkImageData) and not _is_volume(data):
        raise ValueError(f"{path} is damaged, or not a volume")
    return data


def _read_slices(folder):
    slices = find_slices(folder)
    reader = _new("vtkIOImage.vtkDICOMImageReader")
    with only_files(folder) as files:
        reader.SetDirectoryName(os.fsencode(files))
        data = _read_whole(reader, folder)
    if data is not None:
        if data.GetDimensions()[2] != len(slices):
            raise ValueError(f"{folder} has {len(slices)} slices, of which VTK's reader takes {data.GetDimensions()[2]} "
                             "for one series; put each series into a folder of its own")
        correct_values(folder, data, slices)
        place_slices(data, slices)
        warn_of_distances(folder, slices)
    return data


def _make_reader(path):
    for suffix, name in READERS.items():
        if path.lower().endswith(suffix):
            reader = _new_in_one_process(name)
            break
    else:
        reader = _module("vtkIOImage").vtkImageReader2Factory.CreateImageReader2(os.fsencode(path))
        # It takes any file for its own.
        if reader is not None and reader.GetClassName() == "vtkHDRReader" and not path.lower().endswith((".hdr", ".pic")):
            reader = None
    if reader is None and _new("vtkIOImage.vtkDICOMImageReader").CanReadFile(os.fsencode(path)):
        raise ValueError(f"{path} is a file of DICOM; name the folder that the slices are in")
    if path.lower().endswith((".mhd", ".mha")):
        check_metaimage(path)
    if reader is not None and reader.IsA("vtkNrrdReader"):
        check_nrrd(path)
    if reader is not None and reader.IsA("vtkNIFTIImageReader"):
        check_nifti(path)
    if reader is not None and reader.IsA("vtkXMLReader"):
        check_xml(path)
    if reader is not None and reader.IsA("vtkXMLUniformGridAMRReader"):
        check_amr(path)
        reader.SetMaximumLevelsToReadByDefault(0)  # all
    if reader is not None and reader.IsA("vtkDataReader"):
        for kind in ("Scalars", "Vectors", "Fields"):
            getattr(reader, f"ReadAll{kind}On")()
    if reader is None:
        raise ValueError(f"read() does not know {path}; read it by a reader of VTK, as vtkExodusIIReader, and give its "
                         "output, or give a numpy array")
    reader.SetFileName(os.fsencode(path))  # Names that are not UTF-8 have no other form for VTK.
    return reader


def _new_in_one_process(name):
    """Where vtkIOMPIImage is loaded, as by "import vtk", object factories make a reader of NRRD that needs a controller,
    and waits for all of its processes."""
    reader = _new(name)
    if reader.IsA("vtkPNrrdReader"):
        reader = _new("vtkIOMPIImage.vtkPNrrdReader")  # Python knows its methods then.
        reader.SetController(_new("vtkParallelCore.vtkDummyController"))
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
    size, memory = _count_bytes(reader), _count_memory()
    if size > memory / 2 and (mapped := _map(reader, path)):
        return mapped
    if size > memory:  # VTK ends the process if it cannot allocate it.
        raise MemoryError(f"{path} asks for more memory than this process may have; an uncompressed MetaImage or NRRD file, "
                          "or a .vti file with raw appended data, needs none")
    if _is_cut(path, size):
        return None
    with silence() as reports:
        reader.Update()
    data = reader.GetOutputDataObject(0)
    if errors or data is None or _tell_of_damage(reports.GetOutput()):
        return None
    if reader.GetClassName() == "vtkNIFTIImageReader":
        _finish_nifti(data, reader, path)
    else:
        place_by_header(data, path, is_mapped=False)
    return data


def _map(reader, path):
    """The image in a file, whose samples stay there; None if they cannot. (Those of NIfTI are scaled.)"""
    mapped = vtkMappedImageReader()
    if reader.GetClassName() == "vtkNIFTIImageReader" or not mapped.CanReadFile(os.fsencode(path)):
        return None
    mapped.SetFileName(os.fsencode(path))
    mapped.Update()
    place_by_header(mapped.GetOutput(), path, is_mapped=True)
    return mapped.GetOutput()


def _finish_nifti(image, reader, path):
    """What VTK's reader tells and does not do."""
    place_nifti(image, reader, path)
    slope, intercept = reader.GetRescaleSlope(), reader.GetRescaleIntercept()
    is_scaled = (slope, intercept) != (1.0, 0.0) and slope != 0.0 and math.isfinite(slope) and math.isfinite(intercept)
    if is_scaled and reader.GetNIFTIHeader().GetDataType() not in COLORS_OF_NIFTI:
        values = vtk_to_numpy(image.GetPointData().GetScalars())
        scaled = numpy_to_vtk((values * slope + intercept).astype(np.result_type(values, np.float32)))
        scaled.SetName(image.GetPointData().GetScalars().GetName())
        image.GetPointData().SetScalars(scaled)
    header = reader.GetNIFTIHeader()
    if header.GetDim(0) > 3 and header.GetDim(4) > 1:
        warnings.warn(f"{path} has {header.GetDim(4)} volumes; this is the first of them", RuntimeWarning, stacklevel=4)


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
    """The bytes that this machine has, or that this process may have of them, as in a container."""
    try:
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):  # not on this system
        memory = math.inf
    return min([memory, *_limits_of_groups(Path("/"))])


def _limits_of_groups(root):
    """Those of memory, of the control groups of Linux that this process is in."""
    try:
        groups = (root / "proc/self/cgroup").read_text(encoding="utf-8").splitlines()
    except OSError:
        return
    for line in groups:
        _, controllers, group = line.split(":", 2)
        if controllers in ("", "memory"):  # of version 2 and of version 1
            top = root / "sys/fs/cgroup" / controllers
            folder = top / group.lstrip("/")
            # What a container sees of the groups may begin below its own name.
            while top in (folder, *folder.parents):
                for name in ("memory.max", "memory.limit_in_bytes"):
                    try:
                        yield int((folder / name).read_text(encoding="ascii"))
                    except (OSError, ValueError):  # "max"
                        pass
                folder = folder.parent


def _is_volume(image):
    arrays = image.GetPointData().GetNumberOfArrays() + image.GetCellData().GetNumberOfArrays()
    return (image.GetDataDimension() == 3 and arrays > 0
            and all(0.0 < abs(spacing) < math.inf for spacing in image.GetSpacing()))


def _is_cut(path, size):
    """Whether a MetaImage has fewer bytes: VTK's reader leaves the other samples undefined."""
    if not path.lower().endswith((".mhd", ".mha")):
        return False
    fields = fields_of_metaimage(path)
    if is_true(fields.get("CompressedData", b"")):
        digits = fields.get("CompressedDataSize", b"")
        size = int(digits) if digits.isdigit() else 0
    elif not is_true(fields.get("BinaryData", b"True")):
        size /= 4  # A sample of up to eight bytes is at least a digit and a space.
    return size_of_samples(path, fields) < size


def _tell_of_damage(reports):
    """Whether it is among what VTK has reported, which need not be UTF-8."""
    text = reports if isinstance(reports, str) else reports.decode("latin-1")
    return any(damage in text for damage in DAMAGES)
