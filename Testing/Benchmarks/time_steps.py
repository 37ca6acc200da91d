#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a time step costs, as a table in Markdown: STEPS files of EDGE^3 samples, written by VTK into a folder that is
removed, are drawn one after the other. Between two, the picture is drawn again for SECONDS.

    time_steps.py [--steps STEPS] [--edge EDGE] [--seconds SECONDS] [--folder FOLDER]"""

import argparse
import os
import resource
import statistics
import tempfile
import time
from pathlib import Path

from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkMappedImageReader
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOImage import vtkMetaImageReader, vtkMetaImageWriter
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkVolume

SIZE, ISOVALUE = 512, 157.0


def write_step(path, step, edge):
    """Waves that become shorter."""
    source, writer = vtkRTAnalyticSource(), vtkMetaImageWriter()
    source.SetWholeExtent(*3 * (0, edge - 1))
    source.SetCenter(*3 * (edge / 2,))
    source.SetXFreq(12.0 + 0.25 * step)
    source.SetYFreq(8.0 + 0.1 * step)
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetCompression(False)
    writer.SetFileName(str(path))
    writer.SetRAWFileName(str(path.with_suffix(".raw")))
    writer.Write()


def drop_pages(paths):
    """From the memory of the system."""
    for path in paths:
        with open(path.with_suffix(".raw"), "rb") as file:
            os.fsync(file.fileno())
            os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


def new_reader(kind, paths):
    """Returns a reader, and a function that has it give a step."""
    reader = kind()

    def go_to_file(step):
        reader.SetFileName(str(paths[step]))
        reader.Update()

    return reader, go_to_file


def new_series(paths):
    reader, names = vtkMappedImageReader(), vtkStringArray()
    for path in paths:
        names.InsertNextValue(str(path))
    reader.SetFileNames(names)
    return reader, reader.UpdateTimeStep


class Scene:
    def __init__(self, reader):
        self.mapper, self.volume, self.picture = vtkIsosurfaceRayTraceMapper(), vtkVolume(), vtkImageData()
        self.mapper.SetInputConnection(reader.GetOutputPort())
        self.volume.SetMapper(self.mapper)
        look = self.volume.GetProperty()
        look.ShadeOn()
        look.GetIsoSurfaceValues().SetValue(0, ISOVALUE)
        look.GetScalarOpacity().AddPoint(ISOVALUE, 1.0)
        self.renderer = vtkRenderer()
        self.renderer.GetActiveCamera().Elevation(30.0)

    def draw(self):
        camera = self.renderer.GetActiveCamera()
        assert self.mapper.RenderToImage(self.volume, camera, None, SIZE, SIZE, self.picture)


def measure_step(scene, go_to, reader, step, seconds):
    """Milliseconds until the step is there, of the pass over it, of the first frame, of one more; and page faults."""
    faults = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    start = time.perf_counter()
    go_to(step)
    opened = time.perf_counter()
    if step == 0:
        scene.renderer.ResetCamera(reader.GetOutput().GetBounds())
    scene.draw()
    drawn = time.perf_counter()
    faults = resource.getrusage(resource.RUSAGE_SELF).ru_minflt - faults
    build = scene.mapper.GetMacrocellBuildTime()
    again = []
    while not again or time.perf_counter() - drawn < seconds:
        begin = time.perf_counter()
        scene.draw()
        again.append(time.perf_counter() - begin)
    times = opened - start, build, drawn - opened - build, drawn - start, min(again)
    return [1e3 * value for value in times] + [faults]


def measure(name, source, paths, are_dropped, seconds):
    if are_dropped:
        drop_pages(paths)
    reader, go_to = source
    scene = Scene(reader)
    rows = [measure_step(scene, go_to, reader, step, seconds) for step in range(len(paths))]
    *times, faults = (statistics.median(column) for column in zip(*rows[1:]))  # Nobody reads ahead of the first.
    before = "none" if are_dropped else "all"
    print(f"| {name} | {before} | {' | '.join(f'{value:.1f}' for value in times)} | {faults:.0f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--edge", type=int, default=256)
    parser.add_argument("--seconds", type=float, default=0.5)
    parser.add_argument("--folder")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=arguments.folder) as folder:
        paths = [Path(folder) / f"step{step}.mhd" for step in range(arguments.steps)]
        for step, path in enumerate(paths):
            write_step(path, step, arguments.edge)
        print("| steps | files in memory before | open or read, ms | pass, ms | first frame, ms | sum, ms | "
              "the frame again, ms | page faults |\n|---|---|---|---|---|---|---|---|")
        for are_dropped in (False, True):
            for name, source in (
                ("mapped, as time steps", new_series(paths)),
                ("mapped, each by its name", new_reader(vtkMappedImageReader, paths)),
                ("read into memory", new_reader(vtkMetaImageReader, paths)),
            ):
                measure(name, source, paths, are_dropped, arguments.seconds)


if __name__ == "__main__":
    main()
