// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SurfaceTracer_h
#define SurfaceTracer_h

#include "Image/Tracers/ImageTracer.h"
#include "Image/Traversal/Caps.h"

#include <optional>

namespace vtkIsosurfaceRayTracing
{

/// Traces surfaces, and the caps that close their insides where half-spaces cut them open.
class SurfaceTracer : public ImageTracer
{
public:
  using ImageTracer::ImageTracer;

  void Trace(RayPacket& rays, RayHits& hits) final;

protected:
  /// Appends the hits with the surfaces alone.
  virtual void TraceSurfaces(RayPacket& rays, RayHits& hits) = 0;

  /// Whether samples are boxes, whose faces coincide with planes as those of cells do.
  virtual bool HasBoxes() const { return false; }

  /// Sets the value of a cap at the end of a ray, and its surface: the innermost whose inside it
  /// shows, or Hit::NoSurface.
  virtual void EvaluateCap(const Ray& ray, const EndCell& end, Hit& cap) const = 0;

  /// The surface of the largest isovalue whose inside a point is in, or Hit::NoSurface:
  /// getDifference(isovalue) gives the value there, less the isovalue.
  template <typename GetDifference>
  int FindInnermost(const GetDifference& getDifference) const
  {
    static_assert(Hit::NoSurface == -1);
    const std::vector<ScaledIsovalue>& isovalues = this->Selection.Isovalues;
    auto surface = static_cast<int>(isovalues.size()) - 1;
    while (surface >= 0 && !IsInside(getDifference(isovalues[static_cast<std::size_t>(surface)])))
    {
      --surface;
    }
    return surface;
  }

private:
  /// The caps at the two ends of a ray.
  struct RayCaps
  {
    std::optional<Hit> First;
    std::optional<Hit> Last;
  };

  RayCaps CutToCaps(RayPacket& rays, int i) const;
  int GoToPlane(Ray& ray, RayEnd end) const;
  std::optional<Hit> FindCap(const Ray& ray, RayEnd end, int plane) const;
  void TraceBetweenCaps(const RayPacket& rays, RayHits& hits);
};

}

#endif
