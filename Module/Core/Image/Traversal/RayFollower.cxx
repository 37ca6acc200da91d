// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Traversal/RayFollower.h"

#include <algorithm>
#include <utility>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void RayFollower::Follow(const RayPacket& packet, FollowedCells& cells)
{
  this->Source = &cells;
  this->Trace(packet, cells);
}

//------------------------------------------------------------------------------
/// Follows each ray through the cells of all its passages.
void RayFollower::EndSlice(const Frustum& frustum)
{
  // The passages of a ray, each with the number of the next.
  int first[RayPacket::Capacity];
  int next[Passages::Capacity];
  std::fill_n(first, RayPacket::Capacity, -1);
  for (int i = 0; i < this->Passed.Count; ++i)
  {
    next[i] = std::exchange(first[this->Passed.Segments[i].Ray], i);
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
    if (this->Source->Follow(ray, cells))
    {
      Remove(ray, this->Going);
    }
  }
  this->ClearPassages();
}

//------------------------------------------------------------------------------
void RayFollower::AddCells(int axis, int passage, std::vector<Index3>& cells) const
{
  const int* first = this->Passed.First[this->Passed.Segments[passage].Block];
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

}
