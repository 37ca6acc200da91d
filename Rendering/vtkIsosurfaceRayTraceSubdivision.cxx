// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSubdivision.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkGenericCell.h"
#include "vtkHigherOrderHexahedron.h"
#include "vtkHigherOrderWedge.h"
#include "vtkIdList.h"
#include "vtkOrderedTriangulator.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTetra.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

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

/// The volume of tetrahedra, given by their corners.
double FindVolume(vtkPoints* points)
{
  double volume = 0.0;
  for (vtkIdType first = 0; first + 4 <= points->GetNumberOfPoints(); first += 4)
  {
    double corners[4][3];
    for (int i = 0; i < 4; ++i)
    {
      points->GetPoint(first + i, corners[i]);
    }
    volume += std::abs(vtkTetra::ComputeVolume(corners[0], corners[1], corners[2], corners[3]));
  }
  return volume;
}

/// How many parts there are along each parametric axis, and a place on the lattice between them.
using Order = std::array<int, 3>;
using Place = std::array<int, 3>;

/// The corners of the hexahedra that a hexahedron is divided into, one after the other.
std::vector<Place> PlaceHexahedra(const Order& order)
{
  std::vector<Place> places;
  for (int k = 0; k < order[2]; ++k)
  {
    for (int j = 0; j < order[1]; ++j)
    {
      for (int i = 0; i < order[0]; ++i)
      {
        for (const int side : { k, k + 1 })
        {
          places.insert(places.end(),
            { { i, j, side }, { i + 1, j, side }, { i + 1, j + 1, side }, { i, j + 1, side } });
        }
      }
    }
  }
  return places;
}

/// The corners of the wedges that a wedge is divided into, layer by layer.
std::vector<Place> PlaceWedges(const Order& order)
{
  std::vector<Place> places;
  for (int k = 0; k < order[2]; ++k)
  {
    for (int j = 0; j < order[0]; ++j)
    {
      for (int i = 0; i + j < order[0]; ++i)
      {
        for (const int side : { k, k + 1 })
        {
          places.insert(places.end(), { { i, j, side }, { i + 1, j, side }, { i, j + 1, side } });
        }
        if (i + j + 1 == order[0])
        {
          continue;
        }
        for (const int side : { k, k + 1 })
        {
          places.insert(
            places.end(), { { i + 1, j + 1, side }, { i, j + 1, side }, { i + 1, j, side } });
        }
      }
    }
  }
  return places;
}

/// The points that a cell has at some places; none if one is missing.
std::vector<vtkIdType> FindPoints(
  vtkCell* cell, const Order& order, const std::vector<Place>& places)
{
  constexpr double rounding = 1e-6;
  const double* coordinates = cell->GetParametricCoords();
  std::map<Place, vtkIdType> lattice;
  for (vtkIdType i = 0; i < cell->GetNumberOfPoints(); ++i)
  {
    Place place;
    bool isOnLattice = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double coordinate = order[axis] * coordinates[3 * i + axis];
      place[axis] = static_cast<int>(std::lround(coordinate));
      isOnLattice = isOnLattice && std::abs(coordinate - place[axis]) < rounding;
    }
    if (isOnLattice)
    {
      lattice.emplace(place, i);
    }
  }
  std::vector<vtkIdType> points;
  for (const Place& place : places)
  {
    const auto point = lattice.find(place);
    if (point == lattice.end())
    {
      return {};
    }
    points.push_back(point->second);
  }
  return points;
}

/// The order of a Lagrange or Bezier hexahedron or wedge, and how many points that asks for; null
/// for other cells.
const int* FindOrder(vtkCell* cell)
{
  if (auto* hexahedron = vtkHigherOrderHexahedron::SafeDownCast(cell))
  {
    return hexahedron->GetOrder();
  }
  auto* wedge = vtkHigherOrderWedge::SafeDownCast(cell);
  return wedge ? wedge->GetOrder() : nullptr;
}

bool IsHexahedron(int type)
{
  return type == VTK_LAGRANGE_HEXAHEDRON || type == VTK_BEZIER_HEXAHEDRON;
}

bool IsWedge(int type)
{
  return type == VTK_LAGRANGE_WEDGE || type == VTK_BEZIER_WEDGE;
}

/// Whether a tetrahedron of any order may have a number of points; with 15, it has one in each face
/// and one within.
bool MayTetrahedronHave(vtkIdType points)
{
  vtkIdType ofOrder = 0;
  for (vtkIdType order = 1; ofOrder < points; ++order)
  {
    ofOrder = (order + 1) * (order + 2) * (order + 3) / 6;
  }
  return points > 0 && (points == ofOrder || points == 15);
}

/// How many points the degrees of a hexahedron or wedge ask for; 0 if it cannot have them.
double CountPoints(bool isWedge, const double degrees[3], vtkIdType points)
{
  const bool areWhole = std::all_of(degrees, degrees + 3,
    [](double degree) { return degree >= 1.0 && degree == std::floor(degree); });
  if (!areWhole || (isWedge && degrees[0] != degrees[1]))
  {
    return 0.0;
  }
  // A quadratic wedge may have one in each face and one within, too.
  if (isWedge && points == 21)
  {
    return degrees[0] == 2.0 && degrees[2] == 2.0 ? 21.0 : 0.0;
  }
  return (degrees[0] + 1.0) * (degrees[2] + 1.0) *
    (isWedge ? 0.5 * (degrees[0] + 2.0) : degrees[1] + 1.0);
}

/// Whether the degrees and weights that a grid has for a Lagrange or Bezier cell fit its points.
/// VTK trusts them.
bool HasFittingArrays(vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdType points)
{
  const int type = grid->GetCellType(cell);
  vtkDataArray* weights = grid->GetPointData()->GetRationalWeights();
  if (vtkIsosurfaceRayTraceSubdivision::IsBezier(type) && weights &&
    weights->GetNumberOfTuples() < grid->GetNumberOfPoints())
  {
    return false;
  }
  vtkDataArray* degrees = grid->GetCellData()->GetHigherOrderDegrees();
  if (!degrees || !(IsHexahedron(type) || IsWedge(type)))
  {
    return true;
  }
  if (degrees->GetNumberOfComponents() != 3 || degrees->GetNumberOfTuples() <= cell)
  {
    return false;
  }
  double ofCell[3];
  for (int i = 0; i < 3; ++i)
  {
    ofCell[i] = degrees->GetComponent(cell, i);
  }
  return CountPoints(IsWedge(type), ofCell, points) == static_cast<double>(points);
}

/// Whether a list of faces, as in vtkUnstructuredGrid::GetFaceStream, has faces of at least three
/// points each, and these are of a grid.
bool AreFaces(vtkIdList* faces, vtkIdType points)
{
  const vtkIdType count = faces->GetNumberOfIds();
  vtkIdType left = count > 0 ? faces->GetId(0) : -1;
  vtkIdType next = 1;
  for (; left > 0 && next < count; --left)
  {
    const vtkIdType size = faces->GetId(next);
    const vtkIdType* first = faces->GetPointer(next) + 1;
    if (size < 3 || size >= count - next ||
      !std::all_of(first, first + size, [points](vtkIdType id) { return id >= 0 && id < points; }))
    {
      return false;
    }
    next += 1 + size;
  }
  return left == 0;
}

/// Whether VTK cuts cells of a type alike, whatever the places and the ids of their points are, as
/// it cut the reference: some cells at random tell.
bool AreCutAlike(vtkCell* cell, vtkIdList* ofReference)
{
  const auto count = static_cast<std::size_t>(cell->GetNumberOfPoints());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-0.2, 0.2);
  std::vector<vtkIdType> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> corners;
  bool areAlike = true;
  for (int tries = 0; tries < 10 && areAlike; ++tries)
  {
    std::shuffle(numbers.begin(), numbers.end(), random);
    for (std::size_t i = 0; i < count; ++i)
    {
      const double* place = cell->GetParametricCoords() + 3 * i;
      cell->GetPoints()->SetPoint(static_cast<vtkIdType>(i), place[0] + move(random),
        place[1] + move(random), place[2] + move(random));
      cell->GetPointIds()->SetId(static_cast<vtkIdType>(i), numbers[i]);
    }
    cell->Triangulate(0, ids, corners);
    areAlike = std::equal(ids->begin(), ids->end(), ofReference->begin(), ofReference->end(),
      [&](vtkIdType id, vtkIdType number)
      { return id == numbers[static_cast<std::size_t>(number)]; });
  }
  return areAlike;
}

/// Finds tetrahedra between the point with the least id and the faces without it, which are cut
/// from their own points with the least id. So neighbours cut a face alike.
void TriangulateFaces(vtkCell* cell, vtkIdList* ids)
{
  vtkIdList* all = cell->GetPointIds();
  const vtkIdType apex = *std::min_element(all->begin(), all->end());
  for (int i = 0; i < cell->GetNumberOfFaces(); ++i)
  {
    vtkIdList* face = cell->GetFace(i)->GetPointIds();
    const vtkIdType count = face->GetNumberOfIds();
    const vtkIdType first = std::min_element(face->begin(), face->end()) - face->begin();
    if (face->GetId(first) == apex)
    {
      continue;
    }
    for (vtkIdType k = 1; k + 1 < count; ++k)
    {
      ids->InsertNextId(apex);
      ids->InsertNextId(face->GetId(first));
      ids->InsertNextId(face->GetId((first + k) % count));
      ids->InsertNextId(face->GetId((first + k + 1) % count));
    }
  }
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSubdivision::vtkIsosurfaceRayTraceSubdivision(int type)
  : HasVolume(IsSolid(type))
  , PartType(VTK_TETRA)
{
  this->IsPolyhedron = type == VTK_POLYHEDRON;
  this->IsPrism = type == VTK_PENTAGONAL_PRISM || type == VTK_HEXAGONAL_PRISM;
  this->IsTetrahedron = type == VTK_LAGRANGE_TETRAHEDRON || type == VTK_BEZIER_TETRAHEDRON;
  this->IsTriangulatedByPoints = type == VTK_CONVEX_POINT_SET || type == VTK_QUADRATIC_PYRAMID;
  // Cells of later types may have any number of points.
  if (this->HasVolume && type < VTK_CONVEX_POINT_SET)
  {
    const auto cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
    this->Points = cell->GetNumberOfPoints();
    if (!this->IsPrism && !this->IsTriangulatedByPoints)
    {
      this->ChooseWay(cell);
    }
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSubdivision::IsSolid(int type)
{
  const auto cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
  return cell && cell->GetCellDimension() == 3;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSubdivision::IsBezier(int type)
{
  return type >= VTK_BEZIER_TETRAHEDRON && type <= VTK_BEZIER_PYRAMID;
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
  const double volume = FindVolume(this->Corners);
  reference->Triangulate(0, ids, this->Corners);
  constexpr double rounding = 1e-9;
  if (FindVolume(this->Corners) >= (1.0 - rounding) * volume)
  {
    this->AreAlike = AreCutAlike(reference, ids);
    this->Parts.assign(ids->begin(), this->AreAlike ? ids->end() : ids->begin());
    return;
  }
  this->IsTriangulatedByPoints = !this->DivideLattice(reference, VTK_HEXAHEDRON, { 2, 2, 2 }) &&
    !this->DivideLattice(reference, VTK_WEDGE, { 2, 2, 2 }) &&
    !this->DivideLattice(reference, VTK_WEDGE, { 2, 2, 1 });
  this->AreAlike = !this->IsTriangulatedByPoints;
}

//------------------------------------------------------------------------------
/// Finds the hexahedra or wedges that a cell has between its points. Returns false if one of these
/// is missing.
bool vtkIsosurfaceRayTraceSubdivision::DivideLattice(
  vtkCell* cell, int type, const std::array<int, 3>& order)
{
  this->Parts =
    FindPoints(cell, order, type == VTK_HEXAHEDRON ? PlaceHexahedra(order) : PlaceWedges(order));
  if (this->Parts.empty())
  {
    return false;
  }
  this->PartType = type;
  return true;
}

//------------------------------------------------------------------------------
/// Divides a Lagrange or Bezier hexahedron or wedge, if it is not of the order of the last one.
void vtkIsosurfaceRayTraceSubdivision::DivideByOrder(vtkCell* cell, const int* order)
{
  if (std::equal(this->Order.begin(), this->Order.end(), order))
  {
    return;
  }
  std::copy_n(order, this->Order.size(), this->Order.begin());
  this->Parts.clear();
  const bool hasAllPoints = order[3] == cell->GetNumberOfPoints();
  if (hasAllPoints && *std::min_element(order, order + 3) > 0)
  {
    this->DivideLattice(cell, cell->GetNumberOfFaces() == 6 ? VTK_HEXAHEDRON : VTK_WEDGE,
      { order[0], order[1], order[2] });
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSubdivision::FindParts(
  vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* points, vtkIdList* ids)
{
  ids->Reset();
  const vtkIdType count = points->GetNumberOfIds();
  if (!this->MayHave(count) || (this->IsTetrahedron && !MayTetrahedronHave(count)))
  {
    return false;
  }
  if (this->IsPolyhedron)
  {
    return this->DividePolyhedron(grid, cell, points, ids);
  }
  if (!this->AreAlike)
  {
    if (!HasFittingArrays(grid, cell, count))
    {
      return false;
    }
    grid->GetCell(cell, this->Cell);
    if (!this->DivideCell(this->Cell, ids))
    {
      return false;
    }
  }
  for (const vtkIdType number : this->Parts)
  {
    ids->InsertNextId(points->GetId(number));
  }
  return true;
}

//------------------------------------------------------------------------------
/// Finds the corners of the parts of a cell, or, if its order tells them, their numbers.
bool vtkIsosurfaceRayTraceSubdivision::DivideCell(vtkGenericCell* cell, vtkIdList* ids)
{
  if (const int* order = FindOrder(cell->GetRepresentativeCell()))
  {
    this->DivideByOrder(cell, order);
    return !this->Parts.empty();
  }
  if (this->IsPrism)
  {
    TriangulateFaces(cell, ids);
  }
  else if (this->IsTriangulatedByPoints)
  {
    this->TriangulatePoints(cell, ids);
  }
  else if (cell->Triangulate(0, ids, this->Corners) == 0)
  {
    ids->Reset();
  }
  return true;
}

//------------------------------------------------------------------------------
/// Where parts overlap, takes those of the hull. It is the cell where just the faces do not fit.
bool vtkIsosurfaceRayTraceSubdivision::DividePolyhedron(
  vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* points, vtkIdList* ids)
{
  grid->GetFaceStream(cell, this->Faces);
  if (!AreFaces(this->Faces, grid->GetNumberOfPoints()))
  {
    return false;
  }
  this->HasHull = false;
  if (this->Polyhedron.Divide(grid->GetPoints(), points, this->Faces, ids))
  {
    return true;
  }
  grid->GetCell(cell, this->Cell);
  this->Cell->Triangulate(0, ids, this->Corners);
  constexpr double rounding = 1e-6;
  const double volume = this->Polyhedron.GetVolume();
  this->HasHull = std::abs(FindVolume(this->Corners) - volume) > rounding * volume;
  return true;
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
