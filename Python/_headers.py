# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Where the headers of MetaImage and NRRD files put the samples: VTK's readers leave out the directions of the axes."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

LONGEST = 1 << 16  # bytes; a header has about a dozen short lines
LONGEST_NRRD = 1 << 22  # segmentations have some lines for each of hundreds of segments

# Of the spaces of NRRD that a patient is in, what turns them to x to the right, y to the front and z to the head.
SPACES = {
    "right-anterior-superior": (1, 1, 1), "ras": (1, 1, 1),
    "left-anterior-superior": (-1, 1, 1), "las": (-1, 1, 1),
    "left-posterior-superior": (-1, -1, 1), "lps": (-1, -1, 1),
}  # fmt: skip


class Place(NamedTuple):
    steps: np.ndarray  # the columns lead from a sample to the next one along each axis of the file
    origin: np.ndarray  # of the first sample of the file
    are_rows_reversed: bool  # by VTK's reader


def fields_of_metaimage(path):
    """The lines "name = value" up to the samples."""
    with open(path, "rb") as stream:
        lines = stream.read(LONGEST).partition(b"ElementDataFile")
    header = b"".join(lines[:2]) + lines[2].partition(b"\n")[0]
    return {name.decode(): value for name, value in re.findall(rb"^(\w+) *[=:] *(.*?)\s*$", header, re.MULTILINE)}


def check_metaimage(path):
    """Refuse files by which VTK's reader ends the process."""
    fields = fields_of_metaimage(path)
    for name in ("Comment", "Name", "ObjectSubType"):
        if len(fields.get(name, b"")) > 254:
            raise ValueError(f"{path} has a {name} of more than 254 characters, by which VTK's reader ends the process; "
                             "shorten it")


def place_of_metaimage(path):
    """None if the header tells nothing of directions or of a patient. (Its coordinates are those of ITK, then.)"""
    fields = fields_of_metaimage(path)
    matrix = _first_of(fields, "TransformMatrix", "Rotation", "Orientation")
    is_in_patient = re.fullmatch(rb"(?i)(?=.*[RL])(?=.*[AP])(?=.*[IS])...", fields.get("AnatomicalOrientation", b""))
    if matrix is None and not is_in_patient:
        return None
    to_patient = np.array((-1, -1, 1) if is_in_patient else (1, 1, 1))
    # Each row is the direction of one axis.
    axes = np.eye(3) if matrix is None else _numbers(matrix, 9).reshape(3, 3).T
    spacing = _numbers(_first_of(fields, "ElementSpacing", "ElementSize") or b"1 1 1", 3)
    origin = _numbers(_first_of(fields, "Offset", "Position", "Origin") or b"0 0 0", 3)
    return Place(to_patient[:, None] * axes * np.abs(spacing), to_patient * origin, False)


def check_nrrd(path):
    """Refuse files of which VTK's reader gives other samples than there are."""
    header, has_end = _header_of_nrrd(path)
    if b"\0" in header or not has_end:
        raise ValueError(f"{path} is damaged, or no NRRD: its header has no end (an empty line, or a last line that ends)")
    fields = _fields_of_nrrd(header)
    sizes = fields.get(b"sizes", b"").split()
    if not sizes or fields.get(b"dimension") != b"%d" % len(sizes) or not all(each.isdigit() and int(each) for each in sizes):
        raise ValueError(f"{path} is damaged: its header has no sizes, or not as many as the dimension")
    if list(fields).index(b"dimension") > list(fields).index(b"sizes"):
        raise ValueError(f"{path} is damaged: its header has no dimension before its sizes")
    if fields.get(b"encoding", b"").lower() in (b"ascii", b"text", b"txt"):
        raise ValueError(f"{path} has its samples as text, of which VTK's reader skips some; write them with the encoding "
                         "raw or gzip")
    if not _are_parts_first(fields):
        raise ValueError(f"{path} has components, or several volumes, along an axis that is not the first, which VTK's "
                         "reader takes for them, or does not tell the axis (kinds); write one volume")
    if len(sizes) == 3 and int(sizes[0]) < 10:
        raise ValueError(f"{path} has three axes, of which VTK's reader takes the first, with fewer than ten samples, for "
                         "components; write a volume with a longer axis first, or with more samples")


def _are_parts_first(fields):
    """Whether components, or volumes, are along the first axis, if there are any."""
    sizes = fields.get(b"sizes", b"").split()
    are_parts = [each == b"none" for each in re.findall(rb"none|\(", fields.get(b"space directions", b""))]
    if not are_parts and len(sizes) > 3:
        are_parts = [each not in (b"space", b"domain") for each in fields.get(b"kinds", b"").split()]
    # Where the header does not tell, fewer than ten are components, as VTK's reader has it.
    is_first = are_parts[0] if are_parts else bool(sizes) and len(sizes[0]) == 1
    return not any(are_parts[1:]) and (len(sizes) < 4 or len(sizes) == 4 and is_first)


def place_of_nrrd(path):
    """None if the header tells nothing of directions."""
    fields = _fields_of_nrrd(_header_of_nrrd(path)[0])
    if b"space directions" not in fields:
        return None
    space = fields.get(b"space", b"").decode("latin-1")
    to_patient = np.array(SPACES.get(space.lower(), (1, 1, 1)))
    # Axes that are not in space, as that of the components, have "none".
    vectors = re.findall(rb"\(([^)]*)\)", fields[b"space directions"])
    steps = [_numbers(vector, 3) for vector in vectors] if len(vectors) == 3 else np.zeros((3, 3))
    origin = _numbers(fields.get(b"space origin", b"0 0 0").strip(b"()"), 3)
    are_rows_reversed = space in ("left-anterior-superior", "LAS", "3D-left-handed")
    return Place(to_patient[:, None] * np.transpose(steps), to_patient * origin, are_rows_reversed)


def _header_of_nrrd(path):
    """Its lines, up to an empty one, and whether VTK's reader comes to their end."""
    with open(path, "rb") as stream:
        text = stream.read(LONGEST_NRRD)
    header, *rest = re.split(rb"(?<=\n)\r?\n", text, maxsplit=1)
    return header, bool(rest) or len(text) < LONGEST_NRRD and text.endswith(b"\n")


def _fields_of_nrrd(header):
    return dict(re.findall(rb"^([^#:\n]*): +(.*?)\s*$", header, re.MULTILINE))


def _first_of(fields, *names):
    return next((fields[name] for name in names if name in fields), None)


def _numbers(text, count):
    """Zeros, which are no axes, if there are others."""
    try:
        numbers = np.array(text.replace(b",", b" ").split(), dtype=float)
    except ValueError:
        return np.zeros(count)
    return numbers if numbers.size == count and np.isfinite(numbers).all() else np.zeros(count)
