// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellSubdivision.h"

#include <algorithm>
#include <array>
#include <iterator>

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

}

//------------------------------------------------------------------------------
int SubdivideCell(const MeshCell& cell, int (*corners)[4])
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
      corners[count][0] = apex;
      corners[count][1] = face.Corners[first];
      corners[count][2] = face.Corners[(first + k) % face.Count];
      corners[count][3] = face.Corners[(first + k + 1) % face.Count];
    }
  }
  return count;
}

//------------------------------------------------------------------------------
int SubdivideCell(const MeshCell& cell, double (*corners)[4][4])
{
  int numbers[MaximumTetrahedra][4];
  const int tetrahedra = SubdivideCell(cell, numbers);
  for (int i = 0; i < tetrahedra; ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      std::copy_n(cell.Points[numbers[i][k]].begin(), 3, corners[i][k]);
      corners[i][k][3] = cell.Values[numbers[i][k]];
    }
  }
  return tetrahedra;
}

//------------------------------------------------------------------------------
int SubdivideCell(const MeshCell& cell, const double (*numbers)[MaximumCorners], int count,
  double (*corners)[4][4], std::array<double, 4>* ofCorners)
{
  int places[MaximumTetrahedra][4];
  const int tetrahedra = SubdivideCell(cell, places);
  for (int i = 0; i < tetrahedra; ++i)
  {
    std::sort(std::begin(places[i]), std::end(places[i]),
      [&cell](int one, int other) { return IsBefore(cell, one, other); });
    for (int k = 0; k < 4; ++k)
    {
      std::copy_n(cell.Points[places[i][k]].begin(), 3, corners[i][k]);
      for (int number = 0; number < count; ++number)
      {
        ofCorners[i * count + number][k] = numbers[number][places[i][k]];
      }
    }
  }
  return tetrahedra;
}

}
