// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PacketInSet_h
#define PacketInSet_h

#include "Field/SetMembers.h"
#include "Rays/RayHits.h"
#include "Rays/RayPacket.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A packet of rays that goes through the members of a set: where its rays end, and what they hit
/// of all members.
class PacketInSet
{
public:
  /// Both must outlive the tracing of the packet.
  void Begin(RayPacket& rays, RayHits& hits);

  const RayPacket& GetRays() const { return *this->Rays; }

  /// The greatest T that a ray ends at, on the rays as they were given: after Begin and FindEnd.
  double GetEnd() const { return this->End; }
  void FindEnd();

  /// Takes a hit of a ray with a member, where the ray ends if it is opaque: returns whether it is.
  /// Behind it, rays go on for a reach, in the object space of the set.
  bool Take(
    const Hit& hitOfMember, std::size_t number, int ray, const SetMembers& members, double reach);

  /// Puts the hits of each ray in order, in the hits of Begin.
  void Join(const TracedField& set, const SetMembers& members);

private:
  RayPacket* Rays;
  RayHits* Hits;
  /// The T that each ray ends at, on the ray as it was given, and the greatest of them.
  alignas(64) double Ends[RayPacket::Capacity];
  double End;
  /// The hits of each ray with all members so far.
  std::vector<Hit> Found[RayPacket::Capacity];
};

}

#endif
