# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Isosurfaces of volumes and meshes, ray traced on the CPU.

>>> from vtkIsosurfaceRayTracing import render
>>> render("head.vti", 300).save("skull.png")

``render`` makes a picture, without a display and without OpenGL; ``show`` opens a window; ``isosurface`` makes a
``vtkVolume`` for any renderer of VTK or plotter of PyVista; ``cast_rays`` finds where rays meet surfaces; ``read``
reads a file or a folder of DICOM slices. The classes of VTK are here too; they do without numpy, which the functions
need.
"""

import importlib
import os
import typing

# Threads of GNU's OpenMP that wait spin for some 8 ms before they sleep, unless they are told not to when it is loaded,
# which is now: between pictures that takes processors from Mesa, which draws them with threads of its own, and if other
# programs run, it may keep the thread that is waited for from running. 0.3 ms suffice. Others in this process that use
# the same OpenMP have it, too; programs that are started do not inherit it.
_has_policy = "OMP_WAIT_POLICY" in os.environ or "GOMP_SPINCOUNT" in os.environ
if not _has_policy:
    os.environ["GOMP_SPINCOUNT"] = "10000"

try:
    from ._version import __version__
    from .vtkIsosurfaceRayTracing import *
finally:
    if not _has_policy:
        os.environ.pop("GOMP_SPINCOUNT", None)

if typing.TYPE_CHECKING:
    from ._files import read
    from ._picture import Picture
    from ._rays import Hits, cast_rays
    from ._render import render
    from ._show import show
    from ._surface import isosurface

_MODULES = {
    "Hits": "_rays",
    "Picture": "_picture",
    "cast_rays": "_rays",
    "isosurface": "_surface",
    "read": "_files",
    "render": "_render",
    "show": "_show",
}


def __getattr__(name):
    """The functions are imported when they are first used: with them come numpy and VTK's readers."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f".{_MODULES[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted({*globals(), *_MODULES})


__all__ = [name for name in __dir__() if not name.startswith("_") and name not in ("importlib", "os", "typing")]
