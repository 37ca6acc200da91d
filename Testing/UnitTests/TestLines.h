// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TestLines_h
#define TestLines_h

#include "Hit.h"
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
  const Vector3 last = { dimensions[0] - 1.0, dimensions[1] - 1.0, dimensions[2] - 1.0 };
  const Vector3 through = random.PointInBox({ 0.0, 0.0, 0.0 }, last);
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

inline bool AreSame(const Hit& a, const Hit& b)
{
  return a.T == b.T && a.Cell == b.Cell && a.Surface == b.Surface && a.Parametric == b.Parametric &&
    a.Rising == b.Rising && a.Jump == b.Jump && a.Plane == b.Plane && a.Value == b.Value;
}

}

#endif
