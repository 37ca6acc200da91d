// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PaperTables_h
#define PaperTables_h

#include "Setup.h"

namespace Benchmark
{

/// The tables of Parker et al., Interactive Ray Tracing for Isosurface Rendering (IEEE
/// Visualization 1998), and of Ma and Parker, Massively Parallel Software Rendering for Visualizing
/// Large-Scale Data Sets (IEEE CG&A 2001), for the volume and the machine at hand.
void MakePaperTables(const Setup& setup, Report& report);

}

#endif
