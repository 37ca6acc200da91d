# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints times and memory of one way to show an isosurface: pvbatch MeasureTimes.py WAY [CELLS [PIXELS]]

WAY is traced (this plugin), contour (the filter, its polygons as a surface) or volume (ParaView's volume
representation with isosurfaces), of a wavelet of CELLS^3 cells, in a picture of PIXELS^2. Beside each time stands that
of the processors, of all threads, which other programs disturb less.
"""

import os
import statistics
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview.simple import Contour, Render, Show  # noqa: E402

import Scenes  # noqa: E402

ISOVALUES = (150.0, 160.0, 170.0, 180.0, 190.0)


def show_traced(source, view):
    display = Scenes.show(source, view)
    return lambda isovalue: setattr(display, "Isovalues", [isovalue])


def show_contour(source, view):
    contour = Contour(Input=source, ContourBy=list(Scenes.POINTS), Isosurfaces=[157.0])
    Show(contour, view).ColorArrayName = ["POINTS", ""]
    return lambda isovalue: setattr(contour, "Isosurfaces", [isovalue])


def show_volume(source, view):
    display = Show(source, view)
    display.SetRepresentationType("Volume")
    display.BlendMode = "Isosurface"
    display.Shade = 1
    Scenes.color_by(display, *Scenes.POINTS)
    return lambda isovalue: setattr(display, "IsosurfaceValues", [isovalue])


def seconds(change, argument, view):
    """Of the clock, and of the processors."""
    start, start_of_processors = time.perf_counter(), time.process_time()
    change(argument)
    Render(view)
    return time.perf_counter() - start, time.process_time() - start_of_processors


def describe(times):
    """The medians."""
    clock, processors = (statistics.median(column) for column in zip(*times))
    return f"{clock:.3f} s ({processors:.3f} s of processors)"


def resident_mebibytes():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1024


way = sys.argv[1]
cells = int(sys.argv[2]) if len(sys.argv) > 2 else 256
pixels = int(sys.argv[3]) if len(sys.argv) > 3 else 400
view = Scenes.make_view(pixels)
view.CameraPosition = [1.4 * cells, cells, 1.8 * cells]
source = Scenes.make_wavelet(cells)
source.UpdatePipeline()
Render(view)
before = resident_mebibytes()
set_isovalue = globals()[f"show_{way}"](source, view)
first = seconds(set_isovalue, 157.0, view)
isovalues = [seconds(set_isovalue, isovalue, view) for isovalue in ISOVALUES]
camera = view.GetActiveCamera()
orbit = [seconds(camera.Azimuth, 5.0, view) for _ in range(10)]
print(f"{way}: first picture {describe([first])}, new isovalue {describe(isovalues)}, "
      f"orbit frame {describe(orbit)}, memory {resident_mebibytes() - before:.0f} MiB")
