#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of real simulations, those of Debian's package mayavi2, beside VTK's extracted polygons; and
the pictures of Examples/Python/meshes.py, of which those that were made are left in ./meshes."""

import math
import os
import statistics
import subprocess
import sys
import tempfile
import unittest

from vtkmodules.vtkCommonCore import mutable
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkGenericCell, vtkImageData
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkContourGrid, vtkImplicitPolyDataDistance
from vtkmodules.vtkIOExodus import vtkExodusIIReader
from vtkmodules.vtkIOLegacy import vtkStructuredGridReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkWindowToImageFilter,
)
import vtkmodules.vtkRenderingOpenGL2  # the window
from vtkIsosurfaceRayTracing import vtkIsosurfacePicker, vtkIsosurfaceRayTraceMeshMapper

from PictureTesting import EXAMPLES, SIZE, PictureTestCase, read
import mayavi_meshes
import meshes

DATA = "mayavi2"
# Readers, scalars and isovalues.
MESHES = {
    "disk_out_ref.ex2": (vtkExodusIIReader, "Temp", (350.0, 500.0, 800.0)),
    "fire_ug.vtu": (vtkXMLUnstructuredGridReader, "t", (330.0, 450.0)),
    "SampleStructGrid.vtk": (vtkStructuredGridReader, "scalars", (0.4, 0.9)),
}


def setUpModule():
    if all(os.path.isfile(os.path.join(DATA, name)) for name in MESHES):
        return
    try:
        mayavi_meshes.fetch(DATA)
    except mayavi_meshes.PackageError as error:
        print(f"Skipped: the meshes of the package mayavi2 cannot be had: {error}", file=sys.stderr)
        raise unittest.SkipTest(str(error)) from error


def get_leaf(mesh):
    """The mesh itself, or the first block that has points."""
    if not isinstance(mesh, vtkCompositeDataSet):
        return mesh
    iterator = mesh.NewIterator()
    iterator.InitTraversal()
    return iterator.GetCurrentDataObject()


class View:
    """A mesh from a corner, in parallel projection, so that depth is a distance."""

    def __init__(self, name, isovalue):
        reader, self.scalars, _ = MESHES[name]
        self.mesh = meshes.read(reader(), DATA, name)
        self.isovalue = isovalue
        self.renderer = vtkRenderer()
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(SIZE, SIZE)
        self.window.AddRenderer(self.renderer)
        self.mapper = vtkIsosurfaceRayTraceMeshMapper()
        self.mapper.SetInputDataObject(self.mesh)
        self.mapper.SetScalarModeToUsePointFieldData()
        self.mapper.SelectScalarArray(self.scalars)
        self.volume = vtkVolume()
        self.volume.SetMapper(self.mapper)
        surface = self.volume.GetProperty()
        surface.ShadeOn()
        surface.GetIsoSurfaceValues().SetValue(0, isovalue)
        surface.GetScalarOpacity().AddPoint(isovalue, 1.0)
        self.renderer.AddVolume(self.volume)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.ParallelProjectionOn()
        self.camera.SetPosition(0.6, -0.7, 0.5)
        self.camera.SetViewUp(0.0, 0.0, 1.0)
        self.renderer.ResetCamera()
        self.camera.Zoom(1.4)
        self.near, self.far = self.camera.GetClippingRange()
        self.polygons = vtkImplicitPolyDataDistance()

    def trace(self):
        image = vtkImageData()
        assert self.mapper.RenderToImage(self.volume, self.camera, None, SIZE, SIZE, image)
        return image.GetPointData()

    def to_distances(self, depths):
        """From the camera; infinite where there is nothing."""
        return [self.near + depth * (self.far - self.near) if depth < 1.0 else math.inf for depth in depths]

    def draw_polygons(self):
        """The distances of the polygons that VTK extracts."""
        leaf = get_leaf(self.mesh)
        leaf.GetPointData().SetActiveScalars(self.scalars)
        contour = vtkContourFilter() if leaf.IsA("vtkStructuredGrid") else vtkContourGrid()
        contour.SetInputData(leaf)
        contour.SetValue(0, self.isovalue)
        contour.Update()
        self.polygons.SetInput(contour.GetOutput())
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(contour.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        self.renderer.RemoveVolume(self.volume)
        self.renderer.AddActor(actor)
        self.window.Render()
        depths = vtkWindowToImageFilter()
        depths.SetInput(self.window)
        depths.SetInputBufferTypeToZBuffer()
        depths.ReadFrontBufferOff()
        depths.Update()
        values = depths.GetOutput().GetPointData().GetScalars()
        return self.to_distances([values.GetTuple1(i) for i in range(SIZE * SIZE)])

    def get_gap(self, point):
        """The distance of a point from the polygons that were drawn."""
        return abs(self.polygons.EvaluateFunction(point))


def neighbours(pixel, reach):
    x, y = pixel % SIZE, pixel // SIZE
    return [column + SIZE * row for row in range(max(y - reach, 0), min(y + reach + 1, SIZE))
            for column in range(max(x - reach, 0), min(x + reach + 1, SIZE))]  # fmt: skip


class TestMeshData(PictureTestCase):
    def test_surfaces_are_where_the_polygons_are(self):
        """They differ where a triangle cuts a curved surface short: by parts of a cell in depth, and at
        the silhouettes, where a ray meets only one of the two."""
        for name, (_, _, isovalues) in MESHES.items():
            for isovalue in isovalues:
                with self.subTest(name, isovalue=isovalue):
                    view = View(name, isovalue)
                    cell = max(self.get_cell_sizes(view))
                    picture = view.trace()
                    depths, positions = picture.GetArray("Depth"), picture.GetArray("Position")
                    traced = view.to_distances([depths.GetTuple1(i) for i in range(SIZE * SIZE)])
                    drawn = view.draw_polygons()
                    covered = sum(distance < math.inf for distance in drawn)
                    self.assertGreater(covered, 1000)
                    differences, only_one = [], 0
                    for pixel, (ours, theirs) in enumerate(zip(traced, drawn)):
                        if (ours < math.inf) and (theirs < math.inf) and abs(ours - theirs) < cell:
                            differences.append(abs(ours - theirs))
                        elif ours != theirs:
                            only_one += 1
                            # There is a triangle, too small for the pixel; or a silhouette beside it.
                            is_small = ours < math.inf and view.get_gap(positions.GetTuple3(pixel)) < 0.1 * cell
                            around = [drawn[other] for other in neighbours(pixel, 2)]
                            self.assertTrue(is_small or max(around) > min(around) + cell)
                    self.assertLess(only_one, 0.02 * covered)
                    self.assertLess(statistics.median(differences), 0.02 * cell)

    @staticmethod
    def get_cell_sizes(view):
        leaf = get_leaf(view.mesh)
        shown = view.trace().GetArray("CellId")
        ids = {int(shown.GetTuple1(i)) for i in range(SIZE * SIZE)} - {-1}
        return [math.sqrt(leaf.GetCell(i).GetLength2()) for i in ids]

    def test_picks_have_the_isovalue(self):
        """By VTK's own functions of the cell."""
        cell = vtkGenericCell()
        for name, (_, scalars, isovalues) in MESHES.items():
            with self.subTest(name):
                view = View(name, isovalues[1])
                leaf = get_leaf(view.mesh)
                values = leaf.GetPointData().GetArray(scalars)
                low, high = values.GetRange()
                picker = vtkIsosurfacePicker()
                picked = 0
                for pixel in range(0, SIZE * SIZE, 97):
                    if not picker.Pick(pixel % SIZE, pixel // SIZE, 0.0, view.renderer):
                        continue
                    picked += 1
                    self.assertEqual(picker.GetDataSet(), leaf)
                    self.assertEqual(picker.GetIsovalue(), isovalues[1])
                    leaf.GetCell(picker.GetCellId(), cell)
                    sub_id, point, weights = mutable(0), [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
                    cell.EvaluateLocation(sub_id, picker.GetPCoords(), point, weights)
                    self.assertLess(math.dist(point, picker.GetPickPosition()), 1e-12 * leaf.GetLength())
                    value = sum(weight * values.GetTuple1(cell.GetPointId(i)) for i, weight in enumerate(weights))
                    self.assertAlmostEqual(value, isovalues[1], delta=1e-11 * (high - low))
                self.assertGreater(picked, 20)

    def test_baselines(self):
        meshes.write_all(DATA, "meshes", SIZE)
        pictures = {scene.__name__: read(os.path.join("meshes", scene.__name__ + ".png")) for scene in meshes.SCENES}
        self.check_baselines(pictures, "meshes")
        self.check_none_is_like_another(pictures)

    def test_scripts(self):
        with tempfile.TemporaryDirectory() as folder:
            script = os.path.join(EXAMPLES, "meshes.py")
            subprocess.run([sys.executable, script, DATA, folder], check=True, stdout=subprocess.DEVNULL)
            for scene in meshes.SCENES:
                self.assertEqual(len(read(os.path.join(folder, scene.__name__ + ".png"))), 960 * 960)
            for arguments, message in (((), "meshes.py DATA FOLDER"), ((folder, folder), "there is no file")):
                result = subprocess.run([sys.executable, script, *arguments], capture_output=True, check=False)
                self.assertNotEqual(result.returncode, 0)
                self.assertIn(message.encode(), result.stderr)
            with open(os.path.join(folder, "disk_out_ref.ex2"), "wb") as stream:
                stream.write(b"no mesh")
            result = subprocess.run([sys.executable, script, folder, folder], capture_output=True, check=False)
            self.assertEqual(result.returncode, 1)
            self.assertIn(b"disk_out_ref.ex2 is damaged, or not a mesh", result.stderr)


if __name__ == "__main__":
    unittest.main()
