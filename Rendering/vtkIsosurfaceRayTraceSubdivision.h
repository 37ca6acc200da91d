// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Cells of a type that is not traced, in parts that are: the tetrahedra of vtkCell::Triangulate, if
// they fill the cell. Those of VTK 9.1 do not fill VTK_TRIQUADRATIC_HEXAHEDRON and some others.
// These are divided as VTK contours them, into hexahedra or wedges between neighbouring points;
// where a point in the middle is missing, and VTK_CONVEX_POINT_SET, into the tetrahedra of
// vtkOrderedTriangulator, which vtkDataSetTriangleFilter makes.

#ifndef vtkIsosurfaceRayTraceSubdivision_h
#define vtkIsosurfaceRayTraceSubdivision_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                        // for ivars
#include "vtkType.h"                       // for vtkIdType

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCell;
class vtkIdList;
class vtkOrderedTriangulator;
class vtkPoints;

class vtkIsosurfaceRayTraceSubdivision
{
public:
  explicit vtkIsosurfaceRayTraceSubdivision(int type);
  ~vtkIsosurfaceRayTraceSubdivision();
  vtkIsosurfaceRayTraceSubdivision(const vtkIsosurfaceRayTraceSubdivision&) = delete;
  void operator=(const vtkIsosurfaceRayTraceSubdivision&) = delete;

  /// Whether cells have three dimensions. Others have no parts.
  bool IsSolid() const { return this->HasVolume; }

  /// Whether a cell may have so many points.
  bool MayHave(vtkIdType points) const { return this->Points == 0 || this->Points == points; }

  /// Finds the ids of the points of the parts of a cell, one part after the other.
  void FindParts(vtkCell* cell, vtkIdList* ids);

  /// The type of parts, and how many points each has.
  int GetPartType() const { return this->PartType; }
  vtkIdType GetPartSize() const { return this->PartSize; }

private:
  void ChooseWay(vtkCell* reference);
  void TriangulatePoints(vtkCell* cell, vtkIdList* ids);

  bool HasVolume = false;
  /// Zero if not all cells have the same number.
  vtkIdType Points = 0;
  int PartType;
  vtkIdType PartSize = 4;
  bool IsTriangulatedByPoints = false;
  /// The points of hexahedra or wedges.
  std::vector<vtkIdType> Parts;
  vtkNew<vtkOrderedTriangulator> Triangulator;
  vtkNew<vtkPoints> Corners;
};

VTK_ABI_NAMESPACE_END

#endif
