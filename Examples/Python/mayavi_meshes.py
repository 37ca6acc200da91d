#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Take the meshes out of Debian's package mayavi2, without installing it or what it depends on.

    mayavi_meshes.py data

downloads the package (21 MB) and writes data/disk_out_ref.ex2 (a heated disk in a gas, hexahedra),
data/fire_ug.vtu (a fire in a room, hexahedra) and data/SampleStructGrid.vtk (a curvilinear grid).
Needs apt-get and dpkg-deb, and Python only.
"""

import argparse
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path, PurePosixPath

from whole_file import write_whole

PACKAGE = "mayavi2"
NAMES = ("disk_out_ref.ex2", "fire_ug.vtu", "SampleStructGrid.vtk")


class PackageError(Exception):
    """The package cannot be had, or is not what this program knows."""


def run(command, folder):
    """What a command prints; the last line of its complaints, if it fails."""
    try:
        result = subprocess.run(command, cwd=folder, capture_output=True, check=False)
    except OSError as error:
        raise PackageError(f"{command[0]}: {error.strerror}") from error
    if result.returncode != 0:
        complaints = result.stderr.decode(errors="replace").strip().splitlines()
        raise PackageError(complaints[-1] if complaints else f"{command[0]} fails")
    return result.stdout


def download(folder):
    """The path of the package."""
    run(["apt-get", "-o", "Acquire::http::Timeout=30", "download", PACKAGE], folder)
    packages = list(Path(folder).glob(f"{PACKAGE}_*.deb"))
    if len(packages) != 1:
        raise PackageError("apt-get has downloaded nothing")
    return packages[0]


def extract(package, folder):
    """Write the meshes into the folder; return their paths."""
    content = Path(package.parent, "content.tar")
    content.write_bytes(run(["dpkg-deb", "--fsys-tarfile", str(package)], package.parent))
    folder.mkdir(parents=True, exist_ok=True)
    paths = {}
    with tarfile.open(content) as archive:
        for member in archive:
            name = PurePosixPath(member.name).name
            if member.isfile() and name in NAMES:
                # Names in the archive are never used as paths, so that nothing is written elsewhere.
                paths[name] = folder / name
                mesh = archive.extractfile(member)
                write_whole(paths[name], lambda out, mesh=mesh: shutil.copyfileobj(mesh, out))
    missing = [name for name in NAMES if name not in paths]
    if missing:
        raise PackageError(f"{package.name} has no {', '.join(missing)}")
    return [paths[name] for name in NAMES]


def fetch(folder):
    """The paths of the meshes, which are written into the folder."""
    with tempfile.TemporaryDirectory() as temporary:
        return extract(download(temporary), Path(folder))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where to write the meshes")
    arguments = parser.parse_args()
    try:
        print(*fetch(arguments.folder), sep="\n")
    except (PackageError, tarfile.TarError) as error:
        sys.exit(f"the meshes of Debian's package {PACKAGE} cannot be had: {error}")
    except OSError as error:
        sys.exit(f"{error.filename or arguments.folder}: {error.strerror or error}")


if __name__ == "__main__":
    main()
