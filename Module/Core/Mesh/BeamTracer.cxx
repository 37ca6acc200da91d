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
  this->Pairs.Count = 0;
  this->InTetrahedra.Count = 0;
  this->InTrilinear.Count = 0;
  hits.Clear();
  for (std::size_t next = 0;
       next < beam.GetNumberOfSets() || beam.FindMore(selection, this->Rays.EndOfAll);)
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
      if (this->Pairs.Count >= BeamPairs::Batch)
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
  this->Shortened = (1U << BeamRays::Groups) - 1U;
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
/// Finds the ends of the groups with rays that were shortened, and that of all.
void BeamTracer::FindEnds()
{
  for (; this->Shortened != 0; this->Shortened &= this->Shortened - 1)
  {
    const int group = LowestBit(this->Shortened);
    const float* ends = this->Rays.End + group * GroupSize;
    this->Rays.GroupEnd[group] = *std::max_element(ends, ends + GroupSize);
  }
  this->Rays.EndOfAll =
    *std::max_element(this->Rays.GroupEnd, this->Rays.GroupEnd + BeamRays::Groups);
}

//------------------------------------------------------------------------------
void BeamTracer::Shorten(const BeamFrame& frame, int place)
{
  const int ray = this->Rays.Ray[place];
  this->Rays.End[place] = frame.GetEnd(*this->Packet, ray, this->Parts[ray].End);
  this->Shortened |= 1U << (place / GroupSize);
}

//------------------------------------------------------------------------------
/// Solves the pairs, and ends the rays at their hits.
void BeamTracer::Solve(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits)
{
  // Pairs with one piece follow each other.
  for (int i = 0; i < this->Pairs.Count;)
  {
    const int first = i;
    const int piece = this->Pairs.Piece[first];
    while (i < this->Pairs.Count && this->Pairs.Piece[i] == piece)
    {
      ++i;
    }
    const int* places = &this->Pairs.Place[first];
    if (beam.IsInTetrahedron(piece))
    {
      this->Add(
        selection, beam, piece, places, i - first, this->InTetrahedra, this->Tetrahedra, hits);
    }
    else
    {
      this->Add(
        selection, beam, piece, places, i - first, this->InTrilinear, this->Trilinear, hits);
    }
  }
  this->SolveTetrahedra(selection, beam, hits);
  this->SolveTrilinear(selection, beam, hits);
  this->Pairs.Count = 0;
  this->FindEnds();
}

//------------------------------------------------------------------------------
template <typename CellPairs>
void BeamTracer::Add(const MeshSelection& selection, const MeshBeam& beam, int piece,
  const int* places, int count, CellPairs& pairs, PairedCells& cells, HitsOfRays& hits)
{
  for (int i = 0; i < count;)
  {
    if (pairs.Count == CellPairs::Capacity)
    {
      this->SolveTetrahedra(selection, beam, hits);
      this->SolveTrilinear(selection, beam, hits);
    }
    const int cell = cells.Count++;
    cells.Cells[cell] = beam.GetCell(selection, piece);
    cells.Pieces[cell] = piece;
    selection.Cells->Prefetch(cells.Cells[cell]);
    for (; i < count && pairs.Count < CellPairs::Capacity; ++i)
    {
      cells.Places[pairs.Count] = places[i];
      pairs.Ray[pairs.Count] = this->Rays.Ray[places[i]];
      pairs.Cell[pairs.Count++] = cell;
    }
  }
}

//------------------------------------------------------------------------------
/// From the values at the corners.
template <int Corners>
void BeamTracer::FindDifferences(const MeshSelection& selection, const MeshBeam& beam,
  const PairedCells& cells, double (*corners)[Corners][4])
{
  for (int i = 0; i < cells.Count; ++i)
  {
    const auto number = static_cast<std::size_t>(beam.GetSurface(cells.Pieces[i]));
    const MeshSurface& surface = selection.Surfaces[number];
    SubtractIsovalue(surface.Isovalue, surface.Scale, corners[i]);
  }
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
  PairedCells& cells = this->Tetrahedra;
  selection.Cells->LoadTetrahedra(cells.Cells, cells.Count, this->Orders, pairs.Corners);
  FindDifferences(selection, beam, cells, pairs.Corners);
  selection.PacketKernels->SolveTetrahedra(this->Framed, pairs);
  for (std::uint64_t left = pairs.Found; left != 0; left &= left - 1)
  {
    const int pair = LowestBit(left);
    const int ray = pairs.Ray[pair];
    RayPart& part = this->Parts[ray];
    if (part.Has(pairs.T[pair]))
    {
      Hit& hit = hits.Add(ray);
      this->MakeHit(beam, pair, hit);
      if (KeepHit(selection, hit, pairs.T[pair], part))
      {
        hits.RemoveBeyond(ray, part.Base + part.End);
        this->Shorten(beam.GetFrame(), cells.Places[pair]);
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
    this->SolveByItself(selection, beam, cells.Pieces[pairs.Cell[pair]], cells.Places[pair], hits);
  }
  pairs.Count = 0;
  cells.Count = 0;
}

//------------------------------------------------------------------------------
/// Field by field: the numbers come from many places.
void BeamTracer::MakeHit(const MeshBeam& beam, int pair, Hit& hit) const
{
  const TetrahedronPairs& pairs = this->InTetrahedra;
  const int cell = pairs.Cell[pair];
  hit.T = this->Parts[pairs.Ray[pair]].Base + pairs.T[pair];
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
  TrilinearPairs& pairs = this->InTrilinear;
  if (pairs.Count == 0)
  {
    return;
  }
  PairedCells& cells = this->Trilinear;
  selection.Cells->LoadTrilinear(cells.Cells, cells.Count, pairs.Corners);
  FindDifferences(selection, beam, cells, pairs.Corners);
  selection.PacketKernels->SolveTrilinear(this->Framed, pairs);
  for (int pair = 0; pair < pairs.Count; ++pair)
  {
    const TrilinearSolutions& solutions = pairs.Solutions[pair];
    const int piece = cells.Pieces[pairs.Cell[pair]];
    const int place = cells.Places[pair];
    if (!solutions.AreCertain)
    {
      this->SolveByItself(selection, beam, piece, place, hits);
      continue;
    }
    const std::uint32_t cell = cells.Cells[pairs.Cell[pair]];
    RayPart& part = this->Parts[pairs.Ray[pair]];
    for (int i = 0; i < solutions.Count; ++i)
    {
      const CellHit found = MakeCellHit(selection.Cells->GetShape(cell), solutions, i);
      const Hit hit = { part.Base + found.T, cell, beam.GetSurface(piece), found.Parametric,
        found.Entering };
      if (part.Has(found.T) && KeepHit(selection, hit, found.T, part))
      {
        hits.Add(pairs.Ray[pair]) = hit;
        this->Shorten(beam.GetFrame(), place);
      }
    }
  }
  pairs.Count = 0;
  cells.Count = 0;
}

//------------------------------------------------------------------------------
void BeamTracer::SolveByItself(
  const MeshSelection& selection, const MeshBeam& beam, int piece, int place, HitsOfRays& hits)
{
  const int ray = this->Rays.Ray[place];
  this->HitsInCell.clear();
  KeepHitsInCell(selection, GetFrame(*this->Packet, ray), beam.GetCell(selection, piece),
    beam.GetSurface(piece), this->InCell, this->Parts[ray], this->HitsInCell);
  for (const Hit& hit : this->HitsInCell)
  {
    hits.Add(ray) = hit;
    this->Shorten(beam.GetFrame(), place);
  }
}

}
