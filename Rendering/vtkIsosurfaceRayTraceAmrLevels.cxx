// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceAmrLevels.h"

#include "vtkIsosurfaceRayTraceGeometry.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Leaf = vtkIsosurfaceRayTraceLeaf;

/// A thousandth of a cell is less than is visible, and more than the rounding of coordinates that
/// were written as text.
constexpr double Slack = 1e-3;

/// How far a block may reach from the origin, in cells of the coarsest level.
constexpr double Farthest = 0x1p20;

bool AreEqual(const vtkirt::Vector3& a, const vtkirt::Vector3& b)
{
  bool areEqual = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    areEqual = areEqual && std::abs(a[axis] - b[axis]) <= Slack * std::abs(b[axis]);
  }
  return areEqual;
}

bool FindRatio(const vtkirt::Vector3& coarse, const vtkirt::Vector3& fine, vtkirt::Index3& ratio)
{
  bool isWhole = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double exact = coarse[axis] / fine[axis];
    const double whole = std::round(exact);
    isWhole =
      isWhole && whole >= 1.0 && whole <= 1024.0 && std::abs(exact - whole) <= Slack * whole;
    ratio[axis] = isWhole ? static_cast<int>(whole) : 1;
  }
  return isWhole;
}

}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceAmrLevels::GetSpacing(const Leaf& leaf)
{
  vtkirt::Vector3 spacing;
  vtkImageData::SafeDownCast(leaf.Data)->GetSpacing(spacing.data());
  return spacing;
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceAmrLevels::GetCorner(const Leaf& leaf)
{
  auto* image = vtkImageData::SafeDownCast(leaf.Data);
  const int* extent = image->GetExtent();
  const int first[3] = { extent[0], extent[2], extent[4] };
  vtkirt::Vector3 corner;
  image->TransformIndexToPhysicalPoint(first, corner.data());
  return corner;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceAmrLevels::vtkIsosurfaceRayTraceAmrLevels(const std::vector<Leaf>& leaves)
{
  std::vector<vtkirt::Vector3> spacings;
  for (const Leaf& leaf : leaves)
  {
    spacings.push_back(GetSpacing(leaf));
  }
  std::sort(spacings.begin(), spacings.end(), std::greater<>());
  for (const vtkirt::Vector3& spacing : spacings)
  {
    if (!this->Spacings.empty() && AreEqual(spacing, this->Spacings.back()))
    {
      continue;
    }
    vtkirt::Index3 ratio = { 1, 1, 1 };
    if (this->Spacings.empty() || FindRatio(this->Spacings.back(), spacing, ratio))
    {
      this->Spacings.push_back(spacing);
      this->Ratios.push_back(ratio);
    }
  }
  const auto coarsest = std::find_if(leaves.begin(), leaves.end(),
    [this](const Leaf& leaf) { return AreEqual(GetSpacing(leaf), this->Spacings.front()); });
  this->Origin = GetCorner(*coarsest);
  this->LeaveOutTooFine(leaves);
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceAmrLevels::Place(const Leaf& leaf, vtkirt::AmrPatch& patch) const
{
  auto* image = vtkImageData::SafeDownCast(leaf.Data);
  if (!image->GetDirectionMatrix()->IsIdentity())
  {
    return "It has a direction matrix. Give blocks of AMR data along the axes.";
  }
  const vtkirt::Vector3 spacing = GetSpacing(leaf);
  const auto level = std::find_if(this->Spacings.begin(), this->Spacings.end(),
    [&spacing](const vtkirt::Vector3& ofLevel) { return AreEqual(spacing, ofLevel); });
  if (level == this->Spacings.end())
  {
    return "Its spacing is not a whole part of that of the next coarser level.";
  }
  patch.Level = static_cast<int>(level - this->Spacings.begin());
  if (level - this->Spacings.begin() >= static_cast<std::ptrdiff_t>(this->Ratios.size()))
  {
    return "Its cells are too small: the whole data have more than 2^29 of them along an axis.";
  }
  if (!(this->FindReach(leaf) <= Farthest))
  {
    return "It lies more than a million cells of the coarsest level away from the first block "
           "there.";
  }
  const vtkirt::Vector3 corner = GetCorner(leaf);
  const vtkirt::Index3 points = vtkIsosurfaceRayTraceGeometry::GetDimensions(image);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double place = (corner[axis] - this->Origin[axis]) / (*level)[axis];
    const double whole = std::round(place);
    if (!(std::abs(place - whole) <= Slack))
    {
      return "It does not lie on the lattice of its level: its origin is not a whole number of "
             "cells from that of the coarsest level.";
    }
    patch.First[axis] = static_cast<int>(whole);
    patch.Cells[axis] = points[axis] - 1;
  }
  return "";
}

//------------------------------------------------------------------------------
/// How far a block reaches from the origin, in cells of the coarsest level.
double vtkIsosurfaceRayTraceAmrLevels::FindReach(const Leaf& leaf) const
{
  const vtkirt::Vector3 corner = GetCorner(leaf);
  const vtkirt::Vector3 spacing = GetSpacing(leaf);
  const vtkirt::Index3 points = vtkIsosurfaceRayTraceGeometry::GetDimensions(leaf.Data);
  double reach = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    reach = std::max(reach,
      (std::abs(corner[axis] - this->Origin[axis]) + points[axis] * spacing[axis]) /
        this->Spacings.front()[axis]);
  }
  return reach;
}

//------------------------------------------------------------------------------
/// Places are counted in cells of all levels, and in halves of them.
void vtkIsosurfaceRayTraceAmrLevels::LeaveOutTooFine(const std::vector<Leaf>& leaves)
{
  double reach = 0.0;
  for (const Leaf& leaf : leaves)
  {
    const double ofLeaf = this->FindReach(leaf);
    reach = ofLeaf <= Farthest ? std::max(reach, ofLeaf) : reach;
  }
  vtkirt::Vector3 count = { reach, reach, reach };
  std::size_t level = 0;
  for (; level < this->Ratios.size(); ++level)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      count[axis] *= this->Ratios[level][axis];
    }
    if (!(std::max({ count[0], count[1], count[2] }) < 0x1p29))
    {
      break;
    }
  }
  this->Ratios.resize(level);
}

VTK_ABI_NAMESPACE_END
