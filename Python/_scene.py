# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Several surfaces in one picture."""

import difflib

from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkVolume

from ._alike import check_alike, name_one_array
from ._surface import isosurface
from .vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper, vtkIsosurfaceVolume


def to_volume(surfaces, isovalues, options):
    """The one that is drawn, of data and isovalues, of a volume, or of a list of volumes."""
    volumes = surfaces if isinstance(surfaces, (list, tuple)) else [surfaces]
    if not volumes or not all(isinstance(volume, vtkVolume) for volume in volumes):
        if volumes is not surfaces:
            _check_names(options)
            return isosurface(surfaces, isovalues, **options)
        raise TypeError("several surfaces are a list of what isosurface() returns; give numbers as a numpy array")
    if options or not isinstance(isovalues, str):
        raise TypeError(f"{', '.join(options) or 'isovalues'} cannot be given for volumes; give it to each isosurface(), or set "
                        "it in their properties and mappers")
    for volume in volumes:
        if not isinstance(volume.GetMapper(), (vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper)):
            raise TypeError("a volume is one of isosurface(), or has a mapper of this package")
    visible = [volume for volume in volumes if volume.GetVisibility()]
    if not visible:
        raise ValueError("no volume is visible; call VisibilityOn() of what is to be seen")
    return visible[0] if len(visible) == 1 else _join(visible)


def _check_names(options):
    known = isosurface.__kwdefaults__
    for name in options:
        if name not in known:
            near = difflib.get_close_matches(name, [*known, "isovalues"], 1)
            raise TypeError(f"there is no option {name}" + (f"; did you mean {near[0]}?" if near else f"; there are "
                                                            f"{', '.join(known)}"))


def _join(volumes):
    """A volume of which those of a list are the connections: translucent surfaces pass through each other."""
    mappers = [volume.GetMapper() for volume in volumes]
    check_alike(mappers)
    # One of images draws meshes too.
    first = next((each for each in mappers if isinstance(each, vtkIsosurfaceRayTraceMapper)), mappers[0])
    mapper = first.NewInstance()
    mapper.ShallowCopy(first)
    mapper.RemoveAllInputConnections(0)
    if not name_one_array(mappers):
        mapper.SetScalarModeToDefault()
    for volume in volumes:
        _connect(volume, mapper)
    mapper.SetShadows(any(each.GetShadows() for each in mappers))
    mapper.SetAmbientOcclusion(any(each.GetAmbientOcclusion() for each in mappers))
    mapper.SetAmbientOcclusionRadius(max(each.GetAmbientOcclusionRadius() for each in mappers))
    mapper.SetNumberOfAmbientOcclusionRays(
        max((each.GetNumberOfAmbientOcclusionRays() for each in mappers if each.GetAmbientOcclusion()), default=1))
    samples = max(_count_samples(each) for each in mappers)
    mapper.SetProgressiveAccumulation(samples > 1)
    mapper.SetMaximumNumberOfAccumulatedFrames(samples)
    joined = vtkIsosurfaceVolume()
    joined.SetMapper(mapper)
    return joined


def _connect(volume, mapper):
    """Have a mapper draw what another volume draws."""
    own = volume.GetMapper()
    count = own.GetNumberOfInputConnections(0)
    if count == 0:
        raise ValueError("a volume has no input; give its mapper one, or leave the volume out")
    for i in range(count):
        part = own.GetConnectionVolume(i)
        mapper.SetConnectionVolume(mapper.GetNumberOfInputConnections(0), _place(part, volume) if part else volume)
        mapper.AddInputConnection(0, own.GetInputConnection(0, i))


def _place(part, volume):
    """The volume of a connection, whose matrix leads to the coordinates of another volume, in the world."""
    for each in (part, volume):
        each.ComputeMatrix()
    matrix = vtkMatrix4x4()
    vtkMatrix4x4.Multiply4x4(volume.GetMatrix(), part.GetMatrix(), matrix)
    placed = vtkVolume()
    placed.SetProperty(part.GetProperty())
    placed.SetUserMatrix(matrix)
    placed.SetVisibility(part.GetVisibility())
    return placed


def _count_samples(mapper):
    return mapper.GetMaximumNumberOfAccumulatedFrames() if mapper.GetProgressiveAccumulation() else 1
