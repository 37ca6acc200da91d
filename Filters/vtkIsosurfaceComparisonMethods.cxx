// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonMethods.h"

#include "vtkIsosurfaceComparisonTime.h"

#include "vtkCallbackCommand.h"
#include "vtkColorTransferFunction.h"
#include "vtkContour3DLinearGrid.h"
#include "vtkContourFilter.h"
#include "vtkContourGrid.h"
#include "vtkContourValues.h"
#include "vtkDoubleArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkMarchingCubes.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
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
  FilterExtraction(vtkDataSet* data, bool normals)
  {
    this->Filter->SetInputData(data);
    this->Filter->SetComputeNormals(normals);
    this->Filter->ComputeGradientsOff();
    this->Filter->ComputeScalarsOff();
  }

  vtkAlgorithm* GetFilter() override { return this->Filter; }
  void SetIsovalue(double isovalue) override { this->Filter->SetValue(0, isovalue); }

protected:
  vtkNew<FilterT> Filter;
};

/// Its normals are those of merged points; without them the points of each triangle are its own.
void MergePoints(vtkContour3DLinearGrid* filter, bool merge)
{
  filter->SetMergePoints(merge);
}

void MergePoints(vtkContourGrid* /*filter*/, bool /*merge*/) {}

template <typename FilterT>
class MeshExtraction : public Extraction
{
public:
  MeshExtraction(vtkDataSet* data, bool normals)
  {
    this->Filter->SetInputData(data);
    this->Filter->SetComputeNormals(normals);
    this->Filter->ComputeScalarsOff();
    MergePoints(this->Filter, normals);
  }

  vtkAlgorithm* GetFilter() override { return this->Filter; }
  void SetIsovalue(double isovalue) override { this->Filter->SetValue(0, isovalue); }

private:
  vtkNew<FilterT> Filter;
};

class SpanSpaceExtraction : public FilterExtraction<vtkContourFilter>
{
public:
  SpanSpaceExtraction(vtkDataSet* data, bool normals)
    : FilterExtraction<vtkContourFilter>(data, normals)
  {
    this->Grid->ShallowCopy(data);
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
std::unique_ptr<Extraction> New(vtkDataSet* data, bool normals)
{
  return std::make_unique<ExtractionT>(data, normals);
}

//------------------------------------------------------------------------------
double GetBuildTime(vtkIsosurfaceRayTraceMapper* mapper)
{
  return mapper->GetMacrocellBuildTime();
}

double GetBuildTime(vtkIsosurfaceRayTraceMeshMapper* mapper)
{
  return mapper->GetTreeBuildTime();
}

vtkIdType GetMemory(vtkIsosurfaceRayTraceMapper* mapper)
{
  return mapper->GetMacrocellMemory() + mapper->GetBrickMemory();
}

vtkIdType GetMemory(vtkIsosurfaceRayTraceMeshMapper* mapper)
{
  return mapper->GetTreeMemory() + mapper->GetSurfaceMemory();
}

/// Keeps the text of an error. What is reported before it, where in the source it comes from, is
/// cut off.
void KeepError(vtkObject*, unsigned long, void* problem, void* report)
{
  const std::string text = static_cast<const char*>(report);
  const std::size_t source = text.find("): ");
  const std::string words = source == std::string::npos ? text : text.substr(source + 3);
  *static_cast<std::string*>(problem) = words.substr(0, words.find_last_not_of('\n') + 1);
}

//------------------------------------------------------------------------------
template <typename MapperT>
class MappedIsosurface : public TracedIsosurface
{
public:
  explicit MappedIsosurface(vtkDataSet* data)
  {
    this->Mapper->SetInputDataObject(data);
    this->GetVolume()->SetMapper(this->Mapper);
    // Notes tell what it would warn of: an isovalue without a surface.
    vtkNew<vtkCallbackCommand> silence;
    this->Mapper->AddObserver(vtkCommand::WarningEvent, silence);
  }

  const char* GetName() const override { return this->Mapper->GetClassName(); }
  void UseExactNormals() override { this->Mapper->SetNormalModeToInterpolantGradient(); }

  bool CastRays(vtkPoints* origins, vtkDataArray* directions, vtkPolyData* hits) override
  {
    return this->Mapper->CastRays(this->GetVolume(), origins, directions, hits);
  }

  std::string FindProblem() override
  {
    std::string problem;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback(KeepError);
    observer->SetClientData(&problem);
    const unsigned long tag = this->Mapper->AddObserver(vtkCommand::ErrorEvent, observer);
    vtkNew<vtkPoints> noOrigins;
    vtkNew<vtkDoubleArray> noDirections;
    noDirections->SetNumberOfComponents(3);
    vtkNew<vtkPolyData> noHits;
    this->CastRays(noOrigins, noDirections, noHits);
    this->Mapper->RemoveObserver(tag);
    return problem;
  }

  double Build() override
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
    this->Mapper->IntersectWithLine(
      this->GetVolume(), from, to, t, x, pcoords, cell, isovalue, normal);
    return GetBuildTime(this->Mapper.Get());
  }

  vtkIdType GetMemory() override { return vtkIsosurfaceComparison::GetMemory(this->Mapper.Get()); }

private:
  vtkNew<MapperT> Mapper;
};

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
const ExtractionMethod ContourGrid = { "vtkContourGrid", New<MeshExtraction<vtkContourGrid>>,
  false };
const ExtractionMethod Contour3DLinearGrid = { "vtkContour3DLinearGrid",
  New<MeshExtraction<vtkContour3DLinearGrid>>, false };

//------------------------------------------------------------------------------
bool HeedsDirection(const ExtractionMethod& method)
{
  vtkNew<vtkDoubleArray> scalars;
  for (int i = 0; i < 8; ++i)
  {
    scalars->InsertNextValue(i);
  }
  // A cell in which no x is positive.
  vtkNew<vtkImageData> cell;
  cell->SetDimensions(2, 2, 2);
  cell->SetDirectionMatrix(-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0);
  cell->GetPointData()->SetScalars(scalars);
  const auto extraction = method.New(cell, false);
  extraction->SetIsovalue(3.4);
  extraction->Build();
  extraction->GetFilter()->Update();
  return extraction->GetTriangles()->GetBounds()[1] <= 0.0;
}

//------------------------------------------------------------------------------
vtkPolyData* Extraction::GetTriangles()
{
  return vtkPolyData::SafeDownCast(this->GetFilter()->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
std::unique_ptr<TracedIsosurface> TracedIsosurface::New(vtkDataSet* data)
{
  if (vtkImageData::SafeDownCast(data))
  {
    return std::make_unique<MappedIsosurface<vtkIsosurfaceRayTraceMapper>>(data);
  }
  return std::make_unique<MappedIsosurface<vtkIsosurfaceRayTraceMeshMapper>>(data);
}

//------------------------------------------------------------------------------
TracedIsosurface::TracedIsosurface() = default;

//------------------------------------------------------------------------------
TracedIsosurface::~TracedIsosurface() = default;

//------------------------------------------------------------------------------
SurfaceVolume::SurfaceVolume()
{
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
void SurfaceVolume::SetIsovalue(double isovalue)
{
  this->Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, isovalue);
}

}
