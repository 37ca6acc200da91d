// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Fewer rays than pixels where time is short, more where edges are to be smooth.

#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

using namespace MapperTesting;

namespace
{

/// Sets a fixed distance between rays.
void SetDistance(Scene& scene, double distance)
{
  scene.Mapper->AutoAdjustSampleDistancesOff();
  scene.Mapper->SetImageSampleDistance(static_cast<float>(distance));
}

/// What linear interpolation between the middles of squares of pixels gives in a picture.
class BetweenRays
{
public:
  BetweenRays(const Picture& picture, int width, int height, int distance)
    : ThePicture(picture)
    , Width(width)
    , Height(height)
    , Distance(distance)
  {
  }

  /// Whether there is a pixel in the middle of each square around.
  bool HasAll(int x, int y) const
  {
    return this->Middle(this->First(x) + 1) < this->Width &&
      this->Middle(this->First(y) + 1) < this->Height;
  }

  double Get(int x, int y, int channel) const
  {
    double sum = 0.0;
    for (const int up : { 0, 1 })
    {
      for (const int right : { 0, 1 })
      {
        const int column = this->Middle(std::max(this->First(x) + right, 0));
        const int row = this->Middle(std::max(this->First(y) + up, 0));
        sum += this->Weight(x, right) * this->Weight(y, up) *
          this->ThePicture[static_cast<std::size_t>(3 * (column + row * this->Width) + channel)];
      }
    }
    return sum;
  }

private:
  /// Where a pixel is, in squares; whole numbers are middles.
  double Place(int pixel) const { return (pixel + 0.5) / this->Distance - 0.5; }
  int First(int pixel) const { return static_cast<int>(std::floor(this->Place(pixel))); }
  int Middle(int square) const { return square * this->Distance + this->Distance / 2; }
  double Weight(int pixel, int second) const
  {
    const double weight = this->Place(pixel) - this->First(pixel);
    return second == 1 ? weight : 1.0 - weight;
  }

  const Picture& ThePicture;
  int Width;
  int Height;
  int Distance;
};

/// Rays of several pixels each show what the pixels in their middle show with rays of their own.
/// Between them colours are interpolated, and depths are those of the nearest ray; at the right and
/// upper border too, in windows of any size.
void CheckCoarse(Checks& check)
{
  const auto image = NewBall(33, 0.9);
  for (const int size : { 159, 160, 161 })
  {
    for (const int distance : { 3, 5 })
    {
      Scene scene(image, size, size - 7);
      scene.LookFrom(0.0, -1.0, 0.0);
      scene.Renderer->GetActiveCamera()->Zoom(1.5);
      scene.Window->Render();
      const Picture fine = Capture(scene.Window);
      const DepthPicture fineDepths(scene.Window, scene.Renderer);
      SetDistance(scene, distance);
      const Picture coarse = RenderAndCapture(scene.Window);
      const DepthPicture depths(scene.Window, scene.Renderer);
      const int width = fineDepths.GetWidth();
      const BetweenRays expected(fine, width, fineDepths.GetHeight(), distance);
      int wrong = 0;
      int pixels = 0;
      for (int y = 0; y < fineDepths.GetHeight(); ++y)
      {
        for (int x = 0; x < width; ++x)
        {
          if (!expected.HasAll(x, y))
          {
            continue;
          }
          ++pixels;
          for (int channel = 0; channel < 3; ++channel)
          {
            const int color = coarse[static_cast<std::size_t>(3 * (x + y * width) + channel)];
            wrong += std::abs(color - expected.Get(x, y, channel)) > 2.0 ? 1 : 0;
          }
          const int middleX = x / distance * distance + distance / 2;
          const int middleY = y / distance * distance + distance / 2;
          wrong += std::abs(depths.GetDepth(x, y) - fineDepths.GetDepth(middleX, middleY)) > 1e-6;
        }
      }
      check.That(pixels > 20000, "pixels are compared");
      check.Equal(wrong, 0,
        "the number of wrong pixels at distance " + std::to_string(distance) + " in a window of " +
          std::to_string(size));
    }
  }
}

/// What is before the surface stays before it, what is behind is hidden, with any number of rays.
void CheckDepth(Checks& check)
{
  const auto image = NewBall(33, 0.7);
  Scene scene(image, 200, 200);
  const auto sphere = NewSphere(0.4, { 0.5, -0.6, 0.3 });
  scene.Renderer->AddActor(sphere);
  const Picture whole = RenderAndCapture(scene.Window);
  for (const double distance : { 2.0, 4.0, 0.5 })
  {
    SetDistance(scene, distance);
    const double difference = GetDifference(RenderAndCapture(scene.Window), whole, 40);
    check.That(difference < 0.04,
      "at distance " + std::to_string(distance) +
        " the picture is much the same: " + std::to_string(difference));
  }
}

/// In a coarse picture, too, each pixel shows a sphere or an opaque surface, whichever is nearer;
/// a translucent one ends there at the sphere, to within the distance of rays.
void CheckOccluder(Checks& check, double opacity)
{
  constexpr int distance = 5;
  constexpr int size = 200;
  Scene scene(NewBall(33, 0.7), size, size);
  scene.LookFrom(0.0, -1.0, 0.0);
  const auto sphere = NewSphere(0.4, { 0.5, -0.4, 0.3 });
  scene.Renderer->AddActor(sphere);
  scene.Renderer->ResetCameraClippingRange();
  scene.Volume->VisibilityOff();
  const Picture ofSphere = RenderAndCapture(scene.Window);
  const DepthPicture sphereDepths(scene.Window, scene.Renderer);
  scene.Volume->VisibilityOn();
  sphere->VisibilityOff();
  const DepthPicture surfaceDepths = [&]
  {
    scene.Window->Render();
    return DepthPicture(scene.Window, scene.Renderer);
  }();
  scene.SetSurface(0.0, { 0.9, 0.8, 0.7 }, opacity);
  SetDistance(scene, distance);
  const Picture ofSurface = RenderAndCapture(scene.Window);
  sphere->VisibilityOn();
  const Picture both = RenderAndCapture(scene.Window);

  // Which is nearer is the same in all pixels whose rays count.
  const auto isAround = [&](int x, int y, const auto& isSo)
  {
    const int reach = opacity < 1.0 ? 2 * distance : 1;
    for (int j = y - reach; j <= y + reach; ++j)
    {
      for (int i = x - reach; i <= x + reach; ++i)
      {
        if (i < 0 || j < 0 || i >= size || j >= size || !isSo(i, j))
        {
          return false;
        }
      }
    }
    return true;
  };
  // Interpolated depths of a ball are nearly its own.
  constexpr double margin = 0.001;
  int wrong = 0;
  int spheres = 0;
  int surfaces = 0;
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const bool isSphere = isAround(x, y,
        [&](int i, int j)
        { return sphereDepths.GetDepth(i, j) + margin < surfaceDepths.GetDepth(i, j); });
      const bool isSurface = isAround(x, y,
        [&](int i, int j)
        { return surfaceDepths.GetDepth(i, j) + margin < sphereDepths.GetDepth(i, j); });
      spheres += isSphere ? 1 : 0;
      surfaces += isSurface && !sphereDepths.IsEmpty(x, y) ? 1 : 0;
      const auto here = static_cast<std::size_t>(3 * (x + y * size));
      for (std::size_t channel = here; channel < here + 3; ++channel)
      {
        wrong += isSphere && std::abs(both[channel] - ofSphere[channel]) > 1;
        wrong += opacity >= 1.0 && isSurface && std::abs(both[channel] - ofSurface[channel]) > 1;
      }
    }
  }
  check.That(spheres > 500, "the sphere is seen: " + std::to_string(spheres));
  check.That(
    opacity < 1.0 || surfaces > 100, "the surface hides the sphere: " + std::to_string(surfaces));
  check.Equal(wrong, 0,
    "the number of wrong pixels behind and before a sphere, at opacity " + std::to_string(opacity));
}

/// Several rays for a pixel are those of a larger window: their mean colour, and their least depth.
void CheckMean(Checks& check)
{
  const auto image = NewBall(33, 0.7);
  Scene large(image, 200, 200);
  const Picture fine = RenderAndCapture(large.Window);
  const DepthPicture fineDepths(large.Window, large.Renderer);
  Scene small(image, 100, 100);
  SetDistance(small, 0.5);
  const Picture mean = RenderAndCapture(small.Window);
  const DepthPicture depths(small.Window, small.Renderer);
  int wrong = 0;
  for (int y = 0; y < 100; ++y)
  {
    for (int x = 0; x < 100; ++x)
    {
      double least = 1.0;
      int sums[3] = { 0, 0, 0 };
      for (int ray = 0; ray < 4; ++ray)
      {
        const int column = 2 * x + ray % 2;
        const int row = 2 * y + ray / 2;
        least = std::min(least, fineDepths.GetDepth(column, row));
        for (int channel = 0; channel < 3; ++channel)
        {
          sums[channel] += fine[static_cast<std::size_t>(3 * (column + row * 200) + channel)];
        }
      }
      wrong += std::abs(depths.GetDepth(x, y) - least) > 1e-6 ? 1 : 0;
      for (int channel = 0; channel < 3; ++channel)
      {
        const int color = mean[static_cast<std::size_t>(3 * (x + y * 100) + channel)];
        wrong += std::abs(4 * color - sums[channel]) > 8 ? 1 : 0;
      }
    }
  }
  check.Equal(wrong, 0, "the number of pixels that are not the mean of a larger window");
}

/// Several rays for a pixel are its mean: at the edge of a ball as much colour as it is covered.
void CheckSmooth(Checks& check)
{
  Scene scene(NewBall(65, 0.7), 160, 160);
  scene.Property()->ShadeOff();
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 1.0);
  scene.Renderer->SetBackground(0.0, 0.0, 0.0);
  const Picture hard = RenderAndCapture(scene.Window);
  SetDistance(scene, 0.25);
  const Picture soft = RenderAndCapture(scene.Window);
  double hardSum = 0.0;
  double softSum = 0.0;
  int greys = 0;
  for (std::size_t i = 0; i < hard.size(); i += 3)
  {
    hardSum += hard[i] / 255.0;
    softSum += soft[i] / 255.0;
    greys += soft[i] > 0 && soft[i] < 255 ? 1 : 0;
    check.That(hard[i] == 0 || hard[i] == 255, "a pixel with one ray is black or white");
  }
  check.That(greys > 100, "the edge is grey: " + std::to_string(greys));
  check.Near(softSum / hardSum, 1.0, 0.003, "the area of the ball");
}

/// While interacting, pictures become coarse, and fine again when the scene is still.
void CheckHurry(Checks& check)
{
  Scene scene(NewBall(65, 0.7), 300, 300);
  const Picture still = RenderAndCapture(scene.Window);
  check.Equal(scene.Mapper->GetImageSampleDistance(), 1.0F, "the distance when there is time");
  scene.Window->SetDesiredUpdateRate(100000.0);
  scene.Window->Render();
  check.Equal(scene.Mapper->GetImageSampleDistance(), 10.0F, "the distance while interacting");
  scene.Mapper->SetMaximumImageSampleDistance(3.0F);
  scene.Window->Render();
  check.Equal(scene.Mapper->GetImageSampleDistance(), 3.0F, "the largest distance allowed");
  scene.Window->SetDesiredUpdateRate(0.0001);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), still, 0), 0.0,
    "the difference of a picture that had time");
  scene.Mapper->SetMinimumImageSampleDistance(0.5F);
  scene.Window->Render();
  check.Equal(
    scene.Mapper->GetImageSampleDistance(), 0.5F, "the distance with time for smooth edges");
  scene.Window->SetDesiredUpdateRate(100000.0);
  SetDistance(scene, 1.0);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), still, 0), 0.0,
    "the difference of a picture while interacting with the distance held");
}

/// While interacting, first there are fewer rays of ambient occlusion, then fewer of pixels.
void CheckOcclusionInHurry(Checks& check)
{
  constexpr double hurry = 100000.0;
  constexpr double rest = 0.0001;
  Scene scene(NewCube(65, AnalyticFields::Gyroid{ 1.0 }), 100, 100);
  scene.Property()->SetAmbient(0.5);
  scene.Mapper->AmbientOcclusionOn();
  const auto render = [&scene](int rays, double rate)
  {
    scene.Mapper->SetNumberOfAmbientOcclusionRays(rays);
    scene.Window->SetDesiredUpdateRate(rate);
    return RenderAndCapture(scene.Window);
  };
  const Picture few = render(4, rest);
  const Picture many = render(16, rest);
  check.That(GetDifference(few, many, 0) > 0.0, "the number of occlusion rays is seen");
  // (A window with less than one frame a second is at rest.)
  const double others = scene.Mapper->GetTraceTime() + scene.Mapper->GetDisplayTime();
  const Picture some = render(16, 1.0 / (others + 0.5 * scene.Mapper->GetShadeTime()));
  check.Equal(scene.Mapper->GetImageSampleDistance(), 1.0F, "the distance with half of the rays");
  check.That(GetDifference(some, many, 0) > 0.0 && GetDifference(some, few, 0) > 0.0,
    "with half of the time there are neither all rays nor the fewest");
  scene.Mapper->SetMaximumImageSampleDistance(1.0F);
  check.Equal(GetDifference(render(16, hurry), few, 0), 0.0, "the difference of the fewest rays");
  check.Equal(scene.Mapper->GetNumberOfAmbientOcclusionRays(), 16, "the number that was set");
  check.Equal(GetDifference(render(2, hurry), render(2, rest), 0), 0.0,
    "the difference of two rays, which are not fewer while interacting");
  // Frames with fewer rays are no part of a mean.
  scene.Mapper->ProgressiveAccumulationOn();
  render(16, rest);
  render(16, hurry);
  check.Equal(GetDifference(render(16, rest), many, 0), 0.0, "the difference of a new mean");
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 1, "the number of frames in it");
  scene.Mapper->SetMaximumImageSampleDistance(10.0F);
  render(16, hurry);
  check.Equal(scene.Mapper->GetImageSampleDistance(), 10.0F, "the distance in a hurry");
}

}

int TestIsosurfaceRayTraceMapperSampling(int, char*[])
{
  Checks check;
  CheckCoarse(check);
  CheckDepth(check);
  CheckOccluder(check, 1.0);
  CheckOccluder(check, 0.6);
  CheckMean(check);
  CheckSmooth(check);
  CheckHurry(check);
  CheckOcclusionInHurry(check);
  return check.Result();
}
