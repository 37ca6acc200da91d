// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/PointGradients.h"

#include "Mesh/ShapeFunctions.h"

#include <cmath>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Calls visit(cell, point) for every corner of the cells that are traced.
template <typename Visit>
void ForEachCorner(const MeshCells& cells, const Visit& visit)
{
  for (std::int64_t i = 0; i < cells.GetNumberOfCells(); ++i)
  {
    MeshCell cell;
    const int count = cells.Load(i, cell) ? cell.Count : 0;
    for (int corner = 0; corner < count; ++corner)
    {
      visit(i, static_cast<std::size_t>(cell.Ids[corner]));
    }
  }
}

/// The cells around each point, in order: those of point i are from Cells[First[i]] to before
/// Cells[First[i + 1]].
struct CellsOfPoints
{
  explicit CellsOfPoints(const MeshCells& cells)
    : First(static_cast<std::size_t>(cells.GetNumberOfPoints()) + 2)
  {
    ForEachCorner(cells, [this](std::int64_t, std::size_t point) { ++this->First[point + 2]; });
    for (std::size_t i = 1; i < this->First.size(); ++i)
    {
      this->First[i] += this->First[i - 1];
    }
    this->Cells.resize(this->First.back());
    ForEachCorner(cells,
      [this](std::int64_t number, std::size_t point)
      {
        // What is the end of the point before becomes that of this point.
        this->Cells[this->First[point + 1]++] = static_cast<std::uint32_t>(number);
      });
  }

  std::vector<std::size_t> First;
  std::vector<std::uint32_t> Cells;
};

Vector3 GetGradientAtCorner(const MeshCell& cell, std::int64_t id)
{
  CornerWeights weights = {};
  for (int i = 0; i < cell.Count; ++i)
  {
    if (cell.Ids[i] == id)
    {
      weights[i] = 1.0;
      break;
    }
  }
  return GetGradient(cell, GetParametric(cell.Shape, weights));
}

}

//------------------------------------------------------------------------------
PointGradients::PointGradients(const MeshCells& cells, double unit, int threads)
  : Unit(unit)
  , Gradients(static_cast<std::size_t>(cells.GetNumberOfPoints()))
{
  const CellsOfPoints around(cells);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t id = 0; id < cells.GetNumberOfPoints(); ++id)
  {
    const auto point = static_cast<std::size_t>(id);
    Vector3 sum = {};
    double volumes = 0.0;
    for (std::size_t i = around.First[point]; i < around.First[point + 1]; ++i)
    {
      MeshCell cell;
      cells.Load(around.Cells[i], cell);
      const double volume = GetVolume(cell);
      sum = sum + GetGradientAtCorner(cell, id) * (unit * volume);
      volumes += volume;
    }
    const Vector3 mean = sum * (1.0 / volumes);
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
