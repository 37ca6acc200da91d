#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Time maximum intensity pictures beside vtkFixedPointVolumeRayCastMapper, from eight sides, in turn:
time_projection.py VOLUME [SIZE]"""

import statistics
import sys
import time

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, for its factories
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from vtkmodules.vtkIOImage import vtkImageReader2Factory
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper


def new_volume(image, mapper, linear=True):
    low, high = image.GetScalarRange()
    mapper.SetInputData(image)
    mapper.SetBlendModeToMaximumIntensity()
    volume = vtkVolume()
    volume.SetMapper(mapper)
    look = volume.GetProperty()
    look.SetInterpolationType(1 if linear else 0)
    look.GetRGBTransferFunction().AddRGBPoint(low, 0.0, 0.0, 0.0)
    look.GetRGBTransferFunction().AddRGBPoint(high, 1.0, 1.0, 1.0)
    look.GetScalarOpacity().RemoveAllPoints()
    look.GetScalarOpacity().AddPoint(low, 0.0)
    look.GetScalarOpacity().AddPoint(high, 1.0)
    return volume


def new_fine_caster(image):
    mapper = vtkFixedPointVolumeRayCastMapper()
    mapper.AutoAdjustSampleDistancesOff()
    mapper.SetSampleDistance(0.1 * min(image.GetSpacing()))
    return mapper


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    reader = vtkImageReader2Factory.CreateImageReader2(sys.argv[1])
    if reader is None:
        sys.exit(f"VTK has no image reader for {sys.argv[1]}")
    reader.SetFileName(sys.argv[1])
    reader.Update()
    image = reader.GetOutput()
    size = int(sys.argv[2]) if len(sys.argv) == 3 else 512
    contestants = {
        "this mapper": new_volume(image, vtkIsosurfaceRayTraceMapper()),
        "fixed-point, as it is (nearest)":
            new_volume(image, vtkFixedPointVolumeRayCastMapper(), linear=False),
        "fixed-point, linear": new_volume(image, vtkFixedPointVolumeRayCastMapper()),
        "fixed-point, linear, 10 samples per cell": new_volume(image, new_fine_caster(image)),
    }
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(1)
    window.SetSize(size, size)
    window.AddRenderer(renderer)
    for volume in contestants.values():
        renderer.AddVolume(volume)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.0, 1.0, 0.2)
    camera.SetViewUp(0.0, 0.0, 1.0)
    renderer.ResetCamera()
    camera.Zoom(1.3)
    times = {name: [] for name in contestants}
    for view in range(9):
        camera.Azimuth(45.0)
        renderer.ResetCameraClippingRange()
        for name, volume in contestants.items():
            for other in contestants.values():
                other.SetVisibility(other is volume)
            start = time.perf_counter()
            window.Render()
            window.WaitForCompletion()
            if view > 0:  # the first builds what is kept
                times[name].append(1e3 * (time.perf_counter() - start))
    ours = times["this mapper"]
    print("| who | frame, ms | times this mapper's |\n|---|---|---|")
    for name, own in times.items():
        ratio = statistics.median(a / b for a, b in zip(own, ours))
        print(f"| {name} | {statistics.median(own):.0f} ({min(own):.0f}-{max(own):.0f}) | {ratio:.2f} |")


main()
