// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AmrPatches_h
#define AmrPatches_h

#include "Amr/AmrCells.h"
#include "Field/BoundsTree.h"
#include "Image/Samples/VolumeView.h"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A block of a refined grid: cells of one level.
struct AmrPatch
{
  /// 0 is the coarsest.
  int Level;
  /// The first cell on the lattice of the level, and the number of cells.
  Index3 First;
  Index3 Cells;
  /// At the points of the cells, or one for each cell.
  VolumeView Samples;
  /// For each cell, whether another patch has it (a ghost), or nothing is to be drawn there; null
  /// if there are none of either.
  const unsigned char* GhostCells = nullptr;
  const unsigned char* HiddenCells = nullptr;
  /// Only patches of one kind are traced as one.
  int Kind = 0;
};

inline std::size_t GetNumber(const AmrPatch& patch, const Index3& cell)
{
  return Offset(
    { cell[0] - patch.First[0], cell[1] - patch.First[1], cell[2] - patch.First[2] }, patch.Cells);
}

inline bool Owns(const AmrPatch& patch, const Index3& cell)
{
  return IsIn(patch, cell) && (!patch.GhostCells || patch.GhostCells[GetNumber(patch, cell)] == 0);
}

inline double GetSample(const AmrPatch& patch, const Index3& index)
{
  const Index3 place = { index[0] - patch.First[0], index[1] - patch.First[1],
    index[2] - patch.First[2] };
  return DispatchScalarType(patch.Samples,
    [&place](const auto& samples) { return static_cast<double>(*samples.At(place)); });
}

/// The patches of all levels of a refined grid: which of them has a cell, and which cells others
/// cover.
class AmrPatches
{
public:
  /// The patches of a level.
  struct Level
  {
    /// Cells in one of the level before.
    Index3 Ratio;
    std::vector<std::size_t> Numbers;
    std::unique_ptr<BoundsTree> Tree;
    bool HasOverlaps = false;

    /// Calls visit(number) for the patches that have cells in a box.
    template <typename Visit>
    void ForEachIn(const Bounds& box, const Visit& visit) const
    {
      this->Tree->Find([&box](const Bounds& other) { return Overlap(other, box); },
        [&](std::size_t place) { visit(this->Numbers[place]); });
    }
  };

  /// Patches that were found lately, of a level.
  struct Likely
  {
    std::array<const AmrPatch*, 8> Patches = {};
    std::size_t Next = 0;
  };

  /// See AmrHierarchy.
  AmrPatches(std::vector<Index3> ratios, std::vector<AmrPatch> patches, bool ofCells);

  bool AreOfCells() const { return this->OfCells; }

  /// The number of nodes along the edge of a cell, counted without one of its ends.
  int GetNodesOfCell() const { return this->OfCells ? 2 : 1; }

  std::size_t GetCount() const { return this->All.size(); }
  const AmrPatch& Get(std::size_t number) const { return this->All[number]; }
  void SetKind(std::size_t number, int kind) { this->All[number].Kind = kind; }

  int GetNumberOfLevels() const { return static_cast<int>(this->Levels.size()); }
  const Level& GetLevel(int level) const { return this->Levels[static_cast<std::size_t>(level)]; }

  /// The first patch of a level that has a cell; null if there is none.
  const AmrPatch* FindOwner(int level, const Index3& cell) const;

  /// The same where it is likely to be one of some.
  const AmrPatch* FindOwner(int level, const Index3& cell, Likely& likely) const;

  bool IsCoveredByFiner(int level, const Index3& cell) const;

  /// By a level that is not coarser than a given one.
  bool IsCoveredByCoarser(int level, const Index3& cell, int coarsest) const;

  /// Whether the patch that has a cell, of its level or else of the next coarser one, shows it.
  bool IsShown(int level, const Index3& cell) const;

  /// The mean of the finer cells in a cell that its level lacks, each by its part of the volume.
  double FindMean(int level, const Index3& cell) const;

  /// Whether all coarser levels have the cells that a patch lies in. It is false, too, where that
  /// is not seen from boxes alone.
  bool IsInCoarser(const AmrPatch& patch) const;

private:
  bool HasOverlaps(const Level& level) const;
  bool Covers(const Level& level, const Index3& first, const Index3& count) const;

  bool OfCells;
  std::vector<AmrPatch> All;
  std::vector<Level> Levels;
};

}

#endif
