#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""vtkIsosurfaceViewer as a user works with it, by the keys and the mouse of an X server (xdotool, xwd):
TestIsosurfaceViewer.py PATH_OF_VTKISOSURFACEVIEWER"""

import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkMultiBlockDataSet, vtkOverlappingAMR, vtkRectilinearGrid
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter
from vtkmodules.vtkIOLegacy import vtkDataSetWriter
from vtkmodules.vtkIOParallelXML import vtkXMLPImageDataWriter, vtkXMLPUnstructuredGridWriter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLMultiBlockDataWriter,
    vtkXMLRectilinearGridWriter,
    vtkXMLStructuredGridWriter,
    vtkXMLUniformGridAMRWriter,
    vtkXMLUnstructuredGridWriter,
)
from vtkmodules.vtkImagingCore import vtkImageAppendComponents, vtkImageShiftScale

from DicomSlices import write_dicom_slices
from Displays import with_display, without_display
from MeshTesting import ball, make_grid, make_structured_grid
from PictureTesting import make_waves, write_bad_volumes, write_waves
from TestAmr import NESTED, fill
from ViewerSession import PATIENCE, Viewer, differ, xdotool

PROGRAM = sys.argv.pop(1)
SIZE = (400, 320)  # so that pictures are ready soon
SOURCE = Path(__file__).parents[2]
KEYS = ["x", "c", "s", "o", "i", "a"]


class TestIsosurfaceViewer(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def start(self, *arguments):
        viewer = Viewer(PROGRAM, self.folder, *arguments, size=SIZE)
        self.addCleanup(viewer.process.kill)
        return viewer

    def run_program(self, *arguments, **options):
        return subprocess.run(
            [PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, timeout=PATIENCE, **options)

    def write(self, writer, name, data):
        writer.SetInputData(data)
        writer.SetFileName(str(self.folder / name))
        writer.Write()
        return self.folder / name

    def test_keys(self):
        """Each changes the picture, and pressed again, takes it back."""
        viewer = self.start(write_waves(self.folder))
        plain = viewer.take_picture()
        for key in KEYS:
            with self.subTest(key):
                viewer.press(key)
                changed = viewer.take_picture()
                self.assertGreater(differ(changed, plain), 0.02)
                viewer.press(*([key] if key != "c" else 7 * [key]))  # back, or through all colours
                self.assertLess(differ(viewer.take_picture(), plain), 0.001)
        viewer.press("x")
        capped = viewer.take_picture()
        viewer.press("k")
        self.assertGreater(differ(viewer.take_picture(), capped), 0.02)
        self.assertEqual(viewer.quit(), "")  # Nothing moved.

    def test_isovalues(self):
        viewer = self.start(write_waves(self.folder))
        pictures = {}
        for isovalue in ("100", "200", "1.5e2"):
            viewer.type(isovalue)
            pictures[isovalue] = viewer.take_picture()
        self.assertGreater(differ(pictures["100"], pictures["200"]), 0.05)
        viewer.press("1", "BackSpace", "9", "9", "Escape")
        self.assertEqual(differ(viewer.take_picture(), pictures["1.5e2"]), 0.0)
        viewer.press("Up")
        self.assertGreater(differ(viewer.take_picture(), pictures["1.5e2"]), 0.005)
        viewer.press("Down")
        self.assertLess(differ(viewer.take_picture(), pictures["1.5e2"]), 0.001)
        viewer.type("-1e9")  # the least value there is
        self.assertGreater(differ(viewer.take_picture(), pictures["100"]), 0.05)
        viewer.type("200")
        viewer.press("a")
        viewer.type("100")  # of the second surface
        both = viewer.take_picture()
        viewer.press("Tab")
        viewer.type("180")  # of the first one
        self.assertGreater(differ(viewer.take_picture(), both), 0.01)
        viewer.press("1")
        viewer.type("-")
        self.assertEqual(viewer.quit(), "")

    def test_isovalues_as_arguments(self):
        """They make the pictures that typing them makes."""
        viewer = self.start(write_waves(self.folder), "--isovalue", 200)
        one = viewer.take_picture()
        viewer.press("a")
        viewer.type("100")
        viewer.press("r")  # as it begins
        two = viewer.take_picture()
        viewer.quit()
        viewer = self.start(write_waves(self.folder), "--isovalue", 100, 200)
        viewer.pictures = 2
        self.assertLess(differ(viewer.take_picture(), two), 0.001)
        viewer.press("a", "r")
        self.assertLess(differ(viewer.take_picture(), one), 0.001)
        viewer.quit()

    def test_sliders(self):
        viewer = self.start(write_waves(self.folder))
        plain = viewer.take_picture()
        viewer.wait_for_rest()
        height = viewer.capture().shape[0]
        row = round(height * (1.0 - 0.116))  # of the sliders of the first surface
        for column in (160, 344):  # of the isovalue, and of the opacity
            xdotool("mousemove", column, row, "mousedown", 1, "mousemove", column + 8, row, "mouseup", 1)
            changed = viewer.take_picture()
            self.assertGreater(differ(changed, plain), 0.02, column)
            plain = changed
        self.assertIn("frames while moving", viewer.quit())

    def test_resizing(self):
        """The sliders fill the new window, also where its size changes while a frame is drawn."""
        viewer = self.start(write_waves(self.folder))
        for i in range(4):
            viewer.wait_for_rest()
            viewer.press("s")
            for size in ((700 + 10 * i, 600), SIZE):
                xdotool("windowsize", viewer.window, *size)
            picture = viewer.wait_for_rest()
            bar = picture[round(SIZE[1] * (1.0 - 0.116)), round(0.05 * SIZE[0]) : round(0.3 * SIZE[0])]
            self.assertEqual(picture.shape[:2], SIZE[::-1])
            self.assertGreater(bar.min(), 200, i)
        viewer.quit()

    def test_dragging(self):
        """The surface turns; it is refined while the button is held, and after that as it was."""
        viewer = self.start("--isovalue=130", write_waves(self.folder))
        before = viewer.wait_for_rest()
        xdotool("mousemove", *viewer.middle, "mousedown", 1)
        for step in range(1, 21):
            xdotool("mousemove", viewer.middle[0] + 3 * step, viewer.middle[1])
        viewer.wait_until(lambda picture: differ(picture, before) > 0.05, "another side of the surface")
        held = viewer.wait_for_rest()
        xdotool("mouseup", 1)
        self.assertLess(differ(viewer.wait_for_rest()[100:], held[100:]), 0.001)  # below the texts
        (frames,) = re.findall(r"^(\d+) frames while moving: median [\d.]+ ms", viewer.quit(), re.M)
        self.assertGreaterEqual(int(frames), 3)

    def test_picking(self):
        """A red sphere marks the point, and its position and value are shown."""
        viewer = self.start(write_waves(self.folder))
        plain = viewer.wait_for_rest()
        xdotool("mousemove", *viewer.middle, "click", 1)
        at = (slice(viewer.middle[1] - 1, viewer.middle[1] + 1), slice(viewer.middle[0] - 1, viewer.middle[0] + 1))

        def is_marked(picture):
            red, green, blue = picture[at].reshape(-1, 3).mean(axis=0)
            return red > 2.0 * max(green, blue)

        self.assertFalse(is_marked(plain))
        viewer.wait_until(is_marked, "a marker")
        text = (slice(28, 50), slice(0, 300))
        self.assertGreater(differ(viewer.wait_for_rest()[text], plain[text]), 0.05)
        xdotool("mousemove", 10, 100)
        viewer.press("p")  # at nothing
        viewer.wait_until(lambda picture: not is_marked(picture), "a picture without a marker")
        viewer.quit()

    def test_picking_on_caps(self):
        """The value is the same in whichever order the blocks are, and whichever way the axes of images point."""
        left, right, turned = make_waves(), make_waves(), make_waves()
        right.SetOrigin(60.5, 0.0, 0.0)  # on another lattice
        samples = vtk_to_numpy(left.GetPointData().GetScalars()).reshape(41, 41, 41)
        vtk_to_numpy(turned.GetPointData().GetScalars())[:] = samples[::-1].transpose(0, 2, 1).ravel()
        turned.SetExtent(0, 40, 0, 40, 0, 40)
        turned.SetOrigin(-20.0, -20.0, 20.0)
        turned.SetDirectionMatrix(0, 1, 0, 1, 0, 0, 0, 0, -1)
        files = {name: self.write(vtkXMLImageDataWriter(), f"{name}.vti", image)
                 for name, image in (("left", left), ("right", right), ("turned", turned))}
        for names, others, places in ((["left", "right"], ["right", "left"], (0.25, 0.7)), (["left"], ["turned"], (0.45,))):
            texts = []
            for blocks in (names, others):
                viewer = self.start(*(files[name] for name in blocks))
                viewer.press("x")
                texts.append([])
                for place in places:
                    xdotool("mousemove", round(place * SIZE[0]), viewer.middle[1])
                    viewer.press("p")
                    texts[-1].append(viewer.wait_for_rest()[32:48, :290])
                viewer.quit()
            for text, other in zip(*texts):
                self.assertGreater(differ(text, text[:, -1:]), 0.1)
                self.assertLess(differ(text, other), 0.02, (names, others))

    def test_help(self):
        viewer = self.start("--demo")
        plain = viewer.wait_for_rest()
        for key in ("h", "question"):
            viewer.press(key)
            viewer.wait_until(lambda picture: differ(picture, plain) > 0.1, "a help")
            viewer.press(key)
            viewer.wait_until(lambda picture: differ(picture[100:], plain[100:]) == 0.0, "a picture without help")
        viewer.quit()

    def test_framing(self):
        """r shows the surfaces whole, from the same side."""
        viewer = self.start(write_waves(self.folder))
        plain = viewer.take_picture()
        xdotool("mousemove", *viewer.middle, "click", 4, "click", 4)  # the wheel
        self.assertGreater(differ(viewer.take_picture(), plain), 0.05)
        viewer.press("r")
        self.assertLess(differ(viewer.take_picture(), plain), 0.001)
        viewer.quit()

    def write_slices(self, name, image, orientation=(1, 0, 0, 0, 1, 0)):
        slices = self.folder / name
        slices.mkdir(exist_ok=True)
        write_dicom_slices(image, slices, orientation)
        return slices

    def write_files(self):
        """The same volume in each format, and meshes."""
        shorts = vtkImageShiftScale()
        shorts.SetInputData(make_waves())
        shorts.SetOutputScalarTypeToShort()
        shorts.Update()
        image = shorts.GetOutput()
        image.SetSpacing(0.8, 1.0, 1.25)
        slices = self.write_slices("slices", image, (-1, 0, 0, 0, 1, 0))
        samples = vtk_to_numpy(image.GetPointData().GetScalars())
        (self.folder / "waves.raw").write_bytes(samples.tobytes())
        (self.folder / "waves.nhdr").write_text(
            "NRRD0004\ntype: short\ndimension: 3\nsizes: 41 41 41\nendian: little\nencoding: raw\n"
            "spacings: 0.8 1 1.25\ndata file: waves.raw\n", encoding="ascii")
        # In other orders, with headers that put them to the same places.
        turned = samples.reshape(image.GetDimensions(), order="F").T
        (self.folder / "turned.raw").write_bytes(turned.tobytes(order="F"))
        (self.folder / "waves-turned.mhd").write_text(
            "NDims = 3\nBinaryData = True\nTransformMatrix = 0 0 1 0 -1 0 -1 0 0\nElementSpacing = 1.25 1 0.8\n"
            "DimSize = 41 41 41\nAnatomicalOrientation = IPL\nElementType = MET_SHORT\nElementDataFile = turned.raw\n",
            encoding="ascii")
        (self.folder / "waves-left.nhdr").write_text(
            "NRRD0004\ntype: short\ndimension: 3\nspace: left-anterior-superior\nsizes: 41 41 41\nendian: little\n"
            "encoding: raw\nspace directions: (0,0,1.25) (0,1,0) (-0.8,0,0)\nspace origin: (0,0,0)\n"
            "data file: turned.raw\n", encoding="ascii")
        lattice = vtkRectilinearGrid()
        lattice.SetDimensions(image.GetDimensions())
        for axis, name in enumerate("XYZ"):
            coordinates = vtkDoubleArray()
            for i in range(image.GetDimensions()[axis]):
                coordinates.InsertNextValue(i * image.GetSpacing()[axis])
            getattr(lattice, f"Set{name}Coordinates")(coordinates)
        lattice.GetPointData().SetScalars(image.GetPointData().GetScalars())
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, image)
        mesh = make_grid(VTK_TETRA, ball)
        amr = vtkOverlappingAMR()
        fill(amr, NESTED, of_cells=True)
        stored = vtkImageShiftScale()
        stored.SetInputData(image)
        stored.SetScale(2.0)
        stored.SetShift(100.0)
        stored.Update()
        scaled = vtkNIFTIImageWriter()
        scaled.SetRescaleSlope(0.5)
        scaled.SetRescaleIntercept(-100.0)
        # The sform has the place; by the qform it lies on its side.
        registered, side = vtkNIFTIImageWriter(), vtkMatrix4x4()
        side.DeepCopy((1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1))
        registered.SetSFormMatrix(vtkMatrix4x4())
        registered.SetQFormMatrix(side)
        return [
            slices,
            self.write(registered, "waves-registered.nii", image),
            self.write(scaled, "waves-scaled.nii", stored.GetOutput()),
            self.folder / "waves.nhdr",
            self.folder / "waves-turned.mhd",
            self.folder / "waves-left.nhdr",
            self.write(vtkMetaImageWriter(), "waves.mha", image),
            self.write(vtkXMLImageDataWriter(), "waves.vti", image),
            self.write(vtkNIFTIImageWriter(), "waves.nii.gz", image),
            self.write(vtkDataSetWriter(), "waves.vtk", image),
            self.write(vtkXMLRectilinearGridWriter(), "waves.vtr", lattice),
            self.write(vtkXMLPImageDataWriter(), "waves.pvti", image),
            self.write(vtkXMLPUnstructuredGridWriter(), "ball.pvtu", mesh),
            self.write(vtkXMLMultiBlockDataWriter(), "waves.vtm", blocks),
            self.write(vtkXMLUniformGridAMRWriter(), "ball.vthb", amr),
            self.write(vtkXMLUnstructuredGridWriter(), "ball.vtu", mesh),
            self.write(vtkDataSetWriter(), "ball.vtk", mesh),
            self.write(vtkXMLStructuredGridWriter(), "ball.vts", make_structured_grid(ball)),
        ]

    def test_files(self):
        pictures = {}
        for path in self.write_files():
            with self.subTest(path.name):
                folder = self.folder / f"{path.name}.pictures"
                folder.mkdir()
                viewer = Viewer(PROGRAM, folder, path, size=SIZE)
                self.addCleanup(viewer.process.kill)
                pictures[path.name] = viewer.take_picture()
                viewer.quit()
        background = pictures["waves.vti"][:, :1]
        for name, picture in pictures.items():
            self.assertGreater(differ(picture, background), 0.1, name)
            if name.startswith("waves"):
                self.assertLess(differ(picture, pictures["waves.vti"]), 0.01, name)
        # Upright, and the nose is to the front.
        self.assertLess(differ(pictures["slices"], pictures["waves.vti"]), 0.01)

    def test_file_larger_than_memory(self):
        """It is used where it is, and looks the same."""
        writer = vtkMetaImageWriter()
        writer.SetCompression(False)
        path = self.write(writer, "waves.mhd", make_waves())
        pictures = []
        for memory in ("1000", "0.01"):
            viewer = Viewer(PROGRAM, self.folder, path, "--max-memory", memory, size=SIZE)
            self.addCleanup(viewer.process.kill)
            pictures.append(viewer.take_picture())
            viewer.quit()
        self.assertLess(differ(*pictures), 0.01)

    def test_several_files(self):
        left = make_waves()
        right = make_waves()
        right.SetOrigin(60.0, 0.0, 0.0)
        viewer = self.start(
            self.write(vtkXMLImageDataWriter(), "left.vti", left), self.write(vtkXMLImageDataWriter(), "right.vti", right))
        picture = viewer.take_picture()
        viewer.quit()
        covered = np.abs(picture - picture[:, :1]).max(axis=2).max(axis=0) > 30
        self.assertGreaterEqual(np.count_nonzero(np.diff(covered.astype(int)) == 1), 2)  # side by side

    def test_pages(self):
        """Each command of README.md and of the tutorials shows something."""
        self.write(vtkMetaImageWriter(), "volume.mhd", make_waves())
        slices = self.folder / "ct"
        slices.mkdir()
        write_dicom_slices(make_waves(), slices)
        mesh = make_grid(VTK_TETRA, ball)
        mesh.GetPointData().GetArray(0).SetName("pressure")
        speed = mesh.GetPointData().GetArray(0).NewInstance()
        speed.DeepCopy(mesh.GetPointData().GetArray(0))
        speed.SetName("speed")
        mesh.GetPointData().AddArray(speed)
        self.write(vtkXMLUnstructuredGridWriter(), "flow.vtu", mesh)
        pages = [SOURCE / "README.md", *sorted((SOURCE / "Documentation").glob("tutorial-*.md"))]
        text = "\n".join(page.read_text(encoding="utf-8") for page in pages)
        commands = re.findall(r"^vtkIsosurfaceViewer .*$", text, re.M)
        self.assertEqual(len(commands), 5)
        for i, command in enumerate(commands):
            with self.subTest(command):
                viewer = self.start(*shlex.split(command, comments=True)[1:])
                viewer.pictures = i
                picture = viewer.take_picture()
                viewer.quit()
                self.assertGreater(differ(picture, picture[:, :1]), 0.1)

    def test_time_dragging(self):
        """The benchmark of Documentation/measurements.md measures frames of both."""
        script = SOURCE / "Testing" / "Benchmarks" / "time_dragging.py"
        result = subprocess.run(
            [sys.executable, script, PROGRAM, write_waves(self.folder), "150", "100", "1"],
            cwd=self.folder, capture_output=True, text=True, check=True, timeout=2 * PATIENCE)
        self.assertEqual(len(re.findall(r"surfaces?: \d+ frames while moving: median [\d.]+ ms", result.stdout)), 2)

    def test_usage(self):
        result = self.run_program("--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("vtkIsosurfaceViewer FILE", "--demo", "--array", "--isovalue", "--max-memory", "Tab", ".vtm", "exit code"):
            self.assertIn(word, result.stdout)

    def test_errors(self):
        text = self.folder / "text.vti"
        text.write_text("This is not a volume.\n", encoding="ascii")
        binary = self.folder / "binary.mhd"
        binary.write_bytes(b"\\\1\0\0\n\0\0")
        surface = self.folder / "surface.vtp"
        surface.write_text("<VTKFile type='PolyData'></VTKFile>", encoding="ascii")
        levels = self.folder / "levels.vthb"
        levels.write_text('<VTKFile type="vtkHierarchicalBoxDataSet" version="1.0" byte_order="LittleEndian">'
                          '<vtkHierarchicalBoxDataSet><Block level="0" refinement_ratio="2">'
                          '<DataSet index="0" amr_box="0 3 0 2 0 2" file="0.vti"/></Block>'
                          '</vtkHierarchicalBoxDataSet></VTKFile>', encoding="ascii")
        array = self.folder / "array.npy"
        np.save(array, np.zeros((3, 3, 3)))
        mesh = self.write(vtkXMLUnstructuredGridWriter(), "ball.vtu", make_grid(VTK_TETRA, ball))
        flat = vtkDoubleArray()
        flat.SetName("flat")
        flat.SetNumberOfTuples(make_waves().GetNumberOfPoints())
        flat.Fill(1.0)
        waves = make_waves()
        waves.GetPointData().AddArray(flat)
        waves = self.write(vtkXMLImageDataWriter(), "waves.vti", waves)
        for arguments, words in (
            ((), "name files, a folder of DICOM slices, or --demo; see --help"),
            (("--demo", mesh), "name files"),
            (("--nonsense",), "unknown option --nonsense; see --help"),
            (("absent.vtu",), "there is no file absent.vtu"),
            ((text,), "text.vti cannot be read"),
            ((self.folder / "ball.obj",), "there is no file"),
            ((binary,), "binary.mhd cannot be read: it is another kind of file"),
            ((levels,), "has levels without a spacing, as files of version 1.0 have"),
            ((array,), "VTK has no image reader for"),
            ((surface,), "VTK has no image reader for"),
            ((mesh, "--array", "heat"), 'ball.vtu: there is no array "heat"'),
            ((waves, "--array", "flat"), "no two different values, so there is no surface; --array chooses another: "),
            ((waves, "--isovalue", "1", "2", "3"), "--isovalue takes at most two values"),
            ((waves, "--isovalue", "150", "500"), "there is no surface at 500: the values are from 34.0153 to 286.341"),
            ((waves, "--isovalue", "nan"), "error: "),
            ((waves, "--max-memory", "0.01"), "--max-memory"),
            ((waves, mesh), "ball.vtu: there is no array"),
        ):
            with self.subTest(arguments):
                result = self.run_program(*arguments, cwd=self.folder)
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertIn(words, result.stderr)
                self.assertTrue(result.stderr.splitlines()[-1].startswith("error: "), result.stderr)
                self.assertNotIn("WARN", result.stderr)

    def test_folders_that_are_no_series(self):
        """VTK's reader writes beyond its memory, or takes some of the slices."""
        (self.folder / "empty").mkdir()
        for name, radius, shift in (("scout", 8, 0.0), ("two", 5, 0.0), ("shifted", 5, 100.0)):
            other = make_waves(radius)
            other.SetOrigin(0.0, 0.0, shift)
            second = self.write_slices("second" + name, other)
            for path in second.iterdir():
                content = path.read_bytes().replace(b"1.2\0", b"1.3\0")  # of another series
                (self.write_slices(name, make_waves(5)) / f"second{path.name}").write_bytes(content)
        compressed = self.write_slices("compressed", make_waves(5))
        path = compressed / "004.dcm"
        path.write_bytes(path.read_bytes().replace(b"1.2.840.10008.1.2.1\0", b"1.2.840.10008.1.2.5\0"))
        cut = self.write_slices("cut", make_waves(9))
        (cut / "004.dcm").write_bytes((cut / "004.dcm").read_bytes()[:600])
        one = self.write_slices("one", make_waves(5))
        for path in sorted(one.iterdir())[1:]:
            path.unlink()
        for name, words in (
            ("empty", "has no DICOM slices; name the folder that the slices are in"),
            ("scout", "000.dcm and second000.dcm; put each series into a folder of its own"),
            ("two", "has several slices at one place"),
            ("shifted", "has 22 slices, of which VTK's reader takes 11 for one series"),
            ("compressed", "004.dcm is compressed or big-endian (transfer syntax 1.2.840.10008.1.2.5)"),
            ("cut", "004.dcm is damaged: it ends before its last samples"),
            ("one", "has one slice, 000.dcm; if there are several in it, convert them by dcm2niix"),
        ):
            with self.subTest(name):
                result = self.run_program(self.folder / name)
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertIn(words, result.stderr)

    def test_warnings(self):
        """Of what is left out."""
        missing = self.write_slices("missing", make_waves(5))
        (missing / "003.dcm").unlink()
        tilted = self.write_slices("tilted", make_waves(9), (1, 0, 0, 0, 0.8, 0.6))
        several = vtkNIFTIImageWriter()
        several.SetTimeDimension(3)
        volumes = vtkImageAppendComponents()
        for _ in range(3):
            volumes.AddInputData(make_waves(5))
        volumes.Update()
        sheared = vtkNIFTIImageWriter()
        matrix = vtkMatrix4x4()
        matrix.SetElement(0, 1, 0.5)
        sheared.SetSFormMatrix(matrix)
        for path, words in (
            (missing, "slices are missing, or are not evenly spaced: from 004.dcm to 002.dcm it is 2 mm, elsewhere 1"),
            (tilted, "the slices are shifted against each other by up to"),
            (self.write(several, "several.nii", volumes.GetOutput()), "has 3 volumes; the first of them is taken"),
            (self.write(sheared, "sheared.nii", make_waves(5)), "the axes that its sform gives are not perpendicular"),
        ):
            with self.subTest(path.name):
                result = self.run_program(path, "--array", "absent")
                self.assertRegex(result.stderr, rf"^warning: .*{re.escape(path.name)}.*{re.escape(words)}")

    def test_bad_volumes(self):
        for file_name in write_bad_volumes(self.folder):
            with self.subTest(file_name):
                result = self.run_program(file_name)
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertIn(file_name, result.stderr.splitlines()[-1])

    def test_displays(self):
        for environment in (with_display(":9999"), without_display()):
            result = self.run_program("--demo", env=environment)
            self.assertEqual(result.returncode, 1)
            self.assertIn("error: ", result.stderr)
            self.assertIn("display", result.stderr.lower())


if __name__ == "__main__":
    unittest.main()
