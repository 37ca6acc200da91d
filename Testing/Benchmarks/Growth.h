// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Growth_h
#define Growth_h

#include "Setup.h"

namespace Benchmark
{

/// Goal 7: how the times of a picture and of an extraction grow with the edge n of the volume, a
/// gyroid of the same shape for each n: 64, 128 and so on up to the largest. Only the pictures'
/// size, threads, views and repeats of the set-up are used.
void MeasureGrowth(const Setup& setup, int largest, Report& report);

}

#endif
