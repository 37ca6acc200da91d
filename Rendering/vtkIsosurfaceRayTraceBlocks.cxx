// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceBlocks.h"

#include "vtkIsosurfaceRayTraceBlockJoin.h"
#include "vtkIsosurfaceRayTraceColors.h"
#include "vtkIsosurfaceRayTraceProblems.h"

#include "vtkAbstractMapper.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"
#include "vtkUnsignedCharArray.h"

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

std::string NameBlock(const Block& block)
{
  return "Block " + std::to_string(block.FlatIndex) + " of the composite input";
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
std::string vtkIsosurfaceRayTraceBlocks::Update(vtkCompositeDataSet* input, const Choice& choice)
{
  std::string problem = this->Collect(input, choice);
  if (!problem.empty())
  {
    this->Times.clear();
    return problem;
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
/// Finds the blocks that have a volume and the scalars.
std::string vtkIsosurfaceRayTraceBlocks::Collect(vtkCompositeDataSet* input, const Choice& choice)
{
  // The indices are kept: they are found again only if something has changed.
  std::vector<Block> blocks;
  this->NumberOfPoints = 0;
  this->NumberOfCells = 0;
  const auto iterator = vtk::TakeSmartPointer(input->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    auto* data = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject());
    if (!data || data->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const Block block = { data, iterator->GetCurrentFlatIndex(), this->NumberOfPoints,
      this->NumberOfCells, nullptr, nullptr, {} };
    this->NumberOfPoints += data->GetNumberOfPoints();
    this->NumberOfCells += data->GetNumberOfCells();
    const std::string problem = this->Append(block, choice, blocks);
    if (!problem.empty())
    {
      return problem;
    }
  }
  if (blocks.empty())
  {
    return "The composite input has no block with a volume and scalars of the requested kind. Give "
           "blocks of vtkImageData with scalars, or name an array with SelectScalarArray().";
  }
  for (std::size_t i = 0; i < std::min(blocks.size(), this->Blocks.size()); ++i)
  {
    blocks[i].First = this->Blocks[i].First;
  }
  this->Blocks = std::move(blocks);
  return "";
}

//------------------------------------------------------------------------------
/// Appends a block with its arrays, if it has a volume and the scalars. Returns why it cannot be
/// traced; else empty.
std::string vtkIsosurfaceRayTraceBlocks::Append(
  Block block, const Choice& choice, std::vector<Block>& blocks)
{
  vtkDataSet* data = block.Data;
  if (!vtkImageData::SafeDownCast(data) && !vtkRectilinearGrid::SafeDownCast(data))
  {
    return NameBlock(block) + " is a " + data->GetClassName() +
      ". Give blocks of vtkImageData, or one vtkRectilinearGrid.";
  }
  int association = 0;
  block.Scalars = vtkAbstractMapper::GetScalars(
    data, choice.ScalarMode, choice.ArrayAccessMode, choice.ArrayId, choice.ArrayName, association);
  const vtkirt::Index3 points = block.GetPoints();
  if (!block.Scalars || association == vtkDataObject::FIELD_ASSOCIATION_NONE ||
    std::min({ points[0], points[1], points[2] }) < 2)
  {
    return "";
  }
  const bool areOfCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  if (blocks.empty())
  {
    this->OfCells = areOfCells;
  }
  const vtkIdType tuples = areOfCells ? data->GetNumberOfCells() : data->GetNumberOfPoints();
  if (this->OfCells != areOfCells || block.Scalars->GetNumberOfTuples() != tuples ||
    (!blocks.empty() &&
      block.Scalars->GetNumberOfComponents() != blocks[0].Scalars->GetNumberOfComponents()))
  {
    return NameBlock(block) +
      " has scalars unlike those of the blocks before it. Give all blocks a tuple for every "
      "point, or for every cell, with the same number of components.";
  }
  const std::string problem = vtkIsosurfaceRayTraceProblems::FindInGhosts(data);
  if (!problem.empty())
  {
    return NameBlock(block) + ": " + problem;
  }
  if (!choice.ColorArrayName.empty())
  {
    block.Colors = vtkIsosurfaceRayTraceColors::FindArray(data, choice.ColorArrayName);
  }
  if (block.Colors && !blocks.empty() && blocks[0].Colors &&
    block.Colors->GetNumberOfComponents() != blocks[0].Colors->GetNumberOfComponents())
  {
    return NameBlock(block) + " has " + std::to_string(block.Colors->GetNumberOfComponents()) +
      " components to colour by (" + choice.ColorArrayName + "), others have " +
      std::to_string(blocks[0].Colors->GetNumberOfComponents()) +
      ". Give all blocks the same number.";
  }
  blocks.push_back(block);
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
      return NameBlock(block) +
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

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceBlock* vtkIsosurfaceRayTraceBlocks::FindBlock(vtkIdType cellId) const
{
  for (const Block& block : this->Blocks)
  {
    if (cellId >= block.FirstCell && cellId < block.FirstCell + block.Data->GetNumberOfCells())
    {
      return &block;
    }
  }
  return nullptr;
}

VTK_ABI_NAMESPACE_END
