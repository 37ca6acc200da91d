// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A polyhedron, convex or not, in tetrahedra between its centre and the triangles of its faces.
// Neighbours cut a face in common into the same triangles, also if it is not flat: from its first
// point (by x, then y, then z) as SubdivideCell does; a face of which that does not see all, as
// vtkPolygon::EarCutTriangulation does.

#ifndef vtkIsosurfaceRayTracePolyhedron_h
#define vtkIsosurfaceRayTracePolyhedron_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                        // for ivars
#include "vtkType.h"                       // for vtkIdType

#include "Math/Vector.h"

#include <cstddef> // for std::size_t
#include <vector>  // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIdList;
class vtkPoints;
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

  /// Finds the ids of the corners of the tetrahedra, one after the other, given the points of the
  /// mesh, the ids of those of the cell, and its faces as in vtkUnstructuredGrid::GetFaceStream,
  /// each of at least three points. Returns false if they overlap by more than a hundredth of
  /// their volume: the centre does not see all faces from inside.
  bool Divide(vtkPoints* points, vtkIdList* ofCell, vtkIdList* faces, vtkIdList* ids);

  /// The volume of these tetrahedra.
  double GetVolume() const { return this->Volume; }

private:
  using Vector3 = vtkIsosurfaceRayTracing::Vector3;

  /// Of a face, running as its outline does, and the volume of its tetrahedron: less than 0 if it
  /// is seen from the other side.
  struct Triangle
  {
    vtkIdType Corners[3];
    double Volume;
    std::size_t Face;
  };

  /// The numbers of the edges of a face. The sign is less than 0 if it must be turned, to run as
  /// the others.
  struct Outline
  {
    std::size_t FirstEdge;
    std::size_t LastEdge;
    double Sign = 1.0;
  };

  /// An edge of an outline: its lesser id, and its greater one.
  struct Edge
  {
    bool operator<(const Edge& other) const
    {
      return this->Less != other.Less ? this->Less < other.Less : this->Greater < other.Greater;
    }
    bool IsSame(const Edge& other) const
    {
      return this->Less == other.Less && this->Greater == other.Greater;
    }

    vtkIdType Less;
    vtkIdType Greater;
    std::size_t Number;
  };

  /// Where an edge begins, and whose it is.
  struct EdgeOfFace
  {
    vtkIdType Begin;
    std::size_t Face;
  };

  /// A point of a face.
  struct Corner
  {
    Vector3 Place;
    vtkIdType Id;
  };

  void LoadFace(vtkPoints* points, const vtkIdType* ids, std::size_t count);
  void AddOutline();
  bool IsSeenFromFirst() const;
  void CutFace(const Vector3& center);
  bool CutEars(const Vector3& center);
  void AddTriangle(const Vector3& center, std::size_t a, std::size_t b, std::size_t c);
  void SortEdges();
  void TurnFaces();
  void TurnAgainst(std::size_t one, std::size_t edge);

  double Volume = 0.0;
  std::vector<Triangle> Triangles;
  std::vector<Outline> Outlines;
  std::vector<Edge> Edges;
  /// By numbers.
  std::vector<EdgeOfFace> Faces;
  /// By numbers, the next edge that is the same; after the last one, the first.
  std::vector<std::size_t> NextOfEdge;
  /// Whether the signs of faces are known, and those whose neighbours are to be looked at.
  std::vector<bool> AreKnown;
  std::vector<std::size_t> Waiting;
  /// A face, as each of its neighbours sees it.
  std::vector<Corner> Face;
  vtkNew<vtkPolygon> Polygon;
  vtkNew<vtkIdList> Cut;
};

VTK_ABI_NAMESPACE_END

#endif
