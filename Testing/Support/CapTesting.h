// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CapTesting_h
#define CapTesting_h

#include "Rays/Visibility.h"
#include "SameBits.h"
#include "TraceLine.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A half-space with caps that ends in a point of its plane.
inline HalfSpace Behind(const Vector3& normal, const Vector3& point)
{
  return { normal, -Dot(normal, point), true };
}

/// Half-spaces that leave something of a volume: oblique, or along lattice planes.
inline std::vector<HalfSpace> RandomHalfSpaces(RandomNumbers& random, const Index3& size)
{
  std::vector<HalfSpace> halves;
  for (int count = random.Integer(1, 4); count > 0; --count)
  {
    const bool isInLattice = random.Integer(0, 1) == 0;
    Vector3 normal = random.Direction();
    Vector3 point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = random.Integer(size[axis] / 3, size[axis] - size[axis] / 3);
    }
    if (isInLattice)
    {
      normal = { 0.0, 0.0, 0.0 };
      normal[static_cast<std::size_t>(random.Integer(0, 2))] = random.Integer(0, 1) == 0 ? -1 : 1;
    }
    halves.push_back(Behind(normal, point));
  }
  return halves;
}

/// A letter for each hit with one of two surfaces, skin and bone; capital for caps.
inline std::string NameHits(const std::vector<Hit>& hits)
{
  std::string names;
  for (const Hit& hit : hits)
  {
    names +=
      hit.Plane == Hit::NoPlane ? (hit.Surface == 0 ? 's' : 'b') : (hit.Surface == 0 ? 'S' : 'B');
  }
  return names;
}

/// Counts the rays, among many through a volume, whose entries and exits do not alternate, or which
/// enter and never leave, or which meet another cap or hit first with surfaces that are opaque.
/// Adds up the caps. Select(halves, opacity) sets them, and returns the field.
template <typename Select>
int CountLeakingRays(const Index3& size, int scenes, int& caps, const Select& select)
{
  RandomNumbers random(77);
  int leaks = 0;
  for (int scene = 0; scene < scenes; ++scene)
  {
    const std::vector<HalfSpace> halves = RandomHalfSpaces(random, size);
    TracedField& opaque = select(halves, 1.0);
    TracedField& traced = select(halves, Glass);
    for (int ray = 0; ray < 500; ++ray)
    {
      Line line = ray % 2 == 0 ? RandomLine(random, size) : LatticeLine(random, size);
      line.Origin = line.Origin - line.Direction * 64.0; // from without
      const std::vector<Hit> hits = Trace(traced, line);
      const std::vector<Hit> first = Trace(opaque, line);
      bool isInTurn = hits.size() % 2 == 0;
      for (std::size_t i = 0; i < hits.size(); ++i)
      {
        isInTurn = isInTurn && hits[i].Entering == (i % 2 == 0);
        caps += hits[i].Plane != Hit::NoPlane ? 1 : 0;
      }
      const bool isFirst = first.size() == std::min<std::size_t>(1, hits.size()) &&
        (first.empty() || AreSame(first[0], hits[0]));
      leaks += isInTurn && isFirst ? 0 : 1;
    }
  }
  return leaks;
}

}

#endif
