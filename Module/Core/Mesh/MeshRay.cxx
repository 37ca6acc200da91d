// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshRay.h"

#include "Math/Arithmetic.h"
#include "Math/Compiler.h"
#include "Mesh/Slab.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

struct MeshRay::Child
{
  double Begin;
  int Number;
};

//------------------------------------------------------------------------------
MeshRay::MeshRay(const MeshSelection& selection, const RayPacket& packet, int ray)
  : Selection(&selection)
  , Origin(packet.GetOrigin(ray))
  , Direction(packet.GetDirection(ray))
  , Inverse{ packet.Inverse[0][ray], packet.Inverse[1][ray], packet.Inverse[2][ray] }
  , Part{ packet.Begin[ray], packet.End[ray], packet.Base[ray] }
  , Frame(this->Origin, this->Direction)
{
}

//------------------------------------------------------------------------------
void MeshRay::FindHits(CellHits& inCell, std::vector<Hit>& hits)
{
  const int levels = this->Selection->Tree->GetNumberOfLevels();
  if (levels > 0)
  {
    this->Visit(levels - 1, 0, inCell, hits);
  }
}

//------------------------------------------------------------------------------
void MeshRay::Visit(int level, std::size_t number, CellHits& inCell, std::vector<Hit>& hits)
{
  const CellTreeNode& node = this->Selection->Tree->GetNode(level, number);
  Child children[CellTree::Width];
  int count = 0;
  for (int i = 0; i < CellTree::Width; ++i)
  {
    const double begin = this->IsActive(node, i) ? this->FindBegin(node, i) : Infinity;
    if (begin < Infinity)
    {
      children[count++] = { begin, i };
    }
  }
  std::sort(
    children, children + count, [](const Child& a, const Child& b) { return a.Begin < b.Begin; });
  for (int i = 0; i < count && children[i].Begin <= this->Part.End; ++i)
  {
    const std::size_t child =
      number * CellTree::Width + static_cast<std::size_t>(children[i].Number);
    if (level > 0)
    {
      this->Visit(level - 1, child, inCell, hits);
    }
    else
    {
      this->VisitBlock(child, inCell, hits);
    }
  }
}

//------------------------------------------------------------------------------
bool MeshRay::IsActive(const CellTreeNode& node, int child) const
{
  return std::any_of(this->Selection->Surfaces.begin(), this->Selection->Surfaces.end(),
    [&node, child](const MeshSurface& surface)
    { return CellTree::Straddles(node, child, surface.Isovalue); });
}

//------------------------------------------------------------------------------
/// Where the ray enters the box of a child, or infinity.
double MeshRay::FindBegin(const CellTreeNode& node, int child) const
{
  Slab inside = { this->Part.Begin, this->Part.End };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Slab slab = CutToSlab(this->Origin[axis], this->Direction[axis], this->Inverse[axis],
      static_cast<double>(node.Lower[axis][child]), static_cast<double>(node.Upper[axis][child]));
    inside = { std::max(inside.Begin, slab.Begin), std::min(inside.End, slab.End) };
  }
  return inside.Begin <= inside.End ? inside.Begin : Infinity;
}

//------------------------------------------------------------------------------
void MeshRay::VisitBlock(std::size_t block, CellHits& inCell, std::vector<Hit>& hits)
{
  std::uint32_t numbers[CellTree::Width];
  const int count = this->Selection->Tree->GetCells(block, numbers);
  for (std::size_t surface = 0; surface < this->Selection->Surfaces.size(); ++surface)
  {
    const double isovalue = this->Selection->Surfaces[surface].Isovalue;
    for (unsigned int active = this->Selection->Cells->FindStraddling(numbers, count, isovalue);
         active != 0; active &= active - 1)
    {
      KeepHitsInCell(*this->Selection, this->Frame, numbers[LowestBit(active)],
        static_cast<int>(surface), inCell, this->Part, hits);
    }
  }
}

}
