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
    this->Count = 0;
    std::fill_n(this->First, RayPacket::Capacity, None);
  }

  /// Adds a hit, to be made there. What hits in cells do not set has its default.
  Hit& Add(int ray)
  {
    const auto number = static_cast<std::size_t>(this->Count);
    if (number == this->Found.size())
    {
      this->Found.resize(std::max<std::size_t>(RayPacket::Capacity, 2 * number));
    }
    this->Found[number].Next = this->First[ray];
    this->First[ray] = this->Count++;
    return this->Found[number].TheHit;
  }

  /// Removes the hit that was added last.
  void Remove(int ray) { this->First[ray] = this->GetFound(--this->Count).Next; }

  /// Removes all hits of a ray.
  void RemoveAll(int ray) { this->First[ray] = None; }

  /// Removes the hits of a ray beyond a t, but not the last one.
  void RemoveBeyond(int ray, double t)
  {
    int* link = &this->GetFound(this->First[ray]).Next;
    while (*link != None)
    {
      FoundHit& found = this->GetFound(*link);
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

  /// A hit of a ray; null without any.
  const Hit* GetAny(int ray) const
  {
    return this->First[ray] != None ? &this->GetFound(this->First[ray]).TheHit : nullptr;
  }

  bool HasSeveral(int ray) const
  {
    return this->First[ray] != None && this->GetFound(this->First[ray]).Next != None;
  }

  /// Appends those of a ray.
  void Get(int ray, std::vector<Hit>& hits) const
  {
    for (int i = this->First[ray]; i != None;)
    {
      const FoundHit& found = this->GetFound(i);
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

  FoundHit& GetFound(int number) { return this->Found[static_cast<std::size_t>(number)]; }
  const FoundHit& GetFound(int number) const
  {
    return this->Found[static_cast<std::size_t>(number)];
  }

  /// The first ones are in use.
  std::vector<FoundHit> Found;
  int Count = 0;
  int First[RayPacket::Capacity];
};

}

#endif
