# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Files of VTK's XML format for images that vtkMappedImageReader can map."""

from vtkmodules.vtkIOXML import vtkXMLImageDataWriter


def write_vti(path, image, has_long_sizes=True):
    """With raw appended data; for those to begin at a multiple of 8, the element before them has spaces."""
    writer = vtkXMLImageDataWriter()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt64() if has_long_sizes else writer.SetHeaderTypeToUInt32()
    writer.SetInputData(image)
    writer.SetFileName(str(path))
    writer.Write()
    header, samples = path.read_bytes().split(b"<AppendedData", 1)
    begin = len(header) + len(b"<AppendedData") + samples.index(b"_") + 1 + (8 if has_long_sizes else 4)
    path.write_bytes(header + -begin % 8 * b" " + b"<AppendedData" + samples)
