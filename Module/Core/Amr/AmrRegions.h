// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How patches of a level are put together to boxes that are traced as one.

#ifndef AmrRegions_h
#define AmrRegions_h

#include "Amr/AmrPatches.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Patches of a level that fill a box, which are traced as one.
struct AmrRegion
{
  int Level;
  /// As those of patches.
  Index3 First;
  Index3 Cells;
  std::vector<std::size_t> Patches;
};

/// All patches, each in one region. Those that have several patches lie in one of the cubes, with
/// this number of cells of their level along each axis, that start at the origin of the lattice;
/// none has patches that overlap.
std::vector<AmrRegion> MakeAmrRegions(const AmrPatches& patches, int cells);

/// The number of the patch of a region that has a cell of it, on the lattice of the level.
std::size_t FindPatch(const AmrPatches& patches, const AmrRegion& region, const Index3& cell);

}

#endif
