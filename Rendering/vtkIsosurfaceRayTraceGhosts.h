// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The bits of ghost arrays.

#ifndef vtkIsosurfaceRayTraceGhosts_h
#define vtkIsosurfaceRayTraceGhosts_h

#include "vtkDataSetAttributes.h"          // for the bits
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Math/Vector.h"

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceGhosts
{
public:
  /// Cells that are not shown.
  static constexpr int Blanked =
    vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

  /// Cells and points that another piece has.
  static constexpr int Duplicate = vtkDataSetAttributes::DUPLICATECELL;
  static_assert(int{ vtkDataSetAttributes::DUPLICATEPOINT } == Duplicate, "the same bit");

  /// Points that hide all cells they are corners of.
  static constexpr int HiddenPoint = vtkDataSetAttributes::HIDDENPOINT;

  /// Whether a corner of a cell has one of some bits: the flags are those of points on a lattice
  /// with a size, of which the cell has the first.
  static bool HasAtCorner(const unsigned char* flags, const vtkIsosurfaceRayTracing::Index3& first,
    const vtkIsosurfaceRayTracing::Index3& size, int bits);
};

VTK_ABI_NAMESPACE_END

#endif
