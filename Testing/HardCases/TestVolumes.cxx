// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Volumes in which surfaces, cells and bricks meet in degenerate ways.

#include "Tally.h"

#include "Math/Matrix.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace HardCases;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Random, but with a closed surface: inside in the middle, outside at the border.
Field ClosedNoise(RandomNumbers& random, const Index& dimensions, const Index& start)
{
  return Sample(dimensions,
    [&](int x, int y, int z)
    {
      const bool isBorder = x == 0 || y == 0 || z == 0 || x == dimensions[0] - 1 ||
        y == dimensions[1] - 1 || z == dimensions[2] - 1;
      const bool isStart =
        (x - start[0]) / 2 == 0 && (y - start[1]) / 2 == 0 && (z - start[2]) / 2 == 0;
      const double value = random.Uniform(0.05, 1.0);
      return isBorder ? -value : (isStart ? value : random.Uniform(-0.6, 1.0));
    });
}

/// A box whose faces vary about lattice planes by no more than rounding of the values beside them:
/// on which side of a face of cells the surface passes depends on the last bit.
Field NearlyFlush(RandomNumbers& random, const Index& dimensions, double noise)
{
  const double half = (dimensions[0] - 1) / 2.0;
  return Sample(dimensions,
    [&random, half, noise](int x, int y, int z)
    {
      const double r = std::max({ std::abs(x - half), std::abs(y - half), std::abs(z - half) });
      return r == half - 1.0 ? random.Uniform(-noise, noise)
                             : random.Uniform(0.5, 1.0) * (half - 1.0 - r);
    });
}

/// Counts rays from inside a closed surface that leave it without a hit, and rays along which
/// entries and exits do not alternate.
struct CrackCount
{
  std::size_t Rays = 0;
  std::size_t Hits = 0;
  std::size_t Cracks = 0;
  std::size_t Disorder = 0;

  void Check(Tracer& tracer, const std::vector<Line>& lines, RootSolver solver)
  {
    const RayHits firsts = tracer.Cast(lines, 0.0, solver, Reach::First);
    const RayHits all = tracer.Cast(lines, 0.0, solver, Reach::All);
    for (std::size_t ray = 0; ray < lines.size(); ++ray)
    {
      this->Cracks += firsts.First[ray] == firsts.First[ray + 1] ? 1 : 0;
      bool isInside = true;
      bool isOrdered = true;
      double last = -Infinity;
      for (std::size_t i = all.First[ray]; i < all.First[ray + 1]; ++i)
      {
        const Hit& hit = all.Hits[i];
        isOrdered = isOrdered && hit.Entering != isInside && hit.T >= last;
        isInside = hit.Entering;
        last = hit.T;
      }
      this->Disorder += isOrdered && !isInside ? 0 : 1;
    }
    this->Rays += lines.size();
    this->Hits += all.Hits.size();
  }
};

/// Rays from a point in all directions: random ones, and ones that meet edges and vertices.
std::vector<Line> RaysFrom(RandomNumbers& random, const Triple& origin, std::size_t count)
{
  std::vector<Line> lines;
  while (lines.size() < count)
  {
    Triple direction = random.Direction();
    if (lines.size() % 4 == 0)
    {
      for (double& d : direction)
      {
        d = random.Integer(-3, 3);
      }
    }
    if (Oracle::Length(direction) > 0.0)
    {
      lines.push_back({ origin, direction });
    }
  }
  return lines;
}

void CastFromInside(RandomNumbers& random, RootSolver solver, std::size_t rays, CrackCount& count)
{
  const Index dimensions = { 10, 10, 10 };
  const std::size_t raysOfField = 5000;
  for (std::size_t done = 0, i = 0; done < rays; done += raysOfField, ++i)
  {
    const double noises[] = { 1e-7, 1e-15, 1e-16, 1e-17, 1e-300 };
    const Field field = i % 2 == 0 ? NearlyFlush(random, dimensions, noises[i / 2 % 5])
                                   : ClosedNoise(random, dimensions, { 4, 4, 4 });
    const Triple origin =
      i % 3 == 0 ? Triple{ 4.0, 4.0, 4.0 } : Triple{ random.Uniform(4.0, 5.0), 4.5, 4.25 };
    Tracer tracer(field);
    count.Check(tracer, RaysFrom(random, origin, raysOfField), solver);
  }
}

}

TEST(TestVolumes, NoRayLeaksThroughAClosedSurface)
{
  const struct
  {
    RootSolver Solver;
    const char* Name;
    std::size_t Rays;
  } solvers[] = { { RootSolver::Robust, "Robust", 1000000 },
    { RootSolver::Marmitt, "Marmitt", 200000 }, { RootSolver::Linear, "Linear", 200000 } };
  for (const auto& solver : solvers)
  {
    RandomNumbers random(80);
    CrackCount count;
    const std::size_t rays = IsLongRun() ? solver.Rays * 100 : solver.Rays;
    CastFromInside(random, solver.Solver, rays, count);
    Tally tally(std::string("from inside closed surfaces, parity (") + solver.Name + ")");
    tally.Count(count.Rays, count.Hits, count.Cracks, count.Disorder);
    tally.Report();
  }
}

TEST(TestVolumes, IsovalueEqualToSamples)
{
  RandomNumbers random(81);
  Tally ramps("8-bit ramps, isovalue of samples (Robust)");
  Tally labels("8-bit labels, isovalue of a label (Robust)");
  Tally checkers("8-bit checkerboard (Robust)");
  for (int i = 0; i < 60; ++i)
  {
    const Index dimensions = { 7, 8, 9 };
    const auto lines = RandomLines(random, dimensions, 40);
    const int slope = random.Integer(1, 20);
    const Field ramp = Sample(dimensions,
      [slope, i](int x, int y, int z) { return slope * (i % 2 == 0 ? x : (x + y + z) / 2); });
    const Field label =
      Sample(dimensions, [&random](int, int, int) { return random.Integer(0, 3) * 40; });
    const Field checker =
      Sample(dimensions, [](int x, int y, int z) { return (x + y + z) % 2 == 0 ? 10 : 250; });
    ramps.Check(ramp, 2 * slope, lines, ScalarType::UInt8);
    labels.Check(label, 40 * random.Integer(1, 3), lines, ScalarType::UInt8);
    checkers.Check(checker, i % 2 == 0 ? 250.0 : 130.0, lines, ScalarType::UInt8);
  }
  ramps.Report();
  labels.Report();
  checkers.Report();
}

TEST(TestVolumes, ConstantCellsAtTheIsovalue)
{
  // Layers along z. A value equal to the isovalue is inside: in a slab of zeros no surface is
  // visible.
  const struct
  {
    const char* Name;
    int Before;
    int Behind;
    std::vector<double> Positions;
  } layers[] = { { "flat slab: below, at, below", -1, -1, { 3.0, 5.0 } },
    { "flat slab: below, at, above", -1, 1, { 3.0 } },
    { "flat slab: above, at, below", 1, -1, { 5.0 } },
    { "flat slab: above, at, above", 1, 1, {} } };
  for (const auto& layer : layers)
  {
    RandomNumbers random(82);
    const Field field = Sample({ 9, 9, 9 },
      [&layer](int, int, int z) { return z < 3 ? layer.Before : (z > 5 ? layer.Behind : 0); });
    std::vector<Line> lines;
    for (int i = 0; i < 2000; ++i)
    {
      const Triple direction = { random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), 1.0 };
      lines.push_back({ { random.Uniform(3.0, 5.0), random.Uniform(3.0, 5.0), -2.0 }, direction });
    }
    Tracer tracer(field);
    const RayHits hits = tracer.Cast(lines, 0.0);
    Tally tally(std::string(layer.Name) + " (Robust)");
    tally.Expect(RobustGuarantee({ 9, 9, 9 }));
    std::size_t missed = 0;
    std::size_t falseHits = 0;
    for (std::size_t ray = 0; ray < lines.size(); ++ray)
    {
      const std::size_t count = hits.First[ray + 1] - hits.First[ray];
      missed += count < layer.Positions.size() ? 1 : 0;
      falseHits += count > layer.Positions.size() ? 1 : 0;
      for (std::size_t k = 0; k < std::min(count, layer.Positions.size()); ++k)
      {
        const Hit& hit = hits.Hits[hits.First[ray] + k];
        tally.AddError(std::abs(tracer.GetField().GetPoint(hit)[2] - layer.Positions[k]));
      }
    }
    tally.Count(lines.size(), hits.Hits.size(), missed, falseHits);
    tally.Report();
  }
}

TEST(TestVolumes, BoundariesOfMacrocellsAndBricks)
{
  RandomNumbers random(83);
  Tally tally("sizes 8 n + {-1, 0, 1, 2}, sparse (Robust)");
  std::size_t different = 0;
  for (int size = 0; size < 4 * 4 * 8; ++size)
  {
    const int x = size % 4 - 1;
    const int y = size / 4 % 4 - 1;
    const Index dimensions = { 16 + x, 8 + y, 16 + random.Integer(-1, 2) };
    // Two samples are inside, near seams: most macrocells are empty, and surfaces reach into one
    // from samples that it shares with the next.
    Field field =
      Sample(dimensions, [&random](int, int, int) { return random.Uniform(-1.0, -0.1); });
    std::vector<Line> lines;
    for (int i = 0; i < 2; ++i)
    {
      const Index spot = { random.Integer(7, 9), random.Integer(6, 7) + std::max(y - 1, 0),
        random.Integer(7, 9) };
      field.At(spot[0], spot[1], spot[2]) = random.Uniform(0.1, 1.0);
      for (int ray = 0; ray < 50; ++ray)
      {
        const Triple direction = random.Direction();
        const Triple target = random.PointInBox({ -0.9, -0.9, -0.9 }, { 0.9, 0.9, 0.9 });
        Line line{ {}, direction };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          line.Origin[axis] = spot[axis] + target[axis] - 30.0 * direction[axis];
        }
        lines.push_back(line);
      }
    }
    tally.Check(field, 0.0, lines);
    Tracer plain(field, { {}, vtkIsosurfaceRayTracing::BrickLayout::Unbricked, 8, 4 });
    Tracer bricked(field);
    different += IsSame(plain.Cast(lines, 0.0), bricked.Cast(lines, 0.0)) ? 0 : 1;
  }
  EXPECT_EQ(different, 0U);
  tally.Note("the same bits without macrocells and bricks");
  tally.Report();
}

TEST(TestVolumes, NonFiniteSamples)
{
  RandomNumbers random(84);
  Tally tally("5 % NaN and infinite samples (Robust)");
  const double bad[] = { std::numeric_limits<double>::quiet_NaN(), Infinity, -Infinity };
  for (int i = 0; i < 100; ++i)
  {
    const Field field = Sample({ 9, 8, 10 },
      [&](int, int, int) {
        return random.Integer(0, 19) == 0 ? bad[random.Integer(0, 2)] : random.Uniform(-1.0, 1.0);
      });
    const auto lines = RandomLines(random, field.Dimensions, 40);
    const double isovalue = random.Uniform(-0.5, 0.5);
    tally.Check(field, isovalue, lines);
  }
  tally.Report();
}

TEST(TestVolumes, NonFiniteIsovalue)
{
  RandomNumbers random(85);
  const Field field = Sample({ 6, 6, 6 },
    [&random](int, int, int)
    { return random.Integer(0, 9) == 0 ? Infinity : random.Uniform(-1.0, 1.0); });
  Tracer tracer(field);
  const auto lines = RandomLines(random, field.Dimensions, 1000);
  Tally tally("isovalue NaN or infinite (Robust)");
  for (const double isovalue : { Infinity, -Infinity, std::numeric_limits<double>::quiet_NaN() })
  {
    const std::size_t hits = tracer.Cast(lines, isovalue).Hits.size();
    tally.Count(lines.size(), hits, 0, hits);
  }
  tally.Report();
}

TEST(TestVolumes, RandomBitsAsSamples)
{
  // All bit patterns of a double, as whole volumes, through the whole ray tracer.
  RandomNumbers random(86);
  Tally tally("volumes of random bits (Robust, Marmitt, Analytic, Linear)");
  const int volumes = IsLongRun() ? 10000 : 20;
  for (int i = 0; i < volumes; ++i)
  {
    const Field field =
      Sample({ 9, 10, 11 }, [&random](int, int, int) { return random.AnyDouble(); });
    Tracer tracer(field);
    const auto lines = RandomLines(random, field.Dimensions, 500);
    for (const RootSolver solver :
      { RootSolver::Robust, RootSolver::Marmitt, RootSolver::Analytic, RootSolver::Linear })
    {
      const RayHits hits = tracer.Cast(lines, 0.0, solver);
      std::size_t outside = 0;
      for (const Hit& hit : hits.Hits)
      {
        const Triple& p = hit.Parametric;
        const bool isIn = *std::min_element(p.begin(), p.end()) >= 0.0 &&
          *std::max_element(p.begin(), p.end()) <= 1.0;
        outside += isIn ? 0 : 1;
      }
      tally.Count(lines.size(), hits.Hits.size(), 0, outside);
    }
  }
  tally.Report();
}
