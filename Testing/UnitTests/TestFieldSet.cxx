// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A set of fields is traced like its fields one by one: the blocks of an image like the image.

#include "Field/BoundsTree.h"
#include "Field/BuildTimer.h"
#include "Field/FieldSet.h"
#include "Image/ImageField.h"
#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"
#include "Math/Matrix.h"
#include "Matrices.h"
#include "Picture/CastRays.h"
#include "Picture/RenderTiles.h"
#include "RandomNumbers.h"
#include "Rays/LineFrustum.h"
#include "Rays/RaysInBox.h"
#include "SameBits.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int Edge = 33;

/// Many sheets, which all blocks have some of.
double Gyroid(double x, double y, double z)
{
  return std::sin(0.45 * x) * std::cos(0.45 * y) + std::sin(0.45 * y) * std::cos(0.45 * z) +
    std::sin(0.45 * z) * std::cos(0.45 * x);
}

/// A part of an image, made when it is asked for.
class Block final : public FieldSource
{
public:
  Block(const Index3& first, const Index3& dimensions)
    : Volume(TestVolume<double>::Of(dimensions,
        [&first](const Vector3& p)
        { return Gyroid(p[0] + first[0], p[1] + first[1], p[2] + first[2]); }))
    , First(first)
  {
  }

  TracedField& GetField() override
  {
    ++this->TimesAsked;
    if (!this->Field)
    {
      this->Field = ImageField::New(this->Volume.View(), {}, 1);
    }
    return *this->Field;
  }

  Visibility FindVisible() const override { return {}; }

  PlacedField Place(const Matrix4& setFromImage, bool isOnDemand)
  {
    PlacedField placed{};
    placed.Source = this;
    placed.SetFromOwn = Multiply(setFromImage,
      Translation({ static_cast<double>(this->First[0]), static_cast<double>(this->First[1]),
        static_cast<double>(this->First[2]) }));
    const Index3& size = this->Volume.Dimensions;
    placed.Box = TransformBounds(
      placed.SetFromOwn, { { 0.0, 0.0, 0.0 }, { size[0] - 1.0, size[1] - 1.0, size[2] - 1.0 } });
    placed.IsOnDemand = isOnDemand;
    return placed;
  }

  bool IsMade() const { return this->Field != nullptr; }
  int GetTimesAsked() const { return this->TimesAsked; }

private:
  int TimesAsked = 0;
  TestVolume<double> Volume;
  Index3 First;
  std::unique_ptr<ImageField> Field;
};

/// An image in blocks, and the set of them, in a space that is the image's or another.
struct Blocks
{
  Blocks(int edge, const Matrix4& setFromImage, bool areOnDemand)
  {
    for (int z = 0; z + 1 < Edge; z += edge)
    {
      for (int y = 0; y + 1 < Edge; y += edge)
      {
        for (int x = 0; x + 1 < Edge; x += edge)
        {
          const auto size = [edge](int first) { return std::min(edge, Edge - 1 - first) + 1; };
          this->All.push_back(
            std::make_unique<Block>(Index3{ x, y, z }, Index3{ size(x), size(y), size(z) }));
          this->Placed.push_back(this->All.back()->Place(setFromImage, areOnDemand));
        }
      }
    }
    this->Set = std::make_unique<FieldSet>(this->Placed);
  }

  std::ptrdiff_t CountMade() const
  {
    return std::count_if(this->All.begin(), this->All.end(),
      [](const std::unique_ptr<Block>& block) { return block->IsMade(); });
  }

  std::vector<std::unique_ptr<Block>> All;
  std::vector<PlacedField> Placed;
  std::unique_ptr<FieldSet> Set;
};

/// Rays across the image, in its space.
std::vector<CastRay> MakeRays(int count)
{
  RandomNumbers random(3);
  std::vector<CastRay> rays;
  for (int i = 0; i < count; ++i)
  {
    const auto pick = [&random] { return random.Uniform(-20.0, Edge + 20.0); };
    const Vector3 from = { pick(), pick(), -40.0 };
    const Vector3 to = { pick(), pick(), pick() };
    rays.push_back({ from, to - from, 0.0, 1e9 });
  }
  return rays;
}

std::vector<CastRay> Transformed(const Matrix4& matrix, std::vector<CastRay> rays)
{
  for (CastRay& ray : rays)
  {
    ray.Origin = TransformPoint(matrix, ray.Origin);
    ray.Direction = TransformDirection(matrix, ray.Direction);
  }
  return rays;
}

TraceRequest MakeRequest(double opacity)
{
  TraceRequest request;
  request.Surfaces = { { -0.4, opacity }, { 0.3, opacity } };
  return request;
}

const Matrix4 Turned = Multiply(
  Translation({ 3.0, -2.0, 7.0 }), Multiply(Rotation(0.7, 0.4), Scaling({ 0.5, 1.7, 1.1 })));

/// Expects the same hits, though not the same bits.
void ExpectSameHits(const RayHits& hits, const RayHits& expected)
{
  ASSERT_EQ(hits.First, expected.First);
  for (std::size_t i = 0; i < hits.Hits.size(); ++i)
  {
    EXPECT_NEAR(hits.Hits[i].T, expected.Hits[i].T, 1e-9 * expected.Hits[i].T) << i;
    EXPECT_EQ(hits.Hits[i].Surface, expected.Hits[i].Surface) << i;
    EXPECT_EQ(hits.Hits[i].Entering, expected.Hits[i].Entering) << i;
  }
}

//------------------------------------------------------------------------------
TEST(FieldSet, BlocksAreTracedLikeTheImage)
{
  Blocks whole(Edge - 1, Scaling({ 1.0, 1.0, 1.0 }), false);
  TracedField& image = whole.All.front()->GetField();
  const std::vector<CastRay> rays = MakeRays(4000);
  for (const int edge : { 5, 16, 32 })
  {
    for (const Matrix4& matrix : { Scaling({ 1.0, 1.0, 1.0 }), Turned })
    {
      Blocks blocks(edge, matrix, edge == 5);
      for (const double opacity : { 1.0, 0.3, 0.01 })
      {
        SCOPED_TRACE(testing::Message() << edge << " " << opacity);
        image.Select(MakeRequest(opacity), {});
        const RayHits expected = CastRays(image, rays, 2);
        EXPECT_GT(expected.Hits.size(), 1000U);
        blocks.Set->Select(MakeRequest(opacity), {});
        ExpectSameHits(CastRays(*blocks.Set, Transformed(matrix, rays), 2), expected);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(FieldSet, PointsAndGradientsAreThoseOfTheImage)
{
  Blocks whole(Edge - 1, Scaling({ 1.0, 1.0, 1.0 }), false);
  TracedField& image = whole.All.front()->GetField();
  Blocks blocks(16, Turned, true);
  TraceRequest request = MakeRequest(0.3);
  request.Normals = NormalMode::InterpolantGradient;
  image.Select(request, {});
  blocks.Set->Select(request, {});
  const std::vector<CastRay> rays = MakeRays(500);
  const RayHits expected = CastRays(image, rays, 1);
  const RayHits hits = CastRays(*blocks.Set, Transformed(Turned, rays), 1);
  ExpectSameHits(hits, expected);
  const Matrix4 setFromGradient = NormalMatrix(Turned);
  for (std::size_t first = 0; first < hits.Hits.size(); first += RayPacket::Capacity)
  {
    const auto count =
      static_cast<int>(std::min<std::size_t>(RayPacket::Capacity, hits.Hits.size() - first));
    alignas(64) double points[3][RayPacket::Capacity];
    alignas(64) double gradients[3][RayPacket::Capacity];
    blocks.Set->GetPointsAndGradients(
      &hits.Hits[first], count, blocks.Set->GetRequest().Normals, points, gradients);
    for (int i = 0; i < count; ++i)
    {
      const std::size_t number = first + static_cast<std::size_t>(i);
      const Hit& hit = hits.Hits[number];
      const Vector3 point = TransformPoint(Turned, image.GetPoint(expected.Hits[number]));
      const Vector3 normal = Normalized(TransformDirection(setFromGradient,
        image.GetGradient(expected.Hits[number], NormalMode::InterpolantGradient)));
      const Vector3 single = blocks.Set->GetGradient(hit, NormalMode::InterpolantGradient);
      EXPECT_LT(Length(blocks.Set->GetPoint(hit) - point), 1e-8);
      EXPECT_LT(Length(Vector3{ points[0][i], points[1][i], points[2][i] } - point), 1e-8);
      EXPECT_LT(Length(Normalized(single) - normal), 1e-7);
      EXPECT_LT(
        Length(Normalized(Vector3{ gradients[0][i], gradients[1][i], gradients[2][i] }) - normal),
        1e-7);
    }
  }
}

//------------------------------------------------------------------------------
TEST(FieldSet, WhatNoRayMeetsIsNotMade)
{
  Blocks blocks(4, Scaling({ 1.0, 1.0, 1.0 }), true);
  ASSERT_EQ(blocks.All.size(), 512U);
  blocks.Set->Select(MakeRequest(0.01), {});
  EXPECT_EQ(blocks.CountMade(), 0);
  const std::int64_t before = BuildTimer::GetNanosecondsOfThread();
  const RayHits hits =
    CastRays(*blocks.Set, { { { -5.0, 2.0, 2.0 }, { 1.0, 0.0, 0.0 }, 0.0, 1e9 } }, 1);
  EXPECT_GT(hits.Hits.size(), 2U);
  EXPECT_EQ(blocks.CountMade(), 8);
  EXPECT_GT(BuildTimer::GetNanosecondsOfThread(), before);
  // Those behind an opaque surface are not met.
  Blocks hidden(4, Scaling({ 1.0, 1.0, 1.0 }), true);
  hidden.Set->Select(MakeRequest(1.0), {});
  CastRays(*hidden.Set, { { { -5.0, 2.0, 2.0 }, { 1.0, 0.0, 0.0 }, 0.0, 1e9 } }, 1);
  EXPECT_LT(hidden.CountMade(), 4);
}

//------------------------------------------------------------------------------
/// Thousands of members are selected again only if something has changed.
TEST(FieldSet, MembersAreSelectedAgainIfNeeded)
{
  Blocks blocks(16, Scaling({ 1.0, 1.0, 1.0 }), true);
  const std::vector<CastRay> rays = MakeRays(200);
  const auto trace = [&blocks, &rays](const TraceRequest& request, const MemoryBudget& budget)
  {
    blocks.Set->Select(request, {}, budget);
    return CastRays(*blocks.Set, rays, 1);
  };
  const auto count = [&blocks] { return blocks.All.front()->GetTimesAsked(); };
  const RayHits first = trace(MakeRequest(1.0), {});
  EXPECT_EQ(count(), 1);
  EXPECT_TRUE(AreSame(trace(MakeRequest(1.0), {}).Hits, first.Hits));
  EXPECT_EQ(count(), 1);
  trace(MakeRequest(0.5), {});
  EXPECT_EQ(count(), 2);
  TraceRequest cut = MakeRequest(0.5);
  cut.Visible.HalfSpaces = { { { 0.0, 0.0, 1.0 }, -3.0 } };
  trace(cut, {});
  EXPECT_EQ(count(), 3);
  cut.Visible.HalfSpaces.front().Offset = -4.0;
  trace(cut, {});
  EXPECT_EQ(count(), 4);
  blocks.Set->Forget();
  trace(cut, {});
  EXPECT_EQ(count(), 5);
  // Caches with a limit begin a frame with every selection.
  const MemoryBudget little = { 1 << 20 };
  trace(cut, little);
  EXPECT_EQ(count(), 6);
  trace(cut, little);
  EXPECT_EQ(count(), 7);
  trace(cut, {});
  EXPECT_EQ(count(), 8);
}

//------------------------------------------------------------------------------
/// Rays end at the first hit of a member that is opaque.
TEST(FieldSet, MembersHaveOpacitiesOfTheirOwn)
{
  const std::vector<CastRay> rays = MakeRays(4000);
  for (const int edge : { 5, 16 })
  {
    Blocks blocks(edge, Turned, edge == 5);
    TraceRequest request = MakeRequest(0.01);
    blocks.Set->Select(request, {});
    const RayHits all = CastRays(*blocks.Set, Transformed(Turned, rays), 2);
    for (std::size_t number = 0; number < blocks.All.size(); ++number)
    {
      request.MemberOpacities.push_back(
        number % 3 == 0 ? std::optional<double>(1.0) : std::nullopt);
    }
    EXPECT_FALSE(request.HasOnlyOpaqueSurfaces());
    RayHits expected;
    expected.Clear();
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
    {
      for (std::size_t i = all.First[ray]; i < all.First[ray + 1]; ++i)
      {
        expected.Hits.push_back(all.Hits[i]);
        EXPECT_EQ(request.GetOpacity(all.Hits[i]), all.Hits[i].Member % 3 == 0 ? 1.0 : 0.01);
        if (all.Hits[i].Member % 3 == 0)
        {
          break;
        }
      }
      expected.EndRay();
    }
    EXPECT_LT(expected.Hits.size() + 1000, all.Hits.size());
    blocks.Set->Select(request, {});
    ExpectSameHits(CastRays(*blocks.Set, Transformed(Turned, rays), 2), expected);
    std::fill(request.MemberOpacities.begin(), request.MemberOpacities.end(), 1.0);
    EXPECT_TRUE(request.HasOnlyOpaqueSurfaces());
  }
}

//------------------------------------------------------------------------------
TEST(FieldSet, ProjectionsHaveTheExtremeOfAll)
{
  Blocks whole(Edge - 1, Scaling({ 1.0, 1.0, 1.0 }), false);
  TracedField& image = whole.All.front()->GetField();
  Blocks blocks(7, Turned, true);
  const std::vector<CastRay> rays = MakeRays(1000);
  for (const Extremum extremum : { Extremum::Largest, Extremum::Smallest })
  {
    TraceRequest request;
    request.Projection = extremum;
    image.Select(request, {});
    blocks.Set->Select(request, {});
    const RayHits expected = CastRays(image, rays, 1);
    const RayHits hits = CastRays(*blocks.Set, Transformed(Turned, rays), 1);
    ASSERT_EQ(hits.First, expected.First);
    EXPECT_GT(hits.Hits.size(), 100U);
    for (std::size_t i = 0; i < hits.Hits.size(); ++i)
    {
      EXPECT_NEAR(hits.Hits[i].Value, expected.Hits[i].Value, 1e-9);
    }
  }
}

//------------------------------------------------------------------------------
TEST(FieldSet, HalfSpacesCutAllMembers)
{
  Blocks whole(Edge - 1, Scaling({ 1.0, 1.0, 1.0 }), false);
  TracedField& image = whole.All.front()->GetField();
  Blocks blocks(16, Turned, false);
  const std::vector<CastRay> rays = MakeRays(1000);
  for (const bool isCapped : { false, true })
  {
    TraceRequest request = MakeRequest(0.3);
    const HalfSpace half = { { 0.4, 0.5, -0.6 }, -3.3, isCapped };
    request.Visible.HalfSpaces = { half };
    image.Select(request, {});
    const RayHits expected = CastRays(image, rays, 1);
    const Matrix4 imageFromSet = InvertAffine(Turned);
    request.Visible.HalfSpaces = { { TransposeTransformDirection(imageFromSet, half.Normal),
      Dot(half.Normal, TransformPoint(imageFromSet, { 0.0, 0.0, 0.0 })) + half.Offset, isCapped } };
    blocks.Set->Select(request, {});
    const RayHits hits = CastRays(*blocks.Set, Transformed(Turned, rays), 1);
    ExpectSameHits(hits, expected);
    const auto countCaps = [](const RayHits& all)
    {
      return std::count_if(
        all.Hits.begin(), all.Hits.end(), [](const Hit& hit) { return hit.Plane != Hit::NoPlane; });
    };
    EXPECT_EQ(countCaps(hits), countCaps(expected));
    EXPECT_EQ(countCaps(hits) > 50, isCapped);
  }
}

//------------------------------------------------------------------------------
/// A field and where it is in a scene.
struct Shown
{
  TracedField& Field;
  Matrix4 WorldFromObject;
};

/// A picture with shadows and ambient occlusion.
Frame Render(const std::vector<Shown>& fields, bool shadows, const Kernels* kernels)
{
  Scene scene;
  for (const Shown& each : fields)
  {
    SceneField shown;
    shown.Field = &each.Field;
    const Matrix4 clipFromObject = Multiply(Perspective(30.0, 200.0, 0.4),
      Multiply(Invert(Translation({ 16.0, 17.0, 90.0 })), each.WorldFromObject));
    shown.View = Camera(clipFromObject, Invert(clipFromObject), each.WorldFromObject, 150, 130);
    shown.Colors = { { 1.0, 0.6, 0.2 }, { 0.3, 0.5, 1.0 } };
    shown.Surface.Shade = true;
    scene.Fields.push_back(shown);
  }
  scene.Pixels = { 0, 0, 150, 130 };
  scene.TileWidth = 64;
  scene.TileHeight = 64;
  Light light;
  light.Direction = Normalized({ 0.3, 0.7, 0.8 });
  scene.Lights = { light };
  scene.Shadows = shadows;
  scene.OcclusionRays = shadows ? 4 : 0;
  Execution execution;
  execution.Threads = 2;
  execution.PacketKernels = kernels;
  Frame frame;
  FrameTimes times;
  EXPECT_TRUE(RenderTiles(scene, execution, frame, times, [](double) { return true; }));
  return frame;
}

std::size_t CountDifferent(const Frame& a, const Frame& b, int tolerance)
{
  std::size_t count = 0;
  for (std::size_t pixel = 0; pixel < a.Depths.size(); ++pixel)
  {
    bool isDifferent = std::abs(a.Depths[pixel] - b.Depths[pixel]) > 1e-5F;
    for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
    {
      isDifferent = isDifferent || std::abs(a.Colors[k] - b.Colors[k]) > tolerance;
    }
    count += isDifferent ? 1 : 0;
  }
  return count;
}

//------------------------------------------------------------------------------
TEST(FieldSet, PicturesAreThoseOfTheImage)
{
  const Matrix4 identity = Scaling({ 1.0, 1.0, 1.0 });
  Blocks whole(Edge - 1, identity, false);
  TracedField& image = whole.All.front()->GetField();
  Blocks blocks(6, Turned, true);
  for (const double opacity : { 1.0, 0.4 })
  {
    for (const bool shadows : { false, true })
    {
      for (const Kernels* kernels : { static_cast<const Kernels*>(nullptr), &GetBestKernels() })
      {
        TraceRequest request = MakeRequest(opacity);
        // Central differences would show the borders of blocks.
        request.Normals = NormalMode::InterpolantGradient;
        Execution execution;
        execution.PacketKernels = kernels;
        image.Select(request, execution);
        blocks.Set->Select(request, execution);
        const Frame expected = Render({ { image, identity } }, shadows, kernels);
        const Frame frame = Render({ { *blocks.Set, InvertAffine(Turned) } }, shadows, kernels);
        EXPECT_GT(std::count_if(frame.Colors.begin(), frame.Colors.end(),
                    [](std::uint8_t channel) { return channel > 50; }),
          9000);
        // Shadows of grazing rays, and the directions of occlusion, depend on the cell's numbers.
        EXPECT_LE(CountDifferent(frame, expected, shadows ? 40 : 1), shadows ? 200U : 2U)
          << opacity << " " << shadows;
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Packets of a set are traced together, those of a field beside it one by one.
TEST(FieldSet, PicturesBesideAnotherFieldAreThoseOfTheImage)
{
  const Matrix4 identity = Scaling({ 1.0, 1.0, 1.0 });
  const Matrix4 aside = Multiply(Translation({ 4.0, 6.0, -9.0 }), Rotation(0.5, 0.3));
  Blocks whole(Edge - 1, identity, false);
  Blocks other(Edge - 1, identity, false);
  TracedField& image = whole.All.front()->GetField();
  TracedField& beside = other.All.front()->GetField();
  Blocks blocks(6, Turned, true);
  for (const double opacity : { 1.0, 0.4 })
  {
    TraceRequest request = MakeRequest(opacity);
    request.Normals = NormalMode::InterpolantGradient;
    image.Select(request, {});
    blocks.Set->Select(request, {});
    beside.Select(MakeRequest(0.6), {});
    const Shown ofSet = { *blocks.Set, InvertAffine(Turned) };
    const Kernels* kernels = &GetBestKernels();
    const Frame expected = Render({ { image, identity }, { beside, aside } }, false, kernels);
    const Frame first = Render({ ofSet, { beside, aside } }, false, kernels);
    const Frame last = Render({ { beside, aside }, ofSet }, false, kernels);
    const Frame alone = Render({ ofSet }, false, kernels);
    EXPECT_LE(CountDifferent(first, expected, 1), 2U);
    EXPECT_LE(CountDifferent(last, expected, 1), 2U);
    EXPECT_GT(CountDifferent(alone, expected, 1), 2000U);
  }
}

//------------------------------------------------------------------------------
TEST(FieldSet, InstructionSetsChangeNoBit)
{
  const std::vector<CastRay> rays = Transformed(Turned, MakeRays(2000));
  Blocks blocks(6, Turned, true);
  for (const double opacity : { 1.0, 0.3 })
  {
    Execution execution;
    execution.PacketKernels = nullptr;
    blocks.Set->Select(MakeRequest(opacity), execution);
    const RayHits expected = CastRays(*blocks.Set, rays, 1);
    EXPECT_GT(expected.Hits.size(), 500U);
    for (const Kernels* kernels : GetKernels())
    {
      execution.PacketKernels = kernels;
      blocks.Set->Select(MakeRequest(opacity), execution);
      const RayHits hits = CastRays(*blocks.Set, rays, 2);
      EXPECT_EQ(hits.First, expected.First);
      EXPECT_TRUE(AreSame(hits.Hits, expected.Hits));
    }
  }
}

//------------------------------------------------------------------------------
TEST(FieldSet, BeamsChangeNoBit)
{
  // The tiles of a picture have beams, rays that are cast have none. Members overlap: of those that
  // begin nearer, surfaces may be farther.
  const Matrix4 identity = Scaling({ 1.0, 1.0, 1.0 });
  Blocks some(6, identity, true);
  Blocks others(16, Multiply(Translation({ 3.1, 2.7, -4.9 }), Rotation(0.1, -0.2)), true);
  std::vector<PlacedField> placed = others.Placed;
  placed.insert(placed.end(), some.Placed.begin(), some.Placed.end());
  FieldSet set(placed);
  const std::unique_ptr<TracedField::Beam> beam = set.MakeBeam();
  const Matrix4 clipFromObject =
    Multiply(Perspective(30.0, 200.0, 0.4), Invert(Translation({ 16.0, 17.0, 90.0 })));
  const Camera view(clipFromObject, Invert(clipFromObject), identity, 64, 48);
  const auto findCorners = [&view](const PixelRectangle& pixels)
  {
    RayPacket lines;
    lines.Clear();
    for (const int y : { pixels.Y, pixels.Y + pixels.Height - 1 })
    {
      for (const int x : { pixels.X, pixels.X + pixels.Width - 1 })
      {
        const Camera::PixelRay ray = view.GetRay(x, y, 1.0);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          lines.Origin[axis][lines.Count] = ray.Origin[axis];
          lines.Direction[axis][lines.Count] = ray.Direction[axis];
        }
        ++lines.Count;
      }
    }
    return lines;
  };
  ASSERT_EQ(set.GetPacketsAtOnce(), 8);
  const auto packets = std::make_unique<TracedPacket[]>(8);
  for (const double opacity : { 0.3, 1.0 })
  {
    set.Select(MakeRequest(opacity), {});
    std::size_t count = 0;
    for (int tile = 0; tile < 4; ++tile)
    {
      // Beside packets with all rays there is one without any.
      const PixelRectangle pixels = { tile % 2 * 32, tile / 2 * 24, 32, 24 };
      set.Begin(findCorners(pixels), beam.get());
      RayHits without[8];
      for (int i = 0; i < 7; ++i)
      {
        const PixelRectangle block = { pixels.X + i % 2 * 16, pixels.Y + i / 2 % 3 * 8, 16, 8 };
        packets[i].Corners = findCorners(block);
        set.MakeRays(view, block, {}, packets[i].Rays);
        packets[i].Rays.Exists.Words[0] = i == 5 ? 0 : packets[i].Rays.Exists.Words[0];
        packets[i].Rays.Exists.Words[1] = i == 5 ? 0 : packets[i].Rays.Exists.Words[1];
        RayPacket again = packets[i].Rays;
        set.Trace(again, without[i]);
      }
      set.TracePackets(packets.get(), 7, beam.get());
      for (int i = 0; i < 7; ++i)
      {
        EXPECT_EQ(packets[i].Hits.First, without[i].First);
        EXPECT_TRUE(AreSame(packets[i].Hits.Hits, without[i].Hits));
        count += without[i].Hits.size();
      }
    }
    EXPECT_GT(count, 1000U);
  }
}

//------------------------------------------------------------------------------
/// Boxes are found one by one, or in groups by each of the kernels.
TEST(LineFrustum, FindsTheBoxesThatRaysMeet)
{
  RandomNumbers random(5);
  Bounds around = NoBounds();
  std::vector<Bounds> each;
  for (int i = 0; i < 1000; ++i)
  {
    const auto pick = [&random] { return random.Uniform(-9.0, 9.0); };
    const Vector3 lower = { pick(), pick(), pick() };
    const Vector3 size = { random.Uniform(0.1, 1.5), 0.3, 0.2 };
    each.push_back({ lower, lower + size });
    around = Unite(around, each.back());
  }
  const BoundsTree tree(each);
  for (const bool isParallel : { false, true })
  {
    RayPacket lines;
    lines.Clear();
    for (int i = 0; i < 4; ++i)
    {
      const Vector3 eye = { 1.0, 2.0, 30.0 };
      const Vector3 corner = { -2.0 + 1.5 * (i % 2), -3.0 + 2.5 * (i / 2), 0.0 };
      const Vector3 origin = isParallel ? corner + Vector3{ 0.0, 0.0, 30.0 } : eye;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        lines.Origin[axis][i] = origin[axis];
        lines.Direction[axis][i] = corner[axis] - origin[axis];
      }
      ++lines.Count;
    }
    const LineFrustum frustum(lines, around);
    std::vector<std::size_t> isMet(each.size());
    std::transform(each.begin(), each.end(), isMet.begin(),
      [&frustum](const Bounds& box) { return frustum.MayMeet(box) ? 1 : 0; });
    const std::size_t met = std::accumulate(isMet.begin(), isMet.end(), std::size_t{ 0 });
    EXPECT_GT(met, 5U);
    EXPECT_LT(met, 100U);
    std::vector<std::size_t> found(each.size());
    tree.Find([&frustum](const Bounds& box) { return frustum.MayMeet(box); },
      [&found](std::size_t number) { ++found[number]; });
    EXPECT_EQ(found, isMet);
    for (const Kernels* kernels : GetKernels())
    {
      std::fill(found.begin(), found.end(), 0);
      tree.FindByGroups([&](const BoxGroup& boxes)
        { return kernels->FindMetBoxes(boxes, frustum.GetSides(), frustum.GetNumberOfSides()); },
        [&found](std::size_t number, const Bounds&) { ++found[number]; });
      EXPECT_EQ(found, isMet);
    }
    // A ray in the middle meets none of the others.
    for (int i = 0; i < 200; ++i)
    {
      const double u = random.Uniform(0.0, 1.0);
      const double v = random.Uniform(0.0, 1.0);
      Vector3 origin;
      Vector3 inverse;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const auto mix = [&](const double(&of)[RayPacket::Capacity]) {
          return (1.0 - v) * ((1.0 - u) * of[0] + u * of[1]) + v * ((1.0 - u) * of[2] + u * of[3]);
        };
        origin[axis] = mix(lines.Origin[axis]);
        inverse[axis] = 1.0 / mix(lines.Direction[axis]);
      }
      for (std::size_t k = 0; k < each.size(); ++k)
      {
        double begin = 0.0;
        double end = 9.0;
        const bool meets = CutToBox(
          each[k].Lower.data(), each[k].Upper.data(), origin.data(), inverse.data(), begin, end);
        EXPECT_TRUE(!meets || isMet[k] == 1);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// A ray that starts on a surface is not stopped by the same surface of another member.
TEST(FieldSet, SurfacesThatCoincideCastNoShadowsOnEachOther)
{
  const Matrix4 identity = Scaling({ 1.0, 1.0, 1.0 });
  Blocks once(Edge - 1, identity, false);
  Blocks again(16, identity, true);
  std::vector<PlacedField> placed = once.Placed;
  placed.insert(placed.end(), again.Placed.begin(), again.Placed.end());
  FieldSet set(placed);
  TraceRequest request = MakeRequest(1.0);
  request.Normals = NormalMode::InterpolantGradient;
  TracedField& image = once.All.front()->GetField();
  image.Select(request, {});
  const Frame expected = Render({ { image, identity } }, true, &GetBestKernels());
  set.Select(request, {});
  const Frame frame = Render({ { set, identity } }, true, &GetBestKernels());
  EXPECT_LE(CountDifferent(frame, expected, 40), 200U);
}

}
}
