// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AllHitsTracer_h
#define AllHitsTracer_h

#include "Field/RootSet.h"
#include "Image/Tracers/CandidateTracer.h"
#include "Image/Tracers/PacketCollector.h"
#include "Image/Tracers/RootTracing.h"

#include <array>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Finds all hits of the rays of a packet with some surfaces of the trilinear interpolant, up to
/// where each ray ends: behind translucent surfaces it goes on.
///
/// The hits of each ray are put in order behind each slice of blocks, or, where rays come to their
/// blocks one by one, behind the last.
class AllHitsTracer final : public CandidateTracer
{
public:
  /// All must outlive the tracer. The corners are those of the cells.
  AllHitsTracer(const ImageSelection& selection, const RayPacket& rays, RootCells& cells,
    CornerSource& corners);

  /// Appends the hits of all rays of the packet.
  void FindHits(RayHits& hits);

private:
  /// The root of a candidate, with what its order depends on.
  struct FoundRoot
  {
    Hit TheHit;
    Index3 Cell;
    Crossing Begin;
    double Fraction;
    /// Whether the kernels did not find all roots of the surface in the cell.
    bool IsPartial;
    /// The next root of the ray, or negative.
    int Next;
  };
  using Roots = std::vector<const FoundRoot*>;

  int KeepNeeded(const Frustum& frustum, int* passages, int count) const override;
  void KeepSolutions(int surface) override;
  void AddRoot(int candidate, int surface, bool isPartial);
  void Attenuate(int ray, const Hit& hit);
  void EndQueuedSlice(const Frustum& frustum) override;
  void EndFrustum() override;
  void AddHitsOfAll();
  bool AddHitsOfRay(int ray);
  bool AddHitsInCell(int ray, Roots::const_iterator first, Roots::const_iterator last);
  bool AddRootsInCell(int ray, const Index3& cell);

  RootCells& TheCells;
  /// Whether rays end at any hit with any surface.
  bool EndsAllRays = true;
  /// Whether every root is a hit: none is hidden.
  bool AreRootsVisible;
  /// What all roots that were found leave of each ray.
  std::array<double, RayPacket::Capacity> Transmittance;
  /// Those that were not yet added, and the number of the last one of each ray, or negative.
  std::vector<FoundRoot> Found;
  std::array<int, RayPacket::Capacity> LastOfRay;
  PacketCollector Collector;
  /// Kept for their memory.
  Roots OfRay;
  RootSet InCell;
};

}

#endif
