// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef DepthPicture_h
#define DepthPicture_h

#include "AnalyticFields.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <vector>

namespace MapperTesting
{

/// The points in the world of the depth buffer of a window.
class DepthPicture
{
public:
  DepthPicture(vtkRenderWindow* window, vtkRenderer* renderer)
  {
    const int* size = renderer->GetSize();
    const int* origin = renderer->GetOrigin();
    this->Width = size[0];
    this->Height = size[1];
    this->Depths.resize(static_cast<std::size_t>(this->Width * this->Height));
    window->GetZbufferData(origin[0], origin[1], origin[0] + this->Width - 1,
      origin[1] + this->Height - 1, this->Depths.data());
    this->WorldFromClip->DeepCopy(
      renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
        renderer->GetTiledAspectRatio(), -1.0, 1.0));
    this->WorldFromClip->Invert();
  }

  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }

  double GetDepth(int x, int y) const
  {
    return static_cast<double>(this->Depths[static_cast<std::size_t>(x + y * this->Width)]);
  }

  bool IsEmpty(int x, int y) const { return this->GetDepth(x, y) >= 1.0; }

  /// The point at a depth behind the centre of a pixel.
  AnalyticFields::Point GetPoint(int x, int y, double depth) const
  {
    const double clip[4] = { 2.0 * (x + 0.5) / this->Width - 1.0,
      2.0 * (y + 0.5) / this->Height - 1.0, 2.0 * depth - 1.0, 1.0 };
    double world[4];
    this->WorldFromClip->MultiplyPoint(clip, world);
    return { world[0] / world[3], world[1] / world[3], world[2] / world[3] };
  }

  AnalyticFields::Point GetPoint(int x, int y) const
  {
    return this->GetPoint(x, y, this->GetDepth(x, y));
  }

private:
  int Width;
  int Height;
  std::vector<float> Depths;
  vtkNew<vtkMatrix4x4> WorldFromClip;
};

}

#endif
