// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Writes a large volume to measure on, slab by slab: see --help.

#include "AnalyticFieldSource.h"
#include "ReadImage.h"
#include "RunProgram.h"
#include "Support/InputFiles.h"
#include "Support/OutputFile.h"
#include "Support/ReadVolume.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkImageInterpolator.h>
#include <vtkImageResize.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtksys/CommandLineArguments.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using Dimensions = std::array<int, 3>;

struct Arguments
{
  std::string Input;
  std::string Field;
  std::string Dimensions;
  std::string Output;
  double MaxMemory = Programs::GetDefaultMaxMemory();
  bool Help = false;
};

//------------------------------------------------------------------------------
bool ParseArguments(int argc, char* argv[], Arguments& arguments)
{
  using Parser = vtksys::CommandLineArguments;
  Parser parser;
  parser.Initialize(argc, argv);
  parser.AddArgument("--input", Parser::SPACE_ARGUMENT, &arguments.Input,
    "A volume to resample with cubic interpolation: .vti, .nii, .mhd or any other image that VTK "
    "reads, or a folder of DICOM slices. The type of its samples is kept.");
  parser.AddArgument("--field", Parser::SPACE_ARGUMENT, &arguments.Field,
    "Instead, a field to sample: gyroid, marschner-lobb or sphere. 16 bit, isovalue 0.");
  parser.AddArgument("--dimensions", Parser::SPACE_ARGUMENT, &arguments.Dimensions,
    "The number of samples: N for a cube or X,Y,Z. The Visible Woman has 512,512,1734.");
  parser.AddArgument("--output", Parser::SPACE_ARGUMENT, &arguments.Output,
    "The .mhd file to write; its samples go into a .raw file beside it.");
  parser.AddArgument(
    "--max-memory", Parser::SPACE_ARGUMENT, &arguments.MaxMemory, Programs::MaxMemoryHelp);
  parser.AddBooleanArgument("--help", &arguments.Help, "Show this text.");
  const bool parsed = parser.Parse() != 0;
  const bool complete = arguments.Input.empty() != arguments.Field.empty() &&
    !arguments.Dimensions.empty() && !arguments.Output.empty();
  if (arguments.Help || !parsed || !complete)
  {
    std::fprintf(arguments.Help ? stdout : stderr,
      "Usage: vtkIsosurfaceBenchmarkVolume (--input FILE | --field NAME) --dimensions N "
      "--output FILE.mhd\n%s",
      parser.GetHelp());
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
Dimensions ParseDimensions(const std::string& text)
{
  Dimensions dimensions = { 0, 0, 0 };
  char rest = 0;
  int* n = dimensions.data();
  const int numbers = std::sscanf(text.c_str(), "%d,%d,%d%c", n, n + 1, n + 2, &rest);
  if (numbers == 1 && text.find(',') == std::string::npos)
  {
    dimensions[1] = dimensions[2] = dimensions[0];
  }
  const auto isUsable = [](int count) { return count >= 2 && count <= 16384; };
  if ((numbers != 1 && numbers != 3) || !std::all_of(n, n + 3, isUsable))
  {
    throw std::runtime_error(
      "--dimensions " + text + ": give N or X,Y,Z, each from 2 to 16384 samples");
  }
  return dimensions;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageAlgorithm> NewSource(
  const Arguments& arguments, const Dimensions& dimensions)
{
  if (arguments.Input.empty())
  {
    auto source = vtkSmartPointer<Benchmark::AnalyticFieldSource>::New();
    source->SetField(arguments.Field);
    source->SetDimensions(dimensions);
    return source;
  }
  vtkNew<vtkImageInterpolator> cubic;
  cubic->SetInterpolationModeToCubic();
  auto resize = vtkSmartPointer<vtkImageResize>::New();
  resize->SetInputData(Benchmark::ReadImage(arguments.Input, arguments.MaxMemory));
  resize->SetInterpolator(cubic);
  resize->SetOutputDimensions(dimensions.data());
  return resize;
}

//------------------------------------------------------------------------------
const char* GetElementType(int vtkType)
{
  static const std::map<int, const char*> types = { { VTK_CHAR, "MET_CHAR" },
    { VTK_SIGNED_CHAR, "MET_CHAR" }, { VTK_UNSIGNED_CHAR, "MET_UCHAR" }, { VTK_SHORT, "MET_SHORT" },
    { VTK_UNSIGNED_SHORT, "MET_USHORT" }, { VTK_INT, "MET_INT" }, { VTK_UNSIGNED_INT, "MET_UINT" },
    { VTK_FLOAT, "MET_FLOAT" }, { VTK_DOUBLE, "MET_DOUBLE" } };
  const auto found = types.find(vtkType);
  if (found == types.end())
  {
    throw std::runtime_error(
      std::string("MetaImage has no samples of type ") + vtkImageScalarTypeNameMacro(vtkType));
  }
  return found->second;
}

//------------------------------------------------------------------------------
// The index of the first sample of a source: a part of an image does not begin with 0.
std::array<int, 3> FindFirst(vtkImageAlgorithm* source)
{
  source->UpdateInformation();
  const int* extent =
    source->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  return { extent[0], extent[2], extent[4] };
}

//------------------------------------------------------------------------------
// The type of MetaImage: its own names, and numbers as they are in memory here.
std::string MakeHeader(
  const std::string& rawName, vtkImageAlgorithm* source, const Dimensions& dimensions)
{
  vtkImageData* slab = source->GetOutput();
  const double* spacing = slab->GetSpacing();
  double origin[3];
  slab->TransformIndexToPhysicalPoint(FindFirst(source).data(), origin);
  const double* direction = slab->GetDirectionMatrix()->GetData();
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = "
#ifdef VTK_WORDS_BIGENDIAN
      << "True"
#else
      << "False"
#endif
      << "\nTransformMatrix =";
  for (int column = 0; column < 3; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      out << " " << direction[3 * row + column];
    }
  }
  out << "\nOffset = " << origin[0] << " " << origin[1] << " " << origin[2]
      << "\nElementSpacing = " << spacing[0] << " " << spacing[1] << " " << spacing[2]
      << "\nDimSize = " << dimensions[0] << " " << dimensions[1] << " " << dimensions[2]
      << "\nElementNumberOfChannels = " << slab->GetNumberOfScalarComponents()
      << "\nElementType = " << GetElementType(slab->GetScalarType())
      << "\nElementDataFile = " << vtksys::SystemTools::GetFilenameName(rawName) << "\n";
  return out.str();
}

//------------------------------------------------------------------------------
void CheckSpace(const std::string& fileName, std::uintmax_t bytes)
{
  const std::filesystem::path folder = std::filesystem::absolute(fileName).parent_path();
  std::error_code error;
  const std::uintmax_t available = std::filesystem::space(folder, error).available;
  if (!error && available < bytes)
  {
    throw std::runtime_error(folder.string() + " has " + std::to_string(available >> 20U) +
      " MiB free, the volume needs " + std::to_string(bytes >> 20U) + " MiB");
  }
}

//------------------------------------------------------------------------------
// Makes the samples a slab at a time, so that no more is in memory. Returns their range.
std::array<double, 2> WriteSamples(vtkImageAlgorithm* source, const Dimensions& dimensions,
  const std::string& rawName, Programs::OutputFile& raw)
{
  constexpr int samplesInSlab = 1 << 24;
  const int thickness = std::max(1, samplesInSlab / dimensions[0] / dimensions[1]);
  const std::array<int, 3> first = FindFirst(source);
  std::array<double, 2> range = { VTK_DOUBLE_MAX, VTK_DOUBLE_MIN };
  for (int z = 0; z < dimensions[2]; z += thickness)
  {
    const int last = std::min(z + thickness, dimensions[2]) - 1;
    const int extent[6] = { first[0], first[0] + dimensions[0] - 1, first[1],
      first[1] + dimensions[1] - 1, first[2] + z, first[2] + last };
    source->UpdateExtent(extent);
    vtkDataArray* samples = source->GetOutput()->GetPointData()->GetScalars();
    const std::size_t bytes = static_cast<std::size_t>(samples->GetDataSize()) *
      static_cast<std::size_t>(samples->GetDataTypeSize());
    if (z == 0)
    {
      CheckSpace(rawName,
        static_cast<std::uintmax_t>(bytes) / static_cast<std::uintmax_t>(last + 1) *
          static_cast<std::uintmax_t>(dimensions[2]));
    }
    raw.Write(samples->GetVoidPointer(0), bytes);
    range[0] = std::min(range[0], samples->GetRange(0)[0]);
    range[1] = std::max(range[1], samples->GetRange(0)[1]);
    std::fprintf(stderr, "%d of %d slices\n", last + 1, dimensions[2]);
  }
  return range;
}

//------------------------------------------------------------------------------
std::string GetRawName(const std::string& headerName)
{
  return headerName.substr(0, headerName.size() - 3) + "raw";
}

//------------------------------------------------------------------------------
// Both files take their names when both are whole.
void WriteVolume(
  vtkImageAlgorithm* source, const Dimensions& dimensions, const std::string& headerName)
{
  const std::string rawName = GetRawName(headerName);
  Programs::OutputFile header(headerName);
  Programs::OutputFile raw(rawName);
  const std::array<double, 2> range = WriteSamples(source, dimensions, rawName, raw);
  const std::string text = MakeHeader(rawName, source, dimensions);
  header.Write(text.data(), text.size());
  raw.Finish();
  header.Finish();
  std::printf("%s: %d x %d x %d samples from %g to %g\n", headerName.c_str(), dimensions[0],
    dimensions[1], dimensions[2], range[0], range[1]);
}

//------------------------------------------------------------------------------
void Run(const Arguments& arguments)
{
  const Dimensions dimensions = ParseDimensions(arguments.Dimensions);
  if (vtksys::SystemTools::GetFilenameLastExtension(arguments.Output) != ".mhd")
  {
    throw std::runtime_error("--output " + arguments.Output + ": the name must end in .mhd");
  }
  Programs::CheckIsNoInput(arguments.Output, arguments.Input);
  Programs::CheckIsNoInput(GetRawName(arguments.Output), arguments.Input);
  WriteVolume(NewSource(arguments, dimensions), dimensions, arguments.Output);
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  return Benchmark::RunProgram<Arguments>(argc, argv, ParseArguments,
    [&](const Arguments& arguments)
    {
      Run(arguments);
      return true;
    });
}
