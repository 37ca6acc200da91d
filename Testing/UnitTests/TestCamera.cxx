// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of a camera are compared with those of a pinhole and of a parallel projection by
// geometry.

#include "Math/Matrix.h"
#include "Math/Vector.h"
#include "Matrices.h"
#include "RandomNumbers.h"
#include "Rays/Camera.h"

#include <cmath>
#include <cstddef>
#include <iostream>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int Width = 40;
constexpr int Height = 30;

Camera NewCamera(
  const Matrix4& projection, const Matrix4& viewFromWorld, const Matrix4& worldFromIndex)
{
  const Matrix4 clipFromIndex = Multiply(projection, Multiply(viewFromWorld, worldFromIndex));
  return { clipFromIndex, Invert(clipFromIndex), worldFromIndex, Width, Height };
}

Matrix4 RandomWorldFromIndex(RandomNumbers& random)
{
  const double mirrored = random.Integer(0, 1) ? 1.0 : -1.0;
  const Matrix4 spacing = Scaling(
    { random.Uniform(0.1, 5.0) * mirrored, random.Uniform(0.1, 5.0), random.Uniform(0.1, 5.0) });
  return Multiply(Translation({ random.Uniform(-9.0, 9.0), random.Uniform(-9.0, 9.0), 3.0 }),
    Multiply(Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0)), spacing));
}

//------------------------------------------------------------------------------
TEST(Camera, PerspectiveRaysMeetAtTheEye)
{
  RandomNumbers random(701);
  for (int i = 0; i < 2000; ++i)
  {
    const Matrix4 worldFromIndex = RandomWorldFromIndex(random);
    const Matrix4 worldFromView = Multiply(Translation({ 1.0, 2.0, random.Uniform(-100.0, 100.0) }),
      Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0)));
    const double near = random.Uniform(0.1, 2.0);
    const double far = near * std::pow(10.0, random.Uniform(0.1, 6.0));
    const double tangent = random.Uniform(0.1, 1.5);
    const Camera camera =
      NewCamera(Perspective(near, far, tangent), Invert(worldFromView), worldFromIndex);
    const int column = random.Integer(0, Width - 1);
    const int row = random.Integer(0, Height - 1);
    const double depth = i % 3 == 0 ? 1.0 : random.Uniform(0.0, 1.0);
    const Camera::PixelRay ray = camera.GetRay(column, row, depth);

    // In view space the ray goes from the origin through (x, y, -1).
    const Vector3 inView = { tangent * ((2 * column + 1.0) / Width - 1.0),
      tangent * ((2 * row + 1.0) / Height - 1.0), -1.0 };
    const Vector3 start = TransformPoint(worldFromIndex, ray.Origin);
    const Vector3 expectedStart = TransformPoint(worldFromView, inView * near);
    const Vector3 along = TransformDirection(worldFromIndex, ray.Direction);
    const double length = Length(along);
    const Vector3 expectedAlong = Normalized(TransformDirection(worldFromView, inView));
    ASSERT_LT(Length(start - expectedStart), 1e-11);
    ASSERT_LT(Length(along * (1.0 / length) - expectedAlong), 1e-11);
    // The depth of a distance z before the eye is (1 / near - 1 / z) / (1 / near - 1 / far).
    const double z = 1.0 / (1.0 / near - depth * (1.0 / near - 1.0 / far));
    const double expectedEnd = (z - near) * Length(inView);
    ASSERT_NEAR(ray.End * length, expectedEnd, 1e-9 * (1.0 + expectedEnd * z / near));
    ASSERT_NEAR(camera.GetDepth(ray.Origin + ray.Direction * ray.End), depth, 1e-9);
  }
}

//------------------------------------------------------------------------------
TEST(Camera, ParallelProjection)
{
  RandomNumbers random(702);
  for (int i = 0; i < 2000; ++i)
  {
    const Matrix4 worldFromIndex = RandomWorldFromIndex(random);
    const Matrix4 worldFromView = Multiply(Translation({ 1.0, 2.0, random.Uniform(-100.0, 100.0) }),
      Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0)));
    const double near = random.Uniform(-5.0, 5.0); // may be behind the camera
    const double far = near + random.Uniform(1.0, 100.0);
    const double halfHeight = random.Uniform(1.0, 9.0);
    const Camera camera =
      NewCamera(Orthographic(near, far, halfHeight), Invert(worldFromView), worldFromIndex);
    const double depth = random.Uniform(0.0, 1.0);
    const Camera::PixelRay ray = camera.GetRay(3, 29, depth);
    const Vector3 start = { halfHeight * (7.0 / Width - 1.0), halfHeight * (59.0 / Height - 1.0),
      -near };
    ASSERT_LT(
      Length(TransformPoint(worldFromIndex, ray.Origin) - TransformPoint(worldFromView, start)),
      1e-11);
    const Vector3 along = TransformDirection(worldFromIndex, ray.Direction);
    const double length = Length(along);
    ASSERT_LT(
      Length(along * (1.0 / length) - TransformDirection(worldFromView, { 0.0, 0.0, -1.0 })),
      1e-11);
    ASSERT_NEAR(ray.End * length, depth * (far - near), 1e-9);
    ASSERT_NEAR(camera.GetDepth(ray.Origin + ray.Direction * ray.End), depth, 1e-9);
  }
}

//------------------------------------------------------------------------------
TEST(Camera, SubpixelOffsets)
{
  RandomNumbers random(703);
  for (int i = 0; i < 500; ++i)
  {
    const Matrix4 worldFromIndex = RandomWorldFromIndex(random);
    const Matrix4 viewFromWorld = Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0));
    const Camera camera = NewCamera(Perspective(0.5, 50.0, 0.7), viewFromWorld, worldFromIndex);
    // A pixel of four times the resolution in a pixel.
    const Camera fine(camera.GetClipFromObject(), camera.GetObjectFromClip(), worldFromIndex,
      4.0 * Width, 4.0 * Height);
    const int column = random.Integer(0, 3);
    const int row = random.Integer(0, 3);
    const Camera shifted = camera.Shifted(0.25 * column - 0.375, 0.25 * row - 0.375);
    const Camera::PixelRay ray = shifted.GetRay(7, 20, 0.4);
    const Camera::PixelRay expected = fine.GetRay(28 + column, 80 + row, 0.4);
    ASSERT_LT(Length(ray.Origin - expected.Origin), 1e-11);
    ASSERT_LT(Length(ray.Direction - expected.Direction), 1e-11 * Length(expected.Direction));
    ASSERT_NEAR(ray.End, expected.End, 1e-11 * expected.End);
    ASSERT_NEAR(shifted.GetDepth(ray.Origin + ray.Direction * ray.End), 0.4, 1e-9);
    // The points of the ray are at the centre of the pixel of the shifted view.
    const Vector3 point = ray.Origin + ray.Direction * ray.End;
    const Matrix4& m = shifted.GetClipFromObject();
    const Vector3 inClip = TransformPoint(m, point);
    const double w = m[12] * point[0] + m[13] * point[1] + m[14] * point[2] + m[15];
    ASSERT_NEAR(inClip[0] / w, 2.0 * 7.5 / Width - 1.0, 1e-9);
    ASSERT_NEAR(inClip[1] / w, 2.0 * 20.5 / Height - 1.0, 1e-9);
  }
}

//------------------------------------------------------------------------------
TEST(Camera, FarPlaneAtInfinity)
{
  // The limit of Perspective(1, far, 1).
  const Matrix4 projection = { 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, -2.0, 0.0,
    0.0, -1.0, 0.0 };
  const Matrix4 identity = Scaling({ 1.0, 1.0, 1.0 });
  const Camera camera = NewCamera(projection, identity, identity);
  const Camera::PixelRay ray = camera.GetRay(10, 10, 1.0);
  EXPECT_TRUE(std::isinf(ray.End) && ray.End > 0.0);
  EXPECT_LT(ray.Direction[2], 0.0);
  EXPECT_NEAR(camera.GetRay(10, 10, 0.5).End * -ray.Direction[2], 1.0, 1e-12);

  // A rounding beyond infinity is behind the eye.
  Matrix4 beyond = Invert(projection);
  beyond[14] = std::nextafter(beyond[14], -1.0);
  const Camera rounded(projection, beyond, identity, Width, Height);
  const double end = rounded.GetRay(10, 10, 1.0).End;
  EXPECT_TRUE(std::isinf(end) && end > 0.0);
}

}
}
