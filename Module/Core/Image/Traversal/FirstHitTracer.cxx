// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Traversal/FirstHitTracer.h"

#include "Image/Cells/CellSegment.h"
#include "Image/Traversal/CandidateSets.h"

#include <utility>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
const PacketHits& FirstHitTracer::FindFirstHits(
  const RayPacket& packet, FirstHitCells& cells, const ScaledIsovalue& isovalue)
{
  this->Source = &cells;
  this->Isovalue = isovalue;
  this->SolvesAtOnce = cells.SolvesAtOnce();
  this->Waiting.Count = 0;
  this->SurelyHit[0] = {};
  this->SurelyHit[1] = {};
  this->Hits.Found = {};
  this->TraceQueued(packet, cells, cells.GetCorners(), Order::Nearest);
  this->SolveCandidates();
  return this->Hits;
}

//------------------------------------------------------------------------------
/// There are so few that they are solved one by one.
void FirstHitTracer::AddCroppedCells(const Frustum& frustum, const Index3& /*block*/, int first)
{
  for (int passage = first; passage < this->Passed.Count; ++passage)
  {
    const int ray = this->Passed.Segments[passage].Ray;
    this->ForEachCell(
      frustum.Axis, passage, [this, ray](const Index3& cell) { this->FindFirstHit(ray, cell); });
  }
  this->Passed.Count = first;
  --this->Passed.BlockCount;
}

//------------------------------------------------------------------------------
void FirstHitTracer::EndQueuedSlice(const Frustum& /*frustum*/)
{
  for (int word = 0; word < 2; ++word)
  {
    this->Going.Words[word] &= ~(this->SurelyHit[0].Words[word] | this->SurelyHit[1].Words[word] |
      this->Hits.Found.Words[word]);
  }
}

//------------------------------------------------------------------------------
int FirstHitTracer::KeepNeeded(const Frustum& frustum, int* passages, int count) const
{
  if (this->SolvesAtOnce)
  {
    return KeepOthers(
      [this, &frustum](int passage)
      {
        return this->Passed.Hits[passage] ||
          (Has(this->Hits.Found, this->Passed.Segments[passage].Ray) &&
            this->IsBehindHit(frustum, passage));
      },
      passages, count);
  }
  return KeepOthers([this](int passage) { return this->Passed.Hits[passage]; }, passages, count);
}

//------------------------------------------------------------------------------
/// Whether the slices that are left of a passage are behind the one in which the ray has a hit,
/// which may be in another block.
bool FirstHitTracer::IsBehindHit(const Frustum& frustum, int passage) const
{
  const auto axis = static_cast<std::size_t>(frustum.Axis);
  const Passages::Segment& segment = this->Passed.Segments[passage];
  const unsigned int slices = this->Passed.Slices[passage];
  const int next = this->Passed.First[segment.Block][axis] +
    (frustum.IsUp ? LowestBit(slices) : HighestBit(slices));
  const int hit =
    this->Lattice.GetCell(this->Hits.Hits[static_cast<std::size_t>(segment.Ray)])[axis];
  return frustum.IsUp ? hit < next : next < hit;
}

//------------------------------------------------------------------------------
void FirstHitTracer::TakeQueue(const Frustum& frustum)
{
  if (!this->AllInRows)
  {
    // Waiting candidates are read from rows, new ones from copies.
    this->SolveCandidates();
    this->Corners->Copy(this->Queue, frustum.Axis, this->Passed);
    this->AreCopied = true;
  }
  this->Source->ClassifyCells(
    this->Queue, frustum.Axis, this->AreCopied, this->Passed, this->Waiting, this->SurelyHit);
  if (this->AreCopied || this->SolvesAtOnce || this->Waiting.Count >= Candidates::Batch)
  {
    this->SolveCandidates();
    this->AreCopied = false;
  }
}

//------------------------------------------------------------------------------
void FirstHitTracer::SolveCandidates()
{
  if (this->Waiting.Count == 0)
  {
    return;
  }
  this->LoadCorners(this->AreCopied, this->Waiting);
  this->Source->Solve(*this->Packet, this->Waiting, this->Planes, this->Isovalue, this->Solved);
  this->KeepSolutions();
  this->Waiting.Count = 0;
}

//------------------------------------------------------------------------------
void FirstHitTracer::KeepSolutions()
{
  ForEachCandidate(this->Solved.Found,
    [this](int candidate)
    {
      this->Keep(this->Waiting.Ray[candidate], this->GetHit(candidate),
        { this->Solved.Begin[candidate], static_cast<int>(this->Solved.BeginAxis[candidate]) });
    });
  ForEachCandidate(this->Solved.Extreme,
    [this](int candidate)
    { this->FindFirstHit(this->Waiting.Ray[candidate], this->GetCell(candidate)); });
}

//------------------------------------------------------------------------------
Index3 FirstHitTracer::GetCell(int candidate) const
{
  const Candidates& candidates = this->Waiting;
  return { candidates.Cell[0][candidate], candidates.Cell[1][candidate],
    candidates.Cell[2][candidate] };
}

//------------------------------------------------------------------------------
Hit FirstHitTracer::GetHit(int candidate) const
{
  const Solutions& solved = this->Solved;
  return { solved.T[candidate], this->Lattice.GetNumber(this->GetCell(candidate)), 0,
    { solved.Parametric[0][candidate], solved.Parametric[1][candidate],
      solved.Parametric[2][candidate] },
    HasCandidate(solved.Entering, candidate) };
}

//------------------------------------------------------------------------------
/// Solves a cell that the kernels do not.
void FirstHitTracer::FindFirstHit(int ray, const Index3& cell)
{
  Hit hit;
  Crossing begin;
  if (this->Source->FindFirstHit(ray, cell, hit, begin))
  {
    this->Keep(ray, hit, begin);
  }
}

//------------------------------------------------------------------------------
/// Keeps a hit of a ray, unless it has one in an earlier cell.
void FirstHitTracer::Keep(int ray, const Hit& hit, const Crossing& begin)
{
  const auto number = static_cast<std::size_t>(ray);
  // To find cells takes divisions: only for those that are entered at one place.
  if (!Has(this->Hits.Found, ray) || begin < this->Hits.Begin[number] ||
    (!(this->Hits.Begin[number] < begin) &&
      IsEnteredBefore(this->Lattice.GetCell(hit), begin,
        this->Lattice.GetCell(this->Hits.Hits[number]), this->Hits.Begin[number],
        this->Packet->GetDirection(ray))))
  {
    Add(ray, this->Hits.Found);
    this->Hits.Hits[number] = hit;
    this->Hits.Begin[number] = begin;
  }
}

}
