// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Frames of fields whose picture is known: where surfaces are, their depth, and how colours are
// composited.

#include "Image/ImageField.h"
#include "Kernels/Kernels.h"
#include "Math/Matrix.h"
#include "Matrices.h"
#include "OneFieldScene.h"
#include "Picture/RenderTiles.h"
#include "RandomNumbers.h"
#include "Rays/RayPacket.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestVolume.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

bool GoOn(double)
{
  return true;
}

Camera NewCamera(const Matrix4& projection, const Matrix4& worldFromView,
  const Matrix4& worldFromIndex, int width, int height)
{
  const Matrix4 clipFromIndex =
    Multiply(projection, Multiply(Invert(worldFromView), worldFromIndex));
  return { clipFromIndex, Invert(clipFromIndex), worldFromIndex, static_cast<double>(width),
    static_cast<double>(height) };
}

/// Looks down on a volume of 9 x 9 x 9 samples along -z, from z = 20; the near plane is at z = 19,
/// the far plane at z = -11, and a pixel is one cell wide: column 0 is at x = 0.5.
OneFieldScene NewSceneFromAbove()
{
  OneFieldScene scene;
  scene.Shown.View = NewCamera(Orthographic(1.0, 31.0, 4.0), Translation({ 4.0, 4.0, 20.0 }),
    Scaling({ 1.0, 1.0, 1.0 }), 8, 8);
  scene.Pixels = { 0, 0, 8, 8 };
  scene.Request.Surfaces = { { 0.0, 1.0 } };
  scene.Shown.Colors = { { 1.0, 0.5, 0.25 } };
  return scene;
}

Frame Render(OneFieldScene scene, ImageField& image)
{
  Frame frame;
  FrameTimes times;
  EXPECT_TRUE(RenderTiles(scene.Show(image), scene.GetExecution(), frame, times, GoOn));
  EXPECT_GE(times.Bricks, 0.0);
  EXPECT_GE(times.Trace, 0.0);
  EXPECT_GE(times.Shade, 0.0);
  return frame;
}

template <typename Field>
struct SampledField
{
  explicit SampledField(const Field& field)
    : Volume(TestVolume<float>::Of({ 9, 9, 9 }, field))
    , Traced(ImageField::New(this->Volume.View(), {}, 1))
  {
  }

  TestVolume<float> Volume;
  std::unique_ptr<ImageField> Traced;
};

std::vector<int> PixelOf(const Frame& frame, std::size_t pixel)
{
  const auto first = frame.Colors.begin() + static_cast<std::ptrdiff_t>(4 * pixel);
  return { first, first + 4 };
}

//------------------------------------------------------------------------------
TEST(RenderTiles, PlaneInParallelProjection)
{
  // z = 2 + 0.5 x - 0.25 y, inside is below
  const SampledField field(AnalyticFields::Plane{ { 0.5, -0.25, -1.0 }, -2.0 });
  const Frame frame = Render(NewSceneFromAbove(), *field.Traced);
  ASSERT_EQ(frame.Depths.size(), 64U);
  ASSERT_EQ(frame.Colors.size(), 256U);
  for (std::size_t i = 0; i < 64; ++i)
  {
    const double x = static_cast<double>(i % 8) + 0.5;
    const double y = static_cast<double>(i / 8) + 0.5;
    const double z = 2.0 + 0.5 * x - 0.25 * y;
    EXPECT_NEAR(frame.Depths[i], (19.0 - z) / 30.0, 1e-7);
    EXPECT_EQ(PixelOf(frame, i), (std::vector<int>{ 255, 128, 64, 255 }));
  }
}

//------------------------------------------------------------------------------
TEST(RenderTiles, PlaneInPerspectiveProjection)
{
  const SampledField field(AnalyticFields::Plane{ { 0.0, 0.0, -1.0 }, -3.0 }); // z = 3
  OneFieldScene scene = NewSceneFromAbove();
  const double spacing = 0.5;
  scene.Shown.View = NewCamera(Perspective(1.0, 100.0, 1.0), Translation({ 2.0, 2.0, 3.5 }),
    Scaling({ spacing, spacing, spacing }), 10, 10);
  scene.Pixels = { 0, 0, 10, 10 };
  const Frame frame = Render(scene, *field.Traced);
  // The plane is 2 before the eye, and 4 wide there: it just fills the picture.
  for (std::size_t i = 0; i < 100; ++i)
  {
    EXPECT_NEAR(frame.Depths[i], (1.0 - 1.0 / 2.0) / (1.0 - 1.0 / 100.0), 1e-7);
    EXPECT_EQ(PixelOf(frame, i)[3], 255);
  }
}

//------------------------------------------------------------------------------
TEST(RenderTiles, PixelsWithoutSurfaceAreEmpty)
{
  const SampledField field(AnalyticFields::Plane{ { 1.0, 0.0, -1.0 }, 0.75 }); // z = x - 0.75
  OneFieldScene scene = NewSceneFromAbove();
  scene.Pixels = { -3, -2, 14, 12 };
  const Frame frame = Render(scene, *field.Traced);
  ASSERT_EQ(frame.Depths.size(), 14U * 12U);
  int empty = 0;
  for (std::size_t i = 0; i < frame.Depths.size(); ++i)
  {
    const int x = static_cast<int>(i % 14) - 3;
    const int y = static_cast<int>(i / 14) - 2;
    const bool onSurface = x >= 1 && x < 8 && y >= 0 && y < 8;
    const double depth = onSurface ? (19.0 - (x + 0.5 - 0.75)) / 30.0 : 2.0;
    EXPECT_NEAR(frame.Depths[i], depth, 1e-7) << x << " " << y;
    EXPECT_EQ(PixelOf(frame, i),
      (onSurface ? std::vector<int>{ 255, 128, 64, 255 } : std::vector<int>{ 0, 0, 0, 0 }));
    empty += onSurface ? 0 : 1;
  }
  EXPECT_EQ(empty, 14 * 12 - 7 * 8);
}

//------------------------------------------------------------------------------
TEST(RenderTiles, RectangleMatchesTheWholePicture)
{
  const SampledField field(AnalyticFields::Sphere{ { 4.1, 3.9, 4.2 }, 3.0 });
  OneFieldScene scene = NewSceneFromAbove();
  scene.Shown.Surface.Shade = true;
  scene.Lights = { Light() };
  const Frame whole = Render(scene, *field.Traced);
  scene.Pixels = { 2, 3, 5, 4 };
  const Frame part = Render(scene, *field.Traced);
  ASSERT_EQ(part.Depths.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i)
  {
    const std::size_t pixel = (i / 5 + 3) * 8 + i % 5 + 2;
    EXPECT_EQ(part.Depths[i], whole.Depths[pixel]);
    EXPECT_EQ(PixelOf(part, i), PixelOf(whole, pixel));
  }
}

//------------------------------------------------------------------------------
TEST(RenderTiles, EmptyRectangle)
{
  const SampledField field(AnalyticFields::Sphere{ { 4.1, 3.9, 4.2 }, 3.0 });
  OneFieldScene scene = NewSceneFromAbove();
  scene.Pixels = { 2, 3, 0, 0 };
  const Frame frame = Render(scene, *field.Traced);
  EXPECT_TRUE(frame.Colors.empty() && frame.Depths.empty());
}

//------------------------------------------------------------------------------
TestVolume<float> NewGyroid()
{
  return TestVolume<float>::Of({ 40, 41, 42 }, AnalyticFields::Gyroid{ 13.0 });
}

/// An opaque and a translucent surface of the gyroid, which cover many tiles.
OneFieldScene NewSceneOfGyroid()
{
  OneFieldScene scene;
  const Matrix4 worldFromView = Multiply(Rotation(0.4, 0.9), Translation({ 10.0, 15.0, 90.0 }));
  scene.Shown.View =
    NewCamera(Perspective(1.0, 300.0, 0.5), worldFromView, Scaling({ 1.0, 1.1, -0.9 }), 101, 67);
  scene.Pixels = { 0, 0, 101, 67 };
  scene.Request.Surfaces = { { -0.7, 1.0 }, { 0.2, 0.4 } };
  scene.Shown.Colors = { { 0.2, 0.4, 0.9 }, { 0.9, 0.8, 0.1 } };
  scene.Shown.Surface.Shade = true;
  scene.Lights = { Light() };
  return scene;
}

std::ptrdiff_t CountCovered(const Frame& frame)
{
  return std::count_if(
    frame.Depths.begin(), frame.Depths.end(), [](float depth) { return depth <= 1.0F; });
}

//------------------------------------------------------------------------------
// Blocks of pixels whose rays cannot hit anything are skipped: this must not change the picture.

/// Few small objects, many of them at the border of the volume.
TestVolume<float> NewCrumbs(RandomNumbers& random)
{
  const int longest = random.Integer(0, 3) ? 30 : 150;
  const Index3 n = { random.Integer(2, 20), random.Integer(2, 20), random.Integer(2, longest) };
  std::vector<float> samples(Count(n), -1.0F);
  for (int i = random.Integer(1, 20); i > 0; --i)
  {
    Index3 index = { random.Integer(0, n[0] - 1), random.Integer(0, n[1] - 1),
      random.Integer(0, n[2] - 1) };
    if (random.Integer(0, 1))
    {
      const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
      index[axis] = random.Integer(0, 1) ? 0 : n[axis] - 1;
    }
    // With a large one, the surface comes very near to the samples beside it.
    samples[Offset(index, n)] =
      random.Integer(0, 2) ? static_cast<float>(random.Uniform(0.0, 3.0)) : 1e6F;
  }
  return TestVolume<float>(n, samples);
}

/// From anywhere, in any direction: without, within or beside the volume, or very far from it.
Camera AnyCamera(RandomNumbers& random, const Index3& n, int width, int height)
{
  const Vector3 last = { n[0] - 1.0, n[1] - 1.0, n[2] - 1.0 };
  const double distances[] = { 0.0, random.Uniform(0.0, 30.0), 100.0, 3e4, 9e5, 1e7 };
  const double distance = distances[random.Integer(0, 5)];
  const Vector3 forward = random.Direction();
  const Vector3 right =
    Normalized({ forward[1] - forward[2], forward[2] - forward[0], forward[0] - forward[1] });
  const Vector3 up = { right[1] * forward[2] - right[2] * forward[1],
    right[2] * forward[0] - right[0] * forward[2], right[0] * forward[1] - right[1] * forward[0] };
  const Vector3 eye = random.PointInBox({}, last) - forward * distance;
  const Matrix4 indexFromView = { right[0], up[0], -forward[0], eye[0], right[1], up[1],
    -forward[1], eye[1], right[2], up[2], -forward[2], eye[2], 0.0, 0.0, 0.0, 1.0 };
  const double near = std::max(0.1, random.Integer(0, 1) ? distance - 200.0 : 1e-3 * distance);
  const double halfHeight = random.Uniform(1.0, 20.0);
  Matrix4 projection = random.Integer(0, 2)
    ? Perspective(near, distance + 300.0, halfHeight / std::max(distance, 20.0))
    : Orthographic(near, distance + 300.0, halfHeight);
  if (random.Integer(0, 2) == 0)
  {
    // Off the axis, and sheared.
    Matrix4 shear = Translation({});
    shear[1] = random.Uniform(-0.5, 0.5);
    shear[2] = random.Uniform(-0.2, 0.2);
    shear[3] = random.Uniform(-0.5, 0.5);
    projection = Multiply(shear, projection);
  }
  return NewCamera(projection, indexFromView, Translation({}), width, height);
}

/// Along an axis of the volume, so that rays lie in planes of the lattice or next to them.
Camera CameraAlongAnAxis(RandomNumbers& random, const Index3& n, int width, int height)
{
  const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
  Matrix4 worldFromIndex = {};
  for (std::size_t row = 0; row < 3; ++row)
  {
    worldFromIndex[4 * row + (axis + 1 + row) % 3] = row == 2 && random.Integer(0, 1) ? -1.0 : 1.0;
  }
  worldFromIndex[15] = 1.0;
  const double pixel = random.Integer(0, 1) ? 1.0 : 0.25;
  const double offs[] = { 0.0, 1e-12, -1e-12, 1e-6, 0.5 };
  const Vector3 eye = { 0.5 * pixel * width - 3.5 * pixel + offs[random.Integer(0, 4)],
    0.5 * pixel * height - 2.5 * pixel + offs[random.Integer(0, 4)], n[axis] + 100.0 };
  const Matrix4 projection = random.Integer(0, 3)
    ? Orthographic(1.0, 500.0, 0.5 * pixel * height)
    : Perspective(1.0, 500.0, 0.5 * pixel * height / (n[axis] + 100.0));
  const Matrix4 square = Multiply(
    Scaling({ static_cast<double>(height) / static_cast<double>(width), 1.0, 1.0 }), projection);
  return NewCamera(square, Translation(eye), worldFromIndex, width, height);
}

OneFieldScene AnyScene(RandomNumbers& random, const Index3& n)
{
  const int width = random.Integer(1, 80);
  const int height = random.Integer(1, 60);
  OneFieldScene scene;
  scene.Shown.View = random.Integer(0, 2) ? AnyCamera(random, n, width, height)
                                          : CameraAlongAnAxis(random, n, width, height);
  scene.Pixels = random.Integer(0, 1)
    ? PixelRectangle{ 0, 0, width, height }
    : PixelRectangle{ random.Integer(-9, 9), random.Integer(-9, 9), random.Integer(1, width),
        random.Integer(1, height) };
  const int tiles[][2] = { { 16, 8 }, { 16, 8 }, { 1, 1 }, { 1, 9 }, { 40, 1 }, { 7, 5 },
    { 33, 31 }, { 200, 200 } };
  const auto& tile = tiles[random.Integer(0, 7)];
  scene.TileWidth = tile[0];
  scene.TileHeight = tile[1];
  scene.Request.Surfaces = { { 0.0, random.Integer(0, 2) ? 1.0 : 0.5 } };
  scene.Shown.Colors = { { 1.0, 0.5, 0.25 } };
  scene.Request.Solver = random.Integer(0, 5) ? RootSolver::Robust : RootSolver::Linear;
  scene.Request.Interpolation =
    random.Integer(0, 5) ? Interpolant::Trilinear : Interpolant::Nearest;
  scene.KeepHits = true;
  return scene;
}

TEST(RenderTiles, SkippingEmptyRegionsChangesNoPixel)
{
  RandomNumbers random(871);
  std::size_t hits = 0;
  std::size_t pictures = 0;
  for (int i = 0; i < 1500; ++i)
  {
    const auto volume = NewCrumbs(random);
    const auto traced = ImageField::New(volume.View(), {}, 1);
    for (int k = 0; k < 5; ++k)
    {
      OneFieldScene scene = AnyScene(random, volume.Dimensions);
      scene.Request.PacketKernels = nullptr;
      const Frame reference = Render(scene, *traced);
      scene.Request.PacketKernels = GetKernels()[random.Bits() % GetKernels().size()];
      const Frame frame = Render(scene, *traced);
      ASSERT_EQ(frame.Colors, reference.Colors) << i << " " << k;
      ASSERT_EQ(frame.Depths, reference.Depths) << i << " " << k;
      for (std::size_t pixel = 0; pixel < reference.Hits.size(); ++pixel)
      {
        ASSERT_TRUE(AreSame(frame.Hits[pixel], reference.Hits[pixel])) << i << " " << k;
        hits += reference.Hits[pixel].Surface != Hit::NoSurface ? 1 : 0;
      }
      ++pictures;
    }
  }
  std::cout << "[ tried    ] " << pictures << " pictures, " << hits << " pixels with a hit\n";
  EXPECT_GT(hits, 50000U);
}

//------------------------------------------------------------------------------
TEST(RenderTiles, CastsRaysOnlyWhereTheyMayHit)
{
  static const Kernels* base;
  static int blocks;
  OneFieldScene scene;
  scene.Shown.View = NewCamera(Orthographic(1.0, 200.0, 64.0), Translation({ 64.0, 64.0, 150.0 }),
    Scaling({ 1.0, 1.0, 1.0 }), 128, 128);
  scene.Pixels = { 0, 0, 128, 128 };
  scene.Request.Surfaces = { { 0.0, 1.0 } };
  scene.Shown.Colors = { { 1.0, 0.5, 0.25 } };
  // In the middle of one macrocell.
  const auto volume =
    TestVolume<float>::Of({ 128, 128, 128 }, AnalyticFields::Sphere{ { 44.0, 84.0, 60.0 }, 1.5 });
  const auto traced = ImageField::New(volume.View(), {}, 1);
  for (const Kernels* kernels : GetKernels())
  {
    base = kernels;
    blocks = 0;
    Kernels counting = *kernels;
    counting.MakeRays = [](const PixelBlock& block, RayPacket& packet)
    {
      ++blocks;
      base->MakeRays(block, packet);
    };
    scene.Request.PacketKernels = &counting;
    const Frame frame = Render(scene, *traced);
    EXPECT_EQ(CountCovered(frame), 4);
    // Of 128 x 128 pixels the macrocell covers 8 x 8, which are in one block of 16 x 8.
    EXPECT_EQ(blocks, 1);
  }
}

//------------------------------------------------------------------------------
// From the rays of the pixels to their colours.
TEST(RenderTiles, IdenticalWithAllKernels)
{
  const auto volume = NewGyroid();
  const auto traced = ImageField::New(volume.View(), {}, 1);
  OneFieldScene scene = NewSceneOfGyroid();
  scene.Pixels = { 3, 5, 91, 59 };
  std::vector<float> depths(Count({ 91, 59, 1 }), 1.0F);
  for (std::size_t i = 0; i < depths.size(); i += 3)
  {
    depths[i] = 0.9F + 0.1F * static_cast<float>(i % 100) / 100.0F;
  }
  for (const bool hasDepth : { false, true })
  {
    scene.Depth = hasDepth ? depths.data() : nullptr;
    for (const double opacity : { 1.0, 0.4 })
    {
      scene.Request.Surfaces[0].Opacity = opacity;
      scene.Request.PacketKernels = nullptr;
      const Frame reference = Render(scene, *traced);
      EXPECT_TRUE(opacity < 1.0 || CountCovered(reference) > 500);
      for (const Kernels* kernels : GetKernels())
      {
        scene.Request.PacketKernels = kernels;
        const Frame frame = Render(scene, *traced);
        ASSERT_EQ(frame.Colors, reference.Colors);
        ASSERT_EQ(frame.Depths, reference.Depths);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(RenderTiles, IdenticalForAllThreadsAndTiles)
{
  const auto volume = NewGyroid();
  OneFieldScene scene = NewSceneOfGyroid();
  Light lamp;
  lamp.Positional = true;
  lamp.Position = { 50.0, 50.0, 90.0 };
  scene.Lights.push_back(lamp);
  Frame reference;
  std::size_t frames = 0;
  for (const int threads : { 1, 2, 3, 7 })
  {
    for (const auto& tile : { std::pair(32, 4), { 1, 1 }, { 7, 5 }, { 200, 200 }, { 101, 1 } })
    {
      // A new field each time, so that the threads make bricks at once.
      for (const BrickLayout layout : { BrickLayout::Apron, BrickLayout::TwoLevel })
      {
        const auto traced = ImageField::New(volume.View(), { { 8, 8 }, layout, 8, 4 }, threads);
        scene.Threads = threads;
        scene.TileWidth = tile.first;
        scene.TileHeight = tile.second;
        Frame frame = Render(scene, *traced);
        if (frames++ == 0)
        {
          reference = std::move(frame);
          continue;
        }
        ASSERT_EQ(frame.Colors, reference.Colors);
        ASSERT_EQ(frame.Depths, reference.Depths);
      }
    }
  }
  const auto covered = CountCovered(reference);
  std::cout << "[ tried    ] " << frames << " frames of 101 x 67 pixels, " << covered
            << " with an opaque surface\n";
  EXPECT_GT(covered, 500);
}

//------------------------------------------------------------------------------
/// Finds no memory for the colour of any hit.
class FailingColors : public HitColors
{
public:
  Vector3 Get(const Hit& /*hit*/) const override { throw std::bad_alloc(); }
};

//------------------------------------------------------------------------------
/// A scene that takes many times as long as it takes from one report of progress to the next.
class SlowScene
{
public:
  SlowScene(int threads, int tile)
    : Field(AnalyticFields::Gyroid{ 5.0 })
    , TheScene(NewSceneFromAbove())
  {
    this->TheScene.Shown.View = NewCamera(Orthographic(1.0, 31.0, 4.0),
      Translation({ 4.0, 4.0, 20.0 }), Scaling({ 1.0, 1.0, 1.0 }), 150, 150);
    this->TheScene.Shown.Surface.Shade = true;
    this->TheScene.Pixels = { 0, 0, 150, 150 };
    this->TheScene.OcclusionRays = 80;
    this->TheScene.TileWidth = tile;
    this->TheScene.TileHeight = tile;
    this->TheScene.Threads = threads;
  }

  bool Render(Frame& picture, const std::function<bool(double)>& keepGoing)
  {
    FrameTimes times;
    return RenderTiles(this->TheScene.Show(*this->Field.Traced), this->TheScene.GetExecution(),
      picture, times, keepGoing);
  }

private:
  SampledField<AnalyticFields::Gyroid> Field;
  OneFieldScene TheScene;
};

//------------------------------------------------------------------------------
TEST(RenderTiles, StopsWhenAborted)
{
  for (const int tile : { 8, 4096 })
  {
    SlowScene scene(2, tile);
    for (int calls = 1; calls <= 3; ++calls)
    {
      Frame picture;
      std::vector<double> fractions;
      EXPECT_FALSE(scene.Render(picture,
        [&](double done)
        {
          fractions.push_back(done);
          return static_cast<int>(fractions.size()) < calls;
        }));
      ASSERT_EQ(fractions.size(), static_cast<std::size_t>(calls));
      EXPECT_LT(fractions.back(), 1.0);
    }
  }
}

//------------------------------------------------------------------------------
/// On the calling thread, and while no other is at work.
TEST(RenderTiles, ReportsProgressWhileNothingHappens)
{
  Frame whole;
  SlowScene(1, 16).Render(whole, [](double /*done*/) { return true; });
  for (const int tile : { 16, 4096 })
  {
    const auto caller = std::this_thread::get_id();
    Frame picture;
    double last = 0.0;
    int calls = 0;
    EXPECT_TRUE(SlowScene(4, tile).Render(picture,
      [&](double done)
      {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        EXPECT_TRUE(done > last && done <= 1.0);
        last = done;
        ++calls;
        const std::vector<std::uint8_t> before = picture.Colors;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        EXPECT_EQ(picture.Colors, before);
        return true;
      }));
    EXPECT_GT(calls, 3);
    EXPECT_EQ(last, 1.0);
    // In steps, a frame is the same.
    EXPECT_EQ(picture.Colors, whole.Colors);
    EXPECT_EQ(picture.Depths, whole.Depths);
  }
}

//------------------------------------------------------------------------------
TEST(RenderTiles, ExceptionsOfThreadsArriveAtTheCaller)
{
  for (const int threads : { 1, 4 })
  {
    FailingColors colors;
    const SampledField field(AnalyticFields::Gyroid{ 5.0 });
    OneFieldScene scene = NewSceneFromAbove();
    scene.Shown.ColorsOfHits = &colors;
    scene.Threads = threads;
    Frame picture;
    FrameTimes times;
    EXPECT_THROW(RenderTiles(scene.Show(*field.Traced), scene.GetExecution(), picture, times,
                   [](double /*done*/) { return true; }),
      std::bad_alloc);
  }
}

//------------------------------------------------------------------------------
TEST(RenderTiles, RaysEndAtTheDepthBuffer)
{
  const SampledField field(AnalyticFields::Plane{ { 0.0, 0.0, -1.0 }, -3.0 }); // z = 3
  OneFieldScene scene = NewSceneFromAbove();
  const float depthOfPlane = 16.0F / 30.0F;
  std::vector<float> depths(64);
  for (std::size_t i = 0; i < 64; ++i)
  {
    const float offs[] = { -1e-6F, 1e-6F, -0.5F, 1.0F - depthOfPlane };
    depths[i] = depthOfPlane + offs[i % 4];
  }
  scene.Depth = depths.data();
  scene.TileWidth = 3;
  scene.TileHeight = 3;
  const Frame frame = Render(scene, *field.Traced);
  for (std::size_t i = 0; i < 64; ++i)
  {
    const bool isVisible = depths[i] > depthOfPlane;
    EXPECT_NEAR(frame.Depths[i], isVisible ? depthOfPlane : PixelWithoutDepth, 1e-7);
    EXPECT_EQ(PixelOf(frame, i)[3], isVisible ? 255 : 0);
  }
}

//------------------------------------------------------------------------------
TEST(RenderTiles, CompositesTranslucentSurfacesFrontToBack)
{
  const SampledField field(AnalyticFields::Plane{ { 0.0, 0.0, 1.0 }, 0.0 }); // value z
  OneFieldScene scene = NewSceneFromAbove();
  // From above: the last first. A colour of 3 is clamped to 1.
  scene.Request.Surfaces = { { 1.5, 1.0 }, { 3.5, 0.25 }, { 5.5, 0.5 } };
  scene.Shown.Colors = { { 0.4, 0.6, 3.0 }, { 0.0, 1.0, 0.0 }, { 1.0, 0.0, 0.2 } };
  Frame frame = Render(scene, *field.Traced);
  const auto byte = [](double value) { return static_cast<int>(std::lround(255.0 * value)); };
  const double behind = 0.5 * 0.75;
  EXPECT_EQ(PixelOf(frame, 27),
    (std::vector<int>{
      byte(0.5 + behind * 0.4), byte(0.5 * 0.25 + behind * 0.6), byte(0.5 * 0.2 + behind), 255 }));
  EXPECT_NEAR(frame.Depths[27], (19.0 - 1.5) / 30.0, 1e-7);

  scene.Request.Surfaces[0].Opacity = 0.1;
  frame = Render(scene, *field.Traced);
  EXPECT_EQ(PixelOf(frame, 27),
    (std::vector<int>{ byte(0.5 + behind * 0.1 * 0.4), byte(0.5 * 0.25 + behind * 0.1 * 0.6),
      byte(0.5 * 0.2 + behind * 0.1), byte(1.0 - behind * 0.9) }));
  EXPECT_EQ(frame.Depths[27], PixelWithoutDepth);
}

//------------------------------------------------------------------------------
TEST(RenderTiles, SurfacesOfTheSceneCanChange)
{
  const SampledField field(AnalyticFields::Plane{ { 0.0, 0.0, -1.0 }, -8.0 }); // value 8 - z
  OneFieldScene scene = NewSceneFromAbove();
  for (const double isovalue : { 1.25, 6.75, 1.25, 3.0 })
  {
    scene.Request.Surfaces = { { isovalue, 1.0 } };
    const Frame frame = Render(scene, *field.Traced);
    EXPECT_NEAR(frame.Depths[0], (19.0 - (8.0 - isovalue)) / 30.0, 1e-7);
  }
  scene.Request.Surfaces.clear();
  EXPECT_EQ(Render(scene, *field.Traced).Depths[0], PixelWithoutDepth);
}

}
}
