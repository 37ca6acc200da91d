// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PointGradients_h
#define PointGradients_h

#include "Mesh/MeshCells.h"

#include <array>
#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Gradients at the points of a mesh, for normals that are smooth across cells: each is the mean of
/// those of the cells around the point, weighted by their volumes.
class PointGradients
{
public:
  PointGradients() = default;

  /// Gradients are multiplied by the unit, to have a size that a float holds.
  PointGradients(const MeshCells& cells, double unit, int threads);

  bool AreThere() const { return !this->Gradients.empty(); }

  /// The gradient at a point of a cell, interpolated between its corners.
  Vector3 Get(const MeshCell& cell, const Vector3& parametric) const;

  std::size_t GetMemory() const { return this->Gradients.capacity() * sizeof(this->Gradients[0]); }

private:
  double Unit = 1.0;
  std::vector<std::array<float, 3>> Gradients;
};

}

#endif
