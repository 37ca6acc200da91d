#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Lists the classes named vtk... that are declared outside of VTK's ABI namespace. Where VTK is built with
one, a class that is declared outside is another than VTK's, and each use of its name is ambiguous."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("Examples", "Filters", "IO", "Module", "ParaView", "Parallel", "Programs", "Rendering", "Testing")

# A declaration or a definition, at the beginning of a line, as clang-format leaves it.
DECLARATION = re.compile(r"(?:class|struct) (?:\w+_EXPORT )?(vtk\w+)\b(?!::)")


def check_file(path):
    """The declarations that are outside, as lines of text."""
    is_inside = False
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        if line == "VTK_ABI_NAMESPACE_BEGIN":
            is_inside = True
        elif line == "VTK_ABI_NAMESPACE_END":
            is_inside = False
        elif not is_inside and (match := DECLARATION.match(line)):
            yield (f"{path.relative_to(ROOT)}:{number}: {match[1]} must be between "
                   "VTK_ABI_NAMESPACE_BEGIN and VTK_ABI_NAMESPACE_END")


def main():
    files = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*")
                   if path.suffix in (".h", ".inl", ".cxx"))
    violations = [violation for path in files for violation in check_file(path)]
    for violation in violations:
        print(violation)
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
