// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast an image is in thousands of blocks, beside the image as a whole: see --help. It needs a
// display; xvfb-run gives one.

#include "AnalyticFieldSource.h"
#include "Environment.h"
#include "OffScreenWindow.h"
#include "Report.h"
#include "RunProgram.h"
#include "Samples.h"
#include "Schedule.h"
#include "TracedIsosurface.h"
#include "Views.h"

#include <vtkAMRBox.h>
#include <vtkImageData.h>
#include <vtkIsosurfaceRayTraceMapper.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOverlappingAMR.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredData.h>
#include <vtkUniformGrid.h>
#include <vtkVersionMacros.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtksys/CommandLineArguments.hxx>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace Benchmark;

struct Arguments
{
  int Blocks = 22;
  int BlockSize = 16;
  int Size = 512;
  int Views = 8;
  int Repeats = 5;
  std::string Json = "blocks.json";
  bool Help = false;
};

//------------------------------------------------------------------------------
bool ParseArguments(int argc, char* argv[], Arguments& arguments)
{
  using Parser = vtksys::CommandLineArguments;
  Parser parser;
  parser.Initialize(argc, argv);
  parser.AddArgument("--blocks", Parser::SPACE_ARGUMENT, &arguments.Blocks,
    "The number of blocks along each axis. Default: 22, which makes 10648.");
  parser.AddArgument("--block-size", Parser::SPACE_ARGUMENT, &arguments.BlockSize,
    "The number of cells of a block along each axis. Default: 16.");
  parser.AddArgument("--size", Parser::SPACE_ARGUMENT, &arguments.Size,
    "The edge of the pictures in pixels. Default: 512.");
  parser.AddArgument(
    "--views", Parser::SPACE_ARGUMENT, &arguments.Views, "The number of views. Default: 8.");
  parser.AddArgument("--repeats", Parser::SPACE_ARGUMENT, &arguments.Repeats,
    "The number of measurements of each time. Default: 5.");
  parser.AddArgument("--json", Parser::SPACE_ARGUMENT, &arguments.Json,
    "The file for the results. Default: blocks.json.");
  parser.AddBooleanArgument("--help", &arguments.Help, "Show this text.");
  const bool parsed = parser.Parse() != 0;
  const bool sensible = arguments.Blocks >= 1 && arguments.Blocks <= 64 &&
    arguments.BlockSize >= 1 && arguments.BlockSize <= 256 && arguments.Size >= 16 &&
    arguments.Size <= 16384 && arguments.Views >= 1 && arguments.Repeats >= 1;
  if (arguments.Help || !parsed || !sensible)
  {
    std::fprintf(arguments.Help ? stdout : stderr,
      "Usage: vtkIsosurfaceBlocksBenchmark [options]\n%s"
      "Blocks: 1 to 64; their size: 1 to 256; pictures: 16 to 16384 pixels.\n",
      parser.GetHelp());
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeImage(const Arguments& arguments)
{
  const int samples = arguments.Blocks * arguments.BlockSize + 1;
  vtkNew<AnalyticFieldSource> source;
  source->SetField("gyroid");
  source->SetDimensions({ samples, samples, samples });
  source->Update();
  vtkSmartPointer<vtkImageData> image = source->GetOutput();
  return image;
}

/// A part of an image, with the samples at its borders.
void CopyBlock(vtkImageData* whole, const std::array<int, 3>& first, int size, vtkImageData* block)
{
  block->SetOrigin(whole->GetOrigin());
  block->SetSpacing(whole->GetSpacing());
  int extent[6];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = whole->GetExtent()[2 * axis] + first[axis];
    extent[2 * axis + 1] = extent[2 * axis] + size;
  }
  block->SetExtent(extent);
  block->AllocateScalars(whole->GetScalarType(), 1);
  block->CopyAndCastFrom(whole, extent);
}

/// Calls visit(number, first) for all blocks.
template <typename Visit>
void ForEachBlock(const Arguments& arguments, const Visit& visit)
{
  unsigned int number = 0;
  for (int z = 0; z < arguments.Blocks; ++z)
  {
    for (int y = 0; y < arguments.Blocks; ++y)
    {
      for (int x = 0; x < arguments.Blocks; ++x)
      {
        visit(number++,
          std::array<int, 3>{
            x * arguments.BlockSize, y * arguments.BlockSize, z * arguments.BlockSize });
      }
    }
  }
}

/// The same spacing for all, or one for each: a little smaller, so that no two lie on one lattice.
vtkSmartPointer<vtkDataObject> MakeBlocks(
  const Arguments& arguments, vtkImageData* whole, bool haveOneLattice)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  ForEachBlock(arguments,
    [&](unsigned int number, const std::array<int, 3>& first)
    {
      vtkNew<vtkImageData> block;
      CopyBlock(whole, first, arguments.BlockSize, block);
      if (!haveOneLattice)
      {
        double corner[3];
        block->TransformIndexToPhysicalPoint(
          block->GetExtent()[0], block->GetExtent()[2], block->GetExtent()[4], corner);
        const double* spacing = whole->GetSpacing();
        const double smaller = 1.0 - 1e-3 * (1 + number % 97) / arguments.BlockSize;
        block->SetExtent(0, arguments.BlockSize, 0, arguments.BlockSize, 0, arguments.BlockSize);
        block->SetOrigin(corner);
        block->SetSpacing(spacing[0] * smaller, spacing[1] * smaller, spacing[2] * smaller);
      }
      blocks->SetBlock(number, block);
    });
  return blocks;
}

/// A single level.
vtkSmartPointer<vtkDataObject> MakeAmr(const Arguments& arguments, vtkImageData* whole)
{
  vtkNew<vtkOverlappingAMR> amr;
  const int count = arguments.Blocks * arguments.Blocks * arguments.Blocks;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  amr->Initialize(std::vector<unsigned int>{ static_cast<unsigned int>(count) });
#else
  amr->Initialize(1, &count);
#endif
  amr->SetOrigin(whole->GetOrigin());
  amr->SetGridDescription(vtkStructuredData::GetDataDescriptionFromExtent(whole->GetExtent()));
  amr->SetSpacing(0, whole->GetSpacing());
  ForEachBlock(arguments,
    [&](unsigned int number, const std::array<int, 3>& first)
    {
      vtkNew<vtkUniformGrid> block;
      CopyBlock(whole, first, arguments.BlockSize, block);
      double corner[3];
      block->TransformIndexToPhysicalPoint(
        block->GetExtent()[0], block->GetExtent()[2], block->GetExtent()[4], corner);
      block->SetExtent(0, arguments.BlockSize, 0, arguments.BlockSize, 0, arguments.BlockSize);
      block->SetOrigin(corner);
      const int last = arguments.BlockSize - 1;
      amr->SetAMRBox(0, number,
        vtkAMRBox(first[0], first[1], first[2], first[0] + last, first[1] + last, first[2] + last));
      amr->SetDataSet(0, number, block);
    });
  return amr;
}

//------------------------------------------------------------------------------
/// The same samples in some form, and what their pictures took.
struct Form
{
  std::string Name;
  vtkSmartPointer<vtkDataObject> Data;
  vtkSmartPointer<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkSmartPointer<vtkVolume> Volume;
  Samples First;
  Samples Next;
  Samples Ratio;
  Samples Trace;
  Samples Memory;

  /// A new mapper, which has built nothing.
  void Reset()
  {
    this->Mapper = vtkSmartPointer<vtkIsosurfaceRayTraceMapper>::New();
    this->Mapper->SetInputDataObject(this->Data);
    this->Volume = vtkSmartPointer<vtkVolume>::New();
    this->Volume->SetProperty(NewSurfaceProperty(0.0));
    this->Volume->SetMapper(this->Mapper);
  }
};

//------------------------------------------------------------------------------
void Run(const Arguments& arguments, const std::vector<std::string>& command)
{
  if (!OffScreenWindow::IsPossible())
  {
    throw std::runtime_error("pictures need a display: run it with xvfb-run -a");
  }
  OffScreenWindow window(arguments.Size);
  Report report;
  report.Environment = DescribeEnvironment(command, &window);
  const auto write = [&]() { WriteJson(report.GetJson(), arguments.Json); };
  write(); // What cannot be written is known now.
  Log("making the image and its blocks");
  const vtkSmartPointer<vtkImageData> whole = MakeImage(arguments);
  std::vector<Form> forms(4);
  forms[0].Name = "one image";
  forms[0].Data = whole;
  forms[1].Name = "blocks on one lattice";
  forms[1].Data = MakeBlocks(arguments, whole, true);
  forms[2].Name = "blocks of AMR data, on one level";
  forms[2].Data = MakeAmr(arguments, whole);
  forms[3].Name = "blocks on lattices of their own";
  forms[3].Data = MakeBlocks(arguments, whole, false);
  Bounds bounds;
  whole->GetBounds(bounds.data());
  const std::vector<View> orbit = MakeOrbit(bounds, arguments.Views);
  for (int repeat = 0; repeat < arguments.Repeats; ++repeat)
  {
    Log("pictures, turn " + std::to_string(repeat + 1));
    for (Form& form : forms)
    {
      form.Reset();
      window.Show(form.Volume);
      form.First.Add(window.Draw(orbit.front()));
    }
    // All have seen every side before.
    for (const bool isMeasured : { false, true })
    {
      for (const View& view : orbit)
      {
        double ofImage = 0.0;
        for (Form& form : forms)
        {
          window.Show(form.Volume);
          const double seconds = window.Draw(view);
          ofImage = &form == &forms.front() ? seconds : ofImage;
          if (isMeasured)
          {
            form.Next.Add(seconds);
            form.Ratio.Add(seconds / ofImage);
            form.Trace.Add(form.Mapper->GetTraceTime());
          }
        }
      }
    }
    for (Form& form : forms)
    {
      form.Memory.Add(
        static_cast<double>(form.Mapper->GetMacrocellMemory() + form.Mapper->GetBrickMemory()));
    }
  }
  const int blocks = arguments.Blocks * arguments.Blocks * arguments.Blocks;
  const std::string size = std::to_string(arguments.BlockSize) + "^3 cells";
  const Table table = { "blocks", std::to_string(blocks) + " blocks of " + size,
    "Pictures of " + std::to_string(arguments.Size) + " x " + std::to_string(arguments.Size) +
      " pixels in a window, with shading and display. The first from nothing, the next from all "
      "sides. Memory beside the samples: macrocells, bricks, masks of cells, samples of AMR data; "
      "not the image that blocks on one lattice are joined to.",
    { "data", "first picture, ms", "next picture, ms", "times that of one image",
      "of it, tracing, ms", "memory, MiB" },
    {} };
  for (const Form& form : forms)
  {
    report.AddRow(table,
      { form.Name, form.First * 1e3, form.Next * 1e3, form.Ratio, form.Trace * 1e3,
        form.Memory.GetMedian() / (1 << 20) });
  }
  for (std::size_t i = 1; i < forms.size(); ++i)
  {
    report.Goals.push_back({ 1, forms[i].Name + ": a picture, against that of one image",
      forms[i].Ratio.GetMedian(), true, 1.5 });
  }
  write();
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  return Benchmark::RunProgram<Arguments>(argc, argv, ParseArguments,
    [&](const Arguments& arguments)
    {
      Run(arguments, { argv, argv + argc });
      return true;
    });
}
