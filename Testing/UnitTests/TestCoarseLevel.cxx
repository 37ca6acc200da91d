// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Coarse levels of images. Fields that are linear along an axis have the same surface in them,
// whatever part of the slices is read.

#include "Image/CoarseLevel.h"
#include "RandomNumbers.h"
#include "RandomPlanes.h"
#include "TestLines.h"
#include "TestRequest.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr Index3 Size = { 127, 130, 131 };

/// Calls check(hit, point) for hits of the surface, with their points in the space of the image.
template <typename Check>
void ForEachHit(CoarseLevel& level, double isovalue, const Check& check)
{
  ImageField& field = *level.GetField();
  TestRequest request;
  request.Surfaces = { { isovalue, 1.0 } };
  request.Visible.HiddenCells = level.GetHiddenCells();
  field.Select(request, { 2, request.PacketKernels });
  RandomNumbers random(7);
  int count = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Line line = RandomLine(random, field.GetLattice().GetDimensions());
    for (const Hit& hit : Trace(field, line))
    {
      Vector3 point = field.GetPoint(hit);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        point[axis] /= level.GetScale()[axis];
      }
      check(hit, point);
      ++count;
    }
  }
  EXPECT_GT(count, 20);
}

TEST(CoarseLevel, IsOfLargeImages)
{
  EXPECT_FALSE(CoarseLevel::IsOf({ 128, 128, 128 }));
  EXPECT_TRUE(CoarseLevel::IsOf({ 128, 128, 129 }));
  EXPECT_TRUE(CoarseLevel::IsOf({ 1 << 20, 1 << 20, 1 << 20 }));
}

TEST(CoarseLevel, HasTheSurfacesOfLinearFields)
{
  ForEachType(
    [](auto value)
    {
      using T = decltype(value);
      const int first = std::is_signed_v<T> ? -60 : 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const auto volume = TestVolume<T>::Of(
          Size, [&](const Vector3& point) { return first + point[axis]; }, 4);
        CoarseLevel level(volume.View(), nullptr, nullptr);
        double fraction = level.GetFractionRead();
        EXPECT_EQ(fraction, 0.0);
        while (fraction < 1.0)
        {
          level.ReadSlices(2);
          EXPECT_GT(level.GetFractionRead(), fraction);
          fraction = level.GetFractionRead();
          ForEachHit(level, first + 33.3,
            [&](const Hit& hit, const Vector3& point)
            {
              EXPECT_NEAR(point[axis], 33.3, 1e-4);
              Vector3 parametric;
              const Index3 cell = level.FindCell(hit, parametric);
              for (std::size_t i = 0; i < 3; ++i)
              {
                EXPECT_NEAR(cell[i] + parametric[i], point[i], 1e-4);
                EXPECT_GE(cell[i], 0);
                EXPECT_LE(cell[i], Size[i] - 2);
              }
            });
        }
      }
    });
}

TEST(CoarseLevel, ReadsAPartOfTheSlicesAtATime)
{
  const auto volume = TestVolume<double>::Of(
    Size, [](const Vector3& p) { return p[0]; }, 4);
  CoarseLevel level(volume.View(), nullptr, nullptr);
  int calls = 0;
  for (; level.GetFractionRead() < 1.0; ++calls)
  {
    level.ReadSlices(1);
  }
  EXPECT_EQ(calls, 3); // 66 slices, and 31 of 528320 bytes in 16 MiB
}

TEST(CoarseLevel, StandsOnThePlanesOfTheImage)
{
  RandomNumbers random(3);
  const UnevenPlanes planes = RandomPlanes(random, Size, {});
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    TestVolume<double> volume(Size, std::vector<double>(Count(Size)));
    ForEachPlace(Size, [&](const Index3& i) { volume.At(i) = planes.Get(axis, i[axis]); });
    CoarseLevel level(volume.View(), &planes, nullptr);
    level.ReadSlices(1);
    ForEachHit(
      level, 33.3, [&](const Hit&, const Vector3& point) { EXPECT_NEAR(point[axis], 33.3, 1e-4); });
  }
}

TEST(CoarseLevel, TakesBothEndsOfFlatImages)
{
  const Index3 size = { 2048, 1200, 2 };
  const auto volume = TestVolume<float>::Of(size, [](const Vector3& p) { return p[2]; });
  CoarseLevel level(volume.View(), nullptr, nullptr);
  level.ReadSlices(2);
  EXPECT_EQ(level.GetFractionRead(), 1.0);
  EXPECT_EQ(level.GetScale()[2], 1.0);
  ForEachHit(
    level, 0.25, [](const Hit&, const Vector3& point) { EXPECT_NEAR(point[2], 0.25, 1e-6); });
}

TEST(CoarseLevel, HidesWhatIsHidden)
{
  const auto volume = TestVolume<float>::Of(Size, [](const Vector3& p) { return p[2]; });
  std::vector<unsigned char> hidden;
  ForEachPlace({ Size[0] - 1, Size[1] - 1, Size[2] - 1 },
    [&hidden](const Index3& i) { hidden.push_back(i[0] < 50 ? 1 : 0); });
  CoarseLevel level(volume.View(), nullptr, hidden.data());
  level.ReadSlices(2);
  ForEachHit(
    level, 60.5, [](const Hit&, const Vector3& point) { EXPECT_GE(point[0], 50.0 - 1.0); });
}

}
}
