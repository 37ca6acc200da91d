// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TricubicField_h
#define TricubicField_h

#include "Image/Cells/TricubicCell.h"
#include "Image/Macrocells/BlockMask.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Samples/VolumeView.h"
#include "Kernels/Kernels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
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

  /// Sets the spacing of the samples; null planes stand at whole numbers. Returns whether it
  /// differs from the one before.
  bool SetPlanes(const UnevenPlanes* planes)
  {
    CubicEdges edges(this->TheSamples.GetDimensions(), this->TheSamples.GetBefore(), planes);
    const bool isOther = !(edges == this->Edges);
    this->Edges = std::move(edges);
    return isOther;
  }

  const CubicEdges& GetEdges() const { return this->Edges; }

  /// Makes the mask of a block of 8^3 cells: those that a surface may pass, because the
  /// coefficients are on both sides of its isovalue.
  void MakeMask(const Kernels& kernels, const Index3& block,
    const std::vector<ScaledIsovalue>& isovalues, BlockMask& mask) const
  {
    std::fill_n(mask.Slices[2], BlockMask::Edge, 0U);
    const Index3 first = BlockMask::GetFirstCell(block);
    const BlockRanges ranges = this->GetRanges(first);
    const Index3& dimensions = this->TheSamples.GetDimensions();
    for (int z = 0; z < std::min(BlockMask::Edge, dimensions[2] - 1 - first[2]); ++z)
    {
      for (int y = 0; y < std::min(BlockMask::Edge, dimensions[1] - 1 - first[1]); ++y)
      {
        for (int x = 0; x < std::min(BlockMask::Edge, dimensions[0] - 1 - first[0]); ++x)
        {
          const ValueRange<T>& range = ranges[Offset({ x, y, z }, RangesSize)];
          const bool has = std::any_of(isovalues.begin(), isovalues.end(),
            [&](const ScaledIsovalue& isovalue)
            {
              TricubicCell cell;
              return range.Straddles(isovalue.Isovalue, this->Edges.GetOvershoot()) &&
                this->Load(kernels, { first[0] + x, first[1] + y, first[2] + z }, isovalue, cell);
            });
          mask.Slices[2][z] |= static_cast<std::uint64_t>(has) << (x + BlockMask::Edge * y);
        }
      }
    }
    mask.CompleteSlices();
  }

  /// Makes the coefficients of a cell, with an isovalue subtracted. Returns whether the surface may
  /// pass the cell: all samples are finite, and coefficients are on both sides.
  bool Load(const Kernels& kernels, const Index3& cell, const ScaledIsovalue& isovalue,
    TricubicCell& coefficients) const
  {
    return this->Load(cell, coefficients) &&
      kernels.InterpolateSamples(this->Edges.Get(cell).data(), isovalue, coefficients.data());
  }

  /// The value at a point of a cell, less an isovalue: exactly the one with which the polynomials
  /// along rays begin or end there. None if the cell is empty.
  std::optional<double> GetDifference(const Kernels& kernels, const Index3& cell,
    const Vector3& parametric, const ScaledIsovalue& isovalue) const
  {
    TricubicCell coefficients;
    if (!this->Load(cell, coefficients))
    {
      return std::nullopt;
    }
    kernels.InterpolateSamples(this->Edges.Get(cell).data(), isovalue, coefficients.data());
    return GetTricubicValue(coefficients, parametric);
  }

private:
  /// The sample along an axis that is nearest to a place, which may be outside of the volume.
  int FindNearest(std::size_t axis, int place) const
  {
    return std::clamp(
      place, -this->TheSamples.GetBefore(), this->TheSamples.GetDimensions()[axis] - 1);
  }

  /// Reads the 4^3 samples around a cell. (Those outside of the volume have no weight.) Returns
  /// whether all are finite.
  bool Load(const Index3& cell, TricubicCell& samples) const
  {
    std::ptrdiff_t offsets[3][4];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < 4; ++i)
      {
        offsets[axis][i] = this->FindNearest(axis, cell[axis] + i - 1) *
          this->TheSamples.GetStride(static_cast<int>(axis));
      }
    }
    const T* origin = this->TheSamples.At({ 0, 0, 0 });
    double* next = samples.data();
    for (const std::ptrdiff_t z : offsets[2])
    {
      for (const std::ptrdiff_t y : offsets[1])
      {
        const T* row = origin + y + z;
        for (const std::ptrdiff_t x : offsets[0])
        {
          *next++ = static_cast<double>(row[x]);
        }
      }
    }
    return std::is_integral_v<T> || AreFinite(samples);
  }

  static bool AreFinite(const TricubicCell& samples)
  {
    // NaN, where one of them is not finite.
    double checks[4] = {};
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      checks[i % 4] += samples[i] * 0.0;
    }
    return checks[0] + checks[1] + checks[2] + checks[3] == 0.0;
  }

  /// For the cells of a block, x fastest, the ranges of the 4^3 samples around them.
  static constexpr Index3 RangesSize = { BlockMask::Edge + 3, BlockMask::Edge + 3,
    BlockMask::Edge + 3 };
  using BlockRanges = std::array<ValueRange<T>, RangesSize[0] * RangesSize[1] * RangesSize[2]>;

  /// At first each sample has a range of its own, from the one before the block on. Then, along one
  /// axis after the other, each takes in the next three.
  BlockRanges GetRanges(const Index3& first) const
  {
    BlockRanges ranges;
    std::size_t i = 0;
    for (int z = 0; z < RangesSize[2]; ++z)
    {
      for (int y = 0; y < RangesSize[1]; ++y)
      {
        for (int x = 0; x < RangesSize[0]; ++x)
        {
          const T sample = *this->TheSamples.At({ this->FindNearest(0, first[0] + x - 1),
            this->FindNearest(1, first[1] + y - 1), this->FindNearest(2, first[2] + z - 1) });
          ranges[i++].Include(sample, sample);
        }
      }
    }
    std::size_t step = 1;
    for (const int length : RangesSize)
    {
      for (i = 0; i + 3 * step < ranges.size(); ++i)
      {
        for (std::size_t next = i + step; next <= i + 3 * step; next += step)
        {
          ranges[i].Include(ranges[next].Min, ranges[next].Max);
        }
      }
      step *= static_cast<std::size_t>(length);
    }
    return ranges;
  }

  Samples<T> TheSamples;
  CubicEdges Edges;
};

}

#endif
