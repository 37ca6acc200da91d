// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/BeamFrame.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The widest beam: slopes across the axis.
constexpr double LargestSlope = 2.0;

/// The axis along which a direction is longest.
std::size_t FindLongestAxis(const Vector3& d)
{
  const Vector3 size = { std::abs(d[0]), std::abs(d[1]), std::abs(d[2]) };
  return size[0] >= size[1] && size[0] >= size[2] ? 0 : (size[1] >= size[2] ? 1 : 2);
}

/// Where a line meets a plane across an axis, and its slopes.
struct LinePoint
{
  double Place[2];
  double Slope[2];
};

LinePoint MeetPlane(
  const RayPacket& lines, int line, std::size_t along, const std::size_t (&across)[2], double plane)
{
  LinePoint point{};
  const double way = plane - lines.Origin[along][line];
  for (std::size_t i = 0; i < 2; ++i)
  {
    point.Slope[i] = lines.Direction[across[i]][line] / lines.Direction[along][line];
    point.Place[i] = lines.Origin[across[i]][line] + point.Slope[i] * way;
  }
  return point;
}

}

//------------------------------------------------------------------------------
bool BeamFrame::Find(const RayPacket& lines, const Bounds& box)
{
  Vector3 direction = {};
  for (int i = 0; i < lines.Count; ++i)
  {
    direction = direction + Normalized(lines.GetDirection(i));
  }
  this->Along = FindLongestAxis(direction);
  this->Across[0] = (this->Along + 1) % 3;
  this->Across[1] = (this->Along + 2) % 3;
  this->Sign = direction[this->Along] > 0.0 ? 1.0 : -1.0;
  this->Plane = this->Sign > 0.0 ? box.Upper[this->Along] : box.Lower[this->Along];
  this->Length = box.Upper[this->Along] - box.Lower[this->Along];
  this->Largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Largest =
      std::max({ this->Largest, std::abs(box.Lower[axis]), std::abs(box.Upper[axis]) });
  }
  LinePoint corners[4];
  double lower[2] = { HUGE_VAL, HUGE_VAL };
  double upper[2] = { -HUGE_VAL, -HUGE_VAL };
  for (int i = 0; i < 4; ++i)
  {
    corners[i] = MeetPlane(lines, i, this->Along, this->Across, this->Plane);
    const double along = lines.Direction[this->Along][i] * this->Sign;
    if (!(along > 0.0) ||
      !(std::abs(corners[i].Slope[0]) + std::abs(corners[i].Slope[1]) < LargestSlope))
    {
      return false;
    }
    for (std::size_t k = 0; k < 2; ++k)
    {
      lower[k] = std::min(lower[k], corners[i].Place[k]);
      upper[k] = std::max(upper[k], corners[i].Place[k]);
    }
  }
  // Slopes are linear in places: by the two corners that are farthest apart.
  double square = 0.0;
  this->Spread = 0.0;
  for (const int i : { 1, 2, 3 })
  {
    const double way[2] = { corners[i].Place[0] - corners[0].Place[0],
      corners[i].Place[1] - corners[0].Place[1] };
    const double rise[2] = { corners[i].Slope[0] - corners[0].Slope[0],
      corners[i].Slope[1] - corners[0].Slope[1] };
    const double squareOfWay = way[0] * way[0] + way[1] * way[1];
    if (squareOfWay > square)
    {
      square = squareOfWay;
      this->Spread = (rise[0] * way[0] + rise[1] * way[1]) / square;
    }
  }
  for (std::size_t k = 0; k < 2; ++k)
  {
    this->Center[k] = 0.5 * (lower[k] + upper[k]);
    this->Slope[k] = corners[0].Slope[k] + this->Spread * (this->Center[k] - corners[0].Place[k]);
  }
  const double size = 0.5 * std::max(upper[0] - lower[0], upper[1] - lower[1]);
  // Rays need not be between the lines to the last bit; and there may be one line only.
  this->InverseSize = 1.0 / (size * (1.0 + 0x1p-12) + 0x1p-40 * this->Largest);
  double error = 0x1p-30;
  for (int i = 0; i < 4; ++i)
  {
    error = std::max(error, 16.0 * this->GetError(corners[i].Place, corners[i].Slope));
  }
  this->Margin = static_cast<float>(error);
  return error < 1.0 && std::isfinite(this->InverseSize) &&
    std::isfinite(this->Spread * this->Length) && std::isfinite(this->Largest * this->InverseSize);
}

//------------------------------------------------------------------------------
BeamSides BeamFrame::GetSides() const
{
  BeamSides sides{};
  sides.Along = static_cast<int>(this->Along);
  for (int i = 0; i < 4; ++i)
  {
    // X + W >= 0, or W - X >= 0, by coordinates; the same for Y.
    const std::size_t k = static_cast<std::size_t>(i) / 2;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const double across = sign * this->InverseSize;
    const double along = this->Spread - across * this->Slope[k];
    const double offset =
      1.0 - this->Spread * this->Plane - across * (this->Center[k] - this->Slope[k] * this->Plane);
    const double largest = std::max(this->Largest, std::abs(this->Center[k]));
    const double size = 1.0 +
      (std::abs(across) * (3.0 + 2.0 * std::abs(this->Slope[k])) + 2.0 * std::abs(this->Spread)) *
        largest;
    sides.Across[i] = static_cast<int>(this->Across[k]);
    sides.SlopeAlong[i] = static_cast<float>(along);
    sides.SlopeAcross[i] = static_cast<float>(across);
    sides.Offset[i] = static_cast<float>(offset + 0x1p-20 * size);
  }
  return sides;
}

//------------------------------------------------------------------------------
/// By how much the label of a line is wrong within the box, where W is not too small: lines do not
/// pass through one point to the last bit.
double BeamFrame::GetError(const double (&place)[2], const double (&slope)[2]) const
{
  double error = 0.0;
  for (std::size_t k = 0; k < 2; ++k)
  {
    const double expected = this->Slope[k] + this->Spread * (place[k] - this->Center[k]);
    error = std::max(error, std::abs(slope[k] - expected));
  }
  return error * this->Length * this->InverseSize * (1.0 / SmallestW);
}

//------------------------------------------------------------------------------
bool BeamFrame::FindLabel(const RayPacket& packet, int ray, float (&label)[2]) const
{
  const double way = this->Plane - packet.Origin[this->Along][ray];
  double place[2];
  double slope[2];
  double largest = 0.0;
  for (std::size_t k = 0; k < 2; ++k)
  {
    slope[k] = packet.Direction[this->Across[k]][ray] * packet.Inverse[this->Along][ray];
    place[k] = packet.Origin[this->Across[k]][ray] + slope[k] * way;
    label[k] = static_cast<float>((place[k] - this->Center[k]) * this->InverseSize);
    largest = std::max(largest, std::abs(static_cast<double>(label[k])));
  }
  return packet.Direction[this->Along][ray] * this->Sign > 0.0 && largest <= 1.0 &&
    this->GetError(place, slope) <= static_cast<double>(this->Margin);
}

}
