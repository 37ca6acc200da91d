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

  /// Whether all corners of a cell have neighbours on both sides.
  bool IsInner(const Index3& cell) const
  {
    const Index3& dimensions = this->TheSamples.GetDimensions();
    return cell[0] > 0 && cell[1] > 0 && cell[2] > 0 && cell[0] < dimensions[0] - 2 &&
      cell[1] < dimensions[1] - 2 && cell[2] < dimensions[2] - 2;
  }

  /// Interpolates central differences with a kernel, where planes are even and there are inner
  /// cells. Returns the hits whose gradients must be found in other ways.
  RaySet InterpolateDifferences(const Hit* hits, const Index3* cellsOfHits, int count,
    const Kernels& kernels, double (*gradients)[RayPacket::Capacity]) const
  {
    RaySet others = {};
    InnerCells cells;
    cells.Count = count;
    for (int i = 0; i < count; ++i)
    {
      const Hit& hit = hits[i];
      const bool isInner = this->IsInner(cellsOfHits[i]);
      cells.First[i] = this->TheSamples.At(isInner ? cellsOfHits[i] : Index3{ 1, 1, 1 });
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        cells.Parametric[axis][i] = hit.Parametric[axis];
      }
      if (!isInner || hit.Plane != Hit::NoPlane)
      {
        Add(i, others);
      }
    }
    const auto type = static_cast<std::size_t>(ScalarTypeOf<T>());
    kernels.InterpolateDifferences[type](cells, this->TheSamples.GetStrides(), gradients);
    for (int i = 0; std::is_floating_point_v<T> && i < count; ++i)
    {
      if (!IsFinite({ gradients[0][i], gradients[1][i], gradients[2][i] }))
      {
        Add(i, others);
      }
    }
    return others;
  }

private:
  static bool IsFinite(const Vector3& gradient)
  {
    return std::isfinite(gradient[0]) && std::isfinite(gradient[1]) && std::isfinite(gradient[2]);
  }

  /// Central differences at the corners of a cell, interpolated.
  Vector3 InterpolateDifferences(
    const Index3& cell, const Vector3& parametric, const UnevenPlanes* planes) const
  {
    Vector3 gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      CellCorners differences;
      for (int corner = 0; corner < 8; ++corner)
      {
        differences[static_cast<std::size_t>(corner)] = this->GetDifference(
          { cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2) }, axis,
          planes);
      }
      gradient[axis] = Interpolate(differences, parametric);
    }
    return gradient;
  }

  /// The slope at a sample: the central difference, or its equivalent for uneven spacing; at the
  /// border of the image, the one-sided difference.
  double GetDifference(Index3 sample, std::size_t axis, const UnevenPlanes* planes) const
  {
    const int index = sample[axis];
    const int next = std::min(index + 1, this->TheSamples.GetDimensions()[axis] - 1);
    const int previous = std::max(index - 1, 0);
    sample[axis] = next;
    const auto high = static_cast<double>(*this->TheSamples.At(sample));
    sample[axis] = previous;
    const auto low = static_cast<double>(*this->TheSamples.At(sample));
    if (planes)
    {
      sample[axis] = index;
      const auto middle = static_cast<double>(*this->TheSamples.At(sample));
      const UnevenPlanes::SlopeWeights& weights = planes->GetSlopeWeights(axis, index);
      return weights.Below * (middle - low) + weights.Above * (high - middle);
    }
    return (high - low) / (next - previous);
  }

  Samples<T> TheSamples;
};

}

#endif
