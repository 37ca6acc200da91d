// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The same problem in equivalent forms, whose hits must be the same.

#include "Tally.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace HardCases;
using vtkIsosurfaceRayTracing::BrickLayout;

namespace
{

const RootSolver Solvers[] = { RootSolver::Robust, RootSolver::Analytic, RootSolver::Marmitt,
  RootSolver::Linear };

const Index Dimensions = { 13, 17, 11 };

Field Waves()
{
  return Sample(Dimensions,
    [](int x, int y, int z) {
      return std::sin(0.9 * x + 0.3) * std::sin(0.8 * y + 0.2 * z) + std::cos(0.7 * z - 0.1 * x);
    });
}

/// Compares the hits of two equivalent forms, ray by ray: how many rays differ in the number or the
/// directions of their hits, and the largest difference of T.
struct Comparison
{
  std::size_t Rays = 0;
  std::size_t Hits = 0;
  std::size_t Different = 0;
  bool SameBits = true;
  double Largest = 0.0;

  void Add(const RayHits& a, const RayHits& b)
  {
    for (std::size_t ray = 0; ray + 1 < a.First.size(); ++ray)
    {
      const std::size_t count = a.First[ray + 1] - a.First[ray];
      bool isSame = count == b.First[ray + 1] - b.First[ray];
      for (std::size_t i = 0; isSame && i < count; ++i)
      {
        const Hit& inA = a.Hits[a.First[ray] + i];
        const Hit& inB = b.Hits[b.First[ray] + i];
        isSame = inA.Entering == inB.Entering;
        this->SameBits = this->SameBits && inA.T == inB.T;
        this->Largest = std::max(this->Largest, std::abs(inA.T - inB.T));
      }
      this->Different += isSame ? 0 : 1;
    }
    this->Rays += a.First.size() - 1;
    this->Hits += a.Hits.size();
  }

  void Report(const std::string& name)
  {
    Tally tally(name);
    tally.Expect({ RootSolver::Robust, 0.0, 1e-9, 0.0 });
    tally.Count(this->Rays, this->Hits, this->Different, 0);
    tally.AddError(this->Largest);
    tally.Note(this->SameBits ? "the same bits" : "to rounding");
    tally.Report();
  }
};

/// Fields and lines for a metamorphosis that maps samples and points.
template <typename MapIndex, typename MapPoint, typename MapDirection>
Comparison Compare(const Index& mapped, const MapIndex& from, const MapPoint& point,
  const MapDirection& direction, std::size_t fields)
{
  RandomNumbers random(100);
  Comparison comparison;
  for (std::size_t i = 0; i < fields; ++i)
  {
    const Index dimensions = { 6, 7, 8 };
    const Field field = RandomField(random, dimensions);
    const Field other = Sample(mapped,
      [&](int x, int y, int z)
      {
        const Index index = from(Index{ x, y, z });
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          if (index[axis] < 0 || index[axis] >= dimensions[axis])
          {
            return std::numeric_limits<double>::quiet_NaN(); // padding
          }
        }
        return field.At(index[0], index[1], index[2]);
      });
    const auto lines = RandomLines(random, dimensions, 40);
    std::vector<Line> otherLines;
    for (const Line& line : lines)
    {
      otherLines.push_back({ point(line.Origin), direction(line.Direction) });
    }
    const double isovalue = random.Uniform(-0.5, 0.5);
    comparison.Add(Tracer(field).Cast(lines, isovalue), Tracer(other).Cast(otherLines, isovalue));
  }
  return comparison;
}

}

TEST(TestInvariance, AxisPermutation)
{
  // To rounding: interpolation goes along x first, then y, then z.
  const auto turn = [](const Triple& p) { return Triple{ p[1], p[2], p[0] }; };
  Compare(
    { 7, 8, 6 },
    [](const Index& i) {
      return Index{ i[2], i[0], i[1] };
    },
    turn, turn, 200)
    .Report("axes permuted (Robust)");
}

TEST(TestInvariance, Mirroring)
{
  // To rounding: last - x is no double where x is, and weights are rounded from the other side.
  Compare(
    { 6, 7, 8 },
    [](const Index& i) {
      return Index{ 5 - i[0], i[1], i[2] };
    },
    [](const Triple& p) {
      return Triple{ 5.0 - p[0], p[1], p[2] };
    },
    [](const Triple& d) {
      return Triple{ -d[0], d[1], d[2] };
    },
    200)
    .Report("mirrored (Robust)");
}

TEST(TestInvariance, TranslationByWholeCells)
{
  // To rounding: coordinates far from zero have fewer fractional bits.
  Compare(
    { 14, 17, 20 },
    [](const Index& i) {
      return Index{ i[0] - 8, i[1] - 10, i[2] - 12 };
    },
    [](const Triple& p) {
      return Triple{ p[0] + 8.0, p[1] + 10.0, p[2] + 12.0 };
    },
    [](const Triple& d) { return d; }, 200)
    .Report("translated by whole cells, NaN around (Robust)");
}

TEST(TestInvariance, ValuesScaledByPowersOfTwo)
{
  // Bitwise, as no operation rounds otherwise, except where values underflow.
  RandomNumbers random(101);
  Comparison comparison;
  const Field field = RandomField(random, { 6, 7, 8 });
  const auto lines = RandomLines(random, field.Dimensions, 200);
  const RayHits hits = Tracer(field).Cast(lines, 0.25);
  for (int exponent = -900; exponent <= 1000; exponent += 20)
  {
    Field scaled = field;
    for (double& value : scaled.Values)
    {
      value = std::ldexp(value, exponent);
    }
    comparison.Add(hits, Tracer(scaled).Cast(lines, std::ldexp(0.25, exponent)));
  }
  EXPECT_TRUE(comparison.SameBits);
  comparison.Report("values scaled by 2^-900 to 2^1000 (Robust)");
}

TEST(TestInvariance, NegatedValues)
{
  // Only ties differ: what equals the isovalue is inside both times.
  RandomNumbers random(102);
  Comparison comparison;
  for (int i = 0; i < 100; ++i)
  {
    Field field = RandomField(random, { 6, 7, 8 });
    const auto lines = RandomLines(random, field.Dimensions, 40);
    RayHits hits = Tracer(field).Cast(lines, 0.25);
    for (Hit& hit : hits.Hits)
    {
      hit.Entering = !hit.Entering;
    }
    for (double& value : field.Values)
    {
      value = -value;
    }
    comparison.Add(hits, Tracer(field).Cast(lines, -0.25));
  }
  EXPECT_TRUE(comparison.SameBits);
  comparison.Report("values negated (Robust)");
}

TEST(TestInvariance, DirectionsScaledByPowersOfTwo)
{
  RandomNumbers random(103);
  Comparison comparison;
  const Field field = RandomField(random, { 6, 7, 8 });
  const auto lines = RandomLines(random, field.Dimensions, 200);
  const RayHits hits = Tracer(field).Cast(lines, 0.25);
  for (int exponent = -900; exponent <= 900; exponent += 20)
  {
    std::vector<Line> scaled = lines;
    for (Line& line : scaled)
    {
      for (double& d : line.Direction)
      {
        d = std::ldexp(d, exponent);
      }
    }
    RayHits others = Tracer(field).Cast(scaled, 0.25);
    for (Hit& hit : others.Hits)
    {
      hit.T = std::ldexp(hit.T, exponent);
    }
    comparison.Add(hits, others);
  }
  EXPECT_TRUE(comparison.SameBits);
  comparison.Report("directions scaled by 2^-900 to 2^900 (Robust)");
}

TEST(TestInvariance, LayoutsMacrocellsAndThreads)
{
  RandomNumbers random(104);
  const Field field = Waves();
  const auto lines = RandomLines(random, Dimensions, 2000);
  const ImageSettings settings[] = { { { 8, 8 }, BrickLayout::Apron, 8, 4 },
    { {}, BrickLayout::Unbricked, 8, 4 }, { { 2 }, BrickLayout::TwoLevel, 3, 2 },
    { { 3, 2, 5 }, BrickLayout::Apron, 5, 1 }, { { 1 }, BrickLayout::Apron, 1, 1 },
    { { 64 }, BrickLayout::TwoLevel, 16, 4 } };
  std::size_t different = 0;
  std::size_t compared = 0;
  for (const RootSolver solver : Solvers)
  {
    for (const Reach reach : { Reach::First, Reach::All })
    {
      const RayHits expected = Tracer(field, settings[0]).Cast(lines, 0.3, solver, reach);
      EXPECT_GT(expected.Hits.size(), 500U) << "solver " << static_cast<int>(solver);
      for (const ImageSettings& other : settings)
      {
        for (const int threads : { 1, 2, 7 })
        {
          Tracer tracer(field, other);
          different += IsSame(expected, tracer.Cast(lines, 0.3, solver, reach, threads)) ? 0 : 1;
          compared += lines.size();
        }
      }
    }
  }
  Tally tally("layouts, macrocells, threads: the same bits (all solvers)");
  tally.Count(compared, 0, different, 0);
  tally.Report();
}

TEST(TestInvariance, SingleRaysAndBatches)
{
  RandomNumbers random(105);
  const Field field = Waves();
  const auto lines = RandomLines(random, Dimensions, 600);
  std::vector<std::size_t> order(lines.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  std::size_t different = 0;
  std::size_t compared = 0;
  for (const RootSolver solver : Solvers)
  {
    for (const Reach reach : { Reach::First, Reach::All })
    {
      Tracer tracer(field);
      const RayHits together = tracer.Cast(lines, 0.3, solver, reach);
      for (const std::size_t batch : { 1, 2, 7, 8, 9, 100 })
      {
        // In another order, too.
        for (std::size_t i = order.size(); i-- > 1;)
        {
          std::swap(order[i], order[random.Bits() % (i + 1)]);
        }
        for (std::size_t first = 0; first < lines.size(); first += batch)
        {
          const std::size_t count = std::min(batch, lines.size() - first);
          std::vector<Line> some;
          RayHits expected;
          expected.First = { 0 };
          for (std::size_t i = first; i < first + count; ++i)
          {
            some.push_back(lines[order[i]]);
            expected.Hits.insert(expected.Hits.end(),
              together.Hits.begin() + static_cast<std::ptrdiff_t>(together.First[order[i]]),
              together.Hits.begin() + static_cast<std::ptrdiff_t>(together.First[order[i] + 1]));
            expected.First.push_back(expected.Hits.size());
          }
          different += IsSame(expected, tracer.Cast(some, 0.3, solver, reach)) ? 0 : 1;
          compared += count;
        }
      }
    }
  }
  Tally tally("alone or in batches of any make-up: the same bits (all solvers)");
  tally.Count(compared, 0, different, 0);
  tally.Report();
}

TEST(TestInvariance, FirstHitIsTheFirstOfAllHits)
{
  RandomNumbers random(106);
  for (const RootSolver solver : Solvers)
  {
    std::size_t different = 0;
    std::size_t rays = 0;
    for (int i = 0; i < 50; ++i)
    {
      const Field field = RandomField(random, { 6, 6, 6 });
      const auto lines = RandomLines(random, field.Dimensions, 100);
      Tracer tracer(field);
      const RayHits first = tracer.Cast(lines, 0.1, solver, Reach::First);
      const RayHits all = tracer.Cast(lines, 0.1, solver, Reach::All);
      for (std::size_t ray = 0; ray < lines.size(); ++ray)
      {
        const bool any = all.First[ray] != all.First[ray + 1];
        const bool isFirst = any == (first.First[ray] != first.First[ray + 1]) &&
          (!any || first.Hits[first.First[ray]].T == all.Hits[all.First[ray]].T);
        different += isFirst ? 0 : 1;
      }
      rays += lines.size();
    }
    EXPECT_EQ(different, 0U) << "solver " << static_cast<int>(solver);
    EXPECT_EQ(rays, 5000U);
  }
}
