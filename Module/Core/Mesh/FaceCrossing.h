// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FaceCrossing_h
#define FaceCrossing_h

#include "Mesh/MeshCell.h"
#include "Rays/RayFrame.h"

namespace vtkIsosurfaceRayTracing
{

/// Where a ray crosses a face of a cell: a function of the ray and the face alone, and so the same
/// for both cells of the face.
struct FaceCrossing
{
  int Count;
  /// The corners of the face, as numbers within the cell, and their weights: not negative, with the
  /// sum one.
  int Corners[MaximumFaceCorners];
  double Weights[MaximumFaceCorners];
  double T;
  /// Whether the ray enters the cell there, by the orientation of the face.
  bool Entering;

  /// The interpolant there of differences between the values at the corners and an isovalue. It is
  /// not negative if none of them is, and negative if all are.
  double Interpolate(const double* differences) const
  {
    double sum = 0.0;
    for (int i = 0; i < this->Count; ++i)
    {
      sum += this->Weights[i] * differences[this->Corners[i]];
    }
    return sum;
  }
};

/// The crossings of the faces of a cell by a ray, in order. A ray crosses a cell's surface
/// an even number of times. A twisted quadrangle may be crossed twice.
struct FaceCrossings
{
  int Count = 0;
  FaceCrossing Crossings[2 * MaximumFaces];

  /// Whether the ray enters and leaves the cell in turn: then it is inside between the first and
  /// the second crossing, the third and the fourth, and so on.
  bool AreSegments() const
  {
    bool areSegments = this->Count % 2 == 0; // Numbers that overflow may cross a face too few.
    for (int i = 0; i < this->Count; ++i)
    {
      areSegments = areSegments && this->Crossings[i].Entering == (i % 2 == 0);
    }
    return areSegments;
  }

  /// Finds them, given the corners of the cell in the frame of the ray.
  void Find(const MeshCell& cell, const FramePoint* points);

private:
  struct OrderedFace;

  void AddTriangle(const OrderedFace& face, const FramePoint* points);
  void AddQuadrangle(const OrderedFace& face, const FramePoint* points);
  void Add(const OrderedFace& face, const double* weights, bool isLeft, const FramePoint* points);
  void PutInOrder();
};

}

#endif
