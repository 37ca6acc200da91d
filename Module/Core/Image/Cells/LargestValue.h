// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LargestValue_h
#define LargestValue_h

#include "Image/Cells/CellSegment.h"
#include "Math/TrilinearCell.h"

namespace vtkIsosurfaceRayTracing
{

/// A value of the interpolant along a segment, and where it is, as a fraction of the segment.
struct SegmentValue
{
  double Fraction;
  double Value;
};

/// The largest value of the trilinear interpolant along a segment, the first of equal values. It
/// never exceeds the corners, the largest of which is given.
SegmentValue FindLargest(CellCorners corners, double largest, const CellSegment& segment);

}

#endif
