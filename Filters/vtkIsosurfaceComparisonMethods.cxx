// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonMethods.h"

#include "vtkIsosurfaceComparisonTime.h"

#include "vtkColorTransferFunction.h"
#include "vtkContourFilter.h"
#include "vtkContourValues.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkMarchingCubes.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSpanSpace.h"
#include "vtkSynchronizedTemplates3D.h"
#include "vtkUniformGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

namespace vtkIsosurfaceComparison
{
namespace
{

template <typename FilterT>
class FilterExtraction : public Extraction
{
public:
  FilterExtraction(vtkImageData* image, bool normals)
  {
    this->Filter->SetInputData(image);
    this->Filter->SetComputeNormals(normals);
    this->Filter->ComputeGradientsOff();
    this->Filter->ComputeScalarsOff();
  }

  vtkPolyDataAlgorithm* GetFilter() override { return this->Filter; }
  void SetIsovalue(double isovalue) override { this->Filter->SetValue(0, isovalue); }

protected:
  vtkNew<FilterT> Filter;
};

class SpanSpaceExtraction : public FilterExtraction<vtkContourFilter>
{
public:
  SpanSpaceExtraction(vtkImageData* image, bool normals)
    : FilterExtraction<vtkContourFilter>(image, normals)
  {
    this->Grid->ShallowCopy(image);
    this->Tree->SetDataSet(this->Grid);
    this->Tree->SetScalars(this->Grid->GetPointData()->GetScalars());
    this->Filter->SetInputData(this->Grid);
    this->Filter->UseScalarTreeOn();
    this->Filter->SetScalarTree(this->Tree);
  }

  double Build() override
  {
    const Stopwatch watch;
    this->Tree->BuildTree();
    return watch.GetSeconds();
  }

private:
  vtkNew<vtkUniformGrid> Grid;
  vtkNew<vtkSpanSpace> Tree;
};

template <typename ExtractionT>
std::unique_ptr<Extraction> New(vtkImageData* image, bool normals)
{
  return std::make_unique<ExtractionT>(image, normals);
}

}

const ExtractionMethod FlyingEdges = { "vtkFlyingEdges3D", New<FilterExtraction<vtkFlyingEdges3D>>,
  false };
const ExtractionMethod MarchingCubes = { "vtkMarchingCubes",
  New<FilterExtraction<vtkMarchingCubes>>, false };
const ExtractionMethod SynchronizedTemplates = { "vtkSynchronizedTemplates3D",
  New<FilterExtraction<vtkSynchronizedTemplates3D>>, false };
const ExtractionMethod ContourFilter = { "vtkContourFilter",
  New<FilterExtraction<vtkContourFilter>>, false };
const ExtractionMethod SpanSpace = { "vtkSpanSpace", New<SpanSpaceExtraction>, true };

//------------------------------------------------------------------------------
TracedIsosurface::TracedIsosurface(vtkImageData* image)
{
  this->Mapper->SetInputData(image);
  this->Volume->SetMapper(this->Mapper);
  vtkNew<vtkColorTransferFunction> white;
  white->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  vtkNew<vtkPiecewiseFunction> opaque;
  opaque->AddPoint(0.0, 1.0);
  vtkVolumeProperty* property = this->Volume->GetProperty();
  property->SetColor(white);
  property->SetScalarOpacity(opaque);
  property->ShadeOn();
}

//------------------------------------------------------------------------------
TracedIsosurface::~TracedIsosurface() = default;

//------------------------------------------------------------------------------
void TracedIsosurface::SetIsovalue(double isovalue)
{
  this->Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, isovalue);
}

//------------------------------------------------------------------------------
double TracedIsosurface::Build()
{
  // Any line will do: before it is cast, the volume is brought up to date.
  const double from[3] = { 0.0, 0.0, 0.0 };
  const double to[3] = { 1.0, 0.0, 0.0 };
  double t;
  double x[3];
  double pcoords[3];
  double isovalue;
  double normal[3];
  vtkIdType cell;
  this->Mapper->IntersectWithLine(this->Volume, from, to, t, x, pcoords, cell, isovalue, normal);
  return this->Mapper->GetMacrocellBuildTime();
}

}
