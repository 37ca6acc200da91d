#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Lists the includes that break the order of the folders (the table in CONTRIBUTING.md)."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

# A folder of the core includes itself and the folders before it.
CORE = "Module/Core"
CORE_FOLDERS = [f"{CORE}/{folder}" for folder in (
    "Math",
    "Rays",
    "Kernels",
    "Field",
    "Image/Lattice",
    "Image/Samples",
    "Image/Macrocells",
    "Image/Cells",
    "Image/Traversal",
    "Image/Tracers",
    "Image",
    "Amr",
    "Mesh",
    "Picture",
)]

# Where includes are looked for, after the folder of the file.
INCLUDE_FOLDERS = (CORE, "Module", "Rendering", "Filters", "IO", "Parallel", "Programs")

INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')


def find_public_headers():
    """The headers of the classes that are installed."""
    text = (ROOT / "Module/module.cmake").read_text(encoding="utf-8")
    (classes,) = re.findall(r"set\(classes\s([^)]*)\)", text)
    return [f"{name}.h" for name in classes.split()]


def make_rules():
    """What each folder may include of this repository: folders and files."""
    rules = {folder: CORE_FOLDERS[: i + 1] for i, folder in enumerate(CORE_FOLDERS)}
    rules[CORE] = []  # for folders that are not in the order
    compat = "Module/vtkIsosurfaceRayTracingCompat.h"
    rules["Rendering"] = [compat, CORE, "Rendering", "IO/FileMapping.h", "IO/MappingsInUse.h"]
    mappers = [f"Rendering/vtkIsosurfaceRayTrace{kind}Mapper.h" for kind in ("", "Mesh")]
    rules["Filters"] = [compat, CORE, "Filters", *mappers]
    rules["Parallel"] = [compat, CORE, "Parallel", *mappers, "Rendering/vtkCellProjectionMapper.h"]
    public_headers = find_public_headers()
    public_headers += [f"Parallel/vtkIsosurface{name}.h" for name in ("GhostBlocks", "RayTraceCompositor")]
    rules["IO"] = [compat, "IO"]
    headers_of_files = [f"IO/{name}.h" for name in (
        "HeaderText", "ImagePlace", "MetaImageHeader", "NiftiHeader", "NrrdHeader", "RawSamples")]
    rules["Programs"] = [compat, "Programs", *headers_of_files, *public_headers]
    rules["Examples"] = ["Examples", *public_headers]
    return rules


def is_below(path, folder):
    return path == folder or path.startswith(folder + "/")


def find_included(path, name):
    """The file of this repository that is included, or None."""
    for folder in (path.parent, *(ROOT / folder for folder in INCLUDE_FOLDERS)):
        included = (folder / name).resolve()
        if included.is_file() and included.is_relative_to(ROOT):
            return included.relative_to(ROOT).as_posix()
    return None


def check_file(path, rules):
    """The violations in a file, as lines of text."""
    file_name = path.relative_to(ROOT).as_posix()
    folder = max((folder for folder in rules if is_below(file_name, folder)), key=len)
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if not match:
            continue
        included = find_included(path, match[1])
        if included is None:
            is_allowed = not (is_below(folder, CORE) and match[1].startswith("vtk"))
        else:
            is_allowed = any(is_below(included, allowed) for allowed in rules[folder])
        if not is_allowed:
            yield f"{file_name}:{number}: {folder} may not include {included or match[1]}"


def main():
    rules = make_rules()
    files = sorted(path for folder in (CORE, "Rendering", "Filters", "IO", "Parallel", "Programs", "Examples")
                   for path in (ROOT / folder).rglob("*") if path.suffix in (".h", ".inl", ".cxx"))
    violations = [violation for path in files for violation in check_file(path, rules)]
    for violation in violations:
        print(violation)
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
