#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A frame has the transfer functions that there were when it began, with all that they can be set to."""

import math
import time
import unittest

from vtkmodules.vtkCommonCore import vtkVariant
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import (
    vtkCamera, vtkColorTransferFunction, vtkDiscretizableColorTransferFunction, vtkVolume)
import vtkmodules.vtkRenderingVolumeOpenGL2
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

SIZE = 64


def make_volume():
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(*3 * (-8, 8))
    mapper = vtkIsosurfaceRayTraceMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.SetTileSize(4, 4)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 150.0)
    return volume


def make_colors(kind=vtkColorTransferFunction):
    colors = kind()
    colors.AddRGBPoint(100.0, 0.1, 0.9, 0.3)
    colors.AddRGBPoint(200.0, 0.8, 0.2, 0.5)
    return colors


def make_opacity():
    opacity = vtkPiecewiseFunction()
    opacity.AddPoint(50.0, 0.2)
    opacity.AddPoint(250.0, 1.0)
    return opacity


def render(volume):
    camera = vtkCamera()
    camera.SetPosition(10.0, -60.0, 15.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetClippingRange(1.0, 100.0)
    image = vtkImageData()
    if not volume.GetMapper().RenderToImage(volume, camera, None, SIZE, SIZE, image):
        raise AssertionError("there is no picture")
    return image.GetPointData()


def pixels(volume):
    return bytes(memoryview(render(volume).GetArray("Colors")))


class TestTransferFunctions(unittest.TestCase):
    def check_edit(self, volume):
        """An observer that edits all functions while a frame is traced changes the next frame alone."""
        functions = volume.GetProperty()
        before = pixels(volume)
        edits = []

        def edit(*_):
            edits.append(1)
            level = len(edits) % 2
            functions.GetRGBTransferFunction().RemoveAllPoints()
            functions.GetRGBTransferFunction().AddRGBPoint(150.0, level, 1.0, 0.0)
            functions.GetScalarOpacity().RemoveAllPoints()
            functions.GetScalarOpacity().AddPoint(150.0, 1.0 - 0.5 * level)

        observer = volume.GetMapper().AddObserver("VolumeMapperRenderProgressEvent", edit)
        during = pixels(volume)
        volume.GetMapper().RemoveObserver(observer)
        self.assertGreater(len(edits), 0)
        self.assertEqual(before, during)
        self.assertNotEqual(pixels(volume), before)

    def test_edit_while_a_projection_is_traced(self):
        volume = make_volume()
        volume.GetMapper().SetBlendModeToMaximumIntensity()
        volume.GetProperty().SetColor(make_colors())
        volume.GetProperty().SetScalarOpacity(make_opacity())
        self.check_edit(volume)

    def test_edit_while_surfaces_are_traced(self):
        volume = make_volume()
        volume.GetMapper().SetColorArrayName("RTData")
        volume.GetMapper().SetInterpolationModeToCubic()  # It takes long enough to be edited.
        volume.GetMapper().SetNumberOfThreads(1)
        volume.GetProperty().SetColor(make_colors())
        self.check_edit(volume)

    def check_projection(self, volume):
        """Each pixel has the colour and opacity that the functions of the property give its value."""
        surface = volume.GetProperty()
        volume.GetMapper().SetBlendModeToMaximumIntensity()
        data = render(volume)
        colors, values = data.GetArray("Colors"), data.GetArray("Value")
        checked = 0
        for i in range(colors.GetNumberOfTuples()):
            value = values.GetValue(i)
            if not math.isnan(value):
                rgb = [0.0, 0.0, 0.0]
                if surface.GetColorChannels() == 1:
                    rgb = 3 * [surface.GetGrayTransferFunction().GetValue(value)]
                else:
                    surface.GetRGBTransferFunction().GetColor(value, rgb)
                opacity = surface.GetScalarOpacity().GetValue(value)
                expected = [255.0 * x * opacity for x in rgb] + [255.0 * opacity]
                for channel, x in zip(colors.GetTuple(i), expected):
                    self.assertLessEqual(abs(channel - x), 0.51)
                checked += 1
        self.assertGreater(checked, SIZE)

    def test_what_a_copy_may_leave_out(self):
        volume = make_volume()
        colors = make_colors()
        colors.ClampingOff()
        colors.SetUseAboveRangeColor(True)
        colors.SetAboveRangeColor(1.0, 0.0, 1.0)
        colors.SetUseBelowRangeColor(True)
        colors.SetBelowRangeColor(0.0, 1.0, 1.0)
        volume.GetProperty().SetColor(colors)
        opacity = make_opacity()
        opacity.SetUseLogScale(True)
        volume.GetProperty().SetScalarOpacity(opacity)
        self.check_projection(volume)
        colors.SetNanColor(0.3, 0.6, 0.9)
        colors.IndexedLookupOn()  # Values without an annotation have the colour of NaN.
        self.check_projection(volume)

    def test_functions_that_jump(self):
        pictures = []
        for red_behind in (0.9, 0.2):
            volume = make_volume()
            colors, opacity = vtkColorTransferFunction(), vtkPiecewiseFunction()
            colors.AllowDuplicateScalarsOn()
            opacity.AllowDuplicateScalarsOn()
            for value, red in ((0.0, 0.2), (155.0, 0.2), (155.0, red_behind), (300.0, red_behind)):
                colors.AddRGBPoint(value, red, 0.4, 0.6)
                opacity.AddPoint(value, 1.1 - red)
            volume.GetProperty().SetColor(colors)
            volume.GetProperty().SetScalarOpacity(opacity)
            pictures.append(pixels(volume))
            self.check_projection(volume)
        self.assertEqual(*pictures)  # The surface of 150 is before the jump.

    def test_slow_colors(self):
        """VTK takes a twentieth of a second for each."""
        volume = make_volume()
        colors = make_colors()
        colors.AddRGBPoint(120.0, 0.0, 0.2, 1.0, 0.3, 0.4)
        colors.AllowDuplicateScalarsOn()
        colors.AddRGBPoint(180.0, 1.0, 1.0, 0.0)
        colors.AddRGBPoint(180.0, 0.0, 1.0, 0.0)
        colors.SetColorSpaceToLabCIEDE2000()
        volume.GetProperty().SetColor(colors)
        volume.GetProperty().SetScalarOpacity(make_opacity())
        volume.GetMapper().SetBlendModeToMaximumIntensity()
        start = time.process_time()
        data = render(volume)
        of_picture, of_colors = time.process_time() - start, 0.0
        checked = 0
        for i in range(0, SIZE * SIZE, 101):
            value = data.GetArray("Value").GetValue(i)
            if not math.isnan(value):
                rgb = [0.0, 0.0, 0.0]
                start = time.process_time()
                colors.GetColor(value, rgb)
                of_colors += time.process_time() - start
                opacity = make_opacity().GetValue(value)
                for channel, x in zip(data.GetArray("Colors").GetTuple(i), rgb):
                    self.assertLessEqual(abs(channel - 255.0 * x * opacity), 1.1)  # VTK's have steps
                checked += 1
        self.assertGreater(checked, 10)
        self.assertLess(of_picture, 2.0 * of_colors)  # It has a hundred times as many.

    def test_discrete_colors(self):
        volume = make_volume()
        colors = make_colors(vtkDiscretizableColorTransferFunction)
        colors.DiscretizeOn()
        colors.SetNumberOfValues(4)
        colors.Build()
        volume.GetProperty().SetColor(colors)
        self.check_projection(volume)

    def test_colors_of_categories(self):
        volume = make_volume()
        colors = vtkDiscretizableColorTransferFunction()
        colors.IndexedLookupOn()
        for i, value in enumerate((149.0, 150.0, 151.0)):
            colors.SetAnnotation(vtkVariant(value), str(value))
            colors.SetIndexedColor(i, 0.4 * i, 0.6, 0.2)
        volume.GetProperty().SetColor(colors)
        opaque = vtkPiecewiseFunction()
        opaque.AddPoint(150.0, 1.0)
        volume.GetProperty().SetScalarOpacity(opaque)

        def find_shown():
            shown = render(volume).GetArray("Colors")
            return {shown.GetTuple(i) for i in range(SIZE * SIZE)}

        self.assertEqual(find_shown(), {(0, 0, 0, 0), (102, 153, 51, 255)})
        colors.SetIndexedColor(1, 0.2, 0.4, 0.8)
        self.assertEqual(find_shown(), {(0, 0, 0, 0), (51, 102, 204, 255)})

    def test_gray(self):
        volume = make_volume()
        volume.GetProperty().SetColor(make_opacity())
        self.check_projection(volume)

    def test_no_functions(self):
        """The property makes those that are missing, and is asked by one thread alone."""
        self.check_projection(make_volume())


if __name__ == "__main__":
    unittest.main()
