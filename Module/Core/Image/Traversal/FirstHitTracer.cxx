// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Traversal/FirstHitTracer.h"

#include "Image/Cells/CellSegment.h"

#include <algorithm>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Calls visit(candidate) for the members of a set of Solutions, in order.
template <typename Visit>
void ForEachCandidate(const std::uint64_t (&set)[Solutions::Words], const Visit& visit)
{
  for (int word = 0; word < Solutions::Words; ++word)
  {
    for (std::uint64_t bits = set[word]; bits != 0; bits &= bits - 1)
    {
      visit(64 * word + __builtin_ctzll(bits));
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
  this->CornerSteps = cells.GetCornerSteps();
  this->Queue.Count = 0;
  this->Waiting.Count = 0;
  this->SurelyHit[0] = {};
  this->SurelyHit[1] = {};
  this->Stopped = {};
  this->Hits.Found = {};
  this->Trace(packet, cells);
  this->SolveCandidates();
}

//------------------------------------------------------------------------------
void FirstHitTracer::BeginFrustum(const Frustum& frustum)
{
  this->AllInRows = true;
  const std::ptrdiff_t stepU =
    this->CornerSteps[static_cast<std::size_t>(BlockMask::U[frustum.Axis])];
  const std::ptrdiff_t stepV =
    this->CornerSteps[static_cast<std::size_t>(BlockMask::V[frustum.Axis])];
  for (int bit = 0; bit < 64; ++bit)
  {
    this->StepsInSlice[static_cast<std::size_t>(bit)] = bit % 8 * stepU + bit / 8 * stepV;
  }
}

//------------------------------------------------------------------------------
void FirstHitTracer::AddBlock(const Frustum& frustum, const Index3& block)
{
  const void* corner = this->Source->FindCorner(block);
  this->AllInRows = this->AllInRows && corner;
  this->Passed.Corner[this->Passed.BlockCount - 1] = static_cast<const char*>(corner);
  if (this->Passed.Count >= Passages::Batch)
  {
    this->ClassifyPassages(frustum);
  }
}

//------------------------------------------------------------------------------
/// There are so few that they are solved one by one.
void FirstHitTracer::AddCroppedCells(
  const Frustum& frustum, const Index3& /*block*/, int first)
{
  for (int passage = first; passage < this->Passed.Count; ++passage)
  {
    const int ray = this->Passed.Segments[passage].Ray;
    this->ForEachCell(frustum.Axis, passage,
      [this, ray](const Index3& cell) { this->FindFirstHit(ray, cell); });
  }
  this->Passed.Count = first;
  --this->Passed.BlockCount;
}

//------------------------------------------------------------------------------
/// Processes the rays in a slice of blocks.
void FirstHitTracer::EndSlice(const Frustum& frustum)
{
  this->ClassifyPassages(frustum);
  for (int word = 0; word < 2; ++word)
  {
    this->Going.Words[word] &= ~(this->Departures ? this->Stopped.Stopped.Words[word]
                                                  : this->SurelyHit[0].Words[word] |
          this->SurelyHit[1].Words[word] | this->Hits.Found.Words[word]);
  }
}

//------------------------------------------------------------------------------
/// Finds the candidates of every passage, up to where it surely hits the surface. A ray needs the
/// cells of a slice only if it has no sure hit in the slices before. (Whether a ray needs more is
/// unpredictable: counting is faster than branching.)
void FirstHitTracer::ClassifyPassages(const Frustum& frustum)
{
  int waiting[Passages::Capacity];
  int left = this->Passed.Count;
  for (int i = 0; i < left; ++i)
  {
    waiting[i] = i;
  }
  while (left > 0)
  {
    int next = 0;
    for (int i = 0; i < left; ++i)
    {
      const int passage = waiting[i];
      const unsigned int slices = this->Passed.Slices[passage];
      const int slice = frustum.IsUp ? __builtin_ctz(slices) : 31 - __builtin_clz(slices);
      const unsigned int others = slices & ~(1U << slice);
      this->Passed.Slices[passage] = others;
      this->AddCellsOfSlice(frustum.Axis, passage, slice);
      waiting[next] = passage;
      next += others != 0 ? 1 : 0;
      if (this->Queue.Count >= PassedCells::Batch)
      {
        this->ClassifyQueue(frustum);
      }
    }
    this->ClassifyQueue(frustum);
    left = 0;
    for (int i = 0; i < next; ++i)
    {
      waiting[left] = waiting[i];
      left += this->IsOver(waiting[i]) ? 0 : 1;
    }
  }
  this->ClearPassages();
  this->AllInRows = true;
}

//------------------------------------------------------------------------------
/// Whether the rest of a passage is not needed.
bool FirstHitTracer::IsOver(int passage) const
{
  return this->Departures ? Has(this->Stopped.Stopped, this->Passed.Segments[passage].Ray)
                          : this->Passed.Hits[passage];
}

//------------------------------------------------------------------------------
void FirstHitTracer::AddCellsOfSlice(int axis, int passage, int slice)
{
  PassedCells& queue = this->Queue;
  const unsigned int code =
    static_cast<unsigned int>(passage) | static_cast<unsigned int>(slice) << 16;
  // Corners that are not kept in rows are copied later.
  const char* block = this->AllInRows ? this->Passed.Corner[this->Passed.Segments[passage].Block]
                                      : reinterpret_cast<const char*>(this);
  const char* corner = block + slice * this->CornerSteps[static_cast<std::size_t>(axis)];
  const auto put = [&](int index, std::uint64_t cells)
  {
    const int bit = __builtin_ctzll(cells);
    queue.Codes[index] = code | static_cast<unsigned int>(bit) << 24;
    queue.First[index] = corner + this->StepsInSlice[static_cast<std::size_t>(bit)];
    __builtin_prefetch(queue.First[index]);
    __builtin_prefetch(static_cast<const char*>(queue.First[index]) + this->CornerSteps[2]);
  };
  // Mostly there are one or two cells. Both are written, and then counted.
  std::uint64_t cells = this->Passed.Cells[passage][slice];
  put(queue.Count, cells);
  cells &= cells - 1;
  put(queue.Count + 1, cells | std::uint64_t{ 1 } << 63);
  queue.Count += cells != 0 ? 2 : 1;
  for (cells &= cells - 1; cells != 0; cells &= cells - 1)
  {
    put(queue.Count++, cells);
  }
}

//------------------------------------------------------------------------------
void FirstHitTracer::ClassifyQueue(const Frustum& frustum)
{
  if (this->Queue.Count == 0)
  {
    return;
  }
  // The lanes behind the last cell repeat the first.
  std::fill_n(this->Queue.Codes + this->Queue.Count, PassedCells::Spare, this->Queue.Codes[0]);
  std::fill_n(this->Queue.First + this->Queue.Count, PassedCells::Spare, this->Queue.First[0]);
  if (!this->AllInRows)
  {
    // Waiting candidates are read from rows, new ones from copies.
    this->SolveCandidates();
    this->Source->CopyCorners(this->Queue, frustum.Axis, this->Passed);
    this->AreCopied = true;
  }
  this->Source->ClassifyCells(
    this->Queue, frustum.Axis, this->AreCopied, this->Passed, this->Waiting, this->SurelyHit);
  this->Queue.Count = 0;
  if (this->Departures)
  {
    this->StopAtSureHits(frustum);
  }
  if (this->AreCopied || this->Waiting.Count >= Candidates::Batch)
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
  this->Source->LoadCorners(this->AreCopied, this->Waiting);
  this->TheKernels.Solve(
    *this->Packet, this->Waiting, this->Planes, this->Isovalue, this->Solved);
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
        const int ray = 64 * word + __builtin_ctzll(bits);
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
  const bool entering = (this->Solved.Entering[candidate / 64] >> (candidate % 64) & 1) != 0;
  if (this->Departures[ray].Is(0, entering))
  {
    this->StopInCell(ray, this->GetCell(candidate));
  }
  else
  {
    const Vector3 direction = { this->Packet->Direction[0][ray], this->Packet->Direction[1][ray],
      this->Packet->Direction[2][ray] };
    this->Stopped.AddCrossing(ray, this->Solved.T[candidate], direction);
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
    (solved.Entering[candidate / 64] >> (candidate % 64) & 1) != 0 };
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
  if (!Has(this->Hits.Found, ray) ||
    IsEnteredBefore(this->Lattice.GetCell(hit), begin,
      this->Lattice.GetCell(this->Hits.Hits[number]), this->Hits.Begin[number],
      this->Packet->GetDirection(ray)))
  {
    Add(ray, this->Hits.Found);
    this->Hits.Hits[number] = hit;
    this->Hits.Begin[number] = begin;
  }
}

}
