# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of data, one for each process of MPI, and pictures of them."""

import itertools
import unittest

from mpi4py import MPI
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkImageData, vtkPlane
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkPointDataToCellData
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController
from vtkmodules.vtkParallelMPI4Py import vtkMPI4PyCommunicator
from vtkmodules.vtkRenderingCore import vtkCamera, vtkVolume
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper
from vtkIsosurfaceRayTracing.vtkIsosurfaceRayTracingParallel import vtkIsosurfaceRayTraceCompositor

WORLD = MPI.COMM_WORLD
RANK, SIZE = WORLD.Get_rank(), WORLD.Get_size()
CONTROLLER = vtkMPIController()
CONTROLLER.SetCommunicator(vtkMPI4PyCommunicator.ConvertToVTK(WORLD))
vtkMultiProcessController.SetGlobalController(CONTROLLER)

# The cells [low, high) along each axis.
CELLS = ((-16, 17), (-15, 15), (-13, 14))


def split(box, parts):
    """So many boxes of cells, [low, high) along each axis, as even as may be."""
    if parts == 1:
        return [box]
    axis = max(range(3), key=lambda k: box[k][1] - box[k][0])
    low, high = box[axis]
    middle = low + (high - low) * (parts // 2) // parts
    sides = []
    for side, count in (((low, middle), parts // 2), ((middle, high), parts - parts // 2)):
        sides += split(box[:axis] + (side,) + box[axis + 1:], count)
    return sides


def make_piece(own, ghosts, cells=CELLS):
    """The cells of a box, and layers of cells of others around them."""
    low = [max(cells[k][0], own[k][0] - ghosts) for k in range(3)]
    high = [min(cells[k][1], own[k][1] + ghosts) for k in range(3)]
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(*[end for pair in cells for end in pair])
    source.UpdateExtent([end for pair in zip(low, high) for end in pair])
    piece = source.GetOutput()
    flags = vtkUnsignedCharArray()
    flags.SetName(vtkDataSetAttributes.GhostArrayName())
    for z, y, x in itertools.product(*[range(low[k], high[k]) for k in (2, 1, 0)]):
        is_own = all(a <= k < b for (a, b), k in zip(own, (x, y, z)))
        flags.InsertNextValue(0 if is_own else vtkDataSetAttributes.DUPLICATECELL)
    piece.GetCellData().AddArray(flags)
    return piece


def with_cell_scalars(piece):
    ghosts = piece.GetCellData().GetArray(vtkDataSetAttributes.GhostArrayName())
    piece.GetCellData().RemoveArray(vtkDataSetAttributes.GhostArrayName())
    average = vtkPointDataToCellData()
    average.SetInputData(piece)
    average.Update()
    cells = average.GetOutput()
    cells.GetCellData().AddArray(ghosts)
    return cells


def with_few_values(piece):
    """Rays have their largest value at many points."""
    scalars = piece.GetPointData().GetScalars()
    for i in range(scalars.GetNumberOfTuples()):
        scalars.SetValue(i, min(200.0, 50.0 * round(scalars.GetValue(i) / 50.0)))
    return piece


def as_mesh(piece):
    append = vtkAppendFilter()
    append.AddInputData(piece)
    append.Update()
    return append.GetOutput()


def make_volume(data, opacities=(1.0,), isovalues=(157.0,), mapper_class=vtkIsosurfaceRayTraceMapper, settings=()):
    mapper = mapper_class()
    if data:
        mapper.SetInputDataObject(data)
    mapper.SetNumberOfThreads(1)
    for name, *values in settings:
        getattr(mapper, name)(*values)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().ShadeOn()
    for i, (isovalue, opacity) in enumerate(zip(isovalues, opacities)):
        volume.GetProperty().GetIsoSurfaceValues().SetValue(i, isovalue)
        volume.GetProperty().GetScalarOpacity().AddPoint(isovalue, opacity)
    colors = volume.GetProperty().GetRGBTransferFunction()
    colors.AddRGBPoint(60.0, 0.2, 0.3, 0.9)
    colors.AddRGBPoint(260.0, 0.9, 0.4, 0.1)
    return volume


def make_camera(is_parallel=False):
    camera = vtkCamera()
    camera.SetPosition(41.0, 63.0, 52.0)
    camera.SetFocalPoint(0.5, 0.0, 0.5)
    camera.SetViewUp(0.1, 0.0, 1.0)
    camera.SetClippingRange(30.0, 160.0)
    camera.SetViewAngle(32.0)
    camera.SetParallelProjection(is_parallel)
    camera.SetParallelScale(23.0)
    return camera


def pixels_of(picture):
    """The colours and the depth of each pixel."""
    colors = picture.GetPointData().GetArray("Colors")
    depths = picture.GetPointData().GetArray("Depth")
    return [(colors.GetTuple(i), depths.GetValue(i)) for i in range(picture.GetNumberOfPoints())]


def make_plane():
    plane = vtkPlane()
    plane.SetOrigin(1.3, 0.2, 0.4)
    plane.SetNormal(-1.0, -0.7, -0.2)
    return plane


def render(volume, camera, size, lights=None, compositor=None, depths=None):
    picture = vtkImageData()
    compositor = compositor or vtkIsosurfaceRayTraceCompositor()
    return compositor.RenderToImage(volume, camera, lights, *size, picture, depths), picture


def whole_picture(volume, camera, size, lights=None):
    picture = vtkImageData()
    assert volume.GetMapper().RenderToImage(volume, camera, lights, *size, picture)
    return pixels_of(picture)


def on_first(check):
    """What process 0 finds, as an answer for all: none waits for another that has given up."""
    problem = None
    if RANK == 0:
        problem = check()
    return WORLD.bcast(problem, root=0)


class Errors:
    """The errors of objects, which are not printed."""

    def __init__(self, *objects):
        self.texts = []

        def keep(caller, event, text):
            self.texts.append(text)

        keep.CallDataType = "string0"
        for each in objects:
            each.AddObserver("ErrorEvent", keep)


class PicturesOfMany(unittest.TestCase):
    """Tests of pictures that many processes make."""

    def check_against_whole(
        self, picture, volume, camera=make_camera(), size=(160, 120), lights=None, name="", depth_tolerance=0.0
    ):
        def differ(one, other):
            return one[0] != other[0] or abs(one[1] - other[1]) > depth_tolerance

        def compare():
            expected = whole_picture(volume, camera, size, lights)
            found = pixels_of(picture)
            covered = sum(color[3] > 0 for color, _ in expected)
            different = sum(differ(a, b) for a, b in zip(found, expected))
            answer = f"{name or self.id().split('.')[-1]}, {SIZE} processes: {different} of {covered} pixels differ"
            print(answer)
            is_fine = len(found) == len(expected) and covered > len(expected) // 8 and different == 0
            return None if is_fine else answer

        self.assertIsNone(on_first(compare))

    def check_failure(self, volume, pattern, of_process, camera=make_camera(), size=(40, 30), depths=None):
        """No process has a picture; one says why, and process 0 says which one does."""
        compositor = vtkIsosurfaceRayTraceCompositor()
        volumes = [volume] if volume.IsA("vtkVolume") else list(volume)
        errors = Errors(compositor, *[each.GetMapper() for each in volumes])
        is_rendered, _ = render(volume, camera, size, compositor=compositor, depths=depths)
        self.assertFalse(is_rendered)
        if RANK == of_process:
            self.assertRegex(errors.texts[0], pattern)
        if RANK == 0 and of_process > 0:
            self.assertRegex(errors.texts[-1], f"see the errors of these processes: {of_process}\\.")
        if RANK not in (0, of_process):
            self.assertEqual(errors.texts, [])
