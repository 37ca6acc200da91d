// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Volumes whose samples are not evenly spaced: rays miss nothing in them, and gradients are those
// of their space.

#include "Image/ImageField.h"
#include "Image/Lattice/Ray.h"
#include "Image/Lattice/UnevenPlanes.h"
#include "Matrices.h"
#include "RandomNumbers.h"
#include "RandomPlanes.h"
#include "Rays/Camera.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestRequest.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

std::vector<double> WholeNumbers(int count)
{
  std::vector<double> coordinates;
  for (int i = 0; i < count; ++i)
  {
    coordinates.push_back(i);
  }
  return coordinates;
}

/// The hits of the whole line, on both sides of its origin.
std::vector<Hit> TraceBothWays(ImageField& volume, const Line& line)
{
  return Trace(volume, line, Infinity, -Infinity);
}

/// Lines through the volume, many of them through its planes, edges and corners.
Line AnyLine(RandomNumbers& random, const Index3& size, const UnevenPlanes& planes)
{
  Line line = random.Integer(0, 1) == 0 ? RandomLine(random, size) : LatticeLine(random, size);
  if (random.Integer(0, 2) == 0)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      line.Origin[axis] = planes.Get(axis, random.Integer(0, size[axis] - 1));
    }
  }
  return line;
}

/// The interpolant of the volume at a point, found without the ray tracer.
double Evaluate(const TestVolume<double>& volume, const UnevenPlanes& planes, const Vector3& point)
{
  Index3 cell;
  Vector3 p;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    int i = 0;
    while (i < volume.Dimensions[axis] - 2 && planes.Get(axis, i + 1) <= point[axis])
    {
      ++i;
    }
    cell[axis] = i;
    p[axis] = (point[axis] - planes.Get(axis, i)) / (planes.Get(axis, i + 1) - planes.Get(axis, i));
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Index3 up = { corner & 1, corner >> 1 & 1, corner >> 2 };
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      weight *= up[axis] == 1 ? p[axis] : 1.0 - p[axis];
    }
    sum += weight * volume.At({ cell[0] + up[0], cell[1] + up[1], cell[2] + up[2] });
  }
  return sum;
}

TestVolume<double> Noise(RandomNumbers& random, const Index3& size, bool isClosed)
{
  TestVolume<double> volume(size, std::vector<double>(Count(size), -1.0));
  ForEachPlace(size,
    [&](const Index3& i)
    {
      bool isBorder = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isBorder = isBorder || i[axis] == 0 || i[axis] == size[axis] - 1;
      }
      if (!isClosed || !isBorder)
      {
        volume.At(i) = random.Uniform(-1.0, 1.0);
      }
    });
  return volume;
}

}

TEST(UnevenPlanes, FindsCells)
{
  const UnevenPlanes planes(
    { std::vector<double>{ 0.0, 0.25, 0.25, 3.0 }, WholeNumbers(3), WholeNumbers(2) });
  EXPECT_EQ(planes.FindCell(0, -1.0), 0);
  EXPECT_EQ(planes.FindCell(0, 0.1), 0);
  EXPECT_EQ(planes.FindCell(0, 0.25), 2);
  EXPECT_EQ(planes.FindCell(0, 3.0), 2);
  EXPECT_EQ(planes.FindCell(0, 9.0), 2);
  EXPECT_EQ(planes.FindCell(1, 1.0), 1);
  EXPECT_EQ(planes.FindCell(2, 1.0), 0);
  EXPECT_TRUE(planes.IsFlat({ 1, 0, 0 }));
  EXPECT_FALSE(planes.IsFlat({ 2, 1, 0 }));
  EXPECT_EQ(planes.Get(0, 8), 3.0);
  EXPECT_FALSE(planes.HasFlatBorder());
  EXPECT_EQ(planes.GetPoint({ 2, 1, 0 }, { 1.0, 0.5, 0.0 }), (Vector3{ 3.0, 1.5, 0.0 }));
}

// Even planes, given one by one, equal no planes.
TEST(UnevenPlanes, EvenPlanesMatchNoPlanes)
{
  RandomNumbers random(1);
  const Index3 size = { 21, 18, 15 };
  const TestVolume<double> volume = Noise(random, size, false);
  const UnevenPlanes planes(
    { WholeNumbers(size[0]), WholeNumbers(size[1]), WholeNumbers(size[2]) });
  TestRequest request({ { 0.0, Glass }, { 0.5, Glass } });
  const auto even = NewTraced(volume, request);
  request.Planes = &planes;
  const auto uneven = NewTraced(volume, request);
  for (int i = 0; i < 2000; ++i)
  {
    const Line line = AnyLine(random, size, planes);
    const std::vector<Hit> expected = TraceBothWays(*even, line);
    const std::vector<Hit> hits = TraceBothWays(*uneven, line);
    ASSERT_EQ(hits.size(), expected.size()) << ToText(line);
    for (std::size_t k = 0; k < hits.size(); ++k)
    {
      EXPECT_TRUE(AreSame(hits[k], expected[k])) << ToText(line);
      EXPECT_EQ(uneven->GetPoint(hits[k]), even->GetPoint(expected[k])) << ToText(line);
    }
  }
}

// Kernels make the rays of pixels. Those that are parallel to planes stay in the cells that single
// rays stay in, in planes and between them.
TEST(UnevenPlanes, RaysOfPixelsMatchSingleRays)
{
  RandomNumbers random(7);
  const Index3 size = { 7, 7, 7 };
  const TestVolume<double> volume = Noise(random, size, false);
  const std::vector<double> coordinates = { 0.0, 0.5, 0.5, 1.0, 3.5, 5.5, 6.0 };
  const UnevenPlanes planes({ coordinates, coordinates, coordinates });
  TestRequest request({ { 0.0, 1.0 } });
  request.Planes = &planes;
  const auto byKernels = NewTraced(volume, request);
  request.PacketKernels = nullptr;
  const auto oneByOne = NewTraced(volume, request);
  int parallel = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Along the axis, with pixels at every half.
    Matrix4 indexFromClip = {};
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    indexFromClip[4 * u] = 4.0;
    indexFromClip[4 * u + 3] = 3.25;
    indexFromClip[4 * v + 1] = 2.0;
    indexFromClip[4 * v + 3] = 2.25;
    indexFromClip[4 * axis + 2] = 20.0;
    indexFromClip[4 * axis + 3] = 3.0;
    indexFromClip[15] = 1.0;
    const Camera camera(Invert(indexFromClip), indexFromClip, {}, 16, 8);
    RayPacket found;
    RayPacket expected;
    byKernels->MakeRays(camera, { 0, 0, 16, 8 }, {}, found);
    oneByOne->MakeRays(camera, { 0, 0, 16, 8 }, {}, expected);
    ASSERT_EQ(found.Count, expected.Count);
    for (int i = 0; i < found.Count; ++i)
    {
      ASSERT_EQ(Has(found.Exists, i), Has(expected.Exists, i));
      for (std::size_t across = 0; across < 3 && Has(found.Exists, i); ++across)
      {
        EXPECT_TRUE(AreSameBits(found.Origin[across][i], expected.Origin[across][i]));
        EXPECT_TRUE(AreSameBits(found.Inverse[across][i], expected.Inverse[across][i]));
        parallel += found.Direction[across][i] == 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(parallel, 300);
}

// A closed surface is entered as often as left, whatever the planes, and the macrocells hide
// nothing.
TEST(UnevenPlanes, NoRayLeaksThroughAClosedSurface)
{
  RandomNumbers random(2);
  const Index3 size = { 20, 19, 12 };
  std::size_t found = 0;
  for (int round = 0; round < 40; ++round)
  {
    const TestVolume<double> volume = Noise(random, size, true);
    const UnevenPlanes planes = RandomPlanes(random, size, { 10.0, round % 2 == 1 });
    TestRequest request({ { 0.1, Glass } });
    request.Planes = &planes;
    ImageSettings cellByCell;
    cellByCell.MacrocellBranching.clear();
    ImageSettings small;
    small.MacrocellBranching = { 2, 3 };
    const auto traced = NewTraced(volume, request);
    const auto simple = NewTraced(volume, request, cellByCell);
    const auto other = NewTraced(volume, request, small);
    for (int i = 0; i < 400; ++i)
    {
      const Line line = AnyLine(random, size, planes);
      const std::vector<Hit> hits = TraceBothWays(*traced, line);
      found += hits.size();
      ASSERT_EQ(hits.size() % 2, 0U) << ToText(line);
      for (std::size_t k = 0; k < hits.size(); ++k)
      {
        ASSERT_EQ(hits[k].Entering, k % 2 == 0) << ToText(line);
        ASSERT_TRUE(k == 0 || hits[k].T >= hits[k - 1].T) << ToText(line);
      }
      for (ImageField* volumeToo : { simple.get(), other.get() })
      {
        const std::vector<Hit> too = TraceBothWays(*volumeToo, line);
        ASSERT_EQ(too.size(), hits.size()) << ToText(line);
        for (std::size_t k = 0; k < too.size(); ++k)
        {
          ASSERT_TRUE(AreSame(hits[k], too[k])) << ToText(line);
        }
      }
    }
  }
  EXPECT_GT(found, 10000U);
}

// Where the ray tracer finds a hit, the interpolant has the isovalue; and sampling the ray in small
// steps finds no further change of sign.
TEST(UnevenPlanes, HitsLieOnTheInterpolant)
{
  RandomNumbers random(3);
  const Index3 size = { 12, 9, 10 };
  double worst = 0.0;
  std::size_t found = 0;
  for (int round = 0; round < 10; ++round)
  {
    const TestVolume<double> volume = Noise(random, size, false);
    const UnevenPlanes planes = RandomPlanes(random, size, {});
    TestRequest request({ { 0.1, Glass } });
    request.Planes = &planes;
    const auto traced = NewTraced(volume, request);
    for (int i = 0; i < 50; ++i)
    {
      const Line line = RandomLine(random, size);
      const std::vector<Hit> hits = TraceBothWays(*traced, line);
      const std::optional<Ray> ray =
        ClipToVolume(line.Origin, line.Direction, -Infinity, Infinity, size, &planes);
      ASSERT_TRUE(ray);
      std::size_t next = 0;
      double before = -1.0;
      double tBefore = ray->Base + ray->Begin;
      constexpr int steps = 4000;
      for (int step = 0; step <= steps; ++step)
      {
        const double t = ray->Base + ray->Begin + (ray->End - ray->Begin) * step / steps;
        const double value = Evaluate(volume, planes, line.Origin + line.Direction * t) - 0.1;
        if (step > 0 && (before >= 0.0) != (value >= 0.0))
        {
          while (next < hits.size() && hits[next].T < tBefore)
          {
            ++next;
          }
          ASSERT_TRUE(next < hits.size() && hits[next].T <= t) << ToText(line);
        }
        before = value;
        tBefore = t;
      }
      for (const Hit& hit : hits)
      {
        const Vector3 point = traced->GetPoint(hit);
        worst = std::max(worst, std::abs(Evaluate(volume, planes, point) - 0.1));
        worst = std::max(worst, Length(point - (line.Origin + line.Direction * hit.T)));
        ++found;
      }
    }
  }
  EXPECT_GT(found, 1000U);
  EXPECT_LT(worst, 1e-10);
}

// The largest value of a ray is no smaller than any along it, and is taken at the reported point.
TEST(UnevenPlanes, ExtremeValuesMatchTheInterpolant)
{
  RandomNumbers random(6);
  const Index3 size = { 20, 9, 10 };
  for (int round = 0; round < 10; ++round)
  {
    const TestVolume<double> volume = Noise(random, size, false);
    const UnevenPlanes planes = RandomPlanes(random, size, {});
    TestRequest request;
    request.Planes = &planes;
    request.Projection = Extremum::Largest;
    const auto traced = NewTraced(volume, request);
    for (int i = 0; i < 50; ++i)
    {
      const Line line = RandomLine(random, size);
      const std::vector<Hit> hits = TraceBothWays(*traced, line);
      const std::optional<Ray> ray =
        ClipToVolume(line.Origin, line.Direction, -Infinity, Infinity, size, &planes);
      ASSERT_TRUE(ray);
      ASSERT_EQ(hits.size(), 1U) << ToText(line);
      double largest = -Infinity;
      constexpr int steps = 4000;
      for (int step = 0; step <= steps; ++step)
      {
        const double t = ray->Base + ray->Begin + (ray->End - ray->Begin) * step / steps;
        largest = std::max(largest, Evaluate(volume, planes, line.Origin + line.Direction * t));
      }
      EXPECT_GE(hits[0].Value, largest - 1e-9) << ToText(line);
      EXPECT_NEAR(Evaluate(volume, planes, traced->GetPoint(hits[0])), hits[0].Value, 1e-9)
        << ToText(line);
    }
  }
}

// Both normals are exact for a plane, and smooth ones for a quadric at its samples.
TEST(UnevenPlanes, GradientsAreInPhysicalSpace)
{
  RandomNumbers random(4);
  const Index3 size = { 9, 8, 7 };
  const UnevenPlanes planes = RandomPlanes(random, size, {});
  const auto make = [&](const auto& field)
  {
    TestVolume<double> volume(size, std::vector<double>(Count(size)));
    ForEachPlace(size,
      [&](const Index3& i)
      { volume.At(i) = field(planes.Get(0, i[0]), planes.Get(1, i[1]), planes.Get(2, i[2])); });
    return volume;
  };
  TestRequest request({ { 0.0, 1.0 } });
  request.Planes = &planes;
  const auto linear = make([](double x, double y, double z) { return 3.0 * x - 2.0 * y + z; });
  const auto traced = NewTraced(linear, request);
  const auto quadric = make([](double x, double y, double z) { return x * x - y * y + x * z; });
  const auto curved = NewTraced(quadric, request);
  std::vector<Hit> hits;
  ForEachPlace({ size[0] - 1, size[1] - 1, size[2] - 1 },
    [&](const Index3& cell)
    {
      const std::int64_t number = traced->GetLattice().GetNumber(cell);
      const Hit hit = { 0.0, number, 0, { 0.0, 0.0, 0.0 }, true };
      hits.push_back({ 0.0, number, 0, { 0.3, 0.6, 0.2 }, true });
      for (const NormalMode mode :
        { NormalMode::InterpolantGradient, NormalMode::CentralDifferences })
      {
        const Vector3 off = traced->GetGradient(hits.back(), mode) - Vector3{ 3.0, -2.0, 1.0 };
        EXPECT_LT(Length(off), 1e-9);
      }
      if (cell[0] > 0 && cell[1] > 0 && cell[2] > 0)
      {
        const Vector3 p = curved->GetPoint(hit);
        const Vector3 off = curved->GetGradient(hit, NormalMode::CentralDifferences) -
          Vector3{ 2.0 * p[0] + p[2], -2.0 * p[1], p[0] };
        EXPECT_LT(Length(off), 1e-8);
      }
    });
  // Those of many hits at a time are the same.
  ASSERT_EQ(curved->GetRequest().Normals, NormalMode::CentralDifferences);
  double points[3][RayPacket::Capacity];
  double gradients[3][RayPacket::Capacity];
  curved->GetPointsAndGradients(
    hits.data(), RayPacket::Capacity, curved->GetRequest().Normals, points, gradients);
  for (std::size_t i = 0; i < RayPacket::Capacity; ++i)
  {
    const Vector3 one = curved->GetGradient(hits[i], NormalMode::CentralDifferences);
    EXPECT_EQ((Vector3{ gradients[0][i], gradients[1][i], gradients[2][i] }), one);
    EXPECT_EQ((Vector3{ points[0][i], points[1][i], points[2][i] }), curved->GetPoint(hits[i]));
  }
}

// Where two planes coincide and the values beside them differ, there is a wall.
TEST(UnevenPlanes, CoincidentPlanesAreDiscontinuities)
{
  const Index3 size = { 20, 4, 4 };
  for (int flat = 0; flat <= size[0] - 2; ++flat)
  {
    std::vector<double> coordinates;
    for (int i = 0; i < size[0]; ++i)
    {
      coordinates.push_back((i <= flat ? i : i - 1) * (size[0] - 1.0) / (size[0] - 2.0));
    }
    coordinates.back() = size[0] - 1.0;
    const UnevenPlanes planes({ coordinates, WholeNumbers(4), WholeNumbers(4) });
    TestVolume<float> volume(size, std::vector<float>(Count(size)));
    ForEachPlace(size, [&](const Index3& i) { volume.At(i) = i[0] <= flat ? 0.0F : 1.0F; });
    TestRequest request({ { 0.25, 1.0 } });
    request.Planes = &planes;
    for (const RootSolver solver :
      { RootSolver::Robust, RootSolver::Analytic, RootSolver::Marmitt, RootSolver::Linear })
    {
      request.Solver = solver;
      const auto traced = NewTraced(volume, request);
      for (const double direction : { 1.0, -1.0 })
      {
        const auto hits =
          TraceBothWays(*traced, { { coordinates[6], 1.3, 1.6 }, { direction, 0.02, -0.01 } });
        ASSERT_EQ(hits.size(), 1U) << "flat cell " << flat;
        EXPECT_EQ(traced->GetLattice().GetCell(hits[0])[0], flat);
        EXPECT_NEAR(hits[0].Parametric[0], 0.25, 1e-6);
        EXPECT_EQ(hits[0].Entering, direction > 0.0);
        EXPECT_EQ(traced->GetPoint(hits[0])[0], planes.Get(0, flat));
        for (const NormalMode mode :
          { NormalMode::InterpolantGradient, NormalMode::CentralDifferences })
        {
          const Vector3 gradient = traced->GetGradient(hits[0], mode);
          EXPECT_GT(gradient[0], 0.0);
          EXPECT_EQ(gradient[1], 0.0);
          EXPECT_EQ(gradient[2], 0.0);
        }
      }
    }
  }
}

// Also where the first or the last planes coincide, however many do. As elsewhere, rays that begin
// or end in a wall do not meet it.
TEST(UnevenPlanes, WallsAtTheBorder)
{
  for (const int repeats : { 1, 10 })
  {
    const int last = 2 * repeats + 5;
    const Index3 size = { last + 1, 90, 4 };
    std::vector<double> coordinates;
    for (int i = 0; i <= last; ++i)
    {
      coordinates.push_back(std::clamp(i - repeats, 0, 5) * last / 5.0);
    }
    const UnevenPlanes planes({ coordinates, WholeNumbers(90), WholeNumbers(4) });
    TestVolume<float> volume(size, std::vector<float>(Count(size)));
    ForEachPlace(
      size, [&](const Index3& i) { volume.At(i) = i[0] == 0 || i[0] == last ? -1.0F : 1.0F; });
    for (const Interpolant interpolant :
      { Interpolant::Trilinear, Interpolant::Tricubic, Interpolant::Nearest })
    {
      for (const bool hasPackets : { true, false })
      {
        TestRequest request({ { 0.5, Glass } });
        request.Planes = &planes;
        request.Interpolation = interpolant;
        request.PacketKernels = hasPackets ? request.PacketKernels : nullptr;
        const auto traced = NewTraced(volume, request);
        for (const Vector3& direction : { Vector3{ 1.0, 0.02, -0.01 }, { -1.0, 0.1, 0.01 },
               { 0.6, 1.0, 0.02 }, { -0.7, 1.0, 0.01 } })
        {
          const Vector3 middle = { 0.5 * last, 44.3, 1.6 };
          const std::vector<Hit> hits = TraceBothWays(*traced, { middle, direction });
          ASSERT_EQ(hits.size(), 2U);
          for (std::size_t i = 0; i < 2; ++i)
          {
            const bool isFirst = (direction[0] > 0.0) == (i == 0);
            EXPECT_EQ(traced->GetPoint(hits[i])[0], isFirst ? 0.0 : last);
            EXPECT_EQ(hits[i].Entering, i == 0);
            const Vector3 gradient = traced->GetGradient(hits[i], NormalMode::InterpolantGradient);
            EXPECT_EQ(Normalized(gradient), (Vector3{ isFirst ? 1.0 : -1.0, 0.0, 0.0 }));
          }
          const Line inWall = { { direction[0] > 0.0 ? 0.0 : last, 44.3, 1.6 }, direction };
          EXPECT_EQ(Trace(*traced, inWall).size(), 1U);
          EXPECT_EQ(Trace(*traced, inWall, 1.0).size(), 0U);
        }
      }
    }
  }
}

// Cropping is given in the space of the rays.
TEST(UnevenPlanes, CroppingAndClippingAreInPhysicalSpace)
{
  RandomNumbers random(5);
  const Index3 size = { 12, 9, 10 };
  const TestVolume<double> volume = Noise(random, size, false);
  const UnevenPlanes planes = RandomPlanes(random, size, {});
  TestRequest request({ { 0.0, Glass } });
  request.Planes = &planes;
  const auto all = NewTraced(volume, request);
  request.Visible.Regions.Planes = { { { 2.5, 7.0 }, { 1.1, 4.4 }, { 3.3, 5.5 } } };
  request.Visible.Regions.Visible = 0x5ab3c17;
  const auto cropped = NewTraced(volume, request);
  std::size_t count = 0;
  std::size_t unseen = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Line line = RandomLine(random, size);
    std::vector<Hit> expected;
    for (const Hit& hit : TraceBothWays(*all, line))
    {
      if (request.Visible.Regions.Contain(all->GetPoint(hit)))
      {
        expected.push_back(hit);
      }
      else
      {
        ++unseen;
      }
    }
    const std::vector<Hit> hits = TraceBothWays(*cropped, line);
    ASSERT_EQ(hits.size(), expected.size()) << ToText(line);
    count += hits.size();
  }
  EXPECT_GT(count, 100U);
  EXPECT_GT(unseen, 100U);
}

}
