// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/BeamTracer.h"

#include <algorithm>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr float FloatInfinity = std::numeric_limits<float>::infinity();
constexpr int GroupSize = BeamRays::GroupSize;

RayFrame GetFrame(const RayPacket& packet, int ray)
{
  return { { packet.Origin[0][ray], packet.Origin[1][ray], packet.Origin[2][ray] },
    packet.GetDirection(ray) };
}

}

//------------------------------------------------------------------------------
RaySet BeamTracer::Trace(
  const MeshSelection& selection, const RayPacket& packet, MeshBeam& beam, HitsOfRays& hits)
{
  this->Packet = &packet;
  this->Enter(selection, beam.GetFrame());
  this->Pairs.Count = 0;
  for (std::vector<Hit>& hitsOfRay : hits)
  {
    hitsOfRay.clear();
  }
  const Kernels& kernels = *selection.PacketKernels;
  for (std::size_t leaf = 0;
       leaf < beam.GetNumberOfLeaves() || beam.FindMore(selection, this->Rays.EndOfAll); ++leaf)
  {
    const MeshBeam::Leaf& found = beam.GetLeaf(leaf);
    const unsigned int passed = kernels.FindPassed(found.Bounds, found.Blocks, this->Rays);
    if (passed == 0)
    {
      continue;
    }
    if (beam.IsFull())
    {
      this->Solve(selection, beam, hits);
      beam.ForgetPieces();
    }
    beam.Load(selection, leaf, passed);
    for (int number = found.FirstSet; number != MeshBeam::NoSet;)
    {
      const MeshBeam::PieceSet& set = beam.GetSet(number);
      kernels.FindPairs(set.Pieces, set.First, this->Rays, this->Pairs);
      if (this->Pairs.Count >= BeamPairs::Batch)
      {
        this->Solve(selection, beam, hits);
      }
      number = set.Next;
    }
  }
  this->Solve(selection, beam, hits);
  return this->Framed.InBeam;
}

//------------------------------------------------------------------------------
void BeamTracer::Enter(const MeshSelection& selection, const BeamFrame& frame)
{
  const RayPacket& packet = *this->Packet;
  this->PlaceRays();
  selection.PacketKernels->FrameRays(packet, frame.GetNumbers(), this->Framed);
  std::fill_n(this->Rays.End, BeamRays::Capacity, -FloatInfinity);
  for (int place = 0; place < packet.Count; ++place)
  {
    const int ray = this->Rays.Ray[place];
    if (Has(this->Framed.InBeam, ray))
    {
      this->Parts[ray] = { packet.Begin[ray], packet.End[ray], packet.Base[ray] };
      this->Rays.Label[0][place] = static_cast<float>(this->Framed.Label[0][ray]);
      this->Rays.Label[1][place] = static_cast<float>(this->Framed.Label[1][ray]);
      this->Rays.End[place] = static_cast<float>(this->Framed.End[ray]);
    }
  }
  for (int group = 0; group < BeamRays::Groups; ++group)
  {
    for (std::size_t k = 0; k < 2; ++k)
    {
      float lower = FloatInfinity;
      float upper = -FloatInfinity;
      for (int place = group * GroupSize; place < (group + 1) * GroupSize; ++place)
      {
        const bool isThere = this->Rays.End[place] > -FloatInfinity;
        lower = isThere ? std::min(lower, this->Rays.Label[k][place]) : lower;
        upper = isThere ? std::max(upper, this->Rays.Label[k][place]) : upper;
      }
      this->Rays.Lower[k][group] = lower;
      this->Rays.Upper[k][group] = upper;
    }
  }
  for (std::size_t k = 0; k < 2; ++k)
  {
    const float* lower = this->Rays.Lower[k];
    const float* upper = this->Rays.Upper[k];
    this->Rays.LowerOfAll[k] = *std::min_element(lower, lower + BeamRays::Groups);
    this->Rays.UpperOfAll[k] = *std::max_element(upper, upper + BeamRays::Groups);
  }
  this->FindEnds();
}

//------------------------------------------------------------------------------
/// Finds the ray in each place: rays of a rectangle are grouped in squares of 4 x 4 pixels, if it
/// can be cut into such.
void BeamTracer::PlaceRays()
{
  constexpr int edge = 4;
  const int columns = this->Packet->Columns;
  const int count = this->Packet->Count;
  if (columns == this->PlacedColumns && count == this->PlacedCount)
  {
    return;
  }
  this->PlacedColumns = columns;
  this->PlacedCount = count;
  const bool isCut = columns > 0 && columns % edge == 0 && count % (columns * edge) == 0;
  for (int place = 0; place < count; ++place)
  {
    const int square = place / GroupSize;
    const int across = isCut ? columns / edge : 1;
    const int x = square % across * edge + place % edge;
    const int y = square / across * edge + place % GroupSize / edge;
    this->Rays.Ray[place] = isCut ? x + columns * y : place;
  }
}

//------------------------------------------------------------------------------
void BeamTracer::FindEnds()
{
  this->Rays.EndOfAll = -FloatInfinity;
  for (int group = 0; group < BeamRays::Groups; ++group)
  {
    const float* ends = this->Rays.End + group * GroupSize;
    this->Rays.GroupEnd[group] = *std::max_element(ends, ends + GroupSize);
    this->Rays.EndOfAll = std::max(this->Rays.EndOfAll, this->Rays.GroupEnd[group]);
  }
}

//------------------------------------------------------------------------------
/// Solves the pairs, and ends the rays at their hits.
void BeamTracer::Solve(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits)
{
  this->InTetrahedra.Count = 0;
  for (int i = 0; i < this->Pairs.Count; ++i)
  {
    const int ray = this->Rays.Ray[this->Pairs.Place[i]];
    const int piece = this->Pairs.Piece[i];
    const MeshBeam::PieceSet& set = beam.GetSetOf(piece);
    if (!set.AreTetrahedra)
    {
      this->SolveByItself(selection, beam, piece, ray, hits);
      continue;
    }
    const int pair = this->InTetrahedra.Count++;
    this->InTetrahedra.Ray[pair] = ray;
    this->InTetrahedra.Corners[pair] = set.Records.Corner[piece - set.First];
    this->InTetrahedra.Piece[pair] = piece;
    if (this->InTetrahedra.Count == TetrahedronPairs::Capacity)
    {
      this->SolveTetrahedra(selection, beam, hits);
    }
  }
  this->SolveTetrahedra(selection, beam, hits);
  for (int i = 0; i < this->Pairs.Count; ++i)
  {
    const int place = this->Pairs.Place[i];
    const int ray = this->Rays.Ray[place];
    this->Rays.End[place] = beam.GetFrame().GetEnd(*this->Packet, ray, this->Parts[ray].End);
  }
  this->Pairs.Count = 0;
  this->FindEnds();
}

//------------------------------------------------------------------------------
void BeamTracer::SolveTetrahedra(
  const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits)
{
  TetrahedronPairs& pairs = this->InTetrahedra;
  if (pairs.Count == 0)
  {
    return;
  }
  selection.PacketKernels->SolveTetrahedra(this->Framed, pairs);
  for (std::uint64_t left = pairs.Found; left != 0; left &= left - 1)
  {
    const int pair = __builtin_ctzll(left);
    const int ray = pairs.Ray[pair];
    const MeshBeam::PieceSet& set = beam.GetSetOf(pairs.Piece[pair]);
    const int number = pairs.Piece[pair] - set.First;
    const double weights[4] = { pairs.Weights[0][pair], pairs.Weights[1][pair],
      pairs.Weights[2][pair], pairs.Weights[3][pair] };
    const CellHit hit = { pairs.T[pair], set.Orders[number].GetParametric(weights),
      (pairs.Entering >> pair & 1) != 0 };
    KeepHit(selection, hit, set.Cells[number], set.Surface, this->Parts[ray],
      hits[static_cast<std::size_t>(ray)]);
  }
  for (std::uint64_t left = pairs.Extreme; left != 0; left &= left - 1)
  {
    const int pair = __builtin_ctzll(left);
    this->SolveByItself(selection, beam, pairs.Piece[pair], pairs.Ray[pair], hits);
  }
  pairs.Count = 0;
}

//------------------------------------------------------------------------------
void BeamTracer::SolveByItself(
  const MeshSelection& selection, const MeshBeam& beam, int piece, int ray, HitsOfRays& hits)
{
  const MeshBeam::PieceSet& set = beam.GetSetOf(piece);
  KeepHitsInCell(selection, GetFrame(*this->Packet, ray), set.Cells[piece - set.First], set.Surface,
    this->InCell, this->Parts[ray], hits[static_cast<std::size_t>(ray)]);
}

}
