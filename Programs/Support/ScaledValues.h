// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The values that a file means: NIfTI stores others, with a slope and an intercept, which VTK's
// reader tells but does not apply.

#ifndef ScaledValues_h
#define ScaledValues_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkImageData;
class vtkNIFTIImageReader;
VTK_ABI_NAMESPACE_END

namespace Programs
{

/// Whether the values are others than those that are stored, once the reader knows the header.
bool HasScale(vtkNIFTIImageReader* reader);

/// Single precision for integers of 16 bits or fewer, otherwise double.
vtkSmartPointer<vtkImageData> ScaleValues(vtkNIFTIImageReader* reader, vtkImageData* image);

/// Other readers do it.
inline vtkSmartPointer<vtkImageData> ScaleValues(vtkAlgorithm*, vtkImageData* image)
{
  return image;
}

}

#endif
