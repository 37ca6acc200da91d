// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/LoneTracer.h"

#include "Math/Compiler.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
RaySet LoneTracer::Trace(const MeshSelection& selection, const RayPacket& packet,
  const RaySet& rays, const Departure* departures, HitsOfRays& hits)
{
  this->Packet = &packet;
  this->Departures = departures;
  this->Ways.resize(RayPacket::Capacity);
  this->Solver.Begin(selection, packet, departures, this->Frames);
  int going[RayPacket::Capacity];
  int count = 0;
  RaySet traced = {};
  ForEachRay(rays,
    [&](int ray)
    {
      if (this->BeginWay(selection, ray))
      {
        Add(ray, traced);
        going[count++] = ray;
      }
    });
  if (count > 0)
  {
    selection.PacketKernels->FindFrames(packet, this->Solver.GetFramed());
  }
  while (count > 0)
  {
    int left = 0;
    for (int i = 0; i < count; ++i)
    {
      const int ray = going[i];
      if (this->Advance(selection, ray, hits))
      {
        going[left++] = ray;
      }
    }
    count = left;
    this->Solve(selection, hits);
  }
  return traced;
}

//------------------------------------------------------------------------------
/// Returns false if the ray has no frame.
bool LoneTracer::BeginWay(const MeshSelection& selection, int ray)
{
  if (selection.Tree->GetNumberOfLevels() == 0)
  {
    return false;
  }
  RaySet alone = {};
  Add(ray, alone);
  BeamFrame frame;
  if (!frame.FindAlone(*this->Packet, ray, selection.Tree->GetBounds()))
  {
    return false;
  }
  Way& way = this->Ways[static_cast<std::size_t>(ray)];
  this->Frames[ray] = frame.GetNumbers();
  way.Nodes.Begin(selection, frame.GetRay(frame.FindBegin(*this->Packet, alone)));
  return true;
}

//------------------------------------------------------------------------------
/// The depth that a ray ends at by what it has hit.
float LoneTracer::FindEnd(int ray) const
{
  const BeamNumbers& frame = this->Frames[ray];
  return static_cast<float>(GetEndDepth(frame,
    this->Packet->Origin[frame.Along][ray] +
      this->Solver.GetEnds()[ray] * this->Packet->Direction[frame.Along][ray]));
}

//------------------------------------------------------------------------------
/// Takes a ray to the next leaf in which it may hit something. Returns false if there is none.
bool LoneTracer::Advance(const MeshSelection& selection, int ray, HitsOfRays& hits)
{
  Way& way = this->Ways[static_cast<std::size_t>(ray)];
  way.End = this->FindEnd(ray);
  const std::size_t before = this->Pairs.size();
  std::size_t leaf;
  while (way.Nodes.FindLeaf(selection, way.End, leaf))
  {
    this->AddPieces(selection, ray, leaf, hits);
    if (this->Pairs.size() != before)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/// Adds the pairs of a ray with the pieces of a leaf.
void LoneTracer::AddPieces(
  const MeshSelection& selection, int ray, std::size_t leaf, HitsOfRays& hits)
{
  const Way& way = this->Ways[static_cast<std::size_t>(ray)];
  for (std::size_t number = 0; number < selection.Surfaces.size(); ++number)
  {
    const MeshSurface& surface = selection.Surfaces[number];
    const PackedPieces* sets = surface.Pieces->Get(leaf, *selection.PacketKernels);
    for (unsigned int found =
           selection.PacketKernels->FindSetsOnRay(sets, sets->Sets, way.Nodes.GetRay(), way.End);
         found != 0; found &= found - 1)
    {
      const PackedPieces& set = sets[LowestBit(found)];
      for (unsigned int pieces = selection.PacketKernels->FindPiecesOnRay(
             set, this->Frames[ray], way.Nodes.GetRay(), way.End);
           pieces != 0; pieces &= pieces - 1)
      {
        const std::uint32_t cell =
          selection.Tree->GetCellOfLeaf(leaf, set.Cells[LowestBit(pieces)]);
        if (set.AreInTetrahedra && this->StartsAt(ray, cell, static_cast<int>(number)))
        {
          continue; // A ray crosses a plane once.
        }
        const auto pair = static_cast<int>(this->Pairs.size());
        this->Pairs.push_back(ray);
        this->Solver.Add(
          selection, { cell, set.AreInTetrahedra, static_cast<int>(number) }, pair, pair + 1);
        if (this->Solver.IsFull())
        {
          this->Solve(selection, hits);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
void LoneTracer::Solve(const MeshSelection& selection, HitsOfRays& hits)
{
  this->Solver.Solve(selection, this->Pairs.data(), hits);
  this->Pairs.clear();
}

}
