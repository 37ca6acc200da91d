// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceHolder.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkCollectionRange.h"
#include "vtkCommand.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// Lets objects go when a frame of a window has ended, and does what an observer has done to a
/// volume and a renderer.
class EndOfFrame : public vtkCommand
{
public:
  static EndOfFrame* New() { return new EndOfFrame; }

  void Execute(vtkObject* window, unsigned long /*event*/, void* /*data*/) override
  {
    const vtkSmartPointer<EndOfFrame> self = this;
    window->RemoveObserver(this);
    this->Volume->SetMapper(this->NextMapper);
    this->Renderer->SetRenderWindow(this->NextWindow);
    this->Props.clear();
  }

  vtkSmartPointer<vtkVolume> Volume;
  vtkSmartPointer<vtkAbstractVolumeMapper> NextMapper;
  vtkSmartPointer<vtkRenderer> Renderer;
  /// Not owned: it owns this command, if it is the one of the frame.
  vtkWeakPointer<vtkRenderWindow> NextWindow;
  std::vector<vtkSmartPointer<vtkProp>> Props;
};

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceHolder::vtkIsosurfaceRayTraceHolder(
  vtkRenderer* renderer, vtkVolume* volume, vtkAbstractVolumeMapper* mapper)
  : Window(renderer->GetRenderWindow())
  , TellsContext(this->Window->IsCurrent())
  , Renderer(renderer)
  , Volume(volume)
  , Mapper(mapper)
  , End(vtkSmartPointer<EndOfFrame>::New())
{
  for (vtkObject* prop : vtk::Range(renderer->GetViewProps()))
  {
    this->Props.emplace_back(vtkProp::SafeDownCast(prop));
  }
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceHolder::~vtkIsosurfaceRayTraceHolder()
{
  if (!this->HasContext())
  {
    this->Window->Start();
  }
  if (!this->IsAnythingGone())
  {
    return;
  }
  auto* end = static_cast<EndOfFrame*>(this->End.Get());
  end->Volume = this->Volume;
  end->NextMapper = this->Volume->GetMapper();
  end->Renderer = this->Renderer;
  end->NextWindow = this->Renderer->GetRenderWindow();
  end->Props = std::move(this->Props);
  this->Volume->SetMapper(this->Mapper);
  this->Renderer->SetRenderWindow(this->Window);
  this->Window->AddObserver(vtkCommand::EndEvent, end);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceHolder::CanDraw() const
{
  return this->HasContext() && this->Renderer->GetRenderWindow() == this->Window;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceHolder::HasContext() const
{
  this->Window->MakeCurrent();
  return this->Window->IsCurrent() || !this->TellsContext;
}

//------------------------------------------------------------------------------
/// Whether the mapper has left its volume, the renderer its window, or a prop its renderer, or its
/// place there.
bool vtkIsosurfaceRayTraceHolder::IsAnythingGone() const
{
  // Others may have come between them.
  std::size_t found = 0;
  for (vtkObject* prop : vtk::Range(this->Renderer->GetViewProps()))
  {
    found += found < this->Props.size() && prop == this->Props[found].Get() ? 1 : 0;
  }
  return found < this->Props.size() || this->Volume->GetMapper() != this->Mapper ||
    this->Window->HasRenderer(this->Renderer) == 0 || this->Volume->GetReferenceCount() == 1;
}

VTK_ABI_NAMESPACE_END
