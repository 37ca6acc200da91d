// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SetMembers_h
#define SetMembers_h

#include "Field/PlacedField.h"
#include "Math/Matrix.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// More than what rounding may move rays, hits and boxes of a set by, as a part of their distance
/// or size.
constexpr double SlackOfSets = 1e-9;

inline double FindMargin(const Bounds& box, double slack = SlackOfSets)
{
  const Vector3 size = box.Upper - box.Lower;
  return slack * std::max(std::max(size[0], size[1]), size[2]);
}

/// A member of a set of fields: where it lies, and its field.
struct alignas(64) SetMember
{
  Bounds Box;
  bool IsOnDemand = false;
  bool IsSeamless = false;

  FieldSource* Source = nullptr;
  Matrix4 SetFromOwn;
  Matrix4 OwnFromSet;
  Matrix4 SetFromOwnGradient;
  double CellSize = 1.0;
  double MemoryShare = 1.0;
  /// Null before it is selected first.
  TracedField* Field = nullptr;
  /// The number of half-spaces that cut the member alone: those of the request follow.
  int OwnHalfSpaces = 0;
  /// What rays of a projection are cut to.
  Bounds BoxOfProjections;

  double FindMargin() const { return vtkIsosurfaceRayTracing::FindMargin(this->Box); }

  /// A hit, with the number that its half-space has in the member.
  Hit ToOwn(Hit hit) const
  {
    hit.Plane += hit.Plane == Hit::NoPlane ? 0 : this->OwnHalfSpaces;
    return hit;
  }

  RayPacket MoveLines(const RayPacket& lines) const
  {
    RayPacket moved;
    moved.Clear();
    moved.Count = lines.Count;
    for (int i = 0; i < lines.Count; ++i)
    {
      const Vector3 origin = TransformPoint(this->OwnFromSet, lines.GetOrigin(i));
      const Vector3 direction = TransformDirection(this->OwnFromSet, lines.GetDirection(i));
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        moved.Origin[axis][i] = origin[axis];
        moved.Direction[axis][i] = direction[axis];
      }
    }
    return moved;
  }
};

/// The members of a set of fields, each of which is made and selected when it is needed: by Select,
/// or by the first thread whose ray comes to it.
class SetMembers
{
public:
  /// There must be a member.
  explicit SetMembers(const std::vector<PlacedField>& fields);

  /// Selects a request in those that are not on demand; in the others, when Prepare is called.
  void Select(const TraceRequest& request, const Execution& execution, const MemoryBudget& budget);

  /// See FieldSet.
  void Forget() { this->IsSelectionKnown = false; }

  const TraceRequest& GetRequest() const { return this->Request; }
  const Kernels* GetKernels() const { return this->PacketKernels; }

  std::size_t GetCount() const { return this->Count; }
  const SetMember& Get(std::size_t number) const { return this->Members[number]; }
  const SetMember& Get(const Hit& hit) const
  {
    return this->Members[static_cast<std::size_t>(hit.Member)];
  }

  bool IsSelected(std::size_t number) const
  {
    return this->States[number].load(std::memory_order_acquire) / 2 == this->Selection;
  }

  /// Whether rays may hit anything of a member. Before it is selected that is not known.
  bool MayHit(std::size_t number) const
  {
    return this->States[number].load(std::memory_order_acquire) != 2 * this->Selection;
  }

  /// Selects a member, unless it is. Returns null if rays hit nothing of it. Threads may call it at
  /// once.
  const SetMember* Prepare(std::size_t number) const;

  /// By how much caps of members may be behind the plane of a half-space of the request, in units
  /// of its offset.
  double GetDepthOfCaps(std::size_t plane) const { return this->DepthsOfCaps[plane]; }

  /// Of the last selection, but for members on demand.
  double GetGradientSeconds() const { return this->GradientSeconds; }

private:
  TraceRequest MakeRequest(std::size_t number) const;
  double FindDepthOfCaps(const HalfSpace& half) const;
  void SelectMember(std::size_t number, const Execution& execution) const;
  bool SelectField(std::size_t number, const Execution& execution) const;

  std::size_t Count;
  std::unique_ptr<SetMember[]> Members;
  /// Twice the number of the selection that a member has, and 1 if rays may hit anything of it.
  /// Apart from the members, since thousands of them are asked for it.
  std::unique_ptr<std::atomic<unsigned int>[]> States;
  /// The numbers of those that are not on demand.
  std::vector<std::size_t> Eager;
  /// Of each half-space.
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
