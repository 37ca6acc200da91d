// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What interpolates between the scalars of an image or a mesh, by VTK's own cells.

#ifndef vtkIsosurfaceComparisonInterpolant_h
#define vtkIsosurfaceComparisonInterpolant_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <array>
#include <memory>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{

/// Of the active scalars. It is at one place at a time.
class Interpolant
{
public:
  using Vector = std::array<double, 3>;

  /// A point on an edge of a cell where the interpolant, which is linear there, has a value; and
  /// its gradient.
  struct EdgeCrossing
  {
    Vector Point;
    Vector Gradient;
  };

  /// Of a vtkImageData (trilinear), or else of the cells of a mesh.
  static std::unique_ptr<Interpolant> New(vtkDataSet* data);
  virtual ~Interpolant() = default;

  /// Goes to a point. One outside of an image is moved to the border, as is one that rounding has
  /// put outside of a mesh. Returns false if there is no cell.
  virtual bool GoTo(Vector& point) = 0;

  // Of the place it is at, in the world:
  virtual double GetValue() const = 0;
  virtual Vector GetGradient() const = 0;
  /// The length of a vector in cells.
  virtual double GetLengthInCells(const Vector& vector) const = 0;
  /// Those of the edges around.
  virtual std::vector<EdgeCrossing> FindEdgeCrossings(double isovalue) = 0;
};

}

#endif
