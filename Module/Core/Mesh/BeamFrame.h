// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BeamFrame_h
#define BeamFrame_h

#include "Field/TracedField.h"
#include "Kernels/BeamPieces.h"
#include "Rays/RayPacket.h"

// Rays through one point, and parallel ones, are points of a plane across an axis: the label of a
// ray is where it meets the plane. Their slopes are linear functions of their labels (parallel rays
// have one slope), and so what is in space is projected to labels: the label of a point is that of
// the ray through it. It is X / W and Y / W in homogeneous coordinates: W is 1 in the plane, and 0
// where rays meet. The depth is the distance from the plane along the axis, the way the rays go.

namespace vtkIsosurfaceRayTracing
{

/// Whether products of coordinates in a box neither overflow nor vanish in single precision.
bool IsSinglePrecision(const Bounds& box);

/// The frame of a beam: the rays between four lines.
class BeamFrame
{
public:
  /// Finds the frame of the rays between some lines, two at least, that pass through one point, or
  /// are parallel, as they go through a box. Of these the labels are in [-1, 1]. Returns false if
  /// there is none: the lines do neither, or do not go one way along an axis.
  bool Find(const RayPacket& lines, const RaySet& some, const Bounds& box);

  /// Finds that of one line, which has the label 0. Returns false if it goes nowhere, or rounding
  /// does not allow it.
  bool FindAlone(const RayPacket& lines, int line, const Bounds& box);

  /// How the boxes of a tree are projected, in single precision.
  BeamProjection GetProjection() const;

  const BeamNumbers& GetNumbers() const { return this->Numbers; }

  /// The larger extent of the beam in the plane of labels.
  double GetWidth() const { return 2.0 / this->Numbers.InverseSize; }

  /// The depth where the first of some rays begins, and a margin.
  float FindBegin(const RayPacket& rays, const RaySet& some) const;

  /// Whether points in the beam have labels, from a depth to the plane of the frame.
  bool HasLabelsFrom(float depth) const;

  /// The bounds of the labels between lines, and a margin.
  void FindBounds(const RayPacket& lines, float (&lower)[2], float (&upper)[2]) const;

private:
  void SetAxes(const Vector3& direction, const Bounds& box);
  void SetReach(const Bounds& box);
  double SetSize(double size);
  bool SetMargin(double error, const Bounds& box);

  BeamNumbers Numbers;
  /// The largest distance of the box from the centre, across.
  double Reach;
};

}

#endif
