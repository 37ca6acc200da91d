// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "RenderTiles.h"

#include "Shading.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>

#include <omp.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

using Clock = std::chrono::steady_clock;

double Seconds(Clock::duration duration)
{
  return std::chrono::duration<double>(duration).count();
}

/// The rays of a tile and what they hit.
struct TileRays
{
  std::vector<std::optional<Ray>> Rays;
  std::vector<Vector3> Directions;
  RayHits Hits;
};

/// The place of a pixel in the arrays of a frame.
std::size_t PixelOffset(const Scene& scene, int x, int y)
{
  return Offset({ x, y, 0 }, { scene.Pixels.Width, scene.Pixels.Height, 1 });
}

void TraceTile(const Scene& scene, TracedVolume& volume, const PixelRectangle& tile, TileRays& rays)
{
  rays.Rays.clear();
  rays.Directions.clear();
  for (int y = tile.Y; y < tile.Y + tile.Height; ++y)
  {
    for (int x = tile.X; x < tile.X + tile.Width; ++x)
    {
      const float depth = scene.Depth ? scene.Depth[PixelOffset(scene, x, y)] : 1.0F;
      const Camera::PixelRay pixel =
        scene.View.GetRay(scene.Pixels.X + x, scene.Pixels.Y + y, static_cast<double>(depth));
      rays.Rays.push_back(
        ClipToVolume(pixel.Origin, pixel.Direction, 0.0, pixel.End, volume.GetDimensions()));
      rays.Directions.push_back(pixel.Direction);
    }
  }
  volume.Trace(rays.Rays, rays.Hits);
}

std::uint8_t ToByte(double value)
{
  // What is no number, from a light without any attenuation on its own position, is black.
  return static_cast<std::uint8_t>(std::lround(255.0 * (value > 0.0 ? std::min(value, 1.0) : 0.0)));
}

/// Composites the hits of one ray, front to back.
void ShadePixel(const Scene& scene, const TracedVolume& volume, const Hit* first, const Hit* last,
  const Vector3& direction, std::uint8_t rgba[4], float& depth)
{
  Vector3 color = { 0.0, 0.0, 0.0 };
  double transmittance = 1.0;
  depth = Frame::NoSurface;
  for (const Hit* hit = first; hit != last; ++hit)
  {
    const double opacity = scene.Want.Surfaces[static_cast<std::size_t>(hit->Surface)].Opacity;
    Vector3 shaded = ShadeHit(scene, volume, *hit, direction);
    for (double& channel : shaded)
    {
      channel = std::clamp(channel, 0.0, 1.0);
    }
    color = color + shaded * (transmittance * opacity);
    transmittance *= 1.0 - opacity;
    if (opacity >= 1.0)
    {
      depth = static_cast<float>(std::clamp(scene.View.GetDepth(hit->GetPoint()), 0.0, 1.0));
    }
  }
  rgba[0] = ToByte(color[0]);
  rgba[1] = ToByte(color[1]);
  rgba[2] = ToByte(color[2]);
  rgba[3] = ToByte(1.0 - transmittance);
}

void ShadeTile(const Scene& scene, const TracedVolume& volume, const PixelRectangle& tile,
  const TileRays& rays, Frame& frame)
{
  std::size_t ray = 0;
  for (int y = tile.Y; y < tile.Y + tile.Height; ++y)
  {
    for (int x = tile.X; x < tile.X + tile.Width; ++x, ++ray)
    {
      const std::size_t pixel = PixelOffset(scene, x, y);
      const Hit* hits = rays.Hits.Hits.data();
      ShadePixel(scene, volume, hits + rays.Hits.First[ray], hits + rays.Hits.First[ray + 1],
        rays.Directions[ray], &frame.Colors[4 * pixel], frame.Depths[pixel]);
    }
  }
}

/// Tile number i of the image, in pixels from the lower left of the rectangle drawn.
PixelRectangle GetTile(const Scene& scene, int i, int tilesPerRow)
{
  const int x = i % tilesPerRow * scene.TileWidth;
  const int y = i / tilesPerRow * scene.TileHeight;
  return { x, y, std::min(scene.TileWidth, scene.Pixels.Width - x),
    std::min(scene.TileHeight, scene.Pixels.Height - y) };
}

}

//------------------------------------------------------------------------------
bool RenderTiles(const Scene& scene, TracedVolume& volume, Frame& frame, FrameTimes& times,
  const std::function<bool(double)>& keepGoing)
{
  const PixelRectangle& pixels = scene.Pixels;
  const std::size_t count = Count({ pixels.Width, pixels.Height, 1 });
  frame.Colors.resize(4 * count);
  frame.Depths.resize(count);
  volume.Select(scene.Want, scene.Threads);

  const int tilesPerRow = (pixels.Width + scene.TileWidth - 1) / scene.TileWidth;
  const int tiles = tilesPerRow * ((pixels.Height + scene.TileHeight - 1) / scene.TileHeight);
  const double brickSecondsBefore = 1e-9 * static_cast<double>(volume.GetBrickNanoseconds());
  const Clock::time_point start = Clock::now();
  double traceSeconds = 0.0;
  double shadeSeconds = 0.0;
  std::atomic<int> done{ 0 };
  std::atomic<bool> going{ true };

#pragma omp parallel num_threads(scene.Threads) reduction(+ : traceSeconds, shadeSeconds)
  {
    TileRays rays;
#pragma omp for schedule(dynamic)
    for (int i = 0; i < tiles; ++i)
    {
      // A loop of OpenMP cannot be left early: the tiles that remain are passed over.
      if (!going.load(std::memory_order_relaxed))
      {
        continue;
      }
      const PixelRectangle tile = GetTile(scene, i, tilesPerRow);
      const Clock::time_point begin = Clock::now();
      TraceTile(scene, volume, tile, rays);
      const Clock::time_point traced = Clock::now();
      ShadeTile(scene, volume, tile, rays, frame);
      traceSeconds += Seconds(traced - begin);
      shadeSeconds += Seconds(Clock::now() - traced);
      const int finished = done.fetch_add(1, std::memory_order_relaxed) + 1;
      if (omp_get_thread_num() == 0 && !keepGoing(static_cast<double>(finished) / tiles))
      {
        going.store(false, std::memory_order_relaxed);
      }
    }
  }

  const double brickSeconds =
    1e-9 * static_cast<double>(volume.GetBrickNanoseconds()) - brickSecondsBefore;
  const double threadSeconds = traceSeconds + shadeSeconds;
  const double share = threadSeconds > 0.0 ? Seconds(Clock::now() - start) / threadSeconds : 0.0;
  times.Bricks = share * brickSeconds;
  times.Trace = share * (traceSeconds - brickSeconds);
  times.Shade = share * shadeSeconds;
  return going.load();
}

}
