#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The picture of several processes is that of one."""

import unittest

from Support import differences, draw

# Opaque, or composited from what all processes have along each ray.
EXACT = (
    "amr",
    "blocks",
    "cell_blocks",
    "cells",
    "clipped",
    "colored_by_array",
    "colored_by_isovalue",
    "cubic",
    "curvilinear",
    "exact_normals",
    "hexahedra",
    "nearest",
    "rectilinear",
    "sets_around_ball",
    "shared_out_amr",
    "styled_blocks",
    "translucent_sets",
    "trilinear",
    "unordered_around_ball",
    "unordered_grid",
    "unordered_in_glass",
    "unordered_mesh",
    "unordered_vectors",
    "vectors",
)
# ParaView composites translucent pictures in 8 bits, from each process to the next.
TRANSLUCENT = ("beside_glass", "moved", "opacity_function", "translucent", "unordered_around_glass")
# In one process OpenGL finds by the depth buffer what is in front, in others each ray by itself.
BY_DEPTHS = ("opaque_set_in_translucent",)
# A process knows the light that its own piece lets pass, and blends its edges with its own background.
OF_PIECES = ("occlusion", "shadows", "smooth_edges")
OF_EIGHT = ("cell_blocks", "curvilinear", "trilinear", "unordered_mesh")


class TestProcesses(unittest.TestCase):
    def test_same_picture(self):
        scenes = EXACT + TRANSLUCENT + BY_DEPTHS + OF_PIECES
        expected = draw(1, scenes)
        for processes, names in ((2, scenes), (3, scenes), (8, OF_EIGHT)):
            for name, path in draw(processes, names).items():
                found = differences(path, expected[name])
                changed, largest = int((found > 0).sum()), int(found.max())
                print(f"{name}, {processes} processes: {changed} of {found.size} pixels differ, by {largest} at most")
                with self.subTest(scene=name, processes=processes):
                    if name in EXACT:
                        self.assertEqual(changed, 0)
                    elif name in TRANSLUCENT:
                        self.assertLessEqual(largest, 3)
                    elif name in BY_DEPTHS:
                        self.assertLessEqual(int((found > 3).sum()), 3)
                    else:
                        self.assertGreater(changed, 0, "Documentation/paraview.md says that it differs")

    def test_sets_of_data_are_in_order(self):
        """Representations know the order of what they show together, as one does of its blocks."""
        names = ("translucent_sets", "translucent_sets_as_blocks")
        sets, blocks = draw(1, names).values()
        found = differences(sets, blocks)
        print(f"two sets of data, or one of two blocks: {(found > 0).sum()} pixels differ, by {found.max()} at most")
        self.assertLessEqual(int(found.max()), 1)

    def test_coarse_picture_is_in_its_place(self):
        one, two = (draw(processes, ["unordered_interactive"])["unordered_interactive"] for processes in (1, 2))
        self.assertLess(differences(one, two).mean(), 12)

    def test_process_without_data(self):
        one, two = (draw(processes, ["few_cells"])["few_cells"] for processes in (1, 4))
        self.assertEqual(int(differences(one, two).max()), 0)


if __name__ == "__main__":
    unittest.main()
