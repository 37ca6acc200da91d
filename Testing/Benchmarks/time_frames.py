#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Time frames of 512 x 512 pixels from eight sides, of several mappers in turn:

    time_frames.py kinds VOLUME ISOVALUE           kinds of data beside an image, on one thread
    time_frames.py interpolation VOLUME ISOVALUE   tricubic beside trilinear isosurfaces
    time_frames.py projection VOLUME               maximum intensity beside the fixed-point mapper
    time_frames.py secondary DATA ISOVALUE...      shadows and ambient occlusion beside neither, on one
                                                   thread; DATA is a VOLUME, or MESH.vtu:ARRAY
    time_frames.py multisampling VOLUME ISOVALUE   windows with as many samples of a pixel as they have
                                                   by default, and without
    time_frames.py rays DATA ISOVALUE              not frames, but 25 600 rays of CastRays in several
                                                   orders, on one thread
    time_frames.py options VOLUME ISOVALUE LOWER   not frames, but pictures of 800 x 800 pixels by
                                                   render() of the Python package, with its options;
                                                   LOWER is the isovalue of a translucent surface

With --size N in front, pictures have N x N pixels. In time of the processors, all threads together; that of windows with samples, and of render(), in time that
passes."""

import argparse
import inspect
import math
import statistics
import sys
import time

import numpy
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, for its factories
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkPolyData, vtkRectilinearGrid
from vtkmodules.vtkIOImage import vtkImageReader2Factory, vtkNIFTIImageReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume, vtkWindowToImageFilter
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper
from vtkIsosurfaceRayTracing import isosurface, render, vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper

VIEWS, FRAMES = 8, 3
ROWS = 160  # of rays


def read(name):
    reader = (vtkNIFTIImageReader() if name.endswith((".nii", ".nii.gz"))
              else vtkImageReader2Factory.CreateImageReader2(name))
    if reader is None:
        sys.exit(f"VTK has no image reader for {name}")
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()


def new_volume(image, mapper):
    mapper.SetInputData(image)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().SetInterpolationTypeToLinear()
    return volume


def read_mesh(name, array):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    mesh = reader.GetOutput()
    if mesh.GetPointData().SetActiveScalars(array) < 0:
        sys.exit(f"{name} has no point data {array}")
    return mesh


def new_isosurface(data, isovalue, mode=vtkIsosurfaceRayTraceMapper.TRILINEAR):
    if data.IsA("vtkUnstructuredGrid"):
        volume = new_volume(data, vtkIsosurfaceRayTraceMeshMapper())
    else:
        volume = new_volume(data, vtkIsosurfaceRayTraceMapper())
        volume.GetMapper().SetInterpolationMode(mode)
    look = volume.GetProperty()
    look.ShadeOn()
    look.GetIsoSurfaceValues().SetValue(0, isovalue)
    look.GetRGBTransferFunction().AddRGBPoint(isovalue, 1.0, 1.0, 1.0)
    look.GetScalarOpacity().AddPoint(isovalue, 1.0)
    return volume


def make_rectilinear(image):
    """The same samples, between planes half as near to half as far again as those of the image."""
    grid = vtkRectilinearGrid()
    grid.SetDimensions(image.GetDimensions())
    setters = grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates
    for set_coordinates, count, first, spacing in zip(
            setters, image.GetDimensions(), image.GetOrigin(), image.GetSpacing()):
        coordinates = vtkDoubleArray()
        for i in range(count):
            coordinates.InsertNextValue(first + spacing * (i + 2.0 * math.sin(0.25 * i)))
        set_coordinates(coordinates)
    grid.GetPointData().ShallowCopy(image.GetPointData())
    return grid


def blank_cells(image):
    """The same image, in which every fiftieth cell is blanked."""
    ghosts = vtkUnsignedCharArray()
    ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
    ghosts.SetNumberOfTuples(image.GetNumberOfCells())
    ghosts.Fill(0)
    for cell in range(0, image.GetNumberOfCells(), 50):
        ghosts.SetValue(cell, vtkDataSetAttributes.HIDDENCELL)
    blanked = image.NewInstance()
    blanked.ShallowCopy(image)
    blanked.GetCellData().AddArray(ghosts)
    return blanked


def crop(volume):
    """Shows the bars of a fence between planes at 0.4 and 0.6 of the volume along each axis."""
    low = volume.GetMapper().GetBounds()
    planes = [low[2 * axis] + share * (low[2 * axis + 1] - low[2 * axis])
              for axis in range(3) for share in (0.4, 0.6)]
    volume.GetMapper().CroppingOn()
    volume.GetMapper().SetCroppingRegionPlanes(planes)
    volume.GetMapper().SetCroppingRegionFlagsToFence()


def new_projection(image, mapper):
    volume = new_volume(image, mapper)
    mapper.SetBlendModeToMaximumIntensity()
    low, high = image.GetScalarRange()
    look = volume.GetProperty()
    look.GetRGBTransferFunction().AddRGBPoint(low, 0.0, 0.0, 0.0)
    look.GetRGBTransferFunction().AddRGBPoint(high, 1.0, 1.0, 1.0)
    look.GetScalarOpacity().RemoveAllPoints()
    look.GetScalarOpacity().AddPoint(low, 0.0)
    look.GetScalarOpacity().AddPoint(high, 1.0)
    return volume


def get_size(default=512):
    return ARGUMENTS.size or default


def measure(volumes, clock, prepare=lambda volume, view: None, look=lambda window: None, samples=0):
    """The ms of the first frames after prepare(volume, view), and of the frames that follow, which
    look(window) is shown. Each pixel of the window has as many samples; 0 for one."""
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(samples)
    window.SetSize(get_size(), get_size())
    window.AddRenderer(renderer)
    firsts, frames = ({name: [] for name in volumes} for _ in range(2))
    for view in range(VIEWS):
        for name, volume in volumes.items():
            renderer.RemoveAllViewProps()
            renderer.AddVolume(volume)
            renderer.ResetCamera()
            renderer.GetActiveCamera().Zoom(1.6)
            prepare(volume, view)
            for times in (firsts, *[frames] * FRAMES):
                start = clock()
                window.Render()
                window.WaitForCompletion()
                times[name].append(1e3 * (clock() - start))
            look(window)
        renderer.GetActiveCamera().Azimuth(360 / VIEWS)
    return firsts, frames


def describe(times):
    return f"{statistics.median(times):.0f} ({min(times):.0f}-{max(times):.0f})"


def print_table(titles, columns):
    """The times of columns by name, and what they are to the first of the names."""
    print(f"| method | {' | '.join(titles)} | times the first's |\n|{'---|' * (len(titles) + 2)}")
    for name, own in columns[0].items():
        ratio = statistics.median(a / b for a, b in zip(own, next(iter(columns[0].values()))))
        cells = [describe(column[name]) for column in columns]
        print(f"| {name} | {' | '.join(cells)} | {ratio:.2f} |")


def time_kinds(file_name, isovalue):
    image, isovalue = read(file_name), float(isovalue)
    mapper = vtkIsosurfaceRayTraceMapper
    volumes = {
        "image": new_isosurface(image, isovalue, mapper.TRILINEAR),
        "rectilinear grid": new_isosurface(make_rectilinear(image), isovalue, mapper.TRILINEAR),
        "cropped to a fence": new_isosurface(image, isovalue, mapper.TRILINEAR),
        "blanked cells": new_isosurface(blank_cells(image), isovalue, mapper.TRILINEAR),
        "boxes": new_isosurface(image, isovalue, mapper.NEAREST),
        "tricubic": new_isosurface(image, isovalue, mapper.CUBIC),
    }
    crop(volumes["cropped to a fence"])
    for volume in volumes.values():
        volume.GetMapper().SetNumberOfThreads(1)
    _, frames = measure(volumes, time.process_time)
    print_table(["processor ms per frame"], [frames])


def time_interpolation(file_name, isovalue):
    image, isovalue = read(file_name), float(isovalue)
    volumes = {
        "trilinear": new_isosurface(image, isovalue, vtkIsosurfaceRayTraceMapper.TRILINEAR),
        "tricubic": new_isosurface(image, isovalue, vtkIsosurfaceRayTraceMapper.CUBIC),
    }

    def change_isovalue(volume, view):
        volume.GetProperty().GetIsoSurfaceValues().SetValue(0, isovalue + 1e-3 * view)

    firsts, frames = measure(volumes, time.process_time, change_isovalue)
    print_table(["processor ms per frame", "first frame with an isovalue"], [frames, firsts])


def time_projection(file_name):
    image = read(file_name)
    volumes = {"this mapper": new_projection(image, vtkIsosurfaceRayTraceMapper())}
    for name in ("nearest (its default)", "linear", "linear, 10 samples per cell"):
        mapper = vtkFixedPointVolumeRayCastMapper()
        volumes[f"fixed-point, {name}"] = new_projection(image, mapper)
    volumes["fixed-point, nearest (its default)"].GetProperty().SetInterpolationTypeToNearest()
    mapper.AutoAdjustSampleDistancesOff()
    mapper.SetSampleDistance(0.1 * min(image.GetSpacing()))
    for volume in volumes.values():
        volume.GetMapper().SetNumberOfThreads(1)
    _, frames = measure(volumes, time.process_time)
    print_table(["processor ms per frame"], [frames])


def count_hits(window, counts):
    """Appends the number of pixels that are not background, which is black."""
    pixels = vtkWindowToImageFilter()
    pixels.SetInput(window)
    pixels.ReadFrontBufferOff()
    pixels.ShouldRerenderOff()
    pixels.Update()
    colors = vtk_to_numpy(pixels.GetOutput().GetPointData().GetScalars())
    counts.append(int(numpy.count_nonzero(colors.any(axis=1))))


def time_secondary(data_name, *isovalues):
    """All isosurfaces are opaque. Of times a ray, those of all rays of a kind are the same."""
    file_name, _, array = data_name.partition(":")
    data = read_mesh(file_name, array) if array else read(file_name)
    rays = {"neither": 1, "shadows": 1, "ambient occlusion, 16 rays": 16}
    volumes = {name: new_isosurface(data, float(isovalues[0])) for name in rays}
    for volume in volumes.values():
        volume.GetMapper().SetNumberOfThreads(1)
        for i, isovalue in enumerate(isovalues):
            volume.GetProperty().GetIsoSurfaceValues().SetValue(i, float(isovalue))
    volumes["shadows"].GetMapper().ShadowsOn()
    occluded = volumes["ambient occlusion, 16 rays"].GetMapper()
    occluded.AmbientOcclusionOn()
    occluded.SetNumberOfAmbientOcclusionRays(16)
    hits = []
    _, frames = measure(volumes, time.process_time, look=lambda window: count_hits(window, hits))
    if 0 in hits:
        sys.exit("no ray hits any of the isosurfaces")
    print("| picture | processor ms per frame | ns a ray that hits, or starts at a hit |\n|---|---|---|")
    plain = frames["neither"]
    for name, own in frames.items():
        of_ray = [1e6 * (a - (b if name != "neither" else 0.0)) / (rays[name] * count)
                  for a, b, count in zip(own, plain, numpy.repeat(hits[::len(rays)], FRAMES))]
        print(f"| {name} | {describe(own)} | {describe(of_ray)} |")


def time_multisampling(file_name, isovalue):
    volumes = {"an empty window": vtkVolume(), "the isosurface": new_isosurface(read(file_name), float(isovalue))}
    samples = vtkRenderWindow().GetMultiSamples()
    _, without = measure(volumes, time.perf_counter)
    _, frames = measure(volumes, time.perf_counter, samples=samples)
    print(f"| what | without multisampling, ms | {samples} samples, ms |\n|---|---|---|")
    for name in volumes:
        print(f"| {name} | {statistics.median(without[name]):.1f} | {statistics.median(frames[name]):.1f} |")


def make_rays(data):
    """Points on rays, and their directions, of length one, by the order of the rays."""
    random = numpy.random.default_rng(1)
    bounds = numpy.reshape(data.GetBounds(), (3, 2))
    size = bounds[:, 1] - bounds[:, 0]
    places = (numpy.arange(ROWS) + 0.5) / ROWS
    rows = [[x, y, 0.5] for y in places for x in places] * size + bounds[:, 0]
    parallel = numpy.tile(numpy.array([0.1, 0.2, 1.0]) / math.hypot(0.1, 0.2, 1.0), (ROWS * ROWS, 1))
    anywhere = random.uniform(bounds[:, 0], bounds[:, 1], rows.shape)
    directions = random.normal(size=rows.shape)
    directions /= numpy.linalg.norm(directions, axis=1, keepdims=True)
    return {
        "parallel, row by row": (rows, parallel),
        "the same, in any order": (random.permutation(rows), parallel),
        "anywhere, in any direction": (anywhere, directions),
    }


def time_cast(volume, points, directions):
    """The ns of a ray, and the hits of a ray, of rays from outside of the data."""
    far = 2.0 * volume.GetMapper().GetDataSetInput().GetLength()
    origins, hits = vtkPoints(), vtkPolyData()
    origins.SetData(numpy_to_vtk(points - far * directions, deep=True))
    times = []
    for _ in range(1 + 2 * FRAMES):
        start = time.process_time()
        volume.GetMapper().CastRays(volume, origins, numpy_to_vtk(directions, deep=True), hits)
        times.append(1e9 * (time.process_time() - start) / len(points))
    return [describe(times[1:]), f"{hits.GetNumberOfPoints() / len(points):.2f}"]


def time_rays(data_name, isovalue):
    """The hits are described, too: their places, normals, cells, and values."""
    file_name, _, array = data_name.partition(":")
    data, isovalue = read_mesh(file_name, array) if array else read(file_name), float(isovalue)
    volumes = [new_isosurface(data, isovalue) for _ in range(2)]
    volumes[1].GetProperty().GetScalarOpacity().AddPoint(isovalue, 0.3)
    for volume in volumes:
        volume.GetMapper().SetNumberOfThreads(1)
    print("| rays | opaque, ns a ray | hits a ray | translucent, ns a ray | hits a ray |\n|---|---|---|---|---|")
    for name, rays in make_rays(data).items():
        print(f"| {name} | {' | '.join(cell for volume in volumes for cell in time_cast(volume, *rays))} |", flush=True)


def time_options(file_name, isovalue, lower):
    image, isovalue, both = read(file_name), float(isovalue), [float(lower), float(isovalue)]
    volumes = {"default": isosurface(image, isovalue), "samples=1": isosurface(image, isovalue, samples=1),
               "two isovalues, one translucent": isosurface(image, both)}
    for option in ({"clip": "x"}, {"shadows": True}, {"occlusion": True}, {"interpolation": "cubic"}):
        name = ", ".join(f"{name}={value!r}" for name, value in option.items())
        volumes[name] = isosurface(image, isovalue, **option)
    times = {name: [] for name in volumes}
    for repeat in range(FRAMES + 1):
        for name, volume in volumes.items():
            start = time.perf_counter()
            render(volume, size=[get_size(800)] * 2)
            if repeat > 0:  # what is built for the data is there
                times[name].append(1e3 * (time.perf_counter() - start))
    print_table(["ms per picture"], [times])


KINDS = {
    "kinds": time_kinds, "interpolation": time_interpolation, "projection": time_projection, "secondary": time_secondary,
    "multisampling": time_multisampling, "rays": time_rays, "options": time_options}  # fmt: skip


def parse_arguments():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--size", type=int)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("arguments", nargs="*")
    arguments = parser.parse_args()
    try:
        inspect.signature(KINDS[arguments.kind]).bind(*arguments.arguments)
    except TypeError as error:
        parser.error(str(error))
    return arguments


ARGUMENTS = parse_arguments()
KINDS[ARGUMENTS.kind](*ARGUMENTS.arguments)
