// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadImage.h"

#include "Support/ReadVolume.h"

#include <vtkImageData.h>
#include <vtkPointData.h>

#include <stdexcept>

namespace Benchmark
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadImage(const std::string& fileName, double maxMemory)
{
  vtkSmartPointer<vtkImageData> image = Programs::ReadVolume(fileName, maxMemory);
  if (!image->GetPointData()->GetScalars() || image->GetDataDimension() != 3)
  {
    throw std::runtime_error(fileName + " is not a volume with point scalars");
  }
  return image;
}

}
