// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Traversal/PacketTracer.h"

#include "Image/Traversal/FrustumTraversal.h"
#include "Rays/RayPacket.h"

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

/// The axis along which a ray of a packet mainly goes.
int GetMainAxis(const RayPacket& packet, int ray)
{
  int axis = 0;
  for (int other = 1; other < 3; ++other)
  {
    if (std::abs(packet.Direction[other][ray]) > std::abs(packet.Direction[axis][ray]))
    {
      axis = other;
    }
  }
  return axis;
}

}

//------------------------------------------------------------------------------
bool PacketTracer::MayMeet(
  const Kernels& kernels, const BlockTree& tree, const Index3& dimensions, RayPacket& lines)
{
  // Places on lines that begin farther away are not exact enough.
  constexpr double farthest = 1e6;
  const int axis = GetMainAxis(lines, 0);
  for (int i = 0; i < lines.Count; ++i)
  {
    Add(i, lines.Exists);
    for (const auto& origins : lines.Origin)
    {
      if (!(std::abs(origins[i]) < farthest))
      {
        return true;
      }
    }
    const double inverse = 1.0 / lines.Direction[axis][i];
    const double first = -lines.Origin[axis][i] * inverse;
    const double last =
      (dimensions[static_cast<std::size_t>(axis)] - 1 - lines.Origin[axis][i]) * inverse;
    lines.Inverse[axis][i] = inverse;
    lines.Begin[i] = std::min(first, last);
    lines.End[i] = std::max(first, last);
  }
  AlignedRays aligned;
  Frustum frustum;
  if (!kernels.Align(lines, lines.Exists, axis, aligned, frustum) ||
    FrustumTraversal::IsTooWide(frustum))
  {
    return true;
  }
  bool meets = false;
  FrustumTraversal(tree, frustum)
    .ForEachSlice([&meets](const Index3*, int) { return meets = true; });
  return meets;
}

//------------------------------------------------------------------------------
const PacketHits& PacketTracer::FindFirstHits(
  const RayPacket& packet, FirstHitCells& cells, const ScaledIsovalue& isovalue)
{
  this->Departures = nullptr;
  this->TraceSurface(packet, cells, isovalue);
  return this->Hits;
}

//------------------------------------------------------------------------------
const StoppedRays& PacketTracer::FindStopped(const RayPacket& packet, FirstHitCells& cells,
  const ScaledIsovalue& isovalue, const Departure* departures)
{
  this->Departures = departures;
  this->TraceSurface(packet, cells, isovalue);
  return this->Stopped;
}

//------------------------------------------------------------------------------
void PacketTracer::TraceSurface(
  const RayPacket& packet, FirstHitCells& cells, const ScaledIsovalue& isovalue)
{
  this->FirstHitSource = &cells;
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
void PacketTracer::FollowRays(const RayPacket& packet, FollowedCells& cells)
{
  this->FollowedSource = &cells;
  this->Isovalue.reset();
  this->Trace(packet, cells);
}

void PacketTracer::Trace(const RayPacket& packet, Cells& cells)
{
  this->Packet = &packet;
  this->Source = &cells;
  this->TraceSet(packet.Exists, CountOf(packet.Exists));
}

/// Traces rays as one frustum, or, where they make none, half of them after the other.
void PacketTracer::TraceSet(const RaySet& rays, int count)
{
  if (count == 0)
  {
    return;
  }
  const int axis = GetMainAxis(*this->Packet, FirstOf(rays));
  Frustum frustum;
  const bool isFrustum = this->TheKernels.Align(*this->Packet, rays, axis, this->Aligned, frustum);
  // All passages of a slice must have room if rays are to be followed in order.
  const int largestCount = this->Isovalue ? RayPacket::Capacity : Passages::RaysWithRoom;
  if (count > 1 && (!isFrustum || FrustumTraversal::IsTooWide(frustum) || count > largestCount))
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
  this->ClearPassages();
  this->SetStepsInSlice(axis);
  FrustumTraversal(this->Tree, frustum)
    .ForEachSlice(
      [this, &frustum](const Index3* blocks, int blockCount)
      {
        for (int i = 0; i < blockCount; ++i)
        {
          this->Source->Prefetch(blocks[i]);
        }
        for (int i = 0; i < blockCount; ++i)
        {
          this->VisitBlock(frustum, blocks[i]);
        }
        this->EndSlice(frustum);
        return IsEmpty(this->Going);
      });
}

void PacketTracer::SetStepsInSlice(int axis)
{
  const std::ptrdiff_t stepU = this->CornerSteps[static_cast<std::size_t>(BlockMask::U[axis])];
  const std::ptrdiff_t stepV = this->CornerSteps[static_cast<std::size_t>(BlockMask::V[axis])];
  for (int bit = 0; bit < 64; ++bit)
  {
    this->StepsInSlice[static_cast<std::size_t>(bit)] = bit % 8 * stepU + bit / 8 * stepV;
  }
}

void PacketTracer::VisitBlock(const Frustum& frustum, const Index3& block)
{
  BlockMask own;
  const BlockMask& mask = this->Source->GetMask(block, own);
  const int first[3] = { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge,
    block[2] * BlockMask::Edge };
  const int before = this->Passed.Count;
  this->TheKernels.FindPassages(
    this->Aligned, this->Going, frustum.Axis, first, mask.Slices[frustum.Axis], this->Passed);
  if (!this->Isovalue || this->Passed.Count == before)
  {
    return;
  }
  const void* corner = this->FirstHitSource->FindCorner(block);
  this->AllInRows = this->AllInRows && corner;
  this->Passed.Corner[this->Passed.BlockCount - 1] = static_cast<const char*>(corner);
  if (this->Passed.Count >= Passages::Batch)
  {
    this->ClassifyPassages(frustum);
  }
}

void PacketTracer::ClearPassages()
{
  this->Passed.Count = 0;
  this->Passed.BlockCount = 0;
  this->Passed.HasEnds = false;
  this->AllInRows = true;
}

/// Does what is to be done for the rays in a slice of blocks.
void PacketTracer::EndSlice(const Frustum& frustum)
{
  if (!this->Isovalue)
  {
    this->FollowPassages(frustum);
    return;
  }
  this->ClassifyPassages(frustum);
  for (int word = 0; word < 2; ++word)
  {
    this->Going.Words[word] &= ~(this->Departures ? this->Stopped.Stopped.Words[word]
                                                  : this->SurelyHit[0].Words[word] |
          this->SurelyHit[1].Words[word] | this->Hits.Found.Words[word]);
  }
}

/// Follows each ray through the cells of all its passages.
void PacketTracer::FollowPassages(const Frustum& frustum)
{
  // The passages of a ray, each with the number of the next.
  int first[RayPacket::Capacity];
  int next[Passages::Capacity];
  std::fill_n(first, RayPacket::Capacity, -1);
  for (int i = 0; i < this->Passed.Count; ++i)
  {
    next[i] = std::exchange(first[this->Passed.Ways[i].Ray], i);
  }
  std::vector<Index3>& cells = this->CellsOfRay;
  for (int ray = 0; ray < this->Packet->Count; ++ray)
  {
    if (first[ray] < 0)
    {
      continue;
    }
    cells.clear();
    for (int passage = first[ray]; passage >= 0; passage = next[passage])
    {
      this->AddCells(frustum.Axis, passage, cells);
    }
    if (this->FollowedSource->Follow(ray, cells))
    {
      Remove(ray, this->Going);
    }
  }
  this->ClearPassages();
}

void PacketTracer::AddCells(int axis, int passage, std::vector<Index3>& cells) const
{
  const int* first = this->Passed.First[this->Passed.Ways[passage].Block];
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

/// Finds the candidates of every passage, up to where it surely hits something. A ray needs the
/// cells of a slice only if it does not in the slices before. (Whether there is more to do for a
/// ray is as good as random: counting is faster than branching.)
void PacketTracer::ClassifyPassages(const Frustum& frustum)
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
}

/// Whether the rest of a passage does not matter.
bool PacketTracer::IsOver(int passage) const
{
  return this->Departures ? Has(this->Stopped.Stopped, this->Passed.Ways[passage].Ray)
                          : this->Passed.Hits[passage];
}

void PacketTracer::AddCellsOfSlice(int axis, int passage, int slice)
{
  PassedCells& queue = this->Queue;
  const unsigned int code =
    static_cast<unsigned int>(passage) | static_cast<unsigned int>(slice) << 16;
  // What is not kept in rows is copied later.
  const char* block = this->AllInRows ? this->Passed.Corner[this->Passed.Ways[passage].Block]
                                      : reinterpret_cast<const char*>(this);
  const char* corner = block + slice * this->CornerSteps[static_cast<std::size_t>(axis)];
  const auto put = [&](int place, std::uint64_t cells)
  {
    const int bit = __builtin_ctzll(cells);
    queue.Codes[place] = code | static_cast<unsigned int>(bit) << 24;
    queue.First[place] = corner + this->StepsInSlice[static_cast<std::size_t>(bit)];
    __builtin_prefetch(queue.First[place]);
    __builtin_prefetch(static_cast<const char*>(queue.First[place]) + this->CornerSteps[2]);
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

void PacketTracer::ClassifyQueue(const Frustum& frustum)
{
  if (this->Queue.Count == 0)
  {
    return;
  }
  // The lanes behind the last cell look at the first.
  std::fill_n(this->Queue.Codes + this->Queue.Count, PassedCells::Spare, this->Queue.Codes[0]);
  std::fill_n(this->Queue.First + this->Queue.Count, PassedCells::Spare, this->Queue.First[0]);
  if (!this->AllInRows)
  {
    // Those that wait are read from rows, those that come now from copies.
    this->SolveCandidates();
    this->FirstHitSource->CopyCorners(this->Queue, frustum.Axis, this->Passed);
    this->AreCopied = true;
  }
  this->FirstHitSource->ClassifyCells(
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

void PacketTracer::SolveCandidates()
{
  if (this->Departures)
  {
    this->DropStoppedCandidates();
  }
  if (this->Waiting.Count == 0)
  {
    return;
  }
  // The lanes behind the last candidate must have something to look at.
  for (int i = this->Waiting.Count; i < this->Waiting.Count + 16; ++i)
  {
    this->Waiting.Ray[i] = this->Waiting.Ray[0];
  }
  this->FirstHitSource->LoadCorners(this->AreCopied, this->Waiting);
  this->TheKernels.Solve(*this->Packet, this->Waiting, *this->Isovalue, this->Solved);
  for (int word = 0; word < Solutions::Words; ++word)
  {
    for (std::uint64_t bits = this->Solved.Found[word]; bits != 0; bits &= bits - 1)
    {
      const int i = 64 * word + __builtin_ctzll(bits);
      if (this->Departures)
      {
        this->StopAtCandidate(i);
      }
      else
      {
        this->Keep(this->Waiting.Ray[i], this->GetHit(i),
          { this->Solved.Begin[i], static_cast<int>(this->Solved.BeginAxis[i]) });
      }
    }
    for (std::uint64_t bits = this->Solved.Extreme[word]; bits != 0; bits &= bits - 1)
    {
      const int i = 64 * word + __builtin_ctzll(bits);
      if (this->Departures)
      {
        this->StopInCell(this->Waiting.Ray[i], this->GetCell(i));
      }
      else
      {
        this->FindFirstHit(this->Waiting.Ray[i], this->GetCell(i));
      }
    }
  }
  this->Waiting.Count = 0;
}

//------------------------------------------------------------------------------
/// Where a ray is stopped for sure, there is nothing to solve.
void PacketTracer::DropStoppedCandidates()
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
/// What surely hits the surface does so far from where the ray starts: there the value is zero but
/// for rounding, and nothing is sure.
void PacketTracer::StopAtSureHits(const Frustum& frustum)
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
/// others may follow.
void PacketTracer::StopAtCandidate(int candidate)
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
void PacketTracer::StopInCell(int ray, const Index3& cell)
{
  if (!Has(this->Stopped.Stopped, ray))
  {
    this->FirstHitSource->FindStops(ray, cell, this->Departures[ray], this->Stopped);
  }
}

//------------------------------------------------------------------------------
Index3 PacketTracer::GetCell(int candidate) const
{
  const Candidates& candidates = this->Waiting;
  return { candidates.Cell[0][candidate], candidates.Cell[1][candidate],
    candidates.Cell[2][candidate] };
}

//------------------------------------------------------------------------------
Hit PacketTracer::GetHit(int candidate) const
{
  const Solutions& solved = this->Solved;
  return { solved.T[candidate], this->Lattice.GetNumber(this->GetCell(candidate)), 0,
    { solved.Parametric[0][candidate], solved.Parametric[1][candidate],
      solved.Parametric[2][candidate] },
    (solved.Entering[candidate / 64] >> (candidate % 64) & 1) != 0 };
}

/// Solves a cell that the kernels do not.
void PacketTracer::FindFirstHit(int ray, const Index3& cell)
{
  Hit hit;
  Crossing begin;
  if (this->FirstHitSource->FindFirstHit(ray, cell, hit, begin))
  {
    this->Keep(ray, hit, begin);
  }
}

/// Keeps a hit of a ray, unless it has one in a cell before.
void PacketTracer::Keep(int ray, const Hit& hit, const Crossing& begin)
{
  const auto number = static_cast<std::size_t>(ray);
  if (!Has(this->Hits.Found, ray) || begin < this->Hits.Begin[number])
  {
    Add(ray, this->Hits.Found);
    this->Hits.Hits[number] = hit;
    this->Hits.Begin[number] = begin;
  }
}

}
