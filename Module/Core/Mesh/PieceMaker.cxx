// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/PieceMaker.h"

#include "Math/Compiler.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
/// Finds the cells of those blocks of a leaf that have values on both sides, and begins to fetch
/// all: they are anywhere in memory, and reading them one by one is waiting most of the time.
void PieceMaker::FetchCells(
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
void PieceMaker::FindPassedCells(
  std::size_t leaf, CellsOfLeaf& tetrahedra, CellsOfLeaf& others) const
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
      CellsOfLeaf& passed =
        this->Cells->GetShape(numbers[i]) == CellShape::Tetrahedron ? tetrahedra : others;
      passed.Cells[passed.Count] = numbers[i];
      passed.Numbers[passed.Count++] = static_cast<std::uint8_t>(child * CellTree::Width + i);
    }
  }
}

//------------------------------------------------------------------------------
void PieceMaker::Pack(const std::uint32_t* cells, const Kernels& kernels, PackedPieces& set) const
{
  if (set.AreInTetrahedra)
  {
    double corners[PackedPieces::Capacity][4][4];
    this->Cells->LoadTetrahedra(cells, set.Count, corners);
    SubtractIsovalue(this->Isovalue, this->Scale, corners, set.Count);
    kernels.PackPolygons(corners, set);
  }
  else
  {
    double corners[PackedPieces::Capacity][PassedCellRecords::Corners][4];
    this->Cells->LoadTrilinear(cells, set.Count, corners);
    SubtractIsovalue(this->Isovalue, this->Scale, corners, set.Count);
    kernels.PackBoxes(corners, set);
  }
}

}
