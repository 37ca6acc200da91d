# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A scene with a large volume, drawn at rest and while it is interacted with."""

import numpy
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume
import vtkmodules.vtkRenderingOpenGL2  # what vtkRenderWindow needs

from PictureTesting import capture

SIZE = 128  # of a picture


class Scene:
    """In its picture z goes up: the data are in the box from 0 to 256, about."""

    def __init__(self, image, isovalue=128.0):
        self.mapper, self.volume, self.renderer = vtkIsosurfaceRayTraceMapper(), vtkVolume(), vtkRenderer()
        self.image = image
        self.mapper.SetInputDataObject(image)
        self.mapper.AutoAdjustSampleDistancesOff()
        self.volume.SetMapper(self.mapper)
        surface = self.volume.GetProperty()
        surface.GetIsoSurfaceValues().SetValue(0, isovalue)
        surface.GetScalarOpacity().AddPoint(0.0, 1.0)
        surface.ShadeOn()
        self.renderer.AddVolume(self.volume)
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(127.5, 127.5, 128.0)
        camera.SetPosition(127.5, -500.0, 128.0)
        camera.SetViewUp(0.0, 0.0, 1.0)
        camera.SetParallelScale(128.0)
        camera.SetClippingRange(1.0, 2000.0)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(SIZE, SIZE)
        self.window.AddRenderer(self.renderer)
        self.fractions, self.warnings, self.errors = [], [], []
        self.on_progress = lambda: None
        self.mapper.AddObserver("WarningEvent", self.add_warning)
        self.mapper.AddObserver("ErrorEvent", self.add_error)

    def observe(self):
        self.mapper.AddObserver("ProgressEvent", self.add_progress)
        return self

    def add_progress(self, caller, event):
        self.fractions.append(caller.GetProgress())
        self.on_progress()

    def add_warning(self, caller, event, text):
        self.warnings.append(text)

    def add_error(self, caller, event, text):
        self.errors.append(text)

    add_warning.CallDataType = add_error.CallDataType = "string0"

    def render(self):
        """The rows of the picture, from below."""
        self.window.SetAbortRender(0)
        self.window.Render()
        return numpy.frombuffer(capture(self.window), numpy.uint8).reshape(SIZE, -1)

    def render_interactively(self, rate=1e9):
        """At this rate, as little is read for a frame as can be."""
        self.window.SetDesiredUpdateRate(rate)
        rows = self.render()
        self.window.SetDesiredUpdateRate(0.0001)
        return rows

    def render_to_image(self):
        output = vtkImageData()
        assert self.mapper.RenderToImage(self.volume, self.renderer.GetActiveCamera(), None, SIZE, SIZE, output)
        return bytes(memoryview(output.GetPointData().GetArray("Colors")))

    def cast(self):
        origins, directions, output = vtkPoints(), vtkDoubleArray(), vtkPolyData()
        directions.SetNumberOfComponents(3)
        for z in range(5, 250, 5):
            origins.InsertNextPoint(100.0, -500.0, z)
            directions.InsertNextTuple3(0.0, 1.0, 0.0)
        assert self.mapper.CastRays(self.volume, origins, directions, output)
        return bytes(memoryview(output.GetPointData().GetArray("CellId")))
