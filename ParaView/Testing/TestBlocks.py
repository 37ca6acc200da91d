#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Blocks are visible, and have colours and opacities of their own, as the multiblock inspector sets them."""

import re
import unittest

from Support import PICTURES, differences, read_picture, run_pvbatch

SAME = {"colored": "innermost", "colored_all": "innermost", "invisible": "hidden", "again": "plain"}


class TestBlocks(unittest.TestCase):
    def check(self, folder, printed):
        for name, expected in SAME.items():
            with self.subTest(picture=name):
                self.assertGreater(read_picture(folder / f"{expected}.png").std(), 5, "the picture is empty")
                self.assertEqual(int(differences(folder / f"{name}.png", folder / f"{expected}.png").max()), 0)
        for name, other in (("hidden", "plain"), ("innermost", "plain"), ("styled", "plain")):
            with self.subTest(picture=name):
                changed = differences(folder / f"{name}.png", folder / f"{other}.png") > 10
                self.assertGreater(int(changed.sum()), 200)
        self.assertEqual(read_picture(folder / "nothing.png").std(axis=(0, 1)).max(), 0.0)
        # In one process OpenGL finds by the depth buffer what of opaque sets is in front.
        changed = differences(folder / "styled.png", folder / "separate.png")
        print(f"styled blocks and sets of data: {(changed > 0).sum()} pixels differ, {(changed > 3).sum()} by over 3")
        self.assertLessEqual(int((changed > 3).sum()), 20)
        # The middle of the visible block, whose points alone are selected.
        self.assertIn("focal point [0, 2, 10]", printed)
        count, *bounds = map(int, re.search(r"selected (\d+) \[(.*)\]", printed).expand(r"\1, \2").split(", "))
        self.assertGreater(count, 50)
        for axis, (low, high) in enumerate(((-6, 6), (-4, 8), (4, 16))):
            self.assertGreaterEqual(bounds[2 * axis], low)
            self.assertLessEqual(bounds[2 * axis + 1], high)

    def test_edits(self):
        for processes in (1, 2):
            folder = PICTURES / f"{processes}-processes"
            folder.mkdir(parents=True, exist_ok=True)
            printed = run_pvbatch(processes, "DrawBlocks.py", folder)
            with self.subTest(processes=processes):
                self.check(folder, printed)

    def test_state_file(self):
        run_pvbatch(1, "DrawState.py", PICTURES / "1-processes" / "styled.pvsm", PICTURES / "loaded.png")
        changed = differences(PICTURES / "loaded.png", PICTURES / "1-processes" / "styled.png")
        self.assertEqual(int(changed.max()), 0)


if __name__ == "__main__":
    unittest.main()
