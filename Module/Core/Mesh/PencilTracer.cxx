// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/PencilTracer.h"

#include "Math/Compiler.h"
#include "Mesh/RayPencil.h"

#include <algorithm>
#include <numeric>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// In cells: a cube of a leaf's 256.
constexpr double LengthOfLeaf = 6.0;

/// Of so many rays.
int CountGroups(int rays)
{
  return (rays + LoneRays::GroupSize - 1) / LoneRays::GroupSize;
}

}

//------------------------------------------------------------------------------
RaySet PencilTracer::Trace(const MeshSelection& selection, const RayPacket& packet,
  const RaySet& rays, const Departure* departures, HitsOfRays& hits)
{
  this->Packet = &packet;
  this->Departures = departures;
  this->Solver.Begin(selection, packet, departures, true);
  const RaySet traced = this->PlaceRays(selection, rays);
  if (!IsEmpty(traced))
  {
    selection.PacketKernels->FindFrames(packet, this->Solver.GetFramed());
  }
  this->Going.resize(this->NumberOfPencils);
  std::iota(this->Going.begin(), this->Going.end(), std::size_t{ 0 });
  while (!this->Going.empty())
  {
    const auto isAtEnd = [&](std::size_t pencil)
    { return !this->Advance(selection, this->Pencils[pencil], hits); };
    this->Going.erase(
      std::remove_if(this->Going.begin(), this->Going.end(), isAtEnd), this->Going.end());
    this->Solve(selection, hits);
  }
  return traced;
}

//------------------------------------------------------------------------------
/// Puts rays that have a frame in order by the axis that they go along, and makes pencils of them.
/// Returns which they are.
RaySet PencilTracer::PlaceRays(const MeshSelection& selection, const RaySet& rays)
{
  this->NumberOfPencils = 0;
  RaySet traced = {};
  if (selection.Tree->GetNumberOfLevels() == 0)
  {
    return traced;
  }
  this->Rays.Clear(selection.Tree->GetBounds());
  constexpr int ways = LoneRays::Ways;
  int raysOfWay[ways][RayPacket::Capacity];
  int counts[ways] = {};
  ForEachRay(rays,
    [&](int ray)
    {
      BeamFrame frame;
      if (frame.FindAlone(*this->Packet, ray, selection.Tree->GetBounds()))
      {
        RaySet alone = {};
        Add(ray, alone);
        Add(ray, traced);
        const BeamNumbers& numbers = frame.GetNumbers();
        this->Rays.Frame[ray] = numbers;
        this->Rays.Through[ray] = frame.GetRay(frame.FindBegin(*this->Packet, alone));
        const int way = 2 * numbers.Along + (numbers.Sign > 0.0 ? 1 : 0);
        raysOfWay[way][counts[way]++] = ray;
      }
    });
  int first = 0;
  for (int way = 0; way < ways; ++way)
  {
    const int count = counts[way];
    for (int i = 0; i < count; ++i)
    {
      this->Rays.Place(raysOfWay[way][i], first + i);
      this->Rays.End[first + i] = this->FindEnd(first + i);
    }
    if (count > LoneRays::GroupSize) // One group is bounded by its pencil.
    {
      RayPencil::BoundGroups(this->Rays, first, count, selection.Tree->GetBounds());
    }
    if (count > 0)
    {
      this->MakePencils(selection, first, count);
    }
    first += CountGroups(count) * LoneRays::GroupSize;
  }
  return traced;
}

//------------------------------------------------------------------------------
/// Makes a pencil of rays that go one way along an axis; several, if they are far from each other.
void PencilTracer::MakePencils(const MeshSelection& selection, int first, int count)
{
  if (count == 1)
  {
    this->AddPencil(
      selection, first, count, RayPencil::GetBounds(this->Rays.Through[this->Rays.Ray[first]]));
    return;
  }
  const RayPencil pencil(this->Rays, first, count, selection.Tree->GetBounds());
  const float* ends = this->Rays.End + first;
  const double end = std::min(static_cast<double>(*std::max_element(ends, ends + count)), 0.0);
  // Where rays end there should be no more leaves between them than there are rays.
  const double size = LengthOfLeaf * selection.CellSize;
  if ((pencil.GetWidth(0, end) / size + 1.0) * (pencil.GetWidth(1, end) / size + 1.0) < count)
  {
    this->AddPencil(selection, first, count, pencil.GetBounds());
    return;
  }
  const bool areGroups = count > LoneRays::GroupSize;
  const int half = areGroups ? CountGroups(count) / 2 * LoneRays::GroupSize : count / 2;
  this->MakePencils(selection, first, half);
  this->MakePencils(selection, first + half, count - half);
}

//------------------------------------------------------------------------------
void PencilTracer::AddPencil(
  const MeshSelection& selection, int first, int count, const PencilThroughBoxes& bounds)
{
  if (this->NumberOfPencils == this->Pencils.size())
  {
    this->Pencils.emplace_back();
  }
  Pencil& pencil = this->Pencils[this->NumberOfPencils++];
  pencil.First = first;
  pencil.Count = count;
  pencil.Nodes.Begin(selection, bounds);
}

//------------------------------------------------------------------------------
/// The depth that the ray in a place ends at by what it has hit.
float PencilTracer::FindEnd(int place) const
{
  const int ray = this->Rays.Ray[place];
  const BeamNumbers& frame = this->Rays.Frame[ray];
  return static_cast<float>(GetEndDepth(frame,
    this->Packet->Origin[frame.Along][ray] +
      this->Solver.GetEnds()[ray] * this->Packet->Direction[frame.Along][ray]));
}

//------------------------------------------------------------------------------
/// The depth that the last ray of a pencil ends at.
float PencilTracer::FindEnd(const Pencil& pencil) const
{
  constexpr int size = LoneRays::GroupSize;
  const bool hasGroups = pencil.Count > size;
  const float* ends =
    hasGroups ? this->Rays.GroupEnd + pencil.First / size : this->Rays.End + pencil.First;
  return *std::max_element(ends, ends + (hasGroups ? CountGroups(pencil.Count) : pencil.Count));
}

//------------------------------------------------------------------------------
/// Takes a pencil to the next leaf in which a ray may hit something. Returns false if there is
/// none.
bool PencilTracer::Advance(const MeshSelection& selection, Pencil& pencil, HitsOfRays& hits)
{
  const float end = this->FindEnd(pencil);
  const std::size_t before = this->Pairs.size();
  std::size_t leaf;
  while (pencil.Nodes.FindLeaf(selection, end, leaf))
  {
    this->AddPieces(
      selection, { pencil.Nodes.GetPencil(), pencil.First, pencil.Count, end }, leaf, hits);
    if (this->Pairs.size() != before)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/// Adds the pairs of rays of a pencil with the pieces of a leaf.
void PencilTracer::AddPieces(
  const MeshSelection& selection, const RaysInPencil& rays, std::size_t leaf, HitsOfRays& hits)
{
  for (std::size_t surface = 0; surface < selection.Surfaces.size(); ++surface)
  {
    const PackedPieces* sets =
      selection.Surfaces[surface].Pieces->Get(leaf, *selection.PacketKernels);
    const int count = sets->Sets;
    for (int next = 0; next < count;)
    {
      MetPieces met;
      next = selection.PacketKernels->FindPiecesOnRays(sets, next, count, this->Rays, rays, met);
      this->AddPieces(selection, { &sets[next - 1], leaf, static_cast<int>(surface) }, met, hits);
    }
  }
}

//------------------------------------------------------------------------------
/// Adds those with the pieces of a set.
void PencilTracer::AddPieces(
  const MeshSelection& selection, const SetOfLeaf& set, const MetPieces& met, HitsOfRays& hits)
{
  for (int i = 0; i < met.Count; ++i)
  {
    const int place = met.Place[i];
    const int ray = this->Rays.Ray[place];
    for (unsigned int pieces = met.Pieces[i]; pieces != 0; pieces &= pieces - 1)
    {
      const std::uint32_t cell =
        selection.Tree->GetCellOfLeaf(set.Leaf, set.Pieces->Cells[LowestBit(pieces)]);
      if (set.Pieces->AreInTetrahedra && this->StartsAt(ray, cell, set.Surface))
      {
        continue; // A ray crosses a plane once.
      }
      const auto pair = static_cast<int>(this->Pairs.size());
      this->Pairs.push_back(ray);
      this->Places.push_back(place);
      this->Solver.Add(
        selection, { cell, set.Pieces->AreInTetrahedra, set.Surface }, pair, pair + 1);
      if (this->Solver.IsFull())
      {
        this->Solve(selection, hits);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Solves the pairs, and ends their rays at what they hit.
void PencilTracer::Solve(const MeshSelection& selection, HitsOfRays& hits)
{
  this->Solver.Solve(selection, this->Pairs.data(), hits);
  for (const int place : this->Places)
  {
    this->Rays.End[place] = this->FindEnd(place);
    this->Rays.SetGroupEnd(place / LoneRays::GroupSize);
  }
  this->Pairs.clear();
  this->Places.clear();
}

}
