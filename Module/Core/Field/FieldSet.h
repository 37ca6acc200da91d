// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FieldSet_h
#define FieldSet_h

#include "Field/BoundsTree.h"
#include "Field/PlacedField.h"
#include "Field/SetMembers.h"
#include "Field/TracedField.h"
#include "Math/Bounds.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Any number of fields as one: the blocks of composite data. Each has an object space of its own;
/// their hits are put in order along each ray by T, which is the same in all affine spaces.
///
/// Rays find the fields they meet by a hierarchy over boxes, front to back, and end at the nearest
/// opaque hit so far. All have the same request, but for what is visible and opaque. Hits say which
/// member they are of. A projection has the first of the extreme values of all members.
class FieldSet final : public TracedField
{
public:
  /// There must be a member.
  explicit FieldSet(const std::vector<PlacedField>& fields);
  ~FieldSet() override;

  void Select(const TraceRequest& request, const Execution& execution,
    const MemoryBudget& budget = {}) override
  {
    this->Members.Select(request, execution, budget);
  }

  /// To be called before the next Select if the field of a member, or what is visible of it, may
  /// not be what it was.
  void Forget() { this->Members.Forget(); }

  const TraceRequest& GetRequest() const override { return this->Members.GetRequest(); }

  Bounds GetBounds() const override { return this->Box; }
  void AddRay(const Vector3& origin, const Vector3& direction, double begin, double end,
    RayPacket& packet) const override;
  void MakeRays(const Camera& view, const PixelRectangle& pixels, const PixelDepths& depths,
    RayPacket& packet) const override;
  std::unique_ptr<Beam> MakeBeam() const override;
  bool UsesBeams() const override { return true; }
  void Begin(const RayPacket& lines, Beam* beam) const override;
  bool MayHitBetween(RayPacket& lines, Beam* beam) const override;
  using TracedField::Trace;
  void Trace(RayPacket& packet, RayHits& hits, Beam* beam) override;
  int GetPacketsAtOnce() const override { return PacketsAtOnce; }
  void TracePackets(TracedPacket* packets, int count, Beam* beam) override;
  void FindTransmittance(
    RayPacket& packet, const Departure* departures, double* transmittance) override;
  void AddClouds(const Camera& view, const std::vector<ValueIntervals>& shown,
    const Kernels* kernels, std::vector<ViewedCloud>& clouds) const override;
  Vector3 GetPoint(const Hit& hit) const override;
  Vector3 GetPointInCells(const Hit& hit) const override;
  Vector3 GetGradient(const Hit& hit, NormalMode mode) const override;
  void GetPointsAndGradients(const Hit* hits, int count, NormalMode mode,
    double (*points)[RayPacket::Capacity], double (*gradients)[RayPacket::Capacity]) const override;
  FieldStatistics GetStatistics() const override;
  /// Members that are selected by a ray have no such gradients.
  double GetGradientSeconds() const override { return this->Members.GetGradientSeconds(); }

private:
  static constexpr int PacketsAtOnce = 8;

  class ThreadBeam;
  struct Candidate;

  std::vector<Candidate> FindCandidates(const RayPacket& packet) const;
  void TraceMembers(const std::vector<Candidate>& candidates, ThreadBeam& beam) const;
  void PrefetchNext(const std::vector<Candidate>& candidates, std::size_t current) const;
  void TraceMember(const Candidate& candidate, ThreadBeam& beam) const;
  void TraceGathered(std::size_t number, ThreadBeam& beam) const;
  template <typename Find>
  void TraceMoved(std::size_t number, ThreadBeam& beam, const Find& find) const;

  SetMembers Members;
  BoundsTree Tree;
  Bounds Box;
  /// How far, in the object space of the set, rays go on behind an opaque hit.
  double Reach;
};

}

#endif
