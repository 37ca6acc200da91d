// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/ImageField.h"
#include "Math/Matrix.h"
#include "Matrices.h"
#include "Mesh/MeshCells.h"
#include "Mesh/MeshField.h"
#include "Mesh/ShapeFunctions.h"
#include "Picture/CastRays.h"
#include "Picture/RenderTiles.h"
#include "SameBits.h"
#include "TestMesh.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Infinite = std::numeric_limits<double>::infinity();
constexpr double Glass = 1e-12;
constexpr Index3 Cubes = { 5, 4, 4 };

/// Points and values that every type can hold: eighths, and whole numbers from 0 to 100.
TestMesh MakeRoundMesh(RandomNumbers& random, Cutting cutting, double jitter = 0.2)
{
  TestMesh mesh = MakeMesh(random, Cubes, cutting, jitter,
    [&random](const Index3&) { return random.Integer(0, 100) + 0.0; });
  for (double& coordinate : mesh.Points)
  {
    coordinate = std::nearbyint(coordinate * 8.0) / 8.0;
  }
  return mesh;
}

std::vector<CastRay> MakeRays(RandomNumbers& random, int count)
{
  std::vector<CastRay> rays;
  for (int i = 0; i < count; ++i)
  {
    const Vector3 direction = random.Direction();
    const Vector3 through = random.PointInBox({ 0.0, 0.0, 0.0 }, { 5.0, 4.0, 4.0 });
    rays.push_back({ through - direction * random.Uniform(0.0, 9.0), direction, 0.0, Infinite });
  }
  return rays;
}

RayHits TraceMesh(
  const MeshView& view, const TraceRequest& request, const std::vector<CastRay>& rays, int threads)
{
  MeshField field(view, threads);
  field.Select(request, { threads });
  return CastRays(field, rays, threads);
}

template <typename To, typename From>
std::vector<To> Convert(const std::vector<From>& values)
{
  std::vector<To> converted;
  for (const From value : values)
  {
    converted.push_back(static_cast<To>(value));
  }
  return converted;
}

void ExpectSame(const RayHits& expected, const RayHits& found)
{
  EXPECT_GT(expected.Hits.size(), 50U);
  EXPECT_EQ(expected.First, found.First);
  EXPECT_TRUE(AreSame(expected.Hits, found.Hits));
}

//------------------------------------------------------------------------------
TEST(MeshField, TypesOfArraysAndThreadsChangeNoBit)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(1);
    const TestMesh mesh = MakeRoundMesh(random, cutting);
    const std::vector<CastRay> rays = MakeRays(random, 200);
    const TraceRequest request({ { 30.5, 0.5 }, { 60.0, Glass } });
    const RayHits expected = TraceMesh(mesh.View(), request, rays, 1);
    ExpectSame(expected, TraceMesh(mesh.View(), request, rays, 3));

    const auto points = Convert<float>(mesh.Points);
    const auto offsets = Convert<std::int32_t>(mesh.Offsets);
    const auto connectivity = Convert<std::int32_t>(mesh.Connectivity);
    MeshView view = mesh.View();
    view.Points = points.data();
    view.PointType = ScalarType::Float32;
    view.Offsets = offsets.data();
    view.Connectivity = connectivity.data();
    view.IdType = ScalarType::Int32;
    ExpectSame(expected, TraceMesh(view, request, rays, 1));

    ForEachType(
      [&](auto type)
      {
        using Type = decltype(type);
        std::vector<Type> values(3 * mesh.Values.size(), Type(77));
        for (std::size_t i = 0; i < mesh.Values.size(); ++i)
        {
          values[3 * i + 1] = static_cast<Type>(mesh.Values[i]);
        }
        view.Values = values.data() + 1;
        view.ValueType = ScalarTypeOf<Type>();
        view.ValueStride = 3;
        ExpectSame(expected, TraceMesh(view, request, rays, 1));
      });
  }
}

//------------------------------------------------------------------------------
TEST(MeshField, LatticesAreTheirHexahedra)
{
  RandomNumbers random(2);
  const TestMesh mesh = MakeRoundMesh(random, Cutting::Hexahedra);
  const std::vector<CastRay> rays = MakeRays(random, 300);
  MeshView lattice = mesh.View();
  lattice.Shapes = nullptr;
  lattice.Offsets = nullptr;
  lattice.Connectivity = nullptr;
  lattice.NumberOfCells = 0;
  lattice.Dimensions = { Cubes[0] + 1, Cubes[1] + 1, Cubes[2] + 1 };
  const TraceRequest request({ { 45.0, Glass } });
  EXPECT_EQ(FindProblem(lattice, 0, 1), "");
  ExpectSame(TraceMesh(mesh.View(), request, rays, 1), TraceMesh(lattice, request, rays, 1));
}

//------------------------------------------------------------------------------
TEST(MeshField, SeveralSurfacesAreThoseOfEach)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(3);
    const TestMesh mesh = MakeRoundMesh(random, cutting);
    const std::vector<CastRay> rays = MakeRays(random, 200);
    const std::vector<Isosurface> surfaces = { { 20.0, Glass }, { 50.5, Glass }, { 80.0, Glass } };
    const RayHits all = TraceMesh(mesh.View(), TraceRequest(surfaces), rays, 1);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
    {
      const RayHits alone = TraceMesh(mesh.View(), TraceRequest({ surfaces[i] }), rays, 1);
      std::vector<Hit> some;
      for (Hit hit : all.Hits)
      {
        if (hit.Surface == static_cast<int>(i))
        {
          hit.Surface = 0;
          some.push_back(hit);
        }
      }
      EXPECT_GT(some.size(), 50U);
      EXPECT_EQ(some.size(), alone.Hits.size());
      EXPECT_TRUE(AreSame(some, alone.Hits));
    }
    // A ray ends at the first opaque hit.
    const RayHits first = TraceMesh(mesh.View(), TraceRequest({ { 50.5, 1.0 } }), rays, 1);
    const RayHits each = TraceMesh(mesh.View(), TraceRequest({ surfaces[1] }), rays, 1);
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
    {
      const std::size_t count = first.First[ray + 1] - first.First[ray];
      ASSERT_EQ(count, std::min<std::size_t>(each.First[ray + 1] - each.First[ray], 1));
      ASSERT_TRUE(count == 0 || AreSame(first.Hits[first.First[ray]], each.Hits[each.First[ray]]));
    }
  }
}

//------------------------------------------------------------------------------
/// The time to trace a tetrahedron that is there so many times, from corner to face.
std::clock_t FindTimeOfCopies(int copies, double opacity)
{
  TestMesh mesh;
  mesh.AddPoint({ 0.0, 0.0, 0.0 }, 0.0);
  mesh.AddPoint({ 1.0, 0.0, 0.0 }, 1.0);
  mesh.AddPoint({ 0.0, 1.0, 0.0 }, 1.0);
  mesh.AddPoint({ 0.0, 0.0, 1.0 }, 1.0);
  for (int i = 0; i < copies; ++i)
  {
    mesh.AddCell(CellShape::Tetrahedron, { 0, 1, 2, 3 });
  }
  MeshField field(mesh.View(), 1);
  field.Select(TraceRequest({ { 0.5, opacity } }), { 1 });
  const std::vector<CastRay> rays(
    100, { { -1.0, -1.0, -1.0 }, { 1.0, 1.125, 1.0625 }, 0.0, Infinite });
  std::clock_t least = std::numeric_limits<std::clock_t>::max();
  for (int repetition = 0; repetition < 3; ++repetition)
  {
    const std::clock_t begin = std::clock();
    const RayHits hits = CastRays(field, rays, 1);
    least = std::min(least, std::clock() - begin);
    EXPECT_GE(hits.Hits.size(), rays.size());
  }
  return std::max<std::clock_t>(least, 1);
}

TEST(MeshField, CellsAtOnePlaceTakeTimeByTheirNumber)
{
  for (const double opacity : { 1.0, Glass })
  {
    // 16 times as many: by their square it would be 256 times as long.
    EXPECT_LT(FindTimeOfCopies(8000, opacity) / FindTimeOfCopies(500, opacity), 80) << opacity;
  }
}

//------------------------------------------------------------------------------
TEST(MeshField, OnlyWhatIsVisibleIsHit)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(4);
    const TestMesh mesh = MakeRoundMesh(random, cutting);
    const std::vector<CastRay> rays = MakeRays(random, 200);
    const TraceRequest all({ { 45.0, Glass } });
    MeshField field(mesh.View(), 1);
    field.Select(all, {});
    const RayHits expected = CastRays(field, rays, 1);
    std::vector<unsigned char> hidden(mesh.Shapes.size());
    for (unsigned char& cell : hidden)
    {
      cell = static_cast<unsigned char>(random.Integer(0, 1));
    }
    TraceRequest some = all;
    some.Visible.HalfSpaces = { { { 1.0, 0.3, 0.1 }, -2.7 } };
    some.Visible.Regions.Planes = { { { 1.2, 3.1 }, { 1.3, 2.9 }, { 0.7, 2.2 } } };
    some.Visible.Regions.Visible = 0x2a5f3b1;
    some.Visible.HiddenCells = hidden.data();
    std::vector<Hit> visible;
    for (const Hit& hit : expected.Hits)
    {
      const Vector3 p = field.GetPoint(hit);
      if (Dot(p, Vector3{ 1.0, 0.3, 0.1 }) >= 2.7 && some.Visible.Shows(hit, p))
      {
        visible.push_back(hit);
      }
    }
    EXPECT_GT(visible.size(), 10U);
    EXPECT_LT(visible.size() * 2, expected.Hits.size());
    const RayHits found = TraceMesh(mesh.View(), some, rays, 1);
    EXPECT_TRUE(visible.size() == found.Hits.size() && AreSame(visible, found.Hits));
    // What is hidden hides nothing.
    some.Surfaces[0].Opacity = 1.0;
    const RayHits first = TraceMesh(mesh.View(), some, rays, 1);
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
    {
      const std::size_t count = first.First[ray + 1] - first.First[ray];
      ASSERT_EQ(count, std::min<std::size_t>(found.First[ray + 1] - found.First[ray], 1));
    }
  }
}

//------------------------------------------------------------------------------
TEST(MeshField, PointsAreOnTheRayAndGradientsAreDerivatives)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(5);
    const TestMesh mesh = MakeRoundMesh(random, cutting);
    const std::vector<CastRay> rays = MakeRays(random, 100);
    TraceRequest request({ { 45.0, Glass }, { 45.0 + 1e-4, Glass } });
    request.Normals = NormalMode::InterpolantGradient;
    MeshField field(mesh.View(), 1);
    field.Select(request, {});
    const RayHits hits = CastRays(field, rays, 1);
    int pairs = 0;
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
    {
      for (std::size_t i = hits.First[ray]; i < hits.First[ray + 1]; ++i)
      {
        const Hit& hit = hits.Hits[i];
        const Vector3 beside =
          field.GetPoint(hit) - (rays[ray].Origin + rays[ray].Direction * hit.T);
        ASSERT_LT(Length(beside), 1e-12);
        if (i + 1 == hits.First[ray + 1] || hits.Hits[i + 1].Surface == hit.Surface ||
          hits.Hits[i + 1].Cell != hit.Cell)
        {
          continue;
        }
        // From one surface to the next the value changes by their difference.
        const Hit& next = hits.Hits[i + 1];
        const double change = hit.Surface == 0 ? 1e-4 : -1e-4;
        const Vector3 gradient =
          (field.GetGradient(hit, request.Normals) + field.GetGradient(next, request.Normals)) *
          0.5;
        const double slope = Dot(gradient, rays[ray].Direction);
        if (std::abs(slope) > 5.0 && std::abs(slope) < 200.0)
        {
          ASSERT_NEAR(slope * (next.T - hit.T), change, 1e-8);
          ++pairs;
        }
      }
    }
    EXPECT_GT(pairs, 50);
  }
}

//------------------------------------------------------------------------------
TEST(MeshField, NothingIsHitWhereNothingIs)
{
  RandomNumbers random(6);
  const std::vector<CastRay> rays = MakeRays(random, 20);
  const TraceRequest request({ { 0.5, 1.0 } });
  TestMesh mesh;
  EXPECT_EQ(FindProblem(mesh.View(), 0, 1), "");
  EXPECT_TRUE(TraceMesh(mesh.View(), request, rays, 1).Hits.empty());
  // Cells of a surface.
  for (int i = 0; i < 12; ++i)
  {
    mesh.AddPoint(random.PointInVolume({ 6, 5, 5 }), i % 2);
  }
  mesh.AddCell(static_cast<CellShape>(5), { 0, 1, 2 });
  mesh.AddCell(static_cast<CellShape>(9), { 3, 4, 5, 6 });
  mesh.AddCell(static_cast<CellShape>(24), { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 });
  EXPECT_EQ(FindProblem(mesh.View(), 17, 1), "");
  EXPECT_TRUE(TraceMesh(mesh.View(), request, rays, 1).Hits.empty());
}

//------------------------------------------------------------------------------
/// Has a list of cells checked in both types of ids.
void ExpectProblem(const TestMesh& mesh, std::int64_t length, const std::string& start)
{
  EXPECT_EQ(FindProblem(mesh.View(), length, 2).substr(0, start.size()), start);
  const auto offsets = Convert<std::int32_t>(mesh.Offsets);
  const auto connectivity = Convert<std::int32_t>(mesh.Connectivity);
  MeshView view = mesh.View();
  view.Offsets = offsets.data();
  view.Connectivity = connectivity.data();
  view.IdType = ScalarType::Int32;
  EXPECT_EQ(FindProblem(view, length, 1).substr(0, start.size()), start);
}

std::string NameOfCutting(const testing::TestParamInfo<Cutting>& cutting)
{
  constexpr const char* names[] = { "Tetrahedra", "Hexahedra", "Wedges", "Pyramids", "Mixed" };
  return names[cutting.index]; // in the order of AllCuttings
}

/// Cells of one shape are checked together first.
class BadCells : public testing::TestWithParam<Cutting>
{
};
INSTANTIATE_TEST_SUITE_P(All, BadCells, testing::ValuesIn(AllCuttings), NameOfCutting);

TEST_P(BadCells, FirstIsNamed)
{
  RandomNumbers random(7);
  const TestMesh good = MakeRoundMesh(random, this->GetParam());
  const auto length = static_cast<std::int64_t>(good.Connectivity.size());
  EXPECT_EQ(FindProblem(good.View(), length, 2), "");
  // A cell further on is always bad.
  const auto damage = [&](const auto& change)
  {
    TestMesh mesh = good;
    mesh.Connectivity[static_cast<std::size_t>(mesh.Offsets[30])] = -1;
    change(mesh);
    ExpectProblem(mesh, length, "Cell 7 ");
  };
  const auto first = static_cast<std::size_t>(good.Offsets[7]);
  const auto points = static_cast<std::int64_t>(good.Values.size());
  damage([&](TestMesh& mesh) { mesh.Connectivity[first + 2] = -1; });
  damage([&](TestMesh& mesh) { mesh.Connectivity[first + 2] = points; });
  damage([&](TestMesh& mesh) { mesh.Connectivity[first] = std::numeric_limits<int>::min(); });
  damage([&](TestMesh& mesh) { mesh.Connectivity[first] = std::numeric_limits<int>::max(); });
  for (const int end :
    { -1, 0, 1, std::numeric_limits<int>::min(), std::numeric_limits<int>::max() })
  {
    damage([&](TestMesh& mesh) { mesh.Offsets[8] = end; });
  }
  damage([&](TestMesh& mesh) { --mesh.Offsets[8]; });
  damage([&](TestMesh& mesh) { ++mesh.Offsets[8]; });
  TestMesh mesh = good;
  for (const std::int64_t end :
    { std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max() })
  {
    mesh.Offsets[8] = end;
    EXPECT_EQ(FindProblem(mesh.View(), length, 1).substr(0, 7), "Cell 7 ");
  }
  mesh = good;
  // The connectivity is shorter than the offsets say.
  const std::string last = "Cell " + std::to_string(good.Shapes.size() - 1) + " ";
  ExpectProblem(good, length - 1, last);
  // The last cell alone is bad.
  for (const std::int64_t id : { std::int64_t{ -1 }, points, std::int64_t{ INT32_MIN } })
  {
    mesh.Connectivity.back() = id;
    ExpectProblem(mesh, length, last);
  }
  mesh = good;
  ++mesh.Offsets.back();
  ExpectProblem(mesh, length + 1, last);
  // Cells of other shapes may have any offsets.
  mesh = good;
  mesh.Shapes[7] = 5;
  mesh.Shapes[8] = 25;
  mesh.Offsets[8] = std::numeric_limits<int>::max();
  EXPECT_EQ(FindProblem(mesh.View(), length, 1), "");
  // But not if somebody reads them.
  EXPECT_EQ(FindProblem(mesh.View(), length, 1, CheckedCells::All).substr(0, 7), "Cell 7 ");
  mesh = good;
  mesh.Shapes[7] = 5;
  EXPECT_EQ(FindProblem(mesh.View(), length, 1, CheckedCells::All), "");
  mesh.Connectivity[static_cast<std::size_t>(mesh.Offsets[7])] = -1;
  EXPECT_EQ(FindProblem(mesh.View(), length, 1, CheckedCells::All).substr(0, 7), "Cell 7 ");
}

//------------------------------------------------------------------------------
/// Changes some entries of an array to any of its type.
template <typename Type>
void Damage(RandomNumbers& random, std::vector<Type>& values, int count)
{
  for (int i = 0; i < count && !values.empty(); ++i)
  {
    const auto at = static_cast<std::size_t>(random.Bits() % values.size());
    if constexpr (std::is_same_v<Type, double>)
    {
      values[at] =
        random.Integer(0, 1) == 0 ? random.AnyDouble() : values[random.Bits() % values.size()];
    }
    else
    {
      values[at] = random.Integer(0, 2) == 0 ? static_cast<Type>(random.Bits())
                                             : static_cast<Type>(random.Integer(-2, 40));
    }
  }
}

TEST(MeshField, DamagedMeshesAreRefusedOrTraced)
{
  int traced = 0;
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed)
  {
    RandomNumbers random(seed);
    const Cutting cutting = AllCuttings[seed % 5];
    TestMesh mesh = MakeMesh(random, { 2, 2, 1 }, cutting, 0.3,
      [&random](const Index3&) { return random.Integer(-2, 2) + 0.0; });
    Damage(random, mesh.Shapes, random.Integer(0, 2));
    Damage(random, mesh.Offsets, random.Integer(-3, 2));
    Damage(random, mesh.Connectivity, random.Integer(-3, 2));
    Damage(random, mesh.Values, random.Integer(0, 3));
    Damage(random, mesh.Points, random.Integer(0, 3));
    const auto length = static_cast<std::int64_t>(mesh.Connectivity.size());
    if (!FindProblem(mesh.View(), length, 1).empty())
    {
      ++refused;
      continue;
    }
    ++traced;
    std::vector<CastRay> rays = MakeRays(random, 10);
    rays.push_back({ { random.AnyDouble(), random.AnyDouble(), random.AnyDouble() },
      { random.AnyDouble(), random.AnyDouble(), random.AnyDouble() }, 0.0, Infinite });
    MeshField field(mesh.View(), 1);
    field.Select(TraceRequest({ { 0.0, Glass }, { 0.5, 0.5 } }), {});
    const RayHits hits = CastRays(field, rays, 1);
    for (const Hit& hit : hits.Hits)
    {
      ASSERT_TRUE(hit.Cell >= 0 && hit.Cell < static_cast<std::int64_t>(mesh.Shapes.size()));
      const Vector3 gradient = field.GetGradient(hit, NormalMode::CentralDifferences);
      ASSERT_FALSE(std::isnan(gradient[0] + gradient[1] + gradient[2])) << seed;
    }
  }
  EXPECT_GT(traced, 500);
  EXPECT_GT(refused, 500);
}

//------------------------------------------------------------------------------
/// The mean angle of the normals of a mesh to those of a sphere about a point.
double GetMeanAngle(MeshField& field, NormalMode mode, const Vector3& center)
{
  RandomNumbers random(8);
  const RayHits hits = CastRays(field, MakeRays(random, 300), 1);
  double sum = 0.0;
  for (const Hit& hit : hits.Hits)
  {
    const Vector3 normal = Normalized(center - field.GetPoint(hit));
    sum += Length(Cross(normal, Normalized(field.GetGradient(hit, mode))));
  }
  EXPECT_GT(hits.Hits.size(), 100U);
  return sum / static_cast<double>(hits.Hits.size());
}

TEST(MeshField, CentralDifferencesAreSmooth)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(9);
    TestMesh mesh = MakeRoundMesh(random, cutting, 0.15);
    const Vector3 center = { 2.4, 2.1, 1.9 };
    const Vector3 slope = { 0.5, -2.0, 1.0 };
    const auto count = static_cast<std::int64_t>(mesh.Values.size());
    const auto fill = [&](const auto& function)
    {
      for (std::int64_t id = 0; id < count; ++id)
      {
        mesh.Values[static_cast<std::size_t>(id)] = function(mesh.GetPoint(id));
      }
    };
    fill([&](const Vector3& p) { return 1.7 - Length(p - center); });
    MeshField field(mesh.View(), 1);
    TraceRequest request({ { 0.0, 1.0 } });
    request.Normals = NormalMode::InterpolantGradient;
    field.Select(request, {});
    const std::size_t memory = field.GetStatistics().HierarchyMemory;
    const double ofCells = GetMeanAngle(field, NormalMode::InterpolantGradient, center);
    request.Normals = NormalMode::CentralDifferences;
    field.Select(request, {});
    EXPECT_EQ(field.GetStatistics().HierarchyMemory, memory + mesh.Values.size() * 13);
    const double smooth = GetMeanAngle(field, NormalMode::CentralDifferences, center);
    EXPECT_LT(smooth, 0.6 * ofCells) << static_cast<int>(cutting) << " " << ofCells;
    EXPECT_EQ(GetMeanAngle(field, NormalMode::InterpolantGradient, center), ofCells);

    // The same bits with any number of threads.
    MeshField other(mesh.View(), 3);
    other.Select(request, { 3 });
    EXPECT_EQ(GetMeanAngle(other, NormalMode::CentralDifferences, center), smooth);

    // And after another isovalue, which some of the cells have too.
    MeshField later(mesh.View(), 2);
    TraceRequest before = request;
    before.Surfaces = { { 0.3, 1.0 } };
    later.Select(before, { 2 });
    later.Select(request, { 2 });
    EXPECT_EQ(GetMeanAngle(later, NormalMode::CentralDifferences, center), smooth);

    // A linear field has one gradient.
    fill([&](const Vector3& p) { return Dot(p, slope); });
    MeshField linear(mesh.View(), 1);
    linear.Select(request, {});
    const RayHits hits = CastRays(linear, MakeRays(random, 100), 1);
    EXPECT_GT(hits.Hits.size(), 30U);
    for (const Hit& hit : hits.Hits)
    {
      ASSERT_LT(Length(linear.GetGradient(hit, NormalMode::CentralDifferences) - slope), 1e-6);
      ASSERT_LT(Length(linear.GetGradient(hit, NormalMode::InterpolantGradient) - slope), 1e-9);
    }
  }
}

//------------------------------------------------------------------------------
/// Hexahedra may have corners at one point, as wedges in files of other programs: there they have
/// no gradient, and the mean is that of other cells.
TEST(MeshField, SmoothGradientsOfCollapsedHexahedra)
{
  RandomNumbers random(33);
  const Vector3 slope = { 0.5, -2.0, 1.0 };
  const TestMesh whole = MakeRoundMesh(random, Cutting::Hexahedra);
  TestMesh mesh;
  mesh.Points = whole.Points;
  const MeshCells cells(whole.View());
  for (std::int64_t number = 0; number < cells.GetNumberOfCells(); ++number)
  {
    MeshCell cell;
    cells.Load(number, cell);
    const std::int64_t* p = cell.Ids;
    mesh.AddCell(CellShape::Hexahedron, { p[0], p[1], p[2], p[2], p[4], p[5], p[6], p[6] });
    mesh.AddCell(CellShape::Hexahedron, { p[0], p[0], p[2], p[3], p[4], p[4], p[6], p[7] });
  }
  for (std::size_t id = 0; id < whole.Values.size(); ++id)
  {
    mesh.Values.push_back(Dot(mesh.GetPoint(static_cast<std::int64_t>(id)), slope));
  }
  MeshField field(mesh.View(), 1);
  field.Select(TraceRequest({ { 0.0, 1.0 } }), {});
  const RayHits hits = CastRays(field, MakeRays(random, 100), 1);
  EXPECT_GT(hits.Hits.size(), 30U);
  for (const Hit& hit : hits.Hits)
  {
    ASSERT_LT(Length(field.GetGradient(hit, NormalMode::CentralDifferences) - slope), 1e-6);
  }
}

//------------------------------------------------------------------------------
/// Cells without a gradient, and those with a gradient of zero, are not the same.
TEST(MeshField, SmoothGradientsCountPyramidsOfOneValue)
{
  RandomNumbers random(34);
  TestMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3 point = { (corner & 1) * 1.0, (corner >> 1 & 1) * 1.0, (corner >> 2) * 1.0 };
    mesh.AddPoint(point, point[2] - 0.5);
  }
  const std::int64_t apex = mesh.AddPoint({ 0.5, 0.5, 0.5 }, -0.5);
  // The value is that of the apex at all corners of one of them, and half the volume has a slope.
  mesh.AddCell(CellShape::Pyramid, { 0, 1, 3, 2, apex });
  mesh.AddCell(CellShape::Pyramid, { 4, 6, 7, 5, apex });
  MeshField field(mesh.View(), 1);
  field.Select(TraceRequest({ { 0.0, 1.0 } }), {});
  const RayHits hits = CastRays(field, { { { 0.5, 0.5, 2.0 }, { 0.0, 0.0, -1.0 }, 0.0, 10.0 } }, 1);
  ASSERT_EQ(hits.Hits.size(), 1U);
  // Halfway between a corner of the base, with a slope of 2, and the apex, with half of that.
  const Vector3 gradient = field.GetGradient(hits.Hits[0], NormalMode::CentralDifferences);
  EXPECT_LT(Length(gradient - Vector3{ 0.0, 0.0, 1.5 }), 1e-5) << gradient[2];
}

//------------------------------------------------------------------------------
/// The mean of the gradients at a point in the cells around it, weighted by their volumes.
Vector3 FindMeanGradient(const MeshCells& cells, std::int64_t point)
{
  Vector3 sum = {};
  double volumes = 0.0;
  for (std::int64_t number = 0; number < cells.GetNumberOfCells(); ++number)
  {
    MeshCell cell;
    cells.Load(number, cell);
    const auto* corner = std::find(cell.Ids, cell.Ids + cell.Count, point);
    if (corner != cell.Ids + cell.Count)
    {
      CornerWeights weights = {};
      weights[corner - cell.Ids] = 1.0;
      const double volume = GetVolume(cell);
      sum = sum + GetGradient(cell, GetParametric(cell.Shape, weights)) * volume;
      volumes += volume;
    }
  }
  return sum * (1.0 / volumes);
}

TEST(MeshField, SmoothGradientsAreMeansOfCellsAround)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(31);
    TestMesh mesh = MakeRoundMesh(random, cutting);
    if (cutting == Cutting::Mixed)
    {
      // It has no tetrahedra: cells may overlap.
      constexpr std::int64_t row = Cubes[0] + 1;
      constexpr std::int64_t slice = row * (Cubes[1] + 1);
      for (std::int64_t point = 0; point < 3 * slice; point += row + 1)
      {
        mesh.AddCell(CellShape::Tetrahedron, { point, point + 1, point + row, point + slice });
      }
    }
    const MeshCells cells(mesh.View());
    MeshField field(mesh.View(), 2);
    // The first request finds gradients next to its surfaces; the second finds all.
    for (const double isovalue : { 60.5, 30.5 })
    {
      field.Select(TraceRequest({ { isovalue, Glass } }), { 2 });
      const RayHits hits = CastRays(field, MakeRays(random, 40), 1);
      ASSERT_GT(hits.Hits.size(), 20U);
      for (const Hit& hit : hits.Hits)
      {
        MeshCell cell;
        cells.Load(hit.Cell, cell);
        CornerWeights weights;
        GetWeights(cell.Shape, hit.Parametric, weights);
        Vector3 expected = {};
        for (int i = 0; i < cell.Count; ++i)
        {
          expected = expected + FindMeanGradient(cells, cell.Ids[i]) * weights[i];
        }
        const Vector3 gradient = field.GetGradient(hit, NormalMode::CentralDifferences);
        ASSERT_LT(Length(gradient - expected), 1e-4 * (1.0 + Length(expected)))
          << static_cast<int>(cutting);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(MeshField, PointsAndGradientsOfManyHitsAreThoseOfEach)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(35);
    const TestMesh mesh = MakeRoundMesh(random, cutting);
    MeshField field(mesh.View(), 2);
    for (const NormalMode mode :
      { NormalMode::CentralDifferences, NormalMode::InterpolantGradient })
    {
      TraceRequest request({ { 50.5, Glass } });
      request.Normals = mode;
      // Its caps have gradients of their own.
      request.Visible.HalfSpaces.push_back({ { 0.6, 0.0, 0.8 }, -2.5, true });
      field.Select(request, { 2 });
      const RayHits hits = CastRays(field, MakeRays(random, 200), 1);
      const int count = static_cast<int>(hits.Hits.size());
      ASSERT_GT(count, RayPacket::Capacity);
      for (int first = 0; first < count; first += RayPacket::Capacity)
      {
        const Hit* own = &hits.Hits[static_cast<std::size_t>(first)];
        const int ownCount = std::min(count - first, RayPacket::Capacity);
        double points[3][RayPacket::Capacity];
        double gradients[3][RayPacket::Capacity];
        field.GetPointsAndGradients(own, ownCount, mode, points, gradients);
        for (int i = 0; i < ownCount; ++i)
        {
          ASSERT_EQ((Vector3{ points[0][i], points[1][i], points[2][i] }), field.GetPoint(own[i]));
          ASSERT_EQ((Vector3{ gradients[0][i], gradients[1][i], gradients[2][i] }),
            field.GetGradient(own[i], mode));
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(MeshField, GradientsOfTheFirstSurfaceAreThoseOfAll)
{
  RandomNumbers random(32);
  const TestMesh mesh = MakeMesh(random, { 14, 14, 14 }, Cutting::Tetrahedra, 0.2,
    [](const Index3& p) {
      return Length(Vector3{ p[0] - 7.1, p[1] - 6.8, p[2] - 7.3 });
    });
  const TraceRequest request({ { 5.0, Glass } });
  MeshField first(mesh.View(), 2);
  first.Select(request, { 2 });
  MeshField second(mesh.View(), 2);
  second.Select(TraceRequest({ { 2.0, Glass } }), { 2 });
  second.Select(request, { 2 });
  const RayHits hits = CastRays(first, MakeRays(random, 500), 1);
  ASSERT_GT(hits.Hits.size(), 100U);
  for (const Hit& hit : hits.Hits)
  {
    ASSERT_EQ(first.GetGradient(hit, NormalMode::CentralDifferences),
      second.GetGradient(hit, NormalMode::CentralDifferences));
  }
}

//------------------------------------------------------------------------------
/// A floor that is an image, and a ball above it that is a mesh, under a light from straight above.
TEST(MeshField, AMeshAndAnImageAreOneScene)
{
  constexpr int width = 61;
  constexpr int height = 47;
  const auto volume = TestVolume<float>::Of(
    { 25, 25, 25 }, [](const AnalyticFields::Point& p) { return 8.0 - p[1]; });
  const auto floor = ImageField::New(volume.View(), {}, 1);
  RandomNumbers random(10);
  const TestMesh mesh = MakeMesh(random, { 12, 12, 12 }, Cutting::Tetrahedra, 0.0,
    [](const Index3& p) { return 4.0 - std::hypot(p[0] - 6.0, p[1] - 6.0, p[2] - 6.0); });
  MeshField ball(mesh.View(), 1);
  const Matrix4 places[2] = { Translation({ -12.0, -20.0, -12.0 }),
    Translation({ -6.0, -6.0, -6.0 }) };
  TracedField* fields[2] = { floor.get(), &ball };
  const auto render = [&](double ambient, bool hasShadows, int occlusionRays, int threads)
  {
    Scene scene;
    for (int i = 0; i < 2; ++i)
    {
      fields[i]->Select(TraceRequest({ { 0.0, 1.0 } }), { threads });
      SceneField shown;
      shown.Field = fields[i];
      const Matrix4 clipFromObject = Multiply(Perspective(10.0, 100.0, 0.6),
        Multiply(Invert(Translation({ 1.0, 2.0, 40.0 })), places[i]));
      shown.View = Camera(clipFromObject, Invert(clipFromObject), places[i], width, height);
      shown.Colors = { i == 0 ? Vector3{ 1.0, 0.1, 0.0 } : Vector3{ 0.0, 0.9, 0.2 } };
      shown.Surface = { true, ambient, 1.0 - ambient, 0.0, 1.0 };
      scene.Fields.push_back(shown);
    }
    scene.Lights = { Light() };
    scene.Lights[0].Direction = { 0.0, 1.0, 0.0 };
    scene.Shadows = hasShadows;
    scene.OcclusionRays = occlusionRays;
    scene.Pixels = { 0, 0, width, height };
    scene.KeepHits = true;
    Frame frame;
    FrameTimes times;
    EXPECT_TRUE(RenderTiles(scene, { threads }, frame, times, [](double) { return true; }));
    return frame;
  };
  const Frame frame = render(0.0, true, 0, 1);
  int dark = 0;
  int bright = 0;
  int ofBall = 0;
  for (std::size_t pixel = 0; pixel < frame.Hits.size(); ++pixel)
  {
    const Hit& hit = frame.Hits[pixel];
    if (hit.Surface == Hit::NoSurface || hit.Field != 0)
    {
      ofBall += hit.Surface == Hit::NoSurface ? 0 : 1;
      continue;
    }
    const Vector3 point = TransformPoint(places[0], floor->GetPoint(hit));
    const double fromAxis = std::hypot(point[0], point[2]);
    if (std::abs(fromAxis - 4.0) > 0.3)
    {
      ASSERT_EQ(frame.Colors[4 * pixel], fromAxis < 4.0 ? 0 : 255) << fromAxis;
      ++(fromAxis < 4.0 ? dark : bright);
    }
  }
  EXPECT_GT(dark, 10);
  EXPECT_GT(bright, 50);
  EXPECT_GT(ofBall, 40);
  // Occlusion darkens, and threads change nothing.
  const Frame open = render(0.5, false, 0, 1);
  const Frame occluded = render(0.5, false, 8, 1);
  const auto sum = [](const Frame& of)
  {
    std::int64_t total = 0;
    for (const unsigned char channel : of.Colors)
    {
      total += channel;
    }
    return total;
  };
  EXPECT_LT(sum(occluded), sum(open));
  EXPECT_EQ(render(0.5, true, 8, 1).Colors, render(0.5, true, 8, 3).Colors);
}

}
}
