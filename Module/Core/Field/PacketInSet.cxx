// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Field/PacketInSet.h"

#include "Field/HitCollector.h"
#include "Math/Arithmetic.h"
#include "Rays/PlaneRounding.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The largest number of an array as large as a packet: in eight parts, which take no longer than
/// one.
double FindLargest(const double* numbers)
{
  constexpr int parts = 8;
  double largest[parts];
  std::copy_n(numbers, parts, largest);
  for (int i = parts; i < RayPacket::Capacity; i += parts)
  {
    for (int k = 0; k < parts; ++k)
    {
      largest[k] = largest[k] > numbers[i + k] ? largest[k] : numbers[i + k];
    }
  }
  return *std::max_element(largest, largest + parts);
}

bool IsOfEarlierBlock(const SetMembers& members, const Hit& a, const Hit& b)
{
  if (a.Member == b.Member)
  {
    return false;
  }
  const unsigned int blockOfA = members.Get(a).Source->GetBlock(a);
  const unsigned int blockOfB = members.Get(b).Source->GetBlock(b);
  return blockOfA < blockOfB || (blockOfA == blockOfB && a.Member < b.Member);
}

/// Boxes overlap by their margins, so that no ray slips through between them. A hit there has a
/// twin.
void DropTwins(const SetMembers& members, const Vector3& direction, std::vector<Hit>& found)
{
  const double length = Length(direction);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const Hit& hit = found[i];
    const SetMember& member = members.Get(hit);
    bool isTwin = false;
    for (std::size_t k = kept; member.IsSeamless && !isTwin && k-- > 0;)
    {
      const SetMember& other = members.Get(found[k]);
      const double overlap = 2.0 * (member.FindMargin() + other.FindMargin());
      if ((hit.T - found[k].T) * length > overlap)
      {
        break;
      }
      isTwin = other.IsSeamless && hit.Member != found[k].Member &&
        hit.Surface == found[k].Surface && hit.Entering == found[k].Entering;
    }
    if (!isTwin)
    {
      found[kept++] = hit;
    }
  }
  found.resize(kept);
}

}

//------------------------------------------------------------------------------
void PacketInSet::Begin(RayPacket& rays, RayHits& hits)
{
  this->Rays = &rays;
  this->Hits = &hits;
  std::fill_n(this->Ends, RayPacket::Capacity, -Infinity);
  for (int i = 0; i < rays.Count; ++i)
  {
    this->Ends[i] = Has(rays.Exists, i) ? rays.Base[i] + rays.End[i] : -Infinity;
    this->Found[i].clear();
  }
  this->FindEnd();
}

//------------------------------------------------------------------------------
void PacketInSet::FindEnd()
{
  this->End = FindLargest(this->Ends);
}

//------------------------------------------------------------------------------
bool PacketInSet::Take(
  const Hit& hitOfMember, std::size_t number, int ray, const SetMembers& members, double reach)
{
  RayPacket& rays = *this->Rays;
  Hit& hit = this->Found[ray].emplace_back(hitOfMember);
  hit.Member = static_cast<int>(number);
  double depthOfCaps = 0.0;
  if (hit.Plane != Hit::NoPlane)
  {
    hit.Plane -= members.Get(number).OwnHalfSpaces;
    const auto plane = static_cast<std::size_t>(hit.Plane);
    // The same for all members with a cap there, whatever their arithmetic.
    const PlaneCrossing crossing = FindCrossing(
      members.GetRequest().Visible.HalfSpaces[plane], rays.GetOrigin(ray), rays.GetDirection(ray));
    hit.T = crossing.T;
    depthOfCaps = members.GetDepthOfCaps(plane) / std::abs(crossing.Slope);
  }
  const bool isOpaque =
    !members.GetRequest().Projection && members.GetRequest().GetOpacity(hit) >= 1.0;
  if (isOpaque)
  {
    // Another member may have a hit or a cap right there.
    const Vector3 direction = rays.GetDirection(ray);
    const double beyond = reach /
      std::max(std::max(std::abs(direction[0]), std::abs(direction[1])), std::abs(direction[2]));
    rays.End[ray] = std::min(rays.End[ray], hit.T + std::max(beyond, depthOfCaps));
    this->Ends[ray] = rays.Base[ray] + rays.End[ray];
  }
  hit.T += rays.Base[ray];
  return isOpaque;
}

//------------------------------------------------------------------------------
void PacketInSet::Join(const TracedField& set, const SetMembers& members)
{
  RayHits& hits = *this->Hits;
  hits.Clear();
  for (int i = 0; i < this->Rays->Count; ++i)
  {
    std::vector<Hit>& found = this->Found[i];
    if (found.size() > 1)
    {
      std::stable_sort(found.begin(), found.end(),
        [&members](const Hit& a, const Hit& b)
        { return a.T < b.T || (a.T == b.T && IsOfEarlierBlock(members, a, b)); });
      DropTwins(members, this->Rays->GetDirection(i), found);
    }
    if (found.size() == 1)
    {
      hits.Hits.push_back(found.front());
    }
    else if (members.GetRequest().Projection && !found.empty())
    {
      const bool isLargest = members.GetRequest().Projection == Extremum::Largest;
      const auto extreme = std::min_element(found.begin(), found.end(),
        [isLargest](const Hit& a, const Hit& b)
        { return isLargest ? a.Value > b.Value : a.Value < b.Value; });
      hits.Hits.insert(hits.Hits.end(), extreme, extreme + 1);
    }
    else
    {
      // What is hidden in the members is not among them.
      HitCollector collector(set, hits.Hits);
      for (const Hit& hit : found)
      {
        if (collector.AddVisible(hit))
        {
          break;
        }
      }
    }
    hits.EndRay();
  }
}

}
