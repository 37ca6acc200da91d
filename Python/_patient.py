# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Where an image is in a patient: x to the right, y to the front and z to the head, as in NIfTI."""

import warnings

import numpy as np

from ._headers import place_of_metaimage, place_of_nrrd
from ._slices import distances_of

LEFT_OUT = "they are left out, and the samples have the axes of the file"
FROM_DICOM = np.array([-1.0, -1.0, 1.0])  # DICOM has x to the left and y to the back


def place_slices(image, slices):
    """Turn and move an image as its slices of DICOM say, which VTK's reader tells but does not do."""
    along, down = slices[0].orientation * FROM_DICOM
    # VTK begins with the last slice along the normal, and at its last row.
    _set_axes(image, np.transpose([along, -down, -np.cross(along, down)]))
    image.SetSpacing(*slices[0].spacing, np.median(distances_of(slices)))
    rows = image.GetDimensions()[1]
    image.SetOrigin(slices[0].position * FROM_DICOM + down * (rows - 1) * slices[0].spacing[1])


def place_nifti(image, reader, path):
    """The same of NIfTI: by its sform, as of registration, or by its qform."""
    forms = {"sform": reader.GetSFormMatrix(), "qform": reader.GetQFormMatrix()}
    given = [name for name, matrix in forms.items() if matrix]
    taken = next((name for name in given if _set_form(image, forms[name])), None)
    if given and taken != given[0]:
        remedy = f"those of its {taken} are taken" if taken else LEFT_OUT
        warnings.warn(f"{path}: the axes that its {given[0]} gives are not perpendicular; {remedy}", RuntimeWarning,
                      stacklevel=5)


def _set_form(image, matrix):
    axes = np.array([[matrix.GetElement(row, column) for column in range(3)] for row in range(3)])
    scales = np.linalg.norm(axes, axis=0)
    # An sform may have spacings of its own, beside those that the reader has; otherwise these are only rounded.
    spacing = np.where(np.abs(scales - 1.0) < 1e-6, 1.0, scales) * image.GetSpacing()
    return _set_place(image, axes, scales, spacing, [matrix.GetElement(row, 3) for row in range(3)])


def place_by_header(image, path, is_mapped):
    """The same of MetaImage and NRRD, where their headers tell it; of a mapped image the samples are as in the file."""
    name = path.lower()
    if name.endswith((".mhd", ".mha")):
        place = place_of_metaimage(path)
    else:
        place = place_of_nrrd(path) if name.endswith((".nrrd", ".nhdr")) else None
    if place is None or not all(image.GetSpacing()):  # which is an error
        return
    steps, origin = place.steps.copy(), place.origin
    if place.are_rows_reversed and not is_mapped:
        origin = origin + (image.GetDimensions()[1] - 1) * steps[:, 1]
        steps[:, 1] *= -1.0
    spacing = np.linalg.norm(steps, axis=0)
    if not _set_place(image, steps, spacing, spacing, origin):
        warnings.warn(f"{path}: the axes that its header gives are not perpendicular; {LEFT_OUT}", RuntimeWarning,
                      stacklevel=4)


def _set_place(image, axes, lengths, spacing, origin):
    """Take the columns of a matrix, which have these lengths. Returns whether they are perpendicular; else all is left."""
    if not lengths.all() or not _set_axes(image, axes / lengths):
        return False
    image.SetSpacing(spacing)
    image.SetOrigin(origin)
    return True


def _set_axes(image, axes):
    """Take the columns of a matrix. Returns whether they are axes: of length one, and perpendicular."""
    if not np.abs(axes.T @ axes - np.eye(3)).max() < 1e-3:
        return False
    image.SetDirectionMatrix(axes.ravel())
    return True
