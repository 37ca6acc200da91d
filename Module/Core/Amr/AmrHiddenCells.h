// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AmrHiddenCells_h
#define AmrHiddenCells_h

#include "Amr/AmrPatches.h"
#include "Amr/AmrRegions.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Which cells of a region, and of the layer behind it, are hidden: those that its patches do not
/// show, or that finer or earlier patches replace.
class AmrHiddenCells
{
public:
  AmrHiddenCells(const AmrPatches& patches, const AmrRegion& region);

  bool IsEmpty() const;

  /// Cells are on the lattice of the level.
  bool Has(const Index3& cell) const { return this->Flags[this->GetPlace(cell)] != 0; }

private:
  void HideOwn(const AmrPatches& patches, const AmrRegion& region);
  void HideReplaced(const AmrPatches& patches, const AmrRegion& region);
  void HideBehind(const AmrPatches& patches, const AmrRegion& region);
  void Add(const Index3& cell) { this->Flags[this->GetPlace(cell)] = 1; }

  std::size_t GetPlace(const Index3& cell) const
  {
    return Offset(
      { cell[0] - this->First[0], cell[1] - this->First[1], cell[2] - this->First[2] }, this->Size);
  }

  Index3 First;
  Index3 Size;
  std::vector<unsigned char> Flags;
};

}

#endif
