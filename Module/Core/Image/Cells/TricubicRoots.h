// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TricubicRoots_h
#define TricubicRoots_h

#include "Image/Cells/CellSegment.h"
#include "Image/Cells/TricubicCell.h"

namespace vtkIsosurfaceRayTracing
{

class RootSet;
struct Kernels;

/// Adds the roots of a surface along a segment, given the coefficients less its isovalue; all of
/// them, or the first.
void AddTricubicRoots(const Kernels& kernels, const TricubicCell& coefficients,
  const CellSegment& segment, int surface, bool firstOnly, RootSet& roots);

}

#endif
