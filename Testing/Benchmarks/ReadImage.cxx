// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadImage.h"

#include "IsosurfaceCompare/ReadVolume.h"

#include <vtkDICOMImageReader.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtksys/SystemTools.hxx>

#include <stdexcept>

namespace Benchmark
{
namespace
{

vtkSmartPointer<vtkImageData> ReadSlices(const std::string& directory)
{
  vtkNew<vtkDICOMImageReader> reader;
  reader->SetDirectoryName(directory.c_str());
  reader->Update();
  return reader->GetOutput();
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadImage(const std::string& fileName)
{
  const bool isDirectory = vtksys::SystemTools::FileIsDirectory(fileName);
  vtkSmartPointer<vtkImageData> image =
    isDirectory ? ReadSlices(fileName) : Compare::ReadVolume(fileName);
  if (!image->GetPointData()->GetScalars() || image->GetDataDimension() != 3)
  {
    throw std::runtime_error(fileName + " is not a volume with point scalars");
  }
  return image;
}

}
