// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How much of its data a mapper traces.

#ifndef vtkIsosurfaceRayTraceLevel_h
#define vtkIsosurfaceRayTraceLevel_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

VTK_ABI_NAMESPACE_BEGIN

enum class vtkIsosurfaceRayTraceLevel
{
  Exact,
  /// A few samples stand in for large grids, as long as these are not read.
  CoarseUntilRead,
  /// A few samples stand in for large grids.
  Coarse,
  /// What was traced last: both eyes see the same.
  AsBefore
};

VTK_ABI_NAMESPACE_END

#endif
