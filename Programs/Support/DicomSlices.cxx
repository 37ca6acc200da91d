// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "DicomSlices.h"

#include "InputFiles.h"

#include <vtkCallbackCommand.h>
#include <vtkDICOMImageReader.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkVersionMacros.h>
#include <vtksys/Directory.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>

namespace Programs
{
namespace
{

using Vector = std::array<double, 3>;

const char* const Convert = "convert them by dcm2niix, and read the .nii file that it writes";

//------------------------------------------------------------------------------
Vector ToVector(const float* values)
{
  return { values[0], values[1], values[2] };
}

Vector GetNormal(const DicomSlice& slice)
{
  Vector normal;
  vtkMath::Cross(slice.AlongRows.data(), slice.DownColumns.data(), normal.data());
  return normal;
}

double GetPlace(const DicomSlice& slice, const Vector& direction)
{
  return vtkMath::Dot(slice.Position, direction);
}

bool AreClose(const Vector& a, const Vector& b)
{
  constexpr double tolerance = 1e-3;
  return vtkMath::Distance2BetweenPoints(a.data(), b.data()) < tolerance * tolerance;
}

bool AreOfOneSeries(const DicomSlice& a, const DicomSlice& b)
{
  return a.Kind == b.Kind && AreClose(a.AlongRows, b.AlongRows) &&
    AreClose(a.DownColumns, b.DownColumns);
}

//------------------------------------------------------------------------------
/// Of a file that is not a slice, nothing.
std::optional<DicomSlice> ReadHeader(const std::string& folder, const std::string& name)
{
  const std::string path = folder + "/" + name;
  vtkNew<vtkDICOMImageReader> reader;
  vtkNew<vtkCallbackCommand> silence;
  reader->AddObserver(vtkCommand::ErrorEvent, silence);
  reader->AddObserver(vtkCommand::WarningEvent, silence);
  if (!IsFile(path) || !reader->CanReadFile(path.c_str()))
  {
    return std::nullopt;
  }
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  // Uncompressed, the least significant byte first.
  const std::string syntax = reader->GetTransferSyntaxUID();
  if (!syntax.empty() && syntax != "1.2.840.10008.1.2" && syntax != "1.2.840.10008.1.2.1")
  {
    throw std::runtime_error(path + " is compressed or big-endian (transfer syntax " + syntax +
      "), which VTK does not read; convert the slices by dcm2niix, and read the .nii file that it "
      "writes");
  }
  if (reader->GetWidth() == 0 || reader->GetHeight() == 0) // a directory, or a report
  {
    return std::nullopt;
  }
  const double bits = static_cast<double>(reader->GetWidth()) * reader->GetHeight() *
    reader->GetNumberOfComponents() * reader->GetBitsAllocated();
  constexpr double bitsPerByte = 8.0;
  if (bitsPerByte * static_cast<double>(vtksys::SystemTools::FileLength(path)) < bits)
  {
    // VTK leaves the other samples undefined.
    throw std::runtime_error(path + " is damaged: it ends before its last samples");
  }
  const float* directions = reader->GetImageOrientationPatient();
  const double* spacing = reader->GetPixelSpacing();
  // DICOM has the distance of rows first, which VTK knows since 9.6.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  const double inRow = spacing[0];
  const double ofRows = spacing[1];
#else
  const double inRow = spacing[1];
  const double ofRows = spacing[0];
#endif
  const double values = std::ldexp(1.0, reader->GetBitsAllocated());
  const double least = reader->GetPixelRepresentation() == 1 ? -0.5 * values : 0.0;
  return DicomSlice{ name,
    { reader->GetWidth(), reader->GetHeight(), reader->GetDataScalarType(),
      reader->GetNumberOfComponents() },
    ToVector(directions), ToVector(directions + 3), ToVector(reader->GetImagePositionPatient()),
    { inRow, ofRows }, { least, least + values - 1.0 }, reader->GetRescaleSlope(),
    reader->GetRescaleOffset() };
}

//------------------------------------------------------------------------------
std::vector<DicomSlice> ReadHeaders(const std::string& folder)
{
  vtksys::Directory directory;
  directory.Load(folder);
  std::vector<DicomSlice> slices;
  for (unsigned long i = 0; i < directory.GetNumberOfFiles(); ++i)
  {
    if (std::optional<DicomSlice> slice = ReadHeader(folder, directory.GetFile(i)))
    {
      slices.push_back(std::move(*slice));
    }
  }
  std::sort(slices.begin(), slices.end(),
    [](const DicomSlice& a, const DicomSlice& b) { return a.Name < b.Name; });
  return slices;
}

//------------------------------------------------------------------------------
/// From each slice to the next, along the normal.
std::vector<double> GetDistances(const std::vector<DicomSlice>& slices)
{
  const Vector normal = GetNormal(slices.front());
  std::vector<double> distances;
  for (std::size_t i = 1; i < slices.size(); ++i)
  {
    distances.push_back(GetPlace(slices[i - 1], normal) - GetPlace(slices[i], normal));
  }
  return distances;
}

/// Whether scaled samples are what they are in the file, and not what 16 bits have left of them.
bool FitShorts(const DicomSlice& slice, const short* first, const short* last)
{
  using Limits = std::numeric_limits<short>;
  const double ends[2] = { slice.Stored[0] * slice.Slope + slice.Intercept,
    slice.Stored[1] * slice.Slope + slice.Intercept };
  if (slice.Slope == 0.0 ||
    (std::min(ends[0], ends[1]) >= Limits::min() && std::max(ends[0], ends[1]) <= Limits::max()))
  {
    return true;
  }
  // Nobody sees that of slopes like 2.
  const double values = std::ldexp(1.0, std::numeric_limits<unsigned short>::digits);
  const bool isSeen = std::abs(slice.Slope) == 1.0 || std::fmod(values, slice.Slope) != 0.0;
  return isSeen &&
    std::all_of(first, last,
      [&slice](short value)
      {
        const double stored = (value - slice.Intercept) / slice.Slope;
        return std::trunc(stored) == stored && stored >= slice.Stored[0] &&
          stored <= slice.Stored[1];
      });
}

bool FitBytes(const DicomSlice& slice)
{
  return slice.Slope == 1.0 && slice.Intercept == 0.0 && slice.Stored[0] == 0.0;
}

/// Corrects scaled samples that were taken for unsigned ones.
void RestoreNegative(const DicomSlice& slice, float* first, float* last)
{
  if (slice.Stored[0] >= 0.0 || slice.Slope == 0.0)
  {
    return;
  }
  const double values = slice.Stored[1] - slice.Stored[0] + 1.0;
  for (float* value = first; value != last; ++value)
  {
    const double stored = std::rint((*value - slice.Intercept) / slice.Slope);
    if (stored > slice.Stored[1])
    {
      *value = static_cast<float>((stored - values) * slice.Slope + slice.Intercept);
    }
  }
}

/// How far the last slice is from the first across the normal.
double GetShift(const std::vector<DicomSlice>& slices)
{
  const DicomSlice& first = slices.front();
  const DicomSlice& last = slices.back();
  return std::max(std::abs(GetPlace(last, first.AlongRows) - GetPlace(first, first.AlongRows)),
    std::abs(GetPlace(last, first.DownColumns) - GetPlace(first, first.DownColumns)));
}

}

//------------------------------------------------------------------------------
std::vector<DicomSlice> FindSlices(const std::string& folder)
{
  std::vector<DicomSlice> slices = ReadHeaders(folder);
  if (slices.empty())
  {
    throw std::runtime_error(
      folder + " has no DICOM slices; name the folder that the slices are in");
  }
  const DicomSlice first = slices.front();
  const auto other = std::find_if(slices.begin(), slices.end(),
    [&first](const DicomSlice& slice) { return !AreOfOneSeries(slice, first); });
  if (other != slices.end())
  {
    throw std::runtime_error(folder + " has slices of different sizes, directions or types, as " +
      first.Name + " and " + other->Name + "; put each series into a folder of its own, or " +
      Convert);
  }
  if (slices.size() == 1)
  {
    throw std::runtime_error(
      folder + " has one slice, " + first.Name + "; if there are several in it, " + Convert);
  }
  const Vector normal = GetNormal(first);
  std::sort(slices.begin(), slices.end(),
    [&normal](const DicomSlice& a, const DicomSlice& b)
    { return GetPlace(a, normal) > GetPlace(b, normal); });
  const std::vector<double> distances = GetDistances(slices);
  const auto [least, largest] = std::minmax_element(distances.begin(), distances.end());
  constexpr double negligible = 1e-3;
  if (!(*largest > 0.0) || *least < negligible * *largest)
  {
    throw std::runtime_error(folder +
      " has several slices at one place, or does not tell the places; put each series into a "
      "folder of its own, or " +
      Convert);
  }
  return slices;
}

//------------------------------------------------------------------------------
void CorrectValues(
  const std::string& folder, const std::vector<DicomSlice>& slices, vtkImageData* image)
{
  const int type = image->GetScalarType();
  const std::ptrdiff_t count = image->GetPointData()->GetScalars()->GetNumberOfValues() /
    static_cast<std::ptrdiff_t>(slices.size());
  for (std::size_t i = 0; i < slices.size(); ++i)
  {
    const DicomSlice& slice = slices[i];
    void* first = image->GetPointData()->GetScalars()->GetVoidPointer(
      static_cast<vtkIdType>(i) * static_cast<vtkIdType>(count));
    auto* shorts = static_cast<short*>(first);
    if (type == VTK_FLOAT)
    {
      RestoreNegative(slice, static_cast<float*>(first), static_cast<float*>(first) + count);
    }
    else if ((type == VTK_SHORT && !FitShorts(slice, shorts, shorts + count)) ||
      (type == VTK_UNSIGNED_CHAR && !FitBytes(slice)))
    {
      constexpr int bitsPerByte = 8;
      throw std::runtime_error(folder + "/" + slice.Name + " may have values that do not fit the " +
        std::to_string(bitsPerByte * image->GetScalarSize()) + " bits that VTK scales them to; " +
        Convert);
    }
  }
}

//------------------------------------------------------------------------------
double GetDistanceOfSlices(const std::vector<DicomSlice>& slices)
{
  std::vector<double> distances = GetDistances(slices);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

//------------------------------------------------------------------------------
void CheckDistances(const std::string& folder, const std::vector<DicomSlice>& slices)
{
  const double distance = GetDistanceOfSlices(slices);
  const std::vector<double> distances = GetDistances(slices);
  constexpr double tolerance = 0.05;
  const auto other = std::find_if(distances.begin(), distances.end(),
    [distance](double each) { return std::abs(each - distance) > tolerance * distance; });
  if (other != distances.end())
  {
    const auto index = static_cast<std::size_t>(other - distances.begin());
    std::cerr << "warning: " << folder << ": slices are missing, or are not evenly spaced: from "
              << slices[index].Name << " to " << slices[index + 1].Name << " it is " << *other
              << " mm, elsewhere " << distance << "; they are drawn as if it were " << distance
              << " everywhere\n";
  }
  const double shift = GetShift(slices);
  if (shift > std::max(slices.front().Spacing[0], slices.front().Spacing[1]))
  {
    std::cerr << "warning: " << folder << ": the slices are shifted against each other by up to "
              << shift << " mm, as those of a tilted gantry; this is not corrected: " << Convert
              << '\n';
  }
}

}
