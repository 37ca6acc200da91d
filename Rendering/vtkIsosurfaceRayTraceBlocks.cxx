// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceBlocks.h"

#include "vtkIsosurfaceRayTraceBlockJoin.h"
#include "vtkIsosurfaceRayTraceGhosts.h"
#include "vtkIsosurfaceRayTraceLattices.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstddef>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Block = vtkIsosurfaceRayTraceBlock;

}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlocks::Update(
  const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves, bool ofCells)
{
  this->Blocks.resize(leaves.size());
  // New blocks may have the addresses of old ones: modification times tell them apart.
  std::vector<vtkMTimeType> times;
  for (std::size_t i = 0; i < this->Blocks.size(); ++i)
  {
    // The index is kept: it is found again only if something has changed.
    static_cast<vtkIsosurfaceRayTraceLeaf&>(this->Blocks[i]) = leaves[i];
    const Block& block = this->Blocks[i];
    times.push_back(block.Data->GetMTime());
    times.push_back(block.Scalars->GetMTime());
    times.push_back(block.Colors ? block.Colors->GetMTime() : 0);
  }
  const bool isSame = this->Grid && times == this->Times && ofCells == this->OfCells;
  if (this->Blocks.size() == 1)
  {
    Block& block = this->Blocks.front();
    block.First = { 0, 0, 0 };
    this->Dimensions = block.GetPoints();
    this->Grid = block.Data;
    this->Scalars = block.Scalars;
    this->Colors = block.Colors;
  }
  else if (!isSame)
  {
    this->Grid = nullptr; // Its memory first.
    this->Scalars = nullptr;
    this->Colors = nullptr;
    this->Times.clear();
    this->OfCells = ofCells;
    this->PlaceBlocks();
    this->Join();
  }
  this->OfCells = ofCells;
  this->Times = std::move(times);
}

//------------------------------------------------------------------------------
/// Finds the indices of the blocks on the lattice of the first.
void vtkIsosurfaceRayTraceBlocks::PlaceBlocks()
{
  auto* lattice = vtkImageData::SafeDownCast(this->Blocks[0].Data);
  vtkirt::Index3 low = { VTK_INT_MAX, VTK_INT_MAX, VTK_INT_MAX };
  vtkirt::Index3 high = { VTK_INT_MIN, VTK_INT_MIN, VTK_INT_MIN };
  for (Block& block : this->Blocks)
  {
    vtkIsosurfaceRayTraceLattices::FindFirstPoint(
      lattice, vtkImageData::SafeDownCast(block.Data), block.First);
    const vtkirt::Index3 points = block.GetPoints();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], block.First[axis]);
      high[axis] = std::max(high[axis], block.First[axis] + points[axis]);
    }
  }
  std::vector<vtkirt::Bounds> boxes;
  for (Block& block : this->Blocks)
  {
    block.First = Block::Subtract(block.First, low);
    vtkirt::Bounds box;
    const vtkirt::Index3 points = block.GetPoints();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.Lower[axis] = block.First[axis];
      box.Upper[axis] = block.First[axis] + points[axis] - 1;
    }
    boxes.push_back(box);
  }
  this->Tree = std::make_unique<vtkirt::BoundsTree>(boxes);
  this->Dimensions = Block::Subtract(high, low);

  vtkNew<vtkImageData> image;
  image->SetExtent(low[0], high[0] - 1, low[1], high[1] - 1, low[2], high[2] - 1);
  image->SetSpacing(lattice->GetSpacing());
  image->SetOrigin(lattice->GetOrigin());
  image->SetDirectionMatrix(lattice->GetDirectionMatrix());
  this->Grid = image;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlocks::Join()
{
  auto* image = vtkImageData::SafeDownCast(this->Grid);
  const vtkIsosurfaceRayTraceBlockJoin join(this->Blocks, this->Dimensions, this->OfCells);
  this->Scalars = join.JoinScalars();
  if (this->OfCells)
  {
    image->GetCellData()->AddArray(this->Scalars);
  }
  else
  {
    image->GetPointData()->AddArray(this->Scalars);
  }
  if (this->Blocks.front().Colors)
  {
    const bool areScalars = std::all_of(this->Blocks.begin(), this->Blocks.end(),
      [](const Block& block) { return block.Colors == block.Scalars; });
    this->Colors = areScalars ? this->Scalars : join.JoinColors();
  }
  join.HideMissingCells(image);
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceBlock& vtkIsosurfaceRayTraceBlocks::FindOwner(
  const vtkirt::Index3& cell) const
{
  if (this->Blocks.size() == 1)
  {
    return this->Blocks.front();
  }
  // The block that shows it; for cells that are duplicates everywhere, any. Of several, the first.
  std::size_t owner = this->Blocks.size();
  for (const int hiding :
    { vtkIsosurfaceRayTraceGhosts::Blanked | vtkIsosurfaceRayTraceGhosts::Duplicate,
      vtkIsosurfaceRayTraceGhosts::Blanked })
  {
    this->Tree->Find(
      [&cell](const vtkirt::Bounds& box)
      {
        bool isIn = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          isIn = isIn && box.Lower[axis] <= cell[axis] && cell[axis] < box.Upper[axis];
        }
        return isIn;
      },
      [&](std::size_t number)
      {
        const Block& block = this->Blocks[number];
        if (number < owner && block.Shows(Block::Subtract(cell, block.First), hiding))
        {
          owner = number;
        }
      });
    if (owner < this->Blocks.size())
    {
      return this->Blocks[owner];
    }
  }
  return this->Blocks.front();
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceBlocks::GetCellId(const vtkirt::Index3& cell) const
{
  const Block& block = this->FindOwner(cell);
  return block.FirstCell + block.GetCellId(cell);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceBlocks::GetPointId(
  const vtkirt::Index3& cell, const vtkirt::Index3& point) const
{
  const Block& block = this->FindOwner(cell);
  return block.FirstPoint + block.GetPointId(point);
}

VTK_ABI_NAMESPACE_END
