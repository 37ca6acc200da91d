// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Noise_h
#define Noise_h

#include "RandomNumbers.h"
#include "TestVolume.h"

#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Integers from 0 to 120, which every type of samples holds.
template <typename T>
TestVolume<T> Noise(const Index3& size, std::uint64_t seed)
{
  RandomNumbers random(seed);
  TestVolume<T> volume(size, std::vector<T>(Count(size)));
  for (T& value : volume.Values)
  {
    value = static_cast<T>(random.Integer(0, 120));
  }
  return volume;
}

/// Integers from low to high; at the border of the volume the border's value, so that a surface
/// above it is closed.
template <typename T>
TestVolume<T> ClosedNoise(const Index3& size, std::uint64_t seed, int low, int high, int border)
{
  RandomNumbers random(seed);
  TestVolume<T> volume(size, std::vector<T>(Count(size), static_cast<T>(border)));
  ForEachPlace({ size[0] - 2, size[1] - 2, size[2] - 2 },
    [&](const Index3& i) {
      volume.At({ i[0] + 1, i[1] + 1, i[2] + 1 }) = static_cast<T>(random.Integer(low, high));
    });
  return volume;
}

}

#endif
