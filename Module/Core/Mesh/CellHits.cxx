// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellHits.h"

#include "Mesh/CornerOrder.h"
#include "Mesh/ShapeFunctions.h"
#include "Mesh/Slab.h"
#include "Rays/TetrahedronHits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The volume that the rows of a Jacobian span, as a part of the product of their lengths, is 0 for
/// a ray in the surface, but for rounding: some 1e-16, and more in cells that are nearly flat.
constexpr double LeastVolume = 1e-8;

/// More than what rounding may move solutions by: in parametric coordinates, and along the ray as a
/// part of the extent of the cell.
constexpr double Slack = 1e-9;

/// How far rounding may move a solution in a cell where it is not certain, in parametric
/// coordinates or as a part of the way of the ray through it: where values are next to nothing. It
/// is the distance by which solutions that are certain are clear of the faces
/// (TrilinearHits::LeastClearance).
constexpr double UncertainSlack = 1e-6;

/// Whether a solution is within the cell and a point of its own, clearly: neither on the border nor
/// one of many (a ray in the surface).
bool IsIsolated(const Vector3& solution, const TrilinearSystem& system)
{
  const std::array<Vector3, 3> rows = system.GetJacobian(solution);
  const double volume = std::abs(Dot(rows[0], Cross(rows[1], rows[2])));
  return volume > LeastVolume * Length(rows[0]) * Length(rows[1]) * Length(rows[2]) &&
    std::all_of(
      solution.begin(), solution.end(), [](double x) { return x > Slack && x < 1.0 - Slack; });
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

/// Whether the surface passes near to a point of a cell. Where values are next to nothing on a
/// face, what is a solution but for rounding may be none.
bool IsPassed(const CellCorners& differences, const Vector3& point)
{
  bool hasInside = false;
  bool hasOutside = false;
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    Vector3 there;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double way = (corner >> axis & 1U) != 0 ? UncertainSlack : -UncertainSlack;
      there[axis] = std::clamp(point[axis] + way, 0.0, 1.0);
    }
    (IsInside(Interpolate(differences, there)) ? hasInside : hasOutside) = true;
  }
  return hasInside && hasOutside;
}

/// By rounding, those on a face may be beyond it.
void GetPoints(
  const TrilinearSolutions& solutions, const CellCorners& differences, std::vector<Vector3>& points)
{
  points.clear();
  for (int i = 0; i < solutions.Count; ++i)
  {
    const double* p = solutions.Parametric[i];
    const Vector3 point = { std::clamp(p[0], 0.0, 1.0), std::clamp(p[1], 0.0, 1.0),
      std::clamp(p[2], 0.0, 1.0) };
    if (IsPassed(differences, point))
    {
      points.push_back(point);
    }
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
Vector3 GetParametric(CellShape shape, const FaceCrossing& crossing)
{
  CornerWeights weights = {};
  for (int i = 0; i < crossing.Count; ++i)
  {
    weights[crossing.Corners[i]] += crossing.Weights[i];
  }
  return GetParametric(shape, weights);
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
    this->SlackOfT = Slack * this->GetExtent();
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
  if (this->Cell->Shape != CellShape::Tetrahedron)
  {
    return this->Find(differences, this->FindSolutions(differences));
  }
  this->Hits.clear();
  this->FindOfTetrahedron(differences);
  return this->Hits;
}

//------------------------------------------------------------------------------
const std::vector<CellHit>& CellHits::Find(
  const double* differences, const TrilinearSolutions& found)
{
  this->Hits.clear();
  if (!found.AreCertain)
  {
    this->FindBetweenFaces(differences, found);
    return this->Hits;
  }
  for (int i = 0; i < found.Count; ++i)
  {
    this->Hits.push_back(MakeCellHit(this->Cell->Shape, found, i));
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
TrilinearSolutions CellHits::FindSolutions(const double* differences) const
{
  const CornersOfCell source = { GetTraits(this->Cell->Shape).Trilinear, this->Points,
    differences };
  TrilinearSolutions found;
  TrilinearSearch<double, 1, 1, CornersOfCell>(source, &found).Solve(1);
  return found;
}

//------------------------------------------------------------------------------
void CellHits::FindBetweenFaces(const double* differences, const TrilinearSolutions& found)
{
  if (this->FindCrossings().Count == 0)
  {
    return;
  }
  if (this->FindCandidates(differences, found))
  {
    this->MatchParity(this->Faces.Crossings, this->Faces.Count, differences, this->Candidates);
    this->Hits = this->Candidates;
    return;
  }
  // A cell that is not convex may be crossed several times. What is beyond all crossings is a point
  // where the ray touches the cell.
  auto begin = this->Candidates.cbegin();
  const auto endOfAll = this->Candidates.cend();
  const int step = this->GetStep();
  for (int i = 0; i < this->Faces.Count; i += step)
  {
    const FaceCrossing* first = this->Faces.Crossings + i;
    const FaceCrossing* last = first + step - 1;
    const auto isBefore = [this, first](const CellHit& hit)
    { return hit.T < first->T - this->SlackOfT; };
    const auto isBehind = [this, last](const CellHit& hit)
    { return hit.T > last->T + this->SlackOfT; };
    begin = std::find_if_not(begin, endOfAll, isBefore);
    const auto end = std::find_if(begin, endOfAll, isBehind);
    this->Segment.assign(begin, end);
    for (CellHit& hit : this->Segment)
    {
      hit.T = std::clamp(hit.T, first->T, std::max(first->T, last->T));
    }
    this->MatchParity(first, step, differences, this->Segment);
    bool isInside = IsInside(first->Interpolate(differences));
    for (CellHit& hit : this->Segment)
    {
      isInside = !isInside;
      hit.Entering = isInside;
      this->Hits.push_back(hit);
    }
    begin = end;
  }
}

//------------------------------------------------------------------------------
/// Finds the solutions that are between crossings, in order. In a cell that is twisted over itself,
/// which is returned, there may be others.
bool CellHits::FindCandidates(const double* differences, const TrilinearSolutions& found)
{
  const TrilinearSystem system = {
    { MakeTrilinear(*this->Cell, [this](int corner) { return this->Points[corner].X; }),
      MakeTrilinear(*this->Cell, [this](int corner) { return this->Points[corner].Y; }),
      MakeTrilinear(*this->Cell, [differences](int corner) { return differences[corner]; }) }
  };
  if (found.AreComplete)
  {
    GetPoints(found, system.Functions[2], this->Solutions);
  }
  else
  {
    system.Solve(this->Solutions);
  }
  this->Candidates.clear();
  bool isTwisted = false;
  for (const Vector3& solution : this->Solutions)
  {
    const CellHit hit = this->MakeHit(solution, system);
    const bool isInSegment = this->IsInSegment(hit.T);
    const bool isIsolated = !isInSegment && IsIsolated(solution, system);
    isTwisted = isTwisted || isIsolated;
    if (isInSegment || isIsolated)
    {
      this->Candidates.push_back(hit);
    }
  }
  // Solutions come in no order, and in a cell with collapsed edges several are at one place.
  std::sort(this->Candidates.begin(), this->Candidates.end(),
    [](const CellHit& a, const CellHit& b)
    { return std::tie(a.T, a.Parametric) < std::tie(b.T, b.Parametric); });
  return isTwisted;
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
    if (t >= this->Faces.Crossings[i].T - this->SlackOfT &&
      t <= this->Faces.Crossings[i + step - 1].T + this->SlackOfT)
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
  if (extra != hits.end() && distance(*extra) <= UncertainSlack * length)
  {
    hits.erase(extra);
    return;
  }
  CellHit missing = this->MakeHitOnFace(*nearest);
  if (!this->MoveToPiece(differences, missing.T))
  {
    return;
  }
  missing.Entering = nearest->Entering != IsInside(nearest->Interpolate(differences));
  const auto isBefore = [](const CellHit& a, const CellHit& b) { return a.T < b.T; };
  hits.insert(nearest == crossings ? std::lower_bound(hits.begin(), hits.end(), missing, isBefore)
                                   : std::upper_bound(hits.begin(), hits.end(), missing, isBefore),
    missing);
}

//------------------------------------------------------------------------------
/// Moves t to where the ray is in the box of the surface, which is in the hull of the points where
/// segments between corners meet it. Returns false if the ray does not come there. (In a cell that
/// is turned inside out, signs may differ at two faces of which neither is near the surface.
/// Elsewhere, no hit is looked for: with one, what an opaque ray hits would depend on the order of
/// cells.)
bool CellHits::MoveToPiece(const double* differences, double& t) const
{
  const FrameNumbers<double>& ray = this->Frame->GetNumbers();
  // The coordinates of the ray, by that along its longest axis.
  const double rates[3] = { 1.0, ray.ShearX, ray.ShearY };
  Slab inside = { -Infinity, Infinity };
  for (std::size_t k = 0; k < 3; ++k)
  {
    double lower;
    double upper;
    this->FindBoundsOfPiece(differences, this->Frame->GetAxis(k), lower, upper);
    const Slab slab = CutToSlab(ray.Origin[k], rates[k], 1.0 / rates[k], lower, upper);
    inside = { std::max(inside.Begin, slab.Begin), std::min(inside.End, slab.End) };
  }
  if (!(inside.Begin <= inside.End))
  {
    return false;
  }
  const double ends[2] = { inside.Begin * ray.Inverse, inside.End * ray.Inverse };
  t = std::clamp(t, std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  return true;
}

//------------------------------------------------------------------------------
/// Along an axis, and room for rounding.
void CellHits::FindBoundsOfPiece(
  const double* differences, std::size_t axis, double& lower, double& upper) const
{
  lower = Infinity;
  upper = -Infinity;
  for (int a = 0; a < this->Cell->Count; ++a)
  {
    for (int b = 0; b < this->Cell->Count; ++b)
    {
      if (IsInside(differences[a]) && !IsInside(differences[b]))
      {
        const double fraction = differences[b] / (differences[b] - differences[a]);
        const double place =
          this->Cell->Points[b][axis] * (1.0 - fraction) + this->Cell->Points[a][axis] * fraction;
        lower = std::min(lower, place);
        upper = std::max(upper, place);
      }
    }
  }
  const double room = this->SlackOfT / std::abs(this->Frame->GetNumbers().Inverse) +
    0x1p-48 * std::max(std::abs(lower), std::abs(upper));
  lower -= room;
  upper += room;
}

//------------------------------------------------------------------------------
CellHit CellHits::MakeHitOnFace(const FaceCrossing& crossing) const
{
  return { crossing.T, GetParametric(this->Cell->Shape, crossing), false };
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
