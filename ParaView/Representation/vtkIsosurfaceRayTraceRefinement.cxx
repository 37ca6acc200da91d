// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceRefinement.h"

#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{
constexpr unsigned long Milliseconds = 50;

//------------------------------------------------------------------------------
// What a refined picture depends on and this process knows: the time of the last change of data or
// properties, the camera and the size.
std::vector<double> Describe(vtkPVRenderView* view)
{
  vtkRenderer* renderer = view->GetRenderer();
  const double* matrix =
    renderer->GetActiveCamera()
      ->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0)
      ->GetData();
  const int* size = view->GetRenderWindow()->GetSize();
  std::vector<double> shown(matrix, matrix + 16);
  shown.insert(shown.end(),
    { static_cast<double>(view->GetUpdateTimeStamp()), static_cast<double>(size[0]),
      static_cast<double>(size[1]) });
  return shown;
}
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceRefinement);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceRefinement::vtkIsosurfaceRayTraceRefinement() = default;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceRefinement::~vtkIsosurfaceRayTraceRefinement() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRefinement::Continue(vtkPVRenderView* view, int numberOfPictures)
{
  const std::vector<double> shown = Describe(view);
  if (this->Shown != shown)
  {
    this->Shown = shown;
    this->NumberOfPictures = 0;
  }
  ++this->NumberOfPictures;
  vtkRenderWindowInteractor* interactor = view->GetInteractor();
  if (interactor && !this->Interactor && this->NumberOfPictures < numberOfPictures)
  {
    this->Interactor = interactor;
    this->Observer = interactor->AddObserver(
      vtkCommand::TimerEvent, this, &vtkIsosurfaceRayTraceRefinement::Render);
    this->Timer = interactor->CreateOneShotTimer(Milliseconds);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRefinement::Stop()
{
  if (this->Interactor)
  {
    this->Interactor->DestroyTimer(this->Timer);
    this->Interactor->RemoveObserver(this->Observer);
    this->Interactor = nullptr;
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRefinement::Render(
  vtkObject* vtkNotUsed(caller), unsigned long vtkNotUsed(event), void* timer)
{
  if (this->Interactor && *static_cast<int*>(timer) == this->Timer)
  {
    // The interactor destroys the timer itself, while it goes through its timers.
    const vtkSmartPointer<vtkRenderWindowInteractor> interactor = this->Interactor.Get();
    interactor->RemoveObserver(this->Observer);
    this->Interactor = nullptr;
    // ParaView's views observe that, and draw on all processes.
    interactor->Render();
  }
}

VTK_ABI_NAMESPACE_END
