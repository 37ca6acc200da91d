// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "AllKernels.h"
#include "Field/FieldSet.h"
#include "Matrices.h"
#include "Mesh/BeamFrame.h"
#include "Mesh/BeamTracer.h"
#include "Mesh/HitsOfRays.h"
#include "Mesh/MeshBeam.h"
#include "Mesh/MeshField.h"
#include "Rays/AppendBoxedRay.h"
#include "Rays/Camera.h"
#include "SameBits.h"
#include "TestMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

// Rays of a beam must have the very hits that they have by themselves.

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int Edge = 64;
constexpr Index3 Cubes = { 7, 6, 5 };
constexpr Vector3 Middle = { 3.5, 3.0, 2.5 };

/// A camera that looks at a point near the middle of the mesh.
Camera MakeCamera(const Matrix4& projection, double distance, RandomNumbers& random)
{
  const Matrix4 turn = Rotation(random.Uniform(0.0, 6.3), random.Uniform(0.0, 6.3));
  const Vector3 target = Middle + random.PointInBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 });
  const Matrix4 clipFromObject = Multiply(projection,
    Multiply(Translation({ 0.0, 0.0, -distance }), Multiply(turn, Translation(target * -1.0))));
  return Camera(clipFromObject, Invert(clipFromObject), Translation({ 0.0, 0.0, 0.0 }), Edge, Edge);
}

/// Cameras far and near, in the mesh, with parallel rays, and enlarging by up to 1e7.
std::vector<Camera> MakeCameras(RandomNumbers& random)
{
  return { MakeCamera(Perspective(1.0, 100.0, 0.3), 20.0, random),
    MakeCamera(Perspective(0.001, 100.0, 0.9), 7.0, random),
    MakeCamera(Perspective(0.001, 100.0, 0.7), 0.5, random),
    MakeCamera(Orthographic(-50.0, 50.0, 6.0), 0.0, random),
    MakeCamera(Orthographic(-50.0, 50.0, 1e-6), 0.0, random),
    MakeCamera(Perspective(1.0, 100.0, 1e-4), 20.0, random),
    MakeCamera(Perspective(1.0, 100.0, 1e-7), 20.0, random),
    MakeCamera(Perspective(1e5, 1e7, 1e-6), 1e6, random) };
}

RayPacket FindCorners(const Camera& camera, const PixelRectangle& pixels)
{
  RayPacket corners;
  corners.Clear();
  for (const int y : { pixels.Y, pixels.Y + pixels.Height - 1 })
  {
    for (const int x : { pixels.X, pixels.X + pixels.Width - 1 })
    {
      const Camera::PixelRay ray = camera.GetRay(x, y, 1.0);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        corners.Origin[axis][corners.Count] = ray.Origin[axis];
        corners.Direction[axis][corners.Count] = ray.Direction[axis];
      }
      ++corners.Count;
    }
  }
  return corners;
}

/// The hits of the rays through all pixels, by beams of tiles or one by one.
std::vector<Hit> TracePicture(MeshField& field, const Camera& camera, int tile, bool inBeams)
{
  std::vector<Hit> all;
  const auto beam = inBeams ? field.MakeBeam() : nullptr;
  for (int ty = 0; ty < Edge; ty += tile)
  {
    for (int tx = 0; tx < Edge; tx += tile)
    {
      if (beam)
      {
        field.Begin(FindCorners(camera, { tx, ty, tile, tile }), beam.get());
      }
      const int width = std::min(tile, 16);
      const int height = std::min(tile, 8);
      for (int y = ty; y < ty + tile; y += height)
      {
        for (int x = tx; x < tx + tile; x += width)
        {
          const PixelRectangle block = { x, y, width, height };
          RayPacket packet;
          RayHits hits;
          RayPacket corners = FindCorners(camera, block);
          const bool mayHit = field.MayHitBetween(corners, beam.get());
          field.MakeRays(camera, block, {}, packet);
          field.Trace(packet, hits, beam.get());
          EXPECT_TRUE(mayHit || hits.Hits.empty());
          EXPECT_EQ(hits.First.size(), static_cast<std::size_t>(width * height) + 1);
          all.insert(all.end(), hits.Hits.begin(), hits.Hits.end());
        }
      }
    }
  }
  return all;
}

/// What rays hit, and what reaches them if they start on the surface.
struct FoundByRays
{
  RayHits Hits;
  std::vector<double> Transmittance;

  FoundByRays(MeshField& field, const RayPacket& packet)
    : Transmittance(static_cast<std::size_t>(packet.Count))
  {
    RayPacket rays = packet;
    field.Trace(rays, this->Hits);
    rays = packet;
    const std::vector<Departure> departures(
      static_cast<std::size_t>(packet.Count), Departure{ 0, false });
    field.FindTransmittance(rays, departures.data(), this->Transmittance.data());
  }
};

/// Rays in any direction, to points of hits.
RayPacket MakeRaysTo(const MeshField& field, const std::vector<Hit>& hits, RandomNumbers& random)
{
  RayPacket packet;
  packet.Clear();
  const int count = random.Integer(1, RayPacket::Capacity);
  for (int i = 0; i < count; ++i)
  {
    const Vector3 target = field.GetPoint(hits[random.Bits() % hits.size()]);
    const Vector3 way = random.Direction() * random.Uniform(0.1, 10.0);
    const double end = random.Integer(0, 1) ? Infinity : random.Uniform(0.5, 1.5);
    field.AddRay(target - way, way, 0.0, end, packet);
  }
  return packet;
}

class MeshBeams : public WithKernels
{
protected:
  /// Returns the number of hits.
  std::size_t Compare(const MeshView& view, const TraceRequest& request,
    const std::vector<Camera>& cameras, int tile = 32)
  {
    MeshField field(view, 2);
    std::size_t count = 0;
    for (const Camera& camera : cameras)
    {
      field.Select(request, { 1, nullptr });
      const std::vector<Hit> alone = TracePicture(field, camera, tile, false);
      field.Select(request, { 1, &this->TheKernels });
      const std::vector<Hit> inBeams = TracePicture(field, camera, tile, true);
      EXPECT_EQ(alone.size(), inBeams.size());
      EXPECT_TRUE(AreSame(alone, inBeams));
      this->CompareLoneRays(field, request, alone);
      count += alone.size();
      this->Caps += static_cast<std::size_t>(std::count_if(
        alone.begin(), alone.end(), [](const Hit& hit) { return hit.Plane != Hit::NoPlane; }));
    }
    return count;
  }

  /// The same for rays that make no beam.
  void CompareLoneRays(
    MeshField& field, const TraceRequest& request, const std::vector<Hit>& targets)
  {
    RandomNumbers random(targets.size());
    for (int i = 0; i < 4 && !targets.empty(); ++i)
    {
      this->CompareRays(field, request, MakeRaysTo(field, targets, random));
    }
  }

  /// The same for any rays, without trees of pieces and with them. Returns the number of hits.
  std::size_t CompareRays(MeshField& field, const TraceRequest& request, const RayPacket& packet)
  {
    field.Select(request, { 1, nullptr });
    const FoundByRays alone(field, packet);
    for (const double raysForTrees : { Infinity, 0.0 })
    {
      field.Select(request, { 1, &this->TheKernels, raysForTrees });
      const FoundByRays together(field, packet);
      EXPECT_EQ(alone.Hits.First, together.Hits.First);
      EXPECT_TRUE(AreSame(alone.Hits.Hits, together.Hits.Hits));
      EXPECT_EQ(alone.Transmittance, together.Transmittance);
    }
    return alone.Hits.Hits.size();
  }

  /// Of all hits that were compared, the caps.
  std::size_t Caps = 0;
};

double NoisyWaves(RandomNumbers& random, const Index3& p)
{
  return std::sin(1.3 * p[0]) + std::cos(1.1 * p[1]) * std::sin(0.9 * p[2]) +
    random.Uniform(-0.3, 0.3);
}

/// Waves with noise; points are moved by the jitter.
TestMesh MakeNoisyMesh(RandomNumbers& random, Cutting cutting, double jitter = 0.25)
{
  return MakeMesh(
    random, Cubes, cutting, jitter, [&random](const Index3& p) { return NoisyWaves(random, p); });
}

//------------------------------------------------------------------------------
TEST_P(MeshBeams, HitWhatTheirRaysHit)
{
  std::size_t count = 0;
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(20);
    const TestMesh mesh = MakeNoisyMesh(random, cutting);
    const std::vector<Camera> cameras = MakeCameras(random);
    count += this->Compare(mesh.View(), TraceRequest({ { 0.2, 1.0 } }), cameras);
    count += this->Compare(
      mesh.View(), TraceRequest({ { -0.4, 0.5 }, { 0.0, 0.3 }, { 0.5, 1.0 } }), { cameras[0] });
  }
  std::cout << "[ tried    ] " << count << " hits\n";
  EXPECT_GT(count, 80000U);
}

//------------------------------------------------------------------------------
/// Where pieces beside and behind the camera have no labels.
TEST_P(MeshBeams, HitWhatTheirRaysHitFromWithin)
{
  std::size_t count = 0;
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(27);
    for (int i = 0; i < 6; ++i)
    {
      const TestMesh mesh = MakeNoisyMesh(random, cutting);
      const double angle = random.Uniform(0.05, 1.2);
      const double distance = random.Integer(0, 3) == 0 ? 0.0 : random.Uniform(0.0, 3.0);
      const Camera camera = MakeCamera(Perspective(1e-4, 100.0, angle), distance, random);
      count += this->Compare(mesh.View(), TraceRequest({ { 0.2, 1.0 } }), { camera });
    }
  }
  std::cout << "[ tried    ] " << count << " hits\n";
  EXPECT_GT(count, 50000U);
}

//------------------------------------------------------------------------------
/// Most pieces are beside the camera, of cells that are a thousand times as long as wide.
TEST_P(MeshBeams, HitWhatTheirRaysHitInLongCells)
{
  const Matrix4 toMiddle = Translation({ -10.3, -10.2, -9810.1 });
  const Matrix4 clipFromObject = Multiply(Perspective(1e-3, 1e5, 1.0), toMiddle);
  const Camera camera(
    clipFromObject, Invert(clipFromObject), Translation({ 0.0, 0.0, 0.0 }), Edge, Edge);
  for (const Cutting cutting : { Cutting::Tetrahedra, Cutting::Hexahedra })
  {
    RandomNumbers random(33);
    TestMesh mesh = MakeMesh(random, { 20, 20, 20 }, cutting, 0.0,
      [&random](const Index3& p) { return NoisyWaves(random, p); });
    for (std::size_t i = 2; i < mesh.Points.size(); i += 3)
    {
      mesh.Points[i] *= 1000.0;
    }
    EXPECT_GT(this->Compare(mesh.View(), TraceRequest({ { 0.9, 1.0 } }), { camera }), 2000U);
  }
}

//------------------------------------------------------------------------------
TEST_P(MeshBeams, MayHaveTilesOfAnySize)
{
  RandomNumbers random(21);
  const TestMesh mesh = MakeNoisyMesh(random, Cutting::Mixed);
  const Camera camera = MakeCamera(Perspective(1.0, 100.0, 0.2), 20.0, random);
  for (const int tile : { 1, 2, 8, Edge })
  {
    EXPECT_GT(this->Compare(mesh.View(), TraceRequest({ { 0.2, 1.0 } }), { camera }, tile), 1000U);
  }
}

//------------------------------------------------------------------------------
/// Values at the isovalue, and values so far apart that single precision cannot tell them.
TEST_P(MeshBeams, HitWhatTheirRaysHitWhateverTheValues)
{
  for (const Cutting cutting : { Cutting::Tetrahedra, Cutting::Mixed })
  {
    for (const double smallest : { 0.0, 1e-40, 1e-150, 1e-300 })
    {
      RandomNumbers random(22);
      const TestMesh mesh = MakeMesh(random, Cubes, cutting, 0.25,
        [&random, smallest](const Index3&)
        {
          const double sizes[3] = { smallest, 1.0, 1e3 * smallest };
          return sizes[random.Integer(0, 2)] * random.Integer(-2, 2);
        });
      const Camera camera = MakeCamera(Perspective(1.0, 100.0, 0.3), 20.0, random);
      const TraceRequest request({ { 0.0, 0.5 }, { 1.0, 1.0 } });
      EXPECT_GT(this->Compare(mesh.View(), request, { camera }), 1000U);
    }
  }
}

//------------------------------------------------------------------------------
TEST_P(MeshBeams, HitWhatTheirRaysHitFarFromTheOrigin)
{
  constexpr Vector3 far = { 3e6, -2e7, 1e5 };
  for (const Cutting cutting : { Cutting::Tetrahedra, Cutting::Hexahedra })
  {
    RandomNumbers random(23);
    TestMesh mesh = MakeNoisyMesh(random, cutting);
    for (std::size_t i = 0; i < mesh.Points.size(); ++i)
    {
      mesh.Points[i] += far[i % 3];
    }
    const Camera near = MakeCamera(Perspective(1.0, 100.0, 0.3), 20.0, random);
    const Matrix4 clipFromObject = Multiply(near.GetClipFromObject(), Translation(far * -1.0));
    const Matrix4 objectFromClip = Multiply(Translation(far), near.GetObjectFromClip());
    const Camera camera(clipFromObject, objectFromClip, Translation({ 0.0, 0.0, 0.0 }), Edge, Edge);
    EXPECT_GT(this->Compare(mesh.View(), TraceRequest({ { 0.2, 1.0 } }), { camera }), 1000U);
  }
}

//------------------------------------------------------------------------------
/// Some cells are a million times larger than others, flat, turned inside out or pinched.
TEST_P(MeshBeams, HitWhatTheirRaysHitInBadCells)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(24);
    TestMesh mesh = MakeNoisyMesh(random, cutting, 0.9);
    for (int i = 0; i < 40; ++i)
    {
      const auto point =
        static_cast<std::size_t>(random.Integer(0, static_cast<int>(mesh.Values.size()) - 1));
      const auto other =
        static_cast<std::size_t>(random.Integer(0, static_cast<int>(mesh.Values.size()) - 1));
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        mesh.Points[3 * point + axis] =
          i % 4 == 0 ? random.WideMagnitude(3.0, 6.0) : mesh.Points[3 * other + axis];
      }
    }
    const std::vector<Camera> cameras = { MakeCamera(Perspective(1.0, 100.0, 0.3), 20.0, random),
      MakeCamera(Perspective(0.001, 100.0, 0.7), 0.5, random) };
    for (const double opacity : { 0.5, 1.0 })
    {
      EXPECT_GT(this->Compare(mesh.View(), TraceRequest({ { 0.2, opacity } }), cameras), 1000U);
    }
  }
}

/// Cells between points of a lattice, of which many are at the place of another one, with values
/// that are whole numbers; and such cells that are turned inside out, too.
TestMesh MakeCollapsedMesh(RandomNumbers& random, Cutting cutting, bool areTurned)
{
  TestMesh mesh = MakeMesh(random, { 3, 3, 3 }, cutting, 0.0,
    [&](const Index3&)
    { return areTurned ? random.Uniform(0.0, 3.0) : static_cast<double>(random.Integer(0, 3)); });
  for (double& coordinate : mesh.Points)
  {
    coordinate += areTurned ? 0.5 * random.Integer(-2, 2) : 0.0;
  }
  for (int i = 0; i < 16; ++i)
  {
    const int point = random.Integer(0, 47); // of 64 of the lattice
    const int beside[] = { 1, 4, 16 };
    const int other = point + beside[random.Integer(0, 2)];
    std::copy_n(&mesh.Points[3 * static_cast<std::size_t>(other)], 3,
      &mesh.Points[3 * static_cast<std::size_t>(point)]);
  }
  return mesh;
}

//------------------------------------------------------------------------------
/// Rays through vertices and edges of cells that are collapsed or turned: where they have several
/// hits at one place, or next to a cell, these must not depend on other rays either.
TEST_P(MeshBeams, HitTheSameAmongAnyRays)
{
  RandomNumbers random(34);
  std::size_t count = 0;
  for (int i = 0; i < 800; ++i)
  {
    const TestMesh mesh = MakeCollapsedMesh(random, AllCuttings[1 + i % 4], i % 8 < 4);
    MeshField field(mesh.View(), 1);
    const TraceRequest request({ { 1.0, i % 16 < 8 ? 0.5 : 1.0 } });
    RayPacket packets[3];
    RayHits hits[3];
    Vector3 ways[RayPacket::Capacity];
    Vector3 targets[RayPacket::Capacity];
    for (int ray = 0; ray < RayPacket::Capacity; ++ray)
    {
      const auto getWhole = [&random](int lowest, int highest)
      { return static_cast<double>(random.Integer(lowest, highest)); };
      ways[ray] = { getWhole(-2, 2), getWhole(-2, 2), 2.0 * getWhole(0, 1) - 1.0 };
      targets[ray] =
        Vector3{ getWhole(0, 6), getWhole(0, 6), getWhole(0, 6) } * 0.5 - ways[ray] * 8.0;
    }
    for (RayPacket& packet : packets)
    {
      packet.Clear();
      for (int ray = 0; ray < RayPacket::Capacity; ++ray)
      {
        const int number = &packet == packets + 1 ? RayPacket::Capacity - 1 - ray : ray;
        field.AddRay(targets[number], ways[number], 0.0, Infinity, packet);
      }
      field.Select(request, { 1, &this->TheKernels, &packet == packets + 2 ? 0.0 : Infinity });
      field.Trace(packet, hits[&packet - packets]);
    }
    for (std::size_t ray = 0; ray < RayPacket::Capacity; ++ray)
    {
      const std::size_t other = RayPacket::Capacity - 1 - ray;
      const auto get = [](const RayHits& of, std::size_t number)
      {
        return std::vector<Hit>(of.Hits.begin() + static_cast<std::ptrdiff_t>(of.First[number]),
          of.Hits.begin() + static_cast<std::ptrdiff_t>(of.First[number + 1]));
      };
      EXPECT_TRUE(AreSame(get(hits[0], ray), get(hits[1], other)))
        << "mesh " << i << ", ray " << ray;
    }
    EXPECT_EQ(hits[0].First, hits[2].First) << "mesh " << i;
    EXPECT_TRUE(AreSame(hits[0].Hits, hits[2].Hits)) << "mesh " << i;
    count += hits[0].Hits.size();
  }
  std::cout << "[ tried    ] " << count << " hits\n";
  EXPECT_GT(count, 40000U);
}

//------------------------------------------------------------------------------
/// Without a frame rays are traced by themselves, which no test of hits would notice.
TEST(BeamFrame, IsFoundForAllDirections)
{
  RandomNumbers random(27);
  for (int i = 0; i < 10000; ++i)
  {
    const Matrix4 projections[] = { Perspective(0.1, 100.0, random.Uniform(0.01, 0.6)),
      Orthographic(-50.0, 50.0, random.Uniform(0.1, 10.0)) };
    const Camera camera = MakeCamera(projections[i % 2], random.Uniform(10.0, 30.0), random);
    const int edge = random.Integer(2, 32);
    const RayPacket lines = FindCorners(
      camera, { random.Integer(0, Edge - edge), random.Integer(0, Edge - edge), edge, edge });
    BeamFrame frame;
    const RaySet all = { { 15, 0 } };
    ASSERT_TRUE(frame.Find(lines, all, { { 0.0, 0.0, 0.0 }, { 7.0, 6.0, 5.0 } })) << i;
  }
}

//------------------------------------------------------------------------------
/// Rays without a picture: parallel ones, to a point, or in any direction.
enum class Aim
{
  Parallel,
  ToPoint,
  Any
};

RayPacket MakeRays(const MeshField& field, Aim aim, RandomNumbers& random, int count)
{
  RayPacket packet;
  packet.Clear();
  const Vector3 target = random.PointInBox({ -9.0, -9.0, 8.0 }, { 9.0, 9.0, 20.0 });
  for (int i = 0; i < count; ++i)
  {
    const Vector3 origin = random.PointInBox({ 0.0, 0.0, 0.0 }, { 7.0, 6.0, 5.0 });
    const Vector3 any = random.PointInBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 });
    const Vector3 directions[] = { target, target - origin, any };
    field.AddRay(
      origin, directions[static_cast<int>(aim)], 0.0, 1.0 + random.Integer(0, 1) * 100.0, packet);
  }
  return packet;
}

TEST_P(MeshBeams, AreMadeOfRaysWithoutPicture)
{
  std::size_t count = 0;
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(31);
    const TestMesh mesh = MakeNoisyMesh(random, cutting);
    MeshField field(mesh.View(), 1);
    for (int i = 0; i < 30; ++i)
    {
      const TraceRequest request({ { 0.2, i % 2 == 0 ? 0.5 : 1.0 } });
      const Aim aim = std::array{ Aim::Parallel, Aim::ToPoint, Aim::Any }[i % 3U];
      const RayPacket packet = MakeRays(field, aim, random, random.Integer(1, 128));
      count += this->CompareRays(field, request, packet);
    }
  }
  EXPECT_GT(count, 5000U);
}

//------------------------------------------------------------------------------
/// Most of what is between rays that are far apart would be looked at for none of them, which no
/// test of hits would notice.
TEST_P(MeshBeams, AreMadeOfRaysNextToEachOther)
{
  RandomNumbers random(32);
  const TestMesh mesh = MakeMesh(random, { 30, 30, 30 }, Cutting::Hexahedra, 0.2,
    [&random](const Index3&) { return random.Uniform(-1.0, 1.0); });
  MeshField field(mesh.View(), 1);
  const MeshCells cells(mesh.View());
  const CellTree tree(cells, 1);
  MeshSelection selection;
  selection.Cells = &cells;
  selection.Tree = &tree;
  selection.CellSize = field.GetCellSize();
  selection.PacketKernels = &this->TheKernels;
  for (const double distance : { 0.0, 0.1, 1.0, 4.0, 25.0 })
  {
    for (const bool areInRows : { false, true })
    {
      RayPacket packet;
      packet.Clear();
      for (int i = 0; i < 32; ++i)
      {
        const Vector3 place = areInRows
          ? Vector3{ 2.0 + i % 8 * distance / 8, 2.0 + i / 8 * distance / 8, 1.0 + i / 32.0 }
          : random.PointInBox({ 2.0, 2.0, 1.0 }, { 2.0 + distance, 2.0 + distance, 2.0 });
        field.AddRay(place, { 0.1, 0.2, 1.0 }, 0.0, Infinity, packet);
      }
      MeshBeam beam;
      beam.Begin(selection, packet, packet.Exists);
      EXPECT_EQ(beam.IsBeam(), distance < 25.0) << distance;
      // In a picture: the beam is that of a tile, whose rays are not known when it begins. Those
      // that follow each other are to be neighbours.
      beam.Begin(selection, packet);
      ASSERT_TRUE(beam.IsBeam());
      BeamTracer tracer;
      HitsOfRays hits;
      EXPECT_EQ(!IsEmpty(tracer.Trace(selection, packet, nullptr, beam, hits)),
        distance < (areInRows ? 25.0 : 4.0))
        << distance;
    }
  }
}

//------------------------------------------------------------------------------
/// A mesh in a set.
class MeshSource final : public FieldSource
{
public:
  explicit MeshSource(MeshField& field)
    : Field(field)
  {
  }

  TracedField& GetField() override { return this->Field; }
  Visibility FindVisible() const override { return {}; }

private:
  MeshField& Field;
};

TEST(MeshesInSets, HaveNoBeamsWithoutKernels)
{
  RandomNumbers random(25);
  const TestMesh mesh = MakeNoisyMesh(random, Cutting::Mixed);
  MeshField field(mesh.View(), 1);
  MeshSource source(field);
  PlacedField placed{};
  placed.Source = &source;
  placed.SetFromOwn = Translation({ 0.0, 0.0, 0.0 });
  placed.Box = field.GetBounds();
  FieldSet set({ placed });
  set.Select(TraceRequest({ { 0.2, 1.0 } }), { 1, nullptr });
  const Camera camera = MakeCamera(Perspective(1.0, 100.0, 0.3), 20.0, random);
  const PixelRectangle block = { Edge / 2, Edge / 2, 16, 8 };
  const auto beam = set.MakeBeam();
  set.Begin(FindCorners(camera, block), beam.get());
  RayPacket corners = FindCorners(camera, block);
  EXPECT_TRUE(set.MayHitBetween(corners, beam.get()));
  RayPacket packet;
  RayHits hits;
  set.MakeRays(camera, block, {}, packet);
  set.Trace(packet, hits, beam.get());
  EXPECT_FALSE(hits.Hits.empty());
}

//------------------------------------------------------------------------------
/// As those to a light in the mesh or just above it.
TEST_P(MeshBeams, HitWhatTheirRaysHitThatGoToAPoint)
{
  std::size_t count = 0;
  for (int i = 0; i < 100; ++i)
  {
    RandomNumbers random(static_cast<std::uint64_t>(i));
    const TestMesh mesh = MakeNoisyMesh(random, AllCuttings[i % 5]);
    MeshField field(mesh.View(), 1);
    const Vector3 inside = random.PointInBox({ 1.0, 1.0, 1.0 }, { 6.0, 5.0, 4.0 });
    const Vector3 light = i % 2 != 0 ? inside : Vector3{ inside[0], inside[1], 5.5 };
    const Vector3 corner = random.PointInBox({ 0.0, 0.0, 0.0 }, { 5.0, 4.0, 3.0 });
    RayPacket packet;
    packet.Clear();
    while (packet.Count < RayPacket::Capacity)
    {
      const Vector3 origin = corner + random.PointInBox({ 0.0, 0.0, 0.0 }, { 0.7, 0.7, 0.7 });
      field.AddRay(origin, light - origin, 0.0, i % 4 < 2 ? 1.0 : Infinity, packet);
    }
    count += this->CompareRays(field, TraceRequest({ { 0.2, 1.0 } }), packet);
  }
  std::cout << "[ tried    ] " << count << " hits\n";
  EXPECT_GT(count, 3000U);
}

//------------------------------------------------------------------------------
/// More pieces than a beam keeps.
TEST_P(MeshBeams, HitWhatTheirRaysHitAmongManyCells)
{
  RandomNumbers random(26);
  TestMesh mesh = MakeMesh(random, { 30, 30, 30 }, Cutting::Tetrahedra, 0.25,
    [&random](const Index3&) { return random.Uniform(0.0, 1.0); });
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    mesh.Points[i] += Middle[i % 3] - 15.0;
  }
  const Camera camera = MakeCamera(Perspective(10.0, 200.0, 0.3), 90.0, random);
  const TraceRequest request({ { 0.5, 1e-3 } });
  EXPECT_GT(this->Compare(mesh.View(), request, { camera }, Edge), 10000U);
}

//------------------------------------------------------------------------------
TEST_P(MeshBeams, HitWhatIsVisibleOnly)
{
  RandomNumbers random(25);
  const TestMesh mesh = MakeNoisyMesh(random, Cutting::Mixed);
  std::vector<unsigned char> hidden(mesh.Shapes.size());
  std::generate(hidden.begin(), hidden.end(),
    [&random]() { return static_cast<unsigned char>(random.Integer(0, 1)); });
  TraceRequest request({ { 0.2, 1.0 }, { 0.3, 0.5 } });
  request.Visible.HiddenCells = hidden.data();
  request.Visible.HalfSpaces = { { { 1.0, 0.2, 0.1 }, -2.0 } };
  request.Visible.Regions.Planes = { { { 2.0, 4.0 }, { 2.0, 4.0 }, { 2.0, 4.0 } } };
  request.Visible.Regions.Visible = 0x1234567;
  const std::size_t count = this->Compare(mesh.View(), request, MakeCameras(random));
  EXPECT_GT(count, 1000U);
  request.Visible = {};
  EXPECT_GT(this->Compare(mesh.View(), request, MakeCameras(random)), count);
}

//------------------------------------------------------------------------------
TEST_P(MeshBeams, HitTheCapsThatTheirRaysHit)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(28);
    const TestMesh mesh = MakeNoisyMesh(random, cutting);
    const std::vector<Camera> cameras = { MakeCamera(Perspective(1.0, 100.0, 0.2), 20.0, random),
      MakeCamera(Orthographic(-50.0, 50.0, 3.0), 0.0, random) };
    // The inside of the last is all of the mesh.
    for (const std::vector<Isosurface>& surfaces :
      { std::vector<Isosurface>{ { -1.0, 0.5 }, { 0.3, 0.5 } }, { { -1.0, 1.0 }, { 0.3, 0.5 } },
        { { -9.0, 1.0 } } })
    {
      TraceRequest request(surfaces);
      for (const Vector3& normal : { Vector3{ 1.0, 0.2, 0.1 }, Vector3{ 0.0, -1.0, 0.0 } })
      {
        request.Visible.HalfSpaces.push_back({ normal, -Dot(normal, Middle), true });
      }
      this->Compare(mesh.View(), request, cameras);
    }
  }
  std::cout << "[ tried    ] " << this->Caps << " caps\n";
  EXPECT_GT(this->Caps, 5000U);
}

//------------------------------------------------------------------------------
/// Parallel rays upwards through a unit cube, and two triangles there that cover half of it, one
/// behind the other.
struct RaysAndTriangles
{
  static constexpr Bounds Box = { { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 } };
  static constexpr double NearZ = 0.5;
  static constexpr double FarZ = 0.75;

  RayPacket Packet;
  BeamFrame Frame;
  FramedRays Framed;
  BeamRays Rays;
  BeamPieces Pieces;
  BeamPairs Pairs;

  explicit RaysAndTriangles(const Kernels& kernels)
  {
    this->Packet.Clear();
    for (int i = 0; i < RayPacket::Capacity; ++i)
    {
      AppendBoxedRay(Box, GetOrigin(i), { 0.0, 0.0, 1.0 }, 0.0, 2.0, this->Packet);
      this->Rays.Ray[i] = i;
    }
    EXPECT_TRUE(this->Frame.Find(this->Packet, this->Packet.Exists, Box));
    PackedPieces packed{};
    std::fill_n(packed.Upper, 3, 1.0F);
    packed.Count = 2;
    packed.AreInTetrahedra = true;
    const double heights[2] = { NearZ, FarZ };
    for (std::size_t piece = 0; piece < 2; ++piece)
    {
      const auto z = static_cast<std::uint32_t>(heights[piece] * PackedPieces::Steps);
      const std::uint32_t corners[] = { 0, PackedPieces::Steps, PackedPieces::Steps << 10,
        PackedPieces::Steps << 10 };
      for (std::size_t i = 0; i < PackedPieces::Corners; ++i)
      {
        packed.Polygons[i][piece] = corners[i] | z << 20;
      }
    }
    kernels.BoundPackedPieces(packed, this->Frame.GetNumbers(), this->Pieces);
  }

  void Frames(const Kernels& kernels)
  {
    kernels.FrameRays(this->Packet, this->Frame.GetNumbers(), this->Framed, this->Rays);
    this->Pairs.Count = this->Pairs.UnsureCount = 0;
  }

  static Vector3 GetOrigin(int ray)
  {
    // Two are nearer to the slanted edge than the corners are known.
    if (ray == 2 || ray == 3)
    {
      const double place = ray == 2 ? 0.4999 : 0.5001;
      return { place, place, -1.0 };
    }
    return { (0.5 + ray % 16) / 16.0, (0.5 + ray / 16) / 8.0, -1.0 };
  }
  /// By how much a ray is within the triangles, in their plane.
  static double GetInset(int ray)
  {
    const Vector3 origin = GetOrigin(ray);
    return std::min({ origin[0], origin[1], 1.0 - origin[0] - origin[1] });
  }
  bool IsSure(int ray) const
  {
    return (this->Rays.Sure[ray / BeamRays::GroupSize] >> ray % BeamRays::GroupSize & 1U) != 0;
  }
  /// How high a ray ends.
  float GetEnd(int ray) const { return this->Rays.End[ray] + 1.0F; }
};

TEST_P(MeshBeams, EndAtOnceBehindPiecesThatTheySurelyHit)
{
  RaysAndTriangles scene(this->TheKernels);
  // Some rays begin behind the first triangle, or end before it.
  scene.Packet.Begin[0] = 0.6 - scene.Packet.Origin[2][0];
  scene.Packet.End[1] = 0.4 - scene.Packet.Origin[2][1];
  scene.Frames(this->TheKernels);
  this->TheKernels.FindPairs(scene.Pieces, 0, scene.Rays, scene.Pairs);
  std::array<int, RayPacket::Capacity> pairs = {};
  for (int i = 0; i < scene.Pairs.Count; ++i)
  {
    ++pairs[static_cast<std::size_t>(scene.Pairs.Place[i])];
  }
  int sure = 0;
  for (int ray = 2; ray < RayPacket::Capacity; ++ray)
  {
    const double inset = RaysAndTriangles::GetInset(ray);
    EXPECT_EQ(scene.IsSure(ray), inset > 0.01) << ray;
    EXPECT_EQ(pairs[static_cast<std::size_t>(ray)], inset > 0.01 ? 1 : (inset < -0.01 ? 0 : 2));
    EXPECT_NEAR(scene.GetEnd(ray), inset > 0.01 ? RaysAndTriangles::NearZ : 1.0, 0.01) << ray;
    sure += scene.IsSure(ray) ? 1 : 0;
  }
  EXPECT_GT(sure, 40);
  // One that begins behind surely hits what is behind it.
  EXPECT_TRUE(scene.IsSure(0));
  EXPECT_NEAR(scene.GetEnd(0), RaysAndTriangles::FarZ, 0.01);
  EXPECT_FALSE(scene.IsSure(1));
  EXPECT_NEAR(scene.Rays.EndOfSure + 1.0F, RaysAndTriangles::FarZ, 0.01);
}

//------------------------------------------------------------------------------
TEST_P(MeshBeams, GiveUpRaysThatDoNotHitWhatTheySurelyShould)
{
  RaysAndTriangles scene(this->TheKernels);
  for (const double reached : { RaysAndTriangles::NearZ, 0.9 })
  {
    scene.Frames(this->TheKernels);
    this->TheKernels.FindPairs(scene.Pieces, 0, scene.Rays, scene.Pairs);
    RaySet sure = {};
    alignas(64) double ends[RayPacket::Capacity];
    for (int ray = 0; ray < RayPacket::Capacity; ++ray)
    {
      ends[ray] = reached - scene.Packet.Origin[2][ray];
      if (scene.IsSure(ray))
      {
        Add(ray, sure);
      }
    }
    const RaySet missed =
      this->TheKernels.EndRays(scene.Packet, scene.Frame.GetNumbers(), ends, scene.Rays);
    const bool areMissed = reached > RaysAndTriangles::NearZ;
    EXPECT_EQ(CountOf(missed), areMissed ? CountOf(sure) : 0);
    for (int ray = 0; ray < RayPacket::Capacity; ++ray)
    {
      EXPECT_TRUE(!Has(missed, ray) || Has(sure, ray));
      EXPECT_NEAR(scene.GetEnd(ray), reached, Has(missed, ray) ? HUGE_VAL : 0.01) << ray;
      EXPECT_EQ(scene.Rays.End[ray] == -HUGE_VALF, Has(missed, ray));
      EXPECT_FALSE(scene.IsSure(ray));
    }
    EXPECT_EQ(scene.Rays.EndOfSure, -HUGE_VALF);
  }
}

//------------------------------------------------------------------------------
TEST_P(MeshBeams, DoNotEndAtPiecesThatEndNothing)
{
  RaysAndTriangles scene(this->TheKernels);
  std::fill_n(scene.Pieces.Far, BeamPieces::Capacity, HUGE_VALF);
  scene.Frames(this->TheKernels);
  this->TheKernels.FindPairs(scene.Pieces, 0, scene.Rays, scene.Pairs);
  EXPECT_GT(scene.Pairs.Count, 80);
  EXPECT_EQ(scene.Pairs.UnsureCount, scene.Pairs.Count);
  for (int ray = 0; ray < RayPacket::Capacity; ++ray)
  {
    EXPECT_FALSE(scene.IsSure(ray));
    EXPECT_NEAR(scene.GetEnd(ray), 1.0, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshBeams, AllKernels(), NameOfKernels);

}
}
