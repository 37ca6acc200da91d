// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadVolume.h"

#include "MetaImageHeader.h"
#include "NiftiHeader.h"
#include "ReaderErrors.h"

#include <vtkDICOMImageReader.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataReader.h>
#include <vtksys/SystemInformation.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <sstream>
#include <stdexcept>

namespace Compare
{
namespace
{

using vtksys::SystemTools;

constexpr double BytesPerMebibyte = 1024.0 * 1024.0;

[[noreturn]] void Throw(const std::string& name, const std::string& problem)
{
  throw std::runtime_error(name + " cannot be read: " + problem);
}

//------------------------------------------------------------------------------
std::string ToMebibytes(double bytes)
{
  std::ostringstream text;
  text.precision(3);
  text << bytes / BytesPerMebibyte << " MiB";
  return text.str();
}

//------------------------------------------------------------------------------
/// Throws if what the header promises is more than the file has or than is to be in memory.
void CheckSize(vtkInformation* promise, const std::string& name, double capacity, double maxMemory)
{
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  promise->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  std::ostringstream size;
  double bytes = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double samples = static_cast<double>(extent[2 * axis + 1]) - extent[2 * axis] + 1.0;
    bytes *= std::max(samples, 0.0);
    size << (axis > 0 ? " x " : "its header asks for ") << samples;
  }
  vtkInformation* scalars = vtkDataObject::GetActiveFieldInformation(
    promise, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  if (scalars && scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE()))
  {
    bytes *= vtkDataArray::GetDataTypeSize(scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE()));
    bytes *= std::max(scalars->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS()), 1);
  }
  size << " samples, " << ToMebibytes(bytes);
  if (bytes > capacity)
  {
    Throw(name, size.str() + "; its file has no more than " + ToMebibytes(capacity));
  }
  if (bytes > maxMemory * BytesPerMebibyte)
  {
    Throw(name,
      size.str() + ", more than " + ToMebibytes(maxMemory * BytesPerMebibyte) +
        "; --max-memory sets this limit");
  }
}

//------------------------------------------------------------------------------
void CheckGeometry(vtkImageData* image, const std::string& name)
{
  const auto areFinite = [](const double* values, int count) {
    return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
  };
  const double* spacing = image->GetSpacing();
  if (!areFinite(spacing, 3) || std::find(spacing, spacing + 3, 0.0) != spacing + 3)
  {
    std::ostringstream problem;
    problem << "its spacing is " << spacing[0] << " " << spacing[1] << " " << spacing[2];
    Throw(name, problem.str());
  }
  if (!areFinite(image->GetOrigin(), 3) || !areFinite(image->GetBounds(), 6) ||
    !areFinite(image->GetDirectionMatrix()->GetData(), 9))
  {
    Throw(name, "its place in space is not finite");
  }
}

//------------------------------------------------------------------------------
void CheckHeader(vtkAlgorithm*, const std::string&) {}

/// VTK's reader writes beyond its memory if a dimension is not positive.
void CheckHeader(vtkNIFTIImageReader* reader, const std::string& name)
{
  vtkNIFTIImageHeader* header = reader->GetNIFTIHeader();
  for (int i = 1; i <= header->GetDim(0); ++i)
  {
    if (header->GetDim(i) < 1)
    {
      Throw(name, "its header has a dimension of " + std::to_string(header->GetDim(i)));
    }
  }
}

//------------------------------------------------------------------------------
/// The name is that of the file or folder that the reader is set to.
template <typename ReaderT>
vtkSmartPointer<vtkImageData> Read(
  ReaderT* reader, const std::string& name, double capacity, double maxMemory)
{
  const ReaderErrors errors(reader);
  const std::string tried = std::string(reader->GetClassName()) + " was tried";
  try
  {
    reader->UpdateInformation();
    if (errors.GetCount() == 0)
    {
      CheckHeader(reader, name);
      CheckSize(reader->GetOutputInformation(0), name, capacity, maxMemory);
      reader->Update();
    }
  }
  catch (const std::bad_alloc&)
  {
    Throw(name, "there is not enough memory (" + tried + ")");
  }
  if (errors.GetCount() > 0 || reader->GetOutput()->GetNumberOfPoints() == 0)
  {
    throw std::runtime_error(name + " cannot be read (" + tried + ")");
  }
  CheckGeometry(reader->GetOutput(), name);
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
template <typename ReaderT>
vtkSmartPointer<vtkImageData> ReadFile(
  ReaderT* reader, const std::string& name, double capacity, double maxMemory)
{
  reader->SetFileName(name.c_str());
  return Read(reader, name, capacity, maxMemory);
}

}

//------------------------------------------------------------------------------
const char* const MaxMemoryHelp =
  "The most memory that the volume may take, in MiB. Default: the memory of this machine.";

//------------------------------------------------------------------------------
double GetDefaultMaxMemory()
{
  vtksys::SystemInformation system;
  constexpr double kibibytesPerMebibyte = 1024.0;
  return static_cast<double>(system.GetProcMemoryAvailable()) / kibibytesPerMebibyte;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& fileName, double maxMemory)
{
  if (!SystemTools::FileExists(fileName, true))
  {
    throw std::runtime_error("there is no file " + fileName);
  }
  const double unknown = std::numeric_limits<double>::infinity();
  if (SystemTools::StringEndsWith(SystemTools::LowerCase(fileName), ".vti"))
  {
    return ReadFile(vtkNew<vtkXMLImageDataReader>().Get(), fileName, unknown, maxMemory);
  }
  // The factory does not have this reader.
  if (IsNifti(fileName))
  {
    return ReadFile(
      vtkNew<vtkNIFTIImageReader>().Get(), fileName, GetCapacityOfNifti(fileName), maxMemory);
  }
  // Before the factory, whose readers look into the file.
  const double capacity = IsMetaImage(fileName) ? GetCapacityOfMetaImage(fileName) : unknown;
  const auto reader =
    vtk::TakeSmartPointer(vtkImageReader2Factory::CreateImageReader2(fileName.c_str()));
  if (!reader)
  {
    throw std::runtime_error("VTK has no image reader for " + fileName);
  }
  return ReadFile(reader.Get(), fileName, capacity, maxMemory);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadSlices(const std::string& folder, double maxMemory)
{
  vtkNew<vtkDICOMImageReader> reader;
  reader->SetDirectoryName(folder.c_str());
  return Read(reader.Get(), folder, std::numeric_limits<double>::infinity(), maxMemory);
}

}
