// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast the isosurfaces of meshes are, beside triangles: see --help. Pictures need a display;
// xvfb-run gives one.

#include "Environment.h"
#include "IsosurfaceCompare/ReadData.h"
#include "MeshCase.h"
#include "MeshPictures.h"
#include "MeshSource.h"
#include "MeshTraces.h"
#include "OffScreenWindow.h"
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
using vtksys::SystemTools;

struct Arguments
{
  std::string Input;
  std::string Array;
  std::vector<double> Isovalues;
  std::string Cells = "100000,1300000";
  std::string Shapes = "tetrahedra";
  std::string Fields = "ball,gyroid";
  bool Shuffled = false;
  int Size = 512;
  int Views = 8;
  int Repeats = 5;
  std::string Threads;
  std::string Json = "meshes.json";
  double MaxMemory = Programs::GetDefaultMaxMemory();
  bool Help = false;
};

//------------------------------------------------------------------------------
bool ParseArguments(int argc, char* argv[], Arguments& arguments)
{
  using Parser = vtksys::CommandLineArguments;
  Parser parser;
  parser.Initialize(argc, argv);
  parser.AddArgument("--cells", Parser::SPACE_ARGUMENT, &arguments.Cells,
    "About how many cells the meshes have that are made. Default: 100000,1300000.");
  parser.AddArgument("--shapes", Parser::SPACE_ARGUMENT, &arguments.Shapes,
    "Some of tetrahedra,hexahedra. Default: tetrahedra.");
  parser.AddArgument(
    "--fields", Parser::SPACE_ARGUMENT, &arguments.Fields, "Some of ball,gyroid. Default: both.");
  parser.AddBooleanArgument(
    "--shuffled", &arguments.Shuffled, "Put the cells and points that are made in random order.");
  parser.AddArgument("--input", Parser::SPACE_ARGUMENT, &arguments.Input,
    "A file with a mesh instead: .vtu, .vtk, .ex2 and others.");
  parser.AddArgument("--array", Parser::SPACE_ARGUMENT, &arguments.Array,
    "The name of its array. Default: its active scalars.");
  parser.AddArgument("--isovalue", Parser::SPACE_ARGUMENT, &arguments.Isovalues,
    "An isovalue of the array; the option may be repeated.");
  parser.AddArgument("--size", Parser::SPACE_ARGUMENT, &arguments.Size,
    "The edge of the pictures in pixels. Default: 512.");
  parser.AddArgument(
    "--views", Parser::SPACE_ARGUMENT, &arguments.Views, "The number of views. Default: 8.");
  parser.AddArgument("--repeats", Parser::SPACE_ARGUMENT, &arguments.Repeats,
    "The number of measurements of each time, fewer of slow ones. Default: 5.");
  parser.AddArgument("--threads", Parser::SPACE_ARGUMENT, &arguments.Threads,
    "Numbers of threads, such as 1,2. Default: 1 and all that the machine has.");
  parser.AddArgument("--json", Parser::SPACE_ARGUMENT, &arguments.Json,
    "The file for the results. Default: meshes.json.");
  parser.AddArgument(
    "--max-memory", Parser::SPACE_ARGUMENT, &arguments.MaxMemory, Programs::MaxMemoryHelp);
  parser.AddBooleanArgument("--help", &arguments.Help, "Show this text.");
  const bool parsed = parser.Parse() != 0;
  const bool complete = arguments.Input.empty() == arguments.Isovalues.empty();
  const bool sensible = arguments.Size >= 16 && arguments.Size <= 16384 && arguments.Views >= 1 &&
    arguments.Repeats >= 1;
  if (arguments.Help || !parsed || !complete || !sensible)
  {
    std::fprintf(arguments.Help ? stdout : stderr,
      "Usage: vtkIsosurfaceMeshBenchmark [--cells N,...] [options]\n"
      "       vtkIsosurfaceMeshBenchmark --input FILE --array NAME --isovalue V [options]\n%s"
      "Size: 16 to 16384.\n",
      parser.GetHelp());
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
std::vector<double> ParseCells(const std::string& text)
{
  std::vector<double> numbers;
  for (const std::string& word : SystemTools::SplitString(text, ','))
  {
    numbers.push_back(std::atof(word.c_str()));
    if (!(numbers.back() >= 1.0 && numbers.back() <= 1e9))
    {
      throw std::runtime_error("--cells " + text + ": give numbers from 1 to 1e9, such as 1e5,1e6");
    }
  }
  return numbers;
}

//------------------------------------------------------------------------------
/// The words of a text, each of which must be known.
std::vector<std::string> ParseNames(
  const std::string& option, const std::string& text, const std::vector<std::string>& known)
{
  const std::vector<std::string> names = SystemTools::SplitString(text, ',');
  for (const std::string& name : names)
  {
    if (std::find(known.begin(), known.end(), name) == known.end())
    {
      throw std::runtime_error(option + " " + text + ": there is no \"" + name + "\"; there are " +
        known[0] + ", " + known[1]);
    }
  }
  return names;
}

//------------------------------------------------------------------------------
using OnCase = std::function<void(const MeshCase&)>;

void MakeCases(const Arguments& arguments, const OnCase& onCase)
{
  const std::vector<double> cells = ParseCells(arguments.Cells);
  const auto fields = ParseNames("--fields", arguments.Fields, GetMeshFields());
  for (const std::string& name :
    ParseNames("--shapes", arguments.Shapes, { "tetrahedra", "hexahedra" }))
  {
    const MeshShape shape = name == "hexahedra" ? MeshShape::Hexahedra : MeshShape::Tetrahedra;
    for (const double count : cells)
    {
      const int edge = GetMeshEdge(shape, count);
      Log("making " + name);
      MeshCase mesh;
      mesh.Unstructured = MakeMesh(shape, edge, arguments.Shuffled);
      mesh.Grid = mesh.Unstructured;
      mesh.Isovalue = 0.0;
      if (shape == MeshShape::Hexahedra)
      {
        mesh.Split = MakeMesh(MeshShape::Tetrahedra, edge, arguments.Shuffled);
      }
      for (const std::string& field : fields)
      {
        mesh.Name = ToText(mesh.GetNumberOfCells()) + " " + name + ", " + field;
        mesh.Grid->GetPointData()->SetActiveScalars(field.c_str());
        if (mesh.Split)
        {
          mesh.Split->GetPointData()->SetActiveScalars(field.c_str());
        }
        onCase(mesh);
      }
    }
  }
}

//------------------------------------------------------------------------------
void ReadCases(const Arguments& arguments, const OnCase& onCase)
{
  MeshCase mesh;
  mesh.Grid = Compare::ReadMesh(arguments.Input, arguments.Array, arguments.MaxMemory);
  mesh.Unstructured = Compare::MakeUnstructured(mesh.Grid);
  double range[2];
  mesh.GetScalars()->GetRange(range);
  for (const double isovalue : arguments.Isovalues)
  {
    if (!(isovalue > range[0] && isovalue <= range[1]))
    {
      throw std::runtime_error("--isovalue " + ToText(isovalue) + ": " + arguments.Input +
        " has values from " + ToText(range[0]) + " to " + ToText(range[1]) +
        ", so there is no surface");
    }
    mesh.Isovalue = isovalue;
    mesh.Name = SystemTools::GetFilenameName(arguments.Input) + ", " +
      mesh.GetScalars()->GetName() + " " + ToText(isovalue);
    onCase(mesh);
  }
}

//------------------------------------------------------------------------------
void Run(const Arguments& arguments, const std::vector<std::string>& command)
{
  const Schedule schedule = { arguments.Size, arguments.Views, ParseThreads(arguments.Threads),
    arguments.Repeats };
  vtkSMPTools::Initialize(schedule.GetMostThreads());
  // A display may close itself when it has no window: this one stays.
  const auto window =
    OffScreenWindow::IsPossible() ? std::make_unique<OffScreenWindow>(16) : nullptr;
  Report report;
  report.Environment = DescribeEnvironment(command, window.get());
  const auto write = [&]() { WriteJson(report.GetJson(), arguments.Json); };
  Programs::CheckIsNoInput(arguments.Json, arguments.Input);
  write(); // What cannot be written is known now.
  const OnCase measure = [&](const MeshCase& mesh)
  {
    if (window)
    {
      MeasureMeshMemory(schedule, mesh, report);
      MeasureMeshPictures(schedule, mesh, report);
    }
    MeasureMeshTraces(schedule, mesh, report);
    MeasureMeshSplit(schedule, mesh, report);
    MeasureMeshHierarchies(schedule, mesh, report);
    write(); // So that hours of work are not lost.
  };
  if (arguments.Input.empty())
  {
    MakeCases(arguments, measure);
  }
  else
  {
    ReadCases(arguments, measure);
  }
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
