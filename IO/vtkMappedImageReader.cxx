// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkMappedImageReader.h"

#include "FileMapping.h"
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

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

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
vtkMappedImageReader::vtkMappedImageReader() = default;

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
/// What is set, as vtkImageReader2 takes it.
MappableImage vtkMappedImageReader::FindRawImage()
{
  MappableImage image;
  image.Samples.FileName = this->FileName;
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
int vtkMappedImageReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->Image.reset();
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro(
      "A file name must be set (SetFileName): a volume in several files is not mapped.");
    return 0;
  }
  try
  {
    MappableImage image = ImageFiles::HasHeader(this->FileName)
      ? ImageFiles::FindImage(this->FileName)
      : this->FindRawImage();
    image.Check();
    this->Image = std::make_unique<MappableImage>(std::move(image));
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
  return 1;
}

//------------------------------------------------------------------------------
void vtkMappedImageReader::MapSlices(const int extent[6], vtkImageData* output)
{
  const MappableImage& image = *this->Image;
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
  try
  {
    this->MapSlices(extent, vtkImageData::GetData(information));
  }
  catch (const std::exception& problem)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< problem.what());
    return 0;
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
