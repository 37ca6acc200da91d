// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A scene, all that it refers to, and its picture. Needs no window.

#ifndef vtkIsosurfaceRayTracePicture_h
#define vtkIsosurfaceRayTracePicture_h

#include "vtkIsosurfaceRayTraceClouds.h"      // for ivars
#include "vtkIsosurfaceRayTraceRequest.h"     // for arguments
#include "vtkIsosurfaceRayTraceValueColors.h" // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"    // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"                  // for ivars
#include "vtkVolumeProperty.h"                // for ivars

#include "Picture/MessageExchange.h"
#include "Picture/RenderTiles.h"

#include <cstddef>    // for std::size_t
#include <functional> // for std::function
#include <memory>     // for std::unique_ptr
#include <vector>     // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkRenderer;
struct vtkIsosurfaceRayTraceSettings;

class vtkIsosurfaceRayTracePicture
{
public:
  /// The view of the world. The size is in rays.
  struct View
  {
    vtkIsosurfaceRayTracing::Matrix4 ClipFromWorld;
    double Width;
    double Height;
  };

  /// Sets the scene, except for its lights. The input of the request must outlive the picture.
  void SetScene(const vtkIsosurfaceRayTraceSettings& settings,
    const vtkIsosurfaceRayTraceRequest& request, const View& view);

  /// Adds the lights of a renderer.
  void AddLights(vtkRenderer* renderer);

  /// Sets the depths of what is drawn already: a row of values for each row of the view, from the
  /// bottom. Rays end there. To be called again when the rectangle of the scene has changed.
  void SetDepths(const float* depths, int width);

  /// To be called by all processes that make one picture, which have as many fields: those without
  /// data of a connection draw what the others find of its cloud. Returns false if the clouds
  /// differ.
  bool AgreeOnClouds(vtkIsosurfaceRayTracing::MessageExchange& exchange);

  /// Renders the picture. Returns false if keepGoing, called with the fraction done, stopped it.
  bool Trace(const vtkIsosurfaceRayTracing::Execution& execution,
    const std::function<bool(double)>& keepGoing);

  /// The same for the mean of so many frames, in each of which the rays go through other points of
  /// the pixels. Depths and hits are those of the first.
  bool TraceMean(int frames, const vtkIsosurfaceRayTracing::Execution& execution,
    const std::function<bool(double)>& keepGoing);

  /// Whether the picture, which must have kept its hits, shows anything at a pixel. A value of a
  /// projection may have no opacity.
  bool IsVisible(std::size_t pixel) const;

  /// The depth of a hit of the picture, as in the depth buffer, but not clamped to [0, 1].
  float GetDepth(const vtkIsosurfaceRayTracing::Hit& hit) const;

  vtkIsosurfaceRayTracing::Scene Scene;
  vtkIsosurfaceRayTracing::Frame Frame;
  vtkIsosurfaceRayTracing::FrameTimes Times;

private:
  const vtkIsosurfaceRayTracing::SceneField& GetField(const vtkIsosurfaceRayTracing::Hit& hit) const
  {
    return this->Scene.Fields[static_cast<std::size_t>(hit.Field)];
  }

  struct ColorsOfField
  {
    std::unique_ptr<vtkIsosurfaceRayTracing::HitColors> OfHits;
    std::unique_ptr<vtkIsosurfaceRayTraceValueColors> OfValues;
    /// Made of the property when a cloud is drawn first; and what of.
    std::unique_ptr<vtkIsosurfaceRayTracing::CloudMedium> OfCloud;
    vtkIsosurfaceRayTraceClouds::Components Components;
    vtkSmartPointer<vtkVolumeProperty> Property;
  };

  static void SetColors(const vtkIsosurfaceRayTraceRequest::Volume& volume, ColorsOfField& colors,
    vtkIsosurfaceRayTracing::SceneField& shown);

  std::vector<ColorsOfField> Colors;
  /// Of the rectangle of the scene.
  std::vector<float> Depths;
};

VTK_ABI_NAMESPACE_END

#endif
