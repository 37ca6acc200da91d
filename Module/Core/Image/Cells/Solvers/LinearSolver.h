// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LinearSolver_h
#define LinearSolver_h

#include "Image/Cells/CellSegment.h"
#include "Math/TrilinearCell.h"

namespace vtkIsosurfaceRayTracing
{

/// The signs at the two ends of the segment decide, and linear interpolation between the ends gives
/// the hit: A. Neubauer, L. Mroz, H. Hauser, R. Wegenkittl: Cell-Based First-Hit Ray Casting,
/// VisSym 2002, in its cheapest form. Two crossings in one cell are missed; of three, the first may
/// be missed. For previews.
namespace Linear
{

/// Calls visit(u, entering) for the root found, if any.
template <typename Visit>
void ForEachRoot(const CellCorners& difference, const CellSegment& segment, Visit&& visit)
{
  const double atEntry = Interpolate(difference, segment.Entry);
  const double atExit = Interpolate(difference, segment.Exit);
  if (IsInside(atEntry) != IsInside(atExit))
  {
    visit(atEntry / (atEntry - atExit), IsInside(atExit));
  }
}

}
}

#endif
