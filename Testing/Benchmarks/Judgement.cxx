// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Judgement.h"

#include "Contestant.h"

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
std::vector<double> FindTruth(const Input& input, const std::vector<Oracle::Line>& lines)
{
  std::vector<double> truth(lines.size(), Nothing);
#pragma omp parallel for schedule(dynamic, 16)
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    for (const Oracle::Piece& piece : Oracle::FindPieces(input.Field, input.Isovalue, lines[i]))
    {
      const bool beginsInside = IsInside(piece.AtBegin);
      if (beginsInside != IsInside(piece.AtEnd))
      {
        const bool isCrossing = (piece.AtBegin >= 0) != (piece.AtEnd >= 0);
        truth[i] = static_cast<double>(isCrossing
            ? Oracle::FindCrossing(input.Field, input.Isovalue, lines[i], piece)
            : (beginsInside ? piece.Begin : piece.End));
        break;
      }
    }
  }
  return truth;
}

//------------------------------------------------------------------------------
double GetError(double found, double truth)
{
  if (std::isnan(found) != std::isnan(truth))
  {
    return std::numeric_limits<double>::infinity();
  }
  return found == Somewhere ? UnknownError : std::abs(found - truth);
}

//------------------------------------------------------------------------------
double Judgement::GetError(double share) const
{
  if (this->Errors.empty())
  {
    return NotMeasured;
  }
  const auto last = static_cast<double>(this->Errors.size() - 1);
  return this->Errors[static_cast<std::size_t>(std::lround(share * last))];
}

//------------------------------------------------------------------------------
Judgement Judge(const std::vector<double>& found, const std::vector<double>& truth)
{
  constexpr double wrong = 0.05;
  Judgement judgement;
  judgement.Rays = static_cast<int>(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    judgement.Hits += std::isnan(truth[i]) ? 0 : 1;
    judgement.Missed += std::isnan(found[i]) && !std::isnan(truth[i]) ? 1 : 0;
    judgement.Invented += !std::isnan(found[i]) && std::isnan(truth[i]) ? 1 : 0;
    const double error = Benchmark::GetError(found[i], truth[i]);
    if (std::isfinite(error) && error != UnknownError)
    {
      judgement.Errors.push_back(error);
      judgement.Wrong += error > wrong ? 1 : 0;
    }
  }
  std::sort(judgement.Errors.begin(), judgement.Errors.end());
  return judgement;
}

}
