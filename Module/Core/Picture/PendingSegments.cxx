// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/PendingSegments.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
/// Doubles the room of all lists.
void PendingSegments::MakeRoom()
{
  const int room = std::max(16, 2 * this->Room);
  const auto ofRow = [](int places)
  { return static_cast<std::ptrdiff_t>(places) * CloudTile::Edge; };
  const auto all = static_cast<std::size_t>(ofRow(room) * CloudTile::Edge);
  std::vector<double> depths(all);
  std::vector<SegmentLight> lights(all);
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    const std::ptrdiff_t from = row * ofRow(this->Room);
    const std::ptrdiff_t to = row * ofRow(room);
    std::copy_n(this->Depths.begin() + from, ofRow(this->Room), depths.begin() + to);
    std::copy_n(this->Lights.begin() + from, ofRow(this->Room), lights.begin() + to);
  }
  this->Depths.swap(depths);
  this->Lights.swap(lights);
  this->Keys.resize(static_cast<std::size_t>(ofRow(room)));
  this->Room = room;
}

//------------------------------------------------------------------------------
std::size_t PendingSegments::GetCount() const
{
  return std::accumulate(this->Counts.begin(), this->Counts.end(), std::size_t{ 0 });
}

//------------------------------------------------------------------------------
int PendingSegments::GetLongest() const
{
  return *std::max_element(this->Counts.begin(), this->Counts.end());
}

//------------------------------------------------------------------------------
const std::vector<std::size_t>& PendingSegments::FindOrder(int pixel)
{
  this->Order.clear();
  for (int i = 0; i < this->Counts[static_cast<std::size_t>(pixel)]; ++i)
  {
    this->Order.push_back(this->GetIndex(pixel, i));
  }
  std::sort(this->Order.begin(), this->Order.end(),
    [this](std::size_t a, std::size_t b) { return this->IsBefore(a, b); });
  return this->Order;
}

//------------------------------------------------------------------------------
bool PendingSegments::IsBefore(std::size_t a, std::size_t b) const
{
  if (this->Depths[a] != this->Depths[b])
  {
    return this->Depths[a] < this->Depths[b];
  }
  const SegmentLight& one = this->Lights[a];
  const SegmentLight& other = this->Lights[b];
  return std::tie(one.Transmittance, one.Color[0], one.Color[1], one.Color[2]) <
    std::tie(other.Transmittance, other.Color[0], other.Color[1], other.Color[2]);
}

}
