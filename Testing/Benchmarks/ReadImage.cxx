// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadImage.h"

#include <vtkDICOMImageReader.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkNIFTIImageReader.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>
#include <vtksys/SystemTools.hxx>

#include <stdexcept>

namespace Benchmark
{
namespace
{

using vtksys::SystemTools;

vtkSmartPointer<vtkAlgorithm> NewReader(const std::string& fileName)
{
  if (SystemTools::FileIsDirectory(fileName))
  {
    auto reader = vtkSmartPointer<vtkDICOMImageReader>::New();
    reader->SetDirectoryName(fileName.c_str());
    return reader;
  }
  const std::string name = SystemTools::LowerCase(fileName);
  if (SystemTools::StringEndsWith(name, ".vti"))
  {
    auto reader = vtkSmartPointer<vtkXMLImageDataReader>::New();
    reader->SetFileName(fileName.c_str());
    return reader;
  }
  vtkSmartPointer<vtkImageReader2> reader;
  if (SystemTools::StringEndsWith(name, ".nii") || SystemTools::StringEndsWith(name, ".nii.gz"))
  {
    reader = vtkSmartPointer<vtkNIFTIImageReader>::New();
  }
  else
  {
    reader.TakeReference(vtkImageReader2Factory::CreateImageReader2(fileName.c_str()));
  }
  if (reader)
  {
    reader->SetFileName(fileName.c_str());
  }
  return reader;
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadImage(const std::string& fileName)
{
  if (!SystemTools::FileExists(fileName))
  {
    throw std::runtime_error("there is no file or folder " + fileName);
  }
  const vtkSmartPointer<vtkAlgorithm> reader = NewReader(fileName);
  if (!reader)
  {
    throw std::runtime_error("VTK has no image reader for " + fileName);
  }
  reader->Update();
  vtkSmartPointer<vtkImageData> image = vtkImageData::SafeDownCast(reader->GetOutputDataObject(0));
  if (!image || !image->GetPointData()->GetScalars() || image->GetDataDimension() != 3)
  {
    throw std::runtime_error(fileName + " is not a volume with point scalars");
  }
  return image;
}

}
