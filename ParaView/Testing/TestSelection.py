#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Points and cells are selected through the surface: those it passes, the same on one process and on several."""

import json
import unittest

from Support import run_pvbatch


def select(processes, scene):
    output = run_pvbatch(processes, "SelectInScene.py", scene)
    return json.loads(output[output.index("{") : output.rindex("}") + 1])


class TestSelection(unittest.TestCase):
    def test_same_on_two_processes(self):
        for scene in ("blocks", "hexahedra", "nearest", "trilinear"):
            with self.subTest(scene=scene):
                one, two = select(1, scene), select(2, scene)
                print(f"{scene}: {len(one['points'])} points, {len(one['cells'])} cells")
                self.assertGreater(len(one["points"]), 50)
                self.assertGreater(len(one["cells"]), 50)
                self.assertEqual(one["passed"], len(one["cells"]), "cells that the surface does not pass")
                self.assertEqual(one, two)


if __name__ == "__main__":
    unittest.main()
