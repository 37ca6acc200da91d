// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The transmittance along secondary rays, found from any crossing, is compared with that of the
// hits in order: the method of TracedField.

#include "AllKernels.h"
#include "Mesh/MeshField.h"
#include "Noise.h"
#include "RandomNumbers.h"
#include "TestMesh.h"
#include "TestRequest.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr Index3 Size = { 37, 29, 33 };

double Smooth(const AnalyticFields::Point& p)
{
  return std::sin(0.6 * p[0]) + std::cos(0.5 * p[1]) + std::sin(0.4 * p[2] + 0.3 * p[0]);
}

/// Rays that start on surfaces, and what they start on.
struct OutgoingRays
{
  RayPacket Packet;
  Departure Departures[RayPacket::Capacity];
};

OutgoingRays MakeOutgoingRays(
  RandomNumbers& random, TracedField& field, const Index3& size, bool areCoherent)
{
  OutgoingRays rays;
  rays.Packet.Count = 0;
  rays.Packet.Exists = {};
  const Vector3 common = random.Direction();
  while (rays.Packet.Count < RayPacket::Capacity)
  {
    const Vector3 target = random.PointInVolume(size);
    const Vector3 way = random.Direction();
    const std::vector<Hit> hits = Trace(field, { target - way * 60.0, way });
    if (hits.empty())
    {
      continue;
    }
    const Hit& hit = hits.front();
    const Vector3 direction = areCoherent ? common + random.Direction() * 0.05
                                          : random.Direction() * random.Uniform(0.5, 2);
    const Vector3 gradient = field.GetGradient(hit, NormalMode::InterpolantGradient);
    rays.Departures[rays.Packet.Count] = { hit.Surface, Dot(gradient, direction) > 0.0, hit.Member,
      hit.Cell };
    const double end = random.Integer(0, 1) ? Infinity : random.Uniform(0.5, 30.0);
    field.AddRay(field.GetPoint(hit), direction, 0.0, end, rays.Packet);
  }
  return rays;
}

class Transmittance : public WithKernels
{
protected:
  /// Compares both methods for some packets of rays.
  void Check(TracedField& field, std::uint64_t seed, const Index3& size = Size)
  {
    RandomNumbers random(seed);
    int dark = 0;
    int bright = 0;
    for (int run = 0; run < 12; ++run)
    {
      const OutgoingRays rays = MakeOutgoingRays(random, field, size, run % 2 == 0);
      double actual[RayPacket::Capacity];
      double expected[RayPacket::Capacity];
      RayPacket packet = rays.Packet;
      field.FindTransmittance(packet, rays.Departures, actual);
      packet = rays.Packet;
      field.TracedField::FindTransmittance(packet, rays.Departures, expected);
      for (int i = 0; i < rays.Packet.Count; ++i)
      {
        ASSERT_EQ(actual[i], expected[i]) << "ray " << i << " of packet " << run;
        ++(expected[i] < 0.5 ? dark : bright);
      }
    }
    std::cout << "[ tried    ] " << dark << " rays that are stopped, " << bright << " others\n";
    EXPECT_GT(dark, 100);
    EXPECT_GT(bright, 100);
  }

  TestRequest NewRequest(const std::vector<Isosurface>& surfaces) const
  {
    TestRequest request(surfaces);
    request.PacketKernels = &this->TheKernels;
    return request;
  }
};

//------------------------------------------------------------------------------
TEST_P(Transmittance, OfOneOpaqueSurface)
{
  const auto volume = TestVolume<float>::Of(Size, Smooth);
  for (const BrickLayout layout : { BrickLayout::Apron, BrickLayout::Unbricked })
  {
    ImageSettings settings;
    settings.Layout = layout;
    const auto field = NewTraced(volume, this->NewRequest({ { 0.3, 1.0 } }), settings);
    this->Check(*field, 11);
  }
}

//------------------------------------------------------------------------------
TEST_P(Transmittance, OfOneOpaqueSurfaceOfNoise)
{
  const auto volume = Noise<std::uint8_t>(Size, 5);
  const auto field = NewTraced(volume, this->NewRequest({ { 112.5, 1.0 } }));
  this->Check(*field, 12);
}

//------------------------------------------------------------------------------
// Small spheres far from each other: rays pass empty blocks of blocks, of two levels.
TEST_P(Transmittance, OfOneOpaqueSurfaceInManyBlocks)
{
  constexpr Index3 size = { 620, 75, 90 };
  const auto volume = TestVolume<float>::Of(size,
    [](const AnalyticFields::Point& p)
    {
      double squares = 0.0;
      for (const double coordinate : p)
      {
        const double off = std::remainder(coordinate - 11.3, 23.0);
        squares += off * off;
      }
      return 5.2 - std::sqrt(squares);
    });
  const auto field = NewTraced(volume, this->NewRequest({ { 0.0, 1.0 } }));
  this->Check(*field, 19, size);
}

//------------------------------------------------------------------------------
TEST_P(Transmittance, OfSeveralOpaqueSurfaces)
{
  const auto volume = TestVolume<std::int16_t>::Of(
    Size, [](const AnalyticFields::Point& p) { return 100.0 * Smooth(p); });
  const auto field =
    NewTraced(volume, this->NewRequest({ { -180.0, 1.0 }, { 40.0, 1.0 }, { 150.5, 1.0 } }));
  this->Check(*field, 13);
  const auto near =
    NewTraced(volume, this->NewRequest({ { 40.0, 1.0 }, { 40.0001, 1.0 }, { 41.0, 1.0 } }));
  this->Check(*near, 20);
}

//------------------------------------------------------------------------------
TEST_P(Transmittance, OfTranslucentSurfacesAndPlanes)
{
  const auto volume = TestVolume<float>::Of(Size, Smooth);
  TestRequest request = this->NewRequest({ { -1.0, 0.4 }, { 0.3, 1.0 } });
  request.Visible.HalfSpaces = { { { 1.0, 0.2, 0.1 }, -9.0 } };
  this->Check(*NewTraced(volume, request), 14);
  request.Surfaces = { { 0.3, 1.0 } };
  this->Check(*NewTraced(volume, request), 15);
}

//------------------------------------------------------------------------------
TEST_P(Transmittance, OfOtherInterpolants)
{
  const auto volume = TestVolume<float>::Of(Size, Smooth);
  TestRequest request = this->NewRequest({ { 0.3, 1.0 } });
  request.Interpolation = Interpolant::Tricubic;
  this->Check(*NewTraced(volume, request), 16);
  request.Interpolation = Interpolant::Nearest;
  this->Check(*NewTraced(volume, request), 17);
}

//------------------------------------------------------------------------------
TEST_P(Transmittance, OfUnevenSpacing)
{
  std::array<std::vector<double>, 3> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int last = Size[axis] - 1;
    for (int plane = 0; plane <= last; ++plane)
    {
      const double share = static_cast<double>(plane) / last;
      coordinates[axis].push_back(last * share * (0.5 + 0.5 * share));
    }
  }
  const UnevenPlanes planes(coordinates);
  const auto volume = TestVolume<float>::Of(Size, Smooth);
  TestRequest request = this->NewRequest({ { 0.3, 1.0 } });
  request.Planes = &planes;
  this->Check(*NewTraced(volume, request), 18);
}

//------------------------------------------------------------------------------
TEST_P(Transmittance, OfSurfacesInMeshes)
{
  constexpr Index3 cubes = { 9, 8, 7 };
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(19);
    const TestMesh mesh = MakeMesh(random, cubes, cutting, 0.2,
      [&random](const Index3& p)
      {
        return std::sin(1.3 * p[0]) + std::cos(1.1 * p[1]) * std::sin(0.9 * p[2]) +
          random.Uniform(-0.3, 0.3);
      });
    MeshField field(mesh.View(), 2);
    const auto check = [&](const TraceRequest& request)
    {
      for (const double raysForTrees : { Infinity, 0.0 })
      {
        field.Select(request, { 1, &this->TheKernels, raysForTrees });
        this->Check(field, 20, { 10, 9, 8 });
      }
    };
    TraceRequest request({ { 0.2, 1.0 } });
    check(request);
    request.Visible.HalfSpaces = { { { 1.0, 0.2, 0.1 }, -2.0 } };
    check(request);
    request.Surfaces = { { -0.4, 1.0 }, { 0.5, 1.0 } };
    check(request);
    request.Surfaces = { { -0.4, 0.5 }, { 0.5, 1.0 } };
    check(request);
  }
}

// A mesh that is smaller by a power of two has the same bits: nothing is added that has a size.
TEST_P(Transmittance, OfSurfacesInMeshesOfAnySize)
{
  RandomNumbers random(25);
  const Index3 size = { 6, 5, 4 };
  TestMesh mesh = MakeMesh(random, size, Cutting::Tetrahedra, 0.3,
    [&random](const Index3&) { return random.Uniform(-1.0, 1.0); });
  MeshField field(mesh.View(), 1);
  TestMesh smallMesh = mesh;
  constexpr double scale = 0x1p-44;
  std::transform(mesh.Points.begin(), mesh.Points.end(), smallMesh.Points.begin(),
    [](double coordinate) { return scale * coordinate; });
  MeshField small(smallMesh.View(), 1);
  for (const int run : { 0, 1, 2 })
  {
    const TraceRequest request({ { 0.1, 1.0 } });
    const Execution execution = { 1, run > 0 ? &this->TheKernels : nullptr,
      run > 1 ? 0.0 : Infinity };
    field.Select(request, execution);
    small.Select(request, execution);
    int dark = 0;
    for (int i = 0; i < 2000; ++i)
    {
      const Vector3 way = random.Direction();
      const std::vector<Hit> hits = Trace(field, { random.PointInVolume(size) - way * 60.0, way });
      if (hits.empty())
      {
        continue;
      }
      const Hit& hit = hits.front();
      const Vector3 start = field.GetPoint(hit);
      const Vector3 direction = random.Direction();
      const Vector3 gradient = field.GetGradient(hit, NormalMode::InterpolantGradient);
      const Departure departure = { hit.Surface, Dot(gradient, direction) > 0.0, hit.Member,
        hit.Cell };
      RayPacket packets[2];
      double transmittance[2];
      packets[0].Clear();
      packets[1].Clear();
      field.AddRay(start, direction, 0.0, Infinity, packets[0]);
      small.AddRay(start * scale, direction * scale, 0.0, Infinity, packets[1]);
      field.FindTransmittance(packets[0], &departure, &transmittance[0]);
      small.FindTransmittance(packets[1], &departure, &transmittance[1]);
      ASSERT_EQ(transmittance[0], transmittance[1]) << i;
      dark += transmittance[0] == 0.0 ? 1 : 0;
    }
    EXPECT_GT(dark, 100);
  }
}

//------------------------------------------------------------------------------
/// What is left of the light along a ray upwards from a surface at a height: into a layer, or out
/// of it.
double FindLightAbove(TracedField& field, double height, bool isEntering = false)
{
  RayPacket packet;
  packet.Clear();
  field.AddRay({ 1.2, 1.7, height }, { 0.1, 0.05, 1.0 }, 0.0, Infinity, packet);
  const Departure departure = { 0, isEntering };
  double transmittance = 0.0;
  field.FindTransmittance(packet, &departure, &transmittance);
  return transmittance;
}

/// Two layers, whose tops are at heights of 1.5 and 5.5.
double Layers(double z)
{
  return std::abs(z - 1.0) < 1.0 || std::abs(z - 5.0) < 1.0 ? 1.0 : 0.0;
}

//------------------------------------------------------------------------------
// Of a layer only the top is visible: light from above does not get through its inside.
TEST_P(Transmittance, OfLayersThatAreCutOpen)
{
  const auto volume =
    TestVolume<float>::Of({ 4, 4, 9 }, [](const AnalyticFields::Point& p) { return Layers(p[2]); });
  TestRequest request = this->NewRequest({ { 0.5, 1.0 } });
  for (const double opacity : { 1.0, 0.25 })
  {
    request.Surfaces[0].Opacity = opacity;
    request.Visible = {};
    EXPECT_DOUBLE_EQ(
      FindLightAbove(*NewTraced(volume, request), 1.5), (1.0 - opacity) * (1.0 - opacity));
    // The bottom of the upper layer is cropped, or its cells are hidden.
    request.Visible.Regions = { { { { -1.0, 9.0 }, { -1.0, 9.0 }, { 3.0, 5.0 } } }, ~0x3fe00U };
    EXPECT_DOUBLE_EQ(FindLightAbove(*NewTraced(volume, request), 1.5), 1.0 - opacity);
    request.Visible = {};
    std::vector<unsigned char> hidden(3 * 3 * 8, 0);
    std::fill_n(hidden.begin() + 9 * 4, 9, 1);
    request.Visible.HiddenCells = hidden.data();
    EXPECT_DOUBLE_EQ(FindLightAbove(*NewTraced(volume, request), 1.5), 1.0 - opacity);
  }
}

//------------------------------------------------------------------------------
/// Removes the cells of one of eight layers of a mesh.
void RemoveEighth(int layer, TestMesh& mesh)
{
  const auto cells = static_cast<std::ptrdiff_t>(mesh.Shapes.size() / 8);
  const auto ids = static_cast<std::ptrdiff_t>(mesh.Connectivity.size() / 8);
  const auto remove = [layer](auto& numbers, std::ptrdiff_t count)
  { numbers.erase(numbers.begin() + layer * count, numbers.begin() + (layer + 1) * count); };
  remove(mesh.Shapes, cells);
  remove(mesh.Connectivity, ids);
  mesh.Offsets.resize(mesh.Shapes.size() + 1);
}

// The same where the mesh has no cells with the bottom of the upper layer.
TEST_P(Transmittance, OfLayersInMeshesWithGaps)
{
  for (const Cutting cutting : { Cutting::Tetrahedra, Cutting::Hexahedra })
  {
    RandomNumbers random(23);
    TestMesh mesh =
      MakeMesh(random, { 3, 3, 8 }, cutting, 0.0, [](const Index3& p) { return Layers(p[2]); });
    RemoveEighth(4, mesh);
    for (const double opacity : { 1.0, 0.25 })
    {
      const TraceRequest request({ { 0.5, opacity } });
      MeshField field(mesh.View(), 1);
      for (const Kernels* kernels : { &this->TheKernels, static_cast<const Kernels*>(nullptr) })
      {
        field.Select(request, { 1, kernels });
        EXPECT_DOUBLE_EQ(FindLightAbove(field, 1.5), 1.0 - opacity);
      }
    }
  }
}

//------------------------------------------------------------------------------
// The other side of a layer may be so near that only the order of crossings tells it from the side
// that the ray starts on.
TEST_P(Transmittance, OfThinLayersInMeshes)
{
  constexpr double heights[] = { 0.0, 1.0, 1.0 + 1e-6, 1.0 + 2e-6, 2.0 };
  for (const Cutting cutting : { Cutting::Tetrahedra, Cutting::Hexahedra })
  {
    RandomNumbers random(24);
    TestMesh mesh = MakeMesh(
      random, { 3, 3, 4 }, cutting, 0.0, [](const Index3& p) { return p[2] == 2 ? 1.0 : 0.0; });
    for (std::size_t z = 2; z < mesh.Points.size(); z += 3)
    {
      mesh.Points[z] = heights[static_cast<int>(mesh.Points[z])];
    }
    MeshField field(mesh.View(), 1);
    for (const int run : { 0, 1, 2 })
    {
      const Kernels* kernels = run > 0 ? &this->TheKernels : nullptr;
      field.Select(TraceRequest({ { 0.5, 1.0 } }), { 1, kernels, run > 1 ? 0.0 : Infinity });
      const double bottom = 1.0 + 0.5e-6;
      const double top = 1.0 + 1.5e-6;
      EXPECT_EQ(FindLightAbove(field, bottom, true), 0.0);
      EXPECT_EQ(FindLightAbove(field, top, false), 1.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Transmittance, AllKernels(), NameOfKernels);

}
}
