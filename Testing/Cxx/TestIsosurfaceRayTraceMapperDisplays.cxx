// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Stereo in every mode that VTK has off screen, and pictures made of tiles: the ball is where its
// polygons are, and tiles fit together.

#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkCallbackCommand.h>
#include <vtkMath.h>
#include <vtkProperty.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>

using namespace MapperTesting;

namespace
{

constexpr double Radius = 0.7;

vtkSmartPointer<vtkActor> NewPolygons()
{
  auto actor = NewSphere(Radius, { 0.0, 0.0, 0.0 }, 300);
  actor->GetProperty()->SetColor(0.9, 0.8, 0.7);
  return actor;
}

/// A ball with the look that the polygons have.
struct MattScene : Scene
{
  explicit MattScene(vtkImageData* image, int width = 160, int height = 160)
    : Scene(image, width, height)
  {
    this->Property()->SetAmbient(0.0);
    this->Property()->SetDiffuse(1.0);
    this->Property()->SetSpecular(0.0);
  }
};

void CheckStereo(Checks& check, vtkImageData* image, int type, bool isOffScreen)
{
  const std::string name =
    std::to_string(type) + " " + vtkRenderWindow::GetStereoTypeAsString(type);
  MattScene scene(image, 200, 160);
  scene.Window->SetOffScreenRendering(isOffScreen);
  const Picture mono = RenderAndCapture(scene.Window);
  scene.Renderer->GetActiveCamera()->SetEyeAngle(4.0);
  scene.Window->SetStereoType(type);
  scene.Window->StereoRenderOn();
  // VTK_STEREO_EMULATE shows one eye after the other: two frames for each, and both show the same.
  scene.Window->Render();
  const Picture traced = RenderAndCapture(scene.Window);
  scene.Renderer->RemoveVolume(scene.Volume);
  scene.Renderer->AddActor(NewPolygons());
  scene.Window->Render();
  const Picture polygons = RenderAndCapture(scene.Window);
  const double difference = GetDifference(traced, polygons, 4);
  const double fromMono = GetDifference(traced, mono, 4);
  std::cout << name << ": " << 100.0 * difference << " % of the pixels differ, " << 100.0 * fromMono
            << " % from mono\n";
  check.That(difference < 0.001, name + ": it is where its polygons are");
  check.That(fromMono > 0.01, name + ": it is not the picture for one eye");
}

Picture ToPicture(vtkImageData* image)
{
  auto* pixels = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
}

/// vtkWindowToImageFilter makes a large picture of tiles (vtkWindow::SetTileScale).
void CheckScaledPictures(Checks& check, vtkImageData* image)
{
  for (const int scale : { 2, 3 })
  {
    for (const bool isParallel : { false, true })
    {
      MattScene large(image, 160 * scale, 120 * scale);
      large.Renderer->GetActiveCamera()->SetParallelProjection(isParallel ? 1 : 0);
      const Picture expected = RenderAndCapture(large.Window);
      MattScene small(image, 160, 120);
      small.Renderer->GetActiveCamera()->SetParallelProjection(isParallel ? 1 : 0);
      small.Window->Render();
      vtkNew<vtkWindowToImageFilter> filter;
      filter->SetInput(small.Window);
      filter->SetScale(scale);
      filter->Update();
      const double difference = GetDifference(ToPicture(filter->GetOutput()), expected, 1);
      std::cout << "scale " << scale << ": " << 100.0 * difference << " % of the pixels differ\n";
      check.That(difference < 1e-4, "a picture of tiles is one of a large window");
    }
  }
}

/// Copies the picture of a quarter to its position.
void Insert(const Picture& quarter, int width, int height, int column, int row, Picture& whole)
{
  for (int y = 0; y < height; ++y)
  {
    const std::size_t from = static_cast<std::size_t>(3 * y * width);
    const std::size_t to =
      static_cast<std::size_t>(3 * ((y + row * height) * 2 * width + column * width));
    std::copy_n(quarter.begin() + static_cast<std::ptrdiff_t>(from), 3 * width,
      whole.begin() + static_cast<std::ptrdiff_t>(to));
  }
}

/// Four displays, each with a quarter of the view, show what a large one does.
void CheckWall(Checks& check, vtkImageData* image)
{
  constexpr int Width = 100;
  constexpr int Height = 80;
  MattScene large(image, 2 * Width, 2 * Height);
  const Picture expected = RenderAndCapture(large.Window);
  Picture wall(expected.size());
  for (const int column : { 0, 1 })
  {
    for (const int row : { 0, 1 })
    {
      MattScene tile(image, Width, Height);
      vtkCamera* camera = tile.Renderer->GetActiveCamera();
      const double half = vtkMath::RadiansFromDegrees(camera->GetViewAngle() / 2.0);
      camera->SetViewAngle(2.0 * vtkMath::DegreesFromRadians(std::atan(std::tan(half) / 2.0)));
      camera->SetWindowCenter(2.0 * column - 1.0, 2.0 * row - 1.0);
      Insert(RenderAndCapture(tile.Window), Width, Height, column, row, wall);
    }
  }
  check.That(GetDifference(wall, expected, 1) < 1e-4, "a wall of displays shows the whole");
}

/// A picture for both eyes, made of tiles.
void CheckScaledStereo(Checks& check, vtkImageData* image)
{
  Picture pictures[2];
  for (const bool isPolygons : { false, true })
  {
    MattScene scene(image, 100, 80);
    if (isPolygons)
    {
      scene.Renderer->RemoveVolume(scene.Volume);
      scene.Renderer->AddActor(NewPolygons());
    }
    scene.Window->SetStereoTypeToAnaglyph();
    scene.Window->StereoRenderOn();
    scene.Window->Render();
    vtkNew<vtkWindowToImageFilter> filter;
    filter->SetInput(scene.Window);
    filter->SetScale(2);
    filter->Update();
    pictures[isPolygons ? 1 : 0] = ToPicture(filter->GetOutput());
  }
  check.That(GetDifference(pictures[0], pictures[1], 4) < 0.001,
    "a stereo picture of tiles is that of its polygons");
}

/// While interacting, both eyes have pixels of the same size, which is that of a single eye.
void CheckHurry(Checks& check, vtkImageData* image)
{
  for (const int type :
    { VTK_STEREO_SPLITVIEWPORT_HORIZONTAL, VTK_STEREO_ANAGLYPH, VTK_STEREO_LEFT, VTK_STEREO_RIGHT })
  {
    const std::string name = vtkRenderWindow::GetStereoTypeAsString(type);
    MattScene scene(image, 200, 160);
    scene.Window->SetStereoType(type);
    scene.Window->StereoRenderOn();
    std::vector<double> distances;
    vtkNew<vtkCallbackCommand> note;
    note->SetClientData(&distances);
    note->SetCallback(
      [](vtkObject* mapper, unsigned long, void* list, void*)
      {
        static_cast<std::vector<double>*>(list)->push_back(static_cast<double>(
          static_cast<vtkIsosurfaceRayTraceMapper*>(mapper)->GetImageSampleDistance()));
      });
    scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderEndEvent, note);
    // Before the first frame its time is unknown.
    scene.Window->SetDesiredUpdateRate(100000.0);
    scene.Window->Render();
    scene.Window->Render();
    scene.Window->SetDesiredUpdateRate(0.0001);
    scene.Window->Render();
    const bool isOne = type == VTK_STEREO_LEFT || type == VTK_STEREO_RIGHT;
    const std::vector<double> expected = isOne
      ? std::vector<double>{ 1.0, 10.0, 1.0 }
      : std::vector<double>{ 1.0, 1.0, 10.0, 10.0, 1.0, 1.0 };
    check.That(distances == expected, name + ": both eyes have the same distance of rays");
  }
}

}

int TestIsosurfaceRayTraceMapperDisplays(int, char*[])
{
  Checks check;
  const auto image = NewBall(65, Radius);
  // VTK_STEREO_CRYSTAL_EYES needs a display with two pictures.
  for (const bool isOffScreen : { false, true })
  {
    for (const int type : { VTK_STEREO_RED_BLUE, VTK_STEREO_INTERLACED, VTK_STEREO_LEFT,
           VTK_STEREO_RIGHT, VTK_STEREO_DRESDEN, VTK_STEREO_ANAGLYPH, VTK_STEREO_CHECKERBOARD,
           VTK_STEREO_SPLITVIEWPORT_HORIZONTAL, VTK_STEREO_FAKE, VTK_STEREO_EMULATE })
    {
      CheckStereo(check, image, type, isOffScreen);
    }
  }
  CheckHurry(check, image);
  CheckScaledPictures(check, image);
  CheckScaledStereo(check, image);
  CheckWall(check, image);
  return check.Result();
}
