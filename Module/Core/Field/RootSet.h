// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RootSet_h
#define RootSet_h

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A root along the segment of a ray in a cell.
struct Root
{
  /// As a fraction of the segment.
  double Fraction;
  int Surface;
  bool Entering;
};

/// The roots in a cell of several surfaces, in order along the ray.
class RootSet
{
public:
  /// Starts with the roots of the next surface. Surfaces come in the order of their isovalues.
  void NextSurface() { this->FirstAllowed = 0; }

  /// Adds a root behind those of the same surface. Where surfaces are met at one point, a ray that
  /// enters them meets the smaller isovalue first, and a ray that leaves them the larger one.
  void Add(const Root& root)
  {
    const auto first = this->Roots.begin() + this->FirstAllowed;
    const auto position = root.Entering
      ? std::upper_bound(first, this->Roots.end(), root.Fraction,
          [](double fraction, const Root& other) { return fraction < other.Fraction; })
      : std::lower_bound(first, this->Roots.end(), root.Fraction,
          [](const Root& other, double fraction) { return other.Fraction < fraction; });
    this->FirstAllowed = position - this->Roots.begin() + 1;
    this->Roots.insert(position, root);
  }

  void Clear() { this->Roots.clear(); }
  const std::vector<Root>& Get() const { return this->Roots; }

private:
  std::vector<Root> Roots;
  std::ptrdiff_t FirstAllowed = 0;
};

}

#endif
