// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Hits that are shaded by the kernels of every instruction set must have the colours they have one
// by one: the same to the last bit.

#include "AllKernels.h"
#include "Image/ImageField.h"
#include "Image/Lattice/Ray.h"
#include "Math/Matrix.h"
#include "Matrices.h"
#include "OneFieldScene.h"
#include "Picture/Shader.h"
#include "RandomNumbers.h"
#include "Rays/RayPacket.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class ShadingKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, ShadingKernels, AllKernels(), NameOfKernels);

/// Of any magnitude; one in so many is NaN, or a limit of the floating-point numbers.
double AnyNumber(RandomNumbers& random, int special)
{
  constexpr std::numeric_limits<double> limits;
  const double numbers[] = { 0.0, -0.0, limits.max(), limits.lowest(), limits.denorm_min(),
    -limits.denorm_min(), limits.infinity(), -limits.infinity(), limits.quiet_NaN() };
  return random.Integer(1, special) == 1 ? numbers[random.Integer(0, 8)]
                                         : random.WideMagnitude(-320.0, 308.0);
}

//------------------------------------------------------------------------------
const Index3 Dimensions = { 12, 11, 13 };

/// Noise; of one magnitude, of all of them, or with samples that are not finite.
TestVolume<double> RandomVolume(RandomNumbers& random)
{
  const int kind = random.Integer(0, 3);
  std::vector<double> samples(Count(Dimensions));
  for (double& sample : samples)
  {
    const double numbers[] = { random.Uniform(-1.0, 1.0), random.Integer(-1, 1) + 0.0,
      AnyNumber(random, 1000), random.Integer(0, 19) ? random.Uniform(-1.0, 1.0) : std::nan("") };
    sample = numbers[kind];
  }
  return TestVolume<double>(Dimensions, samples);
}

Vector3 RandomColor(RandomNumbers& random)
{
  return random.PointInBox({ 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 });
}

Light RandomLight(RandomNumbers& random)
{
  Light light;
  light.DiffuseColor = RandomColor(random);
  light.SpecularColor = RandomColor(random);
  light.Direction = random.Integer(0, 4) ? random.Direction() : Vector3{ 0.0, 0.0, 1.0 };
  light.Positional = random.Integer(0, 19) == 0;
  return light;
}

/// Turned, mirrored, sheared, and of any spacing.
Matrix4 RandomWorldFromObject(RandomNumbers& random)
{
  const double spacings[] = { 1.0, 1.0, 1e3, 1e-3, 1e150, 1e-150 };
  const double spacing = spacings[random.Integer(0, 5)];
  Matrix4 matrix = Multiply(Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0)),
    Scaling({ spacing, random.Integer(0, 1) ? -spacing : spacing, 3.0 * spacing }));
  matrix[1] += random.Integer(0, 1) ? 0.3 * spacing : 0.0;
  return matrix;
}

OneFieldScene RandomScene(RandomNumbers& random)
{
  const Matrix4 worldFromObject = RandomWorldFromObject(random);
  OneFieldScene scene;
  scene.Shown.View = Camera(worldFromObject, Invert(worldFromObject), worldFromObject, 10, 10);
  scene.Request.Surfaces = { { 0.0, random.Integer(0, 1) ? 1.0 : 1e-9 }, { 0.25, 1.0 } };
  scene.Shown.Colors = { RandomColor(random), RandomColor(random) };
  scene.Request.Normals =
    random.Integer(0, 2) ? NormalMode::CentralDifferences : NormalMode::InterpolantGradient;
  const double powers[] = { 0.0, 1.0, 2.0, 10.0, 37.0, 128.0, 129.0, 0.5, 1000.0 };
  scene.Shown.Surface = { random.Integer(0, 9) != 0, random.Uniform(0.0, 1.0),
    random.Uniform(0.0, 1.0), random.Uniform(0.0, 1.0), powers[random.Integer(0, 8)] };
  for (int i = random.Integer(0, 4); i > 0; --i)
  {
    scene.Lights.push_back(RandomLight(random));
  }
  scene.TwoSidedLighting = random.Integer(0, 1) != 0;
  scene.Shadows = random.Integer(0, 1) != 0;
  scene.OcclusionRays = random.Integer(0, 3) ? 0 : 3;
  return scene;
}

/// Kernels that count what they shade, and keep the colours.
struct CountingKernels
{
  explicit CountingKernels(const Kernels& kernels)
    : Counting(kernels)
  {
    Base = &kernels;
    Hits = Extremes = 0;
    Colors.clear();
    AreExtreme.clear();
    this->Counting.Shade = [](const Phong& phong, ShadedHits& hits)
    {
      Base->Shade(phong, hits);
      Hits += hits.Count;
      for (int i = 0; i < RayPacket::Capacity; ++i)
      {
        Extremes += Has(hits.Extreme, i) ? 1 : 0;
      }
      for (int i = 0; i < hits.Count; ++i)
      {
        Colors.push_back({ hits.Color[0][i], hits.Color[1][i], hits.Color[2][i] });
        AreExtreme.push_back(Has(hits.Extreme, i));
      }
    };
  }

  Kernels Counting;
  inline static const Kernels* Base;
  inline static int Hits;
  inline static int Extremes;
  inline static std::vector<Vector3> Colors;
  /// Those that the kernels left to others.
  inline static std::vector<bool> AreExtreme;
};

/// The colour of a hit that is shaded by itself.
Vector3 ShadeOne(const Shader& shader, const Scene& shown, const Hit& hit, const Vector3& direction)
{
  const SecondaryRays secondary(shown, 0);
  LightAtHits ambient = { { 1.0 } };
  if (shown.OcclusionRays > 0)
  {
    secondary.FindAmbient(&hit, 1, ambient);
  }
  std::vector<LightAtHits> lights(shown.Lights.size());
  secondary.FindLights(&hit, 1, lights.data());
  return shader.Shade(
    hit, direction, { ambient.Parts[0], shown.Shadows ? lights.data() : nullptr });
}

/// Whether the kernels support everything that shades a scene.
bool IsForKernels(const OneFieldScene& scene)
{
  return scene.Shown.Surface.Shade && scene.Shown.Surface.SpecularPower <= 128.0 &&
    scene.Shown.Surface.SpecularPower == std::floor(scene.Shown.Surface.SpecularPower) &&
    std::none_of(scene.Lights.begin(), scene.Lights.end(),
      [](const Light& light) { return light.Positional; });
}

bool AreSameColors(const Vector3& a, const Vector3& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), AreSameNumbers);
}

/// The colour as it is composited.
Vector3 ToFragmentColor(const Vector3& color, double opacity)
{
  return Vector3{ std::clamp(color[0], 0.0, 1.0), std::clamp(color[1], 0.0, 1.0),
    std::clamp(color[2], 0.0, 1.0) } *
    opacity;
}

// Any number of hits, from none to many more than the kernels take at once.
TEST_P(ShadingKernels, ShadingMatchesSingleHits)
{
  RandomNumbers random(862);
  const CountingKernels kernels(this->TheKernels);
  std::size_t hitCount = 0;
  for (int i = 0; i < 1500; ++i)
  {
    const auto volume = RandomVolume(random);
    const auto traced = ImageField::New(volume.View(), {}, 1);
    OneFieldScene scene = RandomScene(random);
    scene.Request.PacketKernels = &kernels.Counting;
    const Scene& shown = scene.Show(*traced);
    RayPacket packet;
    packet.Count = 0;
    packet.Exists = {};
    for (int ray = random.Integer(1, RayPacket::Capacity); ray > 0; --ray)
    {
      const Line line =
        random.Integer(0, 3) ? RandomLine(random, Dimensions) : LatticeLine(random, Dimensions);
      traced->AddRay(line.Origin, line.Direction, 0.0, Infinity, packet);
    }
    RayHits hits;
    traced->Trace(packet, hits);

    const Shader shader(shown, 0, scene.Request.PacketKernels);
    Fragments fragments;
    CountingKernels::Colors.clear();
    CountingKernels::AreExtreme.clear();
    shader.MakeFragments(packet, hits, fragments);
    ASSERT_EQ(fragments.List.size(), hits.Hits.size());
    ASSERT_EQ(fragments.First, hits.First);
    const bool isForKernels = IsForKernels(scene);
    ASSERT_EQ(CountingKernels::Colors.size(), isForKernels ? hits.Hits.size() : 0U);
    for (int ray = 0; ray < packet.Count; ++ray)
    {
      const auto number = static_cast<std::size_t>(ray);
      for (std::size_t hit = hits.First[number]; hit < hits.First[number + 1]; ++hit)
      {
        const Vector3 expected =
          ShadeOne(shader, shown, hits.Hits[hit], GetRay(packet, ray).Direction);
        const double opacity = traced->GetRequest().GetOpacity(hits.Hits[hit]);
        ASSERT_TRUE(!isForKernels || CountingKernels::AreExtreme[hit] ||
          AreSameColors(CountingKernels::Colors[hit], expected))
          << "scene " << i << ", hit " << hit << " of " << hits.Hits.size();
        ASSERT_TRUE(AreSameColors(fragments.List[hit].Color, ToFragmentColor(expected, opacity)))
          << "scene " << i << ", hit " << hit << " of " << hits.Hits.size();
        ASSERT_EQ(fragments.List[hit].Opacity, opacity);
        ASSERT_EQ(fragments.List[hit].T, hits.Hits[hit].T);
      }
    }
    hitCount += hits.Hits.size();
  }
  std::cout << "[ tried    ] " << hitCount << " hits, " << CountingKernels::Hits
            << " of them with kernels, which left " << CountingKernels::Extremes << " to others\n";
  EXPECT_GT(CountingKernels::Hits - CountingKernels::Extremes, 30000);
  EXPECT_GT(CountingKernels::Extremes, 1000);
}

}
}
