#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""README's Build chapter: its preset asks for nothing but what the chapter names, and builds no tests.

Argument: the source folder."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])


def run(*command):
    environment = {name: value for name, value in os.environ.items() if name != "CMAKE_GENERATOR"}
    return subprocess.run(
        command, cwd=SOURCE, env=environment, check=True, capture_output=True, text=True, timeout=300).stdout


def read_chapter(title):
    return (SOURCE / "README.md").read_text(encoding="utf-8").split(f"\n## {title}\n")[1].split("\n## ")[0]


class TestReleasePreset(unittest.TestCase):
    def test_readme_makes_packages_as_they_are_tested(self):
        test = (SOURCE / "Testing" / "run-packages.sh").read_text(encoding="utf-8")
        configure, build, install = re.search(r"```sh\n(.*?)```", read_chapter("Install"), re.S)[1].splitlines()
        self.assertIn(configure + "\n", test)
        self.assertIn(re.sub(r" --parallel \d+$", "", build), test)
        self.assertEqual(install, "apt install ./build/debian/packages/*.deb")

    def test_readme_builds_by_it(self):
        chapter = read_chapter("Build")
        (commands,) = [block for block in re.findall(r"```sh\n(.*?)```", chapter, re.S) if "preset" in block]
        configure, build, install = commands.splitlines()
        self.assertEqual(configure, "cmake --preset release")
        self.assertTrue(build.startswith("cmake --build --preset release"))
        self.assertTrue(install.startswith("cmake --install build/release"))

    def test_builds_the_library_and_the_programs_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            # Debian's VTK needs the Python of Debian, before which another may be in PATH.
            run("cmake", "--preset", "release", "-B", folder, "-DPython3_EXECUTABLE=/usr/bin/python3")
            cache = Path(folder, "CMakeCache.txt").read_text(encoding="utf-8")
            targets = run("cmake", "--build", folder, "--target", "help")
        for expected in ("CMAKE_BUILD_TYPE:STRING=Release", "BUILD_TESTING:BOOL=OFF",
                         "vtkIsosurfaceRayTracing_WARNINGS_AS_ERRORS:BOOL=OFF",
                         "CMAKE_GENERATOR:INTERNAL=Unix Makefiles"):  # fmt: skip
            self.assertIn(expected, cache)
        self.assertNotIn("GTest", cache)
        names = re.findall(r"^\.\.\. (\S+)$", targets, re.M)
        self.assertIn("IsosurfaceRayTracing", names)
        self.assertIn("vtkIsosurfaceCompare", names)
        self.assertIn("vtkIsosurfaceViewer", names)
        self.assertEqual([name for name in names if re.search("test|benchmark", name, re.I)], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
