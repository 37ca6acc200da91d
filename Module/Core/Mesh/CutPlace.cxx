// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CutPlace.h"

#include "Mesh/ShapeFunctions.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
bool CutPlace::Enter(const MeshCell& cell, CellHits& inCell)
{
  this->Cell = &cell;
  this->InCell = &inCell;
  inCell.Enter(this->Frame, cell);
  const FaceCrossings& faces = inCell.FindCrossings();
  const int step = inCell.GetStep();
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
  for (int i = 0; i < this->Cell->Count; ++i)
  {
    differences[i] = this->Frame.Get(this->Cell->Points[i]).T - this->T;
  }
  const std::vector<CellHit>& hits = this->InCell->Find(differences);
  const auto distance = [this](double t) { return std::abs(t - this->T); };
  const auto nearest = std::min_element(hits.begin(), hits.end(),
    [&distance](const CellHit& a, const CellHit& b) { return distance(a.T) < distance(b.T); });
  if (nearest != hits.end())
  {
    return nearest->Parametric;
  }
  const bool isFirstNearer = distance(this->First->T) < distance(this->Last->T);
  return GetParametric(this->Cell->Shape, isFirstNearer ? *this->First : *this->Last);
}

//------------------------------------------------------------------------------
double CutPlace::GetValue(const Vector3& parametric) const
{
  CornerWeights weights;
  GetWeights(this->Cell->Shape, parametric, weights);
  double value = 0.0;
  for (int i = 0; i < this->Cell->Count; ++i)
  {
    value += weights[i] * this->Cell->Values[i];
  }
  return value;
}

//------------------------------------------------------------------------------
bool CutPlace::IsInside(const MeshSurface& surface)
{
  const auto [lowest, highest] =
    std::minmax_element(this->Cell->Values, this->Cell->Values + this->Cell->Count);
  if (*highest < surface.Isovalue || *lowest >= surface.Isovalue)
  {
    return *lowest >= surface.Isovalue;
  }
  double differences[MaximumCorners];
  for (int i = 0; i < this->Cell->Count; ++i)
  {
    differences[i] = Difference(this->Cell->Values[i], surface.Isovalue, surface.Scale);
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
