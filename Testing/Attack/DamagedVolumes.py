# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Small volumes in files of several formats, and the same files damaged: each seed has its own damage,
the same in every run."""

import gzip
import math
import random
import zlib
from pathlib import Path

from vtkmodules.vtkCommonCore import VTK_SHORT
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkNIFTIImageWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

EDGE = 12
METAIMAGE = """\
ObjectType = Image
NDims = 3
BinaryData = True
BinaryDataByteOrderMSB = False
CompressedData = {compressed}
TransformMatrix = 1 0 0 0 1 0 0 0 1
Offset = 0 0 0
ElementSpacing = 1 1 1
DimSize = {edge} {edge} {edge}
HeaderSize = 0
ElementNumberOfChannels = 1
ElementType = MET_SHORT
ElementDataFile = {data_file}
"""

# What numbers and words of a header become.
NUMBERS = ["0", "-1", "1", "2", "3", "65536", "1000000", "2147483647", "-2147483648", "4294967296",
           "99999999999999999999", "1e9", "1e300", "1e-300", "nan", "-inf", "x", ""]
WORDS = ["LIST", "LIST 7", "LOCAL", "True", "ball.raw", ".", "nothing.raw", "/dev/zero",
         "ball%s%n.raw 1 3 1", "ball%d.raw 1 999999999 0", "ball%99999999d.raw 1 9 1", "MET_DOUBLE",
         "MET_LONG_LONG", "MET_STRING", "MET_CHAR", "MET_FLOAT_MATRIX", "double", "gzip", "ascii",
         "Float64"]  # fmt: skip


def new_ball():
    """Ten times the distance from the middle: isovalue 40 is a ball."""
    image = vtkImageData()
    image.SetDimensions(EDGE, EDGE, EDGE)
    image.AllocateScalars(VTK_SHORT, 1)
    for i in range(image.GetNumberOfPoints()):
        distance = math.dist(image.GetPoint(i), 3 * (0.5 * (EDGE - 1),))
        image.GetPointData().GetScalars().SetValue(i, round(10 * distance))
    return image


def write(writer, image, path):
    writer.SetInputData(image)
    writer.SetFileName(str(path))
    writer.Write()
    return path.read_bytes()


def make_whole_files(folder):
    """The bytes of whole files by their names; ball.raw, to which ball.mhd refers, stays there."""
    folder = Path(folder)
    image = new_ball()
    samples = memoryview(image.GetPointData().GetScalars()).tobytes()
    (folder / "ball.raw").write_bytes(samples)
    packed = zlib.compress(samples)

    def metaimage(data_file, packed=b""):
        compressed = f"True\nCompressedDataSize = {len(packed)}" if packed else False
        return METAIMAGE.format(compressed=compressed, edge=EDGE, data_file=data_file).encode("ascii")

    compressed = vtkXMLImageDataWriter()
    text = vtkXMLImageDataWriter()
    text.SetDataModeToAscii()
    nifti = write(vtkNIFTIImageWriter(), image, folder / "whole.nii")
    return {
        "header.mhd": metaimage("ball.raw"),
        "local.mha": metaimage("LOCAL") + samples,
        "packed.mha": metaimage("LOCAL", packed) + packed,
        "compressed.vti": write(compressed, image, folder / "whole.vti"),
        "text.vti": write(text, image, folder / "whole.vti"),
        "raw.nii": nifti,
        "packed.nii.gz": gzip.compress(nifti, mtime=0),
    }


def change_word(draw, data):
    """A word of the header, which is the first half of a file or less, becomes another."""
    lines = data.split(b"\n")
    line = draw.randrange(min(len(lines), 16))
    words = lines[line].split(b" ")
    new = draw.choice(NUMBERS if draw.random() < 0.7 else WORDS)
    words[draw.randrange(len(words))] = new.encode("ascii")
    lines[line] = b" ".join(words)
    return b"\n".join(lines)


def change_number(draw, data):
    """Four bytes of the header become a number that is small, large or negative."""
    place = draw.randrange(min(len(data), 352))
    number = draw.choice((0, 1, 2, 3, 100, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF,
                          0x7FC00000, 0x7F800000))  # fmt: skip
    return data[:place] + number.to_bytes(4, "little") + data[place + 4 :]


def flip_bytes(draw, data):
    damaged = bytearray(data)
    for _ in range(draw.randrange(1, 9)):
        end = draw.choice((64, 512, len(data)))
        damaged[draw.randrange(min(end, len(data)))] = draw.randrange(256)
    return bytes(damaged)


def cut(draw, data):
    return data[: draw.randrange(len(data))]


def repeat_line(draw, data):
    lines = data.split(b"\n")
    line = draw.randrange(min(len(lines), 16))
    lines.insert(draw.randrange(min(len(lines), 16)), lines[line])
    return b"\n".join(lines)


def drop_line(draw, data):
    lines = data.split(b"\n")
    del lines[draw.randrange(min(len(lines), 16))]
    return b"\n".join(lines)


DAMAGES = (change_word, change_word, change_word, change_number, flip_bytes, cut, repeat_line, drop_line)


def damage(files, seed):
    """The name and the bytes of the file of a seed."""
    draw = random.Random(seed)
    name = draw.choice(sorted(files))
    data = files[name]
    if name.endswith(".gz") and draw.random() < 0.7:
        data = gzip.compress(draw.choice(DAMAGES)(draw, gzip.decompress(data)), mtime=0)
    else:
        for _ in range(draw.choice((1, 1, 1, 2, 3))):
            data = draw.choice(DAMAGES)(draw, data) if data else data
    return f"{seed}-{name}", data
