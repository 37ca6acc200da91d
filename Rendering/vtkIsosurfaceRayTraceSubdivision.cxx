// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSubdivision.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkOrderedTriangulator.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTetra.h"

#include <array>
#include <cmath>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// Makes the points of a cell those of its parametric coordinates.
void MakeReference(vtkCell* cell)
{
  const double* place = cell->GetParametricCoords();
  for (vtkIdType i = 0; i < cell->GetNumberOfPoints(); ++i)
  {
    cell->GetPoints()->SetPoint(i, place + 3 * i);
    cell->GetPointIds()->SetId(i, i);
  }
}

/// The volume of tetrahedra between points of a cell; the ids are numbers of points.
double FindVolume(vtkCell* cell, vtkIdList* ids)
{
  double volume = 0.0;
  for (vtkIdType first = 0; first + 4 <= ids->GetNumberOfIds(); first += 4)
  {
    double corners[4][3];
    for (int i = 0; i < 4; ++i)
    {
      cell->GetPoints()->GetPoint(ids->GetId(first + i), corners[i]);
    }
    volume += std::abs(vtkTetra::ComputeVolume(corners[0], corners[1], corners[2], corners[3]));
  }
  return volume;
}

using Place = std::array<double, 3>;

/// The corners of the eight hexahedra that a hexahedron is divided into, one after the other.
std::vector<Place> PlaceHexahedra()
{
  constexpr int corners[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
    { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
  std::vector<Place> places;
  for (const auto& octant : corners)
  {
    for (const auto& corner : corners)
    {
      places.push_back({ 0.5 * (octant[0] + corner[0]), 0.5 * (octant[1] + corner[1]),
        0.5 * (octant[2] + corner[2]) });
    }
  }
  return places;
}

/// The corners of the wedges that a wedge is divided into, four in each layer.
std::vector<Place> PlaceWedges(int layers)
{
  constexpr double triangles[4][3][2] = { { { 0.0, 0.0 }, { 0.5, 0.0 }, { 0.0, 0.5 } },
    { { 0.5, 0.0 }, { 1.0, 0.0 }, { 0.5, 0.5 } }, { { 0.0, 0.5 }, { 0.5, 0.5 }, { 0.0, 1.0 } },
    { { 0.5, 0.5 }, { 0.0, 0.5 }, { 0.5, 0.0 } } };
  std::vector<Place> places;
  for (int layer = 0; layer < layers; ++layer)
  {
    for (const auto& triangle : triangles)
    {
      for (const int side : { layer, layer + 1 })
      {
        for (const auto& corner : triangle)
        {
          places.push_back({ corner[0], corner[1], static_cast<double>(side) / layers });
        }
      }
    }
  }
  return places;
}

/// The points that a cell has at some places; none if one is missing.
std::vector<vtkIdType> FindPoints(vtkCell* cell, const std::vector<Place>& places)
{
  constexpr double closest = 1e-12;
  const vtkIdType count = cell->GetNumberOfPoints();
  std::vector<vtkIdType> points;
  for (const Place& place : places)
  {
    vtkIdType point = 0;
    while (point < count &&
      vtkMath::Distance2BetweenPoints(cell->GetPoints()->GetPoint(point), place.data()) > closest)
    {
      ++point;
    }
    if (point == count)
    {
      return {};
    }
    points.push_back(point);
  }
  return points;
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSubdivision::vtkIsosurfaceRayTraceSubdivision(int type)
  : PartType(VTK_TETRA)
{
  const auto cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
  this->HasVolume = cell && cell->GetCellDimension() == 3;
  this->IsTriangulatedByPoints = type == VTK_CONVEX_POINT_SET;
  // Cells of later types may have any number of points.
  if (this->HasVolume && type < VTK_CONVEX_POINT_SET)
  {
    this->Points = cell->GetNumberOfPoints();
    this->ChooseWay(cell);
  }
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSubdivision::~vtkIsosurfaceRayTraceSubdivision() = default;

//------------------------------------------------------------------------------
/// Finds out how the cells of a type with a given number of points are divided.
void vtkIsosurfaceRayTraceSubdivision::ChooseWay(vtkCell* reference)
{
  MakeReference(reference);
  vtkNew<vtkIdList> ids;
  this->TriangulatePoints(reference, ids);
  const double volume = FindVolume(reference, ids);
  reference->Triangulate(0, ids, this->Corners);
  constexpr double rounding = 1e-9;
  if (FindVolume(reference, ids) >= (1.0 - rounding) * volume)
  {
    return;
  }
  const auto take = [&](int type, vtkIdType size, const std::vector<Place>& corners)
  {
    const std::vector<vtkIdType> parts = FindPoints(reference, corners);
    if (!parts.empty())
    {
      this->PartType = type;
      this->PartSize = size;
      this->Parts = parts;
    }
    return !parts.empty();
  };
  this->IsTriangulatedByPoints = !take(VTK_HEXAHEDRON, 8, PlaceHexahedra()) &&
    !take(VTK_WEDGE, 6, PlaceWedges(2)) && !take(VTK_WEDGE, 6, PlaceWedges(1));
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSubdivision::FindParts(vtkCell* cell, vtkIdList* ids)
{
  if (this->IsTriangulatedByPoints)
  {
    this->TriangulatePoints(cell, ids);
  }
  else if (this->Parts.empty())
  {
    if (cell->Triangulate(0, ids, this->Corners) == 0)
    {
      ids->Reset();
    }
  }
  else
  {
    ids->Reset();
    for (const vtkIdType point : this->Parts)
    {
      ids->InsertNextId(cell->GetPointId(static_cast<int>(point)));
    }
  }
}

//------------------------------------------------------------------------------
/// Finds tetrahedra between all points, which depend on the places of these and the order of their
/// ids. Neighbours divide a face alike: its points have the same places, or, in parametric
/// coordinates, places that are alike.
void vtkIsosurfaceRayTraceSubdivision::TriangulatePoints(vtkCell* cell, vtkIdList* ids)
{
  const bool hasPlaces = this->Points > 0;
  double unit[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  double* places = hasPlaces ? cell->GetParametricCoords() : nullptr;
  ids->Reset();
  this->Corners->Reset();
  const vtkIdType count = cell->GetNumberOfPoints();
  this->Triangulator->InitTriangulation(
    hasPlaces ? unit : cell->GetBounds(), static_cast<int>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    double point[3];
    cell->GetPoints()->GetPoint(i, point);
    this->Triangulator->InsertPoint(
      cell->GetPointId(static_cast<int>(i)), point, hasPlaces ? places + 3 * i : point, 0);
  }
  this->Triangulator->Triangulate();
  this->Triangulator->AddTetras(0, ids, this->Corners);
}

VTK_ABI_NAMESPACE_END
