# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a mapper has once for all that it draws: surfaces in one picture have it in common."""

from .vtkIsosurfaceRayTracing import vtkCellProjectionMapper, vtkIsosurfaceRayTraceMapper

SETTINGS = (
    "InterpolationMode", "RootSolver", "NumberOfInterpolations", "NormalMode", "ScalarMode", "ArrayAccessMode",
    "ArrayId", "ArrayName", "VectorMode", "VectorComponent", "ColorArrayName", "CompositeDataDisplayAttributes",
    "CapClippingPlanes", "DrawIsosurfaces")  # fmt: skip


def check_alike(mappers):
    for name in SETTINGS:
        if len({getattr(mapper, f"Get{name}")() for mapper in mappers if hasattr(mapper, f"Get{name}")}) > 1:
            raise ValueError(f"surfaces in one picture cannot differ in {name} of their mappers; set it alike, or make "
                             "several pictures")
    for find, rule in RULES:
        if len(set(map(find, mappers))) > 1:
            raise ValueError(f"surfaces in one picture are {rule}")


def _find_planes(mapper):
    planes = mapper.GetClippingPlanes()
    planes = [planes.GetItem(i) for i in range(planes.GetNumberOfItems())] if planes else []
    return tuple((plane.GetOrigin(), plane.GetNormal()) for plane in planes)


def _find_cropping(mapper):
    """None for meshes, which are not cropped."""
    is_cropped = isinstance(mapper, vtkIsosurfaceRayTraceMapper) and mapper.GetCropping()
    return (mapper.GetCroppingRegionPlanes(), mapper.GetCroppingRegionFlags()) if is_cropped else None


def _find_color_image(mapper):
    return mapper.GetInputDataObject(1, 0) if isinstance(mapper, vtkIsosurfaceRayTraceMapper) else None


def _find_projection(mapper):
    """None where surfaces are drawn. Those of meshes are, whatever the blend mode is, but not clouds."""
    images = vtkIsosurfaceRayTraceMapper
    has_projections = isinstance(mapper, (images, vtkCellProjectionMapper))
    is_projection = mapper.GetBlendMode() in (images.MAXIMUM_INTENSITY_BLEND, images.MINIMUM_INTENSITY_BLEND)
    return mapper.GetBlendMode() if has_projections and is_projection else None


def _is_cloud(mapper):
    return isinstance(mapper, vtkCellProjectionMapper)


def _is_tetrahedralized(mapper):
    return not isinstance(mapper, vtkIsosurfaceRayTraceMapper) and bool(mapper.GetTetrahedralize())


RULES = (
    (_find_planes, "clipped alike; give all the same clip"),
    (_find_cropping, "cropped alike, and meshes are not; clip all instead, or make several pictures"),
    (_find_color_image, "coloured by one image, all of them, or by none; give all the same color_by, or make several "
                        "pictures"),
    (_find_projection, "not beside a projection (SetBlendMode of a mapper); make several pictures"),
    (_is_cloud, "not beside a cloud (vtkCellProjectionMapper), but for those of its own mesh (DrawIsosurfacesOn of its "
                "mapper); make several pictures"),
    (_is_tetrahedralized, "all tetrahedralized or none, and images are not; call TetrahedralizeOff of the mappers"),
)  # fmt: skip
