// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BeamFrame_h
#define BeamFrame_h

#include "Field/TracedField.h"
#include "Kernels/BeamPieces.h"
#include "Math/Vector.h"
#include "Rays/RayPacket.h"

#include <cmath>
#include <cstddef>

// Rays through one point, and parallel ones, are points of a plane across an axis: the label of a
// ray is where it meets the plane. Their slopes are linear functions of their labels (parallel rays
// have one slope), and so what is in space is projected to labels: the label of a point is that of
// the ray through it.

namespace vtkIsosurfaceRayTracing
{

/// A point in the frame of a beam.
struct BeamPoint
{
  /// Homogeneous: X / W and Y / W is the label. W is 1 in the plane, and 0 where rays meet.
  double X;
  double Y;
  double W;
  /// The distance from the plane along the axis, the way that the rays go.
  double Depth;
};

/// The frame of a beam: the rays between four lines.
class BeamFrame
{
public:
  /// Points with a smaller W are too near to where the rays meet: they may have any label.
  static constexpr double SmallestW = 0x1p-10;

  /// Finds the frame of the rays between lines that pass through one point, or are parallel, as
  /// they go through a box. Of these the labels are in [-1, 1]. Returns false if there is none: the
  /// lines do not go one way along an axis.
  bool Find(const RayPacket& lines, const Bounds& box);

  /// How the boxes of a tree are projected, in single precision.
  BeamProjection GetProjection() const;

  BeamPoint Project(const Vector3& point) const
  {
    const double z = point[this->Along] - this->Plane;
    return { (point[this->Across[0]] - this->Center[0] - this->Slope[0] * z) * this->InverseSize,
      (point[this->Across[1]] - this->Center[1] - this->Slope[1] * z) * this->InverseSize,
      1.0 + this->Spread * z, this->Sign * z };
  }

  /// By how much the labels of rays may be wrong that come as near to the lines as these to one
  /// point.
  float GetMargin() const { return this->Margin; }

  double GetDepth(double coordinate) const { return this->Sign * (coordinate - this->Plane); }
  /// The depth where a ray of a packet ends, and a margin.
  float GetEnd(const RayPacket& packet, int ray, double end) const
  {
    const double depth =
      this->GetDepth(packet.Origin[this->Along][ray] + end * packet.Direction[this->Along][ray]);
    return static_cast<float>(depth + 0x1p-20 * (std::abs(depth) + this->Length));
  }

  /// Finds the label of a ray of a packet. Returns false if the ray is not in the beam.
  bool FindLabel(const RayPacket& packet, int ray, float (&label)[2]) const;

private:
  double GetError(const double (&place)[2], const double (&slope)[2]) const;

  std::size_t Along;
  std::size_t Across[2];
  double Sign;
  /// The coordinate of the plane of labels: where the rays leave the box.
  double Plane;
  /// The extent of the box along the axis.
  double Length;
  /// The largest distance of the box from the centre, across.
  double Reach;
  /// The ray with the label 0: where it meets the plane, and its slopes there.
  double Center[2];
  double Slope[2];
  /// The change of the slope with the place.
  double Spread;
  double InverseSize;
  float Margin;
};

}

#endif
