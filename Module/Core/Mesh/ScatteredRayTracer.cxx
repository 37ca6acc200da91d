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
  const RaySet& rays, const Departure* departures, HitsOfRays& hits)
{
  const Bounds& box = selection.Tree->GetBounds();
  if (!IsSinglePrecision(box))
  {
    return {};
  }
  this->Departures = departures;
  this->Solver.Begin(selection, packet, departures, true);
  selection.PacketKernels->FindFrames(packet, this->Solver.GetFramed());
  selection.PacketKernels->ScatterRays(packet, box.Lower.data(), box.Upper.data(), this->Rays);
  this->FindTrees(selection);
  this->Begin(rays);
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
  for (std::size_t surface = 0; surface < selection.Surfaces.size(); ++surface)
  {
    for (const PieceTree& tree : selection.Surfaces[surface].Trees->Get()->Get())
    {
      this->Trees.push_back({ tree.GetLevels(), static_cast<int>(surface) });
    }
  }
}

//------------------------------------------------------------------------------
void ScatteredRayTracer::Begin(const RaySet& rays)
{
  this->Going.clear();
  if (this->Trees.empty())
  {
    return;
  }
  ForEachRay(rays,
    [this](int ray)
    {
      this->Rays.SetEnd(ray, this->Solver.GetEnds()[ray]);
      this->Going.emplace_back();
      RayOnWay& going = this->Going.back();
      going.Ray = ray;
      going.Tree = 0;
      going.Way.Begin(this->Trees[0].Levels);
    });
}

//------------------------------------------------------------------------------
/// Takes a ray to the next pieces that it may hit. Returns false if there are none.
bool ScatteredRayTracer::Advance(const MeshSelection& selection, RayOnWay& ray, HitsOfRays& hits)
{
  while (true)
  {
    const TreeOfSurface& tree = this->Trees[ray.Tree];
    unsigned int pieces;
    const int set = selection.PacketKernels->FindSetOnRay(
      tree.Levels, this->Rays, ray.Ray, this->GetStartCell(ray.Ray, tree.Surface), ray.Way, pieces);
    if (set >= 0)
    {
      this->AddPairs(selection, tree, ray.Ray, set, pieces, hits);
      return true;
    }
    if (++ray.Tree == this->Trees.size())
    {
      return false;
    }
    ray.Way.Begin(this->Trees[ray.Tree].Levels);
  }
}

//------------------------------------------------------------------------------
/// The cell in which a ray starts on a surface: it crosses a plane there once.
std::uint32_t ScatteredRayTracer::GetStartCell(int ray, int surface) const
{
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  return this->Departures && this->Departures[ray].Surface == surface
    ? static_cast<std::uint32_t>(this->Departures[ray].Cell)
    : none;
}

//------------------------------------------------------------------------------
/// Adds the pairs of a ray with some pieces of a set.
void ScatteredRayTracer::AddPairs(const MeshSelection& selection, const TreeOfSurface& tree,
  int ray, int set, unsigned int pieces, HitsOfRays& hits)
{
  const std::uint32_t* cells =
    tree.Levels.Cells + static_cast<std::size_t>(set) * PackedPieces::Capacity;
  for (; pieces != 0; pieces &= pieces - 1)
  {
    if (this->Solver.IsFull())
    {
      this->Solve(selection, hits);
    }
    const auto pair = static_cast<int>(this->Pairs.size());
    this->Pairs.push_back(ray);
    const std::uint32_t cell = cells[LowestBit(pieces)];
    this->Solver.Add(
      selection, { cell, tree.Levels.Polygons != nullptr, tree.Surface }, pair, pair + 1);
  }
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
