// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What newer versions of VTK define and VTK 9.1 lacks, so that one source serves them all.

#ifndef vtkIsosurfaceRayTracingCompat_h
#define vtkIsosurfaceRayTracingCompat_h

#include "vtkVersionMacros.h"

#if VTK_MAJOR_VERSION > 9 || (VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION >= 3)
#include "vtkABINamespace.h"
#else
#define VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_END
#endif

#endif
