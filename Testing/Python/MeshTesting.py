# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the mapper of meshes share: grids with known values, rays, reports."""

import math

from vtkmodules.vtkCommonCore import vtkCommand, vtkDoubleArray, vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_POLYHEDRON, vtkPolyData, vtkStructuredGrid, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkCellTypeSource
from vtkmodules.vtkRenderingCore import vtkVolume
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMeshMapper

SIZE = 6
CENTER = (3.1, 2.9, 3.05)
RADIUS = 2.2


def set_values(grid, value):
    """Point scalars, by a function of the position."""
    scalars = vtkDoubleArray()
    scalars.SetName("values")
    for i in range(grid.GetNumberOfPoints()):
        scalars.InsertNextValue(value(grid.GetPoint(i)))
    grid.GetPointData().SetScalars(scalars)
    return grid


def plane(point):
    return point[0] + 0.5 * point[1] - 0.25 * point[2]


def ball(point):
    return RADIUS - math.dist(point, CENTER)


def make_grid(shape, value):
    source = vtkCellTypeSource()
    source.SetCellType(shape)
    source.SetBlocksDimensions(SIZE, SIZE, SIZE)
    source.SetOutputPrecision(1)
    source.Update()
    return set_values(source.GetOutput(), value)


def make_structured_grid(value):
    points = vtkPoints()
    for z in range(SIZE + 1):
        for y in range(SIZE + 1):
            for x in range(SIZE + 1):
                points.InsertNextPoint(x + 0.1 * math.sin(y), y + 0.1 * math.sin(z), z)
    grid = vtkStructuredGrid()
    grid.SetDimensions(SIZE + 1, SIZE + 1, SIZE + 1)
    grid.SetPoints(points)
    return set_values(grid, value)


def make_volume(grid, *isovalues, mapper_class=vtkIsosurfaceRayTraceMeshMapper, opacity=1.0):
    mapper = mapper_class()
    mapper.AutoAdjustSampleDistancesOff()
    if grid:
        mapper.SetInputDataObject(grid)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    surface = volume.GetProperty()
    surface.ShadeOn()
    colors, opacities = surface.GetRGBTransferFunction(), surface.GetScalarOpacity()
    colors.RemoveAllPoints()
    opacities.RemoveAllPoints()
    for i, isovalue in enumerate(isovalues):
        surface.GetIsoSurfaceValues().SetValue(i, isovalue)
        colors.AddRGBPoint(isovalue, 0.9, 0.7, 0.5)
        opacities.AddPoint(isovalue, opacity)
    return mapper, volume


def insert_polyhedron(grid, faces):
    stream = [len(faces)]
    for face in faces:
        stream += [len(face), *face]
    ids = vtkIdList()
    for number in stream:
        ids.InsertNextId(number)
    grid.InsertNextCell(VTK_POLYHEDRON, ids)


def make_polyhedra(hexahedra):
    """A grid of hexahedra as one of polyhedra."""
    grid = vtkUnstructuredGrid()
    grid.SetPoints(hexahedra.GetPoints())
    grid.GetPointData().ShallowCopy(hexahedra.GetPointData())
    for i in range(hexahedra.GetNumberOfCells()):
        cell = hexahedra.GetCell(i)
        insert_polyhedron(grid, [[cell.GetFace(k).GetPointId(j) for j in range(4)] for k in range(6)])
    return grid


def cast(mapper, volume, rays):
    """The hits of rays, given by origins and directions: (ray, t, cell, normal)."""
    origins = vtkPoints()
    origins.SetDataTypeToDouble()
    directions = vtkDoubleArray()
    directions.SetNumberOfComponents(3)
    for origin, direction in rays:
        origins.InsertNextPoint(origin)
        directions.InsertNextTuple(direction)
    output = vtkPolyData()
    if not mapper.CastRays(volume, origins, directions, output):
        return None
    data = output.GetPointData()
    return [(int(data.GetArray("RayId").GetTuple1(i)), data.GetArray("T").GetTuple1(i),
             int(data.GetArray("CellId").GetTuple1(i)), data.GetArray("Normals").GetTuple3(i))
            for i in range(output.GetNumberOfPoints())]  # fmt: skip


def parallel_rays(count=15):
    """From below, through the whole grid."""
    step = SIZE / count
    return [((step * (i + 0.37), step * (j + 0.41), -1.0), (0.03, 0.02, 1.0))
            for i in range(count) for j in range(count)]  # fmt: skip


def errors_of(mapper, call, event=vtkCommand.ErrorEvent):
    """What is reported while something is called."""
    messages = []

    def keep(_caller, _event, message):
        messages.append(message)

    keep.CallDataType = "string0"
    tag = mapper.AddObserver(event, keep)
    call()
    mapper.RemoveObserver(tag)
    return messages
