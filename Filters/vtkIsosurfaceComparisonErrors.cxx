// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonErrors.h"

#include "vtkIsosurfaceComparisonInterpolant.h"
#include "vtkIsosurfaceComparisonMethods.h"
#include "vtkIsosurfaceComparisonRow.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTriangle.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

namespace vtkIsosurfaceComparison
{
namespace
{

using Vector = Interpolant::Vector;

/// Lines begin this far before the point, in cells: a point on the isosurface must not lie at the
/// very beginning, where rounding decides whether the surface is crossed.
constexpr double StepBack = 1e-6;

//------------------------------------------------------------------------------
/// A point of a surface, and where the interpolant is asked for it: there, or where the point is
/// moved to if it is outside.
struct PointAndPlace
{
  std::size_t Id;
  Vector Point;
  Vector Place;

  Vector GetWay() const
  {
    return { this->Place[0] - this->Point[0], this->Place[1] - this->Point[1],
      this->Place[2] - this->Point[2] };
  }
};

//------------------------------------------------------------------------------
/// Lines that begin a little before the places of points of a surface and are measured in cells
/// from there.
struct Lines
{
  vtkNew<vtkPoints> Origins;
  vtkNew<vtkDoubleArray> Directions;
  /// Of which point a line is, how long its direction is in the world, and how far the point is
  /// from its place, in cells and in the world.
  struct Line
  {
    std::size_t PointId;
    double Scale;
    double CellsBefore;
    double WorldBefore;
  };
  std::vector<Line> All;

  Lines()
  {
    this->Origins->SetDataTypeToDouble();
    this->Directions->SetNumberOfComponents(3);
  }

  /// The direction is one cell long. The interpolant is at the place.
  void Add(const PointAndPlace& point, const Vector& direction, const Interpolant& interpolant)
  {
    this->Origins->InsertNextPoint(point.Place[0] - StepBack * direction[0],
      point.Place[1] - StepBack * direction[1], point.Place[2] - StepBack * direction[2]);
    this->Directions->InsertNextTuple(direction.data());
    const Vector way = point.GetWay();
    this->All.push_back({ point.Id, vtkMath::Norm(direction.data()),
      interpolant.GetLengthInCells(way), vtkMath::Norm(way.data()) });
  }
};

//------------------------------------------------------------------------------
double AngleBetweenLines(const double a[3], const double b[3])
{
  // vtkMath::AngleBetweenVectors is 0 for a vector of length 0.
  if (vtkMath::Norm(a) == 0.0 || vtkMath::Norm(b) == 0.0)
  {
    return NotMeasured;
  }
  const double angle = vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(a, b));
  return std::min(angle, 180.0 - angle);
}

//------------------------------------------------------------------------------
void CastLines(
  TracedIsosurface& isosurface, const Lines& lines, vtkDataArray* normals, SurfaceErrors& errors)
{
  vtkNew<vtkPolyData> hits;
  if (!isosurface.CastRays(lines.Origins, lines.Directions, hits))
  {
    return;
  }
  auto* rays = vtkIdTypeArray::SafeDownCast(hits->GetPointData()->GetArray("RayId"));
  vtkDataArray* ts = hits->GetPointData()->GetArray("T");
  vtkDataArray* hitNormals = hits->GetPointData()->GetArray("Normals");
  for (vtkIdType hit = 0; hit < hits->GetNumberOfPoints(); ++hit)
  {
    const Lines::Line& line = lines.All[static_cast<std::size_t>(rays->GetValue(hit))];
    const std::size_t point = line.PointId;
    double normal[3];
    double hitNormal[3];
    normals->GetTuple(static_cast<vtkIdType>(point), normal);
    hitNormals->GetTuple(hit, hitNormal);
    const double cells = std::abs(ts->GetComponent(hit, 0) - StepBack);
    errors.Cells[point] = line.CellsBefore + cells;
    errors.World[point] = line.WorldBefore + cells * line.Scale;
    errors.Angles[point] = AngleBetweenLines(normal, hitNormal);
  }
}

//------------------------------------------------------------------------------
/// Keeps the crossing nearest to a point of the edges around its place, where the interpolant is,
/// if it is nearer than what was found.
void TryEdges(Interpolant& interpolant, const PointAndPlace& at, double isovalue,
  const double normal[3], SurfaceErrors& errors)
{
  for (const Interpolant::EdgeCrossing& crossing : interpolant.FindEdgeCrossings(isovalue))
  {
    const Vector way = PointAndPlace{ at.Id, at.Point, crossing.Point }.GetWay();
    const double world = vtkMath::Norm(way.data());
    if (!(errors.World[at.Id] <= world))
    {
      errors.World[at.Id] = world;
      errors.Cells[at.Id] = interpolant.GetLengthInCells(way);
      errors.Angles[at.Id] = AngleBetweenLines(normal, crossing.Gradient.data());
    }
  }
}

//------------------------------------------------------------------------------
double Quantile(const std::vector<double>& sorted, double share)
{
  if (sorted.empty())
  {
    return NotMeasured;
  }
  const auto last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(share * last))];
}

//------------------------------------------------------------------------------
std::vector<double> SortedNumbers(const std::vector<double>& values, std::size_t first)
{
  std::vector<double> numbers;
  std::copy_if(values.begin() + static_cast<std::ptrdiff_t>(first), values.end(),
    std::back_inserter(numbers), [](double value) { return !std::isnan(value); });
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}

//------------------------------------------------------------------------------
SurfaceErrors MeasureErrors(vtkDataSet* data, TracedIsosurface& isosurface, double isovalue,
  vtkPoints* points, vtkDataArray* normals, const std::function<bool()>& isAborted)
{
  constexpr std::size_t portion = 1 << 16;
  const std::unique_ptr<Interpolant> interpolant = Interpolant::New(data);
  const auto count = static_cast<std::size_t>(points->GetNumberOfPoints());
  SurfaceErrors errors;
  errors.Cells.assign(count, NotMeasured);
  errors.World.assign(count, NotMeasured);
  errors.Angles.assign(count, NotMeasured);
  isosurface.UseExactNormals();
  for (std::size_t first = 0; first < count && !isAborted(); first += portion)
  {
    const std::size_t last = std::min(count, first + portion);
    std::vector<PointAndPlace> inside;
    Lines lines;
    for (std::size_t i = first; i < last; ++i)
    {
      PointAndPlace at{ i, {}, {} };
      points->GetPoint(static_cast<vtkIdType>(i), at.Point.data());
      at.Place = at.Point;
      if (!interpolant->GoTo(at.Place))
      {
        continue;
      }
      inside.push_back(at);
      const Vector gradient = interpolant->GetGradient();
      const double cells = interpolant->GetLengthInCells(gradient);
      if (cells > 0.0 && std::isfinite(cells))
      {
        const double scale = (interpolant->GetValue() < isovalue ? 1.0 : -1.0) / cells;
        lines.Add(
          at, { scale * gradient[0], scale * gradient[1], scale * gradient[2] }, *interpolant);
      }
    }
    CastLines(isosurface, lines, normals, errors);
    for (PointAndPlace& at : inside)
    {
      if (interpolant->GoTo(at.Place))
      {
        double normal[3];
        normals->GetTuple(static_cast<vtkIdType>(at.Id), normal);
        TryEdges(*interpolant, at, isovalue, normal, errors);
      }
    }
  }
  return errors;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> FiniteTriangles(vtkPolyData* mesh, const double place[3])
{
  std::vector<bool> isFinite(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double point[3];
    mesh->GetPoint(i, point);
    const bool isPlace =
      std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
    points->SetPoint(i, isPlace ? point : place);
    isFinite[static_cast<std::size_t>(i)] = isPlace;
  }
  if (std::all_of(isFinite.begin(), isFinite.end(), [](bool is) { return is; }))
  {
    return mesh;
  }
  vtkNew<vtkCellArray> triangles;
  const auto iterator = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    if (std::all_of(ids, ids + size,
          [&isFinite](vtkIdType i) { return isFinite[static_cast<std::size_t>(i)]; }))
    {
      triangles->InsertNextCell(size, ids);
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(triangles);
  return result;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> CutAtCentroids(vtkPolyData* mesh)
{
  const vtkIdType vertices = mesh->GetNumberOfPoints();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vertices + mesh->GetNumberOfPolys());
  for (vtkIdType i = 0; i < vertices; ++i)
  {
    points->SetPoint(i, mesh->GetPoint(i));
  }
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(3 * mesh->GetNumberOfPolys(), 9 * mesh->GetNumberOfPolys());
  vtkIdType centroid = vertices;
  const auto iterator = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    double corners[3][3];
    double middle[3];
    for (int i = 0; i < 3; ++i)
    {
      mesh->GetPoint(ids[i], corners[i]);
    }
    vtkTriangle::TriangleCenter(corners[0], corners[1], corners[2], middle);
    points->SetPoint(centroid, middle);
    for (int i = 0; i < 3; ++i)
    {
      triangles->InsertNextCell({ ids[i], ids[(i + 1) % 3], centroid });
    }
    ++centroid;
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(triangles);
  return result;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataArray> NormalsOfCentroids(vtkPolyData* mesh)
{
  auto normals = vtkSmartPointer<vtkDoubleArray>::New();
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh->GetNumberOfPoints() + mesh->GetNumberOfPolys());
  normals->Fill(0.0);
  vtkIdType centroid = mesh->GetNumberOfPoints();
  const auto iterator = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    double normal[3];
    vtkTriangle::ComputeNormal(mesh->GetPoints(), 3, ids, normal);
    normals->SetTuple(centroid++, normal);
  }
  return normals;
}

//------------------------------------------------------------------------------
void Summarize(const SurfaceErrors& errors, std::size_t first, Row& row)
{
  const std::vector<double> cells = SortedNumbers(errors.Cells, first);
  row.MedianDistanceInCells = Quantile(cells, 0.5);
  row.P99DistanceInCells = Quantile(cells, 0.99);
  row.MaximumDistanceInCells = Quantile(cells, 1.0);
  const std::vector<double> world = SortedNumbers(errors.World, first);
  row.MedianDistance = Quantile(world, 0.5);
  row.P99Distance = Quantile(world, 0.99);
  row.MaximumDistance = Quantile(world, 1.0);
  const std::vector<double> angles = SortedNumbers(errors.Angles, first);
  row.MedianNormalError = Quantile(angles, 0.5);
  row.P99NormalError = Quantile(angles, 0.99);
  row.MaximumNormalError = Quantile(angles, 1.0);
  row.LostPoints = static_cast<double>(errors.Cells.size() - first - cells.size());
}

}
