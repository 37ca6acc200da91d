#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Two translucent sets of data in each other: after each edit the picture is that of a new view."""

import re
import unittest

from Support import PICTURES, differences, read_picture, run_pvbatch

SAME = {
    "begin": "translucent",
    "hidden": "set_0",
    "shown": "translucent",
    "made_opaque": "opaque",
    "made_translucent": "translucent",
    "no_outline": "translucent",
    "after_selection": "translucent",
    "deleted": "set_1",
}


class TestSets(unittest.TestCase):
    def test_edits(self):
        for processes in (1, 3):
            folder = PICTURES / f"{processes}-processes"
            folder.mkdir(parents=True, exist_ok=True)
            printed = run_pvbatch(processes, "DrawSets.py", folder)
            for name, expected in SAME.items():
                with self.subTest(picture=name, processes=processes):
                    self.assertGreater(read_picture(folder / f"{expected}.png").std(), 5, "the picture is empty")
                    changed = differences(folder / f"{name}.png", folder / f"{expected}.png")
                    self.assertEqual(int(changed.max()), 0)
            with self.subTest(processes=processes):
                self.assertGreater(int(differences(folder / "outline.png", folder / "set_0.png").max()), 10)
                self.assertEqual(read_picture(folder / "small.png").shape, (90, 120, 3))
                self.assertGreater(read_picture(folder / "small.png").std(), 5)
                self.assertEqual(read_picture(folder / "empty.png").std(axis=(0, 1)).max(), 0.0)
                counts = [int(count) for count in re.findall(r"(\d+) points are selected", printed)]
                self.assertEqual(len(counts), 2)
                self.assertGreater(max(counts), 0, printed)


if __name__ == "__main__":
    unittest.main()
