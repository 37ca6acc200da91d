// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The reference solutions are tested themselves.

#include "Certificate.h"
#include "Tally.h"

#include <gtest/gtest.h>

using namespace HardCases;
using Oracle::Claim;
using Oracle::Verdict;

TEST(TestReferences, CrossingOfAPlane)
{
  // x = 2.5, met at t = 5 by a line that starts at x = -2.5.
  const Field field = Sample({ 6, 4, 4 }, [](int x, int, int) { return x; });
  const Line line = { { -2.5, 1.25, 1.5 }, { 1.0, 0.0, 0.0 } };
  std::vector<Oracle::Quad> crossings;
  for (const Oracle::Piece& piece : Oracle::FindPieces(field, 2.5, line))
  {
    if ((piece.AtBegin >= 0) != (piece.AtEnd >= 0))
    {
      crossings.push_back(Oracle::FindCrossing(field, 2.5, line, piece));
    }
  }
  ASSERT_EQ(crossings.size(), 1U);
  EXPECT_LT(Oracle::Absolute(crossings[0] - 5), 1e-30);
}

TEST(TestReferences, ThreeCrossingsInOneCell)
{
  // (x - 1/4) (y - 1/2) (z - 3/4) along the diagonal.
  const Field field =
    Sample({ 2, 2, 2 }, [](int x, int y, int z) { return (x - 0.25) * (y - 0.5) * (z - 0.75); });
  const Line line = { { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 } };
  std::vector<Oracle::Quad> crossings;
  for (const Oracle::Piece& piece : Oracle::FindPieces(field, 0.0, line))
  {
    if ((piece.AtBegin >= 0) != (piece.AtEnd >= 0))
    {
      crossings.push_back(Oracle::FindCrossing(field, 0.0, line, piece));
    }
  }
  ASSERT_EQ(crossings.size(), 3U);
  EXPECT_LT(Oracle::Absolute(crossings[0] - 0.25), 1e-30);
  EXPECT_LT(Oracle::Absolute(crossings[1] - 0.5), 1e-30);
  EXPECT_LT(Oracle::Absolute(crossings[2] - 0.75), 1e-30);
}

TEST(TestReferences, CertificateRejectsWrongClaims)
{
  const Field field =
    Sample({ 2, 2, 2 }, [](int x, int y, int z) { return (x - 0.25) * (y - 0.5) * (z - 0.75); });
  const Line line = { { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 } };
  const Index cell = { 0, 0, 0 };
  const auto judge = [&](double t, bool entering) {
    return Oracle::Judge(field, 0.0, line, { cell, t - 1e-9, t + 1e-9, entering });
  };
  EXPECT_EQ(judge(0.25, true), Verdict::Proven);
  EXPECT_EQ(judge(0.25, false), Verdict::NoSignChange);
  EXPECT_EQ(judge(0.25 + 2e-9, true), Verdict::EarlierRoot);
  EXPECT_EQ(judge(0.25 - 2e-9, true), Verdict::NoSignChange);
  EXPECT_EQ(judge(0.5, false), Verdict::EarlierRoot);
  EXPECT_EQ(judge(1.5, true), Verdict::NotInCell);
}

TEST(TestReferences, CertificateDistinguishesCloseRootsFromTangents)
{
  // - (1 - 2 x) (1 - 2 y) along the diagonal touches 0 from below; shifted, it crosses twice.
  const Field field =
    Sample({ 3, 2, 2 }, [](int x, int y, int) { return x == 2 ? 9 : -(1 - 2 * x) * (1 - 2 * y); });
  const Line touching = { { 0.0, 0.0, 0.5 }, { 1.0, 1.0, 0.0 } };
  const Claim never = { { 0, 0, 0 }, 0.75, 0.8, true };
  EXPECT_EQ(Oracle::Judge(field, 0.0, touching, never), Verdict::NoSignChange);
  // Now it rises above the isovalue by 1e-300 only, in an interval of 1e-150.
  EXPECT_EQ(Oracle::Judge(field, -1e-300, touching, never), Verdict::EarlierRoot);
}

TEST(TestReferences, CrossingsAreCertified)
{
  RandomNumbers random(1);
  std::size_t count = 0;
  for (int i = 0; i < 50; ++i)
  {
    const Field field = RandomField(random, { 4, 4, 4 });
    for (const Line& line : RandomLines(random, field.Dimensions, 4))
    {
      for (const Oracle::Piece& piece : Oracle::FindPieces(field, 0.1, line))
      {
        if ((piece.AtBegin >= 0) != (piece.AtEnd >= 0))
        {
          const auto t = static_cast<double>(Oracle::FindCrossing(field, 0.1, line, piece));
          const Claim claim = { piece.Cell, t - 1e-13, t + 1e-13, piece.AtEnd >= 0 };
          EXPECT_EQ(Oracle::Judge(field, 0.1, line, claim), Verdict::Proven);
          ++count;
          break;
        }
      }
    }
  }
  EXPECT_GT(count, 100U);
}

TEST(TestReferences, FirstHitsAreCertified)
{
  RandomNumbers random(2);
  Tally tally("exact certificate (GMP) of first hits");
  for (int i = 0; i < 100; ++i)
  {
    const Field field = RandomField(random, { 5, 4, 6 });
    const auto lines = RandomLines(random, field.Dimensions, 20);
    const double isovalue = random.Uniform(-0.5, 0.5);
    Tracer tracer(field);
    const RayHits hits = tracer.Cast(lines, isovalue, RootSolver::Robust, Reach::First);
    for (std::size_t ray = 0; ray < lines.size(); ++ray)
    {
      if (hits.First[ray] == hits.First[ray + 1])
      {
        continue;
      }
      const Hit& hit = hits.Hits[hits.First[ray]];
      const Claim claim = { tracer.GetCell(hit), hit.T - 1e-9, hit.T + 1e-9, hit.Entering };
      const Verdict verdict = Oracle::Judge(field, isovalue, lines[ray], claim);
      tally.Count(0, 1, verdict == Verdict::EarlierRoot, verdict == Verdict::NoSignChange);
      EXPECT_EQ(verdict, Verdict::Proven);
    }
    tally.Count(lines.size(), 0, 0, 0);
  }
  tally.Note("each proven within 1e-9, and none before");
  tally.Report();
}
