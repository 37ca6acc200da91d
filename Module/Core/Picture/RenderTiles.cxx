// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/RenderTiles.h"

#include "Field/BuildTimer.h"
#include "Field/FirstException.h"
#include "Picture/CloudFinder.h"
#include "Picture/CloudTileRenderer.h"
#include "Picture/PixelBlockRenderer.h"
#include "Picture/Tiles.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{
namespace
{

using Clock = std::chrono::steady_clock;

/// What threads write is this far apart, so that none waits for the cache line of another.
constexpr std::size_t CacheLine = 64;

/// The time between two reports of progress: short for people, long for the threads, which must all
/// come to rest for it.
constexpr std::chrono::milliseconds ReportInterval{ 20 };

double Seconds(Clock::duration duration)
{
  return std::chrono::duration<double>(duration).count();
}

std::size_t Area(const PixelRectangle& pixels)
{
  return static_cast<std::size_t>(pixels.Width) * static_cast<std::size_t>(pixels.Height);
}

/// A tile of the picture. Those that follow each other are drawn by different threads, so each has
/// a cache line of its own.
struct alignas(CacheLine) Tile
{
  PixelRectangle Pixels;
  /// The number of groups of blocks that are done: the first ones.
  int GroupsDone = 0;
  bool IsDone = false;
};

std::vector<Tile> FindTiles(const Scene& scene)
{
  std::vector<Tile> tiles;
  for (const PixelRectangle& pixels : MakeTiles(scene))
  {
    tiles.push_back({ pixels });
  }
  return tiles;
}

/// What a thread renders with, and what it has done in a step.
struct alignas(CacheLine) ThreadRenderer
{
  ThreadRenderer(
    const Scene& scene, const std::vector<Shader>& shaders, const Kernels* kernels, Frame& frame)
    : Clouds(HasClouds(scene) ? new CloudRenderer(scene, kernels) : nullptr)
    , Blocks(scene, shaders, this->Clouds ? &this->Clouds->OfTile : nullptr, frame)
  {
  }

  struct CloudRenderer
  {
    CloudRenderer(const Scene& scene, const Kernels* kernels)
      : Finder(scene, kernels)
      , OfTile(scene, kernels)
    {
    }

    CloudFinder Finder;
    CloudTileRenderer OfTile;
  };

  /// Null without clouds.
  std::unique_ptr<CloudRenderer> Clouds;
  PixelBlockRenderer Blocks;
  std::size_t PixelsDone = 0;
  Clock::duration TraceTime{};
  Clock::duration ShadeTime{};
  std::int64_t BuildNanoseconds = 0;
};

void Clear(const Scene& scene, Frame& frame)
{
  const std::size_t count = Area(scene.Pixels);
  Hit none{};
  none.Surface = Hit::NoSurface;
  frame.Colors.resize(4 * count);
  frame.Depths.resize(count);
  frame.Hits.assign(scene.KeepHits ? count : 0, none);
  frame.Fragments.clear();
}

//------------------------------------------------------------------------------
/// Renders a frame in steps. Between them no thread is at work, so that whoever is told of the
/// progress may do anything.
class FrameRenderer
{
public:
  /// All must outlive the renderer.
  FrameRenderer(const Scene& scene, const Execution& execution, Frame& frame, FrameTimes& times)
    : TheScene(scene)
    , TheExecution(execution)
    , Picture(frame)
    , Times(times)
    , Shaders(MakeShaders(scene, execution.PacketKernels))
    , BlocksAtOnce(PixelBlockRenderer::GetBlocksAtOnce(scene))
    , TilesAreWhole(HasClouds(scene))
    , Tiles(FindTiles(scene))
    , Renderers(static_cast<std::size_t>(execution.Threads))
  {
  }

  bool IsDone() const { return this->Tiles.empty(); }

  double GetFractionDone() const
  {
    return static_cast<double>(this->PixelsDone) / static_cast<double>(Area(this->TheScene.Pixels));
  }

  /// Renders tiles until the progress is to be reported, or all are done.
  void TakeStep();

  /// To be called when all tiles are done.
  void CollectFragments();

private:
  void Render(Tile& tile, ThreadRenderer& renderer);

  const Scene& TheScene;
  const Execution& TheExecution;
  Frame& Picture;
  FrameTimes& Times;
  std::vector<Shader> Shaders;
  int BlocksAtOnce;
  /// Whether tiles that are begun are drawn to their end, as clouds are.
  bool TilesAreWhole;
  /// Those that are not done.
  std::vector<Tile> Tiles;
  /// Of each thread.
  std::vector<std::unique_ptr<ThreadRenderer>> Renderers;
  std::size_t PixelsDone = 0;
  Clock::time_point StepStart;
  std::atomic<bool> IsStepOver{ false };
};

//------------------------------------------------------------------------------
void FrameRenderer::TakeStep()
{
  this->StepStart = Clock::now();
  this->IsStepOver = false;
  const auto tiles = static_cast<std::int64_t>(this->Tiles.size());
  FirstException exception;
#pragma omp parallel num_threads(this->TheExecution.Threads)
  {
    std::unique_ptr<ThreadRenderer>& renderer =
      this->Renderers[static_cast<std::size_t>(omp_get_thread_num())];
    exception.Guard(
      [&]
      {
        if (!renderer)
        {
          renderer = std::make_unique<ThreadRenderer>(
            this->TheScene, this->Shaders, this->TheExecution.PacketKernels, this->Picture);
        }
      });
#pragma omp for schedule(dynamic)
    for (std::int64_t i = 0; i < tiles; ++i)
    {
      exception.Guard([&] { this->Render(this->Tiles[static_cast<std::size_t>(i)], *renderer); });
    }
  }
  exception.Rethrow();
  this->Tiles.erase(std::remove_if(this->Tiles.begin(), this->Tiles.end(),
                      [](const Tile& tile) { return tile.IsDone; }),
    this->Tiles.end());

  double traceSeconds = 0.0;
  double shadeSeconds = 0.0;
  double buildSeconds = 0.0;
  for (const std::unique_ptr<ThreadRenderer>& renderer : this->Renderers)
  {
    if (renderer)
    {
      this->PixelsDone += std::exchange(renderer->PixelsDone, 0);
      traceSeconds += Seconds(std::exchange(renderer->TraceTime, {}));
      shadeSeconds += Seconds(std::exchange(renderer->ShadeTime, {}));
      buildSeconds += 1e-9 * static_cast<double>(std::exchange(renderer->BuildNanoseconds, 0));
    }
  }
  const double threadSeconds = traceSeconds + shadeSeconds;
  const double share =
    threadSeconds > 0.0 ? Seconds(Clock::now() - this->StepStart) / threadSeconds : 0.0;
  this->Times.Bricks += share * buildSeconds;
  this->Times.Trace += share * (traceSeconds - buildSeconds);
  this->Times.Shade += share * shadeSeconds;
}

//------------------------------------------------------------------------------
void FrameRenderer::CollectFragments()
{
  std::vector<FragmentOfPixel>& all = this->Picture.Fragments;
  for (const std::unique_ptr<ThreadRenderer>& renderer : this->Renderers)
  {
    if (renderer)
    {
      const std::vector<FragmentOfPixel>& kept = renderer->Blocks.GetKept();
      all.insert(all.end(), kept.begin(), kept.end());
    }
  }
}

//------------------------------------------------------------------------------
/// Renders the groups of blocks of a tile that are left, until the step is over. (A loop of OpenMP
/// cannot be left early: the remaining tiles do nothing.)
void FrameRenderer::Render(Tile& tile, ThreadRenderer& renderer)
{
  int number = 0;
  tile.IsDone = true;
  const std::int64_t builtBefore = BuildTimer::GetNanosecondsOfThread();
  renderer.Blocks.BeginTile(tile.Pixels);
  if (renderer.Clouds)
  {
    renderer.Clouds->OfTile.Begin(tile.Pixels);
  }
  ForEachGroup(tile.Pixels, this->BlocksAtOnce,
    [&](const PixelRectangle* blocks, int count)
    {
      if (number++ < tile.GroupsDone)
      {
        return true;
      }
      if (this->IsStepOver.load(std::memory_order_relaxed) &&
        (tile.GroupsDone == 0 || !this->TilesAreWhole))
      {
        tile.IsDone = false;
        return false;
      }
      const Clock::time_point begin = Clock::now();
      renderer.Blocks.Trace(blocks, count);
      const Clock::time_point traced = Clock::now();
      renderer.Blocks.Shade();
      const Clock::time_point end = Clock::now();
      renderer.TraceTime += traced - begin;
      renderer.ShadeTime += end - traced;
      for (int i = 0; i < count; ++i)
      {
        renderer.PixelsDone += Area(blocks[i]);
      }
      ++tile.GroupsDone;
      if (end - this->StepStart >= ReportInterval)
      {
        this->IsStepOver.store(true, std::memory_order_relaxed);
      }
      return true;
    });
  if (tile.IsDone && renderer.Clouds)
  {
    const Clock::time_point begin = Clock::now();
    renderer.Clouds->OfTile.Render(renderer.Clouds->Finder, this->Picture);
    renderer.TraceTime += Clock::now() - begin;
  }
  renderer.BuildNanoseconds += BuildTimer::GetNanosecondsOfThread() - builtBefore;
}

}

//------------------------------------------------------------------------------
bool RenderTiles(const Scene& scene, const Execution& execution, Frame& frame, FrameTimes& times,
  const std::function<bool(double)>& keepGoing)
{
  Clear(scene, frame);
  times = {};
  FrameRenderer renderer(scene, execution, frame, times);
  while (!renderer.IsDone())
  {
    renderer.TakeStep();
    if (!renderer.IsDone() && !keepGoing(renderer.GetFractionDone()))
    {
      return false;
    }
  }
  renderer.CollectFragments();
  return keepGoing(1.0);
}

}
