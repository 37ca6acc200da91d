#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a picture by up to thousands of processes would take, as a table in Markdown.

    simulate_processes.py volume.mhd isovalue [most processes]

Each process has a box of the volume. Measured here, one after the other, with one thread: the time to trace each box,
without the time to build its hierarchy, and which pixels it covers. Computed from that: the records that binary swap sends in each
step. Assumed: a network with 2 microseconds of latency and 10 GB/s. The time to merge a record is that of
std::merge on this machine, about 10 nanoseconds. The surface is opaque."""

import statistics
import sys
import time

from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkTable
from vtkmodules.vtkIOImage import vtkMetaImageReader
from vtkmodules.vtkImagingCore import vtkExtractVOI
from vtkmodules.vtkRenderingCore import vtkCamera, vtkVolume
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

SIZE = 1024
RECORD, PIXEL = 24, 8  # bytes sent in the swap, and of a finished pixel
LATENCY, BANDWIDTH, MERGE = 2e-6, 10e9, 10e-9  # seconds, bytes a second, seconds a record


def split(box, parts):
    """So many boxes of cells, a power of two, halved across their longest axis."""
    if parts == 1:
        return [box]
    axis = max(range(3), key=lambda k: box[k][1] - box[k][0])
    low, high = box[axis]
    halves = ((low, (low + high) // 2), ((low + high) // 2, high))
    return [part for half in halves for part in split(box[:axis] + (half,) + box[axis + 1:], parts // 2)]


def extract(image, box):
    """The cells of a box with a layer of ghosts."""
    extent = image.GetExtent()
    low = [max(extent[2 * k], box[k][0] - 1) for k in range(3)]
    high = [min(extent[2 * k + 1], box[k][1] + 1) for k in range(3)]
    voi = vtkExtractVOI()
    voi.SetInputData(image)
    voi.SetVOI([end for pair in zip(low, high) for end in pair])
    voi.Update()
    piece = voi.GetOutput()
    flags = vtkUnsignedCharArray()
    flags.SetName(vtkDataSetAttributes.GhostArrayName())
    flags.SetNumberOfTuples(piece.GetNumberOfCells())
    flags.Fill(vtkDataSetAttributes.DUPLICATECELL)
    size = [b - a for a, b in zip(low, high)]
    for z in range(box[2][0] - low[2], box[2][1] - low[2]):
        for y in range(box[1][0] - low[1], box[1][1] - low[1]):
            first = (box[0][0] - low[0]) + size[0] * (y + size[1] * z)
            for cell in range(first, first + box[0][1] - box[0][0]):
                flags.SetValue(cell, 0)
    piece.GetCellData().AddArray(flags)
    return piece


def make_camera(image):
    camera = vtkCamera()
    center, length = image.GetCenter(), image.GetLength()
    camera.SetFocalPoint(center)
    camera.SetPosition([x + 1.1 * length * d for x, d in zip(center, (0.6, -1.5, 0.8))])
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetClippingRange(0.5 * length, 4.0 * length)
    return camera


def trace(piece, isovalue, camera):
    """The time in seconds, and the pixels that are covered: a bit for each."""
    mapper = vtkIsosurfaceRayTraceMapper()
    mapper.SetInputData(piece)
    mapper.SetNumberOfThreads(1)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().ShadeOn()
    volume.GetProperty().GetIsoSurfaceValues().SetValue(0, isovalue)
    volume.GetProperty().GetScalarOpacity().AddPoint(isovalue, 1.0)
    seconds = []
    for _ in range(3):
        fragments = vtkTable()
        start = time.perf_counter()
        if not mapper.RenderToFragments(volume, camera, None, SIZE, SIZE, fragments):
            sys.exit(1)
        seconds.append(time.perf_counter() - start)
    covered = bytearray(SIZE * SIZE // 8)
    for pixel in memoryview(fragments.GetColumnByName("Pixel")):
        covered[pixel >> 3] |= 1 << (pixel & 7)
    return min(seconds), int.from_bytes(covered, "little")


def count(bits):
    return bits.bit_count() if hasattr(bits, "bit_count") else bin(bits).count("1")


def swap(covered):
    """The seconds of all steps, each as long as that of the slowest process, and the most bytes that one sends."""
    parts, rows, seconds = covered, SIZE, 0.0
    sent = [0] * len(covered)
    step = 1
    while step < len(covered):
        half = rows // 2 * SIZE
        next_parts, slowest = [0] * len(parts), 0.0
        for process in range(len(parts)):
            keeps_lower = process & step == 0
            own, other = parts[process], parts[process ^ step]
            lower = (1 << half) - 1
            given = own >> half if keeps_lower else own & lower
            taken = other & lower if keeps_lower else other >> half
            kept = own & lower if keeps_lower else own >> half
            next_parts[process] = kept | taken
            bytes_sent = RECORD * count(given)
            sent[process] += bytes_sent
            duration = LATENCY + max(bytes_sent, RECORD * count(taken)) / BANDWIDTH
            slowest = max(slowest, duration + MERGE * (count(kept) + count(taken)))
        seconds += slowest
        parts, rows, step = next_parts, rows // 2, 2 * step
    gathering = len(covered) * LATENCY + SIZE * SIZE * PIXEL / BANDWIDTH if len(covered) > 1 else 0.0
    return seconds, gathering, max(sent)


def main():
    reader = vtkMetaImageReader()
    reader.SetFileName(sys.argv[1])
    reader.Update()
    image, isovalue = reader.GetOutput(), float(sys.argv[2])
    most = int(sys.argv[3]) if len(sys.argv) > 3 else 4096
    extent = image.GetExtent()
    box = tuple((extent[2 * k], extent[2 * k + 1]) for k in range(3))
    camera = make_camera(image)
    alone = None
    print("| processes | trace, mean, ms | trace, slowest, ms | swap, ms | gathering, ms | picture, ms | efficiency | sent, at most, MB |")
    print("|---|---|---|---|---|---|---|---|")
    processes = 1
    while processes <= most:
        times, covered = zip(*[trace(extract(image, part), isovalue, camera) for part in split(box, processes)])
        swapping, gathering, sent = swap(covered)
        picture = max(times) + swapping + gathering
        alone = alone or picture
        print(f"| {processes} | {1e3 * statistics.mean(times):.2f} | {1e3 * max(times):.2f} | {1e3 * swapping:.2f} | "
              f"{1e3 * gathering:.2f} | {1e3 * picture:.2f} | {100.0 * alone / (processes * picture):.0f} % | "
              f"{1e-6 * sent:.2f} |", flush=True)
        processes *= 4


if __name__ == "__main__":
    main()
