#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""vtkIsosurfaceCompare as a user calls it: TestIsosurfaceCompare.py PATH_OF_VTKISOSURFACECOMPARE"""

import base64
import csv
import html.parser
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from vtkmodules.vtkCommonCore import VTK_SHORT, vtkBitArray, vtkFloatArray, vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet, vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkIOExodus import vtkExodusIIWriter
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter, vtkPNGReader
from vtkmodules.vtkIOLegacy import vtkStructuredGridWriter, vtkStructuredPointsWriter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLMultiBlockDataWriter,
    vtkXMLStructuredGridWriter,
    vtkXMLUnstructuredGridWriter,
)
from vtkIsosurfaceRayTracing import vtkIsosurfaceComparisonFilter

from DicomSlices import write_dicom_slices
from Displays import why_no_pictures, with_display, without_display
from LimitedMemory import LimitedMemory, write_zeros
from PictureTesting import add_array_of_cells

PROGRAM = sys.argv.pop(1)
SOURCE = Path(__file__).parents[2]
ALL_METHODS = [
    "vtkFlyingEdges3D",
    "vtkMarchingCubes",
    "vtkSynchronizedTemplates3D",
    "vtkContourFilter",
    "vtkSpanSpace",
    "vtkGPUVolumeRayCastMapper",
    "vtkIsosurfaceRayTraceMapper",
]
ESSENTIAL_METHODS = [*ALL_METHODS[:2], *ALL_METHODS[-2:]]


def new_ball(scalars=True):
    """Ten times the distance from the middle: isovalue 60 is a ball."""
    size = 20
    image = vtkImageData()
    image.SetDimensions(size, size, size)
    if scalars:
        image.AllocateScalars(VTK_SHORT, 1)
        for i in range(image.GetNumberOfPoints()):
            x, y, z = (c - 0.5 * (size - 1) for c in image.GetPoint(i))
            image.GetPointData().GetScalars().SetValue(i, round(10 * math.hypot(x, y, z)))
    return image


MESH_METHODS = ["vtkContourGrid", "vtkContour3DLinearGrid", "vtkIsosurfaceRayTraceMeshMapper"]


def new_grid(name="radius", scale=1):
    """A bent curvilinear grid with the distance from its middle, scaled: the isovalue 0.7, scaled, is
    a ball. Its cells have their height, its points their number, too."""
    size = 9
    points, distances, numbers, heights = (
        vtkPoints(), vtkFloatArray(), vtkFloatArray(), vtkFloatArray()
    )  # fmt: skip
    for i in range(size**3):
        x, y, z = (2 * c / (size - 1) - 1 for c in (i % size, i // size % size, i // size**2))
        point = (x + 0.1 * math.sin(3 * y + z), y + 0.1 * math.sin(3 * z + x), z)
        points.InsertNextPoint(point)
        distances.InsertNextValue(scale * math.hypot(*point))
        numbers.InsertNextValue(i)
    for i in range((size - 1) ** 3):
        heights.InsertNextValue(i // (size - 1) ** 2)
    grid = vtkStructuredGrid()
    grid.SetDimensions(size, size, size)
    grid.SetPoints(points)
    for array_name, array in ((name, distances), ("number", numbers)):
        array.SetName(array_name)
        grid.GetPointData().AddArray(array)
    heights.SetName("height")
    grid.GetCellData().AddArray(heights)
    return grid


def list_cells(grid):
    append = vtkAppendFilter()
    append.SetInputData(grid)
    append.Update()
    return append.GetOutput()


class Page(html.parser.HTMLParser):
    """What a page shows: texts of cells and paragraphs, pictures; and what it asks others for."""

    def __init__(self, path):
        super().__init__()
        self.texts, self.pictures, self.references, self.open_tags = [], [], [], []
        self.feed(path.read_text(encoding="utf-8"))
        self.close()

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag not in ("meta", "img", "br"):
            self.open_tags.append(tag)
        for name in ("src", "href"):
            reference = attributes.get(name)
            if reference and reference.startswith("data:image/png;base64,"):
                self.pictures.append(base64.b64decode(reference.split(",")[1], validate=True))
            elif reference:
                self.references.append(reference)

    def handle_endtag(self, tag):
        assert self.open_tags.pop() == tag, f"{tag} closes another tag"

    def handle_data(self, data):
        self.texts.append(data)


def read_png(data):
    """The width, the height and the number of different grey values or reds."""
    reader = vtkPNGReader()
    reader.SetMemoryBuffer(data)
    reader.SetMemoryBufferLength(len(data))
    reader.Update()
    image = reader.GetOutput()
    pixels = image.GetPointData().GetScalars()
    reds = {pixels.GetComponent(i, 0) for i in range(0, pixels.GetNumberOfTuples(), 7)}
    width, height, _ = image.GetDimensions()
    return width, height, len(reds)


class TestIsosurfaceCompare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.ball = cls.write(new_ball(), "ball.vti")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def write(cls, image, name):
        writer = vtkXMLImageDataWriter()
        writer.SetInputData(image)
        writer.SetFileName(str(cls.folder / name))
        writer.Write()
        return str(cls.folder / name)

    def run_program(self, *arguments, environment=None, folder=None):
        return subprocess.run(
            [PROGRAM, "--repeats", "1", *map(str, arguments)],
            capture_output=True,
            text=True,
            timeout=300,
            cwd=folder,
            env=environment,
            check=False,
        )

    def test_files(self):
        result = self.run_program(
            "--input", self.ball, "--isovalue", 60, 40, "--thorough",
            "--json", self.folder / "table.json", "--csv", self.folder / "table.csv",
        )  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        table = json.loads((self.folder / "table.json").read_text())
        self.assertEqual([row["Method"] for row in table["rows"]], 2 * ALL_METHODS)
        self.assertEqual([row["Isovalue"] for row in table["rows"]], 7 * [60.0] + 7 * [40.0])
        self.assertEqual(table["dimensions"], [20, 20, 20])
        self.assertGreater(table["rows"][0]["Triangles"], 1000)
        self.assertGreater(table["rows"][0]["MedianDistance"], 1e-4)
        for row in table["rows"][5:7]:
            self.assertIsNone(row["ExtractionTime"])
            self.assertEqual(row["Triangles"], 0)
        with open(self.folder / "table.csv", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual([row["Method"] for row in rows], 2 * ALL_METHODS)
        self.assertEqual(set(rows[0]), set(table["rows"][0]))
        self.assertEqual(int(rows[0]["Triangles"]), table["rows"][0]["Triangles"])
        self.assertIn("vtkSpanSpace", result.stdout)

    def test_equals_signs(self):
        """Options and values are also one argument; values may have signs of their own."""
        table = self.folder / "a=b.json"
        result = self.run_program(
            f"--input={self.ball}", "--isovalue=60", "--isovalue=40", "--methods=flying-edges", f"--json={table}", "--repeats=1"
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([row["Isovalue"] for row in json.loads(table.read_text())["rows"]], [60, 40])

    def test_essentials(self):
        """Without further options: four methods, no other sizes, and progress that ends at 100 %."""
        report, table = self.folder / "essentials", self.folder / "essentials.json"
        for options, methods in (((), ESSENTIAL_METHODS), (("--thorough",), ALL_METHODS)):
            result = self.run_program(
                "--input", self.ball, "--isovalue", 60, "--report", report, "--json", table, *options)
            self.assertEqual(result.returncode, 0, result.stderr)
            content = json.loads(table.read_text())
            self.assertEqual([row["Method"] for row in content["rows"]], methods)
            self.assertEqual(bool(content.get("crossovers")), bool(options))
            texts = " ".join(Page(report / "report.html").texts)
            self.assertEqual("vtkGPUVolumeRayCastMapper, drawn by" in texts, not why_no_pictures(os.environ))
            progress = [int(part) for part in re.findall(r"(\d+) %", result.stderr)]
            self.assertEqual(progress, sorted(progress))
            self.assertEqual(progress[-1], 100)
            self.assertLess(progress[len(progress) // 2], 100)

    def test_report(self):
        result = self.run_program(
            "--input", self.ball, "--isovalue", 60, "--methods", "flying-edges", "ray-tracing", "--thorough",
            "--report", self.folder / "new" / "folder", "--json", self.folder / "report.json",
        )  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        page = Page(self.folder / "new" / "folder" / "report.html")
        self.assertEqual(page.references, [])  # it needs no other file
        self.assertEqual(page.open_tags, [])
        self.assertIn("vtkFlyingEdges3D", page.texts)
        self.assertNotIn("vtkMarchingCubes", page.texts)
        self.assertTrue(any("from a new isovalue to the first complete frame" in text for text in page.texts))
        crossovers = json.loads((self.folder / "report.json").read_text())["crossovers"]
        self.assertIn([20, 20, 20], [crossover["dimensions"] for crossover in crossovers])
        for crossover in crossovers:
            self.assertIn(crossover["verdict"], page.texts)
        # The pictures of two surfaces and their middle, the difference and the error; the charts of
        # totals, costs, the crossover and the distances.
        sizes = [read_png(picture) for picture in page.pictures]
        for width, height, colors in sizes:
            self.assertGreater(colors, 2, "an empty picture")
        squares = [size for size in sizes if size[:2] == (512, 512)]
        charts = [size for size in sizes if size[:2] == (900, 520)]
        self.assertEqual(len(squares), 6)
        self.assertEqual(len(charts), 4)
        self.assertEqual(len(squares) + len(charts), len(sizes))
        self.check_document(
            self.folder / "report.json", self.folder / "new" / "folder" / "report.html"
        )

    def check_document(self, table, report):
        """The measured part of Documentation/comparison.md can be made of these files."""
        copy = self.folder / "Documentation"
        (copy / "images").mkdir(parents=True)
        shutil.copy(SOURCE / "Documentation" / "comparison.md", copy)
        program = SOURCE / "Utilities" / "document_comparison.py"
        command = [sys.executable, program, "--documentation", copy, table, report]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        page = (copy / "comparison.md").read_text(encoding="utf-8")
        self.assertIn("repeats: 1.", page)
        for method in ("vtkFlyingEdges3D", "vtkIsosurfaceRayTraceMapper"):
            self.assertRegex(page, rf"\| {method} \| [0-9.e+-]+ \|")
        for name in ("times", "crossover"):
            png = (copy / "images" / f"comparison-{name}.png").read_bytes()
            self.assertGreater(read_png(png)[2], 5)

    def check_document_of_meshes(self, table):
        copy = self.folder / "DocumentationOfMeshes"
        copy.mkdir()
        shutil.copy(SOURCE / "Documentation" / "comparison.md", copy)
        program = SOURCE / "Utilities" / "document_mesh_comparison.py"
        command = [sys.executable, program, "--documentation", copy, table]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        page = (copy / "comparison.md").read_text(encoding="utf-8")
        for method in MESH_METHODS:
            self.assertRegex(page, rf"\| grid.ex2, 0.7 \| 512 \| {method} \| [0-9–]")

    def test_documented_commands(self):
        """Those of Documentation/comparison.md for meshes, with other data of the same names."""
        page = (SOURCE / "Documentation" / "comparison.md").read_text(encoding="utf-8")
        commands = re.findall(r"    xvfb-run -a vtkIsosurfaceCompare (--input data/.*\n.*--json.*)", page)
        commands = [c.replace("\\\n", " ").split() for c in commands if "cranium" not in c]
        self.assertEqual(len(commands), 3)
        (self.folder / "data").mkdir()
        writers = {
            ".ex2": vtkExodusIIWriter, ".vtk": vtkStructuredGridWriter, ".vtu": vtkXMLUnstructuredGridWriter
        }  # fmt: skip
        for command in commands:
            options = dict(zip(command[::2], command[1::2]))
            data = new_grid(options.get("--array", "radius"), float(options["--isovalue"]) / 0.7)
            path = Path(options["--input"])
            data = data if path.suffix == ".vtk" else list_cells(data)
            self.write_mesh(writers[path.suffix](), path, data)
            result = self.run_program(
                *command, "--repeats", "1", "--methods", "contour-3d-linear-grid", folder=self.folder
            )
            self.assertEqual(result.returncode, 0, result.stderr)
            rows = json.loads((self.folder / options["--json"]).read_text())["rows"]
            self.assertGreater(rows[0]["Triangles"], 200)

    def check_pictures(self, environment):
        result = self.run_program(
            "--input", self.ball, "--isovalue", 60, "--methods", "flying-edges",
            "--report", self.folder, environment=environment,
        )  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        page = Page(self.folder / "report.html")
        why = why_no_pictures(environment)
        self.assertIn(why, result.stdout)
        self.assertIn(why, "".join(page.texts))
        if why:
            self.assertEqual(len(page.pictures), 1)  # the difference, which needs no OpenGL
            self.assertEqual(read_png(page.pictures[0])[:2], (512, 512))
        else:
            self.assertNotIn("No pictures", result.stdout)
            self.assertGreater(len(page.pictures), 1)

    def test_displays(self):
        for environment in (dict(os.environ), without_display(), with_display(":9999")):
            with self.subTest(environment.get("DISPLAY")):
                self.check_pictures(environment)

    def test_no_surface(self):
        result = self.run_program(
            "--input", self.ball, "--isovalue", 5000, "--thorough", "--report", self.folder / "nothing"
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        page = Page(self.folder / "nothing" / "report.html")
        self.assertTrue(any("No surface" in text for text in page.texts))

    def test_scalars_that_cannot_be_contoured(self):
        """Nothing is measured, and no report says that nothing was."""
        none, vectors = new_ball(scalars=False), new_ball(scalars=False)
        array = vtkFloatArray()
        array.SetNumberOfComponents(2)
        array.SetNumberOfTuples(vectors.GetNumberOfPoints())
        array.Fill(1.0)
        vectors.GetPointData().SetScalars(array)
        for image, reason in ((none, "there is no array of points or cells"), (vectors, "The .*have several components")):
            result = self.run_program(
                "--input", self.write(image, "bad.vti"), "--isovalue", 1, "--thorough",
                "--report", self.folder / "none", "--json", self.folder / "none.json",
            )  # fmt: skip
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, f"error: .*bad.vti: .*{reason}")
            self.assertFalse((self.folder / "none.json").exists())
            self.assertFalse((self.folder / "none" / "report.html").exists())

    def test_formats(self):
        for writer, name in ((vtkMetaImageWriter(), "ball.mha"), (vtkNIFTIImageWriter(), "ball.nii")):
            writer.SetInputData(new_ball())
            writer.SetFileName(str(self.folder / name))
            writer.Write()
        slices = self.folder / "slices"
        slices.mkdir()
        write_dicom_slices(new_ball(), slices)
        if hasattr(os, "mkfifo"):
            os.mkfifo(slices / "000.pipe")  # for which VTK's reader would wait
        counts = []
        for name in ("ball.vti", "ball.mha", "ball.nii", "slices"):
            result = self.run_program(
                "--input", self.folder / name, "--isovalue", 60, "--methods", "marching-cubes",
                "--json", self.folder / "format.json",
            )  # fmt: skip
            self.assertEqual(result.returncode, 0, result.stderr)
            table = json.loads((self.folder / "format.json").read_text())
            counts.append(table["rows"][0]["Triangles"])
        self.assertGreater(counts[0], 1000)
        self.assertEqual(counts, [counts[0]] * 4)

        whole = (self.folder / "ball.nii").read_bytes()
        (self.folder / "half.nii").write_bytes(whole[: len(whole) // 2])
        result = self.run_program("--input", self.folder / "half.nii", "--isovalue", 60)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("half.nii cannot be read", result.stderr)

    def write_mesh(self, writer, name, data):
        path = self.folder / name
        writer.SetInputData(data)
        writer.SetFileName(str(path))
        writer.Write()
        return path

    def test_meshes(self):
        """Every kind of file has the same triangles, and hits."""
        grid, listed = new_grid(), list_cells(new_grid())
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, listed)
        rows = {}
        for writer, name, data in (
            (vtkXMLStructuredGridWriter(), "grid.vts", grid),
            (vtkStructuredGridWriter(), "grid.vtk", grid),
            (vtkXMLUnstructuredGridWriter(), "grid.vtu", listed),
            (vtkXMLMultiBlockDataWriter(), "grid.vtm", blocks),
            (vtkExodusIIWriter(), "grid.ex2", listed),
        ):
            path = self.write_mesh(writer, name, data)
            result = self.run_program(
                "--input", path, "--array", "radius", "--isovalue", 0.7,
                "--json", self.folder / "mesh.json",
            )  # fmt: skip
            self.assertEqual(result.returncode, 0, result.stderr)
            table = json.loads((self.folder / "mesh.json").read_text())
            self.assertEqual([row["Method"] for row in table["rows"]], MESH_METHODS)
            self.assertEqual((table["points"], table["cells"]), (729, 512))
            rows[name] = table["rows"]
        self.check_document_of_meshes(self.folder / "mesh.json")
        for name, (contours, linear, rays) in rows.items():
            self.assertGreater(contours["Triangles"], 200, name)
            self.assertGreater(contours["MedianDistance"], 1e-3, name)
            self.assertLess(contours["MaximumDistance"], 0.1, name)
            self.assertEqual(contours["Triangles"], rows["grid.vts"][0]["Triangles"], name)
            self.assertEqual(linear["Triangles"], contours["Triangles"], name)
            self.assertLess(rays["MaximumDistance"], 1e-12, name)
            self.assertEqual(rays["CoveredPixels"], rows["grid.vts"][2]["CoveredPixels"], name)

    def test_arrays_of_meshes(self):
        """Those of cells are averaged; without a name it is the first of the points, but for the marks of ghosts."""
        grid, marked = new_grid(), vtkStructuredGrid()
        marked.CopyStructure(grid)
        marked.AllocatePointGhostArray()
        for of_marked, of_grid in ((marked.GetPointData(), grid.GetPointData()), (marked.GetCellData(), grid.GetCellData())):
            for i in range(of_grid.GetNumberOfArrays()):
                of_marked.AddArray(of_grid.GetArray(i))
        path = self.write_mesh(vtkXMLStructuredGridWriter(), "arrays.vts", marked)
        for array, isovalue in ((["--array", "height"], 3.25), ([], 0.6)):
            result = self.run_program(
                "--input", path, *array, "--isovalue", isovalue, "--methods", "contour-grid",
                "--json", self.folder / "a.json",
            )  # fmt: skip
            self.assertEqual(result.returncode, 0, result.stderr)
            rows = json.loads((self.folder / "a.json").read_text())["rows"]
            self.assertGreater(rows[0]["Triangles"], 100)
            self.assertEqual(rows[0]["Note"], "")

    def test_ids_and_bits_of_cells(self):
        """VTK 9.1 does not average them."""
        grid, triangles = new_grid(), []
        for kind in (vtkIdTypeArray, vtkBitArray, vtkFloatArray):
            array = kind()
            array.SetName(kind.__name__)
            for i in range(grid.GetNumberOfCells()):
                array.InsertNextTuple1(1 if i % 7 < 3 else 0)
            grid.GetCellData().AddArray(array)
        path = self.write_mesh(vtkXMLStructuredGridWriter(), "ids.vts", grid)
        for kind in (vtkIdTypeArray, vtkBitArray, vtkFloatArray):
            result = self.run_program(
                "--input", path, "--array", kind.__name__, "--isovalue", 0.4, "--methods", "contour-grid",
                "--json", self.folder / "i.json",
            )  # fmt: skip
            self.assertEqual(result.returncode, 0, result.stderr)
            triangles.append(json.loads((self.folder / "i.json").read_text())["rows"][0]["Triangles"])
        self.assertGreater(triangles[0], 100)
        self.assertEqual(triangles, 3 * triangles[:1])

    def test_arrays_of_images(self):
        """Also of those in .vtk files, which may hold meshes, too."""
        image = new_ball()
        far = vtkFloatArray()
        far.SetName("twice")
        for i in range(image.GetNumberOfPoints()):
            far.InsertNextValue(2 * image.GetPointData().GetScalars().GetValue(i))
        image.GetPointData().AddArray(far)
        add_array_of_cells(image, "twice")
        triangles = {}
        for writer, name in ((vtkXMLImageDataWriter(), "arrays.vti"), (vtkStructuredPointsWriter(), "arrays.vtk")):
            path = self.write_mesh(writer, name, image)
            for array, isovalue in (((), 60), (("--array", "twice"), 120), (("--array", "of cells"), 80)):
                result = self.run_program(
                    "--input", path, *array, "--isovalue", isovalue, "--methods", "flying-edges",
                    "--json", self.folder / "a.json",
                )  # fmt: skip
                self.assertEqual(result.returncode, 0, result.stderr)
                row = json.loads((self.folder / "a.json").read_text())["rows"][0]
                triangles[name, array] = row["Triangles"]
                self.assertGreater(row["Triangles"], 200)
        (first, twice, averaged), of_legacy = [list(triangles.values())[i : i + 3] for i in (0, 3)]
        self.assertEqual(first, twice)
        self.assertLess(averaged, first / 2)
        self.assertEqual(of_legacy, [first, twice, averaged])

    def test_report_on_a_mesh(self):
        path = self.write_mesh(vtkXMLUnstructuredGridWriter(), "report.vtu", list_cells(new_grid()))
        result = self.run_program(
            "--input", path, "--array", "radius", "--isovalue", 0.7,
            "--report", self.folder / "mesh",
        )  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        page = Page(self.folder / "mesh" / "report.html")
        text = "".join(page.texts)
        self.assertIn("512 cells, 729 points", text)
        self.assertIn("from a new isovalue to the first complete frame", text)
        self.assertNotIn("ambiguous cells they", text)
        sizes = [read_png(picture) for picture in page.pictures]
        self.assertEqual(len([size for size in sizes if size[:2] == (512, 512)]), 6)
        self.assertEqual(len(sizes), 8)  # and the charts of totals and of the distances
        for size in sizes:
            self.assertGreater(size[2], 2, "an empty picture")

    def test_errors_of_meshes(self):
        whole = self.write_mesh(vtkXMLStructuredGridWriter(), "whole.vts", new_grid())
        half = self.folder / "half.vts"
        half.write_bytes(whole.read_bytes()[:3000])
        image = self.folder / "image.vtk"
        image.write_text("# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_POINTS\n"
                         "DIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\n", encoding="utf-8")  # fmt: skip
        lines = self.folder / "lines.vtk"
        lines.write_text("# vtk DataFile Version 3.0\n\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 2 2\n"
                         + "".join(f"{axis}_COORDINATES 2 float\n0 1\n" for axis in "XYZ"), encoding="utf-8")  # fmt: skip
        for arguments, words in (
            (("--input", self.folder / "absent.vtu", "--isovalue", 1), "there is no file"),
            (("--input", half, "--isovalue", 1), "half.vts cannot be read"),
            (("--input", lines, "--isovalue", 1), "no image, no unstructured and no structured grid"),
            (("--input", image, "--isovalue", 1), "image.vtk: there is no array of points or cells"),
            (("--input", whole, "--array", "x", "--isovalue", 1), 'whole.vts: there is no array "x"'),
            (("--input", whole, "--array", "x", "--isovalue", 1), "(for --array): radius number height"),
            (("--input", whole, "--isovalue", 1, "--max-memory", "1e-3"), "--max-memory"),
            (("--input", self.ball, "--array", "x", "--isovalue", 1), 'there is no array "x"'),
            (("--input", whole, "--isovalue", 1, "--methods", "ray-tracing", "flying-edges"),
             "flying-edges is not for meshes, and"),  # fmt: skip
        ):
            result = self.run_program(*arguments)
            self.assertNotEqual(result.returncode, 0, arguments)
            self.assertIn(words, result.stderr)

    def test_memory_of_a_container(self):
        """A volume that takes more is an error; the system would end the process."""
        header = write_zeros(self.folder)
        with LimitedMemory(150 << 20) as limited:
            if not limited.is_possible:
                self.skipTest("no process can be limited")
            command = [*limited.prefix, PROGRAM, "--input", str(header), "--isovalue", "1", "--methods", "flying-edges"]
            result = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("--max-memory", result.stderr)

    def test_errors(self):
        text = self.folder / "text.txt"
        text.write_text("This is not a volume.\n", encoding="utf-8")
        for arguments, words in (
            (("--input", self.folder / "absent.vti", "--isovalue", 1), "there is no file"),
            (("--input", text, "--isovalue", 1), "no image reader"),
            (("--input", self.ball), "--isovalue are needed"),
            (("--isovalue", 60, "--input"), "lacks its value"),
            (("--input", self.ball, "--isovalue", "bone"), "bone is not a number"),
            (("--input", self.ball, "--isovalue="), "is not a number"),
            (("--input", self.ball, "--isovalue", "1e400"), "1e400 is beyond the largest number"),
            (("--inptu", self.ball, "--isovalue", 60), "unknown option --inptu"),
            ((f"--inptu={self.ball}", "--isovalue", 60), "unknown option --inptu"),
            (("--input", self.ball, "--isovalue", 60, "--repeats", 0), "from 1 to 1000"),
            (("--input", self.ball, "--isovalue", 1, "--methods", "magic"), "no method magic"),
            (("--input", self.ball, "--isovalue", 1, "--methods", "contour-grid"), "contour-grid is not for images"),
            (
                ("--input", self.ball, "--isovalue", 60, "--methods", "flying-edges",
                 "--csv", self.folder / "no" / "folder.csv"),
                "cannot be written",
            ),
        ):  # fmt: skip
            result = self.run_program(*arguments)
            self.assertNotEqual(result.returncode, 0, arguments)
            self.assertIn(words, result.stderr)
        help_text = self.run_program("--help")
        self.assertEqual(help_text.returncode, 0)
        self.assertIn("--isovalue VALUE", help_text.stdout)

    def test_class(self):
        comparison = vtkIsosurfaceComparisonFilter()
        comparison.SetInputData(new_ball())
        comparison.SetValue(0, 60.0)
        comparison.SetImageSize(32, 24)
        comparison.PicturesOff()
        comparison.Update()
        difference = comparison.GetOutputDataObject(2)
        self.assertEqual(difference.GetDimensions(), (32, 24, 1))
        self.assertIsNotNone(difference.GetPointData().GetArray("Coverage"))
        mesh = comparison.GetOutputDataObject(1)
        self.assertEqual(mesh.GetPointData().GetScalars().GetName(), "DistanceInCells")
        self.assertEqual(vtkIsosurfaceComparisonFilter.WhyNoPictures(), "")


if __name__ == "__main__":
    unittest.main()
