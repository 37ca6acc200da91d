// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Shows isosurfaces of a file in a window: see --help.

#include "Scalars.h"
#include "Support/CommandLine.h"
#include "Support/OutputFile.h"
#include "Support/ReadDataObject.h"
#include "Support/ReadVolume.h"
#include "Support/ThreadsAtRest.h"
#include "Window.h"
#include "vtkIsosurfaceComparisonFilter.h"

#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkRTAnalyticSource.h>
#include <vtkSmartPointer.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

//------------------------------------------------------------------------------
struct Arguments
{
  std::vector<std::string> Files;
  bool Demo = false;
  std::string Array;
  std::vector<double> Isovalues;
  double MaxMemory = Programs::GetDefaultMaxMemory();
  bool Help = false;
};

//------------------------------------------------------------------------------
/// Throws std::runtime_error if they are invalid; prints the help if it is requested.
Arguments ParseArguments(int argc, char* argv[])
{
  Arguments arguments;
  Programs::CommandLine commandLine(argc, argv);
  commandLine.AddFiles(&arguments.Files);
  commandLine.Add("--demo", &arguments.Demo, "Show a volume that is computed, without a file.");
  commandLine.Add("--array", &arguments.Array,
    "The array of points or cells whose isosurfaces are shown, of vectors those of their "
    "magnitude. Default: the active scalars, or else the first array.");
  commandLine.Add("--isovalue", &arguments.Isovalues,
    "One or two isovalues, separated by spaces: the surface of the smaller one is translucent. "
    "Default: the value between the two classes of values that differ most.");
  commandLine.Add("--max-memory", &arguments.MaxMemory, Programs::MaxMemoryHelp);
  if (!commandLine.Parse())
  {
    // Indented as the options, which is how help2man tells a list.
    const std::string controls = std::regex_replace(Viewer::Controls, std::regex(".+"), "  $&");
    std::printf(
      "Shows isosurfaces in a window, ray traced. Usage:\n\n"
      "  vtkIsosurfaceViewer FILE... [--isovalue VALUE...]\n"
      "  vtkIsosurfaceViewer --demo\n\n"
      "FILE is an image (.vti, .mhd, .mha, .nii, .nii.gz, .nrrd, .nhdr or another one that VTK\n"
      "reads), a folder of DICOM slices, a grid or a mesh (.vtr, .vts, .vtu, .vtk, or Exodus:\n"
      ".e, .ex2, .exo, .g), one in pieces (.pvti, .pvtr, .pvts, .pvtu), or composite data (.vtm) "
      "or\n"
      "AMR data (.vthb, .vth).\n"
      "Several files are shown together, by the array of the first.\n"
      "%s\nIn the window:\n\n%s\n"
      "When the window is closed, the times of frames while something moved are printed, and the\n"
      "exit code is 0; after an error it is 1.\n",
      commandLine.GetHelp().c_str(), controls.c_str());
    arguments.Help = true;
  }
  else if (arguments.Files.empty() == !arguments.Demo)
  {
    throw std::runtime_error("name files, a folder of DICOM slices, or --demo; see --help");
  }
  else if (arguments.Isovalues.size() > Viewer::NumberOfSurfaces)
  {
    throw std::runtime_error("--isovalue takes at most two values");
  }
  std::sort(arguments.Isovalues.begin(), arguments.Isovalues.end(), std::greater<double>());
  return arguments;
}

//------------------------------------------------------------------------------
/// The volume that VTK tests with: waves in a Gaussian ball.
vtkSmartPointer<vtkDataObject> MakeDemo()
{
  constexpr int radius = 48;
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-radius, radius, -radius, radius, -radius, radius);
  source->Update();
  return source->GetOutput();
}

//------------------------------------------------------------------------------
/// What is shown, and its name.
struct Input
{
  std::string Name;
  vtkSmartPointer<vtkDataObject> Data;
};

/// Throws std::runtime_error with the name of a file that has nothing to show.
Viewer::Scalars FindScalars(const Input& input, const std::string& array)
{
  try
  {
    return Viewer::Scalars(input.Data, array);
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(input.Name + ": " + error.what());
  }
}

//------------------------------------------------------------------------------
/// Several files become the blocks of composite data.
Input Read(const Arguments& arguments)
{
  if (arguments.Demo)
  {
    return { "demo", MakeDemo() };
  }
  std::vector<Input> inputs;
  std::string names;
  for (const std::string& file : arguments.Files)
  {
    inputs.push_back(
      { file, Programs::ReadDataObject(file, arguments.Array, arguments.MaxMemory) });
    names += (names.empty() ? "" : ", ") + vtksys::SystemTools::GetFilenameName(file);
  }
  if (inputs.size() == 1)
  {
    return { names, inputs.front().Data };
  }
  const std::string array = FindScalars(inputs.front(), arguments.Array).GetName();
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const Input& input : inputs)
  {
    FindScalars(input, array);
    blocks->SetBlock(blocks->GetNumberOfBlocks(), input.Data);
  }
  return { names, blocks };
}

//------------------------------------------------------------------------------
/// Throws std::runtime_error if one is not within the values.
void CheckIsovalues(const std::vector<double>& isovalues, const Viewer::Scalars& scalars)
{
  for (const double isovalue : isovalues)
  {
    const bool isWithin = scalars.GetLowest() <= isovalue && isovalue <= scalars.GetHighest();
    if (!isWithin)
    {
      std::ostringstream problem;
      problem << "there is no surface at " << isovalue << ": the values are from "
              << scalars.GetLowest() << " to " << scalars.GetHighest();
      throw std::runtime_error(problem.str());
    }
  }
}

//------------------------------------------------------------------------------
void Show(const Arguments& arguments)
{
  const std::string whyNot = vtkIsosurfaceComparisonFilter::WhyNoPictures();
  if (!whyNot.empty())
  {
    throw std::runtime_error(whyNot);
  }
  const Input input = Read(arguments);
  const Viewer::Scalars scalars = FindScalars(input, arguments.Array);
  CheckIsovalues(arguments.Isovalues, scalars);
  Viewer::Window window(input.Data, scalars, arguments.Isovalues, input.Name);
  window.Run();
  std::printf("%s", window.SummarizeFrameTimes().c_str());
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Programs::LetThreadsRest(argv);
  try
  {
    const Arguments arguments = ParseArguments(argc, argv);
    if (!arguments.Help)
    {
      Show(arguments);
    }
    Programs::FlushStandardOutput();
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "error: %s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
