// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayFrame_h
#define RayFrame_h

#include "Math/Vector.h"

#include <cmath>
#include <cstddef>

// What a ray crosses is decided by the coordinates of points about the ray: x and y across it, and
// t along it. They are functions of the point and the ray alone, so that all cells that share a
// point have the same bits. Whatever is decided by them alone, without further rounding, is the
// same as for a mesh whose points are moved by that rounding: no ray slips between two cells.
// (S. Woop, C. Benthin, I. Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.)

namespace vtkIsosurfaceRayTracing
{

/// A point in the frame of a ray.
struct FramePoint
{
  double X;
  double Y;
  double T;
};

/// The frame of a ray: space is sheared along its longest axis, so that the ray becomes that axis.
class RayFrame
{
public:
  RayFrame(const Vector3& origin, const Vector3& direction)
    : Origin(origin)
  {
    const Vector3 size = { std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2]) };
    this->Along = size[0] >= size[1] && size[0] >= size[2] ? 0 : (size[1] >= size[2] ? 1 : 2);
    this->Inverse = 1.0 / direction[this->Along];
    this->ShearX = direction[this->AcrossX()] * this->Inverse;
    this->ShearY = direction[this->AcrossY()] * this->Inverse;
  }

  FramePoint Get(const Vector3& point) const
  {
    const double along = point[this->Along] - this->Origin[this->Along];
    const double x = point[this->AcrossX()] - this->Origin[this->AcrossX()];
    const double y = point[this->AcrossY()] - this->Origin[this->AcrossY()];
    return { x - this->ShearX * along, y - this->ShearY * along, along * this->Inverse };
  }

  /// What t changes by on such a way along the axis.
  double ToT(double length) const { return length * std::abs(this->Inverse); }

private:
  std::size_t AcrossX() const { return (this->Along + 1) % 3; }
  std::size_t AcrossY() const { return (this->Along + 2) % 3; }

  Vector3 Origin;
  std::size_t Along;
  double Inverse;
  double ShearX;
  double ShearY;
};

/// Twice the area of the triangle of the ray and two points across it. The sign for the points the
/// other way round is the opposite one, to the last bit.
inline double GetArea(const FramePoint& a, const FramePoint& b)
{
  return a.X * b.Y - b.X * a.Y;
}

/// Whether that area is positive, exactly. Where it is zero (the ray meets the edge), the ray
/// counts as moved by (e, e^2) with an e smaller than any number: then no ray meets an edge. Two
/// points at one place have no order; no face with such an edge has an area that a ray could cross.
inline bool IsLeftOf(const FramePoint& a, const FramePoint& b)
{
  const double one = a.X * b.Y;
  const double other = b.X * a.Y;
  if (one != other)
  {
    return one > other;
  }
  // Of products that are the same, the parts that rounding took off decide.
  const double restOfOne = std::fma(a.X, b.Y, -one);
  const double restOfOther = std::fma(b.X, a.Y, -other);
  if (restOfOne != restOfOther)
  {
    return restOfOne > restOfOther;
  }
  return a.Y != b.Y ? a.Y > b.Y : b.X > a.X;
}

}

#endif
