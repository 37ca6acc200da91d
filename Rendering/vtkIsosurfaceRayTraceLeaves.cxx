// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceLeaves.h"

#include "vtkIsosurfaceRayTraceColors.h"
#include "vtkIsosurfaceRayTraceProblems.h"
#include "vtkIsosurfaceRayTraceScalars.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// The array to colour by, if there is a name.
vtkDataArray* FindColors(vtkDataSet* data, const std::string& name)
{
  return name.empty() ? nullptr : vtkIsosurfaceRayTraceColors::FindArray(data, name);
}

}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceLeaf::GetName() const
{
  return "Block " + std::to_string(this->FlatIndex) + " of the composite input";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceLeaves::Collect(vtkCompositeDataSet* input,
  vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName, const Kind& kind)
{
  this->Leaves.clear();
  this->NumberOfPoints = 0;
  this->NumberOfCells = 0;
  const auto iterator = vtk::TakeSmartPointer(input->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    auto* data = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject());
    if (!data || data->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const Leaf leaf = { data, iterator->GetCurrentFlatIndex(), this->NumberOfPoints,
      this->NumberOfCells, nullptr, nullptr };
    this->NumberOfPoints += data->GetNumberOfPoints();
    this->NumberOfCells += data->GetNumberOfCells();
    if (!kind.IsTaken(data))
    {
      return leaf.GetName() + " is a " + data->GetClassName() + ". Give blocks of " + kind.Names +
        ".";
    }
    const std::string problem =
      kind.HasVolume(data) ? this->Append(leaf, mapper, colorArrayName) : "";
    if (!problem.empty())
    {
      return problem;
    }
  }
  return this->Leaves.empty()
    ? std::string(
        "The composite input has no block with a volume and scalars of the requested kind. Give "
        "blocks of ") +
      kind.Names + " with scalars, or name an array with SelectScalarArray()."
    : "";
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceLeaves::Take(
  vtkDataSet* data, vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName)
{
  vtkIsosurfaceRayTraceScalars scalars;
  scalars.SelectArray(mapper, data);
  this->OfCells = scalars.AreOfCells;
  this->NumberOfPoints = data->GetNumberOfPoints();
  this->NumberOfCells = data->GetNumberOfCells();
  this->Leaves = { { data, 0, 0, 0, scalars.Array, FindColors(data, colorArrayName) } };
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
    return leaf.GetName() +
      " has scalars unlike those of the blocks before it. Give all blocks a tuple for every "
      "point, or for every cell, with the same number of components.";
  }
  const std::string problem = vtkIsosurfaceRayTraceProblems::FindInGhosts(leaf.Data);
  if (!problem.empty())
  {
    return leaf.GetName() + ": " + problem;
  }
  leaf.Colors = FindColors(leaf.Data, colorArrayName);
  if (leaf.Colors && first.Colors &&
    leaf.Colors->GetNumberOfComponents() != first.Colors->GetNumberOfComponents())
  {
    return leaf.GetName() + " has " + std::to_string(leaf.Colors->GetNumberOfComponents()) +
      " components to colour by (" + colorArrayName + "), others have " +
      std::to_string(first.Colors->GetNumberOfComponents()) + ". Give all blocks the same number.";
  }
  this->Leaves.push_back(leaf);
  return "";
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceLeaves::FindBlock(
  vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex) const
{
  for (const Leaf& leaf : this->Leaves)
  {
    if (cellId >= leaf.FirstCell && cellId < leaf.FirstCell + leaf.Data->GetNumberOfCells())
    {
      cellInBlock = cellId - leaf.FirstCell;
      flatIndex = leaf.FlatIndex;
      return leaf.Data;
    }
  }
  return nullptr;
}

VTK_ABI_NAMESPACE_END
