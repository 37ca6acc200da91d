// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The pictures of many processes are those of one: a little of everything, without Python, so that
// sanitizers see it. Run by mpirun; process 0 has all data, too, for comparison.

#include "vtkCellProjectionMapper.h"
#include "vtkIsosurfaceGhostBlocks.h"
#include "vtkIsosurfaceRayTraceCompositor.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"

#include <vtkAppendFilter.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMPIController.h>
#include <vtkNew.h>
#include <vtkNonOverlappingAMR.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRTAnalyticSource.h>
#include <vtkSmartPointer.h>
#include <vtkUniformGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVersionMacros.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{

constexpr int Width = 90;
constexpr int Height = 70;
constexpr int Points = 21;

using Mapper = vtkIsosurfaceRayTraceMapper;

/// The layers of a cube that a part of so many has; all, if there is one.
vtkSmartPointer<vtkImageData> MakePiece(int part, int parts)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(0, Points - 1, 0, Points - 1, 0, Points - 1);
  source->SetCenter(10.0, 10.0, 10.0);
  const int first = (Points - 1) * part / parts;
  const int last = (Points - 1) * (part + 1) / parts;
  const int extent[6] = { 0, Points - 1, 0, Points - 1, first, last };
  source->UpdateExtent(extent);
  return source->GetOutput();
}

vtkSmartPointer<vtkDataObject> MakeMesh(int part, int parts)
{
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(MakePiece(part, parts));
  append->Update();
  return append->GetOutput();
}

vtkSmartPointer<vtkUniformGrid> MakeBlock(int number)
{
  constexpr int cells = 5;
  auto block = vtkSmartPointer<vtkUniformGrid>::New();
  block->SetDimensions(cells + 1, cells + 1, cells + 1);
  block->SetOrigin(
    2.0 * cells * (number & 1), 2.0 * cells * (number >> 1 & 1), 2.0 * cells * (number >> 2));
  block->SetSpacing(2.0, 2.0, 2.0);
  vtkNew<vtkDoubleArray> values;
  values->SetName("values");
  for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
  {
    const double* point = block->GetPoint(i);
    const double x = point[0] - 10.0;
    const double y = point[1] - 10.0;
    const double z = point[2] - 10.0;
    values->InsertNextValue(220.0 - x * x - y * y - 0.5 * z * z);
  }
  block->GetPointData()->SetScalars(values);
  return block;
}

/// Every so many of eight blocks.
vtkSmartPointer<vtkDataObject> MakeBlocks(int part, int parts)
{
  auto amr = vtkSmartPointer<vtkNonOverlappingAMR>::New();
#if VTK_MAJOR_VERSION > 9 || (VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION >= 6)
  amr->Initialize({ 8 });
#else
  const int count = 8;
  amr->Initialize(1, &count);
#endif
  for (int i = part; i < 8; i += parts)
  {
    amr->SetDataSet(0, static_cast<unsigned int>(i), MakeBlock(i));
  }
  return amr;
}

template <typename MapperType>
vtkSmartPointer<vtkVolume> MakeVolume(vtkDataObject* data, const std::vector<double>& opacities,
  const std::function<void(MapperType*)>& set)
{
  vtkNew<MapperType> mapper;
  mapper->SetInputDataObject(data);
  mapper->SetNormalMode(MapperType::INTERPOLANT_GRADIENT); // without ghosts
  mapper->SetNumberOfThreads(2);
  set(mapper);
  auto volume = vtkSmartPointer<vtkVolume>::New();
  volume->SetMapper(mapper);
  volume->GetProperty()->ShadeOn();
  for (std::size_t i = 0; i < opacities.size(); ++i)
  {
    const double isovalue = 130.0 + 40.0 * static_cast<double>(i);
    volume->GetProperty()->GetIsoSurfaceValues()->SetValue(static_cast<int>(i), isovalue);
    volume->GetProperty()->GetScalarOpacity()->AddPoint(isovalue, opacities[i]);
  }
  volume->GetProperty()->GetRGBTransferFunction()->AddRGBPoint(100.0, 0.2, 0.4, 0.9);
  volume->GetProperty()->GetRGBTransferFunction()->AddRGBPoint(220.0, 0.9, 0.5, 0.2);
  volume->GetProperty()->SetScalarOpacityUnitDistance(5.0);
  return volume;
}

vtkSmartPointer<vtkCamera> MakeCamera()
{
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetPosition(45.0, 38.0, 52.0);
  camera->SetFocalPoint(10.0, 10.0, 10.0);
  camera->SetClippingRange(20.0, 110.0);
  return camera;
}

/// Opaque geometry in the middle of the cube, in the right half of the picture.
vtkSmartPointer<vtkFloatArray> MakeDepths()
{
  auto depths = vtkSmartPointer<vtkFloatArray>::New();
  depths->SetNumberOfValues(vtkIdType{ Width } * Height);
  for (vtkIdType i = 0; i < depths->GetNumberOfValues(); ++i)
  {
    depths->SetValue(i, i % Width < Width / 2 ? 1.0F : 0.8F);
  }
  return depths;
}

/// The number of pixels that differ, and of those that show anything.
struct Comparison
{
  vtkIdType Different = 0;
  vtkIdType Shown = 0;
};

Comparison Compare(vtkImageData* picture, vtkImageData* expected)
{
  auto* found = vtkUnsignedCharArray::SafeDownCast(picture->GetPointData()->GetArray("Colors"));
  auto* whole = vtkUnsignedCharArray::SafeDownCast(expected->GetPointData()->GetArray("Colors"));
  Comparison comparison;
  for (vtkIdType i = 0; i < whole->GetNumberOfTuples(); ++i)
  {
    const unsigned char* color = whole->GetPointer(4 * i);
    comparison.Shown += color[3] > 0 ? 1 : 0;
    comparison.Different +=
      !found || !std::equal(color, color + 4, found->GetPointer(4 * i)) ? 1 : 0;
  }
  return comparison;
}

/// What makes a part of the data.
using Maker = std::function<vtkSmartPointer<vtkDataObject>(int part, int parts)>;

class Checker
{
public:
  explicit Checker(vtkMPIController* controller)
    : Controller(controller)
  {
  }

  /// Draws parts of data together, and checks that process 0 has the picture of one mapper.
  template <typename MapperType>
  void Check(
    const std::string& name, const Maker& make, const std::vector<double>& opacities,
    const std::function<void(MapperType*)>& set = [](MapperType*) {}, bool isInScene = false)
  {
    const int process = this->Controller->GetLocalProcessId();
    vtkSmartPointer<vtkDataObject> own = make(process, this->Controller->GetNumberOfProcesses());
    if (own->IsA("vtkUniformGridAMR"))
    {
      vtkNew<vtkIsosurfaceGhostBlocks> ghosts;
      ghosts->SetInputDataObject(own);
      ghosts->Update();
      own = ghosts->GetOutputDataObject(0);
    }
    const vtkSmartPointer<vtkVolume> volume = MakeVolume<MapperType>(own, opacities, set);
    const vtkSmartPointer<vtkCamera> camera = MakeCamera();
    const vtkSmartPointer<vtkFloatArray> depths = isInScene ? MakeDepths() : nullptr;
    vtkNew<vtkIsosurfaceRayTraceCompositor> compositor;
    compositor->BroadcastCamera(camera);
    vtkNew<vtkImageData> picture;
    const bool isRendered = compositor->RenderToImage(
      volume, camera, nullptr, Width, Height, picture, process == 0 ? depths.Get() : nullptr);
    if (process > 0)
    {
      return;
    }
    const vtkSmartPointer<vtkDataObject> all = make(0, 1);
    const vtkSmartPointer<vtkVolume> whole = MakeVolume<MapperType>(all, opacities, set);
    vtkNew<vtkImageData> expected;
    const bool isExpected =
      MapperType::SafeDownCast(whole->GetMapper())
        ->RenderToImage(whole, camera, nullptr, Width, Height, expected, depths);
    const Comparison comparison = Compare(picture, expected);
    std::cout << name << ": " << comparison.Different << " of " << comparison.Shown
              << " pixels differ" << std::endl;
    this->IsFine = this->IsFine && isRendered && isExpected && comparison.Different == 0 &&
      comparison.Shown > Width * Height / 10;
  }

  /// No process has a picture if one refuses.
  void CheckRefusal()
  {
    const int process = this->Controller->GetLocalProcessId();
    const int last = this->Controller->GetNumberOfProcesses() - 1;
    const vtkSmartPointer<vtkVolume> volume =
      MakeVolume<Mapper>(MakePiece(process, last + 1), { 1.0 }, [](Mapper*) {});
    vtkNew<vtkIsosurfaceRayTraceCompositor> compositor;
    vtkNew<vtkImageData> picture;
    vtkObject::GlobalWarningDisplayOff();
    this->IsFine = !compositor->RenderToImage(
                     volume, MakeCamera(), nullptr, process == last ? 0 : Width, Height, picture) &&
      this->IsFine;
    vtkObject::GlobalWarningDisplayOn();
  }

  /// The same in all processes.
  bool IsFineEverywhere()
  {
    const int own = this->IsFine ? 1 : 0;
    int all = 0;
    this->Controller->AllReduce(&own, &all, 1, vtkCommunicator::MIN_OP);
    return all == 1;
  }

private:
  vtkMPIController* Controller;
  bool IsFine = true;
};

}

int main(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  bool isFine = false;
  {
    Checker checker(controller);
    checker.Check<Mapper>("opaque", MakePiece, { 1.0 });
    checker.Check<Mapper>("translucent", MakePiece, { 0.4, 0.5, 1.0 });
    checker.Check<Mapper>(
      "in a scene", MakePiece, { 0.4, 0.5 }, [](Mapper*) {}, true);
    checker.Check<Mapper>("maximum", MakePiece, { 0.2, 0.5, 0.9 },
      [](Mapper* mapper) { mapper->SetBlendModeToMaximumIntensity(); });
    checker.Check<Mapper>("AMR", MakeBlocks, { 0.4, 0.6 });
    checker.Check<vtkIsosurfaceRayTraceMeshMapper>("mesh", MakeMesh, { 0.4, 0.5 });
    checker.Check<vtkCellProjectionMapper>("cloud", MakeMesh, { 0.1, 0.3 });
    checker.Check<vtkCellProjectionMapper>(
      "surfaces in a cloud in a scene", MakeMesh, { 0.1, 0.3 },
      [](vtkCellProjectionMapper* mapper) { mapper->DrawIsosurfacesOn(); }, true);
    checker.CheckRefusal();
    isFine = checker.IsFineEverywhere();
  }
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return isFine ? EXIT_SUCCESS : EXIT_FAILURE;
}
