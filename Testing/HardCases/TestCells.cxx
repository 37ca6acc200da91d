// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// One cell or few, and values that make its cubic hard.

#include "Tally.h"

#include "Image/Cells/Solvers/AnalyticSolver.h"
#include "Image/Cells/Solvers/LinearSolver.h"
#include "Image/Cells/Solvers/MarmittSolver.h"
#include "Image/Cells/Solvers/RobustSolver.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace HardCases;
using namespace vtkIsosurfaceRayTracing;

namespace
{

const Index OneCell = { 2, 2, 2 };

/// A value that the interpolant has where it turns along the line, if it does, and the size of
/// differences around it.
bool FindTurn(const Field& field, const Line& line, double& value, double& size)
{
  const auto pieces = Oracle::FindPieces(field, 0.0, line);
  if (pieces.size() < 2)
  {
    return false;
  }
  size = 0.0;
  for (const double corner : field.Values)
  {
    size = std::max(size, std::abs(corner));
  }
  value = static_cast<double>(pieces[0].AtEnd * size);
  return true;
}

/// (x - a) (y - b) (z - c): along the diagonal, a cubic with these roots.
Field Product(double a, double b, double c)
{
  return Sample(OneCell, [a, b, c](int x, int y, int z) { return (x - a) * (y - b) * (z - c); });
}

const Line Diagonal = { { -0.25, -0.25, -0.25 }, { 1.0, 1.0, 1.0 } };

}

TEST(TestCells, RandomCorners)
{
  RandomNumbers random(10);
  Tally tally("random corners (Robust)");
  for (int i = 0; i < 400; ++i)
  {
    const Field field = RandomField(random, { 5, 6, 7 });
    const auto lines = RandomLines(random, field.Dimensions, 40);
    tally.Check(field, random.Uniform(-0.8, 0.8), lines);
  }
  tally.Report();
}

TEST(TestCells, TangentRays)
{
  RandomNumbers random(11);
  Tally far("tangent, extremum 1e-2 to 1e-6 from the isovalue (Robust)");
  Tally near("tangent, extremum 1e-7 to 1e-12 from the isovalue (Robust)");
  Tally nearest("tangent, extremum 1e-13 to 1e-16 from the isovalue (Robust)");
  for (int i = 0; i < 4000; ++i)
  {
    const Field field = RandomField(random, OneCell);
    const Line line = RandomLine(random, OneCell);
    double turn;
    double size;
    if (!FindTurn(field, line, turn, size))
    {
      continue;
    }
    for (int k = 2; k <= 16; ++k)
    {
      const double offset = size * std::pow(10.0, -k);
      for (const double isovalue : { turn - offset, turn + offset })
      {
        k <= 6 ? far.Check(field, isovalue, { line })
               : (k <= 12 ? near : nearest).Check(field, isovalue, { line });
      }
    }
  }
  far.Report();
  near.Report();
  nearest.Report();
}

TEST(TestCells, TangentRaysWithoutCrossing)
{
  // (p (1 - x) - q x) (p (1 - y) - q y) on the diagonal is a square: exact, as small integers.
  RandomNumbers random(12);
  Tally above("touching from above, integers (Robust)");
  Tally below("touching from below, integers (Robust)");
  for (int i = 0; i < 2000; ++i)
  {
    const int p = random.Integer(1, 100);
    const int q = random.Integer(1, 100);
    const auto square = [p, q](int x, int y, int)
    { return double((x == 0 ? p : -q) * (y == 0 ? p : -q)); };
    const Line line = { { -0.5, -0.5, random.Uniform(0.0, 1.0) }, { 1.0, 1.0, 0.0 } };
    above.Check(Sample(OneCell, square), 0.0, { line });
    below.Check(
      Sample(OneCell, [&square](int x, int y, int z) { return -square(x, y, z); }), 0.0, { line });
  }
  above.Report();
  below.Report();
}

TEST(TestCells, TangentThenCrossing)
{
  // A square as above, times a third factor: the hit is the crossing, never the tangency.
  RandomNumbers random(22);
  Tally tally("touching, and crossing elsewhere, integers (Robust)");
  for (int i = 0; i < 10000; ++i)
  {
    const int p = random.Integer(1, 100);
    const int q = random.Integer(1, 100);
    const int r = random.Integer(-100, 100);
    const int s = random.Integer(-100, 100);
    const Field field = Sample(OneCell,
      [p, q, r, s](int x, int y, int z)
      { return (x == 0 ? p : -q) * (y == 0 ? p : -q) * (z == 0 ? r : -s); });
    tally.Check(field, 0.0, { Diagonal });
  }
  tally.Report();
}

TEST(TestCells, ThreeRootsInOneCell)
{
  RandomNumbers random(13);
  Tally tally("three roots, gaps 1e-1 to 1e-8 (Robust)");
  std::size_t threes = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const double gap = std::pow(10.0, -random.Uniform(1.0, 8.0));
    const double other = random.Integer(0, 1) == 0 ? gap : random.Uniform(0.1, 0.4);
    const double a = random.Uniform(0.0, 0.4);
    const Field field = Product(a, a + gap, a + gap + other);
    tally.Check(field, 0.0, { Diagonal });
    Tracer tracer(field);
    threes += tracer.Cast({ Diagonal }, 0.0).Hits.size() == 3 ? 1 : 0;
  }
  tally.Note(std::to_string(threes) + " rays with all three hits");
  tally.Report();
}

TEST(TestCells, TripleRoots)
{
  RandomNumbers random(14);
  Tally tally("triple root (Robust)");
  for (int i = 0; i < 4000; ++i)
  {
    const double a = random.Uniform(0.0, 1.0);
    tally.Check(Product(a, a, a), 0.0, { Diagonal });
  }
  tally.Report();
}

TEST(TestCells, VanishingCoefficients)
{
  RandomNumbers random(15);
  Tally tally("vanishing leading coefficients (Robust)");
  for (int i = 0; i < 4000; ++i)
  {
    const int kind = i % 4;
    // A plane through the corner (1, 1, 1), there the last coefficient survives unrounded.
    const double g[3] = { double(random.Integer(-8, 8)), double(random.Integer(-8, 8)),
      double(random.Integer(-8, 8)) };
    const double tiny = std::pow(10.0, -random.Uniform(0.0, 300.0));
    const auto value = [&](int x, int y, int z)
    {
      switch (kind)
      {
        case 0: // a plane
          return g[0] * x + g[1] * y + g[2] * z - 0.5 * (g[0] + g[1] + g[2]);
        case 1: // bilinear, the same for all z
          return g[0] * x + g[1] * y + g[2] * x * y - 1.0;
        case 2: // corners equal in pairs
          return g[(x + y) % 2] * (z == 0 ? -1.0 : 1.0) + 0.5;
        default: // a cubic coefficient from 1 to 1e-300
          return g[0] * (x - 1) + g[1] * (y - 1) + g[2] * (z - 1) + tiny * (x * y * z);
      }
    };
    tally.Check(Sample(OneCell, value), 0.0, RandomLines(random, OneCell, 10));
  }
  tally.Report();
}

TEST(TestCells, Cancellation)
{
  RandomNumbers random(16);
  Tally small("values 1e6 + 1e-6 (Robust)");
  Tally large("values 1e15 + eighths (Robust)");
  for (int i = 0; i < 300; ++i)
  {
    const Index dimensions = { 4, 4, 4 };
    const Field near = RandomField(random, dimensions, 1e6 - 1e-6, 1e6 + 1e-6);
    const Field far =
      Sample(dimensions, [&random](int, int, int) { return 1e15 + random.Integer(-80, 80) / 8.0; });
    const auto lines = RandomLines(random, dimensions, 20);
    small.Check(near, 1e6 + random.Uniform(-5e-7, 5e-7), lines);
    large.Check(far, 1e15 + random.Integer(-40, 40) / 8.0, lines);
  }
  small.Report();
  large.Report();
}

TEST(TestCells, AllSignPatternsWithSaddles)
{
  // All sign patterns of the corners, the ambiguous ones of marching cubes among them.
  RandomNumbers random(17);
  Tally tally("all 254 sign patterns, saddles (Robust)");
  for (int pattern = 1; pattern < 255; ++pattern)
  {
    for (int i = 0; i < 8; ++i)
    {
      const Field field = Sample(OneCell,
        [&random, pattern](int x, int y, int z)
        {
          const double value = random.Uniform(0.01, 1.0);
          return (pattern >> (x + 2 * y + 4 * z) & 1) != 0 ? value : -value;
        });
      tally.Check(field, 0.0, RandomLines(random, OneCell, 20));
    }
  }
  tally.Report();
}

TEST(TestCells, MagnitudesFromDenormalToHuge)
{
  // Below 2^-1000 a denormal gradient has too few bits for an angle.
  for (const bool isDenormal : { false, true })
  {
    RandomNumbers random(18);
    const std::string name =
      isDenormal ? "magnitudes 2^-1060 to 2^-1010, denormal" : "magnitudes 2^-1000 to 2^1020";
    Tally tally(name + " (Robust)");
    for (int exponent = isDenormal ? -1060 : -1000; exponent <= (isDenormal ? -1010 : 1020);
         exponent += isDenormal ? 2 : 10)
    {
      for (int i = 0; i < 10; ++i)
      {
        Field field = RandomField(random, { 3, 3, 3 });
        for (double& value : field.Values)
        {
          value = std::ldexp(value, exponent);
        }
        const double isovalue = std::ldexp(random.Uniform(-0.5, 0.5), exponent);
        const auto lines = RandomLines(random, field.Dimensions, 10);
        tally.CheckNormals(!isDenormal);
        tally.Check(field, isovalue, lines);
      }
    }
    tally.Report();
  }
}

TEST(TestCells, DifferencesThatOverflow)
{
  // Values of both signs near the largest double: their differences overflow.
  RandomNumbers random(23);
  Tally tally("values +-1.7e308 (Robust)");
  for (int i = 0; i < 200; ++i)
  {
    const Field field = RandomField(random, { 3, 3, 3 }, -1.0, 1.0);
    Field huge = field;
    for (double& value : huge.Values)
    {
      value *= 1.7e308;
    }
    const auto lines = RandomLines(random, field.Dimensions, 10);
    tally.CheckNormals(false);
    tally.Check(huge, random.Uniform(-0.9, 0.9) * 1.7e308, lines);
  }
  tally.Report();
}

TEST(TestCells, AllMagnitudesInOneCell)
{
  RandomNumbers random(19);
  Tally tally("magnitudes 1e-120 to 1e120 in one cell (Robust)");
  for (int i = 0; i < 3000; ++i)
  {
    const Field field = Sample({ 3, 3, 3 },
      [&random](int, int, int)
      {
        const double magnitude = std::pow(10.0, random.Uniform(-120.0, 120.0));
        return random.Integer(0, 1) == 0 ? magnitude : -magnitude;
      });
    tally.Check(field, 0.0, RandomLines(random, field.Dimensions, 10));
  }
  tally.Report();
}

//------------------------------------------------------------------------------
// Termination

namespace
{

CellCorners RandomBits(RandomNumbers& random)
{
  CellCorners corners;
  for (double& value : corners)
  {
    value = random.AnyDouble();
  }
  return corners;
}

CellSegment RandomSegment(RandomNumbers& random)
{
  CellSegment segment{ 0.0, 1.0, vtkIsosurfaceRayTracing::Crossing::StartAxis,
    random.PointInBox({ 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 }),
    random.PointInBox({ 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 }) };
  segment.Entry[static_cast<std::size_t>(random.Integer(0, 2))] = random.Integer(0, 1);
  segment.Exit[static_cast<std::size_t>(random.Integer(0, 2))] = random.Integer(0, 1);
  return segment;
}

/// Counts roots, and those outside the segment.
struct RootCounter
{
  std::size_t Roots = 0;
  std::size_t Outside = 0;

  bool operator()(double u, bool)
  {
    ++this->Roots;
    this->Outside += u >= 0.0 && u <= 1.0 ? 0 : 1;
    return false;
  }
};

}

TEST(TestCells, AllSolversTerminateOnRandomBits)
{
  RandomNumbers random(20);
  const std::size_t cells = IsLongRun() ? 1000000000 : 1000000;
  RootCounter robust;
  RootCounter others;
  std::size_t finite = 0;
  for (std::size_t i = 0; i < cells; ++i)
  {
    const CellCorners corners = RandomBits(random);
    const CellSegment segment = RandomSegment(random);
    const auto count = [&robust](double u, bool entering) { return robust(u, entering); };
    const auto countOther = [&others](double u, bool entering) { return others(u, entering); };
    const std::size_t before = robust.Outside;
    Robust::ForEachRoot(corners, segment, count);
    const bool isFinite = std::all_of(
      corners.begin(), corners.end(), [](double value) { return std::isfinite(value); });
    finite += isFinite ? 1 : 0;
    // The traversal never passes cells that are not finite to a solver.
    robust.Outside = isFinite ? robust.Outside : before;
    Marmitt::ForEachRoot(corners, segment, 3, countOther);
    Analytic::ForEachRoot(corners, segment, countOther);
    Linear::ForEachRoot(corners, segment, countOther);
  }
  Tally tally("termination on random bits (Robust, Marmitt, Analytic, Linear)");
  tally.Count(cells, robust.Roots, 0, robust.Outside);
  tally.Note(std::to_string(finite) + " cells finite");
  tally.Report();
}
