// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Cells/TricubicRoots.h"

#include "Field/RootSet.h"
#include "Math/NonicRoots.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void AddTricubicRoots(const TricubicCell& coefficients, const CellSegment& segment, int surface,
  bool firstOnly, RootSet& roots)
{
  Nonic::ForEachRoot(NonicAlongSegment(coefficients, segment.Entry, segment.Exit),
    [&roots, surface, firstOnly](double fraction, bool entering)
    {
      roots.Add({ fraction, surface, entering });
      return firstOnly;
    });
}

}
