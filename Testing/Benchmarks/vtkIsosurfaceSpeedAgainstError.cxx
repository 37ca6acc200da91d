// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast and how exact the solvers are, beside samplers, triangles and VTK's mappers: see --help.
// The mappers of VTK need a display; xvfb-run gives one.

#include "AccuracyReport.h"
#include "BenchmarkInputs.h"
#include "Environment.h"
#include "HitAccuracy.h"
#include "OffScreenWindow.h"
#include "PictureMethods.h"
#include "RayMethods.h"
#include "RunProgram.h"
#include "Samples.h"
#include "Schedule.h"
#include "Support/InputFiles.h"
#include "Support/OutputFile.h"
#include "Support/ReadVolume.h"

#include <vtksys/CommandLineArguments.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
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
  int Pixels = 256;
  std::string Output = ".";
  bool Quick = false;
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
    "A volume: .vti, .nii, .mhd or any other image that VTK reads. Default: analytic fields.");
  parser.AddArgument("--isovalue", Parser::SPACE_ARGUMENT, &arguments.Isovalue,
    "The isovalue of the volume in the file.");
  parser.AddArgument(
    "--size", Parser::SPACE_ARGUMENT, &arguments.Size, "The edge of the fields. Default: 64.");
  parser.AddArgument("--rays", Parser::SPACE_ARGUMENT, &arguments.Rays,
    "The approximate number of rays. Default: 20000.");
  parser.AddArgument("--repeats", Parser::SPACE_ARGUMENT, &arguments.Repeats,
    "The number of measurements of each time. Default: 5.");
  parser.AddArgument("--pixels", Parser::SPACE_ARGUMENT, &arguments.Pixels,
    "The edge of the pictures. Default: 256.");
  parser.AddArgument("--output", Parser::SPACE_ARGUMENT, &arguments.Output,
    "The folder for results.json and the images of errors (.vti). Default: the current one.");
  parser.AddBooleanArgument("--quick", &arguments.Quick, "Small fields, few rays: a test.");
  parser.AddArgument(
    "--max-memory", Parser::SPACE_ARGUMENT, &arguments.MaxMemory, Programs::MaxMemoryHelp);
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
    return { ReadInput(arguments.Input, arguments.Isovalue, arguments.MaxMemory) };
  }
  const int n = arguments.Size;
  return { MakeMarschnerLobb(n), MakeGyroid(n), MakeRandom(n), MakeNearTangent(n),
    MakePlateaus(n) };
}

//------------------------------------------------------------------------------
// In turn, so that what else the machine does affects all methods alike.
std::vector<Result> MeasureRays(
  const Input& input, const Rays& rays, const std::vector<double>& reference, int repeats)
{
  const std::vector<RayMethod> methods = MakeRayMethods(input, rays.Lines);
  std::vector<Result> results;
  std::vector<double> found(rays.Lines.size());
  for (const RayMethod& method : methods)
  {
    Log("  " + method.Family + " " + method.Parameter);
    method.Cast(rays.Lines, found); // Bricks are made and memory is touched.
    results.push_back({ method.Family, method.Parameter, MeasureAccuracy(found, reference), {},
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
  const Input& input, const Rays& rays, const std::vector<double>& reference, int repeats)
{
  const std::vector<PictureMethod> methods = MakePictureMethods(input, rays);
  std::vector<Result> results;
  for (const PictureMethod& method : methods)
  {
    Log("  picture: " + method.Family + " " + method.Parameter);
    results.push_back({ method.Family, method.Parameter,
      MeasureAccuracy(GetDistances(method, rays), reference), {}, NotMeasured, {}, {} });
  }
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    for (std::size_t i = 0; i < methods.size(); ++i)
    {
      Result& result = results[i];
      if (IsEnough(result.FrameMilliseconds * 1e-3, repeats * static_cast<int>(rays.Views.size())))
      {
        continue;
      }
      for (const FrameTimes& times : DrawAll(methods[i], rays))
      {
        AddIfMeasured(1e3 * times.Whole, result.FrameMilliseconds);
        AddIfMeasured(1e3 * times.Trace, result.TraceMilliseconds);
      }
    }
  }
  return results;
}

//------------------------------------------------------------------------------
// The errors of all pixels of a picture, of some methods.
std::vector<PictureErrors> FindPictureErrors(const Input& input, int pixels)
{
  const Rays rays = MakePicture(input, pixels);
  Log("  the reference of the " + std::to_string(rays.Lines.size()) + " pixels of a picture");
  const std::vector<double> reference = FindReference(input, rays.Lines);
  std::vector<PictureErrors> pictures;
  const auto add = [&](const std::string& title, const std::vector<double>& found)
  {
    pictures.push_back({ title, {} });
    std::transform(found.begin(), found.end(), reference.begin(),
      std::back_inserter(pictures.back().Errors), GetError);
  };
  const std::set<std::string> shown = { "Robust", "Single precision", "Marmitt N = 3",
    "Sampler, bisecting 0.5 cells", "Sampler 0.5 cells", "Triangles of flying edges" };
  std::vector<double> found(rays.Lines.size());
  for (const RayMethod& method : MakeRayMethods(input, rays.Lines))
  {
    const std::string title =
      method.Family + (method.Parameter.empty() ? "" : " " + method.Parameter);
    if (shown.count(title) > 0)
    {
      method.Cast(rays.Lines, found);
      add(title, found);
    }
  }
  for (const PictureMethod& method : MakePictureMethods(input, rays))
  {
    if (method.Parameter == "0.5 cells")
    {
      add(method.Family + " " + method.Parameter, GetDistances(method, rays));
    }
  }
  return pictures;
}

//------------------------------------------------------------------------------
// What the project promises, of every input: a run of the benchmark is a test of it.
bool KeepsPromises(const Input& input, const std::vector<Result>& results)
{
  const auto robust = std::find_if(
    results.begin(), results.end(), [](const Result& result) { return result.Family == "Robust"; });
  const HitAccuracy& accuracy = robust->Accuracy;
  if (accuracy.Missed + accuracy.Invented + accuracy.Displaced > 0 ||
    accuracy.GetError(0.99) > 1e-9)
  {
    Log("Robust breaks its promises on " + input.Name + ".");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
Json::Value ToJson(const std::vector<Result>& results)
{
  Json::Value rows;
  for (const Result& result : results)
  {
    rows.append(Benchmark::ToJson(result));
  }
  return rows;
}

//------------------------------------------------------------------------------
std::string GetErrorImageName(std::string input)
{
  std::replace_if(
    input.begin(), input.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '-');
  return input + "-errors.vti";
}

//------------------------------------------------------------------------------
// Returns whether promises are kept.
bool MeasureInput(const Input& input, const Arguments& arguments, Json::Value& json)
{
  const Rays rays = MakeRays(input, arguments.Rays, arguments.Pixels);
  Log(input.Name + ": the reference of " + std::to_string(rays.Lines.size()) + " rays");
  const std::vector<double> reference = FindReference(input, rays.Lines);
  const auto ofRays = MeasureRays(input, rays, reference, arguments.Repeats);
  const auto ofPictures = MeasurePictures(input, rays, reference, arguments.Repeats);
  json["name"] = input.Name;
  json["isovalue"] = input.Isovalue;
  json["numberOfRays"] = ofRays.front().Accuracy.Rays;
  json["numberOfHits"] = ofRays.front().Accuracy.Hits;
  json["rays"] = ToJson(ofRays);
  json["pictures"] = ToJson(ofPictures);
  json["errorImage"] = GetErrorImageName(input.Name);
  WriteErrorImage(FindPictureErrors(input, arguments.Pixels), arguments.Pixels,
    arguments.Output + "/" + GetErrorImageName(input.Name));
  const bool raysKeep = KeepsPromises(input, ofRays);
  return KeepsPromises(input, ofPictures) && raysKeep;
}

//------------------------------------------------------------------------------
bool Run(const Arguments& arguments, const std::vector<std::string>& command)
{
  if (!vtksys::SystemTools::MakeDirectory(arguments.Output))
  {
    throw std::runtime_error("the folder " + arguments.Output + " cannot be created");
  }
  const std::string results = arguments.Output + "/results.json";
  Programs::CheckIsNoInput(results, arguments.Input);
  Programs::CheckOutput(results); // What cannot be written is known now.
  // A display may close itself when it has no window: this one stays.
  const auto window =
    OffScreenWindow::IsPossible() ? std::make_unique<OffScreenWindow>(16) : nullptr;
  Json::Value root;
  root["environment"] = DescribeEnvironment(command, window.get());
  SelectAvailable({ "polygons", "gpu", "fixed-point" }, root["environment"]);
  bool kept = true;
  for (const Input& input : MakeInputs(arguments))
  {
    kept = MeasureInput(input, arguments, root["inputs"].append({})) && kept;
  }
  WriteJson(root, results);
  return kept;
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  return Benchmark::RunProgram<Arguments>(argc, argv, ParseArguments,
    [&](const Arguments& arguments) {
      return Run(arguments, { argv, argv + argc });
    });
}
