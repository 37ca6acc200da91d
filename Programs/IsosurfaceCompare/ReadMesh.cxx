// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadMesh.h"

#include "Support/ReadDataObject.h"

#include <vtkAppendFilter.h>
#include <vtkCellData.h>
#include <vtkCellDataToPointData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>

#include <stdexcept>

namespace Compare
{
namespace
{

//------------------------------------------------------------------------------
/// Null if there is no mesh.
vtkSmartPointer<vtkPointSet> FindMesh(vtkDataObject* data)
{
  if (vtkUnstructuredGrid::SafeDownCast(data) || vtkStructuredGrid::SafeDownCast(data))
  {
    return vtkPointSet::SafeDownCast(data);
  }
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return nullptr;
  }
  vtkNew<vtkAppendFilter> append;
  const auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    if (const vtkSmartPointer<vtkPointSet> block = FindMesh(iterator->GetCurrentDataObject()))
    {
      append->AddInputData(block);
    }
  }
  if (append->GetNumberOfInputConnections(0) == 0)
  {
    return nullptr;
  }
  append->Update();
  return append->GetOutput();
}

//------------------------------------------------------------------------------
std::string FindNameOfArray(vtkPointSet* mesh)
{
  vtkPointData* points = mesh->GetPointData();
  vtkDataArray* const ghosts = points->GetArray(vtkDataSetAttributes::GhostArrayName());
  vtkDataArray* scalars = points->GetScalars();
  for (int i = 0; !scalars && i < points->GetNumberOfArrays(); ++i)
  {
    scalars = points->GetArray(i) != ghosts ? points->GetArray(i) : nullptr;
  }
  return scalars && scalars->GetName() ? scalars->GetName() : "";
}

//------------------------------------------------------------------------------
std::string ListArrays(vtkPointSet* mesh)
{
  std::string list;
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(mesh->GetPointData()),
      static_cast<vtkDataSetAttributes*>(mesh->GetCellData()) })
  {
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      const char* name = attributes->GetArrayName(i);
      list += attributes->GetArray(i) && name ? std::string(" ") + name : "";
    }
  }
  return list.empty() ? " none" : list;
}

//------------------------------------------------------------------------------
/// Returns the mesh, or one with the scalars of its cells at its points.
vtkSmartPointer<vtkPointSet> SelectArray(
  vtkPointSet* mesh, const std::string& array, const std::string& fileName)
{
  const std::string name = array.empty() ? FindNameOfArray(mesh) : array;
  if (mesh->GetPointData()->GetArray(name.c_str()))
  {
    mesh->GetPointData()->SetActiveScalars(name.c_str());
    return mesh;
  }
  if (!mesh->GetCellData()->GetArray(name.c_str()))
  {
    const std::string missing =
      name.empty() ? " has no array of points" : " has no array \"" + name + "\"";
    throw std::runtime_error(fileName + missing + "; it has:" + ListArrays(mesh));
  }
  vtkNew<vtkCellDataToPointData> average;
  average->SetInputData(mesh);
  average->ProcessAllArraysOff();
  average->AddCellDataArray(name.c_str());
  average->Update();
  auto* averaged = vtkPointSet::SafeDownCast(average->GetOutput());
  averaged->GetPointData()->SetActiveScalars(name.c_str());
  return averaged;
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPointSet> ReadMesh(
  const std::string& fileName, const std::string& array, double maxMemory)
{
  const vtkSmartPointer<vtkPointSet> mesh = FindMesh(Programs::ReadDataObject(fileName, maxMemory));
  if (!mesh)
  {
    throw std::runtime_error(fileName + " holds no unstructured and no structured grid");
  }
  return SelectArray(mesh, array, fileName);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkUnstructuredGrid> MakeUnstructured(vtkPointSet* mesh)
{
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(mesh))
  {
    return grid;
  }
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(mesh);
  append->Update();
  return append->GetOutput();
}

}
