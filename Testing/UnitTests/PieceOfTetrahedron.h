// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PieceOfTetrahedron_h
#define PieceOfTetrahedron_h

#include "Rays/RayPacket.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// Where the surface meets the edges of a tetrahedron.
struct PieceOfTetrahedron
{
  int Count = 0;
  long double Points[6][3];
  std::array<long double, 3> Lower;
  std::array<long double, 3> Upper;

  explicit PieceOfTetrahedron(const double (&corners)[4][4])
  {
    this->Lower.fill(std::numeric_limits<long double>::infinity());
    this->Upper.fill(-std::numeric_limits<long double>::infinity());
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        if ((corners[i][3] < 0.0) != (corners[j][3] < 0.0))
        {
          this->Add(corners[i], corners[j]);
        }
      }
    }
  }

  void Add(const double (&a)[4], const double (&b)[4])
  {
    const long double fraction = a[3] / (static_cast<long double>(a[3]) - b[3]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const long double point = a[axis] + fraction * (static_cast<long double>(b[axis]) - a[axis]);
      this->Points[this->Count][axis] = point;
      this->Lower[axis] = std::min(this->Lower[axis], point);
      this->Upper[axis] = std::max(this->Upper[axis], point);
    }
    ++this->Count;
  }

  /// Whether a part of a ray meets the convex hull of the points, which are in one plane: some of
  /// the triangles between them.
  bool IsMetBy(const RayPacket& packet) const
  {
    for (int i = 0; i < this->Count; ++i)
    {
      for (int j = i + 1; j < this->Count; ++j)
      {
        for (int k = j + 1; k < this->Count; ++k)
        {
          if (this->IsMetBy(packet, i, j, k))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  /// (T. Moeller, B. Trumbore: Fast, Minimum Storage Ray-Triangle Intersection, 1997.)
  bool IsMetBy(const RayPacket& packet, int i, int j, int k) const
  {
    long double e[3];
    long double f[3];
    long double s[3];
    long double d[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      e[axis] = this->Points[j][axis] - this->Points[i][axis];
      f[axis] = this->Points[k][axis] - this->Points[i][axis];
      s[axis] = packet.Origin[axis][0] - this->Points[i][axis];
      d[axis] = packet.Direction[axis][0];
    }
    const auto triple = [](const long double* a, const long double* b, const long double* c)
    {
      return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
        a[2] * (b[0] * c[1] - b[1] * c[0]);
    };
    const long double determinant = triple(d, f, e);
    const long double u = triple(d, f, s) / determinant;
    const long double v = triple(d, s, e) / determinant;
    const long double t = triple(f, s, e) / determinant;
    return u >= 0.0L && v >= 0.0L && u + v <= 1.0L && t >= packet.Begin[0] && t <= packet.End[0];
  }
};

}

#endif
