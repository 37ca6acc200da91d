// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/RenderTiles.h"

#include "Picture/PixelBlockRenderer.h"

#include <algorithm>
#include <atomic>
#include <chrono>

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

std::size_t Area(const PixelRectangle& pixels)
{
  return static_cast<std::size_t>(pixels.Width) * static_cast<std::size_t>(pixels.Height);
}

/// The time spent making bricks so far, summed over the threads.
double GetBrickSeconds(const Scene& scene)
{
  double seconds = 0.0;
  for (const SceneField& field : scene.Fields)
  {
    seconds += 1e-9 * static_cast<double>(field.Field->GetStatistics().BrickNanoseconds);
  }
  return seconds;
}

/// Calls visit for the parts of a tile that make a packet of rays each: as square as may be, since
/// the rays of a packet are traced together.
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

void Clear(const Scene& scene, Frame& frame)
{
  const std::size_t count = Area(scene.Pixels);
  Hit none{};
  none.Surface = Hit::NoSurface;
  frame.Colors.resize(4 * count);
  frame.Depths.resize(count);
  frame.Hits.assign(scene.KeepHits ? count : 0, none);
}

}

//------------------------------------------------------------------------------
bool RenderTiles(const Scene& scene, const Execution& execution, Frame& frame, FrameTimes& times,
  const std::function<bool(double)>& keepGoing)
{
  const PixelRectangle& pixels = scene.Pixels;
  const std::size_t count = Area(pixels);
  Clear(scene, frame);
  std::vector<Shader> shaders;
  shaders.reserve(scene.Fields.size());
  for (std::size_t field = 0; field < scene.Fields.size(); ++field)
  {
    shaders.emplace_back(scene, field, execution.PacketKernels);
  }
  const int tilesPerRow = (pixels.Width + scene.TileWidth - 1) / scene.TileWidth;
  const int tiles = tilesPerRow * ((pixels.Height + scene.TileHeight - 1) / scene.TileHeight);
  const double brickSecondsBefore = GetBrickSeconds(scene);
  const Clock::time_point start = Clock::now();
  double traceSeconds = 0.0;
  double shadeSeconds = 0.0;
  std::atomic<std::size_t> done{ 0 };
  std::atomic<bool> going{ true };

#pragma omp parallel num_threads(execution.Threads) reduction(+ : traceSeconds, shadeSeconds)
  {
    PixelBlockRenderer renderer(scene, shaders, frame);
#pragma omp for schedule(dynamic)
    for (int i = 0; i < tiles; ++i)
    {
      ForEachBlock(GetTile(scene, i, tilesPerRow),
        [&](const PixelRectangle& block)
        {
          // A loop of OpenMP cannot be left early: remaining iterations do nothing.
          if (!going.load(std::memory_order_relaxed))
          {
            return;
          }
          const Clock::time_point begin = Clock::now();
          renderer.Trace(block);
          const Clock::time_point traced = Clock::now();
          renderer.Shade();
          traceSeconds += Seconds(traced - begin);
          shadeSeconds += Seconds(Clock::now() - traced);
          const std::size_t some = Area(block);
          const std::size_t finished = done.fetch_add(some, std::memory_order_relaxed) + some;
          if (omp_get_thread_num() == 0 && finished < count &&
            !keepGoing(static_cast<double>(finished) / static_cast<double>(count)))
          {
            going.store(false, std::memory_order_relaxed);
          }
        });
    }
  }

  const double brickSeconds = GetBrickSeconds(scene) - brickSecondsBefore;
  const double threadSeconds = traceSeconds + shadeSeconds;
  const double share = threadSeconds > 0.0 ? Seconds(Clock::now() - start) / threadSeconds : 0.0;
  times.Bricks = share * brickSeconds;
  times.Trace = share * (traceSeconds - brickSeconds);
  times.Shade = share * shadeSeconds;
  // The end of the progress is reported, whichever thread traced the last pixels.
  return going.load() && keepGoing(1.0);
}

}
