// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearCells_h
#define TrilinearCells_h

#include "Image/Cells/TrilinearRoots.h"
#include "Image/Macrocells/CellMasks.h"
#include "Image/Samples/Unbricked.h"
#include "Image/Tracers/RootTracing.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

/// The cells of an image, by the trilinear interpolant.
template <typename T, typename Layout>
class TrilinearCells final : public RootCells
{
public:
  /// All must outlive the cells.
  TrilinearCells(const ImageSelection& selection, CellMasks<T>& masks, Layout& bricks)
    : Selection(selection)
    , Masks(masks)
    , TheReader(bricks)
  {
  }

  typename Layout::Reader& GetReader() { return this->TheReader; }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Masks.Get(block, own);
  }

  void Prefetch(const Index3& block) override
  {
    this->Masks.Prefetch(block);
    this->TheReader.Prefetch(BlockMask::GetFirstCell(block));
  }

  /// Whether some corners are inside and others not, and all are finite.
  bool MayHit(const Index3& cell) override
  {
    Value corners[8];
    this->TheReader.Load(cell, corners);
    const Range range(corners);
    const std::vector<Isosurface>& surfaces = this->Selection.Request.Surfaces;
    return std::any_of(surfaces.begin(), surfaces.end(),
             [&range](const Isosurface& surface) { return range.IsPassedBy(surface); }) &&
      IsFinite(corners);
  }

  void FindRoots(const Index3& cell, const CellSegment& segment, bool all, RootSet& roots) override
  {
    Value corners[8];
    this->TheReader.Load(cell, corners);
    const Range range(corners);
    CellCorners values;
    std::copy(corners, corners + 8, values.begin());
    roots.Clear();
    for (std::size_t i = 0; i < this->Selection.Isovalues.size(); ++i)
    {
      if (range.IsPassedBy(this->Selection.Request.Surfaces[i]))
      {
        roots.NextSurface();
        AddTrilinearRoots(TakeOff(values, this->Selection.Isovalues[i]), segment,
          this->Selection.Request, static_cast<int>(i), !all && this->Selection.EndsRays(i), roots);
      }
    }
  }

private:
  using Value = typename Layout::Value;

  /// That of the corners of a cell.
  struct Range
  {
    Value Low;
    Value High;

    /// Of any corners if some are NaN, which compares false.
    explicit Range(const Value* corners)
      : Low(corners[0])
      , High(corners[0])
    {
      for (int i = 1; i < 8; ++i)
      {
        this->Low = std::min(this->Low, corners[i]);
        this->High = std::max(this->High, corners[i]);
      }
    }

    bool IsPassedBy(const Isosurface& surface) const
    {
      return static_cast<double>(this->Low) < surface.Isovalue &&
        surface.Isovalue <= static_cast<double>(this->High);
    }
  };

  const ImageSelection& Selection;
  CellMasks<T>& Masks;
  typename Layout::Reader TheReader;
};

}

#endif
