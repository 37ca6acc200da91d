// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshBeam.h"

#include "Math/Arithmetic.h"
#include "Math/Compiler.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Whether rays end at any hit with a surface.
bool EndsRays(const MeshSelection& selection, int surface)
{
  const TraceRequest& request = selection.Request;
  return request.Visible.IsConvex() &&
    request.Surfaces[static_cast<std::size_t>(surface)].Opacity >= 1.0;
}

}

//------------------------------------------------------------------------------
void MeshBeam::Begin(const MeshSelection& selection, const RayPacket& lines)
{
  RaySet all = {};
  for (int i = 0; i < lines.Count; ++i)
  {
    Add(i, all);
  }
  if (this->FindFrame(selection, lines, all))
  {
    this->Nodes.Begin(selection, this->Frame.GetProjection());
  }
}

//------------------------------------------------------------------------------
void MeshBeam::Begin(const MeshSelection& selection, const RayPacket& rays, const RaySet& some)
{
  if (!this->FindFrame(selection, rays, some))
  {
    return;
  }
  BeamProjection projection = this->Frame.GetProjection();
  projection.Begin = this->Frame.FindBegin(rays, some);
  // Rays to a point within the mesh would have no labels there.
  constexpr double mostTetrahedra = 4.0;
  const double width = this->Frame.GetWidth();
  this->HasFrame =
    !AreFarApart(selection, CountCells(selection, width, width), CountOf(some), mostTetrahedra) &&
    this->Frame.HasLabelsFrom(projection.Begin);
  if (this->HasFrame)
  {
    this->Nodes.Begin(selection, projection);
  }
}

//------------------------------------------------------------------------------
bool MeshBeam::AreFarApart(
  const MeshSelection& selection, double cells, int count, double mostTetrahedra)
{
  const double mostCellsOfRay = selection.Cells->AreTetrahedra() ? mostTetrahedra : 0.5;
  return !(cells < mostCellsOfRay * count);
}

//------------------------------------------------------------------------------
bool MeshBeam::FindFrame(const MeshSelection& selection, const RayPacket& lines, const RaySet& some)
{
  this->Nodes.Clear();
  this->Sets.clear();
  this->NumberOfSeen = 0;
  this->AnyLabel = 0;
  this->HasFrame = selection.Tree->GetNumberOfLevels() > 0 && selection.PacketKernels &&
    this->Frame.Find(lines, some, selection.Tree->GetBounds());
  return this->HasFrame;
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
  std::size_t leaf;
  while (this->Sets.size() == before && this->Nodes.FindLeaf(selection, end, leaf))
  {
    this->AddLeaf(selection, leaf);
  }
  return this->Sets.size() > before;
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
  LabelBounds bounds;
  unsigned int found = this->Nodes.FindSets(selection, first, count, bounds);
  int order[CellTreeNode::Width];
  int passed = 0;
  for (; found != 0; found &= found - 1)
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
    this->Sets.push_back({ first + order[i], leaf, surface, NotSeen });
    Prefetch(selection, this->Sets.back());
  }
}

//------------------------------------------------------------------------------
/// Begins to fetch what a set is bounded from.
void MeshBeam::Prefetch(const MeshSelection& selection, const Set& set)
{
  if (set.Packed->AreInTetrahedra)
  {
    for (const auto& corners : set.Packed->Polygons)
    {
      PrefetchLine(corners);
    }
    return;
  }
  for (int i = 0; i < set.Packed->Count; ++i)
  {
    selection.Cells->Prefetch(GetCell(selection, set, i));
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
  seen.Pieces.AnyLabel = 0;
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
  this->AnyLabel += seen.Pieces.AnyLabel;
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
  this->Hulls.Bound(selection, selection.Surfaces[static_cast<std::size_t>(set.Surface)], cells,
    count, this->Frame.GetNumbers(), pieces);
}

//------------------------------------------------------------------------------
void MeshBeam::Forget()
{
  for (int i = 0; i < this->NumberOfSeen; ++i)
  {
    this->Sets[this->GetSeen(i).Set].Seen = NotSeen;
  }
  this->NumberOfSeen = 0;
  this->AnyLabel = 0;
}

}
