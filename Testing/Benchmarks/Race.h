// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Race_h
#define Race_h

#include "Setup.h"

namespace Benchmark
{

/// This mapper and its rivals on an isosurface, in turn: memory, a new isovalue, pictures from all
/// sides. Goals 1, 2, 4 and 6.
void RunRace(const Setup& setup, double isovalue, Report& report);

}

#endif
