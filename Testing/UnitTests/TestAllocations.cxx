// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Each allocation of a frame and of rays without a picture fails once: that is an exception, or it
// changes nothing; nothing leaks; and the same field traces rightly afterwards.

#include "AnalyticFields.h"
#include "FailingAllocations.h"
#include "Image/ImageField.h"
#include "Math/Matrix.h"
#include "Matrices.h"
#include "OneFieldScene.h"
#include "Picture/CastRays.h"
#include "Picture/RenderTiles.h"
#include "TestVolume.h"

#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// What is made of a field.
struct Result
{
  Frame Picture;
  RayHits Hits;
};

bool IsSame(const Result& a, const Result& b)
{
  return a.Picture.Colors == b.Picture.Colors && a.Picture.Depths == b.Picture.Depths &&
    a.Hits.Hits.size() == b.Hits.Hits.size() && a.Hits.First == b.Hits.First;
}

OneFieldScene NewScene(Interpolant interpolant, double opacity, int threads)
{
  OneFieldScene scene;
  const Matrix4 view =
    Multiply(Orthographic(1.0, 31.0, 6.0), Invert(Translation({ 6.0, 6.0, 25.0 })));
  scene.Shown.View = { view, Invert(view), Scaling({ 1.0, 1.0, 1.0 }), 24.0, 24.0 };
  scene.Shown.Surface.Shade = true;
  scene.Shown.Colors = { { 1.0, 0.5, 0.25 }, { 0.2, 0.5, 0.9 } };
  scene.Pixels = { 0, 0, 24, 24 };
  scene.Request.Surfaces = { { -0.3, opacity }, { 0.4, 1.0 } };
  scene.Request.Interpolation = interpolant;
  scene.Shadows = true;
  scene.Lights = { Light() };
  scene.Threads = threads;
  return scene;
}

/// All that allocates: building (unless there is a field), selecting, rendering, casting.
Result Trace(
  const TestVolume<float>& volume, OneFieldScene scene, std::unique_ptr<ImageField>& field)
{
  if (!field)
  {
    field = ImageField::New(volume.View(), {}, scene.Threads);
  }
  Result result;
  FrameTimes times;
  RenderTiles(scene.Show(*field), scene.GetExecution(), result.Picture, times,
    [](double /*done*/) { return true; });
  const std::vector<CastRay> rays = { { { 6.0, 6.0, 25.0 }, { 0.0, 0.0, -1.0 }, 0.0, 50.0 },
    { { 3.0, 5.0, 25.0 }, { 0.1, 0.1, -1.0 }, 0.0, 50.0 } };
  result.Hits = CastRays(*field, rays, scene.Threads);
  return result;
}

/// What becomes of it if an allocation fails.
struct Attempt
{
  Attempt(const TestVolume<float>& volume, const OneFieldScene& scene, long number,
    std::unique_ptr<ImageField>& field)
  {
    FailingAllocations::FailAt(number);
    try
    {
      this->Made = Trace(volume, scene, field);
    }
    catch (const std::bad_alloc&)
    {
      this->HasFailed = true;
    }
    this->IsReached = FailingAllocations::HasFailed();
  }

  Result Made;
  bool HasFailed = false;
  /// Whether there are so many allocations.
  bool IsReached;
};

class Allocations : public testing::TestWithParam<Interpolant>
{
};

TEST_P(Allocations, MayFailOneByOne)
{
  const auto volume = TestVolume<float>::Of({ 13, 13, 13 }, AnalyticFields::Gyroid{ 7.0 });
  int total = 0;
  for (const double opacity : { 1.0, 0.5 })
  {
    for (const int threads : { 1, 3 })
    {
      const OneFieldScene scene = NewScene(GetParam(), opacity, threads);
      std::unique_ptr<ImageField> whole;
      const Result expected = Trace(volume, scene, whole);
      ASSERT_FALSE(expected.Hits.Hits.empty());
      int failures = 0;
      bool isReached = true;
      // The first ones one by one.
      for (long number = 1; isReached; number += 1 + number / 100)
      {
        const long before = FailingAllocations::CountLive();
        {
          std::unique_ptr<ImageField> field;
          const Attempt attempt(volume, scene, number, field);
          isReached = attempt.IsReached;
          failures += attempt.HasFailed ? 1 : 0;
          ASSERT_TRUE(attempt.HasFailed || IsSame(attempt.Made, expected)) << number;
          ASSERT_TRUE(IsSame(Trace(volume, scene, field), expected)) << "after " << number;
        }
        ASSERT_EQ(FailingAllocations::CountLive(), before) << "allocation " << number << " leaks";
      }
      EXPECT_GT(failures, 20);
      total += failures;
    }
  }
  RecordProperty("FailedAllocations", total);
}

INSTANTIATE_TEST_SUITE_P(All, Allocations,
  testing::Values(Interpolant::Trilinear, Interpolant::Nearest, Interpolant::Tricubic));

}
}
