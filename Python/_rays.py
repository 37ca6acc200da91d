# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Where rays meet surfaces."""

from __future__ import annotations

import typing

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ._errors import call
from ._numbers import to_array
from ._scene import to_volume


class Hits(typing.NamedTuple):
    """What rays meet: arrays with a row for each hit, by ray and from front to back."""

    rays: np.ndarray
    """The numbers of the rays."""
    t: np.ndarray
    """The distances, in units of the lengths of the directions."""
    points: np.ndarray
    normals: np.ndarray
    """Unit vectors, towards smaller values."""
    isovalues: np.ndarray
    cells: np.ndarray
    """The numbers of the cells."""
    parametric: np.ndarray
    """The coordinates in the cells, from 0 to 1."""


def cast_rays(
    surfaces: typing.Any,
    origins: typing.Any,
    directions: typing.Any,
    isovalues: float | typing.Sequence[float] | str = "auto",
    **options: typing.Any,
) -> Hits:
    """Find where rays meet isosurfaces, up to the first opaque one.

    A ray also ends where the surfaces in front together transmit less than 1/1024 of the light: after 11 hits of
    opacity 0.5. An opacity of 0.001 finds all hits (up to some 6900).

    Parameters
    ----------
    surfaces, isovalues, **options
        As for ``isosurface``, or volumes that it returned.
    origins, directions : array_like
        Rows of x, y and z; a single row is used for all rays.

    Returns
    -------
    Hits

    Examples
    --------
    >>> hits = cast_rays(ct, [[0, 0, z] for z in range(100)], [1, 0, 0], isovalues=300, opacity=0.001)
    >>> thickness = np.ptp(hits.t[hits.rays == 50])
    """
    volume = to_volume(surfaces, isovalues, options)
    origins, directions = _to_rows("origins", origins), _to_rows("directions", directions)
    try:
        origins, directions = np.broadcast_arrays(origins, directions)
    except ValueError:
        counts = f"{len(origins)} origins and {len(directions)} directions"
        raise ValueError(f"there are {counts}; give as many, or one") from None
    for ray in np.flatnonzero(~directions.any(axis=1))[:1]:
        raise ValueError(f"the direction of ray {ray} is (0, 0, 0); give one that is not, or leave out the ray")
    points, hits = vtkPoints(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(origins)))
    call(volume.GetMapper(), "CastRays", volume, points, numpy_to_vtk(np.ascontiguousarray(directions)), hits)
    return Hits(*(_values(hits, name) for name in (
        "RayId", "T", None, "Normals", "Isovalue", "CellId", "ParametricCoordinates")))  # fmt: skip


def _to_rows(name, vectors):
    remedy = "give rows of three finite numbers"
    rows = np.atleast_2d(to_array(name, vectors, remedy))
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise ValueError(f"{name} have the shape {np.shape(vectors)}; {remedy}")
    for row in np.flatnonzero(~np.isfinite(rows).all(axis=1))[:1]:
        raise ValueError(f"row {row} of the {name} is {tuple(rows[row].tolist())}; {remedy}")
    return rows


def _values(hits, name):
    return vtk_to_numpy(hits.GetPointData().GetArray(name) if name else hits.GetPoints().GetData())
