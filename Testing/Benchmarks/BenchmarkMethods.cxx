// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BenchmarkMethods.h"

#include "Contestant.h"
#include "Image/Cells/Solvers/AnalyticSolver.h"
#include "Image/Cells/Solvers/FastSolver.h"
#include "Image/Cells/Solvers/LinearSolver.h"
#include "Image/Cells/Solvers/MarmittSolver.h"
#include "Image/Cells/Solvers/RobustSolver.h"
#include "Image/ImageField.h"
#include "Image/Traversal/CellTraversal.h"

#include <vtkFlyingEdges3D.h>
#include <vtkGenericCell.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace Benchmark
{
namespace
{

using namespace vtkIsosurfaceRayTracing;
using Clock = std::chrono::steady_clock;

std::optional<Ray> MakeRay(const Input& input, const Oracle::Line& line)
{
  return ClipToVolume(line.Origin, line.Direction, line.Begin, line.End, input.Field.Dimensions);
}

//------------------------------------------------------------------------------
// The solvers of the project, through the path that draws

void CastWithSolver(const Input& input, ImageField& volume, const std::vector<Oracle::Line>& lines,
  std::vector<double>& ts)
{
  constexpr std::size_t portion = 128;
  RayHits hits;
  std::vector<std::optional<Ray>> rays;
  for (std::size_t first = 0; first < lines.size(); first += portion)
  {
    const std::size_t last = std::min(lines.size(), first + portion);
    rays.clear();
    for (std::size_t i = first; i < last; ++i)
    {
      rays.push_back(MakeRay(input, lines[i]));
    }
    volume.Trace(rays, hits);
    for (std::size_t i = first; i < last; ++i)
    {
      const std::size_t hit = hits.First[i - first];
      ts[i] = hit < hits.First[i - first + 1] ? hits.Hits[hit].T : Nothing;
    }
  }
}

/// A cell and the way of a ray through it.
struct CellProblem
{
  CellCorners Difference;
  CellSegment Segment;
};

/// The cells with corners on both sides of the isovalue, on the way of the rays to their first hit
/// and beyond.
std::vector<CellProblem> GatherCells(const Input& input, const std::vector<Oracle::Line>& lines)
{
  constexpr std::size_t enough = 20000;
  const Index3& dimensions = input.Field.Dimensions;
  const ActiveMacrocells all(MacrocellLattice(dimensions, {}));
  std::vector<CellProblem> problems;
  for (const Oracle::Line& line : lines)
  {
    const auto ray = MakeRay(input, line);
    if (!ray || problems.size() >= enough)
    {
      continue;
    }
    TraverseCells(*ray, all,
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
        if (inside != 0 && inside != 8 && SegmentInCell(*ray, cell, problem.Segment))
        {
          problems.push_back(problem);
        }
        return problems.size() >= enough;
      });
  }
  return problems;
}

/// The time of a pass over all cells, per cell: the median of several.
template <typename Pass>
double MeasurePerCell(const std::vector<CellProblem>& problems, const Pass& pass)
{
  if (problems.empty())
  {
    return 0.0;
  }
  std::vector<double> times;
  double sum = 0.0;
  for (int repeat = 0; repeat < 7; ++repeat)
  {
    const Clock::time_point start = Clock::now();
    sum += pass();
    times.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + 3, times.end());
  // The sum is used, so that the work is not thought useless.
  return sum == -1.0 ? 0.0 : times[3] / static_cast<double>(problems.size());
}

template <typename Solve>
double MeasureOneByOne(const std::vector<CellProblem>& problems, const Solve& solve)
{
  return MeasurePerCell(problems,
    [&]()
    {
      double sum = 0.0;
      for (const CellProblem& problem : problems)
      {
        solve(problem,
          [&sum](double u, bool)
          {
            sum += u;
            return true;
          });
      }
      return sum;
    });
}

double MeasureInBatches(const std::vector<CellProblem>& problems)
{
  return MeasurePerCell(problems,
    [&]()
    {
      double sum = 0.0;
      Fast::Batch batch = {};
      Fast::Roots roots;
      for (std::size_t first = 0; first + Fast::Lanes <= problems.size(); first += Fast::Lanes)
      {
        for (std::size_t lane = 0; lane < Fast::Lanes; ++lane)
        {
          const CellProblem& problem = problems[first + lane];
          for (std::size_t i = 0; i < 8; ++i)
          {
            batch.Difference[i][lane] = static_cast<float>(problem.Difference[i]);
          }
          for (std::size_t i = 0; i < 3; ++i)
          {
            batch.Entry[i][lane] = static_cast<float>(problem.Segment.Entry[i]);
            batch.Exit[i][lane] = static_cast<float>(problem.Segment.Exit[i]);
          }
        }
        Fast::Solve(batch, true, roots);
        sum += static_cast<double>(roots.U[0][0]) + roots.Found[0][0];
      }
      return sum;
    });
}

double MeasureSolver(
  RootSolver solver, int interpolations, const std::vector<CellProblem>& problems)
{
  switch (solver)
  {
    case RootSolver::Fast:
      return MeasureInBatches(problems);
    case RootSolver::Analytic:
      return MeasureOneByOne(problems,
        [](const CellProblem& p, const auto& visit)
        { Analytic::ForEachRoot(p.Difference, p.Segment, visit); });
    case RootSolver::Marmitt:
      return MeasureOneByOne(problems,
        [interpolations](const CellProblem& p, const auto& visit)
        { Marmitt::ForEachRoot(p.Difference, p.Segment, interpolations, visit); });
    case RootSolver::Linear:
      return MeasureOneByOne(problems,
        [](const CellProblem& p, const auto& visit)
        { Linear::ForEachRoot(p.Difference, p.Segment, visit); });
    default:
      return MeasureOneByOne(problems,
        [](const CellProblem& p, const auto& visit)
        { Robust::ForEachRoot(p.Difference, p.Segment, visit); });
  }
}

//------------------------------------------------------------------------------
// Rivals: samplers

/// The interpolant minus the isovalue, at a point of the volume.
double Evaluate(const Input& input, const Oracle::Line& line, double t)
{
  CellCorners corners;
  Vector3 place;
  Index3 cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double last = input.Field.Dimensions[axis] - 1;
    const double x = std::clamp(line.Origin[axis] + t * line.Direction[axis], 0.0, last);
    cell[axis] = std::min(static_cast<int>(x), input.Field.Dimensions[axis] - 2);
    place[axis] = x - cell[axis];
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    corners[static_cast<std::size_t>(corner)] =
      input.Field.At(cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2));
  }
  return Interpolate(corners, place) - input.Isovalue;
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
  return Nothing;
}

//------------------------------------------------------------------------------
// Rivals: triangles

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
      return Nothing;
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
      : Nothing;
  }

private:
  vtkNew<vtkPolyData> Mesh;
  vtkNew<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};

template <typename CastOne>
Method MakeRival(
  const Input& input, const std::string& family, const std::string& knob, const CastOne& castOne)
{
  Method method;
  method.Family = family;
  method.Knob = knob;
  method.Cast = [&input, castOne](const std::vector<Oracle::Line>& lines, std::vector<double>& ts)
  {
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      const auto ray = MakeRay(input, lines[i]);
      ts[i] = ray ? castOne(lines[i], *ray) : Nothing;
    }
  };
  return method;
}

}

//------------------------------------------------------------------------------
std::string GetSampleKnob(double distance)
{
  std::string knob = std::to_string(distance);
  knob.erase(knob.find_last_not_of('0') + 1);
  return knob + (knob.back() == '.' ? "0 cells" : " cells");
}

//------------------------------------------------------------------------------
std::vector<Method> MakeMethods(const Input& input, const std::vector<Oracle::Line>& lines)
{
  std::vector<Method> methods;
  const VolumeView view = { input.Field.Values.data(), ScalarType::Float64, input.Field.Dimensions,
    1 };
  const std::shared_ptr<ImageField> volume = ImageField::New(view, {}, 1);
  const auto cells = std::make_shared<std::vector<CellProblem>>(GatherCells(input, lines));
  const auto addSolver =
    [&](const std::string& family, const std::string& knob, RootSolver solver, int interpolations)
  {
    const TraceRequest wanted = { { { input.Isovalue, 1.0 } }, solver, interpolations };
    Method method;
    method.Family = family;
    method.Knob = knob;
    method.Cast = [&input, volume, wanted](
                    const std::vector<Oracle::Line>& castLines, std::vector<double>& ts)
    {
      volume->Select(wanted, 1);
      CastWithSolver(input, *volume, castLines, ts);
    };
    method.MeasureCell = [solver, interpolations, cells]()
    { return MeasureSolver(solver, interpolations, *cells); };
    methods.push_back(method);
  };
  addSolver("Robust", "", RootSolver::Robust, 0);
  addSolver("Fast", "", RootSolver::Fast, 0);
  addSolver("Analytic", "", RootSolver::Analytic, 0);
  for (const int interpolations : { 1, 2, 3, 4, 6, 8 })
  {
    addSolver(
      "Marmitt", "N = " + std::to_string(interpolations), RootSolver::Marmitt, interpolations);
  }
  addSolver("Linear", "", RootSolver::Linear, 0);

  for (const int bisections : { 10, 0 })
  {
    for (const double step : { 2.0, 1.0, 0.5, 0.25, 0.125 })
    {
      methods.push_back(
        MakeRival(input, bisections > 0 ? "Sampler, bisecting" : "Sampler", GetSampleKnob(step),
          [&input, step, bisections](const Oracle::Line& line, const Ray& ray)
          { return SampleLine(input, line, ray, step, bisections); }));
    }
  }
  const auto edges = Triangles::New(input, vtkSmartPointer<vtkFlyingEdges3D>::New());
  methods.push_back(MakeRival(input, "Triangles of flying edges", "",
    [edges](const Oracle::Line& line, const Ray& ray) { return edges->Cast(line, ray); }));
  const auto cubes = Triangles::New(input, vtkSmartPointer<vtkMarchingCubes>::New());
  methods.push_back(MakeRival(input, "Triangles of marching cubes", "",
    [cubes](const Oracle::Line& line, const Ray& ray) { return cubes->Cast(line, ray); }));
  return methods;
}

}
