// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceBlocks.h"

#include "vtkIsosurfaceRayTraceBlockJoin.h"
#include "vtkIsosurfaceRayTraceGeometry.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Block = vtkIsosurfaceRayTraceBlock;

bool IsGrid(vtkDataSet* data)
{
  return vtkImageData::SafeDownCast(data) || vtkRectilinearGrid::SafeDownCast(data);
}

bool HasVolume(vtkDataSet* grid)
{
  const vtkirt::Index3 points = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  return std::min({ points[0], points[1], points[2] }) >= 2;
}

/// The index of a block's first point on the lattice of an image. Returns false if the block lies
/// on another lattice.
bool FindFirstPoint(vtkImageData* lattice, vtkImageData* block, vtkirt::Index3& first)
{
  // If four corners are on lattice points, all points are. A thousandth of a cell is less than is
  // visible, and more than the rounding of coordinates that were written as text.
  constexpr double slack = 1e-3;
  const int* extent = block->GetExtent();
  for (int corner = 0; corner < 4; ++corner)
  {
    vtkirt::Index3 offset = { 0, 0, 0 };
    vtkirt::Index3 index = { extent[0], extent[2], extent[4] };
    if (corner > 0)
    {
      const auto axis = static_cast<std::size_t>(corner - 1);
      offset[axis] = extent[2 * axis + 1] - extent[2 * axis];
      index = Block::Add(index, offset);
    }
    vtkirt::Vector3 point;
    vtkirt::Vector3 position;
    block->TransformIndexToPhysicalPoint(index.data(), point.data());
    lattice->TransformPhysicalPointToContinuousIndex(point.data(), position.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double whole = std::round(position[axis]);
      if (!(std::abs(position[axis] - whole) <= slack) || !(std::abs(whole) < 0x1p30))
      {
        return false;
      }
      if (corner == 0)
      {
        first[axis] = static_cast<int>(whole);
      }
      else if (static_cast<int>(whole) != first[axis] + offset[axis])
      {
        return false;
      }
    }
  }
  return true;
}

}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceBlocks::Update(
  vtkCompositeDataSet* input, vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName)
{
  std::string problem = this->Leaves.Collect(input, mapper, colorArrayName,
    { IsGrid, HasVolume, "vtkImageData, or one vtkRectilinearGrid" });
  if (!problem.empty())
  {
    this->Times.clear();
    return problem;
  }
  this->Blocks.resize(this->Leaves.Get().size());
  for (std::size_t i = 0; i < this->Blocks.size(); ++i)
  {
    // The index is kept: it is found again only if something has changed.
    static_cast<vtkIsosurfaceRayTraceLeaf&>(this->Blocks[i]) = this->Leaves.Get()[i];
  }
  // New blocks may have the addresses of old ones: modification times tell them apart.
  std::vector<vtkMTimeType> times;
  for (const Block& block : this->Blocks)
  {
    times.push_back(block.Data->GetMTime());
    times.push_back(block.Scalars->GetMTime());
    times.push_back(block.Colors ? block.Colors->GetMTime() : 0);
  }
  if (this->Grid && times == this->Times)
  {
    return "";
  }
  this->Grid = nullptr; // Its memory first.
  this->Scalars = nullptr;
  this->Times.clear();
  if (this->Blocks.size() == 1)
  {
    this->Blocks[0].First = { 0, 0, 0 };
    this->Dimensions = this->Blocks[0].GetPoints();
    this->Grid = this->Blocks[0].Data;
    this->Scalars = this->Blocks[0].Scalars;
  }
  else
  {
    problem = this->PlaceBlocks();
    if (!problem.empty())
    {
      return problem;
    }
    this->Join();
  }
  this->Times = std::move(times);
  return "";
}

//------------------------------------------------------------------------------
/// Finds the indices of the blocks on the lattice of the first.
std::string vtkIsosurfaceRayTraceBlocks::PlaceBlocks()
{
  auto* lattice = vtkImageData::SafeDownCast(this->Blocks[0].Data);
  vtkirt::Index3 low = { VTK_INT_MAX, VTK_INT_MAX, VTK_INT_MAX };
  vtkirt::Index3 high = { VTK_INT_MIN, VTK_INT_MIN, VTK_INT_MIN };
  double samples = 0.0;
  for (Block& block : this->Blocks)
  {
    auto* image = vtkImageData::SafeDownCast(block.Data);
    if (!lattice || !image || !FindFirstPoint(lattice, image, block.First))
    {
      return block.GetName() +
        " does not lie on the lattice of the blocks before it: its spacing or direction differs, "
        "or its origin is not a whole number of cells from theirs. Use a mapper and a volume for "
        "each lattice.";
    }
    const vtkirt::Index3 points = block.GetPoints();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], block.First[axis]);
      high[axis] = std::max(high[axis], block.First[axis] + points[axis]);
    }
    samples += static_cast<double>(vtkirt::Count(points));
  }
  const double box = (static_cast<double>(high[0]) - low[0]) *
    (static_cast<double>(high[1]) - low[1]) * (static_cast<double>(high[2]) - low[2]);
  if (box > 0x1p20 && box > 64.0 * samples)
  {
    return "The blocks of the composite input lie so far apart that the box around them has more "
           "than 64 times their samples, all of which would be held in memory. Use a mapper and a "
           "volume for each cluster of blocks.";
  }
  for (Block& block : this->Blocks)
  {
    block.First = Block::Subtract(block.First, low);
  }
  this->Dimensions = Block::Subtract(high, low);

  vtkNew<vtkImageData> image;
  image->SetExtent(low[0], high[0] - 1, low[1], high[1] - 1, low[2], high[2] - 1);
  image->SetSpacing(lattice->GetSpacing());
  image->SetOrigin(lattice->GetOrigin());
  image->SetDirectionMatrix(lattice->GetDirectionMatrix());
  this->Grid = image;
  return "";
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlocks::Join()
{
  auto* image = vtkImageData::SafeDownCast(this->Grid);
  const vtkIsosurfaceRayTraceBlockJoin join(
    this->Blocks, this->Dimensions, this->Leaves.AreScalarsOfCells());
  this->Scalars = join.JoinScalars();
  if (this->Leaves.AreScalarsOfCells())
  {
    image->GetCellData()->AddArray(this->Scalars);
  }
  else
  {
    image->GetPointData()->AddArray(this->Scalars);
  }
  const bool haveColors = std::all_of(this->Blocks.begin(), this->Blocks.end(),
    [](const Block& block) { return block.Colors && block.Colors != block.Scalars; });
  if (haveColors)
  {
    image->GetPointData()->AddArray(join.JoinColors());
  }
  join.HideMissingCells(image);
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceBlock& vtkIsosurfaceRayTraceBlocks::FindOwner(
  const vtkirt::Index3& cell) const
{
  // The block that shows it; for cells that are duplicates everywhere, any.
  for (const int hiding : { Block::Blanked | Block::Duplicate, Block::Blanked })
  {
    for (const Block& block : this->Blocks)
    {
      if (block.Shows(Block::Subtract(cell, block.First), hiding))
      {
        return block;
      }
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
