// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceBlock.h"

#include "vtkIsosurfaceRayTraceGeometry.h"
#include "vtkIsosurfaceRayTraceGhosts.h"

#include "vtkUnsignedCharArray.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
vtkirt::Index3 vtkIsosurfaceRayTraceBlock::GetPoints() const
{
  return vtkIsosurfaceRayTraceGeometry::GetDimensions(this->Data);
}

//------------------------------------------------------------------------------
vtkirt::Index3 vtkIsosurfaceRayTraceBlock::GetCells() const
{
  return vtkIsosurfaceRayTraceBlock::Subtract(this->GetPoints(), { 1, 1, 1 });
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceBlock::Shows(const vtkirt::Index3& cell, int hiding) const
{
  if (!vtkIsosurfaceRayTraceBlock::Contains(this->GetCells(), cell))
  {
    return false;
  }
  vtkUnsignedCharArray* ofCells = this->Data->GetCellGhostArray();
  vtkUnsignedCharArray* ofPoints = this->Data->GetPointGhostArray();
  if (ofCells &&
    (ofCells->GetValue(static_cast<vtkIdType>(vtkirt::Offset(cell, this->GetCells()))) & hiding) !=
      0)
  {
    return false;
  }
  return !ofPoints ||
    !vtkIsosurfaceRayTraceGhosts::HasAtCorner(
      ofPoints->GetPointer(0), cell, this->GetPoints(), vtkIsosurfaceRayTraceGhosts::HiddenPoint);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceBlock::GetCellId(const vtkirt::Index3& cell) const
{
  return static_cast<vtkIdType>(
    vtkirt::Offset(vtkIsosurfaceRayTraceBlock::Subtract(cell, this->First), this->GetCells()));
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceBlock::GetPointId(const vtkirt::Index3& point) const
{
  return static_cast<vtkIdType>(
    vtkirt::Offset(vtkIsosurfaceRayTraceBlock::Subtract(point, this->First), this->GetPoints()));
}

VTK_ABI_NAMESPACE_END
