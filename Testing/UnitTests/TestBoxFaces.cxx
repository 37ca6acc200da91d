// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The faces between boxes of samples that rays meet are compared with those found by testing every
// face of the volume in higher precision, and, where rays pass through edges and corners of boxes,
// with a traversal from box to box in exact arithmetic. Neither knows of cells.

#include "Image/ImageField.h"
#include "Image/Lattice/Ray.h"
#include "Image/Lattice/UnevenPlanes.h"
#include "Noise.h"
#include "RandomNumbers.h"
#include "RandomPlanes.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Nearly transparent surfaces, so that a ray meets all of them; one is at a sample.
TestRequest Request(double opacity = 1e-9)
{
  TestRequest request(
    { { 20.0, opacity }, { 50.0, opacity }, { 50.5, opacity }, { 90.25, opacity } });
  request.Interpolation = Interpolant::Nearest;
  return request;
}

/// A crossing of a face, between a sample and the next one along an axis, that is a surface.
struct CrossingT
{
  long double T;
  std::size_t Axis;
  Index3 Lower;
  int Surface;
  bool Entering;
  bool RisesAlongAxis;
};

/// Adds the crossings of a face with all surfaces, in the order of the reference.
template <typename T>
void AddCrossings(const TestVolume<T>& volume, const Line& line, long double t, std::size_t axis,
  const Index3& lower, std::vector<CrossingT>& crossings)
{
  Index3 upper = lower;
  ++upper[axis];
  const auto below = static_cast<double>(volume.At(lower));
  const auto above = static_cast<double>(volume.At(upper));
  if (!std::isfinite(below) || !std::isfinite(above))
  {
    return;
  }
  const std::vector<Isosurface> surfaces = Request().Surfaces;
  const bool isRising = (below < above) == (line.Direction[axis] > 0.0);
  std::vector<CrossingT> own;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    if ((below >= surfaces[i].Isovalue) != (above >= surfaces[i].Isovalue))
    {
      own.push_back({ t, axis, lower, static_cast<int>(i), isRising, below < above });
    }
  }
  if (!isRising)
  {
    std::reverse(own.begin(), own.end());
  }
  crossings.insert(crossings.end(), own.begin(), own.end());
}

/// Where the box of a sample ends along an axis, at its upper side.
long double GetEnd(const Index3& size, const UnevenPlanes* planes, std::size_t axis, int sample)
{
  if (sample < 0 || sample >= size[axis] - 1)
  {
    return sample < 0 ? 0.0L : size[axis] - 1.0L;
  }
  return planes
    ? (planes->Get(axis, sample) + static_cast<long double>(planes->Get(axis, sample + 1))) / 2
    : sample + 0.5L;
}

/// All crossings of a line, by testing every face. Nothing is returned where the line comes so near
/// to an edge of a box that this cannot decide.
template <typename T>
std::optional<std::vector<CrossingT>> TestEveryFace(
  const TestVolume<T>& volume, const Line& line, const UnevenPlanes* planes = nullptr)
{
  const Index3& size = volume.Dimensions;
  std::vector<CrossingT> crossings;
  bool isClear = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (line.Direction[axis] == 0.0)
    {
      continue;
    }
    Index3 faces = volume.Dimensions;
    --faces[axis];
    ForEachPlace(faces,
      [&](const Index3& lower)
      {
        const long double t = (GetEnd(size, planes, axis, lower[axis]) - line.Origin[axis]) /
          static_cast<long double>(line.Direction[axis]);
        bool isHit = t > 0.0L;
        bool isNear = std::abs(t) < 1e-9L;
        for (std::size_t other = 0; other < 3; ++other)
        {
          if (other == axis)
          {
            continue;
          }
          const long double coordinate = line.Origin[other] + t * line.Direction[other];
          const long double begin = GetEnd(size, planes, other, lower[other] - 1);
          const long double end = GetEnd(size, planes, other, lower[other]);
          const bool isParallel = line.Direction[other] == 0.0;
          isNear = isNear ||
            (!isParallel &&
              std::min(std::abs(coordinate - begin), std::abs(coordinate - end)) < 1e-9L);
          isHit = isHit && coordinate >= begin && coordinate <= end;
        }
        isClear = isClear && !(isHit && isNear);
        if (isHit)
        {
          AddCrossings(volume, line, t, axis, lower, crossings);
        }
      });
  }
  std::stable_sort(crossings.begin(), crossings.end(),
    [](const CrossingT& a, const CrossingT& b) { return a.T < b.T; });
  return isClear ? std::optional(crossings) : std::nullopt;
}

/// Where a line crosses a plane between boxes.
struct PlaneCrossing
{
  double T;
  std::size_t Axis;
};

/// The same by a traversal from box to box. Planes crossed at the same t are crossed in the order
/// x, y, z. Exact where origins are halves of whole numbers, and directions 0, 1 or 2 along an
/// axis. Nothing is returned where a plane is crossed just where the line enters or leaves the
/// volume.
template <typename T>
std::optional<std::vector<CrossingT>> TraverseBoxes(const TestVolume<T>& volume, const Line& line)
{
  std::vector<PlaneCrossing> planes;
  Index3 box = {};
  double entry = 0.0;
  double exit = Infinity;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double origin = line.Origin[axis];
    const double direction = line.Direction[axis];
    const int last = volume.Dimensions[axis] - 1;
    if (direction == 0.0)
    {
      box[axis] = std::min(static_cast<int>(std::floor(origin + 0.5)), last);
      exit = origin < 0.0 || origin > last ? -1.0 : exit;
      continue;
    }
    box[axis] = direction > 0.0 ? 0 : last;
    for (int k = 0; k < last; ++k)
    {
      const double t = (k + 0.5 - origin) / direction;
      planes.push_back({ t, axis });
    }
    const double ends[2] = { -origin / direction, (last - origin) / direction };
    entry = std::max(entry, std::min(ends[0], ends[1]));
    exit = std::min(exit, std::max(ends[0], ends[1]));
  }
  std::sort(planes.begin(), planes.end(),
    [](const PlaneCrossing& a, const PlaneCrossing& b)
    { return a.T != b.T ? a.T < b.T : a.Axis < b.Axis; });
  std::vector<CrossingT> crossings;
  for (const PlaneCrossing& plane : planes)
  {
    if (plane.T > 0.0 && (plane.T == entry || plane.T == exit))
    {
      return std::nullopt;
    }
    Index3 lower = box;
    box[plane.Axis] += line.Direction[plane.Axis] > 0.0 ? 1 : -1;
    lower[plane.Axis] = std::min(lower[plane.Axis], box[plane.Axis]);
    if (plane.T > entry && plane.T < exit)
    {
      AddCrossings(volume, line, plane.T, plane.Axis, lower, crossings);
    }
  }
  return crossings;
}

void Compare(ImageField& traced, const Line& line, const std::vector<Hit>& hits,
  const std::vector<CrossingT>& expected, double tolerance)
{
  ASSERT_EQ(hits.size(), expected.size()) << ToText(line);
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    const Hit& hit = hits[i];
    const Index3 cell = traced.GetLattice().GetCell(hit);
    const CrossingT& crossing = expected[i];
    EXPECT_NEAR(hit.T, static_cast<double>(crossing.T), tolerance) << ToText(line);
    EXPECT_EQ(hit.Surface, crossing.Surface) << ToText(line);
    EXPECT_EQ(hit.Entering, crossing.Entering) << ToText(line);
    EXPECT_EQ(hit.Parametric[crossing.Axis], 0.5) << ToText(line);
    const Vector3 onRay = line.Origin + line.Direction * hit.T;
    EXPECT_LE(Length(onRay - traced.GetPoint(hit)), 1e-9) << ToText(line);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // The sample inside; along the plane it is the nearest, where one is nearest.
      const int nearest = cell[axis] + (hit.IsNearUpper(axis) ? 1 : 0);
      const bool isBetween = std::abs(hit.Parametric[axis] - 0.5) < 1e-5;
      if (axis == crossing.Axis)
      {
        EXPECT_EQ(cell[axis], crossing.Lower[axis]) << ToText(line);
        EXPECT_EQ(nearest, crossing.Lower[axis] + (crossing.RisesAlongAxis ? 1 : 0));
      }
      else if (!isBetween)
      {
        EXPECT_EQ(nearest, crossing.Lower[axis]) << ToText(line);
      }
    }
    Vector3 gradient = { 0.0, 0.0, 0.0 };
    gradient[crossing.Axis] = crossing.RisesAlongAxis ? 1.0 : -1.0;
    EXPECT_EQ(traced.GetGradient(hit, NormalMode::InterpolantGradient), gradient) << ToText(line);
    EXPECT_EQ(traced.GetGradient(hit, NormalMode::CentralDifferences), gradient) << ToText(line);
    double points[3][RayPacket::Capacity];
    double gradients[3][RayPacket::Capacity];
    traced.GetPointsAndGradients(&hit, 1, traced.GetRequest().Normals, points, gradients);
    EXPECT_EQ((Vector3{ gradients[0][0], gradients[1][0], gradients[2][0] }), gradient);
  }
}

/// A line from a point at halves of whole numbers, through edges and corners of boxes and cells.
Line HalfLatticeLine(RandomNumbers& random, const Index3& dimensions)
{
  Line line = LatticeLine(random, dimensions);
  for (double& coordinate : line.Origin)
  {
    coordinate += 0.5 * random.Integer(0, 1);
  }
  return line;
}

/// A line along an axis, or across one.
Line FlatLine(RandomNumbers& random, const Index3& dimensions)
{
  Line line = RandomLine(random, dimensions);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (random.Integer(0, 1) == 0)
    {
      line.Direction[axis] = 0.0;
      line.Origin[axis] = random.Integer(0, 1) == 0
        ? random.Integer(0, dimensions[axis] - 1)
        : random.PointInBox({ 0.0, 0.0, 0.0 },
            { dimensions[0] - 1.0, dimensions[1] - 1.0, dimensions[2] - 1.0 })[axis];
    }
  }
  return line;
}

//------------------------------------------------------------------------------
template <typename T>
class BoxFaces : public testing::Test
{
};

TYPED_TEST_SUITE(BoxFaces, SampleTypes);

TYPED_TEST(BoxFaces, RaysHitAllFaces)
{
  RandomNumbers random(3);
  const auto volume = Noise<TypeParam>({ 12, 9, 10 }, 5);
  const auto traced = NewTraced(volume, Request());
  int compared = 0;
  for (int i = 0; i < 400; ++i)
  {
    const Line line =
      i % 2 == 0 ? RandomLine(random, volume.Dimensions) : FlatLine(random, volume.Dimensions);
    if (const auto expected = TestEveryFace(volume, line))
    {
      compared += expected->empty() ? 0 : 1;
      Compare(*traced, line, Trace(*traced, line), *expected, 1e-9);
    }
  }
  EXPECT_GT(compared, 250);
}

TYPED_TEST(BoxFaces, RaysThroughEdgesHitOnce)
{
  RandomNumbers random(4);
  const auto volume = Noise<TypeParam>({ 12, 9, 10 }, 6);
  const auto traced = NewTraced(volume, Request());
  int compared = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const Line line = HalfLatticeLine(random, volume.Dimensions);
    if (const auto expected = TraverseBoxes(volume, line))
    {
      compared += expected->empty() ? 0 : 1;
      Compare(*traced, line, Trace(*traced, line), *expected, 0.0);
    }
  }
  EXPECT_GT(compared, 300);
}

//------------------------------------------------------------------------------
TEST(BoxFacesOfRays, IndependentOfSettings)
{
  const auto volume = Noise<std::int16_t>({ 70, 30, 25 }, 9);
  RandomNumbers random(11);
  std::vector<std::optional<Ray>> rays;
  for (int i = 0; i < 400; ++i)
  {
    const Line line = i % 4 == 0 ? HalfLatticeLine(random, volume.Dimensions)
                                 : RandomLine(random, volume.Dimensions);
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
  for (const double opacity : { 1e-9, 0.4, 1.0 })
  {
    // One by one, cell after cell.
    const auto plain = NewTraced(volume, Request(opacity), all.front());
    RayHits expected;
    expected.Clear();
    for (const auto& ray : rays)
    {
      RayHits own;
      Trace(*plain, { ray }, own);
      expected.Append(own);
    }
    EXPECT_GT(expected.Hits.size(), 200U);
    for (const ImageSettings& settings : all)
    {
      for (const RootSolver solver : { RootSolver::Robust, RootSolver::Linear })
      {
        TestRequest request = Request(opacity);
        request.Solver = solver;
        RayHits hits;
        Trace(*NewTraced(volume, request, settings), rays, hits);
        ASSERT_EQ(hits.First, expected.First);
        for (std::size_t i = 0; i < hits.Hits.size(); ++i)
        {
          EXPECT_TRUE(AreSame(hits.Hits[i], expected.Hits[i])) << i;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(BoxFacesOfRays, SkipNonFiniteSamples)
{
  auto volume = Noise<float>({ 12, 9, 10 }, 31);
  RandomNumbers random(32);
  const float none[] = { std::numeric_limits<float>::quiet_NaN(),
    std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity() };
  for (int i = 0; i < 300; ++i)
  {
    volume.At({ random.Integer(0, 11), random.Integer(0, 8), random.Integer(0, 9) }) = none[i % 3];
  }
  const auto traced = NewTraced(volume, Request());
  for (int i = 0; i < 200; ++i)
  {
    const Line line = RandomLine(random, volume.Dimensions);
    if (const auto expected = TestEveryFace(volume, line))
    {
      Compare(*traced, line, Trace(*traced, line), *expected, 1e-9);
    }
  }
}

//------------------------------------------------------------------------------
TEST(BoxFacesOfRays, LieHalfwayBetweenUnevenPlanes)
{
  const auto volume = Noise<float>({ 12, 9, 10 }, 41);
  RandomNumbers random(42);
  const UnevenPlanes planes = ShiftedPlanes(random, volume.Dimensions);
  TestRequest request = Request();
  request.Planes = &planes;
  const auto traced = NewTraced(volume, request);
  int compared = 0;
  for (int i = 0; i < 400; ++i)
  {
    const Line line = RandomLine(random, volume.Dimensions);
    if (const auto expected = TestEveryFace(volume, line, &planes))
    {
      compared += expected->empty() ? 0 : 1;
      Compare(*traced, line, Trace(*traced, line), *expected, 1e-9);
    }
  }
  EXPECT_GT(compared, 300);
}

//------------------------------------------------------------------------------
TEST(BoxFacesOfRays, RespectCroppingAndClipping)
{
  const auto volume = Noise<double>({ 12, 13, 14 }, 21);
  RandomNumbers random(22);
  int visibleHits = 0;
  for (int i = 0; i < 60; ++i)
  {
    TestRequest request = Request(i % 2 == 0 ? 1e-9 : 1.0);
    Visibility& visible = request.Visible;
    std::vector<unsigned char> hidden(11 * 12 * 13);
    if (i % 3 == 0)
    {
      std::generate(hidden.begin(), hidden.end(),
        [&random]() { return static_cast<unsigned char>(random.Integer(0, 1)); });
      visible.HiddenCells = hidden.data();
    }
    else if (i % 3 == 1)
    {
      visible.Regions = { { { { 2.5, 7.25 }, { 3.0, 8.5 }, { 4.125, 9.0 } } },
        static_cast<unsigned int>(random.Bits()) & CroppingRegions::All };
    }
    else
    {
      const Vector3 normal = random.Direction();
      visible.HalfSpaces = { { normal, -Dot(normal, { 5.5, 6.0, 6.5 }) } };
    }
    const auto isHidden = [&](const CrossingT& crossing, const Line& line)
    {
      Vector3 point = line.Origin + line.Direction * static_cast<double>(crossing.T);
      point[crossing.Axis] = crossing.Lower[crossing.Axis] + 0.5;
      const Index3 cell = { static_cast<int>(point[0]), static_cast<int>(point[1]),
        static_cast<int>(point[2]) };
      return (visible.HiddenCells && hidden[Offset(cell, { 11, 12, 13 })] != 0) ||
        !visible.Regions.Contain(point) ||
        (!visible.HalfSpaces.empty() &&
          Dot(visible.HalfSpaces[0].Normal, point) + visible.HalfSpaces[0].Offset < 0.0);
    };
    const auto traced = NewTraced(volume, request);
    for (int ray = 0; ray < 10; ++ray)
    {
      const Line line = RandomLine(random, volume.Dimensions);
      auto expected = TestEveryFace(volume, line);
      if (!expected)
      {
        continue;
      }
      expected->erase(std::remove_if(expected->begin(), expected->end(),
                        [&](const CrossingT& crossing) { return isHidden(crossing, line); }),
        expected->end());
      if (i % 2 != 0 && !expected->empty())
      {
        expected->erase(expected->begin() + 1, expected->end());
      }
      visibleHits += static_cast<int>(expected->size());
      Compare(*traced, line, Trace(*traced, line), *expected, 1e-9);
    }
  }
  EXPECT_GT(visibleHits, 1000);
}

//------------------------------------------------------------------------------
TEST(BoxFacesOfRays, BeginAndEndWithTheRay)
{
  const TestVolume<float> ramp =
    TestVolume<float>::Of({ 10, 10, 10 }, AnalyticFields::Plane{ { 10.0, 0.0, 0.0 }, 5.0 });
  // The planes are at 2.5 (20), 5.5 (50, 50.5) and 9.5 (none: it is beyond the last sample).
  const auto traced = NewTraced(ramp, Request());
  const auto countHits = [&traced](double x, double way, double length) {
    return Trace(*traced, { { x, 4.25, 4.75 }, { way, 0.0, 0.0 } }, length).size();
  };
  EXPECT_EQ(countHits(-3.0, 1.0, Infinity), 3U);
  EXPECT_EQ(countHits(12.0, -1.0, Infinity), 3U);
  EXPECT_EQ(countHits(0.0, 1.0, 2.5), 1U);
  EXPECT_EQ(countHits(0.0, 1.0, std::nextafter(2.5, 0.0)), 0U);
  EXPECT_EQ(countHits(2.5, 1.0, 1.0), 0U);
  EXPECT_EQ(countHits(2.5, -1.0, 1.0), 0U);
  EXPECT_EQ(countHits(std::nextafter(2.5, 0.0), 1.0, 1.0), 1U);
}

//------------------------------------------------------------------------------
TEST(BoxFacesOfRays, TrilinearSurfacesAfterNearest)
{
  const TestVolume<float> ramp =
    TestVolume<float>::Of({ 10, 10, 10 }, AnalyticFields::Plane{ { 1.0, 0.0, 0.0 }, 4.25 });
  TestRequest request({ { 0.0, 1.0 } });
  request.Interpolation = Interpolant::Nearest;
  const auto traced = NewTraced(ramp, request);
  const Line line = { { -2.0, 4.5, 4.5 }, { 1.0, 0.0, 0.0 } };
  ASSERT_EQ(Trace(*traced, line).size(), 1U);
  EXPECT_EQ(Trace(*traced, line)[0].T, 6.5);
  request.Interpolation = Interpolant::Trilinear;
  Select(*traced, request, 1);
  ASSERT_EQ(Trace(*traced, line).size(), 1U);
  EXPECT_EQ(Trace(*traced, line)[0].T, 6.25);
  EXPECT_EQ(Trace(*traced, line)[0].Jump, 0);
}

}
}
