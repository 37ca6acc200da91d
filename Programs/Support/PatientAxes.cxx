// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PatientAxes.h"

#include <vtkDICOMImageReader.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageReader.h>

#include <cmath>

namespace Programs
{
namespace
{

/// Whether the columns are axes: of length one, and perpendicular.
bool AreAxes(const double matrix[9])
{
  constexpr double tolerance = 1e-3;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      double product = 0.0;
      for (int row = 0; row < 3; ++row)
      {
        product += matrix[3 * row + i] * matrix[3 * row + j];
      }
      if (!(std::abs(product - (i == j ? 1.0 : 0.0)) < tolerance))
      {
        return false;
      }
    }
  }
  return true;
}

/// A direction of DICOM, which has x to the left and y to the back.
void TakeDirection(const float* direction, double result[3])
{
  result[0] = -static_cast<double>(direction[0]);
  result[1] = -static_cast<double>(direction[1]);
  result[2] = static_cast<double>(direction[2]);
}

}

//------------------------------------------------------------------------------
void PlaceInPatient(vtkDICOMImageReader* reader, vtkImageData* image)
{
  const float* orientation = reader->GetImageOrientationPatient();
  double along[3];
  double down[3];
  double normal[3];
  TakeDirection(orientation, along);
  TakeDirection(orientation + 3, down);
  vtkMath::Cross(along, down, normal);
  // VTK begins at the last row, and with the last slice along the normal.
  const double matrix[9] = { along[0], -down[0], -normal[0], along[1], -down[1], -normal[1],
    along[2], -down[2], -normal[2] };
  if (AreAxes(matrix))
  {
    image->SetDirectionMatrix(matrix);
  }
}

//------------------------------------------------------------------------------
void PlaceInPatient(vtkNIFTIImageReader* reader, vtkImageData* image)
{
  vtkMatrix4x4* place =
    reader->GetQFormMatrix() ? reader->GetQFormMatrix() : reader->GetSFormMatrix();
  if (!place)
  {
    return;
  }
  double matrix[9];
  for (int i = 0; i < 9; ++i)
  {
    matrix[i] = place->GetElement(i / 3, i % 3);
  }
  if (AreAxes(matrix))
  {
    image->SetDirectionMatrix(matrix);
    image->SetOrigin(place->GetElement(0, 3), place->GetElement(1, 3), place->GetElement(2, 3));
  }
}

}
