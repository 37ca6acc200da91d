// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Several fields in one picture, each in an object space of its own: their hits are put in order by
// T, they hide each other and cast shadows on each other.

#include "Image/ImageField.h"
#include "Math/Matrix.h"
#include "Matrices.h"
#include "Picture/CastRays.h"
#include "Picture/RenderTiles.h"
#include "TestVolume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int Edge = 25;
constexpr int Width = 61;
constexpr int Height = 47;

/// An image and where it stands in the world.
struct PlacedImage
{
  template <typename Function>
  PlacedImage(const Function& function, const Matrix4& worldFromObject)
    : Volume(TestVolume<float>::Of({ Edge, Edge, Edge }, function))
    , Field(ImageField::New(this->Volume.View(), {}, 1))
    , WorldFromObject(worldFromObject)
  {
  }

  void Select(double opacity)
  {
    TraceRequest request;
    request.Surfaces = { { 0.0, opacity } };
    this->Field->Select(request, {});
  }

  /// Selects it behind a plane of the world, with caps.
  void Select(double opacity, const Vector3& normal, double offset)
  {
    TraceRequest request;
    request.Surfaces = { { 0.0, opacity } };
    const Vector3 first = TransformPoint(this->WorldFromObject, { 0.0, 0.0, 0.0 });
    request.Visible.HalfSpaces = { { TransposeTransformDirection(this->WorldFromObject, normal),
      Dot(normal, first) + offset, true } };
    this->Field->Select(request, {});
  }

  TestVolume<float> Volume;
  std::unique_ptr<ImageField> Field;
  Matrix4 WorldFromObject;
};

/// Two spheres of about 8 about (0, 0, 0) and (5, 1, 3) in the world, on different lattices.
struct TwoSpheres
{
  TwoSpheres()
    : A(AnalyticFields::Sphere{ { 12.0, 12.0, 12.0 }, 8.0 }, Translation({ -12.0, -12.0, -12.0 }))
    , B(AnalyticFields::Sphere{ { 12.3, 11.9, 12.1 }, 10.0 },
        Multiply(Translation({ 5.0, 1.0, 3.0 }),
          Multiply(Rotation(0.7, 0.4),
            Multiply(Scaling({ 0.8, 0.8, 0.8 }), Translation({ -12.3, -11.9, -12.1 })))))
  {
  }

  PlacedImage A;
  PlacedImage B;
};

SceneField Show(const PlacedImage& image, const Vector3& color)
{
  SceneField field;
  field.Field = image.Field.get();
  const Matrix4 clipFromObject = Multiply(Perspective(10.0, 100.0, 0.6),
    Multiply(Invert(Translation({ 1.0, 2.0, 40.0 })), image.WorldFromObject));
  field.View = Camera(clipFromObject, Invert(clipFromObject), image.WorldFromObject, Width, Height);
  field.Colors = { color };
  field.Surface.Shade = false;
  return field;
}

Frame Render(const std::vector<SceneField>& fields, const Scene& settings = {},
  const Execution& execution = {})
{
  Scene scene = settings;
  scene.Fields = fields;
  scene.Pixels = { 0, 0, Width, Height };
  scene.KeepHits = true;
  Frame frame;
  FrameTimes times;
  EXPECT_TRUE(RenderTiles(scene, execution, frame, times, [](double) { return true; }));
  return frame;
}

/// The rays through all pixels, in the object space of a field.
std::vector<CastRay> MakeRays(const SceneField& field)
{
  std::vector<CastRay> rays;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const Camera::PixelRay ray = field.View.GetRay(x, y, 1.0);
      rays.push_back({ ray.Origin, ray.Direction, 0.0, ray.End });
    }
  }
  return rays;
}

/// The T of the hits of the ray through each pixel.
std::vector<std::vector<double>> FindHits(const SceneField& field)
{
  const std::vector<CastRay> rays = MakeRays(field);
  const RayHits hits = CastRays(*field.Field, rays, 1);
  std::vector<std::vector<double>> ts(rays.size());
  for (std::size_t ray = 0; ray < rays.size(); ++ray)
  {
    for (std::size_t i = hits.First[ray]; i < hits.First[ray + 1]; ++i)
    {
      ts[ray].push_back(hits.Hits[i].T);
    }
  }
  return ts;
}

constexpr Vector3 Red = { 1.0, 0.1, 0.0 };
constexpr Vector3 Green = { 0.0, 0.9, 0.2 };

//------------------------------------------------------------------------------
TEST(ScenesOfFields, AFieldWithoutHitsChangesNoBit)
{
  TwoSpheres spheres;
  for (const double opacity : { 1.0, 0.4 })
  {
    spheres.A.Select(opacity);
    TraceRequest nothing;
    nothing.Surfaces = { { 1e6, 1.0 } };
    spheres.B.Field->Select(nothing, {});
    SceneField shown = Show(spheres.A, Red);
    shown.Surface.Shade = true;
    Scene lit;
    lit.Lights = { Light() };
    const Frame alone = Render({ shown }, lit);
    const Frame together = Render({ shown, Show(spheres.B, Green) }, lit);
    const Frame swapped = Render({ Show(spheres.B, Green), shown }, lit);
    const auto covered = std::count_if(alone.Hits.begin(), alone.Hits.end(),
      [](const Hit& hit) { return hit.Surface != Hit::NoSurface; });
    EXPECT_GT(covered, 100);
    EXPECT_EQ(alone.Colors, together.Colors);
    EXPECT_EQ(alone.Depths, together.Depths);
    EXPECT_EQ(alone.Colors, swapped.Colors);
    EXPECT_EQ(alone.Depths, swapped.Depths);
  }
}

//------------------------------------------------------------------------------
TEST(ScenesOfFields, RaysAreMadeForThePixelsOfAFieldAlone)
{
  TwoSpheres spheres;
  spheres.A.Select(1.0);
  const Frame whole = Render({ Show(spheres.A, Red) });
  SceneField part = Show(spheres.A, Red);
  part.Pixels = { 0, 0, Width / 2, Height };
  const Scene scene;
  const Frame left = Render({ part });
  int covered = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const auto pixel = static_cast<std::size_t>(y * Width + x);
      const bool isHit = left.Hits[pixel].Surface != Hit::NoSurface;
      covered += isHit ? 1 : 0;
      if (x < Width / 2)
      {
        ASSERT_EQ(left.Depths[pixel], whole.Depths[pixel]);
      }
      else if (x >= Width / 2 + scene.TileWidth)
      {
        ASSERT_FALSE(isHit) << x;
      }
    }
  }
  EXPECT_GT(covered, 100);
}

//------------------------------------------------------------------------------
TEST(ScenesOfFields, OpaqueFieldsHideEachOther)
{
  TwoSpheres spheres;
  spheres.A.Select(1.0);
  spheres.B.Select(1.0);
  const SceneField a = Show(spheres.A, Red);
  const SceneField b = Show(spheres.B, Green);
  const Frame ofA = Render({ a });
  const Frame ofB = Render({ b });
  for (const bool isSwapped : { false, true })
  {
    const Frame both = isSwapped ? Render({ b, a }) : Render({ a, b });
    int nearer[2] = { 0, 0 };
    for (std::size_t pixel = 0; pixel < both.Depths.size(); ++pixel)
    {
      const bool isB = ofB.Depths[pixel] < ofA.Depths[pixel];
      const Frame& expected = isB ? ofB : ofA;
      ASSERT_EQ(both.Depths[pixel], expected.Depths[pixel]);
      ASSERT_TRUE(std::equal(
        &both.Colors[4 * pixel], &both.Colors[4 * pixel] + 4, &expected.Colors[4 * pixel]));
      ASSERT_EQ(both.Hits[pixel].Surface, expected.Hits[pixel].Surface);
      if (both.Hits[pixel].Surface != Hit::NoSurface)
      {
        ASSERT_EQ(both.Hits[pixel].Field, isB != isSwapped ? 1 : 0);
        ++nearer[isB ? 1 : 0];
      }
    }
    EXPECT_GT(nearer[0], 50);
    EXPECT_GT(nearer[1], 50);
  }
}

//------------------------------------------------------------------------------
TEST(ScenesOfFields, TranslucentFieldsAreCompositedInOrderAlongTheRay)
{
  TwoSpheres spheres;
  spheres.A.Select(0.5);
  spheres.B.Select(0.3);
  const SceneField a = Show(spheres.A, Red);
  const SceneField b = Show(spheres.B, Green);
  const Frame both = Render({ a, b });
  const std::vector<std::vector<double>> hitsOfA = FindHits(a);
  const std::vector<std::vector<double>> hitsOfB = FindHits(b);
  int interleaved = 0;
  for (std::size_t pixel = 0; pixel < hitsOfA.size(); ++pixel)
  {
    struct Layer
    {
      double T;
      Vector3 Color;
      double Opacity;
    };
    std::vector<Layer> layers;
    for (const double t : hitsOfA[pixel])
    {
      layers.push_back({ t, Red, 0.5 });
    }
    for (const double t : hitsOfB[pixel])
    {
      layers.push_back({ t, Green, 0.3 });
    }
    std::sort(
      layers.begin(), layers.end(), [](const Layer& x, const Layer& y) { return x.T > y.T; });
    interleaved += layers.size() == 4 && layers[0].Opacity != layers[1].Opacity &&
        layers[1].Opacity != layers[2].Opacity
      ? 1
      : 0;
    Vector3 expected = { 0.0, 0.0, 0.0 };
    for (const Layer& layer : layers)
    {
      expected = layer.Color * layer.Opacity + expected * (1.0 - layer.Opacity);
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      ASSERT_NEAR(both.Colors[4 * pixel + k], 255.0 * expected[k], 0.5 + 1e-6);
    }
  }
  EXPECT_GT(interleaved, 20);
}

//------------------------------------------------------------------------------
/// So that another process can composite them with its own.
TEST(ScenesOfFields, KeptFragmentsMakeThePicture)
{
  TwoSpheres spheres;
  for (const double opacity : { 1.0, 0.4, 0.98 })
  {
    spheres.A.Select(opacity);
    spheres.B.Select(0.4);
    const std::vector<SceneField> fields = { Show(spheres.A, Red), Show(spheres.B, Green) };
    const Frame expected = Render(fields);
    EXPECT_TRUE(expected.Fragments.empty());
    Scene keeping;
    keeping.KeepFragments = true;
    for (const int threads : { 1, 3 })
    {
      const Frame kept = Render(fields, keeping, { threads });
      EXPECT_EQ(kept.Colors, expected.Colors);
      std::vector<std::vector<Fragment>> ofPixels(kept.Depths.size());
      for (const FragmentOfPixel& fragment : kept.Fragments)
      {
        ofPixels[fragment.Pixel].push_back(fragment.Own);
      }
      for (std::size_t i = 0; i < ofPixels.size(); ++i)
      {
        const std::vector<Fragment>& fragments = ofPixels[i];
        EXPECT_TRUE(std::is_sorted(fragments.begin(), fragments.end(),
          [](const Fragment& a, const Fragment& b) { return a.T < b.T; }));
        const CompositedPixel pixel = Composite(fragments.data(), fragments.size());
        EXPECT_TRUE(std::equal(pixel.Rgba, pixel.Rgba + 4, &expected.Colors[4 * i]));
        EXPECT_EQ(pixel.Depth, expected.Depths[i]);
        // Nothing is kept behind what lets no light through.
        for (std::size_t k = 0; k + 1 < fragments.size(); ++k)
        {
          EXPECT_LT(fragments[k].Opacity, 1.0);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Rays are cast through fields that share an object space.
TEST(ScenesOfFields, RaysHaveTheHitsOfAllFieldsInOrder)
{
  PlacedImage one(AnalyticFields::Sphere{ { 12.0, 12.0, 12.0 }, 8.0 }, Translation({}));
  PlacedImage other(AnalyticFields::Sphere{ { 14.0, 13.0, 15.0 }, 7.0 }, Translation({}));
  const std::vector<CastRay> rays = MakeRays(Show(one, Red));
  for (const double opacity : { 0.4, 0.98, 1.0 })
  {
    one.Select(opacity);
    other.Select(0.3);
    const RayHits ofOne = CastRays(*one.Field, rays, 1);
    const RayHits ofOther = CastRays(*other.Field, rays, 1);
    const RayHits both = CastRays({ one.Field.get(), other.Field.get() }, { rays, rays }, 2);
    int interleaved = 0;
    int dropped = 0;
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
    {
      std::vector<Hit> expected(
        &ofOne.Hits[ofOne.First[ray]], &ofOne.Hits[0] + ofOne.First[ray + 1]);
      for (std::size_t i = ofOther.First[ray]; i < ofOther.First[ray + 1]; ++i)
      {
        expected.push_back(ofOther.Hits[i]);
        expected.back().Field = 1;
      }
      std::sort(
        expected.begin(), expected.end(), [](const Hit& a, const Hit& b) { return a.T < b.T; });
      double transmittance = 1.0;
      std::size_t next = both.First[ray];
      for (const Hit& hit : expected)
      {
        if (transmittance < 1.0 / 1024.0)
        {
          ++dropped;
          continue;
        }
        ASSERT_LT(next, both.First[ray + 1]);
        // A ray that ends at an opaque hit of one field is a shorter ray in the other.
        ASSERT_NEAR(both.Hits[next].T, hit.T, 1e-12 * hit.T);
        ASSERT_EQ(both.Hits[next].Field, hit.Field);
        interleaved += next > both.First[ray] && hit.Field != both.Hits[next - 1].Field ? 1 : 0;
        transmittance *= hit.Field == 0 ? 1.0 - opacity : 0.7;
        ++next;
      }
      ASSERT_EQ(next, both.First[ray + 1]);
    }
    EXPECT_GT(interleaved, 100);
    EXPECT_EQ(dropped > 0, opacity > 0.9);
  }
}

//------------------------------------------------------------------------------
/// Shows hits, and caps, by one colour.
class OneColor final : public HitColors
{
public:
  explicit OneColor(const Vector3& color)
    : Color(color)
  {
  }
  Vector3 Get(const Hit& /*hit*/) const override { return this->Color; }

private:
  Vector3 Color;
};

/// Whatever the rounding of each field.
TEST(ScenesOfFields, OfCapsInOnePlaneThatOfTheFirstFieldIsInFront)
{
  TwoSpheres spheres;
  for (const double opacity : { 1.0, 0.4 })
  {
    for (PlacedImage* image : { &spheres.A, &spheres.B })
    {
      image->Select(opacity, { 0.3, 0.2, -1.0 }, 0.7);
    }
    const OneColor red(Red);
    const OneColor green(Green);
    SceneField a = Show(spheres.A, Red);
    SceneField b = Show(spheres.B, Green);
    a.ColorsOfHits = &red;
    b.ColorsOfHits = &green;
    const std::vector<std::vector<double>> hits[] = { FindHits(a), FindHits(b) };
    const Frame frames[] = { Render({ a, b }), Render({ b, a }) };
    const RayHits cast[] = {
      CastRays({ a.Field, b.Field }, { MakeRays(a), MakeRays(b) }, 1),
      CastRays({ b.Field, a.Field }, { MakeRays(b), MakeRays(a) }, 1),
    };
    int inBoth = 0;
    for (std::size_t pixel = 0; pixel < hits[0].size(); ++pixel)
    {
      const bool areCaps = !hits[0][pixel].empty() && !hits[1][pixel].empty() &&
        std::abs(hits[0][pixel][0] - hits[1][pixel][0]) < 1e-9 * hits[0][pixel][0];
      for (std::size_t order = 0; areCaps && order < 2; ++order)
      {
        const Hit& first = cast[order].Hits[cast[order].First[pixel]];
        ++inBoth;
        ASSERT_EQ(first.Plane, 0);
        ASSERT_EQ(first.Field, 0);
        ASSERT_EQ(frames[order].Hits[pixel].Field, 0);
        const bool isRed = frames[order].Colors[4 * pixel] > frames[order].Colors[4 * pixel + 1];
        ASSERT_EQ(isRed, order == 0);
      }
    }
    EXPECT_GT(inBoth, 200);
  }
}

//------------------------------------------------------------------------------
/// Whatever the rounding of each field, and whichever is opaque.
TEST(ScenesOfFields, OfSurfacesAtOnePlaceThatOfTheFirstFieldIsInFront)
{
  PlacedImage a(
    AnalyticFields::Sphere{ { 12.0, 12.0, 12.0 }, 8.0 }, Translation({ -12.0, -12.0, -12.0 }));
  // Its values are the same; a turn and back leaves rounding.
  PlacedImage b(AnalyticFields::Sphere{ { 12.0, 12.0, 12.0 }, 8.0 },
    Multiply(
      Rotation(-0.7, 0.0), Multiply(Rotation(0.7, 0.0), Translation({ -12.0, -12.0, -12.0 }))));
  for (const double opacityOfA : { 1.0, 0.4 })
  {
    for (const double opacityOfB : { 1.0, 0.4 })
    {
      a.Select(opacityOfA);
      b.Select(opacityOfB);
      const SceneField shown[] = { Show(a, Red), Show(b, Green) };
      for (const std::size_t first : { 0U, 1U })
      {
        const SceneField& front = shown[first];
        const SceneField& back = shown[1 - first];
        const Frame frame = Render({ front, back });
        const RayHits cast =
          CastRays({ front.Field, back.Field }, { MakeRays(front), MakeRays(back) }, 1);
        int found = 0;
        for (std::size_t ray = 0; ray < frame.Hits.size(); ++ray)
        {
          int next = 0;
          for (std::size_t i = cast.First[ray]; i < cast.First[ray + 1]; ++i, ++found)
          {
            ASSERT_EQ(cast.Hits[i].Field, next) << ray;
            const bool isHidden = front.Field->GetRequest().Surfaces[0].Opacity >= 1.0;
            next = isHidden ? 0 : 1 - next;
          }
          ASSERT_EQ(frame.Hits[ray].Field, 0);
        }
        EXPECT_GT(found, 200);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// A floor, and a sphere above it on another lattice, under a light from straight above.
TEST(ScenesOfFields, AFieldCastsItsShadowOnAnother)
{
  PlacedImage floor([](const AnalyticFields::Point& p) { return 8.0 - p[1]; },
    Translation({ -12.0, -20.0, -12.0 })); // y = -12 in the world, inside below
  PlacedImage sphere(AnalyticFields::Sphere{ { 12.0, 12.0, 12.0 }, 8.0 },
    Multiply(Scaling({ 0.5, 0.5, 0.5 }), Translation({ -12.0, -12.0, -12.0 }))); // radius 4
  floor.Select(1.0);
  sphere.Select(1.0);
  SceneField shownFloor = Show(floor, Red);
  shownFloor.Surface = { true, 0.0, 1.0, 0.0, 1.0 };
  SceneField shownSphere = Show(sphere, Green);
  shownSphere.Surface = shownFloor.Surface;
  Scene lit;
  lit.Lights = { Light() };
  lit.Lights[0].Direction = { 0.0, 1.0, 0.0 };
  lit.Shadows = true;
  const Frame frame = Render({ shownFloor, shownSphere }, lit);
  int dark = 0;
  int bright = 0;
  for (std::size_t pixel = 0; pixel < frame.Hits.size(); ++pixel)
  {
    const Hit& hit = frame.Hits[pixel];
    if (hit.Surface == Hit::NoSurface || hit.Field != 0)
    {
      continue;
    }
    const Vector3 point = TransformPoint(floor.WorldFromObject, floor.Field->GetPoint(hit));
    const double fromAxis = std::hypot(point[0], point[2]);
    if (std::abs(fromAxis - 4.0) > 0.1)
    {
      ASSERT_EQ(frame.Colors[4 * pixel], fromAxis < 4.0 ? 0 : 255) << fromAxis;
      ++(fromAxis < 4.0 ? dark : bright);
    }
  }
  EXPECT_GT(dark, 20);
  EXPECT_GT(bright, 50);
}

//------------------------------------------------------------------------------
/// Shows values by a grey of their own, half transparent.
class Greys final : public ValueColors
{
public:
  std::array<double, 4> Get(double value) const override
  {
    const double grey = 0.5 + 0.05 * value;
    return { grey, grey, grey, 0.5 };
  }
};

TEST(ScenesOfFields, ProjectionsEndAtSurfacesInAnyOrder)
{
  TwoSpheres spheres;
  spheres.A.Select(1.0);
  TraceRequest largest;
  largest.Projection = Extremum::Largest;
  spheres.B.Field->Select(largest, {});
  const Greys greys;
  SceneField a = Show(spheres.A, Red);
  a.Surface.Shade = true;
  SceneField b = Show(spheres.B, Green);
  b.ColorsOfValues = &greys;
  Scene lit;
  lit.Lights = { Light() };
  lit.Shadows = true;
  lit.OcclusionRays = 4;
  const Frame first = Render({ a, b }, lit);
  const Frame second = Render({ b, a }, lit);
  EXPECT_EQ(first.Colors, second.Colors);
  EXPECT_EQ(first.Depths, second.Depths);
  // The projection is there, before the surface and beside it, and a projection casts no shadow.
  const Frame surface = Render({ a }, lit);
  int before = 0;
  int beside = 0;
  for (std::size_t pixel = 0; pixel < first.Depths.size(); ++pixel)
  {
    const bool isOther = !std::equal(
      &first.Colors[4 * pixel], &first.Colors[4 * pixel] + 4, &surface.Colors[4 * pixel]);
    const bool isSurface = surface.Depths[pixel] != PixelWithoutDepth;
    EXPECT_EQ(first.Depths[pixel], surface.Depths[pixel]);
    before += isOther && isSurface ? 1 : 0;
    beside += isOther && !isSurface ? 1 : 0;
  }
  EXPECT_GT(before, 20);
  EXPECT_GT(beside, 100);
}

//------------------------------------------------------------------------------
TEST(ScenesOfFields, CoincidingSurfacesDoNotShadowEachOther)
{
  PlacedImage one(
    AnalyticFields::Sphere{ { 12.0, 12.0, 12.0 }, 8.0 }, Translation({ -12.0, -12.0, -12.0 }));
  PlacedImage other(
    AnalyticFields::Sphere{ { 12.0, 12.0, 12.0 }, 8.0 }, Translation({ -12.0, -12.0, -12.0 }));
  one.Select(1.0);
  other.Select(1.0);
  SceneField shown = Show(one, Red);
  SceneField shownToo = Show(other, Red);
  shown.Surface = { true, 0.0, 1.0, 0.0, 1.0 };
  shownToo.Surface = shown.Surface;
  Scene lit;
  lit.Lights = { Light() };
  lit.Lights[0].Direction = { 0.6, 0.0, 0.8 };
  lit.Shadows = true;
  const Frame alone = Render({ shown }, lit);
  const Frame both = Render({ shown, shownToo }, lit);
  int darker = 0;
  int bright = 0;
  for (std::size_t i = 0; i < alone.Colors.size(); i += 4)
  {
    bright += alone.Colors[i] > 60 ? 1 : 0;
    darker += both.Colors[i] + 10 < alone.Colors[i] ? 1 : 0;
  }
  EXPECT_GT(bright, 200);
  EXPECT_EQ(darker, 0);
}

}
}
