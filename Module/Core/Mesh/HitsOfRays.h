// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HitsOfRays_h
#define HitsOfRays_h

#include "Rays/Hit.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The hits of the rays of a packet, as they are found: in no order, and those beyond the first
/// opaque one may be there or not.
class HitsOfRays
{
public:
  void Clear()
  {
    this->Found.clear();
    std::fill_n(this->First, RayPacket::Capacity, None);
  }

  /// Adds a hit, to be made there.
  Hit& Add(int ray)
  {
    this->Found.emplace_back();
    this->Found.back().Next = this->First[ray];
    this->First[ray] = static_cast<int>(this->Found.size()) - 1;
    return this->Found.back().TheHit;
  }

  /// Removes the hit that was added last.
  void Remove(int ray)
  {
    this->First[ray] = this->Found.back().Next;
    this->Found.pop_back();
  }

  /// Removes all hits of a ray.
  void RemoveAll(int ray) { this->First[ray] = None; }

  /// Removes the hits of a ray beyond a t.
  void RemoveBeyond(int ray, double t)
  {
    for (int* link = &this->First[ray]; *link != None;)
    {
      FoundHit& found = this->Found[static_cast<std::size_t>(*link)];
      if (found.TheHit.T > t)
      {
        *link = found.Next;
      }
      else
      {
        link = &found.Next;
      }
    }
  }

  /// The hit of a ray that has one alone; else null.
  const Hit* GetOnly(int ray) const
  {
    if (this->First[ray] == None)
    {
      return nullptr;
    }
    const FoundHit& found = this->Found[static_cast<std::size_t>(this->First[ray])];
    return found.Next == None ? &found.TheHit : nullptr;
  }

  /// Appends those of a ray.
  void Get(int ray, std::vector<Hit>& hits) const
  {
    for (int i = this->First[ray]; i != None;)
    {
      const FoundHit& found = this->Found[static_cast<std::size_t>(i)];
      hits.push_back(found.TheHit);
      i = found.Next;
    }
  }

private:
  static constexpr int None = -1;

  struct FoundHit
  {
    Hit TheHit;
    /// Of the same ray, or None.
    int Next;
  };

  std::vector<FoundHit> Found;
  int First[RayPacket::Capacity];
};

}

#endif
