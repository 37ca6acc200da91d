#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What compositing a picture of 1024 x 1024 pixels costs with 1 to 8 processes, as a table in Markdown.

    many_processes.py vtkIsosurfaceRender --input volume.mhd --isovalue 0 [--opacity 0.5]

The arguments are the program and its arguments, but for the output."""

import os
import subprocess
import sys
import tempfile

PIXELS = 1024 * 1024
# What is sent of a pixel with opaque surfaces, or of each fragment.
OPAQUE_PIXEL = 24


def measure(arguments, processes):
    """For each process, the time to render and to composite in seconds, and the megabytes sent."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "-n", str(processes), *arguments, "--output", os.path.join(folder, "picture.png")]
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
                       "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
                       "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        result = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    return [[float(word) for word in line.split()[2:5]] for line in result.stdout.splitlines()[1:]]


def main():
    print("| processes | sent by a process, at most, MB | all pixels by binary swap, MB | compositing, ms |")
    print("|---|---|---|---|")
    for processes in (1, 2, 3, 4, 5, 8):
        rows = [measure(sys.argv[1:], processes) for _ in range(5)]
        sent = max(row[2] for row in rows[0])
        bound = (1.0 - 1.0 / processes) * PIXELS * OPAQUE_PIXEL * 1e-6
        # The process that comes last waits for none.
        times = sorted(min(row[1] for row in of_run) for of_run in rows)
        print(f"| {processes} | {sent:.1f} | {bound:.1f} | {1e3 * times[2]:.0f} |")


if __name__ == "__main__":
    main()
