// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ShapeFunctions_h
#define ShapeFunctions_h

#include "Mesh/MeshCell.h"

namespace vtkIsosurfaceRayTracing
{

/// The weights of the corners of a cell at a point, or their derivatives.
using CornerWeights = double[MaximumCorners];

/// The weights at a point in VTK's parametric coordinates of the shape.
void GetWeights(CellShape shape, const Vector3& parametric, CornerWeights& weights);

/// Their derivatives by the three coordinates.
void GetWeightDerivatives(
  CellShape shape, const Vector3& parametric, CornerWeights (&derivatives)[3]);

/// The point with these weights.
Vector3 GetParametric(CellShape shape, const CornerWeights& weights);

/// A point given in coordinates of the trilinear cell.
Vector3 GetParametric(CellShape shape, const Vector3& trilinear);

Vector3 GetPoint(const MeshCell& cell, const Vector3& parametric);

/// The same, given the weights of the corners.
inline Vector3 GetWeightedPoint(const MeshCell& cell, const CornerWeights& weights)
{
  Vector3 point = {};
  for (int i = 0; i < cell.Count; ++i)
  {
    point = point + cell.Points[i] * weights[i];
  }
  return point;
}

/// Finds the gradient of the interpolant of the values. Returns false where the cell is flat, or it
/// is infinite: there it is set to zero.
bool FindGradient(const MeshCell& cell, const Vector3& parametric, Vector3& gradient);

/// The same; where it is infinite, its direction. In a flat cell that is across its plane, to the
/// side that the order of its corners tells. Zero if it has none.
Vector3 GetGradient(const MeshCell& cell, const Vector3& parametric);

/// The volume of a cell, about: by its edges in the middle. Never negative.
double GetVolume(const MeshCell& cell);

}

#endif
