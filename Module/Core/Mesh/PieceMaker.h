// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PieceMaker_h
#define PieceMaker_h

#include "Kernels/Kernels.h"
#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"

#include <cstddef>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Cells of a leaf of the tree (in its 16 blocks of 16 cells) that a surface passes, and their
/// numbers within it.
struct CellsOfLeaf
{
  int Count = 0;
  std::uint32_t Cells[CellTree::Width * CellTree::Width];
  std::uint8_t Numbers[CellTree::Width * CellTree::Width];
};

/// Finds the cells of a mesh that a surface passes, and packs its pieces in them.
class PieceMaker
{
public:
  /// Cells and tree must outlive it. For the scale, see MeshSurface.
  PieceMaker(const MeshCells& cells, const CellTree& tree, double isovalue, double scale)
    : Cells(&cells)
    , Tree(&tree)
    , Isovalue(isovalue)
    , Scale(scale)
  {
  }

  const MeshCells& GetCells() const { return *this->Cells; }
  std::size_t GetNumberOfLeaves() const
  {
    return (this->Tree->GetNumberOfBlocks() + CellTree::Width - 1) / CellTree::Width;
  }

  /// Finds those of a leaf: tetrahedra, and others.
  void FindPassedCells(std::size_t leaf, CellsOfLeaf& tetrahedra, CellsOfLeaf& others) const;

  /// Packs the pieces in some cells, as many as the set counts and all of the kind that it has, but
  /// not their numbers.
  void Pack(const std::uint32_t* cells, const Kernels& kernels, PackedPieces& set) const;

private:
  void FetchCells(std::size_t leaf, std::uint32_t (*cells)[CellTree::Width], int* counts) const;

  const MeshCells* Cells;
  const CellTree* Tree;
  double Isovalue;
  double Scale;
};

}

#endif
