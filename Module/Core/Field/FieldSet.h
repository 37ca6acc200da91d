// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FieldSet_h
#define FieldSet_h

#include "Field/BoundsTree.h"
#include "Field/TracedField.h"
#include "Math/Bounds.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Where a member of a set of fields comes from.
class FieldSource
{
public:
  virtual ~FieldSource() = default;

  /// Whether rays may hit anything of a request without caps, as far as it is known without making
  /// the field. Called by one thread at a time.
  virtual bool MayHit(const TraceRequest& /*request*/) { return true; }

  /// The field, which is made if it is not there. Called by one thread at a time.
  virtual TracedField& GetField() = 0;

  /// What of the field is visible, in its object space. It must be there.
  virtual Visibility FindVisible() const = 0;

  /// The number of the block that a hit is of: of hits of several fields in one place, that of the
  /// first block counts.
  virtual unsigned int GetBlock(const Hit& /*hit*/) const { return 0; }

  /// What is kept for the field besides what it tells itself, in bytes.
  virtual std::size_t GetMemory() const { return 0; }
};

/// A field of a set, and where it lies.
struct PlacedField
{
  /// It must outlive the set.
  FieldSource* Source;
  /// From the object space of the field to that of the set: an affine transformation.
  Matrix4 SetFromOwn;
  /// The box that its hits are in, in the object space of the set: rays are cut to it.
  Bounds Box;
  /// The size of its cells in its own object space, about.
  double CellSize = 1.0;
  /// Its share of the memory that all may have, in any unit.
  double MemoryShare = 1.0;
  /// Whether it is made and selected when the first ray comes to its box, by the thread of this
  /// ray; otherwise in Select, with all threads. A field that no ray comes to costs nothing.
  bool IsOnDemand = false;
  /// Whether the fields of all members with this mark are one where their boxes touch. A hit that
  /// two of them have there is one.
  bool IsSeamless = false;
};

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
    const MemoryBudget& budget = {}) override;

  /// To be called before the next Select if the field of a member, or what is visible of it, may
  /// not be what it was.
  void Forget() { this->IsSelectionKnown = false; }

  const TraceRequest& GetRequest() const override { return this->Request; }

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
  double GetGradientSeconds() const override { return this->GradientSeconds; }

private:
  static constexpr int PacketsAtOnce = 8;

  struct Member;
  class ThreadBeam;
  struct Candidate;
  struct PacketOfSet;

  TraceRequest MakeRequest(std::size_t number) const;
  double FindDepthOfCaps(const HalfSpace& half) const;
  void SelectMember(std::size_t number, const Execution& execution) const;
  bool SelectField(std::size_t number, const Execution& execution) const;
  bool IsSelected(std::size_t number) const;
  bool MayHitMember(std::size_t number) const;
  Member* Prepare(std::size_t number) const;
  const Member& GetMember(const Hit& hit) const;

  std::vector<Candidate> FindCandidates(const RayPacket& packet) const;
  void TraceMembers(const std::vector<Candidate>& candidates, ThreadBeam& beam) const;
  void PrefetchNext(const std::vector<Candidate>& candidates, std::size_t current) const;
  void TraceMember(const Candidate& candidate, ThreadBeam& beam) const;
  void TraceGathered(std::size_t number, ThreadBeam& beam) const;
  template <typename Find>
  void TraceMoved(std::size_t number, ThreadBeam& beam, const Find& find) const;
  bool TakeHit(const Hit& hitOfMember, std::size_t number, int ray, PacketOfSet& packet) const;
  bool IsOfEarlierBlock(const Hit& a, const Hit& b) const;
  void JoinHits(PacketOfSet& packet) const;
  void DropTwins(const Vector3& direction, std::vector<Hit>& found) const;

  std::size_t NumberOfMembers;
  std::unique_ptr<Member[]> Members;
  /// Twice the number of the selection that a member has, and 1 if rays may hit anything of it.
  /// Apart from the members, since thousands of them are asked for it.
  std::unique_ptr<std::atomic<unsigned int>[]> States;
  /// The numbers of those that are not on demand.
  std::vector<std::size_t> Eager;
  BoundsTree Tree;
  Bounds Box;
  /// How far, in the object space of the set, rays go on behind an opaque hit.
  double Reach;
  /// Of each half-space, by how much caps of members may be behind its plane, in units of its
  /// offset.
  std::vector<double> DepthsOfCaps;
  TraceRequest Request;
  const Kernels* PacketKernels = nullptr;
  MemoryBudget Budget;
  double MemoryShares = 0.0;
  double GradientSeconds = 0.0;
  /// The number of the selection; members that have another are to be selected before they are
  /// traced.
  unsigned int Selection = 0;
  /// Whether members that have it are as they were selected.
  bool IsSelectionKnown = false;
  /// Of the members, which share them.
  mutable std::array<std::mutex, 64> Mutexes;
};

}

#endif
