// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Judgement.h"

#include <algorithm>
#include <cmath>

namespace Benchmark
{
namespace
{

constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

/// What is equal to the isovalue is inside. On a face whose corners all are, 113 bits may come out
/// a little below.
bool IsInside(const Oracle::Quad& value)
{
  return value >= -1e-26;
}

/// The difference of the neighbours along an axis per cell, one-sided at the border.
double GetDifference(const Input& input, Oracle::Index sample, std::size_t axis)
{
  Oracle::Index below = sample;
  Oracle::Index above = sample;
  below[axis] = std::max(0, sample[axis] - 1);
  above[axis] = std::min(input.Field.Dimensions[axis] - 1, sample[axis] + 1);
  return (input.Field.At(above[0], above[1], above[2]) -
           input.Field.At(below[0], below[1], below[2])) /
    (above[axis] - below[axis]);
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
  return found == SomewhereOnRay ? -1.0 : std::abs(found - truth);
}

//------------------------------------------------------------------------------
double GetQuantile(const std::vector<double>& ascending, double share)
{
  if (ascending.empty())
  {
    return Nothing;
  }
  const auto last = static_cast<double>(ascending.size() - 1);
  return ascending[static_cast<std::size_t>(std::lround(share * last))];
}

//------------------------------------------------------------------------------
double Judgement::GetError(double share) const
{
  return GetQuantile(this->Errors, share);
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
    const double error = GetError(found[i], truth[i]);
    if (std::isfinite(error) && error >= 0.0)
    {
      judgement.Errors.push_back(error);
      judgement.Wrong += error > wrong ? 1 : 0;
    }
  }
  std::sort(judgement.Errors.begin(), judgement.Errors.end());
  return judgement;
}

//------------------------------------------------------------------------------
double GetShade(
  const Input& input, const Oracle::Line& line, double hit, const Oracle::Triple& direction)
{
  Oracle::Index cell;
  Oracle::Triple place;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double x = line.Origin[axis] + hit * line.Direction[axis];
    cell[axis] = std::clamp(static_cast<int>(x), 0, input.Field.Dimensions[axis] - 2);
    place[axis] = x - cell[axis];
  }
  Oracle::Triple normal = {};
  for (int corner = 0; corner < 8; ++corner)
  {
    const Oracle::Index offset = { corner & 1, corner >> 1 & 1, corner >> 2 };
    double weight = 1.0;
    Oracle::Index sample;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      weight *= offset[axis] == 1 ? place[axis] : 1.0 - place[axis];
      sample[axis] = cell[axis] + offset[axis];
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      normal[axis] += weight * GetDifference(input, sample, axis);
    }
  }
  const double dot =
    normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2];
  const double lengths = Oracle::Length(normal) * Oracle::Length(direction);
  return lengths > 0.0 ? std::min(1.0, std::abs(dot) / lengths) : 0.0;
}

}
