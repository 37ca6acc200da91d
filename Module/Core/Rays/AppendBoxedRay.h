// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AppendBoxedRay_h
#define AppendBoxedRay_h

#include "Math/Bounds.h"
#include "Rays/BoxedRays.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// Appends the part of a ray in a box (begin <= t <= end) to a packet that has room for it. If
/// there is none, it does not exist there.
inline void AppendBoxedRay(const Bounds& box, const Vector3& origin, const Vector3& direction,
  double begin, double end, RayPacket& packet)
{
  BoxedRays<double> boxed{};
  std::copy_n(origin.begin(), 3, boxed.Origin);
  std::copy_n(direction.begin(), 3, boxed.Direction);
  boxed.Begin = begin;
  boxed.End = end;
  const int ray = packet.Count++;
  if (!MoveToBox(box.Lower.data(), box.Upper.data(), boxed))
  {
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    packet.Origin[axis][ray] = boxed.Origin[axis];
    packet.Direction[axis][ray] = boxed.Direction[axis];
    packet.Inverse[axis][ray] = boxed.Inverse[axis];
  }
  packet.Begin[ray] = boxed.Begin;
  packet.End[ray] = boxed.End;
  packet.Base[ray] = boxed.Base;
  Add(ray, packet.Exists);
}

}

#endif
