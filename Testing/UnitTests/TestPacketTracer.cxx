// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What rays hit as packets, with the kernels of every instruction set, must be what each of them
// hits by itself, cell by cell: the same to the last bit.

#include "AllKernels.h"
#include "Image/ImageField.h"
#include "Image/Lattice/Ray.h"
#include "Image/Lattice/UnevenPlanes.h"
#include "RandomNumbers.h"
#include "RandomPlanes.h"
#include "Rays/RayPacket.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestRequest.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

using Rays = std::vector<std::optional<Ray>>;

//------------------------------------------------------------------------------
// Rays of all kinds.

Vector3 LastSample(const Index3& size)
{
  return { size[0] - 1.0, size[1] - 1.0, size[2] - 1.0 };
}

std::optional<Ray> Clip(const Line& line, const Index3& size, double tEnd = Infinity)
{
  return ClipToVolume(line.Origin, line.Direction, 0.0, tEnd, size);
}

/// Through neighbouring pixels of a camera, which may be within the volume.
Rays PinholeRays(RandomNumbers& random, const Index3& size)
{
  const Vector3 target = random.PointInBox({}, LastSample(size));
  const double distances[] = { 0.0, random.Uniform(0.0, 10.0), 50.0, 1000.0, 1e7 };
  const double distance = distances[random.Integer(0, 4)];
  const Vector3 forward = random.Direction();
  const Vector3 u =
    Normalized({ forward[1] - forward[2], forward[2] - forward[0], forward[0] - forward[1] });
  const Vector3 v = { forward[1] * u[2] - forward[2] * u[1], forward[2] * u[0] - forward[0] * u[2],
    forward[0] * u[1] - forward[1] * u[0] };
  const Vector3 eye = target - forward * distance;
  const double pixel = random.Uniform(0.01, 1.0) / std::max(distance, 1.0);
  const int columns = random.Integer(1, 16);
  Rays rays;
  const int count = columns * random.Integer(1, 8);
  for (int i = 0; i < count; ++i)
  {
    const Vector3 direction = forward + u * (pixel * (i % columns - 7.5)) +
      v * (pixel * (i / columns - 3.5)); // NOLINT(bugprone-integer-division): a row
    const double end = random.Integer(0, 9) ? Infinity : distance + random.Uniform(0.0, 20.0);
    rays.push_back(Clip({ eye, Normalized(direction) }, size, end));
  }
  return rays;
}

Rays ParallelRays(RandomNumbers& random, const Index3& size)
{
  const Line middle = RandomLine(random, size);
  const double width = random.Uniform(0.5, 40.0);
  Rays rays;
  const int count = random.Integer(1, 128);
  for (int i = 0; i < count; ++i)
  {
    const Vector3 off = random.PointInBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 });
    rays.push_back(Clip({ middle.Origin + off * width, middle.Direction }, size));
  }
  return rays;
}

/// Along an axis, in and beside lattice planes, also those of the border of the volume.
Rays AxisParallelRays(RandomNumbers& random, const Index3& size)
{
  const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
  const double offsets[] = { 0.0, 1e-3, -1e-3, 1e-9, -1e-9, 1e-15, -1e-15, 0.5 };
  Rays rays;
  const int count = random.Integer(1, 128);
  for (int i = 0; i < count; ++i)
  {
    Line line = {};
    for (std::size_t across = 0; across < 3; ++across)
    {
      line.Origin[across] = random.Integer(0, size[across] - 1) + offsets[random.Integer(0, 7)];
    }
    line.Direction[axis] = 1.0;
    if (i % 4 == 3)
    {
      line.Direction[(axis + 1) % 3] = random.Uniform(-1.0, 1.0); // in a plane
    }
    line.Origin = line.Origin - line.Direction * random.Uniform(0.0, 2.0 * size[axis]);
    rays.push_back(Clip(line, size));
  }
  return rays;
}

Rays LatticeRays(RandomNumbers& random, const Index3& size)
{
  Rays rays;
  const int count = random.Integer(1, 128);
  for (int i = 0; i < count; ++i)
  {
    Line line = LatticeLine(random, size);
    line.Direction = line.Direction * (i % 2 == 0 ? random.Uniform(0.5, 2.0) : 1.0);
    rays.push_back(Clip(line, size));
  }
  return rays;
}

/// Incoherent rays; some of them are missing.
Rays MixedRays(RandomNumbers& random, const Index3& size)
{
  Rays rays;
  const bool mostlyMissing = random.Integer(0, 3) == 0;
  const int count = random.Integer(1, 300);
  for (int i = 0; i < count; ++i)
  {
    const bool isMissing = random.Integer(0, 4) == 0 || (mostlyMissing && random.Integer(0, 9));
    const double end = random.Integer(0, 3) ? Infinity : random.Uniform(0.0, 60.0);
    rays.push_back(isMissing ? std::nullopt : Clip(RandomLine(random, size), size, end));
  }
  return rays;
}

/// From one point along axes and diagonals of faces and of the cube.
Rays RaysInAllDirections(RandomNumbers& random, const Index3& size)
{
  Vector3 origin = random.PointInBox({}, LastSample(size));
  if (random.Integer(0, 1))
  {
    origin = { std::floor(origin[0]), std::floor(origin[1]), std::floor(origin[2]) };
  }
  Rays rays;
  ForEachPlace({ 3, 3, 3 },
    [&](const Index3& i)
    {
      const Vector3 direction = { i[0] - 1.0, i[1] - 1.0, i[2] - 1.0 };
      rays.push_back(Clip({ origin, direction }, size));
      rays.push_back(Clip({ origin - direction * (1.0 + size[0]), direction }, size));
    });
  return rays; // with one that has no direction
}

/// Through a corner of blocks, and steeply across the major axis of the first one: in a slice of
/// blocks they pass as many as rays can.
Rays SteepRays(RandomNumbers& random, const Index3& size)
{
  const Vector3 corner = { 0.0, 8.0 * random.Integer(1, 2), 8.0 * random.Integer(1, 2) };
  Rays rays = { Clip({ corner, { 1.0, 1.0, 1.0 } }, size) };
  rays.resize(RayPacket::Capacity, Clip({ corner, { 1.0, 2.0, 2.0 } }, size));
  return rays;
}

Rays OneRay(RandomNumbers& random, const Index3& size)
{
  return { Clip(RandomLine(random, size), size) };
}

/// With directions so short that they end at no finite t, if they end at all.
Rays EndlessRays(RandomNumbers& random, const Index3& size)
{
  Rays rays;
  for (int i = 0; i < 20; ++i)
  {
    Line line = RandomLine(random, size);
    line.Origin = random.PointInBox({}, LastSample(size));
    line.Direction = line.Direction * (i % 3 == 0 ? 1e-308 : i % 3 == 1 ? 3e-308 : 1e-300);
    rays.push_back(Clip(line, size));
  }
  return rays;
}

using NewRays = Rays (*)(RandomNumbers& random, const Index3& size);
constexpr NewRays AllKinds[] = { PinholeRays, ParallelRays, AxisParallelRays, LatticeRays,
  MixedRays, RaysInAllDirections, SteepRays, OneRay, EndlessRays };

//------------------------------------------------------------------------------
TestRequest OpaqueSurface(double isovalue)
{
  TestRequest request;
  request.Surfaces = { { isovalue, 1.0 } };
  return request;
}

/// Rays that were clipped between even planes, between those of a request.
Rays PlaceBetween(const UnevenPlanes* planes, Rays rays)
{
  for (std::optional<Ray>& ray : rays)
  {
    for (std::size_t axis = 0; planes && ray && axis < 3; ++axis)
    {
      if (ray->Step[axis] == 0)
      {
        ray->Inverse[axis] = planes->FindCell(axis, ray->Origin[axis]);
      }
    }
  }
  return rays;
}

RayHits TraceWith(ImageField& volume, const Rays& rays, TestRequest request, const Kernels* kernels)
{
  request.PacketKernels = kernels;
  Select(volume, request, 1);
  RayHits hits;
  Trace(volume, rays, hits);
  return hits;
}

std::string ToText(const Hit& hit, const CellLattice& lattice)
{
  const Index3 cell = lattice.GetCell(hit);
  std::ostringstream text;
  text << "t " << std::hexfloat << hit.T << " in cell " << cell[0] << ", " << cell[1] << ", "
       << cell[2] << "; ";
  return text.str();
}

/// Compares packets with single rays, and counts.
class PacketChecks
{
public:
  PacketChecks(std::string what, const Kernels& kernels)
    : What(std::move(what))
    , TheKernels(kernels)
  {
  }

  ~PacketChecks()
  {
    std::cout << "[ tried    ] " << this->What << ": " << this->Rays << " rays, " << this->Hits
              << " hits\n";
  }

  PacketChecks(const PacketChecks&) = delete;
  PacketChecks& operator=(const PacketChecks&) = delete;

  void Check(
    ImageField& volume, const vtkIsosurfaceRayTracing::Rays& rays, const TestRequest& request)
  {
    const RayHits expected = TraceWith(volume, rays, request, nullptr);
    const RayHits found = TraceWith(volume, rays, request, &this->TheKernels);
    ASSERT_EQ(expected.First.size(), rays.size() + 1);
    ASSERT_EQ(found.First.size(), rays.size() + 1);
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      const std::size_t first = expected.First[i];
      ASSERT_EQ(found.First[i], first);
      ASSERT_EQ(found.First[i + 1], expected.First[i + 1]) << this->Describe(i, rays[i], request);
      for (std::size_t hit = first; hit < expected.First[i + 1]; ++hit)
      {
        ASSERT_TRUE(AreSame(found.Hits[hit], expected.Hits[hit]))
          << ToText(found.Hits[hit], volume.GetLattice()) << "should be "
          << ToText(expected.Hits[hit], volume.GetLattice()) << this->Describe(i, rays[i], request);
      }
    }
    this->Rays += rays.size();
    this->Hits += expected.Hits.size();
  }

  /// All kinds of rays.
  void CheckAll(RandomNumbers& random, ImageField& volume, const TestRequest& request, int repeats)
  {
    for (const NewRays newRays : AllKinds)
    {
      for (int i = 0; i < repeats; ++i)
      {
        const vtkIsosurfaceRayTracing::Rays rays =
          newRays(random, volume.GetLattice().GetDimensions());
        ASSERT_NO_FATAL_FAILURE(this->Check(volume, PlaceBetween(request.Planes, rays), request));
      }
    }
  }

  std::size_t GetNumberOfHits() const { return this->Hits; }

private:
  std::string Describe(
    std::size_t number, const std::optional<Ray>& ray, const TestRequest& request) const
  {
    std::ostringstream text;
    text << this->What << ", solver " << static_cast<int>(request.Solver);
    for (const Isosurface& surface : request.Surfaces)
    {
      text << ", isovalue " << surface.Isovalue;
    }
    text << ", ray " << number;
    if (ray)
    {
      text << ": " << ToText(Line{ ray->Origin, ray->Direction }) << "t from " << ray->Begin
           << " to " << ray->End;
    }
    return text.str();
  }

  std::string What;
  const Kernels& TheKernels;
  std::size_t Rays = 0;
  std::size_t Hits = 0;
};

//------------------------------------------------------------------------------
// Volumes.

/// Sizes at the borders of blocks, and of blocks of blocks.
const std::vector<Index3> Sizes = { { 2, 2, 2 }, { 9, 9, 9 }, { 10, 17, 18 }, { 8, 25, 16 },
  { 65, 34, 3 }, { 3, 66, 2 }, { 600, 3, 4 }, { 2, 530, 9 }, { 7, 2, 1030 } };

/// Few samples inside, so that rays come far; or many; or with noise everywhere.
template <typename T>
TestVolume<T> Islands(RandomNumbers& random, const Index3& size, int percent, int stride = 1)
{
  std::vector<T> samples(Count(size));
  for (T& sample : samples)
  {
    const bool isInside = random.Integer(1, 100) <= percent;
    sample = static_cast<T>(isInside ? random.Integer(50, 100) : random.Integer(0, 49));
  }
  return TestVolume<T>(size, samples, stride);
}

ImageSettings RandomSettings(RandomNumbers& random)
{
  const BrickLayout layouts[] = { BrickLayout::Unbricked, BrickLayout::Apron,
    BrickLayout::TwoLevel };
  const int sizes[] = { 8, 8, 1, 3, 5, 64 };
  const std::vector<int> branchings[] = { { 8, 8 }, { 8 }, { 8, 2, 2 } };
  return { branchings[random.Integer(0, 2)], layouts[random.Integer(0, 2)],
    sizes[random.Integer(0, 5)], random.Integer(1, 4) };
}

class PacketTracing : public WithKernels
{
protected:
  template <typename T>
  void CheckType(const std::string& what)
  {
    RandomNumbers random(8510 + static_cast<std::uint64_t>(ScalarTypeOf<T>()));
    PacketChecks checks(what, this->TheKernels);
    for (const Index3& size : Sizes)
    {
      for (const int percent : { 1, 50 })
      {
        const auto volume = Islands<T>(random, size, percent, random.Integer(1, 2));
        const auto traced = ImageField::New(volume.View(), RandomSettings(random), 1);
        for (const double isovalue : { 50.0, 49.5, 77.3 })
        {
          ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, OpaqueSurface(isovalue), 3));
        }
      }
    }
    EXPECT_GT(checks.GetNumberOfHits(), 10000U);
  }
};
INSTANTIATE_TEST_SUITE_P(All, PacketTracing, AllKernels(), NameOfKernels);

//------------------------------------------------------------------------------
TEST_P(PacketTracing, HitWhatSingleRaysHitInSamplesOfAllTypes)
{
  this->CheckType<std::int8_t>("8 bits, signed");
  this->CheckType<std::uint8_t>("8 bits");
  this->CheckType<std::int16_t>("16 bits, signed");
  this->CheckType<std::uint16_t>("16 bits");
  this->CheckType<std::int32_t>("32 bits, signed");
  this->CheckType<std::uint32_t>("32 bits");
  this->CheckType<std::int64_t>("64 bits, signed");
  this->CheckType<std::uint64_t>("64 bits");
  this->CheckType<float>("float");
  this->CheckType<double>("double");
}

//------------------------------------------------------------------------------
TEST_P(PacketTracing, HitWhatSingleRaysHitInAllLayouts)
{
  const Index3 size = { 35, 26, 42 };
  const AnalyticFields::Gyroid tunnels = { 7.3 };
  const auto volume = TestVolume<float>::Of(size, tunnels);
  RandomNumbers random(852);
  PacketChecks checks("gyroid", this->TheKernels);
  for (const BrickLayout layout :
    { BrickLayout::Unbricked, BrickLayout::Apron, BrickLayout::TwoLevel })
  {
    for (const int brickSize : { 1, 3, 8, 64 })
    {
      const auto traced = ImageField::New(volume.View(), { { 8, 8 }, layout, brickSize, 2 }, 2);
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, OpaqueSurface(0.1), 5));
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, OpaqueSurface(1.45), 5));
    }
  }
  EXPECT_GT(checks.GetNumberOfHits(), 15000U);
}

//------------------------------------------------------------------------------
// Of sizes in which rays pass hundreds of blocks in one slice of wide cells, too.
TEST_P(PacketTracing, HitWhatSingleRaysHitBetweenUnevenPlanes)
{
  RandomNumbers random(8601);
  PacketChecks checks("uneven planes", this->TheKernels);
  for (const Unevenness& unevenness :
    { Unevenness{ 0.5, false }, { 2.0, true }, { 10.0, false }, { 10.0, true }, { 40.0, true } })
  {
    for (const Index3& size :
      { Index3{ 2, 2, 2 }, { 10, 17, 18 }, { 35, 34, 33 }, { 600, 3, 4 }, { 2, 530, 9 } })
    {
      const UnevenPlanes planes = RandomPlanes(random, size, unevenness);
      for (const int percent : { 1, 50 })
      {
        const auto volume = Islands<std::int16_t>(random, size, percent);
        const auto traced = ImageField::New(volume.View(), RandomSettings(random), 1);
        for (const std::vector<Isosurface>& surfaces :
          { std::vector<Isosurface>{ { 49.5, 1.0 } }, { { 77.3, 1.0 } }, { { 49.5, 0.1 } },
            { { 20.0, 0.3 }, { 50.0, 1.0 } }, { { 49.5, 1.0 }, { 50.0, 1.0 } } })
        {
          TestRequest request(surfaces);
          request.Planes = &planes;
          ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, request, 4));
        }
      }
    }
  }
  EXPECT_GT(checks.GetNumberOfHits(), 100000U);
}

//------------------------------------------------------------------------------
// Along one axis all cells but one are narrow, along another one is as wide as all others.
TEST_P(PacketTracing, HitWhatSingleRaysHitInSlicesOfManyBlocks)
{
  RandomNumbers random(8602);
  const Index3 size = { 160, 600, 9 };
  std::array<std::vector<double>, 3> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int last = size[axis] - 1;
    for (int i = 0; i <= last; ++i)
    {
      coordinates[axis].push_back(axis == 2 ? i : i == last ? last : 0.01 * i);
    }
  }
  coordinates[0].back() = size[0] - 1.0;
  std::reverse(coordinates[0].begin(), coordinates[0].end());
  for (double& coordinate : coordinates[0])
  {
    coordinate = size[0] - 1.0 - coordinate;
  }
  const UnevenPlanes planes(coordinates);
  PacketChecks checks("slices of many blocks", this->TheKernels);
  const auto volume = Islands<std::uint8_t>(random, size, 50);
  const auto traced = ImageField::New(volume.View(), {}, 1);
  for (const double opacity : { 1.0, 0.1 })
  {
    TestRequest request({ { 77.3, opacity } });
    request.Planes = &planes;
    Rays rays;
    for (int i = 0; i < RayPacket::Capacity; ++i)
    {
      const Vector3 from = { -1.0, random.Uniform(0.0, 0.1), random.Uniform(0.0, 8.0) };
      rays.push_back(Clip({ from, { 1.0, random.Uniform(0.01, 0.1), 0.001 } }, size));
    }
    ASSERT_NO_FATAL_FAILURE(checks.Check(*traced, rays, request));
    ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, request, 3));
  }
  EXPECT_GT(checks.GetNumberOfHits(), 5000U);
}

//------------------------------------------------------------------------------
/// So many macrocells that rays of a packet have little in common, and come to them one by one.
TEST_P(PacketTracing, HitWhatSingleRaysHitFarFromEachOther)
{
  RandomNumbers random(8603);
  const Index3 size = { 150, 140, 130 };
  PacketChecks checks("rays far from each other", this->TheKernels);
  for (const int percent : { 1, 50 })
  {
    const auto volume = Islands<std::uint8_t>(random, size, percent);
    const auto traced = ImageField::New(volume.View(), {}, 1);
    std::vector<unsigned char> hidden(Count(traced->GetLattice().GetCells()));
    for (unsigned char& isHidden : hidden)
    {
      isHidden = random.Integer(0, 1) != 0 ? 1 : 0;
    }
    for (const TestRequest& request : { OpaqueSurface(49.5), OpaqueSurface(77.0),
           TestRequest({ { 77.0, 0.1 } }), TestRequest({ { 30.0, 0.8 }, { 77.0, 0.9 } }),
           TestRequest({ { 40.0, 0.2 }, { 77.0, 1.0 } }) })
    {
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, request, 4));
      TestRequest half = request;
      half.Visible.HiddenCells = hidden.data();
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, half, 1));
      TestRequest boxes = request;
      boxes.Interpolation = Interpolant::Nearest;
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, boxes, 1));
    }
  }
  EXPECT_GT(checks.GetNumberOfHits(), 10000U);
}

//------------------------------------------------------------------------------
/// Some of the 27, between planes anywhere or in lattice planes.
CroppingRegions RandomRegions(RandomNumbers& random, const Index3& size, const UnevenPlanes* planes)
{
  CroppingRegions regions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (double& plane : regions.Planes[axis])
    {
      const int k = random.Integer(0, size[axis] - 1);
      plane = random.Integer(0, 2) == 0 ? (planes ? planes->Get(axis, k) : k)
                                        : random.Uniform(-1.0, size[axis] + 0.0);
    }
    std::sort(regions.Planes[axis].begin(), regions.Planes[axis].end());
  }
  const unsigned int few = static_cast<unsigned int>(random.Bits() & random.Bits());
  const unsigned int many = static_cast<unsigned int>(random.Bits() | random.Bits());
  regions.Visible = (random.Integer(0, 1) ? few : many) & CroppingRegions::All;
  return regions;
}

TEST_P(PacketTracing, HitWhatSingleRaysHitInCroppedRegions)
{
  RandomNumbers random(8603);
  PacketChecks checks("cropped regions", this->TheKernels);
  for (int round = 0; round < 40; ++round)
  {
    const Index3 size = round % 2 == 0 ? Index3{ 10, 17, 18 } : Index3{ 17, 34, 35 };
    const UnevenPlanes planes = RandomPlanes(random, size, { 2.0, true });
    const auto volume = Islands<float>(random, size, round % 4 < 2 ? 1 : 40);
    const auto traced = ImageField::New(volume.View(), RandomSettings(random), 1);
    for (const std::vector<Isosurface>& surfaces : { std::vector<Isosurface>{ { 49.5, 1.0 } },
           { { 49.5, 0.5 } }, { { 20.0, 0.3 }, { 50.0, 1.0 } } })
    {
      TestRequest request(surfaces);
      request.Planes = round % 3 == 0 ? &planes : nullptr;
      request.Visible.Regions = RandomRegions(random, size, request.Planes);
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, request, 2));
    }
  }
  EXPECT_GT(checks.GetNumberOfHits(), 50000U);
}

//------------------------------------------------------------------------------
/// With plateaus, where the first of equal values counts, and samples that are not finite.
template <typename T>
TestVolume<T> Plateaus(RandomNumbers& random, const Index3& size)
{
  TestVolume<T> volume = Islands<T>(random, size, random.Integer(0, 1) ? 3 : 50);
  const auto ceiling = static_cast<T>(random.Integer(60, 110));
  ForEachPlace(size,
    [&](const Index3& i)
    {
      T& sample = volume.At(i);
      sample = std::min(sample, ceiling);
      if (std::is_floating_point_v<T> && random.Integer(0, 200) == 0)
      {
        sample = static_cast<T>(random.Integer(0, 1) ? Infinity : std::nan(""));
      }
    });
  return volume;
}

/// Checks requests of images with plateaus, some of them between uneven planes, with hidden cells
/// or cropped.
template <typename T>
void CheckPlateaus(RandomNumbers& random, int rounds, PacketChecks& checks, int repeats,
  const std::function<std::vector<TestRequest>(int round)>& makeRequests)
{
  for (int round = 0; round < rounds; ++round)
  {
    const Index3 size = { random.Integer(2, 40), random.Integer(2, 40), random.Integer(2, 40) };
    const UnevenPlanes planes = RandomPlanes(random, size, { 2.0, true });
    const TestVolume<T> volume = Plateaus<T>(random, size);
    std::vector<unsigned char> hidden(Count(size));
    std::generate(hidden.begin(), hidden.end(),
      [&random] { return static_cast<unsigned char>(random.Integer(0, 5) == 0); });
    const auto traced = ImageField::New(volume.View(), RandomSettings(random), 1);
    for (TestRequest& request : makeRequests(round))
    {
      request.Planes = round % 3 == 0 ? &planes : nullptr;
      request.Visible.HiddenCells = round % 4 == 1 ? hidden.data() : nullptr;
      if (round % 4 == 2)
      {
        request.Visible.Regions = RandomRegions(random, size, request.Planes);
      }
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, request, repeats));
    }
  }
}

template <typename T>
void CheckProjections(RandomNumbers& random, PacketChecks& checks)
{
  CheckPlateaus<T>(random, 12, checks, 2,
    [](int /*round*/)
    {
      std::vector<TestRequest> requests(2);
      requests[0].Projection = Extremum::Largest;
      requests[1].Projection = Extremum::Smallest;
      return requests;
    });
}

TEST_P(PacketTracing, FindTheExtremaThatSingleRaysFind)
{
  RandomNumbers random(8604);
  PacketChecks checks("extrema", this->TheKernels);
  ASSERT_NO_FATAL_FAILURE(CheckProjections<std::int8_t>(random, checks));
  ASSERT_NO_FATAL_FAILURE(CheckProjections<std::uint16_t>(random, checks));
  ASSERT_NO_FATAL_FAILURE(CheckProjections<std::int64_t>(random, checks));
  ASSERT_NO_FATAL_FAILURE(CheckProjections<float>(random, checks));
  EXPECT_GT(checks.GetNumberOfHits(), 20000U);
}

//------------------------------------------------------------------------------
template <typename T>
void CheckBoxes(RandomNumbers& random, PacketChecks& checks)
{
  CheckPlateaus<T>(random, 16, checks, 4,
    [](int round)
    {
      std::vector<TestRequest> requests = { OpaqueSurface(round % 5 == 0 ? 49.5 : 50.0),
        TestRequest({ { 50.0, 0.1 } }), TestRequest({ { 20.0, 0.3 }, { 50.0, 1.0 } }),
        TestRequest({ { 49.9, 0.1 }, { 50.0, 0.2 }, { 50.1, 0.1 }, { 77.0, 0.2 } }) };
      for (TestRequest& request : requests)
      {
        request.Interpolation = Interpolant::Nearest;
      }
      return requests;
    });
}

TEST_P(PacketTracing, HitWhatSingleRaysHitOfBoxes)
{
  RandomNumbers random(8605);
  PacketChecks checks("boxes", this->TheKernels);
  ASSERT_NO_FATAL_FAILURE(CheckBoxes<std::uint8_t>(random, checks));
  ASSERT_NO_FATAL_FAILURE(CheckBoxes<std::int64_t>(random, checks));
  ASSERT_NO_FATAL_FAILURE(CheckBoxes<double>(random, checks));
  EXPECT_GT(checks.GetNumberOfHits(), 100000U);
}

//------------------------------------------------------------------------------
constexpr RootSolver AllSolvers[] = { RootSolver::Robust, RootSolver::Analytic, RootSolver::Marmitt,
  RootSolver::Linear };

/// Translucent and opaque, one and several, also of isovalues that no sample of the type has.
const std::vector<std::vector<Isosurface>> SetsOfSurfaces = { { { 49.5, 1.0 } }, { { 49.5, 0.5 } },
  { { 49.5, 1e-9 } }, { { 20.0, 0.3 }, { 50.0, 1.0 } }, { { 20.0, 1.0 }, { 50.0, 0.3 } },
  { { 20.0, 1.0 }, { 50.0, 1.0 } }, { { 20.0, 0.1 }, { 49.5, 0.2 }, { 50.0, 0.01 }, { 77.3, 0.9 } },
  { { 1e9, 1.0 } }, { { 50.0, 1.0 }, { 1e9, 1.0 } }, { { -1e300, 0.5 }, { 50.0, 0.5 } },
  { { -Infinity, 0.5 }, { 50.0, 0.5 }, { 32768.0, 0.5 }, { Infinity, 0.5 } },
  { { 50.0, 0.5 }, { std::nan(""), 0.5 } },
  // In the same cells, and where samples are.
  { { 49.99999999, 0.2 }, { 50.0, 0.3 }, { 50.0, 0.1 }, { 50.00000001, 0.2 } },
  { { 49.5, 0.2 }, { 50.0, 1.0 }, { 50.5, 0.2 } } };

template <typename T>
void CheckAllSolvers(RandomNumbers& random, PacketChecks& checks)
{
  for (const Index3& size : { Index3{ 10, 17, 18 }, { 17, 34, 35 } })
  {
    for (const int percent : { 1, 30 })
    {
      const auto volume = Islands<T>(random, size, percent);
      const auto traced = ImageField::New(volume.View(), RandomSettings(random), 1);
      for (const std::vector<Isosurface>& surfaces : SetsOfSurfaces)
      {
        for (const RootSolver solver : AllSolvers)
        {
          TestRequest request;
          request.Surfaces = surfaces;
          request.Solver = solver;
          ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, request, 2));
        }
      }
    }
  }
}

TEST_P(PacketTracing, HitWhatSingleRaysHitWithAllSolversAndSurfaces)
{
  RandomNumbers random(858);
  PacketChecks checks("all solvers and surfaces", this->TheKernels);
  ASSERT_NO_FATAL_FAILURE(CheckAllSolvers<std::int16_t>(random, checks));
  ASSERT_NO_FATAL_FAILURE(CheckAllSolvers<float>(random, checks));
  EXPECT_GT(checks.GetNumberOfHits(), 500000U);
}

//------------------------------------------------------------------------------
TEST_P(PacketTracing, HitWhatSingleRaysHitWithLittleMemory)
{
  RandomNumbers random(859);
  PacketChecks checks("little memory", this->TheKernels);
  const auto volume = Islands<std::uint8_t>(random, { 40, 33, 42 }, 5);
  for (const BrickLayout layout : { BrickLayout::Apron, BrickLayout::TwoLevel })
  {
    const auto traced = ImageField::New(volume.View(), { { 8, 8 }, layout, 8, 4 }, 1);
    for (const std::size_t memory : { 0, 1000, 20000 })
    {
      TestRequest request = OpaqueSurface(50.0);
      request.Budget.CacheBytes = memory;
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, request, 5));
      request.Surfaces[0].Opacity = 0.5;
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, request, 5));
    }
  }
  EXPECT_GT(checks.GetNumberOfHits(), 10000U);
}

//------------------------------------------------------------------------------
// A ray may pass several blocks of one slice; the blocks of a slice come in no order.
TEST_P(PacketTracing, HitTheFirstOfSeveralBlocksInASlice)
{
  const Index3 size = { 34, 34, 34 };
  RandomNumbers random(853);
  PacketChecks checks("several blocks", this->TheKernels);
  std::size_t several = 0;
  for (int i = 0; i < 60; ++i)
  {
    const auto volume = Islands<std::uint8_t>(random, size, 4);
    const auto traced = ImageField::New(volume.View(), {}, 1);
    Rays rays;
    for (int k = 0; k < 128; ++k)
    {
      // Along one axis a little more than along the others: through many blocks of a slice.
      const auto sign = [&random]() { return random.Integer(0, 1) ? 1.0 : -1.0; };
      Vector3 direction = { random.Uniform(0.9, 1.0) * sign(), random.Uniform(0.9, 1.0) * sign(),
        random.Uniform(0.9, 1.0) * sign() };
      direction[static_cast<std::size_t>(i) % 3] = sign();
      const Vector3 through = random.PointInBox({}, LastSample(size));
      rays.push_back(Clip({ through - direction * 40.0, direction }, size));
    }
    ASSERT_NO_FATAL_FAILURE(checks.Check(*traced, rays, OpaqueSurface(50.0)));

    TestRequest all;
    all.Surfaces = { { 50.0, 1e-9 } };
    Select(*traced, all, 1);
    RayHits hits;
    Trace(*traced, rays, hits);
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
    {
      // Whether the first two blocks with hits lie in one slice across the axis.
      const auto axis = static_cast<std::size_t>(i) % 3;
      const auto blockOf = [&hits, &traced](std::size_t hit)
      {
        const Index3 cell = traced->GetLattice().GetCell(hits.Hits[hit]);
        return Index3{ cell[0] / 8, cell[1] / 8, cell[2] / 8 };
      };
      const std::size_t first = hits.First[ray];
      std::size_t other = first;
      while (other < hits.First[ray + 1] && blockOf(other) == blockOf(first))
      {
        ++other;
      }
      several +=
        other < hits.First[ray + 1] && blockOf(other)[axis] == blockOf(first)[axis] ? 1 : 0;
    }
  }
  std::cout << "[ tried    ] " << several << " rays with hits in several blocks of a slice\n";
  EXPECT_GT(several, 500U);
}

//------------------------------------------------------------------------------
TEST_P(PacketTracing, SkipNonFiniteSamples)
{
  RandomNumbers random(854);
  PacketChecks checks("NaN and infinity", this->TheKernels);
  for (int i = 0; i < 20; ++i)
  {
    auto volume = Islands<float>(random, { 19, 26, 17 }, 5);
    for (float& value : volume.Values)
    {
      const double bad[] = { std::nan(""), Infinity, -Infinity };
      value = random.Integer(0, 19) ? value : static_cast<float>(bad[random.Integer(0, 2)]);
    }
    const auto traced = ImageField::New(volume.View(), {}, 1);
    ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, OpaqueSurface(50.0), 2));
  }
  EXPECT_GT(checks.GetNumberOfHits(), 3000U);
}

//------------------------------------------------------------------------------
// The kernels do not solve cells with such values.
TEST_P(PacketTracing, HitWhatSingleRaysHitInSamplesOfAllMagnitudes)
{
  RandomNumbers random(855);
  PacketChecks checks("all magnitudes", this->TheKernels);
  for (int i = 0; i < 30; ++i)
  {
    const double limits[][2] = { { -324.0, 308.0 }, { -324.0, -290.0 }, { -110.0, -90.0 },
      { 90.0, 110.0 }, { 290.0, 308.0 } };
    const auto& limit = limits[i % 5];
    const Index3 size = { 19, 18, 20 };
    std::vector<double> samples(Count(size));
    for (double& sample : samples)
    {
      sample = random.WideMagnitude(limit[0], limit[1]);
      sample = random.Integer(0, 29) ? -std::abs(sample) : sample;
    }
    const TestVolume<double> volume(size, samples);
    const auto traced = ImageField::New(volume.View(), {}, 1);
    for (const double isovalue : { 0.0, 1e-100, -1e100, 5e-324, 1e300 })
    {
      ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, OpaqueSurface(isovalue), 1));
    }
    const TestRequest several({ { -1e100, 0.2 }, { 0.0, 0.1 }, { 1e-100, 0.2 }, { 1e300, 0.1 } });
    ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, several, 1));
  }
  EXPECT_GT(checks.GetNumberOfHits(), 8000U);
}

//------------------------------------------------------------------------------
TEST_P(PacketTracing, SelectReplacesTheSurface)
{
  RandomNumbers random(856);
  const AnalyticFields::Gyroid tunnels = { 7.3 };
  const auto volume = TestVolume<float>::Of({ 30, 29, 28 }, tunnels);
  const auto traced = ImageField::New(volume.View(), {}, 2);
  PacketChecks checks("isovalue after isovalue", this->TheKernels);
  for (int i = 0; i < 40; ++i)
  {
    const double isovalue = i % 2 == 0 ? 0.3 : random.Uniform(-1.4, 1.4);
    ASSERT_NO_FATAL_FAILURE(checks.CheckAll(random, *traced, OpaqueSurface(isovalue), 1));
  }
  EXPECT_GT(checks.GetNumberOfHits(), 5000U);
}

//------------------------------------------------------------------------------
// Threads make masks and bricks while others read them.
TEST_P(PacketTracing, IdenticalWithSeveralThreads)
{
  const AnalyticFields::Gyroid tunnels = { 9.3 };
  const Index3 size = { 58, 57, 56 };
  const auto volume = TestVolume<float>::Of(size, tunnels);
  RandomNumbers random(857);
  std::vector<Rays> bundles;
  for (int i = 0; i < 200; ++i)
  {
    bundles.push_back(PinholeRays(random, size));
  }
  const auto alone = ImageField::New(volume.View(), {}, 1);
  for (int repeat = 0; repeat < 3; ++repeat)
  {
    const auto traced = ImageField::New(volume.View(), {}, 2);
    TestRequest request = OpaqueSurface(0.2);
    request.PacketKernels = &this->TheKernels;
    Select(*traced, request, 2);
    std::vector<RayHits> hits(bundles.size());
#pragma omp parallel for num_threads(2) schedule(dynamic)
    for (int i = 0; i < static_cast<int>(bundles.size()); ++i)
    {
      const auto index = static_cast<std::size_t>(i);
      Trace(*traced, bundles[index], hits[index]);
    }
    for (std::size_t i = 0; i < bundles.size(); ++i)
    {
      const RayHits expected = TraceWith(*alone, bundles[i], OpaqueSurface(0.2), nullptr);
      ASSERT_EQ(hits[i].First, expected.First);
      ASSERT_TRUE(std::equal(hits[i].Hits.begin(), hits[i].Hits.end(), expected.Hits.begin(),
        [](const Hit& a, const Hit& b) { return AreSame(a, b); }));
    }
  }
}

//------------------------------------------------------------------------------
// Where nothing can be hit, no rays are traced.

/// Lines through one point, or parallel, of any lengths and starting anywhere on themselves.
struct Pencil
{
  Vector3 Crossing;
  bool IsParallel;
  Line Lines[4];

  /// The line with a mean of the directions, or with a mean of the origins; in all it is long
  /// enough to pass a volume.
  Line GetMean(RandomNumbers& random) const
  {
    Line mean = { {}, {} };
    double sum = 0.0;
    for (const Line& line : this->Lines)
    {
      const double weight = random.Integer(0, 3) ? random.Uniform(0.0, 1.0) : 1e-12;
      mean.Origin = mean.Origin + line.Origin * weight;
      mean.Direction = mean.Direction + line.Direction * weight;
      sum += weight;
    }
    mean.Direction = mean.Direction * (1.0 / sum);
    mean.Origin = this->IsParallel ? mean.Origin * (1.0 / sum) : this->Crossing;
    mean.Origin = mean.Origin - Normalized(mean.Direction) * 3e6;
    return mean;
  }
};

/// Some of them aim at a point.
Pencil NewPencil(RandomNumbers& random, const Index3& size, const Vector3& target)
{
  Pencil pencil;
  const double distances[] = { 0.0, random.Uniform(0.0, 50.0), 1000.0, 9e5, 2e6 };
  const Vector3 forward = random.Integer(0, 3)
    ? random.Direction()
    : Normalized({ random.Integer(0, 1) + 0.0, random.Integer(-1, 1) + 0.0, 1.0 });
  const double distance = distances[random.Integer(0, 4)] * (random.Integer(0, 1) ? 1.0 : -1.0);
  const Vector3 through = random.Integer(0, 2) ? target : random.PointInBox({}, LastSample(size));
  pencil.Crossing = through - forward * distance;
  pencil.IsParallel = random.Integer(0, 2) == 0;
  const double widths[] = { 0.0, 1.0, 10.0, 200.0 };
  const double width = widths[random.Integer(0, 3)];
  for (Line& line : pencil.Lines)
  {
    const Vector3 off = random.PointInBox({ -width, -width, -width }, { width, width, width });
    if (pencil.IsParallel)
    {
      line = { pencil.Crossing + off, forward };
      continue;
    }
    line.Direction =
      (forward + off * (1.0 / std::max(std::abs(distance), 30.0))) * random.Uniform(0.1, 10.0);
    line.Origin = pencil.Crossing + line.Direction * random.Uniform(-30.0, 30.0);
  }
  return pencil;
}

RayPacket LinesOf(const Pencil& pencil)
{
  RayPacket lines;
  lines.Count = 4;
  lines.Exists = {};
  for (std::size_t i = 0; i < 4; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lines.Origin[axis][i] = pencil.Lines[i].Origin[axis];
      lines.Direction[axis][i] = pencil.Lines[i].Direction[axis];
    }
  }
  return lines;
}

TEST_P(PacketTracing, AreTracedWhereverRaysHit)
{
  RandomNumbers random(860);
  std::size_t withHits = 0;
  std::size_t leftOut = 0;
  std::size_t empty = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Index3 longest = { 40, 40, i % 2 == 0 ? 40 : 600 };
    Index3 size;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      size[axis] = random.Integer(2, longest[(axis + static_cast<std::size_t>(i)) % 3]);
    }
    std::vector<float> samples(Count(size), 0.0F);
    Index3 target = {};
    for (int k = random.Integer(1, 9); k > 0; --k)
    {
      target = { random.Integer(0, size[0] - 1), random.Integer(0, size[1] - 1),
        random.Integer(0, size[2] - 1) };
      samples[Offset(target, size)] = 60.0F;
    }
    const TestVolume<float> volume(size, samples);
    const auto traced = ImageField::New(volume.View(), {}, 1);
    for (int k = 0; k < 60; ++k)
    {
      const Pencil pencil =
        NewPencil(random, size, { target[0] + 0.1, target[1] + 0.1, target[2] + 0.1 });
      Rays rays;
      for (int ray = 0; ray < 30; ++ray)
      {
        rays.push_back(Clip(pencil.GetMean(random), size));
      }
      const bool hits = !TraceWith(*traced, rays, OpaqueSurface(50.0), nullptr).Hits.empty();
      TestRequest request = OpaqueSurface(50.0);
      request.PacketKernels = &this->TheKernels;
      Select(*traced, request, 1);
      RayPacket lines = LinesOf(pencil);
      const bool mayHit = traced->MayHitBetween(lines, nullptr);
      ASSERT_TRUE(mayHit || !hits) << ToText(pencil.Lines[0]) << ToText(pencil.Lines[3]);
      withHits += hits ? 1 : 0;
      empty += hits ? 0 : 1;
      leftOut += mayHit ? 0 : 1;
    }
  }
  std::cout << "[ tried    ] " << withHits << " pencils of lines with hits, " << empty
            << " without; of these, " << leftOut << " are left out\n";
  EXPECT_GT(withHits, 1000U);
  EXPECT_GT(leftOut, 1000U);
}

//------------------------------------------------------------------------------
TEST_P(PacketTracing, AreTracedWithoutHitPrediction)
{
  const auto volume = TestVolume<float>::Of({ 33, 33, 33 }, AnalyticFields::Sphere{ {}, 3.0 });
  const auto traced = ImageField::New(volume.View(), {}, 1);
  Pencil pencil = { {}, true, {} };
  std::fill_n(pencil.Lines, 4, Line{ { 20.0, 20.0, -9.0 }, { 0.0, 0.0, 1.0 } });
  const auto mayHit = [&](TestRequest request, const Pencil& of)
  {
    request.PacketKernels = request.PacketKernels ? &this->TheKernels : nullptr;
    Select(*traced, request, 1);
    RayPacket lines = LinesOf(of);
    return traced->MayHitBetween(lines, nullptr);
  };
  const TestRequest surface = OpaqueSurface(0.0);
  EXPECT_FALSE(mayHit(surface, pencil));

  TestRequest other = surface;
  other.PacketKernels = nullptr;
  EXPECT_TRUE(mayHit(other, pencil));
  other = surface;
  other.Projection = Extremum::Largest;
  EXPECT_TRUE(mayHit(other, pencil));
  other = surface;
  std::vector<double> coordinates(33);
  std::iota(coordinates.begin(), coordinates.end(), 0.0);
  coordinates[1] = 0.5;
  const UnevenPlanes planes({ coordinates, coordinates, coordinates });
  other.Planes = &planes;
  EXPECT_FALSE(mayHit(other, pencil));

  // Lines that are invalid, that diverge, that go opposite ways, or that come from too far.
  for (const Line& line : { Line{ { 20.0, std::nan(""), 0.0 }, { 0.0, 0.0, 1.0 } },
         Line{ { 20.0, 20.0, 0.0 }, { 0.0, 0.0, std::nan("") } },
         Line{ { 20.0, 20.0, 0.0 }, { 0.0, Infinity, 1.0 } },
         Line{ { 20.0, 20.0, 0.0 }, { 0.0, 0.0, 0.0 } },
         Line{ { 20.0, 20.0, 0.0 }, { 1.0, 0.0, 0.0 } },
         Line{ { 20.0, 20.0, 0.0 }, { 0.0, 0.0, -1.0 } },
         Line{ { 20.0, 20.0, -2e6 }, { 0.0, 0.0, 1.0 } } })
  {
    for (const std::size_t index : { 0, 3 })
    {
      Pencil odd = pencil;
      odd.Lines[index] = line;
      EXPECT_TRUE(mayHit(surface, odd)) << ToText(line);
    }
  }
}

//------------------------------------------------------------------------------
// The traversal has no room for so many macrocells of a slice.
TEST_P(PacketTracing, AreTracedForLinesFarApart)
{
  RandomNumbers random(861);
  const auto volume = Islands<float>(random, { 400, 400, 9 }, 50);
  const auto traced = ImageField::New(volume.View(), {}, 1);
  Pencil pencil = { {}, true, {} };
  for (int i = 0; i < 4; ++i)
  {
    pencil.Lines[i] = { { 399.0 * (i % 2), i < 2 ? 0.0 : 399.0, -9.0 }, { 0.0, 0.0, 1.0 } };
  }
  TestRequest request = OpaqueSurface(50.0);
  request.PacketKernels = &this->TheKernels;
  Select(*traced, request, 1);
  RayPacket lines = LinesOf(pencil);
  EXPECT_TRUE(traced->MayHitBetween(lines, nullptr));
}

//------------------------------------------------------------------------------
// Without this test the others might compare single rays with single rays.
TEST_P(PacketTracing, AreUsedForSuitableRays)
{
  static const Kernels* base;
  static int calls;
  base = &this->TheKernels;
  Kernels counting = this->TheKernels;
  counting.Align = [](const RayPacket& packet, const RaySet& rays, int axis, AlignedRays& aligned,
                     Frustum& frustum)
  {
    ++calls;
    return base->Align(packet, rays, axis, aligned, frustum);
  };
  const Index3 size = { 17, 18, 19 };
  const AnalyticFields::Gyroid tunnels = { 7.3 };
  const auto volume = TestVolume<float>::Of(size, tunnels);
  const auto usesPackets = [&](
                             const TestRequest& request, const ImageSettings& settings, double slow)
  {
    const auto traced = ImageField::New(volume.View(), settings, 1);
    Select(*traced, request, 1);
    RayHits hits;
    calls = 0;
    Trace(*traced, { Clip({ { 1.0, 2.0, 3.0 }, { slow, 0.5 * slow, 0.4 * slow } }, size) }, hits);
    return calls > 0;
  };
  TestRequest request = OpaqueSurface(0.2);
  request.PacketKernels = &counting;
  EXPECT_TRUE(usesPackets(request, { { 8 }, BrickLayout::Unbricked, 8, 4 }, 1.0));
  EXPECT_FALSE(usesPackets(request, { { 4, 4 }, BrickLayout::Apron, 8, 4 }, 1.0));
  EXPECT_FALSE(usesPackets(request, { {}, BrickLayout::Apron, 8, 4 }, 1.0));
  EXPECT_FALSE(usesPackets(request, {}, 1e-308));
  for (const RootSolver solver : AllSolvers)
  {
    request.Solver = solver;
    for (const std::vector<Isosurface>& surfaces : std::vector<std::vector<Isosurface>>{
           { { 0.2, 1.0 } }, { { 0.2, 0.5 } }, { { 0.2, 1.0 }, { 0.3, 1.0 } } })
    {
      request.Surfaces = surfaces;
      EXPECT_TRUE(usesPackets(request, {}, 1.0));
    }
  }
}

}
}
