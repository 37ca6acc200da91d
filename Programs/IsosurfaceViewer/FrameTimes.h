// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FrameTimes_h
#define FrameTimes_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <chrono>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkIsosurfaceRayTraceMapper;
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

/// The times of the frames of a window, by the clock, from the call of Render to the end of it:
/// those while something moves, and those at rest.
class FrameTimes
{
public:
  FrameTimes(vtkRenderWindow* window, vtkIsosurfaceRayTraceMapper* mapper);
  FrameTimes(const FrameTimes&) = delete;
  FrameTimes& operator=(const FrameTimes&) = delete;

  /// The last frames of both kinds.
  std::string Describe() const;

  /// All frames while something moved; empty if there were none.
  std::string Summarize() const;

private:
  struct Frame
  {
    double Milliseconds;
    /// Between rays, in pixels.
    double Distance;
  };

  void Start();
  void End();

  vtkRenderWindow* Window;
  vtkIsosurfaceRayTraceMapper* Mapper;
  std::chrono::steady_clock::time_point Begin;
  std::vector<Frame> Moving;
  double MillisecondsAtRest = 0.0;
};

}

#endif
