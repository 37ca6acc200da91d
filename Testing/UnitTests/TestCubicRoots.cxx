// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The roots of cubics are compared with those they were made from, and with those that halving the
// interval finds in higher precision.

#include "ExactRoots.h"
#include "Image/Cells/Solvers/RobustSolver.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

struct Root
{
  double U;
  bool Entering;

  bool operator==(const Root& other) const
  {
    return this->U == other.U && this->Entering == other.Entering;
  }
};

std::vector<Root> FindRoots(const BernsteinCubic& b)
{
  std::vector<Root> roots;
  Robust::ForEachRoot(b,
    [&roots](double u, bool entering)
    {
      roots.push_back({ u, entering });
      return false;
    });
  return roots;
}

std::vector<Quad> FindRootsExactly(const BernsteinCubic& b)
{
  std::vector<Quad> roots;
  FindSignChanges({ b[0], b[1], b[2], b[3] }, 0, 1, roots);
  return roots;
}

/// scale (u - a) (u - b) (u - c), from its polar form.
BernsteinCubic FromRoots(double a, double b, double c, double scale)
{
  const Quad sum = Quad(a) + b + c;
  const Quad pairs = Quad(a) * b + Quad(b) * c + Quad(c) * a;
  const Quad product = Quad(a) * b * c;
  return { static_cast<double>(-product * scale),
    static_cast<double>((pairs / 3 - product) * scale),
    static_cast<double>((-sum / 3 + pairs * 2 / 3 - product) * scale),
    static_cast<double>((1 - sum + pairs - product) * scale) };
}

/// c0 + c1 u + c2 u^2 + c3 u^3.
BernsteinCubic FromPowers(double c0, double c1, double c2, double c3)
{
  return { c0, c0 + c1 / 3.0, c0 + (2.0 * c1 + c2) / 3.0, c0 + c1 + c2 + c3 };
}

std::string ToText(const BernsteinCubic& b)
{
  char text[200];
  std::snprintf(text, sizeof(text), "{ %a, %a, %a, %a }", b[0], b[1], b[2], b[3]);
  return text;
}

double Size(const BernsteinCubic& b)
{
  return std::max({ std::abs(b[0]), std::abs(b[1]), std::abs(b[2]), std::abs(b[3]) });
}

/// The size of the smallest value of the cubic where it turns: below the rounding of its
/// coefficients, the number of roots is undecidable.
double SmallestTurn(const BernsteinCubic& b)
{
  const Quad d0 = Quad(b[1]) - b[0];
  const Quad d1 = Quad(b[2]) - b[1];
  const Quad d2 = Quad(b[3]) - b[2];
  std::vector<Quad> turns;
  const QuadCubic derivative = { d0, (d0 + 2 * d1) / 3, (2 * d1 + d2) / 3, d2 };
  FindSignChanges(derivative, 0, 1, turns);
  double smallest = std::numeric_limits<double>::infinity();
  for (const Quad u : turns)
  {
    const Quad v = 1 - u;
    const Quad f =
      v * v * v * b[0] + 3 * u * v * v * b[1] + 3 * u * u * v * b[2] + u * u * u * b[3];
    smallest = std::min(smallest, std::abs(static_cast<double>(f)));
  }
  return smallest;
}

double SlopeAt(const BernsteinCubic& b, double u)
{
  const double v = 1.0 - u;
  return 3.0 * ((b[1] - b[0]) * v * v + 2.0 * (b[2] - b[1]) * u * v + (b[3] - b[2]) * u * u);
}

/// What must hold for the roots of every cubic of finite coefficients.
void ExpectConsistent(const BernsteinCubic& b, const std::vector<Root>& roots)
{
  ASSERT_LE(roots.size(), 3U) << ToText(b);
  const bool insideAtBegin = b[0] >= 0.0;
  const bool insideAtEnd = b[3] >= 0.0;
  ASSERT_EQ(roots.size() % 2 == 1, insideAtBegin != insideAtEnd) << ToText(b);
  bool inside = insideAtBegin;
  double u = 0.0;
  for (const Root& root : roots)
  {
    ASSERT_GE(root.U, u) << ToText(b);
    ASSERT_LE(root.U, 1.0) << ToText(b);
    ASSERT_EQ(root.Entering, !inside) << ToText(b);
    u = root.U;
    inside = root.Entering;
  }
}

/// Compares the roots with those found by halving.
class RootChecks
{
public:
  ~RootChecks()
  {
    std::cout << "[ tried    ] " << this->Cubics << " cubics, " << this->Roots << " roots, "
              << this->Ambiguous << " cubics turn within rounding of zero; largest error "
              << this->LargestError << ", of roots not flat " << this->LargestErrorWhereSteep
              << "\n";
  }

  RootChecks() = default;
  RootChecks(const RootChecks&) = delete;
  RootChecks& operator=(const RootChecks&) = delete;

  void Check(const BernsteinCubic& b)
  {
    ++this->Cubics;
    const std::vector<Root> roots = FindRoots(b);
    ASSERT_NO_FATAL_FAILURE(ExpectConsistent(b, roots));
    const std::vector<Quad> exact = FindRootsExactly(b);
    if (SmallestTurn(b) <= 1e-15 * Size(b))
    {
      ++this->Ambiguous;
      return;
    }
    ASSERT_EQ(roots.size(), exact.size()) << ToText(b);
    for (std::size_t i = 0; i < roots.size(); ++i)
    {
      this->CheckRoot(b, roots[i].U, static_cast<double>(roots[i].U - exact[i]));
    }
  }

  std::size_t GetNumberOfRoots() const { return this->Roots; }
  std::size_t GetNumberAmbiguous() const { return this->Ambiguous; }

private:
  void CheckRoot(const BernsteinCubic& b, double u, double error)
  {
    ++this->Roots;
    error = std::abs(error);
    this->LargestError = std::max(this->LargestError, error);
    const double slope = std::abs(SlopeAt(b, u)) / Size(b);
    if (slope > 1e-4)
    {
      this->LargestErrorWhereSteep = std::max(this->LargestErrorWhereSteep, error);
      ASSERT_LE(error, 1e-9) << ToText(b) << " at " << u;
    }
    // Where the cubic is flat, its rounding moves the root.
    const double curved = 2e-15 / std::max(slope, 1e-300);
    ASSERT_LE(error, 1e-9 + std::min(curved, 1e-5)) << ToText(b) << " at " << u;
  }

  std::size_t Cubics = 0;
  std::size_t Roots = 0;
  std::size_t Ambiguous = 0;
  double LargestError = 0.0;
  double LargestErrorWhereSteep = 0.0;
};

//------------------------------------------------------------------------------
TEST(CubicRoots, CubicsOfGivenRoots)
{
  RandomNumbers random(201);
  RootChecks checks;
  for (int exponent = -6; exponent <= -1; ++exponent)
  {
    const double gap = std::pow(10.0, exponent);
    for (int i = 0; i < 1000; ++i)
    {
      const double a = random.Uniform(0.0, 1.0 - 2.0 * gap);
      const double b = a + gap * random.Uniform(0.5, 1.0);
      const double c = i % 3 == 0 ? b + gap : random.Uniform(-2.0, 3.0);
      const BernsteinCubic cubic = FromRoots(a, b, c, random.WideMagnitude(-3.0, 3.0));
      ASSERT_NO_FATAL_FAILURE(checks.Check(cubic));
      // A third root apart leaves the pair clear of rounding: all within [0, 1] must be found.
      if (std::abs(c - a) > 0.1 && std::abs(c - b) > 0.1 && std::abs(c) > 1e-9 &&
        std::abs(c - 1.0) > 1e-9)
      {
        ASSERT_EQ(FindRoots(cubic).size(), c > 0.0 && c < 1.0 ? 3U : 2U) << ToText(cubic);
      }
    }
  }
  EXPECT_GT(checks.GetNumberOfRoots(), 11000U);
  EXPECT_LT(checks.GetNumberAmbiguous(), 1100U); // three roots within 1e-5 or 1e-6, and a few more
}

//------------------------------------------------------------------------------
TEST(CubicRoots, RandomCubics)
{
  RandomNumbers random(202);
  RootChecks checks;
  for (int i = 0; i < 10000; ++i)
  {
    BernsteinCubic b;
    for (double& coefficient : b)
    {
      coefficient =
        i % 2 == 0 ? random.Uniform(-1.0, 1.0) : static_cast<double>(random.Integer(-3, 3));
    }
    ASSERT_NO_FATAL_FAILURE(checks.Check(b));
  }
  EXPECT_GT(checks.GetNumberOfRoots(), 5000U);
}

//------------------------------------------------------------------------------
TEST(CubicRoots, NearlyTangentCubics)
{
  RandomNumbers random(203);
  RootChecks checks;
  for (int i = 0; i < 7000; ++i)
  {
    const double at = random.Uniform(0.0, 1.0);
    const double other = random.Uniform(-3.0, 4.0);
    const double offset = random.WideMagnitude(-14.0, -2.0);
    BernsteinCubic b = FromRoots(at, at, other, 1.0);
    for (double& coefficient : b)
    {
      coefficient += offset;
    }
    ASSERT_NO_FATAL_FAILURE(checks.Check(b));
  }
  EXPECT_GT(checks.GetNumberOfRoots(), 5000U);
}

//------------------------------------------------------------------------------
TEST(CubicRoots, LinesAndParabolas)
{
  RandomNumbers random(204);
  RootChecks checks;
  for (int i = 0; i < 7000; ++i)
  {
    const double root = random.Uniform(-0.2, 1.2);
    const double slope = random.WideMagnitude(-3.0, 3.0);
    ASSERT_NO_FATAL_FAILURE(checks.Check(FromPowers(-slope * root, slope, 0.0, 0.0)));
    const double other = random.Uniform(-0.2, 1.2);
    ASSERT_NO_FATAL_FAILURE(
      checks.Check(FromPowers(slope * root * other, -slope * (root + other), slope, 0.0)));
    const double leading = random.WideMagnitude(-300.0, -10.0);
    ASSERT_NO_FATAL_FAILURE(checks.Check(FromPowers(-slope * root, slope, leading, -leading)));
  }
  EXPECT_GT(checks.GetNumberOfRoots(), 15000U);
}

//------------------------------------------------------------------------------
TEST(CubicRoots, NoRootsWithoutSignChange)
{
  EXPECT_TRUE(FindRoots({ 0.0, 0.0, 0.0, 0.0 }).empty());
  for (const double value : { 5e-324, 1e-300, 1.0, 1e300 })
  {
    EXPECT_TRUE(FindRoots({ value, value, value, value }).empty());
    EXPECT_TRUE(FindRoots({ -value, -value, -value, -value }).empty());
    EXPECT_TRUE(FindRoots({ value, 0.0, 0.0, value }).empty());
  }
}

//------------------------------------------------------------------------------
TEST(CubicRoots, SignRuleForZeroCoefficients)
{
  // At the ends: zero is inside.
  EXPECT_TRUE(FindRoots({ 0.0, 1.0, 2.0, 3.0 }).empty());
  EXPECT_TRUE(FindRoots({ 3.0, 2.0, 1.0, 0.0 }).empty());
  const std::vector<Root> leaving = FindRoots({ 0.0, -1.0, -2.0, -3.0 });
  ASSERT_EQ(leaving.size(), 1U);
  EXPECT_FALSE(leaving[0].Entering);
  EXPECT_EQ(leaving[0].U, 0.0);
  const std::vector<Root> entering = FindRoots({ -3.0, -2.0, -1.0, 0.0 });
  ASSERT_EQ(entering.size(), 1U);
  EXPECT_TRUE(entering[0].Entering);
  EXPECT_EQ(entering[0].U, 1.0);
  // Roots of order three, where the cubic is nothing but rounding over 1e-5.
  const std::vector<Root> flatAtEnd = FindRoots({ -1.0, 0.0, 0.0, 0.0 });
  ASSERT_EQ(flatAtEnd.size(), 1U);
  EXPECT_NEAR(flatAtEnd[0].U, 1.0, 1e-5);
  const std::vector<Root> flatAtBegin = FindRoots({ 0.0, 0.0, 0.0, -1.0 });
  ASSERT_EQ(flatAtBegin.size(), 1U);
  EXPECT_NEAR(flatAtBegin[0].U, 0.0, 1e-5);
  const std::vector<Root> flatWithin = FindRoots({ -1.0, 1.0, -1.0, 1.0 });
  ASSERT_EQ(flatWithin.size(), 1U);
  EXPECT_NEAR(flatWithin[0].U, 0.5, 1e-5);
}

//------------------------------------------------------------------------------
// 3 (u - 1/2)^2 and 3 (1 - 2 u)^2 (1 + u) to the last bit: they touch zero, which is inside. From
// inside that is no root. From outside, either none or a pair without length obeys the sign rule.
TEST(CubicRoots, NoRootsWhereACubicIsTangentFromInside)
{
  EXPECT_TRUE(FindRoots({ 0.75, -0.25, -0.25, 0.75 }).empty());
  EXPECT_TRUE(FindRoots({ 3.0, 0.0, -1.0, 6.0 }).empty());
  for (const BernsteinCubic& b :
    { BernsteinCubic{ -0.75, 0.25, 0.25, -0.75 }, BernsteinCubic{ -3.0, -0.0, 1.0, -6.0 } })
  {
    const std::vector<Root> pair = FindRoots(b);
    ASSERT_NO_FATAL_FAILURE(ExpectConsistent(b, pair));
    for (const Root& root : pair)
    {
      EXPECT_NEAR(root.U, 0.5, 1e-8);
    }
  }
}

//------------------------------------------------------------------------------
TEST(CubicRoots, IdenticalAtAnyMagnitude)
{
  RandomNumbers random(205);
  std::size_t found = 0;
  for (int i = 0; i < 20000; ++i)
  {
    // Multiples of 2^-20 stay exact when scaled by 2^-1000.
    BernsteinCubic b;
    for (double& coefficient : b)
    {
      coefficient = random.Integer(-(1 << 20), 1 << 20) * 0x1p-20;
    }
    const std::vector<Root> roots = FindRoots(b);
    found += roots.size();
    for (const int exponent : { -1000, -997, -400, -333, 1, 333, 334, 500, 1000 })
    {
      BernsteinCubic scaled;
      for (std::size_t k = 0; k < 4; ++k)
      {
        scaled[k] = std::ldexp(b[k], exponent);
      }
      ASSERT_EQ(FindRoots(scaled), roots) << ToText(b) << " 2^" << exponent;
    }
  }
  std::cout << "[ tried    ] 20000 cubics at 10 magnitudes, " << found << " roots each\n";
  EXPECT_GT(found, 10000U);
}

//------------------------------------------------------------------------------
// The signs at the ends, which neighbouring cells must agree on, are those of the coefficients,
// even if another coefficient is so large that the one at the end is negligible beside it.
TEST(CubicRoots, SignsAtTheEndsBesideHugeCoefficients)
{
  for (const double tiny : { 1e-30, 1e-200, 1e-300, 5e-324 })
  {
    for (const double huge : { 1.0, 1e90, 1e110, 1e290, 1e307 })
    {
      EXPECT_EQ(FindRoots({ -tiny, huge, huge, huge }).size(), 1U) << tiny << " " << huge;
      EXPECT_EQ(FindRoots({ huge, huge, huge, -tiny }).size(), 1U) << tiny << " " << huge;
      EXPECT_EQ(FindRoots({ tiny, -huge, -huge, -huge }).size(), 1U) << tiny << " " << huge;
      EXPECT_EQ(FindRoots({ -tiny, huge, huge, -tiny }).size(), 2U) << tiny << " " << huge;
    }
  }
}

//------------------------------------------------------------------------------
TEST(CubicRoots, ConsistentForAnyFiniteBits)
{
  RandomNumbers random(206);
  std::size_t cubics = 0;
  std::size_t found = 0;
  for (int i = 0; i < 2000000; ++i)
  {
    BernsteinCubic b;
    bool finite = true;
    for (double& coefficient : b)
    {
      const std::uint64_t bits = random.Bits();
      std::memcpy(&coefficient, &bits, sizeof(bits));
      finite = finite && std::isfinite(coefficient);
    }
    const std::vector<Root> roots = FindRoots(b);
    ASSERT_LE(roots.size(), 3U) << ToText(b);
    if (finite)
    {
      ++cubics;
      found += roots.size();
      ASSERT_NO_FATAL_FAILURE(ExpectConsistent(b, roots));
    }
  }
  std::cout << "[ tried    ] " << cubics << " cubics, " << found << " roots\n";
  EXPECT_GT(found, 500000U);
}

//------------------------------------------------------------------------------
TEST(CubicRoots, TerminatesForNonFiniteCoefficients)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double values[] = { 0.0, 1.0, -1.0, std::nan(""), infinity, -infinity };
  for (int i = 0; i < 6 * 6 * 6 * 6; ++i)
  {
    const BernsteinCubic b = { values[i % 6], values[i / 6 % 6], values[i / 36 % 6],
      values[i / 216] };
    EXPECT_LE(FindRoots(b).size(), 3U) << ToText(b);
  }
}

//------------------------------------------------------------------------------
TEST(CubicRoots, StopsWhenTheVisitorIsSatisfied)
{
  const BernsteinCubic b = FromRoots(0.2, 0.5, 0.9, 1.0);
  const std::vector<Root> all = FindRoots(b);
  ASSERT_EQ(all.size(), 3U);
  for (std::size_t limit = 1; limit <= 3; ++limit)
  {
    std::vector<Root> roots;
    Robust::ForEachRoot(b,
      [&](double u, bool entering)
      {
        roots.push_back({ u, entering });
        return roots.size() == limit;
      });
    EXPECT_EQ(roots, std::vector<Root>(all.begin(), all.begin() + static_cast<int>(limit)));
  }
}

}
}
