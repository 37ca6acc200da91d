// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReadVolume.h"

#include "DicomSlices.h"
#include "InputFiles.h"
#include "MetaImageHeader.h"
#include "NiftiHeader.h"
#include "NrrdHeader.h"
#include "PatientAxes.h"
#include "ReaderErrors.h"
#include "ScaledValues.h"
#include "XmlFiles.h"
#include "vtkMappedImageReader.h"

#include <vtkAlgorithm.h>
#include <vtkDICOMImageReader.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataReader.h>
#include <vtksys/SystemInformation.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace Programs
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
using Extent = std::array<int, 6>;

/// An extent of samples that a header promises.
struct Promise
{
  double Bytes = 1.0;
  std::string Text;

  Promise(vtkInformation* header, const Extent& extent)
  {
    std::ostringstream size;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double samples = static_cast<double>(extent[2 * axis + 1]) - extent[2 * axis] + 1.0;
      this->Bytes *= std::max(samples, 0.0);
      size << (axis > 0 ? " x " : "") << samples;
    }
    vtkInformation* scalars = vtkDataObject::GetActiveFieldInformation(
      header, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
    if (scalars && scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE()))
    {
      this->Bytes *= vtkDataArray::GetDataTypeSize(scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE()));
      this->Bytes *= std::max(scalars->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS()), 1);
    }
    size << " samples, " << ToMebibytes(this->Bytes);
    this->Text = size.str();
  }
};

/// Throws if what the header promises is more than the file has, or what is to be read more than is
/// to be in memory.
void CheckSize(const Promise& whole, const Promise& piece, const std::string& name, double capacity,
  double maxMemory)
{
  if (whole.Bytes > capacity)
  {
    Throw(name,
      "its header asks for " + whole.Text + "; its file has no more than " + ToMebibytes(capacity));
  }
  if (piece.Bytes > maxMemory * BytesPerMebibyte)
  {
    Throw(name,
      "its header asks for " + piece.Text + ", more than " +
        ToMebibytes(maxMemory * BytesPerMebibyte) + "; --max-memory sets this limit");
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

/// VTK's reader writes beyond its memory if a dimension is not positive. Of several volumes it
/// reads the first.
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
  if (header->GetDim(0) > 3 && header->GetDim(4) > 1)
  {
    std::cerr << "warning: " << name << " has " << header->GetDim(4)
              << " volumes; the first of them is taken\n";
  }
}

//------------------------------------------------------------------------------
/// What is read, and what may be.
struct Order
{
  double Capacity;
  double MaxMemory;
  ChooseExtent Choose;
  Axes TheAxes;
};

//------------------------------------------------------------------------------
/// VTK's reader of MetaImage writes beyond its memory where it is to read a part. Samples that are
/// not compressed are read by another; of others the whole is read.
vtkSmartPointer<vtkImageData> ReadPartOfMetaImage(vtkMetaImageReader* reader, const Extent& extent)
{
  const std::optional<ImageFiles::RawSamples> samples =
    ImageFiles::FindRawSamples(reader->GetFileName());
  if (!samples || samples->Offset < 0)
  {
    reader->Update();
    reader->GetOutput()->Crop(extent.data());
    return reader->GetOutput();
  }
  vtkNew<vtkImageReader2> raw;
  raw->SetFileName(samples->FileName.c_str());
  raw->SetHeaderSize(static_cast<unsigned long>(samples->Offset));
  raw->SetFileDimensionality(3);
  raw->FileLowerLeftOn();
  raw->SetDataByteOrder(
    samples->AreBigEndian ? VTK_FILE_BYTE_ORDER_BIG_ENDIAN : VTK_FILE_BYTE_ORDER_LITTLE_ENDIAN);
  raw->SetDataExtent(reader->GetDataExtent());
  raw->SetDataSpacing(reader->GetDataSpacing());
  raw->SetDataOrigin(reader->GetDataOrigin());
  raw->SetDataScalarType(reader->GetDataScalarType());
  raw->SetNumberOfScalarComponents(reader->GetNumberOfScalarComponents());
  const ReaderErrors errors(raw);
  raw->UpdateExtent(extent.data());
  return errors.GetCount() == 0 ? raw->GetOutput() : nullptr;
}

//------------------------------------------------------------------------------
template <typename ReaderT>
vtkSmartPointer<vtkImageData> ReadExtent(ReaderT* reader, const Extent& extent, const Extent& whole)
{
  if (extent == whole)
  {
    reader->Update();
    return reader->GetOutput();
  }
  if (auto* ofMetaImage = vtkMetaImageReader::SafeDownCast(reader))
  {
    return ReadPartOfMetaImage(ofMetaImage, extent);
  }
  // The reader of .vti hides it.
  static_cast<vtkAlgorithm*>(reader)->UpdateExtent(extent.data());
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
Extent ChooseWhole(const Extent& whole)
{
  return whole;
}

/// The name is that of the file or folder that the reader is set to.
template <typename ReaderT>
vtkSmartPointer<vtkImageData> Read(ReaderT* reader, const std::string& name, const Order& order)
{
  const ReaderErrors errors(reader);
  const std::string tried = std::string(reader->GetClassName()) + " was tried";
  try
  {
    reader->UpdateInformation();
    if (errors.GetCount() == 0)
    {
      CheckHeader(reader, name);
      vtkInformation* header = reader->GetOutputInformation(0);
      Extent whole = { 0, -1, 0, -1, 0, -1 };
      header->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole.data());
      const Extent extent = order.Choose(whole);
      CheckSize({ header, whole }, { header, extent }, name, order.Capacity, order.MaxMemory);
      vtkSmartPointer<vtkImageData> image = ReadExtent(reader, extent, whole);
      if (errors.GetCount() == 0 && image && image->GetNumberOfPoints() > 0)
      {
        if (order.TheAxes == Axes::OfPatient)
        {
          PlaceInPatient(reader, image);
        }
        CheckGeometry(image, name);
        return ScaleValues(reader, image);
      }
    }
  }
  catch (const std::bad_alloc&)
  {
    Throw(name, "there is not enough memory (" + tried + ")");
  }
  throw std::runtime_error(name + " cannot be read (" + tried + ")");
}

//------------------------------------------------------------------------------
template <typename ReaderT>
vtkSmartPointer<vtkImageData> ReadFile(ReaderT* reader, const std::string& name, const Order& order)
{
  if (ImageFiles::IsNrrd(name))
  {
    ImageFiles::CheckVolumeOfNrrd(name);
  }
  reader->SetFileName(name.c_str());
  return Read(reader, name, order);
}

//------------------------------------------------------------------------------
/// The least limit of memory, in bytes, of the control groups of Linux that this process is in, as
/// in a container.
double FindLimitOfGroups()
{
  namespace fs = std::filesystem;
  double limit = std::numeric_limits<double>::infinity();
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) // number:controllers:group
  {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && controllers != "memory") // of version 2 and of version 1
    {
      continue;
    }
    const fs::path top = fs::path("/sys/fs/cgroup") / controllers;
    // What a container sees of the groups may begin below its own name.
    fs::path group = fs::path(line.substr(second + 1)).relative_path();
    for (bool isTop = false; !isTop; group = group.parent_path())
    {
      isTop = group.empty();
      for (const char* name : { "memory.max", "memory.limit_in_bytes" })
      {
        std::ifstream file(top / group / name);
        double bytes = 0.0;
        limit = file >> bytes ? std::min(limit, bytes) : limit; // Without a limit it is a word.
      }
    }
  }
  return limit;
}

//------------------------------------------------------------------------------
/// Takes files alone for slices: the superclass would wait for a pipe in the folder.
class SliceReader : public vtkDICOMImageReader
{
public:
  static SliceReader* New();
  vtkTypeMacro(SliceReader, vtkDICOMImageReader);

  int CanReadFile(const char* fileName) override
  {
    return IsFile(fileName) ? this->Superclass::CanReadFile(fileName) : 0;
  }
};

vtkStandardNewMacro(SliceReader);

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadSlices(const std::string& folder, double maxMemory, Axes axes)
{
  const std::vector<DicomSlice> slices = FindSlices(folder);
  vtkNew<SliceReader> reader;
  reader->SetDirectoryName(folder.c_str());
  const vtkSmartPointer<vtkImageData> image = Read(reader.Get(), folder,
    { std::numeric_limits<double>::infinity(), maxMemory, ChooseWhole, Axes::OfSamples });
  if (image->GetDimensions()[2] != static_cast<int>(slices.size()))
  {
    Throw(folder,
      "it has " + std::to_string(slices.size()) + " slices, of which VTK's reader takes " +
        std::to_string(image->GetDimensions()[2]) +
        " for one series; put each series into a folder of its own");
  }
  CorrectValues(folder, slices, image);
  image->SetSpacing(
    slices.front().Spacing[0], slices.front().Spacing[1], GetDistanceOfSlices(slices));
  if (axes == Axes::OfPatient)
  {
    PlaceInPatient(slices, image);
  }
  CheckDistances(folder, slices);
  return image;
}

//------------------------------------------------------------------------------
/// The reader that knows the first bytes, if there is one. The others print what they miss there.
vtkSmartPointer<vtkImageReader2> FindReader(const std::string& fileName)
{
  const int display = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff();
  auto reader = vtk::TakeSmartPointer(vtkImageReader2Factory::CreateImageReader2(fileName.c_str()));
  vtkObject::SetGlobalWarningDisplay(display);
  // It takes any file for its own.
  const std::string extension =
    SystemTools::LowerCase(SystemTools::GetFilenameLastExtension(fileName));
  const bool isOther =
    reader && reader->IsA("vtkHDRReader") && extension != ".hdr" && extension != ".pic";
  return isOther ? nullptr : reader;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadIntoMemory(
  const std::string& fileName, double maxMemory, const ChooseExtent& choose, Axes axes)
{
  if (SystemTools::FileIsDirectory(fileName))
  {
    vtkSmartPointer<vtkImageData> image = ReadSlices(fileName, maxMemory, axes);
    Extent whole;
    image->GetExtent(whole.data());
    image->Crop(choose(whole).data());
    return image;
  }
  CheckIsFile(fileName);
  const double unknown = std::numeric_limits<double>::infinity();
  if (SystemTools::StringEndsWith(SystemTools::LowerCase(fileName), ".vti"))
  {
    CheckXmlFile(fileName);
    return ReadFile(
      vtkNew<vtkXMLImageDataReader>().Get(), fileName, { unknown, maxMemory, choose, axes });
  }
  // The factory does not have these readers.
  if (ImageFiles::IsNrrd(fileName))
  {
    ImageFiles::CheckNrrd(fileName);
    return ReadFile(vtkNew<vtkNrrdReader>().Get(), fileName, { unknown, maxMemory, choose, axes });
  }
  if (ImageFiles::IsNifti(fileName))
  {
    return ReadFile(vtkNew<vtkNIFTIImageReader>().Get(), fileName,
      { ImageFiles::GetCapacityOfNifti(fileName), maxMemory, choose, axes });
  }
  // Before the factory, whose readers look into the file.
  const double capacity =
    ImageFiles::IsMetaImage(fileName) ? ImageFiles::GetCapacityOfMetaImage(fileName) : unknown;
  const auto reader = FindReader(fileName);
  if (!reader)
  {
    throw std::runtime_error("VTK has no image reader for " + fileName);
  }
  return ReadFile(reader.Get(), fileName, { capacity, maxMemory, choose, axes });
}

//------------------------------------------------------------------------------
/// Whether the values are others than those that are stored.
bool IsScaled(const std::string& fileName)
{
  vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName(fileName.c_str());
  if (!ImageFiles::IsNifti(fileName))
  {
    return false;
  }
  reader->UpdateInformation();
  return HasScale(reader);
}

//------------------------------------------------------------------------------
/// The image where it is in the file; null if it cannot be used there, or has no such array there.
vtkSmartPointer<vtkImageData> MapPiece(
  const std::string& fileName, const std::string& array, const ChooseExtent& choose, Axes axes)
{
  vtkNew<vtkMappedImageReader> mapped;
  if (!mapped->CanReadFile(fileName.c_str()) || IsScaled(fileName))
  {
    return nullptr;
  }
  const double unlimited = std::numeric_limits<double>::infinity();
  const vtkSmartPointer<vtkImageData> image =
    ReadFile(mapped.Get(), fileName, { unlimited, unlimited, choose, axes });
  return array.empty() || image->GetPointData()->HasArray(array.c_str()) ? image : nullptr;
}

}

//------------------------------------------------------------------------------
const char* const MaxMemoryHelp = "The most memory that the volume may take, in MiB. Default: the "
                                  "memory of this machine, or that of "
                                  "the container.";

//------------------------------------------------------------------------------
double GetDefaultMaxMemory()
{
  vtksys::SystemInformation system;
  constexpr double kibibytesPerMebibyte = 1024.0;
  return std::min(static_cast<double>(system.GetProcMemoryAvailable()) / kibibytesPerMebibyte,
    FindLimitOfGroups() / BytesPerMebibyte);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& fileName, double maxMemory, Axes axes)
{
  return ReadIntoMemory(fileName, maxMemory, ChooseWhole, axes);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadOrMapVolume(
  const std::string& fileName, const std::string& array, double maxMemory, Axes axes)
{
  // NIfTI has axes and values of its own.
  const vtkSmartPointer<vtkImageData> image =
    ImageFiles::IsNifti(fileName) ? nullptr : MapPiece(fileName, array, ChooseWhole, axes);
  const double bytes = image ? static_cast<double>(image->GetNumberOfPoints()) *
      image->GetNumberOfScalarComponents() * image->GetScalarSize()
                             : 0.0;
  return bytes > 0.5 * maxMemory * BytesPerMebibyte ? image : ReadVolume(fileName, maxMemory, axes);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadPiece(const std::string& fileName, const std::string& array,
  double maxMemory, const ChooseExtent& choose)
{
  const vtkSmartPointer<vtkImageData> image = MapPiece(fileName, array, choose, Axes::OfSamples);
  return image ? image : ReadIntoMemory(fileName, maxMemory, choose, Axes::OfSamples);
}

}
