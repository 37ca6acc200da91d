// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/PointGradients.h"

#include "Mesh/ShapeFunctions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{
namespace
{

Vector3 GetGradientAtCorner(const MeshCell& cell, int corner)
{
  CornerWeights weights = {};
  weights[corner] = 1.0;
  return GetGradient(cell, GetParametric(cell.Shape, weights));
}

/// The sum of the gradients around a point, each times the volume of its cell, and of the volumes.
struct WeightedSum
{
  Vector3 Gradients = {};
  double Volumes = 0.0;

  void Add(const Vector3& gradient, double volume, double unit)
  {
    this->Gradients = this->Gradients + gradient * (unit * volume);
    this->Volumes += volume;
  }
};

/// Points with consecutive ids.
struct PointRange
{
  std::int64_t First;
  std::int64_t Last;

  bool Has(std::int64_t id) const { return id >= this->First && id < this->Last; }
};

/// Adds all cells to the sums of their corners in a range, in the order of the cells.
void AddCells(
  const MeshCells& cells, const PointRange& range, double unit, std::vector<WeightedSum>& sums)
{
  for (std::int64_t number = 0; number < cells.GetNumberOfCells(); ++number)
  {
    MeshCell cell;
    if (!cells.LoadIds(number, cell) ||
      std::none_of(
        cell.Ids, cell.Ids + cell.Count, [&range](std::int64_t id) { return range.Has(id); }) ||
      !cells.LoadCorners(cell))
    {
      continue;
    }
    const double volume = GetVolume(cell);
    const bool isConstant = cell.Shape == CellShape::Tetrahedron;
    Vector3 gradient = GetGradientAtCorner(cell, 0);
    for (int corner = 0; corner < cell.Count; ++corner)
    {
      if (range.Has(cell.Ids[corner]))
      {
        gradient = isConstant || corner == 0 ? gradient : GetGradientAtCorner(cell, corner);
        sums[static_cast<std::size_t>(cell.Ids[corner])].Add(gradient, volume, unit);
      }
    }
  }
}

}

//------------------------------------------------------------------------------
PointGradients::PointGradients(const MeshCells& cells, double unit, int threads)
  : Unit(unit)
  , Gradients(static_cast<std::size_t>(cells.GetNumberOfPoints()))
{
  const std::int64_t count = cells.GetNumberOfPoints();
  std::vector<WeightedSum> sums(this->Gradients.size());
  // Each thread looks at all cells, but sums at points of its own: the order is always the same.
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int part = 0; part < threads; ++part)
  {
    AddCells(cells, { count * part / threads, count * (part + 1) / threads }, unit, sums);
  }
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t id = 0; id < count; ++id)
  {
    const auto point = static_cast<std::size_t>(id);
    const Vector3 mean = sums[point].Gradients * (1.0 / sums[point].Volumes);
    constexpr double largest = 1e30;
    if (!(std::abs(mean[0]) + std::abs(mean[1]) + std::abs(mean[2]) < largest))
    {
      continue; // It stays zero: the gradient of the cell is taken instead.
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Gradients[point][axis] = static_cast<float>(mean[axis]);
    }
  }
}

//------------------------------------------------------------------------------
Vector3 PointGradients::Get(const MeshCell& cell, const Vector3& parametric) const
{
  CornerWeights weights;
  GetWeights(cell.Shape, parametric, weights);
  Vector3 gradient = {};
  for (int i = 0; i < cell.Count; ++i)
  {
    const std::array<float, 3>& corner = this->Gradients[static_cast<std::size_t>(cell.Ids[i])];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      gradient[axis] += weights[i] * static_cast<double>(corner[axis]);
    }
  }
  return gradient * (1.0 / this->Unit);
}

}
