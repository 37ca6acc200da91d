// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Caps_h
#define Caps_h

#include "Image/Lattice/Ray.h"
#include "Rays/Visibility.h"

#include <vector>

// A cap closes the inside of a surface where a half-space cuts it open. A ray meets one where it is
// cut: at its begin, its end, or both. Whether it is inside there is decided in the cell where its
// cut part begins (or ends), by exactly the value that the solvers start from (or end with). So the
// signs are continuous from the cap to the hits: a ray that begins with a cap leaves the surface
// next, one that does not enters it. There is no crack between cap and surface.

namespace vtkIsosurfaceRayTracing
{

/// The half-space with caps in whose plane a ray begins or ends that is cut to all of them;
/// Hit::NoPlane if there is none. A plane may coincide with a face of the volume, as those of a box
/// around it do.
int FindCappedPlane(
  const Ray& ray, RayEnd end, const std::vector<HalfSpace>& halves, const Index3& cells);

/// The first or the last of the cells that a ray passes, and where the ray begins or ends in it.
struct EndCell
{
  Index3 Cell;
  Crossing At;
};

EndCell FindEndCell(const Ray& ray, RayEnd end, const Index3& cells);

/// Moves the end of a ray, in the plane of a half-space, over planes between cells, or between
/// boxes of samples (see BoxFaces.h), that coincide with it: the cells and the boxes visible there
/// are those that the half-space leaves.
void StepOverPlanes(Ray& ray, RayEnd end, const Index3& cells, bool areBoxes);

}

#endif
