// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceFrame.h"

#include "vtkIsosurfaceRayTraceHits.h"
#include "vtkIsosurfaceRayTraceInputs.h"
#include "vtkIsosurfaceRayTraceLayers.h"
#include "vtkIsosurfaceRayTracePasses.h"
#include "vtkIsosurfaceRayTraceProblems.h"
#include "vtkIsosurfaceRayTraceRequest.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSelection.h"
#include "vtkIsosurfaceRayTraceSettings.h"
#include "vtkIsosurfaceVolume.h"

#include "vtkAbstractMapper.h"
#include "vtkCamera.h"
#include "vtkCollection.h"
#include "vtkDataObject.h"
#include "vtkDualDepthPeelingPass.h"
#include "vtkHardwareSelector.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSSAOPass.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include "Field/Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// The render pass of a kind that draws a volume now, if there is one.
template <typename Pass>
Pass* FindPass(vtkVolume* volume)
{
  const std::vector<Pass*> passes = vtkIsosurfaceRayTracePasses::Find<Pass>(volume);
  return passes.empty() ? nullptr : passes.front();
}

/// Whether a frame in stereo has drawn another eye already.
bool IsSecondEye(vtkRenderer* renderer)
{
  vtkRenderWindow* window = renderer->GetRenderWindow();
  return window->GetStereoRender() != 0 && window->GetStereoType() != VTK_STEREO_RIGHT &&
    renderer->GetActiveCamera()->GetLeftEye() == 0;
}

/// Whether a frame is to be drawn in the time allocated to it, and not to be complete.
bool IsInteractive(vtkRenderer* renderer, vtkVolume* volume)
{
  // Windows at rest have rates of a frame in minutes or hours.
  constexpr double leastRate = 1.0;
  return renderer->GetRenderWindow()->GetDesiredUpdateRate() >= leastRate &&
    !renderer->GetSelector() && volume->GetAllocatedRenderTime() > 0.0;
}

/// While interacting: with fewer rays the light of neighbouring pixels has little in common.
int GetFewestOcclusionRays(const vtkIsosurfaceRayTraceSettings& settings)
{
  return std::min(settings.NumberOfAmbientOcclusionRays, 4);
}

/// What is the matter with a window that is not drawn with OpenGL, and the remedy.
std::string WhyNotOpenGL(vtkRenderWindow* window)
{
  if (!window)
  {
    return "The renderer is not in a render window. Add it to a vtkRenderWindow.";
  }
  const std::string name = window->GetClassName();
  if (name == "vtkRenderWindow") // nothing overrides it
  {
    return "The render window draws nothing. Initialize the module vtkRenderingOpenGL2 "
           "(VTK_MODULE_INIT, vtk_module_autoinit, or import vtkmodules.vtkRenderingOpenGL2) "
           "before it is made.";
  }
  return "Isosurfaces are drawn with OpenGL, and the render window is a " + name +
    ". Add the renderer to a window of OpenGL (VTK 9.7 and newer: set the environment variable "
    "VTK_FACTORY_PREFER=RenderingBackend=OpenGL), or call RenderToImage, which needs no window.";
}

vtkirt::PixelRectangle GetViewport(vtkOpenGLRenderWindow* window)
{
  const std::array<int, 4> viewport = vtkIsosurfaceRayTraceImageDisplay::GetViewport(window);
  return { viewport[0], viewport[1], viewport[2], viewport[3] };
}

/// Whether a renderer has anything else that is visible.
bool HasOthers(vtkRenderer* renderer, vtkVolume* volume)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator next;
  props->InitTraversal(next);
  vtkProp* prop = props->GetNextProp(next);
  while (prop && (prop == volume || !prop->GetVisibility()))
  {
    prop = props->GetNextProp(next);
  }
  return prop != nullptr;
}

/// Whether the window may already have something that hides surfaces. The number of props that are
/// rendered is not told by render passes and selectors, nor before all opaque geometry is drawn.
bool MayShowOthers(vtkRenderer* renderer, vtkVolume* volume)
{
  const bool isErased = renderer->GetErase() && renderer->GetRenderWindow()->GetErase() &&
    !renderer->GetPreserveDepthBuffer();
  return !isErased || renderer->GetNumberOfPropsRendered() > 0 || renderer->GetPass() ||
    renderer->GetSelector() ||
    (vtkIsosurfaceVolume::SafeDownCast(volume) && HasOthers(renderer, volume));
}

}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceFrame::FindProblem(vtkRenderer* renderer, vtkVolume* volume)
{
  vtkRenderWindow* window = renderer->GetRenderWindow();
  if (!vtkOpenGLRenderWindow::SafeDownCast(window))
  {
    return WhyNotOpenGL(window);
  }
  if (FindPass<vtkDualDepthPeelingPass>(volume))
  {
    return "The renderer peels volumes, which isosurfaces do not support. Call "
           "UseDepthPeelingForVolumesOff() of the renderer, or put the mapper in a "
           "vtkIsosurfaceVolume, which peels isosurfaces, but not clouds and projections.";
  }
  return vtkIsosurfaceRayTraceProblems::FindInView(
    vtkIsosurfaceRayTraceScene::GetClipFromWorldOfEye(
      renderer->GetActiveCamera(), renderer->GetTiledAspectRatio()),
    renderer->GetLights());
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceFrame::FindReadingTime(vtkRenderer* renderer, vtkVolume* volume)
{
  if (!IsInteractive(renderer, volume))
  {
    return std::numeric_limits<double>::infinity();
  }
  return IsSecondEye(renderer) ? 0.0 : volume->GetAllocatedRenderTime(); // Both eyes see the same.
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceLevel vtkIsosurfaceRayTraceFrame::ChooseLevel(
  const vtkIsosurfaceRayTraceSettings& settings, vtkRenderer* renderer, vtkVolume* volume) const
{
  using Level = vtkIsosurfaceRayTraceLevel;
  if (!settings.LevelOfDetail || !IsInteractive(renderer, volume))
  {
    return Level::Exact;
  }
  if (IsSecondEye(renderer))
  {
    return Level::AsBefore;
  }
  const auto distance = static_cast<double>(settings.AutoAdjustSampleDistances
      ? std::max(settings.MaximumImageSampleDistance, settings.MinimumImageSampleDistance)
      : settings.ImageSampleDistance);
  // Where samples are in a file, nothing else tells how long an exact frame will take.
  const double seconds = this->Cost.Get(GetFewestOcclusionRays(settings)) / (distance * distance);
  const bool isInTime = seconds > 0.0 && seconds <= volume->GetAllocatedRenderTime();
  return isInTime ? Level::CoarseUntilRead : Level::Coarse;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceFrame::ChooseOcclusionRays(const vtkIsosurfaceRayTraceSettings& settings,
  bool isCoarse, vtkRenderer* renderer, vtkVolume* volume)
{
  const int most = settings.NumberOfAmbientOcclusionRays;
  const int fewest = GetFewestOcclusionRays(settings);
  if (!settings.AutoAdjustSampleDistances || !IsInteractive(renderer, volume))
  {
    this->OcclusionRays = most;
  }
  else if (IsSecondEye(renderer))
  {
    this->OcclusionRays = std::clamp(this->OcclusionRays, fewest, most);
  }
  else
  {
    const auto smallest = static_cast<double>(settings.MinimumImageSampleDistance);
    const double allocated = volume->GetAllocatedRenderTime() * smallest * smallest;
    const FrameCost& cost = this->GetCost(isCoarse);
    const double ofRay = cost.Get(1) - cost.Get(0);
    const double enough = ofRay > 0.0 ? (allocated - cost.Get(0)) / ofRay : most;
    this->OcclusionRays = static_cast<int>(
      std::clamp(std::floor(enough), static_cast<double>(fewest), static_cast<double>(most)));
  }
  return this->OcclusionRays;
}

//------------------------------------------------------------------------------
float vtkIsosurfaceRayTraceFrame::ChooseSampleDistance(
  const vtkIsosurfaceRayTraceSettings& settings, bool isCoarse, vtkRenderer* renderer,
  vtkVolume* volume) const
{
  const double allocated = volume->GetAllocatedRenderTime();
  // In stereo both eyes have the distance of the first.
  if (!settings.AutoAdjustSampleDistances || renderer->GetSelector() || !(allocated > 0.0) ||
    IsSecondEye(renderer))
  {
    return settings.ImageSampleDistance;
  }
  // The number of rays falls with the square of their distance.
  const FrameCost& cost = this->GetCost(isCoarse);
  const double enough = std::sqrt(cost.Get(settings.NumberOfAmbientOcclusionRays) / allocated);
  const double distance = enough > 1.0 ? std::ceil(enough) : 1.0 / std::floor(1.0 / enough);
  return std::clamp(static_cast<float>(distance), settings.MinimumImageSampleDistance,
    std::max(settings.MinimumImageSampleDistance, settings.MaximumImageSampleDistance));
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceFrame::Drawing::Drawing(
  const vtkIsosurfaceRayTraceSettings& settings, const Target& target)
  : Window(vtkOpenGLRenderWindow::SafeDownCast(target.Renderer->GetRenderWindow()))
  , Viewport(::GetViewport(this->Window))
  , Selector(target.Renderer->GetSelector())
  , Occlusion(this->Selector ? nullptr : FindPass<vtkSSAOPass>(target.Volume))
  , Layers(vtkIsosurfaceVolume::FindLayers(target.Volume, target.Renderer))
{
  // A selection of points begins with a usual frame, and shows ids where they have its depth.
  // Others select every pixel.
  if (!this->Selector ||
    this->Selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    this->Sampling =
      vtkirt::PixelSampling::FromDistance(static_cast<double>(settings.ImageSampleDistance));
  }
  if (this->Occlusion || this->Layers)
  {
    this->Sampling.Rays = 1; // A pixel has one point, or one list of fragments.
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceFrame::Render(const vtkIsosurfaceRayTraceSettings& settings,
  const vtkIsosurfaceRayTraceRequest& request, const Target& target,
  const std::function<bool(double)>& keepGoing)
{
  this->Picture.Times = {};
  this->DisplayTime = 0.0;
  this->NumberOfAccumulatedFrames = 0;
  if (!settings.ProgressiveAccumulation)
  {
    this->Accumulations.clear(); // and their memory
  }

  const Drawing drawing(settings, target);
  this->SetScene(settings, request, target, drawing);
  const vtkirt::Scene& scene = this->Picture.Scene;
  if (request.IsNothing() || scene.Pixels.Width == 0 || scene.Pixels.Height == 0)
  {
    return true;
  }

  const vtkirt::Stopwatch ofDepths;
  // For a selection of points the depth is also that of our own surfaces, rounded; there, the depth
  // test decides. It does in coarse pictures, too: each pixel has a depth, and not each a ray.
  const bool isTested =
    drawing.Selector ? !request.IsProjection() : drawing.IsCoarse() && this->IsOpaque(drawing);
  if (MayShowOthers(target.Renderer, target.Volume) && !isTested)
  {
    this->ReadDepths(drawing);
  }
  this->DisplayTime = ofDepths.GetSeconds();

  if (!this->Accumulate(settings, request, target, drawing, keepGoing))
  {
    return false;
  }

  const vtkirt::Stopwatch ofDisplay;
  this->Show(settings, request, target, drawing);
  this->DisplayTime += ofDisplay.GetSeconds();
  if (!drawing.Selector && this->Picture.Times.Trace > 0.0)
  {
    this->KeepCost(settings, request.Inputs.IsCoarse());
  }
  return true;
}

//------------------------------------------------------------------------------
/// Draws what was traced into the window.
void vtkIsosurfaceRayTraceFrame::Show(const vtkIsosurfaceRayTraceSettings& settings,
  const vtkIsosurfaceRayTraceRequest& request, const Target& target, const Drawing& drawing)
{
  if (drawing.Selector)
  {
    this->DisplayIds(request, drawing);
  }
  else if (drawing.Occlusion)
  {
    this->DisplayGeometry(settings, request, target, drawing);
  }
  else if (drawing.Layers)
  {
    this->DisplayOpaque(drawing);
  }
  else
  {
    this->DisplayColors(drawing);
  }
}

//------------------------------------------------------------------------------
/// Macrocells and bricks are built; the remaining time grows with the number of rays.
void vtkIsosurfaceRayTraceFrame::KeepCost(
  const vtkIsosurfaceRayTraceSettings& settings, bool isCoarse)
{
  const vtkirt::FrameTimes& times = this->Picture.Times;
  const auto distance = static_cast<double>(settings.ImageSampleDistance);
  FrameCost& cost = isCoarse ? this->CostOfCoarseLevel : this->Cost;
  cost = { (times.Trace + times.Shade) * distance * distance + this->DisplayTime,
    times.Shade * distance * distance, settings.NumberOfAmbientOcclusionRays };
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceFrame::SetScene(const vtkIsosurfaceRayTraceSettings& settings,
  const vtkIsosurfaceRayTraceRequest& request, const Target& target, const Drawing& drawing)
{
  vtkRenderer* renderer = target.Renderer;
  this->Picture.SetScene(settings, request,
    { vtkIsosurfaceRayTraceScene::GetClipFromWorldOfEye(
        renderer->GetActiveCamera(), renderer->GetTiledAspectRatio()),
      drawing.Sampling.ToRays(drawing.Viewport.Width),
      drawing.Sampling.ToRays(drawing.Viewport.Height) });
  this->Picture.AddLights(renderer);
  vtkirt::Scene& scene = this->Picture.Scene;
  scene.Pixels = drawing.Sampling.Align(scene.Pixels);
  scene.KeepHits = drawing.Selector || drawing.Occlusion;
  scene.KeepFragments = drawing.Layers != nullptr;
}

//------------------------------------------------------------------------------
/// Sets the depth of what is drawn already, for every ray of the scene.
void vtkIsosurfaceRayTraceFrame::ReadDepths(const Drawing& drawing)
{
  vtkirt::Scene& scene = this->Picture.Scene;
  const vtkirt::PixelRectangle& viewport = drawing.Viewport;
  vtkirt::PixelRectangle pixels = drawing.Sampling.ToPixels(scene.Pixels);
  pixels.Width = std::min(pixels.Width, viewport.Width - pixels.X);
  pixels.Height = std::min(pixels.Height, viewport.Height - pixels.Y);
  this->SceneDepths.resize(vtkirt::Count({ pixels.Width, pixels.Height, 1 }));
  vtkIsosurfaceRayTraceImageDisplay::ReadDepths(drawing.Window, viewport.X + pixels.X,
    viewport.Y + pixels.Y, pixels.Width, pixels.Height, this->SceneDepths.data());
  if (drawing.Sampling.Pixels != 1 || drawing.Sampling.Rays != 1)
  {
    this->SceneDepths =
      vtkirt::TakeAtRays(drawing.Sampling, scene.Pixels, this->SceneDepths, pixels);
  }
  scene.Depth = this->SceneDepths.data();
}

//------------------------------------------------------------------------------
/// Traces the frame. With ProgressiveAccumulation, traces one more frame of the same scene, or none
/// if there are enough, and makes the picture their mean.
bool vtkIsosurfaceRayTraceFrame::Accumulate(const vtkIsosurfaceRayTraceSettings& settings,
  const vtkIsosurfaceRayTraceRequest& request, const Target& target, const Drawing& drawing,
  const std::function<bool(double)>& keepGoing)
{
  vtkirt::Scene& scene = this->Picture.Scene;
  // Ids, points and fragments cannot be averaged, and a coarse picture is soon replaced.
  if (!settings.ProgressiveAccumulation || scene.KeepHits || scene.KeepFragments ||
    drawing.Sampling.Pixels != 1)
  {
    return this->Trace(request.Execution, drawing, keepGoing);
  }
  std::vector<vtkObject*> objects = { target.Mapper };
  for (const auto& ofConnection : request.Objects)
  {
    objects.insert(objects.end(), ofConnection->begin(), ofConnection->end());
  }
  for (const vtkIsosurfaceRayTraceRequest::Volume& volume : request.Volumes)
  {
    objects.push_back(volume.Property);
  }
  const vtkIsosurfaceRayTraceAccumulation::Key key = { objects,
    static_cast<double>(settings.ImageSampleDistance), scene };
  vtkIsosurfaceRayTraceAccumulation& accumulation = this->FindAccumulation(target);
  this->NumberOfAccumulatedFrames = accumulation.GetNumberOfFrames(key);
  if (this->NumberOfAccumulatedFrames < settings.MaximumNumberOfAccumulatedFrames)
  {
    vtkIsosurfaceRayTraceAccumulation::SetFrame(this->NumberOfAccumulatedFrames, scene);
    if (!this->Trace(request.Execution, drawing, keepGoing))
    {
      return false;
    }
    accumulation.Add(key, this->Picture.Frame);
    ++this->NumberOfAccumulatedFrames;
  }
  accumulation.GetMean(this->Picture.Frame);
  return true;
}

//------------------------------------------------------------------------------
/// That of the eye for which a renderer draws a volume. Those of renderers and volumes that are
/// gone are forgotten.
vtkIsosurfaceRayTraceAccumulation& vtkIsosurfaceRayTraceFrame::FindAccumulation(
  const Target& target)
{
  std::vector<AccumulationOfEye>& all = this->Accumulations;
  all.erase(std::remove_if(all.begin(), all.end(),
              [](const AccumulationOfEye& each)
              { return each.Renderer == nullptr || each.Volume == nullptr; }),
    all.end());
  const bool isLeft = target.Renderer->GetActiveCamera()->GetLeftEye() != 0;
  const auto found = std::find_if(all.begin(), all.end(),
    [&target, isLeft](const AccumulationOfEye& each)
    {
      return each.Renderer == target.Renderer && each.Volume == target.Volume &&
        each.IsLeft == isLeft;
    });
  if (found != all.end())
  {
    return found->Accumulation;
  }
  all.push_back({ target.Renderer, target.Volume, isLeft, {} });
  return all.back().Accumulation;
}

//------------------------------------------------------------------------------
/// Renders the picture. If hits are kept, it has a pixel for every ray.
bool vtkIsosurfaceRayTraceFrame::Trace(const vtkirt::Execution& execution, const Drawing& drawing,
  const std::function<bool(double)>& keepGoing)
{
  if (!this->Picture.Trace(execution, keepGoing))
  {
    return false;
  }
  const vtkirt::Scene& scene = this->Picture.Scene;
  if (drawing.Sampling.Rays > 1 && !scene.KeepHits)
  {
    vtkirt::AverageRays(drawing.Sampling.Rays, scene.Pixels.Width, this->Picture.Frame);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceFrame::IsOpaque(const Drawing& drawing) const
{
  // A mean is not opaque at the edge of a surface.
  const std::vector<vtkirt::SceneField>& fields = this->Picture.Scene.Fields;
  return drawing.Sampling.Rays == 1 && this->NumberOfAccumulatedFrames <= 1 &&
    std::all_of(fields.begin(), fields.end(),
      [](const vtkirt::SceneField& field)
      {
        const vtkirt::TraceRequest& request = field.Field->GetRequest();
        return !request.HasCloud && request.HasOnlyOpaqueSurfaces();
      });
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceImageDisplay::Image vtkIsosurfaceRayTraceFrame::GetImage(
  const Drawing& drawing, bool isOpaque) const
{
  const vtkirt::PixelRectangle& rays = this->Picture.Scene.Pixels;
  const vtkirt::PixelSampling& sampling = drawing.Sampling;
  const vtkirt::PixelRectangle pixels = sampling.ToPixels(rays);
  return { drawing.Viewport.X + pixels.X, drawing.Viewport.Y + pixels.Y, pixels.Width,
    pixels.Height, rays.Width / sampling.Rays, rays.Height / sampling.Rays,
    this->Picture.Frame.Colors.data(), this->Picture.Frame.Depths.data(), isOpaque,
    drawing.IsCoarse() };
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceFrame::DisplayColors(const Drawing& drawing)
{
  this->Display.Display(drawing.Window, this->GetImage(drawing, this->IsOpaque(drawing)), nullptr);
}

//------------------------------------------------------------------------------
/// Draws the fragments that are opaque, and makes layers of the others.
void vtkIsosurfaceRayTraceFrame::DisplayOpaque(const Drawing& drawing)
{
  vtkirt::Frame& frame = this->Picture.Frame;
  std::fill(frame.Colors.begin(), frame.Colors.end(), std::uint8_t{ 0 });
  for (const vtkirt::FragmentOfPixel& fragment : frame.Fragments)
  {
    if (fragment.Own.Opacity >= 1.0)
    {
      std::copy_n(vtkirt::ToPixel(fragment.Own).Rgba, 4, &frame.Colors[4 * fragment.Pixel]);
    }
  }
  this->Display.Display(drawing.Window, this->GetImage(drawing, true), nullptr);
  const vtkirt::PixelRectangle pixels = drawing.Sampling.ToPixels(this->Picture.Scene.Pixels);
  drawing.Layers->Set(drawing.Window, frame.Fragments,
    { pixels.X, pixels.Y, this->Picture.Scene.Pixels.Width, drawing.Sampling.Pixels });
  frame.Fragments = {}; // They are many.
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceFrame::DisplayIds(
  const vtkIsosurfaceRayTraceRequest& request, const Drawing& drawing)
{
  const vtkIsosurfaceRayTraceSelection selection(drawing.Selector, request.Inputs);
  selection.WriteIds(this->Picture);
  if (drawing.Sampling.Rays > 1)
  {
    vtkirt::TakeNearestRays(
      drawing.Sampling.Rays, this->Picture.Scene.Pixels.Width, this->Picture.Frame);
  }
  const bool isOpaque = !request.IsProjection();
  this->Display.Display(drawing.Window, this->GetImage(drawing, isOpaque), nullptr);
}

//------------------------------------------------------------------------------
/// Also passes points and normals to the render pass, if surfaces have depth.
void vtkIsosurfaceRayTraceFrame::DisplayGeometry(const vtkIsosurfaceRayTraceSettings& settings,
  const vtkIsosurfaceRayTraceRequest& request, const Target& target, const Drawing& drawing)
{
  if (!this->IsOpaque(drawing))
  {
    drawing.Occlusion->SetShaderParameters(nullptr, target.Mapper, target.Volume);
    this->DisplayColors(drawing);
    return;
  }
  std::vector<float> positions;
  std::vector<float> normals;
  vtkIsosurfaceRayTraceHits(request).GetGeometry(this->Picture.Frame.Hits,
    target.Renderer->GetActiveCamera(), settings.NumberOfThreads, positions, normals);
  const vtkIsosurfaceRayTraceImageDisplay::Geometry geometry = { drawing.Occlusion, target.Volume,
    positions.data(), normals.data() };
  this->Display.Display(drawing.Window, this->GetImage(drawing, true), &geometry);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceFrame::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Display.ReleaseGraphicsResources(window);
}

VTK_ABI_NAMESPACE_END
