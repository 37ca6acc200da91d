// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Caps in meshes are where the field says, and those of the image that has the same field; they
// close what half-spaces cut open: entries and exits of rays alternate, however they are cut.

#include "AnalyticFields.h"
#include "CapTesting.h"
#include "Image/ImageField.h"
#include "Mesh/MeshField.h"
#include "Mesh/ShapeFunctions.h"
#include "Noise.h"
#include "TestMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr Index3 Cubes = { 8, 7, 9 };
constexpr Index3 Size = { 9, 8, 10 };
constexpr Vector3 Middle = { 4.0, 3.5, 4.5 };

const Hit* FindCap(const std::vector<Hit>& hits)
{
  const auto cap = std::find_if(
    hits.begin(), hits.end(), [](const Hit& hit) { return hit.Plane != Hit::NoPlane; });
  return cap != hits.end() ? &*cap : nullptr;
}

std::size_t CountCaps(const std::vector<Hit>& hits)
{
  return static_cast<std::size_t>(std::count_if(
    hits.begin(), hits.end(), [](const Hit& hit) { return hit.Plane != Hit::NoPlane; }));
}

TestMesh MakeFullMesh(const Index3& cubes, Cutting cutting)
{
  RandomNumbers random(1);
  return MakeMesh(random, cubes, cutting, 0.0, [](const Index3&) { return 1.0; });
}

/// The mesh of the hexahedra between the samples of an image.
TestMesh MakeMeshOf(const TestVolume<double>& volume)
{
  RandomNumbers random(1);
  const Index3& size = volume.Dimensions;
  return MakeMesh(random, { size[0] - 1, size[1] - 1, size[2] - 1 }, Cutting::Hexahedra, 0.0,
    [&volume](const Index3& i) { return volume.At(i); });
}

//------------------------------------------------------------------------------
TEST(MeshCaps, NoRayFromOutsideLeaks)
{
  int caps = 0;
  for (const Cutting cutting : AllCuttings)
  {
    for (const double jitter : { 0.0, 0.25 })
    {
      RandomNumbers random(5);
      // Zero at the border: what is above is closed.
      const TestMesh mesh = MakeMesh(random, Cubes, cutting, jitter,
        [&random](const Index3& i)
        {
          const bool isInner = i[0] > 0 && i[1] > 0 && i[2] > 0 && i[0] < Cubes[0] &&
            i[1] < Cubes[1] && i[2] < Cubes[2];
          return isInner ? random.Integer(0, 4) + 0.0 : 0.0;
        });
      MeshField traced(mesh.View(), 2);
      MeshField opaque(mesh.View(), 2);
      for (const double isovalue : { 2.0, 1.5, 0.25 })
      {
        const auto select = [&](const std::vector<HalfSpace>& halves, double opacity) -> MeshField&
        {
          TraceRequest request({ { isovalue, opacity } });
          request.Visible.HalfSpaces = halves;
          MeshField& field = opacity < 1.0 ? traced : opaque;
          field.Select(request, { 1, nullptr });
          return field;
        };
        const int before = caps;
        EXPECT_EQ(CountLeakingRays(Size, 6, caps, select), 0)
          << static_cast<int>(cutting) << ", " << jitter << ", " << isovalue;
        EXPECT_GT(caps, before + 300);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(MeshCaps, LieWhereTheFieldReachesTheLargestIsovalue)
{
  // Every cell reproduces a linear field, wherever its points are.
  const AnalyticFields::Plane field = { { 0.3, -0.7, 0.5 }, -1.0 };
  const std::vector<Isosurface> surfaces = { { -1.0, Glass }, { 0.5, Glass }, { 2.0, Glass } };
  int found[4] = {};
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(9);
    TestMesh mesh = MakeMesh(random, Cubes, cutting, 0.2, [](const Index3&) { return 0.0; });
    for (std::size_t i = 0; i < mesh.Values.size(); ++i)
    {
      mesh.Values[i] = field(mesh.GetPoint(static_cast<std::int64_t>(i)));
    }
    MeshField traced(mesh.View(), 2);
    for (int scene = 0; scene < 20; ++scene)
    {
      TraceRequest request(surfaces);
      request.Visible.HalfSpaces.push_back(Behind(random.Direction(), Middle));
      const HalfSpace& half = request.Visible.HalfSpaces[0];
      traced.Select(request, { 1, nullptr });
      for (int ray = 0; ray < 100; ++ray)
      {
        const Line line = RandomLine(random, Size);
        const double slope = Dot(half.Normal, line.Direction);
        const double t = -(Dot(half.Normal, line.Origin) + half.Offset) / slope;
        const Vector3 point = line.Origin + line.Direction * t;
        const double value = field(point);
        double outside = -Infinity; // how far, of the cubes
        int surface = -1;
        bool isClear = true;
        for (std::size_t i = 0; i < 3; ++i)
        {
          outside = std::max({ outside, -point[i], point[i] - Cubes[i] });
          surface += value >= surfaces[i].Isovalue ? 1 : 0;
          isClear = isClear && std::abs(value - surfaces[i].Isovalue) > 1e-9;
        }
        if (!isClear || std::abs(outside) < 0.25 || std::abs(slope) < 1e-2)
        {
          continue;
        }
        const std::vector<Hit> hits = Trace(traced, line);
        const Hit* cap = FindCap(hits);
        ASSERT_EQ(cap != nullptr, outside < 0.0 && t > 0.0 && surface >= 0) << ToText(line);
        found[surface + 1] += outside < 0.0 && t > 0.0 ? 1 : 0;
        if (!cap)
        {
          continue;
        }
        EXPECT_EQ(CountCaps(hits), 1U);
        EXPECT_TRUE(slope > 0.0 ? cap == &hits.front() : cap == &hits.back());
        EXPECT_EQ(cap->Entering, slope > 0.0);
        EXPECT_EQ(cap->Plane, 0);
        EXPECT_EQ(cap->Surface, surface);
        EXPECT_NEAR(cap->T, t, 1e-9);
        EXPECT_NEAR(Length(traced.GetPoint(*cap) - point), 0.0, 1e-9);
        EXPECT_NEAR(cap->Value, value, 1e-9);
        EXPECT_EQ(traced.GetGradient(*cap, NormalMode::CentralDifferences), half.Normal);
        double points[3][RayPacket::Capacity];
        double gradients[3][RayPacket::Capacity];
        traced.GetPointsAndGradients(cap, 1, traced.GetRequest().Normals, points, gradients);
        EXPECT_EQ((Vector3{ gradients[0][0], gradients[1][0], gradients[2][0] }), half.Normal);
      }
    }
  }
  for (const int count : found)
  {
    EXPECT_GT(count, 100);
  }
}

//------------------------------------------------------------------------------
/// Hits, and caps, of several translucent surfaces and several planes.
TEST(MeshCaps, AreThoseOfTheImageWithTheSameField)
{
  RandomNumbers random(4);
  TestVolume<double> volume(Size, std::vector<double>(Count(Size)));
  for (double& value : volume.Values)
  {
    value = random.Uniform(0.0, 4.0);
  }
  const TestMesh mesh = MakeMeshOf(volume);
  const auto image = ImageField::New(volume.View(), {}, 2);
  MeshField traced(mesh.View(), 2);
  std::size_t caps[3] = {};
  for (int scene = 0; scene < 60; ++scene)
  {
    TestRequest request({ { 0.9, 0.3 }, { 2.1, 0.5 }, { 2.6, 0.4 } });
    request.Visible.HalfSpaces = RandomHalfSpaces(random, Size);
    request.Visible.HalfSpaces.back().IsCapped = scene % 2 == 0;
    Select(*image, request, 2);
    traced.Select(request, { 1, nullptr });
    for (int ray = 0; ray < 200; ++ray)
    {
      const Line line = RandomLine(random, Size);
      const std::vector<Hit> expected = Trace(*image, line);
      const std::vector<Hit> found = Trace(traced, line);
      ASSERT_EQ(found.size(), expected.size()) << ToText(line);
      for (std::size_t i = 0; i < found.size(); ++i)
      {
        ASSERT_EQ(found[i].Plane, expected[i].Plane) << ToText(line);
        EXPECT_EQ(found[i].Surface, expected[i].Surface);
        EXPECT_EQ(found[i].Entering, expected[i].Entering);
        EXPECT_EQ(found[i].Cell, expected[i].Cell);
        EXPECT_NEAR(found[i].T, expected[i].T, 1e-8);
        if (found[i].Plane != Hit::NoPlane)
        {
          EXPECT_NEAR(found[i].Value, expected[i].Value, 1e-8);
          EXPECT_NEAR(Length(found[i].Parametric - expected[i].Parametric), 0.0, 1e-8);
          ++caps[static_cast<std::size_t>(found[i].Surface)];
        }
      }
    }
  }
  EXPECT_GT(*std::min_element(caps, caps + 3), 500U);
}

/// The corners of a cell, and a search of the point with given coordinates that shares no code with
/// the tracer.
class Inverse
{
public:
  using Number = long double;
  using Triple = std::array<Number, 3>;

  Inverse(const TestMesh& mesh, std::size_t cell)
  {
    const ShapeTraits& traits = GetTraits(static_cast<CellShape>(mesh.Shapes[cell]));
    for (std::size_t i = 0; i < 8; ++i)
    {
      const std::int64_t id =
        mesh.Connectivity[static_cast<std::size_t>(mesh.Offsets[cell] + traits.Trilinear[i])];
      const Vector3 point = mesh.GetPoint(id);
      this->Points[i] = { point[0], point[1], point[2] };
      this->Values[i] = mesh.Values[static_cast<std::size_t>(id)];
    }
  }

  /// How far a point is outside of the trilinear cell, in its own coordinates, and the value there;
  /// by Newton's method from many starts.
  struct Place
  {
    Number Excess = std::numeric_limits<Number>::infinity();
    Number Value = 0;
  };
  Place Find(const Triple& point) const
  {
    Place nearest;
    if (this->IsFar(point))
    {
      return nearest;
    }
    for (int start = 0; start < 27; ++start)
    {
      Triple p = { 0.2L + 0.3L * (start % 3), 0.2L + 0.3L * (start / 3 % 3),
        0.2L + 0.3L * (start / 9) };
      for (int step = 0; step < 30; ++step)
      {
        this->Step(point, p);
      }
      if (this->GetDistance(point, p) < 1e-14L)
      {
        const Number excess = std::max({ -p[0], -p[1], -p[2], p[0] - 1, p[1] - 1, p[2] - 1 });
        if (excess < nearest.Excess)
        {
          nearest = { excess,
            this->Interpolate([this](std::size_t i) { return this->Values[i]; }, p) };
        }
      }
    }
    return nearest;
  }

private:
  /// The cell is in the box of its corners.
  bool IsFar(const Triple& point) const
  {
    bool isFar = false;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto [low, high] = std::minmax_element(this->Points, this->Points + 8,
        [axis](const Triple& a, const Triple& b) { return a[axis] < b[axis]; });
      isFar = isFar || point[axis] < (*low)[axis] - 0.01L || point[axis] > (*high)[axis] + 0.01L;
    }
    return isFar;
  }

  static Number Weight(std::size_t corner, std::size_t axis, Number x)
  {
    return (corner >> axis & 1U) != 0 ? x : 1 - x;
  }

  template <typename Function>
  static Number Interpolate(const Function& f, const Triple& p)
  {
    Number sum = 0;
    for (std::size_t i = 0; i < 8; ++i)
    {
      sum += Weight(i, 0, p[0]) * Weight(i, 1, p[1]) * Weight(i, 2, p[2]) * f(i);
    }
    return sum;
  }

  Triple GetWay(const Triple& point, const Triple& p) const
  {
    Triple way;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      way[axis] =
        Interpolate([this, axis](std::size_t i) { return this->Points[i][axis]; }, p) - point[axis];
    }
    return way;
  }

  Number GetDistance(const Triple& point, const Triple& p) const
  {
    const Triple way = this->GetWay(point, p);
    return std::max({ std::abs(way[0]), std::abs(way[1]), std::abs(way[2]) });
  }

  void Step(const Triple& point, Triple& p) const
  {
    const Triple way = this->GetWay(point, p);
    Triple columns[3];
    for (std::size_t k = 0; k < 3; ++k)
    {
      Triple low = p;
      Triple high = p;
      low[k] = 0;
      high[k] = 1;
      const Triple a = this->GetWay(point, low);
      const Triple b = this->GetWay(point, high);
      columns[k] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
    }
    const auto determinant = [](const Triple& a, const Triple& b, const Triple& c)
    {
      return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
        a[2] * (b[0] * c[1] - b[1] * c[0]);
    };
    const Number whole = determinant(columns[0], columns[1], columns[2]);
    const Triple change = { determinant(way, columns[1], columns[2]) / whole,
      determinant(columns[0], way, columns[2]) / whole,
      determinant(columns[0], columns[1], way) / whole };
    for (std::size_t k = 0; k < 3; ++k)
    {
      p[k] = std::clamp(p[k] - change[k], Number(-1), Number(2));
    }
  }

  Triple Points[8];
  Number Values[8];
};

//------------------------------------------------------------------------------
/// Every cell is searched for the point.
TEST(MeshCaps, AreInTheCellThatHasThePoint)
{
  const std::vector<Isosurface> surfaces = { { 1.0, Glass }, { 2.0, Glass } };
  int found = 0;
  int none = 0;
  int unclear = 0;
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(14);
    constexpr Index3 cubes = { 3, 3, 3 };
    const TestMesh mesh = MakeMesh(
      random, cubes, cutting, 0.2, [&random](const Index3&) { return random.Uniform(0.0, 3.0); });
    std::vector<unsigned char> hidden(mesh.Shapes.size());
    std::generate(hidden.begin(), hidden.end(),
      [&random]() { return static_cast<unsigned char>(random.Integer(0, 9) == 0); });
    MeshField traced(mesh.View(), 2);
    for (int ray = 0; ray < 300; ++ray)
    {
      TraceRequest request(surfaces);
      request.Visible.HiddenCells = hidden.data();
      const Vector3 point = random.PointInBox({ -0.3, -0.3, -0.3 }, { 3.3, 3.3, 3.3 });
      request.Visible.HalfSpaces.push_back(Behind(random.Direction(), point));
      traced.Select(request, { 1, nullptr });
      const Vector3 direction = random.Direction();
      const std::vector<Hit> hits = Trace(traced, { point - direction * 3.0, direction });

      constexpr long double border = 1e-6L;
      std::int64_t expected = -1;
      long double value = 0;
      bool isClear = std::abs(Dot(direction, request.Visible.HalfSpaces[0].Normal)) > 1e-2;
      for (std::size_t cell = 0; cell < mesh.Shapes.size(); ++cell)
      {
        const Inverse::Place place = hidden[cell] != 0
          ? Inverse::Place()
          : Inverse(mesh, cell).Find({ point[0], point[1], point[2] });
        isClear = isClear && std::abs(place.Excess) > border;
        if (place.Excess < 0)
        {
          expected = static_cast<std::int64_t>(cell);
          value = place.Value;
        }
      }
      int surface = -1;
      for (const Isosurface& one : surfaces)
      {
        isClear = isClear && std::abs(value - one.Isovalue) > border;
        surface += expected >= 0 && value >= one.Isovalue ? 1 : 0;
      }
      if (!isClear)
      {
        ++unclear;
        continue;
      }
      const Hit* cap = FindCap(hits);
      ASSERT_EQ(CountCaps(hits), surface >= 0 ? 1U : 0U) << static_cast<int>(cutting) << " " << ray;
      none += cap ? 0 : 1;
      if (cap)
      {
        ++found;
        EXPECT_EQ(cap->Cell, expected);
        EXPECT_EQ(cap->Surface, surface);
        EXPECT_NEAR(cap->Value, static_cast<double>(value), 1e-8);
        EXPECT_NEAR(cap->T, 3.0, 1e-9);
        EXPECT_NEAR(Length(traced.GetPoint(*cap) - point), 0.0, 1e-8);
      }
    }
  }
  std::cout << "[ tried    ] " << found << " caps, " << none << " without, " << unclear
            << " unclear\n";
  EXPECT_GT(found, 500);
  EXPECT_GT(none, 300);
  EXPECT_LT(unclear, 100);
}

//------------------------------------------------------------------------------
/// Seen from inside, the cap is not hit; from behind, it is.
TEST(MeshCaps, AreHitFromBothSidesButNotInTheirPlane)
{
  for (const Cutting cutting : AllCuttings)
  {
    const TestMesh mesh = MakeFullMesh(Cubes, cutting);
    MeshField traced(mesh.View(), 2);
    TraceRequest request({ { 0.0, 1.0 } });
    request.Visible.HalfSpaces.push_back(Behind({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, 2.25 }));
    traced.Select(request, { 1, nullptr });
    const auto look = [&traced](double from, double way) {
      return Trace(traced, { { 3.5, 3.25, from }, { 0.0, 0.0, way } });
    };
    ASSERT_EQ(look(-5.0, 1.0).size(), 1U);
    EXPECT_NEAR(look(-5.0, 1.0)[0].T, 7.25, 1e-10);
    EXPECT_TRUE(look(-5.0, 1.0)[0].Entering);
    ASSERT_EQ(look(1.0, 1.0).size(), 1U);
    ASSERT_EQ(look(5.0, -1.0).size(), 1U);
    EXPECT_NEAR(look(5.0, -1.0)[0].T, 2.75, 1e-10);
    EXPECT_FALSE(look(5.0, -1.0)[0].Entering);
    ASSERT_EQ(look(12.0, -1.0).size(), 1U);
    EXPECT_TRUE(look(5.0, 1.0).empty());
    EXPECT_TRUE(look(2.25 + 1e-8, 1.0).empty());
    EXPECT_TRUE(look(1.0, -1.0).empty());
    EXPECT_TRUE(Trace(traced, { { -3.0, 3.25, 2.25 }, { 1.0, 0.0, 0.0 } }).empty());
  }
}

//------------------------------------------------------------------------------
TEST(MeshCaps, HaveTheOpacityOfTheirSurface)
{
  // From 0 at the border along x to 4 in the middle.
  RandomNumbers random(1);
  const TestMesh mesh = MakeMesh(random, { 8, 7, 9 }, Cutting::Tetrahedra, 0.0,
    [](const Index3& p) { return std::min(p[0], 8 - p[0]) + 0.0; });
  MeshField traced(mesh.View(), 2);
  const Line line = { { -4.0, 4.25, 4.5 }, { 1.0, 0.0, 0.0 } };
  const auto trace = [&](double skin, double bone, double cut)
  {
    TraceRequest request({ { 1.0, skin }, { 2.5, bone } });
    request.Visible.HalfSpaces.push_back(Behind({ 1.0, 0.0, 0.0 }, { cut, 0.0, 0.0 }));
    traced.Select(request, { 1, nullptr });
    return NameHits(Trace(traced, line));
  };
  EXPECT_EQ(trace(0.5, 0.5, 0.5), "sbbs");
  EXPECT_EQ(trace(0.5, 0.5, 2.0), "Sbbs");
  EXPECT_EQ(trace(0.5, 0.5, 3.0), "Bbs");
  EXPECT_EQ(trace(0.5, 1.0, 2.0), "Sb");
  EXPECT_EQ(trace(0.5, 1.0, 3.0), "B");
  EXPECT_EQ(trace(1.0, 0.5, 2.0), "S");
  EXPECT_EQ(trace(1.0, 0.5, 3.0), "Bbs");
  // Nothing is left after the second of these.
  EXPECT_EQ(trace(0.99, 0.99, 2.0), "Sb");
  EXPECT_EQ(trace(0.9995, 0.5, 2.0), "S");
}

//------------------------------------------------------------------------------
/// Where a ray leaves the surface and enters it at one place, after a cap it leaves first.
TEST(MeshCaps, TakeTurnsWithHitsAtOnePlace)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(1);
    const TestMesh mesh = MakeMesh(random, Cubes, cutting, 0.0,
      [](const Index3& p) {
        return p == Index3{ 4, 4, 4 } ? std::nextafter(1.0, 0.0) : 3.0;
      });
    MeshField traced(mesh.View(), 2);
    TraceRequest request({ { 1.0, Glass }, { 2.0, Glass } });
    request.Visible.HalfSpaces.push_back(Behind({ 0.1, 0.2, 1.0 }, { 4.0, 4.0, 2.25 }));
    traced.Select(request, { 1, nullptr });
    for (int x = -2; x <= 2; ++x)
    {
      for (int y = -2; y <= 2; ++y)
      {
        const Vector3 direction = { 0.5 * x, 0.25 * y, 1.0 };
        const std::vector<Hit> hits =
          Trace(traced, { Vector3{ 4.0, 4.0, 4.0 } - direction * 8.0, direction });
        ASSERT_GE(hits.size(), 5U);
        ASSERT_TRUE(hits[0].Plane == 0 && hits[0].Surface == 1);
        bool isInside[2] = { true, true };
        for (std::size_t i = 1; i < hits.size(); ++i)
        {
          EXPECT_EQ(hits[i].Entering, !isInside[hits[i].Surface]) << x << ", " << y << ": " << i;
          isInside[hits[i].Surface] = hits[i].Entering;
        }
        EXPECT_TRUE(isInside[0] && isInside[1]);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(MeshCaps, CloseFacesOfTheMeshThatLieInAPlane)
{
  for (const Cutting cutting : AllCuttings)
  {
    const TestMesh mesh = MakeFullMesh(Cubes, cutting);
    MeshField traced(mesh.View(), 2);
    RandomNumbers random(31);
    for (const double error : { 0.0, 1e-13, 1e-12 })
    {
      TraceRequest request({ { 0.0, Glass } });
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        Vector3 normal = { 0.0, 0.0, 0.0 };
        normal[axis] = 0.1;
        Vector3 last = { Cubes[0] + 0.0, Cubes[1] + 0.0, Cubes[2] + 0.0 };
        last[axis] += random.Uniform(-error, error);
        request.Visible.HalfSpaces.push_back(
          Behind(normal, { random.Uniform(-error, error), error, -error }));
        request.Visible.HalfSpaces.push_back(Behind(normal * -1.0, last));
      }
      traced.Select(request, { 1, nullptr });
      for (int ray = 0; ray < 1000; ++ray)
      {
        Line line = ray % 2 == 0
          ? RandomLine(random, Size)
          : Line{ { random.Integer(1, 7) + 0.0, random.Integer(1, 6) + 0.0,
                    random.Integer(1, 8) + 0.0 },
              { random.Integer(-2, 2) + 0.0, random.Integer(-2, 2) + 0.0, 1.0 } };
        line.Origin = line.Origin - line.Direction * 20.0;
        const std::vector<Hit> hits = Trace(traced, line);
        ASSERT_EQ(hits.size(), 2U) << ToText(line);
        EXPECT_TRUE(hits[0].Entering && !hits[1].Entering);
      }
    }
    // A plane outside of the mesh cuts nothing.
    TraceRequest request({ { 0.0, Glass } });
    request.Visible.HalfSpaces.push_back(Behind({ 1.0, 0.0, 0.0 }, { -1e-5, 0.0, 0.0 }));
    traced.Select(request, { 1, nullptr });
    EXPECT_TRUE(Trace(traced, { { -3.0, 3.5, 3.5 }, { 1.0, 0.1, 0.1 } }).empty());
  }
}

//------------------------------------------------------------------------------
/// Two meshes that touch in a plane, as two blocks of one, have one cap together: that of the mesh
/// which the half-space leaves. So they have where the plane passes both.
TEST(MeshCaps, AreInOneOfTwoMeshesThatTouch)
{
  RandomNumbers random(17);
  for (const bool hasFloats : { false, true })
  {
    TestMesh low = MakeFullMesh({ 3, 4, 4 }, Cutting::Tetrahedra);
    TestMesh high = MakeFullMesh({ 3, 4, 4 }, Cutting::Hexahedra);
    for (std::size_t i = 0; i < high.Points.size(); i += 3)
    {
      high.Points[i] += 3.0;
    }
    std::vector<float> points[2];
    MeshView views[2] = { low.View(), high.View() };
    for (TestMesh* mesh : { &low, &high })
    {
      const std::size_t k = mesh == &low ? 0 : 1;
      for (double& x : mesh->Points)
      {
        x *= 0.1;
        points[k].push_back(static_cast<float>(x));
      }
      if (hasFloats)
      {
        views[k].Points = points[k].data();
        views[k].PointType = ScalarType::Float32;
      }
    }
    MeshField fields[2] = { { views[0], 1 }, { views[1], 1 } };
    int found = 0;
    for (int ray = 0; ray < 4000; ++ray)
    {
      // Along the plane between the meshes, with a rounding of its own, or across it.
      const bool isBetween = ray % 2 == 0;
      const double way = ray % 4 < 2 ? 1.0 : -1.0;
      TraceRequest request({ { 0.0, Glass } });
      const double length = way * random.Uniform(0.1, 10.0);
      request.Visible.HalfSpaces.push_back(isBetween
          ? Behind({ length, 0.0, 0.0 }, { 0.1 * 3.0, 0.0, 0.0 })
          : Behind({ 0.0, length, 0.0 }, { 0.0, 0.2, 0.0 }));
      const Vector3 at = { isBetween ? 0.3 : random.Uniform(0.25, 0.35),
        isBetween ? random.Uniform(0.05, 0.35) : 0.2, random.Uniform(0.05, 0.35) };
      Vector3 direction = random.Direction();
      direction[isBetween ? 0 : 1] += direction[isBetween ? 0 : 1] > 0.0 ? 0.1 : -0.1;
      std::size_t caps[2];
      for (std::size_t k = 0; k < 2; ++k)
      {
        fields[k].Select(request, { 1, nullptr });
        caps[k] = CountCaps(Trace(fields[k], { at - direction * 5.0, direction }));
      }
      ASSERT_EQ(caps[0] + caps[1], 1U) << ray;
      if (isBetween)
      {
        ASSERT_EQ(caps[1], way > 0.0 ? 1U : 0U) << ray;
      }
      ++found;
    }
    EXPECT_EQ(found, 4000);
  }
}

//------------------------------------------------------------------------------
/// Cells of which a corner is not finite are no cells; one of those that overlap has the cap.
TEST(MeshCaps, AreWhereThereAreCells)
{
  TestMesh mesh = MakeFullMesh({ 4, 4, 4 }, Cutting::Hexahedra);
  mesh.Values[static_cast<std::size_t>(2 + 5 * (2 + 5 * 2))] =
    std::numeric_limits<double>::quiet_NaN();
  mesh.AddCell(CellShape::Hexahedron, { 0, 1, 6, 5, 25, 26, 31, 30 }); // the first cell again
  std::vector<unsigned char> hidden(mesh.Shapes.size());
  hidden[3 + 4 * 3] = 1;
  MeshField traced(mesh.View(), 2);
  for (const double way : { 1.0, -1.0 })
  {
    TraceRequest request({ { 0.0, Glass } });
    request.Visible.HiddenCells = hidden.data();
    request.Visible.Regions.Planes = { { { 0.0, 3.0 }, { 0.0, 3.0 }, { 0.0, 4.0 } } };
    request.Visible.Regions.Visible =
      CroppingRegions::All ^ (1U << (2 + 3 * 0 + 9 * 1)) ^ (1U << (2 + 3 * 1 + 9 * 1));
    request.Visible.HalfSpaces.push_back(
      Behind({ 0.0, 0.0, way }, { 0.0, 0.0, way > 0.0 ? 0.5 : 3.5 }));
    const auto findCell = [&](double x, double y)
    {
      traced.Select(request, { 1, nullptr });
      const std::vector<Hit> hits = Trace(traced, { { x, y, 2.0 - 9.0 * way }, { 0.0, 0.0, way } });
      EXPECT_LE(hits.size(), 1U);
      return FindCap(hits) ? FindCap(hits)->Cell : -1;
    };
    const int layer = way > 0.0 ? 0 : 48;
    EXPECT_EQ(findCell(0.5, 0.25), layer);
    EXPECT_EQ(findCell(2.5, 0.25), layer + 2);
    EXPECT_EQ(findCell(4.5, 0.25), -1);
    EXPECT_EQ(findCell(3.5, 1.25), -1); // cropped
    EXPECT_EQ(findCell(3.5, 3.25), way > 0.0 ? -1 : 63);
    request.Visible.HalfSpaces[0] = Behind({ 0.0, 0.0, way }, { 0.0, 0.0, 1.5 });
    EXPECT_EQ(findCell(2.5, 2.25), -1);
    EXPECT_EQ(findCell(0.5, 2.25), 24);
  }
}

//------------------------------------------------------------------------------
TEST(MeshCaps, AreOnlyOnRequestedPlanes)
{
  const TestMesh mesh = MakeFullMesh(Cubes, Cutting::Tetrahedra);
  MeshField traced(mesh.View(), 2);
  TraceRequest request({ { 0.0, 1.0 } });
  // The second one cuts later, and has none.
  request.Visible.HalfSpaces.push_back(Behind({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, 2.25 }));
  request.Visible.HalfSpaces.push_back({ { 0.0, 0.0, 1.0 }, -3.5 });
  const Line line = { { 3.5, 3.25, -1.0 }, { 0.0, 0.1, 1.0 } };
  traced.Select(request, { 1, nullptr });
  EXPECT_TRUE(Trace(traced, line).empty());
  request.Visible.HalfSpaces[1].Offset = -1.5;
  traced.Select(request, { 1, nullptr });
  EXPECT_EQ(Trace(traced, line).size(), 1U);
  request.Surfaces.clear();
  traced.Select(request, { 1, nullptr });
  EXPECT_TRUE(Trace(traced, line).empty());
}

}
}
