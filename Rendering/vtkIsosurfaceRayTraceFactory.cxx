// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceFactory.h"

#include "vtkIsosurfaceRayTraceMapper.h"

#include "vtkNew.h"
#include "vtkOSPRayVolumeInterface.h"
#include "vtkObjectFactoryCollection.h"
#include "vtkSmartVolumeMapper.h"
#include "vtkVersion.h"
#include "vtkVolume.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// Draws a volume as its own mapper is set, by a vtkIsosurfaceRayTraceMapper.
class IsosurfaceInterface : public vtkOSPRayVolumeInterface
{
public:
  static IsosurfaceInterface* New();
  vtkTypeMacro(IsosurfaceInterface, vtkOSPRayVolumeInterface);

  void Render(vtkRenderer* renderer, vtkVolume* volume) override
  {
    // vtkSmartVolumeMapper passes nothing of itself but the volume.
    vtkAbstractVolumeMapper* mapper = volume->GetMapper();
    this->Mapper->ShallowCopy(mapper);
    if (auto* smart = vtkSmartVolumeMapper::SafeDownCast(mapper))
    {
      this->Mapper->SetVectorMode(smart->GetVectorMode());
      this->Mapper->SetVectorComponent(smart->GetVectorComponent());
      this->Mapper->SetAutoAdjustSampleDistances(smart->GetAutoAdjustSampleDistances());
    }
    this->Mapper->Render(renderer, volume);
    this->TimeToDraw = this->Mapper->GetTimeToDraw();
  }

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->Mapper->ReleaseGraphicsResources(window);
    this->Superclass::ReleaseGraphicsResources(window);
  }

protected:
  IsosurfaceInterface() = default;
  ~IsosurfaceInterface() override = default;

private:
  IsosurfaceInterface(const IsosurfaceInterface&) = delete;
  void operator=(const IsosurfaceInterface&) = delete;

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
};

vtkStandardNewMacro(IsosurfaceInterface);

VTK_CREATE_CREATE_FUNCTION(IsosurfaceInterface);

/// The one that is switched on, if it is.
vtkIsosurfaceRayTraceFactory* FindFactory()
{
  vtkObjectFactoryCollection* factories = vtkObjectFactory::GetRegisteredFactories();
  for (int i = 0; i < factories->GetNumberOfItems(); ++i)
  {
    auto* factory = vtkIsosurfaceRayTraceFactory::SafeDownCast(factories->GetItemAsObject(i));
    if (factory)
    {
      return factory;
    }
  }
  return nullptr;
}

}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceFactory);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceFactory::vtkIsosurfaceRayTraceFactory()
{
  this->RegisterOverride("vtkOSPRayVolumeInterface", "vtkIsosurfaceRayTraceMapper",
    "isosurfaces by vtkIsosurfaceRayTraceMapper", 1, vtkObjectFactoryCreateIsosurfaceInterface);
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceFactory::~vtkIsosurfaceRayTraceFactory() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceFactory::SwitchOn()
{
  if (!FindFactory())
  {
    vtkObjectFactory::RegisterFactory(vtkNew<vtkIsosurfaceRayTraceFactory>());
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceFactory::SwitchOff()
{
  if (vtkIsosurfaceRayTraceFactory* factory = FindFactory())
  {
    vtkObjectFactory::UnRegisterFactory(factory);
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceFactory::IsOn()
{
  return FindFactory() != nullptr;
}

//------------------------------------------------------------------------------
const char* vtkIsosurfaceRayTraceFactory::GetVTKSourceVersion()
{
  return VTK_SOURCE_VERSION;
}

//------------------------------------------------------------------------------
const char* vtkIsosurfaceRayTraceFactory::GetDescription()
{
  return "isosurfaces by vtkIsosurfaceRayTraceMapper in the OSPRay mode of vtkSmartVolumeMapper";
}

VTK_ABI_NAMESPACE_END
