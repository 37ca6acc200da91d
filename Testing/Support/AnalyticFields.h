// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AnalyticFields_h
#define AnalyticFields_h

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

/// Fields as functions of a point in index space, larger inside than outside; the isosurfaces at 0
/// of all but the last are known. Tests with and without VTK sample them.
namespace AnalyticFields
{

using Point = std::array<double, 3>;

/// The distance to a sphere.
struct Sphere
{
  Point Center;
  double Radius;

  double operator()(const Point& p) const
  {
    return this->Radius -
      std::hypot(p[0] - this->Center[0], p[1] - this->Center[1], p[2] - this->Center[2]);
  }
};

/// A half space, whose inside is where the normal points. Trilinear interpolation reproduces it.
struct Plane
{
  Point Normal;
  double Offset;

  double operator()(const Point& p) const
  {
    return this->Normal[0] * p[0] + this->Normal[1] * p[1] + this->Normal[2] * p[2] - this->Offset;
  }
};

/// A box with its faces parallel to those of the cells: the largest distance to one of its planes.
struct Box
{
  Point Center;
  double HalfEdge;

  double operator()(const Point& p) const
  {
    return this->HalfEdge -
      std::max({ std::abs(p[0] - this->Center[0]), std::abs(p[1] - this->Center[1]),
        std::abs(p[2] - this->Center[2]) });
  }
};

/// A. Schoen's gyroid: a periodic surface of many saddles and tunnels.
struct Gyroid
{
  /// In cells.
  double Period;

  double operator()(const Point& p) const
  {
    const double scale = 6.28318530717958647692 / this->Period;
    const double x = p[0] * scale;
    const double y = p[1] * scale;
    const double z = p[2] * scale;
    return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
  }
};

/// A bowl that ripples in all directions, above 0 in about half of the cube from -1 to 1.
inline double Ripples(const Point& p)
{
  return std::sin(5.0 * p[0] + 1.0) * std::cos(4.0 * p[1]) + std::sin(4.5 * p[2]) +
    0.2 * p[0] * p[1];
}

/// S. Marschner and R. Lobb's signal, on the cube from -1 to 1 and with values from 0 to 1: ripples
/// as fine as 40^3 samples can just hold. An Evaluation of Reconstruction Filters for Volume
/// Rendering, IEEE Visualization 1994.
struct MarschnerLobb
{
  double operator()(const Point& p) const
  {
    constexpr double pi = 3.14159265358979323846;
    const double wave = std::cos(2.0 * pi * 6.0 * std::cos(0.5 * pi * std::hypot(p[0], p[1])));
    return (1.0 - std::sin(0.5 * pi * p[2]) + 0.25 * (1.0 + wave)) / (2.0 * 1.25);
  }
};

/// The value as a sample: for integer types the nearest, and within what the type can hold.
template <typename T>
T ToSample(double value)
{
  if constexpr (std::is_integral_v<T>)
  {
    const auto low = static_cast<double>(std::numeric_limits<T>::lowest());
    const auto high = static_cast<double>(std::numeric_limits<T>::max());
    value = std::round(value);
    return value <= low ? std::numeric_limits<T>::lowest()
      : value >= high   ? std::numeric_limits<T>::max()
                        : static_cast<T>(value);
  }
  else
  {
    return static_cast<T>(value);
  }
}

/// The samples of a field on a lattice, with x fastest.
template <typename T, typename Field>
std::vector<T> Sample(const std::array<int, 3>& dimensions, const Field& field)
{
  std::vector<T> samples;
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < dimensions[1]; ++y)
    {
      for (int x = 0; x < dimensions[0]; ++x)
      {
        samples.push_back(ToSample<T>(
          field({ static_cast<double>(x), static_cast<double>(y), static_cast<double>(z) })));
      }
    }
  }
  return samples;
}

}

#endif
