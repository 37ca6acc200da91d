// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshCaps.h"

#include "Mesh/ShapeFunctions.h"
#include "Rays/PlaneRounding.h"
#include "Rays/RayFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The half-space with caps in whose plane a ray begins or ends; Hit::NoPlane if there is none.
int FindCappedPlane(const std::vector<HalfSpace>& halves, const Vector3& origin,
  const Vector3& direction, double t, RayEnd end)
{
  const auto plane = std::find_if(halves.begin(), halves.end(),
    [&](const HalfSpace& half)
    {
      const PlaneCrossing crossing = FindCrossing(half, origin, direction);
      const bool goesThrough = end == RayEnd::Begin ? crossing.Slope > 0.0 : crossing.Slope < 0.0;
      return half.IsCapped && goesThrough && crossing.T == t;
    });
  return plane != halves.end() ? static_cast<int>(plane - halves.begin()) : Hit::NoPlane;
}

/// A place on a ray, where the ray is cut, and the cell that it is in.
class CutPlace
{
public:
  CutPlace(const MeshSelection& selection, const Vector3& origin, const Vector3& direction,
    double t, RayEnd end, CellHits& inCell)
    : Selection(&selection)
    , Frame(origin, direction)
    , Point(origin + direction * t)
    , T(t)
    , End(end)
    , Margin(selection.Tree->GetMargin())
    , LeastInside(selection.Surfaces.front().Isovalue)
    , InCell(&inCell)
  {
  }

  /// Finds the cell, if it reaches an isovalue and is visible: that with the smallest number of
  /// several, which overlap.
  bool FindCell();

  const Vector3& GetPoint() const { return this->Point; }
  std::int64_t GetCell() const { return this->Number; }
  Vector3 FindParametric();
  double GetValue(const Vector3& parametric) const;
  bool IsInside(const MeshSurface& surface);

private:
  void Visit(int level, std::size_t number);
  void VisitBlock(std::size_t block);
  bool MayBeIn(const CellTreeNode& node, int child) const;
  bool MayBeInCell() const;
  bool Enter(std::int64_t number);

  const MeshSelection* Selection;
  RayFrame Frame;
  Vector3 Point;
  double T;
  RayEnd End;
  double Margin;
  /// The smallest isovalue.
  double LeastInside;
  CellHits* InCell;

  static constexpr std::int64_t NoCell = -1;
  std::int64_t Number = NoCell;
  MeshCell Cell;
  /// By which the ray enters and leaves the cell before and behind the place.
  const FaceCrossing* First = nullptr;
  const FaceCrossing* Last = nullptr;
};

//------------------------------------------------------------------------------
bool CutPlace::FindCell()
{
  const int levels = this->Selection->Tree->GetNumberOfLevels();
  if (levels > 0)
  {
    this->Visit(levels - 1, 0);
  }
  return this->Number != NoCell && this->Enter(this->Number);
}

//------------------------------------------------------------------------------
void CutPlace::Visit(int level, std::size_t number)
{
  const CellTreeNode& node = this->Selection->Tree->GetNode(level, number);
  for (int i = 0; i < CellTree::Width; ++i)
  {
    if (!this->MayBeIn(node, i))
    {
      continue;
    }
    const std::size_t child = number * CellTree::Width + static_cast<std::size_t>(i);
    if (level > 0)
    {
      this->Visit(level - 1, child);
    }
    else
    {
      this->VisitBlock(child);
    }
  }
}

//------------------------------------------------------------------------------
/// Whether a place that is inside of a surface may be in a child.
bool CutPlace::MayBeIn(const CellTreeNode& node, int child) const
{
  bool mayBe = static_cast<double>(node.High[child]) >= this->LeastInside;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    mayBe = mayBe && static_cast<double>(node.Lower[axis][child]) <= this->Point[axis] &&
      this->Point[axis] <= static_cast<double>(node.Upper[axis][child]);
  }
  return mayBe;
}

//------------------------------------------------------------------------------
/// The same for the cell that was read.
bool CutPlace::MayBeInCell() const
{
  const MeshCell& cell = this->Cell;
  bool mayBe = *std::max_element(cell.Values, cell.Values + cell.Count) >= this->LeastInside;
  for (std::size_t axis = 0; axis < 3 && mayBe; ++axis)
  {
    double lower = cell.Points[0][axis];
    double upper = lower;
    for (int i = 1; i < cell.Count; ++i)
    {
      lower = std::min(lower, cell.Points[i][axis]);
      upper = std::max(upper, cell.Points[i][axis]);
    }
    mayBe = lower - this->Margin <= this->Point[axis] && this->Point[axis] <= upper + this->Margin;
  }
  return mayBe;
}

//------------------------------------------------------------------------------
void CutPlace::VisitBlock(std::size_t block)
{
  for (int i = 0; i < this->Selection->Tree->GetNumberOfCells(block); ++i)
  {
    const std::int64_t number = this->Selection->Tree->GetCell(block, i);
    const bool isNext = this->Number == NoCell || number < this->Number;
    if (isNext && !this->Selection->Request.Visible.IsHidden(number) && this->Enter(number))
    {
      this->Number = number;
    }
  }
}

//------------------------------------------------------------------------------
/// Returns whether the place is in a cell. Of two cells that a crossing there separates it is in
/// the one that is left out otherwise: its hits at the crossing are traced, too.
bool CutPlace::Enter(std::int64_t number)
{
  if (!this->Selection->Cells->Load(number, this->Cell) || !this->MayBeInCell())
  {
    return false;
  }
  this->InCell->Enter(this->Frame, this->Cell);
  const FaceCrossings& faces = this->InCell->FindCrossings();
  const int step = this->InCell->GetStep();
  for (int i = 0; i < faces.Count; i += step)
  {
    this->First = faces.Crossings + i;
    this->Last = this->First + step - 1;
    const bool isIn = this->End == RayEnd::Begin
      ? this->First->T < this->T && this->T <= this->Last->T
      : this->First->T <= this->T && this->T < this->Last->T;
    if (isIn)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/// The place is where the ray meets the surface of points with the same t. By rounding it may not,
/// beside a face.
Vector3 CutPlace::FindParametric()
{
  double differences[MaximumCorners];
  for (int i = 0; i < this->Cell.Count; ++i)
  {
    differences[i] = this->Frame.Get(this->Cell.Points[i]).T - this->T;
  }
  const std::vector<CellHit>& hits = this->InCell->Find(differences);
  const auto distance = [this](double t) { return std::abs(t - this->T); };
  const auto nearest = std::min_element(hits.begin(), hits.end(),
    [&distance](const CellHit& a, const CellHit& b) { return distance(a.T) < distance(b.T); });
  if (nearest != hits.end())
  {
    return nearest->Parametric;
  }
  const FaceCrossing& face =
    distance(this->First->T) < distance(this->Last->T) ? *this->First : *this->Last;
  CornerWeights weights = {};
  for (int i = 0; i < face.Count; ++i)
  {
    weights[face.Corners[i]] += face.Weights[i];
  }
  return GetParametric(this->Cell.Shape, weights);
}

//------------------------------------------------------------------------------
double CutPlace::GetValue(const Vector3& parametric) const
{
  CornerWeights weights;
  GetWeights(this->Cell.Shape, parametric, weights);
  double value = 0.0;
  for (int i = 0; i < this->Cell.Count; ++i)
  {
    value += weights[i] * this->Cell.Values[i];
  }
  return value;
}

//------------------------------------------------------------------------------
bool CutPlace::IsInside(const MeshSurface& surface)
{
  const auto [lowest, highest] =
    std::minmax_element(this->Cell.Values, this->Cell.Values + this->Cell.Count);
  if (*highest < surface.Isovalue || *lowest >= surface.Isovalue)
  {
    return *lowest >= surface.Isovalue;
  }
  double differences[MaximumCorners];
  for (int i = 0; i < this->Cell.Count; ++i)
  {
    differences[i] = Difference(this->Cell.Values[i], surface.Isovalue, surface.Scale);
  }
  const bool isBegin = this->End == RayEnd::Begin;
  const double low = isBegin ? this->T : this->First->T;
  const double high = isBegin ? this->Last->T : this->T;
  const FaceCrossing& crossing = isBegin ? *this->Last : *this->First;
  bool isInside = vtkIsosurfaceRayTracing::IsInside(crossing.Interpolate(differences));
  for (const CellHit& hit : this->InCell->Find(differences))
  {
    isInside ^= low <= hit.T && hit.T <= high;
  }
  return isInside;
}

}

//------------------------------------------------------------------------------
std::vector<HalfSpace> MovePlanesIntoCells(
  const std::vector<HalfSpace>& halves, const CellTree& tree, ScalarType pointType)
{
  constexpr double rounding = 0x1p-40;
  const double ofPoints = rounding + (pointType == ScalarType::Float32 ? 0x1p-24 : 0.0);
  const Bounds& box = tree.GetBounds();
  std::vector<HalfSpace> moved = halves;
  for (HalfSpace& half : moved)
  {
    half.Offset -= half.IsCapped ? FindRounding(half, box, rounding, ofPoints) : 0.0;
  }
  return moved;
}

//------------------------------------------------------------------------------
std::optional<Hit> FindCap(
  const MeshSelection& selection, const RayPacket& packet, int ray, RayEnd end, CellHits& inCell)
{
  const bool isBegin = end == RayEnd::Begin;
  const double t = isBegin ? packet.Begin[ray] : packet.End[ray];
  const Vector3 origin = packet.GetOrigin(ray);
  const Vector3 direction = packet.GetDirection(ray);
  const int plane = FindCappedPlane(selection.HalfSpaces, origin, direction, t, end);
  if (plane == Hit::NoPlane || selection.Surfaces.empty())
  {
    return std::nullopt;
  }
  CutPlace place(selection, origin, direction, t, end, inCell);
  if (!selection.Request.Visible.Regions.Contain(place.GetPoint()) || !place.FindCell())
  {
    return std::nullopt;
  }
  // That of the largest isovalue.
  int surface = static_cast<int>(selection.Surfaces.size()) - 1;
  while (surface >= 0 && !place.IsInside(selection.Surfaces[static_cast<std::size_t>(surface)]))
  {
    --surface;
  }
  if (surface < 0)
  {
    return std::nullopt;
  }
  Hit cap = { packet.Base[ray] + t, place.GetCell(), surface, place.FindParametric(), isBegin };
  cap.Plane = plane;
  cap.Value = place.GetValue(cap.Parametric);
  return cap;
}

}
