// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RenderTiles_h
#define RenderTiles_h

#include "Field/Execution.h"
#include "Picture/Compositor.h"
#include "Picture/Scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The picture of the pixels of a scene, in rows from the bottom.
struct Frame
{
  /// Red, green, blue and opacity, the colours multiplied by the opacity.
  std::vector<std::uint8_t> Colors;
  /// The depth of the nearest opaque surface, in [0, 1]; PixelWithoutDepth where there is none.
  std::vector<float> Depths;
  /// The nearest hit, if the scene keeps hits, whatever its opacity.
  std::vector<Hit> Hits;
  /// If the scene keeps fragments: those of a pixel that are composited follow each other front to
  /// back; pixels are in no order.
  std::vector<FragmentOfPixel> Fragments;
};

/// The wall-clock time of a frame, in seconds. All three are interleaved on all threads; the time
/// is divided in proportion to what the threads spent on each.
struct FrameTimes
{
  double Bricks = 0.0;
  double Trace = 0.0;
  double Shade = 0.0;
};

/// Traces and shades a scene, tile by tile, on all threads. The fields must be selected. Now and
/// then keepGoing is called with the fraction done, on the calling thread and while no other is at
/// work; if it returns false, the frame is abandoned. Returns whether the frame is complete.
bool RenderTiles(const Scene& scene, const Execution& execution, Frame& frame, FrameTimes& times,
  const std::function<bool(double)>& keepGoing);

}

#endif
