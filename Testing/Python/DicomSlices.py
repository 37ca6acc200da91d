#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a volume as DICOM slices into a folder that exists: DicomSlices.py VOLUME.mhd FOLDER"""

import struct
import sys
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkMetaImageReader

USUAL = (-1, 0, 0, 0, 1, 0)


def write_dicom_slices(image, folder, orientation=USUAL, slope=1, intercept=0):
    """As few fields as vtkDICOMImageReader needs. In DICOM x is to the left and y to the back of a patient: with this
    orientation of rows and columns, x of the image is to the right, y to the front and z to the head."""
    (columns, rows, slices), spacing, origin = image.GetDimensions(), image.GetSpacing(), image.GetOrigin()
    samples = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(slices, rows, columns)
    samples = samples if samples.itemsize == 1 else samples.astype("<i2")
    (a, b, c), (d, e, f) = orientation[:3], orientation[3:]
    normal = (b * f - c * e, c * d - a * f, a * e - b * d)  # the slices are one behind the other
    for k in range(slices):
        z = origin[2] + spacing[2] * (image.GetExtent()[4] + k)
        syntax = _field(0x2, 0x10, b"UI", b"1.2.840.10008.1.2.1\0")
        content = b"\0" * 128 + b"DICM" + _field(0x2, 0x0, b"UL", struct.pack("<I", len(syntax))) + syntax
        content += _field(0x18, 0x50, b"DS", b"%g" % spacing[2])
        content += _field(0x20, 0xE, b"UI", b"1.2\0")  # of the series
        content += _field(0x20, 0x13, b"IS", b"%d" % k)
        content += _field(0x20, 0x32, b"DS", b"%g\\%g\\%g" % tuple(z * abs(each) for each in normal))
        content += _field(0x20, 0x37, b"DS", b"\\".join(b"%g" % each for each in orientation))
        content += _field(0x28, 0x2, b"US", struct.pack("<H", 1))
        content += _field(0x28, 0x10, b"US", struct.pack("<H", rows))
        content += _field(0x28, 0x11, b"US", struct.pack("<H", columns))
        content += _field(0x28, 0x30, b"DS", b"%g\\%g" % (spacing[1], spacing[0]))
        content += _field(0x28, 0x100, b"US", struct.pack("<H", 8 * samples.itemsize))
        content += _field(0x28, 0x103, b"US", struct.pack("<H", samples.dtype.kind == "i"))
        content += _field(0x28, 0x1052, b"DS", b"%g" % intercept) + _field(0x28, 0x1053, b"DS", b"%g" % slope)
        # DICOM has its rows from the top, which VTK turns over.
        content += _field(0x7FE0, 0x10, b"OW", samples[k, ::-1].tobytes())
        (folder / f"{k:03}.dcm").write_bytes(content)


def _field(group, element, kind, value):
    value += b" " * (len(value) % 2)
    size = struct.pack("<HI", 0, len(value)) if kind == b"OW" else struct.pack("<H", len(value))
    return struct.pack("<HH", group, element) + kind + size + value


if __name__ == "__main__":
    reader = vtkMetaImageReader()
    reader.SetFileName(sys.argv[1])
    reader.Update()
    write_dicom_slices(reader.GetOutput(), Path(sys.argv[2]))
