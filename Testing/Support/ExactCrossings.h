// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ExactCrossings_h
#define ExactCrossings_h

#include "Quad.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

/// The test oracle: where a line crosses an isosurface of the trilinear interpolant. It tests every
/// cell of the volume, in 113 bits, and shares no code with the ray tracer: no hierarchy, no
/// traversal, no solver; it does not include a header of the core.
namespace Oracle
{

using vtkIsosurfaceRayTracing::Quad;
using Triple = std::array<double, 3>;
using Index = std::array<int, 3>;
using QuadTriple = std::array<Quad, 3>;

/// Samples at whole numbers, x fastest.
struct Field
{
  Index Dimensions;
  std::vector<double> Values;

  const double& At(int x, int y, int z) const
  {
    return this->Values[static_cast<std::size_t>(x) +
      static_cast<std::size_t>(this->Dimensions[0]) *
        (static_cast<std::size_t>(y) +
          static_cast<std::size_t>(this->Dimensions[1]) * static_cast<std::size_t>(z))];
  }
  double& At(int x, int y, int z)
  {
    return const_cast<double&>(static_cast<const Field&>(*this).At(x, y, z));
  }
};

/// The points origin + t direction, begin <= t <= end, of the very doubles that are given.
struct Line
{
  Triple Origin;
  Triple Direction;
  double Begin = 0.0;
  double End = std::numeric_limits<double>::infinity();
};

inline Quad Absolute(Quad x)
{
  return x < 0 ? -x : x;
}

double Length(const Triple& v);

/// A part of the line in one cell where the interpolant is monotone.
struct Piece
{
  Index Cell;
  Quad Begin;
  Quad End;
  /// Value minus isovalue, in units of the largest such difference at the corners of the cell.
  Quad AtBegin;
  Quad AtEnd;
  /// Whether this piece continues the one before. Cells with a corner that is not finite are empty;
  /// there the pieces are interrupted.
  bool Continues;
};

/// All pieces of the line in cells with corners on both sides of the isovalue, in order. Where the
/// line is parallel to the lattice planes and lies in one, it belongs to the cells above it.
std::vector<Piece> FindPieces(const Field& field, double isovalue, const Line& line);

/// The t at which the interpolant crosses the isovalue in a piece at whose ends the signs differ.
Quad FindCrossing(const Field& field, double isovalue, const Line& line, const Piece& piece);

/// Value minus isovalue at t, by the cubic of the given cell, in the units of Piece.
Quad ValueAt(
  const Field& field, double isovalue, const Line& line, const Index& cell, const Quad& t);

/// The derivative of that along the line, per cell of length.
Quad SlopeAt(
  const Field& field, double isovalue, const Line& line, const Index& cell, const Quad& t);

/// The gradient of the interpolant of a cell, at t, in the units of Piece.
QuadTriple GradientAt(
  const Field& field, double isovalue, const Line& line, const Index& cell, const Quad& t);

/// Whether the line at t is as near as this, in cells, to a face beyond which the field has no
/// cell, or an empty one.
bool IsAtBorder(
  const Field& field, const Line& line, const Index& cell, const Quad& t, double distance);

/// The angle between a vector and an exact one.
double AngleBetween(const Triple& claimed, const QuadTriple& exact);

}

#endif
