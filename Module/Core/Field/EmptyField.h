// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef EmptyField_h
#define EmptyField_h

#include "Field/TracedField.h"

#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// A field without data, which no ray hits: the place of a field in a scene whose data are in other
/// processes.
class EmptyField final : public TracedField
{
public:
  Bounds GetBounds() const override { return NoBounds(); }

  void Select(const TraceRequest& request, const Execution& /*execution*/,
    const MemoryBudget& /*budget*/ = {}) override
  {
    this->Request = request;
  }
  const TraceRequest& GetRequest() const override { return this->Request; }
  bool MayHit() const override { return false; }

  void AddRay(const Vector3& /*origin*/, const Vector3& /*direction*/, double /*begin*/,
    double /*end*/, RayPacket& packet) const override
  {
    ++packet.Count;
  }
  bool MayHitBetween(RayPacket& /*lines*/, Beam* /*beam*/) const override { return false; }

  using TracedField::Trace;
  void Trace(RayPacket& packet, RayHits& hits, Beam* /*beam*/) override
  {
    hits.Hits.clear();
    hits.First.assign(static_cast<std::size_t>(packet.Count) + 1, 0);
  }

  // There are no hits.
  Vector3 GetPoint(const Hit& /*hit*/) const override { return {}; }
  Vector3 GetPointInCells(const Hit& /*hit*/) const override { return {}; }
  Vector3 GetGradient(const Hit& /*hit*/, NormalMode /*mode*/) const override { return {}; }
  void GetPointsAndGradients(const Hit* /*hits*/, int /*count*/, NormalMode /*mode*/,
    double (* /*points*/)[RayPacket::Capacity],
    double (* /*gradients*/)[RayPacket::Capacity]) const override
  {
  }

  FieldStatistics GetStatistics() const override { return {}; }

private:
  TraceRequest Request;
};

}

#endif
