// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/ScatteredRayTracer.h"

#include "Math/Compiler.h"
#include "Mesh/BeamFrame.h"

#include <algorithm>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
RaySet ScatteredRayTracer::Trace(const MeshSelection& selection, const RayPacket& packet,
  const RaySet& rays, const Departure* departures, bool haveTrees, HitsOfRays& hits)
{
  const Bounds& box = selection.Tree->GetBounds();
  if (!IsSinglePrecision(box))
  {
    return {};
  }
  this->Departures = departures;
  this->HaveTrees = haveTrees;
  this->Solver.Begin(selection, packet, departures, true);
  selection.PacketKernels->FindFrames(packet, this->Solver.GetFramed());
  selection.PacketKernels->ScatterRays(packet, box.Lower.data(), box.Upper.data(), this->Rays);
  this->FindTrees(selection);
  this->Begin(selection, rays);
  while (!this->Going.empty())
  {
    const auto isAtEnd = [&](RayOnWay& ray) { return !this->Advance(selection, ray, hits); };
    this->Going.erase(
      std::remove_if(this->Going.begin(), this->Going.end(), isAtEnd), this->Going.end());
    this->Solve(selection, hits);
  }
  return rays;
}

//------------------------------------------------------------------------------
void ScatteredRayTracer::FindTrees(const MeshSelection& selection)
{
  this->Trees.clear();
  for (std::size_t surface = 0; this->HaveTrees && surface < selection.Surfaces.size(); ++surface)
  {
    for (const PieceTree& tree : selection.Surfaces[surface].Trees->Get()->Get())
    {
      this->Trees.push_back({ tree.GetLevels(), static_cast<int>(surface) });
    }
  }
}

//------------------------------------------------------------------------------
void ScatteredRayTracer::Begin(const MeshSelection& selection, const RaySet& rays)
{
  this->Going.clear();
  if (this->HaveTrees ? this->Trees.empty() : selection.Tree->GetNumberOfLevels() == 0)
  {
    return;
  }
  // Above the nodes of a tree; the lowest ones of the tree of cells are the leaves.
  const int top =
    this->HaveTrees ? this->Trees[0].Levels.Count : selection.Tree->GetNumberOfLevels() - 1;
  ForEachRay(rays,
    [this, top](int ray)
    {
      this->Rays.SetEnd(ray, this->Solver.GetEnds()[ray]);
      this->Going.emplace_back();
      RayOnWay& going = this->Going.back();
      going.Ray = ray;
      going.Tree = 0;
      going.Way.Begin(top, !this->HaveTrees && this->Rays.Rate[2][ray] < 0.0F);
    });
}

//------------------------------------------------------------------------------
/// Takes a ray to the next pieces that it may hit. Returns false if there are none.
bool ScatteredRayTracer::Advance(const MeshSelection& selection, RayOnWay& ray, HitsOfRays& hits)
{
  return this->HaveTrees ? this->AdvanceInTrees(selection, ray, hits)
                         : this->AdvanceInCells(selection, ray, hits);
}

//------------------------------------------------------------------------------
bool ScatteredRayTracer::AdvanceInTrees(
  const MeshSelection& selection, RayOnWay& ray, HitsOfRays& hits)
{
  while (true)
  {
    const TreeOfSurface& tree = this->Trees[ray.Tree];
    unsigned int pieces;
    const int set = selection.PacketKernels->FindSetOnRay(
      tree.Levels, this->Rays, ray.Ray, this->GetStartCell(ray.Ray, tree.Surface), ray.Way, pieces);
    if (set >= 0)
    {
      const std::uint32_t* cells =
        tree.Levels.Cells + static_cast<std::size_t>(set) * PackedPieces::Capacity;
      for (; pieces != 0; pieces &= pieces - 1)
      {
        const std::uint32_t cell = cells[LowestBit(pieces)];
        this->Add(
          selection, { cell, tree.Levels.Polygons != nullptr, tree.Surface }, ray.Ray, hits);
      }
      return true;
    }
    if (++ray.Tree == this->Trees.size())
    {
      return false;
    }
    ray.Way.Begin(this->Trees[ray.Tree].Levels.Count);
  }
}

//------------------------------------------------------------------------------
bool ScatteredRayTracer::AdvanceInCells(
  const MeshSelection& selection, RayOnWay& ray, HitsOfRays& hits)
{
  std::size_t leaf;
  while (this->FindLeaf(selection, ray, leaf))
  {
    if (this->AddPiecesOfLeaf(selection, ray.Ray, leaf, hits))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/// Takes a ray to the next leaf of the tree of cells that it may meet. Returns false if there is
/// none.
bool ScatteredRayTracer::FindLeaf(
  const MeshSelection& selection, RayOnWay& ray, std::size_t& leaf) const
{
  std::uint32_t child;
  while (ray.Way.Take(child))
  {
    if (ray.Way.Level == CellTree::LowestLevel)
    {
      leaf = child;
      return true;
    }
    const int level = ray.Way.Level;
    const unsigned int met =
      selection.PacketKernels->FindChildrenOnRay(selection.Tree->GetNode(level, child), this->Rays,
        ray.Ray, selection.Spans.data(), static_cast<int>(selection.Spans.size()));
    ray.Way.Enter(child, met);
    for (unsigned int left = met; left != 0; left &= left - 1)
    {
      selection.Prefetch(level - 1,
        std::size_t{ child } * CellTree::Width + static_cast<std::size_t>(LowestBit(left)));
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/// Adds the pairs of a ray with the pieces of a leaf. Returns whether there are any.
bool ScatteredRayTracer::AddPiecesOfLeaf(
  const MeshSelection& selection, int ray, std::size_t leaf, HitsOfRays& hits)
{
  bool areAny = false;
  for (std::size_t number = 0; number < selection.Surfaces.size(); ++number)
  {
    const auto surface = static_cast<int>(number);
    const PackedPieces* sets =
      selection.Surfaces[number].Pieces->Get(leaf, *selection.PacketKernels);
    const int count = sets->Sets;
    unsigned int pieces;
    for (int next = 0; (next = selection.PacketKernels->FindPiecesOnRay(
                          sets, next, count, this->Rays, ray, pieces)) < count;
         ++next)
    {
      const PackedPieces& set = sets[next];
      for (; pieces != 0; pieces &= pieces - 1)
      {
        const std::uint32_t cell =
          selection.Tree->GetCellOfLeaf(leaf, set.Cells[LowestBit(pieces)]);
        this->Add(selection, { cell, set.AreInTetrahedra, surface }, ray, hits);
        areAny = true;
      }
    }
  }
  return areAny;
}

//------------------------------------------------------------------------------
/// The cell in which a ray starts on a surface. If it is a tetrahedron, the ray crosses the plane
/// of its piece there alone, which need not be solved.
std::uint32_t ScatteredRayTracer::GetStartCell(int ray, int surface) const
{
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  return this->Departures && this->Departures[ray].Surface == surface
    ? static_cast<std::uint32_t>(this->Departures[ray].Cell)
    : none;
}

//------------------------------------------------------------------------------
/// Adds a pair of a ray with a cell.
void ScatteredRayTracer::Add(
  const MeshSelection& selection, const PairSolver::PassedCell& cell, int ray, HitsOfRays& hits)
{
  if (this->Solver.IsFull())
  {
    this->Solve(selection, hits);
  }
  const auto pair = static_cast<int>(this->Pairs.size());
  this->Pairs.push_back(ray);
  this->Solver.Add(selection, cell, pair, pair + 1);
}

//------------------------------------------------------------------------------
/// Solves the pairs, and ends their rays at what they hit.
void ScatteredRayTracer::Solve(const MeshSelection& selection, HitsOfRays& hits)
{
  this->Solver.Solve(selection, this->Pairs.data(), hits);
  for (const int ray : this->Pairs)
  {
    this->Rays.SetEnd(ray, this->Solver.GetEnds()[ray]);
  }
  this->Pairs.clear();
}

}
