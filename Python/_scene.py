# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Several surfaces in one picture."""

from vtkmodules.vtkRenderingCore import vtkVolume

from ._surface import isosurface
from .vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper, vtkIsosurfaceVolume

# What a mapper has once for all that it draws.
COMMON = ("InterpolationMode", "ScalarMode", "ArrayName", "VectorMode", "ColorArrayName", "CapClippingPlanes")


def to_volume(surfaces, isovalues, options):
    """The one that is drawn, of data and isovalues, of a volume, or of a list of volumes."""
    volumes = surfaces if isinstance(surfaces, (list, tuple)) else [surfaces]
    if not volumes or not all(isinstance(volume, vtkVolume) for volume in volumes):
        if volumes is not surfaces:
            return isosurface(surfaces, isovalues, **options)
        raise TypeError("several surfaces are a list of what isosurface() returns; give numbers as a numpy array")
    if options or not isinstance(isovalues, str):
        raise TypeError(f"{', '.join(options) or 'isovalues'} cannot be given here: isosurface() has taken them")
    for volume in volumes:
        if not isinstance(volume.GetMapper(), (vtkIsosurfaceRayTraceMapper, vtkIsosurfaceRayTraceMeshMapper)):
            raise TypeError("a volume is one of isosurface(), or has a vtkIsosurfaceRayTraceMapper")
    return volumes[0] if len(volumes) == 1 else _join(volumes)


def _join(volumes):
    """A volume of which those of a list are the connections: translucent surfaces pass through each other."""
    mappers = [volume.GetMapper() for volume in volumes]
    _check_alike(mappers)
    # One of images draws meshes too.
    first = next((each for each in mappers if isinstance(each, vtkIsosurfaceRayTraceMapper)), mappers[0])
    mapper = first.NewInstance()
    mapper.ShallowCopy(first)
    mapper.RemoveAllInputConnections(0)
    for i, volume in enumerate(volumes):
        mapper.AddInputConnection(0, mappers[i].GetInputConnection(0, 0))
        mapper.SetConnectionVolume(i, volume)
    mapper.SetShadows(any(each.GetShadows() for each in mappers))
    mapper.SetAmbientOcclusion(any(each.GetAmbientOcclusion() for each in mappers))
    mapper.SetAmbientOcclusionRadius(max(each.GetAmbientOcclusionRadius() for each in mappers))
    joined = vtkIsosurfaceVolume()
    joined.SetMapper(mapper)
    return joined


def _check_alike(mappers):
    for name in COMMON:
        values = {getattr(mapper, f"Get{name}")() for mapper in mappers if hasattr(mapper, f"Get{name}")}
        if len(values) > 1:
            raise ValueError(f"surfaces in one picture cannot differ in {name} of their mappers: {values}")
    if len({_describe_planes(mapper) for mapper in mappers}) > 1:
        raise ValueError("surfaces in one picture are clipped alike; give all the same clip")


def _describe_planes(mapper):
    planes = mapper.GetClippingPlanes()
    planes = [planes.GetItem(i) for i in range(planes.GetNumberOfItems())] if planes else []
    return tuple((plane.GetOrigin(), plane.GetNormal()) for plane in planes)
