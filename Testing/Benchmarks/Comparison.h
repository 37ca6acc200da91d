// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Comparison_h
#define Comparison_h

#include "Setup.h"

namespace Benchmark
{

/// This mapper and its baselines on an isosurface, in turn: memory, a new isovalue, pictures from
/// all sides. Goals 1, 2, 4 and 6.
void CompareWithBaselines(const Setup& setup, double isovalue, Report& report);

}

#endif
