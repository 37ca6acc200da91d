#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A volume that is larger than the memory: the first picture and some that follow, as a table in Markdown.

    large_volume.py volume.mhd ISOVALUE MEBIBYTES [BRICK_MEBIBYTES]

The rows of interaction are frames in a window with LevelOfDetail, at 15 frames a second; the others are exact pictures.
The processes that are measured may have so much memory; bricks and masks a part of it (a quarter unless it is given).
The file is one that vtkMappedImageReader maps. Before a run with a cold cache its pages are dropped, which the system
does unless another process uses the file. Macrocells are kept in a temporary directory by the second row, and taken
from there by the two after it."""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "Support"))
from LimitedMemory import LimitedMemory  # noqa: E402

SIZE = 512
PICTURES = 3  # ten degrees apart
FRAMES = 60  # of interaction, one degree apart


def read_memory():
    """Of this process, in MiB: its own, and pages of files."""
    fields = dict(line.split(":") for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines())
    return [int(fields[name].split()[0]) >> 10 for name in ("RssAnon", "RssFile")]


def drop_pages(file_name):
    descriptor = os.open(file_name, os.O_RDONLY)
    os.posix_fadvise(descriptor, 0, 0, os.POSIX_FADV_DONTNEED)
    os.close(descriptor)


def find_samples(file_name):
    """The file of the samples of a MetaImage."""
    (name,) = (line.split(" = ")[1] for line in Path(file_name).read_text(encoding="ascii").splitlines()
               if line.startswith("ElementDataFile"))
    return str(Path(file_name).parent / name)


def new_reader(way, file_name):
    from vtkIsosurfaceRayTracing import vtkMappedImageReader
    from vtkmodules.vtkIOImage import vtkMetaImageReader
    reader = vtkMetaImageReader() if way == "read" else vtkMappedImageReader()
    reader.SetFileName(file_name)
    return reader


def new_window(renderer):
    """In which it is interacted."""
    from vtkmodules.vtkRenderingCore import vtkRenderWindow
    import vtkmodules.vtkRenderingOpenGL2  # what it needs
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(SIZE, SIZE)
    window.SetDesiredUpdateRate(15.0)
    window.AddRenderer(renderer)
    return window


def draw(reader, isovalue, brick_memory, cache, is_interaction):
    """The times of pictures, and the memory after each."""
    from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkVolume
    start = time.perf_counter()
    reader.Update()
    opened = time.perf_counter() - start
    mapper, volume, renderer, picture = vtkIsosurfaceRayTraceMapper(), vtkVolume(), vtkRenderer(), vtkImageData()
    window = new_window(renderer) if is_interaction else None
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.SetMaximumBrickMemory(brick_memory)
    mapper.SetCacheDirectory(cache)
    mapper.SetLevelOfDetail(is_interaction)
    volume.SetMapper(mapper)
    volume.GetProperty().GetIsoSurfaceValues().SetValue(0, isovalue)
    volume.GetProperty().ShadeOn()
    renderer.ResetCamera(reader.GetOutput().GetBounds())
    camera = renderer.GetActiveCamera()
    times, memory = [], []
    renderer.AddVolume(volume)
    for _ in range(FRAMES if is_interaction else PICTURES):
        start = time.perf_counter()
        if is_interaction:
            window.Render()
        else:
            assert mapper.RenderToImage(volume, camera, None, SIZE, SIZE, picture)
        times.append(time.perf_counter() - start)
        memory.append(read_memory())
        camera.Azimuth(1 if is_interaction else 10)
    return {"opened": opened, "times": times, "memory": memory,
            "told": (mapper.GetMacrocellMemory() + mapper.GetBrickMemory()) >> 20}


def extract(reader, isovalue):
    """The time of the triangles, without a picture."""
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
    edges = vtkFlyingEdges3D()
    edges.SetInputConnection(reader.GetOutputPort())
    edges.SetValue(0, isovalue)
    edges.ComputeNormalsOff()
    start = time.perf_counter()
    edges.Update()
    return {"opened": 0.0, "times": [time.perf_counter() - start], "memory": [read_memory()], "told": 0}


def measure(file_name, isovalue, brick_memory, way, cache):
    reader = new_reader(way, file_name)
    if way == "triangles":
        result = extract(reader, isovalue)
    else:
        result = draw(reader, isovalue, brick_memory, cache, way == "interaction")
    print(json.dumps(result))


def run(limited, arguments, way, is_cold, cache=""):
    """None if the system has killed the process."""
    if is_cold:
        drop_pages(find_samples(arguments[0]))
    result = subprocess.run([*limited.prefix, sys.executable, __file__, *arguments, way, cache],
                            stdout=subprocess.PIPE, text=True, check=False)
    if result.returncode not in (0, -9, 137):
        sys.exit(f"{way} failed with {result.returncode}")
    return json.loads(result.stdout) if result.returncode == 0 else None


def make_row(name, cache, result):
    if result is None:
        return f"| {name} | {cache} | killed | - | - | - | - | - |"
    first, *others = result["times"]
    own, files = zip(*result["memory"])
    following = f"{statistics.median(others):.2f}" if others else "-"
    told = result["told"] or "-"
    return (f"| {name} | {cache} | {result['opened']:.3f} | {first:.2f} | {following} | {told} | {max(own)} | "
            f"{max(files)} |")


def main():
    file_name, isovalue, limit = sys.argv[1:4]
    brick_memory = sys.argv[4] if len(sys.argv) > 4 else str(int(limit) // 4)
    arguments = [file_name, isovalue, limit, brick_memory]
    with LimitedMemory(int(limit) << 20) as limited, tempfile.TemporaryDirectory() as cache:
        if not limited.is_possible:
            sys.exit("This system has no control groups for memory that this user may make.")
        print("| samples | pages of the file before | open, s | first picture, s | next, s | "
              "macrocells, bricks, masks, MiB | memory of the process, MiB | pages of files, MiB |\n|---|---|---|---|---|---|---|---|")
        print(make_row("mapped, interaction", "none", run(limited, arguments, "interaction", True)), flush=True)
        print(make_row("mapped", "none", run(limited, arguments, "mapped", True)), flush=True)
        print(make_row("mapped, keeps macrocells", "none", run(limited, arguments, "mapped", True, cache)), flush=True)
        print(make_row("mapped, macrocells kept", "none", run(limited, arguments, "mapped", True, cache)), flush=True)
        for name, directory in (("mapped, macrocells kept", cache), ("mapped", "")):
            print(make_row(name, "those that were left", run(limited, arguments, "mapped", False, directory)), flush=True)
        print(make_row("read into memory", "-", run(limited, arguments, "read", False)))
        print(make_row("mapped, flying edges", "-", run(limited, arguments, "triangles", False)))


if __name__ == "__main__":
    if len(sys.argv) == 7:
        measure(sys.argv[1], float(sys.argv[2]), int(sys.argv[4]), *sys.argv[5:])
    elif len(sys.argv) in (4, 5):
        main()
    else:
        sys.exit(__doc__)
