// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Clouds by cell projection: segments that join exactly, their light against integrals that are
// found in another way, and pictures against rays that are intersected with every tetrahedron in
// extended precision.

#include "AllKernels.h"
#include "CloudReference.h"
#include "Math/Arithmetic.h"
#include "Math/Matrix.h"
#include "Matrices.h"
#include "Mesh/CellBoxes.h"
#include "Mesh/CellSubdivision.h"
#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"
#include "Mesh/MeshField.h"
#include "Picture/CloudMedium.h"
#include "Picture/CloudTileRenderer.h"
#include "Picture/CloudTransfer.h"
#include "Picture/PendingSegments.h"
#include "Picture/RenderTiles.h"
#include "RandomNumbers.h"
#include "TestMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

using Extended = long double;
constexpr Index3 Cubes = { 5, 4, 6 };

/// Transfer functions with some nodes in [-1, 1], jumps among them.
std::vector<CloudNode> MakeNodes(RandomNumbers& random, double largest)
{
  std::vector<double> values;
  for (int i = 0; i < 12; ++i)
  {
    values.push_back(random.Uniform(-1.0, 1.0));
  }
  std::sort(values.begin(), values.end());
  values[5] = values[4];
  std::vector<CloudNode> nodes;
  for (const double value : values)
  {
    const double attenuation = random.Integer(0, 3) == 0 ? 0.0 : random.Uniform(0.0, largest);
    nodes.push_back({ value, attenuation, random.PointInBox({ 0, 0, 0 }, { 1, 1, 1 }) });
  }
  return nodes;
}

//------------------------------------------------------------------------------
/// A mesh of cubes whose points are moved, but for those on its border: it is convex.
TestMesh MakeConvexMesh(RandomNumbers& random, Cutting cutting, double jitter)
{
  TestMesh mesh =
    MakeMesh(random, Cubes, cutting, jitter, [&](const Index3&) { return random.Uniform(-1, 1); });
  for (std::size_t i = 0; i < mesh.Values.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double& coordinate = mesh.Points[3 * i + axis];
      const double end = Cubes[axis];
      const bool isApex = cutting == Cutting::Pyramids || cutting == Cutting::Mixed;
      if (isApex && i >= static_cast<std::size_t>((Cubes[0] + 1) * (Cubes[1] + 1) * (Cubes[2] + 1)))
      {
        continue;
      }
      coordinate = coordinate < 0.45 ? 0.0 : (coordinate > end - 0.45 ? end : coordinate);
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
constexpr int Width = 43;
constexpr int Height = 37;

/// A camera that sees the mesh, and one within it.
Camera MakeCamera(bool isInside)
{
  const Matrix4 worldFromObject = Multiply(Rotation(0.3, 0.5), Scaling({ 1.0, 1.2, 0.9 }));
  const Vector3 center = TransformPoint(worldFromObject, { 2.5, 2.0, 3.0 });
  const Vector3 eye = center + Vector3{ 0.3, 0.2, isInside ? 0.5 : 9.0 };
  const Matrix4 clipFromObject =
    Multiply(Perspective(isInside ? 0.1 : 1.0, 30.0, isInside ? 1.2 : 0.5),
      Multiply(Invert(Translation(eye)), worldFromObject));
  return { clipFromObject, Invert(clipFromObject), worldFromObject, Width, Height };
}

/// Parallel rays along z, half a unit apart, from (0, 0) on: through points and edges of cubes.
Camera MakeParallelCamera()
{
  Matrix4 clip = {};
  clip[0] = 4.0 / Width;
  clip[3] = 1.0 / Width - 1.0;
  clip[5] = 4.0 / Height;
  clip[7] = 1.0 / Height - 1.0;
  clip[10] = 0.1;
  clip[11] = -0.5;
  clip[15] = 1.0;
  return { clip, Invert(clip), Scaling({ 1.0, 1.0, 1.0 }), Width, Height };
}

/// A scene with a cloud alone.
struct CloudScene
{
  CloudScene(const TestMesh& mesh, const std::vector<CloudNode>& nodes, const Camera& view)
    : CloudScene(mesh, ReferenceMixture{ { nodes }, true }, view)
  {
  }

  CloudScene(const TestMesh& mesh, const ReferenceMixture& mixture, const Camera& view)
    : Field(mesh.View(), 1)
    , Medium(mixture.Nodes, mixture.AreIndependent)
  {
    this->Request.HasCloud = true;
    SceneField field;
    field.Field = &this->Field;
    field.View = view;
    field.Cloud = &this->Medium;
    this->Shown.Fields = { field };
    this->Shown.Pixels = { 0, 0, Width, Height };
    this->Shown.TileWidth = CloudTile::Edge;
    this->Shown.TileHeight = CloudTile::Edge;
  }

  /// Lights it from afar and from nearby, given the materials of its clouds.
  void AddLights(const std::vector<Material>& materials, NormalMode normals)
  {
    std::vector<CloudMaterial> ofClouds;
    for (const Material& own : materials)
    {
      ofClouds.push_back({ own.Ambient, own.Diffuse, own.Specular, own.SpecularPower });
    }
    this->Medium.SetMaterials(ofClouds);
    this->Request.LitComponents = static_cast<int>(materials.size());
    this->Request.Normals = normals;
    this->Shown.Lights.resize(2);
    this->Shown.Lights[0].DiffuseColor = { 0.9, 0.8, 0.7 };
    this->Shown.Lights[0].SpecularColor = { 0.5, 0.9, 0.6 };
    this->Shown.Lights[0].Direction = Normalized(Vector3{ 0.3, 0.4, 0.9 });
    Light& nearby = this->Shown.Lights[1];
    nearby.DiffuseColor = { 0.3, 0.2, 0.9 };
    nearby.Positional = true;
    nearby.Position = { 3.0, 4.0, 9.0 };
    nearby.Direction = Normalized(Vector3{ 0.1, 0.2, 0.9 });
    nearby.ConeAngle = 30.0;
    nearby.Exponent = 1.5;
    nearby.Attenuation = { 0.5, 0.03, 0.01 };
  }

  /// The light of all pixels, unrounded.
  std::vector<std::array<double, 4>> Render(const Kernels& kernels)
  {
    this->Field.Select(this->Request, { 1, &kernels });
    Frame frame;
    frame.Colors.resize(std::size_t{ 4 } * Width * Height);
    frame.Depths.resize(std::size_t{ Width } * Height);
    std::vector<std::array<double, 4>> lights(std::size_t{ Width } * Height);
    CloudFinder finder(this->Shown, &kernels);
    CloudTileRenderer renderer(this->Shown, &kernels);
    for (int y = 0; y < Height; y += CloudTile::Edge)
    {
      for (int x = 0; x < Width; x += CloudTile::Edge)
      {
        const PixelRectangle tile = { x, y, std::min(CloudTile::Edge, Width - x),
          std::min(CloudTile::Edge, Height - y) };
        renderer.Begin(tile);
        renderer.Render(finder, frame);
        for (int j = 0; j < tile.Height; ++j)
        {
          for (int i = 0; i < tile.Width; ++i)
          {
            lights[static_cast<std::size_t>((y + j) * Width + x + i)] = renderer.GetLight(i, j);
          }
        }
      }
    }
    return lights;
  }

  TraceRequest Request;
  MeshField Field;
  CloudMedium Medium;
  Scene Shown;
};

//------------------------------------------------------------------------------
/// The segments of all rays of a tile, by pixel.
struct FoundSegment
{
  double Depth[2];
  double Value[2];

  bool operator==(const FoundSegment& other) const
  {
    return std::equal(this->Depth, this->Depth + 2, other.Depth) &&
      std::equal(this->Value, this->Value + 2, other.Value);
  }
};

/// Selects a cloud alone.
void SelectCloud(MeshField& field)
{
  TraceRequest request;
  request.HasCloud = true;
  field.Select(request, {});
}

/// If it pauses, another begin follows every few segments.
std::map<int, std::vector<FoundSegment>> FindSegments(const MeshField& field, const Camera& view,
  const PixelRectangle& pixels, const Kernels& kernels, bool pauses = false)
{
  auto tile = std::make_unique<CloudTile>();
  tile->Columns = pixels.Width;
  tile->Rows = pixels.Height;
  std::fill(std::begin(tile->Begin), std::end(tile->Begin), 0.0);
  std::fill(std::begin(tile->End), std::end(tile->End), Infinity);
  std::uint32_t open[CloudTile::Edge];
  std::fill(std::begin(open), std::end(open), ~0U);
  std::vector<ViewedCloud> clouds;
  field.AddClouds(view, { { { -Infinity, Infinity } } }, &kernels, clouds);
  CloudSource& source = *clouds.front().Source;
  source.Begin(view, pixels, *tile, -Infinity);
  std::map<int, std::vector<FoundSegment>> found;
  auto segments = std::make_unique<CloudSegments>();
  segments->Enough = pauses ? 20 : CloudSegments::Batch;
  while (source.GetNextDepth() < Infinity)
  {
    const double least = source.GetNextDepth();
    segments->Count = 0;
    source.FindMore(open, pauses && !source.IsPaused(), *segments);
    if (pauses && source.IsPaused())
    {
      source.Begin(view, pixels, *tile, source.GetNextDepth());
    }
    for (int i = 0; i < segments->Count; ++i)
    {
      EXPECT_GE(segments->Depth[0][i], least - 1e-9);
      found[segments->Pixel[i]].push_back({ { segments->Depth[0][i], segments->Depth[1][i] },
        { segments->Value[0][0][i], segments->Value[0][1][i] } });
    }
  }
  return found;
}

class CellProjection : public WithKernels
{
};

INSTANTIATE_TEST_SUITE_P(All, CellProjection, AllKernels(), NameOfKernels);

//------------------------------------------------------------------------------
/// What is found in parts, each by a begin where the last one paused, is what is found at once.
TEST_P(CellProjection, GoesOnWhereItPaused)
{
  RandomNumbers random(2);
  std::size_t pixels = 0;
  for (const Cutting cutting : AllCuttings)
  {
    const TestMesh mesh = MakeConvexMesh(random, cutting, 0.2);
    MeshField field(mesh.View(), 1);
    SelectCloud(field);
    for (const Camera& view : { MakeCamera(false), MakeCamera(true), MakeParallelCamera() })
    {
      const auto whole = FindSegments(field, view, { 14, 11, 16, 16 }, this->TheKernels);
      const auto parts = FindSegments(field, view, { 14, 11, 16, 16 }, this->TheKernels, true);
      EXPECT_TRUE(whole == parts);
      pixels += whole.size();
    }
  }
  EXPECT_GT(pixels, 1000U);
}

//------------------------------------------------------------------------------
TEST(CellSubdivision, CutsCellsWithoutRest)
{
  RandomNumbers random(1);
  for (const Cutting cutting : AllCuttings)
  {
    const TestMesh mesh = MakeConvexMesh(random, cutting, 0.2);
    Extended volume = 0;
    for (const Tetrahedron& tetrahedron : Subdivide(MeshCells(mesh.View())))
    {
      Extended edges[3][3];
      for (std::size_t i = 0; i < 3; ++i)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          edges[i][axis] = static_cast<Extended>(tetrahedron[i + 1][axis]) - tetrahedron[0][axis];
        }
      }
      volume += std::abs(Determinant(edges[0], edges[1], edges[2])) / 6;
    }
    EXPECT_NEAR(static_cast<double>(volume), Cubes[0] * Cubes[1] * Cubes[2], 1e-9);
  }
}

//------------------------------------------------------------------------------
/// A layer of many cells, all of which begin at one depth.
TEST_P(CellProjection, PausesBehindManyCellsAtOneDepth)
{
  RandomNumbers random(3);
  TestMesh mesh = MakeMesh(random, Index3{ 40, 40, 1 }, Cutting::Tetrahedra, 0.0,
    [&](const Index3&) { return random.Uniform(-1.0, 1.0); });
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    mesh.Points[i] *= i % 3 == 2 ? 1.0 : 0.15;
  }
  MeshField field(mesh.View(), 1);
  SelectCloud(field);
  const Camera view = MakeParallelCamera();
  const auto whole = FindSegments(field, view, { 0, 0, 16, 16 }, this->TheKernels);
  EXPECT_GT(whole.size(), 100U);
  EXPECT_TRUE(whole == FindSegments(field, view, { 0, 0, 16, 16 }, this->TheKernels, true));
}

//------------------------------------------------------------------------------
TEST(CellSubdivision, CutsSharedFacesAlike)
{
  RandomNumbers random(2);
  for (const Cutting cutting : AllCuttings)
  {
    const TestMesh mesh = MakeConvexMesh(random, cutting, 0.2);
    std::map<std::array<std::array<double, 4>, 3>, int> faces;
    for (Tetrahedron tetrahedron : Subdivide(MeshCells(mesh.View())))
    {
      std::sort(tetrahedron.begin(), tetrahedron.end());
      for (std::size_t without = 0; without < 4; ++without)
      {
        std::array<std::array<double, 4>, 3> face;
        for (std::size_t i = 0, k = 0; i < 4; ++i)
        {
          if (i != without)
          {
            face[k++] = tetrahedron[i];
          }
        }
        ++faces[face];
      }
    }
    const auto isOnBorder = [](const auto& face)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        for (const double side : { 0.0, static_cast<double>(Cubes[axis]) })
        {
          if (std::all_of(
                face.begin(), face.end(), [&](const auto& corner) { return corner[axis] == side; }))
          {
            return true;
          }
        }
      }
      return false;
    };
    for (const auto& [face, count] : faces)
    {
      EXPECT_EQ(count, isOnBorder(face) ? 1 : 2);
    }
  }
}

//------------------------------------------------------------------------------
/// No gaps, no overlaps: the segments of a ray in a convex mesh join to the last bit.
TEST_P(CellProjection, JoinsSegmentsExactly)
{
  RandomNumbers random(3);
  std::size_t joined = 0;
  for (const Cutting cutting : AllCuttings)
  {
    for (const double jitter : { 0.0, 0.2 })
    {
      const TestMesh mesh = MakeConvexMesh(random, cutting, jitter);
      MeshField field(mesh.View(), 1);
      SelectCloud(field);
      const Camera views[] = { MakeCamera(false), MakeCamera(true), MakeParallelCamera() };
      for (const Camera& view : views)
      {
        const bool isThroughPoints = &view == &views[2];
        for (const Index3& corner : { Index3{ 0, 0, 0 }, Index3{ 14, 11, 0 }, Index3{ 27, 21, 0 } })
        {
          const PixelRectangle pixels = { corner[0], corner[1], CloudTile::Edge, CloudTile::Edge };
          for (auto& [pixel, found] : FindSegments(field, view, pixels, this->TheKernels))
          {
            std::sort(found.begin(), found.end(),
              [](const FoundSegment& a, const FoundSegment& b)
              { return std::tie(a.Depth[0], a.Depth[1]) < std::tie(b.Depth[0], b.Depth[1]); });
            for (std::size_t i = 0; i < found.size(); ++i)
            {
              ASSERT_LT(found[i].Depth[0], found[i].Depth[1]);
              if (i > 0)
              {
                const FoundSegment& before = found[i - 1];
                if (isThroughPoints)
                {
                  // Where faces meet in a point of the ray they have one depth, but for rounding.
                  ASSERT_NEAR(before.Depth[1], found[i].Depth[0], 1e-15);
                }
                else
                {
                  ASSERT_EQ(before.Depth[1], found[i].Depth[0]);
                  // There may be a cell without length between them.
                  ASSERT_NEAR(before.Value[1], found[i].Value[0], 1e-12);
                }
                ++joined;
              }
            }
          }
        }
      }
    }
  }
  EXPECT_GT(joined, 100000U);
}

//------------------------------------------------------------------------------
/// A ray through a point of one of two cells crosses the face between them where it does in the
/// other one, to the last bit.
TEST_P(CellProjection, JoinsSegmentsBehindPoints)
{
  RandomNumbers random(16);
  auto tile = std::make_unique<CloudTile>();
  tile->Columns = CloudTile::Edge;
  tile->Rows = CloudTile::Edge;
  const double fromPoint[4][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 0, 1 }, { 0, 0, 1, 0 } };
  std::copy_n(&fromPoint[0][0], 16, &tile->FromPoint[0][0]);
  std::fill_n(tile->Open, CloudTile::Edge, 0xFFFFU);
  std::fill_n(tile->Begin, CloudTile::Capacity, 0.0);
  std::fill_n(tile->End, CloudTile::Capacity, 100.0);
  auto projected = std::make_unique<ProjectedTetrahedra>();
  auto segments = std::make_unique<CloudSegments>();
  for (int i = 0; i < 1000; ++i)
  {
    // Around the ray.
    double face[3][4];
    for (int k = 0; k < 3; ++k)
    {
      const double angle = 2.1 * k + random.Uniform(-0.3, 0.3);
      const double radius = random.Uniform(1.0, 2.0);
      const double point[4] = { radius * std::cos(angle), radius * std::sin(angle),
        random.Uniform(2.0, 3.0), random.Uniform(-1.0, 1.0) };
      std::copy_n(point, 4, face[k]);
    }
    const double before[4] = { 0.0, 0.0, random.Uniform(0.0, 1.0), random.Uniform(-1.0, 1.0) };
    const double behind[4] = { random.Uniform(0.1, 0.3), random.Uniform(0.1, 0.3),
      random.Uniform(4.0, 5.0), random.Uniform(-1.0, 1.0) };
    double corners[2][4][4];
    for (int cell = 0; cell < 2; ++cell)
    {
      std::copy_n(&face[0][0], 12, &corners[cell][0][0]);
      std::copy_n(cell == 0 ? before : behind, 4, corners[cell][3]);
    }
    this->TheKernels.ProjectTetrahedra(*tile, corners, 2, *projected);
    segments->Count = 0;
    this->TheKernels.FindSegments[0][0](*tile, *projected, 0, *segments);
    constexpr int pixel = CloudTile::Middle * CloudTile::Edge + CloudTile::Middle;
    int found[2];
    int count = 0;
    for (int k = 0; k < segments->Count; ++k)
    {
      if (segments->Pixel[k] == pixel)
      {
        ASSERT_LT(count, 2);
        found[count++] = k;
      }
    }
    ASSERT_EQ(count, 2);
    EXPECT_NEAR(segments->Depth[0][found[0]], before[2], 1e-14);
    EXPECT_EQ(segments->Depth[1][found[0]], segments->Depth[0][found[1]]) << i;
    EXPECT_EQ(segments->Value[0][1][found[0]], segments->Value[0][0][found[1]]) << i;
  }
}

//------------------------------------------------------------------------------
/// Rays along edges and through points of a mesh go through all of it.
TEST_P(CellProjection, FillsTheMesh)
{
  RandomNumbers random(4);
  for (const Cutting cutting : AllCuttings)
  {
    const TestMesh mesh = MakeConvexMesh(random, cutting, 0.0);
    MeshField field(mesh.View(), 1);
    SelectCloud(field);
    const auto found =
      FindSegments(field, MakeParallelCamera(), { 0, 0, 16, 16 }, this->TheKernels);
    // Those on the border of the mesh count as beside it or within it.
    for (int y = 1; y < 2 * Cubes[1]; ++y)
    {
      for (int x = 1; x < 2 * Cubes[0]; ++x)
      {
        ASSERT_EQ(found.count(y * CloudTile::Edge + x), 1U) << x << " " << y;
        double sum = 0.0;
        for (const FoundSegment& segment : found.at(y * CloudTile::Edge + x))
        {
          sum += segment.Depth[1] - segment.Depth[0];
        }
        EXPECT_NEAR(sum, 0.1 * Cubes[2], 1e-12);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST_P(CellProjection, IntegratesSegments)
{
  RandomNumbers random(5);
  auto tile = std::make_unique<CloudTile>();
  auto segments = std::make_unique<CloudSegments>();
  std::vector<SegmentLight> lights(CloudSegments::Capacity);
  double worst = 0.0;
  for (const double largest : { 0.1, 3.0, 1e3, 1e9 })
  {
    const std::vector<CloudNode> nodes = MakeNodes(random, largest);
    const CloudTransfer transfer(nodes);
    segments->Count = 301;
    for (int i = 0; i < segments->Count; ++i)
    {
      const int pixel = random.Integer(0, CloudTile::Capacity - 1);
      const double value = random.Uniform(-1.5, 1.5);
      const double changes[3] = { 0.0, random.Uniform(-1e-3, 1e-3), random.Uniform(-3.0, 3.0) };
      segments->Pixel[i] = pixel;
      tile->Length[pixel] = random.Uniform(0.1, 2.0);
      segments->Depth[0][i] = random.Uniform(0.0, 10.0);
      segments->Depth[1][i] = segments->Depth[0][i] + random.Uniform(0.0, 1.0);
      segments->Value[0][0][i] = i % 7 == 0 ? nodes[4].Value : value;
      segments->Value[0][1][i] = segments->Value[0][0][i] + changes[i % 3];
    }
    this->TheKernels.IntegrateSegments(*tile, transfer.GetPieces(), *segments, lights.data());
    for (int i = 0; i < segments->Count; ++i)
    {
      const SegmentLight& light = lights[static_cast<std::size_t>(i)];
      ReferenceLight<Extended> reference;
      AddSegment<Extended>(nodes,
        static_cast<Extended>(tile->Length[segments->Pixel[i]]) *
          (static_cast<Extended>(segments->Depth[1][i]) - segments->Depth[0][i]),
        segments->Value[0][0][i], segments->Value[0][1][i], reference);
      const double error = FindError(
        { light.Color[0], light.Color[1], light.Color[2], 1.0 - light.Transmittance }, reference);
      EXPECT_LT(error, 3e-6) << largest << " " << segments->Value[0][0][i];
      worst = std::max(worst, error);
    }
  }
  this->RecordProperty("worst", std::to_string(worst));
}

//------------------------------------------------------------------------------
/// Lists of any lengths, with depths that are equal but for some digits: those that are drawn are
/// drawn as one after the other, and none is left out that is not alike. Those that begin later are
/// kept.
TEST_P(CellProjection, DrawsSegmentsInOrder)
{
  struct Segment
  {
    double Depth;
    SegmentLight Light;
  };
  RandomNumbers random(15);
  int drawn = 0;
  int alike = 0;
  int later = 0;
  for (int turn = 0; turn < 20; ++turn)
  {
    PendingSegments pending;
    std::vector<std::vector<Segment>> lists(CloudTile::Capacity);
    std::vector<bool> areAlike(CloudTile::Capacity, false);
    for (int pixel = 0; pixel < CloudTile::Capacity; ++pixel)
    {
      std::vector<Segment>& list = lists[static_cast<std::size_t>(pixel)];
      const int count = random.Integer(0, turn < 10 ? 20 : 100);
      for (int i = 0; i < count; ++i)
      {
        double depth = random.Uniform(0.0, 1.0);
        if (i > 0 && random.Integer(0, 200) == 0)
        {
          const double steps[] = { 0.0, 0x1p-52, -0x1p-50, 0x1p-46 };
          depth = list.back().Depth * (1.0 + steps[random.Integer(0, 3)]);
          areAlike[static_cast<std::size_t>(pixel)] = true;
        }
        const auto part = [&random] { return static_cast<float>(random.Uniform(0.0, 1.0)); };
        const float passing = turn % 2 == 0 ? 1.0F - 0.1F * part() : part();
        list.push_back({ depth, { { part(), part(), part() }, passing } });
        pending.Add(pixel, depth, list.back().Light);
      }
    }
    const double before = turn % 3 == 0 ? Infinity : random.Uniform(0.0, 1.0);
    auto light = std::make_unique<TileLight>();
    std::fill_n(&light->Color[0][0], 3 * CloudTile::Capacity, 0.25);
    std::fill_n(light->Transmittance, CloudTile::Capacity, 0.5);
    for (int row = 0; row < CloudTile::Edge; ++row)
    {
      const auto columns = static_cast<unsigned int>(random.Integer(0, 0xFFFF));
      const unsigned int left =
        this->TheKernels.DrawSegments(pending.GetLists(), row, before, columns, *light);
      EXPECT_EQ(left & ~columns, 0U);
      for (int column = 0; column < CloudTile::Edge; ++column)
      {
        const int pixel = row * CloudTile::Edge + column;
        std::vector<Segment>& list = lists[static_cast<std::size_t>(pixel)];
        std::sort(list.begin(), list.end(),
          [](const Segment& a, const Segment& b) { return a.Depth < b.Depth; });
        const bool isDrawn = ((columns & ~left) >> column & 1U) != 0;
        EXPECT_TRUE((left >> column & 1U) == 0 || areAlike[static_cast<std::size_t>(pixel)]);
        double color = 0.25;
        double transmittance = 0.5;
        for (std::size_t i = 0; i < list.size() && isDrawn && list[i].Depth < before; ++i)
        {
          EXPECT_TRUE(i == 0 || list[i - 1].Depth < list[i].Depth);
          if (transmittance >= NegligibleLight)
          {
            color += transmittance * static_cast<double>(list[i].Light.Color[1]);
            transmittance *= static_cast<double>(list[i].Light.Transmittance);
          }
        }
        EXPECT_EQ(light->Color[1][pixel], color) << turn << " " << pixel;
        EXPECT_EQ(light->Transmittance[pixel], transmittance) << turn << " " << pixel;
        drawn += static_cast<int>(isDrawn && !list.empty());
        alike += static_cast<int>((left >> column & 1U) != 0);
      }
      this->TheKernels.KeepSegments(pending.GetLists(), row, before, columns);
      for (int column = 0; column < CloudTile::Edge; ++column)
      {
        const int pixel = row * CloudTile::Edge + column;
        std::vector<double> kept;
        for (const Segment& segment : lists[static_cast<std::size_t>(pixel)])
        {
          if ((columns >> column & 1U) != 0 && before <= segment.Depth)
          {
            kept.push_back(segment.Depth);
          }
        }
        std::vector<double> found;
        for (const std::size_t number : pending.FindOrder(pixel))
        {
          found.push_back(pending.GetDepth(number));
        }
        EXPECT_EQ(found, kept) << turn << " " << pixel;
        later += static_cast<int>(kept.size());
      }
    }
  }
  EXPECT_GT(drawn, 1500);
  EXPECT_GT(alike, 50);
  EXPECT_GT(later, 10000);
}

//------------------------------------------------------------------------------
/// Whole pictures, to less than a 10 000th.
TEST_P(CellProjection, DrawsWhatIntegralsSay)
{
  RandomNumbers random(6);
  double worst = 0.0;
  for (const Cutting cutting : AllCuttings)
  {
    const TestMesh mesh = MakeConvexMesh(random, cutting, 0.2);
    const std::vector<Tetrahedron> tetrahedra = Subdivide(MeshCells(mesh.View()));
    const std::vector<CloudNode> nodes = MakeNodes(random, 0.8);
    for (const bool isInside : { false, true })
    {
      CloudScene scene(mesh, nodes, MakeCamera(isInside));
      const auto lights = scene.Render(this->TheKernels);
      double brightest = 0.0;
      for (int y = 1; y < Height; y += 5)
      {
        for (int x = 2; x < Width; x += 7)
        {
          const ReferenceLight<Extended> reference =
            FindLight<Extended>(tetrahedra, scene.Shown.Fields.front().View, nodes, x, y);
          const std::array<double, 4>& light = lights[static_cast<std::size_t>(y * Width + x)];
          worst = std::max(worst, FindError(light, reference));
          brightest = std::max(brightest, light[3]);
        }
      }
      EXPECT_GT(brightest, 0.5);
    }
  }
  EXPECT_LT(worst, 4e-5);
  this->RecordProperty("worst", std::to_string(worst));
}

//------------------------------------------------------------------------------
/// Transfer functions of some components. If they are one cloud, the last one has the attenuation.
ReferenceMixture MakeMixture(
  RandomNumbers& random, int components, bool areIndependent, double largest)
{
  ReferenceMixture mixture{ {}, areIndependent };
  for (int i = 0; i < components; ++i)
  {
    mixture.Nodes.push_back(MakeNodes(random, largest));
    for (CloudNode& node : mixture.Nodes.back())
    {
      const bool isLast = i == components - 1;
      node.Attenuation = areIndependent || isLast ? node.Attenuation : 0.0;
      node.Color = areIndependent ? node.Color : node.Color * (isLast ? 0.0 : 1.0 / components);
    }
  }
  return mixture;
}

/// Components with random values, of which the first are those that the mesh has.
void AddComponents(RandomNumbers& random, int components, TestMesh& mesh)
{
  mesh.Components.clear();
  for (const double value : mesh.Values)
  {
    mesh.Components.push_back(value);
    for (int i = 1; i < components; ++i)
    {
      mesh.Components.push_back(random.Uniform(-1.0, 1.0));
    }
  }
}

//------------------------------------------------------------------------------
std::vector<Material> MakeMaterials(RandomNumbers& random, std::size_t count)
{
  std::vector<Material> materials(count);
  for (Material& material : materials)
  {
    material = { true, random.Uniform(0.0, 0.3), random.Uniform(0.3, 0.9), random.Uniform(0.1, 0.6),
      &material == materials.data() ? 10.0 : random.Uniform(1.0, 20.0) };
  }
  return materials;
}

//------------------------------------------------------------------------------
TEST_P(CellProjection, IntegratesMixtures)
{
  RandomNumbers random(21);
  auto tile = std::make_unique<CloudTile>();
  auto segments = std::make_unique<CloudSegments>();
  std::vector<SegmentLight> lights(CloudSegments::Capacity);
  double worst = 0.0;
  for (const int components : { 2, 3, 4, -2, -4 })
  {
    for (const double largest : { 0.1, 3.0, 1e3, 1e9, 1e30 })
    {
      const ReferenceMixture mixture =
        MakeMixture(random, std::abs(components), components > 0, largest);
      const CloudMedium medium(mixture.Nodes, mixture.AreIndependent);
      segments->Components = std::abs(components);
      segments->Count = 61;
      for (int i = 0; i < segments->Count; ++i)
      {
        const int pixel = random.Integer(0, CloudTile::Capacity - 1);
        segments->Pixel[i] = pixel;
        tile->Length[pixel] = random.Uniform(0.1, 2.0);
        segments->Depth[0][i] = random.Uniform(0.0, 10.0);
        segments->Depth[1][i] = segments->Depth[0][i] + random.Uniform(0.0, 1.0);
        for (int k = 0; k < segments->Components; ++k)
        {
          const double changes[3] = { 0.0, random.Uniform(-1e-3, 1e-3), random.Uniform(-3.0, 3.0) };
          const std::vector<CloudNode>& nodes = mixture.Nodes[static_cast<std::size_t>(k)];
          // Some begin at a jump.
          segments->Value[k][0][i] = i % 7 == k ? nodes[4].Value : random.Uniform(-1.5, 1.5);
          segments->Value[k][1][i] = segments->Value[k][0][i] + changes[random.Integer(0, 2)];
        }
      }
      this->TheKernels.IntegrateMixture(*tile, medium.GetMixed(), *segments, lights.data());
      for (int i = 0; i < segments->Count; ++i)
      {
        std::vector<std::array<Extended, 2>> values;
        for (int k = 0; k < segments->Components; ++k)
        {
          values.push_back({ segments->Value[k][0][i], segments->Value[k][1][i] });
        }
        const SegmentLight& light = lights[static_cast<std::size_t>(i)];
        EXPECT_GE(light.Transmittance, 0.0F);
        EXPECT_LE(std::max({ light.Color[0], light.Color[1], light.Color[2] }), 1.00001F);
        if (largest > 1e10)
        {
          continue; // The reference has not enough digits.
        }
        ReferenceLight<Extended> reference;
        AddMixedSegment<Extended>(mixture,
          static_cast<Extended>(tile->Length[segments->Pixel[i]]) *
            (static_cast<Extended>(segments->Depth[1][i]) - segments->Depth[0][i]),
          values, reference);
        const double error = FindError(
          { light.Color[0], light.Color[1], light.Color[2], 1.0 - light.Transmittance }, reference);
        EXPECT_LT(error, 3e-6) << components << " " << largest << " " << i;
        worst = std::max(worst, error);
      }
    }
  }
  this->RecordProperty("worst", std::to_string(worst));
}

//------------------------------------------------------------------------------
/// A mixture of one component is that component, and one of two that have the same values is
/// denser.
TEST_P(CellProjection, MixesWhatIsAlike)
{
  RandomNumbers random(22);
  TestMesh mesh = MakeConvexMesh(random, Cutting::Mixed, 0.2);
  std::vector<CloudNode> nodes = MakeNodes(random, 0.5);
  const auto once = CloudScene(mesh, nodes, MakeCamera(false)).Render(this->TheKernels);
  std::vector<CloudNode> half = nodes;
  for (CloudNode& node : half)
  {
    node.Attenuation *= 0.5;
  }
  for (const double value : mesh.Values)
  {
    mesh.Components.insert(mesh.Components.end(), { value, value });
  }
  CloudScene scene(mesh, ReferenceMixture{ { half, half }, true }, MakeCamera(false));
  const auto twice = scene.Render(this->TheKernels);
  double brightest = 0.0;
  for (std::size_t i = 0; i < once.size(); ++i)
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      EXPECT_NEAR(once[i][k], twice[i][k], 4e-5);
    }
    brightest = std::max(brightest, once[i][3]);
  }
  EXPECT_GT(brightest, 0.5);
}

//------------------------------------------------------------------------------
/// Whole pictures of mixtures, with surfaces that are not seen in them, which cut segments.
TEST_P(CellProjection, DrawsWhatIntegralsOfMixturesSay)
{
  RandomNumbers random(23);
  double worst = 0.0;
  for (const Cutting cutting : { Cutting::Tetrahedra, Cutting::Mixed })
  {
    for (const int components : { 2, 3, 4, -2, -4 })
    {
      const auto count = static_cast<std::size_t>(std::abs(components));
      TestMesh mesh = MakeConvexMesh(random, cutting, 0.2);
      AddComponents(random, std::abs(components), mesh);
      std::vector<std::vector<Tetrahedron>> tetrahedra;
      for (std::size_t i = 0; i < count; ++i)
      {
        tetrahedra.push_back(Subdivide(MeshCells(mesh.View(i))));
      }
      const ReferenceMixture mixture =
        MakeMixture(random, std::abs(components), components > 0, 0.5);
      CloudScene scene(mesh, mixture, MakeCamera(components % 2 == 0));
      const auto lights = scene.Render(this->TheKernels);
      double brightest = 0.0;
      for (int y = 1; y < Height; y += 6)
      {
        for (int x = 2; x < Width; x += 8)
        {
          const ReferenceLight<Extended> reference =
            FindMixedLight<Extended>(tetrahedra, scene.Shown.Fields.front().View, mixture, x, y);
          const std::array<double, 4>& light = lights[static_cast<std::size_t>(y * Width + x)];
          worst = std::max(worst, FindError(light, reference));
          brightest = std::max(brightest, light[0]);
        }
      }
      EXPECT_GT(brightest, 0.05) << components;
    }
  }
  EXPECT_LT(worst, 4e-5);
  this->RecordProperty("worst", std::to_string(worst));
}

//------------------------------------------------------------------------------
/// Surfaces that are not seen cut segments of mixtures, and change nothing; nor where these are lit
/// from afar, by gradients that do not change along them.
TEST_P(CellProjection, CutsSegmentsOfMixtures)
{
  RandomNumbers random(24);
  TestMesh mesh = MakeConvexMesh(random, Cutting::Tetrahedra, 0.2);
  AddComponents(random, 3, mesh);
  CloudScene scene(mesh, MakeMixture(random, 3, true, 0.5), MakeCamera(false));
  scene.AddLights(MakeMaterials(random, 3), NormalMode::InterpolantGradient);
  scene.Shown.Lights.pop_back();
  scene.Field.Select(scene.Request, { 1, &this->TheKernels });
  Frame frame;
  frame.Colors.resize(std::size_t{ 4 } * Width * Height);
  frame.Depths.resize(std::size_t{ Width } * Height);
  CloudFinder finder(scene.Shown, &this->TheKernels);
  std::vector<std::array<double, 4>> lights[2];
  for (const int fragments : { 0, 3 })
  {
    CloudTileRenderer renderer(scene.Shown, &this->TheKernels);
    renderer.Begin(PixelRectangle{ 16, 16, 16, 16 });
    for (int pixel = 0; pixel < 256 && fragments > 0; ++pixel)
    {
      const double end =
        scene.Shown.Fields.front().View.GetRay(16 + pixel % 16, 16 + pixel / 16, 1.0).End;
      const Fragment some[3] = { { 0.25 * end, {}, 0.0, 0.5F }, { 0.3 * end, {}, 0.0, 0.5F },
        { 0.35 * end, {}, 0.0, 0.5F } };
      renderer.SetFragments(pixel % 16, pixel / 16, some, 3);
    }
    renderer.Render(finder, frame);
    for (int pixel = 0; pixel < 256; ++pixel)
    {
      lights[fragments / 3].push_back(renderer.GetLight(pixel % 16, pixel / 16));
    }
  }
  EXPECT_FALSE(lights[0] == lights[1]);
  for (std::size_t i = 0; i < lights[0].size(); ++i)
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      EXPECT_NEAR(lights[0][i][k], lights[1][i][k], 1e-6);
    }
  }
}

//------------------------------------------------------------------------------
/// Cells with a value that is not finite are passed over, whichever component it is of.
TEST_P(CellProjection, PassesOverCellsThatAreNotFinite)
{
  RandomNumbers random(25);
  TestMesh mesh = MakeConvexMesh(random, Cutting::Hexahedra, 0.2);
  AddComponents(random, 2, mesh);
  const ReferenceMixture mixture = MakeMixture(random, 2, true, 0.5);
  std::vector<std::array<double, 4>> lights[2];
  for (std::size_t component = 0; component < 2; ++component)
  {
    TestMesh own = mesh;
    own.Components[2 * 100 + component] = std::nan("");
    CloudScene scene(own, mixture, MakeCamera(false));
    lights[component] = scene.Render(this->TheKernels);
  }
  EXPECT_TRUE(lights[0] == lights[1]);
  EXPECT_FALSE(lights[0] == CloudScene(mesh, mixture, MakeCamera(false)).Render(this->TheKernels));
}

//------------------------------------------------------------------------------
/// The gradient of each tetrahedron, at all of its corners.
std::vector<std::array<Vector3, 4>> FindGradients(const std::vector<Tetrahedron>& tetrahedra)
{
  std::vector<std::array<Vector3, 4>> gradients;
  for (const Tetrahedron& tetrahedron : tetrahedra)
  {
    const std::array<Extended, 3> found = FindGradient<Extended>(tetrahedron);
    const Vector3 gradient = { static_cast<double>(found[0]), static_cast<double>(found[1]),
      static_cast<double>(found[2]) };
    gradients.push_back({ gradient, gradient, gradient, gradient });
  }
  return gradients;
}

/// The means around each corner, weighted by volumes.
std::vector<std::array<Vector3, 4>> FindMeanGradients(const std::vector<Tetrahedron>& tetrahedra)
{
  struct Sum
  {
    Vector3 Gradients = {};
    double Volumes = 0.0;
  };
  std::vector<std::array<Vector3, 4>> gradients = FindGradients(tetrahedra);
  std::map<std::array<double, 3>, Sum> sums;
  const auto getPlace = [](const std::array<double, 4>& corner) {
    return std::array<double, 3>{ corner[0], corner[1], corner[2] };
  };
  for (std::size_t i = 0; i < tetrahedra.size(); ++i)
  {
    Vector3 edges[3];
    for (std::size_t k = 0; k < 3; ++k)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        edges[k][axis] = tetrahedra[i][k + 1][axis] - tetrahedra[i][0][axis];
      }
    }
    const double volume = std::abs(Dot(edges[0], Cross(edges[1], edges[2])));
    for (const std::array<double, 4>& corner : tetrahedra[i])
    {
      Sum& sum = sums[getPlace(corner)];
      sum.Gradients = sum.Gradients + gradients[i][0] * volume;
      sum.Volumes += volume;
    }
  }
  for (std::size_t i = 0; i < tetrahedra.size(); ++i)
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      const Sum& sum = sums.at(getPlace(tetrahedra[i][k]));
      gradients[i][k] = sum.Gradients * (1.0 / sum.Volumes);
    }
  }
  return gradients;
}

/// Pictures of clouds that are lit: by the gradients of tetrahedra, or by those at points.
TEST_P(CellProjection, DrawsWhatLitIntegralsSay)
{
  struct Case
  {
    Cutting Cut;
    int Components;
    NormalMode Normals;
    bool IsInside;
    bool IsTwoSided;
  };
  constexpr NormalMode ofCells = NormalMode::InterpolantGradient;
  constexpr NormalMode ofPoints = NormalMode::CentralDifferences;
  RandomNumbers random(31);
  double worst = 0.0;
  for (const Case& one : { Case{ Cutting::Tetrahedra, 1, ofCells, false, true },
         Case{ Cutting::Mixed, 1, ofCells, true, false },
         Case{ Cutting::Tetrahedra, 1, ofPoints, false, false },
         Case{ Cutting::Tetrahedra, 1, ofPoints, true, true },
         Case{ Cutting::Tetrahedra, 3, ofPoints, false, true },
         Case{ Cutting::Mixed, 2, ofCells, false, true },
         Case{ Cutting::Wedges, 4, ofCells, true, true },
         Case{ Cutting::Mixed, -2, ofCells, false, false },
         Case{ Cutting::Tetrahedra, -2, ofPoints, false, true },
         Case{ Cutting::Tetrahedra, -4, ofPoints, false, true } })
  {
    const auto count = static_cast<std::size_t>(std::abs(one.Components));
    const bool areIndependent = one.Components > 0;
    TestMesh mesh = MakeConvexMesh(random, one.Cut, 0.2);
    if (count > 1)
    {
      AddComponents(random, std::abs(one.Components), mesh);
    }
    const ReferenceMixture mixture =
      MakeMixture(random, std::abs(one.Components), areIndependent, 0.5);
    CloudScene scene(mesh, mixture, MakeCamera(one.IsInside));
    const std::vector<Material> materials = MakeMaterials(random, areIndependent ? count : 1);
    scene.AddLights(materials, one.Normals);
    scene.Shown.TwoSidedLighting = one.IsTwoSided;
    std::vector<std::vector<Tetrahedron>> tetrahedra;
    for (std::size_t i = 0; i < count; ++i)
    {
      tetrahedra.push_back(Subdivide(MeshCells(mesh.View(i))));
    }
    ReferenceLighting lighting{ &scene.Shown, materials, {} };
    for (std::size_t i = count - materials.size(); i < count; ++i)
    {
      lighting.Gradients.push_back(
        one.Normals == ofCells ? FindGradients(tetrahedra[i]) : FindMeanGradients(tetrahedra[i]));
    }
    const auto lights = scene.Render(this->TheKernels);
    double brightest = 0.0;
    double changed = 0.0;
    for (int y = 1; y < Height; y += 6)
    {
      for (int x = 2; x < Width; x += 8)
      {
        const Camera& view = scene.Shown.Fields.front().View;
        const ReferenceLight<Extended> reference =
          FindMixedLight<Extended>(tetrahedra, view, mixture, x, y, lighting);
        const std::array<double, 4>& light = lights[static_cast<std::size_t>(y * Width + x)];
        const double error = FindError(light, reference);
        worst = std::max(worst, error);
        EXPECT_LT(error, 4e-5) << one.Components << " " << x << " " << y;
        brightest = std::max(brightest, light[0]);
        changed = std::max(
          changed, FindError(light, FindMixedLight<Extended>(tetrahedra, view, mixture, x, y)));
      }
    }
    EXPECT_GT(brightest, 0.05) << one.Components;
    EXPECT_GT(changed, 0.05) << one.Components;
  }
  this->RecordProperty("worst", std::to_string(worst));
}

//------------------------------------------------------------------------------
/// Where values do not change there is no gradient, and ambient light alone.
TEST_P(CellProjection, HasAmbientLightWithoutGradient)
{
  RandomNumbers random(32);
  TestMesh mesh = MakeConvexMesh(random, Cutting::Mixed, 0.2);
  std::fill(mesh.Values.begin(), mesh.Values.end(), 0.25);
  const std::vector<CloudNode> nodes = { { 0.0, 0.4, { 0.9, 0.5, 0.2 } } };
  const auto unlit = CloudScene(mesh, nodes, MakeCamera(false)).Render(this->TheKernels);
  for (const NormalMode normals :
    { NormalMode::InterpolantGradient, NormalMode::CentralDifferences })
  {
    CloudScene scene(mesh, nodes, MakeCamera(false));
    scene.AddLights({ { true, 0.3, 0.7, 0.2, 10.0 } }, normals);
    const auto lit = scene.Render(this->TheKernels);
    for (std::size_t i = 0; i < lit.size(); ++i)
    {
      EXPECT_NEAR(lit[i][3], unlit[i][3], 1e-6);
      for (std::size_t k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(lit[i][k], 0.3 * unlit[i][k], 1e-6);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Whatever the scales of places and values are, the gradient is found.
TEST_P(CellProjection, IsLitAtAnyScale)
{
  RandomNumbers random(33);
  const TestMesh mesh = MakeConvexMesh(random, Cutting::Tetrahedra, 0.2);
  const auto render = [&](double scale, double size, NormalMode normals)
  {
    TestMesh scaled = mesh;
    std::vector<CloudNode> nodes = { { -scale, 0.0, { 0.2, 0.9, 0.5 } },
      { scale, 0.6, { 0.9, 0.2, 0.1 } } };
    for (double& value : scaled.Values)
    {
      value *= scale;
    }
    for (double& coordinate : scaled.Points)
    {
      coordinate *= size;
    }
    const Camera view = MakeCamera(false);
    const Matrix4 smaller = Scaling({ 1.0 / size, 1.0 / size, 1.0 / size });
    const Matrix4 clip = Multiply(view.GetClipFromObject(), smaller);
    const Matrix4 object = Multiply(Scaling({ size, size, size }), view.GetObjectFromClip());
    CloudScene scene(
      scaled, nodes, { clip, object, Multiply(view.GetWorldFromObject(), smaller), Width, Height });
    scene.AddLights({ { true, 0.1, 0.7, 0.2, 10.0 } }, normals);
    return scene.Render(this->TheKernels);
  };
  struct Case
  {
    double Scale;
    double Size;
    NormalMode Normals;
  };
  for (const Case& one : { Case{ 0x1p-900, 0x1p-80, NormalMode::InterpolantGradient },
         Case{ 0x1p900, 0x1p80, NormalMode::InterpolantGradient },
         Case{ 0x1p-300, 1.0, NormalMode::CentralDifferences },
         Case{ 0x1p300, 1.0, NormalMode::CentralDifferences } })
  {
    const auto expected = render(1.0, 1.0, one.Normals);
    const auto lights = render(one.Scale, one.Size, one.Normals);
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      EXPECT_NEAR(lights[i][0], expected[i][0], 1e-5);
    }
  }
}

//------------------------------------------------------------------------------
TEST(CloudTransfer, FindsValuesThatAreShown)
{
  const Vector3 gray = { 0.5, 0.5, 0.5 };
  const auto find = [](const std::vector<CloudNode>& nodes)
  {
    std::vector<std::array<double, 2>> shown;
    for (const ValueInterval& interval : CloudTransfer(nodes).FindShown())
    {
      shown.push_back({ interval.Low, interval.High });
    }
    return shown;
  };
  using Intervals = std::vector<std::array<double, 2>>;
  EXPECT_EQ(find({ { 1.0, 0.0, gray }, { 2.0, 0.0, gray } }), Intervals{});
  EXPECT_EQ(find({ { 1.0, 0.5, gray } }), (Intervals{ { -Infinity, Infinity } }));
  EXPECT_EQ(find({ { 1.0, 0.0, gray }, { 2.0, 0.0, gray }, { 3.0, 1.0, gray }, { 4.0, 0.0, gray },
              { 5.0, 0.0, gray }, { 5.0, 2.0, gray }, { 6.0, 2.0, gray }, { 6.0, 0.0, gray } }),
    (Intervals{ { 2.0, 4.0 }, { 5.0, 6.0 } }));
  EXPECT_EQ(find({ { 1.0, 1e-300, gray }, { 2.0, 0.0, gray }, { 3.0, 0.5, gray } }),
    (Intervals{ { -Infinity, Infinity } }));
}

//------------------------------------------------------------------------------
/// Cells without a value that is shown are passed over, and the light is the same.
TEST_P(CellProjection, PassesOverWhatIsNotShown)
{
  RandomNumbers random(13);
  const TestMesh mesh = MakeConvexMesh(random, Cutting::Mixed, 0.2);
  const Vector3 color = { 0.9, 0.6, 0.3 };
  const std::vector<CloudNode> nodes = { { 0.5, 0.0, color }, { 0.7, 3.0, color },
    { 0.8, 0.0, color } };
  CloudScene scene(mesh, nodes, MakeCamera(false));
  const auto lights = scene.Render(this->TheKernels);
  const std::vector<Tetrahedron> tetrahedra = Subdivide(MeshCells(mesh.View()));
  double worst = 0.0;
  double largest = 0.0;
  for (int y = 0; y < Height; y += 2)
  {
    for (int x = 0; x < Width; x += 2)
    {
      const auto& light = lights[static_cast<std::size_t>(y * Width + x)];
      worst = std::max(worst,
        FindError(
          light, FindLight<Extended>(tetrahedra, scene.Shown.Fields.front().View, nodes, x, y)));
      largest = std::max(largest, light[3]);
    }
  }
  EXPECT_LT(worst, 4e-5);
  EXPECT_GT(largest, 0.2);

  const auto count = [&](const Scene& shown)
  {
    CloudFinder finder(shown, &this->TheKernels);
    const auto rays = std::make_unique<CloudTile>();
    const auto segments = std::make_unique<CloudSegments>();
    const PixelRectangle tile = { 16, 16, 16, 16 };
    std::uint32_t open[CloudTile::Edge];
    std::fill(std::begin(open), std::end(open), ~0U);
    MakeCloudRays(shown, tile, this->TheKernels, *rays);
    finder.Begin(tile, *rays);
    int found = 0;
    while (finder.GetNextDepth() < Infinity)
    {
      finder.FindMore(open, *segments);
      found += segments->Count;
    }
    return found;
  };
  Scene maximum = scene.Shown;
  maximum.Fields.front().IsMaximum = true;
  const int all = count(maximum);
  EXPECT_GT(all, 1000);
  EXPECT_LT(count(scene.Shown), all * 4 / 5);
}

//------------------------------------------------------------------------------
/// No cell that reaches above all sides is left out, near the origin or far from it; of the others
/// nearly all are.
TEST_P(CellProjection, FindsCellsAboveSides)
{
  RandomNumbers random(12);
  for (const double offset : { 0.0, 1e4 })
  {
    TestMesh mesh = MakeMesh(random, Index3{ 12, 10, 9 }, Cutting::Mixed, 0.2,
      [&](const Index3&) { return random.Uniform(-1.0, 1.0); });
    std::for_each(
      mesh.Points.begin(), mesh.Points.end(), [offset](double& number) { number += offset; });
    const MeshCells cells(mesh.View());
    const CellTree tree(cells, 1);
    const CellBoxes boxes(cells, tree, 2);
    EXPECT_EQ(boxes.GetMemory(), 6 * 16 * tree.GetNumberOfBlocks());
    int above = 0;
    int found = 0;
    int all = 0;
    for (int repeat = 0; repeat < 20; ++repeat)
    {
      double sides[2][4];
      for (auto& side : sides)
      {
        const Vector3 point = random.PointInBox(tree.GetBounds().Lower, tree.GetBounds().Upper);
        const Vector3 normal = random.PointInBox({ -1, -1, -1 }, { 1, 1, 1 });
        std::copy(normal.begin(), normal.end(), side);
        side[3] = -(normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2]);
      }
      for (std::size_t block = 0; block < tree.GetNumberOfBlocks(); ++block)
      {
        const CellTreeNode& node = tree.GetNode(0, block / CellTree::Width);
        const auto child = static_cast<int>(block % CellTree::Width);
        const unsigned int met =
          this->TheKernels.FindMetCells(node, child, boxes.Get(block), sides, 2);
        const bool isBlockMet =
          (this->TheKernels.FindMetChildren(node, sides, 2) >> child & 1U) != 0;
        EXPECT_TRUE(isBlockMet || met == 0);
        for (int i = 0; i < tree.GetNumberOfCells(block); ++i, ++all)
        {
          MeshCell cell;
          ASSERT_TRUE(cells.Load(tree.GetCell(block, i), cell));
          const auto reaches = [&cell](const double(&side)[4])
          {
            return std::any_of(cell.Points, cell.Points + cell.Count,
              [&side](const Vector3& point) {
                return side[0] * point[0] + side[1] * point[1] + side[2] * point[2] + side[3] > 0;
              });
          };
          const bool isMet = (met >> i & 1U) != 0;
          const bool isAbove = reaches(sides[0]) && reaches(sides[1]);
          EXPECT_TRUE(isMet || !isAbove);
          found += isMet ? 1 : 0;
          above += isAbove ? 1 : 0;
        }
      }
    }
    EXPECT_GT(above, all / 20);
    EXPECT_LT(above, all / 2);
    EXPECT_LT(found, above + all / 20);
  }
}

//------------------------------------------------------------------------------
TEST(CellProjection, HasTheSameBitsWithAllKernels)
{
  RandomNumbers random(7);
  TestMesh mesh = MakeConvexMesh(random, Cutting::Mixed, 0.2);
  for (const int components : { 1, 2, 4, -4 })
  {
    AddComponents(random, std::abs(components), mesh);
    CloudScene scene(
      mesh, MakeMixture(random, std::abs(components), components > 0, 2.0), MakeCamera(false));
    for (const bool isLit : { false, true })
    {
      if (isLit)
      {
        const auto clouds = static_cast<std::size_t>(std::max(components, 1));
        scene.AddLights(MakeMaterials(random, clouds), NormalMode::CentralDifferences);
      }
      const auto expected = scene.Render(*GetKernels().front());
      for (const Kernels* kernels : GetKernels())
      {
        EXPECT_TRUE(expected == scene.Render(*kernels)) << components << " " << isLit;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(CellProjection, HasTheSameBitsWithAnyThreads)
{
  RandomNumbers random(8);
  const TestMesh mesh = MakeConvexMesh(random, Cutting::Tetrahedra, 0.2);
  CloudScene scene(mesh, MakeNodes(random, 2.0), MakeCamera(false));
  scene.Field.Select(scene.Request, {});
  const auto render = [&scene](int threads)
  {
    Frame frame;
    FrameTimes times;
    EXPECT_TRUE(RenderTiles(scene.Shown, { threads }, frame, times, [](double) { return true; }));
    return frame.Colors;
  };
  const std::vector<std::uint8_t> expected = render(1);
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 100);
  EXPECT_EQ(expected, render(2));
  EXPECT_EQ(expected, render(7));
}

//------------------------------------------------------------------------------
/// A cloud that is cut by a plane, and the other side of it: light passes both, one after the
/// other.
TEST_P(CellProjection, IsCutByHalfSpaces)
{
  RandomNumbers random(9);
  const TestMesh mesh = MakeConvexMesh(random, Cutting::Tetrahedra, 0.2);
  CloudScene scene(mesh, MakeNodes(random, 0.5), MakeCamera(false));
  const auto whole = scene.Render(this->TheKernels);
  const Vector3 normal = { 0.3, -0.2, 0.9 };
  scene.Request.Visible.HalfSpaces = { { normal, -2.4 } };
  const auto one = scene.Render(this->TheKernels);
  scene.Request.Visible.HalfSpaces = { { normal * -1.0, 2.4 } };
  const auto other = scene.Render(this->TheKernels);
  std::size_t both = 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    const double transmittance = (1.0 - one[i][3]) * (1.0 - other[i][3]);
    EXPECT_NEAR(1.0 - whole[i][3], transmittance, 1e-4);
    both += one[i][3] > 0.0 && other[i][3] > 0.0 ? 1 : 0;
  }
  EXPECT_GT(both, 200U);
}

//------------------------------------------------------------------------------
/// Surfaces in a cloud: what lies before them and behind them is drawn in this order.
TEST_P(CellProjection, DrawsFragmentsInTheCloud)
{
  RandomNumbers random(10);
  const TestMesh mesh = MakeConvexMesh(random, Cutting::Tetrahedra, 0.2);
  const std::vector<CloudNode> nodes = MakeNodes(random, 0.5);
  const std::vector<Tetrahedron> tetrahedra = Subdivide(MeshCells(mesh.View()));
  CloudScene scene(mesh, nodes, MakeCamera(false));
  scene.Field.Select(scene.Request, { 1, &this->TheKernels });
  CloudTileRenderer renderer(scene.Shown, &this->TheKernels);
  renderer.Begin(PixelRectangle{ 16, 16, 16, 16 });
  const Camera& view = scene.Shown.Fields.front().View;
  // Two translucent ones and an opaque one, at random places of each ray.
  std::map<int, std::vector<Fragment>> fragments;
  for (int pixel = 0; pixel < 256; ++pixel)
  {
    const double end = view.GetRay(16 + pixel % 16, 16 + pixel / 16, 1.0).End;
    std::vector<Fragment>& some = fragments[pixel];
    for (const double opacity : { 0.3, 0.6, 1.0 })
    {
      const Vector3 color = random.PointInBox({ 0, 0, 0 }, { 1, 1, 1 });
      some.push_back({ random.Uniform(0.2, 0.5) * end, color * opacity, opacity, 0.5F });
    }
    std::sort(
      some.begin(), some.end(), [](const Fragment& a, const Fragment& b) { return a.T < b.T; });
    const auto opaque = std::find_if(
      some.begin(), some.end(), [](const Fragment& fragment) { return fragment.Opacity >= 1.0; });
    some.erase(opaque + 1, some.end());
    renderer.SetFragments(pixel % 16, pixel / 16, some.data(), some.size());
  }
  Frame frame;
  frame.Colors.resize(std::size_t{ 4 } * Width * Height);
  frame.Depths.resize(std::size_t{ Width } * Height);
  CloudFinder finder(scene.Shown, &this->TheKernels);
  renderer.Render(finder, frame);
  for (int pixel = 0; pixel < 256; pixel += 3)
  {
    const int x = 16 + pixel % 16;
    const int y = 16 + pixel / 16;
    const Camera::PixelRay ray = view.GetRay(x, y, 1.0);
    const Extended unit = Length(TransformDirection(view.GetWorldFromObject(), ray.Direction));
    ReferenceLight<Extended> light;
    double from = 0.0;
    for (const Fragment& fragment : fragments[pixel])
    {
      std::vector<ReferenceSegment<Extended>> segments;
      for (const Tetrahedron& tetrahedron : tetrahedra)
      {
        ReferenceSegment<Extended> segment;
        Camera::PixelRay part = ray;
        part.Origin = ray.Origin + ray.Direction * from;
        part.End = fragment.T - from;
        if (Intersect(tetrahedron, part, segment))
        {
          segments.push_back(segment);
        }
      }
      std::sort(segments.begin(), segments.end(),
        [](const auto& a, const auto& b) { return a.T[0] < b.T[0]; });
      for (const ReferenceSegment<Extended>& segment : segments)
      {
        AddSegment<Extended>(
          nodes, (segment.T[1] - segment.T[0]) * unit, segment.Value[0], segment.Value[1], light);
      }
      for (std::size_t i = 0; i < 3; ++i)
      {
        light.Color[i] += light.Transmittance * fragment.Color[i];
      }
      light.Transmittance *= 1 - fragment.Opacity;
      from = fragment.T;
    }
    EXPECT_LT(FindError(renderer.GetLight(pixel % 16, pixel / 16), light), 4e-5) << pixel;
    EXPECT_EQ(frame.Depths[static_cast<std::size_t>(y * Width + x)], 0.5F);
  }
}

}
}
