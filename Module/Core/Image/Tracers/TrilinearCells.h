// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearCells_h
#define TrilinearCells_h

#include "Field/RootSet.h"
#include "Image/Cells/TrilinearRoots.h"
#include "Image/Samples/Unbricked.h"
#include "Image/Tracers/ImageSelection.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

/// The cells of an image for one thread (see RootTracing.h), by the trilinear interpolant.
template <typename Layout>
class TrilinearCells
{
public:
  TrilinearCells(const ImageSelection& selection, Layout& bricks)
    : Selection(selection)
    , TheReader(bricks)
  {
  }

  typename Layout::Reader& GetReader() { return this->TheReader; }

  void Prefetch(const Index3& cell) { this->TheReader.Prefetch(cell); }

  void Load(const Index3& cell) { this->TheReader.Load(cell, this->Corners); }

  /// Whether some corners are inside and others not, and all are finite.
  bool MayHit() const
  {
    // NaN compares false; IsFinite then decides.
    Value low = this->Corners[0];
    Value high = this->Corners[0];
    for (int i = 1; i < 8; ++i)
    {
      low = std::min(low, this->Corners[i]);
      high = std::max(high, this->Corners[i]);
    }
    const std::vector<Isosurface>& surfaces = this->Selection.Request.Surfaces;
    return std::any_of(surfaces.begin(), surfaces.end(),
             [low, high](const Isosurface& surface)
             {
               return static_cast<double>(low) < surface.Isovalue &&
                 surface.Isovalue <= static_cast<double>(high);
             }) &&
      IsFinite(this->Corners);
  }

  void FindRoots(const CellSegment& segment, bool all, RootSet& roots) const
  {
    CellCorners values;
    std::copy(this->Corners, this->Corners + 8, values.begin());
    roots.Clear();
    for (std::size_t i = 0; i < this->Selection.Isovalues.size(); ++i)
    {
      roots.NextSurface();
      AddTrilinearRoots(TakeOff(values, this->Selection.Isovalues[i]), segment,
        this->Selection.Request, static_cast<int>(i), !all && this->Selection.EndsRays(i), roots);
    }
  }

private:
  using Value = typename Layout::Value;

  const ImageSelection& Selection;
  typename Layout::Reader TheReader;
  Value Corners[8];
};

}

#endif
