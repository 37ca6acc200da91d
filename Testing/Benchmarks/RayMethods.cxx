// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "RayMethods.h"

#include "Image/Cells/Solvers/AnalyticSolver.h"
#include "Image/Cells/Solvers/LinearSolver.h"
#include "Image/Cells/Solvers/MarmittSolver.h"
#include "Image/Cells/Solvers/RobustSolver.h"
#include "Image/ImageField.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Traversal/CellTraversal.h"
#include "IsosurfaceRenderer.h"
#include "Samples.h"
#include "SinglePrecisionSolver.h"

#include <vtkFlyingEdges3D.h>
#include <vtkGenericCell.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace Benchmark
{
namespace
{

using namespace vtkIsosurfaceRayTracing;

std::optional<Ray> MakeRay(const Input& input, const Oracle::Line& line)
{
  return ClipToVolume(line.Origin, line.Direction, line.Begin, line.End, input.Field.Dimensions);
}

//------------------------------------------------------------------------------
// The solvers of the project, through the path that draws

void CastWithSolver(
  ImageField& volume, const std::vector<Oracle::Line>& lines, std::vector<double>& ts)
{
  constexpr std::size_t portion = RayPacket::Capacity;
  RayHits hits;
  RayPacket packet;
  for (std::size_t first = 0; first < lines.size(); first += portion)
  {
    const std::size_t last = std::min(lines.size(), first + portion);
    packet.Count = 0;
    packet.Exists = {};
    for (std::size_t i = first; i < last; ++i)
    {
      volume.AddRay(lines[i].Origin, lines[i].Direction, lines[i].Begin, lines[i].End, packet);
    }
    volume.Trace(packet, hits);
    for (std::size_t i = first; i < last; ++i)
    {
      const std::size_t hit = hits.First[i - first];
      ts[i] = hit < hits.First[i - first + 1] ? hits.Hits[hit].T : NoHit;
    }
  }
}

//------------------------------------------------------------------------------
// Cells one by one

/// A cell and the segment of a ray in it.
struct CellProblem
{
  CellCorners Difference;
  CellSegment Segment;
};

/// Calls visit(problem) for the cells of a ray that have corners on both sides of the isovalue, in
/// order, until it returns true.
template <typename Visit>
void VisitProblems(
  const Input& input, const ActiveMacrocells& active, const Ray& ray, const Visit& visit)
{
  TraverseCells(ray, active,
    [&](const Index3& cell)
    {
      CellProblem problem;
      for (int corner = 0; corner < 8; ++corner)
      {
        problem.Difference[static_cast<std::size_t>(corner)] =
          input.Field.At(
            cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)) -
          input.Isovalue;
      }
      const auto inside =
        std::count_if(problem.Difference.begin(), problem.Difference.end(), IsInside<double>);
      return inside != 0 && inside != 8 && SegmentInCell(ray, cell, problem.Segment) &&
        visit(problem);
    });
}

/// Problems to measure solvers with, on the way of the rays to their first hit and beyond.
std::vector<CellProblem> GatherProblems(
  const Input& input, const ActiveMacrocells& active, const std::vector<Oracle::Line>& lines)
{
  constexpr std::size_t enough = 20000;
  std::vector<CellProblem> problems;
  for (const Oracle::Line& line : lines)
  {
    const auto ray = MakeRay(input, line);
    if (ray && problems.size() < enough)
    {
      VisitProblems(input, active, *ray,
        [&problems](const CellProblem& problem)
        {
          problems.push_back(problem);
          return problems.size() >= enough;
        });
    }
  }
  return problems;
}

/// The first hit by a solver in single precision, cell after cell.
double CastInSinglePrecision(const Input& input, const ActiveMacrocells& active, const Ray& ray)
{
  double found = NoHit;
  VisitProblems(input, active, ray,
    [&](const CellProblem& problem)
    {
      SinglePrecision::ForEachRoot(problem.Difference, problem.Segment,
        [&](float u, bool)
        {
          const CellSegment& segment = problem.Segment;
          found = ray.Base + segment.Begin + (segment.End - segment.Begin) * u;
          return true;
        });
      return !std::isnan(found);
    });
  return found;
}

/// The time to solve a problem: the median of several passes over all.
template <typename Solve>
double MeasureSolver(const std::vector<CellProblem>& problems, const Solve& solve)
{
  constexpr int passes = 7;
  Benchmark::Samples seconds;
  double sum = 0.0;
  for (int pass = 0; pass < passes && !problems.empty(); ++pass)
  {
    seconds.Add(Measure(
      [&]()
      {
        for (const CellProblem& problem : problems)
        {
          solve(problem,
            [&sum](double u, bool)
            {
              sum += u;
              return true;
            });
        }
      }));
  }
  // The sum is used, so that the work is not optimized away.
  return seconds.IsEmpty() || sum == -1.0
    ? NotMeasured
    : 1e9 * seconds.GetMedian() / static_cast<double>(problems.size());
}

//------------------------------------------------------------------------------
// Baselines: samplers

/// The interpolant minus the isovalue, at a point of the volume.
double Evaluate(const Input& input, const Oracle::Line& line, double t)
{
  CellCorners corners;
  Vector3 parametric;
  Index3 cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double last = input.Field.Dimensions[axis] - 1;
    const double x = std::clamp(line.Origin[axis] + t * line.Direction[axis], 0.0, last);
    cell[axis] = std::min(static_cast<int>(x), input.Field.Dimensions[axis] - 2);
    parametric[axis] = x - cell[axis];
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    corners[static_cast<std::size_t>(corner)] =
      input.Field.At(cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2));
  }
  return Interpolate(corners, parametric) - input.Isovalue;
}

/// Samples at steps along the line; where two in turn differ in sign, the second is the hit (as in
/// VTK's GPU mode), or a bisection between them (as in Open VKL, at most 10).
double SampleLine(
  const Input& input, const Oracle::Line& line, const Ray& ray, double step, int bisections)
{
  const double begin = ray.Base + ray.Begin;
  const double end = ray.Base + ray.End;
  bool wasInside = IsInside(Evaluate(input, line, begin));
  for (double t = begin + step; t < end; t += step)
  {
    if (IsInside(Evaluate(input, line, t)) != wasInside)
    {
      double lo = t - step;
      double hi = t;
      for (int i = 0; i < bisections; ++i)
      {
        const double middle = 0.5 * (lo + hi);
        (IsInside(Evaluate(input, line, middle)) == wasInside ? lo : hi) = middle;
      }
      return bisections == 0 ? hi : 0.5 * (lo + hi);
    }
  }
  return NoHit;
}

//------------------------------------------------------------------------------
// Baselines: triangles

/// The triangles of a filter, in a structure that lines can be cast at.
class Triangles
{
public:
  template <typename Filter>
  static std::shared_ptr<Triangles> New(const Input& input, vtkSmartPointer<Filter> filter)
  {
    filter->SetInputData(input.Image);
    filter->SetValue(0, input.Isovalue);
    filter->ComputeNormalsOff();
    filter->ComputeScalarsOff();
    filter->Update();
    auto triangles = std::make_shared<Triangles>();
    triangles->Mesh->ShallowCopy(filter->GetOutput());
    if (triangles->Mesh->GetNumberOfCells() > 0)
    {
      triangles->Locator->SetDataSet(triangles->Mesh);
      triangles->Locator->BuildLocator();
    }
    return triangles;
  }

  double Cast(const Oracle::Line& line, const Ray& ray)
  {
    if (this->Mesh->GetNumberOfCells() == 0)
    {
      return NoHit;
    }
    const double begin = ray.Base + ray.Begin;
    const double end = ray.Base + ray.End;
    double from[3];
    double to[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      from[axis] = line.Origin[axis] + begin * line.Direction[axis];
      to[axis] = line.Origin[axis] + end * line.Direction[axis];
    }
    double fraction;
    double x[3];
    double parametric[3];
    int subId;
    vtkIdType cell;
    return this->Locator->IntersectWithLine(
             from, to, 0.0, fraction, x, parametric, subId, cell, this->Cell) != 0
      ? begin + fraction * (end - begin)
      : NoHit;
  }

private:
  vtkNew<vtkPolyData> Mesh;
  vtkNew<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};

//------------------------------------------------------------------------------
// All of them, made ready for an input

ActiveMacrocells FindActive(
  const vtkIsosurfaceRayTracing::Samples<double>& samples, double isovalue)
{
  MacrocellHierarchy<double> hierarchy(samples, { 4, 4, 4 });
  while (hierarchy.GetFractionRead() < 1.0)
  {
    hierarchy.ReadSlab(1);
  }
  return hierarchy.FindActive({ isovalue }, 1);
}

/// What solvers share.
struct PreparedInput
{
  PreparedInput(const Benchmark::Input& input, const std::vector<Oracle::Line>& lines)
    : Input(input)
    , View{ input.Field.Values.data(), ScalarType::Float64, input.Field.Dimensions, 1 }
    , Volume(ImageField::New(this->View, {}, 1))
    , Active(FindActive(vtkIsosurfaceRayTracing::Samples<double>(this->View), input.Isovalue))
    , Problems(GatherProblems(input, this->Active, lines))
  {
  }

  const Benchmark::Input& Input;
  VolumeView View;
  std::unique_ptr<ImageField> Volume;
  ActiveMacrocells Active;
  std::vector<CellProblem> Problems;
};

/// A method that casts ray by ray.
template <typename CastOne>
RayMethod MakeMethod(const Input& input, const std::string& family, const std::string& parameter,
  const CastOne& castOne)
{
  RayMethod method;
  method.Family = family;
  method.Parameter = parameter;
  method.Cast = [&input, castOne](const std::vector<Oracle::Line>& lines, std::vector<double>& ts)
  {
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      const auto ray = MakeRay(input, lines[i]);
      ts[i] = ray ? castOne(lines[i], *ray) : NoHit;
    }
  };
  return method;
}

/// A solver of the project, which is chosen by the request and measured by itself as solve.
template <typename Solve>
RayMethod MakeSolverMethod(const std::shared_ptr<PreparedInput>& prepared,
  const std::string& family, const std::string& parameter, RootSolver solver, int interpolations,
  const Solve& solve)
{
  const TraceRequest request = { { { prepared->Input.Isovalue, 1.0 } }, solver, interpolations };
  RayMethod method;
  method.Family = family;
  method.Parameter = parameter;
  method.Cast = [prepared, request](const std::vector<Oracle::Line>& lines, std::vector<double>& ts)
  {
    prepared->Volume->Select(request, {});
    CastWithSolver(*prepared->Volume, lines, ts);
  };
  method.MeasureCell = [prepared, solve]() { return MeasureSolver(prepared->Problems, solve); };
  return method;
}

RayMethod MakeSinglePrecisionMethod(const std::shared_ptr<PreparedInput>& prepared)
{
  RayMethod method = MakeMethod(prepared->Input, "Single precision", "",
    [prepared](const Oracle::Line&, const Ray& ray)
    { return CastInSinglePrecision(prepared->Input, prepared->Active, ray); });
  method.MeasureCell = [prepared]()
  {
    return MeasureSolver(prepared->Problems,
      [](const CellProblem& p, const auto& visit)
      { SinglePrecision::ForEachRoot(p.Difference, p.Segment, visit); });
  };
  return method;
}

void AddSolvers(
  const Input& input, const std::vector<Oracle::Line>& lines, std::vector<RayMethod>& methods)
{
  const auto prepared = std::make_shared<PreparedInput>(input, lines);
  methods.push_back(MakeSolverMethod(prepared, "Robust", "", RootSolver::Robust, 0,
    [](const CellProblem& p, const auto& visit)
    { Robust::ForEachRoot(p.Difference, p.Segment, visit); }));
  methods.push_back(MakeSinglePrecisionMethod(prepared));
  methods.push_back(MakeSolverMethod(prepared, "Analytic", "", RootSolver::Analytic, 0,
    [](const CellProblem& p, const auto& visit)
    { Analytic::ForEachRoot(p.Difference, p.Segment, visit); }));
  for (const int n : { 1, 2, 3, 4, 6, 8 })
  {
    methods.push_back(
      MakeSolverMethod(prepared, "Marmitt", "N = " + std::to_string(n), RootSolver::Marmitt, n,
        [n](const CellProblem& p, const auto& visit)
        { Marmitt::ForEachRoot(p.Difference, p.Segment, n, visit); }));
  }
  methods.push_back(MakeSolverMethod(prepared, "Linear", "", RootSolver::Linear, 0,
    [](const CellProblem& p, const auto& visit)
    { Linear::ForEachRoot(p.Difference, p.Segment, visit); }));
}

void AddSamplers(const Input& input, std::vector<RayMethod>& methods)
{
  for (const int bisections : { 10, 0 })
  {
    for (const double step : { 2.0, 1.0, 0.5, 0.25, 0.125 })
    {
      methods.push_back(
        MakeMethod(input, bisections > 0 ? "Sampler, bisecting" : "Sampler", FormatDistance(step),
          [&input, step, bisections](const Oracle::Line& line, const Ray& ray)
          { return SampleLine(input, line, ray, step, bisections); }));
    }
  }
}

template <typename Filter>
void AddTriangles(const Input& input, const std::string& family, std::vector<RayMethod>& methods)
{
  const auto triangles = Triangles::New(input, vtkSmartPointer<Filter>::New());
  methods.push_back(MakeMethod(input, family, "",
    [triangles](const Oracle::Line& line, const Ray& ray) { return triangles->Cast(line, ray); }));
}

}

//------------------------------------------------------------------------------
std::string FormatDistance(double distance)
{
  std::string text = std::to_string(distance);
  text.erase(text.find_last_not_of('0') + 1);
  return text + (text.back() == '.' ? "0 cells" : " cells");
}

//------------------------------------------------------------------------------
std::vector<RayMethod> MakeRayMethods(const Input& input, const std::vector<Oracle::Line>& lines)
{
  std::vector<RayMethod> methods;
  AddSolvers(input, lines, methods);
  AddSamplers(input, methods);
  AddTriangles<vtkFlyingEdges3D>(input, "Triangles of flying edges", methods);
  AddTriangles<vtkMarchingCubes>(input, "Triangles of marching cubes", methods);
  return methods;
}

}
