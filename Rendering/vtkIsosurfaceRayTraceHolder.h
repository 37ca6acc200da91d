// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceHolder
 * @brief   holds what VTK goes on with after a mapper has rendered
 *
 * An observer may take the volume out of its renderer, the mapper out of its volume, or the
 * renderer out of its window while a frame is traced: the last reference may be gone. But VTK calls
 * the mapper from within them, and goes on with them and the props behind them afterwards.
 */

#ifndef vtkIsosurfaceRayTraceHolder_h
#define vtkIsosurfaceRayTraceHolder_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkAbstractVolumeMapper;
class vtkCommand;
class vtkProp;
class vtkRenderer;
class vtkRenderWindow;
class vtkVolume;

class vtkIsosurfaceRayTraceHolder
{
public:
  vtkIsosurfaceRayTraceHolder(
    vtkRenderer* renderer, vtkVolume* volume, vtkAbstractVolumeMapper* mapper);

  /// Lets go. What was taken away is held until the frame of the window ends; until then the mapper
  /// stays in the volume, and the renderer in the window. A window that was finalized is
  /// initialized again, since VTK goes on to draw into it.
  ~vtkIsosurfaceRayTraceHolder();

  vtkIsosurfaceRayTraceHolder(const vtkIsosurfaceRayTraceHolder&) = delete;
  void operator=(const vtkIsosurfaceRayTraceHolder&) = delete;

  /// Whether the renderer can draw into its window: an observer may have taken it away, or
  /// finalized the window. Makes the context of the window current, if an observer has drawn into
  /// another.
  bool CanDraw() const;

  vtkRenderWindow* GetWindow() const { return this->Window; }
  vtkRenderer* GetRenderer() const { return this->Renderer; }
  vtkVolume* GetVolume() const { return this->Volume; }

private:
  bool HasContext() const;
  bool IsAnythingGone() const;

  vtkSmartPointer<vtkRenderWindow> Window;
  /// Whether the window tells if its context is current. (Some that applications make the context
  /// for do not.)
  bool TellsContext;
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkVolume> Volume;
  vtkSmartPointer<vtkAbstractVolumeMapper> Mapper;
  /// All of the renderer.
  std::vector<vtkSmartPointer<vtkProp>> Props;
  /// Made in time: the destructor must not run out of memory.
  vtkSmartPointer<vtkCommand> End;
};

VTK_ABI_NAMESPACE_END

#endif
