// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceLeaves.h"

#include "vtkIsosurfaceRayTraceColors.h"
#include "vtkIsosurfaceRayTraceGridPart.h"
#include "vtkIsosurfaceRayTraceMeshPart.h"
#include "vtkIsosurfaceRayTraceProblems.h"
#include "vtkIsosurfaceRayTraceScalars.h"
#include "vtkIsosurfaceRayTraceTracedCells.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// Finds the array to colour a leaf by, if there is a name: of points, or if there is none of
/// cells.
void FindColors(const std::string& name, vtkIsosurfaceRayTraceLeaf& leaf)
{
  leaf.Colors = name.empty() ? nullptr : vtkIsosurfaceRayTraceColors::FindArray(leaf.Data, name);
  leaf.CellColors = name.empty() || leaf.Colors
    ? nullptr
    : vtkIsosurfaceRayTraceColors::FindCellArray(leaf.Data, name);
}

/// The name of a block; empty if it has none.
std::string FindName(vtkCompositeDataIterator* iterator)
{
  vtkInformation* about =
    iterator->HasCurrentMetaData() != 0 ? iterator->GetCurrentMetaData() : nullptr;
  const char* name = about ? about->Get(vtkCompositeDataSet::NAME()) : nullptr;
  return name ? name : "";
}

/// What is wrong with a block of a class that is not traced.
std::string DescribeClass(vtkDataObject* block)
{
  return std::string("It is a ") + block->GetClassName() +
    ". Give blocks of vtkImageData, vtkRectilinearGrid, vtkUnstructuredGrid or vtkStructuredGrid.";
}

bool IsTraced(vtkDataSet* data)
{
  return vtkIsosurfaceRayTraceGridPart::IsGrid(data) || vtkIsosurfaceRayTraceMeshPart::IsMesh(data);
}

bool HasVolume(vtkDataSet* data)
{
  return vtkIsosurfaceRayTraceGridPart::IsGrid(data)
    ? vtkIsosurfaceRayTraceGridPart::HasVolume(data)
    : vtkIsosurfaceRayTraceTracedCells::HasVolume(data);
}

/// The leaf that has a number, which is then counted from its begin; null if none has it.
const vtkIsosurfaceRayTraceLeaf* FindLeaf(const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves,
  vtkIdType vtkIsosurfaceRayTraceLeaf::*begin, vtkIdType (vtkDataSet::*count)(), vtkIdType& number)
{
  const auto after = std::upper_bound(leaves.begin(), leaves.end(), number,
    [begin](vtkIdType value, const vtkIsosurfaceRayTraceLeaf& leaf)
    { return value < leaf.*begin; });
  if (after == leaves.begin())
  {
    return nullptr;
  }
  const vtkIsosurfaceRayTraceLeaf& leaf = *(after - 1);
  const vtkIdType inLeaf = number - leaf.*begin;
  if (inLeaf >= (leaf.Data->*count)())
  {
    return nullptr;
  }
  number = inLeaf;
  return &leaf;
}

}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceLeaf::GetName() const
{
  return "Block " + std::to_string(this->FlatIndex) +
    (this->Name.empty() ? "" : " (" + this->Name + ")") + " of the composite input";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceLeftOut::Describe() const
{
  if (this->Count < 2)
  {
    return this->First;
  }
  return this->First + " (" + std::to_string(this->Count - 1) +
    (this->Count == 2 ? " other block is" : " other blocks are") + " left out, too.)";
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceLeaves::Change vtkIsosurfaceRayTraceLeaves::Collect(vtkCompositeDataSet* input,
  vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName,
  vtkCompositeDataDisplayAttributes* attributes, int threads)
{
  const vtkMTimeType mapperTime = mapper->vtkObject::GetMTime();
  const bool areSameBlocks =
    mapperTime == this->MapperTime && this->Collected.IsOfBlocks(input, threads);
  if (areSameBlocks && this->Collected.IsOfAttributes(attributes))
  {
    return Change::None;
  }
  this->Collected = {};
  this->LeftOut = {};
  this->Leaves.clear();
  this->SomeAreHidden = false;
  this->SomeHaveOpacities = false;
  this->NumberOfPoints = 0;
  this->NumberOfCells = 0;
  const vtkIsosurfaceRayTraceBlockDisplays displays(input, attributes);
  const auto iterator = vtk::TakeSmartPointer(input->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    vtkDataObject* object = iterator->GetCurrentDataObject();
    auto* data = vtkDataSet::SafeDownCast(object);
    if (!data && object->GetNumberOfElements(vtkDataObject::CELL) > 0 &&
      displays.Get(object).IsVisible)
    {
      // A vtkHyperTreeGrid.
      Leaf other{};
      other.FlatIndex = iterator->GetCurrentFlatIndex();
      other.Name = FindName(iterator);
      this->LeftOut.Add(other, DescribeClass(object));
    }
    if (!data || data->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const Leaf leaf = { data, iterator->GetCurrentFlatIndex(), this->NumberOfPoints,
      this->NumberOfCells, data->GetNumberOfCells(), nullptr, nullptr, nullptr, FindName(iterator),
      displays.Get(data) };
    this->NumberOfPoints += data->GetNumberOfPoints();
    this->NumberOfCells += data->GetNumberOfCells();
    this->SomeAreHidden = this->SomeAreHidden || !leaf.Display.IsVisible;
    if (!leaf.Display.IsVisible)
    {
      continue;
    }
    this->SomeHaveOpacities = this->SomeHaveOpacities || leaf.Display.Opacity;
    const std::string problem = IsTraced(data)
      ? (HasVolume(data) ? this->Append(leaf, mapper, colorArrayName) : "")
      : DescribeClass(data);
    if (!problem.empty())
    {
      this->LeftOut.Add(leaf, problem);
    }
  }
  this->Collected = { input, attributes };
  this->MapperTime = mapperTime;
  return areSameBlocks ? Change::OfDisplay : Change::OfAnything;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceLeaves::Take(
  vtkDataSet* data, vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName)
{
  this->Collected = {};
  this->LeftOut = {};
  this->SomeAreHidden = false;
  this->SomeHaveOpacities = false;
  vtkIsosurfaceRayTraceScalars scalars;
  scalars.SelectArray(mapper, data);
  this->OfCells = scalars.AreOfCells;
  this->NumberOfPoints = data->GetNumberOfPoints();
  this->NumberOfCells = data->GetNumberOfCells();
  this->Leaves = { { data, 0, 0, 0, this->NumberOfCells, scalars.Array, nullptr, nullptr, "",
    {} } };
  FindColors(colorArrayName, this->Leaves.front());
}

//------------------------------------------------------------------------------
/// Appends a block with its arrays, if it has the scalars. Returns why it cannot be traced; else
/// empty.
std::string vtkIsosurfaceRayTraceLeaves::Append(
  Leaf leaf, vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName)
{
  vtkIsosurfaceRayTraceScalars scalars;
  scalars.SelectArray(mapper, leaf.Data);
  leaf.Scalars = scalars.Array;
  if (!leaf.Scalars)
  {
    return "";
  }
  const Leaf& first = this->Leaves.empty() ? leaf : this->Leaves.front();
  if (this->Leaves.empty())
  {
    this->OfCells = scalars.AreOfCells;
  }
  const vtkIdType tuples =
    scalars.AreOfCells ? leaf.Data->GetNumberOfCells() : leaf.Data->GetNumberOfPoints();
  if (this->OfCells != scalars.AreOfCells || leaf.Scalars->GetNumberOfTuples() != tuples ||
    leaf.Scalars->GetNumberOfComponents() != first.Scalars->GetNumberOfComponents())
  {
    return "It has scalars unlike those of the blocks before it. Give all blocks a tuple for every "
           "point, or for every cell, with the same number of components.";
  }
  const std::string problem = vtkIsosurfaceRayTraceProblems::FindInGhosts(leaf.Data);
  if (!problem.empty())
  {
    return problem;
  }
  FindColors(colorArrayName, leaf);
  const vtkDataArray* colors = leaf.GetAnyColors();
  const vtkDataArray* ofFirst = first.GetAnyColors();
  if (colors && ofFirst && colors->GetNumberOfComponents() != ofFirst->GetNumberOfComponents())
  {
    return "It has " + std::to_string(colors->GetNumberOfComponents()) +
      " components to colour by (" + colorArrayName + "), others have " +
      std::to_string(ofFirst->GetNumberOfComponents()) + ". Give all blocks the same number.";
  }
  if (colors && ofFirst && (leaf.CellColors == nullptr) != (first.CellColors == nullptr))
  {
    return "Its array to colour by (" + colorArrayName + ") is one of " +
      (leaf.CellColors ? "cells, those of others are of points."
                       : "points, those of others are of cells.") +
      " Give all blocks arrays of the same kind.";
  }
  this->Leaves.push_back(leaf);
  return "";
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceLeaf* vtkIsosurfaceRayTraceLeaves::FindLeafOfPoint(
  vtkIdType& point) const
{
  return FindLeaf(this->Leaves, &Leaf::FirstPoint, &vtkDataSet::GetNumberOfPoints, point);
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceLeaf* vtkIsosurfaceRayTraceLeaves::FindLeafOfCell(vtkIdType& cell) const
{
  return FindLeaf(this->Leaves, &Leaf::FirstCell, &vtkDataSet::GetNumberOfCells, cell);
}

VTK_ABI_NAMESPACE_END
