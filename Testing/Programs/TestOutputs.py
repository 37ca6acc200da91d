#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What programs write is whole, or absent and told: TestOutputs.py FOLDER_OF_COMPARE FOLDER_OF_BENCHMARKS"""

import os
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BENCHMARKS = Path(sys.argv.pop())
COMPARE = Path(sys.argv.pop()) / "vtkIsosurfaceCompare"
VOLUME = BENCHMARKS / "vtkIsosurfaceBenchmarkVolume"
FULL = Path("/dev/full")
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "DISPLAY"}


def run(*command, **options):
    return subprocess.run(
        list(map(str, command)), stderr=subprocess.PIPE, text=True, env=ENVIRONMENT, timeout=300,
        check=False, **options)  # fmt: skip


class TestOutputs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.sphere = self.folder / "sphere.mhd"
        self.make_sphere(self.sphere)

    def make_sphere(self, path, edge=12):
        result = run(VOLUME, "--field", "sphere", "--dimensions", edge, "--output", path)
        self.assertEqual(result.returncode, 0, result.stderr)

    def commands(self, target):
        """Commands that write a file of that name, or into a folder of that name, and the file."""
        compare = [COMPARE, "--input", self.sphere, "--isovalue", "0", "--repeats", "1",
                   "--methods", "flying-edges"]  # fmt: skip
        benchmark = [BENCHMARKS / "vtkIsosurfaceBenchmark", "--input", self.sphere, "--isovalue", "0",
                     "--size", "16", "--views", "1", "--repeats", "1", "--threads", "1",
                     "--baselines", "none"]  # fmt: skip
        meshes = [BENCHMARKS / "vtkIsosurfaceMeshBenchmark", "--cells", "100", "--fields", "ball",
                  "--size", "16", "--views", "1", "--repeats", "1", "--threads", "1"]  # fmt: skip
        accuracy = [BENCHMARKS / "vtkIsosurfaceSpeedAgainstError", "--quick", "--input", self.sphere,
                    "--isovalue", "0"]  # fmt: skip
        yield [*compare, "--json", target / "a.json"], target / "a.json"
        yield [*compare, "--csv", target / "a.csv"], target / "a.csv"
        yield [*compare, "--report", target], target / "report.html"
        yield [*benchmark, "--json", target / "b.json"], target / "b.json"
        yield [*meshes, "--json", target / "d.json"], target / "d.json"
        yield [*accuracy, "--output", target], target / "results.json"
        yield [*accuracy, "--output", target], target / "sphere-errors.vti"
        yield [VOLUME, "--field", "sphere", "--dimensions", "8", "--output", target / "c.mhd"], (
            target / "c.raw")
        yield [VOLUME, "--field", "sphere", "--dimensions", "8", "--output", target / "c.mhd"], (
            target / "c.mhd")

    def assert_fails(self, command, path, reason):
        result = run(*command, stdout=subprocess.DEVNULL)
        self.assertEqual(result.returncode, 1, (command, result.stderr))
        self.assertIn(f"error: {path} cannot be written: {reason}", result.stderr)

    def test_folder_of_that_name(self):
        for command, path in self.commands(self.folder):
            with self.subTest(command):
                path.mkdir()
                self.assert_fails(command, path, "Is a directory")
                path.rmdir()

    def test_absent_folder(self):
        absent = self.folder / "absent"
        for option, name in (("--json", "a.json"), ("--csv", "a.csv")):
            self.assert_fails(
                [COMPARE, "--input", self.sphere, "--isovalue", "0", option, absent / name],
                absent / name, "No such file or directory")  # fmt: skip
        self.assert_fails(
            [VOLUME, "--field", "sphere", "--dimensions", "8", "--output", absent / "c.mhd"],
            absent / "c.mhd", "No such file or directory")  # fmt: skip

    @unittest.skipUnless(FULL.exists(), "there is no full disk to write to")
    def test_full_disk(self):
        for command, path in self.commands(self.folder):
            with self.subTest(command):
                path.unlink(missing_ok=True)
                path.symlink_to(FULL)
                self.assert_fails(command, path, "No space left on device")
                self.assertTrue(FULL.is_char_device(), "the device was replaced")
                path.unlink(missing_ok=True)
                self.assertFalse((self.folder / "c.mhd").exists(), "a header without its samples")

    @unittest.skipUnless(FULL.exists(), "there is no full disk to write to")
    def test_what_is_printed(self):
        for command in (
            [COMPARE, "--help"],
            [COMPARE, "--input", self.sphere, "--isovalue", "0", "--methods", "flying-edges"],
            [VOLUME, "--help"],
            [VOLUME, "--field", "sphere", "--dimensions", "8", "--output", self.folder / "c.mhd"],
            [BENCHMARKS / "vtkIsosurfaceBenchmark", "--help"],
            [BENCHMARKS / "vtkIsosurfaceSpeedAgainstError", "--help"],
        ):
            with self.subTest(command), open(FULL, "wb") as full:
                result = run(*command, stdout=full)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn("the standard output cannot be written: No space", result.stderr)

    def test_existing_files_are_replaced(self):
        """As whole files, through links, and protected ones not at all."""
        table, link = self.folder / "table.json", self.folder / "link.json"
        table.write_text("old")
        link.symlink_to(table)
        command = [COMPARE, "--input", self.sphere, "--isovalue", "0", "--methods", "flying-edges",
                   "--json", link]  # fmt: skip
        self.assertEqual(run(*command, stdout=subprocess.DEVNULL).returncode, 0)
        self.assertTrue(link.is_symlink())
        self.assertIn('"rows"', table.read_text())
        table.write_text("old")
        table.chmod(0o444)
        if not os.access(table, os.W_OK):  # root may write everything
            self.assert_fails(command, link, "Permission denied")
            self.assertEqual(table.read_text(), "old")

    def test_inputs_stay(self):
        """Not even what a header refers to, or what a link leads to, is replaced."""
        detached, link = self.folder / "detached.mhd", self.folder / "link.json"
        detached.write_text(self.sphere.read_text().replace("sphere.raw", "other.raw"))
        samples, compressed = self.folder / "other.raw", self.folder / "compressed.mhd"
        (self.folder / "sphere.raw").rename(samples)
        compressed.write_text(
            detached.read_text().replace("ElementDataFile", "CompressedData = True\nElementDataFile"))
        nrrd = self.folder / "other.nhdr"
        nrrd.write_text("NRRD0004\ntype: short\ndimension: 3\nsizes: 12 12 12\nencoding: gzip\ndata file: other.raw\n")
        link.symlink_to(samples)
        compare = [COMPARE, "--isovalue", "0", "--input"]
        before = samples.read_bytes()
        for command, path in (
            ([*compare, detached, "--csv", detached], detached),
            ([*compare, detached, "--json", link], link),
            ([*compare, compressed, "--json", samples], samples),
            ([*compare, nrrd, "--json", samples], samples),
            ([BENCHMARKS / "vtkIsosurfaceBenchmark", *compare[1:], detached, "--json", samples], samples),
            ([VOLUME, "--input", detached, "--dimensions", "4", "--output", self.folder / "other.mhd"], samples),
        ):
            with self.subTest(command):
                result = run(*command, stdout=subprocess.DEVNULL)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertRegex(result.stderr, f"error: {path} (is|belongs to) the input: give another name")
        self.assertEqual(samples.read_bytes(), before)
        self.assertIn("other.raw", detached.read_text())
        # A folder that is named like a header is none.
        slices = self.folder / "slices.mhd"
        slices.mkdir()
        result = run(*compare, slices, "--json", slices / "a.json", stdout=subprocess.DEVNULL)
        self.assertNotIn("ElementDataFile", result.stderr)

    def test_outputs_stay(self):
        """None of them replaces another."""
        report, link = self.folder / "report", self.folder / "link.csv"
        (self.folder / "table").touch()
        link.symlink_to(self.folder / "table")
        compare = [COMPARE, "--input", self.sphere, "--isovalue", "0", "--methods", "flying-edges"]
        for outputs in (
            ["--csv", self.folder / "table", "--json", self.folder / "table"],
            ["--csv", self.folder / "table", "--json", report / ".." / "table", "--report", report],
            ["--csv", link, "--json", self.folder / "table"],
            ["--json", report / "report.html", "--report", report],
        ):
            with self.subTest(outputs):
                result = run(*compare, *outputs, stdout=subprocess.DEVNULL)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn("is to be written twice: give another name", result.stderr)
                self.assertFalse(report.exists())
        result = run(*compare, "--csv", "/dev/null", "--json", "/dev/null", stdout=subprocess.DEVNULL)
        self.assertEqual(result.returncode, 0, result.stderr)

    @unittest.skipUnless(hasattr(os, "mkfifo"), "pipes have names there")
    def test_inputs_are_no_pipes(self):
        """Programs would wait for them."""
        for suffix in (".mhd", ".nrrd", ".vti", ".vtu", ".png"):
            pipe = self.folder / f"pipe{suffix}"
            os.mkfifo(pipe)
            with self.subTest(suffix):
                result = run(COMPARE, "--input", pipe, "--isovalue", "0", "--json", self.folder / "a.json")
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn(f"there is no file {pipe}, but a pipe or a device", result.stderr)

    def test_signals_leave_nothing(self):
        """Neither of a new volume nor of one that replaces another."""
        old = {path.name: path.read_bytes() for path in self.folder.iterdir()}
        for number in (signal.SIGINT, signal.SIGTERM):
            command = [VOLUME, "--field", "gyroid", "--dimensions", "600", "--output", self.sphere]
            # A shell in the background makes its children ignore SIGINT, and so might ctest's.
            process = subprocess.Popen(
                command, stderr=subprocess.PIPE, env=ENVIRONMENT,
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # fmt: skip
            process.stderr.readline()  # "46 of 600 slices": they are in a file
            self.assertEqual(len(list(self.folder.glob("*.part"))), 2)
            process.send_signal(number)
            process.stderr.read()
            process.stderr.close()
            self.assertEqual(process.wait(), -number)
            left = {path.name: path.read_bytes() for path in self.folder.iterdir()}
            self.assertEqual(left, old)

    def test_signals_leave_no_folder(self):
        """With a report that is not written, not even those that it is in, but what others wrote there."""
        self.make_sphere(self.sphere, 300)
        for is_used in (False, True):
            report = self.folder / "reports" / "new"
            process = subprocess.Popen(
                [COMPARE, "--input", self.sphere, "--isovalue", "0", "--thorough", "--report", report],
                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=ENVIRONMENT,
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # fmt: skip
            process.stderr.read(1)  # "0 %": it measures
            self.assertTrue(report.exists())
            if is_used:
                (report / "notes").touch()
            process.send_signal(signal.SIGINT)
            process.stderr.close()
            self.assertEqual(process.wait(), -signal.SIGINT)
            self.assertEqual(report.parent.exists(), is_used)


if __name__ == "__main__":
    unittest.main()
