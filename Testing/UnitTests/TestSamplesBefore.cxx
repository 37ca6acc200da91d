// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A volume whose memory has further samples before it must have the surfaces and the gradients that
// a larger volume has there, which begins with these samples.

#include "AllKernels.h"
#include "Image/ImageField.h"
#include "Noise.h"
#include "Picture/CastRays.h"
#include "RandomNumbers.h"
#include "TestRequest.h"
#include "TestVolume.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr Index3 LargerSize = { 20, 11, 18 };
constexpr Vector3 Shift = { 1.0, 1.0, 1.0 };

/// All but the first samples along each axis.
template <typename T>
VolumeView ViewOfRest(const TestVolume<T>& larger)
{
  VolumeView view = larger.View();
  view.Samples = &larger.At({ 1, 1, 1 });
  for (int& dimension : view.Dimensions)
  {
    --dimension;
  }
  view.Before = 1;
  return view;
}

/// Between points of the rest, whose coordinates are whole numbers of 1/64.
std::vector<CastRay> MakeRays(RandomNumbers& random, int count)
{
  const auto pick = [&random]()
  {
    Vector3 point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = random.Integer(0, 64 * (LargerSize[axis] - 2)) / 64.0;
    }
    return point;
  };
  std::vector<CastRay> rays;
  while (rays.size() < static_cast<std::size_t>(count))
  {
    const Vector3 origin = pick();
    const Vector3 direction = pick() - origin;
    if (Length(direction) > 0.0)
    {
      rays.push_back({ origin, direction, 0.0, 1.0 });
    }
  }
  return rays;
}

class SamplesBefore : public WithKernels
{
};

//------------------------------------------------------------------------------
TEST_P(SamplesBefore, AreNeighbours)
{
  ForEachType(
    [this](auto type)
    {
      using T = decltype(type);
      RandomNumbers random(41);
      const TestVolume<T> volume = Noise<T>(LargerSize, 42);
      const auto larger = ImageField::New(volume.View(), {}, 1);
      const auto rest = ImageField::New(ViewOfRest(volume), {}, 1);
      std::size_t atBorder = 0;
      for (const Interpolant interpolant :
        { Interpolant::Trilinear, Interpolant::Tricubic, Interpolant::Nearest })
      {
        TestRequest request({ { 30.25, 0.5 }, { 80.5, 0.5 } });
        request.Interpolation = interpolant;
        request.PacketKernels = random.Integer(0, 3) == 0 ? nullptr : &this->TheKernels;
        Select(*larger, request, 1);
        Select(*rest, request, 1);
        std::vector<CastRay> rays = MakeRays(random, 300);
        const RayHits actual = CastRays(*rest, rays, 1);
        for (CastRay& ray : rays)
        {
          ray.Origin = ray.Origin + Shift;
        }
        const RayHits expected = CastRays(*larger, rays, 1);
        ASSERT_EQ(actual.First, expected.First);
        EXPECT_GT(actual.Hits.size(), 300U);
        for (std::size_t i = 0; i < actual.Hits.size(); ++i)
        {
          const Hit& hit = actual.Hits[i];
          const Index3 cell = rest->GetLattice().GetCell(hit);
          const Index3 shifted = { cell[0] + 1, cell[1] + 1, cell[2] + 1 };
          atBorder += cell[0] == 0 || cell[1] == 0 || cell[2] == 0 ? 1 : 0;
          // Coordinates are rounded otherwise where they are larger.
          const Hit& same = expected.Hits[i];
          EXPECT_EQ(larger->GetLattice().GetNumber(shifted), same.Cell);
          EXPECT_EQ(hit.Surface, same.Surface);
          EXPECT_EQ(hit.Entering, same.Entering);
          EXPECT_NEAR(hit.T, same.T, 1e-10);
          const NormalMode mode = NormalMode::CentralDifferences;
          const Vector3 gradient = rest->GetGradient(hit, mode);
          EXPECT_LT(Length(gradient - larger->GetGradient(same, mode)), 1e-7);
          alignas(64) double points[3][RayPacket::Capacity];
          alignas(64) double gradients[3][RayPacket::Capacity];
          rest->GetPointsAndGradients(&hit, 1, rest->GetRequest().Normals, points, gradients);
          EXPECT_EQ(gradient, (Vector3{ gradients[0][0], gradients[1][0], gradients[2][0] }));
        }
      }
      EXPECT_GT(atBorder, 100U);
    });
}

//------------------------------------------------------------------------------
/// The tricubic interpolant leaves the range of the samples that are equal next to others.
TEST_P(SamplesBefore, MakeMacrocellsActive)
{
  TestVolume<float> volume(LargerSize, std::vector<float>(Count(LargerSize), 10.0F));
  for (int z = 0; z < LargerSize[2]; ++z)
  {
    for (int y = 0; y < LargerSize[1]; ++y)
    {
      volume.At({ 0, y, z }) = 110.0F;
    }
  }
  const auto rest = ImageField::New(ViewOfRest(volume), {}, 1);
  TestRequest request({ { 5.0, 1.0 } });
  request.Interpolation = Interpolant::Tricubic;
  request.PacketKernels = &this->TheKernels;
  Select(*rest, request, 1);
  // Along the first cell it is 10 - 50 t (1 - t)^2, which is 5 for some t below 1/3.
  const RayHits hits = CastRays(*rest, { { { 0.0, 4.5, 8.5 }, { 1.0, 0.0, 0.0 }, 0.0, 1.0 } }, 1);
  ASSERT_EQ(hits.Hits.size(), 1U);
  EXPECT_NEAR(10.0 - 50.0 * hits.Hits[0].T * std::pow(1.0 - hits.Hits[0].T, 2.0), 5.0, 1e-9);
  EXPECT_LT(hits.Hits[0].T, 1.0 / 3.0);
}

INSTANTIATE_TEST_SUITE_P(All, SamplesBefore, AllKernels(), NameOfKernels);

}
}
