// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Tracers/AllHitsTracer.h"

#include "Image/Traversal/CandidateSets.h"

#include <algorithm>
#include <utility>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
AllHitsTracer::AllHitsTracer(
  const ImageSelection& selection, const RayPacket& rays, RootCells& cells, CornerSource& corners)
  : CandidateTracer(selection, rays, cells, corners)
  , TheCells(cells)
  , AreRootsVisible(selection.Request.Visible.IsConvex())
  , Collector(selection, rays.Count)
{
  for (std::size_t surface = 0; surface < selection.Isovalues.size(); ++surface)
  {
    this->EndsAllRays = this->EndsAllRays && selection.EndsRays(surface);
  }
  this->LastOfRay.fill(-1);
  this->Transmittance.fill(1.0);
}

//------------------------------------------------------------------------------
void AllHitsTracer::FindHits(RayHits& hits)
{
  this->TraceSurfaces(Order::Nearest);
  this->Collector.AppendTo(hits);
}

//------------------------------------------------------------------------------
int AllHitsTracer::KeepNeeded(const Frustum& /*frustum*/, int* passages, int count) const
{
  return KeepOthers([this](int passage) { return this->EndsAllRays && this->Passed.Hits[passage]; },
    passages, count);
}

//------------------------------------------------------------------------------
void AllHitsTracer::KeepSolutions(int surface)
{
  const bool endsRays = this->Selection.EndsRays(static_cast<std::size_t>(surface));
  ForEachCandidate(this->Solved.Found,
    [this, surface, endsRays](int candidate) {
      this->AddRoot(candidate, surface, !endsRays && HasCandidate(this->Solved.Further, candidate));
    });
  ForEachCandidate(this->Solved.Extreme,
    [this, surface](int candidate) { this->AddRoot(candidate, surface, true); });
}

//------------------------------------------------------------------------------
void AllHitsTracer::AddRoot(int candidate, int surface, bool isPartial)
{
  const Solutions& solved = this->Solved;
  const Index3 cell = this->GetCell(candidate);
  int& last = this->LastOfRay[static_cast<std::size_t>(this->Waiting.Ray[candidate])];
  const int next = std::exchange(last, static_cast<int>(this->Found.size()));
  this->Found.push_back({ { solved.T[candidate], this->Selection.Lattice.GetNumber(cell), surface,
                            { solved.Parametric[0][candidate], solved.Parametric[1][candidate],
                              solved.Parametric[2][candidate] },
                            HasCandidate(solved.Entering, candidate) },
    cell, { solved.Begin[candidate], static_cast<int>(solved.BeginAxis[candidate]) },
    solved.Fraction[candidate], isPartial, next });
  if (this->AreApart && this->AreRootsVisible && !isPartial)
  {
    this->Attenuate(this->Waiting.Ray[candidate], this->Found.back().TheHit);
  }
}

//------------------------------------------------------------------------------
/// Ends a ray that was found to end at the hit or at a nearer one. In which order the opacities are
/// multiplied makes a difference in the last digits.
void AllHitsTracer::Attenuate(int ray, const Hit& hit)
{
  constexpr double surely = 0.999;
  double& transmittance = this->Transmittance[static_cast<std::size_t>(ray)];
  transmittance *= 1.0 - this->Selection.Request.GetOpacity(hit);
  if (transmittance < surely * NegligibleTransmittance)
  {
    Remove(ray, this->Going);
  }
}

//------------------------------------------------------------------------------
void AllHitsTracer::EndQueuedSlice(const Frustum& /*frustum*/)
{
  if (!this->AreApart)
  {
    this->AddHitsOfAll();
  }
}

//------------------------------------------------------------------------------
void AllHitsTracer::EndFrustum()
{
  this->AddHitsOfAll();
}

//------------------------------------------------------------------------------
/// Adds what was found since the last call. Rays of which nothing is left end.
void AllHitsTracer::AddHitsOfAll()
{
  this->SolveWaiting();
  for (int ray = 0; ray < this->Rays.Count; ++ray)
  {
    if (this->LastOfRay[static_cast<std::size_t>(ray)] >= 0 && this->AddHitsOfRay(ray))
    {
      Remove(ray, this->Going);
    }
  }
  this->Found.clear();
}

//------------------------------------------------------------------------------
/// Adds the hits of a ray, in order. Returns whether nothing of the ray is left.
bool AllHitsTracer::AddHitsOfRay(int ray)
{
  this->OfRay.clear();
  int next = std::exchange(this->LastOfRay[static_cast<std::size_t>(ray)], -1);
  for (; next >= 0; next = this->OfRay.back()->Next)
  {
    this->OfRay.push_back(&this->Found[static_cast<std::size_t>(next)]);
  }
  const Vector3 direction = this->Rays.GetDirection(ray);
  std::sort(this->OfRay.begin(), this->OfRay.end(),
    [&direction](const FoundRoot* a, const FoundRoot* b)
    {
      const bool isBefore = IsEnteredBefore(a->Cell, a->Begin, b->Cell, b->Begin, direction);
      return isBefore ||
        (a->TheHit.Surface < b->TheHit.Surface &&
          !IsEnteredBefore(b->Cell, b->Begin, a->Cell, a->Begin, direction));
    });
  for (auto first = this->OfRay.cbegin(); first != this->OfRay.cend();)
  {
    const auto last = std::find_if(first, this->OfRay.cend(),
      [cell = (*first)->TheHit.Cell](const FoundRoot* root) { return root->TheHit.Cell != cell; });
    if (this->AddHitsInCell(ray, first, last))
    {
      return true;
    }
    first = last;
  }
  return false;
}

//------------------------------------------------------------------------------
bool AllHitsTracer::AddHitsInCell(int ray, Roots::const_iterator first, Roots::const_iterator last)
{
  if (std::any_of(first, last, [](const FoundRoot* root) { return root->IsPartial; }))
  {
    return this->AddRootsInCell(ray, (*first)->Cell);
  }
  if (last - first == 1)
  {
    return this->Collector.Add(ray, (*first)->TheHit);
  }
  this->InCell.Clear();
  for (auto root = first; root != last; ++root)
  {
    this->InCell.NextSurface();
    this->InCell.Add({ (*root)->Fraction, (*root)->TheHit.Surface, (*root)->TheHit.Entering });
  }
  return std::any_of(this->InCell.Get().begin(), this->InCell.Get().end(),
    [this, ray, first, last](const Root& root)
    {
      const auto found = std::find_if(first, last,
        [&root](const FoundRoot* other) { return other->TheHit.Surface == root.Surface; });
      return this->Collector.Add(ray, (*found)->TheHit);
    });
}

//------------------------------------------------------------------------------
/// Adds the hits of all surfaces in a cell, which are found once more.
bool AllHitsTracer::AddRootsInCell(int ray, const Index3& cell)
{
  const Ray own = this->Selection.TakeRay(this->Rays, ray);
  CellSegment segment;
  if (!SegmentInCell(own, cell, segment))
  {
    return false;
  }
  this->TheCells.FindRoots(cell, segment, false, this->InCell);
  return AddHits(own, this->Selection.Lattice, cell, segment, this->InCell,
    [this, ray](const Hit& hit) { return this->Collector.Add(ray, hit); });
}

}
