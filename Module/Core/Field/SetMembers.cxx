// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Field/SetMembers.h"

#include "Field/BuildTimer.h"
#include "Rays/PlaneRounding.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The same as SlackOfSets for rays of a projection in the box of a member: behind it, they would
/// count values that are not its own.
constexpr double SlackOfProjections = 0x1p-48;

/// A half-space in another space, from which a transformation leads to its own.
HalfSpace Transform(const HalfSpace& half, const Matrix4& setFromOwn)
{
  HalfSpace result = half;
  result.Normal = TransposeTransformDirection(setFromOwn, half.Normal);
  result.Offset = Dot(half.Normal, TransformPoint(setFromOwn, { 0.0, 0.0, 0.0 })) + half.Offset;
  return result;
}

bool IsLimited(const MemoryBudget& budget)
{
  return budget.CacheBytes != MemoryBudget{}.CacheBytes;
}

/// A box a little larger, by more than what rounding may move rays and hits.
Bounds WithMargin(const Bounds& box, double slack = SlackOfSets)
{
  Bounds larger = box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    larger.Lower[axis] -= FindMargin(box, slack);
    larger.Upper[axis] += FindMargin(box, slack);
  }
  return larger;
}

}

//------------------------------------------------------------------------------
SetMembers::SetMembers(const std::vector<PlacedField>& fields)
  : Count(fields.size())
  , Members(new SetMember[fields.size()])
  , States(new std::atomic<unsigned int>[fields.size()])
{
  for (std::size_t i = 0; i < fields.size(); ++i)
  {
    const PlacedField& placed = fields[i];
    this->States[i] = 0;
    SetMember& member = this->Members[i];
    member.Source = placed.Source;
    member.Box = WithMargin(placed.Box);
    member.BoxOfProjections = WithMargin(placed.Box, SlackOfProjections);
    member.SetFromOwn = placed.SetFromOwn;
    member.OwnFromSet = InvertAffine(placed.SetFromOwn);
    member.SetFromOwnGradient = NormalMatrix(placed.SetFromOwn);
    member.CellSize = placed.CellSize;
    member.MemoryShare = placed.MemoryShare;
    member.IsOnDemand = placed.IsOnDemand;
    member.IsSeamless = placed.IsSeamless;
    this->MemoryShares += placed.MemoryShare;
    if (!placed.IsOnDemand)
    {
      this->Eager.push_back(i);
    }
  }
}

//------------------------------------------------------------------------------
void SetMembers::Select(
  const TraceRequest& request, const Execution& execution, const MemoryBudget& budget)
{
  // There may be thousands of members. Those that have had the same selection need no other, unless
  // they are to evict something.
  const bool isSame = this->IsSelectionKnown && request == this->Request &&
    execution.PacketKernels == this->PacketKernels && !IsLimited(this->Budget) &&
    !IsLimited(budget);
  this->IsSelectionKnown = false; // Whatever throws on the way.
  this->Request = request;
  this->PacketKernels = execution.PacketKernels;
  this->Budget = budget;
  if (!isSame)
  {
    ++this->Selection;
    this->DepthsOfCaps.clear();
    for (const HalfSpace& half : request.Visible.HalfSpaces)
    {
      this->DepthsOfCaps.push_back(half.IsCapped ? this->FindDepthOfCaps(half) : 0.0);
    }
  }
  this->GradientSeconds = 0.0;
  for (const std::size_t number : this->Eager)
  {
    if (!this->IsSelected(number))
    {
      this->SelectMember(number, execution);
      this->GradientSeconds += this->Members[number].Field->GetGradientSeconds();
    }
  }
  this->IsSelectionKnown = true;
}

//------------------------------------------------------------------------------
/// Meshes move planes into their cells, by what rounding to single precision takes from points: see
/// MovePlanesIntoCells.
double SetMembers::FindDepthOfCaps(const HalfSpace& half) const
{
  constexpr double rounding = 0x1p-23;
  double deepest = 0.0;
  for (std::size_t number = 0; number < this->Count; ++number)
  {
    const SetMember& member = this->Members[number];
    if (member.Box.Lower[0] > member.Box.Upper[0])
    {
      continue; // It has no cells.
    }
    const HalfSpace own = Transform(half, member.SetFromOwn);
    const Bounds box = TransformBounds(member.OwnFromSet, member.Box);
    deepest = std::max(deepest, FindRounding(own, box, rounding, rounding));
  }
  return deepest;
}

//------------------------------------------------------------------------------
/// That of all, in the object space of a member, with what is visible of it.
TraceRequest SetMembers::MakeRequest(std::size_t number) const
{
  SetMember& member = this->Members[number];
  TraceRequest request = this->Request;
  if (!request.MemberOpacities.empty())
  {
    for (Isosurface& surface : request.Surfaces)
    {
      surface.Opacity = this->Request.MemberOpacities[number].value_or(surface.Opacity);
    }
    request.MemberOpacities.clear();
  }
  request.Visible = member.Source->FindVisible();
  member.OwnHalfSpaces = static_cast<int>(request.Visible.HalfSpaces.size());
  for (const HalfSpace& half : this->Request.Visible.HalfSpaces)
  {
    request.Visible.HalfSpaces.push_back(Transform(half, member.SetFromOwn));
  }
  return request;
}

//------------------------------------------------------------------------------
void SetMembers::SelectMember(std::size_t number, const Execution& execution) const
{
  const bool mayHit = this->SelectField(number, execution);
  this->States[number].store(2 * this->Selection + (mayHit ? 1 : 0), std::memory_order_release);
}

//------------------------------------------------------------------------------
/// Selects the field of a member, if it is needed. Returns whether rays may hit anything of it.
bool SetMembers::SelectField(std::size_t number, const Execution& execution) const
{
  SetMember& member = this->Members[number];
  const bool mayHit = this->Request.Visible.HasCaps() || member.Source->MayHit(this->Request);
  if (!mayHit && member.IsOnDemand)
  {
    return false;
  }
  member.Field = &member.Source->GetField();
  MemoryBudget budget = this->Budget;
  if (IsLimited(budget))
  {
    budget.CacheBytes = static_cast<std::size_t>(
      static_cast<double>(budget.CacheBytes) * (member.MemoryShare / this->MemoryShares));
  }
  member.Field->Select(this->MakeRequest(number), execution, budget);
  return member.Field->MayHit();
}

//------------------------------------------------------------------------------
const SetMember* SetMembers::Prepare(std::size_t number) const
{
  if (!this->IsSelected(number))
  {
    const std::lock_guard<std::mutex> lock(this->Mutexes[number % this->Mutexes.size()]);
    if (!this->IsSelected(number))
    {
      const BuildTimer timer;
      this->SelectMember(number, { 1, this->PacketKernels });
    }
  }
  return this->MayHit(number) ? &this->Members[number] : nullptr;
}

}
