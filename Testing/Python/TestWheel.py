#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""pyproject.toml agrees with CMakeLists.txt and with itself. (No wheel is made: that needs a registry.)"""

import re
import unittest
from pathlib import Path

try:
    import tomllib
except ImportError:  # before Python 3.11
    tomllib = None

import vtkIsosurfaceRayTracing

ROOT = Path(__file__).resolve().parents[2]


@unittest.skipIf(tomllib is None, "this Python does not read TOML")
class TestWheel(unittest.TestCase):
    def setUp(self):
        self.project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
        self.settings = self.project["tool"]["scikit-build"]
        self.cmake = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")

    def test_version(self):
        found = re.search(self.settings["metadata"]["version"]["regex"], self.cmake)
        self.assertEqual(found["value"], vtkIsosurfaceRayTracing.__version__)

    def test_version_is_everywhere(self):
        version = re.escape(vtkIsosurfaceRayTracing.__version__)
        for file, expected in (("CHANGELOG.md", rf"\n## {version} - "),
                               ("Packages/Debian/changelog", rf"^vtkisosurfaceraytracing \({version}-\d+\)"),
                               ("ParaView/CMakeLists.txt", rf"VERSION {version} ")):  # fmt: skip
            self.assertRegex((ROOT / file).read_text(encoding="utf-8"), expected)

    def test_vtk_is_that_of_the_sdk(self):
        (sdk,) = (name for name in self.project["build-system"]["requires"] if name.startswith("vtk-sdk=="))
        self.assertIn(sdk.replace("vtk-sdk", "vtk"), self.project["project"]["dependencies"])

    def test_options_exist(self):
        for name in self.settings["cmake"]["define"]:
            if not name.startswith("CMAKE_"):
                self.assertRegex(self.cmake, rf"(option\(|set\(\s*){name}\b")


if __name__ == "__main__":
    unittest.main()
