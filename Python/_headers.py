# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Where the headers of MetaImage and NRRD files put the samples: VTK's readers leave out the directions of the axes."""

from __future__ import annotations

import gzip
import math
import os
import re
import struct
import zlib
from typing import NamedTuple

import numpy as np

LONGEST = 1 << 16  # bytes; a header has about a dozen short lines
LENGTH_NIFTI = 80  # bytes; so many have the type and the dimensions
LONGEST_TEXT = 1 << 22  # segmentations of NRRD have some lines for each of hundreds of segments, AMR data for each block

# Of MetaImage (MET_LONG is of four bytes there, and VTK takes it for eight) and of NIfTI, what VTK's readers know.
TYPES_OF_METAIMAGE = ("MET_CHAR", "MET_UCHAR", "MET_SHORT", "MET_USHORT", "MET_INT", "MET_UINT", "MET_FLOAT", "MET_DOUBLE")
TYPES_OF_NIFTI = (2, 4, 8, 16, 32, 64, 128, 256, 512, 768, 1024, 1280, 1792, 2304)

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
    header = _header_of_metaimage(path)
    return {name.decode(): value for name, value in re.findall(rb"^(\w+) *[=:] *(.*?)\s*$", header, re.MULTILINE)}


def _header_of_metaimage(path):
    with open(path, "rb") as stream:
        lines = stream.read(LONGEST).partition(b"ElementDataFile")
    return b"".join(lines[:2]) + b"".join(lines[2].partition(b"\n")[:2])


def is_true(value):
    return value[:1] in (b"T", b"t", b"1")


def are_local(fields):
    """Whether the samples are in the file of the header."""
    return fields.get("ElementDataFile") in (b"LOCAL", b"Local", b"local")


def size_of_samples(path, fields):
    """The bytes that a MetaImage has for samples."""
    if are_local(fields):
        return os.path.getsize(path) - len(_header_of_metaimage(path))
    skipped = fields.get("HeaderSize", b"")
    sizes = [os.path.getsize(file) - (int(skipped) if skipped.isdigit() else 0) for file in _files_of_metaimage(path, fields)]
    return min(sizes) * len(sizes)  # All have as many samples.


def _files_of_metaimage(path, fields):
    """Those that have the samples: one, or one for each slice."""
    name = os.fsdecode(fields.get("ElementDataFile", b""))
    if pattern := re.fullmatch(r"([^%]*%0?[1-9]?d[^% ]*) +(\d+) +(\d+)( +[1-9]\d*)?", name):
        form, first, last, step = pattern.groups()
        names = [form % i for i in range(int(first), int(last) + 1, int(step or 1))]
    elif re.fullmatch(r"LIST( +2D)?", name):
        with open(path, "rb") as stream:
            lines = stream.read(LONGEST).partition(b"ElementDataFile")[2].splitlines()
        names = [os.fsdecode(line.strip()) for line in lines[1:] if line.strip()]
    elif name.startswith("LIST") or "%" in name:
        raise ValueError(f"{path} has the ElementDataFile {name!r}, which VTK's reader takes for others than it means; write the "
                         "samples into one file, or each slice into a file in a LIST")
    else:
        names = [name] if name else []
    if not names:
        raise ValueError(f"{path} is damaged: its header names no file of samples")
    return [_find_file_of_samples(path, name) for name in names]


def _find_file_of_samples(path, name):
    """The file that a header names."""
    file = os.path.join(os.path.dirname(path), name)
    if not os.path.exists(file):
        raise ValueError(f"{path} is a header, whose samples are in the file {name}, which is not there; put it beside the header")
    return file


def check_metaimage(path):
    """Refuse files by which VTK's reader ends the process, and those of which it gives other samples than there are."""
    fields = fields_of_metaimage(path)
    for name in ("Comment", "Name", "ObjectSubType"):
        if len(fields.get(name, b"")) > 254:
            raise ValueError(f"{path} has a {name} of more than 254 characters, by which VTK's reader ends the process; "
                             "shorten it")
    kind = fields.get("ElementType", b"").decode("latin-1")
    if kind.startswith("MET_") and kind not in TYPES_OF_METAIMAGE:
        raise ValueError(f"{path} has samples of the type {kind}, which VTK does not read; write them as MET_INT, MET_FLOAT or "
                         "another type of up to 32 bits, or as MET_DOUBLE")
    if is_true(fields.get("CompressedData", b"")) and are_local(fields) and "CompressedDataSize" not in fields:
        raise ValueError(f"{path} has compressed samples without their CompressedDataSize, which VTK's reader needs where they "
                         "are in the file of the header; write them into a file of their own, or not compressed")
    if not is_true(fields.get("BinaryData", b"True")) and fields.get("ElementNumberOfChannels", b"1") != b"1":
        raise ValueError(f"{path} has several components as text, of which VTK's reader takes a part; write them in binary form")
    if not are_local(fields):
        _files_of_metaimage(path, fields)


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


def check_nifti(path):
    """Refuse files by which VTK's reader crashes: of a type that it does not know, or without a positive dimension."""
    header = _header_of_nifti(path)
    is_new = header[4:5] == b"n" and b"2" <= header[6:7] <= b"9"
    type_at, sizes_at, form = (12, 16, "8q") if is_new else (70, 40, "8h")
    if len(header) < LENGTH_NIFTI:  # which the reader tells
        return
    sizes = struct.unpack_from(f"<{form}", header, sizes_at)
    order = "<" if 0 <= sizes[0] <= 7 else ">"
    count, *sizes = struct.unpack_from(order + form, header, sizes_at)
    (kind,) = struct.unpack_from(f"{order}h", header, type_at)
    if kind not in TYPES_OF_NIFTI:
        raise ValueError(f"{path} has samples of the type {kind}, which VTK does not know; write them as float32")
    if not 0 < count < 8 or min(sizes[:count]) < 0 or 0 in sizes[:count][:3] + sizes[4:count]:  # 0 volumes are taken for one
        raise ValueError(f"{path} is damaged: its header has the dimensions {sizes[:max(count, 1)]}")


def _header_of_nifti(path):
    """As much as has the type and the dimensions, or less if there is no more."""
    with open(path, "rb") as stream:
        is_compressed = stream.read(2) == b"\x1f\x8b"
    try:
        with (gzip.open if is_compressed else open)(path, "rb") as stream:
            return stream.read(LENGTH_NIFTI)
    except (EOFError, OSError, zlib.error):
        return b""


def check_xml(path):
    """Refuse files that end before their last samples, or whose pieces do not fill them, and those that name such files: VTK's
    readers leave these samples undefined, or crash."""
    for name in _check_one_xml(path):
        piece = os.path.join(os.path.dirname(path), os.fsdecode(name))
        if os.path.isfile(piece):
            _check_one_xml(piece, is_piece=True)


def _check_one_xml(path, is_piece=False):
    """The names of files in it."""
    with open(path, "rb") as stream:
        text = stream.read(LONGEST_TEXT)
        start = re.search(rb'<AppendedData\s[^>]*"raw"[^>]*>\s*_', text)
        header = text[:start.start()] if start else text
        offsets = re.findall(rb'\soffset\s*=\s*"(\d+)"', header)
        if start and offsets and not _is_whole(stream, header, start.end() + max(map(int, offsets))):
            raise ValueError(f"{path} is damaged: it ends before its last samples")
    if is_piece and not start and text and not _has_end(path):
        raise ValueError(f"{path} is damaged: it has no end (</VTKFile>)")
    if (start or len(text) < LONGEST_TEXT) and not _are_filled(header):
        raise ValueError(f"{path} is damaged: its pieces do not fill its WholeExtent")
    return re.findall(rb'\s(?:file|Source)\s*=\s*"([^"]+)"', header)


def _has_end(path):
    with open(path, "rb") as stream:
        stream.seek(max(0, os.path.getsize(path) - LONGEST))
        return b"</VTKFile>" in stream.read()


def _are_filled(header):
    """Whether pieces have as many cells as the whole of an image or a grid."""
    whole, pieces = (sum(map(_count_cells, re.findall(rb'\s%s\s*=\s*"([^"]*)"' % name, header)))
                     for name in (b"WholeExtent", b"Extent"))  # fmt: skip
    return pieces >= whole


def _count_cells(extent):
    """At least one along an axis with a point."""
    ends = _numbers(extent, 6)
    return math.prod(max(high - low, 1) if low <= high else 0 for low, high in zip(ends[::2], ends[1::2]))


def _is_whole(stream, header, place):
    """Whether the array at a place is not cut off. The number of its bytes, or of those of each block, is before it."""
    size = stream.seek(0, os.SEEK_END)
    kind = np.dtype("u8" if b'"UInt64"' in header.partition(b">")[0] else "u4")

    def take(count):
        stream.seek(place)
        order = ">" if b'"BigEndian"' in header else "<"
        read = stream.read(count * kind.itemsize) if count < size else b""
        return np.frombuffer(read, kind.newbyteorder(order), len(read) // kind.itemsize)

    if len(bytes_or_blocks := take(1)) < 1:
        return False
    count = int(bytes_or_blocks[0])
    if b" compressor=" not in header:
        return place + kind.itemsize + count <= size
    sizes = take(3 + count) if count else bytes_or_blocks
    return count == 0 or len(sizes) == 3 + count and place + sizes.nbytes + int(sizes[3:].sum()) <= size


def check_amr(path):
    """Refuse files by which VTK's reader crashes: of version 1.0, whose levels have no spacing."""
    with open(path, "rb") as stream:
        text = stream.read(LONGEST_TEXT)
    levels = [] if b'"vtkNonOverlappingAMR"' in text else re.findall(rb"<Block\s[^>]*>", text)
    if not all(re.search(rb"\sspacing\s*=", level) for level in levels):
        raise ValueError(f"{path} has levels without a spacing, as files of version 1.0 have, by which VTK's reader crashes; "
                         "convert it by VTK's vtkXMLHierarchicalBoxDataFileConverter")


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
    encoding = fields.get(b"encoding", b"").lower()
    if encoding in (b"ascii", b"text", b"txt"):
        raise ValueError(f"{path} has its samples as text, of which VTK's reader skips some; write them with the encoding "
                         "raw or gzip")
    if encoding not in (b"raw", b"gzip", b"gz"):
        raise ValueError(f"{path} has the encoding {encoding.decode('latin-1')!r}, which VTK does not read; write it with the "
                         "encoding raw or gzip")
    if any(fields.get(name, b"0") != b"0" for name in (b"byte skip", b"byteskip", b"line skip", b"lineskip")):
        raise ValueError(f"{path} has samples after something else that is to be skipped (byte skip or line skip), which VTK "
                         "does not do; write them into a file of their own")
    name = _data_file_of_nrrd(fields)
    if name and b"%" not in name and not name.startswith(b"LIST"):  # Of several files, VTK's reader tells.
        _find_file_of_samples(path, os.fsdecode(name))
    if not _are_parts_first(fields):
        raise ValueError(f"{path} has components, or several volumes, along an axis that is not the first, which VTK's "
                         "reader takes for them, or does not tell the axis (kinds); write one volume")
    if encoding != b"raw":
        _check_compressed_nrrd(path, fields, sizes)
    if len(sizes) == 3 and int(sizes[0]) < 10:
        raise ValueError(f"{path} has three axes, of which VTK's reader takes the first, with fewer than ten samples, for "
                         "components; write a volume with a longer axis first, or with more samples")


def _check_compressed_nrrd(path, fields, sizes):
    """Refuse those that VTK's reader takes for others than they are."""
    remedy = "write them with the encoding raw"
    name = _data_file_of_nrrd(fields)
    length = _bytes_of_sample(fields.get(b"type", b""))
    if len(sizes) > 3 and sizes[0] != b"1":
        raise ValueError(f"{path} has compressed samples of several components, of which VTK's reader takes a part; {remedy}")
    if length > 1 and fields.get(b"endian", b"").lower() == b"big":
        raise ValueError(f"{path} has compressed big-endian samples, whose bytes VTK's reader does not swap; {remedy}")
    if name.startswith(b"LIST") or len(name.split()) > 3:
        raise ValueError(f"{path} has compressed samples in several files, of which VTK's reader takes the first; {remedy}")
    samples = os.path.join(os.path.dirname(path), os.fsdecode(name))
    if name and os.path.getsize(samples) > length * math.prod(map(int, sizes)):
        raise ValueError(f"{path} has compressed samples in a file that is longer than they are without compression, of which "
                         f"VTK's reader takes the beginning for a header; {remedy}")


def _data_file_of_nrrd(fields):
    return fields.get(b"data file", fields.get(b"datafile", b""))


def _bytes_of_sample(kind):
    words = {rb"char|int8": 1, rb"short|int16": 2, rb"double|int64|long ?long": 8}
    return next((size for word, size in words.items() if re.search(word, kind.lower())), 4)


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
    is_raw = fields.get(b"encoding", b"").lower() == b"raw"
    are_rows_reversed = is_raw and space in ("left-anterior-superior", "LAS", "3D-left-handed")
    return Place(to_patient[:, None] * np.transpose(steps), to_patient * origin, are_rows_reversed)


def _header_of_nrrd(path):
    """Its lines, up to an empty one, and whether VTK's reader comes to their end."""
    with open(path, "rb") as stream:
        text = stream.read(LONGEST_TEXT)
    header, *rest = re.split(rb"(?<=\n)\r?\n", text, maxsplit=1)
    return header, bool(rest) or len(text) < LONGEST_TEXT and text.endswith(b"\n")


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
