// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The largest and smallest values of rays are compared with those of many samples in higher
// precision, which share no code with what is tested; and with the known values of simple fields.

#include "Image/ImageField.h"
#include "Image/Lattice/Ray.h"
#include "Noise.h"
#include "RandomNumbers.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestRequest.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr Extremum Both[] = { Extremum::Largest, Extremum::Smallest };

TestRequest Request(Extremum kind, const Visibility& visible = {})
{
  TestRequest request;
  request.Projection = kind;
  request.Visible = visible;
  return request;
}

std::optional<Hit> Project(ImageField& volume, const Line& line, double tEnd = Infinity)
{
  const std::vector<Hit> hits = Trace(volume, line, tEnd);
  EXPECT_LE(hits.size(), 1U);
  return hits.empty() ? std::nullopt : std::optional<Hit>(hits.front());
}

/// The interpolant at a point of a cell, from its definition; NaN if a corner is not finite.
template <typename T>
long double SampleCell(
  const TestVolume<T>& volume, const Index3& cell, const std::array<long double, 3>& point)
{
  long double sum = 0.0L;
  for (int i = 0; i < 8; ++i)
  {
    const Index3 corner = { i & 1, i >> 1 & 1, i >> 2 };
    auto product = static_cast<long double>(
      volume.At({ cell[0] + corner[0], cell[1] + corner[1], cell[2] + corner[2] }));
    if (!std::isfinite(product))
    {
      return std::numeric_limits<long double>::quiet_NaN();
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      product *= corner[axis] == 1 ? point[axis] : 1.0L - point[axis];
    }
    sum += product;
  }
  return sum;
}

/// The same at a point of the volume; NaN outside.
template <typename T>
long double Sample(const TestVolume<T>& volume, const std::array<long double, 3>& point)
{
  Index3 cell;
  std::array<long double, 3> inCell;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!(point[axis] >= 0.0L && point[axis] <= volume.Dimensions[axis] - 1.0L))
    {
      return std::numeric_limits<long double>::quiet_NaN();
    }
    cell[axis] = std::min(static_cast<int>(point[axis]), volume.Dimensions[axis] - 2);
    inCell[axis] = point[axis] - cell[axis];
  }
  return SampleCell(volume, cell, inCell);
}

using Predicate = std::function<bool(const Vector3&)>;

/// The most extreme of samples along a line, so many of them per cell, where they are visible; NaN
/// where there are fewer than two.
template <typename T>
long double FindExtremeSample(const TestVolume<T>& volume, const Line& line, Extremum kind,
  const Predicate& isVisible, int perCell = 400)
{
  const Index3& size = volume.Dimensions;
  const long double length = Length(line.Direction);
  const long double farthest = Length(line.Origin) + size[0] + size[1] + size[2];
  const auto count = static_cast<int>(farthest * perCell);
  long double best = std::numeric_limits<long double>::quiet_NaN();
  int found = 0;
  for (int i = 0; i <= count; ++i)
  {
    const long double t = farthest * i / count / length;
    std::array<long double, 3> point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = line.Origin[axis] + t * line.Direction[axis];
    }
    const long double value = Sample(volume, point);
    if (std::isnan(value) ||
      !isVisible({ static_cast<double>(point[0]), static_cast<double>(point[1]),
        static_cast<double>(point[2]) }))
    {
      continue;
    }
    if (++found == 1 || (kind == Extremum::Largest ? value > best : value < best))
    {
      best = value;
    }
  }
  return found < 2 ? std::numeric_limits<long double>::quiet_NaN() : best;
}

bool Everywhere(const Vector3&)
{
  return true;
}

/// Compares with samples. On half the distance between two of them, noise of 0 to 120 rises by no
/// more than sqrt(3) * 120 / 800; where the visible part ends, on the whole distance.
template <typename T>
void Compare(const TestVolume<T>& volume, ImageField& traced, const Line& line, Extremum kind,
  const Predicate& isVisible)
{
  const std::optional<Hit> hit = Project(traced, line);
  const auto best = static_cast<double>(FindExtremeSample(volume, line, kind, isVisible));
  if (std::isnan(best))
  {
    return;
  }
  ASSERT_TRUE(hit) << ToText(line);
  const double sign = kind == Extremum::Largest ? 1.0 : -1.0;
  EXPECT_GE(sign * hit->Value, sign * best - 1e-9) << ToText(line);
  EXPECT_LE(sign * hit->Value, sign * best + 0.55) << ToText(line);

  // It has that value at the reported point.
  const Vector3& inCell = hit->Parametric;
  const long double value =
    SampleCell(volume, traced.GetLattice().GetCell(*hit), { inCell[0], inCell[1], inCell[2] });
  EXPECT_NEAR(static_cast<double>(value), hit->Value, 1e-9) << ToText(line);
  const Vector3 onRay = line.Origin + line.Direction * hit->T;
  EXPECT_LT(Length(onRay - traced.GetPoint(*hit)), 1e-9) << ToText(line);
}

//------------------------------------------------------------------------------
template <typename T>
class Projection : public testing::Test
{
};

TYPED_TEST_SUITE(Projection, SampleTypes);

TYPED_TEST(Projection, MatchesDenseSampling)
{
  RandomNumbers random(3);
  const auto volume = Noise<TypeParam>({ 19, 14, 11 }, 5);
  for (const Extremum kind : Both)
  {
    const auto traced = NewTraced(volume, Request(kind));
    for (int i = 0; i < 25; ++i)
    {
      Compare(volume, *traced, RandomLine(random, volume.Dimensions), kind, Everywhere);
      Compare(volume, *traced, LatticeLine(random, volume.Dimensions), kind, Everywhere);
    }
  }
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, FindsExtremaWithinCells)
{
  // Along the diagonal (t, t, t) this is 3 t (1 - t)^2, largest at 1/3: 4/9.
  TestVolume<double> volume({ 2, 2, 2 }, { 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0 });
  const Line diagonal = { { -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 } };
  const auto largest = Project(*NewTraced(volume, Request(Extremum::Largest)), diagonal);
  ASSERT_TRUE(largest);
  EXPECT_NEAR(largest->Value, 4.0 / 9.0, 1e-15);
  EXPECT_NEAR(largest->T, 1.0 + 1.0 / 3.0, 1e-8);
  for (double& value : volume.Values)
  {
    value = 5.0 - value;
  }
  const auto smallest = Project(*NewTraced(volume, Request(Extremum::Smallest)), diagonal);
  ASSERT_TRUE(smallest);
  EXPECT_NEAR(smallest->Value, 5.0 - 4.0 / 9.0, 1e-14);
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, FirstOfEqualValues)
{
  const TestVolume<float> constant({ 20, 20, 20 }, std::vector<float>(8000, 7.0F));
  for (const Extremum kind : Both)
  {
    const auto traced = NewTraced(constant, Request(kind));
    RayHits hits;
    std::vector<std::optional<Ray>> rays;
    // Later rays use the results of earlier ones, which came from the other side.
    for (int i = 0; i < 8; ++i)
    {
      const double way = i % 2 == 0 ? 1.0 : -1.0;
      rays.push_back(ClipToVolume(
        { 9.5 - 15.0 * way, 3.25, 4.5 }, { way, 0.125, 0.25 }, 0.0, Infinity, constant.Dimensions));
    }
    Trace(*traced, rays, hits);
    ASSERT_EQ(hits.Hits.size(), rays.size());
    for (const Hit& hit : hits.Hits)
    {
      EXPECT_EQ(hit.Value, 7.0);
      EXPECT_DOUBLE_EQ(hit.T, 5.5);
    }
  }
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, PassesOverEqualValues)
{
  // Rays find the value where they enter, in one brick: no others are built.
  constexpr int edge = 100;
  const TestVolume<float> constant(
    { edge, edge, edge }, std::vector<float>(std::size_t{ edge } * edge * edge, 7.0F));
  std::vector<std::optional<Ray>> rays;
  for (int i = 0; i < RayPacket::Capacity; ++i)
  {
    rays.push_back(ClipToVolume({ 9.0 + 0.4 * (i % 16), 9.0 + 0.4 * (i / 16), -5.0 },
      { 0.01, 0.02, 1.0 }, 0.0, Infinity, constant.Dimensions));
  }
  for (const Extremum kind : Both)
  {
    const auto traced = NewTraced(constant, Request(kind));
    RayHits hits;
    Trace(*traced, rays, hits);
    EXPECT_EQ(hits.Hits.size(), rays.size());
    EXPECT_EQ(traced->GetStatistics().NumberOfBricks, 1U);
  }
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, IndependentOfSettings)
{
  const auto volume = Noise<std::int16_t>({ 70, 30, 25 }, 9);
  RandomNumbers random(11);
  std::vector<std::optional<Ray>> rays;
  for (int i = 0; i < 400; ++i)
  {
    const Line line =
      i % 4 == 0 ? LatticeLine(random, volume.Dimensions) : RandomLine(random, volume.Dimensions);
    rays.push_back(ClipToVolume(line.Origin, line.Direction, 0.0, Infinity, volume.Dimensions));
  }
  std::vector<ImageSettings> all;
  for (const std::vector<int>& branching :
    { std::vector<int>{}, { 8, 8 }, { 4 }, { 2, 2, 2, 2 }, { 16, 3 } })
  {
    all.push_back({ branching, BrickLayout::Apron, 8, 4 });
  }
  all.push_back({ { 8, 8 }, BrickLayout::Unbricked, 8, 4 });
  all.push_back({ { 8, 8 }, BrickLayout::TwoLevel, 4, 2 });
  for (const Extremum kind : Both)
  {
    // One by one, rays do not use each other's results.
    const auto plain = NewTraced(volume, Request(kind), all.front());
    RayHits expected;
    expected.Clear();
    for (const auto& ray : rays)
    {
      RayHits own;
      Trace(*plain, { ray }, own);
      expected.Append(own);
    }
    for (const ImageSettings& settings : all)
    {
      RayHits hits;
      Trace(*NewTraced(volume, Request(kind), settings), rays, hits);
      ASSERT_EQ(hits.First, expected.First);
      for (std::size_t i = 0; i < hits.Hits.size(); ++i)
      {
        EXPECT_TRUE(AreSame(hits.Hits[i], expected.Hits[i])) << i;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, RespectsCroppingAndClipping)
{
  const auto volume = Noise<double>({ 12, 13, 14 }, 21);
  RandomNumbers random(22);
  for (int i = 0; i < 60; ++i)
  {
    Visibility visible;
    std::vector<unsigned char> hidden(11 * 12 * 13);
    const bool hides = i % 3 == 0;
    const bool crops = i % 3 == 1;
    if (hides)
    {
      std::generate(hidden.begin(), hidden.end(),
        [&random]() { return static_cast<unsigned char>(random.Integer(0, 1)); });
      visible.HiddenCells = hidden.data();
    }
    else if (crops)
    {
      visible.Regions = { { { { 2.5, 7.25 }, { 3.0, 8.5 }, { 4.125, 9.0 } } },
        static_cast<unsigned int>(random.Bits()) & CroppingRegions::All };
    }
    else
    {
      const Vector3 normal = random.Direction();
      visible.HalfSpaces = { { normal, -Dot(normal, { 5.5, 6.0, 6.5 }) } };
    }
    const Predicate isVisible = [&visible](const Vector3& point)
    {
      const auto cell = [&point](std::size_t axis, int last)
      { return std::min(static_cast<std::size_t>(point[axis]), static_cast<std::size_t>(last)); };
      return visible.Regions.Contain(point) &&
        (!visible.HiddenCells ||
          visible.HiddenCells[cell(0, 10) + 11 * (cell(1, 11) + 12 * cell(2, 12))] == 0) &&
        (visible.HalfSpaces.empty() ||
          Dot(visible.HalfSpaces[0].Normal, point) + visible.HalfSpaces[0].Offset >= 0.0);
    };
    const Extremum kind = Both[i % 2];
    const auto traced = NewTraced(volume, Request(kind, visible));
    for (int ray = 0; ray < 5; ++ray)
    {
      Compare(volume, *traced, RandomLine(random, volume.Dimensions), kind, isVisible);
    }
  }
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, SkipsNonFiniteSamples)
{
  auto volume = Noise<float>({ 12, 13, 14 }, 31);
  RandomNumbers random(32);
  for (int i = 0; i < 60; ++i)
  {
    const float none[] = { std::numeric_limits<float>::quiet_NaN(),
      std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity() };
    volume.At({ random.Integer(0, 11), random.Integer(0, 12), random.Integer(0, 13) }) =
      none[i % 3];
  }
  for (const Extremum kind : Both)
  {
    const auto traced = NewTraced(volume, Request(kind));
    for (int i = 0; i < 40; ++i)
    {
      Compare(volume, *traced, RandomLine(random, volume.Dimensions), kind, Everywhere);
    }
  }
  std::fill(volume.Values.begin(), volume.Values.end(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(Project(
    *NewTraced(volume, Request(Extremum::Largest)), { { 5.0, 5.0, -5.0 }, { 0.1, 0.2, 1.0 } }));
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, EndsAtTheEndOfTheRay)
{
  const TestVolume<std::int16_t> ramp =
    TestVolume<std::int16_t>::Of({ 30, 30, 30 }, AnalyticFields::Plane{ { 100.0, 0.0, 0.0 }, 0.0 });
  const auto traced = NewTraced(ramp, Request(Extremum::Largest));
  const auto hit = Project(*traced, { { -2.0, 7.5, 7.5 }, { 1.0, 0.0, 0.0 } }, 19.25);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->Value, 1725.0);
  EXPECT_EQ(hit->T, 19.25);
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, ExtremeMagnitudes)
{
  const double most = std::numeric_limits<double>::max();
  const Line diagonal = { { -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 } };
  for (const double size : { most, 1e300, 1e-300, 1e-320 })
  {
    const TestVolume<double> volume(
      { 2, 2, 2 }, { -size, size, size, -size, size, -size, -size, -size });
    const auto largest = Project(*NewTraced(volume, Request(Extremum::Largest)), diagonal);
    const auto smallest = Project(*NewTraced(volume, Request(Extremum::Smallest)), diagonal);
    ASSERT_TRUE(largest && smallest);
    EXPECT_NEAR(largest->Value / size, 2.0 * 4.0 / 9.0 - 1.0, 1e-3) << size;
    EXPECT_EQ(smallest->Value, -size);
    const auto edge = Project(
      *NewTraced(volume, Request(Extremum::Largest)), { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 } });
    ASSERT_TRUE(edge);
    EXPECT_EQ(edge->Value, size);
  }
}

//------------------------------------------------------------------------------
TEST(ProjectionOfRays, SurfacesAfterAProjection)
{
  const TestVolume<float> ramp =
    TestVolume<float>::Of({ 10, 10, 10 }, AnalyticFields::Plane{ { 1.0, 0.0, 0.0 }, 4.5 });
  const auto traced = NewTraced(ramp, Request(Extremum::Largest));
  Select(*traced, TestRequest({ { 0.0, 1.0 } }), 1);
  const auto hit = Project(*traced, { { -2.0, 4.5, 4.5 }, { 1.0, 0.0, 0.0 } });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->T, 6.5);
}

}
}
