// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellSubdivision.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Whether a corner comes before another one. Of corners at one place the first is first.
bool IsBefore(const MeshCell& cell, int one, int other)
{
  return cell.Points[one] < cell.Points[other] ||
    (cell.Points[one] == cell.Points[other] && one < other);
}

/// The place of the first corner of a face.
int FindFirst(const MeshCell& cell, const CellFace& face)
{
  int first = 0;
  for (int i = 1; i < face.Count; ++i)
  {
    first = IsBefore(cell, face.Corners[i], face.Corners[first]) ? i : first;
  }
  return first;
}

void CopyCorner(const MeshCell& cell, int from, double (&to)[4])
{
  std::copy_n(cell.Points[from].begin(), 3, to);
  to[3] = cell.Values[from];
}

}

//------------------------------------------------------------------------------
int SubdivideCell(const MeshCell& cell, double (*corners)[4][4])
{
  int apex = 0;
  for (int i = 1; i < cell.Count; ++i)
  {
    apex = IsBefore(cell, i, apex) ? i : apex;
  }
  const ShapeTraits& traits = GetTraits(cell.Shape);
  int count = 0;
  for (int i = 0; i < traits.Faces; ++i)
  {
    const CellFace& face = traits.Face[i];
    if (std::find(face.Corners, face.Corners + face.Count, apex) != face.Corners + face.Count)
    {
      continue;
    }
    const int first = FindFirst(cell, face);
    for (int k = 1; k + 1 < face.Count; ++k, ++count)
    {
      CopyCorner(cell, apex, corners[count][0]);
      CopyCorner(cell, face.Corners[first], corners[count][1]);
      CopyCorner(cell, face.Corners[(first + k) % face.Count], corners[count][2]);
      CopyCorner(cell, face.Corners[(first + k + 1) % face.Count], corners[count][3]);
    }
  }
  return count;
}

//------------------------------------------------------------------------------
int SubdivideCell(const MeshCell& cell, const double (*numbers)[MaximumCorners], int count,
  double (*corners)[4][4], std::array<double, 4>* ofCorners)
{
  // The value of a corner is its place in the cell.
  MeshCell placed = cell;
  std::iota(placed.Values, placed.Values + cell.Count, 0.0);
  const int tetrahedra = SubdivideCell(placed, corners);
  for (int i = 0; i < tetrahedra; ++i)
  {
    std::array<double, 4> sorted[4];
    for (int k = 0; k < 4; ++k)
    {
      std::copy_n(corners[i][k], 4, sorted[k].begin());
    }
    std::sort(std::begin(sorted), std::end(sorted));
    for (int k = 0; k < 4; ++k)
    {
      std::copy_n(sorted[k].begin(), 4, corners[i][k]);
      for (int number = 0; number < count; ++number)
      {
        ofCorners[i * count + number][k] = numbers[number][static_cast<int>(sorted[k][3])];
      }
    }
  }
  return tetrahedra;
}

}
