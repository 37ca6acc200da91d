// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What cannot be drawn: one error with the remedy, nothing drawn, and no lasting effect.

#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkAbstractMapper.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkObjectFactory.h>

#include <functional>
#include <limits>

using namespace MapperTesting;

namespace
{

struct Fault
{
  std::string Name;
  /// A word of the remedy.
  std::string Remedy;
  std::function<void(Scene&, vtkImageData*)> Make;
  std::function<void(Scene&, vtkImageData*)> Mend;
};

void SetScalars(vtkImageData* image, vtkDataArray* scalars)
{
  image->GetPointData()->SetScalars(scalars);
}

std::vector<Fault> GetFaults(vtkDataArray* good)
{
  const auto restore = [good](Scene&, vtkImageData* image) { SetScalars(image, good); };
  return {
    { "no scalars", "Add scalars", [](Scene&, vtkImageData* image) { SetScalars(image, nullptr); },
      restore },
    { "cell scalars of one layer", "2 cells",
      [](Scene&, vtkImageData* image)
      {
        image->SetDimensions(17, 2, 17);
        SetScalars(image, nullptr);
        vtkNew<vtkFloatArray> cells;
        cells->SetNumberOfTuples(image->GetNumberOfCells());
        cells->Fill(1.0);
        image->GetCellData()->SetScalars(cells);
      },
      [good](Scene&, vtkImageData* image)
      {
        image->SetDimensions(17, 17, 17);
        image->GetCellData()->Initialize();
        SetScalars(image, good);
      } },
    { "an array that is not there", "SelectScalarArray",
      [](Scene& scene, vtkImageData*)
      {
        scene.Mapper->SetScalarModeToUsePointFieldData();
        scene.Mapper->SelectScalarArray("no such array");
      },
      [](Scene& scene, vtkImageData*) { scene.Mapper->SetScalarModeToDefault(); } },
    { "too few scalars", "every point",
      [](Scene&, vtkImageData* image)
      {
        vtkNew<vtkFloatArray> few;
        few->SetNumberOfTuples(10);
        few->Fill(1.0);
        SetScalars(image, few);
      },
      restore },
    { "five components", "SetVectorModeToComponent",
      [](Scene&, vtkImageData* image)
      {
        vtkNew<vtkFloatArray> five;
        five->SetNumberOfComponents(5);
        five->SetNumberOfTuples(image->GetNumberOfPoints());
        five->Fill(1.0);
        SetScalars(image, five);
      },
      restore },
    { "one sample along y", "at least 2",
      [](Scene&, vtkImageData* image)
      {
        image->SetDimensions(17, 1, 17);
        vtkNew<vtkFloatArray> flat;
        flat->SetNumberOfTuples(image->GetNumberOfPoints());
        flat->Fill(1.0);
        SetScalars(image, flat);
      },
      [good](Scene&, vtkImageData* image)
      {
        image->SetDimensions(17, 17, 17);
        SetScalars(image, good);
      } },
    { "no samples at all", "at least 2",
      [](Scene&, vtkImageData* image)
      {
        image->SetDimensions(0, 0, 0);
        vtkNew<vtkFloatArray> none;
        SetScalars(image, none);
      },
      [good](Scene&, vtkImageData* image)
      {
        image->SetDimensions(17, 17, 17);
        SetScalars(image, good);
      } },
    { "a spacing of 0", "spacing",
      [](Scene&, vtkImageData* image) { image->SetSpacing(0.125, 0.0, 0.125); },
      [](Scene&, vtkImageData* image) { image->SetSpacing(0.125, 0.125, 0.125); } },
    { "a component that is not there", "SetVectorComponent",
      [](Scene& scene, vtkImageData*)
      {
        scene.Mapper->SetVectorModeToComponent();
        scene.Mapper->SetVectorComponent(1);
      },
      [](Scene& scene, vtkImageData*) { scene.Mapper->SetVectorModeToDisabled(); } },
    { "cropping planes out of order", "SetCroppingRegionPlanes",
      [](Scene& scene, vtkImageData*)
      {
        scene.Mapper->CroppingOn();
        scene.Mapper->SetCroppingRegionPlanes(-1.0, 1.0, 0.5, -0.5, -1.0, 1.0);
      },
      [](Scene& scene, vtkImageData*) { scene.Mapper->CroppingOff(); } },
    { "an array of the field data", "SelectScalarArray",
      [good](Scene& scene, vtkImageData* image)
      {
        image->GetFieldData()->AddArray(good);
        scene.Mapper->SetScalarMode(VTK_SCALAR_MODE_USE_FIELD_DATA);
        scene.Mapper->SelectScalarArray(good->GetName());
      },
      [](Scene& scene, vtkImageData* image)
      {
        image->GetFieldData()->Initialize();
        scene.Mapper->SetScalarModeToDefault();
      } },
    { "another blend mode", "SetBlendModeToIsoSurface",
      [](Scene& scene, vtkImageData*) { scene.Mapper->SetBlendModeToComposite(); },
      [](Scene& scene, vtkImageData*) { scene.Mapper->SetBlendModeToIsoSurface(); } },
    { "a projection of the tricubic interpolant", "SetInterpolationModeToTrilinear",
      [](Scene& scene, vtkImageData*)
      {
        scene.Mapper->SetInterpolationModeToCubic();
        scene.Mapper->SetBlendModeToMaximumIntensity();
      },
      [](Scene& scene, vtkImageData*)
      {
        scene.Mapper->SetInterpolationModeToTrilinear();
        scene.Mapper->SetBlendModeToIsoSurface();
      } },
  };
}

/// A window that is not drawn with OpenGL. Without a name it is as if nothing could draw.
class OtherWindow : public vtkRenderWindow
{
public:
  static OtherWindow* New() { VTK_STANDARD_NEW_BODY(OtherWindow); }
  const char* Name = "vtkRenderWindow";

protected:
  const char* GetClassNameInternal() const override { return this->Name; }
};

/// Draws in a window and returns what the error says.
std::string GetErrorIn(vtkRenderWindow* window, Scene& scene)
{
  vtkNew<vtkRenderer> renderer;
  if (window)
  {
    window->AddRenderer(renderer);
  }
  vtkNew<EventCounter> errors;
  const unsigned long observer = scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  scene.Mapper->Render(renderer, scene.Volume);
  scene.Mapper->RemoveObserver(observer);
  return errors->Text;
}

/// The error says what is the matter with the window, not something else.
void CheckWindows(Checks& check, Scene& scene)
{
  const auto expect = [&](vtkRenderWindow* window, const std::string& words)
  {
    const std::string error = GetErrorIn(window, scene);
    check.That(error.find(words) != std::string::npos, "it says \"" + words + "\": " + error);
  };
  expect(nullptr, "Add it to a vtkRenderWindow");
  vtkNew<OtherWindow> window;
  expect(window, "Initialize the module vtkRenderingOpenGL2");
  window->Name = "vtkWebGPURenderWindow";
  expect(window, "the render window is a vtkWebGPURenderWindow");
}

void CheckFault(Checks& check, const Fault& fault, Scene& scene, vtkImageData* image,
  const Picture& good, const Picture& empty)
{
  vtkNew<EventCounter> errors;
  const unsigned long observer = scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  fault.Make(scene, image);
  const Picture first = RenderAndCapture(scene.Window);
  scene.Window->Render();
  check.Equal(errors->Count, 1, "the number of errors, of two frames with " + fault.Name + ",");
  check.That(errors->Text.find("vtkIsosurfaceRayTraceMapper") != std::string::npos &&
      errors->Text.find(fault.Remedy) != std::string::npos,
    "the error of " + fault.Name + " says who and what to do: " + errors->Text);
  check.Equal(GetDifference(first, empty, 0), 0.0, "what is drawn of " + fault.Name);
  fault.Mend(scene, image);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), good, 0), 0.0,
    "the difference after " + fault.Name);
  check.Equal(errors->Count, 1, "the number of errors after " + fault.Name);
  fault.Make(scene, image);
  scene.Window->Render();
  check.Equal(errors->Count, 2, "the number of errors when there is again " + fault.Name);
  fault.Mend(scene, image);
  scene.Mapper->RemoveObserver(observer);
}

}

int TestIsosurfaceRayTraceMapperErrors(int, char*[])
{
  Checks check;
  const auto image = NewBall(17, 0.7);
  const vtkSmartPointer<vtkDataArray> scalars = image->GetPointData()->GetScalars();
  Scene scene(image);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(2.0, -4.0, 1.6);
  camera->SetClippingRange(1.0, 10.0);
  const Picture good = RenderAndCapture(scene.Window);
  scene.Volume->VisibilityOff();
  const Picture empty = RenderAndCapture(scene.Window);
  scene.Volume->VisibilityOn();
  check.That(GetDifference(good, empty, 0) > 0.1, "there is something to see");

  for (const Fault& fault : GetFaults(scalars))
  {
    CheckFault(check, fault, scene, image, good, empty);
  }

  CheckWindows(check, scene);

  // VTK itself skips a volume that reaches to infinity; a direct call reports the problem.
  vtkNew<EventCounter> infinityErrors;
  const unsigned long observer = scene.Mapper->AddObserver(vtkCommand::ErrorEvent, infinityErrors);
  image->SetOrigin(std::numeric_limits<double>::infinity(), 0.0, 0.0);
  scene.Mapper->Render(scene.Renderer, scene.Volume);
  check.Equal(infinityErrors->Count, 1, "the number of errors with an infinite origin");
  check.That(infinityErrors->Text.find("finite") != std::string::npos, "it says what to give");
  scene.Mapper->RemoveObserver(observer);
  image->SetOrigin(-1.0, -1.0, -1.0);

  // Without an input VTK does not call the mapper; a direct call reports what is missing.
  vtkNew<EventCounter> errors;
  vtkNew<vtkIsosurfaceRayTraceMapper> mapper;
  mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  mapper->Render(scene.Renderer, scene.Volume);
  mapper->Render(scene.Renderer, scene.Volume);
  check.Equal(errors->Count, 1, "the number of errors without an input");
  check.That(errors->Text.find("SetInputData") != std::string::npos, "it says what to call");

  vtkNew<EventCounter> settingErrors;
  mapper->AddObserver(vtkCommand::ErrorEvent, settingErrors);
  mapper->SetMacrocellBranching(8, 4);
  mapper->SetMacrocellBranching(-1, 4);
  check.Equal(mapper->GetMacrocellBranching(99), 0, "the branching of a level that is not there");
  check.Equal(settingErrors->Count, 3, "the number of errors of levels that are not there");
  mapper->SetMacrocellBranching(0, 1);
  check.Equal(mapper->GetMacrocellBranching(0), 2, "the smallest branching");
  mapper->SetTileSize(0, 100000);
  check.Equal(mapper->GetTileSize()[0], 1, "the smallest tile");
  check.Equal(mapper->GetTileSize()[1], 4096, "the largest tile");
  return check.Result();
}
