// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast and how exact the solvers are, beside samplers, triangles and VTK's mappers: see --help.
// Plots and the mappers of VTK need a display; xvfb-run gives one.

#include "BenchmarkInputs.h"
#include "BenchmarkMethods.h"
#include "BenchmarkPictures.h"
#include "BenchmarkReport.h"
#include "Circumstances.h"
#include "Judgement.h"
#include "OffScreenWindow.h"
#include "Rivals.h"
#include "Samples.h"
#include "Setup.h"

#include <vtksys/CommandLineArguments.hxx>
#include <vtksys/SystemTools.hxx>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace Benchmark;

struct Arguments
{
  std::string Input;
  double Isovalue = std::numeric_limits<double>::quiet_NaN();
  int Size = 64;
  int Rays = 20000;
  int Repeats = 5;
  int Pixels = 256;
  std::string Output = ".";
  bool Quick = false;
  bool Help = false;
};

//------------------------------------------------------------------------------
bool ParseArguments(int argc, char* argv[], Arguments& arguments)
{
  using Parser = vtksys::CommandLineArguments;
  Parser parser;
  parser.Initialize(argc, argv);
  parser.AddArgument("--input", Parser::SPACE_ARGUMENT, &arguments.Input,
    "A volume: .vti, .nii, .mhd or any other image that VTK reads. Default: fields made here.");
  parser.AddArgument("--isovalue", Parser::SPACE_ARGUMENT, &arguments.Isovalue,
    "The isovalue of the volume in the file.");
  parser.AddArgument(
    "--size", Parser::SPACE_ARGUMENT, &arguments.Size, "The edge of the fields. Default: 64.");
  parser.AddArgument(
    "--rays", Parser::SPACE_ARGUMENT, &arguments.Rays, "About how many rays. Default: 20000.");
  parser.AddArgument("--repeats", Parser::SPACE_ARGUMENT, &arguments.Repeats,
    "How often times are taken. Default: 5.");
  parser.AddArgument("--pixels", Parser::SPACE_ARGUMENT, &arguments.Pixels,
    "The edge of the pictures. Default: 256.");
  parser.AddArgument("--output", Parser::SPACE_ARGUMENT, &arguments.Output,
    "The folder of the report. Default: the current one.");
  parser.AddBooleanArgument("--quick", &arguments.Quick, "Small fields, few rays: a test.");
  parser.AddBooleanArgument("--help", &arguments.Help, "Show this text.");
  const bool parsed = parser.Parse() != 0;
  const bool sensible = arguments.Size >= 8 && arguments.Rays >= 8 && arguments.Repeats >= 1 &&
    arguments.Pixels >= 16 && arguments.Pixels <= 16384 &&
    (arguments.Input.empty() || !std::isnan(arguments.Isovalue));
  if (arguments.Help || !parsed || !sensible)
  {
    std::printf("Usage: vtkIsosurfaceSpeedAgainstError [options]\n%s", parser.GetHelp());
    return false;
  }
  if (arguments.Quick)
  {
    arguments.Size = 24;
    arguments.Rays = 800;
    arguments.Repeats = 1;
    arguments.Pixels = 64;
  }
  return true;
}

//------------------------------------------------------------------------------
std::vector<Input> MakeInputs(const Arguments& arguments)
{
  if (!arguments.Input.empty())
  {
    return { ReadInput(arguments.Input, arguments.Isovalue) };
  }
  const int n = arguments.Size;
  return { MakeMarschnerLobb(n), MakeGyroid(n), MakeRandom(n), MakeNearTangent(n),
    MakePlateaus(n) };
}

//------------------------------------------------------------------------------
// In turn, so that what else the machine does is everybody's.
std::vector<Result> MeasureRays(
  const Input& input, const Rays& rays, const std::vector<double>& truth, int repeats)
{
  const std::vector<Method> methods = MakeMethods(input, rays.Lines);
  std::vector<Result> results;
  std::vector<double> found(rays.Lines.size());
  for (const Method& method : methods)
  {
    Say("  " + method.Family + " " + method.Knob);
    method.Cast(rays.Lines, found); // Bricks are made and memory is touched.
    results.push_back({ input.Name, method.Family, method.Knob, Judge(found, truth), {},
      method.MeasureCell(), {}, {} });
  }
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    for (std::size_t i = 0; i < methods.size(); ++i)
    {
      const double seconds = Measure([&]() { methods[i].Cast(rays.Lines, found); });
      results[i].NanosecondsPerRay.Add(1e9 * seconds / static_cast<double>(rays.Lines.size()));
    }
  }
  return results;
}

//------------------------------------------------------------------------------
void AddIfMeasured(double value, Samples& samples)
{
  if (!std::isnan(value))
  {
    samples.Add(value);
  }
}

//------------------------------------------------------------------------------
// In turn too.
std::vector<Result> MeasurePictures(
  const Input& input, const Rays& rays, const std::vector<double>& truth, int repeats)
{
  const std::vector<Painter> painters = MakePainters(input, rays);
  std::vector<Result> results;
  for (const Painter& painter : painters)
  {
    Say("  picture: " + painter.Family + " " + painter.Knob);
    results.push_back({ input.Name, painter.Family, painter.Knob, Judge(Look(painter, rays), truth),
      {}, 0.0, {}, {} });
  }
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    for (std::size_t i = 0; i < painters.size(); ++i)
    {
      Result& result = results[i];
      if (IsEnough(result.FrameMilliseconds * 1e-3, repeats * static_cast<int>(rays.Views.size())))
      {
        continue;
      }
      for (const FrameTimes& times : DrawAll(painters[i], rays))
      {
        AddIfMeasured(1e3 * times.Whole, result.FrameMilliseconds);
        AddIfMeasured(1e3 * times.Trace, result.TraceMilliseconds);
      }
    }
  }
  return results;
}

//------------------------------------------------------------------------------
void DrawHeatMap(const Input& input, int pixels, const std::string& fileName)
{
  const Rays rays = MakePicture(input, pixels);
  Say("  the truth about the " + std::to_string(rays.Lines.size()) + " pixels of a picture");
  const std::vector<double> truth = FindTruth(input, rays.Lines);
  std::vector<HeatPanel> panels;
  const auto addPanel = [&](const std::string& title, const std::vector<double>& found)
  {
    panels.push_back({ title, {} });
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      panels.back().Errors.push_back(GetError(found[i], truth[i]));
    }
  };
  const std::set<std::string> shown = { "Robust", "Fast", "Marmitt N = 3",
    "Sampler, bisecting 0.5 cells", "Sampler 0.5 cells", "Triangles of flying edges" };
  std::vector<double> found(rays.Lines.size());
  for (const Method& method : MakeMethods(input, rays.Lines))
  {
    const std::string title = method.Family + (method.Knob.empty() ? "" : " " + method.Knob);
    if (shown.count(title) > 0)
    {
      method.Cast(rays.Lines, found);
      addPanel(title, found);
    }
  }
  for (const Painter& painter : MakePainters(input, rays))
  {
    if (painter.Knob == "0.5 cells")
    {
      addPanel(painter.Family + " " + painter.Knob, Look(painter, rays));
    }
  }
  WriteHeatMap(panels, pixels, fileName);
}

//------------------------------------------------------------------------------
// What the project promises, of every input: a run of the benchmark is a test of it.
bool KeepsPromises(const std::vector<Result>& results)
{
  bool kept = true;
  for (const Result& result : results)
  {
    const Judgement& judged = result.Judged;
    if (result.Family == "Robust" &&
      (judged.Missed + judged.Invented + judged.Wrong > 0 || judged.GetError(0.99) > 1e-9))
    {
      Say("Robust breaks its promises on " + result.Input + ".");
      kept = false;
    }
  }
  return kept;
}

//------------------------------------------------------------------------------
Results MeasureAll(const Arguments& arguments)
{
  Results results;
  for (const Input& input : MakeInputs(arguments))
  {
    const Rays rays = MakeRays(input, arguments.Rays, arguments.Pixels);
    Say(input.Name + ": the truth about " + std::to_string(rays.Lines.size()) + " rays");
    const std::vector<double> truth = FindTruth(input, rays.Lines);
    for (Result& result : MeasureRays(input, rays, truth, arguments.Repeats))
    {
      results.Rays.push_back(std::move(result));
    }
    for (Result& result : MeasurePictures(input, rays, truth, arguments.Repeats))
    {
      results.Pictures.push_back(std::move(result));
    }
    if (OffScreenWindow::IsPossible())
    {
      DrawHeatMap(
        input, arguments.Pixels, arguments.Output + "/" + GetFileName(input.Name) + "-heat.png");
    }
  }
  return results;
}

//------------------------------------------------------------------------------
bool Run(const Arguments& arguments, const std::vector<std::string>& command)
{
  if (!vtksys::SystemTools::MakeDirectory(arguments.Output))
  {
    throw std::runtime_error("the folder " + arguments.Output + " cannot be made");
  }
  // A display may close itself when nobody has a window on it: this one stays.
  const auto window =
    OffScreenWindow::IsPossible() ? std::make_unique<OffScreenWindow>(16) : nullptr;
  auto circumstances = DescribeMachine(command, window.get());
  for (const char* rival : { "polygons", "gpu", "fixed-point" })
  {
    const std::string absence = GetAbsence(rival);
    if (!absence.empty())
    {
      circumstances.emplace_back("absent", std::string(rival) + ", because " + absence);
      Say(circumstances.back().second);
    }
  }
  const Results results = MeasureAll(arguments);
  for (const std::string& file : WriteReport(results, circumstances, arguments.Output))
  {
    if (!vtksys::SystemTools::FileExists(arguments.Output + "/" + file, true))
    {
      throw std::runtime_error(file + " was not written");
    }
  }
  std::printf("%s/results.md\n", arguments.Output.c_str());
  const bool raysKept = KeepsPromises(results.Rays);
  return KeepsPromises(results.Pictures) && raysKept;
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Arguments arguments;
  if (!ParseArguments(argc, argv, arguments))
  {
    return arguments.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  try
  {
    return Run(arguments, { argv, argv + argc }) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
