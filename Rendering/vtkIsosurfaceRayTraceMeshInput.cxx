// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMeshInput.h"

#include "vtkIsosurfaceRayTraceEnumerators.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkIsosurfaceRayTraceProblems.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
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

#include "Math/Matrix.h"

#include <algorithm>
#include <limits>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using vtkirt::CellShape;

static_assert(static_cast<int>(CellShape::Tetrahedron) == VTK_TETRA);
static_assert(static_cast<int>(CellShape::Voxel) == VTK_VOXEL);
static_assert(static_cast<int>(CellShape::Hexahedron) == VTK_HEXAHEDRON);
static_assert(static_cast<int>(CellShape::Wedge) == VTK_WEDGE);
static_assert(static_cast<int>(CellShape::Pyramid) == VTK_PYRAMID);

constexpr vtkirt::Matrix4 Identity = { 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
  0.0, 0.0, 0.0, 1.0 };

bool IsTraced(int shape)
{
  return vtkirt::GetTraits(static_cast<CellShape>(shape)).Corners > 0;
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

}

//------------------------------------------------------------------------------
/// While it is the same, so is the field.
struct vtkIsosurfaceRayTraceMeshInput::Key
{
  vtkPointSet* Grid;
  vtkMTimeType GridTime;
  vtkDataArray* Array;
  vtkMTimeType ArrayTime;
  const void* Points;
  bool AreOfCells;
  int Component;

  bool operator==(const Key& other) const
  {
    return this->Grid == other.Grid && this->GridTime == other.GridTime &&
      this->Array == other.Array && this->ArrayTime == other.ArrayTime &&
      this->Points == other.Points && this->AreOfCells == other.AreOfCells &&
      this->Component == other.Component;
  }
};

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshInput::vtkIsosurfaceRayTraceMeshInput(
  vtkIsosurfaceRayTraceMeshMapper* mapper)
  : Mapper(mapper)
{
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshInput::~vtkIsosurfaceRayTraceMeshInput() = default;

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshInput::Select(vtkVolumeProperty* property)
{
  this->Grid = vtkPointSet::SafeDownCast(this->Mapper->GetDataObjectInput());
  if (!vtkUnstructuredGrid::SafeDownCast(this->Grid) &&
    !vtkStructuredGrid::SafeDownCast(this->Grid))
  {
    return "There is no input. Give a vtkUnstructuredGrid or a vtkStructuredGrid with SetInputData "
           "or SetInputConnection.";
  }
  this->Scalars.SelectArray(this->Mapper, this->Grid);
  std::string problem = this->Scalars.SelectComponent(
    vtkIsosurfaceRayTraceEnumerators::FindComponent(
      this->Mapper->GetVectorMode(), this->Mapper->GetVectorComponent()),
    property, this->PropertyComponent);
  if (!problem.empty())
  {
    return problem;
  }
  problem =
    this->Scalars.FindProblem(this->Grid->GetNumberOfPoints(), this->Grid->GetNumberOfCells());
  if (!problem.empty())
  {
    return problem;
  }
  problem = vtkIsosurfaceRayTraceProblems::FindInGhosts(this->Grid);
  if (!problem.empty())
  {
    return problem;
  }
  if (this->Built && this->MakeKey() == *this->Built)
  {
    return "";
  }
  this->Built.reset();
  this->Field.reset();
  return this->SelectCells();
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshInput::Key vtkIsosurfaceRayTraceMeshInput::MakeKey() const
{
  vtkPoints* points = this->Grid->GetPoints();
  vtkDataArray* coordinates = points ? points->GetData() : nullptr;
  return { this->Grid, this->Grid->GetMTime(), this->Scalars.Array, this->Scalars.Array->GetMTime(),
    coordinates && coordinates->HasStandardMemoryLayout() ? coordinates->GetVoidPointer(0)
                                                          : nullptr,
    this->Scalars.AreOfCells, this->Scalars.Component };
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshInput::SelectCells()
{
  this->View = {};
  this->View.NumberOfPoints = this->Grid->GetNumberOfPoints();
  this->Shapes.clear();
  this->Offsets.clear();
  this->Connectivity.clear();
  this->CellIds.clear();
  if (auto* structured = vtkStructuredGrid::SafeDownCast(this->Grid))
  {
    vtkirt::Index3& dimensions = this->View.Dimensions;
    structured->GetDimensions(dimensions.data());
    if (std::min({ dimensions[0], dimensions[1], dimensions[2] }) < 2)
    {
      return "The input has " + std::to_string(dimensions[0]) + " x " +
        std::to_string(dimensions[1]) + " x " + std::to_string(dimensions[2]) +
        " points. An isosurface needs cells of three dimensions: at least 2 points along each "
        "axis.";
    }
    if (this->View.NumberOfPoints != static_cast<std::int64_t>(vtkirt::Count(dimensions)))
    {
      return "The input has " + std::to_string(this->View.NumberOfPoints) +
        " points, but its dimensions ask for " + std::to_string(vtkirt::Count(dimensions)) + ".";
    }
    return "";
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(this->Grid);
  const vtkIdType cells = grid->GetNumberOfCells();
  if (cells > static_cast<vtkIdType>(std::numeric_limits<std::uint32_t>::max()))
  {
    return "The input has more than 2^32 - 1 cells. Give it in several pieces.";
  }
  bool hasOthers = false;
  bool hasTraced = false;
  vtkNew<vtkGenericCell> generic;
  for (vtkIdType i = 0; i < cells; ++i)
  {
    const int shape = grid->GetCellType(i);
    this->Shapes.push_back(static_cast<unsigned char>(shape));
    if (IsTraced(shape))
    {
      hasTraced = true;
    }
    else if (!hasOthers && shape > VTK_PYRAMID)
    {
      generic->SetCellType(shape);
      hasOthers = generic->GetCellDimension() == 3;
    }
  }
  if (!hasTraced && !hasOthers)
  {
    return "The input has no cells of three dimensions. Give tetrahedra, hexahedra, voxels, wedges "
           "or pyramids.";
  }
  this->SelectListedCells(grid);
  const std::string problem = vtkirt::FindProblem(
    this->View, grid->GetCells()->GetConnectivityArray()->GetNumberOfValues(), 1);
  if (problem.empty() && hasOthers)
  {
    this->SubdivideCells(grid);
  }
  return problem;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshInput::SelectListedCells(vtkUnstructuredGrid* grid)
{
  vtkCellArray* cells = grid->GetCells();
  vtkDataArray* offsets = cells->GetOffsetsArray();
  vtkDataArray* connectivity = cells->GetConnectivityArray();
  const auto idType = FindIdType(connectivity);
  this->View.NumberOfCells = grid->GetNumberOfCells();
  this->View.Shapes = this->Shapes.data();
  if (idType && FindIdType(offsets) == idType)
  {
    this->View.IdType = *idType;
    this->View.Offsets = offsets->GetVoidPointer(0);
    this->View.Connectivity = connectivity->GetVoidPointer(0);
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
/// Quadratic cells, polyhedra and others become tetrahedra, as VTK subdivides them.
void vtkIsosurfaceRayTraceMeshInput::SubdivideCells(vtkUnstructuredGrid* grid)
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
  vtkNew<vtkGenericCell> generic;
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    const int shape = this->Shapes[static_cast<std::size_t>(i)];
    if (IsTraced(shape))
    {
      grid->GetCellPoints(i, ids);
      add(shape, ids, 0, ids->GetNumberOfIds(), i);
      continue;
    }
    grid->GetCell(i, generic);
    if (generic->GetCellDimension() == 3 && generic->Triangulate(0, ids, points) != 0)
    {
      for (vtkIdType first = 0; first + 4 <= ids->GetNumberOfIds(); first += 4)
      {
        add(VTK_TETRA, ids, first, 4, i);
      }
    }
  }
  this->Shapes = std::move(shapes);
  this->Offsets = std::move(offsets);
  this->Connectivity = std::move(connectivity);
  this->View.NumberOfCells = static_cast<std::int64_t>(this->Shapes.size());
  this->View.Shapes = this->Shapes.data();
  this->View.IdType = vtkirt::ScalarType::Int64;
  this->View.Offsets = this->Offsets.data();
  this->View.Connectivity = this->Connectivity.data();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshInput::SelectPoints()
{
  this->PlainPoints = nullptr;
  vtkDataArray* points = this->Grid->GetPoints()->GetData();
  const bool isReal = points->GetDataType() == VTK_FLOAT || points->GetDataType() == VTK_DOUBLE;
  if (!isReal || !points->HasStandardMemoryLayout())
  {
    this->PlainPoints.TakeReference(vtkDataArray::CreateDataArray(VTK_DOUBLE));
    this->PlainPoints->DeepCopy(points);
    points = this->PlainPoints;
  }
  this->View.Points = points->GetVoidPointer(0);
  this->View.PointType =
    points->GetDataType() == VTK_FLOAT ? vtkirt::ScalarType::Float32 : vtkirt::ScalarType::Float64;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshInput::SelectValues()
{
  vtkIsosurfaceRayTraceScalars ofPoints = this->Scalars;
  this->PointScalars = nullptr;
  if (this->Scalars.AreOfCells)
  {
    // The averages are those of VTK.
    auto copy = vtk::TakeSmartPointer(this->Grid->NewInstance());
    copy->CopyStructure(this->Grid);
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
  const vtkIsosurfaceRayTraceScalars::View values = ofPoints.MakeView(this->PlainScalars);
  this->View.Values = values.Values;
  this->View.ValueType = values.Type;
  this->View.ValueStride = values.Stride;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshInput::FindHiddenCells()
{
  this->HiddenCells.clear();
  vtkUnsignedCharArray* cellFlags = this->Grid->GetCellGhostArray();
  vtkUnsignedCharArray* pointFlags = this->Grid->GetPointGhostArray();
  if (!cellFlags && !pointFlags)
  {
    return;
  }
  constexpr int hiddenCell = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL |
    vtkDataSetAttributes::DUPLICATECELL;
  const vtkirt::MeshCells cells(this->View);
  const std::int64_t count = cells.GetNumberOfCells();
  this->HiddenCells.resize(static_cast<std::size_t>(count), 0);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const auto number = static_cast<std::size_t>(i);
    const vtkIdType id = this->CellIds.empty() ? i : this->CellIds[number];
    bool isHidden = cellFlags && (cellFlags->GetValue(id) & hiddenCell) != 0;
    vtkirt::MeshCell cell;
    if (pointFlags && cells.LoadIds(i, cell))
    {
      isHidden = isHidden ||
        std::any_of(cell.Ids, cell.Ids + cell.Count,
          [pointFlags](vtkIdType point)
          { return (pointFlags->GetValue(point) & vtkDataSetAttributes::HIDDENPOINT) != 0; });
    }
    this->HiddenCells[number] = isHidden ? 1 : 0;
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshInput::Update(int threads)
{
  if (this->Field)
  {
    return false;
  }
  this->SelectPoints();
  this->SelectValues();
  this->FindHiddenCells();
  this->Field = std::make_unique<vtkirt::MeshField>(this->View, threads);
  this->Built = std::make_unique<Key>(this->MakeKey());
  return true;
}

//------------------------------------------------------------------------------
vtkirt::Visibility vtkIsosurfaceRayTraceMeshInput::FindVisible() const
{
  vtkirt::Visibility visible;
  visible.HiddenCells = this->HiddenCells.empty() ? nullptr : this->HiddenCells.data();
  return visible;
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 vtkIsosurfaceRayTraceMeshInput::FindPhysicalFromObject() const
{
  return Identity;
}

//------------------------------------------------------------------------------
const vtkirt::Matrix4& vtkIsosurfaceRayTraceMeshInput::GetPhysicalFromObject() const
{
  return Identity;
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkirt::HitColors> vtkIsosurfaceRayTraceMeshInput::MakeColors(
  const vtkIsosurfaceRayTraceValueColors& /*colorsOfValues*/) const
{
  return nullptr;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshInput::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  parametric = hit.Parametric;
  return this->CellIds.empty() ? hit.Cell : this->CellIds[static_cast<std::size_t>(hit.Cell)];
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshInput::FindNearestPoint(
  vtkDataSet* grid, vtkIdType cell, const double position[3])
{
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(cell, ids);
  vtkIdType nearest = -1;
  double least = VTK_DOUBLE_MAX;
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    const double square = vtkMath::Distance2BetweenPoints(grid->GetPoint(ids->GetId(i)), position);
    if (square < least)
    {
      least = square;
      nearest = ids->GetId(i);
    }
  }
  return nearest;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshInput::FindPoint(const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 parametric;
  const vtkIdType cell = this->FindCell(hit, parametric);
  return FindNearestPoint(this->Grid, cell, this->Field->GetPoint(hit).data());
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceMeshInput::FindBlock(
  vtkIdType /*cellId*/, vtkIdType& /*cellInBlock*/, unsigned int& /*flatIndex*/) const
{
  return nullptr;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshInput::GetNumberOfCells() const
{
  return this->Grid->GetNumberOfCells();
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshInput::GetNumberOfPoints() const
{
  return this->Grid->GetNumberOfPoints();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshInput::IsIntact() const
{
  return this->Built && this->Grid->GetNumberOfPoints() >= this->View.NumberOfPoints &&
    this->MakeKey().Points == this->Built->Points &&
    (this->PlainScalars || this->PointScalars ||
      this->Scalars.Array->GetNumberOfTuples() >= this->View.NumberOfPoints);
}

//------------------------------------------------------------------------------
std::vector<vtkObject*> vtkIsosurfaceRayTraceMeshInput::GetObjects() const
{
  auto* listed = vtkUnstructuredGrid::SafeDownCast(this->Grid);
  return { this->Grid, this->Grid->GetPoints(), this->Scalars.Array,
    listed ? listed->GetCells() : nullptr };
}

VTK_ABI_NAMESPACE_END
