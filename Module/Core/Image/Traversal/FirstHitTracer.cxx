// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Traversal/FirstHitTracer.h"

#include "Image/Cells/CellSegment.h"
#include "Math/Compiler.h"

#include <algorithm>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

bool HasCandidate(const std::uint64_t (&set)[Solutions::Words], int candidate)
{
  return (set[candidate / 64] >> (candidate % 64) & 1) != 0;
}

/// Calls visit(candidate) for the members of a set of Solutions, in order.
template <typename Visit>
void ForEachCandidate(const std::uint64_t (&set)[Solutions::Words], const Visit& visit)
{
  for (int word = 0; word < Solutions::Words; ++word)
  {
    for (std::uint64_t bits = set[word]; bits != 0; bits &= bits - 1)
    {
      visit(64 * word + LowestBit(bits));
    }
  }
}

}

//------------------------------------------------------------------------------
const PacketHits& FirstHitTracer::FindFirstHits(
  const RayPacket& packet, FirstHitCells& cells, const ScaledIsovalue& isovalue)
{
  this->Departures = nullptr;
  this->TraceSurface(packet, cells, isovalue);
  return this->Hits;
}

//------------------------------------------------------------------------------
const StoppedRays& FirstHitTracer::FindStopped(const RayPacket& packet, FirstHitCells& cells,
  const ScaledIsovalue& isovalue, const Departure* departures)
{
  this->Departures = departures;
  this->TraceSurface(packet, cells, isovalue);
  return this->Stopped;
}

//------------------------------------------------------------------------------
void FirstHitTracer::TraceSurface(
  const RayPacket& packet, FirstHitCells& cells, const ScaledIsovalue& isovalue)
{
  this->Source = &cells;
  this->Isovalue = isovalue;
  this->SolvesAtOnce = cells.SolvesAtOnce();
  this->Waiting.Count = 0;
  this->SurelyHit[0] = {};
  this->SurelyHit[1] = {};
  this->Stopped = {};
  this->Hits.Found = {};
  this->TraceQueued(
    packet, cells, cells.GetCorners(), this->Departures ? Order::Any : Order::FrontToBack);
  this->SolveCandidates();
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
    this->Going.Words[word] &= ~(this->Departures ? this->Stopped.Stopped.Words[word]
                                                  : this->SurelyHit[0].Words[word] |
          this->SurelyHit[1].Words[word] | this->Hits.Found.Words[word]);
  }
}

//------------------------------------------------------------------------------
int FirstHitTracer::KeepNeeded(const Frustum& frustum, int* passages, int count) const
{
  if (this->Departures)
  {
    return this->KeepOthers([this](int passage)
      { return Has(this->Stopped.Stopped, this->Passed.Segments[passage].Ray); },
      passages, count);
  }
  if (this->SolvesAtOnce)
  {
    return this->KeepOthers(
      [this, &frustum](int passage)
      {
        return this->Passed.Hits[passage] ||
          (Has(this->Hits.Found, this->Passed.Segments[passage].Ray) &&
            this->IsBehindHit(frustum, passage));
      },
      passages, count);
  }
  return this->KeepOthers(
    [this](int passage) { return this->Passed.Hits[passage]; }, passages, count);
}

//------------------------------------------------------------------------------
template <typename IsOver>
int FirstHitTracer::KeepOthers(const IsOver& isOver, int* passages, int count) const
{
  int kept = 0;
  for (int i = 0; i < count; ++i)
  {
    passages[kept] = passages[i];
    kept += isOver(passages[i]) ? 0 : 1;
  }
  return kept;
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
  if (this->Departures)
  {
    this->StopAtSureHits(frustum);
  }
  if (this->AreCopied || this->SolvesAtOnce || this->Waiting.Count >= Candidates::Batch)
  {
    this->SolveCandidates();
    this->AreCopied = false;
  }
}

//------------------------------------------------------------------------------
void FirstHitTracer::SolveCandidates()
{
  if (this->Departures)
  {
    this->DropStoppedCandidates();
  }
  if (this->Waiting.Count == 0)
  {
    return;
  }
  // The lanes behind the last candidate must have valid input.
  for (int i = this->Waiting.Count; i < this->Waiting.Count + 16; ++i)
  {
    this->Waiting.Ray[i] = this->Waiting.Ray[0];
    for (auto& coordinates : this->Waiting.Cell)
    {
      coordinates[i] = coordinates[0];
    }
  }
  this->TheKernels.LoadCorners[this->Corners->GetType(this->AreCopied)](
    this->Corners->GetStrides(this->AreCopied), this->Waiting);
  this->Source->Solve(*this->Packet, this->Waiting, this->Planes, this->Isovalue, this->Solved);
  if (this->Departures)
  {
    this->StopAtSolutions();
  }
  else
  {
    this->KeepSolutions();
  }
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
void FirstHitTracer::StopAtSolutions()
{
  ForEachCandidate(this->Solved.Found, [this](int candidate) { this->StopAtCandidate(candidate); });
  ForEachCandidate(this->Solved.Extreme,
    [this](int candidate)
    { this->StopInCell(this->Waiting.Ray[candidate], this->GetCell(candidate)); });
}

//------------------------------------------------------------------------------
/// Where a ray is surely stopped, there is nothing to solve.
void FirstHitTracer::DropStoppedCandidates()
{
  Candidates& waiting = this->Waiting;
  int count = 0;
  for (int i = 0; i < waiting.Count; ++i)
  {
    const int ray = waiting.Ray[i];
    for (auto& coordinates : waiting.Cell)
    {
      coordinates[count] = coordinates[i];
    }
    waiting.Ray[count] = ray;
    waiting.First[count] = waiting.First[i];
    count += Has(this->Stopped.Stopped, ray) ? 0 : 1;
  }
  waiting.Count = count;
}

//------------------------------------------------------------------------------
/// A hit is sure only far from where the ray starts: there the value is zero but for rounding.
void FirstHitTracer::StopAtSureHits(const Frustum& frustum)
{
  for (const bool rise : { false, true })
  {
    const RaySet hits = std::exchange(this->SurelyHit[rise ? 1 : 0], RaySet());
    const bool entering = rise == frustum.IsUp;
    for (int word = 0; word < 2; ++word)
    {
      std::uint64_t bits = hits.Words[word] & ~this->Stopped.Stopped.Words[word];
      for (; bits != 0; bits &= bits - 1)
      {
        const int ray = 64 * word + LowestBit(bits);
        if (!this->Departures[ray].Is(0, entering))
        {
          Add(ray, this->Stopped.Stopped);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Takes the first root of a candidate. Where that may be the crossing that the ray starts on,
/// further roots may follow.
void FirstHitTracer::StopAtCandidate(int candidate)
{
  const int ray = this->Waiting.Ray[candidate];
  if (this->Departures[ray].Is(0, HasCandidate(this->Solved.Entering, candidate)))
  {
    if (HasCandidate(this->Solved.Further, candidate))
    {
      this->StopInCell(ray, this->GetCell(candidate));
    }
  }
  else
  {
    this->Stopped.AddCrossing(
      ray, this->Solved.T[candidate] * Length(this->Packet->GetDirection(ray)));
  }
}

//------------------------------------------------------------------------------
void FirstHitTracer::StopInCell(int ray, const Index3& cell)
{
  if (!Has(this->Stopped.Stopped, ray))
  {
    this->Source->FindStops(ray, cell, this->Departures[ray], this->Stopped);
  }
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
