#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Time pictures of the tricubic interpolant beside those of the trilinear one, from eight sides, in
turn, by the time of the processors: time_interpolation.py VOLUME ISOVALUE [SIZE]"""

import statistics
import sys
import time

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, for its factories
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from vtkmodules.vtkIOImage import vtkImageReader2Factory, vtkNIFTIImageReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper


def read(name):
    reader = (vtkNIFTIImageReader() if name.endswith((".nii", ".nii.gz"))
              else vtkImageReader2Factory.CreateImageReader2(name))
    if reader is None:
        sys.exit(f"VTK has no image reader for {name}")
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()


def new_volume(image, isovalue, mode):
    mapper = vtkIsosurfaceRayTraceMapper()
    mapper.SetInputData(image)
    mapper.SetInterpolationMode(mode)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    look = volume.GetProperty()
    look.ShadeOn()
    look.GetIsoSurfaceValues().SetValue(0, isovalue)
    look.GetRGBTransferFunction().AddRGBPoint(isovalue, 1.0, 1.0, 1.0)
    look.GetScalarOpacity().AddPoint(isovalue, 1.0)
    return volume


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    image, isovalue = read(sys.argv[1]), float(sys.argv[2])
    size = int(sys.argv[3]) if len(sys.argv) == 4 else 512
    contestants = {
        "trilinear": new_volume(image, isovalue, vtkIsosurfaceRayTraceMapper.TRILINEAR),
        "tricubic": new_volume(image, isovalue, vtkIsosurfaceRayTraceMapper.CUBIC),
    }
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(size, size)
    window.AddRenderer(renderer)
    frames = {name: [] for name in contestants}
    firsts = {name: [] for name in contestants}
    for turn in range(8):
        for name, volume in contestants.items():
            renderer.RemoveAllViewProps()
            renderer.AddVolume(volume)
            renderer.ResetCamera()
            renderer.GetActiveCamera().Zoom(1.6)
            for timings in (firsts, frames, frames, frames):
                # The first frame with another isovalue makes what is kept of cells.
                volume.GetProperty().GetIsoSurfaceValues().SetValue(0, isovalue + 1e-3 * turn)
                start = time.process_time()
                window.Render()
                timings[name].append(1000.0 * (time.process_time() - start))
        renderer.GetActiveCamera().Azimuth(45)
    print("| interpolant | processor ms per frame | first frame with an isovalue |")
    print("|---|---|---|")
    for name in contestants:
        print(f"| {name} | {describe(frames[name])} | {describe(firsts[name])} |")
    ratios = [b / a for a, b in zip(*frames.values())]
    print(f"\nRatio of frames: {statistics.median(ratios):.1f} "
          f"({min(ratios):.1f}-{max(ratios):.1f})")


def describe(times):
    return f"{statistics.median(times):.0f} ({min(times):.0f}-{max(times):.0f})"


main()
