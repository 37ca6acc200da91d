// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Views_h
#define Views_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <array>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

using Triple = std::array<double, 3>;
/// As vtkDataSet::GetBounds.
using Bounds = std::array<double, 6>;

/// Where a square picture is taken from.
struct View
{
  std::string Name;
  Triple Eye;
  Triple Focus;
  Triple Up;
  /// In degrees.
  double Angle;

  void Apply(vtkCamera* camera) const;
};

/// Viewpoints around the volume, a little above it: view k of n is from the angle 2 pi k / n, at
/// (sin, -cos, 0.3); the volume fills the picture.
std::vector<View> MakeOrbit(const Bounds& bounds, int views);

/// Like those of Parker et al. 1998: from the front, close by, from above, and along the long axis
/// from the feet.
std::vector<View> MakePaperViews(const Bounds& bounds);

struct PixelRectangle
{
  int X;
  int Y;
  int Width;
  int Height;
};

/// The rays through the middles of the pixels of a picture of size x size pixels, counted from the
/// lower left.
class PictureRays
{
public:
  PictureRays(const View& view, int size);

  const Triple& GetOrigin() const { return this->Origin; }
  /// The direction of the view, of length one. That of a ray has the length one along it.
  const Triple& GetForward() const { return this->Forward; }
  Triple GetDirection(int x, int y) const;
  /// The difference of the directions of neighbours.
  const Triple& GetStepX() const { return this->StepX; }
  const Triple& GetStepY() const { return this->StepY; }
  /// The pixels that a box covers: no other ray can hit what is in it.
  PixelRectangle GetPixels(const Bounds& box) const;

private:
  int Size;
  Triple Origin;
  Triple Forward;
  /// From pixel to pixel, at a distance of one.
  Triple StepX;
  Triple StepY;
};

}

#endif
