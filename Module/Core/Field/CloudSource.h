// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CloudSource_h
#define CloudSource_h

#include "Kernels/CloudTile.h"
#include "Rays/Camera.h"
#include "Rays/PixelRectangle.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Values from Low to High.
struct ValueInterval
{
  double Low;
  double High;
};

/// In order.
using ValueIntervals = std::vector<ValueInterval>;

/// Finds the segments of rays in the cells of a field, tile by tile, for one thread: front to back,
/// but for what cells that are near to each other overlap in depth.
class CloudSource
{
public:
  virtual ~CloudSource() = default;

  /// Begins with a tile of the viewport whose rays are set, at the first cells, or where it paused
  /// at a depth. The camera is in the object space of the field.
  virtual void Begin(
    const Camera& view, const PixelRectangle& pixels, const CloudTile& tile, double from) = 0;

  /// No segment that is not found yet begins before this depth; infinite if there is none.
  virtual double GetNextDepth() const = 0;

  /// Whether no cell has been begun that is not finished. Then another source of the same cells may
  /// begin at the next depth.
  virtual bool IsPaused() const = 0;

  /// Appends some of the next segments of rays that are open, a bit for each column of each row: as
  /// many as are enough, or all that are left. If it pauses, no more than are found until then.
  virtual void FindMore(
    const std::uint32_t (&open)[CloudTile::Edge], bool pauses, CloudSegments& segments) = 0;
};

/// A source, and the camera in its object space.
struct ViewedCloud
{
  std::unique_ptr<CloudSource> Source;
  Camera View;
};

}

#endif
