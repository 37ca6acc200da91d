// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/HitOrder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// At one point a ray enters the surface with the smaller isovalue first, and leaves it last. All
/// else makes the order one that does not depend on how the hits were found.
bool IsBefore(const Hit& a, const Hit& b)
{
  if (a.T != b.T)
  {
    return a.T < b.T;
  }
  const int first = a.Entering ? a.Surface : -a.Surface;
  const int second = b.Entering ? b.Surface : -b.Surface;
  if (first != second)
  {
    return first < second;
  }
  const auto rest = [](const Hit& hit)
  { return std::tie(hit.Cell, hit.Surface, hit.Entering, hit.Parametric); };
  return rest(a) < rest(b);
}

/// Whether hits are at one place, but for rounding: on the face, the edge or the vertex of several
/// cells.
bool AreTogether(const Hit& a, const Hit& b)
{
  return std::abs(a.T - b.T) <= ToleranceOfPlace * (std::abs(a.T) + std::abs(b.T));
}

/// Hits of one surface that are at one place are not in the order of T, but take turns: a ray that
/// enters leaves next. Goes through the hits from one end. MayBeFirst(hit) tells whether a hit may
/// be the first with its surface.
template <typename Iterator, typename Predicate>
void TakeTurns(Iterator first, Iterator last, const Predicate& mayBeFirst)
{
  // Where many hits are at one place, those before the end of a search are no use to the next
  // alike.
  Iterator searched = first;
  int surface = Hit::NoSurface;
  bool entering = false;
  for (Iterator hit = first; hit != last; ++hit)
  {
    const auto isSame = [hit](const Hit& other) { return other.Surface == hit->Surface; };
    const auto before =
      std::find_if(std::make_reverse_iterator(hit), std::make_reverse_iterator(first), isSame);
    const bool isFirst = before == std::make_reverse_iterator(first);
    const bool isInTurn = isFirst ? mayBeFirst(*hit) : before->Entering != hit->Entering;
    if (isInTurn)
    {
      continue;
    }
    const bool isAlike = hit->Surface == surface && hit->Entering == entering;
    surface = hit->Surface;
    entering = hit->Entering;
    searched = std::find_if(isAlike ? std::max(hit, searched) : hit, last,
      [hit, &isSame](const Hit& next)
      { return isSame(next) && (next.Entering != hit->Entering || !AreTogether(*hit, next)); });
    if (searched != last && AreTogether(*hit, *searched))
    {
      std::swap(*hit, *searched);
    }
  }
}

/// Removes what is beyond the first opaque hit and its place.
void RemoveHidden(const TraceRequest& request, std::vector<Hit>& hits)
{
  const auto opaque = std::find_if(hits.begin(), hits.end(),
    [&request](const Hit& hit) { return request.GetOpacity(hit) >= 1.0; });
  hits.erase(
    std::find_if(opaque, hits.end(), [&](const Hit& hit) { return !AreTogether(*opaque, hit); }),
    hits.end());
}

}

//------------------------------------------------------------------------------
void PutInOrder(const TraceRequest& request, int startsInside, std::vector<Hit>& hits)
{
  if (hits.size() < 2)
  {
    return;
  }
  std::sort(hits.begin(), hits.end(), &IsBefore);
  RemoveHidden(request, hits);
  TakeTurns(hits.begin(), hits.end(),
    [startsInside](const Hit& hit) { return hit.Entering == (hit.Surface > startsInside); });
  TakeTurns(hits.rbegin(), hits.rend(), [](const Hit&) { return true; });
}

}
