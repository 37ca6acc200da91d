// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellHits.h"

#include "Mesh/CornerOrder.h"
#include "Mesh/ShapeFunctions.h"
#include "Rays/TetrahedronHits.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Whether a solution is within the cell and a point of its own, clearly: neither on the border nor
/// one of many (a ray in the surface).
bool IsIsolated(const Vector3& solution, const TrilinearSystem& system)
{
  const std::array<Vector3, 3> rows = system.GetJacobian(solution);
  const double volume = std::abs(Dot(rows[0], Cross(rows[1], rows[2])));
  return volume > 1e-8 * Length(rows[0]) * Length(rows[1]) * Length(rows[2]) &&
    std::all_of(
      solution.begin(), solution.end(), [](double x) { return x > 1e-9 && x < 1.0 - 1e-9; });
}

/// Loads a cell for TrilinearSearch.
struct CornersOfCell
{
  const int (&Trilinear)[8];
  const FramePoint* Points;
  const double* Differences;

  void Load(
    const TrilinearPart* part, int /*count*/, bool /*areWhole*/, TrilinearHits<double>& hits) const
  {
    for (int i = 0; i < 8; ++i)
    {
      const int corner = this->Trilinear[i];
      hits.SetCorner(i, this->Points[corner], this->Differences[corner]);
    }
    std::copy_n(part->Middle, 3, hits.Middle);
    std::copy_n(part->Half, 3, hits.Half);
  }
};

void AddWeights(const FaceCrossing& crossing, double factor, CornerWeights& weights)
{
  for (int i = 0; i < crossing.Count; ++i)
  {
    weights[crossing.Corners[i]] += factor * crossing.Weights[i];
  }
}

}

//------------------------------------------------------------------------------
CellHit MakeCellHit(CellShape shape, const TrilinearSolutions& solutions, int number)
{
  const double* p = solutions.Parametric[number];
  return { solutions.T[number], GetParametric(shape, Vector3{ p[0], p[1], p[2] }),
    solutions.Entering[number] };
}

//------------------------------------------------------------------------------
void CellHits::Enter(const RayFrame& frame, const MeshCell& cell)
{
  this->Frame = &frame;
  this->Cell = &cell;
  for (int i = 0; i < cell.Count; ++i)
  {
    this->Points[i] = this->Frame->Get(cell.Points[i]);
  }
  if (cell.Shape != CellShape::Tetrahedron)
  {
    this->Slack = 1e-9 * this->GetExtent();
  }
  this->AvoidExtremes();
}

//------------------------------------------------------------------------------
const FaceCrossings& CellHits::FindCrossings()
{
  this->Faces.Find(*this->Cell, this->Points);
  return this->Faces;
}

//------------------------------------------------------------------------------
/// Products of coordinates may overflow, or vanish: then those across the ray are multiplied by a
/// power of two, which changes no sign and no weight.
void CellHits::AvoidExtremes()
{
  double largest = 0.0;
  for (int i = 0; i < this->Cell->Count; ++i)
  {
    largest = std::max({ largest, std::abs(this->Points[i].X), std::abs(this->Points[i].Y) });
  }
  if (IsSafeCoordinate(largest) || !(largest > 0.0))
  {
    return;
  }
  const int exponent = -std::ilogb(largest);
  for (int i = 0; i < this->Cell->Count; ++i)
  {
    this->Points[i].X = std::ldexp(this->Points[i].X, exponent);
    this->Points[i].Y = std::ldexp(this->Points[i].Y, exponent);
  }
}

//------------------------------------------------------------------------------
/// The largest extent of the cell in the frame, as a difference of t.
double CellHits::GetExtent() const
{
  const auto extent = [this](auto coordinate)
  {
    const auto [low, high] = std::minmax_element(this->Points, this->Points + this->Cell->Count,
      [&](const FramePoint& a, const FramePoint& b) { return coordinate(a) < coordinate(b); });
    return coordinate(*high) - coordinate(*low);
  };
  return std::max({ extent([](const FramePoint& p) { return p.T; }),
    this->Frame->ToT(extent([](const FramePoint& p) { return p.X; })),
    this->Frame->ToT(extent([](const FramePoint& p) { return p.Y; })) });
}

//------------------------------------------------------------------------------
const std::vector<CellHit>& CellHits::Find(const double* differences)
{
  this->Hits.clear();
  if (this->Cell->Shape == CellShape::Tetrahedron)
  {
    this->FindOfTetrahedron(differences);
  }
  else if (!this->FindClearOfFaces(differences))
  {
    this->FindBetweenFaces(differences);
  }
  return this->Hits;
}

//------------------------------------------------------------------------------
void CellHits::FindOfTetrahedron(const double* differences)
{
  TetrahedronHits<double> tetrahedron;
  const CornerOrder order(this->Cell->Ids);
  for (std::size_t i = 0; i < 4; ++i)
  {
    tetrahedron.Points[i] = this->Points[order.Corners[i]];
    tetrahedron.Differences[i] = differences[order.Corners[i]];
  }
  if (tetrahedron.Find())
  {
    this->Hits.push_back(
      { tetrahedron.T, order.GetParametric(tetrahedron.Weights), tetrahedron.Entering });
  }
}

//------------------------------------------------------------------------------
bool CellHits::FindClearOfFaces(const double* differences)
{
  const CornersOfCell source = { GetTraits(this->Cell->Shape).Trilinear, this->Points,
    differences };
  TrilinearSolutions found;
  TrilinearSearch<double, 1, 1, CornersOfCell>(source, &found).Solve(1);
  for (int i = 0; i < found.Count && found.AreCertain; ++i)
  {
    this->Hits.push_back(MakeCellHit(this->Cell->Shape, found, i));
  }
  return found.AreCertain;
}

//------------------------------------------------------------------------------
void CellHits::FindBetweenFaces(const double* differences)
{
  if (this->FindCrossings().Count == 0)
  {
    return;
  }
  const TrilinearSystem system = {
    { MakeTrilinear(*this->Cell, [this](int corner) { return this->Points[corner].X; }),
      MakeTrilinear(*this->Cell, [this](int corner) { return this->Points[corner].Y; }),
      MakeTrilinear(*this->Cell, [differences](int corner) { return differences[corner]; }) }
  };
  system.Solve(this->Solutions);
  std::vector<CellHit> hits;
  // In a cell that is twisted over itself there may be hits that are not between crossings.
  bool isTwisted = false;
  for (const Vector3& solution : this->Solutions)
  {
    const CellHit hit = this->MakeHit(solution, system);
    const bool isInSegment = this->IsInSegment(hit.T);
    const bool isIsolated = !isInSegment && IsIsolated(solution, system);
    isTwisted = isTwisted || isIsolated;
    if (isInSegment || isIsolated)
    {
      hits.push_back(hit);
    }
  }
  std::sort(hits.begin(), hits.end(), [](const CellHit& a, const CellHit& b) { return a.T < b.T; });
  if (isTwisted)
  {
    this->MatchParity(this->Faces.Crossings, this->Faces.Count, differences, hits);
    this->Hits = hits;
    return;
  }

  // A cell that is not convex may be crossed several times. What is beyond all crossings is a point
  // where the ray touches the cell.
  auto begin = hits.begin();
  const int step = this->GetStep();
  for (int i = 0; i < this->Faces.Count; i += step)
  {
    const FaceCrossing* first = this->Faces.Crossings + i;
    const FaceCrossing* last = first + step - 1;
    const auto isBefore = [this, first](const CellHit& hit)
    { return hit.T < first->T - this->Slack; };
    const auto isBehind = [this, last](const CellHit& hit)
    { return hit.T > last->T + this->Slack; };
    begin = std::find_if_not(begin, hits.end(), isBefore);
    const auto end = std::find_if(begin, hits.end(), isBehind);
    std::vector<CellHit> segment(begin, end);
    this->MatchParity(first, step, differences, segment);
    bool isInside = IsInside(first->Interpolate(differences));
    for (CellHit& hit : segment)
    {
      isInside = !isInside;
      hit.Entering = isInside;
      hit.T = std::clamp(hit.T, first->T, std::max(first->T, last->T));
      this->Hits.push_back(hit);
    }
    begin = end;
  }
}

//------------------------------------------------------------------------------
int CellHits::GetStep() const
{
  return this->Faces.AreSegments() ? 2 : this->Faces.Count;
}

//------------------------------------------------------------------------------
bool CellHits::IsInSegment(double t) const
{
  const int step = this->GetStep();
  for (int i = 0; i < this->Faces.Count; i += step)
  {
    if (t >= this->Faces.Crossings[i].T - this->Slack &&
      t <= this->Faces.Crossings[i + step - 1].T + this->Slack)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/// If the signs at crossings ask for one hit more or less, rounding decided about one on a face.
void CellHits::MatchParity(const FaceCrossing* crossings, int count, const double* differences,
  std::vector<CellHit>& hits) const
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
  if (!isOdd)
  {
    return;
  }
  const auto distance = [nearest](const CellHit& hit) { return std::abs(hit.T - nearest->T); };
  const auto extra = std::min_element(hits.begin(), hits.end(),
    [&distance](const CellHit& a, const CellHit& b) { return distance(a) < distance(b); });
  const double length = crossings[count - 1].T - crossings[0].T;
  if (extra != hits.end() && distance(*extra) <= 1e-6 * length)
  {
    hits.erase(extra);
    return;
  }
  CellHit missing = this->MakeHitOnFace(*nearest);
  missing.Entering = nearest->Entering != IsInside(nearest->Interpolate(differences));
  hits.insert(nearest == crossings ? hits.begin() : hits.end(), missing);
}

//------------------------------------------------------------------------------
CellHit CellHits::MakeHitOnFace(const FaceCrossing& crossing) const
{
  CornerWeights weights = {};
  AddWeights(crossing, 1.0, weights);
  return { crossing.T, GetParametric(this->Cell->Shape, weights), false };
}

//------------------------------------------------------------------------------
CellHit CellHits::MakeHit(const Vector3& trilinear, const TrilinearSystem& system) const
{
  const CellCorners ts =
    MakeTrilinear(*this->Cell, [this](int corner) { return this->Points[corner].T; });
  const std::array<Vector3, 3> rows = system.GetJacobian(trilinear);
  const Vector3 along = Cross(rows[0], rows[1]);
  const bool isRising = Dot(along, rows[2]) > 0.0;
  const bool isForward = Dot(along, InterpolantGradient(ts, trilinear)) > 0.0;
  return { Interpolate(ts, trilinear), GetParametric(this->Cell->Shape, trilinear),
    isRising == isForward };
}

}
