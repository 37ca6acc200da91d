#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the cloud of a mesh takes whose cells are dealt out, in short runs, to 1 to 8 processes, as tables in Markdown.

    cloud_processes.py mesh.vtu array
    cloud_processes.py cubes

The cells of the mesh have one shape; without a file it is so many cubes along each axis, in tetrahedra. Each process
has one thread. Run by mpirun with further arguments, it is such a process."""

import hashlib
import json
import os
import resource
import subprocess
import sys
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkMath
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import vtkCamera, vtkVolume
from vtkIsosurfaceRayTracing import vtkCellProjectionMapper

FRAMES = 3


def read(path, array):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    reader.GetOutput().GetPointData().SetActiveScalars(array)
    return reader.GetOutput()


def make(cubes):
    source, cut = vtkRTAnalyticSource(), vtkDataSetTriangleFilter()
    source.SetWholeExtent(0, cubes, 0, cubes, 0, cubes)
    source.SetCenter(0.5 * cubes, 0.5 * cubes, 0.5 * cubes)
    cut.SetInputConnection(source.GetOutputPort())
    cut.Update()
    return cut.GetOutput()


def take_cells(mesh, process, processes):
    """Those of a process: runs of 64."""
    corners = mesh.GetCell(0).GetNumberOfPoints()
    ids = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, corners)
    ids = ids[numpy.arange(len(ids)) // 64 % processes == process]
    cells = vtkCellArray()
    cells.SetData(corners, numpy_to_vtkIdTypeArray(ids.ravel().astype(numpy.int64), deep=True))
    piece = vtkUnstructuredGrid()
    piece.SetPoints(mesh.GetPoints())
    piece.GetPointData().SetScalars(mesh.GetPointData().GetScalars())
    piece.SetCells(mesh.GetCellType(0), cells)
    return piece


def make_camera(mesh):
    camera = vtkCamera()
    center, length = mesh.GetCenter(), mesh.GetLength()
    direction = [0.4, -0.9, 0.36]
    vtkMath.Normalize(direction)
    camera.SetFocalPoint(center)
    camera.SetPosition([x + 1.4 * length * d for x, d in zip(center, direction)])
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetClippingRange(0.5 * length, 3.0 * length)
    return camera


def make_volume(piece):
    mapper = vtkCellProjectionMapper()
    mapper.SetInputData(piece)
    mapper.SetNumberOfThreads(1)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    low, high = piece.GetPointData().GetScalars().GetRange()
    for part, opacity, color in ((0.0, 0.0, (0.1, 0.2, 0.9)), (0.3, 0.15, (0.1, 0.8, 0.8)),
                                 (0.6, 0.5, (0.9, 0.9, 0.2)), (1.0, 1.0, (0.9, 0.1, 0.1))):
        volume.GetProperty().GetScalarOpacity().AddPoint(low + part * (high - low), opacity)
        volume.GetProperty().GetRGBTransferFunction().AddRGBPoint(low + part * (high - low), *color)
    volume.GetProperty().SetScalarOpacityUnitDistance(piece.GetLength() / 10.0)
    return volume


def run_process(arguments, size, depth, interval):
    """A process: the first prints what all did."""
    from mpi4py import MPI
    from vtkmodules.vtkParallelMPI import vtkMPIController
    from vtkmodules.vtkParallelMPI4Py import vtkMPI4PyCommunicator
    from vtkIsosurfaceRayTracing.vtkIsosurfaceRayTracingParallel import vtkIsosurfaceRayTraceCompositor

    world = MPI.COMM_WORLD
    controller = vtkMPIController()
    controller.SetCommunicator(vtkMPI4PyCommunicator.ConvertToVTK(world))
    mesh = make(int(arguments[0])) if len(arguments) == 1 else read(*arguments)
    volume, camera = make_volume(take_cells(mesh, world.rank, world.size)), make_camera(mesh)
    compositor = vtkIsosurfaceRayTraceCompositor()
    compositor.SetController(controller)
    compositor.SetBufferDepth(depth)
    compositor.SetPollingInterval(interval)
    picture, times = vtkImageData(), []
    for _ in range(FRAMES + 1):
        world.Barrier()
        start, used = time.perf_counter(), resource.getrusage(resource.RUSAGE_SELF)
        if not compositor.RenderToImage(volume, camera, None, size, size, picture):
            world.Abort(1)
        now = resource.getrusage(resource.RUSAGE_SELF)
        cpu = now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime
        times.append((time.perf_counter() - start, world.allreduce(cpu)))
    counts = (compositor.GetSegmentsFound(), compositor.GetSegmentsDrawn(), compositor.GetMostSegmentsStored(),
              compositor.GetBytesSent())
    counts = world.gather(counts)
    if world.rank == 0:
        colors = vtk_to_numpy(picture.GetPointData().GetScalars())
        # The first frame builds the trees.
        seconds, cpu = min(times[1:])
        print(json.dumps({"seconds": seconds, "cpu": cpu, "found": [row[0] for row in counts],
                          "drawn": [row[1] for row in counts], "stored": [row[2] for row in counts],
                          "bytes": [row[3] for row in counts], "picture": hashlib.sha256(colors).hexdigest()}))


def measure(arguments, processes, size=512, depth=4096, interval=1):
    command = ["mpirun", "-n", str(processes), sys.executable, os.path.abspath(__file__), *arguments, str(size),
               str(depth), str(interval)]
    environment = {**os.environ, "OMPI_MCA_rmaps_base_oversubscribe": "1",
                   "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                   "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    result = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(result.stdout.splitlines()[-1])


def print_processes(arguments):
    print("| processes | picture, ms | CPU of all, ms | segments found by a process, most / mean | "
          "drawn by a process, most / mean | sent by all, MB | stored at once by all, at most, % | picture |")
    print("|---|---|---|---|---|---|---|---|")
    alone = None
    for processes in (1, 2, 4, 8):
        run = measure(arguments, processes)
        alone = alone or run["picture"]
        total = sum(run["found"])

        def ratio(counts):
            return f"{max(counts) * processes / total:.2f}" if total else "-"

        stored = f"{100.0 * sum(run['stored']) / total:.1f}" if total else "-"
        same = "the same" if run["picture"] == alone else "ANOTHER"
        print(f"| {processes} | {1e3 * run['seconds']:.0f} | {1e3 * run['cpu']:.0f} | {ratio(run['found'])} | "
              f"{ratio(run['drawn'])} | {1e-6 * sum(run['bytes']):.0f} | {stored} | {same} |", flush=True)


def print_regions(arguments):
    print("\n| tiles | segments | stored at once, at most | % |")
    print("|---|---|---|---|")
    for size in (256, 512, 1024):
        run = measure(arguments, 4, size)
        total, stored = sum(run["found"]), sum(run["stored"])
        print(f"| {(size // 16)**2} | {total} | {stored} | {100.0 * stored / total:.1f} |", flush=True)


def print_buffers(arguments):
    intervals = (1, 16)
    print("\n| buffer depth, segments | " + " | ".join(f"polling interval {i}: ms, stored %" for i in intervals) + " |")
    print("|---" * (1 + len(intervals)) + "|")
    for depth in (256, 4096, 65536):
        cells = []
        for interval in intervals:
            run = measure(arguments, 2, depth=depth, interval=interval)
            cells.append(f"{1e3 * run['seconds']:.0f}, {100.0 * sum(run['stored']) / sum(run['found']):.1f}")
        print(f"| {depth} | " + " | ".join(cells) + " |", flush=True)


def main():
    if len(sys.argv) > 3:
        run_process(sys.argv[1:-3], *map(int, sys.argv[-3:]))
        return
    print_processes(sys.argv[1:])
    print_regions(sys.argv[1:])
    print_buffers(sys.argv[1:])


if __name__ == "__main__":
    main()
