// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceFactory
 * @brief   have vtkSmartVolumeMapper ray trace isosurfaces in its OSPRay mode
 *
 * An application that has vtkSmartVolumeMapper, and lets its user ask it for OSPRay, gets this
 * mapper's isosurfaces without a change: once the factory is switched on, a vtkSmartVolumeMapper of
 * which SetRequestedRenderModeToOSPRay() was called hands every frame to a
 * vtkIsosurfaceRayTraceMapper with its inputs, scalars, VectorMode, blend mode, cropping and
 * clipping planes. Other blend modes than that of isosurfaces are an error, as of the mapper.
 *
 * The factory overrides vtkOSPRayVolumeInterface. What a vtkSmartVolumeMapper has made in its first
 * frame in the OSPRay mode, it keeps: switch the factory on before. In a VTK that has OSPRay it
 * takes the place of OSPRay for volumes without an OSPRay render pass.
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
   * Switch the factory on and off, for the whole process. To do either again changes nothing.
   * Default: off.
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
