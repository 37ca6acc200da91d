// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ReadVolume_h
#define ReadVolume_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace Compare
{

/// The image in a file, read by the reader of VTK for its extension or its first bytes. Throws
/// std::runtime_error if there is no such reader or it finds no image.
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& fileName);

}

#endif
