// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of all kernels must be those of a camera, to the last bit; the frusta must contain the
// rays they are made of, tightly.

#include "AllKernels.h"
#include "Image/Lattice/Ray.h"
#include "Image/Macrocells/BlockMask.h"
#include "Matrices.h"
#include "RandomNumbers.h"
#include "Rays/AppendBoxedRay.h"
#include "Rays/Camera.h"
#include "Rays/RayPacket.h"
#include "SameBits.h"
#include "TestLines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iostream>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class RayKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, RayKernels, AllKernels(), NameOfKernels);

/// A camera, and a rectangle of its pixels with the depths of what is drawn there.
struct View
{
  Camera TheCamera;
  Index3 Dimensions;
  PixelBlock Block;
  std::vector<float> Depths;
};

/// Scaled, turned and sheared.
Matrix4 RandomWorldFromObject(RandomNumbers& random, bool isAligned)
{
  const double scale = std::pow(10.0, random.Integer(-3, 3));
  Matrix4 matrix =
    Scaling({ random.Uniform(0.1, 2.0) * scale, -random.Uniform(0.1, 2.0) * scale, scale });
  if (!isAligned)
  {
    matrix[1] = random.Uniform(-0.5, 0.5) * scale;
    matrix[6] = random.Uniform(-0.5, 0.5) * scale;
    matrix = Multiply(Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0)), matrix);
  }
  return Multiply(Translation({ random.Uniform(-9.0, 9.0) * scale, 2.0, 3.0 }), matrix);
}

/// A perspective or a parallel projection that shows an object of some size at a distance; straight
/// on, or to the side.
Matrix4 RandomProjection(RandomNumbers& random, double size, double distance)
{
  const double extent = size * random.Uniform(0.1, 1.0);
  const double near = (size + distance) * random.Uniform(0.01, 0.5);
  const double far = near + (size + distance) * random.Uniform(1.0, 9.0);
  Matrix4 projection = random.Integer(0, 1) ? Perspective(near, far, extent / (size + distance))
                                            : Orthographic(near, far, extent);
  if (random.Integer(0, 2) == 0)
  {
    projection[2] = random.Uniform(-0.3, 0.3);
    projection[6] = random.Uniform(-0.3, 0.3);
  }
  return projection;
}

View RandomView(RandomNumbers& random)
{
  View view;
  const int longest = random.Integer(0, 1) ? 9 : 600;
  for (int& dimension : view.Dimensions)
  {
    dimension = random.Integer(2, longest);
  }
  const bool isAligned = random.Integer(0, 2) == 0;
  const Matrix4 worldFromObject = RandomWorldFromObject(random, isAligned);
  const Vector3 last = { view.Dimensions[0] - 1.0, view.Dimensions[1] - 1.0,
    view.Dimensions[2] - 1.0 };
  const Vector3 center = TransformPoint(worldFromObject, random.PointInBox({}, last));
  const double size = Length(TransformDirection(worldFromObject, last));
  // From within, from outside, and from far away.
  const double distances[] = { 0.0, random.Uniform(0.5, 3.0), random.Uniform(0.5, 3.0), 1e6 };
  const double distance = size * distances[random.Integer(0, 3)];
  const double turn = std::acos(0.0);
  const Matrix4 rotation = isAligned
    ? Rotation(turn * random.Integer(0, 1), turn * random.Integer(0, 1))
    : Rotation(random.Uniform(0.0, 6.0), random.Uniform(0.0, 6.0));
  const Matrix4 viewFromWorld =
    Multiply(Translation({ 0.0, 0.0, -distance }), Multiply(rotation, Translation(center * -1.0)));
  const Matrix4 clipFromObject =
    Multiply(RandomProjection(random, size, distance), Multiply(viewFromWorld, worldFromObject));
  Matrix4 indexFromClip = Invert(clipFromObject);
  if (random.Integer(0, 19) == 0)
  {
    const double bad[] = { 0.0, Infinity, std::nan(""), 1e300, 1e-300 };
    indexFromClip[random.Bits() % 16] = bad[random.Integer(0, 4)];
  }
  const int width = random.Integer(1, 300);
  const int height = random.Integer(1, 300);
  view.TheCamera = Camera(clipFromObject, indexFromClip, worldFromObject, width, height);
  PixelBlock& block = view.Block;
  block.Width = width;
  block.Height = height;
  block.Columns = random.Integer(1, std::min(width, random.Integer(0, 3) ? 19 : 128));
  block.Rows = random.Integer(1, std::min(height, RayPacket::Capacity / block.Columns));
  block.Column = random.Integer(0, width - block.Columns);
  block.Row = random.Integer(0, height - block.Rows);
  block.DepthStride = block.Columns + random.Integer(0, 5);
  view.Depths.resize(static_cast<std::size_t>(block.DepthStride * block.Rows));
  constexpr std::numeric_limits<float> limits;
  const float special[] = { 0.0F, 1.0F, limits.denorm_min(), limits.infinity(), limits.quiet_NaN(),
    -limits.infinity() };
  for (float& depth : view.Depths)
  {
    depth = random.Integer(0, 2) ? static_cast<float>(random.Uniform(0.0, 1.0))
                                 : special[random.Integer(0, 5)];
  }
  return view;
}

/// The bytes that must be equal in two rays.
std::array<double, 12> ValuesOf(const Ray& ray)
{
  return { ray.Origin[0], ray.Origin[1], ray.Origin[2], ray.Direction[0], ray.Direction[1],
    ray.Direction[2], ray.Inverse[0], ray.Inverse[1], ray.Inverse[2], ray.Begin, ray.End,
    ray.Base };
}

bool AreSame(const Ray& a, const Ray& b)
{
  const auto x = ValuesOf(a);
  const auto y = ValuesOf(b);
  return a.Step == b.Step && std::equal(x.begin(), x.end(), y.begin(), AreSameBits);
}

/// Compares the rays of a block with those of its camera, and counts.
class PixelChecks
{
public:
  explicit PixelChecks(const Kernels& kernels)
    : TheKernels(kernels)
  {
  }

  ~PixelChecks()
  {
    std::cout << "[ tried    ] " << this->Hits << " rays, " << this->Parallel
              << " of them along lattice planes, " << this->Misses << " that miss\n";
  }

  PixelChecks(const PixelChecks&) = delete;
  PixelChecks& operator=(const PixelChecks&) = delete;

  void Check(View& view, bool hasDepth)
  {
    PixelBlock& block = view.Block;
    block.ObjectFromClip = view.TheCamera.GetObjectFromClip().data();
    block.Depth = hasDepth ? view.Depths.data() : nullptr;
    block.Dimensions = view.Dimensions.data();
    RayPacket packet;
    std::memset(&packet, 0xFF, sizeof(packet)); // all numbers are none
    this->TheKernels.MakeRays(block, packet);
    ASSERT_EQ(packet.Count, block.Columns * block.Rows);
    for (int k = 0; k < RayPacket::Capacity; ++k)
    {
      if (k >= packet.Count)
      {
        ASSERT_FALSE(Has(packet.Exists, k));
        continue;
      }
      const int x = k % block.Columns;
      const int y = k / block.Columns;
      const float depth = block.Depth ? block.Depth[y * block.DepthStride + x] : 1.0F;
      const Camera::PixelRay pixel =
        view.TheCamera.GetRay(block.Column + x, block.Row + y, static_cast<double>(depth));
      const auto expected =
        ClipToVolume(pixel.Origin, pixel.Direction, 0.0, pixel.End, view.Dimensions);
      ASSERT_EQ(Has(packet.Exists, k), expected.has_value()) << "ray " << k;
      if (expected)
      {
        ASSERT_TRUE(AreSame(GetRay(packet, k), *expected)) << "ray " << k;
        const auto& step = expected->Step;
        this->Parallel += std::count(step.begin(), step.end(), 0) > 0 ? 1 : 0;
      }
      (expected ? this->Hits : this->Misses) += 1;
    }
  }

  std::size_t Hits = 0;
  std::size_t Misses = 0;
  std::size_t Parallel = 0;

private:
  const Kernels& TheKernels;
};

//------------------------------------------------------------------------------
TEST_P(RayKernels, GenerateCameraRays)
{
  RandomNumbers random(831);
  PixelChecks checks(this->TheKernels);
  for (int i = 0; i < 5000; ++i)
  {
    View view = RandomView(random);
    ASSERT_NO_FATAL_FAILURE(checks.Check(view, i % 2 == 0)) << "view " << i;
  }
  EXPECT_GT(checks.Hits, 50000U);
  EXPECT_GT(checks.Misses, 50000U);
  EXPECT_GT(checks.Parallel, 5000U);
}

//------------------------------------------------------------------------------
// Along each axis, up and down, with a pixel on every column of samples, and one beyond on each
// side.
TEST_P(RayKernels, GenerateRaysInFacesOfCells)
{
  PixelChecks checks(this->TheKernels);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double depth : { 20.0, -20.0 })
    {
      Matrix4 indexFromClip = {};
      indexFromClip[15] = 1.0;
      const auto set = [&](int row, int column, double factor, double offset)
      {
        indexFromClip[static_cast<std::size_t>(4 * row + column)] = factor;
        indexFromClip[static_cast<std::size_t>(4 * row + 3)] = offset;
      };
      set(BlockMask::U[axis], 0, 8.0, 6.5);
      set(BlockMask::V[axis], 1, 4.0, 2.5);
      set(axis, 2, depth, 3.0);
      View view = {};
      view.Dimensions = { 5, 5, 5 };
      view.TheCamera = Camera(Invert(indexFromClip), indexFromClip, {}, 16, 8);
      view.Block = { nullptr, 16, 8, 0, 0, 16, 8, nullptr, 16, nullptr };
      ASSERT_NO_FATAL_FAILURE(checks.Check(view, false)) << "axis " << axis;
    }
  }
  EXPECT_EQ(checks.Hits, 6U * 5U * 5U);
  EXPECT_EQ(checks.Parallel, checks.Hits);
}

//------------------------------------------------------------------------------
/// Rays of any lines, as they are given, of which some do not exist. All at once must be cut as one
/// by one.
struct GivenRays
{
  /// Those that are left, and others.
  int Cut = 0;
  int Missing = 0;

  /// Makes rays about a volume; append(line, begin, end, packet) cuts one.
  template <typename AppendOne, typename CutAll>
  void Check(const Index3& dimensions, const AppendOne& append, const CutAll& cut)
  {
    const double bad[] = { 0.0, Infinity, std::nan(""), 1e300, 1e-310 };
    RandomNumbers& random = this->Random;
    RayPacket packet;
    std::memset(&packet, 0xFF, sizeof(packet)); // all numbers are none
    packet.Clear();
    RayPacket expected = packet;
    const int count = random.Integer(0, RayPacket::Capacity);
    while (packet.Count < count)
    {
      Line line =
        random.Integer(0, 2) ? RandomLine(random, dimensions) : LatticeLine(random, dimensions);
      if (random.Integer(0, 9) == 0)
      {
        (random.Integer(0, 1) ? line.Origin : line.Direction)[random.Bits() % 3] =
          bad[random.Integer(0, 4)];
      }
      const double begin = random.Integer(0, 1) ? 0.0 : random.Uniform(0.0, 20.0);
      const double end = random.Integer(0, 1) ? Infinity : random.Uniform(0.0, 60.0);
      packet.Append(line.Origin, line.Direction, begin, end);
      append(line, begin, end, expected);
      if (random.Integer(0, 9) == 0)
      {
        Remove(packet.Count - 1, packet.Exists);
        Remove(packet.Count - 1, expected.Exists);
      }
    }
    cut(packet);
    ASSERT_EQ(packet.Count, count);
    for (int i = 0; i < RayPacket::Capacity; ++i)
    {
      ASSERT_EQ(Has(packet.Exists, i), Has(expected.Exists, i)) << "ray " << i;
      if (Has(packet.Exists, i))
      {
        ASSERT_TRUE(AreSame(GetRay(packet, i), GetRay(expected, i))) << "ray " << i;
      }
      (Has(packet.Exists, i) ? this->Cut : this->Missing) += i < count ? 1 : 0;
    }
  }

  Index3 MakeDimensions()
  {
    return { this->Random.Integer(2, 30), this->Random.Integer(2, 30),
      this->Random.Integer(2, 600) };
  }

  RandomNumbers Random{ 832 };
};

TEST_P(RayKernels, ClipRaysThatAreGiven)
{
  GivenRays rays;
  for (int run = 0; run < 500; ++run)
  {
    const Index3 dimensions = rays.MakeDimensions();
    ASSERT_NO_FATAL_FAILURE(rays.Check(
      dimensions,
      [&](const Line& line, double begin, double end, RayPacket& packet)
      { AppendRay(ClipToVolume(line.Origin, line.Direction, begin, end, dimensions), packet); },
      [&](RayPacket& packet) { this->TheKernels.ClipRays(dimensions.data(), packet); }));
  }
  EXPECT_GT(rays.Cut, 5000);
  EXPECT_GT(rays.Missing, 5000);
}

//------------------------------------------------------------------------------
TEST_P(RayKernels, MoveRaysThatAreGivenToBoxes)
{
  GivenRays rays;
  for (int run = 0; run < 500; ++run)
  {
    RandomNumbers& random = rays.Random;
    const Index3 dimensions = rays.MakeDimensions();
    // Some are flat, and some begin at a place in the volume.
    Bounds box = { {}, {} };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double size = dimensions[axis] - 1.0;
      box.Lower[axis] = random.Integer(0, 2) == 0 ? random.Uniform(0.0, 0.5 * size) : 0.0;
      box.Upper[axis] = random.Integer(0, 9) == 0 ? box.Lower[axis] : size;
    }
    ASSERT_NO_FATAL_FAILURE(rays.Check(
      dimensions,
      [&](const Line& line, double begin, double end, RayPacket& packet)
      { AppendBoxedRay(box, line.Origin, line.Direction, begin, end, packet); },
      [&](RayPacket& packet)
      { this->TheKernels.MoveRaysToBox(box.Lower.data(), box.Upper.data(), packet); }));
  }
  EXPECT_GT(rays.Cut, 5000);
  EXPECT_GT(rays.Missing, 5000);
}

//------------------------------------------------------------------------------
using LongPoint = std::array<long double, 3>;

LongPoint PointOn(const Ray& ray, long double t)
{
  LongPoint point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    point[axis] = static_cast<long double>(ray.Origin[axis]) +
      t * static_cast<long double>(ray.Direction[axis]);
  }
  return point;
}

/// Rays through one point whose directions differ by as much as spread says.
RayPacket MakeBundle(
  RandomNumbers& random, const Index3& dimensions, double spread, std::vector<Line>& lines)
{
  RayPacket packet;
  packet.Count = 0;
  packet.Exists = {};
  lines.clear();
  const Line middle = RandomLine(random, dimensions);
  const int count = random.Integer(1, RayPacket::Capacity);
  for (int i = 0; i < count; ++i)
  {
    const Vector3 off = random.PointInBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 });
    Line line = middle;
    line.Direction = (line.Direction + off * spread) * random.Uniform(0.5, 2.0);
    if (random.Integer(0, 1))
    {
      line.Origin = line.Origin + off;
    }
    const double end = random.Integer(0, 3) == 0 ? random.Uniform(0.0, 40.0) : Infinity;
    AppendRay(ClipToVolume(line.Origin, line.Direction, 0.0, end, dimensions), packet);
    lines.push_back(line);
  }
  return packet;
}

RaySet SomeOf(RandomNumbers& random, const RayPacket& packet, int percent)
{
  RaySet set = {};
  for (int i = 0; i < packet.Count; ++i)
  {
    if (Has(packet.Exists, i) && random.Integer(1, 100) <= percent)
    {
      Add(i, set);
    }
  }
  return set;
}

/// Whether rays make a frustum along an axis; undecided is set where rounding may decide.
bool MakeFrustum(const RayPacket& packet, const RaySet& rays, int axis, bool& undecided)
{
  bool up = false;
  bool down = false;
  bool steep = false;
  undecided = false;
  for (int i = 0; i < packet.Count; ++i)
  {
    if (!Has(rays, i))
    {
      continue;
    }
    const long double along = packet.Direction[axis][i];
    up = up || along > 0.0L;
    down = down || along < 0.0L;
    for (int other = 0; other < 3; ++other)
    {
      const long double slope = std::abs(packet.Direction[other][i] / along);
      steep = steep || !(slope <= 2.0L);
      undecided = undecided || std::abs(slope - 2.0L) < 1e-12L;
    }
  }
  return up != down && !steep;
}

/// The bounds that a frustum must contain, found ray by ray.
struct Bounds
{
  long double Low = Infinity;
  long double High = -Infinity;
  long double Least[2][2] = { { Infinity, Infinity }, { Infinity, Infinity } };
  long double Most[2][2] = { { -Infinity, -Infinity }, { -Infinity, -Infinity } };
};

class FrustumChecks
{
public:
  void Check(
    RandomNumbers& random, const RayPacket& packet, const RaySet& rays, const Frustum& frustum)
  {
    ++this->Frusta;
    Bounds bounds;
    for (int i = 0; i < packet.Count; ++i)
    {
      if (Has(rays, i))
      {
        const Ray ray = GetRay(packet, i);
        ASSERT_EQ(frustum.IsUp, ray.Direction[static_cast<std::size_t>(frustum.Axis)] > 0.0);
        ASSERT_NO_FATAL_FAILURE(this->CheckRay(random, ray, frustum));
        Include(ray, frustum, bounds);
      }
    }
    // Rays that are not in the set do not count.
    ASSERT_GT(frustum.Low, bounds.Low - Slack);
    ASSERT_LT(frustum.High, bounds.High + Slack);
    for (int j = 0; j < 2; ++j)
    {
      for (int end = 0; end < 2; ++end)
      {
        ASSERT_GT(frustum.Least[j][end], bounds.Least[j][end] - Slack);
        ASSERT_LT(frustum.Most[j][end], bounds.Most[j][end] + Slack);
      }
    }
  }

  std::size_t GetNumberOfFrusta() const { return this->Frusta; }

private:
  static constexpr long double Slack = 0.01L;

  static std::size_t Across(const Frustum& frustum, int j)
  {
    return static_cast<std::size_t>(
      j == 0 ? BlockMask::U[frustum.Axis] : BlockMask::V[frustum.Axis]);
  }

  void CheckRay(RandomNumbers& random, const Ray& ray, const Frustum& frustum)
  {
    for (int i = 0; i < 6; ++i)
    {
      const long double fraction = i < 2 ? i : random.Uniform(0.0, 1.0);
      const LongPoint p = PointOn(ray, ray.Begin + fraction * (ray.End - ray.Begin));
      const long double coordinate = p[static_cast<std::size_t>(frustum.Axis)];
      ASSERT_LT(frustum.Low, coordinate);
      ASSERT_GT(frustum.High, coordinate);
      const long double along =
        (coordinate - frustum.Low) / (static_cast<long double>(frustum.High) - frustum.Low);
      for (int j = 0; j < 2; ++j)
      {
        const long double least =
          frustum.Least[j][0] + along * (frustum.Least[j][1] - frustum.Least[j][0]);
        const long double most =
          frustum.Most[j][0] + along * (frustum.Most[j][1] - frustum.Most[j][0]);
        ASSERT_LT(least, p[Across(frustum, j)]);
        ASSERT_GT(most, p[Across(frustum, j)]);
      }
    }
  }

  static void Include(const Ray& ray, const Frustum& frustum, Bounds& bounds)
  {
    const auto axis = static_cast<std::size_t>(frustum.Axis);
    for (const double t : { ray.Begin, ray.End })
    {
      const long double coordinate = PointOn(ray, t)[axis];
      bounds.Low = std::min(bounds.Low, coordinate);
      bounds.High = std::max(bounds.High, coordinate);
    }
    for (int end = 0; end < 2; ++end)
    {
      const long double plane = end == 0 ? frustum.Low : frustum.High;
      const LongPoint p =
        PointOn(ray, (plane - ray.Origin[axis]) / static_cast<long double>(ray.Direction[axis]));
      for (int j = 0; j < 2; ++j)
      {
        bounds.Least[j][end] = std::min(bounds.Least[j][end], p[Across(frustum, j)]);
        bounds.Most[j][end] = std::max(bounds.Most[j][end], p[Across(frustum, j)]);
      }
    }
  }

  std::size_t Frusta = 0;
};

TEST_P(RayKernels, FrustaContainTheirRays)
{
  RandomNumbers random(832);
  FrustumChecks checks;
  std::size_t refused = 0;
  for (int i = 0; i < 6000; ++i)
  {
    const int longest = i % 5 == 0 ? 3000 : 40;
    const Index3 dimensions = { random.Integer(2, longest), random.Integer(2, longest),
      random.Integer(2, longest) };
    std::vector<Line> lines;
    const double spreads[] = { 0.0, 0.01, 0.1, 0.5, 3.0 };
    RayPacket packet = MakeBundle(random, dimensions, spreads[i % 5], lines);
    const RaySet rays = SomeOf(random, packet, i % 2 == 0 ? 100 : 30);
    const int axis = random.Integer(0, 2);
    bool undecided = false;
    const bool expected = MakeFrustum(packet, rays, axis, undecided);
    AlignedRays aligned;
    Frustum frustum = {};
    const bool isFrustum = this->TheKernels.Align(packet, rays, axis, aligned, frustum);
    if (undecided)
    {
      continue;
    }
    ASSERT_EQ(isFrustum, expected) << i;
    refused += isFrustum ? 0 : 1;
    if (isFrustum)
    {
      ASSERT_EQ(frustum.Axis, axis);
      ASSERT_NO_FATAL_FAILURE(checks.Check(random, packet, rays, frustum)) << i;
    }
  }
  std::cout << "[ tried    ] " << checks.GetNumberOfFrusta() << " frusta, " << refused
            << " sets of rays that are none\n";
  EXPECT_GT(checks.GetNumberOfFrusta(), 1000U);
  EXPECT_GT(refused, 1000U);
}

//------------------------------------------------------------------------------
TEST_P(RayKernels, NoFrustumForOpposedOrSteepRays)
{
  const Index3 dimensions = { 20, 20, 20 };
  const auto haveFrustum = [&](const std::vector<Vector3>& directions)
  {
    RayPacket packet;
    packet.Count = 0;
    packet.Exists = {};
    for (const Vector3& direction : directions)
    {
      AppendRay(ClipToVolume({ 9.5, 9.5, 9.5 }, direction, 0.0, Infinity, dimensions), packet);
    }
    AlignedRays aligned;
    Frustum frustum;
    return this->TheKernels.Align(packet, packet.Exists, 0, aligned, frustum);
  };
  EXPECT_TRUE(haveFrustum({ { 1.0, 0.0, 0.0 } }));
  EXPECT_TRUE(haveFrustum({ { -1.0, 1.9, -1.9 }, { -0.01, 0.0, 0.0 } }));
  EXPECT_TRUE(haveFrustum({ { 1.0, 2.0, -2.0 } }));
  EXPECT_FALSE(haveFrustum({ { 1.0, 2.01, 0.0 } }));
  EXPECT_FALSE(haveFrustum({ { 1.0, 0.0, -2.01 } }));
  EXPECT_FALSE(haveFrustum({ { 1.0, 0.0, 0.0 }, { -1.0, 0.0, 0.0 } }));
  EXPECT_FALSE(haveFrustum({ { 0.0, 1.0, 0.0 } }));
  EXPECT_FALSE(haveFrustum({ { 0.0, 1.0, 1.0 }, { 1.0, 0.0, 0.0 } }));
  // A ray of another kind at any index of the packet.
  for (std::size_t index = 0; index < 19; ++index)
  {
    std::vector<Vector3> directions(19, Vector3{ 1.0, 0.1, 0.2 });
    EXPECT_TRUE(haveFrustum(directions));
    directions[index][0] = -1.0;
    EXPECT_FALSE(haveFrustum(directions)) << index;
    directions[index] = { 1.0, 0.0, 5.0 };
    EXPECT_FALSE(haveFrustum(directions)) << index;
  }
}

}
}
