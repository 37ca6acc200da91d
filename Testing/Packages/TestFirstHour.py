#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""first-hour.sh, with a small CT and a stand-in for apt: its commands work, and Documentation/first-hour.md has them.

Arguments: the source folder, where the packages' files are installed, the folder of their examples."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from vtkmodules.vtkImagingCore import vtkImageShiftScale

from DicomSlices import write_dicom_slices
from PictureTesting import make_waves

SOURCE, PREFIX, EXAMPLES = map(Path, sys.argv[1:4])
PACKAGED = "/usr/share/doc/vtkisosurfaceraytracing-doc/Examples"


class TestFirstHour(unittest.TestCase):
    def test_commands(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "bin").mkdir()
            self.write_program(folder / "bin/apt", "echo $*")
            self.write_program(folder / "bin/xvfb-run", f'shift 2; exec "{SOURCE}/Utilities/with-display.sh" "$@"')
            (folder / "ct").mkdir()
            write_dicom_slices(self.make_ct(), folder / "ct")
            (folder / "view_ct.py").symlink_to(SOURCE / "Testing/Packages/view_ct.py")
            path = f"{folder / 'bin'}:{PREFIX / 'bin'}:/usr/bin:{os.environ['PATH']}"  # Debian's Python
            page = subprocess.run(
                [SOURCE / "Testing/Packages/first-hour.sh"], cwd=folder, check=True, stdout=subprocess.PIPE, text=True,
                env={**os.environ, "PATH": path, "EXAMPLES": str(EXAMPLES), "CMAKE_PREFIX_PATH": str(PREFIX)}).stdout
            for picture in ("gyroid", "head", "skull", "viewer", "minimal"):
                self.assertGreater((folder / f"{picture}.png").stat().st_size, 10000, picture)
        documented = (SOURCE / "Documentation/first-hour.md").read_text(encoding="utf-8")
        self.assertEqual(*(self.without_results(text) for text in (page.replace(str(EXAMPLES), PACKAGED), documented)))

    def write_program(self, path, command):
        path.write_text(f"#!/bin/sh\n{command}\n", encoding="utf-8")
        path.chmod(0o755)

    def make_ct(self):
        values = vtkImageShiftScale()
        values.SetInputData(make_waves(15))
        values.SetShift(-157.0)
        values.SetScale(10.0)
        values.SetOutputScalarTypeToShort()
        values.Update()
        return values.GetOutput()

    def without_results(self, page):
        page = re.sub(r"^(\$ .*\n)(?:.*\n)*?```$", r"\1```", page, flags=re.M)
        return re.sub(r"\d+\.\d seconds|^Done on .*", "", page, flags=re.M)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
