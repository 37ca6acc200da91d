// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceGhosts.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceGhosts::HasAtCorner(
  const unsigned char* flags, const vtkirt::Index3& first, const vtkirt::Index3& size, int bits)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const vtkirt::Index3 index = { first[0] + (corner & 1), first[1] + (corner >> 1 & 1),
      first[2] + (corner >> 2) };
    if ((flags[vtkirt::Offset(index, size)] & bits) != 0)
    {
      return true;
    }
  }
  return false;
}

VTK_ABI_NAMESPACE_END
