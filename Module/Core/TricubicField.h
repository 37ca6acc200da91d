// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TricubicField_h
#define TricubicField_h

#include "BlockMask.h"
#include "CellSegment.h"
#include "Kernels.h"
#include "MacrocellHierarchy.h"
#include "NonicRoots.h"
#include "TricubicCell.h"
#include "VolumeView.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The tricubic interpolant of a volume, read from the samples of the user. A cell is empty if one
/// of the 4^3 samples around it is NaN or infinite.
template <typename T>
class TricubicField
{
public:
  explicit TricubicField(const Samples<T>& samples)
    : TheSamples(samples)
  {
  }

  /// Takes the spacing of the samples; null planes stand at whole numbers. Returns whether it is
  /// another one than before.
  bool SetPlanes(const UnevenPlanes* planes)
  {
    CubicEdges edges(this->TheSamples.GetDimensions(), planes);
    const bool isOther = !(edges == this->Edges);
    this->Edges = std::move(edges);
    return isOther;
  }

  const CubicEdges& GetEdges() const { return this->Edges; }

  /// Makes the mask of a block of 8^3 cells: those that a surface may pass, because the
  /// coefficients are on both sides of its isovalue.
  void MakeMask(
    const Index3& block, const std::vector<ScaledIsovalue>& isovalues, BlockMask& mask) const
  {
    std::fill_n(mask.Slices[2], BlockMask::Edge, 0U);
    Index3 first;
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = block[axis] * BlockMask::Edge;
      count[axis] =
        std::min(BlockMask::Edge, this->TheSamples.GetDimensions()[axis] - 1 - first[axis]);
    }
    for (int z = 0; z < count[2]; ++z)
    {
      for (int y = 0; y < count[1]; ++y)
      {
        for (int x = 0; x < count[0]; ++x)
        {
          const Index3 cell = { first[0] + x, first[1] + y, first[2] + z };
          const auto has = static_cast<std::uint64_t>(this->MayHaveSurface(cell, isovalues));
          mask.Slices[2][z] |= has << (x + BlockMask::Edge * y);
        }
      }
    }
    mask.CompleteSlices();
  }

  /// Calls visit(fraction, rising) for every root along the segment of a ray in a cell, in order,
  /// until visit returns true.
  template <typename Visit>
  void ForEachRoot(const Index3& cell, const ScaledIsovalue& isovalue, const CellSegment& segment,
    const Visit& visit) const
  {
    TricubicCell coefficients;
    if (this->Load(cell, coefficients) && this->HasSurface(cell, isovalue, coefficients))
    {
      Nonic::ForEachRoot(NonicAlongSegment(coefficients, segment.Entry, segment.Exit), visit);
    }
  }

  /// The gradient at a point of a cell, in its own coordinates, per cell edge along each axis.
  Vector3 GetGradient(const Index3& cell, const Vector3& parametric) const
  {
    TricubicCell coefficients;
    this->Load(cell, coefficients);
    InterpolateSamples(this->Edges, cell, coefficients);
    return TricubicGradient(coefficients, parametric);
  }

private:
  /// Reads the 4^3 samples around a cell. (Those outside of the volume count for nothing.) Returns
  /// whether all are finite.
  bool Load(const Index3& cell, TricubicCell& samples) const
  {
    std::ptrdiff_t offsets[3][4];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < 4; ++i)
      {
        offsets[axis][i] =
          std::clamp(cell[axis] + i - 1, 0, this->TheSamples.GetDimensions()[axis] - 1) *
          this->TheSamples.GetStride(static_cast<int>(axis));
      }
    }
    const T* origin = this->TheSamples.At({ 0, 0, 0 });
    // Not a number, if one of them is none.
    double check = 0.0;
    for (std::size_t i = 0; i < 64; ++i)
    {
      samples[i] =
        static_cast<double>(origin[offsets[0][i % 4] + offsets[1][i / 4 % 4] + offsets[2][i / 16]]);
      check += samples[i] * 0.0;
    }
    return check == 0.0;
  }

  bool MayHaveSurface(const Index3& cell, const std::vector<ScaledIsovalue>& isovalues) const
  {
    TricubicCell samples;
    if (!this->Load(cell, samples))
    {
      return false;
    }
    const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
    const ValueRange<double> range = { *low, *high };
    return std::any_of(isovalues.begin(), isovalues.end(),
      [this, &cell, &samples, &range](const ScaledIsovalue& isovalue)
      {
        TricubicCell own = samples;
        return range.Straddles(isovalue.Isovalue, this->Edges.GetOvershoot()) &&
          this->HasSurface(cell, isovalue, own);
      });
  }

  /// Makes coefficients of the samples around a cell, with the isovalue taken off. Returns whether
  /// they are on both sides.
  bool HasSurface(const Index3& cell, const ScaledIsovalue& isovalue, TricubicCell& samples) const
  {
    for (double& sample : samples)
    {
      sample = Difference(sample, isovalue.Isovalue, isovalue.Scale);
    }
    InterpolateSamples(this->Edges, cell, samples);
    return std::any_of(samples.begin(), samples.end(), IsInside) &&
      !std::all_of(samples.begin(), samples.end(), IsInside);
  }

  Samples<T> TheSamples;
  CubicEdges Edges;
};

}

#endif
