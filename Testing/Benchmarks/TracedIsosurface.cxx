// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TracedIsosurface.h"

#include "Samples.h"

#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
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
  return this->Draw(view, this->Threads).GetSeconds();
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
  return static_cast<double>(this->Hits->GetNumberOfPoints()) / this->Size / this->Size;
}

//------------------------------------------------------------------------------
std::vector<double> TracedIsosurface::GetDistances()
{
  const PictureRays rays(this->LastView, this->Size);
  this->CastRays(this->LastView, { 0, 0, this->Size, this->Size });
  std::vector<double> distances(static_cast<std::size_t>(this->Size) * this->Size, NoHit);
  vtkDataArray* pixels = this->Hits->GetPointData()->GetArray("RayId");
  vtkDataArray* ts = this->Hits->GetPointData()->GetArray("T");
  for (vtkIdType i = 0; i < this->Hits->GetNumberOfPoints(); ++i)
  {
    const int pixel = static_cast<int>(pixels->GetComponent(i, 0));
    const Triple direction = rays.GetDirection(pixel % this->Size, pixel / this->Size);
    distances[static_cast<std::size_t>(pixel)] =
      ts->GetComponent(i, 0) * vtkMath::Norm(direction.data());
  }
  return distances;
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
  return Measure([&]() { this->Mapper->CastRays(this->Volume, origins, directions, this->Hits); });
}

}
