// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BeamTracer_h
#define BeamTracer_h

#include "BeamWalk.h"
#include "BlockMask.h"
#include "Hit.h"
#include "Kernels.h"
#include "Ray.h"

#include <utility>

namespace vtkIsosurfaceRayTracing
{

/// Finds the first hits of rays with one surface, a group of rays at a time.
///
/// The rays walk together, as a beam, to the active macrocells; for each of them, all cells of a
/// macrocell that the ray may pass and the surface does are found at once; these are candidates,
/// and solved in batches. What a candidate has to say comes from ray and cell alone
/// (CellSegment.h), so that proposing too many cells costs time and changes nothing.
///
class BeamTracer
{
public:
  /// Where cells come from. Used by one thread.
  class Cells
  {
  public:
    virtual ~Cells() = default;
    /// Says that a block is wanted soon.
    virtual void Prefetch(const Index3& block) = 0;
    /// Which cells of a block of 8^3 the surface passes; either kept elsewhere or made in own.
    virtual const BlockMask& GetMask(const Index3& block, BlockMask& own) = 0;
    virtual void LoadCorners(Candidates& candidates) = 0;
    /// Solves a cell that the kernels do not: the first hit of a ray of the group in it, and where
    /// the ray comes into the cell. Returns false if there is none.
    virtual bool FindFirstHit(int ray, const Index3& cell, Hit& hit, Place& begin) = 0;
  };

  BeamTracer(const Kernels& kernels, const BlockTree& tree, const ScaledIsovalue& isovalue)
    : TheKernels(kernels)
    , Tree(tree)
    , Isovalue(isovalue)
  {
  }

  /// Finds the hits of all rays of a group that exist.
  void Trace(RayGroup& group, Cells& cells);

  const GroupHits& GetHits() const { return this->Hits; }

private:
  void TraceSet(const RaySet& rays, int count);
  void VisitBlock(const Beam& beam, const Index3& block);
  void FollowPassages(const Beam& beam);
  void AddCandidates(int axis, int passage, int slice);
  void SolveQueue();
  void KeepExtreme(int candidate);

  const Kernels& TheKernels;
  const BlockTree& Tree;
  ScaledIsovalue Isovalue;

  RayGroup* Group = nullptr;
  Cells* Source = nullptr;
  RaySet Going = {};
  GroupHits Hits;
  Passages Passed;
  Candidates Queue;
  ExtremeCandidates Extremes;
};

}

#endif
