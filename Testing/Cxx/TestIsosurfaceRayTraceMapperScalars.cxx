// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Scalars of every kind: the same values of any type, in any memory layout, give the same picture.

#include "AnalyticFields.h"
#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkSOADataArrayTemplate.h>

#include <limits>
#include <utility>

using namespace MapperTesting;

namespace
{

constexpr int Samples = 25;

/// Whole numbers that every type can hold, from 5 to 115.
double Hills(const AnalyticFields::Point& p)
{
  return std::floor(60.0 + 35.0 * std::sin(4.0 * p[0]) * std::cos(3.0 * p[1]) - 20.0 * p[2]);
}

vtkSmartPointer<vtkImageData> NewImageOf(vtkDataArray* scalars)
{
  auto image = NewCube(Samples, Hills);
  image->GetPointData()->SetScalars(scalars);
  return image;
}

/// The hills in an array of a type of VTK, as a component of several.
vtkSmartPointer<vtkDataArray> NewHills(int type, int components = 1, int component = 0)
{
  const auto hills = NewCube(Samples, Hills);
  vtkDataArray* values = hills->GetPointData()->GetScalars();
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(values->GetNumberOfTuples());
  array->Fill(7.0);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    array->SetComponent(i, component, values->GetComponent(i, 0));
  }
  return array;
}

Picture Draw(vtkImageData* image, double isovalue)
{
  Scene scene(image);
  scene.SetSurface(isovalue, { 0.9, 0.8, 0.7 }, 1.0);
  return RenderAndCapture(scene.Window);
}

void CheckTypes(Checks& check, const Picture& expected)
{
  const int types[] = { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
    VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG,
    VTK_ID_TYPE, VTK_FLOAT };
  for (const int type : types)
  {
    const auto image = NewImageOf(NewHills(type));
    check.Equal(GetDifference(Draw(image, 50.0), expected, 0), 0.0,
      std::string("the difference with ") + image->GetScalarTypeAsString());
  }
}

/// The upper half of unsigned types, which are negative numbers if taken for signed ones.
void CheckLargeValues(Checks& check, const Picture& expected)
{
  const std::pair<int, double> offsets[] = { { VTK_UNSIGNED_CHAR, 130.0 },
    { VTK_UNSIGNED_SHORT, 65000.0 }, { VTK_UNSIGNED_INT, 4e9 },
    { VTK_UNSIGNED_LONG_LONG, 4503599627370496.0 } };
  for (const auto& [type, offset] : offsets)
  {
    const auto hills = NewHills(VTK_DOUBLE);
    auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    array->SetNumberOfTuples(hills->GetNumberOfTuples());
    for (vtkIdType i = 0; i < hills->GetNumberOfTuples(); ++i)
    {
      array->SetComponent(i, 0, hills->GetComponent(i, 0) + offset);
    }
    // Differences to the isovalue are the same numbers, so the picture is the same too.
    check.Equal(GetDifference(Draw(NewImageOf(array), 50.0 + offset), expected, 0), 0.0,
      std::string("the difference with large values of ") + array->GetDataTypeAsString());
  }
}

void CheckBits(Checks& check)
{
  const auto image = NewCube(Samples, Hills);
  vtkDataArray* hills = image->GetPointData()->GetScalars();
  vtkNew<vtkBitArray> bits;
  vtkNew<vtkFloatArray> zerosAndOnes;
  for (vtkIdType i = 0; i < hills->GetNumberOfTuples(); ++i)
  {
    const bool isHigh = hills->GetComponent(i, 0) >= 50.0;
    bits->InsertNextValue(isHigh ? 1 : 0);
    zerosAndOnes->InsertNextValue(isHigh ? 1.0F : 0.0F);
  }
  check.Equal(GetDifference(Draw(NewImageOf(bits), 0.5), Draw(NewImageOf(zerosAndOnes), 0.5), 0),
    0.0, "the difference with bits");
}

/// Of several components the heaviest is drawn, with its own colours, interleaved or not.
void CheckComponents(Checks& check, const Picture& expected)
{
  const auto interleaved = NewHills(VTK_SHORT, 3, 2);
  vtkNew<vtkSOADataArrayTemplate<short>> separate;
  separate->SetNumberOfComponents(3);
  separate->SetNumberOfTuples(interleaved->GetNumberOfTuples());
  for (int component = 0; component < 3; ++component)
  {
    separate->CopyComponent(component, interleaved, component);
  }
  for (vtkDataArray* array : { interleaved.Get(), static_cast<vtkDataArray*>(separate) })
  {
    Scene scene(NewImageOf(array));
    vtkVolumeProperty* property = scene.Property();
    scene.SetSurface(50.0, { 1.0, 0.0, 0.0 }, 0.5);
    vtkNew<vtkColorTransferFunction> ivory;
    ivory->AddRGBPoint(50.0, 0.9, 0.8, 0.7);
    vtkNew<vtkPiecewiseFunction> opaque;
    opaque->AddPoint(50.0, 1.0);
    property->SetColor(2, ivory);
    property->SetScalarOpacity(2, opaque);
    property->SetShade(2, 1);
    property->SetComponentWeight(0, 0.2);
    property->SetComponentWeight(1, 0.3);
    property->SetComponentWeight(2, 0.9);
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      std::string("the difference with a component of ") + array->GetClassName());
  }
}

void CheckNamedArray(Checks& check, const Picture& expected)
{
  const auto image = NewBall(Samples, 0.5);
  const auto hills = NewHills(VTK_INT);
  hills->SetName("hills");
  image->GetPointData()->AddArray(hills);
  Scene scene(image);
  scene.SetSurface(50.0, { 0.9, 0.8, 0.7 }, 1.0);
  scene.Mapper->SetScalarModeToUsePointFieldData();
  scene.Mapper->SelectScalarArray("hills");
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference with an array by name");
}

/// A component by its number, past the fourth too, and the length of a vector.
void CheckVectors(Checks& check, const Picture& expected)
{
  const auto many = NewHills(VTK_SHORT, 7, 6);
  Scene scene(NewImageOf(many));
  scene.SetSurface(50.0, { 0.9, 0.8, 0.7 }, 1.0);
  scene.Mapper->SetVectorModeToComponent();
  scene.Mapper->SetVectorComponent(6);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference with a component by its number");
  many->FillComponent(6, 0.0);
  many->Modified();
  check.That(GetDifference(RenderAndCapture(scene.Window), expected, 0) > 0.0, "it is read again");

  for (const int type : { VTK_SHORT, VTK_FLOAT, VTK_INT })
  {
    const auto vectors = NewHills(type, 3, 1);
    const auto lengths = NewHills(VTK_DOUBLE);
    for (vtkIdType i = 0; i < vectors->GetNumberOfTuples(); ++i)
    {
      const double* vector = vectors->GetTuple3(i);
      lengths->SetComponent(i, 0, std::hypot(std::hypot(vector[0], vector[1]), vector[2]));
    }
    scene.Mapper->SetInputData(NewImageOf(vectors));
    scene.Mapper->SetVectorModeToMagnitude();
    check.Equal(GetDifference(RenderAndCapture(scene.Window), Draw(NewImageOf(lengths), 50.0), 0),
      0.0, "the difference with the lengths of vectors");
  }
}

/// Magnitudes are not rounded to single precision: what corners have is hit there.
void CheckMagnitudes(Checks& check)
{
  const std::pair<int, double> cases[] = { { VTK_UNSIGNED_CHAR, 1.0 }, { VTK_SHORT, 30000.0 },
    { VTK_FLOAT, 3e38 } };
  for (const auto& [type, number] : cases)
  {
    auto vectors = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    vectors->SetNumberOfComponents(3);
    vectors->SetNumberOfTuples(8);
    vectors->Fill(0.0);
    for (vtkIdType i = 4; i < 8; ++i)
    {
      vectors->SetTuple3(i, number, number, 0.0);
    }
    vtkNew<vtkImageData> image;
    image->SetDimensions(2, 2, 2);
    image->GetPointData()->SetScalars(vectors);
    const double length = std::hypot(vectors->GetComponent(4, 0), vectors->GetComponent(4, 1));
    for (const double height : { 0.5, 1.0 })
    {
      Scene scene(image);
      scene.SetSurface(height * length, { 0.9, 0.8, 0.7 }, 1.0);
      scene.Mapper->SetVectorModeToMagnitude();
      const double p1[3] = { 0.5, 0.5, -1.0 };
      const double p2[3] = { 0.5, 0.5, 2.0 };
      double t;
      double position[3] = {};
      double inCell[3];
      vtkIdType cell;
      double isovalue;
      double normal[3];
      const std::string name = vectors->GetDataTypeAsString();
      check.That(scene.Mapper->IntersectWithLine(
                   scene.Volume, p1, p2, t, position, inCell, cell, isovalue, normal) != 0,
        "a magnitude of " + name + " is hit");
      check.Near(position[2], height, 1e-14, "the place of a magnitude of " + name);
    }
  }
}

/// The scalars of cells are samples at their centres; what is hit is a cell of the image.
void CheckCells(Checks& check, const Picture& expected)
{
  const auto points = NewCube(Samples, Hills);
  const double spacing = points->GetSpacing()[0];
  vtkNew<vtkImageData> cells;
  cells->SetDimensions(Samples + 1, Samples + 1, Samples + 1);
  cells->SetSpacing(spacing, spacing, spacing);
  cells->SetOrigin(-1.0 - 0.5 * spacing, -1.0 - 0.5 * spacing, -1.0 - 0.5 * spacing);
  const auto hills = NewHills(VTK_DOUBLE);
  hills->SetName("hills");
  cells->GetCellData()->SetScalars(hills);
  Scene scene(cells);
  scene.SetSurface(50.0, { 0.9, 0.8, 0.7 }, 1.0);
  scene.Renderer->GetActiveCamera()->DeepCopy(Scene(points).Renderer->GetActiveCamera());
  const Picture byDefault = RenderAndCapture(scene.Window);
  check.That(
    GetDifference(byDefault, expected, 2) < 0.002, "cells look like points at their centres");
  scene.Mapper->SetScalarModeToUseCellFieldData();
  scene.Mapper->SelectScalarArray("hills");
  check.Equal(GetDifference(RenderAndCapture(scene.Window), byDefault, 0), 0.0,
    "the difference with an array of cells by name");

  int hits = 0;
  for (int i = 0; i < 400; ++i)
  {
    const double x = -0.9 + 0.09 * (i % 20);
    const double y = -0.9 + 0.09 * (i / 20);
    const double p1[3] = { x, y, 3.0 };
    const double p2[3] = { x + 0.1, y - 0.2, -3.0 };
    double t;
    double position[3];
    double inCell[3];
    vtkIdType cell;
    double isovalue;
    double normal[3];
    if (scene.Mapper->IntersectWithLine(
          scene.Volume, p1, p2, t, position, inCell, cell, isovalue, normal) == 0)
    {
      continue;
    }
    ++hits;
    double bounds[6];
    cells->GetCellBounds(cell, bounds);
    for (int axis = 0; axis < 3; ++axis)
    {
      check.That(inCell[axis] >= 0.0 && inCell[axis] <= 1.0, "the coordinates are in the cell");
      check.Near(bounds[2 * axis] + inCell[axis] * spacing, position[axis], 1e-12,
        "cell and coordinates of a hit");
    }
  }
  check.That(hits > 200, "most lines hit");
}

/// Where samples are no numbers there are holes, and nothing else is different.
void CheckHoles(Checks& check)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { std::nan(""), infinity, -infinity })
  {
    const auto whole = NewBall(33, 0.7);
    const auto holed = NewBall(33, 0.7);
    // The samples about the point of the ball that is nearest to the eye.
    for (int z = 15; z <= 17; ++z)
    {
      for (int y = 3; y <= 6; ++y)
      {
        for (int x = 15; x <= 17; ++x)
        {
          holed->SetScalarComponentFromDouble(x, y, z, 0, bad);
        }
      }
    }
    Scene scene(whole);
    scene.Property()->ShadeOff();
    scene.LookFrom(0.0, -4.0, 0.0);
    scene.SetSurface(0.0, { 1.0, 0.0, 0.0 }, 1.0);
    const Picture expected = RenderAndCapture(scene.Window);
    const DepthPicture before(scene.Window, scene.Renderer);
    scene.Mapper->SetInputData(holed);
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "through the hole one sees the back of the ball, elsewhere nothing changes");
    const DepthPicture after(scene.Window, scene.Renderer);
    int deeper = 0;
    int moved = 0;
    for (int y = 0; y < before.GetHeight(); ++y)
    {
      for (int x = 0; x < before.GetWidth(); ++x)
      {
        const double difference = after.GetDepth(x, y) - before.GetDepth(x, y);
        deeper += difference > 0.1 ? 1 : 0;
        moved += difference != 0.0 && difference <= 0.1 ? 1 : 0;
      }
    }
    // Four by four cells of the 32 that the ball's cube has across.
    check.That(deeper > 100 && deeper < 500, "the hole has the size of its cells");
    check.Equal(moved, 0, "the number of pixels that moved");
  }
}

}

int TestIsosurfaceRayTraceMapperScalars(int argc, char* argv[])
{
  Checks check;
  const auto image = NewImageOf(NewHills(VTK_DOUBLE));
  const Picture expected = Draw(image, 50.0);
  CheckTypes(check, expected);
  CheckLargeValues(check, expected);
  CheckBits(check);
  CheckComponents(check, expected);
  CheckNamedArray(check, expected);
  CheckVectors(check, expected);
  CheckMagnitudes(check);
  CheckCells(check, expected);
  CheckHoles(check);
  Scene scene(image);
  scene.SetSurface(50.0, { 0.9, 0.8, 0.7 }, 1.0);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
