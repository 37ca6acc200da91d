// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/BeamFrame.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The sum of the slopes across the longest axis is at most 2 for any direction; beams are wider.
constexpr double LargestSlope = 8.0;

/// The axis along which a direction is longest.
std::size_t FindLongestAxis(const Vector3& d)
{
  const Vector3 size = { std::abs(d[0]), std::abs(d[1]), std::abs(d[2]) };
  return size[0] >= size[1] && size[0] >= size[2] ? 0 : (size[1] >= size[2] ? 1 : 2);
}

/// One of so many rays.
RaySet TakeEvery(int stride, const RaySet& rays)
{
  RaySet taken = {};
  int number = 0;
  ForEachRay(rays,
    [&](int ray)
    {
      if (number++ % stride == 0)
      {
        Add(ray, taken);
      }
    });
  return taken;
}

/// Where a line meets a plane across an axis, and its slopes.
struct LinePoint
{
  double Place[2];
  double Slope[2];
};

LinePoint MeetPlane(const RayPacket& lines, int line, const BeamNumbers& frame)
{
  LinePoint point{};
  const double way = frame.Plane - lines.Origin[frame.Along][line];
  for (std::size_t k = 0; k < 2; ++k)
  {
    const int across = frame.Across[k];
    point.Slope[k] = lines.Direction[across][line] / lines.Direction[frame.Along][line];
    point.Place[k] = lines.Origin[across][line] + point.Slope[k] * way;
  }
  return point;
}

}

//------------------------------------------------------------------------------
bool IsSinglePrecision(const Bounds& box)
{
  double largest = 0.0;
  double size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    largest = std::max({ largest, std::abs(box.Lower[axis]), std::abs(box.Upper[axis]) });
    size = std::max(size, box.Upper[axis] - box.Lower[axis]);
  }
  return largest < 0x1p60 && size > 0x1p-60;
}

//------------------------------------------------------------------------------
bool BeamFrame::Find(const RayPacket& lines, const RaySet& some, const Bounds& box)
{
  constexpr int few = 4;
  const int all = CountOf(some);
  if (all > 4 * few && !BeamFrame().Find(lines, TakeEvery(all / few, some), box))
  {
    return false; // It is known after a few.
  }
  int numbers[RayPacket::Capacity];
  int count = 0;
  Vector3 direction = {};
  ForEachRay(some,
    [&](int line)
    {
      numbers[count++] = line;
      direction = direction + Normalized(lines.GetDirection(line));
    });
  this->SetAxes(direction, box);
  LinePoint points[RayPacket::Capacity];
  double lower[2] = { HUGE_VAL, HUGE_VAL };
  double upper[2] = { -HUGE_VAL, -HUGE_VAL };
  for (int i = 0; i < count; ++i)
  {
    points[i] = MeetPlane(lines, numbers[i], this->Numbers);
    const double forward = lines.Direction[this->Numbers.Along][numbers[i]] * this->Numbers.Sign;
    if (!(forward > 0.0) ||
      !(std::abs(points[i].Slope[0]) + std::abs(points[i].Slope[1]) < LargestSlope))
    {
      return false;
    }
    for (std::size_t k = 0; k < 2; ++k)
    {
      lower[k] = std::min(lower[k], points[i].Place[k]);
      upper[k] = std::max(upper[k], points[i].Place[k]);
    }
  }
  // Slopes are linear in places: by the first line and the one that is farthest from it.
  double square = 0.0;
  this->Numbers.Spread = 0.0;
  for (int i = 1; i < count; ++i)
  {
    const double way[2] = { points[i].Place[0] - points[0].Place[0],
      points[i].Place[1] - points[0].Place[1] };
    const double rise[2] = { points[i].Slope[0] - points[0].Slope[0],
      points[i].Slope[1] - points[0].Slope[1] };
    const double squareOfWay = way[0] * way[0] + way[1] * way[1];
    if (squareOfWay > square)
    {
      square = squareOfWay;
      this->Numbers.Spread = (rise[0] * way[0] + rise[1] * way[1]) / square;
    }
  }
  for (std::size_t k = 0; k < 2; ++k)
  {
    this->Numbers.Center[k] = 0.5 * (lower[k] + upper[k]);
    this->Numbers.Slope[k] =
      points[0].Slope[k] + this->Numbers.Spread * (this->Numbers.Center[k] - points[0].Place[k]);
  }
  this->SetReach(box);
  const double size = 0.5 * std::max(upper[0] - lower[0], upper[1] - lower[1]);
  // Rays need not be between the lines to the last bit.
  double error =
    this->SetSize(size * (1.0 + 0x1p-12) + 0x1p-40 * (this->Reach + this->Numbers.Length));
  for (int i = 0; i < count; ++i)
  {
    error = std::max(error, 16.0 * GetLabelError(this->Numbers, points[i].Place, points[i].Slope));
  }
  return this->SetMargin(error, box);
}

//------------------------------------------------------------------------------
bool BeamFrame::FindAlone(const RayPacket& lines, int line, const Bounds& box)
{
  const Vector3 direction = lines.GetDirection(line);
  this->SetAxes(direction, box);
  if (!(std::abs(direction[static_cast<std::size_t>(this->Numbers.Along)]) > 0.0))
  {
    return false;
  }
  const LinePoint point = MeetPlane(lines, line, this->Numbers);
  std::copy_n(point.Place, 2, this->Numbers.Center);
  std::copy_n(point.Slope, 2, this->Numbers.Slope);
  this->Numbers.Spread = 0.0;
  this->SetReach(box);
  // A line has no size: any unit will do that keeps rounding below it.
  return this->SetMargin(this->SetSize(0x1p-20 * (this->Reach + this->Numbers.Length)), box);
}

//------------------------------------------------------------------------------
/// Those along which a direction goes through the box, and across.
void BeamFrame::SetAxes(const Vector3& direction, const Bounds& box)
{
  const std::size_t along = FindLongestAxis(direction);
  this->Numbers.Along = static_cast<int>(along);
  this->Numbers.Across[0] = static_cast<int>((along + 1) % 3);
  this->Numbers.Across[1] = static_cast<int>((along + 2) % 3);
  this->Numbers.Sign = direction[along] > 0.0 ? 1.0 : -1.0;
  this->Numbers.Plane = this->Numbers.Sign > 0.0 ? box.Upper[along] : box.Lower[along];
  this->Numbers.Length = box.Upper[along] - box.Lower[along];
}

//------------------------------------------------------------------------------
void BeamFrame::SetReach(const Bounds& box)
{
  this->Reach = 0.0;
  for (std::size_t k = 0; k < 2; ++k)
  {
    const auto axis = static_cast<std::size_t>(this->Numbers.Across[k]);
    this->Reach = std::max({ this->Reach, std::abs(box.Lower[axis] - this->Numbers.Center[k]),
      std::abs(box.Upper[axis] - this->Numbers.Center[k]) });
  }
}

//------------------------------------------------------------------------------
/// Sets the size that a label of 1 has. Returns by how much labels may be wrong, since slopes are
/// rounded.
double BeamFrame::SetSize(double size)
{
  this->Numbers.InverseSize = 1.0 / size;
  return std::max(0x1p-30, 0x1p-47 * this->Numbers.Length * this->Numbers.InverseSize / SmallestW);
}

//------------------------------------------------------------------------------
/// Sets by how much labels may be wrong. Returns whether all is told in single precision.
bool BeamFrame::SetMargin(double error, const Bounds& box)
{
  this->Numbers.Margin = static_cast<float>(error);
  return IsSinglePrecision(box) && error < 1.0 &&
    std::abs(this->Numbers.Spread) * this->Numbers.Length < 256.0 &&
    (this->Reach + this->Numbers.Length) * this->Numbers.InverseSize < 0x1p60;
}

//------------------------------------------------------------------------------
BeamProjection BeamFrame::GetProjection() const
{
  BeamProjection beam{};
  beam.Along = this->Numbers.Along;
  beam.IsUp = this->Numbers.Sign > 0.0;
  beam.Plane = static_cast<float>(this->Numbers.Plane);
  beam.Spread = static_cast<float>(this->Numbers.Spread);
  beam.Scale = static_cast<float>(this->Numbers.InverseSize);
  beam.PlaneRest = static_cast<float>(static_cast<double>(beam.Plane) - this->Numbers.Plane);
  double reach = this->Reach;
  double steepest = 0.0;
  for (std::size_t k = 0; k < 2; ++k)
  {
    beam.Across[k] = this->Numbers.Across[k];
    beam.Center[k] = static_cast<float>(this->Numbers.Center[k]);
    beam.CenterRest[k] =
      static_cast<float>(static_cast<double>(beam.Center[k]) - this->Numbers.Center[k]);
    beam.Slope[k] = static_cast<float>(this->Numbers.Slope[k] * this->Numbers.InverseSize);
    reach = std::max(reach, this->Reach + std::abs(static_cast<double>(beam.CenterRest[k])));
    steepest = std::max(steepest, std::abs(this->Numbers.Slope[k]));
  }
  const double length = this->Numbers.Length + std::abs(static_cast<double>(beam.PlaneRest));
  // Rounding of the beam, and of its rays at the smallest W.
  beam.Error =
    static_cast<float>(0x1p-20 * (reach + steepest * length) * this->Numbers.InverseSize +
      static_cast<double>(this->Numbers.Margin) * SmallestW);
  beam.RelativeError =
    static_cast<float>(0x1p-18 + 0x1p-20 * length * std::abs(this->Numbers.Spread) / SmallestW);
  beam.DepthError = static_cast<float>(0x1p-20 * length);
  beam.Begin = -HUGE_VALF;
  return beam;
}

//------------------------------------------------------------------------------
float BeamFrame::FindBegin(const RayPacket& rays, const RaySet& some) const
{
  const int along = this->Numbers.Along;
  double begin = HUGE_VAL;
  ForEachRay(some,
    [&](int ray)
    {
      const double coordinate =
        rays.Origin[along][ray] + rays.Begin[ray] * rays.Direction[along][ray];
      begin = std::min(begin, this->Numbers.Sign * (coordinate - this->Numbers.Plane));
    });
  return static_cast<float>(begin - 0x1p-20 * (std::abs(begin) + this->Numbers.Length));
}

//------------------------------------------------------------------------------
bool BeamFrame::HasLabelsFrom(float depth) const
{
  return 1.0 + this->Numbers.Spread * this->Numbers.Sign * static_cast<double>(depth) > SmallestW;
}

//------------------------------------------------------------------------------
void BeamFrame::FindBounds(const RayPacket& lines, float (&lower)[2], float (&upper)[2]) const
{
  constexpr float margin = 0x1p-12F;
  for (std::size_t k = 0; k < 2; ++k)
  {
    lower[k] = HUGE_VALF;
    upper[k] = -HUGE_VALF;
    for (int i = 0; i < lines.Count; ++i)
    {
      const double place = MeetPlane(lines, i, this->Numbers).Place[k];
      const auto label =
        static_cast<float>((place - this->Numbers.Center[k]) * this->Numbers.InverseSize);
      lower[k] = std::min(lower[k], label - margin);
      upper[k] = std::max(upper[k], label + margin);
    }
  }
}

}
