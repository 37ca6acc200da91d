#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compare the pictures and hits of two builds, bit for bit.

All scenes of record_build.py are made by both builds, with the kernels of each instruction set, and
with settings of the mapper that must not change a bit. Where a scene differs, the first number that
does is printed. With one build, what it makes with all these kernels and settings is compared. The
exit status is 1 if anything differs."""

import argparse
import glob
import itertools
import os
import pickle
import struct
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))

# Kernels and settings. The quick form takes the first ones.
VARIANTS = (
    ("Baseline", "NumberOfThreads=1"),
    ("AVX2", "NumberOfThreads=1"),
    ("AVX512", "NumberOfThreads=1"),
    ("AVX512", "NumberOfThreads=2", "BrickLayout=TWO_LEVEL_BRICKS", "BrickSize=4"),
    ("AVX512", "NumberOfThreads=2", "BrickLayout=NO_BRICKS", "NumberOfMacrocellLevels=0"),
    ("AVX512", "NumberOfThreads=2", "MaximumBrickMemory=1", "NumberOfMacrocellLevels=3"),
)
QUICK_VARIANTS = VARIANTS[:4]


class Recording:
    """The scenes as a build makes them, in a process of its own."""

    def __init__(self, build, variant, arguments):
        packages = glob.glob(os.path.join(build, "lib*/python*/*-packages/vtkIsosurfaceRayTracing"))
        if len(packages) != 1:
            sys.exit(f"{build} has no Python package")
        kernels, *settings = variant
        self.name = " ".join((build, *variant))
        self.process = subprocess.Popen(
            [sys.executable, os.path.join(HERE, "record_build.py"), *arguments, *settings],
            stdout=subprocess.PIPE,
            env=dict(os.environ, PYTHONPATH=os.path.dirname(packages[0]),
                     VTK_ISOSURFACE_RAY_TRACING_KERNELS=kernels,
                     # Threads that wait leave the cores to the other recordings.
                     OMP_WAIT_POLICY="passive"))

    def __iter__(self):
        """Yields the name and the arrays of each scene."""
        name = "the start"
        while True:
            try:
                name, arrays = pickle.load(self.process.stdout)
            except EOFError:
                break
            yield name, arrays
        if self.process.wait() != 0:
            sys.exit(f"{self.name}: exit status {self.process.returncode} after {name}")


def show(code, data, index):
    """A number in decimal and hexadecimal."""
    size = struct.calcsize(code)
    bits = data[index * size:(index + 1) * size]
    if not bits:
        return "nothing"
    return f"{struct.unpack(code, bits)[0]!r} (0x{bits[::-1].hex()})"


def find_difference(array, other):
    """Where two arrays differ first, in words; None if they do not."""
    if array == other:
        return None
    if array is None or other is None:
        return "is in one of them only"
    if array[:2] != other[:2]:
        return f"has types and components {array[:2]} and {other[:2]}"
    code, components, data = array
    other_data = other[2]
    byte = next((i for i, (a, b) in enumerate(zip(data, other_data)) if a != b),
                min(len(data), len(other_data)))
    index = byte // struct.calcsize(code)
    return (f"[{index // components}][{index % components}] is "
            f"{show(code, data, index)} and {show(code, other_data, index)}")


class Comparison:
    """Of any number of recordings with the first."""

    def __init__(self):
        self.scenes = self.arrays = self.numbers = self.differences = 0
        self.skipped = set()

    def compare(self, recordings):
        try:
            self.compare_scenes(recordings)
        finally:
            for recording in recordings:
                recording.process.kill()

    def compare_scenes(self, recordings):
        for scenes in itertools.zip_longest(*recordings, fillvalue=("nothing more", None)):
            (name, arrays), *others = scenes
            for recording, (_, other_arrays) in zip(recordings[1:], others):
                if arrays is None or other_arrays is None:
                    self.skipped.add(name)
                elif difference := self.compare_scene(arrays, other_arrays):
                    self.differences += 1
                    print(f"{name}: {difference}\n    in {recordings[0].name}\n"
                          f"    and {recording.name}", flush=True)

    def compare_scene(self, arrays, others):
        """Returns the first difference, in words; None if there is none."""
        self.scenes += 1
        self.arrays += len(arrays)
        self.numbers += sum(len(data) // struct.calcsize(code) for code, _, data in arrays.values())
        for name in dict.fromkeys([*arrays, *others]):
            if difference := find_difference(arrays.get(name), others.get(name)):
                return f"{name}{difference}" if difference[0] == "[" else f"{name} {difference}"
        return None

    def report(self):
        if self.skipped:
            print("Not in both builds:", *sorted(self.skipped))
        print(f"{self.scenes} scenes compared, {self.arrays} arrays, {self.numbers} numbers: "
              f"{self.differences} scenes differ")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("builds", nargs="+", metavar="BUILD", help="build folders, one or two")
    parser.add_argument("--scenes", default="*", metavar="PATTERN", help="only scenes so named")
    parser.add_argument("--kernels", help="Baseline, AVX2 or AVX512 only")
    parser.add_argument("--quick", action="store_true", help="fewer scenes and settings")
    options = parser.parse_args()
    arguments = ["--scenes", options.scenes] + ["--quick"] * options.quick
    variants = [variant for variant in (QUICK_VARIANTS if options.quick else VARIANTS)
                if options.kernels in (None, variant[0])]

    def record(build, variant):
        return Recording(build, variant, arguments)

    comparison = Comparison()
    if len(options.builds) == 1:
        comparison.compare([record(options.builds[0], variant) for variant in variants])
    else:
        for variant in variants:
            comparison.compare([record(build, variant) for build in options.builds])
    comparison.report()
    if comparison.differences or not comparison.scenes:
        sys.exit(1)


if __name__ == "__main__":
    main()
