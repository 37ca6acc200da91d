// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/SurfacePieces.h"

#include "Math/Compiler.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Of leaves without any.
constexpr PackedPieces NoPieces = {};

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
    this->MakeBoxedSets(others, kernels, made.get() + tetrahedra.GetNumberOfSets());
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
    counts[child] = CellTree::Straddles(node, child, this->Isovalue)
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
    BeginSet(tetrahedra, first, set);
    set.AreInTetrahedra = true;
    this->Cells->LoadTetrahedra(&tetrahedra.Cells[first], set.Count, corners);
    SubtractIsovalue(this->Isovalue, this->Scale, corners, set.Count);
    kernels.PackPolygons(corners, set);
  }
}

//------------------------------------------------------------------------------
void SurfacePieces::MakeBoxedSets(
  const PassedCells& others, const Kernels& kernels, PackedPieces* sets) const
{
  double corners[PackedPieces::Capacity][PassedCellRecords::Corners][4];
  for (int first = 0; first < others.Count; first += PackedPieces::Capacity)
  {
    PackedPieces& set = *sets++;
    BeginSet(others, first, set);
    set.AreInTetrahedra = false;
    this->Cells->LoadTrilinear(&others.Cells[first], set.Count, corners);
    SubtractIsovalue(this->Isovalue, this->Scale, corners, set.Count);
    kernels.PackBoxes(corners, set);
  }
}

//------------------------------------------------------------------------------
/// Sets the cells of a set, of which the first is given.
void SurfacePieces::BeginSet(const PassedCells& passed, int first, PackedPieces& set)
{
  set.Count = static_cast<std::uint8_t>(std::min(passed.Count - first, PackedPieces::Capacity));
  std::copy_n(&passed.Numbers[first], set.Count, set.Cells);
}

}
