// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The picture of a scene at rest improves with every frame, and is restarted by whatever changes
// it.

#include "AnalyticFields.h"
#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfaceVolume.h"

#include <vtkHardwareSelector.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPlane.h>
#include <vtkRectilinearGrid.h>
#include <vtkSelection.h>
#include <vtkWindowToImageFilter.h>

#include <cstring>
#include <functional>

using namespace MapperTesting;

namespace
{

void RenderTimes(vtkRenderWindow* window, int times)
{
  for (int i = 0; i < times; ++i)
  {
    window->Render();
  }
}

/// The root mean square of the differences of two pictures.
double GetDeviation(const Picture& a, const Picture& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// One colour, so that pictures differ in edges alone.
void SetFlat(Scene& scene, double opacity)
{
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, opacity);
  scene.Property()->ShadeOff();
}

/// The edge of a ball before a background of another colour becomes that of sixteen rays for every
/// pixel, and the first frame is the picture without.
void CheckEdges(Checks& check, vtkImageData* image)
{
  for (const double opacity : { 1.0, 0.6 })
  {
    Scene scene(image);
    SetFlat(scene, opacity);
    const Picture plain = RenderAndCapture(scene.Window);
    const DepthPicture plainDepths(scene.Window, scene.Renderer);
    scene.Mapper->AutoAdjustSampleDistancesOff();
    scene.Mapper->SetImageSampleDistance(0.25F);
    const Picture smooth = RenderAndCapture(scene.Window);
    scene.Mapper->SetImageSampleDistance(1.0F);
    scene.Mapper->ProgressiveAccumulationOn();
    check.Equal(GetDifference(RenderAndCapture(scene.Window), plain, 0), 0.0,
      "the difference of the first frame");
    check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 1, "the number of frames at first");
    RenderTimes(scene.Window, 14);
    const Picture mean = RenderAndCapture(scene.Window);
    check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 16, "the number of frames");
    const double before = GetDeviation(plain, smooth);
    const double after = GetDeviation(mean, smooth);
    check.That(before > 3.0, "edges were not smooth: " + std::to_string(before));
    check.That(after < 0.28 * before, "they become so: " + std::to_string(after / before));
    const DepthPicture depths(scene.Window, scene.Renderer);
    int wrong = 0;
    for (int y = 0; y < depths.GetHeight(); ++y)
    {
      for (int x = 0; x < depths.GetWidth(); ++x)
      {
        wrong += depths.GetDepth(x, y) != plainDepths.GetDepth(x, y) ? 1 : 0;
      }
    }
    check.Equal(wrong, 0, "the number of depths that are not those of the first frame");
  }
}

/// Surfaces that are visible through each other, in front of and behind polygons, become those of
/// many rays.
void CheckTranslucent(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.SetSurface(0.0, { 0.9, 0.2, 0.1 }, 0.4);
  scene.AddSurface(0.2, { 0.1, 0.9, 0.2 }, 0.5);
  scene.AddSurface(0.4, { 0.2, 0.3, 0.9 }, 1.0);
  scene.Renderer->AddActor(NewSphere(0.3, { 0.5, -1.0, 0.4 }, 40));
  scene.Renderer->AddActor(NewSphere(0.4, { -0.6, 0.9, 0.0 }, 40));
  scene.Renderer->ResetCameraClippingRange();
  scene.Mapper->AutoAdjustSampleDistancesOff();
  const Picture plain = RenderAndCapture(scene.Window);
  scene.Mapper->SetImageSampleDistance(0.25F);
  const Picture smooth = RenderAndCapture(scene.Window);
  scene.Mapper->SetImageSampleDistance(1.0F);
  scene.Mapper->ProgressiveAccumulationOn();
  check.Equal(GetDifference(RenderAndCapture(scene.Window), plain, 0), 0.0,
    "the difference of the first frame of translucent surfaces");
  RenderTimes(scene.Window, 14);
  const Picture mean = RenderAndCapture(scene.Window);
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 16, "the number of frames");
  const double before = GetDeviation(plain, smooth);
  const double after = GetDeviation(mean, smooth);
  check.That(before > 1.0, "edges of translucent surfaces: " + std::to_string(before));
  check.That(after < 0.35 * before, "they become smooth: " + std::to_string(after / before));

  // They are not opaque geometry, and each frame is drawn once.
  vtkNew<vtkIsosurfaceVolume> volume;
  volume->ShallowCopy(scene.Volume);
  scene.Renderer->RemoveViewProp(scene.Volume);
  scene.Renderer->AddViewProp(volume);
  scene.Mapper->Modified();
  RenderTimes(scene.Window, 15);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), mean, 0), 0.0,
    "the difference of the mean in a vtkIsosurfaceVolume");
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 16, "the number of its frames");
}

/// A pixel that shares its ray with others improves as well.
void CheckSupersampled(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  SetFlat(scene, 1.0);
  scene.Mapper->AutoAdjustSampleDistancesOff();
  scene.Mapper->SetImageSampleDistance(0.1F);
  const Picture best = RenderAndCapture(scene.Window);
  scene.Mapper->SetImageSampleDistance(0.5F);
  const Picture plain = RenderAndCapture(scene.Window);
  scene.Mapper->ProgressiveAccumulationOn();
  check.Equal(GetDifference(RenderAndCapture(scene.Window), plain, 0), 0.0,
    "the difference of the first frame of several rays");
  RenderTimes(scene.Window, 14);
  const double ratio =
    GetDeviation(RenderAndCapture(scene.Window), best) / GetDeviation(plain, best);
  check.That(ratio < 0.4, "several rays become more: " + std::to_string(ratio));
}

/// After the last frame nothing is traced, and the picture stays.
void CheckEnd(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.Mapper->ProgressiveAccumulationOn();
  scene.Mapper->SetMaximumNumberOfAccumulatedFrames(3);
  RenderTimes(scene.Window, 2);
  check.That(scene.Mapper->GetTraceTime() > 0.0, "a frame is traced");
  const Picture last = RenderAndCapture(scene.Window);
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 3, "the number of frames at the end");
  vtkNew<EventCounter> steps;
  scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderProgressEvent, steps);
  check.Equal(
    GetDifference(RenderAndCapture(scene.Window), last, 0), 0.0, "the difference after the end");
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 3, "the number of frames after it");
  check.Equal(scene.Mapper->GetTraceTime(), 0.0, "the time of tracing after it");
  check.Equal(steps->Count, 0, "the number of steps of progress after it");

  scene.Mapper->ProgressiveAccumulationOff();
  scene.Window->Render();
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 0, "the number of frames when off");
}

struct Change
{
  const char* Name;
  std::function<void()> Make;
};

/// Whatever changes the picture restarts it: it equals the picture without accumulation.
void CheckRestarts(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.0, 0.0, -0.9);
  plane->SetNormal(0.0, 0.0, 1.0);
  scene.Mapper->AddClippingPlane(plane);
  const auto front = NewSphere(0.3, { 0.5, -1.0, 0.4 }, 20);
  scene.Renderer->AddActor(front);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  scene.Renderer->ResetCameraClippingRange();
  scene.Mapper->ProgressiveAccumulationOn();
  RenderTimes(scene.Window, 3);
  vtkLight* light = vtkLight::SafeDownCast(scene.Renderer->GetLights()->GetItemAsObject(0));
  vtkVolumeProperty* property = scene.Property();
  vtkNew<vtkColorTransferFunction> blue;
  blue->AddRGBPoint(0.0, 0.1, 0.2, 0.9);
  const std::vector<Change> changes = {
    { "the camera", [&] { camera->Azimuth(1.0); } },
    { "the view angle", [&] { camera->Zoom(1.1); } },
    { "the clipping range", [&] { camera->SetClippingRange(1.5, 10.0); } },
    { "the isovalue", [&] { property->GetIsoSurfaceValues()->SetValue(0, 0.05); } },
    { "the colour", [&] { property->GetRGBTransferFunction()->AddRGBPoint(0.05, 0.2, 0.9, 0.3); } },
    { "another colour function", [&] { property->SetColor(blue); } },
    { "the material", [&] { property->SetSpecular(0.7); } },
    { "the opacity", [&] { property->GetScalarOpacity()->AddPoint(0.05, 0.5); } },
    { "the colour of the light", [&] { light->SetColor(1.0, 0.5, 0.5); } },
    { "the position of the light",
      [&]
      {
        light->SetLightTypeToSceneLight();
        light->SetPosition(-3.0, -2.0, 5.0);
      } },
    { "two-sided lighting", [&] { scene.Renderer->SetTwoSidedLighting(0); } },
    { "a setting of the mapper", [&] { scene.Mapper->SetNormalModeToInterpolantGradient(); } },
    { "the position of the volume", [&] { scene.Volume->SetPosition(0.1, 0.0, 0.0); } },
    { "a clipping plane", [&] { plane->SetOrigin(0.0, 0.0, -0.2); } },
    { "the actor in front", [&] { front->SetPosition(-0.3, 0.1, 0.0); } },
    { "the samples",
      [&]
      {
        vtkDataArray* scalars = image->GetPointData()->GetScalars();
        for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
        {
          scalars->SetTuple1(i, scalars->GetTuple1(i) + 0.1);
        }
        scalars->Modified();
      } },
    { "the size of the window", [&] { scene.Window->SetSize(150, 170); } },
    { "the viewport", [&] { scene.Renderer->SetViewport(0.0, 0.0, 0.8, 0.9); } },
    { "the distance of rays", [&] { scene.Mapper->SetMinimumImageSampleDistance(0.5F); } },
  };
  for (const Change& change : changes)
  {
    RenderTimes(scene.Window, 2);
    check.That(scene.Mapper->GetNumberOfAccumulatedFrames() > 1,
      std::string("frames are accumulated before ") + change.Name + " changes");
    change.Make();
    const Picture first = RenderAndCapture(scene.Window);
    check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 1,
      std::string("the number of frames after a change of ") + change.Name);
    scene.Mapper->ProgressiveAccumulationOff();
    check.Equal(GetDifference(RenderAndCapture(scene.Window), first, 0), 0.0,
      std::string("the difference of the picture after a change of ") + change.Name);
    scene.Mapper->ProgressiveAccumulationOn();
  }
}

/// The samples of a block, and the coordinates of a grid, do not affect the modification time of
/// the input.
void CheckInputs(Checks& check)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  const auto image = NewBall(33, 0.7);
  blocks->SetBlock(0, image);
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(33, 33, 33);
  vtkNew<vtkDoubleArray> coordinates;
  for (int i = 0; i < 33; ++i)
  {
    coordinates->InsertNextValue(i / 16.0 - 1.0);
  }
  grid->SetXCoordinates(coordinates);
  grid->SetYCoordinates(coordinates);
  grid->SetZCoordinates(coordinates);
  grid->GetPointData()->SetScalars(image->GetPointData()->GetScalars());
  const auto checkChange = [&check](Scene& scene, const std::function<void()>& change)
  {
    scene.Mapper->ProgressiveAccumulationOn();
    RenderTimes(scene.Window, 2);
    check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 2, "the number of frames of a grid");
    change();
    scene.Window->Render();
    check.Equal(
      scene.Mapper->GetNumberOfAccumulatedFrames(), 1, "the number of frames of a changed grid");
  };
  Scene uneven(grid);
  checkChange(uneven,
    [&]
    {
      coordinates->SetValue(10, coordinates->GetValue(10) + 0.03);
      coordinates->Modified();
    });
  Scene composite(blocks);
  checkChange(composite,
    [&]
    {
      image->GetPointData()->GetScalars()->SetTuple1(33 * 33 * 16, -1.0);
      image->GetPointData()->GetScalars()->Modified();
    });
}

/// Frames of other kinds leave the mean as it is.
void CheckIntact(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.Mapper->SetNumberOfThreads(1);
  scene.Mapper->ProgressiveAccumulationOn();
  RenderTimes(scene.Window, 4);
  const Picture five = RenderAndCapture(scene.Window);
  const Picture six = RenderAndCapture(scene.Window);
  check.That(GetDifference(five, six, 0) > 0.0, "one more frame changes the picture");

  const std::vector<Change> disturbances = {
    { "an aborted frame",
      [&]
      {
        RenderAndAbort(scene.Window);
        check.Equal(
          scene.Mapper->GetNumberOfAccumulatedFrames(), 5, "the number of frames after an abort");
      } },
    { "a coarse frame",
      [&]
      {
        scene.Window->SetDesiredUpdateRate(100000.0);
        scene.Window->Render();
        check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 0, "the number of coarse frames");
        scene.Window->SetDesiredUpdateRate(0.0001);
      } },
    { "a selection",
      [&]
      {
        vtkNew<vtkHardwareSelector> selector;
        selector->SetRenderer(scene.Renderer);
        selector->SetArea(0, 0, 159, 159);
        const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
        check.Equal(selection->GetNumberOfNodes(), 1U, "the number of props selected");
      } },
    { "a pick",
      [&]
      {
        double x[3];
        double pcoords[3];
        double normal[3];
        double isovalue = 0.0;
        vtkIdType cell = -1;
        check.Equal(scene.Mapper->PickPixel(
                      scene.Renderer, scene.Volume, 80, 80, x, pcoords, cell, isovalue, normal),
          1, "what is picked");
      } },
    { "a picture without a window",
      [&]
      {
        vtkNew<vtkImageData> picture;
        scene.Mapper->RenderToImage(
          scene.Volume, scene.Renderer->GetActiveCamera(), nullptr, 90, 70, picture);
      } },
  };
  for (const Change& disturbance : disturbances)
  {
    scene.Mapper->Modified();
    RenderTimes(scene.Window, 5);
    disturbance.Make();
    check.Equal(GetDifference(RenderAndCapture(scene.Window), six, 0), 0.0,
      std::string("the difference of the sixth frame after ") + disturbance.Name);
    check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 6,
      std::string("the number of frames after ") + disturbance.Name);
  }
}

/// A picture without a window is the mean that a window comes to, at once; the rest is as without.
void CheckWithoutWindow(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.Renderer->SetBackground(0.0, 0.0, 0.0);
  scene.Mapper->AmbientOcclusionOn();
  scene.Mapper->SetNumberOfAmbientOcclusionRays(2);
  scene.Property()->SetAmbient(0.5);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  vtkNew<vtkImageData> plain;
  scene.Mapper->RenderToImage(scene.Volume, camera, nullptr, 160, 160, plain);
  scene.Mapper->ProgressiveAccumulationOn();
  vtkNew<vtkImageData> mean;
  scene.Mapper->RenderToImage(scene.Volume, camera, nullptr, 160, 160, mean);
  RenderTimes(scene.Window, 16);
  const Picture shown = Capture(scene.Window);
  int different = 0;
  int smooth = 0;
  for (vtkIdType pixel = 0; pixel < mean->GetNumberOfPoints(); ++pixel)
  {
    double color[4];
    mean->GetPointData()->GetScalars()->GetTuple(pixel, color);
    for (int channel = 0; channel < 3; ++channel)
    {
      different += color[channel] != shown[static_cast<std::size_t>(3 * pixel + channel)] ? 1 : 0;
    }
    smooth += color[3] > 0.0 && color[3] < 255.0 ? 1 : 0;
  }
  check.Equal(different, 0, "the number of colours that a window shows otherwise");
  check.That(smooth > 100, "edges are smooth without a window");
  for (const char* name : { "Depth", "Normals", "Position", "CellId", "IsovalueId" })
  {
    vtkDataArray* before = plain->GetPointData()->GetArray(name);
    vtkDataArray* after = mean->GetPointData()->GetArray(name);
    check.Equal(std::memcmp(before->GetVoidPointer(0), after->GetVoidPointer(0),
                  static_cast<std::size_t>(before->GetDataSize() * before->GetDataTypeSize())),
      0, std::string("the difference of ") + name);
  }
}

/// Coarse pictures are chosen by the time of those that were traced.
void CheckHurry(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.Mapper->ProgressiveAccumulationOn();
  scene.Mapper->SetMaximumNumberOfAccumulatedFrames(2);
  RenderTimes(scene.Window, 4);
  check.Equal(scene.Mapper->GetTraceTime(), 0.0, "the time of tracing");
  scene.Window->SetDesiredUpdateRate(100000.0);
  scene.Window->Render();
  check.Equal(
    scene.Mapper->GetImageSampleDistance(), 10.0F, "the distance while interacting after rest");
}

/// A picture that is taken of the window is the mean.
void CheckScreenshot(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  const auto front = NewSphere(0.3, { 0.5, -1.0, 0.4 }, 20);
  scene.Renderer->AddActor(front);
  scene.Renderer->ResetCameraClippingRange();
  scene.Mapper->ProgressiveAccumulationOn();
  scene.Mapper->SetMaximumNumberOfAccumulatedFrames(4);
  RenderTimes(scene.Window, 3);
  const Picture mean = RenderAndCapture(scene.Window);
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(scene.Window);
  filter->Update();
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 4, "the number of frames taken");
  auto* pixels =
    vtkUnsignedCharArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetScalars());
  check.Equal(
    GetDifference(
      Picture(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues()), mean, 0),
    0.0, "the difference of the picture taken");
}

/// Each eye has its own mean.
void CheckStereo(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.Mapper->ProgressiveAccumulationOn();
  scene.Window->SetStereoTypeToAnaglyph();
  scene.Window->StereoRenderOn();
  RenderTimes(scene.Window, 4);
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 4, "the number of frames in stereo");
}

/// So has each renderer: a volume that is seen by two comes to rest in both, as it would in one.
void CheckRenderers(Checks& check, vtkImageData* image)
{
  Scene alone(image, 80, 80);
  alone.LookFrom(0.3, -1.0, 2.0);
  alone.Mapper->ProgressiveAccumulationOn();
  RenderTimes(alone.Window, 4);
  const Picture expected = RenderAndCapture(alone.Window);

  Scene scene(image, 160, 80);
  scene.Mapper->ProgressiveAccumulationOn();
  scene.Renderer->SetViewport(0.5, 0.0, 1.0, 1.0);
  {
    Scene other(image, 80, 80);
    other.Renderer->RemoveAllViewProps();
    other.Renderer->AddVolume(scene.Volume);
    other.LookFrom(0.3, -1.0, 2.0);
    for (int i = 1; i <= 4; ++i)
    {
      scene.Window->Render();
      check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), i, "the number of frames");
      other.Window->Render();
      check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), i, "that of another window");
    }
    check.Equal(GetDifference(RenderAndCapture(other.Window), expected, 0), 0.0,
      "the difference of the other window");
  }
  scene.Window->Render();
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 5, "the number without the other");
}

/// And so has each volume of a mapper.
void CheckVolumes(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.Mapper->ProgressiveAccumulationOn();
  vtkNew<vtkVolume> other;
  other->SetMapper(scene.Mapper);
  other->SetProperty(scene.Property());
  other->SetPosition(0.3, 0.2, 0.1);
  scene.Renderer->AddVolume(other);
  for (int i = 1; i <= 4; ++i)
  {
    scene.Window->Render();
    check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), i, "the number of two volumes");
  }
}

/// The picture is the same for any number of threads.
void CheckThreads(Checks& check, vtkImageData* image)
{
  Picture pictures[2];
  for (const int threads : { 1, 3 })
  {
    Scene scene(image);
    scene.Mapper->SetNumberOfThreads(threads);
    scene.Mapper->ProgressiveAccumulationOn();
    RenderTimes(scene.Window, 4);
    pictures[threads / 3] = RenderAndCapture(scene.Window);
  }
  check.Equal(GetDifference(pictures[0], pictures[1], 0), 0.0, "the difference by threads");
}

/// A ball in front of a wall, lit by ambient light alone, with few rays.
void SetSky(Scene& scene)
{
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 1.0);
  scene.Property()->SetAmbient(1.0);
  scene.Property()->SetDiffuse(0.0);
  scene.Property()->SetSpecular(0.0);
  scene.Mapper->AmbientOcclusionOn();
  scene.Mapper->SetNumberOfAmbientOcclusionRays(4);
}

/// The noise of few rays vanishes: its variance falls with the number of frames. Elsewhere the
/// pictures differ little, since edges are smooth in all.
void CheckGrain(Checks& check, int argc, char* argv[])
{
  const auto image = NewCube(65,
    [](const AnalyticFields::Point& p)
    { return std::max(-0.5 - p[2], 0.4 - std::hypot(p[0], p[1], p[2] + 0.05)); });
  Scene scene(image, 200, 200);
  SetSky(scene);
  scene.Mapper->ProgressiveAccumulationOn();
  scene.Mapper->SetMaximumNumberOfAccumulatedFrames(64);
  const Picture first = RenderAndCapture(scene.Window);
  RenderTimes(scene.Window, 14);
  const Picture sixteen = RenderAndCapture(scene.Window);
  RenderTimes(scene.Window, 47);
  const Picture last = RenderAndCapture(scene.Window);
  check.Equal(scene.Mapper->GetNumberOfAccumulatedFrames(), 64, "the number of frames");
  const double before = std::pow(GetDeviation(first, last), 2);
  const double after = std::pow(GetDeviation(sixteen, last), 2);
  std::cout << "The variance of 1 frame: " << before << ", of 16: " << after << "\n";
  check.That(before > 100.0, "one frame has grain: " + std::to_string(before));
  check.That(after < before / 12.0, "sixteen have less: " + std::to_string(after / before));
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is that of the baseline");
}

}

int TestIsosurfaceRayTraceMapperAccumulation(int argc, char* argv[])
{
  Checks check;
  const auto image = NewBall(33, 0.7);
  CheckEdges(check, image);
  CheckTranslucent(check, image);
  CheckSupersampled(check, image);
  CheckEnd(check, image);
  CheckRestarts(check, NewBall(33, 0.7));
  CheckInputs(check);
  CheckIntact(check, image);
  CheckHurry(check, image);
  CheckScreenshot(check, image);
  CheckWithoutWindow(check, image);
  CheckStereo(check, image);
  CheckRenderers(check, image);
  CheckVolumes(check, image);
  CheckThreads(check, image);
  CheckGrain(check, argc, argv);
  return check.Result();
}
