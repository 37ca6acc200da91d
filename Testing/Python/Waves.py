# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""An opaque isosurface of vtkRTAnalyticSource, for tests."""

from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import vtkVolume


def make_waves():
    """The source of 33^3 samples, the mapper and the volume."""
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-16, 16, -16, 16, -16, 16)
    mapper = vtkIsosurfaceRayTraceMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 157.0)
    volume.GetProperty().GetScalarOpacity().AddPoint(157.0, 1.0)
    return source, mapper, volume
