// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PatientAxes.h"

#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageReader.h>

#include <array>
#include <cmath>
#include <iostream>

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

/// A point or a direction of DICOM, which has x to the left and y to the back.
std::array<double, 3> FromDicom(const std::array<double, 3>& v)
{
  return { -v[0], -v[1], v[2] };
}

}

//------------------------------------------------------------------------------
void PlaceInPatient(const std::vector<DicomSlice>& slices, vtkImageData* image)
{
  // VTK begins with the last slice along the normal, and at its last row.
  const DicomSlice& first = slices.front();
  const std::array<double, 3> along = FromDicom(first.AlongRows);
  const std::array<double, 3> down = FromDicom(first.DownColumns);
  std::array<double, 3> normal;
  vtkMath::Cross(along.data(), down.data(), normal.data());
  const double matrix[9] = { along[0], -down[0], -normal[0], along[1], -down[1], -normal[1],
    along[2], -down[2], -normal[2] };
  if (AreAxes(matrix))
  {
    image->SetDirectionMatrix(matrix);
  }
  const std::array<double, 3> position = FromDicom(first.Position);
  const double height = (image->GetDimensions()[1] - 1) * first.Spacing[1];
  image->SetOrigin(
    position[0] + height * down[0], position[1] + height * down[1], position[2] + height * down[2]);
}

//------------------------------------------------------------------------------
void PlaceInPatient(vtkNIFTIImageReader* reader, vtkImageData* image)
{
  const bool isRigid = reader->GetQFormMatrix() != nullptr;
  vtkMatrix4x4* place = isRigid ? reader->GetQFormMatrix() : reader->GetSFormMatrix();
  if (!place)
  {
    return;
  }
  double matrix[9];
  std::array<double, 3> spacing;
  image->GetSpacing(spacing.data());
  for (int column = 0; column < 3; ++column)
  {
    const std::array<double, 3> axis = { place->GetElement(0, column), place->GetElement(1, column),
      place->GetElement(2, column) };
    // An sform has spacings of its own.
    const double scale = isRigid ? 1.0 : vtkMath::Norm(axis.data());
    for (int row = 0; row < 3; ++row)
    {
      matrix[3 * row + column] = axis[row] / scale;
    }
    spacing[column] *= scale;
  }
  if (!AreAxes(matrix))
  {
    std::cerr << "warning: " << reader->GetFileName()
              << ": the axes that its sform gives are not perpendicular; they are left out, and "
                 "the samples have the axes of the file\n";
    return;
  }
  image->SetDirectionMatrix(matrix);
  image->SetSpacing(spacing.data());
  image->SetOrigin(place->GetElement(0, 3), place->GetElement(1, 3), place->GetElement(2, 3));
}

}
