// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Slab_h
#define Slab_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <array>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace Render
{

/// The cells of an image that a process has: those between two planes of points across the last
/// axis, along which files are contiguous.
struct Slab
{
  int First;
  int Last;

  bool IsEmpty() const { return this->Last <= this->First; }
};

using Extent = std::array<int, 6>;

/// That of a process, of slabs that are as thick as each other, or nearly. Those of the last
/// processes are empty if there are more processes than layers of cells.
Slab FindSlab(const Extent& whole, int process, int processes);

/// The extent of the points of a slab, with layers of ghosts as far as there are some.
Extent FindExtent(const Extent& whole, const Slab& slab, int ghosts);

/// Marks the cells of an image that are not in a slab as those of another process.
void MarkGhosts(const Slab& slab, vtkImageData* image);

}

#endif
