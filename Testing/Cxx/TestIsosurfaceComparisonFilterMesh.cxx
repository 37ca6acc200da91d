// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// vtkIsosurfaceComparisonFilter with meshes: curvilinear grids, the same cells listed, and split
// into tetrahedra.

#include "AnalyticFields.h"
#include "Checks.h"
#include "vtkIsosurfaceComparisonFilter.h"

#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkContourGrid.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <cmath>
#include <string>
#include <vector>

using namespace MapperTesting;
using AnalyticFields::Point;

namespace
{

//------------------------------------------------------------------------------
/// So many points along each axis, on the cube from -1 to 1, which is bent so that no face is
/// plane.
template <typename Field>
vtkSmartPointer<vtkStructuredGrid> NewBentGrid(int edge, const Field& field)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName("field");
  for (int i = 0; i < edge * edge * edge; ++i)
  {
    const double step = 2.0 / (edge - 1);
    const Point p = { step * (i % edge) - 1.0, step * (i / edge % edge) - 1.0,
      step * (i / edge / edge) - 1.0 };
    const Point bent = { p[0] + 0.1 * std::sin(3.0 * p[1] + p[2]),
      p[1] + 0.1 * std::sin(3.0 * p[2] + p[0]), p[2] + 0.1 * std::sin(3.0 * p[0] + p[1]) };
    points->InsertNextPoint(bent.data());
    values->InsertNextValue(field(bent));
  }
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(edge, edge, edge);
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(values);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> ListCells(vtkDataSet* grid)
{
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(grid);
  append->Update();
  return append->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> SplitCells(vtkDataSet* grid)
{
  vtkNew<vtkDataSetTriangleFilter> split;
  split->SetInputData(grid);
  split->Update();
  return split->GetOutput();
}

//------------------------------------------------------------------------------
enum Rows
{
  ContourGridRow,
  LinearGridRow,
  RayTracingRow,
  NumberOfRows
};

vtkSmartPointer<vtkIsosurfaceComparisonFilter> Compare(vtkDataSet* data, double isovalue)
{
  auto comparison = vtkSmartPointer<vtkIsosurfaceComparisonFilter>::New();
  comparison->SetInputData(data);
  comparison->SetValue(0, isovalue);
  comparison->SetNumberOfRepeats(1);
  comparison->PicturesOff();
  comparison->SetImageSize(96, 96);
  comparison->Update();
  return comparison;
}

double Get(vtkIsosurfaceComparisonFilter* comparison, vtkIdType row, const char* column)
{
  return comparison->GetOutput()->GetValueByName(row, column).ToDouble();
}

//------------------------------------------------------------------------------
// Both VTK's filters and the mapper are rows, and the hits are on the surface that VTK's own cells
// have.
void TestRows(Checks& checks, vtkDataSet* data, const std::string& name)
{
  const auto comparison = Compare(data, 0.0);
  const char* methods[] = { "vtkContourGrid", "vtkContour3DLinearGrid",
    "vtkIsosurfaceRayTraceMeshMapper" };
  vtkTable* table = comparison->GetOutput();
  checks.Equal<vtkIdType>(table->GetNumberOfRows(), NumberOfRows, name + ": rows");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    checks.Equal<std::string>(
      table->GetValueByName(row, "Method").ToString(), methods[row], name + ": method");
    checks.Equal<std::string>(table->GetValueByName(row, "Note").ToString(), "", name + ": note");
    checks.That(std::isnan(Get(comparison, row, "AmbiguousCells")), name + ": no topology");
  }
  vtkNew<vtkContourGrid> contour;
  contour->SetInputData(ListCells(data));
  contour->SetValue(0, 0.0);
  contour->Update();
  for (const Rows row : { ContourGridRow, LinearGridRow })
  {
    checks.Equal(Get(comparison, row, "Triangles"),
      static_cast<double>(contour->GetOutput()->GetNumberOfPolys()), name + ": triangles");
    checks.Equal(
      Get(comparison, row, "IsosurfaceAlonePixels") + Get(comparison, row, "MeshAlonePixels"),
      Get(comparison, row, "DifferentPixels"), name + ": pixels that differ");
  }
  checks.That(Get(comparison, RayTracingRow, "CoveredPixels") > 500.0, name + ": hits");
  checks.That(Get(comparison, RayTracingRow, "Bytes") > 0.0, name + ": memory of the tree");
  checks.Near(
    Get(comparison, RayTracingRow, "MaximumDistance"), 0.0, 1e-12, name + ": distance of hits");
  checks.Near(
    Get(comparison, RayTracingRow, "MaximumNormalError"), 0.0, 1e-5, name + ": normals of hits");
  checks.Equal(Get(comparison, RayTracingRow, "LostPoints"), 0.0, name + ": lost hits");
}

//------------------------------------------------------------------------------
// The interpolant of a plane is the plane in any cell. In a bent face at the border, the triangles
// end with a straight edge, the isosurface does not; tetrahedra have no bent faces.
void TestPlanes(Checks& checks)
{
  const auto grid = NewBentGrid(9, AnalyticFields::Plane{ { 0.3, -0.4, 1.0 }, 0.13 });
  const auto tetrahedra = SplitCells(grid);
  for (vtkDataSet* data : { static_cast<vtkDataSet*>(grid), static_cast<vtkDataSet*>(tetrahedra) })
  {
    const auto comparison = Compare(data, 0.0);
    for (const Rows row : { ContourGridRow, LinearGridRow })
    {
      checks.That(Get(comparison, row, "Triangles") > 100.0, "a plane has triangles");
      checks.Near(Get(comparison, row, "MaximumDistance"), 0.0, 1e-6, "distance of a plane");
      checks.Near(Get(comparison, row, "MedianNormalError"), 0.0, 1e-3, "normal of a plane");
      checks.Equal(Get(comparison, row, "LostPoints"), 0.0, "lost points of a plane");
      checks.Near(Get(comparison, row, "DifferentPixels"), 0.0, data == grid ? 100.0 : 0.0,
        "pixels of a plane that differ");
    }
  }
}

//------------------------------------------------------------------------------
// Triangles are chords: halving the cells quarters the distance, but in units of the cells it is
// halved.
void TestOrder(Checks& checks)
{
  const AnalyticFields::Sphere ball{ { 0.013, -0.021, 0.017 }, 0.71 };
  const auto coarse = Compare(NewBentGrid(13, ball), 0.0);
  const auto fine = Compare(NewBentGrid(25, ball), 0.0);
  for (const char* column : { "MedianDistance", "P99Distance" })
  {
    checks.Near(std::log2(Get(coarse, LinearGridRow, column) / Get(fine, LinearGridRow, column)),
      2.0, 0.3, std::string("order of ") + column);
  }
  checks.Near(std::log2(Get(coarse, LinearGridRow, "MedianDistanceInCells") /
                Get(fine, LinearGridRow, "MedianDistanceInCells")),
    1.0, 0.3, "order of the distance in cells");
}

//------------------------------------------------------------------------------
// In a mesh of tetrahedra the triangles are the isosurface; in its cells the distance is that of
// the vertices' rounding to float.
void TestTetrahedra(Checks& checks)
{
  const AnalyticFields::Sphere ball{ { 0.013, -0.021, 0.017 }, 0.71 };
  const auto comparison = Compare(SplitCells(NewBentGrid(13, ball)), 0.0);
  for (const Rows row : { ContourGridRow, LinearGridRow })
  {
    checks.Near(Get(comparison, row, "MaximumDistance"), 0.0, 1e-6, "distance in tetrahedra");
    checks.Equal(Get(comparison, row, "LostPoints"), 0.0, "lost points in tetrahedra");
    checks.Near(Get(comparison, row, "DifferentPixels"), 0.0, 1.0, "pixels with tetrahedra");
  }
}

//------------------------------------------------------------------------------
void TestOutputs(Checks& checks)
{
  const auto comparison =
    Compare(NewBentGrid(9, AnalyticFields::Sphere{ { 0.0, 0.0, 0.0 }, 0.7 }), 0.0);
  auto* mesh = vtkPolyData::SafeDownCast(comparison->GetOutputDataObject(1));
  auto* difference = vtkImageData::SafeDownCast(comparison->GetOutputDataObject(2));
  checks.Equal(static_cast<double>(mesh->GetNumberOfPolys()),
    3.0 * Get(comparison, ContourGridRow, "Triangles"), "triangles cut in three");
  checks.That(mesh->GetPointData()->GetArray("DistanceInCells"), "there are distances");
  checks.Equal<vtkIdType>(difference->GetNumberOfPoints(), 96 * 96, "pixels");
}

//------------------------------------------------------------------------------
// VTK's filters would read beyond the points.
void TestInvalidMesh(Checks& checks)
{
  const auto grid = ListCells(NewBentGrid(3, AnalyticFields::Plane{ { 0.0, 0.0, 1.0 }, 0.0 }));
  vtkDataArray* ids = grid->GetCells()->GetConnectivityArray();
  ids->SetComponent(5, 0, 1e6);
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  vtkNew<EventCounter> errors;
  comparison->AddObserver(vtkCommand::ErrorEvent, errors);
  comparison->SetInputData(grid);
  comparison->Update();
  checks.Equal(errors->Count, 1, "errors of an invalid mesh");
  vtkTable* table = comparison->GetOutput();
  checks.Equal<vtkIdType>(table->GetNumberOfRows(), NumberOfRows, "rows of an invalid mesh");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    checks.That(
      table->GetValueByName(row, "Note").ToString().find("Cell 0 has a wrong") != std::string::npos,
      "an invalid mesh has a note");
  }
}

//------------------------------------------------------------------------------
void TestMethods(Checks& checks)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  vtkNew<EventCounter> warnings;
  comparison->AddObserver(vtkCommand::WarningEvent, warnings);
  comparison->SetInputData(NewBentGrid(5, AnalyticFields::Plane{ { 0.0, 0.0, 1.0 }, 0.1 }));
  comparison->PicturesOff();
  comparison->ContourGridOff();
  comparison->Contour3DLinearGridOff();
  comparison->Update();
  checks.Equal<vtkIdType>(comparison->GetOutput()->GetNumberOfRows(), 1, "rays alone");
  checks.Equal(warnings->Count, 0, "warnings with a method");
  comparison->RayTracingOff();
  comparison->Update();
  checks.Equal<vtkIdType>(comparison->GetOutput()->GetNumberOfRows(), 0, "methods of images");
  checks.Equal(warnings->Count, 1, "warnings without a method for meshes");
}

} // anonymous namespace

//------------------------------------------------------------------------------
int TestIsosurfaceComparisonFilterMesh(int, char*[])
{
  Checks checks;
  const auto grid = NewBentGrid(13, AnalyticFields::Sphere{ { 0.013, -0.021, 0.017 }, 0.71 });
  TestRows(checks, grid, "curvilinear grid");
  TestRows(checks, ListCells(grid), "listed hexahedra");
  TestRows(checks, SplitCells(grid), "tetrahedra");
  TestPlanes(checks);
  TestOrder(checks);
  TestTetrahedra(checks);
  TestOutputs(checks);
  TestInvalidMesh(checks);
  TestMethods(checks);
  return checks.Result();
}
