// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ImageTracer_h
#define ImageTracer_h

#include "Field/Departure.h"
#include "Image/Tracers/ImageSelection.h"
#include "Kernels/Kernels.h"
#include "Rays/RayHits.h"
#include "Rays/TraceRequest.h"

#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Traces rays through an image: one class for the surfaces of each interpolant, and one for
/// projections. A new one is made when the selection changes; any number of threads use it at once.
class ImageTracer
{
public:
  /// The selection must outlive the tracer.
  explicit ImageTracer(const ImageSelection& selection)
    : Selection(selection)
  {
  }
  virtual ~ImageTracer() = default;

  /// Sets the spacing of the samples. Returns whether macrocells and cells are active by it, and it
  /// differs from the one before.
  virtual bool SetPlanes(const UnevenPlanes* /*planes*/) { return false; }

  /// Finds the macrocells that surfaces of the selected isovalues may pass. Masks of cells are made
  /// for these isovalues from then on.
  virtual ActiveMacrocells FindActive(int threads) = 0;

  /// Appends the hits of rays that are cut to what is visible.
  virtual void Trace(RayPacket& rays, RayHits& hits) = 0;

  /// Finds the rays that surfaces stop, which are all opaque and visible. There is a departure for
  /// each ray. Returns nothing if only hits can tell.
  virtual std::optional<StoppedRays> FindStopped(
    const RayPacket& /*rays*/, const Departure* /*departures*/)
  {
    return std::nullopt;
  }

  /// The gradient at a hit, of the field or of the half-space that a cap closes.
  Vector3 GetGradient(const Hit& hit, NormalMode mode) const
  {
    return hit.Plane != Hit::NoPlane
      ? this->Selection.Request.Visible.HalfSpaces[static_cast<std::size_t>(hit.Plane)].Normal
      : this->GetFieldGradient(hit, mode);
  }

  /// The gradients at up to as many hits as a packet has rays, whose cells are given too.
  virtual void GetGradients(const Hit* hits, const Index3* /*cells*/, int count, NormalMode mode,
    double (*gradients)[RayPacket::Capacity]) const
  {
    for (int i = 0; i < count; ++i)
    {
      this->StoreGradient(hits[i], mode, i, gradients);
    }
  }

protected:
  virtual Vector3 GetFieldGradient(const Hit& hit, NormalMode mode) const = 0;

  void StoreGradient(
    const Hit& hit, NormalMode mode, int i, double (*gradients)[RayPacket::Capacity]) const
  {
    const Vector3 gradient = this->GetGradient(hit, mode);
    gradients[0][i] = gradient[0];
    gradients[1][i] = gradient[1];
    gradients[2][i] = gradient[2];
  }

  /// The selected isovalues.
  std::vector<double> GetIsovalues() const
  {
    std::vector<double> isovalues;
    for (const Isosurface& surface : this->Selection.Request.Surfaces)
    {
      isovalues.push_back(surface.Isovalue);
    }
    return isovalues;
  }

  const ImageSelection& Selection;
};

}

#endif
