// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Histogram.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace Viewer
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkActor2D> MakeHistogram(const std::vector<double>& counts, const Place& place)
{
  const double highest = std::log1p(*std::max_element(counts.begin(), counts.end()));
  const double width = (place.Right - place.Left) / static_cast<double>(counts.size());
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> bars;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    const double left = place.Left + static_cast<double>(i) * width;
    const double top = place.Bottom + std::log1p(counts[i]) / highest * (place.Top - place.Bottom);
    bars->InsertNextCell({ points->InsertNextPoint(left, place.Bottom, 0.0),
      points->InsertNextPoint(left + width, place.Bottom, 0.0),
      points->InsertNextPoint(left + width, top, 0.0), points->InsertNextPoint(left, top, 0.0) });
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(bars);

  vtkNew<vtkCoordinate> coordinate;
  coordinate->SetCoordinateSystemToNormalizedViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape);
  mapper->SetTransformCoordinate(coordinate);
  mapper->TransformCoordinateUseDoubleOn();
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.62, 0.65, 0.70);
  return actor;
}

}
