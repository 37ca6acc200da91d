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

  /// Interpolates central differences with a kernel, where there are inner cells. Returns the hits
  /// whose gradients must be found in other ways.
  RaySet InterpolateDifferences(const Hit* hits, const Index3* cellsOfHits, int count,
    const Kernels& kernels, const UnevenPlanes* planes,
    double (*gradients)[RayPacket::Capacity]) const
  {
    RaySet others = {};
    InnerCells cells;
    cells.Count = count;
    cells.AreUneven = planes != nullptr;
    for (int i = 0; i < count; ++i)
    {
      const Hit& hit = hits[i];
      const bool isInner = this->IsInner(cellsOfHits[i]);
      const Index3 cell = isInner ? cellsOfHits[i] : Index3{ 1, 1, 1 };
      cells.First[i] = this->TheSamples.At(cell);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        cells.Parametric[axis][i] = hit.Parametric[axis];
        if (planes)
        {
          cells.Weights[axis][i] = &planes->GetSlopeWeights(axis, cell[axis]).Below;
        }
      }
      const bool isFlat = planes && planes->IsFlat(cell);
      if (!isInner || isFlat || hit.Plane != Hit::NoPlane)
      {
        Add(i, others);
      }
    }
    const auto type = static_cast<std::size_t>(ScalarTypeOf<T>());
    kernels.InterpolateDifferences[type](cells, this->TheSamples.GetStrides(), gradients);
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
  static bool IsFinite(const Vector3& gradient)
  {
    return std::isfinite(gradient[0]) && std::isfinite(gradient[1]) && std::isfinite(gradient[2]);
  }

  /// Central differences at the corners of a cell, interpolated. At the border of the image they
  /// are one-sided.
  Vector3 InterpolateDifferences(
    const Index3& cell, const Vector3& parametric, const UnevenPlanes* planes) const
  {
    // The steps from the first corner to the sample before it, to the two corners, and to the
    // sample behind, if there are such.
    std::ptrdiff_t steps[3][4];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::ptrdiff_t stride = this->TheSamples.GetStrides()[axis];
      const bool hasPrevious = cell[axis] > 0;
      const bool hasNext = cell[axis] + 2 < this->TheSamples.GetDimensions()[axis];
      steps[axis][0] = hasPrevious ? -stride : 0;
      steps[axis][1] = 0;
      steps[axis][2] = stride;
      steps[axis][3] = hasNext ? 2 * stride : stride;
    }
    const T* first = this->TheSamples.At(cell);
    Vector3 gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      CellCorners differences;
      for (std::size_t corner = 0; corner < 8; ++corner)
      {
        const T* sample = first;
        for (const std::size_t other : { (axis + 1) % 3, (axis + 2) % 3 })
        {
          sample += steps[other][1 + (corner >> other & 1)];
        }
        differences[corner] =
          this->GetDifference(sample, cell, axis, corner >> axis & 1, steps[axis], planes);
      }
      gradient[axis] = Interpolate(differences, parametric);
    }
    return gradient;
  }

  /// The slope at one of two corners along an axis, of which the sample is the first: the central
  /// difference, or its equivalent for uneven spacing.
  static double GetDifference(const T* sample, const Index3& cell, std::size_t axis,
    std::size_t corner, const std::ptrdiff_t steps[4], const UnevenPlanes* planes)
  {
    const auto low = static_cast<double>(sample[steps[corner]]);
    const auto high = static_cast<double>(sample[steps[corner + 2]]);
    if (planes)
    {
      const auto middle = static_cast<double>(sample[steps[corner + 1]]);
      const UnevenPlanes::SlopeWeights& weights =
        planes->GetSlopeWeights(axis, cell[axis] + static_cast<int>(corner));
      return weights.Below * (middle - low) + weights.Above * (high - middle);
    }
    const bool isCentral =
      steps[corner] != steps[corner + 1] && steps[corner + 1] != steps[corner + 2];
    return (high - low) * (isCentral ? 0.5 : 1.0);
  }

  Samples<T> TheSamples;
};

}

#endif
