// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TestLines_h
#define TestLines_h

#include "Math/Arithmetic.h"
#include "RandomNumbers.h"

#include <cstddef>
#include <sstream>
#include <string>

namespace vtkIsosurfaceRayTracing
{

struct Line
{
  Vector3 Origin;
  Vector3 Direction;
};

inline std::string ToText(const Line& line)
{
  std::ostringstream text;
  text << std::hexfloat;
  for (std::size_t i = 0; i < 3; ++i)
  {
    text << line.Origin[i] << " + t * " << line.Direction[i] << "; ";
  }
  return text.str();
}

/// A line through a point of the volume, from without or from within.
inline Line RandomLine(RandomNumbers& random, const Index3& dimensions)
{
  const Vector3 through = random.PointInVolume(dimensions);
  const Vector3 direction = random.Direction();
  return { through - direction * (random.Integer(0, 3) * 20.0), direction };
}

/// A line along lattice planes, edges or diagonals, from a lattice point.
inline Line LatticeLine(RandomNumbers& random, const Index3& dimensions)
{
  Line line = {};
  while (Dot(line.Direction, line.Direction) == 0.0)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      line.Origin[axis] = random.Integer(-2, dimensions[axis] + 1);
      line.Direction[axis] = random.Integer(-2, 2);
    }
  }
  return line;
}

enum class LineKind
{
  Any,
  AlongAxis,
  BesidePlane,
  InFace,
  ThroughVertices,
  Diagonal,
  FromAfar
};
inline constexpr LineKind AllLineKinds[] = { LineKind::Any, LineKind::AlongAxis,
  LineKind::BesidePlane, LineKind::InFace, LineKind::ThroughVertices, LineKind::Diagonal,
  LineKind::FromAfar };

/// A line that goes up or down an axis, and not steeply away from it.
inline Line LineAlong(
  RandomNumbers& random, LineKind kind, std::size_t axis, double sign, const Index3& n)
{
  Line line;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const bool isWhole = kind == LineKind::BesidePlane || kind == LineKind::ThroughVertices ||
      kind == LineKind::Diagonal || (kind == LineKind::InFace && i != axis);
    line.Origin[i] = isWhole ? random.Integer(0, n[i] - 1) : random.Uniform(0.0, n[i] - 1.0);
    line.Direction[i] = random.Uniform(-1.9, 1.9);
  }
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  line.Direction[axis] = 1.0;
  const double tiny[] = { 1e-3, -1e-3, 1e-9, -1e-9, 1e-15, 0.0 };
  switch (kind)
  {
    case LineKind::AlongAxis:
      line.Direction[u] = line.Direction[v] = 0.0;
      break;
    case LineKind::BesidePlane:
      line.Direction[u] = line.Direction[v] = 0.0;
      line.Direction[random.Integer(0, 1) ? u : v] = tiny[random.Integer(0, 5)];
      line.Origin[u] += tiny[random.Integer(0, 5)];
      line.Origin[v] += tiny[random.Integer(0, 5)];
      break;
    case LineKind::InFace:
      line.Direction[random.Integer(0, 1) ? u : v] = 0.0;
      break;
    case LineKind::ThroughVertices:
      line.Direction[u] = 0.5 * random.Integer(-3, 3);
      line.Direction[v] = 0.25 * random.Integer(-7, 7);
      break;
    case LineKind::Diagonal:
      line.Direction[u] = random.Integer(0, 1) ? 1.0 : -1.0;
      line.Direction[v] = random.Integer(0, 1) ? 1.0 : -1.0;
      break;
    default:
      break;
  }
  line.Direction = line.Direction * (sign * random.Uniform(0.5, 2.0));
  line.Origin = line.Origin - line.Direction * (kind == LineKind::FromAfar ? 1e6 : 5.0);
  return line;
}

}

#endif
