#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

"""Tells how fast two builds are, one against the other.

Runs their vtkIsosurfaceBenchmark in turn, so that what the machine does besides
meets both, and prints the medians, and the medians of the ratios of neighbouring
runs:

    Utilities/compare_speed.py OLD_BUILD NEW_BUILD -- --input FILE --isovalue V

What stands behind -- goes to the benchmark. It needs a display (xvfb-run -a).
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("builds", nargs=2, type=pathlib.Path, metavar="BUILD")
    parser.add_argument("--turns", type=int, default=7, help="runs of each (default: 7)")
    parser.add_argument("arguments", nargs="+", help="of the benchmark, behind --")
    return parser.parse_args()


def get_baselines_option(program):
    """Builds before 22 November 2026 call them rivals."""
    text = subprocess.run([program, "--help"], capture_output=True, text=True).stdout
    return "--baselines" if "--baselines" in text else "--rivals"


def measure(build, arguments):
    """The medians of a run, by what they are of."""
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder) / "result.json"
        program = build / "bin" / "vtkIsosurfaceBenchmark"
        command = [program, get_baselines_option(program), "none", "--repeats", "3", "--json", result, *arguments]
        run = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if run.returncode != 0:
            sys.exit(f"{program} failed:\n{run.stderr}")
        tables = json.loads(result.read_text())["tables"]
    return {
        f"{table['name']}, {row['threads']:g} threads: {what}": row[what]["median"]
        for table in tables
        if table["name"].startswith("pictures")
        for row in table["rows"]
        for what in ("trace, ms", "frame, ms")
    }


def main():
    options = parse_arguments()
    runs = [[], []]
    for turn in range(options.turns):
        print(f"turn {turn + 1} of {options.turns}", file=sys.stderr)
        for i, build in enumerate(options.builds):
            runs[i].append(measure(build, options.arguments))
    print("| what | first | second | second / first |\n|---|---|---|---|")
    for what in runs[0][0]:
        first, second = ([run[what] for run in runs[i]] for i in range(2))
        ratio = statistics.median(b / a for a, b in zip(first, second))
        print(
            f"| {what} | {statistics.median(first):.3g} | {statistics.median(second):.3g} "
            f"| {ratio:.3f} |"
        )


if __name__ == "__main__":
    main()
