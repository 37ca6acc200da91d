// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/TrilinearSystem.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Contraction ends where a box has edges of this length: Newton's method goes on.
constexpr double SmallestEdge = 1e-8;
/// Boxes that a cell is cut into at most. Only where solutions are no points (a ray in the surface)
/// are there so many; where the ray enters and leaves the surface is decided on the faces.
constexpr int MaximumBoxes = 500;
/// What an interval is left beyond its contracted ends, as a part of the whole cell: so many
/// roundings that the functions keep both signs in it.
constexpr double Margin = 1e-12;
/// What rounding may move the corners of a part by, in units of the largest corner of the whole.
constexpr double Rounding = 1e-15;

/// Whether a corner is at the upper end of an axis.
bool IsUpper(std::size_t corner, std::size_t axis)
{
  return (corner >> axis & 1U) != 0;
}

/// The corners at the ends of one of the four edges along an axis.
struct Edge
{
  Edge(std::size_t number, std::size_t axis)
  {
    const std::size_t below = number & ((std::size_t{ 1 } << axis) - 1);
    this->Lower = ((number - below) << 1U | below) & 7U;
    this->Upper = (this->Lower | std::size_t{ 1 } << axis) & 7U;
  }

  std::size_t Lower;
  std::size_t Upper;
};

struct Interval
{
  double Low;
  double High;

  double GetMiddle() const { return 0.5 * (this->Low + this->High); }
  double GetLength() const { return this->High - this->Low; }
};

using Box = std::array<Interval, 3>;

/// The corners of a trilinear function on a part of its box along one axis.
CellCorners Restrict(const CellCorners& f, std::size_t axis, const Interval& part)
{
  CellCorners restricted;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Edge edge(i, axis);
    restricted[edge.Lower] = Lerp(f[edge.Lower], f[edge.Upper], part.Low);
    restricted[edge.Upper] = Lerp(f[edge.Lower], f[edge.Upper], part.High);
  }
  return restricted;
}

using Rows = std::array<Vector3, 3>;

/// The inverse of a matrix of rows; false if it is singular, or nearly.
bool Invert(const Rows& m, Rows& inverse)
{
  const Rows columns = { Cross(m[1], m[2]), Cross(m[2], m[0]), Cross(m[0], m[1]) };
  const double determinant = Dot(m[0], columns[0]);
  const double size = std::abs(m[0][0] * columns[0][0]) + std::abs(m[0][1] * columns[0][1]) +
    std::abs(m[0][2] * columns[0][2]);
  if (!(std::abs(determinant) > 1e-12 * size))
  {
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      inverse[i][j] = columns[j][i] / determinant;
    }
  }
  return true;
}

/// Narrows an interval, [0, 1], to where a function may vanish that goes from a value in one
/// interval to a value in another, and a margin beyond. Returns whether anything is left.
bool Contract(const Interval& before, const Interval& behind, double margin, Interval& part)
{
  part = { 0.0, 1.0 };
  if (before.High < 0.0)
  {
    if (behind.High < 0.0)
    {
      return false;
    }
    part.Low = before.High / (before.High - behind.High);
  }
  else if (behind.High < 0.0)
  {
    part.High = before.High / (before.High - behind.High);
  }
  if (before.Low > 0.0)
  {
    if (behind.Low > 0.0)
    {
      return false;
    }
    part.Low = std::max(part.Low, before.Low / (before.Low - behind.Low));
  }
  else if (behind.Low > 0.0)
  {
    part.High = std::min(part.High, before.Low / (before.Low - behind.Low));
  }
  part = { std::max(part.Low - margin, 0.0), std::min(part.High + margin, 1.0) };
  return part.Low <= part.High;
}

/// The system in a part of the cell.
struct Part
{
  TrilinearSystem System;
  /// What rounding may move the corners by.
  Vector3 Error;
  Box Place = { Interval{ 0.0, 1.0 }, Interval{ 0.0, 1.0 }, Interval{ 0.0, 1.0 } };

  /// Values equal to the isovalue are inside: the surface does not touch, it crosses.
  bool MayHaveSolution() const
  {
    for (const std::size_t i : { 0U, 1U })
    {
      const auto [low, high] =
        std::minmax_element(this->System.Functions[i].begin(), this->System.Functions[i].end());
      if (*low > 0.0 || *high < 0.0)
      {
        return false;
      }
    }
    const auto [low, high] =
      std::minmax_element(this->System.Functions[2].begin(), this->System.Functions[2].end());
    return *low < 0.0 && *high >= 0.0;
  }

  bool IsSmall() const
  {
    return std::all_of(this->Place.begin(), this->Place.end(),
      [](const Interval& edge) { return edge.GetLength() < SmallestEdge; });
  }

  Vector3 GetMiddle() const
  {
    return { this->Place[0].GetMiddle(), this->Place[1].GetMiddle(), this->Place[2].GetMiddle() };
  }

  Rows GetJacobianInMiddle() const
  {
    Rows jacobian = {};
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        for (std::size_t corner = 0; corner < 8; ++corner)
        {
          const double value = this->System.Functions[i][corner];
          jacobian[i][axis] += IsUpper(corner, axis) ? 0.25 * value : -0.25 * value;
        }
      }
    }
    return jacobian;
  }

  /// Which part of this along an axis may have solutions, by a combination of the functions that is
  /// nearly the coordinate.
  bool ContractAlong(std::size_t axis, const Vector3& weights, Interval& part) const
  {
    Interval ends[2] = { { HUGE_VAL, -HUGE_VAL }, { HUGE_VAL, -HUGE_VAL } };
    for (std::size_t corner = 0; corner < 8; ++corner)
    {
      const double value = weights[0] * this->System.Functions[0][corner] +
        weights[1] * this->System.Functions[1][corner] +
        weights[2] * this->System.Functions[2][corner];
      Interval& end = ends[IsUpper(corner, axis) ? 1 : 0];
      end = { std::min(end.Low, value), std::max(end.High, value) };
    }
    const double error = std::abs(weights[0]) * this->Error[0] +
      std::abs(weights[1]) * this->Error[1] + std::abs(weights[2]) * this->Error[2];
    for (Interval& end : ends)
    {
      end = { end.Low - error, end.High + error };
    }
    return Contract(ends[0], ends[1], Margin / this->Place[axis].GetLength(), part);
  }

  void CutTo(std::size_t axis, const Interval& part)
  {
    for (CellCorners& function : this->System.Functions)
    {
      function = Restrict(function, axis, part);
    }
    const Interval before = this->Place[axis];
    this->Place[axis] = { before.Low + part.Low * before.GetLength(),
      before.Low + part.High * before.GetLength() };
  }

  /// The axis along which the functions change most: in a cell with corners that coincide the
  /// others may not change them at all.
  std::size_t FindSteepestAxis(const TrilinearSystem& whole) const
  {
    Vector3 change = {};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto [low, high] =
        std::minmax_element(whole.Functions[i].begin(), whole.Functions[i].end());
      const double size = *high - *low;
      for (std::size_t axis = 0; axis < 3 && size > 0.0; ++axis)
      {
        for (std::size_t k = 0; k < 4; ++k)
        {
          const Edge edge(k, axis);
          const CellCorners& f = this->System.Functions[i];
          change[axis] = std::max(change[axis], std::abs(f[edge.Upper] - f[edge.Lower]) / size);
        }
      }
    }
    return static_cast<std::size_t>(
      std::max_element(change.begin(), change.end()) - change.begin());
  }
};

enum class Outcome
{
  Empty,
  Smaller,
  Unchanged
};

Outcome Contract(Part& part)
{
  Rows inverse;
  if (!Invert(part.GetJacobianInMiddle(), inverse))
  {
    return Outcome::Unchanged;
  }
  Box contracted;
  double volume = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!part.ContractAlong(axis, inverse[axis], contracted[axis]))
    {
      return Outcome::Empty;
    }
    volume *= contracted[axis].GetLength();
  }
  if (!(volume < 0.5))
  {
    return Outcome::Unchanged;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    part.CutTo(axis, contracted[axis]);
  }
  return Outcome::Smaller;
}

/// Newton's method, from a small box that has a solution. (The differences across the box may be
/// nothing but rounding: derivatives are those of the whole.)
Vector3 Refine(const Vector3& start, const TrilinearSystem& whole)
{
  Vector3 p = start;
  for (int step = 0; step < 2; ++step)
  {
    const Vector3 values = { Interpolate(whole.Functions[0], p), Interpolate(whole.Functions[1], p),
      Interpolate(whole.Functions[2], p) };
    Rows inverse;
    if (!Invert(whole.GetJacobian(p), inverse))
    {
      break;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      p[axis] = std::clamp(p[axis] - Dot(inverse[axis], values), 0.0, 1.0);
    }
  }
  return p;
}

/// Bisection meets a solution on the border of two boxes in both.
void AddSolution(const Vector3& solution, std::vector<Vector3>& solutions)
{
  const auto isSame = [&solution](const Vector3& other)
  {
    const Vector3 way = other - solution;
    return std::max({ std::abs(way[0]), std::abs(way[1]), std::abs(way[2]) }) < 4.0 * SmallestEdge;
  };
  if (std::none_of(solutions.begin(), solutions.end(), isSame))
  {
    solutions.push_back(solution);
  }
}

}

//------------------------------------------------------------------------------
void TrilinearSystem::Solve(std::vector<Vector3>& solutions) const
{
  solutions.clear();
  Part whole = { *this, {} };
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (const double corner : this->Functions[i])
    {
      whole.Error[i] = std::max(whole.Error[i], Rounding * std::abs(corner));
    }
  }
  std::vector<Part> parts = { whole };
  for (int boxes = 0; !parts.empty() && boxes < MaximumBoxes; ++boxes)
  {
    Part part = parts.back();
    parts.pop_back();
    Outcome outcome = Outcome::Smaller;
    while (outcome == Outcome::Smaller)
    {
      if (!part.MayHaveSolution())
      {
        outcome = Outcome::Empty;
      }
      else if (part.IsSmall())
      {
        AddSolution(Refine(part.GetMiddle(), *this), solutions);
        outcome = Outcome::Empty;
      }
      else
      {
        outcome = Contract(part);
      }
    }
    if (outcome == Outcome::Unchanged)
    {
      const std::size_t axis = part.FindSteepestAxis(*this);
      parts.push_back(part);
      parts.back().CutTo(axis, { 0.5, 1.0 });
      parts.push_back(part);
      parts.back().CutTo(axis, { 0.0, 0.5 });
    }
  }
}

}
