// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Field/FieldSet.h"

#include "Field/GatheredRays.h"
#include "Field/PacketInSet.h"
#include "Field/PixelBlocks.h"
#include "Math/Arithmetic.h"
#include "Math/Compiler.h"
#include "Math/Matrix.h"
#include "Math/PrefetchLines.h"
#include "Rays/AppendBoxedRay.h"
#include "Rays/LineFrustum.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <typeindex>
#include <unordered_map>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Narrows the rays of a packet to a box.
void Cut(const Kernels* kernels, const RayPacket& packet, const Bounds& box, RaysInBox& inside)
{
  const double* lower = box.Lower.data();
  const double* upper = box.Upper.data();
  if (kernels)
  {
    kernels->CutPacketToBox(packet, lower, upper, inside);
    return;
  }
  inside.Rays = {};
  for (int i = 0; i < packet.Count; ++i)
  {
    const Vector3 origin = packet.GetOrigin(i);
    const double inverse[3] = { packet.Inverse[0][i], packet.Inverse[1][i], packet.Inverse[2][i] };
    inside.Begin[i] = packet.Begin[i];
    inside.End[i] = packet.End[i];
    if (Has(packet.Exists, i) &&
      CutToBox(lower, upper, origin.data(), inverse, inside.Begin[i], inside.End[i]))
    {
      Add(i, inside.Rays);
    }
  }
}

/// The boxes of a group that rays between lines may meet: a bit for each.
unsigned int Meet(const Kernels* kernels, const LineFrustum& frustum, const BoxGroup& boxes)
{
  if (kernels)
  {
    return kernels->FindMetBoxes(boxes, frustum.GetSides(), frustum.GetNumberOfSides());
  }
  unsigned int met = 0;
  for (std::size_t i = 0; i < BoxGroup::Size; ++i)
  {
    met |= (frustum.MayMeet(GetBox(boxes, i)) ? 1U : 0U) << i;
  }
  return met;
}

/// Of rays that are in a box, the least T that one begins at, on the rays as they were given.
double FindNear(const RayPacket& packet, const RaysInBox& inside)
{
  double near = Infinity;
  for (int i = 0; i < packet.Count; ++i)
  {
    near = Has(inside.Rays, i) ? std::min(near, packet.Base[i] + inside.Begin[i]) : near;
  }
  return near;
}

}

//------------------------------------------------------------------------------
/// A member that rays may meet, and a T that none of them comes to it before, on the rays as they
/// were given.
struct FieldSet::Candidate
{
  double Near;
  std::size_t Number;
  Bounds Box;
  /// Of the packets that are traced, those with such rays: a bit for each.
  unsigned int Packets = 1;

  bool operator<(const Candidate& other) const
  {
    return std::make_pair(this->Near, this->Number) < std::make_pair(other.Near, other.Number);
  }
};

//------------------------------------------------------------------------------
/// What a thread traces packets with.
class FieldSet::ThreadBeam final : public Beam
{
public:
  /// Begins with other lines.
  void Begin(const RayPacket& lines)
  {
    this->HasLines = true;
    this->Lines = lines;
    this->InBeam.clear();
    for (auto& [number, beam] : this->InUse)
    {
      this->Free[beam.Kind].push_back(std::move(beam.Own));
    }
    this->InUse.clear();
  }

  /// That of a member, begun with the lines; null if it does not use any.
  Beam* GetBeam(std::size_t number, const SetMember& member)
  {
    if (!this->HasLines || !member.Field->UsesBeams())
    {
      return nullptr;
    }
    const auto [place, isNew] = this->InUse.try_emplace(number);
    BeamOfMember& beam = place->second;
    if (isNew)
    {
      const TracedField& field = *member.Field;
      beam.Kind = typeid(field);
      std::vector<std::unique_ptr<Beam>>& free = this->Free[beam.Kind];
      if (free.empty())
      {
        beam.Own = field.MakeBeam();
      }
      else
      {
        beam.Own = std::move(free.back());
        free.pop_back();
      }
      field.Begin(member.MoveLines(this->Lines), beam.Own.get());
    }
    return beam.Own.get();
  }

  bool HasLines = false;
  RayPacket Lines;
  /// The members that rays between the lines may meet, front to back, and their boxes.
  std::vector<Candidate> InBeam;
  std::vector<BoxGroup> Boxes;
  PacketInSet Packets[PacketsAtOnce];
  int PacketCount = 0;
  /// Of the member that is traced: rays and hits.
  RaysInBox Inside;
  GatheredRays Gathered;
  RayPacket Moved;
  RayHits HitsOfMember;

private:
  struct BeamOfMember
  {
    std::type_index Kind = typeid(void);
    std::unique_ptr<Beam> Own;
  };

  std::unordered_map<std::size_t, BeamOfMember> InUse;
  /// Those of fields of a class serve other fields of this class.
  std::unordered_map<std::type_index, std::vector<std::unique_ptr<Beam>>> Free;
};

//------------------------------------------------------------------------------
FieldSet::FieldSet(const std::vector<PlacedField>& fields)
  : Members(fields)
  , Tree(
      [this]
      {
        std::vector<Bounds> boxes;
        boxes.reserve(this->Members.GetCount());
        for (std::size_t i = 0; i < this->Members.GetCount(); ++i)
        {
          boxes.push_back(this->Members.Get(i).Box);
        }
        return boxes;
      }())
  , Box(this->Tree.GetBounds())
  , Reach(SlackOfSets * Length(this->Box.Upper - this->Box.Lower))
{
}

//------------------------------------------------------------------------------
FieldSet::~FieldSet() = default;

//------------------------------------------------------------------------------
void FieldSet::AddRay(const Vector3& origin, const Vector3& direction, double begin, double end,
  RayPacket& packet) const
{
  AppendBoxedRay(this->Box, origin, direction, begin, end, packet);
}

//------------------------------------------------------------------------------
void FieldSet::MakeRays(const Camera& view, const PixelRectangle& pixels, const PixelDepths& depths,
  RayPacket& packet) const
{
  if (!this->Members.GetKernels())
  {
    TracedField::MakeRays(view, pixels, depths, packet);
    return;
  }
  this->Members.GetKernels()->MakeBoxedRays(
    MakePixelBlock(view, pixels, depths), this->Box.Lower.data(), this->Box.Upper.data(), packet);
}

//------------------------------------------------------------------------------
std::unique_ptr<TracedField::Beam> FieldSet::MakeBeam() const
{
  return std::make_unique<ThreadBeam>();
}

//------------------------------------------------------------------------------
void FieldSet::Begin(const RayPacket& lines, Beam* beam) const
{
  auto* thread = static_cast<ThreadBeam*>(beam);
  thread->Begin(lines);
  const LineFrustum frustum(lines, this->Box);
  this->Tree.FindByGroups([&](const BoxGroup& boxes)
    { return Meet(this->Members.GetKernels(), frustum, boxes); },
    [&](std::size_t number, const Bounds& box)
    {
      if (this->Members.MayHit(number))
      {
        thread->InBeam.push_back({ frustum.FindNear(box), number, box });
      }
    });
  std::sort(thread->InBeam.begin(), thread->InBeam.end());
  thread->Boxes.resize((thread->InBeam.size() + BoxGroup::Size - 1) / BoxGroup::Size);
  for (std::size_t i = 0; i < thread->InBeam.size(); ++i)
  {
    SetBox(thread->InBeam[i].Box, i % BoxGroup::Size, thread->Boxes[i / BoxGroup::Size]);
  }
}

//------------------------------------------------------------------------------
bool FieldSet::MayHitBetween(RayPacket& lines, Beam* beam) const
{
  auto* thread = static_cast<ThreadBeam*>(beam);
  if (!thread || !thread->HasLines)
  {
    return true;
  }
  const LineFrustum frustum(lines, this->Box);
  return std::any_of(thread->InBeam.begin(), thread->InBeam.end(),
    [&](const Candidate& candidate)
    {
      if (!frustum.MayMeet(candidate.Box))
      {
        return false;
      }
      if (!this->Members.IsSelected(candidate.Number))
      {
        return true;
      }
      if (!this->Members.MayHit(candidate.Number))
      {
        return false;
      }
      const SetMember& member = this->Members.Get(candidate.Number);
      RayPacket moved = member.MoveLines(lines);
      return member.Field->MayHitBetween(moved, thread->GetBeam(candidate.Number, member));
    });
}

//------------------------------------------------------------------------------
/// The members that rays of a packet meet, front to back.
std::vector<FieldSet::Candidate> FieldSet::FindCandidates(const RayPacket& packet) const
{
  std::vector<Candidate> candidates;
  RaysInBox inside;
  this->Tree.Find(
    [&](const Bounds& box)
    {
      Cut(this->Members.GetKernels(), packet, box, inside);
      return !IsEmpty(inside.Rays);
    },
    [&](std::size_t number)
    {
      // The box that was cut to last is that of the member.
      if (this->Members.MayHit(number))
      {
        candidates.push_back({ FindNear(packet, inside), number, this->Members.Get(number).Box });
      }
    });
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

//------------------------------------------------------------------------------
void FieldSet::Trace(RayPacket& packet, RayHits& hits, Beam* beam)
{
  std::unique_ptr<ThreadBeam> own;
  auto* thread = static_cast<ThreadBeam*>(beam);
  if (!thread)
  {
    own = std::make_unique<ThreadBeam>();
    thread = own.get();
  }
  thread->PacketCount = 1;
  thread->Packets[0].Begin(packet, hits);
  this->TraceMembers(this->FindCandidates(packet), *thread);
}

//------------------------------------------------------------------------------
void FieldSet::TracePackets(TracedPacket* packets, int count, Beam* beam)
{
  auto* thread = static_cast<ThreadBeam*>(beam);
  thread->PacketCount = count;
  for (Candidate& candidate : thread->InBeam)
  {
    candidate.Packets = 0;
  }
  for (int i = 0; i < count; ++i)
  {
    thread->Packets[i].Begin(packets[i].Rays, packets[i].Hits);
    if (IsEmpty(packets[i].Rays.Exists))
    {
      continue;
    }
    const LineFrustum frustum(packets[i].Corners, this->Box);
    for (std::size_t first = 0; first < thread->InBeam.size(); first += BoxGroup::Size)
    {
      const BoxGroup& boxes = thread->Boxes[first / BoxGroup::Size];
      const std::size_t size = std::min<std::size_t>(BoxGroup::Size, thread->InBeam.size() - first);
      unsigned int met = Meet(this->Members.GetKernels(), frustum, boxes) & ((1U << size) - 1);
      for (; met != 0; met &= met - 1)
      {
        thread->InBeam[first + static_cast<std::size_t>(LowestBit(met))].Packets |= 1U << i;
      }
    }
  }
  this->TraceMembers(thread->InBeam, *thread);
}

//------------------------------------------------------------------------------
/// Traces the packets through the candidates, which are sorted.
void FieldSet::TraceMembers(const std::vector<Candidate>& candidates, ThreadBeam& beam) const
{
  const PacketInSet* const first = beam.Packets;
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const Candidate& candidate = candidates[i];
    this->PrefetchNext(candidates, i);
    const bool isBehindAll = std::all_of(first, first + beam.PacketCount,
      [&candidate](const PacketInSet& packet) { return candidate.Near > packet.GetEnd(); });
    if (isBehindAll)
    {
      break;
    }
    this->TraceMember(candidate, beam);
  }
  for (int i = 0; i < beam.PacketCount; ++i)
  {
    beam.Packets[i].Join(*this, this->Members);
  }
}

//------------------------------------------------------------------------------
/// Asks for the memory of members that are traced soon, thousands of which are far apart: first for
/// the member, then for its field, then for what the field knows of.
void FieldSet::PrefetchNext(const std::vector<Candidate>& candidates, std::size_t current) const
{
  constexpr std::size_t sizeOfField = 704; // Of an ImageField, about.
  const auto find = [&](std::size_t ahead) -> const SetMember*
  {
    const std::size_t i = current + ahead;
    // The others hit nothing, or another thread may be making them.
    const bool isTraced = i < candidates.size() && candidates[i].Packets != 0 &&
      this->Members.IsSelected(candidates[i].Number) && this->Members.MayHit(candidates[i].Number);
    return isTraced ? &this->Members.Get(candidates[i].Number) : nullptr;
  };
  if (const SetMember* member = find(6))
  {
    PrefetchLines(member, sizeof(SetMember));
  }
  if (const SetMember* member = find(4))
  {
    PrefetchLines(member->Field, sizeOfField);
  }
  if (const SetMember* member = find(2))
  {
    member->Field->Prefetch();
  }
}

//------------------------------------------------------------------------------
/// Traces the packets through a member: those with all rays in its box as they are, of the others
/// the rays that are in it together.
void FieldSet::TraceMember(const Candidate& candidate, ThreadBeam& beam) const
{
  GatheredRays& gathered = beam.Gathered;
  gathered.Clear();
  const Bounds& box = this->Members.GetRequest().Projection
    ? this->Members.Get(candidate.Number).BoxOfProjections
    : candidate.Box;
  const SetMember* member = nullptr;
  for (unsigned int left = candidate.Packets; left != 0; left &= left - 1)
  {
    const int number = LowestBit(left);
    const PacketInSet& packet = beam.Packets[number];
    if (candidate.Near > packet.GetEnd())
    {
      continue;
    }
    Cut(this->Members.GetKernels(), packet.GetRays(), box, beam.Inside);
    const int count = CountOf(beam.Inside.Rays);
    member = count > 0 && !member ? this->Members.Prepare(candidate.Number) : member;
    if (count > 0 && !member)
    {
      return;
    }
    if (count == CountOf(packet.GetRays().Exists))
    {
      member->Field->MoveRays(packet.GetRays(), beam.Inside, member->OwnFromSet, beam.Moved);
      this->TraceMoved(
        candidate.Number, beam, [number](int ray) { return std::pair(number, ray); });
      continue;
    }
    if (!gathered.HasRoomFor(count))
    {
      this->TraceGathered(candidate.Number, beam);
    }
    gathered.Add(number, packet.GetRays(), beam.Inside);
  }
  this->TraceGathered(candidate.Number, beam);
}

//------------------------------------------------------------------------------
void FieldSet::TraceGathered(std::size_t number, ThreadBeam& beam) const
{
  GatheredRays& gathered = beam.Gathered;
  if (gathered.Rays.Count == 0)
  {
    return;
  }
  const SetMember& member = this->Members.Get(number);
  member.Field->MoveRays(gathered.Rays, gathered.Parts, member.OwnFromSet, beam.Moved);
  this->TraceMoved(number, beam,
    [&gathered](int ray) { return std::pair(gathered.Packet[ray], gathered.Place[ray]); });
  gathered.Clear();
}

//------------------------------------------------------------------------------
/// Traces the rays that were moved to a member. Find(ray) tells the packet that a ray is of, and
/// its number there.
template <typename Find>
void FieldSet::TraceMoved(std::size_t number, ThreadBeam& beam, const Find& find) const
{
  const SetMember& member = this->Members.Get(number);
  const RayHits& found = beam.HitsOfMember;
  member.Field->Trace(beam.Moved, beam.HitsOfMember, beam.GetBeam(number, member));
  if (found.Hits.empty())
  {
    return;
  }
  unsigned int shortened = 0;
  for (int i = 0; i < beam.Moved.Count; ++i)
  {
    const auto ray = static_cast<std::size_t>(i);
    for (std::size_t k = found.First[ray]; k < found.First[ray + 1]; ++k)
    {
      const auto [packet, place] = find(i);
      if (beam.Packets[packet].Take(found.Hits[k], number, place, this->Members, this->Reach))
      {
        shortened |= 1U << packet;
      }
    }
  }
  for (; shortened != 0; shortened &= shortened - 1)
  {
    beam.Packets[LowestBit(shortened)].FindEnd();
  }
}

//------------------------------------------------------------------------------
void FieldSet::FindTransmittance(
  RayPacket& packet, const Departure* departures, double* transmittance)
{
  std::fill_n(transmittance, packet.Count, 1.0);
  RaysInBox inside;
  RayPacket moved;
  Departure ownDepartures[RayPacket::Capacity];
  double some[RayPacket::Capacity];
  for (const Candidate& candidate : this->FindCandidates(packet))
  {
    const SetMember* member = this->Members.Prepare(candidate.Number);
    if (!member)
    {
      continue;
    }
    Cut(this->Members.GetKernels(), packet, member->Box, inside);
    for (int i = 0; i < packet.Count; ++i)
    {
      const bool startsHere = departures[i].Member == static_cast<int>(candidate.Number);
      ownDepartures[i] = startsHere ? departures[i] : Departure{};
      if (!startsHere && departures[i].Surface != Hit::NoSurface && Has(inside.Rays, i))
      {
        // The surface that the ray starts on may go on in the member, or have a twin there.
        const double unit = Length(TransformDirection(member->OwnFromSet, packet.GetDirection(i)));
        inside.Begin[i] = std::max(
          inside.Begin[i], StoppedRays::NearStart * member->CellSize / unit - packet.Base[i]);
      }
    }
    member->Field->MoveRays(packet, inside, member->OwnFromSet, moved);
    member->Field->FindTransmittance(moved, ownDepartures, some);
    for (int i = 0; i < packet.Count; ++i)
    {
      transmittance[i] *= some[i];
      if (transmittance[i] == 0.0)
      {
        Remove(i, packet.Exists);
      }
    }
  }
}

//------------------------------------------------------------------------------
void FieldSet::AddClouds(const Camera& view, const std::vector<ValueIntervals>& shown,
  const Kernels* kernels, std::vector<ViewedCloud>& clouds) const
{
  for (std::size_t i = 0; i < this->Members.GetCount(); ++i)
  {
    if (const SetMember* member = this->Members.Prepare(i))
    {
      const Camera own(Multiply(view.GetClipFromObject(), member->SetFromOwn),
        Multiply(member->OwnFromSet, view.GetObjectFromClip()),
        Multiply(view.GetWorldFromObject(), member->SetFromOwn), view.GetWidth(), view.GetHeight());
      member->Field->AddClouds(own, shown, kernels, clouds);
    }
  }
}

//------------------------------------------------------------------------------
Vector3 FieldSet::GetPoint(const Hit& hit) const
{
  const SetMember& member = this->Members.Get(hit);
  return TransformPoint(member.SetFromOwn, member.Field->GetPoint(member.ToOwn(hit)));
}

//------------------------------------------------------------------------------
Vector3 FieldSet::GetPointInCells(const Hit& hit) const
{
  return this->Members.Get(hit).Field->GetPointInCells(hit);
}

//------------------------------------------------------------------------------
Vector3 FieldSet::GetGradient(const Hit& hit, NormalMode mode) const
{
  const SetMember& member = this->Members.Get(hit);
  return TransformDirection(
    member.SetFromOwnGradient, member.Field->GetGradient(member.ToOwn(hit), mode));
}

//------------------------------------------------------------------------------
void FieldSet::GetPointsAndGradients(const Hit* hits, int count, NormalMode mode,
  double (*points)[RayPacket::Capacity], double (*gradients)[RayPacket::Capacity]) const
{
  alignas(64) double ownPoints[3][RayPacket::Capacity];
  alignas(64) double ownGradients[3][RayPacket::Capacity];
  Hit own[RayPacket::Capacity];
  int places[RayPacket::Capacity];
  int left[RayPacket::Capacity];
  std::iota(left, left + count, 0);
  while (count > 0)
  {
    const int number = hits[left[0]].Member;
    const SetMember& member = this->Members.Get(hits[left[0]]);
    int ownCount = 0;
    int others = 0;
    // Which is which is unpredictable: counting is faster than branching.
    for (int k = 0; k < count; ++k)
    {
      const int i = left[k];
      const bool isOwn = hits[i].Member == number;
      places[ownCount] = i;
      ownCount += isOwn ? 1 : 0;
      left[others] = i;
      others += isOwn ? 0 : 1;
    }
    count = others;
    for (int k = 0; k < ownCount; ++k)
    {
      own[k] = member.ToOwn(hits[places[k]]);
    }
    member.Field->GetPointsAndGradients(own, ownCount, mode, ownPoints, ownGradients);
    for (int k = 0; k < ownCount; ++k)
    {
      const Vector3 point =
        TransformPoint(member.SetFromOwn, { ownPoints[0][k], ownPoints[1][k], ownPoints[2][k] });
      const Vector3 gradient = TransformDirection(
        member.SetFromOwnGradient, { ownGradients[0][k], ownGradients[1][k], ownGradients[2][k] });
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        points[axis][places[k]] = point[axis];
        gradients[axis][places[k]] = gradient[axis];
      }
    }
  }
}

//------------------------------------------------------------------------------
FieldStatistics FieldSet::GetStatistics() const
{
  FieldStatistics all;
  all.HierarchyMemory = this->Tree.GetMemory() + this->Members.GetCount() * sizeof(SetMember);
  for (std::size_t i = 0; i < this->Members.GetCount(); ++i)
  {
    if (const TracedField* field = this->Members.Get(i).Field)
    {
      all += field->GetStatistics();
      all.HierarchyMemory += this->Members.Get(i).Source->GetMemory();
    }
  }
  return all;
}

}
