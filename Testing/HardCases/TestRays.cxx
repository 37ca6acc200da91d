// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays in hard positions and directions.

#include "Tally.h"

#include "Math/Matrix.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace HardCases;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Smallest = std::numeric_limits<double>::denorm_min();

/// All 26 directions to neighbours in the lattice.
std::vector<Triple> LatticeDirections()
{
  std::vector<Triple> directions;
  for (int i = 0; i < 27; ++i)
  {
    if (i != 13)
    {
      directions.push_back({ i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0 });
    }
  }
  return directions;
}

/// The line that passes a point a number of units of t after its origin.
Line Towards(const Triple& point, const Triple& direction, double distance)
{
  return { { point[0] - distance * direction[0], point[1] - distance * direction[1],
             point[2] - distance * direction[2] },
    direction };
}

Triple Nudged(RandomNumbers& random, const Triple& v)
{
  Triple result = v;
  for (double& x : result)
  {
    x = std::nextafter(x, random.Integer(-1, 1) * Infinity);
  }
  return result;
}

}

TEST(TestRays, FarOrigins)
{
  for (const double cells : { 1.0, 1e3, 1e6, 1e9 })
  {
    RandomNumbers random(40);
    char name[64];
    std::snprintf(name, sizeof(name), "origin %g cells away", cells);
    Tally tally(std::string(name) + " (Robust)");
    for (int i = 0; i < 60; ++i)
    {
      const Field field = RandomField(random, { 7, 8, 9 });
      std::vector<Line> lines;
      for (int ray = 0; ray < 40; ++ray)
      {
        const Triple target = random.PointInVolume(field.Dimensions);
        lines.push_back(Towards(target, random.Direction(), cells));
      }
      const double isovalue = random.Uniform(-0.5, 0.5);
      tally.Check(field, isovalue, lines);
    }
    tally.Note("T within 4 roundings of its size besides");
    tally.Report();
  }
}

TEST(TestRays, LatticeDirections)
{
  RandomNumbers random(41);
  Tally exact("in faces, along edges, through vertices, 26 directions (Robust)");
  Tally nudged("the same, nudged by one rounding (Robust)");
  for (int i = 0; i < 40; ++i)
  {
    const Index dimensions = { 5, 6, 7 };
    const bool isInteger = i % 2 == 0;
    const Field field = Sample(dimensions,
      [&random, isInteger](int, int, int)
      { return isInteger ? random.Integer(-3, 3) : random.Uniform(-1.0, 1.0); });
    std::vector<Line> lines;
    std::vector<Line> nudgedLines;
    for (const Triple& direction : LatticeDirections())
    {
      for (int ray = 0; ray < 10; ++ray)
      {
        // Through a vertex, the middle of an edge, of a face, or of a cell; from inside or outside.
        const Triple point = { random.Integer(0, 8) / 2.0, random.Integer(0, 10) / 2.0,
          random.Integer(0, 12) / 2.0 };
        lines.push_back(Towards(point, direction, random.Integer(0, 1) * 16.0));
        // Nudged within the volume only: at its border one rounding decides whether a ray is in it.
        const Line line = Towards(
          { random.Integer(2, 6) / 2.0, random.Integer(2, 8) / 2.0, random.Integer(2, 10) / 2.0 },
          direction, 16.0);
        nudgedLines.push_back({ Nudged(random, line.Origin), Nudged(random, line.Direction) });
      }
    }
    const double isovalue = isInteger ? random.Integer(-1, 1) : random.Uniform(-0.5, 0.5);
    exact.Check(field, isovalue, lines);
    nudged.Check(field, isovalue, nudgedLines);
  }
  exact.Report();
  nudged.Report();
}

TEST(TestRays, AxisParallelWithSignedZerosAndDenormals)
{
  RandomNumbers random(42);
  Tally tally("axis-parallel, signed zeros, denormal components (Robust)");
  const double tiny[] = { 0.0, -0.0, Smallest, -Smallest, 1e-310, -1e-310, 1e-300, -1e-300 };
  for (int i = 0; i < 60; ++i)
  {
    const Index dimensions = { 4, 5, 6 };
    const Field field = RandomField(random, dimensions);
    std::vector<Line> lines;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (int ray = 0; ray < 40; ++ray)
      {
        Line line;
        for (std::size_t other = 0; other < 3; ++other)
        {
          // In a lattice plane, between, or a denormal beside a plane; never at the border, where a
          // denormal component leads out of the volume.
          const int inner = random.Integer(1, dimensions[other] - 2);
          const int kind = random.Integer(0, 2);
          line.Origin[other] = kind == 0 ? inner
            : kind == 1                  ? inner + random.Uniform(0.0, 1.0)
                                         : std::nextafter(inner, random.Integer(0, 1) * 100.0);
          line.Direction[other] = tiny[random.Integer(0, 7)];
        }
        const double way = random.Integer(0, 1) == 0 ? 1.0 : -1.0;
        line.Origin[axis] = way > 0 ? -3.0 : dimensions[axis] + 3.0;
        line.Direction[axis] = way;
        lines.push_back(line);
      }
    }
    tally.Check(field, random.Uniform(-0.5, 0.5), lines);
  }
  tally.Report();
}

TEST(TestRays, RaysInTheBoundaryOfTheVolume)
{
  // In the outermost faces and edges, which belong to the volume, with zeros of both signs.
  RandomNumbers random(43);
  Tally tally("in the outer faces and edges (Robust)");
  for (int i = 0; i < 60; ++i)
  {
    const Index dimensions = { 4, 5, 6 };
    const Field field = RandomField(random, dimensions);
    std::vector<Line> lines;
    for (int ray = 0; ray < 60; ++ray)
    {
      Line line = { random.PointInVolume(dimensions), random.Direction() };
      const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
      line.Origin[axis] = random.Integer(0, 1) == 0 ? -0.0 : dimensions[axis] - 1;
      line.Direction[axis] = random.Integer(0, 1) == 0 ? 0.0 : -0.0;
      const std::size_t other = (axis + 1) % 3;
      if (random.Integer(0, 1) == 0)
      {
        line.Origin[other] = random.Integer(0, 1) * (dimensions[other] - 1);
        line.Direction[other] = 0.0;
      }
      line.Begin = -Infinity;
      lines.push_back(line);
    }
    tally.Check(field, random.Uniform(-0.5, 0.5), lines);
  }
  tally.Report();
}

TEST(TestRays, DirectionsOfAnyLength)
{
  RandomNumbers random(44);
  Tally tally("direction of length 1e-290 to 1e290 (Robust)");
  for (int exponent = -290; exponent <= 290; exponent += 10)
  {
    const Field field = RandomField(random, { 5, 5, 5 });
    std::vector<Line> lines = RandomLines(random, field.Dimensions, 20);
    for (Line& line : lines)
    {
      for (double& d : line.Direction)
      {
        d *= std::pow(10.0, exponent);
      }
    }
    tally.Check(field, random.Uniform(-0.5, 0.5), lines);
  }
  tally.Report();
}

TEST(TestRays, AnisotropicSpacing)
{
  // In index space, directions of the world are compressed along one axis.
  RandomNumbers random(45);
  Tally tally("spacing 1:1e4 and 1e4:1 (Robust)");
  double largest = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    const Field field = RandomField(random, { 6, 6, 6 });
    const Triple spacing = { i % 2 == 0 ? 1.0 : 1e4, 1.0, i % 2 == 0 ? 1e4 : 1.0 };
    std::vector<Line> lines = RandomLines(random, field.Dimensions, 40);
    for (Line& line : lines)
    {
      const Triple target = random.PointInVolume(field.Dimensions);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        line.Direction[axis] /= spacing[axis];
        line.Origin[axis] = target[axis] - 20.0 * line.Direction[axis];
      }
    }
    const double isovalue = random.Uniform(-0.5, 0.5);
    tally.Check(field, isovalue, lines);

    // The normals in the world: the gradient divided by the spacing.
    Tracer tracer(field);
    const RayHits hits = tracer.Cast(lines, isovalue);
    const vtkIsosurfaceRayTracing::Matrix4 toWorld = { spacing[0], 0.0, 0.0, 0.0, 0.0, spacing[1],
      0.0, 0.0, 0.0, 0.0, spacing[2], 0.0, 0.0, 0.0, 0.0, 1.0 };
    for (const Hit& hit : hits.Hits)
    {
      const Triple gradient = tracer.GetField().GetGradient(
        hit, vtkIsosurfaceRayTracing::NormalMode::InterpolantGradient);
      const Triple normal = vtkIsosurfaceRayTracing::TransformDirection(
        vtkIsosurfaceRayTracing::NormalMatrix(toWorld), gradient);
      const Oracle::QuadTriple exact = { gradient[0] / Oracle::Quad(spacing[0]),
        gradient[1] / Oracle::Quad(spacing[1]), gradient[2] / Oracle::Quad(spacing[2]) };
      largest = std::max(largest, Oracle::AngleBetween(normal, exact));
    }
  }
  EXPECT_LE(largest, 1e-6);
  tally.Note("normals in the world within 1e-6");
  tally.Report();
}

TEST(TestRays, VolumeFarFromTheWorldOrigin)
{
  // World origin 1e6 and 1e9, spacing 1e-3: index space is reached by subtracting first. A double
  // at 1e9 stands 1.2e-7 from the next, which is 1.2e-4 cells: no arithmetic can do better.
  for (const double offset : { 1e6, 1e9 })
  {
    RandomNumbers random(46);
    const double spacing = 1e-3;
    char name[64];
    std::snprintf(name, sizeof(name), "world origin %g, spacing 1e-3 (Robust)", offset);
    Tally tally(name);
    double largest = 0.0;
    std::size_t lost = 0;
    for (int i = 0; i < 40; ++i)
    {
      const Field field = Ball({ 12, 12, 12 }, { 5.3, 5.6, 5.9 }, 4.2);
      const std::vector<Line> lines = RandomLines(random, field.Dimensions, 40, 1.0);
      std::vector<Line> rounded = lines;
      for (Line& line : rounded)
      {
        for (double& x : line.Origin)
        {
          const double world = offset + x * spacing;
          x = (world - offset) / spacing;
        }
      }
      tally.Check(field, 0.0, rounded);
      Tracer tracer(field);
      const RayHits a = tracer.Cast(lines, 0.0, RootSolver::Robust, Reach::First);
      const RayHits b = tracer.Cast(rounded, 0.0, RootSolver::Robust, Reach::First);
      for (std::size_t ray = 0; ray < lines.size(); ++ray)
      {
        const bool both = a.First[ray] != a.First[ray + 1] && b.First[ray] != b.First[ray + 1];
        const bool any = a.First[ray] != a.First[ray + 1] || b.First[ray] != b.First[ray + 1];
        lost += any && !both ? 1 : 0;
        largest = both
          ? std::max(largest, std::abs(a.Hits[a.First[ray]].T - b.Hits[b.First[ray]].T))
          : largest;
      }
    }
    std::snprintf(name, sizeof(name), "off the unshifted hit by %.1e cells at most", largest);
    tally.Note(name);
    tally.Note(std::to_string(lost) + " rays graze and differ");
    tally.Report();
    EXPECT_LE(largest, 1000.0 * offset * 0x1p-52 / spacing);
  }
}

TEST(TestRays, CameraInsideTheVolume)
{
  RandomNumbers random(47);
  Tally inside("origin inside a cell (Robust)");
  Tally vertex("origin on a vertex (Robust)");
  Tally surface("origin on the surface, and one rounding beside (Robust)");
  Tally clip("near clip moved through the surface (Robust)");
  for (int i = 0; i < 150; ++i)
  {
    const Field field = RandomField(random, { 5, 5, 5 });
    const double isovalue = random.Uniform(-0.5, 0.5);
    std::vector<Line> fromInside;
    std::vector<Line> fromVertex;
    std::vector<Line> fromSurface;
    std::vector<Line> clipped;
    Tracer tracer(field);
    for (int ray = 0; ray < 20; ++ray)
    {
      fromInside.push_back({ random.PointInVolume(field.Dimensions), random.Direction() });
      fromVertex.push_back({ { double(random.Integer(0, 4)), double(random.Integer(0, 4)),
                               double(random.Integer(0, 4)) },
        random.Direction() });
      const RayHits hits = tracer.Cast({ fromInside.back() }, isovalue);
      for (const Hit& hit : hits.Hits)
      {
        fromSurface.push_back({ tracer.GetField().GetPoint(hit), random.Direction() });
        fromSurface.push_back(
          { Nudged(random, tracer.GetField().GetPoint(hit)), random.Direction() });
        for (const double off : { -1e-6, -1e-12, 1e-12, 1e-6 })
        {
          clipped.push_back(fromInside.back());
          clipped.back().Begin = std::max(0.0, hit.T + off);
        }
      }
    }
    inside.Check(field, isovalue, fromInside);
    vertex.Check(field, isovalue, fromVertex);
    surface.Check(field, isovalue, fromSurface);
    clip.Check(field, isovalue, clipped);
  }
  inside.Report();
  vertex.Report();
  surface.Report();
  clip.Report();
}

TEST(TestRays, SecondaryRaysFromASurface)
{
  // Rays that start at a hit. The start on the surface may count for either side; so half of the
  // rays hit the surface they leave, where they start. The side they leave to decides which hits
  // are real: a first crossing to the side that the ray is on already is none. Nothing else is
  // needed, and no minimum distance.
  RandomNumbers random(48);
  Tally tally("secondary rays, side given (Robust)");
  std::size_t selfHits = 0;
  std::size_t rays = 0;
  std::size_t lost = 0;
  std::size_t falseHits = 0;
  std::size_t expected = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Field field = RandomField(random, { 5, 5, 5 });
    const double isovalue = random.Uniform(-0.5, 0.5);
    Tracer tracer(field);
    const auto primary = RandomLines(random, field.Dimensions, 20);
    const RayHits hits = tracer.Cast(primary, isovalue, RootSolver::Robust, Reach::First);
    for (const Hit& hit : hits.Hits)
    {
      const Line line = { tracer.GetField().GetPoint(hit), random.Direction() };
      // The side is that of the direction, unless it grazes.
      const auto slope =
        static_cast<double>(Oracle::SlopeAt(field, isovalue, line, tracer.GetCell(hit), 0));
      if (std::abs(slope) < 1e-6)
      {
        continue;
      }
      const bool isInside = slope > 0.0;
      const RayHits found = tracer.Cast({ line }, isovalue);
      // Exactly: the crossings behind the first that lie more than rounding from the start.
      std::vector<double> real;
      for (const Oracle::Piece& piece : Oracle::FindPieces(field, isovalue, line))
      {
        if ((piece.AtBegin >= 0) != (piece.AtEnd >= 0))
        {
          const auto t = static_cast<double>(Oracle::FindCrossing(field, isovalue, line, piece));
          if (t > 1e-8)
          {
            real.push_back(t);
          }
        }
      }
      std::size_t first = 0;
      if (!found.Hits.empty() && found.Hits[0].Entering == isInside)
      {
        ++selfHits;
        first = 1;
      }
      const std::size_t left = found.Hits.size() - first;
      lost += left < real.size() ? real.size() - left : 0;
      falseHits += left > real.size() ? left - real.size() : 0;
      expected += real.size();
      for (std::size_t k = 0; k < std::min(left, real.size()); ++k)
      {
        tally.AddError(std::abs(found.Hits[first + k].T - real[k]));
      }
      ++rays;
    }
  }
  tally.Expect(RobustGuarantee({ 5, 5, 5 }));
  tally.Count(rays, expected, lost, falseHits);
  tally.Note(
    std::to_string(selfHits) + " rays hit the surface they leave if their side is unknown");
  tally.Report();
}

TEST(TestRays, ErrorDoesNotGrowOver4096Cells)
{
  RandomNumbers random(49);
  Tally tally("4096 cells along (Robust)");
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    Index dimensions = { 3, 3, 3 };
    dimensions[axis] = 4097;
    const Field field = RandomField(random, dimensions);
    std::vector<Line> lines;
    for (int ray = 0; ray < 20; ++ray)
    {
      // From corner to corner, nearly.
      Line line;
      for (std::size_t other = 0; other < 3; ++other)
      {
        const double last = dimensions[other] - 1;
        line.Origin[other] = random.Uniform(0.0, 0.8);
        line.Direction[other] = (last - random.Uniform(0.0, 0.8) - line.Origin[other]) / 4096.0;
      }
      line.Begin = -100.0;
      lines.push_back(line);
    }
    tally.Check(field, 0.1, lines);
  }
  tally.Report();
}

TEST(TestRays, InvalidRaysHitNothing)
{
  RandomNumbers random(50);
  const Field field = RandomField(random, { 5, 5, 5 });
  Tracer tracer(field);
  const double bad[] = { Infinity, -Infinity, std::numeric_limits<double>::quiet_NaN() };
  std::vector<Line> lines = { { { 2.0, 2.0, -3.0 }, { 0.0, 0.0, 0.0 } },
    { { 2.0, 2.0, -3.0 }, { 0.0, -0.0, 0.0 } } };
  for (int i = 0; i < 1000; ++i)
  {
    Line line = RandomLine(random, field.Dimensions);
    const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
    (random.Integer(0, 1) == 0 ? line.Origin : line.Direction)[axis] = bad[i % 3];
    lines.push_back(line);
  }
  for (int i = 0; i < 1000; ++i)
  {
    Line line = RandomLine(random, field.Dimensions);
    (i % 2 == 0 ? line.Begin : line.End) = bad[2];
    lines.push_back(line);
  }
  const std::size_t hits = tracer.Cast(lines, 0.0).Hits.size();
  Tally tally("rays that are none: NaN, infinite, without direction (Robust)");
  tally.Count(lines.size(), hits, 0, hits);
  tally.Report();
}

TEST(TestRays, RandomBitsTerminate)
{
  RandomNumbers random(51);
  const std::size_t count = IsLongRun() ? 100000000 : 200000;
  const Field field = RandomField(random, { 9, 10, 11 });
  Tracer tracer(field);
  std::size_t hits = 0;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < count; i += 1000)
  {
    std::vector<Line> lines(1000);
    for (Line& line : lines)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        line.Origin[axis] =
          random.Integer(0, 3) == 0 ? random.AnyDouble() : random.Uniform(0.0, 9.0);
        line.Direction[axis] =
          random.Integer(0, 3) == 0 ? random.Uniform(-1.0, 1.0) : random.AnyDouble();
      }
      line.Begin = random.Integer(0, 3) == 0 ? random.AnyDouble() : -Infinity;
      line.End = random.Integer(0, 3) == 0 ? random.AnyDouble() : Infinity;
    }
    const RayHits found = tracer.Cast(lines, 0.1);
    hits += found.Hits.size();
    for (const Hit& hit : found.Hits)
    {
      const Triple& p = hit.Parametric;
      const bool isIn = *std::min_element(p.begin(), p.end()) >= 0.0 &&
        *std::max_element(p.begin(), p.end()) <= 1.0 && std::isfinite(hit.T);
      outside += isIn ? 0 : 1;
    }
  }
  Tally tally("rays of random bits end (Robust)");
  tally.Count(count, hits, 0, outside);
  tally.Report();
}
