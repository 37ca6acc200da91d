// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Refinement.h"

#include "ObserveAlways.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkCommand.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

namespace Viewer
{
namespace
{

constexpr unsigned long MillisecondsOfTimer = 10;
/// A hand that moves the mouse slowly makes no longer pauses.
constexpr std::chrono::milliseconds Rest(80);

}

//------------------------------------------------------------------------------
Refinement::Refinement(vtkRenderWindowInteractor* interactor, vtkIsosurfaceRayTraceMapper* mapper)
  : Interactor(interactor)
  , Mapper(mapper)
{
  for (const unsigned long event : { vtkCommand::MouseMoveEvent, vtkCommand::MouseWheelForwardEvent,
         vtkCommand::MouseWheelBackwardEvent })
  {
    ObserveAlways(interactor, event, this, &Refinement::OnMotion);
  }
  for (const unsigned long event : { vtkCommand::LeftButtonReleaseEvent,
         vtkCommand::MiddleButtonReleaseEvent, vtkCommand::RightButtonReleaseEvent })
  {
    ObserveAlways(interactor, event, this, &Refinement::OnRelease);
  }
  ObserveAlways(interactor, vtkCommand::TimerEvent, this, &Refinement::OnTimer);
}

//------------------------------------------------------------------------------
bool Refinement::IsMoving() const
{
  return this->Interactor->GetRenderWindow()->GetDesiredUpdateRate() >
    this->Interactor->GetStillUpdateRate();
}

//------------------------------------------------------------------------------
void Refinement::Start()
{
  this->Interactor->GetRenderWindow()->AddObserver(
    vtkCommand::EndEvent, this, &Refinement::OnFrame);
  this->Interactor->CreateRepeatingTimer(MillisecondsOfTimer);
}

//------------------------------------------------------------------------------
bool Refinement::IsFinished() const
{
  const int frames = this->Mapper->GetNumberOfAccumulatedFrames();
  const bool isCoarse = this->Mapper->GetImageSampleDistance() > 1.0F;
  return !isCoarse &&
    (frames == 0 || frames == this->Mapper->GetMaximumNumberOfAccumulatedFrames());
}

//------------------------------------------------------------------------------
void Refinement::OnMotion()
{
  this->LastMotion = std::chrono::steady_clock::now();
  if (this->IsPaused)
  {
    this->IsPaused = false;
    this->Interactor->GetRenderWindow()->SetDesiredUpdateRate(
      this->Interactor->GetDesiredUpdateRate());
  }
}

//------------------------------------------------------------------------------
/// Motion during a frame is told after it, however long it takes.
void Refinement::OnFrame()
{
  if (this->IsMoving())
  {
    this->LastMotion = std::chrono::steady_clock::now();
  }
}

//------------------------------------------------------------------------------
void Refinement::OnRelease()
{
  this->IsPaused = false;
}

//------------------------------------------------------------------------------
void Refinement::OnTimer()
{
  if (std::chrono::steady_clock::now() - this->LastMotion < Rest || this->IsFinished())
  {
    return;
  }
  if (this->IsMoving())
  {
    this->IsPaused = true;
    this->Interactor->GetRenderWindow()->SetDesiredUpdateRate(
      this->Interactor->GetStillUpdateRate());
  }
  this->Interactor->Render();
}

}
