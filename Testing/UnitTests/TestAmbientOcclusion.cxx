// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The openness of the sky above a surface, compared with geometry: a sum over a fine grid of
// directions that shares no code with what is tested.

#include "Image/ImageField.h"
#include "Matrices.h"
#include "OneFieldScene.h"
#include "Picture/Hemisphere.h"
#include "Picture/SecondaryRays.h"
#include "Picture/Shader.h"
#include "RandomNumbers.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int Edge = 41;

/// A floor at z = 4.5 that ends at a wall at x = 4.5, which is as high and as long as the volume.
double Corner(const AnalyticFields::Point& p)
{
  return std::max(4.5 - p[2], 4.5 - p[0]);
}

double Floor(const AnalyticFields::Point& p)
{
  return 4.5 - p[2];
}

/// A scene in a world that is twice as high as the volume.
struct OpenScene
{
  template <typename Field>
  explicit OpenScene(const Field& field, double opacity = 1.0)
    : Volume(TestVolume<double>::Of({ Edge, Edge, Edge }, field))
    , Traced(ImageField::New(this->Volume.View(), {}, 1))
  {
    const Matrix4 worldFromIndex = Scaling({ 1.0, 1.0, 2.0 });
    this->TheScene.Shown.View =
      Camera(worldFromIndex, Invert(worldFromIndex), worldFromIndex, 10, 10);
    this->TheScene.Request.Surfaces = { { 0.0, opacity } };
    this->TheScene.Shown.Colors = { { 0.8, 0.5, 0.3 } };
    this->TheScene.Shown.Surface = { true, 0.5, 0.4, 0.0, 1.0 };
    this->TheScene.OcclusionRays = 4096;
    this->TheScene.Show(*this->Traced);
  }

  /// The first hit of a ray.
  Hit Find(const Vector3& origin, const Vector3& direction)
  {
    const std::vector<Hit> hits = Trace(*this->Traced, { origin, direction });
    EXPECT_FALSE(hits.empty());
    return hits.at(0);
  }

  double FindAmbientTransmittance(const Hit& hit) const
  {
    LightAtHits ambient;
    SecondaryRays(this->TheScene, 0).FindAmbient(&hit, 1, ambient);
    return ambient.Parts[0];
  }

  TestVolume<double> Volume;
  std::unique_ptr<ImageField> Traced;
  OneFieldScene TheScene;
};

/// The part of the sky above z that is transmitted, given the transmittance of each direction.
double Integrate(const std::function<double(const Vector3&)>& share)
{
  constexpr int steps = 1500;
  constexpr double twoPi = 6.28318530717958647693;
  double sum = 0.0;
  for (int ring = 0; ring < steps; ++ring)
  {
    const double square = (ring + 0.5) / steps;
    for (int i = 0; i < steps; ++i)
    {
      const double angle = twoPi * (i + 0.5) / steps;
      sum += share({ std::sqrt(square) * std::cos(angle), std::sqrt(square) * std::sin(angle),
        std::sqrt(1.0 - square) });
    }
  }
  return sum / steps / steps;
}

/// Whether a line from the floor, at a distance from the wall, meets the wall in the volume before
/// a length is over. All of it is in the world.
bool MeetsWall(const Vector3& direction, double distance, double length)
{
  const double t = -distance / direction[0];
  return direction[0] < 0.0 && t <= length && std::abs(t * direction[1]) <= 0.5 * (Edge - 1) &&
    t * direction[2] <= 2.0 * (Edge - 1 - 4.5);
}

//------------------------------------------------------------------------------
TEST(AmbientOcclusion, PlaneIsNotOccluded)
{
  OpenScene scene(Floor);
  for (const double slant : { 0.0, 0.3, -0.4 })
  {
    EXPECT_EQ(
      scene.FindAmbientTransmittance(scene.Find({ 20.0, 20.0, 45.0 }, { slant, 0.1, -1.0 })), 1.0);
    // From below it is open as well, on the visible side.
    EXPECT_EQ(
      scene.FindAmbientTransmittance(scene.Find({ 20.0, 20.0, -5.0 }, { slant, 0.1, 1.0 })), 1.0);
  }
}

//------------------------------------------------------------------------------
TEST(AmbientOcclusion, HalfInACorner)
{
  OpenScene scene(Corner);
  for (const double distance : { 1.0, 3.0, 10.0, 25.0 })
  {
    const Hit hit = scene.Find({ 4.5 + distance, 20.0, 45.0 }, { 0.0, 0.0, -1.0 });
    for (const double radius : { Infinity, 12.0, 0.5 })
    {
      scene.TheScene.OcclusionRadius = radius;
      const double expected = 1.0 -
        Integrate([distance, radius](const Vector3& direction)
          { return MeetsWall(direction, distance, radius) ? 1.0 : 0.0; });
      EXPECT_NEAR(scene.FindAmbientTransmittance(hit), expected, 0.004)
        << distance << " " << radius;
      if (distance == 1.0 && radius == Infinity)
      {
        EXPECT_NEAR(expected, 0.5, 0.02);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(AmbientOcclusion, TranslucentSurfacesOccludeByTheirOpacity)
{
  OpenScene scene(Corner, 0.4);
  const Hit hit = scene.Find({ 7.5, 20.0, 45.0 }, { 0.0, 0.0, -1.0 });
  const double hidden = Integrate(
    [](const Vector3& direction) { return MeetsWall(direction, 3.0, Infinity) ? 1.0 : 0.0; });
  EXPECT_NEAR(scene.FindAmbientTransmittance(hit), 1.0 - 0.4 * hidden, 0.002);
}

//------------------------------------------------------------------------------
TEST(AmbientOcclusion, AffectsOnlyTheAmbientTerm)
{
  OpenScene scene(Corner);
  scene.TheScene.Lights = { Light() };
  const Hit hit = scene.Find({ 6.0, 20.0, 45.0 }, { 0.0, 0.0, -1.0 });
  const Shader shader(scene.TheScene, 0, scene.TheScene.Request.PacketKernels);
  const Vector3 direction = { 0.0, 0.0, -1.0 };
  const Vector3 open = shader.Shade(hit, direction);
  const Vector3 closed = shader.Shade(hit, direction, { 0.25 });
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double ambient = 0.5 * scene.TheScene.Shown.Colors[0][i];
    EXPECT_NEAR(open[i] - closed[i], 0.75 * ambient, 1e-12);
    EXPECT_GT(closed[i], 0.3 * scene.TheScene.Shown.Colors[0][i]);
  }

  // The fragments of a packet of rays have it as well.
  RayPacket packet;
  packet.Count = 0;
  packet.Exists = {};
  scene.Traced->AddRay({ 6.0, 20.0, 45.0 }, direction, 0.0, Infinity, packet);
  RayHits hits;
  scene.Traced->Trace(packet, hits);
  Fragments fragments;
  shader.MakeFragments(packet, hits, fragments);
  ASSERT_EQ(fragments.List.size(), 1U);
  EXPECT_EQ(
    fragments.List[0].Color, shader.Shade(hit, direction, { scene.FindAmbientTransmittance(hit) }));
}

//------------------------------------------------------------------------------
TEST(AmbientOcclusion, IndependentOfTheOtherHits)
{
  OpenScene scene(AnalyticFields::Gyroid{ 9.0 }, 0.6);
  scene.TheScene.OcclusionRays = 41;
  RandomNumbers random(5);
  std::vector<Hit> hits;
  while (hits.size() < 300)
  {
    const Vector3 origin = random.PointInBox({ 0.0, 0.0, 0.0 }, { 40.0, 40.0, 40.0 });
    const std::vector<Hit> found = Trace(*scene.Traced, { origin, random.Direction() });
    hits.insert(hits.end(), found.begin(), found.end());
  }
  double least = 1.0;
  double most = 0.0;
  for (std::size_t first = 0; first < hits.size(); first += RayPacket::Capacity)
  {
    const std::size_t count = std::min<std::size_t>(RayPacket::Capacity, hits.size() - first);
    LightAtHits together;
    SecondaryRays(scene.TheScene, 0).FindAmbient(&hits[first], static_cast<int>(count), together);
    for (std::size_t i = 0; i < count; ++i)
    {
      const double part = together.Parts[i];
      EXPECT_EQ(scene.FindAmbientTransmittance(hits[first + i]), part);
      least = std::min(least, part);
      most = std::max(most, part);
    }
  }
  EXPECT_LT(least, 0.2);
  EXPECT_GT(most, 0.7);
}

//------------------------------------------------------------------------------
TEST(AmbientOcclusion, DirectionsVaryBetweenFrames)
{
  OpenScene scene(Corner);
  scene.TheScene.OcclusionRays = 5;
  const Hit hit = scene.Find({ 7.5, 20.0, 45.0 }, { 0.0, 0.0, -1.0 });
  const double expected = 1.0 -
    Integrate(
      [](const Vector3& direction) { return MeetsWall(direction, 3.0, Infinity) ? 1.0 : 0.0; });
  constexpr int frames = 400;
  double sum = 0.0;
  double largest = 0.0;
  for (scene.TheScene.OcclusionFrame = 0; scene.TheScene.OcclusionFrame < frames;
       ++scene.TheScene.OcclusionFrame)
  {
    const double transmittance = scene.FindAmbientTransmittance(hit);
    sum += transmittance;
    largest = std::max(largest, std::abs(transmittance - expected));
  }
  // Five rays estimate it to a fifth; the mean of many frames is as good as that many rays.
  EXPECT_GT(largest, 0.1);
  EXPECT_NEAR(sum / frames, expected, 0.015);
}

//------------------------------------------------------------------------------
TEST(Hemisphere, DirectionsVaryBetweenFrames)
{
  const Vector3 up = { 0.0, 0.0, 1.0 };
  const Vector3 point = { 1.1, 2.2, 3.3 };
  EXPECT_EQ(
    Hemisphere(up, 4, HitNumbers(point)).Next(), Hemisphere(up, 4, HitNumbers(point, 0)).Next());
  for (int frame = 1; frame < 16; ++frame)
  {
    for (int other = 0; other < frame; ++other)
    {
      EXPECT_NE(Hemisphere(up, 4, HitNumbers(point, frame)).Next(),
        Hemisphere(up, 4, HitNumbers(point, other)).Next());
    }
  }
}

//------------------------------------------------------------------------------
TEST(Hemisphere, DirectionsAreCosineWeighted)
{
  RandomNumbers random(8);
  for (int i = 0; i < 50; ++i)
  {
    const Vector3 normal =
      i == 0 ? Vector3{ 0.0, 0.0, -1.0 } : (i == 1 ? Vector3{ 0.0, 0.0, 1.0 } : random.Direction());
    const Vector3 point = { i + 0.1, 2.2, 3.3 };
    constexpr int count = 256;
    Hemisphere sky(normal, count, HitNumbers(point));
    Vector3 sum = { 0.0, 0.0, 0.0 };
    for (int number = 0; number < count; ++number)
    {
      const Vector3 direction = sky.Next();
      EXPECT_NEAR(Dot(direction, direction), 1.0, 1e-12);
      EXPECT_GE(Dot(direction, normal), 0.0);
      sum = sum + direction;
    }
    // The mean height is that of a cosine lobe, and there is no bias to any side.
    EXPECT_LT(Length(sum * (1.0 / count) - normal * (2.0 / 3.0)), 0.01);
  }
}

}
}
