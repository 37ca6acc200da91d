// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Runs vtkIsosurfaceComparisonFilter from the command line: see --help.

#include "Comparison.h"
#include "ReadData.h"
#include "Report.h"
#include "Support/CommandLine.h"
#include "Support/InputFiles.h"
#include "Support/OutputFile.h"
#include "Support/ReadVolume.h"
#include "Support/ThreadsAtRest.h"
#include "TableFiles.h"
#include "vtkIsosurfaceComparisonFilter.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkTable.h>
#include <vtkVariant.h>
#include <vtkVersion.h>
#include <vtksys/SystemInformation.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{

using namespace Compare;
using Filter = vtkIsosurfaceComparisonFilter;

//------------------------------------------------------------------------------
enum class Kind
{
  Images,
  Meshes,
  Both
};

struct MethodSwitch
{
  const char* Name;
  Kind Data;
  void (Filter::*Set)(bool);
  /// Whether it is measured unless others are chosen.
  bool IsEssential;
};

const MethodSwitch Methods[] = {
  { "flying-edges", Kind::Images, &Filter::SetFlyingEdges, true },
  { "marching-cubes", Kind::Images, &Filter::SetMarchingCubes, true },
  { "synchronized-templates", Kind::Images, &Filter::SetSynchronizedTemplates, false },
  { "contour-filter", Kind::Images, &Filter::SetContourFilter, false },
  { "span-space", Kind::Images, &Filter::SetSpanSpace, false },
  { "contour-grid", Kind::Meshes, &Filter::SetContourGrid, true },
  { "contour-3d-linear-grid", Kind::Meshes, &Filter::SetContour3DLinearGrid, true },
  { "gpu-ray-cast", Kind::Images, &Filter::SetGPUVolumeRayCast, true },
  { "ray-tracing", Kind::Both, &Filter::SetRayTracing, true },
};

//------------------------------------------------------------------------------
struct Arguments
{
  std::string Input;
  std::string Array;
  std::vector<double> Isovalues;
  std::vector<std::string> Methods;
  int Repeats = 3;
  bool Thorough = false;
  std::string Json;
  std::string Csv;
  std::string Report;
  double MaxMemory = Programs::GetDefaultMaxMemory();
  bool Help = false;
};

//------------------------------------------------------------------------------
/// Throws std::runtime_error if they are invalid; prints the help if it is requested.
Arguments ParseArguments(int argc, char* argv[])
{
  std::string methods = "One or more of the methods";
  for (const MethodSwitch& method : Methods)
  {
    methods += std::string(" ") + method.Name;
  }
  methods +=
    ". Those with grid in their names are for meshes, ray-tracing is for both, the others are for "
    "images. Default: flying-edges, marching-cubes, gpu-ray-cast (vtkGPUVolumeRayCastMapper) and "
    "ray-tracing, or those for meshes.";

  Arguments arguments;
  Programs::CommandLine commandLine(argc, argv);
  commandLine.Add("--input", &arguments.Input,
    "A volume: .vti, .nii, .mhd or any other image that VTK reads, or a folder of DICOM slices; or "
    "a mesh: .vtu, .vts, .pvtu, .pvts, .vtk, .vtm or Exodus (.e, .ex2, .exo, .g).");
  commandLine.Add("--array", &arguments.Array,
    "The array, of points or cells; that of cells is averaged to points. Default: the active "
    "scalars, or else the first array.");
  commandLine.Add(
    "--isovalue", &arguments.Isovalues, "One or more isovalues, separated by spaces.");
  commandLine.Add("--methods", &arguments.Methods, methods.c_str());
  commandLine.Add("--repeats", &arguments.Repeats,
    "The number of measurements of each time, 1 to 1000; the median is reported. Default: 3.");
  commandLine.Add("--thorough", &arguments.Thorough,
    "Measure all methods. With --report, also resample a volume to up to nine sizes, and find for "
    "how many pictures of one isovalue ray tracing takes less time than triangles. Takes minutes "
    "instead of seconds.");
  commandLine.Add("--json", &arguments.Json, "Write the table to this file, as JSON.");
  commandLine.Add("--csv", &arguments.Csv, "Write the table to this file, as CSV.");
  commandLine.Add("--report", &arguments.Report,
    "Write report.html to this folder: tables, plots and pictures in one file.");
  commandLine.Add("--max-memory", &arguments.MaxMemory, Programs::MaxMemoryHelp);
  if (!commandLine.Parse())
  {
    std::printf("Compares ray traced and extracted isosurfaces: time, memory, accuracy. Usage:\n\n"
                "  vtkIsosurfaceCompare --input FILE --isovalue VALUE... [options]\n\n"
                "Times of pictures, and the plots of a report, need a display; xvfb-run provides "
                "one.\n%s",
      commandLine.GetHelp().c_str());
    arguments.Help = true;
    return arguments;
  }
  if (arguments.Input.empty() || arguments.Isovalues.empty())
  {
    throw std::runtime_error("--input and --isovalue are needed; see --help");
  }
  if (arguments.Repeats < 1 || arguments.Repeats > 1000)
  {
    throw std::runtime_error(
      "--repeats takes a number from 1 to 1000, not " + std::to_string(arguments.Repeats));
  }
  return arguments;
}

//------------------------------------------------------------------------------
/// Makes the folder of the report and completes its name, and tells before long measurements what
/// cannot be written.
std::unique_ptr<Programs::OutputFolder> PrepareOutputs(Arguments& arguments)
{
  std::unique_ptr<Programs::OutputFolder> folder;
  if (!arguments.Report.empty())
  {
    folder = std::make_unique<Programs::OutputFolder>(arguments.Report);
    arguments.Report += "/report.html";
  }
  std::vector<std::string> fileNames;
  for (const std::string& fileName : { arguments.Csv, arguments.Json, arguments.Report })
  {
    if (!fileName.empty())
    {
      Programs::CheckIsNoInput(fileName, arguments.Input);
      Programs::CheckOutput(fileName);
      fileNames.push_back(fileName);
    }
  }
  Programs::CheckOutputsDiffer(fileNames);
  return folder;
}

//------------------------------------------------------------------------------
void ChooseMethods(const Arguments& arguments, bool isImage, Filter* filter)
{
  const std::vector<std::string>& names = arguments.Methods;
  for (const MethodSwitch& method : Methods)
  {
    (filter->*method.Set)(names.empty()
        ? arguments.Thorough || method.IsEssential
        : std::find(names.begin(), names.end(), method.Name) != names.end());
  }
  for (const std::string& name : names)
  {
    const MethodSwitch* found = std::find_if(std::begin(Methods), std::end(Methods),
      [&name](const MethodSwitch& method) { return name == method.Name; });
    if (found == std::end(Methods))
    {
      throw std::runtime_error("there is no method " + name + "; see --help");
    }
    if (found->Data == (isImage ? Kind::Meshes : Kind::Images))
    {
      throw std::runtime_error("--methods: " + name + " is not for " +
        (isImage ? "images" : "meshes") + ", and " + arguments.Input + " is one; see --help");
    }
  }
}

//------------------------------------------------------------------------------
std::string DescribeMachine()
{
  vtksys::SystemInformation system;
  system.RunCPUCheck();
  std::ostringstream load;
  load << std::setprecision(2) << system.GetLoadAverage();
  return std::string(system.GetModelName()) + ", " +
    std::to_string(std::thread::hardware_concurrency()) + " threads, VTK " +
    vtkVersion::GetVTKVersion() + " with " + vtkSMPTools::GetBackend() + ", load average " +
    load.str() + " at the start";
}

//------------------------------------------------------------------------------
/// The percentage of all that is to be measured: of the methods, and then of other sizes.
class ProgressDisplay
{
public:
  /// The part of the time that the methods take, about.
  explicit ProgressDisplay(double partOfMethods)
    : PartOfMethods(partOfMethods)
  {
  }
  ~ProgressDisplay() { std::fprintf(stderr, "\n"); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void ShowMethods(double part) { Show(part * this->PartOfMethods); }
  void ShowSizes(double part) { Show(this->PartOfMethods + part * (1.0 - this->PartOfMethods)); }

  static void OnProgress(vtkObject*, unsigned long, void* self, void* progress)
  {
    static_cast<ProgressDisplay*>(self)->ShowMethods(*static_cast<double*>(progress));
  }

private:
  static void Show(double part) { std::fprintf(stderr, "\r%3.0f %%", 100.0 * part); }

  double PartOfMethods;
};

//------------------------------------------------------------------------------
/// Two methods of each size, without accuracy, which takes about as long as the rest.
double FindPartOfMethods(vtkImageData* image)
{
  const double ofMethods =
    2.0 * static_cast<double>(std::size(Methods)) * static_cast<double>(image->GetNumberOfPoints());
  return ofMethods / (ofMethods + 2.0 * CountCrossoverSamples(image));
}

//------------------------------------------------------------------------------
Comparison Run(const Arguments& arguments, const std::string& command)
{
  Comparison comparison;
  comparison.Command = command;
  comparison.Input = vtksys::SystemTools::GetFilenameName(arguments.Input);
  comparison.Machine = DescribeMachine();
  comparison.Repeats = arguments.Repeats;
  comparison.Data = ReadData(arguments.Input, arguments.Array, arguments.MaxMemory);
  comparison.Camera = vtkSmartPointer<vtkCamera>::New();
  Filter::LookAt(comparison.Data, comparison.Camera);

  auto* image = vtkImageData::SafeDownCast(comparison.Data);
  vtkNew<Filter> filter;
  ChooseMethods(arguments, image != nullptr, filter);
  filter->SetInputData(comparison.Data);
  filter->SetCamera(comparison.Camera);
  filter->SetNumberOfRepeats(arguments.Repeats);
  for (std::size_t i = 0; i < arguments.Isovalues.size(); ++i)
  {
    filter->SetValue(static_cast<int>(i), arguments.Isovalues[i]);
  }
  const bool hasSizes =
    arguments.Thorough && !arguments.Report.empty() && image && Filter::WhyNoPictures().empty();
  ProgressDisplay display(hasSizes ? FindPartOfMethods(image) : 1.0);
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(ProgressDisplay::OnProgress);
  progress->SetClientData(&display);
  filter->AddObserver(vtkCommand::ProgressEvent, progress);
  bool hasFailed = false;
  vtkNew<vtkCallbackCommand> failure;
  failure->SetCallback(
    [](vtkObject*, unsigned long, void* failed, void*) { *static_cast<bool*>(failed) = true; });
  failure->SetClientData(&hasFailed);
  filter->AddObserver(vtkCommand::ErrorEvent, failure);
  filter->Update();
  comparison.Table = filter->GetOutput();
  if (hasFailed)
  {
    throw std::runtime_error(
      arguments.Input + ": " + comparison.Table->GetValueByName(0, "Note").ToString());
  }
  comparison.Mesh = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1));
  comparison.Difference = vtkImageData::SafeDownCast(filter->GetOutputDataObject(2));

  const bool hasPictures = comparison.Difference->GetNumberOfPoints() > 0 &&
    comparison.Table->GetValueByName(0, "CoveredPixels").ToDouble() > 0.0;
  if (hasSizes && hasPictures)
  {
    comparison.Crossovers = MeasureCrossover(image, arguments.Isovalues.front(), arguments.Repeats,
      comparison.Camera, [&display](double part) { display.ShowSizes(part); });
  }
  display.ShowSizes(1.0);
  return comparison;
}

//------------------------------------------------------------------------------
/// The most important columns.
void Print(vtkTable* table)
{
  std::printf("%-28s %10s %11s %11s %11s %11s %11s\n", "method", "isovalue", "extract, s",
    "picture, s", "triangles", "99 %, cells", "diff pixels");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto get = [table, row](const char* column)
    { return table->GetValueByName(row, column).ToDouble(); };
    std::printf("%-28s %10g %11.3g %11.3g %11.0f %11.2g %11.0f  %s\n",
      table->GetValueByName(row, "Method").ToString().c_str(), get("Isovalue"),
      get("ExtractionTime"), get("NewIsovaluePictureTime"), get("Triangles"),
      get("P99DistanceInCells"), get("DifferentPixels"),
      table->GetValueByName(row, "Note").ToString().c_str());
  }
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Programs::LetThreadsRest(argv);
  std::string command = "vtkIsosurfaceCompare";
  for (int i = 1; i < argc; ++i)
  {
    command += std::string(" ") + argv[i];
  }
  try
  {
    Arguments arguments = ParseArguments(argc, argv);
    if (arguments.Help)
    {
      Programs::FlushStandardOutput();
      return EXIT_SUCCESS;
    }
    const std::unique_ptr<Programs::OutputFolder> folder = PrepareOutputs(arguments);
    const Comparison comparison = Run(arguments, command);
    Print(comparison.Table);
    if (!arguments.Csv.empty())
    {
      WriteCsv(comparison, arguments.Csv);
    }
    if (!arguments.Json.empty())
    {
      WriteJson(comparison, arguments.Json);
    }
    if (!arguments.Report.empty())
    {
      WriteReport(comparison, arguments.Report);
      std::printf("%s\n", arguments.Report.c_str());
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
