#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Small runs of vtkIsosurfaceSpeedAgainstError, with and without a display: all methods must be
there and make sense; times are not judged. See Programs.py."""

import math
import os
import unittest

from vtkmodules.vtkIOXML import vtkXMLImageDataReader

from Displays import why_no_pictures, without_display
from Programs import ProgramTest, new_folder, read_json

PROGRAM = "vtkIsosurfaceSpeedAgainstError"
FOLDER = new_folder("accuracy")
INPUTS = ["Marschner-Lobb", "gyroid", "random corners", "near tangent", "integer plateaus"]


def find(results, method, parameter=""):
    return next(
        result
        for result in results
        if (result["method"], result["parameter"]) == (method, parameter)
    )


class TestSpeedAgainstError(ProgramTest):
    @classmethod
    def setUpClass(cls):
        # The name is that of an input of Documentation/accuracy.md, for TestDocuments.py.
        arguments = "--field sphere --dimensions 24 --output cranium.mhd"
        cls().run_program(FOLDER, "vtkIsosurfaceBenchmarkVolume", arguments)

    def measure(self, folder, arguments="", environment=None):
        self.run_program(
            FOLDER, PROGRAM, f"--quick --output {folder} {arguments}", environment
        )
        return read_json(FOLDER / folder / "results.json")

    def check(self, result, rays, percent, error):
        """At most so many percent of the rays are missed or invented, with errors of at most so much; None
        where distances are not known."""
        name = f"{result['method']} {result['parameter']}"
        self.assertLessEqual(result["missed"] + result["invented"], percent / 100 * rays, name)
        if error is None:
            self.assertNotIn("medianError", result, name)
        else:
            self.assertLessEqual(result["medianError"], error, name)
            shares = [share for _, share in result["errorsAndSharesAbove"]]
            self.assertEqual(shares, sorted(shares, reverse=True), name)

    def test_fields(self):
        measured = self.measure("fields")
        self.assertEqual([i["name"] for i in measured["inputs"]], [f"{n} 24^3" for n in INPUTS])
        gyroid = measured["inputs"][1]
        rays = gyroid["numberOfRays"]
        for method, parameter, percent, error in (
            ("Robust", "", 0, 1e-9),
            ("Single precision", "", 0, 1e-5),
            ("Analytic", "", 100, 100),
            ("Marmitt", "N = 3", 0, 1e-4),
            ("Linear", "", 1, 0.02),
            ("Sampler, bisecting", "0.5 cells", 5, 0.001),
            ("Sampler", "0.5 cells", 5, 0.5),
            ("Triangles of flying edges", "", 2, 0.1),
            ("Triangles of marching cubes", "", 2, 0.1),
        ):
            result = find(gyroid["rays"], method, parameter)
            self.check(result, rays, percent, error)
            self.assertGreater(result["nanosecondsPerRay"]["median"], 0, method)
        for method in ("Robust", "Single precision", "Analytic", "Linear"):
            self.assertGreater(find(gyroid["rays"], method)["nanosecondsPerCell"], 0, method)
        if "absent" not in measured["environment"]:
            self.check_pictures(gyroid)

    def check_pictures(self, measured):
        rows = [
            ("Robust", "", 0, 1e-9),
            ("Analytic", "", 100, 100),
            ("Marmitt", "N = 3", 0, 1e-4),
            ("Linear", "", 1, 0.02),
            ("Polygons of flying edges", "", 2, None),
        ]
        for distance in ("1.0", "0.5", "0.25"):
            # A sample lies half a distance behind the surface, on average, and a little more on
            # a slope.
            rows.append(("VTK's GPU mode", f"{distance} cells", 5, float(distance)))
            rows.append(("VTK's fixed-point mapper", f"{distance} cells", 8, None))
        for method, parameter, percent, error in rows:
            result = find(measured["pictures"], method, parameter)
            self.check(result, measured["numberOfRays"], percent, error)
            self.assertGreater(result["millisecondsPerFrame"]["median"], 0, method)
        # Does VTK's depth image still give positions in the texture (Baselines.cxx)?
        error = find(measured["pictures"], "VTK's GPU mode", "0.25 cells")["medianError"]
        self.assertTrue(0.05 < error < 0.2, f"The GPU mode is {error} cells off.")

    def test_input(self):
        measured = self.measure("cranium", "--input cranium.mhd --isovalue 0")
        cranium = measured["inputs"][0]
        self.assertEqual(cranium["name"], "cranium")
        self.check(find(cranium["rays"], "Robust"), cranium["numberOfRays"], 0, 1e-9)
        self.check_error_image(FOLDER / "cranium" / cranium["errorImage"])

    def check_error_image(self, path):
        """Robust has small errors where the surface is, and none around it."""
        reader = vtkXMLImageDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        array = reader.GetOutput().GetPointData().GetArray("Robust")
        self.assertEqual(array.GetNumberOfValues(), 64 * 64)
        errors = [array.GetValue(i) for i in range(array.GetNumberOfValues())]
        known = [error for error in errors if not math.isnan(error)]
        self.assertTrue(0 < len(known) < len(errors))
        self.assertTrue(0.0 <= min(known) and max(known) < 1e-9)

    def check_frames(self, folder, environment):
        """Rays are always measured, frames where they are possible."""
        measured = self.measure(folder, "--input cranium.mhd --isovalue 0", environment)
        robust = find(measured["inputs"][0]["pictures"], "Robust")
        self.assertGreater(robust["millisecondsTracing"]["median"], 0)
        if why_no_pictures(environment):
            self.assertIsNone(robust["millisecondsPerFrame"])
            self.assertEqual(len(measured["environment"]["absent"]), 3)
        else:
            self.assertGreater(robust["millisecondsPerFrame"]["median"], 0)
            self.assertNotIn("absent", measured["environment"])

    def test_display(self):
        self.check_frames("bright", dict(os.environ))

    def test_without_display(self):
        self.check_frames("dark", without_display())


if __name__ == "__main__":
    unittest.main()
