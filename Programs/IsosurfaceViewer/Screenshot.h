// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Screenshot_h
#define Screenshot_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

/// Writes what a window shows to a new PNG file in the current folder. Returns its name. Throws
/// std::runtime_error if it cannot be written.
std::string WriteScreenshot(vtkRenderWindow* window);

}

#endif
