// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/PairSolver.h"

#include "Math/Compiler.h"
#include "Mesh/BeamFrame.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void PairSolver::Begin(const MeshSelection& selection, const RayPacket& packet,
  const Departure* departures, bool boundsHulls)
{
  this->Packet = &packet;
  this->Departures = departures;
  this->BoundsHulls = boundsHulls;
  std::copy_n(packet.End, RayPacket::Capacity, this->Ends);
  if (departures)
  {
    const double nearStart = StoppedRays::NearStart * selection.CellSize;
    ForEachRay(packet.Exists,
      [&](int ray) { this->EndsOfStarts[ray] = nearStart / Length(packet.GetDirection(ray)); });
  }
}

//------------------------------------------------------------------------------
void PairSolver::Add(
  const MeshSelection& selection, const PassedCell& cell, int firstPair, int endOfPairs)
{
  selection.Cells->Prefetch(cell.Number);
  PairedCells& cells = cell.IsTetrahedron ? this->Tetrahedra : this->Trilinear;
  cells.Cells[cells.Count] = cell.Number;
  cells.Surfaces[cells.Count] = cell.Surface;
  cells.FirstPair[cells.Count] = firstPair;
  cells.EndOfPairs[cells.Count++] = endOfPairs;
}

//------------------------------------------------------------------------------
void PairSolver::Solve(const MeshSelection& selection, const int* rays, HitsOfRays& hits)
{
  this->SolveTetrahedra(selection, rays, hits);
  this->SolveTrilinear(selection, rays, hits);
  this->Tetrahedra.Clear();
  this->Trilinear.Clear();
}

//------------------------------------------------------------------------------
/// Takes as many of the pairs with cells as are solved at once.
template <typename CellPairs>
void PairSolver::Take(PairedCells& cells, const int* rays, CellPairs& pairs)
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
      pairs.Ray[pairs.Count] = rays[pair];
      pairs.Cell[pairs.Count++] = cells.Taken;
    }
    ++cells.Taken;
    cells.Next += pair == end ? 1 : 0;
  }
}

//------------------------------------------------------------------------------
/// From the values at the corners.
template <int Corners>
void PairSolver::FindDifferences(
  const MeshSelection& selection, const PairedCells& cells, double (*corners)[Corners][4])
{
  for (int i = 0; i < cells.Taken; ++i)
  {
    const auto number = static_cast<std::size_t>(cells.Surfaces[cells.FirstTaken + i]);
    const MeshSurface& surface = selection.Surfaces[number];
    SubtractIsovalue(surface.Isovalue, surface.Scale, corners[i]);
  }
}

//------------------------------------------------------------------------------
void PairSolver::SolveTetrahedra(const MeshSelection& selection, const int* rays, HitsOfRays& hits)
{
  PairedCells& cells = this->Tetrahedra;
  selection.Cells->ReadCornerIds(cells.Cells, cells.Count, this->Orders, this->Ids);
  while (cells.Next < cells.Count)
  {
    Take(cells, rays, this->InTetrahedra);
    selection.Cells->LoadTetrahedra(
      this->Ids + cells.FirstTaken, cells.Taken, this->InTetrahedra.Corners);
    FindDifferences(selection, cells, this->InTetrahedra.Corners);
    selection.PacketKernels->SolveTetrahedra(this->Framed, this->InTetrahedra);
    this->KeepHits(selection, hits);
  }
}

//------------------------------------------------------------------------------
/// Field by field: the numbers come from many places.
inline void PairSolver::MakeHit(int pair, double base, Hit& hit) const
{
  const TetrahedronPairs& pairs = this->InTetrahedra;
  const int cell = this->Tetrahedra.FirstTaken + pairs.Cell[pair];
  hit.T = base + pairs.T[pair];
  hit.Cell = this->Tetrahedra.Cells[cell];
  hit.Surface = this->Tetrahedra.Surfaces[cell];
  hit.Parametric =
    this->Orders[cell].GetParametric(&pairs.Weights[0][pair], TetrahedronPairs::Capacity);
  hit.Entering = (pairs.Entering >> pair & 1) != 0;
}

//------------------------------------------------------------------------------
/// Keeps those in tetrahedra.
void PairSolver::KeepHits(const MeshSelection& selection, HitsOfRays& hits)
{
  const TetrahedronPairs& pairs = this->InTetrahedra;
  for (std::uint64_t left = pairs.Found; left != 0; left &= left - 1)
  {
    const int pair = LowestBit(left);
    const int ray = pairs.Ray[pair];
    RayPart part = this->GetPart(ray);
    if (!part.Has(pairs.T[pair]))
    {
      continue;
    }
    Hit& hit = hits.Add(ray);
    this->MakeHit(pair, part.Base, hit);
    if (!KeepHit(selection, hit, pairs.T[pair], part))
    {
      hits.Remove(ray);
    }
    else if (part.End < this->Ends[ray])
    {
      this->Ends[ray] = part.End;
      hits.RemoveBeyond(ray, part.Base + part.End);
    }
  }
  for (std::uint64_t left = pairs.Extreme; left != 0; left &= left - 1)
  {
    const int pair = LowestBit(left);
    this->SolveByItself(selection, this->Tetrahedra, this->Tetrahedra.FirstTaken + pairs.Cell[pair],
      pairs.Ray[pair], hits);
  }
}

//------------------------------------------------------------------------------
void PairSolver::SolveTrilinear(const MeshSelection& selection, const int* rays, HitsOfRays& hits)
{
  PairedCells& cells = this->Trilinear;
  while (cells.Next < cells.Count)
  {
    Take(cells, rays, this->InTrilinear);
    selection.Cells->LoadTrilinear(
      cells.Cells + cells.FirstTaken, cells.Taken, this->InTrilinear.Corners);
    FindDifferences(selection, cells, this->InTrilinear.Corners);
    selection.PacketKernels->SolveTrilinear(this->Framed, this->InTrilinear);
    this->KeepTrilinearHits(selection, hits);
  }
}

//------------------------------------------------------------------------------
void PairSolver::KeepTrilinearHits(const MeshSelection& selection, HitsOfRays& hits)
{
  const TrilinearPairs& pairs = this->InTrilinear;
  for (int pair = 0; pair < pairs.Count; ++pair)
  {
    const TrilinearSolutions& solutions = pairs.Solutions[pair];
    const int number = this->Trilinear.FirstTaken + pairs.Cell[pair];
    const int ray = pairs.Ray[pair];
    if (!solutions.AreCertain)
    {
      if (!this->BoundsHulls || this->IsWithinHull(selection, number, ray))
      {
        this->SolveByItself(selection, this->Trilinear, number, ray, hits, &solutions);
      }
      continue;
    }
    const std::uint32_t cell = this->Trilinear.Cells[number];
    RayPart part = this->GetPart(ray);
    for (int i = 0; i < solutions.Count; ++i)
    {
      const CellHit found = MakeCellHit(selection.Cells->GetShape(cell), solutions, i);
      const Hit hit = { part.Base + found.T, cell, this->Trilinear.Surfaces[number],
        found.Parametric, found.Entering };
      if (part.Has(found.T) && KeepHit(selection, hit, found.T, part))
      {
        hits.Add(ray) = hit;
      }
    }
    this->Ends[ray] = part.End;
  }
}

//------------------------------------------------------------------------------
/// Whether a ray may meet the hull of a piece, as the pairs of beams do: where a ray passes an
/// edge, what rounding decides about may lie beside the surface, in two cells or in none.
bool PairSolver::IsWithinHull(const MeshSelection& selection, int number, int ray)
{
  const auto surface = static_cast<std::size_t>(this->Trilinear.Surfaces[number]);
  BeamFrame frame;
  return !frame.FindAlone(*this->Packet, ray, selection.Tree->GetBounds()) ||
    this->Hulls.IsMet(
      selection, selection.Surfaces[surface], this->Trilinear.Cells[number], frame.GetNumbers());
}

//------------------------------------------------------------------------------
void PairSolver::SolveByItself(const MeshSelection& selection, const PairedCells& cells, int number,
  int ray, HitsOfRays& hits, const TrilinearSolutions* solutions)
{
  RayPart part = this->GetPart(ray);
  this->HitsInCell.clear();
  KeepHitsInCell(selection, RayFrame(this->Packet->GetOrigin(ray), this->Packet->GetDirection(ray)),
    cells.Cells[number], cells.Surfaces[number], this->InCell, part, this->HitsInCell, solutions);
  for (const Hit& hit : this->HitsInCell)
  {
    hits.Add(ray) = hit;
  }
  this->Ends[ray] = part.End;
}

}
