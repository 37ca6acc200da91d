# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""vtkIsosurfaceViewer, or another program with a window, as a user works with it, by the keys and the mouse of an X server (xdotool, xwd)."""

import struct
import subprocess
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

PATIENCE = 60.0  # seconds


def xdotool(*arguments):
    return subprocess.run(["xdotool", *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def wait_for(condition, what):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"{what} did not come")
        time.sleep(0.05)


def read_png(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1].astype(int)


def differ(one, other, by=8):
    """The share of pixels that differ."""
    return np.mean(np.abs(one - other).max(axis=2) > by)


class Viewer:
    """A viewer that is running in a folder."""

    def __init__(self, program, folder, *arguments, size=None, name="vtkIsosurfaceViewer"):
        self.folder = folder
        self.name = name  # of the window
        self.process = subprocess.Popen(
            [program, *map(str, arguments)], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        wait_for(self._find_window, "a window")
        if size:
            xdotool("windowsize", "--sync", self.window, *size)
        width, height = size or (1000, 800)
        self.middle = (width // 2, 3 * height // 8)  # of what is above the sliders
        xdotool("mousemove", *self.middle)
        self.wait_until(lambda picture: picture.std() > 1.0, "a first frame")
        self.pictures = 0

    def _find_window(self):
        if self.process.poll() is not None:
            raise AssertionError(self.process.communicate())
        found = subprocess.run(
            ["xdotool", "search", "--onlyvisible", "--name", self.name],
            check=False, capture_output=True, text=True).stdout.split()
        self.window = found[0] if found else None
        return self.window

    def press(self, *keys):
        xdotool("key", *keys)

    def type(self, text):
        self.press(*({"-": "minus", ".": "period"}.get(character, character) for character in text), "Return")

    def take_picture(self):
        """What the viewer writes, when it has done all that was asked before."""
        self.pictures += 1
        path = self.folder / f"vtkIsosurfaceViewer-{self.pictures}.png"
        self.press("w")
        wait_for(path.exists, path)
        return read_png(path)

    def capture(self):
        """What the window shows now."""
        dump = subprocess.run(["xwd", "-silent", "-id", self.window], check=True, capture_output=True).stdout
        header = struct.unpack(">25I", dump[:100])
        width, height, line, colors = header[4], header[5], header[12], header[19]
        pixels = np.frombuffer(dump, np.uint8, height * line, header[0] + 12 * colors)
        return pixels.reshape(height, line)[:, : 4 * width].reshape(height, width, 4)[:, :, 2::-1].astype(int)

    def wait_until(self, condition, what):
        wait_for(lambda: condition(self.capture()), what)

    def wait_for_rest(self):
        """Returns what the window shows when it does not change any more."""
        pictures = [self.capture()]

        def is_at_rest():
            time.sleep(0.7)
            pictures.append(self.capture())
            return differ(pictures[-1], pictures[-2], 0) == 0.0

        wait_for(is_at_rest, "a picture at rest")
        return pictures[-1]

    def quit(self):
        """The text that it prints."""
        self.press("q")
        out, err = self.process.communicate(timeout=PATIENCE)
        if self.process.returncode != 0 or err:
            raise AssertionError((self.process.returncode, err))
        return out
