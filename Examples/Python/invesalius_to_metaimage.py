#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Turn the volume of an InVesalius project into a MetaImage that VTK reads.

    invesalius_to_metaimage.py /usr/share/doc/invesalius-examples/examples/Cranium.inv3 data

writes data/matrix.dat (the samples, as they are in the project) and data/cranium.mhd (a text header
that refers to them). Debian's package invesalius-examples has the project. Needs Python only.

A project has no origin and no orientation. In Cranium the face looks along +y and z is up.
"""

import argparse
import math
import plistlib
import shutil
import sys
import tarfile
import zlib
from pathlib import Path, PurePosixPath

from whole_file import write_whole

BYTES_PER_SAMPLE = 2  # int16, the one type that InVesalius writes

HEADER = """\
ObjectType = Image
NDims = 3
DimSize = {dimensions}
ElementType = MET_SHORT
ElementSpacing = {spacing}
BinaryData = True
BinaryDataByteOrderMSB = False
ElementDataFile = {data_file}
"""


class ProjectError(Exception):
    """The file is not a project that this program can read."""


def find_file(archive, name):
    """The regular file with this name, in any folder of the archive."""
    for member in archive:
        if member.isfile() and PurePosixPath(member.name).name == name:
            return member
    raise ProjectError(f"it contains no {name}")


def read_description(archive):
    """The name of the file of samples, the shape (slowest axis first) and the spacing (x first)."""
    text = archive.extractfile(find_file(archive, "main.plist")).read()
    try:
        project = plistlib.loads(text)
        matrix = project["matrix"]
        shape = [int(n) for n in matrix["shape"]]
        spacing = [float(s) for s in project["spacing"]]
        file_name, sample_type = matrix["filename"], matrix["dtype"]
    except Exception as error:  # a broken property list breaks in many ways
        raise ProjectError(f"its main.plist does not describe a volume ({error!r})") from error
    if sample_type != "int16":
        raise ProjectError(f"its samples are {sample_type}, only int16 is supported")
    if len(shape) != 3 or min(shape) < 1 or len(spacing) != 3 or not min(spacing) > 0:
        raise ProjectError(f"its shape {shape} and spacing {spacing} are not those of a volume")
    return file_name, shape, spacing


def convert(project, folder):
    """Write the samples and their header into the folder; return the path of the header."""
    data_path = folder / "matrix.dat"
    header_path = folder / (project.stem.lower() + ".mhd")
    with tarfile.open(project) as archive:
        file_name, shape, spacing = read_description(archive)
        samples = find_file(archive, file_name)
        expected = math.prod(shape) * BYTES_PER_SAMPLE
        if samples.size != expected:
            raise ProjectError(f"{file_name} has {samples.size} bytes, {shape} needs {expected}")
        folder.mkdir(parents=True, exist_ok=True)
        # Names in the archive are never used as paths, so that nothing is written elsewhere.
        write_whole(data_path, lambda out: shutil.copyfileobj(archive.extractfile(samples), out))
    header = HEADER.format(
        dimensions=" ".join(str(n) for n in reversed(shape)),
        spacing=" ".join(repr(s) for s in spacing),
        data_file=data_path.name,
    )
    write_whole(header_path, lambda out: out.write(header.encode("ascii")))
    return header_path


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("project", type=Path, help="an InVesalius project (.inv3)")
    parser.add_argument("folder", type=Path, help="where to write the MetaImage")
    arguments = parser.parse_args()
    try:
        print(convert(arguments.project, arguments.folder))
    except (ProjectError, tarfile.TarError, zlib.error, EOFError) as error:
        sys.exit(f"{arguments.project} cannot be converted: {error}")
    except OSError as error:
        sys.exit(f"{error.filename or arguments.project}: {error.strerror or error}")


if __name__ == "__main__":
    main()
