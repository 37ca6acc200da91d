// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RandomPlanes_h
#define RandomPlanes_h

#include "Image/Lattice/UnevenPlanes.h"
#include "RandomNumbers.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// How uneven random planes are.
struct Unevenness
{
  /// The longest step is up to two to this power as long as the shortest.
  double Octaves = 10.0;
  /// About one cell in four is flat, but not the one in the middle.
  bool WithFlatCells = false;
};

/// Coordinates from 0 to n - 1.
inline std::vector<double> RandomPlaces(
  RandomNumbers& random, int count, const Unevenness& unevenness)
{
  std::vector<double> coordinates = { 0.0 };
  for (int i = 1; i < count; ++i)
  {
    const bool isFlat = unevenness.WithFlatCells && i != count / 2 && random.Integer(0, 3) == 0;
    coordinates.push_back(
      coordinates.back() + (isFlat ? 0.0 : std::exp2(-random.Uniform(0.0, unevenness.Octaves))));
  }
  const double last = coordinates.back();
  const double scale = (count - 1) / last;
  for (double& coordinate : coordinates)
  {
    coordinate = coordinate == last ? count - 1 : coordinate * scale;
  }
  return coordinates;
}

inline UnevenPlanes RandomPlanes(
  RandomNumbers& random, const Index3& size, const Unevenness& unevenness)
{
  return UnevenPlanes({ RandomPlaces(random, size[0], unevenness),
    RandomPlaces(random, size[1], unevenness), RandomPlaces(random, size[2], unevenness) });
}

/// Planes at whole numbers, of which all but the outermost are shifted by up to 0.45.
inline UnevenPlanes ShiftedPlanes(RandomNumbers& random, const Index3& size)
{
  std::array<std::vector<double>, 3> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int last = size[axis] - 1;
    for (int i = 0; i <= last; ++i)
    {
      coordinates[axis].push_back(i + (i > 0 && i < last ? random.Uniform(-0.45, 0.45) : 0.0));
    }
  }
  return UnevenPlanes(coordinates);
}

}

#endif
