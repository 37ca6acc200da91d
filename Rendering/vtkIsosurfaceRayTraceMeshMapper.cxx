// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMeshMapper.h"

#include "vtkIsosurfaceRayTraceEngine.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceSettings.h"
#include "vtkIsosurfaceRayTraceSharedSettings.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGridBase.h"

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceMeshMapper);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshMapper::vtkIsosurfaceRayTraceMeshMapper()
  : Engine(std::make_unique<vtkIsosurfaceRayTraceEngine>(this,
      vtkIsosurfaceRayTraceEngine::Client{ [this] { return this->GetSettings(); },
        [this](int connection)
        {
          return std::make_unique<vtkIsosurfaceRayTraceInput>(
            this, connection, [this] { return this->GetInputSettings(); });
        },
        [this](int connection) { return this->GetConnectionVolume(connection); },
        [this](float distance) { this->ImageSampleDistance = distance; },
        "Make the picture or the input smaller." }))
{
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshMapper::~vtkIsosurfaceRayTraceMeshMapper() = default;

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMeshMapper::FillInputPortInformation(int /*port*/, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkRectilinearGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::SetInputData(vtkUnstructuredGridBase* grid)
{
  this->SetInputDataInternal(0, grid);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::SetInputData(vtkDataSet* grid)
{
  this->SetInputDataInternal(0, grid);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::Update()
{
  this->Update(0);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::Update(int /*port*/)
{
  vtkIsosurfaceRayTraceEngine::UpdateInputs(this);
}

//------------------------------------------------------------------------------
double* vtkIsosurfaceRayTraceMeshMapper::GetBounds()
{
  return this->Engine->FindBounds(this->CompositeDataDisplayAttributes, this->Bounds)
    ? this->Bounds
    : this->Superclass::GetBounds();
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceMeshMapper::FindBlock(
  vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex)
{
  return this->Engine->FindBlock(cellId, cellInBlock, flatIndex);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::SetTileSize(int width, int height)
{
  if (vtkIsosurfaceRayTraceSharedSettings::SetTileSize(width, height, this->TileSize))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::SetConnectionVolume(int connection, vtkVolume* volume)
{
  if (connection < 0)
  {
    vtkErrorMacro("There is no connection " << connection << ". Give a number from 0 on.");
  }
  else if (vtkIsosurfaceRayTraceSharedSettings::SetAt(connection, volume, this->ConnectionVolumes))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkVolume* vtkIsosurfaceRayTraceMeshMapper::GetConnectionVolume(int connection) const
{
  return vtkIsosurfaceRayTraceSharedSettings::GetAt(connection, this->ConnectionVolumes);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::SetCompositeDataDisplayAttributes(
  vtkCompositeDataDisplayAttributes* attributes)
{
  if (this->CompositeDataDisplayAttributes != attributes)
  {
    this->CompositeDataDisplayAttributes = attributes;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::SetColorArrayName(const char* name)
{
  if (vtkIsosurfaceRayTraceSharedSettings::SetName(name, this->ColorArrayName))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSettings vtkIsosurfaceRayTraceMeshMapper::GetSettings() const
{
  vtkIsosurfaceRayTraceSettings settings;
  vtkIsosurfaceRayTraceSharedSettings::Fill(*this, settings);
  return settings;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceInputSettings vtkIsosurfaceRayTraceMeshMapper::GetInputSettings() const
{
  vtkIsosurfaceRayTraceInputSettings settings{};
  vtkIsosurfaceRayTraceSharedSettings::Fill(*this, settings);
  settings.Tetrahedralize = this->Tetrahedralize;
  return settings;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMeshMapper::GetTreeBuildTime()
{
  return this->Engine->GetHierarchyTime();
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMeshMapper::GetGradientTime()
{
  return this->Engine->GetGradientTime();
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMeshMapper::GetTraceTime()
{
  return this->Engine->GetTimes().Trace;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMeshMapper::GetShadeTime()
{
  return this->Engine->GetTimes().Shade;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMeshMapper::GetDisplayTime()
{
  return this->Engine->GetDisplayTime();
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMeshMapper::GetNumberOfAccumulatedFrames()
{
  return this->Engine->GetNumberOfAccumulatedFrames();
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshMapper::GetTreeMemory()
{
  return static_cast<vtkIdType>(this->Engine->GetStatistics().HierarchyMemory);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshMapper::GetSurfaceMemory()
{
  return static_cast<vtkIdType>(this->Engine->GetStatistics().CacheMemory);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshMapper::HasOnlyOpaqueSurfaces(vtkVolume* volume)
{
  return this->Engine->HasOnlyOpaqueSurfaces(volume);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  // Observers may take the mapper out of the volume.
  const vtkSmartPointer<vtkIsosurfaceRayTraceMeshMapper> self = this;
  const double seconds = this->Engine->Render(renderer, volume);
  if (seconds > 0.0)
  {
    this->TimeToDraw = seconds;
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Engine->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMeshMapper::IntersectWithLine(vtkVolume* volume, const double p1[3],
  const double p2[3], double& t, double x[3], double pcoords[3], vtkIdType& cellId,
  double& isovalue, double normal[3])
{
  return this->Engine->IntersectWithLine(volume, p1, p2, t, x, pcoords, cellId, isovalue, normal);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshMapper::CastRays(
  vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output)
{
  return this->Engine->CastRays(volume, origins, directions, output);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshMapper::FindSurfaceBounds(vtkVolume* volume, double bounds[6])
{
  return this->Engine->FindSurfaceBounds(volume, bounds);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMeshMapper::PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column,
  int row, double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3])
{
  return this->Engine->PickPixel(
    renderer, volume, column, row, x, pcoords, cellId, isovalue, normal);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshMapper::RenderToImage(vtkVolume* volume, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height, vtkImageData* output, vtkFloatArray* depths)
{
  return this->Engine->RenderToImage(volume, { camera, lights, width, height, depths }, output);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshMapper::RenderToFragments(vtkVolume* volume, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height, vtkTable* output, vtkFloatArray* depths)
{
  return this->Engine->RenderToFragments(
    volume, { camera, lights, width, height, depths, true }, output);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkIsosurfaceRayTraceMeshMapper::SafeDownCast(mapper))
  {
    vtkIsosurfaceRayTraceSharedSettings::CopyConnections(other, 0, this);
    vtkIsosurfaceRayTraceSharedSettings::CopyChoiceOfScalars(other, this);
    this->SetBlendMode(other->GetBlendMode());
    this->SetTetrahedralize(other->GetTetrahedralize());
    vtkIsosurfaceRayTraceSharedSettings::Visit<vtkIsosurfaceRayTraceMeshMapper>(
      [this, other](const char*, auto setting, auto...)
      { vtkIsosurfaceRayTraceSharedSettings::Assign(this->*setting, other->*setting); });
  }
  this->Superclass::ShallowCopy(mapper);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const vtkIsosurfaceRayTraceSharedSettings::Printer print{ os, indent };
  print.PrintChoiceOfScalars(this);
  print("Tetrahedralize", this->Tetrahedralize);
  vtkIsosurfaceRayTraceSharedSettings::Visit<vtkIsosurfaceRayTraceMeshMapper>(
    [this, print](const char* name, auto setting, auto... names)
    { print(name, this->*setting, names...); });
  print("NumberOfAccumulatedFrames", this->GetNumberOfAccumulatedFrames());
  print("TreeBuildTime", this->GetTreeBuildTime());
  print("GradientTime", this->GetGradientTime());
  print("TraceTime", this->GetTraceTime());
  print("ShadeTime", this->GetShadeTime());
  print("DisplayTime", this->GetDisplayTime());
  print("TreeMemory", this->GetTreeMemory());
  print("SurfaceMemory", this->GetSurfaceMemory());
}

VTK_ABI_NAMESPACE_END
