// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CornerRows_h
#define CornerRows_h

#include "Image/Macrocells/BlockMask.h"
#include "Image/Samples/VolumeView.h"
#include "Image/Traversal/CellQueueTracer.h"
#include "Kernels/Kernels.h"

#include <array>
#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The corners of cells for kernels: in the rows of a layout or, where it has none, in copies.
template <typename Layout>
class CornerRows final : public CellQueueTracer::CornerSource
{
public:
  using Reader = typename Layout::Reader;

  /// The reader must outlive the rows.
  explicit CornerRows(Reader& reader)
    : TheReader(reader)
  {
  }

  const void* FindCorner(const Index3& block) override
  {
    return this->TheReader.FindBlock(BlockMask::GetFirstCell(block), BlockMask::Edge);
  }

  std::array<std::ptrdiff_t, 3> GetSteps() const override
  {
    const std::ptrdiff_t* strides = this->TheReader.GetStrides();
    constexpr std::ptrdiff_t size = sizeof(typename Layout::Kept);
    return { strides[0] * size, strides[1] * size, strides[2] * size };
  }

  void Copy(PassedCells& cells, int axis, const Passages& passages) override
  {
    // Those behind the last, up to a full vector, repeat the first.
    const int count = cells.Count + PassedCells::Spare;
    this->Copies.resize(8 * static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
    {
      auto* corners = &this->Copies[8 * static_cast<std::size_t>(i)];
      this->TheReader.Load(GetPassedCell(cells.Codes[i], axis, passages), corners);
      cells.First[i] = corners;
    }
  }

  /// The cell of a code of PassedCells.
  static Index3 GetPassedCell(unsigned int code, int axis, const Passages& passages)
  {
    const int* first = passages.First[passages.Segments[code & 0xFFFFU].Block];
    Index3 cell = { first[0], first[1], first[2] };
    cell[static_cast<std::size_t>(axis)] += static_cast<int>(code >> 16 & 7U);
    cell[static_cast<std::size_t>(BlockMask::U[axis])] += static_cast<int>(code >> 24 & 7U);
    cell[static_cast<std::size_t>(BlockMask::V[axis])] += static_cast<int>(code >> 27);
    return cell;
  }

  std::size_t GetType(bool areCopied) const override
  {
    return static_cast<std::size_t>(
      areCopied ? ScalarTypeOf<typename Layout::Value>() : ScalarTypeOf<typename Layout::Kept>());
  }

  const std::ptrdiff_t* GetStrides(bool areCopied) const override
  {
    static constexpr std::ptrdiff_t ofCopies[3] = { 1, 2, 4 };
    return areCopied ? ofCopies : this->TheReader.GetStrides();
  }

private:
  Reader& TheReader;
  /// The eight corners of each cell.
  std::vector<typename Layout::Value> Copies;
};

}

#endif
