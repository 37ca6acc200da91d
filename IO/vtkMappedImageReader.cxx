// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkMappedImageReader.h"

#include "FileMapping.h"
#include "FilePrefetch.h"
#include "ImageFormats.h"
#include "MappableImage.h"
#include "MappingsInUse.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

namespace
{

using ImageFiles::FileMapping;
using ImageFiles::MappableImage;
using ImageFiles::MappingsInUse;

}

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkMappedImageReader);

//------------------------------------------------------------------------------
vtkMappedImageReader::vtkMappedImageReader()
  : Prefetch(std::make_unique<ImageFiles::FilePrefetch>())
{
}

//------------------------------------------------------------------------------
vtkMappedImageReader::~vtkMappedImageReader() = default;

//------------------------------------------------------------------------------
int vtkMappedImageReader::CanReadFile(const char* fileName)
{
  try
  {
    if (fileName && ImageFiles::HasHeader(fileName))
    {
      ImageFiles::FindImage(fileName).Check();
      return 3;
    }
  }
  catch (const std::exception&)
  {
    // It is to be read in another way, which tells what is wrong.
  }
  return 0;
}

//------------------------------------------------------------------------------
bool vtkMappedImageReader::IsMapped(vtkDataArray* array)
{
  return array && array->HasStandardMemoryLayout() && array->GetNumberOfValues() > 0 &&
    MappingsInUse::Find(array->GetVoidPointer(0)) != nullptr;
}

//------------------------------------------------------------------------------
/// The superclass takes the files for slices, and their number for the extent.
void vtkMappedImageReader::SetFileNames(vtkStringArray* names)
{
  const int first = this->DataExtent[4];
  const int last = this->DataExtent[5];
  this->Superclass::SetFileNames(names);
  this->DataExtent[4] = first;
  this->DataExtent[5] = last;
}

//------------------------------------------------------------------------------
int vtkMappedImageReader::GetNumberOfSteps()
{
  const int files = this->FileNames ? static_cast<int>(this->FileNames->GetNumberOfValues()) : 0;
  return this->FileName ? 1 : files;
}

//------------------------------------------------------------------------------
std::string vtkMappedImageReader::GetFileNameOfStep(int step)
{
  return this->FileName ? std::string(this->FileName) : this->FileNames->GetValue(step);
}

//------------------------------------------------------------------------------
/// What is set, as vtkImageReader2 takes it.
MappableImage vtkMappedImageReader::FindRawImage(const std::string& fileName)
{
  MappableImage image;
  image.Samples.FileName = fileName;
  image.Samples.Offset =
    this->ManualHeaderSize ? static_cast<std::int64_t>(this->HeaderSize) : std::int64_t{ -1 };
  image.Samples.AreBigEndian = this->GetDataByteOrder() == VTK_FILE_BYTE_ORDER_BIG_ENDIAN;
  image.ArrayName = "ImageFile";
  image.ScalarType = this->DataScalarType;
  image.NumberOfComponents = this->NumberOfScalarComponents;
  image.Reader = "vtkImageReader2";
  std::copy_n(this->DataExtent, 6, image.Extent.begin());
  std::copy_n(this->DataSpacing, 3, image.Spacing.begin());
  std::copy_n(this->DataOrigin, 3, image.Origin.begin());
  std::copy_n(this->DataDirection, 9, image.Direction.begin());
  if (this->FileDimensionality != 3 && this->DataExtent[4] != this->DataExtent[5])
  {
    image.Throw("its slices are to be in files of their own. Set FileDimensionality to 3.");
  }
  if (!this->FileLowerLeft)
  {
    image.Reverse(1);
  }
  return image;
}

//------------------------------------------------------------------------------
MappableImage vtkMappedImageReader::FindImage(const std::string& fileName)
{
  MappableImage image = ImageFiles::HasHeader(fileName) ? ImageFiles::FindImage(fileName)
                                                        : this->FindRawImage(fileName);
  image.Check();
  return image;
}

//------------------------------------------------------------------------------
MappableImage vtkMappedImageReader::FindImageOfStep(int step)
{
  if (this->FileName)
  {
    return *this->Image;
  }
  MappableImage image = this->FindImage(this->GetFileNameOfStep(step));
  if (!image.IsLike(*this->Image))
  {
    image.Throw("its size, type, array or geometry is not that of the first time step, " +
      this->Image->Samples.FileName + ". Read it with a reader of its own.");
  }
  return image;
}

//------------------------------------------------------------------------------
/// The one that is nearest to the time that is asked for.
int vtkMappedImageReader::ChooseStep(vtkInformation* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const double time =
    output->Has(Pipeline::UPDATE_TIME_STEP()) ? output->Get(Pipeline::UPDATE_TIME_STEP()) : 0.0;
  const double last = this->GetNumberOfSteps() - 1.0;
  return time > 0.0 ? static_cast<int>(std::round(std::min(time, last))) : 0;
}

//------------------------------------------------------------------------------
int vtkMappedImageReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->Image.reset();
  this->SetErrorCode(vtkErrorCode::NoError);
  const int steps = this->GetNumberOfSteps();
  if (steps == 0)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("A file name must be set (SetFileName), or those of time steps (SetFileNames). "
                  "A volume in several files is not mapped.");
    return 0;
  }
  try
  {
    this->Image = std::make_unique<MappableImage>(this->FindImage(this->GetFileNameOfStep(0)));
  }
  catch (const std::exception& problem)
  {
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    vtkErrorMacro(<< problem.what());
    return 0;
  }
  vtkInformation* output = outputVector->GetInformationObject(0);
  output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Image->Extent.data(), 6);
  output->Set(vtkDataObject::SPACING(), this->Image->Spacing.data(), 3);
  output->Set(vtkDataObject::ORIGIN(), this->Image->Origin.data(), 3);
  output->Set(vtkDataObject::DIRECTION(), this->Image->Direction.data(), 9);
  output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(
    output, this->Image->ScalarType, this->Image->NumberOfComponents);
  output->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  output->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  if (!this->FileName)
  {
    std::vector<double> times(static_cast<std::size_t>(steps));
    std::iota(times.begin(), times.end(), 0.0);
    const double range[2] = { times.front(), times.back() };
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), steps);
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkMappedImageReader::MapSlices(
  const MappableImage& image, const int extent[6], vtkImageData* output)
{
  vtkSmartPointer<vtkDataArray> scalars;
  scalars.TakeReference(vtkDataArray::CreateDataArray(image.ScalarType));
  scalars->SetName(image.ArrayName.c_str());
  scalars->SetNumberOfComponents(image.NumberOfComponents);
  const std::int64_t slices = std::int64_t{ image.Extent[5] } - image.Extent[4] + 1;
  const auto valuesOfSlice = static_cast<std::int64_t>(image.GetNumberOfValues()) / slices;
  const std::int64_t sizeOfSlice = valuesOfSlice * scalars->GetDataTypeSize();
  const std::int64_t count = std::int64_t{ extent[5] } - extent[4] + 1;
  void* bytes = MappingsInUse::Keep(std::make_unique<FileMapping>(image.Samples.FileName,
    image.Samples.Offset + (std::int64_t{ extent[4] } - image.Extent[4]) * sizeOfSlice,
    static_cast<std::size_t>(count * sizeOfSlice)));
  constexpr int isGivenBack = 0;
  scalars->SetVoidArray(
    bytes, count * valuesOfSlice, isGivenBack, vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  scalars->SetArrayFreeFunction(&MappingsInUse::GiveBack);
  const auto& whole = image.Extent;
  output->SetExtent(whole[0], whole[1], whole[2], whole[3], extent[4], extent[5]);
  output->GetPointData()->SetScalars(scalars);
}

//------------------------------------------------------------------------------
/// If the next one is damaged, that is told when it is asked for.
void vtkMappedImageReader::PrefetchAfter(int step)
{
  const int next = step + (step < this->Step ? -1 : 1);
  this->Step = step;
  if (next < 0 || next >= this->GetNumberOfSteps())
  {
    return;
  }
  try
  {
    const MappableImage image = this->FindImageOfStep(next);
    this->Prefetch->Start(
      image.Samples.FileName, image.Samples.Offset, static_cast<std::int64_t>(image.GetSize()));
  }
  catch (const std::exception&)
  {
  }
}

//------------------------------------------------------------------------------
int vtkMappedImageReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->Image)
  {
    return 0;
  }
  vtkInformation* information = outputVector->GetInformationObject(0);
  int extent[6];
  information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
  const int step = this->ChooseStep(information);
  vtkImageData* output = vtkImageData::GetData(information);
  try
  {
    this->MapSlices(this->FindImageOfStep(step), extent, output);
  }
  catch (const std::exception& problem)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< problem.what());
    return 0;
  }
  if (!this->FileName)
  {
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), step);
    this->PrefetchAfter(step);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkMappedImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Image: " << (this->Image ? this->Image->Samples.FileName : "(none)") << "\n";
}

VTK_ABI_NAMESPACE_END
