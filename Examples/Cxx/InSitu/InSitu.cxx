// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A simulation in many processes that makes pictures of itself while it runs: nothing is written
// but the pictures, and no process ever has all data.
//
//   mpirun -n 4 InSitu <points along an axis> <steps> <steps between pictures> <prefix of pictures>
//
// Two substances react and diffuse (J. E. Pearson: Complex Patterns in a Simple System. Science
// 261, 1993); pictures show where the concentration of the second is 0.2. The pictures are the same
// for any number of processes.

#include "vtkIsosurfacePicture.h"
#include "vtkIsosurfaceRayTraceCompositor.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMPIController.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace
{

/// The layers of points of a cube that a process has, along z: it computes those from First to End,
/// and has copies of layers of others from Low to High. Rendering needs one below and two above:
/// the cells above the last layer are its own, and their normals need one layer more.
struct Layers
{
  int First;
  int End;
  int Low;
  int High;

  Layers(int points, int process, int processes)
    : First(points * process / processes)
    , End(points * (process + 1) / processes)
    , Low(std::max(0, this->First - 1))
    , High(std::min(points, this->End + 2))
  {
  }
};

//------------------------------------------------------------------------------
/// A concentration in the layers of a process.
class Concentration
{
public:
  Concentration(int points, const Layers& layers, double value)
    : Points(points)
    , Own(layers)
    , Values(this->GetOffset(layers.High - layers.Low), value)
  {
  }

  double* GetLayer(int z) { return this->Values.data() + this->GetOffset(z - this->Own.Low); }
  double& At(int x, int y, int z)
  {
    return this->GetLayer(
      z)[x + static_cast<std::size_t>(y) * static_cast<std::size_t>(this->Points)];
  }

  /// The mean of the six neighbours (at a border, of the point itself), less the value.
  double GetLaplacian(int x, int y, int z)
  {
    const int last = this->Points - 1;
    const double sum = this->At(std::max(x - 1, 0), y, z) + this->At(std::min(x + 1, last), y, z) +
      this->At(x, std::max(y - 1, 0), z) + this->At(x, std::min(y + 1, last), z) +
      this->At(x, y, std::max(z - 1, 0)) + this->At(x, y, std::min(z + 1, last));
    return sum / 6.0 - this->At(x, y, z);
  }

  /// Gives neighbours copies of the layers they need, and takes theirs. Processes from the lowest
  /// to the highest, so that no two wait for each other.
  void Exchange(vtkMultiProcessController* controller)
  {
    constexpr int tag = 1;
    const int process = controller->GetLocalProcessId();
    const auto layer = static_cast<vtkIdType>(this->GetOffset(1));
    const Layers& own = this->Own;
    if (process > 0)
    {
      controller->Receive(this->GetLayer(own.Low), layer, process - 1, tag);
      controller->Send(this->GetLayer(own.First), 2 * layer, process - 1, tag);
    }
    if (process + 1 < controller->GetNumberOfProcesses())
    {
      controller->Send(this->GetLayer(own.End - 1), layer, process + 1, tag);
      controller->Receive(this->GetLayer(own.End), 2 * layer, process + 1, tag);
    }
  }

  double* GetValues() { return this->Values.data(); }
  vtkIdType GetNumberOfValues() const { return static_cast<vtkIdType>(this->Values.size()); }

private:
  std::size_t GetOffset(int layers) const
  {
    return static_cast<std::size_t>(layers) * static_cast<std::size_t>(this->Points) *
      static_cast<std::size_t>(this->Points);
  }

  int Points;
  Layers Own;
  std::vector<double> Values;
};

//------------------------------------------------------------------------------
/// The substances U and V, of which V feeds on U.
class Simulation
{
public:
  Simulation(int points, vtkMultiProcessController* controller)
    : Points(points)
    , Controller(controller)
    , Own(points, controller->GetLocalProcessId(), controller->GetNumberOfProcesses())
    , U(points, this->Own, 1.0)
    , V(points, this->Own, 0.0)
    , NextU(this->U)
    , NextV(this->V)
  {
    const auto isSeed = [points](int k) { return std::abs(2 * k - points) < points / 4; };
    for (int z = this->Own.Low; z < this->Own.High; ++z)
    {
      for (int y = 0; y < points; ++y)
      {
        for (int x = 0; x < points; ++x)
        {
          if (isSeed(x) && isSeed(y) && isSeed(z))
          {
            this->U.At(x, y, z) = 0.25;
            this->V.At(x, y, z) = 0.33;
          }
        }
      }
    }
  }

  void TakeStep()
  {
    constexpr double feed = 0.01;
    constexpr double kill = 0.05;
    for (int z = this->Own.First; z < this->Own.End; ++z)
    {
      for (int y = 0; y < this->Points; ++y)
      {
        for (int x = 0; x < this->Points; ++x)
        {
          const double u = this->U.At(x, y, z);
          const double v = this->V.At(x, y, z);
          this->NextU.At(x, y, z) =
            u + 0.2 * this->U.GetLaplacian(x, y, z) - u * v * v + feed * (1.0 - u);
          this->NextV.At(x, y, z) =
            v + 0.1 * this->V.GetLaplacian(x, y, z) + u * v * v - (feed + kill) * v;
        }
      }
    }
    std::swap(this->U, this->NextU);
    std::swap(this->V, this->NextV);
    this->U.Exchange(this->Controller);
    this->V.Exchange(this->Controller);
  }

  const Layers& GetLayers() const { return this->Own; }
  Concentration& GetV() { return this->V; }

private:
  int Points;
  vtkMultiProcessController* Controller;
  Layers Own;
  Concentration U;
  Concentration V;
  Concentration NextU;
  Concentration NextV;
};

//------------------------------------------------------------------------------
/// Shows the second substance, whose memory it reads where it is.
class View
{
public:
  View(int points, Simulation& simulation, vtkMultiProcessController* controller)
    : TheSimulation(simulation)
  {
    const Layers& own = simulation.GetLayers();
    this->Image->SetExtent(0, points - 1, 0, points - 1, own.Low, own.High - 1);
    this->Image->GetPointData()->SetScalars(this->Scalars);
    // The cells below the first own layer are those of the process below, and so on.
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->SetNumberOfTuples(this->Image->GetNumberOfCells());
    const vtkIdType layer = static_cast<vtkIdType>(points - 1) * (points - 1);
    for (int z = own.Low; z < own.High - 1; ++z)
    {
      const bool isOwn = z >= own.First && z < own.End;
      std::fill_n(ghosts->GetPointer((z - own.Low) * layer), layer,
        static_cast<unsigned char>(isOwn ? 0 : vtkDataSetAttributes::DUPLICATECELL));
    }
    this->Image->GetCellData()->AddArray(ghosts);
    this->Mapper->SetInputData(this->Image);
    this->Mapper->SetNumberOfThreads(1); // The other cores have processes of their own.
    this->Volume->SetMapper(this->Mapper);
    vtkVolumeProperty* property = this->Volume->GetProperty();
    property->GetIsoSurfaceValues()->SetValue(0, 0.2);
    property->GetScalarOpacity()->RemoveAllPoints();
    property->GetScalarOpacity()->AddPoint(0.2, 1.0);
    property->GetRGBTransferFunction()->RemoveAllPoints();
    property->GetRGBTransferFunction()->AddRGBPoint(0.2, 0.55, 0.75, 0.95);
    property->ShadeOn();
    const double middle = 0.5 * (points - 1);
    this->Camera->SetFocalPoint(middle, middle, middle);
    this->Camera->SetPosition(middle + 1.2 * points, middle - 1.6 * points, middle + 0.9 * points);
    this->Camera->SetViewUp(0.0, 0.0, 1.0);
    this->Camera->SetClippingRange(points, 4.0 * points);
    this->Compositor->SetController(controller);
  }

  /// Makes a picture. To be called by all processes; those after the first get an empty one.
  bool Render(vtkImageData* picture)
  {
    // The simulation swaps its arrays: the samples are where they were two steps ago.
    Concentration& shown = this->TheSimulation.GetV();
    this->Scalars->SetArray(shown.GetValues(), shown.GetNumberOfValues(), 1);
    this->Scalars->Modified();
    return this->Compositor->RenderToImage(this->Volume, this->Camera, nullptr, 400, 400, picture);
  }

private:
  Simulation& TheSimulation;
  vtkNew<vtkDoubleArray> Scalars;
  vtkNew<vtkImageData> Image;
  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkCamera> Camera;
  vtkNew<vtkIsosurfaceRayTraceCompositor> Compositor;
};

//------------------------------------------------------------------------------
void Write(vtkImageData* picture, const std::string& fileName)
{
  const double white[3] = { 1.0, 1.0, 1.0 };
  vtkNew<vtkImageData> flat;
  vtkIsosurfacePicture::FlattenColors(picture, white, flat);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(flat);
  writer->SetFileName(fileName.c_str());
  writer->Write();
}

//------------------------------------------------------------------------------
bool Run(int points, int steps, int between, const std::string& prefix,
  vtkMultiProcessController* controller)
{
  Simulation simulation(points, controller);
  View view(points, simulation, controller);
  vtkNew<vtkImageData> picture;
  for (int step = 1; step <= steps; ++step)
  {
    simulation.TakeStep();
    if (step % between != 0)
    {
      continue;
    }
    if (!view.Render(picture))
    {
      return false;
    }
    if (controller->GetLocalProcessId() == 0)
    {
      const std::string fileName = prefix + std::to_string(step) + ".png";
      Write(picture, fileName);
      std::printf("%s\n", fileName.c_str());
    }
  }
  return true;
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  const int points = argc == 5 ? std::atoi(argv[1]) : 0;
  const int between = argc == 5 ? std::atoi(argv[3]) : 0;
  bool isDone = false;
  if (points >= 2 * controller->GetNumberOfProcesses() && points >= 8 && between >= 1)
  {
    isDone = Run(points, std::atoi(argv[2]), between, argv[4], controller);
  }
  else if (controller->GetLocalProcessId() == 0)
  {
    std::fprintf(stderr,
      "usage: InSitu <points along an axis> <steps> <steps between pictures> <prefix of pictures>\n"
      "At least 8 points, and 2 for each process.\n");
  }
  controller->Finalize();
  return isDone ? EXIT_SUCCESS : EXIT_FAILURE;
}
