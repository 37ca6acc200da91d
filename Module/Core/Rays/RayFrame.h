// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayFrame_h
#define RayFrame_h

#include "Math/Arithmetic.h"
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
template <typename Number>
struct FramePointOf
{
  Number X;
  Number Y;
  Number T;
};
using FramePoint = FramePointOf<double>;

/// The frame of a ray as numbers: its origin along its longest axis and the two across, the shears,
/// and the inverse of the direction along.
template <typename Number>
struct FrameNumbers
{
  Number Origin[3];
  Number ShearX;
  Number ShearY;
  Number Inverse;

  /// Given the coordinates of a point along and across.
  SIMD_INLINE FramePointOf<Number> Get(Number pointAlong, Number pointX, Number pointY) const
  {
    const Number along = pointAlong - this->Origin[0];
    const Number x = pointX - this->Origin[1];
    const Number y = pointY - this->Origin[2];
    return { x - this->ShearX * along, y - this->ShearY * along, along * this->Inverse };
  }
};

/// The frame of a ray: space is sheared along its longest axis, so that the ray becomes that axis.
class RayFrame
{
public:
  RayFrame(const Vector3& origin, const Vector3& direction)
  {
    const Vector3 size = { std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2]) };
    this->Along = size[0] >= size[1] && size[0] >= size[2] ? 0 : (size[1] >= size[2] ? 1 : 2);
    const std::size_t x = this->AcrossX();
    const std::size_t y = this->AcrossY();
    const double inverse = 1.0 / direction[this->Along];
    this->Numbers = { { origin[this->Along], origin[x], origin[y] }, direction[x] * inverse,
      direction[y] * inverse, inverse };
  }

  FramePoint Get(const Vector3& point) const
  {
    return this->Numbers.Get(point[this->Along], point[this->AcrossX()], point[this->AcrossY()]);
  }

  /// What t changes by on such a way along the axis.
  double ToT(double length) const { return length * std::abs(this->Numbers.Inverse); }

  /// The longest axis, and those across.
  std::size_t GetAxis(std::size_t number) const { return (this->Along + number) % 3; }
  std::size_t AcrossX() const { return this->GetAxis(1); }
  std::size_t AcrossY() const { return this->GetAxis(2); }

  const FrameNumbers<double>& GetNumbers() const { return this->Numbers; }

private:
  std::size_t Along;
  FrameNumbers<double> Numbers;
};

/// Whether the largest coordinate of a cell across a ray is such that no product overflows or
/// vanishes.
template <typename Number>
SIMD_INLINE auto IsSafeCoordinate(Number largest)
{
  return (0x1p-100 < largest) & (largest < 0x1p100);
}

/// The ray and two points across it.
template <typename Number>
struct FrameEdge
{
  using Mask = decltype(Number() < Number());

  /// Twice the area. With the points the other way round it is the opposite one, to the last bit.
  Number Area;
  /// Whether it is positive, exactly. Where it is zero (the ray meets the edge), the ray counts as
  /// moved by (e, e^2) with an e smaller than any number: then no ray meets an edge. Two points at
  /// one place have no order; no face with such an edge has an area that a ray could cross.
  Mask IsLeft;

  FrameEdge() = default;
  SIMD_INLINE FrameEdge(const FramePointOf<Number>& a, const FramePointOf<Number>& b)
  {
    const Number one = a.X * b.Y;
    const Number other = b.X * a.Y;
    this->Area = one - other;
    this->IsLeft = other < one;
    const Mask isEqual = one == other;
    if (!Any(isEqual))
    {
      return;
    }
    // Of products that are the same, the parts that rounding took off decide.
    const Number restOfOne = FusedMultiplyAdd(a.X, b.Y, 0.0 - one);
    const Number restOfOther = FusedMultiplyAdd(b.X, a.Y, 0.0 - other);
    const Mask isMeeting = isEqual & (restOfOne == restOfOther);
    this->IsLeft = this->IsLeft | (isEqual & (restOfOther < restOfOne)) |
      (isMeeting & ((b.Y < a.Y) | ((a.Y == b.Y) & (a.X < b.X))));
  }
};

}

#endif
