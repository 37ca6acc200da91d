// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceGridInput.h"

#include "vtkIsosurfaceRayTraceCropping.h"
#include "vtkIsosurfaceRayTraceEnumerators.h"
#include "vtkIsosurfaceRayTraceImageColors.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"
#include "vtkVolumeProperty.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceGridInput::Select(vtkVolumeProperty* property)
{
  std::string problem = this->SelectGrid();
  if (!problem.empty())
  {
    return problem;
  }
  problem = this->Scalars.SelectComponent(
    vtkIsosurfaceRayTraceEnumerators::FindComponent(
      this->Mapper->GetVectorMode(), this->Mapper->GetVectorComponent()),
    property, this->PropertyComponent);
  if (!problem.empty())
  {
    return problem;
  }
  problem = vtkIsosurfaceRayTraceSource::FindProblem(this->Grid, this->Scalars);
  if (!problem.empty())
  {
    return problem;
  }
  problem = vtkIsosurfaceRayTraceCropping::FindProblem(this->Mapper);
  if (!problem.empty())
  {
    return problem;
  }
  return this->SelectColors();
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceGridInput::SelectGrid()
{
  vtkIsosurfaceRayTraceMapper* mapper = this->Mapper;
  vtkDataObject* input = mapper->GetDataObjectInput();
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  this->IsComposite = composite != nullptr;
  this->Grid = vtkDataSet::SafeDownCast(input);
  if (composite)
  {
    const std::string problem = this->Blocks.Update(composite, mapper, mapper->GetColorArrayName());
    this->Grid = this->Blocks.GetGrid();
    this->Scalars.Array = this->Blocks.GetScalars();
    this->Scalars.AreOfCells = this->Blocks.GetLeaves().AreScalarsOfCells();
    return problem;
  }
  if (!vtkImageData::SafeDownCast(input) && !vtkRectilinearGrid::SafeDownCast(input))
  {
    return "There is no input. Give a vtkImageData, a vtkRectilinearGrid or composite data of them "
           "with SetInputData, SetInputDataObject or SetInputConnection.";
  }
  this->Scalars.SelectArray(mapper, this->Grid);
  return "";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceGridInput::SelectColors()
{
  auto* image = vtkImageData::SafeDownCast(this->Mapper->GetInputDataObject(1, 0));
  const std::string name = this->Mapper->GetColorArrayName();
  this->ColorImage = image;
  this->ColorArray = nullptr;
  if (!image && name.empty())
  {
    return "";
  }
  this->ColorArray = vtkIsosurfaceRayTraceColors::FindArray(image ? image : this->Grid, name);
  if (this->ColorArray)
  {
    this->NumberOfColors = this->ColorArray->GetNumberOfTuples();
    const std::string problem = image ? vtkIsosurfaceRayTraceGeometry::FindProblem(image) : "";
    return problem.empty() ? "" : "The image to colour by (port 1): " + problem;
  }
  return vtkIsosurfaceRayTraceColors::DescribeMissing(
    name, image ? "the second input" : "the input");
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceGridInput::Update(int threads)
{
  vtkIsosurfaceRayTraceMapper* mapper = this->Mapper;
  vtkirt::ImageSettings settings;
  settings.MacrocellBranching.clear();
  for (int level = 0; level < mapper->GetNumberOfMacrocellLevels(); ++level)
  {
    settings.MacrocellBranching.push_back(mapper->GetMacrocellBranching(level));
  }
  settings.Layout = vtkIsosurfaceRayTraceEnumerators::ToBrickLayout(mapper->GetBrickLayout());
  settings.BrickSize = mapper->GetBrickSize();
  settings.BrickGroupSize = mapper->GetBrickGroupSize();
  return this->Source.Update(this->Grid, this->Scalars, settings, threads);
}

//------------------------------------------------------------------------------
vtkirt::Visibility vtkIsosurfaceRayTraceGridInput::FindVisible(int /*field*/) const
{
  vtkirt::Visibility visible;
  visible.HiddenCells = this->Source.GetHiddenCells();
  vtkIsosurfaceRayTraceCropping::Apply(this->Mapper, this->Source.GetGeometry(), visible);
  return visible;
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceGridInput::FindBlock(
  vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex) const
{
  return this->IsComposite ? this->Blocks.GetLeaves().FindBlock(cellId, cellInBlock, flatIndex)
                           : nullptr;
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkirt::HitColors> vtkIsosurfaceRayTraceGridInput::MakeColors(
  const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const
{
  if (!this->ColorArray)
  {
    return nullptr;
  }
  return std::make_unique<vtkIsosurfaceRayTraceImageColors>(
    this->ColorImage, this->ColorArray, this->Source, colorsOfValues);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceGridInput::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  return this->IsComposite
    ? this->Blocks.GetCellId(this->Source.FindStructuredCell(hit, parametric))
    : this->Source.FindCell(hit, parametric);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceGridInput::FindPoint(const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 parametric;
  return this->IsComposite
    ? this->Blocks.GetPointId(
        this->Source.FindStructuredCell(hit, parametric), this->Source.FindStructuredPoint(hit))
    : this->Source.FindPoint(hit);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceGridInput::GetNumberOfCells() const
{
  return this->IsComposite ? this->Blocks.GetLeaves().GetNumberOfCells()
                           : this->Grid->GetNumberOfCells();
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceGridInput::GetNumberOfPoints() const
{
  return this->IsComposite ? this->Blocks.GetLeaves().GetNumberOfPoints()
                           : this->Grid->GetNumberOfPoints();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceGridInput::IsIntact() const
{
  return this->Source.IsIntact() &&
    (!this->ColorArray || this->ColorArray->GetNumberOfTuples() >= this->NumberOfColors);
}

//------------------------------------------------------------------------------
std::vector<vtkObject*> vtkIsosurfaceRayTraceGridInput::GetObjects() const
{
  std::vector<vtkObject*> objects = { this->Grid, this->Scalars.Array, this->ColorImage,
    this->ColorArray };
  if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(this->Grid))
  {
    objects.insert(objects.end(),
      { rectilinear->GetXCoordinates(), rectilinear->GetYCoordinates(),
        rectilinear->GetZCoordinates() });
  }
  return objects;
}

VTK_ABI_NAMESPACE_END
