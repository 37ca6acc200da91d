// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMapper.h"

#include "vtkIsosurfaceRayTraceEngine.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceMapper);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMapper::vtkIsosurfaceRayTraceMapper()
  : Engine(std::make_unique<vtkIsosurfaceRayTraceEngine>(this,
      vtkIsosurfaceRayTraceEngine::Client{ [this] { return this->GetSettings(); },
        [this](int connection)
        {
          return std::make_unique<vtkIsosurfaceRayTraceInput>(
            this, connection, [this] { return this->GetInputSettings(); });
        },
        [this](int connection) { return this->GetConnectionVolume(connection); },
        [this](float distance) { this->ImageSampleDistance = distance; },
        "Call SetMaximumBrickMemory() or SetBrickLayoutToNoBricks(), or make the picture or the "
        "input smaller." }))
{
  this->BlendMode = vtkVolumeMapper::ISOSURFACE_BLEND;
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMapper::~vtkIsosurfaceRayTraceMapper() = default;

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkRectilinearGrid");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  }
  else
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetColorInputData(vtkImageData* image)
{
  this->SetInputDataInternal(1, image);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetMacrocellMemory()
{
  return static_cast<vtkIdType>(this->Engine->GetStatistics().HierarchyMemory);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetBrickMemory()
{
  return static_cast<vtkIdType>(this->Engine->GetStatistics().CacheMemory);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetNumberOfBricks()
{
  return static_cast<vtkIdType>(this->Engine->GetStatistics().NumberOfBricks);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetMaximumNumberOfBricks()
{
  return static_cast<vtkIdType>(this->Engine->GetStatistics().MaximumNumberOfBricks);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Update()
{
  this->Update(-1);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Update(int /*port*/)
{
  vtkIsosurfaceRayTraceEngine::UpdateInputs(this);
}

//------------------------------------------------------------------------------
double* vtkIsosurfaceRayTraceMapper::GetBounds()
{
  return this->Engine->FindBounds(this->CompositeDataDisplayAttributes, this->Bounds)
    ? this->Bounds
    : this->Superclass::GetBounds();
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceMapper::FindBlock(
  vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex)
{
  return this->Engine->FindBlock(cellId, cellInBlock, flatIndex);
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMapper::GetMacrocellBuildTime()
{
  return this->Engine->GetHierarchyTime();
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMapper::GetBrickBuildTime()
{
  return this->Engine->GetTimes().Bricks;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMapper::GetTraceTime()
{
  return this->Engine->GetTimes().Trace;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMapper::GetShadeTime()
{
  return this->Engine->GetTimes().Shade;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMapper::GetDisplayTime()
{
  return this->Engine->GetDisplayTime();
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::GetNumberOfAccumulatedFrames()
{
  return this->Engine->GetNumberOfAccumulatedFrames();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::HasOnlyOpaqueSurfaces(vtkVolume* volume)
{
  return this->Engine->HasOnlyOpaqueSurfaces(volume);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  // Observers may take the mapper out of the volume.
  const vtkSmartPointer<vtkIsosurfaceRayTraceMapper> self = this;
  const double seconds = this->Engine->Render(renderer, volume);
  if (seconds > 0.0)
  {
    this->TimeToDraw = seconds;
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Engine->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::IntersectWithLine(vtkVolume* volume, const double p1[3],
  const double p2[3], double& t, double x[3], double pcoords[3], vtkIdType& cellId,
  double& isovalue, double normal[3])
{
  return this->Engine->IntersectWithLine(volume, p1, p2, t, x, pcoords, cellId, isovalue, normal);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::CastRays(
  vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output)
{
  return this->Engine->CastRays(volume, origins, directions, output);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::FindSurfaceBounds(vtkVolume* volume, double bounds[6])
{
  return this->Engine->FindSurfaceBounds(volume, bounds);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column,
  int row, double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3])
{
  return this->Engine->PickPixel(
    renderer, volume, column, row, x, pcoords, cellId, isovalue, normal);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::RenderToImage(vtkVolume* volume, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height, vtkImageData* output, vtkFloatArray* depths)
{
  return this->Engine->RenderToImage(volume, { camera, lights, width, height, depths }, output);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::RenderToFragments(vtkVolume* volume, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height, vtkTable* output, vtkFloatArray* depths)
{
  return this->Engine->RenderToFragments(
    volume, { camera, lights, width, height, depths, true }, output);
}

VTK_ABI_NAMESPACE_END
