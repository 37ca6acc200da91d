// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellLattice_h
#define CellLattice_h

#include "Image/Lattice/UnevenPlanes.h"
#include "Rays/Hit.h"

#include <cstdint>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// Divides numbers of 32 bits by the same one, at least 1, by a multiplication. (D. Lemire, O.
/// Kaser, N. Kurz: Faster Remainder by Direct Computation. Software: Practice and Experience 49(6),
/// 2019.)
class Divisor
{
public:
  explicit Divisor(int divisor)
    : IsOne(divisor == 1)
    , Inverse(~std::uint64_t{ 0 } / static_cast<std::uint64_t>(divisor) + 1)
  {
  }

  std::uint32_t Divide(std::uint32_t number) const
  {
    const std::uint64_t low = (this->Inverse & 0xFFFFFFFFU) * number;
    const std::uint64_t high = (this->Inverse >> 32) * number;
    return this->IsOne ? number : static_cast<std::uint32_t>((high + (low >> 32)) >> 32);
  }

private:
  bool IsOne;
  /// 2^64 over the divisor, rounded up.
  std::uint64_t Inverse;
};

/// The cells between the samples of an image: their planes, and their numbers, x fastest.
class CellLattice
{
public:
  /// Given the numbers of samples.
  explicit CellLattice(const Index3& dimensions)
    : Dimensions(dimensions)
    , Cells{ dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 }
    , Columns(this->Cells[0])
    , Rows(this->Cells[1])
  {
  }

  const Index3& GetDimensions() const { return this->Dimensions; }
  const Index3& GetCells() const { return this->Cells; }

  /// The lattice planes; null, as at first, stands for whole numbers. They must outlive the
  /// lattice.
  void SetPlanes(const UnevenPlanes* planes) { this->Planes = planes; }
  const UnevenPlanes* GetPlanes() const { return this->Planes; }

  std::int64_t GetNumber(const Index3& cell) const
  {
    const Index3& size = this->Cells;
    return cell[0] +
      static_cast<std::int64_t>(size[0]) * (cell[1] + static_cast<std::int64_t>(size[1]) * cell[2]);
  }

  Index3 GetCell(std::int64_t number) const
  {
    if (number <= std::numeric_limits<std::uint32_t>::max())
    {
      const auto rest = static_cast<std::uint32_t>(number);
      const std::uint32_t row = this->Columns.Divide(rest);
      const std::uint32_t slice = this->Rows.Divide(row);
      // Unsigned: products may be larger than an int.
      return { static_cast<int>(rest - row * static_cast<std::uint32_t>(this->Cells[0])),
        static_cast<int>(row - slice * static_cast<std::uint32_t>(this->Cells[1])),
        static_cast<int>(slice) };
    }
    const std::int64_t row = number / this->Cells[0];
    const std::int64_t slice = row / this->Cells[1];
    return { static_cast<int>(number - row * this->Cells[0]),
      static_cast<int>(row - slice * this->Cells[1]), static_cast<int>(slice) };
  }
  Index3 GetCell(const Hit& hit) const { return this->GetCell(hit.Cell); }

  Vector3 GetPoint(const Index3& cell, const Vector3& parametric) const
  {
    return this->Planes ? this->Planes->GetPoint(cell, parametric)
                        : GetPointInCells(cell, parametric);
  }
  Vector3 GetPoint(const Hit& hit) const
  {
    return this->GetPoint(this->GetCell(hit), hit.Parametric);
  }

  /// In index space, however the planes are spaced.
  Vector3 GetPointInCells(const Hit& hit) const
  {
    return GetPointInCells(this->GetCell(hit), hit.Parametric);
  }

private:
  static Vector3 GetPointInCells(const Index3& cell, const Vector3& parametric)
  {
    return { cell[0] + parametric[0], cell[1] + parametric[1], cell[2] + parametric[2] };
  }

  Index3 Dimensions;
  Index3 Cells;
  Divisor Columns;
  Divisor Rows;
  const UnevenPlanes* Planes = nullptr;
};

}

#endif
