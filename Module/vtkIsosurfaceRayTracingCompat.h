// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What newer versions of VTK define and VTK 9.1 lacks, so that one source serves them all.

#ifndef vtkIsosurfaceRayTracingCompat_h
#define vtkIsosurfaceRayTracingCompat_h

// Defines the namespace since VTK 9.3. Its version is not asked for: VTK warns of more deprecated
// functions where vtkVersionMacros.h comes first. (VTK's wrapping tools know no __has_include.)
#include "vtkType.h"

#ifndef VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_END
#endif

#endif
