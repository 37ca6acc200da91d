// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSharedPicture.h"

#include "vtkIsosurfaceRayTraceCompositor.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include "vtkCameraPass.h"
#include "vtkCommand.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPVDataRepresentation.h"
#include "vtkPVRenderView.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkViewport.h"
#include "vtkVolume.h"
#include "vtkVolumeCollection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#if __has_include("vtkIceTCompositePass.h")
#define HAS_ICET 1 // not without MPI
#include "vtkIceTCompositePass.h"
#else
#define HAS_ICET 0
#endif

VTK_ABI_NAMESPACE_BEGIN

namespace
{
//------------------------------------------------------------------------------
int GetNumberOfProcesses()
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  return controller ? controller->GetNumberOfProcesses() : 1;
}

//------------------------------------------------------------------------------
int GetProcess()
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  return controller ? controller->GetLocalProcessId() : 0;
}

//------------------------------------------------------------------------------
bool DoOverlap(const vtkBoundingBox& one, const vtkBoundingBox& other, double tolerance)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double begin = std::max(one.GetBound(2 * axis), other.GetBound(2 * axis));
    const double end = std::min(one.GetBound(2 * axis + 1), other.GetBound(2 * axis + 1));
    if (end - begin <= tolerance)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// Whether what two representations show, or one of them in two processes, has no order. In one
// process opaque surfaces are drawn before translucent ones.
bool AreUnorderedMembers(const vtkIsosurfaceRayTraceSharedPicture::Member& one,
  const vtkIsosurfaceRayTraceSharedPicture::Member& other, double tolerance)
{
  const bool isSame = &one == &other;
  const bool areTranslucent = !one.IsOpaque && !other.IsOpaque;
  for (std::size_t i = 0; i < one.Bounds.size(); ++i)
  {
    for (std::size_t k = 0; k < (isSame ? i : other.Bounds.size()); ++k)
    {
      if ((i != k || areTranslucent) && DoOverlap(one.Bounds[i], other.Bounds[k], tolerance))
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// Has the nearest of all processes win in this frame, and not the first in the order of processes.
void CompositeByDepth(vtkRenderer* renderer)
{
#if HAS_ICET
  auto* cameraPass = vtkCameraPass::SafeDownCast(renderer->GetPass());
  auto* pass =
    cameraPass ? vtkIceTCompositePass::SafeDownCast(cameraPass->GetDelegatePass()) : nullptr;
  if (pass)
  {
    pass->UseOrderedCompositingOff(); // vtkPVRenderView sets it for each frame that is no selection
  }
#else
  (void)renderer;
#endif
}

//------------------------------------------------------------------------------
int GetReductionFactor(vtkPVRenderView* view)
{
  // It sets a rate far below 1 for still pictures, on all processes.
  const bool isInteractive = view->GetRenderWindow()->GetDesiredUpdateRate() > 1.0;
  return isInteractive ? view->GetInteractiveRenderImageReductionFactor()
                       : view->GetStillRenderImageReductionFactor();
}

//------------------------------------------------------------------------------
int GetNumberOfRays(int pixels, double distance)
{
  return std::max(1, static_cast<int>(std::ceil(pixels / std::max(1.0, distance))));
}

//------------------------------------------------------------------------------
vtkOpenGLState* GetState(vtkViewport* viewport)
{
  return static_cast<vtkOpenGLRenderWindow*>(viewport->GetVTKWindow())->GetState();
}
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceSharedPicture);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSharedPicture::vtkIsosurfaceRayTraceSharedPicture()
{
  vtkMath::UninitializeBounds(this->Bounds);
  this->SetPicture(this->Image);
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSharedPicture::~vtkIsosurfaceRayTraceSharedPicture() = default;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkIsosurfaceRayTraceSharedPicture> vtkIsosurfaceRayTraceSharedPicture::Of(
  vtkPVRenderView* view)
{
  vtkRenderer* renderer = view->GetRenderer();
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator next;
  props->InitTraversal(next);
  while (vtkProp* prop = props->GetNextProp(next))
  {
    if (auto* found = vtkIsosurfaceRayTraceSharedPicture::SafeDownCast(prop))
    {
      return found;
    }
  }
  auto picture = vtkSmartPointer<vtkIsosurfaceRayTraceSharedPicture>::New();
  picture->View = view;
  picture->VisibilityOff();
  renderer->AddViewProp(picture);
  // All processes that render come there, and before them vtkSynchronizedRenderers, which gives the
  // server the camera of the client.
  picture->Observer = renderer->AddObserver(
    vtkCommand::StartEvent, picture.Get(), &vtkIsosurfaceRayTraceSharedPicture::Begin, -1.0F);
  return picture;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSharedPicture::Add(Member* member)
{
  this->Members.push_back(member);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSharedPicture::Remove(Member* member)
{
  this->Members.erase(
    std::remove(this->Members.begin(), this->Members.end(), member), this->Members.end());
  if (this->Members.empty() && this->View)
  {
    vtkRenderer* renderer = this->View->GetRenderer();
    renderer->RemoveObserver(this->Observer);
    renderer->RemoveViewProp(this);
  }
}

//------------------------------------------------------------------------------
std::vector<vtkIsosurfaceRayTraceSharedPicture::Member*>
vtkIsosurfaceRayTraceSharedPicture::FindVisibleMembers() const
{
  std::vector<Member*> visible;
  std::copy_if(this->Members.begin(), this->Members.end(), std::back_inserter(visible),
    [](const Member* member) { return member->Representation->GetVisibility(); });
  return visible;
}

//------------------------------------------------------------------------------
vtkBoundingBox vtkIsosurfaceRayTraceSharedPicture::FindBounds() const
{
  vtkBoundingBox bounds;
  for (const Member* member : this->FindVisibleMembers())
  {
    for (const vtkBoundingBox& piece : member->Bounds)
    {
      bounds.AddBox(piece);
    }
  }
  return bounds;
}

//------------------------------------------------------------------------------
double* vtkIsosurfaceRayTraceSharedPicture::GetBounds()
{
  vtkMath::UninitializeBounds(this->Bounds);
  const vtkBoundingBox bounds = this->FindBounds();
  if (bounds.IsValid())
  {
    bounds.GetBounds(this->Bounds);
  }
  return this->Bounds;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSharedPicture::AreUnordered() const
{
  const vtkBoundingBox bounds = this->FindBounds();
  if (!bounds.IsValid() || this->View->InTileDisplayMode() || this->View->InCaveDisplayMode())
  {
    return false;
  }
  // Boxes that touch may overlap by the rounding of their corners.
  const double tolerance = 1e-6 * bounds.GetDiagonalLength();
  const std::vector<Member*> members = this->FindVisibleMembers();
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    for (std::size_t k = 0; k <= i; ++k)
    {
      if (AreUnorderedMembers(*members[i], *members[k], tolerance))
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSharedPicture::TellBounds(vtkInformation* request)
{
  // With all bounds in process 0, which shows the picture, ParaView gives other geometry to that
  // process, too, if something is composited in order.
  const bool isShared = this->AreUnordered();
  const auto process = static_cast<std::size_t>(GetProcess());
  for (const Member* member : this->FindVisibleMembers())
  {
    vtkBoundingBox told;
    for (std::size_t i = 0; i < member->Bounds.size(); ++i)
    {
      if (isShared ? process == 0 : process == i)
      {
        told.AddBox(member->Bounds[i]);
      }
    }
    double bounds[6];
    vtkMath::UninitializeBounds(bounds);
    if (told.IsValid())
    {
      told.GetBounds(bounds);
    }
    vtkPVRenderView::SetGeometryBounds(request, member->Representation, bounds);
    vtkPVRenderView::SetOrderedCompositingConfiguration(
      request, member->Representation, vtkPVRenderView::USE_BOUNDS_FOR_REDISTRIBUTION, bounds);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSharedPicture::Begin()
{
  // Opaque surfaces alone are composited by depth, whatever the shape of the pieces.
  const bool isNeeded =
    (GetNumberOfProcesses() == 1 || this->View->GetUseOrderedCompositing()) && this->AreUnordered();
  // What is selected is found by the ids that the volumes of each process draw.
  const bool isSelection = this->View->GetRenderer()->GetSelector() != nullptr;
  this->IsInUse = isNeeded && !isSelection;
  this->SetVisibility(this->IsInUse && GetProcess() == 0);
  for (const Member* member : this->Members)
  {
    member->Volume->SetVisibility(
      member->HasData && member->Representation->GetVisibility() && !this->IsInUse);
  }
  if (isNeeded && isSelection)
  {
    CompositeByDepth(this->View->GetRenderer());
  }
  if (this->IsInUse)
  {
    this->Make();
  }
}

//------------------------------------------------------------------------------
// The picture for the camera that process 0 has now, before and behind the opaque geometry of all
// processes. It is smaller than the viewport by the factor of reduction, for which IceT uses the
// lower left part of the viewport.
void vtkIsosurfaceRayTraceSharedPicture::Make()
{
  vtkRenderer* renderer = this->View->GetRenderer();
  vtkCamera* camera = renderer->GetActiveCamera();
  this->Compositor->BroadcastCamera(camera);
  renderer->UpdateLightsGeometryToFollowCamera(); // which the renderer itself does later
  vtkNew<vtkVolumeCollection> volumes;
  double distance = std::numeric_limits<double>::max();
  for (const Member* member : this->FindVisibleMembers())
  {
    volumes->AddItem(member->Volume);
    auto* mapper = vtkIsosurfaceRayTraceMapper::SafeDownCast(member->Volume->GetMapper());
    distance = std::min(distance, static_cast<double>(mapper->GetImageSampleDistance()));
  }
  const int reduction = GetReductionFactor(this->View);
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&this->Size[0], &this->Size[1], &origin[0], &origin[1]);
  this->Size[0] /= reduction;
  this->Size[1] /= reduction;
  const int columns = GetNumberOfRays(this->Size[0], distance);
  const int rows = GetNumberOfRays(this->Size[1], distance);
  const vtkSmartPointer<vtkFloatArray> depths = this->Depths.Find(renderer, columns, rows);
  if (!this->Compositor->RenderToImage(
        volumes, camera, renderer->GetLights(), columns, rows, this->Image, depths))
  {
    this->Image->Initialize();
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceSharedPicture::RenderOpaqueGeometry(vtkViewport* viewport)
{
  vtkOpenGLState* state = GetState(viewport);
  const vtkOpenGLState::ScopedglViewport restoring(state);
  state->vtkglViewport(0, 0, this->Size[0], this->Size[1]);
  return this->Superclass::RenderOpaqueGeometry(viewport);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceSharedPicture::RenderVolumetricGeometry(vtkViewport* viewport)
{
  vtkOpenGLState* state = GetState(viewport);
  const vtkOpenGLState::ScopedglViewport restoring(state);
  state->vtkglViewport(0, 0, this->Size[0], this->Size[1]);
  return this->Superclass::RenderVolumetricGeometry(viewport);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSharedPicture::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Depths.ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

VTK_ABI_NAMESPACE_END
