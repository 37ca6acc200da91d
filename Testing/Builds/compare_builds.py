#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compare all pictures and hits of two builds, bit for bit: compare_builds.py OLD_BUILD NEW_BUILD

Every scene of record_build.py is made by both builds, with each instruction set, and with settings
that must not change a bit. Says where each scene that differs does so first. The exit
status is 1 if there is any difference."""

import argparse
import fnmatch
import glob
import os
import pickle
import struct
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
# Instruction sets and settings of the mapper; the quick ones first.
VARIANTS = (
    ("Baseline", "NumberOfThreads=1"),
    ("AVX2", "NumberOfThreads=1"),
    ("AVX512", "NumberOfThreads=1"),
    ("AVX512", "NumberOfThreads=2", "BrickLayout=TWO_LEVEL_BRICKS", "BrickSize=4"),
    ("AVX512", "NumberOfThreads=2", "BrickLayout=NO_BRICKS", "NumberOfMacrocellLevels=0"),
    ("AVX512", "NumberOfThreads=2", "MaximumBrickMemory=1", "NumberOfMacrocellLevels=3"),
)


class Recording:
    """The scenes of a build, one after the other, as a process of its own makes them."""

    def __init__(self, build, kernels, arguments):
        packages = glob.glob(os.path.join(build, "lib*/python*/*-packages"))
        if not packages:
            sys.exit(f"{build} has no Python package")
        self.build = build
        # Threads that wait must not take the cores from those of the other build.
        environment = dict(os.environ, OMP_WAIT_POLICY="passive",
                           VTK_ISOSURFACE_RAY_TRACING_KERNELS=kernels,
                           PYTHONPATH=packages[0])
        self.process = subprocess.Popen(
            [sys.executable, os.path.join(HERE, "record_build.py"), *arguments],
            stdout=subprocess.PIPE, env=environment)

    def __iter__(self):
        """Names and arrays."""
        name = "the first scene"
        while True:
            try:
                name, arrays = pickle.load(self.process.stdout)
            except EOFError:
                break
            yield name, arrays
        if self.process.wait() != 0:
            sys.exit(f"{self.build} ended with status {self.process.returncode} after {name}")


def show(code, data, index):
    """A number in decimal and hexadecimal."""
    size = struct.calcsize(code)
    item = data[index * size:(index + 1) * size]
    if not item:
        return "missing"
    value = struct.unpack(code, item)[0]
    return f"{value!r} (0x{item[::-1].hex()})"


def find_difference(old, new):
    """Where two arrays differ first, in words; None if they do not."""
    if old == new:
        return None
    if old is None or new is None:
        return "it is missing in the " + ("old" if old is None else "new") + " build"
    if old[:2] != new[:2]:
        return f"type and components are {old[:2]} and {new[:2]}"
    code, components = old[:2]
    size = struct.calcsize(code)
    index = next((i for i, (a, b) in enumerate(zip(old[2], new[2])) if a != b),
                 min(len(old[2]), len(new[2]))) // size
    return (f"[{index // components}][{index % components}]: "
            f"{show(code, old[2], index)} and {show(code, new[2], index)}")


class Summary:
    def __init__(self):
        self.scenes = self.arrays = self.numbers = self.different = 0
        self.absent = set()

    def compare(self, title, name, old, new):
        """The arrays of a scene."""
        if old is None or new is None:
            which = " and ".join(build for build, arrays in (("old", old), ("new", new))
                                 if arrays is None)
            self.absent.add(f"{name} (not in the {which} build)")
            return
        self.scenes += 1
        self.arrays += len(old)
        self.numbers += sum(len(data) // struct.calcsize(code) for code, _, data in old.values())
        for array in dict.fromkeys([*old, *new]):
            difference = find_difference(old.get(array), new.get(array))
            if difference:
                self.different += 1
                print(f"{title}: {name}: {array} {difference}", flush=True)
                break


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("old_build")
    parser.add_argument("new_build")
    parser.add_argument("--scenes", default="*", help="the pattern of their names")
    parser.add_argument("--kernels", default="*", help="the pattern of instruction sets")
    parser.add_argument("--quick", action="store_true", help="a part of the scenes and settings")
    options = parser.parse_args()
    arguments = ["--scenes", options.scenes] + ["--quick"] * options.quick
    summary = Summary()
    for variant in VARIANTS[:4] if options.quick else VARIANTS:
        kernels, *settings = variant
        if not fnmatch.fnmatch(kernels, options.kernels):
            continue
        recordings = [Recording(build, kernels, [*arguments, *settings])
                      for build in (options.old_build, options.new_build)]
        for (name, old), (_, new) in zip(*recordings):
            summary.compare(" ".join(variant), name, old, new)
    for line in sorted(summary.absent):
        print("skipped", line)
    print(f"{summary.scenes} scenes, {summary.arrays} arrays, {summary.numbers} numbers compared; "
          f"{summary.different} scenes differ")
    if summary.scenes == 0 or summary.different:
        sys.exit(1)


if __name__ == "__main__":
    main()
