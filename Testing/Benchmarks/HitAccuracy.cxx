// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "HitAccuracy.h"

#include "IsosurfaceRenderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Benchmark
{
namespace
{

/// What is equal to the isovalue is inside. On a face whose corners all are, 113 bits may come out
/// a little below.
bool IsInside(const Oracle::Quad& value)
{
  return value >= -1e-26;
}

}

//------------------------------------------------------------------------------
std::vector<double> FindReference(const Input& input, const std::vector<Oracle::Line>& lines)
{
  std::vector<double> reference(lines.size(), NoHit);
#pragma omp parallel for schedule(dynamic, 16)
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    for (const Oracle::Piece& piece : Oracle::FindPieces(input.Field, input.Isovalue, lines[i]))
    {
      const bool beginsInside = IsInside(piece.AtBegin);
      if (beginsInside != IsInside(piece.AtEnd))
      {
        const bool isCrossing = (piece.AtBegin >= 0) != (piece.AtEnd >= 0);
        reference[i] = static_cast<double>(isCrossing
            ? Oracle::FindCrossing(input.Field, input.Isovalue, lines[i], piece)
            : (beginsInside ? piece.Begin : piece.End));
        break;
      }
    }
  }
  return reference;
}

//------------------------------------------------------------------------------
double GetError(double found, double reference)
{
  if (std::isnan(found) != std::isnan(reference))
  {
    return std::numeric_limits<double>::infinity();
  }
  return found == HitAtUnknownDistance ? UnknownError : std::abs(found - reference);
}

//------------------------------------------------------------------------------
double HitAccuracy::GetError(double share) const
{
  if (this->Errors.empty())
  {
    return NotMeasured;
  }
  const auto last = static_cast<double>(this->Errors.size() - 1);
  return this->Errors[static_cast<std::size_t>(std::lround(share * last))];
}

//------------------------------------------------------------------------------
HitAccuracy MeasureAccuracy(const std::vector<double>& found, const std::vector<double>& reference)
{
  constexpr double tolerance = 0.05;
  HitAccuracy accuracy;
  accuracy.Rays = static_cast<int>(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    accuracy.Hits += std::isnan(reference[i]) ? 0 : 1;
    accuracy.Missed += std::isnan(found[i]) && !std::isnan(reference[i]) ? 1 : 0;
    accuracy.Invented += !std::isnan(found[i]) && std::isnan(reference[i]) ? 1 : 0;
    const double error = Benchmark::GetError(found[i], reference[i]);
    if (std::isfinite(error) && error != UnknownError)
    {
      accuracy.Errors.push_back(error);
      accuracy.Displaced += error > tolerance ? 1 : 0;
    }
  }
  std::sort(accuracy.Errors.begin(), accuracy.Errors.end());
  return accuracy;
}

}
