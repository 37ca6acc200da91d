// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Asks for one still picture after the other, as long as they refine an unchanged scene. It does so
// in the process that has the interactor, by its timer: events of the user are handled between.

#ifndef vtkIsosurfaceRayTraceRefinement_h
#define vtkIsosurfaceRayTraceRefinement_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for ivars

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkPVRenderView;
class vtkRenderWindowInteractor;

class vtkIsosurfaceRayTraceRefinement : public vtkObject
{
public:
  static vtkIsosurfaceRayTraceRefinement* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceRefinement, vtkObject);

  /// Asks for a further picture of a view, if there have been fewer than a number of them of what
  /// it shows now. To be called after each still picture.
  void Continue(vtkPVRenderView* view, int numberOfPictures);

  /// Takes back what was asked for.
  void Stop();

protected:
  vtkIsosurfaceRayTraceRefinement();
  ~vtkIsosurfaceRayTraceRefinement() override;

private:
  vtkIsosurfaceRayTraceRefinement(const vtkIsosurfaceRayTraceRefinement&) = delete;
  void operator=(const vtkIsosurfaceRayTraceRefinement&) = delete;

  void Render(vtkObject* caller, unsigned long event, void* timer);

  vtkWeakPointer<vtkRenderWindowInteractor> Interactor; // null if nothing was asked for
  unsigned long Observer = 0;
  int Timer = 0;
  std::vector<double> Shown;
  int NumberOfPictures = 0;
};

VTK_ABI_NAMESPACE_END

#endif
