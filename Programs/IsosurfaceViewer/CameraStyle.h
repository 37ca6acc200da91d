// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CameraStyle_h
#define CameraStyle_h

#include <vtkInteractorStyleTrackballCamera.h>

namespace Viewer
{

/// The mouse moves the camera, and nothing else does: keys belong to the window, and a timer does
/// not go on with what the mouse has begun.
class CameraStyle : public vtkInteractorStyleTrackballCamera
{
public:
  static CameraStyle* New();
  vtkTypeMacro(CameraStyle, vtkInteractorStyleTrackballCamera);
  CameraStyle(const CameraStyle&) = delete;
  void operator=(const CameraStyle&) = delete;

  void OnChar() override {}
  void OnTimer() override {}

protected:
  CameraStyle() = default;
  ~CameraStyle() override = default;
};

}

#endif
