// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ExactCrossings.h"

#include <algorithm>
#include <cmath>

namespace Oracle
{
namespace
{

using Corners = std::array<Quad, 8>;
/// Powers of the fraction of a segment.
using Cubic = std::array<Quad, 4>;

struct Slab
{
  Quad Begin;
  Quad End;
};

/// A segment of the line in a cell, by exact slabs.
struct Segment
{
  Index Cell;
  Quad Begin;
  Quad End;
};

Quad SquareRoot(const Quad& x)
{
  if (!(x > 0))
  {
    return 0;
  }
  // Into the range of a double first.
  if (x < 1e-200)
  {
    return SquareRoot(x * 0x1p600) / 0x1p300;
  }
  Quad root = std::sqrt(static_cast<double>(x));
  for (int i = 0; i < 2; ++i)
  {
    root = (root + x / root) / 2;
  }
  return root;
}

/// The part of the line between planes k and k + 1 of an axis; empty slabs have Begin > End.
std::vector<Slab> CutIntoSlabs(const Line& line, std::size_t axis, int cells)
{
  std::vector<Slab> slabs(static_cast<std::size_t>(cells));
  const Quad origin = line.Origin[axis];
  const Quad direction = line.Direction[axis];
  for (int k = 0; k < cells; ++k)
  {
    Slab& slab = slabs[static_cast<std::size_t>(k)];
    if (line.Direction[axis] == 0.0)
    {
      const bool isLast = k + 1 == cells;
      const bool within = origin >= k && (origin < k + 1 || (isLast && origin == k + 1));
      slab = within ? Slab{ line.Begin, line.End } : Slab{ 1, 0 };
      continue;
    }
    const Quad a = (k - origin) / direction;
    const Quad b = (k + 1 - origin) / direction;
    slab = { std::max<Quad>(std::min(a, b), line.Begin), std::min<Quad>(std::max(a, b), line.End) };
  }
  return slabs;
}

/// Tests every cell of the volume.
std::vector<Segment> CutIntoCells(const Field& field, const Line& line)
{
  std::array<std::vector<Slab>, 3> slabs;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    slabs[axis] = CutIntoSlabs(line, axis, field.Dimensions[axis] - 1);
  }
  std::vector<Segment> segments;
  for (int z = 0; z + 1 < field.Dimensions[2]; ++z)
  {
    const Slab& inZ = slabs[2][static_cast<std::size_t>(z)];
    for (int y = 0; inZ.Begin <= inZ.End && y + 1 < field.Dimensions[1]; ++y)
    {
      const Slab& inY = slabs[1][static_cast<std::size_t>(y)];
      const Slab both = { std::max(inY.Begin, inZ.Begin), std::min(inY.End, inZ.End) };
      for (int x = 0; both.Begin <= both.End && x + 1 < field.Dimensions[0]; ++x)
      {
        const Slab& inX = slabs[0][static_cast<std::size_t>(x)];
        const Segment segment = { { x, y, z }, std::max(inX.Begin, both.Begin),
          std::min(inX.End, both.End) };
        if (segment.Begin < segment.End)
        {
          segments.push_back(segment);
        }
      }
    }
  }
  std::sort(segments.begin(), segments.end(),
    [](const Segment& a, const Segment& b) { return a.Begin + a.End < b.Begin + b.End; });
  return segments;
}

/// Rounding of 2^-113 makes slivers of cells that the line only touches. They do not count.
bool IsNeedle(const Line& line, const Segment& segment)
{
  const double length = Length(line.Direction);
  const Quad reach = Length(line.Origin) + 1.0 + Absolute(segment.End) * length;
  return (segment.End - segment.Begin) * length < reach * 1e-30;
}

bool LoadCorners(const Field& field, const Index& cell, std::array<double, 8>& corners)
{
  bool isFinite = true;
  for (int i = 0; i < 8; ++i)
  {
    const double value = field.At(cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2));
    corners[static_cast<std::size_t>(i)] = value;
    isFinite = isFinite && std::isfinite(value);
  }
  return isFinite;
}

/// Whether all cells of the block between two are there.
bool AreFiniteBetween(const Field& field, const Index& a, const Index& b)
{
  std::array<double, 8> corners;
  for (int z = std::min(a[2], b[2]); z <= std::max(a[2], b[2]); ++z)
  {
    for (int y = std::min(a[1], b[1]); y <= std::max(a[1], b[1]); ++y)
    {
      for (int x = std::min(a[0], b[0]); x <= std::max(a[0], b[0]); ++x)
      {
        if (!LoadCorners(field, { x, y, z }, corners))
        {
          return false;
        }
      }
    }
  }
  return true;
}

bool Straddles(const std::array<double, 8>& corners, double isovalue)
{
  const auto isInside = [isovalue](double value) { return value >= isovalue; };
  return std::any_of(corners.begin(), corners.end(), isInside) &&
    !std::all_of(corners.begin(), corners.end(), isInside);
}

/// The isovalue taken off, and the largest made one.
Corners Normalize(const std::array<double, 8>& values, double isovalue)
{
  Corners difference;
  Quad largest = 0;
  for (std::size_t i = 0; i < 8; ++i)
  {
    difference[i] = static_cast<Quad>(values[i]) - static_cast<Quad>(isovalue);
    largest = std::max(largest, Absolute(difference[i]));
  }
  for (Quad& d : difference)
  {
    d /= largest > 0 ? largest : 1;
  }
  return difference;
}

Corners NormalizedCorners(const Field& field, double isovalue, const Index& cell)
{
  std::array<double, 8> corners;
  LoadCorners(field, cell, corners);
  return Normalize(corners, isovalue);
}

QuadTriple PointInCell(const Line& line, const Index& cell, const Quad& t)
{
  QuadTriple p;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    p[axis] = (static_cast<Quad>(line.Origin[axis]) - cell[axis]) +
      t * static_cast<Quad>(line.Direction[axis]);
  }
  return p;
}

/// The interpolant, by its definition.
Quad Interpolant(const Corners& d, const QuadTriple& p)
{
  Quad sum = 0;
  for (std::size_t i = 0; i < 8; ++i)
  {
    const Quad x = (i & 1) != 0 ? p[0] : 1 - p[0];
    const Quad y = (i >> 1 & 1) != 0 ? p[1] : 1 - p[1];
    const Quad z = (i >> 2) != 0 ? p[2] : 1 - p[2];
    sum += x * y * z * d[i];
  }
  return sum;
}

/// The interpolant along a segment: through its values at four points (P(0), P(1), P(-1), P(2) of
/// the segment continued), which for a cubic is exact.
Cubic AlongSegment(const Corners& d, const QuadTriple& from, const QuadTriple& to)
{
  const auto at = [&d, &from, &to](int u)
  {
    QuadTriple p;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      p[axis] = from[axis] + u * (to[axis] - from[axis]);
    }
    return Interpolant(d, p);
  };
  const Quad f0 = at(0);
  const Quad f1 = at(1);
  const Quad before = at(-1);
  const Quad after = at(2);
  const Quad c2 = (f1 + before) / 2 - f0;
  const Quad odd = (f1 - before) / 2;
  const Quad c3 = (after - f0 - 4 * c2 - 2 * odd) / 6;
  return { f0, odd - c3, c2, c3 };
}

Quad Evaluate(const Cubic& c, const Quad& u)
{
  return ((c[3] * u + c[2]) * u + c[1]) * u + c[0];
}

Quad Derivative(const Cubic& c, const Quad& u)
{
  return (3 * c[3] * u + 2 * c[2]) * u + c[1];
}

/// Where the cubic turns in (0, 1), in order, with 0 before and 1 behind.
std::vector<Quad> MonotoneEnds(const Cubic& c)
{
  std::vector<Quad> ends = { 0 };
  const Quad a = 3 * c[3];
  const Quad h = c[2];
  const Quad discriminant = h * h - a * c[1];
  if (discriminant > 0)
  {
    const Quad root = SquareRoot(discriminant);
    const Quad w = h < 0 ? root - h : -root - h;
    for (const Quad& u : { a != 0 ? w / a : Quad(-1), w != 0 ? c[1] / w : Quad(-1) })
    {
      if (u > 0 && u < 1)
      {
        ends.push_back(u);
      }
    }
    std::sort(ends.begin(), ends.end());
  }
  ends.push_back(1);
  return ends;
}

void AppendPieces(const Corners& corners, const Line& line, const Segment& segment, bool continues,
  std::vector<Piece>& pieces)
{
  const Cubic cubic = AlongSegment(corners, PointInCell(line, segment.Cell, segment.Begin),
    PointInCell(line, segment.Cell, segment.End));
  const std::vector<Quad> ends = MonotoneEnds(cubic);
  const Quad length = segment.End - segment.Begin;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
  {
    const Quad begin = segment.Begin + ends[i] * length;
    const Quad end = i + 2 == ends.size() ? segment.End : segment.Begin + ends[i + 1] * length;
    pieces.push_back({ segment.Cell, begin, end, Evaluate(cubic, ends[i]),
      Evaluate(cubic, ends[i + 1]), continues || i > 0 });
  }
}

}

//------------------------------------------------------------------------------
double Length(const Triple& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

//------------------------------------------------------------------------------
std::vector<Piece> FindPieces(const Field& field, double isovalue, const Line& line)
{
  // Through an edge or a vertex the line may go from cell to cell by any of those that meet there:
  // rounding decides by which, and if one is empty, whether the line is interrupted.
  constexpr double throughEdge = 1e-12;
  std::vector<Piece> pieces;
  bool continues = false;
  Index last = { -1, 0, 0 };
  for (const Segment& segment : CutIntoCells(field, line))
  {
    if (IsNeedle(line, segment))
    {
      continue;
    }
    if ((segment.End - segment.Begin) * Length(line.Direction) > throughEdge)
    {
      continues = continues && (last[0] < 0 || AreFiniteBetween(field, last, segment.Cell));
      last = segment.Cell;
    }
    std::array<double, 8> corners;
    if (!LoadCorners(field, segment.Cell, corners))
    {
      continues = false;
      continue;
    }
    if (Straddles(corners, isovalue))
    {
      AppendPieces(Normalize(corners, isovalue), line, segment, continues, pieces);
      continues = true;
    }
  }
  return pieces;
}

//------------------------------------------------------------------------------
Quad FindCrossing(const Field& field, double isovalue, const Line& line, const Piece& piece)
{
  const Corners corners = NormalizedCorners(field, isovalue, piece.Cell);
  const Cubic cubic = AlongSegment(
    corners, PointInCell(line, piece.Cell, piece.Begin), PointInCell(line, piece.Cell, piece.End));
  const bool insideAtLow = piece.AtBegin >= 0;
  Quad low = 0;
  Quad high = 1;
  Quad u = 0.5;
  for (int i = 0; i < 300 && high - low > 1e-33; ++i)
  {
    const Quad f = Evaluate(cubic, u);
    ((f >= 0) == insideAtLow ? low : high) = u;
    const Quad slope = Derivative(cubic, u);
    const Quad newton = slope != 0 ? u - f / slope : Quad(-1);
    const bool isWithin = newton > low && newton < high;
    // Every third step halves, so that it ends.
    const Quad next = isWithin && i % 3 != 2 ? newton : (low + high) / 2;
    if (isWithin && Absolute(newton - u) < 1e-32)
    {
      break;
    }
    u = next;
  }
  return piece.Begin + u * (piece.End - piece.Begin);
}

//------------------------------------------------------------------------------
Quad ValueAt(
  const Field& field, double isovalue, const Line& line, const Index& cell, const Quad& t)
{
  return Interpolant(NormalizedCorners(field, isovalue, cell), PointInCell(line, cell, t));
}

//------------------------------------------------------------------------------
QuadTriple GradientAt(
  const Field& field, double isovalue, const Line& line, const Index& cell, const Quad& t)
{
  const Corners d = NormalizedCorners(field, isovalue, cell);
  const QuadTriple p = PointInCell(line, cell, t);
  QuadTriple gradient;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    QuadTriple low = p;
    QuadTriple high = p;
    low[axis] = 0;
    high[axis] = 1;
    gradient[axis] = Interpolant(d, high) - Interpolant(d, low);
  }
  return gradient;
}

//------------------------------------------------------------------------------
Quad SlopeAt(
  const Field& field, double isovalue, const Line& line, const Index& cell, const Quad& t)
{
  const QuadTriple gradient = GradientAt(field, isovalue, line, cell, t);
  Quad slope = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    slope += gradient[axis] * static_cast<Quad>(line.Direction[axis]);
  }
  return slope / Length(line.Direction);
}

//------------------------------------------------------------------------------
bool IsAtBorder(
  const Field& field, const Line& line, const Index& cell, const Quad& t, double distance)
{
  const auto isEmpty = [&field](const Index& other)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (other[axis] < 0 || other[axis] + 1 >= field.Dimensions[axis])
      {
        return true;
      }
    }
    std::array<double, 8> corners;
    return !LoadCorners(field, other, corners);
  };
  const QuadTriple p = PointInCell(line, cell, t);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    Index beside = cell;
    beside[axis] += p[axis] < 0.5 ? -1 : 1;
    if (std::min(Absolute(p[axis]), Absolute(1 - p[axis])) <= distance && isEmpty(beside))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
double AngleBetween(const Triple& claimed, const QuadTriple& exact)
{
  // Scaled to the largest component first: squares may overflow.
  const double size =
    std::max({ std::abs(claimed[0]), std::abs(claimed[1]), std::abs(claimed[2]) });
  const QuadTriple a = { claimed[0] / static_cast<Quad>(size), claimed[1] / static_cast<Quad>(size),
    claimed[2] / static_cast<Quad>(size) };
  const QuadTriple cross = { a[1] * exact[2] - a[2] * exact[1], a[2] * exact[0] - a[0] * exact[2],
    a[0] * exact[1] - a[1] * exact[0] };
  const Quad sine = SquareRoot(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
  const Quad cosine = a[0] * exact[0] + a[1] * exact[1] + a[2] * exact[2];
  return std::atan2(static_cast<double>(sine), static_cast<double>(cosine));
}

}
