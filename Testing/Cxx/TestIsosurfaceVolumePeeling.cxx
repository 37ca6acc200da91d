// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Translucent isosurfaces whose renderer peels depths look as their polygons do among translucent
// polygons, before, between and behind them.

#include "Checks.h"
#include "Pictures.h"
#include "Screens.h"
#include "Selection.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkIsosurfaceVolume.h"

#include <vtkActor.h>
#include <vtkAppendFilter.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkFlyingEdges3D.h>
#include <vtkMapper.h>
#include <vtkPropAssembly.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>

#include <array>
#include <functional>
#include <iostream>
#include <set>
#include <string>
#include <vector>

using namespace MapperTesting;

namespace
{

constexpr double Radius = 0.7;

struct Surface
{
  double Isovalue;
  std::array<double, 3> Color;
  double Opacity;
};

/// Isosurfaces of an image in a vtkIsosurfaceVolume, and their polygons to replace it.
struct PeeledScene : Scene
{
  PeeledScene(vtkImageData* image, const std::vector<Surface>& surfaces)
    : Scene(image)
  {
    this->Isosurface->SetMapper(this->Mapper);
    this->Isosurface->SetProperty(this->Property());
    this->Property()->GetIsoSurfaceValues()->SetNumberOfContours(0);
    this->Property()->GetRGBTransferFunction()->RemoveAllPoints();
    this->Property()->GetScalarOpacity()->RemoveAllPoints();
    this->Property()->SetAmbient(0.0);
    this->Property()->SetDiffuse(1.0);
    this->Property()->SetSpecular(0.0);
    for (const Surface& surface : surfaces)
    {
      this->AddSurface(surface.Isovalue, surface.Color, surface.Opacity);
      this->Polygons.push_back(NewPolygons(image, surface));
    }
    this->Renderer->RemoveAllViewProps();
    AddScreens(this->Renderer);
    PeelDepths(this->Renderer);
  }

  static vtkSmartPointer<vtkActor> NewPolygons(vtkImageData* image, const Surface& surface)
  {
    vtkNew<vtkFlyingEdges3D> contour;
    contour->SetInputData(image);
    contour->SetValue(0, surface.Isovalue);
    auto actor = NewActor(contour);
    actor->GetMapper()->ScalarVisibilityOff();
    actor->GetProperty()->SetColor(surface.Color[0], surface.Color[1], surface.Color[2]);
    actor->GetProperty()->SetOpacity(surface.Opacity);
    return actor;
  }

  void ShowIsosurface()
  {
    for (vtkActor* actor : this->Polygons)
    {
      this->Renderer->RemoveViewProp(actor);
    }
    this->Renderer->AddViewProp(this->Isosurface);
  }

  void ShowPolygons()
  {
    this->Renderer->RemoveViewProp(this->Isosurface);
    for (vtkActor* actor : this->Polygons)
    {
      this->Renderer->AddViewProp(actor);
    }
  }

  vtkNew<vtkIsosurfaceVolume> Isosurface;
  std::vector<vtkSmartPointer<vtkActor>> Polygons;
};

const Surface Shell = { 0.0, { 0.9, 0.8, 0.7 }, 0.5 };
const Surface Core = { 0.3, { 0.3, 0.8, 0.9 }, 1.0 };
const Surface FaintCore = { 0.3, { 0.3, 0.8, 0.9 }, 0.4 };

void CheckAgainst(
  Checks& check, const Picture& traced, const Picture& polygons, const std::string& what)
{
  const double difference = GetDifference(traced, polygons, 8);
  std::cout << what << ": " << 100.0 * difference << " % of the pixels differ\n";
  check.That(difference < 0.005, what + ": they look as their polygons do");
}

/// However surfaces are mixed, and whatever else the renderer does.
void CheckAgainstPolygons(Checks& check, vtkImageData* image)
{
  struct Case
  {
    std::string Name;
    std::vector<Surface> Surfaces;
    std::function<void(PeeledScene&)> Apply;
  };
  const std::vector<Case> cases = {
    { "a shell", { Shell }, [](PeeledScene&) {} },
    { "a shell and an opaque core", { Shell, Core }, [](PeeledScene&) {} },
    { "a shell and a core", { Shell, FaintCore }, [](PeeledScene&) {} },
    { "a viewport", { Shell, FaintCore },
      [](PeeledScene& scene) { scene.Renderer->SetViewport(0.21, 0.12, 0.83, 0.97); } },
    { "parallel projection", { Shell, FaintCore },
      [](PeeledScene& scene) { scene.Renderer->GetActiveCamera()->ParallelProjectionOn(); } },
    { "an opaque screen", { Shell, FaintCore },
      [](PeeledScene& scene) {
        scene.Renderer->AddActor(NewScreen(-0.2, { 1.0, 1.0, 1.0 }, 1.0));
      } },
    { "peeling of volumes", { Shell, FaintCore },
      [](PeeledScene& scene) { scene.Renderer->UseDepthPeelingForVolumesOn(); } },
    { "FXAA", { Shell, FaintCore }, [](PeeledScene& scene) { scene.Renderer->UseFXAAOn(); } },
    { "several rays for each pixel", { Shell, FaintCore },
      [](PeeledScene& scene)
      {
        scene.Mapper->AutoAdjustSampleDistancesOff();
        scene.Mapper->SetImageSampleDistance(0.5);
      } },
    { "accumulation", { Shell, FaintCore },
      [](PeeledScene& scene) { scene.Mapper->ProgressiveAccumulationOn(); } },
  };
  for (const Case& each : cases)
  {
    PeeledScene scene(image, each.Surfaces);
    each.Apply(scene);
    scene.ShowPolygons();
    const Picture polygons = RenderAndCapture(scene.Window);
    scene.ShowIsosurface();
    vtkNew<EventCounter> starts;
    scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderStartEvent, starts);
    vtkNew<EventCounter> errors;
    scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
    const Picture traced = RenderAndCapture(scene.Window);
    check.Equal(starts->Count, 1, each.Name + ": the number of times they are traced");
    check.Equal(errors->Count, 0, each.Name + ": the number of errors");
    CheckAgainst(check, traced, polygons, each.Name);
  }
}

/// Two that pass through each other, without any polygons.
void CheckTwo(Checks& check, vtkImageData* image)
{
  PeeledScene scene(image, { Shell });
  scene.Renderer->RemoveAllViewProps();
  const auto other = PeeledScene::NewPolygons(image, { 0.0, { 0.2, 0.9, 0.3 }, 0.6 });
  other->SetPosition(0.4, 0.2, 0.1);
  scene.ShowPolygons();
  scene.Renderer->AddViewProp(other);
  const Picture polygons = RenderAndCapture(scene.Window);

  Scene second(image);
  second.SetSurface(0.0, { 0.2, 0.9, 0.3 }, 0.6);
  second.Property()->SetAmbient(0.0);
  second.Property()->SetDiffuse(1.0);
  second.Property()->SetSpecular(0.0);
  vtkNew<vtkIsosurfaceVolume> moved;
  moved->SetMapper(second.Mapper);
  moved->SetProperty(second.Property());
  moved->SetPosition(0.4, 0.2, 0.1);
  scene.Renderer->RemoveViewProp(other);
  scene.ShowIsosurface();
  scene.Renderer->AddViewProp(moved);
  CheckAgainst(check, RenderAndCapture(scene.Window), polygons, "two volumes");

  // The layers are those of the volumes, also where they have one mapper.
  moved->SetMapper(scene.Mapper);
  CheckAgainst(check, RenderAndCapture(scene.Window), polygons, "two volumes of one mapper");
}

/// Assemblies change nothing, wherever they are in the list of props.
void CheckAssemblies(Checks& check, vtkImageData* image)
{
  PeeledScene scene(image, { Shell, FaintCore });
  vtkNew<vtkIsosurfaceVolume> other;
  other->SetMapper(scene.Mapper);
  other->SetProperty(scene.Property());
  other->SetPosition(0.4, 0.2, 0.1);
  for (const bool hasScreens : { true, false })
  {
    scene.Renderer->RemoveAllViewProps();
    if (hasScreens)
    {
      AddScreens(scene.Renderer);
    }
    scene.Renderer->AddViewProp(scene.Isosurface);
    scene.Renderer->AddViewProp(other);
    const Picture expected = RenderAndCapture(scene.Window);
    vtkNew<vtkAssembly> parts;
    parts->AddPart(scene.Isosurface);
    parts->AddPart(other);
    vtkNew<vtkAssembly> nested;
    nested->AddPart(parts);
    vtkNew<vtkPropAssembly> props;
    props->AddPart(scene.Isosurface);
    props->AddPart(other);
    const std::vector<vtkProp*> assemblies = { parts, nested, props };
    for (vtkProp* assembly : assemblies)
    {
      scene.Renderer->RemoveAllViewProps();
      scene.Renderer->AddViewProp(assembly);
      if (hasScreens)
      {
        AddScreens(scene.Renderer);
      }
      // In another order, if only where depths are equal.
      check.That(GetDifference(RenderAndCapture(scene.Window), expected, 1) < 0.001,
        std::string("they look alike in a ") + assembly->GetClassName());
    }
  }
}

/// Where nothing else is translucent there is nothing to peel: edges are smooth as in a vtkVolume,
/// and the picture is the same.
void CheckAlone(Checks& check, vtkImageData* image)
{
  PeeledScene scene(image, { Shell, FaintCore });
  scene.Mapper->AutoAdjustSampleDistancesOff();
  scene.Mapper->SetImageSampleDistance(0.5);
  scene.ShowIsosurface();
  scene.Window->Render();
  vtkPropCollection* props = scene.Renderer->GetViewProps();
  for (int i = 0; i < props->GetNumberOfItems(); ++i)
  {
    auto* prop = vtkProp::SafeDownCast(props->GetItemAsObject(i));
    prop->SetVisibility(prop == scene.Isosurface.Get());
  }
  const Picture alone = RenderAndCapture(scene.Window);
  scene.Renderer->RemoveViewProp(scene.Isosurface);
  scene.Renderer->AddVolume(scene.Volume);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), alone, 0), 0.0,
    "the difference of one without translucent polygons from a vtkVolume");
}

/// A mesh is drawn in the same way.
void CheckMesh(Checks& check, vtkImageData* image)
{
  PeeledScene scene(image, { Shell, FaintCore });
  scene.ShowIsosurface();
  const Picture ofImage = RenderAndCapture(scene.Window);
  vtkNew<vtkIsosurfaceRayTraceMeshMapper> mapper;
  vtkNew<vtkAppendFilter> voxels;
  voxels->SetInputData(image);
  mapper->SetInputConnection(voxels->GetOutputPort());
  scene.Isosurface->SetMapper(mapper);
  check.That(
    GetDifference(RenderAndCapture(scene.Window), ofImage, 8) < 0.005, "a mesh looks as its image");
}

/// What a frame leaves in the depth buffer, and what can be selected, is the same as without
/// peeling.
void CheckDepthsAndSelection(Checks& check, vtkImageData* image)
{
  PeeledScene scene(image, { Shell, Core });
  scene.ShowIsosurface();
  scene.Window->Render();
  const double peeled = scene.Renderer->GetZ(80, 80);
  constexpr int cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  const std::set<vtkIdType> selected = Select(scene.Renderer, scene.Isosurface, cells);
  scene.Renderer->UseDepthPeelingOff();
  scene.Window->Render();
  check.That(peeled < 1.0, "an opaque surface in a translucent one has a depth");
  check.Equal(peeled, scene.Renderer->GetZ(80, 80), "the depth of an opaque surface");
  check.That(selected.size() > 100, "hundreds of cells are selected");
  check.That(selected == Select(scene.Renderer, scene.Isosurface, cells),
    "the same cells are selected with peeling");
}

/// The frame after one that is aborted, coarse pictures, and windows of another size are complete.
void CheckFrames(Checks& check, vtkImageData* image)
{
  PeeledScene scene(image, { Shell, FaintCore });
  scene.ShowIsosurface();
  const Picture expected = RenderAndCapture(scene.Window);
  scene.Property()->SetDiffuse(0.9);
  RenderAndAbort(scene.Window);
  scene.Property()->SetDiffuse(1.0);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after an aborted frame");

  scene.Mapper->AutoAdjustSampleDistancesOff();
  scene.Mapper->SetImageSampleDistance(2.0);
  const double coarse = GetDifference(RenderAndCapture(scene.Window), expected, 16);
  check.That(coarse > 0.0 && coarse < 0.1, "a coarse picture is much the same");
  scene.Mapper->SetImageSampleDistance(1.0);

  scene.Isosurface->ReleaseGraphicsResources(scene.Window);
  scene.Isosurface->ReleaseGraphicsResources(scene.Window);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after release");
  scene.Window->SetSize(90, 120);
  scene.Window->Render();
  scene.Window->SetSize(160, 160);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after the window was smaller");
}

/// Windows that show one volume, in turn.
void CheckWindows(Checks& check, vtkImageData* image)
{
  PeeledScene scene(image, { Shell, FaintCore });
  scene.ShowIsosurface();
  const Picture expected = RenderAndCapture(scene.Window);
  {
    PeeledScene other(image, { Shell });
    other.Renderer->AddViewProp(scene.Isosurface);
    other.Renderer->SetActiveCamera(scene.Renderer->GetActiveCamera());
    check.Equal(GetDifference(RenderAndCapture(other.Window), expected, 0), 0.0,
      "the difference in another window");
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference back in the first window");
    other.Renderer->UseDepthPeelingOff();
    check.That(GetDifference(RenderAndCapture(other.Window), expected, 8) > 0.02,
      "a renderer that does not peel draws a volume over the screens");
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference in the first window, while the other does not peel");
  }
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after the other window is gone");
  // VTK releases what props of renderers have; this is none of them then.
  scene.Renderer->GetViewProps()->RemoveItem(scene.Isosurface);
  scene.Window->Finalize();
  scene.Window->Render();
  scene.Renderer->AddViewProp(scene.Isosurface);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after the window was finalized");
}

}

int TestIsosurfaceVolumePeeling(int argc, char* argv[])
{
  Checks check;
  const auto image = NewBall(65, Radius);
  CheckAgainstPolygons(check, image);
  CheckTwo(check, image);
  CheckAssemblies(check, image);
  CheckAlone(check, image);
  CheckMesh(check, image);
  CheckDepthsAndSelection(check, image);
  CheckFrames(check, image);
  CheckWindows(check, image);
  PeeledScene scene(image, { Shell, Core });
  scene.ShowIsosurface();
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
