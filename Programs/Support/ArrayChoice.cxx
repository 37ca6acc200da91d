// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ArrayChoice.h"

#include <vtkAbstractVolumeMapper.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace Programs
{
namespace
{

std::array<vtkDataSetAttributes*, 2> GetAttributes(vtkDataSet* block)
{
  return { block->GetPointData(), block->GetCellData() };
}

//------------------------------------------------------------------------------
/// The names of the arrays of numbers that have one, but for the marks of ghosts.
std::vector<std::string> FindNames(vtkDataSetAttributes* attributes)
{
  std::vector<std::string> names;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    const char* name = attributes->GetArray(i) ? attributes->GetArrayName(i) : nullptr;
    if (name && name != std::string(vtkDataSetAttributes::GhostArrayName()))
    {
      names.emplace_back(name);
    }
  }
  return names;
}

//------------------------------------------------------------------------------
/// The array of this name; without one, the active scalars or else the first array. Null if there
/// is none.
vtkDataArray* Find(vtkDataSetAttributes* attributes, const std::string& name)
{
  if (!name.empty())
  {
    return attributes->GetArray(name.c_str());
  }
  const std::vector<std::string> names = FindNames(attributes);
  const bool isActive = attributes->GetScalars() || names.empty();
  return isActive ? attributes->GetScalars() : attributes->GetArray(names.front().c_str());
}

}

//------------------------------------------------------------------------------
ArrayChoice::ArrayChoice(const std::vector<vtkDataSet*>& blocks, const std::string& name)
  : Name(name)
{
  for (vtkDataSet* block : blocks)
  {
    for (vtkDataSetAttributes* attributes : GetAttributes(block))
    {
      if (vtkDataArray* array = Find(attributes, name))
      {
        this->Name = array->GetName() ? array->GetName() : "";
        this->OfCells = attributes == block->GetCellData();
        return;
      }
    }
  }
  const std::string which = name.empty() ? "" : " \"" + name + "\"";
  throw std::runtime_error("there is no array" + which +
    " of points or cells; those there are (for --array):" + ListArrays(blocks));
}

//------------------------------------------------------------------------------
vtkDataArray* ArrayChoice::FindIn(vtkDataSet* block) const
{
  vtkDataSetAttributes* attributes = GetAttributes(block)[this->OfCells ? 1 : 0];
  return this->Name.empty() ? attributes->GetScalars() : attributes->GetArray(this->Name.c_str());
}

//------------------------------------------------------------------------------
void ArrayChoice::SelectFor(vtkAbstractVolumeMapper* mapper) const
{
  if (this->Name.empty())
  {
    mapper->SetScalarMode(
      this->OfCells ? VTK_SCALAR_MODE_USE_CELL_DATA : VTK_SCALAR_MODE_USE_POINT_DATA);
    return;
  }
  mapper->SetScalarMode(
    this->OfCells ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  mapper->SelectScalarArray(this->Name.c_str());
}

//------------------------------------------------------------------------------
ArrayChoice ChooseArray(vtkDataSet* data, const std::string& name, const std::string& fileName)
{
  try
  {
    return { { data }, name };
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(fileName + ": " + error.what());
  }
}

//------------------------------------------------------------------------------
std::string ListArrays(const std::vector<vtkDataSet*>& blocks)
{
  std::vector<std::string> all;
  for (vtkDataSet* block : blocks)
  {
    for (vtkDataSetAttributes* attributes : GetAttributes(block))
    {
      for (const std::string& name : FindNames(attributes))
      {
        if (std::find(all.begin(), all.end(), name) == all.end())
        {
          all.push_back(name);
        }
      }
    }
  }
  std::string list;
  for (const std::string& name : all)
  {
    list += " " + name;
  }
  return list.empty() ? " none" : list;
}

}
