// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTracePartSet.h"

#include "Math/Bounds.h"
#include "Math/Matrix.h"

#include <algorithm>
#include <cstddef>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// In the coordinates of the data.
vtkirt::PlacedField Place(vtkIsosurfaceRayTracePart& part)
{
  vtkirt::PlacedField field{};
  field.Source = &part;
  field.SetFromOwn = part.FindPhysicalFromObject();
  field.Box = part.FindBox();
  field.CellSize = part.FindCellSize();
  field.IsOnDemand = part.IsBuiltOnDemand();
  field.IsSeamless = part.IsSeamless();
  return field;
}

bool AreSame(const vtkirt::PlacedField& a, const vtkirt::PlacedField& b)
{
  return a.Source == b.Source && a.SetFromOwn == b.SetFromOwn && a.Box.Lower == b.Box.Lower &&
    a.Box.Upper == b.Box.Upper && a.CellSize == b.CellSize && a.IsOnDemand == b.IsOnDemand;
}

}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePartSet::Join(
  const std::vector<std::unique_ptr<vtkIsosurfaceRayTracePart>>& parts)
{
  using vtkirt::operator-;
  vtkirt::Bounds all = vtkirt::NoBounds();
  std::vector<vtkirt::PlacedField> placed;
  for (const std::unique_ptr<vtkIsosurfaceRayTracePart>& part : parts)
  {
    placed.push_back(Place(*part));
    all = vtkirt::Unite(all, vtkirt::TransformBounds(placed.back().SetFromOwn, placed.back().Box));
  }
  this->Center = vtkirt::GetCenter(all);
  this->CellSize = 0.0;
  for (vtkirt::PlacedField& field : placed)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      field.SetFromOwn[4 * axis + 3] -= this->Center[axis];
    }
    const vtkirt::Vector3 size = field.Box.Upper - field.Box.Lower;
    field.MemoryShare = std::max(
      1e-9, size[0] * size[1] * size[2] / (field.CellSize * field.CellSize * field.CellSize));
    const vtkirt::AffineAxes axes(field.SetFromOwn);
    const double longest = *std::max_element(axes.Lengths.begin(), axes.Lengths.end());
    this->CellSize = std::max(this->CellSize, field.CellSize * longest);
    field.Box = vtkirt::TransformBounds(field.SetFromOwn, field.Box);
  }
  const bool isSame = this->Set &&
    std::equal(placed.begin(), placed.end(), this->Placed.begin(), this->Placed.end(), AreSame);
  if (isSame)
  {
    this->Set->Forget();
    return;
  }
  this->Set = std::make_unique<vtkirt::FieldSet>(placed);
  this->Placed = std::move(placed);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePartSet::Clear()
{
  this->Set.reset();
  this->Placed.clear();
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 vtkIsosurfaceRayTracePartSet::GetPhysicalFromObject() const
{
  return { 1.0, 0.0, 0.0, this->Center[0], 0.0, 1.0, 0.0, this->Center[1], 0.0, 0.0, 1.0,
    this->Center[2], 0.0, 0.0, 0.0, 1.0 };
}

VTK_ABI_NAMESPACE_END
