// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef EmissionAbsorption_h
#define EmissionAbsorption_h

#include "Math/Arithmetic.h"

// The light of a ray through a cloud that glows and absorbs: the integral of c a exp(-d), where a
// is the attenuation, c the colour, and d the depth, the integral of a so far. (N. Max: Optical
// Models for Direct Volume Rendering, IEEE TVCG 1(2), 1995.) With a and c linear in a step it is,
// integrated by parts,
//
//   c0 (1 - M) + c1 (M - exp(-d1)),   M = the mean of exp(-d) over the step
//
// (K. Moreland, E. Angel: A Fast High Accuracy Volume Renderer for Unstructured Data, 2004, who
// find M by error functions or in a table). Steps are so short that M is a series.
//
// Of a mixture, whose light is the sum of several products c a, that sum is a polynomial of second
// degree: its integral takes the means of exp(-d), x exp(-d) and x^2 exp(-d), which are series too.
// Where it is lit, and the light is linear as well, it is of third degree.

namespace vtkIsosurfaceRayTracing
{

/// The largest depth of a step. What is left out of the series is less than a 10 millionth
/// of the light.
constexpr double LargestStepDepth = 0.125;

/// A step in which the depth is Linear x + Square x^2, for x from 0 to 1.
template <typename Number>
struct AbsorptionStep
{
  Number Linear;
  Number Square;

  /// Given the attenuations at its ends, times its length.
  SIMD_INLINE AbsorptionStep(Number first, Number last)
    : Linear(first)
    , Square(0.5 * (last - first))
  {
  }

  SIMD_INLINE Number GetDepth() const { return this->Linear + this->Square; }

  /// The x at which the largest depth is reached. The depth of the step must be larger.
  SIMD_INLINE Number FindLargest() const
  {
    const Number discriminant =
      this->Linear * this->Linear + (4.0 * LargestStepDepth) * this->Square;
    return (2.0 * LargestStepDepth) / (this->Linear + Sqrt(Max(discriminant, Number(0.0))));
  }

  /// The part of the light that passes.
  SIMD_INLINE Number GetTransmittance() const
  {
    const Number x = 0.0 - this->GetDepth();
    Number sum = 1.0 + x * (1.0 / 6.0);
    for (int i = 5; i > 0; --i)
    {
      sum = 1.0 + x * sum * (1.0 / i);
    }
    return sum;
  }

  /// The mean of the light that has passed: of the series of exp(-d) term by term.
  SIMD_INLINE Number GetMeanTransmittance() const
  {
    const Number a = this->Linear;
    const Number b = this->Square;
    const Number aa = a * a;
    const Number ab = a * b;
    const Number bb = b * b;
    const Number first = a * (1.0 / 2.0) + b * (1.0 / 3.0);
    const Number second = aa * (1.0 / 6.0) + ab * (1.0 / 4.0) + bb * (1.0 / 10.0);
    const Number third =
      aa * (a * (1.0 / 24.0) + b * (1.0 / 10.0)) + bb * (a * (1.0 / 12.0) + b * (1.0 / 42.0));
    const Number fourth = aa * (aa * (1.0 / 120.0) + ab * (1.0 / 36.0)) +
      bb * (aa * (1.0 / 28.0) + ab * (1.0 / 48.0) + bb * (1.0 / 216.0));
    return 1.0 - (first - (second - (third - fourth)));
  }

  /// The means of x^0, x^1 and so on times the light that has passed: of the power series of
  /// exp(-d), whose derivative is that of -d times itself.
  template <int Count>
  SIMD_INLINE void GetMoments(Number (&moments)[Count]) const
  {
    constexpr int degree = 8;
    Number before = 0.0;
    Number power = 1.0;
    for (int k = 0; k < Count; ++k)
    {
      moments[k] = 1.0 / (k + 1);
    }
    for (int n = 1; n <= degree; ++n)
    {
      const Number next = (this->Linear * power + 2.0 * this->Square * before) * (-1.0 / n);
      before = power;
      power = next;
      for (int k = 0; k < Count; ++k)
      {
        moments[k] = moments[k] + power * (1.0 / (n + k + 1));
      }
    }
  }
};

}

#endif
