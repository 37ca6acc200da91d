// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Hits with surfaces of the tricubic interpolant are compared with the interpolant itself,
// implemented here in another form (Hermite's, in higher precision) and evaluated at many points of
// each ray; with quadrics, which it reproduces; and with polynomials of known roots.

#include "AllKernels.h"
#include "Image/Cells/TricubicCell.h"
#include "Image/ImageField.h"
#include "Image/Lattice/Ray.h"
#include "Image/Lattice/UnevenPlanes.h"
#include "Math/NonicRoots.h"
#include "Noise.h"
#include "RandomNumbers.h"
#include "RandomPlanes.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestRequest.h"
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

/// Nearly transparent surfaces, so that a ray meets all of them. The last is above all samples.
TestRequest Request(double opacity = 1e-9)
{
  TestRequest request(
    { { 20.0, opacity }, { 50.0, opacity }, { 90.25, opacity }, { 125.0, opacity } });
  request.Interpolation = Interpolant::Tricubic;
  return request;
}

//------------------------------------------------------------------------------
/// The interpolant and its gradient, by definition: cubics in Hermite's form along each axis, with
/// slopes of parabolas.
template <typename T>
class Reference
{
public:
  explicit Reference(const TestVolume<T>& volume, const UnevenPlanes* planes = nullptr)
    : Volume(volume)
    , Planes(planes)
  {
  }

  struct Answer
  {
    long double Value;
    std::array<long double, 3> Gradient;
  };

  Answer At(const std::array<long double, 3>& point) const
  {
    std::array<std::vector<Weight>, 3> weights;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      weights[axis] = this->GetWeights(axis, point[axis]);
    }
    Answer answer = {};
    for (const Weight& z : weights[2])
    {
      for (const Weight& y : weights[1])
      {
        for (const Weight& x : weights[0])
        {
          const auto sample =
            static_cast<long double>(this->Volume.At({ x.Sample, y.Sample, z.Sample }));
          answer.Value += x.Value * y.Value * z.Value * sample;
          answer.Gradient[0] += x.Slope * y.Value * z.Value * sample;
          answer.Gradient[1] += x.Value * y.Slope * z.Value * sample;
          answer.Gradient[2] += x.Value * y.Value * z.Slope * sample;
        }
      }
    }
    return answer;
  }

  Answer At(const Line& line, long double t) const
  {
    std::array<long double, 3> point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = line.Origin[axis] + t * line.Direction[axis];
      point[axis] = std::min(std::max(point[axis], 0.0L), this->Volume.Dimensions[axis] - 1.0L);
    }
    return this->At(point);
  }

private:
  struct Weight
  {
    int Sample;
    long double Value;
    long double Slope;
  };

  long double Crossing(std::size_t axis, int plane) const
  {
    return this->Planes ? this->Planes->Get(axis, plane) : plane;
  }

  std::vector<Weight> GetWeights(std::size_t axis, long double coordinate) const
  {
    const int last = this->Volume.Dimensions[axis] - 1;
    int cell = 0;
    while (cell < last - 1 && this->Crossing(axis, cell + 1) <= coordinate)
    {
      ++cell;
    }
    const long double width = this->Crossing(axis, cell + 1) - this->Crossing(axis, cell);
    const long double t = (coordinate - this->Crossing(axis, cell)) / width;
    const long double s = 1 - t;
    std::vector<Weight> weights;
    const auto add = [&weights](int sample, long double value, long double slope) {
      weights.push_back({ sample, value, slope });
    };
    add(cell, (1 + 2 * t) * s * s, -6 * t * s / width);
    add(cell + 1, t * t * (1 + 2 * s), 6 * t * s / width);
    this->AddSlope(axis, cell, width * t * s * s, s * (s - 2 * t), weights);
    this->AddSlope(axis, cell + 1, -width * t * t * s, -t * (2 * s - t), weights);
    return weights;
  }

  /// Adds a multiple of the slope at a sample: that of the parabola through it and its neighbours,
  /// or of the line to the one neighbour it has.
  void AddSlope(std::size_t axis, int sample, long double value, long double slope,
    std::vector<Weight>& weights) const
  {
    const auto add = [&](int other, long double weight) {
      weights.push_back({ other, weight * value, weight * slope });
    };
    const int last = this->Volume.Dimensions[axis] - 1;
    const long double here = this->Crossing(axis, sample);
    const long double below = sample > 0 ? here - this->Crossing(axis, sample - 1) : 0;
    const long double above = sample < last ? this->Crossing(axis, sample + 1) - here : 0;
    if (below > 0 && above > 0)
    {
      add(sample - 1, -above / (below * (below + above)));
      add(sample, (above - below) / (below * above));
      add(sample + 1, below / (above * (below + above)));
      return;
    }
    const int other = above > 0 ? sample + 1 : sample - 1;
    const long double width = above > 0 ? above : -below;
    add(sample, -1 / width);
    add(other, 1 / width);
  }

  const TestVolume<T>& Volume;
  const UnevenPlanes* Planes;
};

//------------------------------------------------------------------------------
/// What the comparison of rays with the reference found.
struct Compared
{
  int Hits = 0;
  int Points = 0;
};

/// Tests many points of a ray, and both sides of every hit: a surface's hits so far tell on which
/// side of it the ray is. Nothing is compared where the field nearly equals the isovalue, nor
/// nearer to a hit than this.
template <typename T>
void Compare(const Reference<T>& reference, const TestRequest& request, const Ray& ray,
  const Line& line, const std::vector<Hit>& hits, Compared& compared)
{
  const long double near = 1e-8L / Length(line.Direction);
  const long double begin = ray.Base + static_cast<long double>(ray.Begin);
  const long double end = ray.Base + static_cast<long double>(ray.End);
  std::vector<std::vector<Hit>> hitsOf(request.Surfaces.size());
  std::vector<long double> points;
  for (const Hit& hit : hits)
  {
    std::vector<Hit>& own = hitsOf[static_cast<std::size_t>(hit.Surface)];
    if (!own.empty())
    {
      ASSERT_NE(hit.Entering, own.back().Entering) << ToText(line);
      ASSERT_LE(own.back().T, hit.T) << ToText(line);
    }
    own.push_back(hit);
    points.push_back(std::max(hit.T - 2 * near, begin));
    points.push_back(std::min(hit.T + 2 * near, end));
  }
  const int steps = static_cast<int>((end - begin) * Length(line.Direction) * 50) + 2;
  for (int k = 0; k <= steps; ++k)
  {
    points.push_back(begin + (end - begin) * k / steps);
  }
  const long double first = reference.At(line, begin).Value;
  for (const long double t : points)
  {
    const long double value = reference.At(line, t).Value;
    for (std::size_t i = 0; i < hitsOf.size(); ++i)
    {
      const std::vector<Hit>& own = hitsOf[i];
      const long double isovalue = request.Surfaces[i].Isovalue;
      const auto next =
        std::find_if(own.begin(), own.end(), [t](const Hit& hit) { return hit.T > t; });
      const bool isNear = std::any_of(
        own.begin(), own.end(), [t, near](const Hit& hit) { return std::abs(hit.T - t) < near; });
      if (!isNear && std::abs(value - isovalue) > 1e-9L)
      {
        ++compared.Points;
        const bool startsInside = own.empty() ? first >= isovalue : !own.front().Entering;
        const bool isInside = ((next - own.begin()) % 2 == 0) == startsInside;
        ASSERT_EQ(value >= isovalue, isInside) << ToText(line) << " t = " << static_cast<double>(t);
      }
    }
  }
  compared.Hits += static_cast<int>(hits.size());
}

/// Compares the points of hits with those of the ray, and their gradients in the selected mode with
/// the reference, one by one and by packets.
template <typename T>
void CheckPointsAndGradients(const Reference<T>& reference, const ImageField& traced,
  const Line& line, const std::vector<Hit>& hits)
{
  for (const Hit& hit : hits)
  {
    const Vector3 point = traced.GetPoint(hit);
    EXPECT_LE(Length(line.Origin + line.Direction * hit.T - point), 1e-9);
    const auto expected = reference.At(line, hit.T).Gradient;
    const Vector3 gradient = traced.GetGradient(hit, traced.GetRequest().Normals);
    double points[3][RayPacket::Capacity];
    double gradients[3][RayPacket::Capacity];
    traced.GetPointsAndGradients(&hit, 1, traced.GetRequest().Normals, points, gradients);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(gradient[axis], static_cast<double>(expected[axis]), 1e-5) << ToText(line);
      EXPECT_EQ(gradients[axis][0], gradient[axis]);
      EXPECT_EQ(points[axis][0], point[axis]);
    }
  }
}

template <typename T>
Compared CompareRays(const TestVolume<T>& volume, TestRequest request,
  const std::vector<Line>& lines, const ImageSettings& settings = {})
{
  const auto traced = NewTraced(volume, request, settings);
  const Reference<T> reference(volume, request.Planes);
  Compared compared;
  for (const Line& line : lines)
  {
    const auto ray =
      ClipToVolume(line.Origin, line.Direction, 0.0, Infinity, volume.Dimensions, request.Planes);
    if (!ray)
    {
      continue;
    }
    const std::vector<Hit> hits = Trace(*traced, line);
    Compare(reference, request, *ray, line, hits, compared);
    for (const NormalMode mode :
      { NormalMode::InterpolantGradient, NormalMode::CentralDifferences })
    {
      request.Normals = mode;
      Select(*traced, request, 1);
      CheckPointsAndGradients(reference, *traced, line, hits);
    }
  }
  return compared;
}

/// Lines from anywhere, along lattice planes and edges, and through lattice points.
std::vector<Line> ManyLines(RandomNumbers& random, const Index3& dimensions, int count)
{
  std::vector<Line> lines;
  for (int i = 0; i < count; ++i)
  {
    Line line = RandomLine(random, dimensions);
    if (i % 3 == 1)
    {
      line = LatticeLine(random, dimensions);
    }
    else if (i % 3 == 2)
    {
      const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
      line.Direction[axis] = 0.0;
      line.Origin[axis] = random.Integer(0, dimensions[axis] - 1);
    }
    lines.push_back(line);
  }
  return lines;
}

//------------------------------------------------------------------------------
template <typename T>
class Tricubic : public testing::Test
{
};

TYPED_TEST_SUITE(Tricubic, SampleTypes);

TYPED_TEST(Tricubic, SurfacesMatchTheInterpolant)
{
  RandomNumbers random(3);
  const auto volume = Noise<TypeParam>({ 12, 9, 10 }, 5);
  const Compared compared =
    CompareRays(volume, Request(), ManyLines(random, volume.Dimensions, 100));
  EXPECT_GT(compared.Hits, 500);
  EXPECT_GT(compared.Points, 100000);
}

//------------------------------------------------------------------------------
TEST(TricubicRays, HitThinVolumes)
{
  RandomNumbers random(4);
  for (const Index3& size : { Index3{ 2, 2, 2 }, Index3{ 2, 9, 3 }, Index3{ 20, 3, 2 } })
  {
    const auto volume = Noise<float>(size, 8);
    EXPECT_GT(CompareRays(volume, Request(), ManyLines(random, size, 200)).Hits, 50);
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, HitSurfacesOfOvershoots)
{
  // Single samples of 1 among 0: only what overshoots them reaches the isovalues. Some stand where
  // macrocells meet.
  RandomNumbers random(6);
  TestVolume<float> volume({ 40, 19, 21 }, std::vector<float>(40 * 19 * 21, 0.0F));
  for (int i = 0; i < 200; ++i)
  {
    volume.At({ random.Integer(0, 39), random.Integer(0, 18), random.Integer(0, 20) }) = 1.0F;
    volume.At({ 8 * random.Integer(0, 4), 8 * random.Integer(0, 2), 8 * random.Integer(0, 2) }) =
      1.0F;
  }
  for (const std::vector<int>& branching :
    { std::vector<int>{}, { 8, 8 }, { 1 }, { 2, 2, 2 }, { 16, 3 } })
  {
    TestRequest request({ { -0.06, 1e-9 }, { -0.02, 1e-9 }, { 1.001, 1e-9 }, { 1.02, 1e-9 } });
    request.Interpolation = Interpolant::Tricubic;
    const Compared compared = CompareRays(
      volume, request, ManyLines(random, volume.Dimensions, 60), { branching, BrickLayout::Apron });
    EXPECT_GT(compared.Hits, 100);
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, IndependentOfSettings)
{
  const auto volume = Noise<std::int16_t>({ 70, 30, 25 }, 9);
  RandomNumbers random(11);
  std::vector<std::optional<Ray>> rays;
  for (const Line& line : ManyLines(random, volume.Dimensions, 150))
  {
    rays.push_back(ClipToVolume(line.Origin, line.Direction, 0.0, Infinity, volume.Dimensions));
  }
  // And some that go together as packets.
  for (int i = 0; i < 100; ++i)
  {
    rays.push_back(ClipToVolume({ -5.0, 3.0 + 0.1 * i, 4.25 + 0.07 * i },
      { 1.0, 0.02, 0.01 * (i % 7) }, 0.0, Infinity, volume.Dimensions));
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
    TestRequest plain = Request(opacity);
    plain.PacketKernels = nullptr;
    RayHits expected;
    Trace(*NewTraced(volume, plain, all.front()), rays, expected);
    EXPECT_GT(expected.Hits.size(), 200U);
    const auto check = [&](const TestRequest& request, const ImageSettings& settings)
    {
      RayHits hits;
      Trace(*NewTraced(volume, request, settings), rays, hits);
      ASSERT_EQ(hits.First, expected.First);
      for (std::size_t i = 0; i < hits.Hits.size(); ++i)
      {
        EXPECT_TRUE(AreSame(hits.Hits[i], expected.Hits[i])) << i;
      }
    };
    for (const ImageSettings& settings : all)
    {
      TestRequest request = Request(opacity);
      check(request, settings);
      request.Solver = RootSolver::Linear; // which is not used
      request.PacketKernels = nullptr;
      check(request, settings);
    }
    for (const Kernels* kernels : GetKernels())
    {
      TestRequest request = Request(opacity);
      request.PacketKernels = kernels;
      check(request, { { 8, 8 } });
    }
    TestRequest thrifty = Request(opacity);
    thrifty.Budget.CacheBytes = 10000; // for less than all masks
    check(thrifty, { { 8, 8 } });
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, HitQuadricsExactly)
{
  // A ball and a saddle: the interpolant is the field itself, but for the outermost cells.
  const Index3 size = { 12, 12, 12 };
  const Vector3 center = { 5.3, 5.6, 5.45 };
  for (const double sign : { 1.0, -1.0 })
  {
    const auto field = [&center, sign](const AnalyticFields::Point& p)
    {
      return 9.0 - (p[0] - center[0]) * (p[0] - center[0]) -
        (p[1] - center[1]) * (p[1] - center[1]) - sign * (p[2] - center[2]) * (p[2] - center[2]);
    };
    const auto volume = TestVolume<double>::Of(size, field);
    TestRequest request({ { 0.0, 1e-9 } });
    request.Interpolation = Interpolant::Tricubic;
    const auto traced = NewTraced(volume, request);
    RandomNumbers random(15);
    int met = 0;
    for (int i = 0; i < 1000; ++i)
    {
      const Line line = RandomLine(random, size);
      for (const Hit& hit : Trace(*traced, line))
      {
        const Vector3 point = traced->GetPoint(hit);
        const bool isInner = *std::min_element(point.begin(), point.end()) >= 1.0 &&
          *std::max_element(point.begin(), point.end()) <= 10.0;
        if (!isInner)
        {
          continue;
        }
        ++met;
        const Vector3 out = point - center;
        const Vector3 gradient = { -2.0 * out[0], -2.0 * out[1], -2.0 * sign * out[2] };
        EXPECT_NEAR(field(point), 0.0, 1e-8);
        EXPECT_LE(
          Length(traced->GetGradient(hit, NormalMode::InterpolantGradient) - gradient), 1e-12);
        EXPECT_EQ(hit.Entering, Dot(gradient, line.Direction) > 0.0);
      }
    }
    EXPECT_GT(met, 400);
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, DoNotLeakThroughEdgesAndCorners)
{
  // Rays from the middle of a ball, which leave it exactly once, through points where cells meet.
  const Index3 size = { 17, 17, 17 };
  const auto ball = TestVolume<float>::Of(size, AnalyticFields::Sphere{ { 8.0, 8.0, 8.0 }, 5.0 });
  for (const double isovalue : { 0.0, 1.0, 2.0, -1.0 })
  {
    TestRequest request({ { isovalue, 1e-9 } });
    request.Interpolation = Interpolant::Tricubic;
    const auto traced = NewTraced(ball, request);
    ForEachPlace({ 17, 17, 17 },
      [&](const Index3& point)
      {
        const Vector3 direction = { point[0] - 8.0, point[1] - 8.0, point[2] - 8.0 };
        if (Length(direction) == 0.0)
        {
          return;
        }
        for (const double inverse : { 1.0, 1.0 / 3.0, 0.1 })
        {
          const Line line = { { 8.0, 8.0, 8.0 }, direction * inverse };
          const std::vector<Hit> hits = Trace(*traced, line);
          ASSERT_EQ(hits.size(), 1U) << ToText(line);
          EXPECT_FALSE(hits[0].Entering);
          EXPECT_NEAR(hits[0].T * Length(line.Direction), 5.0 - isovalue, 0.05);
        }
      });
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, DoNotLeakThroughSurfacesInFaces)
{
  // Rays through points in faces of cells that the surface passes to within rounding: both cells
  // must agree on them, so that a ray never enters, or leaves, twice in turn.
  const Index3 size = { 9, 8, 10 };
  RandomNumbers random(81);
  TestVolume<double> volume(size, std::vector<double>(Count(size)));
  for (double& value : volume.Values)
  {
    value = random.Uniform(-1.0, 1.0);
  }
  TestRequest request({ { 0.1, 1e-9 } });
  request.Interpolation = Interpolant::Tricubic;
  const auto traced = NewTraced(volume, request);
  const Reference<double> reference(volume);
  int through = 0;
  for (int i = 0; i < 300; ++i)
  {
    Line within = RandomLine(random, size);
    const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
    within.Origin[axis] = random.Integer(1, size[axis] - 2);
    within.Direction[axis] = 0.0;
    for (const Hit& hit : Trace(*traced, within))
    {
      for (int k = 0; k < 20; ++k)
      {
        const Vector3 direction = random.Direction();
        const Line line = { traced->GetPoint(hit) - direction * 32.0, direction };
        const std::vector<Hit> hits = Trace(*traced, line);
        for (std::size_t next = 1; next < hits.size(); ++next)
        {
          ASSERT_NE(hits[next].Entering, hits[next - 1].Entering) << ToText(line);
        }
        const auto ray = ClipToVolume(line.Origin, line.Direction, 0.0, Infinity, size);
        const double begin = static_cast<double>(reference.At(line, ray->Base + ray->Begin).Value);
        const double end = static_cast<double>(reference.At(line, ray->Base + ray->End).Value);
        ASSERT_EQ(hits.size() % 2 == 1, (begin >= 0.1) != (end >= 0.1)) << ToText(line);
        ++through;
      }
    }
  }
  EXPECT_GT(through, 3000);
}

//------------------------------------------------------------------------------
TEST(TricubicRays, HitNothingWithinTwoSamplesOfANonFiniteOne)
{
  auto volume = Noise<float>({ 12, 9, 10 }, 31);
  const float none[] = { std::numeric_limits<float>::quiet_NaN(),
    std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity() };
  const auto whole = NewTraced(volume, Request());
  std::vector<std::unique_ptr<ImageField>> holed;
  auto with = volume;
  const Index3 indices[] = { { 3, 4, 5 }, { 8, 2, 2 }, { 6, 6, 7 } };
  for (int i = 0; i < 3; ++i)
  {
    with.At(indices[i]) = none[i];
  }
  RandomNumbers random(32);
  int gone = 0;
  int kept = 0;
  for (const ImageSettings& settings : { ImageSettings{ {} }, ImageSettings{} })
  {
    const auto traced = NewTraced(with, Request(), settings);
    for (int i = 0; i < 200; ++i)
    {
      const Line line = RandomLine(random, volume.Dimensions);
      std::vector<Hit> expected = Trace(*whole, line);
      const std::size_t before = expected.size();
      expected.erase(std::remove_if(expected.begin(), expected.end(),
                       [&indices, &whole](const Hit& hit)
                       {
                         const Index3 cell = whole->GetLattice().GetCell(hit);
                         return std::any_of(indices, indices + 3,
                           [&cell](const Index3& index)
                           {
                             bool isAround = true;
                             for (std::size_t axis = 0; axis < 3; ++axis)
                             {
                               const int offset = index[axis] - cell[axis];
                               isAround = isAround && offset >= -1 && offset <= 2;
                             }
                             return isAround;
                           });
                       }),
        expected.end());
      gone += static_cast<int>(before - expected.size());
      kept += static_cast<int>(expected.size());
      const std::vector<Hit> hits = Trace(*traced, line);
      ASSERT_EQ(hits.size(), expected.size());
      for (std::size_t k = 0; k < hits.size(); ++k)
      {
        EXPECT_TRUE(AreSame(hits[k], expected[k]));
      }
    }
  }
  EXPECT_GT(gone, 300);
  EXPECT_GT(kept, 300);
}

//------------------------------------------------------------------------------
TEST(TricubicRays, UnevenPlanes)
{
  const auto volume = Noise<float>({ 12, 9, 10 }, 41);
  RandomNumbers random(42);
  const UnevenPlanes planes = ShiftedPlanes(random, volume.Dimensions);
  TestRequest request = Request();
  request.Planes = &planes;
  for (const std::vector<int>& branching : { std::vector<int>{}, { 8, 8 }, { 2, 2 } })
  {
    const Compared compared = CompareRays(volume, request,
      ManyLines(random, volume.Dimensions, 150), { branching, BrickLayout::Apron });
    EXPECT_GT(compared.Hits, 500);
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, CoincidentPlanesAreDiscontinuities)
{
  // A field of x that jumps from 4 to 8 where planes 4 and 5 coincide, a straight line on each
  // side.
  const Index3 size = { 10, 5, 5 };
  const auto volume = TestVolume<float>::Of(
    size, [](const AnalyticFields::Point& p) { return p[0] < 4.5 ? p[0] : p[0] + 3.0; });
  const std::vector<double> flat = { 0.0, 1.0, 2.0, 3.0, 4.5, 4.5, 6.0, 7.0, 8.0, 9.0 };
  const std::vector<double> even = { 0.0, 1.0, 2.0, 3.0, 4.0 };
  const UnevenPlanes planes({ flat, even, even });
  // At 8 the wall ends.
  TestRequest request({ { 5.5, 1e-9 }, { 8.0, 1e-9 } });
  request.Interpolation = Interpolant::Tricubic;
  request.Planes = &planes;
  const auto traced = NewTraced(volume, request);
  for (const double direction : { 1.0, -1.0 })
  {
    const Line line = { { direction > 0.0 ? -1.0 : 10.0, 2.25, 1.75 }, { direction, 0.03, 0.01 } };
    const std::vector<Hit> hits = Trace(*traced, line);
    ASSERT_EQ(hits.size(), 2U);
    for (const Hit& hit : hits)
    {
      EXPECT_NEAR(traced->GetPoint(hit)[0], 4.5, 1e-12);
      EXPECT_EQ(hit.Entering, direction > 0.0);
      const Vector3 gradient = traced->GetGradient(hit, NormalMode::CentralDifferences);
      EXPECT_LE(Length(gradient - Vector3{ 4.0, 0.0, 0.0 }), 1e-9);
    }
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, PlanesAndInterpolantCanChange)
{
  const auto volume = Noise<float>({ 12, 9, 10 }, 51);
  RandomNumbers random(52);
  const std::vector<Line> lines = ManyLines(random, volume.Dimensions, 100);
  const auto changing = ImageField::New(volume.View(), {}, 1);
  std::array<std::vector<double>, 3> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < volume.Dimensions[axis]; ++i)
    {
      coordinates[axis].push_back(i);
    }
  }
  std::optional<UnevenPlanes> planes;
  struct Turn
  {
    Interpolant Interpolation;
    double Shift;
    double Isovalue;
  };
  for (const Turn& turn :
    { Turn{ Interpolant::Trilinear, 0.0, 20.0 }, { Interpolant::Tricubic, 0.0, 20.0 },
      { Interpolant::Trilinear, 0.0, -5.0 }, { Interpolant::Tricubic, 0.0, -5.0 },
      { Interpolant::Tricubic, 0.9, -5.0 }, { Interpolant::Tricubic, -0.9, -5.0 },
      { Interpolant::Trilinear, -0.9, 20.0 }, { Interpolant::Tricubic, -0.9, 20.0 },
      { Interpolant::Nearest, 0.0, -5.0 }, { Interpolant::Tricubic, 0.0, -5.0 } })
  {
    coordinates[1][4] = 4.0 + turn.Shift;
    planes.emplace(coordinates); // at the same address
    TestRequest request = Request();
    request.Surfaces = { { turn.Isovalue, 1e-9 } };
    request.Interpolation = turn.Interpolation;
    request.Planes = turn.Shift == 0.0 ? nullptr : &*planes;
    Select(*changing, request, 1);
    const auto fresh = NewTraced(volume, request);
    for (const Line& line : lines)
    {
      const std::vector<Hit> hits = Trace(*changing, line);
      const std::vector<Hit> expected = Trace(*fresh, line);
      ASSERT_EQ(hits.size(), expected.size());
      for (std::size_t i = 0; i < hits.size(); ++i)
      {
        EXPECT_TRUE(AreSame(hits[i], expected[i]));
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, HitSurfacesThatOnlyOtherPlanesHave)
{
  // A layer of 1 among 0. Where it is near to the next, the steep slope there makes the interpolant
  // overshoot 1 before it.
  const Index3 size = { 9, 9, 9 };
  const auto volume = TestVolume<float>::Of(
    size, [](const AnalyticFields::Point& p) { return p[1] == 4.0 ? 1.0 : 0.0; });
  std::array<std::vector<double>, 3> coordinates;
  for (int i = 0; i < 9; ++i)
  {
    coordinates[0].push_back(i);
    coordinates[1].push_back(i == 4 ? 4.9 : i);
    coordinates[2].push_back(i);
  }
  const UnevenPlanes planes(coordinates);
  TestRequest request({ { 2.0, 1e-9 } });
  request.Interpolation = Interpolant::Tricubic;
  const auto traced = NewTraced(volume, request);
  const Line line = { { 4.3, -2.0, 4.2 }, { 0.01, 1.0, 0.02 } };
  EXPECT_TRUE(Trace(*traced, line).empty());
  request.Planes = &planes;
  Select(*traced, request, 1);
  EXPECT_EQ(Trace(*traced, line).size(), 2U);
  request.Planes = nullptr;
  Select(*traced, request, 1);
  EXPECT_TRUE(Trace(*traced, line).empty());
}

//------------------------------------------------------------------------------
TEST(TricubicRays, RespectCroppingAndClipping)
{
  const auto volume = Noise<double>({ 12, 13, 14 }, 21);
  const auto whole = NewTraced(volume, Request());
  RandomNumbers random(22);
  int shown = 0;
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
    const auto traced = NewTraced(volume, request);
    for (int ray = 0; ray < 10; ++ray)
    {
      const Line line = RandomLine(random, volume.Dimensions);
      std::vector<Hit> expected;
      for (const Hit& hit : Trace(*whole, line))
      {
        const Vector3 point = whole->GetPoint(hit);
        const bool isVisible = visible.Shows(hit, point) &&
          std::all_of(visible.HalfSpaces.begin(), visible.HalfSpaces.end(),
            [&point](const HalfSpace& half)
            { return Dot(half.Normal, point) + half.Offset >= 0.0; });
        if (isVisible && (i % 2 == 0 || expected.empty()))
        {
          expected.push_back(hit);
        }
      }
      const std::vector<Hit> hits = Trace(*traced, line);
      ASSERT_EQ(hits.size(), expected.size());
      for (std::size_t k = 0; k < hits.size(); ++k)
      {
        EXPECT_NEAR(hits[k].T, expected[k].T, 1e-9);
        EXPECT_EQ(hits[k].Cell, expected[k].Cell);
        EXPECT_EQ(hits[k].Surface, expected[k].Surface);
      }
      shown += static_cast<int>(hits.size());
    }
  }
  EXPECT_GT(shown, 1000);
}

//------------------------------------------------------------------------------
TEST(TricubicRays, SamplesOfAllMagnitudes)
{
  // Largest and smallest numbers: the same hits as with ordinary ones.
  const auto volume = Noise<double>({ 12, 9, 10 }, 61);
  RandomNumbers random(62);
  const std::vector<Line> lines = ManyLines(random, volume.Dimensions, 100);
  const auto ordinary = NewTraced(volume, Request());
  for (const double factor : { 0x1p1015, 0x1p-1000 })
  {
    auto scaled = volume;
    std::for_each(
      scaled.Values.begin(), scaled.Values.end(), [factor](double& value) { value *= factor; });
    TestRequest request = Request();
    for (Isosurface& surface : request.Surfaces)
    {
      surface.Isovalue *= factor;
    }
    const auto traced = NewTraced(scaled, request);
    for (const Line& line : lines)
    {
      const std::vector<Hit> hits = Trace(*traced, line);
      const std::vector<Hit> expected = Trace(*ordinary, line);
      ASSERT_EQ(hits.size(), expected.size());
      for (std::size_t i = 0; i < hits.size(); ++i)
      {
        EXPECT_NEAR(hits[i].T, expected[i].T, 1e-8);
        EXPECT_EQ(hits[i].Surface, expected[i].Surface);
        const Vector3 off =
          Normalized(traced->GetGradient(hits[i], NormalMode::CentralDifferences)) -
          Normalized(ordinary->GetGradient(expected[i], NormalMode::CentralDifferences));
        EXPECT_LE(Length(off), 1e-9) << ToText(line);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(TricubicRays, SamplesWithLargeOffset)
{
  // All differences are exact: the same hits and gradients as without it.
  auto volume = Noise<double>({ 12, 9, 10 }, 63);
  auto shifted = volume;
  constexpr double offset = 0x1p50;
  for (std::size_t i = 0; i < volume.Values.size(); ++i)
  {
    volume.Values[i] = std::round(volume.Values[i]);
    shifted.Values[i] = volume.Values[i] + offset;
  }
  TestRequest request = Request();
  const auto ordinary = NewTraced(volume, request);
  for (Isosurface& surface : request.Surfaces)
  {
    surface.Isovalue += offset;
  }
  const auto traced = NewTraced(shifted, request);
  RandomNumbers random(64);
  std::size_t found = 0;
  for (const Line& line : ManyLines(random, volume.Dimensions, 100))
  {
    const std::vector<Hit> hits = Trace(*traced, line);
    ASSERT_TRUE(AreSame(hits, Trace(*ordinary, line))) << ToText(line);
    found += hits.size();
    const int count = static_cast<int>(std::min<std::size_t>(hits.size(), RayPacket::Capacity));
    double points[3][RayPacket::Capacity];
    double gradients[3][RayPacket::Capacity];
    traced->GetPointsAndGradients(
      hits.data(), count, NormalMode::CentralDifferences, points, gradients);
    for (int i = 0; i < count; ++i)
    {
      const Hit& hit = hits[static_cast<std::size_t>(i)];
      const Vector3 expected = ordinary->GetGradient(hit, NormalMode::CentralDifferences);
      EXPECT_EQ(traced->GetGradient(hit, NormalMode::CentralDifferences), expected);
      EXPECT_EQ((Vector3{ gradients[0][i], gradients[1][i], gradients[2][i] }), expected);
    }
  }
  EXPECT_GT(found, 500U);
}

//------------------------------------------------------------------------------
/// The polynomial with the given roots, by products in Bernstein form in higher precision.
BernsteinNonic WithRoots(const std::vector<long double>& roots, long double factor)
{
  std::vector<long double> b = { factor };
  const auto raise = [&b](long double atBegin, long double atEnd)
  {
    // Times the linear function from one value to the other.
    const std::size_t degree = b.size();
    std::vector<long double> product(degree + 1);
    for (std::size_t i = 0; i < product.size(); ++i)
    {
      const long double share = static_cast<long double>(i) / static_cast<long double>(degree);
      product[i] =
        (i < degree ? (1 - share) * atBegin * b[i] : 0) + (i > 0 ? share * atEnd * b[i - 1] : 0);
    }
    b = product;
  };
  for (const long double root : roots)
  {
    raise(-root, 1 - root);
  }
  while (b.size() < 10)
  {
    raise(1, 1);
  }
  BernsteinNonic nonic;
  std::transform(b.begin(), b.end(), nonic.begin(),
    [](long double value) { return static_cast<double>(value); });
  return nonic;
}

std::vector<double> FindRoots(const BernsteinNonic& nonic)
{
  std::vector<double> roots;
  bool isInside = IsInside(nonic.front());
  Nonic::ForEachRoot(nonic,
    [&roots, &isInside](double u, bool entering)
    {
      EXPECT_NE(entering, isInside);
      isInside = entering;
      roots.push_back(u);
      return false;
    });
  EXPECT_EQ(isInside, IsInside(nonic.back()));
  return roots;
}

TEST(NonicRoots, RootsOfProducts)
{
  RandomNumbers random(71);
  for (int i = 0; i < 3000; ++i)
  {
    std::vector<long double> roots(static_cast<std::size_t>(random.Integer(0, 9)));
    for (long double& root : roots)
    {
      root = random.Uniform(-0.5, 1.5);
    }
    std::vector<long double> within;
    std::copy_if(roots.begin(), roots.end(), std::back_inserter(within),
      [](long double root) { return root > 0 && root < 1; });
    std::sort(within.begin(), within.end());
    double nearest = 1.0;
    for (std::size_t k = 1; k < within.size(); ++k)
    {
      nearest = std::min(nearest, static_cast<double>(within[k] - within[k - 1]));
    }
    if (nearest < 0.02)
    {
      continue; // the coefficients do not say where they are
    }
    const std::vector<double> found =
      FindRoots(WithRoots(roots, random.Integer(0, 1) == 0 ? 1 : -3));
    ASSERT_EQ(found.size(), within.size());
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      EXPECT_NEAR(found[k], static_cast<double>(within[k]), 1e-6);
    }
  }
}

TEST(NonicRoots, PairsOfCloseRoots)
{
  for (const double distance : { 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7 })
  {
    for (const double u : { 0.1, 0.3, 0.5, 0.77 })
    {
      const std::vector<double> found =
        FindRoots(WithRoots({ u, u + static_cast<long double>(distance) }, 1));
      ASSERT_EQ(found.size(), 2U) << u << " " << distance;
      EXPECT_NEAR(found[0], u, 0.1 * distance);
      EXPECT_NEAR(found[1], u + distance, 0.1 * distance);
      // What does not reach zero has none.
      BernsteinNonic above = WithRoots({ u, u + static_cast<long double>(distance) }, 1);
      for (double& coefficient : above)
      {
        coefficient += 0.26 * distance * distance;
      }
      EXPECT_TRUE(FindRoots(above).empty()) << u << " " << distance;
    }
  }
}

TEST(NonicRoots, TerminatesAtMultipleRoots)
{
  for (const int multiplicity : { 2, 3, 4, 5, 9 })
  {
    for (const long double u : { 0.0L, 0.2L, 0.5L, 1.0L })
    {
      const std::vector<double> found = FindRoots(
        WithRoots(std::vector<long double>(static_cast<std::size_t>(multiplicity), u), 1));
      for (const double root : found)
      {
        EXPECT_NEAR(root, static_cast<double>(u), 0.05);
      }
    }
  }
  EXPECT_TRUE(FindRoots(BernsteinNonic{}).empty());
}

}
}
