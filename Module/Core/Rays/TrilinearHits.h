// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearHits_h
#define TrilinearHits_h

#include "Math/Arithmetic.h"
#include "Math/TrilinearCell.h"
#include "Math/TrilinearPolynomials.h"
#include "Math/Vector.h"
#include "Rays/RayFrame.h"

namespace vtkIsosurfaceRayTracing
{

/// Finds where rays meet an isosurface in parts of trilinear cells, wherever that is certain: one
/// ray, or one for each lane.
///
/// A hit is where three functions vanish: the coordinates across the ray, and the difference to the
/// isovalue. Multiplied by the inverse of their Jacobian in the middle of the part, they do where
/// x = -constant - products(x), in coordinates of the part between -1 and 1. That bounds x, and so
/// the products and their derivatives. Where the right side then changes by less than x, it is a
/// contraction: there is one solution at most. To be precise, with products that stay as they are
/// beyond the bounds there is exactly one solution in space, and it is in the part or not. (R.
/// Krawczyk: Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4,
/// 1969. With the steepness of each function along each axis as a matrix S, it is a contraction if
/// the inverse of 1 - S has no negative number; it has none if the sums of its rows are positive.
/// A. Neumaier: Interval Methods for Systems of Equations, 1990, on M-matrices.)
///
/// Whether a solution next to a face is a hit in this cell or the next, FaceCrossings decide: what
/// is sure here, rounding cannot change there. So signs chain from cell to cell, whoever finds
/// them.
template <typename Number>
class TrilinearHits
{
public:
  using Mask = decltype(Number() < Number());

  /// The coordinates of the corners across the ray, and the differences between their values and
  /// the isovalue.
  Number Functions[3][8];
  /// Their coordinates along the ray.
  Number Along[8];
  /// The part, in coordinates of the cell between -1 and 1.
  Number Middle[3];
  Number Half[3];

  /// Where the ray has one hit in the part. Only there the next three are defined.
  Mask HasHit;
  Number T;
  /// In coordinates of the cell between 0 and 1.
  Number Parametric[3];
  Mask Entering;
  /// Where rounding decides whether the hit is in the part, or through which faces of the cell the
  /// ray passes.
  Mask IsUnsure;
  /// Where it has none.
  Mask IsEmpty;
  /// Where smaller parts may tell: those between Low and High, in coordinates of this part, if they
  /// are less than half of it. Elsewhere it cannot be told here.
  Mask IsOpen;
  Mask IsSmaller;
  Number Low[3];
  Number High[3];

  SIMD_INLINE void SetCorner(int corner, const FramePointOf<Number>& point, Number difference)
  {
    this->Functions[0][corner] = point.X;
    this->Functions[1][corner] = point.Y;
    this->Functions[2][corner] = difference;
    this->Along[corner] = point.T;
  }

  SIMD_INLINE void Find(bool areWhole)
  {
    this->FindPolynomials(areWhole);
    const Mask isOrdinary =
      (0x1p-110 < this->Largest) & (this->Largest < 0x1p110) & (this->Clearance < LargestClearance);
    const Mask isAside = this->IsAside();
    this->IsEmpty = isOrdinary & isAside;
    this->HasHit = this->IsOpen = AndNot(isOrdinary, this->IsEmpty);
    this->IsUnsure = this->Largest < 0.0;
    if (!Any(this->IsOpen))
    {
      return;
    }
    if (areWhole)
    {
      this->IsUnsure = this->IsOpen & this->IsNearEdge();
    }
    this->Bound(this->System.Find(this->Polynomials));
    if (Any(this->HasHit))
    {
      this->Solve();
    }
  }

private:
  /// How far from faces a solution is certain, in coordinates of the cell: far more than what
  /// rounding moves it by, and so little that hardly any is nearer.
  static constexpr double LeastClearance = 1e-6;
  /// How far from faces rounding may move solutions.
  static constexpr double Reach = 1e-11;
  /// In coordinates of a part it is more. Thinner parts than this are given up.
  static constexpr double LargestClearance = 1e-2;
  /// So no part is made thinner than this, in coordinates of the cell: where a ray goes along the
  /// edges of a box, its solutions are known at once in two of three directions.
  static constexpr double ThinnestHalf = 0x1p-8;
  /// Beyond, contractions are too slow.
  static constexpr double LargestErrorFactor = 20.0;
  /// Of Newton's method, which then makes a last step. Hardly any solution needs more: those that
  /// do are beyond the border, and looked for in a smaller part.
  static constexpr int MaximumSteps = 5;
  static constexpr double Tolerance = 1e-8;
  /// What rounding may move functions by, in units of their coefficients.
  static constexpr double Rounding = 1e-14;

  SIMD_INLINE void FindPolynomials(bool areWhole)
  {
    this->Clearance = areWhole
      ? Number(LeastClearance)
      : LeastClearance / Min(Min(this->Half[0], this->Half[1]), this->Half[2]);
    this->Largest = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      TrilinearPolynomial<Number>& polynomial = this->Polynomials[i];
      polynomial.Set(this->Functions[i]);
      const Number size = polynomial.GetVariation() + Abs(polynomial.Coefficients[0]);
      this->Errors[i] = Rounding * size;
      this->Largest = i < 2 ? Max(this->Largest, size) : this->Largest;
      if (!areWhole)
      {
        polynomial.Restrict(this->Middle, this->Half);
      }
    }
  }

  /// Whether one of the functions has one sign in the part, clearly.
  SIMD_INLINE Mask IsAside() const
  {
    Number distance = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      const Number variation = (1.0 + 4.0 * this->Clearance) * this->Polynomials[i].GetVariation();
      distance =
        Max(distance, Abs(this->Polynomials[i].Coefficients[0]) - (variation + this->Errors[i]));
    }
    return 0.0 < distance;
  }

  /// Whether the ray comes so near to an edge of the cell that rounding decides through which face
  /// it passes: curved faces may have their other points far away.
  SIMD_INLINE Mask IsNearEdge() const
  {
    const Number* x = this->Functions[0];
    const Number* y = this->Functions[1];
    const Number tolerance = 1e-12 * this->Largest * this->Largest;
    Number distances[12];
    Number least = Infinity;
    for (int edge = 0; edge < 12; ++edge)
    {
      const int a = GetEnd(edge, 0);
      const int b = GetEnd(edge, 1);
      distances[edge] = Abs(x[a] * y[b] - x[b] * y[a]);
      least = Min(least, distances[edge]);
    }
    Mask isNear = least < tolerance;
    if (!Any(isNear))
    {
      return isNear;
    }
    // Near to the line through its ends: is it between them?
    isNear = tolerance < 0.0;
    for (int edge = 0; edge < 12; ++edge)
    {
      const int a = GetEnd(edge, 0);
      const int b = GetEnd(edge, 1);
      isNear = isNear | ((distances[edge] < tolerance) & (x[a] * x[b] + y[a] * y[b] < tolerance));
    }
    return isNear;
  }

  /// The corners at both ends of an edge.
  SIMD_INLINE static int GetEnd(int edge, int end)
  {
    const int axis = edge / 4;
    const int low = (1 << axis) - 1;
    const int others = edge % 4;
    return (others & low) | (others & ~low) << 1 | end << axis;
  }

  /// Bounds the solutions, given where the Jacobian is regular.
  SIMD_INLINE void Bound(Mask isRegular)
  {
    const Mask isSafe = isRegular & this->IsPrecise();
    const Number farthest = this->FindBounds();
    const Mask isContraction = this->IsContraction();
    Number volume = 1.0;
    for (int i = 0; i < 3; ++i)
    {
      this->Widen(i);
      volume = volume * (this->High[i] - this->Low[i]);
    }
    this->IsSmaller = isSafe & (volume < 4.0);
    this->IsEmpty = this->IsEmpty | (isSafe & (1.0 < farthest));
    this->HasHit = AndNot(isSafe, this->IsEmpty) & isContraction;
    this->IsOpen = AndNot(AndNot(this->IsOpen, this->IsEmpty), this->HasHit);
  }

  /// Where rounding is no matter in what the inverse is multiplied with.
  SIMD_INLINE Mask IsPrecise() const
  {
    Mask isPrecise = this->IsOpen;
    for (const Number(&row)[3] : this->System.Inverse)
    {
      const Number error = Abs(row[0]) * this->Errors[0] + Abs(row[1]) * this->Errors[1] +
        Abs(row[2]) * this->Errors[2];
      isPrecise = isPrecise & (8.0 * error < this->Clearance);
    }
    return isPrecise;
  }

  /// Finds the bounds, twice: within the first ones products are smaller. Returns how far away
  /// solutions are at least.
  SIMD_INLINE Number FindBounds()
  {
    Number farthest = 0.0;
    Number margins[3];
    for (int i = 0; i < 3; ++i)
    {
      this->Most[i] = 1.0;
    }
    for (int pass = 0; pass < 2; ++pass)
    {
      for (int i = 0; i < 3; ++i)
      {
        const Number size = this->System.GetSize(i, this->Most);
        if (pass == 0)
        {
          margins[i] = 4.0 * this->Clearance * (1.0 + size);
        }
        const Number reach = size + margins[i];
        const Number constant = this->System.Constant[i];
        farthest = Max(farthest, Abs(constant) - reach);
        this->Low[i] = Max(0.0 - constant - reach, Number(-1.0));
        this->High[i] = Min(reach - constant, Number(1.0));
      }
      for (int i = 0; i < 3; ++i)
      {
        this->Most[i] = Max(Abs(this->Low[i]), Abs(this->High[i]));
      }
    }
    return farthest;
  }

  /// Where it is one within the bounds. There the solution is not farther away than ErrorFactor
  /// times what is left of the functions.
  SIMD_INLINE Mask IsContraction()
  {
    Number rows[3][3];
    for (int i = 0; i < 3; ++i)
    {
      this->System.FindSteepness(i, this->Most, rows[i]);
      for (int axis = 0; axis < 3; ++axis)
      {
        rows[i][axis] = (i == axis ? 1.0 : 0.0) - rows[i][axis];
      }
    }
    Number inverse[3][3];
    InvertRows(rows, inverse);
    Mask isContraction = this->IsOpen;
    this->ErrorFactor = 0.0;
    for (const Number(&row)[3] : inverse)
    {
      const Number sum = row[0] + row[1] + row[2];
      isContraction = isContraction & (0.0 < sum) & (sum < LargestErrorFactor);
      this->ErrorFactor = Max(this->ErrorFactor, sum);
    }
    return isContraction;
  }

  /// Widens a part that would be too thin to go on with.
  SIMD_INLINE void Widen(int axis)
  {
    const Number one = 1.0;
    const Number thinnest = Min(ThinnestHalf / this->Half[axis], one);
    const Number half = Max(0.5 * (this->High[axis] - this->Low[axis]), thinnest);
    const Number middle = Clamp(0.5 * (this->Low[axis] + this->High[axis]), half - one, one - half);
    this->Low[axis] = middle - half;
    this->High[axis] = middle + half;
  }

  /// Finds the only solutions of contractions, by Newton's method.
  SIMD_INLINE void Solve()
  {
    Number x[3];
    for (int i = 0; i < 3; ++i)
    {
      x[i] = 0.0 - this->System.Constant[i];
    }
    Number farthest = 0.0;
    Number error = 0.0;
    Mask isMoving = this->HasHit;
    for (int step = 0; step < MaximumSteps; ++step)
    {
      Number inside[3];
      Number rest[3];
      const Number size = this->Evaluate(x, inside, rest);
      farthest = Max(Max(Abs(x[0]), Abs(x[1])), Abs(x[2]));
      // The solution is no farther away than this.
      error = size * this->ErrorFactor;
      this->IsEmpty = this->IsEmpty | (isMoving & (1.0 + this->Clearance + error < farthest));
      isMoving = AndNot(AndNot(isMoving, this->IsEmpty), size <= Tolerance);
      if (!Any(isMoving))
      {
        break;
      }
      Number inverse[3][3];
      this->System.InvertJacobian(inside, inverse);
      for (int i = 0; i < 3; ++i)
      {
        x[i] = Select(isMoving, x[i] - Dot(inverse[i], rest), x[i]);
      }
    }
    this->IsOpen = this->IsOpen | isMoving;
    this->HasHit = AndNot(AndNot(this->HasHit, this->IsEmpty), isMoving);
    if (Any(this->HasHit))
    {
      this->MakeHit(x, error);
      this->CheckBorder(AndNot(this->HasHit, farthest + error + this->Clearance < 1.0));
    }
  }

  /// What is left of the functions at a point, with the products of the nearest point inside.
  /// Returns the largest.
  SIMD_INLINE Number Evaluate(const Number x[3], Number inside[3], Number rest[3]) const
  {
    for (int i = 0; i < 3; ++i)
    {
      inside[i] = Clamp(x[i], 0.0 - this->Most[i], this->Most[i]);
    }
    this->System.EvaluateProducts(inside, rest);
    Number largest = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      rest[i] = this->System.Constant[i] + x[i] + rest[i];
      largest = Max(largest, Abs(rest[i]));
    }
    return largest;
  }

  /// Makes hits of solutions that are not farther away than an error, with a last step of Newton's
  /// method for the functions themselves.
  SIMD_INLINE void MakeHit(const Number x[3], Number error)
  {
    Number point[3];
    for (int i = 0; i < 3; ++i)
    {
      point[i] = 0.5 + 0.5 * (this->Middle[i] + this->Half[i] * x[i]);
    }
    // As large as the polynomials.
    const Number values[3] = { 8.0 * Interpolate(this->Functions[0], point),
      8.0 * Interpolate(this->Functions[1], point), 8.0 * Interpolate(this->Functions[2], point) };
    Number rest[3];
    Number slopes[3];
    for (int i = 0; i < 3; ++i)
    {
      rest[i] = Dot(this->System.Inverse[i], values);
      slopes[i] = this->System.Inverse[i][2];
    }
    Number inverse[3][3];
    this->System.InvertJacobian(x, inverse);
    // The way along the ray on which the difference rises.
    Number rise[3];
    for (int i = 0; i < 3; ++i)
    {
      this->Parametric[i] = point[i] - 0.5 * this->Half[i] * Dot(inverse[i], rest);
      rise[i] = this->Half[i] * Dot(inverse[i], slopes);
    }
    this->T = Interpolate(this->Along, this->Parametric);
    Number gradient[3];
    FindInterpolantGradient(this->Along, this->Parametric, gradient);
    const Number way = Dot(gradient, rise);
    const Number size =
      Abs(gradient[0] * rise[0]) + Abs(gradient[1] * rise[1]) + Abs(gradient[2] * rise[2]);
    this->Entering = 0.0 < way;
    // The Jacobian is that before the last step.
    const Number unsure = 1e-7 + 4.0 * this->ErrorFactor * error;
    this->HasHit = this->HasHit & (unsure * size < Abs(way));
  }

  /// Of the solutions near the border of the part, keeps those that may be within.
  SIMD_INLINE void CheckBorder(Mask isNear)
  {
    Number excess = -1.0;
    for (int i = 0; i < 3; ++i)
    {
      const Number x = 2.0 * this->Parametric[i] - 1.0;
      excess = Max(excess, Abs(x - this->Middle[i]) - this->Half[i]);
    }
    const Mask isBeyond = isNear & (Reach < excess);
    this->HasHit = AndNot(this->HasHit, isBeyond);
    this->IsEmpty = this->IsEmpty | isBeyond;
    this->IsUnsure = this->IsUnsure | isNear;
  }

  TrilinearPolynomial<Number> Polynomials[3];
  PreconditionedTrilinears<Number> System;
  /// The size of the coordinates across the ray, some ten times the largest.
  Number Largest;
  /// What rounding may have moved the polynomials by.
  Number Errors[3];
  /// In coordinates of the part.
  Number Clearance;
  /// The most that the coordinates of solutions may be.
  Number Most[3];
  Number ErrorFactor;
};

}

#endif
