// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PatientAxes.h"

#include "MetaImageHeader.h"
#include "NrrdHeader.h"

#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkMath.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageReader.h>

#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>

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

//------------------------------------------------------------------------------
/// Takes axes that have these lengths. Returns whether they are perpendicular; else all is left.
bool SetPlace(vtkImageData* image, const std::array<std::array<double, 3>, 3>& axes,
  const std::array<double, 3>& lengths, const std::array<double, 3>& spacing,
  const std::array<double, 3>& origin)
{
  double matrix[9];
  for (int column = 0; column < 3; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      matrix[3 * row + column] = axes[column][row] / lengths[column];
    }
  }
  if (!AreAxes(matrix))
  {
    return false;
  }
  image->SetDirectionMatrix(matrix);
  image->SetSpacing(spacing.data());
  image->SetOrigin(origin.data());
  return true;
}

const char* const LeftOut = "they are left out, and the samples have the axes of the file";

void WarnOfAxes(const std::string& fileName, const std::string& source, const std::string& remedy)
{
  std::cerr << "warning: " << fileName << ": the axes that its " << source
            << " gives are not perpendicular; " << remedy << '\n';
}

//------------------------------------------------------------------------------
/// Returns whether it is taken.
bool SetForm(vtkImageData* image, vtkMatrix4x4* form)
{
  std::array<std::array<double, 3>, 3> axes;
  std::array<double, 3> lengths;
  std::array<double, 3> spacing;
  image->GetSpacing(spacing.data());
  constexpr double rounding = 1e-6;
  for (int i = 0; i < 3; ++i)
  {
    axes[i] = { form->GetElement(0, i), form->GetElement(1, i), form->GetElement(2, i) };
    lengths[i] = vtkMath::Norm(axes[i].data());
    // An sform may have spacings of its own, beside those that the reader has.
    spacing[i] *= std::abs(lengths[i] - 1.0) < rounding ? 1.0 : lengths[i];
  }
  return SetPlace(image, axes, lengths, spacing,
    { form->GetElement(0, 3), form->GetElement(1, 3), form->GetElement(2, 3) });
}

//------------------------------------------------------------------------------
/// That of the first sample of the image, which may be in the last row of the file.
std::optional<ImageFiles::ImagePlace> FindPlaceOfNrrd(const std::string& name, vtkImageData* image)
{
  std::optional<ImageFiles::NrrdPlace> place = ImageFiles::FindPlaceOfNrrd(name);
  // vtkMappedImageReader leaves rows where they are, and turns the axis.
  if (place && place->AreRowsReversed && image->GetDirectionMatrix()->GetElement(1, 1) > 0.0)
  {
    for (int i = 0; i < 3; ++i)
    {
      place->Origin[i] += (image->GetDimensions()[1] - 1) * place->Steps[1][i];
      place->Steps[1][i] = -place->Steps[1][i];
    }
  }
  return place;
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
  // As of registration.
  vtkMatrix4x4* const sform = reader->GetSFormMatrix();
  if (sform && SetForm(image, sform))
  {
    return;
  }
  vtkMatrix4x4* const qform = reader->GetQFormMatrix();
  const bool isTaken = qform && SetForm(image, qform);
  if (sform || (qform && !isTaken))
  {
    WarnOfAxes(reader->GetFileName(), sform ? "sform" : "qform",
      isTaken ? "those of its qform are taken" : LeftOut);
  }
}

//------------------------------------------------------------------------------
void PlaceInPatient(vtkImageReader2* reader, vtkImageData* image)
{
  const std::string name = reader->GetFileName();
  std::optional<ImageFiles::ImagePlace> place;
  if (ImageFiles::IsMetaImage(name))
  {
    place = ImageFiles::FindPlaceOfMetaImage(name);
  }
  else if (ImageFiles::IsNrrd(name))
  {
    place = FindPlaceOfNrrd(name, image);
  }
  if (!place)
  {
    return;
  }
  std::array<double, 3> spacing;
  for (int i = 0; i < 3; ++i)
  {
    spacing[i] = vtkMath::Norm(place->Steps[i].data());
  }
  if (!SetPlace(image, place->Steps, spacing, spacing, place->Origin))
  {
    WarnOfAxes(name, "header", LeftOut);
  }
}

}
