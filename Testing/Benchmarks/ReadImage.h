// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ReadImage_h
#define ReadImage_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

/// The volume in a file (or in a folder of DICOM slices), by the reader of VTK for its extension or
/// its first bytes. It has three dimensions and point scalars, and takes at most so many MiB (see
/// ReadVolume.h). Throws std::runtime_error.
vtkSmartPointer<vtkImageData> ReadImage(const std::string& fileName, double maxMemory);

}

#endif
