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
  this->Reach = 0.0;
  for (std::size_t k = 0; k < 2; ++k)
  {
    this->Reach = std::max({ this->Reach, std::abs(box.Lower[this->Across[k]] - this->Center[k]),
      std::abs(box.Upper[this->Across[k]] - this->Center[k]) });
  }
  const double size = 0.5 * std::max(upper[0] - lower[0], upper[1] - lower[1]);
  // Rays need not be between the lines to the last bit; and there may be one line only.
  this->InverseSize = 1.0 / (size * (1.0 + 0x1p-12) + 0x1p-40 * (this->Reach + this->Length));
  double error = 0x1p-30;
  for (int i = 0; i < 4; ++i)
  {
    error = std::max(error, 16.0 * this->GetError(corners[i].Place, corners[i].Slope));
  }
  this->Margin = static_cast<float>(error);
  return error < 1.0 && std::abs(this->Spread) * this->Length < 256.0 &&
    (this->Reach + this->Length) * this->InverseSize < 0x1p60;
}

//------------------------------------------------------------------------------
BeamProjection BeamFrame::GetProjection() const
{
  BeamProjection beam{};
  beam.Along = static_cast<int>(this->Along);
  beam.IsUp = this->Sign > 0.0;
  beam.Plane = static_cast<float>(this->Plane);
  beam.Spread = static_cast<float>(this->Spread);
  beam.Scale = static_cast<float>(this->InverseSize);
  beam.SmallestW = static_cast<float>(4.0 * SmallestW);
  beam.PlaneRest = static_cast<float>(static_cast<double>(beam.Plane) - this->Plane);
  double reach = this->Reach;
  double steepest = 0.0;
  for (std::size_t k = 0; k < 2; ++k)
  {
    beam.Across[k] = static_cast<int>(this->Across[k]);
    beam.Center[k] = static_cast<float>(this->Center[k]);
    beam.CenterRest[k] = static_cast<float>(static_cast<double>(beam.Center[k]) - this->Center[k]);
    beam.Slope[k] = static_cast<float>(this->Slope[k] * this->InverseSize);
    reach = std::max(reach, this->Reach + std::abs(static_cast<double>(beam.CenterRest[k])));
    steepest = std::max(steepest, std::abs(this->Slope[k]));
  }
  const double length = this->Length + std::abs(static_cast<double>(beam.PlaneRest));
  beam.Error = static_cast<float>(0x1p-20 * (reach + steepest * length) * this->InverseSize);
  beam.RelativeError =
    static_cast<float>(0x1p-18 + 0x1p-20 * length * std::abs(this->Spread) / SmallestW);
  beam.DepthError = static_cast<float>(0x1p-20 * length);
  return beam;
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
