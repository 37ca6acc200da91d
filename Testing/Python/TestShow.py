#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""show() of the Python package: the window shows the picture of render(), and refines it while it rests."""

import unittest
from unittest import mock

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderWindowInteractor
from vtkIsosurfaceRayTracing import isosurface, render, show
from vtkIsosurfaceRayTracing._camera import VIEW
from vtkIsosurfaceRayTracing._show import make_interactor, make_window

from PackageTesting import SIZE, make_ball
from PictureTesting import capture


class TestShow(unittest.TestCase):
    def test_window_comes_to_the_picture(self):
        for opacity in (1.0, 0.4):
            volume = isosurface(make_ball(), [0.0, 0.3], color=["red", "blue"], opacity=opacity)
            volume.GetMapper().AutoAdjustSampleDistancesOff()  # which would take more rays than the picture
            window = make_window(volume, SIZE, VIEW, None, 1.0, None, "white")
            window.SetOffScreenRendering(True)
            window.SetMultiSamples(0)
            for _ in range(8):
                window.Render()
            shown = np.frombuffer(capture(window), np.uint8).reshape(SIZE[1], SIZE[0], 3)[::-1]
            picture = render(volume, size=SIZE, background="white").rgba[:, :, :3]
            self.assertLess((picture != 255).mean(), 0.9)
            self.assertLessEqual(np.abs(shown.astype(int) - picture).max(), 1)

    def test_camera(self):
        volume, camera = isosurface(make_ball(), 0.0), vtkCamera()
        camera.SetPosition(3.0, 4.0, 50.0)
        camera.SetFocalPoint(3.0, 4.0, 0.0)
        window = make_window(volume, SIZE, VIEW, None, 1.0, camera, "white")
        copy = window.GetRenderers().GetFirstRenderer().GetActiveCamera()
        self.assertIsNot(copy, camera)  # The mouse does not turn that of the caller.
        self.assertEqual(copy.GetPosition(), (3.0, 4.0, 50.0))

    def test_picture_is_refined_until_the_window_is_closed(self):
        class Interactor:
            """Ends when there is nothing more to refine, as a user would close the window."""

            def __new__(cls):
                interactor = vtkRenderWindowInteractor()
                interactor.AddObserver("TimerEvent", cls.check, -1.0)
                return interactor

            @staticmethod
            def check(interactor, _):
                mapper = volume.GetMapper()
                counts.append(mapper.GetNumberOfAccumulatedFrames())
                if counts[-1] == mapper.GetMaximumNumberOfAccumulatedFrames():
                    interactor.TerminateApp()

        counts = []
        volume = isosurface(make_ball(), 0.0)
        with mock.patch("vtkmodules.vtkRenderingCore.vtkRenderWindowInteractor", Interactor):
            show(volume, size=SIZE)
        self.assertEqual(counts, sorted(counts))
        self.assertEqual(counts[-1], 8)

    def test_bad_arguments(self):
        for options, message in (({"size": 3}, "size is 3"), ({"background": "whitish"}, "no colour"),
                                 ({"view": "front"}, "view is 'front'")):  # fmt: skip
            with self.assertRaisesRegex(ValueError, message):
                show(make_ball(), 0.0, **options)

    def test_interactor_is_of_the_window(self):
        volume = isosurface(make_ball(), 0.0)
        window = make_window(volume, SIZE, VIEW, None, 1.0, None, "white")
        interactor = make_interactor(window, volume.GetMapper())
        self.assertIs(interactor.GetRenderWindow(), window)
        self.assertEqual(interactor.GetInteractorStyle().GetClassName(), "vtkInteractorStyleTrackballCamera")
        deleted = []
        window.AddObserver("DeleteEvent", lambda *_: deleted.append(True))
        del window, interactor
        self.assertEqual(deleted, [True])  # so it is closed


if __name__ == "__main__":
    unittest.main()
