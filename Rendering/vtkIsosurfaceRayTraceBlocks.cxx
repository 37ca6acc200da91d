// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceBlocks.h"

#include "vtkIsosurfaceRayTraceColors.h"
#include "vtkIsosurfaceRayTraceGeometry.h"

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

using Blocks = vtkIsosurfaceRayTraceBlocks;

constexpr int BlankedCell = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;
constexpr int Duplicate = vtkDataSetAttributes::DUPLICATECELL;
static_assert(int{ vtkDataSetAttributes::DUPLICATEPOINT } == Duplicate, "both are the same bit");

std::string NameBlock(const Blocks::Block& block)
{
  return "Block " + std::to_string(block.FlatIndex) + " of the composite input";
}

vtkirt::Index3 operator+(const vtkirt::Index3& a, const vtkirt::Index3& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

vtkirt::Index3 operator-(const vtkirt::Index3& a, const vtkirt::Index3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

bool Contains(const vtkirt::Index3& size, const vtkirt::Index3& place)
{
  return place[0] >= 0 && place[1] >= 0 && place[2] >= 0 && place[0] < size[0] &&
    place[1] < size[1] && place[2] < size[2];
}

vtkirt::Index3 GetPoints(const Blocks::Block& block)
{
  return vtkIsosurfaceRayTraceGeometry::GetDimensions(block.Data);
}

vtkirt::Index3 GetCells(const Blocks::Block& block)
{
  return GetPoints(block) - vtkirt::Index3{ 1, 1, 1 };
}

/// Where a block lies on the lattice of an image: the index of its first point. Returns false if it
/// lies on another.
bool FindPlace(vtkImageData* lattice, vtkImageData* block, vtkirt::Index3& first)
{
  // If four corners are where they should be, all points are. A thousandth of a cell is less than
  // one would see, and more than the rounding of coordinates that were written as text.
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
      index = index + offset;
    }
    vtkirt::Vector3 point;
    vtkirt::Vector3 place;
    block->TransformIndexToPhysicalPoint(index.data(), point.data());
    lattice->TransformPhysicalPointToContinuousIndex(point.data(), place.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double whole = std::round(place[axis]);
      if (!(std::abs(place[axis] - whole) <= slack) || !(std::abs(whole) < 0x1p30))
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

/// Sets the samples beside known ones so that the central difference at the border of what is known
/// is the one-sided difference, as at the border of a volume.
void Continue(const vtkirt::Index3& size, const std::vector<bool>& known, vtkDataArray* samples)
{
  const double low = samples->GetDataTypeMin();
  const double high = samples->GetDataTypeMax();
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    if (known[i])
    {
      continue;
    }
    const auto number = static_cast<int64_t>(i);
    const vtkirt::Index3 place = { static_cast<int>(number % size[0]),
      static_cast<int>(number / size[0] % size[1]), static_cast<int>(number / size[0] / size[1]) };
    std::vector<std::array<vtkIdType, 2>> neighbours;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (const int side : { -1, 1 })
      {
        vtkirt::Index3 next = place;
        vtkirt::Index3 afterNext = place;
        next[axis] += side;
        afterNext[axis] += 2 * side;
        if (Contains(size, afterNext) && known[vtkirt::Offset(next, size)] &&
          known[vtkirt::Offset(afterNext, size)])
        {
          neighbours.push_back({ static_cast<vtkIdType>(vtkirt::Offset(next, size)),
            static_cast<vtkIdType>(vtkirt::Offset(afterNext, size)) });
        }
      }
    }
    for (int component = 0; !neighbours.empty() && component < samples->GetNumberOfComponents();
         ++component)
    {
      double sum = 0.0;
      for (const auto& neighbour : neighbours)
      {
        sum += 2.0 * samples->GetComponent(neighbour[0], component) -
          samples->GetComponent(neighbour[1], component);
      }
      const double mean = sum / static_cast<double>(neighbours.size());
      samples->SetComponent(static_cast<vtkIdType>(i), component, std::clamp(mean, low, high));
    }
  }
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
  // Who makes blocks anew may make them where others were: times tell, addresses do not.
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
    this->Dimensions = GetPoints(this->Blocks[0]);
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
  // The places are kept: they are found anew only where something has changed.
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
    Block block = { data, iterator->GetCurrentFlatIndex(), this->NumberOfPoints,
      this->NumberOfCells, nullptr, nullptr, {} };
    this->NumberOfPoints += data->GetNumberOfPoints();
    this->NumberOfCells += data->GetNumberOfCells();
    if (!vtkImageData::SafeDownCast(data) && !vtkRectilinearGrid::SafeDownCast(data))
    {
      return NameBlock(block) + " is a " + data->GetClassName() +
        ". Give blocks of vtkImageData, or one vtkRectilinearGrid.";
    }
    int association = 0;
    block.Scalars = vtkAbstractMapper::GetScalars(data, choice.ScalarMode, choice.ArrayAccessMode,
      choice.ArrayId, choice.ArrayName, association);
    const vtkirt::Index3 points = GetPoints(block);
    if (!block.Scalars || association == vtkDataObject::FIELD_ASSOCIATION_NONE ||
      std::min({ points[0], points[1], points[2] }) < 2)
    {
      continue;
    }
    if (blocks.empty())
    {
      this->OfCells = association == 1;
    }
    const vtkIdType tuples =
      association == 1 ? data->GetNumberOfCells() : data->GetNumberOfPoints();
    if (this->OfCells != (association == 1) || block.Scalars->GetNumberOfTuples() != tuples ||
      (!blocks.empty() &&
        block.Scalars->GetNumberOfComponents() != blocks[0].Scalars->GetNumberOfComponents()))
    {
      return NameBlock(block) +
        " has scalars unlike those of the blocks before it. Give all blocks a tuple for every "
        "point, "
        "or for every cell, with the same number of components.";
    }
    if (!choice.ColorArrayName.empty())
    {
      block.Colors = vtkIsosurfaceRayTraceColors::FindArray(data, choice.ColorArrayName);
    }
    blocks.push_back(block);
  }
  if (blocks.empty())
  {
    return "The composite input has no block with a volume and scalars of the kind asked for. Give "
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
/// Finds where the blocks lie on the lattice of the first.
std::string vtkIsosurfaceRayTraceBlocks::PlaceBlocks()
{
  auto* lattice = vtkImageData::SafeDownCast(this->Blocks[0].Data);
  vtkirt::Index3 low = { VTK_INT_MAX, VTK_INT_MAX, VTK_INT_MAX };
  vtkirt::Index3 high = { VTK_INT_MIN, VTK_INT_MIN, VTK_INT_MIN };
  double samples = 0.0;
  for (Block& block : this->Blocks)
  {
    auto* image = vtkImageData::SafeDownCast(block.Data);
    if (!lattice || !image || !FindPlace(lattice, image, block.First))
    {
      return NameBlock(block) +
        " does not lie on the lattice of the blocks before it: its spacing or direction is "
        "another, "
        "or its origin is not a whole number of cells from theirs. Give each lattice a mapper and "
        "a volume of its own.";
    }
    const vtkirt::Index3 points = GetPoints(block);
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
           "than 64 times their samples, which would be in memory. Give those that lie together a "
           "mapper and a volume of their own.";
  }
  for (Block& block : this->Blocks)
  {
    block.First = block.First - low;
  }
  this->Dimensions = high - low;

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
  this->Scalars = this->JoinArray(false);
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
    image->GetPointData()->AddArray(this->JoinArray(true));
  }
  this->HideMissingCells(image);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataArray> vtkIsosurfaceRayTraceBlocks::JoinArray(bool isColor) const
{
  const auto get = [isColor](const Block& block) { return isColor ? block.Colors : block.Scalars; };
  const bool ofCells = !isColor && this->OfCells;
  int type = get(this->Blocks[0])->GetDataType();
  bool isSameType = true;
  for (const Block& block : this->Blocks)
  {
    isSameType = isSameType && get(block)->GetDataType() == type;
  }
  type = isSameType ? (type == VTK_BIT ? VTK_UNSIGNED_CHAR : type) : VTK_DOUBLE;
  auto joined = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  const vtkirt::Index3 size =
    ofCells ? this->Dimensions - vtkirt::Index3{ 1, 1, 1 } : this->Dimensions;
  joined->SetName(get(this->Blocks[0])->GetName());
  joined->SetNumberOfComponents(get(this->Blocks[0])->GetNumberOfComponents());
  joined->SetNumberOfTuples(static_cast<vtkIdType>(vtkirt::Count(size)));
  joined->Fill(0.0);
  std::vector<bool> known(vtkirt::Count(size), false);
  // Samples of another block first: where the block itself is there, its own count.
  for (const bool onlyOwn : { false, true })
  {
    for (const Block& block : this->Blocks)
    {
      this->CopySamples(block, get(block), ofCells, onlyOwn, joined, known);
    }
  }
  Continue(size, known, joined);
  return joined;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlocks::CopySamples(const Block& block, vtkDataArray* from, bool ofCells,
  bool onlyOwn, vtkDataArray* to, std::vector<bool>& known) const
{
  vtkUnsignedCharArray* flags =
    ofCells ? block.Data->GetCellGhostArray() : block.Data->GetPointGhostArray();
  if (!flags && !onlyOwn)
  {
    return;
  }
  const vtkirt::Index3 one = { 1, 1, 1 };
  const vtkirt::Index3 size = ofCells ? GetCells(block) : GetPoints(block);
  const vtkirt::Index3 whole = ofCells ? this->Dimensions - one : this->Dimensions;
  const auto isTaken = [flags, onlyOwn](vtkIdType sample)
  { return !onlyOwn || !flags || (flags->GetValue(sample) & Duplicate) == 0; };
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      const auto source = static_cast<vtkIdType>(vtkirt::Offset({ 0, y, z }, size));
      const std::size_t target = vtkirt::Offset(block.First + vtkirt::Index3{ 0, y, z }, whole);
      // Runs of samples that are taken.
      for (vtkIdType begin = 0; begin < size[0];)
      {
        vtkIdType end = begin;
        while (end < size[0] && isTaken(source + end))
        {
          ++end;
        }
        if (end > begin)
        {
          to->InsertTuples(
            static_cast<vtkIdType>(target) + begin, end - begin, source + begin, from);
          const auto first = known.begin() + static_cast<std::ptrdiff_t>(target);
          std::fill(first + begin, first + end, true);
        }
        begin = end + 1;
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Whether a block shows a cell at a place of its own.
static bool ShowsCell(const Blocks::Block& block, const vtkirt::Index3& cell, int hiding)
{
  vtkUnsignedCharArray* ofCells = block.Data->GetCellGhostArray();
  vtkUnsignedCharArray* ofPoints = block.Data->GetPointGhostArray();
  if (ofCells &&
    (ofCells->GetValue(static_cast<vtkIdType>(vtkirt::Offset(cell, GetCells(block)))) & hiding) !=
      0)
  {
    return false;
  }
  for (int corner = 0; ofPoints && corner < 8; ++corner)
  {
    const vtkirt::Index3 point = cell + vtkirt::Index3{ corner & 1, corner >> 1 & 1, corner >> 2 };
    if ((ofPoints->GetValue(static_cast<vtkIdType>(vtkirt::Offset(point, GetPoints(block)))) &
          vtkDataSetAttributes::HIDDENPOINT) != 0)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlocks::HideMissingCells(vtkImageData* image) const
{
  // A cell that is a duplicate in a block may be that of another block; as a sample, both are one.
  const int hiding = BlankedCell | (this->OfCells ? 0 : Duplicate);
  const vtkirt::Index3 whole = this->Dimensions - vtkirt::Index3{ 1, 1, 1 };
  std::vector<bool> isShown(vtkirt::Count(whole), false);
  for (const Block& block : this->Blocks)
  {
    const vtkirt::Index3 size = GetCells(block);
    for (int z = 0; z < size[2]; ++z)
    {
      for (int y = 0; y < size[1]; ++y)
      {
        for (int x = 0; x < size[0]; ++x)
        {
          const vtkirt::Index3 cell = { x, y, z };
          if (ShowsCell(block, cell, hiding))
          {
            isShown[vtkirt::Offset(block.First + cell, whole)] = true;
          }
        }
      }
    }
  }
  if (std::find(isShown.begin(), isShown.end(), false) == isShown.end())
  {
    return;
  }
  vtkUnsignedCharArray* flags = image->AllocateCellGhostArray();
  for (std::size_t i = 0; i < isShown.size(); ++i)
  {
    flags->SetValue(static_cast<vtkIdType>(i), isShown[i] ? 0 : vtkDataSetAttributes::HIDDENCELL);
  }
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceBlocks::Block& vtkIsosurfaceRayTraceBlocks::FindOwner(
  const vtkirt::Index3& cell) const
{
  // The one that shows it; of cells that are duplicates everywhere, any.
  for (const int hiding : { BlankedCell | Duplicate, BlankedCell })
  {
    for (const Block& block : this->Blocks)
    {
      const vtkirt::Index3 own = cell - block.First;
      if (Contains(GetCells(block), own) && ShowsCell(block, own, hiding))
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
  return block.FirstCell +
    static_cast<vtkIdType>(vtkirt::Offset(cell - block.First, GetCells(block)));
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceBlocks::GetPointId(
  const vtkirt::Index3& cell, const vtkirt::Index3& point) const
{
  const Block& block = this->FindOwner(cell);
  return block.FirstPoint +
    static_cast<vtkIdType>(vtkirt::Offset(point - block.First, GetPoints(block)));
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceBlocks::Block* vtkIsosurfaceRayTraceBlocks::FindBlock(
  vtkIdType cellId) const
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
