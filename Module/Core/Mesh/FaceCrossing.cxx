// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/FaceCrossing.h"

#include "Rays/TetrahedronHits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Whether a closed polygon of edges surrounds the ray an odd number of times: whether so many of
/// them cross the half plane beside it (x > 0 and y = 0; a point there is below).
template <typename Face>
bool IsInside(const Face& face, const FramePoint* points)
{
  bool isInside = false;
  for (int i = 0; i < face.Count; ++i)
  {
    const FramePoint& a = points[face.Corners[i]];
    const FramePoint& b = points[face.Corners[(i + 1) % face.Count]];
    const bool goesUp = b.Y > 0.0;
    isInside ^= (a.Y > 0.0) != goesUp && FrameEdge<double>(a, b).IsLeft == goesUp;
  }
  return isInside;
}

/// Whether all corners of a face are on one side of the ray.
bool IsBeside(const CellFace& face, const FramePoint* points)
{
  bool isLeft = true;
  bool isRight = true;
  bool isBelow = true;
  bool isAbove = true;
  for (int i = 0; i < face.Count; ++i)
  {
    const FramePoint& p = points[face.Corners[i]];
    isLeft = isLeft && p.X < 0.0;
    isRight = isRight && p.X > 0.0;
    isBelow = isBelow && p.Y < 0.0;
    isAbove = isAbove && p.Y > 0.0;
  }
  return isLeft || isRight || isBelow || isAbove;
}

/// A point of a bilinear patch.
struct PatchPoint
{
  double U;
  double V;

  /// How far it is outside of the patch.
  double GetExcess() const
  {
    return std::max({ -this->U, this->U - 1.0, -this->V, this->V - 1.0, 0.0 });
  }
};

/// The points of a bilinear patch at the origin, unless it is degenerate: of all of it, not of the
/// part within the patch alone. The corners are in order around it.
class PatchPoints
{
public:
  explicit PatchPoints(const FramePoint (&p)[4])
    : A{ p[0].X, p[0].Y }
    , B{ p[1].X - p[0].X, p[1].Y - p[0].Y }
    , C{ p[3].X - p[0].X, p[3].Y - p[0].Y }
    , D{ (p[2].X - p[3].X) - this->B[0], (p[2].Y - p[3].Y) - this->B[1] }
  {
    // At the origin a + v c and b + v d are parallel.
    const double c0 = Cross(this->A, this->B);
    const double c1 = Cross(this->A, this->D) + Cross(this->C, this->B);
    const double c2 = Cross(this->C, this->D);
    const double discriminant = c1 * c1 - 4.0 * c0 * c2;
    if (!(discriminant >= 0.0))
    {
      // By rounding, perhaps: what is nearest to a solution.
      this->Add(-0.5 * c1 / c2);
      return;
    }
    const double q = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
    this->Add(q / c2);
    this->Add(c0 / q);
    this->AreExact = true;
  }

  /// Whether the corners are counterclockwise about a point.
  bool IsCounterclockwise(const PatchPoint& p) const
  {
    const Pair alongU = { this->B[0] + p.V * this->D[0], this->B[1] + p.V * this->D[1] };
    const Pair alongV = { this->C[0] + p.U * this->D[0], this->C[1] + p.U * this->D[1] };
    return Cross(alongU, alongV) > 0.0;
  }

  int Count = 0;
  PatchPoint Points[2];
  bool AreExact = false;

private:
  using Pair = std::array<double, 2>;

  static double Cross(const Pair& s, const Pair& t) { return s[0] * t[1] - s[1] * t[0]; }

  void Add(double v)
  {
    const Pair from = { this->A[0] + v * this->C[0], this->A[1] + v * this->C[1] };
    const Pair way = { this->B[0] + v * this->D[0], this->B[1] + v * this->D[1] };
    const double square = way[0] * way[0] + way[1] * way[1];
    const double u = -(from[0] * way[0] + from[1] * way[1]) / square;
    if (std::isfinite(u) && std::isfinite(v))
    {
      this->Points[this->Count++] = { u, v };
    }
  }

  /// The point at (u, v) is A + u B + v C + u v D.
  Pair A;
  Pair B;
  Pair C;
  Pair D;
};

/// Whether the parametric coordinates of a cell are left-handed in the frame of the ray, in the
/// middle.
bool IsMirrored(const MeshCell& cell, const FramePoint* points)
{
  std::array<Vector3, 3> edges = GetMiddleEdges(cell,
    [points](int corner) {
      return Vector3{ points[corner].X, points[corner].Y, points[corner].T };
    });
  // The scale of t is that of the direction: it may be any.
  double longest = 0.0;
  for (const Vector3& edge : edges)
  {
    longest = std::max(longest, std::abs(edge[2]));
  }
  for (Vector3& edge : edges)
  {
    edge[2] = longest > 0.0 ? edge[2] / longest : 0.0;
  }
  return Dot(Cross(edges[0], edges[1]), edges[2]) < 0.0;
}

}

//------------------------------------------------------------------------------
/// The corners of a face in an order that does not depend on the cell: from the one with the
/// smallest id on, to its neighbour with the smaller id.
struct FaceCrossings::OrderedFace
{
  OrderedFace(const MeshCell& cell, const CellFace& face, bool isMirrored)
    : Count(face.Count)
  {
    const auto id = [&cell, &face](int i) { return cell.Ids[face.Corners[i % face.Count]]; };
    int first = 0;
    for (int i = 1; i < face.Count; ++i)
    {
      first = id(i) < id(first) ? i : first;
    }
    const bool isForward = id(first + 1) <= id(first + face.Count - 1);
    for (int i = 0; i < face.Count; ++i)
    {
      this->Corners[i] =
        face.Corners[(isForward ? first + i : first + face.Count - i) % face.Count];
    }
    this->IsOutward = isForward != isMirrored;
  }

  int Count;
  int Corners[MaximumFaceCorners];
  /// Whether they are counterclockwise seen from outside, in the frame of the ray.
  bool IsOutward;
};

//------------------------------------------------------------------------------
void FaceCrossings::Find(const MeshCell& cell, const FramePoint* points)
{
  this->Count = 0;
  const ShapeTraits& traits = GetTraits(cell.Shape);
  const bool isMirrored = IsMirrored(cell, points);
  for (int i = 0; i < traits.Faces; ++i)
  {
    if (IsBeside(traits.Face[i], points))
    {
      continue;
    }
    const OrderedFace face(cell, traits.Face[i], isMirrored);
    if (face.Count == 3)
    {
      this->AddTriangle(face, points);
    }
    else
    {
      this->AddQuadrangle(face, points);
    }
  }
  this->PutInOrder();
}

//------------------------------------------------------------------------------
void FaceCrossings::PutInOrder()
{
  // Those at the same t stay in order. (std::stable_sort() allocates memory.)
  for (FaceCrossing* next = this->Crossings; next < this->Crossings + this->Count; ++next)
  {
    FaceCrossing* place = std::upper_bound(this->Crossings, next, *next,
      [](const FaceCrossing& a, const FaceCrossing& b) { return a.T < b.T; });
    std::rotate(place, next, next + 1);
  }
  if (this->Count != 2 || this->Crossings[0].Entering)
  {
    return;
  }
  // Where the ray passes a vertex, an edge or a flat cell.
  const double first = this->Crossings[0].T;
  const double last = this->Crossings[1].T;
  if (last - first <= PartOfSamePlace * (std::abs(first) + std::abs(last)))
  {
    std::swap(this->Crossings[0], this->Crossings[1]);
  }
}

//------------------------------------------------------------------------------
void FaceCrossings::AddTriangle(const OrderedFace& face, const FramePoint* points)
{
  const FramePoint& a = points[face.Corners[0]];
  const FramePoint& b = points[face.Corners[1]];
  const FramePoint& c = points[face.Corners[2]];
  const FrameEdge<double> ab(a, b);
  const FrameEdge<double> bc(b, c);
  const FrameEdge<double> ca(c, a);
  const bool isLeft = ab.IsLeft;
  if (bc.IsLeft != isLeft || ca.IsLeft != isLeft)
  {
    return;
  }
  double weights[3] = { bc.Area, ca.Area, ab.Area };
  MakeWeights(isLeft, weights);
  this->Add(face, weights, isLeft, points);
}

//------------------------------------------------------------------------------
void FaceCrossings::AddQuadrangle(const OrderedFace& face, const FramePoint* points)
{
  const FramePoint corners[4] = { points[face.Corners[0]], points[face.Corners[1]],
    points[face.Corners[2]], points[face.Corners[3]] };
  const PatchPoints found(corners);
  const auto add = [this, &face, &found, points](const PatchPoint& point)
  {
    const double u = std::clamp(point.U, 0.0, 1.0);
    const double v = std::clamp(point.V, 0.0, 1.0);
    const double weights[4] = { (1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v };
    this->Add(face, weights, found.IsCounterclockwise(point), points);
  };
  const PatchPoint& one = found.Points[0];
  const PatchPoint& other = found.Points[1];
  if (IsInside(face, points))
  {
    // The parity is certain: there is one.
    const bool takesOther = found.Count == 2 && other.GetExcess() < one.GetExcess();
    add(found.Count == 0 ? PatchPoint{ 0.5, 0.5 } : (takesOther ? other : one));
  }
  else if (found.AreExact && found.Count == 2 && one.GetExcess() == 0.0 && other.GetExcess() == 0.0)
  {
    add(one);
    add(other);
  }
}

//------------------------------------------------------------------------------
void FaceCrossings::Add(
  const OrderedFace& face, const double* weights, bool isLeft, const FramePoint* points)
{
  FaceCrossing& crossing = this->Crossings[this->Count++];
  crossing.Count = face.Count;
  crossing.Entering = isLeft != face.IsOutward;
  crossing.T = 0.0;
  for (int i = 0; i < face.Count; ++i)
  {
    crossing.Corners[i] = face.Corners[i];
    crossing.Weights[i] = weights[i];
    crossing.T += weights[i] * points[face.Corners[i]].T;
  }
}

}
