// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AmrRanges_h
#define AmrRanges_h

#include "Amr/AmrPatches.h"
#include "Amr/AmrRegions.h"

#include <limits>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The least and the largest of some values; the largest is less if there are none.
struct AmrRange
{
  double Min = std::numeric_limits<double>::infinity();
  double Max = -std::numeric_limits<double>::infinity();
};

/// Ranges of the values that regions may have, found from the samples alone: a region whose range
/// has no isovalue needs no nodes.
class AmrRanges
{
public:
  /// The patches must outlive the ranges.
  explicit AmrRanges(const AmrPatches& patches);
  AmrRanges(const AmrRanges&) = delete;
  void operator=(const AmrRanges&) = delete;

  /// A range that has all finite values of the interpolant in a region; it may be larger.
  AmrRange Find(const AmrRegion& region) const;

private:
  void IncludeLent(int level, Index3 first, Index3 end, bool asWhole, AmrRange& range) const;

  const AmrPatches& Patches;
  /// Of patches whose means coarser levels may need, where they have no cells of their own; those
  /// of the others are empty. None if all are.
  std::vector<AmrRange> LentRanges;
};

}

#endif
