// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Caps close what half-spaces cut open: entries and exits of rays alternate, however they are cut;
// and caps are where the field says.

#include "CapTesting.h"
#include "Image/ImageField.h"
#include "Noise.h"
#include "RandomNumbers.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

int CountLeaks(const TestVolume<float>& volume, TestRequest request, int& caps)
{
  const auto traced = ImageField::New(volume.View(), {}, 2);
  const auto opaque = ImageField::New(volume.View(), {}, 2);
  const auto select = [&](const std::vector<HalfSpace>& halves, double opacity) -> TracedField&
  {
    ImageField& field = opacity < 1.0 ? *traced : *opaque;
    request.Visible.HalfSpaces = halves;
    request.Surfaces[0].Opacity = opacity;
    Select(field, request, 2);
    return field;
  };
  return CountLeakingRays(volume.Dimensions, 40, caps, select);
}

//------------------------------------------------------------------------------
TEST(Caps, NoRayFromOutsideLeaks)
{
  const TestVolume<float> volume = ClosedNoise<float>({ 21, 19, 23 }, 5, 0, 4, 0);
  for (const double isovalue : { 2.0, 1.5, 0.25 })
  {
    int caps = 0;
    EXPECT_EQ(CountLeaks(volume, { { { isovalue, 1.0 } } }, caps), 0) << "above " << isovalue;
    EXPECT_GT(caps, 3000);
    TestRequest alone({ { isovalue, 1.0 } });
    alone.PacketKernels = nullptr;
    EXPECT_EQ(CountLeaks(volume, alone, caps), 0) << "cell by cell, above " << isovalue;
    TestRequest boxes({ { isovalue, 1.0 } });
    boxes.Interpolation = Interpolant::Nearest;
    EXPECT_EQ(CountLeaks(volume, boxes, caps), 0) << "between boxes, above " << isovalue;
    int cubicCaps = 0;
    TestRequest cubic({ { isovalue, 1.0 } });
    cubic.Interpolation = Interpolant::Tricubic;
    EXPECT_EQ(CountLeaks(volume, cubic, cubicCaps), 0) << "tricubic, above " << isovalue;
    EXPECT_GT(cubicCaps, 1000);
  }
}

//------------------------------------------------------------------------------
TEST(Caps, NoRayLeaksBetweenUnevenPlanes)
{
  const Index3 size = { 21, 19, 23 };
  const TestVolume<float> volume = ClosedNoise<float>(size, 6, 0, 4, 0);
  RandomNumbers random(3);
  std::array<std::vector<double>, 3> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Many at whole numbers, where half-spaces end; and some cells are flat.
    for (int i = 0; i < size[axis]; ++i)
    {
      coordinates[axis].push_back(random.Integer(0, 1) == 0
          ? random.Integer(1, size[axis] - 2)
          : random.Uniform(1.0, size[axis] - 2.0));
    }
    std::sort(coordinates[axis].begin(), coordinates[axis].end());
    // The cells at the border are not.
    coordinates[axis].front() = 0.0;
    coordinates[axis].back() = size[axis] - 1.0;
  }
  const UnevenPlanes planes(coordinates);
  TestRequest request({ { 1.5, 1.0 } });
  request.Planes = &planes;
  int caps = 0;
  EXPECT_EQ(CountLeaks(volume, request, caps), 0);
  request.Interpolation = Interpolant::Nearest;
  EXPECT_EQ(CountLeaks(volume, request, caps), 0) << "between boxes";
  EXPECT_GT(caps, 3000);
  request.Interpolation = Interpolant::Tricubic;
  EXPECT_EQ(CountLeaks(volume, request, caps), 0) << "tricubic";
}

//------------------------------------------------------------------------------
TEST(Caps, LieWhereTheFieldReachesTheLargestIsovalue)
{
  // Trilinear interpolation reproduces the field.
  const AnalyticFields::Plane field = { { 0.3, -0.7, 0.5 }, -1.0 };
  const TestVolume<double> volume = TestVolume<double>::Of({ 20, 18, 22 }, field);
  const std::vector<Isosurface> surfaces = { { -1.0, Glass }, { 1.0, Glass }, { 3.0, Glass } };
  const auto traced = ImageField::New(volume.View(), {}, 2);
  RandomNumbers random(9);
  int found[4] = {};
  for (int scene = 0; scene < 50; ++scene)
  {
    TestRequest request(surfaces);
    request.Visible.HalfSpaces = { Behind(random.Direction(), { 9.5, 8.5, 10.5 }) };
    const HalfSpace& half = request.Visible.HalfSpaces[0];
    Select(*traced, request, 2);
    for (int ray = 0; ray < 100; ++ray)
    {
      const Line line = RandomLine(random, volume.Dimensions);
      const double slope = Dot(half.Normal, line.Direction);
      const double t = -(Dot(half.Normal, line.Origin) + half.Offset) / slope;
      const Vector3 point = line.Origin + line.Direction * t;
      const double value = field(point);
      bool isInVolume = t > 0.0;
      int surface = -1;
      bool isClear = true;
      for (std::size_t i = 0; i < 3; ++i)
      {
        isInVolume = isInVolume && point[i] > 0.0 && point[i] < volume.Dimensions[i] - 1.0;
        surface += value >= surfaces[i].Isovalue ? 1 : 0;
        isClear = isClear && std::abs(value - surfaces[i].Isovalue) > 1e-9;
      }
      if (!isClear)
      {
        continue;
      }
      const std::vector<Hit> hits = Trace(*traced, line);
      const auto cap = std::find_if(
        hits.begin(), hits.end(), [](const Hit& hit) { return hit.Plane != Hit::NoPlane; });
      ASSERT_EQ(cap != hits.end(), isInVolume && surface >= 0) << ToText(line);
      found[surface + 1] += isInVolume ? 1 : 0;
      if (cap == hits.end())
      {
        continue;
      }
      EXPECT_TRUE(slope > 0.0 ? cap == hits.begin() : cap == hits.end() - 1);
      EXPECT_EQ(cap->Entering, slope > 0.0);
      EXPECT_EQ(cap->Plane, 0);
      EXPECT_EQ(cap->Surface, surface);
      EXPECT_NEAR(cap->T, t, 1e-9);
      EXPECT_NEAR(Length(traced->GetPointInCells(*cap) - point), 0.0, 1e-9);
      EXPECT_NEAR(cap->Value, value, 1e-9);
      EXPECT_EQ(traced->GetGradient(*cap, NormalMode::CentralDifferences), half.Normal);
      double points[3][RayPacket::Capacity];
      double gradients[3][RayPacket::Capacity];
      traced->GetPointsAndGradients(&*cap, 1, traced->GetRequest().Normals, points, gradients);
      EXPECT_EQ((Vector3{ gradients[0][0], gradients[1][0], gradients[2][0] }), half.Normal);
    }
  }
  for (const int count : found)
  {
    EXPECT_GT(count, 100);
  }
}

//------------------------------------------------------------------------------
/// Seen from inside, the cap is not hit; from behind, it is.
TEST(Caps, AreHitFromBothSidesButNotInTheirPlane)
{
  const TestVolume<double> full({ 8, 8, 8 }, std::vector<double>(512, 1.0));
  const auto traced = ImageField::New(full.View(), {}, 2);
  TestRequest request({ { 0.0, 1.0 } });
  request.Visible.HalfSpaces = { Behind({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, 2.25 }) };
  Select(*traced, request, 2);
  const auto look = [&traced](double from, double way) {
    return Trace(*traced, { { 3.5, 3.25, from }, { 0.0, 0.0, way } });
  };
  ASSERT_EQ(look(-5.0, 1.0).size(), 1U);
  EXPECT_EQ(look(-5.0, 1.0)[0].T, 7.25);
  EXPECT_TRUE(look(-5.0, 1.0)[0].Entering);
  ASSERT_EQ(look(1.0, 1.0).size(), 1U);
  ASSERT_EQ(look(5.0, -1.0).size(), 1U);
  EXPECT_EQ(look(5.0, -1.0)[0].T, 2.75);
  EXPECT_FALSE(look(5.0, -1.0)[0].Entering);
  ASSERT_EQ(look(9.0, -1.0).size(), 1U);
  EXPECT_TRUE(look(5.0, 1.0).empty());
  EXPECT_TRUE(look(2.25 + 1e-8, 1.0).empty());
  EXPECT_TRUE(look(1.0, -1.0).empty());
  EXPECT_TRUE(Trace(*traced, { { -3.0, 3.25, 2.25 }, { 1.0, 0.0, 0.0 } }).empty());
}

//------------------------------------------------------------------------------
TEST(Caps, HaveTheOpacityOfTheirSurface)
{
  // From 1 at the border along x to 4 in the middle.
  const TestVolume<double> volume = TestVolume<double>::Of(
    { 15, 9, 9 }, [](const AnalyticFields::Point& p) { return std::min(p[0], 14.0 - p[0]); });
  const auto traced = ImageField::New(volume.View(), {}, 2);
  const Line line = { { -4.0, 4.25, 4.5 }, { 1.0, 0.0, 0.0 } };
  const auto trace = [&](double skin, double bone, double cut)
  {
    TestRequest request({ { 2.0, skin }, { 4.0, bone } });
    request.Visible.HalfSpaces = { Behind({ 1.0, 0.0, 0.0 }, { cut, 0.0, 0.0 }) };
    Select(*traced, request, 2);
    return NameHits(Trace(*traced, line));
  };
  EXPECT_EQ(trace(0.5, 0.5, 1.0), "sbbs");
  EXPECT_EQ(trace(0.5, 0.5, 3.0), "Sbbs");
  EXPECT_EQ(trace(0.5, 0.5, 5.0), "Bbs");
  EXPECT_EQ(trace(0.5, 1.0, 3.0), "Sb");
  EXPECT_EQ(trace(0.5, 1.0, 5.0), "B");
  EXPECT_EQ(trace(1.0, 0.5, 3.0), "S");
  EXPECT_EQ(trace(1.0, 0.5, 5.0), "Bbs");
  // Nothing is left after the second of these.
  EXPECT_EQ(trace(0.99, 0.99, 3.0), "Sb");
  EXPECT_EQ(trace(0.9995, 0.5, 3.0), "S");
}

//------------------------------------------------------------------------------
TEST(Caps, CloseFacesOfTheVolumeThatLieInAPlane)
{
  const TestVolume<double> full({ 9, 8, 7 }, std::vector<double>(504, 1.0));
  const auto traced = ImageField::New(full.View(), {}, 2);
  RandomNumbers random(31);
  for (const double error : { 0.0, 1e-13, 1e-9 })
  {
    TestRequest request({ { 0.0, Glass } });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Vector3 normal = { 0.0, 0.0, 0.0 };
      normal[axis] = 0.1;
      Vector3 last = { 8.0, 7.0, 6.0 };
      last[axis] += random.Uniform(-error, error);
      request.Visible.HalfSpaces.push_back(
        Behind(normal, { random.Uniform(-error, error), error, -error }));
      request.Visible.HalfSpaces.push_back(Behind(normal * -1.0, last));
    }
    Select(*traced, request, 2);
    for (int ray = 0; ray < 1000; ++ray)
    {
      Line line = RandomLine(random, full.Dimensions);
      line.Origin = line.Origin - line.Direction * 20.0;
      const std::vector<Hit> hits = Trace(*traced, line);
      ASSERT_EQ(hits.size(), 2U) << ToText(line);
      EXPECT_TRUE(hits[0].Entering && !hits[1].Entering);
    }
  }
  // A plane outside of the volume cuts nothing.
  TestRequest request({ { 0.0, Glass } });
  request.Visible.HalfSpaces = { Behind({ 1.0, 0.0, 0.0 }, { -1e-5, 0.0, 0.0 }) };
  Select(*traced, request, 2);
  EXPECT_TRUE(Trace(*traced, { { -3.0, 3.5, 3.5 }, { 1.0, 0.1, 0.1 } }).empty());
}

//------------------------------------------------------------------------------
TEST(Caps, HaveTheValuesOfNearestSamples)
{
  const Index3 size = { 14, 15, 16 };
  TestVolume<float> volume = ClosedNoise<float>(size, 8, 0, 4, 0);
  for (float& value : volume.Values)
  {
    value *= 0.7F; // of which a weighted mean of equals may be something else
  }
  const auto low = static_cast<double>(2.0F * 0.7F);
  const auto high = static_cast<double>(3.0F * 0.7F);
  const auto traced = ImageField::New(volume.View(), {}, 2);
  RandomNumbers random(10);
  int found = 0;
  for (int scene = 0; scene < 30; ++scene)
  {
    TestRequest request({ { low, Glass }, { high, Glass } });
    request.Interpolation = Interpolant::Nearest;
    request.Visible.HalfSpaces = { Behind(random.Direction(), { 6.5, 7.0, 7.5 }) };
    Select(*traced, request, 2);
    for (int ray = 0; ray < 100; ++ray)
    {
      for (const Hit& hit : Trace(*traced, RandomLine(random, size)))
      {
        const Vector3 point = traced->GetPointInCells(hit);
        const Index3 nearest = { static_cast<int>(std::lround(point[0])),
          static_cast<int>(std::lround(point[1])), static_cast<int>(std::lround(point[2])) };
        if (hit.Plane != Hit::NoPlane)
        {
          ++found;
          EXPECT_EQ(hit.Value, static_cast<double>(volume.At(nearest)));
          EXPECT_EQ(hit.Surface, hit.Value >= high ? 1 : 0);
        }
      }
    }
  }
  EXPECT_GT(found, 500);
}

//------------------------------------------------------------------------------
/// Half-spaces that end between two layers of boxes show those that they leave.
TEST(Caps, BetweenNearestSamplesHaveTheValueOfTheRemainingOne)
{
  const Index3 size = { 12, 12, 12 };
  const TestVolume<float> volume =
    TestVolume<float>::Of(size, [](const AnalyticFields::Point& p) { return p[2]; });
  const auto traced = ImageField::New(volume.View(), {}, 2);
  RandomNumbers random(12);
  for (const double way : { 1.0, -1.0 })
  {
    TestRequest request({ { -1.0, Glass }, { 5.5, Glass } });
    request.Interpolation = Interpolant::Nearest;
    const double length = way * random.Uniform(0.1, 10.0);
    request.Visible.HalfSpaces = { { { 0.0, 0.0, length }, -5.5 * length, true } };
    Select(*traced, request, 2);
    int found[2] = { 0, 0 };
    for (int ray = 0; ray < 1000; ++ray)
    {
      const std::vector<Hit> hits = Trace(*traced, RandomLine(random, size));
      for (const Hit& hit : hits)
      {
        const bool isCap = hit.Plane != Hit::NoPlane;
        EXPECT_TRUE(isCap) << "a face in the plane is not visible";
        EXPECT_EQ(hit.Value, way > 0.0 ? 6.0 : 5.0);
        EXPECT_EQ(hit.Surface, way > 0.0 ? 1 : 0);
        ++found[hit.Entering ? 1 : 0];
      }
    }
    EXPECT_GT(found[0], 50);
    EXPECT_GT(found[1], 50);
  }
}

//------------------------------------------------------------------------------
TEST(Caps, SkipHiddenAndNonFiniteCells)
{
  const Index3 size = { 9, 9, 9 };
  // From inside to outside between the last two planes.
  TestVolume<float> volume = TestVolume<float>::Of(
    size, [](const AnalyticFields::Point& p) { return p[2] > 7.5 ? -1.0 : 1.0; });
  volume.At({ 2, 2, 2 }) = std::numeric_limits<float>::quiet_NaN();
  std::vector<unsigned char> hidden(8 * 8 * 8, 0);
  hidden[Offset({ 5, 5, 2 }, { 8, 8, 8 })] = 1;
  const auto traced = ImageField::New(volume.View(), {}, 2);
  TestRequest request({ { 0.0, 1.0 } });
  request.Visible.HalfSpaces = { Behind({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, 2.25 }) };
  request.Visible.HiddenCells = hidden.data();
  request.Visible.Regions = { { { { 2.0, 6.0 }, { 2.0, 6.0 }, { 2.0, 6.0 } } },
    CroppingRegions::All & ~(1U << (2 + 3 * 2 + 9 * 1)) };
  for (const Interpolant field : { Interpolant::Trilinear, Interpolant::Nearest })
  {
    request.Interpolation = field;
    Select(*traced, request, 2);
    const auto isClosed = [&traced](double x, double y)
    {
      const std::vector<Hit> hits = Trace(*traced, { { x, y, -2.0 }, { 0.0, 0.0, 1.0 } });
      EXPECT_EQ(hits.size(), 1U);
      const bool isCap = !hits.empty() && hits[0].Plane != Hit::NoPlane;
      EXPECT_EQ(hits.empty() ? 0.0 : hits[0].T, isCap ? 4.25 : 9.5);
      return isCap;
    };
    EXPECT_TRUE(isClosed(4.5, 4.5));
    EXPECT_FALSE(isClosed(5.5, 5.25));
    EXPECT_TRUE(isClosed(6.5, 5.25));
    EXPECT_FALSE(isClosed(6.5, 6.25)); // cropped
    EXPECT_FALSE(isClosed(2.25, 2.25));
    // The cell has no interpolant; the box of its other corner has a value.
    EXPECT_EQ(isClosed(1.25, 1.25), field == Interpolant::Nearest);
    EXPECT_TRUE(isClosed(0.75, 0.75));
  }
}

//------------------------------------------------------------------------------
/// Half-spaces that end in a lattice plane show the cells that they leave, whatever is beyond.
TEST(Caps, InLatticePlanesBelongToTheRemainingCells)
{
  const Index3 size = { 12, 12, 12 };
  RandomNumbers random(13);
  for (const double way : { 1.0, -1.0 })
  {
    TestVolume<float> volume(size, std::vector<float>(Count(size), 1.0F));
    ForEachPlace(size,
      [&](const Index3& i)
      {
        if (way * (i[2] - 6) < 0.0)
        {
          volume.At(i) = std::numeric_limits<float>::quiet_NaN();
        }
      });
    const auto traced = ImageField::New(volume.View(), {}, 2);
    TestRequest request({ { 0.0, Glass } });
    const double length = way * random.Uniform(0.1, 10.0);
    request.Visible.HalfSpaces = { { { 0.0, 0.0, length }, -6.0 * length, true } };
    Select(*traced, request, 2);
    int found = 0;
    for (int ray = 0; ray < 1000; ++ray)
    {
      Line line = RandomLine(random, size);
      line.Direction[2] += line.Direction[2] > 0.0 ? 0.1 : -0.1;
      const double t = (6.0 - line.Origin[2]) / line.Direction[2];
      const Vector3 point = line.Origin + line.Direction * t;
      if (t > 0.0 && std::min(point[0], point[1]) > 0.0 && std::max(point[0], point[1]) < 11.0)
      {
        const std::vector<Hit> hits = Trace(*traced, line);
        ASSERT_EQ(hits.size(), 1U) << ToText(line);
        EXPECT_EQ(traced->GetLattice().GetCell(hits[0])[2], way > 0.0 ? 6 : 5);
        EXPECT_NEAR(hits[0].Parametric[2], way > 0.0 ? 0.0 : 1.0, 1e-9);
        ++found;
      }
    }
    EXPECT_GT(found, 200);
  }
}

//------------------------------------------------------------------------------
TEST(Caps, AreOnlyOnRequestedPlanes)
{
  const TestVolume<double> full({ 8, 8, 8 }, std::vector<double>(512, 1.0));
  const auto traced = ImageField::New(full.View(), {}, 2);
  TestRequest request({ { 0.0, 1.0 } });
  // The second one cuts later, and has none.
  request.Visible.HalfSpaces = { Behind({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, 2.25 }),
    { { 0.0, 0.0, 1.0 }, -3.5 } };
  Select(*traced, request, 2);
  EXPECT_TRUE(Trace(*traced, { { 3.5, 3.25, -1.0 }, { 0.0, 0.1, 1.0 } }).empty());
  request.Visible.HalfSpaces[1].Offset = -1.5;
  Select(*traced, request, 2);
  EXPECT_EQ(Trace(*traced, { { 3.5, 3.25, -1.0 }, { 0.0, 0.1, 1.0 } }).size(), 1U);
}

}
}
