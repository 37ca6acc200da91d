// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadMesh.h"

#include "Support/ReaderErrors.h"

#include <vtkAppendFilter.h>
#include <vtkCellData.h>
#include <vtkCellDataToPointData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataReader.h>
#include <vtkExodusIIReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridReader.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <vector>

namespace Compare
{
namespace
{

using vtksys::SystemTools;

std::string GetExtension(const std::string& fileName)
{
  return SystemTools::LowerCase(SystemTools::GetFilenameLastExtension(fileName));
}

bool IsOneOf(const std::string& extension, const std::vector<std::string>& extensions)
{
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

bool IsExodus(const std::string& fileName)
{
  return IsOneOf(GetExtension(fileName), { ".ex2", ".exo", ".e", ".g" });
}

//------------------------------------------------------------------------------
template <typename ReaderT>
vtkSmartPointer<vtkDataObject> Read(ReaderT* reader, const std::string& fileName)
{
  const Programs::ReaderErrors errors(reader);
  const std::string tried = std::string(reader->GetClassName()) + " was tried";
  reader->SetFileName(fileName.c_str());
  try
  {
    reader->Update();
  }
  catch (const std::bad_alloc&)
  {
    throw std::runtime_error(
      fileName + " cannot be read: there is not enough memory (" + tried + ")");
  }
  if (errors.GetCount() > 0 || !reader->GetOutputDataObject(0))
  {
    throw std::runtime_error(fileName + " cannot be read (" + tried + ")");
  }
  return reader->GetOutputDataObject(0);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> ReadExodus(const std::string& fileName)
{
  vtkNew<vtkExodusIIReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  for (const int type : { vtkExodusIIReader::NODAL, vtkExodusIIReader::ELEM_BLOCK })
  {
    reader->SetAllArrayStatus(type, 1);
  }
  return Read(reader.Get(), fileName);
}

//------------------------------------------------------------------------------
template <typename ReaderT>
vtkSmartPointer<vtkDataObject> ReadLegacy(const std::string& fileName)
{
  vtkNew<ReaderT> reader;
  reader->ReadAllScalarsOn();
  reader->ReadAllFieldsOn();
  return Read(reader.Get(), fileName);
}

//------------------------------------------------------------------------------
/// By the reader for the very kind of file: those for several kinds do not pass errors on. Null if
/// the kind is none of a mesh.
vtkSmartPointer<vtkDataObject> ReadFile(const std::string& fileName)
{
  const std::string extension = GetExtension(fileName);
  if (IsExodus(fileName))
  {
    return ReadExodus(fileName);
  }
  if (extension == ".vtu")
  {
    return Read(vtkNew<vtkXMLUnstructuredGridReader>().Get(), fileName);
  }
  if (extension == ".vts")
  {
    return Read(vtkNew<vtkXMLStructuredGridReader>().Get(), fileName);
  }
  if (extension == ".vtm")
  {
    return Read(vtkNew<vtkXMLMultiBlockDataReader>().Get(), fileName);
  }
  vtkNew<vtkDataReader> kind;
  kind->SetFileName(fileName.c_str());
  return kind->IsFileUnstructuredGrid() ? ReadLegacy<vtkUnstructuredGridReader>(fileName)
    : kind->IsFileStructuredGrid()      ? ReadLegacy<vtkStructuredGridReader>(fileName)
                                        : nullptr;
}

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
  vtkDataArray* scalars = points->GetScalars();
  for (int i = 0; !scalars && i < points->GetNumberOfArrays(); ++i)
  {
    scalars = points->GetArray(i);
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
bool IsMesh(const std::string& fileName)
{
  return IsExodus(fileName) || IsOneOf(GetExtension(fileName), { ".vtk", ".vtu", ".vts", ".vtm" });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPointSet> ReadMesh(
  const std::string& fileName, const std::string& array, double maxMemory)
{
  if (!SystemTools::FileExists(fileName, true))
  {
    throw std::runtime_error("there is no file " + fileName);
  }
  constexpr double bytesPerMebibyte = 1024.0 * 1024.0;
  if (static_cast<double>(SystemTools::FileLength(fileName)) > maxMemory * bytesPerMebibyte)
  {
    throw std::runtime_error(fileName + " has more bytes than --max-memory allows");
  }
  const vtkSmartPointer<vtkPointSet> mesh = FindMesh(ReadFile(fileName));
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
