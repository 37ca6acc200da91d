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
  this->Trace(packet, cells, cells.NeedsOrder() ? Order::FrontToBack : Order::Any);
}

//------------------------------------------------------------------------------
void RayFollower::BeginFrustum(const Frustum& /*frustum*/)
{
  this->CellsOfSlice.clear();
  std::fill_n(this->First, RayPacket::Capacity, -1);
}

//------------------------------------------------------------------------------
void RayFollower::AddBlock(const Frustum& frustum, const Index3& /*block*/)
{
  if (this->Passed.Count >= Passages::Batch)
  {
    this->TakeCells(frustum.Axis);
  }
}

//------------------------------------------------------------------------------
/// Follows each ray through the cells of all its passages.
void RayFollower::EndSlice(const Frustum& frustum)
{
  this->TakeCells(frustum.Axis);
  for (int ray = 0; ray < this->Packet->Count; ++ray)
  {
    int next = std::exchange(this->First[ray], -1);
    if (next < 0)
    {
      continue;
    }
    this->CellsOfRay.clear();
    while (next >= 0)
    {
      const LinkedCell& linked = this->CellsOfSlice[static_cast<std::size_t>(next)];
      this->CellsOfRay.push_back(linked.Cell);
      next = linked.Next;
    }
    if (this->Source->Follow(ray, this->CellsOfRay))
    {
      Remove(ray, this->Going);
    }
  }
  this->CellsOfSlice.clear();
}

//------------------------------------------------------------------------------
void RayFollower::TakeCells(int axis)
{
  for (int passage = 0; passage < this->Passed.Count; ++passage)
  {
    int& first = this->First[this->Passed.Segments[passage].Ray];
    this->ForEachCell(axis, passage,
      [this, &first](const Index3& cell)
      {
        const auto number = static_cast<int>(this->CellsOfSlice.size());
        this->CellsOfSlice.push_back({ cell, std::exchange(first, number) });
      });
  }
  this->ClearPassages();
}

}
