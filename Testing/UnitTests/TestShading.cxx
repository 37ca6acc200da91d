// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Normals are compared with those by the inverse transpose, colours with the Phong model by hand.

#include "Image/ImageField.h"
#include "Math/Matrix.h"
#include "Matrices.h"
#include "OneFieldScene.h"
#include "Picture/Shader.h"
#include "RandomNumbers.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <cmath>
#include <cstddef>
#include <iostream>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

double Length(const Vector3& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

Vector3 Unit(const Vector3& v)
{
  return v * (1.0 / Length(v));
}

void ExpectNear(const Vector3& a, const Vector3& b, double tolerance)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(a[i], b[i], tolerance);
  }
}

//------------------------------------------------------------------------------
TEST(Shading, NormalsAreTransformedByTheInverseTranspose)
{
  RandomNumbers random(801);
  double worst = 0.0;
  std::size_t tried = 0;
  for (const double ratio : { 1.0, 10.0, 1e4 })
  {
    for (int i = 0; i < 3000; ++i)
    {
      // Rotations, mirrors, shears and spacings.
      Matrix4 m = Multiply(Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0)),
        Scaling({ random.Integer(0, 1) ? 1.0 : -1.0, random.Uniform(1.0, ratio), 1.0 / ratio }));
      m[1] += random.Integer(0, 1) ? random.Uniform(-0.5, 0.5) : 0.0;
      m[3] = random.Uniform(-1e3, 1e3);
      const Vector3 gradient = random.Direction();
      const Vector3 expected = Unit(TransposeTransformDirection(Invert(m), gradient));
      const double error = Length(Unit(TransformDirection(NormalMatrix(m), gradient)) - expected);
      worst = std::max(worst, error);
      ++tried;
      ASSERT_LT(error, 1e-11) << ratio;
    }
  }
  std::cout << "[ tried    ] " << tried << " matrices; largest error " << worst << "\n";
}

//------------------------------------------------------------------------------
TEST(Shading, NormalsAtAnySpacing)
{
  for (const double spacing : { 1e-300, 1e-200, 1e-100, 1e-9, 1e9, 1e100, 1e200, 1e300 })
  {
    const Vector3 normal = TransformDirection(
      NormalMatrix(Scaling({ spacing, -spacing, 2.0 * spacing })), { 1.0, 1.0, 1.0 });
    ExpectNear(Unit(normal), Unit({ 1.0, -1.0, 0.5 }), 1e-14);
  }
  ExpectNear(Unit(TransformDirection(NormalMatrix(Scaling({ 1.0, 1e4, 1.0 })), { 1.0, 1.0, 0.0 })),
    Unit({ 1.0, 1e-4, 0.0 }), 1e-15);
}

//------------------------------------------------------------------------------
/// A scene whose surface is the plane x = 4 of index space, seen along x. Inside is at larger x.
class PlaneScene
{
public:
  explicit PlaneScene(
    const Matrix4& worldFromIndex = Scaling({ 1.0, 1.0, 1.0 }), double steep = 1.0)
    : Volume(TestVolume<double>::Of(
        { 9, 9, 9 }, [steep](const AnalyticFields::Point& p) { return steep * (p[0] - 4.0); }))
    , Traced(ImageField::New(this->Volume.View(), {}, 1))
  {
    this->TheScene.Shown.View =
      Camera(worldFromIndex, Invert(worldFromIndex), worldFromIndex, 10, 10);
    this->TheScene.Request.Surfaces = { { 0.0, 1.0 } };
    this->TheScene.Shown.Colors = { { 0.8, 0.5, 0.3 } };
    this->TheScene.Shown.Surface.Shade = true;
  }

  /// The colour at a point of the plane, seen along a direction.
  Vector3 Shade(double y, double z, const Vector3& direction = { 1.0, 0.0, 0.0 })
  {
    const Vector3 origin = Vector3{ 4.0, y, z } - direction * 2.0;
    const Scene& shown = this->TheScene.Show(*this->Traced);
    const std::vector<Hit> hits = Trace(*this->Traced, { origin, direction });
    EXPECT_EQ(hits.size(), 1U);
    return Shader(shown, 0, this->TheScene.Request.PacketKernels).Shade(hits.at(0), direction);
  }

  TestVolume<double> Volume;
  std::unique_ptr<ImageField> Traced;
  OneFieldScene TheScene;
};

Vector3 Phong(const Vector3& color, double diffuse, double specular, const Material& surface)
{
  const double scaled = surface.Ambient + surface.Diffuse * diffuse;
  const double added = surface.Specular * specular;
  return color * scaled + Vector3{ added, added, added };
}

//------------------------------------------------------------------------------
TEST(Shading, ColorWithoutShading)
{
  PlaneScene plane;
  plane.TheScene.Shown.Surface.Shade = false;
  EXPECT_EQ(plane.Shade(3.0, 3.0), plane.TheScene.Shown.Colors[0]);
}

//------------------------------------------------------------------------------
TEST(Shading, AmbientTermWithoutLights)
{
  PlaneScene plane;
  ExpectNear(plane.Shade(3.0, 3.0), plane.TheScene.Shown.Colors[0] * 0.1, 1e-15);
}

//------------------------------------------------------------------------------
TEST(Shading, PhongWithADirectionalLight)
{
  for (const NormalMode mode : { NormalMode::CentralDifferences, NormalMode::InterpolantGradient })
  {
    PlaneScene plane;
    OneFieldScene& scene = plane.TheScene;
    scene.Request.Normals = mode;
    Light light;
    light.Direction = { -0.8, 0.6, 0.0 }; // the normal is -x: cosine 0.8
    scene.Lights = { light };
    // The mirrored light leaves along (-0.8, -0.6, 0); the viewer is at (-1, 0, 0).
    ExpectNear(plane.Shade(3.0, 3.0),
      Phong(scene.Shown.Colors[0], 0.8, std::pow(0.8, 10.0), scene.Shown.Surface), 1e-14);
    // Seen along the mirrored light the highlight is full.
    ExpectNear(plane.Shade(3.0, 3.0, { 0.8, 0.6, 0.0 }),
      Phong(scene.Shown.Colors[0], 0.8, 1.0, scene.Shown.Surface), 1e-14);
    scene.Lights[0].DiffuseColor = { 0.5, 0.0, 1.0 };
    scene.Lights[0].SpecularColor = { 0.0, 0.25, 1.0 };
    scene.Lights.push_back(light);
    const Vector3 both = plane.Shade(3.0, 3.0);
    const double highlight = 0.2 * std::pow(0.8, 10.0);
    ExpectNear(both,
      { 0.8 * (0.1 + 0.7 * 0.8 * 1.5) + highlight, 0.5 * (0.1 + 0.7 * 0.8) + highlight * 1.25,
        0.3 * (0.1 + 0.7 * 0.8 * 2.0) + highlight * 2.0 },
      1e-14);
  }
}

//------------------------------------------------------------------------------
TEST(Shading, TwoSidedLighting)
{
  PlaneScene plane;
  OneFieldScene& scene = plane.TheScene;
  Light light;
  light.Direction = { 1.0, 0.0, 0.0 };
  scene.Lights = { light };
  const Vector3 fromBehind = { -1.0, 0.0, 0.0 };
  ExpectNear(plane.Shade(3.0, 3.0, fromBehind),
    Phong(scene.Shown.Colors[0], 1.0, 1.0, scene.Shown.Surface), 1e-14);
  scene.TwoSidedLighting = false;
  ExpectNear(plane.Shade(3.0, 3.0, fromBehind),
    Phong(scene.Shown.Colors[0], 0.0, 0.0, scene.Shown.Surface), 1e-14);
  ExpectNear(
    plane.Shade(3.0, 3.0), Phong(scene.Shown.Colors[0], 0.0, 0.0, scene.Shown.Surface), 1e-14);
}

// A smooth normal may be turned away from a viewer on the outside: the hit tells which side it is.
TEST(Shading, FrontAndBackAreThoseOfTheHit)
{
  PlaneScene plane;
  OneFieldScene& scene = plane.TheScene;
  Light light;
  light.Direction = { -1.0, 0.0, 0.0 };
  scene.Lights = { light };
  const Shader shader(scene.Show(*plane.Traced), 0, scene.Request.PacketKernels);
  const Vector3 direction = Unit({ -0.1, 1.0, 0.0 });
  Hit hit = { 1.0, plane.Traced->GetLattice().GetNumber({ 4, 3, 3 }), 0, { 0.0, 0.5, 0.5 }, true };
  ExpectNear(shader.Shade(hit, direction),
    Phong(scene.Shown.Colors[0], 1.0, 0.0, scene.Shown.Surface), 1e-14);
  hit.Entering = false;
  ExpectNear(shader.Shade(hit, direction),
    Phong(scene.Shown.Colors[0], 0.0, 0.0, scene.Shown.Surface), 1e-14);
}

//------------------------------------------------------------------------------
TEST(Shading, PhongWithASpotLightAndAttenuation)
{
  PlaneScene plane;
  OneFieldScene& scene = plane.TheScene;
  Light lamp;
  lamp.Positional = true;
  lamp.Position = { 0.0, 3.0, 3.0 };
  lamp.Direction = { -1.0, 0.0, 0.0 }; // it shines along x, straight at the plane
  lamp.Attenuation = { 0.5, 0.25, 0.125 };
  scene.Lights = { lamp };
  // Right below: 4 away.
  double strength = 1.0 / (0.5 + 0.25 * 4.0 + 0.125 * 16.0);
  ExpectNear(plane.Shade(3.0, 3.0),
    Phong(scene.Shown.Colors[0], strength, strength, scene.Shown.Surface), 1e-14);
  // 3 aside: 5 away, cosine 0.8. The viewer sees the highlight under the same angle.
  strength = 1.0 / (0.5 + 0.25 * 5.0 + 0.125 * 25.0);
  const auto expected = [&](double s)
  { return Phong(scene.Shown.Colors[0], 0.8 * s, std::pow(0.8, 10.0) * s, scene.Shown.Surface); };
  ExpectNear(plane.Shade(6.0, 3.0), expected(strength), 1e-14);
  // That point is 36.87 degrees off the axis of the cone.
  scene.Lights[0].ConeAngle = 36.8;
  ExpectNear(plane.Shade(6.0, 3.0), expected(0.0), 1e-14);
  scene.Lights[0].ConeAngle = 36.9;
  ExpectNear(plane.Shade(6.0, 3.0), expected(strength * 0.8), 1e-14);
  scene.Lights[0].Exponent = 3.0;
  ExpectNear(plane.Shade(6.0, 3.0), expected(strength * 0.512), 1e-14);
  scene.Lights[0].ConeAngle = 90.0;
  ExpectNear(plane.Shade(6.0, 3.0), expected(strength), 1e-14);
}

//------------------------------------------------------------------------------
TEST(Shading, LightsAreInWorldCoordinates)
{
  // The plane x = 4 of index space is x = -8 in the world, mirrored; the viewer is at +x.
  PlaneScene plane(Scaling({ -2.0, 1e4, 0.5 }));
  OneFieldScene& scene = plane.TheScene;
  Light lamp;
  lamp.Positional = true;
  lamp.Position = { -4.0, 3e4 + 3.0, 1.5 };
  lamp.Attenuation = { 0.0, 0.0, 1.0 };
  scene.Lights = { lamp };
  const double strength = 1.0 / 25.0;
  ExpectNear(plane.Shade(3.0, 3.0),
    Phong(
      scene.Shown.Colors[0], 0.8 * strength, std::pow(0.8, 10.0) * strength, scene.Shown.Surface),
    1e-12);
}

//------------------------------------------------------------------------------
TEST(Shading, IndependentOfTheMagnitudeOfTheData)
{
  Light light;
  light.Direction = { -1.0, 0.0, 0.0 };
  for (const double steep : { 1e-305, 1e-200, 1e-100, 1.0, 1e100, 1e200, 1e305 })
  {
    PlaneScene plane(Scaling({ 1.0, 1.0, 1.0 }), steep);
    plane.TheScene.Lights = { light };
    ExpectNear(plane.Shade(3.0, 3.0),
      Phong(plane.TheScene.Shown.Colors[0], 1.0, 1.0, plane.TheScene.Shown.Surface), 1e-12);
  }
}

//------------------------------------------------------------------------------
TEST(Shading, CentralDifferencesAndInterpolantGradients)
{
  // x^2 along x: the central difference at 3 and 4 is 6 and 8, the difference between them 7.
  const auto volume = TestVolume<std::int16_t>::Of(
    { 9, 4, 5 }, [](const AnalyticFields::Point& p) { return p[0] * p[0] + 3.0 * p[2]; });
  const auto traced = ImageField::New(volume.View(), {}, 1);
  const CellLattice& lattice = traced->GetLattice();
  const Hit within = { 0.0, lattice.GetNumber({ 3, 1, 1 }), 0, { 0.25, 0.5, 0.5 }, true };
  EXPECT_EQ(
    traced->GetGradient(within, NormalMode::CentralDifferences), (Vector3{ 6.5, 0.0, 3.0 }));
  EXPECT_EQ(
    traced->GetGradient(within, NormalMode::InterpolantGradient), (Vector3{ 7.0, 0.0, 3.0 }));
  // At the border the difference is one-sided: 1 at x = 0, 15 at x = 8.
  const Hit atFirst = { 0.0, lattice.GetNumber({ 0, 0, 0 }), 0, { 0.0, 0.0, 0.0 }, true };
  EXPECT_EQ(
    traced->GetGradient(atFirst, NormalMode::CentralDifferences), (Vector3{ 1.0, 0.0, 3.0 }));
  const Hit atLast = { 0.0, lattice.GetNumber({ 7, 2, 3 }), 0, { 1.0, 1.0, 1.0 }, true };
  EXPECT_EQ(
    traced->GetGradient(atLast, NormalMode::CentralDifferences), (Vector3{ 15.0, 0.0, 3.0 }));
}

}
}
