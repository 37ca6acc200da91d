// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TracedIsosurface.h"

#include "Samples.h"

#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>

namespace Benchmark
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkVolumeProperty> NewSurfaceProperty(double isovalue)
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->GetIsoSurfaceValues()->SetValue(0, isovalue);
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(isovalue, 0.96, 0.90, 0.80);
  property->SetColor(color);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(isovalue - 1e-3 * std::max(1.0, std::abs(isovalue)), 0.0);
  opacity->AddPoint(isovalue, 1.0);
  property->SetScalarOpacity(opacity);
  property->SetInterpolationTypeToLinear();
  property->ShadeOn();
  return property;
}

//------------------------------------------------------------------------------
TracedIsosurface::TracedIsosurface(vtkImageData* image, int size, int threads)
  : Image(image)
  , Size(size)
  , Threads(threads)
{
  image->GetBounds(this->Box.data());
  if (OffScreenWindow::IsPossible())
  {
    this->Window = std::make_unique<OffScreenWindow>(size);
  }
  this->Forget();
}

//------------------------------------------------------------------------------
TracedIsosurface::~TracedIsosurface() = default;

//------------------------------------------------------------------------------
void TracedIsosurface::Forget()
{
  this->Mapper = vtkSmartPointer<vtkIsosurfaceRayTraceMapper>::New();
  this->Mapper->SetInputData(this->Image);
  this->Volume = vtkSmartPointer<vtkVolume>::New();
  this->Volume->SetMapper(this->Mapper);
  if (this->Window)
  {
    this->Window->Show(this->Volume);
  }
}

//------------------------------------------------------------------------------
void TracedIsosurface::SetIsovalue(double isovalue)
{
  this->Volume->SetProperty(NewSurfaceProperty(isovalue));
}

//------------------------------------------------------------------------------
double TracedIsosurface::Begin(double isovalue, const View& view)
{
  const double* range = this->Image->GetScalarRange();
  const double step = 0.05 * (range[1] - range[0]);
  this->Forget();
  this->SetIsovalue(isovalue + step < range[1] ? isovalue + step : isovalue - step);
  this->Draw(view, this->Threads);
  this->SetIsovalue(isovalue);
  const FrameTimes times = this->Draw(view, this->Threads);
  return std::isnan(times.Whole) ? times.Trace : times.Whole;
}

//------------------------------------------------------------------------------
FrameTimes TracedIsosurface::Draw(const View& view, int threads)
{
  this->LastView = view;
  this->Mapper->SetNumberOfThreads(threads);
  FrameTimes times;
  if (this->Window)
  {
    times.Whole = this->Window->Draw(view);
    times.Trace = this->Mapper->GetTraceTime();
  }
  else
  {
    times.Trace = this->CastRays(view, this->GetPixels(view));
  }
  return times;
}

//------------------------------------------------------------------------------
double TracedIsosurface::GetHitShare()
{
  this->CastRays(this->LastView, this->GetPixels(this->LastView));
  return static_cast<double>(this->Hits) / this->Size / this->Size;
}

//------------------------------------------------------------------------------
PixelRectangle TracedIsosurface::GetPixels(const View& view) const
{
  return PictureRays(view, this->Size).GetPixels(this->Box);
}

//------------------------------------------------------------------------------
double TracedIsosurface::CastRays(const View& view, const PixelRectangle& pixels)
{
  const PictureRays rays(view, this->Size);
  vtkNew<vtkPoints> origins;
  origins->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  for (int y = pixels.Y; y < pixels.Y + pixels.Height; ++y)
  {
    for (int x = pixels.X; x < pixels.X + pixels.Width; ++x)
    {
      origins->InsertNextPoint(rays.GetOrigin().data());
      directions->InsertNextTuple(rays.GetDirection(x, y).data());
    }
  }
  vtkNew<vtkPolyData> hits;
  const double seconds =
    Measure([&]() { this->Mapper->CastRays(this->Volume, origins, directions, hits); });
  this->Hits = hits->GetNumberOfPoints();
  return seconds;
}

}
