// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BeamTracer.h"

#include "BeamWalk.h"
#include "RayGroup.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

int CountOf(const RaySet& set)
{
  return __builtin_popcountll(set.Words[0]) + __builtin_popcountll(set.Words[1]);
}

int FirstOf(const RaySet& set)
{
  return set.Words[0] != 0 ? __builtin_ctzll(set.Words[0]) : 64 + __builtin_ctzll(set.Words[1]);
}

/// Whether any ray of a group goes along lattice planes.
bool HasParallel(const RayGroup& group)
{
  for (int i = 0; i < group.Count; ++i)
  {
    if (Has(group.Exists, i) &&
      (group.Direction[0][i] == 0.0 || group.Direction[1][i] == 0.0 ||
        group.Direction[2][i] == 0.0))
    {
      return true;
    }
  }
  return false;
}

}

//------------------------------------------------------------------------------
void BeamTracer::Trace(RayGroup& group, Cells& cells)
{
  this->Group = &group;
  this->Source = &cells;
  this->Found = {};
  this->HasParallelRays = HasParallel(group);
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
  if (count > 1 && (!isBeam || BeamWalk::IsTooWide(beam)))
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
  BeamWalk(this->Tree, beam)
    .ForEachSlice([this, &beam](const Index3& macrocell) { this->VisitBlock(beam, macrocell); },
      [this]()
      {
        this->Going.Words[0] &= ~this->Found.Words[0];
        this->Going.Words[1] &= ~this->Found.Words[1];
        return IsEmpty(this->Going);
      });
}

void BeamTracer::VisitBlock(const Beam& beam, const Index3& block)
{
  BlockMask own;
  const BlockMask& mask = this->Source->GetMask(block, own);
  const int first[3] = { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge,
    block[2] * BlockMask::Edge };
  this->TheKernels.FindCells(
    *this->Group, this->Going, beam.Axis, first, mask.Slices[beam.Axis], this->Passed);

  this->FoundInBlock = {};
  // A ray needs the cells of a slice only if it hit nothing in the slices before.
  int left = this->Passed.Count;
  int waiting[RayGroup::Capacity];
  for (int i = 0; i < left; ++i)
  {
    waiting[i] = i;
  }
  while (left > 0)
  {
    this->Queue.Count = 0;
    int next = 0;
    for (int i = 0; i < left; ++i)
    {
      const int entry = waiting[i];
      unsigned int& slices = this->Passed.Slices[entry];
      const int slice = beam.IsUp ? __builtin_ctz(slices) : 31 - __builtin_clz(slices);
      slices &= ~(1U << slice);
      this->AddCandidates(beam.Axis, first, entry, slice);
      if (slices != 0)
      {
        waiting[next++] = entry;
      }
      if (this->Queue.Count >= Candidates::Batch)
      {
        this->SolveQueue();
      }
    }
    this->SolveQueue();
    left = 0;
    for (int i = 0; i < next; ++i)
    {
      if (!Has(this->FoundInBlock, this->Passed.Ray[waiting[i]]))
      {
        waiting[left++] = waiting[i];
      }
    }
  }
}

void BeamTracer::AddCandidates(int axis, const int first[3], int entry, int slice)
{
  const int u = BlockMask::U[axis];
  const int v = BlockMask::V[axis];
  for (std::uint64_t cells = this->Passed.Cells[entry][slice]; cells != 0; cells &= cells - 1)
  {
    const int bit = __builtin_ctzll(cells);
    const int place = this->Queue.Count++;
    Candidates& queue = this->Queue;
    queue.Ray[place] = this->Passed.Ray[entry];
    queue.Cell[axis][place] = first[axis] + slice;
    queue.Cell[u][place] = first[u] + bit % 8;
    queue.Cell[v][place] = first[v] + bit / 8;
  }
}

/// Whether a ray along lattice planes does not pass a cell, but the one on the other side of such a
/// plane, however near.
bool BeamTracer::IsBeside(int candidate) const
{
  const int ray = this->Queue.Ray[candidate];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (this->Group->Direction[axis][ray] == 0.0)
    {
      const auto floor = static_cast<int>(std::floor(this->Group->Origin[axis][ray]));
      if (this->Queue.Cell[axis][candidate] != std::min(floor, this->Dimensions[axis] - 2))
      {
        return true;
      }
    }
  }
  return false;
}

/// The kernels propose cells that a ray comes near to, and find out by the planes of a cell whether
/// it passes there. Along an axis that it is parallel to there are none to tell.
void BeamTracer::DropCandidatesBeside()
{
  int kept = 0;
  for (int i = 0; i < this->Queue.Count; ++i)
  {
    if (!this->IsBeside(i))
    {
      this->Queue.Ray[kept] = this->Queue.Ray[i];
      for (int* cells : this->Queue.Cell)
      {
        cells[kept] = cells[i];
      }
      ++kept;
    }
  }
  this->Queue.Count = kept;
}

void BeamTracer::SolveQueue()
{
  if (this->HasParallelRays)
  {
    this->DropCandidatesBeside();
  }
  if (this->Queue.Count == 0)
  {
    return;
  }
  for (int i = 0; i < 8; ++i)
  {
    this->Queue.Ray[this->Queue.Count + i] = 0;
  }
  this->Source->LoadCorners(this->Queue);
  this->TheKernels.FindFirstRoots(*this->Group, this->Queue, this->Isovalue, this->Roots);
  for (int i = 0; i < this->Roots.Count; ++i)
  {
    const int candidate = this->Roots.Candidate[i];
    this->Keep(this->Queue.Ray[candidate],
      { this->Roots.T[i], this->GetCell(candidate), 0,
        { this->Roots.Parametric[0][i], this->Roots.Parametric[1][i],
          this->Roots.Parametric[2][i] },
        this->Roots.Rising[i] },
      { this->Roots.Begin[i], static_cast<int>(this->Roots.BeginAxis[i]) });
  }
  for (int i = 0; i < this->Roots.ExtremeCount; ++i)
  {
    const int candidate = this->Roots.Extreme[i];
    const int ray = this->Queue.Ray[candidate];
    Hit hit;
    Place begin;
    if (this->Source->FindFirstHit(ray, this->GetCell(candidate), hit, begin))
    {
      this->Keep(ray, hit, begin);
    }
  }
  this->Queue.Count = 0;
}

Index3 BeamTracer::GetCell(int candidate) const
{
  return { this->Queue.Cell[0][candidate], this->Queue.Cell[1][candidate],
    this->Queue.Cell[2][candidate] };
}

/// Keeps a hit unless the ray has one in a cell before.
void BeamTracer::Keep(int ray, const Hit& hit, const Place& begin)
{
  Add(ray, this->FoundInBlock);
  if (this->HasHit(ray) && !(begin < this->Begins[ray]))
  {
    return;
  }
  Add(ray, this->Found);
  this->Hits[ray] = hit;
  this->Begins[ray] = begin;
}

}
