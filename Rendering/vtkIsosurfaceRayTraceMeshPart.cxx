// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMeshPart.h"

#include "vtkIsosurfaceRayTraceGhosts.h"
#include "vtkIsosurfaceRayTraceGridLists.h"
#include "vtkIsosurfaceRayTraceSubdivision.h"

#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include "Mesh/ShapeFunctions.h"

#include <algorithm>
#include <mutex>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Lists = vtkIsosurfaceRayTraceGridLists;

/// VTK 9.1 reads the weights of Bezier cells, and evaluates them, in memory that all threads have
/// in common.
std::unique_lock<std::mutex> LockEvaluation(int type)
{
  static std::mutex mutex;
  return vtkIsosurfaceRayTraceSubdivision::IsBezier(type) ? std::unique_lock<std::mutex>(mutex)
                                                          : std::unique_lock<std::mutex>();
}

/// The parametric coordinates of a point in a polyhedron. (VTK, asked for them, also finds whether
/// the point is inside, in a thousand times the time.)
vtkirt::Vector3 FindPlaceInBox(vtkPointSet* grid, vtkIdType cell, const vtkirt::Vector3& point)
{
  double bounds[6];
  grid->GetCellBounds(cell, bounds);
  vtkirt::Vector3 place;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double size = bounds[2 * axis + 1] - bounds[2 * axis];
    place[axis] = size > 0.0 ? (point[axis] - bounds[2 * axis]) / size : 0.0;
  }
  return place;
}

/// When a grid was modified last, but for its arrays: those that are not traced do not matter.
vtkMTimeType FindOwnTime(vtkPointSet* grid)
{
  return std::max({ grid->vtkObject::GetMTime(), grid->GetPointData()->vtkObject::GetMTime(),
    grid->GetCellData()->vtkObject::GetMTime() });
}

/// An array of cells as vtkCellDataToPointData takes it: VTK 9.1 leaves out ids, and averages bits
/// to what is in memory.
vtkSmartPointer<vtkDataArray> MakeAveraged(vtkDataArray* array)
{
  if (array->GetDataType() == VTK_ID_TYPE || array->GetDataType() == VTK_BIT)
  {
    auto numbers = vtkSmartPointer<vtkDoubleArray>::New();
    numbers->DeepCopy(array);
    return numbers;
  }
  auto copy = vtk::TakeSmartPointer(array->NewInstance());
  copy->ShallowCopy(array);
  return copy;
}

/// The objects of a grid that are traced. Some may be null.
std::vector<vtkObject*> FindParts(vtkPointSet* grid, vtkDataArray* scalars)
{
  std::vector<vtkObject*> parts = { scalars, grid->GetPoints(), grid->GetCellGhostArray(),
    grid->GetPointGhostArray(), grid->GetCellData()->GetHigherOrderDegrees() };
  if (auto* listed = vtkUnstructuredGrid::SafeDownCast(grid))
  {
    parts.insert(parts.end(), { listed->GetCells(), Lists::GetTypes(listed) });
  }
  return parts;
}

}

//------------------------------------------------------------------------------
/// While it is the same, so is the mesh.
struct vtkIsosurfaceRayTraceMeshPart::Key
{
  Key(vtkPointSet* grid, const vtkIsosurfaceRayTraceScalars& scalars, bool isTetrahedralized)
    : Grid(grid)
    , GridTime(FindOwnTime(grid))
    , Points(Lists::FindPoints(grid))
    , AreOfCells(scalars.AreOfCells)
    , Component(scalars.Component)
    , HasOthers(scalars.HasOthers)
    , IsTetrahedralized(isTetrahedralized)
  {
    for (vtkObject* part : FindParts(grid, scalars.Array))
    {
      this->Parts.emplace_back(part, part ? part->GetMTime() : 0);
    }
  }

  bool operator==(const Key& other) const
  {
    return this->Grid == other.Grid && this->GridTime == other.GridTime &&
      this->Points == other.Points && this->AreOfCells == other.AreOfCells &&
      this->Component == other.Component && this->HasOthers == other.HasOthers &&
      this->IsTetrahedralized == other.IsTetrahedralized && this->Parts == other.Parts;
  }

  vtkPointSet* Grid;
  vtkMTimeType GridTime;
  /// The memory of the points.
  const void* Points;
  bool AreOfCells;
  int Component;
  bool HasOthers;
  bool IsTetrahedralized;
  std::vector<std::pair<vtkObject*, vtkMTimeType>> Parts;
};

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshPart::IsMesh(vtkDataSet* data)
{
  return vtkUnstructuredGrid::SafeDownCast(data) || vtkStructuredGrid::SafeDownCast(data);
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshPart::vtkIsosurfaceRayTraceMeshPart(
  vtkPointSet* grid, const vtkIsosurfaceRayTraceScalars& scalars, bool isTetrahedralized)
  : MadeFrom(std::make_unique<Key>(grid, scalars, isTetrahedralized))
  , Scalars(scalars)
{
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshPart::~vtkIsosurfaceRayTraceMeshPart() = default;

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshPart::IsOf(
  vtkPointSet* grid, const vtkIsosurfaceRayTraceScalars& scalars, bool isTetrahedralized) const
{
  return Key(grid, scalars, isTetrahedralized) == *this->MadeFrom;
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceMeshPart::GetFirstData() const
{
  return this->GetGrid();
}

//------------------------------------------------------------------------------
vtkPointSet* vtkIsosurfaceRayTraceMeshPart::GetGrid() const
{
  return this->MadeFrom->Grid;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshPart::SelectCells(int threads)
{
  // VTK finds the averages of values of cells.
  std::string problem = this->TracedCells.Select(this->GetGrid(), this->MadeFrom->IsTetrahedralized,
    this->Scalars.AreOfCells, threads, this->ReadArrays);
  this->View = this->TracedCells.GetView();
  return problem;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshPart::SelectPoints()
{
  vtkDataArray* points = this->GetGrid()->GetPoints()->GetData();
  const bool isReal = points->GetDataType() == VTK_FLOAT || points->GetDataType() == VTK_DOUBLE;
  if (!isReal || !points->HasStandardMemoryLayout() || this->TracedCells.HaveCenters())
  {
    this->PlainPoints.TakeReference(vtkDataArray::CreateDataArray(VTK_DOUBLE));
    this->PlainPoints->DeepCopy(points);
    this->TracedCells.AddMeans(this->PlainPoints);
    points = this->PlainPoints;
  }
  this->View.Points = this->ReadArrays.Read(points);
  this->View.PointType =
    points->GetDataType() == VTK_FLOAT ? vtkirt::ScalarType::Float32 : vtkirt::ScalarType::Float64;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshPart::SelectValues(int threads)
{
  vtkIsosurfaceRayTraceScalars ofPoints = this->Scalars;
  if (this->Scalars.AreOfCells)
  {
    // The averages are those of VTK.
    auto copy = vtk::TakeSmartPointer(this->GetGrid()->NewInstance());
    copy->CopyStructure(this->GetGrid());
    const vtkSmartPointer<vtkDataArray> array = MakeAveraged(this->Scalars.Array);
    array->SetName("values");
    copy->GetCellData()->AddArray(array);
    vtkNew<vtkCellDataToPointData> average;
    average->SetInputData(copy);
    average->Update();
    this->PointScalars = average->GetOutput()->GetPointData()->GetArray("values");
    ofPoints.Array = this->PointScalars;
    ofPoints.AreOfCells = false;
  }
  if (this->TracedCells.HaveCenters())
  {
    // Centres have the means of magnitudes, not the magnitudes of means.
    ofPoints.MakeView(this->PlainScalars, threads);
    vtkNew<vtkDoubleArray> all;
    all->DeepCopy(this->PlainScalars ? this->PlainScalars.Get() : ofPoints.Array);
    this->TracedCells.AddMeans(all);
    this->PointScalars = all;
    ofPoints.Array = all;
    ofPoints.Component = all->GetNumberOfComponents() == 1 ? 0 : ofPoints.Component;
  }
  const vtkIsosurfaceRayTraceScalars::View values = ofPoints.MakeView(this->PlainScalars, threads);
  this->ReadArrays.Read(this->PlainScalars ? this->PlainScalars.Get() : ofPoints.Array);
  this->View.Values = values.Values;
  this->View.ValueType = values.Type;
  this->View.ValueStride = values.Stride;
  if (this->Scalars.HasOthers)
  {
    this->View.Components = values.Components;
    this->View.NumberOfComponents = ofPoints.Array->GetNumberOfComponents();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshPart::FindHiddenCells()
{
  vtkUnsignedCharArray* cellFlags = this->GetGrid()->GetCellGhostArray();
  vtkUnsignedCharArray* pointFlags = this->GetGrid()->GetPointGhostArray();
  if (!cellFlags && !pointFlags)
  {
    return;
  }
  const std::int64_t count = this->Cells->GetNumberOfCells();
  this->HiddenCells.resize(static_cast<std::size_t>(count), 0);
  vtkNew<vtkIdList> points;
  vtkIdType last = -1;
  for (std::int64_t i = 0; i < count; ++i)
  {
    using Ghosts = vtkIsosurfaceRayTraceGhosts;
    const auto number = static_cast<std::size_t>(i);
    const vtkIdType id = this->TracedCells.FindId(i);
    if (id == std::exchange(last, id))
    {
      // The next part of a cell.
      this->HiddenCells[number] = this->HiddenCells[number - 1];
      continue;
    }
    bool isHidden =
      cellFlags && (cellFlags->GetValue(id) & (Ghosts::Blanked | Ghosts::Duplicate)) != 0;
    if (pointFlags && !isHidden)
    {
      this->FindPointsOfCell(i, points);
      isHidden = std::any_of(points->begin(), points->end(),
        [pointFlags](vtkIdType point)
        { return (pointFlags->GetValue(point) & Ghosts::HiddenPoint) != 0; });
    }
    this->HiddenCells[number] = isHidden ? 1 : 0;
  }
}

//------------------------------------------------------------------------------
/// Hides those parts of a cell that are finite, where one of the others is not.
void vtkIsosurfaceRayTraceMeshPart::HidePartsOfInfiniteCells()
{
  if (!this->TracedCells.MayBeParts() || this->Field->AreAllCellsFinite())
  {
    return;
  }
  const std::int64_t count = this->Cells->GetNumberOfCells();
  this->HiddenCells.resize(static_cast<std::size_t>(count), 0);
  std::int64_t end = 0;
  for (std::int64_t begin = 0; begin < count; begin = end)
  {
    const vtkIdType id = this->TracedCells.FindId(begin);
    bool isFinite = true;
    for (end = begin; end < count && this->TracedCells.FindId(end) == id; ++end)
    {
      vtkirt::MeshCell part;
      isFinite = this->Cells->Load(end, part) && isFinite;
    }
    if (!isFinite)
    {
      std::fill(this->HiddenCells.begin() + begin, this->HiddenCells.begin() + end, 1);
    }
  }
}

//------------------------------------------------------------------------------
/// The points of a cell, or of the whole of which it is a part; none if its shape is not traced.
void vtkIsosurfaceRayTraceMeshPart::FindPointsOfCell(std::int64_t number, vtkIdList* points) const
{
  if (this->TracedCells.MayBeParts())
  {
    this->GetGrid()->GetCellPoints(this->TracedCells.FindId(number), points);
    return;
  }
  points->Reset();
  vtkirt::MeshCell cell;
  this->Cells->LoadIds(number, cell);
  for (int i = 0; i < cell.Count; ++i)
  {
    points->InsertNextId(cell.Ids[i]);
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshPart::Update(int threads)
{
  if (this->Field)
  {
    return false;
  }
  this->SelectPoints();
  this->SelectValues(threads);
  if (this->MadeFrom->IsTetrahedralized)
  {
    this->TracedCells.Tetrahedralize(this->View, threads);
  }
  this->Cells = std::make_unique<vtkirt::MeshCells>(this->View, threads);
  this->FindHiddenCells();
  this->Field = std::make_unique<vtkirt::MeshField>(*this->Cells, threads);
  this->HidePartsOfInfiniteCells();
  return true;
}

//------------------------------------------------------------------------------
vtkirt::Visibility vtkIsosurfaceRayTraceMeshPart::FindVisible() const
{
  vtkirt::Visibility visible;
  visible.HiddenCells = this->HiddenCells.empty() ? nullptr : this->HiddenCells.data();
  return visible;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMeshPart::FindCellSize() const
{
  return this->Field->GetCellSize();
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshPart::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  parametric = hit.Parametric;
  return this->Leaf.FirstCell + this->TracedCells.FindId(hit.Cell);
}

//------------------------------------------------------------------------------
/// As VTK finds them, if it does.
void vtkIsosurfaceRayTraceMeshPart::MoveToWholeCell(
  const vtkirt::Hit& hit, vtkGenericCell* any, vtkirt::Vector3& parametric) const
{
  if (!this->TracedCells.MayBeParts())
  {
    return;
  }
  const vtkIdType cell = this->TracedCells.FindId(hit.Cell);
  vtkPointSet* grid = this->GetGrid();
  // An observer may have given the grid other cells.
  if (cell >= grid->GetNumberOfCells() ||
    grid->GetCellType(cell) == this->TracedCells.GetShape(hit.Cell))
  {
    return;
  }
  const vtkirt::Vector3 position = this->Field->GetPoint(hit);
  if (grid->GetCellType(cell) == VTK_POLYHEDRON)
  {
    parametric = FindPlaceInBox(grid, cell, position);
    return;
  }
  const std::unique_lock<std::mutex> lock = LockEvaluation(grid->GetCellType(cell));
  grid->GetCell(cell, any);
  std::vector<double> weights(static_cast<std::size_t>(any->GetNumberOfPoints()));
  vtkirt::Vector3 closest;
  vtkirt::Vector3 found;
  double distance = 0.0;
  int subId = 0;
  if (any->EvaluatePosition(
        position.data(), closest.data(), subId, found.data(), distance, weights.data()) >= 0)
  {
    parametric = found;
  }
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 vtkIsosurfaceRayTraceMeshPart::FindPhysicalFromObject() const
{
  return { 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0 };
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshPart::FindPoint(const vtkirt::Hit& hit) const
{
  // Of what is traced: an observer may have given the grid other points and cells.
  vtkirt::MeshCell cell;
  this->Cells->Load(hit.Cell, cell);
  const vtkirt::Vector3 position = this->Field->GetPoint(hit);
  std::int64_t nearest = -1;
  double least = VTK_DOUBLE_MAX;
  for (int i = 0; i < cell.Count; ++i)
  {
    const double square = vtkMath::Distance2BetweenPoints(cell.Points[i].data(), position.data());
    if (square < least && cell.Ids[i] < this->TracedCells.CountPointsOfGrid())
    {
      least = square;
      nearest = cell.Ids[i];
    }
  }
  return this->Leaf.FirstPoint + nearest;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshPart::SampleColors(
  const vtkirt::Hit& hit, int components, double* values) const
{
  vtkirt::MeshCell cell;
  this->Cells->LoadIds(hit.Cell, cell);
  vtkirt::CornerWeights weights;
  vtkirt::GetWeights(cell.Shape, hit.Parametric, weights);
  for (int component = 0; component < components; ++component)
  {
    values[component] = 0.0;
    for (int i = 0; i < cell.Count; ++i)
    {
      // Values without weight may be NaN.
      values[component] +=
        weights[i] == 0.0 ? 0.0 : weights[i] * this->FindColor(cell.Ids[i], component);
    }
  }
}

//------------------------------------------------------------------------------
/// The number to colour by that a point has, or a centre.
double vtkIsosurfaceRayTraceMeshPart::FindColor(std::int64_t point, int component) const
{
  return point < this->TracedCells.CountPointsOfGrid()
    ? this->Leaf.Colors->GetComponent(point, component)
    : this->TracedCells.FindMean(point, this->Leaf.Colors, component);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshPart::IsIntact() const
{
  const vtkDataArray* colors = this->Leaf.Colors;
  return (!colors || colors->GetNumberOfTuples() >= this->TracedCells.CountPointsOfGrid()) &&
    this->ReadArrays.AreIntact();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshPart::AddObjects(std::vector<vtkObject*>& objects) const
{
  objects.insert(objects.end(), { this->GetGrid(), this->Leaf.Colors });
  const std::vector<vtkObject*> parts = FindParts(this->GetGrid(), this->Scalars.Array);
  objects.insert(objects.end(), parts.begin(), parts.end());
  this->ReadArrays.AddObjects(objects);
}

VTK_ABI_NAMESPACE_END
