# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a mapper has once for all that it draws: surfaces in one picture have it in common."""

from vtkmodules.vtkCommonDataModel import vtkDataSet

from .vtkIsosurfaceRayTracing import vtkCellProjectionMapper, vtkIsosurfaceRayTraceMapper

# Of vtkAbstractMapper, whose wrappers do not have them.
DEFAULT, USE_POINT_FIELD_DATA, USE_CELL_FIELD_DATA = 0, 3, 4
BY_NAME = 1

SETTINGS = (
    "InterpolationMode", "RootSolver", "NumberOfInterpolations", "NormalMode", "VectorMode", "VectorComponent",
    "CompositeDataDisplayAttributes", "CapClippingPlanes", "DrawIsosurfaces")  # fmt: skip


def name_one_array(mappers):
    """Whether all trace the array of one name, or all that of none."""
    return len({(each.GetScalarMode(), each.GetArrayAccessMode(), each.GetArrayId(), each.GetArrayName())
                for each in mappers}) == 1


def _trace_active_arrays(mapper):
    mapper.Update()
    inputs = [mapper.GetInputDataObject(0, i) for i in range(mapper.GetNumberOfInputConnections(0))]
    return mapper.GetScalarMode() == DEFAULT or all(_is_active(mapper, data) for data in inputs)


def _is_active(mapper, data):
    if not isinstance(data, vtkDataSet) or mapper.GetArrayAccessMode() != BY_NAME:
        return False
    of_points, of_cells = data.GetPointData().GetScalars(), data.GetCellData().GetScalars()
    active = {USE_POINT_FIELD_DATA: of_points, USE_CELL_FIELD_DATA: None if of_points else of_cells}.get(mapper.GetScalarMode())
    return active is not None and active.GetName() == mapper.GetArrayName()


def check_alike(mappers):
    for name in SETTINGS:
        if len({getattr(mapper, f"Get{name}")() for mapper in mappers if hasattr(mapper, f"Get{name}")}) > 1:
            raise ValueError(f"surfaces in one picture cannot differ in {name} of their mappers; set it alike, or make "
                             "several pictures")
    if not name_one_array(mappers) and not all(map(_trace_active_arrays, mappers)):
        raise ValueError("surfaces in one picture are of arrays with one name, or of those that are active; make the arrays "
                         "active, or make several pictures")
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


def _find_color_array(mapper):
    return mapper.GetColorArrayName()


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
    (_find_color_array, "coloured by arrays of one name, all of them, or by none; give all a color_by of numpy, which may be "
                        "of one colour (unsigned char)"),
    (_find_color_image, "coloured by one image, all of them, or by none; give all the same color_by, or make several "
                        "pictures"),
    (_find_projection, "not beside a projection (SetBlendMode of a mapper); make several pictures"),
    (_is_cloud, "not beside a cloud (vtkCellProjectionMapper), but for those of its own mesh (DrawIsosurfacesOn of its "
                "mapper); make several pictures"),
    (_is_tetrahedralized, "all tetrahedralized or none, and images are not; call TetrahedralizeOff of the mappers"),
)  # fmt: skip
