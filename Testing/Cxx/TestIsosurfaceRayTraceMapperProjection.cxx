// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Maximum and minimum intensity: the values are those of geometry, the pictures those of VTK's ray
// casters with many samples, and all other properties of a pixel belong to its value.

#include "AnalyticFields.h"
#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkFloatArray.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkHardwareSelector.h>
#include <vtkMath.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkTrivialProducer.h>

#include <functional>
#include <limits>

using namespace MapperTesting;

namespace
{

using AnalyticFields::Point;

constexpr int Size = 160;

/// A ball of fog, 1 in the middle.
double Fog(const Point& p)
{
  return std::exp(-4.0 * vtkMath::Dot(p, p));
}

/// A skull of sorts, with an arch of bright teeth and a dark vessel.
double Head(const Point& p)
{
  const double radius = std::hypot(p[0] / 0.75, p[1] / 0.9, p[2] / 0.8);
  double value = radius < 1.0 ? 0.15 : 0.0;
  value = std::max(value, 0.6 * std::exp(-std::pow((radius - 0.9) / 0.08, 2)));
  for (int tooth = -3; tooth <= 3; ++tooth)
  {
    const double angle = 0.3 * tooth;
    const double distance =
      std::hypot(p[0] - 0.5 * std::sin(angle), p[1] + 0.65 * std::cos(angle), p[2] + 0.45);
    value = std::max(value, std::min(1.0, (0.11 - distance) * 20.0));
  }
  return value;
}

/// Grey for what is above 0.1, blue below, and the less opaque the smaller.
void SetLook(vtkVolumeProperty* property)
{
  property->SetInterpolationTypeToLinear();
  property->GetRGBTransferFunction()->RemoveAllPoints();
  property->GetRGBTransferFunction()->AddRGBPoint(0.0, 0.2, 0.3, 0.9);
  property->GetRGBTransferFunction()->AddRGBPoint(0.2, 0.5, 0.45, 0.4);
  property->GetRGBTransferFunction()->AddRGBPoint(1.0, 1.0, 1.0, 0.95);
  property->GetScalarOpacity()->RemoveAllPoints();
  property->GetScalarOpacity()->AddPoint(0.05, 0.0);
  property->GetScalarOpacity()->AddPoint(0.7, 1.0);
}

struct ProjectedScene : Scene
{
  explicit ProjectedScene(vtkImageData* image)
    : Scene(image, Size, Size)
  {
    this->Mapper->SetBlendModeToMaximumIntensity();
    SetLook(this->Property());
  }
};

double GetValue(vtkImageData* picture, const char* name, vtkIdType pixel)
{
  return picture->GetPointData()->GetArray(name)->GetTuple1(pixel);
}

//------------------------------------------------------------------------------
/// Along a ray that passes the middle of fog at a distance, the fog is densest there.
void CheckValues(Checks& check)
{
  ProjectedScene scene(NewCube(81, Fog));
  const auto picture = scene.RenderToImage();
  double eye[3];
  scene.Renderer->GetActiveCamera()->GetPosition(eye);
  int inside = 0;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    Point position;
    picture->GetPointData()->GetArray("Position")->GetTuple(i, position.data());
    if (std::isnan(position[0]) || Fog(position) < 0.1)
    {
      continue; // nothing, or where rays are cut by the border of the cube
    }
    ++inside;
    check.Near(GetValue(picture, "Value", i), Fog(position), 2e-3, "the value at its position");
    // The point nearest to the middle sees it at a right angle.
    Point toEye;
    vtkMath::Subtract(eye, position.data(), toEye.data());
    vtkMath::Normalize(toEye.data());
    check.Near(vtkMath::Dot(toEye, position), 0.0, 0.02, "how much nearer the ray comes elsewhere");
    double clip[4] = { position[0], position[1], position[2], 1.0 };
    scene.Renderer->GetActiveCamera()
      ->GetCompositeProjectionTransformMatrix(1.0, 0.0, 1.0)
      ->MultiplyPoint(clip, clip);
    check.Near(GetValue(picture, "Depth", i), clip[2] / clip[3], 1e-6, "the depth of the position");
  }
  check.That(inside > 4000, "there is fog to see");
  check.That(!picture->GetPointData()->HasArray("IsovalueId"), "there are no isovalues");
}

//------------------------------------------------------------------------------
/// The smallest value is minus the largest of the negated field.
void CheckMinimum(Checks& check)
{
  ProjectedScene largest(NewCube(33, Head));
  ProjectedScene smallest(NewCube(33, [](const Point& p) { return -Head(p); }));
  smallest.Mapper->SetBlendModeToMinimumIntensity();
  const auto a = largest.RenderToImage();
  const auto b = smallest.RenderToImage();
  int different = 0;
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    const double value = GetValue(a, "Value", i);
    different += std::isnan(value) ? 0 : (value == -GetValue(b, "Value", i) ? 0 : 1);
  }
  check.Equal(different, 0, "the number of smallest values that are not minus the largest");
}

//------------------------------------------------------------------------------
/// VTK's ray casters with so many samples that they find nearly the same values. The one that
/// computes in 15 bits is inaccurate where values are steep.
void CheckAgainstRayCasters(Checks& check, const std::string& name, vtkImageData* image,
  const std::function<void(vtkVolumeMapper*)>& setUp, vtkActor* actor = nullptr)
{
  ProjectedScene scene(image);
  if (actor)
  {
    scene.Renderer->AddActor(actor);
  }
  setUp(scene.Mapper);
  const Picture ours = RenderAndCapture(scene.Window);
  const auto compare = [&](vtkVolumeMapper* caster, int tolerance, double share)
  {
    caster->SetInputDataObject(image);
    caster->SetBlendMode(vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND);
    setUp(caster);
    scene.Volume->SetMapper(caster);
    const double difference = GetDifference(RenderAndCapture(scene.Window), ours, tolerance);
    check.That(difference <= share,
      name + " looks as with " + caster->GetClassName() + ", but " +
        std::to_string(100.0 * difference) + " % of it");
  };
  // For a cropped box, that one moves the planes.
  if (scene.Mapper->GetCropping() == 0 ||
    scene.Mapper->GetCroppingRegionFlags() != VTK_CROP_SUBVOLUME)
  {
    vtkNew<vtkGPUVolumeRayCastMapper> gpu;
    gpu->SetAutoAdjustSampleDistances(0);
    gpu->SetSampleDistance(0.005F);
    compare(gpu, 4, 0.01);
  }
  vtkNew<vtkFixedPointVolumeRayCastMapper> fixedPoint;
  fixedPoint->SetAutoAdjustSampleDistances(0);
  fixedPoint->SetSampleDistance(0.005F);
  compare(fixedPoint, 16, 0.01);

  scene.Volume->VisibilityOff();
  check.That(GetDifference(RenderAndCapture(scene.Window), ours, 16) > 0.1, name + " is visible");
}

void CheckAgainstRayCasters(Checks& check)
{
  const auto head = NewCube(41, Head);
  CheckAgainstRayCasters(check, "the head", head, [](vtkVolumeMapper*) {});
  CheckAgainstRayCasters(check, "the hollow",
    NewCube(41, [](const Point& p) { return 1.0 - Head(p); }),
    [](vtkVolumeMapper* mapper) { mapper->SetBlendModeToMinimumIntensity(); });
  const auto sphere = NewSphere(0.5, { 0.1, -0.2, -0.1 }, 32);
  CheckAgainstRayCasters(
    check, "a head with a ball in it", head, [](vtkVolumeMapper*) {}, sphere);
  CheckAgainstRayCasters(check, "a head with a clipping plane", head,
    [](vtkVolumeMapper* mapper)
    {
      vtkNew<vtkPlane> plane;
      plane->SetNormal(1.0, 1.0, 0.3);
      mapper->AddClippingPlane(plane);
    });
  for (const int regions : { VTK_CROP_SUBVOLUME, VTK_CROP_FENCE, VTK_CROP_CROSS })
  {
    CheckAgainstRayCasters(check, "a head cropped to " + std::to_string(regions), head,
      [regions](vtkVolumeMapper* mapper)
      {
        mapper->CroppingOn();
        mapper->SetCroppingRegionPlanes(-0.43, 0.37, -0.68, 0.42, -0.51, 0.38);
        mapper->SetCroppingRegionFlags(regions);
      });
  }
}

//------------------------------------------------------------------------------
/// The window shows what RenderToImage has, and picks it; but not what has no opacity.
void CheckPixels(Checks& check)
{
  ProjectedScene scene(NewCube(33, Head));
  scene.Renderer->SetBackground(0.0, 0.0, 0.0);
  scene.Window->Render();
  const Picture window = Capture(scene.Window);
  const auto picture = scene.RenderToImage();
  vtkNew<vtkIsosurfacePicker> picker;
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  check.That(selector->CaptureBuffers(), "buffers are captured");
  int wrong = 0;
  int picked = 0;
  int passedOver = 0;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); i += 41)
  {
    const int x = static_cast<int>(i % Size);
    const int y = static_cast<int>(i / Size);
    double color[4];
    picture->GetPointData()->GetArray("Colors")->GetTuple(i, color);
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      wrong += std::abs(color[channel] - window[3 * static_cast<std::size_t>(i) + channel]) > 1.0;
    }
    const double value = GetValue(picture, "Value", i);
    const bool isVisible = !std::isnan(value) && color[3] > 0.0;
    passedOver += !std::isnan(value) && !isVisible ? 1 : 0;
    const int isPicked = picker->Pick(x, y, 0.0, scene.Renderer);
    check.Equal(isPicked != 0, isVisible, "whether pixel " + std::to_string(i) + " is picked");
    const unsigned int position[2] = { static_cast<unsigned int>(x), static_cast<unsigned int>(y) };
    const auto selected = selector->GetPixelInformation(position, 0);
    check.Equal(selected.Valid, isVisible, "whether pixel " + std::to_string(i) + " is selected");
    if (isVisible)
    {
      ++picked;
      Point hit;
      picture->GetPointData()->GetArray("Position")->GetTuple(i, hit.data());
      check.Equal(picker->GetIsovalue(), value, "the value picked");
      check.That(std::equal(hit.begin(), hit.end(), picker->GetPickPosition()),
        "its position is picked to the last bit");
      check.Equal(static_cast<double>(picker->GetCellId()), GetValue(picture, "CellId", i),
        "the cell picked");
      check.Equal(static_cast<double>(selected.AttributeID), GetValue(picture, "CellId", i),
        "the cell selected");
    }
  }
  check.Equal(wrong, 0, "the number of pixels that differ between window and image");
  check.That(picked > 100 && passedOver > 20, "some pixels are picked and some are not");

  double t;
  double x[3];
  double pcoords[3];
  double value;
  double normal[3];
  vtkIdType cell;
  const double from[3] = { 0.0, -3.0, -0.45 };
  const double to[3] = { 0.0, 3.0, -0.45 };
  check.Equal(
    scene.Mapper->IntersectWithLine(scene.Volume, from, to, t, x, pcoords, cell, value, normal), 1,
    "whether a line has a largest value");
  check.Near(value, 1.0, 0.3, "the value of a tooth");
  check.Near(x[1], -0.65, 0.1, "where the tooth is");
}

//------------------------------------------------------------------------------
/// An aborted picture leaves the previous result, and the next is complete.
void CheckAbort(Checks& check)
{
  ProjectedScene scene(NewCube(33, Head));
  scene.Mapper->SetNumberOfThreads(1);
  for (const bool isLargest : { true, false })
  {
    scene.Mapper->SetBlendMode(isLargest ? vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND
                                         : vtkVolumeMapper::MINIMUM_INTENSITY_BLEND);
    scene.Property()->GetScalarOpacity()->AddPoint(0.0, isLargest ? 0.0 : 0.5);
    scene.Volume->VisibilityOff();
    const Picture empty = RenderAndCapture(scene.Window);
    scene.Volume->VisibilityOn();
    const Picture whole = RenderAndCapture(scene.Window);
    check.That(GetDifference(whole, empty, 16) > 0.1, "there are values to see");
    vtkNew<EventCounter> steps;
    vtkNew<EventCounter> ends;
    scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderProgressEvent, steps);
    scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderEndEvent, ends);
    RenderAndAbort(scene.Window);
    check.Equal(steps->Count, 1, "the number of steps before the abort");
    check.Equal(ends->Count, 1, "the number of ends of a picture that is given up");
    check.Equal(GetDifference(Capture(scene.Window), empty, 0), 0.0, "what it has drawn");
    check.Equal(GetDifference(RenderAndCapture(scene.Window), whole, 0), 0.0,
      "the difference of the picture after it");
  }
}

//------------------------------------------------------------------------------
/// Values of cells are those of samples at their centres, whatever they are called.
void CheckCells(Checks& check)
{
  const auto centres = NewCube(21, Head);
  vtkNew<vtkImageData> cells;
  cells->SetDimensions(22, 22, 22);
  cells->SetSpacing(centres->GetSpacing());
  cells->SetOrigin(-1.05, -1.05, -1.05);
  vtkDataArray* values = centres->GetPointData()->GetScalars();
  cells->GetCellData()->AddArray(values);
  vtkNew<vtkDoubleArray> zeros;
  zeros->SetName("zeros");
  zeros->SetNumberOfTuples(cells->GetNumberOfCells());
  zeros->Fill(0.0);
  cells->GetCellData()->SetScalars(zeros);

  ProjectedScene scene(cells);
  scene.Mapper->SetScalarModeToUseCellFieldData();
  scene.Mapper->SelectScalarArray("field");
  for (const int mode :
    { vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, vtkVolumeMapper::MINIMUM_INTENSITY_BLEND })
  {
    scene.Mapper->SetBlendMode(mode);
    const auto picture = scene.RenderToImage();
    ProjectedScene expected(centres);
    expected.Mapper->SetBlendMode(mode);
    expected.Renderer->SetActiveCamera(scene.Renderer->GetActiveCamera());
    const auto ofCentres = expected.RenderToImage();
    int shown = 0;
    int inOtherCells = 0;
    for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
    {
      const double value = GetValue(picture, "Value", i);
      check.Equal(std::isnan(value), std::isnan(GetValue(ofCentres, "Value", i)),
        "whether there is a value of cells");
      if (std::isnan(value))
      {
        continue;
      }
      ++shown;
      check.Near(value, GetValue(ofCentres, "Value", i), 1e-12, "the value of cells");
      double position[3];
      picture->GetPointData()->GetArray("Position")->GetTuple(i, position);
      int sub;
      double pcoords[3];
      double weights[8];
      const vtkIdType cell = cells->FindCell(position, nullptr, 0, 0.0, sub, pcoords, weights);
      inOtherCells += cell != static_cast<vtkIdType>(GetValue(picture, "CellId", i)) ? 1 : 0;
    }
    check.That(shown > 8000, "there are values of cells");
    // On the face of two cells, either has it.
    check.That(inOtherCells < shown / 100, "the cells are those that VTK finds");
  }
}

//------------------------------------------------------------------------------
/// Rays, cast through an array that is chosen by name or number, find the values of the picture.
void CheckCasting(Checks& check)
{
  // Rays have different smallest values, too.
  const auto image = NewCube(33, [](const Point& p) { return Head(p) + 0.3 * p[0]; });
  vtkNew<vtkFloatArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(image->GetNumberOfPoints());
  other->Fill(0.7);
  image->GetPointData()->AddArray(other);
  image->GetPointData()->SetActiveScalars("other");
  ProjectedScene scene(image);
  scene.Mapper->SetScalarModeToUsePointFieldData();
  const double* eye = scene.Renderer->GetActiveCamera()->GetPosition();
  for (const int mode :
    { vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, vtkVolumeMapper::MINIMUM_INTENSITY_BLEND })
  {
    scene.Mapper->SetBlendMode(mode);
    for (const bool isByName : { true, false })
    {
      isByName ? scene.Mapper->SelectScalarArray("field") : scene.Mapper->SelectScalarArray(0);
      const auto picture = scene.RenderToImage();
      vtkNew<vtkPoints> origins;
      origins->SetDataTypeToDouble();
      vtkNew<vtkDoubleArray> directions;
      directions->SetNumberOfComponents(3);
      std::vector<vtkIdType> pixels;
      for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); i += 5)
      {
        if (!std::isnan(GetValue(picture, "Value", i)))
        {
          double position[3];
          picture->GetPointData()->GetArray("Position")->GetTuple(i, position);
          origins->InsertNextPoint(eye);
          directions->InsertNextTuple3(
            position[0] - eye[0], position[1] - eye[1], position[2] - eye[2]);
          pixels.push_back(i);
        }
      }
      vtkNew<vtkPolyData> hits;
      check.That(scene.Mapper->CastRays(scene.Volume, origins, directions, hits), "rays are cast");
      check.Equal(hits->GetNumberOfPoints(), static_cast<vtkIdType>(pixels.size()),
        "the number of values of rays");
      check.That(pixels.size() > 2000, "thousands of rays");
      double range[2];
      hits->GetPointData()->GetArray("Isovalue")->GetRange(range);
      check.That(range[1] - range[0] > 0.2, "the values are not those of the other array");
      for (std::size_t ray = 0; ray < pixels.size(); ++ray)
      {
        const auto row = static_cast<vtkIdType>(ray);
        vtkPointData* data = hits->GetPointData();
        check.Equal(data->GetArray("RayId")->GetTuple1(row), static_cast<double>(ray), "the ray");
        check.Near(data->GetArray("Isovalue")->GetTuple1(row),
          GetValue(picture, "Value", pixels[ray]), 1e-9, "the value of a ray");
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Each of several connections has a value on a ray; the nearest is met.
void CheckConnections(Checks& check)
{
  ProjectedScene scene(NewCube(17, Fog));
  const auto moved = NewCube(17, Fog);
  moved->SetOrigin(moved->GetOrigin()[0], moved->GetOrigin()[1], moved->GetOrigin()[2] + 3.0);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(moved);
  scene.Mapper->AddInputConnection(0, producer->GetOutputPort());
  const double from[3] = { 0.1, 0.1, 9.0 };
  const double to[3] = { 0.1, 0.1, -9.0 };
  double t = 0.0;
  double x[3] = { 0.0, 0.0, 0.0 };
  double parametric[3];
  double value = 0.0;
  double normal[3];
  vtkIdType cell = -1;
  check.Equal(
    scene.Mapper->IntersectWithLine(scene.Volume, from, to, t, x, parametric, cell, value, normal),
    1, "there is a value");
  check.Near(x[2], 3.0, 0.2, "the value is that of the nearest connection");
  vtkNew<vtkPoints> origins;
  origins->InsertNextPoint(from);
  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  directions->InsertNextTuple3(0.0, 0.0, -1.0);
  vtkNew<vtkPolyData> hits;
  check.That(scene.Mapper->CastRays(scene.Volume, origins, directions, hits), "a ray is cast");
  check.Equal(hits->GetNumberOfPoints(), vtkIdType{ 2 }, "the number of values of a ray");
  double bounds[6];
  check.That(scene.Mapper->FindSurfaceBounds(scene.Volume, bounds), "there are bounds");
  check.That(bounds[4] < 0.2 && bounds[5] > 2.8, "the bounds are those of all connections");
}

//------------------------------------------------------------------------------
/// A window shows no depth of values: what is drawn behind them is not hidden.
void CheckDepth(Checks& check)
{
  ProjectedScene scene(NewCube(17, Fog));
  scene.Window->Render();
  const DepthPicture depths(scene.Window, scene.Renderer);
  int near = 0;
  for (int i = 0; i < Size; ++i)
  {
    near += depths.IsEmpty(i, i) ? 0 : 1;
  }
  check.Equal(near, 0, "the number of pixels with a depth");
  scene.AddSurface(1.0, { 1.0, 1.0, 1.0 }, 1.0);
  check.That(!scene.Mapper->HasOnlyOpaqueSurfaces(scene.Volume), "values are no opaque surfaces");
}

}

int TestIsosurfaceRayTraceMapperProjection(int argc, char* argv[])
{
  Checks check;
  CheckValues(check);
  CheckMinimum(check);
  CheckAgainstRayCasters(check);
  CheckPixels(check);
  CheckAbort(check);
  CheckCells(check);
  CheckCasting(check);
  CheckConnections(check);
  CheckDepth(check);

  ProjectedScene scene(NewCube(65, Head));
  const auto sphere = NewSphere(0.25, { 0.5, -0.7, 0.5 }, 32);
  sphere->GetProperty()->SetColor(0.8, 0.3, 0.2);
  scene.Renderer->AddActor(sphere);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
