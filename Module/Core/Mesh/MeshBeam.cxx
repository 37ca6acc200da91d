// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshBeam.h"

#include "Math/Arithmetic.h"
#include "Math/Compiler.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The nodes that hold blocks of cells.
constexpr int LevelOfLeaves = 0;

IsovalueSpan FindSpan(double isovalue)
{
  const auto rounded = static_cast<float>(isovalue);
  const float from =
    static_cast<double>(rounded) < isovalue ? std::nextafterf(rounded, FloatInfinity) : rounded;
  return { std::nextafterf(from, -FloatInfinity), from };
}

/// Whether rays end at any hit with a surface.
bool EndsRays(const MeshSelection& selection, int surface)
{
  const TraceRequest& request = selection.Request;
  return request.Visible.IsConvex() &&
    request.Surfaces[static_cast<std::size_t>(surface)].Opacity >= 1.0;
}

}

//------------------------------------------------------------------------------
MeshBeam::MeshBeam()
  : Boxes{}
{
  std::fill_n(this->Boxes.Low, CellTreeNode::Width, -FloatInfinity);
  std::fill_n(this->Boxes.High, CellTreeNode::Width, FloatInfinity);
}

//------------------------------------------------------------------------------
void MeshBeam::Begin(const MeshSelection& selection, const RayPacket& lines)
{
  RaySet all = {};
  for (int i = 0; i < lines.Count; ++i)
  {
    Add(i, all);
  }
  this->FindFrame(selection, lines, all);
}

//------------------------------------------------------------------------------
void MeshBeam::Begin(const MeshSelection& selection, const RayPacket& rays, const RaySet& some)
{
  this->FindFrame(selection, rays, some);
  if (this->HasFrame)
  {
    this->Projection.Begin = this->Frame.FindBegin(rays, some);
  }
}

//------------------------------------------------------------------------------
void MeshBeam::FindFrame(const MeshSelection& selection, const RayPacket& lines, const RaySet& some)
{
  this->Heap.clear();
  this->Sets.clear();
  this->NumberOfSeen = 0;
  const int levels = selection.Tree->GetNumberOfLevels();
  this->HasFrame = levels > 0 && selection.PacketKernels &&
    this->Frame.Find(lines, some, selection.Tree->GetBounds());
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
  for (std::size_t next = 0; next < this->Sets.size() || this->FindMore(selection, FloatInfinity);)
  {
    if (this->FindPassed(selection, rays, next) != 0)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool MeshBeam::FindMore(const MeshSelection& selection, float end)
{
  const std::size_t before = this->Sets.size();
  while (this->Sets.size() == before && !this->Heap.empty() && this->Heap.front().Near <= end)
  {
    std::pop_heap(this->Heap.begin(), this->Heap.end());
    const Node node = this->Heap.back();
    this->Heap.pop_back();
    if (node.Level == LevelOfLeaves)
    {
      this->AddLeaf(selection, node.Number);
    }
    else
    {
      this->Expand(selection, node);
    }
  }
  return this->Sets.size() > before;
}

//------------------------------------------------------------------------------
void MeshBeam::Expand(const MeshSelection& selection, const Node& node)
{
  LabelBounds bounds;
  unsigned int found =
    selection.PacketKernels->ProjectChildren(selection.Tree->GetNode(node.Level, node.Number),
      this->Projection, this->Spans.data(), static_cast<int>(this->Spans.size()), bounds);
  for (; found != 0; found &= found - 1)
  {
    const int child = LowestBit(found);
    const std::size_t number = node.Number * CellTree::Width + static_cast<std::size_t>(child);
    this->Prefetch(selection, node.Level - 1, number);
    this->Heap.push_back({ bounds.Near[child], node.Level - 1, number });
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

//------------------------------------------------------------------------------
/// Begins to fetch what is read of a node when it is expanded.
void MeshBeam::Prefetch(const MeshSelection& selection, int level, std::size_t number)
{
  if (level > LevelOfLeaves)
  {
    selection.Tree->Prefetch(level, number);
  }
  for (const MeshSurface& surface : selection.Surfaces)
  {
    if (level == LevelOfLeaves)
    {
      surface.Pieces->PrefetchBoxes(number);
    }
    else if (level == LevelOfLeaves + 1)
    {
      surface.Pieces->Prefetch(number * CellTree::Width, CellTree::Width);
    }
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddLeaf(const MeshSelection& selection, std::size_t leaf)
{
  for (std::size_t surface = 0; surface < selection.Surfaces.size(); ++surface)
  {
    const PackedPieces* sets =
      selection.Surfaces[surface].Pieces->Get(leaf, *selection.PacketKernels);
    for (int first = 0; first < sets->Sets; first += CellTreeNode::Width)
    {
      this->AddSets(selection, leaf, static_cast<int>(surface), sets + first,
        std::min(sets->Sets - first, CellTreeNode::Width));
    }
  }
}

//------------------------------------------------------------------------------
/// Adds those of some sets that the beam may meet.
void MeshBeam::AddSets(const MeshSelection& selection, std::size_t leaf, int surface,
  const PackedPieces* first, int count)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < count; ++i)
    {
      this->Boxes.Lower[axis][i] = first[i].Lower[axis];
      this->Boxes.Upper[axis][i] = first[i].Upper[axis];
    }
  }
  constexpr IsovalueSpan anyValue = { 0.0F, 0.0F };
  LabelBounds bounds;
  unsigned int found =
    selection.PacketKernels->ProjectChildren(this->Boxes, this->Projection, &anyValue, 1, bounds);
  int order[CellTreeNode::Width];
  int passed = 0;
  for (found &= (1U << count) - 1U; found != 0; found &= found - 1)
  {
    order[passed++] = LowestBit(found);
  }
  std::sort(order, order + passed, [&](int a, int b) { return bounds.Near[a] < bounds.Near[b]; });
  for (int i = 0; i < passed; ++i)
  {
    const std::size_t group = this->Sets.size() / GroupSize;
    if (group == this->Bounds.size())
    {
      this->Bounds.emplace_back();
    }
    this->Bounds[group].Copy(bounds, order[i], static_cast<int>(this->Sets.size() % GroupSize));
    const PackedPieces* set = first + order[i];
    for (const auto& corners : set->Polygons)
    {
      PrefetchLine(corners);
    }
    this->Sets.push_back({ set, leaf, surface, NotSeen });
  }
}

//------------------------------------------------------------------------------
unsigned int MeshBeam::FindPassed(
  const MeshSelection& selection, const BeamRays& rays, std::size_t& next) const
{
  const std::size_t group = next / GroupSize;
  const std::size_t first = group * GroupSize;
  const std::size_t last = std::min(first + GroupSize, this->Sets.size());
  const unsigned int among = ((1U << (last - first)) - 1U) & ~((1U << (next - first)) - 1U);
  next = last;
  return selection.PacketKernels->FindPassed(this->Bounds[group], among, rays);
}

//------------------------------------------------------------------------------
int MeshBeam::Load(const MeshSelection& selection, std::size_t set)
{
  Set& loaded = this->Sets[set];
  if (loaded.Seen != NotSeen)
  {
    return loaded.Seen;
  }
  loaded.Seen = this->NumberOfSeen++;
  if (static_cast<std::size_t>(loaded.Seen) == this->Seen.size())
  {
    this->Seen.emplace_back();
  }
  SeenPieces& seen = this->Seen[static_cast<std::size_t>(loaded.Seen)];
  seen.Set = set;
  if (loaded.Packed->AreInTetrahedra)
  {
    selection.PacketKernels->BoundPackedPieces(
      *loaded.Packed, this->Frame.GetNumbers(), seen.Pieces);
    if (!EndsRays(selection, loaded.Surface))
    {
      std::fill_n(seen.Pieces.Far, BeamPieces::Capacity, FloatInfinity);
    }
  }
  else
  {
    this->BoundTrilinear(selection, loaded, seen.Pieces);
  }
  return loaded.Seen;
}

//------------------------------------------------------------------------------
void MeshBeam::BoundTrilinear(const MeshSelection& selection, const Set& set, BeamPieces& pieces)
{
  const int count = set.Packed->Count;
  std::uint32_t cells[PackedPieces::Capacity] = {};
  for (int i = 0; i < count; ++i)
  {
    cells[i] = GetCell(selection, set, i);
  }
  selection.Cells->LoadTrilinear(cells, count, this->Records.Corner);
  const MeshSurface& surface = selection.Surfaces[static_cast<std::size_t>(set.Surface)];
  for (int i = 0; i < count; ++i)
  {
    SubtractIsovalue(surface.Isovalue, surface.Scale, this->Records.Corner[i]);
  }
  pieces.Count = count;
  selection.PacketKernels->BoundTrilinear(this->Records, this->Frame.GetNumbers(), pieces);
}

//------------------------------------------------------------------------------
void MeshBeam::Forget()
{
  for (int i = 0; i < this->NumberOfSeen; ++i)
  {
    this->Sets[this->GetSeen(i).Set].Seen = NotSeen;
  }
  this->NumberOfSeen = 0;
}

}
