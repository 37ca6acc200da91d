// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast this mapper is, beside triangles and other mappers: see --help. What needs a window
// needs a display too; xvfb-run gives one.

#include "Baselines.h"
#include "Comparison.h"
#include "Environment.h"
#include "GoalMeasurements.h"
#include "Growth.h"
#include "OffScreenWindow.h"
#include "PaperTables.h"
#include "ReadImage.h"
#include "Report.h"
#include "RunProgram.h"
#include "Schedule.h"
#include "Support/InputFiles.h"
#include "Support/ReadVolume.h"

#include <vtkSMPTools.h>
#include <vtksys/CommandLineArguments.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace Benchmark;

struct Arguments
{
  std::string Input;
  std::vector<double> Isovalues;
  int Size = 512;
  int Views = 8;
  int Repeats = 5;
  std::string Threads;
  std::string Baselines = "flying-edges,marching-cubes,polygons,embree,fixed-point,gpu";
  bool Goals = false;
  bool Papers = false;
  int Growth = 0;
  std::string Json = "benchmark.json";
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
    "A volume: .vti, .nii, .mhd or any other image that VTK reads, or a folder of DICOM slices.");
  parser.AddArgument("--isovalue", Parser::SPACE_ARGUMENT, &arguments.Isovalues,
    "An isovalue; the option may be repeated.");
  parser.AddArgument("--size", Parser::SPACE_ARGUMENT, &arguments.Size,
    "The edge of the pictures in pixels. Default: 512.");
  parser.AddArgument(
    "--views", Parser::SPACE_ARGUMENT, &arguments.Views, "The number of views. Default: 8.");
  parser.AddArgument("--repeats", Parser::SPACE_ARGUMENT, &arguments.Repeats,
    "The number of measurements of each time, fewer of slow ones. Default: 5.");
  parser.AddArgument("--threads", Parser::SPACE_ARGUMENT, &arguments.Threads,
    "Numbers of threads, such as 1,2. Default: 1 and all that the machine has.");
  parser.AddArgument("--baselines", Parser::SPACE_ARGUMENT, &arguments.Baselines,
    "Some of flying-edges,marching-cubes,polygons,embree,fixed-point,gpu, or none. Default: all.");
  parser.AddBooleanArgument("--goals", &arguments.Goals,
    "Measure cold start, whole frames at 1024 x 1024 and simulated scaling too.");
  parser.AddBooleanArgument("--papers", &arguments.Papers,
    "Make the tables of the papers of 1998 and 2001 too, with other hierarchies and bricks.");
  parser.AddArgument("--growth", Parser::SPACE_ARGUMENT, &arguments.Growth,
    "Measure the growth with the edge of the volume too, from 64 to this; needs no --input.");
  parser.AddArgument("--json", Parser::SPACE_ARGUMENT, &arguments.Json,
    "The file for the results. Default: benchmark.json.");
  parser.AddArgument(
    "--max-memory", Parser::SPACE_ARGUMENT, &arguments.MaxMemory, Programs::MaxMemoryHelp);
  parser.AddBooleanArgument("--help", &arguments.Help, "Show this text.");
  const bool parsed = parser.Parse() != 0;
  const bool complete = arguments.Input.empty() == arguments.Isovalues.empty() &&
    (!arguments.Input.empty() || arguments.Growth > 0);
  const bool sensible = arguments.Size >= 16 && arguments.Size <= 16384 && arguments.Views >= 1 &&
    arguments.Repeats >= 1 && (arguments.Growth == 0 || arguments.Growth >= 128);
  if (arguments.Help || !parsed || !complete || !sensible)
  {
    std::fprintf(arguments.Help ? stdout : stderr,
      "Usage: vtkIsosurfaceBenchmark --input FILE --isovalue V [options]\n"
      "       vtkIsosurfaceBenchmark --growth 1024 [options]\n%s"
      "Size: 16 to 16384. Growth: 128 or more.\n",
      parser.GetHelp());
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
std::vector<std::string> ParseBaselines(const std::string& text)
{
  if (text == "none")
  {
    return {};
  }
  const std::vector<std::string> known = GetBaselineNames();
  std::vector<std::string> baselines;
  for (const std::string& name : vtksys::SystemTools::SplitString(text, ','))
  {
    if (std::find(known.begin(), known.end(), name) == known.end())
    {
      throw std::runtime_error("--baselines " + text + ": there is no baseline \"" + name +
        "\"; there are flying-edges, marching-cubes, polygons, embree, fixed-point, gpu, or none");
    }
    baselines.push_back(name);
  }
  return baselines;
}

//------------------------------------------------------------------------------
void DescribeVolume(const Setup& setup, const std::string& file, Report& report)
{
  const int* n = setup.Image->GetDimensions();
  const double* range = setup.Image->GetScalarRange();
  report.Environment["volume"] = vtksys::SystemTools::GetFilenameName(file) + ", " +
    std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]) + ", " +
    setup.Image->GetScalarTypeAsString() + " from " + ToText(range[0]) + " to " + ToText(range[1]);
  for (const double isovalue : setup.Isovalues)
  {
    if (!(isovalue > range[0] && isovalue <= range[1]))
    {
      throw std::runtime_error("--isovalue " + ToText(isovalue) + ": " + file +
        " has values from " + ToText(range[0]) + " to " + ToText(range[1]) +
        ", so there is no surface");
    }
  }
}

//------------------------------------------------------------------------------
// Calls back after every part, so that hours of work are not lost.
void MeasureAll(const Arguments& arguments, const Setup& setup, Report& report,
  const std::function<void()>& onPartDone)
{
  for (const double isovalue : setup.Isovalues)
  {
    CompareWithBaselines(setup, isovalue, report);
    onPartDone();
    if (arguments.Goals)
    {
      MeasureColdStart(setup, isovalue, report);
      MeasureWholeFrame(setup, isovalue, report);
      MeasureScaling(setup, isovalue, report);
      onPartDone();
    }
  }
  if (arguments.Papers && setup.Image)
  {
    MakePaperTables(setup, report);
    onPartDone();
  }
  if (arguments.Growth > 0)
  {
    MeasureGrowth(setup, arguments.Growth, report);
    onPartDone();
  }
}

//------------------------------------------------------------------------------
void Run(const Arguments& arguments, const std::vector<std::string>& command)
{
  Report report;
  Setup setup{ { arguments.Size, arguments.Views, ParseThreads(arguments.Threads),
                 arguments.Repeats },
    nullptr, arguments.Isovalues, {} };
  vtkSMPTools::Initialize(setup.GetMostThreads());
  // A display may close itself when it has no window: this one stays.
  const auto window =
    OffScreenWindow::IsPossible() ? std::make_unique<OffScreenWindow>(16) : nullptr;
  report.Environment = DescribeEnvironment(command, window.get());
  setup.Baselines = SelectAvailable(ParseBaselines(arguments.Baselines), report.Environment);
  if (!arguments.Input.empty())
  {
    setup.Image = ReadImage(arguments.Input, arguments.MaxMemory);
    DescribeVolume(setup, arguments.Input, report);
  }
  const auto write = [&arguments, &report]() { WriteJson(report.GetJson(), arguments.Json); };
  Programs::CheckIsNoInput(arguments.Json, arguments.Input);
  write(); // What cannot be written is known now.
  MeasureAll(arguments, setup, report, write);
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
