// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Surfaces coloured by another array, of the input or of another image: every pixel has the colour
// of its position.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkFloatArray.h>

#include <functional>

using namespace MapperTesting;

namespace
{

constexpr int Size = 120;

/// A quantity that trilinear interpolation keeps, from 0 to 1.
double Height(const AnalyticFields::Point& p)
{
  return 0.5 + 0.3 * p[2] + 0.15 * p[0] - 0.05 * p[1];
}

/// Adds an array of the height, or of a colour made of it.
vtkSmartPointer<vtkDataArray> NewHeights(vtkImageData* image, int type, int components)
{
  auto heights = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  heights->SetName("height");
  heights->SetNumberOfComponents(components);
  heights->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    AnalyticFields::Point point;
    image->GetPoint(i, point.data());
    const double height = Height(point);
    for (int component = 0; component < components; ++component)
    {
      const double value = component == 1 ? 1.0 - height : height;
      heights->SetComponent(i, component, type == VTK_FLOAT ? value : std::round(255.0 * value));
    }
  }
  return heights;
}

/// Compares the colours of all pixels with those of their positions.
void Compare(Checks& check, Scene& scene, const std::string& name, double tolerance)
{
  vtkNew<vtkImageData> picture;
  check.That(scene.Mapper->RenderToImage(
               scene.Volume, scene.Renderer->GetActiveCamera(), nullptr, Size, Size, picture),
    "there is a picture " + name);
  vtkDataArray* colors = picture->GetPointData()->GetArray("Colors");
  vtkDataArray* positions = picture->GetPointData()->GetArray("Position");
  double worst = 0.0;
  int hits = 0;
  for (vtkIdType i = 0; colors && i < colors->GetNumberOfTuples(); ++i)
  {
    if (colors->GetComponent(i, 3) == 0.0)
    {
      continue;
    }
    ++hits;
    AnalyticFields::Point position;
    positions->GetTuple(i, position.data());
    const double height = Height(position);
    worst = std::max(worst, std::abs(colors->GetComponent(i, 0) - 255.0 * height));
    worst = std::max(worst, std::abs(colors->GetComponent(i, 1) - 255.0 * (1.0 - height)));
  }
  check.That(hits > 1000, "thousands of pixels are hit " + name);
  check.Near(worst, 0.0, tolerance, "the difference of colours " + name);
}

void SetTransferFunction(Scene& scene)
{
  scene.Property()->ShadeOff();
  vtkColorTransferFunction* function = scene.Property()->GetRGBTransferFunction();
  function->RemoveAllPoints();
  function->AddRGBPoint(0.0, 0.0, 1.0, 0.0);
  function->AddRGBPoint(1.0, 1.0, 0.0, 0.0);
}

void CheckSameImage(Checks& check)
{
  for (const bool isDirect : { false, true })
  {
    const auto image = NewBall(33, 0.8);
    image->GetPointData()->AddArray(
      isDirect ? NewHeights(image, VTK_UNSIGNED_CHAR, 4) : NewHeights(image, VTK_FLOAT, 1));
    Scene scene(image);
    SetTransferFunction(scene);
    scene.Mapper->SetColorArrayName("height");
    Compare(check, scene, isDirect ? "by colours" : "by an array", isDirect ? 1.01 : 0.51);

    // Without a name it is the isovalue again.
    scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 1.0);
    scene.Mapper->SetColorArrayName(nullptr);
    const Picture plain = RenderAndCapture(scene.Window);
    check.That(
      GetDifference(plain, Picture(plain.size(), 255), 0) < 0.9, "the ball is white again");
    vtkNew<EventCounter> errors;
    scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
    scene.Mapper->SetColorArrayName("depth");
    scene.Window->Render();
    scene.Window->Render();
    check.Equal(errors->Count, 1, "the number of errors for a name that is not there");
    check.That(errors->Text.find("SetColorArrayName") != std::string::npos, "it says what to call");
  }
}

/// A coarser, larger image, rotated: only the position counts.
void CheckOtherImage(Checks& check)
{
  const auto other = vtkSmartPointer<vtkImageData>::New();
  other->SetExtent(2, 12, 5, 16, -3, 9);
  other->SetSpacing(0.3, 0.28, 0.26);
  other->SetOrigin(0.08, -3.6, -0.8);
  other->SetDirectionMatrix(0.8, -0.6, 0.0, 0.6, 0.8, 0.0, 0.0, 0.0, 1.0);
  other->GetPointData()->SetScalars(NewHeights(other, VTK_FLOAT, 1));
  Scene scene(NewBall(33, 0.6));
  SetTransferFunction(scene);
  scene.Mapper->SetColorInputData(other);
  Compare(check, scene, "by another image", 0.51);
  scene.Mapper->SetColorArrayName("height");
  Compare(check, scene, "by a named array of another image", 0.51);
}

}

int TestIsosurfaceRayTraceMapperColors(int argc, char* argv[])
{
  Checks check;
  CheckSameImage(check);
  CheckOtherImage(check);
  const auto image = NewBall(33, 0.8);
  image->GetPointData()->AddArray(NewHeights(image, VTK_FLOAT, 1));
  Scene scene(image, 200, 200);
  SetTransferFunction(scene);
  scene.Property()->ShadeOn();
  scene.Mapper->SetColorArrayName("height");
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
