// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BeamTracer.h"

#include "BeamWalk.h"
#include "RayGroup.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

int FirstOf(const RaySet& set)
{
  return set.Words[0] != 0 ? __builtin_ctzll(set.Words[0]) : 64 + __builtin_ctzll(set.Words[1]);
}

}

//------------------------------------------------------------------------------
const GroupHits& BeamTracer::FindFirstHits(
  RayGroup& group, Cells& cells, const ScaledIsovalue& isovalue)
{
  this->Isovalue = isovalue;
  this->CornerSteps = cells.GetCornerSteps();
  this->Queue.Count = 0;
  this->Hits.Found = {};
  this->Hits.Refined = {};
  this->Hits.Rising = {};
  this->Trace(group, cells);
  this->TheKernels.Refine(group, this->Hits);
  return this->Hits;
}

void BeamTracer::FollowRays(RayGroup& group, Cells& cells)
{
  this->Isovalue.reset();
  this->Trace(group, cells);
}

void BeamTracer::Trace(RayGroup& group, Cells& cells)
{
  this->Group = &group;
  this->Source = &cells;
  this->TraceSet(group.Exists, CountOf(group.Exists));
}

/// Traces rays as one beam, or, where they make none, half of them after the other.
void BeamTracer::TraceSet(const RaySet& rays, int count)
{
  if (count == 0)
  {
    return;
  }
  const int first = FirstOf(rays);
  int axis = 0;
  for (int other = 1; other < 3; ++other)
  {
    if (std::abs(this->Group->Direction[other][first]) >
      std::abs(this->Group->Direction[axis][first]))
    {
      axis = other;
    }
  }
  Beam beam;
  const bool isBeam = this->TheKernels.Align(*this->Group, rays, axis, beam);
  // All passages of a slice must have room if rays are to be followed in order.
  const int largestCount = this->Isovalue ? RayGroup::Capacity : Passages::RaysWithRoom;
  if (count > 1 && (!isBeam || BeamWalk::IsTooWide(beam) || count > largestCount))
  {
    RaySet half = {};
    RaySet rest = rays;
    for (int i = 0; i < count / 2; ++i)
    {
      const int ray = FirstOf(rest);
      Add(ray, half);
      rest.Words[ray / 64] &= rest.Words[ray / 64] - 1;
    }
    this->TraceSet(half, count / 2);
    this->TraceSet(rest, count - count / 2);
    return;
  }
  this->Going = rays;
  this->Passed.Count = 0;
  BeamWalk(this->Tree, beam)
    .ForEachSlice(
      [this, &beam](const Index3* blocks, int blockCount)
      {
        for (int i = 0; i < blockCount; ++i)
        {
          this->Source->Prefetch(blocks[i]);
        }
        for (int i = 0; i < blockCount; ++i)
        {
          this->VisitBlock(beam, blocks[i]);
        }
        this->EndSlice(beam);
        return IsEmpty(this->Going);
      });
}

void BeamTracer::VisitBlock(const Beam& beam, const Index3& block)
{
  BlockMask own;
  const BlockMask& mask = this->Source->GetMask(block, own);
  const int first[3] = { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge,
    block[2] * BlockMask::Edge };
  const int before = this->Passed.Count;
  this->TheKernels.FindPassages(
    *this->Group, this->Going, beam.Axis, first, mask.Slices[beam.Axis], this->Passed);
  if (!this->Isovalue || this->Passed.Count == before)
  {
    return;
  }
  const void* corner = this->Source->FindCorner(block);
  this->AllInRows = this->AllInRows && corner;
  std::fill(&this->Passed.Corner[before], &this->Passed.Corner[this->Passed.Count],
    static_cast<const char*>(corner));
  if (this->Passed.Count >= Passages::Batch)
  {
    this->SolvePassages(beam);
  }
}

/// Does what is to be done for the rays in a slice of blocks.
void BeamTracer::EndSlice(const Beam& beam)
{
  if (!this->Isovalue)
  {
    this->FollowPassages(beam);
    return;
  }
  this->SolvePassages(beam);
  this->Going.Words[0] &= ~this->Hits.Found.Words[0];
  this->Going.Words[1] &= ~this->Hits.Found.Words[1];
}

/// Follows each ray through the cells of all its passages.
void BeamTracer::FollowPassages(const Beam& beam)
{
  // The passages of a ray, each with the number of the next.
  int first[RayGroup::Capacity];
  int next[Passages::Capacity];
  std::fill_n(first, RayGroup::Capacity, -1);
  for (int i = 0; i < this->Passed.Count; ++i)
  {
    next[i] = std::exchange(first[this->Passed.Ray[i]], i);
  }
  std::vector<Index3>& cells = this->CellsOfRay;
  for (int ray = 0; ray < this->Group->Count; ++ray)
  {
    if (first[ray] < 0)
    {
      continue;
    }
    cells.clear();
    for (int passage = first[ray]; passage >= 0; passage = next[passage])
    {
      this->AddCells(beam.Axis, passage, cells);
    }
    if (this->Source->Follow(ray, cells))
    {
      Remove(ray, this->Going);
    }
  }
  this->Passed.Count = 0;
}

void BeamTracer::AddCells(int axis, int passage, std::vector<Index3>& cells) const
{
  const int* first = this->Passed.First[passage];
  for (unsigned int slices = this->Passed.Slices[passage]; slices != 0; slices &= slices - 1)
  {
    const int slice = __builtin_ctz(slices);
    for (std::uint64_t bits = this->Passed.Cells[passage][slice]; bits != 0; bits &= bits - 1)
    {
      const int bit = __builtin_ctzll(bits);
      Index3 cell = { first[0], first[1], first[2] };
      cell[static_cast<std::size_t>(axis)] += slice;
      cell[static_cast<std::size_t>(BlockMask::U[axis])] += bit % 8;
      cell[static_cast<std::size_t>(BlockMask::V[axis])] += bit / 8;
      cells.push_back(cell);
    }
  }
}

/// Finds the first hit of every passage. A ray needs the cells of a slice only if it hit nothing in
/// the slices before. (Whether there is more to do for a ray is as good as random: counting is
/// faster than branching.)
void BeamTracer::SolvePassages(const Beam& beam)
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
      const int slice = beam.IsUp ? __builtin_ctz(slices) : 31 - __builtin_clz(slices);
      const unsigned int others = slices & ~(1U << slice);
      this->Passed.Slices[passage] = others;
      this->AddCandidates(beam.Axis, passage, slice);
      waiting[next] = passage;
      next += others != 0 ? 1 : 0;
      if (this->Queue.Count >= Candidates::Batch)
      {
        this->SolveQueue();
      }
    }
    this->SolveQueue();
    left = 0;
    for (int i = 0; i < next; ++i)
    {
      waiting[left] = waiting[i];
      left += this->Passed.Hits[waiting[i]] ? 0 : 1;
    }
  }
  this->Passed.Count = 0;
  this->AllInRows = true;
}

void BeamTracer::AddCandidates(int axis, int passage, int slice)
{
  Candidates& queue = this->Queue;
  const int* first = this->Passed.First[passage];
  int* along = queue.Cell[axis];
  int* acrossU = queue.Cell[BlockMask::U[axis]];
  int* acrossV = queue.Cell[BlockMask::V[axis]];
  const int firstU = first[BlockMask::U[axis]];
  const int firstV = first[BlockMask::V[axis]];
  const std::ptrdiff_t* steps = this->CornerSteps.data();
  const std::ptrdiff_t toSlice = slice * steps[axis];
  const std::ptrdiff_t stepU = steps[BlockMask::U[axis]];
  const std::ptrdiff_t stepV = steps[BlockMask::V[axis]];
  const char* corner = this->Passed.Corner[passage];
  const auto put = [&](int place, std::uint64_t cells)
  {
    const int bit = __builtin_ctzll(cells);
    queue.Passage[place] = passage;
    queue.Ray[place] = this->Passed.Ray[passage];
    along[place] = first[axis] + slice;
    acrossU[place] = firstU + bit % 8;
    acrossV[place] = firstV + bit / 8;
    queue.First[place] = corner ? corner + toSlice + bit % 8 * stepU + bit / 8 * stepV : nullptr;
  };
  // Mostly there are one or two. Both are written, and then counted.
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

void BeamTracer::SolveQueue()
{
  if (this->Queue.Count == 0)
  {
    return;
  }
  for (int i = 0; i < 8; ++i)
  {
    this->Queue.Ray[this->Queue.Count + i] = 0;
  }
  if (this->AllInRows)
  {
    this->Source->GatherCorners(this->Queue);
  }
  else
  {
    this->Source->LoadCorners(this->Queue);
  }
  this->TheKernels.FindHits(
    *this->Group, this->Queue, *this->Isovalue, this->Hits, this->Passed, this->Extremes);
  for (int i = 0; i < this->Extremes.Count; ++i)
  {
    this->KeepExtreme(this->Extremes.Numbers[i]);
  }
  this->Queue.Count = 0;
}

/// Solves a candidate that the kernels do not, and keeps its hit as they do.
void BeamTracer::KeepExtreme(int candidate)
{
  const int ray = this->Queue.Ray[candidate];
  Hit hit;
  Place begin;
  if (!this->Source->FindFirstHit(ray,
        { this->Queue.Cell[0][candidate], this->Queue.Cell[1][candidate],
          this->Queue.Cell[2][candidate] },
        hit, begin))
  {
    return;
  }
  this->Passed.Hits[this->Queue.Passage[candidate]] = true;
  GroupHits& hits = this->Hits;
  if (Has(hits.Found, ray) &&
    !(begin < Place{ hits.Begin[ray], static_cast<int>(hits.BeginAxis[ray]) }))
  {
    return;
  }
  Add(ray, hits.Found);
  Add(ray, hits.Refined);
  hits.Begin[ray] = begin.T;
  hits.BeginAxis[ray] = begin.Axis;
  hits.T[ray] = hit.T;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    hits.Cell[axis][ray] = hit.Cell[axis];
    hits.Parametric[axis][ray] = hit.Parametric[axis];
  }
  const std::uint64_t bit = std::uint64_t{ 1 } << (ray % 64);
  std::uint64_t& rising = hits.Rising.Words[ray / 64];
  rising = hit.Rising ? rising | bit : rising & ~bit;
}

}
