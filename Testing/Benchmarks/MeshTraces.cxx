// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MeshTraces.h"

#include "CellGrid.h"
#ifdef BENCHMARK_HAS_EMBREE
#include "EmbreeCells.h"
#include "EmbreeTriangles.h"
#endif
#include "IsosurfaceRenderer.h"
#include "MeshTracer.h"
#include "Samples.h"
#include "Views.h"

#include <vtkCellType.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Benchmark
{
namespace
{

const char* const TimeNote =
  "On one thread processor time, which other programs do not lengthen; on several threads "
  "wall-clock time. Of a picture it is the share that its threads spent on tracing, not on "
  "shading. ";

/// A picture that is traced again and again.
struct TracedPicture
{
  PictureRays Rays;
  vtkIsosurfaceRayTracing::Scene Scene;

  PixelRectangle GetPixels() const
  {
    const vtkIsosurfaceRayTracing::PixelRectangle& pixels = this->Scene.Pixels;
    return { pixels.X, pixels.Y, pixels.Width, pixels.Height };
  }
};

std::vector<TracedPicture> MakePictures(
  const Schedule& schedule, const Bounds& bounds, const MeshTracer& tracer)
{
  std::vector<TracedPicture> pictures;
  for (const View& view : MakeOrbit(bounds, schedule.Views))
  {
    const PictureRays rays(view, schedule.Size);
    pictures.push_back({ rays, tracer.MakeScene(view, rays, schedule.Size) });
  }
  return pictures;
}

/// The factor from seconds of a picture to nanoseconds of a ray.
double GetNanoseconds(const Schedule& schedule)
{
  return 1e9 / schedule.Size / schedule.Size;
}

//------------------------------------------------------------------------------
/// Traces a picture, given by its number, on so many threads, and returns the seconds.
using TracePicture = std::function<double(std::size_t, int)>;

/// The seconds of pictures on so many threads, of two ways that took turns, and their ratio.
struct TurnTimes
{
  int Threads;
  Samples Rays;
  Samples First;
  Samples Second;
  Samples Ratio;
};

/// Without a second way there is the first alone.
std::vector<TurnTimes> TakeTurns(const Schedule& schedule,
  const std::vector<TracedPicture>& pictures, const std::string& what, const TracePicture& first,
  const TracePicture& second)
{
  std::vector<TurnTimes> times;
  for (const int threads : schedule.Threads)
  {
    times.push_back({ threads, {}, {}, {}, {} });
  }
  for (int repeat = 0; repeat < schedule.Repeats; ++repeat)
  {
    schedule.LogTurn(what, repeat);
    for (std::size_t i = 0; i < pictures.size(); ++i)
    {
      for (TurnTimes& turn : times)
      {
        const int threads = turn.Threads;
        turn.Rays.Add(MeshTracer::MakeRays(pictures[i].Scene, threads));
        const double ours = first(i, threads);
        turn.First.Add(ours);
        if (second)
        {
          const double theirs = second(i, threads);
          turn.Second.Add(theirs);
          turn.Ratio.Add(ours / theirs);
        }
      }
    }
  }
  return times;
}

//------------------------------------------------------------------------------
#ifdef BENCHMARK_HAS_EMBREE
/// The size of a cell: the edge of a cube, if the box of the mesh were filled with as many.
double GetCellSize(const MeshCase& mesh)
{
  const Bounds box = mesh.GetBounds();
  return std::cbrt(
    (box[1] - box[0]) * (box[3] - box[2]) * (box[5] - box[4]) / mesh.GetNumberOfCells());
}

/// Compares the hits of all rays: an error of one of both would show.
void ReportAgreement(const MeshCase& mesh, const MeshTracer& tracer, EmbreeTriangles& triangles,
  const std::vector<TracedPicture>& pictures, Report& report)
{
  const double cell = GetCellSize(mesh);
  double ours = 0.0;
  double theirs = 0.0;
  std::vector<double> distances;
  for (const TracedPicture& picture : pictures)
  {
    const std::vector<float> first = tracer.FindDepths(picture.Scene, picture.Rays);
    const std::vector<float> second = triangles.FindDepths(picture.Rays, picture.GetPixels());
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      const bool isOurs = std::isfinite(first[i]);
      const bool isTheirs = std::isfinite(second[i]);
      ours += isOurs && !isTheirs ? 1.0 : 0.0;
      theirs += !isOurs && isTheirs ? 1.0 : 0.0;
      if (isOurs && isTheirs)
      {
        distances.push_back(std::abs(static_cast<double>(first[i] - second[i])) / cell);
      }
    }
  }
  std::sort(distances.begin(), distances.end());
  const auto both = static_cast<double>(distances.size());
  const auto getQuantile = [&distances](double share)
  {
    const double place = share * static_cast<double>(distances.size());
    return distances.empty()
      ? NotMeasured
      : distances[std::min(distances.size() - 1, static_cast<std::size_t>(place))];
  };
  report.AddRow(
    { "mesh agreement", "Whether both hit the same",
      "The rays of all pictures. Distances along the view, in cells: in the edge of a cube, if as "
      "many as there are cells filled the box of the mesh. A ray past the edge of the surface that "
      "one of both hits meets another part of it far behind.",
      { "mesh", "rays that hit both", "only this library's surface, %", "only the triangles, %",
        "distance: median", "99 %", "largest" },
      {} },
    { mesh.Name, both, 100.0 * ours / (both + ours + theirs),
      100.0 * theirs / (both + ours + theirs), getQuantile(0.5), getQuantile(0.99),
      getQuantile(1.0) });
}
#endif

}

//------------------------------------------------------------------------------
void MeasureMeshTraces(const Schedule& schedule, const MeshCase& mesh, Report& report)
{
  Log(mesh.Name + ": building trees");
  std::unique_ptr<MeshTracer> tracer;
  const double treeSeconds = Measure(
    [&]()
    {
      tracer =
        std::make_unique<MeshTracer>(mesh.Grid, mesh.GetScalars(), schedule.GetMostThreads());
    });
  tracer->Select(mesh.Isovalue);
  const std::vector<TracedPicture> pictures = MakePictures(schedule, mesh.GetBounds(), *tracer);
  vtkSmartPointer<vtkPolyData> triangles;
  const double extraction =
    Measure([&]() { triangles = ExtractMesh<vtkContour3DLinearGrid>(mesh, mesh.Isovalue); });
  double build = NotMeasured;
  TracePicture theirs;
#ifdef BENCHMARK_HAS_EMBREE
  std::unique_ptr<EmbreeTriangles> embree;
  build = Measure(
    [&]() { embree = std::make_unique<EmbreeTriangles>(triangles, schedule.GetMostThreads()); });
  theirs = [&](std::size_t picture, int threads)
  {
    const TracedPicture& traced = pictures[picture];
    return MeasureOn(threads, [&]() { embree->Trace(traced.Rays, traced.GetPixels(), threads); });
  };
  ReportAgreement(mesh, *tracer, *embree, pictures, report);
#endif
  report.AddRow({ "mesh preparation", "Before the first ray",
                  "On " + std::to_string(schedule.GetMostThreads()) +
                    " threads. This library's tree serves all isovalues; triangles and Embree's "
                    "tree are those of one.",
                  { "mesh", "cells", "this library's tree, ms", "triangles", "extraction, ms",
                    "Embree's tree, ms" },
                  {} },
    { mesh.Name, mesh.GetNumberOfCells(), 1e3 * treeSeconds,
      static_cast<double>(triangles->GetNumberOfPolys()), 1e3 * extraction, 1e3 * build });
  const std::vector<TurnTimes> times = TakeTurns(
    schedule, pictures, mesh.Name + ": traces",
    [&](std::size_t picture, int threads)
    { return tracer->Trace(pictures[picture].Scene, threads); },
    theirs);
  const double nanoseconds = GetNanoseconds(schedule);
  for (const TurnTimes& turn : times)
  {
    report.AddRow(
      { "mesh traces", "First hits of rays, " + schedule.GetPictureSize(),
        TimeNote +
          std::string("Nanoseconds for each pixel. Both ways make their rays; what making ours "
                      "takes alone is told. Embree's tree was built before."),
        { "mesh", "threads", "rays alone, ns", "this library, ns", "Embree, ns",
          "this library / Embree" },
        {} },
      { mesh.Name, static_cast<double>(turn.Threads), turn.Rays * nanoseconds,
        turn.First * nanoseconds, turn.Second * nanoseconds, turn.Ratio });
    if (!turn.Ratio.IsEmpty())
    {
      report.Goals.push_back({ 1,
        mesh.Name + ": trace, this library against Embree on " + std::to_string(turn.Threads) +
          " threads",
        turn.Ratio.GetMedian(), true, mesh.GetNumberOfCells() < 5e6 ? 0.7 : 1.0 });
    }
  }
}

//------------------------------------------------------------------------------
void MeasureMeshSplit(const Schedule& schedule, const MeshCase& mesh, Report& report)
{
  if (!mesh.Split)
  {
    return;
  }
  MeshTracer cells(mesh.Grid, mesh.GetScalars(), schedule.GetMostThreads());
  MeshTracer tetrahedra(
    mesh.Split, mesh.Split->GetPointData()->GetScalars(), schedule.GetMostThreads());
  cells.Select(mesh.Isovalue);
  tetrahedra.Select(mesh.Isovalue);
  const auto pictures = MakePictures(schedule, mesh.GetBounds(), cells);
  const auto picturesOfSplit = MakePictures(schedule, mesh.GetBounds(), tetrahedra);
  const std::vector<TurnTimes> times = TakeTurns(
    schedule, pictures, mesh.Name + ": cells and tetrahedra",
    [&](std::size_t picture, int threads) { return cells.Trace(pictures[picture].Scene, threads); },
    [&](std::size_t picture, int threads)
    { return tetrahedra.Trace(picturesOfSplit[picture].Scene, threads); });
  const double nanoseconds = GetNanoseconds(schedule);
  for (const TurnTimes& turn : times)
  {
    report.AddRow(
      { "mesh split", "Cells as they are, and split into tetrahedra",
        TimeNote + std::string("Nanoseconds for each pixel, with making the rays."),
        { "mesh", "threads", "cells, ns", "tetrahedra, ns", "cells / tetrahedra" }, {} },
      { mesh.Name, static_cast<double>(turn.Threads), turn.First * nanoseconds,
        turn.Second * nanoseconds, turn.Ratio });
    report.Goals.push_back({ 5,
      mesh.Name + ": trace of the cells against that of tetrahedra on " +
        std::to_string(turn.Threads) + " threads",
      turn.Ratio.GetMedian(), true, 3.0 });
  }
}

//------------------------------------------------------------------------------
namespace
{

/// A hierarchy over the cells, through which rays are traced one by one.
struct OtherHierarchy
{
  std::string Name;
  double BuildSeconds;
  double Bytes;
  /// Returns the t of the first hit of a ray, given its origin and direction.
  std::function<double(const Triple&, const Triple&)> FindFirst;
  Samples Times;
  Samples Ratio;

  /// As MeshTracer::FindDepths.
  std::vector<float> FindDepths(const TracedPicture& picture) const
  {
    const PixelRectangle pixels = picture.GetPixels();
    std::vector<float> depths;
    for (int y = pixels.Y; y < pixels.Y + pixels.Height; ++y)
    {
      for (int x = pixels.X; x < pixels.X + pixels.Width; ++x)
      {
        depths.push_back(static_cast<float>(
          this->FindFirst(picture.Rays.GetOrigin(), picture.Rays.GetDirection(x, y))));
      }
    }
    return depths;
  }
};

bool HasOnlyTetrahedra(vtkUnstructuredGrid* grid)
{
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    if (grid->GetCellType(i) != VTK_TETRA)
    {
      return false;
    }
  }
  return true;
}

/// The share of rays, in percent, that only one of two hits.
double FindDisagreement(const std::vector<float>& first, const std::vector<float>& second)
{
  double different = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    different += std::isfinite(first[i]) != std::isfinite(second[i]) ? 1.0 : 0.0;
  }
  return 100.0 * different / static_cast<double>(first.size());
}

}

//------------------------------------------------------------------------------
void MeasureMeshHierarchies(const Schedule& schedule, const MeshCase& mesh, Report& report)
{
  constexpr double mostCells = 2e6;
  const double cells = mesh.GetNumberOfCells();
  if (cells > mostCells || !HasOnlyTetrahedra(mesh.Unstructured))
  {
    return;
  }
  Log(mesh.Name + ": other hierarchies");
  MeshTracer tracer(mesh.Grid, mesh.GetScalars(), schedule.GetMostThreads());
  tracer.Select(mesh.Isovalue);
  const TracedPicture picture = MakePictures(schedule, mesh.GetBounds(), tracer).front();
  const TetrahedronList list(mesh.Unstructured);
  std::vector<OtherHierarchy> others;
  std::unique_ptr<CellGrid> grid;
  const double gridSeconds = Measure([&]() { grid = std::make_unique<CellGrid>(list); });
  others.push_back({ "uniform grid with lists of cells", gridSeconds, grid->GetMemory(),
    [&](const Triple& origin, const Triple& direction)
    { return grid->FindFirst(origin, direction, mesh.Isovalue); },
    {}, {} });
#ifdef BENCHMARK_HAS_EMBREE
  std::unique_ptr<EmbreeCells> embree;
  const double embreeSeconds = Measure([&]()
    { embree = std::make_unique<EmbreeCells>(list, mesh.Isovalue, schedule.GetMostThreads()); });
  others.push_back({ "Embree's tree over the cells", embreeSeconds, embree->GetMemory(),
    [&](const Triple& origin, const Triple& direction)
    { return embree->FindFirst(origin, direction); },
    {}, {} });
#endif
  Samples ours;
  for (int repeat = 0; repeat < schedule.Repeats; ++repeat)
  {
    ours.Add(tracer.Trace(picture.Scene, 1));
    for (OtherHierarchy& other : others)
    {
      other.Times.Add(MeasureProcessor([&]() { other.FindDepths(picture); }));
      other.Ratio.Add(other.Times.GetMedian() / ours.GetMedian());
    }
  }
  const Table table = { "mesh hierarchies", "Other hierarchies over the cells",
    "On one thread, of one picture. In these rays are traced one by one; hits in a cell are found "
    "by "
    "its gradient and barycentric coordinates, so rays may slip through between two cells. The "
    "grid "
    "has ranges of values on three levels, as images have macrocells; Embree's tree has none.",
    { "mesh", "hierarchy", "build, ms", "memory, bytes a cell", "trace, ns", "times this library's",
      "rays with a hit in one of both, %" },
    {} };
  const double nanoseconds = GetNanoseconds(schedule);
  report.AddRow(table,
    { mesh.Name, "this library's", Cell(), tracer.GetMemory() / cells, ours * nanoseconds, 1.0,
      0.0 });
  const std::vector<float> depths = tracer.FindDepths(picture.Scene, picture.Rays);
  for (const OtherHierarchy& other : others)
  {
    report.AddRow(table,
      { mesh.Name, other.Name, 1e3 * other.BuildSeconds, other.Bytes / cells,
        other.Times * nanoseconds, other.Ratio,
        FindDisagreement(depths, other.FindDepths(picture)) });
  }
}

}
