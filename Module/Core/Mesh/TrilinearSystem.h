// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearSystem_h
#define TrilinearSystem_h

#include "Math/TrilinearCell.h"
#include "Math/Vector.h"

#include <array>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Three trilinear functions of the coordinates of a cell, [0, 1]^3: two that vanish on a ray (the
/// coordinates across it), and one that vanishes on an isosurface (the value minus the isovalue).
struct TrilinearSystem
{
  CellCorners Functions[3];

  /// The gradients of the three at a point of the cell.
  std::array<Vector3, 3> GetJacobian(const Vector3& point) const
  {
    return { InterpolantGradient(this->Functions[0], point),
      InterpolantGradient(this->Functions[1], point),
      InterpolantGradient(this->Functions[2], point) };
  }

  /// Finds the points of the cell where all three vanish.
  ///
  /// A trilinear function is within the hull of its corners, in every box of the cell. A box whose
  /// corners are all on one side, for one of the functions, has no solution. Any other is
  /// contracted: multiplied by the inverse Jacobian of the middle, each function is nearly one
  /// coordinate, and vanishes only where its hull does. A box that does not shrink so is bisected.
  /// So no solution is missed that rounding leaves.
  /// (T. Martin, E. Cohen, R. M. Kirby: Direct Isosurface Visualization of Hex-Based High-Order
  /// Geometry and Attribute Representations, IEEE TVCG 18(5), 2012, have the idea for splines.)
  void Solve(std::vector<Vector3>& solutions) const;
};

}

#endif
