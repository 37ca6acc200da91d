// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BenchmarkPictures.h"

#include "BenchmarkMethods.h"
#include "Rivals.h"
#include "TracedIsosurface.h"

#include <algorithm>
#include <array>
#include <thread>
#include <utility>

namespace Benchmark
{
namespace
{

using Mapper = vtkIsosurfaceRayTraceMapper;

int GetMostThreads()
{
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::unique_ptr<Contestant> NewOurs(const Input& input, const Rays& rays, int solver)
{
  auto ours = std::make_unique<TracedIsosurface>(input.Image, rays.Size, GetMostThreads());
  ours->SetIsovalue(input.Isovalue);
  ours->GetMapper()->SetRootSolver(solver);
  return ours;
}

std::unique_ptr<Contestant> NewTheirs(
  const std::string& name, const Input& input, const Rays& rays, double sampleDistance)
{
  std::unique_ptr<Contestant> rival =
    NewRival(name, input.Image, rays.Size, GetMostThreads(), sampleDistance);
  rival->Begin(input.Isovalue, rays.Views.front());
  return rival;
}

}

//------------------------------------------------------------------------------
std::vector<Painter> MakePainters(const Input& input, const Rays& rays)
{
  std::vector<Painter> painters;
  painters.push_back({ "Robust", "", NewOurs(input, rays, Mapper::ROBUST) });
  painters.push_back({ "Fast", "", NewOurs(input, rays, Mapper::FAST) });
  painters.push_back({ "Analytic", "", NewOurs(input, rays, Mapper::ANALYTIC) });
  painters.push_back({ "Marmitt", "N = 3", NewOurs(input, rays, Mapper::MARMITT) });
  painters.push_back({ "Linear", "", NewOurs(input, rays, Mapper::LINEAR) });
  if (GetAbsence("polygons").empty())
  {
    painters.push_back({ "Polygons of flying edges", "", NewTheirs("polygons", input, rays, 0.0) });
  }
  const std::array<std::pair<const char*, const char*>, 2> samplers = {
    { { "VTK's GPU mode", "gpu" }, { "VTK's fixed-point mapper", "fixed-point" } }
  };
  for (const auto& [family, name] : samplers)
  {
    for (const double distance : { 1.0, 0.5, 0.25 })
    {
      if (GetAbsence(name).empty())
      {
        painters.push_back(
          { family, GetSampleKnob(distance), NewTheirs(name, input, rays, distance) });
      }
    }
  }
  return painters;
}

//------------------------------------------------------------------------------
std::vector<FrameTimes> DrawAll(const Painter& painter, const Rays& rays)
{
  std::vector<FrameTimes> times;
  // The first picture after others may make what they did not need.
  painter.Who->Draw(rays.Views.front(), GetMostThreads());
  for (const View& view : rays.Views)
  {
    times.push_back(painter.Who->Draw(view, GetMostThreads()));
  }
  return times;
}

//------------------------------------------------------------------------------
std::vector<double> Look(const Painter& painter, const Rays& rays)
{
  std::vector<double> found;
  for (const View& view : rays.Views)
  {
    painter.Who->Draw(view, GetMostThreads());
    const std::vector<double> distances = painter.Who->GetDistances();
    rays.ForEachPixel([&](int x, int y)
      { found.push_back(distances[static_cast<std::size_t>(x + y * rays.Size)]); });
  }
  return found;
}

}
