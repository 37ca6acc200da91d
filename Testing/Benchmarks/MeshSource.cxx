// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MeshSource.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

namespace Benchmark
{
namespace
{

using Point = std::array<double, 3>;
/// A corner of a cube: x + 2 y + 4 z.
using Corners = std::vector<int>;

struct Field
{
  const char* Name;
  double (*Function)(const Point& p);
};

double GetBall(const Point& p)
{
  const double w = 3.0 * vtkMath::Pi();
  return std::hypot(p[0], p[1], p[2]) - 0.7 +
    0.12 * std::sin(w * p[0]) * std::sin(w * p[1]) * std::sin(w * p[2]);
}

double GetGyroid(const Point& p)
{
  const double w = 4.0 * vtkMath::Pi();
  return std::sin(w * p[0]) * std::cos(w * p[1]) + std::sin(w * p[1]) * std::cos(w * p[2]) +
    std::sin(w * p[2]) * std::cos(w * p[0]);
}

constexpr Field Fields[] = { { "ball", GetBall }, { "gyroid", GetGyroid } };

/// The cells in a cube, one after the other. Neighbours have mirrored tetrahedra, so that those on
/// both sides of a face share its diagonal.
const Corners& GetCorners(MeshShape shape, bool isMirrored)
{
  static const Corners hexahedron = { 0, 1, 3, 2, 4, 5, 7, 6 };
  static const Corners tetrahedra = { 0, 1, 2, 4, 3, 2, 1, 7, 5, 4, 7, 1, 6, 7, 4, 2, 1, 2, 4, 7 };
  static const Corners mirrored = { 1, 3, 0, 5, 2, 0, 3, 6, 4, 6, 5, 0, 7, 5, 6, 3, 0, 5, 3, 6 };
  return shape == MeshShape::Hexahedra ? hexahedron : isMirrored ? mirrored : tetrahedra;
}

int GetCornersOfCell(MeshShape shape)
{
  return shape == MeshShape::Hexahedra ? 8 : 4;
}

/// The numbers from 0, in order or shuffled.
std::vector<vtkIdType> MakeOrder(vtkIdType count, bool isShuffled)
{
  std::vector<vtkIdType> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), vtkIdType{ 0 });
  if (isShuffled)
  {
    std::shuffle(order.begin(), order.end(), std::mt19937_64(2001));
  }
  return order;
}

/// Between -1 and 1, the same for a number every time (splitmix64).
double GetNoise(std::uint64_t number)
{
  number += 0x9E3779B97F4A7C15U;
  number = (number ^ (number >> 30)) * 0xBF58476D1CE4E5B9U;
  number = (number ^ (number >> 27)) * 0x94D049BB133111EBU;
  number ^= number >> 31;
  return static_cast<double>(number >> 11) * 0x1p-52 - 1.0;
}

Point MakePoint(const std::array<int, 3>& place, std::uint64_t number, int edge)
{
  constexpr double jitter = 0.2;
  Point point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isInside = place[axis] > 0 && place[axis] < edge;
    const double moved = place[axis] + (isInside ? jitter * GetNoise(3 * number + axis) : 0.0);
    point[axis] = 2.0 * moved / edge - 1.0;
  }
  return point;
}

/// The points and their values, each at its place in the order.
void AddPoints(int edge, const std::vector<vtkIdType>& order, vtkUnstructuredGrid* grid)
{
  const auto count = static_cast<vtkIdType>(order.size());
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(count);
  std::vector<vtkFloatArray*> arrays;
  for (const Field& field : Fields)
  {
    vtkNew<vtkFloatArray> values;
    values->SetName(field.Name);
    values->SetNumberOfValues(count);
    grid->GetPointData()->AddArray(values);
    arrays.push_back(values);
  }
  std::size_t number = 0;
  for (int z = 0; z <= edge; ++z)
  {
    for (int y = 0; y <= edge; ++y)
    {
      for (int x = 0; x <= edge; ++x, ++number)
      {
        const Point point = MakePoint({ x, y, z }, number, edge);
        points->SetPoint(order[number], point.data());
        for (std::size_t i = 0; i < arrays.size(); ++i)
        {
          arrays[i]->SetValue(order[number], static_cast<float>(Fields[i].Function(point)));
        }
      }
    }
  }
  grid->SetPoints(points);
}

void AddCells(MeshShape shape, int edge, const std::vector<vtkIdType>& pointOrder, bool isShuffled,
  vtkUnstructuredGrid* grid)
{
  const vtkIdType cubes = static_cast<vtkIdType>(edge) * edge * edge;
  const int corners = GetCornersOfCell(shape);
  const auto cellsOfCube =
    static_cast<vtkIdType>(GetCorners(shape, false).size()) / static_cast<vtkIdType>(corners);
  const std::vector<vtkIdType> order = MakeOrder(cubes * cellsOfCube, isShuffled);
  const auto count = static_cast<vtkIdType>(order.size());
  vtkNew<vtkTypeInt64Array> offsets;
  offsets->SetNumberOfValues(count + 1);
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, corners * i);
  }
  vtkNew<vtkTypeInt64Array> connectivity;
  connectivity->SetNumberOfValues(corners * count);
  std::size_t cell = 0;
  for (vtkIdType cube = 0; cube < cubes; ++cube)
  {
    const vtkIdType x = cube % edge;
    const vtkIdType y = cube / edge % edge;
    const vtkIdType z = cube / edge / edge;
    const Corners& ofCube = GetCorners(shape, (x + y + z) % 2 != 0);
    for (std::size_t i = 0; i < ofCube.size(); i += static_cast<std::size_t>(corners), ++cell)
    {
      for (int k = 0; k < corners; ++k)
      {
        const int corner = ofCube[i + static_cast<std::size_t>(k)];
        const vtkIdType point = x + (corner & 1) +
          (edge + 1) * (y + (corner >> 1 & 1) + (edge + 1) * (z + (corner >> 2)));
        connectivity->SetValue(
          corners * order[cell] + k, pointOrder[static_cast<std::size_t>(point)]);
      }
    }
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(count);
  types->FillValue(shape == MeshShape::Hexahedra ? VTK_HEXAHEDRON : VTK_TETRA);
  grid->SetCells(types, cells);
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkUnstructuredGrid> MakeMesh(MeshShape shape, int edge, bool isShuffled)
{
  const vtkIdType points = static_cast<vtkIdType>(edge + 1) * (edge + 1) * (edge + 1);
  const std::vector<vtkIdType> order = MakeOrder(points, isShuffled);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  AddPoints(edge, order, grid);
  AddCells(shape, edge, order, isShuffled, grid);
  return grid;
}

//------------------------------------------------------------------------------
int GetMeshEdge(MeshShape shape, double cells)
{
  const double cellsOfCube = shape == MeshShape::Hexahedra ? 1.0 : 5.0;
  return std::max(1, static_cast<int>(std::lround(std::cbrt(cells / cellsOfCube))));
}

//------------------------------------------------------------------------------
std::vector<std::string> GetMeshFields()
{
  std::vector<std::string> names;
  for (const Field& field : Fields)
  {
    names.emplace_back(field.Name);
  }
  return names;
}

}
