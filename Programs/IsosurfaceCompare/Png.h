// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Encodes pictures as PNG, to be embedded in a page.

#ifndef Png_h
#define Png_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

namespace Compare
{

/// The bytes of a PNG file, in base 64.
std::string EncodePng(vtkImageData* image);

/// Renders a window and encodes its picture.
std::string EncodePng(vtkRenderWindow* window);

}

#endif
