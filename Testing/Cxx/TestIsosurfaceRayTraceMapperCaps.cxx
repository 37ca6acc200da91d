// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Caps on clipping planes: where geometry says they are, with the colours of the field, lit as
// planes are; and the pictures that VTK's own filters make of clipped solids.

#include "AnalyticFields.h"
#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "RandomRays.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"
#include "vtkIsosurfaceVolume.h"

#include <vtkCellData.h>
#include <vtkClipClosedSurface.h>
#include <vtkClipPolyData.h>
#include <vtkCutter.h>
#include <vtkDataSetAttributes.h>
#include <vtkExtractVOI.h>
#include <vtkFlyingEdges3D.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkLightCollection.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPointDataToCellData.h>
#include <vtkProperty.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>

#include <functional>
#include <limits>
#include <map>

using namespace MapperTesting;

namespace
{

using AnalyticFields::Point;

constexpr int Size = 160;

vtkSmartPointer<vtkPlane> NewPlane(const Point& normal, const Point& origin)
{
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetNormal(normal[0], normal[1], normal[2]);
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  return plane;
}

double Gyroid(const Point& p)
{
  return std::sin(4.0 * p[0]) * std::cos(4.0 * p[1]) + std::sin(4.0 * p[1]) * std::cos(4.0 * p[2]) +
    std::sin(4.0 * p[2]) * std::cos(4.0 * p[0]);
}

void Cap(Scene& scene, const std::vector<vtkSmartPointer<vtkPlane>>& planes)
{
  for (vtkPlane* plane : planes)
  {
    scene.Mapper->AddClippingPlane(plane);
  }
  scene.Mapper->CapClippingPlanesOn();
}

/// Colours that rise with the value, in every channel in another way.
void UseRamp(Scene& scene, double low, double high)
{
  vtkColorTransferFunction* colors = scene.Property()->GetRGBTransferFunction();
  colors->RemoveAllPoints();
  colors->AddRGBPoint(low, 0.1, 0.2, 0.9);
  colors->AddRGBPoint(0.5 * (low + high), 0.9, 0.6, 0.3);
  colors->AddRGBPoint(high, 1.0, 1.0, 0.1);
}

struct Pixel
{
  int X;
  int Y;
  Point Position;
  Point Normal;
  std::array<double, 4> Color;
  double Depth;
  vtkIdType Cell;
  int IsovalueId;
};

/// The pixels of a picture that have a surface.
std::vector<Pixel> GetPixels(vtkImageData* picture)
{
  vtkPointData* data = picture->GetPointData();
  std::vector<Pixel> pixels;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    Pixel pixel;
    pixel.X = static_cast<int>(i % Size);
    pixel.Y = static_cast<int>(i / Size);
    pixel.Cell = static_cast<vtkIdType>(data->GetArray("CellId")->GetTuple1(i));
    data->GetArray("Position")->GetTuple(i, pixel.Position.data());
    data->GetArray("Normals")->GetTuple(i, pixel.Normal.data());
    data->GetArray("Colors")->GetTuple(i, pixel.Color.data());
    pixel.Depth = data->GetArray("Depth")->GetTuple1(i);
    pixel.IsovalueId = static_cast<int>(data->GetArray("IsovalueId")->GetTuple1(i));
    if (pixel.Cell >= 0)
    {
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

std::vector<Pixel> Render(Scene& scene, vtkLightCollection* lights = nullptr)
{
  return GetPixels(scene.RenderToImage(lights));
}

bool IsOn(vtkPlane* plane, const Point& point)
{
  Point copy = point;
  return std::abs(plane->EvaluateFunction(copy.data())) < 1e-9;
}

vtkSmartPointer<vtkLightCollection> NewLights(const Point& from)
{
  auto lights = vtkSmartPointer<vtkLightCollection>::New();
  lights->AddItem(NewLight(from));
  return lights;
}

double Radius(const Point& p)
{
  return std::hypot(p[0], p[1], p[2]);
}

/// The disc in which a plane cuts a ball: position, normal, depth, colour and light.
void CheckDisc(Checks& check)
{
  constexpr double radius = 0.8;
  const auto image = NewBall(41, radius);
  Scene scene(image, Size, Size);
  const Point normal = { -2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0 };
  const auto plane = NewPlane(normal, { 0.02, -0.02, 0.01 }); // 0.03 from the centre
  const Picture open = RenderAndCapture(scene.Window);
  scene.Mapper->AddClippingPlane(plane);
  const Picture cut = RenderAndCapture(scene.Window);
  check.That(!scene.Mapper->GetCapClippingPlanes(), "there are no caps by default");
  Cap(scene, {});
  UseRamp(scene, 0.0, radius);
  scene.Property()->SetAmbient(0.2);
  scene.Property()->SetDiffuse(0.8);
  scene.Property()->SetSpecular(0.0);
  const Point light = { 1.0, -3.0, 1.0 };
  const double cosine = -vtkMath::Dot(normal, light) / Radius(light);
  const double disc = std::sqrt(radius * radius - 0.03 * 0.03);
  const auto picture = Render(scene, NewLights(light));
  vtkMatrix4x4* clipFromWorld =
    scene.Renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(1.0, -1.0, 1.0);
  int caps = 0;
  double largest = 0.0;
  for (const Pixel& pixel : picture)
  {
    if (!IsOn(plane, pixel.Position))
    {
      continue;
    }
    ++caps;
    Point inPlane;
    Point away;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      inPlane[axis] = pixel.Position[axis] + 0.03 * normal[axis];
      away[axis] = pixel.Normal[axis] + normal[axis];
    }
    largest = std::max(largest, Radius(inPlane));
    check.Near(Radius(away), 0.0, 1e-12, "the difference of the normal from that of the plane");
    double color[3];
    scene.Property()->GetRGBTransferFunction()->GetColor(radius - Radius(pixel.Position), color);
    for (int channel = 0; channel < 3; ++channel)
    {
      // The samples are those of a ball, the interpolant is only nearly one.
      check.Near(pixel.Color[channel], 255.0 * color[channel] * (0.2 + 0.8 * cosine), 6.0,
        "the colour of a cap");
    }
    double clip[4] = { pixel.Position[0], pixel.Position[1], pixel.Position[2], 1.0 };
    clipFromWorld->MultiplyPoint(clip, clip);
    check.Near(pixel.Depth, 0.5 + 0.5 * clip[2] / clip[3], 1e-6, "the depth of a cap");
    check.Equal(pixel.IsovalueId, 0, "the isovalue of a cap");
  }
  check.That(caps > 3000, "a disc covers " + std::to_string(caps) + " pixels");
  check.Near(largest, disc, 0.02, "the radius of the disc");

  // The solid is closed.
  for (const Pixel& pixel : picture)
  {
    const double* eye = scene.Renderer->GetActiveCamera()->GetPosition();
    Point toEye;
    vtkMath::Subtract(eye, pixel.Position.data(), toEye.data());
    const bool isTurnedAway = vtkMath::Dot(pixel.Normal, toEye) < -0.05 * Radius(toEye);
    check.That(!isTurnedAway, "only the outside is visible");
  }

  scene.Mapper->CapClippingPlanesOff();
  scene.SetSurface(0.0, { 0.9, 0.8, 0.7 }, 1.0);
  scene.Property()->SetAmbient(0.1);
  scene.Property()->SetDiffuse(0.7);
  scene.Property()->SetSpecular(0.2);
  check.That(RenderAndCapture(scene.Window) == cut, "without caps it is as before");
  scene.Mapper->RemoveAllClippingPlanes();
  scene.Mapper->CapClippingPlanesOn();
  check.That(RenderAndCapture(scene.Window) == open, "without planes there is nothing to cap");
}

/// Rays, pixels, picks and selections are of the same caps, in a window as without one.
void CheckAgreement(Checks& check)
{
  const auto image = NewCube(33, Gyroid);
  Scene scene(image, Size, Size);
  const std::vector<vtkSmartPointer<vtkPlane>> planes = { NewPlane(
                                                            { 0.3, 1.0, -0.2 }, { 0.0, -0.3, 0.0 }),
    NewPlane({ -1.0, 0.2, 0.0 }, { 0.3, 0.0, 0.0 }) };
  Cap(scene, planes);
  UseRamp(scene, 0.0, 1.5);
  const Picture drawn = RenderAndCapture(scene.Window);
  const DepthPicture depths(scene.Window, scene.Renderer);
  const auto picture = vtkSmartPointer<vtkImageData>::New();
  scene.Mapper->RenderToImage(scene.Volume, scene.Renderer->GetActiveCamera(),
    scene.Renderer->GetLights(), Size, Size, picture);
  vtkNew<vtkIsosurfacePicker> picker;
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  const Point eye = { scene.Renderer->GetActiveCamera()->GetPosition()[0],
    scene.Renderer->GetActiveCamera()->GetPosition()[1],
    scene.Renderer->GetActiveCamera()->GetPosition()[2] };
  int caps[2] = { 0, 0 };
  int wrongColors = 0;
  int compared = 0;
  for (const Pixel& pixel : GetPixels(picture))
  {
    const std::size_t offset = static_cast<std::size_t>(3 * (pixel.X + Size * pixel.Y));
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      wrongColors +=
        std::abs(pixel.Color[channel] - static_cast<double>(drawn[offset + channel])) > 1.0 ? 1 : 0;
    }
    const bool isOnFirst = IsOn(planes[0], pixel.Position);
    const bool isOnSecond = IsOn(planes[1], pixel.Position);
    caps[0] += isOnFirst ? 1 : 0;
    caps[1] += isOnSecond ? 1 : 0;
    for (vtkPlane* plane : planes)
    {
      Point copy = pixel.Position;
      check.That(
        plane->EvaluateFunction(copy.data()) > -1e-9, "what is visible is what both leave");
    }
    if ((!isOnFirst && !isOnSecond) || ++compared % 97 != 0)
    {
      continue;
    }
    check.Near(
      depths.GetDepth(pixel.X, pixel.Y), pixel.Depth, 1e-6, "the depth of a cap in the window");
    check.Equal(picker->Pick(pixel.X, pixel.Y, 0.0, scene.Renderer), 1, "the pick of a cap");
    check.Equal(picker->GetCellId(), pixel.Cell, "the cell picked");
    check.Equal(picker->GetIsovalue(), 0.0, "the isovalue picked");
    for (int axis = 0; axis < 3; ++axis)
    {
      check.Equal(picker->GetPickPosition()[axis], pixel.Position[axis], "the position picked");
      check.Equal(picker->GetPickNormal()[axis], pixel.Normal[axis], "the normal picked");
    }
    double bounds[6];
    image->GetCell(pixel.Cell)->GetBounds(bounds);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double width = bounds[2 * axis + 1] - bounds[2 * axis];
      check.Near(bounds[2 * axis] + width * picker->GetPCoords()[axis], pixel.Position[axis], 1e-12,
        "the position in the cell picked");
    }
    double t;
    double x[3];
    double pcoords[3];
    double normal[3];
    double isovalue;
    vtkIdType cell;
    Point behind;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      behind[axis] = eye[axis] + 2.0 * (pixel.Position[axis] - eye[axis]);
    }
    check.Equal(scene.Mapper->IntersectWithLine(
                  scene.Volume, eye.data(), behind.data(), t, x, pcoords, cell, isovalue, normal),
      1, "a line to a cap");
    check.Near(t, 0.5, 1e-9, "the way to a cap");
    check.Equal(cell, pixel.Cell, "the cell that a line finds");
    selector->SetArea(static_cast<unsigned int>(pixel.X), static_cast<unsigned int>(pixel.Y),
      static_cast<unsigned int>(pixel.X), static_cast<unsigned int>(pixel.Y));
    const auto selection = vtk::TakeSmartPointer(selector->Select());
    auto* ids = selection->GetNumberOfNodes() == 1
      ? vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList())
      : nullptr;
    check.That(ids && ids->GetNumberOfTuples() == 1 && ids->GetValue(0) == pixel.Cell,
      "the cell of a cap is selected");
  }
  check.That(caps[0] > 1000 && caps[1] > 300, "both planes have caps");
  check.That(compared > 20 * 97, "picks were compared");
  check.Equal(wrongColors, 0, "the number of colours that differ in the window");
}

/// A volume that is rotated, stretched and moved, in a box of planes around it and cut by another:
/// what is at or above the isovalue is closed. Every ray from outside leaves as often as it enters.
void CheckClosedBox(Checks& check)
{
  auto image = NewCube(25, Gyroid);
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  image->SetExtent(5, 29, -3, 21, 0, 24);
  image->SetSpacing(1.0 / 12.0, -1.0 / 12.0, 1.0 / 12.0);
  image->SetDirectionMatrix(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
  Scene scene(image, Size, Size);
  scene.Property()->GetScalarOpacity()->RemoveAllPoints();
  scene.Property()->GetScalarOpacity()->AddPoint(0.0, 1e-6);
  scene.Volume->SetPosition(100.3, -200.1, 50.2);
  scene.Volume->RotateX(25.0);
  scene.Volume->SetScale(1.0, 1.2, 0.9);
  // The corners of the volume in the world, of which each face has a plane.
  const auto toWorld = [&](const Point& index)
  {
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    image->TransformContinuousIndexToPhysicalPoint(index.data(), point);
    scene.Volume->GetMatrix()->MultiplyPoint(point, point);
    return Point{ point[0], point[1], point[2] };
  };
  const Point low = toWorld({ 5.0, -3.0, 0.0 });
  const Point high = toWorld({ 29.0, 21.0, 24.0 });
  const Point edges[3] = { toWorld({ 29.0, -3.0, 0.0 }), toWorld({ 5.0, 21.0, 0.0 }),
    toWorld({ 5.0, -3.0, 24.0 }) };
  std::vector<vtkSmartPointer<vtkPlane>> planes;
  Point center;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (low[axis] + high[axis]);
    Point along;
    Point across;
    Point normal;
    vtkMath::Subtract(edges[(axis + 1) % 3].data(), low.data(), along.data());
    vtkMath::Subtract(edges[(axis + 2) % 3].data(), low.data(), across.data());
    vtkMath::Cross(along.data(), across.data(), normal.data());
    vtkMath::Normalize(normal.data());
    Point inwards;
    vtkMath::Subtract(high.data(), low.data(), inwards.data());
    const double side = vtkMath::Dot(normal, inwards) > 0.0 ? 1.0 : -1.0;
    planes.push_back(NewPlane({ side * normal[0], side * normal[1], side * normal[2] }, low));
    planes.push_back(NewPlane({ -side * normal[0], -side * normal[1], -side * normal[2] }, high));
  }
  planes.push_back(
    NewPlane({ 0.5, -0.7, 0.4 }, { center[0] - 0.3, center[1] + 0.4, center[2] - 0.2 }));
  Cap(scene, planes);

  const RandomRays rays({ center[0], center[1], center[2] }, 1.0, 4000);
  for (const bool isNearest : { false, true })
  {
    scene.Mapper->SetInterpolationMode(
      isNearest ? vtkIsosurfaceRayTraceMapper::NEAREST : vtkIsosurfaceRayTraceMapper::TRILINEAR);
    const auto output = rays.Cast(scene.Mapper, scene.Volume);
    vtkDataArray* normals = output->GetPointData()->GetNormals();
    vtkDataArray* ids = output->GetPointData()->GetArray("RayId");
    std::map<int, int> hits;
    std::vector<int> onPlane(planes.size());
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      ++hits[static_cast<int>(ids->GetTuple1(i))];
      for (std::size_t plane = 0; plane < planes.size(); ++plane)
      {
        const double* normal = planes[plane]->GetNormal();
        const double length = vtkMath::Norm(normal);
        onPlane[plane] += vtkMath::Dot(normal, normals->GetTuple3(i)) < -0.999999 * length ? 1 : 0;
      }
    }
    int odd = 0;
    for (const auto& [ray, count] : hits)
    {
      odd += count % 2;
    }
    check.Equal(odd, 0, isNearest ? "the number of rays that leak between boxes" : "that leak");
    for (const int count : onPlane)
    {
      check.That(count > 20, "every plane has caps: " + std::to_string(count));
    }
  }
}

/// A solid that fills its volume, closed by six planes in its faces: a box without holes.
void CheckFullBox(Checks& check)
{
  Scene scene(NewCube(9, [](const Point&) { return 1.0; }), Size, Size);
  std::vector<vtkSmartPointer<vtkPlane>> planes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      Point normal = { 0.0, 0.0, 0.0 };
      Point origin = { 0.3, 0.2, 0.1 };
      normal[axis] = -side;
      origin[axis] = side;
      planes.push_back(NewPlane(normal, origin));
    }
  }
  Cap(scene, planes);
  struct Row
  {
    int First = Size;
    int Last = -1;
    int Count = 0;
  };
  std::map<int, Row> rows;
  std::vector<int> caps(planes.size());
  for (const Pixel& pixel : Render(scene))
  {
    Row& row = rows[pixel.Y];
    row.First = std::min(row.First, pixel.X);
    row.Last = std::max(row.Last, pixel.X);
    ++row.Count;
    for (std::size_t i = 0; i < planes.size(); ++i)
    {
      caps[i] += vtkMath::Dot(pixel.Normal.data(), planes[i]->GetNormal()) < -0.999 ? 1 : 0;
    }
  }
  check.That(rows.size() > 100, "the box is visible");
  for (const auto& [y, row] : rows)
  {
    check.Equal(row.Count, row.Last - row.First + 1, "the number of pixels of the box in a row");
  }
  int faces = 0;
  for (const int count : caps)
  {
    faces += count > 500 ? 1 : 0;
  }
  check.Equal(faces, 3, "the number of faces that are visible");
}

/// The pictures of VTK's filters: vtkClipClosedSurface, and vtkCutter for the colours.
void CheckAgainstPolygons(Checks& check)
{
  const std::vector<vtkSmartPointer<vtkPlane>> planes = { NewPlane(
                                                            { 0.1, 1.0, -0.2 }, { 0.0, -0.2, 0.0 }),
    NewPlane({ -1.0, 0.2, 0.0 }, { 0.3, 0.0, 0.0 }) };
  const auto image =
    NewCube(81, [](const Point& p) { return Gyroid(p) - 4.0 * (Radius(p) - 0.7); });
  Scene scene(image, 240, 240);
  scene.Property()->SetAmbient(0.0);
  scene.Property()->SetDiffuse(1.0);
  scene.Property()->SetSpecular(0.0);
  Cap(scene, planes);
  vtkColorTransferFunction* colors = scene.Property()->GetRGBTransferFunction();
  colors->RemoveAllPoints();
  colors->AddRGBPoint(0.0, 0.9, 0.8, 0.7);
  colors->AddRGBPoint(1e-6, 0.9, 0.2, 0.1);
  const Picture ofOneColor = RenderAndCapture(scene.Window);
  UseRamp(scene, 0.0, 3.0);
  const Picture ofField = RenderAndCapture(scene.Window);
  scene.Renderer->RemoveVolume(scene.Volume);
  const Picture empty = RenderAndCapture(scene.Window);

  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  vtkNew<vtkPlaneCollection> collection;
  for (vtkPlane* plane : planes)
  {
    collection->AddItem(plane);
  }
  vtkNew<vtkClipClosedSurface> clip;
  clip->SetInputConnection(contour->GetOutputPort());
  clip->SetClippingPlanes(collection);
  clip->SetScalarModeToColors();
  clip->SetBaseColor(0.9, 0.8, 0.7);
  clip->SetClipColor(0.9, 0.2, 0.1);
  const auto add = [&scene](vtkAlgorithm* source)
  {
    const auto actor = NewActor(source);
    actor->GetProperty()->SetInterpolationToFlat();
    scene.Renderer->AddActor(actor);
    return actor.Get();
  };
  add(clip);
  Picture polygons = RenderAndCapture(scene.Window);
  double share = GetDifference(ofOneColor, polygons, 25);
  std::cout << "vtkClipClosedSurface: " << 100.0 * share << " % of the pixels differ\n";
  check.That(GetDifference(polygons, empty, 4) > 0.2, "polygons are drawn");
  check.That(share < 0.01, "the caps are those of vtkClipClosedSurface");

  scene.Renderer->RemoveAllViewProps();
  auto* surface = add(contour);
  surface->GetMapper()->ScalarVisibilityOff();
  surface->GetProperty()->SetColor(0.1, 0.2, 0.9);
  surface->GetMapper()->SetClippingPlanes(collection);
  for (std::size_t i = 0; i < 2; ++i)
  {
    vtkNew<vtkCutter> cutter;
    cutter->SetInputData(image);
    cutter->SetCutFunction(planes[i]);
    vtkNew<vtkClipPolyData> inside;
    inside->SetInputConnection(cutter->GetOutputPort());
    inside->SetValue(0.0);
    vtkMapper* mapper = add(inside)->GetMapper();
    mapper->SetLookupTable(colors);
    mapper->AddClippingPlane(planes[1 - i]);
  }
  polygons = RenderAndCapture(scene.Window);
  share = GetDifference(ofField, polygons, 25);
  std::cout << "vtkCutter: " << 100.0 * share << " % of the pixels differ\n";
  check.That(share < 0.01, "the colours are those of vtkCutter");
}

/// Caps have the colours of another array, or image, where there is one.
void CheckOtherColors(Checks& check)
{
  const auto image = NewBall(33, 0.8);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("colors");
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* point = image->GetPoint(i);
    colors->InsertNextTuple3(127.5 + 127.0 * point[0], 127.5 + 127.0 * point[1], 127.5);
  }
  image->GetPointData()->AddArray(colors);
  Scene scene(image, Size, Size);
  const auto plane = NewPlane({ 0.0, 1.0, -0.1 }, { 0.0, -0.1, 0.0 });
  Cap(scene, { plane });
  scene.Property()->ShadeOff();
  scene.Mapper->SetColorArrayName("colors");
  int caps = 0;
  for (const Pixel& pixel : Render(scene))
  {
    caps += IsOn(plane, pixel.Position) ? 1 : 0;
    check.Near(pixel.Color[0], 127.5 + 127.0 * pixel.Position[0], 1.5, "the red of a position");
    check.Near(pixel.Color[1], 127.5 + 127.0 * pixel.Position[1], 1.5, "the green of a position");
  }
  check.That(caps > 3000, "caps have the colours of an array");
}

/// A translucent skin over a bone: each section has the opacity of its own.
void CheckTranslucent(Checks& check)
{
  Scene scene(NewBall(41, 0.9), Size, Size);
  scene.Property()->ShadeOff();
  scene.SetSurface(0.0, { 0.9, 0.75, 0.5 }, 0.4);
  scene.AddSurface(0.4, { 0.2, 0.5, 0.9 }, 1.0);
  const auto plane = NewPlane({ 0.0, 1.0, 0.0 }, { 0.0, -0.1, 0.0 });
  Cap(scene, { plane });
  int skins = 0;
  int bones = 0;
  for (const Pixel& pixel : Render(scene))
  {
    const double value = 0.9 - Radius(pixel.Position);
    if (!IsOn(plane, pixel.Position) || std::abs(value - 0.4) < 0.02 || value < 0.02)
    {
      continue;
    }
    const bool isBone = value > 0.4;
    (isBone ? bones : skins) += 1;
    check.Equal(pixel.IsovalueId, isBone ? 1 : 0, "the isovalue of a section");
    double section[3];
    scene.Property()->GetRGBTransferFunction()->GetColor(value, section);
    // Behind the section of the skin there is the bone, or the skin once more.
    const std::array<double, 3> skin = { 0.9, 0.75, 0.5 };
    const std::array<double, 3> bone = { 0.2, 0.5, 0.9 };
    bool matchesBone = true;
    bool matchesSkin = true;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto isNear = [&](double color)
      { return std::abs(pixel.Color[k] - 255.0 * color) < 4.0; };
      matchesBone = matchesBone && isNear(isBone ? section[k] : 0.4 * section[k] + 0.6 * bone[k]);
      matchesSkin = matchesSkin && isNear(0.4 * section[k] + 0.6 * 0.4 * skin[k]);
    }
    check.That(isBone ? matchesBone : (matchesBone || matchesSkin), "the colour of a section");
  }
  check.That(skins > 500 && bones > 500, "both have sections");
}

/// Nothing above caps occludes them; but they occlude what is below.
void CheckLight(Checks& check)
{
  Scene scene(NewBall(41, 0.9), Size, Size);
  scene.Property()->SetAmbient(0.0);
  scene.Property()->SetDiffuse(1.0);
  scene.Property()->SetSpecular(0.0);
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 1.0);
  const auto plane = NewPlane({ 0.0, 1.0, 0.0 }, { 0.0, -0.1, 0.0 });
  Cap(scene, { plane });
  const auto lights = NewLights({ 0.3, -3.0, 0.4 });
  const auto compare = [&](const std::string& name)
  {
    const std::vector<Pixel> with = Render(scene, lights);
    scene.Mapper->ShadowsOff();
    scene.Mapper->AmbientOcclusionOff();
    const std::vector<Pixel> without = Render(scene, lights);
    int caps = 0;
    int darker = 0;
    for (std::size_t i = 0; i < with.size(); ++i)
    {
      caps += IsOn(plane, with[i].Position) ? 1 : 0;
      darker += IsOn(plane, with[i].Position) && with[i].Color != without[i].Color ? 1 : 0;
    }
    check.That(caps > 3000, "there are caps with " + name);
    check.Equal(darker, 0, "the number of pixels of a cap that lose light with " + name);
  };
  scene.Mapper->ShadowsOn();
  compare("shadows");
  scene.Property()->SetAmbient(0.5);
  scene.Mapper->AmbientOcclusionOn();
  compare("ambient occlusion");

  // From within, with the light outside of the opening.
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(0.1, 0.0, 0.1);
  camera->SetFocalPoint(0.2, 1.0, 0.3);
  camera->SetViewAngle(60.0);
  camera->SetClippingRange(0.01, 5.0);
  const auto countLit = [&](bool hasCaps)
  {
    scene.Mapper->SetCapClippingPlanes(hasCaps);
    int lit = 0;
    for (const Pixel& pixel : Render(scene, lights))
    {
      lit += pixel.Color[0] > 0.0 ? 1 : 0;
    }
    return lit;
  };
  scene.Property()->SetAmbient(0.0);
  scene.Mapper->ShadowsOn();
  check.That(countLit(false) > 5000, "light comes in without a cap");
  check.Equal(countLit(true), 0, "the number of pixels that are lit through a cap");
  scene.Mapper->ShadowsOff();
  scene.Mapper->AmbientOcclusionOn();
  scene.Property()->SetAmbient(1.0);
  scene.Property()->SetDiffuse(0.0);
  check.That(countLit(false) > 5000, "ambient light comes in without a cap");
  check.Equal(countLit(true), 0, "the number of pixels to which ambient light comes through a cap");

  // The cap itself, from inside: unlit by the light outside, and lit by one inside.
  camera->SetPosition(0.1, 0.6, 0.1);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  scene.Mapper->AmbientOcclusionOff();
  scene.Property()->SetAmbient(0.0);
  scene.Property()->SetDiffuse(1.0);
  check.Equal(countLit(true), 0, "the number of pixels of a cap that are lit from behind");
  int behind = 0;
  for (const Pixel& pixel : Render(scene))
  {
    behind += IsOn(plane, pixel.Position) && pixel.Color[0] > 20.0 ? 1 : 0;
    check.That(pixel.Normal[1] < 0.0 || !IsOn(plane, pixel.Position), "the normal points out");
  }
  check.That(behind > 3000, "a cap is visible from behind");
}

/// Cropping leaves a cap where it leaves a surface, and has none of its own.
void CheckCropping(Checks& check)
{
  const auto plane = NewPlane({ 0.2, 1.0, -0.1 }, { 0.0, -0.1, 0.0 });
  for (const int flags : { VTK_CROP_SUBVOLUME, VTK_CROP_FENCE, 0x7ffffff & ~(1 << 13) })
  {
    Scene scene(NewBall(33, 0.8), Size, Size);
    Cap(scene, { plane });
    scene.Mapper->CroppingOn();
    scene.Mapper->SetCroppingRegionPlanes(-0.4, 0.35, -0.9, 0.9, -0.3, 0.45);
    scene.Mapper->SetCroppingRegionFlags(flags);
    const std::vector<Pixel> cropped = Render(scene);
    scene.Mapper->CroppingOff();
    std::map<int, Pixel> whole;
    for (const Pixel& pixel : Render(scene))
    {
      whole[pixel.X + Size * pixel.Y] = pixel;
    }
    int caps = 0;
    int expected = 0;
    const auto isLeft = [flags](const Point& p)
    {
      const int x = p[0] < -0.4 ? 0 : (p[0] > 0.35 ? 2 : 1);
      const int z = p[2] < -0.3 ? 0 : (p[2] > 0.45 ? 2 : 1);
      return (flags >> (x + 3 + 9 * z) & 1) != 0;
    };
    for (const auto& [index, pixel] : whole)
    {
      expected += IsOn(plane, pixel.Position) && isLeft(pixel.Position) ? 1 : 0;
    }
    for (const Pixel& pixel : cropped)
    {
      const bool isCap = IsOn(plane, pixel.Position);
      caps += isCap ? 1 : 0;
      check.That(isLeft(pixel.Position), "what is visible is in a region that is left");
      check.That(isCap || std::abs(Radius(pixel.Position) - 0.8) < 0.01, "cropping has no caps");
    }
    check.That(expected > 500, "cropping leaves some of a cap");
    check.Equal(caps, expected, "the number of pixels of a cropped cap");
  }
}

/// Every kind of input has caps; those that are the same have the same.
void CheckInputs(Checks& check)
{
  // Linear, so that its value is known everywhere; nowhere near an isovalue but where it is cut.
  const auto field = [](const Point& p) { return 1.5 + p[0] + 0.5 * p[1] - 0.25 * p[2]; };
  const auto image = NewCube(21, field);
  const auto plane = NewPlane({ 0.3, 1.0, 0.2 }, { 0.05, -0.2, 0.1 });
  const auto render = [&](vtkDataObject* data, const std::function<void(Scene&)>& set)
  {
    Scene scene(data, Size, Size);
    scene.Property()->ShadeOff();
    Cap(scene, { plane });
    UseRamp(scene, 0.0, 3.0);
    set(scene);
    int caps = 0;
    for (const Pixel& pixel : Render(scene))
    {
      if (!IsOn(plane, pixel.Position))
      {
        continue;
      }
      ++caps;
      double color[3];
      scene.Property()->GetRGBTransferFunction()->GetColor(field(pixel.Position), color);
      const bool isNearest =
        scene.Mapper->GetInterpolationMode() == vtkIsosurfaceRayTraceMapper::NEAREST;
      for (int channel = 0; channel < 3; ++channel)
      {
        check.Near(
          pixel.Color[channel], 255.0 * color[channel], isNearest ? 25.0 : 1.0, "a colour");
      }
    }
    check.That(caps > 5000, "there are caps: " + std::to_string(caps));
    return RenderAndCapture(scene.Window);
  };
  const auto leave = [](Scene&) {};
  const Picture expected = render(image, leave);

  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int i = 0; i < 2; ++i)
  {
    vtkNew<vtkExtractVOI> half;
    half->SetInputData(image);
    half->SetVOI(i == 0 ? 0 : 9, i == 0 ? 9 : 20, 0, 20, 0, 20);
    half->Update();
    blocks->SetBlock(static_cast<unsigned int>(i), half->GetOutput());
  }
  check.That(render(blocks, leave) == expected, "two blocks have the caps of one image");

  std::array<std::vector<double>, 3> coordinates;
  for (int i = 0; i < 21; ++i)
  {
    const double even = i / 10.0 - 1.0;
    coordinates[0].push_back(even);
    coordinates[1].push_back(even * std::abs(even));
    coordinates[2].push_back(even);
  }
  const auto grid = NewGrid(coordinates, field);
  check.That(GetDifference(render(grid, leave), expected, 1) < 0.001, "uneven planes change none");

  render(image, [](Scene& scene) { scene.Mapper->SetInterpolationModeToNearest(); });

  vtkNew<vtkPointDataToCellData> toCells;
  toCells->SetInputData(image);
  toCells->Update();
  render(toCells->GetOutput(), leave);

  // Cells that are blanked, and those with a value that is NaN, have no cap.
  vtkNew<vtkImageData> holed;
  holed->DeepCopy(image);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(holed->GetNumberOfCells());
  for (vtkIdType i = 0; i < holed->GetNumberOfCells(); ++i)
  {
    const bool isBlanked = i % 20 > 13;
    ghosts->SetValue(i, isBlanked ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  holed->GetCellData()->AddArray(ghosts);
  for (int z = 0; z < 21; ++z)
  {
    for (int y = 0; y < 21; ++y)
    {
      holed->GetPointData()->GetScalars()->SetComponent(
        4 + 21 * (y + 21 * z), 0, std::numeric_limits<double>::quiet_NaN());
    }
  }
  Scene scene(holed, Size, Size);
  Cap(scene, { plane });
  int caps = 0;
  for (const Pixel& pixel : Render(scene))
  {
    const auto column = pixel.Cell % 20;
    caps += IsOn(plane, pixel.Position) ? 1 : 0;
    check.That(column <= 13 && column != 3 && column != 4, "there is no cap in a hole");
  }
  check.That(caps > 3000, "there are caps beside holes");
}

/// Projections have no solids.
void CheckProjection(Checks& check)
{
  Scene scene(NewBall(21, 0.8), Size, Size);
  scene.Property()->GetScalarOpacity()->AddPoint(0.8, 1.0);
  scene.Mapper->SetBlendModeToMaximumIntensity();
  scene.Mapper->AddClippingPlane(NewPlane({ 0.0, 1.0, 0.0 }, { 0.0, 0.1, 0.0 }));
  const Picture before = RenderAndCapture(scene.Window);
  scene.Mapper->CapClippingPlanesOn();
  check.That(RenderAndCapture(scene.Window) == before, "a projection has no caps");
}

/// A wedge out of an onion of three surfaces, the outermost translucent, with shadows.
void MakePicture(Scene& scene)
{
  scene.SetSurface(0.0, { 0.9, 0.75, 0.5 }, 0.5);
  scene.AddSurface(0.3, { 0.2, 0.5, 0.9 }, 1.0);
  scene.AddSurface(0.6, { 0.8, 0.2, 0.2 }, 1.0);
  scene.Mapper->ShadowsOn();
  Cap(scene,
    { NewPlane({ -1.0, 0.3, -0.2 }, { 0.25, 0.0, 0.0 }),
      NewPlane({ -0.1, 1.0, 0.1 }, { 0.0, -0.2, 0.0 }) });
}

}

int TestIsosurfaceRayTraceMapperCaps(int argc, char* argv[])
{
  Checks check;
  CheckDisc(check);
  CheckAgreement(check);
  CheckClosedBox(check);
  CheckFullBox(check);
  CheckAgainstPolygons(check);
  CheckOtherColors(check);
  CheckTranslucent(check);
  CheckLight(check);
  CheckCropping(check);
  CheckInputs(check);
  CheckProjection(check);
  Scene scene(NewBall(41, 0.9), 300, 300);
  MakePicture(scene);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
