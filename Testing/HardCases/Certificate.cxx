// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Certificate.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace Oracle
{
namespace
{

using Rational = mpq_class;
/// Coefficients of powers, lowest first; the last is not zero.
using Polynomial = std::vector<Rational>;

struct Interval
{
  Rational Begin;
  Rational End;
};

bool IsInside(const Rational& value)
{
  return sgn(value) >= 0;
}

void Trim(Polynomial& p)
{
  while (!p.empty() && sgn(p.back()) == 0)
  {
    p.pop_back();
  }
}

Rational Evaluate(const Polynomial& p, const Rational& u)
{
  Rational sum = 0;
  for (std::size_t i = p.size(); i-- > 0;)
  {
    sum = sum * u + p[i];
  }
  return sum;
}

Polynomial Derivative(const Polynomial& p)
{
  Polynomial derivative;
  for (std::size_t i = 1; i < p.size(); ++i)
  {
    derivative.push_back(p[i] * static_cast<unsigned long>(i));
  }
  return derivative;
}

Polynomial NegatedRemainder(Polynomial a, const Polynomial& b)
{
  while (a.size() >= b.size())
  {
    const Rational factor = a.back() / b.back();
    const std::size_t shift = a.size() - b.size();
    for (std::size_t i = 0; i < b.size(); ++i)
    {
      a[i + shift] -= factor * b[i];
    }
    a.pop_back(); // it is zero now
    Trim(a);
  }
  for (Rational& coefficient : a)
  {
    coefficient = -coefficient;
  }
  return a;
}

int CountSignChanges(const std::vector<Polynomial>& chain, const Rational& u)
{
  int changes = 0;
  int last = 0;
  for (const Polynomial& p : chain)
  {
    const int sign = sgn(Evaluate(p, u));
    changes += sign != 0 && last != 0 && sign != last ? 1 : 0;
    last = sign != 0 ? sign : last;
  }
  return changes;
}

/// The number of distinct roots in (0, 1), by Sturm's theorem. None of them may be 0 or 1.
int CountRoots(const Polynomial& p)
{
  std::vector<Polynomial> chain = { p, Derivative(p) };
  while (!chain.back().empty())
  {
    chain.push_back(NegatedRemainder(chain[chain.size() - 2], chain.back()));
  }
  chain.pop_back();
  return CountSignChanges(chain, 0) - CountSignChanges(chain, 1);
}

/// Divides roots at 0 away.
void DeflateAtZero(Polynomial& p)
{
  while (!p.empty() && sgn(p.front()) == 0)
  {
    p.erase(p.begin());
  }
}

/// p(1 - u)
Polynomial Reversed(const Polynomial& p)
{
  Polynomial sum;
  for (std::size_t i = p.size(); i-- > 0;)
  {
    // sum * (1 - u) + p[i]
    Polynomial product(sum.size() + 1);
    for (std::size_t k = 0; k < sum.size(); ++k)
    {
      product[k] += sum[k];
      product[k + 1] -= sum[k];
    }
    product[0] += p[i];
    sum = product;
  }
  Trim(sum);
  return sum;
}

/// Whether the sign (equal is inside) changes somewhere in [0, 1]. Where the function touches zero
/// within and turns back, it does not.
bool ChangesSign(Polynomial p)
{
  Trim(p);
  if (p.empty())
  {
    return false;
  }
  const bool inside = IsInside(Evaluate(p, 0));
  if (IsInside(Evaluate(p, 1)) != inside)
  {
    return true;
  }
  DeflateAtZero(p);
  p = Reversed(p);
  DeflateAtZero(p);
  p = Reversed(p);
  // Now the signs at the ends are those just inside of them.
  if (IsInside(Evaluate(p, 0)) != inside || IsInside(Evaluate(p, 1)) != inside)
  {
    return true;
  }
  return CountRoots(p) >= 2;
}

/// The part of a line in a cell. None if they have no more than a point in common.
std::optional<Interval> Cut(const Line& line, const Index& cell, const Interval& within)
{
  Interval part = within;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Rational origin = line.Origin[axis];
    const Rational direction = line.Direction[axis];
    if (sgn(direction) == 0)
    {
      if (origin < cell[axis] || origin > cell[axis] + 1)
      {
        return std::nullopt;
      }
      continue;
    }
    Rational a = (cell[axis] - origin) / direction;
    Rational b = (cell[axis] + 1 - origin) / direction;
    if (b < a)
    {
      std::swap(a, b);
    }
    part.Begin = std::max(part.Begin, a);
    part.End = std::min(part.End, b);
    if (part.Begin >= part.End)
    {
      return std::nullopt;
    }
  }
  return part;
}

bool LoadDifferences(
  const Field& field, double isovalue, const Index& cell, std::array<Rational, 8>& differences)
{
  for (int i = 0; i < 8; ++i)
  {
    const double value = field.At(cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2));
    if (!std::isfinite(value))
    {
      return false;
    }
    differences[static_cast<std::size_t>(i)] = Rational(value) - Rational(isovalue);
  }
  return true;
}

/// The interpolant of a cell along a part of a line, as a polynomial of the fraction of the way.
Polynomial AlongPart(const std::array<Rational, 8>& differences, const Line& line,
  const Index& cell, const Interval& part)
{
  Polynomial sum(4);
  for (std::size_t i = 0; i < 8; ++i)
  {
    Polynomial weight = { differences[i] };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Rational direction = line.Direction[axis];
      Rational at = line.Origin[axis] + part.Begin * direction - cell[axis];
      Rational slope = (part.End - part.Begin) * direction;
      if ((i >> axis & 1) == 0)
      {
        at = 1 - at;
        slope = -slope;
      }
      Polynomial product(weight.size() + 1);
      for (std::size_t k = 0; k < weight.size(); ++k)
      {
        product[k] += weight[k] * at;
        product[k + 1] += weight[k] * slope;
      }
      weight = product;
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      sum[k] += weight[k];
    }
  }
  return sum;
}

template <typename Visit>
bool AnyCell(const Field& field, const Visit& visit)
{
  for (int z = 0; z + 1 < field.Dimensions[2]; ++z)
  {
    for (int y = 0; y + 1 < field.Dimensions[1]; ++y)
    {
      for (int x = 0; x + 1 < field.Dimensions[0]; ++x)
      {
        if (visit(Index{ x, y, z }))
        {
          return true;
        }
      }
    }
  }
  return false;
}

bool HasSignChange(
  const Field& field, double isovalue, const Line& line, const Index& cell, const Interval& within)
{
  std::array<Rational, 8> differences;
  if (!LoadDifferences(field, isovalue, cell, differences))
  {
    return false;
  }
  const auto isInside = [](const Rational& value) { return IsInside(value); };
  const bool any = std::any_of(differences.begin(), differences.end(), isInside);
  const bool all = std::all_of(differences.begin(), differences.end(), isInside);
  if (any == all)
  {
    return false;
  }
  const std::optional<Interval> part = Cut(line, cell, within);
  return part && ChangesSign(AlongPart(differences, line, cell, *part));
}

/// Whether a part of the line, taken as a box, meets a closed cell.
bool IsNearCell(const Line& line, const Index& cell, const Rational& low, const Rational& high)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Rational origin = line.Origin[axis];
    const Rational direction = line.Direction[axis];
    const Rational a = origin + low * direction;
    const Rational b = origin + high * direction;
    if (std::max(a, b) < cell[axis] || std::min(a, b) > cell[axis] + 1)
    {
      return false;
    }
  }
  return true;
}

/// The side of the surface that a point of the line is on; none outside the volume and where a
/// sample is not finite.
std::optional<bool> IsInsideAt(
  const Field& field, double isovalue, const Line& line, const Rational& t)
{
  Index cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Rational x = Rational(line.Origin[axis]) + t * Rational(line.Direction[axis]);
    const int last = field.Dimensions[axis] - 1;
    if (sgn(x) < 0 || x > last)
    {
      return std::nullopt;
    }
    cell[axis] =
      std::min(static_cast<int>(mpz_class(x.get_num() / x.get_den()).get_si()), last - 1);
  }
  std::array<Rational, 8> differences;
  if (!LoadDifferences(field, isovalue, cell, differences))
  {
    return std::nullopt;
  }
  return IsInside(AlongPart(differences, line, cell, { t, t })[0]);
}

}

//------------------------------------------------------------------------------
Verdict Judge(const Field& field, double isovalue, const Line& line, const Claim& claim)
{
  const Rational low = std::max(claim.Low, line.Begin);
  const Rational high = std::min(claim.High, line.End);
  if (!IsNearCell(line, claim.Cell, low, high))
  {
    return Verdict::NotInCell;
  }
  const Interval earlier = { Rational(line.Begin), low };
  const bool isEarlier = AnyCell(
    field, [&](const Index& cell) { return HasSignChange(field, isovalue, line, cell, earlier); });
  if (isEarlier)
  {
    return Verdict::EarlierRoot;
  }
  const std::optional<bool> before = IsInsideAt(field, isovalue, line, low);
  const std::optional<bool> behind = IsInsideAt(field, isovalue, line, high);
  const bool changes = before && behind && *before != *behind && *behind == claim.Entering;
  return changes ? Verdict::Proven : Verdict::NoSignChange;
}

}
