// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Tally.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

namespace HardCases
{
namespace
{

using Oracle::Piece;
using Oracle::Quad;

constexpr char TableHead[] =
  "| case | rays | hits | misses | false hits | p99 dt | max dt | max angle | note |\n"
  "|---|---|---|---|---|---|---|---|---|\n";

std::string ToString(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.1e", value);
  return text;
}

}

//------------------------------------------------------------------------------
/// A hit, located on the exact line.
struct Tally::LocatedHit
{
  Quad T;
  /// The distance of the point of the hit from the line, and of its T from its point.
  double Beside;
  bool Entering;
  Index Cell;
  const Hit* TheHit;
};

//------------------------------------------------------------------------------
/// A part of the line between two points that are clearly on one side of the surface each.
struct Tally::Interval
{
  Quad Begin;
  Quad End;
  /// Whether they are on different sides, and the second is inside.
  bool Crosses;
  bool Entering;
  /// Whether the interpolant comes as near to the isovalue between them as rounding can move it.
  bool InBand;
  /// Whether one of the two points is missing: the line begins or ends in the band.
  bool IsOpen;
  /// The pieces it is made of; a crossing out of the band is in the last.
  std::size_t FirstPiece;
  std::size_t LastPiece;
  std::vector<LocatedHit> Hits;

  /// How well a hit fits in here; 0 if not at all. Slack is the tolerance of its position.
  int GetRank(const LocatedHit& located, const Quad& slack) const
  {
    if (located.T < this->Begin - slack || located.T > this->End + slack)
    {
      return 0;
    }
    const bool isWithin = located.T >= this->Begin && located.T <= this->End;
    const bool isFree = this->Crosses && this->Entering == located.Entering && this->Hits.empty();
    return (isWithin ? 3 : 1) + (isFree ? 2 : (this->InBand ? 1 : 0));
  }
};

struct Tally::Context
{
  const Field& TheField;
  double Isovalue;
  const Line& TheLine;
  const Guarantee& Guaranteed;
  Tracer& TheTracer;
};

//------------------------------------------------------------------------------
Tally::LocatedHit Tally::Crossing(const Tracer& tracer, const Line& line, const Hit& hit)
{
  const Index cell = tracer.GetCell(hit);
  Oracle::QuadTriple way;
  Quad along = 0;
  Quad square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Quad direction = line.Direction[axis];
    way[axis] = (static_cast<Quad>(cell[axis]) + static_cast<Quad>(hit.Parametric[axis])) -
      static_cast<Quad>(line.Origin[axis]);
    along += way[axis] * direction;
    square += direction * direction;
  }
  const Quad t = along / square;
  const double length = Oracle::Length(line.Direction);
  double beside = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Quad off = way[axis] - t * static_cast<Quad>(line.Direction[axis]);
    beside = std::max(beside, std::abs(static_cast<double>(off)));
  }
  // A double of this magnitude has no more digits.
  const double digits = std::abs(hit.T) * length * 0x1p-51;
  const double tOff = std::abs(static_cast<double>((hit.T - t) * length));
  return { t, std::max(beside, tOff - digits), hit.Entering, cell, &hit };
}

//------------------------------------------------------------------------------
double Tally::Distance(const Context& context, const LocatedHit& located, const Quad& root)
{
  const auto along = static_cast<double>(
    Oracle::Absolute(located.T - root) * Oracle::Length(context.TheLine.Direction));
  return std::max(along, located.Beside);
}

//------------------------------------------------------------------------------
bool Tally::IsNear(const Context& context, const LocatedHit& located, const Quad& root)
{
  return Distance(context, located, root) <= context.Guaranteed.Accuracy;
}

//------------------------------------------------------------------------------
/// Whether rounding of the size of the band moves a root by no more than the guaranteed accuracy.
bool Tally::IsWellConditioned(const Context& context, const Index& cell, const Quad& root)
{
  const Quad slope = Oracle::Absolute(
    Oracle::SlopeAt(context.TheField, context.Isovalue, context.TheLine, cell, root));
  return context.Guaranteed.Band <= context.Guaranteed.Accuracy * slope;
}

//------------------------------------------------------------------------------
/// Whether the interpolant is so close to the isovalue at a hit that rounding explains it.
bool Tally::IsExplained(const Context& context, const LocatedHit& located)
{
  const Quad residual = Oracle::Absolute(
    Oracle::ValueAt(context.TheField, context.Isovalue, context.TheLine, located.Cell, located.T));
  return residual <= context.Guaranteed.Band && located.Beside <= context.Guaranteed.Accuracy;
}

//------------------------------------------------------------------------------
bool Tally::IsNearRoot(const Context& context, const std::vector<Piece>& pieces,
  const Interval& interval, const LocatedHit& located)
{
  for (std::size_t i = interval.FirstPiece; i <= interval.LastPiece; ++i)
  {
    const bool crosses = (pieces[i].AtBegin >= 0) != (pieces[i].AtEnd >= 0);
    if (crosses &&
      IsNear(context, located,
        Oracle::FindCrossing(context.TheField, context.Isovalue, context.TheLine, pieces[i])))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
Guarantee RobustGuarantee(const Index& dimensions)
{
  const int longest = *std::max_element(dimensions.begin(), dimensions.end());
  return { RootSolver::Robust, (32.0 + 16.0 * longest) * 0x1p-53, 1e-9, 1e-6 };
}

//------------------------------------------------------------------------------
Tally::Tally(std::string name)
  : Name(std::move(name))
{
}

//------------------------------------------------------------------------------
void Tally::Check(
  const Field& field, double isovalue, const std::vector<Line>& lines, ScalarType type)
{
  Tracer tracer(field, {}, type);
  this->CheckHits(field, isovalue, lines, tracer.Cast(lines, isovalue),
    RobustGuarantee(field.Dimensions), tracer);
}

//------------------------------------------------------------------------------
void Tally::CheckHits(const Field& field, double isovalue, const std::vector<Line>& lines,
  const RayHits& hits, const Guarantee& guarantee, Tracer& tracer)
{
  this->Expect(guarantee);
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    this->CheckLine(field, isovalue, lines[i], hits.Hits.data() + hits.First[i],
      hits.Hits.data() + hits.First[i + 1], guarantee, tracer);
  }
  this->Rays += lines.size();
  this->Hits += hits.Hits.size();
}

//------------------------------------------------------------------------------
void Tally::Count(std::size_t rays, std::size_t hits, std::size_t misses, std::size_t falseHits)
{
  this->Rays += rays;
  this->Hits += hits;
  this->Misses += misses;
  this->FalseHits += falseHits;
}

//------------------------------------------------------------------------------
void Tally::Note(const std::string& note)
{
  this->Notes += (this->Notes.empty() ? "" : "; ") + note;
}

//------------------------------------------------------------------------------
std::vector<Tally::Interval> Tally::FindIntervals(
  const std::vector<Piece>& pieces, double band) const
{
  std::vector<Interval> intervals;
  bool hasAnchor = false;
  bool isInside = false;
  bool inBand = false;
  Quad since = 0;
  Quad last = 0;
  std::size_t sincePiece = 0;
  std::size_t lastPiece = 0;
  const auto closeChain = [&]()
  {
    if (inBand)
    {
      intervals.push_back({ since, last, false, false, true, true, sincePiece, lastPiece, {} });
    }
    hasAnchor = inBand = false;
  };
  const auto pass = [&](std::size_t piece, const Quad& t, const Quad& value, bool isInBand)
  {
    last = t;
    lastPiece = piece;
    if (isInBand)
    {
      inBand = true;
      return;
    }
    const bool nowInside = value >= 0;
    if (inBand || (hasAnchor && nowInside != isInside))
    {
      intervals.push_back({ since, t, hasAnchor && nowInside != isInside, nowInside, inBand,
        !hasAnchor, sincePiece, piece, {} });
    }
    since = t;
    sincePiece = piece;
    hasAnchor = true;
    isInside = nowInside;
    inBand = false;
  };
  const auto isNear = [band](const Quad& value) { return Oracle::Absolute(value) <= band; };
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const Piece& piece = pieces[i];
    if (!piece.Continues)
    {
      closeChain();
      since = piece.Begin;
      sincePiece = i;
    }
    // Where two cells meet, each has its own unit.
    const bool joins = piece.Continues && i > 0 && pieces[i - 1].End == piece.Begin;
    const bool isJoined =
      i + 1 < pieces.size() && pieces[i + 1].Continues && pieces[i + 1].Begin == piece.End;
    pass(i, piece.Begin, piece.AtBegin,
      isNear(piece.AtBegin) || (joins && isNear(pieces[i - 1].AtEnd)));
    pass(i, piece.End, piece.AtEnd,
      isNear(piece.AtEnd) || (isJoined && isNear(pieces[i + 1].AtBegin)));
  }
  closeChain();
  return intervals;
}

//------------------------------------------------------------------------------
void Tally::CheckLine(const Field& field, double isovalue, const Line& line, const Hit* first,
  const Hit* last, const Guarantee& guarantee, Tracer& tracer)
{
  const std::vector<Piece> pieces = Oracle::FindPieces(field, isovalue, line);
  std::vector<Interval> intervals = this->FindIntervals(pieces, guarantee.Band);
  const Quad slack = guarantee.Accuracy / Oracle::Length(line.Direction);
  std::size_t from = 0; // intervals and hits are in order
  for (const Hit* hit = first; hit != last; ++hit)
  {
    const LocatedHit located = Crossing(tracer, line, *hit);
    while (from < intervals.size() && located.T > intervals[from].End + 4 * slack)
    {
      ++from;
    }
    Interval* best = nullptr;
    int rankOfBest = 0;
    for (std::size_t i = from; i < intervals.size(); ++i)
    {
      Interval& interval = intervals[i];
      if (located.T < interval.Begin - slack)
      {
        break;
      }
      const int rank = interval.GetRank(located, slack);
      if (rank > rankOfBest)
      {
        rankOfBest = rank;
        best = &interval;
      }
    }
    if (best)
    {
      best->Hits.push_back(located);
      continue;
    }
    // In the volume the band would have an interval there: by the exact arithmetic the line has
    // just left, along a face of the volume or through its edge.
    if (IsExplained({ field, isovalue, line, guarantee, tracer }, located))
    {
      ++this->InBandHits;
      continue;
    }
    ++this->FalseHits;
    this->PrintFailure("false hit", isovalue, line, located.T);
  }

  bool isInBand = false;
  for (const Interval& interval : intervals)
  {
    isInBand = isInBand || interval.InBand;
    this->Measure({ field, isovalue, line, guarantee, tracer }, pieces, interval);
  }
  this->InBandRays += isInBand ? 1 : 0;
}

//------------------------------------------------------------------------------
void Tally::Measure(
  const Context& context, const std::vector<Piece>& pieces, const Interval& interval)
{
  const auto printFailure = [this, &context](const char* what, const Quad& t)
  { this->PrintFailure(what, context.Isovalue, context.TheLine, t); };
  const std::size_t count = interval.Hits.size();
  if (interval.Crosses && count == 0)
  {
    // Where the line runs along a face of the volume, rounding may take it out of it.
    const Piece& last = pieces[interval.LastPiece];
    const Quad root =
      Oracle::FindCrossing(context.TheField, context.Isovalue, context.TheLine, last);
    if (Oracle::IsAtBorder(
          context.TheField, context.TheLine, last.Cell, root, context.Guaranteed.Band))
    {
      return;
    }
    ++this->Misses;
    printFailure("miss", interval.Begin);
    return;
  }
  if (!interval.IsOpen && (count % 2 == 1) != interval.Crosses)
  {
    ++this->FalseHits;
    printFailure("wrong parity", interval.Begin);
    return;
  }
  if (!interval.InBand && count == 1)
  {
    this->MeasureRoot(context, pieces[interval.LastPiece], interval.Hits[0]);
    return;
  }
  // Near a triple root there is no extremum, and yet rounding makes three crossings of one: a hit
  // that is one of several must be explained by the band.
  this->InBandHits += count;
  for (const LocatedHit& located : interval.Hits)
  {
    if (!IsExplained(context, located) && !IsNearRoot(context, pieces, interval, located))
    {
      ++this->Unexplained;
      printFailure("unexplained in the band", located.T);
    }
  }
  // Clear crossings must be found, whatever happens beside them.
  for (std::size_t i = interval.FirstPiece; i <= interval.LastPiece; ++i)
  {
    const Piece& piece = pieces[i];
    if ((piece.AtBegin >= 0) == (piece.AtEnd >= 0))
    {
      continue;
    }
    const Quad root =
      Oracle::FindCrossing(context.TheField, context.Isovalue, context.TheLine, piece);
    // Where two cells meet in the band at an angle, roots on both sides of the face may vanish.
    const double length = Oracle::Length(context.TheLine.Direction);
    const double apart =
      static_cast<double>(std::min(root - piece.Begin, piece.End - root)) * length;
    const bool isWithin = root > interval.Begin && root < interval.End;
    const bool isApart = isWithin && apart > 2.0 * context.Guaranteed.Accuracy;
    if (isApart && !interval.IsOpen && IsWellConditioned(context, piece.Cell, root) &&
      std::none_of(interval.Hits.begin(), interval.Hits.end(),
        [&](const LocatedHit& located) { return IsNear(context, located, root); }))
    {
      ++this->Misses;
      printFailure("miss in the band", root);
    }
  }
}

//------------------------------------------------------------------------------
void Tally::MeasureRoot(const Context& context, const Piece& piece, const LocatedHit& located)
{
  const Field& field = context.TheField;
  const Line& line = context.TheLine;
  const Quad root = Oracle::FindCrossing(field, context.Isovalue, line, piece);
  const double error = Distance(context, located, root);
  if (!IsWellConditioned(context, piece.Cell, root))
  {
    ++this->IllConditioned;
    this->LargestIllConditionedError = std::max(this->LargestIllConditionedError, error);
    if (!IsExplained(context, located))
    {
      ++this->Unexplained;
      this->PrintFailure("unexplained", context.Isovalue, line, root);
    }
    return;
  }
  this->Errors.push_back(error);
  if (error > context.Guaranteed.Accuracy)
  {
    this->PrintFailure("inaccurate", context.Isovalue, line, root);
  }
  if (!this->AreNormalsChecked)
  {
    return;
  }
  const auto exact = Oracle::GradientAt(field, context.Isovalue, line, located.Cell, root);
  if (Oracle::Absolute(exact[0]) + Oracle::Absolute(exact[1]) + Oracle::Absolute(exact[2]) > 1e-2)
  {
    const Triple found = context.TheTracer.GetField().GetGradient(
      *located.TheHit, vtkIsosurfaceRayTracing::NormalMode::InterpolantGradient);
    this->LargestAngle = std::max(this->LargestAngle, Oracle::AngleBetween(found, exact));
  }
}

//------------------------------------------------------------------------------
void Tally::PrintFailure(const char* what, double isovalue, const Line& line, const Quad& t)
{
  if (++this->Failures > 3)
  {
    return;
  }
  std::printf("%s: %s: isovalue %a, origin %a %a %a, direction %a %a %a, near t %.17g\n",
    this->Name.c_str(), what, isovalue, line.Origin[0], line.Origin[1], line.Origin[2],
    line.Direction[0], line.Direction[1], line.Direction[2], static_cast<double>(t));
}

//------------------------------------------------------------------------------
void Tally::Report()
{
  std::sort(this->Errors.begin(), this->Errors.end());
  const std::size_t count = this->Errors.size();
  const double p99 = count == 0 ? 0.0 : this->Errors[(count - 1) * 99 / 100];
  const double largest = count == 0 ? 0.0 : this->Errors.back();
  std::ostringstream row;
  row << "| " << this->Name << " | " << this->Rays << " | " << this->Hits << " | " << this->Misses
      << " | " << this->FalseHits << " | " << (count ? ToString(p99) : "-") << " | "
      << (count ? ToString(largest) : "-") << " | "
      << (this->LargestAngle > 0.0 ? ToString(this->LargestAngle) : "-") << " | ";
  if (this->InBandRays > 0)
  {
    this->Note(std::to_string(this->InBandRays) + " rays in the band, " +
      std::to_string(this->InBandHits) + " hits there");
  }
  if (this->IllConditioned > 0)
  {
    this->Note(std::to_string(this->IllConditioned) + " ill-conditioned hits, dt up to " +
      ToString(this->LargestIllConditionedError));
  }
  row << this->Notes << " |\n";
  std::cout << row.str();
  if (const char* path = std::getenv("HARD_CASES_TABLE"))
  {
    const bool isNew = !std::ifstream(path).good();
    std::ofstream(path, std::ios::app) << (isNew ? TableHead : "") << row.str();
  }
  EXPECT_EQ(this->Misses, 0U) << this->Name;
  EXPECT_EQ(this->FalseHits, 0U) << this->Name;
  EXPECT_EQ(this->Unexplained, 0U) << this->Name;
  EXPECT_LE(largest, this->Accuracy) << this->Name;
  EXPECT_LE(this->LargestAngle, this->Normal) << this->Name;
}

}
