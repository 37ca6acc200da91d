// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadVolume.h"

#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>
#include <vtksys/SystemTools.hxx>

#include <cstdio>
#include <stdexcept>

namespace Compare
{
namespace
{

using vtksys::SystemTools;

/// Many readers report an error and read on; an incomplete volume is not accepted.
void CountError(vtkObject*, unsigned long, void* count, void* text)
{
  ++*static_cast<int*>(count);
  std::fprintf(stderr, "%s", static_cast<const char*>(text));
}

template <typename ReaderT>
vtkSmartPointer<vtkImageData> Read(ReaderT* reader, const std::string& fileName)
{
  int errors = 0;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(CountError);
  observer->SetClientData(&errors);
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  // It would only repeat that the reader failed.
  vtkNew<vtkCallbackCommand> silence;
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silence);
  reader->SetFileName(fileName.c_str());
  reader->Update();
  if (errors > 0 || reader->GetOutput()->GetNumberOfPoints() == 0)
  {
    throw std::runtime_error(
      fileName + " cannot be read (" + reader->GetClassName() + " was tried)");
  }
  return reader->GetOutput();
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& fileName)
{
  if (!SystemTools::FileExists(fileName, true))
  {
    throw std::runtime_error("there is no file " + fileName);
  }
  const std::string name = SystemTools::LowerCase(fileName);
  if (SystemTools::StringEndsWith(name, ".vti"))
  {
    return Read(vtkSmartPointer<vtkXMLImageDataReader>::New().Get(), fileName);
  }
  // The factory does not have this reader.
  if (SystemTools::StringEndsWith(name, ".nii") || SystemTools::StringEndsWith(name, ".nii.gz"))
  {
    return Read(vtkSmartPointer<vtkNIFTIImageReader>::New().Get(), fileName);
  }
  const auto reader =
    vtk::TakeSmartPointer(vtkImageReader2Factory::CreateImageReader2(fileName.c_str()));
  if (!reader)
  {
    throw std::runtime_error("VTK has no image reader for " + fileName);
  }
  return Read(reader.Get(), fileName);
}

}
