// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearSearch_h
#define TrilinearSearch_h

#include "Math/Arithmetic.h"
#include "Math/Compiler.h"
#include "Rays/TrilinearHits.h"

namespace vtkIsosurfaceRayTracing
{

/// The hits of a ray with an isosurface in a trilinear cell, in no order.
struct TrilinearSolutions
{
  static constexpr int Capacity = 4;
  /// Solutions nearer to each other, next to the border of two parts, are one.
  static constexpr double LeastDistance = 4e-8;

  /// Whether all were found.
  bool AreComplete;
  /// Whether, besides, all are sure: see TrilinearHits.
  bool AreCertain;
  int Count;
  double T[Capacity];
  double Parametric[Capacity][3];
  bool Entering[Capacity];

  SIMD_INLINE bool HasNear(const double parametric[3]) const
  {
    for (int i = 0; i < this->Count; ++i)
    {
      double distance = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        distance = Max(distance, Abs(parametric[axis] - this->Parametric[i][axis]));
      }
      if (distance < LeastDistance)
      {
        return true;
      }
    }
    return false;
  }

  SIMD_INLINE void Add(double t, const double parametric[3], bool isEntering)
  {
    if (this->Count == Capacity)
    {
      this->GiveUp();
      return;
    }
    this->T[this->Count] = t;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Parametric[this->Count][axis] = parametric[axis];
    }
    this->Entering[this->Count++] = isEntering;
  }

  SIMD_INLINE void GiveUp() { this->AreComplete = this->AreCertain = false; }
};

/// A part of a trilinear cell, in coordinates of the cell between -1 and 1.
struct TrilinearPart
{
  /// After so many contractions and bisections a part is given up.
  static constexpr int MaximumCuts = 10;

  /// That of the cell and its ray.
  int Pair;
  int Cuts;
  double Middle[3];
  double Half[3];

  /// The part of this one between low and high, in its own coordinates.
  SIMD_INLINE TrilinearPart Cut(const double low[3], const double high[3]) const
  {
    TrilinearPart part = { this->Pair, this->Cuts + 1, {}, {} };
    for (int i = 0; i < 3; ++i)
    {
      part.Middle[i] = this->Middle[i] + this->Half[i] * 0.5 * (low[i] + high[i]);
      part.Half[i] = this->Half[i] * 0.5 * (high[i] - low[i]);
    }
    return part;
  }
};

/// Finds all hits of rays in cells, so many pairs at most, by contraction and bisection of parts:
/// as many at once as a Number has lanes. What it finds for a pair depends on no other pair.
///
/// A Source loads the corners of cells, for some parts of them, into the lanes of TrilinearHits;
/// behind the last of the parts it is repeated.
template <typename Number, int Lanes, int MaximumPairs, typename Source>
class TrilinearSearch
{
public:
  SIMD_INLINE TrilinearSearch(const Source& source, TrilinearSolutions* solutions)
    : TheSource(source)
    , Solutions(solutions)
  {
  }

  SIMD_INLINE void Solve(int pairs)
  {
    for (int first = 0; first < pairs; first += Lanes)
    {
      for (this->Count = 0; this->Count < Lanes && first + this->Count < pairs; ++this->Count)
      {
        const int pair = first + this->Count;
        this->Solutions[pair].AreComplete = true;
        this->Solutions[pair].AreCertain = true;
        this->Solutions[pair].Count = 0;
        this->Parts[this->Count] = { pair, 0, { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 } };
      }
      this->SolveParts(true);
    }
    while (this->Waiting > 0)
    {
      this->Count = this->Waiting < Lanes ? this->Waiting : Lanes;
      this->Waiting -= this->Count;
      for (int lane = 0; lane < this->Count; ++lane)
      {
        this->Parts[lane] = this->Stack[this->Waiting + lane];
      }
      this->SolveParts(false);
    }
  }

private:
  using LaneSet = unsigned int;

  /// Not zero: in the middle of symmetric cells there may be solutions, and none may be in two
  /// parts.
  static constexpr double Section = 0x1p-5;

  SIMD_INLINE void SolveParts(bool areWhole)
  {
    TrilinearHits<Number> hits;
    this->TheSource.Load(this->Parts, this->Count, areWhole, hits);
    hits.Find(areWhole);
    const LaneSet all = (1U << this->Count) - 1U;
    const LaneSet found = all & ToBits(hits.HasHit);
    const LaneSet open = all & ToBits(hits.IsOpen);
    const LaneSet unsure = all & ToBits(hits.IsUnsure);
    this->MarkUnsure(unsure);
    this->Keep(hits, found, unsure);
    this->Divide(hits, open);
    this->GiveUp(all & ~(found | open | ToBits(hits.IsEmpty)));
  }

  SIMD_INLINE void MarkUnsure(LaneSet lanes)
  {
    for (; lanes != 0; lanes &= lanes - 1)
    {
      this->Solutions[this->Parts[LowestBit(lanes)].Pair].AreCertain = false;
    }
  }

  SIMD_INLINE void Keep(const TrilinearHits<Number>& hits, LaneSet found, LaneSet unsure)
  {
    if (found == 0)
    {
      return;
    }
    double t[Lanes];
    double parametric[3][Lanes];
    Store(hits.T, t);
    for (int i = 0; i < 3; ++i)
    {
      Store(hits.Parametric[i], parametric[i]);
    }
    const LaneSet entering = ToBits(hits.Entering);
    for (; found != 0; found &= found - 1)
    {
      const int lane = LowestBit(found);
      TrilinearSolutions& solutions = this->Solutions[this->Parts[lane].Pair];
      const double point[3] = { parametric[0][lane], parametric[1][lane], parametric[2][lane] };
      if ((unsure >> lane & 1U) == 0 || !solutions.HasNear(point))
      {
        solutions.Add(t[lane], point, (entering >> lane & 1U) != 0);
      }
    }
  }

  /// Contracts parts, or bisects them across the longest edge.
  SIMD_INLINE void Divide(const TrilinearHits<Number>& hits, LaneSet open)
  {
    if (open == 0)
    {
      return;
    }
    double low[3][Lanes];
    double high[3][Lanes];
    for (int i = 0; i < 3; ++i)
    {
      Store(hits.Low[i], low[i]);
      Store(hits.High[i], high[i]);
    }
    const LaneSet smaller = ToBits(hits.IsSmaller);
    for (; open != 0; open &= open - 1)
    {
      const int lane = LowestBit(open);
      const TrilinearPart& part = this->Parts[lane];
      if (part.Cuts == TrilinearPart::MaximumCuts)
      {
        this->GiveUp(1U << lane);
        continue;
      }
      if ((smaller >> lane & 1U) != 0)
      {
        const double lowest[3] = { low[0][lane], low[1][lane], low[2][lane] };
        const double highest[3] = { high[0][lane], high[1][lane], high[2][lane] };
        this->Stack[this->Waiting++] = part.Cut(lowest, highest);
        continue;
      }
      const double* h = part.Half;
      const int axis = h[0] >= h[1] && h[0] >= h[2] ? 0 : (h[1] >= h[2] ? 1 : 2);
      double lowest[3] = { -1.0, -1.0, -1.0 };
      double highest[3] = { 1.0, 1.0, 1.0 };
      lowest[axis] = Section;
      this->Stack[this->Waiting++] = part.Cut(lowest, highest);
      lowest[axis] = -1.0;
      highest[axis] = Section;
      this->Stack[this->Waiting++] = part.Cut(lowest, highest);
    }
  }

  SIMD_INLINE void GiveUp(LaneSet lanes)
  {
    for (; lanes != 0; lanes &= lanes - 1)
    {
      this->Solutions[this->Parts[LowestBit(lanes)].Pair].GiveUp();
    }
  }

  const Source& TheSource;
  TrilinearSolutions* Solutions;
  /// Those in the lanes.
  TrilinearPart Parts[Lanes];
  int Count = 0;
  /// Those that wait, cut more often from the first to the last one. Each pair leaves two at most;
  /// when the last ones are taken, all that were cut more often are, and each leaves two again.
  TrilinearPart Stack[2 * MaximumPairs + 2 * Lanes * TrilinearPart::MaximumCuts];
  int Waiting = 0;
};

}

#endif
