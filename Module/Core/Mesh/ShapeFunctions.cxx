// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/ShapeFunctions.h"

#include "Math/FlatEdges.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A factor of a weight that is linear in a coordinate, and its derivative.
struct Factor
{
  double Value;
  double Slope;
};

Factor Rising(double coordinate)
{
  return { coordinate, 1.0 };
}

Factor Falling(double coordinate)
{
  return { 1.0 - coordinate, -1.0 };
}

/// A weight that is a product of a factor for each coordinate, and its derivatives.
struct Product
{
  double Value;
  Vector3 Slopes;
};

Product Multiply(const Factor& r, const Factor& s, const Factor& t)
{
  return { r.Value * s.Value * t.Value,
    { r.Slope * s.Value * t.Value, r.Value * s.Slope * t.Value, r.Value * s.Value * t.Slope } };
}

/// The weights of one corner after the other.
template <typename Visit>
void ForEachWeight(CellShape shape, const Vector3& p, const Visit& visit)
{
  constexpr Factor one = { 1.0, 0.0 };
  const double rest = 1.0 - p[0] - p[1];
  switch (shape)
  {
    case CellShape::Tetrahedron:
      visit(0, Product{ rest - p[2], { -1.0, -1.0, -1.0 } });
      visit(1, Product{ p[0], { 1.0, 0.0, 0.0 } });
      visit(2, Product{ p[1], { 0.0, 1.0, 0.0 } });
      visit(3, Product{ p[2], { 0.0, 0.0, 1.0 } });
      return;
    case CellShape::Wedge:
      for (const int level : { 0, 3 })
      {
        const Factor t = level == 0 ? Falling(p[2]) : Rising(p[2]);
        visit(level, Product{ rest * t.Value, { -t.Value, -t.Value, rest * t.Slope } });
        visit(level + 1, Multiply(Rising(p[0]), one, t));
        visit(level + 2, Multiply(one, Rising(p[1]), t));
      }
      return;
    case CellShape::Pyramid:
      visit(0, Multiply(Falling(p[0]), Falling(p[1]), Falling(p[2])));
      visit(1, Multiply(Rising(p[0]), Falling(p[1]), Falling(p[2])));
      visit(2, Multiply(Rising(p[0]), Rising(p[1]), Falling(p[2])));
      visit(3, Multiply(Falling(p[0]), Rising(p[1]), Falling(p[2])));
      visit(4, Multiply(one, one, Rising(p[2])));
      return;
    case CellShape::Voxel:
    case CellShape::Hexahedron:
      break;
  }
  const ShapeTraits& traits = GetTraits(shape);
  for (int i = 0; i < 8; ++i)
  {
    visit(traits.Trilinear[i],
      Multiply((i & 1) != 0 ? Rising(p[0]) : Falling(p[0]),
        (i & 2) != 0 ? Rising(p[1]) : Falling(p[1]), (i & 4) != 0 ? Rising(p[2]) : Falling(p[2])));
  }
}

}

//------------------------------------------------------------------------------
void GetWeights(CellShape shape, const Vector3& parametric, CornerWeights& weights)
{
  ForEachWeight(shape, parametric,
    [&weights](int corner, const Product& weight) { weights[corner] = weight.Value; });
}

//------------------------------------------------------------------------------
void GetWeightDerivatives(
  CellShape shape, const Vector3& parametric, CornerWeights (&derivatives)[3])
{
  ForEachWeight(shape, parametric,
    [&derivatives](int corner, const Product& weight)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        derivatives[axis][corner] = weight.Slopes[axis];
      }
    });
}

//------------------------------------------------------------------------------
Vector3 GetParametric(CellShape shape, const CornerWeights& w)
{
  switch (shape)
  {
    case CellShape::Tetrahedron:
      return { w[1], w[2], w[3] };
    case CellShape::Voxel:
      return { w[1] + w[3] + w[5] + w[7], w[2] + w[3] + w[6] + w[7], w[4] + w[5] + w[6] + w[7] };
    case CellShape::Hexahedron:
      return { w[1] + w[2] + w[5] + w[6], w[2] + w[3] + w[6] + w[7], w[4] + w[5] + w[6] + w[7] };
    case CellShape::Wedge:
      return { w[1] + w[4], w[2] + w[5], w[3] + w[4] + w[5] };
    case CellShape::Pyramid:
      break;
  }
  const double base = w[0] + w[1] + w[2] + w[3];
  return base > 0.0 ? Vector3{ (w[1] + w[2]) / base, (w[2] + w[3]) / base, w[4] }
                    : Vector3{ 0.5, 0.5, 1.0 };
}

//------------------------------------------------------------------------------
Vector3 GetParametric(CellShape shape, const Vector3& trilinear)
{
  // In a wedge the edges of the lower and the upper triangle at y = 1 are points.
  return shape == CellShape::Wedge
    ? Vector3{ trilinear[0] * (1.0 - trilinear[1]), trilinear[1], trilinear[2] }
    : trilinear;
}

//------------------------------------------------------------------------------
Vector3 GetPoint(const MeshCell& cell, const Vector3& parametric)
{
  CornerWeights weights;
  GetWeights(cell.Shape, parametric, weights);
  return GetWeightedPoint(cell, weights);
}

namespace
{

/// The derivatives of the point and of the value by parametric coordinates.
struct CellDerivatives
{
  Vector3 Edges[3] = {};
  Vector3 Slopes = {};
};

CellDerivatives GetDerivatives(const MeshCell& cell, const Vector3& parametric)
{
  CellDerivatives made;
  if (cell.Shape == CellShape::Tetrahedron)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      made.Edges[axis] = cell.Points[axis + 1] - cell.Points[0];
      made.Slopes[axis] = cell.Values[axis + 1] - cell.Values[0];
    }
    return made;
  }
  Vector3 inside = parametric;
  if (cell.Shape == CellShape::Pyramid)
  {
    // At the apex the other two coordinates do not move the point.
    inside[2] = std::min(inside[2], 1.0 - 1e-6);
  }
  CornerWeights derivatives[3];
  GetWeightDerivatives(cell.Shape, inside, derivatives);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < cell.Count; ++i)
    {
      made.Edges[axis] = made.Edges[axis] + cell.Points[i] * derivatives[axis][i];
      // Differences: the derivatives of all weights have the sum zero.
      made.Slopes[axis] += (cell.Values[i] - cell.Values[0]) * derivatives[axis][i];
    }
  }
  return made;
}

/// The gradient as a fraction, Numerator / (Volume * Length), with edges about 1: no product of
/// them overflows or vanishes.
struct GradientFraction
{
  explicit GradientFraction(CellDerivatives cell)
    : Length(std::max({ vtkIsosurfaceRayTracing::Length(cell.Edges[0]),
        vtkIsosurfaceRayTracing::Length(cell.Edges[1]),
        vtkIsosurfaceRayTracing::Length(cell.Edges[2]) }))
  {
    Vector3(&edges)[3] = cell.Edges;
    for (Vector3& edge : edges)
    {
      edge = { edge[0] / this->Length, edge[1] / this->Length, edge[2] / this->Length };
    }
    const Vector3 normals[3] = { Cross(edges[1], edges[2]), Cross(edges[2], edges[0]),
      Cross(edges[0], edges[1]) };
    this->Numerator =
      normals[0] * cell.Slopes[0] + normals[1] * cell.Slopes[1] + normals[2] * cell.Slopes[2];
    this->Volume = Dot(edges[0], normals[0]);
    this->IsFlat = AreFlat(edges[0].data(), edges[1].data(), edges[2].data(), this->Volume);
  }

  /// What edges were divided by.
  double Length;
  Vector3 Numerator;
  double Volume;
  bool IsFlat;
};

}

//------------------------------------------------------------------------------
bool FindGradient(const MeshCell& cell, const Vector3& parametric, Vector3& gradient)
{
  const GradientFraction fraction(GetDerivatives(cell, parametric));
  gradient = {};
  if (fraction.IsFlat)
  {
    return false;
  }
  const Vector3 direction = fraction.Numerator * (1.0 / fraction.Volume);
  const double length = fraction.Length;
  const auto isFinite = [](const Vector3& v) { return std::isfinite(v[0] + v[1] + v[2]); };
  const Vector3 slope = { direction[0] / length, direction[1] / length, direction[2] / length };
  if (!isFinite(direction))
  {
    return false;
  }
  gradient = isFinite(slope) ? slope : direction;
  return true;
}

//------------------------------------------------------------------------------
Vector3 GetGradient(const MeshCell& cell, const Vector3& parametric)
{
  Vector3 gradient;
  if (FindGradient(cell, parametric, gradient))
  {
    return gradient;
  }
  // With slopes about 1 it is finite.
  CellDerivatives derivatives = GetDerivatives(cell, parametric);
  Vector3& slopes = derivatives.Slopes;
  const double largest =
    std::max({ std::abs(slopes[0]), std::abs(slopes[1]), std::abs(slopes[2]) });
  slopes = { slopes[0] / largest, slopes[1] / largest, slopes[2] / largest };
  const GradientFraction fraction(derivatives);
  if (!(Length(fraction.Numerator) > 0.0))
  {
    return {};
  }
  const double side = fraction.IsFlat ? 1.0 : std::copysign(1.0, fraction.Volume);
  return Normalized(fraction.Numerator) * side;
}

//------------------------------------------------------------------------------
double GetVolume(const MeshCell& cell)
{
  const std::array<Vector3, 3> edges =
    GetMiddleEdges(cell, [&cell](int corner) { return cell.Points[corner]; });
  return std::abs(Dot(Cross(edges[0], edges[1]), edges[2]));
}

}
