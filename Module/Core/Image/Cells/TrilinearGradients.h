// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearGradients_h
#define TrilinearGradients_h

#include "Image/Lattice/CellLattice.h"
#include "Image/Lattice/UnevenPlanes.h"
#include "Image/Samples/Unbricked.h"
#include "Image/Samples/VolumeView.h"
#include "Kernels/Kernels.h"
#include "Math/TrilinearCell.h"
#include "Rays/Hit.h"
#include "Rays/TraceRequest.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace vtkIsosurfaceRayTracing
{

/// From differences along the edges of a cell to the gradient. In a flat cell only its flat axes
/// count: there the gradient is infinite, and this is its direction.
inline Vector3 DivideByWidths(Vector3 gradient, const UnevenPlanes* planes, const Index3& cell)
{
  if (!planes)
  {
    return gradient;
  }
  const bool isFlat = planes->IsFlat(cell);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double width = planes->GetWidth(axis, cell[axis]);
    gradient[axis] = isFlat ? (width > 0.0 ? 0.0 : gradient[axis]) : gradient[axis] / width;
  }
  return gradient;
}

/// Gradients in the cells of an image, read from the samples of the user.
template <typename T>
class TrilinearGradients
{
public:
  explicit TrilinearGradients(const Samples<T>& samples)
    : TheSamples(samples)
  {
  }

  /// Where there are no central differences to take (in flat cells, and beside NaN or infinite
  /// samples), it is the gradient of the interpolant.
  Vector3 GetGradient(const Hit& hit, NormalMode mode, const CellLattice& lattice) const
  {
    const UnevenPlanes* planes = lattice.GetPlanes();
    const Index3 cell = lattice.GetCell(hit);
    if (mode == NormalMode::CentralDifferences && !(planes && planes->IsFlat(cell)))
    {
      const Vector3 gradient = this->InterpolateDifferences(cell, hit.Parametric, planes);
      if (IsFinite(gradient))
      {
        return gradient;
      }
    }
    Stored<T> corners[8];
    LoadCorners(this->TheSamples, cell, corners);
    CellCorners values;
    std::copy(corners, corners + 8, values.begin());
    return DivideByWidths(InterpolantGradient(values, hit.Parametric), planes, cell);
  }

  /// Interpolates central differences with a kernel. Returns the hits whose gradients must be found
  /// in other ways.
  RaySet InterpolateDifferences(const Hit* hits, const Index3* cellsOfHits, int count,
    const Kernels& kernels, const UnevenPlanes* planes,
    double (*gradients)[RayPacket::Capacity]) const
  {
    InnerCells cells;
    cells.AreUneven = planes != nullptr;
    cells.Count = 0;
    RaySet others = {};
    int inner[RayPacket::Capacity];
    int atBorder[RayPacket::Capacity];
    int borderCount = 0;
    for (int i = 0; i < count; ++i)
    {
      if (hits[i].Plane != Hit::NoPlane || (planes && planes->IsFlat(cellsOfHits[i])))
      {
        Add(i, others);
      }
      else if (this->IsInner(cellsOfHits[i]))
      {
        inner[cells.Count] = i;
        AddCell(this->TheSamples.At(cellsOfHits[i]), hits[i], cellsOfHits[i], planes, cells);
      }
      else
      {
        atBorder[borderCount++] = i;
      }
    }
    alignas(64) double found[3][RayPacket::Capacity];
    if (cells.Count == count)
    {
      Call<T>(kernels, cells, this->TheSamples.GetStrides(), gradients);
    }
    else if (cells.Count > 0)
    {
      Call<T>(kernels, cells, this->TheSamples.GetStrides(), found);
      Scatter(found, inner, cells.Count, gradients);
    }
    for (int first = 0; first < borderCount; first += Batch)
    {
      Neighbourhood copies[Batch];
      cells.Count = 0;
      for (const int* i = atBorder + first; i < atBorder + std::min(first + Batch, borderCount);
           ++i)
      {
        Neighbourhood& copy = copies[cells.Count];
        this->Copy(cellsOfHits[*i], copy);
        AddCell(copy + FirstCorner, hits[*i], cellsOfHits[*i], planes, cells);
      }
      Call<double>(kernels, cells, Steps, found);
      Scatter(found, atBorder + first, cells.Count, gradients);
    }
    const bool mayBeInfinite = std::is_floating_point_v<T> || planes;
    for (int i = 0; mayBeInfinite && i < count; ++i)
    {
      if (!IsFinite({ gradients[0][i], gradients[1][i], gradients[2][i] }))
      {
        Add(i, others);
      }
    }
    return others;
  }

private:
  /// The corners of a cell and their neighbours, x fastest: those that central differences at the
  /// corners need; the others have no defined values.
  using Neighbourhood = double[64];
  static constexpr std::ptrdiff_t Steps[3] = { 1, 4, 16 };
  static constexpr int FirstCorner = 21;
  /// Cells whose samples are copied at once.
  static constexpr int Batch = 16;

  static bool IsFinite(const Vector3& gradient)
  {
    return std::isfinite(gradient[0]) && std::isfinite(gradient[1]) && std::isfinite(gradient[2]);
  }

  /// Whether all corners of a cell have neighbours on both sides.
  bool IsInner(const Index3& cell) const
  {
    const Index3& dimensions = this->TheSamples.GetDimensions();
    const int before = this->TheSamples.GetBefore();
    return cell[0] + before > 0 && cell[1] + before > 0 && cell[2] + before > 0 &&
      cell[0] < dimensions[0] - 2 && cell[1] < dimensions[1] - 2 && cell[2] < dimensions[2] - 2;
  }

  static void AddCell(const void* corner, const Hit& hit, const Index3& cell,
    const UnevenPlanes* planes, InnerCells& cells)
  {
    const int i = cells.Count++;
    cells.First[i] = corner;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cells.Parametric[axis][i] = hit.Parametric[axis];
      if (planes)
      {
        cells.Weights[axis][i] = &planes->GetSlopeWeights(axis, cell[axis]).Below;
      }
    }
  }

  template <typename Sample>
  static void Call(const Kernels& kernels, const InnerCells& cells, const std::ptrdiff_t* strides,
    double (*gradients)[RayPacket::Capacity])
  {
    kernels.InterpolateDifferences[static_cast<std::size_t>(ScalarTypeOf<Sample>())](
      cells, strides, gradients);
  }

  static void Scatter(const double (*found)[RayPacket::Capacity], const int* places, int count,
    double (*gradients)[RayPacket::Capacity])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < count; ++i)
      {
        gradients[axis][places[i]] = found[axis][i];
      }
    }
  }

  /// Copies the samples around a cell. Behind the border of the image they are continued linearly,
  /// so that central differences there are one-sided.
  void Copy(const Index3& cell, Neighbourhood& copy) const
  {
    // From the first corner to the sample before it, to the two corners, and to the one behind.
    std::ptrdiff_t steps[3][4];
    bool hasBefore[3];
    bool hasBehind[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::ptrdiff_t stride = this->TheSamples.GetStrides()[axis];
      hasBefore[axis] = cell[axis] + this->TheSamples.GetBefore() > 0;
      hasBehind[axis] = cell[axis] + 2 < this->TheSamples.GetDimensions()[axis];
      steps[axis][0] = hasBefore[axis] ? -stride : 0;
      steps[axis][1] = 0;
      steps[axis][2] = stride;
      steps[axis][3] = hasBehind[axis] ? 2 * stride : stride;
    }
    const T* first = this->TheSamples.At(cell);
    const auto copyRow = [&](int y, int z, int begin, int end)
    {
      const T* row = first + steps[1][y] + steps[2][z];
      for (int x = begin; x < end; ++x)
      {
        copy[x + 4 * y + 16 * z] = static_cast<double>(row[steps[0][x]]);
      }
    };
    // Neighbours are along one axis: half of the 4^3 samples.
    for (const int inner : { 1, 2 })
    {
      copyRow(inner, 0, 1, 3);
      copyRow(0, inner, 1, 3);
      copyRow(1, inner, 0, 4);
      copyRow(2, inner, 0, 4);
      copyRow(3, inner, 1, 3);
      copyRow(inner, 3, 1, 3);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!hasBefore[axis])
      {
        Continue(axis, 1, -Steps[axis], copy);
      }
      if (!hasBehind[axis])
      {
        Continue(axis, 2, Steps[axis], copy);
      }
    }
  }

  /// Continues samples behind the corners of a cell on one side along an axis.
  static void Continue(
    std::size_t axis, std::ptrdiff_t side, std::ptrdiff_t step, Neighbourhood& copy)
  {
    const std::ptrdiff_t u = Steps[(axis + 1) % 3];
    const std::ptrdiff_t v = Steps[(axis + 2) % 3];
    for (const std::ptrdiff_t across : { u + v, 2 * u + v, u + 2 * v, 2 * u + 2 * v })
    {
      double* corner = copy + side * Steps[axis] + across;
      corner[step] = corner[0] - (corner[-step] - corner[0]);
    }
  }

  /// Central differences at the corners of a cell, interpolated.
  Vector3 InterpolateDifferences(
    const Index3& cell, const Vector3& parametric, const UnevenPlanes* planes) const
  {
    Neighbourhood copy;
    this->Copy(cell, copy);
    Vector3 gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      CellCorners differences;
      for (int corner = 0; corner < 8; ++corner)
      {
        const double* sample =
          copy + FirstCorner + (corner & 1) + 4 * (corner >> 1 & 1) + 16 * (corner >> 2);
        differences[static_cast<std::size_t>(corner)] =
          GetSlope(sample, axis, cell[axis] + (corner >> axis & 1), planes);
      }
      gradient[axis] = Interpolate(differences, parametric);
    }
    return gradient;
  }

  /// The slope at a sample along an axis: the central difference, or its equivalent for uneven
  /// spacing.
  static double GetSlope(
    const double* sample, std::size_t axis, int plane, const UnevenPlanes* planes)
  {
    const double below = sample[-Steps[axis]];
    const double above = sample[Steps[axis]];
    if (!planes)
    {
      return (above - below) * 0.5;
    }
    const UnevenPlanes::SlopeWeights& weights = planes->GetSlopeWeights(axis, plane);
    return weights.Below * (sample[0] - below) + weights.Above * (above - sample[0]);
  }

  Samples<T> TheSamples;
};

}

#endif
