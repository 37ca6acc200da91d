// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// vtkSmartVolumeMapper in its OSPRay mode draws the picture of our mapper when, and only when, the
// factory is on.

#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfaceRayTraceFactory.h"

#include <vtkNew.h>
#include <vtkObjectFactoryCollection.h>
#include <vtkPlane.h>
#include <vtkSmartVolumeMapper.h>

#include <functional>

using namespace MapperTesting;

namespace
{

/// A ball and vectors: the picture depends on which of them is traced, and how.
vtkSmartPointer<vtkImageData> NewImage()
{
  auto image = NewBall(33, 0.7);
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("vectors");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double point[3];
    image->GetPoint(i, point);
    vectors->SetTuple3(i, point[0] - 0.5, point[1] + 0.4, 2.0 * point[2] - 0.5);
  }
  image->GetPointData()->AddArray(vectors);
  return image;
}

void SelectVectors(vtkVolumeMapper* mapper)
{
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectScalarArray("vectors");
}

struct Setting
{
  std::string Name;
  std::function<void(vtkIsosurfaceRayTraceMapper*)> ApplyToOurs;
  std::function<void(vtkSmartVolumeMapper*)> ApplyToSmart;
};

std::vector<Setting> GetSettings()
{
  const auto cut = [](vtkVolumeMapper* mapper)
  {
    vtkNew<vtkPlane> plane;
    plane->SetNormal(0.2, 0.3, -1.0);
    plane->SetOrigin(0.0, 0.0, 0.3);
    mapper->AddClippingPlane(plane);
    mapper->SetCroppingRegionPlanes(-2.0, 0.1, -2.0, 2.0, -2.0, 2.0);
    mapper->CroppingOn();
  };
  return {
    { "a ball", [](auto*) {}, [](auto*) {} },
    { "a cut ball", cut, cut },
    { "a component",
      [](vtkIsosurfaceRayTraceMapper* mapper)
      {
        SelectVectors(mapper);
        mapper->SetVectorModeToComponent();
        mapper->SetVectorComponent(2);
      },
      [](vtkSmartVolumeMapper* mapper)
      {
        SelectVectors(mapper);
        mapper->SetVectorMode(vtkSmartVolumeMapper::COMPONENT);
        mapper->SetVectorComponent(2);
      } },
    { "a magnitude",
      [](vtkIsosurfaceRayTraceMapper* mapper)
      {
        SelectVectors(mapper);
        mapper->SetVectorModeToMagnitude();
      },
      [](vtkSmartVolumeMapper* mapper)
      {
        SelectVectors(mapper);
        mapper->SetVectorMode(vtkSmartVolumeMapper::MAGNITUDE);
      } },
  };
}

vtkSmartPointer<vtkSmartVolumeMapper> NewSmartMapper(vtkImageData* image)
{
  auto mapper = vtkSmartPointer<vtkSmartVolumeMapper>::New();
  mapper->SetInputData(image);
  mapper->SetBlendModeToIsoSurface();
  mapper->SetRequestedRenderModeToOSPRay();
  return mapper;
}

void CheckPictures(Checks& check)
{
  const auto image = NewImage();
  std::vector<Picture> pictures;
  for (const Setting& setting : GetSettings())
  {
    Scene scene(image);
    scene.SetSurface(0.1, { 0.9, 0.6, 0.3 }, 1.0);
    scene.AddSurface(0.5, { 0.3, 0.6, 0.9 }, 0.5);
    setting.ApplyToOurs(scene.Mapper);
    const Picture expected = RenderAndCapture(scene.Window);
    const auto smart = NewSmartMapper(image);
    setting.ApplyToSmart(smart);
    scene.Volume->SetMapper(smart);
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference of the smart mapper with " + setting.Name);
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference of its second frame with " + setting.Name);
    scene.Volume->ReleaseGraphicsResources(scene.Window);
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference after release with " + setting.Name);
    for (const Picture& other : pictures)
    {
      check.That(GetDifference(expected, other, 2) > 0.02, setting.Name + " is another picture");
    }
    pictures.push_back(expected);
  }
}

/// What a smart mapper draws while the factory is off.
Picture DrawWithout(vtkImageData* image, bool isOSPRay)
{
  Scene scene(image);
  const auto smart = NewSmartMapper(image);
  if (!isOSPRay)
  {
    smart->SetRequestedRenderModeToGPU();
  }
  scene.Volume->SetMapper(smart);
  return RenderAndCapture(scene.Window);
}

}

int TestIsosurfaceRayTraceFactory(int, char*[])
{
  Checks check;
  const auto image = NewImage();
  const int factories = vtkObjectFactory::GetRegisteredFactories()->GetNumberOfItems();
  check.That(!vtkIsosurfaceRayTraceFactory::IsOn(), "it is off at first");
  const Picture ospray = DrawWithout(image, true);
  const Picture gpu = DrawWithout(image, false);
  Scene empty(image);
  empty.Renderer->RemoveAllViewProps();
  check.Equal(GetDifference(ospray, RenderAndCapture(empty.Window), 0), 0.0,
    "without the factory there is no OSPRay: what is drawn");

  vtkIsosurfaceRayTraceFactory::SwitchOn();
  vtkIsosurfaceRayTraceFactory::SwitchOn();
  check.That(vtkIsosurfaceRayTraceFactory::IsOn(), "it is on");
  check.Equal(vtkObjectFactory::GetRegisteredFactories()->GetNumberOfItems(), factories + 1,
    "the number of factories");
  CheckPictures(check);
  check.Equal(GetDifference(DrawWithout(image, false), gpu, 0), 0.0,
    "the difference in another mode, with the factory on");

  vtkIsosurfaceRayTraceFactory::SwitchOff();
  vtkIsosurfaceRayTraceFactory::SwitchOff();
  check.That(!vtkIsosurfaceRayTraceFactory::IsOn(), "it is off again");
  check.Equal(GetDifference(DrawWithout(image, true), ospray, 0), 0.0,
    "the difference in the OSPRay mode, with the factory off again");
  return check.Result();
}
