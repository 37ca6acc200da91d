// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PictureMethods.h"

#include "Baselines.h"
#include "RayMethods.h"
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

std::unique_ptr<IsosurfaceRenderer> NewOurs(const Input& input, const Rays& rays, int solver)
{
  auto ours = std::make_unique<TracedIsosurface>(input.Image, rays.Size, GetMostThreads());
  ours->SetIsovalue(input.Isovalue);
  ours->GetMapper()->SetRootSolver(solver);
  return ours;
}

std::unique_ptr<IsosurfaceRenderer> NewTheirs(
  const std::string& name, const Input& input, const Rays& rays, double sampleDistance)
{
  std::unique_ptr<IsosurfaceRenderer> baseline =
    NewBaseline(name, input.Image, rays.Size, GetMostThreads(), sampleDistance);
  baseline->Begin(input.Isovalue, rays.Views.front());
  return baseline;
}

}

//------------------------------------------------------------------------------
std::vector<PictureMethod> MakePictureMethods(const Input& input, const Rays& rays)
{
  std::vector<PictureMethod> methods;
  methods.push_back({ "Robust", "", NewOurs(input, rays, Mapper::ROBUST) });
  methods.push_back({ "Analytic", "", NewOurs(input, rays, Mapper::ANALYTIC) });
  methods.push_back({ "Marmitt", "N = 3", NewOurs(input, rays, Mapper::MARMITT) });
  methods.push_back({ "Linear", "", NewOurs(input, rays, Mapper::LINEAR) });
  if (GetAbsence("polygons").empty())
  {
    methods.push_back({ "Polygons of flying edges", "", NewTheirs("polygons", input, rays, 0.0) });
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
        methods.push_back(
          { family, FormatDistance(distance), NewTheirs(name, input, rays, distance) });
      }
    }
  }
  return methods;
}

//------------------------------------------------------------------------------
std::vector<FrameTimes> DrawAll(const PictureMethod& method, const Rays& rays)
{
  std::vector<FrameTimes> times;
  // The first picture after others may make what they did not need.
  method.Renderer->Draw(rays.Views.front(), GetMostThreads());
  for (const View& view : rays.Views)
  {
    times.push_back(method.Renderer->Draw(view, GetMostThreads()));
  }
  return times;
}

//------------------------------------------------------------------------------
std::vector<double> GetDistances(const PictureMethod& method, const Rays& rays)
{
  std::vector<double> found;
  for (const View& view : rays.Views)
  {
    method.Renderer->Draw(view, GetMostThreads());
    const std::vector<double> distances = method.Renderer->GetDistances();
    rays.ForEachPixel([&](int x, int y)
      { found.push_back(distances[static_cast<std::size_t>(x + y * rays.Size)]); });
  }
  return found;
}

}
