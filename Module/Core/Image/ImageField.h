// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ImageField_h
#define ImageField_h

#include "Image/ImageSettings.h"
#include "Image/Samples/VolumeView.h"
#include "Image/Tracers/ImageSelection.h"
#include "Kernels/Kernels.h"
#include "Rays/Hit.h"
#include "Rays/Ray.h"
#include "Rays/RayHits.h"
#include "Rays/TraceRequest.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

class ImageStructures;
class ImageTracer;

/// An image made ready for rays: macrocells at once, bricks as rays come. It depends on the samples
/// and the settings alone; the samples must outlive it and not change.
class ImageField
{
public:
  /// Builds the macrocells, with the given number of threads.
  static std::unique_ptr<ImageField> New(
    const VolumeView& view, const ImageSettings& settings, int threads);
  ~ImageField();

  /// Chooses what to trace from now on: finds the macrocells of the isovalues unless they are the
  /// same as before.
  void Select(const TraceRequest& request, int threads);

  /// Whether rays between lines that pass through one point, or are parallel, may hit a surface:
  /// those whose directions are means of the lines' own. The lines have an origin and a direction,
  /// and nothing else.
  bool MayHitBetween(RayPacket& lines) const;

  /// Finds the hits of rays with the surfaces, each ray up to the first opaque one or to where
  /// nothing of it is left to see. A ray that does not exist has no hits. Any number of threads may
  /// trace at once; what a ray hits does not depend on the others. Rays are cut to what is visible.
  void Trace(RayPacket& rays, RayHits& hits);
  /// The same for any number of rays.
  void Trace(const std::vector<std::optional<Ray>>& rays, RayHits& hits);

  /// The gradient of the samples at a hit, in the space that rays go through; in a flat cell, as
  /// long as it likes.
  Vector3 GetGradient(const Hit& hit, NormalMode mode) const;

  /// The same for up to as many hits as a packet has rays, with kernels.
  void GetGradients(const Hit* hits, int count, NormalMode mode, const Kernels& kernels,
    double (*gradients)[RayPacket::Capacity]) const;

  const Index3& GetDimensions() const { return this->Dimensions; }
  /// In bytes.
  std::size_t GetMacrocellMemory() const;
  std::size_t GetBrickMemory() const;
  std::size_t GetNumberOfBricks() const;
  std::size_t GetMaximumNumberOfBricks() const;
  /// The time spent making bricks so far, summed over the threads.
  std::int64_t GetBrickNanoseconds() const;

private:
  explicit ImageField(std::unique_ptr<ImageStructures> structures);

  std::unique_ptr<ImageStructures> Structures;
  ImageSelection Selection;
  Index3 Dimensions;
  std::unique_ptr<ImageTracer> Tracer;
};

}

#endif
