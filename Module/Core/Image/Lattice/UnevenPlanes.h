// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef UnevenPlanes_h
#define UnevenPlanes_h

#include "Math/Vector.h"

#include <algorithm>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Where the lattice planes of a volume stand whose samples are not evenly spaced.
///
/// Rays are straight lines in the space of these coordinates. A cell is a box there, and its
/// interpolant is trilinear in the coordinates of the box, so that all that is said of a ray in a
/// cell holds as it does where planes stand at whole numbers. The first plane of an axis stands at
/// 0 and the last, plane n, at n: the mean spacing is 1, and the box of the volume is the same as
/// with even spacing.
///
/// Coordinates never decrease. Where two planes coincide, the cell between them is flat: a ray
/// crosses it at one t, from one face to the other, and meets a surface there if it has one.
class UnevenPlanes
{
public:
  /// At least two coordinates for each axis, non-decreasing from 0 to the number of the last plane.
  explicit UnevenPlanes(std::array<std::vector<double>, 3> coordinates)
    : Coordinates(std::move(coordinates))
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int planes = static_cast<int>(this->Coordinates[axis].size());
      for (int plane = 0; plane < planes; ++plane)
      {
        const double below = plane > 0 ? this->GetWidth(axis, plane - 1) : 0.0;
        const double above = plane < planes - 1 ? this->GetWidth(axis, plane) : 0.0;
        this->Slopes[axis].push_back(ParabolaWeights(below, above));
      }
    }
  }

  /// The coordinate of a plane. Beyond the last plane it is that of the last: macrocells may extend
  /// further.
  double Get(std::size_t axis, int plane) const
  {
    const std::vector<double>& coordinates = this->Coordinates[axis];
    return coordinates[std::min(static_cast<std::size_t>(plane), coordinates.size() - 1)];
  }

  double GetWidth(std::size_t axis, int cell) const
  {
    return this->Get(axis, cell + 1) - this->Get(axis, cell);
  }

  bool IsFlat(const Index3& cell) const
  {
    return !(this->GetWidth(0, cell[0]) > 0.0 && this->GetWidth(1, cell[1]) > 0.0 &&
      this->GetWidth(2, cell[2]) > 0.0);
  }

  /// The weights of the differences of a field to the plane below and to the plane above in its
  /// slope at a plane: that of the parabola through the three values.
  struct SlopeWeights
  {
    double Below;
    double Above;
  };

  const SlopeWeights& GetSlopeWeights(std::size_t axis, int plane) const
  {
    return this->Slopes[axis][static_cast<std::size_t>(plane)];
  }

  /// The cell that contains a coordinate; in a plane, the cell above it. Outside the volume, the
  /// nearest cell.
  int FindCell(std::size_t axis, double coordinate) const
  {
    const std::vector<double>& coordinates = this->Coordinates[axis];
    return static_cast<int>(
      std::upper_bound(coordinates.begin() + 1, coordinates.end() - 1, coordinate) -
      coordinates.begin() - 1);
  }

  /// A point given in the coordinates of a cell.
  Vector3 GetPoint(const Index3& cell, const Vector3& parametric) const
  {
    Vector3 point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] =
        this->Get(axis, cell[axis]) + parametric[axis] * this->GetWidth(axis, cell[axis]);
    }
    return point;
  }

private:
  /// The slope is the mean of those to both sides, of which the nearer counts more. (The rise
  /// between the neighbours over their distance would be off by half the difference of the two
  /// widths, times the second derivative, which is visible.) At the border of the volume and beside
  /// a flat cell, it is the slope to the other side.
  static SlopeWeights ParabolaWeights(double below, double above)
  {
    if (below > 0.0 && above > 0.0)
    {
      return { above / (below + above) / below, below / (below + above) / above };
    }
    return { below > 0.0 ? 1.0 / below : 0.0, above > 0.0 ? 1.0 / above : 0.0 };
  }

  std::array<std::vector<double>, 3> Coordinates;
  std::array<std::vector<SlopeWeights>, 3> Slopes;
};

}

#endif
