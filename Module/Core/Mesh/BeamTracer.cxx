// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/BeamTracer.h"

#include "Math/Arithmetic.h"
#include "Math/Compiler.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{
namespace
{

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
  hits.Clear();
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
  return this->Framed.InBeam;
}

//------------------------------------------------------------------------------
void BeamTracer::Enter(const MeshSelection& selection, const BeamFrame& frame)
{
  const RayPacket& packet = *this->Packet;
  this->PlaceRays();
  selection.PacketKernels->FrameRays(packet, frame.GetNumbers(), this->Framed, this->Rays);
  std::copy_n(packet.End, RayPacket::Capacity, this->Ends);
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
  for (int i = 0; i < this->Pairs.Count;)
  {
    i = this->FindCells(selection, beam, i);
    this->SolveTetrahedra(selection, beam, hits);
    this->SolveTrilinear(selection, beam, hits);
  }
  this->Pairs.Count = 0;
  this->Pairs.UnsureCount = 0;
  const RaySet missed = selection.PacketKernels->EndRays(
    *this->Packet, beam.GetFrame().GetNumbers(), this->Ends, this->Rays);
  for (std::size_t word = 0; word < 2; ++word)
  {
    this->Framed.InBeam.Words[word] &= ~missed.Words[word];
  }
}

//------------------------------------------------------------------------------
void BeamTracer::RemovePairsBehindEnds()
{
  int kept = 0;
  for (int i = 0; i < this->Pairs.Count; ++i)
  {
    const int place = this->Pairs.Place[i];
    this->Pairs.Place[kept] = place;
    this->Pairs.Piece[kept] = this->Pairs.Piece[i];
    kept += this->Pairs.Near[i] <= this->Rays.End[place] ? 1 : 0;
  }
  this->Pairs.Count = kept;
}

//------------------------------------------------------------------------------
/// Finds the cells of pairs, from one pair on. Returns the first pair of which the cell is not
/// among them: they are not more than there is room for.
int BeamTracer::FindCells(const MeshSelection& selection, const MeshBeam& beam, int pair)
{
  this->Tetrahedra.Clear();
  this->Trilinear.Clear();
  while (pair < this->Pairs.Count && !this->Tetrahedra.IsFull() && !this->Trilinear.IsFull())
  {
    // Pairs with one piece follow each other.
    const int piece = this->Pairs.Piece[pair];
    const int first = pair;
    while (pair < this->Pairs.Count && this->Pairs.Piece[pair] == piece)
    {
      ++pair;
    }
    const std::uint32_t cell = beam.GetCell(selection, piece);
    selection.Cells->Prefetch(cell);
    PairedCells& cells = beam.IsInTetrahedron(piece) ? this->Tetrahedra : this->Trilinear;
    cells.Add(cell, piece, first, pair);
  }
  return pair;
}

//------------------------------------------------------------------------------
/// Takes as many of the pairs with cells as are solved at once.
template <typename CellPairs>
void BeamTracer::Take(PairedCells& cells, CellPairs& pairs) const
{
  cells.FirstTaken = cells.Next;
  cells.Taken = 0;
  pairs.Count = 0;
  while (cells.Next < cells.Count && pairs.Count < CellPairs::Capacity)
  {
    int& pair = cells.FirstPair[cells.Next];
    const int end = cells.EndOfPairs[cells.Next];
    for (; pair < end && pairs.Count < CellPairs::Capacity; ++pair)
    {
      pairs.Ray[pairs.Count] = this->Rays.Ray[this->Pairs.Place[pair]];
      pairs.Cell[pairs.Count++] = cells.Taken;
    }
    ++cells.Taken;
    cells.Next += pair == end ? 1 : 0;
  }
}

//------------------------------------------------------------------------------
/// From the values at the corners.
template <int Corners>
void BeamTracer::FindDifferences(const MeshSelection& selection, const MeshBeam& beam,
  const PairedCells& cells, double (*corners)[Corners][4])
{
  for (int i = 0; i < cells.Taken; ++i)
  {
    const auto number =
      static_cast<std::size_t>(beam.GetSurface(cells.Pieces[cells.FirstTaken + i]));
    const MeshSurface& surface = selection.Surfaces[number];
    SubtractIsovalue(surface.Isovalue, surface.Scale, corners[i]);
  }
}

//------------------------------------------------------------------------------
void BeamTracer::SolveTetrahedra(
  const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits)
{
  PairedCells& cells = this->Tetrahedra;
  selection.Cells->ReadCornerIds(cells.Cells, cells.Count, this->Orders, this->Ids);
  while (cells.Next < cells.Count)
  {
    this->Take(cells, this->InTetrahedra);
    selection.Cells->LoadTetrahedra(
      this->Ids + cells.FirstTaken, cells.Taken, this->InTetrahedra.Corners);
    FindDifferences(selection, beam, cells, this->InTetrahedra.Corners);
    selection.PacketKernels->SolveTetrahedra(this->Framed, this->InTetrahedra);
    this->KeepHits(selection, beam, hits);
  }
}

//------------------------------------------------------------------------------
/// Keeps those in tetrahedra.
void BeamTracer::KeepHits(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits)
{
  const TetrahedronPairs& pairs = this->InTetrahedra;
  for (std::uint64_t left = pairs.Found; left != 0; left &= left - 1)
  {
    const int pair = LowestBit(left);
    const int ray = pairs.Ray[pair];
    RayPart part = this->GetPart(ray);
    if (part.Has(pairs.T[pair]))
    {
      Hit& hit = hits.Add(ray);
      this->MakeHit(beam, pair, hit);
      if (KeepHit(selection, hit, pairs.T[pair], part))
      {
        this->Ends[ray] = part.End;
        hits.RemoveBeyond(ray, part.Base + part.End);
      }
      else
      {
        hits.Remove(ray);
      }
    }
  }
  for (std::uint64_t left = pairs.Extreme; left != 0; left &= left - 1)
  {
    const int pair = LowestBit(left);
    const int piece = this->Tetrahedra.Pieces[this->Tetrahedra.FirstTaken + pairs.Cell[pair]];
    this->SolveByItself(selection, beam, piece, pairs.Ray[pair], hits);
  }
}

//------------------------------------------------------------------------------
/// Field by field: the numbers come from many places.
void BeamTracer::MakeHit(const MeshBeam& beam, int pair, Hit& hit) const
{
  const TetrahedronPairs& pairs = this->InTetrahedra;
  const int cell = this->Tetrahedra.FirstTaken + pairs.Cell[pair];
  hit.T = this->Packet->Base[pairs.Ray[pair]] + pairs.T[pair];
  hit.Cell = this->Tetrahedra.Cells[cell];
  hit.Surface = beam.GetSurface(this->Tetrahedra.Pieces[cell]);
  hit.Parametric =
    this->Orders[cell].GetParametric(&pairs.Weights[0][pair], TetrahedronPairs::Capacity);
  hit.Entering = (pairs.Entering >> pair & 1) != 0;
}

//------------------------------------------------------------------------------
void BeamTracer::SolveTrilinear(
  const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits)
{
  PairedCells& cells = this->Trilinear;
  while (cells.Next < cells.Count)
  {
    this->Take(cells, this->InTrilinear);
    selection.Cells->LoadTrilinear(
      cells.Cells + cells.FirstTaken, cells.Taken, this->InTrilinear.Corners);
    FindDifferences(selection, beam, cells, this->InTrilinear.Corners);
    selection.PacketKernels->SolveTrilinear(this->Framed, this->InTrilinear);
    this->KeepTrilinearHits(selection, beam, hits);
  }
}

//------------------------------------------------------------------------------
void BeamTracer::KeepTrilinearHits(
  const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits)
{
  const TrilinearPairs& pairs = this->InTrilinear;
  for (int pair = 0; pair < pairs.Count; ++pair)
  {
    const TrilinearSolutions& solutions = pairs.Solutions[pair];
    const int number = this->Trilinear.FirstTaken + pairs.Cell[pair];
    const int piece = this->Trilinear.Pieces[number];
    const int ray = pairs.Ray[pair];
    if (!solutions.AreCertain)
    {
      this->SolveByItself(selection, beam, piece, ray, hits);
      continue;
    }
    const std::uint32_t cell = this->Trilinear.Cells[number];
    RayPart part = this->GetPart(ray);
    for (int i = 0; i < solutions.Count; ++i)
    {
      const CellHit found = MakeCellHit(selection.Cells->GetShape(cell), solutions, i);
      const Hit hit = { part.Base + found.T, cell, beam.GetSurface(piece), found.Parametric,
        found.Entering };
      if (part.Has(found.T) && KeepHit(selection, hit, found.T, part))
      {
        hits.Add(ray) = hit;
      }
    }
    this->Ends[ray] = part.End;
  }
}

//------------------------------------------------------------------------------
void BeamTracer::SolveByItself(
  const MeshSelection& selection, const MeshBeam& beam, int piece, int ray, HitsOfRays& hits)
{
  RayPart part = this->GetPart(ray);
  this->HitsInCell.clear();
  KeepHitsInCell(selection, GetFrame(*this->Packet, ray), beam.GetCell(selection, piece),
    beam.GetSurface(piece), this->InCell, part, this->HitsInCell);
  for (const Hit& hit : this->HitsInCell)
  {
    hits.Add(ray) = hit;
  }
  this->Ends[ray] = part.End;
}

}
