// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Unbricked_h
#define Unbricked_h

#include "Image/Samples/VolumeView.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace vtkIsosurfaceRayTracing
{

/// Reads the corners of a cell from the array of the user.
template <typename T>
void LoadCorners(const Samples<T>& samples, const Index3& cell, Stored<T> corners[8])
{
  const T* first = samples.At(cell);
  for (int corner = 0; corner < 8; ++corner)
  {
    corners[corner] = static_cast<Stored<T>>(first[(corner & 1) * samples.GetStride(0) +
      (corner >> 1 & 1) * samples.GetStride(1) + (corner >> 2) * samples.GetStride(2)]);
  }
}

/// A cell with a corner that is NaN or infinite is empty.
template <typename Value>
bool IsFinite(const Value corners[8])
{
  if constexpr (std::is_floating_point_v<Value>)
  {
    return std::all_of(corners, corners + 8, [](Value v) { return std::isfinite(v); });
  }
  return true;
}

/// The layout without bricks: rays read the array of the user as it is.
///
/// Every layout has a Reader, made for one ray at a time, that loads the corners of cells, and
/// makes missing bricks as it goes. Readers of all threads work at once. Where the corners of a
/// whole block of cells are kept in rows, values of type Kept with GetStrides between neighbours,
/// FindBlock returns the first of them; else null.
template <typename T>
class Unbricked
{
public:
  using Value = Stored<T>;
  using Kept = T;

  explicit Unbricked(const Samples<T>& samples)
    : TheSamples(samples)
  {
  }

  void BeginFrame(std::size_t) {}

  class Reader
  {
  public:
    explicit Reader(Unbricked& layout)
      : Layout(layout)
    {
    }

    void Prefetch(const Index3&) {}

    void Load(const Index3& cell, Value corners[8])
    {
      LoadCorners(this->Layout.TheSamples, cell, corners);
    }

    const Kept* FindBlock(const Index3& first, int) const
    {
      return this->Layout.TheSamples.At(first);
    }

    const std::ptrdiff_t* GetStrides() const { return this->Layout.TheSamples.GetStrides(); }

  private:
    Unbricked& Layout;
  };

  std::size_t GetNumberOfBricks() const { return 0; }
  std::size_t GetMaximumNumberOfBricks() const { return 0; }
  std::size_t GetMemory() const { return 0; }

private:
  Samples<T> TheSamples;
};

}

#endif
