// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/RenderTiles.h"

#include "Math/ByteColor.h"
#include "Picture/Shader.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

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

/// The place of a pixel in the arrays of a frame.
std::size_t PixelOffset(const Scene& scene, int x, int y)
{
  return Offset({ x, y, 0 }, { scene.Pixels.Width, scene.Pixels.Height, 1 });
}

/// Makes the rays of some pixels, one after the other.
void MakeRays(
  const Scene& scene, const PixelRectangle& pixels, const Index3& dimensions, RayPacket& rays)
{
  rays.Count = 0;
  rays.Exists = {};
  for (int y = pixels.Y; y < pixels.Y + pixels.Height; ++y)
  {
    for (int x = pixels.X; x < pixels.X + pixels.Width; ++x)
    {
      const float depth = scene.Depth ? scene.Depth[PixelOffset(scene, x, y)] : 1.0F;
      const Camera::PixelRay pixel =
        scene.View.GetRay(scene.Pixels.X + x, scene.Pixels.Y + y, static_cast<double>(depth));
      AddRay(ClipToVolume(
               pixel.Origin, pixel.Direction, 0.0, pixel.End, dimensions, scene.Request.Planes),
        rays);
    }
  }
}

/// Whether a ray through some pixels may hit anything: asks for those at the corners.
bool MayHit(
  const Scene& scene, const ImageField& volume, const PixelRectangle& pixels, RayPacket& corners)
{
  corners.Count = 0;
  corners.Exists = {};
  for (const int y : { pixels.Y, pixels.Y + pixels.Height - 1 })
  {
    for (const int x : { pixels.X, pixels.X + pixels.Width - 1 })
    {
      const Camera::PixelRay pixel = scene.View.GetRay(scene.Pixels.X + x, scene.Pixels.Y + y, 1.0);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        corners.Origin[axis][corners.Count] = pixel.Origin[axis];
        corners.Direction[axis][corners.Count] = pixel.Direction[axis];
      }
      ++corners.Count;
    }
  }
  return volume.MayHitBetween(corners);
}

/// Makes the rays of some pixels and finds what they hit.
void TraceBlock(const Scene& scene, ImageField& volume, const PixelRectangle& pixels,
  RayPacket& rays, RayHits& hits)
{
  if (!MayHit(scene, volume, pixels, rays))
  {
    hits.Clear();
    return;
  }
  if (!scene.Request.BeamKernels || scene.Request.Planes)
  {
    MakeRays(scene, pixels, volume.GetDimensions(), rays);
    volume.Trace(rays, hits);
    return;
  }
  PixelBlock block;
  block.IndexFromClip = scene.View.GetIndexFromClip().data();
  block.Width = scene.View.GetWidth();
  block.Height = scene.View.GetHeight();
  block.Column = scene.Pixels.X + pixels.X;
  block.Row = scene.Pixels.Y + pixels.Y;
  block.Columns = pixels.Width;
  block.Rows = pixels.Height;
  block.Depth = scene.Depth ? scene.Depth + PixelOffset(scene, pixels.X, pixels.Y) : nullptr;
  block.DepthStride = scene.Pixels.Width;
  block.Dimensions = volume.GetDimensions().data();
  scene.Request.BeamKernels->MakeRays(block, rays);
  volume.Trace(rays, hits);
}

/// Composites the hits of one ray, front to back.
void CompositePixel(const Scene& scene, const Hit* hits, const Vector3* colors, std::size_t count,
  std::uint8_t rgba[4], float& depth)
{
  depth = Frame::NoSurface;
  std::fill_n(rgba, 4, std::uint8_t{ 0 });
  if (count == 0)
  {
    return;
  }
  Vector3 color = { 0.0, 0.0, 0.0 };
  double transmittance = 1.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double opacity =
      scene.Request.Surfaces[static_cast<std::size_t>(hits[i].Surface)].Opacity;
    Vector3 shaded = colors[i];
    for (double& channel : shaded)
    {
      channel = std::clamp(channel, 0.0, 1.0);
    }
    color = color + shaded * (transmittance * opacity);
    transmittance *= 1.0 - opacity;
    if (opacity >= 1.0)
    {
      depth = static_cast<float>(
        std::clamp(scene.View.GetDepth(hits[i].GetPoint(scene.Request.Planes)), 0.0, 1.0));
    }
  }
  rgba[0] = ToByte(color[0]);
  rgba[1] = ToByte(color[1]);
  rgba[2] = ToByte(color[2]);
  rgba[3] = ToByte(1.0 - transmittance);
}

/// Colours the extreme value of one ray, if it has one.
void ColorPixel(const Scene& scene, const Hit* hits, std::size_t count, std::uint8_t rgba[4])
{
  std::fill_n(rgba, 4, std::uint8_t{ 0 });
  if (count > 0)
  {
    const std::array<double, 4> color = scene.ColorsOfValues->Get(hits[0].Value);
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      rgba[channel] = ToByte(std::clamp(color[channel], 0.0, 1.0) * color[3]);
    }
    rgba[3] = ToByte(color[3]);
  }
}

/// Writes the hits of some pixels, where one opaque surface is all there is.
void WriteOpaque(const Scene& scene, const Shader& shader, const PixelRectangle& pixels,
  const RayPacket& rays, const RayHits& hits, Frame& frame)
{
  HitPixels made;
  shader.MakePixels(rays, hits, made);
  std::size_t ray = 0;
  std::size_t hit = 0;
  for (int y = pixels.Y; y < pixels.Y + pixels.Height; ++y)
  {
    std::size_t pixel = PixelOffset(scene, pixels.X, y);
    for (int x = 0; x < pixels.Width; ++x, ++ray, ++pixel)
    {
      const bool isHit = hits.First[ray + 1] > hit;
      const std::uint32_t color = isHit ? made.Colors[hit] : 0;
      for (std::size_t k = 0; k < 4; ++k)
      {
        frame.Colors[4 * pixel + k] = static_cast<std::uint8_t>(color >> (8 * k));
      }
      frame.Depths[pixel] = isHit ? made.Depths[hit] : Frame::NoSurface;
      if (scene.KeepHits && isHit)
      {
        frame.Hits[pixel] = hits.Hits[hit];
      }
      hit += isHit ? 1 : 0;
    }
  }
}

void ShadeBlock(const Scene& scene, const Shader& shader, const PixelRectangle& pixels,
  const RayPacket& rays, const RayHits& hits, std::vector<Vector3>& colors, Frame& frame)
{
  if (hits.Hits.empty())
  {
    for (int y = pixels.Y; y < pixels.Y + pixels.Height; ++y)
    {
      const std::size_t first = PixelOffset(scene, pixels.X, y);
      std::fill_n(&frame.Colors[4 * first], 4 * pixels.Width, std::uint8_t{ 0 });
      std::fill_n(&frame.Depths[first], pixels.Width, Frame::NoSurface);
    }
    return;
  }
  if (shader.CanMakePixels())
  {
    WriteOpaque(scene, shader, pixels, rays, hits, frame);
    return;
  }
  if (!scene.Request.Projection)
  {
    shader.Shade(rays, hits, colors);
  }
  std::size_t ray = 0;
  for (int y = pixels.Y; y < pixels.Y + pixels.Height; ++y)
  {
    for (int x = pixels.X; x < pixels.X + pixels.Width; ++x, ++ray)
    {
      const std::size_t pixel = PixelOffset(scene, x, y);
      const std::size_t first = hits.First[ray];
      const std::size_t count = hits.First[ray + 1] - first;
      if (scene.Request.Projection)
      {
        ColorPixel(scene, hits.Hits.data() + first, count, &frame.Colors[4 * pixel]);
        frame.Depths[pixel] = Frame::NoSurface;
      }
      else
      {
        CompositePixel(scene, hits.Hits.data() + first, colors.data() + first, count,
          &frame.Colors[4 * pixel], frame.Depths[pixel]);
      }
      if (scene.KeepHits && count > 0)
      {
        frame.Hits[pixel] = hits.Hits[first];
      }
    }
  }
}

/// Calls visit for the parts of a tile that make a group of rays each: as square as may be, since
/// the rays of a group walk together.
template <typename Visit>
void ForEachBlock(const PixelRectangle& tile, const Visit& visit)
{
  constexpr int width = 16;
  const int columns = std::min(width, tile.Width);
  const int rows = RayPacket::Capacity / columns;
  for (int y = 0; y < tile.Height; y += rows)
  {
    for (int x = 0; x < tile.Width; x += columns)
    {
      visit(PixelRectangle{ tile.X + x, tile.Y + y, std::min(columns, tile.Width - x),
        std::min(rows, tile.Height - y) });
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
bool RenderTiles(const Scene& scene, ImageField& volume, Frame& frame, FrameTimes& times,
  const std::function<bool(double)>& keepGoing)
{
  const PixelRectangle& pixels = scene.Pixels;
  const std::size_t count = Count({ pixels.Width, pixels.Height, 1 });
  frame.Colors.resize(4 * count);
  frame.Depths.resize(count);
  frame.Hits.assign(scene.KeepHits ? count : 0, Hit{ 0.0, {}, Hit::NoSurface, {}, false });
  volume.Select(scene.Request, scene.Threads);

  const Shader shader(scene, volume);
  const int tilesPerRow = (pixels.Width + scene.TileWidth - 1) / scene.TileWidth;
  const int tiles = tilesPerRow * ((pixels.Height + scene.TileHeight - 1) / scene.TileHeight);
  const double brickSecondsBefore = 1e-9 * static_cast<double>(volume.GetBrickNanoseconds());
  const Clock::time_point start = Clock::now();
  double traceSeconds = 0.0;
  double shadeSeconds = 0.0;
  std::atomic<std::size_t> done{ 0 };
  std::atomic<bool> going{ true };

#pragma omp parallel num_threads(scene.Threads) reduction(+ : traceSeconds, shadeSeconds)
  {
    RayPacket rays;
    RayHits hits;
    std::vector<Vector3> colors;
#pragma omp for schedule(dynamic)
    for (int i = 0; i < tiles; ++i)
    {
      const PixelRectangle tile = GetTile(scene, i, tilesPerRow);
      ForEachBlock(tile,
        [&](const PixelRectangle& block)
        {
          // A loop of OpenMP cannot be left early: what remains is passed over.
          if (!going.load(std::memory_order_relaxed))
          {
            return;
          }
          const Clock::time_point begin = Clock::now();
          TraceBlock(scene, volume, block, rays, hits);
          const Clock::time_point traced = Clock::now();
          ShadeBlock(scene, shader, block, rays, hits, colors, frame);
          traceSeconds += Seconds(traced - begin);
          shadeSeconds += Seconds(Clock::now() - traced);
          const std::size_t some = Count({ block.Width, block.Height, 1 });
          const std::size_t finished = done.fetch_add(some, std::memory_order_relaxed) + some;
          if (omp_get_thread_num() == 0 && finished < count &&
            !keepGoing(static_cast<double>(finished) / static_cast<double>(count)))
          {
            going.store(false, std::memory_order_relaxed);
          }
        });
    }
  }

  const double brickSeconds =
    1e-9 * static_cast<double>(volume.GetBrickNanoseconds()) - brickSecondsBefore;
  const double threadSeconds = traceSeconds + shadeSeconds;
  const double share = threadSeconds > 0.0 ? Seconds(Clock::now() - start) / threadSeconds : 0.0;
  times.Bricks = share * brickSeconds;
  times.Trace = share * (traceSeconds - brickSeconds);
  times.Shade = share * shadeSeconds;
  // Whoever did the last pixels, the end is told.
  return going.load() && keepGoing(1.0);
}

}
