// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef OneFieldScene_h
#define OneFieldScene_h

#include "Picture/Scene.h"
#include "TestRequest.h"

namespace vtkIsosurfaceRayTracing
{

/// A scene that shows one image, and what is selected of it.
struct OneFieldScene : Scene
{
  TestRequest Request;
  SceneField Shown;
  int Threads = 1;

  Execution GetExecution() const { return { this->Threads, this->Request.PacketKernels }; }

  /// Selects what is requested of an image, and shows it.
  const Scene& Show(ImageField& image)
  {
    Select(image, this->Request, this->Threads);
    this->Shown.Field = &image;
    this->Fields = { this->Shown };
    return *this;
  }
};

}

#endif
