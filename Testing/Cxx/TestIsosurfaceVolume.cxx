// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Opaque isosurfaces take part in the scene as their polygons do: beside translucent polygons, in
// render passes, for GetZ and selectors, and once per frame.

#include "Checks.h"
#include "Pictures.h"
#include "Screens.h"
#include "Selection.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfaceVolume.h"

#include <vtkActor.h>
#include <vtkCameraPass.h>
#include <vtkDataObject.h>
#include <vtkDepthOfFieldPass.h>
#include <vtkEDLShading.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkFramebufferPass.h>
#include <vtkGaussianBlurPass.h>
#include <vtkLightsPass.h>
#include <vtkOpaquePass.h>
#include <vtkOutlineSource.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderStepsPass.h>
#include <vtkSSAAPass.h>
#include <vtkSSAOPass.h>
#include <vtkSequencePass.h>
#include <vtkVolumetricPass.h>

#include <functional>
#include <set>

using namespace MapperTesting;

namespace
{

constexpr double Radius = 0.7;

/// A ball in a vtkIsosurfaceVolume, and polygons of the same ball to replace it.
struct BallScene : Scene
{
  explicit BallScene(vtkImageData* image)
    : Scene(image)
  {
    this->Isosurface->SetMapper(this->Mapper);
    this->Isosurface->SetProperty(this->Property());
    this->Property()->SetAmbient(0.0);
    this->Property()->SetDiffuse(1.0);
    this->Property()->SetSpecular(0.0);
    this->Renderer->RemoveAllViewProps();
    this->Polygons = NewSphere(Radius, { 0.0, 0.0, 0.0 }, 300);
    this->Polygons->GetProperty()->SetColor(0.9, 0.8, 0.7);
    this->Show(this->Isosurface);
    // Both scenes have the bounds of the volume, which vtkEDLShading uses.
    this->Renderer->AddActor(NewActor(vtkNew<vtkOutlineSource>()));
  }

  /// Of the two balls, the one given.
  void Show(vtkProp* ball)
  {
    this->Renderer->RemoveViewProp(this->Isosurface);
    this->Renderer->RemoveViewProp(this->Polygons);
    this->Renderer->AddViewProp(ball);
  }

  vtkNew<vtkIsosurfaceVolume> Isosurface;
  vtkSmartPointer<vtkActor> Polygons;
};

struct Setting
{
  std::string Name;
  std::function<void(vtkRenderer*)> Apply;
};

/// Adds a pass over VTK's usual ones.
template <typename Pass>
vtkSmartPointer<Pass> AddPass(vtkRenderer* renderer)
{
  vtkNew<vtkRenderStepsPass> steps;
  auto pass = vtkSmartPointer<Pass>::New();
  pass->SetDelegatePass(steps);
  renderer->SetPass(pass);
  return pass;
}

void AddSequence(vtkRenderer* renderer)
{
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(vtkNew<vtkLightsPass>());
  passes->AddItem(vtkNew<vtkOpaquePass>());
  passes->AddItem(vtkNew<vtkVolumetricPass>());
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  renderer->SetPass(camera);
}

std::vector<Setting> GetSettings()
{
  return {
    { "plain", [](vtkRenderer*) {} },
    { "translucent polygons", AddScreens },
    { "depth peeling",
      [](vtkRenderer* renderer)
      {
        AddScreens(renderer);
        PeelDepths(renderer);
      } },
    { "depth peeling for volumes",
      [](vtkRenderer* renderer)
      {
        AddScreens(renderer);
        PeelDepths(renderer);
        renderer->UseDepthPeelingForVolumesOn();
      } },
    { "FXAA", [](vtkRenderer* renderer) { renderer->UseFXAAOn(); } },
    { "a viewport and a pass",
      [](vtkRenderer* renderer)
      {
        renderer->SetViewport(0.21, 0.12, 0.83, 0.97);
        AddPass<vtkEDLShading>(renderer);
      } },
    { "a sequence of passes", AddSequence },
    { "vtkEDLShading", [](vtkRenderer* renderer) { AddPass<vtkEDLShading>(renderer); } },
    { "vtkEDLShading and translucent polygons",
      [](vtkRenderer* renderer)
      {
        AddScreens(renderer);
        AddPass<vtkEDLShading>(renderer);
      } },
    { "vtkSSAOPass",
      [](vtkRenderer* renderer)
      {
        renderer->AddActor(NewScreen(0.4, { 1.0, 1.0, 1.0 }, 1.0));
        AddPass<vtkSSAOPass>(renderer)->SetRadius(0.8);
      } },
    { "UseSSAO",
      [](vtkRenderer* renderer)
      {
        renderer->AddActor(NewScreen(0.4, { 1.0, 1.0, 1.0 }, 1.0));
        renderer->UseSSAOOn();
        renderer->SetSSAORadius(0.8);
      } },
    { "vtkSSAAPass", [](vtkRenderer* renderer) { AddPass<vtkSSAAPass>(renderer); } },
    { "vtkDepthOfFieldPass",
      [](vtkRenderer* renderer) { AddPass<vtkDepthOfFieldPass>(renderer); } },
    { "vtkGaussianBlurPass",
      [](vtkRenderer* renderer) { AddPass<vtkGaussianBlurPass>(renderer); } },
  };
}

/// It looks as its polygons do, and is drawn once.
void CheckAgainstPolygons(Checks& check, vtkImageData* image, const Setting& setting)
{
  BallScene scene(image);
  scene.Renderer->SetBackground(0.3, 0.3, 0.3);
  setting.Apply(scene.Renderer);
  // The first frame of a vtkDepthOfFieldPass is black, whatever the scene.
  scene.Show(scene.Polygons);
  scene.Window->Render();
  scene.Show(scene.Isosurface);
  vtkNew<EventCounter> starts;
  scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderStartEvent, starts);
  const Picture traced = RenderAndCapture(scene.Window);
  check.Equal(starts->Count, 1, setting.Name + ": the number of times it is drawn");
  scene.Show(scene.Polygons);
  const Picture polygons = RenderAndCapture(scene.Window);
  const double difference = GetDifference(traced, polygons, 6);
  std::cout << setting.Name << ": " << 100.0 * difference << " % of the pixels differ\n";
  check.That(difference < 0.005, setting.Name + ": it looks as its polygons do");
}

/// A scene with a translucent surface, one within, and a screen through both.
struct TranslucentScene : Scene
{
  explicit TranslucentScene(vtkImageData* image)
    : Scene(image)
  {
    this->SetSurface(0.0, { 0.9, 0.8, 0.7 }, 0.5);
    this->AddSurface(0.3, { 0.3, 0.8, 0.9 }, 1.0);
    this->Renderer->AddActor(NewScreen(0.0, { 0.2, 1.0, 0.2 }, 1.0));
    this->Renderer->SetViewport(0.21, 0.12, 0.83, 0.97);
  }
};

/// With a translucent surface, and without depth peeling, it is a volume, drawn once and last, also
/// into the framebuffer of a pass, of which it must read the depths.
void CheckTranslucent(Checks& check, vtkImageData* image)
{
  TranslucentScene scene(image);
  const Picture expected = RenderAndCapture(scene.Window);
  vtkNew<vtkIsosurfaceVolume> volume;
  volume->ShallowCopy(scene.Volume);
  check.That(!volume->HasOpaqueGeometry(), "it is not opaque");
  scene.Renderer->RemoveViewProp(scene.Volume);
  scene.Renderer->AddViewProp(volume);
  vtkNew<EventCounter> starts;
  scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderStartEvent, starts);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference of a translucent one from a vtkVolume");
  check.Equal(starts->Count, 1, "the number of times a translucent one is drawn");

  TranslucentScene inFramebuffer(image);
  AddPass<vtkFramebufferPass>(inFramebuffer.Renderer);
  check.Equal(GetDifference(RenderAndCapture(inFramebuffer.Window), expected, 1), 0.0,
    "the difference of a translucent one in a framebuffer");
}

/// VTK cannot peel a vtkVolume, and reports so once; everything else is drawn.
void CheckPeeling(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.SetSurface(0.0, { 0.9, 0.8, 0.7 }, 0.5);
  scene.Renderer->RemoveVolume(scene.Volume);
  AddScreens(scene.Renderer);
  PeelDepths(scene.Renderer);
  scene.Renderer->UseDepthPeelingForVolumesOn();
  const Picture expected = RenderAndCapture(scene.Window);
  scene.Renderer->AddVolume(scene.Volume);
  vtkNew<EventCounter> errors;
  scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference with a volume that cannot be peeled");
  check.Equal(errors->Count, 1, "the number of errors");
  check.That(errors->Text.find("UseDepthPeelingForVolumesOff") != std::string::npos,
    "the error has the remedy");
}

/// What the mapper says of opacity is what it draws: isovalues that are hidden do not count, the
/// component counts that is drawn.
void CheckOpacity(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  vtkNew<vtkIsosurfaceVolume> volume;
  check.That(!volume->HasOpaqueGeometry(), "without a mapper nothing is opaque");
  volume->ShallowCopy(scene.Volume);
  check.That(volume->HasOpaqueGeometry(), "an opaque surface");
  scene.AddSurface(0.3, { 1.0, 1.0, 1.0 }, 0.0);
  check.That(volume->HasOpaqueGeometry(), "an opaque surface and one that is hidden");
  scene.AddSurface(0.2, { 1.0, 1.0, 1.0 }, 0.9);
  check.That(!volume->HasOpaqueGeometry(), "an opaque surface and a translucent one");
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 0.0);
  check.That(!volume->HasOpaqueGeometry(), "a hidden surface alone");
  scene.Property()->GetIsoSurfaceValues()->SetNumberOfContours(0);
  check.That(!volume->HasOpaqueGeometry(), "no surface");
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 1.0);
  scene.Mapper->SetBlendModeToComposite();
  check.That(!volume->HasOpaqueGeometry(), "a mapper that cannot draw");
  scene.Mapper->SetBlendModeToIsoSurface();

  vtkNew<vtkDoubleArray> two;
  two->SetNumberOfComponents(2);
  two->SetNumberOfTuples(image->GetNumberOfPoints());
  two->CopyComponent(0, image->GetPointData()->GetScalars(), 0);
  two->CopyComponent(1, image->GetPointData()->GetScalars(), 0);
  vtkNew<vtkImageData> vectors;
  vectors->CopyStructure(image);
  vectors->GetPointData()->SetScalars(two);
  scene.Mapper->SetInputData(vectors);
  scene.Property()->GetScalarOpacity(1)->AddPoint(0.0, 0.5);
  check.That(volume->HasOpaqueGeometry(), "the first component");
  scene.Property()->SetComponentWeight(0, 0.5);
  check.That(!volume->HasOpaqueGeometry(), "the second component");
}

/// A copy of one is one: it draws the same, in the same order among translucent polygons; and a
/// vtkVolume can be made of it.
void CheckCopy(Checks& check, vtkImageData* image)
{
  BallScene scene(image);
  scene.Isosurface->SetPosition(0.1, 0.0, -0.2);
  scene.Isosurface->RotateX(30.0);
  scene.Isosurface->SetScale(1.2, 0.8, 1.0);
  scene.Isosurface->PickableOff();
  AddScreens(scene.Renderer);
  PeelDepths(scene.Renderer);
  const Picture expected = RenderAndCapture(scene.Window);
  vtkNew<vtkIsosurfaceVolume> copy;
  copy->ShallowCopy(scene.Isosurface);
  check.That(copy->GetMapper() == scene.Mapper && copy->GetProperty() == scene.Property(),
    "a copy has the mapper and the property");
  check.That(copy->HasOpaqueGeometry(), "a copy is opaque");
  check.That(!copy->GetPickable(), "a copy is not pickable where the original is not");
  scene.Show(copy);
  check.Equal(
    GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0, "the difference of a copy");
  vtkNew<vtkVolume> volume;
  volume->ShallowCopy(scene.Isosurface);
  scene.Renderer->RemoveViewProp(copy);
  scene.Renderer->AddViewProp(volume);
  check.That(GetDifference(RenderAndCapture(scene.Window), expected, 8) > 0.02,
    "a vtkVolume is drawn after the screens");
  scene.Show(copy);
  copy->SetMapper(nullptr);
  check.That(!copy->HasOpaqueGeometry() && scene.Isosurface->HasOpaqueGeometry(),
    "a copy that loses its mapper takes none away");
}

/// With smooth edges, whose pixels are blended, what is before the surface hides it, too.
void CheckSmoothEdges(Checks& check, vtkImageData* image)
{
  for (const bool accumulates : { false, true })
  {
    BallScene scene(image);
    scene.Renderer->RemoveAllViewProps();
    scene.Renderer->AddActor(NewScreen(-0.9, { 1.0, 0.2, 0.2 }, 1.0));
    scene.Renderer->AddViewProp(scene.Isosurface);
    const Picture expected = RenderAndCapture(scene.Window);
    if (accumulates)
    {
      scene.Mapper->ProgressiveAccumulationOn();
      scene.Window->Render();
    }
    else
    {
      scene.Mapper->AutoAdjustSampleDistancesOff();
      scene.Mapper->SetImageSampleDistance(0.5);
    }
    const double difference = GetDifference(RenderAndCapture(scene.Window), expected, 8);
    check.That(difference > 0.0 && difference < 0.02, "smooth edges change the edges alone");
  }
}

/// The depth at a pixel is that of the hit.
void CheckDepth(Checks& check, vtkImageData* image)
{
  BallScene scene(image);
  scene.Window->Render();
  double x[3];
  double pcoords[3];
  double normal[3];
  double isovalue;
  vtkIdType cell;
  check.Equal(scene.Mapper->PickPixel(
                scene.Renderer, scene.Isosurface, 70, 90, x, pcoords, cell, isovalue, normal),
    1, "the pick of a pixel");
  scene.Renderer->SetWorldPoint(x[0], x[1], x[2], 1.0);
  scene.Renderer->WorldToDisplay();
  check.Near(scene.Renderer->GetZ(70, 90), scene.Renderer->GetDisplayPoint()[2], 1e-6,
    "the depth at a pixel");
}

/// A selector finds the same cells as in a vtkVolume.
void CheckSelector(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  vtkSmartPointer<vtkActor> screen = NewScreen(-0.5, { 1.0, 0.0, 0.0 }, 1.0);
  scene.Renderer->AddActor(screen);
  scene.Window->Render();
  constexpr int cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  const std::set<vtkIdType> expected = Select(scene.Renderer, scene.Volume, cells);
  vtkNew<vtkIsosurfaceVolume> volume;
  volume->ShallowCopy(scene.Volume);
  scene.Renderer->RemoveViewProp(scene.Volume);
  scene.Renderer->AddViewProp(volume);
  scene.Window->Render();
  check.That(expected.size() > 100, "hundreds of cells are selected");
  check.That(Select(scene.Renderer, volume, cells) == expected, "the same cells are selected");
  check.That(Select(scene.Renderer, screen, cells) == std::set<vtkIdType>{ 0 },
    "the cell of the screen is selected");
}

/// With another mapper it is a vtkVolume.
void CheckOtherMapper(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  mapper->SetInputData(image);
  scene.Volume->SetMapper(mapper);
  const Picture expected = RenderAndCapture(scene.Window);
  check.That(GetDifference(expected, Picture(expected.size(), 0), 60) > 0.1, "a cloud is drawn");
  vtkNew<vtkIsosurfaceVolume> volume;
  volume->ShallowCopy(scene.Volume);
  scene.Renderer->RemoveViewProp(scene.Volume);
  scene.Renderer->AddViewProp(volume);
  check.That(!volume->HasOpaqueGeometry(), "another mapper's volume is not opaque");
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference with another mapper");
}

}

int TestIsosurfaceVolume(int argc, char* argv[])
{
  Checks check;
  const auto image = NewBall(65, Radius);
  for (const Setting& setting : GetSettings())
  {
    CheckAgainstPolygons(check, image, setting);
  }
  CheckTranslucent(check, image);
  CheckPeeling(check, image);
  CheckOpacity(check, image);
  CheckCopy(check, image);
  CheckSmoothEdges(check, image);
  CheckDepth(check, image);
  CheckSelector(check, image);
  CheckOtherMapper(check, image);
  BallScene scene(image);
  AddScreens(scene.Renderer);
  PeelDepths(scene.Renderer);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
