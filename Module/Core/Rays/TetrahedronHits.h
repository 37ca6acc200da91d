// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TetrahedronHits_h
#define TetrahedronHits_h

#include "Math/Arithmetic.h"
#include "Rays/RayFrame.h"

namespace vtkIsosurfaceRayTracing
{

/// Crossings whose T differ by no more than this part of them are in one place, but for rounding:
/// it leaves some 1e-15 of a sum of three products.
constexpr double PartOfSamePlace = 1e-12;

/// The least sum of areas that weights are made of: the inverse of one that is near to the smallest
/// numbers would overflow.
constexpr double LeastSumOfAreas = 0x1p-900;

/// Turns the areas opposite to the corners of a triangle that a ray crosses into their weights: not
/// negative, with the sum one. Left tells whether the areas are positive.
template <typename Number>
SIMD_INLINE void MakeWeights(decltype(Number() < Number()) isLeft, Number weights[3])
{
  const Number sign = Select(isLeft, Number(1.0), Number(-1.0));
  for (int i = 0; i < 3; ++i)
  {
    weights[i] = Max(sign * weights[i], Number(0.0));
  }
  const Number sum = weights[0] + weights[1] + weights[2];
  const Number inverse = 1.0 / sum;
  const auto hasArea = LeastSumOfAreas < sum;
  for (int i = 0; i < 3; ++i)
  {
    weights[i] = Select(hasArea, weights[i] * inverse, Number(1.0 / 3.0));
  }
}

/// Finds where rays meet an isosurface in tetrahedra: one ray, or one for each lane.
///
/// The values are linear along a ray: they are known from the two faces that it crosses, and there
/// from the ray and the face alone; so they are the same for the tetrahedron behind a face.
template <typename Number>
class TetrahedronHits
{
public:
  using Mask = decltype(Number() < Number());

  /// The corners in the frame of the ray, in the order of their ids.
  FramePointOf<Number> Points[4];
  /// The differences between their values and the isovalue.
  Number Differences[4];

  Number T;
  Number Weights[4];
  Mask Entering;

  /// Returns where there are hits; only there the numbers are defined.
  SIMD_INLINE Mask Find()
  {
    this->FindEdges();
    const Mask crosses012 = this->Crosses(this->Edge01, this->Edge12, this->Edge02);
    const Mask crosses013 = this->Crosses(this->Edge01, this->Edge13, this->Edge03);
    const Mask crosses023 = this->Crosses(this->Edge02, this->Edge23, this->Edge03);
    const Mask crosses123 = this->Crosses(this->Edge12, this->Edge23, this->Edge13);
    // Of the crossed faces, in this order, the first one has corner 0 and the last one corner 3.
    const Mask isCrossed = crosses012 | crosses013 | crosses023;
    const Mask oneIs012 = crosses012;
    const Mask oneIs023 = AndNot(AndNot(crosses023, crosses013), crosses012);
    const Mask otherIs123 = crosses123;
    const Mask otherIs013 = AndNot(AndNot(crosses013, crosses023), crosses123);
    const Face one = this->MakeOne(oneIs012, oneIs023);
    const Face other = this->MakeOther(otherIs013, otherIs123);
    const Mask isInsideAtOne = IsInside(one.Difference);
    const Mask isInsideAtOther = IsInside(other.Difference);
    const Mask isHit = isCrossed & (isInsideAtOne ^ isInsideAtOther);
    if (!Any(isHit))
    {
      return isHit;
    }
    const Number fraction = one.Difference / (one.Difference - other.Difference);
    this->T = Lerp(one.T, other.T, fraction);
    for (int i = 0; i < 4; ++i)
    {
      this->Weights[i] = Lerp(one.Weights[i], other.Weights[i], fraction);
    }
    Mask isOneFirst = one.T < other.T;
    const Mask isClose = Abs(one.T - other.T) <= PartOfSamePlace * (Abs(one.T) + Abs(other.T));
    if (Any(isClose & isHit))
    {
      // Where the ray passes a vertex, an edge or a flat cell. The second face is seen from
      // outside where the others are seen from inside.
      const Mask oneIs013 = AndNot(crosses013, crosses012);
      const Mask entersAtOne = one.IsLeft ^ oneIs013 ^ this->IsMirrored();
      isOneFirst = (isClose & entersAtOne) | AndNot(isOneFirst, isClose);
    }
    this->Entering = (isOneFirst & isInsideAtOther) | AndNot(isInsideAtOne, isOneFirst);
    return isHit;
  }

private:
  using Edge = FrameEdge<Number>;

  /// Where the ray crosses a face.
  struct Face
  {
    Mask IsLeft;
    /// Of all four corners.
    Number Weights[4];
    Number T;
    Number Difference;
  };

  SIMD_INLINE void FindEdges()
  {
    this->Edge01 = Edge(this->Points[0], this->Points[1]);
    this->Edge02 = Edge(this->Points[0], this->Points[2]);
    this->Edge03 = Edge(this->Points[0], this->Points[3]);
    this->Edge12 = Edge(this->Points[1], this->Points[2]);
    this->Edge13 = Edge(this->Points[1], this->Points[3]);
    this->Edge23 = Edge(this->Points[2], this->Points[3]);
  }

  /// Whether the ray crosses the face of three corners a < b < c.
  SIMD_INLINE static Mask Crosses(const Edge& ab, const Edge& bc, const Edge& ac)
  {
    return AndNot(ab.IsLeft ^ ac.IsLeft, ab.IsLeft ^ bc.IsLeft);
  }

  /// The face of the corners 0, 1 or 2, and 2 or 3.
  SIMD_INLINE Face MakeOne(Mask is012, Mask is023) const
  {
    const Number zero = 0.0;
    Face face;
    face.IsLeft = (is023 & this->Edge02.IsLeft) | AndNot(this->Edge01.IsLeft, is023);
    Number weights[3] = { Select(is012, this->Edge12.Area,
                            Select(is023, this->Edge23.Area, this->Edge13.Area)),
      0.0 - Select(is012, this->Edge02.Area, this->Edge03.Area),
      Select(is023, this->Edge02.Area, this->Edge01.Area) };
    MakeWeights(face.IsLeft, weights);
    face.Weights[0] = weights[0];
    face.Weights[1] = Select(is023, zero, weights[1]);
    face.Weights[2] = Select(is012, weights[2], Select(is023, weights[1], zero));
    face.Weights[3] = Select(is012, zero, weights[2]);
    this->Interpolate(face);
    return face;
  }

  /// The face of the corners 0 or 1, 1 or 2, and 3.
  SIMD_INLINE Face MakeOther(Mask is013, Mask is123) const
  {
    const Number zero = 0.0;
    Face face;
    face.IsLeft = (is013 & this->Edge01.IsLeft) | (is123 & this->Edge12.IsLeft) |
      AndNot(AndNot(this->Edge02.IsLeft, is013), is123);
    Number weights[3] = { Select(is013, this->Edge13.Area, this->Edge23.Area),
      0.0 - Select(is123, this->Edge13.Area, this->Edge03.Area),
      Select(is013, this->Edge01.Area, Select(is123, this->Edge12.Area, this->Edge02.Area)) };
    MakeWeights(face.IsLeft, weights);
    face.Weights[0] = Select(is123, zero, weights[0]);
    face.Weights[1] = Select(is123, weights[0], Select(is013, weights[1], zero));
    face.Weights[2] = Select(is013, zero, weights[1]);
    face.Weights[3] = weights[2];
    this->Interpolate(face);
    return face;
  }

  /// A weight of zero adds nothing: the sums are those of the three corners, to the last bit.
  SIMD_INLINE void Interpolate(Face& face) const
  {
    face.T = face.Weights[0] * this->Points[0].T;
    face.Difference = face.Weights[0] * this->Differences[0];
    for (int i = 1; i < 4; ++i)
    {
      face.T = face.T + face.Weights[i] * this->Points[i].T;
      face.Difference = face.Difference + face.Weights[i] * this->Differences[i];
    }
  }

  /// Whether the corners are left-handed in the frame of the ray.
  SIMD_INLINE Mask IsMirrored() const
  {
    Number edges[3][3];
    Number longest = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      edges[i][0] = this->Points[i + 1].X - this->Points[0].X;
      edges[i][1] = this->Points[i + 1].Y - this->Points[0].Y;
      edges[i][2] = this->Points[i + 1].T - this->Points[0].T;
      longest = Max(longest, Abs(edges[i][2]));
    }
    // The scale of t is that of the direction: it may be any.
    const Mask hasLength = 0.0 < longest;
    for (int i = 0; i < 3; ++i)
    {
      edges[i][2] = Select(hasLength, edges[i][2] / longest, Number(0.0));
    }
    const Number determinant =
      edges[0][0] * (edges[1][1] * edges[2][2] - edges[1][2] * edges[2][1]) +
      edges[0][1] * (edges[1][2] * edges[2][0] - edges[1][0] * edges[2][2]) +
      edges[0][2] * (edges[1][0] * edges[2][1] - edges[1][1] * edges[2][0]);
    return determinant < 0.0;
  }

  Edge Edge01;
  Edge Edge02;
  Edge Edge03;
  Edge Edge12;
  Edge Edge13;
  Edge Edge23;
};

}

#endif
