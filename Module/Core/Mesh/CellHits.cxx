// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellHits.h"

#include "Mesh/ShapeFunctions.h"
#include "Mesh/TrilinearSystem.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

bool IsInside(double difference)
{
  return difference >= 0.0;
}

void AddWeights(const FaceCrossing& crossing, double factor, CornerWeights& weights)
{
  for (int i = 0; i < crossing.Count; ++i)
  {
    weights[crossing.Corners[i]] += factor * crossing.Weights[i];
  }
}

}

//------------------------------------------------------------------------------
bool CellHits::Enter(const MeshCell& cell)
{
  this->Cell = &cell;
  for (int i = 0; i < cell.Count; ++i)
  {
    this->Points[i] = this->Frame.Get(cell.Points[i]);
  }
  this->Faces.Find(cell, this->Points);
  return this->Faces.Count > 0;
}

//------------------------------------------------------------------------------
const std::vector<CellHit>& CellHits::Find(const double* differences)
{
  this->Hits.clear();
  if (this->Cell->Shape == CellShape::Tetrahedron)
  {
    this->FindOfTetrahedron(differences);
  }
  else
  {
    this->FindOfTrilinear(differences);
  }
  return this->Hits;
}

//------------------------------------------------------------------------------
/// The field is linear: it is known from the two faces that the ray crosses.
void CellHits::FindOfTetrahedron(const double* differences)
{
  const FaceCrossing& first = this->Faces.Crossings[0];
  const FaceCrossing& last = this->Faces.Crossings[this->Faces.Count - 1];
  const double before = first.Interpolate(differences);
  const double behind = last.Interpolate(differences);
  if (IsInside(before) == IsInside(behind))
  {
    return;
  }
  const double fraction = before / (before - behind);
  CornerWeights weights = {};
  AddWeights(first, 1.0 - fraction, weights);
  AddWeights(last, fraction, weights);
  this->Hits.push_back({ Lerp(first.T, last.T, fraction), GetParametric(this->Cell->Shape, weights),
    IsInside(behind) });
}

//------------------------------------------------------------------------------
void CellHits::FindOfTrilinear(const double* differences)
{
  const TrilinearSystem system = {
    { MakeTrilinear(*this->Cell, [this](int corner) { return this->Points[corner].X; }),
      MakeTrilinear(*this->Cell, [this](int corner) { return this->Points[corner].Y; }),
      MakeTrilinear(*this->Cell, [differences](int corner) { return differences[corner]; }) }
  };
  system.Solve(this->Solutions);
  std::vector<CellHit> hits;
  for (const Vector3& solution : this->Solutions)
  {
    hits.push_back(this->MakeHit(solution));
  }
  std::sort(hits.begin(), hits.end(), [](const CellHit& a, const CellHit& b) { return a.T < b.T; });

  // A cell that is not convex may be crossed several times. What is beyond all crossings is a point
  // where the ray touches the cell.
  const auto [low, high] = std::minmax_element(this->Points, this->Points + this->Cell->Count,
    [](const FramePoint& a, const FramePoint& b) { return a.T < b.T; });
  const double slack = 1e-9 * (high->T - low->T);
  const FaceCrossing* crossings = this->Faces.Crossings;
  const int step = this->Faces.AreSegments() ? 2 : this->Faces.Count;
  auto begin = hits.begin();
  for (int i = 0; i < this->Faces.Count; i += step)
  {
    const FaceCrossing* first = crossings + i;
    const auto isBefore = [first, slack](const CellHit& hit) { return hit.T < first->T - slack; };
    const auto isBehind = [first, step, slack](const CellHit& hit)
    { return hit.T > first[step - 1].T + slack; };
    begin = std::find_if_not(begin, hits.end(), isBefore);
    const auto end = std::find_if(begin, hits.end(), isBehind);
    this->AddSegment({ begin, end }, first, step, differences);
    begin = end;
  }
}

//------------------------------------------------------------------------------
/// Adds the hits between crossings, where the ray is in the cell. If they ask for one hit more or
/// less, rounding decided about one on a face.
void CellHits::AddSegment(
  std::vector<CellHit> hits, const FaceCrossing* crossings, int count, const double* differences)
{
  bool isOdd = hits.size() % 2 != 0;
  const FaceCrossing* nearest = crossings;
  double leastValue = HUGE_VAL;
  for (int i = 0; i < count; ++i)
  {
    const double value = crossings[i].Interpolate(differences);
    isOdd ^= IsInside(value);
    if (std::abs(value) < leastValue)
    {
      leastValue = std::abs(value);
      nearest = &crossings[i];
    }
  }
  if (isOdd)
  {
    const auto distance = [nearest](const CellHit& hit) { return std::abs(hit.T - nearest->T); };
    const auto extra = std::min_element(hits.begin(), hits.end(),
      [&distance](const CellHit& a, const CellHit& b) { return distance(a) < distance(b); });
    const double length = crossings[count - 1].T - crossings[0].T;
    if (extra != hits.end() && distance(*extra) <= 1e-6 * length)
    {
      hits.erase(extra);
    }
    else
    {
      const CellHit missing = this->MakeHitOnFace(*nearest);
      hits.insert(nearest == crossings ? hits.begin() : hits.end(), missing);
    }
  }
  bool isInside = IsInside(crossings[0].Interpolate(differences));
  for (CellHit& hit : hits)
  {
    isInside = !isInside;
    hit.Entering = isInside;
    hit.T = std::clamp(hit.T, crossings[0].T, std::max(crossings[0].T, crossings[count - 1].T));
  }
  this->Hits.insert(this->Hits.end(), hits.begin(), hits.end());
}

//------------------------------------------------------------------------------
CellHit CellHits::MakeHitOnFace(const FaceCrossing& crossing) const
{
  CornerWeights weights = {};
  AddWeights(crossing, 1.0, weights);
  return { crossing.T, GetParametric(this->Cell->Shape, weights), false };
}

//------------------------------------------------------------------------------
CellHit CellHits::MakeHit(const Vector3& trilinear) const
{
  CornerWeights ofTrilinear;
  GetWeights(CellShape::Voxel, trilinear, ofTrilinear);
  const ShapeTraits& traits = GetTraits(this->Cell->Shape);
  CornerWeights weights = {};
  double t = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    weights[traits.Trilinear[i]] += ofTrilinear[i];
    t += ofTrilinear[i] * this->Points[traits.Trilinear[i]].T;
  }
  return { t, GetParametric(this->Cell->Shape, weights), false };
}

}
