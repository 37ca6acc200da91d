// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceTracedCells.h"

#include "vtkIsosurfaceRayTraceGridLists.h"
#include "vtkIsosurfaceRayTraceReadArrays.h"
#include "vtkIsosurfaceRayTraceSubdivision.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include "Mesh/MeshCells.h"
#include "Mesh/Tetrahedralization.h"

#include <algorithm>
#include <limits>
#include <optional>

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

constexpr std::int64_t MaximumCells = std::numeric_limits<std::uint32_t>::max();

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

double MeanOf(vtkDataArray* array, const std::vector<vtkIdType>& points, int component)
{
  double sum = 0.0;
  for (const vtkIdType point : points)
  {
    sum += array->GetComponent(point, component);
  }
  return sum / static_cast<double>(points.size());
}

}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceTracedCells::HasVolume(vtkDataSet* grid)
{
  if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    int dimensions[3];
    structured->GetDimensions(dimensions);
    return *std::min_element(dimensions, dimensions + 3) >= 2;
  }
  // Of what has no types, Select says so.
  auto* listed = vtkUnstructuredGrid::SafeDownCast(grid);
  return !HasAllTypes(listed) || HasType(listed, IsSolid);
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceTracedCells::Select(vtkPointSet* grid, bool isTetrahedralized,
  bool areAllRead, int threads, vtkIsosurfaceRayTraceReadArrays& arrays)
{
  this->View.NumberOfPoints = grid->GetNumberOfPoints();
  auto* structured = vtkStructuredGrid::SafeDownCast(grid);
  const std::string problem = structured
    ? this->SelectLattice(structured)
    : this->SelectListed(vtkUnstructuredGrid::SafeDownCast(grid), areAllRead, threads, arrays);
  if (!problem.empty() || !isTetrahedralized)
  {
    return problem;
  }
  const std::int64_t tetrahedra =
    vtkirt::CountTetrahedra(vtkirt::MeshCells(this->View, threads), threads);
  return tetrahedra <= MaximumCells
    ? ""
    : "The cells of the input are split into " + std::to_string(tetrahedra) +
      " tetrahedra, more than 2^32 - 1. Give it in several pieces, or call TetrahedralizeOff.";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceTracedCells::SelectLattice(vtkStructuredGrid* grid)
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
std::string vtkIsosurfaceRayTraceTracedCells::SelectListed(
  vtkUnstructuredGrid* grid, bool areAllRead, int threads, vtkIsosurfaceRayTraceReadArrays& arrays)
{
  const vtkIdType count = grid->GetNumberOfCells();
  if (count > MaximumCells)
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
  this->ViewListed(grid, arrays);
  const bool areSubdivided =
    HasType(grid, [](int type) { return !IsTraced(type) && IsSolid(type); });
  const auto checked =
    areSubdivided || areAllRead ? vtkirt::CheckedCells::All : vtkirt::CheckedCells::Traced;
  const std::string problem = vtkirt::FindProblem(
    this->View, grid->GetCells()->GetConnectivityArray()->GetNumberOfValues(), threads, checked);
  return problem.empty() && areSubdivided ? this->Subdivide(grid, threads) : problem;
}

//------------------------------------------------------------------------------
/// Reads the lists of cells where they are, if their types allow it.
void vtkIsosurfaceRayTraceTracedCells::ViewListed(
  vtkUnstructuredGrid* grid, vtkIsosurfaceRayTraceReadArrays& arrays)
{
  this->View.NumberOfCells = grid->GetNumberOfCells();
  this->View.Shapes = static_cast<const unsigned char*>(arrays.Read(Lists::GetTypes(grid)));
  vtkCellArray* cells = grid->GetCells();
  vtkDataArray* offsets = cells->GetOffsetsArray();
  vtkDataArray* connectivity = cells->GetConnectivityArray();
  const auto idType = FindIdType(connectivity);
  if (idType && FindIdType(offsets) == idType)
  {
    this->View.IdType = *idType;
    this->View.Offsets = arrays.Read(offsets);
    this->View.Connectivity = arrays.Read(connectivity);
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
std::string vtkIsosurfaceRayTraceTracedCells::Subdivide(vtkUnstructuredGrid* grid, int threads)
{
  this->Parts.emplace();
  const std::string problem = this->Parts->Subdivide(grid, threads);
  this->View.NumberOfPoints += static_cast<std::int64_t>(this->Parts->Centers.size());
  this->View.NumberOfCells = static_cast<std::int64_t>(this->Parts->Shapes.size());
  this->View.Shapes = this->Parts->Shapes.data();
  this->View.IdType = vtkirt::ScalarType::Int64;
  this->View.Offsets = this->Parts->Offsets.data();
  this->View.Connectivity = this->Parts->Connectivity.data();
  return problem;
}

//------------------------------------------------------------------------------
/// Adds what the centres of polyhedra have to an array of the points.
void vtkIsosurfaceRayTraceTracedCells::AddMeans(vtkDataArray* array) const
{
  const int components = array->GetNumberOfComponents();
  std::vector<double> mean(static_cast<std::size_t>(components));
  vtkIdType center = this->CountPointsOfGrid();
  for (const std::vector<vtkIdType>& points : this->Parts->Centers)
  {
    for (int i = 0; i < components; ++i)
    {
      mean[i] = MeanOf(array, points, i);
    }
    array->InsertTuple(center++, mean.data());
  }
}

//------------------------------------------------------------------------------
std::int64_t vtkIsosurfaceRayTraceTracedCells::CountPointsOfGrid() const
{
  return this->View.NumberOfPoints -
    (this->Parts ? static_cast<std::int64_t>(this->Parts->Centers.size()) : 0);
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceTracedCells::FindMean(
  std::int64_t center, vtkDataArray* array, int component) const
{
  const auto number = static_cast<std::size_t>(center - this->CountPointsOfGrid());
  return MeanOf(array, this->Parts->Centers[number], component);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceTracedCells::Tetrahedralize(vtkirt::MeshView& view, int threads)
{
  const vtkirt::MeshCells cells(view, threads);
  if (vtkirt::AreAllTetrahedra(cells))
  {
    return;
  }
  this->Tetrahedra.emplace(cells, threads);
  this->Offsets = {};
  this->Connectivity = {};
  if (this->Parts)
  {
    this->Parts->Shapes = {};
    this->Parts->Offsets = {};
    this->Parts->Connectivity = {};
  }
  view = this->Tetrahedra->MakeView(view);
  this->View = this->Tetrahedra->MakeView(this->View);
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceTracedCells::GetWarning() const
{
  return !this->Parts || this->Parts->FirstHull < 0
    ? ""
    : "Cell " + std::to_string(this->Parts->FirstHull) +
      " is a polyhedron that is not convex, and not all of it is seen from its centre. It is drawn "
      "as its convex hull, and so are others like it. Divide them into convex cells.";
}

VTK_ABI_NAMESPACE_END
