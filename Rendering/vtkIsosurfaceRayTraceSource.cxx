// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSource.h"

#include "MappingsInUse.h"
#include "vtkIsosurfaceRayTraceGhosts.h"
#include "vtkIsosurfaceRayTraceMacrocellCache.h"
#include "vtkIsosurfaceRayTraceProblems.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <sstream>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// The flags of the cells of a grid, of which those with a hidden point are hidden.
std::vector<unsigned char> FindCellFlags(
  vtkDataSet* grid, const vtkirt::Index3& points, const vtkirt::Index3& cells)
{
  std::vector<unsigned char> flags(vtkirt::Count(cells), 0);
  if (vtkUnsignedCharArray* ofCells = grid->GetCellGhostArray())
  {
    std::copy_n(ofCells->GetPointer(0), flags.size(), flags.begin());
  }
  vtkUnsignedCharArray* ofPoints = grid->GetPointGhostArray();
  for (int z = 0; ofPoints && z < cells[2]; ++z)
  {
    for (int y = 0; y < cells[1]; ++y)
    {
      for (int x = 0; x < cells[0]; ++x)
      {
        if (vtkIsosurfaceRayTraceGhosts::HasAtCorner(ofPoints->GetPointer(0), { x, y, z }, points,
              vtkIsosurfaceRayTraceGhosts::HiddenPoint))
        {
          flags[vtkirt::Offset({ x, y, z }, cells)] |= vtkDataSetAttributes::HIDDENCELL;
        }
      }
    }
  }
  return flags;
}

}

//------------------------------------------------------------------------------
/// What a field was built from, and how. While it is the same, so is the field.
struct vtkIsosurfaceRayTraceSource::Key
{
  vtkDataArray* Array;
  vtkMTimeType ArrayTime;
  const void* Buffer;
  vtkIdType NumberOfValues;
  vtkirt::Index3 Dimensions;
  bool AreOfCells;
  int Component;
  vtkirt::ImageSettings Settings;

  bool operator==(const Key& other) const
  {
    return this->Array == other.Array && this->ArrayTime == other.ArrayTime &&
      this->Buffer == other.Buffer && this->NumberOfValues == other.NumberOfValues &&
      this->Dimensions == other.Dimensions && this->AreOfCells == other.AreOfCells &&
      this->Component == other.Component && this->Settings == other.Settings;
  }
};

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSource::vtkIsosurfaceRayTraceSource() = default;
vtkIsosurfaceRayTraceSource::~vtkIsosurfaceRayTraceSource() = default;

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceSource::FindProblem(
  vtkDataSet* grid, const vtkIsosurfaceRayTraceScalars& selection)
{
  const vtkirt::Index3 dimensions = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  if (std::min({ dimensions[0], dimensions[1], dimensions[2] }) < 2)
  {
    return FindProblemOfSize(grid, selection.AreOfCells);
  }
  const std::string problem =
    selection.FindProblem(grid->GetNumberOfPoints(), grid->GetNumberOfCells());
  if (!problem.empty())
  {
    return problem;
  }
  const std::string ofGhosts = vtkIsosurfaceRayTraceProblems::FindInGhosts(grid);
  return ofGhosts.empty() ? vtkIsosurfaceRayTraceGeometry::FindProblem(grid) : ofGhosts;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceSource::FindProblemOfSize(vtkDataSet* grid, bool areOfCells)
{
  const vtkirt::Index3 dimensions = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  if (std::min({ dimensions[0], dimensions[1], dimensions[2] }) >= (areOfCells ? 3 : 2))
  {
    return "";
  }
  std::ostringstream text;
  text << "The input has " << dimensions[0] << " x " << dimensions[1] << " x " << dimensions[2]
       << " points. An isosurface needs at least 2 samples along each axis, which are "
       << (areOfCells ? "2 cells, as the scalars are those of cells." : "2 points.");
  return text.str();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSource::Update(vtkDataSet* grid,
  const vtkIsosurfaceRayTraceScalars& selection, const vtkirt::ImageSettings& settings,
  const std::string& cacheDirectory, int threads)
{
  vtkDataArray* scalars = selection.Array;
  Key key;
  key.Array = scalars;
  key.ArrayTime = scalars->GetMTime();
  key.Buffer = scalars->HasStandardMemoryLayout() ? scalars->GetVoidPointer(0) : nullptr;
  key.NumberOfValues = scalars->GetNumberOfValues();
  key.AreOfCells = selection.AreOfCells;
  key.Component = selection.Component;
  key.Settings = settings;
  key.Dimensions = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  for (int& dimension : key.Dimensions)
  {
    dimension -= selection.AreOfCells ? 1 : 0;
  }

  // After writing into the scalars, applications often call Modified() of the grid, not of the
  // array. So a change of the grid counts as one of the scalars. Those in a file take long to read,
  // and nobody writes into them: a change of the geometry explains that of the grid.
  vtkIsosurfaceRayTraceGeometry geometry(grid, selection.AreOfCells);
  const bool isNewer = grid->GetMTime() != this->GridTime;
  const bool gridChanged =
    isNewer && (!this->View.AreInFile || geometry.HasSamePoints(this->Geometry));
  if (isNewer || !this->Built || this->Built->AreOfCells != key.AreOfCells)
  {
    this->GridTime = 0; // Until the hidden cells are there: memory for them may fail.
    this->AtCoarse = false;
    this->Coarse.reset();
    const std::vector<unsigned char> before = this->HiddenCells;
    this->UpdateHiddenCells(grid, selection.AreOfCells);
    if (this->HiddenCells != before)
    {
      this->Field.reset();
    }
  }
  this->GridTime = grid->GetMTime();
  this->Geometry = std::move(geometry);
  if (this->Field && this->Built && *this->Built == key && !gridChanged)
  {
    this->Field->SetPlanes(this->Geometry.GetPlanes());
    return false;
  }

  this->AtCoarse = false;
  this->Coarse.reset(); // Their memory first.
  this->Field.reset();
  this->MakeField(selection, cacheDirectory, key, threads);
  this->Field->SetPlanes(this->Geometry.GetPlanes());
  this->Built = std::make_unique<Key>(key);
  return true;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSource::MakeField(const vtkIsosurfaceRayTraceScalars& selection,
  const std::string& cacheDirectory, const Key& key, int threads)
{
  this->Cache.reset();
  this->CacheProblem.clear();
  const vtkIsosurfaceRayTraceScalars::View samples =
    selection.MakeView(this->PlainScalars, threads);
  vtkirt::VolumeView& view = this->View;
  view.Type = samples.Type;
  view.Samples = samples.Values;
  view.Stride = samples.Stride;
  view.Dimensions = key.Dimensions;
  const ImageFiles::FileMapping* mapping =
    this->PlainScalars ? nullptr : ImageFiles::MappingsInUse::Find(key.Buffer);
  view.AreInFile = mapping != nullptr;
  if (mapping && !cacheDirectory.empty())
  {
    this->Cache =
      std::make_unique<vtkIsosurfaceRayTraceMacrocellCache>(cacheDirectory, *mapping, view);
  }
  this->Field = vtkirt::ImageField::NewUnread(view, key.Settings);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSource::SelectLevel(vtkIsosurfaceRayTraceLevel level, int threads)
{
  using Level = vtkIsosurfaceRayTraceLevel;
  if (level == Level::AsBefore)
  {
    return false;
  }
  const bool wasCoarse = this->AtCoarse;
  const bool isWanted =
    level == Level::Coarse || (level == Level::CoarseUntilRead && this->GetFractionRead() < 1.0);
  this->AtCoarse = isWanted && vtkirt::CoarseLevel::IsOf(this->View.Dimensions);
  if (!this->AtCoarse)
  {
    return wasCoarse;
  }
  if (!this->Coarse)
  {
    this->Coarse = std::make_unique<vtkirt::CoarseLevel>(
      this->View, this->Geometry.GetPlanes(), this->GetHiddenCellsOfSamples());
  }
  const bool isRead = this->Coarse->GetFractionRead() == 1.0;
  if (!isRead)
  {
    this->Coarse->ReadSlices(threads);
  }
  return !wasCoarse || !isRead;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSource::ReadSlab(int threads)
{
  this->Field->ReadSlab(threads, this->Cache.get());
  if (this->Cache && this->Field->GetFractionRead() == 1.0)
  {
    this->CacheProblem = this->Cache->GetProblem();
    this->Cache.reset();
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSource::IsIntact() const
{
  const Key& key = *this->Built;
  return this->PlainScalars ||
    (key.Array->GetSize() >= key.NumberOfValues && key.Array->GetVoidPointer(0) == key.Buffer);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSource::UpdateHiddenCells(vtkDataSet* grid, bool areOfCells)
{
  const vtkirt::Index3 points = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  this->Cells = { points[0] - 1, points[1] - 1, points[2] - 1 };
  this->HiddenCells.clear();
  if (!grid->GetCellGhostArray() && !grid->GetPointGhostArray())
  {
    return;
  }
  using Ghosts = vtkIsosurfaceRayTraceGhosts;
  const std::vector<unsigned char> flags = FindCellFlags(grid, points, this->Cells);
  const int fewer = areOfCells ? 1 : 0;
  const vtkirt::Index3 size = { this->Cells[0] - fewer, this->Cells[1] - fewer,
    this->Cells[2] - fewer };
  this->HiddenCells.reserve(vtkirt::Count(size));
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        const vtkirt::Index3 cell = { x, y, z };
        // A cell between the centres of eight is that of the piece that has the first of them.
        const bool isHidden =
          (flags[vtkirt::Offset(cell, this->Cells)] & (Ghosts::Blanked | Ghosts::Duplicate)) != 0 ||
          (areOfCells && Ghosts::HasAtCorner(flags.data(), cell, this->Cells, Ghosts::Blanked));
        this->HiddenCells.push_back(isHidden ? 1 : 0);
      }
    }
  }
  if (std::count(this->HiddenCells.begin(), this->HiddenCells.end(), 1) == 0)
  {
    this->HiddenCells.clear();
  }
}

//------------------------------------------------------------------------------
const unsigned char* vtkIsosurfaceRayTraceSource::GetHiddenCellsOfSamples() const
{
  return this->HiddenCells.empty() ? nullptr : this->HiddenCells.data();
}

//------------------------------------------------------------------------------
const unsigned char* vtkIsosurfaceRayTraceSource::GetHiddenCells() const
{
  return this->AtCoarse ? this->Coarse->GetHiddenCells() : this->GetHiddenCellsOfSamples();
}

//------------------------------------------------------------------------------
vtkirt::Index3 vtkIsosurfaceRayTraceSource::FindCellOfSamples(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  if (this->AtCoarse)
  {
    return this->Coarse->FindCell(hit, parametric);
  }
  parametric = hit.Parametric;
  return this->Field->GetLattice().GetCell(hit);
}

//------------------------------------------------------------------------------
vtkirt::Index3 vtkIsosurfaceRayTraceSource::FindStructuredCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  vtkirt::Index3 cell = this->FindCellOfSamples(hit, parametric);
  for (std::size_t axis = 0; this->Built->AreOfCells && axis < 3; ++axis)
  {
    // From the centre of one cell to that of the next.
    const double coordinate = parametric[axis];
    const double border = this->Geometry.GetShareOfFirst(axis, cell[axis]);
    const bool isBeyond = coordinate > border || (coordinate == border && !hit.FallsAlong(axis));
    const bool isInNext = isBeyond && border < 1.0;
    cell[axis] += isInNext ? 1 : 0;
    parametric[axis] =
      isInNext ? 0.5 * (coordinate - border) / (1.0 - border) : 0.5 + 0.5 * coordinate / border;
  }
  return cell;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceSource::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  return static_cast<vtkIdType>(
    vtkirt::Offset(this->FindStructuredCell(hit, parametric), this->Cells));
}

//------------------------------------------------------------------------------
vtkirt::Index3 vtkIsosurfaceRayTraceSource::FindStructuredPoint(const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 parametric;
  vtkirt::Index3 point = this->FindCellOfSamples(hit, parametric);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Between the centres of two cells it is the point between these.
    const bool isUpper = this->AtCoarse ? parametric[axis] > 0.5 : hit.IsNearUpper(axis);
    const bool isNext = this->Built->AreOfCells || isUpper;
    point[axis] += isNext ? 1 : 0;
  }
  return point;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceSource::FindPoint(const vtkirt::Hit& hit) const
{
  return static_cast<vtkIdType>(
    vtkirt::Offset(this->FindStructuredPoint(hit), this->GetNumberOfPoints()));
}

VTK_ABI_NAMESPACE_END
