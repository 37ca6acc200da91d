// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Pictures as they are put into a page: PNG files that were never written.

#ifndef Png_h
#define Png_h

#include <string>

class vtkImageData;
class vtkRenderWindow;

namespace Compare
{

/// The bytes of a PNG file, in base 64.
std::string EncodePng(vtkImageData* image);

/// Renders a window and encodes what it shows.
std::string EncodePng(vtkRenderWindow* window);

}

#endif
