// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LoneRay_h
#define LoneRay_h

#include "Kernels/BeamPieces.h"
#include "Math/Bounds.h"
#include "Mesh/BeamFrame.h"
#include "RandomNumbers.h"
#include "Rays/AppendBoxedRay.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// A ray through a box with some cells, which begins and ends anywhere in it.
struct LoneRay
{
  RayPacket Packet;
  BeamFrame Frame;
  float Begin;
  float End;
  bool HasFrame;

  LoneRay(RandomNumbers& random, const Bounds& box)
  {
    this->Packet.Clear();
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
    const double before = random.Integer(0, 2) == 0 ? random.Uniform(0.0, 100.0) : 0.0;
    AppendBoxedRay(box, random.PointInBox(box.Lower, box.Upper) - direction * before, direction,
      before + begin, before + end, this->Packet);
    this->HasFrame =
      (this->Packet.Exists.Words[0] & 1U) != 0 && this->Frame.FindAlone(this->Packet, 0, box);
    if (this->HasFrame)
    {
      const BeamNumbers& numbers = this->Frame.GetNumbers();
      this->Begin = this->Frame.FindBegin(this->Packet, this->Packet.Exists);
      this->End = static_cast<float>(GetEndDepth(numbers,
        this->Packet.Origin[numbers.Along][0] +
          this->Packet.End[0] * this->Packet.Direction[numbers.Along][0]));
    }
  }

  /// Whether it meets a box, made larger on each side by a part of its size.
  template <typename Box>
  bool Meets(const Box& box, long double part) const
  {
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
        end = low <= 0.0L && 0.0L <= high ? end : -1.0L / 0.0L;
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
