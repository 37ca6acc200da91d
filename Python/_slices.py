# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The files of a folder of DICOM slices: VTK's reader takes any for a volume, and trusts what the last one says."""

import contextlib
import os
import tempfile
import warnings
from typing import NamedTuple

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_FLOAT, VTK_SHORT, VTK_UNSIGNED_CHAR, vtkVersion
from vtkmodules.vtkIOImage import vtkDICOMImageReader

SYNTAXES = ("1.2.840.10008.1.2", "1.2.840.10008.1.2.1")  # uncompressed, the least significant byte first
REMEDY = "convert them by dcm2niix, and read the .nii file that it writes"


class Slice(NamedTuple):
    name: str
    kind: tuple  # what is the same in all slices of a volume
    orientation: np.ndarray  # directions along rows and down columns; in DICOM x is to the left, y to the back
    position: np.ndarray  # of the first sample
    spacing: tuple  # of samples in a row, and of rows
    stored: range  # the samples that the file may have
    slope: float
    intercept: float


def find_slices(folder):
    """The slices in a folder, in the order of VTK: from the last one along the normal."""
    slices = [each for name in sorted(os.listdir(folder)) for each in _read_header(os.path.join(folder, name), name)]
    if not slices:
        raise ValueError(f"{folder} has no DICOM slices; name the folder that the slices are in")
    first = slices[0]
    for each in slices:
        if each.kind != first.kind or np.abs(each.orientation - first.orientation).max() > 1e-3:
            raise ValueError(f"{folder} has slices of different sizes, directions or types, as {first.name} and "
                             f"{each.name}; put each series into a folder of its own, or {REMEDY}")
    if len(slices) < 2:
        raise ValueError(f"{folder} has one slice, {first.name}; if there are several in it, {REMEDY}")
    normal = np.cross(*first.orientation)
    slices.sort(key=lambda each: -each.position @ normal)
    distances = distances_of(slices)
    if distances.min() < 1e-3 * distances.max() or not distances.max() > 0.0:
        raise ValueError(f"{folder} has several slices at one place, or does not tell the places; put each series "
                         f"into a folder of its own, or {REMEDY}")
    return slices


@contextlib.contextmanager
def only_files(folder):
    """A folder without pipes, for which VTK's reader would wait: the same, or one of links to its files."""
    with os.scandir(folder) as entries:
        files = [each for each in entries if not each.is_dir()]
    if all(each.is_file() for each in files):
        yield folder
        return
    with tempfile.TemporaryDirectory() as links:
        for each in files:
            if each.is_file():
                os.symlink(os.path.abspath(each.path), os.path.join(links, each.name))
        yield links


def correct_values(folder, data, slices):
    """VTK's reader scales samples to their own type: others are left of values that do not fit. Where it makes floating-point
    numbers of them, it takes signed samples for unsigned ones."""
    values = vtk_to_numpy(data.GetPointData().GetScalars()).reshape(len(slices), -1)
    for each, scaled in zip(slices, values):
        if data.GetScalarType() == VTK_FLOAT:
            _restore_negative(each, scaled)
        elif data.GetScalarType() == VTK_SHORT and not _fit_16_bits(each, scaled.astype(np.int64)):
            raise ValueError(f"{os.path.join(folder, each.name)} may have values that do not fit the 16 bits that VTK "
                             f"scales them to; {REMEDY}")
        elif data.GetScalarType() == VTK_UNSIGNED_CHAR and (each.slope, each.intercept, each.stored[0]) != (1.0, 0.0, 0):
            raise ValueError(f"{os.path.join(folder, each.name)} may have values that do not fit the 8 bits that VTK "
                             f"scales them to; {REMEDY}")


def _restore_negative(each, scaled):
    """Changes values in place."""
    if each.stored[0] < 0 and each.slope != 0.0:
        stored = np.rint((scaled.astype(float) - each.intercept) / each.slope)
        is_negative = stored > each.stored[-1]
        scaled[is_negative] = (stored[is_negative] - len(each.stored)) * each.slope + each.intercept


def _fit_16_bits(each, scaled):
    slope, intercept = int(each.slope), int(each.intercept)
    ends = np.array([each.stored[0], each.stored[-1]]) * slope + intercept
    if slope == 0 or ends.min() >= -(2**15) and ends.max() < 2**15:
        return True
    stored, rest = np.divmod(scaled - intercept, slope)
    # Nobody sees that of slopes like 2.
    is_seen = abs(slope) == 1 or 2**16 % slope != 0
    return is_seen and not rest.any() and stored.min() >= each.stored[0] and stored.max() <= each.stored[-1]


def distances_of(slices):
    """From each slice to the next, along the normal."""
    positions = np.array([each.position for each in slices])
    return -np.diff(positions, axis=0) @ np.cross(*slices[0].orientation)


def warn_of_distances(folder, slices):
    """Of slices that are missing, and of a gantry that was tilted."""
    distances, step = distances_of(slices), np.median(distances_of(slices))
    for index in np.flatnonzero(np.abs(distances - step) > 0.05 * step)[:1]:
        warnings.warn(
            f"{folder}: slices are missing, or are not evenly spaced: from {slices[index].name} to "
            f"{slices[index + 1].name} it is {distances[index]:g} mm, elsewhere {step:g}; they are drawn as if it were "
            f"{step:g} everywhere", RuntimeWarning, stacklevel=4)
    steps = np.diff([each.position for each in slices], axis=0)
    shift = np.abs(steps @ np.transpose(slices[0].orientation)).sum(axis=0).max()
    if shift > max(slices[0].spacing):
        warnings.warn(
            f"{folder}: the slices are shifted against each other by up to {shift:g} mm, as those of a tilted gantry; "
            f"this is not corrected: {REMEDY}", RuntimeWarning, stacklevel=4)


def _read_header(path, name):
    """Of a file that is not a slice, nothing."""
    reader = vtkDICOMImageReader()
    if not os.path.isfile(path) or not reader.CanReadFile(os.fsencode(path)):
        return
    reader.SetFileName(os.fsencode(path))
    reader.UpdateInformation()
    syntax = reader.GetTransferSyntaxUID()
    if syntax and syntax not in SYNTAXES:
        raise ValueError(f"{path} is compressed or big-endian (transfer syntax {syntax}), which VTK does not read; "
                         "convert the slices by dcm2niix, and read the .nii file that it writes")
    if not reader.GetWidth() or not reader.GetHeight():  # a directory, or a report
        return
    kind = (reader.GetWidth(), reader.GetHeight(), reader.GetDataScalarType(), reader.GetNumberOfComponents())
    bits = reader.GetWidth() * reader.GetHeight() * reader.GetNumberOfComponents() * reader.GetBitsAllocated()
    if 8 * os.path.getsize(path) < bits:  # VTK leaves the other samples undefined.
        raise ValueError(f"{path} is damaged: it ends before its last samples")
    # DICOM has the distance of rows first, which VTK knows since 9.6.
    along, down, _ = reader.GetPixelSpacing()
    if (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) < (9, 6):
        along, down = down, along
    values = 1 << reader.GetBitsAllocated()
    least = -values // 2 if reader.GetPixelRepresentation() == 1 else 0
    yield Slice(name, kind, np.reshape(reader.GetImageOrientationPatient(), (2, 3)),
                np.array(reader.GetImagePositionPatient()), (along, down), range(least, least + values),
                reader.GetRescaleSlope(), reader.GetRescaleOffset())
