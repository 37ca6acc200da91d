// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AmrHierarchy_h
#define AmrHierarchy_h

#include "Amr/AmrNodes.h"
#include "Amr/AmrPatches.h"
#include "Amr/AmrRanges.h"
#include "Amr/AmrRegions.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Adaptive mesh refinement: patches on lattices that are finer from level to level, of which the
/// finest count. It gives each region samples such that the trilinear interpolants of all regions
/// are one continuous function: there are no cracks where levels meet.
///
/// The nodes of samples at points are these points. Samples of cells make nodes at the corners and
/// the centres of cells, edges and faces, which have the mean of the cells of the level that touch
/// them: between equal levels that is the trilinear interpolant between the centres of cells, as
/// for images. (The octants of F. Wang et al.: CPU Isosurface Ray Tracing of Adaptive Mesh
/// Refinement Data, IEEE TVCG 25(1), 2019.) A node that a coarser cell touches, and no finer one,
/// has the value of the interpolant of the coarser level there, so that both are the same on the
/// faces between them. Where a level has no cells, but finer ones do, means take the mean of these
/// instead, each by its volume.
///
/// Where patches of one level overlap, the first counts, unless it has a ghost there.
class AmrHierarchy
{
public:
  /// Ratios are, for each level, the numbers of its cells in one of the level before, along each
  /// axis; those of the first level are not used. What patches refer to must outlive the hierarchy
  /// and not change.
  AmrHierarchy(std::vector<Index3> ratios, std::vector<AmrPatch> patches, bool ofCells);
  AmrHierarchy(const AmrHierarchy&) = delete;
  void operator=(const AmrHierarchy&) = delete;

  /// The number of nodes along the edge of a cell, counted without one of its ends.
  int GetNodesOfCell() const { return this->Patches.GetNodesOfCell(); }

  const AmrPatch& GetPatch(std::size_t number) const { return this->Patches.Get(number); }

  /// Regions that were made before stay what they are.
  void SetKind(std::size_t number, int kind) { this->Patches.SetKind(number, kind); }

  /// See MakeAmrRegions.
  std::vector<AmrRegion> MakeRegions(int cells) const
  {
    return MakeAmrRegions(this->Patches, cells);
  }

  AmrNodes MakeNodes(const AmrRegion& region) const;

  /// A range that has all finite values of the interpolant in a region; it may be larger.
  AmrRange FindRange(const AmrRegion& region) const { return this->Ranges.Find(region); }

  /// The number of the patch of a region that has a cell of it, on the lattice of the level.
  std::size_t FindPatch(const AmrRegion& region, const Index3& cell) const
  {
    return vtkIsosurfaceRayTracing::FindPatch(this->Patches, region, cell);
  }

private:
  class NodeReader;

  std::vector<double> GatherSamples(const AmrRegion& region, Index3& dimensions) const;
  bool FillInner(const AmrRegion& region, AmrNodes& nodes) const;
  void HideCells(const AmrRegion& region, AmrNodes& nodes) const;

  AmrPatches Patches;
  AmrRanges Ranges;
};

}

#endif
