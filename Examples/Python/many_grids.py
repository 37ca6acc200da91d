#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draw data with several grids, by rays and by triangles:

    many_grids.py VOLUME.mhd ISOVALUE FOLDER [HIERARCHY ARRAY ISOVALUE]

Each picture has rays on the left and, on the right, the triangles that vtkContourFilter extracts
from each grid, as ParaView draws it. Printed are the milliseconds from a new isovalue to a picture
of each. HIERARCHY is the file of an AMR simulation by Enzo, ARRAY one of its arrays of cells.
"""

import os
import sys
import time

from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import (
    VTK_XYZ_GRID,
    vtkAMRBox,
    vtkAMRUtilities,
    vtkCompositeDataSet,
    vtkMultiBlockDataSet,
    vtkOverlappingAMR,
    vtkUniformGrid,
)
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData, vtkContourFilter
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter
from vtkmodules.vtkImagingCore import vtkExtractVOI, vtkImageReslice
from vtkmodules.vtkIOAMR import vtkAMREnzoReader
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCompositeDataDisplayAttributes,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkWindowToImageFilter,
)
import vtkmodules.vtkRenderingOpenGL2
from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

from read_volume import read_volume
from whole_file import write_picture

BONE, SKIN, COPPER = (0.96, 0.90, 0.80), (0.45, 0.75, 0.95), (0.90, 0.60, 0.35)


class Sides:
    """A window with rays on the left and triangles on the right."""

    def __init__(self, size):
        self.mapper = vtkIsosurfaceRayTraceMapper()
        self.mapper.AutoAdjustSampleDistancesOff()
        self.volume = self.make_volume(BONE, 1.0)
        self.volume.SetMapper(self.mapper)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetAlphaBitPlanes(1)
        self.window.SetSize(2 * size, size)
        self.rays, self.triangles = vtkRenderer(), vtkRenderer()
        for i, renderer in enumerate((self.rays, self.triangles)):
            renderer.SetBackground(0.16, 0.18, 0.22)
            renderer.SetViewport(0.5 * i, 0.0, 0.5 * i + 0.5, 1.0)
            renderer.SetUseDepthPeeling(True)
            self.window.AddRenderer(renderer)
        self.triangles.SetActiveCamera(self.rays.GetActiveCamera())
        self.rays.AddVolume(self.volume)
        # What has the first isovalue, and is changed with it.
        self.volumes, self.contours = [self.volume], []

    @staticmethod
    def make_volume(color, opacity):
        volume = vtkVolume()
        surface = volume.GetProperty()
        surface.ShadeOn()
        surface.SetDiffuse(0.9)
        colors, opacities = surface.GetRGBTransferFunction(), surface.GetScalarOpacity()
        colors.RemoveAllPoints()  # A new property has functions from black to white.
        opacities.RemoveAllPoints()
        colors.AddRGBPoint(0.0, *color)
        opacities.AddPoint(0.0, opacity)
        return volume

    def add_triangles(self, data, isovalue, color, opacity=1.0, array=None):
        """Those of an isosurface of a data set. Of a named array of cells, the points have means."""
        contour = vtkContourFilter()
        if array:
            means = vtkCellDataToPointData()
            means.SetInputData(data)
            contour.SetInputConnection(means.GetOutputPort())
            contour.SetInputArrayToProcess(0, 0, 0, 0, array)
        else:
            contour.SetInputData(data)
        contour.SetValue(0, isovalue)
        triangles = contour
        if isinstance(data, vtkCompositeDataSet):
            triangles = vtkCompositeDataGeometryFilter()
            triangles.SetInputConnection(contour.GetOutputPort())
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(triangles.GetOutputPort())
        mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(color)
        actor.GetProperty().SetDiffuse(0.9)
        actor.GetProperty().SetOpacity(opacity)
        self.triangles.AddActor(actor)
        return contour

    def look_from(self, direction, up, zoom):
        camera = self.rays.GetActiveCamera()
        camera.SetPosition(direction)
        camera.SetFocalPoint(0.0, 0.0, 0.0)
        camera.SetViewUp(up)
        self.rays.ResetCamera(self.triangles.ComputeVisiblePropBounds())
        camera.Zoom(zoom)
        self.rays.ResetCameraClippingRange()

    def set_isovalue(self, isovalue):
        for volume in self.volumes:
            volume.GetProperty().GetIsoSurfaceValues().SetValue(0, isovalue)
        for contour in self.contours:
            contour.SetValue(0, isovalue)

    def measure(self, isovalue, renderer):
        """The median time from a new isovalue to a picture of one side, in milliseconds."""
        self.rays.SetDraw(renderer is self.rays)
        self.triangles.SetDraw(renderer is self.triangles)
        seconds = []
        for i in range(8):
            self.set_isovalue(isovalue * (1.0 + 0.001 * (7 - i)))
            start = time.perf_counter()
            self.window.Render()
            seconds.append(time.perf_counter() - start)
        self.rays.DrawOn()
        self.triangles.DrawOn()
        return 1e3 * sorted(seconds[2:])[3]

    def write(self, file_name):
        self.window.Render()
        picture = vtkWindowToImageFilter()
        picture.SetInput(self.window)
        picture.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetInputConnection(picture.GetOutputPort())
        write_picture(writer, file_name)


def cut(image, extent, step=1):
    """A part of an image, of which every step-th point is taken."""
    voi = vtkExtractVOI()
    voi.SetInputData(image)
    voi.SetVOI(extent)
    voi.SetSampleRate(step, step, step)
    voi.Update()
    return voi.GetOutput()


def even(image, number):
    """The extent of the largest part with multiples of a number of cells along each axis."""
    extent = list(image.GetExtent())
    for axis in range(3):
        extent[2 * axis + 1] -= (extent[2 * axis + 1] - extent[2 * axis]) % number
    return extent


def refined(sides, image, isovalue):
    """AMR: every second point of the CT, and all points on its left."""
    whole = even(image, 4)
    left = list(whole)
    left[1] -= (whole[1] - whole[0]) // 8 * 4
    amr = vtkOverlappingAMR()
    if vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() >= 906:
        amr.Initialize([1, 1])
    else:
        amr.Initialize(2, [1, 1])
    origin = image.GetPoint(image.ComputePointId(whole[::2]))
    amr.SetOrigin(origin)
    amr.SetGridDescription(VTK_XYZ_GRID)
    for level, (extent, step) in enumerate(((whole, 2), (left, 1))):
        spacing = [step * length for length in image.GetSpacing()]
        first = [(extent[2 * axis] - whole[2 * axis]) // step for axis in range(3)]
        cells = [(extent[2 * axis + 1] - extent[2 * axis]) // step for axis in range(3)]
        grid = vtkUniformGrid()
        grid.SetDimensions([n + 1 for n in cells])
        grid.SetSpacing(spacing)
        grid.SetOrigin([o + i * length for o, i, length in zip(origin, first, spacing)])
        grid.GetPointData().SetScalars(cut(image, extent, step).GetPointData().GetScalars())
        amr.SetSpacing(level, spacing)
        amr.SetAMRBox(level, 0, vtkAMRBox(first, [f + n - 1 for f, n in zip(first, cells)]))
        amr.SetDataSet(level, 0, grid)
    amr.SetRefinementRatio(0, 2)
    vtkAMRUtilities.BlankCells(amr)
    sides.mapper.SetInputDataObject(amr)
    sides.contours = [sides.add_triangles(amr, isovalue, BONE)]
    sides.look_from((-0.1, 1.1, 0.3), (0.0, 0.0, 1.0), 4.5)


def registered(sides, image, isovalue):
    """Two scans: the skin of the second, which is coarser and turned, around the bone."""
    turn = vtkTransform()
    turn.RotateZ(25.0)
    scan = vtkImageReslice()
    scan.SetInputData(image)
    scan.SetResliceTransform(turn)
    scan.AutoCropOutputOn()
    scan.SetOutputSpacing([2.0 * length for length in image.GetSpacing()])
    scan.SetBackgroundLevel(image.GetScalarRange()[0])
    scan.Update()
    skin = 0.5 * (image.GetScalarRange()[0] + isovalue)
    sides.mapper.SetInputData(image)
    sides.mapper.AddInputConnection(0, scan.GetOutputPort())
    volume = sides.make_volume(SKIN, 0.35)
    volume.SetUserTransform(turn)
    volume.GetProperty().GetIsoSurfaceValues().SetValue(0, skin)
    sides.mapper.SetConnectionVolume(1, volume)
    sides.contours = [sides.add_triangles(image, isovalue, BONE)]
    sides.add_triangles(scan.GetOutput(), skin, SKIN, 0.35)
    sides.triangles.GetActors().GetLastActor().SetUserTransform(turn)
    sides.look_from((-0.5, 1.1, 0.35), (0.0, 0.0, 1.0), 1.4)


def mixed(sides, image, isovalue):
    """Three blocks, each in its colour: an image, a coarser one, and a mesh of tetrahedra."""
    whole = even(image, 4)
    first, last = whole[4:]
    borders = [first + (last - first) // 12 * 4 * i for i in range(3)] + [last]
    slabs = [whole[:4] + borders[i : i + 2] for i in range(3)]
    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputData(cut(image, slabs[0], 4))
    tetrahedra.Update()
    parts = (tetrahedra.GetOutput(), cut(image, slabs[1], 2), cut(image, slabs[2]))
    blocks = vtkMultiBlockDataSet()
    attributes = vtkCompositeDataDisplayAttributes()
    for i, (part, color) in enumerate(zip(parts, (COPPER, SKIN, BONE))):
        blocks.SetBlock(i, part)
        attributes.SetBlockColor(part, color)
        sides.contours.append(sides.add_triangles(part, isovalue, color))
    sides.mapper.SetInputDataObject(blocks)
    sides.mapper.SetCompositeDataDisplayAttributes(attributes)
    sides.look_from((-0.5, 1.1, 0.35), (0.0, 0.0, 1.0), 1.5)


SCENES = (refined, registered, mixed)


def simulation(sides, file_name, array, isovalue):
    """AMR of a simulation, with values of cells."""
    reader = vtkAMREnzoReader()
    reader.SetFileName(file_name)
    reader.SetMaxLevel(64)
    reader.SetCellArrayStatus(array, 1)
    reader.Update()
    sides.mapper.SetInputDataObject(reader.GetOutput())
    sides.mapper.SetScalarModeToUseCellFieldData()
    sides.mapper.SelectScalarArray(array)
    sides.contours = [sides.add_triangles(reader.GetOutput(), isovalue, BONE, 1.0, array)]
    sides.look_from((0.5, 0.45, 0.85), (0.0, 1.0, 0.0), 1.2)


def write(sides, isovalue, file_name):
    rays, triangles = (sides.measure(isovalue, side) for side in (sides.rays, sides.triangles))
    sides.write(file_name)
    print(f"{file_name}: rays {rays:.3g} ms, triangles {triangles:.3g} ms")


def write_all(image, isovalue, folder, size):
    os.makedirs(folder, exist_ok=True)
    for furnish in SCENES:
        sides = Sides(size)
        furnish(sides, image, isovalue)
        write(sides, isovalue, os.path.join(folder, furnish.__name__ + ".png"))


def main():
    if len(sys.argv) not in (4, 7):
        sys.exit(__doc__)
    if len(sys.argv) == 7 and not os.path.isfile(sys.argv[4]):
        sys.exit(f"there is no file {sys.argv[4]}")
    volume_file, isovalue, folder = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    write_all(read_volume(volume_file), isovalue, folder, 480)
    if len(sys.argv) == 7:
        sides = Sides(480)
        simulation(sides, sys.argv[4], sys.argv[5], float(sys.argv[6]))
        write(sides, float(sys.argv[6]), os.path.join(folder, "simulation.png"))


if __name__ == "__main__":
    main()
