// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearRoots_h
#define TrilinearRoots_h

#include "Image/Cells/CellSegment.h"
#include "Kernels/Kernels.h"
#include "Math/TrilinearCell.h"
#include "Rays/TraceRequest.h"

namespace vtkIsosurfaceRayTracing
{

class RootSet;

/// The corners of a cell with an isovalue subtracted.
CellCorners TakeOff(const CellCorners& corners, const ScaledIsovalue& isovalue);

/// Adds the roots of a surface along a segment, given the corners less its isovalue, as the
/// requested solver finds them; all of them, or the first.
void AddTrilinearRoots(const CellCorners& differences, const CellSegment& segment,
  const TraceRequest& request, int surface, bool firstOnly, RootSet& roots);

}

#endif
