// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Everything at once, in any combination: scenes that a seed draws. ATTACK_SCENES says how many
// there are in each test (1000), ATTACK_SEED with which seed they begin (0).

#include "RandomScenes.h"
#include "Tally.h"

#include "Matrices.h"
#include "Picture/RenderTiles.h"
#include "SameBits.h"

#include <gtest/gtest.h>

using namespace HardCases;
using vtkIsosurfaceRayTracing::Frame;
using vtkIsosurfaceRayTracing::ImageField;
using vtkIsosurfaceRayTracing::Scene;
using vtkIsosurfaceRayTracing::SceneField;

namespace
{

/// Visits the random numbers of every seed, up to the first with a failure.
template <typename Visit>
void ForEachSeed(const Visit& visit)
{
  // A line through an edge beside an empty cell: the oracle once followed it beyond that.
  std::vector<std::uint64_t> seeds = { 1597 };
  const std::uint64_t first = GetNumber("ATTACK_SEED", 0);
  for (std::uint64_t i = 0; i < GetNumber("ATTACK_SCENES", 1000); ++i)
  {
    seeds.push_back(first + i);
  }
  for (const std::uint64_t seed : seeds)
  {
    if (!testing::Test::HasFailure())
    {
      RandomNumbers random(seed);
      visit(random);
    }
  }
}

RayHits Cast(
  Tracer& tracer, const std::vector<Line>& lines, const TraceRequest& request, const RandomWay& way)
{
  tracer.GetField().Select(request, way.How, way.Budget);
  return CastRays(tracer.GetField(), ToCastRays(lines), way.How.Threads);
}

/// The hits with one of several surfaces.
RayHits HitsWith(int surface, const RayHits& all)
{
  RayHits hits;
  hits.Clear();
  for (std::size_t ray = 0; ray + 1 < all.First.size(); ++ray)
  {
    std::copy_if(all.Hits.begin() + static_cast<std::ptrdiff_t>(all.First[ray]),
      all.Hits.begin() + static_cast<std::ptrdiff_t>(all.First[ray + 1]),
      std::back_inserter(hits.Hits), [surface](const Hit& hit) { return hit.Surface == surface; });
    hits.EndRay();
  }
  return hits;
}

/// A picture of the field from somewhere, shaded in some way.
Scene DrawPicture(RandomNumbers& random, const RandomScene& drawn)
{
  using namespace vtkIsosurfaceRayTracing;
  constexpr double size = 24.0;
  const Triple at = random.PointInVolume(drawn.Samples.Dimensions);
  const Matrix4 turned =
    Multiply(Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0)), Translation(at * -1.0));
  const Matrix4 lens = random.Integer(0, 1)
    ? Perspective(random.Uniform(0.1, 10.0), 60.0, random.Uniform(0.1, 1.0))
    : Orthographic(1.0, 60.0, random.Uniform(1.0, 10.0));
  const Matrix4 view =
    Multiply(lens, Multiply(Translation({ 0.0, 0.0, random.Uniform(-30.0, -1.0) }), turned));

  SceneField field;
  field.View = { view, Invert(view), Scaling({ 1.0, 1.0, 1.0 }), size, size };
  field.Colors = { { 1.0, 0.5, 0.2 }, { 0.1, 0.9, 0.3 }, { 0.2, 0.3, 1.0 } };
  field.Surface.Shade = random.Integer(0, 3) != 0;
  Scene scene;
  scene.Fields = { field };
  scene.Pixels = { 0, 0, static_cast<int>(size), static_cast<int>(size) };
  scene.Lights = std::vector<Light>(static_cast<std::size_t>(random.Integer(0, 2)));
  for (Light& light : scene.Lights)
  {
    light.Direction = random.Direction();
    light.Position = random.PointInVolume(drawn.Samples.Dimensions) * 3.0;
    light.Positional = random.Integer(0, 1) == 0;
    light.ConeAngle = random.Uniform(10.0, 180.0);
  }
  scene.TwoSidedLighting = random.Integer(0, 1) == 0;
  scene.Shadows = random.Integer(0, 1) == 0;
  scene.OcclusionRays = random.Integer(-4, 4);
  scene.OcclusionRays = scene.OcclusionRays < 0 ? 0 : scene.OcclusionRays;
  scene.OcclusionRadius = random.Uniform(0.5, 20.0);
  scene.KeepHits = true;
  scene.TileWidth = 8 * random.Integer(1, 4);
  scene.TileHeight = 4 * random.Integer(1, 4);
  return scene;
}

class Gray : public vtkIsosurfaceRayTracing::ValueColors
{
  std::array<double, 4> Get(double value) const override
  {
    const double level = value > 0.0 ? 1.0 : 0.25;
    return { level, level, level, 0.5 };
  }
};

Frame Render(Scene scene, ImageField& field, const TraceRequest& request, const RandomWay& way)
{
  const Gray colors;
  field.Select(request, way.How, way.Budget);
  scene.Fields[0].Field = &field;
  scene.Fields[0].ColorsOfValues = &colors;
  Frame frame;
  vtkIsosurfaceRayTracing::FrameTimes times;
  EXPECT_TRUE(RenderTiles(scene, way.How, frame, times, [](double) { return true; }));
  return frame;
}

}

TEST(TestRandomScenes, HitsOfTheOracle)
{
  Tally tally("random scenes (Robust)");
  ForEachSeed(
    [&tally](RandomNumbers& random)
    {
      const RandomScene scene(random);
      const RandomWay way(random);
      const TraceRequest request(scene.DrawSurfaces(random, Glass));
      Tracer tracer(scene.Samples, way.Settings, scene.Type);
      const RayHits all = Cast(tracer, scene.Lines, request, way);
      const std::size_t before = tally.GetFailures();
      for (std::size_t surface = 0; surface < request.Surfaces.size(); ++surface)
      {
        tally.CheckHits(scene.Samples, request.Surfaces[surface].Isovalue, scene.Lines,
          HitsWith(static_cast<int>(surface), all), RobustGuarantee(scene.Samples.Dimensions),
          tracer);
      }
      EXPECT_EQ(tally.GetFailures(), before) << way.ToText();
    });
  tally.Report();
}

TEST(TestRandomScenes, HitsDoNotDependOnTheWay)
{
  std::size_t hits = 0;
  ForEachSeed(
    [&hits](RandomNumbers& random)
    {
      const RandomScene scene(random);
      const TraceRequest request = scene.DrawRequest(random);
      const RandomWay one(random);
      const RandomWay other(random);
      Tracer tracer(scene.Samples, one.Settings, scene.Type);
      Tracer again(scene.Samples, other.Settings, scene.Type);
      const RayHits expected = Cast(tracer, scene.Lines, request, one);
      EXPECT_TRUE(IsSame(expected, Cast(again, scene.Lines, request, other)))
        << one.ToText() << "; " << other.ToText();
      hits += expected.Hits.size();
    });
  EXPECT_GT(hits, 0U);
}

TEST(TestRandomScenes, PicturesDoNotDependOnTheWay)
{
  std::size_t hits = 0;
  ForEachSeed(
    [&hits](RandomNumbers& random)
    {
      const RandomScene drawn(random);
      const TraceRequest request = drawn.DrawRequest(random);
      const Scene scene = DrawPicture(random, drawn);
      const RandomWay one(random);
      const RandomWay other(random);
      Tracer tracer(drawn.Samples, one.Settings, drawn.Type);
      Tracer again(drawn.Samples, other.Settings, drawn.Type);
      const Frame expected = Render(scene, tracer.GetField(), request, one);
      const Frame frame = Render(scene, again.GetField(), request, other);
      EXPECT_EQ(expected.Colors, frame.Colors) << one.ToText() << "; " << other.ToText();
      EXPECT_EQ(expected.Depths, frame.Depths) << one.ToText() << "; " << other.ToText();
      EXPECT_TRUE(AreSame(expected.Hits, frame.Hits)) << one.ToText() << "; " << other.ToText();
      hits += static_cast<std::size_t>(std::count_if(expected.Hits.begin(), expected.Hits.end(),
        [](const Hit& hit) { return hit.Surface != Hit::NoSurface; }));
    });
  EXPECT_GT(hits, 0U);
}
