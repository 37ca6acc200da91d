// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The files of a folder of DICOM slices. VTK's reader takes any for a volume, and trusts what the
// last one says: it writes beyond its memory if another is larger.

#ifndef DicomSlices_h
#define DicomSlices_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <array>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace Programs
{

/// What the header of a slice says, in the coordinates of DICOM: x to the left, y to the back.
struct DicomSlice
{
  std::string Name;
  /// Width, height, type, components: the same in all slices of a volume.
  std::array<int, 4> Kind;
  std::array<double, 3> AlongRows;
  std::array<double, 3> DownColumns;
  /// Of the first sample.
  std::array<double, 3> Position;
  /// Of samples in a row, and of rows.
  std::array<double, 2> Spacing;
  /// The least and the largest sample that the file may have, and what makes them values.
  std::array<double, 2> Stored;
  double Slope;
  double Intercept;
};

/// The slices in a folder in the order of VTK's reader, from the last one along the normal. Throws
/// std::runtime_error if they are not those of one series, or if VTK's reader does not read them.
std::vector<DicomSlice> FindSlices(const std::string& folder);

/// Throws std::runtime_error if VTK's reader, which scales samples to their own type, made others
/// of values that do not fit. Where it makes floating-point numbers of signed samples, it takes
/// them for unsigned ones: their values are corrected.
void CorrectValues(
  const std::string& folder, const std::vector<DicomSlice>& slices, vtkImageData* image);

/// The median distance of slices.
double GetDistanceOfSlices(const std::vector<DicomSlice>& slices);

/// Warns of slices that are missing, and of a gantry that was tilted.
void CheckDistances(const std::string& folder, const std::vector<DicomSlice>& slices);

}

#endif
