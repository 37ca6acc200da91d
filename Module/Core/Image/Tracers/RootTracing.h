// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RootTracing_h
#define RootTracing_h

#include "Field/Departure.h"
#include "Field/RootSet.h"
#include "Image/Cells/CellSegment.h"
#include "Image/Tracers/ImageSelection.h"
#include "Image/Traversal/PacketTracer.h"

#include <algorithm>

// Surfaces that are found as the roots of polynomials along the segments of rays in cells.

namespace vtkIsosurfaceRayTracing
{

/// The cells of an image, for one thread.
class RootCells : public PacketTracer::Cells
{
public:
  /// Whether a surface may pass a cell of an active macrocell: for cells that are found without
  /// masks.
  virtual bool MayHit(const Index3& cell) = 0;

  /// Finds the roots of the surfaces along a segment in a cell that surfaces may pass, in order:
  /// all of them, or none behind the first of an opaque surface.
  virtual void FindRoots(
    const Index3& cell, const CellSegment& segment, bool all, RootSet& roots) = 0;
};

/// Adds the hits of the roots in a cell. Returns whether nothing of the ray is left: add(hit) does.
template <typename Add>
bool AddHits(const Ray& ray, const CellLattice& lattice, const Index3& cell,
  const CellSegment& segment, const RootSet& roots, const Add& add)
{
  return std::any_of(roots.Get().begin(), roots.Get().end(),
    [&](const Root& root) {
      return add(MakeHit(ray, lattice, cell, segment, root.Fraction, root.Surface, root.Entering));
    });
}

/// Appends the hits of the rays of a packet.
void TraceRoots(
  const ImageSelection& selection, const RayPacket& rays, RootCells& cells, RayHits& hits);

/// Finds the rays of a packet that surfaces stop. There is a departure for each ray.
StoppedRays FindStoppedRays(const ImageSelection& selection, const RayPacket& rays,
  const Departure* departures, RootCells& cells);

/// The same for the crossings of one ray in a cell that surfaces may pass.
void FindStopsInCell(int number, const Ray& ray, const Index3& cell, const Departure& departure,
  RootCells& cells, RootSet& roots, StoppedRays& stopped);

}

#endif
