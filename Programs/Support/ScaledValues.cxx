// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScaledValues.h"

#include <vtkImageData.h>
#include <vtkImageShiftScale.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>

#include <cmath>

namespace Programs
{

//------------------------------------------------------------------------------
bool HasScale(vtkNIFTIImageReader* reader)
{
  const double slope = reader->GetRescaleSlope();
  const double intercept = reader->GetRescaleIntercept();
  const int type = reader->GetNIFTIHeader()->GetDataType();
  const bool isColor =
    type == vtkNIFTIImageHeader::TypeRGB24 || type == vtkNIFTIImageHeader::TypeRGBA32;
  // A slope of 0 means none.
  return !isColor && std::isfinite(slope) && std::isfinite(intercept) && slope != 0.0 &&
    (slope != 1.0 || intercept != 0.0);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ScaleValues(vtkNIFTIImageReader* reader, vtkImageData* image)
{
  if (!HasScale(reader))
  {
    return image;
  }
  vtkNew<vtkImageShiftScale> scale;
  scale->SetInputData(image);
  scale->SetShift(reader->GetRescaleIntercept() / reader->GetRescaleSlope());
  scale->SetScale(reader->GetRescaleSlope());
  const bool isShort = image->GetScalarSize() <= 2 || image->GetScalarType() == VTK_FLOAT;
  scale->SetOutputScalarType(isShort ? VTK_FLOAT : VTK_DOUBLE);
  scale->Update();
  return scale->GetOutput();
}

}
