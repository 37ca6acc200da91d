// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadData.h"

#include "Support/ArrayChoice.h"
#include "Support/ReadDataObject.h"
#include "Support/ReadVolume.h"

#include <vtkAppendFilter.h>
#include <vtkCellData.h>
#include <vtkCellDataToPointData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
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
/// Data with an array of cells as numbers, which vtkCellDataToPointData averages: VTK 9.1 leaves
/// out ids, and averages bits to what is in memory.
vtkSmartPointer<vtkDataSet> TakeAsNumbers(vtkDataSet* data, const std::string& name)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name.c_str());
  if (!array || (array->GetDataType() != VTK_ID_TYPE && array->GetDataType() != VTK_BIT))
  {
    return data;
  }
  vtkNew<vtkDoubleArray> numbers;
  numbers->DeepCopy(array);
  numbers->SetName(name.c_str());
  auto changed = vtk::TakeSmartPointer(data->NewInstance());
  changed->ShallowCopy(data);
  changed->GetCellData()->AddArray(numbers);
  return changed;
}

/// The data with an array of points, or others with an average of those of cells.
vtkSmartPointer<vtkDataSet> MoveToPoints(vtkDataSet* data, const Programs::ArrayChoice& choice)
{
  if (!choice.IsOfCells())
  {
    return data;
  }
  vtkNew<vtkCellDataToPointData> average;
  average->SetInputData(TakeAsNumbers(data, choice.GetName()));
  average->ProcessAllArraysOff();
  average->AddCellDataArray(choice.GetName().c_str());
  average->Update();
  return average->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataSet> SelectArray(
  vtkDataSet* data, const std::string& name, const std::string& fileName)
{
  const Programs::ArrayChoice choice = Programs::ChooseArray(data, name, fileName);
  const vtkSmartPointer<vtkDataSet> selected = MoveToPoints(data, choice);
  if (!choice.GetName().empty()) // Those without a name are active already.
  {
    selected->GetPointData()->SetActiveScalars(choice.GetName().c_str());
  }
  return selected;
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataSet> ReadData(
  const std::string& fileName, const std::string& array, double maxMemory)
{
  const vtkSmartPointer<vtkDataObject> data = Programs::IsGrid(fileName)
    ? Programs::ReadDataObject(fileName, array, maxMemory)
    : vtkSmartPointer<vtkDataObject>(Programs::ReadVolume(fileName, maxMemory));
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    return SelectArray(image, array, fileName);
  }
  const vtkSmartPointer<vtkPointSet> mesh = FindMesh(data);
  if (!mesh)
  {
    throw std::runtime_error(fileName + " holds no image, no unstructured and no structured grid");
  }
  return SelectArray(mesh, array, fileName);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPointSet> ReadMesh(
  const std::string& fileName, const std::string& array, double maxMemory)
{
  const vtkSmartPointer<vtkDataSet> data = ReadData(fileName, array, maxMemory);
  auto* mesh = vtkPointSet::SafeDownCast(data);
  if (!mesh)
  {
    throw std::runtime_error(fileName + " holds no unstructured and no structured grid");
  }
  return mesh;
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
