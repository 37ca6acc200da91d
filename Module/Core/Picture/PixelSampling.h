// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PixelSampling_h
#define PixelSampling_h

#include "Picture/RenderTiles.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The number of rays of a picture: one for a square of pixels, or a square of rays for one pixel.
struct PixelSampling
{
  /// The edge of the square of pixels that share a ray; at least 1.
  int Pixels = 1;
  /// The edge of the square of rays for each pixel; at least 1, and 1 if pixels share rays.
  int Rays = 1;

  /// The sampling whose rays are about so many pixels apart.
  static PixelSampling FromDistance(double distance)
  {
    return distance >= 1.0 ? PixelSampling{ static_cast<int>(std::lround(distance)), 1 }
                           : PixelSampling{ 1, static_cast<int>(std::lround(1.0 / distance)) };
  }

  /// So many pixels, in rays; not a whole number if the last ray reaches beyond them.
  double ToRays(int pixels) const
  {
    return static_cast<double>(pixels) * this->Rays / this->Pixels;
  }

  /// The rectangle of pixels that one of rays covers, which begins and ends with whole pixels.
  PixelRectangle ToPixels(const PixelRectangle& rays) const
  {
    const auto scale = [this](int ray) { return ray * this->Pixels / this->Rays; };
    return { scale(rays.X), scale(rays.Y), scale(rays.Width), scale(rays.Height) };
  }

  /// A rectangle of rays made larger until it begins and ends with whole pixels.
  PixelRectangle Align(const PixelRectangle& rays) const
  {
    const int n = this->Rays;
    const int x = rays.X / n * n;
    const int y = rays.Y / n * n;
    return { x, y, (rays.X + rays.Width - x + n - 1) / n * n,
      (rays.Y + rays.Height - y + n - 1) / n * n };
  }
};

/// The depth for each ray of a rectangle, which goes through the middle of its pixels, out of the
/// depths of a rectangle of pixels that begins where the rays do.
inline std::vector<float> TakeAtRays(const PixelSampling& sampling, const PixelRectangle& rays,
  const std::vector<float>& depths, const PixelRectangle& pixels)
{
  const int middle = sampling.Pixels / 2;
  std::vector<float> result;
  for (int y = 0; y < rays.Height; ++y)
  {
    for (int x = 0; x < rays.Width; ++x)
    {
      const int column = std::min(x * sampling.Pixels / sampling.Rays + middle, pixels.Width - 1);
      const int row = std::min(y * sampling.Pixels / sampling.Rays + middle, pixels.Height - 1);
      result.push_back(depths[Offset({ column, row, 0 }, { pixels.Width, pixels.Height, 1 })]);
    }
  }
  return result;
}

/// Makes a picture of so many rays across one of pixels, with so many rays along the edge of each:
/// their mean colour, and their least depth.
inline void AverageRays(int rays, int width, Frame& frame)
{
  const int columns = width / rays;
  const int pixels = static_cast<int>(frame.Depths.size()) / (rays * rays);
  for (int pixel = 0; pixel < pixels; ++pixel)
  {
    int sum[4] = { 0, 0, 0, 0 };
    float depth = PixelWithoutDepth;
    for (int i = 0; i < rays * rays; ++i)
    {
      const int x = pixel % columns * rays + i % rays;
      const int y = pixel / columns * rays + i / rays;
      const auto from = static_cast<std::size_t>(x + y * width);
      depth = std::min(depth, frame.Depths[from]);
      for (std::size_t channel = 0; channel < 4; ++channel)
      {
        sum[channel] += frame.Colors[4 * from + channel];
      }
    }
    // These elements are not read any more.
    const auto to = static_cast<std::size_t>(pixel);
    frame.Depths[to] = depth;
    for (std::size_t channel = 0; channel < 4; ++channel)
    {
      frame.Colors[4 * to + channel] =
        static_cast<std::uint8_t>((2 * sum[channel] + rays * rays) / (2 * rays * rays));
    }
  }
  frame.Depths.resize(static_cast<std::size_t>(pixels));
  frame.Colors.resize(4 * frame.Depths.size());
}

/// The same where colours have no mean: the colour of the nearest of the rays that have one.
inline void TakeNearestRays(int rays, int width, Frame& frame)
{
  const int columns = width / rays;
  const int pixels = static_cast<int>(frame.Depths.size()) / (rays * rays);
  for (int pixel = 0; pixel < pixels; ++pixel)
  {
    const auto corner =
      static_cast<std::size_t>(pixel % columns * rays + pixel / columns * rays * width);
    std::size_t nearest = corner;
    for (int i = 1; i < rays * rays; ++i)
    {
      const std::size_t ray = corner + static_cast<std::size_t>(i % rays + i / rays * width);
      const bool isFirst = frame.Colors[4 * nearest + 3] == 0;
      if (frame.Colors[4 * ray + 3] != 0 && (isFirst || frame.Depths[ray] < frame.Depths[nearest]))
      {
        nearest = ray;
      }
    }
    const auto to = static_cast<std::size_t>(pixel);
    frame.Depths[to] = frame.Depths[nearest];
    std::copy_n(frame.Colors.begin() + static_cast<std::ptrdiff_t>(4 * nearest), 4,
      frame.Colors.begin() + static_cast<std::ptrdiff_t>(4 * to));
  }
  frame.Depths.resize(static_cast<std::size_t>(pixels));
  frame.Colors.resize(4 * frame.Depths.size());
}

}

#endif
