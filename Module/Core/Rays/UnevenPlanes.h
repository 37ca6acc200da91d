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
/// Rays go through the space that these places are in, in straight lines. A cell is a box there,
/// and its interpolant is trilinear in the coordinates of the box, so that all that is said of a
/// ray in a cell holds as it does where planes stand at whole numbers. The first plane of an axis
/// stands at 0 and the last, plane n, at n: the spacing is 1 in the mean, and the box of the volume
/// is the same as with even spacing.
///
/// Places never fall. Where two planes coincide, the cell between them is flat: a ray crosses it in
/// no time, from the one face to the other, and meets a surface there if it has one.
class UnevenPlanes
{
public:
  /// For each axis at least two places, which do not fall, from 0 to the number of the last plane.
  explicit UnevenPlanes(std::array<std::vector<double>, 3> places)
    : Places(std::move(places))
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int planes = static_cast<int>(this->Places[axis].size());
      for (int plane = 0; plane < planes; ++plane)
      {
        const double below = plane > 0 ? this->GetWidth(axis, plane - 1) : 0.0;
        const double above = plane < planes - 1 ? this->GetWidth(axis, plane) : 0.0;
        this->Slopes[axis].push_back(ParabolaWeights(below, above));
      }
    }
  }

  /// Where a plane stands. Beyond the last plane it is the last one: macrocells may reach further.
  double Get(std::size_t axis, int plane) const
  {
    const std::vector<double>& places = this->Places[axis];
    return places[std::min(static_cast<std::size_t>(plane), places.size() - 1)];
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

  /// What the rises of a field from the plane below and to the plane above are multiplied by, to
  /// make its slope at a plane: that of the parabola through the three.
  struct SlopeWeights
  {
    double Below;
    double Above;
  };

  const SlopeWeights& GetSlopeWeights(std::size_t axis, int plane) const
  {
    return this->Slopes[axis][static_cast<std::size_t>(plane)];
  }

  /// The cell that a place is in; in a plane, that above. Beside the volume, the nearest.
  int FindCell(std::size_t axis, double place) const
  {
    const std::vector<double>& places = this->Places[axis];
    return static_cast<int>(
      std::upper_bound(places.begin() + 1, places.end() - 1, place) - places.begin() - 1);
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
  /// widths, times the second derivative; one would see it.) At the border of the volume and beside
  /// a flat cell, the slope to the other side.
  static SlopeWeights ParabolaWeights(double below, double above)
  {
    if (below > 0.0 && above > 0.0)
    {
      return { above / (below + above) / below, below / (below + above) / above };
    }
    return { below > 0.0 ? 1.0 / below : 0.0, above > 0.0 ? 1.0 / above : 0.0 };
  }

  std::array<std::vector<double>, 3> Places;
  std::array<std::vector<SlopeWeights>, 3> Slopes;
};

}

#endif
