#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of Examples/Python that have no test of their own, and README.md's snippet."""

import contextlib
import io
import itertools
import os
import plistlib
import re
import runpy
import signal
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from vtkmodules.vtkCommonDataModel import VTK_TETRA
from vtkmodules.vtkIOImage import vtkMetaImageReader, vtkMetaImageWriter, vtkNIFTIImageWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLUnstructuredGridWriter
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor
from vtkIsosurfaceRayTracing import render

from DicomSlices import write_dicom_slices
from MeshTesting import ball, make_grid
from PictureTesting import (
    EXAMPLES,
    ISOVALUE,
    count_colored,
    difference,
    make_interactor,
    make_waves,
    read,
    write_bad_volumes,
    write_waves,
)

METHODS = ["vtkFlyingEdges3D", "vtkMarchingCubes", "vtkSynchronizedTemplates3D", "vtkContourFilter",
           "vtkSpanSpace", "vtkIsosurfaceRayTraceMapper"]


class TestExamples(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def run_script(self, script, *arguments):
        return subprocess.run(
            [sys.executable, os.path.join(EXAMPLES, script), *arguments],
            capture_output=True, text=True, check=False)

    def check_script(self, script, *arguments):
        """What a script prints that comes to a good end."""
        result = self.run_script(script, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_compare_isosurfaces(self):
        output = self.check_script("compare_isosurfaces.py", write_waves(self.folder), str(ISOVALUE))
        lines = {name: values for name, *values in map(str.split, output.splitlines())}
        self.assertEqual(lines["Method"], METHODS)
        for name in ("FirstPictureTime", "NextPictureTime", "NewIsovaluePictureTime", "Bytes"):
            for value in lines[name]:
                self.assertGreater(float(value), 0.0, name)
        for name in ("ExtractionTime", "Triangles", "MedianDistance"):
            for value in lines[name][:-1]:
                self.assertGreater(float(value), 0.0, name)
        self.assertEqual(lines["ExtractionTime"][-1], "nan")
        self.assertEqual(lines["Note"], [])

    def test_compare_isosurfaces_shows_whole_notes(self):
        output = self.check_script("compare_isosurfaces.py", write_waves(self.folder), "1000")
        self.assertIn("No surface: the scalars are from 34.0153 to 286.341.", output)

    def test_ray_trace_isosurface(self):
        picture = os.path.join(self.folder, "picture.png")
        self.check_script(
            "ray_trace_isosurface.py", write_waves(self.folder), str(ISOVALUE), picture)
        pixels = read(picture)
        self.assertEqual(len(pixels), 800 * 800)
        background, surface = pixels[0], pixels[400 * 800 + 400]
        self.assertEqual(background, (41.0, 46.0, 56.0))
        self.assertGreater(surface[0], 100.0)

    def run_with_events(self, script, act):
        """Runs an example with act(interactor) in place of the loop over events. Returns its names."""

        class Interactor:
            def __new__(cls):
                interactor = vtkRenderWindowInteractor()
                interactor.AddObserver("StartEvent", lambda *_: act(interactor))
                return interactor

        arguments = [os.path.join(EXAMPLES, script), write_waves(self.folder), str(ISOVALUE)]
        with mock.patch("vtkmodules.vtkRenderingCore.vtkRenderWindowInteractor", Interactor):
            with mock.patch.object(sys, "argv", arguments):
                return runpy.run_path(arguments[0])

    def test_isosurface_slider(self):
        """The mouse drags its knob."""

        def drag(interactor):
            before.append(interactor.GetRenderWindow().GetRenderers().GetFirstRenderer().GetVolumes()
                          .GetLastProp().GetProperty().GetIsoSurfaceValues().GetValue(0))
            for x, event in ((374, "LeftButtonPressEvent"), (480, "MouseMoveEvent"), (480, "LeftButtonReleaseEvent")):
                interactor.SetEventInformation(x, 80)
                interactor.InvokeEvent(event)

        before = []
        names = self.run_with_events("isosurface_slider.py", drag)
        self.assertEqual(before, [ISOVALUE])
        isovalue = names["volume"].GetProperty().GetIsoSurfaceValues().GetValue(0)
        self.assertAlmostEqual(isovalue, ISOVALUE + 106 / 640 * (286.341 - 34.0153), delta=3.0)
        self.assertIn("isosurface_slider.py VOLUME ISOVALUE", self.run_script("isosurface_slider.py").stderr)

    def test_pick(self):
        """A click tells where the surface is."""

        def click(interactor):
            for position in itertools.product(range(100, 800, 120), repeat=2):
                interactor.SetEventInformation(*position)
                interactor.InvokeEvent("LeftButtonPressEvent")
                interactor.InvokeEvent("LeftButtonReleaseEvent")

        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            self.run_with_events("pick.py", click)
        lines = printed.getvalue().splitlines()
        self.assertIn(len(lines), range(3, 34))
        for line in lines:
            self.assertRegex(line, r"^position( -?[0-9.e+-]+){3} normal( -?[0-9.e+-]+){3} cell \d+$")

    def run_with_small_pictures(self, script, *arguments):
        """In less time."""
        small = mock.patch.dict(render.__kwdefaults__, size=(100, 80))
        with small, mock.patch.object(sys, "argv", [script, *arguments]):
            runpy.run_path(os.path.join(EXAMPLES, script))

    def test_numpy_to_png(self):
        picture = os.path.join(self.folder, "picture.png")
        self.run_with_small_pictures("numpy_to_png.py", picture)
        self.assertGreater(count_colored(picture), 3000)

    def test_ct(self):
        volume = vtkImageShiftScale()  # as Hounsfield units
        volume.SetInputData(make_waves())
        volume.SetShift(-ISOVALUE)
        volume.SetScale(10.0)
        writer = vtkMetaImageWriter()
        writer.SetInputConnection(volume.GetOutputPort())
        writer.SetFileName(os.path.join(self.folder, "ct.mhd"))
        writer.Write()
        self.run_with_small_pictures("ct.py", os.path.join(self.folder, "ct.mhd"), self.folder)
        for name in ("skin_and_bone", "slice", "caps"):
            self.assertGreater(len(set(read(os.path.join(self.folder, f"{name}.png")))), 10, name)

    def test_volumes(self):
        """A brain, half of it, and a simulation."""
        waves = vtkImageShiftScale()  # between the values of a brain and of nothing
        waves.SetInputData(make_waves())
        waves.SetShift(60.0 - ISOVALUE)
        writer = vtkNIFTIImageWriter()
        writer.SetInputConnection(waves.GetOutputPort())
        writer.SetFileName(os.path.join(self.folder, "brain.nii.gz"))
        writer.Write()
        self.run_with_small_pictures("other_volumes.py", os.path.join(self.folder, "brain.nii.gz"), self.folder)
        for name in ("brain", "brain_cut", "reaction"):
            self.assertGreater(count_colored(os.path.join(self.folder, f"{name}.png")), 1000, name)
            self.assertGreater(len(set(read(os.path.join(self.folder, f"{name}.png")))), 100, name)

    def test_simulation(self):
        """Its pictures change with the time, but not the camera and the scalar bar."""
        names = [os.path.join(self.folder, f"flow{step}") for step in range(2)]
        for step, name in enumerate(names):
            mesh = make_grid(VTK_TETRA, lambda point, step=step: ball(point) - 0.2 * step)
            speed = mesh.GetPointData().GetScalars()
            pressure = speed.NewInstance()
            pressure.DeepCopy(speed)
            speed.SetName("speed")
            pressure.SetName("pressure")
            mesh.GetPointData().SetScalars(pressure)  # the other one is not active
            mesh.GetPointData().AddArray(speed)
            writer = vtkXMLUnstructuredGridWriter()
            writer.SetInputData(mesh)
            writer.SetFileName(f"{name}.vtu")
            writer.Write()
        self.check_script("simulation.py", "speed", "0.2", "pressure", *(f"{name}.vtu" for name in names))
        first, second = (read(f"{name}.png") for name in names)
        different = sum(a != b for a, b in zip(first, second))
        self.assertGreater(different, 100)
        self.assertLess(different, 0.5 * len(first))
        self.assertGreater(count_colored(f"{names[0]}.png"), 1000)

    def test_small_ones_are_small(self):
        scripts = [Path(EXAMPLES, f"{name}.py") for name in ("ct", "isosurface_slider", "mpi", "numpy_to_png", "pick", "simulation")]
        for path in (*scripts, Path(EXAMPLES, "../Cxx/Minimal/Minimal.cxx")):
            self.assertLess(len(path.read_text(encoding="utf-8").splitlines()), 40, path.name)
        for path in (Path(EXAMPLES, "mpi_cloud.py"), Path(EXAMPLES, "../Cxx/MeshWindow/MeshWindow.cxx")):
            self.assertLess(len(path.read_text(encoding="utf-8").splitlines()), 60, path.name)

    def test_formats_of_volumes(self):
        """The same volume in each makes the same picture."""
        volume = vtkImageShiftScale()
        volume.SetInputData(make_waves())
        volume.SetOutputScalarTypeToShort()
        volume.Update()
        folder = Path(self.folder)
        slices = folder / "slices"
        slices.mkdir()
        write_dicom_slices(volume.GetOutput(), slices)
        names = [slices]
        for writer, name in ((vtkMetaImageWriter(), "waves.mhd"), (vtkXMLImageDataWriter(), "waves.vti"),
                             (vtkNIFTIImageWriter(), "waves.nii"), (vtkNIFTIImageWriter(), "waves.nii.gz")):  # fmt: skip
            writer.SetInputData(volume.GetOutput())
            writer.SetFileName(str(folder / name))
            writer.Write()
            names.append(folder / name)
        pictures = []
        for name in names:
            picture = str(folder / "picture.png")
            self.check_script("ray_trace_isosurface.py", str(name), str(ISOVALUE), picture)
            pictures.append(read(picture))
        for name, picture in zip(names[1:], pictures[1:]):
            self.assertLess(difference(picture, pictures[0]), 0.001, name)

    def test_folder_without_slices(self):
        result = self.run_script("ray_trace_isosurface.py", self.folder, str(ISOVALUE), "picture.png")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("has no DICOM slices", result.stderr)

    def test_many_grids(self):
        """Rays and triangles show the same surfaces."""
        output = self.check_script("many_grids.py", write_waves(self.folder), str(ISOVALUE), self.folder)
        names = ("refined", "registered", "mixed")
        self.assertEqual(len(output.splitlines()), len(names))
        for name, line in zip(names, output.splitlines()):
            times = re.fullmatch(rf".*/{name}\.png: rays ([0-9.]+) ms, triangles ([0-9.]+) ms", line)
            self.assertTrue(times, line)
            self.assertGreater(min(float(time) for time in times.groups()), 0.0)
            pixels = read(os.path.join(self.folder, name + ".png"))
            self.assertEqual(len(pixels), 960 * 480)
            shown = [pixel != (41.0, 46.0, 56.0) for pixel in pixels]
            sides = [[shown[960 * y + x] for y in range(480) for x in range(first, first + 480)] for first in (0, 480)]
            self.assertGreater(sum(sides[0]), 0.1 * len(sides[0]))
            different = sum(a != b for a, b in zip(*sides))
            self.assertLess(different, 0.02 * sum(sides[0]))
        result = self.run_script("many_grids.py", write_waves(self.folder), "1", self.folder, "absent", "Density", "1")
        self.assertIn("there is no file absent", result.stderr)

    def test_pictures_that_cannot_be_written(self):
        volume = write_waves(self.folder)
        picture = os.path.join(self.folder, "absent", "picture.png")
        result = self.run_script("ray_trace_isosurface.py", volume, str(ISOVALUE), picture)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("picture.png cannot be written: No such file or directory", result.stderr)
        for script, first in (("gallery.py", "shadows.png"), ("scenes.py", "translucent_polygons.png")):
            os.mkdir(os.path.join(self.folder, first))  # where a file of that name should go
            result = self.run_script(script, volume, str(ISOVALUE), self.folder)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(f"{first} cannot be written: Is a directory", result.stderr)
            self.assertEqual(list(Path(self.folder).glob("*.part")), [])

    def test_files_are_whole_or_absent(self):
        """Of a file whose writing a signal ends, nothing is left but the old one."""
        target = Path(self.folder, "old.txt")
        target.write_text("old", encoding="ascii")
        program = ("import sys, time; from whole_file import write_whole\n"
                   "def write(stream): stream.write(b'new'); print(flush=True); time.sleep(60)\n"
                   "write_whole(sys.argv[1], write)")
        for number in (signal.SIGINT, signal.SIGTERM):
            with subprocess.Popen(
                    [sys.executable, "-c", program, target], cwd=EXAMPLES, stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL,
                    preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler)
            ) as process:
                process.stdout.readline()
                process.send_signal(number)
            self.assertNotEqual(process.returncode, 0)
            self.assertEqual(os.listdir(self.folder), ["old.txt"])
            self.assertEqual(target.read_text(encoding="ascii"), "old")

    def test_bad_volumes(self):
        """One error names the file; nothing is measured or drawn."""
        picture = os.path.join(self.folder, "picture.png")
        for file_name in (os.path.join(self.folder, "absent.mhd"), *write_bad_volumes(self.folder)):
            for script, last in (("compare_isosurfaces.py", ()), ("ray_trace_isosurface.py", (picture,)),
                                 ("gallery.py", (self.folder,)), ("scenes.py", (self.folder,)),
                                 ("many_grids.py", (self.folder,))):
                with self.subTest(script, file_name=file_name):
                    result = self.run_script(script, file_name, str(ISOVALUE), *last)
                    self.assertEqual(result.returncode, 1, result.stderr)
                    self.assertEqual(result.stderr.count(file_name), 1, result.stderr)
                    self.assertIn(file_name, result.stderr.splitlines()[-1])
                    self.assertEqual(result.stdout, "")
        self.assertEqual(list(Path(self.folder).glob("*.png")), [])

    def test_usage(self):
        for script, arguments in (
            ("compare_isosurfaces.py", "VOLUME.mhd ISOVALUE"),
            ("ray_trace_isosurface.py", "VOLUME ISOVALUE PICTURE.png"),
            ("many_grids.py", "VOLUME.mhd ISOVALUE FOLDER"),
        ):
            for given in ((), ("absent.mhd", "1", "picture.png")[: len(arguments.split())]):
                result = self.run_script(script, *given)
                self.assertNotEqual(result.returncode, 0)
                words = "there is no file absent.mhd" if given else f"{script} {arguments}"
                self.assertIn(words, result.stderr)

    def test_readme(self):
        """Its snippet, as it is but for the names and the isovalue."""
        with open(os.path.join(EXAMPLES, "../../README.md"), encoding="utf-8") as readme:
            _, snippet = re.findall(r"```python\n(.*?)```", readme.read(), re.DOTALL)
        snippet = snippet.replace("volume.mhd", write_waves(self.folder)).replace("300", str(ISOVALUE))
        scene = {}
        with mock.patch("vtkmodules.vtkRenderingCore.vtkRenderWindowInteractor", make_interactor):
            exec(compile(snippet, "README.md", "exec"), scene)
        width, height = scene["window"].GetSize()
        red, _, blue = scene["window"].GetPixelData(
            width // 2, height // 2, width // 2, height // 2, 0, 0)[:3]
        self.assertGreater(red, blue)  # ivory

    def write_project(self, sample_count=24):
        """An InVesalius project of 2 x 3 x 4 samples, of which as many are there."""
        samples = bytes(range(2 * sample_count))
        description = {"spacing": (0.5, 1.0, 2.0),
                       "matrix": {"filename": "matrix.dat", "shape": (4, 3, 2), "dtype": "int16"}}
        project = os.path.join(self.folder, "Small.inv3")
        with tarfile.open(project, "w:gz") as archive:
            for name, content in (("main.plist", plistlib.dumps(description)),
                                  ("matrix.dat", samples)):
                file_name = os.path.join(self.folder, name)
                with open(file_name, "wb") as stream:
                    stream.write(content)
                archive.add(file_name, arcname=f"project/{name}")
        return project

    def test_invesalius_to_metaimage(self):
        output = self.check_script("invesalius_to_metaimage.py", self.write_project(), self.folder)
        volume = os.path.join(self.folder, "small.mhd")
        self.assertEqual(output, volume + "\n")
        reader = vtkMetaImageReader()
        reader.SetFileName(volume)
        reader.Update()
        image = reader.GetOutput()
        self.assertEqual(image.GetDimensions(), (2, 3, 4))
        self.assertEqual(image.GetSpacing(), (0.5, 1.0, 2.0))
        self.assertEqual(image.GetScalarComponentAsDouble(1, 0, 0, 0), 0x0302)

    def test_invesalius_project_that_is_broken(self):
        result = self.run_script(
            "invesalius_to_metaimage.py", self.write_project(sample_count=23), self.folder)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("matrix.dat has 46 bytes", result.stderr)

    def run_mayavi_meshes(self, *names):
        """With an apt-get that makes a package of files of these names, and a dpkg-deb that knows it."""
        tools = Path(self.folder, "tools")
        tools.mkdir()
        programs = {"apt-get": "import io, tarfile\n"
                               "with tarfile.open('mayavi2_1.deb', 'w') as tar:\n"
                               f"    for name in {names}:\n"
                               "        member = tarfile.TarInfo('./usr/share/' + name)\n"
                               "        member.size = len(name)\n"
                               "        tar.addfile(member, io.BytesIO(name.encode()))\n",
                    "dpkg-deb": "import sys\n"
                                "sys.stdout.buffer.write(open(sys.argv[2], 'rb').read())\n"}
        for name, program in programs.items():
            Path(tools, name).write_text(f"#!{sys.executable}\n{program}", encoding="ascii")
            os.chmod(Path(tools, name), 0o755)
        return subprocess.run(
            [sys.executable, os.path.join(EXAMPLES, "mayavi_meshes.py"), os.path.join(self.folder, "data")],
            env={**os.environ, "PATH": str(tools)}, capture_output=True, text=True, check=False)

    def test_mayavi_meshes(self):
        names = ["disk_out_ref.ex2", "fire_ug.vtu", "SampleStructGrid.vtk"]
        result = self.run_mayavi_meshes("other.vtk", *names)
        paths = [os.path.join(self.folder, "data", name) for name in names]
        self.assertEqual(result.stdout.split(), paths, result.stderr)
        self.assertEqual([Path(path).read_text(encoding="ascii") for path in paths], names)
        self.assertEqual(len(os.listdir(os.path.join(self.folder, "data"))), 3)

    def test_mayavi_meshes_of_another_package(self):
        result = self.run_mayavi_meshes("fire_ug.vtu", "other.vtk")
        self.assertEqual(result.returncode, 1)
        self.assertIn("mayavi2_1.deb has no disk_out_ref.ex2, SampleStructGrid.vtk", result.stderr)

    def test_mayavi_meshes_without_tools(self):
        result = subprocess.run([sys.executable, os.path.join(EXAMPLES, "mayavi_meshes.py"), self.folder],
                                env={**os.environ, "PATH": self.folder}, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("cannot be had: apt-get: No such file or directory", result.stderr)


if __name__ == "__main__":
    unittest.main()
