// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The kernels of tricubic cells: compared with the interpolant by its definition, in higher
// precision, and with each other bit for bit. The masks of blocks, with their cells one by one.

#include "AllKernels.h"
#include "Image/Cells/TricubicCell.h"
#include "Image/Cells/TricubicField.h"
#include "Kernels/Kernels.h"
#include "Math/NonicRoots.h"
#include "RandomNumbers.h"
#include "RandomPlanes.h"
#include "SameBits.h"
#include "TestVolume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr CubicEdge Even = { 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0 };
constexpr CubicEdge First = { 0.0, 1.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0 };
constexpr CubicEdge Uneven = { 0.4, 0.1, 0.05, 0.7 };

/// Numbers of many sizes, or of few values, which are often equal.
TricubicCell RandomSamples(RandomNumbers& random)
{
  TricubicCell samples;
  const int kind = random.Integer(0, 2);
  for (double& sample : samples)
  {
    sample = kind == 0 ? random.Uniform(-1.0, 1.0)
      : kind == 1      ? random.Integer(-1, 1)
                       : std::ldexp(random.Uniform(-1.0, 1.0), random.Integer(-40, 40));
  }
  return samples;
}

/// Often an end of the cell, as for segments from face to face.
Vector3 RandomPoint(RandomNumbers& random)
{
  Vector3 point;
  for (double& coordinate : point)
  {
    const int kind = random.Integer(0, 3);
    coordinate = kind < 2 ? kind : random.Uniform(0.0, 1.0);
  }
  return point;
}

double LargestOf(const TricubicCell& numbers)
{
  double largest = 0.0;
  for (const double number : numbers)
  {
    largest = std::max(largest, std::abs(number));
  }
  return largest;
}

//------------------------------------------------------------------------------
/// Bernstein's polynomial of a degree, or its slope.
long double Bernstein(int degree, int i, long double t)
{
  if (i < 0 || i > degree)
  {
    return 0.0L;
  }
  return std::pow(t, i) * std::pow(1.0L - t, degree - i) * std::tgamma(degree + 1.0L) /
    std::tgamma(i + 1.0L) / std::tgamma(degree - i + 1.0L);
}

long double Slope(int i, long double t)
{
  return 3.0L * (Bernstein(2, i - 1, t) - Bernstein(2, i, t));
}

/// The interpolant of coefficients; along one axis its slope.
long double Evaluate(const TricubicCell& cell, const std::array<long double, 3>& p, int slopeAxis)
{
  long double sum = 0.0L;
  for (int i = 0; i < 64; ++i)
  {
    const int places[3] = { i % 4, i / 4 % 4, i / 16 };
    long double product = cell[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < 3; ++axis)
    {
      const long double t = p[static_cast<std::size_t>(axis)];
      product *= axis == slopeAxis ? Slope(places[axis], t) : Bernstein(3, places[axis], t);
    }
    sum += product;
  }
  return sum;
}

//------------------------------------------------------------------------------
class TricubicKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, TricubicKernels, AllKernels(), NameOfKernels);

TEST_P(TricubicKernels, CoefficientsMeetSamplesWithTheSlopes)
{
  RandomNumbers random(1);
  for (int i = 0; i < 1000; ++i)
  {
    const TricubicCell samples = RandomSamples(random);
    const CubicEdge edges[3] = { Even, First, Uneven };
    const double* const weights[3] = { edges[0].data(), edges[1].data(), edges[2].data() };
    const double isovalue = random.Uniform(-0.5, 0.5);
    TricubicCell cell = samples;
    const bool areBoth =
      this->TheKernels.InterpolateSamples(weights, { isovalue, 1.0 }, cell.data());
    const double tolerance = 1e-14 * (LargestOf(samples) + 1.0);
    bool haveBoth[2] = { false, false };
    for (std::size_t place = 0; place < 64; ++place)
    {
      haveBoth[IsInside(cell[place]) ? 1 : 0] = true;
      // The weights of the four samples along each axis in the coefficient.
      long double expected = -isovalue;
      long double rows[3][4];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const CubicEdge& edge = edges[axis];
        const std::size_t at = place >> (2 * axis) & 3;
        const long double lower[4] = { -edge[0], 1.0L + edge[0] - edge[1], edge[1], 0.0L };
        const long double upper[4] = { 0.0L, edge[2], 1.0L + edge[3] - edge[2], -edge[3] };
        for (std::size_t k = 0; k < 4; ++k)
        {
          const long double end = k == (at == 0 ? 1U : 2U) ? 1.0L : 0.0L;
          rows[axis][k] = at == 1 ? lower[k] : (at == 2 ? upper[k] : end);
        }
      }
      for (std::size_t k = 0; k < 64; ++k)
      {
        expected += rows[0][k & 3] * rows[1][k >> 2 & 3] * rows[2][k >> 4] * samples[k];
      }
      ASSERT_NEAR(cell[place], static_cast<double>(expected), tolerance);
    }
    ASSERT_EQ(areBoth, haveBoth[0] && haveBoth[1]);
  }
}

TEST_P(TricubicKernels, PolynomialsAreTheInterpolantAlongLines)
{
  RandomNumbers random(2);
  int found = 0;
  for (int i = 0; i < 300; ++i)
  {
    const TricubicCell cell = RandomSamples(random);
    const Vector3 p = RandomPoint(random);
    const Vector3 q = RandomPoint(random);
    BernsteinNonic nonic;
    const bool isFound =
      this->TheKernels.RestrictCell(cell.data(), p.data(), q.data(), nonic.data());
    const double tolerance = 1e-13 * LargestOf(cell);
    bool haveBoth[2] = { false, false };
    for (int step = 0; step <= 10; ++step)
    {
      const long double u = step / 10.0L;
      std::array<long double, 3> point;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        point[axis] = p[axis] + u * (static_cast<long double>(q[axis]) - p[axis]);
      }
      const long double expected = Evaluate(cell, point, -1);
      haveBoth[expected > tolerance ? 1 : 0] |= std::abs(expected) > tolerance;
      long double value = 0.0L;
      for (int k = 0; isFound && k < 10; ++k)
      {
        value += Bernstein(9, k, u) * nonic[static_cast<std::size_t>(k)];
      }
      ASSERT_TRUE(!isFound || std::abs(value - expected) <= tolerance);
    }
    ASSERT_TRUE(isFound || !haveBoth[0] || !haveBoth[1]);
    if (isFound)
    {
      ++found;
      ASSERT_EQ(nonic.front(), GetTricubicValue(cell, p));
      ASSERT_EQ(nonic.back(), GetTricubicValue(cell, q));
    }
  }
  EXPECT_GT(found, 50);
  EXPECT_LT(found, 290);
}

TEST_P(TricubicKernels, GradientsAreThoseOfTheInterpolant)
{
  RandomNumbers random(3);
  for (int i = 0; i < 1000; ++i)
  {
    const TricubicCell cell = RandomSamples(random);
    const Vector3 p = RandomPoint(random);
    Vector3 gradient;
    this->TheKernels.FindCellGradient(cell.data(), p.data(), gradient.data());
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto expected = static_cast<double>(Evaluate(cell, { p[0], p[1], p[2] }, axis));
      ASSERT_NEAR(gradient[static_cast<std::size_t>(axis)], expected, 1e-13 * LargestOf(cell));
    }
  }
}

TEST_P(TricubicKernels, HaveTheSameBits)
{
  const Kernels& baseline = *GetKernels().front();
  RandomNumbers random(4);
  for (int i = 0; i < 3000; ++i)
  {
    TricubicCell cells[2];
    cells[0] = cells[1] = RandomSamples(random);
    const double* const weights[3] = { Uneven.data(), Even.data(), First.data() };
    const ScaledIsovalue isovalue = { random.Uniform(-0.5, 0.5), 1.0 };
    const Vector3 p = RandomPoint(random);
    const Vector3 q = RandomPoint(random);
    BernsteinNonic nonics[2] = {};
    Vector3 gradients[2];
    bool answers[2][2];
    for (std::size_t k = 0; k < 2; ++k)
    {
      const Kernels& kernels = k == 0 ? baseline : this->TheKernels;
      answers[k][0] = kernels.InterpolateSamples(weights, isovalue, cells[k].data());
      answers[k][1] = kernels.RestrictCell(cells[k].data(), p.data(), q.data(), nonics[k].data());
      kernels.FindCellGradient(cells[k].data(), p.data(), gradients[k].data());
    }
    ASSERT_EQ(answers[0][0], answers[1][0]);
    ASSERT_EQ(answers[0][1], answers[1][1]);
    for (std::size_t k = 0; k < 64; ++k)
    {
      ASSERT_TRUE(AreSameBits(cells[0][k], cells[1][k]));
    }
    for (std::size_t k = 0; k < 10; ++k)
    {
      ASSERT_TRUE(AreSameBits(nonics[0][k], nonics[1][k]));
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      ASSERT_TRUE(AreSameBits(gradients[0][k], gradients[1][k]));
    }
  }
}

//------------------------------------------------------------------------------
/// Samples that may lie on both sides of isovalues around zero, and which a power of two scales:
/// those of some types may be of any size, and not finite.
template <typename T>
std::vector<T> RandomVolume(RandomNumbers& random, const Index3& size, double& scale)
{
  std::vector<T> samples(static_cast<std::size_t>(size[0]) * size[1] * size[2]);
  const bool isInteger = std::is_integral_v<T>;
  const int kind = random.Integer(0, 2);
  const int exponents[] = { -1070, -1000, -30, 0, 30, 1015 };
  const int exponent = std::is_same_v<T, double> ? exponents[random.Integer(0, 5)] : 0;
  const bool hasOthers = !isInteger && random.Integer(0, 3) == 0;
  for (T& sample : samples)
  {
    const double number = kind == 0 ? random.Integer(-1, 1)
      : kind == 1                   ? random.Uniform(-100.0, 100.0)
                                    : 90.0 + random.Uniform(-1.0, 1.0);
    sample = static_cast<T>(isInteger ? std::abs(number) : std::ldexp(number, exponent));
    if (hasOthers && random.Integer(0, 99) == 0)
    {
      using Limits = std::numeric_limits<T>;
      sample = random.Integer(0, 1) == 0 ? Limits::quiet_NaN() : Limits::infinity();
    }
  }
  scale = std::ldexp(1.0, -exponent);
  return samples;
}

/// Counts the cells of all masks, each of which is asked itself.
template <typename T>
void CompareMasks(const Kernels& kernels, RandomNumbers& random, int& cellsInMasks)
{
  const Index3 size = { random.Integer(2, 20), random.Integer(2, 12), random.Integer(2, 12) };
  double scale = 1.0;
  const auto volume = TestVolume<T>(size, RandomVolume<T>(random, size, scale));
  TricubicField<T> field{ Samples<T>(volume.View()) };
  std::optional<UnevenPlanes> planes;
  if (random.Integer(0, 1) == 0)
  {
    planes = RandomPlanes(random, size, { 10.0, true });
  }
  field.SetPlanes(planes ? &*planes : nullptr);
  std::vector<ScaledIsovalue> isovalues;
  for (int i = random.Integer(1, 2); i > 0; --i)
  {
    // Equal to many samples, or to none.
    const double values[] = { 0.0, 1.0, 90.0, random.Uniform(-100.0, 100.0) };
    isovalues.push_back({ values[random.Integer(0, 3)] / scale, scale });
  }
  for (const Index3& block : { Index3{ 0, 0, 0 }, Index3{ 1, 0, 0 }, Index3{ 2, 1, 1 } })
  {
    const Index3 first = BlockMask::GetFirstCell(block);
    if (first[0] >= size[0] - 1 || first[1] >= size[1] - 1 || first[2] >= size[2] - 1)
    {
      continue;
    }
    BlockMask mask;
    field.MakeMask(kernels, block, isovalues, mask);
    ForEachPlace({ 8, 8, 8 },
      [&](const Index3& place)
      {
        const Index3 cell = { first[0] + place[0], first[1] + place[1], first[2] + place[2] };
        const bool isInVolume =
          cell[0] < size[0] - 1 && cell[1] < size[1] - 1 && cell[2] < size[2] - 1;
        TricubicCell coefficients;
        const bool mayPass = isInVolume &&
          std::any_of(isovalues.begin(), isovalues.end(),
            [&](const ScaledIsovalue& isovalue)
            { return field.Load(kernels, cell, isovalue, coefficients); });
        ASSERT_EQ(mask.Has(place), mayPass);
        cellsInMasks += mayPass ? 1 : 0;
      });
  }
}

TEST_P(TricubicKernels, MasksHaveTheCellsThatSurfacesMayPass)
{
  RandomNumbers random(5);
  int cells = 0;
  for (int i = 0; i < 300 && !HasFatalFailure(); ++i)
  {
    CompareMasks<double>(this->TheKernels, random, cells);
    CompareMasks<float>(this->TheKernels, random, cells);
    CompareMasks<std::uint8_t>(this->TheKernels, random, cells);
  }
  EXPECT_GT(cells, 50000);
}

}
}
