# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Where an image is in a patient: x to the right, y to the front and z to the head, as in NIfTI."""

import math


def place(image, reader):
    """Turn an image as its file says, which VTK's readers of DICOM and NIfTI tell but do not do."""
    kind = reader.GetClassName()
    if kind == "vtkDICOMImageReader":
        _set_axes(image, _axes_of_dicom(reader.GetImageOrientationPatient()))
    elif kind == "vtkNIFTIImageReader":
        matrix = reader.GetQFormMatrix() or reader.GetSFormMatrix()
        if matrix and _set_axes(image, [[matrix.GetElement(row, column) for row in range(3)] for column in range(3)]):
            image.SetOrigin([matrix.GetElement(row, 3) for row in range(3)])


def _axes_of_dicom(orientation):
    """Those of the image, of the directions of rows and columns."""
    along, down = ((-x, -y, z) for x, y, z in (orientation[:3], orientation[3:]))  # DICOM has x to the left, y to the back
    normal = _cross(along, down)
    # VTK begins at the last row, and with the last slice along the normal.
    return [along, [-each for each in down], [-each for each in normal]]


def _set_axes(image, axes):
    """Returns whether they are axes: of length one, and perpendicular."""
    for i, axis in enumerate(axes):
        for j in range(i + 1):
            if not abs(math.fsum(a * b for a, b in zip(axis, axes[j])) - (i == j)) < 1e-3:
                return False
    image.SetDirectionMatrix([axis[row] for row in range(3) for axis in axes])
    return True


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
