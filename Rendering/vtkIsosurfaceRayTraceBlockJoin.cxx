// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceBlockJoin.h"

#include "vtkIsosurfaceRayTraceGhosts.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Block = vtkIsosurfaceRayTraceBlock;

/// Extrapolates the samples beside known ones, so that the central difference at the border of the
/// known samples is the one-sided difference, as at the border of a volume.
void Extrapolate(const vtkirt::Index3& size, const std::vector<bool>& known, vtkDataArray* samples)
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
    const vtkirt::Index3 point = { static_cast<int>(number % size[0]),
      static_cast<int>(number / size[0] % size[1]), static_cast<int>(number / size[0] / size[1]) };
    std::vector<std::array<vtkIdType, 2>> neighbours;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (const int side : { -1, 1 })
      {
        vtkirt::Index3 next = point;
        vtkirt::Index3 afterNext = point;
        next[axis] += side;
        afterNext[axis] += 2 * side;
        if (Block::Contains(size, afterNext) && known[vtkirt::Offset(next, size)] &&
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

/// There may be millions of short rows, so arrays of one type are copied without VTK's dispatch.
void CopyTuples(
  vtkDataArray* from, vtkIdType source, vtkIdType count, vtkDataArray* to, vtkIdType target)
{
  if (from->GetDataType() != to->GetDataType() || from->GetDataType() == VTK_BIT ||
    !from->HasStandardMemoryLayout())
  {
    to->InsertTuples(target, count, source, from);
    return;
  }
  const vtkIdType components = from->GetNumberOfComponents();
  std::memcpy(to->GetVoidPointer(target * components), from->GetVoidPointer(source * components),
    static_cast<std::size_t>(count * components * from->GetDataTypeSize()));
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceBlockJoin::vtkIsosurfaceRayTraceBlockJoin(
  const std::vector<Block>& blocks, const vtkirt::Index3& dimensions, bool ofCells)
  : Blocks(blocks)
  , Points(dimensions)
  , Cells(Block::Subtract(dimensions, { 1, 1, 1 }))
  , OfCells(ofCells)
{
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataArray> vtkIsosurfaceRayTraceBlockJoin::JoinScalars() const
{
  return this->JoinArrays(&Block::Scalars, this->OfCells);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataArray> vtkIsosurfaceRayTraceBlockJoin::JoinColors() const
{
  return this->JoinArrays(&Block::Colors, false);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataArray> vtkIsosurfaceRayTraceBlockJoin::JoinArrays(
  vtkDataArray* Block::*array, bool ofCells) const
{
  int type = (this->Blocks[0].*array)->GetDataType();
  bool isSameType = true;
  for (const Block& block : this->Blocks)
  {
    isSameType = isSameType && (block.*array)->GetDataType() == type;
  }
  type = isSameType ? (type == VTK_BIT ? VTK_UNSIGNED_CHAR : type) : VTK_DOUBLE;
  auto joined = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  const vtkirt::Index3 size = ofCells ? this->Cells : this->Points;
  joined->SetName((this->Blocks[0].*array)->GetName());
  joined->SetNumberOfComponents((this->Blocks[0].*array)->GetNumberOfComponents());
  joined->SetNumberOfTuples(static_cast<vtkIdType>(vtkirt::Count(size)));
  joined->Fill(0.0);
  std::vector<bool> known(vtkirt::Count(size), false);
  // Duplicates first: the samples of the blocks that own them replace them.
  for (const bool onlyOwn : { false, true })
  {
    for (const Block& block : this->Blocks)
    {
      this->CopySamples(block, block.*array, ofCells, onlyOwn, joined, known);
    }
  }
  Extrapolate(size, known, joined);
  return joined;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlockJoin::CopySamples(const Block& block, vtkDataArray* from,
  bool ofCells, bool onlyOwn, vtkDataArray* to, std::vector<bool>& known) const
{
  vtkUnsignedCharArray* flags =
    ofCells ? block.Data->GetCellGhostArray() : block.Data->GetPointGhostArray();
  if (!flags && !onlyOwn)
  {
    return;
  }
  const vtkirt::Index3 size = ofCells ? block.GetCells() : block.GetPoints();
  const vtkirt::Index3 whole = ofCells ? this->Cells : this->Points;
  const auto isTaken = [flags, onlyOwn](vtkIdType sample)
  {
    return !onlyOwn || !flags ||
      (flags->GetValue(sample) & vtkIsosurfaceRayTraceGhosts::Duplicate) == 0;
  };
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      const auto source = static_cast<vtkIdType>(vtkirt::Offset({ 0, y, z }, size));
      const std::size_t target = vtkirt::Offset(Block::Add(block.First, { 0, y, z }), whole);
      // Runs of samples that are copied.
      for (vtkIdType begin = 0; begin < size[0];)
      {
        vtkIdType end = begin;
        while (end < size[0] && isTaken(source + end))
        {
          ++end;
        }
        if (end > begin)
        {
          CopyTuples(from, source + begin, end - begin, to, static_cast<vtkIdType>(target) + begin);
          const auto first = known.begin() + static_cast<std::ptrdiff_t>(target);
          std::fill(first + begin, first + end, true);
        }
        begin = end + 1;
      }
    }
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlockJoin::HideMissingCells(vtkImageData* image) const
{
  // A cell that is a duplicate in a block may be that of another block; as samples, both are the
  // same.
  const int hiding = vtkIsosurfaceRayTraceGhosts::Blanked |
    (this->OfCells ? 0 : vtkIsosurfaceRayTraceGhosts::Duplicate);
  std::vector<bool> isShown(vtkirt::Count(this->Cells), false);
  for (const Block& block : this->Blocks)
  {
    const vtkirt::Index3 size = block.GetCells();
    const bool hasFlags = block.Data->GetCellGhostArray() || block.Data->GetPointGhostArray();
    for (int z = 0; z < size[2]; ++z)
    {
      for (int y = 0; y < size[1]; ++y)
      {
        if (!hasFlags)
        {
          const auto first = isShown.begin() +
            static_cast<std::ptrdiff_t>(
              vtkirt::Offset(Block::Add(block.First, { 0, y, z }), this->Cells));
          std::fill(first, first + size[0], true);
        }
        for (int x = 0; hasFlags && x < size[0]; ++x)
        {
          const vtkirt::Index3 cell = { x, y, z };
          if (block.Shows(cell, hiding))
          {
            isShown[vtkirt::Offset(Block::Add(block.First, cell), this->Cells)] = true;
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

VTK_ABI_NAMESPACE_END
