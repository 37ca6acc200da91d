// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The settings of the mapper: how they are set, copied, printed and passed on.

#include "vtkIsosurfaceRayTraceEnumerators.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceSettings.h"
#include "vtkIsosurfaceRayTraceSharedSettings.h"

#include "vtkImageData.h"
#include "vtkVersionMacros.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

const char* const InterpolationModeNames[] = { "Trilinear", "Nearest", "Cubic" };
const char* const RootSolverNames[] = { "Robust", "Analytic", "Marmitt", "Linear" };
const char* const BrickLayoutNames[] = { "NoBricks", "ApronBricks", "TwoLevelBricks" };

}

//------------------------------------------------------------------------------
/// Calls visit(name, pointer to member) for every setting, and with the names of the enumerators if
/// it has some.
template <typename Visitor>
void vtkIsosurfaceRayTraceMapper::VisitSettings(const Visitor& visit)
{
  using Self = vtkIsosurfaceRayTraceMapper;
  vtkIsosurfaceRayTraceSharedSettings::Visit<Self>(visit);
  visit("InterpolationMode", &Self::InterpolationMode, InterpolationModeNames);
  visit("RootSolver", &Self::RootSolver, RootSolverNames);
  visit("NumberOfInterpolations", &Self::NumberOfInterpolations);
  visit("BrickLayout", &Self::BrickLayout, BrickLayoutNames);
  visit("BrickSize", &Self::BrickSize);
  visit("BrickGroupSize", &Self::BrickGroupSize);
  visit("MaximumBrickMemory", &Self::MaximumBrickMemory);
  visit("NumberOfMacrocellLevels", &Self::NumberOfMacrocellLevels);
  visit("MacrocellBranching", &Self::MacrocellBranching);
  visit("CacheDirectory", &Self::CacheDirectory);
  visit("LevelOfDetail", &Self::LevelOfDetail);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* volumeMapper = vtkVolumeMapper::SafeDownCast(mapper))
  {
    this->CopyVolumeMapper(volumeMapper);
  }
  if (auto* other = vtkIsosurfaceRayTraceMapper::SafeDownCast(mapper))
  {
    VisitSettings([this, other](const char*, auto setting, auto...)
      { vtkIsosurfaceRayTraceSharedSettings::Assign(this->*setting, other->*setting); });
  }
  this->Superclass::ShallowCopy(mapper);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::CopyVolumeMapper(vtkVolumeMapper* mapper)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkIsosurfaceRayTraceSharedSettings::CopyConnections(mapper, port, this);
  }
  vtkIsosurfaceRayTraceSharedSettings::CopyChoiceOfScalars(mapper, this);
  this->SetBlendMode(mapper->GetBlendMode());
  this->SetAverageIPScalarRange(mapper->GetAverageIPScalarRange());
  this->SetCropping(mapper->GetCropping());
  this->SetCroppingRegionPlanes(mapper->GetCroppingRegionPlanes());
  this->SetCroppingRegionFlags(mapper->GetCroppingRegionFlags());
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  this->SetComputeNormalFromOpacity(mapper->GetComputeNormalFromOpacity());
#endif
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetConnectionVolume(int connection, vtkVolume* volume)
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
vtkVolume* vtkIsosurfaceRayTraceMapper::GetConnectionVolume(int connection) const
{
  return vtkIsosurfaceRayTraceSharedSettings::GetAt(connection, this->ConnectionVolumes);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetCompositeDataDisplayAttributes(
  vtkCompositeDataDisplayAttributes* attributes)
{
  if (this->CompositeDataDisplayAttributes != attributes)
  {
    this->CompositeDataDisplayAttributes = attributes;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetColorArrayName(const char* name)
{
  if (vtkIsosurfaceRayTraceSharedSettings::SetName(name, this->ColorArrayName))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetCacheDirectory(const char* name)
{
  if (vtkIsosurfaceRayTraceSharedSettings::SetName(name, this->CacheDirectory))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::HasMacrocellLevel(int level)
{
  if (level < 0 || level >= MaximumNumberOfMacrocellLevels)
  {
    vtkErrorMacro("There is no macrocell level " << level << ": levels are 0 to "
                                                 << MaximumNumberOfMacrocellLevels - 1 << ".");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetMacrocellBranching(int level, int branching)
{
  const int clamped = std::clamp(branching, 2, 64);
  if (this->HasMacrocellLevel(level) && this->MacrocellBranching[level] != clamped)
  {
    this->MacrocellBranching[level] = clamped;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::GetMacrocellBranching(int level)
{
  return this->HasMacrocellLevel(level) ? this->MacrocellBranching[level] : 0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetTileSize(int width, int height)
{
  if (vtkIsosurfaceRayTraceSharedSettings::SetTileSize(width, height, this->TileSize))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceInputSettings vtkIsosurfaceRayTraceMapper::GetInputSettings() const
{
  // VTK's own functions that only look are not const.
  auto* self = const_cast<vtkIsosurfaceRayTraceMapper*>(this);
  vtkIsosurfaceRayTraceInputSettings settings{};
  vtkIsosurfaceRayTraceSharedSettings::Fill(*this, settings);
  settings.ColorImage = vtkImageData::SafeDownCast(self->GetInputDataObject(1, 0));
  settings.Image.MacrocellBranching.assign(
    this->MacrocellBranching, this->MacrocellBranching + this->NumberOfMacrocellLevels);
  settings.Image.Layout = vtkIsosurfaceRayTraceEnumerators::ToBrickLayout(this->BrickLayout);
  settings.Image.BrickSize = this->BrickSize;
  settings.Image.BrickGroupSize = this->BrickGroupSize;
  settings.CacheDirectory = this->CacheDirectory;
  settings.Cropping = self;
  return settings;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSettings vtkIsosurfaceRayTraceMapper::GetSettings() const
{
  namespace enumerators = vtkIsosurfaceRayTraceEnumerators;
  vtkIsosurfaceRayTraceSettings settings;
  vtkIsosurfaceRayTraceSharedSettings::Fill(*this, settings);
  settings.BlendMode = this->BlendMode;
  settings.Projection = enumerators::FindProjection(this->BlendMode);
  settings.InterpolationMode = enumerators::ToInterpolant(this->InterpolationMode);
  settings.RootSolver = enumerators::ToRootSolver(this->RootSolver);
  settings.NumberOfInterpolations = this->NumberOfInterpolations;
  settings.LevelOfDetail = this->LevelOfDetail;
  if (this->MaximumBrickMemory > 0)
  {
    settings.MaximumMemory = static_cast<std::size_t>(this->MaximumBrickMemory) << 20;
  }
  return settings;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const vtkIsosurfaceRayTraceSharedSettings::Printer print{ os, indent };
  print.PrintChoiceOfScalars(this);
  VisitSettings([this, print](const char* name, auto setting, auto... names)
    { print(name, this->*setting, names...); });
  print("NumberOfAccumulatedFrames", this->GetNumberOfAccumulatedFrames());
  print("MacrocellBuildTime", this->GetMacrocellBuildTime());
  print("BrickBuildTime", this->GetBrickBuildTime());
  print("TraceTime", this->GetTraceTime());
  print("ShadeTime", this->GetShadeTime());
  print("DisplayTime", this->GetDisplayTime());
  print("MacrocellMemory", this->GetMacrocellMemory());
  print("BrickMemory", this->GetBrickMemory());
  print("NumberOfBricks", this->GetNumberOfBricks());
  print("MaximumNumberOfBricks", this->GetMaximumNumberOfBricks());
}

VTK_ABI_NAMESPACE_END
