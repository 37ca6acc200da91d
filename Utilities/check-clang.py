#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that clang compiles the sources of a build without a warning.

    Utilities/check-clang.py BUILD [CLANG]

BUILD has the compile_commands.json that every preset writes, with the flags of GCC and -Werror. Sources
are parsed only, those of the library and of the programs; the preset clang builds and tests everything."""

import json
import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = tuple(f"{ROOT}/{name}/" for name in ("Module", "Rendering", "Filters", "IO", "Parallel", "Programs"))


def make_commands(build, clang):
    """One for each source, and one for what is generated of them."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    for entry in entries:
        source = os.path.join(entry["directory"], entry["file"])
        if source.startswith(FOLDERS) or "/TypedImageStructures_" in source:
            words = shlex.split(entry["command"])
            # Before the flags stand the compiler and what launches it.
            flags = words[next(i for i, word in enumerate(words) if word.startswith("-")):]
            output = flags.index("-o")
            del flags[output:output + 2]
            # CMake gives no standard where it is the default of the compiler.
            yield source, entry["directory"], [clang, "-std=gnu++17", *flags,
                                                "-Wno-unknown-warning-option", "-fsyntax-only"]


def check(command):
    source, folder, words = command
    run = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    return source, run.returncode, run.stderr


def main():
    build = Path(sys.argv[1]).resolve()
    clang = sys.argv[2] if len(sys.argv) > 2 else "clang++"
    commands = list(make_commands(build, clang))
    if not commands:
        sys.exit(f"{build} has no sources of the library in compile_commands.json.")
    failed = 0
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        for source, status, messages in threads.map(check, commands):
            if status != 0:
                failed += 1
                print(f"{source}:\n{messages}", file=sys.stderr)
    print(f"{len(commands)} sources, {failed} that {clang} does not compile")
    sys.exit(failed != 0)


if __name__ == "__main__":
    main()
