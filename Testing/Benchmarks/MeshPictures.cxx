// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MeshPictures.h"

#include "Environment.h"
#include "OffScreenWindow.h"
#include "Samples.h"
#include "TracedIsosurface.h"

#include <vtkActor.h>
#include <vtkIsosurfaceRayTraceMeshMapper.h>
#include <vtkPolyDataMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <memory>
#include <utility>
#include <vector>

namespace Benchmark
{
namespace
{

using Mapper = vtkIsosurfaceRayTraceMeshMapper;

//------------------------------------------------------------------------------
/// Draws the isosurfaces of a mesh into a window of its own.
class MeshDrawing
{
public:
  explicit MeshDrawing(const MeshCase& mesh, int size)
    : Mesh(mesh)
    , Window(size)
  {
  }
  virtual ~MeshDrawing() = default;

  /// Does all that a new isovalue requires, up to the first picture; returns the seconds.
  virtual double ChangeIsovalue(double isovalue, const View& view) = 0;
  /// Draws one more picture of the isosurface; returns the seconds.
  double Draw(const View& view) { return this->Window.Draw(view); }

protected:
  const MeshCase& Mesh;
  OffScreenWindow Window;
};

//------------------------------------------------------------------------------
class TracedMesh : public MeshDrawing
{
public:
  TracedMesh(const MeshCase& mesh, int size, int threads)
    : MeshDrawing(mesh, size)
    , Threads(threads)
  {
    this->Reset(Mapper::CENTRAL_DIFFERENCES);
  }

  /// A new mapper, which has built nothing.
  void Reset(int normalMode)
  {
    this->TheMapper = vtkSmartPointer<Mapper>::New();
    this->TheMapper->SetInputData(this->Mesh.Grid);
    this->TheMapper->SetNumberOfThreads(this->Threads);
    this->TheMapper->SetNormalMode(normalMode);
    this->Volume = vtkSmartPointer<vtkVolume>::New();
    this->Volume->SetMapper(this->TheMapper);
    this->Window.Show(this->Volume);
  }

  double ChangeIsovalue(double isovalue, const View& view) override
  {
    this->Volume->SetProperty(NewSurfaceProperty(isovalue));
    return this->Window.Draw(view);
  }

  Mapper* GetMapper() { return this->TheMapper; }

private:
  int Threads;
  vtkSmartPointer<Mapper> TheMapper;
  vtkSmartPointer<vtkVolume> Volume;
};

//------------------------------------------------------------------------------
/// The triangles that a filter extracts, without normals: they are shaded flat.
template <typename Filter>
class DrawnTriangles : public MeshDrawing
{
public:
  using MeshDrawing::MeshDrawing;

  double ChangeIsovalue(double isovalue, const View& view) override
  {
    vtkSmartPointer<vtkPolyData> triangles;
    const double extraction =
      Measure([&]() { triangles = ExtractMesh<Filter>(this->Mesh, isovalue); });
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(triangles);
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Window.Show(actor);
    return extraction + this->Window.Draw(view);
  }
};

//------------------------------------------------------------------------------
/// What the pictures of a method took, and how many times those of this mapper.
struct PictureTimes
{
  std::string Name;
  std::unique_ptr<MeshDrawing> Drawing;
  Samples NewIsovalue;
  Samples NewIsovalueRatio;
  Samples Next;
  Samples NextRatio;
};

/// An isovalue some steps away from the one that is measured.
double GetOtherIsovalue(const MeshCase& mesh, int steps)
{
  double range[2];
  mesh.GetScalars()->GetRange(range);
  const double step = 0.05 * steps * (range[1] - range[0]);
  return mesh.Isovalue + step < range[1] ? mesh.Isovalue + step : mesh.Isovalue - step;
}

//------------------------------------------------------------------------------
void MeasureNewIsovalue(const Schedule& schedule, const MeshCase& mesh,
  const std::vector<View>& orbit, TracedMesh& ours, std::vector<PictureTimes>& baselines,
  Report& report)
{
  Samples second;
  Samples newIsovalue;
  Samples next;
  for (int repeat = 0; repeat < schedule.Repeats; ++repeat)
  {
    schedule.LogTurn(mesh.Name + ": a new isovalue", repeat);
    ours.Reset(Mapper::CENTRAL_DIFFERENCES);
    ours.ChangeIsovalue(GetOtherIsovalue(mesh, 2), orbit.front());
    second.Add(ours.ChangeIsovalue(GetOtherIsovalue(mesh, 1), orbit.front()));
    const double our = ours.ChangeIsovalue(mesh.Isovalue, orbit.front());
    const double ourNext = ours.Draw(orbit.back());
    newIsovalue.Add(our);
    next.Add(ourNext);
    for (PictureTimes& baseline : baselines)
    {
      if (!IsEnough(baseline.NewIsovalue, schedule.Repeats))
      {
        const double their = baseline.Drawing->ChangeIsovalue(mesh.Isovalue, orbit.front());
        const double theirNext = baseline.Drawing->Draw(orbit.back());
        baseline.NewIsovalue.Add(their);
        baseline.NewIsovalueRatio.Add(their / our);
        baseline.Next.Add(theirNext);
        baseline.NextRatio.Add(theirNext / ourNext);
      }
    }
  }
  const Table table = { "mesh pictures", "Pictures in a window, " + schedule.GetPictureSize(),
    "On " + std::to_string(schedule.GetMostThreads()) +
      " threads, with shading and display: the first complete frame of a new isovalue, where two "
      "others have been drawn before; the next, from another side. With the second isovalue the "
      "mapper finds the gradients at all points. The triangles are extracted and drawn without "
      "normals, which would take longer.",
    { "mesh", "method", "new isovalue, ms", "times this mapper's", "next picture, ms",
      "times this mapper's next" },
    {} };
  report.AddRow(table, { mesh.Name, "this mapper", newIsovalue * 1e3, 1.0, next * 1e3, 1.0 });
  report.AddRow(table, { mesh.Name, "this mapper, the second isovalue", second * 1e3, {}, {}, {} });
  for (const PictureTimes& baseline : baselines)
  {
    report.AddRow(table,
      { mesh.Name, baseline.Name, baseline.NewIsovalue * 1e3, baseline.NewIsovalueRatio,
        baseline.Next * 1e3, baseline.NextRatio });
  }
  const double cells = mesh.GetNumberOfCells();
  report.Goals.push_back({ 2,
    mesh.Name + ": a new isovalue, " + baselines.front().Name +
      " and drawing its triangles against this mapper",
    baselines.front().NewIsovalueRatio.GetMedian(), false,
    cells < 9e5     ? 3.0
      : cells < 5e6 ? 8.0
                    : 15.0 });
}

//------------------------------------------------------------------------------
void MeasureFirstPicture(const Schedule& schedule, const MeshCase& mesh, const View& view,
  TracedMesh& ours, PictureTimes& theirs, Report& report)
{
  struct Variant
  {
    const char* Name;
    int NormalMode;
    Samples Tree;
    Samples Gradients;
    Samples First;
    Samples Ratio;
  };
  Variant variants[] = { { "this mapper", Mapper::CENTRAL_DIFFERENCES, {}, {}, {}, {} },
    { "this mapper, gradients in the cells as normals", Mapper::INTERPOLANT_GRADIENT, {}, {}, {},
      {} } };
  Samples baseline;
  for (int repeat = 0; repeat < schedule.Repeats && !IsEnough(baseline, schedule.Repeats); ++repeat)
  {
    schedule.LogTurn(mesh.Name + ": the first picture", repeat);
    const double their = theirs.Drawing->ChangeIsovalue(mesh.Isovalue, view);
    baseline.Add(their);
    for (Variant& variant : variants)
    {
      ours.Reset(variant.NormalMode);
      const double our = ours.ChangeIsovalue(mesh.Isovalue, view);
      variant.First.Add(our);
      variant.Ratio.Add(our / their);
      variant.Tree.Add(ours.GetMapper()->GetTreeBuildTime());
      variant.Gradients.Add(ours.GetMapper()->GetGradientTime());
    }
  }
  const Table table = { "mesh first picture", "The first picture, from nothing",
    "On " + std::to_string(schedule.GetMostThreads()) +
      " threads: the mesh is in memory, and nothing has been built. The mapper's own normals are "
      "interpolated between gradients at the points, which for the first picture are found next to "
      "the surface.",
    { "mesh", "method", "first picture, ms", "of it, the tree, ms", "gradients, ms",
      "times that of " + theirs.Name },
    {} };
  for (const Variant& variant : variants)
  {
    report.AddRow(table,
      { mesh.Name, variant.Name, variant.First * 1e3, variant.Tree * 1e3, variant.Gradients * 1e3,
        variant.Ratio });
  }
  report.AddRow(table, { mesh.Name, theirs.Name, baseline * 1e3, Cell(), Cell(), 1.0 });
  report.Goals.push_back(
    { 3, mesh.Name + ": the first picture from nothing, this mapper against " + theirs.Name,
      variants[0].Ratio.GetMedian(), true, 1.5 });
}

}

//------------------------------------------------------------------------------
void MeasureMeshMemory(const Schedule& schedule, const MeshCase& mesh, Report& report)
{
  Log(mesh.Name + ": memory");
  const double cells = mesh.GetNumberOfCells();
  const View view = MakeOrbit(mesh.GetBounds(), 1).front();
  TracedMesh ours(mesh, schedule.Size, schedule.GetMostThreads());
  // What windows and shaders take once is not that of the mesh.
  ours.ChangeIsovalue(mesh.Isovalue, view);
  ours.Reset(Mapper::INTERPOLANT_GRADIENT);
  const double before = GetResidentMebibytes();
  ours.ChangeIsovalue(mesh.Isovalue, view);
  const auto tree = static_cast<double>(ours.GetMapper()->GetTreeMemory());
  const auto surface = static_cast<double>(ours.GetMapper()->GetSurfaceMemory());
  ours.Reset(Mapper::CENTRAL_DIFFERENCES);
  ours.ChangeIsovalue(mesh.Isovalue, view);
  const auto withGradients = static_cast<double>(ours.GetMapper()->GetTreeMemory());
  const auto triangles = ExtractMesh<vtkContour3DLinearGrid>(mesh, mesh.Isovalue);
  constexpr double kibi = 1024.0;
  report.AddRow(
    { "mesh memory", "Memory, bytes for each cell",
      "The user's arrays: points, cells and values. Growth: of the program, by two first pictures, "
      "without and with gradients. The triangles are those of vtkContour3DLinearGrid.",
      { "mesh", "cells", "the user's arrays", "tree", "what is known of the surface",
        "tree, with gradients at the points", "growth", "triangles" },
      {} },
    { mesh.Name, cells, kibi * static_cast<double>(mesh.Grid->GetActualMemorySize()) / cells,
      tree / cells, surface / cells, withGradients / cells,
      kibi * kibi * (GetResidentMebibytes() - before) / cells,
      kibi * static_cast<double>(triangles->GetActualMemorySize()) / cells });
  report.Goals.push_back({ 4, mesh.Name + ": memory beside the user's arrays, bytes a cell",
    (tree + surface) / cells, true, 8.0 });
}

//------------------------------------------------------------------------------
void MeasureMeshPictures(const Schedule& schedule, const MeshCase& mesh, Report& report)
{
  const std::vector<View> orbit = MakeOrbit(mesh.GetBounds(), schedule.Views);
  TracedMesh ours(mesh, schedule.Size, schedule.GetMostThreads());
  std::vector<PictureTimes> baselines(2);
  baselines[0].Name = "vtkContour3DLinearGrid";
  baselines[0].Drawing =
    std::make_unique<DrawnTriangles<vtkContour3DLinearGrid>>(mesh, schedule.Size);
  baselines[1].Name = "vtkContourGrid";
  baselines[1].Drawing = std::make_unique<DrawnTriangles<vtkContourGrid>>(mesh, schedule.Size);
  // What windows and shaders take once is not measured.
  ours.ChangeIsovalue(mesh.Isovalue, orbit.front());
  baselines[0].Drawing->ChangeIsovalue(mesh.Isovalue, orbit.front());
  MeasureNewIsovalue(schedule, mesh, orbit, ours, baselines, report);
  MeasureFirstPicture(schedule, mesh, orbit.front(), ours, baselines.front(), report);
}

}
