// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ExactMesh.h"

#include <algorithm>
#include <cmath>

namespace Oracle
{
namespace
{

template <typename Number>
using Vector = std::array<Number, 3>;

template <typename Number>
Vector<Number> Minus(const Vector<Number>& a, const Vector<Number>& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

template <typename Number>
Vector<Number> To(const Triple& a)
{
  return { a[0], a[1], a[2] };
}

template <typename Number>
Vector<Number> Cross(const Vector<Number>& a, const Vector<Number>& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

template <typename Number>
Number Dot(const Vector<Number>& a, const Vector<Number>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename Number>
Number GetSum(const Vector<Number>& a)
{
  const auto absolute = [](Number x) { return x < 0 ? -x : x; };
  return absolute(a[0]) + absolute(a[1]) + absolute(a[2]);
}

/// Solves a system of columns by Cramer's rule; false if it has no unique solution.
template <typename Number>
bool Solve(
  const Vector<Number> (&columns)[3], const Vector<Number>& right, Vector<Number>& solution)
{
  const Vector<Number> normals[3] = { Cross(columns[1], columns[2]), Cross(columns[2], columns[0]),
    Cross(columns[0], columns[1]) };
  const Number determinant = Dot(columns[0], normals[0]);
  if (determinant == 0)
  {
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    solution[i] = Dot(right, normals[i]) / determinant;
  }
  return true;
}

Quad GetLargestDifference(const Cell& cell, double isovalue)
{
  Quad largest = 0;
  for (const double value : cell.Values)
  {
    largest = std::max(largest, Absolute(static_cast<Quad>(value) - static_cast<Quad>(isovalue)));
  }
  return largest;
}

/// The weights of the corners, by the definition of VTK's cells.
template <typename Number>
std::array<Number, 8> GetWeights(std::size_t corners, const Vector<Number>& p)
{
  const Number r = p[0];
  const Number s = p[1];
  const Number t = p[2];
  switch (corners)
  {
    case 4:
      return { 1 - r - s - t, r, s, t };
    case 5:
      return { (1 - r) * (1 - s) * (1 - t), r * (1 - s) * (1 - t), r * s * (1 - t),
        (1 - r) * s * (1 - t), t };
    case 6:
      return { (1 - r - s) * (1 - t), r * (1 - t), s * (1 - t), (1 - r - s) * t, r * t, s * t };
    default:
      return { (1 - r) * (1 - s) * (1 - t), r * (1 - s) * (1 - t), r * s * (1 - t),
        (1 - r) * s * (1 - t), (1 - r) * (1 - s) * t, r * (1 - s) * t, r * s * t, (1 - r) * s * t };
  }
}

/// A point and its value minus the isovalue.
template <typename Number>
struct Sample
{
  Vector<Number> Point;
  Number Value;
};

template <typename Number>
Sample<Number> Evaluate(const Cell& cell, double isovalue, const Vector<Number>& parametric)
{
  const std::array<Number, 8> weights = GetWeights(cell.Points.size(), parametric);
  Sample<Number> sample = { {}, 0 };
  for (std::size_t i = 0; i < cell.Points.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sample.Point[axis] += weights[i] * static_cast<Number>(cell.Points[i][axis]);
    }
    sample.Value +=
      weights[i] * (static_cast<Number>(cell.Values[i]) - static_cast<Number>(isovalue));
  }
  return sample;
}

/// How far parametric coordinates are within a cell of so many corners; negative outside.
template <typename Number>
Number GetDepth(std::size_t corners, const Vector<Number>& p)
{
  Number depth = std::min({ p[0], p[1], p[2] });
  const bool isSimplex = corners == 4 || corners == 6;
  depth =
    std::min(depth, isSimplex ? 1 - p[0] - p[1] - (corners == 4 ? p[2] : Number(0)) : 1 - p[0]);
  depth = isSimplex ? depth : std::min(depth, 1 - p[1]);
  return corners == 4 ? depth : std::min(depth, 1 - p[2]);
}

/// Two vectors across the line.
template <typename Number>
std::array<Vector<Number>, 2> GetFrame(const Line& line)
{
  const Vector<Number> direction = To<Number>(line.Direction);
  std::size_t smallest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    smallest =
      std::abs(line.Direction[axis]) < std::abs(line.Direction[smallest]) ? axis : smallest;
  }
  Vector<Number> axis = {};
  axis[smallest] = 1;
  const Vector<Number> one = Cross(direction, axis);
  return { one, Cross(direction, one) };
}

/// The equations of a root, at a point of the cell: two distances across the line, and the value.
template <typename Number>
class Equations
{
public:
  Equations(const Cell& cell, double isovalue, const Line& line)
    : TheCell(cell)
    , Isovalue(isovalue)
    , Unit(static_cast<Number>(GetLargestDifference(cell, isovalue)))
    , Origin(To<Number>(line.Origin))
    , Frame(GetFrame<Number>(line))
  {
  }

  Vector<Number> Get(const Vector<Number>& p) const
  {
    const Sample<Number> sample = Evaluate(this->TheCell, this->Isovalue, p);
    const Vector<Number> way = Minus(sample.Point, this->Origin);
    return { Dot(way, this->Frame[0]), Dot(way, this->Frame[1]), sample.Value / this->Unit };
  }

  /// The weights are linear in each coordinate: differences are derivatives.
  Vector<Number> GetDerivative(const Vector<Number>& p, std::size_t axis) const
  {
    Vector<Number> behind = p;
    behind[axis] += 1;
    return Minus(this->Get(behind), this->Get(p));
  }

  /// One step of Newton's method; false where it has none.
  bool Step(Vector<Number>& p) const
  {
    const Vector<Number> columns[3] = { this->GetDerivative(p, 0), this->GetDerivative(p, 1),
      this->GetDerivative(p, 2) };
    Vector<Number> step;
    if (!Solve(columns, this->Get(p), step))
    {
      return false;
    }
    p = Minus(p, step);
    return GetSum(p) < 100;
  }

  /// Until steps are so small.
  bool Converge(Vector<Number>& p, double precision) const
  {
    for (int i = 0; i < 30; ++i)
    {
      const Vector<Number> before = p;
      if (!this->Step(p))
      {
        return false;
      }
      if (GetSum(Minus(p, before)) < precision)
      {
        return true;
      }
    }
    return false;
  }

private:
  const Cell& TheCell;
  double Isovalue;
  Number Unit;
  Vector<Number> Origin;
  std::array<Vector<Number>, 2> Frame;
};

CellRoot MakeRoot(const Cell& cell, std::int64_t number, double isovalue, const Line& line,
  const QuadTriple& parametric)
{
  const QuadTriple direction = To<Quad>(line.Direction);
  const QuadTriple way = Minus(Evaluate(cell, isovalue, parametric).Point, To<Quad>(line.Origin));
  // The coordinates change along the line so that it stays where it is across.
  QuadTriple columns[3];
  QuadTriple slopes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    QuadTriple behind = parametric;
    behind[axis] += 1;
    const Sample<Quad> here = Evaluate(cell, isovalue, parametric);
    const Sample<Quad> there = Evaluate(cell, isovalue, behind);
    columns[axis] = Minus(there.Point, here.Point);
    slopes[axis] = there.Value - here.Value;
  }
  QuadTriple change = {};
  const bool hasSlope = Solve(columns, direction, change);
  const Quad slope = hasSlope ? Dot(slopes, change) : Quad(0);
  Quad steepest = 0;
  Quad stretch = 0;
  for (std::size_t axis = 0; axis < 3 && hasSlope; ++axis)
  {
    QuadTriple along = {};
    along[axis] = 1;
    Solve(columns, along, change);
    steepest = std::max(steepest, Absolute(Dot(slopes, change)));
    stretch = std::max({ stretch, Absolute(change[0]), Absolute(change[1]), Absolute(change[2]) });
  }
  const Quad size = GetSize(cell);
  const Quad unit = GetLargestDifference(cell, isovalue) / size;
  return { number, Dot(way, direction) / Dot(direction, direction),
    static_cast<double>(slope / (unit * static_cast<Quad>(Length(line.Direction)))),
    static_cast<double>(steepest / unit), static_cast<double>(stretch * size),
    static_cast<double>(GetDepth(cell.Points.size(), parametric)) };
}

}

//------------------------------------------------------------------------------
double GetSize(const Cell& cell)
{
  double size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax_element(cell.Points.begin(), cell.Points.end(),
      [axis](const Triple& a, const Triple& b) { return a[axis] < b[axis]; });
    size = std::max(size, (*high)[axis] - (*low)[axis]);
  }
  return size;
}

//------------------------------------------------------------------------------
double GetLargestCoordinate(const Cell& cell)
{
  double largest = 0.0;
  for (const Triple& p : cell.Points)
  {
    largest = std::max({ largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) });
  }
  return largest;
}

//------------------------------------------------------------------------------
std::vector<CellRoot> FindRoots(
  const Cell& cell, std::int64_t number, double isovalue, const Line& line, int starts)
{
  std::vector<CellRoot> roots;
  const auto isInside = [isovalue](double value) { return value >= isovalue; };
  const auto inside = std::count_if(cell.Values.begin(), cell.Values.end(), isInside);
  if (inside == 0 || inside == static_cast<std::ptrdiff_t>(cell.Values.size()))
  {
    return roots;
  }
  const Equations<double> equations(cell, isovalue, line);
  const Equations<Quad> exact(cell, isovalue, line);
  const std::size_t corners = cell.Points.size();
  const int count = corners == 4 ? 1 : starts;
  for (int i = 0; i < count * count * count; ++i)
  {
    Triple start = { (i % count + 0.5) / count, (i / count % count + 0.5) / count,
      (i / count / count + 0.5) / count };
    // Double precision sorts out starts that lead nowhere.
    if (count > 1 && (!equations.Converge(start, 1e-6) || GetDepth(corners, start) < -1e-3))
    {
      continue;
    }
    QuadTriple p = To<Quad>(start);
    if (!exact.Converge(p, 1e-18) || GetDepth(corners, p) < 0)
    {
      continue;
    }
    const CellRoot root = MakeRoot(cell, number, isovalue, line, p);
    if (root.T >= line.Begin && root.T <= line.End &&
      std::none_of(roots.begin(), roots.end(),
        [&root, &cell, &line](const CellRoot& other)
        { return Absolute(other.T - root.T) * Length(line.Direction) < GetSize(cell) * 1e-14; }))
    {
      roots.push_back(root);
    }
  }
  return roots;
}

//------------------------------------------------------------------------------
Residual GetResidual(
  const Cell& cell, double isovalue, const Line& line, double t, const Triple& parametric)
{
  const Sample<Quad> sample = Evaluate(cell, isovalue, To<Quad>(parametric));
  QuadTriple way = Minus(sample.Point, To<Quad>(line.Origin));
  Quad square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    way[axis] -= static_cast<Quad>(t) * static_cast<Quad>(line.Direction[axis]);
    square += way[axis] * way[axis];
  }
  return { static_cast<double>(sample.Value / GetLargestDifference(cell, isovalue)),
    std::sqrt(static_cast<double>(square)) / GetSize(cell) };
}

}
