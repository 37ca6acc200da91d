// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What must be the same in all processes for their pictures to make one.

#ifndef vtkIsosurfaceRayTraceAgreement_h
#define vtkIsosurfaceRayTraceAgreement_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkLightCollection;
class vtkVolume;

namespace vtkIsosurfaceRayTraceAgreement
{

/// Things that processes must agree on, as numbers, and their name for a sentence.
struct Item
{
  const char* Name;
  std::vector<double> Numbers;
};

/// The items of a picture: first those that all pictures have, then those of each volume. The
/// volumes must have mappers that trace isosurfaces; the lights may be null.
std::vector<Item> Describe(const std::vector<vtkVolume*>& volumes, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height);

}

VTK_ABI_NAMESPACE_END

#endif
