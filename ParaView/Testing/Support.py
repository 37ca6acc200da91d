# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: to run scripts in ParaView's programs, and to compare pictures."""

import os
import pathlib
import subprocess

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

HERE = pathlib.Path(__file__).resolve().parent
PICTURES = pathlib.Path(os.environ["PICTURES_FOLDER"])
SECONDS = 600


def program(name):
    return os.path.join(os.environ["PARAVIEW_PROGRAMS"], name)


def on_processes(processes, *command):
    return [*(["mpirun", "--oversubscribe", "-np", str(processes)] if processes > 1 else []), *map(str, command)]


def run(command, **environment):
    """Returns what a command prints; fails with it if the command fails or ParaView reports an error."""
    done = subprocess.run(
        command,
        env={**os.environ, **environment},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=SECONDS,
    )
    if done.returncode != 0 or "ERR|" in done.stdout:
        raise AssertionError(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def run_pvbatch(processes, script, *arguments):
    """Runs a script of this folder."""
    return run(on_processes(processes, program("pvbatch"), HERE / script, *arguments))


def draw(processes, names):
    """Draws scenes of Scenes.py; returns their files by name."""
    folder = PICTURES / f"{processes}-processes"
    folder.mkdir(parents=True, exist_ok=True)
    run_pvbatch(processes, "DrawScenes.py", folder, *names)
    return find_pictures(folder, names)


def find_pictures(folder, names):
    files = {name: folder / f"{name}.png" for name in names}
    for path in files.values():
        if read_picture(path).std() < 5:
            raise AssertionError(f"the picture {path} is empty")
    return files


def read_picture(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    scalars = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return scalars[:, :3].reshape(height, width, 3).astype(int)


def differences(path, other):
    """Of each pixel the largest difference of its colours, of 255."""
    picture, expected = read_picture(path), read_picture(other)
    if picture.shape != expected.shape:
        raise AssertionError(f"{path} is {picture.shape}, {other} is {expected.shape}")
    return abs(picture - expected).max(axis=2)
