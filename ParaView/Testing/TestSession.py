#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What users do with a representation: state files, trace, animation, time, undo, screenshots of other sizes."""

import unittest

from Support import HERE, PICTURES, differences, program, read_picture, run, run_pvbatch


class TestSession(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        PICTURES.mkdir(parents=True, exist_ok=True)
        run_pvbatch(1, "DrawSession.py", PICTURES)
        run_pvbatch(1, "DrawUndo.py", PICTURES)

    def assert_same(self, name, other):
        self.assertGreater(read_picture(PICTURES / f"{name}.png").std(), 5, "the picture is empty")
        self.assertEqual(int(differences(PICTURES / f"{name}.png", PICTURES / f"{other}.png").max()), 0)

    def assert_different(self, name, other):
        self.assertGreater(int((differences(PICTURES / f"{name}.png", PICTURES / f"{other}.png") > 10).sum()), 200)

    def test_first_apply_shows_a_surface(self):
        self.assertGreater(read_picture(PICTURES / "first_apply.png").std(), 5)

    def test_state_files(self):
        for kind, processes in (("pvsm", 1), ("py", 1), ("pvsm", 2)):
            with self.subTest(kind=kind, processes=processes):
                run_pvbatch(processes, "DrawState.py", PICTURES / f"state.{kind}", PICTURES / f"from_{kind}.png")
                self.assert_same(f"from_{kind}", "still")

    def test_trace(self):
        trace = (PICTURES / "trace.py").read_text()
        self.assertIn("SetRepresentationType('Isosurface (ray traced)')", trace)
        self.assertIn(".Isovalues = [150.0, 190.0]", trace)
        self.assertIn(".IsosurfaceInterpolation = 'Cubic'", trace)

    def test_animated_isovalue(self):
        self.assert_same("animated_middle", "isovalue_150")
        self.assert_different("animated_start", "animated_middle")

    def test_time_series(self):
        self.assert_different("time_0", "time_1")

    def test_screenshot_of_another_size(self):
        self.assertEqual(read_picture(PICTURES / "large.png").shape, (300, 400, 3))

    def test_interactive_picture_is_coarser(self):
        self.assert_different("interactive", "still")

    def test_progressive_refinement(self):
        self.assert_different("refined", "unrefined")

    def test_window_refines_itself(self):
        printed = run([program("pvpython"), str(HERE / "DrawWaiting.py"), str(PICTURES / "waited.png")])
        self.assertIn("16 frames", printed)
        self.assert_same("waited", "refined")

    def test_undo_and_redo(self):
        self.assert_different("edited", "before_edit")
        self.assert_same("undone", "before_edit")
        self.assert_same("redone", "edited")

    def test_colours_of_vectors(self):
        for one, other in (("length", "magnitude"), ("height", "component")):
            changed = differences(PICTURES / f"colored_by_{one}.png", PICTURES / f"colored_by_{other}.png")
            self.assertGreater(read_picture(PICTURES / f"colored_by_{one}.png").std(), 5)
            self.assertLessEqual(int(changed.max()), 2)
        self.assert_different("colored_by_component", "colored_by_isovalue")

    def test_scalar_bar(self):
        self.assert_different("with_bar", "without_bar")


if __name__ == "__main__":
    unittest.main()
