// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellLattice_h
#define CellLattice_h

#include "Field/HitCollector.h"
#include "Image/Lattice/UnevenPlanes.h"
#include "Rays/Hit.h"

#include <cstdint>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// The cells between the samples of an image: their planes, and their numbers, x fastest.
class CellLattice final : public HitLocator
{
public:
  /// Given the numbers of samples.
  explicit CellLattice(const Index3& dimensions)
    : Dimensions(dimensions)
    , Cells{ dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 }
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
    // Division of 32 bits takes a fraction of the time.
    const auto all = static_cast<std::uint64_t>(number);
    return all <= std::numeric_limits<std::uint32_t>::max()
      ? this->Divide(static_cast<std::uint32_t>(all))
      : this->Divide(all);
  }
  Index3 GetCell(const Hit& hit) const { return this->GetCell(hit.Cell); }

  Vector3 GetPoint(const Index3& cell, const Vector3& parametric) const
  {
    return this->Planes ? this->Planes->GetPoint(cell, parametric)
                        : GetPointInCells(cell, parametric);
  }
  Vector3 GetPoint(const Hit& hit) const override
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

  template <typename Integer>
  Index3 Divide(Integer number) const
  {
    const auto columns = static_cast<Integer>(this->Cells[0]);
    const auto rows = static_cast<Integer>(this->Cells[1]);
    const Integer row = number / columns;
    const Integer slice = row / rows;
    return { static_cast<int>(number - row * columns), static_cast<int>(row - slice * rows),
      static_cast<int>(slice) };
  }

  Index3 Dimensions;
  Index3 Cells;
  const UnevenPlanes* Planes = nullptr;
};

}

#endif
