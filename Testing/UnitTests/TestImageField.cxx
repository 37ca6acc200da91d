// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The hits of rays with the isosurfaces of whole volumes are compared with those found without any
// traversal, in every cell and in higher precision; and rays must not slip through closed surfaces.

#include "ExactRoots.h"
#include "Image/ImageField.h"
#include "Noise.h"
#include "RandomNumbers.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

std::vector<double> Noise(std::uint64_t seed, std::size_t count, double low, double high)
{
  RandomNumbers random(seed);
  std::vector<double> noise(count);
  for (double& value : noise)
  {
    value = random.Uniform(low, high);
  }
  return noise;
}

//------------------------------------------------------------------------------
/// A hit as it should be.
struct ExactHit
{
  double T;
  /// How far rounding may move it: a lot where the ray is nearly tangent to the surface.
  double Slack;
};

using QuadPoint = std::array<Quad, 3>;

/// The part of a line within a cell, with both ends in the cell's own coordinates.
struct ExactSegment
{
  Quad Begin = 0;
  Quad End = 1e300;
  QuadPoint Entry;
  QuadPoint Exit;
};

/// Finds the part of a line within a cell. Where it crosses a face its coordinate is exactly 0
/// or 1.
bool FindExactSegment(
  const Line& line, const Index3& cell, const Index3& dimensions, ExactSegment& s)
{
  Quad in[3];
  Quad out[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Quad d = line.Direction[axis];
    if (d == 0)
    {
      if (cell[axis] !=
        std::min(static_cast<int>(std::floor(line.Origin[axis])), dimensions[axis] - 2))
      {
        return false;
      }
      in[axis] = -1;
      out[axis] = 1e300;
      continue;
    }
    in[axis] = (cell[axis] + (d > 0 ? 0 : 1) - Quad(line.Origin[axis])) / d;
    out[axis] = (cell[axis] + (d > 0 ? 1 : 0) - Quad(line.Origin[axis])) / d;
    s.Begin = std::max(s.Begin, in[axis]);
    s.End = std::min(s.End, out[axis]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Quad d = line.Direction[axis];
    const Quad origin = Quad(line.Origin[axis]) - cell[axis];
    s.Entry[axis] = in[axis] == s.Begin ? Quad(d > 0 ? 0 : 1) : origin + s.Begin * d;
    s.Exit[axis] = out[axis] == s.End ? Quad(d > 0 ? 1 : 0) : origin + s.End * d;
  }
  return s.Begin < s.End;
}

/// The trilinear interpolant as it is defined.
Quad InterpolateExactly(const std::array<Quad, 8>& corners, const QuadPoint& p)
{
  Quad sum = 0;
  for (std::size_t i = 0; i < 8; ++i)
  {
    sum += (i & 1 ? p[0] : 1 - p[0]) * (i >> 1 & 1 ? p[1] : 1 - p[1]) * (i >> 2 ? p[2] : 1 - p[2]) *
      corners[i];
  }
  return sum;
}

template <typename T>
void FindExactHitsInCell(const TestVolume<T>& volume, const Line& line, const Index3& cell,
  double isovalue, std::vector<ExactHit>& hits)
{
  ExactSegment segment;
  if (!FindExactSegment(line, cell, volume.Dimensions, segment))
  {
    return;
  }
  std::array<Quad, 8> differences;
  double size = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    const auto value = static_cast<double>(
      volume.At({ cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2) }));
    if (!std::isfinite(value))
    {
      return;
    }
    differences[static_cast<std::size_t>(i)] = Quad(value) - isovalue;
    size = std::max(size, std::abs(value - isovalue));
  }
  const auto evaluate = [&](Quad u)
  {
    QuadPoint p;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      p[axis] = (1 - u) * segment.Entry[axis] + u * segment.Exit[axis];
    }
    return InterpolateExactly(differences, p);
  };
  const Quad f[4] = { evaluate(0), evaluate(Quad(1) / 3), evaluate(Quad(2) / 3), evaluate(1) };
  std::vector<Quad> roots;
  FindSignChanges({ f[0], (-5 * f[0] + 18 * f[1] - 9 * f[2] + 2 * f[3]) / 6,
                    (2 * f[0] - 9 * f[1] + 18 * f[2] - 5 * f[3]) / 6, f[3] },
    0, 1, roots);
  const Quad length = segment.End - segment.Begin;
  for (const Quad u : roots)
  {
    const Quad h = 1e-9;
    const double slope =
      std::abs(static_cast<double>((evaluate(u + h) - evaluate(u - h)) / (2 * h * length)));
    const double t = static_cast<double>(segment.Begin + length * u);
    hits.push_back(
      { t, 1e-13 + 1e-15 * t + 1e-10 * static_cast<double>(length) + 4e-15 * size / slope });
  }
}

/// Whether a line passes near a cell: to spare the exact arithmetic where there is nothing.
bool PassesNear(const Line& line, const Index3& cell)
{
  double begin = -Infinity;
  double end = Infinity;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = (cell[axis] - 1e-3 - line.Origin[axis]) / line.Direction[axis];
    const double high = (cell[axis] + 1.001 - line.Origin[axis]) / line.Direction[axis];
    begin = std::max(begin, std::min(low, high)); // a NaN comes second, and is passed over
    end = std::min(end, std::max(low, high));
  }
  return begin <= end + 1e-6;
}

template <typename T>
std::vector<ExactHit> FindExactHits(const TestVolume<T>& volume, const Line& line, double isovalue)
{
  std::vector<ExactHit> hits;
  ForEachPlace({ volume.Dimensions[0] - 1, volume.Dimensions[1] - 1, volume.Dimensions[2] - 1 },
    [&](const Index3& cell)
    {
      if (PassesNear(line, cell))
      {
        FindExactHitsInCell(volume, line, cell, isovalue, hits);
      }
    });
  std::sort(
    hits.begin(), hits.end(), [](const ExactHit& a, const ExactHit& b) { return a.T < b.T; });
  return hits;
}

/// Removes pairs of hits so close that rounding may create or remove them.
template <typename AnyHit>
std::vector<AnyHit> WithoutClosePairs(const std::vector<AnyHit>& hits)
{
  std::vector<AnyHit> kept;
  for (const AnyHit& hit : hits)
  {
    if (!kept.empty() && hit.T - kept.back().T < 1e-6)
    {
      kept.pop_back();
    }
    else
    {
      kept.push_back(hit);
    }
  }
  return kept;
}

/// Compares what is traced with what is exact, and counts.
class HitChecks
{
public:
  explicit HitChecks(std::string what)
    : What(std::move(what))
  {
  }

  ~HitChecks()
  {
    std::cout << "[ tried    ] " << this->What << ": " << this->Lines << " rays, " << this->Hits
              << " hits, " << this->Ambiguous << " rays all but touch; largest error "
              << this->LargestError << " cells\n";
  }

  HitChecks(const HitChecks&) = delete;
  HitChecks& operator=(const HitChecks&) = delete;

  template <typename T>
  void Check(const TestVolume<T>& volume, ImageField& traced, const Line& line, double isovalue)
  {
    ++this->Lines;
    const std::vector<Hit> hits = Trace(traced, line);
    const std::vector<ExactHit> exact = FindExactHits(volume, line, isovalue);
    if (hits.size() != exact.size())
    {
      ++this->Ambiguous;
      ASSERT_EQ(WithoutClosePairs(hits).size(), WithoutClosePairs(exact).size())
        << this->What << ": " << ToText(line);
      return;
    }
    const double speed = Length(line.Direction);
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      ++this->Hits;
      const double error = std::abs(hits[i].T - exact[i].T);
      ASSERT_LE(error, exact[i].Slack) << this->What << ": " << ToText(line);
      const Vector3 off =
        traced.GetPointInCells(hits[i]) - (line.Origin + line.Direction * exact[i].T);
      ASSERT_LE(Length(off), exact[i].Slack * (1.0 + speed)) << this->What << ": " << ToText(line);
      if (exact[i].Slack < 1e-9)
      {
        this->LargestError = std::max(this->LargestError, error * speed);
      }
    }
  }

  std::size_t GetNumberOfHits() const { return this->Hits; }
  std::size_t GetNumberAmbiguous() const { return this->Ambiguous; }

private:
  std::string What;
  std::size_t Lines = 0;
  std::size_t Hits = 0;
  std::size_t Ambiguous = 0;
  double LargestError = 0.0;
};

template <typename T>
void CheckRandomLines(const std::string& what, const TestVolume<T>& volume, double isovalue,
  std::uint64_t seed, std::size_t fewestHits)
{
  RandomNumbers random(seed);
  const auto traced = NewTraced(volume, { { isovalue, Glass } });
  HitChecks checks(what);
  for (int i = 0; i < 700; ++i)
  {
    ASSERT_NO_FATAL_FAILURE(
      checks.Check(volume, *traced, RandomLine(random, volume.Dimensions), isovalue));
  }
  EXPECT_GT(checks.GetNumberOfHits(), fewestHits);
  EXPECT_LT(checks.GetNumberAmbiguous(), 3U);
}

const AnalyticFields::Sphere Ball = { { 8.1, 7.7, 8.4 }, 6.3 };
const AnalyticFields::Gyroid Tunnels = { 7.3 };
const AnalyticFields::Plane Slope = { { 0.3, -0.7, 0.45 }, 0.9 };

//------------------------------------------------------------------------------
TEST(ImageField, FindsTheHitsOfEveryCell)
{
  const Index3 size = { 18, 16, 17 };
  CheckRandomLines("sphere", TestVolume<float>::Of(size, Ball), 0.0, 301, 500);
  CheckRandomLines("plane", TestVolume<double>::Of(size, Slope), 0.0, 302, 200);
  CheckRandomLines("gyroid", TestVolume<float>::Of(size, Tunnels), 0.1, 303, 1000);
  const auto scaled = [](const AnalyticFields::Point& p) { return 100.0 + 40.0 * Tunnels(p); };
  CheckRandomLines(
    "gyroid in bytes, isovalue 100", TestVolume<std::uint8_t>::Of(size, scaled), 100.0, 304, 1000);
  CheckRandomLines(
    "noise", TestVolume<double>(size, Noise(305, Count(size), -1.0, 1.0)), 0.0, 305, 2000);
  CheckRandomLines("noise of bytes 0 to 4, isovalue 2",
    ClosedNoise<std::uint8_t>(size, 306, 0, 4, 0), 2.0, 306, 2000);
  CheckRandomLines("noise of two values, isovalue the larger",
    ClosedNoise<std::int16_t>(size, 307, -1, 0, -1), 0.0, 307, 1000);
}

//------------------------------------------------------------------------------
TEST(ImageField, FindsAPlane)
{
  const auto volume = TestVolume<double>::Of({ 20, 21, 22 }, Slope);
  const auto traced = NewTraced(volume, { { 0.0, 1.0 } });
  RandomNumbers random(310);
  std::size_t hits = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Line line = RandomLine(random, volume.Dimensions);
    for (const Hit& hit : Trace(*traced, line))
    {
      ++hits;
      const Vector3 point = traced->GetPointInCells(hit);
      const double slope =
        Dot(line.Direction, { Slope.Normal[0], Slope.Normal[1], Slope.Normal[2] });
      ASSERT_NEAR(Slope(point), 0.0, 1e-13) << ToText(line);
      ASSERT_EQ(hit.Entering, slope > 0.0) << ToText(line);
      ASSERT_NEAR(hit.T, -Slope(line.Origin) / slope, 1e-13 / std::abs(slope)) << ToText(line);
    }
  }
  std::cout << "[ tried    ] 20000 rays, " << hits << " hits\n";
  EXPECT_GT(hits, 5000U);
}

//------------------------------------------------------------------------------
TEST(ImageField, IdenticalHitsWithAllSettings)
{
  const Index3 size = { 25, 19, 33 };
  const auto volume = TestVolume<float>::Of(size, Tunnels);
  const std::vector<Isosurface> surfaces = { { -0.2, 0.6 }, { 0.0, Glass }, { 0.3, 0.2 } };
  ImageSettings plain;
  plain.MacrocellBranching = {};
  plain.Layout = BrickLayout::Unbricked;
  const auto reference = NewTraced(volume, surfaces, plain);
  std::vector<std::unique_ptr<ImageField>> others;
  for (const BrickLayout layout :
    { BrickLayout::Unbricked, BrickLayout::Apron, BrickLayout::TwoLevel })
  {
    for (const std::vector<int>& branching :
      { std::vector<int>{}, { 8, 8 }, { 2, 3, 5 }, { 64 }, { 1 } })
    {
      for (const int brickSize : { 1, 2, 3, 5, 8, 64 })
      {
        others.push_back(
          NewTraced(volume, surfaces, { branching, layout, brickSize, brickSize % 4 + 1 }));
      }
    }
  }
  RandomNumbers random(311);
  std::size_t hits = 0;
  for (int i = 0; i < 1500; ++i)
  {
    const Line line = i % 3 == 0 ? LatticeLine(random, size) : RandomLine(random, size);
    const std::vector<Hit> expected = Trace(*reference, line);
    hits += expected.size();
    for (const auto& other : others)
    {
      ASSERT_TRUE(AreSame(Trace(*other, line), expected)) << ToText(line);
    }
  }
  std::cout << "[ tried    ] 1500 rays with " << others.size() << " settings, " << hits
            << " hits each\n";
  EXPECT_GT(hits, 3000U);
}

//------------------------------------------------------------------------------
/// Traces many lines, all of which begin inside a closed surface and leave the volume, on all
/// threads. Returns how many leak: hit the surface an even number of times, or without alternating.
template <typename NewLine>
std::size_t CountLeaks(ImageField& volume, int lines, std::uint64_t seed, const NewLine& newLine)
{
  std::size_t leaks = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : leaks)
  for (int chunk = 0; chunk < lines / 1000; ++chunk)
  {
    RandomNumbers random(seed + 1000 * static_cast<std::uint64_t>(chunk));
    for (int i = 0; i < 1000; ++i)
    {
      const std::vector<Hit> hits = Trace(volume, newLine(random));
      bool inside = true;
      double t = 0.0;
      bool good = hits.size() % 2 == 1;
      for (const Hit& hit : hits)
      {
        good = good && hit.Entering != inside && hit.T >= t;
        inside = hit.Entering;
        t = hit.T;
      }
      leaks += good ? 0 : 1;
    }
  }
  return leaks;
}

Line FromNear(RandomNumbers& random, const Vector3& point, double distance)
{
  const Vector3 off = { distance, distance, distance };
  const Vector3 origin = random.PointInBox(point - off, point + off);
  return { origin, random.Direction() };
}

//------------------------------------------------------------------------------
TEST(ImageField, NoRayLeaksThroughAClosedSurface)
{
  const Index3 size = { 33, 33, 33 };
  const Vector3 center = { 16.2, 15.9, 16.1 };
  const AnalyticFields::Sphere ball = { center, 12.0 };
  const auto smooth = TestVolume<float>::Of(size, ball);
  EXPECT_EQ(CountLeaks(*NewTraced(smooth, { { 0.0, Glass } }), 200000, 320,
              [&](RandomNumbers& random) { return FromNear(random, center, 5.0); }),
    0U);
  const auto bytes = TestVolume<std::uint8_t>::Of(
    size, [&](const AnalyticFields::Point& p) { return 100.0 + 2.0 * ball(p); });
  for (const double isovalue : { 100.0, 99.5, 100.0 + 1e-7, 101.0 })
  {
    EXPECT_EQ(CountLeaks(*NewTraced(bytes, { { isovalue, Glass } }), 50000, 321,
                [&](RandomNumbers& random) { return FromNear(random, center, 5.0); }),
      0U);
  }
}

//------------------------------------------------------------------------------
TEST(ImageField, NoRayLeaksThroughASurfaceNearFacesOfCells)
{
  const Index3 size = { 17, 17, 17 };
  const Vector3 center = { 8.0, 8.0, 8.0 };
  for (const double off : { 0.0, 1e-7, -1e-7, 1e-12, -1e-12, 1e-15, -1e-15 })
  {
    const auto box = TestVolume<double>::Of(size, AnalyticFields::Box{ center, 5.0 + off });
    EXPECT_EQ(CountLeaks(*NewTraced(box, { { 0.0, Glass } }), 60000, 322,
                [&](RandomNumbers& random) { return FromNear(random, center, 3.0); }),
      0U)
      << off;
  }
}

//------------------------------------------------------------------------------
TEST(ImageField, NoRayLeaksThroughClosedNoise)
{
  const Index3 size = { 13, 14, 15 };
  const Index3 index = { 6, 7, 7 };
  const Vector3 start = { 6.0, 7.0, 7.0 };
  auto noise = ClosedNoise<std::int16_t>(size, 323, -2, 2, -2);
  noise.At(index) = 1;
  EXPECT_EQ(CountLeaks(*NewTraced(noise, { { 0.0, Glass } }), 200000, 324,
              [&](RandomNumbers& random) {
                return Line{ start, random.Direction() };
              }),
    0U);
  auto fine = ClosedNoise<float>(size, 325, -8000000, 8000000, -8000000);
  fine.At(index) = 1.0F;
  EXPECT_EQ(CountLeaks(*NewTraced(fine, { { 0.0, Glass } }), 100000, 326,
              [&](RandomNumbers& random) {
                return Line{ start, random.Direction() };
              }),
    0U);
}

//------------------------------------------------------------------------------
// Samples of all magnitudes side by side: products of differences vanish, and sums overflow.
TEST(ImageField, NoRayLeaksThroughClosedNoiseOfAllMagnitudes)
{
  const Index3 size = { 13, 14, 15 };
  const Vector3 start = { 6.0, 7.0, 7.0 };
  const double denormal = std::numeric_limits<double>::denorm_min();
  const double largest = std::numeric_limits<double>::max();
  RandomNumbers random(346);
  TestVolume<double> smallest(size, std::vector<double>(Count(size), -denormal));
  TestVolume<double> all(size, std::vector<double>(Count(size), -largest));
  ForEachPlace({ size[0] - 2, size[1] - 2, size[2] - 2 },
    [&](const Index3& i)
    {
      const Index3 index = { i[0] + 1, i[1] + 1, i[2] + 1 };
      smallest.At(index) = random.Integer(-2, 2) * denormal;
      all.At(index) = random.Integer(0, 9) ? random.WideMagnitude(-324.0, 308.0) : largest;
    });
  smallest.At({ 6, 7, 7 }) = denormal;
  all.At({ 6, 7, 7 }) = 1e300;
  const auto newLine = [&](RandomNumbers& numbers) { return Line{ start, numbers.Direction() }; };
  for (const double isovalue : { 0.0, denormal })
  {
    EXPECT_EQ(CountLeaks(*NewTraced(smallest, { { isovalue, Glass } }), 30000, 347, newLine), 0U);
  }
  for (const double isovalue : { 0.0, denormal, 1e-200, 1.0, 1e300, -1e307, -largest / 4.0 })
  {
    EXPECT_EQ(CountLeaks(*NewTraced(all, { { isovalue, Glass } }), 30000, 348, newLine), 0U)
      << isovalue;
  }
}

//------------------------------------------------------------------------------
TEST(ImageField, NoRayLeaksThroughVerticesAndEdges)
{
  const Index3 size = { 13, 14, 15 };
  auto noise = ClosedNoise<std::int8_t>(size, 327, -2, 2, -2);
  std::vector<Vector3> starts;
  ForEachPlace(size,
    [&](const Index3& i)
    {
      if (noise.At(i) >= 0)
      {
        starts.push_back({ i[0] + 0.0, i[1] + 0.0, i[2] + 0.0 });
      }
    });
  const auto toVertex = [&](RandomNumbers& random)
  {
    const Vector3& from = starts[random.Bits() % starts.size()];
    Vector3 to = from;
    while (to == from)
    {
      to = { random.Integer(0, size[0] - 1) + 0.0, random.Integer(0, size[1] - 1) + 0.0,
        random.Integer(0, size[2] - 1) + 0.5 * random.Integer(0, 1) };
    }
    return Line{ from, (to - from) * (random.Integer(0, 1) ? 1.0 : random.Uniform(0.1, 1.0)) };
  };
  EXPECT_EQ(CountLeaks(*NewTraced(noise, { { 0.0, Glass } }), 200000, 328, toVertex), 0U);
  const auto nearlyAligned = [&](RandomNumbers& random)
  {
    const Vector3& from = starts[random.Bits() % starts.size()];
    Vector3 direction = { random.WideMagnitude(-320.0, -10.0), random.WideMagnitude(-320.0, -10.0),
      random.WideMagnitude(-320.0, -10.0) };
    direction[random.Bits() % 3] = random.Integer(0, 1) ? 1.0 : -1.0;
    return Line{ from, direction };
  };
  EXPECT_EQ(CountLeaks(*NewTraced(noise, { { 0.0, Glass } }), 100000, 329, nearlyAligned), 0U);
}

//------------------------------------------------------------------------------
TEST(ImageField, EntriesAndExitsAlternate)
{
  const Index3 size = { 15, 14, 13 };
  const auto noise = ClosedNoise<std::uint8_t>(size, 330, 0, 9, 0);
  const auto traced = NewTraced(noise, { { 5.0, Glass } });
  RandomNumbers random(331);
  std::size_t hits = 0;
  for (int i = 0; i < 50000; ++i)
  {
    Line line = i % 2 == 0 ? LatticeLine(random, size) : RandomLine(random, size);
    line.Origin = line.Origin - line.Direction * 100.0; // outside, so the first hit is an entry
    bool inside = false;
    double t = 0.0;
    for (const Hit& hit : Trace(*traced, line))
    {
      ASSERT_EQ(hit.Entering, !inside) << ToText(line);
      ASSERT_GE(hit.T, t) << ToText(line);
      inside = hit.Entering;
      t = hit.T;
      ++hits;
    }
    ASSERT_FALSE(inside) << ToText(line);
  }
  std::cout << "[ tried    ] 50000 rays, " << hits << " hits\n";
  EXPECT_GT(hits, 100000U);
}

//------------------------------------------------------------------------------
// A cell whose values along its diagonal rise above 5 by so little that the entry and the exit have
// the same t on a ray that comes from far away.
TEST(ImageField, EntryPrecedesExitAtEqualT)
{
  for (const double isovalue : { 5.0, -5.0 })
  {
    for (const double sign : { 1.0, -1.0 })
    {
      // 4 u (1 - u) along the diagonal of the face z = 0.
      const double top = isovalue + sign * 1e-16 * 16.0;
      TestVolume<double> volume({ 2, 2, 2 }, std::vector<double>(8, top - sign));
      for (const Index3& i : { Index3{ 1, 0, 0 }, { 0, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 } })
      {
        volume.At(i) = top + sign;
      }
      const auto traced = NewTraced(volume, { { isovalue, Glass } });
      for (const double distance : { 1.0, 1e9 })
      {
        const std::vector<Hit> hits =
          Trace(*traced, { { -distance, -distance, 0.5 }, { 1.0, 1.0, 0.0 } });
        ASSERT_EQ(hits.size(), 2U);
        EXPECT_EQ(hits[0].Entering, sign > 0.0) << isovalue << " from " << distance;
        EXPECT_EQ(hits[1].Entering, sign < 0.0) << isovalue << " from " << distance;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(ImageField, SurfacesInTheOrderOfTheRay)
{
  const auto volume = TestVolume<float>::Of(
    { 9, 9, 9 }, [](const AnalyticFields::Point& p) { return p[0] + 0.1 * p[1]; });
  const std::vector<Isosurface> surfaces = { { 1.5, 0.1 }, { 4.25, 0.1 }, { 4.5, 0.1 },
    { std::nextafter(4.5, 5.0), 0.1 }, { 7.0, 0.1 } };
  const auto traced = NewTraced(volume, surfaces);
  const auto surfacesMet = [&](const Line& line)
  {
    std::vector<int> met;
    for (const Hit& hit : Trace(*traced, line))
    {
      met.push_back(hit.Surface);
    }
    return met;
  };
  EXPECT_EQ(
    surfacesMet({ { -1.0, 0.1, 0.1 }, { 1.0, 0.0, 0.0 } }), (std::vector<int>{ 0, 1, 2, 3, 4 }));
  EXPECT_EQ(
    surfacesMet({ { 11.0, 0.1, 0.1 }, { -1.0, 0.0, 0.0 } }), (std::vector<int>{ 4, 3, 2, 1, 0 }));
  // From far away 4.25 and 4.5 have the same t.
  EXPECT_EQ(
    surfacesMet({ { -1e17, 0.1, 0.1 }, { 1.0, 0.0, 0.0 } }), (std::vector<int>{ 0, 1, 2, 3, 4 }));
  EXPECT_EQ(
    surfacesMet({ { 1e17, 0.1, 0.1 }, { -1.0, 0.0, 0.0 } }), (std::vector<int>{ 4, 3, 2, 1, 0 }));
}

//------------------------------------------------------------------------------
// The values differ so little, and the field is so steep, that no number lies between the hits.
TEST(ImageField, CoincidentSurfacesInTheOrderOfTheirValues)
{
  const auto volume = TestVolume<double>::Of(
    { 4, 3, 3 }, [](const AnalyticFields::Point& p) { return 0x1p30 * (p[0] - 1.5); });
  const double next = std::nextafter(1.0, 2.0);
  const auto traced =
    NewTraced(volume, { { 1.0, Glass }, { next, Glass }, { std::nextafter(next, 2.0), Glass } });
  const std::vector<Hit> entering = Trace(*traced, { { -1.0, 1.1, 1.2 }, { 1.0, 0.0, 0.0 } });
  ASSERT_EQ(entering.size(), 3U);
  EXPECT_EQ(entering[0].T, entering[2].T);
  EXPECT_TRUE(entering[0].Surface == 0 && entering[1].Surface == 1 && entering[2].Surface == 2);
  const std::vector<Hit> falling = Trace(*traced, { { 5.0, 1.1, 1.2 }, { -1.0, 0.0, 0.0 } });
  ASSERT_EQ(falling.size(), 3U);
  EXPECT_EQ(falling[0].T, falling[2].T);
  EXPECT_TRUE(falling[0].Surface == 2 && falling[1].Surface == 1 && falling[2].Surface == 0);
}

//------------------------------------------------------------------------------
TEST(ImageField, SeveralSurfacesMatchSingleOnes)
{
  const Index3 size = { 15, 14, 13 };
  const auto volume = TestVolume<float>::Of(size, Tunnels);
  const std::vector<Isosurface> surfaces = { { -0.5, Glass }, { 0.0, Glass }, { 0.5, Glass },
    { 0.51, Glass } };
  const auto all = NewTraced(volume, surfaces);
  std::vector<std::unique_ptr<ImageField>> each;
  for (const Isosurface& surface : surfaces)
  {
    each.push_back(NewTraced(volume, { surface }));
  }
  RandomNumbers random(333);
  std::size_t hits = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const Line line = i % 4 == 0 ? LatticeLine(random, size) : RandomLine(random, size);
    const std::vector<Hit> together = Trace(*all, line);
    hits += together.size();
    ASSERT_TRUE(std::is_sorted(
      together.begin(), together.end(), [](const Hit& a, const Hit& b) { return a.T < b.T; }))
      << ToText(line);
    for (std::size_t k = 0; k < each.size(); ++k)
    {
      std::vector<Hit> alone = Trace(*each[k], line);
      for (Hit& hit : alone)
      {
        hit.Surface = static_cast<int>(k);
      }
      std::vector<Hit> ofSurface;
      std::copy_if(together.begin(), together.end(), std::back_inserter(ofSurface),
        [k](const Hit& hit) { return hit.Surface == static_cast<int>(k); });
      ASSERT_TRUE(AreSame(alone, ofSurface)) << ToText(line);
    }
  }
  std::cout << "[ tried    ] 5000 rays, " << hits << " hits\n";
  EXPECT_GT(hits, 10000U);
}

//------------------------------------------------------------------------------
TEST(ImageField, StopsWhereTheRayIsOpaque)
{
  const auto volume =
    TestVolume<std::int16_t>::Of({ 9, 3, 3 }, [](const AnalyticFields::Point& p) { return p[0]; });
  const Line line = { { -1.0, 1.2, 1.3 }, { 1.0, 0.0, 0.0 } };
  const auto numberOfHits = [&](std::vector<Isosurface> surfaces)
  { return Trace(*NewTraced(volume, surfaces), line).size(); };
  EXPECT_EQ(numberOfHits({ { 1.5, 0.5 }, { 3.5, 1.0 }, { 5.5, 0.5 } }), 2U);
  EXPECT_EQ(numberOfHits({ { 3.2, 0.5 }, { 3.4, 1.0 }, { 3.6, 1.0 } }), 2U); // all in one cell
  EXPECT_EQ(numberOfHits({ { 1.5, 0.999 }, { 3.5, 0.5 }, { 5.5, 0.5 } }), 2U);
  EXPECT_EQ(numberOfHits({ { 1.5, 0.9 }, { 3.5, 0.9 }, { 5.5, 0.9 }, { 6.5, 0.9 } }), 4U);
  EXPECT_EQ(numberOfHits({ { 1.5, 0.97 }, { 3.5, 0.97 }, { 5.5, 0.9 } }), 2U);
  EXPECT_EQ(numberOfHits({ { 8.0, 1.0 } }), 1U);
  EXPECT_EQ(numberOfHits({ { 0.0, 1.0 } }), 0U); // all is inside
  EXPECT_EQ(numberOfHits({ { -Infinity, 1.0 }, { Infinity, 1.0 } }), 0U);
  EXPECT_EQ(numberOfHits({ { std::nan(""), 1.0 } }), 0U);
  EXPECT_EQ(numberOfHits({}), 0U);
}

//------------------------------------------------------------------------------
TEST(ImageField, HitsAreStoredByRay)
{
  const auto volume = TestVolume<float>::Of({ 9, 9, 9 }, Slope);
  const auto traced = NewTraced(volume, { { 0.0, 1.0 } });
  const auto ray = ClipToVolume({ 4.0, 9.0, 4.0 }, { 0.0, -1.0, 0.0 }, 0.0, Infinity, { 9, 9, 9 });
  const auto miss = ClipToVolume({ 4.0, 9.0, 4.0 }, { 0.0, -1.0, 0.0 }, 0.0, 1.5, { 9, 9, 9 });
  ASSERT_TRUE(ray);
  RayHits hits;
  for (int repeat = 0; repeat < 2; ++repeat)
  {
    Trace(*traced, { ray, std::nullopt, miss, ray }, hits);
    ASSERT_EQ(hits.First, (std::vector<std::size_t>{ 0, 1, 1, 1, 2 }));
    EXPECT_TRUE(AreSame(hits.Hits[0], hits.Hits[1]));
  }
  Trace(*traced, {}, hits);
  EXPECT_EQ(hits.First, (std::vector<std::size_t>{ 0 }));
}

//------------------------------------------------------------------------------
TEST(ImageField, SelectReplacesTheSurfaces)
{
  const Index3 size = { 17, 16, 15 };
  const auto volume = TestVolume<float>::Of(size, Tunnels);
  const ImageSettings settings = { { 2, 2 }, BrickLayout::Apron, 8, 4 };
  const auto traced = NewTraced(volume, TestRequest(), settings);
  RandomNumbers random(334);
  std::vector<Line> lines;
  for (int i = 0; i < 200; ++i)
  {
    lines.push_back(RandomLine(random, size));
  }
  const std::vector<std::vector<Isosurface>> selections = { { { 0.0, 1.0 } }, { { 0.0, Glass } },
    { { 1.3, Glass } }, { { -1.2, Glass } }, { { 0.0, Glass }, { 0.7, Glass } },
    { { -1.2, Glass }, { 1.3, Glass } }, {}, { { -1.2, Glass } } };
  for (const std::vector<Isosurface>& surfaces : selections)
  {
    Select(*traced, { surfaces }, 1);
    const auto fresh = NewTraced(volume, surfaces, settings);
    for (const Line& line : lines)
    {
      ASSERT_TRUE(AreSame(Trace(*traced, line), Trace(*fresh, line))) << ToText(line);
    }
  }
}

//------------------------------------------------------------------------------
/// Of a field whose samples have been read in part, rays hit what they hit of the whole in
/// macrocells that are read; the end is the whole, to the last bit.
TEST(ImageField, SamplesAreReadSlabBySlab)
{
  const Index3 dimensions = { 100, 90, 500 }; // 36 MB
  const auto volume = TestVolume<double>::Of(dimensions,
    [](const Vector3& p) { return std::sin(0.3 * p[0]) + std::cos(0.2 * p[1] + 0.05 * p[2]); });
  const TestRequest request({ { 0.3, Glass }, { -0.8, Glass } });
  const auto whole = NewTraced(volume, request);
  RandomNumbers random(32);
  std::vector<Line> lines;
  std::vector<std::vector<Hit>> all;
  for (int i = 0; i < 1000; ++i)
  {
    lines.push_back(RandomLine(random, dimensions));
    all.push_back(Trace(*whole, lines.back()));
  }
  const Index3 macrocells = { 13, 12, 63 };
  const auto field = ImageField::NewUnread(volume.View(), {});
  std::vector<std::size_t> counts;
  while (counts.size() < 10)
  {
    Select(*field, request, 2);
    const auto rowsRead = std::lround(field->GetFractionRead() * macrocells[1] * macrocells[2]);
    std::size_t count = 0;
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      std::vector<Hit> expected;
      std::copy_if(all[i].begin(), all[i].end(), std::back_inserter(expected),
        [&](const Hit& hit)
        {
          const Index3 cell = whole->GetLattice().GetCell(hit);
          return cell[1] / 8 + cell[2] / 8 * macrocells[1] < rowsRead;
        });
      count += expected.size();
      ASSERT_TRUE(AreSame(Trace(*field, lines[i]), expected)) << ToText(lines[i]);
    }
    counts.push_back(count);
    if (field->GetFractionRead() == 1.0)
    {
      break;
    }
    field->ReadSlab(2);
  }
  EXPECT_EQ(field->GetFractionRead(), 1.0);
  EXPECT_EQ(counts.front(), 0U);
  EXPECT_GE(counts.size(), 4U);
  EXPECT_TRUE(std::is_sorted(counts.begin(), counts.end(), std::less_equal<>()));
  EXPECT_GT(counts.back(), lines.size());
}

//------------------------------------------------------------------------------
/// What is hit with hidden cells is the first of all hits that is in another cell, whatever the
/// kernels, and with other cells when these are selected.
TEST(ImageField, HiddenCellsAreNotHit)
{
  const Index3 dimensions = { 22, 19, 25 };
  const auto volume = TestVolume<float>::Of(dimensions,
    [](const Vector3& p) { return std::sin(p[0]) + std::cos(0.7 * p[1]) - 0.1 * p[2]; });
  const auto field = ImageField::New(volume.View(), {}, 1);
  RandomNumbers random(31);
  std::vector<Line> lines;
  for (int i = 0; i < 3000; ++i)
  {
    lines.push_back(RandomLine(random, dimensions));
  }
  const auto trace = [&](const Visibility& visible, double opacity, const Kernels* kernels)
  {
    TraceRequest request({ { -0.4, opacity } });
    request.Visible = visible;
    Execution execution;
    execution.PacketKernels = kernels;
    field->Select(request, execution);
    std::vector<std::vector<Hit>> hits;
    for (std::size_t first = 0; first < lines.size(); first += 100)
    {
      RayPacket packet;
      packet.Clear();
      for (std::size_t i = first; i < first + 100; ++i)
      {
        field->AddRay(lines[i].Origin, lines[i].Direction, 0.0, 1e6, packet);
      }
      RayHits found;
      field->Trace(packet, found);
      for (std::size_t i = 0; i < 100; ++i)
      {
        hits.emplace_back(found.Hits.begin() + static_cast<std::ptrdiff_t>(found.First[i]),
          found.Hits.begin() + static_cast<std::ptrdiff_t>(found.First[i + 1]));
      }
    }
    return hits;
  };
  const std::vector<std::vector<Hit>> all = trace({}, 1e-9, nullptr);
  // Other cells have another address.
  std::vector<std::vector<unsigned char>> choices;
  for (const double share : { 0.1, 0.5, 0.9 })
  {
    choices.emplace_back(Count({ 21, 18, 24 }));
    std::vector<unsigned char>& hidden = choices.back();
    for (unsigned char& cell : hidden)
    {
      cell = random.Uniform(0.0, 1.0) < share ? 1 : 0;
    }
    Visibility visible;
    visible.HiddenCells = hidden.data();
    for (const double opacity : { 1.0, 1e-9 })
    {
      for (const Kernels* kernels : { static_cast<const Kernels*>(nullptr), &GetBestKernels() })
      {
        const std::vector<std::vector<Hit>> hits = trace(visible, opacity, kernels);
        for (std::size_t i = 0; i < lines.size(); ++i)
        {
          std::vector<Hit> expected;
          std::copy_if(all[i].begin(), all[i].end(), std::back_inserter(expected),
            [&hidden](const Hit& hit) { return hidden[static_cast<std::size_t>(hit.Cell)] == 0; });
          expected.resize(
            std::min<std::size_t>(expected.size(), opacity >= 1.0 ? 1 : expected.size()));
          ASSERT_TRUE(AreSame(hits[i], expected)) << share << " " << opacity << " " << i;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(ImageField, NegativeZeroEqualsZero)
{
  const Index3 size = { 12, 13, 11 };
  const auto zeros = ClosedNoise<float>(size, 344, -1, 1, -1);
  auto negative = zeros;
  std::replace(negative.Values.begin(), negative.Values.end(), 0.0F, -0.0F);
  const auto reference = NewTraced(zeros, { { 0.0, Glass } });
  const auto traced = NewTraced(negative, { { 0.0, Glass } });
  const auto below = NewTraced(zeros, { { -0.0, Glass } });
  RandomNumbers random(345);
  std::size_t hits = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const Line line = i % 2 == 0 ? LatticeLine(random, size) : RandomLine(random, size);
    const std::vector<Hit> expected = Trace(*reference, line);
    hits += expected.size();
    ASSERT_TRUE(AreSame(Trace(*traced, line), expected)) << ToText(line);
    ASSERT_TRUE(AreSame(Trace(*below, line), expected)) << ToText(line);
  }
  EXPECT_GT(hits, 2000U);
}

//------------------------------------------------------------------------------
template <typename T>
void CheckNonFiniteSamples(const std::string& what, std::uint64_t seed)
{
  const Index3 size = { 12, 13, 11 };
  auto volume = TestVolume<T>::Of(size, Tunnels);
  RandomNumbers random(seed);
  const double bad[] = { std::nan(""), Infinity, -Infinity };
  for (int i = 0; i < 40; ++i)
  {
    volume.At({ random.Integer(0, 11), random.Integer(0, 12), random.Integer(0, 10) }) =
      static_cast<T>(bad[i % 3]);
  }
  HitChecks checks(what);
  const auto traced = NewTraced(volume, { { 0.05, Glass } });
  for (int i = 0; i < 700; ++i)
  {
    const Line line = RandomLine(random, size);
    ASSERT_NO_FATAL_FAILURE(checks.Check(volume, *traced, line, 0.05));
    for (const Hit& hit : Trace(*traced, line))
    {
      for (const NormalMode mode :
        { NormalMode::CentralDifferences, NormalMode::InterpolantGradient })
      {
        const Vector3 gradient = traced->GetGradient(hit, mode);
        ASSERT_TRUE(std::isfinite(Dot(gradient, gradient)));
      }
    }
  }
  EXPECT_GT(checks.GetNumberOfHits(), 300U);
}

TEST(ImageField, NoSurfaceInCellsWithNonFiniteSamples)
{
  CheckNonFiniteSamples<float>("float with NaN and infinity", 335);
  CheckNonFiniteSamples<double>("double with NaN and infinity", 336);
}

//------------------------------------------------------------------------------
template <typename T>
void CheckSameHits(const std::vector<double>& samples, ImageField& reference,
  const std::vector<Isosurface>& surfaces)
{
  const Index3& size = reference.GetLattice().GetDimensions();
  std::vector<T> converted;
  for (const double sample : samples)
  {
    converted.push_back(static_cast<T>(sample));
  }
  for (const int stride : { 1, 3 })
  {
    const TestVolume<T> volume(size, converted, stride);
    for (const BrickLayout layout :
      { BrickLayout::Apron, BrickLayout::TwoLevel, BrickLayout::Unbricked })
    {
      const auto traced = NewTraced(volume, surfaces, { { 4, 2 }, layout, 4, 2 });
      RandomNumbers random(338);
      for (int i = 0; i < 300; ++i)
      {
        const Line line = i % 3 == 0 ? LatticeLine(random, size) : RandomLine(random, size);
        const std::vector<Hit> hits = Trace(*traced, line);
        ASSERT_TRUE(AreSame(hits, Trace(reference, line))) << ToText(line);
        for (const Hit& hit : hits)
        {
          for (const NormalMode mode :
            { NormalMode::CentralDifferences, NormalMode::InterpolantGradient })
          {
            ASSERT_EQ(traced->GetGradient(hit, mode), reference.GetGradient(hit, mode));
          }
        }
      }
    }
  }
}

TEST(ImageField, IdenticalHitsForAllSampleTypes)
{
  const Index3 size = { 11, 12, 13 };
  RandomNumbers random(337);
  std::vector<double> samples(Count(size));
  for (double& sample : samples)
  {
    sample = random.Integer(0, 100);
  }
  const std::vector<Isosurface> surfaces = { { 33.3, 0.1 }, { 50.0, 0.1 } };
  const TestVolume<double> volume(size, samples);
  const auto reference = NewTraced(volume, surfaces);
  CheckSameHits<std::int8_t>(samples, *reference, surfaces);
  CheckSameHits<std::uint8_t>(samples, *reference, surfaces);
  CheckSameHits<std::int16_t>(samples, *reference, surfaces);
  CheckSameHits<std::uint16_t>(samples, *reference, surfaces);
  CheckSameHits<std::int32_t>(samples, *reference, surfaces);
  CheckSameHits<std::uint32_t>(samples, *reference, surfaces);
  CheckSameHits<std::int64_t>(samples, *reference, surfaces);
  CheckSameHits<std::uint64_t>(samples, *reference, surfaces);
  CheckSameHits<float>(samples, *reference, surfaces);
  CheckSameHits<double>(samples, *reference, surfaces);
}

//------------------------------------------------------------------------------
TEST(ImageField, HitsFromFarAwayMatchThoseFromNear)
{
  const Index3 size = { 18, 16, 17 };
  const auto volume = TestVolume<float>::Of(size, Ball);
  const auto traced = NewTraced(volume, { { 0.0, Glass } });
  RandomNumbers random(340);
  std::size_t compared = 0;
  double largest = 0.0;
  for (int i = 0; i < 1500; ++i)
  {
    const Line line = RandomLine(random, size);
    const Line near = { line.Origin - line.Direction * 40.0, line.Direction };
    const Line far = { line.Origin - line.Direction * 1e9, line.Direction };
    const std::vector<Hit> nearHits = Trace(*traced, near);
    const std::vector<Hit> farHits = Trace(*traced, far);
    const std::vector<ExactHit> exact = FindExactHits(volume, far, 0.0);
    ASSERT_EQ(farHits.size(), exact.size()) << ToText(far);
    if (nearHits.size() != 2 || farHits.size() != 2 || nearHits[1].T - nearHits[0].T < 1.0)
    {
      continue; // where the ray grazes the ball, the 1e-7 that its origin is rounded by matter more
    }
    for (std::size_t k = 0; k < 2; ++k)
    {
      ++compared;
      const Vector3 off =
        traced->GetPointInCells(nearHits[k]) - traced->GetPointInCells(farHits[k]);
      largest = std::max(largest, Length(off));
      ASSERT_NEAR(farHits[k].T, exact[k].T, 2.5e-7);
    }
  }
  std::cout << "[ tried    ] " << compared << " hits from 1e9 cells away; off by up to " << largest
            << " cells\n";
  EXPECT_GT(compared, 500U);
  EXPECT_LT(largest, 1e-6);
}

//------------------------------------------------------------------------------
// The origin 2^30 cells away is exact, and so is the ray: every digit is that of a ray from near
// by.
TEST(ImageField, NoHitIsLostFromFarAway)
{
  const Index3 size = { 18, 16, 17 };
  const auto volume = TestVolume<float>::Of(size, Ball);
  const auto traced = NewTraced(volume, { { 0.0, Glass } });
  RandomNumbers random(341);
  std::size_t compared = 0;
  double largest = 0.0;
  for (int i = 0; i < 3000; ++i)
  {
    Line line;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      line.Direction[axis] = random.Integer(-1024, 1024) * 0x1p-10;
      line.Origin[axis] = random.Integer(0, 1000) * (size[axis] - 1) * 0x1p-10;
    }
    line.Direction[random.Bits() % 3] = random.Integer(0, 1) ? 1.0 : -1.0;
    const Line near = { line.Origin - line.Direction * 32.0, line.Direction };
    const Line far = { line.Origin - line.Direction * 0x1p30, line.Direction };
    const std::vector<Hit> nearHits = Trace(*traced, near);
    const std::vector<Hit> farHits = Trace(*traced, far);
    ASSERT_EQ(nearHits.size(), farHits.size()) << ToText(line);
    for (std::size_t k = 0; k < nearHits.size(); ++k)
    {
      ++compared;
      const Vector3 off =
        traced->GetPointInCells(nearHits[k]) - traced->GetPointInCells(farHits[k]);
      const double steep = std::abs(
        Dot(traced->GetGradient(nearHits[k], NormalMode::InterpolantGradient), line.Direction));
      largest = std::max(largest, Length(off) * std::min(1.0, steep));
    }
  }
  std::cout << "[ tried    ] " << compared << " hits from 2^30 cells away; off by up to " << largest
            << " cells\n";
  EXPECT_GT(compared, 1000U);
  EXPECT_LT(largest, 1e-12);
}

//------------------------------------------------------------------------------
TEST(ImageField, NoHitsBehindTheEndOfARay)
{
  const auto volume = TestVolume<double>::Of({ 17, 16, 18 }, Ball);
  const auto traced = NewTraced(volume, { { 0.0, Glass } });
  RandomNumbers random(342);
  std::size_t cut = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const Line line = RandomLine(random, volume.Dimensions);
    const std::vector<Hit> all = Trace(*traced, line);
    if (all.size() < 2 || all[1].T - all[0].T < 0.1)
    {
      continue;
    }
    ++cut;
    ASSERT_EQ(Trace(*traced, line, all[0].T - 1e-9).size(), 0U) << ToText(line);
    ASSERT_EQ(Trace(*traced, line, all[0].T + 1e-9).size(), 1U) << ToText(line);
    ASSERT_EQ(Trace(*traced, line, all[1].T - 1e-9).size(), 1U) << ToText(line);
    ASSERT_EQ(Trace(*traced, line, all[1].T + 1e-9).size(), 2U) << ToText(line);
  }
  EXPECT_GT(cut, 1000U);
}

//------------------------------------------------------------------------------
// Scaled by a power of two, data has the same hits to the last bit, if no difference of samples
// becomes denormal.
TEST(ImageField, IdenticalHitsAtAnyMagnitudeOfTheData)
{
  const Index3 size = { 12, 11, 10 };
  const auto unit = TestVolume<float>::Of(size, Tunnels);
  const auto reference = NewTraced(unit, { { 0.25, Glass } });
  for (const int exponent : { -990, -500, -300, 300, 500, 1000, 1020, 1023 })
  {
    TestVolume<double> scaled(size, std::vector<double>(Count(size)));
    for (std::size_t i = 0; i < scaled.Values.size(); ++i)
    {
      scaled.Values[i] = std::ldexp(static_cast<double>(unit.Values[i]), exponent);
    }
    const std::vector<Isosurface> surfaces = { { std::ldexp(0.25, exponent), Glass } };
    const auto traced = NewTraced(scaled, surfaces);
    const auto bare = NewTraced(scaled, surfaces, { {}, BrickLayout::Unbricked, 8, 4 });
    RandomNumbers random(343);
    std::size_t hits = 0;
    for (int i = 0; i < 300; ++i)
    {
      const Line line = RandomLine(random, size);
      const std::vector<Hit> expected = Trace(*reference, line);
      hits += expected.size();
      ASSERT_TRUE(AreSame(Trace(*traced, line), expected)) << "2^" << exponent << ToText(line);
      ASSERT_TRUE(AreSame(Trace(*bare, line), expected)) << "2^" << exponent << ToText(line);
    }
    EXPECT_GT(hits, 300U);
  }
}

}
}
