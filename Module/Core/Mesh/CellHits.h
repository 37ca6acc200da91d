// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellHits_h
#define CellHits_h

#include "Mesh/FaceCrossing.h"
#include "Mesh/MeshCell.h"
#include "Mesh/TrilinearSystem.h"
#include "Rays/RayFrame.h"
#include "Rays/TrilinearSearch.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Where a ray meets an isosurface in a cell.
struct CellHit
{
  double T;
  /// VTK's parametric coordinates of the cell.
  Vector3 Parametric;
  bool Entering;
};

/// One of the solutions in a cell of a shape.
CellHit MakeCellHit(CellShape shape, const TrilinearSolutions& solutions, int number);

/// The point where a ray crosses a face of a cell of a shape, in VTK's parametric coordinates.
Vector3 GetParametric(CellShape shape, const FaceCrossing& crossing);

/// Finds the hits of rays with the isosurfaces in cells, one after the other.
///
/// A ray is inside or outside of a surface where it crosses a face, the same for both cells of the
/// face. Between its crossings of a cell it has an odd number of hits if and only if it is inside
/// at one of them alone. So along the ray the hits are as many as these signs ask for, whatever
/// rounding does to those next to a face: none is lost between two cells, and none is found in
/// both. Where all is clear of rounding, the faces need not be asked: see TrilinearHits.
class CellHits
{
public:
  /// Begins with a ray and a cell.
  void Enter(const RayFrame& frame, const MeshCell& cell);

  /// Where the ray crosses the faces of the cell, in order.
  const FaceCrossings& FindCrossings();
  /// How many crossings belong together: between the first and the last of them the ray is in the
  /// cell.
  int GetStep() const;

  /// Finds the hits with an isosurface, in order. The differences are those between the values at
  /// the corners and the isovalue: see Difference.
  const std::vector<CellHit>& Find(const double* differences);
  /// The same in a trilinear cell, given what TrilinearSearch found there.
  const std::vector<CellHit>& Find(const double* differences, const TrilinearSolutions& found);

private:
  double GetExtent() const;
  void AvoidExtremes();
  void FindOfTetrahedron(const double* differences);
  TrilinearSolutions FindSolutions(const double* differences) const;
  void FindBetweenFaces(const double* differences, const TrilinearSolutions& found);
  bool FindCandidates(const double* differences, const TrilinearSolutions& found);
  /// Whether t is between such crossings.
  bool IsInSegment(double t) const;
  void MatchParity(const FaceCrossing* crossings, int count, const double* differences,
    std::vector<CellHit>& hits) const;
  bool MoveToPiece(const double* differences, double& t) const;
  void FindBoundsOfPiece(
    const double* differences, std::size_t axis, double& lower, double& upper) const;
  CellHit MakeHitOnFace(const FaceCrossing& crossing) const;
  CellHit MakeHit(const Vector3& trilinear, const TrilinearSystem& system) const;

  const RayFrame* Frame = nullptr;
  const MeshCell* Cell = nullptr;
  FramePoint Points[MaximumCorners];
  FaceCrossings Faces;
  /// What rounding may move hits by.
  double SlackOfT;
  std::vector<CellHit> Hits;
  std::vector<Vector3> Solutions;
  /// The solutions that may be hits: all of them, and those between two crossings.
  std::vector<CellHit> Candidates;
  std::vector<CellHit> Segment;
};

}

#endif
