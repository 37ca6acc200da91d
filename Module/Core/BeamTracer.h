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
    /// Which cells of a block of 8^3 the surface passes; either kept elsewhere or made in own.
    virtual const BlockMask& GetMask(const Index3& block, BlockMask& own) = 0;
    virtual void LoadCorners(Candidates& candidates) = 0;
    /// Solves a cell that the kernels do not: the first hit of a ray of the group in it, and where
    /// the ray comes into the cell. Returns false if there is none.
    virtual bool FindFirstHit(int ray, const Index3& cell, Hit& hit, Place& begin) = 0;
  };

  /// The dimensions are those of the volume, in samples.
  BeamTracer(const Kernels& kernels, const BlockTree& tree, const Index3& dimensions,
    const ScaledIsovalue& isovalue)
    : TheKernels(kernels)
    , Tree(tree)
    , Dimensions(dimensions)
    , Isovalue(isovalue)
  {
  }

  void Trace(RayGroup& group, Cells& cells);

  bool HasHit(int ray) const { return (this->Found.Words[ray / 64] >> (ray % 64) & 1) != 0; }
  const Hit& GetHit(int ray) const { return this->Hits[ray]; }

private:
  void TraceSet(const RaySet& rays, int count);
  void VisitBlock(const Beam& beam, const Index3& block);
  void AddCandidates(int axis, const int first[3], int entry, int slice);
  void SolveQueue();
  bool IsBeside(int candidate) const;
  void DropCandidatesBeside();
  Index3 GetCell(int candidate) const;
  void Keep(int ray, const Hit& hit, const Place& begin);

  const Kernels& TheKernels;
  const BlockTree& Tree;
  Index3 Dimensions;
  ScaledIsovalue Isovalue;

  RayGroup* Group = nullptr;
  Cells* Source = nullptr;
  bool HasParallelRays = false;
  RaySet Going = {};
  RaySet Found = {};
  RaySet FoundInBlock = {};
  Hit Hits[RayGroup::Capacity];
  /// Where a ray came into the cell it hit.
  Place Begins[RayGroup::Capacity];
  BlockCells Passed;
  Candidates Queue;
  FirstRoots Roots;
};

}

#endif
