// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What is picked and selected, and the properties of the pixels of a picture without a window,
// equal what a window shows.

#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "Selection.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"

#include <vtkAssembly.h>
#include <vtkAssemblyNode.h>
#include <vtkAssemblyPath.h>
#include <vtkCellPicker.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMath.h>
#include <vtkPlane.h>
#include <vtkProp3DCollection.h>
#include <vtkWorldPointPicker.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <set>

using namespace MapperTesting;

namespace
{

constexpr int Size = 120;
constexpr int Cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// The properties from RenderToImage.
struct Image
{
  vtkNew<vtkImageData> Output;

  template <typename Array>
  Array* Get(const char* name)
  {
    return Array::SafeDownCast(this->Output->GetPointData()->GetArray(name));
  }
};

/// What the window of a scene shows.
Image MakePicture(const Scene& scene)
{
  Image picture;
  scene.Mapper->RenderToImage(scene.Volume, scene.Renderer->GetActiveCamera(),
    scene.Renderer->GetLights(), Size, Size, picture.Output);
  return picture;
}

/// A ball that is moved and turned, and cut by a plane.
void Furnish(Scene& scene)
{
  scene.Volume->SetPosition(0.1, -0.2, 0.05);
  scene.Volume->RotateX(30.0);
  scene.Volume->SetScale(1.1, 0.9, 1.0);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.2, 0.3, -1.0);
  plane->SetOrigin(0.0, 0.0, 0.3);
  scene.Mapper->AddClippingPlane(plane);
}

/// A volume in an assembly is picked where it is drawn.
void CheckAssembly(Checks& check)
{
  const auto image = NewBall(33, 0.8);
  Scene scene(image, Size, Size);
  Furnish(scene);
  scene.Renderer->RemoveVolume(scene.Volume);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(scene.Volume);
  inner->RotateY(20.0);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->SetPosition(0.3, -0.1, 0.2);
  outer->SetScale(0.8);
  scene.Renderer->AddViewProp(outer);
  scene.Window->Render();
  vtkNew<vtkIsosurfacePicker> picker;
  vtkNew<vtkWorldPointPicker> depthPicker; // the point that the depth buffer shows
  int picked = 0;
  for (int x = Size / 2 - 20; x <= Size / 2 + 20; x += 5)
  {
    depthPicker->Pick(x, Size / 2, 0.0, scene.Renderer);
    const double z = static_cast<double>(scene.Renderer->GetZ(x, Size / 2));
    if (picker->Pick(x, Size / 2, 0.0, scene.Renderer) == 0)
    {
      check.Equal(z, 1.0, "the depth where nothing is picked in an assembly");
      continue;
    }
    ++picked;
    check.That(picker->GetPath()->GetLastNode()->GetViewProp() == scene.Volume.Get(),
      "the volume in the assembly is picked");
    for (int axis = 0; axis < 3; ++axis)
    {
      check.Near(picker->GetPickPosition()[axis], depthPicker->GetPickPosition()[axis], 2e-2,
        "the position picked in an assembly");
    }
  }
  check.That(picked >= 5, "the volume in the assembly is found");
  check.That(scene.Volume->GetUserMatrix() == nullptr, "the volume is as before");
}

/// Pictures without a window, made where there is no display, are those of a window.
void CheckPictures(Checks& check)
{
  const auto image = NewBall(33, 0.8);
  for (const bool isTranslucent : { false, true })
  {
    for (const bool isParallel : { false, true })
    {
      Scene scene(image, Size, Size);
      Furnish(scene);
      if (isTranslucent)
      {
        scene.SetSurface(0.0, { 0.9, 0.6, 0.3 }, 0.4);
        scene.AddSurface(0.3, { 0.3, 0.6, 0.9 }, 1.0);
      }
      vtkCamera* camera = scene.Renderer->GetActiveCamera();
      camera->SetParallelProjection(isParallel ? 1 : 0);
      for (const int type :
        { VTK_LIGHT_TYPE_HEADLIGHT, VTK_LIGHT_TYPE_CAMERA_LIGHT, VTK_LIGHT_TYPE_SCENE_LIGHT })
      {
        vtkNew<vtkLight> light;
        light->SetLightType(type);
        light->SetIntensity(0.4);
        light->SetPosition(0.3, 0.5 * type, 1.0);
        scene.Renderer->AddLight(light);
      }
      const std::string display = vtksys::SystemTools::GetEnv("DISPLAY");
      vtksys::SystemTools::UnPutEnv("DISPLAY");
      Image without;
      check.That(scene.Mapper->RenderToImage(
                   scene.Volume, camera, scene.Renderer->GetLights(), Size, Size, without.Output),
        "there is a picture without a display");
      vtksys::SystemTools::PutEnv("DISPLAY=" + display);

      scene.Renderer->SetBackground(0.0, 0.0, 0.0);
      const Picture window = RenderAndCapture(scene.Window);
      auto* colors = without.Get<vtkUnsignedCharArray>("Colors");
      check.That(colors == without.Output->GetPointData()->GetScalars(), "colours are the scalars");
      Picture rgb;
      for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
      {
        for (int channel = 0; channel < 3; ++channel)
        {
          rgb.push_back(colors->GetTypedComponent(i, channel));
        }
      }
      check.That(GetDifference(window, Picture(window.size(), 0), 0) > 0.1, "something is drawn");
      check.Equal(GetDifference(rgb, window, 0), 0.0, "the difference of a picture from a window");

      const DepthPicture depths(scene.Window, scene.Renderer);
      double worst = 0.0;
      for (int i = 0; i < Size * Size; ++i)
      {
        worst = std::max(worst,
          std::abs(depths.GetDepth(i % Size, i / Size) -
            static_cast<double>(without.Get<vtkFloatArray>("Depth")->GetValue(i))));
      }
      check.Near(worst, 0.0, 1e-6, "the difference of the depths");
    }
  }
  Scene scene(image);
  Image output;
  vtkNew<EventCounter> errors;
  scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  check.That(!scene.Mapper->RenderToImage(scene.Volume, nullptr, nullptr, 9, 9, output.Output) &&
      !scene.Mapper->RenderToImage(
        scene.Volume, scene.Renderer->GetActiveCamera(), nullptr, 0, 9, output.Output),
    "no picture without a camera or without pixels");
  check.Equal(errors->Count, 2, "the number of errors");
  check.That(scene.Mapper->RenderToImage(
               scene.Volume, scene.Renderer->GetActiveCamera(), nullptr, 40, 30, output.Output),
    "a picture without lights");
  check.That(output.Get<vtkUnsignedCharArray>("Colors")->GetTypedComponent(40 * 15 + 20, 0) > 100,
    "it has a headlight");
}

/// Every pixel of a window, picked: the position is that of the picture to the last bit, and the
/// other properties are consistent.
void CheckPicker(Checks& check)
{
  const auto image = NewBall(33, 0.8);
  image->SetExtent(3, 35, -7, 25, 0, 32);
  Scene scene(image, Size, Size);
  Furnish(scene);
  scene.SetSurface(0.0, { 0.9, 0.6, 0.3 }, 0.4);
  scene.AddSurface(0.3, { 0.3, 0.6, 0.9 }, 1.0);
  scene.LookFrom(1.0, -2.0, 0.8);
  scene.Renderer->ResetCamera();
  scene.Window->Render();
  Image picture = MakePicture(scene);
  vtkNew<vtkIsosurfacePicker> picker;
  int hits = 0;
  int wrong = 0;
  double worst = 0.0;
  for (int i = 0; i < Size * Size; i += 7)
  {
    const int picked = picker->Pick(i % Size, i / Size, 0.0, scene.Renderer);
    const vtkIdType cell = picture.Get<vtkIdTypeArray>("CellId")->GetValue(i);
    const int surface = picture.Get<vtkIntArray>("IsovalueId")->GetValue(i);
    if (cell < 0)
    {
      wrong += picked != 0 || std::isfinite(picker->GetIsovalue()) ? 1 : 0;
      continue;
    }
    ++hits;
    double position[3];
    double normal[3];
    picture.Get<vtkDoubleArray>("Position")->GetTypedTuple(i, position);
    picture.Get<vtkDoubleArray>("Normals")->GetTypedTuple(i, normal);
    const bool isSame = picked != 0 && picker->GetCellId() == cell &&
      std::equal(position, position + 3, picker->GetPickPosition()) &&
      std::equal(normal, normal + 3, picker->GetPickNormal()) &&
      picker->GetIsovalue() == (surface == 0 ? 0.0 : 0.3) &&
      picker->GetMapper() == scene.Mapper.Get() && picker->GetDataSet() == image &&
      picker->GetProp3D() == scene.Volume.Get();
    wrong += isSame ? 0 : 1;
    // Cell, coordinates and structured index lead back to the position.
    double bounds[6];
    image->GetCellBounds(picker->GetCellId(), bounds);
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    const int* index = picker->GetCellIJK();
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* pcoords = picker->GetPCoords();
      point[axis] = bounds[2 * axis] + pcoords[axis] * (bounds[2 * axis + 1] - bounds[2 * axis]);
      const double structured =
        image->GetOrigin()[axis] + image->GetSpacing()[axis] * (index[axis] + pcoords[axis]);
      worst = std::max(worst, std::abs(structured - point[axis]));
    }
    scene.Volume->GetMatrix()->MultiplyPoint(point, point);
    worst = std::max(worst, std::sqrt(vtkMath::Distance2BetweenPoints(point, position)));
  }
  check.That(hits > 150, std::to_string(hits) + " pixels are hit");
  check.Equal(wrong, 0, "the number of pixels picked wrong");
  check.Near(worst, 0.0, 1e-12, "cell and coordinates of what is picked");

  // A ray of the caller's, from above the middle, by an orientation that turns by no angle.
  const double* center = scene.Volume->GetCenter();
  double from[3] = { center[0], center[1], center[2] + 3.0 };
  double orientation[4] = { 0.0, 0.0, 0.0, 1.0 };
  check.Equal(picker->Pick3DRay(from, orientation, scene.Renderer), 1, "a ray in space picks");
  check.That(picker->GetProp3D() == scene.Volume.Get() && std::isfinite(picker->GetIsovalue()),
    "it picks the isosurface");

  // What is in front of the surface is picked instead.
  const auto actor = NewSphere(0.2, { 0.5, -1.5, 0.4 });
  scene.Renderer->AddActor(actor);
  scene.Window->Render();
  double display[3] = { 0.5, -1.5, 0.4 };
  scene.Renderer->SetWorldPoint(display[0], display[1], display[2], 1.0);
  scene.Renderer->WorldToDisplay();
  scene.Renderer->GetDisplayPoint(display);
  check.Equal(picker->Pick(display[0], display[1], 0.0, scene.Renderer), 1, "the sphere is picked");
  check.That(picker->GetProp3D() == actor.Get() && !std::isfinite(picker->GetIsovalue()),
    "and not the surface behind it");
  actor->SetPosition(-0.5, 3.0, -0.4);
  scene.Window->Render();
  check.Equal(picker->Pick(Size / 2, Size / 2, 0.0, scene.Renderer), 1, "something is picked");
  check.That(picker->GetProp3D() == scene.Volume.Get(), "it is not the sphere behind the surface");

  // VTK's pickers that read the depth buffer find the surface too.
  vtkNew<vtkWorldPointPicker> world;
  world->Pick(Size / 2, Size / 2, 0.0, scene.Renderer);
  check.Near(
    std::sqrt(vtkMath::Distance2BetweenPoints(world->GetPickPosition(), picker->GetPickPosition())),
    0.0, 0.05, "the place that vtkWorldPointPicker finds");
  vtkNew<vtkCellPicker> cells;
  cells->Pick(Size / 2, Size / 2, 0.0, scene.Renderer);
  check.That(cells->GetProp3D() == scene.Volume.Get(), "vtkCellPicker picks the volume");
}

/// At the border of the data, and of a part cut out of them, each pixel of the picture is picked.
void CheckBorders(Checks& check)
{
  const auto image = NewCube(9, [](const auto& point) { return point[0] + 0.02 * point[1]; });
  for (const bool isCut : { false, true })
  {
    Scene scene(image, Size, Size);
    scene.SetSurface(0.0, { 0.9, 0.6, 0.3 }, 1.0);
    for (const double side : { -1.0, 1.0 })
    {
      vtkNew<vtkPlane> plane;
      plane->SetOrigin(0.0, -0.2 * side, 0.0);
      plane->SetNormal(0.0, side, 0.0);
      if (isCut)
      {
        scene.Mapper->AddClippingPlane(plane);
      }
    }
    // The border of the surface is that of the bounds, and aslant to rows of pixels.
    scene.LookFrom(5.0, 0.0, 0.0);
    scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
    scene.Renderer->GetActiveCamera()->Roll(10.0);
    scene.Renderer->ResetCamera();
    scene.Window->Render();
    Image picture = MakePicture(scene);
    vtkNew<vtkIsosurfacePicker> picker;
    int wrong = 0;
    for (int i = 0; i < Size * Size; ++i)
    {
      const bool isHit = picture.Get<vtkIdTypeArray>("CellId")->GetValue(i) >= 0;
      const bool isPicked = picker->Pick(i % Size, i / Size, 0.0, scene.Renderer) != 0;
      wrong += isPicked == isHit ? 0 : 1;
    }
    check.Equal(wrong, 0, "the number of pixels picked wrong where data end");
  }
}

std::set<vtkIdType> GetCells(Scene& scene)
{
  Image picture = MakePicture(scene);
  auto* cells = picture.Get<vtkIdTypeArray>("CellId");
  std::set<vtkIdType> ids(cells->GetPointer(0), cells->GetPointer(0) + Size * Size);
  ids.erase(-1);
  return ids;
}

/// The points of an image that are nearest to what is visible.
std::set<vtkIdType> GetNearestPoints(Scene& scene, vtkImageData* image)
{
  Image picture = MakePicture(scene);
  vtkNew<vtkMatrix4x4> dataFromWorld;
  vtkMatrix4x4::Invert(scene.Volume->GetMatrix(), dataFromWorld);
  std::set<vtkIdType> ids;
  for (int i = 0; i < Size * Size; ++i)
  {
    double position[4] = { 0.0, 0.0, 0.0, 1.0 };
    picture.Get<vtkDoubleArray>("Position")->GetTypedTuple(i, position);
    if (std::isfinite(position[0]))
    {
      dataFromWorld->MultiplyPoint(position, position);
      ids.insert(image->FindPoint(position));
    }
  }
  return ids;
}

void CheckSelector(Checks& check)
{
  const auto image = NewBall(33, 0.8);
  Scene scene(image, Size, Size);
  Furnish(scene);
  const Picture before = RenderAndCapture(scene.Window);
  const std::set<vtkIdType> expected = GetCells(scene);
  check.That(expected.size() > 100, "hundreds of cells are visible");
  check.That(Select(scene.Renderer, scene.Volume, Cells) == expected,
    "the cells selected are those visible");
  const std::set<vtkIdType> points =
    Select(scene.Renderer, scene.Volume, vtkDataObject::FIELD_ASSOCIATION_POINTS);
  check.That(points == GetNearestPoints(scene, image), "the points selected are nearest to hits");
  check.Equal(GetDifference(RenderAndCapture(scene.Window), before, 0), 0.0,
    "the difference after a selection");

  // With an actor in the scene, each has its own.
  const auto actor = NewSphere(0.3, { 0.5, -1.2, 0.4 });
  scene.Renderer->AddActor(actor);
  scene.Window->Render();
  const std::set<vtkIdType> ofActor = Select(scene.Renderer, actor, Cells);
  const std::set<vtkIdType> left = Select(scene.Renderer, scene.Volume, Cells);
  check.That(!ofActor.empty() && *ofActor.rbegin() < 96, "the cells of the sphere are its own");
  check.That(!left.empty() && left.size() < expected.size() &&
      std::includes(expected.begin(), expected.end(), left.begin(), left.end()),
    "the sphere hides some cells");
  const std::set<vtkIdType> pointsLeft =
    Select(scene.Renderer, scene.Volume, vtkDataObject::FIELD_ASSOCIATION_POINTS);
  check.That(!pointsLeft.empty() && pointsLeft.size() < points.size() &&
      std::includes(points.begin(), points.end(), pointsLeft.begin(), pointsLeft.end()),
    "the sphere hides some points");
}

/// The number of pixels in which the volume is selected.
int CountSelected(Scene& scene, int association)
{
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(association);
  const auto selection = vtk::TakeSmartPointer(selector->Select());
  return selection && selection->GetNumberOfNodes() == 1
    ? selection->GetNode(0)->GetProperties()->Get(vtkSelectionNode::PIXEL_COUNT())
    : 0;
}

/// Cells and points are selected in all pixels that show something: before those of points, VTK
/// draws the usual picture, whose depth may be one of fewer or more rays.
void CheckSelectedPixels(Checks& check)
{
  const auto image = NewBall(33, 0.8);
  for (const bool isProjection : { false, true })
  {
    Scene scene(image, Size, Size);
    Furnish(scene);
    if (isProjection)
    {
      scene.Mapper->SetBlendModeToMaximumIntensity();
      scene.Property()->GetScalarOpacity()->AddPoint(-0.1, 0.0); // nothing but the ball
    }
    Image picture = MakePicture(scene);
    int shown = 0;
    for (int i = 0; i < Size * Size; ++i)
    {
      shown += picture.Get<vtkUnsignedCharArray>("Colors")->GetTypedComponent(i, 3) > 0 ? 1 : 0;
    }
    check.That(shown > 2000, "thousands of pixels show something");
    scene.Mapper->AutoAdjustSampleDistancesOff();
    for (const float distance : { 1.0F, 4.0F, 0.5F })
    {
      scene.Mapper->SetImageSampleDistance(distance);
      scene.Window->Render();
      check.Equal(CountSelected(scene, Cells), shown, "the number of pixels of cells");
      const int ofPoints = CountSelected(scene, vtkDataObject::FIELD_ASSOCIATION_POINTS);
      // With other rays the edge is another.
      check.Near(
        ofPoints, shown, distance == 1.0F ? 0.0 : 0.05 * shown, "the number of pixels of points");
      // One of four rays is enough.
      check.That(distance >= 1.0F || ofPoints > shown, "pixels at the edge are selected");
    }
  }
}

/// What polygons hide is not selected, be it a surface or a projection.
void CheckHidden(Checks& check)
{
  const auto image = NewBall(33, 0.8);
  for (const bool isProjection : { false, true })
  {
    Scene scene(image, Size, Size);
    if (isProjection)
    {
      scene.Mapper->SetBlendModeToMaximumIntensity();
    }
    const int shown = CountSelected(scene, Cells);
    check.That(shown > 2000, "thousands of pixels are selected");
    // Before the middle of the volume, and drawn first.
    const auto shield = NewSphere(0.3, { 0.7, -1.4, 0.56 }, 20);
    shield->PickableOff();
    scene.Renderer->RemoveVolume(scene.Volume);
    scene.Renderer->AddActor(shield);
    scene.Renderer->AddVolume(scene.Volume);
    check.Equal(CountSelected(scene, Cells), shown, "the number behind what is not pickable");
    shield->PickableOn();
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.Renderer);
    selector->SetArea(Size / 2, Size / 2, Size / 2, Size / 2);
    selector->SetFieldAssociation(Cells);
    const auto selection = vtk::TakeSmartPointer(selector->Select());
    check.That(selection->GetNumberOfNodes() == 1 &&
        selection->GetNode(0)->GetProperties()->Get(vtkSelectionNode::PROP()) == shield.Get(),
      "what hides the volume is selected");
  }
}

/// Ids beyond 24 bits.
void CheckLargeIds(Checks& check)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(260, 260, 260);
  image->SetSpacing(2.0 / 259, 2.0 / 259, 2.0 / 259);
  image->SetOrigin(-1.0, -1.0, -1.0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill_n(values, image->GetNumberOfPoints(), std::uint8_t{ 0 });
  std::fill_n(values, 257 * 260 * 260, std::uint8_t{ 200 });
  Scene scene(image, Size, Size);
  scene.SetSurface(100.0, { 0.9, 0.8, 0.7 }, 1.0);
  scene.LookFrom(0.3, -0.2, 2.0);
  scene.Window->Render();
  const std::set<vtkIdType> expected = GetCells(scene);
  check.That(!expected.empty() && *expected.begin() > 1 << 24, "the ids are large");
  check.That(
    Select(scene.Renderer, scene.Volume, Cells) == expected, "large ids are selected whole");
}

}

int TestIsosurfacePicking(int, char*[])
{
  Checks check;
  CheckAssembly(check);
  CheckPictures(check);
  CheckPicker(check);
  CheckBorders(check);
  CheckSelector(check);
  CheckSelectedPixels(check);
  CheckHidden(check);
  CheckLargeIds(check);
  return check.Result();
}
