// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayPacket_h
#define RayPacket_h

#include "Math/Compiler.h"
#include "Math/Vector.h"

#include <cstddef>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Some of up to 128 rays.
struct RaySet
{
  std::uint64_t Words[2];
};

inline bool Has(const RaySet& set, int ray)
{
  return (set.Words[ray / 64] >> (ray % 64) & 1) != 0;
}

inline void Add(int ray, RaySet& set)
{
  set.Words[ray / 64] |= std::uint64_t{ 1 } << (ray % 64);
}

inline void Remove(int ray, RaySet& set)
{
  set.Words[ray / 64] &= ~(std::uint64_t{ 1 } << (ray % 64));
}

/// Those of a set that are not in another one.
inline RaySet Without(const RaySet& set, const RaySet& other)
{
  return { { set.Words[0] & ~other.Words[0], set.Words[1] & ~other.Words[1] } };
}

/// Those of both sets.
inline RaySet Unite(const RaySet& set, const RaySet& other)
{
  return { { set.Words[0] | other.Words[0], set.Words[1] | other.Words[1] } };
}

/// Calls visit(ray) for those in a set.
template <typename Visit>
void ForEachRay(const RaySet& set, const Visit& visit)
{
  for (int word = 0; word < 2; ++word)
  {
    for (std::uint64_t rays = set.Words[word]; rays != 0; rays &= rays - 1)
    {
      visit(64 * word + LowestBit(rays));
    }
  }
}

inline bool IsEmpty(const RaySet& set)
{
  return (set.Words[0] | set.Words[1]) == 0;
}

inline int CountOf(const RaySet& set)
{
  return CountBits(set.Words[0]) + CountBits(set.Words[1]);
}

/// Rays that are traced side by side, in arrays.
struct RayPacket
{
  static constexpr int Capacity = 128;

  int Count;
  /// If the rays are those of the pixels of a rectangle, row by row, the length of a row; else 0.
  /// It decides about speed alone.
  int Columns;
  /// Those that meet the field at all; the others have no defined values.
  RaySet Exists;
  // Each ray in the object space of a field, from Begin to End counted from its origin, which is at
  // Base on the ray as it was given. The direction is zero along an axis whose planes the ray is
  // parallel to; the field defines what Inverse is there (images: see Ray).
  alignas(64) double Origin[3][Capacity];
  alignas(64) double Direction[3][Capacity];
  alignas(64) double Inverse[3][Capacity];
  alignas(64) double Begin[Capacity];
  alignas(64) double End[Capacity];
  alignas(64) double Base[Capacity];

  void Clear()
  {
    this->Count = 0;
    this->Columns = 0;
    this->Exists = {};
  }

  /// Appends a ray, for which there must be room, as it was given: neither base nor inverse is set.
  void Append(const Vector3& origin, const Vector3& direction, double begin, double end)
  {
    const int ray = this->Count++;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Origin[axis][ray] = origin[axis];
      this->Direction[axis][ray] = direction[axis];
    }
    this->Begin[ray] = begin;
    this->End[ray] = end;
    Add(ray, this->Exists);
  }

  Vector3 GetOrigin(int ray) const
  {
    return { this->Origin[0][ray], this->Origin[1][ray], this->Origin[2][ray] };
  }
  Vector3 GetDirection(int ray) const
  {
    return { this->Direction[0][ray], this->Direction[1][ray], this->Direction[2][ray] };
  }
};

}

#endif
