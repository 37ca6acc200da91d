// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/LoneTracer.h"

#include "Math/Compiler.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
RaySet LoneTracer::Trace(
  const MeshSelection& selection, const RayPacket& packet, const RaySet& rays, HitsOfRays& hits)
{
  this->Packet = &packet;
  this->Ways.resize(RayPacket::Capacity);
  this->Solver.Begin(packet);
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
  if (!frame.Find(*this->Packet, alone, selection.Tree->GetBounds()))
  {
    return false;
  }
  Way& way = this->Ways[static_cast<std::size_t>(ray)];
  way.Frame = frame.GetNumbers();
  way.Begin = frame.FindBegin(*this->Packet, alone);
  BeamProjection projection = frame.GetProjection();
  projection.Begin = way.Begin;
  way.Nodes.Begin(selection, projection);
  return true;
}

//------------------------------------------------------------------------------
/// The depth that a ray ends at by what it has hit.
float LoneTracer::FindEnd(int ray) const
{
  const BeamNumbers& frame = this->Ways[static_cast<std::size_t>(ray)].Frame;
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
    const PackedPieces* all = surface.Pieces->Get(leaf, *selection.PacketKernels);
    for (int first = 0; first < all->Sets; first += CellTree::Width)
    {
      LabelBounds bounds;
      const PackedPieces* sets = all + first;
      unsigned int met =
        way.Nodes.FindSets(selection, sets, std::min(all->Sets - first, CellTree::Width), bounds);
      for (; met != 0; met &= met - 1)
      {
        const PackedPieces& set = sets[LowestBit(met)];
        unsigned int pieces = bounds.Near[LowestBit(met)] <= way.End
          ? selection.PacketKernels->FindPiecesOnRay(set, way.Frame, way.Begin, way.End)
          : 0;
        if (pieces != 0 && !set.AreInTetrahedra)
        {
          pieces = this->FindWithinHulls(selection, way, leaf, surface, set, pieces);
        }
        for (; pieces != 0; pieces &= pieces - 1)
        {
          const auto pair = static_cast<int>(this->Pairs.size());
          this->Pairs.push_back(ray);
          this->Solver.Add(selection,
            { selection.Tree->GetCellOfLeaf(leaf, set.Cells[LowestBit(pieces)]),
              set.AreInTetrahedra, static_cast<int>(number) },
            pair, pair + 1);
          if (this->Solver.IsFull())
          {
            this->Solve(selection, hits);
          }
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Of pieces in trilinear cells whose boxes a ray meets, those whose hulls it may meet. These must
/// be as narrow as they are in beams: where a ray passes an edge, what rounding decides about may
/// lie beside the surface, in two cells or in none.
unsigned int LoneTracer::FindWithinHulls(const MeshSelection& selection, const Way& way,
  std::size_t leaf, const MeshSurface& surface, const PackedPieces& set, unsigned int pieces)
{
  int numbers[PackedPieces::Capacity];
  std::uint32_t cells[PackedPieces::Capacity] = {};
  int count = 0;
  for (unsigned int left = pieces; left != 0; left &= left - 1)
  {
    numbers[count] = LowestBit(left);
    cells[count] = selection.Tree->GetCellOfLeaf(leaf, set.Cells[numbers[count]]);
    ++count;
  }
  this->Hulls.Bound(selection, surface, cells, count, way.Frame, this->InHulls);
  unsigned int within = 0;
  for (int i = 0; i < count; ++i)
  {
    // The label of the ray is 0.
    const LabelBounds& bounds = this->InHulls.Bounds;
    bool isWithin = bounds.Near[i] <= way.End;
    for (std::size_t k = 0; k < 2; ++k)
    {
      isWithin = isWithin && bounds.Lower[k][i] <= 0.0F && 0.0F <= bounds.Upper[k][i];
    }
    for (const auto& line : this->InHulls.Line)
    {
      isWithin = isWithin && line[2][i] >= 0.0F;
    }
    within |= static_cast<unsigned int>(isWithin) << numbers[i];
  }
  return within;
}

//------------------------------------------------------------------------------
void LoneTracer::Solve(const MeshSelection& selection, HitsOfRays& hits)
{
  this->Solver.Solve(selection, this->Pairs.data(), hits);
  this->Pairs.clear();
}

}
