// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadDataObject.h"

#include "HeaderText.h"
#include "InputFiles.h"
#include "ReadVolume.h"
#include "ReaderErrors.h"
#include "XmlFiles.h"

#include <vtkDataReader.h>
#include <vtkExodusIIReader.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridReader.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridReader.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLPRectilinearGridReader.h>
#include <vtkXMLPStructuredGridReader.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUniformGridAMRReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtksys/SystemTools.hxx>

#include <map>
#include <new>
#include <stdexcept>

namespace Programs
{
namespace
{

using vtksys::SystemTools;

std::string GetExtension(const std::string& fileName)
{
  return SystemTools::LowerCase(SystemTools::GetFilenameLastExtension(fileName));
}

//------------------------------------------------------------------------------
template <typename ReaderT>
vtkSmartPointer<vtkDataObject> Read(ReaderT* reader, const std::string& fileName)
{
  const ReaderErrors errors(reader);
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
  reader->ReadAllVectorsOn();
  reader->ReadAllFieldsOn();
  return Read(reader.Get(), fileName);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> ReadLegacyOfAnyKind(const std::string& fileName)
{
  vtkNew<vtkDataReader> kind;
  kind->SetFileName(fileName.c_str());
  if (kind->IsFileUnstructuredGrid())
  {
    return ReadLegacy<vtkUnstructuredGridReader>(fileName);
  }
  if (kind->IsFileStructuredGrid())
  {
    return ReadLegacy<vtkStructuredGridReader>(fileName);
  }
  if (kind->IsFileRectilinearGrid())
  {
    return ReadLegacy<vtkRectilinearGridReader>(fileName);
  }
  if (kind->IsFileStructuredPoints())
  {
    return ReadLegacy<vtkStructuredPointsReader>(fileName);
  }
  throw std::runtime_error(fileName + " holds no image and no grid");
}

//------------------------------------------------------------------------------
template <typename ReaderT>
vtkSmartPointer<vtkDataObject> ReadXml(const std::string& fileName)
{
  CheckXmlFile(fileName);
  return Read(vtkNew<ReaderT>().Get(), fileName);
}

//------------------------------------------------------------------------------
/// Throws if a level has no spacing, as in files of version 1.0: VTK's reader crashes.
void CheckLevels(const std::string& fileName)
{
  constexpr std::size_t most = 1 << 22;
  const std::string text = ImageFiles::ReadBeginning(fileName, most);
  if (text.find("\"vtkNonOverlappingAMR\"") != std::string::npos)
  {
    return;
  }
  const std::string level = "<Block ";
  for (std::size_t i = text.find(level); i != std::string::npos; i = text.find(level, i + 1))
  {
    if (text.substr(i, text.find('>', i) - i).find(" spacing=") == std::string::npos)
    {
      const char* const error = " cannot be read: it has levels without a spacing, as files of "
                                "version 1.0 have; convert it by VTK's "
                                "vtkXMLHierarchicalBoxDataFileConverter";
      throw std::runtime_error(fileName + error);
    }
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> ReadAmr(const std::string& fileName)
{
  CheckLevels(fileName);
  CheckXmlFile(fileName);
  vtkNew<vtkXMLUniformGridAMRReader> reader;
  reader->SetMaximumLevelsToReadByDefault(0); // all
  return Read(reader.Get(), fileName);
}

//------------------------------------------------------------------------------
using ReadFunction = vtkSmartPointer<vtkDataObject> (*)(const std::string&);

/// Readers for the very kind of file: those for several kinds do not pass errors on.
const std::map<std::string, ReadFunction> Readers = {
  { ".e", ReadExodus },
  { ".ex2", ReadExodus },
  { ".exo", ReadExodus },
  { ".g", ReadExodus },
  { ".pvti", ReadXml<vtkXMLPImageDataReader> },
  { ".pvtr", ReadXml<vtkXMLPRectilinearGridReader> },
  { ".pvts", ReadXml<vtkXMLPStructuredGridReader> },
  { ".pvtu", ReadXml<vtkXMLPUnstructuredGridReader> },
  { ".vth", ReadAmr },
  { ".vthb", ReadAmr },
  { ".vtk", ReadLegacyOfAnyKind },
  { ".vtm", ReadXml<vtkXMLMultiBlockDataReader> },
  { ".vtr", ReadXml<vtkXMLRectilinearGridReader> },
  { ".vts", ReadXml<vtkXMLStructuredGridReader> },
  { ".vtu", ReadXml<vtkXMLUnstructuredGridReader> },
};

}

//------------------------------------------------------------------------------
bool IsGrid(const std::string& fileName)
{
  return Readers.count(GetExtension(fileName)) > 0;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> ReadDataObject(
  const std::string& fileName, const std::string& array, double maxMemory)
{
  if (SystemTools::FileIsDirectory(fileName) || !IsGrid(fileName))
  {
    return ReadOrMapVolume(fileName, array, maxMemory, Axes::OfPatient);
  }
  CheckIsFile(fileName);
  constexpr double bytesPerMebibyte = 1024.0 * 1024.0;
  if (static_cast<double>(SystemTools::FileLength(fileName)) > maxMemory * bytesPerMebibyte)
  {
    throw std::runtime_error(fileName + " has more bytes than --max-memory allows");
  }
  return Readers.at(GetExtension(fileName))(fileName);
}

}
