// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/BeamTracer.h"

#include "Math/Arithmetic.h"
#include "Math/Compiler.h"

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int GroupSize = BeamRays::GroupSize;

}

//------------------------------------------------------------------------------
RaySet BeamTracer::Trace(const MeshSelection& selection, const RayPacket& packet,
  const Departure* departures, MeshBeam& beam, HitsOfRays& hits)
{
  this->Packet = &packet;
  this->Solver.Begin(selection, packet, departures, false);
  this->Enter(selection, beam.GetFrame());
  if (this->AreFarApart(selection, beam.GetFrame()))
  {
    return {};
  }
  for (std::size_t next = 0;
       next < beam.GetNumberOfSets() || this->FindMore(selection, beam, hits);)
  {
    const std::size_t first = next / MeshBeam::GroupSize * MeshBeam::GroupSize;
    for (unsigned int passed = beam.FindPassed(selection, this->Rays, next); passed != 0;
         passed &= passed - 1)
    {
      if (beam.IsFull())
      {
        this->Solve(selection, beam, hits);
        beam.Forget();
      }
      const int set = beam.Load(selection, first + static_cast<std::size_t>(LowestBit(passed)));
      if (beam.HasLittleInCommon())
      {
        beam.End();
        return {};
      }
      selection.PacketKernels->FindPairs(
        beam.GetPieces(set), set * BeamPieces::Capacity, this->Rays, this->Pairs);
      if (this->Pairs.Count >= BeamPairs::Batch ||
        this->Pairs.UnsureCount >= BeamPairs::BatchOfUnsure)
      {
        this->Solve(selection, beam, hits);
      }
    }
  }
  this->Solve(selection, beam, hits);
  return this->Solver.GetFramed().InBeam;
}

//------------------------------------------------------------------------------
void BeamTracer::Enter(const MeshSelection& selection, const BeamFrame& frame)
{
  const RayPacket& packet = *this->Packet;
  this->PlaceRays();
  selection.PacketKernels->FrameRays(
    packet, frame.GetNumbers(), this->Solver.GetFramed(), this->Rays);
  this->Pairs.Count = 0;
  this->Pairs.UnsureCount = 0;
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
  for (int place = 0; place < RayPacket::Capacity; ++place)
  {
    const int square = place / GroupSize;
    const int across = isCut ? columns / edge : 1;
    const int x = square % across * edge + place % edge;
    const int y = square / across * edge + place % GroupSize / edge;
    this->Rays.Ray[place] = isCut && place < count ? x + columns * y : place;
  }
}

//------------------------------------------------------------------------------
/// Whether the rays that are in the beam are, as in a picture of a mesh with more cells than
/// pixels, or where neighbours in the packet are nowhere near: a piece is looked at for all rays of
/// a group if it is between any of them.
bool BeamTracer::AreFarApart(const MeshSelection& selection, const BeamFrame& frame)
{
  constexpr double mostTetrahedra = 1.5;
  // In the beam labels are from -1 to 1.
  const double half = 0.5 * frame.GetWidth();
  double cells = 0.0;
  for (int group = 0; group < BeamRays::Groups; ++group)
  {
    double extent[2];
    for (int k = 0; k < 2; ++k)
    {
      extent[k] = half *
        (static_cast<double>(this->Rays.Upper[k][group]) -
          static_cast<double>(this->Rays.Lower[k][group]));
    }
    // Groups without rays have bounds the other way round.
    const bool hasRays = !(extent[0] < 0.0);
    cells += hasRays ? MeshBeam::CountCells(selection, extent[0], extent[1]) : 0.0;
  }
  return MeshBeam::AreFarApart(
    selection, cells, CountOf(this->Solver.GetFramed().InBeam), mostTetrahedra);
}

//------------------------------------------------------------------------------
/// Finds further sets of the beam. Returns false if there are none before the rays end.
bool BeamTracer::FindMore(const MeshSelection& selection, MeshBeam& beam, HitsOfRays& hits)
{
  // They begin behind the ends of all rays that surely hit. The others may end before, too, but
  // must be solved for that.
  if (this->Pairs.UnsureCount > 0 && this->Rays.EndOfSure > -FloatInfinity &&
    this->Rays.EndOfSure < beam.GetNextDepth())
  {
    this->Solve(selection, beam, hits);
  }
  return beam.FindMore(selection, this->Rays.EndOfAll);
}

//------------------------------------------------------------------------------
/// Solves the pairs, and ends the rays at their hits.
void BeamTracer::Solve(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits)
{
  if (this->Pairs.Count == 0)
  {
    return;
  }
  this->RemovePairsBehindEnds();
  for (int pair = 0; pair < this->Pairs.Count;)
  {
    if (this->Solver.IsFull())
    {
      this->Solver.Solve(selection, this->RayOfPair, hits);
    }
    this->AddCell(selection, beam, pair);
  }
  this->Solver.Solve(selection, this->RayOfPair, hits);
  this->Pairs.Count = 0;
  this->Pairs.UnsureCount = 0;
  const RaySet missed = selection.PacketKernels->EndRays(
    *this->Packet, beam.GetFrame().GetNumbers(), this->Solver.GetEnds(), this->Rays);
  RaySet& inBeam = this->Solver.GetFramed().InBeam;
  inBeam = Without(inBeam, missed);
}

//------------------------------------------------------------------------------
void BeamTracer::RemovePairsBehindEnds()
{
  int kept = 0;
  for (int i = 0; i < this->Pairs.Count; ++i)
  {
    const int place = this->Pairs.Place[i];
    this->RayOfPair[kept] = this->Rays.Ray[place];
    this->Pairs.Piece[kept] = this->Pairs.Piece[i];
    kept += this->Pairs.Near[i] <= this->Rays.End[place] ? 1 : 0;
  }
  this->Pairs.Count = kept;
}

//------------------------------------------------------------------------------
/// Adds the cell of a pair for all pairs with it, which follow each other. Moves on behind them.
void BeamTracer::AddCell(const MeshSelection& selection, const MeshBeam& beam, int& pair)
{
  const int piece = this->Pairs.Piece[pair];
  const int first = pair;
  while (pair < this->Pairs.Count && this->Pairs.Piece[pair] == piece)
  {
    ++pair;
  }
  this->Solver.Add(selection,
    { beam.GetCell(selection, piece), beam.IsInTetrahedron(piece), beam.GetSurface(piece) }, first,
    pair);
}

}
