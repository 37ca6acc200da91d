// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TestImages_h
#define TestImages_h

#include "AnalyticFields.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>

#include <array>
#include <vector>

namespace MapperTesting
{

/// A cube of so many samples along each edge, from -1 to 1, of a field of points in it.
template <typename Field>
vtkSmartPointer<vtkImageData> NewCube(int samples, const Field& field)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  const double spacing = 2.0 / (samples - 1);
  image->SetDimensions(samples, samples, samples);
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(-1.0, -1.0, -1.0);
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("field");
  scalars->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    AnalyticFields::Point point;
    image->GetPoint(i, point.data());
    scalars->SetValue(i, field(point));
  }
  image->GetPointData()->SetScalars(scalars);
  return image;
}

inline vtkSmartPointer<vtkImageData> NewBall(int samples, double radius)
{
  return NewCube(samples, AnalyticFields::Sphere{ { 0.0, 0.0, 0.0 }, radius });
}

inline vtkSmartPointer<vtkDataArray> NewCoordinates(const std::vector<double>& values, int type)
{
  auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->SetComponent(static_cast<vtkIdType>(i), 0, values[i]);
  }
  return array;
}

/// A grid with samples of a field at its points, and at the centres of its cells.
template <typename Field>
vtkSmartPointer<vtkRectilinearGrid> NewGrid(
  const std::array<std::vector<double>, 3>& coordinates, const Field& field, int type = VTK_DOUBLE)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(static_cast<int>(coordinates[0].size()),
    static_cast<int>(coordinates[1].size()), static_cast<int>(coordinates[2].size()));
  grid->SetXCoordinates(NewCoordinates(coordinates[0], type));
  grid->SetYCoordinates(NewCoordinates(coordinates[1], type));
  grid->SetZCoordinates(NewCoordinates(coordinates[2], type));
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("field");
  vtkNew<vtkDoubleArray> ofCells;
  ofCells->SetName("field");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    AnalyticFields::Point point;
    grid->GetPoint(i, point.data());
    scalars->InsertNextValue(field(point));
  }
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    double b[6];
    grid->GetCellBounds(i, b);
    ofCells->InsertNextValue(
      field({ 0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3]), 0.5 * (b[4] + b[5]) }));
  }
  grid->GetPointData()->SetScalars(scalars);
  grid->GetCellData()->AddArray(ofCells);
  return grid;
}

}

#endif
