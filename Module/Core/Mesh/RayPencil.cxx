// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/RayPencil.h"

#include "Mesh/BeamFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
RayPencil::RayPencil(const LoneRays& rays, int firstPlace, int count, const Bounds& box)
  : Frame(rays.Frame[rays.Ray[firstPlace]])
  , Box(box)
{
  // Nothing is met before the box: places far from there would be less precise.
  const float* begins = rays.Begin + firstPlace;
  const double reach = Length(box.Upper * 0.5 - box.Lower * 0.5);
  this->Begin = std::clamp(
    static_cast<double>(*std::min_element(begins, begins + count)), -4.0 * reach, -0x1p-20 * reach);
  for (std::size_t k = 0; k < 2; ++k)
  {
    // In the planes where the first ray begins, and where all leave the box.
    double places[2] = { Infinity, -Infinity };
    double exits[2] = { Infinity, -Infinity };
    for (int i = 0; i < count; ++i)
    {
      const BeamNumbers& frame = rays.Frame[rays.Ray[firstPlace + i]];
      const double exit = frame.Center[k];
      const double place = exit + frame.Sign * frame.Slope[k] * this->Begin;
      places[0] = std::min(places[0], place);
      places[1] = std::max(places[1], place);
      exits[0] = std::min(exits[0], exit);
      exits[1] = std::max(exits[1], exit);
    }
    for (std::size_t end = 0; end < 2; ++end)
    {
      this->Ends[k][end] = { exits[end], (places[end] - exits[end]) / this->Begin };
    }
  }
}

//------------------------------------------------------------------------------
PencilThroughBoxes RayPencil::GetBounds() const
{
  PencilThroughBoxes bounds{};
  int entries = 0;
  int exits = PencilThroughBoxes::Sides;
  const auto add = [&](int axis, bool isUpper, const Edge& edge, double reach)
  {
    // In a box the lower end is below the upper side, and the upper end above the lower side: from
    // the depth where they meet on, or until then.
    const DepthsOfCoordinate depths(edge.AtPlane, edge.Rate, reach + this->Frame.Length);
    const bool isEntry = (depths.Rate > 0.0) != isUpper;
    bounds.Bounds[isEntry ? entries++ : --exits] = { axis, isUpper, static_cast<float>(depths.Rate),
      static_cast<float>(depths.AtZero + (isEntry ? -depths.RoomFromZero : depths.RoomFromZero)) };
  };
  const Edge ahead = { this->Frame.Plane, this->Frame.Sign };
  double reach = 0.0;
  for (std::size_t k = 0; k < 2; ++k)
  {
    const auto axis = static_cast<std::size_t>(this->Frame.Across[k]);
    for (const Edge& edge : this->Ends[k])
    {
      reach = std::max({ reach, std::abs(this->Box.Lower[axis] - edge.AtPlane),
        std::abs(this->Box.Upper[axis] - edge.AtPlane) });
    }
  }
  add(this->Frame.Along, false, ahead, reach);
  add(this->Frame.Along, true, ahead, reach);
  for (std::size_t k = 0; k < 2; ++k)
  {
    add(this->Frame.Across[k], true, this->Ends[k][0], reach);
    add(this->Frame.Across[k], false, this->Ends[k][1], reach);
  }
  bounds.NumberOfEntries = entries;
  bounds.Begin = static_cast<float>(this->Begin - 0x1p-20 * std::abs(this->Begin));
  constexpr int last = 2;
  const std::size_t k = this->Frame.Across[0] == last ? 0 : 1;
  bounds.IsUp = (this->Frame.Along == last ? this->Frame.Sign
                                           : this->Ends[k][0].Rate + this->Ends[k][1].Rate) > 0.0;
  return bounds;
}

//------------------------------------------------------------------------------
void RayPencil::BoundGroups(LoneRays& rays, int firstPlace, int count, const Bounds& box)
{
  constexpr int size = LoneRays::GroupSize;
  const int end = firstPlace + count;
  for (int place = firstPlace; place < end; place += size)
  {
    const RayPencil pencil(rays, place, std::min(size, end - place), box);
    pencil.BoundGroup(rays, place / size);
    rays.SetGroupEnd(place / size);
  }
}

//------------------------------------------------------------------------------
void RayPencil::BoundGroup(LoneRays& rays, int group) const
{
  for (int k = 0; k < 2; ++k)
  {
    const Edge& lower = this->Ends[k][0];
    const Edge& upper = this->Ends[k][1];
    rays.Lower[k][group] = static_cast<float>(lower.AtPlane);
    rays.LowerRate[k][group] = static_cast<float>(lower.Rate);
    rays.Upper[k][group] = static_cast<float>(upper.AtPlane);
    rays.UpperRate[k][group] = static_cast<float>(upper.Rate);
  }
  rays.GroupBegin[group] = static_cast<float>(this->Begin - 0x1p-20 * std::abs(this->Begin));
}

//------------------------------------------------------------------------------
PencilThroughBoxes RayPencil::GetBounds(const RayThroughBoxes& ray)
{
  PencilThroughBoxes bounds{};
  bounds.NumberOfEntries = 3;
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds.Bounds[axis] = { axis, !ray.IsUp[axis], ray.Rate[axis], ray.Earlier[axis] };
    bounds.Bounds[axis + 3] = { axis, ray.IsUp[axis], ray.Rate[axis], ray.Later[axis] };
  }
  bounds.Begin = ray.Begin;
  bounds.IsUp = ray.IsUp[2];
  return bounds;
}

}
