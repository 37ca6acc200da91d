# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Isosurfaces as a prop of VTK."""

from __future__ import annotations

import numbers
from typing import Any, Sequence

import numpy as np

from ._clipping import to_planes
from ._coloring import color_by as apply_color_by
from ._coloring import to_limits
from ._data import MESHES, grids_of, to_data
from ._isovalues import choose_isovalues
from ._property import color_slices, make_property
from ._scalars import Scalars
from .vtkIsosurfaceRayTracing import (
    vtkIsosurfaceRayTraceMapper,
    vtkIsosurfaceRayTraceMeshMapper,
    vtkIsosurfaceVolume,
)

INTERPOLATIONS = {
    "linear": vtkIsosurfaceRayTraceMapper.TRILINEAR,
    "nearest": vtkIsosurfaceRayTraceMapper.NEAREST,
    "cubic": vtkIsosurfaceRayTraceMapper.CUBIC,
}


def isosurface(
    data: Any,
    isovalues: float | Sequence[float] | str = "auto",
    *,
    scalars: str | None = None,
    color: Any = None,
    opacity: float | Sequence[float] | None = None,
    color_by: Any = None,
    cmap: Any = "viridis",
    clim: tuple[float, float] | None = None,
    clip: Any = None,
    caps: Any = "gray",
    shadows: bool = False,
    occlusion: bool = False,
    interpolation: str = "linear",
    samples: int = 8,
    spacing: Any = None,
    origin: Any = None,
    direction: Any = None,
) -> vtkIsosurfaceVolume:
    """Isosurfaces, for a renderer of VTK, a plotter of PyVista, or ``render`` and ``show``.

    Parameters
    ----------
    data : numpy.ndarray, vtkDataObject, str or os.PathLike
        The samples: an array with the axes x, y and z (give ``array.T`` if they are z, y and x), a vtkImageData, a
        vtkRectilinearGrid, a vtkStructuredGrid, a vtkUnstructuredGrid, composite data of these, which PyVista's are too; or a
        path that ``read`` reads. Arrays are not copied if VTK can use their memory: make the isosurfaces again after a change
        of the array.
    isovalues : float, sequence of float or "auto"
        "auto" is the threshold that best separates the values into two classes (Otsu's method).
    scalars : str, optional
        The name of the point or cell array. Without it, the active array is used. For vectors, the magnitude is used.
    color : colour or list of colours, optional
        A CSS colour name, "#rrggbb", or red, green and blue from 0 to 1: one for all isovalues or one for each. Without it,
        ivory; for several isovalues, colours from blue to ivory.
    opacity : float or sequence of float, optional
        From 0 to 1, one for all isovalues or one for each. Without it, the surface of the largest isovalue is opaque,
        and the others have an opacity of 0.35.
    color_by : str, numpy.ndarray or vtkImageData, optional
        What colours the surfaces instead of ``color``: the name of another array of the data, a numpy array with a value for
        each sample, or an image of any resolution. Arrays of unsigned char with 3 or 4 components are colours; for other
        vectors, the magnitude is used.
    cmap : str, list of colours or callable
        The colours of ``color_by``: "viridis", "coolwarm", "gray", "inferno", a colour map of matplotlib or its name, or a list
        of colours, which are interpolated.
    clim : pair of float, optional
        The values at the two ends of ``cmap`` or, without ``color_by``, of the colours of ``caps``. Without them, the
        range of the array; for ``caps``, from the smallest isovalue to the 99th percentile of the values above it.
    clip : normal, (point, normal), vtkPlane, or list of these, optional
        Planes that cut the surfaces. The side to which the normal points is kept. The normal is a vector or an axis ("x",
        "-z"). Without a point, the plane goes through the centre of the data.
    caps : bool, None or colour map
        Whether cuts are closed; without ``color_by``, also the colour map of the data on them. True gives caps the colour of
        the surface, and None is the same as False.
    shadows, occlusion : bool
        Whether the surfaces cast shadows on each other, and whether they occlude ambient light within a quarter of the diagonal
        of the data (ambient occlusion). Occlusion uses four rays for each of the ``samples``: with few samples, pictures are
        noisy. Both take more time.
    interpolation : {"linear", "cubic", "nearest"}
        The interpolation between samples. In meshes, the cells determine it.
    samples : int
        The number of rays for a pixel in a still picture, from 1 to 256, for anti-aliasing.
    spacing, origin, direction : array_like, optional
        For a numpy array: the distances between samples, the position of the first sample, and the axes as the columns of a
        matrix.

    Returns
    -------
    vtkIsosurfaceVolume
        A vtkVolume; all other settings are in its property and its mapper.

    Raises
    ------
    TypeError, ValueError
        Something cannot be drawn; the message says what to give instead.

    Examples
    --------
    >>> plotter = pyvista.Plotter()
    >>> plotter.add_actor(isosurface(grid, [0.2, 0.8]))
    """
    if caps is None or isinstance(caps, np.bool_):
        caps = bool(caps)
    _check_use(color_by, cmap, clim, clip, caps)
    data = to_data(data, spacing, origin, direction)
    of_data = Scalars(data, scalars)
    chosen = choose_isovalues(isovalues, of_data)
    surface = make_property(chosen, color, opacity, shadows, occlusion)
    mapper = _make_mapper(data, interpolation)
    data = of_data.select(mapper, data)
    planes = to_planes(clip, _center_of(data))
    for plane in planes:
        mapper.AddClippingPlane(plane)
    mapper.SetCapClippingPlanes(bool(planes) and caps is not False)
    if color_by is not None:
        data = apply_color_by(mapper, surface, data, color_by, cmap, clim)
    elif planes and not isinstance(caps, bool):
        low = min(chosen)
        color_slices(surface, caps, *((low, of_data.high_value(low)) if clim is None else to_limits(clim)))
    mapper.SetInputDataObject(data)
    _set_light(mapper, shadows, occlusion, 0.25 * _length_of(data))
    _set_sampling(mapper, samples)
    volume = vtkIsosurfaceVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(surface)
    return volume


def _check_use(color_by, cmap, clim, clip, caps):
    """What is given must have an effect."""
    defaults = isosurface.__kwdefaults__
    if color_by is None and cmap is not defaults["cmap"]:
        raise ValueError("cmap is for color_by; give that, too (color is for surfaces, caps for cuts)")
    if clip is None and caps is not False and caps is not defaults["caps"]:
        raise ValueError("caps are on the cuts of clip; give that, too")
    if color_by is not None and not isinstance(caps, bool) and caps is not defaults["caps"]:
        raise ValueError("with color_by, cuts have the colours of cmap; leave caps out, or give True or False")
    if clim is not None and color_by is None and (clip is None or isinstance(caps, bool)):
        raise ValueError("clim is for color_by, or for the data on the cuts of clip; give one of these, too")


def _make_mapper(data, interpolation):
    if not isinstance(interpolation, str) or interpolation not in INTERPOLATIONS:
        raise ValueError(f"interpolation is {interpolation!r}; give one of {', '.join(map(repr, INTERPOLATIONS))}")
    if interpolation != "linear" and all(isinstance(grid, MESHES) for grid in grids_of(data)):
        raise ValueError("in meshes, values are interpolated by their cells; leave interpolation out")
    if isinstance(data, MESHES):
        return vtkIsosurfaceRayTraceMeshMapper()
    mapper = vtkIsosurfaceRayTraceMapper()
    mapper.SetInterpolationMode(INTERPOLATIONS[interpolation])
    mapper.LevelOfDetailOn()  # in windows, as long as the mouse moves
    return mapper


def _set_light(mapper, shadows, occlusion, radius):
    mapper.SetShadows(bool(shadows))
    mapper.SetAmbientOcclusion(bool(occlusion))
    mapper.SetNumberOfAmbientOcclusionRays(4)  # of each ray of a pixel
    mapper.SetAmbientOcclusionRadius(radius)


def _set_sampling(mapper, samples):
    """Many rays for a pixel where the picture rests, and four in each frame of a window if there is the time."""
    if not isinstance(samples, numbers.Integral) or not 1 <= samples <= 256:
        raise ValueError(f"samples is {samples!r}; give a whole number from 1 to 256")
    mapper.SetProgressiveAccumulation(samples > 1)
    mapper.SetMaximumNumberOfAccumulatedFrames(samples)
    mapper.SetMinimumImageSampleDistance(0.5 if samples > 1 else 1.0)


def _bounds_of(data):
    bounds = [0.0] * 6
    data.GetBounds(bounds)
    return np.reshape(bounds, (3, 2))


def _center_of(data):
    return _bounds_of(data).mean(axis=1)


def _length_of(data):
    return float(np.linalg.norm(np.ptp(_bounds_of(data), axis=1)))
