// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LoneRay_h
#define LoneRay_h

#include "Kernels/BeamPieces.h"
#include "Kernels/Kernels.h"
#include "Math/Bounds.h"
#include "Mesh/BeamFrame.h"
#include "Mesh/RayPencil.h"
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
  BeamFrame Frame;
  float Begin;
  float End;
  bool HasFrame;

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
    const double before = random.Integer(0, 2) == 0 ? random.Uniform(0.0, 100.0) : 0.0;
    this->Set(box, random.PointInBox(box.Lower, box.Upper) - direction * before, direction,
      before + begin, before + end);
  }

  LoneRay(
    const Bounds& box, const Vector3& origin, const Vector3& direction, double begin, double end)
    : Box(box)
  {
    this->Set(box, origin, direction, begin, end);
  }

  /// Puts it into a place, in which it is the ray of the packet with this number, too.
  void Put(int place, LoneRays& rays) const
  {
    rays.Frame[place] = this->Frame.GetNumbers();
    rays.Through[place] = this->GetThrough();
    rays.Place(place, place);
    rays.End[place] = this->End;
  }

  RayThroughBoxes GetThrough() const { return this->Frame.GetRay(this->Begin); }

  /// The pieces of a set that it may meet; a bit for each.
  unsigned int FindPieces(const Kernels& kernels, const PackedPieces& set) const
  {
    LoneRays alone;
    alone.Clear(this->Box);
    this->Put(0, alone);
    MetPieces met;
    kernels.FindPiecesOnRays(
      &set, 0, 1, alone, { RayPencil::GetBounds(alone.Through[0]), 0, 1, this->End }, met);
    return met.Count == 0 ? 0 : met.Pieces[0];
  }

  /// Whether it meets a box, made larger on each side by a part of its size.
  template <typename Box>
  bool Meets(const Box& box, long double part) const
  {
    return this->FindEntry(box, part) <= static_cast<long double>(this->Packet.End[0]);
  }

  /// The t where it enters the box; infinity if it does not meet it.
  template <typename Box>
  long double FindEntry(const Box& box, long double part) const
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
    return begin <= end ? begin : infinity;
  }

private:
  void Set(
    const Bounds& box, const Vector3& origin, const Vector3& direction, double begin, double end)
  {
    this->Packet.Clear();
    AppendBoxedRay(box, origin, direction, begin, end, this->Packet);
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
};

}

#endif
