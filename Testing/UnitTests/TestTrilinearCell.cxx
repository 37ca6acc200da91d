// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The interpolant is compared with its definition in higher precision. What keeps rays from
// slipping between cells (the same bits on both sides of a face, signs that no rounding changes) is
// exact.

#include "ExactRoots.h"
#include "Image/Cells/Solvers/RobustSolver.h"
#include "Math/TrilinearCell.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

CellCorners RandomCorners(RandomNumbers& random, bool wide)
{
  CellCorners corners;
  for (double& corner : corners)
  {
    corner = wide ? random.WideMagnitude(-30.0, 30.0) : random.Uniform(-1.0, 1.0);
  }
  return corners;
}

/// Within the cell, and often on its faces.
Vector3 RandomPoint(RandomNumbers& random)
{
  Vector3 p;
  for (double& coordinate : p)
  {
    const int where = random.Integer(0, 5);
    coordinate = where < 2 ? static_cast<double>(where) : random.Uniform(0.0, 1.0);
  }
  return p;
}

double Largest(const CellCorners& corners)
{
  double largest = 0.0;
  for (const double corner : corners)
  {
    largest = std::max(largest, std::abs(corner));
  }
  return largest;
}

Quad Weight(std::size_t corner, std::size_t axis, Quad p)
{
  return corner >> axis & 1 ? p : 1 - p;
}

Quad Define(const CellCorners& v, const std::array<Quad, 3>& p)
{
  Quad sum = 0;
  for (std::size_t i = 0; i < 8; ++i)
  {
    sum += Weight(i, 0, p[0]) * Weight(i, 1, p[1]) * Weight(i, 2, p[2]) * v[i];
  }
  return sum;
}

//------------------------------------------------------------------------------
TEST(TrilinearCell, MatchesTheDefinition)
{
  RandomNumbers random(401);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i)
  {
    const CellCorners v = RandomCorners(random, i % 2 == 0);
    const Vector3 p = RandomPoint(random);
    const Quad error = Interpolate(v, p) - Define(v, { p[0], p[1], p[2] });
    worst = std::max(worst, std::abs(static_cast<double>(error)) / Largest(v));
  }
  std::cout << "[ tried    ] 200000 points; largest error " << worst << " of the largest corner\n";
  EXPECT_LT(worst, 4.5e-16);
}

//------------------------------------------------------------------------------
TEST(TrilinearCell, ReproducesCornerSamples)
{
  RandomNumbers random(402);
  for (int i = 0; i < 1000; ++i)
  {
    const CellCorners v = RandomCorners(random, true);
    for (std::size_t k = 0; k < 8; ++k)
    {
      const Vector3 corner = { k & 1 ? 1.0 : 0.0, k >> 1 & 1 ? 1.0 : 0.0, k >> 2 ? 1.0 : 0.0 };
      ASSERT_EQ(Interpolate(v, corner), v[k]);
    }
  }
}

//------------------------------------------------------------------------------
TEST(TrilinearCell, IsContinuousAcrossFacesToTheLastBit)
{
  RandomNumbers random(403);
  for (int i = 0; i < 100000; ++i)
  {
    CellCorners low = RandomCorners(random, i % 2 == 0);
    CellCorners high = RandomCorners(random, true);
    const std::size_t axis = random.Bits() % 3;
    const std::size_t bit = std::size_t{ 1 } << axis;
    for (std::size_t k = 0; k < 8; ++k)
    {
      if ((k & bit) == 0)
      {
        high[k] = low[k | bit];
      }
    }
    Vector3 p = RandomPoint(random);
    p[axis] = 1.0;
    const double below = Interpolate(low, p);
    p[axis] = 0.0;
    ASSERT_EQ(Interpolate(high, p), below);
  }
}

//------------------------------------------------------------------------------
TEST(TrilinearCell, CubicAlongASegmentMatchesTheInterpolant)
{
  RandomNumbers random(404);
  double worst = 0.0;
  for (int i = 0; i < 50000; ++i)
  {
    const CellCorners v = RandomCorners(random, false);
    const Vector3 p = RandomPoint(random);
    const Vector3 q = RandomPoint(random);
    const BernsteinCubic b = CubicAlongSegment(v, p, q);
    ASSERT_EQ(b[0], Interpolate(v, p));
    ASSERT_EQ(b[3], Interpolate(v, q));
    for (const double u : { 0.0, 0.1, 1.0 / 3.0, 0.5, 0.77, 1.0 })
    {
      std::array<Quad, 3> point;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        point[axis] = (1 - Quad(u)) * p[axis] + Quad(u) * q[axis];
      }
      const auto value = static_cast<double>(Define(v, point));
      worst = std::max(worst, std::abs(Robust::Evaluate(b, u) - value));
    }
  }
  std::cout << "[ tried    ] 50000 segments; largest error " << worst << "\n";
  EXPECT_LT(worst, 1e-15);
}

//------------------------------------------------------------------------------
TEST(TrilinearCell, GradientMatchesTheInterpolant)
{
  RandomNumbers random(405);
  double worst = 0.0;
  for (int i = 0; i < 50000; ++i)
  {
    const CellCorners v = RandomCorners(random, i % 2 == 0);
    const Vector3 p = RandomPoint(random);
    const Vector3 gradient = InterpolantGradient(v, p);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t s = (axis + 1) % 3;
      const std::size_t t = (axis + 2) % 3;
      Quad sum = 0;
      for (std::size_t k = 0; k < 8; ++k)
      {
        sum += (k >> axis & 1 ? 1 : -1) * Weight(k, s, p[s]) * Weight(k, t, p[t]) * v[k];
      }
      const double error = std::abs(static_cast<double>(gradient[axis] - sum));
      worst = std::max(worst, error / Largest(v));
    }
  }
  std::cout << "[ tried    ] 50000 gradients; largest error " << worst
            << " of the largest corner\n";
  EXPECT_LT(worst, 1e-15);
}

//------------------------------------------------------------------------------
TEST(TrilinearCell, LerpIsExactAtEndpointsAndKeepsSigns)
{
  RandomNumbers random(406);
  for (int i = 0; i < 1000000; ++i)
  {
    const double a = random.WideMagnitude(-290.0, 307.0);
    const double b = random.WideMagnitude(-290.0, 307.0);
    ASSERT_EQ(Lerp(a, b, 0.0), a);
    ASSERT_EQ(Lerp(a, b, 1.0), b);
    const double t = i % 3 == 0 ? 1.0 - random.Uniform(0.0, 1e-15) : random.Uniform(0.0, 1.0);
    ASSERT_EQ(IsInside(Lerp(std::abs(a), std::abs(b), t)), true) << a << " " << b << " " << t;
    ASSERT_EQ(IsInside(Lerp(-std::abs(a), -std::abs(b), t)), false) << a << " " << b << " " << t;
  }
}

//------------------------------------------------------------------------------
TEST(TrilinearCell, CubicKeepsTheCommonSignOfTheCorners)
{
  RandomNumbers random(407);
  for (int i = 0; i < 300000; ++i)
  {
    CellCorners v;
    const bool inside = i % 2 == 0;
    for (double& corner : v)
    {
      const double magnitude = std::abs(random.WideMagnitude(-250.0, 300.0));
      corner = inside ? (random.Integer(0, 3) ? magnitude : 0.0) : -magnitude;
    }
    for (const double b : CubicAlongSegment(v, RandomPoint(random), RandomPoint(random)))
    {
      ASSERT_EQ(IsInside(b), inside);
    }
  }
}

//------------------------------------------------------------------------------
// The smallest of numbers: half of one is rounded to zero, which must not turn outside to inside.
TEST(TrilinearCell, CubicKeepsTheCommonSignOfDenormalDifferences)
{
  CellCorners v;
  v.fill(-SmallestDifference);
  const double almostOne = std::nextafter(1.0, 0.0);
  for (const double coordinate : { 0.0, 1e-300, 0.5, almostOne, 1.0 })
  {
    for (const double b :
      CubicAlongSegment(v, { coordinate, coordinate, 0.0 }, { coordinate, coordinate, 1.0 }))
    {
      EXPECT_FALSE(IsInside(b)) << coordinate;
    }
  }
}

}
}
