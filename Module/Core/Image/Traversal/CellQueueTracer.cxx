// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Traversal/CellQueueTracer.h"

#include "Math/Compiler.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void CellQueueTracer::TraceQueued(
  const RayPacket& packet, Cells& cells, CornerSource& corners, Order order)
{
  this->Corners = &corners;
  this->CornerSteps = corners.GetSteps();
  this->Queue.Count = 0;
  this->Trace(packet, cells, order);
}

//------------------------------------------------------------------------------
void CellQueueTracer::BeginFrustum(const Frustum& frustum)
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
void CellQueueTracer::AddBlock(const Frustum& frustum, const Index3& block)
{
  const void* corner = this->Corners->FindCorner(block);
  this->AllInRows = this->AllInRows && corner;
  this->Passed.Corner[this->Passed.BlockCount - 1] = static_cast<const char*>(corner);
  if (this->Passed.Count >= Passages::Batch)
  {
    this->TakePassages(frustum);
  }
}

//------------------------------------------------------------------------------
void CellQueueTracer::EndSlice(const Frustum& frustum)
{
  this->TakePassages(frustum);
  this->EndQueuedSlice(frustum);
}

//------------------------------------------------------------------------------
inline void CellQueueTracer::AddCellsOfSlice(int axis, int passage, int slice)
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
    const int bit = LowestBit(cells);
    queue.Codes[index] = code | static_cast<unsigned int>(bit) << 24;
    queue.First[index] = corner + this->StepsInSlice[static_cast<std::size_t>(bit)];
    PrefetchLine(queue.First[index]);
    PrefetchLine(static_cast<const char*>(queue.First[index]) + this->CornerSteps[2]);
  };
  // Mostly there are one or two cells. Both are written, and then counted: by the sign of a number,
  // since compilers make a branch of a comparison, which is unpredictable.
  std::uint64_t cells = this->Passed.Cells[passage][slice];
  put(queue.Count, cells);
  cells &= cells - 1;
  put(queue.Count + 1, cells | std::uint64_t{ 1 } << 63);
  queue.Count += 1 + static_cast<int>((cells | (0 - cells)) >> 63);
  for (cells &= cells - 1; cells != 0; cells &= cells - 1)
  {
    put(queue.Count++, cells);
  }
}

//------------------------------------------------------------------------------
/// Queues the cells of every passage, slice by slice, up to where it is over. (Whether a ray needs
/// more is unpredictable: counting is faster than branching.)
void CellQueueTracer::TakePassages(const Frustum& frustum)
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
      const int slice = frustum.IsUp ? LowestBit(slices) : HighestBit(slices);
      const unsigned int others = slices & ~(1U << slice);
      this->Passed.Slices[passage] = others;
      this->AddCellsOfSlice(frustum.Axis, passage, slice);
      waiting[next] = passage;
      next += others != 0 ? 1 : 0;
      if (this->Queue.Count >= PassedCells::Batch)
      {
        this->EndQueue(frustum);
      }
    }
    this->EndQueue(frustum);
    left = this->KeepNeeded(frustum, waiting, next);
  }
  this->ClearPassages();
  this->AllInRows = true;
}

//------------------------------------------------------------------------------
void CellQueueTracer::EndQueue(const Frustum& frustum)
{
  if (this->Queue.Count == 0)
  {
    return;
  }
  Fill(this->Queue);
  this->TakeQueue(frustum);
  this->Queue.Count = 0;
}

//------------------------------------------------------------------------------
void CellQueueTracer::Fill(PassedCells& cells)
{
  std::fill_n(cells.Codes + cells.Count, PassedCells::Spare, cells.Codes[0]);
  std::fill_n(cells.First + cells.Count, PassedCells::Spare, cells.First[0]);
}

//------------------------------------------------------------------------------
void CellQueueTracer::LoadCorners(bool areCopied, Candidates& candidates) const
{
  for (int i = candidates.Count; i < candidates.Count + 16; ++i)
  {
    candidates.Ray[i] = candidates.Ray[0];
    for (auto& coordinates : candidates.Cell)
    {
      coordinates[i] = coordinates[0];
    }
  }
  this->TheKernels.LoadCorners[this->Corners->GetType(areCopied)](
    this->Corners->GetStrides(areCopied), candidates);
}

}
