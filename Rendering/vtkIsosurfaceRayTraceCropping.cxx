// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceCropping.h"

#include "vtkIsosurfaceRayTraceGeometry.h"

#include "vtkVolumeMapper.h"

#include <array>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace vtkIsosurfaceRayTraceCropping
{
namespace
{

/// The flags of the 27 regions with their order along an axis reversed.
unsigned int Reverse(unsigned int regions, std::size_t axis)
{
  constexpr int strides[3] = { 1, 3, 9 };
  unsigned int reversed = 0;
  for (int region = 0; region < 27; ++region)
  {
    const int interval = region / strides[axis] % 3;
    const int other = region + (2 - 2 * interval) * strides[axis];
    reversed |= (regions >> region & 1U) << other;
  }
  return reversed;
}

}

//------------------------------------------------------------------------------
std::string FindProblem(vtkVolumeMapper* mapper)
{
  const double* planes = mapper->GetCroppingRegionPlanes();
  const bool isOrdered = planes[0] <= planes[1] && planes[2] <= planes[3] && planes[4] <= planes[5];
  return mapper->GetCropping() == 0 || isOrdered
    ? ""
    : "Cropping is on, but a lower one of CroppingRegionPlanes (xmin, xmax, ymin, ymax, zmin, "
      "zmax) is greater than the upper one, or one of them is NaN. Call SetCroppingRegionPlanes "
      "with numbers in order.";
}

//------------------------------------------------------------------------------
void Apply(vtkVolumeMapper* mapper, const vtkIsosurfaceRayTraceGeometry& geometry,
  vtkirt::Visibility& visibility)
{
  if (mapper->GetCropping() == 0)
  {
    return;
  }
  const double* planes = mapper->GetCroppingRegionPlanes();
  auto regions = static_cast<unsigned int>(mapper->GetCroppingRegionFlags());
  std::array<std::array<double, 2>, 3> between;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    between[axis] = { geometry.GetIndex(axis, planes[2 * axis]),
      geometry.GetIndex(axis, planes[2 * axis + 1]) };
    // Spacing may be negative.
    if (between[axis][0] > between[axis][1])
    {
      std::swap(between[axis][0], between[axis][1]);
      regions = Reverse(regions, axis);
    }
  }
  if (regions != VTK_CROP_SUBVOLUME)
  {
    visibility.Regions = { between, regions };
    return;
  }
  // Rays are cut to a box, which is faster than testing every hit.
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    vtkirt::Vector3 normal = { 0.0, 0.0, 0.0 };
    normal[axis] = 1.0;
    visibility.HalfSpaces.push_back({ normal, -between[axis][0] });
    normal[axis] = -1.0;
    visibility.HalfSpaces.push_back({ normal, between[axis][1] });
  }
}

}

VTK_ABI_NAMESPACE_END
