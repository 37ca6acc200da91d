# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Processes that may have so much memory and no more, the pages of files that they use included (ulimit counts
addresses instead): by a control group of Linux."""

import os
import subprocess
from pathlib import Path

MEMORY_GROUPS = Path("/sys/fs/cgroup/memory")  # of version 1


def write_zeros(folder):
    """A MetaImage of 200 MiB, in a file with a hole. Returns the path of its header."""
    header = folder / "zeros.mhd"
    header.write_text("NDims = 3\nDimSize = 512 512 400\nElementType = MET_SHORT\nElementDataFile = zeros.raw\n",
                      encoding="ascii")  # fmt: skip
    (folder / "zeros.raw").touch()
    os.truncate(folder / "zeros.raw", 2 * 512 * 512 * 400)
    return header


class LimitedMemory:
    """Run commands with prefix before them. If is_possible is not true, there are no groups, or none for this user."""

    def __init__(self, limit):
        """In bytes."""
        self.group = None
        self.prefix = ["systemd-run", "--quiet", "--scope", "-p", f"MemoryMax={limit}", "-p", "MemorySwapMax=0"]
        self.is_possible = self.is_working()
        if not self.is_possible:
            self.prefix.insert(1, "--user")
            self.is_possible = self.is_working()
        if not self.is_possible:
            self.is_possible = self.make_group(limit)

    def is_working(self):
        try:
            return subprocess.run([*self.prefix, "true"], capture_output=True, timeout=20, check=False).returncode == 0
        except (OSError, subprocess.TimeoutExpired):
            return False

    def make_group(self, limit):
        """One within that of this process, whose limits hold, too."""
        try:
            groups = Path("/proc/self/cgroup").read_text(encoding="ascii").splitlines()
            (own,) = (line.split(":")[2] for line in groups if line.split(":")[1] == "memory")
            group = MEMORY_GROUPS / own[1:] / f"limited-{os.getpid()}-{id(self)}"
            group.mkdir()
            self.group = group
            (group / "memory.limit_in_bytes").write_text(str(limit), encoding="ascii")
        except (OSError, ValueError):
            self.close()
            return False
        self.prefix = ["sh", "-c", 'echo $$ > "$0" && exec "$@"', str(group / "cgroup.procs")]
        return self.is_working()

    def close(self):
        """When the processes have ended."""
        if self.group:
            self.group.rmdir()
            self.group = None

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()
