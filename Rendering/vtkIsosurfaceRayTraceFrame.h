// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The frames of a volume in render windows: from the scene of a renderer to the pixels.

#ifndef vtkIsosurfaceRayTraceFrame_h
#define vtkIsosurfaceRayTraceFrame_h

#include "vtkIsosurfaceRayTraceAccumulation.h" // for ivars
#include "vtkIsosurfaceRayTraceImageDisplay.h" // for ivars
#include "vtkIsosurfaceRayTraceLevel.h"        // for return values
#include "vtkIsosurfaceRayTracePicture.h"      // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"     // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkWeakPointer.h"                    // for ivars

#include "Picture/PixelSampling.h"

#include <functional> // for std::function
#include <string>     // for std::string
#include <vector>     // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkAbstractMapper;
class vtkHardwareSelector;
class vtkIsosurfaceRayTraceLayers;
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkSSAOPass;
class vtkVolume;
class vtkWindow;

class vtkIsosurfaceRayTraceFrame
{
public:
  /// What is drawn, and where to.
  struct Target
  {
    vtkRenderer* Renderer;
    vtkVolume* Volume;
    /// The settings are the same as long as it is not modified.
    vtkAbstractMapper* Mapper;
  };

  /// Why a renderer cannot draw a volume; empty if it can.
  static std::string FindProblem(vtkRenderer* renderer, vtkVolume* volume);

  /// How long a frame may read samples before it shows what is read of them, in seconds: without an
  /// end unless the window is for interaction. (A rendering that is at rest, or selects ids, is
  /// complete.)
  static double FindReadingTime(vtkRenderer* renderer, vtkVolume* volume);

  /// How much of the data to trace. With LevelOfDetail a coarse level stands in, in a window for
  /// interaction, unless all is read and the last exact frame took no more than the time allocated.
  vtkIsosurfaceRayTraceLevel ChooseLevel(
    const vtkIsosurfaceRayTraceSettings& settings, vtkRenderer* renderer, vtkVolume* volume) const;

  /// The number of ambient occlusion rays. With AutoAdjustSampleDistances, in a window for
  /// interaction, it is chosen by the time of the last frame like this one, so that the frame takes
  /// the time allocated to it if the distance between other rays is the smallest; but not fewer
  /// than four, if there are.
  int ChooseOcclusionRays(const vtkIsosurfaceRayTraceSettings& settings, bool isCoarse,
    vtkRenderer* renderer, vtkVolume* volume);

  /// The distance between rays, in pixels. With AutoAdjustSampleDistances it is chosen in the same
  /// way.
  float ChooseSampleDistance(const vtkIsosurfaceRayTraceSettings& settings, bool isCoarse,
    vtkRenderer* renderer, vtkVolume* volume) const;

  /// Draws a frame, or the ids of a hardware selection. Returns false if keepGoing, called with the
  /// fraction done, stopped it.
  bool Render(const vtkIsosurfaceRayTraceSettings& settings,
    const vtkIsosurfaceRayTraceRequest& request, const Target& target,
    const std::function<bool(double)>& keepGoing);

  /// Of the last frame. The display time is that of reading depths, uploading and drawing.
  const vtkIsosurfaceRayTracing::FrameTimes& GetTimes() const { return this->Picture.Times; }
  double GetDisplayTime() const { return this->DisplayTime; }
  int GetNumberOfAccumulatedFrames() const { return this->NumberOfAccumulatedFrames; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  /// What a frame would have taken with a ray for every pixel, in seconds.
  struct FrameCost
  {
    double Seconds = 0.0;
    /// The part that grows with the number of ambient occlusion rays, and that number.
    double Shading = 0.0;
    int OcclusionRays = 0;

    /// The same with another number of these rays.
    double Get(int rays) const
    {
      const double part =
        this->OcclusionRays > 0 ? static_cast<double>(rays) / this->OcclusionRays : 1.0;
      return this->Seconds + (part - 1.0) * this->Shading;
    }
  };

  /// How a frame is drawn.
  struct Drawing
  {
    Drawing(const vtkIsosurfaceRayTraceSettings& settings, const Target& target);

    /// Whether pixels show colours from between rays. (Ids and points have none between.)
    bool IsCoarse() const
    {
      return !this->Selector && !this->Occlusion && !this->Layers && this->Sampling.Pixels > 1;
    }

    vtkOpenGLRenderWindow* Window;
    /// In a render pass, of a framebuffer whose origin and size may differ from the window's.
    vtkIsosurfaceRayTracing::PixelRectangle Viewport;
    /// At most one of them.
    vtkHardwareSelector* Selector;
    vtkSSAOPass* Occlusion;
    vtkIsosurfaceRayTraceLayers* Layers;
    vtkIsosurfaceRayTracing::PixelSampling Sampling;
  };

  /// Of a renderer, whose windows and cameras differ from those of others, and of a volume that has
  /// the mapper.
  struct AccumulationOfEye
  {
    vtkWeakPointer<vtkRenderer> Renderer;
    vtkWeakPointer<vtkVolume> Volume;
    bool IsLeft;
    vtkIsosurfaceRayTraceAccumulation Accumulation;
  };

  void SetScene(const vtkIsosurfaceRayTraceSettings& settings,
    const vtkIsosurfaceRayTraceRequest& request, const Target& target, const Drawing& drawing);
  void ReadDepths(const Drawing& drawing);
  bool Accumulate(const vtkIsosurfaceRayTraceSettings& settings,
    const vtkIsosurfaceRayTraceRequest& request, const Target& target, const Drawing& drawing,
    const std::function<bool(double)>& keepGoing);
  vtkIsosurfaceRayTraceAccumulation& FindAccumulation(const Target& target);
  bool Trace(const vtkIsosurfaceRayTracing::Execution& execution, const Drawing& drawing,
    const std::function<bool(double)>& keepGoing);
  void Show(const vtkIsosurfaceRayTraceSettings& settings,
    const vtkIsosurfaceRayTraceRequest& request, const Target& target, const Drawing& drawing);
  void DisplayColors(const Drawing& drawing);
  void DisplayOpaque(const Drawing& drawing);
  void DisplayIds(const vtkIsosurfaceRayTraceRequest& request, const Drawing& drawing);
  void DisplayGeometry(const vtkIsosurfaceRayTraceSettings& settings,
    const vtkIsosurfaceRayTraceRequest& request, const Target& target, const Drawing& drawing);
  bool IsOpaque(const Drawing& drawing) const;
  void KeepCost(const vtkIsosurfaceRayTraceSettings& settings, bool isCoarse);
  const FrameCost& GetCost(bool isCoarse) const
  {
    return isCoarse ? this->CostOfCoarseLevel : this->Cost;
  }
  vtkIsosurfaceRayTraceImageDisplay::Image GetImage(const Drawing& drawing, bool isOpaque) const;

  vtkIsosurfaceRayTracePicture Picture;
  std::vector<float> SceneDepths;
  std::vector<AccumulationOfEye> Accumulations;
  int NumberOfAccumulatedFrames = 0;
  double DisplayTime = 0.0;
  /// Of the last frame, and of the last one of a coarse level.
  FrameCost Cost;
  FrameCost CostOfCoarseLevel;
  /// Those that were chosen last.
  int OcclusionRays = 0;
  vtkIsosurfaceRayTraceImageDisplay Display;
};

VTK_ABI_NAMESPACE_END

#endif
