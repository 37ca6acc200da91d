// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The limits of double precision. Nothing here is guaranteed; the tests record what happens, so
// that a change is noticed.

#include "Tally.h"

#include <gtest/gtest.h>

using namespace HardCases;

namespace
{

std::size_t CountHits(const Field& field, double isovalue, const Line& line)
{
  Tracer tracer(field);
  return tracer.Cast({ line }, isovalue).Hits.size();
}

}

TEST(TestLimits, TangentFromBelowHitsTwiceOrNever)
{
  // -(1 - 2 x) (1 - 2 y) is 0 in the middle of the diagonal and below elsewhere. A value equal to
  // the isovalue is inside: the ray is inside at one point. Rounding decides whether it enters and
  // leaves there, but it never enters alone.
  const Field field =
    Sample({ 2, 2, 2 }, [](int x, int y, int) { return -(1 - 2 * x) * (1 - 2 * y); });
  const Line line = { { 0.0, 0.0, 0.5 }, { 1.0, 1.0, 0.0 } };
  EXPECT_EQ(CountHits(field, 0.0, line) % 2, 0U);
  EXPECT_EQ(CountHits(field, -1e-14, line), 2U);
  EXPECT_EQ(CountHits(field, 1e-14, line), 0U);
}

TEST(TestLimits, RayThatLeavesTheBoundaryByADenormal)
{
  // Begins in the border of the volume and leaves it by a denormal: it counts as being in the
  // border.
  const Field field = Sample({ 3, 3, 3 }, [](int x, int, int) { return x; });
  const Line line = { { -1.0, 0.0, 0.5 },
    { 1.0, -std::numeric_limits<double>::denorm_min(), 0.0 } };
  EXPECT_EQ(CountHits(field, 0.5, line), 1U);
}

TEST(TestLimits, DirectionsTooShortForAnInverse)
{
  // 1 / 5e-309 is infinite: such a component counts as zero, and such a direction as none.
  const Field field = Sample({ 3, 3, 3 }, [](int x, int, int) { return x; });
  EXPECT_EQ(CountHits(field, 0.5, { { -1.0, 0.5, 0.5 }, { 5e-309, 0.0, 0.0 } }), 0U);
  EXPECT_EQ(CountHits(field, 0.5, { { -1.0, 0.5, 0.5 }, { 1e-300, 0.0, 0.0 } }), 1U);
}

TEST(TestLimits, AccuracyOfTripleRoots)
{
  // (1/5 - x) (1/5 - y) (1/5 - z), times -3500, in integers; exactly on the diagonal.
  const Field field = Sample({ 2, 2, 2 },
    [](int x, int y, int z)
    { return -28.0 * (x == 0 ? 1 : -4) * (y == 0 ? 1 : -4) * (z == 0 ? 1 : -4); });
  Tracer tracer(field);
  const RayHits hits = tracer.Cast({ { { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 } } }, 0.0);
  ASSERT_EQ(hits.Hits.size(), 1U);
  EXPECT_NEAR(hits.Hits[0].T, 0.2, 2e-5);
}
