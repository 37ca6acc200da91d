# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of pictures share: a volume that every clone can make, baselines, comparisons."""

import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

from vtkmodules.vtkFiltersCore import vtkPointDataToCellData
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkPNGReader
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor, vtkWindowToImageFilter

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "../../Examples/Python")
BASELINES = os.path.join(HERE, "../Data/Baseline")
sys.path.insert(0, EXAMPLES)

SIZE = 160
ISOVALUE = 150.0


def make_waves(radius=20):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(*3 * (-radius, radius))
    source.Update()
    return source.GetOutput()


def add_array_of_cells(data, name):
    """The averages of the array of points of this name, called "of cells"."""
    average = vtkPointDataToCellData()
    average.SetInputData(data)
    average.Update()
    array = average.GetOutput().GetCellData().GetArray(name)
    array.SetName("of cells")
    data.GetCellData().AddArray(array)
    return array


def write_waves(folder, radius=20):
    """The name of the file."""
    file_name = os.path.join(folder, "waves.mhd")
    writer = vtkMetaImageWriter()
    writer.SetInputData(make_waves(radius))
    writer.SetFileName(file_name)
    writer.Write()
    return file_name


def write_bad_volumes(folder):
    """The names of files that are no whole volumes."""
    header = Path(write_waves(folder)).read_text(encoding="ascii")
    files = {
        "text.mhd": "This is not a volume.\n",
        "huge.mhd": re.sub("DimSize = .*", "DimSize = 8192 8192 8192", header),  # 2 TB
        "flat.mhd": re.sub("ElementSpacing = .*", "ElementSpacing = 1 0 1", header),
        "without_samples.mhd": header.replace("waves.", "absent."),
        "cut.mhd": header.replace("waves.", "cut."),
    }
    for name, text in files.items():
        Path(folder, name).write_text(text, encoding="ascii")
    (samples,) = re.findall("ElementDataFile = (.*)", header)
    Path(folder, samples.replace("waves.", "cut.")).write_bytes(Path(folder, samples).read_bytes()[:999])
    return [os.path.join(folder, name) for name in files]


def read(file_name):
    """The pixels of a picture, in rows."""
    reader = vtkPNGReader()
    reader.SetFileName(file_name)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    return [scalars.GetTuple(i) for i in range(scalars.GetNumberOfTuples())]


def count_colored(file_name):
    """The number of pixels that are not white."""
    return sum(color != (255.0, 255.0, 255.0) for color in read(file_name))


def capture(window):
    """The bytes of the picture in a window as it is."""
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ReadFrontBufferOff()
    grabber.ShouldRerenderOff()
    grabber.Update()
    return bytes(memoryview(grabber.GetOutput().GetPointData().GetScalars()))


def difference(picture, other):
    """The share of pixels of which a channel differs by more than two steps."""
    different = sum(1 for a, b in zip(picture, other)
                    if max(abs(x - y) for x, y in zip(a, b)) > 2)
    return different / len(picture)


class PictureTestCase(unittest.TestCase):
    def check_baselines(self, pictures, prefix):
        """Each picture, by its name, is the baseline <prefix>-<name>.png, or a <prefix>-<name>_1.png of another VTK."""
        for name, picture in pictures.items():
            with self.subTest(name):
                self.assertEqual(len(picture), SIZE * SIZE)
                baselines = [read(path) for path in sorted(Path(BASELINES).glob(f"{prefix}-{name}*.png"))
                             if re.fullmatch(r"(_\d)?", path.stem[len(f"{prefix}-{name}"):])]
                self.assertEqual({(len(each), len(each[0])) for each in baselines}, {(len(picture), len(picture[0]))})
                self.assertLessEqual(min(difference(picture, each) for each in baselines), 0.002)

    def check_none_is_like_another(self, pictures):
        names = list(pictures)
        for i, name in enumerate(names):
            for other in names[:i]:
                self.assertGreater(
                    difference(pictures[name], pictures[other]), 0.01, f"{name} and {other}")

    def check_usage(self, script):
        """Without arguments it says which it needs."""
        result = subprocess.run(
            [sys.executable, os.path.join(EXAMPLES, script)], capture_output=True, check=False)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn(script.encode() + b" VOLUME.mhd ISOVALUE FOLDER", result.stderr)


def make_interactor():
    """Of a user who closes the window at once."""
    interactor = vtkRenderWindowInteractor()
    interactor.AddObserver("StartEvent", lambda caller, _: caller.Render())  # instead of the loop
    return interactor
