// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Histogram_h
#define Histogram_h

#include "Place.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor2D;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

/// Bars as high as the logarithms of counts, which fill a place.
vtkSmartPointer<vtkActor2D> MakeHistogram(const std::vector<double>& counts, const Place& place);

}

#endif
