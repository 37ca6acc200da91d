#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Lists names of compilers and processors (attributes, built-ins, intrinsics, predefined macros) that are used where
others cannot be tried: outside of Math/Compiler.h and of the vectors of the kernels."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("Module", "Rendering", "Filters", "IO", "Parallel", "Programs")
ALLOWED = re.compile(r"Module/Core/(?:Math/Compiler|Kernels/Vectors\w*)\.h")

COMMENT = re.compile(r"//.*")
# A macro that says on what this is compiled: elsewhere it is not defined, and the #if is false. A comparison of macros
# that are not defined may be true.
TEST_OF_PLATFORM = re.compile(r"\s*#\s*(?:if|ifdef|ifndef|elif)\b(?!.*[=<>])")
NAME_OF_COMPILER = re.compile(r"\b(?:__\w+|_mm\d*_\w+)|\[\[\s*\w+::\w+")


def check_file(path):
    """The names in a file, as lines of text."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        code = COMMENT.sub("", line)
        if TEST_OF_PLATFORM.match(code):
            continue
        for name in NAME_OF_COMPILER.findall(code):
            yield f"{path.relative_to(ROOT)}:{number}: {name} belongs into Module/Core/Math/Compiler.h"


def main():
    files = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*")
                   if path.suffix in (".h", ".inl", ".in", ".cxx")
                   and not ALLOWED.fullmatch(path.relative_to(ROOT).as_posix()))
    violations = [violation for path in files for violation in check_file(path)]
    for violation in violations:
        print(violation)
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
