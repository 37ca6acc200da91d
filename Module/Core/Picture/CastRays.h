// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CastRays_h
#define CastRays_h

#include "Image/ImageField.h"

#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The hits of any number of rays, traced on several threads.
RayHits CastRays(ImageField& volume, const std::vector<std::optional<Ray>>& rays, int threads);

}

#endif
