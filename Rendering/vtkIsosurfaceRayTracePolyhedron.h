// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A polyhedron, convex or not, in tetrahedra between its centre and the triangles of its faces.
// Neighbours cut a face in common into the same triangles, also if it is not flat.

#ifndef vtkIsosurfaceRayTracePolyhedron_h
#define vtkIsosurfaceRayTracePolyhedron_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                        // for ivars
#include "vtkType.h"                       // for vtkIdType

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCell;
class vtkIdList;
class vtkPolygon;

class vtkIsosurfaceRayTracePolyhedron
{
public:
  vtkIsosurfaceRayTracePolyhedron();
  ~vtkIsosurfaceRayTracePolyhedron();
  vtkIsosurfaceRayTracePolyhedron(const vtkIsosurfaceRayTracePolyhedron&) = delete;
  void operator=(const vtkIsosurfaceRayTracePolyhedron&) = delete;

  /// Stands for the id of the centre, which is the mean of the points.
  static constexpr vtkIdType Center = -1;

  /// Finds the ids of the corners of the tetrahedra, one after the other. Returns false if they
  /// overlap: the centre does not see all faces from inside.
  bool Divide(vtkCell* cell, vtkIdList* ids);

  /// The volume of these tetrahedra.
  double GetVolume() const { return this->Volume; }

private:
  /// Of a face, and the volume of its tetrahedron: less than 0 if it is seen from the other side.
  struct Triangle
  {
    vtkIdType Get(int corner) const { return this->Corners[corner % 3]; }
    void TurnAgainst(vtkIdType first, vtkIdType second);

    vtkIdType Corners[3];
    double Volume;
  };

  void CopyFace(vtkCell* face);
  void CutFace();
  void AddTriangles(double center[3]);
  void TurnTriangles();

  double Volume = 0.0;
  std::vector<Triangle> Triangles;
  /// A face, as each of its neighbours sees it, and the numbers of the corners of its triangles.
  vtkNew<vtkPolygon> Face;
  vtkNew<vtkIdList> Cut;
};

VTK_ABI_NAMESPACE_END

#endif
