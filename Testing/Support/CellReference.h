// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellReference_h
#define CellReference_h

#include "Image/Cells/CellSegment.h"
#include "Image/Cells/Solvers/RobustSolver.h"
#include "Image/Traversal/CellTraversal.h"
#include "Kernels/Kernels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

// The reference for the kernels: the cells that a ray passes, and its roots in them.

namespace vtkIsosurfaceRayTracing
{

inline RayPacket EmptyPacket()
{
  RayPacket packet;
  packet.Count = 0;
  packet.Exists = {};
  return packet;
}

/// In the order of the ray, as the traversal from cell to cell visits them.
inline std::vector<Index3> CellsOnRay(const Ray& ray, const Index3& dimensions)
{
  std::vector<Index3> cells;
  TraverseCells(ray, ActiveMacrocells(MacrocellLattice(dimensions, {})),
    [&cells](const Index3& cell)
    {
      cells.push_back(cell);
      return false;
    });
  return cells;
}

/// Subtracts the isovalue as ImageField does: a difference that is not zero never vanishes.
inline CellCorners Differences(const CellCorners& corners, const ScaledIsovalue& isovalue)
{
  CellCorners differences;
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    const double value = corners[corner];
    const double plain = value * isovalue.Scale - isovalue.Isovalue * isovalue.Scale;
    const double sign = (value > isovalue.Isovalue) - (value < isovalue.Isovalue);
    differences[corner] = std::abs(plain) < SmallestDifference ? sign * SmallestDifference : plain;
  }
  return differences;
}

/// The first root in a cell, and whether there are more.
struct FirstRoot
{
  Crossing Begin;
  double T;
  Vector3 Parametric;
  bool Entering;
  bool IsOnly;
};

using MaybeRoot = std::optional<FirstRoot>;

/// The result of the reference.
inline MaybeRoot ExpectRoot(const Ray& ray, const Index3& cell, const CellCorners& differences)
{
  CellSegment segment;
  MaybeRoot root;
  if (!SegmentInCell(ray, cell, segment))
  {
    return root;
  }
  Robust::ForEachRoot(differences, segment,
    [&](double u, bool entering)
    {
      if (root)
      {
        root->IsOnly = false;
        return true;
      }
      const double t = segment.Begin + (segment.End - segment.Begin) * u;
      root = FirstRoot{ { segment.Begin, segment.BeginAxis }, ray.Base + std::min(t, segment.End),
        {}, entering, true };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        root->Parametric[axis] = Lerp(segment.Entry[axis], segment.Exit[axis], u);
      }
      return false;
    });
  return root;
}

}

#endif
