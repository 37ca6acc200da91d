// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshBeam.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr float FloatInfinity = std::numeric_limits<float>::infinity();

IsovalueSpan FindSpan(double isovalue)
{
  const auto rounded = static_cast<float>(isovalue);
  const float from =
    static_cast<double>(rounded) < isovalue ? std::nextafterf(rounded, FloatInfinity) : rounded;
  return { std::nextafterf(from, -FloatInfinity), from };
}

}

//------------------------------------------------------------------------------
void MeshBeam::Begin(const MeshSelection& selection, const RayPacket& lines)
{
  this->Heap.clear();
  this->Leaves.clear();
  this->NumberOfSets = 0;
  const int levels = selection.Tree->GetNumberOfLevels();
  this->HasFrame =
    levels > 0 && selection.PacketKernels && this->Frame.Find(lines, selection.Tree->GetBounds());
  if (!this->HasFrame)
  {
    return;
  }
  this->Projection = this->Frame.GetProjection();
  this->Spans.clear();
  for (const MeshSurface& surface : selection.Surfaces)
  {
    this->Spans.push_back(FindSpan(surface.Isovalue));
  }
  this->Heap.push_back({ -FloatInfinity, levels - 1, 0 });
}

//------------------------------------------------------------------------------
bool MeshBeam::MayHitBetween(const MeshSelection& selection, const RayPacket& lines)
{
  // The lines as one group of rays without an end.
  BeamRays rays;
  for (std::size_t k = 0; k < 2; ++k)
  {
    std::fill_n(rays.Lower[k], 2 * BeamRays::Groups, FloatInfinity);
    std::fill_n(rays.Upper[k], 2 * BeamRays::Groups, -FloatInfinity);
  }
  std::fill_n(rays.GroupEnd, 2 * BeamRays::Groups, FloatInfinity);
  this->Frame.FindBounds(lines, rays.LowerOfAll, rays.UpperOfAll);
  for (std::size_t k = 0; k < 2; ++k)
  {
    rays.Lower[k][0] = rays.LowerOfAll[k];
    rays.Upper[k][0] = rays.UpperOfAll[k];
  }
  rays.EndOfAll = FloatInfinity;
  for (std::size_t leaf = 0; leaf < this->Leaves.size() || this->FindMore(selection, FloatInfinity);
       ++leaf)
  {
    const Leaf& found = this->Leaves[leaf];
    if (selection.PacketKernels->FindPassed(found.Bounds, found.Blocks, rays) != 0)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool MeshBeam::FindMore(const MeshSelection& selection, float end)
{
  const std::size_t before = this->Leaves.size();
  while (this->Leaves.size() == before && !this->Heap.empty() && this->Heap.front().Near <= end)
  {
    std::pop_heap(this->Heap.begin(), this->Heap.end());
    const Node node = this->Heap.back();
    this->Heap.pop_back();
    this->Expand(selection, node);
  }
  return this->Leaves.size() > before;
}

//------------------------------------------------------------------------------
void MeshBeam::Expand(const MeshSelection& selection, const Node& node)
{
  LabelBounds bounds;
  unsigned int found =
    selection.PacketKernels->ProjectChildren(selection.Tree->GetNode(node.Level, node.Number),
      this->Projection, this->Spans.data(), static_cast<int>(this->Spans.size()), bounds);
  if (node.Level == 0)
  {
    this->AddLeaf(selection, node.Number, found, bounds);
    return;
  }
  for (; found != 0; found &= found - 1)
  {
    const int child = __builtin_ctz(found);
    const std::size_t number = node.Number * CellTree::Width + static_cast<std::size_t>(child);
    selection.Tree->Prefetch(node.Level - 1, number);
    this->Heap.push_back({ bounds.Near[child], node.Level - 1, number });
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddLeaf(const MeshSelection& selection, std::size_t number, unsigned int blocks,
  const LabelBounds& bounds)
{
  if (blocks == 0)
  {
    return;
  }
  this->Leaves.push_back({ bounds, number, blocks, 0, NoSet });
  for (; blocks != 0 && !selection.Tree->AreCellsSorted(); blocks &= blocks - 1)
  {
    const std::size_t block =
      number * CellTree::Width + static_cast<std::size_t>(__builtin_ctz(blocks));
    selection.Cells->Prefetch(
      selection.Tree->GetCell(block, 0), selection.Tree->GetNumberOfCells(block));
  }
}

//------------------------------------------------------------------------------
void MeshBeam::Load(const MeshSelection& selection, std::size_t leaf, unsigned int blocks)
{
  Leaf& found = this->Leaves[leaf];
  const unsigned int missing = blocks & ~found.Loaded;
  found.Loaded |= missing;
  for (std::size_t surface = 0; surface < selection.Surfaces.size() && missing != 0; ++surface)
  {
    CellList tetrahedra;
    CellList others;
    for (unsigned int left = missing; left != 0; left &= left - 1)
    {
      const std::size_t block =
        found.Number * CellTree::Width + static_cast<std::size_t>(__builtin_ctz(left));
      for (unsigned int active = selection.Surfaces[surface].Active->Get(block); active != 0;
           active &= active - 1)
      {
        const std::uint32_t number = selection.Tree->GetCell(block, __builtin_ctz(active));
        const bool isTetrahedron = selection.Cells->IsTetrahedron(number);
        CellList& list = isTetrahedron ? tetrahedra : others;
        list.Numbers[list.Count++] = number;
        if (list.Count == BeamPieces::Capacity)
        {
          this->AddSet(selection, list, surface, isTetrahedron, found);
        }
      }
    }
    this->AddSet(selection, tetrahedra, surface, true, found);
    this->AddSet(selection, others, surface, false, found);
  }
}

//------------------------------------------------------------------------------
void MeshBeam::ForgetPieces()
{
  this->NumberOfSets = 0;
  for (Leaf& leaf : this->Leaves)
  {
    leaf.Loaded = 0;
    leaf.FirstSet = NoSet;
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddSet(const MeshSelection& selection, CellList& cells, std::size_t surface,
  bool areTetrahedra, Leaf& leaf)
{
  if (cells.Count == 0)
  {
    return;
  }
  const auto number = static_cast<std::size_t>(this->NumberOfSets++);
  if (number == this->Sets.size())
  {
    this->Sets.emplace_back();
  }
  PieceSet& set = this->Sets[number];
  set.First = static_cast<int>(number) * BeamPieces::Capacity;
  set.Surface = static_cast<int>(surface);
  set.AreTetrahedra = areTetrahedra;
  set.Next = leaf.FirstSet;
  leaf.FirstSet = static_cast<int>(number);
  const int count = cells.Count;
  cells.Count = 0;
  set.Pieces.Count = count;
  std::copy_n(cells.Numbers, count, set.Cells);
  selection.Cells->LoadRecords(cells.Numbers, count, areTetrahedra, set.Orders, set.Records);
  const MeshSurface& traced = selection.Surfaces[surface];
  const int corners = areTetrahedra ? 4 : PassedCellRecords::Corners;
  for (int i = 0; i < count; ++i)
  {
    for (int corner = 0; corner < corners; ++corner)
    {
      double& value = set.Records.Corner[i][corner][3];
      value = Difference(value, traced.Isovalue, traced.Scale);
    }
  }
  const Kernels& kernels = *selection.PacketKernels;
  (areTetrahedra ? kernels.BoundTetrahedra : kernels.BoundTrilinear)(
    set.Records, this->Frame.GetNumbers(), set.Pieces);
}

}
