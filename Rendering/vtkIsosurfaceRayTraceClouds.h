// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The transfer functions of a property, as those of a cloud.

#ifndef vtkIsosurfaceRayTraceClouds_h
#define vtkIsosurfaceRayTraceClouds_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Picture/CloudTransfer.h"

#include <memory> // for std::unique_ptr

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceValueColors;

namespace vtkIsosurfaceRayTraceClouds
{

/// Makes transfer functions that are linear between nodes: those of the property, and as many
/// between them as it takes where its functions are not linear (midpoints, sharpness, colour
/// spaces, logarithms), to less than 1e-4. The opacity is the attenuation for the unit distance, as
/// vtkUnstructuredGridVolumeMapper's family has it.
std::unique_ptr<vtkIsosurfaceRayTracing::CloudTransfer> MakeTransfer(
  const vtkIsosurfaceRayTraceValueColors& colors, double unitDistance);

}

VTK_ABI_NAMESPACE_END

#endif
