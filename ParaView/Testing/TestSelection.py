#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Points and cells are selected through the surface: those it passes, the same on one process and on several.

What the filter Extract Selection makes of a selection is compared, and how much ParaView's table shows of it.
"""

import json
import re
import unittest

from Support import run_pvbatch


def select(processes, scene):
    output = run_pvbatch(processes, "SelectInScene.py", scene)
    return json.loads(output[output.index("{") : output.rindex("}") + 1])


def place_and_value(tooltip):
    return re.search(r"Coords: (.*)\nRTData: (.*?)[\n<]", tooltip).groups()


class TestSelection(unittest.TestCase):
    def test_same_on_two_processes(self):
        for scene in ("blocks", "hexahedra", "nearest", "trilinear"):
            with self.subTest(scene=scene):
                one, two = select(1, scene), select(2, scene)
                print(f"{scene}: {len(one['points'])} points, {len(one['cells'])} cells")
                self.assertGreater(len(one["points"]), 50)
                self.assertGreater(len(one["cells"]), 50)
                self.assertEqual(one["passed"], len(one["cells"]), "cells that the surface does not pass")
                self.assertEqual(one["points"], two["points"])
                self.assertEqual(one["cells"], two["cells"])
                for found in (one, two):
                    self.assertEqual(found["rows"], found["extracted"], "what the table of the selection shows")

    def test_where_pieces_have_no_order(self):
        one, two = (select(processes, "unordered_grid") for processes in (1, 2))
        self.assertGreater(len(one["points"]), 1000)
        self.assertEqual(one["points"], two["points"])
        self.assertEqual(one["cells"], two["cells"])

    def test_hover(self):
        one, two = (select(processes, "blocks") for processes in (1, 2))
        print(one["point"], one["cell"], sep="\n")
        self.assertIn("Block: Wavelet", one["point"])
        self.assertEqual(place_and_value(one["point"]), place_and_value(two["point"]))
        for tooltip in (one["cell"], two["cell"]):
            self.assertIn("Type: Voxel", tooltip)


if __name__ == "__main__":
    unittest.main()
