// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Each allocation that the library makes in a frame, in a pick, in CastRays and in RenderToImage
// fails once: that is one error, or it changes nothing; nothing leaks; and the same mapper works
// afterwards.

#include "Checks.h"
#include "FailingAllocations.h"
#include "Pictures.h"
#include "Selection.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkIsosurfaceVolume.h"

#include <vtkAppendFilter.h>
#include <vtkCallbackCommand.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTimerLog.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <functional>
#include <string>
#include <vector>

using namespace MapperTesting;

namespace
{

constexpr int Size = 24;
constexpr int Samples = 9;

/// What an action finds out; empty if it finds nothing.
using Finding = std::vector<double>;

/// A scene whose mapper is replaced, so that everything is built again.
struct Attacked : Scene
{
  explicit Attacked(vtkDataObject* data)
    : Scene(data, Size, Size)
  {
    this->AddSurface(0.2, { 0.3, 0.5, 0.9 }, 1.0);
    this->Mapper->SetNumberOfThreads(2);
    this->Mapper->AutoAdjustSampleDistancesOff();
  }

  virtual ~Attacked() = default;

  virtual void ReplaceMapper()
  {
    this->Attackee = vtkSmartPointer<vtkIsosurfaceRayTraceMapper>::New();
    this->Attackee->ShallowCopy(this->Mapper);
    this->Show(this->Attackee);
  }

  void Show(vtkAbstractVolumeMapper* mapper)
  {
    this->Errors->Count = 0;
    mapper->AddObserver(vtkCommand::ErrorEvent, this->Errors);
    this->Shown->SetMapper(mapper);
  }

  void ShowInOpaquePass()
  {
    this->Renderer->RemoveVolume(this->Volume);
    this->OpaqueVolume->SetProperty(this->Property());
    this->Renderer->AddVolume(this->OpaqueVolume);
    this->Shown = this->OpaqueVolume;
  }

  vtkSmartPointer<vtkIsosurfaceRayTraceMapper> Attackee;
  vtkNew<vtkIsosurfaceVolume> OpaqueVolume;
  vtkVolume* Shown = this->Volume;
  vtkNew<EventCounter> Errors;
  vtkNew<vtkIsosurfacePicker> Picker;
};

/// The blocks of a scene as meshes, with a mapper of meshes.
struct AttackedMeshes : Attacked
{
  explicit AttackedMeshes(vtkMultiBlockDataSet* blocks)
    : Attacked(blocks)
  {
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      vtkNew<vtkAppendFilter> toMesh;
      toMesh->AddInputData(blocks->GetBlock(i));
      toMesh->Update();
      this->Meshes->SetBlock(i, toMesh->GetOutput());
    }
    this->MeshMapper->SetInputDataObject(this->Meshes);
    this->MeshMapper->SetNumberOfThreads(2);
    this->MeshMapper->AutoAdjustSampleDistancesOff();
  }

  void ReplaceMapper() override
  {
    vtkNew<vtkIsosurfaceRayTraceMeshMapper> attackee;
    attackee->ShallowCopy(this->MeshMapper);
    this->Show(attackee);
  }

  vtkNew<vtkMultiBlockDataSet> Meshes;
  vtkNew<vtkIsosurfaceRayTraceMeshMapper> MeshMapper;
};

/// Two translucent surfaces, cut and capped, with colours and shadows.
void Furnish(Attacked& scene)
{
  scene.SetSurface(0.0, { 0.9, 0.8, 0.7 }, 0.5);
  scene.AddSurface(0.2, { 0.3, 0.5, 0.9 }, 0.7);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.1, 1.0, 0.2);
  scene.Mapper->AddClippingPlane(plane);
  scene.Mapper->CapClippingPlanesOn();
  scene.Mapper->SetColorArrayName("field");
  scene.Mapper->ShadowsOn();
  scene.Mapper->AmbientOcclusionOn();
  scene.Mapper->SetNumberOfAmbientOcclusionRays(2);
  scene.Mapper->SetImageSampleDistance(0.5F);
}

/// A ball in two halves.
vtkSmartPointer<vtkMultiBlockDataSet> NewBlocks()
{
  const auto ball = NewBall(Samples, 0.7);
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int i = 0; i < 2; ++i)
  {
    constexpr int last = Samples - 1;
    constexpr int middle = last / 2;
    int extent[6] = { i == 0 ? 0 : middle, i == 0 ? middle : last, 0, last, 0, last };
    vtkNew<vtkImageData> half;
    half->DeepCopy(ball);
    half->Crop(extent);
    blocks->SetBlock(i, half);
  }
  return blocks;
}

vtkSmartPointer<vtkRectilinearGrid> NewUnevenGrid()
{
  const std::vector<double> planes = { -1.0, -0.9, -0.6, -0.2, 0.1, 0.5, 0.8, 1.0 };
  return NewGrid({ planes, planes, planes }, AnalyticFields::Sphere{ { 0.0, 0.0, 0.0 }, 0.7 });
}

using Action = std::function<Finding(Attacked&)>;

void Append(vtkDataArray* array, Finding& finding)
{
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    const double* tuple = array->GetTuple(i);
    finding.insert(finding.end(), tuple, tuple + array->GetNumberOfComponents());
  }
}

Finding Render(Attacked& scene)
{
  const Picture picture = RenderAndCapture(scene.Window);
  return { picture.begin(), picture.end() };
}

/// A second frame of the same view, which has what the first has built.
Finding RenderAgain(Attacked& scene)
{
  scene.Window->Render();
  scene.Attackee->Modified();
  return Render(scene);
}

/// A frame in which an observer takes the volume out of the renderer.
Finding RenderAndTakeAway(Attacked& scene)
{
  const auto takeAway = [](vtkObject*, unsigned long, void* attacked, void*)
  {
    auto* of = static_cast<Attacked*>(attacked);
    of->Renderer->RemoveVolume(of->Volume);
  };
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&scene);
  observer->SetCallback(takeAway);
  scene.Attackee->AddObserver(vtkCommand::VolumeMapperRenderStartEvent, observer);
  const Finding finding = Render(scene);
  scene.Attackee->RemoveObserver(observer);
  scene.Renderer->RemoveVolume(scene.Volume);
  scene.Renderer->AddVolume(scene.Volume);
  return finding;
}

Finding Pick(Attacked& scene)
{
  vtkIsosurfacePicker* picker = scene.Picker;
  if (picker->Pick(Size / 2, Size / 2, 0.0, scene.Renderer) == 0)
  {
    return {};
  }
  const double* position = picker->GetPickPosition();
  return { position[0], position[1], position[2], static_cast<double>(picker->GetCellId()) };
}

Finding PickAlongLine(Attacked& scene)
{
  vtkIsosurfacePicker* picker = scene.Picker;
  double from[3] = { 0.1, -3.0, 0.1 };
  double to[3] = { 0.1, 3.0, 0.1 };
  if (picker->Pick3DPoint(from, to, scene.Renderer) == 0)
  {
    return {};
  }
  const double* position = picker->GetPickPosition();
  return { position[0], position[1], position[2], static_cast<double>(picker->GetCellId()) };
}

Finding SelectCells(Attacked& scene)
{
  const auto cells = Select(scene.Renderer, scene.Volume, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  return { cells.begin(), cells.end() };
}

Finding CastRays(Attacked& scene)
{
  vtkNew<vtkPoints> origins;
  vtkNew<vtkFloatArray> directions;
  directions->SetNumberOfComponents(3);
  for (int i = 0; i < 40; ++i)
  {
    origins->InsertNextPoint(0.02 * i - 0.4, -3.0, 0.1);
    directions->InsertNextTuple3(0.0, 1.0, 0.0);
  }
  vtkNew<vtkPolyData> hits;
  Finding finding;
  if (scene.Attackee->CastRays(scene.Volume, origins, directions, hits))
  {
    Append(hits->GetPointData()->GetArray("T"), finding);
    Append(hits->GetPointData()->GetArray("CellId"), finding);
  }
  return finding;
}

Finding RenderToImage(Attacked& scene)
{
  vtkNew<vtkImageData> output;
  Finding finding;
  if (scene.Attackee->RenderToImage(
        scene.Volume, scene.Renderer->GetActiveCamera(), nullptr, Size, Size, output))
  {
    Append(output->GetPointData()->GetArray("Colors"), finding);
    Append(output->GetPointData()->GetArray("CellId"), finding);
  }
  return finding;
}

/// A picture, and another one with macrocells that are made anew.
Finding RenderWithOtherMacrocells(Attacked& scene)
{
  if (RenderToImage(scene).empty())
  {
    return {};
  }
  scene.Attackee->SetMacrocellBranching(0, scene.Attackee->GetMacrocellBranching(0) == 2 ? 3 : 2);
  return RenderToImage(scene);
}

/// Frames begin and end, for their observers.
Finding RenderBetweenEvents(Attacked& scene)
{
  vtkNew<EventCounter> starts;
  vtkNew<EventCounter> ends;
  scene.Attackee->AddObserver(vtkCommand::VolumeMapperRenderStartEvent, starts);
  scene.Attackee->AddObserver(vtkCommand::VolumeMapperRenderEndEvent, ends);
  const Finding finding = Render(scene);
  scene.Attackee->RemoveObserver(starts);
  scene.Attackee->RemoveObserver(ends);
  return starts->Count == ends->Count ? finding : Finding{ -1.0 };
}

Finding FindSurfaceBounds(Attacked& scene)
{
  double bounds[6];
  return scene.Attackee->FindSurfaceBounds(scene.Volume, bounds) ? Finding(bounds, bounds + 6)
                                                                 : Finding{};
}

Finding AskWhetherOpaque(Attacked& scene)
{
  return scene.Attackee->HasOnlyOpaqueSurfaces(scene.Volume) ? Finding{ 1.0 } : Finding{};
}

/// Lets an allocation of an action fail, and the action succeed afterwards. Returns whether there
/// are so many allocations; grown is by how many more of them are alive.
bool Fail(Checks& check, const std::string& what, Attacked& scene, const Action& action,
  const Finding& expected, long number, long& grown)
{
  scene.ReplaceMapper();
  const long before = FailingAllocations::CountLive();
  FailingAllocations::FailAt(number);
  const bool isSame = action(scene) == expected;
  const bool hasFailed = FailingAllocations::HasFailed();
  if (scene.Errors->Count == 0)
  {
    check.That(isSame, what + " finds the same if there is no error");
  }
  else
  {
    // What is known of a frame that failed can be asked for.
    check.That(scene.Attackee == nullptr || scene.Attackee->GetMacrocellMemory() >= 0,
      what + " knows its memory");
    check.That(hasFailed && scene.Errors->Count == 1, what + " reports one error");
    check.That(scene.Errors->Text.find("There is not enough memory.") != std::string::npos,
      what + " reports what is the matter, not " + scene.Errors->Text);
  }
  check.That(action(scene) == expected, what + " finds the same the next time");
  scene.ReplaceMapper();
  grown = FailingAllocations::CountLive() - before;
  return hasFailed;
}

/// Fails the allocations of an action one after the other. Returns how many. So many of them are
/// dense; between the others there are ever larger gaps.
int Attack(
  Checks& check, const std::string& name, Attacked& scene, const Action& action, long dense = 20)
{
  scene.ReplaceMapper();
  const Finding expected = action(scene);
  check.That(!expected.empty(), name + " finds something");
  check.Equal(scene.Errors->Count, 0, name + ": the number of errors without failure");
  int failures = 0;
  bool hasFailed = true;
  for (long number = 1; hasFailed && check.Result() == EXIT_SUCCESS; number += 1 + number / dense)
  {
    const std::string what = name + " without allocation " + std::to_string(number);
    long grown = 1;
    // What VTK keeps for good is kept once; a leak comes again.
    for (int i = 0; i < 3 && grown > 0; ++i)
    {
      hasFailed = Fail(check, what, scene, action, expected, number, grown);
    }
    check.That(grown <= 0, what + " leaks nothing");
    failures += hasFailed ? 1 : 0;
  }
  std::cout << name << ": " << failures << " allocations have failed\n";
  return failures;
}

}

int TestIsosurfaceAllocations(int, char*[])
{
  vtkTimerLog::LoggingOff(); // It keeps what it logs.
  Checks check;
  check.That(FailingAllocations::SelectLibrary("libvtkIsosurfaceRayTracing"),
    "the library is a shared library");
  int total = 0;
  {
    Attacked scene(NewBall(Samples, 0.7));
    total += Attack(check, "Render", scene, Render);
    total += Attack(check, "RenderAgain", scene, RenderAgain);
    total += Attack(check, "Pick", scene, Pick);
    total += Attack(check, "PickAlongLine", scene, PickAlongLine);
    total += Attack(check, "SelectCells", scene, SelectCells);
    total += Attack(check, "CastRays", scene, CastRays);
    total += Attack(check, "RenderToImage", scene, RenderToImage);
    total += Attack(check, "HasOnlyOpaqueSurfaces", scene, AskWhetherOpaque);
    total += Attack(check, "FindSurfaceBounds", scene, FindSurfaceBounds);
    total += Attack(check, "RenderToImage (other macrocells)", scene, RenderWithOtherMacrocells);
    total += Attack(check, "Render (events)", scene, RenderBetweenEvents);
  }
  {
    Attacked scene(NewBall(Samples, 0.7));
    Furnish(scene);
    total += Attack(check, "Render (translucent)", scene, Render);
    total += Attack(check, "RenderToImage (translucent)", scene, RenderToImage);
    scene.Mapper->ProgressiveAccumulationOn();
    total += Attack(check, "Render (accumulated)", scene, RenderAgain);
  }
  {
    Attacked scene(NewBlocks());
    total += Attack(check, "Render (blocks)", scene, Render);
    total += Attack(check, "Pick (blocks)", scene, Pick);
  }
  {
    AttackedMeshes scene(NewBlocks());
    total += Attack(check, "Render (meshes)", scene, Render);
    total += Attack(check, "Pick (meshes)", scene, Pick);
    total += Attack(check, "SelectCells (meshes)", scene, SelectCells);
    scene.SetSurface(0.0, { 0.9, 0.8, 0.7 }, 0.5);
    scene.MeshMapper->SetColorArrayName("field");
    scene.MeshMapper->ShadowsOn();
    total += Attack(check, "Render (translucent meshes)", scene, Render);
  }
  {
    Attacked scene(NewUnevenGrid());
    scene.Mapper->SetScalarModeToUseCellFieldData();
    scene.Mapper->SelectScalarArray("field");
    total += Attack(check, "Render (cells of a grid)", scene, Render);
    scene.Mapper->SetBlendModeToMaximumIntensity();
    total += Attack(check, "Render (projection)", scene, Render);
  }
  {
    Attacked scene(NewBall(Samples, 0.7));
    scene.Renderer->UseSSAOOn();
    scene.ShowInOpaquePass();
    total += Attack(check, "Render (with a render pass)", scene, Render);
  }
  {
    Attacked scene(NewBall(Samples, 0.7));
    total += Attack(check, "Render (volume taken away)", scene, RenderAndTakeAway, 1000);
  }
  std::cout << total << " allocations have failed\n";
  check.That(total > 1000, "many allocations fail");
  return check.Result();
}
