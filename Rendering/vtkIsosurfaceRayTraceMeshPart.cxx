// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMeshPart.h"

#include "vtkIsosurfaceRayTraceGhosts.h"
#include "vtkIsosurfaceRayTraceGridLists.h"
#include "vtkIsosurfaceRayTracePolyhedron.h"
#include "vtkIsosurfaceRayTraceSubdivision.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
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
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Lists = vtkIsosurfaceRayTraceGridLists;

using vtkirt::CellShape;

static_assert(static_cast<int>(CellShape::Tetrahedron) == VTK_TETRA);
static_assert(static_cast<int>(CellShape::Voxel) == VTK_VOXEL);
static_assert(static_cast<int>(CellShape::Hexahedron) == VTK_HEXAHEDRON);
static_assert(static_cast<int>(CellShape::Wedge) == VTK_WEDGE);
static_assert(static_cast<int>(CellShape::Pyramid) == VTK_PYRAMID);

bool IsTraced(int shape)
{
  return vtkirt::GetTraits(static_cast<CellShape>(shape)).Corners > 0;
}

bool IsSolid(int type)
{
  return vtkIsosurfaceRayTraceSubdivision::IsSolid(type);
}

/// Whether a grid has cells of a type that is asked for. (VTK's list of the types that a grid has
/// is made by a look at all cells, always.)
template <typename Predicate>
bool HasType(vtkUnstructuredGrid* grid, const Predicate& isAskedFor)
{
  const auto* type = static_cast<const unsigned char*>(Lists::GetTypes(grid)->GetVoidPointer(0));
  const unsigned char* last = type + grid->GetNumberOfCells();
  bool isKnown[256] = {};
  while (type != last)
  {
    if (!isKnown[*type] && isAskedFor(*type))
    {
      return true;
    }
    isKnown[*type] = true;
    const unsigned char known = *type;
    type = std::find_if(type, last, [known](unsigned char other) { return other != known; });
  }
  return false;
}

/// Whether every cell of a grid has a type.
bool HasAllTypes(vtkUnstructuredGrid* grid)
{
  const vtkDataArray* types = Lists::GetTypes(grid);
  return types && types->GetNumberOfValues() >= grid->GetNumberOfCells();
}

/// The type of ids that can be read where they are; none for others.
std::optional<vtkirt::ScalarType> FindIdType(vtkDataArray* ids)
{
  if (!ids->HasStandardMemoryLayout())
  {
    return std::nullopt;
  }
  return ids->GetDataTypeSize() == 8 ? vtkirt::ScalarType::Int64 : vtkirt::ScalarType::Int32;
}

/// VTK 9.1 evaluates Bezier cells in memory that all threads have in common.
std::unique_lock<std::mutex> LockEvaluation(int type)
{
  static std::mutex mutex;
  const bool isBezier = type >= VTK_BEZIER_TETRAHEDRON && type <= VTK_BEZIER_PYRAMID;
  return isBezier ? std::unique_lock<std::mutex>(mutex) : std::unique_lock<std::mutex>();
}

double FindMean(vtkDataArray* array, const std::vector<vtkIdType>& points, int component)
{
  double sum = 0.0;
  for (const vtkIdType point : points)
  {
    sum += array->GetComponent(point, component);
  }
  return sum / static_cast<double>(points.size());
}

/// When a grid was modified last, but for its arrays: those that are not traced do not matter.
vtkMTimeType FindOwnTime(vtkPointSet* grid)
{
  return std::max({ grid->vtkObject::GetMTime(), grid->GetPointData()->vtkObject::GetMTime(),
    grid->GetCellData()->vtkObject::GetMTime() });
}

/// The objects of a grid that are traced. Some may be null.
std::vector<vtkObject*> FindParts(vtkPointSet* grid, vtkDataArray* scalars)
{
  std::vector<vtkObject*> parts = { scalars, grid->GetPoints(), grid->GetCellGhostArray(),
    grid->GetPointGhostArray() };
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
bool vtkIsosurfaceRayTraceMeshPart::HasVolume(vtkDataSet* grid)
{
  if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    int dimensions[3];
    structured->GetDimensions(dimensions);
    return *std::min_element(dimensions, dimensions + 3) >= 2;
  }
  // Of what has no types, SelectCells says so.
  auto* listed = vtkUnstructuredGrid::SafeDownCast(grid);
  return !HasAllTypes(listed) || HasType(listed, IsSolid);
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
/// The memory of an array, which must be the same as long as the array is traced.
const void* vtkIsosurfaceRayTraceMeshPart::Read(vtkDataArray* array)
{
  this->ReadArrays.push_back({ array, array->GetVoidPointer(0), array->GetNumberOfValues() });
  return this->ReadArrays.back().Memory;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshPart::SelectCells(int threads)
{
  vtkPointSet* grid = this->GetGrid();
  this->View.NumberOfPoints = grid->GetNumberOfPoints();
  auto* structured = vtkStructuredGrid::SafeDownCast(grid);
  const std::string problem = structured
    ? this->SelectLattice(structured)
    : this->SelectListedCells(vtkUnstructuredGrid::SafeDownCast(grid), threads);
  if (problem.empty() && this->MadeFrom->IsTetrahedralized)
  {
    this->Tetrahedralize();
  }
  return problem;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshPart::SelectLattice(vtkStructuredGrid* grid)
{
  vtkirt::Index3& dimensions = this->View.Dimensions;
  grid->GetDimensions(dimensions.data());
  if (!HasVolume(grid))
  {
    return "The input has " + std::to_string(dimensions[0]) + " x " +
      std::to_string(dimensions[1]) + " x " + std::to_string(dimensions[2]) +
      " points. An isosurface needs cells of three dimensions: at least 2 points along each axis.";
  }
  if (this->View.NumberOfPoints != static_cast<std::int64_t>(vtkirt::Count(dimensions)))
  {
    return "The input has " + std::to_string(this->View.NumberOfPoints) +
      " points, but its dimensions ask for " + std::to_string(vtkirt::Count(dimensions)) + ".";
  }
  return "";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshPart::SelectListedCells(vtkUnstructuredGrid* grid, int threads)
{
  const vtkIdType count = grid->GetNumberOfCells();
  if (count > static_cast<vtkIdType>(std::numeric_limits<std::uint32_t>::max()))
  {
    return "The input has more than 2^32 - 1 cells. Give it in several pieces.";
  }
  if (!HasAllTypes(grid))
  {
    return "The input has " + std::to_string(count) + " cells, but not a type for each.";
  }
  if (count <= 0 || !HasVolume(grid))
  {
    return "The input has no cells of three dimensions. Give tetrahedra, hexahedra, voxels, wedges "
           "or pyramids.";
  }
  this->ViewCells(grid);
  const bool areSubdivided =
    HasType(grid, [](int type) { return !IsTraced(type) && IsSolid(type); });
  // VTK itself reads cells of all shapes.
  const bool areAllRead =
    areSubdivided || this->Scalars.AreOfCells || this->MadeFrom->IsTetrahedralized;
  const auto checked = areAllRead ? vtkirt::CheckedCells::All : vtkirt::CheckedCells::Traced;
  const std::string problem = vtkirt::FindProblem(
    this->View, grid->GetCells()->GetConnectivityArray()->GetNumberOfValues(), threads, checked);
  return problem.empty() && areSubdivided ? this->SubdivideCells(grid) : problem;
}

//------------------------------------------------------------------------------
/// Reads the lists of cells where they are, if their types allow it.
void vtkIsosurfaceRayTraceMeshPart::ViewCells(vtkUnstructuredGrid* grid)
{
  this->View.NumberOfCells = grid->GetNumberOfCells();
  this->View.Shapes = static_cast<const unsigned char*>(this->Read(Lists::GetTypes(grid)));
  vtkCellArray* cells = grid->GetCells();
  vtkDataArray* offsets = cells->GetOffsetsArray();
  vtkDataArray* connectivity = cells->GetConnectivityArray();
  const auto idType = FindIdType(connectivity);
  if (idType && FindIdType(offsets) == idType)
  {
    this->View.IdType = *idType;
    this->View.Offsets = this->Read(offsets);
    this->View.Connectivity = this->Read(connectivity);
    return;
  }
  const auto copy = [](vtkDataArray* from, std::vector<std::int64_t>& to)
  {
    for (vtkIdType i = 0; i < from->GetNumberOfTuples(); ++i)
    {
      to.push_back(static_cast<std::int64_t>(from->GetTuple1(i)));
    }
    return to.data();
  };
  this->View.IdType = vtkirt::ScalarType::Int64;
  this->View.Offsets = copy(offsets, this->Offsets);
  this->View.Connectivity = copy(connectivity, this->Connectivity);
}

//------------------------------------------------------------------------------
/// Divides quadratic cells, polyhedra and others.
std::string vtkIsosurfaceRayTraceMeshPart::SubdivideCells(vtkUnstructuredGrid* grid)
{
  std::vector<unsigned char> shapes;
  std::vector<std::int64_t> offsets = { 0 };
  std::vector<std::int64_t> connectivity;
  const auto add = [&](int shape, vtkIdList* ids, vtkIdType first, vtkIdType count, vtkIdType cell)
  {
    shapes.push_back(static_cast<unsigned char>(shape));
    for (vtkIdType i = first; i < first + count; ++i)
    {
      connectivity.push_back(ids->GetId(i));
    }
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    this->CellIds.push_back(cell);
  };
  std::map<int, vtkIsosurfaceRayTraceSubdivision> types;
  vtkNew<vtkGenericCell> generic;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    const int shape = this->View.Shapes[i];
    if (IsTraced(shape))
    {
      grid->GetCellPoints(i, ids);
      add(shape, ids, 0, ids->GetNumberOfIds(), i);
      continue;
    }
    vtkIsosurfaceRayTraceSubdivision& type = types.try_emplace(shape, shape).first->second;
    if (!type.IsSolid())
    {
      continue;
    }
    grid->GetCellPoints(i, ids);
    const bool mayHave = type.MayHave(ids->GetNumberOfIds());
    if (mayHave)
    {
      grid->GetCell(i, generic);
    }
    if (!mayHave || !type.FindParts(generic, ids))
    {
      return "Cell " + std::to_string(i) + " has a wrong number of points, or a face of it has.";
    }
    this->AddCenter(generic->GetPointIds(), ids);
    if (this->FirstHull < 0 && type.IsHull())
    {
      this->FirstHull = i;
    }
    const vtkIdType size = type.GetPartSize();
    for (vtkIdType first = 0; first + size <= ids->GetNumberOfIds(); first += size)
    {
      add(type.GetPartType(), ids, first, size, i);
    }
  }
  this->Shapes = std::move(shapes);
  this->Offsets = std::move(offsets);
  this->Connectivity = std::move(connectivity);
  this->ViewOwnCells();
  return "";
}

//------------------------------------------------------------------------------
/// Gives the centre of a polyhedron an id, if its parts have it as a corner.
void vtkIsosurfaceRayTraceMeshPart::AddCenter(vtkIdList* points, vtkIdList* parts)
{
  constexpr vtkIdType center = vtkIsosurfaceRayTracePolyhedron::Center;
  if (std::find(parts->begin(), parts->end(), center) != parts->end())
  {
    std::replace(
      parts->begin(), parts->end(), center, static_cast<vtkIdType>(this->View.NumberOfPoints));
    this->Centers.emplace_back(points->begin(), points->end());
    ++this->View.NumberOfPoints;
  }
}

//------------------------------------------------------------------------------
/// Adds what the centres of polyhedra have to an array of the points.
void vtkIsosurfaceRayTraceMeshPart::AddMeans(vtkDataArray* array) const
{
  const int components = array->GetNumberOfComponents();
  std::vector<double> mean(static_cast<std::size_t>(components));
  vtkIdType center = this->CountPointsOfGrid();
  for (const std::vector<vtkIdType>& points : this->Centers)
  {
    for (int i = 0; i < components; ++i)
    {
      mean[i] = FindMean(array, points, i);
    }
    array->InsertTuple(center++, mean.data());
  }
}

//------------------------------------------------------------------------------
std::int64_t vtkIsosurfaceRayTraceMeshPart::CountPointsOfGrid() const
{
  return this->View.NumberOfPoints - static_cast<std::int64_t>(this->Centers.size());
}

//------------------------------------------------------------------------------
/// Replaces all cells by tetrahedra between their points, which agree on faces.
void vtkIsosurfaceRayTraceMeshPart::Tetrahedralize()
{
  auto copy = vtk::TakeSmartPointer(this->GetGrid()->NewInstance());
  copy->CopyStructure(this->GetGrid());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  ids->SetNumberOfValues(copy->GetNumberOfCells());
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfValues(), 0);
  copy->GetCellData()->AddArray(ids);
  vtkNew<vtkDataSetTriangleFilter> filter;
  filter->SetInputData(copy);
  filter->TetrahedraOnlyOn();
  filter->Update();
  vtkUnstructuredGrid* made = filter->GetOutput();
  auto* idsOfMade = vtkIdTypeArray::SafeDownCast(made->GetCellData()->GetArray("ids"));
  this->Shapes.clear();
  this->Offsets = { 0 };
  this->Connectivity.clear();
  this->CellIds.clear();
  this->View.NumberOfPoints = this->CountPointsOfGrid();
  this->Centers.clear();
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < made->GetNumberOfCells(); ++i)
  {
    made->GetCellPoints(i, corners);
    this->Shapes.push_back(VTK_TETRA);
    this->Connectivity.insert(this->Connectivity.end(), corners->begin(), corners->end());
    this->Offsets.push_back(static_cast<std::int64_t>(this->Connectivity.size()));
    this->CellIds.push_back(idsOfMade->GetValue(i));
  }
  this->ViewOwnCells();
}

//------------------------------------------------------------------------------
/// Lists the cells that are kept here.
void vtkIsosurfaceRayTraceMeshPart::ViewOwnCells()
{
  this->View.Dimensions = { 0, 0, 0 };
  this->View.NumberOfCells = static_cast<std::int64_t>(this->Shapes.size());
  this->View.Shapes = this->Shapes.data();
  this->View.IdType = vtkirt::ScalarType::Int64;
  this->View.Offsets = this->Offsets.data();
  this->View.Connectivity = this->Connectivity.data();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshPart::SelectPoints()
{
  vtkDataArray* points = this->GetGrid()->GetPoints()->GetData();
  const bool isReal = points->GetDataType() == VTK_FLOAT || points->GetDataType() == VTK_DOUBLE;
  if (!isReal || !points->HasStandardMemoryLayout() || !this->Centers.empty())
  {
    this->PlainPoints.TakeReference(vtkDataArray::CreateDataArray(VTK_DOUBLE));
    this->PlainPoints->DeepCopy(points);
    this->AddMeans(this->PlainPoints);
    points = this->PlainPoints;
  }
  this->View.Points = this->Read(points);
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
    auto array = vtk::TakeSmartPointer(this->Scalars.Array->NewInstance());
    array->ShallowCopy(this->Scalars.Array);
    array->SetName("values");
    copy->GetCellData()->AddArray(array);
    vtkNew<vtkCellDataToPointData> average;
    average->SetInputData(copy);
    average->Update();
    this->PointScalars = average->GetOutput()->GetPointData()->GetArray("values");
    ofPoints.Array = this->PointScalars;
    ofPoints.AreOfCells = false;
  }
  if (!this->Centers.empty())
  {
    // Centres have the means of magnitudes, not the magnitudes of means.
    ofPoints.MakeView(this->PlainScalars, threads);
    vtkNew<vtkDoubleArray> all;
    all->DeepCopy(this->PlainScalars ? this->PlainScalars.Get() : ofPoints.Array);
    this->AddMeans(all);
    this->PointScalars = all;
    ofPoints.Array = all;
    ofPoints.Component = all->GetNumberOfComponents() == 1 ? 0 : ofPoints.Component;
  }
  const vtkIsosurfaceRayTraceScalars::View values = ofPoints.MakeView(this->PlainScalars, threads);
  this->Read(this->PlainScalars ? this->PlainScalars.Get() : ofPoints.Array);
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
    const vtkIdType id = this->CellIds.empty() ? i : this->CellIds[number];
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
  if (this->CellIds.empty() || this->Field->AreAllCellsFinite())
  {
    return;
  }
  this->HiddenCells.resize(this->CellIds.size(), 0);
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < this->CellIds.size(); begin = end)
  {
    bool isFinite = true;
    for (end = begin; end < this->CellIds.size() && this->CellIds[end] == this->CellIds[begin];
         ++end)
    {
      vtkirt::MeshCell part;
      isFinite = this->Cells->Load(static_cast<std::int64_t>(end), part) && isFinite;
    }
    if (!isFinite)
    {
      std::fill(this->HiddenCells.begin() + static_cast<std::ptrdiff_t>(begin),
        this->HiddenCells.begin() + static_cast<std::ptrdiff_t>(end), 1);
    }
  }
}

//------------------------------------------------------------------------------
/// The points of a cell, or of the whole of which it is a part; none if its shape is not traced.
void vtkIsosurfaceRayTraceMeshPart::FindPointsOfCell(std::int64_t number, vtkIdList* points) const
{
  if (!this->CellIds.empty())
  {
    this->GetGrid()->GetCellPoints(this->CellIds[static_cast<std::size_t>(number)], points);
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
  this->Cells = std::make_unique<vtkirt::MeshCells>(this->View, threads);
  this->FindHiddenCells();
  this->Field = std::make_unique<vtkirt::MeshField>(*this->Cells, threads);
  this->HidePartsOfInfiniteCells();
  return true;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshPart::GetWarning() const
{
  return this->FirstHull < 0 ? ""
                             : "Cell " + std::to_string(this->FirstHull) +
      " is a polyhedron that is not convex, and not all of it is seen from its centre. It is drawn "
      "as its convex hull, and so are others like it. Divide them into convex cells.";
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
  return this->Leaf.FirstCell +
    (this->CellIds.empty() ? hit.Cell : this->CellIds[static_cast<std::size_t>(hit.Cell)]);
}

//------------------------------------------------------------------------------
/// As VTK finds them, if it does.
void vtkIsosurfaceRayTraceMeshPart::MoveToWholeCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  if (this->CellIds.empty())
  {
    return;
  }
  const auto part = static_cast<std::size_t>(hit.Cell);
  const vtkIdType cell = this->CellIds[part];
  vtkPointSet* grid = this->GetGrid();
  // An observer may have given the grid other cells.
  if (cell >= grid->GetNumberOfCells() || grid->GetCellType(cell) == this->Shapes[part])
  {
    return;
  }
  vtkNew<vtkGenericCell> whole;
  grid->GetCell(cell, whole);
  const vtkirt::Vector3 position = this->Field->GetPoint(hit);
  std::vector<double> weights(static_cast<std::size_t>(whole->GetNumberOfPoints()));
  vtkirt::Vector3 closest;
  vtkirt::Vector3 found;
  double distance = 0.0;
  int subId = 0;
  const std::unique_lock<std::mutex> lock = LockEvaluation(whole->GetCellType());
  if (whole->EvaluatePosition(
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
    if (square < least && cell.Ids[i] < this->CountPointsOfGrid())
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
  const std::int64_t center = point - this->CountPointsOfGrid();
  return center < 0
    ? this->Leaf.Colors->GetComponent(point, component)
    : FindMean(this->Leaf.Colors, this->Centers[static_cast<std::size_t>(center)], component);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshPart::IsIntact() const
{
  const vtkDataArray* colors = this->Leaf.Colors;
  return (!colors || colors->GetNumberOfTuples() >= this->CountPointsOfGrid()) &&
    std::all_of(this->ReadArrays.begin(), this->ReadArrays.end(),
      [](const ReadArray& read)
      {
        return read.Array->GetVoidPointer(0) == read.Memory &&
          read.Array->GetNumberOfValues() >= read.Values;
      });
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshPart::AddObjects(std::vector<vtkObject*>& objects) const
{
  objects.insert(objects.end(), { this->GetGrid(), this->Leaf.Colors });
  const std::vector<vtkObject*> parts = FindParts(this->GetGrid(), this->Scalars.Array);
  objects.insert(objects.end(), parts.begin(), parts.end());
  for (const ReadArray& read : this->ReadArrays)
  {
    objects.push_back(read.Array);
  }
}

VTK_ABI_NAMESPACE_END
