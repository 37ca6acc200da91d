// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ImageFormats.h"

#include "AppendedSamples.h"
#include "HeaderText.h"
#include "MetaImageHeader.h"
#include "NiftiHeader.h"
#include "NrrdHeader.h"

#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataReader.h>
#include <vtksys/SystemTools.hxx>

#include <optional>
#include <stdexcept>

namespace ImageFiles
{
namespace
{

using vtksys::SystemTools;

//------------------------------------------------------------------------------
/// Counts errors in place of printing them.
class ErrorCounter : public vtkCommand
{
public:
  static ErrorCounter* New() { return new ErrorCounter; }
  void Execute(vtkObject*, unsigned long, void*) override { ++this->Count; }

  int Count = 0;
};

void Observe(vtkAlgorithm* reader, vtkCommand* errors)
{
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
}

void Observe(vtkXMLImageDataReader* reader, vtkCommand* errors)
{
  Observe(static_cast<vtkAlgorithm*>(reader), errors);
  reader->SetParserErrorObserver(errors);
}

//------------------------------------------------------------------------------
/// VTK's own. Object factories make another where vtkIOMPIImage is loaded, as by Python's "import
/// vtk": it crashes, or fails, without a controller, and waits for all processes of one.
class NrrdReader : public vtkNrrdReader
{
public:
  static NrrdReader* New() { VTK_STANDARD_NEW_BODY(NrrdReader); }
};

//------------------------------------------------------------------------------
/// What the reader's output will be.
void Describe(vtkInformation* output, MappableImage& image)
{
  output->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), image.Extent.data());
  output->Get(vtkDataObject::SPACING(), image.Spacing.data());
  output->Get(vtkDataObject::ORIGIN(), image.Origin.data());
  image.Direction = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
  if (output->Has(vtkDataObject::DIRECTION()))
  {
    output->Get(vtkDataObject::DIRECTION(), image.Direction.data());
  }
  vtkInformation* scalars = vtkDataObject::GetActiveFieldInformation(
    output, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  if (!scalars)
  {
    image.Throw("its header names no scalars of points (Scalars=\"...\")");
  }
  image.ScalarType = scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE());
  image.NumberOfComponents = scalars->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS());
}

//------------------------------------------------------------------------------
template <typename ReaderT>
MappableImage ReadHeader(ReaderT* reader, const std::string& fileName)
{
  MappableImage image = {};
  image.Samples.FileName = fileName;
  image.Reader = reader->GetClassName();
  vtkNew<ErrorCounter> errors;
  Observe(reader, errors);
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  if (errors->Count > 0)
  {
    image.Throw("its header is damaged; " + image.Reader + " tells how.");
  }
  Describe(reader->GetOutputInformation(0), image);
  return image;
}

//------------------------------------------------------------------------------
/// Of samples that are stored in another way.
[[noreturn]] void ThrowOfOtherForm(const MappableImage& image, const std::string& form)
{
  image.Throw("its samples are " + form +
    ". Write them uncompressed, binary, and into one file, or read them into the memory with " +
    image.Reader + ".");
}

//------------------------------------------------------------------------------
MappableImage FindImageOfMetaImage(const std::string& fileName)
{
  // Before VTK's reader, which trusts the header.
  const std::optional<RawSamples> samples = FindRawSamples(fileName);
  MappableImage image = ReadHeader(vtkNew<vtkMetaImageReader>().Get(), fileName);
  if (!samples)
  {
    ThrowOfOtherForm(image, "compressed, text, or in several files");
  }
  image.Samples = *samples;
  image.ArrayName = "MetaImage";
  return image;
}

//------------------------------------------------------------------------------
MappableImage FindImageOfNrrd(const std::string& fileName)
{
  const std::optional<NrrdSamples> samples = FindRawSamplesOfNrrd(fileName);
  vtkNew<NrrdReader> reader;
  MappableImage image = ReadHeader(reader.Get(), fileName);
  if (!samples)
  {
    ThrowOfOtherForm(
      image, "compressed, text, in several files, or after others that are to be skipped");
  }
  CheckNrrd(fileName);
  image.Samples = *samples;
  image.ArrayName = reader->GetScalarArrayName();
  if (image.GetNumberOfValues() != samples->Count)
  {
    image.Throw("the sizes in its header are not those of a volume");
  }
  if (!reader->GetFileLowerLeft())
  {
    image.Reverse(1);
  }
  return image;
}

//------------------------------------------------------------------------------
MappableImage FindImageOfNifti(const std::string& fileName)
{
  // Throws for a type of which VTK's reader crashes.
  GetCapacityOfNifti(fileName);
  vtkNew<vtkNIFTIImageReader> reader;
  MappableImage image = ReadHeader(reader.Get(), fileName);
  vtkNIFTIImageHeader* header = reader->GetNIFTIHeader();
  const bool hasVectors = header->GetDim(0) >= 5 && header->GetDim(5) > 1;
  if (IsCompressedNifti(fileName) || hasVectors)
  {
    ThrowOfOtherForm(image, "compressed, or have components one after the other");
  }
  if (header->GetVoxOffset() < 0)
  {
    image.Throw("its header is damaged: the samples are before the file.");
  }
  image.Samples.Offset = header->GetVoxOffset();
  image.Samples.AreBigEndian = reader->GetDataByteOrder() == VTK_FILE_BYTE_ORDER_BIG_ENDIAN;
  image.ArrayName = "NIFTI";
  if (reader->GetQFac() < 0.0)
  {
    image.Reverse(2);
  }
  return image;
}

//------------------------------------------------------------------------------
MappableImage FindImageOfVti(const std::string& fileName)
{
  vtkNew<vtkXMLImageDataReader> reader;
  MappableImage image = ReadHeader(reader.Get(), fileName);
  const std::optional<AppendedSamples> samples =
    FindAppendedSamples(reader->GetXMLParser(), fileName);
  if (!samples)
  {
    ThrowOfOtherForm(
      image, "compressed, text, encoded, hidden in part, or in several pieces or time steps");
  }
  image.Samples = *samples;
  image.ArrayName = samples->ArrayName;
  if (!samples->HaveSize(image.GetSize()))
  {
    image.Throw("its scalars have another size than its extent. Write the file again.");
  }
  return image;
}

}

//------------------------------------------------------------------------------
bool HasHeader(const std::string& fileName)
{
  const std::string extension =
    SystemTools::LowerCase(SystemTools::GetFilenameLastExtension(fileName));
  return IsMetaImage(fileName) || IsNrrd(fileName) || IsNifti(fileName) || extension == ".vti";
}

//------------------------------------------------------------------------------
MappableImage FindImage(const std::string& fileName)
{
  if (IsPipe(fileName))
  {
    throw std::runtime_error(fileName + " is a pipe, which cannot be mapped: give a file");
  }
  if (IsMetaImage(fileName))
  {
    return FindImageOfMetaImage(fileName);
  }
  if (IsNrrd(fileName))
  {
    return FindImageOfNrrd(fileName);
  }
  return IsNifti(fileName) ? FindImageOfNifti(fileName) : FindImageOfVti(fileName);
}

}
