// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Cells/TricubicRoots.h"

#include "Field/RootSet.h"
#include "Kernels/Kernels.h"
#include "Math/NonicRoots.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void AddTricubicRoots(const Kernels& kernels, const TricubicCell& coefficients,
  const CellSegment& segment, int surface, bool firstOnly, RootSet& roots)
{
  BernsteinNonic nonic;
  if (!kernels.RestrictCell(
        coefficients.data(), segment.Entry.data(), segment.Exit.data(), nonic.data()))
  {
    return;
  }
  Nonic::ForEachRoot(nonic,
    [&roots, surface, firstOnly](double fraction, bool entering)
    {
      roots.Add({ fraction, surface, entering });
      return firstOnly;
    });
}

}
