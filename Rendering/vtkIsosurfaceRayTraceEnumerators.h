// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts enumerators of VTK and of vtkIsosurfaceRayTraceMapper to those of the core.

#ifndef vtkIsosurfaceRayTraceEnumerators_h
#define vtkIsosurfaceRayTraceEnumerators_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Image/ImageSettings.h"
#include "Rays/TraceRequest.h"

#include <optional> // for std::optional

VTK_ABI_NAMESPACE_BEGIN

namespace vtkIsosurfaceRayTraceEnumerators
{

/// Of vtkIsosurfaceRayTraceMapper::InterpolationModes, and so on.
vtkIsosurfaceRayTracing::Interpolant ToInterpolant(int interpolationMode);
vtkIsosurfaceRayTracing::RootSolver ToRootSolver(int rootSolver);
vtkIsosurfaceRayTracing::NormalMode ToNormalMode(int normalMode);
vtkIsosurfaceRayTracing::BrickLayout ToBrickLayout(int brickLayout);

/// The extreme value that a blend mode of vtkVolumeMapper projects; none for other modes.
std::optional<vtkIsosurfaceRayTracing::Extremum> FindProjection(int blendMode);

/// The component of vtkIsosurfaceRayTraceScalars that a vector mode selects; none if it is
/// disabled.
std::optional<int> FindComponent(int vectorMode, int vectorComponent);

}

VTK_ABI_NAMESPACE_END

#endif
