// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Which blocks of images lie on one lattice: their samples coincide, or are whole numbers of cells
// apart.

#ifndef vtkIsosurfaceRayTraceLattices_h
#define vtkIsosurfaceRayTraceLattices_h

#include "vtkIsosurfaceRayTraceLeaves.h"   // for results
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Math/Vector.h"

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;

namespace vtkIsosurfaceRayTraceLattices
{

/// The index of a block's first point on the lattice of an image. Returns false if the block lies
/// on another lattice.
bool FindFirstPoint(
  vtkImageData* lattice, vtkImageData* block, vtkIsosurfaceRayTracing::Index3& first);

/// Divides blocks, in their order, into those that are to be joined: images on one lattice, of
/// one opacity, that fill a good part of the box around them. All others are by themselves.
std::vector<std::vector<vtkIsosurfaceRayTraceLeaf>> Group(
  const std::vector<vtkIsosurfaceRayTraceLeaf>& grids);

}

VTK_ABI_NAMESPACE_END

#endif
