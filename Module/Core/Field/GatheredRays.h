// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef GatheredRays_h
#define GatheredRays_h

#include "Math/Compiler.h"
#include "Rays/RayPacket.h"
#include "Rays/RaysInBox.h"

namespace vtkIsosurfaceRayTracing
{

/// Parts of rays of several packets, as a packet of their own: few rays of each may meet the same
/// box.
struct GatheredRays
{
  RayPacket Rays;
  /// All of the rays.
  RaysInBox Parts;
  /// Which packet each ray is of, and its number there.
  int Packet[RayPacket::Capacity];
  int Place[RayPacket::Capacity];

  void Clear()
  {
    this->Rays.Clear();
    this->Parts.Rays = {};
  }

  bool HasRoomFor(int count) const { return this->Rays.Count + count <= RayPacket::Capacity; }

  /// Adds the parts of the rays of a packet that are in a box. There must be room.
  void Add(int packet, const RayPacket& rays, const RaysInBox& inside)
  {
    for (int word = 0; word < 2; ++word)
    {
      for (std::uint64_t bits = inside.Rays.Words[word]; bits != 0; bits &= bits - 1)
      {
        this->Add(packet, rays, inside, 64 * word + LowestBit(bits));
      }
    }
  }

private:
  void Add(int packet, const RayPacket& rays, const RaysInBox& inside, int ray)
  {
    const int last = this->Rays.Count++;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Rays.Origin[axis][last] = rays.Origin[axis][ray];
      this->Rays.Direction[axis][last] = rays.Direction[axis][ray];
    }
    vtkIsosurfaceRayTracing::Add(last, this->Parts.Rays);
    this->Parts.Begin[last] = inside.Begin[ray];
    this->Parts.End[last] = inside.End[ray];
    this->Packet[last] = packet;
    this->Place[last] = ray;
  }
};

}

#endif
