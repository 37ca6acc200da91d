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
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
    static_assert(TricubicBlock::Edge == BlockMask::Edge);
    std::fill_n(mask.Slices[2], BlockMask::Edge, 0U);
    const Index3 first = BlockMask::GetFirstCell(block);
    TricubicBlock around;
    this->LoadBlock(first, around);
    TricubicRanges ranges;
    kernels.BoundTricubic(around, ranges);
    const double rounding = this->GetRounding(around);
    const Index3& dimensions = this->TheSamples.GetDimensions();
    for (int z = 0; z < std::min(BlockMask::Edge, dimensions[2] - 1 - first[2]); ++z)
    {
      for (int y = 0; y < std::min(BlockMask::Edge, dimensions[1] - 1 - first[1]); ++y)
      {
        for (int x = 0; x < std::min(BlockMask::Edge, dimensions[0] - 1 - first[0]); ++x)
        {
          const bool has = std::any_of(isovalues.begin(), isovalues.end(),
            [&](const ScaledIsovalue& isovalue)
            {
              // Where rounding may decide, or samples are not finite, the cell is asked itself.
              const double margin = rounding + 1e-12 * std::abs(isovalue.Isovalue);
              const double below = isovalue.Isovalue - ranges.Low[z][y][x];
              const double above = ranges.High[z][y][x] - isovalue.Isovalue;
              TricubicCell cell;
              return (below > margin && above > margin) ||
                (!(below < -margin || above < -margin) &&
                  this->Load(
                    kernels, { first[0] + x, first[1] + y, first[2] + z }, isovalue, cell));
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
  /// Where samples are along each axis, from the one before a cell on. Instead of those outside of
  /// the volume, the nearest ones.
  template <int Count>
  void FindOffsets(const Index3& cell, std::ptrdiff_t (&offsets)[3][Count]) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int last = this->TheSamples.GetDimensions()[axis] - 1;
      for (int i = 0; i < Count; ++i)
      {
        offsets[axis][i] = std::clamp(cell[axis] + i - 1, -this->TheSamples.GetBefore(), last) *
          this->TheSamples.GetStride(static_cast<int>(axis));
      }
    }
  }

  /// Reads the 4^3 samples around a cell. (Those outside of the volume have no weight.) Returns
  /// whether all are finite.
  bool Load(const Index3& cell, TricubicCell& samples) const
  {
    std::ptrdiff_t offsets[3][4];
    this->FindOffsets(cell, offsets);
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

  /// Reads the samples around the cells of a block, and their weights. Beyond the volume, cells
  /// have none.
  void LoadBlock(const Index3& first, TricubicBlock& block) const
  {
    constexpr int count = TricubicBlock::SamplesPerEdge;
    std::ptrdiff_t offsets[3][count];
    this->FindOffsets(first, offsets);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int cells =
        std::min(TricubicBlock::Edge, this->TheSamples.GetDimensions()[axis] - 1 - first[axis]);
      for (int i = 0; i < cells; ++i)
      {
        const double* edge = this->Edges.Get(axis, first[axis] + i);
        for (int k = 0; k < 4; ++k)
        {
          block.Weights[axis][k][i] = edge[k];
        }
      }
    }
    const T* origin = this->TheSamples.At({ 0, 0, 0 });
    for (int z = 0; z < count; ++z)
    {
      for (int y = 0; y < count; ++y)
      {
        const T* row = origin + offsets[1][y] + offsets[2][z];
        for (int x = 0; x < count; ++x)
        {
          block.Samples[z][y][x] = static_cast<double>(row[offsets[0][x]]);
        }
      }
    }
  }

  /// More than rounding can change coefficients of a block, in whatever order they are made.
  /// Infinite where samples are not finite, or too large for that.
  double GetRounding(const TricubicBlock& block) const
  {
    const double weights = 1.0 + 2.0 * this->Edges.GetOvershoot();
    const double limit = 1e300 / weights;
    double largest = 0.0;
    bool areBelow = true;
    for (const auto& plane : block.Samples)
    {
      for (const auto& row : plane)
      {
        for (const double sample : row)
        {
          largest = std::max(largest, std::abs(sample));
          areBelow = areBelow && std::abs(sample) < limit;
        }
      }
    }
    return areBelow ? 1e-12 * weights * largest + std::numeric_limits<double>::min()
                    : std::numeric_limits<double>::infinity();
  }

  Samples<T> TheSamples;
  CubicEdges Edges;
};

}

#endif
