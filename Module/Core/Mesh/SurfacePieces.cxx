// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/SurfacePieces.h"

#include "Math/Arithmetic.h"
#include "Math/Compiler.h"
#include "Math/RoundOutward.h"
#include "Math/TrilinearCell.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Of leaves without any.
constexpr PackedPieces NoPieces = {};

/// The box of the points where segments between corners on both sides meet the surface: all of it
/// in the cell is in their convex hull.
Bounds FindHull(const MeshCell& cell, double isovalue, double scale)
{
  Bounds box = { { Infinity, Infinity, Infinity }, { -Infinity, -Infinity, -Infinity } };
  for (int i = 0; i < cell.Count; ++i)
  {
    const double a = Difference(cell.Values[i], isovalue, scale);
    for (int j = 0; j < cell.Count && a < 0.0; ++j)
    {
      const double b = Difference(cell.Values[j], isovalue, scale);
      if (b < 0.0)
      {
        continue;
      }
      const double fraction = a / (a - b);
      const Vector3 point = cell.Points[i] * (1.0 - fraction) + cell.Points[j] * fraction;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        box.Lower[axis] = std::min(box.Lower[axis], point[axis]);
        box.Upper[axis] = std::max(box.Upper[axis], point[axis]);
      }
    }
  }
  return box;
}

/// Makes the box of a set, and its boxes: the nearest step to each side.
void PackBoxes(const Bounds (&boxes)[PackedPieces::Capacity], PackedPieces& set)
{
  for (auto& words : set.Polygons)
  {
    std::fill_n(words, PackedPieces::Capacity, 0U);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double lower = Infinity;
    double upper = -Infinity;
    for (int i = 0; i < set.Count; ++i)
    {
      lower = std::min(lower, boxes[i].Lower[axis]);
      upper = std::max(upper, boxes[i].Upper[axis]);
    }
    set.Lower[axis] = RoundDown(lower);
    set.Upper[axis] = RoundUp(upper);
    lower = static_cast<double>(set.Lower[axis]);
    const double size = static_cast<double>(set.Upper[axis]) - lower;
    if (!(size > 0.0 && size < Infinity))
    {
      continue; // Without a size, or so large that it has no labels in single precision.
    }
    const auto pack = [&set, axis, lower, size](int corner, int i, double coordinate)
    {
      const double steps = (coordinate - lower) * (PackedPieces::Steps / size) + 0.5;
      set.Polygons[corner][i] |= static_cast<std::uint32_t>(steps) << (PackedPieces::Bits * axis);
    };
    for (int i = 0; i < set.Count; ++i)
    {
      pack(0, i, boxes[i].Lower[axis]);
      pack(1, i, boxes[i].Upper[axis]);
    }
  }
}

}

//------------------------------------------------------------------------------
SurfacePieces::SurfacePieces(
  const MeshCells& cells, const CellTree& tree, double isovalue, double scale)
  : Cells(&cells)
  , Tree(&tree)
  , Isovalue(isovalue)
  , Scale(scale)
  , NumberOfLeaves((tree.GetNumberOfBlocks() + CellTree::Width - 1) / CellTree::Width)
  , Leaves(new std::atomic<const PackedPieces*>[this->NumberOfLeaves]())
{
}

//------------------------------------------------------------------------------
SurfacePieces::~SurfacePieces()
{
  for (std::size_t leaf = 0; leaf < this->NumberOfLeaves; ++leaf)
  {
    const PackedPieces* made = this->Leaves[leaf].load();
    if (made != &NoPieces)
    {
      delete[] made;
    }
  }
}

//------------------------------------------------------------------------------
const PackedPieces* SurfacePieces::Make(std::size_t leaf, const Kernels& kernels)
{
  PassedCells tetrahedra;
  PassedCells others;
  this->FindPassedCells(leaf, tetrahedra, others);
  const int count = tetrahedra.GetNumberOfSets() + others.GetNumberOfSets();
  std::unique_ptr<PackedPieces[]> made;
  if (count > 0)
  {
    made.reset(new PackedPieces[static_cast<std::size_t>(count)]);
    this->MakeSets(tetrahedra, kernels, made.get());
    this->MakeSets(others, made.get() + tetrahedra.GetNumberOfSets());
    made[0].Sets = static_cast<std::uint16_t>(count);
  }
  const PackedPieces* ours = made ? made.get() : &NoPieces;
  const PackedPieces* before = nullptr;
  if (!this->Leaves[leaf].compare_exchange_strong(before, ours))
  {
    return before;
  }
  this->Memory += static_cast<std::size_t>(count) * sizeof(PackedPieces);
  made.release();
  return ours;
}

//------------------------------------------------------------------------------
/// Finds the cells of those blocks of a leaf that have values on both sides, and begins to fetch
/// all: they are anywhere in memory, and reading them one by one is waiting most of the time.
void SurfacePieces::FetchCells(
  std::size_t leaf, std::uint32_t (*cells)[CellTree::Width], int* counts) const
{
  const CellTreeNode& node = this->Tree->GetNode(0, leaf);
  for (int child = 0; child < CellTree::Width; ++child)
  {
    const std::size_t block = leaf * CellTree::Width + static_cast<std::size_t>(child);
    counts[child] = CellTree::HasBothSides(node, child, this->Isovalue)
      ? this->Tree->GetCells(block, cells[child])
      : 0;
    for (int i = 0; i < counts[child]; ++i)
    {
      this->Cells->Prefetch(cells[child][i]);
    }
  }
}

//------------------------------------------------------------------------------
void SurfacePieces::FindPassedCells(
  std::size_t leaf, PassedCells& tetrahedra, PassedCells& others) const
{
  std::uint32_t cells[CellTree::Width][CellTree::Width];
  int counts[CellTree::Width];
  this->FetchCells(leaf, cells, counts);
  for (int child = 0; child < CellTree::Width; ++child)
  {
    const std::uint32_t* numbers = cells[child];
    for (unsigned int active = this->Cells->FindStraddling(numbers, counts[child], this->Isovalue);
         active != 0; active &= active - 1)
    {
      const int i = LowestBit(active);
      MeshCell cell;
      if (!this->Tree->AreAllFinite() && !this->Cells->Load(numbers[i], cell))
      {
        continue;
      }
      PassedCells& passed =
        this->Cells->GetShape(numbers[i]) == CellShape::Tetrahedron ? tetrahedra : others;
      passed.Cells[passed.Count] = numbers[i];
      passed.Numbers[passed.Count++] = static_cast<std::uint8_t>(child * CellTree::Width + i);
    }
  }
}

//------------------------------------------------------------------------------
void SurfacePieces::MakeSets(
  const PassedCells& tetrahedra, const Kernels& kernels, PackedPieces* sets) const
{
  double corners[PackedPieces::Capacity][4][4];
  for (int first = 0; first < tetrahedra.Count; first += PackedPieces::Capacity)
  {
    PackedPieces& set = *sets++;
    set.AreInTetrahedra = true;
    set.Count =
      static_cast<std::uint8_t>(std::min(tetrahedra.Count - first, PackedPieces::Capacity));
    std::copy_n(&tetrahedra.Numbers[first], set.Count, set.Cells);
    this->Cells->LoadTetrahedra(&tetrahedra.Cells[first], set.Count, corners);
    for (int i = 0; i < set.Count; ++i)
    {
      SubtractIsovalue(this->Isovalue, this->Scale, corners[i]);
    }
    kernels.PackPolygons(corners, set);
  }
}

//------------------------------------------------------------------------------
void SurfacePieces::MakeSets(const PassedCells& others, PackedPieces* sets) const
{
  for (int first = 0; first < others.Count; first += PackedPieces::Capacity)
  {
    PackedPieces& set = *sets++;
    set.AreInTetrahedra = false;
    set.Count = static_cast<std::uint8_t>(std::min(others.Count - first, PackedPieces::Capacity));
    std::copy_n(&others.Numbers[first], set.Count, set.Cells);
    Bounds boxes[PackedPieces::Capacity];
    for (int i = 0; i < set.Count; ++i)
    {
      MeshCell cell;
      this->Cells->Load(others.Cells[first + i], cell);
      boxes[i] = FindHull(cell, this->Isovalue, this->Scale);
    }
    PackBoxes(boxes, set);
  }
}

}
