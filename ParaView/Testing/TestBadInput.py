#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be shown is said, on one process and on several, and the scene is drawn without it."""

import subprocess
import unittest

from Support import HERE, PICTURES, SECONDS, differences, on_processes, program, read_picture

MESSAGES = {
    "no_array": 'There is no array "RTData" of points or cells to contour. Choose one in "Contour By"',
    "polygons": "vtkPolyData",
    "missing_color_array": 'There is no array named "absent" in the input to colour by',
    "outside_range": "",
    "no_light": "No light is on",
    "fails_to_read": "RuntimeError: this process cannot read",
    "missing_in_a_time_step": 'There is no array "RTData" of points or cells to contour',
}


class TestBadInput(unittest.TestCase):
    def test_messages(self):
        PICTURES.mkdir(parents=True, exist_ok=True)
        for kind, message in MESSAGES.items():
            for processes in (1, 2):
                with self.subTest(kind=kind, processes=processes):
                    picture = PICTURES / f"{kind}-{processes}.png"
                    command = on_processes(processes, program("pvbatch"), HERE / "DrawBadInput.py", kind, picture)
                    done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS)
                    output = done.stdout + done.stderr
                    self.assertEqual(done.returncode, 0, output)
                    self.assertIn(message, output)
                    if not message:
                        self.assertNotIn("ERR|", output)
                    self.assertGreater(read_picture(picture).std(), 5, "the other prop is not drawn")
                    if kind == "missing_in_a_time_step":
                        first, without, last = (f"{picture}-{time}.png" for time in range(3))
                        self.assertGreater(int((differences(first, without) > 10).sum()), 200)
                        self.assertEqual(int(differences(first, last).max()), 0)


if __name__ == "__main__":
    unittest.main()
