// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/SurfacePieces.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Of leaves without any.
constexpr PackedPieces NoPieces = {};

int CountSets(const CellsOfLeaf& passed)
{
  return (passed.Count + PackedPieces::Capacity - 1) / PackedPieces::Capacity;
}

}

//------------------------------------------------------------------------------
SurfacePieces::SurfacePieces(
  const MeshCells& cells, const CellTree& tree, double isovalue, double scale)
  : Maker(cells, tree, isovalue, scale)
  , NumberOfLeaves(this->Maker.GetNumberOfLeaves())
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
  CellsOfLeaf tetrahedra;
  CellsOfLeaf others;
  this->Maker.FindPassedCells(leaf, tetrahedra, others);
  const int count = CountSets(tetrahedra) + CountSets(others);
  std::unique_ptr<PackedPieces[]> made;
  if (count > 0)
  {
    made.reset(new PackedPieces[static_cast<std::size_t>(count)]);
    PackedPieces* next = made.get();
    this->MakeSets(tetrahedra, true, kernels, next);
    this->MakeSets(others, false, kernels, next);
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
/// Makes those in some cells. Moves on behind the last set.
void SurfacePieces::MakeSets(
  const CellsOfLeaf& passed, bool areTetrahedra, const Kernels& kernels, PackedPieces*& next) const
{
  for (int first = 0; first < passed.Count; first += PackedPieces::Capacity)
  {
    PackedPieces& set = *next++;
    set.Count = static_cast<std::uint8_t>(std::min(passed.Count - first, PackedPieces::Capacity));
    set.AreInTetrahedra = areTetrahedra;
    std::copy_n(&passed.Numbers[first], set.Count, set.Cells);
    this->Maker.Pack(&passed.Cells[first], kernels, set);
  }
}

}
