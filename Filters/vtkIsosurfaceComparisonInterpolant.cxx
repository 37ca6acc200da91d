// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonInterpolant.h"

#include "vtkDataArray.h"
#include "vtkGenericCell.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStaticCellLocator.h"
#include "vtkVoxel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vtkIsosurfaceComparison
{
namespace
{

/// Whether values at the ends of an edge are on both sides of the isovalue.
bool IsCrossed(double begin, double end)
{
  return (begin >= 0.0) != (end >= 0.0) && std::isfinite(begin - end);
}

//------------------------------------------------------------------------------
/// The trilinear interpolant of an image, by VTK's own cell.
class ImageInterpolant : public Interpolant
{
public:
  explicit ImageInterpolant(vtkImageData* image)
    : Image(image)
    , Scalars(image->GetPointData()->GetScalars())
    , IndexFromWorld(image->GetPhysicalToIndexMatrix())
  {
  }

  bool GoTo(Vector& point) override;
  double GetValue() const override;
  Vector GetGradient() const override;
  double GetLengthInCells(const Vector& vector) const override;
  std::vector<EdgeCrossing> FindEdgeCrossings(double isovalue) override;

private:
  bool IsSample(const int ijk[3]) const;
  double GetSample(int ijk[3]) const;

  vtkImageData* Image;
  vtkDataArray* Scalars;
  vtkMatrix4x4* IndexFromWorld;

  struct Place
  {
    int Cell[3];
    double Parametric[3];
    /// The values at the corners: (x, y, z) is x + 2 y + 4 z.
    double Corners[8];
  };
  Place At;
};

//------------------------------------------------------------------------------
bool ImageInterpolant::GoTo(Vector& point)
{
  const int* extent = this->Image->GetExtent();
  double index[3];
  this->Image->TransformPhysicalPointToContinuousIndex(point.data(), index);
  bool isMoved = false;
  for (int i = 0; i < 3; ++i)
  {
    const double low = extent[2 * i];
    const double high = extent[2 * i + 1];
    isMoved = isMoved || index[i] < low || index[i] > high;
    index[i] = std::clamp(index[i], low, high);
    this->At.Cell[i] = std::min(static_cast<int>(std::floor(index[i])), extent[2 * i + 1] - 1);
    this->At.Parametric[i] = index[i] - this->At.Cell[i];
  }
  if (isMoved)
  {
    this->Image->TransformContinuousIndexToPhysicalPoint(index, point.data());
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    int ijk[3] = { this->At.Cell[0] + (corner & 1), this->At.Cell[1] + (corner >> 1 & 1),
      this->At.Cell[2] + (corner >> 2) };
    this->At.Corners[corner] = this->GetSample(ijk);
  }
  return true;
}

//------------------------------------------------------------------------------
double ImageInterpolant::GetValue() const
{
  double weights[8];
  vtkVoxel::InterpolationFunctions(this->At.Parametric, weights);
  return std::inner_product(weights, weights + 8, this->At.Corners, 0.0);
}

//------------------------------------------------------------------------------
Interpolant::Vector ImageInterpolant::GetGradient() const
{
  double derivatives[24];
  vtkVoxel::InterpolationDerivs(this->At.Parametric, derivatives);
  Vector gradient = { 0.0, 0.0, 0.0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* weights = derivatives + 8 * axis;
    const double perCell = std::inner_product(weights, weights + 8, this->At.Corners, 0.0);
    for (int i = 0; i < 3; ++i)
    {
      gradient[i] += this->IndexFromWorld->GetElement(axis, i) * perCell;
    }
  }
  return gradient;
}

//------------------------------------------------------------------------------
double ImageInterpolant::GetLengthInCells(const Vector& vector) const
{
  Vector cells;
  for (int i = 0; i < 3; ++i)
  {
    cells[i] = 0.0;
    for (int j = 0; j < 3; ++j)
    {
      cells[i] += this->IndexFromWorld->GetElement(i, j) * vector[j];
    }
  }
  return vtkMath::Norm(cells.data());
}

//------------------------------------------------------------------------------
bool ImageInterpolant::IsSample(const int ijk[3]) const
{
  const int* extent = this->Image->GetExtent();
  return ijk[0] >= extent[0] && ijk[0] <= extent[1] && ijk[1] >= extent[2] && ijk[1] <= extent[3] &&
    ijk[2] >= extent[4] && ijk[2] <= extent[5];
}

//------------------------------------------------------------------------------
double ImageInterpolant::GetSample(int ijk[3]) const
{
  return this->Scalars->GetComponent(this->Image->ComputePointId(ijk), 0);
}

//------------------------------------------------------------------------------
/// Of the edges that end at a corner of the cell. (Not those of the cell alone: rounding may have
/// put a point at a corner into a neighbour of the cell it belongs to.)
std::vector<Interpolant::EdgeCrossing> ImageInterpolant::FindEdgeCrossings(double isovalue)
{
  std::vector<EdgeCrossing> crossings;
  for (int edge = 0; edge < 48; ++edge)
  {
    const int corner = edge % 8;
    const int axis = edge / 16;
    const int step = (edge / 8) % 2 == 0 ? 1 : -1;
    int sample[3] = { this->At.Cell[0] + (corner & 1), this->At.Cell[1] + (corner >> 1 & 1),
      this->At.Cell[2] + (corner >> 2) };
    Vector index = { static_cast<double>(sample[0]), static_cast<double>(sample[1]),
      static_cast<double>(sample[2]) };
    sample[axis] += step;
    if (!this->IsSample(sample))
    {
      continue;
    }
    const double begin = this->At.Corners[corner] - isovalue;
    const double end = this->GetSample(sample) - isovalue;
    if (IsCrossed(begin, end))
    {
      index[axis] += step * begin / (begin - end);
      crossings.push_back({});
      this->Image->TransformContinuousIndexToPhysicalPoint(
        index.data(), crossings.back().Point.data());
    }
  }
  const Place here = this->At;
  for (EdgeCrossing& crossing : crossings)
  {
    this->GoTo(crossing.Point);
    crossing.Gradient = this->GetGradient();
  }
  this->At = here;
  return crossings;
}

//------------------------------------------------------------------------------
/// The interpolants of the cells of a mesh, by VTK's own cells.
class MeshInterpolant : public Interpolant
{
public:
  explicit MeshInterpolant(vtkDataSet* mesh)
    : Mesh(mesh)
    , Scalars(mesh->GetPointData()->GetScalars())
  {
    this->Locator->SetDataSet(mesh);
    this->Locator->BuildLocator();
  }

  bool GoTo(Vector& point) override;
  double GetValue() const override;
  Vector GetGradient() const override { return this->GetGradient(this->Parametric); }
  double GetLengthInCells(const Vector& vector) const override
  {
    return vtkMath::Norm(vector.data()) / this->EdgeLength;
  }
  std::vector<EdgeCrossing> FindEdgeCrossings(double isovalue) override;

private:
  bool GoToBorder(Vector& point);
  Vector GetGradient(const double parametric[3]) const;

  vtkDataSet* Mesh;
  vtkDataArray* Scalars;
  vtkNew<vtkStaticCellLocator> Locator;

  vtkNew<vtkGenericCell> Cell;
  /// The values at its points.
  std::vector<double> Values;
  double Parametric[3];
  std::vector<double> Weights;
  /// The mean of its edges.
  double EdgeLength;
};

//------------------------------------------------------------------------------
bool MeshInterpolant::GoTo(Vector& point)
{
  this->Weights.resize(static_cast<std::size_t>(std::max(this->Mesh->GetMaxCellSize(), 1)));
  const vtkIdType number =
    this->Locator->FindCell(point.data(), 0.0, this->Cell, this->Parametric, this->Weights.data());
  if (number < 0 && !this->GoToBorder(point))
  {
    return false;
  }
  if (this->Cell->GetCellDimension() != 3)
  {
    return false;
  }
  this->Values.clear();
  for (vtkIdType i = 0; i < this->Cell->GetNumberOfPoints(); ++i)
  {
    this->Values.push_back(this->Scalars->GetComponent(this->Cell->GetPointId(i), 0));
  }
  const int edges = this->Cell->GetNumberOfEdges();
  double sum = 0.0;
  for (int i = 0; i < edges; ++i)
  {
    sum += std::sqrt(this->Cell->GetEdge(i)->GetLength2());
  }
  this->EdgeLength = sum / edges;
  return true;
}

//------------------------------------------------------------------------------
/// Moves a point to the cell that it is beside, by rounding.
bool MeshInterpolant::GoToBorder(Vector& point)
{
  const double radius = 1e-6 * this->Mesh->GetLength();
  Vector nearest;
  vtkIdType number;
  int subId;
  double square;
  if (this->Locator->FindClosestPointWithinRadius(
        point.data(), radius, nearest.data(), this->Cell, number, subId, square) == 0)
  {
    return false;
  }
  point = nearest;
  double closest[3];
  this->Cell->EvaluatePosition(
    point.data(), closest, subId, this->Parametric, square, this->Weights.data());
  return true;
}

//------------------------------------------------------------------------------
double MeshInterpolant::GetValue() const
{
  return std::inner_product(this->Values.begin(), this->Values.end(), this->Weights.begin(), 0.0);
}

//------------------------------------------------------------------------------
Interpolant::Vector MeshInterpolant::GetGradient(const double parametric[3]) const
{
  Vector gradient;
  this->Cell->Derivatives(0, parametric, this->Values.data(), 1, gradient.data());
  return gradient;
}

//------------------------------------------------------------------------------
/// Of the edges of the cell. Those of quadratic cells are curved, and left out.
std::vector<Interpolant::EdgeCrossing> MeshInterpolant::FindEdgeCrossings(double isovalue)
{
  std::vector<EdgeCrossing> crossings;
  for (int i = 0; i < this->Cell->GetNumberOfEdges(); ++i)
  {
    vtkCell* edge = this->Cell->GetEdge(i);
    const double begin = this->Scalars->GetComponent(edge->GetPointId(0), 0) - isovalue;
    const double end = this->Scalars->GetComponent(edge->GetPointId(1), 0) - isovalue;
    if (edge->GetNumberOfPoints() == 2 && IsCrossed(begin, end))
    {
      Vector from;
      Vector to;
      edge->GetPoints()->GetPoint(0, from.data());
      edge->GetPoints()->GetPoint(1, to.data());
      EdgeCrossing crossing;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        crossing.Point[axis] = from[axis] + begin / (begin - end) * (to[axis] - from[axis]);
      }
      Vector closest;
      double parametric[3];
      int subId;
      double square;
      this->Cell->EvaluatePosition(
        crossing.Point.data(), closest.data(), subId, parametric, square, this->Weights.data());
      crossing.Gradient = this->GetGradient(parametric);
      crossings.push_back(crossing);
    }
  }
  return crossings;
}

}

//------------------------------------------------------------------------------
std::unique_ptr<Interpolant> Interpolant::New(vtkDataSet* data)
{
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    return std::make_unique<ImageInterpolant>(image);
  }
  return std::make_unique<MeshInterpolant>(data);
}

}
