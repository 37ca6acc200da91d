// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast and how exact the clouds of meshes are, beside VTK's other mappers, and what many
// processes would need: see --help. Pictures need a display; xvfb-run gives one.

#include "CloudProcesses.h"
#include "CloudReference.h"
#include "IsosurfaceCompare/ReadData.h"
#include "MeshSource.h"
#include "MeshTracer.h"
#include "OffScreenWindow.h"
#include "Quad.h"
#include "RunProgram.h"
#include "Samples.h"
#include "Schedule.h"
#include "Support/ReadVolume.h"

#include "Picture/CloudMedium.h"

#include <vtkCellProjectionMapper.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkProjectedTetrahedraMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtksys/CommandLineArguments.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace Benchmark;
namespace vtkirt = vtkIsosurfaceRayTracing;

struct Arguments
{
  std::string Input;
  std::string Array;
  double Cells = 200000.0;
  int Size = 512;
  int Repeats = 5;
  int Threads = 2;
  int Step = 16;
  double Opacity = 1.0;
  int Processes = 0;
  bool Help = false;
};

bool ParseArguments(int argc, char* argv[], Arguments& arguments)
{
  using Parser = vtksys::CommandLineArguments;
  Parser parser;
  parser.Initialize(argc, argv);
  parser.AddArgument("--cells", Parser::SPACE_ARGUMENT, &arguments.Cells,
    "About how many tetrahedra the mesh has that is made. Default: 200000.");
  parser.AddArgument("--input", Parser::SPACE_ARGUMENT, &arguments.Input,
    "A file with a mesh instead: .vtu, .vtk, .ex2 and others.");
  parser.AddArgument("--array", Parser::SPACE_ARGUMENT, &arguments.Array,
    "The name of its array. Default: its active scalars.");
  parser.AddArgument("--size", Parser::SPACE_ARGUMENT, &arguments.Size,
    "The edge of the pictures in pixels. Default: 512.");
  parser.AddArgument("--opacity", Parser::SPACE_ARGUMENT, &arguments.Opacity,
    "The largest attenuation through a tenth of the diagonal. Default: 1.");
  parser.AddArgument("--repeats", Parser::SPACE_ARGUMENT, &arguments.Repeats,
    "The number of frames of each mapper, in turn. Default: 5.");
  parser.AddArgument("--threads", Parser::SPACE_ARGUMENT, &arguments.Threads,
    "The number of threads of this mapper. Default: 2.");
  parser.AddArgument("--step", Parser::SPACE_ARGUMENT, &arguments.Step,
    "Colours are compared at every such pixel along both axes. Default: 16.");
  parser.AddArgument("--processes", Parser::SPACE_ARGUMENT, &arguments.Processes,
    "Instead of pictures, up to so many processes are simulated.");
  parser.AddBooleanArgument("--help", &arguments.Help, "Show this text.");
  const bool parsed = parser.Parse() != 0;
  const bool sensible = arguments.Cells >= 5.0 && arguments.Cells <= 1e9 && arguments.Size >= 16 &&
    arguments.Size <= 16384 && arguments.Repeats >= 1 && arguments.Threads >= 1 &&
    arguments.Step >= 1 && arguments.Opacity > 0.0 && arguments.Processes >= 0;
  if (arguments.Help || !parsed || !sensible)
  {
    std::fprintf(arguments.Help ? stdout : stderr,
      "Usage: vtkIsosurfaceCloudBenchmark [--cells N] [options]\n"
      "       vtkIsosurfaceCloudBenchmark --input FILE --array NAME [options]\n%s"
      "Cells: 5 to 1e9. Size: 16 to 16384.\n",
      parser.GetHelp());
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
/// A mesh of tetrahedra, its transfer functions, and where it is seen from.
struct Cloud
{
  explicit Cloud(const Arguments& arguments)
  {
    if (arguments.Input.empty())
    {
      this->Grid =
        MakeMesh(MeshShape::Tetrahedra, GetMeshEdge(MeshShape::Tetrahedra, arguments.Cells), false);
      this->Grid->GetPointData()->SetActiveScalars("gyroid");
    }
    else
    {
      vtkNew<vtkDataSetTriangleFilter> cut;
      cut->SetInputData(
        Compare::ReadMesh(arguments.Input, arguments.Array, Programs::GetDefaultMaxMemory()));
      cut->TetrahedraOnlyOn();
      cut->Update();
      this->Grid = cut->GetOutput();
    }
    this->Property->GetScalarOpacity()->RemoveAllPoints();
    this->Property->GetRGBTransferFunction()->RemoveAllPoints();
    double range[2];
    this->Grid->GetPointData()->GetScalars()->GetRange(range);
    const auto add = [&](double part, double opacity, double red, double green, double blue)
    {
      const double value = range[0] + part * (range[1] - range[0]);
      this->Property->GetScalarOpacity()->AddPoint(value, opacity);
      this->Property->GetRGBTransferFunction()->AddRGBPoint(value, red, green, blue);
      this->Nodes.push_back(
        { value, opacity * 10.0 / this->Grid->GetLength(), { red, green, blue } });
    };
    add(0.0, 0.0, 0.1, 0.2, 0.9);
    add(0.3, 0.15 * arguments.Opacity, 0.1, 0.8, 0.8);
    add(0.6, 0.5 * arguments.Opacity, 0.9, 0.9, 0.2);
    add(1.0, arguments.Opacity, 0.9, 0.1, 0.1);
    this->Property->SetScalarOpacityUnitDistance(0.1 * this->Grid->GetLength());
    Bounds bounds;
    this->Grid->GetBounds(bounds.data());
    this->Eye = MakeOrbit(bounds, 8)[1];
  }

  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  vtkNew<vtkVolumeProperty> Property;
  std::vector<vtkirt::CloudNode> Nodes;
  View Eye;
};

//------------------------------------------------------------------------------
/// A mapper, its frames, and how far their colours are from the exact ones.
struct Method
{
  Method(const char* name, vtkAbstractVolumeMapper* mapper, const Cloud& cloud, int size)
    : Name(name)
    , Window(std::make_unique<OffScreenWindow>(size))
  {
    mapper->SetInputDataObject(cloud.Grid);
    this->Volume->SetMapper(mapper);
    this->Volume->SetProperty(cloud.Property);
    this->Window->Show(this->Volume);
  }

  std::string Name;
  std::unique_ptr<OffScreenWindow> Window;
  vtkNew<vtkVolume> Volume;
  Samples Milliseconds;
};

std::vector<Method> MakeMethods(const Cloud& cloud, const Arguments& arguments)
{
  std::vector<Method> methods;
  vtkNew<vtkCellProjectionMapper> ours;
  ours->AutoAdjustSampleDistancesOff();
  ours->SetNumberOfThreads(arguments.Threads);
  methods.emplace_back("vtkCellProjectionMapper", ours, cloud, arguments.Size);
  const auto addRayCast = [&](const char* name, vtkUnstructuredGridVolumeRayIntegrator* integrator)
  {
    vtkNew<vtkUnstructuredGridVolumeRayCastMapper> rayCast;
    rayCast->AutoAdjustSampleDistancesOff();
    rayCast->SetImageSampleDistance(1.0F);
    rayCast->SetNumberOfThreads(arguments.Threads);
    rayCast->SetRayIntegrator(integrator);
    methods.emplace_back(name, rayCast, cloud, arguments.Size);
  };
  addRayCast("vtkUnstructuredGridVolumeRayCastMapper", nullptr);
  vtkNew<vtkUnstructuredGridLinearRayIntegrator> linear;
  addRayCast("the same, linear integrator", linear);
  vtkNew<vtkProjectedTetrahedraMapper> projected;
  methods.emplace_back("vtkProjectedTetrahedraMapper", projected, cloud, arguments.Size);
  return methods;
}

//------------------------------------------------------------------------------
/// The exact colours of some pixels, before the background of the window.
struct ExactPixel
{
  int X;
  int Y;
  vtkirt::ReferenceLight<vtkirt::Quad> Light;
};

/// Where a point is in a picture of width and height one.
std::array<double, 2> FindPlace(const vtkirt::Camera& view, const std::array<double, 4>& corner)
{
  const vtkirt::Matrix4& clip = view.GetClipFromObject();
  const auto multiply = [&](std::size_t row)
  {
    return clip[row] * corner[0] + clip[row + 1] * corner[1] + clip[row + 2] * corner[2] +
      clip[row + 3];
  };
  return { 0.5 + 0.5 * multiply(0) / multiply(12), 0.5 + 0.5 * multiply(4) / multiply(12) };
}

std::vector<ExactPixel> FindExactPixels(const Cloud& cloud, const vtkirt::Camera& view,
  const std::vector<vtkirt::Tetrahedron>& all, const Arguments& arguments)
{
  // Those that tetrahedra are projected to, about.
  const int columns = arguments.Size / arguments.Step;
  const auto toPixel = [&](double place)
  { return (place * arguments.Size - 0.5 - arguments.Step / 2) / arguments.Step; };
  std::vector<std::vector<vtkirt::Tetrahedron>> near(static_cast<std::size_t>(columns * columns));
  for (const vtkirt::Tetrahedron& tetrahedron : all)
  {
    double low[2] = { HUGE_VAL, HUGE_VAL };
    double high[2] = { -HUGE_VAL, -HUGE_VAL };
    for (const std::array<double, 4>& corner : tetrahedron)
    {
      const std::array<double, 2> place = FindPlace(view, corner);
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        const double pixel = toPixel(place[axis]);
        low[axis] = std::min(low[axis], pixel - 0.01);
        high[axis] = std::max(high[axis], pixel + 0.01);
      }
    }
    for (int y = std::max(0, static_cast<int>(std::ceil(low[1])));
         y <= std::min(columns - 1.0, std::floor(high[1])); ++y)
    {
      for (int x = std::max(0, static_cast<int>(std::ceil(low[0])));
           x <= std::min(columns - 1.0, std::floor(high[0])); ++x)
      {
        near[static_cast<std::size_t>(y * columns + x)].push_back(tetrahedron);
      }
    }
  }
  std::vector<ExactPixel> pixels(near.size());
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < columns * columns; ++i)
  {
    const auto number = static_cast<std::size_t>(i);
    const int x = i % columns * arguments.Step + arguments.Step / 2;
    const int y = i / columns * arguments.Step + arguments.Step / 2;
    pixels[number] = { x, y,
      vtkirt::FindLight<vtkirt::Quad>(near[number], view, cloud.Nodes, x, y) };
  }
  return pixels;
}

/// The differences of the colours of pixels: the largest, and the mean of their magnitudes.
struct ColorError
{
  double Largest = 0.0;
  double Sum = 0.0;
  int Count = 0;

  void Add(double error)
  {
    this->Largest = std::max(this->Largest, error);
    this->Sum += error;
    ++this->Count;
  }
};

ColorError FindError(
  const std::vector<ExactPixel>& pixels, OffScreenWindow& window, const View& eye, int size)
{
  window.Draw(eye);
  const std::vector<unsigned char> colors = window.GetColors();
  ColorError error;
  for (const ExactPixel& pixel : pixels)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double background = k == 2 ? 1.0 : 0.0;
      const double exact = static_cast<double>(pixel.Light.Color[k]) +
        background * static_cast<double>(pixel.Light.Transmittance);
      const std::size_t place = static_cast<std::size_t>(3 * (pixel.Y * size + pixel.X) + k);
      error.Add(std::abs(colors[place] / 255.0 - std::min(exact, 1.0)));
    }
  }
  return error;
}

//------------------------------------------------------------------------------
/// The largest error of the light of rays before it is rounded to 8 bits.
double FindUnroundedError(const std::vector<ExactPixel>& pixels, const vtkirt::Scene& scene)
{
  double worst = 0.0;
  CloudTiles tiles(scene);
  for (const ExactPixel& pixel : pixels)
  {
    worst = std::max(worst, vtkirt::FindError(tiles.GetLight(pixel.X, pixel.Y), pixel.Light));
  }
  return worst;
}

//------------------------------------------------------------------------------
void ComparePictures(const Cloud& cloud, const Arguments& arguments)
{
  MeshTracer tracer(cloud.Grid, cloud.Grid->GetPointData()->GetScalars(), arguments.Threads);
  const vtkirt::CloudMedium medium(cloud.Nodes);
  const vtkirt::Scene scene = tracer.MakeCloudScene(
    cloud.Eye, PictureRays(cloud.Eye, arguments.Size), arguments.Size, medium);
  const CloudTimes times = MeasureCloud(scene);
  std::printf("%lld tetrahedra, %d x %d pixels, %lld segments, %.1f ns of one thread a segment "
              "(finding alone %.1f), %.1f bytes a cell\n\n",
    static_cast<long long>(cloud.Grid->GetNumberOfCells()), arguments.Size, arguments.Size,
    static_cast<long long>(times.Segments),
    1e9 * times.Render / static_cast<double>(times.Segments),
    1e9 * times.Find / static_cast<double>(times.Segments),
    tracer.GetMemory() / static_cast<double>(cloud.Grid->GetNumberOfCells()));
  if (!OffScreenWindow::IsPossible())
  {
    std::printf("There is no display: no pictures.\n");
    return;
  }
  std::vector<Method> methods = MakeMethods(cloud, arguments);
  for (Method& method : methods)
  {
    method.Window->Draw(cloud.Eye); // What is done once is not measured.
  }
  for (int repeat = 0; repeat < arguments.Repeats; ++repeat)
  {
    for (Method& method : methods)
    {
      method.Milliseconds.Add(1e3 * method.Window->Draw(cloud.Eye));
    }
  }
  const std::vector<ExactPixel> pixels =
    FindExactPixels(cloud, scene.Fields.front().View, tracer.Subdivide(), arguments);
  std::printf("| mapper | frame, ms | times ours | largest error of a colour | mean error |\n"
              "|---|---|---|---|---|\n");
  for (Method& method : methods)
  {
    const ColorError error = FindError(pixels, *method.Window, cloud.Eye, arguments.Size);
    std::printf("| %s | %.0f | %.2f | %.4f | %.5f |\n", method.Name.c_str(),
      method.Milliseconds.GetMedian(),
      method.Milliseconds.GetMedian() / methods.front().Milliseconds.GetMedian(), error.Largest,
      error.Sum / error.Count);
  }
  std::printf("\nBefore colours are rounded to 8 bits (which is 0.0020 at most), the error of this "
              "mapper is %.1e at most, in %zu pixels.\n",
    FindUnroundedError(pixels, scene), pixels.size());
}

//------------------------------------------------------------------------------
void Run(const Arguments& arguments)
{
  const Cloud cloud(arguments);
  if (arguments.Processes > 0)
  {
    SimulateProcesses(cloud.Grid, cloud.Nodes, cloud.Eye, arguments.Size, arguments.Processes);
    return;
  }
  ComparePictures(cloud, arguments);
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
