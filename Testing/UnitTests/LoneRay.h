// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LoneRay_h
#define LoneRay_h

#include "Kernels/Kernels.h"
#include "Kernels/ScatteredRays.h"
#include "Math/Bounds.h"
#include "RandomNumbers.h"
#include "Rays/AppendBoxedRay.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// A ray through a box with some cells, which begins and ends anywhere in it.
struct LoneRay
{
  Bounds Box;
  RayPacket Packet;

  LoneRay(RandomNumbers& random, const Bounds& box)
    : Box(box)
  {
    const double begin = random.Uniform(-0.5, 0.5);
    const double end = begin + random.Uniform(0.1, 2.0);
    Vector3 direction = random.Direction();
    const int kind = random.Integer(0, 5);
    if (kind < 2)
    {
      // Along the plane of two axes, or nearly so.
      direction[static_cast<std::size_t>(random.Integer(0, 2))] *=
        kind == 0 ? 0.0 : std::pow(10.0, random.Uniform(-12.0, 0.0));
    }
    direction = Normalized(direction) * Length(box.Upper - box.Lower);
    const double before =
      random.Integer(0, 2) == 0 ? std::pow(10.0, random.Uniform(-1.0, 6.0)) : 0.0;
    this->Packet.Clear();
    AppendBoxedRay(box, random.PointInBox(box.Lower, box.Upper) - direction * before, direction,
      before + begin, before + end, this->Packet);
  }

  /// Whether it meets the box.
  bool Exists() const { return Has(this->Packet.Exists, 0); }

  /// As it comes to boxes and polygons.
  ScatteredRays Scatter(const Kernels& kernels) const
  {
    ScatteredRays rays;
    kernels.ScatterRays(this->Packet, this->Box.Lower.data(), this->Box.Upper.data(), rays);
    rays.SetEnd(0, this->Packet.End[0]);
    return rays;
  }

  /// The pieces of a set that it may meet; a bit for each.
  unsigned int FindPieces(const Kernels& kernels, const PackedPieces& set) const
  {
    unsigned int pieces;
    return kernels.FindPiecesOnRay(&set, 0, 1, this->Scatter(kernels), 0, pieces) == 0 ? pieces : 0;
  }

  /// Whether it meets a box, made larger on each side by a part of its size.
  template <typename Box>
  bool Meets(const Box& box, long double part) const
  {
    constexpr long double infinity = std::numeric_limits<long double>::infinity();
    long double begin = this->Packet.Begin[0];
    long double end = this->Packet.End[0];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const long double room = part *
        (static_cast<long double>(box.Upper[axis]) - static_cast<long double>(box.Lower[axis]));
      const long double origin = this->Packet.Origin[axis][0];
      const long double direction = this->Packet.Direction[axis][0];
      const long double low = static_cast<long double>(box.Lower[axis]) - room - origin;
      const long double high = static_cast<long double>(box.Upper[axis]) + room - origin;
      if (direction == 0.0L)
      {
        end = low <= 0.0L && 0.0L <= high ? end : -infinity;
        continue;
      }
      begin = std::max(begin, std::min(low / direction, high / direction));
      end = std::min(end, std::max(low / direction, high / direction));
    }
    return begin <= end;
  }
};

}

#endif
