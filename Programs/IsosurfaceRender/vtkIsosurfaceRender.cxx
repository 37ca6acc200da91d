// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A picture of a volume, by one process or by many: see --help.

#include "Slab.h"
#include "Support/ArrayChoice.h"
#include "Support/CommandLine.h"
#include "Support/InputFiles.h"
#include "Support/OutputFile.h"
#include "Support/ReadVolume.h"
#include "Support/ThreadsAtRest.h"
#include "vtkIsosurfacePicture.h"
#include "vtkIsosurfaceRayTraceCompositor.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkCamera.h>
#include <vtkColorSeries.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMPIController.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkTimerLog.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

//------------------------------------------------------------------------------
struct Arguments
{
  std::string Input;
  std::string Output;
  std::string Array;
  std::vector<double> Isovalues;
  std::vector<double> Opacities;
  int Width = 1024;
  int Height = 1024;
  double Azimuth = 30.0;
  double Elevation = 20.0;
  double MaxMemory = Programs::GetDefaultMaxMemory();
  std::string Cache;
  bool Help = false;
};

//------------------------------------------------------------------------------
/// Throws std::runtime_error if they are invalid.
void Check(const Arguments& arguments)
{
  if (arguments.Input.empty() || arguments.Isovalues.empty() || arguments.Output.empty())
  {
    throw std::runtime_error("--input, --isovalue and --output are needed; see --help");
  }
  const std::string suffix = vtksys::SystemTools::GetFilenameLastExtension(arguments.Output);
  if (vtksys::SystemTools::LowerCase(suffix) != ".png" && !Programs::IsDevice(arguments.Output))
  {
    throw std::runtime_error("--output " + arguments.Output + ": the name must end in .png");
  }
  if (arguments.Width < 1 || arguments.Height < 1 || arguments.Width > 65536 ||
    arguments.Height > 65536)
  {
    throw std::runtime_error("--width and --height take numbers from 1 to 65536");
  }
  if (!std::isfinite(arguments.Azimuth))
  {
    throw std::runtime_error("--azimuth takes a finite number of degrees");
  }
  if (!(std::abs(arguments.Elevation) < 90.0))
  {
    throw std::runtime_error("--elevation takes a number between -90 and 90");
  }
  const auto isOpacity = [](double value) { return value >= 0.0 && value <= 1.0; };
  if ((!arguments.Opacities.empty() && arguments.Opacities.size() != arguments.Isovalues.size()) ||
    !std::all_of(arguments.Opacities.begin(), arguments.Opacities.end(), isOpacity))
  {
    throw std::runtime_error("--opacity takes a number from 0 to 1 for each isovalue");
  }
}

//------------------------------------------------------------------------------
/// Throws std::runtime_error if they are invalid.
Arguments ParseArguments(int argc, char* argv[], std::string& help)
{
  Arguments arguments;
  Programs::CommandLine commandLine(argc, argv);
  commandLine.Add("--input", &arguments.Input,
    "A volume: .vti, .nii, .mhd or any other image that VTK reads, or a folder of DICOM slices.");
  commandLine.Add("--array", &arguments.Array,
    "The array of points or cells whose isosurfaces are shown, of vectors those of their "
    "magnitude. Default: the active scalars, or else the first array.");
  commandLine.Add(
    "--isovalue", &arguments.Isovalues, "One or more isovalues, separated by spaces.");
  commandLine.Add("--opacity", &arguments.Opacities,
    "An opacity from 0 to 1 for each isovalue, in their order. Default: 1.");
  commandLine.Add("--output", &arguments.Output, "The picture, a PNG file.");
  commandLine.Add("--width", &arguments.Width,
    "The width of the picture in pixels, from 1 to 65536. Default: 1024.");
  commandLine.Add("--height", &arguments.Height,
    "The height of the picture in pixels, from 1 to 65536. Default: 1024.");
  commandLine.Add("--azimuth", &arguments.Azimuth,
    "By how many degrees the camera turns around the volume, from the front (y). Default: 30.");
  commandLine.Add("--elevation", &arguments.Elevation,
    "By how many degrees the camera looks down at it, between -90 and 90. Default: 20.");
  const std::string maxMemoryHelp =
    std::string(Programs::MaxMemoryHelp) + " Raw samples stay in their file and take none.";
  commandLine.Add("--max-memory", &arguments.MaxMemory, maxMemoryHelp.c_str());
  commandLine.Add("--cache", &arguments.Cache,
    "A directory for macrocells of raw samples, with which the file is drawn at once the next "
    "time. "
    "It is made if there is none. Default: none.");
  arguments.Help = !commandLine.Parse();
  help = commandLine.GetHelp();
  if (arguments.Help)
  {
    return arguments;
  }
  Check(arguments);
  arguments.Opacities.resize(arguments.Isovalues.size(), 1.0);
  return arguments;
}

//------------------------------------------------------------------------------
/// The part of a volume that a process has; null if it has none.
struct Piece
{
  vtkSmartPointer<vtkImageData> Image;
  Programs::ArrayChoice Array;
  bool HasVectors;
  Render::Extent Whole;
};

//------------------------------------------------------------------------------
Piece ReadSlab(const Arguments& arguments, vtkMultiProcessController* controller)
{
  // For the normals at the border, of scalars of cells, too.
  constexpr int ghosts = 2;
  Render::Extent whole{};
  Render::Slab slab{};
  const auto choose = [&](const Render::Extent& all)
  {
    whole = all;
    slab =
      Render::FindSlab(whole, controller->GetLocalProcessId(), controller->GetNumberOfProcesses());
    return Render::FindExtent(whole, slab, ghosts);
  };
  const vtkSmartPointer<vtkImageData> image =
    Programs::ReadPiece(arguments.Input, arguments.Array, arguments.MaxMemory, choose);
  const Programs::ArrayChoice array =
    Programs::ChooseArray(image, arguments.Array, arguments.Input);
  if (whole[4] == whole[5])
  {
    throw std::runtime_error(
      arguments.Input + " has a single layer of samples. An isosurface needs two.");
  }
  if (!slab.IsEmpty() && controller->GetNumberOfProcesses() > 1)
  {
    Render::MarkGhosts(slab, image);
  }
  // All processes draw alike, those without data, too.
  const bool hasVectors = array.FindIn(image)->GetNumberOfComponents() > 1;
  return { slab.IsEmpty() ? nullptr : image, array, hasVectors, whole };
}

//------------------------------------------------------------------------------
void SetProperty(const Arguments& arguments, vtkVolumeProperty* property)
{
  vtkNew<vtkColorSeries> series;
  series->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_PASTEL2);
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  vtkPiecewiseFunction* opacities = property->GetScalarOpacity();
  colors->RemoveAllPoints();
  opacities->RemoveAllPoints();
  for (std::size_t i = 0; i < arguments.Isovalues.size(); ++i)
  {
    const double isovalue = arguments.Isovalues[i];
    const vtkColor3ub color = series->GetColorRepeating(static_cast<int>(i));
    property->GetIsoSurfaceValues()->SetValue(static_cast<int>(i), isovalue);
    colors->AddRGBPoint(
      isovalue, color.GetRed() / 255.0, color.GetGreen() / 255.0, color.GetBlue() / 255.0);
    opacities->AddPoint(isovalue, arguments.Opacities[i]);
  }
  property->ShadeOn();
}

//------------------------------------------------------------------------------
/// Shows all of a volume, whose whole extent may be larger than what is there of it.
void LookAt(const Piece& piece, const Arguments& arguments, vtkCamera* camera)
{
  const auto corner = [&piece](int i, int k, int l)
  {
    std::array<double, 3> point;
    piece.Image->TransformIndexToPhysicalPoint(i, k, l, point.data());
    return point;
  };
  const Render::Extent& whole = piece.Whole;
  const std::array<double, 3> first = corner(whole[0], whole[2], whole[4]);
  const std::array<double, 3> last = corner(whole[1], whole[3], whole[5]);
  std::array<double, 3> center;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (first[axis] + last[axis]);
  }
  const double radius = 0.5 * std::sqrt(vtkMath::Distance2BetweenPoints(first.data(), last.data()));
  const double distance =
    radius / std::sin(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle()));
  camera->SetFocalPoint(center.data());
  camera->SetPosition(center[0], center[1] + distance, center[2]);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->Azimuth(arguments.Azimuth);
  camera->Elevation(arguments.Elevation);
  camera->SetClippingRange(distance - radius, distance + radius);
}

//------------------------------------------------------------------------------
void Write(vtkImageData* picture, const std::string& fileName)
{
  const double white[3] = { 1.0, 1.0, 1.0 };
  vtkNew<vtkImageData> flat;
  vtkIsosurfacePicture::FlattenColors(picture, white, flat);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(flat);
  writer->WriteToMemoryOn();
  writer->Write();
  Programs::OutputFile file(fileName);
  file.Write(writer->GetResult()->GetPointer(0),
    static_cast<std::size_t>(writer->GetResult()->GetNumberOfValues()));
  file.Finish();
}

//------------------------------------------------------------------------------
/// Whether all processes are. To be called by all.
bool AreAllFine(bool isFine, vtkMultiProcessController* controller)
{
  const int own = isFine ? 1 : 0;
  int all = 0;
  controller->AllReduce(&own, &all, 1, vtkCommunicator::MIN_OP);
  return all != 0;
}

//------------------------------------------------------------------------------
void PrintTimes(double readTime, vtkIsosurfaceRayTraceCompositor* compositor,
  vtkMultiProcessController* controller)
{
  const double own[4] = { readTime, compositor->GetRenderTime(), compositor->GetCompositeTime(),
    static_cast<double>(compositor->GetBytesSent()) };
  std::vector<double> all(4 * static_cast<std::size_t>(controller->GetNumberOfProcesses()));
  controller->AllGather(own, all.data(), 4);
  if (controller->GetLocalProcessId() > 0)
  {
    return;
  }
  std::printf("process   read, s  render, s  composite, s  sent, MB\n");
  for (std::size_t i = 0; 4 * i < all.size(); ++i)
  {
    const double* times = &all[4 * i];
    std::printf(
      "%7zu %9.3f %10.4f %13.4f %9.3f\n", i, times[0], times[1], times[2], 1e-6 * times[3]);
  }
}

//------------------------------------------------------------------------------
/// Whether no pixel of the picture of process 0 shows anything. To be called by all.
bool IsEmpty(vtkImageData* picture, vtkMultiProcessController* controller)
{
  int isEmpty = 1;
  if (controller->GetLocalProcessId() == 0)
  {
    auto* colors = vtkUnsignedCharArray::SafeDownCast(picture->GetPointData()->GetScalars());
    double opacities[2];
    colors->GetRange(opacities, 3);
    isEmpty = opacities[1] > 0.0 ? 0 : 1;
  }
  controller->Broadcast(&isEmpty, 1, 0);
  return isEmpty != 0;
}

//------------------------------------------------------------------------------
/// Why there may be no surface, given the range of the scalars.
std::string FindRemedy(const Arguments& arguments, double lowest, double highest)
{
  // Of opacities that are larger.
  const auto hasIsovalue = [&](double opacity)
  {
    bool has = false;
    for (std::size_t i = 0; i < arguments.Isovalues.size(); ++i)
    {
      has = has ||
        (lowest < arguments.Isovalues[i] && arguments.Isovalues[i] <= highest &&
          arguments.Opacities[i] > opacity);
    }
    return has;
  };
  std::ostringstream remedy;
  if (lowest > highest)
  {
    remedy << "No sample of the volume is a number (all are NaN).";
  }
  else if (!hasIsovalue(-1.0))
  {
    remedy << "The scalars of the volume are from " << lowest << " to " << highest
           << ": give isovalues between them.";
  }
  else if (!hasIsovalue(0.0))
  {
    remedy << "Surfaces whose --opacity is 0 cannot be seen.";
  }
  else
  {
    remedy << "No ray meets a surface: try a larger picture.";
  }
  return remedy.str();
}

//------------------------------------------------------------------------------
/// Says why there may be no surface. To be called by all.
void WarnOfNothing(
  const Arguments& arguments, const Piece& piece, vtkMultiProcessController* controller)
{
  double own[2] = { std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  if (piece.Image)
  {
    piece.Array.FindIn(piece.Image)->GetRange(own, piece.HasVectors ? -1 : 0);
  }
  double lowest = 0.0;
  double highest = 0.0;
  controller->AllReduce(&own[0], &lowest, 1, vtkCommunicator::MIN_OP);
  controller->AllReduce(&own[1], &highest, 1, vtkCommunicator::MAX_OP);
  if (controller->GetLocalProcessId() == 0)
  {
    std::fprintf(stderr, "warning: the picture is empty. %s\n",
      FindRemedy(arguments, lowest, highest).c_str());
  }
}

//------------------------------------------------------------------------------
/// Calls a function that may throw. Returns whether it did not; if it did, says why.
template <typename Function>
bool Try(vtkMultiProcessController* controller, const Function& function)
{
  try
  {
    function();
    return true;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "error: process %d: %s\n", controller->GetLocalProcessId(), error.what());
    return false;
  }
}

//------------------------------------------------------------------------------
/// To be called by all processes. None leaves before all do, so that none waits for it.
bool Run(const Arguments& arguments, vtkMultiProcessController* controller)
{
  const bool isFirst = controller->GetLocalProcessId() == 0;
  const double start = vtkTimerLog::GetUniversalTime();
  std::optional<Piece> piece;
  const bool isRead = Try(controller,
    [&]
    {
      if (isFirst)
      {
        Programs::CheckIsNoInput(arguments.Output, arguments.Input);
        Programs::CheckOutput(arguments.Output);
      }
      piece = ReadSlab(arguments, controller);
    });
  const double readTime = vtkTimerLog::GetUniversalTime() - start;
  if (!AreAllFine(isRead, controller))
  {
    return false;
  }
  vtkNew<vtkIsosurfaceRayTraceMapper> mapper;
  mapper->SetInputData(piece->Image);
  piece->Array.SelectFor(mapper);
  if (piece->HasVectors)
  {
    mapper->SetVectorModeToMagnitude();
  }
  mapper->SetCacheDirectory(arguments.Cache.c_str());
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  SetProperty(arguments, volume->GetProperty());
  vtkNew<vtkCamera> camera;
  if (isFirst)
  {
    LookAt(*piece, arguments, camera);
  }
  vtkNew<vtkIsosurfaceRayTraceCompositor> compositor;
  compositor->SetController(controller);
  compositor->BroadcastCamera(camera);
  vtkNew<vtkImageData> picture;
  if (!compositor->RenderToImage(
        volume, camera, nullptr, arguments.Width, arguments.Height, picture))
  {
    return false;
  }
  if (IsEmpty(picture, controller))
  {
    WarnOfNothing(arguments, *piece, controller);
  }
  PrintTimes(readTime, compositor, controller);
  return AreAllFine(
    !isFirst || Try(controller, [&] { Write(picture, arguments.Output); }), controller);
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Programs::LetThreadsRest(argv);
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  const bool isFirst = controller->GetLocalProcessId() == 0;
  bool isDone = false;
  try
  {
    std::string help;
    const Arguments arguments = ParseArguments(argc, argv, help);
    if (arguments.Help && isFirst)
    {
      std::printf("Makes a picture of isosurfaces. By many processes, each of which reads its own "
                  "slab of the volume:\n\n"
                  "  mpirun -n 4 vtkIsosurfaceRender --input FILE --isovalue VALUE... --output "
                  "PICTURE.png\n\nor by one, without mpirun.\n%s",
        help.c_str());
    }
    isDone = arguments.Help || Run(arguments, controller);
    Programs::FlushStandardOutput();
  }
  catch (const std::exception& error)
  {
    // All processes have the same arguments.
    if (isFirst)
    {
      std::fprintf(stderr, "error: %s\n", error.what());
    }
  }
  controller->Finalize();
  return isDone ? EXIT_SUCCESS : EXIT_FAILURE;
}
