// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Refinement_h
#define Refinement_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <chrono>

VTK_ABI_NAMESPACE_BEGIN
class vtkIsosurfaceRayTraceMapper;
class vtkRenderWindowInteractor;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

/// Draws again while that makes the picture better: as soon as the mouse rests, also with a button
/// held.
class Refinement
{
public:
  Refinement(vtkRenderWindowInteractor* interactor, vtkIsosurfaceRayTraceMapper* mapper);
  Refinement(const Refinement&) = delete;
  Refinement& operator=(const Refinement&) = delete;

  /// After the interactor is initialized.
  void Start();

  /// Whether more frames would make the picture better.
  bool IsFinished() const;

private:
  /// Whether frames are drawn in haste.
  bool IsMoving() const;
  void OnMotion();
  void OnFrame();
  void OnRelease();
  void OnTimer();

  vtkRenderWindowInteractor* Interactor;
  vtkIsosurfaceRayTraceMapper* Mapper;
  std::chrono::steady_clock::time_point LastMotion;
  /// Whether a button is held on, while the picture is that of rest.
  bool IsPaused = false;
};

}

#endif
