// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceFactory
 * @brief   have vtkSmartVolumeMapper ray trace isosurfaces in its OSPRay mode
 *
 * An application that uses vtkSmartVolumeMapper, and lets its user select OSPRay, gets the
 * isosurfaces of vtkIsosurfaceRayTraceMapper without a change: once the factory is switched on, a
 * vtkSmartVolumeMapper on which SetRequestedRenderModeToOSPRay() was called renders every frame by
 * a vtkIsosurfaceRayTraceMapper with its inputs, scalars, VectorMode, blend mode, cropping and
 * clipping planes. Blend modes that vtkIsosurfaceRayTraceMapper does not support are an error.
 *
 * The factory overrides vtkOSPRayVolumeInterface. A vtkSmartVolumeMapper keeps the object that it
 * created in its first frame in the OSPRay mode: switch the factory on before. In a VTK built with
 * OSPRay, it replaces OSPRay for volumes without an OSPRay render pass.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkSmartVolumeMapper vtkObjectFactory
 */

#ifndef vtkIsosurfaceRayTraceFactory_h
#define vtkIsosurfaceRayTraceFactory_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfaceRayTraceFactory : public vtkObjectFactory
{
public:
  static vtkIsosurfaceRayTraceFactory* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceFactory, vtkObjectFactory);

  ///@{
  /**
   * Switch the factory on and off, for the whole process. Repeated calls have no effect. Default:
   * off.
   */
  static void SwitchOn();
  static void SwitchOff();
  static bool IsOn();
  ///@}

  const char* GetVTKSourceVersion() override;
  const char* GetDescription() override;

protected:
  vtkIsosurfaceRayTraceFactory();
  ~vtkIsosurfaceRayTraceFactory() override;

private:
  vtkIsosurfaceRayTraceFactory(const vtkIsosurfaceRayTraceFactory&) = delete;
  void operator=(const vtkIsosurfaceRayTraceFactory&) = delete;
};

VTK_ABI_NAMESPACE_END

#endif
