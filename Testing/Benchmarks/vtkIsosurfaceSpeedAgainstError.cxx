// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast and how exact the solvers are, beside samplers and triangles: see --help. Needs a
// display for the plots; xvfb-run gives one.

#include "BenchmarkInputs.h"
#include "BenchmarkMethods.h"
#include "BenchmarkReport.h"

#include <vtksys/CommandLineArguments.hxx>
#include <vtksys/SystemInformation.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
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
  int Pixels = 128;
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
    "The edge of the picture of errors. Default: 128.");
  parser.AddArgument("--output", Parser::SPACE_ARGUMENT, &arguments.Output,
    "The folder of the report. Default: the current one.");
  parser.AddBooleanArgument("--quick", &arguments.Quick, "Small fields, few rays: a test.");
  parser.AddBooleanArgument("--help", &arguments.Help, "Show this text.");
  const bool parsed = parser.Parse() != 0;
  const bool sensible = arguments.Size >= 8 && arguments.Rays >= 8 && arguments.Repeats >= 1 &&
    arguments.Pixels >= 1 && (arguments.Input.empty() || !std::isnan(arguments.Isovalue));
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
    arguments.Pixels = 24;
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
// What is equal to the isovalue is inside. On a face whose corners all are, 113 bits may come out a
// little below.
bool IsInside(const Oracle::Quad& value)
{
  return value >= -1e-26;
}

//------------------------------------------------------------------------------
// The t of the first hit of every line, NaN where there is none, by the oracle: every cell, 113
// bits.
std::vector<double> FindTruth(const Input& input, const std::vector<Oracle::Line>& lines)
{
  std::vector<double> truth(lines.size(), std::numeric_limits<double>::quiet_NaN());
#pragma omp parallel for schedule(dynamic, 16)
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    for (const Oracle::Piece& piece : Oracle::FindPieces(input.Field, input.Isovalue, lines[i]))
    {
      const bool beginsInside = IsInside(piece.AtBegin);
      if (beginsInside != IsInside(piece.AtEnd))
      {
        const bool isCrossing = (piece.AtBegin >= 0) != (piece.AtEnd >= 0);
        truth[i] = static_cast<double>(isCrossing
            ? Oracle::FindCrossing(input.Field, input.Isovalue, lines[i], piece)
            : (beginsInside ? piece.Begin : piece.End));
        break;
      }
    }
  }
  return truth;
}

//------------------------------------------------------------------------------
// The error of a hit: NaN where there is nothing and nothing found, infinite where misjudged.
double GetError(double found, double truth)
{
  if (std::isnan(found) != std::isnan(truth))
  {
    return std::numeric_limits<double>::infinity();
  }
  return std::abs(found - truth);
}

//------------------------------------------------------------------------------
Result Measure(const Input& input, const Method& method, const std::vector<Oracle::Line>& lines,
  const std::vector<double>& truth, int repeats)
{
  constexpr double wrong = 0.05;
  using Clock = std::chrono::steady_clock;
  Result result{ input.Name, method.Family, method.Knob, static_cast<int>(lines.size()), 0, 0, 0, 0,
    {}, 0.0, 0.0, 0.0, method.MeasureCell() };
  std::vector<double> found(lines.size());
  method.Cast(lines, found); // Bricks are made and memory is touched.
  std::vector<double> times;
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    const Clock::time_point start = Clock::now();
    method.Cast(lines, found);
    times.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count() /
      static_cast<double>(lines.size()));
  }
  std::sort(times.begin(), times.end());
  result.NanosecondsPerRay = times[times.size() / 2];
  result.Fastest = times.front();
  result.Slowest = times.back();
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    result.Hits += std::isnan(truth[i]) ? 0 : 1;
    result.Missed += std::isnan(found[i]) && !std::isnan(truth[i]) ? 1 : 0;
    result.Invented += !std::isnan(found[i]) && std::isnan(truth[i]) ? 1 : 0;
    const double error = GetError(found[i], truth[i]);
    if (std::isfinite(error))
    {
      result.Errors.push_back(error);
      result.Wrong += error > wrong ? 1 : 0;
    }
  }
  std::sort(result.Errors.begin(), result.Errors.end());
  return result;
}

//------------------------------------------------------------------------------
void DrawHeatMap(const Input& input, int pixels, const std::string& fileName)
{
  const std::vector<Oracle::Line> lines = MakePicture(input, pixels);
  const std::vector<double> truth = FindTruth(input, lines);
  std::vector<std::vector<double>> errors;
  std::vector<double> found(lines.size());
  for (const Method& method : MakeMethods(input, lines))
  {
    const bool isShown = method.Knob == "N = 3" || method.Knob == "0.5 cells" ||
      method.Family == "Robust" || method.Family == "Fast" ||
      method.Family == "Triangles of flying edges";
    if (isShown)
    {
      method.Cast(lines, found);
      errors.emplace_back();
      for (std::size_t i = 0; i < lines.size(); ++i)
      {
        errors.back().push_back(GetError(found[i], truth[i]));
      }
    }
  }
  WriteHeatMap(errors, pixels, fileName);
}

//------------------------------------------------------------------------------
std::string DescribeMachine(const Arguments& arguments)
{
  vtksys::SystemInformation system;
  system.RunCPUCheck();
  return std::string(system.GetModelName()) + ", " + std::to_string(arguments.Repeats) +
    " repeats, " __VERSION__;
}

//------------------------------------------------------------------------------
// What the project promises, of every input: a run of the benchmark is a test of it.
bool KeepsPromises(const std::vector<Result>& results)
{
  bool kept = true;
  for (const Result& result : results)
  {
    if (result.Family == "Robust" &&
      (result.Missed + result.Invented + result.Wrong > 0 || result.GetError(0.99) > 1e-9))
    {
      std::fprintf(stderr, "Robust breaks its promises on %s.\n", result.Input.c_str());
      kept = false;
    }
  }
  return kept;
}

//------------------------------------------------------------------------------
bool Run(const Arguments& arguments)
{
  if (!vtksys::SystemTools::MakeDirectory(arguments.Output))
  {
    throw std::runtime_error("the folder " + arguments.Output + " cannot be made");
  }
  std::vector<Result> results;
  for (const Input& input : MakeInputs(arguments))
  {
    const std::vector<Oracle::Line> lines = MakeLines(input, arguments.Rays);
    std::fprintf(stderr, "%s: the truth about %zu rays...\n", input.Name.c_str(), lines.size());
    const std::vector<double> truth = FindTruth(input, lines);
    for (const Method& method : MakeMethods(input, lines))
    {
      std::fprintf(stderr, "  %s %s\n", method.Family.c_str(), method.Knob.c_str());
      results.push_back(Measure(input, method, lines, truth, arguments.Repeats));
    }
    std::string name = input.Name;
    std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '-');
    DrawHeatMap(input, arguments.Pixels, arguments.Output + "/" + name + "-heat.png");
  }
  for (const std::string& file : WriteReport(results, DescribeMachine(arguments), arguments.Output))
  {
    if (!vtksys::SystemTools::FileExists(arguments.Output + "/" + file, true))
    {
      throw std::runtime_error(file + " was not written");
    }
  }
  std::printf("%s/results.md\n", arguments.Output.c_str());
  return KeepsPromises(results);
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
    return Run(arguments) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
