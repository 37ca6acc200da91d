// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "GoalMeasurements.h"

#include "OffScreenWindow.h"
#include "TileSchedule.h"
#include "TracedIsosurface.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace Benchmark
{
namespace
{

//------------------------------------------------------------------------------
// Seconds to sum the samples up, as words, on so many threads.
double ReadOnce(const Setup& setup)
{
  const auto* words =
    static_cast<const std::uint64_t*>(setup.Image->GetPointData()->GetScalars()->GetVoidPointer(0));
  const auto count = static_cast<std::int64_t>(setup.GetDataBytes() / sizeof(std::uint64_t));
  std::uint64_t sum = 0;
  const double seconds = Measure(
    [&]()
    {
#pragma omp parallel for schedule(static) num_threads(setup.GetMostThreads()) reduction(+ : sum)
      for (std::int64_t i = 0; i < count; ++i)
      {
        sum += words[i];
      }
    });
  // The sum is used, so that the work is not optimized away.
  return sum == 1 ? std::nextafter(seconds, 0.0) : seconds;
}

//------------------------------------------------------------------------------
// The seconds of each tile of a picture on one thread, in the order in which threads take them.
std::vector<double> MeasureTiles(TracedIsosurface& surface, const View& view)
{
  constexpr int times = 3;
  const int* size = surface.GetMapper()->GetTileSize();
  const PixelRectangle pixels = surface.GetPixels(view);
  const auto cast = [&](const PixelRectangle& part)
  {
    double fastest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < times; ++i)
    {
      fastest = std::min(fastest, surface.CastRays(view, part));
    }
    return fastest;
  };
  // Measured beside each tile: one time alone may be when the machine was busy with other work, and
  // above that of all tiles.
  double ofNoRays = std::numeric_limits<double>::infinity();
  std::vector<double> costs;
  for (int y = 0; y < pixels.Height; y += size[1])
  {
    for (int x = 0; x < pixels.Width; x += size[0])
    {
      ofNoRays = std::min(ofNoRays, cast({ 0, 0, 0, 0 }));
      costs.push_back(cast({ pixels.X + x, pixels.Y + y, std::min(size[0], pixels.Width - x),
        std::min(size[1], pixels.Height - y) }));
    }
  }
  for (double& cost : costs)
  {
    cost = std::max(0.0, cost - ofNoRays);
  }
  return costs;
}

}

//------------------------------------------------------------------------------
void MeasureColdStart(const Setup& setup, double isovalue, Report& report)
{
  const View view = setup.GetOrbit().front();
  TracedIsosurface surface(setup.Image, setup.Size, setup.GetMostThreads());
  surface.SetIsovalue(isovalue);
  surface.Draw(view, setup.GetMostThreads()); // The window and its shaders are no part of it.
  Samples cold;
  Samples frame;
  Samples read;
  Samples macrocells;
  for (int repeat = 0; repeat < setup.Repeats && !IsEnough(cold, setup.Repeats); ++repeat)
  {
    setup.LogTurn("Isovalue " + ToText(isovalue) + ": cold start", repeat);
    surface.Reset();
    surface.SetIsovalue(isovalue);
    cold.Add(surface.Draw(view, setup.GetMostThreads()).GetSeconds());
    macrocells.Add(surface.GetMapper()->GetMacrocellBuildTime());
    frame.Add(surface.Draw(view, setup.GetMostThreads()).GetSeconds());
    read.Add(ReadOnce(setup));
  }
  report.Tables.push_back({ "cold start " + ToText(isovalue),
    "Isovalue " + ToText(isovalue) + ": cold start to the first picture",
    "On " + std::to_string(setup.GetMostThreads()) + " threads. One read: the sum of all samples.",
    { "what", "ms" },
    { { "first picture", cold * 1e3 }, { "of it, macrocells", macrocells * 1e3 },
      { "the same picture again", frame * 1e3 }, { "one read of the volume", read * 1e3 },
      { "bandwidth of the read, GB/s", 1e-9 * setup.GetDataBytes() / read.GetMedian() } } });
  report.Goals.push_back({ 3,
    "Isovalue " + ToText(isovalue) +
      ": cold start to first picture, against two reads of the volume and a frame",
    cold.GetMedian() / (2.0 * read.GetMedian() + frame.GetMedian()), true, 1.0 });
}

//------------------------------------------------------------------------------
void MeasureWholeFrame(const Setup& setup, double isovalue, Report& report)
{
  constexpr int size = 1024;
  if (!OffScreenWindow::IsPossible())
  {
    return;
  }
  TracedIsosurface surface(setup.Image, size, setup.GetMostThreads());
  surface.SetIsovalue(isovalue);
  Samples whole;
  Samples trace;
  Samples shade;
  Samples display;
  Samples ratio;
  for (const View& view : setup.GetOrbit())
  {
    surface.Draw(view, setup.GetMostThreads()); // Builds the bricks.
  }
  for (int repeat = 0; repeat < setup.Repeats; ++repeat)
  {
    setup.LogTurn("Isovalue " + ToText(isovalue) + ": whole frames", repeat);
    for (const View& view : setup.GetOrbit())
    {
      const FrameTimes times = surface.Draw(view, setup.GetMostThreads());
      whole.Add(1e3 * times.Whole);
      trace.Add(1e3 * times.Trace);
      shade.Add(1e3 * surface.GetMapper()->GetShadeTime());
      display.Add(1e3 * surface.GetMapper()->GetDisplayTime());
      ratio.Add(times.Whole / times.Trace);
    }
  }
  report.Tables.push_back({ "whole frame " + ToText(isovalue),
    "Isovalue " + ToText(isovalue) + ": the whole frame, 1024 x 1024 pixels",
    "On " + std::to_string(setup.GetMostThreads()) +
      " threads. The rest of the frame is the time of VTK and OpenGL.",
    { "what", "ms" },
    { { "frame", whole }, { "trace", trace }, { "shading", shade }, { "display", display } } });
  report.Goals.push_back(
    { 5, "Isovalue " + ToText(isovalue) + ": the whole frame against its trace", ratio.GetMedian(),
      true, 1.25 });
}

//------------------------------------------------------------------------------
void MeasureScaling(const Setup& setup, double isovalue, Report& report)
{
  Log("Isovalue " + ToText(isovalue) + ": the cost of every tile");
  TracedIsosurface surface(setup.Image, setup.Size, setup.GetMostThreads());
  surface.SetIsovalue(isovalue);
  const View view = setup.GetOrbit().front();
  surface.Draw(view, 1); // Makes the bricks; one thread from here on.
  const std::vector<double> costs = MeasureTiles(surface, view);
  Table table{ "simulated scaling " + ToText(isovalue),
    "Isovalue " + ToText(isovalue) + ": more threads than this machine has, simulated",
    std::to_string(costs.size()) + " tiles of " +
      std::to_string(surface.GetMapper()->GetTileSize()[0]) + " x " +
      std::to_string(surface.GetMapper()->GetTileSize()[1]) + " of a picture of " +
      setup.GetPictureSize() +
      ", each traced alone on one thread with CastRays (the fastest of three, minus a call without "
      "rays), assigned in order to threads that share no caches and no bandwidth. Parker et "
      "al. measured 91 % and 80 % on 128 processors.",
    { "threads", "efficiency, %" }, {} };
  for (const int threads : { 16, 64, 128 })
  {
    table.Rows.push_back({ static_cast<double>(threads), 100.0 * GetEfficiency(costs, threads) });
  }
  report.Tables.push_back(table);
  report.Goals.push_back(
    { 6, "Isovalue " + ToText(isovalue) + ": simulated efficiency on 128 threads, %",
      100.0 * GetEfficiency(costs, 128), false, 91.0 });
}

}
