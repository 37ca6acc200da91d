// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceGridPart.h"

#include "vtkIsosurfaceRayTraceCropping.h"
#include "vtkIsosurfaceRayTraceLatticeSampling.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// Scales what is visible along each axis.
void Scale(const vtkirt::Vector3& scale, vtkirt::Visibility& visible)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (vtkirt::HalfSpace& half : visible.HalfSpaces)
    {
      half.Normal[axis] /= scale[axis];
    }
    for (double& plane : visible.Regions.Planes[axis])
    {
      plane *= scale[axis];
    }
  }
}

}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceGridPart::IsGrid(vtkDataSet* data)
{
  return vtkImageData::SafeDownCast(data) || vtkRectilinearGrid::SafeDownCast(data);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceGridPart::HasVolume(vtkDataSet* grid)
{
  const vtkirt::Index3 points = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  return std::min({ points[0], points[1], points[2] }) >= 2;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceGridPart::IsOf(const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves) const
{
  const std::vector<vtkIsosurfaceRayTraceBlock>& ours = this->Blocks.Get();
  return std::equal(leaves.begin(), leaves.end(), ours.begin(), ours.end(),
    [](const vtkIsosurfaceRayTraceLeaf& a, const vtkIsosurfaceRayTraceLeaf& b)
    { return a.Data == b.Data; });
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceGridPart::Select(
  const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves, const vtkIsosurfaceRayTraceScalars& scalars,
  const vtkirt::ImageSettings& settings, const std::string& cacheDirectory,
  vtkVolumeMapper* cropping)
{
  this->IsBuilt = false;
  this->Blocks.Update(leaves, scalars.AreOfCells);
  this->Scalars = scalars;
  this->Scalars.Array = this->Blocks.GetScalars();
  this->NumberOfTuples = this->Scalars.Array->GetNumberOfTuples();
  this->Colors = this->Blocks.GetColors();
  this->NumberOfColors = this->Colors ? this->Colors->GetNumberOfTuples() : 0;
  this->Settings = settings;
  this->CacheDirectory = cacheDirectory;
  this->Cropping = cropping;
  return vtkIsosurfaceRayTraceSource::FindProblemOfSize(this->Blocks.GetGrid(), scalars.AreOfCells);
}

//------------------------------------------------------------------------------
vtkirt::TracedField& vtkIsosurfaceRayTraceGridPart::GetField()
{
  if (!this->IsBuilt)
  {
    // It is on demand: so few samples lie close together as they are, and shading reads them again.
    this->Settings.Layout = vtkirt::BrickLayout::Unbricked;
    this->Update(1);
  }
  return *this->Source.GetField();
}

//------------------------------------------------------------------------------
/// A small part is built at once, faster than a file is opened.
bool vtkIsosurfaceRayTraceGridPart::Update(int threads)
{
  const std::string directory = this->IsBuiltOnDemand() ? "" : this->CacheDirectory;
  const bool hadToBeBuilt = !this->IsBuilt &&
    this->Source.Update(this->Blocks.GetGrid(), this->Scalars, this->Settings, directory, threads);
  while (this->IsBuiltOnDemand() && this->GetFractionRead() < 1.0)
  {
    this->ReadSlab(threads);
  }
  this->IsBuilt = true;
  return hadToBeBuilt;
}

//------------------------------------------------------------------------------
vtkirt::Visibility vtkIsosurfaceRayTraceGridPart::FindVisible() const
{
  vtkirt::Visibility visible;
  visible.HiddenCells = this->Source.GetHiddenCells();
  if (this->Cropping)
  {
    vtkIsosurfaceRayTraceCropping::Apply(this->Cropping, this->Source.GetGeometry(), visible);
  }
  if (this->IsCoarse())
  {
    Scale(this->Source.GetCoarseScale(), visible);
  }
  return visible;
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 vtkIsosurfaceRayTraceGridPart::FindPhysicalFromObject() const
{
  vtkirt::Matrix4 matrix =
    vtkIsosurfaceRayTraceGeometry(this->Blocks.GetGrid(), this->Scalars.AreOfCells)
      .GetPhysicalFromObject();
  for (std::size_t i = 0; this->IsCoarse() && i < 12; ++i)
  {
    matrix[i] /= i % 4 < 3 ? this->Source.GetCoarseScale()[i % 4] : 1.0;
  }
  return matrix;
}

//------------------------------------------------------------------------------
/// Larger ones are built faster by all threads.
bool vtkIsosurfaceRayTraceGridPart::IsBuiltOnDemand() const
{
  constexpr vtkIdType largest = 1 << 18;
  return this->NumberOfTuples <= largest;
}

//------------------------------------------------------------------------------
vtkirt::Bounds vtkIsosurfaceRayTraceGridPart::FindBox() const
{
  const vtkirt::Index3 points =
    vtkIsosurfaceRayTraceGeometry::GetDimensions(this->Blocks.GetGrid());
  const int fewer = this->Scalars.AreOfCells ? 2 : 1;
  vtkirt::Bounds box = { { 0.0, 0.0, 0.0 }, {} };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.Upper[axis] = points[axis] - fewer;
    box.Upper[axis] *= this->IsCoarse() ? this->Source.GetCoarseScale()[axis] : 1.0;
  }
  return box;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceGridPart::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  return this->Blocks.GetCellId(this->Source.FindStructuredCell(hit, parametric));
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceGridPart::FindPoint(const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 parametric;
  return this->Blocks.GetPointId(
    this->Source.FindStructuredCell(hit, parametric), this->Source.FindStructuredPoint(hit));
}

//------------------------------------------------------------------------------
std::optional<double> vtkIsosurfaceRayTraceGridPart::FindOpacity() const
{
  return this->Blocks.Get().front().Display.Opacity;
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceLeaf& vtkIsosurfaceRayTraceGridPart::FindLeaf(
  const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 parametric;
  return this->Blocks.FindOwner(this->Source.FindStructuredCell(hit, parametric));
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceGridPart::SampleColors(
  const vtkirt::Hit& hit, int components, double* values) const
{
  vtkirt::Vector3 index;
  const vtkirt::Index3 cell = this->Source.FindStructuredCell(hit, index);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    index[axis] += cell[axis];
  }
  for (int component = 0; component < components; ++component)
  {
    values[component] = vtkIsosurfaceRayTraceSampleLattice(
      this->Colors, this->Source.GetNumberOfPoints(), index, component);
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceGridPart::IsIntact() const
{
  const bool areScalarsIntact = this->IsBuilt
    ? this->Source.IsIntact()
    : this->Scalars.Array->GetNumberOfTuples() >= this->NumberOfTuples;
  return areScalarsIntact &&
    (!this->Colors || this->Colors->GetNumberOfTuples() >= this->NumberOfColors);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceGridPart::AddObjects(std::vector<vtkObject*>& objects) const
{
  vtkDataSet* grid = this->Blocks.GetGrid();
  objects.insert(objects.end(), { grid, this->Scalars.Array, this->Colors });
  if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    objects.insert(objects.end(),
      { rectilinear->GetXCoordinates(), rectilinear->GetYCoordinates(),
        rectilinear->GetZCoordinates() });
  }
}

VTK_ABI_NAMESPACE_END
